// Billboards (ISO/IEC 14772-1, 6.6) turn their Z axis to where the viewer is, about an axis or any way round.
import {Matrix4, Quaternion, Vector3, type Object3D, type PerspectiveCamera} from 'three';
import {vrmlOf} from '../world/file';
import type {World} from '../world/world';

export class Billboards {
  private readonly all: {object: Object3D; axis: Vector3; still: Quaternion}[];

  constructor(world: World) {
    this.all = world.parts.flatMap(part => {
      const said = vrmlOf(part.extras)['Billboard'] as {axisOfRotation?: number[]} | undefined;
      const [x = 0, y = 1, z = 0] = said?.axisOfRotation ?? [];
      return said ? [{object: part.object, axis: new Vector3(x, y, z), still: part.object.quaternion.clone()}] : [];
    });
  }

  get any(): boolean { return this.all.length > 0; }

  /// Before each picture.
  face(camera: PerspectiveCamera): void {
    for (const {object, axis} of this.all) {
      const frame = object.parent?.matrixWorld.clone().invert() ?? new Matrix4();
      const to = camera.position.clone().applyMatrix4(frame).sub(object.position);
      if (axis.lengthSq() === 0) {
        const up = new Vector3(0, 1, 0).transformDirection(camera.matrixWorld).transformDirection(frame);
        object.quaternion.setFromRotationMatrix(new Matrix4().lookAt(to, new Vector3(), up));
        continue;
      }
      const about = axis.clone().normalize(), from = new Vector3(0, 0, 1).projectOnPlane(about), across = to.projectOnPlane(about);
      if (from.lengthSq() < 1e-12 || across.lengthSq() < 1e-12) continue;
      const angle = Math.atan2(from.cross(across).dot(about), new Vector3(0, 0, 1).projectOnPlane(about).dot(across));
      object.quaternion.setFromAxisAngle(about, angle);
    }
  }

  rest(): void { for (const {object, still} of this.all) object.quaternion.copy(still); }
}
