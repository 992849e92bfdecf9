// The texels of baked light, to be judged: as a checker, and how many there are to a metre.
import {MeshBasicMaterial, type Side, type Texture} from 'three';

/// Blue, green, yellow, red for 1, 10, 100, 1000 texels a metre.
export const densityScale = [[1, '#30509b'], [10, '#2f9a72'], [100, '#e8cf49'], [1000, '#c83a2c']] as const;

/// Faces that are seen from the side are darker, so that shapes are seen.
const shading = 'outgoingLight *= 0.45 + 0.55 * abs(normalize(cross(dFdx(vPlace), dFdy(vPlace))).z);';

function shaded(light: Texture, side: Side, color: string): MeshBasicMaterial {
  const material = new MeshBasicMaterial({lightMap: light, side});
  const {width, height} = light.image as {width: number; height: number};
  // Places as the eye has them: they are small however far away the world is, and know the matrices of batches.
  material.onBeforeCompile = shader => {
    shader.uniforms['texels'] = {value: [width, height]};
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', '#include <common>\nvarying vec3 vPlace;')
      .replace('#include <project_vertex>', '#include <project_vertex>\nvPlace = mvPosition.xyz;');
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nuniform vec2 texels; varying vec3 vPlace;')
      .replace('#include <opaque_fragment>', `vec2 t = vLightMapUv * texels;\n${color}\n${shading}\n#include <opaque_fragment>`);
  };
  material.customProgramCacheKey = () => color;
  return material;
}

/// Each field of the checker is one texel.
export function checkered(light: Texture, side: Side): MeshBasicMaterial {
  return shaded(light, side, 'outgoingLight = mix(vec3(0.18), vec3(0.75), mod(floor(t.x) + floor(t.y), 2.0));');
}

export function densities(light: Texture, side: Side): MeshBasicMaterial {
  return shaded(light, side, `
    vec2 tx = dFdx(t), ty = dFdy(t); vec3 px = dFdx(vPlace), py = dFdy(vPlace);
    float area = length(cross(px, py));
    float d = log(sqrt(abs(tx.x * ty.y - tx.y * ty.x) / max(area, 1e-12))) / log(10.0);
    outgoingLight = d < 1.0 ? mix(vec3(0.03, 0.08, 0.33), vec3(0.03, 0.32, 0.17), clamp(d, 0.0, 1.0))
      : d < 2.0 ? mix(vec3(0.03, 0.32, 0.17), vec3(0.8, 0.62, 0.07), d - 1.0) : mix(vec3(0.8, 0.62, 0.07), vec3(0.58, 0.04, 0.03), clamp(d - 2.0, 0.0, 1.0));`);
}
