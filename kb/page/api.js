/** The service: one way to ask it, one shape of errors. */

import { early, headers } from './early.js';
import { askForToken } from './signin.js';

/** What went wrong, as the service said it. */
export class ApiError extends Error {
  constructor(status, said) {
    super(said.message);
    Object.assign(this, { status, code: said.code, help: said.help ?? null, problems: said.problems ?? [], current: said.current, said });
  }
}

async function ask(method, path, body, options) {
  const begun = method === 'GET' && !options.signal ? early(path) : undefined;
  const sent = headers();
  if (body !== undefined) sent['content-type'] = options.type ?? 'application/json';
  const text = body === undefined || options.type ? body : JSON.stringify(body);
  try {
    return await (begun ?? fetch(path, { method, headers: sent, body: text, signal: options.signal }));
  } catch (error) {
    if (error.name === 'AbortError') throw error;
    throw new ApiError(0, { code: 'http/unreachable', message: 'The service does not answer.', help: 'What you typed is kept; try again when the connection is back.' });
  }
}

/**
 * Asks and gives the answer's JSON (or text, or bytes, where `options` say so); throws an {@link ApiError} on a refusal.
 * A missing token is asked for, and the request made again.
 */
export async function call(method, path, body, options = {}) {
  let answer = await ask(method, path, body, options);
  while (answer.status === 401) {
    const said = await failure(answer);
    await askForToken(said.message);
    answer = await ask(method, path, body, options);
  }
  if (!answer.ok) throw await failure(answer);
  return options.text ? answer.text() : options.bytes ? answer.arrayBuffer() : answer.status === 204 ? null : answer.json();
}

async function failure(answer) {
  try {
    return new ApiError(answer.status, (await answer.json()).error);
  } catch {
    return new ApiError(answer.status, { code: 'http/odd-answer', message: `The service answered ${answer.status} without a word.` });
  }
}

/** A path with its query; what is null or empty is left out. */
export function path(base, query = {}) {
  const given = Object.entries(query).filter(([, value]) => value !== null && value !== undefined && value !== '');
  return given.length ? `${base}?${new URLSearchParams(given)}` : base;
}

export const get = (where, options) => call('GET', where, undefined, options);
export const post = (where, body, options) => call('POST', where, body, options);
