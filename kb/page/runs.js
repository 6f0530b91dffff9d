/** The steps of a route as a person would say them. */

import { action, cost, metres } from './format.js';
import { model } from './model.js';

/** Whether a run is longer than what is written as nothing. */
const isFar = (run) => metres(run.metres) !== metres(0);

/**
 * Steps of one action in a row become one run: {action, metres, cost, steps, end, changes}.
 * @param {Object} route the answer of `/api/route`
 */
export function runs(route) {
  const made = [];
  let at = route.waypoints[0];
  for (const step of route.steps) {
    let run = made.at(-1);
    // over a map that is drawn each line and arc counts for itself
    if (!run || run.action !== step.action || model.site?.layout_kind) {
      run = { action: step.action, metres: 0, cost: 0, steps: [], change: null };
      made.push(run);
    }
    // The last room of the paper's modes has no way in it that counts: its end is the door.
    const last = step === route.steps.at(-1) && route.distance === undefined;
    if (at && !last) run.metres += Math.hypot(step.x - at.x, step.y - at.y, (step.z ?? 0) - (at.z ?? 0));
    if (!last) at = step;
    run.cost += step.hardness ?? 0;
    run.steps.push(step);
    if (step.kind === 'change') run.change = step;
  }
  return made.filter((run) => isFar(run) || Number(cost(run.cost)) > 0 || made.length === 1);
}

/** Where a run leads: `to door 104`, `to ward 12`, `to where it changes shape`. */
export function leadsTo(all, index, goal) {
  if (index === all.length - 1) return `to ${goal}`;
  if (all[index].steps[0].kind === 'move') return `to ${all[index].steps[0].place}`;
  const next = all[index + 1].steps[0];
  if (next.kind === 'door') return `to door ${next.place}`;
  if (model.site?.layout_kind) return `to ${next.place}`;
  if (next.kind === 'change') return `then changes shape${next.state ? ` to ${next.state}` : ''}`;
  return `to room ${next.place}`;
}

/** A run in words. */
export const sentence = (all, index, goal) => `${isFar(all[index]) ? `${metres(all[index].metres)} ` : ''}${leadsTo(all, index, goal)}`;

/** One step in words: `room c, 15.2`, `door 28`. */
export function stepText(step) {
  if (model.site?.layout_kind) return `${step.kind}, ${step.place}: ${action(step.action)}`;
  const where = step.kind === 'change' ? `change of shape to ${step.state ?? '?'}` : `${step.kind} ${step.place}`;
  return `${where}: ${action(step.action)}`;
}

/** A point of the route in the middle of a run, as `x,y`. */
export function middle(run, route) {
  const first = route.steps.indexOf(run.steps[0]);
  const [from, to] = [route.steps[first - 1] ?? route.waypoints[0], run.steps.at(-1)];
  const at = run.steps.length > 1 ? run.steps[Math.floor((run.steps.length - 1) / 2)] : { x: (from.x + to.x) / 2, y: (from.y + to.y) / 2 };
  return `${at.x},${at.y}`;
}

/** What why asks of a run: its dearest step. */
export function telling(run) {
  const step = run.steps.reduce((best, one) => ((one.hardness ?? 0) > (best.hardness ?? 0) ? one : best), run.steps[0]);
  return why(step);
}

/** What why is asked of a step. */
export function why(step) {
  if (!model.site?.layout_kind) return `${step.kind === 'room' ? 'room' : 'door'} ${step.place}`;
  const { start, goal } = model.ask;
  if (step.kind === 'motion') return `goal ${goal}`;
  return `${step.place} from ${start} to ${goal}`;
}

/** The SQL that gives this route's steps from the site's database. */
export function asSql({ start, goal, robot }) {
  const text = (value) => `'${value.replaceAll("'", "''")}'`;
  const whose = (model.site?.robots.length ?? 1) > 1 ? ` AND robot = ${text(robot)}` : '';
  return `SELECT step, kind, place, action, cost FROM action_sequence WHERE start = ${text(start)} AND goal = ${text(goal)}${whose} ORDER BY step;`;
}
