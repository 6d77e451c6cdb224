#!/usr/bin/env python3
"""Do the sources keep to what CONTRIBUTING.md says of their form?

 - no line is longer than 120 columns;
 - headers that only one library includes are called *_i.h;
 - a function that returns MeBool returns METRUE, MEFALSE or a condition, not 0 or 1;
 - what a header declares in a group has a title there ("@name").
"""
import pathlib
import re
import sys

top = pathlib.Path(sys.argv[1])
LIBRARIES = ('MeGlobals', 'MdtKea', 'MdtBcl', 'Mdt', 'Mcd', 'Mst', 'MeViewer', 'MeApp')
COLUMNS = 120


def sources():
    for directory in LIBRARIES + ('tests', 'tutorials', 'bench', 'KarmaSweep'):
        for pattern in ('*.c', '*.h', '*.cpp'):
            yield from sorted((top / directory).rglob(pattern))


def long_lines(path, lines):
    for number, line in enumerate(lines, 1):
        if len(line) > COLUMNS:
            yield f'{path}:{number}: {len(line)} columns'


def numbers_for_truth(path, lines):
    """Returns of 0 and 1 in functions whose first line says that they return MeBool."""
    returns_truth = False
    for number, line in enumerate(lines, 1):
        if re.match(r'[A-Za-z]', line) and '(' in line and not line.rstrip().endswith(';'):
            returns_truth = bool(re.match(r'(static |inline |MEPUBLIC )*MeBool ', line))
        if returns_truth and re.search(r'\breturn (0|1);', line):
            yield f'{path}:{number}: {line.strip()} of a MeBool'


def untitled_groups(path, lines):
    for number, line in enumerate(lines, 1):
        if '@{' in line and not any('@name' in before for before in lines[max(number - 60, 0):number]):
            yield f'{path}:{number}: a group without a title'


complaints = []
for source in sources():
    name, text = source.relative_to(top), source.read_text(encoding='utf8').splitlines()
    complaints += long_lines(name, text)
    if name.parts[0] in LIBRARIES:
        complaints += numbers_for_truth(name, text)
    if name.parts[1] == 'include':
        complaints += untitled_groups(name, text)
    if name.parts[0] in LIBRARIES and name.parts[1] == 'src' and name.suffix == '.h' and not name.stem.endswith('_i'):
        complaints.append(f'{name}: a private header is called *_i.h')
print('\n'.join(complaints) or 'the sources keep to their form')
sys.exit(bool(complaints))
