/** What people call the ends of missions, on the map and in time. */

import { model } from './model.js';

/** Metres from a place at which a point is called by its name. */
const NEAR = 0.5;
/** An end of a mission as people call it: the place there, or the space, or where it is. */
function endName([x, y], space) {
  const place = (model.map?.places ?? []).find((of) => Math.hypot(of.x - x, of.y - y) <= NEAR);
  return place?.place ?? space ?? `${x.toFixed(1)}, ${y.toFixed(1)}`;
}

/** From where to where a mission led. */
export const fromTo = ({ start, goal, spaces: [from, to] }) => `${endName(start, from)} → ${endName(goal, to)}`;

const ENDED = { arrived: 'arrived', no_way: 'found no way', lost: 'did not know where it was', silent: 'was not heard any more', gave_up: 'gave up' };

/** How a mission ended, in words. */
export const ended = ({ ending, meaning }) => ENDED[ending] ?? meaning;
