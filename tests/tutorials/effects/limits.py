import math
import re

from tutorial import near, status

G, STEP = 9.8, 1 / 240


def check():
    """Hard stops give back the square of the restitution, soft ones what their damping leaves."""
    for keys, drop, strong in ('', 2, 200), ('Down@1,Down@1', 1, 200), ('Right@1,Right@1,Right@1,Right@1', 2, 400):
        line = status(300, keys)
        rebounds, pressed = figures(line, 'rebounds'), figures(line, 'by')
        for height, e in zip(rebounds, (0, 0.5, 1)):
            is_hit_at = math.sqrt(2 * G * drop) * STEP * (1 - e**2)  # at most so far above the stop
            near(height, e**2 * drop + is_hit_at / 2, is_hit_at / 2 + 0.01, f'the rebound of restitution {e}')
        for k, stiffness, damping in (0, strong, 0), (1, strong, 4), (2, 0.4 * strong, 4):
            depth, height = soft(drop, stiffness, damping)
            near(pressed[k], depth, 0.01, f'how far the spring {k} is pressed')
            near(rebounds[3 + k], *undamped(height, damping), f'the rebound from the spring {k}')
    low = figures(status(300, '3@1'), 'rebounds')  # the strong springs are stiffer than the threshold, so hard: 0.7
    for height in low[3:5]:
        near(height, 0.49 * 2, 0.03, 'the rebound of a spring that counts as hard')
    near(low[5], *undamped(soft(2, 80, 4)[1], 4), 'the rebound from the spring below the threshold')


def figures(line, name):
    return [float(x) for x in re.search(re.escape(name) + r' \(m\):((?: [0-9.]+)+)', line).group(1).split()]


def undamped(height, damping):
    """-> the height and its tolerance, where the step that comes to the stop has no damping: for 1 kg, that is up to
    damping x step of the speed."""
    more = height * damping * STEP
    return height + more, more + 0.01


def soft(drop, k, c, h=1e-5):
    """How deep and how high: 1 kg falls on a spring and damper that only push. Integrated with a small step."""
    x, v = 0.0, -math.sqrt(2 * G * drop)
    deepest = 0.0
    while x <= 0:
        v += h * (max(-k * x - c * v, 0) - G)
        x += h * v
        deepest = min(deepest, x)
    return -deepest, v * v / (2 * G)
