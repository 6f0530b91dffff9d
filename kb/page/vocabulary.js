/** Beside the editor: the classes that rules may speak of, with their properties; what is pressed is written where the cursor is. */

import { get } from './api.js';
import { button, el, fill } from './dom.js';
import { said } from './notice.js';

let [box, list, sought, classes, insert] = [null, null, null, [], null];

const plain = (markdown) => (markdown ?? '').replace(/\[([^\]]*)\]\([^)]*\)/g, '$1').replaceAll('`', '');

const word = ({ text, detail, what }) => el('div', {}, button(text, () => insert(text), { class: 'link', 'aria-label': `Write ${text}` }), el('span', { class: 'hint', text: [detail, plain(what)].filter(Boolean).map((part) => ` ${part}`).join(':') }));

function show() {
  const wanted = sought.value.trim().toLowerCase();
  const has = ({ text }) => text.toLowerCase().includes(wanted);
  const found = classes.flatMap(({ class: of, properties }) => {
    const fit = has(of) ? properties : properties.filter(has);
    return wanted && !has(of) && !fit.length ? [] : [[of, fit]];
  });
  const entry = ([of, properties]) => el('details', { open: Boolean(wanted) && found.length <= 4 }, el('summary', { text: of.text }), word(of), ...properties.map(word));
  fill(list, ...found.map(entry), found.length ? null : el('p', { class: 'hint', text: 'Nothing is called that.' }));
}

async function load() {
  try {
    ({ classes } = await get('/api/rules/classes'));
    show();
  } catch (error) {
    fill(list, said(error));
  }
}

/** Makes the list, which is read when it is opened; `write` puts a text where the cursor is. */
export function startVocabulary(write) {
  insert = write;
  list = el('div', { class: 'vocabulary' });
  sought = el('input', { type: 'search', 'aria-label': 'Search classes and properties', placeholder: 'search', on: { input: show } });
  box = el('details', { class: 'card', id: 'vocabulary', on: { toggle: () => { if (box.open) load(); } } }, el('summary', { text: 'Classes and properties' }), sought, list);
  return box;
}
