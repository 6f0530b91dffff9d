/** What one can do with what lies at a point of the map. */

import { why, whyNot } from './answers.js';
import { close, closings } from './closing.js';
import { button, byId, el, fill, shut } from './dom.js';
import { redraw } from './draw.js';
import { list } from './format.js';
import { describe, isGoing, names, takeAway } from './laid.js';
import { model } from './model.js';
import { endOf, nameOf, nounOf, pieceOf, weightsOf } from './thing.js';
import { lead } from './ends.js';

let before = null;

/** Closes it, and gives the focus back to where it was. */
export function closePopover() {
  const box = byId('popover');
  if (box.hidden) return;
  const inside = box.contains(document.activeElement);
  box.hidden = true;
  if (inside) (before ?? byId('canvas')).focus({ preventScroll: true });
}

/** Opens it at a point of the canvas. */
export function openPopover(thing, [px, py]) {
  before = document.activeElement;
  const box = byId('popover');
  const act = (text, does) => button(text, () => { closePopover(); return does(); });
  const { title, text } = weightsOf(thing);
  const solid = thing.kind === 'wall';
  const around = thing.areas?.length ? el('p', { class: 'hint', text: `in ${list(thing.areas.map((area) => area.name))}` }) : null;
  const named = solid ? '' : nameOf(thing);
  const called = thing.place ? `${thing.place.place}, ${title}` : solid && thing.laid?.length ? names(thing.laid) : title;
  fill(
    box,
    el('h3', { text: called }),
    el('p', { text }),
    around,
    thing.kind === 'room' && nounOf(thing) ? el('p', { class: 'hint', text: `here ${pieceOf(thing)}` }) : null,
    solid ? null : act('Start here', () => lead('start', thing)),
    solid ? null : act('Go here', () => lead('goal', thing)),
    solid || thing.kind === 'doorway' ? null : act('Why is it so?', () => why(pieceOf(thing))),
    !solid && model.ask.start && model.ask.goal ? act(`Why not through ${named}?`, () => whyNot(named)) : null,
    ...(model.may('tell') ? (thing.laid ?? []).flatMap((of) => laid(of, act)) : []),
    ...(model.may('tell') ? closings(thing).map(({ text: label, edit, sides }) => act(label, () => close(edit, label, sides))) : []),
    shut('this', closePopover),
  );
  box.hidden = false;
  place(box, px, py);
  box.querySelector('button').focus({ preventScroll: true });
  box.setAttribute('aria-label', `${called}: ${endOf(thing)}`);
}

// What was laid over the map may be moved, changed and taken away.
function laid(of, act) {
  if (isGoing(of)) return [act(`Keep ${describe(of)}`, () => takeAway(of))];
  return [act(`Take away ${describe(of)}…`, () => takeAway(of)), act(`Move or change ${describe(of)}…`, () => redraw(of))];
}

const GAP = 12;
/** What is pressed with a finger stays in sight by so much, pixels. */
const CLEAR = 40;

// It covers nothing of what it is about: it stands beside that, or above or beneath it.
function place(box, px, py) {
  const { clientWidth: width, clientHeight: height } = byId('map-box');
  box.style.removeProperty('--room');
  delete box.dataset.above;
  // On a phone it has the width of the window.
  if (getComputedStyle(box).position === 'fixed') return placeAcross(box, byId('map-box').getBoundingClientRect().top + py);
  const w = box.offsetWidth;
  const beside = [px + GAP, px - GAP - w].find((left) => left >= 6 && left + w <= width - 6);
  const [above, below] = [py - GAP, height - py - GAP];
  if (beside === undefined) box.style.setProperty('--room', `${Math.max(above, below)}px`);
  const h = box.offsetHeight;
  const top = beside !== undefined ? Math.min(py + GAP, height - h - 8) : h <= below ? py + GAP : py - GAP - h;
  box.style.setProperty('left', `${beside ?? Math.max(6, Math.min(px - w / 2, width - w - 6))}px`);
  box.style.setProperty('top', `${Math.max(6, top)}px`);
  return undefined;
}

// At the lower end of the window where the point stays in sight, else at the upper one, and no higher than there is room.
function placeAcross(box, y) {
  const [above, below] = [y - CLEAR, window.innerHeight - y - CLEAR];
  const isAbove = box.offsetHeight > below && above > below;
  box.toggleAttribute('data-above', isAbove);
  box.style.setProperty('--room', `${Math.max(above, below)}px`);
}

byId('popover').addEventListener('keydown', (event) => {
  if (event.key === 'Escape') {
    event.stopPropagation();
    closePopover();
  }
});
