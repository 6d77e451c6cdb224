/* Contact groups: the list, the life, and that a group acts as its contacts would. */
#include "scene.h"

static const double mass = 2, gravity = 10;

/* A cube of edge 1 on the floor y = 0, with contacts at its four lower corners, in a group or one by one. */
typedef struct {
    MdtWorldID world;
    MdtBodyID body;
    MdtContactGroupID group;
    MdtContactID contact[4];
} Cube;

static void placeContact(MdtContactID c, int i, double friction) {
    MdtContactSetPosition(c, i & 1 ? .5 : -.5, 0, i & 2 ? .5 : -.5);
    MdtContactSetNormal(c, 0, 1, 0);
    MdtContactParamsID p = MdtContactGetParams(c);
    MdtContactParamsSetType(p, MdtContactTypeFriction2D);
    MdtContactParamsSetFrictionModel(p, MdtFrictionModelNormalForce);
    MdtContactParamsSetFrictionCoeffecient(p, friction);
}

static Cube makeCube(MeBool grouped) {
    const double edge[3] = {1, 1, 1};
    Cube s;
    s.world = scene_world(2, 10, gravity);
    s.body = scene_box(s.world, mass, edge, 0, .5, 0);
    s.group = grouped ? MdtContactGroupCreate(s.world) : NULL;
    if (grouped)
        MdtContactGroupSetBodies(s.group, s.body, 0);
    for (int i = 0; i < 4; i++) {
        s.contact[i] = grouped ? MdtContactGroupCreateContact(s.group) : MdtContactCreate(s.world);
        placeContact(s.contact[i], i, .5);
        if (!grouped) {
            MdtContactSetBodies(s.contact[i], s.body, 0);
            MdtContactEnable(s.contact[i]);
        }
    }
    if (grouped)
        MdtContactGroupEnable(s.group);
    return s;
}

TEST(the_list_is_walked_from_first_to_null) {
    Cube s = makeCube(METRUE);
    ck_assert_int_eq(MdtContactGroupGetCount(s.group), 4);
    int i = 0;
    for (MdtContactID c = MdtContactGroupGetFirstContact(s.group); c; c = MdtContactGroupGetNextContact(s.group, c)) {
        ck_assert_ptr_eq(c, s.contact[i++]);
        ck_assert_ptr_eq(MdtContactGetContactGroup(c), s.group);
        ck_assert_ptr_eq(MdtContactGetBody(c, 0), s.body);
    }
    ck_assert_int_eq(i, 4);
    MdtContactGroupID empty = MdtContactGroupCreate(s.world);
    ck_assert_ptr_null(MdtContactGroupGetFirstContact(empty));
    ck_assert_int_eq(MdtContactGroupGetCount(empty), 0);
}

TEST(contacts_come_and_go) {
    Cube s = makeCube(METRUE);
    MdtContactGroupDestroyContact(s.group, s.contact[1]);
    ck_assert_int_eq(MdtContactGroupGetCount(s.group), 3);
    ck_assert_ptr_eq(MdtContactGroupGetNextContact(s.group, s.contact[0]), s.contact[2]);
    ck_assert_int_eq(MdtWorldGetTotalConstraints(s.world), 4);

    MdtContactGroupRemoveContact(s.group, s.contact[3]);
    ck_assert_int_eq(MdtContactGroupGetCount(s.group), 2);
    ck_assert_ptr_null(MdtContactGetContactGroup(s.contact[3]));
    ck_assert(!MdtContactIsEnabled(s.contact[3]));
    ck_assert_int_eq(MdtWorldGetTotalConstraints(s.world), 4);

    MdtContactGroupAppendContact(s.group, s.contact[3]);
    ck_assert_ptr_eq(MdtContactGroupGetNextContact(s.group, s.contact[2]), s.contact[3]);
    MdtContactDestroy(s.contact[0]); /* by itself: the group notices */
    ck_assert_ptr_eq(MdtContactGroupGetFirstContact(s.group), s.contact[2]);
    MdtContactGroupReset(s.group);
    ck_assert_int_eq(MdtContactGroupGetCount(s.group), 0);
    ck_assert_int_eq(MdtWorldGetTotalConstraints(s.world), 1);
}

TEST(a_group_takes_its_contacts_with_it) {
    Cube s = makeCube(METRUE);
    MdtContactGroupDestroy(s.group);
    ck_assert_int_eq(MdtWorldGetTotalConstraints(s.world), 0);
    ck_assert_int_eq(MdtWorldGetEnabledConstraints(s.world), 0);
    steps(s.world, 10, FRAME);
}

TEST(a_group_acts_as_its_contacts_do_by_themselves) {
    Cube grouped = makeCube(METRUE), single = makeCube(MEFALSE);
    for (int i = 0; i < 60; i++) {
        MdtBodyAddForce(grouped.body, 13, 0, 3);
        MdtBodyAddForce(single.body, 13, 0, 3);
        MdtWorldStep(grouped.world, FRAME);
        MdtWorldStep(single.world, FRAME);
        ck_assert_mem_eq(MdtBodyGetTransformPtr(grouped.body), MdtBodyGetTransformPtr(single.body), sizeof(MeMatrix4));
    }
}

TEST(forces_are_the_sums_over_the_contacts) {
    Cube s = makeCube(METRUE);
    MeVector3 sum = {0, 0, 0}, f;
    MdtBodyAddForce(s.body, 3, 0, 0);
    MdtWorldStep(s.world, FRAME);
    for (int i = 0; i < 4; i++) {
        MdtContactGetForce(s.contact[i], 0, f);
        for (int k = 0; k < 3; k++)
            sum[k] += f[k];
    }
    MdtContactGroupGetForce(s.group, 0, f);
    assert_vec3_near(f, sum[0], sum[1], sum[2], TOL(1e-5, 1e-12));
    assert_near(f[0], -3, 2e-4); /* on soft normals the cube begins to lean; friction itself has no epsilon */
    assert_near(f[1], mass * gravity, 2e-3);
    assert_near(f[2], 0, TOL(1e-6, 1e-8));
    assert_near(MdtContactGroupGetNormalForce(s.group), mass * gravity, 2e-3);
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtContactGroupQuaConstraint(s.group)), 12);
    MdtContactGroupGetForce(s.group, 1, f);
    assert_vec3_near(f, -sum[0], -sum[1], -sum[2], TOL(1e-5, 1e-12));
}

TEST(only_the_group_s_switch_counts) {
    Cube s = makeCube(METRUE);
    ck_assert(MdtContactIsEnabled(s.contact[0]));
    MdtContactDisable(s.contact[0]);
    ck_assert(MdtContactIsEnabled(s.contact[0]));
    MdtContactGroupDisable(s.group);
    ck_assert(!MdtContactIsEnabled(s.contact[0]));
    MdtContactEnable(s.contact[0]);
    ck_assert(!MdtContactIsEnabled(s.contact[0]));
    steps(s.world, 12, FRAME); /* it falls through, for 0.2 s */
    assert_near(MdtBodyGetTransformPtr(s.body)[3][1], .5 - gravity * .2 * .2 / 2, TOL(1e-6, 1e-12));
}

TEST(with_the_world_the_body_comes_first) {
    Cube s = makeCube(METRUE);
    ck_assert(!MdtContactGroupIsSwapped(s.group));
    MdtContactGroupDisable(s.group);
    MdtContactGroupSetBodies(s.group, 0, s.body);
    ck_assert(MdtContactGroupIsSwapped(s.group));
    ck_assert_ptr_eq(MdtContactGroupGetBody(s.group, 0), s.body);
    ck_assert_ptr_null(MdtContactGroupGetBody(s.group, 1));
    ck_assert_ptr_eq(MdtContactGetBody(s.contact[2], 0), s.body);
    int generator;
    MdtContactGroupSetGenerator(s.group, &generator);
    ck_assert_ptr_eq(MdtContactGroupGetGenerator(s.group), &generator);
}

TEST(a_group_joins_its_bodies_and_a_sort_key_orders_groups) {
    MdtWorldID w = scene_world(3, 9, 0);
    MdtBodyID b[3];
    for (int i = 0; i < 3; i++)
        b[i] = scene_body(w, 1, i, 0, 0);
    MdtContactGroupID g[2];
    for (int i = 0; i < 2; i++) {
        g[i] = MdtContactGroupCreate(w);
        MdtContactGroupSetBodies(g[i], b[i], b[i + 1]);
        MdtContactGroupEnable(g[i]);
        MdtContactGroupSetSortKey(g[i], 2 - i);
        ck_assert_int_eq(MdtContactGroupGetSortKey(g[i]), 2 - i);
    }
    MdtWorldStep(w, FRAME);
    ck_assert_int_eq(MdtBodyGetPartition(b[0]), MdtBodyGetPartition(b[2]));
    ck_assert_ptr_eq(MdtConstraintGetFirst(w), MdtContactGroupQuaConstraint(g[1]));
}

TEST(bad_input_changes_nothing) {
    Cube s = makeCube(METRUE);
    MdtContactGroupID other = MdtContactGroupCreate(s.world);
    ck_assert_ptr_null(MdtContactGroupGetNextContact(other, s.contact[0]));
    assert_warned("not in this group");
    MdtContactGroupRemoveContact(other, s.contact[0]);
    assert_warned("not in this group");
    MdtContactGroupDestroyContact(other, s.contact[0]);
    assert_warned("not in this group");
    MdtContactGroupAppendContact(other, s.contact[0]);
    assert_warned("in a group already");
    MdtContactSetBodies(s.contact[0], s.body, 0);
    assert_warned("belongs to a group");
    MdtContactGroupGetCount(NULL);
    assert_warned("null");
    ck_assert_ptr_null(MdtContactGroupCreateContact((MdtContactGroupID)s.contact[0]));
    assert_warned("not a ContactGroup");
    for (int i = MdtWorldGetTotalConstraints(s.world); i < 10; i++)
        MdtContactGroupCreateContact(other);
    assert_silent();
    ck_assert_ptr_null(MdtContactGroupCreateContact(other));
    assert_warned("maxConstraints");
    ck_assert_int_eq(MdtContactGroupGetCount(s.group), 4);
}
