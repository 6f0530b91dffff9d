/** How long things on the map are, and where one points. */

import { byId } from './dom.js';
import { list } from './format.js';

const LONGEST_PX = 130;

/** Shows how long a metre is at this zoom: the longest bar of 1, 2 or 5 times a power of ten that fits. */
export function showScale(camera) {
  const most = LONGEST_PX / camera.scale;
  const power = 10 ** Math.floor(Math.log10(most));
  const metres = power * ([5, 2, 1].find((times) => times * power <= most) ?? 1);
  const bar = byId('scale-bar');
  bar.style.setProperty('width', `${metres * camera.scale}px`);
  bar.textContent = metres < 1 ? `${Math.round(metres * 100)} cm` : `${metres} m`;
}

/** Shows a point of the map, or none. */
export function showPoint(at) {
  byId('at').textContent = at ? `x ${at[0].toFixed(2)}, y ${at[1].toFixed(2)} m` : '';
}

/** How large a shape is, in words. */
export function size(points) {
  if (points.length < 2) return '';
  const [xs, ys] = [0, 1].map((axis) => points.map((point) => point[axis]));
  const sides = [xs, ys].map((of) => `${(Math.max(...of) - Math.min(...of)).toFixed(2)} m`);
  return `${sides[0]} wide, ${sides[1]} deep, ${area(corners(points)).toFixed(1)} m²`;
}

/** How wide a doorway is, in words. */
export const span = (points) => (points.length < 2 ? '' : `${metresOf(points)} wide`);

/** How far it is along these points. */
export function metresOf(points) {
  const far = points.slice(1).reduce((sum, [x, y], i) => sum + Math.hypot(x - points[i][0], y - points[i][1]), 0);
  return `${far.toFixed(2)} m`;
}

/** How far it is from each point to the next, in words, and in all. */
export function distances(points) {
  if (points.length < 2) return `From x ${points[0][0].toFixed(2)}, y ${points[0][1].toFixed(2)} m: press the next point.`;
  const each = points.slice(1).map((point, i) => metresOf([points[i], point]));
  return each.length === 1 ? `It is ${each[0]} from one to the other.` : `${list(each)}: ${metresOf(points)} in all.`;
}

/** The corners of a shape: two points are those of a rectangle. */
export function corners(points) {
  if (points.length !== 2) return points;
  const [[ax, ay], [bx, by]] = points;
  return [[ax, ay], [bx, ay], [bx, by], [ax, by]];
}

function area(points) {
  const twice = points.reduce((sum, [x, y], i) => {
    const [nx, ny] = points[(i + 1) % points.length];
    return sum + x * ny - nx * y;
  }, 0);
  return Math.abs(twice) / 2;
}
