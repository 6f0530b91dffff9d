/** Robots where they are, as they say it, with the way that each follows and what it was told of it. */

import { get } from './api.js';
import { button, byId, el, refill } from './dom.js';
import { cost } from './format.js';
import { showAt } from './map.js';
import { called, QUIET_S } from './marks.js';
import { model } from './model.js';
import { isOpen } from './router.js';

const OFTEN_MS = 1000;
/** So many are listed; all are on the map. */
const MOST = 100;
/** Where nobody said yet where it is. */
const SELDOM_MS = 4000;

let written = '';

/** How long ago, roughly: what changes each second is not read. */
function ago(seconds) {
  if (seconds < QUIET_S) return 'just now';
  if (seconds < 60) return `${Math.floor(seconds / 10) * 10} s ago`;
  return `${Math.floor(seconds / 60)} min ago`;
}

function where({ robot, name, state, space, x, y }) {
  const kind = name && robot && name !== robot ? `${robot}, ` : '';
  return `${kind}${state ? `${state}, ` : ''}${space ? `in ${space}` : `at ${x.toFixed(1)}, ${y.toFixed(1)}`}`;
}

function wayOf({ way }) {
  if (!way) return null;
  return way.cost === null ? `no way to ${way.goal}: ${way.reason ?? 'unknown why'}` : `on its way to ${way.goal}, hardness ${cost(way.cost)}`;
}

function heard({ who, seconds, way }) {
  if (seconds < QUIET_S) return null;
  return who || !way ? `last heard ${ago(seconds)}` : `asked for its way from here ${ago(seconds)}`;
}

function toldOf({ way }) {
  return (way?.told ?? []).toReversed().map(({ seconds, words }) => el('li', { text: `${ago(seconds)}: ${words}` }));
}

function entry(robot) {
  const isLooked = robot.key === model.lookedAt;
  const told = isLooked ? toldOf(robot) : [];
  const look = () => {
    model.set('lookedAt', isLooked ? null : robot.key);
    if (!isLooked) showAt([robot.x, robot.y]);
    show();
  };
  const lines = [where(robot), robot.doing, wayOf(robot), heard(robot)].filter(Boolean).join(' · ');
  return el('li', {}, button(called(robot), look, { class: 'link', 'aria-pressed': String(isLooked) }), ` ${lines}`,
    told.length ? el('div', {}, el('p', { class: 'hint', text: 'It was told, the newest first:' }), el('ul', { class: 'plain told' }, ...told)) : null);
}

function show() {
  const { robots } = model;
  byId('robots-card').hidden = !robots.length;
  const more = robots.length - MOST;
  const list = el('ul', { class: 'plain listed' }, ...robots.slice(0, MOST).map(entry), more > 0 ? el('li', { class: 'hint', text: `and ${more} more` }) : null);
  const text = list.textContent + model.lookedAt;
  if (text === written) return;
  written = text;
  refill(byId('robots'), list);
}

async function look() {
  if (!document.hidden && isOpen('map') && document.body.dataset.connected !== 'false') {
    try {
      const { robots } = await get('/api/whereabouts');
      const keyed = robots.map((robot, at) => ({ ...robot, key: robot.name ?? `${at}` }));
      if (keyed.length || model.robots.length) model.set('robots', keyed);
    } catch {
      // An unreachable service has its own banner.
    }
  }
  setTimeout(look, model.robots.length ? OFTEN_MS : SELDOM_MS);
}

/** Makes the card; it follows for as long as the map is looked at. */
export function startRobots() {
  model.on('robots', show);
  look();
}
