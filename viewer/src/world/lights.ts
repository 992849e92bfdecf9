// The lights of a world, its headlight, and what is shone with instead.
import {DirectionalLight, Group, HemisphereLight, type Light, type PerspectiveCamera, type Scene} from 'three';
import type {World} from './world';

export type Lighting = 'world' | 'headlight' | 'off';

export class Lights {
  private readonly headlight = new DirectionalLight(0xffffff, Math.PI);
  private readonly fill = new HemisphereLight(0xffffff, 0x8a9099, 0.35);
  private readonly own: Light | undefined;  // the headlight of the file, which stands where its first camera is

  private readonly eye = new Group();      // goes with the camera

  constructor(scene: Scene, private readonly world: Pick<World, 'lights' | 'navigation'>) {
    this.own = world.lights.find(light => light.name === 'headlight' || light.parent?.name === 'headlight');
    this.headlight.position.set(0, 0, 0);
    this.headlight.target.position.set(0, 0, -1);
    this.eye.add(this.headlight, this.headlight.target);
    scene.add(this.fill, this.eye);
    this.set('world');
  }

  /// Before each picture.
  follow(camera: PerspectiveCamera): void {
    this.eye.position.copy(camera.position);
    this.eye.quaternion.copy(camera.quaternion);
  }

  /// Whether the world has lights other than the headlight.
  get hasWorldLights(): boolean { return this.world.lights.some(light => light !== this.own); }

  set(lighting: Lighting): void {
    const world = lighting === 'world';
    for (const light of this.world.lights) light.visible = world && light !== this.own;
    this.headlight.visible = lighting === 'headlight' || (world && (this.own !== undefined || (this.world.navigation.headlight && !this.hasWorldLights)));
    if (this.own instanceof DirectionalLight) {
      this.headlight.color.copy(this.own.color);
      this.headlight.intensity = this.own.intensity;
    }
    this.fill.visible = lighting !== 'off';
  }
}
