// A plant is thousands of small meshes. Those that stand still are drawn by material, in one call each; materials that differ in nothing
// but their colour are one. The meshes themselves stay in the tree, unseen, for everything else: picking, boxes, selection.
import {BatchedMesh, Color, DoubleSide, Group, Matrix4, MeshLambertMaterial, type BufferAttribute, type BufferGeometry, type Material, type Mesh, type MeshBasicMaterial, type MeshStandardMaterial, type Object3D, type Scene} from 'three';
import {bakedKey} from 'wrlkit-three';
import {moves} from '../behaviour/behaviour';
import {otherColor} from './forms';
import type {Look, Looks} from './looks';
import {isShown, type World} from './world';

/// The layer of meshes that a batch draws. Cameras do not see it, rays that are set to do.
export const batchedLayer = 1;
const few = 200;  // meshes that are drawn one by one

interface Batch {
  drawn: BatchedMesh;
  material: Material;  // as in the file; white, when there are colours
  colors: Color[];     // by instance; empty: the material has it
  meshes: Mesh[];      // by instance
  tinted: boolean;     // the instances have other colours than their own
}

const white = new Color(1, 1, 1), grey = new Color(otherColor);
const tinted = new MeshLambertMaterial({color: white, side: DoubleSide});

export class Batches {
  private readonly group = new Group();
  private readonly batches: Batch[] = [];
  private readonly toGroup = new Matrix4();
  private stale = true;

  constructor(scene: Scene, world: World) {
    scene.add(this.group);
    // The card has the places as singles: of a plant in the coordinates of its country they would be wrong by half a metre.
    world.box.getCenter(this.group.position);
    this.toGroup.makeTranslation(this.group.position.clone().negate());
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

  /// `tints`: colours of meshes instead of their own; others are grey.
  setLook(looks: Looks, look: Look, tints: Map<Mesh, Color> | null = null): void {
    const colored = look === 'full' || look === 'albedo';
    const plain = tints ? grey : white;
    for (const batch of this.batches) {
      const {drawn, material, colors, meshes} = batch;
      drawn.material = tints ? tinted : looks.variant(material, look);
      if (colors.length > 0 || tints || batch.tinted) meshes.forEach((mesh, i) => drawn.setColorAt(i, tints?.get(mesh) ?? (colored ? colors[i] : undefined) ?? plain));
      batch.tinted = tints !== null;
    }
  }

  private add(meshes: Mesh[]): void {
    const geometries = [...new Set(meshes.map(mesh => mesh.geometry))];
    const size = (count: (g: BufferGeometry) => number): number => geometries.reduce((n, g) => n + count(g), 0);
    const first = meshes[0]!.material as Material;
    const colored = meshes.some(mesh => mesh.material !== first);
    const colors = colored ? meshes.map(mesh => (mesh.material as MeshBasicMaterial).color) : [];
    const material = colored ? whitened(first) : first;
    const drawn = new BatchedMesh(meshes.length, size(g => g.getAttribute('position').count), size(g => g.index?.count ?? 0), material);
    drawn.sortObjects = false;
    drawn.frustumCulled = false;  // each of its objects is
    const ids = new Map(geometries.map(g => [g, drawn.addGeometry(g)]));
    const placed = new Matrix4();
    for (const mesh of meshes) {
      drawn.setMatrixAt(drawn.addInstance(ids.get(mesh.geometry)!), placed.multiplyMatrices(this.toGroup, mesh.matrixWorld));
      mesh.layers.set(batchedLayer);
    }
    colors.forEach((color, i) => drawn.setColorAt(i, color));
    this.group.add(drawn);
    this.batches.push({drawn, material, colors, meshes, tinted: false});
  }
}

/// Opaque meshes that no animation and no level of detail moves or hides.
function still(world: World): Mesh[] {
  const found: Mesh[] = [];
  if (world.clips.length > 0 || moves(world)) return found;
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
  return [materialKey(mesh.material as Material), mesh.geometry.index !== null, ...attributes].join();
}

/// The same for plain materials that differ in their colour only.
function materialKey(m: Material): string {
  const {type, uuid, side, alphaTest, vertexColors} = m;
  const {map, lightMap, lightMapIntensity, roughness, metalness, flatShading, emissive, emissiveMap, normalMap, roughnessMap, metalnessMap, aoMap, color} = m as MeshStandardMaterial;
  const plain = color && !emissiveMap && !normalMap && !roughnessMap && !metalnessMap && !aoMap && !(emissive && emissive.getHex() !== 0);
  if (!plain || (type !== 'MeshStandardMaterial' && type !== 'MeshBasicMaterial')) return uuid;
  return [type, side, alphaTest, vertexColors, map?.uuid, lightMap?.uuid, lightMapIntensity, roughness, metalness, flatShading, bakedKey(m)].join();
}

function whitened(m: Material): Material {
  const made = m.clone() as MeshBasicMaterial;
  made.color.copy(white);
  return made;
}
