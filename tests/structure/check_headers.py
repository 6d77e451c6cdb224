#!/usr/bin/env python3
"""Does each public header compile alone, as C11 and as C++17, without a warning?"""
import concurrent.futures
import os
import pathlib
import subprocess
import sys

top, precision, cc, cxx = pathlib.Path(sys.argv[1]), *sys.argv[2:5]
headers = sorted(top.glob('*/include/*.h'))
flags = ['-Wall', '-Wextra', '-Wpedantic', '-Wconversion', '-Wshadow', '-Wundef', '-Werror', '-fsyntax-only']
flags += [f'-I{d}' for d in sorted({str(h.parent) for h in headers})]
if precision == 'double':
    flags.append('-D_ME_API_DOUBLE=1')


def complaint(job):
    """What the compiler says of a header that is included twice and alone; empty if it is fine."""
    header, compiler, standard, language = job
    text = f'#include "{header.name}"\n#include "{header.name}"\nint main(void) {{ return 0; }}\n'
    run = subprocess.run([compiler, f'-std={standard}', *flags, '-x', language, '-'], input=text, capture_output=True, text=True)
    return f'{header.name} as {standard}:\n{run.stderr}' if run.returncode else ''


jobs = [(header, *how) for header in headers for how in ((cc, 'c11', 'c'), (cxx, 'c++17', 'c++'))]
with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
    complaints = [text for text in pool.map(complaint, jobs) if text]
print(*complaints, sep='\n')
failed = len(complaints)
print(f'{len(headers)} headers, {failed} failures')
sys.exit(bool(failed) or not headers)
