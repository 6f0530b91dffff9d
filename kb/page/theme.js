/** Light, dark, or as the system has it. */

import { byId } from './dom.js';

const CHOICES = ['auto', 'light', 'dark'];
const system = matchMedia('(prefers-color-scheme: dark)');
const changed = new EventTarget();

function choice() {
  return localStorage.getItem('adit-theme') ?? 'auto';
}

/** Whether the page is dark now. */
export const isDark = () => (choice() === 'auto' ? system.matches : choice() === 'dark');

/** Calls `act` whenever light turns to dark or back. */
export const onTheme = (act) => changed.addEventListener('change', act);

function apply() {
  document.documentElement.dataset.theme = isDark() ? 'dark' : 'light';
  byId('theme').textContent = { auto: 'Colours: as the system', light: 'Colours: light', dark: 'Colours: dark' }[choice()];
  changed.dispatchEvent(new Event('change'));
}

/** A colour of the style sheet, by its name. */
export const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** Applies the choice, and lets the button change it. */
export function startTheme() {
  system.addEventListener('change', apply);
  byId('theme').addEventListener('click', () => {
    localStorage.setItem('adit-theme', CHOICES[(CHOICES.indexOf(choice()) + 1) % CHOICES.length]);
    apply();
  });
  apply();
}
