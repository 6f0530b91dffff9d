/** What an entry of the history says, in the words that the page has for such things. */

import { titleOf } from './cells.js';
import { inWords } from './difference.js';
import { count, list, value } from './format.js';
import { describe } from './laid.js';
import { keyName } from './pending.js';

/** A row that came or went, which the history keeps as an object; null where it is none. */
export function rowOf(of) {
  if (typeof of !== 'string' || !of.startsWith('{')) return of !== null && typeof of === 'object' ? of : null;
  try {
    return JSON.parse(of);
  } catch {
    return null;
  }
}

const plain = (of) => value(of).replaceAll('_', ' ');

/** Who edits without a name, by where that is done. */
const PLACES = { page: 'on the page', cli: 'on the command line', http: 'by a program' };

/** Who did something, in words: a name, or where it was done. */
export const author = (who) => (Object.hasOwn(PLACES, who ?? '') ? PLACES[who] : who ?? '');

/** As {@link author}, behind what was done: `by Anna`, `on the page`. */
export const by = (who) => (Object.hasOwn(PLACES, who) ? PLACES[who] : `by ${who}`);

/** A fact: `doorway at 5.9,3.5 closed: yes`. */
export function fact(row) {
  const what = row.class.toLowerCase().replaceAll('_', ' ').replace(/s$/, '');
  const point = row.key ? /^-?[\d.]+,-?[\d.]+$/.exec(row.key)?.[0] : `${row.x},${row.y}`;
  const object = point ? `at ${point}` : row.key;
  const said = row.kind === 'truth' ? value(Boolean(Number(row.value))) : value(row.value);
  return `${String(object).startsWith(what) ? '' : `${what} `}${object} ${plain(row.property)}: ${said}`;
}

const tuningCell = ({ tuning, key, column_name: column }) => `Tuning “${tuning}”: ${keyName(key)} ${plain(column)}`;

function cellOfTuning(entry) {
  const [tuning, , ...rest] = entry.key.split('/');
  return tuningCell({ tuning, key: rest.slice(0, -1).join('/'), column_name: rest.at(-1) });
}

/** By table: what is said of a row that came, and of one that went. */
const ROWS = {
  told: [(row) => `Told: ${fact(row)}`, (row) => `No longer told: ${fact(row)}`],
  laid: [(row) => `New on the map: ${describe(row)}`, (row) => `Taken away: ${describe(row)}`],
  active_tunings: [({ tuning }) => `Tuning “${tuning}” on`, ({ tuning }) => `Tuning “${tuning}” off`],
  tuning_cells: [(row) => `${tuningCell(row)} ${value(row.value)}`, (row) => `${tuningCell(row)} as in the tables`],
};

/** `The rule file doors.rhai: 2 lines more`. */
function ofFile({ key, old, new: now }) {
  const [was, is] = [old, now].map((text) => (typeof text === 'string' ? text : null));
  return `Rule file ${key}: ${was === null ? 'new' : is === null ? 'deleted' : inWords(was, is)}`;
}

/** Whether an entry is about a rule file. */
export const isFile = ({ table }) => table === 'rule files';

/** An entry in words. */
export function words(entry) {
  if (isFile(entry)) return ofFile(entry);
  const [was, is] = [rowOf(entry.old), rowOf(entry.new)];
  if (!was && !is) {
    const what = entry.table === 'tuning_cells' ? cellOfTuning(entry) : `${titleOf(entry.table)}, ${keyName(entry.key)}${entry.column ? ` ${plain(entry.column)}` : ''}`;
    return `${what} ${value(entry.old)} → ${value(entry.new)}`;
  }
  const [comes, goes] = ROWS[entry.table] ?? [() => `New in ${titleOf(entry.table)}: ${keyName(entry.key)}`, () => `Gone from ${titleOf(entry.table)}: ${keyName(entry.key)}`];
  return is ? comes(is) : goes(was);
}

const NOUNS = { told: 'fact', active_tunings: 'tuning', tuning_cells: 'tuned cell' };

function nounOf(entry) {
  if (isFile(entry)) return 'rule file';
  const laid = entry.table === 'laid' && (rowOf(entry.new) ?? rowOf(entry.old));
  if (laid) return laid.what === 'door' ? 'doorway' : laid.what;
  return NOUNS[entry.table] ?? (entry.column ? 'cell' : 'row');
}

/** What was done in one go, by kinds: `3 cells, an area and a rule file`. What is moved or changed goes and comes, and is one. */
export function kinds(entries) {
  const things = new Map(entries.map((entry) => [JSON.stringify([entry.table, entry.key, entry.column]), nounOf(entry)]));
  if (things.size === 1 && entries[0].table === 'laid') return `moved or changed: ${describe(rowOf(entries[0].new) ?? rowOf(entries[0].old))}`;
  const counts = new Map();
  for (const noun of things.values()) counts.set(noun, (counts.get(noun) ?? 0) + 1);
  return list([...counts].map(([noun, n]) => (n > 1 ? count(n, noun) : `${/^[aeiou]/.test(noun) ? 'an' : 'a'} ${noun}`)));
}
