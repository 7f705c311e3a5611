// The selection, shared by tables and charts: "cell:3", "difficulty:0", "finding:17", or null.
const listeners = [];
let chosen = null;

export const selected = () => chosen;

export function select(key, source = null) {
  chosen = key === chosen && source !== "show" ? null : key;
  for (const listener of listeners) listener(chosen, source);
}

export const onSelect = (listener) => listeners.push(listener);

/** "cell:3" is number 3 of the cells; null for another kind. */
export function indexOf(key, kind) {
  return key?.startsWith(`${kind}:`) ? Number(key.slice(kind.length + 1)) : null;
}
