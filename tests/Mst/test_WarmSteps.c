/* A warm step of a universe allocates nothing, though the contact graph of a heap changes in every step: neither for
 * new pairs of models, nor for their touches, contacts and constraints, nor for the solver.
 *
 * What is warm: a block that grows is made twice as large as what was asked for, so memory is warm once nothing that is
 * still to come needs more than twice what the largest before did. So the boxes are jammed first, each among dozens:
 * the factor of that is nearly full, and twice its memory is more than any graph of as many bodies needs. Then they
 * fall onto each other in a bin, lie, and are thrown up and fall again: two falls fill the cache, two are counted.
 *
 * What is cold takes few blocks too: they double, as the number of pairs does that touch.
 *
 * Once with pools of fixed sizes, and once with pools that grow. The program asks for the events of every step. */
#include "universe.h"

enum { BOXES = 100, FALL = 120, WARM_FALLS = 2, FALLS = 4 };

static MdtBodyID body[BOXES];
static unsigned int seed;
static int allocations;

/* ---- memory that counts ---- */

static void *MEAPI create(size_t bytes) {
    allocations++;
    return malloc(bytes ? bytes : 1);
}

static void *MEAPI createAligned(size_t bytes, unsigned int alignment) {
    allocations++;
    return aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

static void *MEAPI resize(void *const block, size_t bytes) {
    allocations++;
    return realloc(block, bytes);
}

static void MEAPI destroy(void *const block) {
    free(block);
}

/* ---- the heap ---- */

static MeReal chance(double from, double to) {
    seed = seed * 1664525u + 1013904223u;
    return (MeReal)(from + (to - from) * (seed >> 8) / (1 << 24));
}

/* A plane through the point, with this normal, `across` x `up` (axes 0 to 2). */
static void makePlane(int across, int up, int normal, MeReal direction, MeReal distance) {
    static MeMatrix4 tm[3][3][3];
    MeReal(*m)[4] = tm[normal][across][direction > 0];
    memset(m, 0, sizeof(MeMatrix4));
    m[0][across] = m[1][up] = m[3][3] = 1;
    m[2][normal] = direction;
    m[3][normal] = -direction * distance;
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), m);
}

/* A bin of 5 m by 5 m. The budget bounds the time of the test: some steps are solved exactly, others finished by
 * sweeps. */
static void makeWorld(const MstUniverseSizes *sizes) {
    universe_begin(sizes);
    MdtWorldSetGravity(u->world, 0, -9.81, 0);
    MdtWorldSetWorkBudget(u->world, 5);
    MdtWorldEnableReport(u->world);
    const MdtContactParamsID p = MstBridgeGetContactParams(u->bridge, 0, 0);
    MdtContactParamsSetType(p, MdtContactTypeFriction2D);
    MdtContactParamsSetFrictionModel(p, MdtFrictionModelCone);
    MdtContactParamsSetFrictionCoeffecient(p, .5);
    makePlane(2, 0, 1, 1, 0);
    makePlane(1, 2, 0, 1, 2.5);
    makePlane(2, 1, 0, -1, 2.5);
    makePlane(0, 1, 2, 1, 2.5);
    makePlane(1, 0, 2, -1, 2.5);
}

static void makeBoxes(void) {
    const McdGeometryID cube = McdBoxCreate(u->frame, 1, 1, 1);
    for (int i = 0; i < BOXES; i++)
        body[i] = McdModelGetBody(MstModelAndBodyCreate(u, cube, 1));
}

/* Aside of the bin, for the exact solver, which may have nothing of the heap. */
static void makePendulum(void) {
    const MdtBodyID bob = MdtBodyCreate(u->world);
    const MdtBSJointID joint = MdtBSJointCreate(u->world);
    MdtBodySetPosition(bob, 11, 5, 0);
    MdtBodyEnable(bob);
    MdtBSJointSetBodies(joint, bob, 0);
    MdtBSJointSetPosition(joint, 10, 5, 0);
    MdtBSJointEnable(joint);
}

/* Turned any way and at rest, four a layer, on `width` by `width`. */
static void place(double width, double layer) {
    seed = 1;
    for (int i = 0; i < BOXES; i++) {
        MeReal q[4];
        for (int k = 0; k < 4; k++)
            q[k] = chance(-.5, .5);
        MdtBodyEnable(body[i]);
        MdtBodySetPosition(body[i], chance(-width / 2, width / 2), 2 + layer * (i / 4), chance(-width / 2, width / 2));
        MdtBodySetQuaternion(body[i], q[0], q[1], q[2], q[3]);
        MdtBodySetLinearVelocity(body[i], 0, 0, 0);
        MdtBodySetAngularVelocity(body[i], 0, 0, 0);
    }
}

static void throwUp(void) {
    for (int i = 0; i < BOXES; i++) {
        MdtBodyEnable(body[i]);
        MdtBodySetLinearVelocity(body[i], chance(-2, 2), chance(2, 6), chance(-2, 2));
    }
}

/* ---- steps ---- */

/* Which bodies contacts join, as a hash. */
static unsigned int graphNow(void) {
    unsigned int hash = 0;
    for (MdtConstraintID c = MdtConstraintGetFirst(u->world); c; c = MdtConstraintGetNext(c))
        for (int side = 0; side < 2; side++) {
            const MdtBodyID b = MdtConstraintGetBody(c, (unsigned int)side);
            unsigned int index = 0;
            while (index < BOXES && body[index] != b)
                index++;
            hash = hash * 31 + index;
        }
    return hash;
}

/* Pairs of models that touch. */
static int touchesNow(void) {
    int count, touches = 0;
    const MstEvent *event = MstUniverseGetEvents(u, &count);
    for (int i = 0; i < count; i++)
        touches += event[i].kind == MstEventBegin || event[i].kind == MstEventPersist;
    return touches;
}

/* How often the step has allocated. */
static int step(int *touches) {
    allocations = 0;
    MstUniverseStep(u, 1. / 60);
    *touches = touchesNow();
    return allocations;
}

/* How the two falls that are counted went. */
typedef struct Falls {
    int cold, warm;                  /* allocations, until they began, and in them */
    int jammed;                      /* pairs of models that touched in the first step */
    int changes;                     /* steps in which the graph changed */
    int factorizations, fewest, max; /* partitions */
} Falls;

static void noteStep(Falls *f, int allocated) {
    static unsigned int last;
    MdtReport report;
    ck_assert(MdtWorldGetReport(u->world, &report));
    const int partitions = MdtWorldGetReportCount(u->world);
    const unsigned int graph = graphNow();
    f->warm += allocated;
    f->changes += graph != last;
    f->factorizations += report.factorizations;
    f->fewest = MeMIN(f->fewest, partitions);
    f->max = MeMAX(f->max, partitions);
    last = graph;
}

static Falls runFalls(const MstUniverseSizes *sizes) {
    Falls f = {.fewest = BOXES};
    makeWorld(sizes);
    makeBoxes();
    makePendulum();
    place(3, .1);
    MdtWorldSetSolver(u->world, MdtSolverExact); /* either solver has had the largest partition that there is */
    f.cold = step(&f.jammed);
    MdtWorldSetSolver(u->world, MdtSolverAuto);
    place(3, .1);
    f.cold += step(&f.jammed);
    place(4, 1.2);
    for (int i = 0; i < FALLS * FALL; i++) {
        if (i > 0 && i % FALL == 0)
            throwUp();
        int touches;
        const int allocated = step(&touches);
        if (i < WARM_FALLS * FALL)
            f.cold += allocated;
        else
            noteStep(&f, allocated);
    }
    return f;
}

static void assertWarm(const MstUniverseSizes *sizes) {
    const MeMemoryAPIStruct before = MeMemoryAPI;
    MeMemoryAPI = (MeMemoryAPIStruct){create, createAligned, resize, destroy, destroy};
    const Falls f = runFalls(sizes);
    MeMemoryAPI = before;
    printf("%d cold and %d warm allocations, %d pairs jammed; the graph changed in %d steps, %d to %d partitions, %d "
           "factorizations\n",
           f.cold, f.warm, f.jammed, f.changes, f.fewest, f.max, f.factorizations);
    ck_assert_int_gt(f.cold, 0);
    ck_assert_int_lt(4 * f.cold, f.jammed); /* memory doubles, and is not taken one by one */
    ck_assert_int_gt(f.changes, (FALLS - WARM_FALLS) * FALL / 2);
    ck_assert_int_gt(f.max, 2 * f.fewest);
    ck_assert_int_gt(f.factorizations, 0);
    ck_assert_int_eq(f.warm, 0);
}

TEST(a_warm_step_allocates_nothing_while_the_contact_graph_changes) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    sizes.dynamicBodiesMaxCount = BOXES + 1;
    sizes.collisionModelsMaxCount = BOXES + 5;
    sizes.collisionPairsMaxCount = 40 * BOXES;
    sizes.dynamicConstraintsMaxCount = 200 * BOXES;
    assertWarm(&sizes);
}

TEST(nor_does_one_of_a_universe_that_grows) {
    assertWarm(&MstUniverseGrowingSizes);
}
