/** Who changed what, when and why; what was done in one go is one entry, taken back in one go, once it was seen what that does. */

import { get, path } from './api.js';
import { button, byId, el, fill, grid, refill } from './dom.js';
import { moment } from './format.js';
import { difference } from './difference.js';
import { author, isFile, kinds, words } from './history-words.js';
import { model } from './model.js';
import { said } from './notice.js';
import { refresh } from './refresh.js';
import { isOpen, onTab } from './router.js';
import { focusSaved, showSaved } from './saved.js';
import { takeBackSeen } from './undo.js';

const PAGE = 50;
const SHOWN = 4;
let shown = PAGE;

/** Entries that were made together, the newest first. */
function together(edits) {
  const sets = new Map();
  for (const entry of edits) sets.set(entry.change_set, [entry, ...(sets.get(entry.change_set) ?? [])]);
  return [...sets.values()];
}

function row(entries, undoing) {
  const [first] = entries;
  // What takes something back is called by what it takes back.
  const isUndo = entries.some(({ id }) => undoing.has(id));
  const ordered = isUndo ? [...entries].reverse() : entries;
  const all = [...new Set(ordered.map((entry) => words(isUndo ? { ...entry, old: entry.new, new: entry.old } : entry)))];
  // One thing is said itself; of several it is said what they are.
  const isOne = all.length === 1;
  const title = isOne ? all[0] : kinds(ordered);
  const what = isUndo ? `Taken back: ${title}` : isOne ? title : `${title[0].toUpperCase()}${title.slice(1)}`;
  const each = isOne ? null : el('details', { open: all.length <= SHOWN }, el('summary', { text: `All ${all.length}` }), el('ul', { class: 'plain' }, ...all.map((text) => el('li', { text }))));
  const texts = ordered.filter(isFile).map((entry) => el('details', {}, el('summary', { text: `What changed in ${entry.key}` }), lazily(() => difference(entry.old ?? '', entry.new ?? ''))));
  const open = entries.filter(({ undone }) => !undone);
  const undo = !open.length ? el('span', { class: 'hint', text: 'taken back' })
    : model.may('tune') ? button('Undo…', () => takeBack(open[0].id, isUndo ? what : title), { 'aria-label': `Undo ${what}` }) : null;
  const by = [author(first.who), first.why].filter(Boolean).join(': ');
  return [moment(first.at), el('div', { class: 'what' }, what, by ? el('p', { class: 'hint', text: by }) : null, each, ...texts), undo];
}

// Made once somebody looks.
function lazily(make) {
  const box = el('div');
  setTimeout(() => box.parentElement?.addEventListener('toggle', () => { if (!box.firstChild) box.append(make()); }));
  return box;
}

async function takeBack(edit, what) {
  try {
    const answer = await takeBackSeen([edit], what);
    if (!answer) return;
    showSaved('Taken back.', []);
    focusSaved();
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
    const none = el('p', { class: 'card', text: 'Nothing was edited yet. What is edited is kept here, with who, when and why.' });
    const undoing = new Set(edits.map(({ undone }) => undone));
    const rows = together(edits.slice(0, shown)).map((entries) => row(entries, undoing));
    refill(byId('history'), edits.length ? el('div', { class: 'card' }, grid('History', ['when', 'what', ''], rows), more) : none);
  } catch (error) {
    fill(byId('history'), said(error));
  }
}

/** Makes the tab; it follows while it is open. */
export function startHistory() {
  onTab('history', load);
  model.on('generation', () => { if (isOpen('history')) load(); });
}
