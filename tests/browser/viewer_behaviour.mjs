// The viewer page runs what worlds do: the same worlds as behaviour.mjs, clicked by the mouse; Anchors, Billboards, and what cannot run.
//   node viewer_behaviour.mjs WRLKIT FOLDER
import assert from 'node:assert';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import {box, hidden_levels, is_color, worlds} from './behaviour_worlds.mjs';
import {open_page, start_chromium, wrlkit} from './viewer_page.mjs';

const [program, folder] = process.argv.slice(2);
fs.mkdirSync(folder, {recursive: true});
const browser = await start_chromium();

async function open_world(name, text, fragment = '#panel=view') {
  const file = path.join(folder, `${name}.x3dv`), html = path.join(folder, `${name}.html`);
  fs.writeFileSync(file, text);
  wrlkit(program, 'view', '-q', file, '-o', html, '--criteria', 'quadric');
  return open_page(browser, html, {fragment, dark: true});
}

/// In the page: time goes on as the test says, and what is seen at points of the world.
const in_page = {
  hold: () => { window.viewer.mode.stage.invalidate = () => undefined; },
  pass: seconds => {
    const {mode} = window.viewer;
    for (let t = 0; t < seconds; t += 0.016) mode.behaviour.tick(0.016);
  },
  look: ({eye, target}) => {
    const {stage} = window.viewer.mode, {position} = stage.camera;
    stage.camera.position.fromArray(eye);
    stage.camera.lookAt(...target);
    stage.navigator.take(position.clone(), stage.camera.quaternion.clone(), 10);
    stage.drawNow();
  },
  pixel: point => {
    const {stage} = window.viewer.mode, {camera} = stage, box = stage.canvas.getBoundingClientRect();
    const at = camera.position.clone().fromArray(point).project(camera);
    return [box.left + (at.x + 1) / 2 * box.width, box.top + (1 - at.y) / 2 * box.height];
  },
  state: ({points, nodes}) => {
    const {mode} = window.viewer, {stage} = mode, copy = document.createElement('canvas');
    stage.drawNow();
    [copy.width, copy.height] = [stage.canvas.width, stage.canvas.height];
    const pen = copy.getContext('2d', {willReadFrequently: true});
    pen.drawImage(stage.canvas, 0, 0);
    const color = point => {
      const at = stage.camera.position.clone().fromArray(point).project(stage.camera);
      return [...pen.getImageData(Math.round((at.x + 1) / 2 * copy.width), Math.round((1 - at.y) / 2 * copy.height), 1, 1).data].slice(0, 3);
    };
    const place = name => mode.world.parts.find(p => p.name === name).object.getWorldPosition(stage.camera.position.clone()).toArray();
    return {colors: points.map(color), places: nodes.map(place)};
  },
};

async function runs(world) {
  const {page, faults, close} = await open_world(world.name, world.world);
  const state = () => page.evaluate(in_page.state, {points: world.points, nodes: world.nodes ?? []});
  await page.evaluate(in_page.hold);
  await page.getByLabel('Run the world').check();
  await page.evaluate(in_page.pass, 0.1);
  const states = [await state()];
  for (const step of world.steps) {
    if (step.camera) await page.evaluate(in_page.look, step.camera);
    if (step.click) await page.mouse.click(...await page.evaluate(in_page.pixel, step.click));
    if (step.over) await page.mouse.move(...await page.evaluate(in_page.pixel, step.over));
    await page.evaluate(in_page.pass, step.wait ?? 0.1);
    states.push(await state());
  }
  const lights = world.name === 'light';  // the page shines a little by itself
  world.expect.forEach((letters, step) => [...lights ? '' : letters ?? ''].forEach((letter, i) =>
    assert(is_color(states[step].colors[i], letter), `${world.name}, step ${step}, point ${i}: ${states[step].colors[i]} is not '${letter}'`)));
  if (lights) assert(states[1].colors[0][0] > states[0].colors[0][0] + 30, `${states.map(s => s.colors[0])}`);
  world.places?.forEach((place, step) => {
    if (place) assert(states[step].places[0].every((v, i) => Math.abs(v - place[i]) < 0.02), `${world.name}, step ${step}: ${states[step].places[0]}`);
  });
  assert.deepEqual(faults, [], world.name);
  await close();
}

/// An Anchor to a Viewpoint goes there; one to another file asks first. Off, a click selects as ever.
async function anchors() {
  const {page, faults, close} = await open_world('anchors', worlds.find(w => w.name === 'anchors').world);
  const click = async point => page.mouse.click(...await page.evaluate(in_page.pixel, point));
  const eye = () => page.evaluate(() => window.viewer.mode.stage.camera.position.toArray());
  await click([2, 0, 0]);
  assert.equal(await page.locator('.part[aria-selected=true]').count(), 1);
  await page.getByRole('tab', {name: 'View'}).click();
  await page.getByLabel('Run the world').check();
  await click([2, 0, 0]);
  assert.match(await page.locator('dialog.open').textContent(), /manual\.html/);
  assert.equal(await page.locator('dialog.open a').getAttribute('target'), '_blank');
  await page.getByRole('button', {name: 'Stay here'}).click();
  assert.equal(await page.locator('dialog.open').count(), 0);
  await click([-2, 0, 0]);
  assert((await eye())[2] < -9);
  assert.deepEqual(faults, []);
  await close();
}

/// Colours change as ColorInterpolators say.
async function colours() {
  const text = `#X3D V3.3 utf8\nPROFILE Immersive\nViewpoint { position 0 0 10 }\nNavigationInfo { headlight FALSE }
    Transform { translation -2 0 0 children [ DEF Touch TouchSensor {} ${box('w')} ] }
    Transform { translation 2 0 0 children Shape { appearance Appearance { material DEF Paint Material { diffuseColor 0 0 0 emissiveColor 1 0 0 } } geometry Box { size 1 1 1 } } }
    DEF Clock TimeSensor { cycleInterval 0.4 } DEF Mix ColorInterpolator { key [ 0 1 ] keyValue [ 1 0 0 0 1 0 ] }
    ROUTE Touch.touchTime TO Clock.startTime\nROUTE Clock.fraction_changed TO Mix.set_fraction\nROUTE Mix.value_changed TO Paint.emissiveColor\n`;
  const {page, faults, close} = await open_world('colours', text);
  const shows = async letter => is_color((await page.evaluate(in_page.state, {points: [[2, 0, 0]], nodes: []})).colors[0], letter);
  await page.evaluate(in_page.hold);
  await page.getByLabel('Run the world').check();
  assert(await shows('r'));
  await page.mouse.click(...await page.evaluate(in_page.pixel, [-2, 0, 0]));
  await page.evaluate(in_page.pass, 0.6);
  assert(await shows('g'));
  assert.deepEqual(faults, []);
  await close();
}

/// A Billboard turns to the viewer while the world runs; what does not run is named.
async function billboard_and_list() {
  const text = `#X3D V3.3 utf8\nPROFILE Immersive\nViewpoint { position 0 0 10 }\nBillboard { children ${box('r', '2 2 0.01')} }
    Script { url "ecmascript: function initialize() {}" } Sound { source AudioClip { url "bell.wav" } }\n`;
  const {page, faults, close} = await open_world('billboard', text);
  await page.evaluate(in_page.hold);
  assert.equal(await page.locator('#not-run').textContent(), 'Not run here: Script, Sound.');
  const seen = async () => is_color((await page.evaluate(in_page.state, {points: [[0, 0, 0.9]], nodes: []})).colors[0], 'r');
  await page.evaluate(in_page.look, {eye: [10, 0, 0], target: [0, 0, 0]});
  assert(!await seen());
  await page.getByLabel('Run the world').check();
  assert(await seen());
  assert.deepEqual(faults, []);
  await close();
}

/// A second of silence as a file.
function wav() {
  const rate = 8000, samples = Buffer.alloc(2 * rate), header = Buffer.alloc(44);
  header.write('RIFF', 0);
  header.writeUInt32LE(36 + samples.length, 4);
  header.write('WAVEfmt ', 8);
  header.writeUInt32LE(16, 16);
  for (const [at, value] of [[20, 1], [22, 1], [32, 2], [34, 16]]) header.writeUInt16LE(value, at);
  header.writeUInt32LE(rate, 24);
  header.writeUInt32LE(2 * rate, 28);
  header.write('data', 36);
  header.writeUInt32LE(samples.length, 40);
  return Buffer.concat([header, samples]);
}

/// Sounds are off until the user says so; one that repeats is heard as its ellipsoids say, one more by a click, and a file that is none is named.
async function sounds() {
  fs.writeFileSync(path.join(folder, 'hum.wav'), wav());
  fs.writeFileSync(path.join(folder, 'bad.wav'), 'RIFF, but no sound');
  const sound = (name, file, more = '') => `DEF ${name} Sound { minFront 2 minBack 2 maxFront 22 maxBack 22 source DEF ${name}Clip AudioClip { url "${file}" ${more} } }`;
  const text = `#X3D V3.3 utf8\nPROFILE Immersive\nViewpoint { position 0 0 10 }
    Transform { translation -2 0 0 children [ DEF Touch TouchSensor {} ${box('r')} ${sound('Hum', 'hum.wav', 'loop TRUE')} ] }
    Transform { translation 2 0 0 children [ DEF Off TouchSensor {} ${box('g')} ] }
    Transform { scale 2 2 2 children [ ${sound('Bell', 'hum.wav')} ${sound('Bad', 'bad.wav')} ${sound('Gone', 'gone.wav')} ] }
    ROUTE Touch.touchTime TO BellClip.startTime\nROUTE Off.touchTime TO HumClip.stopTime\n`;
  const {page, faults, close} = await open_world('sounds', text);
  const playing = () => page.evaluate(() => {
    window.viewer.mode.stage.drawNow();
    return window.viewer.mode.behaviour.sounds.playing;
  });
  const becomes = async (names, what) => {
    const until = Date.now() + 30_000;
    while ((await playing()).map(s => s.name).join() !== names) assert(Date.now() < until, `${what}: ${JSON.stringify(await playing())}`);
  };
  assert.equal(await page.locator('#not-run').textContent(), 'Not run here: Sound.');
  await page.getByLabel('Run the world').check();
  assert.deepEqual(await playing(), []);
  await page.getByLabel('Play its sounds').check();
  await becomes('Hum', 'at first');
  await page.waitForFunction(() => document.querySelector('#sound-faults')?.textContent === 'Bad: the browser cannot decode it');
  await page.evaluate(in_page.look, {eye: [-2, 0, 12], target: [-2, 0, 0]});
  assert(Math.abs((await playing())[0].gain - 10 ** -0.5) < 1e-6, 'half way between the ellipsoids');
  await page.evaluate(in_page.look, {eye: [-2, 0, 30], target: [-2, 0, 0]});
  assert.equal((await playing())[0].gain, 0);
  await page.evaluate(in_page.look, {eye: [0, 0, 10], target: [0, 0, 0]});
  await page.mouse.click(...await page.evaluate(in_page.pixel, [-2, 0, 0]));
  await becomes('Hum,Bell', 'by a click');
  await becomes('Hum', 'after a second');
  await page.mouse.click(...await page.evaluate(in_page.pixel, [2, 0, 0]));
  await becomes('', 'stopped');
  await page.getByLabel('Play its sounds').uncheck();
  await page.getByLabel('Run the world').uncheck();
  assert(!await page.getByLabel('Play its sounds').isChecked());
  assert.deepEqual(faults, []);
  await close();
}

/// A world that only sounds is drawn again when they are there, and is as loud as that picture says.
async function only_a_sound() {
  const text = `#X3D V3.3 utf8\nPROFILE Immersive\nViewpoint { position 0 0 10 }\n${box('r')} Sound { maxFront 99 maxBack 99 source AudioClip { url "hum.wav" loop TRUE } }\n`;
  const {page, faults, close} = await open_world('only_a_sound', text);
  await page.getByLabel('Run the world').check();
  await page.getByLabel('Play its sounds').check();
  await page.waitForFunction(() => window.viewer.mode.behaviour.sounds.playing[0]?.gain > 0.5, undefined, {timeout: 30_000});
  assert.deepEqual(faults, []);
  await close();
}

/// Off again, the world is as it was; a link runs nothing.
async function off_and_on() {
  const {page, faults, close} = await open_world('off_and_on', worlds.find(w => w.name === 'switch').world, '#panel=view&run=1');
  const seen = async letter => is_color((await page.evaluate(in_page.state, {points: [[2, 0, 0]], nodes: []})).colors[0], letter);
  assert(!await page.getByLabel('Run the world').isChecked());
  assert(!await page.evaluate(() => window.viewer.mode.behaviour.running));
  for (let i = 0; i < 2; ++i) {
    await page.getByLabel('Run the world').check();
    assert(await seen('r'));
    await page.mouse.click(...await page.evaluate(in_page.pixel, [-2, 0, 0]));
    await page.evaluate(in_page.pass, 0.1);
    assert(await seen('b'));
    await page.getByLabel('Run the world').uncheck();
    assert(await seen('r'));
  }
  assert.deepEqual(faults, []);
  await close();
}

/// A Switch of red, green and blue that a Script turns; `n` is its field.
const scripted = (program, fields = '') => `#X3D V3.3 utf8\nPROFILE Immersive\nViewpoint { position 0 0 10 }\nNavigationInfo { headlight FALSE }
  Transform { translation -2 0 0 children [ DEF Touch TouchSensor {} ${box('w')} ] }
  Transform { translation 2 0 0 children DEF Lamp Switch { whichChoice 0 children [ ${box('r')} ${box('g')} ${box('b')} ] } }
  DEF Slider Transform { translation 0 2 0 children ${box('w')} }
  DEF S Script { inputOnly SFTime press inputOnly SFBool over outputOnly SFInt32 choice outputOnly SFVec3f place initializeOnly SFInt32 n 1 ${fields}
    url "ecmascript: ${program}" }
  ROUTE Touch.touchTime TO S.press\nROUTE Touch.isActive TO S.over\nROUTE S.choice TO Lamp.whichChoice\nROUTE S.place TO Slider.translation\n`;

/// Scripts run when the user says so, one click later than the world, and are ended with it; what they do wrong is named.
async function scripts() {
  const program = `function initialize() { choice = n; } function press(value, time) { n = n + 1; choice = n; place = new SFVec3f(1, n, 0).add(place);
    if (value !== time && Math.abs(value - Date.now() / 1000) > 60) choice = 0; } function over(on) { if (!on) Lamp.whichChoice = 1; }`;
  const {page, faults, close} = await open_world('scripts', scripted(program));
  const state = () => page.evaluate(in_page.state, {points: [[2, 0, 0]], nodes: ['Slider']});
  const shows = async letter => {
    const until = Date.now() + 30_000;
    while (!is_color((await state()).colors[0], letter)) assert(Date.now() < until, `not '${letter}'`);
  };
  const lamp = page.getByLabel('Run its Scripts');
  assert(await lamp.isDisabled());
  await page.getByLabel('Run the world').check();
  assert(is_color((await state()).colors[0], 'r'));
  assert.equal(await page.locator('iframe').count(), 0);
  await lamp.check();
  await shows('g');
  await page.mouse.click(...await page.evaluate(in_page.pixel, [-2, 0, 0]));
  await shows('b');
  assert.deepEqual((await state()).places[0], [1, 2, 0]);
  await page.waitForFunction(() => document.querySelector('#script-faults')?.textContent.includes('S reports ReferenceError: Lamp'));
  await page.getByLabel('Run the world').uncheck();
  assert.equal(await page.locator('iframe').count(), 0);
  assert(is_color((await state()).colors[0], 'r'));
  assert.deepEqual(faults, []);
  await close();
}

/// With directOutput a Script reads and sets the nodes that it holds; its program is in a file beside the world. What it may not do is named.
async function held_nodes() {
  fs.writeFileSync(path.join(folder, 'held.js'), `function press() { var at = slider.translation; at.x = at.x + 1; slider.translation = at;
    lamp[0].whichChoice = lamp[0].whichChoice + 2; turned.rotation = new SFRotation(0, 0, 1, 1.5707963); }
    function over(on) { if (!on) paint.diffuseColor = new SFColor(1, 1, 1); else try { Browser.createVrmlFromString('Group {}'); } catch (e) { reason = e.message; } }`);
  const fields = `directOutput TRUE initializeOnly SFNode slider USE Slider initializeOnly MFNode lamp [ USE Lamp USE Slider ] initializeOnly SFNode turned USE Slider
    initializeOnly SFNode paint DEF Paint Material { diffuseColor 1 0 0 } initializeOnly SFString reason ""`;
  const {page, faults, close} = await open_world('held_nodes', scripted('', fields).replace('ecmascript: ', 'held.js'));
  const state = () => page.evaluate(in_page.state, {points: [[2, 0, 0]], nodes: ['Slider']});
  await page.getByLabel('Run the world').check();
  await page.getByLabel('Run its Scripts').check();
  const until = Date.now() + 30_000;
  while (!is_color((await state()).colors[0], 'b')) {
    assert(Date.now() < until, 'the Script sets nothing');
    if (is_color((await state()).colors[0], 'r')) await page.mouse.click(...await page.evaluate(in_page.pixel, [-2, 0, 0]));
    await page.waitForTimeout(300);
  }
  assert.deepEqual((await state()).places[0], [1, 2, 0]);
  await page.waitForFunction(() => document.querySelector('#script-faults')?.textContent.includes('S reports Error: diffuseColor of Material cannot be set'));
  assert.deepEqual(faults, []);
  await close();
}

/// A Script that does not end is ended, one that asks for the network or the page gets nothing, one with a fault is named; the page goes on.
async function hostile_scripts() {
  let asked = 0;
  const server = http.createServer((_, response) => {
    ++asked;
    response.writeHead(200, {'Access-Control-Allow-Origin': '*', 'Content-Type': 'text/javascript'}).end('1');
  }).listen(0, '127.0.0.1');
  await new Promise(done => { server.once('listening', done); });
  const site = `http://127.0.0.1:${server.address().port}`;
  const worlds = {
    endless: ['function press() { for (;;); }', 'S was stopped because it ran for more than 1 s'],
    endless_at_first: ['while (true) {} function press() {}', 'S was stopped because it ran for more than 1 s'],
    faulty: ['function press( { }', 'S cannot be run: '],
    network: [`function press() { var said = [];
      try { importScripts('${site}/x.js'); said.push('loaded'); } catch (e) { said.push('no import'); }
      try { var r = new XMLHttpRequest(); r.open('GET', '${site}/', false); r.send(); said.push('got'); } catch (e) { said.push('no request'); }
      try { eval('1'); said.push('eval'); } catch (e) { said.push('no eval'); }
      try { said.push(typeof document + typeof localStorage); indexedDB.open('x'); said.push('kept'); } catch (e) { said.push('no storage'); }
      try { fetch('${site}/').catch(function () {}); said.push('fetch'); } catch (e) { said.push('no fetch'); }
      import('${site}/x.js').catch(function () {});
      said.push([typeof WebSocket, typeof Worker, typeof navigator, typeof self, typeof globalThis.constructor.prototype.dispatchEvent].join(' '));
      throw new Error(said.join()); }`, 'no import,no request,no eval,undefinedundefined,no storage,no fetch,undefined undefined undefined undefined undefined'],
  };
  for (const [name, [program, expected]] of Object.entries(worlds)) {
    const {page, faults, close} = await open_world(`script_${name}`, scripted(program));
    await page.getByLabel('Run the world').check();
    await page.getByLabel('Run its Scripts').check();
    const told = () => page.waitForFunction(text => document.querySelector('#script-faults')?.textContent.includes(text), expected, {timeout: 1500});
    for (let i = 0; ; ++i) {
      await page.mouse.click(...await page.evaluate(in_page.pixel, [-2, 0, 0]));
      if (await told().then(() => true, () => false)) break;
      assert(i < 20, `${name}: ${await page.locator('#script-faults').textContent()}`);
    }
    assert.deepEqual(faults.filter(f => !/Content Security Policy|violates|Refused to|asks for (http|ws):..127/.test(f)), [], name);
    await close();
  }
  assert.equal(asked, 0);
  server.close();
}

/// A Script that goes on after its answer, that would answer by itself, say too much or leave its function: all in one world, beside one that sends
/// an event very often, of which the first counts.
async function scripts_that_outlive_their_calls() {
  const programs = {
    Later: ['Promise.resolve().then(function () { for (;;); });', 'Later was stopped because it ran for more than 1 s'],
    Leaver: ['return {}; }); (function () {', 'Leaver cannot be run: Uncaught SyntaxError: Unexpected token'],
    Timer: ['function press() { setInterval(function () { for (;;); }, 0); }', 'Timer reports ReferenceError: setInterval is not defined'],
    Forger: [`function press() { postMessage('{}'); for (;;); }`, 'Forger reports ReferenceError: postMessage is not defined'],
    Talker: [`function press() { throw new Error('x'.repeat(2000000)); }`, 'Talker was stopped because it sent more than 1000000 characters at once'],
  };
  const flood = `function press() { Array.prototype.map = function () { var all = [];
    for (var i = 0; i < 20000; ++i) all.push({name: 'choice', value: i ? 1 : 2}); return all; }; }`;
  const others = Object.entries(programs).map(([name, [program]]) =>
    `DEF ${name} Script { inputOnly SFTime press outputOnly SFInt32 choice url "ecmascript: ${program}" }
      ROUTE Touch.touchTime TO ${name}.press\nROUTE ${name}.choice TO Lamp.whichChoice\n`);
  const {page, faults, close} = await open_world('script_outlives', scripted(flood) + others.join(''));
  const told = list => page.waitForFunction(texts => texts.every(t => document.querySelector('#script-faults')?.textContent.includes(t)),
    list.map(name => programs[name][1]), {timeout: 30_000});
  await page.getByLabel('Run the world').check();
  await page.getByLabel('Run its Scripts').check();
  await told(['Later', 'Leaver']);  // before any event, so no call is being waited for
  await page.mouse.click(...await page.evaluate(in_page.pixel, [-2, 0, 0]));
  await told(Object.keys(programs));
  const until = Date.now() + 10_000;
  const color = async () => (await page.evaluate(in_page.state, {points: [[2, 0, 0]], nodes: []})).colors[0];
  while (!is_color(await color(), 'b')) assert(Date.now() < until, `not 'b': ${await color()}`);
  assert.doesNotMatch(await page.locator('#script-faults').textContent(), /\bS (was|reports|cannot)/);
  assert.deepEqual(faults, []);
  await close();
}

try {
  await scripts();
  await held_nodes();
  await hostile_scripts();
  await scripts_that_outlive_their_calls();
  for (const world of [...worlds, hidden_levels]) if (!world.events) await runs(world);
  await colours();
  await anchors();
  await billboard_and_list();
  await sounds();
  await only_a_sound();
  await off_and_on();
  console.log(`${worlds.length} worlds`);
} finally {
  await browser.close();
}
