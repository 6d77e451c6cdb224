/* Random scenes of bodies tied by joints of all kinds that do not fit: whatever happens, every body stays finite.
 * Scenes that fit are those of test_RandomScenes.c. */
#include "scene.h"
#include "random_numbers.h"

enum { BODIES = 6, JOINTS = 8 };

/* One number after the other: the order in which a compiler evaluates arguments is its own. */
static void vector(MeReal v[3], double size) {
    for (int i = 0; i < 3; i++)
        v[i] = (MeReal)uniform(-size, size);
}

static int pick(int n) {
    return (int)uniform(0, n);
}

static MdtConstraintID makeJoint(MdtWorldID w, int kind) {
    switch (kind) {
    case 0:
        return MdtBSJointQuaConstraint(MdtBSJointCreate(w));
    case 1:
        return MdtHingeQuaConstraint(MdtHingeCreate(w));
    case 2:
        return MdtPrismaticQuaConstraint(MdtPrismaticCreate(w));
    case 3:
        return MdtUniversalQuaConstraint(MdtUniversalCreate(w));
    case 4:
        return MdtAngular3QuaConstraint(MdtAngular3Create(w));
    case 5:
        return MdtCarWheelQuaConstraint(MdtCarWheelCreate(w));
    case 6:
        return MdtLinear1QuaConstraint(MdtLinear1Create(w));
    case 7:
        return MdtLinear2QuaConstraint(MdtLinear2Create(w));
    case 8:
        return MdtFixedPathQuaConstraint(MdtFixedPathCreate(w));
    case 9:
        return MdtRPROJointQuaConstraint(MdtRPROJointCreate(w));
    case 10:
        return MdtSpringQuaConstraint(MdtSpringCreate(w));
    case 11:
        return MdtSpring6QuaConstraint(MdtSpring6Create(w));
    case 12:
        return MdtConeLimitQuaConstraint(MdtConeLimitCreate(w));
    case 13:
        return MdtSkeletalQuaConstraint(MdtSkeletalCreate(w));
    default:
        return MdtFPFOJointQuaConstraint(MdtFPFOJointCreate(w));
    }
}

enum { KINDS = 15 };

static void setUp(MdtConstraintID c) {
    MdtHingeID hinge = MdtConstraintDCastHinge(c);
    MdtPrismaticID slider = MdtConstraintDCastPrismatic(c);
    MdtSpring6ID springs = MdtConstraintDCastSpring6(c);
    MdtConeLimitID cone = MdtConstraintDCastConeLimit(c);
    MdtCarWheelID wheel = MdtConstraintDCastCarWheel(c);
    if (hinge || slider) {
        MdtLimitID limit = hinge ? MdtHingeGetLimit(hinge) : MdtPrismaticGetLimit(slider);
        MdtSingleLimitID low = MdtLimitGetLowerLimit(limit), high = MdtLimitGetUpperLimit(limit);
        MdtSingleLimitSetStop(low, uniform(-1, 0));
        MdtSingleLimitSetStop(high, uniform(0, 1));
        MdtSingleLimitSetRestitution(low, uniform(0, 1));
        MdtSingleLimitSetStiffness(high, uniform(0, 1e4));
        MdtLimitActivateLimits(limit, pick(2));
    }
    if (springs)
        for (int i = 0; i < 3; i++) {
            MdtSpring6SetLinearStiffness(springs, i, uniform(0, 1e5));
            MdtSpring6SetAngularStiffness(springs, i, uniform(0, 1e4));
            MdtSpring6SetLinearDamping(springs, i, uniform(0, 10));
        }
    if (cone)
        MdtConeLimitSetConeHalfAngle(cone, uniform(0, 3));
    if (wheel) {
        const double kp = uniform(0, 1e5), kd = uniform(0, 100), softness = uniform(0, .01);
        MdtCarWheelSetSuspension(wheel, kp, kd, softness, -.3, .3, 0);
    }
}

static MdtWorldID makeScene(unsigned long long number, MdtBodyID body[BODIES]) {
    state = number * 7919 + 17;
    MdtWorldID w = scene_open(BODIES, JOINTS, 0);
    MdtWorldSetEpsilon(w, pick(2) ? 0 : (MeReal)1e-4);
    for (int i = 0; i < BODIES; i++) {
        MeReal at[3], turn[3], v[3], spin[3];
        double edge[3];
        for (int k = 0; k < 3; k++)
            edge[k] = uniform(.2, 2);
        const double mass = pow(10, uniform(-2, 3));
        vector(at, 3);
        vector(turn, 1);
        vector(v, 3);
        vector(spin, 5);
        body[i] = scene_box(w, mass, edge, at[0], at[1], at[2]);
        MdtBodySetQuaternion(body[i], 1, turn[0], turn[1], turn[2]);
        MdtBodySetAngularVelocity(body[i], spin[0], spin[1], spin[2]);
        MdtBodySetLinearVelocity(body[i], v[0], v[1], v[2]);
    }
    for (int i = 0; i < JOINTS; i++) {
        const int a = pick(BODIES), b = pick(BODIES);
        MdtConstraintID c = makeJoint(w, pick(KINDS));
        MdtConstraintSetBodies(c, body[a], a == b ? 0 : body[b]);
        setUp(c);
        MdtConstraintEnable(c);
    }
    return w;
}

static double energyOf(MdtBodyID body[BODIES]) {
    double sum = 0;
    for (int i = 0; i < BODIES; i++)
        sum += MdtBodyGetKineticEnergy(body[i]);
    return sum;
}

static MeBool isFiniteScene(MdtBodyID body[BODIES]) {
    for (int i = 0; i < BODIES; i++) {
        MeReal *tm = &MdtBodyGetTransformPtr(body[i])[0][0];
        for (int k = 0; k < 16; k++)
            if (!isfinite(tm[k]))
                return MEFALSE;
    }
    return isfinite(energyOf(body));
}

TEST(scenes_that_do_not_fit_stay_finite) {
    MdtBodyID body[BODIES];
    for (unsigned long long n = 0; n < 20; n++) {
        MdtWorldID w = makeScene(n, body);
        for (int i = 0; i < 40; i++) {
            MdtWorldStep(w, FRAME);
            ck_assert_msg(isFiniteScene(body), "scene %llu is not finite after %d steps", n, i + 1);
        }
        MdtWorldDestroy(w);
    }
    messages_forget(); /* degenerate joints warn */
}
