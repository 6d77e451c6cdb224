/* What one more of something costs a step of 1/60 s, in the precision of the build: as CSV, ns.
 *
 * Two universes with FEW and MANY of it are stepped in turn; the difference of their CPU times over the difference of
 * the numbers is the marginal cost. The cost of a joint or a contact includes that of the body it belongs to, which the
 * first lines tell. Nothing is put to rest but what is said to sleep. All are measured in turns, 15 times, so that a
 * machine that is slow for a while is so for all of them; with --quick once. */
#include "timing.h"

#include "McdMesh.h"
#include "Mst.h"
#include "MstMover.h"
#include "MstVehicle.h"

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
    bool isOnMesh;  /* the ground is a mesh of squares of 1 m; else a plane */
    double rolling; /* m, MdtContactParamsSetRollingFriction */
} Case;

/* A character, which walks in each step. */
typedef struct Walker {
    MstUniverseID universe;
    MstMoverID mover;
    MeVector3 velocity;
} Walker;

static Walker walkers[FEW + MANY];
static int numWalkers;

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

static McdModelID addShape(MstUniverseID u, McdGeometryID g, double x) {
    const McdModelID m = MstModelAndBodyCreate(u, g, 1);
    McdModelDynamicsSetPosition(m, (MeReal)x, (MeReal).5, 0);
    MdtBodyEnable(McdModelGetBody(m));
    return m;
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

static void addSweptBox(MstUniverseID u, double x) {
    McdModelSetSwept(addShape(u, McdBoxCreate(u->frame, 1, 1, 1), x), METRUE);
}

static void addMoved(MstUniverseID u, double x) {
    const MdtBodyID b = McdModelGetBody(addShape(u, McdBoxCreate(u->frame, 2, (MeReal).5, 2), x));
    MdtBodySetKinematic(b, METRUE);
    MdtBodySetLinearVelocity(b, 0, 0, 1);
}

static void addCarried(MstUniverseID u, double x) {
    addMoved(u, x);
    McdModelDynamicsSetPosition(addShape(u, McdBoxCreate(u->frame, 1, 1, 1), x), (MeReal)x, (MeReal)1.25, 0);
}

static void addWalker(MstUniverseID u, double x) {
    const MeVector3 at = {(MeReal)x, (MeReal).1, 0};
    MstMoverParams params;
    MstMoverSetDefaults(&params, u);
    walkers[numWalkers++] = (Walker){u, MstMoverCreate(u, &params, at), {0, -1, 1}};
}

static void walk(MstUniverseID u) {
    for (int i = 0; i < numWalkers; i++)
        if (walkers[i].universe == u)
            MstMoverMove(walkers[i].mover, walkers[i].velocity, (MeReal)(1. / 60), 0);
}

static void destroyWalkers(void) {
    for (int i = 0; i < numWalkers; i++)
        MstMoverDestroy(walkers[i].mover);
    numWalkers = 0;
}

static void addCar(MstUniverseID u, double x, MstVehicleCast cast) {
    const McdModelID chassis = addShape(u, McdBoxCreate(u->frame, (MeReal)1.6, (MeReal).3, (MeReal).8), x);
    MstVehicleParams params;
    MstWheelParams wheel;
    MstVehicleSetDefaults(&params, u);
    params.cast = cast;
    const MstVehicleID v = MstVehicleCreate(u, chassis, &params);
    MstWheelSetDefaults(&wheel, u);
    for (int i = 0; i < 4; i++) {
        MeVector3Set(wheel.position, (MeReal)(i < 2 ? .6 : -.6), 0, (MeReal)(i % 2 ? .5 : -.5));
        wheel.axle = i / 2;
        wheel.drive = 1;
        MstVehicleAddWheel(v, &wheel);
    }
}

static void addCastCar(MstUniverseID u, double x) {
    addCar(u, x, kMstVehicleRay);
}

static void addBodyCar(MstUniverseID u, double x) {
    addCar(u, x, kMstVehicleBodies);
}

/* Boxes of 1 kg slide, so that no step can be left out; .6 of their weight overcomes friction .5. */
static const Case cases[] = {
    {"body that flies", addFlying, .friction = MdtFrictionModelCone},
    {"body on a ball joint", addBall, .friction = MdtFrictionModelCone},
    {"body on a hinge", addPlainHinge, .friction = MdtFrictionModelCone},
    {"body on a hinge at its stop", addLimit, .friction = MdtFrictionModelCone},
    {"body on a hinge with a motor", addMotor, .friction = MdtFrictionModelCone},
    {"body on a prismatic joint", addPrismatic, .friction = MdtFrictionModelCone},
    {"body in a plane (linear 1)", addLinear1, .friction = MdtFrictionModelCone},
    {"sphere that rolls, one contact, cone", addSphere, .push = 1, .friction = MdtFrictionModelCone},
    {"sphere that rolls, with a rolling bound", addSphere, .push = 1, .friction = MdtFrictionModelCone, .rolling = .01},
    {"box that slides, four contacts, no friction", addBox, .push = 1, .friction = MdtFrictionModelUnknown},
    {"box that slides, four contacts, box friction", addBox, .push = 6, .friction = MdtFrictionModelBox},
    {"box that slides, four contacts, normal force", addBox, .push = 6, .friction = MdtFrictionModelNormalForce},
    {"box that slides, four contacts, cone", addBox, .push = 6, .friction = MdtFrictionModelCone},
    {"box that slides, swept", addSweptBox, .push = 6, .friction = MdtFrictionModelCone},
    {"box that slides on a mesh", addBox, .push = 6, .friction = MdtFrictionModelCone, .isOnMesh = true},
    {"box that sleeps", addSleeping, .friction = MdtFrictionModelCone, .sleeps = true},
    {"body that the program moves (kinematic)", addMoved, .friction = MdtFrictionModelCone},
    {"body that the program moves, and a box on it", addCarried, .friction = MdtFrictionModelCone},
    {"character that walks (mover)", addWalker, .friction = MdtFrictionModelCone},
    {"car on four wheels that are cast (vehicle)", addCastCar, .friction = MdtFrictionModelCone},
    {"car on four wheels that are bodies (vehicle)", addBodyCar, .friction = MdtFrictionModelCone},
    {"character that walks on a mesh", addWalker, .friction = MdtFrictionModelCone, .isOnMesh = true},
};

enum { NUM_CASES = sizeof cases / sizeof *cases };

static void setFriction(MdtContactParamsID p, const Case *c) {
    if (c->friction == MdtFrictionModelUnknown)
        return;
    MdtContactParamsSetType(p, MdtContactTypeFriction2D);
    MdtContactParamsSetFrictionModel(p, c->friction);
    MdtContactParamsSetRollingFriction(p, (MeReal)c->rolling);
    MdtContactParamsSetFriction(p, (MeReal)1.2); /* N, of the box model, at each of four contacts */
    MdtContactParamsSetFrictionCoeffecient(p, (MeReal).5);
}

/* Flat, in the plane y = 0, under all units. */
static McdGeometryID createMesh(MstUniverseID u) {
    enum { LONG = 1200, WIDE = 16 };
    MeVector3 *v = malloc(sizeof *v * (LONG + 1) * (WIDE + 1));
    int *t = malloc(sizeof *t * 6 * LONG * WIDE), *next = t;
    if (!v || !t)
        abort();
    for (int j = 0; j <= WIDE; j++)
        for (int i = 0; i <= LONG; i++)
            MeVector3Set(v[j * (LONG + 1) + i], (MeReal)(i - LONG / 2 - .3), 0, (MeReal)(j - WIDE / 2 - .3));
    for (int j = 0; j < WIDE; j++)
        for (int i = 0; i < LONG; i++) {
            const int a = j * (LONG + 1) + i, b = a + LONG + 1;
            const int two[6] = {a, b, b + 1, a, b + 1, a + 1};
            memcpy(next, two, sizeof two);
            next += 6;
        }
    const McdGeometryID mesh = McdMeshCreate(u->frame, v, (LONG + 1) * (WIDE + 1), t, 2 * LONG * WIDE, 0);
    free(v);
    free(t);
    return mesh;
}

static void addGround(MstUniverseID u, const Case *c) {
    static MeMatrix4 here = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    static MeMatrix4 up = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}};
    if (c->isOnMesh)
        MstFixedModelCreate(u, createMesh(u), here);
    else
        MstFixedModelCreate(u, McdPlaneCreate(u->frame), up);
}

static MstUniverseID make(const Case *c, int n) {
    const MstUniverseID u = MstUniverseCreate(&MstUniverseGrowingSizes);
    if (!u)
        abort();
    MdtWorldSetGravity(u->world, 0, (MeReal)-9.81, 0);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    setFriction(MstBridgeGetContactParams(u->bridge, 0, 0), c);
    addGround(u, c);
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
    walk(u);
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
    destroyWalkers();
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
