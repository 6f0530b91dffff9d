/** From where to where: the form over the map, its link, and the question to the service. */

import { ApiError, get, path } from './api.js';
import { button, byId, el, fill } from './dom.js';
import { complain, said } from './notice.js';
import { model } from './model.js';
import { isOpen, remember } from './router.js';
import { endOf } from './thing.js';

// Above this, the list of suggestions holds places only: a browser shows thousands badly.
const MOST_ROOMS = 500;
const MOST_PLACES = 200;

let asked = 0;
/** The ends of the way that is on the screen. */
let shown = null;

/** Asks for the route of the present ends, and gives it; the newest question counts. */
export async function askRoute() {
  const { start, goal, robot } = model.ask;
  asked += 1;
  const mine = asked;
  if (!start || !goal) return model.set('route', null);
  try {
    const answer = await get(path('/api/route', { start, goal, robot }));
    if (mine !== asked) return undefined;
    shown = model.ask;
    model.set('route', answer);
  } catch (error) {
    if (mine !== asked) return undefined;
    if (error instanceof ApiError && error.status >= 400 && error.status < 500) refuse(error);
    else if (error.status !== 0) complain(error);
  }
  return undefined;
}

const UNKNOWN = { 'route/unknown-start': 'start', 'route/unknown-goal': 'goal' };
const MOST_GUESSES = 3;

/** Says beside the fields what is wrong with them. The way that is on the screen stays, and so does what was typed. */
function refuse(error) {
  const wrong = UNKNOWN[error.code];
  if (wrong) byId(wrong).setAttribute('aria-invalid', 'true');
  fill(byId('ends-said'), said(error), wrong ? guesses(wrong) : null);
  if (!shown || shown === model.ask || !model.route || model.route.error) return model.set('route', { error });
  model.set('ask', shown);
  if (isOpen('map')) remember('map', shown);
  return model.set('route', model.route);
}

/** Places whose names are like what was typed. */
function guesses(end) {
  const typed = model.ask[end].toLowerCase();
  const like = model.map.places.map(({ place }) => place).filter((place) => place.toLowerCase().includes(typed) || typed.includes(place.toLowerCase()));
  if (!like.length) return null;
  return el('p', {}, 'Did you mean ', ...like.slice(0, MOST_GUESSES).flatMap((name, at) => [at ? ' or ' : null, button(name, () => {
    byId(end).focus();
    return setEnds({ ...typedEnds(), [end]: name });
  }, { class: 'link' })]), '?');
}

const typedEnds = () => ({ start: byId('start').value.trim(), goal: byId('goal').value.trim(), robot: model.site.robots.length > 1 ? byId('robot').value : '' });

/** Sets the ends, shows them in the form and in the address, and asks. */
export function setEnds(ends) {
  model.set('ask', { ...model.ask, ...ends });
  const { start, goal, robot } = model.ask;
  byId('start').value = start;
  byId('goal').value = goal;
  if (robot) byId('robot').value = robot;
  fill(byId('ends-said'));
  for (const end of ['start', 'goal']) byId(end).removeAttribute('aria-invalid');
  model.set('whyNot', null);
  model.set('firm', null);
  if (isOpen('map')) remember('map', model.ask);
  return askRoute();
}

/** Leads the start or the goal to what was clicked. */
export const lead = (end, thing) => setEnds({ [end]: endOf(thing) });

// The two places that lie farthest apart: the way between them shows most of the floor.
function farApart(places) {
  let best = [places[0]?.place ?? '', model.site.layout_kind ? places[1]?.place ?? '' : ''];
  let most = 0;
  for (const one of places) {
    for (const other of places) {
      const far = Math.hypot(one.x - other.x, one.y - other.y);
      if (far > most) [most, best] = [far, [one.place, other.place]];
    }
  }
  return best;
}

/** Opens what a link says; without a link, a way between two places, so that there is something to see. */
export function openEnds(params) {
  const said = { start: params.get('start') ?? '', goal: params.get('goal') ?? '', robot: params.get('robot') ?? '' };
  if (!said.start && !said.goal && !model.ask.start && !model.ask.goal) {
    [said.start, said.goal] = farApart(model.map.places.slice(0, MOST_PLACES));
  }
  if (said.start || said.goal) return setEnds({ ...said, robot: said.robot || model.ask.robot });
  if (model.ask.start || model.ask.goal) remember('map', model.ask);
  return undefined;
}

function known() {
  const { places, rooms } = model.map;
  const names = [...places.map(({ place }) => place), ...(rooms.length <= MOST_ROOMS ? rooms.map(({ name }) => name) : [])];
  fill(byId('ends-known'), ...names.map((value) => el('option', { value })));
}

function robots() {
  const names = model.site.robots;
  byId('robot-choice').hidden = names.length < 2;
  if (byId('robot').options.length === names.length) return;
  fill(byId('robot'), ...names.map((value) => el('option', { value, text: value })));
  if (names.length > 1 && !model.ask.robot) model.ask.robot = names[0];
}

/** Makes the form work. */
export function startEnds() {
  model.on('map', known);
  model.on('site', robots);
  byId('ends').addEventListener('submit', (event) => {
    event.preventDefault();
    setEnds(typedEnds());
  });
  byId('robot').addEventListener('change', () => setEnds(typedEnds()));
  byId('swap').addEventListener('click', () => setEnds({ start: model.ask.goal, goal: model.ask.start }));
}
