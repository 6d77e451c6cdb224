#!/usr/bin/env python3
"""Which library includes whose headers, and which room of a library which one's? The layers allow no cycles,
third-party headers stay private, and private headers are short."""
import pathlib
import re
import sys

sys.dont_write_bytecode = True  # the sources may be read only
from rooms import ROOMS

ALLOWED = {  # library: the libraries whose public headers it may include
    'MeGlobals': [],
    'MdtKea': ['MeGlobals'],
    'MdtBcl': ['MdtKea', 'MeGlobals'],
    'Mdt': ['MdtBcl', 'MdtKea', 'MeGlobals'],
    'Mcd': ['MeGlobals'],
    'Mst': ['Mcd', 'Mdt', 'MdtBcl', 'MdtKea', 'MeGlobals'],
    'MeViewer': ['MeGlobals'],
    'MeApp': ['Mst', 'Mcd', 'Mdt', 'MdtBcl', 'MdtKea', 'MeGlobals', 'MeViewer'],
    'tutorials': ['Mdt', 'MdtBcl', 'MdtKea', 'Mcd', 'Mst', 'MeGlobals', 'MeViewer', 'MeApp'],
}

top = pathlib.Path(sys.argv[1])
owner = {}
for library in ALLOWED:
    for header in (top / library).glob('include/*.h'):
        owner[header.name] = library

wrong = []
for library, others in ALLOWED.items():
    files = [f for f in (top / library).rglob('*') if f.suffix in ('.c', '.cpp', '.h')]
    if not files:
        wrong.append(f'{library}: no sources found')
    for file in files:
        public = file.parent.name == 'include'
        for number, line in enumerate(file.read_text().splitlines(), 1):
            match = re.match(r'\s*#\s*include\s*([<"])([^>"]+)', line)
            if not match:
                continue
            name = match.group(2)
            where = f'{file.relative_to(top)}:{number}'
            if match.group(1) == '"' and name in owner:
                if owner[name] not in others + [library]:
                    wrong.append(f'{where}: {library} may not use {owner[name]} ({name})')
            elif public and match.group(1) == '"':
                wrong.append(f'{where}: a public header includes the private {name}')
            elif public and '/' in name:
                wrong.append(f'{where}: a public header includes the third-party {name}')


PREFIX = {'MdtKea': 'kea', 'Mdt': 'mdt', 'Mcd': 'mcd', 'Mst': 'mst'}
# Constants and types that every room may include.
SHARED = ['common/kea_policy_i.h', 'common/kea_arena_i.h', 'common/kea_machine_i.h']
UPWARD = {  # (file, header of a room above): why it may include that
    ('pair/mcd_tested.c', 'space/mcd_space_i.h'): 'reads in which block of its space a model is; calls nothing there',
}
LONGEST = 200  # lines of a private header; those of MdtKea are not divided among its rooms


def code_of(file):
    return re.sub(r'/\*.*?\*/', lambda c: '\n' * c.group().count('\n'), file.read_text(), flags=re.S)


def check_rooms(library, rooms):
    """What files of rooms include of rooms that they may not use, and the functions of these that they name."""
    source, prefix = top / library / 'src', PREFIX[library]
    room_of = {}
    for room in rooms:
        for file in (source / room).glob('*.c*'):
            for name in re.findall(rf'^[A-Za-z][\w *]*?\b({prefix}_\w+)\([^;{{]*\{{', code_of(file), flags=re.M):
                room_of[name] = room
    if len(set(room_of.values())) < len(rooms):
        yield f'{library}: rooms without functions'
    for room, others in rooms.items():
        files = sorted((source / room).iterdir())
        for file in files:
            for number, line in enumerate(code_of(file).splitlines(), 1):
                where = f'{file.relative_to(top)}:{number}'
                used = [(name, room_of.get(name, room)) for name in re.findall(rf'\b{prefix}_\w+', line)]
                include = re.match(r'#include "((\w+)/\w+\.h)"', line)
                name = include.group(1) if include else ''
                if name and name not in SHARED and (f'{room}/{file.name}', name) not in UPWARD:
                    used.append((name, include.group(2)))
                yield from (f'{where}: {room}/ may not use {other}/ ({name})'
                            for name, other in used if other in rooms and other not in others.split() + [room])
            length = len(file.read_text().splitlines())
            if file.suffix == '.h' and library != 'MdtKea' and length > LONGEST:
                yield f'{file.relative_to(top)}: {length} lines: divide it'


for library, rooms in ROOMS.items():
    wrong += check_rooms(library, rooms)
print('\n'.join(wrong) or 'all includes follow the layers')
sys.exit(bool(wrong))
