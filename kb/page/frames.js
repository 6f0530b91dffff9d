/**
 * The picture of the floor. It is painted beside, in slices of time, so that nobody who moves the map waits for it; until it is done
 * the one before is shown where it would lie now.
 */

// While the map is moved the rest of a frame goes to whoever moves it.
const SLICE_MS = { moved: 9, still: 40 };
const MOVED_MS = 250;

export class Frames {
  /** @param {CanvasRenderingContext2D} context where it is shown */
  constructor(context) {
    this.context = context;
    /** The last whole picture: its canvas, of what view, of what. */ this.whole = null;
    this.work = null;
    this.spare = null;
    this.isDue = true;
    this.movedAt = -Infinity;
  }

  /** What was painted is other by now. */
  forget() {
    this.isDue = true;
  }

  /**
   * Shows one frame; says whether another has to follow.
   * @param {Camera} camera
   * @param {Object} what is seen
   * @param {string} paper the colour where nothing is
   * @param {(context: CanvasRenderingContext2D, camera: Camera) => Iterator} steps paints all, step by step
   */
  show(camera, what, paper, steps) {
    const now = performance.now();
    const isMoved = !this.whole || !camera.isLike(this.whole.camera);
    if (isMoved) this.movedAt = now;
    if (this.isDue || (!this.work && isMoved)) this.begin(camera, what, steps);
    const slice = now - this.movedAt < MOVED_MS ? SLICE_MS.moved : SLICE_MS.still;
    if (this.work) this.goOn(this.whole ? now + slice : Infinity);
    this.lay(camera, paper);
    return Boolean(this.work) || !camera.isLike(this.whole.camera);
  }

  begin(camera, what, steps) {
    const { width, height } = this.context.canvas;
    // Without the wish to read, what is painted is put off, and all of it comes in the frame that shows it.
    this.spare ??= document.createElement('canvas').getContext('2d', { willReadFrequently: true });
    if (this.spare.canvas.width !== width || this.spare.canvas.height !== height) Object.assign(this.spare.canvas, { width, height });
    const still = camera.still();
    this.isDue = false;
    this.work = { context: this.spare, camera: still, what, steps: steps(this.spare, still) };
  }

  goOn(until) {
    const { context, camera, what, steps } = this.work;
    while (!steps.next().done) {
      if (until === Infinity) continue;
      context.getImageData(0, 0, 1, 1);
      if (performance.now() >= until) return;
    }
    this.spare = this.whole?.context ?? null;
    this.whole = { context, camera, what };
    this.work = null;
  }

  lay(camera, paper) {
    const { context, whole } = this;
    const dense = window.devicePixelRatio || 1;
    const by = camera.scale / whole.camera.scale;
    const [dx, dy] = camera.shift.map((at, axis) => dense * (at - by * whole.camera.shift[axis]));
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = paper;
    context.fillRect(0, 0, context.canvas.width, context.canvas.height);
    context.setTransform(by, 0, 0, by, dx, dy);
    context.drawImage(whole.context.canvas, 0, 0);
  }
}
