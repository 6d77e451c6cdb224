/* Swept bodies with joints: a part of a step, however short, corrects its share of a joint's error and no more. */
#include "universe.h"

#define STEP (1. / 60)
enum { MAX = 12 };

static McdModelID box[MAX];
static int count;
static MeU32 seed;

static double between(double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (seed / 4294967296.);
}

/* An empty universe with a plane at z = 0, and materials that rebound and rub. */
static void begin(MeU32 number) {
    seed = number * 7919 + 1;
    count = 0;
    universe_begin(0);
    MdtWorldSetGravity(u->world, 0, 0, -10);
    MdtWorldSetAutoDisable(u->world, 0);
    universe_addFloor();
    MdtContactParamsID params = MstBridgeGetContactParams(u->bridge, 0, 0);
    MdtContactParamsSetType(params, MdtContactTypeFriction2D);
    MdtContactParamsSetFrictionModel(params, MdtFrictionModelCone);
    MdtContactParamsSetFrictionCoeffecient(params, .5);
    MdtContactParamsSetRestitution(params, between(0, .6));
}

static MdtBodyID addBox(const double size[3], const double at[3]) {
    McdModelID m = box[count++] = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, size[0], size[1], size[2]), 1000);
    McdModelSetSwept(m, METRUE);
    McdModelDynamicsSetPosition(m, at[0], at[1], at[2]);
    return McdModelGetBody(m);
}

static void hinge(McdModelID a, McdModelID b) {
    MdtHingeID joint = MdtHingeCreate(u->world);
    MeVector3 p, q;
    McdModelDynamicsGetPosition(a, p);
    McdModelDynamicsGetPosition(b, q);
    MdtHingeSetBodies(joint, McdModelGetBody(a), McdModelGetBody(b));
    MdtHingeSetPosition(joint, (p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2);
    MdtHingeSetAxis(joint, between(-1, 1), between(-1, 1), between(-1, 1));
    MdtHingeEnable(joint);
}

static double energy(void) {
    double sum = 0;
    for (int i = 0; i < count; i++) {
        const MdtBodyID b = McdModelGetBody(box[i]);
        MeVector3 at;
        MdtBodyGetPosition(b, at);
        sum += (double)MdtBodyGetKineticEnergy(b) + (double)MdtBodyGetMass(b) * 10 * (double)at[2];
    }
    return sum;
}

/* The largest gain of energy in a step, of the energy at the start. */
static double largestGain(int steps) {
    double before = energy(), worst = 0;
    const double start = before;
    for (int i = 0; i < steps; i++) {
        MstUniverseStep(u, STEP);
        const double now = energy();
        worst = now - before < worst ? worst : now - before; /* not a number too is worse */
        before = now;
    }
    return worst / start;
}

/* Six boxes on hinges with any axes, thrown on the plane. */
static double throwChain(MeU32 number) {
    begin(number);
    for (int i = 0; i < 6; i++) {
        const double size[3] = {between(.1, .6), between(.1, .6), between(.1, .6)}, at[3] = {.7 * i, 0, between(.5, 1)};
        const MdtBodyID b = addBox(size, at);
        MdtBodySetQuaternion(b, between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1));
        MdtBodySetLinearVelocity(b, between(-20, 20), between(-20, 20), between(-20, 0));
        MdtBodySetAngularVelocity(b, between(-20, 20), between(-20, 20), between(-20, 20));
    }
    for (int i = 0; i < 5; i++)
        hinge(box[i], box[i + 1]);
    const double gain = largestGain(20);
    return gain;
}

/* Pairs of boxes that fall on each other. */
static double dropPairs(MeU32 number) {
    begin(number);
    for (int i = 0; i < 2; i++) {
        const double x = between(-.5, .5), y = between(-.5, .5), size[3] = {.5, .3, .2};
        for (int k = -1; k <= 1; k += 2) {
            const double at[3] = {x + .3 * k, y, 1 + .8 * i};
            const MdtBodyID b = addBox(size, at);
            MdtBodySetLinearVelocity(b, 0, 0, -20);
            MdtBodySetAngularVelocity(b, between(-9, 9), between(-9, 9), 0);
        }
        hinge(box[count - 2], box[count - 1]);
    }
    const double gain = largestGain(30);
    return gain;
}

#ifdef TEST_IS_SLOW
enum { CHAINS = 4, PILES = 8, GAINED_CHAINS = 0, GAINED_PILES = 2 };
#else
enum { CHAINS = 12, PILES = 40, GAINED_CHAINS = 1, GAINED_PILES = 8 };
#endif

/* The gain of the first seeds, and of those that have gained. */
static void assertNoGain(double gainOf(MeU32), MeU32 number, const MeU32 gained[], int numGained) {
    for (MeU32 i = 0; i < number; i++)
        assert_below(gainOf(i), 1e-3);
    for (int i = 0; i < numGained; i++)
        assert_below(gainOf(gained[i]), 1e-3);
    messages_forget(); /* in double a pile warns that its step could not be solved */
}

/* 125: a pass that turned bodies by half a turn, where all laws were met, was taken as the answer. */
TEST(swept_boxes_on_hinges_gain_no_energy) {
    static const MeU32 gained[] = {125};
    assertNoGain(throwChain, CHAINS, gained, GAINED_CHAINS);
}

/* A part of 5e-10 s made 5e5 J to 1e13 J of a joint's error. 2618: as above; 1136, 3227: the
 * tangent problem of bodies that turned by half a radian; the others: contacts kept a joint open. */
TEST(swept_pairs_on_hinges_do_not_explode) {
    static const MeU32 gained[] = {851, 1384, 2618, 3859, 64, 3313, 1136, 3227};
    assertNoGain(dropPairs, PILES, gained, GAINED_PILES);
}

/* A joint that is open by x closes by x (1 - (1 - gamma)^s) in the share s of a step, however small. */
TEST(a_part_corrects_its_share_of_an_error) {
    static const double part[] = {1e-2, 1e-3, 1e-4};
    const double open = .01;
    for (int i = 0; i < 3; i++) {
        MeVector3 at, v;
        MdtWorldID w = MdtWorldCreate(1, 1, 1, 1);
        MdtBodyID b = MdtBodyCreate(w);
        MdtBSJointID joint = MdtBSJointCreate(w);
        MdtWorldSetEpsilon(w, 0);
        MdtWorldSetMinSafeTime(w, 1e-9);
        MdtBSJointSetBodies(joint, b, 0);
        MdtBSJointSetPosition(joint, 0, 0, 0);
        MdtBSJointEnable(joint);
        MdtBodyEnable(b);
        MdtBodySetPosition(b, open, 0, 0);
        MdtBodySetSafeTime(b, part[i] * STEP);
        MdtWorldStepSafeTime(w, STEP);
        const double closed = open * (1 - pow(1 - (double)MdtWorldGetGamma(w), part[i]));
        MdtBodyGetPosition(b, at);
        MdtBodyGetLinearVelocity(b, v);
        assert_near(open - (double)at[0], closed, open * TOL(1e-7, 1e-10));
        ck_assert(v[0] <= 0 && (double)-v[0] <= (1 + 1e-5) * closed / (part[i] * STEP)); /* it gives no other energy */
        MdtWorldDestroy(w);
    }
}
