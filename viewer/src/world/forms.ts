// What the pass `recognise` found: parts that are cylinders, boxes, elbows, known from the extras of their meshes.
import {Color, DoubleSide, MeshLambertMaterial, type Mesh} from 'three';
import {vrmlOf, type GltfFile} from './file';
import type {Looks} from './looks';
import type {World} from './world';

/// By the node that a mesh was made of.
const kinds: Record<string, string> = {
  Box: 'box', BoxForm: 'box', Cylinder: 'cylinder', CylinderForm: 'cylinder', Cone: 'cone', FrustumForm: 'cone', Extrusion: 'prism', PrismForm: 'prism',
  PyramidForm: 'pyramid', RingForm: 'ring', Sphere: 'sphere', SphereForm: 'sphere', DishForm: 'dish', TorusForm: 'elbow', RectangularTorusForm: 'bent bar',
};

const kindColors: Record<string, string> = {
  cylinder: '#4c78a8', elbow: '#f28e2b', box: '#59a14f', prism: '#edc948', ring: '#b07aa1', dish: '#e15759', sphere: '#ff9da7', cone: '#76b7b2',
  pyramid: '#9c755f', 'bent bar': '#d37295',
};
export const otherColor = '#9ea3ab';  // faces that are not part of a form

export interface Form {
  kind: string;
  sizes: Record<string, unknown>;
}

export function formOf(file: GltfFile, mesh: number | null): Form | null {
  const extras = mesh === null ? undefined : file.meshes?.[mesh]?.extras;
  for (const said of [extras?.['wrlkit'], vrmlOf(extras)])
    for (const [type, sizes] of Object.entries(said ?? {})) {
      const kind = kinds[type];
      if (kind) return {kind, sizes: sizes as Record<string, unknown>};
    }
  return null;
}

export class Forms {
  readonly colors = new Map<Mesh, Color>();
  readonly legend: {kind: string; color: string; parts: number}[];
  readonly others: number;  // parts with faces that are not part of a form
  private readonly materials = new Map<Color, MeshLambertMaterial>();

  constructor(world: World) {
    const counts = new Map<string, number>(), palette = new Map<string, Color>();
    let others = 0;
    for (const part of world.parts) {
      const surfaces = part.meshes.filter(mesh => mesh.isMesh);
      if (surfaces.length === 0) continue;
      const kind = formOf(world.file, part.mesh)?.kind;
      if (!kind) {
        ++others;
        continue;
      }
      counts.set(kind, (counts.get(kind) ?? 0) + 1);
      const color = palette.get(kind) ?? new Color(kindColors[kind]);
      palette.set(kind, color);
      for (const mesh of surfaces) this.colors.set(mesh, color);
    }
    this.others = others;
    this.legend = [...counts].sort((a, b) => b[1] - a[1]).map(([kind, parts]) => ({kind, color: kindColors[kind]!, parts}));
  }

  /// Each kind in a colour of its own.
  tint(world: World, looks: Looks): void {
    looks.apply(world.root, 'form');
    for (const [mesh, color] of this.colors) {
      let material = this.materials.get(color);
      if (!material) this.materials.set(color, material = new MeshLambertMaterial({color, side: DoubleSide}));
      mesh.material = material;
    }
  }
}
