/* Dynamics guide, chapter 3, "Constraints: Joints and Contacts", its second half: the program Bounce. */
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
