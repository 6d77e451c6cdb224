#!/usr/bin/env python3
"""Does each public header compile, as C11 and as C++17, without a warning?

usage: check_headers.py SOURCE single|double CC CXX alone|together

Alone: with nothing else before it. What a header includes does not hang on the precision nor on the compiler, so that
one build asks for that, and the others for warnings of all headers in one file. Nor does it hang on the language, but
for headers that have lines for one of the two: C++ is asked about these alone, and about all in one file.
"""
import concurrent.futures
import os
import pathlib
import subprocess
import sys

top, precision, cc, cxx, alone = pathlib.Path(sys.argv[1]), *sys.argv[2:6]
headers = sorted(top.glob('*/include/*.h'))
flags = ['-Wall', '-Wextra', '-Wpedantic', '-Wconversion', '-Wshadow', '-Wundef', '-Werror', '-fsyntax-only']
flags += [f'-I{d}' for d in sorted({str(h.parent) for h in headers})]
if precision == 'double':
    flags.append('-D_ME_API_DOUBLE=1')


def complaint(job):
    """What the compiler says of headers that are included twice, and with nothing else; empty if they are fine."""
    included, compiler, standard, language = job
    lines = ''.join(f'#include "{header.name}"\n' * 2 for header in included)
    run = subprocess.run([compiler, f'-std={standard}', *flags, '-x', language, '-'], input=f'{lines}int main(void) {{ return 0; }}\n',
                         capture_output=True, text=True)
    return f'{included[0].name} as {standard}:\n{run.stderr}' if run.returncode else ''


def has_language(header):
    return '__cplusplus' in header.read_text()


groups = [[header] for header in headers] if alone == 'alone' else [headers]
jobs = [(group, cc, 'c11', 'c') for group in groups]
jobs += [([header], cxx, 'c++17', 'c++') for header in headers if alone == 'alone' and has_language(header)]
jobs.append((headers, cxx, 'c++17', 'c++'))
with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
    complaints = [text for text in pool.map(complaint, jobs) if text]
print(*complaints, sep='\n')
failed = len(complaints)
print(f'{len(headers)} headers, {failed} failures')
sys.exit(bool(failed) or not headers)
