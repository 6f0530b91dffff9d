/** The versions of a rule file: what it was, in what that differs from what it is, and taken up again as a draft. */

import { get, path } from './api.js';
import { difference } from './difference.js';
import { button, el, fill } from './dom.js';
import { draftOf, edit, textOf } from './drafts.js';
import { moment } from './format.js';
import { author } from './history-words.js';
import { model } from './model.js';
import { said } from './notice.js';

let [box, body, file] = [null, null, null];

function title({ at, who, why, text, edit: entry }, place) {
  const when = at ? moment(at) : entry === null && place === 0 ? 'as it is now' : 'before that';
  const by = who ? `, ${author(who)}` : ', saved with another program';
  return `${when}${by}${why ? `: ${why}` : ''}${text === null ? ' (no such file)' : ''}`;
}

function row(version, place) {
  const shown = el('div');
  const name = title(version, place);
  const compare = button('Compare', () => {
    if (shown.firstChild) {
      compare.setAttribute('aria-expanded', 'false');
      return fill(shown);
    }
    compare.setAttribute('aria-expanded', 'true');
    return fill(shown, el('p', { class: 'hint', text: 'From that to what is in the editor:' }), difference(version.text ?? '', textOf(file) ?? ''));
  }, { class: 'link', 'aria-label': `Compare with ${name}`, 'aria-expanded': 'false' });
  const restore = model.may('rules') ? button('Take up again', () => edit(file, version.text), { class: 'link', 'aria-label': `Take up again: ${name}` }) : null;
  return el('li', {}, el('div', { class: 'file-head' }, name, el('span', { class: 'buttons' }, compare, restore)), shown);
}

async function load() {
  const of = file;
  try {
    const { versions } = await get(path('/api/rules/versions', { file: of }));
    if (of !== file) return;
    const known = versions.filter(({ text }, place) => text !== null || place > 0);
    fill(body, known.length ? el('ul', { class: 'plain versions' }, ...known.map(row)) : el('p', { class: 'hint', text: 'It was never saved.' }));
  } catch (error) {
    fill(body, said(error));
  }
}

/** Makes the list, which is read when it is opened. */
export function startVersions() {
  body = el('div');
  box = el('details', { class: 'card', id: 'versions', on: { toggle: () => { if (box.open && file) load(); } } }, el('summary', { text: 'Versions of this file' }), body);
  model.on('generation changed', () => { if (box.open && file) load(); });
  return box;
}

/** Shows those of a file; none: of nothing. */
export function showVersions(name) {
  const isOther = name !== file;
  file = name;
  box.hidden = !name || (draftOf(name) && draftOf(name).version === null && draftOf(name).was === null && !box.open);
  if (isOther && box.open && name) load();
}
