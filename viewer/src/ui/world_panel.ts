// Next to the world: its figures, the selected part, how it is shown, its materials.
import {Vector3, type MeshStandardMaterial, type Texture} from 'three';
import type {WorldMode} from '../modes/world';
import {state} from '../state';
import {formOf, otherColor} from '../world/forms';
import {lightOf} from 'wrlkit-three';
import type {Lighting} from '../world/lights';
import type {Look} from '../world/looks';
import {bytesByKind, heaviest, unpackedBytes} from '../world/statistics';
import {densityScale} from '../world/texels';
import {boxOf, labelOf, meshesBelow, type Part} from '../world/world';
import {button, check, choice, facts, h, section, slider, table} from './dom';
import {bytes, count, counted, length, share, significant} from './format';
import {keptCheck, keptChoice} from './kept';
import {levelsPanel} from './levels_panel';
import {Tabs, type Tab} from './tabs';

const mostMaterials = 500;  // that are listed

export class WorldPanel {
  readonly element: HTMLElement;
  private readonly tabs: Tabs;
  private readonly part = h('div', {class: 'panel'});
  private readonly live = h('div', {class: 'live'});
  private readonly memory: number;
  private readonly opened = performance.now();  // since the page was asked for

  constructor(private readonly mode: WorldMode) {
    this.memory = unpackedBytes(mode.world);
    const levels: Tab[] = mode.levels ? [{key: 'levels', title: 'Levels', content: levelsPanel(mode, mode.levels)}] : [];
    this.tabs = new Tabs('World', [
      {key: 'figures', title: 'Figures', content: this.figures()},
      {key: 'part', title: 'Part', content: this.part},
      {key: 'view', title: 'View', content: this.view()},
      ...levels,
      {key: 'materials', title: 'Materials', content: this.materials()},
    ], key => state.set('panel', key));
    this.element = this.tabs.element;
    this.showPart(null);
    mode.onSelect(part => { this.showPart(part); if (part) this.tabs.show('part'); });
    mode.stage.onFrame(() => this.drawn());
    const wanted = state.get('panel');
    if (wanted) this.tabs.show(wanted, false);
  }

  private drawn(): void {
    const f = this.mode.stage.figures;
    this.live.replaceChildren(facts([['Draws', count(f.draws)], ['Triangles drawn', count(f.triangles)], ['Time to draw', `${f.milliseconds.toFixed(1)} ms`],
      ['Memory, about', bytes(this.memory)], ['Opened in', `${significant(this.opened / 1000, 2)} s`]]));
  }

  private figures(): HTMLElement {
    const {world} = this.mode;
    const size = world.box.getSize(new Vector3());
    const meshes = world.parts.filter(p => p.mesh !== null).length;
    const heavy = heaviest(world, 20).filter(row => row.triangles > 0);
    const rows = heavy.map(row => [button(row.label, () => this.mode.select(row.part, true), {class: 'link'}), count(row.places), count(row.triangles), bytes(row.bytes)]);
    return h('div', {class: 'panel'},
      section('World', facts([
        ['Triangles', h('output', {id: 'world-triangles'}, count(world.triangles))],
        ['Triangles stored', h('output', {id: 'world-unique'}, count(world.unique))], ['Parts', count(world.parts.length)], ['Shapes', count(meshes)],
        ['Materials', count(world.file.materials?.length ?? 0)], ['Pictures', count(world.file.images?.length ?? 0)],
        ['Size', world.empty ? 'nothing is seen' : `${length(size.x)} × ${length(size.y)} × ${length(size.z)}`], ['As GLB', bytes(world.size)]])),
      section('Heaviest parts', heavy.length > 0
        ? h('div', {class: 'scroll'}, table('Heaviest parts', [{title: 'Part'}, {title: 'Places', number: true}, {title: 'Triangles', number: true}, {title: 'Bytes', number: true}], rows))
        : h('p', {}, 'There are no triangles.')),
      section('Bytes', byteBar(bytesByKind(world))),
      section('Picture', this.live));
  }

  private showPart(part: Part | null): void {
    if (!part) {
      this.part.replaceChildren(h('p', {class: 'hint'}, 'Click a part in the picture, or choose one in the tree.'));
      return;
    }
    const size = boxOf(part).getSize(new Vector3());
    const materials = [...new Set(meshesBelow(part).map(mesh => this.mode.looks.original(mesh).name || 'unnamed'))];
    const rows: [string, string | HTMLElement][] = [['Type', part.type], ['Triangles', h('output', {id: 'part-triangles'}, count(part.triangles))], ['Bytes', bytes(part.bytes)]];
    if (part.children.length > 0) rows.push(['Parts inside', count(countBelow(part))]);
    if (size.length() > 0) rows.push(['Size', `${length(size.x)} × ${length(size.y)} × ${length(size.z)}`]);
    const form = formOf(this.mode.world.file, part.mesh);
    if (form) rows.push(['Form', `${form.kind}, ${Object.entries(form.sizes).filter(([, v]) => typeof v === 'number').map(([k, v]) => `${k} ${significant(v as number, 4)}`).join(', ')}`]);
    if (materials.length > 0) rows.push([materials.length > 1 ? 'Materials' : 'Material', materials.slice(0, 6).join(', ') + (materials.length > 6 ? ` and ${materials.length - 6} more` : '')]);
    this.part.replaceChildren(
      section(labelOf(part), ...above(part, p => this.mode.select(p)), facts(rows),
        h('div', {class: 'buttons'}, button('Look at it', () => this.mode.lookAt(part)), button('Hide', () => this.hide(part)), button('Show only this', () => this.isolate(part)), button('Show all', () => this.showAll()))),
      ...(Object.keys(part.extras).length > 0 ? [section('Extras', h('pre', {tabindex: 0, 'aria-label': 'Extras'}, JSON.stringify(part.extras, null, 1)))] : []));
  }

  private hide(part: Part): void {
    this.mode.setHidden(part, true);
    this.mode.select(null);
  }

  private isolate(part: Part): void {
    this.showAll();
    const family = new Set<Part>([part]);
    for (let p = part.parent; p; p = p.parent) family.add(p);
    const hideOthers = (parts: Part[]): void => {
      for (const p of parts) {
        if (!family.has(p)) this.mode.setHidden(p, true);
        else if (p !== part) hideOthers(p.children);
      }
    };
    hideOthers(this.mode.world.roots);
  }

  private showAll(): void {
    for (const part of this.mode.world.parts) if (part.object.userData['hidden']) this.mode.setHidden(part, false);
  }

  private view(): HTMLElement {
    const {mode} = this;
    const {world, stage} = mode;
    if (state.get('move') === 'walk') mode.move('walk');
    const manner = choice('Move', [['orbit', 'Orbit'], ['walk', 'Walk']] as const, mode.manner, value => {
      mode.move(value);
      stage.canvas.focus();
    });
    const lighting = keptChoice<Lighting>(`light${mode.suffix}`, 'Light', [['world', 'World’s'], ['headlight', 'Headlight'], ['off', 'Off']], 'world', value => mode.setLighting(value));
    lighting.element.dataset['key'] = 'l';
    const parts: HTMLElement[] = [manner.element, lighting.element];
    if (world.parts.some(p => p.meshes.some(m => lightOf(mode.looks.original(m))))) parts.push(this.bakedLight());
    else parts.push(this.surface([['full', 'As it is'], ['grey', 'Grey']], null));
    parts.push(keptCheck(`edges${mode.suffix}`, 'Edges (hidden lines removed)', false, on => mode.setEdges(on), 'x'));
    parts.push(keptCheck(`boxes${mode.suffix}`, 'Bounding boxes', false, on => mode.setBoxes(on), 'b'));
    if (world.sky) parts.push(keptCheck(`sky${mode.suffix}`, 'Sky of the world', false, on => mode.setSky(on)));
    const sections = [section('Display', ...parts)];
    const places = world.viewpoints.map(v => button(v.name, () => mode.goTo(v)));
    sections.push(section('Viewpoints', h('div', {class: 'buttons places'}, button('All of it', () => stage.overview(world.box)), ...places)));
    if (world.clips.length > 0) sections.push(section('Animations', h('p', {}, world.clips.map(c => c.name || 'unnamed').join(', ')), this.playBox()));
    if (mode.behaviour.any || mode.behaviour.lost.length > 0) sections.push(this.behaviour());
    const speed = slider('Walking speed', {min: -2, max: 2, step: 0.1, value: 0}, value => setSpeed(value));
    const setSpeed = (value: number): void => {
      stage.navigator.speed = world.navigation.speed * 4 ** value;
      speed.set(value, `${significant(stage.navigator.speed, 2)} m/s`);
    };
    setSpeed(0);
    sections.push(section('Walking', speed.element));
    return h('div', {class: 'panel'}, ...sections);
  }

  private behaviour(): HTMLElement {
    const {behaviour} = this.mode, {lost} = behaviour;
    const run = behaviour.any ? this.runBox() : [];
    const list = lost.map(([type, n]) => n > 1 ? `${type} (${count(n)})` : type).join(', ');
    return section('Behaviour', ...run, ...(list ? [h('p', {class: 'soft', id: `not-run${this.mode.suffix}`}, `Not run here: ${list}.`)] : []));
  }

  private playBox(): HTMLElement {
    const {mode} = this, box = check('Play', false, on => mode.play(on), 'p'), input = box.querySelector('input')!;
    mode.onRun(() => {
      input.checked = mode.playing;
      input.disabled = mode.behaviour.running;
    });
    return box;
  }

  /// The address does not keep it: a link runs nothing.
  private runBox(): HTMLElement[] {
    const {mode} = this, box = check('Run the world (clicks, sensors, clocks)', false, on => mode.run(on)), input = box.querySelector('input')!;
    const fault = h('p', {class: 'soft', role: 'status', id: `run-fault${mode.suffix}`});
    const scripts = check('Run its Scripts (programs in the file)', false, on => mode.runScripts(on)), scriptsInput = scripts.querySelector('input')!;
    const sounds = check('Play its sounds', false, on => mode.hearSounds(on)), soundsInput = sounds.querySelector('input')!;
    const scriptFaults = h('ul', {class: 'soft', id: `script-faults${mode.suffix}`}), soundFaults = h('ul', {class: 'soft', id: `sound-faults${mode.suffix}`});
    scriptsInput.disabled = soundsInput.disabled = true;
    const list = (element: HTMLElement, texts: readonly string[]): void => element.replaceChildren(...texts.map(text => h('li', {}, text)));
    mode.onRun(() => {
      const {behaviour} = mode;
      input.checked = behaviour.running;
      scriptsInput.disabled = !behaviour.running;
      scriptsInput.checked = behaviour.runsScripts;
      soundsInput.checked = behaviour.sounds?.on ?? false;
      soundsInput.disabled = !behaviour.running;
      list(scriptFaults, behaviour.scriptFaults);
      list(soundFaults, behaviour.sounds?.faults ?? []);
      fault.textContent = behaviour.fault ? `The world was stopped: ${behaviour.fault}.` : '';
    });
    return [box, fault, ...(mode.behaviour.programs.length > 0 ? [scripts, scriptFaults] : []), ...(mode.behaviour.hasSounds ? [sounds, soundFaults] : [])];
  }

  private bakedLight(): HTMLElement {
    const legend = h('ul', {class: 'legend', hidden: true}, ...densityScale.map(([n, color]) => h('li', {}, h('i', {style: `background:${color}`}), `${n} texels a metre`)));
    return this.surface([['full', 'Both'], ['light', 'Baked light'], ['albedo', 'Colour'], ['checker', 'Texels'], ['density', 'Density']], legend);
  }

  /// `density`: the legend of that look.
  private surface(options: readonly (readonly [Look, string])[], density: HTMLElement | null): HTMLElement {
    const {forms, suffix} = this.mode;
    const found = forms.legend.length > 0;
    const legend = h('ul', {class: 'legend', id: `forms${suffix}`, hidden: true}, ...forms.legend.map(f => kindRow(f.color, f.kind, f.parts)),
      ...(forms.others > 0 ? [kindRow(otherColor, 'other faces', forms.others)] : []));
    const looks = keptChoice<Look>(`look${suffix}`, 'Surface', found ? [...options, ['form', 'By form']] : options, 'full', value => {
      this.mode.setLook(value);
      legend.hidden = value !== 'form';
      if (density) density.hidden = value !== 'density';
    });
    return h('div', {}, looks.element, ...(density ? [density] : []), legend);
  }

  private materials(): HTMLElement {
    const users = new Map<MeshStandardMaterial, Part[]>();
    for (const part of this.mode.world.parts) {
      for (const mesh of part.meshes) {
        const m = this.mode.looks.original(mesh) as MeshStandardMaterial;
        const parts = users.get(m);
        if (parts) parts.push(part);
        else users.set(m, [part]);
      }
    }
    const entries = [...users].slice(0, mostMaterials).map(([m, parts]) => this.material(m, parts));
    if (users.size > mostMaterials) entries.push(h('p', {class: 'hint'}, `and ${count(users.size - mostMaterials)} more`));
    return h('div', {class: 'panel'}, section('Materials', ...(entries.length > 0 ? entries : [h('p', {}, 'There are none.')])));
  }

  private material(m: MeshStandardMaterial, parts: Part[]): HTMLElement {
    const swatch = h('i', {class: 'swatch', style: `background:${m.color ? `#${m.color.getHexString()}` : 'none'}`});
    const words = [counted(parts.length, 'part')];
    if (m.opacity < 1) words.push(`opacity ${significant(m.opacity, 2)}`);
    if (m.roughness !== undefined) words.push(`roughness ${significant(m.roughness, 2)}`);
    else words.push(lightOf(m) ? 'baked light' : 'unlit');
    const pictures = ([['texture', m.map], ['emission', m.emissiveMap], ['baked light', lightOf(m)]] as const).flatMap(([name, t]) => t ? [thumbnail(t, name)] : []);
    return h('div', {class: 'material'}, swatch, h('div', {}, button(m.name || 'unnamed', () => this.mode.select(parts[0]!, true), {class: 'link'}), h('div', {class: 'soft'}, words.join(' · ')), ...pictures));
  }
}

function thumbnail(texture: Texture, what: string): HTMLElement {
  const image = texture.image as ImageBitmap | undefined;
  if (!image?.width) return h('span');
  const canvas = h('canvas', {class: 'thumb', width: 64, height: Math.max(1, Math.round(64 * Math.min(2, image.height / image.width))), role: 'img', 'aria-label': what});
  canvas.getContext('2d')?.drawImage(image, 0, 0, canvas.width, canvas.height);
  return h('div', {class: 'soft picture'}, canvas, `${what}: ${texture.name ? `${texture.name}, ` : ''}${image.width} × ${image.height}`);
}

const kindRow = (color: string, kind: string, parts: number): HTMLElement =>
  h('li', {}, h('i', {style: `background:${color}`}), `${kind} `, h('span', {class: 'soft'}, count(parts)));

const countBelow = (part: Part): number => part.children.reduce((n, p) => n + 1 + countBelow(p), 0);

/// The way from the root to a part, to be clicked.
function above(part: Part, pick: (part: Part) => void): HTMLElement[] {
  const way: HTMLElement[] = [];
  for (let p = part.parent; p; p = p.parent) {
    const at = p;
    way.unshift(h('li', {}, button(p.name || p.type, () => pick(at), {class: 'link'})));
  }
  return way.length > 0 ? [h('ol', {class: 'way', 'aria-label': 'Inside of'}, ...way)] : [];
}

const kindColors = ['#3565a8', '#c8772b', '#4b8b5a', '#8a5ba6', '#b5474f', '#6d7680', '#2f8f9d'];

function byteBar(kinds: {name: string; bytes: number}[]): HTMLElement {
  const all = kinds.reduce((n, k) => n + k.bytes, 0);
  const bar = h('div', {class: 'bar-of-bytes', 'aria-hidden': 'true'}, ...kinds.map((k, i) => h('i', {style: `flex:${k.bytes};background:${kindColors[i % kindColors.length]}`})));
  return h('div', {}, bar, h('ul', {class: 'legend'}, ...kinds.map((k, i) => h('li', {}, h('i', {style: `background:${kindColors[i % kindColors.length]}`}), `${k.name} `, h('span', {class: 'soft'}, `${bytes(k.bytes)}, ${share(k.bytes, all)}`)))));
}
