// Nodes of X3D that are drawn, next to X_ITE's picture of the same text: what is covered must be the same, and the colours alike.
//   node x_ite_pictures.mjs WRLKIT FOLDER
// Pairs of pictures are left in FOLDER.
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {has_chromium, take_pictures} from './browser.mjs';
import {run} from './program.mjs';

const [wrlkit, folder] = process.argv.slice(2);
const here = path.dirname(new URL(import.meta.url).pathname);
if (!has_chromium || !fs.existsSync(path.join(here, 'node_modules/x_ite'))) process.exit(77);
fs.mkdirSync(folder, {recursive: true});
const size = {width: 240, height: 180}, key = [0.85, 0.25, 0.65];
const bound = {overlap: 0.97, difference: 0.04, coverage: 0.03};

const green = 'appearance Appearance { material Material { diffuseColor 0.2 0.7 0.4 } }';
/// Eight by eight, smooth: filters differ.
const colors = [...Array(64).keys()].map(i => `0x${[40 + 25 * (i % 8), 220 - 22 * (i >> 3), 128].map(v => v.toString(16).padStart(2, '0')).join('')}`);
const tiles = `PixelTexture { repeatS FALSE repeatT FALSE image 8 8 3 ${colors.join(' ')} textureProperties TextureProperties { magnificationFilter "AVG_PIXEL" minificationFilter "AVG_PIXEL" boundaryModeS "CLAMP_TO_EDGE" boundaryModeT "CLAMP_TO_EDGE" } }`;
const shape = (geometry, look = green) => `Shape { ${look} geometry ${geometry} }`;
const hill = 'uDimension 3 vDimension 3 uOrder 3 vOrder 3 uKnot [ 0 0 0 1 1 1 ] vKnot [ 0 0 0 1 1 1 ] solid FALSE controlPoint Coordinate { point [ -2 0 2, 0 0 2, 2 0 2, -2 0 0, 0 4 0, 2 0 0, -2 0 -2, 0 0 -2, 2 0 -2 ] }';

const worlds = {
  clip_plane: `Transform { children [ ClipPlane { plane 0.6 0.8 0 0.3 } ${shape('Sphere { radius 1.8 }')} ] }`,
  nurbs_patch: `Transform { rotation 1 0 0 0.5 children ${shape(`NurbsPatchSurface { ${hill} }`)} }`,
  flat_shapes: `Transform { translation -1.6 0 0 children ${shape('Disk2D { innerRadius 0.5 outerRadius 1.2 solid FALSE }')} }
    Transform { translation 1.4 0.9 0 children ${shape('Rectangle2D { size 1.5 1 }')} } Transform { translation 1.4 -0.9 0 children ${shape('ArcClose2D { closureType "PIE" startAngle 0.3 endAngle 4 radius 0.9 solid FALSE }')} }`,
  strips: shape('IndexedTriangleStripSet { solid FALSE index [ 0 1 2 3 4 5 -1 ] coord Coordinate { point [ -2 -1 0, -2 1 0, 0 -1 0.5, 0 1 0.5, 2 -1 0, 2 1 0 ] } color Color { color [ 1 0 0, 0 1 0, 0 0 1, 1 1 0, 0 1 1, 1 0 1 ] } }'),
  elevation: `Transform { translation -2 -1 0 rotation 1 0 0 0.6 children ${shape('ElevationGrid { xDimension 3 zDimension 3 xSpacing 2 zSpacing 1.5 height [ 0 0.6 0, 0.5 1.4 0.3, 0 0.2 0 ] solid FALSE creaseAngle 2 }')} }`,
  extrusion: shape('Extrusion { crossSection [ 1 0, 0 1, -1 0, 0 -1, 1 0 ] spine [ -2 -1 0, -0.5 0 0, 0.5 1 0, 2 1 0 ] scale [ 0.6 0.6, 0.9 0.9, 0.5 0.5, 0.8 0.8 ] solid FALSE }'),
  texture_transform: shape('Box { size 3 3 0.2 }', `appearance Appearance { material Material { diffuseColor 1 1 1 } texture ${tiles} textureTransform TextureTransform { scale 0.8 0.7 rotation 0.4 center 0.5 0.5 translation 0.1 0.05 } }`),
  two_sides: `Transform { rotation 0 1 0 2.4 children ${shape('IndexedFaceSet { solid FALSE coordIndex [ 0 1 2 3 -1 ] coord Coordinate { point [ -1.5 -1.5 0, 1.5 -1.5 0, 1.5 1.5 0, -1.5 1.5 0 ] } }',
    'appearance Appearance { material Material { diffuseColor 0.9 0.1 0.1 } backMaterial Material { diffuseColor 0.1 0.2 0.9 } }')} }`,
  // A swung surface is none of them: X_ITE extrudes the profile along the trajectory, X3D 27.4.11 has their product.
  swept: shape('NurbsSweptSurface { solid FALSE crossSectionCurve ContourPolyline2D { controlPoint [ 0.6 0.6, -0.6 0.6, -0.6 -0.6, 0.6 -0.6, 0.6 0.6 ] } trajectoryCurve NurbsCurve { order 3 knot [ 0 0 0 1 1 1 ] controlPoint Coordinate { point [ -2 -1 0, 0 2 0, 2 -1 0 ] } } }'),
  cad: `CADAssembly { children CADPart { translation -1 0 0 rotation 0 0 1 0.5 children [ CADFace { shape ${shape('Box { size 1 2 1 }')} } CADFace { shape Shape { ${green} geometry QuadSet { solid FALSE coord Coordinate { point [ 1 -1 0, 3 -1 0, 3 1 0, 1 1 0 ] } } } } ] } }`,
  trimmed: `Transform { rotation 1 0 0 0.9 children ${shape(`NurbsTrimmedSurface { ${hill} trimmingContour [ Contour2D { children ContourPolyline2D { controlPoint [ 0 0, 1 0, 1 1, 0 1, 0 0 ] } } Contour2D { children ContourPolyline2D { controlPoint [ 0.3 0.3, 0.3 0.7, 0.7 0.7, 0.7 0.3, 0.3 0.3 ] } } ] }`)} }`,
  multi_texture: shape('Rectangle2D { size 4 4 }', `appearance Appearance { material UnlitMaterial { emissiveColor 1 1 1 } texture MultiTexture { mode "MODULATE" texture [ ${tiles} PixelTexture { repeatS FALSE repeatT FALSE image 2 1 3 0xFF8080 0x80FF80 } ] } }`),
  mirrored: shape('Rectangle2D { size 4 4 }', `appearance Appearance { material UnlitMaterial { emissiveColor 1 1 1 } texture ${tiles.replaceAll('CLAMP_TO_EDGE', 'MIRRORED_REPEAT')} textureTransform TextureTransform { scale 2.5 2.5 } }`),
  texture_3d: shape('Rectangle2D { size 4 4 }', `appearance Appearance { material UnlitMaterial { emissiveColor 1 1 1 } texture ${tiles} textureTransform TextureTransform3D { rotation 0 0 1 0.5 center 0.5 0.5 0 scale 0.8 0.7 1 translation 0.1 0.05 0 } }`),
  two_sided: `Transform { rotation 0 1 0 2.4 children ${shape('Rectangle2D { size 3 3 solid FALSE }', 'appearance Appearance { material TwoSidedMaterial { diffuseColor 0.9 0.1 0.1 separateBackColor TRUE backDiffuseColor 0.1 0.2 0.9 } }')} }`,
  // Widths of lines and sizes of points are none of them: they count in that of a plain one, which is the browser's. Nor is a PhysicalMaterial: its
  // lamps are as bright here as in the glTF that is made of it, and X_ITE divides them by pi.
  unlit: shape('Sphere { radius 1.8 }', 'appearance Appearance { material UnlitMaterial { emissiveColor 0.9 0.5 0.1 } }'),
  fans: shape('IndexedTriangleFanSet { solid FALSE index [ 0 1 2 3 4 -1 ] coord Coordinate { point [ 0 -1.5 0, 2 -0.5 0, 1 1 0.4, -1 1.2 0, -2 -0.6 0.3 ] } }'),
  from_places: shape('IndexedFaceSet { solid FALSE coordIndex [ 0 1 2 3 -1 ] coord Coordinate { point [ -0.2 -0.1 0, 1.4 0 0, 1.1 1.2 0, 0 0.9 0 ] } texCoord TextureCoordinateGenerator { mode "COORD" } }',
    `appearance Appearance { material UnlitMaterial { emissiveColor 1 1 1 } texture ${tiles} }`),
  generated: shape('Box { size 2.5 2.5 2.5 }', `appearance Appearance { material UnlitMaterial { emissiveColor 1 1 1 } texture ${tiles} }`),
};

const jobs = [];
for (const [name, nodes] of Object.entries(worlds)) {
  const text = `#X3D V4.0 utf8\nPROFILE Full\nBackground { skyColor ${key.join(' ')} }\nViewpoint { position 0 0 7 }\n${nodes}\n`, file = path.join(folder, `${name}.x3dv`);
  fs.writeFileSync(file, text);
  const drawn = await run(wrlkit, ['render', '-q', file, path.join(folder, `${name}.png`), '--width', size.width, '--height', size.height, '--samples', 1, '--background', key]);
  assert.equal(drawn.code, 0, drawn.text);
  jobs.push({name, x_ite: text, reference: `/out/${name}.png`, ...size, key, reach: 1});
}

const failed = [];
await take_pictures(folder, jobs, ({name, error, overlap, difference, coverage, sheet}) => {
  if (sheet) fs.writeFileSync(path.join(folder, `${name}_both.png`), Buffer.from(sheet.split(',')[1], 'base64'));
  console.log(`${name}: overlap ${overlap?.toFixed(4)}, difference ${difference?.toFixed(4)}, covered ${coverage?.toFixed(3)}`);
  if (error || !(overlap >= bound.overlap && difference <= bound.difference && coverage >= bound.coverage)) failed.push(`${name}: ${error ?? 'not alike'}`);
});
assert.deepEqual(failed, []);
