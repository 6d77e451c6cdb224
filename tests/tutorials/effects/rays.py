import math

from tutorial import figure, near, status

USES = ['Mcd']  # of the libraries above MeGlobals
LAMP, RANGE, RAYS, BALL = (0, 0), 9, 90, 0.15
CONE = math.atan(0.9 / 2)  # between its axis and its side

# What the room is like at the height of the lamp, seen from above: circles (x, z, radius) and rectangles
# (x, z, half width, half depth, turn), each with whether it is glass.
CIRCLES = [(-3, -0.9, 1, False), (-2, 3, 0.5, False), (2, -2.4, 0.6, False), (5, -2, 0.5, False)]
RECTANGLES = [(3, 1, 0.5, 0.5, 0.4, False), (0, -4, 2, 0.1, 0, False), (1.8, 0.8, 0.05, 1.5, 0.4, True),
              (-1.2, 1.8, 1.5, 0.05, -0.3, True)]
CONE_AT = (1, 4, 0.9 * 3 / 4)  # its height's centre of mass is at a quarter


def circle(p, x, z, radius):
    return math.hypot(p[0] - x, p[1] - z) - radius


def rectangle(p, x, z, width, depth, turn):
    """The distance; a turn about y takes x to (cos, -sin)."""
    dx, dz = p[0] - x, p[1] - z
    u = abs(dx * math.cos(turn) - dz * math.sin(turn)) - width
    v = abs(dx * math.sin(turn) + dz * math.cos(turn)) - depth
    return math.hypot(max(u, 0), max(v, 0)) + min(max(u, v), 0)


def shapes(ball, glass):
    """-> distances to all that is seen, less the ball's radius; the ball meets the cone on its slanting side."""
    for x, z, radius, _ in CIRCLES:
        yield lambda p, s=(x, z, radius): circle(p, *s) - ball
    yield lambda p: circle(p, *CONE_AT) - ball / math.cos(CONE)
    for *s, is_glass in RECTANGLES:
        if glass or not is_glass:
            yield lambda p, s=s: rectangle(p, *s) - ball


def cast(angle, distance):
    """-> how far a ray gets, by steps as long as nothing is nearer than; None: all the way."""
    t = 0
    while t < RANGE:
        d = distance((LAMP[0] + t * math.cos(angle), LAMP[1] + t * math.sin(angle)))
        if d < 1e-7:
            return t
        t += d
    return None


def around(ball, glass):
    """-> (number of hits, the nearest)"""
    seen = list(shapes(ball, glass))
    hits = [cast(2 * math.pi * i / RAYS, lambda p: min(s(p) for s in seen)) for i in range(RAYS)]
    hits = [t for t in hits if t is not None]
    return len(hits), min(hits)


def check():
    """Rays end where they should, thin and thick, with and without glass; the red one counts all that it enters."""
    for keys, ball, glass in (('', 0, True), ('3@1', 0, False), ('4@1', BALL, True), ('3@1,4@1', BALL, False)):
        line = status(3, keys)
        count, nearest = around(ball, glass)
        assert abs(figure(line, 'hits') - count) <= (1 if ball else 0), f'{keys}: {line}, expected {count}'
        near(figure(line, 'nearest'), nearest, 1e-3 if ball else 2e-4, f'nearest with "{keys}"')
    for frame in (1, 60, 150, 400):
        line = status(frame)
        angle = 0.01 * (frame - 1)
        count = sum(cast(angle, s) is not None for s in shapes(0, True))
        assert figure(line, 'on the red one') == count, f'{frame}: {line}, expected {count}'
