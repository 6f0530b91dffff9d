/** Drawing on the map: areas, obstacles, places, bridges and named doorways, by hand or by numbers, named where they lie; they wait among what is pending. */

import { byId, fill } from './dom.js';
import { fields, HOW, points, rectangleOf, WORDS } from './draw-form.js';
import { number, untilWhen, value } from './format.js';
import { corners, size, span } from './measure.js';
import { model } from './model.js';
import { discard, put } from './pending.js';
import { REACH_PX, Snapper } from './snap.js';

let tool = null;
let map = null;

/** The tool of the pointer while something is drawn: it is asked before the map moves. */
class Tool {
  constructor(camera, invalidate) {
    Object.assign(this, { camera, invalidate, points: [], held: -1, from: null, id: null });
    this.fields = fields({ changed: () => this.read(), done: stopDrawing, forget });
    this.snapper = null;
  }

  get isPlace() { return this.fields.what.value === 'place'; }

  get isDoor() { return this.fields.what.value === 'door'; }

  get isBridge() { return this.fields.what.value === 'bridge'; }

  get isRectangle() { return this.isBridge || (!this.isPlace && !this.isDoor && this.fields.shape.value === 'rectangle'); }

  /** Whether two points say where it is. */
  get hasTwo() { return this.isRectangle || this.isDoor; }

  meant(at, event) {
    this.snapper ??= new Snapper(model.map);
    return this.snapper.meant(this.camera, at, event);
  }

  /** Whether a press is for the drawing, and not to move the map. */
  press(at, event) {
    const reach = event.pointerType === 'touch' ? 2 * REACH_PX : REACH_PX;
    const drawn = this.points.map((point) => this.camera.toScreen(point));
    this.held = drawn.findIndex(([x, y]) => Math.hypot(x - at[0], y - at[1]) <= reach);
    this.from = this.hasTwo && this.held < 0 ? this.meant(at, event) : null;
    return this.held >= 0 || this.from !== null;
  }

  drag(at, event) {
    const point = this.meant(at, event);
    if (this.held >= 0) this.points = this.points.with(this.held, point);
    else if (this.from) this.points = [this.from, point];
    this.moved();
  }

  /** A press that moved nothing: the next corner. */
  tap(at, event) {
    const point = this.meant(at, event);
    if (this.isPlace) this.points = [point];
    else if (this.hasTwo) this.points = this.points.length === 1 ? [this.points[0], point] : [point];
    else if (this.held < 0) this.points = [...this.points, point];
    this.moved();
    this.finish();
  }

  /** The hand lets go: what is whole is named. */
  finish() {
    if (!this.isWhole) return;
    const { name } = this.fields;
    if (!name.value) name.value = freeName(this.fields.what.value);
    this.beside();
    name.focus({ preventScroll: true });
    if (this.hasTwo || this.isPlace) name.select();
    this.read();
  }

  get isWhole() {
    const enough = this.isPlace ? 1 : this.hasTwo ? 2 : 3;
    return this.points.length >= enough;
  }

  moved() {
    this.fields.corners.value = this.points.map((point) => point.join(',')).join(' ');
    this.read();
  }

  /** Takes up what the fields say. */
  read() {
    // A field that goes with the form says once more that it was changed.
    if (tool !== this) return;
    const { fields: of } = this;
    const what = of.what.value;
    of.shapeLabel.hidden = what !== 'area' && what !== 'obstacle';
    of.kindLabel.hidden = what !== 'area' && !this.isDoor;
    if (!of.kindLabel.hidden) of.offer(what);
    of.heightLabel.hidden = !this.isBridge;
    of.cornersLabel.firstChild.data = `${this.isPlace ? 'Point' : this.isDoor ? 'Posts' : 'Corners'}, metres `;
    of.corners.placeholder = this.isPlace ? 'x,y' : 'x,y x,y';
    const said = points(of.corners.value);
    this.points = said ?? [];
    fill(of.how, said ? HOW[HOW[what] ? what : this.isRectangle ? 'rectangle' : 'polygon'] : this.isPlace ? 'A point is two numbers: x,y in metres.' : 'Corners are numbers: x,y x,y in metres.');
    of.size.textContent = this.isPlace ? '' : this.isDoor ? span(this.points) : size(this.isRectangle ? corners(this.points) : this.points);
    this.take();
    this.invalidate();
  }

  take() {
    const { fields: of } = this;
    const [what, name] = [of.what.value, of.name.value.trim()];
    if (!this.points.length) return this.leave();
    const [kind, until] = [of.kind.value.trim(), of.until.value.trim()];
    const height = Number(of.height.value.trim().replace(',', '.'));
    const properties = this.isBridge ? { height } : what === 'area' || this.isDoor ? { ...this.properties, ...(kind ? { kind } : {}) } : {};
    const lay = { kind: 'lay', what, name, corners: this.points, properties, ...(until ? { until } : {}) };
    this.id ??= `laid:${Date.now()}`;
    const wrong = !this.isWhole ? `needs another ${this.isDoor ? 'post' : 'corner'}` : !name ? 'needs a name' : this.isBridge && !(height > 0) ? 'needs a height: how many metres are clear beneath it' : undefined;
    const gone = this.replaced ? [{ kind: 'lift', name: this.replaced }] : [];
    return put(this.id, { words: laidWords(lay, this.replaced), edits: [...gone, lay], wrong, shape: { what, name, points: this.points, open: true } });
  }

  leave() {
    const { id } = this;
    this.id = null;
    return id && discard(id);
  }

  // The form stands beside what is drawn, where there is room.
  beside() {
    const box = this.fields.form;
    const { clientWidth: width, clientHeight: height, offsetTop: above } = byId('map-box');
    const drawn = this.points.map((point) => this.camera.toScreen(point));
    const [right, left] = [Math.max(...drawn.map(([x]) => x)), Math.min(...drawn.map(([x]) => x))];
    const fits = right + 16 + box.offsetWidth < width;
    const x = fits ? right + 16 : left - 16 - box.offsetWidth > 0 ? left - 16 - box.offsetWidth : width - box.offsetWidth - 8;
    const y = Math.min(...drawn.map(([, py]) => py));
    box.style.setProperty('left', `${Math.max(6, x)}px`);
    box.style.setProperty('top', `${above + Math.max(6, Math.min(y, height - box.offsetHeight - 8))}px`);
  }
}

function laidWords({ what, name, properties, until }, replaced) {
  const kind = properties.kind ? ` (${value(properties.kind)})` : what === 'bridge' && properties.height > 0 ? ` (${number(properties.height)} m high)` : '';
  return `${replaced ? 'Moved or changed: ' : 'New on the map: '}${WORDS[what]} ${name ? `“${name}”` : 'without a name'}${kind}${untilWhen(until)}`;
}

// Another name than all that the map has, and all that waits.
function freeName(what) {
  const { map } = model;
  const known = new Set([...map.places.map(({ place }) => place), ...map.areas.map(({ name }) => name), ...map.named_doors.map(({ name }) => name), ...model.laid.map(({ name }) => name), ...[...model.pending.values()].map(({ shape }) => shape?.name)]);
  for (let n = 1; ; n += 1) if (!known.has(`${what} ${n}`)) return `${what} ${n}`;
}

/** Whoever draws now, or null. */
export const drawing = () => tool;

function begin() {
  if (tool) return stopDrawing();
  tool = new Tool(map.camera, map.invalidate);
  map.camera.tool = tool;
  byId('map-box').after(tool.fields.form);
  byId('draw').setAttribute('aria-pressed', 'true');
  byId('map-box').dataset.drawing = 'true';
  tool.read();
  tool.fields.what.focus({ preventScroll: true });
  return undefined;
}

/** Puts the pen away; what was drawn waits to be saved. */
export function stopDrawing() {
  const { id, fields: { form } } = tool;
  const hadFocus = form.contains(document.activeElement);
  map.camera.tool = null;
  tool = null;
  form.remove();
  byId('draw').setAttribute('aria-pressed', 'false');
  delete byId('map-box').dataset.drawing;
  const item = model.pending.get(id);
  if (item) put(id, { ...item, shape: { ...item.shape, open: false } });
  if (hadFocus) (item && !byId('save').disabled ? byId('save') : byId('draw')).focus({ preventScroll: true });
}

function forget() {
  const { id } = tool;
  stopDrawing();
  if (id) discard(id);
}

// Puts what is laid, or waits to be, into a form of its own.
function takeUp({ what, name, kind, until, corners: outline, properties }, more) {
  if (tool) stopDrawing();
  begin();
  const { fields: of } = tool;
  const rectangle = what === 'place' || what === 'door' ? null : outline.length === 2 ? outline : rectangleOf(outline);
  of.what.value = what;
  of.shape.value = rectangle ? 'rectangle' : 'polygon';
  of.name.value = name;
  of.kind.value = kind ?? '';
  of.until.value = until ?? '';
  of.height.value = properties?.height ?? '';
  Object.assign(tool, { properties, ...more });
  of.corners.value = (rectangle ?? outline).map((corner) => corner.join(',')).join(' ');
  tool.read();
  tool.beside();
  of.name.focus({ preventScroll: true });
}

/** Takes up what lies over the map already, to be moved or changed. */
export function redraw(laid) {
  takeUp(laid, { replaced: laid.name, id: `laid:${laid.name}` });
}

/** Takes up again what was drawn and waits. */
export function reopen(id, { edits }) {
  const lay = edits.at(-1);
  const { kind, ...properties } = lay.properties;
  takeUp({ ...lay, kind, properties }, { id, replaced: edits.length > 1 ? edits[0].name : undefined });
}

/** Makes the button work. */
export function startDraw(camera, invalidate) {
  map = { camera, invalidate };
  const button = byId('draw');
  button.hidden = !model.may('tell') || !model.site || model.site.rooms_mode === 'none';
  button.addEventListener('click', begin);
  // saved, or discarded elsewhere
  model.on('pending', () => { if (tool?.id && !model.pending.has(tool.id)) stopDrawing(); });
}
