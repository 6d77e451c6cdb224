#!/usr/bin/env python3
"""check_faults.py SWEEP SCENE WRONG SOURCE CC - karma-sweep refuses what it cannot do, and says what to change; and
nothing that a run does costs more than that run. SCENE is of scene.c, WRONG of wrong_scene.c."""
import os
import pathlib
import re
import resource
import shutil
import signal
import socket
import stat
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
import sweep
from sweep import check, finish, start, wait_for, children

program, scene, wrong_scene, source = map(os.path.abspath, sys.argv[1:5])
cc = sys.argv[5]
directory = pathlib.Path(tempfile.mkdtemp())
FOUR = ['-set', 'b=1']  # runs; mishaps are in run 2

LATE = r'took more than 1 s \(-limit\) in run 2: it is ended'

# As in scene.c; status of run 2, and what is said of it.
MISHAPS = [
    ('nothing', 'ok', ''),
    ('isKilled', 'died', r'by signal 9 .*in run 2: given up'),
    ('hangs', 'late', LATE),
    ('fails', 'failed(7)', ''),
    ('stops', 'late', LATE),
    ('handlesAllSignals', 'ok', ''),
    ('blocksAllSignals', 'late', LATE),
    ('handlesAndLoops', 'late', LATE),
    ('becomesAnother', 'late', LATE),
    ('closesAll', 'ok', ''),
    ('closesStreams', 'ok', ''),
    ('writesToAll', 'ok', ''),
    ('leavesChild', 'ok', ''),
    ('returnsTwice', 'ok', ''),
    ('leaves', 'died', r'left with exit code 0 in run 2: given up'),
    ('leavesAtOnce', 'died', r'left with exit code 3 in run 2: given up'),
    ('aborts', 'died', r'in run 2: given up'),
    ('prints', 'ok', r'run \d, or one near it, prints more than 10000 bytes'),
    ('roundsUp', 'ok', ''),
    ('killsGroup', 'died', r'by signal 15 .*in run 2: given up'),
    ('leavesTimer', 'ok', r'by signal 14 .*in run 3: its share is run again')]

# As in wrong_scene.c: what is said.
WRONG = [
    'another version of KarmaSweep.h: compile it again',
    'name is null, empty, or has a slash',
    'name is null, empty, or has a slash',
    'function run is null',
    'parameterCount has to be 0 to 32',
    'parameterCount has to be 0 to 32',
    'table of parameters is null',
    'resultCount has to be 1 to 64',
    'resultCount has to be 1 to 64',
    'resultCount has to be 1 to 64',
    'table of results is null',
    'wrong result 0: its name is null',
    'wrong result 0: its name',
    'wrong parameter 0: its name is null',
    'wrong parameter 0: its name',
    'least <= largest',
    'have to be finite',
    'have to be finite',
    'count has to be 1 or more',
    'sweepScene returns null',
    'cannot be loaded: that ends the process',
    'cannot be loaded: that ends the process with exit code 0',
    'cannot be loaded: that ends the process']


def sweeps(name, *options, of=scene, **more):
    return start([program, of, '-out', name, '-workers', '2', *options], directory, **more)


def table_of(name):
    path = directory / name
    return path.read_bytes() if path.exists() else None


def refuses(what, text, process):
    code, said = finish(process)
    check(f'{what}: exit code {code}, expected 2', code == 2, said)
    check(f'{what}: says {text!r}', text in said, said)
    check(f'{what}: no sanitizer complains', 'runtime error' not in said, said)


def check_mishaps():
    # The first mishap does nothing: its table is what all others are compared with, but for the parameter's column.
    alone = {'leavesTimer', 'roundsUp'}  # what they leave behind is for the next run in the same process
    running = [sweeps(f'{name}.csv', *FOUR, '-set', f'mishap={i}', '-limit', '01'[status == 'late'],
                      '-workers', '12'[name not in alone], delay=20000 * (name in alone))
               for i, (name, status, _) in enumerate(MISHAPS)]
    right = None
    for i, (process, (name, status, text)) in enumerate(zip(running, MISHAPS)):
        code, said = finish(process)
        lines = re.sub(rb'(?m)^(\d+,[^,]*,[^,]*),\d+,', rb'\1,0,', table_of(f'{name}.csv') or b'').split(b'\n')
        right = right or lines
        check(f'{name}: exit code {code}', code == (status != 'ok'), said)
        same = [line == other for line, other in zip(lines, right)]
        check(f'{name}: other rows are as without it', len(lines) == len(right) and
              all(same[:3] + same[4:]) and (same[3] or status != 'ok'), lines)
        check(f'{name}: run 2 is {status}', len(lines) > 3 and lines[3].endswith(f',{status}'.encode()), said)
        check(f'{name}: says {text!r}', re.search(text, said), said)
        check(f'{name}: no flood', len(said) < 45000, len(said))
        journal = directory / f'{name}.csv.journal'
        check(f'{name}: the journal is whole', journal.read_bytes().count(b'\n') == 5)


def check_left_behind():
    """Children of runs end with the sweep."""
    def left():
        found = []
        for file in pathlib.Path('/proc').glob('[0-9]*/environ'):
            try:
                found += [file] if b'SWEEP_TEST_MARK=left' in file.read_bytes() else []
            except OSError:
                continue
        return found
    code, said = finish(sweeps('left.csv', *FOUR, '-set', 'mishap=12', SWEEP_TEST_MARK='left'))
    check('a child of a run: exit code', code == 0, said)
    wait_for('the end of a child of a run', lambda: not left(), 5)


def check_suspended():
    """Time in which karma-sweep itself is stopped is none of the runs'."""
    process = sweeps('suspended.csv', '-set', 'a=0:1:2', '-set', 'b=1', '-limit', '2', delay=500000)
    wait_for('workers', lambda: len(children(process.pid)) == 2)
    workers = children(process.pid)
    for id_ in [process.pid, *workers]:
        os.kill(id_, signal.SIGSTOP)
    time.sleep(2.3)
    for id_ in [process.pid, *workers]:
        os.kill(id_, signal.SIGCONT)
    code, said = finish(process)
    check('suspended', code == 0 and 'limit' not in said, said)


def check_tables():
    running = [sweeps('wrong.csv', of=wrong_scene, SWEEP_TEST_WRONG=str(i)) for i in range(len(WRONG))]
    for i, (process, text) in enumerate(zip(running, WRONG)):
        refuses(f'wrong scene {i}', text, process)
    check('wrong scenes leave no files', not list(directory.glob('*wrong*')))


def library_of(code, name):
    (directory / f'{name}.c').write_text(code)
    subprocess.run([cc, '-shared', '-fPIC', '-o', f'{name}.so', f'{name}.c'], cwd=directory, check=True)
    return f'{name}.so'


def check_files():
    os.mkfifo(directory / 'pipe.so')
    (directory / 'text.so').write_text('This is no library.\n')
    (directory / 'empty.so').write_bytes(b'')
    (directory / 'directory.so').mkdir()
    whole = pathlib.Path(scene).read_bytes()
    for size in 32, 300, 2000, len(whole) // 4, len(whole) // 2, len(whole) - 100:
        (directory / f'cut{size}.so').write_bytes(whole[:size])
        code, said = finish(sweeps('cut.csv', '-again', of=f'cut{size}.so'))
        # What is at the end of a library is not needed to load it.
        fits = code == 2 and 'cannot be loaded' in said or code == 0 and size > 2000
        check(f'cut off at {size}: exit code {code}', fits, said)
    for name, text in (('missing.so', 'cannot be read'), ('pipe.so', 'has to be a file'),
                       ('/dev/zero', 'has to be a file'), ('directory.so', 'has to be a file'),
                       ('text.so', 'cannot be loaded'), ('empty.so', 'cannot be loaded'),
                       (library_of('int other;', 'without'), 'has no function sweepScene'),
                       (library_of('__attribute__((constructor)) static void f(void) { __builtin_trap(); }', 'traps'),
                        'cannot be loaded: that ends the process by signal')):
        refuses(name, text, sweeps('refused.csv', of=name))
    text = (pathlib.Path(__file__).parent / 'scene.c').read_text()
    (directory / 'precise.c').write_text(f'#include "MePrecision.h"\n{text}')
    refuses('the other precision', 'one precision: karma-mst or karma-mst-double', sweeps(
        'refused.csv', of='precise.c', KARMA_SWEEP_LIBS=' ',
        KARMA_SWEEP_CC=f'{cc} -I{source}/KarmaSweep/include -I{source}/MeGlobals/include -D_ME_API_DOUBLE=1'))
    check('refused scenes leave no files', not list(directory.glob('refused*')))


def make_device():
    """One that it would do no harm to lose; without the right to make one, one that cannot be lost."""
    try:
        os.mknod(directory / 'device', 0o600 | stat.S_IFCHR, os.makedev(1, 3))
        return 'device'
    except PermissionError:
        return '/dev/pts/ptmx'


def check_out():
    device = make_device()
    os.mkfifo(directory / 'pipe')
    (directory / 'link').symlink_to(device)
    (directory / 'nowhere').symlink_to('not-there')
    (directory / 'folder').mkdir()
    (directory / 'full.csv.journal').symlink_to('/dev/full')
    (directory / 'waits.csv.journal').symlink_to('pipe')
    (directory / 'drafts.csv.draft').mkdir()
    shutil.copy(scene, directory / 'scene.so')
    place = socket.socket(socket.AF_UNIX)
    place.bind(str(directory / 'socket'))
    for name, text in ((device, 'is a device'), ('pipe', 'is a pipe'), ('folder', 'is a directory'),
                       ('.', 'is a directory'), ('socket', 'is a socket'), ('link', 'is a device'),
                       ('nowhere', 'is a link to what'),
                       ('full.csv', 'is a device'), ('waits.csv', 'is a pipe'),
                       ('drafts.csv', 'drafts.csv.draft is a directory'), ('scene.so', 'is the scene'),
                       ('', 'lacks its value'), ('x' * 5000, 'choose a shorter one'), ('x' * 300, 'cannot be written'),
                       ('not-there/out.csv', 'cannot be written')):
        is_there = len(name) < 99 and os.path.lexists(directory / name)
        kind = is_there and os.lstat(directory / name).st_mode
        refuses(f'-out {name[:50]}', text, sweeps(name, of='./scene.so'))
        check(f'-out {name[:50]}: is what it was', not is_there or os.lstat(directory / name).st_mode == kind)
    check('a device has no journal', not list(directory.glob('device.*')))
    (directory / 'real.csv').write_text('')
    (directory / 'linked.csv').symlink_to('real.csv')
    code, said = finish(sweeps('linked.csv', *FOUR))
    check('a link to a file stays one', code == 0 and (directory / 'linked.csv').is_symlink() and
          table_of('real.csv') == table_of('nothing.csv'), said)


def check_options():
    for options, text in ((['-workers', '0'], '-workers: a whole number'), (['-workers', '257'], 'from 1 to 256'),
                          (['-limit', '99999999999'], '-limit: a whole'), (['-limit', '-1'], '-limit: a whole number'),
                          (['-silence', '0'], '-silence: a whole'), (['-sample', '0'], '-sample: a whole number'),
                          (['-sample', '100000001'], '-sample: a whole'), (['-seed', '9' * 20], '-seed: a whole'),
                          (['-set', 'a=0:1:4294967298'], 'a count from 1'), (['-set', 'a=1e999'], 'finite'),
                          (['-set', 'a=-1e308:1e308'], 'finite'), (['-set', 'a=nan'], 'finite'),
                          (['-set', 'a=0:1:2:3'], 'write name=value'), (['-set', 'a=1'] * 129, 'more than 128'),
                          (['-out'], 'lacks its value')):
        refuses(f'{options[:2]}', text, start([program, scene, *options], directory))
    check('refused options leave no files', not (directory / 'test.csv').exists())
    for option in '-list', '-help':
        with open('/dev/full', 'w', encoding='utf8') as full:
            done = subprocess.run([program, scene, option], stdout=full, stderr=subprocess.PIPE, text=True,
                                        check=False)
        check(f'{option} on a full disk', done.returncode == 2 and 'No space left' in done.stderr, done)


def limited(*limits):
    return lambda: [resource.setrlimit(kind, (most, resource.getrlimit(kind)[1])) for kind, most in limits]


def check_room():
    """No room for the journal, for the table, for processes; then there is."""
    right = table_of('nothing.csv')
    for most in 10, 150, len(right) - 10:
        code, said = finish(sweeps('room.csv', *FOUR, preexec=limited((resource.RLIMIT_FSIZE, most))))
        check(f'{most} bytes: exit code {code}', code == 2 and 'ulimit -f' in said and 'room.csv' in said, said)
        left = [path.name for path in directory.glob('room.csv*')]
        check(f'{most} bytes: no table, no draft', left == ['room.csv.journal'], left)
    # Rows are there, but no room for the table.
    finish(sweeps('table.csv', *FOUR))
    os.remove(directory / 'table.csv')
    code, said = finish(sweeps('table.csv', *FOUR, preexec=limited((resource.RLIMIT_FSIZE, 100))))
    check(f'no room for the table: exit code {code}', code == 2 and 'table.csv cannot be written' in said, said)
    check('no room for the table: no draft', table_of('table.csv.draft') is None and table_of('table.csv') is None)
    for name in 'room.csv', 'table.csv':
        code, said = finish(sweeps(name, *FOUR))
        check(f'{name}: goes on', code == 0 and table_of(name) == right, said)
    code, said = finish(sweeps('few.csv', *FOUR, '-workers', '20', preexec=limited((resource.RLIMIT_NOFILE, 12))))
    check('fewer workers', code == 0 and table_of('few.csv') == right and said.count('the others go on') == 1, said)


def check_surroundings():
    """Whoever starts it may have closed the standard files or ignore signals."""
    command = [program, scene, '-out', 'closed.csv', *FOUR, '-set', 'mishap=17']
    closed = subprocess.run(['sh', '-c', 'exec "$@" <&- >&- 2>&-', 'sh', *command], cwd=directory, check=False)
    check('standard files are closed', closed.returncode == 0 and table_of('closed.csv') == table_of('prints.csv'))
    def ignore():
        for number in signal.SIGCHLD, signal.SIGALRM, signal.SIGTERM:
            signal.signal(number, signal.SIG_IGN)
    code, said = finish(sweeps('ignored.csv', *FOUR, '-set', 'mishap=16', preexec=ignore))
    check('signals are ignored', code == 1 and table_of('ignored.csv') == table_of('aborts.csv'), said)


def check_journal():
    finish(sweeps('journal.csv', *FOUR))
    path, right = directory / 'journal.csv.journal', table_of('journal.csv')
    whole = path.read_bytes()
    head, *rows = whole.splitlines(keepends=True)
    survives = [('nothing', b''), ('a torn head', head[:9]), ('a head without its end', head[:-1]),
                ('the head alone', head), ('a torn row', whole[:-1]), ('zeros', head + rows[0] + bytes(100)),
                ('zeros in a row', whole[:-9] + bytes(9)), ('a row twice', whole + rows[1]),
                ('rows in another order', head + b''.join(reversed(rows))),
                ('an empty line', head + b'\n' + b''.join(rows)),
                ('another run', head + rows[0].replace(b'0', b'9', 1)),
                ('another checksum', head + rows[0][:-3] + b'zz\n'), ('no text', head + bytes(range(128, 256)) * 50)]
    for what, text in survives:
        path.write_bytes(text)
        os.remove(directory / 'journal.csv')
        code, said = finish(sweeps('journal.csv', *FOUR))
        check(f'journal: {what}', code == 0 and table_of('journal.csv') == right, said)
        found = path.read_bytes().splitlines(keepends=True)
        check(f'journal: {what}: whole again', found[0] == head and set(rows) <= set(found), found)
    refused = [('another text', b'Dear diary,\n' * 30), ('a line without end', b'Dear diary'), ('zeros', bytes(500)),
               ('a bit of the head', bytes([head[0] ^ 1]) + whole[1:]),
               ('another version', whole.replace(b'sweep 1', b'sweep 2', 1))]
    for what, text in refused:
        path.write_bytes(text)
        refuses(f'journal: {what}', 'or no journal: choose another -out, or -again', sweeps('journal.csv', *FOUR))
        check(f'journal: {what}: is as it was', path.read_bytes() == text)
    code, said = finish(sweeps('journal.csv', *FOUR, '-again'))
    check('journal: -again', code == 0 and table_of('journal.csv') == right, said)


for part in (check_mishaps, check_left_behind, check_suspended, check_tables, check_files, check_out, check_options,
             check_room, check_surroundings, check_journal):
    part()
shutil.rmtree(directory)
print(f'{sweep.wrong} wrong')
sys.exit(sweep.wrong > 0)
