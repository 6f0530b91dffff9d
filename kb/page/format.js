/** Numbers, times and names as a person reads them. */

/** A number with as many digits as matter: 86, 5.65, 0.003. */
export function number(value) {
  if (value === null || value === undefined) return 'unknown';
  if (!Number.isFinite(value)) return 'no end';
  const size = Math.abs(value);
  const digits = size >= 1000 ? 0 : size >= 100 ? 1 : size >= 0.1 || size === 0 ? 2 : 4;
  return String(Number(value.toFixed(digits)));
}

/** A cost: one digit behind the point, so that costs stand below each other; small ones two. */
export const cost = (value) => (value === null || value === undefined ? 'none' : value !== 0 && Math.abs(value) < 1 ? value.toFixed(2) : value.toFixed(1));

/** A length in metres. */
export const metres = (value) => `${value < 10 ? value.toFixed(1) : value.toFixed(value < 100 ? 1 : 0)} m`;

/** `2 doors`, `1 room`, `no routes`. */
export const count = (n, noun) => `${n === 0 ? 'no' : n.toLocaleString('en')} ${noun}${n === 1 ? '' : 's'}`;

/** A value of a cell. */
export function value(of) {
  if (of === null || of === undefined) return 'nothing';
  if (typeof of === 'boolean') return of ? 'yes' : 'no';
  return typeof of === 'number' ? exact(of) : String(of);
}

/** A number as it was typed: all its digits, no more. */
export const exact = (of) => (typeof of === 'number' ? String(Number(of.toPrecision(12))) : String(of ?? ''));

/** An action as it is said: `walk on knee`. */
export const action = (name) => (name ? name.toLowerCase().replaceAll('_', '-') : 'move');

/** A moment: the time where it is today, else with its day. */
export function moment(text) {
  const at = new Date(text);
  if (Number.isNaN(at.getTime())) return text ?? '';
  const time = at.toLocaleTimeString([], { hour: '2-digit', minute: '2-digit', hour12: false });
  return at.toDateString() === new Date().toDateString() ? time : `${at.toLocaleDateString('en-GB', { day: 'numeric', month: 'short' })} ${time}`;
}

/** Words joined: `a, b and c`. */
export function list(words) {
  return words.length < 2 ? words.join('') : `${words.slice(0, -1).join(', ')} and ${words.at(-1)}`;
}
