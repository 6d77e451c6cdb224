/* Joints that are accepted and make no sense: 30 bodies and 150 joints of any kind between any two of them, with any
 * axes and stops, some of which are overrun at the start. A step of them may not take long, leave the finite numbers or
 * give energy.
 *
 *     test_Mdt_RandomJoints                              SYSTEMS systems, about a second (fewer with sanitizers)
 *     KARMA_RANDOM_SYSTEMS=10000 test_Mdt_RandomJoints   so many
 */
#include "scene.h"
#include "random_numbers.h"

#ifdef TEST_IS_SLOW
enum { SYSTEMS = 2 };
#else
enum { SYSTEMS = 20 };
#endif
enum { BODIES = 30, JOINTS = 150, STEPS = 4 };

enum { BUDGET = 30 }; /* millions of multiplications */

static int running; /* the number of the one that runs */
static MdtWorldID world;
static MdtBodyID body[BODIES];

static void makeBodies(void) {
    for (int i = 0; i < BODIES; i++) {
        const double edge[3] = {uniform(.2, 1), uniform(.2, 1), uniform(.2, 1)};
        body[i] = scene_box(world, exp(uniform(-2, 2)), edge, uniform(-2, 2), uniform(-2, 2), uniform(-2, 2));
        MdtBodySetQuaternion(body[i], uniform(.1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        MdtBodySetLinearVelocity(body[i], uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        MdtBodySetAngularVelocity(body[i], uniform(-2, 2), uniform(-2, 2), uniform(-2, 2));
    }
}

/* Rigid stops: a spring would store energy. */
static void addStops(MdtLimitID limit) {
    const double lower = uniform(-1, .5);
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(limit), lower);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(limit), (lower + uniform(0, 1)));
    MdtLimitActivateLimits(limit, METRUE);
}

static MdtConstraintID makeJoint(MdtBodyID a, MdtBodyID b) {
    MdtConstraintID c;
    switch (below(8)) {
    case 0:
        c = MdtHingeQuaConstraint(MdtHingeCreate(world));
        break;
    case 1:
        c = MdtPrismaticQuaConstraint(MdtPrismaticCreate(world));
        break;
    case 2:
        c = MdtUniversalQuaConstraint(MdtUniversalCreate(world));
        break;
    case 3:
        c = MdtAngular3QuaConstraint(MdtAngular3Create(world));
        break;
    case 4:
        c = MdtLinear1QuaConstraint(MdtLinear1Create(world));
        break;
    case 5:
        c = MdtLinear2QuaConstraint(MdtLinear2Create(world));
        break;
    case 6:
        c = MdtConeLimitQuaConstraint(MdtConeLimitCreate(world));
        break;
    default:
        c = MdtBSJointQuaConstraint(MdtBSJointCreate(world));
        break;
    }
    MdtConstraintSetBodies(c, a, b);
    MdtConstraintSetPosition(c, uniform(-2, 2), uniform(-2, 2), uniform(-2, 2));
    MdtConstraintSetAxis(c, uniform(-1, 1), uniform(-1, 1), uniform(.1, 1));
    return c;
}

static void makeJoints(void) {
    for (int i = 0; i < JOINTS; i++) {
        const int a = below(BODIES), b = below(BODIES + 1);
        const MdtConstraintID c = makeJoint(body[a], b == a || b == BODIES ? 0 : body[b]);
        const MdtHingeID hinge = MdtConstraintDCastHinge(c);
        const MdtPrismaticID slider = MdtConstraintDCastPrismatic(c);
        const MdtConeLimitID cone = MdtConstraintDCastConeLimit(c);
        if (hinge)
            addStops(MdtHingeGetLimit(hinge));
        if (slider)
            addStops(MdtPrismaticGetLimit(slider));
        if (cone)
            MdtConeLimitSetConeHalfAngle(cone, uniform(0, 2));
        MdtConstraintEnable(c);
    }
}

/* J */
static double kineticEnergy(void) {
    double sum = 0;
    for (int i = 0; i < BODIES; i++) {
        MeVector3 v, w, x;
        MdtBodyGetLinearVelocity(body[i], v);
        MdtBodyGetAngularVelocity(body[i], w);
        MdtBodyGetPosition(body[i], x);
        for (int k = 0; k < 3; k++)
            ck_assert_msg(isfinite(x[k]) && isfinite(v[k]) && isfinite(w[k]),
                          "a body of system %d leaves the finite numbers", running);
        sum += (double)MdtBodyGetKineticEnergy(body[i]);
    }
    return sum;
}

typedef struct Max {
    double value;
    int system;
} Max;

typedef struct Worst {
    Max work;    /* millions, in a step */
    Max growth;  /* of the kinetic energy, gravity's work apart, of what there was */
    int limited; /* steps */
} Worst;

static void note(Max *max, double value) {
    if (value > max->value)
        *max = (Max){value, running};
}

static double heightOfEnergy(void) {
    double sum = 0;
    for (int i = 0; i < BODIES; i++) {
        MeVector3 x;
        MdtBodyGetCenterOfMassPosition(body[i], x);
        sum += (double)MdtBodyGetMass(body[i]) * 10 * (double)x[1];
    }
    return sum;
}

static void runSystem(int number, Worst *worst) {
    running = number;
    state = 1000003ULL * (unsigned long long)number + 17;
    world = scene_open(BODIES, JOINTS, 10);
    MdtWorldSetWorkBudget(world, BUDGET);
    MdtWorldEnableReport(world);
    makeBodies();
    makeJoints();
    const double start = kineticEnergy();
    double height = heightOfEnergy();
    for (int k = 0; k < STEPS; k++) {
        MdtReport r;
        MdtWorldStep(world, FRAME);
        ck_assert(MdtWorldGetReport(world, &r));
        const double fallen = fmax(height - heightOfEnergy(), 0);
        note(&worst->work, (double)r.work);
        note(&worst->growth, (kineticEnergy() - fallen) / start);
        worst->limited += r.limited > 0;
        ck_assert((r.limited > 0) <= (r.fallbacks > 0 && r.way == MdtReportWayLimited));
    }
    MdtWorldDestroy(world);
}

TEST(random_joints_end_their_steps_and_give_no_energy) {
    const char *wanted = getenv("KARMA_RANDOM_SYSTEMS");
    const int systems = wanted ? atoi(wanted) : SYSTEMS;
    Worst worst = {0};
    for (int i = 0; i < systems; i++)
        runSystem(i, &worst);
    printf("%d systems: at most %.3g millions of multiplications (system %d), energy times %.9g (system %d), "
           "%d steps limited\n",
           systems, worst.work.value, worst.work.system, worst.growth.value, worst.growth.system, worst.limited);
    assert_below(worst.work.value, 1.1 * BUDGET); /* the last answer is given in any case */
    assert_below(worst.growth.value, 1 + TOL(4e-6, 5e-9));
    ck_assert(worst.limited > 0 || systems < 20); /* some of twenty ask for more than there is */
    messages_forget();
}
