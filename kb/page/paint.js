/** Paints one frame of the map. */

import { number } from './format.js';
import { roomsWeigh } from './layers.js';
import { model } from './model.js';
import { hatching } from './palette.js';
import { colour } from './theme.js';
import { paintRoutes } from './paint-route.js';

const MOST_LABELS = 500;

/** Colours and patterns of the present theme, made once until it changes. */
export function inks(context) {
  const named = Object.fromEntries(['ink', 'faint', 'paper', 'wall', 'free', 'amber', 'amber-line', 'shut', 'line'].map((name) => [name, colour(name)]));
  return {
    ...named,
    bridge: hatching(context, colour('bridge'), null, 1.6),
    changed: hatching(context, colour('amber-line'), colour('amber')),
    barred: hatching(context, colour('shut'), colour('free'), 1.2),
    unknown: hatching(context, colour('faint'), colour('free'), 1),
  };
}

/** Everything, from the floor up to the labels. `shown` is a Drawn, `still` the walls' Path2D. */
export function paint(context, camera, shown, still, ink, pointed) {
  const dense = window.devicePixelRatio || 1;
  const { clientWidth: width, clientHeight: height } = context.canvas;
  context.setTransform(dense, 0, 0, dense, 0, 0);
  context.clearRect(0, 0, width, height);
  context.fillStyle = ink.paper;
  context.fillRect(0, 0, width, height);
  const world = () => context.setTransform(dense * camera.scale, 0, 0, -dense * camera.scale, dense * camera.shift[0], dense * camera.shift[1]);
  const screen = () => context.setTransform(dense, 0, 0, dense, 0, 0);
  const pixel = 1 / camera.scale;
  const tile = new DOMMatrix([pixel, 0, 0, pixel, 0, 0]);
  for (const pattern of [ink.bridge, ink.changed, ink.barred, ink.unknown]) pattern.setTransform(tile);

  world();
  context.fillStyle = ink.free;
  const [x0, y0, x1, y1] = model.map.bounds;
  context.fillRect(x0, y0, x1 - x0, y1 - y0);
  for (const group of shown.roomGroups) {
    context.fillStyle = group.changed ? ink.changed : group.kind >= 0 ? shown.classes.colour(group.kind)
      : { [-1]: ink.barred, [-2]: ink.unknown, [-3]: ink.paper }[group.kind];
    context.fill(group.path);
    context.lineWidth = group.changed ? 1.5 * pixel : 0.6 * pixel;
    context.strokeStyle = group.changed ? ink['amber-line'] : ink.line;
    context.stroke(group.path);
  }
  context.fillStyle = ink.bridge;
  context.fill(still.bridges);
  context.fillStyle = ink.wall;
  context.fill(still.walls);
  context.strokeStyle = ink.wall;
  context.lineWidth = 2 * pixel;
  context.strokeRect(x0, y0, x1 - x0, y1 - y0);
  context.setLineDash([6 * pixel, 4 * pixel]);
  context.strokeStyle = ink.ink;
  context.lineWidth = pixel;
  context.stroke(still.areas);
  context.setLineDash([]);
  paintDoors(context, shown, ink, pixel);
  context.lineWidth = 4 * pixel;
  context.strokeStyle = ink.ink;
  context.stroke(still.namedDoors);
  if (pointed) outline(context, pointed, ink, pixel);

  screen();
  labels(context, camera, shown, ink);
  paintRoutes(context, camera, shown, ink);
  places(context, camera, ink);
}

function paintDoors(context, shown, ink, pixel) {
  for (const group of shown.doorGroups) {
    const weighed = group.kind >= 0 || group.kind === -1;
    context.lineWidth = (group.changed ? 6 : weighed ? 4.5 : 1.5) * pixel;
    context.setLineDash(group.kind === -1 ? [3 * pixel, 3 * pixel] : []);
    if (group.kind >= 0 && !group.changed) {
      // A dark line around it: the palest class would not be seen on the floor.
      context.strokeStyle = ink.ink;
      context.lineWidth = 7 * pixel;
      context.stroke(group.path);
      context.lineWidth = 4.5 * pixel;
    }
    context.strokeStyle = group.changed ? ink['amber-line'] : group.kind >= 0 ? shown.classes.colour(group.kind) : group.kind === -1 ? ink.shut : ink.faint;
    context.stroke(group.path);
  }
  context.setLineDash([]);
}

function outline(context, pointed, ink, pixel) {
  context.strokeStyle = ink.ink;
  context.lineWidth = 2 * pixel;
  if (pointed.kind === 'room') {
    const [x0, y0, x1, y1] = model.map.rooms[pointed.index].rect;
    context.strokeRect(x0, y0, x1 - x0, y1 - y0);
  } else if (pointed.kind === 'door') {
    const [x0, y0, x1, y1] = model.map.doors[pointed.index].segment;
    context.lineWidth = 9 * pixel;
    context.globalAlpha = 0.5;
    context.beginPath();
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
    context.stroke();
    context.globalAlpha = 1;
  }
}

/** Text that can be read on any ground. */
export function write(context, text, x, y, ink, align = 'center') {
  context.textAlign = align;
  context.textBaseline = 'middle';
  context.lineWidth = 3.5;
  context.lineJoin = 'round';
  context.strokeStyle = ink.paper;
  context.strokeText(text, x, y);
  context.fillStyle = ink.ink;
  context.fillText(text, x, y);
}

function labels(context, camera, shown, ink) {
  const [sx0, sy0, sx1, sy1] = camera.seen();
  const { map, weights } = model;
  context.font = '12px system-ui, sans-serif';
  let left = MOST_LABELS;
  for (const index of shown.rooms) {
    const [x0, y0, x1, y1] = map.rooms[index].rect;
    if (x1 < sx0 || x0 > sx1 || y1 < sy0 || y0 > sy1 || Math.min((x1 - x0) * camera.scale * 0.8, (y1 - y0) * camera.scale) < 22) continue;
    if (roomsWeigh() && shown.layer === 'easiest' && shown.topRoom(roomsAround(index)) !== index) continue;
    const [px, py] = camera.toScreen([(x0 + x1) / 2, (y0 + y1) / 2]);
    const letter = weights.rooms.passable[index] === false ? '✕' : shown.actions.letter(weights.rooms.action[index]);
    write(context, `${map.rooms[index].name} · ${letter}`, px, py, ink);
    left -= 1;
    if (left === 0) break;
  }
  if (!roomsWeigh()) doorLabels(context, camera, shown, ink);
  for (const bridge of map.bridges) {
    const [x0, , x1, y1] = bridge.rect;
    const [px, py] = camera.toScreen([(x0 + x1) / 2, y1]);
    if ((x1 - x0) * camera.scale > 8) write(context, `${number(bridge.height)} m high`, px, py + 9, ink);
  }
  for (const area of map.areas) {
    const [px, py] = camera.toScreen([area.polygon[0], area.polygon[1]]);
    write(context, area.kind ? `${area.name} (${area.kind})` : area.name, px + 4, py - 8, ink, 'left');
  }
  for (const door of map.named_doors) {
    const [px, py] = camera.toScreen([(door.from[0] + door.to[0]) / 2, (door.from[1] + door.to[1]) / 2]);
    if (camera.scale > 8) write(context, door.name, px + 6, py - 8, ink, 'left');
  }
}

// Rooms of other layers around the middle of this one: asked of the page's finder, which the map sets.
let roomsAround = () => [];

/** Says how rooms at the middle of a room are found. */
export const setRoomsAround = (find) => { roomsAround = find; };

function doorLabels(context, camera, shown, ink) {
  const { map, weights } = model;
  for (const index of shown.doors) {
    const [x0, y0, x1, y1] = map.doors[index].segment;
    if (Math.hypot(x1 - x0, y1 - y0) * camera.scale < 30) continue;
    const [px, py] = camera.toScreen([(x0 + x1) / 2, (y0 + y1) / 2]);
    const shut = weights.doors.passable[index] === true ? '' : ' ✕';
    write(context, `door ${map.doors[index].door}${shut}`, px, py, ink);
  }
}

function places(context, camera, ink) {
  context.font = '600 12px system-ui, sans-serif';
  for (const place of model.map.places) {
    const [px, py] = camera.toScreen([place.x, place.y]);
    context.fillStyle = ink.ink;
    context.beginPath();
    context.arc(px, py, 3, 0, 7);
    context.fill();
    if (camera.scale > 6 || model.map.places.length < 30) write(context, place.place, px + 7, py, ink, 'left');
  }
}
