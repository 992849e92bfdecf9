// The help overlay.
import {button, h} from './dom';

const keys: readonly (readonly [string, string])[] = [
  ['Drag, one finger', 'turn; in Walk: look around'],
  ['Right or Shift drag, two fingers', 'move sideways'],
  ['Wheel, pinch', 'nearer, farther; in Walk: go'],
  ['Arrow keys', 'turn; in Walk: go'],
  ['W A S D, Q E', 'in Walk: go, sink, rise; Shift is faster'],
  ['Click, double click in the tree', 'select, look at'],
  ['F', 'look at what is selected, or at all'],
  ['V, Shift V', 'the next Viewpoint, the one before'],
  ['/', 'search'],
  ['Esc', 'select nothing'],
  ['X, B, L', 'edges, bounding boxes, light'],
  ['Space', 'Collapse: the next edge'],
  ['Backspace', 'Collapse: one back'],
  ['P', 'Collapse, animations: play and stop'],
  ['1 2 3 4', 'modes'],
  ['T', 'light or dark'],
  ['?', 'this help'],
];

export function makeHelp(): HTMLDialogElement {
  const dialog: HTMLDialogElement = h('dialog', {class: 'help', 'aria-labelledby': 'help-title'},
    h('h2', {id: 'help-title', tabindex: -1, autofocus: true}, 'Help'),
    h('p', {}, 'The address of the page keeps what you see: copy it to share a view.'),
    h('dl', {}, ...keys.flatMap(([key, what]) => [h('dt', {}, key), h('dd', {}, what)])),
    h('div', {class: 'buttons'}, button('Close', () => dialog.close())));
  return dialog;
}
