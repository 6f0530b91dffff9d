/** How firm the way is: for each number of the tables, between which values it stays the best. */

import { get, path } from './api.js';
import { button, byId, debounced, el, fill } from './dom.js';
import { cost, number } from './format.js';
import { model } from './model.js';
import { said } from './notice.js';
import { keyName } from './pending.js';

let wanted = false;
let asked = '';
let stop = null;
let isPaused = false;

/** Asks how firm the present way is, unless that is known. */
export const askFirm = debounced(async () => {
  const { start, goal, robot } = model.ask;
  if (isPaused || model.route?.status !== 'ok') return;
  const question = JSON.stringify([start, goal, robot, model.weights?.generation]);
  if (question === asked) return;
  asked = question;
  stop?.abort();
  stop = new AbortController();
  try {
    const answer = await get(path('/api/firm', { start, goal, robot }), { signal: stop.signal });
    if (asked === question) model.set('firm', answer);
  } catch (error) {
    if (asked === question) model.set('firm', { error, cells: [] });
  }
}, 200);

/** What takes the service long stands back while a preview is waited for. */
export function pauseFirm() {
  isPaused = true;
  asked = '';
  stop?.abort();
}

/** Goes on where it stood back: with what somebody asked for, or would have beside the cells that are edited. */
export function resumeFirm() {
  isPaused = false;
  if (wanted || model.pending.size) askFirm();
}

const name = (cell) => `${keyName(cell.key)} ${cell.column.replaceAll('_', ' ')}`;

// A hardness is never below 0, so an interval from there has no lower end.
const free = (cell) => !cell.low && cell.high === null;

function span(cell) {
  if (free(cell)) return 'any value';
  if (!cell.low) return `up to ${number(cell.high)}`;
  return cell.high === null ? `from ${number(cell.low)} up` : `between ${number(cell.low)} and ${number(cell.high)}`;
}

/** For the cells that are being edited: between which values the way stays the best. Null where nothing is known. */
export function firmWithin(cells) {
  const found = cells.map((cell) => model.firm?.cells.find((firm) => firm.table === cell.table && firm.key === cell.key && firm.column === cell.column)).filter(Boolean);
  if (!found.length) return null;
  return el('p', { class: 'firm-within' }, ...found.flatMap((cell) => ['The way below stays the best ', free(cell) ? 'whatever the value of ' : 'with ', el('b', { text: free(cell) ? name(cell) : `${name(cell)} ${span(cell)}` }), '. ']));
}

// The bar reaches from 0 to twice the present value, or to what is beyond the interval's end.
function bar(cell) {
  const reach = Math.max(cell.value * 2, (cell.high ?? 0) * 1.2, (cell.low ?? 0) * 1.2, 1e-9);
  const share = (value) => `${Math.min(100, (100 * value) / reach).toFixed(1)}%`;
  const made = el('div', { class: 'bar', 'aria-hidden': 'true' }, el('span', { class: 'within' }), el('span', { class: 'at' }));
  made.style.setProperty('--low', share(cell.low ?? 0));
  made.style.setProperty('--high', cell.high === null ? '100%' : share(cell.high));
  made.style.setProperty('--at', share(cell.value));
  return made;
}

function beyond(word, end, other) {
  if (!other || end === null) return null;
  return el('p', { class: 'hint', text: `${word} ${number(end)}: ${other.way}${other.cost_at_end === null || other.cost_at_end === undefined ? '' : ` (cost ${cost(other.cost_at_end)})`}` });
}

function show() {
  const card = byId('firm-card');
  card.hidden = !wanted || model.route?.status !== 'ok';
  if (card.hidden) return;
  if (!model.firm) return fill(byId('firm'), el('p', { class: 'hint', text: 'Trying other values…' }));
  if (model.firm.error) return fill(byId('firm'), said(model.firm.error));
  const bounded = model.firm.cells.filter((cell) => !free(cell));
  const others = model.firm.cells.filter(free);
  const items = bounded.map((cell) => el('li', {}, el('b', { text: name(cell) }), ` is ${number(cell.value)}; the way stays the best ${cell.exact === false ? 'about ' : ''}${span(cell)}.`, bar(cell), beyond('Below', cell.low, cell.below), beyond('Above', cell.high, cell.above)));
  const rest = others.length ? el('p', { class: 'hint', text: `Whatever the value of ${others.map(name).join(', ')}, this way stays the best.` }) : null;
  fill(byId('firm'), el('ul', { class: 'plain firm' }, ...items), rest);
  return undefined;
}

/** The button that asks, for the card of the route. */
export function firmButton() {
  return button('How firm is this?', () => {
    wanted = true;
    show();
    askFirm();
    byId('firm-card').scrollIntoView({ block: 'nearest' });
  }, { id: 'how-firm' });
}

/** Keeps the card up to date. */
export function startFirm() {
  model.on('firm', show);
  model.on('generation ask', () => {
    asked = '';
    model.firm = null;
  });
  model.on('route', () => {
    if (wanted || model.pending.size) askFirm();
    show();
  });
}
