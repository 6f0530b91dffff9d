/** On a phone all that is not the map stands on a sheet beneath it: its handle pulls it up and down, and so does whoever goes on there, or on the map. */

import { byId } from './dom.js';

const phone = matchMedia('(max-width: 900px)');
const SLOP = 6;
/** As long as a press may take from the finger's coming down to the click, milliseconds. */
const PRESS_MS = 700;

const sheet = byId('sheet');
const handle = byId('sheet-handle');
const side = byId('side');
/** How far it was scrolled when it was pulled down. */
let left = 0;

const isUp = () => sheet.classList.contains('open');

/** Pulls the sheet up or down; it lies still where there is room beside the map. */
function pull(up) {
  if (!phone.matches || up === isUp()) return;
  if (!up) left = side.scrollTop;
  sheet.classList.toggle('open', up);
  handle.setAttribute('aria-expanded', String(up));
  side.scrollTop = up ? left : 0;
}

// What waits and what was saved are seen with the sheet down, too.
const isAlwaysSeen = (node) => Boolean(node.closest('#saved, .tray, #replay-card'));

/** What is looked at is on the map. */
export const lookAtMap = () => pull(false);

function follow() {
  let pressed = -PRESS_MS;
  side.addEventListener('pointerdown', (event) => { pressed = event.timeStamp; });
  // What is pressed must not move away before the finger is up; what it does may pull the sheet down again.
  side.addEventListener('click', ({ target }) => { if (!isAlwaysSeen(target)) pull(true); }, true);
  side.addEventListener('focusin', ({ target, timeStamp }) => {
    if (isUp() || isAlwaysSeen(target) || timeStamp - pressed < PRESS_MS) return;
    pull(true);
    if (isUp()) target.scrollIntoView({ block: 'nearest' });
  });
  byId('map-card').addEventListener('focusin', () => pull(false));
}

function drag() {
  let from = null;
  let travelled = 0;
  handle.addEventListener('pointerdown', (event) => {
    handle.setPointerCapture(event.pointerId);
    from = { y: event.clientY, height: sheet.offsetHeight };
    travelled = 0;
  });
  handle.addEventListener('pointermove', (event) => {
    if (!from) return;
    travelled = from.y - event.clientY;
    if (!sheet.classList.contains('dragged') && Math.abs(travelled) < SLOP) return;
    sheet.classList.add('dragged');
    sheet.style.setProperty('height', `${Math.max(handle.offsetHeight, from.height + travelled)}px`);
  });
  const release = () => {
    from = null;
    if (!sheet.classList.contains('dragged')) return;
    sheet.classList.remove('dragged');
    sheet.style.removeProperty('height');
    pull(travelled > 0);
  };
  handle.addEventListener('pointerup', release);
  handle.addEventListener('pointercancel', release);
  // A drag ends in a click, too, which is none.
  handle.addEventListener('click', (event) => { if (!event.detail || Math.abs(travelled) < SLOP) pull(!isUp()); });
}

/** Makes the sheet follow; what is below the sheet's lower end has to know how high the word of what was saved is. */
export function startSheet() {
  drag();
  follow();
  new ResizeObserver(() => document.documentElement.style.setProperty('--saved', `${byId('saved').offsetHeight}px`)).observe(byId('saved'));
}
