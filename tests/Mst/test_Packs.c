/* Packs: lattices of balls or cubes that fall onto a floor and bounce, more of them than are solved in time. */
#include "universe.h"
#include <string.h>

#define GRAVITY 9.81
enum { MAX_BODIES = 512 };

typedef struct Pack {
    int n[3];
    MeBool areCubes;
    double gap, drop; /* of a size; m */
    double restitution, friction, h;
    MdtSolver solver;
    double budget; /* millions of multiplications; 0: the default */
    double ratio;  /* of masses, alternating */
    double speed;  /* m/s, along x */
    MeBool isReversed;
} Pack;

static const Pack usual = {{3, 3, 3}, MEFALSE, .01, .5, 1, 0, 1. / 60, MdtSolverAuto, 0, 1, 0, MEFALSE};

static McdModelID model[MAX_BODIES];
static int count;
static double bottom; /* J: the energy of the pack at rest on the floor */

static double mass(int i) {
    return (double)MdtBodyGetMass(McdModelGetBody(model[i]));
}

/* J, above that of the pack at rest. */
static double energy(void) {
    double sum = -bottom;
    for (int i = 0; i < count; i++) {
        MeVector3 at;
        McdModelDynamicsGetPosition(model[i], at);
        sum += (double)MdtBodyGetKineticEnergy(McdModelGetBody(model[i])) + mass(i) * GRAVITY * (double)at[2];
    }
    return sum;
}

/* kg m/s, along x. */
static double momentum(void) {
    double sum = 0;
    for (int i = 0; i < count; i++) {
        MeVector3 v;
        McdModelDynamicsGetLinearVelocity(model[i], v);
        sum += mass(i) * (double)v[0];
    }
    return sum;
}

static void beginWorld(const Pack *p) {
    universe_begin(&MstUniverseGrowingSizes);
    MdtWorldSetGravity(u->world, 0, 0, -GRAVITY);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MdtWorldSetSolver(u->world, p->solver);
    if (p->budget > 0)
        MdtWorldSetWorkBudget(u->world, (MeReal)p->budget);
    const MdtContactParamsID surface = MstBridgeGetContactParams(u->bridge, 0, 0);
    MdtContactParamsSetSurface(surface, (MeReal)p->friction, (MeReal)p->restitution);
    if (p->friction == 0)
        MdtContactParamsSetType(surface, MdtContactTypeFrictionZero);
    universe_addFloor();
}

static void addBody(const Pack *p, McdGeometryID shape, int i) {
    const int at = p->isReversed ? p->n[0] * p->n[1] * p->n[2] - 1 - i : i;
    const int z = at % p->n[2], y = at / p->n[2] % p->n[1], x = at / p->n[2] / p->n[1];
    const double apart = 1 + p->gap;
    model[i] = MstModelAndBodyCreate(u, shape, (x + y + z) % 2 ? p->ratio : 1);
    McdModelDynamicsSetPosition(model[i], apart * x, apart * y, .5 + p->drop + apart * z);
    McdModelDynamicsSetLinearVelocity(model[i], p->speed, 0, 0);
    bottom += mass(i) * GRAVITY * (.5 + z);
}

static void makePack(const Pack *p) {
    beginWorld(p);
    const McdGeometryID shape = p->areCubes ? McdBoxCreate(u->frame, 1, 1, 1) : McdSphereCreate(u->frame, .5);
    bottom = 0;
    count = p->n[0] * p->n[1] * p->n[2];
    for (int i = 0; i < count; i++)
        addBody(p, shape, i);
}

/* The part of the energy that is left after so many seconds. It never grows. */
static double play(const Pack *p, double time) {
    makePack(p);
    const double first = energy();
    for (double t = 0; t < time; t += p->h) {
        MstUniverseStep(u, p->h);
        assert_below(energy(), first * (1 + 1e-4));
    }
    assert_silent();
    return energy() / first;
}

static void assertKept(const Pack *p, double time) {
    const double kept = play(p, time);
    ck_assert_msg(fabs(kept - 1) < 1e-3, "%dx%dx%d, gap %g, step %g: %g of the energy is left", p->n[0], p->n[1],
                  p->n[2], p->gap, p->h, kept);
}

/* ---- elastic ----------------------------------------------------------------------------------------------------- */

static void assertBounces(Pack p) {
    static const double gap[] = {0, 1e-4, .01, .1}, rate[] = {30, 60, 240};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) {
            p.gap = gap[i];
            p.h = 1 / rate[k];
            assertKept(&p, .9);
        }
}

TEST(balls_keep_their_energy) {
    Pack p = usual;
    assertBounces(p);
    p.solver = MdtSolverFast;
    assertBounces(p);
}

TEST(so_do_cubes) {
    Pack p = usual;
    p.areCubes = METRUE;
    assertBounces(p);
    p.solver = MdtSolverFast;
    assertBounces(p);
}

/* Where the impacts of a step were left to its end, they kept .0, .02, .27. */
TEST(so_do_larger_packs) {
    static const struct {
        int n[3];
        double gap, drop;
    } of[] = {{{4, 4, 4}, .01, 1}, {{6, 6, 6}, 1e-3, .5}, {{1, 1, 20}, 1e-3, .5}, {{8, 8, 8}, 0, .5}};
    for (int i = 0; i < 4; i++) {
        Pack p = usual;
        memcpy(p.n, of[i].n, sizeof p.n);
        p.gap = of[i].gap;
        p.drop = of[i].drop;
        assertKept(&p, .8);
    }
}

TEST(so_do_packs_that_may_cost_little) {
    for (int budget = 1; budget <= 16; budget *= 4)
        for (int areCubes = 0; areCubes < 2; areCubes++) {
            Pack p = usual;
            p.budget = budget;
            p.areCubes = areCubes;
            assertKept(&p, .6);
        }
}

/* In whatever order they were made, whatever their masses, and while they move along the floor. */
TEST(so_do_packs_of_other_kinds) {
    for (int k = 0; k < 8; k++) {
        Pack p = usual;
        p.solver = k / 4 ? MdtSolverFast : MdtSolverAuto;
        p.isReversed = k % 4 == 0;
        p.ratio = k % 4 == 1 ? 100 : k % 4 == 2 ? .01 : 1;
        p.speed = k % 4 == 3 ? 3 : 0;
        assertKept(&p, .6);
        assert_near(momentum(), p.speed * count * 3.14159265358979324 / 6 * (p.ratio == 1), 1e-4);
    }
}

/* From low and high, in long steps, where slow impacts on the floor are half of the speed of the fall. */
TEST(so_do_packs_that_fall_from_low_or_high) {
    static const double drop[] = {.25, 1}, gap[] = {0, .01, .1};
    for (int k = 0; k < 24; k++) {
        Pack p = usual;
        p.h = 1. / 30;
        p.drop = drop[k % 2];
        p.gap = gap[k / 2 % 3];
        p.areCubes = k / 6 % 2;
        p.solver = k / 12 ? MdtSolverFast : MdtSolverAuto;
        assertKept(&p, .9);
    }
}

TEST(so_do_cubes_of_unequal_masses) {
    static const double rate[] = {30, 60, 240};
    for (int k = 0; k < 6; k++) {
        Pack p = usual;
        p.areCubes = METRUE;
        p.ratio = k % 2 ? .01 : 100;
        p.h = 1 / rate[k / 2];
        assertKept(&p, .6);
    }
}

/* Bodies that fall less than within a step, beside others that they touch. All impacts are too slow to be reflected. */
TEST(what_hops_within_a_step_keeps_its_energy) {
    static const double drop[] = {.0005, .003, .01};
    for (int k = 0; k < 12; k++) {
        Pack p = usual;
        p.n[0] = p.n[1] = 4;
        p.n[2] = 1;
        p.gap = 0;
        p.h = 1. / 30;
        p.drop = drop[k % 3];
        p.areCubes = k / 3 % 2;
        p.solver = k / 6 ? MdtSolverFast : MdtSolverAuto;
        assert_near(play(&p, 5), 1, 2e-5);
    }
}

/* ---- billiards --------------------------------------------------------------------------------------------------- */

/* A cue ball and a triangle of balls on the floor, which it hits in the middle; they are mirrored about y = 0. */
typedef struct Rack {
    int rows;
    double radius, gap, speed, h; /* m; of a radius; m/s */
    MdtSolver solver;
} Rack;

static void makeRack(const Rack *r) {
    const Pack p = {.restitution = 1, .h = r->h, .solver = r->solver};
    const double apart = (2 + r->gap) * r->radius;
    beginWorld(&p);
    const McdGeometryID ball = McdSphereCreate(u->frame, (MeReal)r->radius);
    count = 0;
    bottom = 0;
    model[count] = MstModelAndBodyCreate(u, ball, 1000);
    McdModelDynamicsSetPosition(model[count], (MeReal)(-6 * r->radius), 0, (MeReal)r->radius);
    McdModelDynamicsSetLinearVelocity(model[count++], (MeReal)r->speed, 0, 0);
    for (int i = 0; i < r->rows; i++)
        for (int k = 0; k <= i; k++) {
            model[count] = MstModelAndBodyCreate(u, ball, 1000);
            McdModelDynamicsSetPosition(model[count++], (MeReal)(apart * i * sqrt(.75)), (MeReal)(apart * (k - .5 * i)),
                                        (MeReal)r->radius);
        }
    for (int i = 0; i < count; i++)
        bottom += mass(i) * GRAVITY * r->radius;
}

/* m/s: by how much the velocities of mirrored balls differ, at most. */
static double asymmetry(int rows) {
    double worst = 0;
    for (int i = 0, first = 1; i < rows; first += ++i)
        for (int k = 0; k <= i; k++) {
            MeVector3 v, mirrored;
            McdModelDynamicsGetLinearVelocity(model[first + k], v);
            McdModelDynamicsGetLinearVelocity(model[first + i - k], mirrored);
            worst = fmax(worst, fmax(fabs((double)(v[0] - mirrored[0])), fabs((double)(v[1] + mirrored[1]))));
        }
    return worst;
}

static void assertBreaksEvenly(const Rack *r) {
    makeRack(r);
    const double first = energy(), before = momentum();
    for (double t = 0; t < 10 * r->radius / r->speed + 2 * r->h; t += r->h)
        MstUniverseStep(u, (MeReal)r->h);
    ck_assert_msg(asymmetry(r->rows) < TOL(2e-4, 1e-9) * r->speed, "%d rows, radius %g, gap %g, step %g: %g of %g m/s",
                  r->rows, r->radius, r->gap, r->h, asymmetry(r->rows), r->speed);
    assert_near(energy() / first, 1, 1e-4);
    assert_near(momentum() / before, 1, 1e-5);
    assert_silent();
}

/* From the fourth row on, of 11 balls, the corner balls left with .75 and .38 of the cue's speed. */
TEST(billiards_break_evenly) {
    static const double gap[] = {0, 1e-3, .05}, rate[] = {30, 60, 240}, radius[] = {.0286, .5};
    for (int k = 0; k < 108; k++) {
        const Rack r = {.rows = 3 + k % 3,
                        .gap = gap[k / 3 % 3],
                        .h = 1 / rate[k / 9 % 3],
                        .radius = radius[k / 27 % 2],
                        .speed = 5,
                        .solver = k / 54 ? MdtSolverFast : MdtSolverAuto};
        assertBreaksEvenly(&r);
    }
}

/* ---- inelastic, rough -------------------------------------------------------------------------------------------- */

/* rad/s, the fastest. */
static double spin(void) {
    double max = 0;
    for (int i = 0; i < count; i++) {
        MeVector3 w;
        MdtBodyGetAngularVelocity(McdModelGetBody(model[i]), w);
        max = fmax(max, (double)MeVector3Magnitude(w));
    }
    return max;
}

/* A layer, of more bodies than are solved in time: e² of the energy is left, and what lands flat does not rotate. */
TEST(a_layer_bounces_by_the_law) {
    static const double restitution[] = {.9, .5, .1};
    for (int i = 0; i < 12; i++) {
        Pack p = usual;
        p.n[0] = p.n[1] = 4;
        p.n[2] = 1;
        p.areCubes = i / 6;
        p.solver = i / 3 % 2 ? MdtSolverFast : MdtSolverAuto;
        p.restitution = restitution[i % 3];
        assert_near(play(&p, .36), p.restitution * p.restitution, 1e-5);
        assert_below(spin(), 1e-5);
    }
}

TEST(friction_only_takes) {
    for (int i = 0; i < 8; i++) {
        Pack p = usual;
        p.areCubes = i % 2;
        p.solver = i / 2 % 2 ? MdtSolverFast : MdtSolverAuto;
        p.restitution = i / 4 ? .5 : 1;
        p.friction = .5;
        p.speed = 1;
        assert_below(play(&p, .6), 1);
    }
}

/* A layer that slides as it lands: friction takes μ times the change of the vertical velocity, (1 + e) v, but for the
 * fall of one step, by which the blow is early. */
TEST(a_blow_has_the_friction_of_its_impulse) {
    for (int i = 0; i < 4; i++) {
        Pack p = usual;
        p.n[0] = p.n[1] = 4;
        p.n[2] = 1;
        p.solver = i % 2 ? MdtSolverFast : MdtSolverAuto;
        p.restitution = i / 2 ? .5 : 1;
        p.friction = .1;
        p.speed = 3;
        makePack(&p);
        const double first = momentum(), blow = (1 + p.restitution) * sqrt(2 * GRAVITY * p.drop);
        for (double t = 0; t < .36; t += p.h)
            MstUniverseStep(u, p.h);
        assert_near(momentum() / first, 1 - p.friction * blow / p.speed, p.friction * GRAVITY * p.h / p.speed);
    }
}
