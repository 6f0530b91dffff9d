/** One colour of the floor in patches: of a large floor only those are painted that are seen, and no frame waits for all of them. */

// So many things make a patch, about.
const MANY = 1000;
// So many are painted in one go: what is near has no seams, and what is far away is too small to show them.
const AT_ONCE = 2000;

/** Paths of things by where they lie. */
export class Patches {
  /** @param {number[]} bounds of the map @param {number} count how many things lie on it */
  constructor([x0, y0, x1, y1], count) {
    this.across = Math.max(1, Math.ceil(Math.sqrt(count / MANY)));
    this.from = [x0, y0];
    this.size = [(x1 - x0) / this.across, (y1 - y0) / this.across];
    this.patches = new Map();
  }

  column(low, high, axis) {
    const at = Math.floor(((low + high) / 2 - this.from[axis]) / this.size[axis]);
    return Math.max(0, Math.min(this.across - 1, at)) || 0;
  }

  /** The path of what lies in this box. */
  path([x0, y0, x1, y1]) {
    const key = this.column(x0, x1, 0) * this.across + this.column(y0, y1, 1);
    let patch = this.patches.get(key);
    if (!patch) this.patches.set(key, patch = { path: new Path2D(), count: 0, box: [Infinity, Infinity, -Infinity, -Infinity] });
    patch.count += 1;
    const { box } = patch;
    if (x0 < box[0]) box[0] = x0;
    if (y0 < box[1]) box[1] = y0;
    if (x1 > box[2]) box[2] = x1;
    if (y1 > box[3]) box[3] = y1;
    return patch.path;
  }

  /** The paths of what may be seen in a box of the map. */
  seen([x0, y0, x1, y1]) {
    const isSeen = ({ box }) => box[0] <= x1 && box[2] >= x0 && box[1] <= y1 && box[3] >= y0;
    const seen = [...this.patches.values()].filter(isSeen);
    if (seen.length < 2 || seen.reduce((sum, { count }) => sum + count, 0) > AT_ONCE) return seen.map(({ path }) => path);
    const all = new Path2D();
    for (const { path } of seen) all.addPath(path);
    return [all];
  }
}
