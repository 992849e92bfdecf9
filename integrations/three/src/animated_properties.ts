// Animations of what is no node (KHR_animation_pointer): colours, transparency and places of pictures of materials, colour and brightness of lamps.
import {ColorKeyframeTrack, InterpolateDiscrete, InterpolateLinear, NumberKeyframeTrack, VectorKeyframeTrack,
  type BufferAttribute, type InterpolationModes, type KeyframeTrack, type Light, type Mesh, type MeshStandardMaterial, type Object3D} from 'three';
import type {GLTF, GLTFParser} from 'three/addons/loaders/GLTFLoader.js';

interface Channel {
  sampler: number;
  target: {path: string; extensions?: {KHR_animation_pointer?: {pointer: string}}};
}

interface FileAnimation {
  channels: Channel[];
  samplers: {input: number; output: number; interpolation?: string}[];
}

interface FileMesh { primitives: {material?: number}[] }

interface FileNode { extensions?: {KHR_lights_punctual?: {light: number}} }

interface Samples {
  times: number[];
  values: number[][];
  interpolation: InterpolationModes;
}

type MakeTracks = (object: Object3D, samples: Samples) => KeyframeTrack[];

type TrackType = new (name: string, times: number[], values: number[], interpolation: InterpolationModes) => KeyframeTrack;

/// Of components [from, to) of the values.
function track(Type: TrackType, property: string, from: number, to: number): (object: Object3D, samples: Samples) => KeyframeTrack {
  return (object, {times, values, interpolation}) =>
    new Type(`${object.uuid}.${property}`, times, values.flatMap(v => v.slice(from, to)), interpolation);
}

const one = (make: (object: Object3D, samples: Samples) => KeyframeTrack): MakeTracks => (object, samples) => [make(object, samples)];
const color = track(ColorKeyframeTrack, 'material.color', 0, 3), opacity = track(NumberKeyframeTrack, 'material.opacity', 3, 4);
const picture = 'pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/';

/// A picture that moves: its matrix is made of offset, scale and rotation in the order of glTF, scale first, whenever it is drawn.
function placed(make: (object: Object3D, samples: Samples) => KeyframeTrack): MakeTracks {
  return (object, samples) => {
    const map = ((object as Mesh).material as MeshStandardMaterial).map;
    if (!map) return [];
    map.matrixAutoUpdate = true;
    map.updateMatrix = () => {
      const {offset, repeat, rotation} = map, c = Math.cos(rotation), s = Math.sin(rotation);
      map.matrix.set(repeat.x * c, repeat.y * s, offset.x, -repeat.x * s, repeat.y * c, offset.y, 0, 0, 1);
    };
    return [make(object, samples)];
  };
}

const ofMaterial: Record<string, MakeTracks> = {
  'pbrMetallicRoughness/baseColorFactor': (object, samples) => [color(object, samples), opacity(object, samples)],
  'pbrMetallicRoughness/metallicFactor': one(track(NumberKeyframeTrack, 'material.metalness', 0, 1)),
  'pbrMetallicRoughness/roughnessFactor': one(track(NumberKeyframeTrack, 'material.roughness', 0, 1)),
  emissiveFactor: one(track(ColorKeyframeTrack, 'material.emissive', 0, 3)),
  [`${picture}offset`]: placed(track(VectorKeyframeTrack, 'map.offset', 0, 2)),
  [`${picture}scale`]: placed(track(VectorKeyframeTrack, 'map.repeat', 0, 2)),
  [`${picture}rotation`]: placed(track(NumberKeyframeTrack, 'map.rotation', 0, 1)),
};

const ofLight: Record<string, MakeTracks> = {
  color: one(track(ColorKeyframeTrack, 'color', 0, 3)),
  intensity: one(track(NumberKeyframeTrack, 'intensity', 0, 1)),
};

/// Objects by the number of their material or lamp in the file.
type ByNumber = Map<number, Object3D[]>;

const add = (all: ByNumber, number: number, object: Object3D): void => {
  all.set(number, [...all.get(number) ?? [], object]);
};

function shownBy(gltf: GLTF, parser: GLTFParser): {materials: ByNumber; lights: ByNumber} {
  const materials: ByNumber = new Map(), lights: ByNumber = new Map();
  const {nodes = [], meshes = []} = parser.json as {nodes?: FileNode[]; meshes?: FileMesh[]};
  gltf.scene.traverse(object => {
    // Of the primitive: lines and points have materials that three.js has made for them.
    const of = parser.associations.get(object) as {meshes?: number; primitives?: number; nodes?: number} | undefined;
    const number = meshes[of?.meshes ?? -1]?.primitives[of?.primitives ?? 0]?.material;
    if (number !== undefined && (object as Mesh).material) add(materials, number, object);
    const light = nodes[of?.nodes ?? -1]?.extensions?.KHR_lights_punctual?.light;
    const lamp = light !== undefined && [object, ...object.children].find(o => (o as Light).isLight);
    if (lamp) add(lights, light, lamp);
  });
  return {materials, lights};
}

/// What moves by a pointer, and how: nothing where three.js has nothing like it.
function targetOf(pointer: string, {materials, lights}: {materials: ByNumber; lights: ByNumber}): [Object3D[], MakeTracks] | undefined {
  for (const [pattern, objects, tracks] of [
    [/^\/materials\/(\d+)\/(.+)$/, materials, ofMaterial], [/^\/extensions\/KHR_lights_punctual\/lights\/(\d+)\/(.+)$/, lights, ofLight],
  ] as const) {
    const [, number, property] = pattern.exec(pointer) ?? [];
    const make = property && Object.hasOwn(tracks, property) ? tracks[property] : undefined;
    if (make) return [objects.get(Number(number)) ?? [], make];
  }
  return undefined;
}

async function numbers(parser: GLTFParser, accessor: number): Promise<number[][]> {
  const attribute = await parser.getDependency('accessor', accessor) as BufferAttribute;
  return Array.from({length: attribute.count}, (_, i) => Array.from({length: attribute.itemSize}, (_, k) => attribute.getComponent(i, k)));
}

/// Adds them to the clips that GLTFLoader has made of the same animations.
export async function addAnimatedProperties(gltf: GLTF, parser: GLTFParser): Promise<void> {
  const animations = (parser.json as {animations?: FileAnimation[]}).animations ?? [];
  if (!animations.some(a => a.channels.some(c => c.target.path === 'pointer'))) return;
  const shown = shownBy(gltf, parser);
  for (const [i, {channels, samplers}] of animations.entries()) {
    const clip = gltf.animations[i];
    for (const {sampler, target} of clip ? channels : []) {
      const found = targetOf(target.extensions?.KHR_animation_pointer?.pointer ?? '', shown);
      const {input, output, interpolation = 'LINEAR'} = samplers[sampler]!;
      if (!found || interpolation === 'CUBICSPLINE') continue;
      const samples = {
        times: (await numbers(parser, input)).flat(), values: await numbers(parser, output),
        interpolation: interpolation === 'STEP' ? InterpolateDiscrete : InterpolateLinear,
      };
      const [objects, make] = found;
      clip!.tracks.push(...objects.flatMap(object => make(object, samples)));
    }
    clip?.resetDuration();
  }
}
