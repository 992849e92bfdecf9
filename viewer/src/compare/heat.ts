// The surface of a world in colours of its distance from another, measured by wrlkit (tools/report/deviation_map.h).
import {BufferAttribute, BufferGeometry, DoubleSide, Mesh, ShaderMaterial, type Color} from 'three';

/// From no distance to the end of the scale.
export const heatColors = ['#c9ced6', '#f4d35e', '#ee8434', '#c5283d', '#4b1458'] as const;

export class Heat {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  readonly triangles: number;

  constructor(data: ArrayBuffer, colors: readonly Color[]) {
    const head = new DataView(data), vertices = head.getUint32(0, true);
    this.triangles = head.getUint32(4, true);
    const origin = [8, 16, 24].map(at => head.getFloat64(at, true)) as [number, number, number];
    const places = new Float32Array(data, 32, 3 * vertices), distances = new Float32Array(data, 32 + 12 * vertices, vertices);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(places, 3));
    geometry.setAttribute('distance', new BufferAttribute(distances, 1));
    geometry.setIndex(new BufferAttribute(new Uint32Array(data, 32 + 16 * vertices, 3 * this.triangles), 1));
    this.mesh = new Mesh(geometry, heatMaterial(colors));
    this.mesh.position.set(...origin);
  }

  /// Metres at the end of the scale.
  set scale(metres: number) { this.mesh.material.uniforms['scale']!.value = Math.max(metres, 1e-12); }
}

function heatMaterial(colors: readonly Color[]): ShaderMaterial {
  return new ShaderMaterial({
    side: DoubleSide,
    uniforms: {scale: {value: 1}, colors: {value: colors}},
    vertexShader: `
      attribute float distance;
      varying float vDistance;
      varying vec3 vPlace;
      void main() {
        vDistance = distance;
        vec4 p = modelViewMatrix * vec4(position, 1.0);
        vPlace = p.xyz;
        gl_Position = projectionMatrix * p;
      }`,
    fragmentShader: `
      uniform float scale;
      uniform vec3 colors[${colors.length}];
      varying float vDistance;
      varying vec3 vPlace;
      void main() {
        float t = clamp(vDistance / scale, 0.0, 1.0) * ${(colors.length - 1).toFixed(1)};
        vec3 color = colors[0];
        for (int i = 1; i < ${colors.length}; ++i) color = mix(color, colors[i], clamp(t - float(i - 1), 0.0, 1.0));
        float facing = abs(normalize(cross(dFdx(vPlace), dFdy(vPlace))).z);
        gl_FragColor = vec4(color * (0.45 + 0.55 * facing), 1.0);
        #include <colorspace_fragment>
      }`,
  });
}
