#!/usr/bin/env python3
"""Are Kea's choices in its policy file? No other source of it has a number with an exponent or a fraction, nor an integer
above the size of its vectors and matrices, but for those of formulas and of memory; nor has the policy file a constant
that nobody reads, or that is said to have no test, or name a test that does not exist."""
import pathlib
import re
import sys

POLICY = 'common/kea_policy_i.h'
HALVES = {'0.5', '.5', '1.5', '1.0', '2.0'}  # of formulas; 1.0 and 2.0 make a product of integers one of doubles
ALLOWED = {  # (file, number): why it is no choice
    ('common/kea_rotation.c', '2.094395102393195492'): '2 pi / 3',
    ('common/kea_arena_i.h', '15'): 'alignment to 16 bytes',
    ('inner/kea_graph.c', '15'): 'bits that a hash is folded by',
    ('fast/kea_colour.c', '64'): 'bits of the words that colours are sets in',
    ('fast/kea_fast_i.h', '16'): 'alignment, bytes',
    ('kea_system.c', '16'): 'alignment, bytes',
    **{('fast/kea_lanes_i.h', str(lane)): 'index of a lane' for lane in (13, 14, 15)},
}
SMALL = 12  # the largest block of a factor: two bodies' unknowns, or a joint's rows
COEFFICIENTS = {  # (file, function): all of its numbers are published ones
    ('common/kea_rotation.c', 'blanesMoan4'): 'Blanes and Moan 2002',
}

NUMBER = re.compile(r'(?<![\w.])(?:\d+\.\d*|\.\d+|\d+)(?:[eE][+-]?\d+)?[fFlL]?(?![\w.])')


# Program, and tests in it: `Mst_Blows', `MdtKea_system: velocity_rows_obey_their_law', `test_Mst_SweptJoints'.
NAMED = re.compile(r'\b(?:test_)?((?:MdtKea|MdtBcl|Mdt|Mst|Mcd|scenes)_(?!ER)[A-Za-z]\w*|guide_chapter_\d+)\b'
                   r'(?::\s*(\w+_\w+(?:,\s+\w+_\w+)*))?')


def missing_tests(root, policy):
    """What the comments of the policy file name and the tests do not have."""
    comments = re.sub(r'\n \* ', '\n', ' '.join(re.findall(r'/\*.*?\*/', policy, flags=re.S)))
    for program, tests in NAMED.findall(comments):
        library, _, name = program.partition('_')
        guide = program.startswith('guide_')
        found = list((root / 'tests').glob(f'guide/*{name}*.c' if guide else f'{library}/test_*{name}.c'))
        text = ''.join(file.read_text() for file in found)
        if not found:
            yield f'{POLICY}: there is no test program {program}'
        for test in re.findall(r'\w+', tests):
            if found and not re.search(rf'TEST\({test}\b', text):
                yield f'{POLICY}: {program} has no test {test}'


def blanked(text):
    """The text with comments, strings and includes blanked."""
    return re.sub(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"', lambda m: re.sub(r'[^\n]', ' ', m.group()), text,
                  flags=re.S)


top = pathlib.Path(sys.argv[1]) / 'MdtKea' / 'src'
wrong, used, everything, count = [], set(), '', 0
for file in sorted(f for f in top.rglob('*') if f.suffix in ('.c', '.h')):
    name = file.relative_to(top).as_posix()
    if name == POLICY:
        continue
    text = blanked(file.read_text())
    everything += text
    function = ''
    for number, line in enumerate(text.splitlines(), 1):
        head = re.match(r'\w.*?(\w+)\(', line)
        function = head.group(1) if head else function
        for literal in NUMBER.findall(line):
            if literal.isdigit() and int(literal) <= SMALL:
                continue
            if literal in HALVES or (name, function) in COEFFICIENTS:
                continue
            count += 1
            if (name, literal) in ALLOWED:
                used.add((name, literal))
            else:
                wrong.append(f'{file}:{number}: {literal} is a choice: it belongs into {POLICY}, with its reason')
wrong += missing_tests(pathlib.Path(sys.argv[1]), (top / POLICY).read_text())
if re.search(r'No\s+(?:\*\s+)?test', (top / POLICY).read_text()):
    wrong.append(f'{POLICY}: a choice without a test')
policy = blanked((top / POLICY).read_text())
names = re.findall(r'\b(kea_\w+)\b(?:\[\w+\])? =', policy) + re.findall(r'\b(KEA_\w+) =', policy)
for name in names:
    if not re.search(rf'\b{name}\b', everything + policy.replace(name, '', 1)):
        wrong.append(f'{POLICY}: nobody reads {name}')
for entry in sorted(set(ALLOWED) - used):
    wrong.append(f'{entry[0]} has no {entry[1]} any more: remove it from the list')
if not names:
    wrong.append(f'{POLICY}: no constants found')
print('\n'.join(wrong) or f'all {len(names)} constants of Kea are in {POLICY}')
sys.exit(bool(wrong))
