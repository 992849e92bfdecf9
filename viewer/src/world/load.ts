// Bytes of a .glb to a World.
import {Box3, type Light, type Line, type Mesh, type Object3D, PerspectiveCamera, type Points, type PointsMaterial, Vector3} from 'three';
import {GLTFLoader, type GLTF} from 'three/addons/loaders/GLTFLoader.js';
import {accessorBytes, accessorsOf, trianglesOf, typeOf, vrmlOf, type FileNode, type GltfFile} from './file';
import {levelsOf, WrlkitPlugin} from 'wrlkit-three';
import {hide, isShown, Levels, type Navigation, type Part, type Viewpoint, type World} from './world';

/// Triangles, lines or points.
const isDrawn = (o: Object3D): o is Mesh => (o as Mesh).isMesh || (o as Line).isLine || (o as Points).isPoints;

/// What a Switch does not show is there and hidden (KHR_node_visibility).
const isVisible = (node: FileNode): boolean => (node.extensions?.['KHR_node_visibility'] as {visible?: boolean} | undefined)?.visible !== false;

const shownTriangles = (parts: readonly Part[]): number => parts.reduce((n, p) => n + (p.object.visible ? p.triangles : 0), 0);

/// The node of the file that an object is; undefined for a primitive of a mesh.
function nodeOf(gltf: GLTF, o: Object3D): number | undefined {
  return gltf.parser.associations.get(o)?.nodes;
}

class Builder {
  readonly parts: Part[] = [];
  private readonly file: GltfFile;

  private readonly coarser: Set<Object3D>;

  constructor(private readonly gltf: GLTF) {
    this.file = gltf.parser.json as GltfFile;
    this.coarser = new Set(levelsOf(gltf).flatMap(set => set.levels.slice(1)));
  }

  /// The parts at an object and below it.
  build(o: Object3D, parent: Part | null): Part[] {
    if (this.coarser.has(o)) return [];
    const node = nodeOf(this.gltf, o);
    if (node === undefined) return o.children.flatMap(child => this.build(child, parent));
    const part = this.part(o, node, parent);
    for (const child of o.children) {
      if (isDrawn(child) && nodeOf(this.gltf, child) === undefined) part.meshes.push(child);
      else part.children.push(...this.build(child, part));
    }
    part.triangles += shownTriangles(part.children);
    return [part];
  }

  private part(object: Object3D, node: number, parent: Part | null): Part {
    const said = this.file.nodes?.[node] ?? {};
    const mesh = said.mesh ?? null;
    hide(object, 'world', !isVisible(said));
    const part: Part = {
      node, object, parent, mesh, name: said.name ?? '', type: this.typeOf(said.extras, node, object), extras: said.extras ?? {},
      children: [], meshes: isDrawn(object) ? [object] : [], triangles: mesh === null ? 0 : trianglesOf(this.file, mesh), bytes: 0,
    };
    this.parts.push(part);
    return part;
  }

  private typeOf(extras: Record<string, unknown> | undefined, node: number, object: Object3D): string {
    const said = typeOf(extras), mesh = this.file.nodes?.[node]?.mesh;
    if (said) return said;
    if (mesh !== undefined) return typeOf(this.file.meshes?.[mesh]?.extras) ?? 'Shape';
    if (this.file.nodes?.[node]?.camera !== undefined) return 'Viewpoint';
    if ((object as Light).isLight || object.children.some(c => (c as Light).isLight)) return 'Light';
    return object.children.length > 0 ? 'Group' : 'Node';
  }

  /// Bytes of each part's meshes; what several share counts once.
  sizes(parts: Part[]): void {
    for (const part of parts) {
      const accessors = new Set<number>();
      const collect = (p: Part): void => {
        if (p.mesh !== null) for (const a of accessorsOf(this.file, p.mesh).keys()) accessors.add(a);
        p.children.forEach(collect);
      };
      collect(part);
      part.bytes = [...accessors].reduce((n, a) => n + accessorBytes(this.file, a), 0);
    }
  }
}

function levelsIn(gltf: GLTF, parts: Part[]): Levels[] {
  const byObject = new Map(parts.map(part => [part.object, part]));
  return levelsOf(gltf).flatMap(set => {
    const part = byObject.get(set.levels[0]!);
    return part ? [new Levels(set, part, [part.triangles, ...set.levels.slice(1).map(level => trianglesBelow(gltf, level))])] : [];
  });
}

function trianglesBelow(gltf: GLTF, o: Object3D): number {
  const file = gltf.parser.json as GltfFile;
  const mesh = file.nodes?.[nodeOf(gltf, o) ?? -1]?.mesh;
  return (mesh === undefined ? 0 : trianglesOf(file, mesh)) + o.children.reduce((n, child) => n + trianglesBelow(gltf, child), 0);
}

function viewpoints(gltf: GLTF): Viewpoint[] {
  const file = gltf.parser.json as GltfFile;
  gltf.scene.updateMatrixWorld(true);
  return gltf.cameras.flatMap((camera, i) => {
    const holder = camera.parent && nodeOf(gltf, camera) === undefined ? camera.parent : camera;
    const node = file.nodes?.[nodeOf(gltf, holder) ?? -1];
    const said = vrmlOf(node?.extras)['Viewpoint'] as {description?: string} | undefined;
    const placed = new PerspectiveCamera(camera instanceof PerspectiveCamera ? camera.fov : 45);
    camera.matrixWorld.decompose(placed.position, placed.quaternion, new Vector3());
    return [{name: said?.description || node?.name || `Viewpoint ${i + 1}`, node: node?.name ?? '', camera: placed}];
  });
}

function findVrml<T>(file: GltfFile, type: string): T | undefined {
  for (const holder of [...(file.scenes ?? []), ...(file.nodes ?? [])]) {
    const found = vrmlOf(holder.extras)[type];
    if (found) return found as T;
  }
  return undefined;
}

function navigation(file: GltfFile): Navigation {
  const said = findVrml<{type?: string[]; speed?: number; avatarSize?: number[]; headlight?: boolean}>(file, 'NavigationInfo') ?? {};
  const [radius = 0.25, height = 1.6, step = 0.75] = said.avatarSize ?? [];
  return {type: said.type ?? ['WALK', 'ANY'], speed: said.speed ?? 1, size: [radius, height, step], headlight: said.headlight ?? true};
}

function sky(file: GltfFile): number[] | null {
  const colors = findVrml<{skyColor?: number[]}>(file, 'Background')?.skyColor;
  return colors && colors.length >= 3 ? colors.slice(-3) : null;
}

function allLights(root: Object3D): Light[] {
  const lights: Light[] = [];
  root.traverse(o => { if ((o as Light).isLight) lights.push(o as Light); });
  return lights;
}

/// A mesh that several nodes show comes out as objects of the same geometry and materials.
export async function loadWorld(name: string, bytes: ArrayBuffer): Promise<World> {
  const loader = new GLTFLoader().register(parser => new WrlkitPlugin(parser, {names: false}));
  const gltf = await loader.parseAsync(bytes, '');
  const file = gltf.parser.json as GltfFile;
  const builder = new Builder(gltf);
  const roots = gltf.scene.children.flatMap(child => builder.build(child, null));
  const levels = levelsIn(gltf, builder.parts);
  builder.sizes(builder.parts);
  const cameras = viewpoints(gltf);
  gltf.scene.updateMatrixWorld(true);
  const box = new Box3();
  for (const part of builder.parts) for (const mesh of part.meshes) if (isShown(mesh)) box.expandByObject(mesh);
  gltf.scene.traverse(o => { if ((o as Points).isPoints) ((o as Points).material as PointsMaterial).size = 3; });  // pixels: one is hardly seen
  const empty = box.isEmpty();
  if (empty) box.set(new Vector3(-1, -1, -1), new Vector3(1, 1, 1));
  return {
    name, size: bytes.byteLength, file, root: gltf.scene, parts: builder.parts, roots, levels, viewpoints: cameras, navigation: navigation(file),
    sky: sky(file), lights: allLights(gltf.scene), clips: gltf.animations, box, empty, triangles: shownTriangles(roots),
    unique: uniqueTriangles(file, builder.parts),
  };
}

function uniqueTriangles(file: GltfFile, parts: Part[]): number {
  const meshes = new Set(parts.map(p => p.mesh).filter(mesh => mesh !== null));
  return [...meshes].reduce((n, mesh) => n + trianglesOf(file, mesh), 0);
}

