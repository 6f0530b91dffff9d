/** What part of the map is seen: pan and zoom by mouse, touch and keys. */

const SLOP = 6;
const STEP = 60;

/** The view of a canvas on the map. Metres, y up, on one side; CSS pixels, y down, on the other. */
export class Camera {
  constructor(canvas, moved) {
    this.canvas = canvas;
    this.moved = moved;
    this.scale = 1;
    this.shift = [0, 0];
    this.bounds = [0, 0, 1, 1];
    /** Whether the whole map is seen, as {@link fit} shows it. */ this.isWhole = true;
    /** What of the canvas, from below, the whole map is not shown on, pixels. */ this.below = 0;
    /** Whoever may take a press instead of the map: `press(point, event)`, `drag`, `finish`. */ this.tool = null;
  }

  /** The whole map with a margin. */
  fit(bounds = this.bounds) {
    this.bounds = bounds;
    const [x0, y0, x1, y1] = bounds;
    const { clientWidth: width, clientHeight } = this.canvas;
    const height = Math.max(clientHeight / 2, clientHeight - this.below);
    const margin = Math.min(width, height) * 0.03 + 4;
    this.scale = Math.max(1e-3, Math.min((width - 2 * margin) / (x1 - x0), (height - 2 * margin) / (y1 - y0)));
    this.least = this.scale / 3;
    this.shift = [width / 2 - (this.scale * (x0 + x1)) / 2, height / 2 + (this.scale * (y0 + y1)) / 2];
    this.isWhole = true;
    this.moved();
  }

  /** The canvas has become wider and higher by so much: the whole map, or what was in its middle, is there still. */
  grown(wider, higher) {
    if (this.isWhole) this.fit();
    else this.pan(wider / 2, higher / 2);
  }

  /** The view as it is now, which does not move along. */
  still() {
    return Object.assign(Object.create(Camera.prototype), { canvas: this.canvas, scale: this.scale, shift: this.shift });
  }

  /** Whether the same is seen. */
  isLike({ scale, shift }) {
    return scale === this.scale && shift[0] === this.shift[0] && shift[1] === this.shift[1];
  }

  toScreen([x, y]) {
    return [this.shift[0] + x * this.scale, this.shift[1] - y * this.scale];
  }

  toMap([px, py]) {
    return [(px - this.shift[0]) / this.scale, (this.shift[1] - py) / this.scale];
  }

  /** What of the map is seen, as x0, y0, x1, y1. */
  seen() {
    const [x0, y1] = this.toMap([0, 0]);
    const [x1, y0] = this.toMap([this.canvas.clientWidth, this.canvas.clientHeight]);
    return [x0, y0, x1, y1];
  }

  pan(dx, dy) {
    this.shift = [this.shift[0] + dx, this.shift[1] + dy];
    this.isWhole = false;
    this.moved();
  }

  /** Zooms by a factor about a point of the screen, the middle where none is said. */
  zoom(factor, about = [this.canvas.clientWidth / 2, this.canvas.clientHeight / 2]) {
    const [x, y] = this.toMap(about);
    this.scale = Math.max(this.least ?? 1e-3, Math.min(2000, this.scale * factor));
    this.shift = [about[0] - x * this.scale, about[1] + y * this.scale];
    this.isWhole = false;
    this.moved();
  }

  /** Moves a point of the map into view where it is not. */
  show(at) {
    const [px, py] = this.toScreen(at);
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (px < 40 || py < 40 || px > width - 40 || py > height - 40) this.pan(width / 2 - px, height / 2 - py);
  }

  /** Listens to mouse, touch and keys. `tap(point, event)` is a press that moved nothing, `hover(point or null)` the mouse. */
  listen(tap, hover) {
    const held = new Map();
    let travelled = 0;
    let taken = false;
    const at = (event) => [event.offsetX, event.offsetY];
    this.canvas.addEventListener('pointerdown', (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      held.set(event.pointerId, at(event));
      if (held.size === 1) travelled = 0;
      taken = held.size === 1 && Boolean(this.tool?.press(at(event), event));
    });
    this.canvas.addEventListener('pointermove', (event) => {
      const before = held.get(event.pointerId);
      if (!before) return hover(at(event));
      const now = at(event);
      const [dx, dy] = [now[0] - before[0], now[1] - before[1]];
      travelled += Math.hypot(dx, dy);
      if (held.size === 1 && travelled < SLOP) return undefined;
      if (taken) this.tool?.drag(now, event);
      else if (held.size === 2) this.pinch(held, event.pointerId, now);
      else this.pan(dx, dy);
      held.set(event.pointerId, now);
      return hover(taken ? now : null);
    });
    const release = (event) => {
      const was = held.delete(event.pointerId);
      if (taken && travelled >= SLOP) this.tool?.finish();
      if (was && event.type === 'pointerup' && travelled < SLOP && held.size === 0 && event.button === 0) tap(at(event), event);
      if (held.size === 0) taken = false;
    };
    this.canvas.addEventListener('pointerup', release);
    this.canvas.addEventListener('pointercancel', release);
    this.canvas.addEventListener('pointerleave', () => hover(null));
    this.canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), at(event));
    }, { passive: false });
    this.canvas.addEventListener('keydown', (event) => this.key(event, tap));
  }

  pinch(held, moving, now) {
    const [still] = [...held].filter(([id]) => id !== moving).map(([, point]) => point);
    const before = held.get(moving);
    const grown = Math.hypot(now[0] - still[0], now[1] - still[1]) / Math.max(1, Math.hypot(before[0] - still[0], before[1] - still[1]));
    this.zoom(grown, [(now[0] + still[0]) / 2, (now[1] + still[1]) / 2]);
    this.pan((now[0] - before[0]) / 2, (now[1] - before[1]) / 2);
  }

  key(event, tap) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const acts = {
      ArrowLeft: () => this.pan(STEP, 0), ArrowRight: () => this.pan(-STEP, 0),
      ArrowUp: () => this.pan(0, STEP), ArrowDown: () => this.pan(0, -STEP),
      '+': () => this.zoom(1.3), '=': () => this.zoom(1.3), '-': () => this.zoom(1 / 1.3), 0: () => this.fit(),
      Enter: () => tap([this.canvas.clientWidth / 2, this.canvas.clientHeight / 2], event),
    };
    if (!acts[event.key]) return;
    event.preventDefault();
    acts[event.key]();
  }
}
