/** The rules: read, edited, checked while one types. What is edited is a draft in the tray, and saved from there with all else. */

import { post } from './api.js';
import { button, byId, debounced, el, fill, form } from './dom.js';
import { draftOf, drafts, edit, files, forget, loadFiles, names, textOf } from './drafts.js';
import { editor } from './editor.js';
import { count } from './format.js';
import { showGrids, startGrids } from './grids.js';
import { model } from './model.js';
import { said } from './notice.js';
import { isOpen, onTab, remember } from './router.js';
import { allPass } from './summary.js';
import { startVersions, showVersions } from './versions.js';
import { startVocabulary } from './vocabulary.js';

const WAIT = 300;

let open = null;
let pane = null;

const isTest = (name) => name.startsWith('tests/') || name.includes('/tests/');
/** What a file of a rule base beneath is called where this site has its own. */
const ownName = (name) => name.slice(isTest(name) ? name.lastIndexOf('/tests/') + 1 : name.lastIndexOf('/') + 1);
const languageOf = (name) => (name.endsWith('.toml') ? 'toml' : 'rhai');
const isOwn = (name) => files.get(name)?.own ?? Boolean(draftOf(name));

const mayEdit = () => model.may('rules') && isOwn(open) && textOf(open) !== null;

const first = () => names().find(isOwn) ?? names()[0];

const others = (file) => Object.fromEntries(drafts().filter((other) => other.file !== file).map((other) => [other.file, other.text]));

/** What may stand at a place of the open file. */
async function propose(text, at) {
  return (await post('/api/rules/complete', { file: open, text, others: others(open), at })).proposals;
}

const check = debounced(async () => {
  const draft = draftOf(open);
  if (!draft || draft.text === null) return;
  const file = open;
  const { text } = draft;
  try {
    const answer = await post('/api/rules/check', { file, text, others: others(file) });
    if (file !== open || draftOf(open)?.text !== text) return;
    result(answer.problems, answer.tests);
  } catch (error) {
    result(error.problems ?? [], null, error);
  }
}, WAIT);

function result(problems, tests, error) {
  const here = problems.filter((problem) => !problem.file || problem.file.endsWith(open));
  pane.mark(here);
  const failures = tests?.failures ?? [];
  const items = [...problems, ...failures].map((problem) => el('li', {}, problem.line
    ? button(`${problem.file && !problem.file.endsWith(open) ? `${problem.file}, ` : ''}line ${problem.line}`, () => jump(problem), { class: 'link' }) : null, `${problem.line ? ': ' : ''}${problem.message}`, problem.help ? el('span', { class: 'hint', text: ` ${problem.help}` }) : null));
  const word = error && !items.length ? [said(error)]
    : problems.some((problem) => problem.severity !== 'warning') ? [el('p', { class: 'wrong', role: 'alert', text: `This would not work: ${count(problems.length, 'problem')}.` })]
      : tests ? [el('p', { class: tests.failed ? 'wrong' : 'right', role: 'status', text: tests.failed ? `${count(tests.failed, 'test')} of the rules would fail; ${tests.passed} pass.` : tests.passed ? `Looks right. ${allPass(tests.passed)}` : 'Looks right.' })] : [];
  fill(byId('rules-result'), ...word, items.length ? el('ul', { class: 'plain problems' }, ...items) : null);
}

function jump(problem) {
  const name = names().find((file) => file === problem.file) ?? names().findLast((file) => problem.file?.endsWith(file)) ?? open;
  if (name !== open) openFile(name);
  pane.go(problem.line, problem.column);
}

/** The rule base in which a file beneath lies: `rooms/by-state` of `rooms/by-state/tests/doors.toml`. */
const baseOf = (name) => (isOwn(name) ? '' : name.replace(/(\/tests)?\/[^/]*$/u, ''));

function list() {
  const entry = (name) => {
    const draft = draftOf(name);
    const state = !draft ? '' : draft.text === null ? ' – to be deleted' : draft.version === null ? ' – new' : ' – edited';
    return el('li', {}, button(isOwn(name) ? name : name.slice(baseOf(name).length + 1), () => openFile(name), { class: `link${draft ? ' draft' : ''}${draft?.text === null ? ' going' : ''}`, 'aria-label': isOwn(name) ? null : name, 'aria-current': name === open ? 'true' : null }), state ? el('span', { class: 'hint', text: state }) : null);
  };
  const part = (title, own, test) => {
    const found = names().filter((name) => isOwn(name) === own && isTest(name) === test).sort();
    const bases = [...new Set(found.map(baseOf))];
    return bases.flatMap((base) => [el('h2', { text: base ? `${title}: ${base}` : title }), el('ul', { class: 'plain' }, ...found.filter((name) => baseOf(name) === base).map(entry))]);
  };
  fill(byId('rules-files'), ...part('Rules of this site', true, false), ...part('Their tests', true, true),
    ...part('Rules beneath', false, false), ...part('Tests beneath', false, true));
}

function openFile(name, line) {
  if (!names().includes(name)) return;
  open = name;
  pane.show(textOf(name) ?? draftOf(name).was, languageOf(name));
  standing();
  pane.area.setAttribute('aria-label', `Text of ${name}`);
  byId('rules-name').textContent = name;
  fill(byId('rules-result'));
  list();
  if (isOpen('rules')) remember('rules', { file: name });
  if (line) pane.go(Number(line));
  if (draftOf(name)) check();
}

/** What is pending, and what is on the disk now: shown where it is other than what the editor shows. */
function follow() {
  if (!open) return undefined;
  if (!names().includes(open)) return openFile(first());
  const text = textOf(open) ?? draftOf(open).was;
  if (text !== pane.text) {
    const { selectionStart, scrollTop } = pane.area;
    pane.show(text, languageOf(open));
    pane.area.setSelectionRange(selectionStart, selectionStart);
    pane.area.scrollTop = scrollTop;
  }
  standing();
  list();
  if (draftOf(open)) check();
  else {
    pane.mark([]);
    fill(byId('rules-result'));
  }
  return undefined;
}

async function reload() {
  await loadFiles();
  follow();
}

// Each element stays the same while somebody types or presses it.
function standing() {
  const file = files.get(open);
  const draft = draftOf(open);
  const note = !model.may('rules') ? [el('p', { class: 'hint', text: 'You may read the rules, not change them.' })]
    : file && !file.own ? [
      el('p', { text: 'This file lies beneath the rules of this site. A rule of this site replaces the one of the same name here.' }),
      button(names().includes(ownName(open)) ? `Open ${ownName(open)} of this site` : `Begin ${ownName(open)} of this site`, writeOver, { id: 'write-over', class: 'strong' })]
      : draft?.text === null ? [el('p', { text: 'This file is deleted with what is saved next.' }), button('Keep it', () => forget(open), { id: 'rules-keep' })] : [];
  const text = note.map((node) => node.textContent).join();
  if (byId('rules-note').dataset.said !== `${open}${text}`) {
    fill(byId('rules-note'), ...note);
    byId('rules-note').dataset.said = `${open}${text}`;
  }
  pane.area.readOnly = !mayEdit();
  byId('rules-delete').hidden = !mayEdit();
  byId('rules-back').hidden = !draft || draft.version === null;
  showGrids(open, draft?.text ?? null);
  showVersions(isOwn(open) ? open : null);
}

/** Begins a file of this site with the text of the one beneath; nothing is saved yet. */
function writeOver() {
  const [name, { text }] = [ownName(open), files.get(open)];
  if (!names().includes(name)) edit(name, text);
  openFile(name);
}

/** A rule that is whole, and is about nothing until somebody says what. */
function begun(name) {
  const rooms = model.site.rooms_mode !== 'none' && !model.site.layout_kind;
  const own = model.tables?.tables.find((table) => !['robots', 'changes', 'loads', 'hours', 'measures'].includes(table.table));
  const key = own?.columns[0]?.name;
  if (rooms || !key) return `rule "${name}"\n    each room in ROOMS where false\n    then { room.hardness = 1.0; }\n`;
  return `rule "${name}"\n    each ${own.table.replace(/s$/, '')} in ${own.table.toUpperCase()} where false\n    then { ${own.table.replace(/s$/, '')}.note = "what follows"; }\n`;
}

const BEGUN = {
  rule: (name) => `// ${name}: what it is for.\n\n${begun(name)}`,
  test: (name) => `[[test]]\nname = "${name}"\n`,
};

function newFile() {
  const kind = el('select', { id: 'new-kind' }, el('option', { value: 'rule', text: 'rules' }), el('option', { value: 'test', text: 'tests of rules' }));
  const name = el('input', { id: 'new-name', autocomplete: 'off', spellcheck: 'false', required: true, pattern: '[\\p{L}\\p{N}_][\\p{L}\\p{N}_ .\\-]*', placeholder: 'its name', 'aria-label': 'Name of the new file' });
  return form({ class: 'new-file', id: 'new-file' }, () => {
    const plain = name.value.trim().replace(/\.(rhai|toml)$/, '');
    const file = kind.value === 'test' ? `tests/${plain}.toml` : `${plain}.rhai`;
    name.value = '';
    if (!names().includes(file)) edit(file, BEGUN[kind.value](plain));
    openFile(file);
    pane.area.focus();
  }, el('label', {}, 'New file of ', kind), name, el('button', { type: 'submit', text: 'Begin it' }));
}

async function show(params) {
  try {
    if (!files.size) await loadFiles();
  } catch (error) {
    return fill(byId('rules-note'), said(error));
  }
  byId('new-file').hidden = !model.may('rules');
  const wanted = params.get('file');
  const found = names().find((name) => name === wanted) ?? names().findLast((name) => name.endsWith(`/${wanted}`));
  return openFile(found ?? open ?? first(), params.get('line'));
}

/** Makes the tab. */
export function startRules() {
  pane = editor({ label: 'Text of the rules', language: 'rhai', changed: (text) => edit(open, text), propose });
  const remove = button('Delete this file', () => edit(open, null), { id: 'rules-delete', class: 'quiet' });
  const back = button('Back to what is saved', () => forget(open), { id: 'rules-back', class: 'quiet' });
  fill(byId('rules'), el('div', { id: 'rules-note' }),
    el('div', { class: 'rules-columns' }, el('div', { class: 'rules-aside' }, el('div', { class: 'card' }, el('nav', { id: 'rules-files', 'aria-label': 'Files of rules' }), newFile()), startVocabulary((text) => { if (mayEdit()) pane.insert(text); })),
      el('div', { class: 'rules-side' }, el('div', { class: 'card' }, el('div', { class: 'file-head' }, el('h2', { id: 'rules-name' }), el('span', { class: 'buttons' }, back, remove)), pane.node, el('div', { id: 'rules-result', class: 'result' })),
        startGrids((line) => pane.go(line)), el('div', { class: 'tray' }), startVersions())));
  onTab('rules', show);
  model.on('pending', follow);
  model.on('generation changed problems', () => { if (files.size) reload().catch(() => {}); });
}
