/** What lies where: rooms and doors by a point, through a grid of buckets. */

import { holds } from './shapes.js';

const CELLS = 64;

/** Buckets over the map's bounds. */
export class Buckets {
  constructor([x0, y0, x1, y1]) {
    this.origin = [x0, y0];
    this.size = Math.max((x1 - x0) / CELLS, (y1 - y0) / CELLS, 1e-6);
    this.buckets = new Map();
  }

  cells([x0, y0, x1, y1]) {
    const at = (value, axis) => Math.floor((value - this.origin[axis]) / this.size);
    const cells = [];
    for (let i = at(x0, 0); i <= at(x1, 0); i += 1) for (let j = at(y0, 1); j <= at(y1, 1); j += 1) cells.push(i * 100003 + j);
    return cells;
  }

  add(rect, index) {
    for (const cell of this.cells(rect)) {
      const found = this.buckets.get(cell);
      if (found) found.push(index);
      else this.buckets.set(cell, [index]);
    }
  }

  near(rect) {
    const found = new Set();
    for (const cell of this.cells(rect)) for (const index of this.buckets.get(cell) ?? []) found.add(index);
    return [...found];
  }
}

/** The distance from a point to a segment. */
export function distanceTo([x, y], [x0, y0, x1, y1]) {
  const [dx, dy] = [x1 - x0, y1 - y0];
  const square = dx * dx + dy * dy;
  const along = square ? Math.max(0, Math.min(1, ((x - x0) * dx + (y - y0) * dy) / square)) : 0;
  return Math.hypot(x - x0 - along * dx, y - y0 - along * dy);
}

/** Finds rooms, doors, named doors and places of one map. */
export class Finder {
  constructor(map) {
    this.map = map;
    this.rooms = new Buckets(map.bounds);
    this.doors = new Buckets(map.bounds);
    this.spaces = new Buckets(map.bounds);
    this.doorways = new Buckets(map.bounds);
    map.spaces.forEach(({ rings: [outer = []] }, index) => this.spaces.add(boxOf(outer), index));
    map.doorways.forEach(({ segment }, index) => this.doorways.add(boxOf(segment), index));
    map.rooms.forEach((room, index) => this.rooms.add(room.rect, index));
    map.doors.forEach((door, index) => {
      this.doors.add(boxOf(door.segment), index);
    });
  }

  /** Indices of the rooms at a point, whatever their layer. */
  roomsAt([x, y]) {
    return this.rooms.near([x, y, x, y]).filter((index) => holds(this.map.rooms[index], [x, y]));
  }

  /** The index of the nearest door within reach among those that are drawn, or -1. */
  doorAt(at, reach, drawn) {
    return nearest(this.doors, this.map.doors, at, reach, drawn);
  }

  /** The index of the nearest doorway within reach, or -1. */
  doorwayAt(at, reach) {
    return nearest(this.doorways, this.map.doorways, at, reach, () => true);
  }

  /** The index of the space at a point, or -1. */
  spaceAt([x, y]) {
    // A hole is a ring more: a point in it is in an even number of rings.
    const within = (index) => this.map.spaces[index].rings.filter((ring) => inside([x, y], ring)).length % 2 === 1;
    return this.spaces.near([x, y, x, y]).find(within) ?? -1;
  }

  /** The named door within reach, or undefined. */
  namedDoorAt(at, reach) {
    return this.map.named_doors.find((door) => distanceTo(at, [...door.from, ...door.to]) <= reach);
  }

  /** The place within reach, or undefined. */
  placeAt([x, y], reach) {
    return this.map.places.find((place) => Math.hypot(place.x - x, place.y - y) <= reach);
  }

  /** Names of the areas around a point. */
  areasAt([x, y]) {
    return this.map.areas.filter((area) => inside([x, y], area.polygon));
  }
}

/** The box about points x, y, x, y, … */
export function boxOf(points) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i += 1) {
    const axis = i % 2;
    box[axis] = Math.min(box[axis], points[i]);
    box[axis + 2] = Math.max(box[axis + 2], points[i]);
  }
  return box;
}

function nearest(buckets, list, at, reach, drawn) {
  const [x, y] = at;
  let best = -1;
  let least = reach;
  for (const index of buckets.near([x - reach, y - reach, x + reach, y + reach])) {
    const distance = drawn(index) ? distanceTo(at, list[index].segment) : Infinity;
    if (distance <= least) [best, least] = [index, distance];
  }
  return best;
}

/** Whether a point lies in a polygon x, y, x, y, … */
export function inside([x, y], polygon) {
  let within = false;
  for (let i = 0, j = polygon.length - 2; i < polygon.length; j = i, i += 2) {
    const [xi, yi, xj, yj] = [polygon[i], polygon[i + 1], polygon[j], polygon[j + 1]];
    if (yi > y !== yj > y && x < ((xj - xi) * (y - yi)) / (yj - yi) + xi) within = !within;
  }
  return within;
}
