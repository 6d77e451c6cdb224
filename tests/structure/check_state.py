#!/usr/bin/env python3
"""Does a library of the simulation keep anything that a step reads outside of worlds, frameworks and universes?

What a step depends on must be reachable from the universe and belong to it, so that a program can have several, step them in
any order, and one day take one back in time. Variables of the library itself are listed here, with what they are for.
"""
import re
import subprocess
import sys

ALLOWED = {
    'table': 'the requests that the program has numbered: these functions of 1.2 name no framework',
    'liveWorlds': 'how many there are', 'liveFrames': 'the same: what is destroyed after the last one is not warned of',
    'name': 'names of geometry types', 'classicFrame': 'what programs that know of no framework do not say',
    '_ZStL8__ioinit': "the C++ library's", 'DW.ref.__gxx_personality_v0': "the C++ library's",
}

library = sys.argv[1]
listing = subprocess.run(['objdump', '-t', library], capture_output=True, text=True, check=True).stdout
found = set()
for line in listing.splitlines():
    part = line.split()
    if len(part) < 5 or part[-3] == '*UND*' or ' d ' in line or ' df ' in line:
        continue
    section = next((p for p in part if p.startswith(('.data', '.bss', '*COM*'))), '')
    if section and not section.startswith('.data.rel.ro'):
        found.add(re.sub(r'\.\d+$', '', part[-1]))  # one inside of a function has a number
wrong = sorted(found - set(ALLOWED))
print('\n'.join(f'{library} has the variable {s}' for s in wrong) or f'variables: {", ".join(sorted(found)) or "none"}')
sys.exit(bool(wrong) or not listing)
