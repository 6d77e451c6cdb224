import math

from tutorial import figure, near, status


def check():
    """In the pane: a throw with gravity g sin(tilt). The rail's bead keeps up. The joints bear the rest and wind."""
    for keys, tilt, speed in ('', 30, 5), ('Up@1,Up@1', 40, 5), ('Down@1,Right@1', 25, 5.5):
        slope, e = math.radians(tilt), math.radians(53)
        for frames in 20, 50, 75:
            line = status(frames, keys)
            up = speed * math.sin(e) * frames / 60 - 9.8 * math.sin(slope) * (frames / 60) ** 2 / 2
            near(figure(line, 'across'), speed * math.cos(e) * frames / 60, 0.002, 'the way across')
            near(figure(line, 'up'), up, 0.002, 'the way up the slope')
            near(figure(line, 'rises'), up, 0.002, "the rail bead's way")
            bear(line, 9.8 * math.cos(slope))
    bear(status(50, '3@1'), 9.8 * math.cos(math.radians(30)) + 20)
    bear(status(600), 9.8 * math.cos(math.radians(30)))


def bear(line, force):
    near(figure(line, 'force'), force, 0.051, "the plane's force")
    near(figure(line, 'bears'), force, 0.051, "the rail's force")
    for name in 'off the pane', 'rail: rises %.3f m, off' % figure(line, 'rises'):
        near(figure(line, name), 0, 0.05, f'{name}, in mm')
