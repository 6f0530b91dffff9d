/** The words on the map. None covers another: what matters most is written first, and what finds no room is left out. */

import { number } from './format.js';
import { EASIEST, roomsWeigh } from './layers.js';
import { model } from './model.js';
import { boxIn, centreOf } from './shapes.js';
import { onlyInto, showsPieces } from './thing.js';

const MOST_ROOMS = 500;
const PLAIN = '12px system-ui, sans-serif';
const BOLD = '600 12px system-ui, sans-serif';

/** Writes the labels of one frame. */
export class Labels {
  constructor(context, ink, width) {
    this.context = context;
    this.ink = ink;
    this.width = width;
    this.taken = [];
  }

  /** Keeps a box free, of what was drawn otherwise. */
  keep(x, y, half) {
    this.taken.push([x - half, y - half, x + half, y + half]);
  }

  /** Writes a text at the first of these spots where it covers nothing; says whether it did. */
  put(text, spots, font = PLAIN) {
    const { context, ink } = this;
    context.font = font;
    const width = context.measureText(text).width;
    for (const [x, y, align] of spots) {
      const wished = align === 'left' ? x : align === 'right' ? x - width : x - width / 2;
      // Of what is in sight the word is, too.
      const most = this.width - width - 3;
      const left = x < 0 || x > this.width ? wished : Math.max(3, Math.min(wished, most));
      const box = [left - 1, y - 8, left + width + 1, y + 8];
      if (this.taken.some((other) => box[0] < other[2] && other[0] < box[2] && box[1] < other[3] && other[1] < box[3])) continue;
      this.taken.push(box);
      context.textAlign = 'left';
      context.textBaseline = 'middle';
      context.lineWidth = 3.5;
      context.lineJoin = 'round';
      context.strokeStyle = ink.paper;
      context.strokeText(text, left, y);
      context.fillStyle = ink.ink;
      context.fillText(text, left, y);
      return true;
    }
    return false;
  }
}

const around = ([x, y], by) => [[x + by, y, 'left'], [x, y - by - 6, 'center'], [x, y + by + 6, 'center'], [x - by, y, 'right']];

// So many things are looked at in one step, about.
const STEP = 25;

/** All labels of the floor, step by step, the most telling first. `find` gives the rooms of all layers at a point. */
export function* labelFloor(labels, camera, shown, find) {
  places(labels, camera);
  const { map, weights } = model;
  for (const door of map.named_doors) {
    if (camera.scale > 6) labels.put(door.name, around(camera.toScreen([(door.from[0] + door.to[0]) / 2, (door.from[1] + door.to[1]) / 2]), 8), BOLD);
  }
  for (const { rect: [x0, y0, x1, y1], height } of map.bridges) {
    const [px, py] = camera.toScreen([(x0 + x1) / 2, (y0 + y1) / 2]);
    const half = ((y1 - y0) * camera.scale) / 2;
    if ((x1 - x0) * camera.scale > 8) labels.put(`${number(height)} m high`, [[px, py - half + 10, 'center'], [px, py - half - 9, 'center'], [px, py + half + 9, 'center']]);
  }
  for (const area of map.areas) {
    const [px, py] = camera.toScreen([area.polygon[0], area.polygon[1]]);
    labels.put(area.kind ? `${area.name} (${area.kind})` : area.name, [[px + 4, py - 9, 'left'], [px + 4, py + 9, 'left']]);
  }
  yield;
  if (!roomsWeigh()) yield* doors(labels, camera, shown, weights);
  if (showsPieces()) yield* rooms(labels, camera, shown, find);
  else yield* spaces(labels, camera);
}

// The largest first: a corridor is known by its name before a niche is.
function* spaces(labels, camera) {
  const { map, weights } = model;
  const known = new Set(map.places.map(({ place }) => place));
  const order = map.spaces.map((_, index) => index).sort((a, b) => map.spaces[b].area - map.spaces[a].area);
  let seen = 0;
  for (const index of order) {
    seen += 1;
    if (seen % STEP === 0) yield;
    const { at, area } = map.spaces[index];
    const name = weights.spaces.name[index];
    if (known.has(name) || Math.sqrt(area) * camera.scale < 40) continue;
    const [px, py] = camera.toScreen(at);
    labels.put(weights.spaces.closed[index] ? `${name} ✕` : name, [[px, py, 'center'], [px, py + 16, 'center'], [px, py - 16, 'center']]);
  }
  for (const [index, { segment: [x0, y0, x1, y1] }] of map.doorways.entries()) {
    if (index % STEP === 0) yield;
    const { closed, name: names } = weights.doorways;
    const [name, into] = [names[index], onlyInto(index)];
    if (Math.hypot(x1 - x0, y1 - y0) * camera.scale < 24 && !closed[index] && !into) continue;
    labels.put(closed[index] ? `${name} ✕` : into ? `${name} → ${into}` : name, around(camera.toScreen([(x0 + x1) / 2, (y0 + y1) / 2]), 9));
  }
}

function places(labels, camera) {
  const { context, ink } = labels;
  for (const place of model.map.places) {
    const at = camera.toScreen([place.x, place.y]);
    context.fillStyle = ink.ink;
    context.beginPath();
    context.arc(at[0], at[1], 3, 0, 7);
    context.fill();
    if (place.place !== model.route?.start && place.place !== model.route?.goal) labels.put(place.place, around(at, 7), BOLD);
  }
}

function* doors(labels, camera, shown, weights) {
  for (const [seen, index] of shown.doors.entries()) {
    if (seen % STEP === 0) yield;
    const { door, segment: [x0, y0, x1, y1] } = model.map.doors[index];
    if (Math.hypot(x1 - x0, y1 - y0) * camera.scale < 36) continue;
    const shut = weights.doors.passable[index] === true ? '' : ' ✕';
    const upright = Math.abs(x1 - x0) < Math.abs(y1 - y0);
    const at = (share) => [...camera.toScreen([x0 + share * (x1 - x0), y0 + share * (y1 - y0)])];
    const beside = [0.5, 0.25, 0.75].flatMap((share) => {
      const [px, py] = at(share);
      return upright ? [[px + 8, py, 'left'], [px - 8, py, 'right']] : [[px, py - 13, 'center'], [px, py + 13, 'center']];
    });
    labels.put(`door ${door}${shut}`, beside);
  }
}

function* rooms(labels, camera, shown, find) {
  const [sx0, sy0, sx1, sy1] = camera.seen();
  const { map, weights } = model;
  let left = MOST_ROOMS;
  for (const index of shown.rooms) {
    const room = map.rooms[index];
    const [x0, y0, x1, y1] = room.rect;
    if (x1 < sx0 || x0 > sx1 || y1 < sy0 || y0 > sy1) continue;
    const [wide, high] = boxIn(room).map((side) => side * camera.scale);
    if (Math.min(wide * 0.8, high) < 22) continue;
    const middle = centreOf(room);
    if (roomsWeigh() && shown.layer === EASIEST && shown.topRoom(find(middle)) !== index) continue;
    const [px, py] = camera.toScreen(middle);
    const letter = weights.rooms.passable[index] === false ? '✕' : shown.actions.letter(weights.rooms.action[index]);
    const lower = py + Math.min(18, high / 4);
    labels.put(`${room.name} · ${letter}`, [[px, py, 'center'], [px, lower, 'center'], [px, 2 * py - lower, 'center']]);
    left -= 1;
    if (left % STEP === 0) yield;
    if (left === 0) break;
  }
}
