#!/usr/bin/env python3
"""Which checks are on in which build?

usage: check_build_types.py SOURCE

Configures Karma for each build type, by itself, with several configurations in one tree, and as part of another
project, and preprocesses one line with the flags of one of its files: cheap assertions (MEASSERT) are on in Debug and
RelWithDebInfo, checks of handles (KARMA_CHECK) in Debug, neither in Release, MinSizeRel and where no type is given;
KARMA_CHECK=ON and OFF decide both. Costly assertions (MEVALIDATE) are on in Debug, and where KARMA_VALIDATE=ON, but never
without the cheap ones. The presets of CI say ON, those of what is shipped or timed OFF. Nothing of it
reaches who uses Karma.
"""
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

QUICK = ['-DKARMA_VIEWER=OFF', '-DKARMA_TESTS=OFF', '-DKARMA_MPI=OFF']
MACROS = re.compile(r'KARMA_CHECK|KARMA_ASSERT|KARMA_VALIDATE|ME_ASSERT_ENABLED|ME_VALIDATE_ENABLED|NDEBUG')
NOTE = 'no build type is given'
# handles are looked up, assertions, costly ones
NEITHER, ASSERTIONS, BOTH, ALL = (False, False, False), (False, True, False), (True, True, False), (True, True, True)

# Options of a configuration, and what is on.
ALONE = [
    (['-DCMAKE_BUILD_TYPE=Debug'], ALL),
    (['-DCMAKE_BUILD_TYPE=debug'], ALL),
    (['-DCMAKE_BUILD_TYPE=RelWithDebInfo'], ASSERTIONS),
    (['-DCMAKE_BUILD_TYPE=Release'], NEITHER),
    (['-DCMAKE_BUILD_TYPE=MinSizeRel'], NEITHER),
    (['-DCMAKE_BUILD_TYPE=Coverage'], NEITHER),
    (['-UCMAKE_BUILD_TYPE'], NEITHER),
    (['-DCMAKE_BUILD_TYPE='], NEITHER),
    (['-DCMAKE_BUILD_TYPE=Release', '-DKARMA_CHECK=ON'], BOTH),
    (['-DCMAKE_BUILD_TYPE=Debug', '-DKARMA_CHECK=OFF'], NEITHER),
    (['-DCMAKE_BUILD_TYPE=Debug', '-DKARMA_CHECK=auto'], ALL),
    (['-DCMAKE_BUILD_TYPE=Debug', '-DKARMA_CHECK=ON', '-DKARMA_VALIDATE=OFF'], BOTH),
    (['-DCMAKE_BUILD_TYPE=Release', '-DKARMA_CHECK=ON', '-DKARMA_VALIDATE=ON'], ALL),
    (['-DCMAKE_BUILD_TYPE=Release', '-DKARMA_VALIDATE=ON'], NEITHER)]
PRESETS = {'ON': ['asan', 'ci', 'ci-double', 'dev', 'tsan'], 'OFF': ['asan-release', 'bench', 'double', 'release']}
CONFIGURATIONS = {'Debug': ALL, 'RelWithDebInfo': ASSERTIONS, 'Release': NEITHER, 'MinSizeRel': NEITHER}

PROGRAM = '''cmake_minimum_required(VERSION 3.22)
project(game C CXX)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
add_subdirectory({source} karma)
add_executable(game game.c)
target_link_libraries(game Karma::Mst)
'''


def configure(source, build, *options):
    return subprocess.run(['cmake', '-S', source, '-B', build, *options], capture_output=True, text=True, check=False)


def command_of(build, file, configuration=''):
    """The options with which a file is compiled."""
    for entry in json.loads((build / 'compile_commands.json').read_text()):
        if entry['file'].endswith(file) and configuration in entry['command']:
            return shlex.split(entry['command'])
    sys.exit(f'{file} is not compiled in {build}')


def what_is_on(command, scratch):
    """(handles are looked up, assertions are on, costly ones are) with these options."""
    line = scratch / 'line.c'
    line.write_text('#include "MeAssert.h"\nhandles: KARMA_CHECK assertions: MEASSERT(x) costly: MEVALIDATE(x)\n')
    options = [word for word in command[1:command.index('-o')] if word.startswith(('-D', '-I'))]
    done = subprocess.run([command[0], *options, '-E', '-P', line], capture_output=True, text=True, check=True)
    handles, *asserted = re.search(r'handles: (\S+) assertions: (.*) costly: (.*)', done.stdout, re.DOTALL).groups()
    return handles == '1', *('MeFatalError' in text for text in asserted)


def alone(source, scratch):
    build = scratch / 'alone'
    for options, expected in ALONE:
        done = configure(source, build, *QUICK, '-DKARMA_CHECK=AUTO', '-DKARMA_VALIDATE=AUTO', *options)
        if done.returncode:
            yield f'{options}: {done.stderr}'
            continue
        found = what_is_on(command_of(build, 'MePool.c'), scratch)
        if found != expected:
            yield f'{options}: checks of handles and assertions are {found}, not {expected}'
        is_given = any(re.match('-DCMAKE_BUILD_TYPE=.', option) for option in options)
        if (NOTE in done.stdout) == is_given:
            yield f'{options}: {"a" if is_given else "no"} note that no build type is given\n{done.stdout}'
        if not is_given and 'CMAKE_BUILD_TYPE:STRING=Release' not in (build / 'CMakeCache.txt').read_text():
            yield f'{options}: the build type is not Release'
    done = configure(source, build, '-DKARMA_CHECK=MAYBE')
    if done.returncode == 0 or 'it must be AUTO, ON or OFF' not in done.stderr:
        yield f'KARMA_CHECK=MAYBE is not refused\n{done.stderr}'


def together(source, scratch):
    """Several configurations in one tree."""
    if not shutil.which('ninja'):
        return
    build = scratch / 'together'
    types = ';'.join(CONFIGURATIONS)
    done = configure(source, build, '-G', 'Ninja Multi-Config', f'-DCMAKE_CONFIGURATION_TYPES={types}', *QUICK)
    if done.returncode or NOTE in done.stdout:
        yield f'several configurations: {done.stdout}{done.stderr}'
        return
    for configuration, expected in CONFIGURATIONS.items():
        found = what_is_on(command_of(build, 'MePool.c', f'{configuration}/'), scratch)
        if found != expected:
            yield f'{configuration} of several: checks of handles and assertions are {found}, not {expected}'


def as_part(source, scratch):
    """Another project's build type is its own, and Karma without one is Release."""
    game, build = scratch / 'game', scratch / 'part'
    game.mkdir()
    (game / 'CMakeLists.txt').write_text(PROGRAM.format(source=source))
    (game / 'game.c').write_text('int main(void) { return 0; }\n')
    for kind, expected in ('', NEITHER), ('Debug', ALL), ('RelWithDebInfo', ASSERTIONS), ('Release', NEITHER):
        done = configure(game, build, *QUICK, f'-DCMAKE_BUILD_TYPE={kind}')
        if done.returncode:
            yield f'as part of another project: {done.stderr}'
            return
        karma, program = command_of(build, 'MePool.c'), command_of(build, 'game.c')
        if what_is_on(karma, scratch) != expected:
            yield f'{kind} of another project: checks of handles and assertions are not {expected}'
        if MACROS.search(' '.join(program).replace('-DNDEBUG', '')):
            yield f'{kind} of another project: {program} is compiled with macros of Karma'
        if (NOTE in done.stdout) != (kind == '') or ('-O3' in karma) != (kind in ('', 'Release')):
            yield f'{kind} of another project: Karma is compiled by {karma}\n{done.stdout}'
        if ('-O3' in program) != (kind == 'Release'):
            yield f'{kind} of another project: the program is compiled by {program}'


def presets(source):
    listed = json.loads((source / 'CMakePresets.json').read_text())['configurePresets']
    named = {preset['name']: preset for preset in listed}

    def check_of(preset):
        found = preset.get('cacheVariables', {}).get('KARMA_CHECK')
        return found or ('inherits' in preset and check_of(named[preset['inherits']]))

    for check, names in PRESETS.items():
        found = sorted(name for name, preset in named.items() if check_of(preset) == check)
        if found != names:
            yield f'presets {found} say KARMA_CHECK={check}: these should: {names}'
    if sum(map(len, PRESETS.values())) != sum(not preset.get('hidden') for preset in listed):
        yield 'a preset does not say what it wants of KARMA_CHECK'


def headers(source):
    """What programs include must not depend on how Karma was built."""
    for header in source.glob('*/include/*.h'):
        for number, line in enumerate(header.read_text().splitlines(), 1):
            if header.name != 'MeAssert.h' and re.match(r'\s*#', line) and MACROS.search(line):
                yield f'{header}:{number}: {line}'


def main():
    source = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as place:
        scratch = pathlib.Path(place)
        wrong = [text for check in (presets, headers) for text in check(source)]
        wrong += [text for check in (alone, together, as_part) for text in check(source, scratch)]
    print(*(wrong or ['each build type has its checks']), sep='\n')
    return bool(wrong)


if __name__ == '__main__':
    sys.exit(main())
