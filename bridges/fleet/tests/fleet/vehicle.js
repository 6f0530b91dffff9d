// A vehicle that others wrote (npm vda-5050-lib): drives what its order says, and prints each state as a line.
// node vehicle.js FOLDER-OF-NODE_MODULES BROKER VERSION SERIAL MAP X Y SPEED
const [folder, brokerUrl, version, serialNumber, mapId, x, y, speed] = process.argv.slice(2);
const { AgvController, VirtualAgvAdapter } = require(require.resolve("vda-5050-lib", { paths: [folder] }));

// the library knows 2.0; what it uses of an order is the same in 2.1, where only the head says another version
class Vehicle extends AgvController {
    validateTopicObject(topic, object, known) {
        if (object.version !== version) throw new TypeError(`version ${object.version}, and it speaks ${version}`);
        super.validateTopicObject(topic, { ...object, version: known }, known);
    }
    _withObjectHeader(...args) {
        return { ...super._withObjectHeader(...args), version };
    }
    async publish(topic, object, options) {
        const said = await super.publish(topic, object, options);
        if (topic === "state" && said) console.log(JSON.stringify(said));
        return said;
    }
}
const vehicle = new Vehicle({ manufacturer: "acme", serialNumber },
    { interfaceName: "uagv", transport: { brokerUrl, reconnectPeriod: 200 }, vdaVersion: "2.0.0" },
    { agvAdapterType: VirtualAgvAdapter, publishStateInterval: 1000, publishVisualizationInterval: 0 },
    { initialPosition: { mapId, x: +x, y: +y, theta: 0, lastNodeId: "start" }, vehicleSpeed: +speed, tickRate: 50 });
vehicle.start().catch(error => { console.error(error); process.exit(1); });

const error = { errorType: "obstacle", errorLevel: "WARNING", errorDescription: "a pallet", errorReferences: [] };
const commands = {
    lost: () => vehicle.updateAgvPositionVelocity({ ...vehicle.currentState.agvPosition, positionInitialized: false }, undefined, true),
    obstacle: () => { vehicle._agvAdapter.stopDriving(); vehicle._agvAdapter._traverseContext = undefined; vehicle.updateErrors(error, "add", true); },
    clear: () => vehicle.updateErrors(error, "remove", true),
    vanish: () => process.kill(process.pid, "SIGKILL"),
};
require("readline").createInterface({ input: process.stdin }).on("line", line => commands[line]()).on("close", () => process.exit(0));
