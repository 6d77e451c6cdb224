#!/usr/bin/env python3
"""check_defaults.py SOURCE - is each default that a page of the manual names read by a program of the manual?

A table may have a column "default". Its rows name setters, or members of parameters. docs.manual compares what programs print with
the pages; so a default is checked if a program calls the getter of its setter (MdtBodySetMass: MdtBodyGetMass, or one of GETTERS), or
reads the member. `..Tail` after a setter is one of the same object with another end. EXCEPTIONS have no getter.
"""
import pathlib
import re
import sys

PAGES = ('manual bodies shapes joints contacts moving terrain queries events sleep continuous accuracy debugging troubleshooting limits '
         'migration').split()
EXCEPTIONS = {
    'MdtBSJointSetPositionMotor': 'no getter: a test of joints sees that a new one does not drive',
    'MdtSkeletalSetPositionMotor': 'no getter, likewise',
    'MdtSpring6SetLinearMotor': 'no getter, likewise',
    'MdtSpring6..AngularMotor': 'no getter, likewise',
    'MdtCarWheelSetSteeringPositionMotor': 'no getter, likewise',
    'MdtMimicSetJoints': 'the row says which joints are legal',
    'McdSpaceSetModelCullingParameters': 'no getter',
    'filter': 'a pointer', 'filterData': 'a pointer', 'up': 'a direction, from gravity', 'forward': 'a direction',
    'position': 'where a wheel is: the program must set it',
    'constraint': 'an argument', 'lower': 'of a row, in a callback', 'upper': 'likewise',
    'stiffness': '0: not used', 'torque': 'a curve', 'across': 'as along',
}
GETTERS = {  # of setters whose getter has another name
    'MdtBodyEnable': 'MdtBodyIsEnabled', 'MdtBodySetKinematic': 'MdtBodyIsKinematic',
    'MdtBodyDisableNonSphericalInertia': 'MdtBodyNonSphericalInertiaIsEnabled',
    'MdtBodyDisableCoriolisForce': 'MdtBodyCoriolisForceIsEnabled',
    'MdtConstraintSetBreakLimits': 'MdtConstraintGetBreakForce',
    'MdtLimitActivateLimits': 'MdtLimitIsActive', 'MdtLimitSetLimitedForceMotor': 'MdtLimitGetMotorMaxForce',
    'MdtLimitSetPositionMotor': 'MdtLimitGetMotorFrequency', 'MdtLimitSetMotorTracking': 'MdtLimitMotorIsTracking',
    'MdtLimitSetLock': 'MdtLimitIsLocked', 'MdtLimitCalculatePosition': 'MdtLimitPositionIsCalculated',
    'MdtSkeletalSetAxes': 'MdtSkeletalBodyGetAxes', 'MdtConeLimitBodySetAxes': 'MdtConeLimitGetAxis',
    'MdtConeLimitSetAxes': 'MdtConeLimitGetAxis', 'MdtUniversalSetAxes': 'MdtUniversalGetAxis',
    'MdtAngular3EnableRotation': 'MdtAngular3RotationIsEnabled',
    'MdtSpringSetNaturalLength': 'MdtSpringGetLimit', 'MdtSpringSetStiffness': 'MdtSpringGetLimit',
    'MdtSpringSetDamping': 'MdtSpringGetLimit',
    'MdtCarWheelSetSteeringLock': 'MdtCarWheelIsSteeringLocked',
    'MdtCarWheelSetSteeringLimitedForceMotor': 'MdtCarWheelGetSteeringMotorMaxForce',
    'MdtCarWheelSetHingeLimitedForceMotor': 'MdtCarWheelGetHingeMotorMaxForce',
    'MdtCarWheelSetSuspension': 'MdtCarWheelGetSuspensionKp',
    'MdtGearSetTeeth': 'MdtGearGetRatio', 'MdtGearSetRack': 'MdtGearGetRatio', 'MdtGearBodySetAxis': 'MdtGearGetAxis',
    'MdtContactParamsSetFrictionModel': 'MdtContactParamsGetPrimaryFrictionModel',
    'MdtContactParamsSetFriction': 'MdtContactParamsGetPrimaryFriction',
    'MdtContactParamsSetFrictionCoeffecient': 'MdtContactParamsGetPrimaryFrictionCoeffecient',
    'MdtContactParamsSetSlip': 'MdtContactParamsGetPrimarySlip',
    'McdModelSetFilter': 'McdModelGetFilterMask', 'McdModelSetSensor': 'McdModelIsSensor', 'McdSpaceDisablePair': 'McdSpacePairIsEnabled',
    'McdSpaceEnablePair': 'McdSpacePairIsEnabled', 'MstSensorSetMask': 'MstSensorGetMask',
}
SETTER = re.compile(r'(M[a-z]{2}\w+?)(BodySet|Set|Enable|Disable|Activate|Calculate)(\w*)$')


def rows(text):
    """(number of the line, cells of a row, its default), of tables with a column of defaults."""
    header = None
    for number, line in enumerate(text.splitlines(), 1):
        cells = [cell.strip() for cell in line.strip('|').split('|')]
        if not line.startswith('|'):
            header = None
        elif header is None:
            header = cells
        elif not set(line) <= set('|-: '):
            column = next((i for i, name in enumerate(header) if name.startswith('default')), None)
            if column is not None and column < len(cells):
                yield number, cells[:column] + cells[column + 1:], cells[column]


def wanted(cells):
    """(what the row names, pattern of what a program has to contain)."""
    prefix = None
    for name in re.findall(r'`([^`]+)`', ' '.join(cells)):
        name = re.sub(r'\(.*', '', name)
        setter = SETTER.match(name)
        if setter:
            prefix = setter[1]
            yield name, rf'\b{GETTERS.get(name) or setter[1] + setter[2].replace("Set", "Get") + setter[3]}\('
        elif name.startswith('..') and prefix:
            yield f'{prefix}{name}', rf'\b{prefix}\w*Get\w*{re.sub("^Set", "", name.strip("."))}\w*\('
        elif re.fullmatch(r'[a-z]\w+', name):
            yield name, rf'[.>]{name}\b'


def main(top):
    text = {page: (top / 'docs' / f'{page}.md').read_text() for page in PAGES}
    programs = '\n'.join(block for page in text.values() for block in re.findall(r'^```c\n(.*?)^```$', page, re.DOTALL | re.MULTILINE))
    count, wrong, used = 0, [], set()
    for page in PAGES:
        for number, cells, default in rows(text[page]):
            if not default or default.startswith('['):
                continue
            named = list(wanted(cells))
            count += 1
            used |= {name for name, _ in named}
            if not named:
                wrong.append(f'{page}.md:{number}: the row names neither a setter nor a member: {cells[0]}')
            wrong += [f'{page}.md:{number}: no program reads the default of {name}' for name, pattern in named
                      if name not in EXCEPTIONS and not re.search(pattern, programs)]
    wrong += [f'no row names {name} any more: check_defaults.py' for name in sorted((EXCEPTIONS.keys() | GETTERS.keys()) - used)]
    print(*(wrong or [f'{count} rows of defaults are read by programs']), sep='\n')
    return bool(wrong) or count < 100


if __name__ == '__main__':
    sys.exit(main(pathlib.Path(sys.argv[1])))
