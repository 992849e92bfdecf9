// Panels of which one is seen at a time.
import {h} from './dom';

export interface Tab {
  key: string;
  title: string;
  content: HTMLElement;
}

export class Tabs {
  readonly bar: HTMLElement;
  readonly element: HTMLElement;
  private readonly buttons = new Map<string, HTMLButtonElement>();

  constructor(label: string, private readonly tabs: readonly Tab[], private readonly changed: (key: string) => void = () => undefined) {
    this.bar = h('div', {class: 'tabs', role: 'tablist', 'aria-label': label, keydown: (e: KeyboardEvent) => this.key(e)});
    for (const tab of tabs) {
      tab.content.id ||= `panel-${tab.key}`;
      const b = h('button', {type: 'button', role: 'tab', id: `tab-${tab.key}`, 'aria-controls': tab.content.id, click: () => this.show(tab.key)}, tab.title);
      tab.content.setAttribute('role', 'tabpanel');
      tab.content.tabIndex = 0;  // it may have to be scrolled
      tab.content.setAttribute('aria-labelledby', b.id);
      this.buttons.set(tab.key, b);
      this.bar.append(b);
    }
    this.element = h('div', {class: 'tabbed'}, this.bar, ...tabs.map(tab => tab.content));
    if (tabs[0]) this.show(tabs[0].key, false);
  }

  show(key: string, tell = true): void {
    for (const tab of this.tabs) {
      const on = tab.key === key, b = this.buttons.get(tab.key)!;
      tab.content.hidden = !on;
      b.setAttribute('aria-selected', String(on));
      b.tabIndex = on ? 0 : -1;
    }
    if (tell) this.changed(key);
  }

  private key(e: KeyboardEvent): void {
    const step = e.key === 'ArrowRight' ? 1 : e.key === 'ArrowLeft' ? -1 : 0;
    if (step === 0) return;
    const at = this.tabs.findIndex(tab => this.buttons.get(tab.key) === document.activeElement);
    const next = this.tabs[(at + step + this.tabs.length) % this.tabs.length]!;
    this.show(next.key);
    this.buttons.get(next.key)!.focus();
  }
}
