// Controls whose value the address keeps (state.ts): what it says is done at once, and what is usual is not written.
import {state} from '../state';
import {check, choice, type Choice} from './dom';

export function keptChoice<T extends string>(key: string, label: string, options: readonly (readonly [T, string])[], usual: T, change: (value: T) => void): Choice<T> {
  const said = state.get(key), value = options.find(([name]) => name === said)?.[0] ?? usual;
  if (value !== usual) change(value);
  return choice(label, options, value, wanted => {
    change(wanted);
    state.set(key, wanted === usual ? null : wanted);
  });
}

/// `shortcut`: see check().
export function keptCheck(key: string, label: string, usual: boolean, change: (on: boolean) => void, shortcut = ''): HTMLLabelElement {
  const said = state.get(key), value = said === null ? usual : said === '1';
  if (value !== usual) change(value);
  return check(label, value, on => {
    change(on);
    state.set(key, on === usual ? null : on ? 1 : 0);
  }, shortcut);
}
