#!/usr/bin/env python3
"""check_settings.py SWEEP SETTINGS BENCH PIPELINE - the report's sweep of settings makes the errors that bench makes by
itself, with any number of workers."""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

import sweep
from sweep import check

SCENES = {'led-arm': 'bench', 'tumbling': 'bench', 'heavy-100': 'pipeline', 'incline': 'pipeline'}  # and who runs them
OUTCOMES = {'0': 'holds', '1': 'fails'}

program, settings = (pathlib.Path(arg).resolve() for arg in sys.argv[1:3])
benches = dict(zip(('bench', 'pipeline'), (pathlib.Path(arg).resolve() for arg in sys.argv[3:5])))


def told(option):
    return subprocess.run([benches['bench'], option], text=True, check=True, stdout=subprocess.PIPE).stdout.splitlines()


def read(path):
    with open(path, encoding='utf8') as source:
        return list(csv.DictReader(source))


def swept(directory, index, workers):
    out = directory / f'{index}-{workers}.csv'
    done = subprocess.run([program, settings, '-set', f'scene={index}', '-set', 'sub-steps=0:1:2', '-set', 'most=1e9',
                           '-workers', str(workers), '-out', out], text=True, capture_output=True, check=False)
    check('karma-sweep ends', done.returncode in (0, 1), done.stderr)  # 1: rows of solvers that are not for the scene
    return out


def same(ours, theirs):
    """bench writes six digits."""
    if math.isfinite(ours):
        return f'{ours:.6g}' == f'{float(theirs):.6g}'
    return not math.isfinite(float(theirs))


with tempfile.TemporaryDirectory() as name:
    directory = pathlib.Path(name)
    solvers = {row[0]: tuple(row[1:]) for row in csv.reader(told('--solvers'))}
    names = [line.split(':')[0] for line in told('--list')]
    for scene, bench in SCENES.items():
        out = swept(directory, names.index(scene), 2)
        check(f'{scene}: bytes', out.read_bytes() == swept(directory, names.index(scene), 1).read_bytes())
        mine = {(*solvers[row['solver']], str(2 ** int(row['sub-steps [power of 2]']))): row
                for row in read(out) if row['status'] == 'ok'}
        rows = directory / f'{scene}-bench.csv'
        subprocess.run([benches[bench], '--scene', scene, '--substeps', '1,2', '--csv', rows], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        compared = set()
        for theirs in read(rows):
            key = theirs['engine'], theirs['setting'], theirs['substeps']
            ours = mine.get(key)
            if not ours:
                check(f'{scene}: {key} is swept', theirs['setting'] == '2 threads')
                continue
            compared.add(key)
            check(f'{scene}: {key} {OUTCOMES[ours["fails"]]}', theirs['outcome'] == OUTCOMES[ours['fails']], theirs)
            for suffix in ('', ' 2', ' 3'):
                if theirs['value' + suffix]:
                    check(f'{scene}: {key} value{suffix}', same(float(ours['value' + suffix]), theirs['value' + suffix]),
                          f"{ours['value' + suffix]} {theirs['value' + suffix]}")
        check(f'{scene}: as many rows', compared == set(mine) and len(mine) > 0, f'{compared} {set(mine)}')
        print(f'{scene}: {len(compared)} rows')
print(f'{sweep.wrong} wrong')
sys.exit(sweep.wrong > 0)
