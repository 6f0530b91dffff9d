/** Paints one frame of the map. */

import { Labels, labelFloor } from './labels.js';
import { model } from './model.js';
import { hatching } from './palette.js';
import { paintScan, seesScan } from './scan.js';
import { polygon, trace } from './shapes.js';
import { colour } from './theme.js';
import { showsPieces } from './thing.js';
import { paintMeasured } from './paint-measure.js';
import { paintPending } from './paint-pending.js';
import { paintRoutes } from './paint-route.js';

/** Colours and patterns of the present theme, made once until it changes. */
export function inks(context) {
  const named = Object.fromEntries(['ink', 'faint', 'paper', 'wall', 'free', 'amber', 'amber-line', 'shut', 'line'].map((name) => [name, colour(name)]));
  return {
    ...named,
    bridge: hatching(context, colour('bridge'), null, 1.6),
    changed: hatching(context, colour('amber-line'), colour('amber')),
    barred: hatching(context, colour('shut'), colour('free'), 1.2),
    unknown: hatching(context, colour('faint'), colour('free'), 1),
  };
}

// Metres or pixels as the unit of what is painted next.
function units(context, camera) {
  const dense = window.devicePixelRatio || 1;
  return {
    world: () => context.setTransform(dense * camera.scale, 0, 0, -dense * camera.scale, dense * camera.shift[0], dense * camera.shift[1]),
    screen: () => context.setTransform(dense, 0, 0, dense, 0, 0),
  };
}

/** On the layer over the floor: what is pointed at, what waits, and what is measured. It is painted alone while nothing beneath it changes. */
export function paintOver(context, camera, ink, pointed, measured) {
  const { world, screen } = units(context, camera);
  screen();
  context.clearRect(0, 0, context.canvas.clientWidth, context.canvas.clientHeight);
  world();
  if (pointed) outline(context, pointed, ink, 1 / camera.scale);
  screen();
  const labels = new Labels(context, ink, camera.canvas.clientWidth);
  if (measured) paintMeasured(context, camera, ink, labels, measured);
  paintPending(context, camera, ink, labels);
}

/**
 * Everything, from the floor up to the labels, step by step. `shown` is a Drawn, `still` the paths of what no edit changes, `find` gives
 * the rooms at a point.
 */
export function* paint(context, camera, shown, still, ink, find) {
  const { clientWidth: width, clientHeight: height } = camera.canvas;
  const seen = camera.seen();
  const { world, screen } = units(context, camera);
  screen();
  context.clearRect(0, 0, width, height);
  context.fillStyle = ink.paper;
  context.fillRect(0, 0, width, height);
  const pixel = 1 / camera.scale;
  const tile = new DOMMatrix([pixel, 0, 0, pixel, 0, 0]);
  for (const pattern of [ink.bridge, ink.changed, ink.barred, ink.unknown]) pattern.setTransform(tile);

  world();
  context.fillStyle = ink.free;
  const [x0, y0, x1, y1] = model.map.bounds;
  context.fillRect(x0, y0, x1 - x0, y1 - y0);
  const isScanned = seesScan();
  if (isScanned) paintScan(context);
  const over = isScanned ? 0.45 : 1;
  for (const group of shown.roomGroups) {
    context.globalAlpha = over;
    context.fillStyle = group.changed ? ink.changed : group.kind >= 0 ? shown.classes.colour(group.kind)
      : group.kind === -1 ? ink.barred : group.kind === -2 ? ink.unknown : shown.actions.colour(group.action);
    if (group.kind === -3 && !group.changed) context.globalAlpha = 0.13 * over;
    context.lineWidth = group.changed ? 1.5 * pixel : 0.6 * pixel;
    context.strokeStyle = group.changed ? ink['amber-line'] : ink.line;
    const paths = group.patches.seen(seen);
    for (const path of paths) {
      context.fill(path);
      yield;
    }
    context.globalAlpha = 1;
    if (!group.changed && !showsPieces()) continue;
    for (const path of paths) {
      context.stroke(path);
      yield;
    }
  }
  context.fillStyle = ink.bridge;
  context.fill(still.bridges);
  context.fillStyle = ink.wall;
  // What was scanned has its walls in it.
  for (const path of isScanned ? [] : still.walls.seen(seen)) {
    context.fill(path);
    yield;
  }
  context.strokeStyle = ink.wall;
  context.lineWidth = 2 * pixel;
  context.strokeRect(x0, y0, x1 - x0, y1 - y0);
  context.setLineDash([6 * pixel, 4 * pixel]);
  context.strokeStyle = ink.ink;
  context.lineWidth = pixel;
  context.stroke(still.areas);
  context.setLineDash([]);
  yield* paintDoors(context, seen, shown, ink, pixel, Math.max(1.5, Math.min(4.5, camera.scale * 0.6)));
  if (!showsPieces()) paintDoorways(context, still.doorways, ink, pixel);
  yield;
  paintClosed(context, ink, pixel);
  context.lineWidth = 4 * pixel;
  context.strokeStyle = ink.ink;
  context.stroke(still.namedDoors);

  screen();
  const labels = new Labels(context, ink, width);
  paintRoutes(context, camera, shown, ink, labels);
  yield* labelFloor(labels, camera, shown, find);
}

// `wide` is the width of a door that weighs, in pixels: slim where the whole of a large floor is seen.
function* paintDoors(context, seen, shown, ink, pixel, wide) {
  for (const group of shown.doorGroups) {
    const paths = group.patches.seen(seen);
    const stroke = function* () {
      for (const path of paths) {
        context.stroke(path);
        yield;
      }
    };
    context.setLineDash(group.kind === -1 ? [3 * pixel, 3 * pixel] : []);
    if (group.kind >= 0 && !group.changed && wide > 3) {
      // A dark line around it: the palest class would not be seen on the floor.
      context.strokeStyle = ink.ink;
      context.lineWidth = (wide + 2.5) * pixel;
      yield* stroke();
    }
    context.lineWidth = (group.changed ? wide + 1.5 : group.kind === -2 ? 1.5 : wide) * pixel;
    context.strokeStyle = group.changed ? ink['amber-line'] : group.kind >= 0 ? shown.classes.colour(group.kind) : group.kind === -1 ? ink.shut : ink.faint;
    yield* stroke();
    if (group.changed) {
      // Hatched as the rooms are: amber dashes on the dark amber line.
      context.setLineDash([4 * pixel, 3 * pixel]);
      context.strokeStyle = ink.amber;
      context.lineWidth = Math.max(1, wide - 1.5) * pixel;
      yield* stroke();
    }
  }
  context.setLineDash([]);
}

function line(context, [x0, y0, x1, y1]) {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

// An opening is a thin dotted line from post to post.
function paintDoorways(context, doorways, ink, pixel) {
  context.strokeStyle = ink.faint;
  context.lineWidth = 1.5 * pixel;
  context.setLineDash([2 * pixel, 3 * pixel]);
  context.stroke(doorways);
  context.setLineDash([]);
}

// What nobody passes, or some robots do not: a bar with a white line in it, as a sign at a street says it.
function paintClosed(context, ink, pixel) {
  const { doorways, closings } = model.weights;
  const shut = [...model.map.doorways.filter((_, index) => doorways.closed[index] || doorways.closed_from[index]), ...closings];
  for (const { segment } of shut) {
    context.strokeStyle = ink.shut;
    context.lineWidth = 7 * pixel;
    line(context, segment);
    context.strokeStyle = ink.paper;
    context.lineWidth = 2 * pixel;
    line(context, segment);
  }
}

function outline(context, pointed, ink, pixel) {
  context.strokeStyle = ink.ink;
  context.lineWidth = 2 * pixel;
  if (pointed.kind === 'room') {
    const path = new Path2D();
    const { rings } = model.map.spaces[pointed.space] ?? {};
    if (rings && !showsPieces()) rings.forEach((ring) => polygon(path, ring));
    else trace(path, model.map.rooms[pointed.index]);
    context.stroke(path);
  } else if (pointed.kind === 'door' || pointed.kind === 'doorway') {
    const [x0, y0, x1, y1] = (pointed.kind === 'door' ? model.map.doors : model.map.doorways)[pointed.index].segment;
    context.lineWidth = 9 * pixel;
    context.globalAlpha = 0.5;
    context.beginPath();
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
    context.stroke();
    context.globalAlpha = 1;
  }
}
