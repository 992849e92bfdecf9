// A surface whose light is in a texture, and which may shine itself: MeshBasicMaterial knows of no emission.
import {Color, MeshBasicMaterial, type WebGLProgramParametersWithUniforms} from 'three';

export class BakedMaterial extends MeshBasicMaterial {
  emissive = new Color(0);
  emissiveIntensity = 1;

  override copy(from: this): this {
    super.copy(from);
    this.emissive.copy(from.emissive);
    this.emissiveIntensity = from.emissiveIntensity;
    return this;
  }

  override onBeforeCompile(shader: WebGLProgramParametersWithUniforms): void {
    shader.uniforms['emissive'] = {value: new Color()};  // three.js fills it in
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nuniform vec3 emissive;')
      .replace('#include <opaque_fragment>', 'outgoingLight += emissive;\n#include <opaque_fragment>');
  }

  override customProgramCacheKey(): string { return 'baked light'; }
}
