// The lighting equation of VRML (ISO/IEC 14772-1, 4.14.4; without ambient light) for a glTF file that wrlkit wrote: colours
// and pictures are those of glTF, taken back to colours of the display, in which VRML browsers compute; the highlights are in
// the extras of the materials. Lights are glTF's.
import * as THREE from 'three';

/// Changes materials, vertex colours and lights of a scene, for a renderer whose output is linear.
export function light_as_vrml(scene) {
  const made = new Map(), colors = new Set();
  const remade = m => made.get(m) ?? made.set(m, for_display(m)).get(m);
  scene.traverse(o => {
    if (o.isLight) o.color.convertLinearToSRGB();
    if (!o.material) return;
    o.material = Array.isArray(o.material) ? o.material.map(remade) : remade(o.material);
    if (o.geometry.attributes.color) colors.add(o.geometry.attributes.color);
  });
  colors.forEach(color_for_display);
}

/// A material whose numbers are colours of the display; a metallic-roughness one becomes one of VRML.
function for_display(material) {
  const m = material.isMeshStandardMaterial ? shiny(material.userData.vrml97?.Material ?? {}) : material.clone();
  for (const key of ['color', 'emissive']) if (material[key]) m[key].copy(material[key]).convertLinearToSRGB();
  for (const key of ['map', 'emissiveMap']) if (material[key]) m[key] = picture_for_display(material[key]);
  for (const key of ['side', 'transparent', 'opacity', 'alphaTest', 'depthWrite', 'vertexColors']) m[key] = material[key];
  return m;
}

/// Blinn's highlight as VRML has it: neither normalised nor less where the light comes in at a slant.
const highlight = `reflectedLight.directSpecular += step(0.0, dot(geometryNormal, directLight.direction)) * directLight.color
    * RECIPROCAL_PI * material.specularColor
    * pow(saturate(dot(geometryNormal, normalize(directLight.direction + geometryViewDir))), material.specularShininess);`;

function shiny({specularColor = [0, 0, 0], shininess = 0.2}) {
  const m = new THREE.MeshPhongMaterial({shininess: 128 * shininess});
  m.specular.fromArray(specularColor);
  const chunk = 'lights_phong_pars_fragment';
  const changed = THREE.ShaderChunk[chunk].replace(/reflectedLight\.directSpecular \+=.*;/, highlight);
  if (changed === THREE.ShaderChunk[chunk]) throw new Error(`${chunk} is not as expected`);
  m.onBeforeCompile = shader => { shader.fragmentShader = shader.fragmentShader.replace(`#include <${chunk}>`, changed); };
  return m;
}

function picture_for_display(texture) {
  const t = texture.clone();
  t.colorSpace = THREE.NoColorSpace;
  t.needsUpdate = true;
  return t;
}

function color_for_display(attribute) {
  const c = new THREE.Color();
  for (let i = 0; i < attribute.count; ++i) {
    c.fromBufferAttribute(attribute, i).convertLinearToSRGB();
    attribute.setXYZ(i, c.r, c.g, c.b);
  }
  attribute.needsUpdate = true;
}
