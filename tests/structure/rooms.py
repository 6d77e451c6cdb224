"""The rooms of each library's src, and what follows from the symbols of its objects: which calls go up from a room, and
which files call each other in a circle. Read by check_includes.py, check_rooms.py and tools/circles."""
import collections
import pathlib
import re
import subprocess

ROOMS = {  # library: room: the other rooms whose functions it may call, and whose headers include
    'MdtKea': {'inner': '', 'common': 'inner', 'exact': 'inner common', 'fast': 'inner common'},
    'Mdt': {'base': '', 'record': 'base', 'api': 'base record', 'island': 'base record',
            'step': 'base record api island', 'world': 'base record island step'},
    'Mcd': {'convex': '', 'model': 'convex', 'surface': 'convex model', 'pair': 'convex model surface',
            'geometry': 'convex model surface pair', 'space': 'convex model surface pair geometry'},
    'Mst': {'bridge': '', 'touch': 'bridge', 'step': 'bridge touch', 'universe': 'bridge touch step vehicle mover',
            'vehicle': 'bridge', 'mover': 'bridge',
            'advise': 'bridge touch step universe vehicle mover'},
}


def members(archive):
    """{source: (symbols that its object defines, symbols that it wants of others)} of a static library."""
    listing = subprocess.run(['nm', '-A', archive], capture_output=True, text=True, check=True).stdout
    found = collections.defaultdict(lambda: (set(), set()))
    for line in listing.splitlines():
        match = re.match(r'.*:([^:/]+)\.o:[0-9a-f]* +(\w) (\S+)$', line)
        if match:
            name, kind, symbol = match.groups()
            if kind in 'UTDBRVW':
                found[name][kind == 'U'].add(symbol)
    return dict(found)


def calls(archive):
    """[(source, source of the same library, symbol)]: the first one wants what the second one defines."""
    objects = members(archive)
    home = {symbol: name for name, (defined, _) in objects.items() for symbol in defined}
    return [(name, home[symbol], symbol) for name, (_, wanted) in sorted(objects.items()) for symbol in sorted(wanted)
            if home.get(symbol, name) != name]


def room_of(source):
    """{file name: its room, or '' for what is in none} of a library's src."""
    return {f.name: '' if f.parent == source else f.parent.name for f in pathlib.Path(source).rglob('*.c*')}


def circles(pairs):
    """The sets of files of which each calls all others, through others: strongly connected components, by size."""
    after, before = collections.defaultdict(set), collections.defaultdict(set)
    for a, b in pairs:
        after[a].add(b)
        before[b].add(a)

    def reached(start, edges):
        seen, todo = {start}, [start]
        while todo:
            todo += [n for n in edges[todo.pop()] if n not in seen and not seen.add(n)]
        return seen

    found, done = [], set()
    for name in sorted(set(after) | set(before)):
        if name not in done:
            circle = reached(name, after) & reached(name, before)
            done |= circle
            found += [sorted(circle)] if len(circle) > 1 else []
    return sorted(found, key=len, reverse=True)
