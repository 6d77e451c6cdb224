/* Advice (MstAdvise.h): what it says of scenes of which the answer is known, that it changes nothing, and what it does
 * about copies that crash, hang or end. Judged by counted work, which is the same on every machine. */
#include "universe.h"
#include <signal.h>
#include <unistd.h>

enum { MAX = 32 };

static const MeReal step = 1. / 60;

/* ---- asking ------------------------------------------------------------------------------------------------------ */

static MstAdvice advice;
static MstTrial trial[MAX];
static int told;

static void MEAPI keep(const MstAdvice *a, void *userdata) {
    ck_assert_int_le(a->count, MAX);
    memcpy(trial, a->trial, (size_t)a->count * sizeof *trial);
    advice = *a;
    advice.trial = trial;
    told += *(int *)userdata;
}

static MstAdviceParams paramsOf(double seconds) {
    MstAdviceParams p;
    MstAdviceParamsReset(&p);
    p.seconds = (MeReal)seconds;
    p.byWork = METRUE;
    return p;
}

static void ask(const MstAdviceParams *p) {
    static int one = 1;
    told = 0;
    ck_assert(MstAdvise(u, p, keep, &one));
    while (told == 0) /* in copies for ever: they end in their last step */
        MstUniverseStep(u, step);
    ck_assert_int_eq(told, 1);
}

/* The trial of this setting. */
static const MstTrial *tried(const char *setting) {
    for (int i = 0; i < advice.count; i++)
        if (strstr(trial[i].setting, setting) && strncmp(trial[i].setting, "together", 8) != 0)
            return &trial[i];
    ck_abort_msg("there is no trial of %s", setting);
    return 0;
}

static MeBool isFollowed(const char *setting) {
    for (int i = 0; i < advice.followCount; i++)
        if (strstr(trial[advice.follow[i]].setting, setting))
            return METRUE;
    return MEFALSE;
}

/* ---- scenes ------------------------------------------------------------------------------------------------------ */

static void create(double lengthScale) {
    MstUniverseSizes sizes = MstUniverseGrowingSizes;
    sizes.lengthScale = (MeReal)lengthScale;
    universe_begin(&sizes);
    MdtWorldSetGravity(u->world, 0, 0, -9.81);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), 0.5, 0);
    universe_addFloor();
}

static McdModelID addBox(double side, double x, double z) {
    const McdModelID m = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, side, side, side), 1);
    McdModelDynamicsSetPosition(m, x, 0, z);
    return m;
}

/* Boxes that fall flat on the floor, each for itself: met in time or not, they lie there. */
static void createFallingBoxes(void) {
    create(1);
    for (int i = 0; i < 6; i++)
        addBox(1, 2 * i, .6 + .05 * i);
}

/* Boxes that slide to a halt, side by side in one partition, each with a blow and a stop of its own. */
static void createSlidingBoxes(void) {
    create(1);
    for (int i = 0; i < 8; i++) {
        const McdModelID box = addBox(1, 1.005 * i, .5);
        McdModelDynamicsSetLinearVelocity(box, .1 * (8 - i), 0, 0);
    }
}

/* Two rods on hinges that swing through, from the horizontal. */
static void createDoublePendulum(void) {
    MdtBodyID before = 0;
    create(1);
    for (int i = 0; i < 2; i++) {
        const McdModelID rod = MstModelAndBodyCreate(u, McdBoxCreate(u->frame, 0.9, 0.1, 0.1), 1000);
        const MdtBodyID body = McdModelGetBody(rod);
        MdtHingeID hinge = MdtHingeCreate(u->world);
        McdModelDynamicsSetPosition(rod, .5 + i, 0, 5);
        MdtHingeSetBodies(hinge, body, before);
        MdtHingeSetPosition(hinge, (MeReal)i, 0, 5);
        MdtHingeSetAxis(hinge, 0, 1, 0);
        MdtHingeEnable(hinge);
        before = body;
    }
}

/* FNV-1a over all bodies' places and motion. */
static MeU32 stateHash(void) {
    MeU32 hash = 2166136261u;
    for (MdtBodyID b = MdtBodyGetFirst(u->world); b; b = MdtBodyGetNext(b)) {
        MeVector3 v[2];
        MdtBodyGetLinearVelocity(b, v[0]);
        MdtBodyGetAngularVelocity(b, v[1]);
        const unsigned char *part[] = {(const unsigned char *)MdtBodyGetTransformPtr(b), (const unsigned char *)v};
        const size_t size[] = {sizeof(MeMatrix4), sizeof v};
        for (int k = 0; k < 2; k++)
            for (size_t i = 0; i < size[k]; i++)
                hash = (hash ^ part[k][i]) * 16777619u;
    }
    return hash;
}

/* ---- what it says ------------------------------------------------------------------------------------------------ */

/* A blow or a stop that comes up to a step late costs millimetres. */
TEST(timed_contacts_are_waste_where_millimetres_are_nothing) {
    createSlidingBoxes();
    MstAdviceParams p = paramsOf(.5);
    p.tolerance = (MeReal)0.02;
    ask(&p);
    const MstTrial *t = tried("MdtWorldSetTimedContacts(world, 0)");
    ck_assert_int_eq(t->verdict, MstVerdictTake);
    assert_below(t->ratio, 1); /* .09 to .83: which sticks first is chance */
    assert_below(t->error, .02);
    ck_assert_int_gt(advice.best, 0);
    ck_assert_int_gt(advice.followCount, 0);
    ck_assert(trial[advice.best].ratio <= t->ratio);
    ck_assert_int_eq(advice.bodies, 8);
    ck_assert_int_eq(t->steps, 30);
}

TEST(timed_contacts_are_needed_where_they_are_not) {
    createSlidingBoxes();
    const MstAdviceParams p = paramsOf(.5); /* a millimetre */
    ask(&p);
    const MstTrial *t = tried("MdtWorldSetTimedContacts(world, 0)");
    ck_assert_int_eq(t->verdict, MstVerdictTrade);
    assert_below(.001, t->error);
    ck_assert(!isFollowed("MdtWorldSetTimedContacts"));
}

TEST(sub_steps_that_are_needed_are_found) {
    createDoublePendulum();
    MdtWorldSetIntegratorOrder(u->world, 4); /* else order 4 is cheaper than sub-steps */
    MdtBodySetAngularVelocityDamping(MdtBodyGetFirst(u->world), 1e-3);
    const MstAdviceParams p = paramsOf(1.5);
    ask(&p);
    assert_below(advice.tolerance, trial[0].error);
    const MstTrial *two = tried("MdtWorldSetSubSteps(world, 2)"), *four = tried("MdtWorldSetSubSteps(world, 4)");
    /* errors fall with the square */
    ck_assert_int_eq(four->verdict, MstVerdictMend);
    ck_assert_int_eq(two->verdict, MstVerdictExact);
    ck_assert(isFollowed("MdtWorldSetSubSteps(world, 4)"));
}

TEST(sub_steps_that_are_waste_are_found) {
    createFallingBoxes();
    MdtWorldSetSubSteps(u->world, 4);
    const MstAdviceParams p = paramsOf(.5);
    ask(&p);
    ck_assert_int_eq(tried("MdtWorldSetSubSteps(world, 1)")->verdict, MstVerdictTake);
    ck_assert(isFollowed("MdtWorldSetSubSteps(world, 1)"));
    ck_assert_int_eq(trial[advice.best].verdict, MstVerdictTake);
}

TEST(a_ball_that_flies_needs_nothing) {
    create(1);
    const McdModelID ball = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, 0.5), 1);
    McdModelDynamicsSetPosition(ball, 0, 0, 50);
    const MstAdviceParams p = paramsOf(.5);
    ask(&p);
    ck_assert_int_eq(advice.best, 0);
    for (int i = 0; i < advice.count; i++)
        ck_assert_msg(trial[i].verdict == MstVerdictNone, "%s: %s", trial[i].setting, trial[i].advice);
}

/* A ball of 10 cm at 120 m/s, and a wall of 2 cm: without continuous motion it is behind it. */
TEST(a_bullet_is_to_be_swept) {
    create(1);
    static MeMatrix4 wallPlace;
    MeMatrix4TMMakeIdentity(wallPlace);
    wallPlace[3][0] = 5;
    MstFixedModelCreate(u, McdBoxCreate(u->frame, 0.02, 10, 10), wallPlace);
    const McdModelID ball = MstModelAndBodyCreate(u, McdSphereCreate(u->frame, 0.05), 1000);
    McdModelDynamicsSetPosition(ball, 0, 0, 3);
    McdModelDynamicsSetLinearVelocity(ball, 120, 0, 0);
    const MstAdviceParams p = paramsOf(.2);
    ask(&p);
    assert_below(5, trial[0].error); /* it flies on */
    const MstTrial *t = tried("McdModelSetSwept(model, METRUE) of all 1");
    ck_assert_int_eq(t->verdict, MstVerdictMend);
    ck_assert(isFollowed("McdModelSetSwept"));
}

TEST(scales_that_are_wrong_are_named) {
    create(1);
    for (int i = 0; i < 4; i++)
        addBox(.01, .02 * i, .008);
    const MstAdviceParams p = paramsOf(.2);
    ask(&p);
    (void)tried("MstUniverseSizes.lengthScale = 0.017");
}

/* ---- what it leaves ---------------------------------------------------------------------------------------------- */

static int steps, calls;

/* The program's own state, on which its scene depends. */
static MeBool MEAPI push(McdIntersectResult *result, McdContact *colC, MdtContactID dynC) {
    (void)result, (void)colC, (void)dynC;
    calls++;
    return METRUE;
}

static void runProgram(int count) {
    for (int i = 0; i < count; i++) {
        MdtBodyAddForce(MdtBodyGetFirst(u->world), steps % 7 + .01 * (calls % 13), 0, 0);
        MstUniverseStep(u, step);
        steps++;
    }
}

static MeU32 hashAfterProgram(MeBool withAdvice, int *callsMade) {
    static int one = 1;
    createFallingBoxes();
    MstBridgeSetPerContactCB(u->bridge, 0, 0, push);
    steps = calls = 0;
    runProgram(20);
    if (withAdvice) {
        MstAdviceParams p = paramsOf(.25);
        p.after = (MeReal)0.1;
        told = 0;
        ck_assert(MstAdvise(u, &p, keep, &one));
        ck_assert(!MstAdviseIsCopy(u));
    }
    runProgram(40);
    const MeU32 hash = stateHash();
    *callsMade = calls;
    ck_assert_int_eq(steps, 60);
    return hash;
}

TEST(nothing_is_changed_by_it_to_the_last_bit) {
    int callsWithout, callsWith;
    const MeU32 without = hashAfterProgram(MEFALSE, &callsWithout), with = hashAfterProgram(METRUE, &callsWith);
    ck_assert_int_eq(told, 1);
    ck_assert_int_gt(advice.count, 5);
    ck_assert_int_eq(trial[0].steps, 15);
    ck_assert_uint_eq(with, without);
    ck_assert_int_eq(callsWith, callsWithout);
    ck_assert_int_gt(callsWithout, 0);
}

TEST(it_says_the_same_again_and_with_workers) {
    const MstAdviceParams p = paramsOf(.3);
    MstTrial before[MAX];
    createFallingBoxes();
    ask(&p);
    const int count = advice.count;
    memcpy(before, trial, sizeof before);
    createFallingBoxes();
    MeTaskPoolID pool = MeTaskPoolCreate(2);
    MdtWorldSetTaskPool(u->world, pool);
    ask(&p);
    ck_assert_int_eq(advice.count, count);
    for (int i = 0; i < count; i++) {
        ck_assert_str_eq(trial[i].setting, before[i].setting);
        ck_assert(trial[i].error == before[i].error && trial[i].work == before[i].work &&
                  trial[i].verdict == before[i].verdict);
    }
    MstUniverseStep(u, step); /* the workers are still there */
    ck_assert_int_eq(MdtWorldGetWorkerCount(u->world), 2);
    MeTaskPoolDestroy(pool);
}

/* ---- copies that go wrong ---------------------------------------------------------------------------------------- */

typedef enum Mishap { CRASH, HANG, END } Mishap;
static Mishap mishap;

/* In copies that do not meet contacts in time only. */
static MeBool MEAPI failSometimes(McdIntersectResult *result, McdContact *colC, MdtContactID dynC) {
    (void)result, (void)colC, (void)dynC;
    if (!MstAdviseIsCopy(u) || (mishap != END && MdtWorldGetTimedContacts(u->world) > 0))
        return METRUE;
    if (mishap == CRASH)
        raise(SIGKILL);
    for (; mishap == HANG;)
        pause();
    _exit(0);
}

LOOP_TEST(a_copy_that_goes_wrong_is_reported, CRASH, END + 1) {
    mishap = (Mishap)_i;
    createFallingBoxes();
    MstBridgeSetPerContactCB(u->bridge, 0, 0, failSometimes);
    MstAdviceParams p = paramsOf(.25);
    p.patience = 30;
    ask(&p);
    if (mishap == END) { /* all of them, at the same step: that many are compared */
        ck_assert(advice.restriction[0]);
        ck_assert_int_lt(trial[0].steps, 15);
        ck_assert_int_gt(trial[0].steps, 0);
    } else {
        const MstTrial *t = tried("MdtWorldSetTimedContacts(world, 0)");
        ck_assert_int_eq(t->verdict, MstVerdictFailed);
        ck_assert_int_lt(t->steps, 15);
        ck_assert_int_eq(trial[0].steps, 15);
    }
}

TEST(bad_input_is_refused) {
    MstAdviceParams p = paramsOf(1);
    create(1);
    assert_none(MstAdvise, 0, 0, 0, 0);
    assert_none(MstAdviseIsCopy, 0);
    assert_refused(MstAdviceParamsReset, 0);
    assert_refused(MstAdvicePrint, 0);
    p.seconds = 0;
    ck_assert(!MstAdvise(u, &p, 0, 0));
    assert_warned("seconds");
    p = paramsOf(1);
    p.rounds = 16;
    ck_assert(!MstAdvise(u, &p, 0, 0));
    assert_warned("rounds");
    p = paramsOf(1);
    p.patience = 0;
    ck_assert(!MstAdvise(u, &p, 0, 0));
    assert_warned("patience");
    p = paramsOf(1);
    p.after = -1;
    ck_assert(!MstAdvise(u, &p, 0, 0));
    assert_warned("after");
    p = paramsOf(1);
    p.tolerance = (MeReal)NAN;
    ck_assert(!MstAdvise(u, &p, 0, 0));
    assert_warned("tolerance");
    ck_assert(MstAdvise(u, 0, 0, 0));
    ck_assert(!MstAdvise(u, 0, 0, 0));
    assert_warned("earlier");
    universe_end(NULL); /* with what was asked */
}
