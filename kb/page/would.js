/** What an edit that has a form of its own would change, shown in the form before it may be made. */

import { byId, debounced, el, fill } from './dom.js';
import { untilWhen } from './format.js';
import { model } from './model.js';
import { said } from './notice.js';
import { noteList, summary, thisRoute } from './summary.js';
import { previewOf } from './tried.js';

const WAIT = 150;

/**
 * Looks ahead: `look` whenever something is typed, `now` at once. `isReady` says whether what is on the screen is of the edit as it stands,
 * and looks ahead where it is not, without holding anybody up; `forget` takes it off the screen.
 * @param {() => Object|null} wish the edit, or null where it is not whole
 * @param {HTMLButtonElement} make makes the edit; it can be pressed once it was on the screen what that would change
 */
export function lookAhead(id, wish, make) {
  const node = el('div', { id, class: 'would', role: 'status' });
  let [asked, seen] = ['', ''];
  let mine = null;
  // A card over the map shows there what it would change, for as long as it is open.
  const draw = (answer) => {
    if (mine && model.ahead === mine) model.set('ahead', null);
    mine = answer && node.closest('.card') ? answer : null;
    if (mine) model.set('ahead', mine);
  };
  new MutationObserver(() => {
    if (mine && !node.isConnected) draw(null);
  }).observe(byId('answers'), { childList: true });
  const show = (text, ...parts) => {
    fill(node, ...parts);
    [asked, seen] = ['', text];
    wait(false);
    // What has come must not push the form out of sight.
    const card = node.closest('.card');
    if (card?.contains(document.activeElement)) card.scrollIntoView({ block: 'nearest' });
  };
  function wait(isAwaited) {
    node.setAttribute('aria-busy', String(isAwaited));
    make.disabled = isAwaited;
    if (isAwaited && !node.firstChild) fill(node, el('p', { class: 'hint', text: 'Looking what would change…' }));
  }
  async function now() {
    const edit = wish();
    if (!edit) {
      draw(null);
      return show('');
    }
    const text = JSON.stringify(edit);
    asked = text;
    wait(true);
    try {
      const answer = await previewOf([edit]);
      if (asked !== text) return undefined;
      show(text, ...(answer.closings ?? []).map((closing) => el('p', { text: `Then: ${closing}${edit.until ? untilWhen(edit.until) : ''}.` })), el('p', { text: summary(answer).join(' ') }), thisRoute(answer), noteList(answer.notes));
      draw(answer);
    } catch (error) {
      // What cannot be looked at in time may be made all the same; what is refused may not.
      if (asked !== text) return undefined;
      draw(null);
      show(error.status >= 500 ? text : '', said(error));
    }
    return undefined;
  }
  function isReady() {
    const text = JSON.stringify(wish());
    if (seen !== text && asked !== text) now();
    return seen === text;
  }
  const later = debounced(now, WAIT);
  function look() {
    [asked, seen] = ['', ''];
    wait(Boolean(wish()));
    later();
  }
  return { node, now, look, isReady, forget: () => { draw(null); show(''); } };
}
