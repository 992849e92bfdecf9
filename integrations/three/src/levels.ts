// Levels of detail (MSFT_lod). MSFT_screencoverage says down to which part of the window's height each level is shown, in VRML's standard
// field of view; levels change at the distances of the VRML file, whatever the camera's field of view is.
import {Box3, MathUtils, Vector3, type Camera, type Object3D} from 'three';
import type {GLTF, GLTFParser} from 'three/addons/loaders/GLTFLoader.js';

const angle = 0.785398;
/// VRML's standard field of view, in degrees.
export const fieldOfView = MathUtils.radToDeg(angle);
const tangent = Math.tan(angle / 2);

/// The levels of one object, which are siblings.
export class LevelSet {
  readonly box = new Box3();  // of the finest level, in the world

  /// levels: the finest one first. coverage: empty where the file does not say it.
  constructor(readonly levels: Object3D[], readonly coverage: number[]) { this.measure(); }

  /// After the object has been moved or scaled.
  measure(): void { this.box.setFromObject(this.levels[0]!); }

  get radius(): number { return this.box.isEmpty() ? 0 : this.box.getSize(new Vector3()).length() / 2; }

  /// From the eye to the middle of the box, in metres, where the level behind this one takes its place; 0 where that is not said.
  switchDistance(level: number): number {
    const least = this.coverage[level];
    return least ? this.radius / (least * tangent) : 0;
  }

  /// The level that is shown at this distance between the eye and the middle of the box.
  levelAt(distance: number): number {
    const covered = this.radius / (distance * tangent);
    const level = this.coverage.findIndex(least => covered >= least);
    return level < 0 ? 0 : Math.min(level, this.levels.length - 1);
  }

  distanceTo(eye: Vector3): number { return eye.distanceTo(this.box.getCenter(new Vector3())); }

  show(level: number): void { this.levels.forEach((o, k) => { o.visible = k === level; }); }
}

const known = new WeakMap<GLTF, LevelSet[]>();

/// Of a file that WrlkitPlugin has seen.
export function levelsOf(gltf: GLTF): LevelSet[] {
  return known.get(gltf) ?? [];
}

/// Shows the levels that the file has for where the camera is; to be called before each picture.
export function updateLevels(sets: readonly LevelSet[], camera: Camera): void {
  const eye = new Vector3().setFromMatrixPosition(camera.matrixWorld);
  for (const set of sets) set.show(set.levelAt(set.distanceTo(eye)));
}

interface FileNode {
  extensions?: {MSFT_lod?: {ids?: number[]}};
  extras?: {MSFT_screencoverage?: number[]};
}

/// Hangs the coarser levels next to the finest one, hidden.
export async function hangLevels(gltf: GLTF, parser: GLTFParser): Promise<void> {
  const nodes = (parser.json as {nodes?: FileNode[]}).nodes ?? [];
  const finest: {object: Object3D; node: FileNode; ids: number[]}[] = [];
  gltf.scene.traverse(object => {
    const node = nodes[parser.associations.get(object)?.nodes ?? -1], ids = node?.extensions?.MSFT_lod?.ids;
    if (node && ids && object.parent) finest.push({object, node, ids});
  });
  const sets = await Promise.all(finest.map(async ({object, node, ids}) => {
    const coarser = await Promise.all(ids.map(id => parser.getDependency('node', id) as Promise<Object3D>));
    for (const level of coarser) {
      object.parent?.add(level);
      level.visible = false;
    }
    return {levels: [object, ...coarser], coverage: node.extras?.MSFT_screencoverage ?? []};
  }));
  gltf.scene.updateMatrixWorld(true);
  known.set(gltf, sets.map(set => new LevelSet(set.levels, set.coverage)));
}
