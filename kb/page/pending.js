/** What was edited and is not saved yet: cells, rows, and what is drawn on the map. It is previewed and saved together. */

import { model } from './model.js';
import { banner } from './notice.js';

/** How a cell is named among what is pending. */
export const cellId = (table, key, column, tuning) => JSON.stringify(tuning ? [table, key, column, tuning] : [table, key, column]);

const same = (a, b) => a === b || (a === null && b === '') || (a === '' && b === null);

/** Edits one cell; back at its old value it is no edit. @param {Object} cell table, key, column, old, value, wrong; tuning, where it is of one */
export function editCell(cell) {
  const id = cellId(cell.table, cell.key, cell.column, cell.tuning);
  const pending = new Map(model.pending);
  const old = pending.has(id) ? pending.get(id).old : cell.old;
  if (!cell.wrong && same(cell.value, old)) pending.delete(id);
  else pending.set(id, { ...cell, old });
  model.set('pending', pending);
}

/**
 * Takes up what is no cell, in place of what has this name.
 * @param {Object} item `words` for people, `edits` for the service; `wrong` as long as it cannot be saved, `shape` where it is drawn
 */
export function put(id, item) {
  model.set('pending', new Map(model.pending).set(id, item));
}

/** Takes edits back; all of them where none is named. */
export function discard(id) {
  const pending = new Map(id ? model.pending : []);
  if (id) pending.delete(id);
  model.set('pending', pending);
}

/** The pending cells, each with its name. */
export const cells = () => [...model.pending].filter(([, item]) => item.column !== undefined);

function set({ table, key, column, old, value, tuning }, withOld) {
  if (!tuning) return { kind: 'set', table, key, column, value, ...(withOld ? { old } : {}) };
  return value === null ? { kind: 'unset_in_tuning', tuning, table, key, column } : { kind: 'set_in_tuning', tuning, table, key, column, value };
}

/** What is pending as edits that the service understands. */
export function edits(withOld) {
  const items = [...model.pending.values()].filter((item) => !item.wrong);
  // A table is as its file has it before its cells are set.
  const isFile = (item) => item.edits?.some(({ kind }) => kind === 'take');
  const files = items.filter(isFile);
  const taken = new Set(files.flatMap((item) => item.edits.map(({ table }) => table)));
  const others = items.filter((item) => !isFile(item)).flatMap((item) => item.edits ?? [set(item, withOld && !taken.has(item.table))]);
  const wanted = files.flatMap((item) => item.edits.map(({ version, ...edit }) => (withOld ? { ...edit, version } : edit)));
  return [...wanted, ...others];
}

/** A row's key without the robot where there is but one: `SQUAT`. */
export function keyName(key) {
  const robots = model.site?.robots ?? [];
  return robots.length === 1 && key.startsWith(`${robots[0]}/`) ? key.slice(robots[0].length + 1) : key;
}

const KEPT = 'adit-pending';

// Nobody holds the pen any more.
const putDown = ([id, item]) => [id, item.shape ? { ...item, shape: { ...item.shape, open: false } } : item];

/** Takes edits up again, beside what waits by now. */
export function restore(items) {
  model.set('pending', new Map([...[...items].map(putDown), ...model.pending]));
}

/** Keeps it over a reload of the page, for this site and this tab of the browser. */
export function keepPending() {
  try {
    const { site, items } = JSON.parse(sessionStorage.getItem(KEPT) ?? '{}');
    if (site === model.site.name && items?.length) model.set('pending', new Map(items.map(putDown)));
  } catch {
    sessionStorage.removeItem(KEPT);
  }
  let wasKept = true;
  model.on('pending', () => {
    const items = [...model.pending];
    // What is too large to keep is there until the page is closed or loaded again.
    let isKept = true;
    sessionStorage.removeItem(KEPT);
    try {
      if (items.length) sessionStorage.setItem(KEPT, JSON.stringify({ site: model.site.name, items }));
    } catch {
      isKept = false;
    }
    if (wasKept === isKept) return;
    wasKept = isKept;
    banner('kept', isKept ? null : 'What waits is too large to outlive a reload of this page: save it, or drop some of it.');
  });
}
