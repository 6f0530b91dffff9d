/** The rules: read, edited, checked while one types, tested at each save. */

import { call, get, post } from './api.js';
import { button, byId, debounced, el, fill } from './dom.js';
import { editor } from './editor.js';
import { count } from './format.js';
import { model } from './model.js';
import { said } from './notice.js';
import { refresh } from './refresh.js';
import { isOpen, onTab, remember } from './router.js';

const WAIT = 300;

/** Files and tests as the service has them, by name. */
let files = new Map();
let open = null;
/** Texts that were changed here and are not saved: name to {text, version}. */
const drafts = new Map();
let pane = null;
let saving = false;

const isTest = (name) => name.startsWith('tests/') || name.includes('/tests/');
/** What a file of a rule base beneath is called where this site has its own. */
const ownName = (name) => name.slice(isTest(name) ? name.lastIndexOf('/tests/') + 1 : name.lastIndexOf('/') + 1);
const languageOf = (name) => (name.endsWith('.toml') ? 'toml' : 'rhai');

async function load() {
  const answer = await get('/api/rules');
  files = new Map([...answer.files, ...answer.tests].map((file) => [file.file, file]));
}

const mayEdit = () => model.may('rules') && files.get(open)?.own === true;

const first = () => [...files.keys()].find((name) => files.get(name).own) ?? [...files.keys()][0];

const check = debounced(async () => {
  const draft = drafts.get(open);
  if (!draft) return;
  const file = open;
  try {
    const answer = await post('/api/rules/check', { file, text: draft.text });
    if (file !== open || drafts.get(open)?.text !== draft.text) return;
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
    ? button(`line ${problem.line}`, () => jump(problem), { class: 'link' }) : null, `${problem.line ? ': ' : ''}${problem.message}`, problem.help ? el('span', { class: 'hint', text: ` ${problem.help}` }) : null));
  const word = error && !items.length ? [said(error)]
    : problems.some((problem) => problem.severity !== 'warning') ? [el('p', { class: 'wrong', role: 'alert', text: `This would not work: ${count(problems.length, 'problem')}.` })]
      : tests ? [el('p', { class: tests.failed ? 'wrong' : 'right', role: 'status', text: tests.failed ? `${count(tests.failed, 'test')} of the rules would fail; ${tests.passed} pass.` : `Looks right; all ${count(tests.passed, 'test')} of the rules pass.` })] : [];
  fill(byId('rules-result'), ...word, items.length ? el('ul', { class: 'plain problems' }, ...items) : null);
}

function jump(problem) {
  const name = files.has(problem.file) ? problem.file : [...files.keys()].findLast((file) => problem.file?.endsWith(file)) ?? open;
  if (name !== open) openFile(name);
  pane.go(problem.line, problem.column);
}

async function save(version) {
  const file = open;
  const draft = drafts.get(file);
  if (!draft || saving) return;
  saving = true;
  try {
    const answer = await call('PUT', `/api/rules/${file.split('/').map(encodeURIComponent).join('/')}`, { text: draft.text, version });
    const now = drafts.get(file);
    // What was typed meanwhile is not saved yet.
    if (now === draft) drafts.delete(file);
    else if (now) now.version = answer.version;
    files.set(file, { file, own: true, version: answer.version, text: draft.text });
    pane.mark([]);
    list();
    fill(byId('rules-result'), el('p', { class: 'right', role: 'status', text: `Saved and in force: generation ${answer.generation}, ${count(answer.tests.passed, 'test')} of the rules passed.` }));
    await refresh(answer.generation);
  } catch (error) {
    if (error.status === 409) return conflict(error);
    result(error.problems, null, error);
    if (error.problems.length) byId('rules-result').prepend(el('p', { class: 'wrong', role: 'alert', text: 'Not saved. The rules from before stay in force.' }));
  } finally {
    saving = false;
  }
  return undefined;
}

// Somebody else saved the file since it was opened: nothing is overwritten without a word.
async function conflict(error) {
  await load();
  const theirs = files.get(open);
  fill(byId('rules-result'), said(error),
    button('Load theirs (what I typed is lost)', () => { drafts.delete(open); openFile(open); }),
    button('Save mine over it', () => save(theirs?.version ?? null)));
}

function list() {
  const entry = (name) => el('li', {}, button(`${name}${drafts.has(name) ? ' •' : ''}`, () => openFile(name), { class: 'link', 'aria-current': name === open ? 'true' : null }));
  const names = [...files.keys()];
  const part = (title, own, test) => {
    const found = names.filter((name) => files.get(name).own === own && isTest(name) === test);
    return found.length ? [el('h2', { text: title }), el('ul', { class: 'plain' }, ...found.map(entry))] : [];
  };
  fill(byId('rules-files'), ...part('Rules of this site', true, false), ...part('Their tests', true, true),
    ...part('Rules beneath', false, false), ...part('Tests beneath', false, true));
}

function openFile(name, line) {
  const file = files.get(name);
  if (!file) return;
  open = name;
  pane.show(drafts.get(name)?.text ?? file.text, languageOf(name));
  pane.area.readOnly = !mayEdit();
  standing();
  pane.area.setAttribute('aria-label', `Text of ${name}`);
  byId('rules-name').textContent = name;
  fill(byId('rules-result'));
  byId('rules-save').disabled = !drafts.has(name);
  list();
  if (isOpen('rules')) remember('rules', { file: name });
  if (line) pane.go(Number(line));
  if (drafts.has(name)) check();
}

function typed(text) {
  const file = files.get(open);
  if (text === file.text) drafts.delete(open);
  else drafts.set(open, { text, version: drafts.get(open)?.version ?? file.version });
  byId('rules-save').disabled = !drafts.has(open);
  list();
  if (drafts.has(open)) check();
  else fill(byId('rules-result'));
}

/** What is on the disk now: unedited files follow by themselves, of edited ones is said that they changed. */
async function follow() {
  const before = files;
  await load();
  for (const [name, draft] of drafts) {
    if (!files.has(name) && draft.version === null) files.set(name, before.get(name));
  }
  for (const [name, draft] of drafts) {
    const now = files.get(name);
    if (name === open && now && now.version !== draft.version) {
      fill(byId('rules-result'), el('p', { class: 'wrong', role: 'status', text: `${name} was changed elsewhere meanwhile.` }),
        button('Load it (what I typed is lost)', () => { drafts.delete(name); openFile(name); }),
        button('Keep what I typed', () => { drafts.set(name, { ...draft, version: now.version }); fill(byId('rules-result')); }));
    }
  }
  if (open && !drafts.has(open) && files.get(open)?.version !== before.get(open)?.version) openFile(files.has(open) ? open : first());
  list();
}

function standing() {
  const file = files.get(open);
  const note = !model.may('rules') ? [el('p', { class: 'hint', text: 'You may read the rules, not change them.' })]
    : file && !file.own ? [
      el('p', { text: 'This file lies beneath the rules of this site. A rule of this site replaces the one of the same name here.' }),
      button(files.has(ownName(open)) ? `Open ${ownName(open)} of this site` : 'Write over it in this site', writeOver, { id: 'write-over', class: 'strong' })]
      : [];
  fill(byId('rules-note'), ...note);
  byId('rules-save').hidden = !mayEdit();
}

/** Begins a file of this site with the text of the one beneath; nothing is saved yet. */
function writeOver() {
  const [name, { text }] = [ownName(open), files.get(open)];
  if (!files.has(name)) {
    files.set(name, { file: name, own: true, version: null, text: '' });
    drafts.set(name, { text, version: null });
  }
  openFile(name);
}

async function show(params) {
  try {
    if (!files.size) await load();
  } catch (error) {
    return fill(byId('rules-note'), said(error));
  }
  const wanted = params.get('file');
  const found = [...files.keys()].find((name) => name === wanted) ?? [...files.keys()].findLast((name) => name.endsWith(`/${wanted}`));
  return openFile(found ?? open ?? first(), params.get('line'));
}

/** Makes the tab. */
export function startRules() {
  pane = editor({ label: 'Text of the rules', language: 'rhai', changed: typed });
  pane.area.addEventListener('keydown', (event) => {
    if ((event.ctrlKey || event.metaKey) && event.key === 's') {
      event.preventDefault();
      if (drafts.has(open)) save(drafts.get(open).version);
    }
  });
  const saver = button('Save', () => save(drafts.get(open)?.version ?? null), { id: 'rules-save', class: 'strong' });
  fill(byId('rules'), el('div', { id: 'rules-note' }),
    el('div', { class: 'rules-columns' }, el('nav', { id: 'rules-files', class: 'card', 'aria-label': 'Files of rules' }),
      el('div', { class: 'card' }, el('div', { class: 'file-head' }, el('h2', { id: 'rules-name' }), saver), pane.node, el('div', { id: 'rules-result', class: 'result' }))));
  onTab('rules', show);
  model.on('generation problems', () => { if (files.size) follow().catch(() => {}); });
  window.addEventListener('beforeunload', (event) => { if (drafts.size) event.preventDefault(); });
}
