#!/usr/bin/env python3
"""Which library includes whose headers, and which room of Kea calls which? The layers allow no cycles, and third-party
headers stay private."""
import pathlib
import re
import sys

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


# The rooms of MdtKea/src: the other rooms whose functions each may call, and whose headers include.
ROOMS = {'inner': [], 'common': ['inner'], 'exact': ['inner', 'common'], 'fast': ['inner', 'common']}
SHARED = ['common/kea_policy_i.h', 'common/kea_arena_i.h', 'common/kea_machine_i.h']  # constants and types that every room may include

source = top / 'MdtKea/src'
room_of = {}
for room in ROOMS:
    for file in (source / room).glob('*.c'):
        for name in re.findall(r'^[A-Za-z][\w *]*?\b(kea_\w+)\(', file.read_text(), flags=re.M):
            room_of[name] = room
if len(set(room_of.values())) < len(ROOMS):
    wrong.append('MdtKea: rooms without functions')
for room, others in ROOMS.items():
    for file in (source / room).iterdir():
        text = re.sub(r'/\*.*?\*/', lambda c: '\n' * c.group().count('\n'), file.read_text(), flags=re.S)
        for number, line in enumerate(text.splitlines(), 1):
            where = f'{file.relative_to(top)}:{number}'
            used = [(n, room_of.get(n, room)) for n in re.findall(r'\bkea_\w+', line)]
            include = re.match(r'#include "((\w+)/\w+\.h)"', line)
            if include and include.group(1) not in SHARED:
                used.append((include.group(1), include.group(2)))
            wrong += [f'{where}: {room}/ may not use {other}/ ({name})'
                      for name, other in used if other in ROOMS and other not in others + [room]]
print('\n'.join(wrong) or 'all includes follow the layers')
sys.exit(bool(wrong))
