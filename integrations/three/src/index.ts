/// What wrlkit writes into glTF and three.js does not read by itself.
export {BakedMaterial} from './baked_material.js';
export {bakedKey, DirectedMaterial, type Directions} from './directed_light.js';
export {fieldOfView, levelsOf, LevelSet, updateLevels} from './levels.js';
export {lightOf} from './lightmaps.js';
export {nameAt, partAt, type NamedPart} from './names.js';
export {WrlkitPlugin, type WrlkitOptions} from './plugin.js';
