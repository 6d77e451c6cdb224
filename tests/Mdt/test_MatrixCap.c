/* The cap on a partition's rows: what is left out, in which order, and that joints stay. */
#include "scene.h"

enum { CONTACTS = 4 };

/* Two stacked spheres on the floor and a joint: contacts 0, 1 between the bodies, 2, 3 with the world; depths rise
 * within each kind. 3 rows of the joint, 4 contacts of 3 rows: 15 in all. */
typedef struct {
    MdtWorldID world;
    MdtBodyID lower, upper;
    MdtBSJointID joint;
    MdtContactID contact[CONTACTS];
} Stack;

static Stack makeStack(void) {
    static const double depth[CONTACTS] = {.003, .004, .001, .002};
    Stack s;
    s.world = scene_world(3, 12, 10);
    s.lower = scene_body(s.world, 1, 0, 1, 0);
    s.upper = scene_body(s.world, 1, 0, 3, 0);
    s.joint = scene_ball(s.world, s.upper, 0, 0, 4, 0);
    for (int i = 0; i < CONTACTS; i++) {
        const MeBool between = i < 2;
        s.contact[i] = MdtContactCreate(s.world);
        MdtContactSetBodies(s.contact[i], between ? s.upper : s.lower, between ? s.lower : 0);
        MdtContactSetPosition(s.contact[i], i % 2 - .5, between ? 2 : 0, 0);
        MdtContactSetNormal(s.contact[i], 0, 1, 0);
        MdtContactSetPenetration(s.contact[i], depth[i]);
        MdtContactParamsSetType(MdtContactGetParams(s.contact[i]), MdtContactTypeFriction2D);
        MdtContactEnable(s.contact[i]);
    }
    return s;
}

static int rowsOf(MdtContactID c) {
    return MdtConstraintGetRowCount(MdtContactQuaConstraint(c));
}

static void assertRows(Stack *s, int cap, const int rows[CONTACTS]) {
    int log[2] = {-1, -1};
    MdtWorldSetMatrixSizeLog(s->world, log, 2);
    MdtWorldSetMaxMatrixSize(s->world, cap);
    MdtWorldStep(s->world, FRAME);
    int sum = 3;
    for (int i = 0; i < CONTACTS; i++) {
        ck_assert_msg(rowsOf(s->contact[i]) == rows[i], "cap %d: contact %d has %d rows, not %d", cap, i,
                      rowsOf(s->contact[i]), rows[i]);
        sum += rows[i];
    }
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtBSJointQuaConstraint(s->joint)), 3);
    ck_assert_int_eq(log[0], sum);
    ck_assert_int_eq(log[1], 0);
    MdtWorldSetMatrixSizeLog(s->world, NULL, 0);
}

TEST(rows_go_in_the_documented_order) {
    static const struct {
        int cap, rows[CONTACTS];
    } cases[] = {
        {15, {3, 3, 3, 3}}, {14, {3, 3, 1, 3}}, {13, {3, 3, 1, 3}}, {11, {3, 3, 1, 1}},
        {9, {1, 3, 1, 1}},  {7, {1, 1, 1, 1}},  {6, {0, 1, 1, 1}},  {5, {0, 0, 1, 1}},
        {4, {0, 0, 0, 1}},  {3, {0, 0, 0, 0}},  {1, {0, 0, 0, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Stack s = makeStack();
        assertRows(&s, cases[i].cap, cases[i].rows);
    }
}

TEST(a_group_keeps_its_deepest_contact) {
    Stack s = makeStack();
    MdtContactGroupID g = MdtContactGroupCreate(s.world);
    MdtContactGroupSetBodies(g, s.upper, s.lower);
    MdtContactGroupEnable(g);
    MdtContactGroupAppendContact(g, s.contact[0]);
    MdtContactGroupAppendContact(g, s.contact[1]);
    MdtWorldSetMaxMatrixSize(s.world, 3);
    MdtWorldStep(s.world, FRAME);
    ck_assert_int_eq(rowsOf(s.contact[0]), 0);
    ck_assert_int_eq(rowsOf(s.contact[1]), 1);
    ck_assert_int_eq(rowsOf(s.contact[2]) + rowsOf(s.contact[3]), 0);
}

static MeReal MEAPI importanceOfX(const MdtContactID c) {
    MeVector3 p;
    MdtContactGetPosition(c, p);
    return p[0] + (MdtContactGetBody(c, 1) ? 0 : (MeReal).1);
}

TEST(a_callback_replaces_the_order) {
    Stack s = makeStack(); /* by importance: 0, 2, 1, 3 */
    MdtWorldSetContactImportanceCB(s.world, importanceOfX);
    assertRows(&s, 11, (int[CONTACTS]){1, 3, 1, 3});
    s = makeStack();
    MdtWorldSetContactImportanceCB(s.world, importanceOfX);
    assertRows(&s, 5, (int[CONTACTS]){0, 1, 0, 1});
    s = makeStack();
    MdtWorldSetContactImportanceCB(s.world, importanceOfX);
    MdtWorldSetContactImportanceCB(s.world, NULL);
    assertRows(&s, 5, (int[CONTACTS]){0, 0, 1, 1});
}

TEST(without_a_call_there_is_no_cap) {
    MdtWorldID w = scene_world(1, 200, 10);
    ck_assert_int_eq(MdtWorldGetMaxMatrixSize(w), MDTMAXMATRIXSIZE_MAX);
    MdtBodyID b = scene_body(w, 1, 0, 1, 0);
    for (int i = 0; i < 200; i++) {
        MdtContactID c = MdtContactCreate(w);
        MdtContactSetBodies(c, b, 0);
        MdtContactSetPosition(c, (MeReal)(i % 20), 0, (MeReal)(i / 20));
        MdtContactEnable(c);
    }
    int log;
    MdtWorldSetMatrixSizeLog(w, &log, 1);
    MdtWorldStep(w, FRAME);
    ck_assert_int_eq(log, 200);
    MdtWorldSetMaxMatrixSize(w, 0);
    assert_warned("positive");
    ck_assert_int_eq(MdtWorldGetMaxMatrixSize(w), MDTMAXMATRIXSIZE_MAX);
}

static int shown, maxShown;

static void MEAPI restIfEven(MdtPartitionOutput *po, void *data) {
    const MdtPartitionInfo *last = &po->info[po->numPartitions - 1];
    ck_assert_ptr_eq(data, &shown);
    ck_assert_int_eq(last->numBodies, 1);
    ck_assert_int_eq(MdtBodyGetPartition(po->bodies[last->firstBody]), po->numPartitions - 1);
    maxShown = po->numPartitions;
    po->info[po->numPartitions - 1].isDisabled = shown++ % 2 == 0;
}

TEST(a_program_may_decide_about_rest) {
    MdtWorldID w = scene_world(4, 0, 10);
    MdtBodyID b[4];
    for (int i = 0; i < 4; i++)
        b[i] = scene_body(w, 1, i, 0, 0);
    shown = maxShown = 0;
    MdtWorldSetPartitionCB(w, restIfEven, &shown);
    MdtWorldStep(w, FRAME);
    ck_assert_int_eq(maxShown, 4);
    for (int i = 0; i < 4; i++)
        ck_assert_int_eq(MdtBodyIsEnabled(b[i]), i % 2);
    MdtWorldSetPartitionCB(w, NULL, NULL);
    MdtWorldStep(w, FRAME);
    ck_assert_int_eq(shown, 4);
}

TEST(auto_disable_as_a_callback_is_the_world_s) {
    MdtWorldID w = MdtWorldCreate(2, 0);
    MdtBodyID still = scene_body(w, 1, 0, 0, 0), moving = scene_body(w, 1, 5, 0, 0);
    MdtBodySetLinearVelocity(moving, 1, 0, 0);
    MdtWorldSetPartitionCB(w, MdtAutoDisableLastPartition, NULL);
    steps(w, 30, FRAME);
    ck_assert(!MdtBodyIsEnabled(still));
    ck_assert(MdtBodyIsEnabled(moving));
    MdtWorldDestroy(w);
}
