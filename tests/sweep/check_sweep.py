#!/usr/bin/env python3
"""check_sweep.py SWEEP SCENE CATAPULT SOURCE CC - karma-sweep on one machine: its rows are right, and the same bytes whatever the
number of workers, whoever is killed, and wherever it goes on."""
import csv
import math
import os
import pathlib
import signal
import sys
import tempfile

sys.dont_write_bytecode = True
import sweep
from sweep import check, children, finish, lines_of, start, wait_for

program, scene, catapult, source, cc = sys.argv[1:6]
directory = pathlib.Path(tempfile.mkdtemp())
GRID = ['-set', 'a=0:3:40', '-set', 'b=-1:1:15']  # 600 runs


def run(name, *options, of=scene, code=0, **more):
    """-> the bytes of the table, and what was said."""
    done, said = finish(start([program, of, '-out', name, *options], directory, **more))
    check(f'{name} {options}: exit code {done}, expected {code}', done == code, said)
    path = directory / name
    return path.read_bytes() if path.exists() else b'', said


def rows(text):
    return list(csv.DictReader(text.decode().splitlines()))


def check_grid():
    table = rows(run('grid.csv', '-workers', '2')[0])
    check('12 rows in order', [r['run'] for r in table] == [str(i) for i in range(12)])
    for i, row in enumerate(table):
        a, b = float(i // 3), i % 3 - 1.0
        check(f'row {i}: {row}', float(row['a [m]']) == a and float(row['b']) == b and row['status'] == 'ok' and
              float(row['product [m]']) == a * b and float(row['root']) == math.sqrt(a + 10) and row['nothing'] == 'nan')
    table = rows(run('set.csv', '-set', 'a=1.5', '-set', 'b=0:4')[0])
    check('a set parameter', [(r['a [m]'], r['b']) for r in table] == [('1.5', '0'), ('1.5', '2'), ('1.5', '4')])
    said = finish(start([program, scene, '-list'], directory))[1]
    check('-list', 'parameter a [m]: 0 to 3, 4 on the grid' in said and '12 runs' in said, said)


def check_sample():
    few, many, other = (rows(run(f'{name}.csv', '-sample', n, '-seed', seed)[0])
                        for name, n, seed in (('few', '50', '1'), ('many', '200', '1'), ('other', '50', '2')))
    check('a sample begins as a larger one', few == many[:50])
    check('another seed, other values', all(x['a [m]'] != y['a [m]'] for x, y in zip(few, other)))
    for least, largest, name in ((0, 3, 'a [m]'), (-1, 1, 'b')):
        values = sorted((float(r[name]) - least) / (largest - least) for r in many)
        # The star discrepancy of 200 points: Halton's first two bases stay below .03, chance is at about .07.
        farthest = max(max(abs(v - i / 200), abs(v - (i + 1) / 200)) for i, v in enumerate(values))
        check(f'{name} is spread evenly: {farthest}', 0 <= values[0] and values[-1] <= 1 and farthest < .03)


def check_deaths():
    """Workers are killed, then the whole; what is there in the end is what it is without."""
    right = run('right.csv', *GRID, '-workers', '1')[0]
    for workers in '3', '7':
        check(f'{workers} workers, the same bytes', run(f'w{workers}.csv', *GRID, '-workers', workers)[0] == right)
    journal = directory / 'killed.csv.journal'
    process = start([program, scene, '-out', 'killed.csv', *GRID, '-workers', '3'], directory, delay=8000)
    for already in 60, 150:
        wait_for('rows', lambda: lines_of(journal) > already)
        os.kill(children(process.pid)[0], signal.SIGKILL)
    code, said = finish(process)
    check('killed workers are reported', said.count('was ended by signal 9') == 2 and said.count('run again') == 2, said)
    check('after killed workers, the same bytes', code == 0 and (directory / 'killed.csv').read_bytes() == right)

    (directory / 'killed.csv').unlink()
    journal.unlink()
    process = start([program, scene, '-out', 'killed.csv', *GRID, '-workers', '3'], directory, delay=8000)
    wait_for('rows', lambda: lines_of(journal) > 100)
    _, said = run('killed.csv', *GRID, code=2)
    check('two at once', 'at work in another' in said, said)
    workers = children(process.pid)
    process.kill()
    finish(process)
    wait_for('the end of workers without a master', lambda: not any(os.path.exists(f'/proc/{w}') for w in workers))
    check('no table before all is done', not (directory / 'killed.csv').exists())
    there = lines_of(journal) - 1
    again, said = run('killed.csv', *GRID)
    check('goes on where it was', f'{there} of 600 rows are there already' in said and
          f'600 rows, {600 - there} of them new' in said, said)
    check('after that, the same bytes', again == right)
    return right, journal


def check_damage(right, journal):
    whole = journal.read_bytes()
    for what, text in (('torn', whole[:-7]), ('a bit turned', whole[:9000] + bytes([whole[9000] ^ 1]) + whole[9001:]),
                       ('rubbish at the end', whole + b'5 ok 1 2 3 #0123456789abcdef\n'), ('empty', b'')):
        journal.write_bytes(text)
        (directory / 'killed.csv').unlink()
        table, said = run('killed.csv', *GRID)
        check(f'journal {what}: the same bytes', table == right, said)
        check(f'journal {what}: whole again', lines_of(journal) == 601)
    for options in ([], ['-sample', '600'], [*GRID, '-set', 'mishap=4']):
        table, said = run('killed.csv', *options, code=2)
        check(f'journal of other parameters: {options}', 'of another scene' in said and table == right, said)
    said = run('killed.csv', '-again')[1]
    check('-again', '12 rows, 12 of them new' in said, said)


def check_mishaps():
    for mishap, option, status in (('1', [], 'died'), ('2', ['-limit', '1'], 'late'), ('3', [], 'failed(7)')):
        for workers in '1', '2':
            name = f'mishap{mishap}-{workers}.csv'
            table, said = run(name, '-set', f'mishap={mishap}', '-set', 'b=1', '-workers', workers, *option, code=1)
            found = [r['status'] for r in rows(table)]
            check(f'{name}: {found}', found == ['ok', 'ok', status, 'ok'], said)
            check(f'{name}: {said}', said.count('in run 2') == {'1': 3, '2': 1, '3': 0}[mishap] and
                  '1 without results' in said and rows(table)[2]['root'] == '')


def check_source():
    text = pathlib.Path(__file__).with_name('scene.c').read_bytes()
    (directory / 'own.c').write_bytes(text)
    table, said = run('own.csv', of='own.c', KARMA_SWEEP_CC=f'{cc} -I{source}/KarmaSweep/include', KARMA_SWEEP_LIBS='')
    check('a scene of source', table == (directory / 'grid.csv').read_bytes(), said)
    (directory / 'own.c').write_bytes(text + b'#error\n')
    said = run('bad.csv', of='own.c', code=2, KARMA_SWEEP_CC=cc)[1]
    check('source with a mistake', 'own.c could not be compiled' in said, said)


def check_refusals():
    for options, text in ((['-set', 'c=1'], 'no parameter of that name'), (['-set', 'a=3:1'], 'write name=value'),
                          (['-set', 'a=0:1:0'], 'write name=value'), (['-set', 'a'], 'write name=value'),
                          (['-sample', 'x'], 'a whole number has to follow'), (['-nonsense'], 'is no option'),
                          (['-set', 'a=0:1:99999', '-set', 'b=0:1:99999'], 'is too large'), (['other'], 'already')):
        said = run('refused.csv', *options, code=2)[1]
        check(f'{options}', text in said, said)
    said = run('refused.csv', of=program, code=2)[1]
    check('no scene', 'cannot be loaded' in said or 'no function sweepScene' in said, said)


def check_catapult():
    """The heavier the weight, the farther: the energy of the weight is what the stone gets a part of."""
    options = ['-set', 'short arm=1', '-set', 'long arm=4', '-set', 'release=45', '-set', 'weight=500:4000:8']
    table, said = run('catapult.csv', *options, '-workers', '2', of=catapult)
    check('on one worker, the same bytes', run('catapult1.csv', *options, '-workers', '1', of=catapult)[0] == table)
    ranges = [float(r['range [m]']) for r in rows(table)]
    check(f'ranges {ranges}', len(ranges) == 8 and ranges == sorted(ranges), said)
    for row in rows(table):
        # Released at 45 degrees, from the end of the arm; up to a step later, in which it turns by 2 degrees.
        v, x, z = float(row['speed [m/s]']) / 2 ** .5, -4 / 2 ** .5, 5 + 4 / 2 ** .5
        flight = x + v * (v + math.sqrt(v * v + 2 * 9.81 * z)) / 9.81
        fall = math.sin(math.pi / 4) * 2  # of each arm's end, per metre of arm
        mass, arm = float(row['weight [kg]']), 4
        work = 9.81 * fall * (mass * 1 - 20 * arm - 150 * 1.5)  # of the weight, the stone, and the beam of 150 kg
        inertia = mass * 1 ** 2 + 20 * arm ** 2 + 150 * (5 ** 2 / 12 + 1.5 ** 2)
        check(f'{row}: energy', abs(float(row['speed [m/s]']) / (arm * math.sqrt(2 * work / inertia)) - 1) < .03)
        check(f'{row}: {flight}', abs(float(row['range [m]']) - flight) < .5 + .02 * flight and 0 < float(row['efficiency']) < 1)


check_grid()
check_sample()
check_damage(*check_deaths())
check_mishaps()
check_source()
check_refusals()
check_catapult()
print(f'{sweep.wrong} wrong')
sys.exit(sweep.wrong > 0)
