/** In what two texts differ, line by line. */

import { el } from './dom.js';

const AROUND = 2;
/** Longer texts are compared without looking for what stayed in between. */
const MOST = 4_000_000;

/** How many lines the longest common part of the rest of both has, for each pair of lines. */
function lengths(old, now) {
  const width = now.length + 1;
  const table = new Uint32Array((old.length + 1) * width);
  for (let i = old.length - 1; i >= 0; i -= 1) {
    for (let j = now.length - 1; j >= 0; j -= 1) {
      table[i * width + j] = old[i] === now[j] ? table[(i + 1) * width + j + 1] + 1 : Math.max(table[(i + 1) * width + j], table[i * width + j + 1]);
    }
  }
  return (i, j) => table[i * width + j];
}

/** All lines of both, each `same`, `gone` or `new`. @returns {{kind: string, text: string, line: number}[]} */
export function lines(before, after) {
  const split = (text) => (text ? text.replace(/\n$/, '').split('\n') : []);
  const [old, now] = [split(before), split(after)];
  let head = 0;
  while (head < old.length && head < now.length && old[head] === now[head]) head += 1;
  let tail = 0;
  while (tail < old.length - head && tail < now.length - head && old.at(-1 - tail) === now.at(-1 - tail)) tail += 1;
  const [a, b] = [old.slice(head, old.length - tail), now.slice(head, now.length - tail)];
  const same = (from, to) => now.slice(from, to).map((text, at) => ({ kind: 'same', text, line: from + at + 1 }));
  const found = same(0, head);
  const common = a.length * b.length > MOST ? () => 0 : lengths(a, b);
  let [i, j] = [0, 0];
  while (i < a.length || j < b.length) {
    if (i < a.length && j < b.length && a[i] === b[j]) {
      found.push({ kind: 'same', text: b[j], line: head + j + 1 });
      i += 1;
      j += 1;
    } else if (i < a.length && (j >= b.length || common(i + 1, j) >= common(i, j + 1))) {
      found.push({ kind: 'gone', text: a[i], line: head + i + 1 });
      i += 1;
    } else {
      found.push({ kind: 'new', text: b[j], line: head + j + 1 });
      j += 1;
    }
  }
  return [...found, ...same(now.length - tail, now.length)];
}

/** What became of a text in a few words: `2 lines in place of 1`. */
export function inWords(before, after) {
  const all = lines(before, after);
  const of = (kind) => all.filter((line) => line.kind === kind).length;
  const [more, gone] = [of('new'), of('gone')];
  const noun = (n) => `${n} ${n === 1 ? 'line' : 'lines'}`;
  if (more && more === gone) return `${noun(more)} changed`;
  if (more && gone) return `${noun(more)} in place of ${gone}`;
  return more ? `${noun(more)} more` : gone ? `${noun(gone)} fewer` : 'as it was';
}

const SIGNS = { same: ' ', gone: '−', new: '+' };
const SAID = { gone: 'gone: ', new: 'new: ' };

/** The difference to be read: what changed, with some lines around it. */
export function difference(before, after) {
  const all = lines(before, after);
  const near = (at) => all.slice(Math.max(0, at - AROUND), at + AROUND + 1).some(({ kind }) => kind !== 'same');
  const shown = [];
  all.forEach((line, at) => {
    if (near(at)) shown.push(el('li', { class: line.kind }, el('span', { class: 'sign', 'aria-hidden': 'true', text: `${String(line.line).padStart(4)} ${SIGNS[line.kind]} ` }), SAID[line.kind] ? el('span', { class: 'unseen', text: SAID[line.kind] }) : null, line.text || ' '));
    else if (at && near(at - 1)) shown.push(el('li', { class: 'between', text: '…' }));
  });
  return shown.length ? el('ul', { class: 'difference', tabindex: '0', 'aria-label': 'What differs' }, ...shown) : el('p', { class: 'hint', text: 'There is no difference.' });
}
