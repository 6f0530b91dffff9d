/** Which rooms and doors are drawn, in which order and colour: paths by colour, made once per weights. */

import { model } from './model.js';
import { Actions, Classes } from './palette.js';
import { Patches } from './patches.js';
import { trace } from './shapes.js';

/** The view of all layers at once: wherever several states fit, the room that is easiest lies on top. */
export const EASIEST = 'easiest';

/** Whether rooms carry hardness here; in the paper's modes the doors do. */
export const roomsWeigh = () => model.map.layers.length > 0;

/** Whether a layer is of the robot whose way is asked. */
export const ofRobot = (layer) => !model.ask.robot || model.map.layers[layer].robot === model.ask.robot;

/** What is drawn of one layer (or of all) with the present weights and preview. */
export class Drawn {
  constructor(layer) {
    const { map, weights } = model;
    this.layer = layer;
    this.generation = weights.generation;
    const rows = model.table('robots');
    const actionAt = rows?.columns.findIndex((column) => column.name === 'action') ?? -1;
    const ordered = rows && actionAt >= 0 ? rows.rows.map((row) => row[actionAt]) : [];
    this.actions = new Actions([...ordered, ...weights.rooms.action]);
    const counts = roomsWeigh() ? weights.rooms : weights.doors;
    this.classes = new Classes(counts.hardness.filter((value, i) => value !== null && counts.passable[i] !== false));
    const changed = (of, numbered) => new Map((of?.list ?? []).map((thing) => [numbered(thing), thing]).filter(([index]) => index !== undefined));
    this.changedRooms = changed(model.tried?.rooms, ({ room }) => model.roomIndex.get(room));
    this.changedDoors = changed(model.tried?.doors, ({ door }) => model.doorIndex.get(door));
    const shows = map.layers.map((_, index) => (layer === EASIEST ? ofRobot(index) : index === layer));
    this.rooms = map.rooms.flatMap((room, index) => (room.layer === null || shows[room.layer] ? [index] : []));
    this.shownRooms = new Set(this.rooms);
    this.doors = map.doors.flatMap((door, index) => (this.showsDoor(door, index) ? [index] : []));
    this.shownDoors = new Set(this.doors);
    this.roomGroups = this.groupRooms();
    this.doorGroups = this.groupDoors();
  }

  showsDoor(door, index) {
    const { map, weights } = model;
    if (!roomsWeigh()) return true;
    const notable = weights.doors.passable[index] === false || weights.doors.hardness[index] > 0;
    if (this.layer === EASIEST && !notable && !this.changedDoors.has(index)) return false;
    const { layer } = map.rooms[model.roomIndex.get(door.room1)];
    return this.layer === EASIEST ? ofRobot(layer) : layer === this.layer;
  }

  /** The class of a room: of its hardness; -1 barred, -2 unknown, -3 where rooms weigh nothing. */
  roomClass(index) {
    const { rooms } = model.weights;
    if (rooms.passable[index] === false) return -1;
    if (!roomsWeigh()) return -3;
    return rooms.hardness[index] === null ? -2 : this.classes.of(rooms.hardness[index]);
  }

  // The hardest first, so that the easiest lies on top; barred and unknown rooms lowest.
  groupRooms() {
    const groups = new Map();
    for (const index of this.rooms) {
      const kind = this.roomClass(index);
      const changed = this.changedRooms.has(index);
      const action = kind === -3 ? model.weights.rooms.action[index] : null;
      const name = `${kind}/${changed}/${action}`;
      if (!groups.has(name)) groups.set(name, { kind, changed, action, patches: new Patches(model.map.bounds, this.rooms.length) });
      const room = model.map.rooms[index];
      trace(groups.get(name).patches.path(room.rect), room);
    }
    const rank = ({ kind }) => (kind < 0 ? 1000 - kind : kind);
    return [...groups.values()].sort((a, b) => rank(b) - rank(a) || Number(a.changed) - Number(b.changed));
  }

  groupDoors() {
    const { map, weights } = model;
    const groups = new Map();
    for (const index of this.doors) {
      const passable = weights.doors.passable[index];
      const hardness = weights.doors.hardness[index];
      const kind = passable !== true ? -1 : roomsWeigh() || hardness === null ? -2 : this.classes.of(hardness);
      const changed = this.changedDoors.has(index);
      const name = `${kind}/${changed}`;
      if (!groups.has(name)) groups.set(name, { kind, changed, patches: new Patches(map.bounds, this.doors.length) });
      const [x0, y0, x1, y1] = map.doors[index].segment;
      const path = groups.get(name).patches.path([Math.min(x0, x1), Math.min(y0, y1), Math.max(x0, x1), Math.max(y0, y1)]);
      path.moveTo(x0, y0);
      path.lineTo(x1, y1);
    }
    return [...groups.values()];
  }

  /** The room that is seen at a point: of those there the one that lies on top. */
  topRoom(indices) {
    const here = indices.filter((index) => this.shownRooms.has(index));
    const weight = (index) => (model.weights.rooms.passable[index] === false ? Infinity : model.weights.rooms.hardness[index] ?? 1e308);
    return here.sort((a, b) => weight(a) - weight(b) || a - b)[0] ?? -1;
  }
}

/** A layer as it is called: its state, its robot where there are several, its facing where it has one. */
export function layerName({ robot, state, facing }) {
  const several = (model.site?.robots.length ?? 1) > 1;
  return `${several ? `${robot}: ` : ''}${state}${facing === null || facing === undefined ? '' : `, facing ${facing}°`}`;
}
