/** Closing from the map: doorways, spaces, areas, named doors, rooms and doors, for a time, for all or for some robots. */

import { post } from './api.js';
import { card } from './answers.js';
import { button, byId, el, fill, focusStays, form } from './dom.js';
import { untilWhen } from './format.js';
import { model } from './model.js';
import { said } from './notice.js';
import { put } from './pending.js';
import { refresh } from './refresh.js';
import { andThen, focusSaved, showSaved } from './saved.js';
import { holds, middleOf } from './shapes.js';
import { nounOf, showsPieces, sidesOf } from './thing.js';
import { waitsAs } from './told.js';
import { lookAhead } from './would.js';

/** As far as a door may be from the point at which it was told, metres. */
const NEAR_M = 0.5;

const pointOf = ({ object }) => object.split(',').map(Number);

/** The fact by which something is closed, where one of this class is about what this finds. */
function closedBy(classes, property, isIt) {
  return model.facts.find((fact) => classes.includes(fact.class) && fact.property === property && fact.value === (property === 'closed') && fact.standing === 'holds' && isIt(fact));
}

const isNamed = (name) => Boolean(closedBy(['NAMED_DOORS', 'AREAS'], 'closed', ({ object }) => object === name));

function doorFact(door) {
  const [x, y] = middleOf(door.segment);
  return closedBy(['DOORS'], 'passable', (fact) => {
    const [fx, fy] = pointOf(fact);
    return Math.hypot(fx - x, fy - y) <= NEAR_M;
  });
}

const roomFact = (room) => closedBy(['ROOMS'], 'passable', (fact) => fact.object === room.name || holds(room, pointOf(fact)));

/** What may be closed or opened at a thing of the map, each with its edit. */
export function closings(thing) {
  const { weights, map } = model;
  const way = (name, closed) => ({ text: closed ? `Open ${name} again` : `Close ${name}…`, edit: { kind: closed ? 'open' : 'close', what: name } });
  const tell = (text, what, name, object, told) => (told
    ? { text: `Open ${what} again`, edit: { kind: 'retract', fact: told.id } }
    : { text: `${text} ${what}…`, edit: { kind: 'tell', class: name, object, property: 'passable', value: false } });
  const ways = [];
  if (thing.kind === 'doorway') {
    const { closed, closed_from: from } = weights.doorways;
    const sides = [...new Set(sidesOf(thing.index))];
    ways.push({ ...way(nounOf(thing), closed[thing.index] || from[thing.index]), sides: sides.length > 1 ? sides : [] });
  }
  else if (thing.named) ways.push(way(thing.named.name, isNamed(thing.named.name)));
  if (thing.kind === 'room' && nounOf(thing)) ways.push(way(nounOf(thing), weights.spaces.closed[thing.space]));
  for (const area of thing.areas ?? []) if (area.name !== nounOf(thing)) ways.push(way(area.name, isNamed(area.name)));
  const [door, room] = [map.doors[thing.index], map.rooms[thing.index]];
  if (thing.kind === 'door') ways.push(tell('Close', `door ${door.door}`, 'DOORS', String(door.door), doorFact(door)));
  if (thing.kind === 'room' && showsPieces()) ways.push(tell('Keep out of', `room ${room.name}`, 'ROOMS', room.name, roomFact(room)));
  return ways;
}

/** Asks until when and for whom, shows what would change, and does it. */
export function close(edit, label, sides = []) {
  const title = label.replace('…', '');
  const until = el('input', { id: 'close-until', placeholder: 'opened, 18:00, 2h', title: 'A time, a while, or a day with its time: 18:00, 2h, 2026-12-24T08:00', autocomplete: 'off' });
  const reason = el('input', { id: 'close-why', placeholder: 'if you like' });
  const { robots } = model.site;
  const only = el('select', { id: 'close-only' }, el('option', { value: '', text: 'everybody' }), ...robots.map((robot) => el('option', { value: robot, text: robot })));
  const from = el('select', { id: 'close-from' }, el('option', { value: '', text: 'either side' }), ...sides.map((side) => el('option', { value: side, text: side })));
  const ends = edit.kind === 'close' || edit.kind === 'tell';
  const forSome = edit.kind === 'close' && robots.length > 1;
  const oneSide = edit.kind === 'close' && sides.length > 0;
  const wish = () => ({ ...edit, ...(oneSide && from.value ? { from: from.value } : {}), ...(ends && until.value.trim() ? { until: until.value.trim() } : {}), ...(forSome && only.value ? { only: [only.value] } : {}) });
  const send = el('button', { type: 'submit', class: 'strong', text: title });
  const would = lookAhead('close-preview', wish, send);
  const asked = form({ class: 'line-form' }, make,
    ends ? el('label', {}, 'Until ', until) : null,
    oneSide ? el('label', {}, 'From ', from) : null,
    forSome ? el('label', {}, 'For ', only) : null,
    el('label', {}, 'Why ', reason), send,
    button('Save it with the rest', toTheTray, { id: 'close-with-the-rest' }));
  const made = card('tell-card', title, [would.node, asked]);
  for (const field of [until, only, from]) field.addEventListener('input', would.look);
  would.now();
  // Beside numbers, rules and what is drawn: previewed and saved with them.
  function toTheTray() {
    const edit = wish();
    put(waitsAs(edit), { words: `${title}${edit.from ? ` from ${edit.from}` : ''}${untilWhen(edit.until)}${edit.only ? ` for ${edit.only}` : ''}`, edits: [edit] });
    made.remove();
    byId('preview-title').focus();
  }
  async function make() {
    if (!would.isReady()) return;
    const stays = focusStays();
    try {
      const answer = await post('/api/edits', { edit: wish(), why: reason.value.trim() || undefined });
      const isHere = stays();
      made.remove();
      showSaved(`${title}: done.${andThen([answer])}`, [answer.done.id]);
      if (isHere) focusSaved();
      await refresh(answer.generation);
    } catch (error) {
      fill(would.node, said(error));
    }
  }
  (ends ? until : reason).focus();
}
