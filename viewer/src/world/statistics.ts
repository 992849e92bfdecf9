// Where the bytes and the triangles of a file are.
import type {BufferAttribute, Material, Mesh, MeshStandardMaterial, Texture} from 'three';
import type {DirectedMaterial} from 'wrlkit-three';
import {accessorBytes, accessorsOf, type GltfFile} from './file';
import {labelOf, type Part, type World} from './world';

export interface Kind {
  name: string;
  bytes: number;
}

/// Bytes of the file by kind, the largest first.
export function bytesByKind(world: World): Kind[] {
  const file = world.file, kinds = new Map<string, number>();
  const add = (name: string, n: number): void => { if (n > 0) kinds.set(name, (kinds.get(name) ?? 0) + n); };
  const seen = new Set<number>();
  const addAccessor = (index: number, name: string): void => {
    if (!seen.has(index)) add(name, accessorBytes(file, index));
    seen.add(index);
  };
  for (let mesh = 0; mesh < (file.meshes?.length ?? 0); ++mesh) for (const [index, name] of accessorsOf(file, mesh)) addAccessor(index, name);
  for (const animation of file.animations ?? []) for (const s of animation.samplers) addAccessor(s.input, 'animations'), addAccessor(s.output, 'animations');
  for (const image of file.images ?? []) add('pictures', file.bufferViews?.[image.bufferView ?? -1]?.byteLength ?? 0);
  const known = [...kinds.values()].reduce((n, bytes) => n + bytes, 0);
  add('names, tree and extras', world.size - known);
  return [...kinds].map(([name, bytes]) => ({name, bytes})).sort((a, b) => b.bytes - a.bytes);
}

export interface Heavy {
  part: Part;      // the first that shows the mesh
  label: string;
  places: number;  // how many parts show it
  triangles: number;
  bytes: number;
}

/// The meshes with the most triangles, each once.
export function heaviest(world: World, most: number): Heavy[] {
  const found = new Map<number, Heavy>();
  for (const part of world.parts) {
    if (part.mesh === null) continue;
    const known = found.get(part.mesh);
    if (known) ++known.places;
    else found.set(part.mesh, {part, label: labelOf(part), places: 1, triangles: part.triangles - below(part), bytes: meshBytes(world.file, part.mesh)});
  }
  return [...found.values()].sort((a, b) => b.triangles - a.triangles || b.bytes - a.bytes).slice(0, most);
}

const below = (part: Part): number => part.children.reduce((n, p) => n + p.triangles, 0);

function meshBytes(file: GltfFile, mesh: number): number {
  return [...accessorsOf(file, mesh).keys()].reduce((n, a) => n + accessorBytes(file, a), 0);
}

/// Bytes that the graphics card needs for geometry and textures, each once and unpacked; textures with their smaller copies.
export function unpackedBytes(world: World): number {
  const sizes = new Map<unknown, number>();
  world.root.traverse(o => {
    const {geometry, material} = o as Mesh;
    if (!geometry) return;
    for (const a of [...Object.values(geometry.attributes), geometry.index]) if (a) sizes.set((a as BufferAttribute).array, (a as BufferAttribute).array.byteLength);
    for (const t of texturesOf(material as Material)) {
      const image = t.image as {width?: number; height?: number} | undefined;
      if (image?.width && image.height) sizes.set(t.source, image.width * image.height * 4 * 4 / 3);
    }
  });
  return [...sizes.values()].reduce((n, bytes) => n + bytes, 0);
}

function texturesOf(material: Material): Texture[] {
  const {map, emissiveMap, normalMap, aoMap, lightMap, roughnessMap, metalnessMap} = material as MeshStandardMaterial;
  const {x, y, z} = (material as DirectedMaterial).directions ?? {};
  return [map, emissiveMap, normalMap, aoMap, lightMap, roughnessMap, metalnessMap, x, y, z].filter(t => t instanceof Object) as Texture[];
}
