#!/usr/bin/env python3
"""calls.py SOURCE OUTPUT COMPILER [DEFINITION ...] - writes a table of all public functions as C, for fuzz_calls.c.

The headers of the libraries below are preprocessed; a function is public that is declared with MEPUBLIC there. Each gets
a name, the kinds of its parameters and of its result, a weight, and a function that calls it with values of these kinds:

    handle       a pointer to something that a library owns: from a pool of such, with live, stale and null ones
    reals        an array of MeReal, or of double, that stays where it is: functions keep pointers
    record       a structure of the program's, filled by fuzz_records.c
    callback     a function of fuzz_callbacks.c
    real, integer, text, opaque (void *)

What is not called is in EXCEPTIONS, with the reason. A parameter of an unknown kind is an error: say here what it is.
"""
import pathlib
import re
import subprocess
import sys

LIBRARIES = ('MeGlobals', 'MdtKea', 'MdtBcl', 'Mdt', 'Mcd', 'Mst')
# Not installed, or no interface of a library.
NOT_PUBLIC = ('MdtInternal.h', 'MeInternal.h', 'McdInternal.h', 'MeTeam.h', 'KarmaClassic.h')

EXCEPTIONS = [
    (r'Me(Info|Debug|Log|Warning|FatalError)$|MeHandler\w+$|MeShow\w+$', 'the format, and its arguments, are the program\'s'),
    (r'MeSet\w+(Handler|Show)$', 'the fuzzer has handlers of its own'),
    (r'MeMatrixF?Print$', 'the same: a format'),
    (r'MeMatrix(Multiply|MultiplyT1|Transpose)$|MeRealArrayIsZero$|MeVectorSetZero$', 'arrays of any size'),
    (r'MeRandGetSeed|MeRealRand|MeVectorMakeRandom', 'arrays of any size'),
    (r'Me(Dict|Set|Heap|Hash|Poolx)[A-Z]\w*$|MeChunk(Init|PutMem)$|MeIDPoolCopy$', 'places, nodes and keys are memory of the program'),
    (r'Me(Open|OpenRaw|OpenWithSearch|Close|Read|Write|Lseek|LoadWholeFileHandle|SaveWholeFileHandle)$|MeStream\w+$',
     'files: fuzz_files'),
    (r'MeCommandLine\w+$', 'texts: fuzz_files'),
    (r'tic(OutputResults)?$|toc$|MeProfileOutputResults|MeProfileSetOutputParameters', 'write files'),
    (r'MeProfileStartTiming$', 'takes a structure'),
    (r'MeHSVtoRGB$|MeMatrix3LUDecompose$', 'arrays of other numbers'),
    (r'MeTaskPool\w+$|MdtWorldSetTaskCallbacks$', 'threads: the fuzzer gives worlds a pool of its own'),
    (r'MeShortenPath$', 'returns its argument'),
    (r'MdtKea\w+$|MdtBcl(AddRow|TypeOf|ContactSurface|SkeletalZeroTwist|Coupling\w+|GearEngage)$',
     'arrays of the caller: MdtKea and the rows of MdtBcl, which programs see in callbacks only'),
    (r'MdtUnpackForces$|MdtAutoDisableLastPartition$|MdtPartitionGetSafeTime$|MdtUpdatePartitions$',
     'take the library\'s own arrays, in callbacks'),
    (r'MdtWorldSetMatrixSizeLog$', 'keeps an array of any size'),
    (r'McdGeometry(Init|Deinit)$|McdGeometry(Set|Increment|Decrement)\w*ReferenceCount$|McdFrameworkRegisterGeometryType$|'
     r'McdFrameworkSetInteractions(Warned)?$|McdFrameworkSetLineSegInteraction$|McdFrameworkRegisterConvexType$|'
     r'McdConvex(Create|SetData|GetData)$',
     'for geometry types of a program, which are memory of the program'),
    (r'McdModelPairContainer(Init|RemovePair)$', 'an array of the program'),
    (r'McdCullingTableDestroy$', 'a table that models use'),
    (r'McdModelPairReset$', 'not between McdHello and McdGoodbye'),
    (r'McdModelSetRelativeTransformPtrs$', 'may destroy memory of the program'),
    (r'McdModelSetBodyData$|MdtBodySetModel$', 'the bridge\'s: pointers without a type'),
    (r'Mcd\w*InstanceSetAABB$', 'writes what a geometry type of a program computes'),
    (r'MdtContactGroup(Set|Get)(Generator|Holder)$', 'the bridge\'s'),
    (r'McdQueryBy(Filter|Pairs)$', 'called by queries, with data of the program'),
    (r'MstAdvise\w*$|MstAdvice\w*$', 'copies of the whole process'),
    (r'Mst(HandleTransitions|HandleTransitionsOf|HandleCollisions)$', 'pairs that are not the bridge\'s'),
    (r'McdTerm$', 'of frameworks that are a universe\'s: to be destroyed by it'),
    (r'Mcd\w*PrintStats$|McdFrameworkPrintInteractionTable$', 'print'),
]

# What a number of things may be at most: the arrays that go with it are so large.
LIMITS = {
    'MeBoundingSphereCalc': {'numPoints': 64},
    'McdConvexMeshCreateHull': {'vertexCount': 64},
    'McdRGHeightFieldCreate': {'xCount': 8, 'yCount': 8},
    'McdMeshCreate': {'vertexCount': 64, 'triangleCount': 16},
    'McdMeshCreateWithFlags': {'vertexCount': 64, 'triangleCount': 16},
    'McdContactSimplify': {'nContacts_src': 64, 'nContacts_dest': 64},
    'McdBatchIntersectEach': {'resultMaxCount': 16, 'contactMaxCount': 64},
    'McdIntersectEach': {'resultArraySize': 16, 'contactArraySize': 64},
    'McdSpaceGetLineSegIntersections': {'inMaxListSize': 16},
    'McdSpaceOverlapBox': {'listSize': 64},
    'McdSpaceOverlapGeometry': {'listSize': 64},
    'McdSpaceOverlapModel': {'listSize': 64},
    'MdtWorldCreate': {'maxBodies': 100000, 'maxConstraints': 100000},
    'MdtWorldSetSubSteps': {'n': 20},
}
SLICES = {'maxVert': 64}  # of all functions that have such a parameter

MANY = {'heights'}  # arrays as large as there are
# What a function returns that is not to be handed on: it may be gone at any time.
NOT_KEPT = {'McdModelPairManagerGetPair'}

WEIGHTS = [
    (r'MstUniverseStep$', 120), (r'MdtWorldStep$', 10), (r'MdtWorldStep\w+$', 4),
    (r'MstModelAndBodyCreate$', 30), (r'MstFixedModelCreate$', 12), (r'MstUniverseCreate$', 1),
    (r'Mcd(Box|Sphere|Sphyl|Cylinder|Cone|Plane|ConvexMeshHull|RGHeightField|TriangleList|Mesh|Aggregate)Create$', 5),
    (r'McdAggregateAddElement$', 6),
    (r'McdModelDynamicsSetPosition$|McdModelSetTransformPtr$|McdModelDynamicsGetBody$|McdModelGetBody$', 8),
    (r'Mdt\w+(Create|SetBodies|Enable)$', 3),
    (r'McdIntersect$|McdModelPairCreate$|McdSafeTime$|McdDistance$', 5),
    (r'MstUniverseGet\w+$', 3), (r'MstBridgeGetContactParams$', 6),
    (r'MdtWorldSetGravity$', 4), (r'MstVehicle(Create|Drive)$', 5), (r'MstVehicleAddWheel$', 12),
]

# Structures of which there is a pool: canonical names (the structure's tag).
HANDLES = [
    'MstUniverse', 'MstBridge', 'MdtWorld', 'MdtBody', 'MdtBaseConstraint', 'MdtBSJoint', 'MdtHinge', 'MdtPrismatic', 'MdtUniversal',
    'MdtAngular3', 'MdtCarWheel', 'MdtLinear1', 'MdtLinear2', 'MdtFixedPath', 'MdtFPFOJoint', 'MdtRPROJoint', 'MdtSpring',
    'MdtSpring6', 'MdtConeLimit', 'MdtSkeletal', 'MdtGear', 'MdtPulley', 'MdtMimic', 'MdtUserConstraint', 'MdtContact',
    'MdtContactGroup', 'MdtBclLimit',
    'MdtBclSingleLimit', 'MdtBclContactParams', '_McdFramework', '_McdSpace', '_McdGeometry', '_McdGeometryInstance', '_McdModel',
    '_McdModelPair', '_McdModelPairContainer', 'McdModelPairManager', 'McdCullingTable', 'McdBatchContext', 'MeIDPool', 'MeChunk',
    'MeTaskPool', 'MstMover', 'MstVehicle',
]
CONSTRAINTS = HANDLES[HANDLES.index('MdtBSJoint'):HANDLES.index('MdtBclLimit')]

REALS = {'MeReal', 'AcmeReal', 'float'}
ARRAYS = {'MeVector3': 3, 'MeVector4': 4, 'MeMatrix3': 9, 'MeMatrix4': 16, 'MeMatrix4Ptr': 16, 'MeMatrix3Ptr': 9, 'MeVector3Ptr': 3,
          'MeVector4Ptr': 4}
INTEGERS = {'int', 'unsigned', 'unsigned int', 'long', 'unsigned long', 'short', 'char', 'unsigned char', 'char unsigned', 'signed char',
            'size_t'}


def canonical(text):
    """typedef name -> (base, stars), of all typedefs that are plain; enums are integers."""
    known = {}
    for name in re.findall(r'typedef enum \w*\s*\{[^}]*\}\s*(\w+)\s*;', text):
        known[name] = ('int', 0)
    for base, stars, name in re.findall(r'typedef\s+(?:const\s+)?(?:struct\s+|enum\s+)?(\w+(?:\s+\w+)*?)\s*(\**)\s*(\w+)\s*;', text):
        known[name] = (base, len(stars))
    for tag, name in re.findall(r'typedef struct (\w+)\s*\{(?:[^{}]|\{[^{}]*\})*\}\s*(\w+)\s*;', text):
        known[name] = (tag, 0)
    return known


def resolve(base, stars, known):
    seen = set()
    while base in known and base not in seen and base not in REALS:
        seen.add(base)
        base, more = known[base]
        stars += more
    return base, stars


class Unknown(Exception):
    pass


def split(text):
    parts = [part.strip() for part in re.split(r',(?![^()]*\))', text)]
    return [part for part in parts if part not in ('', 'void')]


def classify(parameter, function, known, callbacks, records):
    """(kind, type, size or limit, C type to cast to) of a parameter."""
    match = re.fullmatch(r'(.*?)(\w+)?\s*((?:\[\w*\])*)', parameter)
    core, name, arrays = match.groups()
    words = [w for w in re.findall(r'\w+|\*', core) if w not in ('const', 'struct', 'enum', 'register')]
    if not words:
        words, name = [name], ''
    base, stars = ' '.join(w for w in words if w != '*'), words.count('*')
    is_const = bool(re.match(r'const\b', parameter.strip()))
    cast = f'{base} {"*" * stars}'
    limit = LIMITS.get(function, {}).get(name, SLICES.get(name, 0))
    dimensions = [int(d) for d in re.findall(r'\[(\d+)\]', arrays)]
    if base == 'va_list' or base == 'FILE':
        raise Unknown(parameter)
    if base == 'double' and dimensions:
        size = dimensions[0] * (dimensions[1] if len(dimensions) > 1 else 1)
        return 'DOUBLES', 0, size, is_const, 'void *'
    if base in REALS and (dimensions or stars == 1):
        size = dimensions[0] if dimensions else 0
        if base != 'MeReal':
            raise Unknown(parameter)
        size = 192 if name in MANY else 4 if size == 0 else size if size in (3, 4, 9, 16) else 16
        return 'REALS', 0, size, is_const, 'void *'
    if base in ARRAYS and stars == 0 and not dimensions:
        return 'REALS', 0, ARRAYS[base], is_const, 'void *'
    if base == 'MeVector3' and dimensions == [3]:
        return 'REALS', 0, 9, is_const, 'void *'
    if base == 'MeVector3' and stars == 1:
        return 'REALS', 0, 192, is_const, 'void *'
    if base == 'char' and stars == 1:
        return 'TEXT', 0, 0, 0, 'void *'
    if base == 'void' and stars == 1:
        return 'OPAQUE', 0, 0, 0, 'void *'
    if base in callbacks:
        return 'CALLBACK', callbacks[base], 0, 0, base
    tag, depth = resolve(base, stars, known)
    if depth == 1 and tag in HANDLES:
        return 'HANDLE', HANDLES.index(tag), 0, 0, cast
    if depth == 0 and (tag in INTEGERS or tag.startswith('unsigned')):
        return 'INTEGER', 1 if base == 'MeBool' else 0, limit, 0, cast
    if depth == 0 and tag in ('MeReal', 'float', 'double', 'AcmeReal'):
        is_step = name in ('step', 'stepsize', 'duration', 'motionDuration', 'dt', 'time')
        return 'REAL', is_step, 0, 0, cast
    record = f'{tag.lstrip("_").replace(" ", "_")}{"_" * (depth - 1)}' if depth else None
    if record in records:
        return 'RECORD', records[record], 0, 0, 'void *'
    raise Unknown(f'{parameter} ({tag}{"*" * depth})')


def classify_result(text, known):
    words = [w for w in re.findall(r'\w+|\*', text) if w not in ('const', 'struct', 'enum')]
    base, stars = ' '.join(w for w in words if w != '*'), words.count('*')
    if base == 'void' and not stars:
        return 'NOTHING', 0
    tag, depth = resolve(base, stars, known)
    if depth == 1 and tag in HANDLES:
        return 'HANDLE', HANDLES.index(tag)
    if depth == 0 and tag in ('MeReal', 'float', 'double'):
        return 'REAL', 0
    if depth == 0 and tag in INTEGERS:
        return 'INTEGER', 0
    return 'OTHER', 0


def preprocess(source, compiler, definitions, headers):
    text = ''.join(f'#include "{h.name}"\n' for h in headers)
    flags = [f'-I{source / library / "include"}' for library in LIBRARIES] + [f'-D{d}' for d in definitions]
    run = subprocess.run([compiler, '-E', '-P', '-std=c11', *flags, '-x', 'c', '-'], input=text, capture_output=True, text=True, check=True)
    return run.stdout


def functions(text):
    text = re.sub(r'__attribute__\(\(__format__\(.*?\)\)\)', '', text)
    pattern = r'__attribute__\(\(visibility\("default"\)\)\)\s+([^;{}=()]*?)\(?\b(\w+)\)?\s*\(((?:[^;{}=()]|\([^()]*\))*)\)\s*;'
    for result, name, rest in re.findall(pattern, text):
        yield ' '.join(result.split()), name, ' '.join(rest.split())


def listed(path, macro):
    """name -> index, of MACRO(name) at the beginning of lines of a C file."""
    return {name: i for i, name in enumerate(re.findall(rf'^\s*{macro}\((\w+)', path.read_text(encoding='utf-8'), re.M))}


def weight(name):
    return next((w for pattern, w in WEIGHTS if re.match(pattern, name)), 1)


def exception(name):
    return next((reason for pattern, reason in EXCEPTIONS if re.match(pattern, name)), None)


def thunk(name, result, parameters):
    given = ', '.join(f'({p[4]})a[{i}].{"p" if p[4].endswith("*") or p[0] in ("HANDLE", "RECORD") else "f" if p[0] == "CALLBACK" else "r" if p[0] == "REAL" else "i"}'
                      for i, p in enumerate(parameters))
    call = f'({name})({given})'
    body = {'NOTHING': f'{call};\n    (void)result;', 'HANDLE': f'result->p = {call};', 'REAL': f'result->r = (double){call};',
            'INTEGER': f'result->i = (long){call};', 'OTHER': f'(void){call};\n    (void)result;'}[result[0]]
    unused = '' if parameters else '    (void)a;\n'
    return f'static void call_{name}(const FuzzValue *a, FuzzValue *result) {{\n{unused}    {body}\n}}\n'


def main():
    source, output, compiler = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
    here = pathlib.Path(__file__).resolve().parent
    headers = [h for library in LIBRARIES for h in sorted((source / library / 'include').glob('*.h')) if h.name not in NOT_PUBLIC]
    text = preprocess(source, compiler, sys.argv[4:], headers)
    known = canonical(text)
    callbacks, records = listed(here / 'fuzz_callbacks.c', 'CALLBACK'), listed(here / 'fuzz_records.c', 'RECORD')
    lines = ['/* Written by calls.py. */', '#include "fuzz_calls.h"', *(f'#include "{h.name}"' for h in headers), '']
    entries, left, errors, found = [], [], [], set()
    for result, name, rest in sorted(set(functions(text)), key=lambda f: f[1]):
        found.add(name)
        reason = exception(name)
        if reason:
            left.append((name, reason))
            continue
        try:
            parameters = [classify(p, name, known, callbacks, records) for p in split(rest)]
        except Unknown as unknown:
            errors.append(f'{name}: what is {unknown}?')
            continue
        answer = ('OTHER', 0) if name in NOT_KEPT else classify_result(result, known)
        lines.append(thunk(name, answer, parameters))
        kinds = ', '.join(f'{{FUZZ_{p[0]}, {int(p[1])}, {p[2]}, {int(p[3])}}}' for p in parameters) or '{FUZZ_NOTHING, 0, 0, 0}'
        entries.append(f'    {{"{name}", call_{name}, FUZZ_{answer[0]}, {answer[1]}, {weight(name)}, {len(parameters)}, {{{kinds}}}}},')
    errors += [f'no function is an exception by {pattern}' for pattern, _ in EXCEPTIONS if not any(re.match(pattern, f) for f in found)]
    errors += [f'there is no {name}' for name in LIMITS if name not in found]
    lines += ['const FuzzFunction fuzzFunctions[] = {', *entries, '};',
              f'const int fuzzFunctionCount = {len(entries)};', f'const int fuzzPoolCount = {len(HANDLES)};',
              'const char *const fuzzPoolNames[] = {' + ', '.join(f'"{h.lstrip("_")}"' for h in HANDLES) + '};',
              'const int fuzzPoolIsConstraint[] = {' + ', '.join(str(int(h in CONSTRAINTS)) for h in HANDLES) + '};',
              'const char *const fuzzExceptions[][2] = {', *(f'    {{"{n}", "{r}"}},' for n, r in left), '    {0, 0}', '};', '']
    if errors:
        sys.exit('\n'.join(errors))
    output.write_text('\n'.join(lines), encoding='utf-8')


if __name__ == '__main__':
    main()
