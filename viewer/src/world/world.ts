// A world that is loaded: its parts as a tree, its levels of detail, its cameras and lights. A part is a node of glTF,
// which is a grouping node or a Shape of VRML.
import {LevelSet} from 'wrlkit-three';
import {Box3, type AnimationClip, type Light, type Mesh, type Object3D, type PerspectiveCamera} from 'three';
import {namedAbove} from '../ui/tree';
import type {GltfFile} from './file';

export interface Part {
  node: number;        // in the glTF file
  object: Object3D;
  name: string;        // empty when it has none
  type: string;
  extras: Record<string, unknown>;
  parent: Part | null;
  children: Part[];
  meshes: Mesh[];      // its own: triangles, lines, points
  mesh: number | null; // in the glTF file
  triangles: number;   // its own and those below, finest level
  bytes: number;       // of the meshes, its own and those below, each once
}

/// The finest level is part.object.
export class Levels extends LevelSet {
  constructor(set: LevelSet, readonly part: Part, readonly triangles: number[]) {  // triangles: of each level
    super(set.levels, set.coverage);
  }
}

export interface Viewpoint {
  name: string;
  node: string;         // the name of its node, which Anchors and events know
  camera: PerspectiveCamera;
}

export interface Navigation {
  type: string[];
  speed: number;        // metres a second
  size: [number, number, number];
  headlight: boolean;
}

export interface World {
  name: string;
  size: number;         // of the glb, bytes
  file: GltfFile;
  root: Object3D;
  parts: Part[];        // every one, parents first
  roots: Part[];
  levels: Levels[];
  viewpoints: Viewpoint[];
  navigation: Navigation;
  sky: number[] | null; // red, green, blue at the horizon
  lights: Light[];
  clips: AnimationClip[];
  box: Box3;            // of a world that shows nothing: some metres around the origin
  empty: boolean;
  triangles: number;    // as shown: finest level
  unique: number;       // the same, those of each mesh once
}

/// What a part is called where it has no name itself: by the nearest part above that has one.
export function labelOf(part: Part): string {
  if (part.name) return part.name;
  const above = namedAbove(part);
  return above ? `${part.type} in ${above}` : part.type;
}

/// The part to which an object of the scene belongs.
export function partOf(world: World, object: Object3D | null): Part | null {
  for (let o = object; o; o = o.parent) {
    const part = byObject(world).get(o);
    if (part) return part;
  }
  return null;
}

const tables = new WeakMap<World, Map<Object3D, Part>>();
function byObject(world: World): Map<Object3D, Part> {
  let table = tables.get(world);
  if (!table) {
    tables.set(world, table = new Map(world.parts.map(p => [p.object, p])));
    for (const l of world.levels) for (const level of l.levels) table.set(level, l.part);
  }
  return table;
}

export function boxOf(part: Part): Box3 {
  return new Box3().setFromObject(part.object);
}

/// All meshes at a part and below.
export function meshesBelow(part: Part): Mesh[] {
  return [...part.meshes, ...part.children.flatMap(meshesBelow)];
}

/// Hides an object for one who asks, or no longer: it is visible when nobody hides it.
export function hide(object: Object3D, by: 'user' | 'world', hidden: boolean): void {
  object.userData[keyOf[by]] = hidden;
  object.visible = !isHidden(object, 'user') && !isHidden(object, 'world');
}

export function isHidden(object: Object3D, by: 'user' | 'world'): boolean { return object.userData[keyOf[by]] === true; }

const keyOf = {user: 'hidden', world: 'hiddenByWorld'} as const;

/// Whether neither an object nor anything above it is hidden.
export function isShown(object: Object3D): boolean {
  for (let o: Object3D | null = object; o; o = o.parent) if (!o.visible) return false;
  return true;
}
