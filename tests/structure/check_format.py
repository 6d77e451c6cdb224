#!/usr/bin/env python3
"""check_format.py SOURCE - are the sources as clang-format 14 writes them (.clang-format)?

Ends with 77, which CTest takes for skipped, where there is no clang-format of that version: others format otherwise.
"""
import pathlib
import re
import shutil
import subprocess
import sys

top = pathlib.Path(sys.argv[1])
DIRECTORIES = ('MeGlobals', 'MdtKea', 'MdtBcl', 'Mdt', 'Mcd', 'Mst', 'MeViewer', 'MeApp', 'tests', 'tutorials',
               'bench', 'KarmaSweep')


def formatter():
    for name in ('clang-format-14', 'clang-format'):
        if shutil.which(name):
            version = subprocess.run([name, '--version'], capture_output=True, text=True, check=True).stdout
            if re.search(r'version 14\.', version):
                return name
    print('there is no clang-format 14')
    sys.exit(77)


def sources():
    for directory in DIRECTORIES:
        for path in sorted((top / directory).rglob('*')):
            if path.suffix in ('.c', '.h', '.cpp'):
                yield str(path.relative_to(top))


names = list(sources())
said = subprocess.run([formatter(), '--dry-run', *names], cwd=top, capture_output=True, text=True, check=True).stderr
wrong = {line.split(':')[0] for line in said.splitlines() if '[-Wclang-format-violations]' in line}
print('\n'.join(f'{name}: clang-format -i {name}' for name in sorted(wrong)) or f'{len(names)} files are formatted')
sys.exit(bool(wrong))
