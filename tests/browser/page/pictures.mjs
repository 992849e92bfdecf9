// Pictures in the page: loaded, compared, put side by side. A picture is a canvas.

function canvas(width, height) {
  const c = document.createElement('canvas');
  c.width = width;
  c.height = height;
  return c;
}

const pen = c => c.getContext('2d', {willReadFrequently: true});
const pixels = c => pen(c).getImageData(0, 0, c.width, c.height).data;

export function picture_of(source) {
  const c = canvas(source.width, source.height);
  pen(c).drawImage(source, 0, 0);
  return c;
}

export async function load_picture(url) {
  const image = new Image();
  image.src = url;
  await image.decode();
  return picture_of(image);
}

/// 1 for each pixel that is part of the world, and not of the background of that colour.
function covered(data, key) {
  const [r, g, b] = key.map(v => 255 * v), mask = new Uint8Array(data.length / 4);
  const differs = (value, of_key) => Math.abs(value - of_key) > 12;
  for (let i = 0, k = 0; i < mask.length; ++i, k += 4) mask[i] = differs(data[k], r) || differs(data[k + 1], g) || differs(data[k + 2], b) ? 1 : 0;
  return mask;
}

/// The mask, with what lies `step` before and behind each pixel in the list, within runs of that length.
function spread(mask, step, run) {
  const out = mask.slice();
  for (let i = 0; i < mask.length; ++i) {
    if (!mask[i]) continue;
    const at = Math.floor(i / step) % run;
    if (at > 0) out[i - step] = 1;
    if (at < run - 1) out[i + step] = 1;
  }
  return out;
}

/// The mask, grown by `reach` pixels in each direction.
function grown(mask, width, reach) {
  if (reach === 0) return mask;
  return grown(spread(spread(mask, 1, width), width, mask.length / width), width, reach - 1);
}

const count = mask => mask.reduce((sum, v) => sum + v, 0);
const both = (a, b) => a.map((v, i) => v & b[i]);
const mean = list => list.reduce((sum, v) => sum + v, 0) / Math.max(1, list.length);

/// The part of what either mask covers that has a counterpart in the other, no farther than `reach` pixels away.
function overlap(a, b, width, reach) {
  const matched = count(both(a, grown(b, width, reach))) + count(both(b, grown(a, width, reach)));
  const common = count(both(a, b)), all = count(a) + count(b);
  return all === 0 ? 1 : reach === 0 ? common / (all - common) : matched / all;
}

/// {overlap, difference, worst, coverage}. overlap: see above; difference: mean of the channels' absolute differences where
/// both pictures are covered, worst: that of the worst tenth; coverage: part of the first picture that is covered. All from
/// 0 to 1.
export function compare(a, b, {key, reach = 0}) {
  const [p, q] = [pixels(a), pixels(b)];
  if (p.length !== q.length) throw new Error(`pictures of ${a.width} x ${a.height} and ${b.width} x ${b.height}`);
  const [in_a, in_b] = [covered(p, key), covered(q, key)], differences = [];
  for (let i = 0, k = 0; i < in_a.length; ++i, k += 4)
    if (in_a[i] && in_b[i]) differences.push((Math.abs(p[k] - q[k]) + Math.abs(p[k + 1] - q[k + 1]) + Math.abs(p[k + 2] - q[k + 2])) / 765);
  const sorted = Float64Array.from(differences).sort();
  return {
    overlap: overlap(in_a, in_b, a.width, reach),
    difference: mean(sorted),
    worst: mean(sorted.subarray(Math.floor(sorted.length * 0.9))),
    coverage: count(in_a) / in_a.length,
  };
}

/// Pictures of one width, one below the other.
export function stack(pictures) {
  const c = canvas(pictures[0].width, pictures.reduce((sum, p) => sum + p.height, 0));
  let y = 0;
  for (const p of pictures) pen(c).drawImage(p, 0, y), y += p.height;
  return c;
}

/// Pictures next to each other, with a line of text above each.
export function sheet(pictures, labels) {
  const gap = 4, head = 20;
  const c = canvas(pictures.reduce((sum, p) => sum + p.width + gap, -gap), head + Math.max(...pictures.map(p => p.height)));
  const ink = pen(c);
  ink.fillStyle = 'white';
  ink.fillRect(0, 0, c.width, c.height);
  ink.fillStyle = 'black';
  ink.font = '14px sans-serif';
  let x = 0;
  pictures.forEach((p, i) => {
    ink.fillText(labels[i], x + 4, 15, p.width - 8);
    ink.drawImage(p, x, head);
    x += p.width + gap;
  });
  return c;
}
