// A tileset that is loaded piece by piece: 3d-tiles-renderer, with all that tiles of ours need.
import {Matrix4, type Object3D} from 'three';
import {TilesRenderer} from '3d-tiles-renderer/three';
import {GLTFExtensionsPlugin} from '3d-tiles-renderer/three/plugins';
import type {Tile} from '3d-tiles-renderer/core';
import {DRACOLoader} from 'three/addons/loaders/DRACOLoader.js';
import {MeshoptDecoder} from 'three/addons/libs/meshopt_decoder.module.js';
import dracoWrapper from 'three/addons/libs/draco/gltf/draco_wasm_wrapper.js?url';
import dracoDecoder from 'three/addons/libs/draco/gltf/draco_decoder.wasm?url';

/// Its decoder is in the page.
const dracoLoader = new DRACOLoader().setDecoderPath({js: dracoWrapper, wasm: dracoDecoder});

/// What 3d-tiles-renderer knows of a tile and does not declare.
export interface LoadedTile extends Tile {
  engineData: {scene: Object3D | null; transform: Matrix4};
}

export interface LoadStatistics {
  inCache: number;
  queued: number;
  downloading: number;
  parsing: number;
  loaded: number;
  failed: number;
}

/// Counts the bytes that come over the network.
class Meter {
  readonly name = 'METER';
  bytes = 0;

  /// At the root of a site 3d-tiles-renderer puts one slash too many before a name.
  preprocessURL(url: string): string { return url.replace(/([^:])\/\/+/g, '$1/'); }

  async fetchData(url: string, options: RequestInit): Promise<Response> {
    const response = await fetch(url, options);
    if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
    const body = await response.arrayBuffer();
    this.bytes += body.byteLength;
    return new Response(body, {headers: response.headers});
  }
}

export class Tileset {
  readonly tiles: TilesRenderer;
  private readonly meter = new Meter();

  constructor(url: string) {
    this.tiles = new TilesRenderer(url);
    this.tiles.registerPlugin(new GLTFExtensionsPlugin({meshoptDecoder: MeshoptDecoder, dracoLoader, autoDispose: false}));
    this.tiles.registerPlugin(this.meter);
    this.tiles.addEventListener('load-root-tileset', ({tileset}) => this.place((tileset as unknown as {root: Tile}).root.transform));
    this.budget = usualBudget;
  }

  /// Bytes that came over the network.
  get bytes(): number { return this.meter.bytes; }
  get statistics(): LoadStatistics { return (this.tiles as unknown as {stats: LoadStatistics}).stats; }
  get loading(): boolean { const s = this.statistics; return s.queued + s.downloading + s.parsing > 0; }
  get shown(): LoadedTile[] { return [...this.tiles.visibleTiles] as LoadedTile[]; }
  get loaded(): LoadedTile[] {
    const out: LoadedTile[] = [];
    this.tiles.forEachLoadedModel((_, tile) => out.push(tile as LoadedTile));
    return out;
  }

  /// Bytes of geometry and pictures that are kept at most, except for what the picture needs at least.
  get budget(): number { return this.tiles.lruCache.maxBytesSize; }
  set budget(bytes: number) {
    this.tiles.lruCache.maxBytesSize = bytes;
    this.tiles.lruCache.minBytesSize = 0.75 * bytes;
  }
  get kept(): number { return (this.tiles.lruCache as unknown as {cachedBytes: number}).cachedBytes; }

  /// Pixels that what is shown is wrong by, at most: of tiles that are shown.
  get error(): number { return this.shown.reduce((most, tile) => Math.max(most, tile.traversal.error), 0); }

  /// The root around the origin, y up, wherever on the Earth it is.
  private place(transform: number[] | undefined): void {
    const m = new Matrix4().makeRotationX(-Math.PI / 2);
    if (transform) m.multiply(new Matrix4().fromArray(transform).invert());
    m.decompose(this.tiles.group.position, this.tiles.group.quaternion, this.tiles.group.scale);
    this.tiles.group.updateMatrixWorld(true);
  }
}

export const usualBudget = 256e6;

/// The tiles above it.
export const levelOf = (tile: Tile): number => tile.internal.depth;
