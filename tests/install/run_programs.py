#!/usr/bin/env python3
"""Do programs written for Karma build against an installation, and behave?

usage: run_programs.py --build BUILD --precision single|double --cc CC --cxx CXX [--flags FLAGS] [--only NAME]

Installs the build tree into a scratch prefix and takes each tests/install/programs/*.c as a program of somebody else:
built as C, and as C++ too unless its first line contains 'C only', with the warnings that tell of cut pointers as
errors; run headless, in a directory of its own, by KARMA_VIEWER='-null -frames 60'. It must end with 0 and, unless its
first line contains 'may print', write nothing to stderr. Programs called classic_*.c get -include KarmaClassic.h.
"""
import argparse
import concurrent.futures
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

PROGRAMS = pathlib.Path(__file__).resolve().parent / 'programs'
# In C a missing declaration makes an int of what a function returns: pointers lose half of their bits.
STRICT = [f'-Werror={w}' for w in ('implicit-function-declaration', 'int-conversion', 'incompatible-pointer-types')]
SECONDS = 60  # for a program that is expected to take less than one, on a busy machine


def run(command, **more):
    try:
        return subprocess.run(command, capture_output=True, text=True, check=False, timeout=SECONDS, **more)
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(command, 124, '', f'not done after {SECONDS} s')


def must(command, **more):
    done = subprocess.run(command, capture_output=True, text=True, check=False, **more)
    if done.returncode:
        sys.exit(f'{shlex.join(command)}:\n{done.stdout}{done.stderr}')
    return done.stdout


class Installation:
    """A scratch prefix with the build in it, and how programs are compiled against it."""

    def __init__(self, arguments, prefix):
        must(['cmake', '--install', str(arguments.build), '--prefix', str(prefix)])
        self.libraries = next(prefix.rglob('karma-mdt*.pc')).parent.parent
        self.compilers = {'c': [arguments.cc, *STRICT], 'c++': [arguments.cxx]}
        # A sanitizer's run-time library for C++, which is in Mcd, comes with that compiler only.
        self.linkers = {'c': arguments.cxx if arguments.flags else arguments.cc, 'c++': arguments.cxx}
        self.more = shlex.split(arguments.flags)
        package = 'karma-double' if arguments.precision == 'double' else 'karma'
        environment = {**os.environ, 'PKG_CONFIG_PATH': str(self.libraries / 'pkgconfig')}
        self.cflags, self.libs = (shlex.split(must(['pkg-config', option, package], env=environment))
                                  for option in ('--cflags', '--libs'))

    def compile(self, program, language, target):
        classic = ['-include', 'KarmaClassic.h'] if program.name.startswith('classic_') else []
        compiled = run([*self.compilers[language], *self.more, *self.cflags, *classic, '-x', language, '-c', str(program),
                        '-o', f'{target}.o'])
        if compiled.returncode:
            return compiled
        return run([self.linkers[language], *self.more, f'{target}.o', '-o', str(target), *self.libs, '-lm'])

    def environment(self):
        mine = {key: value for key, value in os.environ.items() if key != 'DISPLAY'}
        return {**mine, 'KARMA_VIEWER': '-null -frames 60', 'LD_LIBRARY_PATH': str(self.libraries)}


def what_is_wrong(installation, program, language, scratch):
    """A text that says so, or an empty one."""
    scratch.mkdir()
    built = installation.compile(program, language, scratch / 'program')
    if built.returncode:
        return f'does not build\n{built.stderr}'
    ran = run([str(scratch / 'program')], cwd=scratch, env=installation.environment())
    if ran.returncode:
        return f'ends with {ran.returncode}\n{ran.stdout}{ran.stderr}'
    with open(program, encoding='utf-8') as file:
        silent = 'may print' not in file.readline()
    return f'writes to stderr\n{ran.stderr}' if silent and ran.stderr else ''


def languages(program):
    with open(program, encoding='utf-8') as file:
        return ['c'] if 'C only' in file.readline() else ['c', 'c++']


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--build', type=pathlib.Path, required=True)
    parser.add_argument('--precision', choices=('single', 'double'), required=True)
    parser.add_argument('--cc', required=True)
    parser.add_argument('--cxx', required=True)
    parser.add_argument('--flags', default='', help='for both compilers, such as -fsanitize=address')
    parser.add_argument('--only', default='', help='only programs whose names contain this')
    arguments = parser.parse_args()
    jobs = [(program, language) for program in sorted(PROGRAMS.glob('*.c')) if arguments.only in program.name
            for language in languages(program)]
    with tempfile.TemporaryDirectory() as directory, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        scratch = pathlib.Path(directory)
        installation = Installation(arguments, scratch / 'prefix')
        wrong = list(pool.map(lambda job: what_is_wrong(installation, *job, scratch / f'{job[0].stem}.{job[1]}'), jobs))
    for (program, language), text in zip(jobs, wrong):
        if text:
            print(f'{program.name} as {language}: {text}')
    print(f'{wrong.count("")} of {len(jobs)} programs build and behave')
    return 1 if any(wrong) or not jobs else 0


if __name__ == '__main__':
    sys.exit(main())
