/** Taking back what was saved, once it was seen what that does. */

import { post } from './api.js';
import { sure } from './dom.js';
import { summary } from './preview.js';

function testsOf({ rules }) {
  if (!rules) return '';
  return rules.failed ? `${rules.failed} tests of the rules would fail.` : `All ${rules.passed} tests of the rules pass.`;
}

/**
 * Says what it would change, and does it where somebody still wants it; the answer of the service, or null.
 * @param {number[]} edits numbers of the history, the latest first to go
 */
export async function takeBackSeen(edits, what) {
  const undo = [...edits].reverse().map((edit) => ({ kind: 'undo', edit }));
  const would = await post('/api/preview', { edits: undo });
  if (!await sure(`Take back “${what}”? ${[...summary(would), testsOf(would)].join(' ')}`, 'Take it back')) return null;
  return post('/api/edits', { edit: undo.length === 1 ? undo[0] : { kind: 'together', edits: undo } });
}
