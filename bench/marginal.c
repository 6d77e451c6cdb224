/* What one more of something costs a step of 1/60 s, in the precision of the build: as CSV, ns.
 *
 * Two universes with FEW and MANY of it are stepped in turn; the difference of their CPU times over the difference of
 * the numbers is the marginal cost. The cost of a joint or a contact includes that of the body it belongs to, which the
 * first lines tell. Nothing is put to rest but what is said to sleep. All are measured in turns, 15 times, so that a
 * machine that is slow for a while is so for all of them; with --quick once. */
#include "timing.h"

#include "Mst.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { FEW = 100, MANY = 300, WARM = 20, STEPS = 100, RUNS = 15 };

static const double spacing = 4; /* m: units do not meet */

typedef struct Case {
    const char *what;
    void (*add)(MstUniverseID u, double x); /* one unit */
    double push;                            /* N on every body, sideways */
    MdtFrictionModel friction;
    bool sleeps;
} Case;

static MdtBodyID addBody(MstUniverseID u, double x) {
    const MdtBodyID b = MdtBodyCreate(u->world);
    MdtBodySetPosition(b, (MeReal)x, 10, 0);
    MdtBodyEnable(b);
    return b;
}

static void addFlying(MstUniverseID u, double x) {
    addBody(u, x);
}

static void addJoint(MstUniverseID u, MdtConstraintID j, double x) {
    MdtConstraintSetBodies(j, addBody(u, x), 0);
    MdtConstraintSetPosition(j, (MeReal)(x - .5), 10, 0);
    MdtConstraintSetAxis(j, 0, 0, 1);
    MdtConstraintEnable(j);
}

static void addBall(MstUniverseID u, double x) {
    addJoint(u, MdtBSJointQuaConstraint(MdtBSJointCreate(u->world)), x);
}

static MdtHingeID addHinge(MstUniverseID u, double x) {
    const MdtHingeID j = MdtHingeCreate(u->world);
    addJoint(u, MdtHingeQuaConstraint(j), x);
    return j;
}

static void addPlainHinge(MstUniverseID u, double x) {
    addHinge(u, x);
}

static void addMotor(MstUniverseID u, double x) {
    const MdtLimitID limit = MdtHingeGetLimit(addHinge(u, x));
    MdtLimitSetLimitedForceMotor(limit, 3, 100);
    MdtLimitActivateMotor(limit, METRUE);
}

/* It hangs in its stop from the first step on. */
static void addLimit(MstUniverseID u, double x) {
    const MdtLimitID limit = MdtHingeGetLimit(addHinge(u, x));
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(limit), 0);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(limit), 0);
    MdtLimitActivateLimits(limit, METRUE);
}

static void addPrismatic(MstUniverseID u, double x) {
    const MdtPrismaticID j = MdtPrismaticCreate(u->world);
    addJoint(u, MdtPrismaticQuaConstraint(j), x);
}

static void addLinear1(MstUniverseID u, double x) {
    addJoint(u, MdtLinear1QuaConstraint(MdtLinear1Create(u->world)), x);
}

static void addShape(MstUniverseID u, McdGeometryID g, double x) {
    const McdModelID m = MstModelAndBodyCreate(u, g, 1);
    McdModelDynamicsSetPosition(m, (MeReal)x, (MeReal).5, 0);
    MdtBodyEnable(McdModelGetBody(m));
}

static void addBox(MstUniverseID u, double x) {
    addShape(u, McdBoxCreate(u->frame, 1, 1, 1), x);
}

static void addSphere(MstUniverseID u, double x) {
    addShape(u, McdSphereCreate(u->frame, (MeReal).5), x);
}

static void addSleeping(MstUniverseID u, double x) {
    addBox(u, x);
}

/* Boxes of 1 kg slide, so that no step can be left out; .6 of their weight overcomes friction .5. */
static const Case cases[] = {
    {"body that flies", addFlying, 0, MdtFrictionModelCone, false},
    {"body on a ball joint", addBall, 0, MdtFrictionModelCone, false},
    {"body on a hinge", addPlainHinge, 0, MdtFrictionModelCone, false},
    {"body on a hinge at its stop", addLimit, 0, MdtFrictionModelCone, false},
    {"body on a hinge with a motor", addMotor, 0, MdtFrictionModelCone, false},
    {"body on a prismatic joint", addPrismatic, 0, MdtFrictionModelCone, false},
    {"body in a plane (linear 1)", addLinear1, 0, MdtFrictionModelCone, false},
    {"sphere that rolls, one contact, cone", addSphere, 1, MdtFrictionModelCone, false},
    {"box that slides, four contacts, no friction", addBox, 1, MdtFrictionModelUnknown, false},
    {"box that slides, four contacts, box friction", addBox, 6, MdtFrictionModelBox, false},
    {"box that slides, four contacts, normal force", addBox, 6, MdtFrictionModelNormalForce, false},
    {"box that slides, four contacts, cone", addBox, 6, MdtFrictionModelCone, false},
    {"box that sleeps", addSleeping, 0, MdtFrictionModelCone, true},
};

enum { NUM_CASES = sizeof cases / sizeof *cases };

static void setFriction(MdtContactParamsID p, MdtFrictionModel model) {
    if (model == MdtFrictionModelUnknown)
        return;
    MdtContactParamsSetType(p, MdtContactTypeFriction2D);
    MdtContactParamsSetFrictionModel(p, model);
    MdtContactParamsSetFriction(p, (MeReal)1.2); /* N, of the box model, at each of four contacts */
    MdtContactParamsSetFrictionCoeffecient(p, (MeReal).5);
}

static MstUniverseID make(const Case *c, int n) {
    static MeMatrix4 floorTM = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    const MstUniverseID u = MstUniverseCreate(&MstUniverseGrowingSizes);
    if (!u)
        abort();
    MdtWorldSetGravity(u->world, 0, (MeReal)-9.81, 0);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    setFriction(MstBridgeGetContactParams(u->bridge, 0, 0), c->friction);
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), floorTM);
    for (int i = 0; i < n; i++)
        c->add(u, spacing * (i - n / 2));
    for (MdtBodyID b = MdtBodyGetFirst(u->world); b; b = MdtBodyGetNext(b))
        MdtBodySetMass(b, 1);
    return u;
}

static void step(const Case *c, MstUniverseID u) {
    if (c->push > 0)
        for (MdtBodyID b = MdtBodyGetFirst(u->world); b; b = MdtBodyGetNext(b))
            MdtBodyAddForce(b, 0, 0, (MeReal)c->push);
    MstUniverseStep(u, (MeReal)(1. / 60));
}

static double timed(const Case *c, MstUniverseID u) {
    const double start = cpuTime();
    step(c, u);
    return cpuTime() - start;
}

/* ns, of one more. The median step of each: what interrupts some does not count. */
static double costOnce(const Case *c) {
    const MstUniverseID few = make(c, FEW), many = make(c, MANY);
    double timesFew[STEPS], timesMany[STEPS];
    for (int i = 0; i < WARM; i++) {
        step(c, few);
        step(c, many);
    }
    if (c->sleeps) {
        MdtWorldSetAutoDisable(few->world, METRUE);
        MdtWorldSetAutoDisable(many->world, METRUE);
        for (int i = 0; i < STEPS; i++) {
            step(c, few);
            step(c, many);
        }
    }
    for (int i = 0; i < STEPS; i++) {
        timesFew[i] = timed(c, few);
        timesMany[i] = timed(c, many);
    }
    MstUniverseDestroy(few);
    MstUniverseDestroy(many);
    return 1e9 * (median(timesMany, STEPS) - median(timesFew, STEPS)) / (MANY - FEW);
}

int main(int argc, char *argv[]) {
    const int runs = argc > 1 && strcmp(argv[1], "--quick") == 0 ? 1 : RUNS;
    double costs[NUM_CASES][RUNS];
    for (int run = 0; run < runs; run++)
        for (int i = 0; i < NUM_CASES; i++)
            costs[i][run] = costOnce(&cases[i]);
    puts("what,ns,least,largest");
    for (int i = 0; i < NUM_CASES; i++) {
        const double middle = median(costs[i], runs);
        printf("\"%s\",%.1f,%.1f,%.1f\n", cases[i].what, middle, costs[i][0], costs[i][runs - 1]);
    }
    return 0;
}
