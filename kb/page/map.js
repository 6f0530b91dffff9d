/** The map: the canvas with what is told of it, legend, layers, the word at the mouse, the popover at a click. */

import { Camera } from './camera.js';
import { byId, el, fill } from './dom.js';
import { drawing, startDraw } from './draw.js';
import { action, number } from './format.js';
import { Frames } from './frames.js';
import { Drawn, EASIEST, layerName, ofRobot, roomsWeigh } from './layers.js';
import { laidAt } from './laid.js';
import { placeMarks } from './marks.js';
import { showPoint, showScale } from './measure.js';
import { measuring, startMeasuring } from './measuring.js';
import { model } from './model.js';
import { showScan } from './scan.js';
import { inks, paint, paintOver } from './paint.js';
import { Patches } from './patches.js';
import { Finder, boxOf } from './places.js';
import { closePopover, openPopover } from './popover.js';
import { centreOf, middleOf, polygon } from './shapes.js';
import { showsPieces, weightsOf } from './thing.js';
import { onTheme } from './theme.js';

const canvas = byId('canvas');
const frames = new Frames(canvas.getContext('2d'));
const over = byId('over').getContext('2d');
const camera = new Camera(canvas, () => { closePopover(); pointAtMiddle(); invalidateFloor(); });
let found = null;
let shown = null;
let still = null;
let ink = null;
let pointed = null;
let waiting = false;
let isFloorDue = false;
let layout = null;
let size = [0, 0];

/** Draws the layer over the floor again at the next frame: what is pointed at, and what waits. */
function invalidateOver() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    if (!shown || canvas.clientWidth === 0) return;
    paintOver(over, camera, ink, pointed, measuring());
    placeMarks(camera);
    if (!isFloorDue) return;
    isFloorDue = false;
    const isMore = frames.show(camera, shown, ink.paper, (context, view) => paint(context, view, shown, still, ink, (at) => finder().roomsAt(at)));
    showScale(camera);
    // Whoever measures how soon an edit is seen reads it here.
    const { what } = frames.whole;
    canvas.dataset.generation = what.generation;
    canvas.dataset.changed = String(what.changedRooms.size + what.changedDoors.size);
    canvas.dataset.view = viewOf(camera);
    if (!isMore) canvas.dataset.painted = viewOf(camera);
    if (!performance.getEntriesByName('first picture').length) performance.mark('first picture');
    if (isMore) invalidateFloor();
  });
}

const viewOf = ({ scale, shift }) => [scale, ...shift].join(' ');

// Shows the picture of the floor again, from where it is seen now.
function invalidateFloor() {
  isFloorDue = true;
  canvas.dataset.painted = '';
  invalidateOver();
}

/** Draws the map again at the next frame. */
export function invalidate() {
  frames.forget();
  invalidateFloor();
}

/** What lies where; on a large floor it takes a moment to know, and the first picture does not wait for it. */
const finder = () => (found ??= new Finder(model.map));

/** Everything that follows from weights, preview or layer. */
function redraw() {
  if (!model.map || !model.weights) return;
  const chosen = byId('layer').value;
  shown = new Drawn(chosen === EASIEST || chosen === '' ? EASIEST : Number(chosen));
  ink ??= inks(frames.context);
  legend();
  invalidate();
}

function newMap() {
  const { map } = model;
  found = null;
  const polygons = (list) => {
    const path = new Path2D();
    for (const points of list) polygon(path, points);
    return path;
  };
  still = { walls: new Patches(map.bounds, map.walls.length), areas: polygons(map.areas.map((area) => area.polygon)), bridges: new Path2D(), namedDoors: new Path2D(), doorways: new Path2D() };
  for (const wall of map.walls) polygon(still.walls.path(boxOf(wall)), wall);
  for (const { segment: [ax, ay, bx, by] } of map.doorways) {
    still.doorways.moveTo(ax, ay);
    still.doorways.lineTo(bx, by);
  }
  for (const { rect: [x0, y0, x1, y1] } of map.bridges) still.bridges.rect(x0, y0, x1 - x0, y1 - y0);
  for (const { from, to } of map.named_doors) {
    still.namedDoors.moveTo(...from);
    still.namedDoors.lineTo(...to);
  }
  layerChoice();
  pointed = null;
  if (layout === null || String(map.bounds) !== String(camera.bounds)) fit();
  layout = map.layout;
}

// The layers of the robot whose way is asked.
function layerChoice() {
  const { layers } = model.map;
  const options = layers.flatMap((layer, index) => (ofRobot(index) ? [el('option', { value: String(index), text: `only rooms of ${layerName(layer)}` })] : []));
  const before = byId('layer').value;
  fill(byId('layer'), el('option', { value: EASIEST, text: 'easiest state at each spot' }), ...options);
  if (options.some((option) => option.value === before)) byId('layer').value = before;
  byId('layer-choice').hidden = options.length < 2;
  byId('pieces-choice').hidden = !roomsWeigh();
  byId('scan-choice').hidden = !model.map.scan;
}

const fit = () => { if (canvas.clientWidth) camera.fit(model.map.bounds); };

// What stands at the foot of the map lies on nothing of the whole map. What a preview adds to it moves no map.
function standAbove() {
  const { offsetHeight } = byId('map-foot');
  if (model.tried || !offsetHeight || camera.below === offsetHeight) return;
  camera.below = offsetHeight;
  if (model.map && camera.isWhole) fit();
}

function legend() {
  const { actions, classes } = shown;
  const items = classes.bounds.map((_, index) => swatch(classes.colour(index), classes.label(index)));
  const title = roomsWeigh() ? 'Hardness of a metre:' : 'Hardness of a door:';
  const used = new Set([...model.weights.rooms.action, ...(roomsWeigh() ? [] : model.weights.doors.action)]);
  const ways = actions.names.filter((name) => used.has(name)).map((name) => el('li', {}, stroke(name), el('b', { text: actions.letter(name) }), ` ${action(name)}`));
  const barred = el('li', {}, el('span', { class: 'swatch barred', 'aria-hidden': 'true' }), 'shut or not entered ✕');
  const amber = model.tried ? [el('li', {}, el('span', { class: 'swatch changed', 'aria-hidden': 'true' }), 'would change')] : [];
  fill(byId('legend'), el('li', { class: 'legend-title', text: title }), ...items, barred, ...amber, el('li', { class: 'legend-title', text: 'Action:' }), ...ways);
}

function swatch(colour, text) {
  const box = el('span', { class: 'swatch', 'aria-hidden': 'true' });
  box.style.setProperty('--fill', colour);
  return el('li', {}, box, text);
}

function stroke(name) {
  const line = el('span', { class: 'line-swatch', 'aria-hidden': 'true' });
  line.style.setProperty('--fill', shown.actions.colour(name));
  return line;
}

/** What lies at a point of the screen: the nearest doorway, or door that is drawn, else the room on top. */
function thingAt(point, reach = 8) {
  const at = camera.toMap(point);
  const near = reach / camera.scale;
  const doorway = showsPieces() ? -1 : finder().doorwayAt(at, near);
  const door = finder().doorAt(at, near, (index) => shown.shownDoors.has(index));
  const common = { at, laid: laidAt(at, camera.scale), space: finder().spaceAt(at), place: finder().placeAt(at, near * 1.5), named: finder().namedDoorAt(at, near * 1.5), areas: finder().areasAt(at) };
  if (doorway >= 0) return { kind: 'doorway', index: doorway, ...common };
  if (door >= 0) return { kind: 'door', index: door, ...common };
  const room = shown.topRoom(finder().roomsAt(at));
  return room >= 0 ? { kind: 'room', index: room, ...common } : { kind: 'wall', index: -1, ...common };
}

// Who moves the map by keys acts on its middle.
function pointAtMiddle() {
  if (document.activeElement === canvas) showPoint(camera.toMap([canvas.clientWidth / 2, canvas.clientHeight / 2]));
}

function hover(point) {
  showPoint(point && camera.toMap(point));
  measuring()?.hover(point);
  if (drawing() || measuring()) {
    byId('tip').hidden = true;
    return;
  }
  const thing = point && shown ? thingAt(point) : null;
  const tip = byId('tip');
  if (pointed?.index !== thing?.index || pointed?.kind !== thing?.kind) invalidateOver();
  pointed = thing?.kind === 'wall' ? null : thing;
  tip.hidden = !pointed || !byId('popover').hidden;
  if (tip.hidden) return;
  tip.textContent = tipText(pointed);
  const left = Math.min(point[0] + 14, canvas.clientWidth - tip.offsetWidth - 4);
  tip.style.setProperty('left', `${Math.max(4, left)}px`);
  tip.style.setProperty('top', `${point[1] + 18 + tip.offsetHeight > canvas.clientHeight ? point[1] - tip.offsetHeight - 8 : point[1] + 18}px`);
}

function tipText(thing) {
  const { title, text } = weightsOf(thing);
  const changed = { room: shown.changedRooms, door: shown.changedDoors }[thing.kind]?.get(thing.index);
  if (!changed) return `${title}: ${text}`;
  const hardness = changed.old.hardness === changed.new.hardness ? '' : ` hardness ${number(changed.old.hardness)} → ${number(changed.new.hardness)}`;
  const acted = changed.old.action === changed.new.action ? '' : ` ${action(changed.old.action)} → ${action(changed.new.action)}`;
  const opened = changed.old.passable === changed.new.passable ? '' : changed.new.passable ? ' opens' : ' shuts';
  return `${title} would change:${hardness}${acted}${opened}`;
}

function resize() {
  const dense = window.devicePixelRatio || 1;
  const { clientWidth: width, clientHeight: height } = canvas;
  if (!width) return;
  if (canvas.width !== Math.round(width * dense) || canvas.height !== Math.round(height * dense)) {
    for (const layer of [canvas, over.canvas]) {
      layer.width = Math.round(width * dense);
      layer.height = Math.round(height * dense);
    }
    const [wider, higher] = [width - size[0], height - size[1]];
    size = [width, height];
    if (model.map && String(camera.bounds) === String(model.map.bounds)) camera.grown(wider, higher);
    else if (model.map) fit();
    invalidate();
  }
}

/** Shows a room or door of the list: in the middle, with a line around it. */
export function point(kind, index) {
  const { map } = model;
  if (kind === 'space' || kind === 'doorway') return pointAtNoun(kind, index);
  const layer = kind === 'room' ? map.rooms[index].layer : map.rooms[model.roomIndex.get(map.doors[index].room1)].layer;
  if (layer !== null) byId('pieces').checked = true;
  if (layer !== null && shown.layer !== EASIEST && shown.layer !== layer) {
    byId('layer').value = String(layer);
    redraw();
  }
  const at = kind === 'room' ? centreOf(map.rooms[index]) : middleOf(map.doors[index].segment);
  camera.show(at);
  pointed = { kind, index, at };
  invalidate();
  return { thing: { kind, index, at, areas: finder().areasAt(at) }, screen: camera.toScreen(at) };
}

function pointAtNoun(kind, index) {
  const { map } = model;
  const at = kind === 'space' ? map.spaces[index].at : middleOf(map.doorways[index].segment);
  byId('pieces').checked = false;
  camera.show(at);
  const common = { at, space: finder().spaceAt(at), areas: finder().areasAt(at), place: finder().placeAt(at, 0) };
  const room = kind === 'space' ? shown.topRoom(finder().roomsAt(at)) : -1;
  const thing = kind === 'doorway' ? { kind, index, ...common } : { kind: room >= 0 ? 'room' : 'wall', index: room, ...common };
  pointed = thing.kind === 'wall' ? null : thing;
  redraw();
  return { thing, screen: camera.toScreen(at) };
}

/** Moves a point into view. */
export function showAt(at) {
  if (shown) camera.show(at);
}

/** Opens the card of a thing of the list, as a click on it would. */
export function openCard(kind, index) {
  const { thing, screen } = point(kind, index);
  byId('map-box').scrollIntoView({ block: 'nearest' });
  openPopover(thing, screen);
}

/** Makes the map answer. `lead(end, at)` sets the start or the goal to a point. */
export function startMap(lead) {
  camera.listen((at, event) => {
    if (!shown) return;
    const thing = thingAt(at, event.pointerType === 'touch' ? 16 : 8);
    byId('tip').hidden = true;
    const tool = drawing() ?? measuring();
    if (tool) return tool.tap(at, event);
    if (event.shiftKey) return lead('goal', thing);
    if (!model.ask.start) return lead('start', thing);
    if (!model.ask.goal) return lead('goal', thing);
    return openPopover(thing, at);
  }, hover);
  startDraw(camera, invalidateOver);
  startMeasuring(camera, invalidateOver);
  canvas.addEventListener('focus', pointAtMiddle);
  byId('zoom-in').addEventListener('click', () => camera.zoom(1.4));
  byId('zoom-out').addEventListener('click', () => camera.zoom(1 / 1.4));
  byId('zoom-fit').addEventListener('click', fit);
  byId('layer').addEventListener('change', redraw);
  byId('pieces').addEventListener('change', redraw);
  byId('scan').addEventListener('change', () => showScan(byId('scan').checked, redraw));
  model.on('map', newMap);
  model.on('weights', redraw);
  // The words of a preview come first: on a large floor it takes a moment to find what is drawn otherwise.
  model.on('preview ahead', () => requestAnimationFrame(redraw));
  let robot = model.ask.robot;
  model.on('ask', () => {
    if (robot === model.ask.robot || !model.map) return;
    robot = model.ask.robot;
    layerChoice();
    redraw();
  });
  model.on('route whyNot', invalidate);
  model.on('pending', invalidateOver);
  onTheme(() => {
    ink = null;
    redraw();
  });
  new ResizeObserver(resize).observe(canvas);
  new ResizeObserver(standAbove).observe(byId('map-foot'));
}
