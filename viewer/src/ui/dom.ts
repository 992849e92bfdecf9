// Elements in one line each.

type Child = Node | string;
type Attributes = Record<string, string | number | boolean | ((event: never) => void)>;

/// An element. Attributes that are functions listen: {click: ...}; those that are false are left out.
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(name, value as EventListener);
    else if (value !== false) element.setAttribute(name, value === true ? '' : String(value));
  }
  element.append(...children);
  return element;
}

export function button(label: string, press: () => void, attributes: Attributes = {}): HTMLButtonElement {
  return h('button', {type: 'button', click: press, ...attributes}, label);
}

/// A box to tick; `key` is found by the keyboard (keys.ts).
export function check(label: string, on: boolean, change: (on: boolean) => void, key = ''): HTMLLabelElement {
  const input = h('input', {type: 'checkbox', checked: on, 'data-key': key, change: () => change(input.checked)});
  return h('label', {class: 'check'}, input, label);
}

export interface Choice<T extends string> {
  element: HTMLElement;
  set(value: T): void;
}

/// One of few, all of them seen.
export function choice<T extends string>(label: string, options: readonly (readonly [T, string])[], value: T, change: (value: T) => void): Choice<T> {
  const name = `choice-${label.replaceAll(' ', '-')}`;
  const inputs = options.map(([key]) => h('input', {type: 'radio', name, value: key, checked: key === value, change: () => change(key)}));
  const labels = options.map(([, text], i) => h('label', {}, inputs[i]!, h('span', {}, text)));
  const element = h('fieldset', {class: 'choice'}, h('legend', {}, label), h('div', {}, ...labels));
  return {element, set: wanted => inputs.forEach((input, i) => { input.checked = options[i]![0] === wanted; })};
}

export interface Slider {
  element: HTMLElement;
  input: HTMLInputElement;
  /// Moves it and says so, without calling back.
  set(value: number, text: string): void;
}

export function slider(label: string, range: {min: number; max: number; step: number; value: number}, change: (value: number) => void): Slider {
  const output = h('output');
  const input = h('input', {type: 'range', 'aria-label': label, min: range.min, max: range.max, step: range.step, input: () => change(Number(input.value))});
  input.value = String(range.value);
  const element = h('div', {class: 'slider'}, h('div', {class: 'row'}, h('span', {}, label), output), input);
  const set = (value: number, text: string): void => {
    input.value = String(value);
    input.setAttribute('aria-valuetext', text);
    output.textContent = text;
  };
  return {element, input, set};
}

export function section(title: string, ...children: Child[]): HTMLElement {
  return h('section', {}, h('h2', {}, title), ...children);
}

/// Names and values.
export function facts(rows: readonly (readonly [string, Child])[]): HTMLElement {
  return h('dl', {}, ...rows.flatMap(([name, value]) => [h('dt', {}, name), h('dd', {}, value)]));
}

export interface Column {
  title: string;
  number?: boolean;
}

export function table(caption: string, columns: readonly Column[], rows: readonly (readonly Child[])[]): HTMLTableElement {
  const cell = (tag: 'td' | 'th', i: number, child: Child): HTMLElement =>
    h(tag, {class: columns[i]?.number ? 'number' : 'text', ...(tag === 'th' ? {scope: 'col'} : {})}, child);
  return h('table', {},
    h('caption', {class: 'hidden'}, caption),
    h('thead', {}, h('tr', {}, ...columns.map((c, i) => cell('th', i, c.title)))),
    h('tbody', {}, ...rows.map(row => h('tr', {}, ...row.map((child, i) => cell('td', i, child))))));
}
