/** Where a point that is drawn comes to lie: on a corner or an edge that is near, else on round centimetres. */

import { Buckets, distanceTo } from './places.js';

/** So near to a corner or an edge, or to what is drawn already, a pointer means it. */
export const REACH_PX = 10;

/** What points snap to on one map: walls, areas, doorways and named doors. */
export class Snapper {
  constructor(map) {
    this.sides = [];
    this.buckets = new Buckets(map.bounds);
    const [x0, y0, x1, y1] = map.bounds;
    for (const polygon of [[x0, y0, x1, y0, x1, y1, x0, y1], ...map.walls, ...map.areas.map(({ polygon: of }) => of)]) {
      for (let i = 0; i < polygon.length; i += 2) this.add([polygon[i], polygon[i + 1], polygon[(i + 2) % polygon.length], polygon[(i + 3) % polygon.length]]);
    }
    for (const { segment } of map.doorways) this.add(segment);
    for (const { from, to } of map.named_doors) this.add([...from, ...to]);
  }

  add(side) {
    const [ax, ay, bx, by] = side;
    this.buckets.add([Math.min(ax, bx), Math.min(ay, by), Math.max(ax, bx), Math.max(ay, by)], this.sides.length);
    this.sides.push(side);
  }

  /** The map's point that is meant by one of the screen: as it is, to a millimetre, while Alt is held. */
  meant(camera, at, event) {
    const point = camera.toMap(at);
    return event?.altKey ? point.map(rounded) : this.at(point, REACH_PX / camera.scale, 1 / camera.scale);
  }

  /** The point in place of one of the map. `reach` is how far it may be moved, `pixel` how large a pixel is, metres. */
  at([x, y], reach, pixel) {
    const near = this.buckets.near([x - reach, y - reach, x + reach, y + reach]).map((index) => this.sides[index]);
    const corner = nearest(near.flatMap(([ax, ay, bx, by]) => [[ax, ay], [bx, by]]), [x, y], reach);
    if (corner) return corner.map(rounded);
    // as fine as the hand can be at this zoom
    const step = pixel > 0.05 ? 0.1 : pixel > 0.01 ? 0.05 : 0.01;
    const round = [x, y].map((value) => Math.round(value / step) * step);
    const edge = nearest(near.filter((side) => distanceTo([x, y], side) <= reach).map((side) => foot(round, side)), [x, y], reach + step);
    return (edge ?? round).map(rounded);
  }
}

const rounded = (metres) => Number(metres.toFixed(3));

function nearest(points, [x, y], reach) {
  let [best, least] = [null, reach];
  for (const point of points) {
    const far = Math.hypot(point[0] - x, point[1] - y);
    if (far <= least) [best, least] = [point, far];
  }
  return best;
}

function foot([x, y], [ax, ay, bx, by]) {
  const [dx, dy] = [bx - ax, by - ay];
  const square = dx * dx + dy * dy;
  const along = square ? Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / square)) : 0;
  return [ax + along * dx, ay + along * dy];
}
