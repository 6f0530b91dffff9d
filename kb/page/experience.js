/** Tuning from experience: what robots measured on their ways, and the hardness that fits it best. */

import { call, get, path } from './api.js';
import { button, byId, el, fill, grid, refill, sure } from './dom.js';
import { asSentence, count, exact, number, value } from './format.js';
import { model } from './model.js';
import { said } from './notice.js';
import { cellId, editCell, keyName } from './pending.js';
import { onTab } from './router.js';

const EXAMPLE = 'mission,state,distance,measured\n1,STAND,12.5,13.1\n1,SQUAT,1.2,5.0';

/** Of what is fitted; none where there is but one measure. */
let wanted = '';
let choices = [];

async function add(text) {
  try {
    const answer = await call('POST', path('/api/traversals', { measure: byId('measure').value }), text, { type: 'text/csv' });
    fill(byId('experience-said'), el('p', { class: 'right', role: 'status', text: `${count(answer.added, 'row')} added, ${answer.total} in all.` }));
    byId('traversals').value = '';
    await load();
  } catch (error) {
    fill(byId('experience-said'), said(error));
  }
}

function cellOf({ table, key, column }) {
  const known = model.table(table);
  const at = known?.columns.findIndex(({ name }) => name === column) ?? -1;
  const row = known?.keys.indexOf(key) ?? -1;
  return at < 0 || row < 0 ? undefined : known.rows[row][at];
}

// As many digits as the interval's width allows to be meant.
function rounded(cell) {
  const width = Math.abs((cell.high ?? cell.proposed) - (cell.low ?? cell.proposed)) || Math.abs(cell.proposed) || 1;
  const digits = Math.max(0, Math.min(6, 1 - Math.floor(Math.log10(width))));
  return Number(cell.proposed.toFixed(digits));
}

const known = (cell) => cell.proposed !== null && cell.proposed !== undefined;

const isTaken = ({ table, key, column }) => model.pending.has(cellId(table, key, column));

function takeButton(cell) {
  const taken = isTaken(cell);
  const old = cellOf(cell);
  if (!known(cell)) return '';
  if (old === rounded(cell)) return 'is so already';
  if (taken || old === undefined || !model.may('tune')) return taken ? 'taken, not saved' : '';
  return button(`Take ${rounded(cell)}`, () => {
    editCell({ table: cell.table, key: cell.key, column: cell.column, old, value: rounded(cell) });
    return load();
  }, { 'aria-label': `Take ${rounded(cell)} for ${cell.column} of ${keyName(cell.key)}` });
}

const measures = async () => [...new Set((await get('/api/traversals')).traversals.map(({ measure }) => measure))].sort();

// Where robots measured several things, one of them is fitted at a time.
function measureChoice() {
  if (!wanted) return null;
  const choice = el('select', { on: { change: () => { wanted = choice.value; return load(); } } }, ...choices.map((name) => el('option', { value: name, text: name, selected: name === wanted })));
  return el('label', {}, 'By what was measured in ', choice);
}

/** Whether another measure is fitted from now on. */
async function isMeasureChosen() {
  const was = wanted;
  choices = await measures();
  wanted = choices.length > 1 ? choices[0] : '';
  return wanted !== was;
}

async function load() {
  try {
    const fit = await get(path('/api/fit', { robot: model.ask.robot, measure: wanted }));
    const rows = fit.cells.map((cell) => [keyName(cell.key), cell.column, value(cell.present), el('b', { text: known(cell) ? exact(rounded(cell)) : 'cannot be estimated' }), cell.low === null ? '' : `${number(cell.low)} to ${number(cell.high)}`, String(cell.observations ?? ''), takeButton(cell)]);
    const notes = (fit.notes ?? []).map((note) => el('p', { class: 'hint', text: asSentence(note) }));
    const taken = fit.cells.filter(isTaken).length;
    const pending = taken ? el('p', {}, `${taken} taken. `, el('a', { href: '#map', text: 'See on the map what they would change, and save' })) : null;
    refill(byId('fit'), measureChoice(), fit.cells.length ? grid('Proposed values', ['of', 'what', 'now', 'proposed', '95 % between', 'from', ''], rows) : el('p', { class: 'hint', text: 'Nothing to propose yet.' }), ...notes, pending);
  } catch (error) {
    const isOther = error.code === 'fit/which-measure' || (wanted && error.code === 'fit/unknown-measure');
    if (isOther && await isMeasureChosen()) return load();
    fill(byId('fit'), said(error));
  }
  return undefined;
}

async function forget() {
  const { traversals } = await get('/api/traversals');
  // Robots measure meanwhile, so there may be some as soon as one looks.
  if (!traversals.length) return fill(byId('experience-said'), el('p', { role: 'status', text: 'No measurements are kept.' }));
  if (!await sure(`Delete all ${count(traversals.length, 'measurement')}? No route changes by that. They cannot be brought back.`, 'Delete them')) return undefined;
  try {
    await call('DELETE', '/api/traversals');
    fill(byId('experience-said'), el('p', { role: 'status', text: 'All measurements are deleted.' }));
  } catch (error) {
    fill(byId('experience-said'), said(error));
  }
  await load();
  return undefined;
}

function show() {
  if (!byId('traversals')) {
    const file = el('input', { type: 'file', id: 'traversals-file', accept: '.csv,text/csv' });
    file.addEventListener('change', async () => { if (file.files[0]) byId('traversals').value = await file.files[0].text(); });
    const measure = el('select', { id: 'measure' }, ...['seconds', 'joules'].map((name) => el('option', { value: name, text: name })));
    fill(byId('experience'),
      el('div', { class: 'card' }, el('h2', { text: 'What fits the measurements' }), el('div', { id: 'fit' })),
      model.may('tune') ? el('div', { class: 'card' }, el('h2', { text: 'Add measurements' }),
        el('p', { class: 'hint', text: 'One row for each stretch: its state or action, metres, and what was measured. Rows of one mission share its total.' }),
        el('label', {}, 'File (CSV) ', file), el('label', {}, 'or paste rows ', el('textarea', { id: 'traversals', rows: '6', placeholder: EXAMPLE })),
        el('label', {}, 'Measured in ', measure),
        el('div', { class: 'buttons' }, button('Add', () => add(byId('traversals').value), { id: 'traversals-add', class: 'strong' }), button('Delete all measurements', forget)),
        el('div', { id: 'experience-said' })) : null);
  }
  return load();
}

/** Makes the tab. */
export function startExperience() {
  onTab('experience', show);
}
