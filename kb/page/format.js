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

/** A time as people say it: `4.5 s`, `1 min 20 s`, `2 h 5 min`. */
export function time(seconds) {
  if (seconds < 10) return `${Number(seconds.toFixed(1))} s`;
  const whole = Math.round(seconds);
  const and = (rest, unit) => (rest > 0 ? ` ${rest} ${unit}` : '');
  if (whole < 60) return `${whole} s`;
  const minutes = Math.floor(whole / 60);
  return minutes < 60 ? `${minutes} min${and(whole % 60, 's')}` : `${Math.floor(minutes / 60)} h${and(minutes % 60, 'min')}`;
}

/** An energy as people say it: `413 J`, `4.2 kJ`. */
function energy(joules) {
  const [size, unit] = joules >= 1e6 ? [1e6, 'MJ'] : joules >= 1e3 ? [1e3, 'kJ'] : [1, 'J'];
  const amount = joules / size;
  return `${Number(amount.toFixed(amount >= 100 ? 0 : 1))} ${unit}`;
}

/** What a way takes, times and energies first: `1 min 20 s, 4.2 kJ`; nothing where nothing is known. */
export function taken(amounts, measures) {
  const rank = ({ unit }) => (unit === 's' ? 0 : unit === 'J' ? 1 : 2);
  const known = (measures ?? []).filter(({ measure }) => amounts?.[measure] !== undefined).sort((one, other) => rank(one) - rank(other));
  const word = ({ measure, unit }) => {
    const amount = amounts[measure];
    if (unit === 's') return time(amount);
    return unit === 'J' ? energy(amount) : `${measure} ${number(amount)}${unit ? ` ${unit}` : ''}`;
  };
  return known.map(word).join(', ');
}

/** `2 doors`, `1 room`, `no routes`. */
export const count = (n, noun) => `${n === 0 ? 'no' : n.toLocaleString('en')} ${noun}${n === 1 ? '' : 's'}`;

/** What the service says of something in a line, as a sentence that stands alone. */
export const asSentence = (note) => `${note[0].toUpperCase()}${note.slice(1)}.`;

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

// Made once: it takes longer than all else that is said of a moment.
let made = null;
const clock = () => (made ??= new Intl.DateTimeFormat([], { hour: '2-digit', minute: '2-digit', hour12: false }));

/** A moment: the time where it is today, else with its day. */
export function moment(text) {
  const at = new Date(text);
  if (Number.isNaN(at.getTime())) return text ?? '';
  const time = clock().format(at);
  return at.toDateString() === new Date().toDateString() ? time : `${at.toLocaleDateString('en-GB', { day: 'numeric', month: 'short' })} ${time}`;
}

const DURATION = /^(\d+(?:\.\d+)?) ?(s|min|m|h|d)$/;

/** How long something holds, as it was typed or as the service has it: ` for 2 h`, ` until 18:00`; nothing where no end is said. */
export function untilWhen(end) {
  const [, amount, unit] = DURATION.exec(end ?? '') ?? [];
  if (amount) return ` for ${amount} ${unit === 'm' ? 'min' : unit}`;
  return end ? ` until ${end.includes('T') ? moment(end) : end}` : '';
}

/** Words joined: `a, b and c`. */
export function list(words) {
  return words.length < 2 ? words.join('') : `${words.slice(0, -1).join(', ')} and ${words.at(-1)}`;
}
