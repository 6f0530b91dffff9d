/** What waits of what somebody else has edited since: what it is by now and who edited it; one of the two goes. */

import { get, path } from './api.js';
import { titleOf } from './cells.js';
import { difference } from './difference.js';
import { button, byId, el } from './dom.js';
import { files, forget, overtaken, rebase } from './drafts.js';
import { value } from './format.js';
import { by } from './history-words.js';
import { model } from './model.js';
import { cells, discard, keyName, put } from './pending.js';
import { otherRows, outdated } from './table-file.js';
import { inTuning } from './tunings.js';

/** So far back in the history it is looked for who edited a cell. */
const MOST = 200;

/** What a cell is by now; undefined where its row is gone. */
function present({ table, key, column, tuning }) {
  const of = model.table(table);
  const base = of?.rows[of.keys.indexOf(key)]?.[of.columns.findIndex(({ name }) => name === column)];
  return tuning ? inTuning(table, key, column, tuning) ?? base : base;
}

const moved = () => cells().filter(([, cell]) => present(cell) !== cell.old);

/** Whether something has to be settled before it may be saved. */
export const isClashing = () => moved().length > 0 || overtaken().length > 0 || outdated().length > 0;

/** By what it is about, as text: what was made of it. Who presses a button there is to find it again. */
let made = new Map();

/** What has to be settled, each as a node that stays the same as long as it is about the same. */
export function clashes() {
  const wanted = [
    ...moved().map(([id, cell]) => [[id, cell.old, cell.value, present(cell)], () => otherValue(id, cell)]),
    ...overtaken().map((draft) => [[draft.file, draft.text, draft.was, files.get(draft.file)?.version], () => otherFile(draft)]),
    ...outdated().map((edit) => [[edit.table, edit.version, model.table(edit.table)?.version], () => otherRows(edit)]),
  ];
  made = new Map(wanted.map(([about, make]) => [JSON.stringify(about), make]).map(([name, make]) => [name, made.get(name) ?? make()]));
  return [...made.values()];
}

function isAbout(entry, { table, key, column, tuning }) {
  if (tuning) return entry.table === 'tuning_cells' && entry.key === [tuning, table, key, column].join('/');
  return entry.table === table && entry.key === key && (entry.column ?? column) === column;
}

/** `, edited by Anna`; nothing where the history does not say it. */
async function doneBy(cell, done) {
  try {
    const entry = (await get(path('/api/history', { limit: MOST }))).edits.find((one) => isAbout(one, cell));
    return entry ? `, ${done} ${by(entry.who)}` : '';
  } catch {
    return '';
  }
}

function otherValue(id, cell) {
  const now = present(cell);
  const name = `${keyName(cell.key)} ${cell.column.replaceAll('_', ' ')}`;
  const text = el('p', { class: 'wrong', role: 'alert' });
  const isGone = now === undefined;
  const isMine = now === cell.value;
  const words = isGone ? `${keyName(cell.key)} is gone from ${titleOf(cell.table)} by now` : isMine ? `${name} is ${value(now)} by now, the same as yours` : `${name} is ${value(now)} by now`;
  const before = isGone || isMine ? '' : `; it was ${value(cell.old)} when you began`;
  doneBy(cell, isGone ? 'taken away' : 'edited').then((who) => { text.textContent = `${words}${who}${before}.`; });
  return el('div', { class: 'conflict' }, text, el('div', { class: 'line-form' },
    button(isGone || isMine ? 'Drop my edit' : `Take ${value(now)}`, () => settle(() => discard(id)), { class: 'take-theirs' }),
    // It stands on what is there now, so that saving it is no blind overwrite.
    isGone || isMine ? null : button(`Set ${value(cell.value)} all the same`, () => settle(() => put(id, { ...cell, old: now })), { class: 'set-mine' })));
}

// What they made of it is shown before it is saved over.
function otherFile({ file, was, text }) {
  const theirs = files.get(file)?.text ?? null;
  const what = theirs === null ? `${file} was deleted by somebody else meanwhile.` : was === null ? `Somebody else has made a file ${file} meanwhile.` : `${file} was saved by somebody else meanwhile. What they changed:`;
  return el('div', { class: 'conflict' }, el('p', { class: 'wrong', role: 'alert', text: what }), theirs === null ? null : difference(was ?? '', theirs),
    text === null || theirs === null ? null : el('details', {}, el('summary', { text: 'Yours beside theirs' }), difference(theirs, text)),
    el('div', { class: 'line-form' }, button('Take theirs (what I typed is lost)', () => settle(() => forget(file)), { class: 'take-theirs' }),
      button('Keep mine, over theirs', () => settle(() => rebase(file)), { class: 'set-mine' })));
}

// The button goes with what it settles; who pressed it by keys goes on in the tray, or where that was.
function settle(act) {
  const hadFocus = byId('preview').contains(document.activeElement) || document.activeElement === document.body;
  act();
  if (hadFocus) byId(model.pending.size ? 'preview-title' : 'content').focus({ preventScroll: true });
}
