/* Explosions (MstUniverseExplode): the law of the impulse, who gets one, and shields. By either solver. */
#include "universe.h"

enum { SOLVERS = 3 };

static void begin(int solver) {
    universe_begin(0);
    MdtWorldSetSolver(u->world, (MdtSolver)solver);
    MdtWorldSetGravity(u->world, 0, 0, 0);
}

static McdModelID addBox(double lx, double ly, double lz, double x, double y, double z) {
    const McdGeometryID g = McdBoxCreate(u->frame, (MeReal)lx, (MeReal)ly, (MeReal)lz);
    const McdModelID m = MstModelAndBodyCreate(u, g, 1000);
    McdModelDynamicsSetPosition(m, (MeReal)x, (MeReal)y, (MeReal)z);
    return m;
}

static int explode(double x, double y, double z, double radius, double impulse, double falloff, MeBool isShielded) {
    const MeVector3 at = {(MeReal)x, (MeReal)y, (MeReal)z};
    return MstUniverseExplode(u, at, (MeReal)radius, (MeReal)impulse, (MeReal)falloff, isShielded);
}

/* kg m/s */
static void momentumOf(McdModelID m, double p[3]) {
    MeVector3 v;
    McdModelDynamicsGetLinearVelocity(m, v);
    for (int i = 0; i < 3; i++)
        p[i] = (double)v[i] * (double)MdtBodyGetMass(McdModelGetBody(m));
}

/* Boxes of several sizes and distances, turned about z, so that the explosion faces a side or a corner. */
LOOP_TEST(the_impulse_falls_with_the_distance, 0, SOLVERS) {
    static const double sizes[] = {.2, 3}, gaps[] = {.1, 2, 4.9}, falloffs[] = {0, 1, 2.5},
                        steps[] = {1. / 30, 1. / 240};
    for (int s = 0; s < 2; s++)
        for (int g = 0; g < 3; g++)
            for (int f = 0; f < 3; f++)
                for (int turned = 0; turned < 2; turned++) {
                    const double size = sizes[s], half = size / 2 * (turned ? sqrt(2) : 1), impulse = 70, radius = 5;
                    const double area = size * 2 * size * (turned ? sqrt(2) : 1);
                    double p[3];
                    begin(_i);
                    const McdModelID m = addBox(size, size, 2 * size, gaps[g] + half, 0, 0);
                    if (turned)
                        McdModelDynamicsSetQuaternion(m, (MeReal)cos(ME_PI / 8), 0, 0, (MeReal)sin(ME_PI / 8));
                    ck_assert_int_eq(explode(0, 0, 0, radius, impulse, falloffs[f], MEFALSE), 1);
                    MstUniverseStep(u, (MeReal)steps[g % 2]);
                    momentumOf(m, p);
                    assert_near_rel(p[0], impulse * area * pow(1 - gaps[g] / radius, falloffs[f]), TOL(1e-4, 1e-12));
                    assert_near(p[1], 0, TOL(1e-3, 1e-11));
                    assert_near(p[2], 0, TOL(1e-3, 1e-11));
                }
}

TEST(beyond_its_radius_it_does_nothing) {
    double p[3];
    begin(0);
    const McdModelID m = addBox(1, 1, 1, 3, 0, 0);
    ck_assert_int_eq(explode(0, 0, 0, 2.49, 100, 1, MEFALSE), 0);
    ck_assert_int_eq(explode(0, 0, 0, 2.51, 100, 1, MEFALSE), 1);
    ck_assert_int_eq(explode(3, 0, 0, 2, 100, 1, MEFALSE), 0); /* no direction */
    MstUniverseStep(u, (MeReal)(1. / 60));
    momentumOf(m, p);
    assert_near(p[0], 100 * .01 / 2.51, TOL(1e-3, 1e-12));
}

LOOP_TEST(it_may_pull, 0, SOLVERS) {
    double p[3];
    begin(_i);
    const McdModelID m = addBox(1, 1, 1, 0, 2.5, 0);
    ck_assert_int_eq(explode(0, 0, 0, 4, -30, 1, MEFALSE), 1);
    MstUniverseStep(u, (MeReal)(1. / 60));
    momentumOf(m, p);
    assert_near(p[1], -15, TOL(1e-4, 1e-12));
}

/* Only what forces move: sleepers, which wake, but not what the program has stopped or moves. */
LOOP_TEST(it_pushes_dynamic_bodies_only, 0, SOLVERS) {
    begin(_i);
    MdtWorldSetGravity(u->world, 0, 0, -9.8);
    universe_addFloor();
    const McdModelID asleep = addBox(1, 1, 1, 2, 0, .5), stopped = addBox(1, 1, 1, -2, 0, .5),
                     moved = addBox(1, 1, 1, 0, 2, .5), sensor = addBox(1, 1, 1, 0, -2, .5);
    MdtBodySetKinematic(McdModelGetBody(moved), METRUE);
    McdModelSetSensor(sensor, METRUE);
    MdtBodySetGravityFactor(McdModelGetBody(sensor), 0);
    universe_step(200);
    McdModelDynamicsDisable(stopped);
    ck_assert(!McdModelDynamicsIsEnabled(asleep));
    ck_assert_int_eq(explode(0, 0, .5, 4, 1000, 1, MEFALSE), 1);
    universe_step(1);
    ck_assert(McdModelDynamicsIsEnabled(asleep) && !McdModelDynamicsIsEnabled(stopped));
    MeVector3 v;
    McdModelDynamicsGetLinearVelocity(asleep, v);
    ck_assert(v[0] > (MeReal).3);
    McdModelDynamicsGetLinearVelocity(moved, v);
    assert_vec3_near(v, 0, 0, 0, 0);
    McdModelDynamicsGetLinearVelocity(sensor, v);
    assert_vec3_near(v, 0, 0, 0, 0);
}

/* A wall shields what is behind it, and a body does not shield another. */
TEST(walls_shield) {
    static const MeVector3 place = {1, 0, 0};
    double p[3][3];
    begin(0);
    MstFixedModelCreateAt(u, McdBoxCreate(u->frame, (MeReal).2, 4, 4), place, 0);
    const McdModelID m[] = {addBox(1, 1, 1, 2.5, 0, 0), addBox(1, 1, 1, -1.5, 0, 0), addBox(1, 1, 1, -3, 0, 0)};
    ck_assert_int_eq(explode(0, 0, 0, 10, 50, 0, MEFALSE), 3);
    for (int i = 0; i < 3; i++)
        MdtBodyResetImpulses(McdModelGetBody(m[i]));
    const int changing = McdSpaceIsChanging(u->space);
    ck_assert_int_eq(explode(0, 0, 0, 10, 50, 0, METRUE), 2);
    ck_assert_int_eq(McdSpaceIsChanging(u->space), changing);
    universe_step(1);
    for (int i = 0; i < 3; i++)
        momentumOf(m[i], p[i]);
    assert_near(p[0][0], 0, 0);
    assert_near(p[1][0], -50, TOL(1e-3, 1e-11));
    assert_near(p[2][0], -50, TOL(1e-3, 1e-11));
}

TEST(bad_input_pushes_nothing) {
    static const MeVector3 nowhere = {NAN, 0, 0}, origin = {0, 0, 0};
    begin(0);
    addBox(1, 1, 1, 2, 0, 0);
    assert_none(MstUniverseExplode, u, NULL, 4, 1, 1, MEFALSE);
    assert_none(MstUniverseExplode, u, nowhere, 4, 1, 1, MEFALSE);
    assert_none(MstUniverseExplode, u, origin, 0, 1, 1, MEFALSE);
    assert_none(MstUniverseExplode, u, origin, 4, INFINITY, 1, MEFALSE);
    assert_none(MstUniverseExplode, u, origin, 4, 1, -1, MEFALSE);
    assert_none(MstUniverseExplode, NULL, origin, 4, 1, 1, MEFALSE);
}
