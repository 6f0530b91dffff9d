/** What takes longest is asked for first, while the rest of the page is still on its way. */

import { get } from './api.js';
import { getFloor, getWeights } from './floor.js';

const begun = (work) => {
  // A failure is heard where it is waited for; until then it is no stray one.
  work.catch(() => {});
  return work;
};

export const first = { site: begun(get('/api/site')), floor: begun(getFloor()), weights: begun(getWeights()) };
