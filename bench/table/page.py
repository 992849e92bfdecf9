"""The viewer page: from `wrlkit view` to the first picture in headless Chromium (software rendering)."""
import re

from . import measure
from .measure import Row, in_turn, number, output, plant


def page(runs):
    source, html = plant('100M'), measure.DATA / 'plant.html'
    cost = in_turn({'view': [measure.WRLKIT, 'view', '-q', source, '-o', html]}, min(runs, 3))['view']
    text = output('node', measure.ROOT / 'bench' / 'viewer.mjs', measure.WRLKIT, source)
    first = float(re.search(r'first picture after (\d+) ms', text)[1])
    return [Row('page', 'view, plant of 100 MB', cost.cpu, 'CPU s', f'{number(cost.peak)} MB', 'wrlkit view plant.wrl -o plant.html', 3),
            Row('page', 'its first picture', first / 1000, 's', '1,440 x 900, software rendering', 'bench/viewer.mjs wrlkit plant.wrl', 3, wall=True)], []
