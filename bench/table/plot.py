"""A log-log plot as SVG, whose colours follow the page's: light or dark."""
import html
import math

SIZE, LEFT, TOP, RIGHT, BOTTOM = (760, 420), 64, 16, 230, 48
COLORS = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#7f7f7f', '#8c564b', '#9467bd', '#17becf', '#bcbd22']
STYLE = ('<style>text{font:13px sans-serif;fill:#222}.grid{stroke:#ddd}'
         '@media(prefers-color-scheme:dark){text{fill:#ddd}.grid{stroke:#444}}</style>')


def slope(points):
    """Of the logarithms, by least squares: 1 for what grows as its input does."""
    xs, ys = ([math.log(p[i]) for p in points] for i in (0, 1))
    x, y = sum(xs) / len(xs), sum(ys) / len(ys)
    below = sum((a - x) ** 2 for a in xs)
    return sum((a - x) * (b - y) for a, b in zip(xs, ys)) / below if below else 0


def decades(values):
    return range(math.floor(math.log10(min(values))), math.ceil(math.log10(max(values))) + 1)


def log_log(axes, curves):
    xs, ys = (decades([p[i] for points in curves.values() for p in points]) for i in (0, 1))
    right, bottom = SIZE[0] - RIGHT, SIZE[1] - BOTTOM
    place = lambda value, ticks, a, b: a + (b - a) * (math.log10(value) - ticks[0]) / max(1, ticks[-1] - ticks[0])
    at_x, at_y = (lambda v: place(v, xs, LEFT, right)), (lambda v: place(v, ys, bottom, TOP))
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {SIZE[0]} {SIZE[1]}">', STYLE]
    for d in xs:
        out.append(f'<path class="grid" d="M{at_x(10 ** d):.1f} {TOP}V{bottom}"/>')
        out.append(f'<text x="{at_x(10 ** d):.1f}" y="{bottom + 18}" text-anchor="middle">{10 ** d:g}</text>')
    for d in ys:
        out.append(f'<path class="grid" d="M{LEFT} {at_y(10 ** d):.1f}H{right}"/>')
        out.append(f'<text x="{LEFT - 8}" y="{at_y(10 ** d) + 4:.1f}" text-anchor="end">{10 ** d:g}</text>')
    out.append(f'<text x="{(LEFT + right) / 2}" y="{SIZE[1] - 8}" text-anchor="middle">{axes[0]}</text>')
    out.append(f'<text x="{LEFT}" y="{TOP - 4}" text-anchor="middle">{axes[1]}</text>')
    for i, (name, points) in enumerate(curves.items()):
        color = COLORS[i % len(COLORS)]
        path = ' '.join(f'{at_x(x):.1f},{at_y(y):.1f}' for x, y in points)
        out.append(f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="2"/>')
        out += [f'<circle cx="{at_x(x):.1f}" cy="{at_y(y):.1f}" r="3" fill="{color}"/>' for x, y in points]
        said = f'{name}, slope {slope(points):.2f}' if len(points) > 1 else name
        y = TOP + 14 + 20 * i
        out.append(f'<rect x="{right + 12}" y="{y - 9}" width="10" height="10" fill="{color}"/>')
        out.append(f'<text x="{right + 28}" y="{y}">{html.escape(said)}</text>')
    return '\n'.join(out) + '\n</svg>\n'
