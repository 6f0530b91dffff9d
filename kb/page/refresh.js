/** Keeps the page at the newest generation. */

import { get } from './api.js';
import { askRoute } from './ends.js';
import { model } from './model.js';
import { complain } from './notice.js';

let running = null;
let again = false;

/**
 * Loads what changed up to `generation` (all that may have, where none is given). One load runs at a time; what comes
 * meanwhile is loaded once after it.
 */
export async function refresh(generation) {
  if (generation !== undefined && generation <= (model.weights?.generation ?? 0)) return running;
  if (running) {
    again = true;
    return running;
  }
  running = load();
  try {
    await running;
  } catch (error) {
    // An unreachable service has its own banner; when the line is back, everything is loaded anew.
    if (error.status !== 0) complain(error);
  } finally {
    running = null;
  }
  if (again) {
    again = false;
    return refresh();
  }
  return undefined;
}

async function load() {
  const [weights, site, tables] = await Promise.all([get('/api/weights'), get('/api/site'), get('/api/tables'), askRoute()]);
  if (weights.layout !== model.map?.layout) {
    const map = await get('/api/map');
    if (map.layout !== weights.layout) return load();
    model.set('site', site);
    model.set('tables', tables);
    model.weights = null;
    model.preview = null;
    model.set('map', map);
  } else {
    model.set('site', site);
    model.set('tables', tables);
  }
  model.set('weights', weights);
  model.set('generation', weights.generation);
  return undefined;
}
