// The tree of parts with a search. Only the rows that are seen are in the page, so that a plant of a hundred thousand
// parts scrolls.
import {count} from './format';
import {h} from './dom';

const rowHeight = 24;

/// What a row shows.
export interface TreePart<P> {
  readonly node: number;      // no other has it
  readonly name: string;      // empty when it has none
  readonly type: string;
  readonly extras: Record<string, unknown>;
  readonly parent: P | null;
  readonly children: readonly P[];
  readonly triangles: number; // 0: not said
}

interface Row<P> {
  part: P;
  depth: number;
}

/// The name of the nearest part above that has one; empty when there is none.
export function namedAbove<P extends TreePart<P>>(part: P): string {
  for (let above = part.parent; above; above = above.parent) if (above.name) return above.name;
  return '';
}

export class Tree<P extends TreePart<P>> {
  readonly element: HTMLElement;
  private readonly search: HTMLInputElement;
  private readonly found = h('p', {class: 'found', role: 'status'});
  private readonly list: HTMLElement;
  private readonly space = h('div', {class: 'space', role: 'presentation'});
  private readonly open = new Set<P>();
  private readonly texts = new Map<P, string>();
  private rows: Row<P>[] = [];
  private selected: P | null = null;

  /// `parts` may grow; refresh() shows what is new.
  constructor(private readonly world: {readonly roots: readonly P[]; readonly parts: readonly P[]}, private readonly pick: (part: P, closer: boolean) => void) {
    this.search = h('input', {type: 'search', placeholder: 'Search names, types, extras', 'aria-label': 'Search parts', input: () => this.fill(), keydown: (e: KeyboardEvent) => this.searchKey(e)});
    this.list = h('div', {class: 'rows', role: 'tree', tabindex: 0, 'aria-label': 'Parts', scroll: () => this.draw(), keydown: (e: KeyboardEvent) => this.key(e)}, this.space);
    this.element = h('div', {class: 'tree'}, h('div', {class: 'search'}, this.search, this.found), this.list);
    new ResizeObserver(() => this.draw()).observe(this.list);
    this.refresh();
  }

  refresh(): void {
    if (this.world.roots.length < 4 && this.open.size === 0) for (const part of this.world.roots) this.open.add(part);
    this.fill();
  }

  /// Shows a part as selected, and where it is in the tree.
  select(part: P | null): void {
    this.selected = part;
    for (let above = part?.parent; above; above = above.parent) this.open.add(above);
    if (part && !this.matches(part)) this.search.value = '';
    this.fill();
    const i = this.rows.findIndex(row => row.part === part);
    if (i >= 0) this.reveal(i);
  }

  private matches(part: P): boolean {
    const wanted = this.search.value.trim().toLowerCase();
    return !wanted || part.type.toLowerCase().startsWith(wanted) || this.textOf(part).includes(wanted);
  }

  /// Its name, and what its extras hold: titles, addresses, metadata.
  private textOf(part: P): string {
    let text = this.texts.get(part);
    if (text === undefined) this.texts.set(part, text = [part.name, ...wordsOf(part.extras)].join('\n').toLowerCase());
    return text;
  }

  private fill(): void {
    const wanted = this.search.value.trim();
    this.rows = wanted ? this.world.parts.filter(p => this.matches(p)).map(part => ({part, depth: 0})) : [];
    const add = (part: P, depth: number): void => {
      this.rows.push({part, depth});
      if (this.open.has(part)) for (const child of part.children) add(child, depth + 1);
    };
    if (!wanted) for (const part of this.world.roots) add(part, 0);
    this.found.textContent = wanted ? `${count(this.rows.length)} found` : `${count(this.world.parts.length)} parts`;
    this.space.style.height = `${this.rows.length * rowHeight}px`;
    this.draw();
  }

  private draw(): void {
    const first = Math.max(0, Math.floor(this.list.scrollTop / rowHeight) - 4);
    const last = Math.min(this.rows.length, first + Math.ceil(this.list.clientHeight / rowHeight) + 8);
    this.space.replaceChildren(...this.rows.slice(first, last).map((row, i) => this.row(row, first + i)));
    const at = this.rows.findIndex(row => row.part === this.selected);
    if (at >= first && at < last) this.list.setAttribute('aria-activedescendant', `row-${this.selected!.node}`);
    else this.list.removeAttribute('aria-activedescendant');
  }

  private row({part, depth}: Row<P>, index: number): HTMLElement {
    const branch = part.children.length > 0 && !this.search.value.trim();
    const twist = h('span', {class: branch ? this.open.has(part) ? 'twist open' : 'twist' : 'twist leaf', 'aria-hidden': 'true'});
    const row = h('div', {
      class: 'part', role: 'treeitem', id: `row-${part.node}`, 'aria-level': depth + 1, 'aria-selected': String(part === this.selected),
      ...(branch ? {'aria-expanded': String(this.open.has(part))} : {}), style: `top:${index * rowHeight}px;padding-left:${6 + Math.min(depth, 14) * 13}px`,
      click: (e: MouseEvent) => e.target === twist && branch ? this.toggle(part) : this.pick(part, false),
      dblclick: () => this.pick(part, true),
    }, twist, h('span', {class: part.name ? 'name' : 'name nameless'}, part.name || part.type), h('span', {class: 'type'}, this.about(part)));
    if (part.triangles > 0) row.append(h('span', {class: 'figure'}, count(part.triangles)));
    return row;
  }

  /// What is shown next to a name: the type, and of what was found where it is.
  private about(part: P): string {
    const type = part.name ? part.type : '', above = this.search.value.trim() ? namedAbove(part) : '';
    return above ? `${type} in ${above}`.trim() : type;
  }

  private toggle(part: P): void {
    if (!this.open.delete(part)) this.open.add(part);
    this.fill();
  }

  private reveal(index: number): void {
    const top = index * rowHeight;
    if (top < this.list.scrollTop || top + rowHeight > this.list.scrollTop + this.list.clientHeight) this.list.scrollTop = top - this.list.clientHeight / 2;
    this.draw();
  }

  private searchKey(e: KeyboardEvent): void {
    if (e.key === 'Enter' && this.rows[0]) this.pick(this.rows[0].part, true);
    if (e.key === 'ArrowDown') this.list.focus();
  }

  private key(e: KeyboardEvent): void {
    const i = this.rows.findIndex(row => row.part === this.selected), part = this.rows[i]?.part;
    const go = (to: number): void => { const row = this.rows[Math.max(0, Math.min(this.rows.length - 1, to))]; if (row) this.pick(row.part, false); };
    const keys: Record<string, () => void> = {
      ArrowDown: () => go(i + 1),
      ArrowUp: () => go(i - 1),
      Home: () => go(0),
      End: () => go(this.rows.length - 1),
      Enter: () => part && this.pick(part, true),
      ArrowRight: () => { if (part && part.children.length > 0) this.open.has(part) ? go(i + 1) : this.toggle(part); },
      ArrowLeft: () => { if (part && this.open.has(part)) this.toggle(part); else if (part?.parent) this.pick(part.parent, false); },
    };
    if (!keys[e.key]) return;
    keys[e.key]!();
    e.preventDefault();
    e.stopPropagation();
  }
}

function wordsOf(value: unknown): string[] {
  if (typeof value === 'string') return [value];
  return value && typeof value === 'object' ? Object.values(value).flatMap(wordsOf) : [];
}
