// What the page does: it fetches the list of pictures to be taken, takes one after the other, and sends back each with what
// it saw. The driver (browser.mjs) is at the other end.
import {compare, load_picture, picture_of, sheet} from './pictures.mjs';
import {show} from './show.mjs';

async function work(job) {
  const shown = picture_of(await show(job));
  if (!job.reference) return {shown: shown.toDataURL()};
  const pictures = await Promise.all(job.reference.map(({url}) => load_picture(url)));
  const labels = [...job.reference.map(r => r.label), 'three.js, from the glTF'];
  return {...compare(pictures.at(-1), shown, job), sheet: sheet([...pictures, shown], labels).toDataURL()};
}

const send = result => fetch('/result', {method: 'POST', body: JSON.stringify(result)});

for (const job of await (await fetch('/jobs')).json()) {
  const result = await work(job).catch(error => ({error: String(error?.stack ?? error)}));
  await send({name: job.name, lighting: job.lighting, ...result});
}
await send({end: true});
