/** A mission that is looked at again: the robot goes over the map as its journal says, with what it met and which rule decided. */

import { button, byId, el, fill, shut } from './dom.js';
import { time } from './format.js';
import { ended, fromTo } from './mission-words.js';
import { model } from './model.js';
import { lookAtMap } from './sheet.js';

const SPEEDS = [1, 4, 16];
const START_SPEED = 4;
/** Seconds of the mission that an arrow key moves on. */
const STEP_S = 0.5;

let mission = null;
let at = 0;
let speed = START_SPEED;
let playing = 0;
let parts = null;

/** The last entry of the journal at a time. */
const lastAt = (seconds) => mission.journal.findLastIndex((entry) => entry.time <= seconds);

const turned = (from, to, share) => from + ((((to - from) % 360) + 540) % 360 - 180) * share;

/** Between two poses, where the robot was at a time. */
function between(one, other, share) {
  return [one[0] + (other[0] - one[0]) * share, one[1] + (other[1] - one[1]) * share, turned(one[2], other[2], share)];
}

/** What is seen of the mission at a time. */
function scene() {
  const { journal } = mission;
  const index = Math.max(0, lastAt(at));
  const [before, after] = [journal[index], journal[index + 1] ?? journal[index]];
  const share = after.time > before.time ? Math.max(0, Math.min(1, (at - before.time) / (after.time - before.time))) : 0;
  const past = journal.slice(0, index + 1);
  const newest = (of) => past.findLast((entry) => entry[of])?.[of] ?? null;
  const pose = between(before.pose, after.pose, share);
  const truth = before.truth && after.truth ? between(before.truth, after.truth, share) : null;
  const shape = newest('shape');
  return {
    pose, truth, way: newest('way'), start: mission.start, goal: mission.goal,
    trail: [...past.map((entry) => (entry.truth ?? entry.pose).slice(0, 2)), (truth ?? pose).slice(0, 2)],
    seen: past.flatMap((entry) => entry.seen ?? []),
    name: [mission.robot, shape].filter(Boolean).join(', '),
    decided: past.findLast((entry) => entry.next),
  };
}

const quoted = (text) => `“${text}”`;

function decision({ next, action, rule }) {
  const does = action ? `${action}, then ${next}` : next;
  return rule ? `What it does: ${does}, by rule ${quoted(rule)}.` : `What it does: ${does}.`;
}

function show() {
  const seen = scene();
  model.set('replay', seen);
  parts.slider.value = String(at);
  parts.slider.setAttribute('aria-valuetext', `${time(at)} of ${time(mission.seconds)}`);
  parts.now.textContent = `${time(at)} of ${time(mission.seconds)}`;
  parts.decided.textContent = seen.decided ? decision(seen.decided) : '';
  for (const { item, when } of parts.story) item.classList.toggle('past', when <= at);
}

function play(isOn) {
  cancelAnimationFrame(playing);
  playing = 0;
  parts.toggle.textContent = isOn ? 'Pause' : 'Play';
  if (!isOn) return;
  if (at >= mission.seconds) at = 0;
  let before = null;
  const frame = (now) => {
    if (!mission) return;
    at = Math.min(mission.seconds, at + (before === null ? 0 : ((now - before) / 1000) * speed));
    before = now;
    show();
    if (at < mission.seconds) playing = requestAnimationFrame(frame);
    else play(false);
  };
  playing = requestAnimationFrame(frame);
}

function leave() {
  play(false);
  mission = null;
  byId('replay-card').hidden = true;
  model.set('replay', null);
  byId('missions-card').querySelector('summary').focus();
}

const goTo = (seconds) => {
  at = seconds;
  show();
};

/** What was met, each with the time at which it was: press it, and the robot stands there. */
function told() {
  const met = mission.journal.filter((entry) => entry.words);
  return met.map(({ time: when, words }) => ({ when, item: el('li', {}, button(time(when), () => goTo(when), { class: 'link' }), ` ${words}`) }));
}

/** Looks at a mission again from its beginning. */
export function replay(wanted) {
  if (mission) play(false);
  mission = wanted;
  at = 0;
  const slider = el('input', { type: 'range', min: '0', max: String(mission.seconds), step: String(STEP_S), value: '0', 'aria-label': 'Time of the mission', on: { input: () => goTo(Number(slider.value)) } });
  const toggle = button('Play', () => play(!playing), { class: 'strong' });
  const pace = el('select', { on: { change: () => { speed = Number(pace.value); } } }, ...SPEEDS.map((times) => el('option', { value: String(times), text: times === 1 ? 'as fast as it was' : `${times} times as fast`, selected: times === speed })));
  const story = told();
  parts = { slider, toggle, story, now: el('output', { class: 'hint' }), decided: el('p', { class: 'hint' }) };
  const title = el('h2', { tabindex: '-1', text: `Mission ${mission.mission}: ${fromTo(mission)}` });
  const how = el('p', { text: `It ${ended(mission)}, after ${time(mission.seconds)} and ${mission.length.toFixed(1)} m.` });
  const met = story.length ? el('ol', { class: 'plain story' }, ...story.map(({ item }) => item)) : el('p', { class: 'hint', text: 'It met nothing that it did not know.' });
  fill(byId('replay-card'), title, shut('the mission', leave), how, el('div', { class: 'buttons' }, toggle, el('label', {}, 'Shown ', pace)), slider, parts.now, parts.decided, met);
  byId('replay-card').hidden = false;
  show();
  lookAtMap();
  byId('replay-card').scrollIntoView({ block: 'nearest' });
  title.focus();
}
