/** What may stand where one types: proposed beneath the cursor, taken with Tab, or chosen with the arrows and taken with Enter. */

import { debounced, el, fill } from './dom.js';

const WAIT = 120;
const MOST = 12;
const KINDS = { class: 'class', property: 'property', variable: 'variable', function: 'function', word: 'word' };

/** The word that ends at a place of a text. */
const wordBefore = (text, at) => /[\p{L}\p{N}_]*$/u.exec(text.slice(0, at))[0];

/**
 * Completes what is typed into an editor's area.
 * @param {HTMLTextAreaElement} area
 * @param {{ask: (text: string, at: number) => Promise<Object[]>, changed: () => void, isOn: () => boolean}} wishes
 */
export function completion(area, { ask, changed, isOn }) {
  const list = el('ul', { class: 'proposals', id: 'proposals', role: 'listbox', 'aria-label': 'Proposals' });
  list.hidden = true;
  const measure = el('span', { class: 'measure', 'aria-hidden': 'true', text: '0'.repeat(100) });
  area.setAttribute('aria-controls', 'proposals');
  area.setAttribute('aria-autocomplete', 'list');
  let [found, chosen, asked] = [[], -1, 0];

  function close() {
    asked += 1;
    look.cancel();
    list.hidden = true;
    chosen = -1;
    area.removeAttribute('aria-activedescendant');
  }

  function place() {
    const before = area.value.slice(0, area.selectionStart - wordBefore(area.value, area.selectionStart).length);
    const lines = before.split('\n');
    const style = getComputedStyle(area);
    const [width, height] = [measure.getBoundingClientRect().width / 100, parseFloat(style.lineHeight)];
    const [left, top] = [parseFloat(style.paddingLeft) + lines.at(-1).length * width - area.scrollLeft, parseFloat(style.paddingTop) + lines.length * height - area.scrollTop];
    list.style.setProperty('left', `${Math.max(0, Math.min(left, area.clientWidth - list.offsetWidth))}px`);
    const below = top + list.offsetHeight <= area.clientHeight || top - height < list.offsetHeight;
    list.style.setProperty('top', `${below ? top : top - height - list.offsetHeight}px`);
  }

  function choose(at) {
    chosen = at;
    [...list.children].forEach((item, index) => item.setAttribute('aria-selected', String(index === at)));
    if (at < 0) return area.removeAttribute('aria-activedescendant');
    list.children[at].scrollIntoView({ block: 'nearest' });
    return area.setAttribute('aria-activedescendant', list.children[at].id);
  }

  function show() {
    fill(list, ...found.map(({ text, kind, detail }, at) => el('li', { id: `proposal-${at}`, role: 'option', 'aria-selected': 'false', on: { pointerdown: (event) => { event.preventDefault(); take(at); } } }, el('b', { text }), el('span', { class: 'hint', text: ` ${[KINDS[kind], detail].filter(Boolean).join(', ')}` }))));
    list.hidden = !found.length;
    chosen = -1;
    if (found.length) place();
  }

  function take(at) {
    const word = wordBefore(area.value, area.selectionStart);
    area.setRangeText(found[at].text, area.selectionStart - word.length, area.selectionStart, 'end');
    close();
    changed();
  }

  async function now(all) {
    const at = area.selectionStart;
    const word = wordBefore(area.value, at);
    const isField = area.value[at - word.length - 1] === '.';
    if (!isOn() || at !== area.selectionEnd || (!word && !isField && !all)) return close();
    asked += 1;
    const mine = asked;
    try {
      const proposals = await ask(area.value, at);
      if (mine !== asked || document.activeElement !== area) return undefined;
      const begins = ({ text }) => text.toLowerCase().startsWith(word.toLowerCase()) && text !== word;
      found = proposals.filter(begins).slice(0, MOST);
      return show();
    } catch {
      return close();
    }
  }
  const look = debounced(() => now(false), WAIT);

  area.addEventListener('input', (event) => { if (event.inputType?.startsWith('insert') && !event.inputType.includes('Paste') && !event.inputType.includes('LineBreak')) look(); else close(); });
  area.addEventListener('blur', close);
  area.addEventListener('scroll', close);
  area.addEventListener('pointerdown', close);
  area.addEventListener('keydown', (event) => {
    if (event.key === ' ' && event.ctrlKey) {
      event.preventDefault();
      return now(true);
    }
    if (list.hidden) return undefined;
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step) {
      event.preventDefault();
      return choose((chosen + step + found.length) % found.length);
    }
    if ((event.key === 'Tab' && !event.shiftKey) || (event.key === 'Enter' && chosen >= 0 && !event.ctrlKey)) {
      event.preventDefault();
      return take(Math.max(0, chosen));
    }
    if (event.key === 'Escape') event.stopPropagation();
    if (!/^[\w.]$/.test(event.key) && event.key !== 'Shift') close();
    return undefined;
  });
  return [list, measure];
}
