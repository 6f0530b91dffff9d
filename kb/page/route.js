/** The card of the present way: what to do, one after the other, and what each costs. */

import { why, whyOnTheWay } from './answers.js';
import { button, byId, copy, el, fill } from './dom.js';
import { firmButton } from './firm.js';
import { action, cost, metres, taken } from './format.js';
import { model } from './model.js';
import { said } from './notice.js';
import { Actions } from './palette.js';
import { address } from './router.js';
import { asSql, middle, runs, sentence, stepText, telling, why as whyOf } from './runs.js';

const opened = new Set();

function colours() {
  const table = model.table('robots');
  const at = table?.columns.findIndex(({ name }) => name === 'action') ?? -1;
  return new Actions([...(at < 0 ? [] : table.rows.map((row) => row[at])), ...(model.weights?.rooms.action ?? [])]);
}

function item(all, index, route, actions) {
  const run = all[index];
  const line = el('span', { class: 'line-swatch', 'aria-hidden': 'true' });
  line.style.setProperty('--fill', actions.colour(run.action));
  const steps = el('ol', { class: 'steps' }, ...run.steps.map((step) => el('li', {}, el('button', { type: 'button', class: 'link', text: stepText(step), on: { click: () => why(whyOf(step)) } }), ` ${cost(step.hardness)}`)));
  const details = el('details', { open: opened.has(index) }, el('summary', {}, `${run.steps.length} step${run.steps.length === 1 ? '' : 's'}`), steps);
  details.addEventListener('toggle', () => (details.open ? opened.add(index) : opened.delete(index)));
  return el('li', {}, el('div', { class: 'run' }, el('b', {}, line, action(run.action)), el('span', { class: 'where', text: sentence(all, index, route.goal) }), el('span', { class: 'cost', text: cost(run.cost) })),
    el('div', { class: 'run-more' }, details, button('Why?', () => whyOnTheWay(`Why ${action(run.action)} here?`, model.site.layout_kind ? null : middle(run, route), telling(run)), { class: 'quiet', 'aria-label': `Why ${action(run.action)} here?` })));
}

function copies(route) {
  return el('div', { class: 'buttons' },
    button('Copy link', (event) => copy(new URL(address('map', model.ask), location.href).href, event.target), { class: 'quiet' }),
    button('Copy SQL', (event) => copy(asSql(route), event.target), { class: 'quiet' }),
    button('Copy JSON', (event) => copy(JSON.stringify(route, null, 2), event.target), { class: 'quiet' }));
}

function show() {
  const { route, ask } = model;
  const title = byId('route-title');
  if (!route) {
    title.textContent = 'The way';
    const what = ask.start ? 'Now say where to: click the map, or type a name.' : 'Say from where: click the map, or type a name above it.';
    return fill(byId('route'), el('p', { class: 'hint', text: what }));
  }
  if (route.error) {
    title.textContent = 'The way';
    return fill(byId('route'), said(route.error));
  }
  title.replaceChildren(`${route.start} to ${route.goal}`, el('span', { class: 'total', text: cost(route.cost) }));
  if (route.status === 'no_route') return fill(byId('route'), el('p', { class: 'wrong', role: 'status', text: 'There is no way.' }), el('p', { text: route.reason ?? '' }));
  const all = runs(route);
  const actions = colours();
  const far = route.distance === undefined ? '' : `, ${metres(route.distance)}`;
  const takes = taken(route.measures, model.site?.measures);
  const about = takes ? `, takes about ${takes}` : '';
  const same = route.status === 'same_room' ? el('p', { class: 'hint', text: 'Start and goal lie in the same room.' }) : null;
  return fill(byId('route'), el('p', { class: 'hint', text: `${route.robot}: cost ${cost(route.cost)}${far}${about}, ${route.steps.length} steps` }), same,
    el('ol', { class: 'runs' }, ...all.map((_, index) => item(all, index, route, actions))), model.site.layout_kind ? null : el('div', { class: 'buttons' }, button('Why this way?', () => whyOnTheWay(`Why does the way from ${route.start} to ${route.goal} lead as it does?`, null, null), { class: 'quiet' }), firmButton()), copies(route));
}

/** Keeps the card up to date. */
export function startRoute() {
  model.on('route', show);
  model.on('ask', () => opened.clear());
}
