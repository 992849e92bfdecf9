// From where a world is looked at: its first Viewpoint, which is the first camera of its glTF, or a place from which all of
// it is seen.
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';

/// {camera, flags}: for the page (show.mjs) and for wrlkit render. `glb` is what the world was converted to.
export function view_of(wrlkit, file, glb, from_viewpoint) {
  if (from_viewpoint && has_camera(glb)) return {camera: 0, flags: []};
  const camera = look_at_box(bounds_of(wrlkit, file));
  return {camera, flags: ['--look-at', [camera.eye, camera.target, camera.up].join(',')]};
}

/// The JSON of a .glb says so.
function has_camera(glb) {
  const bytes = fs.existsSync(glb) ? fs.readFileSync(glb) : Buffer.alloc(20);
  const json = bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString();
  return json !== '' && (JSON.parse(json).cameras?.length ?? 0) > 0;
}

function bounds_of(wrlkit, file) {
  const command = ['info', '-q', '--json', file];
  try {
    return JSON.parse(execFileSync(wrlkit, command, {stdio: ['ignore', 'pipe', 'ignore'], maxBuffer: 1e8})).bounds;
  } catch (error) {
    return error.status === 1 ? JSON.parse(error.stdout).bounds : null;
  }
}

/// From the front, the right and above, at a distance from which the box is well in the picture.
function look_at_box(bounds) {
  const {min, max} = bounds?.min ? bounds : {min: [-1, -1, -1], max: [1, 1, 1]};
  const centre = min.map((v, i) => (v + max[i]) / 2);
  const size = Math.hypot(...min.map((v, i) => max[i] - v)) || 1;
  return {eye: centre.map((v, i) => v + size * [0.5, 0.4, 1.1][i]), target: centre, up: [0, 1, 0]};
}
