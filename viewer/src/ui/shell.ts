// The frame of the page: the bar with the modes, the tree at the left, the picture, the panel at the right. On a phone the
// picture fills the page and the others come up as a sheet.
import {button, h} from './dom';
import {makeHelp} from './help';
import {state} from '../state';

export interface ModeView {
  key: string;
  title: string;
  left: HTMLElement | null;
  right: HTMLElement;
  over: HTMLElement | null;  // on the picture
  enter(): void;
}

const paper = {width: 680, height: 620};  // that a picture may take of A4 and Letter, in pixels of style sheets

export class Shell {
  readonly canvas = h('canvas', {tabindex: 0, 'aria-label': 'Picture of the world. Arrow keys turn it.'});
  private readonly left = h('aside', {class: 'left', 'aria-label': 'Tree of parts'});
  private readonly right = h('aside', {class: 'right', 'aria-label': 'Panel'});
  private readonly over = h('div', {class: 'over'});
  private readonly status = h('p', {class: 'status', role: 'status'});
  private readonly modes = h('nav', {class: 'modes', 'aria-label': 'Modes'});
  private readonly sheets = h('nav', {class: 'sheets', 'aria-label': 'Sheets'});
  private readonly help = makeHelp();
  private views: ModeView[] = [];
  private readonly buttons = new Map<string, HTMLButtonElement>();
  private current = '';
  private readonly view: HTMLElement;
  private themeOnScreen = '';
  onTheme: () => void = () => undefined;
  onPrint: () => void = () => undefined;  // the picture is wanted at once

  constructor(title: string, root: HTMLElement) {
    document.title = `${title}: wrlkit`;
    const tools = h('div', {class: 'tools'},
      button('Print', () => window.print()),
      button('Dark', () => this.toggleTheme(), {class: 'theme'}),
      button('Help', () => this.help.showModal(), {'aria-keyshortcuts': '?'}));
    const head = h('header', {class: 'head'}, h('h1', {}, title), this.modes, tools);
    this.view = h('main', {class: 'view'}, this.canvas, this.over, this.status);
    root.append(head, this.left, this.view, this.right, this.sheets, this.help);
    this.setTheme(state.get('theme') ?? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light'));
    for (const [key, text] of [['left', 'Parts'], ['none', 'Picture'], ['right', 'Panel']] as const) {
      this.sheets.append(button(text, () => this.sheet(key), {'data-sheet': key}));
    }
    this.sheet('none');
    window.addEventListener('beforeprint', () => this.toPaper());
    window.addEventListener('afterprint', () => this.fromPaper());
  }

  get mode(): string { return this.current; }
  get dark(): boolean { return document.documentElement.dataset['theme'] === 'dark'; }

  setModes(views: ModeView[]): void {
    this.views = views;
    for (const view of views) {
      const b = button(view.title, () => this.show(view.key));
      this.buttons.set(view.key, b);
      this.modes.append(b);
    }
    this.modes.hidden = views.length < 2;
    this.show(views.find(v => v.key === state.get('mode'))?.key ?? views[0]!.key);
  }

  show(key: string): void {
    const view = this.views.find(v => v.key === key);
    if (!view) return;
    this.current = key;
    for (const [k, b] of this.buttons) b.setAttribute('aria-pressed', String(k === key));
    this.left.replaceChildren(...(view.left ? [view.left] : []));
    this.left.hidden = !view.left;
    document.body.classList.toggle('no-left', !view.left);
    this.right.replaceChildren(view.right);
    this.right.setAttribute('aria-label', `${view.title} panel`);
    this.over.replaceChildren(...(view.over ? [view.over] : []));
    state.set('mode', key);
    view.enter();
  }

  say(text: string): void { if (this.status.textContent !== text) this.status.textContent = text; }
  openHelp(): void { this.help.open ? this.help.close() : this.help.showModal(); }

  /// Which sheet a phone shows.
  sheet(key: 'left' | 'none' | 'right'): void {
    document.body.dataset['sheet'] = key;
    for (const b of this.sheets.querySelectorAll('button')) b.setAttribute('aria-pressed', String(b.dataset['sheet'] === key));
  }

  toggleTheme(): void {
    this.setTheme(this.dark ? 'light' : 'dark');
    state.set('theme', this.dark ? 'dark' : 'light');
  }

  /// The picture goes onto paper as it is on the screen, as wide as the paper, and is light.
  private toPaper(): void {
    this.themeOnScreen = this.dark ? 'dark' : 'light';
    this.setTheme('light');
    const {clientWidth: width, clientHeight: height} = this.view;
    Object.assign(this.view.style, {width: `${width}px`, height: `${height}px`, zoom: String(Math.min(paper.width / width, paper.height / height))});
    this.onPrint();
  }

  private fromPaper(): void {
    this.view.removeAttribute('style');
    this.setTheme(this.themeOnScreen);
  }

  private setTheme(theme: string): void {
    document.documentElement.dataset['theme'] = theme === 'dark' ? 'dark' : 'light';
    const b = document.querySelector('button.theme');
    if (b) b.textContent = this.dark ? 'Light' : 'Dark';
    this.onTheme();
  }
}
