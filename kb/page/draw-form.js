/** The form beside what is drawn: what it is, how it is called, and where it lies in numbers. */

import { el, fill } from './dom.js';
import { corners } from './measure.js';
import { model } from './model.js';
import { spokenOf } from './spoken.js';

/** What can be drawn. */
export const WORDS = { area: 'an area', obstacle: 'an obstacle', place: 'a place', bridge: 'a bridge', door: 'a named doorway' };

/** How it is drawn. */
export const HOW = {
  rectangle: 'Drag from corner to corner on the map, or press each.',
  polygon: 'Press corner after corner on the map; drag a corner to move it.',
  place: 'Press on the map where it is.',
  door: 'Drag from post to post on the map, or press each.',
};

/** Points as they are written: `x,y x,y`; null where that is none. */
export function points(text) {
  const pairs = text.trim().split(/\s+/).filter(Boolean).map((pair) => pair.split(',').map(Number));
  return pairs.every((pair) => pair.length === 2 && pair.every(Number.isFinite)) ? pairs : null;
}

/** Two corners of a rectangle along the axes, where that is one. */
export function rectangleOf(outline) {
  const two = [outline[0], outline[2]];
  const said = (points) => JSON.stringify(points);
  const all = outline.length === 4 ? corners(two) : [];
  return [all, [all[0], all[3], all[2], all[1]]].some((turned) => said(turned) === said(outline)) ? two : null;
}

/** The kinds that mean something here: those of which rules speak, and those that lie on the map. */
async function kindsOf(what) {
  const onMap = what === 'door' ? model.map.named_doors : model.map.areas;
  const lying = [...onMap, ...model.laid.filter((laid) => laid.what === what)].map(({ kind }) => kind);
  const spoken = await spokenOf(what === 'door' ? 'NAMED_DOORS' : 'AREAS', 'kind').catch(() => []);
  // `keepout` is another way to write `keep-out`.
  const plain = (kind) => kind.replace(/[^\p{L}\p{N}]/gu, '').toLowerCase();
  return [...new Map([...spoken, ...lying].filter(Boolean).reverse().map((kind) => [plain(kind), kind])).values()].reverse();
}

/** The fields, and the form with them. `changed`, `done` and `forget` are called when they are. */
export function fields({ changed, done, forget }) {
  const option = (from) => Object.entries(from).map(([name, text]) => el('option', { value: name, text }));
  const on = { input: changed, change: changed };
  const input = (id, more = {}) => el('input', { id: `draw-${id}`, autocomplete: 'off', spellcheck: 'false', on, ...more });
  const made = {
    what: el('select', { id: 'draw-what', on }, ...option(WORDS)),
    shape: el('select', { id: 'draw-shape', on }, ...option({ rectangle: 'a rectangle', polygon: 'a polygon' })),
    name: input('name'),
    kind: input('kind', { list: 'draw-kinds', placeholder: 'if you like' }),
    height: input('height', { placeholder: '1.3', inputmode: 'decimal', size: '6' }),
    corners: input('corners', { placeholder: 'x,y x,y', inputmode: 'text' }),
    until: input('until', { placeholder: '18:00, 2h', title: 'A time, a while, or a day with its time: 18:00, 2h, 2026-12-24T08:00; else until it is taken away' }),
    how: el('p', { class: 'hint', id: 'draw-how' }),
    size: el('p', { class: 'hint', id: 'draw-size' }),
  };
  const label = (text, field) => el('label', {}, `${text} `, field);
  made.shapeLabel = label('As', made.shape);
  made.kindLabel = label('Kind', made.kind);
  made.heightLabel = label('Clear height, metres', made.height);
  made.cornersLabel = label('Corners, metres', made.corners);
  const kinds = el('datalist', { id: 'draw-kinds' });
  let offered = null;
  /** Offers the kinds of what is drawn. */
  made.offer = async (what) => {
    if (offered === what) return;
    offered = what;
    const found = await kindsOf(what);
    if (offered !== what) return;
    fill(kinds, ...found.map((kind) => el('option', { value: kind })));
    made.kind.placeholder = found.length ? `${found.slice(0, 2).join(', ')}…` : 'if you like';
  };
  made.form = el('form', { id: 'draw-form', class: 'card draw-form', 'aria-label': 'Draw on the map', on: { submit: (event) => { event.preventDefault(); done(); } } },
    label('Draw', made.what), made.shapeLabel, made.how, label('Name', made.name), made.kindLabel, made.heightLabel, made.cornersLabel, made.size, label('Until', made.until),
    kinds,
    el('div', { class: 'buttons' }, el('button', { type: 'submit', id: 'draw-done', text: 'Done' }), el('button', { type: 'button', id: 'draw-discard', text: 'Discard', on: { click: forget } })));
  made.form.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape') return;
    event.stopPropagation();
    done();
  });
  return made;
}
