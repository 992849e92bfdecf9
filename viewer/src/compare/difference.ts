// The difference of two pictures: where both are alike it is black.
import {HalfFloatType, Mesh, OrthographicCamera, PlaneGeometry, Scene, ShaderMaterial, WebGLRenderTarget, type WebGLRenderer} from 'three';

export class Difference {
  private readonly targets = [0, 1].map(() => new WebGLRenderTarget(1, 1, {type: HalfFloatType, samples: 4}));
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
  private readonly material = new ShaderMaterial({
    uniforms: {a: {value: this.targets[0]!.texture}, b: {value: this.targets[1]!.texture}, gain: {value: 4}},
    depthTest: false,
    vertexShader: 'varying vec2 vUv; void main() { vUv = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }',
    fragmentShader: `
      uniform sampler2D a, b;
      uniform float gain;
      varying vec2 vUv;
      vec3 seen(vec3 c) { return sRGBTransferOETF(vec4(clamp(c, 0.0, 1.0), 1.0)).rgb; }
      void main() { gl_FragColor = vec4(abs(seen(texture2D(a, vUv).rgb) - seen(texture2D(b, vUv).rgb)) * gain, 1.0); }`,
  });

  constructor() {
    const plane = new Mesh(new PlaneGeometry(2, 2), this.material);
    plane.frustumCulled = false;
    this.scene.add(plane);
  }

  set gain(factor: number) { this.material.uniforms['gain']!.value = factor; }

  draw(renderer: WebGLRenderer, width: number, height: number, pictures: readonly [() => void, () => void]): void {
    const ratio = renderer.getPixelRatio();
    this.targets.forEach((target, i) => {
      target.setSize(Math.round(width * ratio), Math.round(height * ratio));
      renderer.setRenderTarget(target);
      renderer.clear();
      pictures[i]!();
    });
    renderer.setRenderTarget(null);
    renderer.render(this.scene, this.camera);
  }
}
