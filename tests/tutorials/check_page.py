#!/usr/bin/env python3
"""check_page.py SOURCE - does tools/pictures keep lists and tables of a comment apart from its prose, and join its prose?"""
import importlib.machinery
import importlib.util
import pathlib
import sys

sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader('pictures', str(pathlib.Path(sys.argv[1]) / 'tools' / 'pictures'))
pictures = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
loader.exec_module(pictures)

CASES = [  # a comment, and its paragraphs in Markdown
    (' Name: what\n * it is.\n *\n * One line\n * and one more.\n ', ['Name: what it is.', 'One line and one more.']),
    (' There are:\n *   - one, which is\n *     long;\n *   - two.\n * And more.',
     ['There are:\n\n- one, which is long;\n- two.\n\nAnd more.']),
    (' A table:\n *     rod   pushes\n *       or  pulls\n * is over.',
     ['A table:\n\n```\nrod   pushes\n  or  pulls\n```\n\nis over.']),
    (' Name: it.\n *\n *   a  b\n *   c  d\n *   - item', ['Name: it.', '```\na  b\nc  d\n```\n\n- item']),
    (' A - b\n * -c', ['A - b -c']),
]
wrong = 0
for comment, expected in CASES:
    found = ['\n'.join(parts) for parts in pictures.pieces(comment)]
    if found != expected:
        wrong += 1
        print(f'{comment!r}\n  gives    {found}\n  expected {expected}')
print(f'{len(CASES)} comments, {wrong} wrong')
sys.exit(wrong > 0)
