/** What a scanner saw, beneath what the map is made of. */

import { get } from './api.js';
import { model } from './model.js';
import { banner } from './notice.js';

let image = null;
let isShown = false;

/** Shows it or not; fetched when it is first wanted. `changed` is called once it is there. */
export async function showScan(isWanted, changed) {
  isShown = isWanted;
  if (isWanted && !image) {
    try {
      image = await createImageBitmap(new Blob([await get('/api/scan', { bytes: true })], { type: 'image/png' }));
    } catch (error) {
      banner('scan', error.message);
    }
  }
  changed();
}

/** Whether it is seen: what lies over it is painted thinly then. */
export const seesScan = () => isShown && Boolean(image) && Boolean(model.map.scan);

/** Paints it into a map whose y goes up. */
export function paintScan(context) {
  const [x0, y0, x1, y1] = model.map.scan;
  context.save();
  context.translate(x0, y1);
  context.scale(1, -1);
  context.imageSmoothingEnabled = false;
  context.drawImage(image, 0, 0, x1 - x0, y1 - y0);
  context.restore();
}
