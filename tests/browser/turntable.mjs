// An animated WebP of `wrlkit render --turntable`, read by Chromium: as many pictures as were asked for, as long as each should be, in
// the colours of the PNG files of the same series.
//   node turntable.mjs WRLKIT FOLDER
import assert from 'node:assert';
import fs from 'node:fs';
import path from 'node:path';
import {start_chromium, wrlkit} from './viewer_page.mjs';
import {file_of} from './worlds.mjs';

const [program, folder] = process.argv.slice(2), n = 9;
fs.mkdirSync(folder, {recursive: true});
const world = file_of('corpus/features/colour_per_face.wrl'), animation = path.join(folder, 'round.webp');
const flags = ['--turntable', n, '--width', 160, '--height', 120];
wrlkit(program, 'render', '-q', world, animation, ...flags);
wrlkit(program, 'render', '-q', world, path.join(folder, 'round.png'), ...flags);
const base64 = file => fs.readFileSync(file).toString('base64');
const pictures = Array.from({length: n}, (_, i) => base64(path.join(folder, `round_${String(i).padStart(3, '0')}.png`)));

/// In the browser: milliseconds of each picture, and how far it is from its PNG file (mean and largest of 255).
async function compare([webp, pngs]) {
  const bytes = Uint8Array.from(atob(webp), c => c.charCodeAt(0));
  const decoder = new ImageDecoder({data: bytes, type: 'image/webp'});
  await decoder.tracks.ready;
  const {frameCount, repetitionCount} = decoder.tracks.selectedTrack, frames = [];
  const pixels = (image, width, height) => {
    const context = new OffscreenCanvas(width, height).getContext('2d');
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, width, height).data;
  };
  for (let i = 0; i < frameCount; ++i) {
    const {image} = await decoder.decode({frameIndex: i});
    const png = await createImageBitmap(new Blob([Uint8Array.from(atob(pngs[i]), c => c.charCodeAt(0))]));
    const a = pixels(image, png.width, png.height), b = pixels(png, png.width, png.height);
    const apart = a.map((x, k) => Math.abs(x - b[k]));
    frames.push({milliseconds: image.duration / 1000, size: [image.displayWidth, image.displayHeight], mean: apart.reduce((s, x) => s + x, 0) / apart.length, largest: apart.reduce((x, y) => Math.max(x, y), 0)});
  }
  return {frames, repetitionCount};
}

const browser = await start_chromium();
try {
  const page = await browser.newPage();
  await page.goto(`file://${animation}`);  // about:blank has no ImageDecoder
  const {frames, repetitionCount} = await page.evaluate(compare, [base64(animation), pictures]);
  assert.equal(frames.length, n);
  assert.equal(repetitionCount, Infinity);
  for (const [i, frame] of frames.entries()) {
    assert.deepEqual([frame.milliseconds, ...frame.size], [80, 160, 120], `picture ${i}`);
    assert(frame.mean < 3 && frame.largest < 90, `picture ${i} is ${frame.mean} of 255 from its PNG in the mean, ${frame.largest} at most`);
  }
  console.log(`${n} pictures, at most ${Math.max(...frames.map(f => f.mean)).toFixed(2)} of 255 from the PNG files in the mean, ${Math.max(...frames.map(f => f.largest))} at a pixel`);
} finally {
  await browser.close();
}
