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
  const is_covered = i => key.some((v, k) => Math.abs(data[4 * i + k] - 255 * v) > 12);
  return Uint8Array.from({length: data.length / 4}, (_, i) => is_covered(i) ? 1 : 0);
}

/// The mask, grown by `reach` pixels in each direction.
function grown(mask, width, reach) {
  if (reach === 0) return mask;
  const height = mask.length / width;
  const at = (x, y) => x >= 0 && x < width && y >= 0 && y < height && mask[y * width + x];
  const near = [-1, 0, 1].flatMap(dy => [-1, 0, 1].map(dx => [dx, dy]));
  const one = mask.map((_, i) => near.some(([dx, dy]) => at(i % width + dx, Math.floor(i / width) + dy)) ? 1 : 0);
  return grown(one, width, reach - 1);
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
  const [in_a, in_b] = [covered(p, key), covered(q, key)];
  const distance = i => [0, 1, 2].reduce((sum, k) => sum + Math.abs(p[4 * i + k] - q[4 * i + k]) / 765, 0);
  const differences = Array.from(in_a.keys()).filter(i => in_a[i] && in_b[i]).map(distance).sort((x, y) => x - y);
  return {
    overlap: overlap(in_a, in_b, a.width, reach),
    difference: mean(differences),
    worst: mean(differences.slice(Math.floor(differences.length * 0.9))),
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
