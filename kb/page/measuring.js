/** Measuring on the map: points are pressed, or drawn in one go, and it is said how far it is from each to the next, and in all. */

import { button, byId, el } from './dom.js';
import { drawing, stopDrawing } from './draw.js';
import { distances } from './measure.js';
import { model } from './model.js';
import { REACH_PX, Snapper } from './snap.js';

const HOW = 'Press two points or more, or drag from one to the other; Enter takes the middle of the map. Escape ends it.';

let tool = null;

/** The tool of the pointer while something is measured. */
class Measure {
  constructor(camera, invalidate) {
    Object.assign(this, { camera, invalidate, points: [], ahead: null, held: -1, from: null, isHeld: false });
    this.snapper = new Snapper(model.map);
    this.said = el('span', { role: 'status' });
    this.back = button('Take the last point back', () => this.takeBack(), { class: 'link', hidden: true });
    this.line = el('p', { class: 'measured', id: 'measured' }, this.said, this.back);
  }

  meant(at, event) { return this.snapper.meant(this.camera, at, event); }

  near(at, event) {
    const reach = event.pointerType === 'touch' ? 2 * REACH_PX : REACH_PX;
    return this.points.map((point) => this.camera.toScreen(point)).findLastIndex(([x, y]) => Math.hypot(x - at[0], y - at[1]) <= reach);
  }

  /** Whether a press is for what is measured, and not to move the map: on a point, or where there is none yet. */
  press(at, event) {
    this.held = this.near(at, event);
    this.from = this.points.length ? null : this.meant(at, event);
    this.isHeld = this.held >= 0 || this.from !== null;
    return this.isHeld;
  }

  drag(at, event) {
    const point = this.meant(at, event);
    this.points = this.held >= 0 ? this.points.with(this.held, point) : [this.from, point];
    this.show(true);
  }

  /** A press that moved nothing: the next point; one that is there already closes the round. */
  tap(at, event) {
    this.isHeld = false;
    if (event.repeat) return;
    const near = this.near(at, event);
    if (near >= 0 && near === this.points.length - 1) return;
    this.points = [...this.points, near >= 0 ? this.points[near] : this.meant(at, event)];
    this.show();
  }

  finish() {
    this.isHeld = false;
    this.show();
  }

  /** Where the mouse is: so far it would be. */
  hover(at) {
    this.ahead = at && this.points.length && !this.isHeld ? this.meant(at) : null;
    this.invalidate();
  }

  takeBack() {
    this.points = this.points.slice(0, -1);
    this.show();
    if (!this.points.length) byId('canvas').focus({ preventScroll: true });
  }

  // While a point is moved nobody wants to hear each step.
  show(isMoving = false) {
    this.ahead = null;
    this.said.setAttribute('aria-busy', String(isMoving));
    this.said.textContent = this.points.length ? distances(this.points) : HOW;
    this.back.hidden = !this.points.length;
    this.invalidate();
  }
}

/** Whoever measures now, or null. */
export const measuring = () => (tool?.camera.tool === tool ? tool : null);

function begin(camera, invalidate) {
  if (drawing()) stopDrawing();
  tool = new Measure(camera, invalidate);
  camera.tool = tool;
  byId('map-box').after(tool.line);
  byId('measuring').setAttribute('aria-pressed', 'true');
  byId('canvas').focus({ preventScroll: true });
  // A status is heard where it changes, and not where it appears.
  const { said } = tool;
  requestAnimationFrame(() => { if (tool?.said === said && !tool.points.length) tool.show(); });
}

function end() {
  const { camera, line, invalidate } = tool;
  if (line.contains(document.activeElement)) byId('measuring').focus({ preventScroll: true });
  if (camera.tool === tool) camera.tool = null;
  tool = null;
  line.remove();
  byId('measuring').setAttribute('aria-pressed', 'false');
  invalidate();
}

function key(event) {
  if (!measuring() || event.defaultPrevented || event.target.closest('input, select, textarea, dialog, .popover')) return;
  if (event.key === 'Escape') end();
  else if (event.key === 'Backspace' && tool.points.length) tool.takeBack();
  else return;
  event.preventDefault();
}

/** Makes the button work. */
export function startMeasuring(camera, invalidate) {
  byId('measuring').addEventListener('click', () => (measuring() ? end() : begin(camera, invalidate)));
  document.addEventListener('keydown', key);
  // Whoever draws has the pointer.
  const look = () => { if (tool && !measuring()) end(); };
  byId('draw').addEventListener('click', look);
  model.on('pending', look);
  model.on('map', () => { if (tool) end(); });
}
