/** Paints what is measured on the map: the stretches, their points, and how long they are. */

import { metresOf } from './measure.js';

const DOT = 5;
const BOLD = '600 13px system-ui, sans-serif';

/** `ahead` is where the next point would be. */
export function paintMeasured(context, camera, ink, labels, { points, ahead }) {
  const at = points.map((point) => camera.toScreen(point));
  if (ahead) line(context, ink, [at.at(-1), camera.toScreen(ahead)], [6, 5]);
  line(context, ink, at, []);
  for (const [x, y] of at) dot(context, ink, x, y);
  const all = ahead ? [...points, ahead] : points;
  all.slice(1).forEach((point, i) => length(context, camera, ink, labels, all[i], point));
  if (all.length > 2) {
    const [x, y] = camera.toScreen(all.at(-1));
    plate(context, ink, labels, `${metresOf(all)} in all`, [[x + 12, y + 14, 'left'], [x - 12, y + 14, 'right'], [x + 12, y - 16, 'left'], [x - 12, y - 16, 'right']]);
  }
}

function line(context, ink, at, dashes) {
  if (at.length < 2) return;
  context.lineJoin = 'round';
  for (const [colour, wide] of [[ink.paper, 6], [ink.ink, 2.5]]) {
    context.beginPath();
    at.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
    context.setLineDash(colour === ink.paper ? [] : dashes);
    context.lineWidth = wide;
    context.strokeStyle = colour;
    context.stroke();
  }
  context.setLineDash([]);
}

function dot(context, ink, x, y) {
  context.beginPath();
  context.arc(x, y, DOT, 0, 7);
  context.fillStyle = ink.paper;
  context.fill();
  context.lineWidth = 2.5;
  context.strokeStyle = ink.ink;
  context.stroke();
}

// Beside the middle of the stretch, off its line.
function length(context, camera, ink, labels, from, to) {
  const [[ax, ay], [bx, by]] = [camera.toScreen(from), camera.toScreen(to)];
  const [x, y] = [(ax + bx) / 2, (ay + by) / 2];
  const isSteep = Math.abs(by - ay) > Math.abs(bx - ax);
  plate(context, ink, labels, metresOf([from, to]), isSteep ? [[x + 9, y, 'left'], [x - 9, y, 'right']] : [[x, y - 14, 'center'], [x, y + 14, 'center']]);
}

// The words of the floor beneath do not show through.
function plate(context, ink, labels, text, spots) {
  if (!labels.put(text, spots, BOLD)) return;
  const [x0, y0, x1, y1] = labels.taken.at(-1);
  context.globalCompositeOperation = 'destination-over';
  context.fillStyle = ink.paper;
  context.fillRect(x0 - 3, y0 - 1, x1 - x0 + 6, y1 - y0 + 2);
  context.globalCompositeOperation = 'source-over';
}
