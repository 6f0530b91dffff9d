/** What a room or a door is, in words and in the service's names. */

import { byId } from './dom.js';
import { action, list, metres, number } from './format.js';
import { layerName, roomsWeigh } from './layers.js';
import { model } from './model.js';

/** Whether the map shows the pieces of rooms that routes are searched in; else it shows the building. */
export const showsPieces = () => !roomsWeigh() || byId('pieces').checked;

/** As people call the space or doorway that it is, or lies in; undefined where it is of none. */
export function nounOf({ kind, index, space }) {
  if (kind === 'doorway') return model.weights.doorways.name[index];
  return kind === 'room' && !showsPieces() && space >= 0 ? model.weights.spaces.name[space] : undefined;
}

/** As the service names it in why and why-not: `room d`, `door 7`, `doorway 12`, `ward 3`. */
export function nameOf(thing) {
  return nounOf(thing) ?? pieceOf(thing);
}

/** The piece of a room, or the door between pieces, as the service names it. */
export function pieceOf({ kind, index }) {
  return kind === 'room' ? `room ${model.map.rooms[index].name}` : `door ${model.map.doors[index].door}`;
}

/** Its title, its hardness and action in words. */
export function weightsOf(thing) {
  if (thing.kind === 'wall') return { title: 'No way here', text: thing.laid?.some(({ what }) => what === 'obstacle') ? 'An obstacle leaves the robot no room here.' : 'A wall, or too little room for the robot.' };
  if (thing.kind === 'doorway') return doorway(thing);
  const weights = model.weights[thing.kind === 'room' ? 'rooms' : 'doors'];
  const [hardness, how, passable] = [weights.hardness[thing.index], weights.action[thing.index], weights.passable[thing.index]];
  const layer = thing.kind === 'room' ? model.map.rooms[thing.index].layer : null;
  const state = layer === null ? '' : ` (${layerName(model.map.layers[layer])})`;
  const noun = nounOf(thing);
  const shut = noun !== undefined && model.weights.spaces.closed[thing.space] ? 'closed; ' : '';
  return { title: noun ?? `${nameOf(thing)}${state}`, text: `${shut}${inWords(thing.kind, hardness, how, passable)}` };
}

/** The names of the spaces that a doorway is between. */
export function sidesOf(index) {
  return model.map.doorways[index].spaces.map((number) => model.weights.spaces.name[model.map.spaces.findIndex(({ space }) => space === number)]);
}

/** Where a doorway that is closed from one side leads; nothing of another one. */
export function onlyInto(index) {
  const { closed, closed_from: from } = model.weights.doorways;
  return closed[index] || !from[index] ? undefined : sidesOf(index).find((name) => name !== from[index]);
}

function doorway({ index }) {
  const { width, height } = model.map.doorways[index];
  const between = sidesOf(index);
  const wide = `${metres(width)} wide${height === null ? '' : `, ${metres(height)} high`}`;
  const { closed, closed_from: from } = model.weights.doorways;
  const shut = closed[index] ? 'closed; ' : from[index] ? `closed from ${from[index]}; ` : '';
  return { title: model.weights.doorways.name[index], text: `${shut}${wide}, between ${list(between)}` };
}

/** Hardness, action and whether it is passable, in words. */
export function inWords(kind, hardness, how, passable) {
  if (passable === false) return kind === 'room' ? 'not entered' : `lets nobody through${how ? ` (${action(how)})` : ''}`;
  const parts = [];
  if (how) parts.push(action(how));
  if (hardness !== null) parts.push(kind === 'room' ? `hardness ${number(hardness)} a metre` : `hardness ${number(hardness)}`);
  else if (kind === 'room' && !roomsWeigh()) parts.push('its doors say how hard it is');
  else parts.push(kind === 'room' ? 'hardness unknown, so no route enters it' : 'hardness unknown, so no route passes it');
  return parts.join(', ');
}

/** The text that asks for a route from or to here: the place, else the point. */
export function endOf(thing) {
  if (thing.place) return thing.place.place;
  return thing.at.map((value) => String(Math.round(value * 100) / 100)).join(',');
}
