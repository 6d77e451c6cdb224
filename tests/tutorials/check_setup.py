#!/usr/bin/env python3
"""check_setup.py SOURCE - what tools/setup says while it installs; dpkg-query, id and apt-get are stood for by scripts."""
import os
import pathlib
import subprocess
import sys
import tempfile

TOOLS = {
    'dpkg-query': 'echo "unknown ok not-installed"',
    'id': 'echo 0',
    'apt-get': '[ "$1" = update ] && echo "Hit:1 http://mirror" && exit\n'
               'printf "%s\\n" "Get:1 libode 8.1" "Unpacking a (1)" "Unpacking b (1)" "Setting up a (1)"\nexit $APT_EXIT',
}
top = pathlib.Path(sys.argv[1])
wrong = 0


def check(code, *texts):
    global wrong
    environment = os.environ | {'PATH': directory + ':' + os.environ['PATH'], 'APT_EXIT': str(code)}
    done = subprocess.run([top / 'tools' / 'setup', 'bench'], env=environment, capture_output=True, text=True, check=False)
    said = (done.stdout + done.stderr).splitlines()
    places = [next((i for i, line in enumerate(said) if line.startswith(text)), -1) for text in texts]
    if done.returncode != code or -1 in places:
        wrong += 1
        print(f'apt-get ends with {code}: exit code {done.returncode}, {texts} in lines {places} of:', *said, sep='\n')
    return said


with tempfile.TemporaryDirectory() as directory:
    for name, text in TOOLS.items():
        path = pathlib.Path(directory, name)
        path.write_text('#!/bin/sh\n' + text + '\n')
        path.chmod(0o755)
    stages = 'Installing: fetching', 'Installing: unpacking', 'Installing: setting up'
    well = check(0, 'Installing missing Debian packages: cmake', *stages, 'Installed.')
    if sum(line.startswith('Installing: ') for line in well) != 3:
        wrong += 1
        print('a stage is told more than once:', *well, sep='\n')
    check(1, *stages, 'Unpacking b (1)', 'The packages could not be installed: cmake')
print(f'{wrong} wrong')
sys.exit(wrong > 0)
