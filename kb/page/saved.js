/** The word after a save, with its undo. */

import { post } from './api.js';
import { button, byId, el, fill } from './dom.js';
import { said } from './notice.js';
import { refresh } from './refresh.js';

/**
 * Says what was saved. `edits` are the numbers of the history to take back, the latest first to go.
 * @param {string} text
 * @param {number[]} edits
 * @param {{text: string, act: () => void}} [other] another button
 */
export function showSaved(text, edits, other) {
  const undo = edits.length ? button('Undo', () => undoAll(edits), { id: 'undo', class: 'strong' }) : null;
  const more = other ? button(other.text, other.act) : null;
  fill(byId('saved'), el('div', { class: 'card done' }, el('p', { text }), undo, more, button('Close', () => fill(byId('saved')), { class: 'quiet' })));
}

async function undoAll(edits) {
  try {
    let answer = null;
    for (const edit of [...edits].reverse()) answer = await post('/api/edits', { edit: { kind: 'undo', edit } });
    showSaved('Taken back. The tables are as they were.', []);
    await refresh(answer?.generation);
  } catch (error) {
    byId('saved').append(el('div', { class: 'card' }, said(error)));
  }
}
