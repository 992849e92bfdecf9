// What pages that draw one file have in common, whatever draws it.
import {compare, load_picture, picture_of, sheet} from './pictures.mjs';

/// Addresses that were asked for, other than those of the test's own server: a fault of each.
export function from_elsewhere() {
  const asked = performance.getEntriesByType('resource').map(entry => entry.name);
  return asked.filter(url => !url.startsWith(location.origin) && !/^(blob|data):/.test(url)).map(url => `asks for ${url}`);
}

/// The result for a canvas that shows job.glb: compared with the picture at job.reference, and what else was found.
export async function compared(engine, canvas, job, found) {
  const shown = picture_of(canvas), reference = await load_picture(job.reference);
  return {...compare(reference, shown, job), ...found, sheet: sheet([reference, shown], ['wrlkit render', engine]).toDataURL()};
}
