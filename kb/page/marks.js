/** Marks over the map: where robots are, the way of the one that is looked at, and a mission that is looked at again. */

import { byId } from './dom.js';
import { model } from './model.js';

const NS = 'http://www.w3.org/2000/svg';
/** How large a robot is marked, pixels: as a sign, whatever its size. */
const RADIUS = 8;
const NOSE = 15;
const FONT = 12;
/** Seconds after which a robot that is not heard is marked as one that may be elsewhere by now. */
export const QUIET_S = 10;

let camera = null;

function svg(tag, attributes, ...children) {
  const made = document.createElementNS(NS, tag);
  for (const [name, value] of Object.entries(attributes)) if (value !== null && value !== undefined) made.setAttribute(name, value);
  made.append(...children.filter(Boolean));
  return made;
}

/** What a robot is called: its name, or whose ways it drives. */
export const called = ({ name, robot }) => name ?? `a ${robot ?? 'robot'} without a name`;

/** Draws with `to`, which leads from metres to the picture; `unit` is a pixel there. */
class Marks {
  constructor(to, unit) { Object.assign(this, { to, unit }); }

  line(points, kind) {
    if (!points || points.length < 2) return null;
    return svg('polyline', { class: kind, points: points.map((point) => this.to(point).join(',')).join(' '), 'vector-effect': 'non-scaling-stroke' });
  }

  body([x, y], heading, kind, label) {
    const [px, py] = this.to([x, y]);
    const r = RADIUS * this.unit;
    const nose = NOSE * this.unit;
    const turn = heading === null || heading === undefined ? null : (-heading * Math.PI) / 180;
    const at = (angle, far) => `${px + Math.cos(angle) * far},${py + Math.sin(angle) * far}`;
    const ahead = turn === null ? null : svg('polygon', { points: [at(turn, nose), at(turn + 1, r), at(turn - 1, r)].join(' ') });
    const text = label ? svg('text', { x: px + r + 4 * this.unit, y: py - r, 'font-size': FONT * this.unit, 'stroke-width': 4 * this.unit }) : null;
    if (text) text.textContent = label;
    return svg('g', { class: kind, 'stroke-width': 2 * this.unit }, ahead, svg('circle', { cx: px, cy: py, r }), text);
  }

  ring([x, y], kind) {
    const [px, py] = this.to([x, y]);
    return svg('circle', { class: kind, cx: px, cy: py, r: 6 * this.unit, 'stroke-width': 3 * this.unit });
  }

  robots() {
    const looked = model.robots.find((robot) => robot.key === model.lookedAt);
    const mark = (robot) => this.body([robot.x, robot.y], robot.heading, `robot${robot.seconds > QUIET_S ? ' quiet' : ''}${robot === looked ? ' looked-at' : ''}`, called(robot));
    return [this.line(looked?.way?.points, 'robot-way'), ...model.robots.map(mark)];
  }

  replay() {
    const { replay } = model;
    if (!replay) return [];
    const { way, trail, seen, start, goal, pose, truth, name } = replay;
    const lines = (seen ?? []).map(([x0, y0, x1, y1]) => this.line([[x0, y0], [x1, y1]], 'seen'));
    return [this.line(way, 'replay-way'), this.line(trail, 'trail'), ...lines, this.ring(start, 'replay-from'), this.ring(goal, 'replay-to'),
      truth ? this.body(truth, truth[2], 'truth', null) : null, this.body(pose, pose[2], 'replayed', name)];
  }

  all() {
    return [...this.robots(), ...this.replay()].filter(Boolean);
  }
}

function inPicture() {
  const picture = document.querySelector('#picture > svg');
  const metres = picture?.querySelector('#metres')?.transform.baseVal.consolidate()?.matrix;
  if (!metres) return;
  const { width, height } = picture.viewBox.baseVal;
  const unit = Math.max(width / picture.clientWidth, height / picture.clientHeight) || 1;
  picture.querySelector('.marks')?.remove();
  const marks = new Marks(([x, y]) => [metres.a * x + metres.e, metres.d * y + metres.f], unit);
  picture.append(svg('g', { class: 'marks' }, ...marks.all()));
}

/** Draws them anew. */
function draw() {
  if (model.site?.layout_kind) return inPicture();
  if (!camera) return undefined;
  byId('marks').replaceChildren(...new Marks((at) => camera.toScreen(at), 1).all());
  return undefined;
}

/** The map is seen from elsewhere. */
export function placeMarks(of) {
  camera = of;
  if (model.robots.length || model.replay || byId('marks').firstChild) draw();
}

/** Draws marks, and again whenever something has moved. */
export function startMarks() {
  model.on('robots lookedAt replay picture', draw);
}
