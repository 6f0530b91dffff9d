/** Paints what is drawn and not saved yet, what is to be taken away, and what would come or go with what is taken back. */

import { corners } from './measure.js';
import { model } from './model.js';

const HANDLE = 5;

/** Over everything but the words. */
export function paintPending(context, camera, ink, labels) {
  const shapes = [...model.pending.values()].map(({ shape }) => shape).concat(model.ahead?.shapes ?? []);
  for (const shape of shapes) if (shape?.points.length) drawn(context, camera, ink, labels, shape);
}

function drawn(context, camera, ink, labels, { what, name, points, open, gone }) {
  const at = points.map((point) => camera.toScreen(point));
  if (what === 'place') pin(context, ink, at[0], gone);
  else {
    outline(context, (what === 'door' ? points : corners(points)).map((point) => camera.toScreen(point)), what, ink);
    if (gone) cross(context, at, ink);
  }
  if (open) for (const [x, y] of at) handle(context, ink, x, y);
  const [left, top] = [Math.min(...at.map(([x]) => x)), Math.min(...at.map(([, y]) => y))];
  labels.put(gone ? `${name} goes` : name || 'without a name', what === 'place' ? [[at[0][0] + 10, at[0][1], 'left'], [at[0][0] - 10, at[0][1], 'right']] : [[left + 2, top - 10, 'left'], [left + 6, top + 12, 'left']], '600 12px system-ui, sans-serif');
}

function outline(context, at, what, ink) {
  context.beginPath();
  at.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
  context.closePath();
  context.globalAlpha = what === 'obstacle' ? 0.75 : 0.4;
  context.fillStyle = what === 'obstacle' ? ink.wall : ink.amber;
  context.fill();
  context.globalAlpha = 1;
  context.lineWidth = 2.5;
  context.setLineDash([7, 4]);
  context.strokeStyle = ink['amber-line'];
  context.stroke();
  context.setLineDash([]);
}

function cross(context, at, ink) {
  const [xs, ys] = [0, 1].map((axis) => at.map((point) => point[axis]));
  const [x0, x1, y0, y1] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  context.strokeStyle = ink.shut;
  context.lineWidth = 3;
  for (const [from, to] of [[y0, y1], [y1, y0]]) {
    context.beginPath();
    context.moveTo(x0, from);
    context.lineTo(x1, to);
    context.stroke();
  }
}

function pin(context, ink, [x, y], gone) {
  context.beginPath();
  context.arc(x, y, 7, 0, 7);
  context.fillStyle = ink.amber;
  context.fill();
  context.lineWidth = 3;
  context.strokeStyle = gone ? ink.shut : ink['amber-line'];
  context.stroke();
  if (gone) cross(context, [[x - 8, y - 8], [x + 8, y + 8]], ink);
}

function handle(context, ink, x, y) {
  context.fillStyle = ink.paper;
  context.strokeStyle = ink['amber-line'];
  context.lineWidth = 2;
  context.fillRect(x - HANDLE, y - HANDLE, 2 * HANDLE, 2 * HANDLE);
  context.strokeRect(x - HANDLE, y - HANDLE, 2 * HANDLE, 2 * HANDLE);
}
