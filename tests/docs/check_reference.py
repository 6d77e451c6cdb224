#!/usr/bin/env python3
"""check_reference.py SOURCE - does Doxygen make the reference without a warning, is every public function in it, and does no
header's brief end within a sentence?

Exit code 77: doxygen is not installed.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

top = pathlib.Path(sys.argv[1]).resolve()
if not shutil.which('doxygen'):
    print('doxygen is not installed: `tools/setup test`')
    sys.exit(77)


def declared():
    """The public functions, those included that are inline; not those of C++, which are C's under the same name."""
    for header in sorted(top.glob('*/include/*.h')):
        if header.stem.endswith('Internal'):
            continue
        text = re.sub(r'^#ifdef __cplusplus.*?^#e(?:lse|ndif)', '', header.read_text(), flags=re.DOTALL | re.MULTILINE)
        text = re.sub(r'/\*.*?\*/', '', text, flags=re.DOTALL)
        text = re.sub(r'^#(?:.*\\\n)*.*', '', text, flags=re.MULTILINE)
        yield from re.findall(r'^(?:MEPUBLIC|static inline)\b[^;{(]*?\b(\w+)\(', text, re.MULTILINE)


with tempfile.TemporaryDirectory() as directory:
    place = pathlib.Path(directory)
    settings = (top / 'docs' / 'Doxyfile.in').read_text().replace('@PROJECT_SOURCE_DIR@', str(top))
    settings = settings.replace('@KARMA_REFERENCE_DIRECTORY@', directory).replace('@PROJECT_VERSION@', '0')
    (place / 'Doxyfile').write_text(settings)
    run = subprocess.run(['doxygen', str(place / 'Doxyfile')], capture_output=True, text=True, check=False)
    said = run.stdout + run.stderr + (place / 'warnings.txt').read_text()
    tags = set(re.findall(r'<name>(\w+)</name>', (place / 'karma.tag').read_text()))
    files = (place / 'html' / 'files.html').read_text()
briefs = [re.sub('<[^>]*>', '', brief).strip() for brief in re.findall(r'<td class="desc">(.*?)</td>', files)]
cut = [brief for brief in briefs if brief.count('(') != brief.count(')')]
functions = set(declared())
missing = sorted(functions - tags)
if run.returncode or said.strip() or missing or cut or not {'MdtHingeSetAxis', 'MdtWorldStep'} <= functions:
    print(said.replace(str(top) + '/', ''))
    print(*(f'cut: {brief}' for brief in cut), *(f'{name} is not in the reference' for name in missing), f'{len(functions)} functions', sep='\n')
    sys.exit(1)
print(f'{len(functions)} functions are in the reference, no warnings')
