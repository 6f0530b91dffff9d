/** Where the page begins: loads what there is, follows what changes. */

import { get } from './api.js';
import { button, byId, el, pressOnce } from './dom.js';
import { startEnds, lead, openEnds } from './ends.js';
import { startExperience } from './experience.js';
import { startFacts } from './facts.js';
import { startFirm } from './firm.js';
import { getFloor, getWeights } from './floor.js';
import { moment } from './format.js';
import { readLaid } from './laid.js';
import { startHistory } from './history.js';
import { startMap } from './map.js';
import { startMarks } from './marks.js';
import { startMissions } from './missions.js';
import { model } from './model.js';
import { banner, complain, where } from './notice.js';
import { startOutline } from './outline.js';
import { keepPending } from './pending.js';
import { startPicture } from './picture.js';
import { startPreview } from './preview.js';
import { refresh } from './refresh.js';
import { startRobots } from './robots.js';
import { startRoute } from './route.js';
import { address, onTab, route } from './router.js';
import { startRules } from './rules.js';
import { startSheet } from './sheet.js';
import { startSql } from './sql.js';
import { follow } from './stream.js';
import { startTables } from './table.js';
import { startTheme } from './theme.js';
import { readTunings, startTunings } from './tunings.js';

function inForce() {
  const { site, weights } = model;
  byId('site-name').textContent = site.name;
  document.body.dataset.rooms = site.layout_kind ?? site.rooms_mode;
  document.body.dataset.drawn = String(Boolean(site.layout_kind));
  if (site.rooms_mode === 'none' && !site.layout_kind) for (const name of document.querySelectorAll("nav a[href='#map'], #map > h1")) name.textContent = 'Tables';
  document.title = `${site.name} – adit`;
  const since = site.changed_at ? `, in force since ${moment(site.changed_at)}` : '';
  byId('in-force').textContent = `generation ${weights?.generation ?? site.generation}${since}`;
  problems(site.problems ?? []);
  banner('notes', site.notes?.length ? site.notes.map((text) => el('p', { text })) : null, 'note');
}

function problems(found) {
  if (!found.length) return banner('problems');
  const [first] = found;
  const name = first.file?.split('/').at(-1);
  const place = address('rules', name?.endsWith('.rhai') || name?.endsWith('.toml') ? { file: name, line: String(first.line ?? '') } : {});
  return banner('problems', [el('p', { text: `A file was saved with a mistake; the rules from before stay in force. ${where(first)}${first.message}` }), el('a', { href: place, text: 'Show it' })], 'bad');
}

let connected = null;

function connection(now) {
  if (now === connected) return;
  const back = connected === false;
  connected = now;
  document.body.dataset.connected = String(now);
  banner('connection', now ? null : el('p', { text: 'Connection lost, trying again… What you see is as it was; what you typed is kept.' }));
  if (now && back) refresh().catch(complain);
}

function heard(event, data) {
  if (event === 'hello') {
    // A service that was restarted with an older database has a lower number: look anew whenever it differs.
    if (data.generation !== model.weights?.generation) refresh();
  } else if (event === 'changed') {
    refresh(data.generation);
    model.lastChange = data;
    model.dispatchEvent(new Event('changed'));
  } else if (event === 'problems') {
    problems(data.problems);
    model.problems = data.problems;
    model.dispatchEvent(new Event('problems'));
  }
}

async function begin() {
  startTheme();
  pressOnce();
  try {
    const rest = Promise.all([getFloor(), getWeights(), get('/api/tables'), readTunings(), get('/api/facts')]);
    // A failure of the rest is heard below, when it is waited for; until then it is no stray one.
    rest.catch(() => {});
    const site = await get('/api/site');
    model.set('site', site);
    start();
    model.set('site', site);
    const laid = await readLaid();
    const [map, weights, tables, tunings, { facts }] = await rest;
    model.set('facts', facts);
    model.set('laid', laid);
    model.set('tunings', tunings);
    model.set('tables', tables);
    model.set('map', map);
    model.set('weights', weights);
    model.set('generation', weights.generation);
    keepPending();
    route();
  } catch (error) {
    complain(error);
    byId('banners').append(button('Try again', () => location.reload()));
    return;
  }
  follow(heard, connection);
  startRobots();
}

function start() {
  startSheet();
  startMap(lead);
  startPicture();
  startMarks();
  startEnds();
  startTables();
  startTunings();
  startPreview();
  startRoute();
  startFirm();
  startOutline();
  startMissions();
  startRules();
  startSql();
  startFacts();
  startExperience();
  startHistory();
  model.on('site weights', inForce);
  onTab('map', openEnds);
}

begin();
