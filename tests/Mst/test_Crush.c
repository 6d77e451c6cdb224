/* Movers that leave a body no room: doors that close on it, a press. They enter it, since nothing stops them; it is not
 * thrown out. Doors with a motor stop. */
#include "universe.h"

static const double gravity = 9.8;

enum { SOLVERS = 3 };

static void begin(int solver, double friction) {
    universe_begin(0);
    MdtWorldSetSolver(u->world, (MdtSolver)solver);
    MdtWorldSetGravity(u->world, 0, 0, (MeReal)-gravity);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal)friction, 0);
    universe_addFloor();
}

static MdtBodyID box(double lx, double ly, double lz, double x, double y, double z) {
    const McdGeometryID g = McdBoxCreate(u->frame, (MeReal)lx, (MeReal)ly, (MeReal)lz);
    const MdtBodyID b = McdModelGetBody(MstModelAndBodyCreate(u, g, 1000));
    MdtBodySetPosition(b, (MeReal)x, (MeReal)y, (MeReal)z);
    return b;
}

static MdtBodyID mover(double lx, double ly, double lz, double x, double y, double z) {
    const MdtBodyID b = box(lx, ly, lz, x, y, z);
    MdtBodySetKinematic(b, METRUE);
    return b;
}

static void moveTo(MdtBodyID b, double x, double y, double z) {
    const MeVector3 position = {(MeReal)x, (MeReal)y, (MeReal)z};
    const MeVector4 quaternion = {1, 0, 0, 0};
    MdtBodyMoveTo(b, position, quaternion);
}

static double at(MdtBodyID b, int k) {
    MeVector3 x;
    MdtBodyGetPosition(b, x);
    return (double)x[k];
}

static double speedOf(MdtBodyID b) {
    MeVector3 v;
    MdtBodyGetLinearVelocity(b, v);
    return (double)MeVector3Magnitude(v);
}

/* N: the largest force of the body's contacts. */
static double forceOn(MdtBodyID b) {
    double max = 0;
    for (MdtContactID c = MdtBodyGetFirstContact(b); c; c = MdtBodyGetNextContact(b, c)) {
        MeVector3 f;
        MdtConstraintGetForce(MdtContactQuaConstraint(c), 0, f);
        max = fmax(max, (double)MeVector3Magnitude(f));
    }
    return max;
}

typedef enum { DOORS, DOOR_AND_WALL, PRESS, ASKEW, KINDS } Kind;

/* What crushes a box of a size: two movers of which one may stand, or one above the floor. */
typedef struct {
    Kind kind;
    double size;
    MdtBodyID load, side[2];
} Scene;

static Scene scene(Kind kind, double size) {
    Scene s = {kind, size, box(size, size, size, 0, 0, size / 2), {0, 0}};
    if (kind == ASKEW)
        MdtBodySetQuaternion(s.load, (MeReal).9689124, 0, 0, (MeReal).2474040); /* by half a radian */
    if (kind == PRESS)
        s.side[0] = mover(3 * size, 3 * size, .2 * size, 0, 0, 1.3 * size);
    for (int k = 0; k < 2 && kind != PRESS; k++)
        s.side[k] = mover(.2 * size, 3 * size, 3 * size, (k ? 1 : -1) * .9 * size, 0, 1.6 * size);
    return s;
}

/* Brings the movers' faces to so much of the size from the middle or, of a press, from the floor. */
static void close(const Scene *s, double half) {
    for (int k = 0; k < 2 && s->kind != PRESS; k++)
        if (k == 1 || s->kind != DOOR_AND_WALL)
            moveTo(s->side[k], (k ? 1 : -1) * (half + .1) * s->size, 0, 1.6 * s->size);
    if (s->kind == PRESS)
        moveTo(s->side[0], 0, 0, (2 * half + .1) * s->size);
}

#ifdef TEST_IS_SLOW
enum { SIZES = 1, FRICTIONS = 1 };
#else
enum { SIZES = 3, FRICTIONS = 3 };
#endif

/* From a gap of .3 of its size until a tenth of the box has no room, and back. */
static void crush(const Scene *s, double speed, int rate) {
    const double weight = 1000 * pow(s->size, 3) * gravity, wall = s->kind == DOOR_AND_WALL ? .35 : 0;
    double top = 0, force = 0, half = .8;
    for (int i = 0; i < 2 * rate && half > .45 - wall; i++) {
        half = fmax(half - speed / s->size / rate, .45 - wall);
        close(s, half);
        MstUniverseStep(u, (MeReal)(1. / rate));
        top = fmax(top, speedOf(s->load));
        force = fmax(force, forceOn(s->load));
    }
    for (int i = 0; i < rate / 2; i++) {
        MstUniverseStep(u, (MeReal)(1. / rate));
        top = fmax(top, speedOf(s->load));
    }
    ck_assert(isfinite(force) && isfinite(top));
    assert_below(5 * weight, force);                              /* it tells that the box is crushed */
    assert_below(top, 2.5 * speed + sqrt(2 * gravity * s->size)); /* twice the speed is a rebound of the fast solver */
}

LOOP_TEST(a_crushed_box_is_not_thrown_out, 0, SOLVERS *KINDS) {
    static const double sizes[] = {1, .1, 10}, frictions[] = {0, .1, 1}, speeds[] = {.1, 1, 10};
    static const int rates[] = {30, 60, 240};
    for (int k = 0; k < SIZES * FRICTIONS * 3; k++)
        for (int r = 0; r < 3; r++) {
            const double size = sizes[k / 3 / FRICTIONS], speed = speeds[k % 3];
            if (speed < .2 * size || speed > .2 * size * rates[r]) /* it would not arrive; it would jump over the box */
                continue;
            begin(_i % SOLVERS, frictions[k / 3 % FRICTIONS]);
            const Scene s = scene((Kind)(_i / SOLVERS), size);
            crush(&s, speed, rates[r]);
        }
}

/* Two boxes side by side, and a third on top, whose faces slip: the ways out among them are many. The last case is an
 * impact that crushes two boxes. */
LOOP_TEST(a_crushed_row_is_not_thrown_out, 0, SOLVERS) {
    static const double sizes[] = {2.2, .5, 8, .707}, speeds[] = {2.8, .3, 8, 5.6};
    static const int rates[] = {30, 60, 240};
    for (int k = 0; k < 10; k++) {
        const double size = sizes[k / 3], speed = speeds[k / 3], rate = rates[k % 3];
        double top = 0, x = 1.15 * size;
        begin(_i, 0);
        const MdtBodyID load[3] = {box(size, size, size, -.5 * size, 0, .5 * size),
                                   box(size, size, size, .51 * size, 0, .5 * size),
                                   box(size, size, size, 0, 0, 1.5 * size)};
        if (k == 9)
            MstModelAndBodyDestroy(MdtBodyGetModel(load[2]));
        mover(.2 * size, 3 * size, 3 * size, -x, 0, 1.6 * size);
        const MdtBodyID door = mover(.2 * size, 3 * size, 3 * size, x, 0, 1.6 * size);
        for (int i = 0; x > -.3 * size; i++) {
            x -= speed / rate;
            moveTo(door, x, 0, 1.6 * size);
            MstUniverseStep(u, (MeReal)(1 / rate));
            for (int b = 0; b < (k == 9 ? 2 : 3); b++)
                top = fmax(top, speedOf(load[b]));
        }
        assert_below(top, 3 * (speed + sqrt(gravity * size)));
    }
}

/* Doors that a motor of a bounded force moves along a rail are stopped by what they crush: its force is the motor's. */
LOOP_TEST(doors_with_a_motor_stop_at_a_box, 0, SOLVERS) {
    static const double sizes[] = {.1, 1, 10};
    for (int k = 0; k < 3; k++) {
        const double size = sizes[k], weight = 1000 * pow(size, 3) * gravity, strength = 3 * weight;
        begin(_i, .5);
        const MdtBodyID load = box(size, size, size, 0, 0, size / 2);
        MdtBodyID door[2];
        for (int side = 0; side < 2; side++) {
            const double x = (side ? 1 : -1) * .9 * size;
            door[side] = box(.2 * size, 2 * size, 2 * size, x, 0, 1.2 * size);
            MdtBodySetGravityFactor(door[side], 0);
            const MdtPrismaticID rail = MdtPrismaticCreate(u->world);
            MdtPrismaticSetBodies(rail, door[side], 0);
            MdtPrismaticSetAxis(rail, 1, 0, 0);
            MdtLimitSetLimitedForceMotor(MdtPrismaticGetLimit(rail), (MeReal)((side ? -1 : 1) * .3 * size),
                                         (MeReal)strength);
            MdtLimitActivateMotor(MdtPrismaticGetLimit(rail), METRUE);
            MdtPrismaticEnable(rail);
        }
        for (int i = 0; i < 240; i++)
            universe_step(1);
        for (int side = 0; side < 2; side++)
            assert_near(fabs(at(load, 0) - at(door[side], 0)), .6 * size, 1e-3 * size);
        assert_near(at(load, 0), 0, 1e-3 * size);
        ck_assert(forceOn(load) > .2 * strength && forceOn(load) < strength); /* of two or four points */
    }
}
