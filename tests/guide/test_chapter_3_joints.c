/* Dynamics guide, chapter 3, "Constraints: Joints and Contacts", its first half: joints and limits, section by
 * section. */
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

/* "Common Constraint Functions": create, SetBodies, Enable, Disable, IsEnabled, Reset, Destroy. */
TEST(common_constraint_functions) {
    begin();
    MdtHingeID joint = MdtHingeCreate(world);
    MdtHingeSetBodies(joint, body1, body2);
    MdtHingeSetPosition(joint, .5, 0, 0);
    ck_assert(!MdtHingeIsEnabled(joint));
    MdtBodySetLinearVelocity(body1, 0, 1, 0);
    evolve(1);
    assert_velocity(body2, 0, 0, 0, 0); /* not processed before it is enabled */
    MdtHingeEnable(joint);
    ck_assert(MdtHingeIsEnabled(joint));
    evolve(1);
    ck_assert(velocity(body2, 1) != 0);
    MdtHingeDisable(joint); /* "keeps the constraint structure in memory for later use" */
    ck_assert(!MdtHingeIsEnabled(joint));
    ck_assert(MdtHingeGetBody(joint, 1) == body2);
    MeVector3 axis;
    MdtHingeSetAxis(joint, 0, 1, 0);
    MdtHingeReset(joint);
    MdtHingeGetAxis(joint, axis);
    ck_assert(fabs(axis[0]) > .9); /* "axis = {1,0,0}" of the body */
    MdtConstraintID constraint = MdtHingeQuaConstraint(joint);
    ck_assert(MdtConstraintDCastHinge(constraint) == joint);
    ck_assert(MdtConstraintDCastBSJoint(constraint) == 0); /* "not of the expected type, 0 is returned" */
    MdtHingeDestroy(joint);
    ck_assert_int_eq(MdtWorldGetTotalConstraints(world), 0);
    end();
}

/* "Common Accessors", "Common Mutators". */
TEST(common_accessors_and_mutators) {
    begin();
    int data;
    MdtBSJointID joint = MdtBSJointCreate(world);
    MdtBSJointSetBodies(joint, body1, 0);
    MdtBSJointSetPosition(joint, 0, 1, 0);
    MeVector3 posVector, force, torque;
    MdtBSJointGetPosition(joint, posVector);
    assert_vec3_near(posVector, 0, 1, 0, 0);
    ck_assert(MdtBSJointGetBody(joint, 0) == body1 && MdtBSJointGetBody(joint, 1) == 0);
    MdtBSJointSetUserData(joint, &data);
    ck_assert(MdtBSJointGetUserData(joint) == &data);
    ck_assert(MdtBSJointGetWorld(joint) == world);
    MdtBSJointSetSortKey(joint, 7);
    ck_assert_int_eq(MdtBSJointGetSortKey(joint), 7);
    MdtWorldSetGravity(world, 0, -10, 0);
    MdtBSJointEnable(joint);
    evolve(1);
    MdtBSJointGetForce(joint, 0, force); /* on the last time step, in the world's frame */
    assert_vec3_near(force, 0, 10, 0, TOL(2e-2, 2e-2));
    MdtBSJointGetTorque(joint, 0, torque);
    assert_vec3_near(torque, 0, 0, 0, TOL(1e-6, 9e-14));
    end();
}

/* "Base Constraint Functions": the same by the abstract identifier; axes are normalized. */
TEST(base_constraint_functions) {
    begin();
    int data;
    MdtConstraintID constraint = MdtUniversalQuaConstraint(MdtUniversalCreate(world));
    MdtConstraintSetBodies(constraint, body1, body2);
    MdtConstraintBodySetPosition(constraint, 0, 0, 1, 0);
    MdtConstraintBodySetPosition(constraint, 1, 1, 1, 0);
    MeVector3 p, q;
    MdtConstraintBodyGetPosition(constraint, 1, p);
    assert_vec3_near(p, 1, 1, 0, TOL(1e-6, 9e-14));
    MdtConstraintSetAxis(constraint, 0, 3, 0);
    MdtConstraintGetAxis(constraint, p);
    assert_vec3_near(p, 0, 1, 0, TOL(1e-6, 9e-14));
    MdtConstraintSetAxes(constraint, 0, 0, 2, 5, 0, 0);
    MdtConstraintGetAxes(constraint, p, q);
    assert_vec3_near(p, 0, 0, 1, TOL(1e-6, 9e-14));
    assert_vec3_near(q, 1, 0, 0, TOL(1e-6, 9e-14));
    MdtConstraintSetBothAxis(constraint, 0, 2, 0, 0, 0, 2); /* "an older, deprecated name" */
    MdtConstraintGetBothAxes(constraint, p, q);
    assert_vec3_near(p, 0, 1, 0, TOL(1e-6, 9e-14));
    MdtConstraintBodyGetBothAxes(constraint, 1, p, q);
    assert_vec3_near(q, 0, 0, 1, TOL(1e-6, 9e-14));
    MdtConstraintSetUserData(constraint, &data);
    MdtConstraintSetSortKey(constraint, 3);
    ck_assert(MdtConstraintGetUserData(constraint) == &data && MdtConstraintGetSortKey(constraint) == 3);
    ck_assert(MdtConstraintGetWorld(constraint) == world && MdtConstraintGetBody(constraint, 0) == body1);
    MdtConstraintEnable(constraint);
    ck_assert_int_eq(MdtConstraintIsEnabled(constraint), 1);
    MdtConstraintDisable(constraint);
    ck_assert_int_eq(MdtConstraintIsEnabled(constraint), 0);
    MdtConstraintEnable(constraint);
    MdtConstraintDestroy(constraint); /* "disabled automatically if necessary" */
    ck_assert_int_eq(MdtWorldGetEnabledConstraints(world), 0);
    end();
}

/* "Ball-and-socket (BS) Joint": the two points are at the same location in the world. */
TEST(ball_and_socket) {
    begin();
    const MeReal pos_x = .5, pos_y = (MeReal).25, pos_z = 0;
    MdtBSJointID bs = MdtBSJointCreate(world);
    MdtBSJointSetBodies(bs, body1, body2);
    MdtBSJointSetPosition(bs, pos_x, pos_y, pos_z);
    MdtBSJointEnable(bs);
    MdtBodySetAngularVelocity(body1, 2, 1, 3);
    for (int i = 0; i < 300; i++) {
        evolve(1);
        assert_near(gapOf(MdtBSJointQuaConstraint(bs)), 0, TOL(2e-5, 1e-5));
    }
    ck_assert(fabs(spin(body1, 0) - spin(body2, 0)) > .01); /* "allows all rotations about the common point" */
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtBSJointQuaConstraint(bs)), 3);
    end();
}

/* "Hinge Joint": the axes, fixed in both bodies, coincide at all times; one rotation is free. */
TEST(hinge_joint) {
    begin();
    MdtHingeID joint = MdtHingeCreate(world);
    MdtHingeSetBodies(joint, body1, body2);
    MdtHingeSetPosition(joint, .5, 0, 0);
    MdtHingeSetAxis(joint, 0, 0, 1);
    MdtHingeEnable(joint);
    MdtBodyAddImpulseAtPosition(body2, 1, 3, 1, 1, 1, 1);
    for (int i = 0; i < 300; i++) {
        evolve(1);
        MeVector3 p, q, unused;
        MdtConstraintBodyGetAxes(MdtHingeQuaConstraint(joint), 0, p, unused);
        MdtConstraintBodyGetAxes(MdtHingeQuaConstraint(joint), 1, q, unused);
        assert_vec3_near(p, q[0], q[1], q[2], 4e-5);
        assert_near(gapOf(MdtHingeQuaConstraint(joint)), 0, 1e-4);
    }
    ck_assert(fabs(spin(body1, 2) - spin(body2, 2)) > .1);
    end();
}

/* "Prismatic": slides along the axis only; "the initial position of the bodies specifies the zero displacement". */
TEST(prismatic) {
    begin();
    MdtPrismaticID joint = MdtPrismaticCreate(world);
    MdtPrismaticSetBodies(joint, body1, body2);
    MdtPrismaticSetAxis(joint, 1, 0, 0);
    MeVector3 axisVec;
    MdtPrismaticGetAxis(joint, axisVec);
    assert_vec3_near(axisVec, 1, 0, 0, TOL(1e-6, 9e-14));
    MdtLimitID limit = MdtPrismaticGetLimit(joint);
    MdtLimitCalculatePosition(limit, 1);
    MdtPrismaticEnable(joint);
    evolve(1);
    assert_near(MdtLimitGetPosition(limit), 0, TOL(1e-6, 9e-14));
    MdtBodySetLinearVelocity(body2, 1, 0, 0);
    evolve(60);
    assert_near(fabs(MdtLimitGetPosition(limit)), 1, TOL(1e-6, 9e-14));
    MdtBodySetAngularVelocity(body2, 0, 1, 1);
    evolve(10);
    for (int k = 0; k < 3; k++)
        assert_near(spin(body1, k), spin(body2, k), 4e-6);
    /* "The actuation force will be applied ... until their relative velocity reaches the specified speed." */
    MdtBodySetAngularVelocity(body1, 0, 0, 0);
    MdtBodySetAngularVelocity(body2, 0, 0, 0);
    MdtBodySetLinearVelocity(body1, 0, 0, 0);
    MdtBodySetLinearVelocity(body2, 0, 0, 0);
    MdtLimitSetLimitedForceMotor(limit, .5, 2);
    evolve(120);
    assert_near(MdtLimitGetVelocity(limit), .5, TOL(5e-7, 5e-14));
    end();
}

/* "Universal Joint": two axes with a common origin, perpendicular at all times; it does not twist. */
TEST(universal) {
    begin();
    MdtUniversalID joint = MdtUniversalCreate(world);
    MeVector3 axis[2];
    MdtUniversalSetBodies(joint, body1, body2);
    for (unsigned int k = 0; k < 2; k++)
        MdtUniversalGetAxis(joint, k, axis[k]);
    assert_vec3_near(axis[0], 1, 0, 0, TOL(1e-6, 9e-14)); /* "x-axis in body1 and y-axis in body2" */
    assert_vec3_near(axis[1], 0, 1, 0, TOL(1e-6, 9e-14));
    MdtUniversalSetPosition(joint, .5, 0, 0);
    MdtUniversalSetAxis(joint, 0, 0, 1, 0);
    MdtUniversalSetAxis(joint, 1, 0, 0, 1);
    MdtUniversalEnable(joint);
    MdtBodySetAngularVelocity(body1, 3, 0, 0); /* a twist is transmitted */
    MdtBodySetAngularVelocity(body2, 0, .2, 0);
    for (int i = 0; i < 100; i++) {
        evolve(1);
        for (unsigned int k = 0; k < 2; k++)
            MdtUniversalGetAxis(joint, k, axis[k]);
        assert_near((double)axis[0][0] * axis[1][0] + (double)axis[0][1] * axis[1][1] + (double)axis[0][2] * axis[1][2],
                    0, 2e-5);
        assert_near(gapOf(MdtUniversalQuaConstraint(joint)), 0, 2e-6);
    }
    assert_near(spin(body2, 0), 1.5, .02); /* shared by the two */
    end();
}

/* "Angular Joint": fixed orientation, free position; keeps things upright, softly if wished. */
TEST(angular3_and_angular2) {
    begin();
    MdtAngular3ID joint = MdtAngular3Create(world);
    MdtAngular3SetBodies(joint, body1, 0);
    MdtAngular3SetAxis(joint, 0, 1, 0);
    ck_assert(MdtAngular3GetStiffness(joint) == MEINFINITY && MdtAngular3GetDamping(joint) == MEINFINITY);
    MdtAngular3EnableRotation(joint, 1);
    ck_assert(MdtAngular3RotationIsEnabled(joint));
    MdtAngular3Enable(joint);
    MdtBodyAddTorque(body1, 5, 5, 5);
    MdtBodyAddForce(body1, 6, 0, 0);
    evolve(1);
    assert_spin(body1, 0, 5 / .4 * (double)step, 0, 1e-4);
    assert_velocity(body1, 6 * (double)step, 0, 0, TOL(1e-6, 9e-14));
    MdtAngular3SetStiffness(joint, 20);
    MdtAngular3SetDamping(joint, 2);
    double tilt = 0;
    for (int i = 0; i < 300; i++) {
        if (i < 30)
            MdtBodyAddTorque(body1, 2, 0, 0);
        evolve(1);
        tilt = fmax(tilt, 1 - (double)MdtBodyGetTransformPtr(body1)[1][1]);
    }
    ck_assert_msg(tilt > 1e-3, "it does not give: %g", tilt);
    assert_near(MdtBodyGetTransformPtr(body1)[1][1], 1, TOL(1e-6, 4e-12)); /* upright again */
    end();
}

/* "CarWheel Joint": chassis and wheel, steering, rolling, springing. */
TEST(car_wheel) {
    begin();
    MdtBodyID chassis = body1, wheel = body2;
    MdtBodySetMass(chassis, 100);
    MdtBodySetSphericalInertiaTensor(chassis, 40);
    MdtCarWheelID joint = MdtCarWheelCreate(world);
    MdtCarWheelSetBodies(joint, chassis, wheel);
    MdtCarWheelSetPosition(joint, 1, 0, 0);
    MeVector3 steeringAxis, hingeAxis;
    MdtCarWheelGetSteeringAxis(joint, steeringAxis);
    MdtCarWheelGetHingeAxis(joint, hingeAxis);
    assert_vec3_near(steeringAxis, 0, 0, 1, TOL(1e-6, 9e-14)); /* "body1 z-axis", "body2 y-axis" */
    assert_vec3_near(hingeAxis, 0, 1, 0, TOL(1e-6, 9e-14));
    MdtCarWheelSetSteeringAxis(joint, 0, 1, 0);
    MdtCarWheelSetHingeAxis(joint, 0, 0, 1);
    MdtCarWheelSetSuspension(joint, 1000, 60, 0, -.3, .3, .05);
    ck_assert(MdtCarWheelGetSuspensionKp(joint) == 1000 && MdtCarWheelGetSuspensionKd(joint) == 60);
    assert_near(MdtCarWheelGetSuspensionLowLimit(joint), -.3, TOL(1e-7, 3e-14));
    assert_near(MdtCarWheelGetSuspensionHighLimit(joint), .3, TOL(1e-7, 3e-14));
    assert_near(MdtCarWheelGetSuspensionReference(joint), .05, TOL(1e-8, 5e-15));
    assert_near(MdtCarWheelGetSuspensionLimitSoftness(joint), 0, 0);
    MdtCarWheelSetSteeringLock(joint, 1);
    MdtCarWheelSetHingeLimitedForceMotor(joint, 10, 3);
    ck_assert(MdtCarWheelGetHingeMotorDesiredVelocity(joint) == 10 && MdtCarWheelGetHingeMotorMaxForce(joint) == 3);
    MdtCarWheelEnable(joint);
    evolve(240);
    assert_near(MdtCarWheelGetSuspensionHeight(joint), .05, 5e-6); /* unloaded, at its reference */
    assert_near(MdtCarWheelGetHingeAngleRate(joint), 10, TOL(1e-5, 9e-13));
    ck_assert(MdtCarWheelGetHingeAngle(joint) >= 0 && (double)MdtCarWheelGetHingeAngle(joint) <= PI + 1e-6);
    assert_near(MdtCarWheelGetSteeringAngle(joint), 0, TOL(1e-6, 9e-14));
    MdtCarWheelSetSteeringLock(joint, 0);
    MdtCarWheelSetSteeringLimitedForceMotor(joint, 1, 100);
    ck_assert(MdtCarWheelGetSteeringMotorDesiredVelocity(joint) == 1 &&
              MdtCarWheelGetSteeringMotorMaxForce(joint) == 100);
    evolve(30);
    assert_near(fabs(MdtCarWheelGetSteeringAngle(joint)), .5, 2e-5);
    assert_near(fabs(MdtCarWheelGetSteeringAngleRate(joint)), 1, 6e-5);
    end();
}

/* "Linear1 Joint", "Linear2 Joint": a point in a plane, on a line. */
TEST(linear1_and_linear2) {
    begin();
    MdtLinear1ID plane = MdtLinear1Create(world);
    MdtLinear1SetBodies(plane, body1, 0);
    MdtLinear1SetPosition(plane, 0, 0, 0);
    MdtLinear1SetAxis(plane, 0, 1, 0);
    MdtLinear1Enable(plane);
    MdtLinear2ID line = MdtLinear2Create(world);
    MdtLinear2SetBodies(line, body2, 0);
    MdtLinear2SetPosition(line, 1, 0, 0);
    MdtLinear2SetDirection(line, 0, 0, 2);
    MeVector3 directVec;
    MdtLinear2GetDirection(line, directVec);
    assert_vec3_near(directVec, 0, 0, 1, TOL(1e-6, 9e-14));
    MdtLinear2Enable(line);
    for (int i = 0; i < 60; i++) {
        MdtBodyAddForce(body1, 1, 2, 3);
        MdtBodyAddForce(body2, 1, 2, 3);
        evolve(1);
    }
    const double t = 60 * (double)step, way = t * t / 2;
    assert_position(body1, way, 0, 3 * way, 3e-6);
    assert_position(body2, 1, 0, 3 * way, 3e-6);
    assert_near(coordinate(body1, 1), 0, 1e-6);
    end();
}

/* "Fixed-Path Joint": the animation supplies position and velocity; "the forces generated by any animated motion will
 * be transmitted correctly". */
TEST(fixed_path) {
    begin();
    MdtWorldSetGravity(world, 0, -10, 0);
    MdtFixedPathID joint = MdtFixedPathCreate(world);
    MdtFixedPathSetBodies(joint, body1, 0);
    MdtFixedPathEnable(joint);
    MeVector3 velocityThere;
    for (int i = 0; i < 120; i++) { /* an elevator that speeds up with 2 m/s² */
        const double t = i * (double)step;
        MdtFixedPathSetPosition(joint, 1, 0, t * t, 0);
        MdtFixedPathSetVelocity(joint, 1, 0, 2 * t, 0);
        MdtFixedPathGetVelocity(joint, 1, velocityThere);
        assert_vec3_near(velocityThere, 0, (MeReal)(2 * t), 0, 0);
        evolve(1);
    }
    const double t = 120 * (double)step;
    assert_near(coordinate(body1, 1), t * t, .01);
    assert_near(forceOn(MdtFixedPathQuaConstraint(joint), 0, 1), 12, TOL(2e-3, 2e-11)); /* m (g + a) */
    end();
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

/* "Relative-Position-Relative-Orientation Joint": driven orientation, attachment frames, strengths. */
TEST(rpro) {
    begin();
    MdtRPROJointID joint = MdtRPROJointCreate(world);
    MdtRPROJointSetBodies(joint, body1, 0);
    MdtRPROJointSetAttachmentPosition(joint, 0, -.5, 0, 1);
    MdtRPROJointSetAttachmentPosition(joint, 0, -.5, 0, 0);
    MdtRPROJointSetAttachmentQuaternion(joint, 1, 0, 0, 0, 0);
    MeVector3 position;
    MeVector4 quaternion;
    MdtRPROJointGetPosition(joint, 0, position);
    assert_vec3_near(position, 0, -.5, 0, TOL(1e-7, 9e-14));
    MdtRPROJointGetAttachmentOrientation(joint, 0, quaternion);
    ck_assert(quaternion[0] == 1);
    MdtRPROJointEnable(joint);
    for (int i = 0; i < 60; i++) {
        const double half = i * (double)step / 2;
        MeVector4 q = {cos(half), sin(half), 0, 0}, got;
        MeVector3 w = {1, 0, 0};
        MdtRPROJointSetRelativeQuaternion(joint, q);
        MdtRPROJointGetRelativeQuaternion(joint, got);
        assert_near(got[1], q[1], TOL(1e-6, 9e-14));
        MdtRPROJointSetRelativeAngularVelocity(joint, w);
        evolve(1);
    }
    MdtBodyGetQuaternion(body1, quaternion);
    assert_near(2 * asin(quaternion[1]), 60 * (double)step, TOL(1e-6, 2e-9));
    assert_near(gapOf(MdtRPROJointQuaConstraint(joint)), 0, TOL(1e-6, 7e-7));
    MdtRPROJointSetLinearStrength(joint, 1, 1, 1); /* "will cause the constraint to be broken easily" */
    MdtRPROJointSetAngularStrength(joint, 1, 1, 1);
    MeVector3 hold = {0, 0, 0};
    MdtRPROJointSetRelativeAngularVelocity(joint, hold);
    for (int i = 0; i < 30; i++) {
        MdtBodyAddForce(body1, 50, 0, 0);
        evolve(1);
    }
    ck_assert_msg(gapOf(MdtRPROJointQuaConstraint(joint)) > 1, "it held");
    end();
}

/* "Spring Joint": Hooke's law, F = -k(d - l); "the default is ... initialized at the initial separation". */
TEST(spring) {
    begin();
    MdtSpringID joint = MdtSpringCreate(world);
    MdtSpringSetBodies(joint, body1, body2);
    MdtSpringSetPosition(joint, 0, 0, 0, 0);
    MdtSpringSetPosition(joint, 1, 1, 0, 0);
    MeVector3 position;
    MdtSpringGetPosition(joint, position, 1);
    assert_vec3_near(position, 1, 0, 0, 0);
    MdtSpringEnable(joint);
    evolve(1);
    assert_near(forceOn(MdtSpringQuaConstraint(joint), 0, 0), 0, TOL(1e-6, 9e-14));
    MdtSpringSetNaturalLength(joint, .8);
    MdtSpringSetStiffness(joint, 5);
    MdtSpringSetDamping(joint, 0);
    double min = 9, max = 0;
    for (int i = 0; i < 300; i++) {
        evolve(1);
        const double d = coordinate(body2, 0) - coordinate(body1, 0);
        min = fmin(min, d);
        max = fmax(max, d);
    }
    assert_near(max, 1, 2e-4); /* it swings about its natural length */
    assert_near(min, .6, 4e-5);
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtSpringQuaConstraint(joint)), 1);
    ck_assert(MdtSpringGetLimit(joint) != 0);
    end();
}

/* "Cone Limit constraint": with a ball and socket; "the angle between the cone axis and the side". */
TEST(cone_limit) {
    begin();
    MdtBSJointID ball = MdtBSJointCreate(world);
    MdtBSJointSetBodies(ball, body1, 0);
    MdtBSJointSetPosition(ball, 0, 0, 0);
    MdtBSJointEnable(ball);
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

/* "Joint Limit", "The Single Joint Limit": accessors, mutators, actuators, indicators and their rules. */
TEST(joint_limit_and_single_limit) {
    begin();
    MdtHingeID hinge = MdtHingeCreate(world);
    MdtLimitID limit = MdtHingeGetLimit(hinge);
    MdtBclSingleLimit single;
    ck_assert(!MdtLimitIsActive(limit) && !MdtLimitPositionIsCalculated(limit));
    ck_assert(MdtLimitGetStiffnessThreshold(limit) == MEINFINITY);
    MdtSingleLimitReset(&single);
    ck_assert(single.stop == 0 && single.restitution == 1 && single.stiffness == MEINFINITY && single.damping == 0);
    MdtSingleLimitSetStop(&single, 2);
    MdtLimitSetLowerLimit(limit, &single); /* above the upper stop, 0: that is reset too */
    assert_near(MdtSingleLimitGetStop(MdtLimitGetUpperLimit(limit)), 2, 0);
    MdtSingleLimitSetStop(&single, 1);
    MdtLimitSetUpperLimit(limit, &single);
    assert_near(MdtSingleLimitGetStop(MdtLimitGetLowerLimit(limit)), 1, 0);
    MdtSingleLimitSetDamping(&single, -1);
    MdtSingleLimitSetStiffness(&single, -1);
    MdtSingleLimitSetRestitution(&single, 2);
    ck_assert(single.damping == 0 && single.stiffness == 0 && single.restitution == 1); /* "enforced" */
    MdtLimitSetStiffnessThreshold(limit, -4);
    assert_near(MdtLimitGetStiffnessThreshold(limit), 0, 0);
    MdtLimitSetLimitedForceMotor(limit, 3, -1);
    ck_assert(!MdtLimitIsMotorized(limit));
    MdtLimitSetLimitedForceMotor(limit, 3, 4);
    ck_assert(MdtLimitIsMotorized(limit) && MdtLimitPositionIsCalculated(limit));
    ck_assert(MdtLimitGetMotorDesiredVelocity(limit) == 3 && MdtLimitGetMotorMaxForce(limit) == 4);
    MdtLimitCalculatePosition(limit, 0);
    ck_assert(MdtLimitPositionIsCalculated(limit));
    MdtHingeSetBodies(hinge, body1, 0);
    MdtHingeEnable(hinge);
    MdtLimitSetPosition(limit, 5); /* "does not change the actual position of any modelled object" */
    assert_near(MdtLimitGetPosition(limit), 5, 0);
    assert_position(body1, 0, 0, 0, 0);
    /* "a lower limiting velocity may be achieved if the bodies are subject to damping": F = I d w */
    MdtBodySetAngularVelocityDamping(body1, 20);
    MdtLimitActivateMotor(limit, 1);
    evolve(300);
    assert_near(MdtLimitGetVelocity(limit), 4 / (.4 * 20), .1);
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
