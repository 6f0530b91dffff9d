/** Taking back what was saved, once it was seen what that does. */

import { get, path, post } from './api.js';
import { sure } from './dom.js';
import { asSentence, count } from './format.js';
import { rowOf } from './history-words.js';
import { model } from './model.js';
import { allPass, summary } from './summary.js';
import { previewOf } from './tried.js';

/** So far back in the history it is looked for what lay over the map. */
const MOST = 1000;

function testsOf({ rules }) {
  if (!rules) return '';
  return rules.failed ? `${count(rules.failed, 'test')} of the rules would fail.` : rules.passed ? allPass(rules.passed) : '';
}


/** What comes back to the map, and what goes from it: the outlines as those of what waits. */
async function shapesOf(numbers) {
  const { edits } = await get(path('/api/history', { limit: MOST }));
  const sets = new Set(edits.filter(({ id }) => numbers.includes(id)).map((entry) => entry.change_set));
  return edits.filter((entry) => entry.table === 'laid' && sets.has(entry.change_set)).map((entry) => {
    const [came, went] = [rowOf(entry.new), rowOf(entry.old)];
    const { what, name, outline } = came ?? went;
    return { what, name, points: JSON.parse(outline), gone: Boolean(came) };
  });
}

/**
 * Says what it would change, marks it on the map as what waits is marked, and does it where somebody still wants it; the answer of the service, or null.
 * @param {number[]} edits numbers of the history, the latest first to go
 */
export async function takeBackSeen(edits, what) {
  const undo = [...edits].reverse().map((edit) => ({ kind: 'undo', edit }));
  const [would, shapes] = [previewOf(undo), shapesOf(edits).catch(() => [])];
  const question = would.then((answer) => `Take back “${what}”? ${[...summary(answer), ...(answer.notes ?? []).map(asSentence), testsOf(answer)].join(' ')}`);
  const before = model.ahead;
  let isAsked = true;
  Promise.all([would, shapes]).then(([answer, drawn]) => { if (isAsked) model.set('ahead', { ...answer, shapes: drawn }); }).catch(() => {});
  try {
    if (!await sure(question, 'Take it back')) return null;
  } finally {
    isAsked = false;
    if (model.ahead !== before) model.set('ahead', before);
  }
  return post('/api/edits', { edit: undo.length === 1 ? undo[0] : { kind: 'together', edits: undo } });
}
