#!/usr/bin/env python3
"""The menu of tutorials, without a window: it knows all of them, keys move the mark, Enter writes the choice.

usage: check_menu.py <program> <png_check> <top of the sources>
"""
import os
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
from tutorial import SIZE, look, picture, run

top = pathlib.Path(sys.argv[3])
names = sorted(path.name for path in (top / 'tutorials').iterdir() if path.is_dir() and path.name[0].isupper())
os.environ['KARMA_TEXTURES'] = str(top / 'docs' / 'pictures')


def shown(*arguments):
    return run('-null', '-frames', '5', *arguments)


def choice(keys):
    if os.path.exists('choice'):
        os.remove('choice')
    run('-null', '-frames', '5', '-choice', 'choice', '-at', names[0], '-key', keys)
    return open('choice').read() if os.path.exists('choice') else ''


def check_names():
    order = {}
    for name in names:
        line = shown('-at', name)
        words = line.split()
        assert words[0] == name and words[2:4] == ['of', str(len(names))], line
        order[int(words[1])] = name
    assert sorted(order) == list(range(1, len(names) + 1)), order
    return [order[i] for i in sorted(order)]


def check_keys(order):
    first = ['-at', order[0]]
    for keys, place in (('Right', 1), ('Left', 0), ('Down', 4), ('Up', 0), ('Space', 12)):
        line = shown(*first, '-key', f'{keys}@2')
        assert line.startswith(order[place] + ' '), f'{keys}: {line}'
    assert shown('-at', order[-1], '-key', 'Right@2').startswith(order[-1] + ' ')
    assert shown('-at', order[-1], '-key', 'Space@2').startswith(order[0] + ' '), 'after the last page comes the first'
    assert shown(*first, '-key', 'Down@2,Down@3,Down@4').startswith(order[12] + ' ')


def check_choice():
    assert choice('Enter@3') == names[0] + '\n'
    assert choice('Escape@3') == '', 'leaving is no choice'


def check_pictures(order):
    """A warning, as for a picture that cannot be read, would fail each run."""
    pixels = lambda *arguments: pathlib.Path(picture('menu.png', 5, *arguments)).read_bytes()
    first = pixels()
    look('size', 'menu.png', '%dx%d' % SIZE)
    assert len({first, *(pixels('-at', order[i]) for i in (1, 12, 24))}) == 4, 'marks or pages look the same'
    os.environ['KARMA_TEXTURES'] = '.'
    assert pixels() != first, 'the pictures are not shown'


with tempfile.TemporaryDirectory() as directory:
    os.chdir(directory)
    try:
        in_order = check_names()
        check_keys(in_order)
        check_choice()
        check_pictures(in_order)
    except AssertionError as failure:
        print('FAILED:', failure)
        sys.exit(1)
print('as it should be')
