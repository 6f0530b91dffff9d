/** Closing from the map: doorways, spaces, areas, named doors, rooms and doors, for a time, for all or for some robots. */

import { post } from './api.js';
import { card } from './answers.js';
import { debounced, el, fill, form } from './dom.js';
import { model } from './model.js';
import { said } from './notice.js';
import { summary, thisRoute } from './preview.js';
import { refresh } from './refresh.js';
import { andRules, showSaved } from './saved.js';
import { nounOf, showsPieces } from './thing.js';

const WAIT = 150;

/** What may be closed or opened at a thing of the map, each with its edit. */
export function closings(thing) {
  const { weights, map } = model;
  const way = (name, closed) => ({ text: closed ? `Open ${name} again` : `Close ${name}…`, edit: { kind: closed ? 'open' : 'close', what: name } });
  const tell = (text, fact) => ({ text, edit: { kind: 'tell', ...fact } });
  const ways = [];
  if (thing.kind === 'doorway') ways.push(way(nounOf(thing), weights.doorways.closed[thing.index]));
  else if (thing.named) ways.push(way(thing.named.name, false));
  if (thing.kind === 'room' && nounOf(thing)) ways.push(way(nounOf(thing), weights.spaces.closed[thing.space]));
  for (const area of thing.areas ?? []) if (area.name !== nounOf(thing)) ways.push(way(area.name, false));
  if (thing.kind === 'door') ways.push(tell(`Close door ${map.doors[thing.index].door}…`, { class: 'DOORS', object: String(map.doors[thing.index].door), property: 'passable', value: false }));
  if (thing.kind === 'room' && showsPieces()) ways.push(tell(`Keep out of room ${map.rooms[thing.index].name}…`, { class: 'ROOMS', object: map.rooms[thing.index].name, property: 'passable', value: false }));
  return ways;
}

/** Asks until when and for whom, shows what would change, and does it. */
export function close(edit, label) {
  const title = label.replace('…', '');
  const until = el('input', { id: 'close-until', placeholder: '18:00, 2h, 2026-12-24T08:00', autocomplete: 'off' });
  const reason = el('input', { id: 'close-why', placeholder: 'if you like' });
  const { robots } = model.site;
  const only = el('select', { id: 'close-only' }, el('option', { value: '', text: 'everybody' }), ...robots.map((robot) => el('option', { value: robot, text: robot })));
  const would = el('div', { id: 'close-preview', role: 'status' });
  const ends = edit.kind !== 'open';
  const forSome = edit.kind === 'close' && robots.length > 1;
  const asked = form({ class: 'line-form' }, make,
    ends ? el('label', {}, 'Until (empty: until it is opened) ', until) : null,
    forSome ? el('label', {}, 'For ', only) : null,
    el('label', {}, 'Why ', reason), el('button', { type: 'submit', class: 'strong', text: title }));
  const made = card('tell-card', title, would, asked);
  const wish = () => ({ ...edit, ...(ends && until.value.trim() ? { until: until.value.trim() } : {}), ...(forSome && only.value ? { only: [only.value] } : {}) });
  const preview = debounced(async () => {
    const { start, goal, robot } = model.ask;
    try {
      const answer = await post('/api/preview', { edits: [wish()], ...(start && goal ? { start, goal } : {}), ...(robot ? { robot } : {}) });
      fill(would, ...(answer.closings ?? []).map((text) => el('p', { text: `Then: ${text}.` })), el('p', { text: summary(answer).join(' ') }), thisRoute(answer));
    } catch (error) {
      fill(would, said(error));
    }
  }, WAIT);
  for (const field of [until, only]) field.addEventListener('input', preview);
  preview();
  async function make() {
    try {
      const answer = await post('/api/edits', { edit: wish(), why: reason.value.trim() || undefined });
      made.remove();
      showSaved(`${title}: done.${andRules([answer])}`, [answer.done.id]);
      await refresh(answer.generation);
    } catch (error) {
      fill(would, said(error));
    }
  }
  (ends ? until : reason).focus();
}
