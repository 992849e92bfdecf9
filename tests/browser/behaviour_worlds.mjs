// Worlds that do something, one for each thing that KHR_interactivity can say; with what is done to them and what must be seen then.
// A world is seen from z = 10; `points` are looked at after each step, and `expect` has a letter for the colour at each.

const x3d = body => `#X3D V3.3 utf8\nPROFILE Immersive\nViewpoint { position 0 0 10 }\nNavigationInfo { headlight FALSE }\n${body}\n`;
const paint = {r: '1 0 0', g: '0 1 0', b: '0 0 1', w: '1 1 1'};
export const box = (color, size = '1 1 1') => `Shape { appearance Appearance { material Material { diffuseColor 0 0 0 emissiveColor ${paint[color]} } } geometry Box { size ${size} } }`;
const at = (place, ...children) => `Transform { translation ${place} children [ ${children.join(' ')} ] }`;
const routes = text => text.trim().split(/\s*,\s*/).map(r => `ROUTE ${r.replace('>', ' TO ')}`).join('\n');
/// White, to be clicked, at x = -2.
const button = (name = 'Touch', place = '-2 0 0') => at(place, `DEF ${name} TouchSensor {}`, box('w'));
/// Red, green and blue, one of them, at x = 2.
const lamp = at('2 0 0', `DEF Lamp Switch { whichChoice 0 children [ ${box('r')} ${box('g')} ${box('b')} ] }`);
const pressed = {click: [-2, 0, 0]}, lit = [[2, 0, 0]];
const far = {eye: [0, 0, 10], target: [0, 0, 0]};
const clock = (text = '') => `DEF Clock TimeSensor { cycleInterval 0.4 ${text} }`;
const slide = 'DEF Way PositionInterpolator { key [ 0 1 ] keyValue [ 2 0 0, 2 2 0 ] }';
const sliding = `DEF Slider Transform { translation 2 0 0 children ${box('g')} }`;
const moving = 'Clock.fraction_changed>Way.set_fraction, Way.value_changed>Slider.set_translation';
const integer = (n, name = `I${n}`) => `DEF ${name} IntegerTrigger { integerKey ${n} }`;

export const worlds = [
  {name: 'switch', points: lit, steps: [pressed], expect: ['r', 'b'],
    world: x3d(`${button()} ${lamp} DEF T BooleanTrigger {} ${integer(2)}
      ${routes('Touch.touchTime>T.set_triggerTime, T.triggerTrue>I2.set_boolean, I2.triggerValue>Lamp.set_whichChoice')}`)},
  {name: 'toggle', points: lit, steps: [pressed, pressed, pressed], expect: ['r', 'g', 'r', 'g'],
    world: x3d(`${button()} ${lamp} DEF T BooleanTrigger {} DEF Keep BooleanToggle {} DEF F BooleanFilter {} DEF N BooleanTrigger {} DEF When TimeTrigger {} ${integer(1)} ${integer(0)}
      ${routes(`Touch.touchTime>T.set_triggerTime, T.triggerTrue>Keep.set_boolean, Keep.toggle_changed>F.set_boolean, F.inputTrue>I1.set_boolean, F.inputFalse>When.set_boolean,
        When.triggerTime>N.set_triggerTime, N.triggerTrue>I0.set_boolean, I1.triggerValue>Lamp.set_whichChoice, I0.triggerValue>Lamp.set_whichChoice`)}`)},
  {name: 'sequence', points: lit, steps: [pressed, pressed, pressed], expect: ['r', 'g', 'b', 'r'],
    world: x3d(`${button()} ${lamp} DEF Next IntegerSequencer { key [ 0 0.5 1 ] keyValue [ 0 1 2 ] }
      ${routes('Touch.isActive>Next.next, Next.value_changed>Lamp.set_whichChoice')}`)},
  {name: 'animation', points: [[2, 0, 0], [2, 2, 0]], nodes: ['Slider'], steps: [{wait: 0.5}, {...pressed, wait: 0.8}, {...pressed, wait: 0.2}], expect: ['g.', 'g.', '.g', null],
    world: x3d(`${button()} ${sliding} ${clock()} ${slide} ${routes(`Touch.touchTime>Clock.set_startTime, ${moving}`)}`)},
  {name: 'start_and_stop', points: [[-2, 0, 0]], nodes: ['Slider'], steps: [{...pressed, wait: 0.7}, {click: [-2, -2, 0], wait: 0.1}, {wait: 0.4}], expect: ['w', 'w', 'w', 'w'], moves: [false, true, null, false],
    world: x3d(`${button()} ${button('Halt', '-2 -2 0')} ${sliding} ${clock('loop TRUE stopTime 1')} ${slide}
      ${routes(`Touch.touchTime>Clock.set_startTime, Halt.touchTime>Clock.set_stopTime, ${moving}`)}`)},
  {name: 'enabled', points: [], nodes: ['Slider'], steps: [{wait: 0.3}, {...pressed, wait: 0.1}, {wait: 0.3}], expect: ['', '', '', ''], moves: [null, true, null, false],
    world: x3d(`${button()} ${sliding} ${clock('loop TRUE')} ${slide} DEF Run BooleanToggle { toggle TRUE } DEF T BooleanTrigger {}
      ${routes(`Touch.touchTime>T.set_triggerTime, T.triggerTrue>Run.set_boolean, Run.toggle_changed>Clock.set_enabled, ${moving}`)}`)},
  {name: 'clock_and_sequencer', points: lit, steps: [{...pressed, wait: 0.15}, {wait: 0.5}], expect: ['r', 'g', 'b'],
    world: x3d(`${button()} ${lamp} DEF Clock TimeSensor { cycleInterval 0.5 } DEF Show IntegerSequencer { key [ 0 0.6 ] keyValue [ 1 2 ] }
      ${routes('Touch.touchTime>Clock.set_startTime, Clock.fraction_changed>Show.set_fraction, Show.value_changed>Lamp.set_whichChoice')}`)},
  {name: 'proximity', points: lit, steps: [{camera: {eye: [0, 0, 5], target: [0, 0, 0]}}, {camera: far}], expect: ['r', 'g', 'r'], nodes: ['Follower'], places: [null, [0, 3, 5], [0, 3, 5]],
    world: x3d(`${at('0 0 4', 'DEF Near ProximitySensor { size 4 4 4 }')} ${lamp} DEF F BooleanFilter {} DEF T BooleanTrigger {} ${integer(1)} ${integer(0)}
      ${at('0 3 4', `DEF Follower Transform { translation 0 0 -9 children ${box('b')} }`)}
      ${routes(`Near.isActive>F.set_boolean, F.inputTrue>I1.set_boolean, Near.exitTime>T.set_triggerTime, T.triggerTrue>I0.set_boolean, Near.position_changed>Follower.set_translation,
        I1.triggerValue>Lamp.set_whichChoice, I0.triggerValue>Lamp.set_whichChoice`)}`)},
  {name: 'visibility', points: [], events: ['viewpoint:Seen', 'viewpoint:Lost'], steps: [{camera: {eye: [0, 0, 10], target: [0, 0, 20]}}, {camera: far}], expect: ['', '', ''],
    sent: [['viewpoint:Seen'], ['viewpoint:Seen', 'viewpoint:Lost'], ['viewpoint:Seen', 'viewpoint:Lost', 'viewpoint:Seen']],
    world: x3d(`DEF See VisibilitySensor { size 2 2 2 } ${box('g')} DEF F BooleanFilter {} DEF Seen Viewpoint { description "Seen" } DEF Lost Viewpoint { description "Lost" }
      ${routes('See.isActive>F.set_boolean, F.inputTrue>Seen.set_bind, F.inputNegate>Lost.set_bind')}`)},
  {name: 'over', points: lit, steps: [{over: [-2, 0, 0]}, {over: [0, 3, 0]}], expect: ['r', 'g', 'r'],
    world: x3d(`${button()} ${lamp} DEF F BooleanFilter {} DEF When TimeTrigger {} DEF T BooleanTrigger {} ${integer(1)} ${integer(0)}
      ${routes(`Touch.isOver>F.set_boolean, F.inputTrue>I1.set_boolean, F.inputFalse>When.set_boolean, When.triggerTime>T.set_triggerTime, T.triggerTrue>I0.set_boolean,
        I1.triggerValue>Lamp.set_whichChoice, I0.triggerValue>Lamp.set_whichChoice`)}`)},
  {name: 'light', points: lit, steps: [pressed, pressed], expect: ['.', 'l', '.'],
    world: x3d(`${button()} ${at('2 0 0', 'Shape { appearance Appearance { material Material { diffuseColor 1 1 1 ambientIntensity 0 } } geometry Box { size 1 1 1 } }')}
      DEF Sun DirectionalLight { direction 0 0 -1 on FALSE } DEF T BooleanTrigger {} DEF Keep BooleanToggle {}
      ${routes('Touch.touchTime>T.set_triggerTime, T.triggerTrue>Keep.set_boolean, Keep.toggle_changed>Sun.on')}`)},
  {name: 'anchors', points: [], events: ['viewpoint:Back', 'open:manual.html', 'viewpoint:Side'], expect: ['', '', '', ''],
    steps: [{click: [-2, 0, 0]}, {click: [2, 0, 0]}, {click: [0, 2, 0]}],
    sent: [[], ['viewpoint:Back'], ['viewpoint:Back', 'open:manual.html'], ['viewpoint:Back', 'open:manual.html', 'viewpoint:Side']],
    world: x3d(`DEF Back Viewpoint { position 0 0 -10 orientation 0 1 0 3.14159 description "Back" } DEF Side Viewpoint { position 10 0 0 description "Side" }
      Anchor { url "#Back" children ${at('-2 0 0', box('r'))} } Anchor { url "manual.html" children ${at('2 0 0', box('g'))} }
      ${button('Turn', '0 2 0')} DEF T BooleanTrigger {} ${routes('Turn.touchTime>T.set_triggerTime, T.triggerTrue>Side.set_bind')}`)},
  {name: 'nested', points: [[2, 0, 0], [2, 2, 0]], steps: [pressed], expect: ['r.', 'gw'],
    world: x3d(`Group { children [ DEF Outer TouchSensor {} ${button('Touch')} ] } ${lamp} DEF Other Switch { children ${at('2 2 0', box('w'))} }
      DEF T BooleanTrigger {} DEF U BooleanTrigger {} ${integer(1)} DEF J IntegerTrigger { integerKey 2 } DEF K IntegerTrigger { integerKey 0 }
      ${routes(`Touch.touchTime>T.set_triggerTime, T.triggerTrue>I1.set_boolean, I1.triggerValue>Lamp.set_whichChoice, Outer.touchTime>U.set_triggerTime, U.triggerTrue>J.set_boolean,
        J.triggerValue>Lamp.set_whichChoice, Touch.touchTime>T.set_triggerTime, T.triggerTrue>K.set_boolean, K.triggerValue>Other.set_whichChoice`)}`)},
  // The child that is not chosen lies before the other one: it can be neither clicked nor pointed at, and is in nothing's way.
  {name: 'hidden', points: [[0, 0, 0], [2, 2, 0]], steps: [{over: [0, 0, 0]}, {click: [0, 0, 0]}, {click: [0, 0, 0]}], expect: ['r.', 'r.', 'b', 'rg'],
    world: x3d(`DEF Both Switch { whichChoice 0 children [ Group { children [ DEF Back TouchSensor {} ${box('r')} ] } ${at('0 0 2', 'DEF Front TouchSensor {}', box('b'))} ] }
      DEF Sign Switch { whichChoice -1 children ${at('2 2 0', box('g'))} } DEF T BooleanTrigger {} DEF U BooleanTrigger {} DEF F BooleanFilter {} ${integer(1)} ${integer(0)} ${integer(0, 'Shown')}
      ${routes(`Back.touchTime>T.set_triggerTime, T.triggerTrue>I1.set_boolean, I1.triggerValue>Both.set_whichChoice, Front.touchTime>U.set_triggerTime, U.triggerTrue>I0.set_boolean,
        I0.triggerValue>Both.set_whichChoice, Front.isOver>F.set_boolean, F.inputTrue>Shown.set_boolean, Shown.triggerValue>Sign.set_whichChoice`)}`)},
  // ISO/IEC 14772-1, 4.6.9: a stopTime that is not later than the startTime is ignored; a later one has passed, and the clock does not run.
  {name: 'stop_before_start', points: [], nodes: ['Slider'], steps: [{wait: 0.3}, {wait: 0.3}], expect: ['', '', ''], moves: [null, true, true],
    world: x3d(`${sliding} ${clock('loop TRUE startTime 5 stopTime 5')} ${slide} ${routes(moving)}`)},
  {name: 'stopped_at_first', points: [], nodes: ['Slider'], steps: [{wait: 0.3}, {wait: 0.3}], expect: ['', '', ''], moves: [null, false, false],
    world: x3d(`${button()} ${sliding} ${clock('loop TRUE startTime 5 stopTime 6')} ${slide} ${routes(`Touch.touchTime>Clock.set_stopTime, ${moving}`)}`)},
  // It runs once a click, however often it is clicked meanwhile: set_startTime and set_cycleInterval of an active clock are ignored.
  {name: 'ignored_while_active', points: lit, steps: [{...pressed, wait: 0.5}, {...pressed, wait: 0.3}, {wait: 0.6}], expect: ['r', 'g', 'g', 'b'],
    world: x3d(`${button()} ${lamp} DEF Clock TimeSensor { cycleInterval 1 } DEF Show IntegerSequencer { key [ 0 0.95 ] keyValue [ 1 2 ] }
      ${routes('Touch.touchTime>Clock.set_startTime, Touch.touchTime>Clock.set_cycleInterval, Clock.fraction_changed>Show.set_fraction, Show.value_changed>Lamp.set_whichChoice')}`)},
  // No longer to repeat, a clock ends with its cycle; to repeat again, it begins anew.
  {name: 'loop_ends', points: [], nodes: ['Slider'], steps: [{...pressed, wait: 0.6}, {wait: 0.2}, {...pressed, wait: 0.1}, {wait: 0.5}], expect: ['', '', '', '', ''],
    places: [null, [2, 2, 0], [2, 2, 0], null, null], moves: [null, true, false, true, true],
    world: x3d(`${button()} ${sliding} ${clock('loop TRUE')} ${slide} DEF Run BooleanToggle { toggle TRUE } DEF T BooleanTrigger {}
      ${routes(`Touch.touchTime>T.set_triggerTime, T.triggerTrue>Run.set_boolean, Run.toggle_changed>Clock.set_loop, ${moving}`)}`)},
  // Not enabled, a clock stops at once; enabled again, one that repeats goes on from its beginning.
  {name: 'enabled_again', points: [], nodes: ['Slider'], steps: [{...pressed, wait: 0.3}, {wait: 0.3}, {...pressed, wait: 0.25}, {wait: 0.1}], expect: ['', '', '', '', ''], moves: [null, null, false, true, true],
    world: x3d(`${button()} ${sliding} ${clock('loop TRUE')} ${slide} DEF Run BooleanToggle { toggle TRUE } DEF T BooleanTrigger {}
      ${routes(`Touch.touchTime>T.set_triggerTime, T.triggerTrue>Run.set_boolean, Run.toggle_changed>Clock.set_enabled, ${moving}`)}`)},
  // The viewer is told of what a Script gets.
  {name: 'script', points: lit, events: ['to-script:10:press'], steps: [pressed], expect: ['r', 'r'], sent: [[], ['to-script:10:press']],
    world: x3d(`${button()} ${lamp} DEF S Script { inputOnly SFTime press outputOnly SFInt32 choice url "ecmascript: function press() { choice = 1; }" }
      ${routes('Touch.touchTime>S.press, S.choice>Lamp.set_whichChoice')}`)},
];

/// Levels of detail that a Switch hides, of which the page would show one.
export const hidden_levels = {name: 'hidden_levels', points: lit, steps: [pressed, pressed], expect: ['.', 'g', '.'],
  world: x3d(`${button()} ${at('2 0 0', `DEF Lamp Switch { whichChoice -1 children LOD { range 50 children [ ${box('g')} ${box('r')} ] } }`)}
    DEF T BooleanTrigger {} DEF Keep BooleanToggle {} DEF F BooleanFilter {} ${integer(0)} DEF N BooleanTrigger {} DEF When TimeTrigger {} ${integer(-1, 'None')}
    ${routes(`Touch.touchTime>T.set_triggerTime, T.triggerTrue>Keep.set_boolean, Keep.toggle_changed>F.set_boolean, F.inputTrue>I0.set_boolean, I0.triggerValue>Lamp.set_whichChoice,
      F.inputFalse>When.set_boolean, When.triggerTime>N.set_triggerTime, N.triggerTrue>None.set_boolean, None.triggerValue>Lamp.set_whichChoice`)}`)};

const letters = {r: [1, 0, 0], g: [0, 1, 0], b: [0, 0, 1], w: [1, 1, 1], l: [1, 1, 1], '.': [0, 0, 0]};
/// Whether a colour is that of the letter: by which of its parts are bright.
export const is_color = (color, letter) => color.every((v, i) => (v > 100) === (letters[letter][i] > 0));
