#!/usr/bin/env python3
"""messages.py SOURCE OUTPUT LIBRARY... - writes calls of every public function with bad input, as C, for test_messages.c.

The functions are those that the public headers of these
libraries declare, and those macros that the table of the original's interface has as
functions. Each is called in four ways: NOTHING, all of it zero; DEAD, the same of a joint that has been destroyed; HALF, the first
handle a live one, numbers NaN, the rest zero; NUMBERS, all handles live ones, numbers NaN, integers -1. Live ones are
those that test_messages.c has a LIVE_type of. Of a handle that is null or dead, results and vectors are to be 0.
"""
import importlib.machinery
import importlib.util
import pathlib
import re
import sys

REALS = {'MeReal', 'float', 'double', 'AcmeReal'}
VECTORS = {'MeVector3', 'MeVector4'}
INTEGERS = {'int', 'unsigned', 'unsigned int', 'long', 'unsigned long', 'short', 'char', 'unsigned char', 'size_t', 'MeI32', 'MeU32', 'MeI16',
            'MeU16', 'MeI8', 'MeU8', 'MeBool', 'McdGeometryType', 'MstMaterialID'}


def table(source):
    """tools/api-coverage, which reads tests/api/functions.tsv."""
    path = source / 'tools/api-coverage'
    spec = importlib.util.spec_from_loader('coverage', importlib.machinery.SourceFileLoader('coverage', str(path)))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def without_comments(text):
    return re.sub(r'//.*', '', re.sub(r'/\*.*?\*/', ' ', text, flags=re.S))


def declared(header):
    """(result, name, parameters) of a header's functions."""
    text = without_comments(header.read_text(encoding='utf-8'))
    text = re.sub(r'ME_PRINTF_LIKE\(.*?\)', '', text)
    for result, name, rest in re.findall(r'MEPUBLIC\s+([^;{}()]+?)\bMEAPI(?:_CDECL)?\s*\(?(\w+)\)?\s*\((.*?)\)\s*;', text, re.S):
        yield result.strip(), name, ' '.join(rest.split())
    for result, name, rest in re.findall(r'^static inline ([\w ]+[ *])(\w+)\(([^{};]*?)\)\s*\{', text, re.S | re.M):
        yield result.strip(), name, ' '.join(rest.split())


def macros(header):
    text = without_comments(header.read_text(encoding='utf-8'))
    return set(re.findall(r'^#define (\w+)\(', text, re.M))


def kind(parameter):
    """The type without const and the parameter's name; None for what is no plain type."""
    if re.search(r'\(|\[', parameter):
        return None
    words = [w for w in re.findall(r'\w+|\*', parameter) if w not in ('const', 'struct', 'enum', 'register')]
    if '*' in words:
        return None if words.count('*') > 1 else words[0] + '_pointer'
    return ' '.join(words[:-1]) if len(words) > 1 else words[0]


def arguments(parameters, way, live):
    given, handles = [], 0
    for parameter in parameters:
        if parameter == '...':
            continue
        what = kind(parameter)
        if what in live and (way == 'NUMBERS' or (way in ('DEAD', 'HALF') and handles == 0)):
            given.append(f'LIVE_{what}')
        elif what in REALS:
            given.append('0' if way in ('NOTHING', 'DEAD') else f'({what})NAN')
        elif what in INTEGERS and way == 'NUMBERS':
            given.append(f'({what})-1')
        else:
            given.append('0')
        handles += what in live
    return given, handles


def asking(name, parameters, result, call):
    """Lines of a call that notes whether its result, and what it writes to vectors, is 0."""
    given = re.match(r'\w+\((.*)\)$', call).group(1).split(', ')
    lines, checks = [], []
    for i, parameter in enumerate(p for p in parameters if p != '...'):
        if kind(parameter) in VECTORS and 'const' not in parameter:
            lines.append(f'    {kind(parameter)} v{i};\n    memset(v{i}, 7, sizeof v{i});')
            checks.append(f'    noteZero(v{i}, sizeof v{i});')
            given[i] = f'v{i}'
    call = f'{name}({", ".join(given)})'
    if result == 'void':
        return lines + [f'    {call};'] + checks
    return lines + [f'    const __typeof__({call}) result = {call};', '    noteZero(&result, sizeof result);'] + checks


def main():
    source, output = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    test = (source / 'tests/api/test_messages.c').read_text(encoding='utf-8')
    live = set(re.findall(r'^#define LIVE_(\w+)', test, re.M))
    joints = {f'Mdt{name}ID' for name in re.findall(r'^ +DO\((\w+)\)', test, re.M)}
    leave = set(re.findall(r'^ +LEAVE\((\w+)', test, re.M))
    coverage = table(source)
    found, results, headers = {}, {}, []
    for library in sys.argv[3:]:
        for header in sorted((source / library / 'include').glob('*.h')):
            if header.name in ('MdtInternal.h', 'MeInternal.h', 'McdInternal.h', 'MeTeam.h', 'KarmaClassic.h') or header.stem in leave:
                continue
            headers.append(header)
            for result, name, rest in declared(header):
                found.setdefault(name, coverage.split_parameters(rest))
                results.setdefault(name, result)
    written = set().union(*(macros(header) for header in headers))
    for row in coverage.read_rows():
        if row.name in written and row.name not in found and 'function' in row.kind and row.parameters:
            found[row.name] = coverage.split_parameters(row.parameters)
    unknown = leave - set(found) - {h.stem for h in headers}
    lines = [f'#include "{header.name}"' for header in headers] + ['']
    entries = []
    for name, parameters in sorted(found.items()):
        if name in leave:
            continue
        ways = []
        for way in ('NOTHING', 'DEAD', 'HALF', 'NUMBERS'):
            if way == 'DEAD' and (not parameters or kind(parameters[0]) not in joints):
                continue
            given, handles = arguments(parameters, way, live)
            if way != 'NOTHING' and not handles:
                continue
            call = f'{name}({", ".join(given)})'
            if call not in [c for w, c in ways if w != 'DEAD'] and parameters:
                ways.append((way, call))
        for way, call in ways:
            lines.append(f'static void {name}_{way}(void) {{')
            lines += asking(name, parameters, results.get(name, 'void'), call) if way in ('NOTHING', 'DEAD') else [f'    {call};']
            lines.append('}')
            needs = way == 'DEAD' or way == 'NOTHING' and (kind(parameters[0]) if parameters else '') in live
            entries.append(f'    {{"{name}", {way}, {name}_{way}, {int(needs)}}},')
    lines += ['', 'static const Call calls[] = {', *entries, '};', '']
    output.write_text('\n'.join(lines), encoding='utf-8')


if __name__ == '__main__':
    main()
