/** What rules speak of: texts with which they compare a property, and properties that they take for a yes or no. */

import { files, loadFiles } from './drafts.js';

const COMMENTS = /\/\*[\s\S]*?\*\/|\/\/[^\n]*/g;

async function texts() {
  if (!files.size) await loadFiles();
  return [...files.values()].filter(({ file }) => file.endsWith('.rhai')).map(({ text }) => text.replace(COMMENTS, ''));
}

const all = (text, pattern) => [...text.matchAll(new RegExp(pattern, 'g'))];

/**
 * How a file calls a property: `area.kind` of a variable, `spot.area.kind` along a link.
 * @param {string[]} links names of properties, in whatever file, that name objects of the class
 */
function called(text, links, of, property) {
  const variables = all(text, `\\b(\\w+)\\s+in\\s+${of}\\b`).map(([, name]) => name);
  const ways = [...new Set(variables)].map((name) => `(?<![.\\w])${name}`).concat(links.map((name) => `\\w\\.${name}`));
  return ways.length ? `(?:${ways.join('|')})\\.${property}\\b` : null;
}

/** @param {string} of a class, as `AREAS` */
async function uses(of, property) {
  const found = await texts();
  const links = found.flatMap((text) => all(text, `\\bproperty\\s+\\w+\\.(\\w+)\\s+names\\s+${of}\\b`).map(([, name]) => name));
  return found.flatMap((text) => {
    const it = called(text, links, of, property);
    return it ? [{ text, it, everywhere: found }] : [];
  });
}

const compared = (text, it) => [...all(text, `${it}\\s*[!=]=\\s*"([^"]+)"`), ...all(text, `"([^"]+)"\\s*[!=]=\\s*[\\w.]*?${it}`)].map(([, word]) => word);

// `is_to_keep_out_of(area.kind)` compares it in the function.
function comparedWithin(text, it, everywhere) {
  const names = all(text, `\\b(\\w+)\\(\\s*[\\w.]*?${it}\\s*\\)`).map(([, name]) => name);
  const bodies = names.flatMap((name) => everywhere.flatMap((of) => all(of, `\\bfn\\s+${name}\\(\\s*(\\w+)\\s*\\)\\s*\\{([^}]*)\\}`)));
  return bodies.flatMap(([, given, body]) => compared(body, `\\b${given}`));
}

/** The texts with which rules compare a property, each once. */
export async function spokenOf(of, property) {
  return [...new Set((await uses(of, property)).flatMap(({ text, it, everywhere }) => [...compared(text, it), ...comparedWithin(text, it, everywhere)]))];
}

/** Whether rules take a property for a yes or no: it is a condition by itself. */
export async function isCondition(of, property) {
  return (await uses(of, property)).some(({ text, it }) => new RegExp(`!\\s*[\\w.]*?${it}|(?:\\bwhere|&&|\\|\\|)\\s*[\\w.]*?${it}\\s*(?:&&|\\|\\||\\b(?:then|set|each|none|revise|rule)\\b)`).test(text));
}
