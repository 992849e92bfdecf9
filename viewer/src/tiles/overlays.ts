// What is drawn over the tiles that are shown: their boxes, and the part that is selected.
import {Box3Helper, BoxGeometry, BufferGeometry, Color, EdgesGeometry, Group, LineBasicMaterial, LineSegments, Matrix4, Mesh, type Object3D, type Scene} from 'three';
import {copy, glow, glowEdges, marked} from '../view/overlay';
import {levelOf, type LoadedTile} from './loading';
import {isWithin, matrixAt, placesOf, type NamedPart, type Names} from './names';
import {colorOfLevel} from './tints';

const edges = new EdgesGeometry(new BoxGeometry(2, 2, 2));

/// The box of a tile, from that of two metres around the origin.
function matrixOfBox(tile: LoadedTile): Matrix4 | null {
  const b = tile.boundingVolume.box;
  if (!b) return null;
  const [x, y, z, ...axes] = b as [number, number, number, ...number[]];
  const [a, c, d, e, f, g, h, i, j] = axes as [number, number, number, number, number, number, number, number, number];
  return tile.engineData.transform.clone().multiply(new Matrix4().set(a, e, h, x, c, f, i, y, d, g, j, z, 0, 0, 0, 1));
}

export class TileBoxes {
  private readonly group = marked(new Group());
  on = false;

  constructor(scene: Scene) { scene.add(this.group); }

  show(tiles: readonly LoadedTile[], root: Object3D): void {
    this.group.clear();
    if (!this.on) return;
    this.group.matrixAutoUpdate = false;
    this.group.matrix.copy(root.matrixWorld);
    for (const tile of tiles) {
      const matrix = matrixOfBox(tile);
      if (!matrix) continue;
      const box = marked(new LineSegments(edges, new LineBasicMaterial({color: colorOfLevel(levelOf(tile))})));
      box.matrixAutoUpdate = false;
      box.matrix.copy(matrix);
      this.group.add(box);
    }
  }
}

/// Corners of the triangles of a mesh in a place that belong to a part or to those below it.
function cornersOf(mesh: Mesh, place: number, names: Names, part: NamedPart): number[] {
  const index = mesh.geometry.index, out: number[] = [];
  const n = index ? index.count : mesh.geometry.getAttribute('position').count;
  const at = (i: number): number => index ? index.getX(i) : i;
  for (let i = 0; i + 2 < n; i += 3) if (isWithin(names.at(mesh, at(i), place), part)) out.push(at(i), at(i + 1), at(i + 2));
  return out;
}

export class PartHighlight {
  private readonly group = marked(new Group());
  /// The selected part, in the tiles that are shown.
  triangles = 0;
  tiles = 0;

  constructor(scene: Scene, private readonly names: Names) { scene.add(this.group); }

  show(part: NamedPart | null, tiles: readonly LoadedTile[]): void {
    for (const o of this.group.children) {
      if (o instanceof Box3Helper) o.dispose();
      else (o as Mesh).geometry.dispose();
    }
    this.group.clear();
    this.triangles = this.tiles = 0;
    if (!part) return;
    for (const tile of tiles) this.tiles += this.showIn(tile, part) ? 1 : 0;
    if (!part.box.isEmpty()) this.group.add(marked(new Box3Helper(part.box, new Color(0x2f7bff))));
  }

  private showIn(tile: LoadedTile, part: NamedPart): boolean {
    const before = this.triangles;
    tile.engineData.scene?.traverse(o => {
      const mesh = o as Mesh;
      if (mesh.isMesh) for (let place = 0; place < placesOf(mesh); ++place) this.showAt(mesh, place, part);
    });
    return this.triangles > before;
  }

  private showAt(mesh: Mesh, place: number, part: NamedPart): void {
    const corners = cornersOf(mesh, place, this.names, part);
    if (corners.length === 0) return;
    this.triangles += corners.length / 3;
    const some = new BufferGeometry();
    some.setAttribute('position', mesh.geometry.getAttribute('position'));
    some.setIndex(corners);
    const made = new Mesh(some);
    made.applyMatrix4(matrixAt(mesh, place));
    this.group.add(copy(made, glow), copy(made, glowEdges));
  }
}
