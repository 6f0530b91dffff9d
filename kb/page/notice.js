/** Banners over the page, and what went wrong, in words. */

import { byId, el, shut } from './dom.js';

const banners = new Map();

/** Shows a banner by this name, or takes it away where there is nothing to say. */
export function banner(name, content, tone = 'warn') {
  banners.get(name)?.remove();
  banners.delete(name);
  if (!content) return;
  const made = el('div', { class: `banner ${tone}`, role: 'status', 'data-banner': name }, ...[content].flat());
  banners.set(name, made);
  byId('banners').append(made);
}

// What helps in a terminal helps nobody here.
const isForTerminals = (help) => /`adit |\/api\/|`--[a-z]/u.test(help);

/** An error as nodes: what is wrong, and what helps. */
export function said(error) {
  const [only, second] = error.problems ?? [];
  const place = only?.line && !second && only.message === error.message ? where(only) : '';
  const parts = [el('p', { class: 'wrong', role: 'alert', text: place + error.message })];
  if (error.help && !isForTerminals(error.help)) parts.push(el('p', { class: 'hint', text: error.help }));
  for (const problem of error.problems ?? []) {
    if (problem.message !== error.message) parts.push(el('p', { class: 'hint', text: where(problem) + problem.message }));
  }
  return el('div', {}, ...parts);
}

/** `rules/doors.rhai, line 3: ` where a problem has a place. */
export const where = (problem) => (problem.file ? `${problem.file}${problem.line ? `, line ${problem.line}` : ''}: ` : '');

/** Shows an error for as long as it is not closed. */
export function complain(error) {
  if (error.name === 'AbortError') return;
  banner('error', [said(error), shut('this', () => banner('error'))], 'bad');
}
