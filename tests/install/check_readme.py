#!/usr/bin/env python3
"""Do the lines of README.md's section 'A program' and of docs/install.md work for somebody without the tests' packages?

usage: check_readme.py SOURCE

Takes their blocks in their order: C and CMake blocks become program.c and CMakeLists.txt in $HOME/ball, shell blocks
are run by one shell. The source is a copy without anything built, $HOME is an empty directory, and pkg-config knows no Check.
What cannot be tried here is the absence of other packages of this machine: its libraries are used, and its compilers, which are
told not to optimize (quick_compilers.sh).
The presets of CI must fail in the same place, naming what is missing.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SHELL_SECONDS = 1700  # Karma is built three times; with two processes that takes some minutes on a busy machine
RUNS = 4              # of the program: by pkg-config, find_package, FetchContent, shared
LAST = re.compile(r'^after two seconds: (\S+) m high$', re.MULTILINE)


def blocks(source):
    """(language, text) of each fenced block."""
    section = re.search(r'^## A program\n(.*?)^## ', (source / 'README.md').read_text(), re.DOTALL | re.MULTILINE).group(1)
    return re.findall(r'^```(\w+)\n(.*?)^```$', section + (source / 'docs/install.md').read_text(), re.DOTALL | re.MULTILINE)


def script(parts, ball):
    """One shell script: what a reader writes into files is written where the README has it."""
    lines = ['set -eux']
    files = {'c': ball / 'program.c', 'cmake': ball / 'CMakeLists.txt'}
    for language, text in parts:
        if language == 'sh':
            lines.append(text)
        else:
            lines.append(f"cat >'{files[language]}' <<'END_OF_BLOCK'\n{text}END_OF_BLOCK")
    return '\n'.join(lines)


def copy_source(source, target):
    """The source as a checkout has it: neither build directories nor git's own."""
    target.mkdir()
    pack = ['tar', '-C', source, '--exclude=./build', '--exclude=./.git', '-cf', '-', '.']
    with subprocess.Popen(pack, stdout=subprocess.PIPE) as tar:
        subprocess.run(['tar', '-C', target, '-xf', '-'], stdin=tar.stdout, check=True)
    if tar.returncode:
        sys.exit('the source could not be copied')


def without_check(directory):
    """A directory of all of pkg-config's files but Check's, for PKG_CONFIG_LIBDIR."""
    directory.mkdir()
    paths = subprocess.run(['pkg-config', '--variable=pc_path', 'pkg-config'], capture_output=True, text=True, check=True)
    for folder in paths.stdout.strip().split(':'):
        for file in pathlib.Path(folder).glob('*.pc'):
            link = directory / file.name
            if file.stem != 'check' and not file.stem.startswith('karma') and not link.exists():
                link.symlink_to(file)
    return directory


def run(command, environment, folder):
    return subprocess.run(command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False, timeout=SHELL_SECONDS)


def complaints(source, scratch):
    home = scratch / 'home'
    (home / 'ball').mkdir(parents=True)
    karma = scratch / 'karma'
    copy_source(source, karma)
    (scratch / 'quick').mkdir()
    subprocess.run(['sh', source / 'tests/install/quick_compilers.sh', scratch / 'quick'], check=True)
    environment = {name: value for name, value in os.environ.items() if name not in ('PKG_CONFIG_PATH', 'LD_LIBRARY_PATH')}
    environment.update(HOME=str(home), PKG_CONFIG_LIBDIR=str(without_check(scratch / 'pkgconfig')),
                       CMAKE_BUILD_PARALLEL_LEVEL='2', PATH=f"{scratch / 'quick'}:{os.environ['PATH']}")
    for preset in ('ci', 'ci-double', 'asan'):
        done = run(['cmake', '--preset', preset], environment, karma)
        if done.returncode == 0 or 'Check not found; `tools/setup test`' not in ' '.join(done.stdout.split()):
            yield f'the preset {preset} does not fail for want of Check:\n{done.stdout}'
    parts = blocks(source)
    done = run(['sh', '-c', script(parts, home / 'ball')], environment, karma)
    if done.returncode:
        yield f'a line of the README failed:\n{done.stdout}'
        return
    if 'Tests are not built: Check not found; `tools/setup test`' not in done.stdout:
        yield f'CMake does not say that tests are not built:\n{done.stdout}'
    heights = LAST.findall(done.stdout)
    if len(heights) != RUNS or len(set(heights)) != 1:
        yield f'{RUNS} programs should print one height, they print {heights}'


with tempfile.TemporaryDirectory() as place:
    wrong = list(complaints(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(place)))
print(*(wrong or ["the README's lines work in their order"]), sep='\n')
sys.exit(bool(wrong))
