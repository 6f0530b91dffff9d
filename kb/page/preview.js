/** Before anything is saved: what all that is edited would change together, on the map and in numbers. */

import { post } from './api.js';
import { clashes, isClashing } from './clashes.js';
import { button, byId, debounced, el, fill, focusStays, keep } from './dom.js';
import { drafts, loadFiles, rebase } from './drafts.js';
import { reopen } from './draw.js';
import { count, list, value } from './format.js';
import { firmWithin, pauseFirm, resumeFirm } from './firm.js';
import { model } from './model.js';
import { said } from './notice.js';
import { cells, discard, edits, keyName, restore } from './pending.js';
import { refresh } from './refresh.js';
import { andThen, focusSaved, forgetSaved, showSaved } from './saved.js';
import { cellList, conclusionList, noteList, routeList, rulesTried, summary, thisRoute } from './summary.js';
import { previewOf } from './tried.js';
import { isOn } from './tunings.js';

const WAIT = 80;
const QUICK = 30;
const THOROUGH = 5000;
let stop = null;
let failed = null;
let refused = null;
/** The edits, as text, that the preview on the screen is of. */
let previewed = '';
let saving = false;

const question = () => JSON.stringify(edits(false));
const isPreviewed = () => Boolean(model.preview) && previewed === question();

const ask = debounced(async () => {
  stop?.abort();
  if (saving) return undefined;
  const wanted = edits(false);
  if (!wanted.length) {
    failed = null;
    return model.set('preview', null);
  }
  pauseFirm();
  const mine = new AbortController();
  stop = mine;
  const asked = question();
  try {
    const answer = await previewOf(wanted, { patience_ms: QUICK }, { signal: mine.signal });
    failed = null;
    previewed = asked;
    model.set('refusal', null);
    model.set('preview', answer);
    resumeFirm();
    // The first answer is quick; the whole comparison follows while nobody types.
    if (answer.routes?.truncated) model.set('preview', await previewOf(wanted, { patience_ms: THOROUGH }, { signal: mine.signal }));
  } catch (error) {
    if (error.name === 'AbortError' || asked !== question()) return undefined;
    failed = error;
    model.set('preview', null);
    model.set('refusal', error);
  } finally {
    // Where it was broken off for another one, that one goes before, too.
    if (stop === mine) resumeFirm();
  }
  return undefined;
}, WAIT);

const inOneWord = (item) => item.words ?? `${keyName(item.key)} ${item.column.replaceAll('_', ' ')} ${value(item.old)} → ${item.tuning && item.value === null ? 'as in the tables' : value(item.value)}${item.tuning ? ` in the tuning “${item.tuning}”${isOn(item.tuning) ? '' : ', which is off'}` : ''}`;
const isWrong = (item) => `${item.words ?? `${keyName(item.key)} ${item.column}`}: ${item.wrong}`;

// Made once: a button that is replaced while somebody presses it does nothing, and a field loses what is typed.
let card = null;

function makeCard() {
  const made = {
    typed: el('ul', { class: 'plain typed' }),
    items: new Map(),
    told: el('div', { id: 'preview-told' }),
    refused: el('div'),
    clashes: el('div'),
    why: el('input', { id: 'save-why', placeholder: 'if you like' }),
    who: el('input', { id: 'save-who', placeholder: 'for the history', autocomplete: 'name', value: localStorage.getItem('adit-who') ?? '' }),
    save: el('button', { type: 'button', id: 'save', class: 'strong', 'aria-keyshortcuts': 'Control+Enter', on: { click: () => saveAll(isPreviewed()) } }),
    unseen: el('button', { type: 'button', id: 'save-unseen', text: 'Save without a preview', on: { click: () => saveAll(isPreviewless()) } }),
    discard: button('Discard', discardAll, { id: 'discard' }),
    hint: el('span', { class: 'hint', text: 'Ctrl-Enter saves, too.' }),
  };
  made.whose = el('label', {}, 'Your name ', made.who);
  // Escape takes back what was typed here, never what waits.
  let before = '';
  made.why.addEventListener('focus', () => { before = made.why.value; });
  made.why.addEventListener('keydown', (event) => { if (event.key === 'Escape') made.why.value = before; });
  made.who.addEventListener('input', () => localStorage.setItem('adit-who', made.who.value.trim()));
  fill(byId('preview'), made.typed, made.clashes, made.told, made.refused, el('label', {}, 'Why ', made.why), made.whose, el('div', { class: 'buttons' }, made.save, made.unseen, made.discard, made.hint));
  return made;
}

function discardAll() {
  const gone = model.pending;
  if (!gone.size) return;
  discard();
  showSaved(`Discarded: ${count(gone.size, 'change')}.`, [], { text: 'Undo', act: () => {
    forgetSaved();
    restore(gone);
    byId('preview-title').focus();
  } });
  focusSaved();
}

/** Takes one edit back; who does it by keys goes on in the tray. */
function leave(id) {
  discard(id);
  if (model.pending.size) (card.typed.querySelector('button:not([hidden])') ?? byId('preview-title')).focus();
}

function told() {
  const { preview } = model;
  if (failed) return [said(failed)];
  if (preview) return [el('p', { id: 'preview-summary', text: summary(preview).join(' ') }), thisRoute(preview), noteList(preview.notes), rulesTried(preview.rules), cellList(preview.cells), conclusionList(preview.conclusions), routeList(preview.routes), firmWithin(cells().map(([, cell]) => cell))];
  return [...model.pending.values()].every((item) => item.wrong) ? [] : [el('p', { class: 'hint', text: 'Looking what would change…' })];
}

const listItem = (id) => el('li', {}, el('span'), button('Drop it', () => leave(id), { class: 'link' }), button('Change', () => reopen(id, model.pending.get(id)), { class: 'link' }));

// One item stays one element: a button that is replaced while somebody presses it does nothing.
function listItems() {
  const { items } = card;
  for (const id of [...items.keys()]) if (!model.pending.has(id)) items.delete(id);
  for (const [id, item] of model.pending) {
    if (!items.has(id)) items.set(id, listItem(id));
    const [text, leave, change] = items.get(id).children;
    change.hidden = !item.shape || item.shape.gone || item.shape.open;
    change.setAttribute('aria-label', `Change: ${item.words}`);
    text.textContent = item.wrong ? isWrong(item) : inOneWord(item);
    leave.setAttribute('aria-label', `Drop it: ${text.textContent}`);
    leave.hidden = model.pending.size === 1;
  }
  keep(card.typed, [...items.values()]);
}

function show() {
  place();
  const { size } = model.pending;
  byId('preview-card').hidden = size === 0;
  if (!size) return;
  card ??= makeCard();
  listItems();
  fill(card.told, ...told());
  card.told.setAttribute('aria-busy', String(Boolean(model.preview) && !isPreviewed()));
  fill(card.refused, refused ? said(refused) : null);
  // What is being saved is another one until all is loaded.
  keep(card.clashes, saving ? [] : clashes());
  card.whose.hidden = Boolean(sessionStorage.getItem('adit-token'));
  card.save.textContent = size === 1 ? 'Save' : `Save all ${size}`;
  card.save.disabled = !maySave() || !isPreviewed();
  card.unseen.hidden = !isPreviewless();
  card.unseen.disabled = !maySave();
}

const maySave = () => !saving && !model.preview?.rules?.failed && !isClashing() && ![...model.pending.values()].some(({ wrong }) => wrong);

// What would change cannot be told: too large, too late. Whoever saves it all the same has to say so.
const isPreviewless = () => Boolean(failed && failed.status >= 500);

const isSame = (one, other) => JSON.stringify([one?.edits, one?.value]) === JSON.stringify([other.edits, other.value]);

/** Saves all, in one transaction; `isKnown` says whether it was on the screen what that would change, or that it cannot be told. */
async function saveAll(isKnown) {
  if (!isKnown || !maySave()) return;
  saving = true;
  // Whether more routes would change is not worth the wait any more.
  stop?.abort();
  const hadFocus = byId('preview-card').contains(document.activeElement);
  const stays = focusStays();
  show();
  const sent = new Map(model.pending);
  const wanted = edits(true);
  const [only] = wanted;
  const edit = wanted.length === 1 ? only : { kind: 'together', edits: wanted };
  let keepRefusal = null;
  try {
    const answer = await post('/api/edits', { edit, why: card.why.value.trim() || undefined });
    // What was saved is shown as saved even before the new weights are here; what was typed meanwhile waits.
    model.pending = new Map([...model.pending].filter(([id, item]) => !isSame(sent.get(id), item)).map(([id, item]) => [id, item.column !== undefined && sent.has(id) ? { ...item, old: sent.get(id).value } : item]));
    const saved = [...sent.values()].flatMap(({ draft }) => draft ?? []);
    if (saved.length) await loadFiles();
    // What was typed meanwhile goes on from what was saved.
    for (const { file } of saved) rebase(file);
    if (!model.pending.size) model.preview = null;
    card.why.value = '';
    showSaved(`Saved: ${list([...sent.values()].map(inOneWord))}.${andThen([answer])}`, [answer.done.id]);
    if (hadFocus && stays()) focusSaved();
    // A tuning that is off changes nothing but itself.
    await refresh(answer.generation === model.weights?.generation ? undefined : answer.generation);
  } catch (error) {
    if (error.status === 409) await refresh();
    if (error.status === 409 && drafts().length) await loadFiles();
    if (!isClashing()) keepRefusal = error;
  }
  saving = false;
  model.set('pending', new Map(model.pending));
  // What the service refused is said until it is edited again.
  refused = keepRefusal;
  show();
}

/** Ctrl-Enter: saves what the preview on the screen is of; a preview that is there and not in sight comes into it first. */
function saveBySign(event) {
  if (event.key !== 'Enter' || !(event.ctrlKey || event.metaKey)) return;
  // A query is run by it, and a question that is open comes first.
  if (event.defaultPrevented || document.querySelector('dialog[open]')) return;
  event.preventDefault();
  if (event.repeat || !isPreviewed()) return;
  if (isInSight()) saveAll(true);
  else byId('preview-summary').scrollIntoView({ block: 'center' });
}

// Within the card, too, which may be scrolled, and of which Save covers the lower end.
function isInSight() {
  const { top, bottom } = byId('preview-summary').getBoundingClientRect();
  const least = Math.max(0, byId('preview-card').getBoundingClientRect().top);
  return top >= least && bottom <= Math.min(window.innerHeight, card.save.parentElement.getBoundingClientRect().top + 1);
}

// What is edited is not to lie under the tray, which grows while its preview comes.
function keepInSight() {
  const tray = byId('preview-card').getBoundingClientRect();
  document.documentElement.style.setProperty('--tray', `${tray.height}px`);
  if (!byId('tables').contains(document.activeElement)) return;
  const { top, bottom } = document.activeElement.getBoundingClientRect();
  if (bottom > tray.top && top < tray.bottom) document.activeElement.scrollIntoView({ block: 'nearest' });
}

/** Previews edits while they are typed; Ctrl-Enter saves them, wherever the focus is. */
export function startPreview() {
  model.on('pending', () => {
    failed = null;
    refused = null;
    if (!model.pending.size) {
      ask.cancel();
      stop?.abort();
      if (model.preview) model.set('preview', null);
    } else {
      ask();
    }
    show();
  });
  model.on('preview firm tables tunings', show);
  model.on('route generation', () => { if (model.pending.size) ask(); });
  document.addEventListener('keydown', saveBySign);
  new ResizeObserver(keepInSight).observe(byId('preview-card'));
  model.on('generation changed problems', follow);
  window.addEventListener('hashchange', () => setTimeout(show));
  place();
  follow();
}

// There is one tray: it goes to the page that is open.
function place() {
  const open = document.querySelector('[data-tab]:not([hidden])');
  const slot = open?.querySelector('.tray');
  if (!slot || byId('preview-card').parentElement === slot) return;
  slot.append(byId('preview-card'));
  // Beside the map what was saved is said above the tables.
  if (slot.parentElement.matches('.side-column')) slot.parentElement.prepend(byId('saved'));
  else slot.prepend(byId('saved'));
}

/** Looks whether files of drafts were saved by somebody else. */
async function follow() {
  if (!drafts().length) return;
  try {
    await loadFiles();
    show();
  } catch {
    // An unreachable service has its own banner.
  }
}
