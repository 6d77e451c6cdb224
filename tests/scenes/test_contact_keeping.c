/* What Karma's adapter does with contacts from step to step: those that last stay the same objects. */
#include "karma_test.h"
#include "engine_karma.c"

/* A box of 1 x .4 x 1 m whose corners stand on the ground, and one beside it. */
typedef struct Stand {
    EngineWorld *world;
    SceneContact contacts[8];
} Stand;

static SceneContact contactAt(int body, double x, double z) {
    return (SceneContact){
        .body = body, .other = SCENE_WORLD, .point = {x, 0, z}, .normal = {0, 1, 0}, .friction = .5, .restitution = 0};
}

static Stand makeStand(void) {
    Stand s;
    SceneWorld w = {.numBodies = 0};
    const double none[3] = {0, 0, 0};
    s.world = create(0, none, true);
    for (int i = 0; i < 2; i++) {
        addBody(s.world, scene_addBox(&w, 1, 1, .4, 1, 2 * i, .2, 0));
        for (int k = 0; k < 4; k++)
            s.contacts[4 * i + k] = contactAt(i, 2 * i + (k & 1 ? .5 : -.5), k & 2 ? .5 : -.5);
    }
    setContacts(s.world, s.contacts, 8);
    return s;
}

static void note(const EngineWorld *w, MdtContactID ids[]) {
    for (int i = 0; i < w->numContacts; i++)
        ids[i] = w->contacts[i].id;
}

TEST(they_stay_when_they_move_a_little_in_whatever_order) {
    Stand s = makeStand();
    MdtContactID before[8], after[8];
    MeVector3 p;
    note(s.world, before);
    SceneContact turned[8];
    for (int i = 0; i < 8; i++) {
        turned[i] = s.contacts[7 - i];
        turned[i].point[0] += .02;
        turned[i].depth = .001 * i;
    }
    setContacts(s.world, turned, 8);
    note(s.world, after);
    for (int i = 0; i < 8; i++) {
        ck_assert_ptr_eq(after[i], before[7 - i]);
        MdtContactGetPosition(after[i], p);
        assert_near(p[0], turned[i].point[0], TOL(1e-6, 1e-14));
        assert_near(MdtContactGetPenetration(after[i]), .001 * i, TOL(1e-9, 1e-16));
    }
    ck_assert_int_eq(MdtWorldGetTotalConstraints(s.world->world), 8);
    destroy(s.world);
}

/* A ball that rolls has one contact, which goes with it. */
TEST(they_stay_when_they_move_with_their_bodies) {
    Stand s = makeStand();
    MdtContactID before[8], after[8];
    note(s.world, before);
    for (int i = 0; i < 2; i++)
        MdtBodySetPosition(s.world->bodies[i], 2. * i + 3, .2, 0);
    for (int i = 0; i < 8; i++)
        s.contacts[i].point[0] += 3;
    setContacts(s.world, s.contacts, 8);
    note(s.world, after);
    ck_assert_int_eq(memcmp(before, after, sizeof before), 0);
    destroy(s.world);
}

TEST(they_go_when_they_part_and_come_anew) {
    Stand s = makeStand();
    MdtContactID before[8];
    note(s.world, before);
    SceneContact left[3] = {s.contacts[6], s.contacts[1], s.contacts[0]};
    left[2].point[2] += .4; /* too far to be the same */
    setContacts(s.world, left, 3);
    ck_assert_int_eq(MdtWorldGetTotalConstraints(s.world->world), 3);
    ck_assert_ptr_eq(s.world->contacts[0].id, before[6]);
    ck_assert_ptr_eq(s.world->contacts[1].id, before[1]);
    ck_assert(MdtContactIsEnabled(s.world->contacts[2].id));
    ck_assert_ptr_eq(MdtContactGetBody(s.world->contacts[2].id, 0), s.world->bodies[0]);
    /* in the world's order the old ones come first, and the new one last */
    MdtConstraintID c = MdtConstraintGetFirst(s.world->world);
    ck_assert_ptr_eq(MdtConstraintDCastContact(c), before[1]);
    c = MdtConstraintGetNext(c);
    ck_assert_ptr_eq(MdtConstraintDCastContact(c), before[6]);
    c = MdtConstraintGetNext(c);
    ck_assert_ptr_eq(MdtConstraintDCastContact(c), s.world->contacts[2].id);
    setContacts(s.world, left, 0);
    ck_assert_int_eq(MdtWorldGetTotalConstraints(s.world->world), 0);
    destroy(s.world);
}
