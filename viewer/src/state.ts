// What is shown, kept in the fragment of the address, so that a view can be shared: #mode=world&select=12&camera=...

const values = new URLSearchParams(location.hash.slice(1));
let due = 0;

function write(): void {
  due = 0;
  const text = values.toString();
  history.replaceState(null, '', text ? `#${text}` : location.pathname + location.search);
}

export const state = {
  get: (key: string): string | null => values.get(key),
  number(key: string): number | null {
    const text = values.get(key), n = Number(text);
    return text === null || !Number.isFinite(n) ? null : n;
  },
  /// Null takes the key away.
  set(key: string, value: string | number | null): void {
    if (value === null) values.delete(key);
    else values.set(key, String(value));
    due ||= window.setTimeout(write, 200);
  },
};

/// Another fragment was put into the address by hand: the page begins again with it.
export function followAddress(): void {
  window.addEventListener('hashchange', () => location.reload());
}
