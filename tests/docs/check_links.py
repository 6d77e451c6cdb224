#!/usr/bin/env python3
"""check_links.py SOURCE - do the pages speak of what there is?

In README.md, CONTRIBUTING.md and the pages of docs/: every link to a file of the project has a file, every anchor a heading, every
page of docs/ is linked or named by another page, and every public name in `back quotes` stands in some source.
"""
import pathlib
import re
import sys

top = pathlib.Path(sys.argv[1])
pages = [top / 'README.md', top / 'CONTRIBUTING.md', *sorted((top / 'docs').rglob('*.md'))]
EXEMPT = {top / 'docs' / 'api-coverage.md'}  # names what is not offered
NEW = {'McdNew'}                            # of a geometry that a reader is to add
PUBLIC = re.compile(r'^(?:Mdt|Mcd|Mst|Me|RRender|RGraphic|RCamera|RPanel)[A-Z][A-Za-z0-9]+$')


def without_blocks(text):
    return re.sub(r'^```.*?^```$', '', text, flags=re.DOTALL | re.MULTILINE)


def anchors(text):
    """The anchors of a page's headings, as GitHub makes them."""
    for title in re.findall(r'^#+ (.*)$', without_blocks(text), re.MULTILINE):
        title = re.sub(r'\[([^]]*)\]\([^)]*\)', r'\1', title)
        yield re.sub(r'[^\w\- ]', '', title.lower()).replace(' ', '-')


def links(text):
    for target in re.findall(r'\]\(([^)\s]+)\)', without_blocks(text)):
        if not re.match(r'\w+:', target):
            yield target


def names(text):
    for quoted in re.findall(r'`([^`\n]+)`', without_blocks(text)):
        for word in re.findall(r'\w+', quoted):
            if PUBLIC.match(word):
                yield word


code = ''.join(file.read_text(errors='replace') for pattern in ('*/include/*.h', '*/src/*.[ch]', '*/src/*/*.[ch]', 'tests/**/*.[ch]', '**/CMakeLists.txt')
               for file in top.glob(pattern) if 'build' not in file.relative_to(top).parts)
known = set(re.findall(r'\w+', code))
wrong, mentioned = [], ''
for page in pages:
    text = page.read_text()
    mentioned += text.replace(page.name, '') if page.is_relative_to(top / 'docs') else text
    where = page.relative_to(top)
    for target in links(text):
        path, _, anchor = target.partition('#')
        file = (page.parent / path).resolve() if path else page
        if not file.exists():
            wrong.append(f'{where}: {target}: no such file')
        elif anchor and anchor not in anchors(file.read_text()):
            wrong.append(f'{where}: {target}: no such heading')
    if page not in EXEMPT:
        wrong += [f'{where}: {name} is nowhere in the sources' for name in sorted(set(names(text)) - known - NEW)]
wrong += [f'{page.relative_to(top)}: no page links to it or names it' for page in pages[2:] if page.name not in mentioned]
print(*(wrong or [f'{len(pages)} pages speak of what there is']), sep='\n')
sys.exit(bool(wrong))
