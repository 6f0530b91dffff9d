/** What an edit that has a form of its own would change, shown in the form before it may be made. */

import { post } from './api.js';
import { debounced, el, fill } from './dom.js';
import { model } from './model.js';
import { said } from './notice.js';
import { summary, thisRoute } from './preview.js';

const WAIT = 150;

/**
 * Looks ahead: `look` whenever something is typed, `now` at once; `isSeen` says whether what is on the screen is of the edit as it stands.
 * @param {() => Object|null} wish the edit, or null where it is not whole
 */
export function lookAhead(id, wish) {
  const node = el('div', { id, role: 'status' });
  let [asked, seen] = ['', ''];
  async function now() {
    const edit = wish();
    asked = JSON.stringify(edit);
    if (!edit) return fill(node);
    const text = asked;
    const { start, goal, robot } = model.ask;
    try {
      const answer = await post('/api/preview', { edits: [edit], ...(start && goal ? { start, goal } : {}), ...(robot ? { robot } : {}) });
      if (asked !== text) return undefined;
      fill(node, ...(answer.closings ?? []).map((closing) => el('p', { text: `Then: ${closing}.` })), el('p', { text: summary(answer).join(' ') }), thisRoute(answer));
      seen = text;
    } catch (error) {
      if (asked !== text) return undefined;
      fill(node, said(error));
      // What cannot be looked at in time may be made all the same; what is refused may not.
      seen = error.status >= 500 ? text : '';
    }
    return undefined;
  }
  return { node, now, look: debounced(now, WAIT), isSeen: () => seen !== '' && seen === JSON.stringify(wish()) };
}
