/* What holds for the life of every joint, under each joint's own names: creation, attachment, bookkeeping, casts,
 * defaults and reset. */
#include "scene.h"

#define FOR_ALL_JOINTS(DO)                                                                                             \
    DO(BSJoint)                                                                                                        \
    DO(Hinge)                                                                                                          \
    DO(Prismatic)                                                                                                      \
    DO(Universal)                                                                                                      \
    DO(Angular3)                                                                                                       \
    DO(CarWheel)                                                                                                       \
    DO(Linear1)                                                                                                        \
    DO(Linear2)                                                                                                        \
    DO(FixedPath)                                                                                                      \
    DO(FPFOJoint)                                                                                                      \
    DO(RPROJoint)                                                                                                      \
    DO(Spring)                                                                                                         \
    DO(Spring6)                                                                                                        \
    DO(ConeLimit)                                                                                                      \
    DO(Skeletal)                                                                                                       \
    DO(Gear)                                                                                                           \
    DO(Pulley)                                                                                                         \
    DO(Mimic)                                                                                                          \
    DO(UserConstraint)

/* One warning or more, and a neutral result. */
#define WARNS(call)                                                                                                    \
    do {                                                                                                               \
        caught.warnings = 0;                                                                                           \
        call;                                                                                                          \
        ck_assert_msg(caught.warnings > 0, "%s: no warning", #call);                                                   \
    } while (0)
#define WARNS_0(call)                                                                                                  \
    do {                                                                                                               \
        caught.warnings = 0;                                                                                           \
        ck_assert_msg((call) == 0, "%s is not 0", #call);                                                              \
        ck_assert_msg(caught.warnings > 0, "%s: no warning", #call);                                                   \
    } while (0)

/* ---- the world's two bodies ---- */

typedef struct {
    MdtWorldID world;
    MdtBodyID a, b;
} Stage;

static Stage makeStage(unsigned int constraints) {
    Stage s;
    s.world = scene_world(2, constraints, 10);
    s.a = scene_body(s.world, 1, 1, 2, 3);
    s.b = scene_body(s.world, 2, 2, 2, 3);
    MdtBodySetQuaternion(s.b, .5, .5, .5, -.5);
    return s;
}

/* ---- life ---- */

#define LIFE(Joint)                                                                                                    \
    static void lifeOf##Joint(void) {                                                                                  \
        Stage s = makeStage(2);                                                                                        \
        int data;                                                                                                      \
        caught.warnings = 0;                                                                                           \
        Mdt##Joint##ID j = Mdt##Joint##Create(s.world);                                                                \
        ck_assert(j && !Mdt##Joint##IsEnabled(j) && !Mdt##Joint##GetBody(j, 0) && !Mdt##Joint##GetBody(j, 1));         \
        ck_assert(Mdt##Joint##GetWorld(j) == s.world && !Mdt##Joint##GetUserData(j) &&                                 \
                  Mdt##Joint##GetSortKey(j) == 0);                                                                     \
        assert_silent();                                                                                               \
        WARNS(Mdt##Joint##Enable(j)); /* unattached */                                                                 \
        ck_assert(!Mdt##Joint##IsEnabled(j));                                                                          \
        WARNS(Mdt##Joint##SetBodies(j, 0, 0));                                                                         \
        WARNS(Mdt##Joint##SetBodies(j, s.a, s.a));                                                                     \
        WARNS_0(Mdt##Joint##GetBody(j, 2));                                                                            \
        caught.warnings = 0;                                                                                           \
        MdtBodyID attached[3][2] = {{s.a, NULL}, {NULL, s.b}, {s.b, s.a}};                                             \
        for (int i = 0; i < 3; i++) {                                                                                  \
            MdtBodyID first = attached[i][0], second = attached[i][1];                                                 \
            Mdt##Joint##SetBodies(j, first, second);                                                                   \
            ck_assert(Mdt##Joint##GetBody(j, 0) == first && Mdt##Joint##GetBody(j, 1) == second);                      \
            Mdt##Joint##Enable(j);                                                                                     \
            ck_assert(Mdt##Joint##IsEnabled(j) == 1);                                                                  \
            MdtWorldStep(s.world, FRAME);                                                                              \
            Mdt##Joint##Disable(j);                                                                                    \
            ck_assert(!Mdt##Joint##IsEnabled(j));                                                                      \
        }                                                                                                              \
        Mdt##Joint##SetUserData(j, &data);                                                                             \
        Mdt##Joint##SetSortKey(j, 2147483647);                                                                         \
        ck_assert(Mdt##Joint##GetUserData(j) == &data && Mdt##Joint##GetSortKey(j) == 2147483647);                     \
        ck_assert(caught.fatal == 0);                                                                                  \
        WARNS(Mdt##Joint##SetSortKey(j, -1));                                                                          \
        Mdt##Joint##Enable(j);                                                                                         \
        WARNS(Mdt##Joint##SetBodies(j, s.a, s.b)); /* while it is enabled */                                           \
        ck_assert(Mdt##Joint##GetBody(j, 0) == s.a);                                                                   \
        Mdt##Joint##Destroy(j);                                                                                        \
        ck_assert_int_eq(MdtWorldGetEnabledConstraints(s.world), 0);                                                   \
        ck_assert_int_eq(MdtWorldGetTotalConstraints(s.world), 0);                                                     \
        steps(s.world, 3, FRAME);                                                                                      \
    }
FOR_ALL_JOINTS(LIFE)

TEST(life) {
#define RUN_LIFE(Joint) lifeOf##Joint();
    FOR_ALL_JOINTS(RUN_LIFE)
    messages_forget();
}

TEST(a_full_world_names_its_limit) {
    Stage s = makeStage(1);
    MdtHingeCreate(s.world);
#define CREATE_IN_VAIN(Joint)                                                                                          \
    ck_assert(Mdt##Joint##Create(s.world) == NULL);                                                                    \
    ck_assert(strstr(caught.last, "Mdt" #Joint "Create") != NULL);                                                     \
    assert_warned("maxConstraints");
    FOR_ALL_JOINTS(CREATE_IN_VAIN)
    ck_assert_int_eq(MdtWorldGetTotalConstraints(s.world), 1);
}

TEST(casts_are_each_other_s_inverse_and_know_the_type) {
    Stage s = makeStage(19);
    MdtConstraintID all[19];
    int n = 0, hits;
#define CREATE(Joint)                                                                                                  \
    {                                                                                                                  \
        Mdt##Joint##ID j = Mdt##Joint##Create(s.world);                                                                \
        all[n] = Mdt##Joint##QuaConstraint(j);                                                                         \
        ck_assert(MdtConstraintDCast##Joint(all[n]) == j);                                                             \
        n++;                                                                                                           \
    }
    FOR_ALL_JOINTS(CREATE)
#define COUNT_CASTS(Joint)                                                                                             \
    hits = 0;                                                                                                          \
    for (int i = 0; i < n; i++)                                                                                        \
        hits += MdtConstraintDCast##Joint(all[i]) != NULL;                                                             \
    ck_assert_int_eq(hits, 1);                                                                                         \
    ck_assert(Mdt##Joint##QuaConstraint(NULL) == NULL);
    FOR_ALL_JOINTS(COUNT_CASTS)
#define CAST_NULL(Joint) WARNS_0(MdtConstraintDCast##Joint(NULL));
    FOR_ALL_JOINTS(CAST_NULL)
    messages_forget();
}

/* ---- handles of another type (null and dead ones: api.messages) ---- */

static void MEAPI noRows(MdtKeaConstraints *const list, void *const constraint, const MdtKeaTransformation *const pose,
                         MdtKeaBody *const bodies[], const void *const params) {
    (void)list, (void)constraint, (void)pose, (void)bodies, (void)params;
}

/* The joint's own functions, not those that every constraint has, know the type. */
TEST(a_handle_of_another_joint_is_noticed) {
    Stage s = makeStage(4);
    void *hinge = MdtHingeCreate(s.world), *ball = MdtBSJointCreate(s.world);
    WARNS_0(MdtHingeGetLimit(ball));
    ck_assert(strstr(caught.last, "BSJoint") && strstr(caught.last, "Hinge"));
    WARNS_0(MdtPrismaticGetLimit(hinge));
    WARNS_0(MdtSpringGetLimit(hinge));
    WARNS(MdtAngular3SetStiffness(hinge, 1));
    WARNS(MdtCarWheelSetSteeringLock(hinge, 1));
    WARNS(MdtUniversalSetAxis(hinge, 0, 1, 0, 0));
    WARNS(MdtLinear2SetDirection(hinge, 1, 0, 0));
    WARNS(MdtFixedPathSetPosition(hinge, 0, 1, 0, 0));
    WARNS(MdtFPFOJointSetPosition(hinge, 1, 0, 0));
    WARNS(MdtRPROJointSetLinearStrength(hinge, 1, 1, 1));
    WARNS(MdtSpring6SetLinearStiffness(hinge, 0, 1));
    WARNS(MdtConeLimitSetConeHalfAngle(hinge, 1));
    WARNS(MdtSkeletalSetTwistLimitAngle(hinge, 1));
    WARNS(MdtUserConstraintSetFunction(hinge, noRows));
    WARNS(MdtGearSetRatio(hinge, 2));
    WARNS(MdtPulleySetRatio(hinge, 2));
    WARNS(MdtMimicSetOffset(hinge, 2));
    WARNS(MdtBSJointReset(hinge));
    messages_forget();
}

/* ---- defaults (defaults.tsv of the guides) ---- */

static void assertAxes(MdtConstraintID c, unsigned int k, const double p[3], const double o[3]) {
    MeVector3 a, b;
    MdtConstraintBodyGetAxesRel(c, k, a, b);
    assert_vec3_near(a, p[0], p[1], p[2], 0);
    assert_vec3_near(b, o[0], o[1], o[2], 0);
}

static void assertAtCentre(MdtConstraintID c, unsigned int k) {
    MeVector3 p;
    MdtConstraintBodyGetPositionRel(c, k, p);
    assert_vec3_near(p, 0, 0, 0, 0);
}

static const double X[3] = {1, 0, 0}, Y[3] = {0, 1, 0}, Z[3] = {0, 0, 1};

static void assertFrames(MdtConstraintID c) {
    for (unsigned int k = 0; k < 2; k++) {
        assertAtCentre(c, k);
        assertAxes(c, k, X, Y);
    }
}

static void assertLimit(MdtLimitID l) {
    ck_assert(!MdtLimitIsActive(l) && !MdtLimitIsMotorized(l) && !MdtLimitPositionIsCalculated(l));
    ck_assert(MdtLimitGetStiffnessThreshold(l) == MEINFINITY && l->offset == 0);
    ck_assert(MdtLimitGetMotorDesiredVelocity(l) == 0 && MdtLimitGetMotorMaxForce(l) == 0);
    const MdtSingleLimitID stop[2] = {MdtLimitGetLowerLimit(l), MdtLimitGetUpperLimit(l)};
    for (int i = 0; i < 2; i++)
        ck_assert(MdtSingleLimitGetStop(stop[i]) == 0 && MdtSingleLimitGetRestitution(stop[i]) == 1 &&
                  MdtSingleLimitGetStiffness(stop[i]) == MEINFINITY && MdtSingleLimitGetDamping(stop[i]) == 0);
}

static void changeLimit(MdtLimitID l) {
    MdtSingleLimitSetStop(MdtLimitGetLowerLimit(l), -1);
    MdtSingleLimitSetDamping(MdtLimitGetLowerLimit(l), 1);
    MdtSingleLimitSetStiffness(MdtLimitGetUpperLimit(l), 1);
    MdtSingleLimitSetRestitution(MdtLimitGetUpperLimit(l), .5);
    MdtLimitSetStiffnessThreshold(l, 10);
    MdtLimitSetPosition(l, 5);
    MdtLimitActivateLimits(l, 1);
    MdtLimitSetLimitedForceMotor(l, 1, 2);
}

static void defaultsOfBSJoint(MdtBSJointID j) {
    assertFrames(MdtBSJointQuaConstraint(j));
}

static void changeBSJoint(MdtBSJointID j) {
    (void)j;
}

static void defaultsOfHinge(MdtHingeID j) {
    assertFrames(MdtHingeQuaConstraint(j));
    assertLimit(MdtHingeGetLimit(j));
}

static void changeHinge(MdtHingeID j) {
    changeLimit(MdtHingeGetLimit(j));
}

static void defaultsOfPrismatic(MdtPrismaticID j) {
    assertFrames(MdtPrismaticQuaConstraint(j));
    assertLimit(MdtPrismaticGetLimit(j));
}

static void changePrismatic(MdtPrismaticID j) {
    changeLimit(MdtPrismaticGetLimit(j));
}

static void defaultsOfUniversal(MdtUniversalID j) {
    assertFrames(MdtUniversalQuaConstraint(j)); /* x of the first body, y of the second */
}

static void changeUniversal(MdtUniversalID j) {
    MdtUniversalSetAxis(j, 0, 0, 0, 1);
}

static void defaultsOfAngular3(MdtAngular3ID j) {
    assertFrames(MdtAngular3QuaConstraint(j));
    ck_assert(!MdtAngular3RotationIsEnabled(j));
    ck_assert(MdtAngular3GetStiffness(j) == MEINFINITY && MdtAngular3GetDamping(j) == MEINFINITY);
}

static void changeAngular3(MdtAngular3ID j) {
    MdtAngular3EnableRotation(j, 5);
    ck_assert_int_eq(MdtAngular3RotationIsEnabled(j), 1);
    MdtAngular3SetStiffness(j, 3);
    MdtAngular3SetDamping(j, 4);
    ck_assert(MdtAngular3GetStiffness(j) == 3 && MdtAngular3GetDamping(j) == 4);
}

static void defaultsOfCarWheel(MdtCarWheelID j) {
    const MdtConstraintID c = MdtCarWheelQuaConstraint(j);
    for (unsigned int k = 0; k < 2; k++) {
        assertAtCentre(c, k);
        assertAxes(c, k, Z, Y); /* steering z of the first body, hinge y of the second */
    }
    ck_assert(!MdtCarWheelIsSteeringLocked(j));
    ck_assert(MdtCarWheelGetSteeringMotorMaxForce(j) == (MeReal)1e9 &&
              MdtCarWheelGetSteeringMotorDesiredVelocity(j) == 0);
    ck_assert(MdtCarWheelGetHingeMotorMaxForce(j) == 0 && MdtCarWheelGetHingeMotorDesiredVelocity(j) == 0);
    ck_assert(MdtCarWheelGetSuspensionHighLimit(j) == (MeReal)1e9 &&
              MdtCarWheelGetSuspensionLowLimit(j) == (MeReal)-1e9 && MdtCarWheelGetSuspensionReference(j) == 0);
    ck_assert(MdtCarWheelGetSuspensionKp(j) == 0 && MdtCarWheelGetSuspensionKd(j) == 0 &&
              MdtCarWheelGetSuspensionLimitSoftness(j) == 0);
    ck_assert(MdtCarWheelGetSteeringAngle(j) == 0 && MdtCarWheelGetSuspensionHeight(j) == 0 &&
              MdtCarWheelGetHingeAngle(j) == 0);
}

static void changeCarWheel(MdtCarWheelID j) {
    MdtCarWheelSetSteeringLock(j, 1);
    MdtCarWheelSetSteeringLimitedForceMotor(j, 1, 2);
    MdtCarWheelSetHingeLimitedForceMotor(j, 3, 4);
    MdtCarWheelSetSuspension(j, 5, 6, 7, -8, 9, 1);
    ck_assert(MdtCarWheelIsSteeringLocked(j) && MdtCarWheelGetSteeringMotorDesiredVelocity(j) == 1 &&
              MdtCarWheelGetSteeringMotorMaxForce(j) == 2);
    ck_assert(MdtCarWheelGetHingeMotorDesiredVelocity(j) == 3 && MdtCarWheelGetHingeMotorMaxForce(j) == 4);
    ck_assert(MdtCarWheelGetSuspensionKp(j) == 5 && MdtCarWheelGetSuspensionKd(j) == 6 &&
              MdtCarWheelGetSuspensionLimitSoftness(j) == 7 && MdtCarWheelGetSuspensionLowLimit(j) == -8 &&
              MdtCarWheelGetSuspensionHighLimit(j) == 9 && MdtCarWheelGetSuspensionReference(j) == 1);
}

static void defaultsOfLinear1(MdtLinear1ID j) {
    assertFrames(MdtLinear1QuaConstraint(j));
}

static void changeLinear1(MdtLinear1ID j) {
    (void)j;
}

static void defaultsOfLinear2(MdtLinear2ID j) {
    assertFrames(MdtLinear2QuaConstraint(j));
}

static void changeLinear2(MdtLinear2ID j) {
    MdtLinear2SetDirection(j, 0, 0, 1);
}

static void defaultsOfFixedPath(MdtFixedPathID j) {
    for (unsigned int k = 0; k < 2; k++) {
        MeVector3 v;
        MdtFixedPathGetPosition(j, k, v);
        assert_vec3_near(v, 0, 0, 0, 0);
        MdtFixedPathGetVelocity(j, k, v);
        assert_vec3_near(v, 0, 0, 0, 0);
    }
}

static void changeFixedPath(MdtFixedPathID j) {
    for (unsigned int k = 0; k < 2; k++) {
        MdtFixedPathSetPosition(j, k, 1, 2, 3);
        MdtFixedPathSetVelocity(j, k, 4, 5, 6);
    }
}

static void defaultsOfFPFOJoint(MdtFPFOJointID j) {
    assertFrames(MdtFPFOJointQuaConstraint(j));
}

static void changeFPFOJoint(MdtFPFOJointID j) {
    MdtFPFOJointSetPosition(j, 1, 1, 1);
}

static void defaultsOfRPROJoint(MdtRPROJointID j) {
    MeVector4 q;
    MeVector3 v;
    MdtRPROJointGetRelativeQuaternion(j, q);
    ck_assert(q[0] == 1 && q[1] == 0 && q[2] == 0 && q[3] == 0);
    MdtRPROJointGetRelativeAngularVelocity(j, v);
    assert_vec3_near(v, 0, 0, 0, 0);
    MdtRPROJointGetLinearStrength(j, v);
    ck_assert(v[0] == MEINFINITY && v[1] == MEINFINITY && v[2] == MEINFINITY);
    MdtRPROJointGetAngularStrength(j, v);
    ck_assert(v[0] == MEINFINITY && v[1] == MEINFINITY && v[2] == MEINFINITY);
    for (unsigned int k = 0; k < 2; k++) {
        MdtRPROJointGetAttachmentPosition(j, k, v);
        assert_vec3_near(v, 0, 0, 0, 0);
        MdtRPROJointGetAttachmentQuaternion(j, k, q);
        ck_assert(q[0] == 1 && q[1] == 0 && q[2] == 0 && q[3] == 0);
    }
}

static void changeRPROJoint(MdtRPROJointID j) {
    const MeVector4 q = {3, 0, 4, 0};
    MeVector3 v = {1, 2, 3};
    MeVector4 back;
    MdtRPROJointSetRelativeQuaternion(j, q); /* is normalized */
    MdtRPROJointGetRelativeQuaternion(j, back);
    assert_near(back[0], .6, TOL(1e-7, 1e-15));
    assert_near(back[2], .8, TOL(1e-7, 1e-15));
    MdtRPROJointSetRelativeAngularVelocity(j, v);
    MdtRPROJointSetLinearStrength(j, 1, 2, 3);
    MdtRPROJointSetAngularStrength(j, 4, 5, 6);
    for (unsigned int k = 0; k < 2; k++) {
        MdtRPROJointSetAttachmentPosition(j, 1, 2, 3, k);
        MdtRPROJointSetAttachmentQuaternion(j, 1, 1, 1, 1, k);
        MdtRPROJointGetAttachmentQuaternion(j, k, back);
        for (int i = 0; i < 4; i++)
            assert_near(back[i], .5, TOL(1e-7, 1e-15));
    }
}

/* Both stops soft and damped, at the length at which the bodies are attached: 1 m. */
static void defaultsOfSpring(MdtSpringID j) {
    const MdtLimitID l = MdtSpringGetLimit(j);
    const MdtSingleLimitID stop[2] = {MdtLimitGetLowerLimit(l), MdtLimitGetUpperLimit(l)};
    assertFrames(MdtSpringQuaConstraint(j));
    for (int i = 0; i < 2; i++)
        ck_assert(MdtSingleLimitGetStiffness(stop[i]) > 0 && MdtSingleLimitGetStiffness(stop[i]) < MEINFINITY &&
                  MdtSingleLimitGetDamping(stop[i]) > 0);
    ck_assert(!MdtLimitIsMotorized(l));
}

static void changeSpring(MdtSpringID j) {
    MdtSpringSetStiffness(j, MEINFINITY);
    MdtSpringSetDamping(j, 0);
    MdtSpringSetNaturalLength(j, 3);
    MdtSpringSetPosition(j, 1, 1, 1, 1);
    MdtLimitSetLimitedForceMotor(MdtSpringGetLimit(j), 1, 1);
}

static void defaultsOfSpring6(MdtSpring6ID j) {
    assertFrames(MdtSpring6QuaConstraint(j));
    for (int i = 0; i < 3; i++) {
        ck_assert(MdtSpring6GetLinearStiffness(j, i) == 0 && MdtSpring6GetLinearDamping(j, i) == 0);
        ck_assert(MdtSpring6GetAngularStiffness(j, i) == 0 && MdtSpring6GetAngularDamping(j, i) == 0);
    }
}

static void changeSpring6(MdtSpring6ID j) {
    for (int i = 0; i < 3; i++) {
        MdtSpring6SetLinearStiffness(j, i, 1. + i);
        MdtSpring6SetLinearDamping(j, i, 4. + i);
        MdtSpring6SetAngularStiffness(j, i, 7. + i);
        MdtSpring6SetAngularDamping(j, i, 10. + i);
    }
    for (int i = 0; i < 3; i++) {
        ck_assert(MdtSpring6GetLinearStiffness(j, i) == (MeReal)(1 + i) &&
                  MdtSpring6GetLinearDamping(j, i) == (MeReal)(4 + i));
        ck_assert(MdtSpring6GetAngularStiffness(j, i) == (MeReal)(7 + i) &&
                  MdtSpring6GetAngularDamping(j, i) == (MeReal)(10 + i));
    }
}

static void defaultsOfConeLimit(MdtConeLimitID j) {
    assertFrames(MdtConeLimitQuaConstraint(j));
    ck_assert(MdtConeLimitGetConeHalfAngle(j) == ME_PI);
    ck_assert(MdtConeLimitGetStiffness(j) == MEINFINITY && MdtConeLimitGetDamping(j) == MEINFINITY);
}

static void changeConeLimit(MdtConeLimitID j) {
    MdtConeLimitSetConeHalfAngle(j, 1);
    MdtConeLimitSetStiffness(j, 2);
    MdtConeLimitSetDamping(j, 3);
    ck_assert(MdtConeLimitGetConeHalfAngle(j) == 1 && MdtConeLimitGetStiffness(j) == 2 &&
              MdtConeLimitGetDamping(j) == 3);
}

static void defaultsOfSkeletal(MdtSkeletalID j) {
    const MeReal quarter = ME_PI / 4;
    assertFrames(MdtSkeletalQuaConstraint(j));
    ck_assert(MdtSkeletalGetConePrimaryLimitAngle(j) == quarter &&
              MdtSkeletalGetConeSecondaryLimitAngle(j) == quarter && MdtSkeletalGetTwistLimitAngle(j) == quarter);
    ck_assert(MdtSkeletalGetConeStiffness(j) == MEINFINITY && MdtSkeletalGetConeDamping(j) == MEINFINITY);
    ck_assert(MdtSkeletalGetTwistStiffness(j) == MEINFINITY && MdtSkeletalGetTwistDamping(j) == MEINFINITY);
    ck_assert(MdtSkeletalGetConeOption(j) == MdtSkeletalConeOptionCone &&
              MdtSkeletalGetTwistOption(j) == MdtSkeletalTwistOptionLimited);
}

static void changeSkeletal(MdtSkeletalID j) {
    MdtSkeletalSetConePrimaryLimitAngle(j, 1);
    MdtSkeletalSetConeSecondaryLimitAngle(j, 2);
    MdtSkeletalSetTwistLimitAngle(j, 3);
    MdtSkeletalSetConeStiffness(j, 4);
    MdtSkeletalSetConeDamping(j, 5);
    MdtSkeletalSetTwistStiffness(j, 6);
    MdtSkeletalSetTwistDamping(j, 7);
    MdtSkeletalSetConeOption(j, MdtSkeletalConeOptionFree);
    MdtSkeletalSetTwistOption(j, MdtSkeletalTwistOptionFree);
    ck_assert(MdtSkeletalGetConePrimaryLimitAngle(j) == 1 && MdtSkeletalGetConeSecondaryLimitAngle(j) == 2 &&
              MdtSkeletalGetTwistLimitAngle(j) == 3);
    ck_assert(MdtSkeletalGetConeStiffness(j) == 4 && MdtSkeletalGetConeDamping(j) == 5 &&
              MdtSkeletalGetTwistStiffness(j) == 6 && MdtSkeletalGetTwistDamping(j) == 7);
    ck_assert(MdtSkeletalGetConeOption(j) == MdtSkeletalConeOptionFree &&
              MdtSkeletalGetTwistOption(j) == MdtSkeletalTwistOptionFree);
}

static void defaultsOfUserConstraint(MdtUserConstraintID j) {
    assertFrames(MdtUserConstraintQuaConstraint(j));
}

static void changeUserConstraint(MdtUserConstraintID j) {
    MdtUserConstraintSetFunction(j, noRows);
    ck_assert(MdtUserConstraintGetFunction(j) == noRows);
}

static void defaultsOfGear(MdtGearID j) {
    assertFrames(MdtGearQuaConstraint(j));
    ck_assert(MdtGearGetRatio(j) == 1 && !MdtGearGetHousing(j));
    ck_assert(MdtGearGetCoordinate(j, 0) == 0 || MdtGearGetBody(j, 0)); /* the poses of reset have not engaged it */
}

static void changeGear(MdtGearID j) {
    MdtGearSetRack(j, 3);
    ck_assert(MdtGearGetRatio(j) == 3);
    MdtGearSetTeeth(j, 10, -20);
    ck_assert(MdtGearGetRatio(j) == (MeReal)-.5);
    MdtGearSetHousing(j, MdtGearGetBody(j, 1));
    ck_assert(MdtGearGetHousing(j) == MdtGearGetBody(j, 1));
    MdtGearBodySetAxis(j, 0, 1, 2, 3);
}

static void defaultsOfPulley(MdtPulleyID j) {
    MeVector3 p;
    assertFrames(MdtPulleyQuaConstraint(j));
    ck_assert(MdtPulleyGetRatio(j) == 1 && !MdtPulleyGetSlack(j) && MdtPulleyGetLength(j) == 0);
    for (unsigned int k = 0; k < 2; k++) {
        MdtPulleyGetWheel(j, k, p);
        assert_vec3_near(p, 0, 0, 0, 0);
    }
}

static void changePulley(MdtPulleyID j) {
    MeVector3 p;
    MdtPulleySetRatio(j, 2);
    MdtPulleySetLength(j, 3);
    MdtPulleySetSlack(j, 5);
    MdtPulleySetWheel(j, 1, 4, 5, 6);
    ck_assert(MdtPulleyGetRatio(j) == 2 && MdtPulleyGetLength(j) == 3 && MdtPulleyGetSlack(j) == 1);
    MdtPulleyGetWheel(j, 1, p);
    assert_vec3_near(p, 4, 5, 6, 0);
    MdtPulleySetPosition(j, 1, 7, 8, 9);
    MdtPulleyGetPosition(j, 1, p);
    assert_vec3_near(p, 7, 8, 9, TOL(1e-6, 1e-14));
}

static void defaultsOfMimic(MdtMimicID j) {
    ck_assert(MdtMimicGetRatio(j) == 1 && MdtMimicGetOffset(j) == 0);
    ck_assert(!MdtMimicGetJoint(j, 0) && !MdtMimicGetJoint(j, 1));
}

static void changeMimic(MdtMimicID j) {
    MdtMimicSetRatio(j, 2);
    MdtMimicSetOffset(j, 3);
    ck_assert(MdtMimicGetRatio(j) == 2 && MdtMimicGetOffset(j) == 3);
}

/* Frames that can be changed by all constraints' functions, and the rest by the joint's own. */
static void changeFrames(MdtConstraintID c) {
    MdtConstraintSetPosition(c, 4, 5, 6);
    MdtConstraintSetAxes(c, 0, 1, 0, 0, 0, 1);
}

TEST(reset_restores_the_defaults_and_leaves_the_bodies) {
    Stage s = makeStage(19);
#define DEFAULTS(Joint)                                                                                                \
    {                                                                                                                  \
        Mdt##Joint##ID j = Mdt##Joint##Create(s.world);                                                                \
        int data;                                                                                                      \
        defaultsOf##Joint(j);                                                                                          \
        Mdt##Joint##SetBodies(j, s.a, s.b);                                                                            \
        Mdt##Joint##SetUserData(j, &data);                                                                             \
        Mdt##Joint##SetSortKey(j, 5);                                                                                  \
        Mdt##Joint##Enable(j);                                                                                         \
        changeFrames(Mdt##Joint##QuaConstraint(j));                                                                    \
        change##Joint(j);                                                                                              \
        Mdt##Joint##Reset(j);                                                                                          \
        defaultsOf##Joint(j);                                                                                          \
        ck_assert(Mdt##Joint##GetBody(j, 0) == s.a && Mdt##Joint##GetBody(j, 1) == s.b);                               \
        ck_assert(Mdt##Joint##IsEnabled(j) && Mdt##Joint##GetUserData(j) == &data && Mdt##Joint##GetSortKey(j) == 5);  \
        Mdt##Joint##Destroy(j);                                                                                        \
    }
    FOR_ALL_JOINTS(DEFAULTS)
}

/* ---- numbers that a joint cannot have: a warning, and nothing is changed ---- */

TEST(numbers_that_a_joint_cannot_have) {
    const MeReal bad[] = {NAN, INFINITY, -1};
    Stage s = makeStage(19);
    const MdtAngular3ID angular = MdtAngular3Create(s.world);
    const MdtCarWheelID wheel = MdtCarWheelCreate(s.world);
    const MdtFixedPathID path = MdtFixedPathCreate(s.world);
    const MdtRPROJointID rpro = MdtRPROJointCreate(s.world);
    const MdtSpringID spring = MdtSpringCreate(s.world);
    const MdtSpring6ID six = MdtSpring6Create(s.world);
    const MdtConeLimitID cone = MdtConeLimitCreate(s.world);
    const MdtSkeletalID skeletal = MdtSkeletalCreate(s.world);
    const MdtUniversalID universal = MdtUniversalCreate(s.world);
    const MdtGearID gear = MdtGearCreate(s.world);
    const MdtPulleyID pulley = MdtPulleyCreate(s.world);
    const MdtMimicID mimic = MdtMimicCreate(s.world);
    assert_silent();
    const MdtBclSingleLimit before = *MdtLimitGetLowerLimit(MdtSpringGetLimit(spring));
    for (int i = 0; i < 3; i++) {
        const MeReal x = bad[i];
        WARNS(MdtAngular3SetStiffness(angular, x));
        WARNS(MdtAngular3SetDamping(angular, x));
        WARNS(MdtCarWheelSetSuspension(wheel, x, 0, 0, 0, 0, 0));
        WARNS(MdtCarWheelSetSuspension(wheel, 0, x, 0, 0, 0, 0));
        WARNS(MdtCarWheelSetSuspension(wheel, 0, 0, x, 0, 0, 0));
        WARNS(MdtRPROJointSetLinearStrength(rpro, 1, x, 1));
        WARNS(MdtRPROJointSetAngularStrength(rpro, 1, 1, x));
        WARNS(MdtSpringSetStiffness(spring, x));
        WARNS(MdtSpringSetDamping(spring, x));
        WARNS(MdtSpringSetNaturalLength(spring, x));
        WARNS(MdtSpring6SetLinearStiffness(six, 0, x));
        WARNS(MdtSpring6SetAngularDamping(six, 2, x));
        WARNS(MdtConeLimitSetStiffness(cone, x));
        WARNS(MdtConeLimitSetDamping(cone, x));
        WARNS(MdtSkeletalSetConeStiffness(skeletal, x));
        WARNS(MdtSkeletalSetTwistDamping(skeletal, x));
        WARNS(MdtPulleySetRatio(pulley, x));
        WARNS(MdtPulleySetLength(pulley, x));
    }
    for (int i = 0; i < 2; i++) {
        const MeReal x = bad[i];
        const MeVector4 q = {1, x, 0, 0};
        MeVector3 v = {0, 0, x};
        WARNS(MdtCarWheelSetSuspension(wheel, 0, 0, 0, x, 0, 0));
        WARNS(MdtCarWheelSetSuspension(wheel, 0, 0, 0, 0, x, 0));
        WARNS(MdtCarWheelSetSuspension(wheel, 0, 0, 0, 0, 0, x));
        WARNS(MdtCarWheelSetSteeringLimitedForceMotor(wheel, x, 0));
        WARNS(MdtCarWheelSetHingeLimitedForceMotor(wheel, 0, x));
        WARNS(MdtCarWheelSetSteeringAxis(wheel, x, 0, 0));
        WARNS(MdtCarWheelSetHingeAxis(wheel, 0, 0, x));
        WARNS(MdtFixedPathSetPosition(path, 0, x, 0, 0));
        WARNS(MdtFixedPathSetVelocity(path, 1, 0, 0, x));
        WARNS(MdtRPROJointSetRelativeQuaternion(rpro, q));
        WARNS(MdtRPROJointSetRelativeAngularVelocity(rpro, v));
        WARNS(MdtRPROJointSetAttachmentPosition(rpro, x, 0, 0, 0));
        WARNS(MdtRPROJointSetAttachmentQuaternion(rpro, 1, 0, x, 0, 0));
        WARNS(MdtSpringSetPosition(spring, 0, x, 0, 0));
        WARNS(MdtConeLimitSetConeHalfAngle(cone, x));
        WARNS(MdtSkeletalSetConePrimaryLimitAngle(skeletal, x));
        WARNS(MdtUniversalSetAxis(universal, 0, 0, x, 0));
        WARNS(MdtGearSetRatio(gear, x));
        WARNS(MdtGearSetRack(gear, x));
        WARNS(MdtGearBodySetAxis(gear, 0, x, 0, 0));
        WARNS(MdtPulleySetWheel(pulley, 0, 0, x, 0));
        WARNS(MdtPulleySetPosition(pulley, 0, 0, x, 0));
        WARNS(MdtMimicSetRatio(mimic, x));
        WARNS(MdtMimicSetOffset(mimic, x));
    }
    WARNS(MdtCarWheelSetSuspension(wheel, 1, 1, 0, 1, 0, 0)); /* low above high */
    WARNS(MdtFixedPathSetPosition(path, 2, 0, 0, 0));
    WARNS(MdtRPROJointSetAttachmentPosition(rpro, 0, 0, 0, 2));
    WARNS(MdtRPROJointSetAttachmentQuaternion(rpro, 0, 0, 0, 0, 1));
    WARNS(MdtRPROJointSetRelativeQuaternion(rpro, NULL));
    WARNS(MdtSpring6SetLinearStiffness(six, 3, 1));
    WARNS_0(MdtSpring6GetAngularDamping(six, -1));
    WARNS(MdtUniversalSetAxis(universal, 2, 1, 0, 0));
    WARNS(MdtUniversalSetAxis(universal, 0, 0, 0, 0));
    WARNS(MdtGearSetRatio(gear, 0));
    WARNS(MdtGearSetTeeth(gear, 0, 1));
    WARNS(MdtGearSetTeeth(gear, 1, 0));
    WARNS(MdtGearSetRack(gear, 0));
    WARNS(MdtGearSetHousing(gear, s.a));
    WARNS(MdtGearBodySetAxis(gear, 0, 0, 0, 0));
    WARNS(MdtGearBodySetAxis(gear, 2, 0, 0, 1));
    WARNS_0(MdtGearGetCoordinate(gear, 2));
    WARNS(MdtPulleySetRatio(pulley, 0));
    WARNS(MdtPulleySetWheel(pulley, 2, 0, 0, 0));
    WARNS_0(MdtPulleyGetDistance(pulley, 2));
    WARNS_0(MdtMimicGetJoint(mimic, 2));
    WARNS(MdtSkeletalSetConeOption(skeletal, (MdtSkeletalConeOption)4));
    WARNS(MdtSkeletalSetTwistOption(skeletal, (MdtSkeletalTwistOption)3));
    caught.warnings = 0;
    defaultsOfAngular3(angular);
    defaultsOfCarWheel(wheel);
    defaultsOfFixedPath(path);
    defaultsOfRPROJoint(rpro);
    defaultsOfSpring(spring);
    ck_assert(memcmp(&before, MdtLimitGetLowerLimit(MdtSpringGetLimit(spring)), sizeof before) == 0);
    defaultsOfSpring6(six);
    defaultsOfConeLimit(cone);
    defaultsOfSkeletal(skeletal);
    defaultsOfUniversal(universal);
    defaultsOfGear(gear);
    defaultsOfPulley(pulley);
    defaultsOfMimic(mimic);
    MdtConeLimitSetConeHalfAngle(cone, -1); /* clamped */
    ck_assert(MdtConeLimitGetConeHalfAngle(cone) == 0);
    MdtConeLimitSetConeHalfAngle(cone, 4);
    ck_assert(MdtConeLimitGetConeHalfAngle(cone) == ME_PI);
    MdtCarWheelSetHingeLimitedForceMotor(wheel, 1, -5);
    ck_assert(MdtCarWheelGetHingeMotorMaxForce(wheel) == 0);
}
