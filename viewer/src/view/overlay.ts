// What is drawn over a world: edges with hidden lines removed, the selected part, bounding boxes.
import {Box3, Box3Helper, Color, Group, Mesh, MeshBasicMaterial, Object3D, type Material, type PerspectiveCamera, type Scene, type WebGLRenderer} from 'three';
import {boxOf, meshesBelow, type Part, type World} from '../world/world';

/// Drawn in front of surfaces at the same place: a little nearer to the eye on the same ray.
function nearer<T extends Material>(material: T): T {
  material.onBeforeCompile = shader => {
    shader.vertexShader = shader.vertexShader.replace('#include <project_vertex>', '#include <project_vertex>\nvec4 nearer = projectionMatrix * vec4(mvPosition.xyz * 0.998, 1.0);\ngl_Position.z = nearer.z / nearer.w * gl_Position.w;');
  };
  return material;
}

const edgeMaterial = nearer(new MeshBasicMaterial({wireframe: true, color: 0x14181d, transparent: true, opacity: 0.4}));
export const glow = nearer(new MeshBasicMaterial({color: 0x2f7bff, transparent: true, opacity: 0.28, depthWrite: false}));
export const glowEdges = nearer(new MeshBasicMaterial({color: 0x1e62e0, wireframe: true, transparent: true, opacity: 0.5}));

/// Over the picture of a scene.
export function drawEdges(renderer: WebGLRenderer, scene: Scene, camera: PerspectiveCamera): void {
  const {background} = scene;
  scene.overrideMaterial = edgeMaterial;
  scene.background = null;
  renderer.autoClearColor = renderer.autoClearDepth = false;
  renderer.render(scene, camera);
  renderer.autoClearColor = renderer.autoClearDepth = true;
  scene.background = background;
  scene.overrideMaterial = null;
}

export function marked<T extends Object3D>(o: T): T {
  o.userData['overlay'] = true;
  return o;
}

/// A copy of a mesh where it is, in another material.
export function copy(mesh: Mesh, material: Material): Mesh {
  const made = marked(new Mesh(mesh.geometry, material));
  made.matrixAutoUpdate = false;
  mesh.updateWorldMatrix(true, false);
  made.matrix.copy(mesh.matrixWorld);
  return made;
}

const most = 2000;  // meshes whose copies are drawn; of larger assemblies only the box is

export class Highlight {
  private readonly group = marked(new Group());

  constructor(scene: Scene) { scene.add(this.group); }

  show(part: Part | null): void {
    for (const o of this.group.children) if (o instanceof Box3Helper) o.dispose();
    this.group.clear();
    if (!part) return;
    const meshes = meshesBelow(part);
    if (meshes.length <= most) for (const mesh of meshes) if (mesh.isMesh) this.group.add(copy(mesh, glow), copy(mesh, glowEdges));
    const box = boxOf(part);
    if (!box.isEmpty()) this.group.add(marked(new Box3Helper(box, new Color(0x2f7bff))));
  }
}

/// The boxes of all parts that have a mesh.
export class Boxes {
  private readonly group = marked(new Group());
  private made = false;

  constructor(scene: Scene, private readonly world: World) {
    scene.add(this.group);
    this.group.visible = false;
  }

  show(on: boolean): void {
    this.group.visible = on;
    if (!on || this.made) return;
    this.made = true;
    for (const part of this.world.parts.filter(p => p.meshes.length > 0).slice(0, most)) {
      const box = part.meshes.reduce((sum, mesh) => sum.expandByObject(mesh), new Box3());
      this.group.add(marked(new Box3Helper(box, new Color(0xd2691e))));
    }
  }
}

/// Boxes that are seen for a moment.
export class Flashes {
  private readonly group = marked(new Group());
  private readonly left: {helper: Box3Helper; seconds: number}[] = [];

  constructor(scene: Scene) { scene.add(this.group); }

  add(boxes: readonly Box3[]): void {
    for (const box of boxes) {
      const helper = marked(new Box3Helper(box, new Color(0xe0162b)));
      this.group.add(helper);
      this.left.push({helper, seconds: 0.7});
    }
  }

  /// True as long as there are any.
  tick(seconds: number): boolean {
    for (const flash of this.left) flash.seconds -= seconds;
    while (this.left[0] && this.left[0].seconds <= 0) {
      const {helper} = this.left.shift()!;
      this.group.remove(helper);
      helper.dispose();
    }
    return this.left.length > 0;
  }
}
