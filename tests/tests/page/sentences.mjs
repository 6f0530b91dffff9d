// What the page can say of itself: the texts of its files that reach a person, one a line, `…` where something is put in.
//
//     node sentences.mjs FOLDER_OF_THE_PAGE FOLDER_WITH_ACORN

import { readdirSync, readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [folder, modules] = process.argv.slice(2);
const { parse } = await import(pathToFileURL(`${modules}/node_modules/acorn/dist/acorn.mjs`));

/** Calls whose first text is a name, and never shown. */
const NAMING = new Set(['byId', 'querySelector', 'querySelectorAll', 'getElementById', 'closest', 'matches', 'addEventListener', 'removeEventListener', 'createElement', 'createElementNS', 'getAttribute', 'setAttribute', 'hasAttribute', 'removeAttribute', 'toggleAttribute', 'setAttributeNS', 'el', 'svg', 'get', 'post', 'path', 'getItem', 'setItem', 'removeItem', 'set', 'on', 'has', 'getPropertyValue', 'setProperty', 'removeProperty', 'getContext', 'join', 'split', 'startsWith', 'endsWith', 'includes', 'indexOf', 'replace', 'replaceAll', 'RegExp', 'Event', 'KeyboardEvent', 'CustomEvent', 'EventSource', 'fetch', 'add', 'remove', 'toggle', 'contains', 'matchMedia', 'mark', 'measure', 'toLocaleString', 'setPointerCapture', 'localeCompare', 'padStart', 'repeat', 'delete', 'decode', 'TextDecoder', 'getEntriesByName']);
/** Properties whose texts are names or drawing, and never shown. */
const NAMES = /^(class|className|id|type|for|htmlFor|href|src|role|name|method|rel|scope|viewBox|d|fill|stroke|style|kind|autocomplete|inputmode|wrap|spellcheck|key|code|value|font|transform|width|height|offset|weekday|day|month|year|hour|minute|style|unit|credentials|cache|mode|action|aria-(live|hidden|pressed|expanded|controls|current|keyshortcuts|haspopup|modal|selected|describedby|labelledby|autocomplete|activedescendant|busy|invalid|atomic|orientation|sort)|data-.*|stroke-.*|fill-.*|text-anchor|dominant-baseline|font-.*|content-type|accept|step|min|max|behavior|block|inline|pattern|table|column|property|state|op|field|fillStyle|strokeStyle|textAlign|textBaseline|lineCap|lineJoin|globalCompositeOperation|cursor|display|hash|dataset|Content-Type|Accept|[Aa]uthorization)$/;
/** What is written into an editor or the clipboard is of the language that is written there. */
const WRITTEN = /^(rule "|\/\/ |SELECT |AND |mission,)/;
/** Properties whose texts are always shown. */
const SHOWN = new Set(['text', 'title', 'placeholder', 'label', 'aria-label', 'alt', 'hint', 'words', 'textContent', 'help', 'legend', 'summary']);

const nameOf = (node) => node?.name ?? node?.value ?? (node?.type === 'MemberExpression' ? nameOf(node.property) : undefined);
const isText = (text) => /\p{L}{2}/u.test(text);
const isSentence = (text) => /\p{L}/u.test(text) && (/^\p{Lu}\p{Ll}/u.test(text) || /(^|\p{L}|[,.;:…”)]) (\p{L}|“|…|\d)/u.test(text)) && !/^[a-z-]+( [a-z-]+)*$/.test(text) || /\p{L}+ \p{L}+/u.test(text) && !/[#.[\]>]\w|^[MLZ] ?\d/.test(text);

function textsOf(source) {
  const found = [];
  const add = (text, shown) => {
    const clean = text.replace(/\s+/g, ' ').trim();
    if (!/^\d+( \d+)?px /.test(clean) && isText(clean) && (shown || isSentence(clean))) found.push(clean);
  };
  const visit = (node, context) => {
    if (!node || typeof node.type !== 'string') return;
    if (node.type === 'ImportDeclaration' || node.type === 'ExportAllDeclaration' || node.type === 'ImportExpression') return;
    if (node.type === 'Literal') {
      if (typeof node.value === 'string' && context !== 'name') add(node.value, context === 'shown');
      return;
    }
    if (node.type === 'TemplateLiteral') {
      if (context !== 'name') add(node.quasis.map((quasi) => quasi.value.cooked).join('…'), context === 'shown');
      for (const part of node.expressions) visit(part, context === 'name' ? 'name' : 'part');
      return;
    }
    if (node.type === 'TaggedTemplateExpression') return;
    if (node.type === 'BinaryExpression' && /^[!=<>]|^in$/.test(node.operator)) {
      for (const side of [node.left, node.right]) if (side.type !== 'Literal' && side.type !== 'TemplateLiteral') visit(side, context);
      return;
    }
    if (node.type === 'SwitchCase') {
      for (const of of node.consequent) visit(of, null);
      return;
    }
    if (node.type === 'CallExpression' || node.type === 'NewExpression') {
      const callee = nameOf(node.callee);
      // a list of words
      if (callee === 'split' && node.callee.object?.type === 'Literal') return;
      visit(node.callee.type === 'MemberExpression' ? node.callee.object : node.callee, null);
      node.arguments.forEach((argument, at) => {
        const isName = NAMING.has(callee) && at === 0;
        const isLabel = callee === 'setAttribute' && at === 1 ? (/^(aria-label|title|placeholder)$/.test(nameOf(node.arguments[0])) ? 'shown' : 'name') : null;
        visit(argument, isName ? 'name' : isLabel ?? (callee === 'button' && at === 0 ? 'shown' : context === 'name' ? 'name' : null));
      });
      return;
    }
    if (node.type === 'Property') {
      if (node.computed) visit(node.key, 'name');
      const name = String(nameOf(node.key));
      visit(node.value, SHOWN.has(name) ? 'shown' : NAMES.test(name) && node.value.type !== 'ArrowFunctionExpression' ? 'name' : null);
      return;
    }
    if (node.type === 'MemberExpression') {
      visit(node.object, null);
      if (node.computed) visit(node.property, 'name');
      return;
    }
    if (node.type === 'AssignmentExpression') {
      visit(node.left, null);
      const name = String(nameOf(node.left));
      visit(node.right, SHOWN.has(name) ? 'shown' : NAMES.test(name) ? 'name' : context);
      return;
    }
    if (node.type === 'ConditionalExpression') {
      visit(node.test, null);
      visit(node.consequent, context);
      visit(node.alternate, context);
      return;
    }
    const inner = node.type === 'LogicalExpression' || node.type === 'BinaryExpression' || node.type === 'SequenceExpression' || node.type === 'ParenthesizedExpression' ? context : null;
    for (const [key, value] of Object.entries(node)) {
      if (key === 'type' || key === 'loc') continue;
      for (const child of Array.isArray(value) ? value : [value]) if (child && typeof child === 'object') visit(child, inner);
    }
  };
  visit(parse(source, { ecmaVersion: 'latest', sourceType: 'module' }), null);
  return found;
}

function textsOfHtml(source) {
  const bare = source.replace(/<(script|style)[\s\S]*?<\/\1>/g, '').replace(/<!--[\s\S]*?-->/g, '');
  const decoded = (text) => text.replace(/&amp;/g, '&').replace(/&lt;/g, '<').replace(/&gt;/g, '>').replace(/&nbsp;/g, ' ').replace(/\s+/g, ' ').trim();
  const found = [];
  for (const [, inner, between] of bare.matchAll(/<([^>]*)>([^<]*)/g)) {
    for (const [, , text] of inner.matchAll(/\b(aria-label|title|placeholder|alt)="([^"]*)"/g)) found.push(decoded(text));
    found.push(decoded(between));
  }
  return found.filter(isText);
}

const written = new Set();
for (const file of readdirSync(folder).sort()) {
  const isHtml = file.endsWith('.html');
  if (!isHtml && !file.endsWith('.js')) continue;
  const source = readFileSync(`${folder}/${file}`, 'utf8');
  const texts = [...new Set(isHtml ? textsOfHtml(source) : textsOf(source))];
  for (const text of texts.filter((text) => WRITTEN.test(text))) written.add(text);
  const said = texts.filter((text) => !WRITTEN.test(text));
  if (said.length) console.log([`## ${file}`, '', ...said.map((text) => `- ${text}`), ''].join('\n'));
}
console.log(['## Written into an editor or the clipboard', '', ...[...written].map((text) => `- ${text}`)].join('\n'));
