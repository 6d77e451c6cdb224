#!/usr/bin/env python3
"""Runs without a window: exit codes, pictures and their names, and that the same run gives the same picture.

usage: check_runs.py <program> <png_check>
"""
import os
import re
import subprocess
import sys
import tempfile

program, compare = (os.path.abspath(p) for p in sys.argv[1:3])
failures = 0


def run(arguments, expected, *texts):
    """Runs the program; its exit code and what its output must match."""
    global failures
    environment = {k: v for k, v in os.environ.items() if k != 'DISPLAY'}
    done = subprocess.run([program, *arguments.split()], capture_output=True, text=True, env=environment, timeout=250)
    output = done.stdout + done.stderr
    wrong = [t for t in texts if not re.search(t, output)]
    if done.returncode != expected or wrong:
        failures += 1
        print(f'FAILED: program {arguments}: exit code {done.returncode}, expected {expected}; missing {wrong}; '
              f'output:\n{output}')
    return output


def expect(condition, what):
    global failures
    if not condition:
        failures += 1
        print(f'FAILED: {what}')


def same(a, b):
    with open(a, 'rb') as f, open(b, 'rb') as g:
        return f.read() == g.read()


with tempfile.TemporaryDirectory() as directory:
    os.chdir(directory)
    run('-null -frames 50', 0, r'tick 3', r'cleanup 0')
    run('-bench -frames 50 -warn', 2, r'cleanup 0')
    run('-null -exit 5', 7, r'cleanup 0')
    run('-null -destroy 5', 0, r'destroyed 0')
    run('-osmesa -size 64x48 -destroy 5', 0, r'destroyed 0')
    run('-null -frames 50 -key q@10', 0, r'cleanup 0')
    run('-null -frames 5 -key Enter@3', 0, r'reset at 2')
    run('-null -frames 5 -screenshot none.png', 2, r'none\.png')
    run('-null -frames 5 -profile', 0)
    run('-gl -frames 5', 1, r'-osmesa')
    for way in ('-help', '--help', '-h'):
        run(way, 0, r'-frames', r'-screenshot', r'-osmesa')

    # What nobody knows ends the program before its first tick, with one message that says what to write.
    for words, message in (('-fraems 50', '-fraems is no option: write -frames'), ('--size 64x48', 'write -size'),
                           ('-nonsense', '-nonsense is no option: -help lists all'), ('file', 'file belongs to no option'),
                           ('-frames 5 -frames abc', '-frames is given more than once'),
                           ('-frames=5 -frames=9', '-frames is given more than once'),
                           ('-frames abc', '-frames abc: write a whole number above 0'),
                           ('-size 7', '-size 7: write WIDTHxHEIGHT'), ('-key Foo@3', '-key Foo@3: write NAME@FRAME'),
                           ('-frames', 'option -frames has no value: write -frames VALUE'),
                           ('-screenshot none/such.png', 'there is no directory none: make it first')):
        said = run(f'-null {words}', 2, re.escape(message))
        expect(said.count('Karma warning') == 1 and 'tick' not in said, f'{words}: more than one message, or a tick:\n{said}')

    run('-osmesa -size 320x240 -frames 12 -screenshot a.png', 0, r'wrote a\.png \(320x240\)')
    run('-size 320x240 -frames 12 -screenshot b.png', 0, r'wrote b\.png')  # no display: off-screen by itself
    expect(same('a.png', 'b.png'), 'the same run gives another picture')
    run('-osmesa -size 320x240 -frames 12 -screenshot c.png -key F1@6', 0)
    run('-osmesa -size 320x240 -frames 12 -screenshot d.png -key F1@5,F1@6', 0)
    expect(subprocess.run([compare, 'help', 'a.png', 'c.png']).returncode == 0, '-key F1 shows no help')
    expect(not same('a.png', 'd.png'), 'a pause does not hold the ball')
    run('-osmesa -size 320x240 -frames 12 -screenshot e.png -camera 30,1,0.5', 0)
    expect(not same('a.png', 'e.png'), '-camera does nothing')
    run('-osmesa -size 64x48 -frames 10 -every 3 -screenshot series.png', 0, r'3 pictures.*series-0003\.png')
    expect(sorted(f for f in os.listdir('.') if f.startswith('series')) ==
           [f'series-000{i}.png' for i in (1, 2, 3)], '-every wrote other files')
    run('-osmesa -size 64x48', 0, r'wrote test_viewer_program\.png \(64x48\)')
    os.mkdir('place.png')
    run('-osmesa -size 64x48 -frames 3 -screenshot place.png', 2, r'place\.png cannot be written')
    os.rmdir('place.png')
    run('-osmesa -size 64x48 -frames 3 -key F2@2,F2@3', 0, r'test_viewer_program-0001\.png',
        r'test_viewer_program-0002\.png')

    # A film: every second tick's picture goes to ffmpeg, or what stands for it here, with size and rate.
    paths = os.environ['PATH']
    os.environ['PATH'] = directory  # no ffmpeg, even where it is installed
    said = run('-osmesa -size 64x48 -frames 3 -film film.mp4', 2, r'film\.mp4: ffmpeg is not installed.*apt-get install ffmpeg')
    expect('tick' not in said, f'without ffmpeg it simulates before it says so:\n{said}')
    os.environ['PATH'] = ''
    run('-osmesa -size 64x48 -frames 3 -film film.mp4', 2, r'ffmpeg is not installed')
    os.environ['PATH'] = f'{directory}:{paths}'
    with open('ffmpeg', 'w') as tool:
        tool.write('#!/bin/sh\nprintf "%s\\n" "$@" >arguments\ncat >pictures\n')
    os.chmod('ffmpeg', 0o755)
    run("-osmesa -size 64x48 -frames 21 -film it's.mp4", 0, r"wrote it's\.mp4 \(64x48, 10 pictures\)")
    arguments = open('arguments').read().split('\n')
    expect(arguments[arguments.index('-video_size') + 1] == '64x48' and
           arguments[arguments.index('-framerate') + 1] == '30' and arguments[-2] == "it's.mp4",
           f'ffmpeg was called with {arguments}')
    expect(os.path.getsize('pictures') == 10 * 64 * 48 * 4, 'not all pictures arrived')
    run('-osmesa -size 64x48 -frames 21 -film it.gif', 0, r'7 pictures')
    expect('20' in open('arguments').read().split('\n'), 'a GIF has 20 pictures a second')
    run('-null -frames 5 -film it.gif', 2, r'-null')
    with open('ffmpeg', 'w') as tool:
        tool.write('#!/bin/sh\nexit 3\n')
    run('-osmesa -size 320x240 -frames 21 -film it.mp4', 2, r'could not make the film')
    os.environ['PATH'] = paths

print('runs without a window: ' + (f'{failures} failures' if failures else 'all as they should be'))
sys.exit(failures > 0)
