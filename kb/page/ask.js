/** Asking for a value: what rules lack to conclude it is asked here, question by question; what was answered stays, and can be answered otherwise. */

import { ruleLink } from './answers.js';
import { post } from './api.js';
import { answerOf, askField, parts } from './askable.js';
import { button, byId, el, fill, focusStays, form } from './dom.js';
import { count, value as inWords } from './format.js';
import { model } from './model.js';
import { said } from './notice.js';
import { tell } from './told.js';

/** What is asked for, what was answered, what came of it, and which of the answers is being changed. */
let talk = { what: '', answers: [], asked: null, changing: -1 };

/** The card in which a value is asked for. */
export function askCard() {
  const begin = form({ class: 'line-form' }, () => ask({ what: byId('ask-what').value.trim(), answers: [] }, byId('ask-said')), askField(), el('button', { type: 'submit', class: 'strong', text: 'Find out' }));
  return el('div', { class: 'card' }, el('h2', { text: 'Find something out' }), begin, el('div', { id: 'ask-said' }));
}

/** Asks with these answers; what the service cannot take is said at `wrong`, and what was answered stays. */
async function ask({ what, answers }, wrong) {
  const stays = focusStays();
  try {
    const asked = await post('/api/ask', { what, answers: answers.map(({ what: of, value }) => ({ what: of, value })) });
    const how = asked.question ? await answerOf(asked.question.what) : null;
    talk = { what, answers, asked: { ...asked, question: asked.question && { ...asked.question, how } }, changing: -1 };
    show();
    if (stays()) goOn();
  } catch (error) {
    fill(wrong, said(error));
  }
}

// At a question that is answered by buttons its words have the focus, so that no key that is pressed twice answers the next one.
const goOn = () => (byId('ask-answer') ?? byId('ask-next')).focus();

function show() {
  const { answers, asked, changing } = talk;
  const earlier = answers.map((answer, at) => (at === changing ? questionItem(answer, at) : answered(answer, at)));
  const next = asked.question ? questionItem(asked.question, answers.length) : null;
  fill(byId('ask-said'), el('ol', { class: 'dialogue' }, ...earlier, changing < 0 ? next : null), ...(asked.question || changing >= 0 ? [] : [result(), keepButton()]));
}

const saidOf = ({ value }) => (value === null ? 'not known' : inWords(value));

function answered(answer, at) {
  const change = button('Change', () => {
    talk.changing = at;
    show();
    goOn();
  }, { class: 'link', 'aria-label': `Change: ${answer.text} ${saidOf(answer)}` });
  return el('li', {}, el('span', { class: 'hint', text: answer.text }), ' ', el('b', { text: saidOf(answer) }), ' ', change);
}

/** A question; one that was answered is taken up with its answer, and what came after that is asked anew where it is another one. */
function questionItem(question, at) {
  const { how } = question;
  const before = talk.answers[at];
  const wrong = el('div', { role: 'status' });
  const stay = () => {
    talk.changing = -1;
    show();
    [...byId('ask-said').querySelectorAll('li button')][at].focus();
  };
  const reply = (value) => {
    if (before && before.value === value) return stay();
    return ask({ what: talk.what, answers: [...talk.answers.slice(0, at), { ...question, value }] }, wrong);
  };
  const unknown = button('I do not know', () => reply(null));
  const back = before ? button('Keep this answer', stay) : null;
  const text = el('p', { id: how.isTruth ? 'ask-next' : null, tabindex: how.isTruth ? '-1' : null, text: question.text });
  if (how.isTruth) return el('li', { class: 'asked' }, text, el('div', { class: 'buttons', role: 'group', 'aria-label': question.text }, button('Yes', () => reply(true)), button('No', () => reply(false)), unknown, back), wrong);
  const known = how.words.length ? el('datalist', { id: 'ask-words' }, ...how.words.map((word) => el('option', { value: word }))) : null;
  const field = el('input', { id: 'ask-answer', autocomplete: 'off', required: true, 'aria-label': question.text, inputmode: how.isNumber ? 'decimal' : null, list: known ? 'ask-words' : null, placeholder: known ? `${how.words.slice(0, 3).join(', ')}…` : null, value: before?.value ?? '' });
  return el('li', { class: 'asked' }, text, form({ class: 'line-form' }, () => reply(field.value.trim()), field, known, el('button', { type: 'submit', class: 'strong', text: 'Answer' }), unknown, back), wrong);
}

const BY_RULE = /^(.*?), by rule "(.*?)" \((.*?), line (\d+)(?:, version \w+)?\)(?: with .*)?$/su;

// With which objects the rule concluded it follows beneath, in facts.
function reason(text) {
  const [, what, rule, file, line] = BY_RULE.exec(text) ?? [];
  return rule ? el('li', {}, `${what}, by the rule `, ruleLink(rule, file, line)) : el('li', { text });
}

function result() {
  const { answers, asked: { status, value, why, what, weighed } } = talk;
  const isOpen = answers.some((answer) => answer.value === null);
  const found = status === 'known' ? el('b', { text: `${what} is ${inWords(value)}` }) : isOpen ? `${what} stays unknown while an answer above is not known.` : `${what} is unknown, and nothing that can be asked would settle it.`;
  const reasons = isOpen && status !== 'known' ? [] : why;
  return el('div', {}, el('p', { id: 'ask-next', tabindex: '-1' }, found),
    reasons.length ? el('ul', { class: 'plain', 'aria-label': 'Why' }, ...reasons.map(reason)) : null,
    weighed ? el('p', { class: 'hint', text: `Rules weighed ${count(weighed, 'object')} for it.` }) : null);
}

function keepButton() {
  const told = talk.answers.filter(({ value }) => value !== null);
  if (!told.length || !model.may('tell')) return null;
  return button('Tell the site these answers', () => {
    for (const { what, value } of told) tell({ ...parts(what), value });
    byId('preview-title').focus();
  });
}
