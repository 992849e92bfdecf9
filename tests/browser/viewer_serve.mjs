// `wrlkit view --serve`: the page is there at a loopback address, nothing else is, and a page of another site that has given its name
// to this machine gets nothing.
//   node viewer_serve.mjs WRLKIT FOLDER
import assert from 'node:assert';
import {spawn} from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import net from 'node:net';
import os from 'node:os';
import path from 'node:path';
import {file_of} from './worlds.mjs';

const [program, folder] = process.argv.slice(2);
fs.mkdirSync(folder, {recursive: true});
const world = path.join(folder, 'syntax.wrl');
fs.copyFileSync(file_of('corpus/features/syntax.wrl'), world);
const serve = ['view', '-q', world, '--serve'];
const server = spawn(program, serve, {stdio: ['ignore', 'pipe', 'inherit']});

/// A client that says just this, and then nothing; its socket.
function say(address, bytes) {
  const socket = net.connect(Number(address.port), address.hostname, () => socket.write(bytes));
  socket.on('error', () => undefined);
  return socket;
}

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
  for (const way of ['/../../etc/passwd', '/%2e%2e/%2e%2e/etc/passwd', '//etc/passwd', '/index.html/../../x', '/?/etc/passwd']) assert.equal((await ask(address, {path: way})).code, 404, way);
  assert.equal((await ask(address, {host: `evil.example:${address.port}`})).code, 404);
  assert.equal((await ask(address, {host: `localhost:${address.port}`})).code, 200);
  for (const {address: own, family, internal} of Object.values(os.networkInterfaces()).flat()) {
    if (family === 'IPv4' && !internal) await assert.rejects(ask({hostname: own, port: address.port}), `${own} answers`);
  }
  // Clients that say nothing, nonsense, or too much, and one that does not read, are in nobody's way.
  const idle = ['', 'GET', '\0\r\n\xff'.repeat(100), `GET / HTTP/1.1\r\n${'X: y\r\n'.repeat(1e5)}`, `GET / HTTP/1.1\r\nHost: 127.0.0.1:${address.port}\r\n\r\n`].map(bytes => say(address, bytes));
  idle.at(-1).pause();
  const answers = await Promise.all(Array.from({length: 100}, () => ask(address)));
  assert(answers.every(a => a.code === 200 && a.text === page.text), 'a hundred at once');
  for (const socket of idle) socket.destroy();
  // A world that has changed is read again by whoever comes next; one that is gone, or is none any more, leaves the last page.
  fs.writeFileSync(world, '#VRML V2.0 utf8\nShape { geometry Box { } }\n');
  const changed = await Promise.all(Array.from({length: 10}, () => ask(address)));
  assert(changed.every(a => a.code === 200 && a.text === changed[0].text) && changed[0].text !== page.text, 'the world has changed');
  fs.writeFileSync(world, 'no world');
  assert.equal((await ask(address)).text, changed[0].text);
  fs.rmSync(world);
  assert.equal((await ask(address)).text, changed[0].text);
  fs.copyFileSync(file_of('corpus/features/syntax.wrl'), world);
  assert.equal((await ask(address)).text, page.text);
  // Another one takes another port.
  const other = spawn(program, serve, {stdio: ['ignore', 'pipe', 'inherit']});
  const second = new URL(await new Promise(resolve => other.stdout.setEncoding('utf8').once('data', resolve)));
  assert.notEqual(second.port, address.port);
  assert.equal((await ask(second)).code, 200);
  other.kill();
  console.log(String(address));
} finally {
  server.kill();
}
