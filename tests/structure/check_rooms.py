#!/usr/bin/env python3
"""check_rooms.py SOURCE ARCHIVE - do the objects of a static library call down only, from room to room, and are the
circles of files that call each other small? What an object calls is what nm says that it wants."""
import pathlib
import re
import sys

sys.dont_write_bytecode = True  # the sources may be read only
from rooms import ROOMS, calls, circles, room_of

UPWARD = {}  # (calling file, symbol): why it may go up
LARGEST = {'MdtKea': 7, 'Mdt': 7, 'Mcd': 7, 'Mst': 7}  # files that call each other in a circle

top, archive = pathlib.Path(sys.argv[1]), sys.argv[2]
library = re.match(r'lib([A-Za-z]+)', pathlib.Path(archive).name).group(1)
rooms, found = room_of(top / library / 'src'), calls(archive)
below = {room: others.split() + [room] for room, others in ROOMS[library].items()}
below[''] = list(below) + ['']  # the front door calls all

wrong = [f'{library}: {name} is in no room' for name, room in rooms.items() if room not in below]
wrong += [f'{library}: {rooms[a]}/{a} calls {symbol} of {rooms[b]}/{b}' for a, b, symbol in found
          if rooms[b] not in below.get(rooms[a], []) and (a, symbol) not in UPWARD]
largest = next(iter(circles({(a, b) for a, b, _ in found})), [])
if len(largest) > LARGEST[library]:
    wrong.append(f'{library}: {len(largest)} files call each other in a circle: {" ".join(largest)}')
print('\n'.join(wrong) or f'{len(found)} calls between files go down; the largest circle has {len(largest)} files')
sys.exit(bool(wrong) or not found)
