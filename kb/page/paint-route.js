/** Paints ways: the present one coloured by action, with its direction; a previewed or refused one dashed. */

import { model } from './model.js';
import { write } from './paint.js';

/** All ways that are known now. */
export function paintRoutes(context, camera, shown, ink) {
  const previewed = model.preview?.route;
  if (model.route?.waypoints?.length) way(context, camera, shown, ink, model.route.waypoints);
  if (model.whyNot?.route?.waypoints) plain(context, camera, model.whyNot.route.waypoints, ink.shut, ink);
  if (previewed?.waypoints && differs(previewed, model.route)) plain(context, camera, previewed.waypoints, ink['amber-line'], ink);
  ends(context, camera, ink);
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
function way(context, camera, shown, ink, waypoints) {
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
    label(context, run, shown.actions.letter(action), ink);
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

function label(context, run, letter, ink) {
  const whole = run.slice(1).reduce((sum, point, i) => sum + length(run[i], point), 0);
  if (whole < 40) return;
  let left = whole * 0.3;
  for (let i = 0; i + 1 < run.length; i += 1) {
    const here = length(run[i], run[i + 1]);
    if (left <= here) {
      const part = left / here;
      context.font = '700 12px system-ui, sans-serif';
      write(context, letter, run[i][0] + part * (run[i + 1][0] - run[i][0]), run[i][1] + part * (run[i + 1][1] - run[i][1]) - 12, ink);
      return;
    }
    left -= here;
  }
}

function ends(context, camera, ink) {
  const waypoints = model.route?.waypoints ?? [];
  if (!waypoints.length) return;
  const [first, last] = [waypoints[0], waypoints.at(-1)];
  disc(context, camera, first, ink, ink.paper);
  disc(context, camera, last, ink, ink.ink);
  context.font = '700 13px system-ui, sans-serif';
  const named = (text) => (model.map.places.some(({ place }) => place === text) ? '' : `: ${text}`);
  for (const [waypoint, word, text, down] of [[first, 'start', model.route.start, 17], [last, 'goal', model.route.goal, -17]]) {
    const [px, py] = camera.toScreen([waypoint.x, waypoint.y]);
    write(context, `${word}${named(text)}`, px, py + down, ink);
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
