// A world of X3D drawn by X_ITE.
import X3D from '/node_modules/x_ite/dist/x_ite.mjs';
import {compare, load_picture, picture_of, sheet} from './pictures.mjs';

let canvas;

/// It looks at its attributes when it is made.
async function browser_of({width, height}) {
  if (!canvas) {
    const frame = document.createElement('div');
    Object.assign(frame.style, {position: 'absolute', left: 0, top: 0, width: `${width}px`, height: `${height}px`});
    frame.innerHTML = `<x3d-canvas style="display: block; width: 100%; height: 100%" preserveDrawingBuffer="true" antialiased="false" splashScreen="false" notifications="false"
      timings="false" contentScale="1"></x3d-canvas>`;
    document.body.append(frame);
    canvas = frame.firstElementChild;
  }
  return X3D.getBrowser(canvas);
}

/// job: {x_ite: text of the world, width, height, reference, key}: the picture next to that of `reference`, and how alike they are.
export async function draw_with_x_ite(job) {
  const browser = await browser_of(job);
  await browser.replaceWorld(await browser.createX3DFromString(job.x_ite));
  for (let i = 0; i < 5; ++i) await browser.nextFrame();
  const reference = await load_picture(job.reference), shown = picture_of(canvas.shadowRoot.querySelector('canvas.x_ite-private-canvas'));
  return {...compare(reference, shown, job), sheet: sheet([reference, shown], ['wrlkit render', 'X_ITE 15']).toDataURL()};
}
