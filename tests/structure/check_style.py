#!/usr/bin/env python3
"""Do the sources keep to what CONTRIBUTING.md says of their form?

 - no line is longer than 120 columns;
 - headers that only one library includes are called *_i.h;
 - a function that returns MeBool returns METRUE, MEFALSE or a condition, not 0 or 1;
 - what a header declares in a group has a title there ("@name");
 - identifiers have the field's words (CONTRIBUTING, "Glossary"), not those of BANNED, but for EXCEPTIONS.
"""
import pathlib
import re
import sys

top = pathlib.Path(sys.argv[1])
LIBRARIES = ('MeGlobals', 'MdtKea', 'MdtBcl', 'Mdt', 'Mcd', 'Mst', 'MeViewer', 'MeApp')
COLUMNS = 120

SOLVER = ('MdtKea', 'Mdt', 'Mcd', 'Mst')
BANNED = [  # (words, what to say instead, the directories in which that holds)
    ('most least', 'max, min', LIBRARIES + ('tests', 'tutorials', 'bench')),
    ('way', 'displacement, direction or path', LIBRARIES),
    ('sag', 'slop', LIBRARIES),
    ('rub grip', 'frictionImpulse, frictionMass', LIBRARIES),
    ('off', 'offset, inactive, or what it is away from what', LIBRARIES),
    ('lack missing wanted', 'remainingTime, residual, expected or target', LIBRARIES),
    ('apart', 'separated, gap or noCollide', LIBRARIES),
    ('crowd crowds', 'large island', LIBRARIES),
    ('part parts', 'substep, child or fraction', SOLVER),
    ('rest rests', 'sleep, certificate or remaining', SOLVER),
    ('take takes taken', 'allocate, acquire, pop, copy, run ...: what is done to which object', LIBRARIES),
    ('hold holds held', 'guard, constrain, buffer ...: what is done to which object', LIBRARIES),
    ('meet meets met', 'touch, collide, overlap', LIBRARIES),
    ('ask asks asked', 'query, request', LIBRARIES),
    ('tell tells told', 'report, notify, warn, print', LIBRARIES),
    ('judge judges judged', 'rate, check, choose', LIBRARIES),
]
# What programs see has Karma's names: Mdt..., McdInit, RRender..., kMe..., and fields of public records.
INTERFACE = re.compile(r'(Me|Mdt|Mcd|Mst|R|kMe|kMcd|kR)[A-Z0-9]\w*$')
SENTENCE = re.compile(r'[a-z0-9]+(_[a-z0-9]+){2,}$')  # of a test
EXCEPTIONS = {  # identifier: (where, why)
    'least': ('MdtKea/src/exact MdtKea/src/fast Mdt/src/step tests/MdtKea', 'MdtKeaReport.least, a public field'),
    'leastRatio': ('Mst/src', 'MstTrial.leastRatio, a public field'),
    'way': ('Mdt/src/island Mdt/src/step Mst/src MeApp/src', 'MdtReport.way, a public field'),
    'apart': ('Mcd/src/model Mcd/src/pair Mst/src/step', 'of McdIntersectResult and McdModelPair.stand, public fields'),
    'isHeldApart': ('Mst/src/step', 'McdModelPair.isHeldApart, a public field'),
    'holdsSlow': ('MdtKea/src Mdt/src/step', 'MdtKeaParameters.holdsSlow, a public field'),
    'isOneWay': ('MdtKea/src MdtBcl/src', 'MdtKeaSurface.isOneWay, a public field'),
    'isPart': ('MdtKea/src Mdt/src/step', 'MdtKeaParameters.isPart, a public field'),
    'restSpeed': ('MdtKea/src Mdt/src/step', 'MdtKeaParameters.restSpeed, a public field'),
    'parts': ('Mdt/src', 'MdtReport.parts, a public field'),
    'taken': ('MeGlobals/src/MeIDPool.c', 'MeIDPool.taken, a public field: numbers that are in use'),
    'isTaken': ('MeGlobals/src/MeIDPool.c', 'of a number in MeIDPool.taken'),
    'countTaken': ('MeGlobals/src/MeIDPool.c', 'of numbers in MeIDPool.taken'),
    'off_t': ('MeGlobals/src', 'of POSIX'),
    'MDT_OFF_CENTRE': ('Mdt/src', "a centre of mass that is off the frame's origin"),
    'sag': ('Mst/src/universe', 'of a joint under its load: epsilon F h² / gamma'),
    'rest': ('Mdt/src/base', 'what remains of a list or a word'),
    'missingMember': ('Mst/src/universe', 'an object of a universe that was not created'),
    'heldControl': ('MeViewer/src', 'a control whose key is held down'),
    'heldFor': ('MeViewer/src', 's, for which a key is held down'),
    'holdKey': ('MeViewer/src', 'a key is held down'),
    'holdAngle': ('MeViewer/src', 'by which the camera turns while a key is held down'),
    'holdZoom': ('MeViewer/src', 'by which the camera nears while a key is held down'),
}


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


def house_words(path, text, used):
    """Identifiers of the code that have a banned word."""
    code = re.sub(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"', ' ', text, flags=re.S)
    banned = {word: instead for words, instead, places in BANNED if path.parts[0] in places for word in words.split()}
    for name in sorted(set(re.findall(r'[A-Za-z_]\w*', code))):
        words = {part.lower() for part in re.findall(r'[A-Z]?[a-z]+|[A-Z]+(?![a-z])', name)} & set(banned)
        if not words or INTERFACE.match(name) or SENTENCE.match(name):
            continue
        if path.as_posix().startswith(tuple(EXCEPTIONS.get(name, ('\0',))[0].split())):
            used.add(name)
        else:
            yield f'{path}: {name}: say {banned[words.pop()]}'


complaints, used = [], set()
for source in sources():
    name, whole = source.relative_to(top), source.read_text(encoding='utf8')
    text = whole.splitlines()
    complaints += long_lines(name, text)
    if name.parts[0] in LIBRARIES:
        complaints += numbers_for_truth(name, text)
    if name.parts[1] == 'include':
        complaints += untitled_groups(name, text)
    if name.parts[0] in LIBRARIES and name.parts[1] == 'src' and name.suffix == '.h' and not name.stem.endswith('_i'):
        complaints.append(f'{name}: a private header is called *_i.h')
    if name.parts[1] != 'include':
        complaints += house_words(name, whole, used)
complaints += [f'check_style.py: nothing is called {name} any more' for name in EXCEPTIONS if name not in used]
print('\n'.join(complaints) or 'the sources keep to their form')
sys.exit(bool(complaints))
