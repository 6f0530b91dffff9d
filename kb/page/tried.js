/** What edits would change, as the service finds it out: with what becomes of the way that is looked at. */

import { post } from './api.js';
import { model } from './model.js';

/** @param {Object[]} edits @param {Object} [more] of the question @param {Object} [options] of the request */
export function previewOf(edits, more = {}, options = {}) {
  const { start, goal, robot } = model.ask;
  return post('/api/preview', { edits, ...(start && goal ? { start, goal } : {}), ...(robot ? { robot } : {}), ...more }, options);
}
