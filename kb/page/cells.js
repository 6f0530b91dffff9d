/** A cell of a table as a field, and what is typed into it. */

import { el } from './dom.js';
import { exact } from './format.js';
import { model } from './model.js';

/** A field for a value of a column. */
export function field(column, label, value) {
  const made = column.kind === 'truth'
    ? el('select', { 'aria-label': label }, el('option', { value: '', text: '' }), el('option', { value: 'true', text: 'yes' }), el('option', { value: 'false', text: 'no' }))
    : el('input', { 'aria-label': label, inputmode: column.kind === 'number' ? 'decimal' : null, spellcheck: 'false', size: column.kind === 'number' ? '5' : String(Math.max(12, exact(value).length + 1)) });
  made.value = exact(value);
  made.disabled = !model.may('tune');
  return made;
}

/** What was typed, as the column's kind; or what is wrong with it. */
export function parse(text, column) {
  const typed = text.trim();
  if (typed === '') return column.required ? { value: '', wrong: 'needs a value' } : { value: null };
  if (column.kind === 'truth') return { value: typed === 'true' };
  if (column.kind !== 'number') return { value: typed };
  const value = Number(typed.replace(',', '.'));
  return Number.isFinite(value) ? { value } : { value: typed, wrong: 'needs a number' };
}

/** Enter goes to the same column of the next row that has a field there. Nothing is saved by it: that takes Ctrl-Enter, or Save. */
export function goDown(event) {
  event.preventDefault();
  const { cellIndex, parentElement } = event.target.closest('td');
  const fieldOf = (row) => row.children[cellIndex]?.querySelector(':is(input, select):not(:disabled)');
  let row = parentElement.nextElementSibling;
  while (row && !fieldOf(row)) row = row.nextElementSibling;
  const below = row && fieldOf(row);
  below?.focus();
  below?.select?.();
}

const TITLES = { robots: 'Robot states', changes: 'Changes of shape', loads: 'Loads', hours: 'Opening hours', measures: 'Measures' };

/** What people call a table. */
export const titleOf = (name) => TITLES[name] ?? name.replaceAll('_', ' ');

/** Whether a table is one that every site has. */
export const isOfAll = (name) => Object.hasOwn(TITLES, name);
