#!/usr/bin/env python3
"""Makes docs/performance.md, and its pictures by gnuplot, of the figures that tools/bench has written into a directory.

    report.py DIRECTORY
    report.py --rows DIRECTORY

free.csv and contact.csv have a line for each run of a scene, marginal.csv one for each cost, scaling.csv one for each
size and each weight, hour.csv and consistency.csv one for each row of theirs; machine.txt and the heads of free.txt and
contact.txt say what was measured. --rows prints what sweep.csv, of karma-sweep, has found: the rows that are to be
timed. sweep.txt is its command, scenes.txt and solvers.txt name what it numbers. bench/published.csv has the figures that
others have published. No figure stands in this file."""
import collections
import csv
import math
import pathlib
import statistics
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parent.parent
PICTURES = TOP / 'docs' / 'pictures'
SHOWN = ('pendulum', 'tumbling', 'chain-level', 'tower', 'incline', 'cards', 'pyramid-820', 'ragdolls-100', 'net',
         'bridge', 'terrain-car')  # as work-precision diagrams
TIMED = ('chain-level', 'tower-shaken', 'cards', 'heap', 'isotropy', 'heap-1000', 'pyramid-820', 'ragdolls-100', 'net',
         'machines', 'cars', 'gears', 'terrain-car')  # whose distribution of times is shown
LEVELS = ('platinum', 'gold', 'bronze')
GOLD = 1e3     # times the goal
KEY = "set key outside right vertical maxcols 1 font ',9'\n"
SHAPES, COLOURS = 5, 8  # of gnuplot's points: odd numbers from 5 on are filled, the even ones before them open
FLOOR = 1e-16  # errors below it are drawn there

Row = collections.namedtuple('Row', 'scene engine setting substeps outcome times p95 p99 worst cpus errors lack')
Error = collections.namedtuple('Error', 'name goal value')


def number(text):
    return float(text) if text else math.nan


def errors_of(line):
    for suffix in ('', ' 2', ' 3'):
        if line['error' + suffix]:
            yield Error(line['error' + suffix], number(line['goal' + suffix]), number(line['value' + suffix]))


def read_rows(file):
    """The runs of a scene by one engine, with one setting and number of sub-steps, as one row."""
    runs = collections.OrderedDict()
    with open(file, encoding='utf8') as source:
        for line in csv.DictReader(source):
            key = line['scene'], line['engine'], line['setting'], int(line['substeps'])
            runs.setdefault(key, []).append(line)
    for key, lines in runs.items():
        def column(name):
            return [number(line[name]) for line in lines]
        yield Row(*key, lines[0]['outcome'], column('median us'), column('p95 us'), column('p99 us'),
                  column('worst us'), column('cpu s/s'), list(errors_of(lines[0])), lines[0].get('lack') or '')


def solver(row):
    return f'{row.engine} {row.setting}'


def cost(row):
    return statistics.median(row.cpus)


def holds(row):
    return row.outcome == 'holds' and not any(math.isnan(e.value) or math.isinf(e.value) for e in row.errors)


def level(row):
    """Index into LEVELS, or None of a row that fails."""
    if not holds(row):
        return None
    if all(e.value <= e.goal for e in row.errors):
        return 0
    return 1 if all(e.value <= GOLD * e.goal for e in row.errors) else 2


def table(head, lines):
    yield '| ' + ' | '.join(head) + ' |'
    yield '|' + '---|' * len(head)
    for line in lines:
        yield '| ' + ' | '.join(line) + ' |'
    yield ''


def figure(x):
    return f'{x:.2g}' if x < 100 else f'{x:.0f}'


def command(text):
    return ['```sh', text, '```', '']


# Pictures

def draw(name, script):
    """gnuplot's picture docs/pictures/NAME.svg. Returns the line that shows it."""
    PICTURES.mkdir(exist_ok=True)
    file = PICTURES / f'{name}.svg'
    head = f"set terminal svg size 760,420 font 'sans,11' background 'white'\nset output '{file}'\n"
    subprocess.run(['gnuplot'], input=head + script, text=True, check=True)
    return [f'![{name}](pictures/{name}.svg)', '']


def block(name, points):
    return f'${name} << EOD\n' + ''.join(' '.join(map(str, p)) + '\n' for p in points) + 'EOD\n'


def work_precision(rows, scene):
    """Curves over sub-steps; a larger point is one step a frame; failures are open points at the upper edge."""
    of = [r for r in rows if r.scene == scene and r.outcome != 'impossible']
    values = [max(r.errors[0].value, FLOOR) for r in of if holds(r)]
    edge = 10 * max(values, default=1)
    script = (f"set logscale xy\nset format '%.0e'\n{KEY}set grid\nset title '{scene}'\n"
              f"set xlabel 'CPU time per simulated second, s'\nset ylabel '{of[0].errors[0].name}'\n"
              f'set yrange [:{2 * edge}]\n')
    plots = []
    for index, name in enumerate(dict.fromkeys(map(solver, of))):
        mine = [r for r in of if solver(r) == name]
        good = [(cost(r), max(r.errors[0].value, FLOOR), 1.2 if r.substeps == 1 else .6) for r in mine if holds(r)]
        bad = [(cost(r), edge) for r in mine if not holds(r)]
        colour, shape = f'lc {index % COLOURS + 1}', 5 + 2 * (index % SHAPES)
        if good:
            script += block(f'good{index}', good)
            plots.append(f"$good{index} using 1:2:3 with linespoints pt {shape} ps variable {colour} title '{name}'")
        if bad:
            script += block(f'bad{index}', bad)
            plots.append(f'$bad{index} with points pt {shape - 1} {colour} ' +
                         ('notitle' if good else f"title '{name}'"))
    return draw(f'performance-{scene}', script + 'plot ' + ', '.join(plots) + '\n')


def cheapest(rows, scene, name, least):
    """s per simulated second of the cheapest row that reaches the level, over all numbers of sub-steps."""
    costs = [cost(r) for r in rows if r.scene == scene and solver(r) == name and level(r) is not None and
             level(r) <= least]
    return min(costs, default=math.inf)


def crowds(rows):
    """The scenes that are compared with fewer settings."""
    ran = {(r.scene, r.setting) for r in rows if r.engine.startswith('Karma')}
    return {scene for scene, setting in ran if setting == 'auto' and (scene, 'exact') not in ran}


def profile(rows, least, group, text):
    """Dolan and More 2002: of the scenes, the share that a solver does within a factor of the cheapest's cost."""
    scenes, names = list(dict.fromkeys(r.scene for r in rows)), profile_solvers(rows)
    best = {s: min(merged_cost(rows, s, n, least) for n in names) for s in scenes}
    script = (KEY + "set logscale x\nset yrange [0:1]\nset xrange [1:1000]\nset grid\n"
              f"set title '{text}: reaches {LEVELS[least]}'\nset xlabel 'cost, times the cheapest'\n"
              "set ylabel 'share of the scenes'\n")
    plots = []
    for index, name in enumerate(names):
        ratios = sorted(c / best[s] for s in scenes if math.isfinite(c := merged_cost(rows, s, name, least)))
        points = [(1, sum(r <= 1 for r in ratios) / len(scenes))]
        points += [(r, (i + 1) / len(scenes)) for i, r in enumerate(ratios)] + [(1000, len(ratios) / len(scenes))]
        script += block(f'p{index}', points)
        plots.append(f"$p{index} with steps lw 2 lc {index % COLOURS + 1} dt {1 + index // COLOURS} title '{name}'")
    return draw(f'performance-{group}-{LEVELS[least]}', script + 'plot ' + ', '.join(plots) + '\n')


def profile_solvers(rows):
    """One name for each solver; Karma's two programs have different names for their first setting."""
    return [n for n in dict.fromkeys(map(solver, rows)) if not n.endswith('eps 0') and not n.endswith('eps 1e-4')]


def merged_cost(rows, scene, name, least):
    """Without contact a universe's settings of contacts do not matter: the rigid world stands for them."""
    if name.startswith('Karma') and not any(r.scene == scene and solver(r) == name for r in rows):
        precision = ' '.join(name.split()[:2])
        name = precision + (' eps 1e-4' if name.endswith('defaults') else ' eps 0')
    return cheapest(rows, scene, name, least)


# Sections

def load_warning(machine):
    cores = int(machine['processor'].split(',')[-1].split()[0])
    loads = [float(machine[key].split()[0]) for key in ('load at the start', 'load at the end') if key in machine]
    if max(loads, default=0) > cores:
        yield from ['**The machine was not quiet**: more processes wanted to run than there are cores. CPU times are little '
                    'touched by that;', 'times by the clock are: those of two threads, the 99th percentiles and worst '
                    'frames, and what is said to be too slow.', '']


def engines(directory):
    """What each engine says of itself; of which scenes, where it says two things."""
    told = collections.OrderedDict()
    for name, scenes_of in (('free', 'without contact'), ('contact', 'with contact')):
        file = directory / f'{name}.txt'
        for line in file.read_text(encoding='utf8').splitlines() if file.exists() else ():
            if line.startswith('* '):
                told.setdefault(line, []).append(scenes_of)
    subjects = collections.Counter(line.split(': ')[0] for line in told)
    for line, of in told.items():
        subject, text = line.split(': ', 1)
        yield line if subjects[subject] == 1 else f'{subject}, scenes {of[0]}: {text}'


def head(directory):
    yield from ['# Speed against error', '',
                'Scenes with a known answer, in Karma and in the engines that Debian packages. One program runs all of them, in',
                'turns. `tools/bench` makes this page; [bench.md](bench.md) says how it measures. Read ratios, not digits.',
                'Where no number of sub-steps is given, there is one step per frame of 1/60 s. Box3D and Jolt are not packaged:',
                'Box3D is in [threads](threads.md#how-much-faster) and [the solver](solver.md#crowds).', '']
    lines = (directory / 'machine.txt').read_text(encoding='utf8').splitlines()
    yield from table(('', ''), [line.split('|', 1) for line in lines])
    yield from load_warning(dict(line.split('|', 1) for line in lines))
    yield from [*engines(directory), '']
    command_line = lines[0].split('|')[1]
    yield from ['One command repeats the whole page:', ''] + command(command_line)


def scenes(directory):
    yield from ['## The scenes', '', 'Each line has the scene, then its errors. Tables and diagrams show the first error.', '']
    for line in (directory / 'scenes.txt').read_text(encoding='utf8').splitlines():
        name, text = line.split(': ', 1)
        yield f'* **{name}**: {text}'
    yield from ['', *command('tools/bench --list')]


def levels(rows):
    yield from ['## Levels', '', 'Platinum: every error is within the goal, which is set for Karma at one step per frame. Gold: within '
                f'{GOLD:g} times the goal.',
                'Bronze: the scene holds to the end, and its event happened. `-`: the engine lacks a feature. Karma '
                'has a row for each setting',
                'of a world (eps, scenes without contact) and of a universe (scenes with contact). One row of each makes all scenes.', '']
    counts = []
    for name in dict.fromkeys(map(solver, rows)):
        mine = [r for r in rows if solver(r) == name and r.substeps == 1]
        able = [r for r in mine if r.outcome != 'impossible']
        of = [level(r) for r in able]
        counts.append((name, *(str(of.count(i)) for i in range(3)),
                       str(sum(not holds(r) and r.outcome == 'fails' or r.outcome == 'holds' and not holds(r)
                               for r in able)),
                       str(sum(r.outcome == 'too slow' for r in able)), str(len(mine) - len(able))))
    yield from table(('solver', *LEVELS, 'fails', 'too slow', '-'), counts)
    yield from command('tools/bench --report')


def leads(rows):
    yield from ['## Where Karma leads, where it trails', '',
                "Karma's CPU time over that of the best other engine, each with its cheapest setting and number of "
                "sub-steps. Below 1 Karma leads.",
                '`only Karma`: no other engine reaches the level. `not Karma`: another one does, and Karma does not. '
                '`nobody`: none does within',
                'the time limit of a run. Nothing sleeps. Karma does not solve partitions at rest with unchanged inputs again',
                '([architecture.md](architecture.md), rest certificate): towers at rest gain most by that.', '']
    lines = []
    for scene in dict.fromkeys(r.scene for r in rows):
        line = [scene]
        for least in (2, 1, 0):
            got = [r for r in rows if r.scene == scene and level(r) is not None and level(r) <= least]
            ours = min((r for r in got if r.engine.startswith('Karma')), key=cost, default=None)
            theirs = min((r for r in got if not r.engine.startswith('Karma')), key=cost, default=None)
            if ours and theirs:
                line.append(f'{figure(cost(ours) / cost(theirs))} ({solver(theirs)}, {theirs.substeps} sub)')
            else:
                line.append('only Karma' if ours else 'not Karma' if theirs else 'nobody')
        lines.append(line)
    yield from table(('scene', *reversed(LEVELS)), lines)
    yield from command('tools/bench --report')


def diagrams(rows):
    yield from ['## Work and precision', '',
                'A curve has the numbers of sub-steps of a solver; its large point is one step per frame. Open points '
                'at the upper edge fail.', f'Errors below {FLOOR:g} are drawn there.', '']
    present = {r.scene for r in rows}
    for scene in SHOWN:
        if scene in present:
            yield from work_precision(rows, scene)
            yield from command(f'tools/bench --scene {scene}          # its figures alone')
    yield from ['## Performance profiles', '',
                'The share of scenes that a solver does at the level, over the ratio of its CPU time to that of the '
                'cheapest (Dolan and Moré',
                '2002). Each solver has its best number of sub-steps.', '']
    many = crowds(rows)
    for group, text, of in (('profile', 'scenes of few bodies', [r for r in rows if r.scene not in many]),
                            ('crowds', 'crowds', [r for r in rows if r.scene in many])):
        for least in (2, 1):
            if of:
                yield from profile(of, least, group, text)
                yield from command('tools/bench --report')


def distribution(rows):
    yield from ['## Times of frames', '',
                'µs, one step per frame, medians over the runs. Brackets have the least and the largest run of the median frame.', '']
    lines = []
    for r in rows:
        if r.scene in TIMED and r.substeps == 1 and holds(r):
            lines.append((r.scene, solver(r), f'{figure(statistics.median(r.times))} ({figure(min(r.times))} to '
                          f'{figure(max(r.times))})', *(figure(statistics.median(t)) for t in (r.p95, r.p99, r.worst))))
    yield from table(('scene', 'solver', 'p50', 'p95', 'p99', 'worst'), lines)
    yield from command('tools/bench --report')


def lacks(rows):
    """What an engine has not, as it says itself."""
    yield from ['## What an engine cannot do', '', 'An engine is not compared in these scenes; elsewhere on this page they are `-`.', '']
    found = collections.OrderedDict()
    for r in rows:
        if r.lack:
            found.setdefault((r.engine, r.lack), ([], []))
            settings, names = found[r.engine, r.lack]
            settings.append(r.setting)
            names.append(r.scene)
    yield from table(('engine', 'settings', 'what it lacks', 'scenes'), [
        (engine, ', '.join(dict.fromkeys(settings)), lack, ', '.join(dict.fromkeys(names)))
        for (engine, lack), (settings, names) in found.items()])
    yield from command('tools/bench --report')


def swept(directory):
    """The rows of the sweep of settings: errors, no times."""
    names = [line.split(': ', 1)[0] for line in (directory / 'scenes.txt').read_text(encoding='utf8').splitlines()]
    with open(directory / 'solvers.txt', encoding='utf8') as source:
        solvers = {line[0]: line[1:] for line in csv.reader(source)}
    for line in read_lines(directory, 'sweep'):
        errors = [Error(suffix, number(line['goal' + suffix]), number(line['value' + suffix]))
                  for suffix in ('', ' 2', ' 3') if line['status'] == 'ok' and line['goal' + suffix] not in ('', 'nan')]
        outcome = line['status'] if line['status'] != 'ok' else 'fails' if line['fails'] == '1' else 'holds'
        yield Row(names[int(line['scene'])], *solvers[line['solver']], 2 ** int(line['sub-steps [power of 2]']), outcome,
                  [], [], [], [], [], errors, '')


def chosen(rows):
    """Of each scene and engine, each setting that reaches the best level any of its settings does, with the fewest
    sub-steps."""
    groups = collections.OrderedDict()
    for r in rows:
        if level(r) is not None:
            groups.setdefault((r.scene, r.engine), []).append(r)
    for of in groups.values():
        top = min(map(level, of))
        for setting in dict.fromkeys(r.setting for r in of):
            able = [r for r in of if r.setting == setting and level(r) == top]
            if able:
                yield min(able, key=lambda r: r.substeps)


def sweep_text(directory):
    rows = list(swept(directory))
    if not rows:
        return
    made = [r for r in rows if not r.outcome.startswith('failed')]
    late = sum(r.outcome in ('late', 'died') for r in made)
    substeps = ', '.join(map(str, sorted({r.substeps for r in rows})))
    yield from ['More numbers of sub-steps than all rows are timed with are swept for their errors alone by `karma-sweep` '
                '([sweep.md](sweep.md)): '
                f'{substeps} steps a frame, {len(made)} runs of {len({r.scene for r in made})} scenes ({late} of them ended '
                'early). For each scene and engine every setting', 'that reaches the best level any of the engine\'s does, with '
                'the fewest sub-steps that do, is timed along with the others, in turns: '
                f'{len(list(chosen(rows)))} rows, some of them among the others anyway.', '']
    yield from command((directory / 'sweep.txt').read_text(encoding='utf8').strip())


def best(rows, directory):
    yield from ['## Best settings', '',
                'For each engine, the cheapest row of the best level that it reaches. A cell has the level, the '
                'setting, sub-steps, and the CPU',
                'time per simulated second in ms. Timed: ' + sweep(rows) + '.', '', *sweep_text(directory)]
    engines = list(dict.fromkeys(r.engine for r in rows))
    lines = []
    for scene in dict.fromkeys(r.scene for r in rows):
        line = [scene]
        for engine in engines:
            able = [r for r in rows if r.scene == scene and r.engine == engine and level(r) is not None]
            top = min(able, key=lambda r: (level(r), cost(r)), default=None)
            line.append(f'{LEVELS[level(top)]}: {top.setting}, {top.substeps}, {figure(1e3 * cost(top))}' if top else '-')
        lines.append(line)
    yield from table(('scene', *engines), lines)
    yield from command('tools/bench --report')


def sweep(rows):
    parts = []
    for engine in dict.fromkeys(r.engine for r in rows):
        settings = dict.fromkeys(r.setting for r in rows if r.engine == engine)
        parts.append(f'{engine} with {", ".join(settings)}')
    substeps = sorted({r.substeps for r in rows})
    return '; '.join(parts) + f'; sub-steps {", ".join(map(str, substeps))}, not of every scene and setting all'


def published(rows):
    """SimBenchmark: our figures beside the published ones, at the same steps."""
    theirs = collections.OrderedDict()
    with open(TOP / 'bench' / 'published.csv', encoding='utf8') as source:
        for line in csv.DictReader(source):
            name = f"{line['engine']} {line['solver']}".strip()
            theirs.setdefault(line['scene'], collections.OrderedDict()).setdefault(name, {})[line['step s']] = line['error']
    if not any(r.scene in theirs for r in rows):
        return
    yield from ['## Published benchmarks', '', 'SimBenchmark (Kang and Hwangbo 2018): the mean square error that each of its '
                'scenes defines, with steps of 10 and 1 ms;', 'beside it what its authors published (their repository\'s '
                'files `data/*/sample.csv` and `default.csv`, without error reduction: `bench/published.csv`).',
                'Their peers are older versions, with other settings of their own. [bench.md](bench.md) says what differs.', '']
    for scene, figures in theirs.items():
        mine = [r for r in rows if r.scene == scene]
        lines = []
        for name in dict.fromkeys(map(solver, mine)):
            at = {r.substeps: r for r in mine if solver(r) == name}
            coarse, fine = at.get(1), at[max(at)] if len(at) > 1 else None
            lines.append((name, 'here', *(short(r) if r else '' for r in (coarse, fine)), *(
                figure(1e3 * cost(r)) if r and r.cpus and holds(r) else '' for r in (coarse, fine))))
        for name, by_step in figures.items():
            lines.append((name, 'published', *(f'{float(by_step[h]):.1e}' if h in by_step else ''
                                               for h in ('0.01', '0.001')), '', ''))
        yield from [f'**{scene}**', '']
        yield from table(('solver', '', '10 ms', '1 ms', 'ms a second, 10 ms', '1 ms'), lines)
        yield from command(f'tools/bench --scene {scene}')


def short(row):
    if row.outcome == 'impossible':
        return '-'
    return f'{row.errors[0].value:.1e}' if holds(row) else 'too slow' if row.outcome == 'too slow' else 'fails'


def read_lines(directory, name):
    file = directory / f'{name}.csv'
    if not file.exists():
        return []
    with open(file, encoding='utf8') as source:
        return list(csv.DictReader(source))


def consistency(directory):
    """After Erez, Tassa, Todorov 2015."""
    lines = read_lines(directory, 'consistency')
    if not lines:
        return
    yield from ['## Consistency', '', 'After Erez, Tassa and Todorov 2015: from states along a run with steps of 1/3840 s, '
                'how far a tenth of a second with larger', 'steps ends from where the fine ones do, in the same engine: root '
                'mean square over the bodies, mean over the starts, m.', 'The curves are steps of 1/60 to 1/960 s. What an '
                'engine does consistently wrong is not seen.', '']
    for scene in dict.fromkeys(line['scene'] for line in lines):
        of = [line for line in lines if line['scene'] == scene]
        script = (f"set logscale xy\nset format '%.0e'\n{KEY}set grid\nset title '{scene}'\n"
                  "set xlabel 'CPU time of a frame, us'\nset ylabel 'distance, m'\n")
        plots = []
        for index, name in enumerate(dict.fromkeys(solver_of(line) for line in of)):
            points = [(line['us'], max(float(line['error']), FLOOR)) for line in of if solver_of(line) == name
                      and math.isfinite(float(line['error'])) and float(line['us']) > 0]
            if points:
                script += block(f'c{index}', points)
                plots.append(f"$c{index} with linespoints pt {5 + 2 * (index % SHAPES)} lc {index % COLOURS + 1} title '{name}'")
        yield from draw(f'performance-consistency-{scene}', script + 'plot ' + ', '.join(plots) + '\n')
    yield from command('build/bench/bench/consistency')


def solver_of(line):
    return f"{line['engine']} {line['setting']}"


def exponent(points):
    """The slope of the best straight line through the logarithms."""
    if len(points) < 2:
        return math.nan
    xs, ys = [math.log(x) for x, _ in points], [math.log(y) for _, y in points]
    mx, my = statistics.mean(xs), statistics.mean(ys)
    return sum((x - mx) * (y - my) for x, y in zip(xs, ys)) / sum((x - mx) ** 2 for x in xs)


def scaling(directory):
    lines = read_lines(directory, 'scaling')
    if not lines:
        return
    yield from ['## Growth', '',
                'Mean CPU time of a frame of 1/60 s, in ms, over 2 s of game time; one step per frame. The exponent '
                'is that of the best fit, a',
                'power of the size. Empty: beyond the time limit, or not possible. In brackets: the scene fails.', '']
    for kind in dict.fromkeys(line['kind'] for line in lines if line['what'] == 'time'):
        of = [line for line in lines if line['kind'] == kind and line['what'] == 'time']
        sizes = sorted({int(line['size']) for line in of})
        found, script, plots = [], f"set logscale xy\n{KEY}set grid\nset title '{kind}'\nset xlabel '{of[0]['unit']}'\n" \
            "set ylabel 'CPU time of a frame, us'\n", []
        for index, name in enumerate(dict.fromkeys(map(solver_of, of))):
            at = {int(line['size']): line for line in of if solver_of(line) == name}
            points = [(size, float(line['value'])) for size, line in at.items()
                      if line['outcome'] == 'holds' and float(line['value']) > 0]
            found.append((name, *(growth_cell(at.get(size)) for size in sizes), f'{exponent(points):.2f}'))
            if not points:
                continue
            script += block(f's{index}', points)
            plots.append(f"$s{index} with linespoints pt {5 + 2 * (index % SHAPES)} lc {index % COLOURS + 1} title '{name}'")
        yield from [f'**{kind}**', '']
        yield from draw('performance-growth-' + kind.replace(' ', '-'), script + 'plot ' + ', '.join(plots) + '\n')
        yield from table(('solver', *(f"{size} {of[0]['unit']}" for size in sizes), 'exponent'), found)
        yield from command('build/bench/bench/scaling')
    weights = [line for line in lines if line['what'] == 'memory']
    kinds = list(dict.fromkeys(line['kind'] for line in weights))
    yield from ['## Memory', '',
                'Bytes for one more: the growth of the process over an empty world, divided by the number of bodies '
                'in the last column. A body',
                'has a model and a shape. `-`: none, as MuJoCo allocates the maximum in advance.', '']
    yield from table(('engine', *kinds, 'bodies'), [
        (engine, *(next(line['value'] if float(line['value']) > 0 else '-' for line in weights if line['engine'] == engine and line['kind'] == kind)
                   for kind in kinds), next(line['size'] for line in weights if line['engine'] == engine))
        for engine in dict.fromkeys(line['engine'] for line in weights)])
    yield from command('build/bench/bench/scaling')


def growth_cell(line):
    if not line:
        return ''
    text = figure(float(line['value']) / 1e3)
    return text if line['outcome'] == 'holds' else f'({text})'


def hour(directory):
    lines = read_lines(directory, 'hour')
    if not lines:
        return
    yield from ['## Energy and momentum', '', 'The largest errors so far, at three times of one run with one step a frame: '
                'of the energy over m g l or the kinetic energy at', 'the start, of the angular momentum over that at the '
                'start, of the momentum over the mass times 1 m/s. `-`: it is tied to the world.', '']
    yield from table(('scene', 'solver', 'minutes', 'energy', 'angular momentum', 'momentum', ''), [
        (line['scene'], solver_of(line), f"{float(line['minutes']):g}", f"{float(line['energy']):.1e}",
         *(f'{float(line[c]):.1e}' if line[c] else '-' for c in ('angular momentum', 'momentum')),
         line['outcome'] if line['outcome'] != 'holds' else '') for line in lines])
    yield from command('build/bench/bench/hour')


def cell(row):
    if row.outcome == 'impossible':
        return '-'
    what = f'{row.errors[0].value:.1e}' if holds(row) else 'too slow' if row.outcome == 'too slow' else 'fails'
    return f'{what}, {figure(statistics.median(row.times))}'


def everything(rows, title, name):
    yield from [f'## {title}', '', 'The first error of the scene, and the median time of a frame in µs.', '']
    solvers = list(dict.fromkeys(map(solver, rows)))
    lines = []
    for scene, substeps in dict.fromkeys((r.scene, r.substeps) for r in rows):
        cells = {solver(r): cell(r) for r in rows if r.scene == scene and r.substeps == substeps}
        lines.append((scene, str(substeps), *(cells.get(s, '') for s in solvers)))
    yield from table(('scene', 'sub', *solvers), lines)
    yield from command(f'column -s, -t out/bench/{name}.csv | less -S')


def marginal(directory):
    file = directory / 'marginal.csv'
    if not file.exists():
        return
    yield from ['## What one more costs', '',
                'ns per step of 1/60 s, single precision, one thread: the difference of two worlds, over the '
                'difference of their numbers. The',
                'median, and the least and the largest run. [advice.md](advice.md) has the conclusions.', '']
    with open(file, encoding='utf8') as source:
        yield from table(('one more', 'ns', 'least', 'largest'), [
            (line['what'], *(f'{float(line[c]):.0f}' for c in ('ns', 'least', 'largest')))
            for line in csv.DictReader(source)])
    yield from command('build/bench/bench/marginal')


ADVICE = (  # the cheaper one, the dearer one, what to do, what is lost; both are lines of marginal.csv
    ('box that sleeps', 'box that slides, four contacts, cone', 'Let bodies sleep (`MdtWorldSetAutoDisable`).',
     'nothing, while nothing touches them'),
    ('sphere that rolls, one contact, cone', 'box that slides, four contacts, cone',
     'Take a sphere where the shape is not seen: one contact instead of four.', 'it rolls'),
    ('box that slides, four contacts, no friction', 'box that slides, four contacts, cone',
     'Leave out friction where nothing is to stop.', 'it slides for ever'),
    ('box that slides, four contacts, box friction', 'box that slides, four contacts, cone',
     'Box friction instead of the cone.', 'the bound does not follow the weight, and depends on the direction'),
    ('box that slides, four contacts, normal force', 'box that slides, four contacts, cone',
     'Two bounds by the normal force instead of the cone.', 'on a diagonal friction is the root of 2 times too large'),
    ('body on a ball joint', 'body on a hinge', 'A ball joint where the axis need not be held.', 'it may turn any way'),
    ('body in a plane (linear 1)', 'body on a prismatic joint', 'One row where one direction is all that is held.',
     'the rest is free'),
    ('body on a hinge', 'body on a hinge with a motor', 'A hinge without its motor.', 'it is not driven'),
    ('sphere that rolls, one contact, cone', 'sphere that rolls, with a rolling bound',
     'No rolling bound (`MdtContactParamsSetRollingFriction`) where nothing rolls to its rest.', 'it rolls for ever'),
    ('box that slides, four contacts, cone', 'box that slides on a mesh',
     'A plane or a box instead of flat triangles (`McdMesh`).', 'nothing, if the ground is flat'),
    ('box that slides, four contacts, cone', 'box that slides, swept',
     'Sweep (`McdModelSetSwept`) only what may pass a wall in a step.', 'nothing, for what is slower'),
    ('box that slides, four contacts, cone', 'body that the program moves, and a box on it',
     'A fixed model where nothing moves, instead of a kinematic body.', 'it stands still'),
    ('car on four wheels that are cast (vehicle)', 'car on four wheels that are bodies (vehicle)',
     'Wheels that are cast (`MstVehicle`), instead of bodies on car-wheel joints.', 'wheels do not touch what they drive past'),
    ('character that walks (mover)', 'character that walks on a mesh',
     'Planes and boxes under characters (`MstMover`), instead of triangles.', 'nothing, if the ground is flat'),
)


def advice(directory):
    with open(directory / 'marginal.csv', encoding='utf8') as source:
        costs = {line['what']: float(line['ns']) for line in csv.DictReader(source)}
    lines = [(what, f'{costs[dear]:.0f}', f'{costs[cheap]:.0f}', f'{costs[cheap] / costs[dear]:.2g}', lost)
             for cheap, dear, what, lost in ADVICE]
    yield from ['# Model only what a scene needs', '',
                'What a feature costs, and what leaving it out loses. Times are ns per step of one more, from',
                '[performance.md](performance.md#what-one-more-costs); `tools/bench` makes this page along with it. A '
                'share near 1 saves nothing: take what is',
                'right. For the settings of your own scene run it with `-advise`: it prints time and error of each',
                '([How do I](howto.md#settings-that-make-a-scene-faster)).', '']
    yield from table(('advice', 'ns before', 'ns after', 'share', 'what is lost'), lines)
    yield from command('build/bench/bench/marginal')


def main(directory):
    groups = {name: list(read_rows(directory / f'{name}.csv')) for name in ('free', 'contact')
              if (directory / f'{name}.csv').exists()}
    rows = [r for group in groups.values() for r in group]
    page = [*head(directory), *scenes(directory), *lacks(rows), *levels(rows), *leads(rows), *best(rows, directory),
            *diagrams(rows), *published(rows), *consistency(directory), *distribution(rows), *scaling(directory), *hour(directory),
            *marginal(directory),
            *everything(groups['free'], 'All scenes without contact', 'free'),
            *everything(groups['contact'], 'All scenes with contact', 'contact')]
    (TOP / 'docs' / 'performance.md').write_text('\n'.join(page).rstrip() + '\n', encoding='utf8')
    (TOP / 'docs' / 'advice.md').write_text('\n'.join(advice(directory)).rstrip() + '\n', encoding='utf8')
    print(f'{len(rows)} rows: docs/performance.md')


if __name__ == '__main__':
    if len(sys.argv) == 3 and sys.argv[1] == '--rows':
        for row in chosen(swept(pathlib.Path(sys.argv[2]))):
            print(row.scene, row.engine, row.setting, row.substeps, sep=',')
        sys.exit()
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
