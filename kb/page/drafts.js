/** Rule files and tests that are edited and not saved: drafts among all that is pending. */

import { get } from './api.js';
import { inWords } from './difference.js';
import { model } from './model.js';
import { discard, put } from './pending.js';

/** Files and tests as the service has them, by name. */
export let files = new Map();

const idOf = (name) => `file:${name}`;

/** Names of drafts among what is pending. */
export const drafts = () => [...model.pending.values()].flatMap(({ draft }) => draft ?? []);

/** The draft of a file; nothing where it is as it is saved. */
export const draftOf = (name) => model.pending.get(idOf(name))?.draft;

/** What the files are called, those of drafts too. */
export const names = () => [...new Set([...files.keys(), ...drafts().map(({ file }) => file)])];

/** The text of a file as it stands here; null where it goes. */
export const textOf = (name) => (draftOf(name) ? draftOf(name).text : files.get(name)?.text ?? '');

/** Reads what the service has. */
export async function loadFiles() {
  const answer = await get('/api/rules');
  files = new Map([...answer.files, ...answer.tests].map((file) => [file.file, file]));
}

function words({ file, text, version, was }) {
  if (text === null) return `${file}: deleted`;
  return version === null ? `${file}: new` : `${file}: ${inWords(was, text)}`;
}

function keep(draft) {
  const { file, text, version } = draft;
  put(idOf(file), { words: words(draft), edits: [{ kind: 'write', file, text, version }], draft });
}

/** Takes up another text of a file; null: it is to be deleted. As it is saved, it is no draft. */
export function edit(name, text) {
  const saved = files.get(name);
  const before = draftOf(name) ?? { file: name, version: saved?.version ?? null, was: saved?.text ?? null };
  if (text === before.was || (text === null && before.version === null)) discard(idOf(name));
  else keep({ ...before, text });
}

/** Goes on from what was saved meanwhile: what is typed stays, and is saved over that. */
export function rebase(name) {
  const draft = draftOf(name);
  const saved = files.get(name);
  if (!draft) return;
  if (draft.text === (saved?.text ?? null)) discard(idOf(name));
  else keep({ ...draft, version: saved?.version ?? null, was: saved?.text ?? null });
}

/** Drafts of files that are others by now than when they were begun. */
export const overtaken = () => drafts().filter(({ file, version }) => (files.get(file)?.version ?? null) !== version);

/** Forgets a draft. */
export const forget = (name) => discard(idOf(name));
