// The names of the parts of a tileset: the rows of the property tables of all tiles that have been loaded so far, as one tree.
import {Box3, Matrix4, Vector3, type BufferAttribute, type InstancedMesh, type Mesh, type Object3D} from 'three';

export interface NamedPart {
  node: number;
  name: string;
  type: string;
  extras: Record<string, unknown>;
  parent: NamedPart | null;
  children: NamedPart[];
  triangles: number;
  box: Box3;            // of what has been loaded of it and of the parts below
}

/// As GLTFExtensionsPlugin of 3d-tiles-renderer leaves them in userData.
interface Table {
  count: number;
  getPropertyValue(name: string, row: number): unknown;
}
interface Features {
  featureIds: {attribute?: number; propertyTable?: number}[];
}
interface UserData {
  meshFeatures?: Features;
  structuralMetadata?: {tableAccessors: Table[]};
  gltfExtensions?: {EXT_instance_features?: Features};  // GLTFLoader leaves there what it does not know
}

/// For each vertex of a mesh, or for each place where it stands, the row of its part.
interface Rows {
  ids: BufferAttribute;
  parts: (NamedPart | null)[];
  ofPlaces: boolean;
}

const isInstanced = (o: Object3D): o is InstancedMesh => (o as InstancedMesh).isInstancedMesh === true;

/// How many times a mesh is drawn.
export const placesOf = (mesh: Mesh): number => isInstanced(mesh) ? mesh.count : 1;

/// From a mesh in one of its places to the page.
export function matrixAt(mesh: Mesh, place: number): Matrix4 {
  mesh.updateWorldMatrix(true, false);
  if (!isInstanced(mesh)) return mesh.matrixWorld.clone();
  const local = new Matrix4();
  mesh.getMatrixAt(place, local);
  return local.premultiply(mesh.matrixWorld);
}

export class Names {
  readonly parts: NamedPart[] = [];
  readonly roots: NamedPart[] = [];
  private readonly byName = new Map<NamedPart | null, Map<string, NamedPart>>();
  private readonly rows = new WeakMap<Object3D, Rows>();

  /// Reads what a tile has brought; `matrix` leads from its meshes to the page. True when there are names that were not known.
  add(scene: Object3D, matrix: Matrix4): boolean {
    const before = this.parts.length;
    const tables = new Map<Table, NamedPart[]>();
    scene.updateMatrixWorld(true);
    scene.traverse(o => {
      const {meshFeatures, structuralMetadata, gltfExtensions} = o.userData as UserData, mesh = o as Mesh, ofPlaces = isInstanced(o);
      const feature = (ofPlaces ? gltfExtensions?.EXT_instance_features : meshFeatures)?.featureIds[0];
      const table = structuralMetadata?.tableAccessors[feature?.propertyTable ?? -1];
      // GLTFLoader keeps the case of what belongs to places.
      const ids = mesh.geometry?.getAttribute(`${ofPlaces ? '_FEATURE_ID' : '_feature_id'}_${feature?.attribute}`);
      if (!table || !ids) return;
      let parts = tables.get(table);
      if (!parts) tables.set(table, parts = this.read(table));
      this.rows.set(mesh, {ids: ids as BufferAttribute, parts, ofPlaces});
      this.measure(mesh, matrix);
    });
    return this.parts.length > before;
  }

  /// The part that a vertex of a mesh belongs to; in one of several places, where it has them.
  at(mesh: Object3D, vertex: number, place = 0): NamedPart | null {
    const rows = this.rows.get(mesh);
    return rows?.parts[rows.ids.getX(rows.ofPlaces ? place : vertex)] ?? null;
  }

  /// The part with that path of names.
  find(path: string): NamedPart | null {
    return this.parts.find(part => pathOf(part) === path) ?? null;
  }

  private read(table: Table): NamedPart[] {
    const columns = ['name', 'parent'].map(key => Array.from({length: table.count}, (_, row) => table.getPropertyValue(key, row)));
    const names = columns[0] as string[], parents = columns[1] as number[];
    const parts: NamedPart[] = [];
    const part = (row: number): NamedPart | null => row < table.count ? parts[row] ??= this.part(names[row]!, parents[row]! === row ? null : part(parents[row]!)) : null;
    for (let row = 0; row < table.count; ++row) part(row);
    return parts;
  }

  private part(name: string, parent: NamedPart | null): NamedPart {
    let siblings = this.byName.get(parent);
    if (!siblings) this.byName.set(parent, siblings = new Map());
    const known = siblings.get(name);
    if (known) return known;
    const made: NamedPart = {node: this.parts.length, name, type: '', extras: {}, parent, children: [], triangles: 0, box: new Box3()};
    siblings.set(name, made);
    this.parts.push(made);
    (parent?.children ?? this.roots).push(made);
    return made;
  }

  private measure(mesh: Mesh, toPage: Matrix4): void {
    const positions = mesh.geometry.getAttribute('position'), p = new Vector3(), touched = new Set<NamedPart>();
    for (let place = 0; place < placesOf(mesh); ++place) {
      const matrix = matrixAt(mesh, place).premultiply(toPage);
      for (let i = 0; i < positions.count; ++i) {
        const part = this.at(mesh, i, place);
        if (!part) continue;
        part.box.expandByPoint(p.fromBufferAttribute(positions, i).applyMatrix4(matrix));
        touched.add(part);
      }
    }
    for (const part of touched) for (let above = part.parent; above; above = above.parent) above.box.union(part.box);
  }
}

export function pathOf(part: NamedPart): string {
  return part.parent ? `${pathOf(part.parent)}/${part.name}` : part.name;
}

/// Whether a part is another, or below it.
export function isWithin(part: NamedPart | null, other: NamedPart): boolean {
  for (let p = part; p; p = p.parent) if (p === other) return true;
  return false;
}
