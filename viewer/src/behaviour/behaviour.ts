// What the world does by itself and when it is clicked: the graph that wrlkit has made of its ROUTEs, and Billboards. It runs when the
// user says so; Scripts and Sounds when he says that, too. Films do not.
import type {PerspectiveCamera} from 'three';
import {typeOf} from '../world/file';
import type {Part, World} from '../world/world';
import {Billboards} from './billboards';
import {GraphRun, type GraphFile} from './graph';
import {WorldHost} from './host';
import type {Value} from './operations';
import {Scripts, scriptsOf} from './scripts';
import {Sounds, soundsOf} from './sounds';

const secondsBetween = 1;  // events for the page that no click has caused

/// Nodes of VRML that do something and are not in the graph.
const notRun = /^(Script|Sound|SpatialSound|AudioClip|MovieTexture|PlaneSensor|SphereSensor|CylinderSensor|KeySensor|StringSensor|LoadSensor|.*(Chaser|Damper|Follower|PickSensor|Emitter))$/;

export interface ForThePage {
  /// An event that the page has to act upon: viewpoint:NAME, open:URL.
  told(id: string): void;
  changed(): void;
  /// The graph was switched off, for it is faulty; or a Script is.
  failed(): void;
}

export class Behaviour {
  running = false;
  fault = '';  // why it was switched off
  private readonly graph: GraphFile | null;
  private readonly billboards: Billboards;
  readonly programs: ReturnType<typeof scriptsOf>;  // Scripts that can be run
  private scripts: Scripts | null = null;
  private readonly audible: ReturnType<typeof soundsOf>;
  sounds: Sounds | null = null;  // while the world runs
  private run: GraphRun | null = null;
  private host: WorldHost | null = null;
  private over: readonly number[] = [];
  private clicked = false;  // what happens is by a click
  private time = 0;
  private toldAt = -secondsBetween;

  constructor(private readonly world: World, private readonly camera: PerspectiveCamera, private readonly page: ForThePage) {
    this.graph = graphOf(world);
    this.programs = scriptsOf(world.file, this.graph);
    this.billboards = new Billboards(world);
    this.audible = soundsOf(world.file);
  }

  /// Is there anything that can be run?
  get any(): boolean { return this.graph !== null || this.billboards.any || this.hasSounds; }
  get hasSounds(): boolean { return this.audible.length > 0; }

  /// Types of nodes that do something which the page does not run, and how many there are.
  get lost(): [string, number][] {
    const found = new Map<string, number>();
    for (const [node, {extras}] of (this.world.file.nodes ?? []).entries()) {
      const type = typeOf(extras) ?? '';
      if (notRun.test(type) && ![...this.programs, ...this.audible].some(p => p.node === node)) found.set(type, (found.get(type) ?? 0) + 1);
    }
    return [...found].sort(([a], [b]) => a.localeCompare(b));
  }

  set(on: boolean): void {
    this.running = on;
    this.fault = '';
    this.over = [];
    this.host?.restore();
    this.runScripts(false);
    this.sounds?.dispose();
    this.sounds = on ? new Sounds(this.audible, node => this.world.parts.find(p => p.node === node)?.object ?? null, () => this.heard()) : null;
    this.run = this.host = null;
    if (on && this.graph) this.guard(() => this.begin(this.graph!));
    if (!on) this.billboards.rest();
    this.page.changed();
  }

  /// A sound can be heard, which is as loud as the next picture says, or cannot.
  private heard(): void {
    this.page.failed();
    this.page.changed();
  }

  /// Runs its Scripts as well, while the world runs: programs of the file.
  runScripts(on: boolean): void {
    this.scripts?.dispose();
    this.scripts = null;
    if (!on || !this.run) return;
    this.scripts = new Scripts(this.programs, (id, value) => this.guard(() => this.run?.receive(id, value)), () => this.page.failed());
  }

  get runsScripts(): boolean { return this.scripts !== null; }
  /// What Scripts could not do.
  get scriptFaults(): readonly string[] { return this.scripts?.faults ?? []; }

  private begin(graph: GraphFile): void {
    this.host = new WorldHost(this.world, this.camera, (id, value) => this.tell(id, value), () => this.page.changed());
    this.run = new GraphRun(graph, this.host);
    this.host.remember(this.run.pointersSet);
    this.run.start();
  }

  /// A file from elsewhere may ask in each picture: only a click leads out of the page, and the camera is moved now and then.
  private tell(id: string, value: Value): void {
    if (id.startsWith('to-script:')) return this.scripts?.tell(id, value);
    if (id.startsWith('sound:')) return this.sounds?.receive(id, value);
    if (!this.clicked && (id.startsWith('open:') || this.time - this.toldAt < secondsBetween)) return;
    this.toldAt = this.time;
    this.page.told(id);
  }

  /// A graph that is faulty is switched off.
  private guard(act: () => void): void {
    try {
      act();
    } catch (error) {
      this.set(false);
      this.fault = error instanceof Error ? error.message : String(error);
      this.page.failed();
    }
  }

  /// Time goes on; true as long as another picture is wanted.
  tick(seconds: number): boolean {
    if (!this.running) return false;
    this.time += seconds;
    this.guard(() => {
      this.host?.players.tick(seconds);
      this.run?.tick(seconds);
    });
    return this.run !== null;
  }

  /// Before each picture.
  draw(): void {
    if (!this.running) return;
    this.billboards.face(this.camera);
    this.sounds?.place(this.camera);
  }

  /// True when something has heard the click.
  click(part: Part | null): boolean {
    let heard = false;
    const way = wayUp(part);
    this.clicked = true;
    this.guard(() => { heard = (this.host?.selects(way) && this.run?.select(way)) ?? false; });
    this.clicked = false;
    return heard;
  }

  /// The pointer is over that part.
  hover(part: Part | null): void {
    const found = wayUp(part), before = this.over, way = this.host?.hovers(found) ? found : [];
    this.over = way;
    this.guard(() => {
      this.run?.hover(before.filter(node => !way.includes(node)), false);
      this.run?.hover(way.filter(node => !before.includes(node)), true);
    });
  }

  get hovers(): boolean { return this.run !== null && (this.graph?.declarations ?? []).some(d => d.op === 'event/onHoverIn'); }
}

function graphOf(world: World): GraphFile | null {
  const said = world.file.extensions?.['KHR_interactivity'] as {graphs?: GraphFile[]; graph?: number} | undefined;
  return said?.graphs?.[said.graph ?? 0] ?? null;
}

/// Whether anything may be moved but by animations.
export function moves(world: World): boolean {
  const pointers = JSON.stringify(graphOf(world)?.nodes ?? []);
  return /"\/nodes\/\d+\/(translation|rotation|scale)"/.test(pointers) || new Billboards(world).any;
}

/// From a part to the root, as numbers of nodes.
function wayUp(part: Part | null): number[] {
  const way: number[] = [];
  for (let p = part; p; p = p.parent) way.push(p.node);
  return way;
}
