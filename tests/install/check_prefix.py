#!/usr/bin/env python3
"""Is Karma installed only where somebody meant it to be?

usage: check_prefix.py SOURCE

Configures Karma, builds nothing, and tries prefixes: those that are no place for it are refused with a message that says
why, before anything is written; the others get as far as the first library, which is not there. The lines of README.md
and docs/ that install must fail, and call nothing, where HOME is not set.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

QUICK = ['-DKARMA_VIEWER=OFF', '-DKARMA_TESTS=OFF', '-DKARMA_MPI=OFF']
STARTED = 'file INSTALL cannot find'  # nothing is built
NEW = f'/karma-{os.getpid()}'         # a directory that is not there


def install(build, *options, cwd='/', **environment):
    done = subprocess.run(['cmake', '--install', build, *options], capture_output=True, text=True, check=False, cwd=cwd,
                          env={**{k: v for k, v in os.environ.items() if k != 'DESTDIR'}, **environment})
    return done.returncode, ' '.join((done.stdout + done.stderr).split())


def complaints(source, scratch):
    build, given = scratch / 'build', scratch / 'given'
    for place, options in (build, []), (given, [f'-DCMAKE_INSTALL_PREFIX={scratch}/there']):
        subprocess.run(['cmake', '-S', source, '-B', place, *QUICK, *options], check=True, capture_output=True)
    (scratch / 'file').write_text('')
    (scratch / 'link').symlink_to(source)
    lines = [
        (build, [], {}, 'no prefix is given'),
        (build, ['--prefix', ''], {}, 'no prefix is given'),
        (build, [], {'DESTDIR': f'{scratch}/stage'}, 'no prefix is given'),
        (build, ['--prefix', '/'], {}, 'the root directory'),
        (build, ['--prefix', '//'], {}, 'the root directory'),
        (build, ['--prefix', NEW], {}, 'is HOME set?'),
        (build, ['--prefix', f'{NEW}/karma'], {}, 'is HOME set?'),
        (build, ['--prefix', source], {}, 'is inside of the source'),
        (build, ['--prefix', source / 'build/karma'], {}, 'is inside of the source'),
        (build, ['--prefix', source / 'Mst/../new'], {}, 'is inside of the source'),
        (build, ['--prefix', scratch / 'link/new'], {}, 'is inside of the source'),
        (build, ['--prefix', 'new'], {'cwd': source}, 'is inside of the source'),
        (build, ['--prefix', '/new'], {'DESTDIR': str(source)}, 'is inside of the source'),
        (build, ['--prefix', scratch / 'file/new'], {}, 'is no directory'),
        (build, ['--prefix', scratch / 'new'], {}, STARTED),
        (build, ['--prefix', f'{source}-new'], {'DESTDIR': f'{scratch}/stage'}, STARTED),
        (build, ['--prefix', NEW], {'DESTDIR': f'{scratch}/stage'}, STARTED),
        (build, ['--prefix', 'new'], {'cwd': scratch}, STARTED),
        (given, [], {}, STARTED),
        (given, ['--prefix', '/usr/local'], {'DESTDIR': f'{scratch}/stage'}, STARTED),
        (given, ['--prefix', source], {}, 'is inside of the source')]
    for place, options, more, text in lines:
        code, said = install(place, *options, **more)
        if code == 0 or text not in said or ('is not installed' in said) != (text != STARTED):
            yield f'{place.name} {options} {more}: expected {text!r}: exit code {code}, {said}'
    if os.path.exists(NEW) or (source / 'new').exists() or (source / 'build/karma').exists():
        yield 'a prefix that is refused is written to'


def lines_without_home(source):
    for page in source / 'README.md', *source.glob('docs/**/*.md'):
        for line in page.read_text().splitlines():
            if not line.startswith('cmake --install'):
                continue
            done = subprocess.run(['sh', '-c', f'cmake() {{ echo called; }}\nunset HOME\n{line}'], capture_output=True,
                                  text=True, check=False)
            if done.returncode == 0 or done.stdout:
                yield f'{page.name}: {line}: does not refuse where HOME is not set'


with tempfile.TemporaryDirectory() as directory:
    checkout = pathlib.Path(sys.argv[1]).resolve()
    wrong = [*complaints(checkout, pathlib.Path(directory)), *lines_without_home(checkout)]
print(*(wrong or ['it is installed only where somebody said']), sep='\n')
sys.exit(bool(wrong))
