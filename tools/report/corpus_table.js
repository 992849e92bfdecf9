// The table of all files in the page of `corpus report`: searched, sorted and paged. `states`, `rows` and `looks` are
// data that the page defines in front of this script (tools/corpus/report_page.cpp).
const names = [
  'input', 'state', 'seconds', 'cpu', 'memory', 'input_bytes', 'output_bytes', 'errors', 'warnings', 'lost', 'rms',
  'max',
];
const CAUSE = 13;
const LOOK = 12;
const size = 100;
let by = 0;
let down = false;
let page = 0;

const $ = (id) => document.getElementById(id);
const text = (s) => {
  const e = document.createElement('span');
  e.textContent = s;
  return e.innerHTML;
};
const bytes = (n) => {
  if (n < 1e4) return n + ' B';
  return n < 1e7 ? (n / 1e3).toFixed(0) + ' kB' : (n / 1e6).toFixed(1) + ' MB';
};
const metres = (v) => {
  if (v === null) return '';
  return v === 0 ? '0' : v.toPrecision(3);
};
const image = (b) => (b ? '<img loading="lazy" alt="" src="data:image/jpeg;base64,' + b + '">' : '');
const picture = (i) => '<div class=look>' + image(looks[i][0]) + image(looks[i][1]) + '</div>';

// Rows without a value come last, whichever way the column is sorted.
function compare(a, b) {
  const x = a[by];
  const y = b[by];
  if (x === null) return y === null ? 0 : 1;
  if (y === null) return -1;
  const order = x < y ? -1 : x > y ? 1 : 0;
  return down ? -order : order;
}

function shown() {
  const query = $('q').value.toLowerCase();
  const state = $('s').value;
  const found = (r) => !query || (r[0] + r[CAUSE]).toLowerCase().includes(query);
  return rows.filter((r) => found(r) && (state === '' || states[r[1]] === state)).sort(compare);
}

function cells(r) {
  const name = text(r[0]) + (r[CAUSE] ? '<br><span class=bad>' + text(r[CAUSE]) + '</span>' : '');
  const figures = [
    r[2].toFixed(3), r[3].toFixed(3), bytes(r[4]), bytes(r[5]), bytes(r[6]), r[7], r[8], r[9], metres(r[10]),
    metres(r[11]), r[LOOK] === null ? '' : picture(r[LOOK]),
  ];
  const texts = [name, states[r[1]]].map((s) => '<td class=text>' + s + '</td>');
  return '<tr>' + texts.join('') + figures.map((s) => '<td>' + s + '</td>').join('') + '</tr>';
}

function draw() {
  for (const b of document.querySelectorAll('#head button'))
    b.parentNode.ariaSort = b.dataset.i != by ? 'none' : down ? 'descending' : 'ascending';
  const all = shown();
  const last = Math.max(0, Math.ceil(all.length / size) - 1);
  page = Math.min(page, last);
  $('n').textContent = all.length + ' files, page ' + (page + 1) + ' of ' + (last + 1);
  $('rows').innerHTML = all.slice(page * size, page * size + size).map(cells).join('');
}

function heading(name, i) {
  const button = '<button type="button" data-i="' + i + '">' + name.replace('_', ' ') + '</button>';
  return '<th' + (i < 2 ? ' class=text' : '') + '>' + button + '</th>';
}

$('head').innerHTML = names.map(heading).join('') + '<th class=text>before, after</th>';
$('head').onclick = (e) => {
  const i = e.target.dataset.i;
  if (i === undefined) return;
  down = by == i ? !down : i > 1;
  by = +i;
  page = 0;
  draw();
};
$('q').oninput = $('s').onchange = () => {
  page = 0;
  draw();
};
$('back').onclick = () => {
  page = Math.max(0, page - 1);
  draw();
};
$('next').onclick = () => {
  page++;
  draw();
};
for (const s of states) $('s').add(new Option(s, s));
for (const e of document.querySelectorAll('[data-look]')) e.innerHTML = picture(+e.dataset.look);
draw();
