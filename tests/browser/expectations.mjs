// How alike pictures must be: parts of one. `vrml` and `three` are the two kinds of lighting of page/show.mjs.
const usual = {
  least_overlap: 0.99,             // of the parts that are covered: intersection over union
  most: {vrml: 0.01, three: 0.1},  // mean difference of the channels where both are covered
  least_coverage: 0.01,            // of the picture, so that nothing is compared with nothing
  reach: 0,                        // pixels that a covered pixel may be away from its counterpart
};

// Worlds for which that cannot hold, and why. Where several rows fit, the later one counts.
const exceptions = [
  {why: 'lines and points are drawn two pixels wide by wrlkit, one pixel wide by three.js', reach: 1, least_overlap: 0.995, least_coverage: 0.0001,
    worlds: /lines_|points_|PointSet|IndexedLineSet/},
  {why: 'strokes of text are as wide as a pixel, and browsers place corners on a sixteenth of one', least_overlap: 0.95,
    worlds: /text_|Text\.wrl|FontStyle/},
  {why: 'text with lines', least_overlap: 0.97, reach: 1, worlds: /text_justify|text_length/},
  {why: 'seen from the edge: a few pixels', least_overlap: 0.97, least_coverage: 0.001, worlds: /nodes\/(Color|ElevationGrid|Normal|TextureCoordinate|Coordinate)\.wrl/},
  {why: 'all parts are switched off', least_coverage: 0, worlds: /nodes\/(Cone|Cylinder)\.wrl/},
  {why: 'nothing turns by itself in glTF', least_overlap: 0.94, most: {vrml: 0.06}, worlds: /[bB]illboard/},
  {why: 'no fog in glTF', most: {vrml: 0.13}, worlds: /fog_/},
  {why: 'saturated colours and slopes under one lamp: the middle of what is reflected is lighter in linear colours', most: {three: 0.13},
    worlds: /elevation_(crease|plain|ccw_false|normal_per_vertex)|proto_(every_type|is_everywhere|node_fields|as_parts)|normal_per_vertex|background_panorama|vrml1\/(TriangleStripSet|FaceSet|Material)|nodes\/MovieTexture|paper\/pipes|colour_per_vertex_indexed/},
  {why: 'the same, and colours between which it goes over', most: {three: 0.17},
    worlds: /elevation_(texcoord|colour)|features\/colour_per_vertex\.|lines_colour_per_vertex_indexed|proto_nested|pixel_texture_3|light_point|paper\/stairs_room/},
  {why: 'light falls off in glTF as it does in nature, in VRML it does not', most: {vrml: 0.12}, worlds: /light_(point|spot)|paper\/(pipes|stairs_room)|pump_room/},
  {why: 'a light shines on the whole world in glTF, in VRML on its group', most: {vrml: 0.25, three: 0.33}, worlds: /light_scope/},
  {why: 'a picture on a stretched box is shrunk more across than along: wrlkit reads it at the mean size, three.js several times at the larger one',
    most: {vrml: 0.012}, worlds: /features\/inline\.wrl/},
  {why: 'light that is emitted and light that is reflected add up in linear colours', most: {three: 0.22}, worlds: /nodes\/ImageTexture/},
  // Found plants and worlds with baked light.
  {why: 'edges are lines: two pixels wide by wrlkit, one by three.js', reach: 1, least_overlap: 0.97, most: {vrml: 0.09},
    worlds: /vzome.*(80|heptahedron|compound_of|bookball|icosahedron).* with light|model_goal.* with light/},
  {why: 'bars of a pixel', least_overlap: 0.98, least_coverage: 0.004, worlds: /(hand_railing|fix_wall).* with light/},
  {why: 'two faces in one place: who of them is seen is another by each program', most: {vrml: 0.03}, worlds: /(great_dodecahemi|Lusail\/main|model_field).* with light/},
  {why: 'glass: three.js draws its faces in the order of the file, not from far to near', most: {vrml: 0.08}, worlds: /house\/vase.* with light/},
];

// Worlds that cannot be compared at all, and why.
const left_out = [
  {why: 'outlines of sites and points: lines', worlds: /nist-steelvis.* with light/},
  {why: 'one face, which turns its back to the camera', worlds: /mockup\/back_ground/},
  {why: 'strokes, lines and bars that are a few pixels wide', worlds: /vrml1\/(AsciiText|DrawStyle|LineSet|RotationXYZ|Scale|Texture2)\.wrl/},
  {why: 'centimetres: nothing of it is seen from where its camera stands', worlds: /vrml1\/Units\.wrl/},
  {why: 'fog of half a metre, and none in glTF', worlds: /vrml1\/Environment\.wrl/},
  {why: 'a face that crosses itself, with normals that point away from the viewer', worlds: /vrml1\/QuadMesh\.wrl/},
];
export const is_compared = name => !left_out.some(row => row.worlds.test(name));

// Pictures of a few pixels, side by side in colours that WebP halves in resolution.
const lossy = 0.06;

/// What is asked of a world; `webp`: its pictures are stored with losses.
export function expected(name, webp = false) {
  const e = exceptions.filter(e => e.worlds.test(name)).reduce((sum, e) => ({...sum, ...e, most: {...sum.most, ...e.most}}), usual);
  return webp ? {...e, most: {...e.most, vrml: Math.max(e.most.vrml, lossy)}} : e;
}
