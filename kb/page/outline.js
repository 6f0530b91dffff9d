/** All rooms and doors as a table that can be searched: the map for whoever does not see it. */

import { button, byId, el, fill, grid } from './dom.js';
import { openCard } from './map.js';
import { model } from './model.js';
import { nameOf, weightsOf } from './thing.js';

const MOST = 100;

function show() {
  if (!byId('outline').open || !model.weights) return;
  const sought = byId('outline-search')?.value ?? '';
  const matches = [];
  let total = 0;
  for (const kind of ['room', 'door']) {
    const list = kind === 'room' ? model.map.rooms : model.map.doors;
    for (let index = 0; index < list.length; index += 1) {
      const thing = { kind, index };
      const { title, text } = weightsOf(thing);
      if (!`${title} ${text}`.toLowerCase().includes(sought.toLowerCase())) continue;
      total += 1;
      if (matches.length < MOST) matches.push([title, text, button('Show', () => openCard(kind, index), { 'aria-label': `Show ${nameOf(thing)}` })]);
    }
  }
  const more = total > MOST ? `The first ${MOST} of ${total}: say more to find the rest.` : `${total} found.`;
  fill(byId('outline-list'), el('p', { class: 'hint', role: 'status', text: more }), grid('Rooms and doors', ['Which', 'How it is', 'On the map'], matches));
}

/** Makes the table; it is filled when it is opened. */
export function startOutline() {
  fill(byId('outline-body'), el('label', {}, 'Search ', el('input', { id: 'outline-search', placeholder: 'door 7, squat, not entered', on: { input: show } })), el('div', { id: 'outline-list' }));
  byId('outline').addEventListener('toggle', show);
  byId('to-outline').addEventListener('click', (event) => {
    event.preventDefault();
    byId('outline').open = true;
    byId('outline').scrollIntoView();
    byId('outline-search').focus();
  });
  model.on('weights', show);
}
