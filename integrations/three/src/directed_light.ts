// Baked light that knows where it comes from: for each texel the mean direction v of its light, longer the more of it comes from there
// (docs/lighting.md). Radiance is taken as linear over the sphere of directions, so that a surface of normal n gets 1 + 2 v.n of it, and the part
// |v| shines as a lamp: highlights move with the viewer. The program does the same (light/render/baked.cpp).
import type {Color, Texture, WebGLProgramParametersWithUniforms} from 'three';
import {BakedMaterial} from './baked_material.js';

export interface Directions {
  x: Texture;          // of v in the world, for red, green and blue light, each 0.5 + 0.5 v
  y: Texture;
  z: Texture;
  specular: Color;     // of ISO/IEC 14772-1, 4.14
  shininess: number;
}

const varyings = 'varying vec3 vPlace; varying vec3 vShade;';

// The normal of shading in the world; 0 where there is none.
const normal = `
  #include <beginnormal_vertex>
  #include <morphnormal_vertex>
  #include <defaultnormal_vertex>
  vShade = (vec4(transformedNormal, 0.0) * viewMatrix).xyz;`;

const light = `
  vec3 eye = isOrthographic ? vec3(0.0, 0.0, 1.0) : -vPlace;
  vec3 face = inverseTransformDirection(cross(dFdx(vPlace), dFdy(vPlace)), viewMatrix);
  vec3 shade = dot(vShade, vShade) > 0.0 ? normalize(vShade) : face;
  if (dot(shade, face) < 0.0) shade = -shade;
  vec3 vx = 2.0 * texture2D(directionX, vLightMapUv).rgb - 1.0, vy = 2.0 * texture2D(directionY, vLightMapUv).rgb - 1.0, vz = 2.0 * texture2D(directionZ, vLightMapUv).rgb - 1.0;
  vec3 towards = vec3(vx.r + vx.g + vx.b, vy.r + vy.g + vy.b, vz.r + vz.g + vz.b) / 3.0;
  float directed = length(towards);
  vec3 shine = vec3(0.0);
  if (directed > 0.0 && dot(shade, towards) > 0.0) {
    vec3 lamp = towards / directed;
    float gloss = max(dot(shade, normalize(lamp + inverseTransformDirection(eye, viewMatrix))), 0.0);
    shine = min(directed, 1.0) / max(dot(face, lamp), 0.25) * pow(max(gloss, 1e-4), 128.0 * shininess) * specular * reflectedLight.indirectDiffuse;
  }
  reflectedLight.indirectDiffuse *= max(1.0 + 2.0 * (vx * shade.x + vy * shade.y + vz * shade.z), 0.0) / max(1.0 + 2.0 * (vx * face.x + vy * face.y + vz * face.z), 0.1);`;

export class DirectedMaterial extends BakedMaterial {
  directions!: Directions;

  override copy(from: this): this {
    super.copy(from);
    this.directions = from.directions;
    return this;
  }

  override onBeforeCompile(shader: WebGLProgramParametersWithUniforms): void {
    super.onBeforeCompile(shader);
    const {x, y, z, specular, shininess} = this.directions;
    Object.assign(shader.uniforms, {directionX: {value: x}, directionY: {value: y}, directionZ: {value: z}, specular: {value: specular}, shininess: {value: shininess}});
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>\n${varyings}`)
      .replace('#include <begin_vertex>', `${normal}\n#include <begin_vertex>`)
      .replace('#include <project_vertex>', '#include <project_vertex>\nvPlace = mvPosition.xyz;');
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>\n${varyings} uniform sampler2D directionX, directionY, directionZ; uniform vec3 specular; uniform float shininess;`)
      .replace('#include <aomap_fragment>', `${light}\n#include <aomap_fragment>`)
      .replace('#include <opaque_fragment>', 'outgoingLight += shine;\n#include <opaque_fragment>');
  }

  override customProgramCacheKey(): string { return 'directed light'; }
}

/// What emission and directions say of materials that are otherwise alike.
export function bakedKey(material: unknown): string {
  if (!(material instanceof BakedMaterial)) return '';
  if (!(material instanceof DirectedMaterial)) return `${material.emissive.getHex()}`;
  const {x, y, z, specular, shininess} = material.directions;
  return [material.emissive.getHex(), x.uuid, y.uuid, z.uuid, specular.getHex(), shininess].join();
}
