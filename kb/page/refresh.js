/** Keeps the page at the newest generation. */

import { get } from './api.js';
import { askRoute } from './ends.js';
import { getFloor, getWeights } from './floor.js';
import { readLaid } from './laid.js';
import { model } from './model.js';
import { complain } from './notice.js';
import { readTunings } from './tunings.js';

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
  const rest = Promise.all([get('/api/site'), get('/api/tables'), readLaid(), readTunings(), get('/api/facts')]);
  // A failure of the rest is heard below, when it is waited for; until then it is no stray one.
  rest.catch(() => {});
  const way = askRoute();
  const weights = await getWeights();
  const moved = weights.layout !== model.map?.layout;
  // What an edit weighs is drawn at once; only a floor that was cut anew has to wait for its map.
  if (!moved) model.set('weights', weights);
  const map = moved ? await getFloor() : null;
  if (moved && map.layout !== weights.layout) return load();
  const [site, tables, laid, tunings, { facts }] = await rest;
  model.set('facts', facts);
  model.set('laid', laid);
  model.set('tunings', tunings);
  model.set('site', site);
  model.set('tables', tables);
  if (moved) {
    model.set('preview', null);
    model.weights = null;
    model.set('map', map);
    model.set('weights', weights);
  }
  model.set('generation', weights.generation);
  await way;
  return undefined;
}
