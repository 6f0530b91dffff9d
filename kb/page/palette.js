/** Which colour, letter and dash stands for what. Never colour alone. */

import { number } from './format.js';
import { isDark } from './theme.js';

// One hue from pale to strong, so that lightness alone tells the order.
const HARDNESS = {
  light: ['#dff0e8', '#bfdfe0', '#97c6d8', '#70a9cf', '#5589be', '#4569a6', '#3c4a86'],
  dark: ['#1d332f', '#1f464b', '#24596a', '#31708c', '#4a86b0', '#7398cc', '#a9b4e2'],
};
// Okabe and Ito's colours, told apart by nearly everyone.
const ACTIONS = {
  light: ['#0072b2', '#d55e00', '#007a5a', '#a3487d', '#5b3fa8', '#7a5c00', '#000000'],
  dark: ['#56b4e9', '#ff9248', '#2fd3a4', '#f0a3cf', '#b8a4ff', '#e6d26a', '#ffffff'],
};
const DASHES = [[], [10, 4], [3, 4], [12, 4, 3, 4], [6, 3], [2, 2], [16, 6]];

/** The hardness of every room and door that counts, in classes: each value its own while they are few. */
export class Classes {
  /** @param {number[]} values */
  constructor(values) {
    const distinct = [...new Set(values)].sort((a, b) => a - b);
    const most = HARDNESS.light.length;
    this.single = distinct.length <= most;
    this.bounds = this.single ? distinct : Array.from({ length: most }, (_, i) => distinct[Math.floor(((i + 1) * distinct.length) / most) - 1]);
    this.least = distinct[0];
  }

  /** The class of a value. */
  of(value) {
    const found = this.bounds.findIndex((bound) => value <= bound);
    return found < 0 ? this.bounds.length - 1 : found;
  }

  /** The colour of a class. */
  colour(index) {
    const scale = HARDNESS[isDark() ? 'dark' : 'light'];
    const last = Math.max(1, this.bounds.length - 1);
    const step = this.bounds.length <= 4 ? 1.5 : (scale.length - 1) / last;
    return scale[Math.min(scale.length - 1, Math.round(index * step))];
  }

  /** What a class holds, in words. */
  label(index) {
    if (this.single) return number(this.bounds[index]);
    const from = index ? this.bounds[index - 1] : this.least;
    if (number(from) === number(this.bounds[index])) return number(from);
    return `${number(from)} to ${number(this.bounds[index])}`;
  }
}

/** Colour, dash and letters of each action, in the order of the table of robots. */
export class Actions {
  /** @param {string[]} names */
  constructor(names) {
    this.names = [...new Set(names.filter(Boolean))];
    this.letters = new Map();
    for (const name of this.names) {
      const initials = name.split(/[-_ ]+/).map((word) => word[0]).join('').toUpperCase();
      const taken = new Set(this.letters.values());
      let letters = initials;
      for (let n = 2; taken.has(letters); n += 1) letters = name.slice(0, n).toUpperCase();
      this.letters.set(name, letters);
    }
  }

  index(name) {
    return Math.max(0, this.names.indexOf(name)) % DASHES.length;
  }

  colour(name) {
    return ACTIONS[isDark() ? 'dark' : 'light'][this.index(name)];
  }

  dash(name) {
    return DASHES[this.index(name)];
  }

  letter(name) {
    return this.letters.get(name) ?? '?';
  }
}

/** A hatching in this colour. Its lines are as far apart on the screen whatever the zoom. */
export function hatching(context, colour, ground, width = 2) {
  const tile = document.createElement('canvas');
  tile.width = 10;
  tile.height = 10;
  const pen = tile.getContext('2d');
  if (ground) {
    pen.fillStyle = ground;
    pen.fillRect(0, 0, 10, 10);
  }
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.beginPath();
  for (const shift of [-10, 0, 10]) {
    pen.moveTo(shift - 1, 11);
    pen.lineTo(shift + 11, -1);
  }
  pen.stroke();
  return context.createPattern(tile, 'repeat');
}
