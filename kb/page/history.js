/** Who changed what, when and why; each entry with its undo. */

import { get, path, post } from './api.js';
import { button, byId, el, fill, grid } from './dom.js';
import { moment, value } from './format.js';
import { model } from './model.js';
import { said } from './notice.js';
import { keyName } from './pending.js';
import { refresh } from './refresh.js';
import { isOpen, onTab } from './router.js';

const PAGE = 50;
let shown = PAGE;

const text = (of) => (of !== null && typeof of === 'object' ? JSON.stringify(of) : value(of));

function row(entry) {
  const what = `${entry.table} ${keyName(entry.key)}${entry.column ? ` ${entry.column}` : ''}`;
  const change = el('span', {}, el('s', { text: text(entry.old) }), ' → ', el('b', { text: text(entry.new) }));
  const undo = entry.undone ? el('span', { class: 'hint', text: 'taken back' })
    : model.may('tune') ? button('Undo', () => takeBack(entry.id), { 'aria-label': `Undo ${what}` }) : null;
  return [moment(entry.at), entry.who ?? '', what, change, entry.why ?? '', undo];
}

async function takeBack(edit) {
  try {
    const answer = await post('/api/edits', { edit: { kind: 'undo', edit } });
    await refresh(answer.generation);
    await load();
  } catch (error) {
    byId('history').prepend(said(error));
  }
}

async function load() {
  try {
    const { edits } = await get(path('/api/history', { limit: shown + 1 }));
    const more = edits.length > shown ? button('Show earlier ones', () => { shown += PAGE; return load(); }) : null;
    const none = el('p', { class: 'card', text: 'Nothing was edited yet. What is tuned on the map’s page is kept here, with who, when and why.' });
    fill(byId('history'), edits.length ? el('div', { class: 'card' }, grid('History', ['when', 'who', 'what', 'old → new', 'why', ''], edits.slice(0, shown).map(row)), more) : none);
  } catch (error) {
    fill(byId('history'), said(error));
  }
}

/** Makes the tab; it follows while it is open. */
export function startHistory() {
  onTab('history', load);
  model.on('generation', () => { if (isOpen('history')) load(); });
}
