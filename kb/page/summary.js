/** What a preview says, in the expert's terms: how much would change, which rules, routes and cells. */

import { el } from './dom.js';
import { cost, count, list, number, value } from './format.js';
import { model } from './model.js';
import { keyName } from './pending.js';
import { address, isOpen } from './router.js';

const MOST_ROUTES = 50;
const TESTS_SHOWN = 5;

/** That all tests of the rules pass, in words. */
export const allPass = (total) => (total === 1 ? 'The one test of the rules passes.' : `All ${count(total, 'test')} of the rules pass.`);

/** What becomes of the rules: their tests, and which of them decide about more or less than now. */
export function rulesTried(rules) {
  if (!rules) return null;
  const total = rules.passed + rules.failed;
  const word = rules.failed ? `${rules.failed} of ${count(total, 'test')} of the rules would fail, so this cannot be saved.` : total ? allPass(total) : 'No tests of the rules were run: there are none.';
  const failures = rules.failures.slice(0, TESTS_SHOWN).map((of) => el('li', {}, of.line ? el('a', { href: address('rules', { file: of.file, line: String(of.line) }), text: `${of.file}, line ${of.line}` }) : null, `${of.line ? ': ' : ''}${of.message}`));
  const more = rules.failures.length > TESTS_SHOWN ? el('li', { text: `and ${rules.failures.length - TESTS_SHOWN} more` }) : null;
  return el('div', { id: 'preview-rules' }, el('p', { class: rules.failed ? 'wrong' : total ? 'right' : 'hint', text: word }), failures.length ? el('ul', { class: 'plain problems' }, ...failures, more) : null, deciding(rules.decides));
}

function deciding(decides) {
  if (!decides.length) return null;
  const noun = model.site.rooms_mode === 'none' || model.site.layout_kind ? 'object' : 'room or door';
  const many = (n) => (n === 1 ? `1 ${noun}` : `${n} ${noun === 'object' ? 'objects' : 'rooms and doors'}`);
  const line = ({ rule, revises, old, new: now }) => {
    const what = revises ? changing(many, old, now) : old === null ? (now ? `new: decides about ${many(now)}` : 'new: decides about nothing yet')
      : now === null ? `gone: decided about ${many(old)}`
        : old === now ? `decides about ${many(now)}, but other ones than now` : `decides about ${many(now)}; now about ${old}`;
    return el('li', {}, el('q', { text: rule }), ` ${what}`);
  };
  return el('details', { open: decides.length <= 4 }, el('summary', { text: 'Rules that decide otherwise' }), el('ul', { class: 'plain' }, ...decides.map(line)));
}

// A rule that changes what others decide.
function changing(many, old, now) {
  if (old === null) return now ? `new: changes ${many(now)}` : 'new: changes nothing yet';
  if (now === null) return `gone: changed ${many(old)}`;
  return old === now ? `changes ${many(now)}, to other values than now` : `changes ${many(now)}; now ${old}`;
}

/** The counts, in the expert's terms. */
export function summary(preview) {
  const parts = [];
  const { rooms, doors, routes } = preview;
  if (model.site.layout_kind) {
    // there are no rooms that could change
  } else if (model.site.rooms_mode === 'none') return [preview.conclusions.length ? `${count(preview.conclusions.length, 'conclusion')} would change.` : 'No conclusion would change.'];
  // Where the floor is cut anew, a room is no longer the one that it was: there is none to count.
  if (preview.layout_changed) parts.push('The floor would be cut into rooms anew.');
  else if (doors.changed || rooms.changed) parts.push(`${list([doors.changed ? count(doors.changed, 'door') : null, rooms.changed ? count(rooms.changed, 'room') : null].filter(Boolean))} would change.`);
  else if (!model.site.layout_kind && !preview.closings?.length) parts.push('No room or door would change.');
  // Where there are too many to compare while somebody types, the service says how many it did.
  const compared = routes?.compared ?? routes?.total ?? 0;
  if (routes?.total && !compared) parts.push(`${count(routes.total, 'route')} between places are too many to compare while you type.`);
  else if (routes?.total) {
    const all = compared < routes.total ? `the ${compared.toLocaleString('en')} of ${count(routes.total, 'route')} between places that were compared in time` : `${count(routes.total, 'route')} between places`;
    const kinds = [['shorter', 'cheaper'], ['longer', 'dearer'], ['lost', 'lost'], ['found', 'possible at all']].filter(([name]) => routes[name]).map(([name, word]) => `${routes[name].toLocaleString('en')} ${word === 'lost' ? (routes[name] === 1 ? 'is' : 'are') : routes[name] === 1 ? 'becomes' : 'become'} ${word}`);
    const ways = routes.rerouted ? `${routes.rerouted.toLocaleString('en')} ${routes.rerouted === 1 ? 'leads' : 'lead'} another way` : '';
    parts.push(routes.changed || routes.rerouted
      ? `Of ${all}, ${list([...kinds, ways].filter(Boolean))}.`
      : `None of ${all} changes.`);
  }
  return parts;
}

/** What becomes of the way that is looked at. */
export function thisRoute(preview) {
  const [before, after] = [preview.before, preview.route];
  if (!before && !after) return null;
  const was = before?.cost;
  const becomes = after?.cost;
  const text = becomes === undefined || becomes === null ? 'The way that you look at would be lost.'
    : was === undefined || was === null ? `The way that you ask for would be found: cost ${cost(becomes)}.`
      : Math.abs(was - becomes) < 5e-7 * Math.max(1, was) ? `The way that you look at stays at ${cost(was)}.`
        : null;
  if (text) return el('p', { text });
  return el('p', {}, 'The way that you look at: ', el('s', { text: cost(was) }), ' ', el('b', { text: cost(becomes) }), leadsElsewhere(before, after) ? (model.site.layout_kind || !isOpen('map') ? ', another way' : ', another way (hatched in amber)') : ', the same way');
}

const through = (route) => route.steps.map(({ place, action }) => `${place} ${action}`).join();
const leadsElsewhere = (one, other) => through(one) !== through(other);

/** What files change, of which nobody typed a cell. */
export function cellList(cells) {
  const taken = new Set([...model.pending.values()].flatMap((item) => item.edits ?? []).filter(({ kind }) => kind === 'take').map(({ table }) => table));
  const changed = cells.filter(({ table }) => taken.has(table));
  if (!changed.length) return null;
  const items = changed.slice(0, MOST_ROUTES).map(({ key, column, old, new: now }) => el('li', {}, `${keyName(key)} ${column.replaceAll('_', ' ')}: `, el('s', { text: value(old) }), ' ', el('b', { text: value(now) })));
  const more = changed.length > MOST_ROUTES ? el('li', { text: `and ${changed.length - MOST_ROUTES} more` }) : null;
  return el('details', { id: 'preview-cells', open: changed.length <= 4 }, el('summary', { text: `${count(changed.length, 'cell')} would change` }), el('ul', { class: 'plain' }, ...items, more));
}

/** What would be worth a look: cells that name nothing, places at which no robot fits, kinds of which no rule speaks. */
export function noteList(notes) {
  return notes?.length ? el('ul', { class: 'plain wrong' }, ...notes.map((text) => el('li', { text }))) : null;
}

export function conclusionList(conclusions) {
  if (!conclusions?.length) return null;
  const items = conclusions.slice(0, MOST_ROUTES).map(({ what, property, old, new: now }) => el('li', {}, `${what}: ${property.replaceAll('_', ' ')} `, el('s', { text: shown(old) }), ' ', el('b', { text: shown(now) })));
  const more = conclusions.length > MOST_ROUTES ? el('li', { text: `and ${conclusions.length - MOST_ROUTES} more` }) : null;
  return el('ul', { class: 'plain' }, ...items, more);
}

const shown = (of) => (typeof of === 'number' ? number(of) : value(of));

export function routeList(routes) {
  if (!routes?.list?.length) return null;
  const items = routes.list.slice(0, MOST_ROUTES).map(({ start, goal, old, new: now, other_way: other }) => el('li', {}, `${start} to ${goal}: `, el('s', { text: cost(old) }), ' ', el('b', { text: cost(now) }), other ? ' another way' : ''));
  const more = routes.list.length > MOST_ROUTES ? el('li', { text: `and ${routes.list.length - MOST_ROUTES} more` }) : null;
  return el('details', {}, el('summary', { text: 'Which routes' }), el('ul', { class: 'plain' }, ...items, more));
}
