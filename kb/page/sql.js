/** SQL: ask, look, take the answer along, share the question. */

import { call, get, path, post } from './api.js';
import { button, byId, copy, download, el, fill, form, grid, sure } from './dom.js';
import { editor } from './editor.js';
import { exact, number } from './format.js';
import { by } from './history-words.js';
import { model } from './model.js';
import { said } from './notice.js';
import { address, onTab, remember } from './router.js';

const CONCLUDED = 'SELECT object, property, value, rule\nFROM conclusions\nORDER BY object, property\nLIMIT 100;';
const FIRST = 'SELECT step, kind, place, action, hardness, cost\nFROM action_sequence\nWHERE start = \'START\' AND goal = \'GOAL\'\nORDER BY step;';

let pane = null;
let began = false;

async function run() {
  const query = pane.text.trim();
  if (!query) return;
  remember('sql', { q: query });
  fill(byId('sql-answer'), el('p', { class: 'hint', text: 'Asking…' }));
  try {
    const answer = await post('/api/sql', { query });
    const note = `${answer.rows.length} row${answer.rows.length === 1 ? '' : 's'} in ${number(answer.took_ms)} ms, generation ${answer.generation}`;
    fill(byId('sql-answer'),
      el('p', { role: 'status', class: answer.truncated ? 'wrong' : 'hint', text: answer.truncated ? `${note}. There are more: these are the first; LIMIT and OFFSET show the others.` : note }),
      grid('Answer', answer.columns, answer.rows.map((row) => row.map((cell) => (cell === null ? '' : exact(cell)))), { class: 'rows' }),
      el('div', { class: 'buttons' }, button('Download CSV', () => take('csv', query)), button('Download JSON', () => take('json', query)),
        button('Copy link', (event) => copy(new URL(address('sql', { q: query }), location.href).href, event.target))));
  } catch (error) {
    fill(byId('sql-answer'), said(error));
  }
}

async function take(format, query) {
  try {
    const text = await call('GET', path('/api/sql', { query, format }), undefined, { text: true });
    download(`answer.${format}`, format === 'csv' ? 'text/csv' : 'application/json', text);
  } catch (error) {
    byId('sql-answer').append(said(error));
  }
}

async function saved() {
  try {
    const { queries } = await get('/api/queries');
    const item = ({ name, query, who }) => el('li', {}, button(name, () => { pane.show(query); return run(); }, { class: 'link', title: who ? by(who) : '' }),
      model.may('tune') ? button('Delete', () => forget(name), { class: 'quiet', 'aria-label': `Delete ${name}` }) : null);
    fill(byId('sql-saved'), queries.length ? el('ul', { class: 'plain saved-queries' }, ...queries.map(item)) : el('p', { class: 'hint', text: 'None yet.' }));
  } catch (error) {
    fill(byId('sql-saved'), said(error));
  }
}

async function keep() {
  const name = byId('query-name').value.trim();
  if (!name || !pane.text.trim()) return;
  try {
    await call('PUT', `/api/queries/${encodeURIComponent(name)}`, { query: pane.text });
    byId('query-name').value = '';
    await saved();
  } catch (error) {
    byId('sql-saved').append(said(error));
  }
}

async function forget(name) {
  if (!await sure(`Delete the query ${name}? It cannot be brought back.`, 'Delete it')) return;
  try {
    await call('DELETE', `/api/queries/${encodeURIComponent(name)}`);
  } catch (error) {
    byId('sql-saved').append(said(error));
    return;
  }
  await saved();
}

async function schema() {
  try {
    const { tables } = await get('/api/schema');
    fill(byId('sql-schema'), ...tables.map(({ name, kind, columns }) => el('details', {}, el('summary', {}, name, el('small', { text: ` ${kind}` })),
      el('div', { class: 'names' }, button(name, () => pane.insert(name), { class: 'link' }), ...columns.map((column) => button(column, () => pane.insert(column), { class: 'link' }))))));
  } catch (error) {
    fill(byId('sql-schema'), said(error));
  }
}

function show(params) {
  const query = params.get('q');
  if (query && query !== pane.text.trim()) pane.show(query);
  else if (!began && !pane.text) {
    const quoted = (text) => text.replaceAll("'", "''");
    if (model.site.rooms_mode === 'none' && !model.site.layout_kind) pane.show(CONCLUDED);
    else pane.show(FIRST.replace('START', quoted(model.ask.start || 'home')).replace('GOAL', quoted(model.ask.goal || 'a')));
  }
  if (!began) {
    schema();
    saved();
  }
  began = true;
  // A shared link shows its answer; it can only read.
  if (query) run();
}

/** Makes the tab. */
export function startSql() {
  pane = editor({ label: 'Query', language: 'sql', changed: () => {}, numbers: false, rows: 7 });
  pane.area.addEventListener('keydown', (event) => {
    if ((event.ctrlKey || event.metaKey) && event.key === 'Enter') {
      event.preventDefault();
      run();
    }
  });
  const keeper = form({ class: 'line-form' }, keep, el('label', {}, 'Save as ', el('input', { id: 'query-name' })), el('button', { type: 'submit', text: 'Save the query' }));
  fill(byId('sql'), el('div', { class: 'sql-columns' },
    el('div', {}, el('div', { class: 'card' }, pane.node, el('div', { class: 'buttons' }, button('Run', run, { id: 'sql-run', class: 'strong' }), el('span', { class: 'hint', text: 'Ctrl-Enter runs it. It only reads.' })), keeper), el('div', { class: 'card', id: 'sql-answer', 'aria-label': 'Answer' }, el('p', { class: 'hint', text: 'The answer comes here.' }))),
    el('div', {}, el('div', { class: 'card' }, el('h2', { text: 'Saved queries' }), el('div', { id: 'sql-saved' })), el('div', { class: 'card' }, el('h2', { text: 'Tables and views' }), el('p', { class: 'hint', text: 'A name that is pressed goes into the query.' }), el('div', { id: 'sql-schema' })))));
  onTab('sql', show);
}
