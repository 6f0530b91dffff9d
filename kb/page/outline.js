/** All that is on the map as a table that can be searched: the map for whoever does not see it. */

import { button, byId, el, fill, grid } from './dom.js';
import { number } from './format.js';
import { openCard } from './map.js';
import { model } from './model.js';
import { nameOf, pieceOf, weightsOf } from './thing.js';

const MOST = 100;

function space(index) {
  const { name, closed } = model.weights.spaces;
  return { title: name[index], text: `${closed[index] ? 'closed; ' : ''}${number(model.map.spaces[index].area)} m²` };
}

function show() {
  if (!byId('outline').open || !model.weights) return;
  const sought = byId('outline-search')?.value ?? '';
  const matches = [];
  let total = 0;
  const { spaces, doorways, rooms, doors } = model.map;
  for (const [kind, list] of [['space', spaces], ['doorway', doorways], ['room', rooms], ['door', doors]]) {
    for (let index = 0; index < list.length; index += 1) {
      const thing = { kind, index };
      const { title, text } = kind === 'space' ? space(index) : weightsOf(thing);
      if (!`${title} ${text}`.toLowerCase().includes(sought.toLowerCase())) continue;
      total += 1;
      if (matches.length < MOST) matches.push([title, text, button('Show', () => openCard(kind, index), { 'aria-label': `Show ${kind === 'space' ? title : kind === 'doorway' ? nameOf(thing) : pieceOf(thing)}` })]);
    }
  }
  const more = total > MOST ? `The first ${MOST} of ${total}: type more to find the rest.` : `${total} found.`;
  fill(byId('outline-list'), el('p', { class: 'hint', role: 'status', text: more }), grid('What is on the map', ['Which', 'How it is', 'On the map'], matches));
}

/** Makes the table; it is filled when it is opened. */
export function startOutline() {
  fill(byId('outline-body'), el('label', {}, 'Search ', el('input', { id: 'outline-search', placeholder: 'corridor 2, door 7, not entered', on: { input: show } })), el('div', { id: 'outline-list' }));
  byId('outline').addEventListener('toggle', show);
  byId('to-outline').addEventListener('click', (event) => {
    event.preventDefault();
    byId('outline').open = true;
    byId('outline').scrollIntoView();
    byId('outline-search').focus();
  });
  model.on('weights', show);
}
