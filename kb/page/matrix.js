/** The changes of shape as a matrix: a row for each state that is left, a column for each that is taken, in the cells what that takes. */

import { field, goDown, parse, titleOf } from './cells.js';
import { el } from './dom.js';
import { exact } from './format.js';
import { model } from './model.js';
import { discard, keyName, put } from './pending.js';
import { addRow, keyParts, newRows, typeInto } from './rows.js';

const KEPT = 'adit-changes';
const LIST = 'list';
/** Beyond it a matrix is no overview any more. */
const MOST_STATES = 24;

const keysOf = (table) => table.columns.filter(({ key }) => key).map(({ name }) => name);
const hasPairs = (table) => table.table === 'changes' && keysOf(table).filter((name) => name !== 'robot').join() === 'from_state,to_state';
const robotOf = () => model.ask.robot || model.site.robots[0];

/** The states of the robot that may change, those that come at the end. */
function statesOf(table, rows) {
  const pairs = rows.map(({ key }) => keyParts(table, { key }));
  const used = new Set(pairs.flatMap((of) => [of.from_state, of.to_state]));
  const robots = model.table('robots');
  const moves = robots.concluded?.find(({ property }) => property === 'moves')?.values;
  const own = robots.keys.map((key, at) => ({ ...keyParts(robots, { key }), at })).filter(({ robot }) => robot === robotOf());
  const coming = newRows('robots').map(([,, row]) => keyParts(robots, row)).filter(({ robot }) => robot === robotOf());
  const there = own.filter(({ state, at }) => used.has(state) || moves?.[at] !== false);
  return [...new Set([...there, ...coming].map(({ state }) => state).concat([...used]))];
}

const pair = (from, to) => ({ robot: robotOf(), from_state: from, to_state: to });
const keyOf = (table, cells) => keysOf(table).map((name) => cells[name]).join('/');

/** What a matrix may show of these rows: the columns that are no key, the states, and those of which a change to themselves is said. */
function offered(table, columns, rows) {
  if (!hasPairs(table)) return null;
  const states = statesOf(table, rows);
  const said = new Set([...rows.map(({ key }) => key), ...newRows(table.table).map(([,, row]) => row.key)]);
  const turns = states.filter((state) => said.has(keyOf(table, pair(state, state))));
  if (states.length > MOST_STATES) return null;
  // A row that has no place in it is not to be lost: a name with a slash, say.
  const places = new Set(states.flatMap((from) => states.map((to) => keyOf(table, pair(from, to)))));
  return rows.every(({ key }) => places.has(key)) && (states.length > 1 || turns.length) ? { of: columns.filter(({ key }) => !key), states, turns } : null;
}

/** The table as a matrix: of which column, with which states; null where it is a list. `columns` are those that are shown. */
export function asMatrix(table, columns, rows) {
  const { of, states, turns } = offered(table, columns, rows) ?? { of: [] };
  const chosen = localStorage.getItem(KEPT);
  const usual = of.length === 1 && of[0].name === 'hardness' ? of[0] : undefined;
  const column = chosen === LIST ? undefined : of.find(({ name }) => name === chosen) ?? usual;
  return column ? { column, states, turns } : null;
}

/** The choice between the list and the matrix; nothing where there is none. `changed` shows what is chosen. */
export function matrixChoice(table, columns, rows, changed) {
  const { of } = offered(table, columns, rows) ?? { of: [] };
  if (!of.length) return null;
  const words = ({ name }) => (of.length === 1 ? 'as a matrix' : `${name} as a matrix`);
  const made = el('select', { 'aria-label': `How ${titleOf(table.table)} are shown` }, el('option', { value: LIST, text: 'as a list' }), ...of.map((column) => el('option', { value: column.name, text: words(column) })));
  made.value = asMatrix(table, columns, rows)?.column.name ?? LIST;
  made.addEventListener('change', () => {
    localStorage.setItem(KEPT, made.value);
    changed();
  });
  return el('div', { class: 'shown-as' }, made);
}

/**
 * The table as a matrix. `makeCell` makes the cell of a row that is there.
 * @returns what is shown, the cells of rows that are there, and those of rows that are not
 */
export function matrix(table, { column, states, turns }, rows, makeCell) {
  const known = new Map(rows.map((row) => [row.key, row]));
  const made = { rows: [], unmade: [] };
  const cell = (from, to) => {
    const cells = pair(from, to);
    const key = keyOf(table, cells);
    if (from === to && !turns.includes(from)) return el('td', { class: 'same' });
    const of = known.has(key) ? { td: makeCell(known.get(key), column) } : unmade(table, key, cells, column);
    of.td.dataset.key = key;
    (known.has(key) ? made.rows : made.unmade).push(known.has(key) ? of.td : of);
    return of.td;
  };
  const coming = new Set(newRows('robots').map(([,, row]) => keyParts(model.table('robots'), row)).filter(({ robot }) => robot === robotOf()).map(({ state }) => state));
  const head = el('tr', {}, el('th', { scope: 'col' }, 'from ↓', el('br'), 'to →'), ...states.map((to) => el('th', { scope: 'col', class: coming.has(to) ? 'new' : null, text: to })));
  const body = states.map((from) => el('tr', { class: coming.has(from) ? 'new' : null }, el('th', { scope: 'row', text: from }), ...states.map((to) => cell(from, to))));
  const caption = el('caption', { class: 'unseen', text: `${titleOf(table.table)}: ${column.name}, from the state of a row to that of a column` });
  return { ...made, node: el('table', { class: 'tuned matrix' }, caption, el('thead', {}, head), el('tbody', {}, ...body)) };
}

/** The row for this pair that comes, where one does: what it waits under, where it stands there, and the row. */
const waitingFor = (table, key) => newRows(table.table).find(([,, row]) => row.key === key);

// Nothing else comes with it, and nothing else is said in it: without its value it does not come either.
const isAlone = ([id,, row], { name }) => model.pending.get(id).rows.length === 1 && Object.entries(row.cells).every(([of, value]) => of === name || (value ?? '') === '');

/** A cell of a change of which nothing is said: what is typed there makes a row of it. */
function unmade(table, key, cells, column) {
  const input = field(column, `${column.name} of ${keyName(key)}`, null);
  input.placeholder = '–';
  const note = el('span', { class: 'note', role: 'status', hidden: true });
  const td = el('td', { class: column.kind }, input, note);
  let before;
  const read = () => {
    const waiting = waitingFor(table, key);
    if (input.value.trim() === '' && (!waiting || isAlone(waiting, column))) return waiting && discard(waiting[0]);
    if (!waiting) addRow(table, { ...cells, [column.name]: parse(input.value, column).value }, '');
    return typeInto(waitingFor(table, key), column, input.value);
  };
  const goBack = () => {
    const waiting = waitingFor(table, key);
    if (!waiting) return undefined;
    return before ? put(waiting[0], before) : discard(waiting[0]);
  };
  input.addEventListener('input', read);
  input.addEventListener('focus', () => {
    const item = model.pending.get(waitingFor(table, key)?.[0]);
    before = item?.wrong ? undefined : item;
  });
  input.addEventListener('keydown', (event) => {
    if (event.key === 'Escape') goBack();
    if (event.key === 'Enter' && !event.ctrlKey && !event.metaKey && !event.isComposing) goDown(event);
  });
  const mark = () => {
    const [,, row] = waitingFor(table, key) ?? [];
    for (const name of ['new', 'edited']) td.classList.toggle(name, Boolean(row));
    const wrong = row?.wrong?.startsWith(`${column.name} `) ? row.wrong.slice(column.name.length + 1) : '';
    input.toggleAttribute('aria-invalid', Boolean(wrong));
    note.hidden = !wrong;
    note.textContent = wrong;
    // A tuning says other values of rows that are there.
    input.disabled = !model.may('tune') || Boolean(model.editIn && !row);
    input.title = row || input.disabled ? '' : 'Nothing is said of this change, so it costs nothing';
    if ((parse(input.value, column).value ?? '') !== (row?.cells[column.name] ?? '')) input.value = exact(row?.cells[column.name]);
  };
  return { td, mark };
}
