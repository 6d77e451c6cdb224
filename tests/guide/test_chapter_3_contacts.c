/* Dynamics guide, chapter 3, "Constraints: Joints and Contacts", its second half: contacts, friction, and the program
 * Bounce. */
#include "Mdt/behaviour.h"

static MdtWorldID world;
static MdtBodyID body;
static const MeReal step = 1.0 / 60;

static MdtContactID contact;

/* A body on the plane y = 0, with gravity, touching it at its centre of mass. */
static void beginOnPlane(void) {
    world = MdtWorldCreate(2, 8);
    MdtWorldSetAutoDisable(world, 0);
    MdtWorldSetGravity(world, 0, -(MeReal)(9.8), 0);
    body = MdtBodyCreate(world);
    MdtBodyEnable(body);
    contact = MdtContactCreate(world);
    MdtContactSetBodies(contact, body, 0);
    MdtContactSetNormal(contact, 0, 1, 0);
    MdtContactEnable(contact);
}

/* As collision detection would, the contact is kept under the body. */
static void push(double fx, double fz, int n) {
    while (n--) {
        MdtContactSetPosition(contact, coordinate(body, 0), 0, coordinate(body, 2));
        MdtContactSetPenetration(contact, -coordinate(body, 1));
        MdtBodyAddForce(body, fx, 0, fz);
        MdtWorldStep(world, step);
    }
}

/* "Creating Contacts: MdtContact": "there is no relative motion in the direction opposite to the contact normal"; up
 * to three forces are present. */
TEST(creating_contacts) {
    beginOnPlane();
    for (int type = MdtContactTypeFrictionZero; type <= MdtContactTypeFriction2D; type++) {
        MdtContactParamsSetType(MdtContactGetParams(contact), (MdtContactType)type);
        push(0, 0, 60);
        assert_near(velocity(body, 1), 0, TOL(1e-6, 3e-8));
        assert_near(forceOn(MdtContactQuaConstraint(contact), 0, 1), 9.8, TOL(2e-5, 2e-6));
        ck_assert_int_eq(MdtConstraintGetRowCount(MdtContactQuaConstraint(contact)), 1 + type);
    }
    MdtBodySetLinearVelocity(body, 0, 1, 0); /* away it may go */
    push(0, 0, 1);
    assert_near(velocity(body, 1), 1 - 9.8 * (double)step, TOL(1e-5, 8e-9));
    MdtWorldDestroy(world);
}

/* "Friction in MdtKea": frictionless, infinite friction, box friction, normal force friction. */
TEST(friction_modes) {
    beginOnPlane();
    MdtContactParamsID params = MdtContactGetParams(contact);
    const double t = 60 * (double)step;
    push(2, 0, 60); /* "free to slide over each other" */
    assert_near(velocity(body, 0), 2 * t, TOL(1e-4, 2e-8));
    MdtBodySetLinearVelocity(body, 0, 0, 0);

    MdtContactParamsSetType(params, MdtContactTypeFriction2D);
    push(1000, 0, 60); /* "can not slide over each other at all" */
    assert_near(velocity(body, 0), 0, 2e-2);

    MdtBodySetLinearVelocity(body, 0, 0, 0);
    MdtContactParamsSetFriction(params, 3); /* "equivalent to setting f_smax to a constant value" */
    push(2.9, 0, 60);
    assert_near(velocity(body, 0), 0, 1e-4);
    push(4, 0, 60);
    assert_near(velocity(body, 0), 1 * t, 1e-3);
    MdtWorldSetGravity(world, 0, -98, 0); /* "it does not depend on the normal force" */
    MdtBodySetLinearVelocity(body, 0, 0, 0);
    push(4, 0, 60);
    assert_near(velocity(body, 0), 1 * t, TOL(6e-6, 9e-9));

    MdtBodySetLinearVelocity(body, 0, 0, 0); /* "multiplying the coefficient of friction by the normal force" */
    MdtContactParamsSetPrimaryFrictionModel(params, MdtFrictionModelNormalForce);
    MdtContactParamsSetSecondaryFrictionModel(params, MdtFrictionModelNormalForce);
    MdtContactParamsSetFrictionCoeffecient(params, .5);
    push(48, 0, 60);
    assert_near(velocity(body, 0), 0, 1e-2);
    push(50, 0, 60);
    assert_near(velocity(body, 0), 1 * t, 2e-2);
    MdtWorldDestroy(world);
}

/* "Coulomb Friction" in the numbers of its figure: at rest f balances the force, in motion f = mu N, however fast. */
TEST(coulomb_friction) {
    beginOnPlane();
    MdtContactParamsID params = MdtContactGetParams(contact);
    const double mu = .25, max = mu * 9.8;
    MdtContactParamsSetType(params, MdtContactTypeFriction2D);
    MdtContactParamsSetFrictionModel(params, MdtFrictionModelNormalForce);
    MdtContactParamsSetFrictionCoeffecient(params, mu);
    for (int i = 1; i <= 9; i++) {
        push(0, max * i / 10, 10);
        assert_near(forceOn(MdtContactQuaConstraint(contact), 0, 2), -max * i / 10, TOL(8e-6, 3e-6));
    }
    for (int speed = 1; speed <= 100; speed *= 10) {
        MdtBodySetLinearVelocity(body, 0, 0, (MeReal)speed);
        push(0, 0, 1);
        assert_near(forceOn(MdtContactQuaConstraint(contact), 0, 2), -max, TOL(5e-6, 3e-8));
    }
    MdtWorldDestroy(world);
}

/* "Slip: An Alternate Way to Model Friction": "an applied force will result in a relative velocity", force times slip;
 * and slidiness: "one body will act like a conveyer belt". */
TEST(slip_and_slide) {
    beginOnPlane();
    MdtContactParamsID params = MdtContactGetParams(contact);
    MdtContactSetDirection(contact, 1, 0, 0);
    MdtContactParamsSetType(params, MdtContactTypeFriction2D);
    params->slip1 = (MeReal).0005; /* "defined in the MdtBclContactParams structure" */
    params->options |= MdtBclContactOptionSlip1;
    for (int force = 10; force <= 1000; force *= 10) {
        push(force, 0, 5);
        assert_near_rel(velocity(body, 0), .0005 * force, TOL(8e-6, 2e-6));
        push(force, 0, 30);
        assert_near_rel(velocity(body, 0), .0005 * force, TOL(2e-5, 5e-6)); /* "it does not accelerate" */
    }
    MdtContactParamsSetPrimarySlip(params, 0);
    MdtContactParamsSetPrimarySlide(params, 2);
    push(0, 0, 30);
    assert_near(fabs(velocity(body, 0)), 2, TOL(4e-6, 4e-7));
    MdtWorldDestroy(world);
}

/* "Functions that are specific to Contacts". */
TEST(contact_accessors_and_mutators) {
    beginOnPlane();
    MdtContactID nextContact = MdtContactCreate(world);
    MeVector3 v;
    MdtContactSetNormal(contact, 0, 0, 2);
    MdtContactGetNormal(contact, v);
    assert_vec3_near(v, 0, 0, 1, 1e-7);
    MdtContactSetDirection(contact, 3, 0, 0);
    MdtContactGetDirection(contact, v);
    assert_vec3_near(v, 1, 0, 0, 1e-7);
    MdtContactSetPenetration(contact, .125);
    assert_near(MdtContactGetPenetration(contact), .125, 0);
    ck_assert(MdtContactGetNext(contact) == MdtContactInvalidID);
    MdtContactSetNext(contact, nextContact);
    ck_assert(MdtContactGetNext(contact) == nextContact);
    MdtBclContactParams all;
    MdtContactParamsReset(&all);
    all.restitution = (MeReal).5;
    all.options |= MdtBclContactOptionBounce;
    MdtContactSetParams(contact, &all);
    assert_near(MdtContactParamsGetRestitution(MdtContactGetParams(contact)), .5, 0);
    MdtWorldDestroy(world);
}

/* "MdtContactGroups": "all the contacts between two bodies" as one constraint. */
TEST(contact_groups) {
    beginOnPlane();
    MdtContactDestroy(contact);
    MdtContactGroupID group = MdtContactGroupCreate(world);
    MdtContactGroupSetBodies(group, body, 0);
    ck_assert(MdtContactGroupGetFirstContact(group) == 0); /* "NULL if the contact group is empty" */
    MdtContactID corner[4];
    for (int i = 0; i < 4; i++) {
        corner[i] = MdtContactGroupCreateContact(group);
        MdtContactSetPosition(corner[i], i & 1 ? 1 : -1, 0, i & 2 ? 1 : -1);
        MdtContactSetNormal(corner[i], 0, 1, 0);
    }
    ck_assert_int_eq(MdtContactGroupGetCount(group), 4);
    int walked = 0;
    for (MdtContactID c = MdtContactGroupGetFirstContact(group); c; c = MdtContactGroupGetNextContact(group, c))
        ck_assert(c == corner[walked++]);
    ck_assert_int_eq(walked, 4);
    MdtContactGroupEnable(group);
    MdtWorldStep(world, step);
    assert_near(MdtContactGroupGetNormalForce(group), 9.8, 1e-2);
    MdtContactGroupDestroyContact(group, corner[3]);
    MdtContactGroupRemoveContact(group, corner[0]);
    ck_assert_int_eq(MdtContactGroupGetCount(group), 2);
    MdtContactGroupAppendContact(group, corner[0]);
    ck_assert_int_eq(MdtContactGroupGetCount(group), 3);
    ck_assert(MdtContactGroupGetNextContact(group, corner[0]) == 0);
    MdtContactGroupSetSortKey(group, 5);
    ck_assert_int_eq(MdtContactGroupGetSortKey(group), 5);
    MdtWorldDestroy(world);
}

/* "The MdtBclContactParams Structure": members, and the table of default values. */
TEST(contact_params) {
    MdtBclContactParams param;
    memset(&param, 0x55, sizeof param);
    MdtContactParamsReset(&param);
    ck_assert(param.type == MdtContactTypeFrictionZero);
    ck_assert(param.model1 == MdtFrictionModelBox && param.model2 == MdtFrictionModelBox);
    ck_assert(param.restitution == 0 && param.velThreshold == (MeReal)0.001 && param.softness == 0);
    ck_assert(param.max_adhesive_force == 0 && param.slip1 == 0 && param.slip2 == 0);
    ck_assert(param.slide1 == 0 && param.slide2 == 0);
    MdtContactParamsSetType(&param, MdtContactTypeFriction1D);
    MdtContactParamsSetPrimaryFrictionModel(&param, MdtFrictionModelNormalForce);
    ck_assert(param.type == MdtContactTypeFriction1D && param.model1 == MdtFrictionModelNormalForce);
    param.FrictionCoefficient = (MeReal).5;
    assert_near(MdtContactParamsGetPrimaryFrictionCoeffecient(&param), .5, 0);
    param.friction1 = 3;
    param.friction2 = 4;
    ck_assert(MdtContactParamsGetPrimaryFriction(&param) == 3 && MdtContactParamsGetSecondaryFriction(&param) == 4);
}

/* "How to Use Contacts: Bounce.c": the program, from its fragments. */
static const MeReal ballRadius = 1;

static void tick(void) {
    MeVector3 pos;
    MeReal penetration;
    if (contact) {
        MdtContactDisable(contact);
        MdtContactDestroy(contact);
        contact = 0;
    }
    MdtBodyGetPosition(body, pos);
    penetration = 0 - (pos[1] - ballRadius);
    if (penetration > 0) {
        MdtContactParamsID params;
        contact = MdtContactCreate(world, body, 0);
        MdtContactSetPosition(contact, pos[0], pos[1] - ballRadius, pos[2]);
        MdtContactSetNormal(contact, 0, 1, 0);
        MdtContactSetPenetration(contact, penetration);
        params = MdtContactGetParams(contact);
        MdtContactParamsSetType(params, MdtContactTypeFriction2D);
        MdtContactParamsSetFriction(params, 5.0);
        MdtContactParamsSetRestitution(params, 0.6);
        MdtContactEnable(contact);
    }
    MdtWorldStep(world, step);
}

/* "A ball is thrown onto a surface and rebounds each time, with consecutive smaller amplitudes", of the restitution
 * squared; and friction sets it rolling. */
TEST(bounce) {
    world = MdtWorldCreate(1, 1);
    MdtWorldSetAutoDisable(world, 0);
    MdtWorldSetGravity(world, 0, -(MeReal)(9.8), 0);
    body = MdtBodyCreate(world);
    MdtBodySetPosition(body, 0, 6, 0);
    MdtBodySetLinearVelocity(body, 1, 0, 0);
    MdtBodyEnable(body);
    contact = 0;
    double top[4] = {0}, before = 0;
    int bounces = 0;
    for (int i = 0; i < 600 && bounces < 4; i++) {
        tick();
        const double up = velocity(body, 1);
        if (before > 0 && up <= 0)
            top[bounces++] = coordinate(body, 1) - 1;
        before = up;
    }
    ck_assert_int_eq(bounces, 4);
    double height = 5;
    for (int i = 0; i < 4; i++) {
        assert_below(top[i], height);
        assert_near(top[i], .36 * height, .2 * height * .36 + .1); /* impacts are met within a step of 1/60 s */
        height = top[i];
    }
    for (int i = 0; i < 900; i++)
        tick();
    assert_near(coordinate(body, 1), 1, 1e-3);                       /* it has come to rest */
    assert_near(velocity(body, 0), -spin(body, 2), TOL(2e-6, 7e-9)); /* and rolls */
    assert_near(velocity(body, 0), 1 / (1 + .4), TOL(1e-4, 7e-9));   /* with what is left of 1 m/s when it does */
    MdtWorldDestroy(world);
}

/* "Remember that if the contact is not enabled before the world is updated, the Kea solver will ignore it"; by two
 * names. */
TEST(enabling_by_two_names) {
    beginOnPlane();
    MdtConstraintID cid = MdtContactQuaConstraint(contact);
    MdtConstraintDisable(cid);
    ck_assert(!MdtContactIsEnabled(contact));
    push(0, 0, 1);
    assert_near(velocity(body, 1), -9.8 * (double)step, TOL(1e-6, 2e-9));
    MdtBodySetLinearVelocity(body, 0, 0, 0);
    MdtConstraintEnable(cid);
    ck_assert(MdtContactIsEnabled(contact));
    MdtBodySetPosition(body, 0, 0, 0);
    push(0, 0, 1);
    assert_near(velocity(body, 1), 0, 1e-4);
    MdtContactDisable(contact);
    ck_assert(!MdtConstraintIsEnabled(cid));
    MdtContactEnable(contact);
    ck_assert(MdtConstraintIsEnabled(cid));
    MdtWorldDestroy(world);
}
