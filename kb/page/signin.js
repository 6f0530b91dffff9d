/** The box that asks for a token where the service wants one. Kept for this browser tab only. */

import { byId } from './dom.js';

let asking = null;

/** Asks once, however many requests wait for it. @param {string} why what the service said */
export function askForToken(why) {
  asking ??= new Promise((resolve) => {
    const box = byId('sign-in');
    byId('sign-in-why').textContent = why;
    byId('token').value = '';
    box.addEventListener('cancel', (event) => event.preventDefault());
    byId('sign-in-form').addEventListener('submit', () => {
      sessionStorage.setItem('adit-token', byId('token').value.trim());
      asking = null;
      resolve();
    }, { once: true });
    if (!box.open) box.showModal();
  });
  return asking;
}
