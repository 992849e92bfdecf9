// How surfaces are shown: as the file says, or so that something else than their colour is seen. Every material has a
// variant of each look, made when it is needed.
import {Color, DoubleSide, MeshBasicMaterial, MeshLambertMaterial, type Material, type Mesh, type MeshStandardMaterial, type Object3D} from 'three';
import {lightOf} from 'wrlkit-three';
import {checkered, densities} from './texels';

export type Look = 'full' | 'albedo' | 'light' | 'grey' | 'flat' | 'checker' | 'density' | 'form';

/// Of baked light, and of its texels: only for worlds that have it.
export const lightLooks = ['light', 'checker', 'density'] as const;

const paper = new Color(0.62, 0.64, 0.67);

function albedo(m: MeshStandardMaterial): Material {
  const {color, map, transparent, opacity, side, alphaTest, vertexColors, emissive, emissiveMap} = m;
  const glows = emissive !== undefined && color.getHex() === 0 && emissive.getHex() !== 0;
  return new MeshBasicMaterial({color: glows ? emissive : color, map: glows ? emissiveMap : map, transparent, opacity, side, alphaTest, vertexColors});
}

function make(m: Material, look: Look): Material {
  if (!m.type.startsWith('Mesh')) return m;  // lines and points look as they are, always
  const light = lightOf(m);
  switch (look) {
    case 'full': return m;
    case 'albedo': return albedo(m as MeshStandardMaterial);
    case 'light': return light ? new MeshBasicMaterial({lightMap: light, lightMapIntensity: (m as MeshBasicMaterial).lightMapIntensity, side: m.side}) : new MeshBasicMaterial({color: 0x000000, side: m.side});
    case 'checker': return light ? checkered(light, m.side) : new MeshLambertMaterial({color: paper, side: m.side});
    case 'density': return light ? densities(light, m.side) : new MeshLambertMaterial({color: paper, side: m.side});
    case 'flat': return new MeshBasicMaterial({color: paper, side: DoubleSide});
    case 'grey':
    case 'form': return new MeshLambertMaterial({color: paper, side: DoubleSide});
  }
}

export class Looks {
  private readonly variants = new Map<string, Material>();
  private readonly originals = new Map<Mesh, Material>();

  /// Makes all meshes below look so.
  apply(root: Object3D, look: Look): void {
    root.traverse(o => {
      const mesh = o as Mesh;
      if (!mesh.isMesh || mesh.userData['overlay']) return;
      if (!this.originals.has(mesh)) this.originals.set(mesh, mesh.material as Material);
      mesh.material = this.variant(this.originals.get(mesh)!, look);
    });
  }

  /// What the file says.
  original(mesh: Mesh): Material { return this.originals.get(mesh) ?? mesh.material as Material; }

  variant(m: Material, look: Look): Material {
    const key = `${m.uuid} ${look}`;
    let made = this.variants.get(key);
    if (!made) this.variants.set(key, made = make(m, look));
    return made;
  }
}
