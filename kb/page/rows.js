/** Rows that come and go: a new one, as another one is and with all that names that one, or one that is taken away. */

import { field, parse, titleOf } from './cells.js';
import { el, fill, form } from './dom.js';
import { count, list, value as said } from './format.js';
import { model } from './model.js';
import { discard, keyName, put } from './pending.js';

const newId = (table, key) => `row:${table}/${key}`;
const goneId = (table, key) => `gone:${table}/${key}`;

/** Whether the row is to be taken away. */
export const isGoing = (table, key) => model.pending.has(goneId(table, key));

const index = (table, column) => table.columns.findIndex(({ name }) => name === column);

/** The rows of other tables that name a row, each with the columns that do, and the value of which column each holds. */
function naming(table, key) {
  const row = table.rows[table.keys.indexOf(key)] ?? [];
  return model.tables.tables.flatMap((other) => {
    const refers = other.refers.filter((to) => to.table === table.table);
    return other.keys.flatMap((of, at) => {
      const met = refers.filter(({ columns }) => columns.every(([own, its]) => other.rows[at][index(other, own)] === row[index(table, its)]));
      return met.length ? [{ table: other, key: of, at, columns: met.flatMap(({ columns }) => columns) }] : [];
    });
  });
}

const alongWith = (found) => {
  const tables = [...new Set(found.map(({ table }) => table))];
  return tables.length ? `, with ${list(tables.map((of) => `${count(found.filter(({ table }) => table === of).length, 'row')} of ${titleOf(of.table)}`))}` : '';
};

/** A row by its cells as they stand there, for the service. */
function rowOf(table, cells) {
  const keys = table.columns.filter(({ key }) => key).map(({ name }) => name);
  const others = table.columns.filter(({ key, name }) => !key && !isPlaced(table, name) && (cells[name] ?? null) !== null);
  const own = Object.fromEntries(others.map(({ name }) => [name, cells[name]]));
  return { table: table.table, key: keys.map((name) => cells[name]).join('/'), cells: own, began: own };
}

const cellsOf = (table, at) => Object.fromEntries(table.columns.map(({ name }, column) => [name, table.rows[at]?.[column] ?? null]));

// What was typed into a new row since it came.
function typed(rows) {
  const set = rows.map(({ cells, began }) => Object.entries(cells).filter(([name, value]) => began && value !== (began[name] ?? null)));
  const own = set[0].map(([name, value]) => `${name.replaceAll('_', ' ')} ${said(value)}`);
  const others = set.slice(1).filter((cells) => cells.length).length;
  return [...own, ...(others ? [`${count(others, 'more row')} with other values`] : [])];
}

/** `base` says which rows come; what is typed into them is said behind it. */
function item(base, rows) {
  const lacking = rows.flatMap((row) => model.table(row.table).columns.filter(({ key, required, name }) => !key && required && !isPlaced(row, name) && (row.cells[name] ?? '') === '').map(({ name }) => name.replaceAll('_', ' ')));
  const wrong = rows.map((row) => row.wrong).find(Boolean) ?? (lacking.length ? `needs ${list([...new Set(lacking)])}` : undefined);
  const other = typed(rows);
  return { words: other.length ? `${base}; ${list(other)}` : base, base, rows, wrong, edits: rows.map(({ table, key, cells }) => ({ kind: 'add', table, key, cells })) };
}

// The service puts a new state behind the others.
const isPlaced = ({ table }, name) => table === 'robots' && name === 'position';

/** Takes up a new row: its key's columns, others where they are known, and the key of the row that it is to be like. */
export function addRow(table, keys, from) {
  const at = table.keys.indexOf(from);
  const like = cellsOf(table, at);
  const row = rowOf(table, { ...like, ...keys });
  const also = at < 0 ? [] : naming(table, from).map(({ table: other, at: of, columns }) => rowOf(other, { ...cellsOf(other, of), ...Object.fromEntries(columns.map(([own, its]) => [own, keys[its] ?? like[its]])) }));
  const as = at < 0 ? '' : `, as ${keyName(from)}${alongWith(naming(table, from))}`;
  put(newId(table.table, row.key), item(`New in ${titleOf(table.table)}: ${keyName(row.key)}${as}`, [row, ...also]));
}

/** Has a row taken away with what is saved next. */
function removeRow(table, key) {
  for (const [id, { table: of, key: its }] of model.pending) if (of === table.table && its === key) discard(id);
  put(goneId(table.table, key), { words: `Gone from ${titleOf(table.table)}: ${keyName(key)}${alongWith(naming(table, key))}`, edits: [{ kind: 'remove', table: table.table, key }] });
}

/** What stands under a table: the forms by which a row comes or goes. `columns` are those that are shown. */
export function rowForms(table, columns) {
  const keys = table.columns.filter(({ key }) => key);
  const shown = keys.filter(({ name }) => columns.some((column) => column.name === name));
  const hidden = Object.fromEntries(keys.filter((key) => !shown.includes(key)).map(({ name }) => [name, model.ask.robot || model.site.robots[0]]));
  const all = () => table.keys.map((key) => el('option', { value: key, text: keyName(key) }));
  const like = el('select', {}, el('option', { value: '', text: 'nothing' }), ...all());
  const inputs = new Map(shown.map((column) => [column.name, choice(table, column)]));
  const add = form({ class: 'line-form' }, () => {
    const named = Object.fromEntries([...inputs].map(([name, input]) => [name, input.value.trim()]));
    // One that is like another one is of the same robot.
    addRow(table, like.value ? named : { ...hidden, ...named }, like.value);
    for (const input of inputs.values()) input.value = '';
  }, ...[...inputs].map(([name, input]) => el('label', {}, `New ${name.replaceAll('_', ' ')} `, input)), el('label', {}, 'like ', like), el('button', { type: 'submit', text: 'Add' }));
  const which = el('select', {}, ...all());
  const remove = form({ class: 'line-form' }, () => removeRow(table, which.value), el('label', {}, 'Row ', which), el('button', { type: 'submit', text: 'Remove' }));
  return el('details', { class: 'row-forms' }, el('summary', { text: 'Add or remove a row' }), add, table.keys.length ? remove : null);
}

// A key that names a row of another table is one of those that are there, or come.
function choice(table, { name, kind }) {
  const other = table.refers.find(({ columns }) => columns.some(([own]) => own === name));
  if (!other) return el('input', { required: true, size: kind === 'number' ? '5' : '12', spellcheck: 'false', autocomplete: 'off' });
  const [, its] = other.columns.find(([own]) => own === name);
  const of = model.table(other.table);
  const values = () => [...new Set([...of.rows.map((row) => row[index(of, its)]), ...newRows(other.table).map(([,, row]) => keyParts(of, row)[its])])];
  const made = el('select', { required: true });
  const offer = () => fill(made, ...values().map((value) => el('option', { value, text: value })));
  made.addEventListener('focus', () => { const before = made.value; offer(); if (before) made.value = before; });
  offer();
  return made;
}

/** What the columns of its key are in a row. */
export function keyParts(table, row) {
  const parts = row.key.split('/');
  return Object.fromEntries(table.columns.filter(({ key }) => key).map(({ name }, at) => [name, parts[at]]));
}

/** The rows that come to a table: of each what it waits under, where it stands there, and the row. */
export function newRows(name) {
  return [...model.pending].flatMap(([id, { rows }]) => (rows ?? []).flatMap((row, at) => (row.table === name ? [[id, at, row]] : [])));
}

/** Takes up what is typed into a cell of a row that comes; says what is wrong with it. */
export function typeInto([id, at], column, text) {
  const waiting = model.pending.get(id);
  const { value, wrong } = parse(text, column);
  const rows = waiting.rows.map((of, place) => (place === at ? { ...of, cells: { ...of.cells, [column.name]: value }, wrong: wrong && `${column.name} ${wrong}` } : of));
  put(id, item(waiting.base, rows));
  return wrong;
}

/** A new row among the others, whose cells may be set before it is saved. */
export function newRow(table, columns, [id, at, row]) {
  const parts = keyParts(table, row);
  return el('tr', { class: 'new' }, ...columns.map((column) => {
    if (column.key) return el('th', { scope: 'row', text: parts[column.name] });
    const input = field(column, `${column.name} of the new ${keyName(row.key)}`, row.cells[column.name]);
    input.addEventListener('input', () => input.toggleAttribute('aria-invalid', Boolean(typeInto([id, at], column, input.value))));
    return el('td', { class: `${column.kind} edited` }, input);
  }));
}
