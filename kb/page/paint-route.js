/** Paints ways: the present one coloured by action, with its direction; a previewed or refused one dashed. */

import { model } from './model.js';

/** All ways that are known now. */
export function paintRoutes(context, camera, shown, ink, labels) {
  const previewed = model.tried?.route;
  const letters = [];
  if (previewed?.waypoints && differs(previewed, model.route)) band(context, camera, previewed.waypoints, ink['amber-line']);
  if (model.route?.waypoints?.length) way(context, camera, shown, ink, model.route.waypoints, letters);
  if (model.whyNot?.route?.waypoints) plain(context, camera, model.whyNot.route.waypoints, ink.shut, ink);
  ends(context, camera, ink, labels);
  for (const { text, at: [x, y] } of letters) labels.put(text, [[x, y - 13, 'center'], [x, y + 13, 'center'], [x + 14, y, 'left'], [x - 14, y, 'right']], '700 12px system-ui, sans-serif');
}

function differs(one, other) {
  const said = (route) => JSON.stringify(route?.waypoints?.map(({ x, y, action }) => [x, y, action]));
  return said(one) !== said(other);
}

function line(context, points) {
  context.beginPath();
  points.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
  context.stroke();
}

// Under the present way and wider than it: both are seen where they lead the same way.
function band(context, camera, waypoints, colour) {
  context.lineCap = 'butt';
  context.lineJoin = 'round';
  context.strokeStyle = colour;
  context.lineWidth = 12;
  context.setLineDash([5, 3]);
  line(context, waypoints.map(({ x, y }) => camera.toScreen([x, y])));
  context.setLineDash([]);
}

function plain(context, camera, waypoints, colour, ink) {
  const points = waypoints.map(({ x, y }) => camera.toScreen([x, y]));
  context.lineCap = 'round';
  context.lineJoin = 'round';
  context.strokeStyle = ink.paper;
  context.lineWidth = 7;
  line(context, points);
  context.strokeStyle = colour;
  context.lineWidth = 4;
  context.setLineDash([2, 8]);
  line(context, points);
  context.setLineDash([]);
}

// A waypoint says the action with which one arrives at it.
function way(context, camera, shown, ink, waypoints, letters) {
  const points = waypoints.map(({ x, y }) => camera.toScreen([x, y]));
  context.lineCap = 'round';
  context.lineJoin = 'round';
  context.strokeStyle = ink.paper;
  context.lineWidth = 8;
  line(context, points);
  context.lineCap = 'butt';
  for (let from = 0; from + 1 < points.length;) {
    const { action } = waypoints[from + 1];
    let to = from + 1;
    while (to + 1 < points.length && waypoints[to + 1].action === action) to += 1;
    const run = points.slice(from, to + 1);
    context.strokeStyle = shown.actions.colour(action);
    context.lineWidth = 4.5;
    context.setLineDash(shown.actions.dash(action));
    line(context, run);
    context.setLineDash([]);
    arrows(context, run, shown.actions.colour(action), ink);
    const at = along(run, 0.3);
    if (at) letters.push({ text: shown.actions.letter(action), at });
    from = to;
  }
}

const length = ([ax, ay], [bx, by]) => Math.hypot(bx - ax, by - ay);

function arrows(context, run, colour, ink) {
  for (let i = 0; i + 1 < run.length; i += 1) {
    const [[ax, ay], [bx, by]] = [run[i], run[i + 1]];
    if (length(run[i], run[i + 1]) < 34) continue;
    context.save();
    context.translate((ax + bx) / 2, (ay + by) / 2);
    context.rotate(Math.atan2(by - ay, bx - ax));
    context.beginPath();
    context.moveTo(9, 0);
    context.lineTo(-6, -7);
    context.lineTo(-6, 7);
    context.closePath();
    context.fillStyle = colour;
    context.strokeStyle = ink.paper;
    context.lineWidth = 1.5;
    context.fill();
    context.stroke();
    context.restore();
  }
}

// The point at this share of a run, or nothing where the run is too short to be spoken of.
function along(run, share) {
  const whole = run.slice(1).reduce((sum, point, i) => sum + length(run[i], point), 0);
  if (whole < 14) return null;
  let left = whole * share;
  for (let i = 0; i + 1 < run.length; i += 1) {
    const here = length(run[i], run[i + 1]);
    if (left <= here) return run[i].map((value, axis) => value + (left / here) * (run[i + 1][axis] - value));
    left -= here;
  }
  return run.at(-1);
}

function ends(context, camera, ink, labels) {
  const waypoints = model.route?.waypoints ?? [];
  if (!waypoints.length) return;
  const [first, last] = [waypoints[0], waypoints.at(-1)];
  disc(context, camera, first, ink, ink.paper);
  disc(context, camera, last, ink, ink.ink);
  for (const [waypoint, word, text, down] of [[first, 'start', model.route.start, 17], [last, 'goal', model.route.goal, -17]]) {
    const [px, py] = camera.toScreen([waypoint.x, waypoint.y]);
    labels.keep(px, py, 9);
    labels.put(`${text} (${word})`, [[px, py + down, 'center'], [px, py - down, 'center'], [px + 14, py, 'left'], [px - 14, py, 'right']], '700 13px system-ui, sans-serif');
  }
}

function disc(context, camera, { x, y }, ink, colour) {
  const [px, py] = camera.toScreen([x, y]);
  context.beginPath();
  context.arc(px, py, 7, 0, 7);
  context.fillStyle = colour;
  context.fill();
  context.lineWidth = 3;
  context.strokeStyle = ink.ink;
  context.stroke();
}
