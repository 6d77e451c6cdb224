#!/usr/bin/env python3
"""Has every public function a comment of its own, or one for the group that it stands in?"""
import pathlib
import re
import sys

top = pathlib.Path(sys.argv[1])
missing = []
count = 0
for header in sorted(top.glob('*/include/*.h')):
    lines = header.read_text().splitlines()
    group = False       # inside @{ ... @}
    commented = False   # the previous line ends a comment, or a declaration that one covers
    in_comment = False
    for number, line in enumerate(lines, 1):
        text = line.strip()
        if '@{' in text:
            group = True
        if '@}' in text:
            group = False
        if in_comment or text.startswith('/*'):
            in_comment = '*/' not in text
            commented = True
            continue
        match = re.match(r'(?:extern )?MEPUBLIC\b.*?(\w+)\)?\s*\(', text)
        if match:
            count += 1
            if not (commented or group):
                missing.append(f'{header.relative_to(top)}:{number}: {match.group(1)} has no comment')
        if not text:
            commented = False
print('\n'.join(missing) or f'all {count} public functions are documented')
sys.exit(bool(missing) or count == 0)
