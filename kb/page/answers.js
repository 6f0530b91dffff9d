/** The cards beside the map: why something is so, and why not that way. */

import { get, path } from './api.js';
import { titleOf } from './cells.js';
import { button, byId, el, fill, focusStays, shut } from './dom.js';
import { edit, files, loadFiles, names, textOf } from './drafts.js';
import { action, cost, list, number, value } from './format.js';
import { model } from './model.js';
import { said } from './notice.js';
import { keyName } from './pending.js';
import { address } from './router.js';

/** Where tests that are made on the page stand. */
const MADE = 'tests/made.toml';

/**
 * A card beside the map; one of its kind that is there goes. It takes the focus, and comes into sight, where that is wanted:
 * not from under the hand of somebody who has gone on since they asked.
 */
export function card(id, title, content, isWanted = () => true) {
  const takes = isWanted() || Boolean(byId(id)?.contains(document.activeElement));
  byId(id)?.remove();
  const heading = el('h2', { text: title, tabindex: '-1' });
  const close = shut('this', () => {
    if (id === 'why-not-card') model.set('whyNot', null);
    byId(id).remove();
    byId('canvas').focus({ preventScroll: true });
  });
  const made = el('section', { class: 'card answer', id, 'aria-label': title }, close, heading, ...content);
  byId('answers').prepend(made);
  if (takes) {
    made.scrollIntoView({ block: 'nearest' });
    heading.focus({ preventScroll: true });
  }
  return made;
}

/** A link to the line of a rule. */
export function ruleLink(rule, file, line) {
  if (!file) return el('q', { text: rule });
  const name = file.split('/').at(-1);
  return el('a', { href: address('rules', { file: name, line: String(line ?? '') }), text: `${rule}` });
}

const WORDS = { passable: 'may be passed' };

function conclusion(of, facts) {
  const what = `${WORDS[of.property] ?? of.property}: ${typeof of.value === 'number' && of.property !== 'passable' ? number(of.value) : of.property === 'passable' ? value(Boolean(of.value)) : of.property === 'action' ? action(of.value) : value(of.value)}`;
  const because = el('span', {}, ', by the rule ', ruleLink(of.rule, of.file, of.line));
  const witness = Object.entries(of.witness ?? {}).map(([variable, object]) => (variable === 'revised by' ? changedBy(object) : el('li', {}, el('b', { text: variable }), ` is ${called(object)}`, el('span', { class: 'hint', text: propertiesOf(object, facts) }))));
  return el('li', {}, el('b', { text: what }), of.rule ? because : null, of.rule || !of.why ? null : ` (${of.why})`, witness.length ? el('ul', { class: 'plain' }, ...witness) : null);
}

const changedBy = (rules) => el('li', {}, 'changed after that by ', ...[rules].flat().flatMap((rule, at) => [at ? ', ' : '', el('q', { text: rule })]));

/** An object as people call it: `SQUAT of Robot states`, `room 22`. */
function called(object) {
  const [of, ...rest] = String(object).split(' ');
  const key = rest.join(' ');
  const table = model.table(of.toLowerCase());
  if (table) return `${keyName(key)} of ${titleOf(table.table)}`;
  return `${of.toLowerCase().replaceAll('_', ' ').replace(/s$/, '')} ${key}`;
}

function propertiesOf(object, facts) {
  const found = facts?.find((fact) => `${fact.class} ${fact.key}` === object);
  // What its key says is said already.
  const parts = String(found?.key ?? '').split('/');
  const known = Object.entries(found?.properties ?? {}).filter(([, of]) => !parts.includes(String(of))).map(([name, of]) => `${name.replaceAll('_', ' ')} ${name === 'action' ? action(of) : typeof of === 'number' ? number(of) : value(of)}`);
  return known.length ? `: ${known.join(', ')}` : '';
}

/** Asks why something is as it is, and shows it. @param {string} what `door 7`, `room d` */
export async function why(what) {
  const stays = focusStays();
  try {
    const answer = await get(path('/api/why', { what }));
    card('why-card', `Why is ${answer.name ?? what} as it is?`, reasonsOf(answer, what), stays);
  } catch (error) {
    card('why-card', `Why is ${what} as it is?`, [said(error)], stays);
  }
}

function reasonsOf(answer, what) {
  const facts = answer.facts ?? [];
  const told = answer.conclusions.length ? [] : [el('p', { text: 'No rule says anything of it.' })];
  return [...told, el('ul', { class: 'reasons' }, ...answer.conclusions.map((of) => conclusion(of, facts))), lone(facts, answer), testOf(answer, what)];
}

/**
 * Asks why the robot does on its way what it does: first what keeps it from what is easier, then what rules say beneath.
 * @param {string} title the question
 * @param {?string} at where on the way; null is all of it
 * @param {?string} what the room or door of which rules speak there
 */
export async function whyOnTheWay(title, at, what) {
  const stays = focusStays();
  const { start, goal, robot } = model.ask;
  const busy = card('why-card', title, [el('p', { class: 'hint', text: 'Looking…' })], stays);
  // A map of which no such question can be asked has rules all the same.
  const [way, rules] = await Promise.allSettled([get(path('/api/why', { start, goal, robot, ...(at ? { at } : {}) })), what ? get(path('/api/why', { what })) : null]);
  if (!busy.isConnected) return;
  const sentences = (way.value?.sentences ?? []).map((text) => el('p', { class: 'sentence', text }));
  const beneath = rules.status === 'rejected' ? [said(rules.reason)] : rules.value ? reasonsOf(rules.value, what) : [];
  const failed = way.status === 'rejected' && !beneath.length ? [said(way.reason)] : [];
  const under = beneath.length ? [el('details', { open: !sentences.length }, el('summary', { text: `What rules say of ${rules.value?.name ?? what}` }), ...beneath)] : [];
  card('why-card', title, [...sentences, ...failed, ...under], stays);
}

// What rules say of it now, as a test that stands in the tray with all else.
function testOf(answer, what) {
  if (!model.may('rules') || !answer.conclusions.some(({ rule }) => rule)) return null;
  const saidHere = el('div', { role: 'status' });
  const make = button('Make a test of it', async () => {
    try {
      const test = await get(path('/api/rules/test', { what }));
      if (!files.size) await loadFiles();
      const before = names().includes(MADE) ? textOf(MADE) : '';
      edit(MADE, `${before ? `${before.trimEnd()}\n\n` : ''}${test.text}`);
      const fails = test.failures.length ? el('p', { class: 'wrong', text: `By itself the test fails, since more than is given in it plays a part: ${test.failures[0].message}` }) : null;
      fill(saidHere, fails, el('p', {}, `It is in the tray, at the end of ${MADE}. `, el('a', { href: address('rules', { file: MADE }), text: 'Read it' })));
    } catch (error) {
      fill(saidHere, said(error));
    }
    saidHere.scrollIntoView({ block: 'nearest' });
  }, { id: 'make-test' });
  return el('div', {}, make, saidHere);
}

// Facts that are no rule's witness: what was told of the object itself.
function lone(facts, answer) {
  const named = new Set(answer.conclusions.flatMap((of) => Object.values(of.witness ?? {})));
  const rest = facts.filter((fact) => !named.has(`${fact.class} ${fact.key}`));
  if (!rest.length) return null;
  return el('ul', { class: 'plain' }, ...rest.map((fact) => el('li', { class: 'hint', text: `${called(`${fact.class} ${fact.key}`)}${propertiesOf(`${fact.class} ${fact.key}`, facts)}` })));
}

/** Asks why the route does not lead through something, and shows it. */
export async function whyNot(through) {
  const { start, goal, robot } = model.ask;
  const title = `Why not through ${through}?`;
  const busy = card('why-not-card', title, [el('p', { class: 'hint', text: 'Looking…' })]);
  const stays = focusStays();
  try {
    const answer = await get(path('/api/why-not', { start, goal, through, robot }));
    if (!busy.isConnected) return;
    const sentence = el('p', { class: 'sentence', text: answer.sentence ?? answer.reason ?? '' });
    const numbers = answer.cost !== null && answer.cost !== undefined
      ? el('p', { class: 'hint', text: `The best way costs ${cost(answer.best)}, the one through ${through} ${cost(answer.cost)}. It is dotted on the map.` }) : null;
    card('why-not-card', title, [sentence, numbers, details(answer)], stays);
    model.set('whyNot', answer);
  } catch (error) {
    card('why-not-card', title, [said(error)], stays);
  }
}

function details(answer) {
  const rejected = (answer.rejected ?? []).map(rejection);
  const concluded = (answer.conclusions ?? []).map((of) => conclusion(of, answer.facts));
  const deciding = (answer.deciding ?? []).map((of) => el('li', { text: typeof of === 'string' ? of : of.sentence ?? of.message ?? list(Object.entries(of).map(([name, item]) => `${name} ${value(item)}`)) }));
  if (!rejected.length && !concluded.length && !deciding.length) return null;
  // Where no way leads there at all, this is the answer; else the sentence is.
  const open = answer.cost === null || answer.cost === undefined;
  return el('details', { open }, el('summary', { text: 'What decides there' }),
    deciding.length ? el('ul', {}, ...deciding) : null,
    rejected.length ? el('ul', { class: 'rejected' }, ...rejected) : null,
    concluded.length ? el('ul', { class: 'reasons' }, ...concluded) : null,
    answer.truncated ? el('p', { class: 'hint', text: 'There is more; this is the first of it.' }) : null);
}

const COMPARED = { '<': 'below', '<=': 'at most', '>': 'above', '>=': 'at least', '==': 'equal to', '!=': 'other than' };

// `state.height < room.height` with 20 and 4 becomes: its height 20 is not below the room's height 4.
function rejection(of) {
  const who = keyName(of.key ?? of.class ?? '');
  const parts = /^(\w+)\.(\w+) (<=?|>=?|==|!=) (\w+)\.(\w+)$/.exec(of.test ?? '');
  const known = of.left !== undefined && of.left !== null && of.right !== undefined && of.right !== null;
  const reason = parts && known
    ? `its ${parts[2]} ${value(of.left)} is not ${COMPARED[parts[3]]} the ${parts[4]}’s ${parts[5]} ${value(of.right)}`
    : `${of.test ?? of.reason}${known ? `: ${value(of.left)} against ${value(of.right)}` : ''}`;
  return el('li', {}, el('b', { text: who }), ` does not fit: ${reason} (rule “${of.rule}”)`);
}
