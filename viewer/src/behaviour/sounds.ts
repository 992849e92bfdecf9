// Sounds of the world, which play when the user says so. `wrlkit view` puts their files into the page (url "data:..."); the graph says what
// happens to their AudioClips (writers/gltf/interactivity/targets.h): "sound:4:startTime" means now.
import {Vector3, type Object3D, type PerspectiveCamera} from 'three';
import {vrmlOf, type GltfFile} from '../world/file';
import {loudness, type Ellipsoids} from './loudness';
import type {Value} from './operations';

const farFuture = 4_102_444_800;  // 2100: a clip that starts there waits for an event
const mostSounds = 64;

type Fields = Record<string, unknown>;

interface Found {
  node: number;
  name: string;
  data: string;         // base64
  shape: Ellipsoids;
  intensity: number;
  spatialize: boolean;
  loop: boolean;
  pitch: number;
  playsAtFirst: boolean;
}

const number = (fields: Fields, name: string, otherwise: number): number => typeof fields[name] === 'number' ? fields[name] : otherwise;
const vector = (fields: Fields, name: string, otherwise: readonly number[]): readonly number[] => {
  const v = fields[name];
  return Array.isArray(v) && v.length === 3 && v.every(Number.isFinite) ? v as number[] : otherwise;
};

/// The Sounds of a file whose AudioClip is in it.
export function soundsOf(file: GltfFile): Found[] {
  const clips = new Map<string, Fields>();  // by DEF, for those that are used again
  return (file.nodes ?? []).flatMap(({name, extras}, node) => {
    const sound = vrmlOf(extras)['Sound'] as Fields | undefined, source = sound?.['source'] as Fields | undefined;
    const used = source?.['USE'];
    const clip = (typeof used === 'string' ? clips.get(used) : source?.['AudioClip']) as Fields | undefined;
    if (typeof clip?.['DEF'] === 'string') clips.set(clip['DEF'], clip);
    const url = [clip?.['url']].flat().map(String).find(u => /^data:audio\/\w+;base64,/.test(u));
    if (!sound || !clip || !url) return [];
    const start = number(clip, 'startTime', 0), loop = clip['loop'] === true;
    return [{
      node, name: name ?? 'Sound', data: url.slice(url.indexOf(',') + 1), loop,
      shape: {
        location: vector(sound, 'location', [0, 0, 0]), direction: vector(sound, 'direction', [0, 0, 1]), minFront: number(sound, 'minFront', 1),
        minBack: number(sound, 'minBack', 1), maxFront: number(sound, 'maxFront', 10), maxBack: number(sound, 'maxBack', 10),
      },
      intensity: number(sound, 'intensity', 1), spatialize: sound['spatialize'] !== false, pitch: number(clip, 'pitch', 1),
      playsAtFirst: loop && start < farFuture && !(number(clip, 'stopTime', 0) > start),
    }];
  }).slice(0, mostSounds);
}

/// One Sound while the world runs. What happens to it is kept while it cannot be heard, so that one that goes on is heard later.
class Playing {
  active: boolean;
  gain = 0;            // what is heard of it, from 0 to 1
  private intensity: number;
  private loop: boolean;
  private pitch: number;
  private samples: AudioBuffer | null = null;
  private source: AudioBufferSourceNode | null = null;
  private volume: GainNode | null = null;
  private side: StereoPannerNode | null = null;

  constructor(readonly found: Found, private readonly object: Object3D | null) {
    this.active = found.playsAtFirst;
    [this.intensity, this.loop, this.pitch] = [found.intensity, found.loop, found.pitch];
  }

  get heard(): boolean { return this.source !== null; }

  /// Rejects where the browser cannot decode the file.
  async hear(context: AudioContext): Promise<void> {
    const bytes = Uint8Array.from(atob(this.found.data), c => c.charCodeAt(0));
    this.samples = await context.decodeAudioData(bytes.buffer);
    if (context.state === 'closed') return;
    [this.volume, this.side] = [context.createGain(), context.createStereoPanner()];
    this.volume.gain.value = 0;
    this.volume.connect(this.side).connect(context.destination);
    if (this.active && this.loop) this.begin();
    else this.active = false;
  }

  receive(field: string, value: Value): void {
    if (field === 'startTime' && !this.active) this.begin();
    if (field === 'stopTime') this.end();
    if (field === 'intensity') this.intensity = Math.min(1, Math.max(0, Number(value)));
    if (field === 'pitch' && Number(value) > 0) this.pitch = Number(value);
    if (field === 'loop') this.loop = value === true;
    if (this.source) [this.source.loop, this.source.playbackRate.value] = [this.loop, this.pitch];
  }

  private begin(): void {
    this.active = true;
    if (!this.samples || !this.volume) return;
    const source = this.source = this.volume.context.createBufferSource();
    [source.buffer, source.loop, source.playbackRate.value] = [this.samples, this.loop, this.pitch];
    source.onended = () => { if (this.source === source) this.end(); };
    source.connect(this.volume);
    source.start();
  }

  end(): void {
    this.active = false;
    this.silence();
  }

  /// It goes on, unheard.
  silence(): void {
    const {source} = this;
    this.source = null;
    source?.stop();
  }

  /// As it is heard by the camera.
  place(camera: PerspectiveCamera): void {
    if (!this.volume || !this.side || !this.object) return;
    const {shape, spatialize} = this.found;
    this.gain = this.intensity * loudness(shape, this.object.worldToLocal(camera.position.clone()).toArray());
    this.volume.gain.value = this.gain;
    const from = camera.worldToLocal(this.object.localToWorld(new Vector3(...shape.location))), distance = from.length();
    this.side.pan.value = spatialize && distance > 0 ? from.x / distance : 0;
  }
}

export class Sounds {
  readonly faults: string[] = [];
  private context: AudioContext | null = null;
  private readonly all: Playing[];

  /// `changed`: another one can be heard, or cannot.
  constructor(found: readonly Found[], objectOf: (node: number) => Object3D | null, private readonly changed: () => void) {
    this.all = found.map(sound => new Playing(sound, objectOf(sound.node)));
  }

  get on(): boolean { return this.context !== null; }

  /// From a click: a browser allows it then.
  hear(on: boolean): void {
    this.faults.length = 0;
    if (!on) return this.silence();
    const context = this.context = new AudioContext();
    for (const sound of this.all)
      sound.hear(context).catch(() => {
        if (this.context === context) this.faults.push(`${sound.found.name}: the browser cannot decode it`);
      }).finally(() => {
        if (this.context === context) this.changed();
      });
  }

  /// An event of the graph, such as "sound:4:startTime".
  receive(id: string, value: Value): void {
    const [, node, field] = id.split(':');
    for (const sound of this.all) if (sound.found.node === Number(node)) sound.receive(field ?? '', value);
  }

  place(camera: PerspectiveCamera): void { if (this.context) for (const sound of this.all) sound.place(camera); }

  /// What plays now, and how loud it is.
  get playing(): {name: string; gain: number}[] {
    return this.all.filter(sound => sound.heard).map(({found, gain}) => ({name: found.name, gain}));
  }

  private silence(): void {
    for (const sound of this.all) sound.silence();
    void this.context?.close();
    this.context = null;
  }

  dispose(): void {
    for (const sound of this.all) sound.end();
    this.silence();
  }
}
