#!/usr/bin/env python3
"""The twelve scenes end with the same bits in every build: whatever compiler, optimization, width of registers and number of
threads.

usage: check_states.py <states> <states.txt> <single|double> <workers>...

`tools/states` writes states.txt anew.
"""
import subprocess
import sys

program, file, precision, *workers = sys.argv[1:]
column = {'single': 1, 'double': 2}[precision]
kept = {line.split()[0]: line.split()[column] for line in open(file) if not line.startswith('#')}
differ = False
for count in workers:
    run = subprocess.run([program, '--workers', count], capture_output=True, text=True)
    print(run.stderr, end='')
    if run.returncode:
        sys.exit(f'{count} workers: it ends with {run.returncode}')
    states = dict(line.split() for line in run.stdout.splitlines())
    if states.keys() != kept.keys():
        sys.exit(f'scenes are {" ".join(states)}; tests/states/states.txt has {" ".join(kept)}')
    for name, state in states.items():
        if state != kept[name]:
            print(f'{name}, {count} workers: state {state}, and not {kept[name]}')
            differ = True
if differ:
    sys.exit('if results were meant to change, say so in the commit, and run tools/states')
