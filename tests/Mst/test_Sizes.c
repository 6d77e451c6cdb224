/* The sizes of a universe: what has no room is said once, in the program's words; sizes of 0 have no limits; universes
 * in several threads at once. */
#include "universe.h"
#include "whole.h"
#include <pthread.h>

static MeMatrix4 ground = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};

static MstUniverseSizes sizesOf(unsigned int all) {
    return (MstUniverseSizes){all, 4 * all, 0, all, 4 * all, all, all, 1, 1};
}

static McdModelID makeBall(MstUniverseID universe, double radius, double x, double y, double z) {
    const McdModelID m = MstModelAndBodyCreate(universe, McdSphereCreate(universe->frame, radius), 1000);
    if (m)
        McdModelDynamicsSetPosition(m, x, y, z);
    return m;
}

/* ---- models whose place is not known yet ------------------------------------------------------------------------- */

/* 98 bodies created and one destroyed before the first step: 'no room for 4253 more pairs'. They are all at the origin
 * until the program has put them elsewhere. */
TEST(models_have_no_pairs_before_their_first_place_is_known) {
    McdModelID m[98];
    universe_begin(NULL);
    for (int i = 0; i < 98; i++)
        m[i] = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, .4), 1000);
    MstModelAndBodyDestroy(m[97]);
    for (int i = 0; i < 97; i++)
        McdModelDynamicsSetPosition(m[i], (MeReal)i, 0, 5);
    MstUniverseStep(u, 1. / 60);
}

/* The same while the universe runs; and bodies that sleep at once are met where they are, not at the origin. */
TEST(a_body_that_is_disabled_before_its_first_step_is_where_it_was_put) {
    universe_begin(NULL);
    MdtWorldSetGravity(u->world, 0, 0, -9.8);
    MstUniverseStep(u, 1. / 60);
    const McdModelID below = makeBall(u, .5, 7, 0, 0), above = makeBall(u, .4, 7, 0, 1.2);
    MdtBodyDisable(McdModelGetBody(below));
    McdModelID other[40];
    for (int i = 0; i < 40; i++)
        other[i] = makeBall(u, .4, -i, 0, -20);
    MstModelAndBodyDestroy(other[39]);
    MeVector3 p, q;
    universe_step(30);
    int count;
    const MstEvent *event = MstUniverseGetEvents(u, &count);
    ck_assert_int_ge(count, 1);
    ck_assert(event[0].model1 == above || event[0].model2 == above);
    McdModelDynamicsGetPosition(above, p);
    McdModelDynamicsGetPosition(below, q);
    ck_assert(p[2] - q[2] > (MeReal).85); /* it has woken it, and is not through it */
}

/* ---- what is said where there is no room ------------------------------------------------------------------------- */

static int said;
static char words[4096];

static void MEAPI_CDECL listen(const int level, const char *const format, va_list ap) {
    const size_t at = strlen(words);
    (void)level;
    said++;
    vsnprintf(words + at, sizeof words - at, format, ap);
}

/* One message, one line, with these two in it. */
static void assertSaidOnce(const char *function, const char *member) {
    char name[100];
    snprintf(name, sizeof name, "raise MstUniverseSizes.%s,", member);
    ck_assert_msg(said == 1, "%d messages: %s", said, words);
    ck_assert_msg(strncmp(words, function, strlen(function)) == 0 && words[strlen(function)] == ':', "%s", words);
    ck_assert_msg(strstr(words, name) && !strchr(words, '\n'), "%s", words);
    said = 0;
    words[0] = 0;
}

static MeHandler warning;

static void beginListening(const MstUniverseSizes *sizes) {
    universe_begin(sizes);
    said = 0;
    words[0] = 0;
    warning = MeSetWarningHandler(listen);
}

static void endListening(void) {
    MeSetWarningHandler(warning);
}

TEST(too_many_models_name_the_size_once) {
    MstUniverseSizes sizes = sizesOf(20);
    sizes.collisionModelsMaxCount = 5;
    beginListening(&sizes);
    for (int i = 0; i < 8; i++)
        ck_assert_int_eq(makeBall(u, 1, 3 * i, 0, 0) != 0, i < 5);
    assertSaidOnce("MstModelAndBodyCreate", "collisionModelsMaxCount");
    ck_assert_int_eq(MdtWorldGetTotalBodies(u->world), 5); /* nothing half made is left */
    ck_assert(!MstFixedModelCreate(u, McdPlaneCreate(u->frame), ground) && !McdModelCreate(McdPlaneCreate(u->frame)));
    ck_assert_int_eq(said, 0);
    endListening();
    beginListening(&sizes);
    for (int i = 0; i < 7; i++)
        McdModelCreate(McdPlaneCreate(u->frame));
    assertSaidOnce("McdModelCreate", "collisionModelsMaxCount");
    endListening();
}

TEST(too_many_bodies_name_the_size_once) {
    MstUniverseSizes sizes = sizesOf(20);
    sizes.dynamicBodiesMaxCount = 5;
    beginListening(&sizes);
    for (int i = 0; i < 8; i++)
        ck_assert_int_eq(makeBall(u, 1, 3 * i, 0, 0) != 0, i < 5);
    assertSaidOnce("MstModelAndBodyCreate", "dynamicBodiesMaxCount");
    ck_assert_int_eq(McdFrameworkGetModelCount(u->frame), 5);
    ck_assert(!MdtBodyCreate(u->world));
    ck_assert_int_eq(said, 0);
    endListening();
}

TEST(too_many_constraints_name_the_size_once) {
    MstUniverseSizes sizes = sizesOf(20);
    sizes.dynamicConstraintsMaxCount = 3;
    beginListening(&sizes);
    for (int i = 0; i < 6; i++)
        ck_assert_int_eq(MdtHingeCreate(u->world) != 0, i < 3);
    assertSaidOnce("MdtHingeCreate", "dynamicConstraintsMaxCount");
    endListening();
    beginListening(&sizes);
    for (int i = 0; i < 4; i++) /* contacts */
        makeBall(u, 1, 1.9 * i, 0, 0);
    universe_step(5);
    assertSaidOnce("MstUniverseStep", "dynamicConstraintsMaxCount");
    endListening();
}

TEST(too_many_pairs_name_the_size_once) {
    MstUniverseSizes sizes = sizesOf(100);
    sizes.collisionPairsMaxCount = 10;
    beginListening(&sizes);
    for (int i = 0; i < 20; i++)
        makeBall(u, 1, .1 * i, 0, 0);
    universe_step(3);
    makeBall(u, 1, 0, .1, 0);
    MstUniverseStep(u, 1. / 60);
    assertSaidOnce("MstUniverseStep", "collisionPairsMaxCount");
    endListening();
}

TEST(too_many_parts_of_aggregates_and_materials_name_the_size_once) {
    MstUniverseSizes sizes = sizesOf(20);
    sizes.collisionGeometryInstancesMaxCount = 3;
    sizes.materialsMaxCount = 2;
    beginListening(&sizes);
    MeMatrix4TMMakeIdentity(ground);
    const McdGeometryID a = McdAggregateCreate(u->frame, 2);
    for (int i = 0; i < 2; i++)
        McdAggregateAddElement(a, McdSphereCreate(u->frame, 1), ground);
    for (int i = 0; i < 3; i++)
        ck_assert_int_eq(MstModelAndBodyCreate(u, a, 1) != 0, i < 1);
    assertSaidOnce("MstModelAndBodyCreate", "collisionGeometryInstancesMaxCount");
    ck_assert_int_eq(MdtWorldGetTotalBodies(u->world), 1);
    for (int i = 0; i < 3; i++)
        ck_assert_int_eq((int)MstBridgeGetNewMaterial(u->bridge), i < 1);
    assertSaidOnce("MstBridgeGetNewMaterial", "materialsMaxCount");
    endListening();
}

TEST(a_type_out_of_range_names_the_size) {
    beginListening(NULL);
    McdFrameworkRegisterGeometryType(u->frame, (McdGeometryType)kMcdGeometryFirstUserType, "mine", 0, 0, 0, 0, 0, 0);
    ck_assert_int_eq(said, 1);
    ck_assert(strstr(words, "MstUniverseSizes.collisionUserGeometryTypesMaxCount"));
    endListening();
}

/* ---- growing ----------------------------------------------------------------------------------------------------- */

/* A field of pillars of two balls, one ball of which is hung up by a joint. */
static MstUniverseID makeField(const MstUniverseSizes *sizes, int side, MdtBodyID *first) {
    const MstUniverseID made = MstUniverseCreate(sizes);
    const McdGeometryID small = McdSphereCreate(made->frame, .4);
    MdtWorldSetGravity(made->world, 0, 0, -9.8);
    for (int i = 0; i < side * side; i++) {
        const MeReal x = (MeReal)(i % side), y = (MeReal)(i / side);
        for (int k = 0; k < 2; k++) {
            const McdModelID m = MstModelAndBodyCreate(made, small, 1000);
            McdModelDynamicsSetPosition(m, x + (MeReal)(.01 * k), y, .79 * k);
            if (i == 0 && k == 0)
                *first = McdModelGetBody(m);
            if (k == 0) {
                const MdtBSJointID j = MdtBSJointCreate(made->world);
                MdtBSJointSetBodies(j, McdModelGetBody(m), 0);
                MdtBSJointSetPosition(j, x, y, 0);
                MdtBSJointEnable(j);
            }
        }
    }
    return made;
}

static unsigned int hashOf(MstUniverseID universe, unsigned int hash) {
    McdSpaceModelIterator it;
    McdModelID m;
    McdSpaceModelIteratorBegin(universe->space, &it);
    while (McdSpaceGetModel(universe->space, &it, &m)) {
        MeVector3 p, v;
        if (!McdModelGetBody(m))
            continue;
        unsigned char bytes[2 * sizeof p];
        McdModelDynamicsGetPosition(m, p);
        McdModelDynamicsGetLinearVelocity(m, v);
        memcpy(bytes, p, sizeof p);
        memcpy(bytes + sizeof p, v, sizeof v);
        for (size_t i = 0; i < sizeof bytes; i++)
            hash = (hash ^ bytes[i]) * 16777619u;
    }
    return hash;
}

TEST(a_universe_of_sizes_0_takes_3000_bodies_and_1500_joints_without_a_message) {
    MdtBodyID first = 0;
    u = makeField(&MstUniverseGrowingSizes, 39, &first); /* 3042 bodies, 1521 joints */
    const MdtBodyID before = first;
    universe_step(3);
    ck_assert_int_eq(MdtWorldGetTotalBodies(u->world), 3042);
    ck_assert_int_gt(MdtWorldGetTotalConstraints(u->world), 1521 + 1000); /* contacts too */
    ck_assert_int_eq(MdtWorldGetMaxBodies(u->world), MeNoLimit);
    MdtBodyAddForce(before, 0, 0, 1); /* the first handle is good yet */
}

TEST(a_growing_universe_moves_as_one_of_fixed_sizes_bit_by_bit) {
    const MstUniverseSizes fixed = sizesOf(2000);
    MdtBodyID first;
    unsigned int hash[2] = {1, 1};
    for (int k = 0; k < 2; k++) {
        u = makeField(k ? &MstUniverseGrowingSizes : &fixed, 14, &first);
        McdModelID thrown = 0;
        for (int i = 0; i < 20; i++) {
            if (i % 5 == 0) { /* and some that come and go */
                if (thrown)
                    MstModelAndBodyDestroy(thrown);
                thrown = makeBall(u, .3, 3, 3, 4);
                McdModelDynamicsSetLinearVelocity(thrown, 0, 0, -60);
            }
            MstUniverseStep(u, 1. / 60);
            hash[k] = hashOf(u, hash[k]);
        }
    }
    ck_assert_int_eq((int)hash[0], (int)hash[1]);
    ck_assert(hash[0] != 1);
}

/* Addresses of parameters hold while materials come. */
TEST(a_bridge_of_size_0_takes_300_materials_whose_parameters_stay) {
    universe_begin(&MstUniverseGrowingSizes);
    MdtContactParamsID of[300];
    for (int i = 0; i < 300; i++) {
        const MstMaterialID m = MstBridgeGetNewMaterial(u->bridge);
        ck_assert_int_eq((int)m, i + 1);
        of[i] = MstBridgeGetContactParams(u->bridge, m, 0);
        MdtContactParamsSetRestitution(of[i], (MeReal)i / 300);
    }
    for (int i = 0; i < 300; i++) {
        ck_assert_ptr_eq(MstBridgeGetContactParams(u->bridge, 0, (MstMaterialID)(i + 1)), of[i]);
        assert_near(MdtContactParamsGetRestitution(of[i]), (MeReal)i / 300, 0);
    }
}

TEST(worlds_frameworks_and_spaces_by_hand_grow_too) {
    const MdtWorldID w = MdtWorldCreate(MeNoLimit, MeNoLimit);
    const McdFrameworkID f = McdInit(0, MeNoLimit, MeNoLimit, 1);
    McdPrimitivesRegisterTypes(f);
    McdPrimitivesRegisterInteractions(f);
    const McdSpaceID s = McdSpaceAxisSortCreate(f, McdAllAxes, MeNoLimit, MeNoLimit);
    const McdGeometryID ball = McdSphereCreate(f, 1);
    for (int i = 0; i < 500; i++) {
        const McdModelID m = McdModelCreate(ball);
        const MdtBodyID b = MdtBodyCreate(w);
        McdModelSetBody(m, b);
        MdtBodySetPosition(b, (MeReal)(i % 20), (MeReal)(i / 20), 0);
        ck_assert(McdSpaceInsertModel(s, m));
        MdtBSJointCreate(w);
    }
    McdSpaceUpdateAll(s);
    ck_assert_int_eq(McdSpaceGetModelCount(s), 500);
    ck_assert_int_eq(MdtWorldGetTotalBodies(w), 500);
    ck_assert_int_eq(MdtWorldGetTotalConstraints(w), 500);
    McdSpaceDestroy(s);
    McdFrameworkDestroyAllModelsAndGeometries(f);
    McdTerm(f);
    MdtWorldDestroy(w);
}

/* ---- threads ----------------------------------------------------------------------------------------------------- */

#ifdef TEST_IS_SLOW
enum { ROUNDS = 20 };
#else
enum { ROUNDS = 100 };
#endif

typedef struct Thread {
    pthread_t id;
    unsigned int hash[ROUNDS];
    Whole whole;
} Thread;

/* Creates, steps and destroys universes. */
static void *live(void *context) {
    Thread *t = context;
    for (int i = 0; i < ROUNDS; i++) {
        whole_begin(&t->whole, i % 2 ? NULL : &MstUniverseGrowingSizes);
        whole_grounds(&t->whole, t->whole.u->frame);
        whole_shapes(&t->whole, t->whole.u->frame);
        whole_step(&t->whole, 1);
        t->hash[i] = hashOf(t->whole.u, 1);
        whole_end(&t->whole);
    }
    return 0;
}

TEST(two_threads_create_step_and_destroy_universes_at_once_100_times) {
    Thread *t = calloc(2, sizeof *t);
    for (int k = 0; k < 2; k++)
        ck_assert_int_eq(pthread_create(&t[k].id, NULL, live, &t[k]), 0);
    for (int k = 0; k < 2; k++)
        pthread_join(t[k].id, NULL);
    for (int i = 0; i < ROUNDS; i++)
        ck_assert(t[0].hash[i] == t[1].hash[i] && t[0].hash[i] == t[0].hash[0]);
    free(t);
}
