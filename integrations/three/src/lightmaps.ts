// Baked light (MOZ_lightmap, or extras.lightmap of a material): a texture of what arrives at a surface, and maybe three that say from where. Such surfaces are shown without the world's lamps,
// whose light is in the texture already. Every part has its place on a page, which glTF says by a transform in a material of its own; here
// the transform goes into texture coordinates, so that a page is one texture and what it lights can be drawn in one call.
import {BufferAttribute, BufferGeometry, Color, NoColorSpace, SRGBColorSpace, type ColorSpace, type Material, type Mesh, type MeshStandardMaterial, type Texture} from 'three';
import type {GLTF, GLTFParser} from 'three/addons/loaders/GLTFLoader.js';
import {BakedMaterial} from './baked_material.js';
import {DirectedMaterial, type Directions} from './directed_light.js';

const channel = 3;  // of texture coordinates

interface Transform {
  offset?: [number, number];
  rotation?: number;
  scale?: [number, number];
  texCoord?: number;
}

interface LightmapInfo {
  index: number;
  texCoord?: number;
  scale?: number;      // of extras.lightmap
  intensity?: number;  // of MOZ_lightmap: the same
  directions?: [number, number, number];
  extensions?: {KHR_texture_transform?: Transform};
}

/// The light of a material that was baked; null when it has none.
export function lightOf(material: Material): Texture | null {
  return (material as BakedMaterial).lightMap ?? null;
}

/// Geometries with their places on the pages; the rest of them is shared.
class Places {
  private readonly made = new Map<BufferGeometry, Map<string, BufferGeometry>>();

  of(geometry: BufferGeometry, info: LightmapInfo): BufferGeometry {
    const key = JSON.stringify([info.texCoord, info.extensions]);
    let known = this.made.get(geometry);
    if (!known) this.made.set(geometry, known = new Map());
    let placed = known.get(key);
    if (!placed) known.set(key, placed = place(geometry, info));
    return placed;
  }
}

function place(geometry: BufferGeometry, info: LightmapInfo): BufferGeometry {
  const {offset = [0, 0], rotation = 0, scale = [1, 1], texCoord = info.texCoord ?? 0} = info.extensions?.KHR_texture_transform ?? {};
  const from = geometry.getAttribute(texCoord === 0 ? 'uv' : `uv${texCoord}`) as BufferAttribute | undefined;
  const made = new BufferGeometry();
  made.setIndex(geometry.index);
  for (const [name, attribute] of Object.entries(geometry.attributes)) made.setAttribute(name, attribute);
  Object.assign(made.morphAttributes, geometry.morphAttributes);
  made.morphTargetsRelative = geometry.morphTargetsRelative;
  made.boundingBox = geometry.boundingBox;
  made.boundingSphere = geometry.boundingSphere;
  if (!from) return made;
  const out = new Float32Array(2 * from.count), c = Math.cos(rotation), s = Math.sin(rotation);
  for (let i = 0; i < from.count; ++i) {
    const x = from.getX(i) * scale[0], y = from.getY(i) * scale[1];
    out[2 * i] = offset[0] + c * x + s * y;
    out[2 * i + 1] = offset[1] - s * x + c * y;
  }
  return made.setAttribute(`uv${channel}`, new BufferAttribute(out, 2));
}

type Page = (index: number, meaning: ColorSpace) => Promise<Texture | null>;

interface Vrml97 {
  Material?: {specularColor?: [number, number, number]; shininess?: number};
}

async function directions(material: Material, info: LightmapInfo, page: Page): Promise<Directions | null> {
  if (info.directions?.length !== 3) return null;
  const [x, y, z] = await Promise.all(info.directions.map(index => page(index, NoColorSpace)));
  if (!x || !y || !z) return null;
  const {specularColor = [0, 0, 0], shininess = 0.2} = (material.userData['vrml97'] as Vrml97 | undefined)?.Material ?? {};
  return {x, y, z, specular: new Color().setRGB(...specularColor, SRGBColorSpace), shininess};
}

/// The material with its light; `page` gives a texture of a file.
async function baked(material: MeshStandardMaterial, info: LightmapInfo, page: Page): Promise<BakedMaterial> {
  const {name, color, map, transparent, opacity, side, alphaTest, depthWrite, vertexColors, userData, emissive, emissiveIntensity} = material;
  const from = await directions(material, info, page);
  const made = new (from ? DirectedMaterial : BakedMaterial)({name, color, map, transparent, opacity, side, alphaTest, depthWrite, vertexColors});
  if (from) (made as DirectedMaterial).directions = from;
  if (emissive) made.emissive.copy(emissive).multiplyScalar(emissiveIntensity);  // an unlit material has none
  made.userData = userData;
  made.lightMap = await page(info.index, SRGBColorSpace);
  // three.js takes the map for irradiance, of which a white surface reflects 1 / pi.
  made.lightMapIntensity = (info.scale ?? info.intensity ?? 1) * Math.PI;
  return made;
}

function infoOf(material: Material | undefined): LightmapInfo | undefined {
  const {lightmap, gltfExtensions} = material?.userData ?? {};
  return lightmap ?? (gltfExtensions as {MOZ_lightmap?: LightmapInfo} | undefined)?.MOZ_lightmap;
}

/// Gives the materials of a file their baked light.
export async function addBakedLight(gltf: GLTF, parser: GLTFParser): Promise<void> {
  const made = new Map<Material, Promise<BakedMaterial>>(), pages = new Map<number, Promise<Texture | null>>(), places = new Places();
  const page: Page = (index, meaning) => {
    const known = pages.get(index) ?? loadPage(parser, index, meaning);
    pages.set(index, known);
    return known;
  };
  const waiting: Promise<void>[] = [];
  gltf.scene.traverse(o => {
    const mesh = o as Mesh;
    const material = mesh.material as MeshStandardMaterial | undefined;
    const info = infoOf(material);
    if (!material || !info) return;
    if (!made.has(material)) made.set(material, baked(material, info, page));
    mesh.geometry = places.of(mesh.geometry, info);
    waiting.push(made.get(material)!.then(m => { mesh.material = m; }));
  });
  await Promise.all(waiting);
}

async function loadPage(parser: GLTFParser, index: number, meaning: ColorSpace): Promise<Texture | null> {
  const texture = ((await parser.getDependency('texture', index)) as Texture | null)?.clone() ?? null;
  if (!texture) return null;
  texture.channel = channel;
  texture.colorSpace = meaning;
  return texture;
}
