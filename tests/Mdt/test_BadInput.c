/* Whatever a program passes: a message, a neutral result, and a world that still steps and stays finite. */
#include "scene.h"

static const MeReal bad[] = {NAN, INFINITY, -INFINITY};

static MdtWorldID w;
static MdtBodyID b;
static MdtHingeID hinge;
static MdtContactID contact;

static void setUp(void) {
    w = scene_open(3, 4, 10);
    b = scene_body(w, 1, 1, 0, 0);
    hinge = scene_hinge(w, b, 0, 0, 0, 0, 0, 0, 1);
    contact = MdtContactCreate(w, b, 0);
}

/* The world steps, silently, and stays finite. */
static void tearDown(void) {
    caught.warnings = 0;
    for (int i = 0; i < 60; i++) {
        MdtWorldStep(w, FRAME);
        for (int r = 0; r < 4; r++)
            for (int c = 0; c < 4; c++)
                ck_assert(isfinite(MdtBodyGetTransformPtr(b)[r][c]));
    }
    assert_silent();
    MdtWorldDestroy(w);
}

TEST(numbers_that_are_not_finite_change_nothing) {
    setUp();
    for (int i = 0; i < 3; i++) {
        const MeReal x = bad[i];
        MeVector3 v;
        assert_refused(MdtBodySetPosition, b, x, 0, 0);
        assert_refused(MdtBodySetQuaternion, b, 1, 0, x, 0);
        assert_refused(MdtBodySetLinearVelocity, b, 0, x, 0);
        assert_refused(MdtBodySetAngularVelocity, b, 0, 0, x);
        assert_refused(MdtBodySetMass, b, x);
        assert_refused(MdtBodySetSphericalInertiaTensor, b, x);
        assert_refused(MdtBodySetLinearVelocityDamping, b, x);
        assert_refused(MdtBodySetAngularVelocityDamping, b, x);
        assert_refused(MdtBodySetFastSpinAxis, b, 1, x, 0);
        assert_refused(MdtBodySetSafeTime, b, x);
        assert_refused(MdtBodyAddForce, b, x, 0, 0);
        assert_refused(MdtBodyAddForceAtPosition, b, 1, 0, 0, x, 0, 0);
        assert_refused(MdtBodyAddTorque, b, 0, x, 0);
        assert_refused(MdtBodyAddImpulse, b, 0, x, 0);
        assert_refused(MdtBodyAddImpulseAtPosition, b, 0, x, 0, 0, 0, 0);
        v[0] = x, v[1] = v[2] = 0;
        assert_refused(MdtBodySetCenterOfMassRelativePosition, b, v);
        assert_refused(MdtBodySetCenterOfMassPosition, b, v);
        assert_refused(MdtHingeSetPosition, hinge, x, 0, 0);
        assert_refused(MdtHingeSetAxis, hinge, x, 0, 0);
        assert_refused(MdtContactSetPosition, contact, x, 0, 0);
        assert_refused(MdtContactSetNormal, contact, 0, x, 0);
        assert_refused(MdtContactSetDirection, contact, 0, x, 0);
        assert_refused(MdtContactSetPenetration, contact, x);
        MdtContactParamsSetFriction(MdtContactGetParams(contact), x);
        assert_warned("Friction");
        MdtContactParamsSetRestitution(MdtContactGetParams(contact), x);
        assert_warned("Restitution");
        MdtContactParamsSetSlip(MdtContactGetParams(contact), x);
        assert_warned("Slip");
        MdtContactParamsSetPrimarySlide(MdtContactGetParams(contact), x);
        assert_warned("Slide");
        assert_refused(MdtLimitSetLimitedForceMotor, MdtHingeGetLimit(hinge), x, 1);
        assert_refused(MdtLimitSetPosition, MdtHingeGetLimit(hinge), x);
        assert_refused(MdtSingleLimitSetStop, MdtLimitGetLowerLimit(MdtHingeGetLimit(hinge)), x);
        assert_refused(MdtSingleLimitSetStiffness, MdtLimitGetLowerLimit(MdtHingeGetLimit(hinge)), x);
        assert_refused(MdtWorldSetGravity, w, x, 0, 0);
        assert_refused(MdtWorldSetEpsilon, w, x);
        assert_refused(MdtWorldSetGamma, w, x);
        assert_refused(MdtConstraintSetWorldLinearVelocity, MdtHingeQuaConstraint(hinge), x, 0, 0);
    }
    MeVector3 p;
    MdtBodyGetPosition(b, p);
    assert_vec3_near(p, 1, 0, 0, 0);
    ck_assert(MdtBodyGetMass(b) == 1);
    tearDown();
}

TEST(masses_and_tensors_that_no_body_has) {
    setUp();
    const MeReal masses[] = {0, -1};
    for (int i = 0; i < 2; i++) {
        MdtBodySetMass(b, masses[i]);
        assert_warned("positive");
        MdtBodySetSphericalInertiaTensor(b, masses[i]);
        assert_warned("positive");
    }
    const MeMatrix3 tensors[] = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}},   {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                                 {{1, 2, 0}, {2, 1, 0}, {0, 0, 1}},   {{1, .5, 0}, {0, 1, 0}, {0, 0, 1}},
                                 {{1, 0, 0}, {0, NAN, 0}, {0, 0, 1}}, {{1e-39, 0, 0}, {0, 1e-39, 0}, {0, 0, 1e-39}}};
    for (int i = 0; i < 6; i++) {
        MdtBodySetInertiaTensor(b, tensors[i]);
        assert_warned("positive definite");
    }
    MeMatrix3 I;
    MdtMakeInertiaTensorSphere(0, 1, I);
    assert_warned("mass");
    assert_near(I[0][0], 1, 0);
    MdtMakeInertiaTensorBox(1, 1, -1, 1, I);
    assert_warned("edge");
    tearDown();
}

TEST(axes_and_orientations_without_direction) {
    setUp();
    const MeMatrix3 skew = {{1, 0, 0}, {0, 1, 0}, {0, 1, 1}}, mirror = {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
    MdtHingeSetAxis(hinge, 0, 0, 0);
    assert_warned("zero");
    MdtConstraintSetAxes(MdtHingeQuaConstraint(hinge), 1, 0, 0, 2, 0, 0);
    assert_warned("parallel");
    MdtContactSetNormal(contact, 0, 0, 0);
    assert_warned("length");
    MdtContactSetDirection(contact, 0, 3, 0);
    assert_warned("along the normal");
    MdtBodySetFastSpinAxis(b, 0, 0, 0);
    assert_warned("axis");
    MdtBodySetQuaternion(b, 0, 0, 0, 0);
    assert_warned("no orientation");
    MdtBodySetOrientation(b, skew);
    assert_warned("no rotation");
    MdtBodySetOrientation(b, mirror);
    assert_warned("no rotation");
    tearDown();
}

TEST(steps_that_are_none) {
    setUp();
    const MeReal hs[] = {0, -.1, NAN, INFINITY};
    for (int i = 0; i < 4; i++) {
        MdtWorldStep(w, hs[i]);
        assert_warned("step size");
        MdtWorldStepSafeTime(w, hs[i]);
        assert_warned("step size");
    }
    MeVector3 p;
    MdtBodyGetPosition(b, p);
    assert_vec3_near(p, 1, 0, 0, 0);
    tearDown();
}

TEST(parameters_out_of_range) {
    setUp();
    MdtWorldSetEpsilon(w, -1);
    assert_warned("epsilon");
    MdtWorldSetGamma(w, 2);
    assert_warned("gamma");
    MdtWorldSetGamma(w, -.1);
    assert_warned("gamma");
    MdtWorldSetGammaWithRefTimeStep(w, .2, 0, 1);
    assert_warned("reference step");
    MdtWorldSetAutoDisableVelocityThreshold(w, -1);
    assert_warned("threshold");
    MdtWorldSetAutoDisableAliveWindow(w, -1);
    assert_warned("alive window");
    MdtWorldSetMinSafeTime(w, 0);
    assert_warned("safe time");
    MdtWorldSetMaxLCPIterations(w, -1);
    assert_warned("iterations");
    MdtBodySetSortKey(b, -1);
    assert_warned("sort key");
    MdtHingeSetSortKey(hinge, -1);
    assert_warned("sort key");
    MdtBodySetLinearVelocityDamping(b, -1);
    assert_warned("damping");
    MdtContactParamsSetRestitution(MdtContactGetParams(contact), 2);
    assert_warned("Restitution");
    MdtContactParamsSetType(MdtContactGetParams(contact), (MdtContactType)7);
    assert_warned("contact type");
    MdtContactParamsSetFrictionModel(MdtContactGetParams(contact), (MdtFrictionModel)7);
    assert_warned("friction model");
    MdtHingeGetBody(hinge, 2);
    assert_warned("body index");
    ck_assert(MdtBodyGetSortKey(b) == 0 && MdtWorldGetEpsilon(w) == (MeReal)1e-4);
    tearDown();
}

TEST(null_results_and_callbacks_are_refused) {
    setUp();
    MdtBodyGetPosition(b, 0);
    assert_warned("result is null");
    MdtHingeGetPosition(hinge, 0);
    assert_warned("result is null");
    MdtHingeSetLimit(hinge, 0);
    assert_warned("limit is null");
    MdtWorldForAllConstraints(w, 0, 0);
    assert_warned("callback is null");
    tearDown();
}

TEST(more_than_the_world_was_created_for) {
    setUp();
    MdtBodyID made[4];
    for (int i = 0; i < 2; i++)
        ck_assert((made[i] = MdtBodyCreate(w)) != NULL);
    assert_silent();
    ck_assert(MdtBodyCreate(w) == NULL);
    assert_warned("maxBodies");
    MdtBodyDestroy(made[1]);
    ck_assert(MdtBodyCreate(w) != NULL); /* there is room again */
    assert_silent();
    ck_assert(MdtBSJointCreate(w) != NULL && MdtContactCreate(w) != NULL && MdtHingeCreate(w) == NULL);
    assert_warned("maxConstraints");
    ck_assert(MdtContactCreate(w, b, 0) == NULL);
    assert_warned("maxConstraints");
    tearDown();
}

TEST(destroyed_handles_are_noticed) {
    setUp();
    MdtBodyID gone = MdtBodyCreate(w);
    MdtBSJointID joint = MdtBSJointCreate(w);
    MdtBodyDestroy(gone);
    MdtBSJointDestroy(joint);
    MdtBodyDestroy(gone);
    assert_warned("destroyed");
    MdtBodySetPosition(gone, 1, 2, 3);
    assert_warned("destroyed");
    MdtBSJointDestroy(joint);
    assert_warned("destroyed");
    MdtBSJointSetBodies(joint, b, 0);
    assert_warned("destroyed");
    MdtHingeSetBodies(hinge, gone, 0);
    assert_warned("destroyed");
    ck_assert(MdtHingeGetBody(hinge, 0) == b);
    tearDown();
}

#if KARMA_CHECK
/* Nothing is read through handles of a destroyed world, or through a pointer that never was a handle. */
TEST(the_check_build_notices_handles_of_destroyed_worlds) {
    MdtWorldID gone = MdtWorldCreate(2, 2);
    MdtBodyID body = MdtBodyCreate(gone);
    MdtHingeID joint = MdtHingeCreate(gone);
    char wild[4096];
    memset(wild, 0x55, sizeof wild);
    MdtWorldDestroy(gone);
    MdtWorldStep(gone, FRAME);
    assert_warned("world has been destroyed");
    MdtWorldDestroy(gone);
    assert_warned("world has been destroyed");
    MdtBodyEnable(body);
    assert_warned("body has been destroyed");
    MdtHingeEnable(joint);
    assert_warned("constraint has been destroyed");
    MdtBodyEnable((MdtBodyID)(void *)wild);
    assert_warned("never was one");
    MdtWorldStep((MdtWorldID)(void *)wild, FRAME);
    assert_warned("never was one");
}
#endif

TEST(attachments_that_make_no_sense) {
    setUp();
    MdtWorldID other = MdtWorldCreate(1, 0);
    MdtBodyID stranger = MdtBodyCreate(other);
    MdtBSJointID j = MdtBSJointCreate(w);
    MdtBSJointEnable(j);
    assert_warned("attached to no body");
    ck_assert(!MdtBSJointIsEnabled(j));
    MdtBSJointSetBodies(j, b, stranger);
    assert_warned("another world");
    MdtBSJointSetBodies(j, b, b);
    assert_warned("the same");
    MdtBSJointSetBodies(j, 0, 0);
    assert_warned("both bodies are null");
    MdtHingeReset((MdtHingeID)(void *)j);
    assert_warned("not a Hinge");
    MdtConstraintSetPosition(MdtContactQuaConstraint(contact), 1, 1, 1);
    assert_warned("MdtContact.h");
    MdtWorldDestroy(other);
    tearDown();
}

TEST(scales_that_are_none_count_as_1) {
    MdtWorldID x = MdtWorldCreate(1, 0, 0, 1);
    assert_warned("length scale");
    MdtWorldID y = MdtWorldCreate(1, 0, 1, NAN);
    assert_warned("mass scale");
    ck_assert(MdtWorldGetDefaultDensity(x) == 1 && MdtWorldGetDefaultDensity(y) == 1);
    ck_assert(MdtWorldCreate(4000000000u, 1) == NULL);
    assert_warned("more than");
    MdtWorldDestroy(x);
    MdtWorldDestroy(y);
}

/* What a program writes into the public structures goes unchecked; the world must bear it. */
TEST(rubbish_in_public_structures_does_not_reach_the_bodies) {
    setUp();
    MdtBclContactParams *p = MdtContactGetParams(contact);
    MdtBclLimit *limit = MdtHingeGetLimit(hinge);
    const MeReal rubbish[] = {NAN, INFINITY, -1e30, 1e30, -1};
    MdtContactEnable(contact);
    for (int i = 0; i < 5; i++) {
        const MeReal x = rubbish[i];
        p->type = MdtContactTypeFriction2D;
        p->options = 511;
        p->friction1 = p->friction2 = p->FrictionCoefficient = p->restitution = p->velThreshold = x;
        p->softness = p->max_adhesive_force = p->slip1 = p->slip2 = p->slide1 = p->slide2 = x;
        limit->bActive = limit->bPowered = 1;
        limit->desired_vel = limit->fmax = limit->offset = limit->stiffnessThreshold = x;
        for (int k = 0; k < 2; k++) {
            limit->limit[k].stop = limit->limit[k].stiffness = limit->limit[k].damping = x;
            limit->limit[k].restitution = x;
        }
        for (int n = 0; n < 5; n++)
            MdtWorldStep(w, FRAME);
        for (int c = 0; c < 3; c++)
            ck_assert_msg(isfinite(MdtBodyGetTransformPtr(b)[3][c]), "rubbish %g", x);
        ck_assert(caught.fatal == 0);
        MdtBodySetPosition(b, 1, 0, 0);
        MdtBodySetQuaternion(b, 1, 0, 0, 0);
        MdtBodySetLinearVelocity(b, 0, 0, 0);
        MdtBodySetAngularVelocity(b, 0, 0, 0);
    }
    MdtContactReset(contact);
    MdtHingeReset(hinge);
    tearDown();
}

/* Forces beyond all measure stop the body where it is; the others move on. */
/* What is asked by a vector that is no vector, or so large that its product is not. */
TEST(questions_by_no_numbers_are_refused) {
    setUp();
    for (int i = 0; i < 3; i++) {
        MeVector3 asked = {0, bad[i], 0}, answer = {1, 2, 3};
        assert_refused(MdtBodyGetVelocityAtPoint, b, asked, answer);
        assert_vec3_near(answer, 0, 0, 0, 0);
        assert_refused(MdtConvertVector, b, asked, 0, answer);
        assert_refused(MdtConvertPositionVector, b, asked, 0, answer);
    }
    MeVector3 far = {3e38, -3e38, 3e38};
    MdtBodySetQuaternion(b, .5, .5, .5, .5);
    MdtConvertPositionVector(b, far, b, far);
    for (int i = 0; i < 3; i++)
        ck_assert(!isnan(far[i]));
    tearDown();
}

/* Smaller than numbers of single precision can be: what is divided by it is infinite. */
TEST(numbers_that_are_all_but_0_are_not_positive) {
    setUp();
    const MeReal tiny = 1e-39;
    assert_refused(MdtBodySetMass, b, tiny);
    assert_refused(MdtWorldStep, w, tiny);
    MdtWorldID small = MdtWorldCreate(1, 1, tiny, tiny);
    assert_warned("scale");
    MdtWorldDestroy(small);
    tearDown();
}

#ifndef _ME_API_DOUBLE /* which has room for what input can be */
TEST(overflow_stops_only_its_partition) {
    setUp();
    MdtBodyID other = scene_body(w, 1, 5, 5, 5);
    MdtHingeDisable(hinge);
    MdtBodySetMass(b, 1.2e-38);
    for (int i = 0; i < 40; i++)
        MdtBodyAddForce(b, MEINFINITY, 0, 0);
    MdtWorldStep(w, FRAME);
    MeVector3 v;
    MdtBodyGetLinearVelocity(other, v);
    assert_near(v[1], -10 * (double)FRAME, TOL(1e-6, 2e-9));
    MdtBodySetMass(b, 1);
    MdtBodySetPosition(b, 1, 0, 0);
    MdtBodySetLinearVelocity(b, 0, 0, 0);
    tearDown();
}
#endif
