// Tiles in colours of their own: by level, or each tile in another one.
import {Color, MeshLambertMaterial, type Material, type Mesh, type Object3D} from 'three';
import {levelColors} from '../world/levels';
import {levelOf, type LoadedTile} from './loading';

export type Tint = 'none' | 'level' | 'tile';

export const colorOfLevel = (level: number): string => levelColors[level % levelColors.length]!;

export class Tints {
  private readonly originals = new WeakMap<Mesh, Material | Material[]>();
  private readonly ofTiles = new WeakMap<LoadedTile, MeshLambertMaterial>();
  private readonly ofLevels = levelColors.map(color => new MeshLambertMaterial({color}));
  private made = 0;

  apply(tile: LoadedTile, scene: Object3D, tint: Tint): void {
    const material = tint === 'none' ? null : tint === 'level' ? this.ofLevels[levelOf(tile) % this.ofLevels.length]! : this.ofTile(tile);
    scene.traverse(o => {
      const mesh = o as Mesh;
      if (!mesh.isMesh) return;
      const original = this.originals.get(mesh) ?? mesh.material;
      this.originals.set(mesh, original);
      mesh.material = material ?? original;
    });
  }

  /// Hues far apart for tiles that come one after the other.
  private ofTile(tile: LoadedTile): MeshLambertMaterial {
    let material = this.ofTiles.get(tile);
    if (!material) this.ofTiles.set(tile, material = new MeshLambertMaterial({color: new Color().setHSL(this.made++ * 0.618034 % 1, 0.55, 0.6)}));
    return material;
  }
}
