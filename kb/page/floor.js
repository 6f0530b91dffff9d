/** The floor as the service packs it: a text with what people named, then numbers. The manual says how, under “A packed floor”. */

import { get } from './api.js';

/** The floor as it is now. */
export const getFloor = async () => unpack(await get('/api/floor', { bytes: true }));

/** What rules say of its rooms and doors. */
export const getWeights = () => get('/api/weights?changes=false');

function unpack(packed) {
  const length = new DataView(packed).getUint32(0, true);
  const { names, counts: [walls, rooms, doors], ...map } = JSON.parse(new TextDecoder().decode(new Uint8Array(packed, 4, length)));
  const numbers = new Numbers(packed, 4 + length, map.bounds);
  map.walls = numbers.polygons(walls);
  const [number, layer, shape] = [numbers.integers(rooms), numbers.integers(rooms), numbers.polygons(rooms)];
  map.rooms = shape.map((corners, index) => ({ room: number[index], name: names[index], layer: layer[index] < 0 ? null : layer[index], ...shaped(corners) }));
  const [door, room1, segments] = [numbers.integers(doors), numbers.integers(doors), numbers.points(doors * 2)];
  map.doors = Array.from(door, (of, index) => ({ door: of, room1: room1[index], segment: segments.slice(4 * index, 4 * index + 4) }));
  return map;
}

// Two corners are those of a rectangle.
function shaped(corners) {
  if (corners.length === 4) return { rect: corners };
  const rect = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; i < corners.length; i += 2) {
    rect[0] = Math.min(rect[0], corners[i]);
    rect[1] = Math.min(rect[1], corners[i + 1]);
    rect[2] = Math.max(rect[2], corners[i]);
    rect[3] = Math.max(rect[3], corners[i + 1]);
  }
  return { rect, outline: corners };
}

class Numbers {
  constructor(packed, at, [x0, y0]) {
    Object.assign(this, { packed, at, from: [x0, y0] });
  }

  take(Kind, count) {
    const taken = new Kind(this.packed, this.at, count);
    this.at += 4 * count;
    return taken;
  }

  integers(count) {
    return this.take(Int32Array, count);
  }

  /** Points as x, y, x, y, …; they are counted from the map's lower left corner. */
  points(count) {
    const [x0, y0] = this.from;
    const taken = this.take(Float32Array, 2 * count);
    // A loop: what goes over a large floor value by value by a function takes five times as long.
    const all = new Array(2 * count);
    for (let i = 0; i < all.length; i += 2) {
      all[i] = taken[i] + x0;
      all[i + 1] = taken[i + 1] + y0;
    }
    return all;
  }

  polygons(count) {
    const corners = this.integers(count);
    const all = this.points(corners.reduce((sum, of) => sum + of, 0));
    let from = 0;
    return Array.from(corners, (of) => all.slice(from, (from += 2 * of)));
  }
}
