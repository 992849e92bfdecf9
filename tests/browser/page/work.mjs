// What the page does: it fetches what picture is to be taken, takes it and sends it back with what it saw, until there is
// none. The driver (browser.mjs) is at the other end.
import {compare, load_picture, picture_of, sheet, stack} from './pictures.mjs';
import {show} from './show.mjs';

/// Pictures of one file at several times, each compared with its own: the worst of all, and both rows of pictures.
async function series(job) {
  const all = [], shown = [], references = [];
  for (const frame of job.frames) {
    shown.push(picture_of(await show({...job, time: frame.time})));
    references.push(await load_picture(frame.url));
    all.push(compare(references.at(-1), shown.at(-1), job));
  }
  const worst = (name, of) => of(...all.map(c => c[name]));
  const rows = [sheet(references, job.frames.map(f => `VRML, ${f.time} s`)), sheet(shown, job.frames.map(f => `three.js, ${f.time} s`))];
  return {overlap: worst('overlap', Math.min), difference: worst('difference', Math.max), coverage: worst('coverage', Math.min), sheet: stack(rows).toDataURL()};
}

async function work(job) {
  if (job.tileset) return (await import('./tileset.mjs')).draw_tileset(job);
  if (job.babylon) return (await import('/out/babylon/babylon.js')).draw_with_babylon(job);
  if (job.cesium_model) return (await import('./cesium.mjs')).draw_model(job);
  if (job.cesium) return (await import('./cesium.mjs')).draw_with_cesium(job);
  if (job.behaviour) return (await import('/out/babylon/behaviour.js')).behave(job);
  if (job.x_ite) return (await import('./x_ite.mjs')).draw_with_x_ite(job);
  if (job.frames) return series(job);
  const shown = picture_of(await show(job));
  if (!job.reference) return {shown: shown.toDataURL()};
  const pictures = await Promise.all(job.reference.map(({url}) => load_picture(url)));
  const labels = [...job.reference.map(r => r.label), 'three.js, from the glTF'];
  return {...compare(pictures.at(-1), shown, job), sheet: sheet([...pictures, shown], labels).toDataURL()};
}

const send = result => fetch('/result', {method: 'POST', body: JSON.stringify(result)});

const next_job = async () => (await fetch('/job')).json();

for (let job = await next_job(); job; job = await next_job()) {
  const result = await work(job).catch(error => ({error: String(error?.stack ?? error)}));
  await send({name: job.name, lighting: job.lighting, ...result});
}
await send({end: true});
