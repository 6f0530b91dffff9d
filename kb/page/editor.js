/** A plain editor: a textarea over its coloured text, with line numbers. */

import { el, fill } from './dom.js';
import { completion } from './completion.js';
import { coloured, offset } from './highlight.js';

/**
 * Makes an editor.
 * @param {{label: string, language: string, changed: (text: string) => void, numbers?: boolean, rows?: number, propose?: (text: string, at: number) => Promise<Object[]>}} wishes
 */
export function editor({ label, language, changed, numbers = true, rows = 24, propose = null }) {
  const under = el('pre', { class: 'under', 'aria-hidden': 'true' });
  const gutter = el('pre', { class: 'gutter', 'aria-hidden': 'true' });
  const area = el('textarea', { 'aria-label': label, spellcheck: 'false', autocapitalize: 'off', autocomplete: 'off', wrap: 'off', rows: String(rows) });
  const box = el('div', { class: 'editor-text' }, under, area);
  const node = el('div', { class: numbers ? 'editor numbered' : 'editor' }, numbers ? gutter : null, box);
  let problems = [];
  let kind = language;

  const draw = () => {
    // The last line needs a letter, or the coloured text is a line shorter than what is typed.
    fill(under, ...coloured(area.value, kind, problems), '\n ');
    const lines = area.value.split('\n').length;
    const wrong = new Set(problems.map((problem) => problem.line));
    // So do the numbers: what is typed is scrolled further by the height of its scrollbar, which they do not have.
    fill(gutter, ...Array.from({ length: lines }, (_, i) => el('span', { class: wrong.has(i + 1) ? 'wrong' : '', text: `${wrong.has(i + 1) ? '✕' : ''}${i + 1}\n` })), ' ');
    scroll();
  };
  const scroll = () => {
    under.scrollTop = area.scrollTop;
    under.scrollLeft = area.scrollLeft;
    gutter.scrollTop = area.scrollTop;
  };
  const typed = () => {
    draw();
    changed(area.value);
  };
  area.addEventListener('input', typed);
  if (propose) box.append(...completion(area, { ask: propose, changed: typed, isOn: () => !area.readOnly && kind === 'rhai' }));
  area.addEventListener('scroll', scroll);

  return {
    node,
    area,
    get text() { return area.value; },
    /** Shows another text. */
    show(text, what = kind) {
      kind = what;
      problems = [];
      area.value = text;
      draw();
    },
    /** Underlines problems where they are. */
    mark(found) {
      problems = found;
      draw();
    },
    /** Puts the cursor on a line. */
    go(line, column = 1) {
      const at = offset(area.value, line, column);
      area.focus();
      area.setSelectionRange(at, at);
      area.scrollTop = Math.max(0, (line - 6) * (area.scrollHeight / Math.max(1, area.value.split('\n').length)));
      scroll();
    },
    /** Puts a text where the cursor is. */
    insert(text) {
      area.setRangeText(text, area.selectionStart, area.selectionEnd, 'end');
      area.focus();
      draw();
      changed(area.value);
    },
  };
}
