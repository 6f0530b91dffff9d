/** Tabs by the address behind `#`, so that a link can be shared: `#sql?q=SELECT…`. */

import { byId } from './dom.js';

// The tab is shown once the address has changed.
const SHOWN_MS = 50;

const shown = new Map();

/** The tab and its parameters that an address names. */
export function parse(hash) {
  const [tab, query = ''] = hash.replace(/^#/, '').split(/\?(.*)/s);
  return { tab, params: new URLSearchParams(query) };
}

/** Calls `show` with the parameters whenever the tab is opened. */
export function onTab(tab, show) {
  shown.set(tab, show);
}

/** The address of a tab with parameters. */
export function address(tab, params) {
  const given = Object.entries(params).filter(([, value]) => value);
  const query = given.map(([name, value]) => `${name}=${encodeURIComponent(value)}`).join('&');
  return query ? `#${tab}?${query}` : `#${tab}`;
}

/** Puts the present state into the address without opening the tab anew. */
export function remember(tab, params) {
  history.replaceState(null, '', address(tab, params));
}

/** Whether this tab is the open one. */
export const isOpen = (tab) => !document.querySelector(`[data-tab="${tab}"]`).hidden;

function open() {
  const { tab, params } = parse(location.hash);
  const wanted = document.querySelector(`[data-tab="${CSS.escape(tab || 'map')}"]`);
  if (!wanted) return;
  for (const section of document.querySelectorAll('[data-tab]')) section.hidden = section !== wanted;
  for (const link of document.querySelectorAll('nav a')) {
    const isOpened = link.getAttribute('href') === `#${wanted.dataset.tab}`;
    if (isOpened) link.setAttribute('aria-current', 'page');
    else link.removeAttribute('aria-current');
    // On a phone not all of them are in sight.
    if (isOpened) link.scrollIntoView({ block: 'nearest', inline: 'nearest' });
  }
  shown.get(wanted.dataset.tab)?.(params);
}

/** Opens what the address says, now and whenever it changes. */
export function route() {
  window.addEventListener('hashchange', open);
  byId('skip').addEventListener('click', (event) => {
    event.preventDefault();
    byId('content').focus();
  });
  byId('to-tables').addEventListener('click', () => setTimeout(() => document.querySelector('#tables summary')?.focus(), SHOWN_MS));
  open();
}
