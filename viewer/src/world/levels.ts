// Levels of detail (MSFT_lod): which of them is shown, by distance as the file says, or one for all.
import {fieldOfView} from 'wrlkit-three';
import {MathUtils, MeshLambertMaterial, type Box3, type Mesh, type Object3D, type PerspectiveCamera} from 'three';
import type {Looks} from './looks';
import {isHidden, type Levels, type World} from './world';

const tangent = Math.tan(MathUtils.degToRad(fieldOfView) / 2);
/// Height of the screen for which `wrlkit` chooses the ranges of levels: a level begins where it is wrong by a pixel of it.
export const screen = 1080;

export const levelColors = ['#4c78a8', '#59a14f', '#edc948', '#f28e2b', '#e15759', '#b07aa1', '#9c755f', '#7f7f7f'] as const;

export interface LevelFigures {
  shown: number[];      // how many objects show each level
  triangles: number[];  // of each level, as shown
  pixels: number;       // error that is seen at most, from the distances where levels begin
}

export class LevelControl {
  readonly most: number;              // levels of the object that has the most
  fixed: number | null = null;        // null: by distance
  figures: LevelFigures = {shown: [], triangles: [], pixels: 0};
  private readonly at: number[];      // the level of each object
  private readonly tints = levelColors.map(color => new MeshLambertMaterial({color}));

  constructor(private readonly world: World) {
    this.most = Math.max(...world.levels.map(l => l.levels.length));
    this.at = world.levels.map(() => 0);
  }

  /// Before each picture; the boxes of objects that have changed.
  update(camera: PerspectiveCamera, height: number): Box3[] {
    const switched: Box3[] = [];
    const figures: LevelFigures = {shown: Array<number>(this.most).fill(0), triangles: Array<number>(this.most).fill(0), pixels: 0};
    this.world.levels.forEach((l, i) => {
      const distance = l.distanceTo(camera.position);
      const level = this.fixed === null ? l.levelAt(distance) : Math.min(this.fixed, l.levels.length - 1);
      if (level !== this.at[i]) switched.push(l.box);
      this.at[i] = level;
      const hidden = isHidden(l.part.object, 'user') || isHidden(l.part.object, 'world');
      l.levels.forEach((o, k) => { o.visible = k === level && !hidden; });
      ++figures.shown[level]!;
      figures.triangles[level]! += l.triangles[level]!;
      figures.pixels = Math.max(figures.pixels, pixelError(l, level, distance) * height / screen * tangent / Math.tan(MathUtils.degToRad(camera.fov) / 2));
    });
    this.figures = figures;
    return switched;
  }

  /// Each level in a colour of its own.
  tint(looks: Looks): void {
    looks.apply(this.world.root, 'grey');
    for (const l of this.world.levels) l.levels.forEach((o, k) => paint(o, this.tints[k % this.tints.length]!));
  }
}

/// At the near side of the ball, a level is as wrong as one pixel where it begins.
function pixelError(l: Levels, level: number, distance: number): number {
  const radius = l.radius;
  const begins = level > 0 ? l.switchDistance(level - 1) : 0;
  if (begins === 0) return 0;
  return distance > radius ? Math.max(0, begins - radius) / (distance - radius) : Infinity;
}

function paint(root: Object3D, material: MeshLambertMaterial): void {
  root.traverse(o => { if ((o as Mesh).isMesh) (o as Mesh).material = material; });
}
