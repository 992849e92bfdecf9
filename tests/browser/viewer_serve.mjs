// `wrlkit view --serve`: the page is there at a loopback address, nothing else is, and a page of another site that has given its name
// to this machine gets nothing.
//   node viewer_serve.mjs WRLKIT FOLDER
import assert from 'node:assert';
import {spawn} from 'node:child_process';
import http from 'node:http';
import os from 'node:os';
import {file_of} from './worlds.mjs';

const [program] = process.argv.slice(2);
const server = spawn(program, ['view', '-q', file_of('corpus/features/syntax.wrl'), '--serve'], {stdio: ['ignore', 'pipe', 'inherit']});

function ask(address, {path = '/', host} = {}) {
  return new Promise((resolve, reject) => {
    const request = http.get({hostname: address.hostname, port: address.port, path, headers: host ? {Host: host} : {}, timeout: 3000}, response => {
      let text = '';
      response.setEncoding('utf8').on('data', piece => { text += piece; }).on('end', () => resolve({code: response.statusCode, text}));
    });
    request.on('error', reject);
  });
}

try {
  const address = new URL(await new Promise((resolve, reject) => {
    server.stdout.setEncoding('utf8').once('data', resolve);
    server.once('exit', code => reject(new Error(`it ended with ${code}`)));
  }));
  assert.equal(address.hostname, '127.0.0.1');
  const page = await ask(address);
  assert.equal(page.code, 200);
  assert(page.text.startsWith('<!doctype html>') && page.text.includes('syntax.wrl'));
  assert.equal((await ask(address, {path: '/../../etc/passwd'})).code, 404);
  assert.equal((await ask(address, {host: `evil.example:${address.port}`})).code, 404);
  assert.equal((await ask(address, {host: `localhost:${address.port}`})).code, 200);
  for (const {address: own, family, internal} of Object.values(os.networkInterfaces()).flat()) {
    if (family === 'IPv4' && !internal) await assert.rejects(ask({hostname: own, port: address.port}), `${own} answers`);
  }
  console.log(String(address));
} finally {
  server.kill();
}
