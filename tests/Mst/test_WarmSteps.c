/* A warm step of a world allocates nothing, though the contact graph of a heap changes in every step.
 *
 * What is warm: a block that grows is made twice as large as what was asked for, so memory is warm once no graph that
 * is still to come needs more than twice what the largest before did. So the boxes are jammed first, each among dozens:
 * the factor of that is nearly full, and twice its memory is more than any graph of as many bodies needs. Then they
 * fall onto each other in a bin, lie, and are thrown up and fall again: two falls fill the cache, two are counted. Only
 * the world's step is: what collision and the bridge keep of a new pair is theirs. */
#include "MdtReport.h"
#include "MeMemory.h"
#include "Mst.h"
#include "karma_test.h"

enum { BOXES = 100, FALL = 120, WARM_FALLS = 2, FALLS = 4 };

static MstUniverseID u;
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
    static MeMatrix4 tm[5];
    static int count;
    MeReal(*m)[4] = tm[count++];
    memset(m, 0, sizeof tm[0]);
    m[0][across] = m[1][up] = m[3][3] = 1;
    m[2][normal] = direction;
    m[3][normal] = -direction * distance;
    MstFixedModelCreate(u, McdPlaneCreate(u->frame), m);
}

/* A bin of 5 m by 5 m. The budget bounds the time of the test: some steps are solved exactly, others finished by
 * sweeps. */
static void makeWorld(void) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    sizes.dynamicBodiesMaxCount = BOXES;
    sizes.collisionModelsMaxCount = BOXES + 5;
    sizes.collisionPairsMaxCount = 40 * BOXES;
    sizes.dynamicConstraintsMaxCount = 200 * BOXES;
    u = MstUniverseCreate(&sizes);
    MdtWorldSetGravity(u->world, 0, (MeReal)-9.81, 0);
    MdtWorldSetWorkBudget(u->world, 5);
    MdtWorldEnableReport(u->world);
    const MdtContactParamsID p = MstBridgeGetContactParams(u->bridge, 0, 0);
    MdtContactParamsSetType(p, MdtContactTypeFriction2D);
    MdtContactParamsSetFrictionModel(p, MdtFrictionModelCone);
    MdtContactParamsSetFrictionCoeffecient(p, (MeReal).5);
    makePlane(2, 0, 1, 1, 0);
    makePlane(1, 2, 0, 1, (MeReal)2.5);
    makePlane(2, 1, 0, -1, (MeReal)2.5);
    makePlane(0, 1, 2, 1, (MeReal)2.5);
    makePlane(1, 0, 2, -1, (MeReal)2.5);
}

static void makeBoxes(void) {
    const McdGeometryID cube = McdBoxCreate(u->frame, 1, 1, 1);
    for (int i = 0; i < BOXES; i++)
        body[i] = McdModelGetBody(MstModelAndBodyCreate(u, cube, 1));
}

/* Turned any way and at rest, four a layer, on `width` by `width`. */
static void place(double width, double layer) {
    seed = 1;
    for (int i = 0; i < BOXES; i++) {
        MeReal q[4];
        for (int k = 0; k < 4; k++)
            q[k] = chance(-.5, .5);
        MdtBodyEnable(body[i]);
        MdtBodySetPosition(body[i], chance(-width / 2, width / 2), (MeReal)(2 + layer * (i / 4)),
                           chance(-width / 2, width / 2));
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

/* How often the world's step has allocated. */
static int step(void) {
    McdSpaceUpdateAll(u->space);
    MstBridgeUpdateContacts(u->bridge, u->space, u->world);
    allocations = 0;
    MdtWorldStep(u->world, (MeReal)(1. / 60));
    return allocations;
}

START_TEST(a_warm_step_allocates_nothing_while_the_contact_graph_changes) {
    const MeMemoryAPIStruct before = MeMemoryAPI;
    MeMemoryAPI = (MeMemoryAPIStruct){create, createAligned, resize, destroy, destroy};
    makeWorld();
    makeBoxes();
    place(3, .1);
    int changes = 0, cold = step(), warm = 0, factorizations = 0, fewest = BOXES, most = 0;
    unsigned int last = 0;
    place(4, 1.2);
    for (int i = 0; i < FALLS * FALL; i++) {
        if (i > 0 && i % FALL == 0)
            throwUp();
        const int count = step();
        MdtReport report;
        ck_assert(MdtWorldGetReport(u->world, &report));
        const int partitions = MdtWorldGetReportCount(u->world);
        const unsigned int graph = graphNow();
        *(i < WARM_FALLS * FALL ? &cold : &warm) += count;
        if (i >= WARM_FALLS * FALL) {
            changes += graph != last;
            factorizations += report.factorizations;
            fewest = MeMIN(fewest, partitions);
            most = MeMAX(most, partitions);
        }
        last = graph;
    }
    MstUniverseDestroy(u);
    MeMemoryAPI = before;
    printf("%d cold and %d warm allocations; the graph changed in %d steps, %d to %d partitions, %d factorizations\n",
           cold, warm, changes, fewest, most, factorizations);
    ck_assert_int_gt(cold, 0);
    ck_assert_int_gt(changes, (FALLS - WARM_FALLS) * FALL / 2);
    ck_assert_int_gt(most, 2 * fewest);
    ck_assert_int_gt(factorizations, 0);
    ck_assert_int_eq(warm, 0);
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, a_warm_step_allocates_nothing_while_the_contact_graph_changes);
}

TEST_MAIN("WarmSteps", tests)
