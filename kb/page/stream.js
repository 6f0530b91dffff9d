/** Live events, read with fetch, since an EventSource can send no token. Comes back by itself after a break. */

import { headers } from './early.js';
import { askForToken } from './signin.js';

const FIRST_WAIT = 250;
const LONGEST_WAIT = 5000;
// The service gives a sign of life every 15 s; after three missing ones the line is taken for dead.
const SILENCE = 45000;

/**
 * Follows `/api/events` for ever.
 * @param {(event: string, data: Object) => void} heard
 * @param {(connected: boolean) => void} connection
 */
export async function follow(heard, connection) {
  let wait = FIRST_WAIT;
  for (;;) {
    const stop = new AbortController();
    try {
      const answer = await fetch('/api/events', { headers: { ...headers(), accept: 'text/event-stream' }, signal: stop.signal });
      if (answer.status === 401) await askForToken('The service wants to know who follows its changes.');
      if (!answer.ok) throw new Error(`events: ${answer.status}`);
      connection(true);
      wait = FIRST_WAIT;
      await read(answer.body.getReader(), heard, stop);
    } catch {
      // Whatever broke it, the next try tells.
    }
    stop.abort();
    connection(false);
    await new Promise((resolve) => setTimeout(resolve, wait));
    wait = Math.min(wait * 2, LONGEST_WAIT);
  }
}

async function read(reader, heard, stop) {
  const decoder = new TextDecoder();
  let text = '';
  for (;;) {
    const timer = setTimeout(() => stop.abort(), SILENCE);
    const { done, value } = await reader.read();
    clearTimeout(timer);
    if (done) return;
    text += decoder.decode(value, { stream: true });
    const blocks = text.split(/\r?\n\r?\n/);
    text = blocks.pop();
    for (const block of blocks) dispatch(block, heard);
  }
}

function dispatch(block, heard) {
  let event = 'message';
  const data = [];
  for (const line of block.split(/\r?\n/)) {
    if (line.startsWith('event:')) event = line.slice(6).trim();
    else if (line.startsWith('data:')) data.push(line.slice(5).trimStart());
  }
  if (data.length) heard(event, JSON.parse(data.join('\n')));
}
