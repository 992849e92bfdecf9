// Keys that act wherever the focus is, but in a field that takes text.
import type {Mode, Stage} from '../view/stage';
import type {Shell} from './shell';

/// What keys act on.
export interface KeyMode<P = unknown> extends Mode {
  readonly stage: Stage;
  readonly selected: P | null;
  lookAt(part: P): void;
  select(part: P | null): void;
  goToNext?(by: 1 | -1): void;
}

/// Clicks what the page has for it, so that keys and buttons do the same.
function press(selector: string): void {
  document.querySelector<HTMLElement>(selector)?.click();
}

/// `world` is the one that is looked at.
export function listenToKeys<P>(shell: Shell, world: () => KeyMode<P>): void {
  const keys: Record<string, () => void> = {
    '?': () => shell.openHelp(),
    '/': () => document.querySelector<HTMLInputElement>('.search input')?.focus(),
    t: () => shell.toggleTheme(),
    f: () => {
      const {selected, stage} = world();
      if (selected && stage.shows(world())) world().lookAt(selected);
      else stage.frameAll();
    },
    v: () => world().goToNext?.(1),
    V: () => world().goToNext?.(-1),
    Escape: () => world().select(null),
    x: () => press('[data-key=x]'),
    b: () => press('[data-key=b]'),
    l: () => press('[data-key=l] input:not(:checked)'),
    p: () => press('[data-key=p]'),
    ' ': () => press('[data-key=space]'),
    Backspace: () => press('[data-key=back]'),
  };
  for (const n of [1, 2, 3, 4]) keys[n] = () => press(`.modes button:nth-child(${n})`);
  document.addEventListener('keydown', e => {
    const target = e.target as HTMLElement;
    const takesText = target instanceof HTMLInputElement && ['search', 'number', 'text'].includes(target.type);
    const takesSpace = e.key === ' ' && (target instanceof HTMLButtonElement || target instanceof HTMLInputElement);
    if (e.ctrlKey || e.metaKey || e.altKey || takesText || takesSpace || document.querySelector('dialog[open]')) return;
    const act = keys[e.key] ?? keys[e.key.toLowerCase()];
    if (!act) return;
    act();
    e.preventDefault();
  });
}
