#!/usr/bin/env python3
"""check_ranks.py SWEEP SCENE MPIRUN - karma-sweep on several ranks of MPI: the bytes of one machine, also when a rank is killed."""
import os
import pathlib
import signal
import sys
import tempfile

sys.dont_write_bytecode = True
import sweep
from sweep import check, children, finish, lines_of, start, wait_for

program, scene, mpirun = sys.argv[1:4]
directory = pathlib.Path(tempfile.mkdtemp())
GRID = ['-set', 'a=0:3:40', '-set', 'b=-1:1:15']  # 600 runs
QUIET = {'OMPI_ALLOW_RUN_AS_ROOT': '1', 'OMPI_ALLOW_RUN_AS_ROOT_CONFIRM': '1', 'ASAN_OPTIONS': 'detect_leaks=0'}
LOCAL = ['--oversubscribe', '--bind-to', 'none', '--mca', 'btl', 'self,vader', '--mca', 'btl_vader_single_copy_mechanism', 'none']


def ranks(count, name, *more, delay=0):
    return start([mpirun, '-n', str(count), *LOCAL, *more, program, scene, '-out', name, '-silence', '3', *GRID], directory, delay, **QUIET)


def right():
    finish(start([program, scene, '-out', 'right.csv', *GRID], directory, **QUIET))
    return (directory / 'right.csv').read_bytes()


def rank_to_kill(launcher):
    """The rank with the largest number: its environment says which it is."""
    numbered = []
    for child in children(launcher):
        words = pathlib.Path(f'/proc/{child}/environ').read_bytes().split(b'\0')
        numbered += [(int(w.split(b'=')[1]), child) for w in words if w.startswith(b'OMPI_COMM_WORLD_RANK=')]
    return max(numbered)[1]


def killed(name, *more):
    """A rank is killed after some rows. -> exit code, what was said."""
    journal = directory / f'{name}.journal'
    process = ranks(3, name, *more, delay=6000)
    wait_for('rows', lambda: lines_of(journal) > 60)
    os.kill(rank_to_kill(process.pid), signal.SIGKILL)
    return finish(process)


expected = right()
for count in 1, 2, 4:
    code, said = finish(ranks(count, f'r{count}.csv'))
    check(f'{count} ranks, the same bytes', code == 0 and (directory / f'r{count}.csv').read_bytes() == expected, said)

# mpirun ends all with the first that dies; the next start goes on.
code, said = killed('ended.csv')
check('mpirun has ended all', code != 0 and not (directory / 'ended.csv').exists(), said)
there = lines_of(directory / 'ended.csv.journal') - 1
code, said = finish(ranks(3, 'ended.csv'))
check('goes on', code == 0 and f'{there} of 600 rows are there already' in said, said)
check('after that, the same bytes', (directory / 'ended.csv').read_bytes() == expected)

# Told to go on, the others do the share of the dead one.
code, said = killed('recovered.csv', '--enable-recovery')
check('the dead rank is reported', 'rank 2 has been silent' in said and 'run again' in said, said)
check('the others have done its share', (directory / 'recovered.csv').exists() and
      (directory / 'recovered.csv').read_bytes() == expected, f'exit code {code}\n{said}')
print(f'{sweep.wrong} wrong')
sys.exit(sweep.wrong > 0)
