// What the page reads of a glTF file itself, in addition to what three.js makes of it: names, types, sizes.

export interface Accessor {
  bufferView?: number;
  componentType: number;
  count: number;
  type: string;
}

export interface Primitive {
  attributes: Record<string, number>;
  indices?: number;
  material?: number;
  mode?: number;
}

export interface FileNode {
  name?: string;
  mesh?: number;
  camera?: number;
  children?: number[];
  extensions?: Record<string, unknown> & {MSFT_lod?: {ids: number[]}};
  extras?: Record<string, unknown>;
}

export interface GltfFile {
  nodes?: FileNode[];
  meshes?: {name?: string; primitives: Primitive[]; extras?: Record<string, unknown>}[];
  materials?: {name?: string; extensions?: Record<string, unknown>; extras?: Record<string, unknown>}[];
  accessors?: Accessor[];
  bufferViews?: {byteLength: number}[];
  images?: {name?: string; bufferView?: number; mimeType?: string}[];
  animations?: {name?: string; samplers: {input: number; output: number}[]}[];
  extensions?: Record<string, unknown>;
  scenes?: {nodes?: number[]; extras?: Record<string, unknown>}[];
}

/// What wrlkit keeps of VRML next to a part of glTF: {Transform: {...}, DEF: ...}.
export function vrmlOf(extras: Record<string, unknown> | undefined): Record<string, unknown> {
  const vrml = extras?.['vrml97'];
  return vrml && typeof vrml === 'object' ? vrml as Record<string, unknown> : {};
}

/// The type of the VRML node, or of the form of our own, that extras tell of.
export function typeOf(extras: Record<string, unknown> | undefined): string | undefined {
  return Object.keys({...vrmlOf(extras), ...extras?.['wrlkit'] as object}).find(key => /^[A-Z]/.test(key) && key !== 'DEF' && key !== 'USE');
}

const components: Record<string, number> = {SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16};

export function accessorBytes(file: GltfFile, index: number): number {
  const a = file.accessors?.[index];
  if (!a) return 0;
  const size = a.componentType <= 5121 ? 1 : a.componentType <= 5123 ? 2 : 4;
  return a.count * size * (components[a.type] ?? 1);
}

const kindOfAttribute = (name: string): string =>
  name === 'POSITION' ? 'positions' : name === 'NORMAL' ? 'normals' : name.startsWith('TEXCOORD') ? 'texture coordinates' : name.startsWith('COLOR') ? 'colours' : 'other';

/// Accessors of a mesh, each once, with what they are.
export function accessorsOf(file: GltfFile, mesh: number): Map<number, string> {
  const found = new Map<number, string>();
  for (const p of file.meshes?.[mesh]?.primitives ?? []) {
    for (const [name, accessor] of Object.entries(p.attributes)) found.set(accessor, kindOfAttribute(name));
    if (p.indices !== undefined) found.set(p.indices, 'indices');
  }
  return found;
}

/// Triangles of a mesh, once.
export function trianglesOf(file: GltfFile, mesh: number): number {
  let n = 0;
  for (const p of file.meshes?.[mesh]?.primitives ?? []) {
    const corners = file.accessors?.[p.indices ?? p.attributes['POSITION'] ?? -1]?.count ?? 0;
    const mode = p.mode ?? 4;
    n += mode === 4 ? Math.floor(corners / 3) : mode > 4 ? Math.max(0, corners - 2) : 0;
  }
  return n;
}
