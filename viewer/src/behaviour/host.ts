// The world as a behaviour graph sees it: properties by JSON pointers (glTF 2.0 Asset Object Model), animations, and the camera.
import type {Light, Object3D, PerspectiveCamera} from 'three';
import {MathUtils} from 'three';
import {hide, isHidden, type World} from '../world/world';
import type {Host} from './graph';
import type {Value} from './operations';
import {Players} from './players';

interface Property {
  get(): Value;
  set?(value: Value): void;
}

const selectable = ['KHR_node_selectability', 'selectable'] as const, hoverable = ['KHR_node_hoverability', 'hoverable'] as const;

export class WorldHost implements Host {
  readonly players: Players;
  private readonly properties = new Map<string, Property>();
  private readonly before = new Map<string, Value>();  // what properties were when the graph began

  /// `told`: events that are for the page.
  constructor(private readonly world: World, camera: PerspectiveCamera, private readonly told: (id: string, value: Value) => void, private readonly changed: () => void) {
    this.players = new Players(world.root, world.clips);
    const eye = '/extensions/KHR_interactivity/activeCamera/';
    this.properties.set(`${eye}position`, {get: () => camera.position.toArray()});
    this.properties.set(`${eye}rotation`, {get: () => camera.quaternion.toArray() as number[]});
    this.properties.set(`${eye}perspective/yfov`, {get: () => MathUtils.degToRad(camera.fov)});
    this.properties.set(`${eye}perspective/aspectRatio`, {get: () => camera.aspect});
    for (const part of world.parts) this.addNode(part.node, part.object);
    world.clips.forEach((_, i) => this.properties.set(`/animations/${i}/extensions/KHR_interactivity/virtualPlayhead`, {get: () => this.players.head(i)}));
  }

  private addNode(node: number, object: Object3D): void {
    const at = `/nodes/${node}/`;
    const list = (name: string, get: () => number[], set: (v: number[]) => void): void => {
      this.properties.set(at + name, {get, set: v => { if (Array.isArray(v) && v.every(Number.isFinite)) set(v); }});
    };
    list('translation', () => object.position.toArray(), v => object.position.fromArray(v));
    list('rotation', () => object.quaternion.toArray() as number[], v => object.quaternion.fromArray(v as [number, number, number, number]));
    list('scale', () => object.scale.toArray(), v => object.scale.fromArray(v));
    this.properties.set(`${at}extensions/KHR_node_visibility/visible`, {get: () => !isHidden(object, 'world'), set: v => hide(object, 'world', v !== true)});
    const said = this.world.file.nodes?.[node]?.extensions;
    for (const [extension, property] of [selectable, hoverable]) {
      let value = (said?.[extension] as Record<string, unknown> | undefined)?.[property] !== false;
      this.properties.set(`${at}extensions/${extension}/${property}`, {get: () => value, set: v => { value = v === true; }});
    }
    const light = said?.['KHR_lights_punctual'] as {light: number} | undefined;
    const shining = [object, ...object.children].find(o => (o as Light).isLight) as Light | undefined;
    if (light && shining) this.properties.set(`/extensions/KHR_lights_punctual/lights/${light.light}/intensity`, {get: () => shining.intensity, set: v => { shining.intensity = Number(v); }});
  }

  get(pointer: string): Value | undefined { return this.properties.get(pointer)?.get(); }

  set(pointer: string, value: Value): boolean {
    const property = this.properties.get(pointer);
    property?.set?.(value);
    if (property?.set) this.changed();
    return property?.set !== undefined;
  }

  /// Whether a node can be clicked, or pointed at, when those are the nodes from it to the root.
  selects(way: readonly number[]): boolean { return this.allow(way, selectable); }
  hovers(way: readonly number[]): boolean { return this.allow(way, hoverable); }
  private allow(way: readonly number[], [extension, property]: readonly [string, string]): boolean {
    return way.every(node => this.get(`/nodes/${node}/extensions/${extension}/${property}`) !== false);
  }

  /// Keeps the values of properties that will be set.
  remember(pointers: readonly string[]): void {
    for (const pointer of pointers) {
      const property = this.properties.get(pointer);
      if (property?.set) this.before.set(pointer, property.get());
    }
  }

  /// The world is again as it was before the graph ran.
  restore(): void {
    this.players.dispose();
    for (const [pointer, value] of this.before) this.properties.get(pointer)?.set?.(value);
  }

  play(animation: number, start: number, end: number, speed: number, done: () => void): void { this.players.play(animation, start, end, speed, done); }
  stop(animation: number): void { this.players.stop(animation); }
  stopAt(animation: number, time: number, done: () => void): void { this.players.stopAt(animation, time, done); }
  send(id: string, value: Value): void { this.told(id, value); }
}
