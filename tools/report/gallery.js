// Search and order of the worlds of a gallery; without it they stand there by name (tools/report/gallery_page.cpp).
const list = document.getElementById('worlds');
const worlds = [...list.children];
const query = document.getElementById('q');
const by = document.getElementById('by');
const count = document.getElementById('n');

function show() {
  const words = query.value.toLowerCase();
  let n = 0;
  for (const w of worlds) {
    w.hidden = !w.dataset.name.toLowerCase().includes(words);
    n += w.hidden ? 0 : 1;
  }
  count.textContent = n + ' of ' + worlds.length + ' worlds';
}

function sort() {
  const key = by.value;
  const order = [...worlds];
  if (key !== 'name') order.sort((a, b) => b.dataset[key] - a.dataset[key]);
  list.append(...order);
}

query.addEventListener('input', show);
by.addEventListener('change', sort);
show();
sort();
