/** Facts that wait among what is pending: to be told, or no longer told. */

import { untilWhen } from './format.js';
import { fact as words } from './history-words.js';
import { model } from './model.js';
import { discard, put } from './pending.js';

/** The name under which an edit of facts or closings waits: what is said of the same thing once more takes its place. */
export const waitsAs = ({ kind, fact, what, class: of, object, property }) => (kind === 'retract' ? `retract:${fact}` : kind === 'tell' ? `tell:${of}:${object}:${property}` : `close:${what}`);

/** Has a fact told with what is saved next. @param {Object} fact class, object, property, value; until, where it ends */
export function tell(fact) {
  const edit = { kind: 'tell', ...fact };
  put(waitsAs(edit), { words: `Told: ${words({ ...fact, key: fact.object })}${untilWhen(fact.until)}`, edits: [edit] });
}

const retraction = ({ id }) => ({ kind: 'retract', fact: id });

/** Whether a fact is to be taken back. */
export const isGoing = (fact) => model.pending.has(waitsAs(retraction(fact)));

/** Has a fact taken back with what is saved next; asked once more, it stays. */
export function takeBack(fact, said) {
  const edit = retraction(fact);
  if (isGoing(fact)) discard(waitsAs(edit));
  else put(waitsAs(edit), { words: `No longer told: ${said}`, edits: [edit] });
}
