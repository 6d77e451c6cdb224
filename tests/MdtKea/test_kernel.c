/* The fast solver's kernels: the same bits whatever the width of registers, and eight manifolds solved as the laws of
 * contact say, which is computed here in double, one number at a time. */
#include "fast/kea_fast_i.h"
#include "karma_test.h"

enum { GROUPS = 40, BODIES = 1 + GROUPS * KEA_LANES * 2, PASSES = 12 };

static KeaGroup groups[GROUPS] __attribute__((aligned(64)));
static KeaMotion motion[BODIES], before[BODIES], displacement[BODIES];
static float speedChange[BODIES];
static unsigned int seed;

static float chance(double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return (float)(low + (high - low) * (seed >> 8) / (1 << 24));
}

static void setFrame(KeaGroup *g, int lane) {
    double n[3], t[3], s = 0, along = 0;
    for (int i = 0; i < 3; i++) {
        n[i] = chance(-1, 1), t[i] = chance(-1, 1);
        s += n[i] * n[i];
    }
    for (int i = 0; i < 3; i++)
        n[i] /= sqrt(s), along += n[i] * t[i];
    s = 0;
    for (int i = 0; i < 3; i++)
        t[i] -= along * n[i], s += t[i] * t[i];
    g->normal.x[lane] = (float)n[0], g->normal.y[lane] = (float)n[1], g->normal.z[lane] = (float)n[2];
    g->along.x[lane] = (float)(t[0] / sqrt(s)), g->along.y[lane] = (float)(t[1] / sqrt(s)),
    g->along.z[lane] = (float)(t[2] / sqrt(s));
}

static void setBodies(KeaGroup *g, int group, int lane) {
    for (int k = 0; k < 2; k++) {
        const MeBool isWorld = k == 1 && chance(0, 1) < 0.3f;
        const float mass = chance(.5, 2), moments[3] = {chance(.1, .3), chance(.1, .3), chance(.1, .3)};
        g->body[k][lane] = isWorld ? 0 : 1 + 2 * (group * KEA_LANES + lane) + k;
        g->invMass[k][lane] = isWorld ? 0 : 1 / mass;
        for (int i = 0; i < 6; i++) {
            const int diagonal = i == 0 ? 0 : i == 3 ? 1 : i == 5 ? 2 : -1;
            g->invInertia[k][i][lane] = isWorld ? 0 : diagonal >= 0 ? 1 / moments[diagonal] : chance(-.2, .2);
        }
        g->arm[k].x[lane] = chance(-.5, .5), g->arm[k].y[lane] = chance(-.5, .5), g->arm[k].z[lane] = chance(-.5, .5);
    }
}

/* A quadrilateral, a triangle, two points or one. */
static void setPoints(KeaGroup *g, int lane, int points) {
    static const float x[] = {-.5f, .5f, .5f, -.5f}, y[] = {-.5f, -.5f, .5f, .5f};
    for (int k = 0; k < points; k++) {
        g->isPoint[k][lane] = -1;
        g->x[k][lane] = points == 1 ? 0 : x[k] * chance(.5, 1);
        g->y[k][lane] = points == 1 ? 0 : y[k] * chance(.5, 1);
        g->gap[k][lane] = chance(-.01, .002);
        g->slop[k][lane] = 1e-5f;
        g->impulse[k][lane] = chance(0, .1);
        g->lever[k][lane] = points == 1 ? 0 : chance(.1, .7);
    }
}

static void setSurface(KeaGroup *g, int lane) {
    g->coefficient[0][lane] = chance(.2, .8), g->coefficient[1][lane] = chance(.2, .8);
    g->isCone[lane] = chance(0, 1) < 0.5f ? -1 : 0;
    g->isOneWay[lane] = chance(0, 1) < 0.2f ? -1 : 0;
    g->slip[0][lane] = chance(0, 1) < 0.2f ? .5f : 0;
    g->slide[1][lane] = chance(0, 1) < 0.2f ? .1f : 0;
    g->compliance[lane] = chance(0, 1) < 0.2f ? .1f : 0;
    g->correction[lane] = .05f;
}

static void makeGroupsOf(unsigned int from, int maxPoints) {
    seed = from;
    memset(groups, 0, sizeof groups);
    memset(motion, 0, sizeof motion);
    for (int i = 1; i < BODIES; i++)
        for (int k = 0; k < 3; k++)
            motion[i].lin[k] = chance(-1, 1), motion[i].ang[k] = chance(-2, 2);
    for (int i = 0; i < GROUPS; i++)
        for (int lane = 0; lane < KEA_LANES; lane++) {
            const int points = (int)chance(0, maxPoints + .999);
            groups[i].manifold[lane] = points ? 0 : -1;
            if (!points)
                continue;
            setFrame(&groups[i], lane);
            setBodies(&groups[i], i, lane);
            setPoints(&groups[i], lane, points);
            setSurface(&groups[i], lane);
        }
    memcpy(before, motion, sizeof motion);
    memset(displacement, 0, sizeof displacement);
}

static void makeGroups(unsigned int from) {
    makeGroupsOf(from, KEA_POINTS);
}

/* All that a step does; what comes out is in groups, motion, way and `measured`. */
static void run(const KeaKernel *kernel, KeaMeasure *measured) {
    float uphill[KEA_LANES] = {0};
    const KeaTolerance tolerance = {.change = speedChange, .accuracy = 1e-3f, .loadSpeed = .16f, .stepsize = 1.f / 60};
    kernel->prepare(groups, GROUPS, 1.f / 60);
    kernel->apply(groups, GROUPS, motion);
    memcpy(before, motion, sizeof motion);
    for (int i = 0; i < PASSES; i++) {
        const float beta = (float)i / (float)(i + 3);
        kernel->extrapolate(motion, before, BODIES, beta);
        kernel->pass(groups, GROUPS, motion, beta, uphill);
    }
    memset(measured, 0, sizeof *measured);
    kernel->measure(groups, GROUPS, motion, &tolerance, measured);
    kernel->advance(groups, GROUPS, motion, 1.f / 60);
    for (int i = 0; i < 4; i++)
        kernel->push(groups, GROUPS, displacement);
}

LOOP_TEST(every_width_gives_the_same_bits, 1, 9) {
#ifdef KEA_HAS_AVX2
    static KeaGroup narrow[GROUPS];
    static KeaMotion narrowMotion[BODIES], narrowWay[BODIES];
    KeaMeasure measured, narrowMeasured;
    if (!__builtin_cpu_supports("avx2"))
        return;
    makeGroups((unsigned int)_i);
    run(&kea_kernel, &narrowMeasured);
    memcpy(narrow, groups, sizeof narrow);
    memcpy(narrowMotion, motion, sizeof motion);
    memcpy(narrowWay, displacement, sizeof displacement);
    makeGroups((unsigned int)_i);
    run(&kea_kernelAvx2, &measured);
    ck_assert_int_eq(memcmp(&measured, &narrowMeasured, sizeof measured), 0);
    ck_assert_int_eq(memcmp(motion, narrowMotion, sizeof motion), 0);
    ck_assert_int_eq(memcmp(displacement, narrowWay, sizeof displacement), 0);
    for (int i = 0; i < GROUPS; i++) {
        ck_assert_int_eq(memcmp(groups[i].impulse, narrow[i].impulse, sizeof narrow[i].impulse), 0);
        ck_assert_int_eq(memcmp(groups[i].frictionImpulse, narrow[i].frictionImpulse, sizeof narrow[i].frictionImpulse),
                         0);
        ck_assert_int_eq(memcmp(&groups[i].torsionImpulse, &narrow[i].torsionImpulse, sizeof narrow[i].torsionImpulse),
                         0);
    }
#endif
}

/* As if they had four points. */
LOOP_TEST(visits_of_few_points_give_the_same_bits, 0, 8) {
    static KeaGroup all[GROUPS];
    static KeaMotion allMotion[BODIES], allWay[BODIES];
    const int max = 1 + _i % 2;
    KeaMeasure measured;
    makeGroupsOf((unsigned int)(1 + _i), max);
    for (int i = 0; i < GROUPS; i++)
        groups[i].points = KEA_POINTS;
    run(&kea_kernel, &measured);
    memcpy(all, groups, sizeof all);
    memcpy(allMotion, motion, sizeof motion);
    memcpy(allWay, displacement, sizeof displacement);
    makeGroupsOf((unsigned int)(1 + _i), max);
    for (int i = 0; i < GROUPS; i++)
        groups[i].points = max;
    run(&kea_kernel, &measured);
    ck_assert_int_eq(memcmp(motion, allMotion, sizeof motion), 0);
    ck_assert_int_eq(memcmp(displacement, allWay, sizeof displacement), 0);
    for (int i = 0; i < GROUPS; i++) {
        ck_assert_int_eq(memcmp(groups[i].impulse, all[i].impulse, sizeof all[i].impulse), 0);
        ck_assert_int_eq(memcmp(groups[i].frictionImpulse, all[i].frictionImpulse, sizeof all[i].frictionImpulse), 0);
        for (int lane = 0; lane < KEA_LANES; lane++) /* where one of them is -0 */
            assert_near(groups[i].torsionImpulse[lane], all[i].torsionImpulse[lane], 0);
    }
}

/* ---- the laws, in double ---- */

typedef struct Point {
    double rate, impulse; /* m/s against its target, N s */
} Point;

static void crossOf(double r[3], const double a[3], const double b[3]) {
    for (int i = 0; i < 3; i++)
        r[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void laneOf(const KeaLanes3 *from, int lane, double to[3]) {
    to[0] = from->x[lane], to[1] = from->y[lane], to[2] = from->z[lane];
}

/* Each point's own velocity along the normal, from the bodies' motions. */
static Point pointOf(const KeaGroup *g, int lane, int k) {
    double n[3], t1[3], t2[3], rate = 0;
    laneOf(&g->normal, lane, n);
    laneOf(&g->along, lane, t1);
    crossOf(t2, n, t1);
    for (int b = 0; b < 2; b++) {
        const KeaMotion *m = &motion[g->body[b][lane]];
        double arm[3], w[3], turn[3];
        laneOf(&g->arm[b], lane, arm);
        for (int i = 0; i < 3; i++) {
            arm[i] += g->x[k][lane] * t1[i] + g->y[k][lane] * t2[i];
            w[i] = m->ang[i];
        }
        crossOf(turn, w, arm);
        for (int i = 0; i < 3; i++)
            rate += (b == 0 ? 1 : -1) * n[i] * (m->lin[i] + turn[i]);
    }
    const double impulse = g->impulse[k][lane];
    return (Point){rate - g->bias[k][lane] + g->compliance[lane] * impulse, impulse};
}

/* Along t1 and t2 at the centre, and about the normal, from the bodies' motions. */
static void frictionRatesOf(const KeaGroup *g, int lane, double rate[3]) {
    double axis[3][3]; /* t1, t2, n */
    laneOf(&g->along, lane, axis[0]);
    laneOf(&g->normal, lane, axis[2]);
    crossOf(axis[1], axis[2], axis[0]);
    rate[0] = rate[1] = rate[2] = 0;
    for (int b = 0; b < 2; b++) {
        const KeaMotion *m = &motion[g->body[b][lane]];
        const double w[3] = {m->ang[0], m->ang[1], m->ang[2]};
        double arm[3], turn[3];
        laneOf(&g->arm[b], lane, arm);
        crossOf(turn, w, arm);
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 3; k++)
                rate[k] += (b == 0 ? 1 : -1) * axis[k][i] * (k < 2 ? m->lin[i] + turn[i] : w[i]);
    }
}

/* The same by the coupling. */
static void coupledRatesOf(const KeaGroup *g, int lane, double rate[3]) {
    double resultant[3] = {0, 0, 0};
    for (int k = 0; k < KEA_POINTS; k++) {
        const double p = g->impulse[k][lane];
        resultant[0] += p;
        resultant[1] += p * g->x[k][lane];
        resultant[2] += p * g->y[k][lane];
    }
    const double torsionImpulse = g->torsionImpulse[lane];
    for (int k = 0; k < 2; k++)
        rate[k] = g->torsionToSlide[k][lane] * torsionImpulse;
    rate[2] = g->torsionMass[lane] > 0 ? torsionImpulse / g->torsionMass[lane] : 0;
    for (int j = 0; j < 3; j++) {
        rate[0] += g->toSlide[0][j][lane] * resultant[j];
        rate[1] += g->toSlide[1][j][lane] * resultant[j];
        rate[2] += g->toSpin[j][lane] * resultant[j];
    }
}

LOOP_TEST(rates_of_friction_follow_from_the_coupling, 1, 9) {
    makeGroups((unsigned int)_i);
    memset(motion, 0, sizeof motion);
    for (int i = 0; i < GROUPS; i++)
        for (int lane = 0; lane < KEA_LANES; lane++)
            groups[i].torsionImpulse[lane] = groups[i].manifold[lane] >= 0 ? chance(-.1, .1) : 0;
    kea_kernel.prepare(groups, GROUPS, 1.f / 60);
    kea_kernel.apply(groups, GROUPS, motion);
    for (int i = 0; i < GROUPS; i++)
        for (int lane = 0; lane < KEA_LANES; lane++) {
            double found[3], expected[3];
            if (groups[i].manifold[lane] < 0)
                continue;
            frictionRatesOf(&groups[i], lane, found);
            coupledRatesOf(&groups[i], lane, expected);
            for (int k = 0; k < 3; k++)
                assert_near(found[k], expected[k], 1e-5);
        }
}

/* Friction is off here: manifolds that share no body are solved by one visit, four points whose velocities contradict
 * each other by several. */
LOOP_TEST(a_visit_solves_what_shares_no_body, 1, 9) {
    enum { VISITS = 60 };
    float uphill[KEA_LANES] = {0};
    int acting = 0;
    makeGroups((unsigned int)_i);
    for (int i = 0; i < GROUPS; i++)
        memset(groups[i].coefficient, 0, sizeof groups[i].coefficient);
    kea_kernel.prepare(groups, GROUPS, 1.f / 60);
    kea_kernel.apply(groups, GROUPS, motion);
    for (int i = 0; i < VISITS; i++)
        kea_kernel.pass(groups, GROUPS, motion, 0, uphill);
    for (int i = 0; i < GROUPS; i++)
        for (int lane = 0; lane < KEA_LANES; lane++)
            for (int k = 0; k < KEA_POINTS && groups[i].manifold[lane] >= 0 && groups[i].isPoint[k][lane]; k++) {
                const Point p = pointOf(&groups[i], lane, k);
                ck_assert(p.impulse >= 0);
                ck_assert_msg(p.rate > -1e-4, "group %d lane %d point %d: %g m/s", i, lane, k, p.rate);
                if (p.impulse > 0) {
                    acting++;
                    assert_near(p.rate, 0, 1e-4);
                }
            }
    ck_assert_int_gt(acting, GROUPS);
}

/* A ball of 1 kg and radius .5 m with one manifold on the ground, y up, and friction of 1. */
typedef struct Ball {
    MdtKeaBody body, *bodies[1];
    MdtKeaManifold manifold;
    MdtKeaSystem kea;
    void *scratch;
} Ball;

static const double gravity = 9.81;

static void makeBall(Ball *b) {
    memset(b, 0, sizeof *b);
    b->body = (MdtKeaBody){.quaternion = {1, 0, 0, 0}, .principal = {1, 0, 0, 0}, .invMass = 1};
    for (int i = 0; i < 3; i++)
        b->body.moments[i] = .1;
    b->body.force[1] = -gravity;
    b->bodies[0] = &b->body;
    b->manifold = (MdtKeaManifold){.body = {0, MdtKeaWORLD}, .normal = {0, 1, 0}, .direction = {1, 0, 0}};
    b->manifold.surface = (MdtKeaSurface){.coefficient = {1, 1}, .isCone = METRUE};
    b->kea = (MdtKeaSystem){.numBodies = 1, .numManifolds = 1, .bodies = b->bodies, .manifolds = &b->manifold};
    b->kea.parameters = (MdtKeaParameters){
        .stepsize = 1. / 60, .gamma = .2, .softening = 1, .solver = MdtKeaSolverFast, .accuracy = 1e-3};
    b->kea.cache = MdtKeaCacheCreate();
    b->scratch = malloc(MdtKeaScratchSize(1, 0, 0));
}

static void addPoint(Ball *b, double x, double z, double depth) {
    b->manifold.point[b->manifold.numPoints++] = (MdtKeaPoint){.position = {x, -.5, z}, .depth = depth};
}

static void stepBall(Ball *b, int steps) {
    for (int step = 0; step < steps; step++) {
        MdtKeaInit(&b->kea, b->scratch);
        MdtKeaSolve(&b->kea);
        ck_assert(MdtKeaIntegrate(&b->kea));
        for (int k = 0; k < b->manifold.numPoints; k++)
            keaCopy(b->manifold.point[k].guess, b->manifold.point[k].force);
    }
}

static void destroyBall(Ball *b) {
    MdtKeaCacheDestroy(b->kea.cache);
    free(b->scratch);
}

/* It spins on one point; another of the manifold is 1 m aside and 2 cm above the ground. What carries nothing gives
 * friction no lever: the spin about the normal stays as it is. */
TEST(a_point_without_load_gives_friction_no_lever) {
    const double spin = 5;
    Ball b;
    makeBall(&b);
    addPoint(&b, 0, 0, 0);
    addPoint(&b, 1, 0, -.02);
    b.body.angularMomentum[1] = .1 * spin;
    stepBall(&b, 30);
    assert_near(b.manifold.point[0].force[0], gravity, 1e-4);
    assert_near(b.body.angularMomentum[1], .1 * spin, 1e-6);
    destroyBall(&b);
}

/* Points in one place, in pairs, and all of them, under it or at its edge, which it overlaps. */
LOOP_TEST(points_may_coincide, 0, 4) {
    static const double place[][4][2] = {{{-.3, 0}, {-.3, 0}, {.3, 0}, {.3, 0}},
                                         {{0, 0}, {0, 0}, {0, 0}, {0, 0}},
                                         {{-.3, -.3}, {-.3, -.3}, {.3, .3}, {.3, -.3}},
                                         {{-.3, 0}, {-.3 + 1e-7, 0}, {.3, 0}, {.3, 1e-7}}};
    Ball b;
    makeBall(&b);
    for (int k = 0; k < 4; k++)
        addPoint(&b, place[_i][k][0], place[_i][k][1], 1e-3);
    stepBall(&b, 30);
    assert_near(keaLength(b.body.velocity), 0, 1e-4);
    assert_near(keaLength(b.body.angularMomentum), 0, 1e-4);
    assert_near(keaLength(b.body.position), 30 * .6e-3, 1e-3); /* six passes of .15 each */
    destroyBall(&b);
}

/* The same anywhere: what is pushed out of an overlap by 2e-4 m a step moves by no more than some of that, and its
 * speed is that of a step's fall. */
LOOP_TEST(points_may_coincide_anywhere, 1, 4) {
    seed = (unsigned int)_i;
    for (int trial = 0; trial < 300; trial++) {
        Ball b;
        const int count = 2 + trial % 3;
        makeBall(&b);
        for (int k = 0; k < count; k++) {
            const MdtKeaPoint *last = &b.manifold.point[k > 0 ? k - 1 : 0];
            const MeBool isNew = k == 0 || chance(0, 1) < .3f;
            addPoint(&b, isNew ? chance(-1, 1) : last->position[0], isNew ? chance(-1, 1) : last->position[2], 1e-3);
        }
        for (int i = 0; i < 3; i++)
            b.body.moments[i] = chance(.02, .2);
        for (int i = 0; i < 10; i++) {
            double from[3];
            keaCopy(from, b.body.position);
            stepBall(&b, 1);
            keaSubtract(from, from, b.body.position);
            assert_below(keaLength(from), 1e-2 + 1e-2 * i);
            assert_below(keaLength(b.body.velocity), gravity / 60 * (i + 1) + 1e-3);
        }
        destroyBall(&b);
    }
}
