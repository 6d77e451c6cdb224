#!/usr/bin/env python3
"""tests/fuzz/planted.py [-seconds 60] [-preset ci] [fault ...] - do the fuzzers find what they are made for?

Puts one known fault at a time into a copy of the sources in build/planted, each of a kind that users have met, builds the
fuzzers and runs them with the seeds 1, 2, ... until one of them finds something, without the stored runs. Prints how long
that took. Fails if a fault is not found in time."""
import argparse, os, shutil, subprocess, sys, time

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PLACE = os.path.join(TOP, 'build', 'planted')
TREE, BUILD = os.path.join(PLACE, 'tree'), os.path.join(PLACE, 'build')

# name: (the fuzzer, file, what is there, what is put there, maybe another file ...)
FAULTS = {
    'callbacks-destroy-at-once':
        ('calls', 'MeGlobals/src/me_stage.c', 'return MeStageIsActive(stage, level) ? MeWhenStageEnds : MeWhenNow;',
         'return level < 0 ? MeWhenStageEnds : MeWhenNow;'),
    'body-keeps-its-models':
        ('calls', 'Mdt/src/record/MdtBody.c', '    if (mdt_userOf(b))\n        mdt_userOf(b)->leave(b);\n', ''),
    'body-keeps-its-joints':
        ('calls', 'Mdt/src/record/MdtBody.c', 'while (b->attachments)\n', 'while (b->attachments && b->attachments->next)\n'),
    'two-models-of-a-body-touch':
        ('calls', 'Mst/src/step/mst_commit.c', '|| body1 == body2 ||', '||',
         'Mst/src/step/mst_step_i.h', 'return mst_bodyOf(p->model1) && mst_bodyOf(p->model1) == mst_bodyOf(p->model2);',
         'return MEFALSE && p;'),
    'model-of-another-world':
        ('calls', 'Mst/src/step/mst_commit.c', '|| !areBodiesOfWorld(b, body1, body2, w)', '|| (areBodiesOfWorld(b, body1, body2, w), 0)'),
    'bodies-of-a-bridges-group':
        ('calls', 'Mdt/src/record/MdtConstraint.c', 'if (base->record.flags & MDT_BRIDGED) {', 'if (0) {'),
    'centre-of-mass-anywhere':
        ('calls', 'Mdt/src/record/MdtBody.c', '    if (!isCentreInBound(caller, b, centre))\n        return;\n', ''),
    'rim-of-a-model-that-is-gone':
        ('calls', 'Mcd/src/model/McdContact.c', 'return isKnown && mcd_record(ins->model)->magic == MCD_MODEL ? ins : 0;',
         'return ins;'),
    'side-out-of-range':
        ('calls', 'Mcd/src/model/McdContact.c', 'if (!c || side < 0 || side > 1) {', 'if (!c) {'),
    'numbers-that-are-none':
        ('calls', 'Mdt/src/base/mdt_check.c', 'if (mdt_areFinite(v))', 'if (mdt_areFinite(v) || x != x)'),
    'sizes-that-are-none':
        ('calls', 'Mcd/src/geometry/mcd_local.c', 'if (size >= (MeReal)FLT_MIN && size <= (MeReal)(FLT_MAX / 4))',
         'if (!(size < (MeReal)FLT_MIN) && !(size > (MeReal)(FLT_MAX / 4)))'),
    'facet-before-the-first':
        ('geometries', 'Mcd/src/convex/mcd_distance.c', 'MeMAX(nearestFacet(t), 0)', '-1'),
    'line-longer-than-its-place':
        ('files', 'MeGlobals/src/MeStream.c', 'MeMIN(there, (size_t)n - 1)', 'MeMIN(there, (size_t)n)'),
}


def run(*command, **more):
    return subprocess.run(command, capture_output=True, text=True, errors='replace', **more)


def build():
    done = run('cmake', '--build', BUILD, '-j', str(os.cpu_count()), '--target', 'fuzz_calls', 'fuzz_geometries',
               'fuzz_files')
    if done.returncode:
        sys.exit(done.stdout + done.stderr)


def copy(preset):
    files = run('git', '-C', TOP, 'ls-files').stdout.split('\n')
    for name in filter(None, files):
        source, target = os.path.join(TOP, name), os.path.join(TREE, name)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        if os.path.isfile(source) and (not os.path.isfile(target) or open(source, 'rb').read() != open(target, 'rb').read()):
            shutil.copy(source, target)
    done = run('cmake', '--preset', preset, '-B', BUILD, '-DKARMA_WERROR=OFF', cwd=TREE)
    if done.returncode:
        sys.exit(done.stdout + done.stderr)


def planted(file, there, instead):
    """-> the text with the fault."""
    with open(os.path.join(TOP, file)) as f:
        text = f.read()
    if text.count(there) != 1:
        sys.exit(f'{file} has {text.count(there)} times {there!r}')
    return text.replace(there, instead)


def search(fuzzer, seconds):
    """-> after how long it is found, and what; None: it is not."""
    start = time.time()
    seed = 0
    while time.time() - start < seconds:
        seed += 1
        left = seconds - (time.time() - start)
        done = run(os.path.join(BUILD, 'tests', 'fuzz', 'fuzz_' + fuzzer), '--seed', str(seed), '--calls', '1000000000',
                   '--seconds', str(left), '--most', '1', '--shorten', '0')
        for line in done.stdout.splitlines():
            if 'FOUND' in line:
                return time.time() - start, line.split('FOUND ', 1)[1]
        if done.returncode:
            return time.time() - start, done.stderr[-200:]
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('-seconds', type=float, default=60)
    parser.add_argument('-preset', default='ci')
    parser.add_argument('fault', nargs='*', help='one of ' + ', '.join(FAULTS))
    options = parser.parse_args()
    copy(options.preset)
    missed = []
    for name in options.fault or FAULTS:
        fuzzer, *changes = FAULTS[name]
        changes = [changes[i:i + 3] for i in range(0, len(changes), 3)]
        for file, there, instead in changes:
            with open(os.path.join(TREE, file), 'w') as f:
                f.write(planted(file, there, instead))
        build()
        found = search(fuzzer, options.seconds)
        print(f'{name}: ' + (f'found in {found[0]:.1f} s: {found[1]}' if found else 'NOT FOUND'), flush=True)
        missed += [] if found else [name]
        for file, _, _ in changes:
            shutil.copy(os.path.join(TOP, file), os.path.join(TREE, file))
    sys.exit(1 if missed else 0)


main()
