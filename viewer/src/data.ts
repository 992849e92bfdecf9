// What wrlkit has put into the page: a table of contents, and files packed by gzip as base64 (tools/verbs/viewer_page.cpp).

/// How far two worlds are apart, in metres; `where` the distance is largest.
export interface OneSide {
  rms: number;
  max: number;
  where: [number, number, number];
}

export interface Apart extends OneSide {
  sides: [OneSide & {file: number}, OneSide & {file: number}];
}

export interface Contents {
  worlds: {name: string; file: number}[];
  collapses: {criterion: string; file: number}[];
  deviation?: Apart;
}

function textOf(id: string): string {
  const element = document.getElementById(id);
  if (!element) throw new Error(`the page has no part '${id}'`);
  const text = element.textContent ?? '';
  element.remove();  // the text is large
  return text;
}

export function readContents(): Contents {
  return JSON.parse(textOf('contents')) as Contents;
}

function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/// Unpacks a file; each can be read once.
export async function readFile(number: number): Promise<ArrayBuffer> {
  const packed = new Blob([bytesOf(textOf(`file-${number}`))]);
  return new Response(packed.stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}
