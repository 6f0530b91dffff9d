/** What a room or a door is, in words and in the service's names. */

import { action, number } from './format.js';
import { layerName, roomsWeigh } from './layers.js';
import { model } from './model.js';

/** As the service names it in why and why-not: `room d`, `door 7`. */
export function nameOf({ kind, index }) {
  return kind === 'room' ? `room ${model.map.rooms[index].name}` : `door ${model.map.doors[index].door}`;
}

/** Its title, its hardness and action in words. */
export function weightsOf(thing) {
  if (thing.kind === 'wall') return { title: 'Wall', text: 'or no room for the robot' };
  const weights = model.weights[thing.kind === 'room' ? 'rooms' : 'doors'];
  const [hardness, how, passable] = [weights.hardness[thing.index], weights.action[thing.index], weights.passable[thing.index]];
  const layer = thing.kind === 'room' ? model.map.rooms[thing.index].layer : null;
  const state = layer === null ? '' : ` (${layerName(model.map.layers[layer])})`;
  return { title: `${nameOf(thing)}${state}`, text: inWords(thing.kind, hardness, how, passable) };
}

/** Hardness, action and whether it is passable, in words. */
export function inWords(kind, hardness, how, passable) {
  if (passable === false) return kind === 'room' ? 'not entered' : `lets nobody through${how ? ` (${action(how)})` : ''}`;
  const parts = [];
  if (how) parts.push(action(how));
  if (hardness !== null) parts.push(kind === 'room' ? `hardness ${number(hardness)} a metre` : `hardness ${number(hardness)}`);
  else if (kind === 'room' && !roomsWeigh()) parts.push('its doors say how hard it is');
  else parts.push('hardness unknown, so no route enters');
  return parts.join(', ');
}

/** The text that asks for a route from or to here: the place, else the point. */
export function endOf(thing) {
  if (thing.place) return thing.place.place;
  return thing.at.map((value) => String(Math.round(value * 100) / 100)).join(',');
}
