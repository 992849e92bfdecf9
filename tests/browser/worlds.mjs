// Where the worlds are: corpus/ of this project, and the corpus of found files next to the project, when it is there.
import fs from 'node:fs';
import path from 'node:path';

export const project = path.resolve(import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname), '../..');
const shared = path.join(process.env.WRLKIT_SHARED ?? path.join(project, '../shared'), 'corpus');
export const has_shared = fs.existsSync(path.join(shared, 'MANIFEST.tsv'));

/// Rows of a tab-separated file with a header line, as objects.
function table(file) {
  const [header, ...rows] = fs.readFileSync(file, 'utf8').trimEnd().split('\n').map(line => line.split('\t'));
  return rows.map(row => Object.fromEntries(header.map((name, i) => [name, row[i] ?? ''])));
}

export const vrml97 = {ends: /\.wrl$/, format: /^vrml97( gz)?$/};
export const every_format = {ends: /\.(wrl|x3d)$/, format: /^(vrml97|vrml1|x3d|x3dv)( gz)?$/};

/// {name, file} of each world of this project.
export function own_worlds(kinds = vrml97) {
  return fs.readdirSync(path.join(project, 'corpus'), {recursive: true})
    .filter(name => kinds.ends.test(name)).sort()
    .map(name => ({name: `corpus/${name}`, file: path.join(project, 'corpus', name)}));
}

/// {name, file, format, broken} of each found model: all of those kinds, and those that are broken, whatever they are.
export function found_worlds(kinds = vrml97) {
  if (!has_shared) return [];
  return table(path.join(shared, 'MANIFEST.tsv'))
    .filter(row => !row.format.startsWith('asset'))
    .map(row => ({name: row.path, file: path.join(shared, row.path), format: row.format, broken: row.path.startsWith('broken/')}))
    .filter(world => world.broken || kinds.format.test(world.format));
}

/// Paths of the found models in which an independent reader saw something to draw.
export function found_to_draw() {
  if (!has_shared) return new Set();
  const drawn = row => row.ok === '1' && Number(row.triangles) + Number(row.lines) + Number(row.points) > 0;
  return new Set(table(path.join(shared, 'reference.tsv')).filter(drawn).map(row => row.path));
}

/// The file of a world by its name: corpus/... of this project, or a path in the found corpus. Null when it is not there.
export function file_of(name) {
  const file = name.startsWith('corpus/') ? path.join(project, name) : path.join(shared, name);
  return fs.existsSync(file) ? file : null;
}

/// Found plants and worlds in which there is something to draw, by name.
export function plants_and_worlds() {
  const drawn = found_to_draw();
  return found_worlds(every_format).filter(w => /^(plant|worlds)\//.test(w.name) && drawn.has(w.name)).sort((a, b) => a.name < b.name ? -1 : 1);
}
