/** Decision tables of the open file as grids: what is given, what is set, and in their rows what is amiss. */

import { post } from './api.js';
import { button, debounced, el, fill } from './dom.js';
import { asSentence } from './format.js';

const WAIT = 300;

const HIT = {
  unique: 'No two rows may match together.',
  any: 'Rows that match together say the same.',
  first: 'The first row that matches counts.',
  priority: 'Of the rows that match the one with the best value counts.',
  'collect sum': 'What all rows that match say is added up.',
  'collect min': 'Of the rows that match the one with the least value counts.',
  'collect max': 'Of the rows that match the one with the greatest value counts.',
  'collect count': 'The rows that match are counted.',
};
const MARK = { overlap: 'overlaps', unreachable: 'never reached' };

let [box, shown, go] = [null, '', null];

function row(grid, { line, tests, outputs }, index) {
  const amiss = grid.amiss.filter(({ rows }) => rows.includes(index));
  const marks = [...new Set(amiss.map(({ what }) => MARK[what]))].filter(Boolean);
  const cells = tests.map((test) => el('td', { class: test === 'any' ? 'any' : null, text: test }));
  return el('tr', { class: amiss.length ? 'amiss' : null }, el('th', { scope: 'row' }, button(String(index + 1), () => go(line), { class: 'link', 'aria-label': `Row ${index + 1}, in line ${line}` }), marks.length ? el('span', { class: 'wrong', text: ` ${marks.join(', ')}` }) : null),
    ...cells, ...outputs.map((output, at) => el('td', { class: at ? null : 'first-output', text: output })));
}

// The service gives one example of what no row matches, of what may be a whole stretch: `is 50`.
const instance = (reads) => `for instance ${reads.replace(/^is /, '')}`;

// What no row matches stands as a row where one is missing.
function missing({ missing: example, set }) {
  if (!example) return null;
  const cells = example.map((reads) => el('td', { class: reads ? null : 'any', text: reads ? instance(reads) : 'any' }));
  return el('tr', { class: 'gap' }, el('th', { scope: 'row', text: 'no row' }), ...cells, el('td', { class: 'first-output', colspan: String(Math.max(1, set.length)), text: 'nothing is set' }));
}

function table(grid) {
  const { name, line, hit, given, set, rows, amiss } = grid;
  const outputs = hit === 'collect count' ? [] : set;
  const counted = hit === 'collect count' ? ` It sets ${set.join()}.` : '';
  const names = el('tr', {}, el('th', { scope: 'col' }, el('span', { class: 'unseen', text: 'row' })), ...given.map((text) => el('th', { scope: 'col' }, el('span', { class: 'unseen', text: 'given ' }), text)), ...outputs.map((text, at) => el('th', { scope: 'col', class: at ? null : 'first-output' }, el('span', { class: 'unseen', text: 'set ' }), text)));
  const groups = el('tr', { 'aria-hidden': 'true' }, el('td'), el('td', { colspan: String(given.length), text: 'given' }), outputs.length ? el('td', { class: 'first-output', colspan: String(outputs.length), text: 'set' }) : null);
  const made = el('table', { class: 'decisions' }, el('caption', { class: 'unseen', text: `Decision table ${name}` }), el('thead', {}, groups, names), el('tbody', {}, ...rows.map((of, index) => row({ amiss }, of, index)), missing({ ...grid, set: outputs })));
  const said = amiss.map(({ message, help }) => el('li', {}, asSentence(message), help ? el('span', { class: 'hint', text: ` ${asSentence(help)}` }) : null));
  return el('section', { class: 'card', 'aria-label': `Decision table ${name}` }, el('div', { class: 'file-head' }, el('h2', {}, name), button(`Line ${line}`, () => go(line), { class: 'link', 'aria-label': `Show ${name} in line ${line}` })),
    el('p', { class: 'hint', text: `${HIT[hit]}${counted}` }), el('div', { class: 'scroll', tabindex: '0', role: 'region', 'aria-label': `Rows of ${name}` }, made), said.length ? el('ul', { class: 'plain problems' }, ...said) : null);
}

async function ask(question) {
  try {
    const { tables } = await post('/api/rules/tables', question);
    // What does not read at the moment stays as it was.
    if (JSON.stringify(question) === shown && (tables.length || !question.text?.includes('table'))) fill(box, ...tables.map(table));
  } catch {
    fill(box);
  }
}
const later = debounced(ask, WAIT);

/** Shows the tables of a file: as it is saved, or of the text that is typed. */
export function showGrids(file, text) {
  const question = text === null ? { file } : { file, text };
  if (JSON.stringify(question) === shown) return;
  const isOther = !shown || JSON.parse(shown).file !== file;
  shown = JSON.stringify(question);
  if (!file.endsWith('.rhai') || file.startsWith('tests/')) return fill(box);
  if (!isOther) return later(question);
  later.cancel();
  fill(box);
  return ask(question);
}

/** Where they stand; `show` goes to a line of the file. */
export function startGrids(show) {
  go = show;
  box = el('div', { id: 'rules-tables' });
  return box;
}
