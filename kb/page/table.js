/** The tables beside the map. A cell that is edited shows old and new until it is saved. */

import { field, goDown, isOfAll, parse, titleOf } from './cells.js';
import { byId, el, fill, keep } from './dom.js';
import { exact, number, value as inWords } from './format.js';
import { asMatrix, matrix, matrixChoice } from './matrix.js';
import { model } from './model.js';
import { cellId, discard, editCell, keyName, put } from './pending.js';
import { isGoing, newRow, newRows, rowForms } from './rows.js';
import { fileForms } from './table-file.js';
import { inTuning } from './tunings.js';

const MOST_ROWS = 200;
/** Units that a column is named after. */
const UNITS = { s: 'seconds', J: 'joules', m: 'metres' };

/** What is shown: by table, its structure as text and its cells. */
const views = new Map();

function structure(table) {
  return JSON.stringify([table.columns, table.keys, (table.concluded ?? []).map(({ property }) => property), model.may('tune'), model.ask.robot, asMatrix(table, columnsOf(table), rowsOf(table))]);
}

// Of a fleet, the rows of the robot whose way is asked: the others only take room.
function rowsOf(table) {
  const robot = table.columns.findIndex(({ name, key }) => name === 'robot' && key);
  const all = table.keys.map((key, at) => ({ key, at }));
  return robot < 0 || !model.ask.robot ? all : all.filter(({ at }) => table.rows[at][robot] === model.ask.robot);
}

// The order of rows is no number to tune, and columns in which nothing stands only take room.
function columnsOf(table) {
  const names = table.columns.map((column, index) => ({ ...column, index }));
  const used = ({ index, required }) => required || Boolean(model.site.layout_kind) || rowsOf(table).some(({ at }) => table.rows[at][index] !== null);
  const oneRobot = (column) => column.key && column.name === 'robot' && table.columns.filter(({ key }) => key).length > 1 && new Set(rowsOf(table).map(({ at }) => table.rows[at][column.index])).size <= 1;
  return names.filter((column) => used(column) && !oneRobot(column) && !(table.table === 'robots' && column.name === 'position'));
}

function build(table, open) {
  const columns = columnsOf(table);
  const wanted = rowsOf(table);
  const as = asMatrix(table, columns, wanted);
  const cells = new Map();
  const cellOf = ({ key, at }, column) => {
    const cell = makeCell(table, key, column, table.rows[at][column.index]);
    cells.set(cellId(table.table, key, column.name), { ...cell, at, key, column });
    return cell.td;
  };
  const shape = as ? matrix(table, as, wanted, cellOf) : list(table, columns, wanted, cellOf);
  const title = titleOf(table.table);
  const more = !as && wanted.length > MOST_ROWS ? el('p', { class: 'hint', text: `The first ${MOST_ROWS} of ${wanted.length} rows; SQL shows all.` }) : null;
  const empty = as || wanted.length ? null : el('p', { class: 'hint', text: 'Nothing is said here.' });
  const node = el('details', { open, 'data-table': table.table }, el('summary', { text: title }), matrixChoice(table, columns, wanted, tables), el('div', { class: 'scroll' }, shape.node), more, empty, model.may('tune') ? rowForms(table, columns) : null, fileForms(table));
  return { results: [], unmade: [], ...shape, node, cells, structure: structure(table), table, columns, shown: new Map() };
}

function list(table, columns, wanted, cellOf) {
  const results = [];
  const concluded = isOfAll(table.table) ? [] : table.concluded ?? [];
  const head = el('tr', {}, ...columns.map(({ name, unit, kind, key }) => el('th', { scope: 'col', class: key ? null : kind }, name.replaceAll('_', ' '), unit && UNITS[unit] !== name ? el('small', { text: ` ${unit}` }) : null)), ...concluded.map(({ property }) => el('th', { scope: 'col', class: 'concluded', text: property.replaceAll('_', ' ') })));
  const result = (at, property) => {
    const td = el('td', { class: 'concluded' });
    results.push({ td, at, property });
    return td;
  };
  const rows = wanted.slice(0, MOST_ROWS).map((of) => el('tr', { 'data-key': of.key }, ...columns.map((column) => (column.key ? el('th', { scope: 'row', text: String(table.rows[of.at][column.index]) }) : cellOf(of, column))),
    ...concluded.map(({ property }) => result(of.at, property))));
  const coming = el('tbody');
  return { node: el('table', { class: 'tuned' }, el('caption', { class: 'unseen', text: titleOf(table.table) }), el('thead', {}, head), el('tbody', {}, ...rows), coming), rows, coming, results };
}

function makeCell(table, key, column, value) {
  const label = `${column.name} of ${keyName(key)}`;
  const struck = el('s', { class: 'old', hidden: true });
  const note = el('span', { class: 'note', role: 'status', hidden: true });
  const force = el('span', { class: 'force', hidden: true });
  const input = field(column, label, value);
  const cell = { td: el('td', { class: column.kind }, struck, input, note, force), input, struck, note, force, value };
  // What waited when somebody came here, unless it was saved or discarded since.
  let before;
  const goBack = () => {
    const id = waitsAs(table.table, key, column.name);
    return before && model.pending.has(id) ? put(id, before) : discard(id);
  };
  const read = () => {
    if (!model.pending.has(waitsAs(table.table, key, column.name))) before = undefined;
    // What a tuning no longer says is as the tables have it.
    const typed = parse(input.value, model.editIn ? { ...column, required: false } : column);
    editCell({ table: table.table, key, column: column.name, old: views.get(table.table).cells.get(cellId(table.table, key, column.name)).value, ...typed, ...(model.editIn ? { tuning: model.editIn } : {}) });
  };
  input.addEventListener('input', read);
  input.addEventListener('focus', () => {
    const waiting = model.pending.get(waitsAs(table.table, key, column.name));
    before = waiting?.wrong ? undefined : waiting;
  });
  input.addEventListener('keydown', (event) => {
    if (event.key === 'Escape') goBack();
    if (event.key === 'Enter' && !event.ctrlKey && !event.metaKey && !event.isComposing) goDown(event);
  });
  return cell;
}

/** How an edit of a cell waits: in the tables, or in the tuning that is edited. */
const waitsAs = (table, key, column) => cellId(table, key, column, model.editIn);

function update(table) {
  const view = views.get(table.table);
  for (const cell of view.cells.values()) {
    const { key, column } = cell;
    const base = table.rows[cell.at][column.index];
    const now = inTuning(table.table, key, column.name) ?? base;
    cell.value = now;
    cell.td.classList.toggle('tuned-otherwise', now !== base);
    if (!model.pending.has(waitsAs(table.table, key, column.name)) && document.activeElement !== cell.input) cell.input.value = exact(now);
  }
  const said = new Map((table.concluded ?? []).map(({ property, values }) => [property, values]));
  for (const { td, at, property } of view.results) {
    const of = said.get(property)?.[at];
    td.textContent = typeof of === 'number' ? number(of) : inWords(of);
  }
  const marks = new Map((table.overridden ?? []).map((mark) => [cellId(table.table, mark.key, mark.column), mark]));
  for (const [id, cell] of view.cells) {
    const mark = marks.get(id);
    const words = mark ? `${inWords(mark.value)} counts: ${mark.tuning} is on` : '';
    cell.td.classList.toggle('overridden', Boolean(mark));
    cell.force.hidden = !mark || mark.tuning === model.editIn;
    if (cell.force.textContent !== words) cell.force.textContent = words;
  }
}

function tables() {
  // Without a map there is no robot: its tables are empty, and only take room.
  const present = model.tables.tables.filter(({ table, rows }) => model.site.rooms_mode !== 'none' || rows.length || !isOfAll(table));
  const names = new Set(present.map(({ table }) => table));
  for (const name of [...views.keys()]) if (!names.has(name)) views.delete(name);
  let anew = views.size !== present.length;
  for (const table of present) {
    const known = views.get(table.table);
    if (known?.structure !== structure(table)) {
      views.set(table.table, build(table, known?.node.open ?? table === present[0]));
      anew = true;
    }
    update(table);
  }
  if (anew) replaceTables(present.map(({ table }) => views.get(table).node));
  byId('tables-title').hidden = present.length === 1;
  marks();
}

// Who is in a field of a table that is made anew goes on in the field that takes its place.
function replaceTables(nodes) {
  const { activeElement: had } = document;
  const [of, label] = [had.closest('#tables [data-table]')?.dataset.table, had.getAttribute('aria-label')];
  fill(byId('tables'), ...nodes);
  if (!of || !label) return;
  const heir = had.isConnected ? had : nodes.find((node) => node.dataset.table === of)?.querySelector(`[aria-label="${CSS.escape(label)}"]`);
  heir?.focus({ preventScroll: true });
}

// A row that comes stays the same element as long as it waits: somebody may be typing in it.
function markComing({ table, columns, coming, shown }) {
  const wanted = new Map(newRows(table.table).map((of) => [JSON.stringify([of[0], of[1]]), of]));
  for (const id of [...shown.keys()]) if (!wanted.has(id)) shown.delete(id);
  for (const [id, of] of wanted) if (!shown.has(id)) shown.set(id, newRow(table, columns, of));
  keep(coming, [...shown.values()]);
}

function markRows(view) {
  const { table, rows, coming, unmade } = view;
  if (coming) markComing(view);
  for (const { mark } of unmade) mark();
  for (const row of rows) {
    const going = isGoing(table.table, row.dataset.key);
    row.classList.toggle('going', going);
    for (const input of row.querySelectorAll('input, select')) input.disabled = going || !model.may('tune');
  }
}

/** Shows which cells are edited, old struck through, new beside it; and which rows come and go. */
function marks() {
  for (const view of views.values()) {
    markRows(view);
    for (const cell of view.cells.values()) {
      const pending = model.pending.get(waitsAs(view.table.table, cell.key, cell.column.name));
      cell.td.classList.toggle('edited', Boolean(pending));
      cell.struck.hidden = !pending;
      cell.struck.textContent = pending ? inWords(pending.old) : '';
      // Somebody else has edited it since.
      const moved = Boolean(pending) && pending.old !== cell.value;
      cell.td.classList.toggle('moved', moved);
      cell.note.hidden = !moved && !pending?.wrong;
      cell.note.textContent = moved ? `meanwhile ${inWords(cell.value)}` : pending?.wrong ?? '';
      cell.input.toggleAttribute('aria-invalid', Boolean(pending?.wrong));
      const shownAs = pending ? exact(pending.value) : exact(cell.value);
      // While somebody types, `2.` must not become `2` under the hand.
      if (parse(cell.input.value, cell.column).value !== (pending ? pending.value : cell.value)) cell.input.value = shownAs;
    }
  }
}

// A state that comes is a row and a column of the matrix.
function waited() {
  const [view, table] = [views.get('changes'), model.table('changes')];
  if (view && table && view.structure !== structure(table)) tables();
  else marks();
}

/** Shows the tables and keeps them up to date. */
export function startTables() {
  model.on('tables tunings editIn ask', () => { if (model.tables) tables(); });
  model.on('pending', waited);
}
