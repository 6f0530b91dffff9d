/** Colours for rules, their tests and SQL: tokens found by one expression each; no grammar. */

import { el } from './dom.js';

const RULE_WORDS = 'rule each some least most none exists all count sum where by then else revise set level priority table on property default class names of is known unknown order from let if in for while return true false const fn max min'.split(' ');
const SQL_WORDS = 'select from where and or not in is null as on join left inner outer cross group by order having limit offset union all except intersect distinct case when then else end with recursive values like between exists asc desc over partition count sum min max avg round cast'.split(' ');

const LANGUAGES = {
  rhai: { pattern: /(\/\/[^\n]*|\/\*[\s\S]*?\*\/)|("(?:[^"\\\n]|\\.)*"?|`[^`]*`?)|(\b\d+(?:\.\d+)?(?:e[+-]?\d+)?\b)|(\b[A-Z][A-Z0-9_]+\b)|(\b[A-Za-z_]\w*\b)/g, words: new Set(RULE_WORDS) },
  toml: { pattern: /(#[^\n]*)|("(?:[^"\\\n]|\\.)*"?|'[^'\n]*'?)|(\b\d+(?:\.\d+)?\b)|(\b[A-Z][A-Z0-9_]+\b)|(^\s*\[\[?[^\]\n]*\]\]?|\btrue\b|\bfalse\b)/gm, words: null },
  sql: { pattern: /(--[^\n]*|\/\*[\s\S]*?\*\/)|('(?:[^']|'')*'?|"[^"]*"?)|(\b\d+(?:\.\d+)?\b)|(\b\B)|(\b[A-Za-z_]\w*\b)/g, words: new Set(SQL_WORDS) },
};
const KINDS = ['comment', 'text', 'number', 'class'];

/** The tokens of a text: [from, to, kind]; what is between them is plain. */
export function tokens(text, language) {
  const { pattern, words } = LANGUAGES[language];
  const found = [];
  for (const match of text.matchAll(pattern)) {
    const group = match.slice(1).findIndex((part) => part !== undefined);
    const word = match[0];
    const kind = group < 4 ? KINDS[group] : !words || words.has(language === 'sql' ? word.toLowerCase() : word) ? 'word' : null;
    if (kind && word) found.push([match.index, match.index + word.length, kind]);
  }
  return found;
}

/** Where a line and column (from 1) are in a text. */
export function offset(text, line, column) {
  let at = 0;
  for (let n = 1; n < line; n += 1) {
    const next = text.indexOf('\n', at);
    if (next < 0) return text.length;
    at = next + 1;
  }
  return Math.min(text.length, at + Math.max(0, (column || 1) - 1));
}

function spans(text, problems) {
  return problems.filter((problem) => problem.line).map((problem) => {
    const from = offset(text, problem.line, problem.column);
    const lineEnd = text.indexOf('\n', from);
    const end = problem.end_line ? offset(text, problem.end_line, problem.end_column) : from;
    // A place without an extent is underlined to the end of its word, or its line's last letter.
    const word = /^\w+/.exec(text.slice(from))?.[0].length ?? 1;
    return { from, to: Math.max(end, Math.min(from + word, lineEnd < 0 ? text.length : Math.max(lineEnd, from + 1))), severity: problem.severity };
  });
}

/** The text as coloured nodes, problems underlined. */
export function coloured(text, language, problems = []) {
  const marks = spans(text, problems);
  const found = tokens(text, language);
  const cuts = [...new Set([0, text.length, ...found.flatMap(([a, b]) => [a, b]), ...marks.flatMap(({ from, to }) => [from, to])])].sort((a, b) => a - b);
  const nodes = [];
  let next = 0;
  for (let i = 0; i + 1 < cuts.length; i += 1) {
    const [from, to] = [cuts[i], cuts[i + 1]];
    while (next < found.length && found[next][1] <= from) next += 1;
    const kind = next < found.length && found[next][0] <= from ? found[next][2] : null;
    const mark = marks.find((one) => one.from <= from && to <= one.to);
    const classes = [kind && `t-${kind}`, mark && `problem ${mark.severity ?? 'error'}`].filter(Boolean).join(' ');
    nodes.push(classes ? el('span', { class: classes, text: text.slice(from, to) }) : text.slice(from, to));
  }
  return nodes;
}
