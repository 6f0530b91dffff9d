/** The word after a save, with its undo. */

import { button, byId, el, fill, shut } from './dom.js';
import { said } from './notice.js';
import { refresh } from './refresh.js';
import { takeBackSeen } from './undo.js';

/**
 * Says what was saved. `edits` are the numbers of the history to take back, the latest first to go.
 * @param {string} text
 * @param {number[]} edits
 * @param {{text: string, act: () => void}} [other] another button
 */
export function showSaved(text, edits, other) {
  const undo = edits.length ? button('Undo…', () => undoAll(edits, text.replace(/^Saved: /, '').replace(/\.$/, '')), { id: 'undo', class: 'strong' }) : null;
  const more = other ? button(other.text, other.act) : null;
  fill(byId('saved'), el('div', { class: 'card done' }, el('p', { text, id: 'saved-said', tabindex: '-1' }), undo, more, shut('this', () => {
    forgetSaved();
    byId('content').focus({ preventScroll: true });
  })));
}

/** Takes the word away. */
export const forgetSaved = () => fill(byId('saved'));

/** What rules that react did of it, and what it leaves as one may not expect it, after the word about it. */
export const andThen = (answers) => {
  const done = answers.flatMap(({ reacted }) => reacted ?? []);
  const remarks = answers.flatMap((answer) => answer.remarks ?? []);
  return (done.length ? ` Then ${done.join('; ')}.` : '') + remarks.map((remark) => ` But ${remark}.`).join('');
};

/** Gives the focus to the word itself, not to its undo: who holds the key, or presses it once more, must not undo. */
export const focusSaved = () => byId('saved-said').focus({ preventScroll: true });

async function undoAll(edits, what) {
  const hadFocus = byId('saved').contains(document.activeElement);
  try {
    const answer = await takeBackSeen(edits, what);
    if (!answer) return;
    showSaved('Taken back. All is as it was.', []);
    if (hadFocus) focusSaved();
    await refresh(answer.generation);
  } catch (error) {
    byId('saved').append(el('div', { class: 'card' }, said(error)));
  }
}
