#!/usr/bin/env python3
"""check_joints.py SOURCE - has every joint the functions of all constraints under its own name, written out and alike?

They are functions that each joint's header declares, and no macros, so that editors, search and Doxygen find them, and
that what they say names them (mdt_named.c). What is missing is printed as it is to be written.
"""
import pathlib
import re
import sys

INDEX = 'const unsigned int bodyindex'
XYZ = 'const MeReal x, const MeReal y, const MeReal z'
TWO = 'const MeReal px, const MeReal py, const MeReal pz, const MeReal ox, const MeReal oy, const MeReal oz'
FUNCTIONS = {  # result, name, parameters after the handle
    'common': [
        ('void', 'Destroy', ''), ('void', 'Enable', ''), ('void', 'Disable', ''), ('MeBool', 'IsEnabled', ''),
        ('void', 'SetBodies', 'const MdtBodyID b1, const MdtBodyID b2'), ('MdtBodyID', 'GetBody', INDEX),
        ('void', 'GetForce', INDEX + ', MeVector3 force'), ('void', 'GetTorque', INDEX + ', MeVector3 torque'),
        ('MdtWorldID', 'GetWorld', ''), ('void', 'SetUserData', 'void *data'), ('void *', 'GetUserData', ''),
        ('void', 'SetSortKey', 'const MeI32 key'), ('MeI32', 'GetSortKey', '')],
    'position': [('void', 'SetPosition', XYZ), ('void', 'GetPosition', 'MeVector3 position')],
    'axis': [('void', 'SetAxis', XYZ), ('void', 'GetAxis', 'MeVector3 axis')],
    'axes': [('void', 'SetAxes', TWO)],
    'body axes': [('void', 'BodySetAxes', f'{INDEX}, {TWO}'),
                  ('void', 'BodyGetAxes', INDEX + ', MeVector3 primary, MeVector3 ortho')],
}
JOINTS = {
    'Angular3': ('axis',), 'BSJoint': ('position',), 'CarWheel': ('position',),
    'ConeLimit': ('position', 'axis', 'axes', 'body axes'), 'Contact': (), 'ContactGroup': (), 'FPFOJoint': (),
    'FixedPath': (), 'Gear': ('axis',), 'Hinge': ('position', 'axis'), 'Linear1': ('position', 'axis'), 'Linear2': ('position',),
    'Mimic': (), 'Prismatic': ('axis',), 'Pulley': (), 'RPROJoint': (), 'Skeletal': ('position', 'axes', 'body axes'), 'Spring': (),
    'Spring6': ('position', 'axes'), 'Universal': ('position', 'axes'), 'UserConstraint': (),
}


def functions(joint, group):
    for result, name, parameters in FUNCTIONS[group]:
        yield f'MEPUBLIC {result} MEAPI Mdt{joint}{name}(const Mdt{joint}ID j{", " * bool(parameters)}{parameters});\n'.replace('* MEAPI', '*MEAPI')


def packed(text):
    return re.sub(r'\s+', ' ', text)


def main():
    include = pathlib.Path(sys.argv[1]) / 'Mdt' / 'include'
    declared = {path.stem.removeprefix('Mdt') for path in include.glob('*.h')
                if re.search(r'QuaConstraint\(const Mdt', path.read_text())}
    wrong = [f'{name} is not in the table of check_joints.py' for name in sorted(declared - set(JOINTS))]
    for joint, groups in JOINTS.items():
        text = packed((include / f'Mdt{joint}.h').read_text())
        wrong += [f'Mdt{joint}.h lacks\n{function}' for group in ('common', *groups) for function in functions(joint, group)
                  if packed(function) not in text]
    print(*(wrong[:10] or [f'{len(JOINTS)} joints have the functions of all constraints']), sep='\n')
    return bool(wrong)


if __name__ == '__main__':
    sys.exit(main())
