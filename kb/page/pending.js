/** Cells that were edited and are not saved yet. */

import { model } from './model.js';

/** How a cell is named among the pending ones. */
export const cellId = (table, key, column) => JSON.stringify([table, key, column]);

const same = (a, b) => a === b || (a === null && b === '') || (a === '' && b === null);

/** Edits one cell; back at its old value it is no edit. @param {Object} cell table, key, column, old, value, wrong */
export function editCell(cell) {
  const id = cellId(cell.table, cell.key, cell.column);
  const pending = new Map(model.pending);
  const old = pending.has(id) ? pending.get(id).old : cell.old;
  if (!cell.wrong && same(cell.value, old)) pending.delete(id);
  else pending.set(id, { ...cell, old });
  model.set('pending', pending);
}

/** Takes edits back; all of them where none is named. */
export function discard(id) {
  const pending = new Map(id ? model.pending : []);
  if (id) pending.delete(id);
  model.set('pending', pending);
}

/** The pending cells as edits that the service understands. */
export function edits(withOld) {
  return [...model.pending.values()].filter((cell) => !cell.wrong).map(({ table, key, column, old, value }) => (
    withOld ? { kind: 'set', table, key, column, value, old } : { kind: 'set', table, key, column, value }));
}

/** A row's key without the robot where there is but one: `SQUAT`. */
export function keyName(key) {
  const robots = model.site?.robots ?? [];
  return robots.length === 1 && key.startsWith(`${robots[0]}/`) ? key.slice(robots[0].length + 1) : key;
}
