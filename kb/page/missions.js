/** Missions that were driven: a list, of which one is looked at again. */

import { get, path } from './api.js';
import { button, byId, el, fill, refill } from './dom.js';
import { moment, time } from './format.js';
import { ended, fromTo } from './mission-words.js';
import { model } from './model.js';
import { said } from './notice.js';
import { replay } from './replay.js';

const PAGE = 20;
let shown = PAGE;

function entry(mission) {
  const { mission: number, robot, seconds, length, at } = mission;
  const again = button('Look again', () => open(number), { class: 'link', 'aria-label': `Look again at mission ${number}` });
  const whose = robot && model.site.robots.length > 1 ? `${robot} ` : '';
  return el('li', {}, el('b', { text: `${number}: ${fromTo(mission)}` }), ` ${whose}${ended(mission)} · ${time(seconds)}, ${length.toFixed(1)} m · ${moment(at)} `, again);
}

async function open(number) {
  try {
    replay(await get(`/api/missions/${number}`));
  } catch (error) {
    byId('missions').prepend(said(error));
  }
}

async function load() {
  if (!byId('missions-card').open) return;
  try {
    const { missions } = await get(path('/api/missions', { limit: shown + 1 }));
    const more = missions.length > shown ? button('Show earlier ones', () => { shown += PAGE; return load(); }) : null;
    const none = el('p', { class: 'hint', text: 'None is kept yet. A mission that a robot drives by the rules of this site, or a simulated one, can be kept with its journal; it is listed here then, to be looked at again.' });
    refill(byId('missions'), missions.length ? el('ul', { class: 'plain listed' }, ...missions.slice(0, shown).map(entry)) : none, more);
  } catch (error) {
    fill(byId('missions'), said(error));
  }
}

/** Makes the list; it is read whenever somebody opens it. */
export function startMissions() {
  byId('missions-card').addEventListener('toggle', load);
  model.on('generation', load);
}
