// A plant is thousands of small meshes of few materials. Those that stand still are drawn by material, in one call each; the
// meshes themselves stay in the tree, unseen, for everything else: picking, boxes, selection.
import {BatchedMesh, Group, type BufferAttribute, type BufferGeometry, type Material, type Mesh, type Object3D, type Scene} from 'three';
import type {Look, Looks} from './looks';
import {isShown, type World} from './world';

/// The layer of meshes that a batch draws. Cameras do not see it, rays that are told to do.
export const batchedLayer = 1;
const few = 200;  // meshes that are drawn one by one

interface Batch {
  drawn: BatchedMesh;
  material: Material;  // of the file
  meshes: Mesh[];      // by instance
}

export class Batches {
  private readonly group = new Group();
  private readonly batches: Batch[] = [];
  private stale = false;

  constructor(scene: Scene, world: World) {
    scene.add(this.group);
    world.root.updateMatrixWorld(true);
    const meshes = still(world);
    if (meshes.length <= few) return;
    const groups = new Map<string, Mesh[]>();
    for (const mesh of meshes) {
      const key = keyOf(mesh), together = groups.get(key);
      if (together) together.push(mesh);
      else groups.set(key, [mesh]);
    }
    for (const together of groups.values()) if (together.length > 1) this.add(together);
  }

  /// Some meshes were hidden or shown.
  visibilityChanged(): void { this.stale = true; }

  /// Before each picture.
  update(): void {
    if (!this.stale) return;
    this.stale = false;
    for (const {drawn, meshes} of this.batches) meshes.forEach((mesh, i) => drawn.setVisibleAt(i, isShown(mesh)));
  }

  setLook(looks: Looks, look: Look): void {
    for (const batch of this.batches) batch.drawn.material = looks.variant(batch.material, look);
  }

  private add(meshes: Mesh[]): void {
    const geometries = [...new Set(meshes.map(mesh => mesh.geometry))];
    const size = (count: (g: BufferGeometry) => number): number => geometries.reduce((n, g) => n + count(g), 0);
    const material = meshes[0]!.material as Material;
    const drawn = new BatchedMesh(meshes.length, size(g => g.getAttribute('position').count), size(g => g.index?.count ?? 0), material);
    drawn.sortObjects = false;
    drawn.frustumCulled = false;  // each of its objects is
    const ids = new Map(geometries.map(g => [g, drawn.addGeometry(g)]));
    for (const mesh of meshes) {
      drawn.setMatrixAt(drawn.addInstance(ids.get(mesh.geometry)!), mesh.matrixWorld);
      mesh.layers.set(batchedLayer);
    }
    this.group.add(drawn);
    this.batches.push({drawn, material, meshes});
  }
}

/// Opaque meshes that no animation and no level of detail moves or hides.
function still(world: World): Mesh[] {
  const found: Mesh[] = [];
  if (world.clips.length > 0) return found;
  const levels = new Set(world.levels.flatMap(l => l.levels));
  const walk = (o: Object3D): void => {
    if (levels.has(o)) return;
    const mesh = o as Mesh;
    if (mesh.isMesh && !(mesh.material as Material).transparent && mesh.matrixWorld.determinant() > 0 && Object.keys(mesh.geometry.morphAttributes).length === 0) found.push(mesh);
    o.children.forEach(walk);
  };
  walk(world.root);
  return found;
}

/// Meshes of one key fit into one batch.
function keyOf(mesh: Mesh): string {
  const attributes = Object.entries(mesh.geometry.attributes).map(([name, a]) => `${name} ${a.itemSize} ${a.normalized} ${(a as BufferAttribute).array.constructor.name}`).sort();
  return [(mesh.material as Material).uuid, mesh.geometry.index !== null, ...attributes].join();
}
