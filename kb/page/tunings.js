/** Named tunings: which are on, switched with what is saved next, and in which of them cells are edited. */

import { get } from './api.js';
import { byId, el, fill, refill } from './dom.js';
import { model } from './model.js';
import { discard, put } from './pending.js';

/** Named tunings, each with its cells and whether it is on. */
export const readTunings = async () => (await get('/api/tunings')).tunings;

const switchId = (name) => `switch:${name}`;

function toggle({ tuning, on }) {
  if (model.pending.has(switchId(tuning))) return discard(switchId(tuning));
  return put(switchId(tuning), { words: `Tuning “${tuning}” ${on ? 'off' : 'on'}`, edits: [{ kind: 'switch', tuning, on: !on }] });
}

function box(of) {
  const waits = model.pending.has(switchId(of.tuning));
  const input = el('input', { type: 'checkbox', disabled: !model.may('tune'), on: { change: () => toggle(of) } });
  input.checked = of.on !== waits;
  return el('label', { class: waits ? 'waits' : null }, input, ` ${of.tuning}`);
}

/** What the boxes show, as text. */
let shown = '';

function header() {
  // A box that is made anew between the finger going down and up hears no click.
  const now = JSON.stringify([model.may('tune'), ...model.tunings.map(({ tuning, on }) => [tuning, on, model.pending.has(switchId(tuning))])]);
  if (now === shown) return;
  shown = now;
  byId('tunings').hidden = !model.tunings.length;
  refill(byId('tunings'), el('span', { text: 'Tunings' }), ...model.tunings.map(box));
}

/** Whether a tuning is on, or will be with what is saved next. */
export const isOn = (name) => Boolean(model.tunings.find(({ tuning }) => tuning === name)?.on) !== model.pending.has(switchId(name));

/** What a cell is in a tuning, the one that is edited unless another is named; undefined where that does not say it, or none is edited. */
export function inTuning(table, key, column, name = model.editIn) {
  const of = model.tunings.find(({ tuning }) => tuning === name);
  return of?.cells.find((cell) => cell.table === table && cell.key === key && cell.column === column)?.value;
}

function choice() {
  const names = model.tunings.map(({ tuning }) => tuning);
  if (model.editIn && !names.includes(model.editIn)) names.push(model.editIn);
  fill(byId('edit-in'), el('option', { value: '', text: 'in the tables' }), ...names.map((name) => el('option', { value: name, text: `in the tuning ${name}` })), el('option', { value: '/', text: 'in a new tuning…' }));
  byId('edit-in').value = model.editIn;
}

function chosen() {
  const { value } = byId('edit-in');
  byId('new-tuning').hidden = value !== '/';
  if (value === '/') byId('new-tuning').focus();
  else model.set('editIn', value);
}

function named() {
  const name = byId('new-tuning').value.trim();
  if (!name) return;
  byId('new-tuning').value = '';
  byId('new-tuning').hidden = true;
  model.set('editIn', name);
}

/** Makes the header and the choice over the tables work. */
export function startTunings() {
  byId('edit-in').addEventListener('change', chosen);
  byId('new-tuning').addEventListener('change', named);
  byId('edit-choice').hidden = !model.may('tune');
  model.on('tunings pending', header);
  model.on('tunings editIn', choice);
}
