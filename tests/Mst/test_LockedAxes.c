/* Locked axes of bodies that collide: games in a plane, characters that do not tip over. Each by either solver. */
#include "universe.h"
#include "random_numbers.h"

static const double gravity = 9.8;

enum { SOLVERS = 3 };

static void begin(int solver, double friction, double restitution) {
    MstUniverseSizes sizes = MstUniverseDefaultSizes;
    sizes.dynamicBodiesMaxCount = 64;
    sizes.dynamicConstraintsMaxCount = 2000;
    universe_begin(&sizes);
    MdtWorldSetSolver(u->world, (MdtSolver)solver);
    MdtWorldSetGravity(u->world, 0, (MeReal)-gravity, 0);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(u->bridge, 0, 0), (MeReal)friction, (MeReal)restitution);
}

static MdtBodyID add(McdGeometryID g, double x, double y, double z, int axes) {
    const MdtBodyID b = McdModelGetBody(MstModelAndBodyCreate(u, g, 1000));
    MdtBodySetPosition(b, (MeReal)x, (MeReal)y, (MeReal)z);
    MdtBodySetLockedAxes(b, axes);
    return b;
}

static MdtBodyID box(double lx, double ly, double lz, double x, double y, double z, int axes) {
    return add(McdBoxCreate(u->frame, (MeReal)lx, (MeReal)ly, (MeReal)lz), x, y, z, axes);
}

static MdtBodyID ball(double radius, double x, double y, double z, int axes) {
    return add(McdSphereCreate(u->frame, (MeReal)radius), x, y, z, axes);
}

static void wall(double lx, double ly, double lz, double x, double y, double z) {
    const MeVector3 at = {(MeReal)x, (MeReal)y, (MeReal)z};
    MstFixedModelCreateAt(u, McdBoxCreate(u->frame, (MeReal)lx, (MeReal)ly, (MeReal)lz), at, 0);
}

/* The plane y = 0. */
static void floorOf(double size) {
    wall(size, 1, size, 0, -.5, 0);
}

static void turnInPlane(MdtBodyID b, double angle) {
    MdtBodySetQuaternion(b, (MeReal)cos(angle / 2), 0, 0, (MeReal)sin(angle / 2));
}

static double at(MdtBodyID b, int k) {
    MeVector3 x;
    MdtBodyGetPosition(b, x);
    return (double)x[k];
}

static double turned(MdtBodyID b, int k) {
    MeVector4 q;
    MdtBodyGetQuaternion(b, q);
    return (double)q[k];
}

static double speedAlong(MdtBodyID b, int k) {
    MeVector3 v;
    MdtBodyGetLinearVelocity(b, v);
    return (double)v[k];
}

static double spinAbout(MdtBodyID b, int k) {
    MeVector3 w;
    MdtBodyGetAngularVelocity(b, w);
    return (double)w[k];
}

/* How far a body is out of the plane z = 0: its place, its attitude, its velocities. */
static double outOfPlane(MdtBodyID b) {
    return fabs(at(b, 2)) + fabs(turned(b, 1)) + fabs(turned(b, 2)) + fabs(speedAlong(b, 2)) + fabs(spinAbout(b, 0)) +
           fabs(spinAbout(b, 1));
}

/* ---- a game in a plane ---- */

#ifdef TEST_IS_SLOW
enum { PILE = 20, STEPS = 200 };
#else
enum { PILE = 50, STEPS = 1000 };
#endif

/* Boxes and balls of many sizes that fall askew into a pit, in front of a wall that some of them overlap. */
LOOP_TEST(a_pile_in_a_pit_stays_in_its_plane, 0, SOLVERS) {
    MdtBodyID pile[PILE];
    double top = 0;
    begin(_i, .5, .2);
    state = 7;
    floorOf(20);
    for (int side = -1; side <= 1; side += 2)
        wall(1, 60, 4, 3.5 * side, 30, 0);
    wall(20, 60, 1, 0, 30, -1);
    for (int i = 0; i < PILE; i++) {
        const double x = -2 + i % 5 + uniform(-.1, .1), y = .6 + 1.2 * (i / 5);
        pile[i] = below(3) == 0 ? ball(uniform(.2, .4), x, y, 0, MdtLockToPlaneXY)
                                : box(uniform(.3, .7), uniform(.3, .7), uniform(.5, 1.5), x, y, 0, MdtLockToPlaneXY);
        turnInPlane(pile[i], uniform(-3, 3));
    }
    for (int step = 0; step < STEPS; step++) {
        universe_step(1);
        for (int i = 0; i < PILE; i++)
            assert_near(outOfPlane(pile[i]), 0, 0);
    }
    for (int i = 0; i < PILE; i++) {
        top = fmax(top, at(pile[i], 1));
        assert_below(fabs(at(pile[i], 0)), 3);
        assert_below(.1, at(pile[i], 1));
    }
    if (STEPS == 1000)
        assert_below(top, 4); /* they lie on one another, six or seven wide */
}

LOOP_TEST(a_tower_in_a_plane_stands, 0, SOLVERS) {
    MdtBodyID tower[10];
    begin(_i, .5, 0);
    floorOf(20);
    for (int i = 0; i < 10; i++)
        tower[i] = box(.5, .5, 1, i % 2 ? .05 : -.05, .25 + .5 * i, 0, MdtLockToPlaneXY);
    universe_step(600);
    for (int i = 0; i < 10; i++) {
        assert_near(at(tower[i], 1), .25 + .5 * i, 1e-3);
        assert_near(at(tower[i], 0), i % 2 ? .05 : -.05, 2e-3);
        assert_near(outOfPlane(tower[i]), 0, 0);
    }
}

/* A contact whose normal is locked has nothing to act on, nor has its friction. */
LOOP_TEST(a_wall_behind_has_no_say, 0, SOLVERS) {
    double end[2];
    for (int k = 0; k < 2; k++) {
        begin(_i, .5, 0);
        floorOf(40);
        if (k == 1)
            wall(40, 20, 1, 0, 10, -.9);
        const MdtBodyID b = box(1, 1, 1, 0, 3, 0, MdtLockToPlaneXY);
        MdtBodySetLinearVelocity(b, 2, 0, 0);
        universe_step(200);
        end[k] = at(b, 0);
        assert_near(at(b, 1), .5, 1e-3);
    }
    assert_near(end[0], end[1], 1e-3);
}

/* A ball that slides begins to roll: 5/7 of its speed is left. Without rotation it slides on for v²/2 μ g. */
LOOP_TEST(a_ball_rolls_along_free_axes_only, 0, SOLVERS) {
    static const int axes[] = {MdtLockNone, MdtLockToPlaneXY, MdtLockTranslationZ, MdtLockRotation};
    const double speed = 3, mu = .4;
    for (int k = 0; k < 4; k++) {
        begin(_i, mu, 0);
        floorOf(40);
        const MdtBodyID b = ball(.5, -5, .5, 0, axes[k]);
        universe_step(10);
        MdtBodySetLinearVelocity(b, (MeReal)speed, 0, (MeReal)(k == 0 ? 0 : 1));
        universe_step(120);
        const double rolls = 5. / 7 * speed, way = hypot(speed, 1) / (2 * mu * gravity);
        assert_near(speedAlong(b, 0), axes[k] == MdtLockRotation ? 0 : rolls, 1e-4);
        assert_near(spinAbout(b, 2), axes[k] == MdtLockRotation ? 0 : -rolls / .5, 2e-4);
        if (axes[k] == MdtLockRotation) { /* a step too long or too short, at its mean speed */
            assert_near(at(b, 0) + 5, speed * way, 2e-2);
            assert_near(at(b, 2), way, 1e-2);
        } else
            assert_near(at(b, 2), 0, 0);
    }
}

LOOP_TEST(a_platform_carries_along_free_axes, 0, SOLVERS) {
    begin(_i, .5, 0);
    const MdtBodyID platform = box(20, 1, 20, 0, -.5, 0, 0), b = box(.5, .5, .5, 0, .25, 0, MdtLockToPlaneXY);
    MdtBodySetKinematic(platform, METRUE);
    universe_step(10);
    MdtBodySetLinearVelocity(platform, 1, 0, 1);
    universe_step(60);
    assert_near(speedAlong(b, 0), 1, 1e-4);
    assert_near(outOfPlane(b), 0, 0);
}

LOOP_TEST(a_swept_body_stays_in_its_plane, 0, SOLVERS) {
    begin(_i, .5, .5);
    wall(.1, 10, 10, 3, 0, 0);
    const MdtBodyID b = box(.2, .2, .2, 0, 0, 0, MdtLockToPlaneXY);
    McdModelSetSwept(MdtBodyGetModel(b), METRUE);
    MdtWorldSetGravity(u->world, 0, 0, 0);
    MdtBodySetLinearVelocity(b, 200, 0, 10);
    for (int i = 0; i < 60; i++) {
        universe_step(1);
        assert_below(at(b, 0), 3);
        assert_near(outOfPlane(b), 0, 0);
    }
    assert_below(speedAlong(b, 0), -50);
}

/* ---- a character ---- */

LOOP_TEST(an_upright_body_never_tips, 0, SOLVERS) {
    double start[4];
    begin(_i, .8, 0);
    floorOf(40);
    const MdtBodyID c = add(McdSphylCreate(u->frame, (MeReal).3, (MeReal)1.2), 0, 1.2, 0, MdtLockRotation);
    for (int k = 0; k < 4; k++)
        start[k] = turned(c, k);
    for (int i = 0; i < 300; i++) {
        if (i % 60 == 0)
            MdtBodySetLinearVelocity(box(.4, .4, .4, -3, 1.5, .1, 0), 8, 0, 0);
        universe_step(1);
        for (int k = 0; k < 4; k++)
            assert_near(turned(c, k), start[k], 0);
    }
    assert_below(.01, at(c, 0)); /* they push it */
    assert_near(at(c, 1), .3, 1e-3);
}

/* Off its centre, a body that does not turn is hit as a point mass is. */
LOOP_TEST(a_hit_off_centre_moves_a_point_mass, 0, 2 * SOLVERS) {
    const double e = _i < SOLVERS ? .5 : 0;
    begin(_i % SOLVERS, 0, e);
    MdtWorldSetGravity(u->world, 0, 0, 0);
    const MdtBodyID target = box(1, 1, 1, 0, 0, 0, MdtLockRotation),
                    shot = box(.5, .2, .5, -2, .4, .1, MdtLockRotation);
    MdtBodySetMass(target, 3);
    MdtBodySetMass(shot, 1);
    MdtBodySetLinearVelocity(shot, 4, 0, 0);
    universe_step(60);
    assert_near(speedAlong(target, 0), (1 + e) * 4 / 4, 1e-5);
    assert_near(speedAlong(shot, 0), 4 - (1 + e) * 3, 1e-5);
    for (int k = 1; k < 3; k++)
        assert_near(fabs(speedAlong(target, k)) + fabs(speedAlong(shot, k)), 0, 1e-6);
    assert_near(turned(target, 0), 1, 0);
}

LOOP_TEST(impulses_have_no_effect_along_locked_axes, 0, SOLVERS) {
    begin(_i, 0, 0);
    MdtWorldSetGravity(u->world, 0, 0, 0);
    const MdtBodyID b = box(1, 1, 2, 0, 0, 0, MdtLockToPlaneZX);
    MdtBodyAddImpulseAtPosition(b, 1000, 1000, 500, (MeReal).5, (MeReal)-.5, 1);
    universe_step(60);
    assert_near(at(b, 1), 0, 0);
    assert_near(speedAlong(b, 0), .5, 1e-6);
    assert_near(speedAlong(b, 2), .25, 1e-6);
    assert_near(turned(b, 1), 0, 0); /* about x */
    assert_near(turned(b, 3), 0, 0); /* about z */
}
