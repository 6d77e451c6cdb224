#!/usr/bin/env python3
"""check_advise.py STACK DROP - the option -advise of programs: what it prints, and what it says where it cannot."""
import re
import subprocess
import sys

stack, drop = sys.argv[1:3]
wrong = 0


def check(program, *arguments, code, texts):
    global wrong
    done = subprocess.run([program, *arguments], capture_output=True, text=True, timeout=200, check=False)
    said = done.stdout + done.stderr
    missing = [text for text in texts if not re.search(text, said, re.M)]
    if done.returncode != code or missing:
        wrong += 1
        print(f'{program} {" ".join(arguments)}: exit code {done.returncode}, without {missing}:\n{said}')
    return said


said = check(stack, '-advise', '0.2', code=0, texts=[
    r'^21 bodies, 12 steps of 0\.01667 s each time$', r'^errors are those of the first [0-9.]+ s', r'^ 0 .* as it is$',
    r'^ [0-9]+ .* MdtWorldSetSubSteps\(world, 2\)$', r'^ [0-9]+ .* MdtWorldSetSolver\(world, \w+\)$', r'^best: '])
if len(re.findall('^best: ', said, re.M)) != 1:
    wrong += 1
    print('copies of the process have printed, too:', said)
check(stack, '-advise', '0.2@0.5', code=0, texts=['^best: '])
check(stack, '-advise', '0.2@', code=2, texts=['-advise 0.2@: write SECONDS or SECONDS@START'])
check(stack, '-advise', '-1', code=2, texts=['-advise -1: write SECONDS'])
check(drop, '-advise', '0.2', code=2, texts=['-advise: this program has no universe'])
print(f'{wrong} wrong')
sys.exit(wrong > 0)
