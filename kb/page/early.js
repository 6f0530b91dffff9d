/** What takes longest is asked for first, while the rest of the page is still on its way. */

/** Headers that say who asks. Percent-encoded: a name may have any letters, a header may not. */
export function headers() {
  const sent = {};
  const token = sessionStorage.getItem('adit-token');
  if (token) sent.authorization = `Bearer ${token}`;
  sent['x-adit-who'] = encodeURIComponent(localStorage.getItem('adit-who') || 'page');
  return sent;
}

const begun = new Map(['/api/site', '/api/floor', '/api/weights?changes=false'].map((path) => {
  const answer = fetch(path, { headers: headers() });
  // A failure is heard where it is waited for; until then it is no stray one.
  answer.catch(() => {});
  return [path, answer];
}));

/** The answer that was asked for before the page was here, for the first who asks for it; nothing for others. */
export function early(path) {
  const answer = begun.get(path);
  begun.delete(path);
  return answer;
}
