#!/usr/bin/env python3
"""Do the programs of pages of docs/ build and run as the pages have it, and print what they say?

usage: check_blocks.py PAGE ... --build BUILD --precision single|double --cc CC [--flags FLAGS]

The fenced blocks of the pages are run in their order, in an empty $HOME; a page may use files of those before it:
  c     a file, named by its first words: /* fall.c: ...
  cmake CMakeLists.txt
  sh    run by one shell, which stops at the first command that fails
  text  what the sh block before it has printed, to the letter
What a page does to install Karma is the README's, whose test runs it: such lines must stand there or in install.md too,
and here the build is installed in their place. `cc` is the build's compiler with its sanitizers, packages are those of the build's
precision, warnings are errors, and programs of the viewer draw nothing and end after 60 frames.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SECONDS = 280
STRICT = '-std=c11 -Wall -Wextra -Werror -D_POSIX_C_SOURCE=200809L'
INSTALLS = re.compile(r'^(tools/setup|cmake --preset|cmake --build --preset|cmake --install|export PKG_CONFIG_PATH=)')
NAME = re.compile(r'/\* (\w+\.[ch]): ')


def blocks(page):
    """(language, text, line number) of each fenced block."""
    for match in re.finditer(r'^```(\w+)\n(.*?)^```$', page, re.DOTALL | re.MULTILINE):
        yield match[1], match[2], page.count('\n', 0, match.start()) + 1


def without_comment(line):
    return re.sub(r'\s+# .*', '', line).strip()


def commands(text, readme, precision):
    """The lines of a shell block that are to be run; an exit names a line that the README's test does not run."""
    kept = []
    for line in text.splitlines():
        if not INSTALLS.match(line):
            kept.append(re.sub(r'(pkg-config --cflags --libs \S+?)\)', r'\1-double)' if precision == 'double' else r'\1)', line))
        elif not line.startswith('tools/setup') and without_comment(line) not in readme:
            sys.exit(f'the README does not have this line, which nothing runs: {line}')
    return '\n'.join(kept)


class Shell:
    """The directory of a reader, and how commands are run in it."""

    def __init__(self, arguments, scratch):
        self.home = scratch / 'home'
        self.home.mkdir()
        prefix = self.home / 'karma'
        done = subprocess.run(['cmake', '--install', arguments.build, '--prefix', prefix], capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit(done.stdout + done.stderr)
        libraries = next(prefix.rglob('karma-mdt*.pc')).parent.parent
        tools = scratch / 'tools'
        tools.mkdir()
        behind = '-lstdc++' if arguments.flags else ''  # for a sanitizer's run-time library for C++, which is in Mcd
        (tools / 'cc').write_text(f'#!/bin/sh\nexec {arguments.cc} {STRICT} {arguments.flags} "$@" {behind}\n')
        (tools / 'cc').chmod(0o755)
        mine = {key: value for key, value in os.environ.items() if key != 'DISPLAY'}
        # Were the compiler ccache, it would look for the real one in PATH, and find `cc` above, which calls ccache.
        self.environment = {'CCACHE_PATH': os.environ['PATH'], **mine,
                            'HOME': str(self.home), 'PATH': f'{tools}:{os.environ["PATH"]}',
                            'PKG_CONFIG_PATH': str(libraries / 'pkgconfig'), 'LD_LIBRARY_PATH': str(libraries),
                            'KARMA_VIEWER': '-null -frames 60', 'KARMA': str(prefix)}

    def run(self, text):
        return subprocess.run(['sh', '-eu', '-c', text], cwd=self.home, env=self.environment, capture_output=True, text=True,
                              check=False, timeout=SECONDS)


def complaints(page, shell, arguments):
    tried = (page.parent.parent / 'README.md', page.parent / 'install.md')
    readme = [without_comment(line) for file in tried for line in file.read_text().splitlines()]
    printed, programs = '', set()
    for language, text, line in blocks(page.read_text()):
        where = f'{page.name}:{line}'
        if language in ('c', 'cmake'):
            name = NAME.match(text)
            file = 'CMakeLists.txt' if language == 'cmake' else name[1] if name else None
            if not file:
                yield f'{where}: the block does not begin with the name of its file'
                continue
            (shell.home / file).write_text(text)
            programs.add(file)
        elif language == 'sh':
            script = commands(text, readme, arguments.precision)
            words = re.findall(r'[\w.]+', script)  # with or without .c: a page may have a script that adds it
            programs = {file for file in programs if file not in words and file.removesuffix('.c') not in words}
            done = shell.run(script)
            printed = done.stdout + done.stderr
            if done.returncode:
                yield f'{where}: ends with {done.returncode}\n{printed}'
                return
        elif language == 'text':
            if printed != text:
                yield f'{where}: the page says\n{text}but printed is\n{printed}'
        else:
            yield f'{where}: nobody checks blocks of {language}'
    for file in sorted(programs - {'CMakeLists.txt'}):
        if file.endswith('.c'):
            yield f'{file} is never built'


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('page', type=pathlib.Path, nargs='+')
    parser.add_argument('--build', type=pathlib.Path, required=True)
    parser.add_argument('--precision', choices=('single', 'double'), required=True)
    parser.add_argument('--cc', required=True)
    parser.add_argument('--flags', default='', help='for compiler and linker, such as -fsanitize=address')
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as directory:
        shell = Shell(arguments, pathlib.Path(directory))
        wrong = [complaint for page in arguments.page for complaint in complaints(page.resolve(), shell, arguments)]
    print(*(wrong or [f'the programs of {arguments.page[-1].name} do what it says']), sep='\n')
    return bool(wrong)


if __name__ == '__main__':
    sys.exit(main())
