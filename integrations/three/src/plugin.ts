import type {GLTF, GLTFLoaderPlugin, GLTFParser} from 'three/addons/loaders/GLTFLoader.js';
import {addAnimatedProperties} from './animated_properties.js';
import {hangLevels} from './levels.js';
import {addBakedLight} from './lightmaps.js';
import {readNames} from './names.js';

export interface WrlkitOptions {
  levels?: boolean;      // MSFT_lod; default: true, as all
  light?: boolean;       // MOZ_lightmap, and extras.lightmap with directions
  properties?: boolean;  // KHR_animation_pointer
  names?: boolean;       // EXT_structural_metadata, EXT_mesh_features, EXT_instance_features
}

/// `new GLTFLoader().register(parser => new WrlkitPlugin(parser))`. One plugin, as levels of detail have baked light too.
export class WrlkitPlugin implements GLTFLoaderPlugin {
  readonly name = 'WRLKIT';

  constructor(private readonly parser: GLTFParser, private readonly options: WrlkitOptions = {}) {}

  async afterRoot(gltf: GLTF): Promise<void> {
    const {levels = true, light = true, properties = true, names = true} = this.options;
    if (levels) await hangLevels(gltf, this.parser);
    if (properties) await addAnimatedProperties(gltf, this.parser);
    if (light) await addBakedLight(gltf, this.parser);
    if (names) await readNames(gltf, this.parser);
  }
}
