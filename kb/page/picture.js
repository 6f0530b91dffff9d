/** A map that is not cut into rooms: the picture that the service draws of it, with the way that is asked for. */

import { get, path } from './api.js';
import { byId } from './dom.js';
import { complain } from './notice.js';
import { model } from './model.js';

let asked = 0;

async function draw() {
  if (!model.site?.layout_kind) return;
  asked += 1;
  const mine = asked;
  const { start, goal, robot } = model.ask;
  const there = model.route && !model.route.error;
  try {
    const svg = await get(path('/api/picture', there ? { start, goal, robot } : {}), { text: true });
    if (mine !== asked) return;
    const parsed = new DOMParser().parseFromString(svg, 'image/svg+xml').documentElement;
    const box = byId('picture');
    box.replaceChildren(document.importNode(parsed, true));
    box.setAttribute('aria-label', there ? `Map with the way from ${start} to ${goal}` : 'Map');
    box.dataset.generation = model.weights.generation;
    box.hidden = false;
    model.dispatchEvent(new Event('picture'));
  } catch (error) {
    if (mine === asked && error.status !== 0) complain(error);
  }
}

/** Draws it, and again whenever the site or the way is another. */
export function startPicture() {
  model.on('weights route', draw);
}
