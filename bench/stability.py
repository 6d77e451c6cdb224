#!/usr/bin/env python3
"""stability.py CSV PICTURE - the map of stability as one SVG picture, from what bench/stability.c has printed."""
import csv
import sys
from collections import defaultdict
from xml.sax.saxutils import escape

STEPS = [1 / 15 / 2 ** i for i in range(7)]
# From the longest step to the shortest, and where nothing holds.
COLOURS = ['#1a9850', '#91cf60', '#d9ef8b', '#fee08b', '#fdae61', '#f46d43', '#d73027']
NOTHING = '#555555'
CELL, HIGH, GAP, LEFT, TOP = 34, 17, 22, 92, 64
TITLES = {'chain': 'chain, last link heavier', 'tower': 'tower, top cube heavier', 'beam': 'beam on springs'}
DOWN = {'chain': 'mass ratio', 'tower': 'mass ratio', 'beam': 'Hz of a link'}


def cost(us):
    """Of a simulated second: microseconds, or thousands of them."""
    if us >= 9950:
        return f'{us / 1000:.0f}k'
    return f'{us / 1000:.1f}k' if us >= 1000 else f'{us:.0f}'


def colour(step):
    return NOTHING if step == 0 else COLOURS[min(range(7), key=lambda i: abs(STEPS[i] - step))]


def text(x, y, what, size=11, anchor='middle', fill='black', weight='normal'):
    return (f'<text x="{x}" y="{y}" font-size="{size}" text-anchor="{anchor}" fill="{fill}" '
            f'font-weight="{weight}">{escape(what)}</text>')


def cell(x, y, row, is_cheapest):
    edge = 'stroke="black" stroke-width="1.8"' if is_cheapest else 'stroke="white" stroke-width=".6"'
    out = [f'<rect x="{x}" y="{y}" width="{CELL}" height="{HIGH}" fill="{colour(row["step"])}" {edge}/>']
    what = cost(row['us']) if row['step'] else '-'
    fill = 'white' if row['step'] == 0 or colour(row['step']) in (COLOURS[0], COLOURS[6]) else 'black'
    return out + [text(x + CELL / 2, y + HIGH - 5, what, 9, fill=fill, weight='bold' if is_cheapest else 'normal')]


def legend(y):
    out = [text(LEFT, y + 12, 'longest step that holds:', anchor='start')]
    x = LEFT + 140
    for step, shade in list(zip(STEPS, COLOURS)) + [(0, NOTHING)]:
        out.append(f'<rect x="{x}" y="{y}" width="14" height="14" fill="{shade}"/>')
        out.append(text(x + 18, y + 12, f'1/{round(1 / step)} s' if step else 'none', anchor='start'))
        x += 74
    return out + [text(LEFT, y + 34, 'number: CPU time of a simulated second with the cheapest setting, us; '
                       'framed: the cheapest engine', anchor='start')]


def panel(rows, engines, top):
    """A scene: of each engine a table, parameters downwards, counts across. Returns the drawing and its height."""
    parameters = sorted({r['parameter'] for r in rows})
    counts = sorted({r['count'] for r in rows})
    at = {(r['engine'], r['parameter'], r['count']): r for r in rows}
    wide = CELL * len(counts)
    out = [text(LEFT, top - 24, TITLES[rows[0]['scene']], 13, 'start', weight='bold'),
           text(LEFT - 8, top - 6, DOWN[rows[0]['scene']], anchor='end')]
    out += [text(LEFT - 8, top + i * HIGH + 12, f'{p:g}', anchor='end') for i, p in enumerate(parameters)]
    for e, engine in enumerate(engines):
        x = LEFT + e * (wide + GAP)
        out += [text(x + (k + .5) * CELL, top - 6, str(n), 9) for k, n in enumerate(counts)]
        for i, p in enumerate(parameters):
            for k, n in enumerate(counts):
                here = [at[o, p, n] for o in engines if (o, p, n) in at and at[o, p, n]['step'] > 0]
                row = at.get((engine, p, n))
                if row:
                    best = bool(here) and row['step'] > 0 and row['us'] == min(r['us'] for r in here)
                    out += cell(x + k * CELL, top + i * HIGH, row, best)
    return out, len(parameters) * HIGH


def draw(rows):
    scenes = defaultdict(list)
    for row in rows:
        scenes[row['scene']].append(row)
    engines = list(dict.fromkeys(r['engine'] for r in rows))
    wide = CELL * max(len({r['count'] for r in s}) for s in scenes.values())
    out = [text(LEFT + e * (wide + GAP) + wide / 2, 22, engine, 13, weight='bold') for e, engine in enumerate(engines)]
    top = TOP
    for scene in scenes.values():
        drawn, high = panel(scene, engines, top + 10)
        out += drawn
        top += high + 62
    out += legend(top - 34)
    width, height = LEFT + len(engines) * (wide + GAP) + 8, top + 20
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
            f'viewBox="0 0 {width} {height}" font-family="sans-serif">\n<rect width="100%" height="100%" fill="white"/>\n'
            + '\n'.join(out) + '\n</svg>\n')


def main():
    with open(sys.argv[1], encoding='utf-8') as file:
        rows = [{**r, 'parameter': float(r['parameter']), 'count': int(r['count']), 'step': float(r['step']),
                 'us': float(r['us'])} for r in csv.DictReader(file)]
    with open(sys.argv[2], 'w', encoding='utf-8') as file:
        file.write(draw(rows))


if __name__ == '__main__':
    main()
