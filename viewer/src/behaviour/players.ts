// Animations that a behaviour graph starts and stops, on a timeline that goes on for ever (KHR_interactivity, "Animation Start").
import {AnimationMixer, type AnimationAction, type AnimationClip, type Object3D} from 'three';

interface Playing {
  time: number;  // on that timeline
  end: number;
  stop: number;
  speed: number;
  done: () => void;
  stopped: () => void;
}

export class Players {
  private readonly mixer: AnimationMixer;
  private readonly actions: (AnimationAction | undefined)[] = [];
  private readonly playing = new Map<number, Playing>();
  private readonly heads: number[] = [];

  constructor(root: Object3D, private readonly clips: readonly AnimationClip[]) { this.mixer = new AnimationMixer(root); }

  get any(): boolean { return this.playing.size > 0; }

  /// Where an animation is on the timeline.
  head(animation: number): number { return this.playing.get(animation)?.time ?? this.heads[animation] ?? 0; }

  play(animation: number, start: number, end: number, speed: number, done: () => void): void {
    if (!this.clips[animation]) return;
    this.playing.set(animation, {time: start, end, stop: end, speed, done, stopped: () => undefined});
    this.show(animation, start);
  }

  /// What it moves stays where it is.
  stop(animation: number): void {
    const at = this.playing.get(animation);
    if (at) this.heads[animation] = at.time;
    this.playing.delete(animation);
  }

  stopAt(animation: number, time: number, stopped: () => void): void {
    const at = this.playing.get(animation);
    if (at) Object.assign(at, {stop: time, stopped});
  }

  tick(seconds: number): void {
    for (const [animation, at] of [...this.playing]) {
      const limit = Math.min(at.stop, at.end);
      at.time = Math.min(at.time + seconds * at.speed, limit);
      this.show(animation, at.time);
      if (at.time < limit) continue;
      this.stop(animation);
      if (at.stop < at.end) at.stopped();
      else at.done();
    }
  }

  private show(animation: number, time: number): void {
    const clip = this.clips[animation]!;
    let action = this.actions[animation];
    if (!action) {
      action = this.actions[animation] = this.mixer.clipAction(clip);
      action.play();
      action.paused = true;
    }
    const rounds = clip.duration > 0 && time > 0 ? Math.ceil((time - clip.duration) / clip.duration) : 0;
    action.time = clip.duration > 0 ? time - rounds * clip.duration : 0;
    this.mixer.update(0);
  }

  dispose(): void { this.mixer.stopAllAction(); }
}
