/** Shapes of rooms: a rectangle, or an outline x, y, x, y, …, convex and counterclockwise. */

/** Whether a room holds a point, on its outline too. */
export function holds({ rect: [x0, y0, x1, y1], outline }, [x, y]) {
  if (x < x0 || x > x1 || y < y0 || y > y1) return false;
  // Counterclockwise and convex: nothing of it lies to the right of a side.
  return !outline || sides(outline).every(([ax, ay, bx, by]) => (bx - ax) * (y - ay) >= (by - ay) * (x - ax));
}

/** The sides of a polygon x, y, x, y, …, each from x, y to x, y. */
function sides(polygon) {
  const at = (i) => polygon[i % polygon.length];
  return polygon.flatMap((x, i) => (i % 2 ? [] : [[x, at(i + 1), at(i + 2), at(i + 3)]]));
}

/** The middle of a segment, or of a rectangle. */
export const middleOf = ([x0, y0, x1, y1]) => [(x0 + x1) / 2, (y0 + y1) / 2];

/** The centre of gravity of a room. */
export function centreOf({ rect, outline }) {
  if (!outline) return middleOf(rect);
  const [x0, y0] = rect;
  let [area, x, y] = [0, 0, 0];
  for (const [ax, ay, bx, by] of sides(outline)) {
    const twice = (ax - x0) * (by - y0) - (ay - y0) * (bx - x0);
    area += 3 * twice;
    x += (ax + bx - 2 * x0) * twice;
    y += (ay + by - 2 * y0) * twice;
  }
  return [x0 + x / area, y0 + y / area];
}

/** How wide and high a box about the centre of a room may be that lies in it and is shaped as the box about the room. */
export function boxIn(room) {
  const { rect: [x0, y0, x1, y1], outline } = room;
  const [dx, dy] = [x1 - x0, y1 - y0];
  if (!outline) return [dx, dy];
  const [x, y] = centreOf(room);
  const shares = sides(outline).map(([ax, ay, bx, by]) => (2 * ((bx - ax) * (y - ay) - (by - ay) * (x - ax))) / (Math.abs(by - ay) * dx + Math.abs(bx - ax) * dy));
  const share = Math.max(0, Math.min(1, ...shares));
  return [dx * share, dy * share];
}

/** Adds a room to a path. */
export function trace(path, { rect: [x0, y0, x1, y1], outline }) {
  if (!outline) return path.rect(x0, y0, x1 - x0, y1 - y0);
  return polygon(path, outline);
}

/** Adds a polygon x, y, x, y, … to a path. */
export function polygon(path, points) {
  path.moveTo(points[0], points[1]);
  for (let i = 2; i < points.length; i += 2) path.lineTo(points[i], points[i + 1]);
  path.closePath();
}
