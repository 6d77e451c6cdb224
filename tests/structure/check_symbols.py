#!/usr/bin/env python3
"""Does a shared library export its interface and nothing else?"""
import os
import re
import subprocess
import sys

library = sys.argv[1]
name = re.match(r'lib([A-Za-z]+)', os.path.basename(library)).group(1)
PREFIX = {'MeGlobals': r'Me|tic', 'MdtKea': r'MdtKea', 'MdtBcl': r'MdtBcl', 'Mdt': r'Mdt', 'Mcd': r'Mcd',
          'Mst': r'Mst|McdModel(GetBody$|SetBody$|Dynamics)',
          'MeViewer': r'R[A-Z_]|MeViewer', 'MeApp': r'MeApp|RGraphic(Aggregate|Convex|Triangles)Create$|RGraphicCreateFrom'}

listing = subprocess.run(['nm', '-D', '--defined-only', library], capture_output=True, text=True, check=True).stdout
symbols = [line.split()[-1] for line in listing.splitlines()]
wrong = [s for s in symbols if not re.match(PREFIX[name], s) and s not in ('_init', '_fini')]
print('\n'.join(f'{library} exports {s}' for s in wrong) or f'{len(symbols)} symbols, all of the interface')
sys.exit(bool(wrong) or not symbols)
