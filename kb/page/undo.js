/** Taking back what was saved, once it was seen what that does. */

import { post } from './api.js';
import { sure } from './dom.js';
import { count } from './format.js';
import { allPass, summary } from './summary.js';

function testsOf({ rules }) {
  if (!rules) return '';
  return rules.failed ? `${count(rules.failed, 'test')} of the rules would fail.` : rules.passed ? allPass(rules.passed) : '';
}

const asSentence = (note) => `${note[0].toUpperCase()}${note.slice(1)}.`;

/**
 * Says what it would change, and does it where somebody still wants it; the answer of the service, or null.
 * @param {number[]} edits numbers of the history, the latest first to go
 */
export async function takeBackSeen(edits, what) {
  const undo = [...edits].reverse().map((edit) => ({ kind: 'undo', edit }));
  const question = post('/api/preview', { edits: undo }).then((would) => `Take back “${what}”? ${[...summary(would), ...(would.notes ?? []).map(asSentence), testsOf(would)].join(' ')}`);
  if (!await sure(question, 'Take it back')) return null;
  return post('/api/edits', { edit: undo.length === 1 ? undo[0] : { kind: 'together', edits: undo } });
}
