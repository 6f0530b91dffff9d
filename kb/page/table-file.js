/** A table as a file: out, to a spreadsheet, and in again, as one edit among the others. */

import { call } from './api.js';
import { titleOf } from './cells.js';
import { button, download, el, fill } from './dom.js';
import { model } from './model.js';
import { said } from './notice.js';
import { discard, put } from './pending.js';

/** What a file may hold, bytes: the service reads no more in one request, and Base64 is longer by a third. */
const MOST_BYTES = 1_400_000;

const XLSX = 'application/vnd.openxmlformats-officedocument.spreadsheetml.sheet';

async function save(name, ending, answer) {
  try {
    const bytes = await call('GET', `/api/tables/${encodeURIComponent(name)}.${ending}`, undefined, { bytes: true });
    download(`${name}.${ending}`, ending === 'csv' ? 'text/csv' : XLSX, bytes);
    fill(answer);
  } catch (error) {
    fill(answer, said(error));
  }
}

/** Takes up the rows of a file, in place of those that are there. */
async function take(name, file, answer) {
  if (file.size > MOST_BYTES) {
    fill(answer, el('p', { class: 'wrong', text: `${file.name} is larger than ${MOST_BYTES / 1e6} MB, which is the most that the page takes: whoever runs the service can take it in.` }));
    return;
  }
  let bytes;
  try {
    bytes = new Uint8Array(await file.arrayBuffer());
  } catch {
    fill(answer, el('p', { class: 'wrong', text: `${file.name} cannot be read.` }));
    return;
  }
  const base64 = btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''));
  // What waits for the table was set beside the rows of before.
  for (const [id, { table: of, rows, edits }] of model.pending) if (of === name || rows?.some(({ table }) => table === name) || edits?.some(({ table }) => table === name)) discard(id);
  keep({ kind: 'take', table: name, file: file.name, base64 });
  fill(answer);
}

const idOf = (name) => `file:${name}`;

/** Has a file wait for a table as it is now. */
function keep(edit) {
  put(idOf(edit.table), { words: `${titleOf(edit.table)} as in ${edit.file}`, edits: [{ ...edit, version: model.table(edit.table)?.version }] });
}

/** Files that wait for tables which are others by now than when they were taken. */
export const outdated = () => [...model.pending.values()].flatMap(({ edits }) => (edits?.[0].kind === 'take' && edits[0].version !== model.table(edits[0].table)?.version ? edits : []));

/** What is said of one, and what can be done. */
export const otherRows = (edit) => el('div', { class: 'conflict' },
  el('p', { class: 'wrong', role: 'alert', text: `${titleOf(edit.table)}: somebody else edited these rows since ${edit.file} was taken. Listed below is what the file changes of them as they are now.` }),
  el('div', { class: 'line-form' }, button('Drop the file', () => discard(idOf(edit.table)), { class: 'take-theirs' }),
    button('Take it all the same', () => keep(edit), { class: 'set-mine' })));

/** What stands under a table: the way out to a file, and the way in for those who may tune. */
export function fileForms({ table: name }) {
  const answer = el('div', { role: 'status' });
  const out = ['csv', 'xlsx'].map((ending) => button(`Download ${ending.toUpperCase()}`, () => save(name, ending, answer)));
  const chosen = el('input', { type: 'file', accept: `.csv,.xlsx,text/csv,${XLSX}` });
  // The same file, edited once more, is taken again.
  chosen.addEventListener('click', () => { chosen.value = ''; });
  chosen.addEventListener('change', () => chosen.files[0] && take(name, chosen.files[0], answer));
  const into = model.may('tune') ? el('label', {}, 'Take the rows of a file ', chosen) : null;
  return el('details', { class: 'row-forms' }, el('summary', { text: 'As a file' }), el('div', { class: 'buttons' }, ...out), into, answer);
}
