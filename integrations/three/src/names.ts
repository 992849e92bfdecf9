// Names of parts that are not objects: rows of a property table (EXT_structural_metadata) that the vertices of a mesh (EXT_mesh_features) or the
// places of an InstancedMesh (EXT_instance_features) refer to.
import type {BufferAttribute, InstancedMesh, Intersection, Mesh, Object3D} from 'three';
import type {GLTF, GLTFParser} from 'three/addons/loaders/GLTFLoader.js';

type Value = string | number | null;  // null: nothing is said

export interface NamedPart {
  name: string;                 // empty: it has none
  path: string[];               // names of the groups around it, the outermost first, and its own
  row: Record<string, Value>;   // of the table; empty where names are those of objects
}

interface Property {
  type: string;
  componentType?: string;
  array?: boolean;
  semantic?: string;
  noData?: Value;
  default?: Value;
}

interface Column {
  values: number;
  stringOffsets?: number;
  stringOffsetType?: string;
}

interface Metadata {
  schema?: {classes?: Record<string, {properties?: Record<string, Property>}>};
  propertyTables?: {class: string; count: number; properties?: Record<string, Column>}[];
}

interface FeatureIds {
  featureIds?: {attribute?: number; nullFeatureId?: number; propertyTable?: number}[];
}

type Table = Record<string, Value>[];

const tables = new WeakMap<Object3D, Table[]>();  // by scene

const arrays = {
  INT8: Int8Array, UINT8: Uint8Array, INT16: Int16Array, UINT16: Uint16Array, INT32: Int32Array, UINT32: Uint32Array,
  FLOAT32: Float32Array, FLOAT64: Float64Array,
} as const;

/// Reads the tables of a file, so that `nameAt` knows its parts.
export async function readNames(gltf: GLTF, parser: GLTFParser): Promise<void> {
  const metadata = (parser.json as {extensions?: {EXT_structural_metadata?: Metadata}}).extensions?.EXT_structural_metadata;
  const found = await Promise.all((metadata?.propertyTables ?? []).map(async ({class: name, count, properties = {}}) => {
    const rows: Table = Array.from({length: count}, () => ({}));
    for (const [key, column] of Object.entries(properties)) {
      const property = metadata?.schema?.classes?.[name]?.properties?.[key];
      const values = property ? await read(parser, property, column, count) : null;
      values?.forEach((value, i) => { rows[i]![key] = value === property!.noData ? property!.default ?? null : value; });
      if (values && property!.semantic === 'NAME' && key !== 'name') values.forEach((value, i) => { rows[i]!['name'] ??= value; });
    }
    return rows;
  }));
  for (const scene of gltf.scenes) tables.set(scene, found);
}

/// Texts and single numbers; null for other columns.
async function read(parser: GLTFParser, property: Property, column: Column, count: number): Promise<Value[] | null> {
  if (property.array) return null;
  const bytes = (view: number): Promise<ArrayBuffer> => parser.getDependency('bufferView', view) as Promise<ArrayBuffer>;
  if (property.type === 'STRING') {
    const offsets = numbers(await bytes(column.stringOffsets ?? -1), column.stringOffsetType ?? 'UINT32', count + 1);
    const text = new Uint8Array(await bytes(column.values)), decoder = new TextDecoder();
    return offsets && Array.from({length: count}, (_, i) => decoder.decode(text.subarray(offsets[i], offsets[i + 1])));
  }
  return property.type === 'SCALAR' ? numbers(await bytes(column.values), property.componentType ?? '', count) : null;
}

function numbers(bytes: ArrayBuffer, type: string, count: number): number[] | null {
  const Kind = arrays[type as keyof typeof arrays];
  return Kind ? Array.from(new Kind(bytes, 0, count)) : null;
}

/// The part that a ray has hit: a row of a table where the file has one, otherwise the nearest object with a name.
export function partAt(hit: Intersection): NamedPart {
  const above = namesAbove(hit.object), rows = rowsAt(hit);
  const path = [...above, ...rows.map(row => String(row['name'] ?? '')).filter(name => name !== '')];
  return {name: path.at(-1) ?? '', path, row: rows.at(-1) ?? {}};
}

/// The name of the part that a ray has hit; empty when it has none.
export function nameAt(hit: Intersection): string {
  return partAt(hit).name;
}

/// GLTFLoader keeps the name of the file in userData.
function namesAbove(object: Object3D): string[] {
  const names: string[] = [];
  for (let o: Object3D | null = object; o && !tables.has(o); o = o.parent) {
    const name = o.userData['name'] as string | undefined;
    if (name) names.unshift(name);
  }
  return names;
}

/// The row of the part and those of the groups that it is in, the outermost first.
function rowsAt(hit: Intersection): Table {
  const feature = featureAt(hit);
  let root: Object3D | null = hit.object;
  while (root && !tables.has(root)) root = root.parent;
  const table = root && feature ? tables.get(root)?.[feature.table] : undefined;
  const rows: Table = [];
  for (let row = feature && table?.[feature.id]; row && rows.length < 1000; row = table?.[row['parent'] as number]) rows.unshift(row);
  return rows;
}

function featureAt(hit: Intersection): {table: number; id: number} | null {
  const mesh = hit.object as Mesh;
  const said = (o: Object3D | null, name: string) => ((o?.userData['gltfExtensions'] as Record<string, FeatureIds> | undefined)?.[name])?.featureIds?.[0];
  const placed = said(mesh, 'EXT_instance_features') ?? ((mesh as InstancedMesh).isInstancedMesh ? said(mesh.parent, 'EXT_instance_features') : undefined);
  const [ids, at] = placed && hit.instanceId !== undefined ? [placed, hit.instanceId] : [said(mesh, 'EXT_mesh_features'), hit.face?.a ?? hit.index];
  if (!ids || ids.attribute === undefined || ids.propertyTable === undefined || at === undefined) return null;
  const attributes = mesh.geometry.attributes, key = `_FEATURE_ID_${ids.attribute}`;
  const values = (attributes[key] ?? attributes[key.toLowerCase()]) as BufferAttribute | undefined;
  const id = values?.getX(at);
  return id === undefined || id === ids.nullFeatureId ? null : {table: ids.propertyTable, id};
}
