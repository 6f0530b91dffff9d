/** Asking for a value: what rules lack to conclude it is asked here, question by question. */

import { post } from './api.js';
import { button, byId, el, fill, focusStays, form } from './dom.js';
import { count, value as inWords } from './format.js';
import { model } from './model.js';
import { said } from './notice.js';
import { tell } from './told.js';

let answers = [];

/** The card in which a value is asked for. */
export function askCard() {
  const what = el('input', { id: 'ask-what', autocomplete: 'off', required: true, placeholder: 'orders.2.total' });
  const begin = form({ class: 'line-form' }, () => { answers = []; return ask(); }, el('label', {}, 'Class, object and property ', what), el('button', { type: 'submit', class: 'strong', text: 'Find out' }));
  return el('div', { class: 'card' }, el('h2', { text: 'Find something out' }), begin, el('div', { id: 'ask-said', role: 'status' }));
}

async function ask() {
  const stays = focusStays();
  try {
    const asked = await post('/api/ask', { what: byId('ask-what').value.trim(), answers: answers.map(({ what, value }) => ({ what, value })) });
    fill(byId('ask-said'), ...shown(asked), keepButton(asked));
    if (stays()) byId('ask-answer')?.focus();
  } catch (error) {
    // an answer that cannot be is asked for again
    answers.pop();
    fill(byId('ask-said'), said(error));
  }
}

function shown({ status, value, why, what, question, weighed }) {
  const told = answers.map((answer) => el('p', { class: 'hint', text: `${answer.text} ${answer.value ?? 'not known'}` }));
  if (question) {
    const input = el('input', { id: 'ask-answer', autocomplete: 'off' });
    const reply = (given) => { answers.push({ what: question.what, value: given || null, text: question.text }); return ask(); };
    const asked = form({ class: 'line-form' }, () => reply(input.value.trim()), el('label', {}, `${question.text} `, input), el('button', { type: 'submit', class: 'strong', text: 'Answer' }), button('I do not know', () => reply(null)));
    return [...told, asked];
  }
  const isOpen = answers.some((answer) => answer.value === null);
  const reasons = el('ul', { class: 'plain' }, ...(isOpen ? [] : why).map((text) => el('li', { text })));
  const found = status === 'known' ? [el('p', {}, el('b', { text: `${what} is ${inWords(value)}` })), reasons] : [el('p', { text: isOpen ? `${what} is unknown as long as that is not known.` : `${what} is unknown, and nothing that can be asked would settle it.` }), reasons];
  return [...told, ...found, weighed ? el('p', { class: 'hint', text: `Rules weighed ${count(weighed, 'object')} for it.` }) : null];
}

function keepButton({ question }) {
  const told = answers.filter(({ value }) => value !== null);
  if (question || !told.length || !model.may('tell')) return null;
  return button('Tell the site these answers', () => keep(told));
}

function keep(told) {
  for (const { what, value } of told) {
    const [, name, object, property] = /^([^.]+)\.(.*)\.([^.]+)$/u.exec(what);
    tell({ class: name.toUpperCase(), object, property, value });
  }
  byId('preview-title').focus();
}
