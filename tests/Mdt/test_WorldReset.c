/* A world that is emptied, and one that is as new. */
#include "Mdt.h"
#include "karma_test.h"

/* Two boxes on a rope of joints, in contact with the world. */
static void fill(MdtWorldID w) {
    MdtBodyID a = MdtBodyCreate(w), b = MdtBodyCreate(w);
    MdtBSJointID joint = MdtBSJointCreate(w);
    MdtBSJointSetBodies(joint, a, b);
    MdtBSJointEnable(joint);
    MdtContactGroupID group = MdtContactGroupCreate(w);
    MdtContactGroupSetBodies(group, a, 0);
    for (int i = 0; i < 3; i++) {
        MdtContactID c = MdtContactGroupCreateContact(group);
        MdtContactSetNormal(c, 0, 0, 1);
    }
    MdtContactGroupEnable(group);
    MdtBodyEnable(a);
    MdtBodyEnable(b);
}

TEST(reset_empties_a_world) {
    MdtWorldID w = MdtWorldCreate(2, 5);
    MdtWorldSetGravity(w, 0, 0, -3);
    for (int round = 0; round < 5; round++) { /* each time there is room for all of it again */
        fill(w);
        ck_assert_int_eq((int)MdtWorldGetTotalBodies(w), 2);
        MdtWorldStep(w, 1. / 60);
        ck_assert_int_gt(MdtWorldGetMaxMemoryPoolUsed(w), 0);
        MdtWorldReset(w);
        ck_assert(!MdtBodyGetFirst(w) && !MdtConstraintGetFirst(w) && MdtWorldGetTotalBodies(w) == 0);
        MdtWorldStep(w, 1. / 60);
    }
    MeVector3 gravity;
    MdtWorldGetGravity(w, gravity);
    ck_assert(gravity[2] == -3);
    MdtWorldDestroy(w);
}

TEST(recreate_makes_it_new) {
    MdtWorldID w = MdtWorldCreate(2, 5, 2, 3), fresh = MdtWorldCreate(2, 5, 2, 3);
    MeVector3 gravity, expected;
    fill(w);
    MdtWorldSetGravity(w, 0, 0, -3);
    MdtWorldSetEpsilon(w, 1);
    MdtWorldSetGamma(w, 1);
    MdtWorldReCreate(w);
    ck_assert_ptr_null(MdtBodyGetFirst(w));
    MdtWorldGetGravity(w, gravity);
    MdtWorldGetGravity(fresh, expected);
    ck_assert(memcmp(gravity, expected, sizeof gravity) == 0);
    ck_assert(MdtWorldGetEpsilon(w) == MdtWorldGetEpsilon(fresh) && MdtWorldGetGamma(w) == MdtWorldGetGamma(fresh));
    MdtWorldDestroy(w);
    MdtWorldDestroy(fresh);
}

TEST(no_world_warns) {
    assert_refused(MdtWorldReset, NULL);
    assert_refused(MdtWorldReCreate, NULL);
    assert_none(MdtWorldGetMaxMemoryPoolUsed, NULL);
}
