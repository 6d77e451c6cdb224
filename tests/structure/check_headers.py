#!/usr/bin/env python3
"""Does each public header compile alone, as C11 and as C++17, without a warning?"""
import pathlib
import subprocess
import sys
import tempfile

top, precision, cc, cxx = pathlib.Path(sys.argv[1]), *sys.argv[2:5]
headers = sorted(top.glob('*/include/*.h'))
flags = ['-Wall', '-Wextra', '-Wpedantic', '-Wconversion', '-Wshadow', '-Wundef', '-Werror', '-fsyntax-only']
flags += [f'-I{d}' for d in sorted({str(h.parent) for h in headers})]
if precision == 'double':
    flags.append('-D_ME_API_DOUBLE=1')
failed = 0
with tempfile.TemporaryDirectory() as scratch:
    for header in headers:
        for compiler, standard, suffix in ((cc, 'c11', 'c'), (cxx, 'c++17', 'cpp')):
            source = pathlib.Path(scratch) / f'alone.{suffix}'
            source.write_text(f'#include "{header.name}"\n#include "{header.name}"\nint main(void) {{ return 0; }}\n')
            run = subprocess.run([compiler, f'-std={standard}', *flags, str(source)], capture_output=True, text=True)
            if run.returncode:
                failed += 1
                print(f'{header.name} as {standard}:\n{run.stderr}')
print(f'{len(headers)} headers, {failed} failures')
sys.exit(bool(failed) or not headers)
