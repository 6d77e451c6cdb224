/* Dynamics guide, chapter 3, "Constraints: Joints and Contacts", its first half: what the tests of each joint in
 * tests/Mdt do not have. */
#include "Mdt/behaviour.h"
#include "MeMath.h"

static MdtWorldID world;
static MdtBodyID body1, body2;
static const MeReal step = 1.0 / 60;

/* Two enabled bodies of the mass 1, a metre apart, in a world without gravity that puts nothing to rest. */
static void begin(void) {
    world = MdtWorldCreate(3, 4);
    MdtWorldSetAutoDisable(world, 0);
    body1 = MdtBodyCreate(world);
    body2 = MdtBodyCreate(world);
    MdtBodySetPosition(body2, 1, 0, 0);
    MdtBodyEnable(body1);
    MdtBodyEnable(body2);
}

static void end(void) {
    MdtWorldDestroy(world);
}

static void evolve(int n) {
    while (n--)
        MdtWorldStep(world, step);
}

/* "Fixed-Position-Fixed-Orientation Joint": "removes all six degrees of freedom, hence all relative motion". */
TEST(fpfo) {
    begin();
    MdtFPFOJointID joint = MdtFPFOJointCreate(world);
    MdtFPFOJointSetBodies(joint, body1, body2);
    MdtFPFOJointEnable(joint);
    MdtBodyAddImpulseAtPosition(body2, 0, 1, 0, 1, 0, 0);
    evolve(60);
    /* as one body of the mass 2 and the moment .4 + .4 + 2 × .5²: half the impulse's speed, and the spin .5 / 1.3 */
    assert_near(spin(body1, 2), .5 / 1.3, TOL(4e-7, 2e-8));
    assert_near(spin(body2, 2), .5 / 1.3, TOL(4e-7, 2e-8));
    assert_near(velocity(body1, 1) + velocity(body2, 1), 1, TOL(1e-6, 9e-14));
    MeVector3 p, q;
    MdtBodyGetPosition(body1, p);
    MdtBodyGetPosition(body2, q);
    assert_near(distance(p, q), 1, TOL(1e-6, 2e-7));
    end();
}

/* "Cone Limit constraint": with a ball and socket; "the angle between the cone axis and the side". */
TEST(cone_limit) {
    begin();
    scene_ball(world, body1, 0, 0, 0, 0);
    MdtConeLimitID cone = MdtConeLimitCreate(world);
    MdtConeLimitSetBodies(cone, body1, 0);
    assert_near(MdtConeLimitGetConeHalfAngle(cone), ME_PI, TOL(1e-6, 3e-13));
    MdtConeLimitSetConeHalfAngle(cone, .5);
    ck_assert(MdtConeLimitGetStiffness(cone) == MEINFINITY && MdtConeLimitGetDamping(cone) == MEINFINITY);
    MdtConeLimitEnable(cone);
    for (int i = 0; i < 120; i++) {
        MdtBodyAddTorque(body1, 1, 0, 1);
        evolve(1);
        assert_below(acos(fmin(1, MdtBodyGetTransformPtr(body1)[0][0])), .5 + 2e-3);
    }
    assert_near(acos(MdtBodyGetTransformPtr(body1)[0][0]), .5, TOL(5e-7, 8e-7));
    ck_assert(fabs(spin(body1, 0)) > 1); /* "does not place a limit on the 'twist'" */
    MdtConeLimitSetStiffness(cone, 3);
    MdtConeLimitSetDamping(cone, 1);
    ck_assert(MdtConeLimitGetStiffness(cone) == 3 && MdtConeLimitGetDamping(cone) == 1);
    end();
}

#define LO_LIMIT ((MeReal)-0.5)
#define HI_LIMIT ((MeReal)1.0)

/* "How to Use Joints": the tutorial Hinge. The sample toggles the motor and the limits on, so both are off at first
 * (the text before says "motorized by default"). With some loss at the stops the hinge comes to rest at its limit. */
TEST(how_to_use_joints) {
    begin();
    MdtBodyID body = body1;
    const MeReal desiredVelocity = 2, maxForce = 1;
    MdtHingeID hinge = MdtHingeCreate(world);
    MdtHingeSetBodies(hinge, body, 0);
    MdtHingeSetPosition(hinge, 0, 0, 0);
    MdtHingeSetAxis(hinge, 1, 0, 0);

    MdtLimitID limit = MdtHingeGetLimit(hinge);
    MdtLimitActivateMotor(limit, !MdtLimitIsMotorized(limit));
    MdtLimitActivateLimits(limit, !MdtLimitIsActive(limit));
    ck_assert(MdtLimitIsMotorized(limit) && MdtLimitIsActive(limit));

    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(limit), LO_LIMIT);
    MdtSingleLimitSetStop(MdtLimitGetUpperLimit(limit), HI_LIMIT);
    MdtLimitSetLimitedForceMotor(limit, desiredVelocity, maxForce);
    MdtSingleLimitSetRestitution(MdtLimitGetUpperLimit(limit), .5);

    MdtHingeEnable(hinge);
    double fastest = 0;
    for (int i = 0; i < 900; i++) {
        evolve(1);
        fastest = fmax(fastest, spin(body, 0));
        assert_below(MdtLimitGetPosition(limit), 1 + 1e-4);
    }
    assert_near(fastest, 2, TOL(2e-6, 2e-13)); /* the desired velocity */
    assert_near(MdtLimitGetPosition(limit), 1, 2e-6);
    assert_near(MdtLimitGetVelocity(limit), 0, TOL(1e-6, 9e-14));
    MdtLimitSetLimitedForceMotor(limit, -desiredVelocity, maxForce); /* and back to the other stop */
    MdtSingleLimitSetRestitution(MdtLimitGetLowerLimit(limit), 0);
    evolve(900);
    assert_near(MdtLimitGetPosition(limit), -.5, 2e-6);
    end();
}
