#!/usr/bin/env python3
"""check_run.py SOURCE - what tools/run says to somebody without a display, or with a wrong name. Nothing is built."""
import os
import pathlib
import subprocess
import sys

top = pathlib.Path(sys.argv[1])
names = sorted(path.name.lower() for path in (top / 'tutorials').iterdir() if path.is_dir() and path.name[0].isupper())
environment = {name: value for name, value in os.environ.items() if name != 'DISPLAY'}
CASES = [  # arguments, exit code, what is said besides all names
    ([], 0, ['DISPLAY is not set']),
    (['-help'], 0, ['tools/run [tutorial] [options]']),
    (['--help'], 0, ['tools/run [tutorial] [options]']),
    (['hing'], 2, ["no tutorial 'hing'", "Did you mean 'hinge'?"]),
    (['Dorp'], 2, ["Did you mean 'drop'?"]),
    (['quad'], 2, ["Did you mean 'quadbike'?"]),
    (['nothinglikeit'], 2, ["no tutorial 'nothinglikeit'."]),
]
wrong = 0
for arguments, code, texts in CASES:
    done = subprocess.run([top / 'tools' / 'run', *arguments], env=environment, capture_output=True, text=True, check=False)
    said = done.stdout + done.stderr
    missing = [text for text in texts if text not in said] + [name for name in names if name not in said.split()]
    guessed = 'Did you mean' in said and not any('Did you mean' in text for text in texts)
    if done.returncode != code or missing or guessed:
        wrong += 1
        print(f'tools/run {" ".join(arguments)}: exit code {done.returncode}, without {missing}:\n{said}')
print(f'{len(CASES)} calls, {wrong} wrong')
sys.exit(wrong > 0 or not names)
