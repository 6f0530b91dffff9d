/** Before anything is saved: what the edited cells would change, on the map and in numbers. */

import { post } from './api.js';
import { button, byId, debounced, el, fill } from './dom.js';
import { cost, count, list, value } from './format.js';
import { askFirm, firmWithin } from './firm.js';
import { model } from './model.js';
import { said } from './notice.js';
import { cellId, discard, edits, keyName } from './pending.js';
import { refresh } from './refresh.js';
import { showSaved } from './saved.js';

const WAIT = 120;
const MOST_ROUTES = 50;
let stop = null;
let failed = null;
let conflicts = new Map();

const ask = debounced(async () => {
  stop?.abort();
  const wanted = edits(false);
  if (!wanted.length) {
    failed = null;
    return model.set('preview', null);
  }
  stop = new AbortController();
  const { start, goal, robot } = model.ask;
  const body = { edits: wanted, ...(start && goal ? { start, goal } : {}), ...(robot ? { robot } : {}) };
  try {
    const answer = await post('/api/preview', body, { signal: stop.signal });
    failed = null;
    model.set('preview', answer);
  } catch (error) {
    if (error.name === 'AbortError') return undefined;
    failed = error;
    model.set('preview', null);
  }
  return undefined;
}, WAIT);

const inOneWord = (cell) => `${keyName(cell.key)} ${cell.column.replaceAll('_', ' ')} ${value(cell.old)} → ${value(cell.value)}`;

/** The counts, in the expert's terms. */
export function summary(preview) {
  const parts = [];
  const { rooms, doors, routes } = preview;
  if (preview.layout_changed) parts.push('The floor is cut into rooms anew.');
  if (doors.changed || rooms.changed) parts.push(`${list([doors.changed ? count(doors.changed, 'door') : null, rooms.changed ? count(rooms.changed, 'room') : null].filter(Boolean))} would weigh otherwise.`);
  else if (!preview.layout_changed) parts.push('No room and no door would weigh otherwise.');
  // Where there are too many to compare while somebody types, the service says how many it did.
  const compared = routes?.compared ?? routes?.total ?? 0;
  if (routes?.total && !compared) parts.push(`${count(routes.total, 'route')} between places are too many to compare while you type.`);
  else if (routes?.total) {
    const all = compared < routes.total ? `${compared} of ${count(routes.total, 'route')} between places that were compared in time` : `${count(routes.total, 'route')} between places`;
    const kinds = [['shorter', 'cheaper'], ['longer', 'dearer'], ['lost', 'lost'], ['found', 'possible at all']].filter(([name]) => routes[name]).map(([name, word]) => `${routes[name]} ${word === 'lost' ? (routes[name] === 1 ? 'is' : 'are') : routes[name] === 1 ? 'becomes' : 'become'} ${word}`);
    const ways = routes.rerouted ? `${routes.rerouted} ${routes.rerouted === 1 ? 'leads' : 'lead'} another way` : '';
    parts.push(routes.changed || routes.rerouted
      ? `Of ${all} ${list([...kinds, ways].filter(Boolean))}.`
      : `None of ${all} changes.`);
  }
  return parts;
}

function thisRoute(preview) {
  const [before, after] = [preview.before, preview.route];
  if (!before && !after) return null;
  const was = before?.cost;
  const becomes = after?.cost;
  const text = becomes === undefined || becomes === null ? 'The way that you look at would be lost.'
    : was === undefined || was === null ? `The way that you ask for would be found: cost ${cost(becomes)}.`
      : Math.abs(was - becomes) < 5e-7 * Math.max(1, was) ? `The way that you look at stays at ${cost(was)}.`
        : null;
  if (text) return el('p', { text });
  return el('p', {}, 'The way that you look at: ', el('s', { text: cost(was) }), ' ', el('b', { text: cost(becomes) }), leadsElsewhere(before, after) ? ', another way (hatched in amber)' : ', the same way');
}

const through = (route) => route.steps.map(({ place, action }) => `${place} ${action}`).join();
const leadsElsewhere = (one, other) => through(one) !== through(other);

function routeList(routes) {
  if (!routes?.list?.length) return null;
  const items = routes.list.slice(0, MOST_ROUTES).map(({ start, goal, old, new: now, other_way: other }) => el('li', {}, `${start} to ${goal}: `, el('s', { text: cost(old) }), ' ', el('b', { text: cost(now) }), other ? ' another way' : ''));
  const more = routes.list.length > MOST_ROUTES ? el('li', { text: `and ${routes.list.length - MOST_ROUTES} more` }) : null;
  return el('details', {}, el('summary', { text: 'Which routes' }), el('ul', { class: 'plain' }, ...items, more));
}

function show() {
  const cells = [...model.pending.entries()];
  const card = byId('preview-card');
  card.hidden = cells.length === 0;
  if (!cells.length) return fill(byId('preview'));
  const before = byId('save-why')?.value ?? '';
  const focused = document.activeElement?.id;
  const wrong = cells.filter(([, cell]) => cell.wrong);
  const typed = el('ul', { class: 'plain typed' }, ...cells.map(([, cell]) => el('li', { text: cell.wrong ? `${keyName(cell.key)} ${cell.column}: ${cell.wrong}` : inOneWord(cell) })));
  const { preview } = model;
  const told = failed ? [said(failed)]
    : preview ? [el('p', { id: 'preview-summary', text: summary(preview).join(' ') }), thisRoute(preview), routeList(preview.routes), firmWithin(cells.map(([, cell]) => cell))]
      : wrong.length === cells.length ? [] : [el('p', { class: 'hint', text: 'Looking what would change…' })];
  const clashes = [...conflicts].filter(([id]) => model.pending.has(id)).map(([id, error]) => conflict(id, error));
  const why = el('input', { id: 'save-why', placeholder: 'if you like', value: before });
  const who = sessionStorage.getItem('adit-token') ? null : el('label', {}, 'Your name ', el('input', { id: 'save-who', placeholder: 'for the history', autocomplete: 'name', value: localStorage.getItem('adit-who') ?? '', on: { input: (event) => localStorage.setItem('adit-who', event.target.value.trim()) } }));
  const save = button(cells.length === 1 ? 'Save' : `Save ${cells.length} cells`, saveAll, { id: 'save', class: 'strong' });
  save.disabled = wrong.length > 0 || Boolean(failed && failed.status !== 0) || clashes.length > 0;
  fill(byId('preview'), typed, ...told, ...clashes, el('label', {}, 'Why ', why), who, el('div', { class: 'buttons' }, save, button('Discard', () => { conflicts = new Map(); discard(); }, { id: 'discard' })));
  if (focused && focused !== 'discard') byId(focused)?.focus();
  return undefined;
}

function conflict(id, error) {
  const cell = model.pending.get(id);
  const theirs = error.current !== undefined ? value(error.current) : 'theirs';
  return el('div', { class: 'conflict' }, el('p', { class: 'wrong', role: 'alert', text: error.message }),
    button(`Take ${theirs}`, () => settle(id, null), { class: 'take-theirs' }),
    button(`Set ${value(cell.value)} again`, () => settle(id, error.current), { class: 'set-mine' }));
}

// Theirs: the pending edit goes. Mine: it stands on what is there now, so that saving it is no blind overwrite.
function settle(id, current) {
  conflicts.delete(id);
  if (current === null) return discard(id);
  const pending = new Map(model.pending);
  pending.set(id, { ...pending.get(id), old: current });
  model.set('pending', pending);
  return undefined;
}

async function saveAll() {
  const why = byId('save-why').value.trim() || undefined;
  const done = [];
  const words = [];
  let generation;
  for (const edit of edits(true)) {
    const id = cellId(edit.table, edit.key, edit.column);
    try {
      const answer = await post('/api/edits', { edit, why });
      done.push(answer.done.id);
      words.push(inOneWord(model.pending.get(id) ?? edit));
      generation = answer.generation;
      const pending = new Map(model.pending);
      pending.delete(id);
      model.pending = pending;
    } catch (error) {
      if (error.status === 409) conflicts.set(id, error);
      else failed = error;
    }
  }
  if (done.length) showSaved(`Saved: ${list(words)}.`, done);
  const keepFailure = failed;
  if (!model.pending.size) model.preview = null;
  // What was saved is shown as saved even before the new weights are here.
  if (done.length) {
    byId('save-why').value = '';
    await refresh(generation);
  } else if (conflicts.size) {
    await refresh();
  }
  failed = keepFailure;
  model.set('pending', new Map(model.pending));
}

/** Previews edits while they are typed; Escape discards them all. */
export function startPreview() {
  model.on('pending', () => {
    failed = null;
    if (!model.pending.size) {
      ask.cancel();
      stop?.abort();
      if (model.preview) model.set('preview', null);
    } else {
      ask();
      askFirm();
    }
    show();
  });
  model.on('preview firm', show);
  model.on('route generation', () => { if (model.pending.size) ask(); });
  byId('preview-card').addEventListener('keydown', (event) => {
    if (event.key === 'Escape') discard();
  });
  window.addEventListener('beforeunload', (event) => {
    if (model.pending.size) event.preventDefault();
  });
}
