/* Documented behaviours: what all constraints share (Dynamics guide ch. 3, "Common Constraint Functions",
 * "Base Constraint Functions").
 *
 * Already proved elsewhere:
 *   a created constraint acts only after Enable             test_Constraint: a_constraint_acts_only_when_enabled
 *   a second body of null is the world                      test_BSJoint: sag_is_epsilon_force_step_squared_over_gamma
 *   it has to be disabled before its bodies change; a warning  test_Constraint: changing_the_bodies_of_an_enabled_...
 *   MdtConstraintSetAxes normalizes and makes orthogonal    test_Constraint: frames_are_given_in_the_world_...
 *   reset brings the defaults of each type back             test_JointLife: reset_restores_the_defaults_and_...
 *   positions and axes are the world's and move with bodies  test_Constraint: frames_are_given_in_the_world_...
 */
#include "behaviour.h"

#define EVERY_JOINT(X)                                                                                                 \
    X(Angular3)                                                                                                        \
    X(BSJoint)                                                                                                         \
    X(CarWheel)                                                                                                        \
    X(ConeLimit)                                                                                                       \
    X(FPFOJoint)                                                                                                       \
    X(FixedPath)                                                                                                       \
    X(Hinge)                                                                                                           \
    X(Linear1)                                                                                                         \
    X(Linear2)                                                                                                         \
    X(Prismatic)                                                                                                       \
    X(RPROJoint)                                                                                                       \
    X(Spring)                                                                                                          \
    X(Universal)                                                                                                       \
    X(Spring6)                                                                                                         \
    X(Skeletal)                                                                                                        \
    X(Contact)
enum { TYPES = 16 };

/* One of every type, to be recognized again. */
typedef struct {
    MdtWorldID world;
    MdtBodyID a, b;
    int count;
    MdtConstraintID constraint[TYPES];
    const char *name[TYPES];
} Zoo;

static Zoo makeZoo(void) {
    Zoo z = {.world = scene_world(3, 2 * TYPES, 0)};
    z.a = scene_body(z.world, 1, 0, 0, 0);
    z.b = scene_body(z.world, 2, 1, .5, 0);
#define ADD(Type)                                                                                                      \
    z.name[z.count] = #Type;                                                                                           \
    z.constraint[z.count++] = Mdt##Type##QuaConstraint(Mdt##Type##Create(z.world));
    EVERY_JOINT(ADD)
    return z;
}

/* Ch. 3: bodies are placed, then attached, then the position is set: it is then one point of both, and moves with
 * each. */
TEST(bodies_are_placed_attached_and_then_the_position_is_set) {
    MdtWorldID w = scene_world(2, 1, 0);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0), b = scene_body(w, 1, 4, 0, 0);
    MdtBSJointID j = MdtBSJointCreate(w);
    MdtConstraintID c = MdtBSJointQuaConstraint(j);
    MeVector3 p;
    MdtBSJointSetBodies(j, a, b);
    MdtBSJointSetPosition(j, 1, 2, 3);
    assert_near(gapOf(c), 0, TOL(1e-6, 9e-14));
    MdtBSJointGetPosition(j, p);
    assert_vec3_near(p, 1, 2, 3, TOL(1e-6, 3e-13));
    MdtConstraintBodyGetPositionRel(c, 1, p);
    assert_vec3_near(p, -3, 2, 3, TOL(1e-6, 3e-13));
    MdtBodySetPosition(b, 5, 0, 0); /* moved after that: an error that the joint has to work off */
    assert_near(gapOf(c), 1, TOL(1e-6, 9e-14));
    MdtBSJointEnable(j);
    steps(w, 120, FRAME);
    assert_near(gapOf(c), 0, TOL(1e-6, 3e-11));
    MdtWorldDestroy(w);
}

/* Places the two bodies apart, one above the other's side, and lets them move towards each other and turn. */
static void setMoving(Zoo *z) {
    MdtBodySetPosition(z->a, 0, 0, 0);
    MdtBodySetQuaternion(z->a, 1, 0, 0, 0);
    MdtBodySetPosition(z->b, 1, .5, 0);
    MdtBodySetQuaternion(z->b, 1, 0, 0, 0);
    MdtBodySetLinearVelocity(z->a, .5, 2, .3);
    MdtBodySetAngularVelocity(z->a, .2, -.4, .7);
    MdtBodySetLinearVelocity(z->b, -.1, .2, -.5);
    MdtBodySetAngularVelocity(z->b, -.3, .1, .6);
}

/* Gives the constraint something to do between the two bodies. */
static void setTask(Zoo *z, MdtConstraintID c) {
    MdtConstraintSetBodies(c, z->a, z->b);
    if (MdtConstraintDCastContact(c)) {
        /* of balls, half-way between their centres: flat, it would turn with both within the step, and its arms too */
        MdtContactSetPosition(MdtConstraintDCastContact(c), .5, .25, 0);
        MdtContactSetNormal(MdtConstraintDCastContact(c), -2, -1, 0);
        for (unsigned int k = 0; k < 2; k++)
            MdtContactSetRadius(MdtConstraintDCastContact(c), k, sqrt(.3125));
        MdtContactParamsSetType(MdtContactGetParams(MdtConstraintDCastContact(c)), MdtContactTypeFriction2D);
    } else if (!MdtConstraintDCastSpring(c))
        MdtConstraintSetPosition(c, .4, .3, .2);
    if (MdtConstraintDCastConeLimit(c)) {
        MdtConeLimitSetConeHalfAngle(MdtConstraintDCastConeLimit(c), .2);
        MdtBodySetQuaternion(z->b, 1, 0, 0, .3);
    }
    for (int k = 0; k < 3; k++)
        if (MdtConstraintDCastSpring6(c)) {
            MdtSpring6SetLinearDamping(MdtConstraintDCastSpring6(c), k, 50);
            MdtSpring6SetAngularDamping(MdtConstraintDCastSpring6(c), k, 1);
        }
}

static double dot(const MeVector3 a, const MeVector3 b) {
    return (double)a[0] * b[0] + (double)a[1] * b[1] + (double)a[2] * b[2];
}

/* The size of a vector that a function of a body gives. */
static double sizeOf(double (*part)(MdtBodyID, int), MdtBodyID b) {
    return sqrt(pow(part(b, 0), 2) + pow(part(b, 1), 2) + pow(part(b, 2), 2));
}

/* Ch. 3: force and torque of the last step, in the world's frame. Those on the two bodies are action and reaction: the
 * forces are opposite, and together with the torques have no moment about where the bodies were in the mean of the step
 * (a contact: where it was found); and they are what changed the momenta, F h = m Δv and T h = I Δω (these bodies are
 * spheres). The latter is so but for the part of a jerk that acts where the bodies have arrived: its direction has
 * turned on by up to ω h/2 from the mean one, with which it is reported, and its arm has moved by up to v h/2 too. */
TEST(forces_are_the_last_step_s_and_opposite_on_the_two_bodies) {
    Zoo z = makeZoo();
    const double start[2][3] = {{0, 0, 0}, {1, .5, 0}}, mass[2] = {1, 2}, h = (double)FRAME, reach = sqrt(1.25);
    for (int i = 0; i < z.count; i++) {
        setMoving(&z);
        setTask(&z, z.constraint[i]);
        MdtConstraintEnable(z.constraint[i]);
        double v[2][3], w[2][3], at[2][3], moment[3] = {0}, sum[3] = {0}, size = 0;
        double rate = fmax(sizeOf(spin, z.a), sizeOf(spin, z.b));
        const double speed = sizeOf(velocity, z.a) + sizeOf(velocity, z.b);
        for (int k = 0; k < 2; k++)
            for (int axis = 0; axis < 3; axis++) {
                v[k][axis] = velocity(k ? z.b : z.a, axis);
                w[k][axis] = spin(k ? z.b : z.a, axis);
            }
        MdtWorldStep(z.world, FRAME);
        const MeBool isContact = MdtConstraintDCastContact(z.constraint[i]) != NULL;
        for (int k = 0; k < 2; k++)
            for (int axis = 0; axis < 3; axis++)
                at[k][axis] = isContact ? start[k][axis] : (start[k][axis] + coordinate(k ? z.b : z.a, axis)) / 2;
        rate = fmax(rate, fmax(sizeOf(spin, z.a), sizeOf(spin, z.b)));
        for (unsigned int k = 0; k < 2; k++) {
            MeVector3 f, t;
            MdtConstraintGetForce(z.constraint[i], k, f);
            MdtConstraintGetTorque(z.constraint[i], k, t);
            const double turn = isContact ? 0 : rate * h / 2, shift = isContact ? 0 : speed * h / 2;
            const double F = sqrt(dot(f, f)), L = sqrt(dot(t, t));
            for (int axis = 0; axis < 3; axis++) {
                const int p = (axis + 1) % 3, q = (axis + 2) % 3;
                const MdtBodyID b = k ? z.b : z.a;
                size = fmax(size, fmax(fabs(f[axis]), fabs(t[axis])));
                sum[axis] += (double)f[axis];
                moment[axis] += (double)t[axis] + at[k][p] * (double)f[q] - at[k][q] * (double)f[p];
                assert_near((double)f[axis] * h, mass[k] * (velocity(b, axis) - v[k][axis]),
                            TOL(2e-6, 1e-12) + turn * F * h);
                assert_near((double)t[axis] * h, .4 * (spin(b, axis) - w[k][axis]),
                            TOL(2e-6, 1e-12) + (turn * (F * reach + L) + shift * F) * h);
            }
        }
        ck_assert_msg(size > 1, "%s did nothing", z.name[i]);
        assert_vec3_near(sum, 0, 0, 0, TOL(8e-7, 7e-14) * size);
        /* the sides' points are apart by up to ε F h² where the joint gives way, half of it in the mean */
        const double sag = (double)MdtWorldGetEpsilon(z.world) * size * h * h;
        assert_vec3_near(moment, 0, 0, 0, TOL(8e-7, 3e-14) * size + sag * size);
        MdtConstraintDisable(z.constraint[i]);
    }
    MdtWorldDestroy(z.world);
}

/* Ch. 3, MdtConstraintSetAxes: the third axis is the cross product of the two, so the pair is a full orientation. */
TEST(two_axes_make_a_right_handed_frame) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0);
    MdtRPROJointID j = MdtRPROJointCreate(w);
    MdtConstraintID c = MdtRPROJointQuaConstraint(j);
    MeVector4 q;
    MdtRPROJointSetBodies(j, a, 0);
    MdtConstraintBodySetAxes(c, 0, 0, 7, 0, 0, 0, 2); /* x to y, y to z, so the third is x: a third of a turn */
    MdtRPROJointGetAttachmentQuaternion(j, 0, q);
    const double sign = q[0] < 0 ? -1 : 1;
    for (int i = 0; i < 4; i++)
        assert_near(sign * (double)q[i], .5, TOL(5e-7, 5e-14));
    MdtWorldDestroy(w);
}

static int rowsOf(MdtConstraintID c) {
    MdtWorldID w = MdtConstraintGetWorld(c);
    MdtConstraintEnable(c);
    MdtWorldStep(w, FRAME);
    const int rows = MdtConstraintGetRowCount(c);
    MdtConstraintDisable(c);
    return rows;
}

/* The car wheel removes 3 to 6: what is free, the steering (a motor without force, no lock), the rolling and the
 * springing; a lock, a motor and the spring take one each. */
TEST(a_car_wheel_removes_3_to_6) {
    MdtWorldID w = scene_world(2, 1, 0);
    MdtBodyID chassis = scene_body(w, 10, 0, 0, 0), wheel = scene_body(w, 1, 1, 0, 0);
    MdtCarWheelID j = MdtCarWheelCreate(w);
    MdtConstraintID c = MdtCarWheelQuaConstraint(j);
    MdtCarWheelSetBodies(j, chassis, wheel);
    MdtCarWheelSetPosition(j, 1, 0, 0);
    MdtCarWheelSetSteeringAndHingeAxes(j, 0, 1, 0, 0, 0, 1);
    MdtCarWheelSetSteeringLimitedForceMotor(j, 0, 0);
    ck_assert_int_eq(rowsOf(c), 3);
    MdtCarWheelSetSteeringLock(j, 1);
    ck_assert_int_eq(rowsOf(c), 4);
    MdtCarWheelSetSuspension(j, 100, 10, 0, -1, 1, 0);
    ck_assert_int_eq(rowsOf(c), 5);
    MdtCarWheelSetHingeLimitedForceMotor(j, 0, 5);
    ck_assert_int_eq(rowsOf(c), 6);
    MdtWorldDestroy(w);
}
