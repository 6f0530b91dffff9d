/** What one may ask about, offered as one types it: a class, one of its objects, a property of it. */

import { get } from './api.js';
import { isOfAll } from './cells.js';
import { el, fill } from './dom.js';
import { model } from './model.js';
import { isCondition, spokenOf } from './spoken.js';

const MOST = 200;
const PARTS = /^([^.]+)\.(.*)\.([^.]+)$/u;

/** Of `/api/rules/classes`; what is missing is not offered. */
let classes = [];

/** `orders.2.total`, in its parts. */
export function parts(what) {
  const [, name, object, property] = PARTS.exec(what);
  return { class: name.toUpperCase(), object, property };
}

const classOf = (name) => classes.find(({ class: of }) => of.text === name.toUpperCase());

const ON_MAP = {
  rooms: ({ rooms }) => rooms.map(({ name }) => name),
  doors: ({ doors }) => doors.map(({ door }) => String(door)),
  spaces: () => model.weights.spaces.name,
  doorways: () => model.weights.doorways.name,
  areas: ({ areas }) => areas.map(({ name }) => name),
  named_doors: ({ named_doors: named }) => named.map(({ name }) => name),
};

function objectsOf(name) {
  const onMap = model.map && model.weights && ON_MAP[name]?.(model.map);
  return [...new Set(onMap?.length ? onMap : model.table(name)?.keys ?? [])].filter(Boolean);
}

/** What may stand in the place of what is typed. */
function offers(typed) {
  const at = typed.indexOf('.');
  if (at < 0) return classes.map(({ class: of }) => of.text.toLowerCase()).filter((name) => objectsOf(name).length).map((name) => `${name}.`);
  const [name, rest] = [typed.slice(0, at).toLowerCase(), typed.slice(at + 1)];
  const objects = objectsOf(name);
  const object = objects.filter((of) => rest.startsWith(`${of}.`)).sort((one, other) => other.length - one.length)[0];
  if (object === undefined) return objects.filter((of) => of.toLowerCase().includes(rest.toLowerCase())).map((of) => `${name}.${of}.`);
  return (classOf(name)?.properties ?? []).map(({ text }) => `${name}.${object}.${text}`);
}

// A building has spaces, a shop has orders: the example is of what there is.
function example() {
  const all = offers('');
  const name = ['spaces.', ...all].find((of) => all.includes(of) && !isOfAll(of.slice(0, -1)));
  return name && offers(offers(name)[0])[0];
}

/** The field in which one says what is asked, with what it offers. */
export function askField() {
  const list = el('datalist', { id: 'ask-offers' });
  const field = el('input', { id: 'ask-what', list: 'ask-offers', autocomplete: 'off', autocapitalize: 'off', spellcheck: 'false', required: true, size: '28' });
  const offer = () => {
    const found = offers(field.value.trim());
    fill(list, ...found.slice(0, MOST).map((value) => el('option', { value })));
    field.placeholder = example() ?? '';
  };
  field.addEventListener('input', offer);
  field.addEventListener('focus', offer);
  // One can ask without what is offered.
  get('/api/rules/classes').then((answer) => { ({ classes } = answer); offer(); }).catch(() => {});
  return el('label', {}, 'Class, object and property ', field, list);
}

/** How a question is answered, as far as the site's classes and rules say it: whether with yes or no or a number, and texts of which rules speak. */
export async function answerOf(what) {
  const { class: of, property } = parts(what);
  const kind = classOf(of)?.properties.find(({ text }) => text === property)?.detail;
  try {
    const words = await spokenOf(of, property);
    const isTruth = kind === 'true or false' || (!words.length && await isCondition(of, property));
    return { isTruth, isNumber: kind === 'a number', words };
  } catch {
    return { isTruth: kind === 'true or false', isNumber: kind === 'a number', words: [] };
  }
}
