// The collapses of a world by one criterion, as one sequence: of all surfaces the one goes next whose error stays smallest. So a
// world of one surface collapses in the order of its criterion.
import {Box3, BufferGeometry, Color, DoubleSide, Group, Mesh, MeshBasicMaterial, MeshLambertMaterial, Matrix4, Scene, Vector3, Vector4, type PerspectiveCamera} from 'three';
import type {Surface} from './file';
import {edgeOf, type Edge} from './cost';
import type {Refinement} from './refine';
import {Stepper} from './stepper';

export type Shading = 'greys' | 'shaded';

/// Where a run shows more detail than its clock says: nowhere; in a lens, a circle in the picture; near the eye, and less far away.
export type Detail = {kind: 'even'} | {kind: 'lens'; x: number; y: number; radius: number} | {kind: 'near'; distance: number};

const greyMaterial = new MeshBasicMaterial({vertexColors: true, side: DoubleSide});

export class Run {
  readonly scene = new Scene();
  readonly root = new Group();
  readonly box = new Box3();
  readonly faces: Uint32Array;          // of the world, after that many collapses
  at = 0;                               // collapses done
  private readonly steppers: Stepper[];
  private readonly order: Uint32Array;  // the surface of each collapse
  private readonly meshes: {mesh: Mesh; color: Color; surface: number}[] = [];
  private readonly refined: (Refinement | undefined)[] = [];

  constructor(readonly criterion: string, private readonly surfaces: Surface[]) {
    this.steppers = surfaces.map(s => new Stepper(s.record, centerOf(s)));
    surfaces.forEach((s, i) => this.place(s, i));
    this.scene.add(this.root);
    this.order = orderOf(surfaces);
    this.faces = this.countFaces();
  }

  get steps(): number { return this.order.length; }
  get count(): number { return this.faces[this.at]!; }
  /// The largest of all surfaces, from the original, in metres.
  get error(): number { return this.steppers.reduce((most, s, i) => Math.max(most, s.error * this.surfaces[i]!.scale), 0); }

  goTo(step: number): void {
    const to = Math.max(0, Math.min(this.steps, step));
    for (; this.at < to; ++this.at) this.steppers[this.order[this.at]!]!.collapse();
    for (; this.at > to; --this.at) this.steppers[this.order[this.at - 1]!]!.split();
  }

  /// The first state that has at most that many faces, or the last.
  stepOf(faces: number): number {
    let low = 0, high = this.steps;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.faces[middle]! <= faces) high = middle;
      else low = middle + 1;
    }
    return low;
  }

  /// The edge that goes next, in the world; null at the end.
  next(): (Edge & {surface: string}) | null {
    const i = this.order[this.at];
    if (i === undefined) return null;
    const stepper = this.steppers[i]!, surface = this.surfaces[i]!, place = surface.places[0]!;
    const edge = edgeOf(surface.record, stepper.done - 1, stepper.positions, stepper.corners);
    for (const p of [edge.from, edge.to, edge.result]) p.applyMatrix4(place);
    const {scale} = surface;
    return {...edge, surface: surface.name, length: edge.length * scale, lengthNormal: edge.lengthNormal * scale, melax: edge.melax * scale, planes: edge.planes * scale ** 4};
  }

  flush(): void { for (const s of this.steppers) s.flush(); }

  /// Draws with more detail where it is wanted, for this camera; the number of faces that are drawn.
  refine(detail: Detail, camera: PerspectiveCamera): number {
    for (const {mesh, surface} of this.meshes) mesh.geometry = detail.kind === 'even' ? this.steppers[surface]!.geometry : this.refinementOf(surface).geometry;
    if (detail.kind === 'even') return this.count;
    const view = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    this.surfaces.forEach((surface, i) => {
      const refinement = this.refinementOf(i), done = this.steppers[i]!.done, error = this.steppers[i]!.error * surface.scale;
      const placed = this.meshes.filter(m => m.surface === i).map(m => new Matrix4().multiplyMatrices(view, m.mesh.matrix));
      const seen = new Vector4();
      /// Whether a test holds at one of the places, of where a node is in the picture and how far around it its ball reaches.
      const isNear = (node: number, test: (p: Vector4, reach: number) => boolean): boolean =>
        placed.some(m => test(seen.set(refinement.places[3 * node]!, refinement.places[3 * node + 1]!, refinement.places[3 * node + 2]!, 1).applyMatrix4(m), refinement.radius[node]! * surface.scale));
      if (detail.kind === 'lens') {
        const {x, y, radius} = detail, zoom = camera.projectionMatrix.elements[5]!;
        const inside = (p: Vector4, reach: number): boolean => p.w > 0 && Math.hypot((p.x / p.w - x) * camera.aspect, p.y / p.w - y) < radius + reach * zoom / p.w;
        refinement.update((split, node) => split < done || isNear(node, inside));
      } else {
        // At the pivot a split is wanted when the clock has it; its error may be as much larger as it is farther away.
        const before = (split: number): number => (split > 0 ? surface.record.error[split - 1]! : surface.record.baseError) * surface.scale;
        refinement.update((split, node) => isNear(node, (p, reach) => before(split) * detail.distance > error * Math.max(p.w - reach, 0)));
      }
    });
    return this.surfaces.reduce((n, s, i) => n + this.refinementOf(i).faces * s.places.length, 0);
  }

  private refinementOf(surface: number): Refinement {
    return this.refined[surface] ??= this.steppers[surface]!.refinement();
  }

  shade(shading: Shading): void {
    for (const {mesh, color} of this.meshes) mesh.material = shading === 'greys' ? greyMaterial : new MeshLambertMaterial({color, side: DoubleSide, flatShading: true});
  }

  /// Positions of the corners of all faces that are there, in the world: what the picture shows.
  shown(): Float64Array {
    const out: number[] = [], p = new Vector3();
    this.surfaces.forEach((surface, i) => {
      const {corners, positions, faces} = this.steppers[i]!;
      for (const place of surface.places) for (const c of corners.subarray(0, 3 * faces)) out.push(...p.fromArray(positions, 3 * c).applyMatrix4(place).toArray());
    });
    return Float64Array.from(out);
  }

  private place(surface: Surface, index: number): void {
    const stepper = this.steppers[index]!;
    const color = new Color().setRGB(...surface.color.map(c => c / 255) as [number, number, number], 'srgb');
    const center = centerOf(surface);
    for (const place of surface.places) {
      const mesh = new Mesh<BufferGeometry>(stepper.geometry, greyMaterial);
      mesh.matrixAutoUpdate = false;
      mesh.matrix.copy(place).multiply(translation(center));
      this.root.add(mesh);
      this.meshes.push({mesh, color, surface: index});
    }
    this.root.updateMatrixWorld(true);
    for (const mesh of this.root.children.slice(-surface.places.length)) this.box.expandByObject(mesh);
  }

  private countFaces(): Uint32Array {
    const faces = new Uint32Array(this.steps + 1);
    const done = this.surfaces.map(s => s.record.splits);
    faces[0] = this.surfaces.reduce((n, s) => n + s.record.faces * s.places.length, 0);
    this.order.forEach((surface, k) => {
      const {record, places} = this.surfaces[surface]!, i = --done[surface]!;
      faces[k + 1] = faces[k]! - (record.faceEnd[i]! - (i > 0 ? record.faceEnd[i - 1]! : record.baseFaces)) * places.length;
    });
    return faces;
  }
}

function centerOf(surface: Surface): Vector3 {
  const p = surface.record.positions, box = new Box3();
  for (let i = 0; i + 2 < p.length; i += 3) box.expandByPoint(new Vector3(p[i], p[i + 1], p[i + 2]));
  return box.isEmpty() ? new Vector3() : box.getCenter(new Vector3());
}

const translation = (by: Vector3): Matrix4 => new Matrix4().makeTranslation(by);

/// Surfaces by the error that their next collapse leaves; it never falls within a surface, so a stable sort keeps their order.
function orderOf(surfaces: Surface[]): Uint32Array {
  const steps = surfaces.reduce((n, s) => n + s.record.splits, 0);
  const owner = new Uint32Array(steps), error = new Float64Array(steps);
  let at = 0;
  surfaces.forEach(({record, scale}, s) => {
    for (let i = record.splits - 1; i >= 0; --i, ++at) {
      owner[at] = s;
      error[at] = (i > 0 ? record.error[i - 1]! : record.baseError) * scale;
    }
  });
  if (surfaces.length === 1) return owner;
  const index = Array.from({length: steps}, (_, i) => i).sort((a, b) => error[a]! - error[b]! || a - b);
  return Uint32Array.from(index, i => owner[i]!);
}
