/** Small helpers for the document. What users named goes in as text, never as HTML. */

/** The element with this id. @param {string} id */
export const byId = (id) => document.getElementById(id);

/**
 * A new element. `on` holds listeners, `text` the text; what is true is set without a value, what is null or false is left out.
 * @param {string} tag
 * @param {Object} [attributes]
 * @param {...(Node|string|null)} children
 */
export function el(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === 'on') for (const [event, listener] of Object.entries(value)) made.addEventListener(event, listener);
    else if (name === 'text') made.textContent = value;
    else if (name === 'value') made.value = value;
    else if (value === true) made.setAttribute(name, '');
    else if (value !== null && value !== undefined && value !== false) made.setAttribute(name, value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** A button that does something; while it does, it cannot be pressed again. */
export function button(text, act, attributes = {}) {
  const made = el('button', { type: 'button', text, ...attributes });
  made.addEventListener('click', async (event) => {
    const stays = focusStays();
    const hadFocus = document.activeElement === made;
    made.disabled = true;
    try {
      await act(event);
    } finally {
      made.disabled = false;
      // What cannot be pressed loses the focus.
      if (hadFocus && made.isConnected && stays()) made.focus({ preventScroll: true });
    }
  });
  return made;
}

/** The button that puts a card away: what is on the map is closed by buttons that say so. */
export const shut = (what, act) => button('×', act, { class: 'quiet shut', 'aria-label': `Put ${what} away`, title: `Put ${what} away` });

/** Says later on whether the focus is where it is now, or nowhere: whoever has gone on meanwhile keeps it. */
export function focusStays() {
  const before = document.activeElement;
  return () => [before, document.body].includes(document.activeElement);
}

/**
 * Asks before something is done that cannot be undone; the answer is `no` unless somebody says otherwise.
 * @param {string|Promise<string>} question where it has to be found out first, it cannot be answered with yes before
 */
export function sure(question, yes) {
  return new Promise((resolve, reject) => {
    const text = el('p', { text: 'Looking what would change…', role: 'status' });
    const agree = el('button', { type: 'button', text: yes, class: 'strong', disabled: true, on: { click: () => box.close('yes') } });
    const box = el('dialog', { class: 'sure', 'aria-label': yes, on: { close: () => { resolve(box.returnValue === 'yes'); box.remove(); } } }, text,
      el('div', { class: 'buttons' }, el('button', { type: 'button', text: 'Keep', autofocus: true, on: { click: () => box.close('no') } }), agree));
    document.body.append(box);
    box.showModal();
    Promise.resolve(question).then((asked) => {
      text.textContent = asked;
      box.setAttribute('aria-label', asked);
      agree.disabled = false;
    }).catch((error) => {
      reject(error);
      box.close('no');
    });
  });
}

/** A form that does something when it is sent; while it does, it cannot be sent again. */
export function form(attributes, act, ...children) {
  let busy = false;
  const made = el('form', attributes, ...children);
  made.addEventListener('submit', async (event) => {
    event.preventDefault();
    if (busy) return;
    busy = true;
    try {
      await act(event);
    } finally {
      busy = false;
    }
  });
  return made;
}

const DOUBLE_MS = 500;
const DOUBLE_PX = 8;

/**
 * A double click, or a key that is held, does one thing: what has just appeared under the pointer, or has been given the
 * focus, is not pressed by it.
 */
export function pressOnce() {
  let last = null;
  document.addEventListener('click', (event) => {
    // Keys and scripts click without a count.
    if (!event.detail) return;
    const { timeStamp, clientX, clientY, target } = event;
    const pressed = target.closest('label') ?? target.closest('a, button, summary, input, select, textarea') ?? target;
    const again = last && timeStamp - last.timeStamp < DOUBLE_MS && Math.hypot(clientX - last.clientX, clientY - last.clientY) < DOUBLE_PX;
    if (again && last.pressed !== pressed) {
      event.preventDefault();
      event.stopPropagation();
    }
    last = { timeStamp, clientX, clientY, pressed };
  }, true);
  document.addEventListener('keydown', (event) => {
    if (event.repeat && event.key === 'Enter' && !event.target.closest?.('textarea')) event.preventDefault();
  }, true);
}

/** Puts these children in place of what is there. */
export function fill(parent, ...children) {
  parent.replaceChildren(...children.filter((child) => child !== null && child !== undefined));
}

/** As {@link fill}, but whoever has the focus on something there goes on from what takes its place. */
export function refill(parent, ...children) {
  const all = () => [...parent.querySelectorAll('button, input, select, a')];
  const at = all().indexOf(document.activeElement);
  fill(parent, ...children);
  if (at >= 0) all()[Math.min(at, all().length - 1)]?.focus({ preventScroll: true });
}

/** As {@link fill}, but what stands there already is left alone: what has the focus keeps it, what is pressed stays pressed. */
export function keep(parent, children) {
  if (parent.children.length !== children.length || children.some((child, at) => parent.children[at] !== child)) fill(parent, ...children);
}

/** Calls `act` once it was not asked for during `wait` milliseconds; `cancel` forgets that it was. */
export function debounced(act, wait) {
  let timer = 0;
  const later = (...given) => {
    clearTimeout(timer);
    timer = setTimeout(() => act(...given), wait);
  };
  later.cancel = () => clearTimeout(timer);
  return later;
}

/** A table with a header row; cells are nodes or text. */
export function grid(caption, columns, rows, attributes = {}) {
  const head = el('tr', {}, ...columns.map((name) => (name ? el('th', { scope: 'col', text: name }) : el('th', { scope: 'col' }, el('span', { class: 'unseen', text: 'what to do' })))));
  const body = rows.map((row) => el('tr', {}, ...row.map((cell) => el('td', {}, cell ?? ''))));
  const table = el('table', attributes, el('caption', { class: 'unseen', text: caption }), el('thead', {}, head), el('tbody', {}, ...body));
  return el('div', { class: 'scroll', tabindex: '0', role: 'region', 'aria-label': caption }, table);
}

/** Offers a text as a file. */
export function download(name, type, text) {
  const address = URL.createObjectURL(new Blob([text], { type }));
  const link = el('a', { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

/** Copies a text, and says so on the button for a moment. */
export async function copy(text, pressed) {
  const before = pressed.textContent;
  try {
    await navigator.clipboard.writeText(text);
    pressed.textContent = 'Copied';
  } catch {
    // Without https there is no clipboard: show the text, selected, to be copied by hand.
    const box = el('textarea', { class: 'copy-box', 'aria-label': 'To copy', readonly: true, rows: '3', value: text });
    pressed.closest('.card, section').append(box);
    box.select();
    box.addEventListener('blur', () => box.remove());
  }
  setTimeout(() => { pressed.textContent = before; }, 1500);
}
