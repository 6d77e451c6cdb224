from tutorial import figure, near, status

USES = ['Mcd']  # of the libraries above MeGlobals
DRIVEN = ['box', 'cylinder', 'sphyl', 'cone', 'hull', 'stool', 'ball']  # in the order of key 3
FIXED = ['box', 'cylinder', 'sphyl', 'cone', 'hull', 'stool', 'plane', 'triangle list', 'height field', 'ball']


def presses(key, times, first):
    return [f'{key}@{first + i}' for i in range(times)]


def check():
    """A box in a box's face has four contacts; pushed out by what the library says, every shape only just touches."""
    line = status(2)
    assert line.strip().startswith('box against box'), line
    assert figure(line, 'contacts') == 4, line
    near(figure(line, 'deepest'), -0.05, 2e-4, 'the depth')
    near(figure(line, 'distance'), -0.05, 2e-4, 'the distance')
    assert status(60) == line and 'box against cylinder' in status(200), 'the shapes do not change by themselves'
    assert status(200, 'Enter@1') == line, 'the shapes change after a key'
    line = status(30, ','.join(presses('Up', 10, 1)))
    assert 'no contact' in line, line
    near(figure(line, 'distance'), 0.15, 2e-4, 'the distance after ten steps up')
    for i, driven in enumerate(DRIVEN):
        for k, fixed in enumerate(FIXED):
            kinds = presses('3', i, 1) + presses('4', k, 10)
            for steps in (3, 10, 25):  # a stool takes a cone between its legs
                down = presses('Down', steps, 22)
                line = status(50, ','.join(kinds + down))
                assert line.strip().startswith(f'{driven} against {fixed}'), f'{driven}, {fixed}: {line}'
                if 'contacts' in line:
                    break
            assert 'contacts' in line, f'{driven}, {fixed} do not meet: {line}'
            assert figure(line, 'deepest') < 0.021, f'{driven}, {fixed}: {line}'
            line = status(60, ','.join(kinds + down + presses('5', 6, 51)))
            assert 'contacts' in line, f'{driven}, {fixed}: pushed out, it is gone: {line}'
            near(figure(line, 'deepest'), 0, 2e-3, f'{driven} against {fixed}, pushed out: the depth')
