/** What people laid over the map: known, found at a point, taken away, changed. */

import { get } from './api.js';
import { list } from './format.js';
import { model } from './model.js';
import { discard, put } from './pending.js';
import { inside } from './places.js';

/** What lies over the map now; nothing where there is no map. */
export async function readLaid() {
  if (model.site?.rooms_mode === 'none') return [];
  return (await get('/api/areas')).laid;
}

const REACH_PX = 10;
const middle = ([[ax, ay], [bx, by]]) => [(ax + bx) / 2, (ay + by) / 2];

/** What was laid around a point of the map; places within some pixels. */
export function laidAt([x, y], scale) {
  const near = ([cx, cy]) => Math.hypot(cx - x, cy - y) * scale <= REACH_PX;
  return model.laid.filter(({ what, corners }) => (what === 'place' ? near(corners[0]) : what === 'door' ? near(middle(corners)) : inside([x, y], corners.flat())));
}

const goneId = ({ name }) => `lift:${name}`;

/** Whether it is to be taken away. */
export const isGoing = (laid) => model.pending.has(goneId(laid));

/** Has it taken away with what is saved next; asked once more, it stays. */
export function takeAway(laid) {
  if (isGoing(laid)) return discard(goneId(laid));
  discard(`laid:${laid.name}`);
  const shape = { what: laid.what, name: laid.name, points: laid.corners, gone: true };
  return put(goneId(laid), { words: `Taken away: ${describe(laid)}`, edits: [{ kind: 'lift', name: laid.name }], shape });
}

/** `the area “wet floor” (wet)`. */
export const describe = ({ what, name, kind }) => `the ${what === 'door' ? 'doorway' : what} “${name}”${kind ? ` (${kind})` : ''}`;

/** Names of things that lie there, in words. */
export const names = (all) => list(all.map(({ name }) => name));
