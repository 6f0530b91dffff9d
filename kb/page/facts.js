/** Facts: what people and robots told of single things, and until when. */

import { get } from './api.js';
import { askCard } from './ask.js';
import { button, byId, el, fill, form, grid, refill } from './dom.js';
import { moment } from './format.js';
import { author, fact as words } from './history-words.js';
import { isGoing, readLaid, takeAway } from './laid.js';
import { model } from './model.js';
import { said } from './notice.js';
import { isOpen, onTab } from './router.js';
import { isGoing as isTakenBack, takeBack, tell as tellWithTheRest } from './told.js';
import { lookAhead } from './would.js';

const USUAL = {
  doorway: { text: 'Nobody passes a doorway', class: 'DOORWAYS', property: 'closed', value: 'true', object: 'name of the doorway, or x,y' },
  space: { text: 'Nobody enters a space', class: 'SPACES', property: 'closed', value: 'true', object: 'name of the space, or x,y' },
  door: { text: 'A door lets nobody through', class: 'DOORS', property: 'passable', value: 'false', object: 'number of the door, or x,y' },
  room: { text: 'A room is not entered', class: 'ROOMS', property: 'passable', value: 'false', object: 'name of the room, or x,y' },
  named: { text: 'A named door is closed', class: 'NAMED_DOORS', property: 'closed', value: 'true', object: 'name of the door' },
  other: { text: 'Something else' },
};
/** What may be closed: in the paper's modes doorways and spaces close nothing, and without a map there is nothing to close. */
const usualHere = () => ({ 'by-state': Object.keys(USUAL), none: ['other'] })[model.site.rooms_mode] ?? ['door', 'room', 'named', 'other'];
const STANDING = { holds: 'holds', lost: 'lost: what it is about is no longer there', expired: 'over' };

function field(label, id, attributes = {}) {
  return el('label', { 'data-field': id }, `${label} `, el('input', { id: `fact-${id}`, autocomplete: 'off', ...attributes }));
}

function tellForm() {
  const kind = el('select', { id: 'fact-kind' }, ...usualHere().map((name) => el('option', { value: name, text: USUAL[name].text })));
  const made = form({ class: 'fact-form' }, tell, el('label', {}, 'What ', kind), field('Class', 'class', { placeholder: model.site.rooms_mode === 'none' || model.site.layout_kind ? 'in capitals, as its table is called' : 'ROOMS, AREAS…' }), field('Which', 'object', { required: true }),
    field('Property', 'property'), field('Value', 'value'), field('Until', 'until', { placeholder: 'taken back, 18:00, 2h', title: 'A time, a while, or a day with its time: 18:00, 2h, 2026-12-24T08:00' }), el('div', { class: 'buttons' }, send));
  const choose = () => {
    const usual = USUAL[kind.value];
    for (const name of ['class', 'property', 'value']) {
      made.querySelector(`[data-field=${name}]`).hidden = kind.value !== 'other';
      made.querySelector(`#fact-${name}`).required = kind.value === 'other';
    }
    made.querySelector('#fact-object').placeholder = usual.object ?? 'its name, or x,y';
  };
  kind.addEventListener('change', choose);
  made.addEventListener('input', would.look);
  choose();
  return el('div', {}, made, would.node);
}

const read = (name) => byId(`fact-${name}`).value.trim();

/** The fact as it stands in the form; null where it is not whole. */
function fact() {
  const usual = USUAL[read('kind')];
  const [of, property, object] = [usual.class ?? read('class'), usual.property ?? read('property'), read('object')];
  return of && property && object ? { class: of, object, property, value: typed(usual.value ?? read('value')), until: read('until') || undefined } : null;
}

const send = el('button', { type: 'submit', class: 'strong', text: 'Tell it' });
const would = lookAhead('fact-would', () => fact() && { kind: 'tell', ...fact() }, send);

/** What was typed as a value: a number, yes or no, or a text. */
function typed(text) {
  if (text === 'true' || text === 'false') return text === 'true';
  return text !== '' && Number.isFinite(Number(text)) ? Number(text) : text;
}

// It waits, and is saved with rules and numbers that belong to it; what the service would refuse stays in the form.
function tell() {
  if (!would.isReady()) return;
  tellWithTheRest(fact());
  byId('fact-object').value = '';
  would.forget();
  byId('preview-title').focus();
}

// People know spaces and doorways by their names, which facts about them outlive.
const called = (fact) => ({ ...fact, key: ['SPACES', 'DOORWAYS'].includes(fact.class) && fact.about.length === 1 ? fact.about[0] : fact.object });

/** Has a fact taken back with what is saved next; asked once more, it stays. */
function retracting(fact) {
  const said = words(called(fact));
  const text = isTakenBack(fact) ? 'Keep' : 'Take back…';
  return button(text, () => takeBack(fact, said), { 'aria-label': `${text} ${said}` });
}

async function load() {
  try {
    const { facts } = await get('/api/facts');
    const rows = facts.map((fact) => [words(called(fact)), fact.until ? moment(fact.until) : 'taken back', STANDING[fact.standing] ?? fact.standing, author(fact.who), fact.at ? moment(fact.at) : '', fact.why ?? '',
      model.may('tell') ? retracting(fact) : null]);
    refill(byId('facts-list'), facts.length ? grid('What is told', ['what', 'until', 'standing', 'who', 'when', 'why', ''], rows) : el('p', { class: 'hint', text: 'Nothing is told now.' }));
  } catch (error) {
    fill(byId('facts-list'), said(error));
  }
  if (!byId('laid-list')) return;
  try {
    const laid = await readLaid();
    const rows = laid.map((one) => [one.name, [one.what, one.kind].filter(Boolean).join(', '), one.until ? moment(one.until) : 'taken away', author(one.who), one.why ?? '', model.may('tell') ? goes(one) : null]);
    refill(byId('laid-list'), laid.length ? grid('What lies over the map', ['what', 'kind', 'until', 'who', 'why', ''], rows) : el('p', { class: 'hint', text: 'Nothing lies over the map now.' }));
  } catch (error) {
    fill(byId('laid-list'), said(error));
  }
}

// What it would change is seen beside the map, where it is saved.
function goes(laid) {
  const text = isGoing(laid) ? 'Keep' : 'Take away…';
  return button(text, () => {
    takeAway(laid);
    location.hash = '#map';
  }, { 'aria-label': `${text} ${laid.name}` });
}

function drawLink() {
  return el('p', {}, el('a', { href: '#map', text: 'Draw on the map', on: { click: () => setTimeout(() => byId('draw').click()) } }), ' what else lies there: areas, obstacles, places, bridges, doors.');
}

function show() {
  if (!byId('fact-kind')) {
    fill(byId('facts'), el('div', { class: 'card' }, el('h2', { text: 'What is told now' }), el('div', { id: 'facts-list' })),
      model.may('tell') ? el('div', { class: 'card' }, el('h2', { text: 'Tell something' }), tellForm()) : null,
      askCard(),
      model.site.rooms_mode === 'none' ? null : el('div', { class: 'card' }, el('h2', { text: 'What lies over the map' }), el('div', { id: 'laid-list' }), model.may('tell') ? drawLink() : null));
  }
  return load();
}

/** Makes the tab; it follows while it is open. */
export function startFacts() {
  onTab('facts', show);
  model.on('generation pending', () => { if (isOpen('facts')) load(); });
}
