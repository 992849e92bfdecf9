// Baked light (MOZ_lightmap): a texture of what arrives at a surface. Such surfaces are shown without the world's lamps,
// whose light is in the texture already.
import {MeshBasicMaterial, SRGBColorSpace, type Material, type Mesh, type MeshStandardMaterial, type Texture} from 'three';
import type {GLTF} from 'three/addons/loaders/GLTFLoader.js';

interface LightmapInfo {
  index: number;
  texCoord?: number;
  intensity?: number;
}

/// The light of a material that was baked; undefined when it has none.
export function lightOf(material: Material): Texture | null {
  return (material as MeshBasicMaterial).lightMap ?? null;
}

async function baked(gltf: GLTF, material: MeshStandardMaterial, info: LightmapInfo): Promise<MeshBasicMaterial> {
  const {name, color, map, transparent, opacity, side, alphaTest, vertexColors, userData} = material;
  const made = new MeshBasicMaterial({name, color, map, transparent, opacity, side, alphaTest, vertexColors});
  made.userData = userData;
  const transform = (info as {extensions?: unknown}).extensions;
  const definition = {index: info.index, texCoord: info.texCoord ?? 0, ...(transform ? {extensions: transform} : {})};
  await gltf.parser.assignTexture(made as unknown as Material, 'lightMap', definition as never, SRGBColorSpace);
  // three.js takes the map for irradiance, of which a white surface reflects 1 / pi.
  made.lightMapIntensity = (info.intensity ?? 1) * Math.PI;
  return made;
}

/// Gives the materials of a file their baked light.
export async function bakedLight(gltf: GLTF): Promise<void> {
  const made = new Map<Material, Promise<MeshBasicMaterial>>();
  const waiting: Promise<void>[] = [];
  gltf.scene.traverse(o => {
    const mesh = o as Mesh;
    const material = mesh.material as MeshStandardMaterial | undefined;
    const info = material?.userData['gltfExtensions']?.['MOZ_lightmap'] as LightmapInfo | undefined;
    if (!material || !info) return;
    if (!made.has(material)) made.set(material, baked(gltf, material, info));
    waiting.push(made.get(material)!.then(m => { mesh.material = m; }));
  });
  await Promise.all(waiting);
}
