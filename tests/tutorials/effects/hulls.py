from tutorial import figure, status

USES = ['Mdt', 'Mcd', 'Mst']
IS_LONG = True
# Tetrahedron, cube, octahedron, dodecahedron, icosahedron; table, 16 triangles round it and 8 to the point of the gem;
# 2 n - 4 triangles of the pebble's 50 points; 6 sides and 12 triangles of the crystal.
FACES = 'faces 4 6 8 12 20 25 96 18 '


def check():
    """Each hull has the faces it should have; the heap comes to rest and sleeps, not through the floor, twice."""
    for frames, keys in (1500, ''), (3000, '3@1500'):
        line = status(frames, keys)
        assert FACES in line, line
        assert figure(line, 'awake') == 0 and figure(line, 'motion') == 0, line
        assert figure(line, 'deepest') < 0.5, line  # mm: what sleeps may have so much left (test_Mst_Heaps)
        assert figure(line, 'in the tray') >= 40, line
    line = status(1530, '3@1500')
    assert figure(line, 'awake') == 48 and figure(line, 'motion') > 1000, f'they have not been tossed up: {line}'
