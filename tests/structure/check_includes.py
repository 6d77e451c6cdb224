#!/usr/bin/env python3
"""Which library includes whose headers? The layers allow no cycles, and third-party headers stay private."""
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
print('\n'.join(wrong) or 'all includes follow the layers')
sys.exit(bool(wrong))
