/* Contacts, made by hand as a program without collision makes them. */
#include "scene.h"

/* The one contact of a body with a horizontal floor at y = 0, under its centre, made anew before every step. */
typedef struct {
    MdtWorldID world;
    MdtBodyID body;
    MdtContactID contact;
    MdtBclContactParams params;
    double radius;
    MeBool early; /* make it while there is still a gap */
} Ball;

static Ball makeBall(double height, double gravity) {
    Ball s = {.radius = .5};
    s.world = scene_world(2, 8, gravity);
    MdtWorldSetEpsilon(s.world, 0);
    s.body = scene_body(s.world, 1, 0, height, 0);
    MdtContactParamsReset(&s.params);
    return s;
}

static void stepBall(Ball *s, MeReal h) {
    MeVector3 p;
    if (s->contact)
        MdtContactDestroy(s->contact);
    s->contact = MdtContactInvalidID;
    MdtBodyGetPosition(s->body, p);
    const double depth = s->radius - (double)p[1];
    if (depth > 0 || s->early) {
        s->contact = MdtContactCreate(s->world);
        MdtContactSetBodies(s->contact, s->body, 0);
        MdtContactSetPosition(s->contact, p[0], 0, p[2]);
        MdtContactSetNormal(s->contact, 0, 1, 0);
        MdtContactSetPenetration(s->contact, depth);
        MdtContactSetParams(s->contact, &s->params);
        MdtContactEnable(s->contact);
    }
    MdtWorldStep(s->world, h);
}

static double heightOf(const Ball *s) {
    return (double)MdtBodyGetTransformPtr(s->body)[3][1] - s->radius;
}

static double speedOf(const Ball *s) {
    MeVector3 v;
    MdtBodyGetLinearVelocity(s->body, v);
    return v[1];
}

/* The next height at which the ball turns round. */
static double nextTop(Ball *s, MeReal h) {
    while (speedOf(s) <= 0)
        stepBall(s, h);
    double top = heightOf(s);
    while (speedOf(s) > 0) {
        stepBall(s, h);
        top = fmax(top, heightOf(s));
    }
    return top;
}

TEST(bounces_rise_to_the_square_of_the_restitution) {
    const double es[] = {.9, .7, .5, .2};
    for (int k = 0; k < 4; k++)
        for (int early = 0; early < 2; early++) {
            Ball s = makeBall(2.5, 9.81);
            s.early = early;
            MdtContactParamsSetRestitution(&s.params, es[k]);
            double wanted = 2;
            for (int bounce = 0; bounce < 3; bounce++) {
                const double top = nextTop(&s, 5e-4);
                wanted *= es[k] * es[k];
                /* the top lies between two pictures */
                assert_near(top, wanted, 9.81 / 8 * 5e-4 * 5e-4 + TOL(early ? 2e-6 : 1e-5, early ? 1e-9 : 1e-6));
            }
        }
}

/* The Dynamics guide's Bounce: a contact is made once the ball is in the plane; its depth tells when and how fast
 * they met. Flights between bounces last 20 steps and more. */
TEST(contacts_that_are_made_late_bounce_as_high) {
    static const struct {
        double h, e, g, height;
    } cases[] = {
        {.02, .6, 9.8, 4.4}, {.04, .8, 9.8, 20}, {.01, .3, 1.6, .9}, {.0025, .5, 100, 4}, {1. / 60, .95, 9.8, 1}};
    for (int k = 0; k < 5; k++) {
        const double h = cases[k].h, g = cases[k].g, ratio = cases[k].e * cases[k].e;
        Ball s = makeBall(.5 + cases[k].height, g);
        double wanted = ratio * cases[k].height;
        int bounces = 0;
        MdtContactParamsSetRestitution(&s.params, cases[k].e);
        for (; bounces < 10 && sqrt(8 * wanted / g) >= 20 * h; bounces++) {
            while (speedOf(&s) <= 0)
                stepBall(&s, h);
            while (speedOf(&s) > 0) /* up, and to the first picture after the top */
                stepBall(&s, h);
            const double top = heightOf(&s) + speedOf(&s) * speedOf(&s) / (2 * g);
            assert_near_rel(top, wanted, TOL(1e-4, 1e-6));
            wanted = ratio * top;
        }
        ck_assert_int_ge(bounces, 1);
    }
}

static double energyOf(const Ball *s) {
    return 9.81 * heightOf(s) + speedOf(s) * speedOf(s) / 2;
}

TEST(a_lossless_bounce_neither_gains_nor_loses) {
    for (int early = 0; early < 2; early++) {
        Ball s = makeBall(5.5, 9.81);
        s.early = early;
        MdtContactParamsSetRestitution(&s.params, 1);
        const double first = nextTop(&s, FRAME);
        for (int i = 0; i < 10; i++) {
            const double top = nextTop(&s, FRAME), energy = energyOf(&s);
            assert_below(top, 5 + 1e-5);
            assert_near(top, first, 9.81 * (double)FRAME * (double)FRAME); /* tops lie between two pictures */
            if (early)
                assert_near(energy, 9.81 * 5, TOL(1e-4, 1e-9));
        }
    }
}

TEST(impacts_below_the_threshold_do_not_bounce) {
    for (int k = 0; k < 2; k++) {
        Ball s = makeBall(.5, 0);
        s.early = METRUE;
        MdtContactParamsSetRestitution(&s.params, .5);
        MdtContactParamsSetRestitutionThreshold(&s.params, 1);
        MdtBodySetLinearVelocity(s.body, 0, k ? (MeReal)-1.1 : (MeReal)-.9, 0);
        stepBall(&s, FRAME);
        assert_near(speedOf(&s), k ? .55 : 0, TOL(1e-6, 9e-9));
    }
}

TEST(a_bouncing_ball_comes_to_rest_and_stays) {
    /* an overlap that counts as touching is left as it is: a part of the ball's size, sqrt(I/m) */
    const double touching = TOL(1e-5, 1e-7) * sqrt(.4);
    Ball s = makeBall(3, 9.81);
    MdtWorldSetEpsilon(s.world, MDTWORLD_DEFAULT_EPSILON); /* the sag that keeps the contact overlapping */
    MdtContactParamsSetRestitution(&s.params, .6);
    for (int i = 0; i < 600; i++)
        stepBall(&s, FRAME);
    for (int i = 0; i < 300; i++) {
        stepBall(&s, FRAME);
        assert_near(speedOf(&s), 0, TOL(1e-5, 9e-9));
        assert_near(heightOf(&s), -1e-4 * 9.81 * (double)FRAME * (double)FRAME / .2, touching);
    }
}

static void pushFor(Ball *s, int n, double fx, double fz) {
    for (int i = 0; i < n; i++) {
        MdtBodyAddForce(s->body, fx, 0, fz);
        stepBall(s, FRAME);
    }
}

/* Kea stops when every row is met to 1e-9 of the partition's speed: the loads' change and a tenth of the whole. */
#define SOLVER_ERROR(acceleration) (1.1e-9 * (acceleration) * (double)FRAME)

/* A body whose contact is at its centre, so that friction does not turn it. */
static Ball makeBlock(double gravity) {
    Ball s = makeBall(0, gravity);
    s.radius = 0;
    s.early = METRUE;
    return s;
}

static void velocityOf(const Ball *s, MeVector3 v) {
    MdtBodyGetLinearVelocity(s->body, v);
}

/* A body that has risen by less than half a digit of single precision shows the same place as before. What is measured
 * from there says nothing of the rise, which MdtContactSetExact puts back: noise of rounding moves no resting body. */
TEST(what_places_lose_by_rounding_is_put_back) {
    const double rise = 1.5e-6, position[3] = {0, 49.5, 0};
    for (unsigned int side = 0; side < 2; side++) {
        MeVector3 at;
        MdtWorldID w = scene_world(1, 1, 0);
        MdtBodyID b = scene_body(w, 1, 0, 50, 0);
        MdtBodySetLinearVelocity(b, 0, rise / (double)FRAME, 0);
        MdtWorldStep(w, FRAME);
        MdtBodyGetPosition(b, at);
        ck_assert(TOL((double)at[1] == 50, (double)at[1] > 50));
        MdtContactID c = MdtContactCreate(w);
        MdtContactSetBodies(c, side == 0 ? b : 0, side == 0 ? 0 : b);
        MdtContactSetExact(c, position, 50 - (double)at[1]);
        assert_near(MdtContactGetPenetration(c), side == 0 ? -rise : TOL(rise, -rise), TOL(1e-10, 1e-14));
    }
}

/* Else the forces of the last step, which are numbers along the direction, would be no guess for the next. */
TEST(the_primary_direction_does_not_hang_on_rounding) {
    static const MeReal axes[3][3] = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
    const MeReal noise = TOL((MeReal)1e-6, (MeReal)1e-12);
    MdtWorldID w = MdtWorldCreate(1, 1);
    MdtContactID c = MdtContactCreate(w);
    for (int k = 0; k < 3; k++) {
        MeVector3 before, now;
        MdtContactSetNormal(c, axes[k][0], axes[k][1], axes[k][2]);
        MdtContactGetDirection(c, before);
        for (int i = 0; i < 27; i++) {
            MdtContactSetNormal(c, axes[k][0] + noise * (MeReal)(i % 3 - 1),
                                axes[k][1] + noise * (MeReal)(i / 3 % 3 - 1), axes[k][2] + noise * (MeReal)(i / 9 - 1));
            MdtContactGetDirection(c, now);
            assert_vec3_near(now, before[0], before[1], before[2], 3 * (double)noise);
        }
    }
    MdtWorldDestroy(w);
}

TEST(box_friction_is_a_box) {
    Ball s = makeBlock(9.81);
    MeVector3 v;
    MdtContactParamsSetType(&s.params, MdtContactTypeFriction2D);
    MdtContactParamsSetFriction(&s.params, 10);
    pushFor(&s, 60, 9, 9);
    velocityOf(&s, v);
    assert_vec3_near(v, 0, 0, 0, TOL(1e-6, 2e-8));
    MdtContactParamsSetPrimaryFriction(&s.params, 10);
    MdtContactParamsSetSecondaryFriction(&s.params, 2);
    pushFor(&s, 60, 9, 9);
    velocityOf(&s, v);
    ck_assert_msg((fabs(v[0]) < 1e-6) != (fabs(v[2]) < 1e-6), "v = %g %g", v[0], v[2]);
    assert_near(fabs(v[0]) + fabs(v[2]), 7 * 60 * (double)FRAME, TOL(1e-4, 7e-8));
}

TEST(frictionless_and_infinite_friction) {
    MeVector3 v;
    Ball ice = makeBlock(9.81);
    pushFor(&ice, 60, 5, -2);
    velocityOf(&ice, v);
    assert_vec3_near(v, 5 * 60 * (double)FRAME, 0, -2 * 60 * (double)FRAME, TOL(1e-5, 5e-8));
    Ball glue = makeBlock(9.81);
    MdtContactParamsSetType(&glue.params, MdtContactTypeFriction2D); /* friction MEINFINITY by default */
    pushFor(&glue, 60, 1000, -2000);
    velocityOf(&glue, v);
    assert_vec3_near(v, 0, 0, 0, 1e-6);
}

TEST(friction_1d_acts_along_the_primary_direction) {
    Ball s = makeBlock(9.81);
    MdtContactID c = MdtContactCreate(s.world, s.body, 0); /* the form of the guide's sample */
    MdtContactSetNormal(c, 0, 1, 0);
    MdtContactSetDirection(c, 1, 5, 1); /* its part in the plane counts */
    MeVector3 d, v;
    MdtContactGetDirection(c, d);
    assert_vec3_near(d, sqrt(.5), 0, sqrt(.5), TOL(1e-6, 9e-9));
    MdtContactParamsSetType(MdtContactGetParams(c), MdtContactTypeFriction1D);
    MdtContactEnable(c);
    MdtBodyAddForce(s.body, 4, 0, 0);
    MdtWorldStep(s.world, FRAME);
    velocityOf(&s, v);
    assert_vec3_near(v, 2 * (double)FRAME, 0, -2 * (double)FRAME, TOL(1e-6, 2e-8));
}

/* The bound of the normal-force model is that of this very step: it holds from the first. */
TEST(normal_force_friction_is_coulomb_s) {
    const double mu = .4, g = 10;
    MeVector3 v;
    Ball s = makeBlock(g);
    MdtContactParamsSetType(&s.params, MdtContactTypeFriction2D);
    MdtContactParamsSetFrictionModel(&s.params, MdtFrictionModelNormalForce);
    MdtContactParamsSetFrictionCoeffecient(&s.params, mu);
    pushFor(&s, 1, 3.9, 0);
    velocityOf(&s, v);
    assert_near(v[0], 0, TOL(1e-6, 9e-9));
    pushFor(&s, 60, 5, 0);
    velocityOf(&s, v);
    assert_near(v[0], (5 - mu * g) * 60 * (double)FRAME, TOL(1e-5, 1e-8));
    /* gravity along a slope of tan .5 */
    for (int k = 0; k < 2; k++) {
        Ball slope = makeBlock(0);
        MdtWorldSetGravity(slope.world, g * sqrt(.2), -g * sqrt(.8), 0);
        MdtContactParamsSetType(&slope.params, MdtContactTypeFriction2D);
        MdtContactParamsSetFrictionModel(&slope.params, MdtFrictionModelNormalForce);
        const double coefficient = k ? .51 : .49;
        MdtContactParamsSetFrictionCoeffecient(&slope.params, coefficient);
        pushFor(&slope, 120, 0, 0);
        velocityOf(&slope, v);
        const double acceleration = g * (sqrt(.2) - coefficient * sqrt(.8));
        assert_near(v[0], k ? 0 : acceleration * 120 * (double)FRAME, TOL(2e-5, 1e-8));
    }
}

TEST(slip_velocity_is_slip_times_force_at_once) {
    const double slips[] = {.001, .1, 2};
    for (int k = 0; k < 3; k++) {
        Ball s = makeBlock(9.81);
        MeVector3 v;
        MdtContactParamsSetType(&s.params, MdtContactTypeFriction2D);
        MdtContactParamsSetSlip(&s.params, slips[k]);
        /* at once: with h far below the time m × slip that friction needs to bring a mass to its speed it is reached
         * exponentially, in a step of 1/60 s by 1 / (1 + m slip / h) */
        const double lag = slips[k] / (double)FRAME / (1 + slips[k] / (double)FRAME);
        pushFor(&s, 1, 3, 0);
        velocityOf(&s, v);
        const double first = 3 * slips[k] * (1 - lag);
        /* errors of four points add up to sqrt(4) times one row's */
        assert_near(v[0], first, TOL(1e-5 * first, 2 * SOLVER_ERROR(9.81 + 3)));
        pushFor(&s, 2000, 3, -1);
        velocityOf(&s, v);
        assert_near_rel(v[0], 3 * slips[k], TOL(1e-5, 1e-6));
        assert_near_rel(v[2], -1 * slips[k], TOL(1e-5, 1e-6));
    }
}

TEST(slide_carries_at_belt_speed) {
    Ball s = makeBlock(9.81);
    MeVector3 v, direction;
    MdtContactParamsSetType(&s.params, MdtContactTypeFriction2D);
    MdtContactParamsSetFriction(&s.params, 4);
    MdtContactParamsSetPrimarySlide(&s.params, 2);
    stepBall(&s, FRAME);
    MdtContactGetDirection(s.contact, direction);
    velocityOf(&s, v);
    for (int i = 0; i < 3; i++) /* friction 4 on the mass 1 */
        assert_near(v[i], 4 * (double)FRAME * direction[i], TOL(1e-6, 2e-8));
    pushFor(&s, 60, 0, 0);
    velocityOf(&s, v);
    for (int i = 0; i < 3; i++)
        assert_near(v[i], 2 * (double)direction[i], TOL(1e-6, 1e-9));
}

TEST(a_contact_does_not_pull_unless_it_is_adhesive) {
    MeVector3 f;
    Ball s = makeBlock(0);
    MdtContactParamsSetMaxAdhesiveForce(&s.params, 5);
    MdtBodyAddForce(s.body, 0, 4, 0);
    stepBall(&s, FRAME);
    assert_near(speedOf(&s), 0, 1e-7);
    MdtContactGetForce(s.contact, 0, f);
    assert_vec3_near(f, 0, -4, 0, TOL(1e-5, SOLVER_ERROR(4) / (double)FRAME));
    MdtBodyAddForce(s.body, 0, 7, 0);
    stepBall(&s, FRAME);
    assert_near(speedOf(&s), 2 * (double)FRAME, TOL(1e-6, 7e-9));
    Ball free = makeBlock(0);
    MdtBodyAddForce(free.body, 0, 4, 0);
    stepBall(&free, FRAME);
    assert_near(speedOf(&free), 4 * (double)FRAME, TOL(1e-6, 6e-10));
}

TEST(softness_rests_softness_force_step_squared_over_gamma_deep) {
    Ball s = makeBall(.5, 10);
    s.early = METRUE;
    MdtWorldSetEpsilon(s.world, .002);
    MdtContactParamsSetSoftness(&s.params, .01);
    for (int i = 0; i < 400; i++)
        stepBall(&s, FRAME);
    assert_near_rel(-heightOf(&s), .012 * 10 * (double)FRAME * (double)FRAME / .2, TOL(1e-3, 1e-6));
}

/* A contact with a gap lets the body come to the floor and no further, in the very step. */
TEST(a_gap_closes_exactly) {
    Ball s = makeBall(.6, 0);
    s.early = METRUE;
    MdtBodySetLinearVelocity(s.body, 0, -20, 0);
    stepBall(&s, FRAME);
    assert_near(heightOf(&s), 0, 1e-7);
    stepBall(&s, FRAME);
    assert_near(heightOf(&s), 0, 1e-7);
    assert_near(speedOf(&s), 0, TOL(1e-5, 9e-9));
}

TEST(overlap_is_pushed_out_by_gamma_a_step) {
    Ball s = makeBall(.4, 0);
    stepBall(&s, FRAME);
    assert_near(heightOf(&s), -.08, TOL(1e-6, 1e-9));
    stepBall(&s, FRAME);
}

TEST(a_disabled_contact_is_ignored_and_the_world_may_come_first) {
    Ball s = makeBlock(9.81);
    MdtContactID c = MdtContactCreate(s.world);
    MdtContactSetBodies(c, 0, s.body);
    MdtContactSetNormal(c, 0, -1, 0); /* the way the first body, the world, would be pushed */
    MdtWorldStep(s.world, FRAME);
    assert_near(speedOf(&s), -9.81 * (double)FRAME, TOL(1e-6, 2e-9));
    MdtContactEnable(c);
    MdtBodySetLinearVelocity(s.body, 0, 0, 0);
    MdtWorldStep(s.world, FRAME);
    assert_near(speedOf(&s), 0, TOL(1e-6, 2e-8));
    MeVector3 f;
    MdtContactGetForce(c, 1, f);
    assert_vec3_near(f, 0, 9.81, 0, TOL(1e-4, 1e-6));
}

TEST(a_moving_world_carries) {
    Ball s = makeBlock(9.81);
    MdtContactID c = MdtContactCreate(s.world);
    MeVector3 v;
    MdtContactSetBodies(c, s.body, 0);
    MdtContactParamsSetType(MdtContactGetParams(c), MdtContactTypeFriction2D);
    MdtContactSetWorldVelocity(c, 1, .5, -2);
    MdtContactEnable(c);
    MdtWorldStep(s.world, FRAME);
    velocityOf(&s, v);
    assert_vec3_near(v, 1, .5, -2, TOL(1e-5, 1e-9));
    MdtContactGetRelativeVelocity(c, v);
    assert_vec3_near(v, 0, 0, 0, TOL(1e-5, 1e-9));
}

TEST(parameters_have_the_guide_s_defaults) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtContactID c = MdtContactCreate(w);
    MdtContactParamsID p = MdtContactGetParams(c);
    MeVector3 v;
    ck_assert(MdtContactParamsGetType(p) == MdtContactTypeFrictionZero);
    ck_assert(MdtContactParamsGetPrimaryFrictionModel(p) == MdtFrictionModelBox);
    ck_assert(MdtContactParamsGetSecondaryFrictionModel(p) == MdtFrictionModelBox);
    ck_assert(MdtContactParamsGetPrimaryFriction(p) == MEINFINITY &&
              MdtContactParamsGetSecondaryFriction(p) == MEINFINITY);
    ck_assert(MdtContactParamsGetPrimaryFrictionCoeffecient(p) == 0 && MdtContactParamsGetRestitution(p) == 0);
    ck_assert(MdtContactParamsGetRestitutionThreshold(p) == (MeReal).001 && MdtContactParamsGetSoftness(p) == 0);
    ck_assert(MdtContactParamsGetPrimarySlip(p) == 0 && MdtContactParamsGetPrimarySlide(p) == 0 &&
              MdtContactParamsGetMaxAdhesiveForce(p) == 0 && p->options == 0);
    MdtContactGetNormal(c, v);
    assert_vec3_near(v, 0, 1, 0, 0);
    MdtContactGetPosition(c, v);
    assert_vec3_near(v, 0, 0, 0, 0);
    ck_assert(MdtContactGetPenetration(c) == 0 && MdtContactGetNext(c) == MdtContactInvalidID);
}

/* Every value goes in and comes out, and switches its option. */
TEST(parameters_round_trip) {
    MdtBclContactParams p;
    MdtContactParamsReset(&p);
    MdtContactParamsSetPrimarySlip(&p, 1);
    MdtContactParamsSetSecondarySlip(&p, 2);
    MdtContactParamsSetPrimarySlide(&p, -3);
    MdtContactParamsSetSecondarySlide(&p, 4);
    MdtContactParamsSetMaxAdhesiveForce(&p, 5);
    MdtContactParamsSetSoftness(&p, 6);
    MdtContactParamsSetRestitution(&p, .7);
    MdtContactParamsSetSecondaryFrictionCoeffecient(&p, 8);
    ck_assert(MdtContactParamsGetPrimarySlip(&p) == 1 && MdtContactParamsGetSecondarySlip(&p) == 2);
    ck_assert(MdtContactParamsGetPrimarySlide(&p) == -3 && MdtContactParamsGetSecondarySlide(&p) == 4);
    ck_assert(MdtContactParamsGetMaxAdhesiveForce(&p) == 5 && MdtContactParamsGetSoftness(&p) == 6);
    ck_assert(MdtContactParamsGetSecondaryFrictionCoeffecient(&p) == 8);
    ck_assert_int_eq(p.options, MdtBclContactOptionSlip1 | MdtBclContactOptionSlip2 | MdtBclContactOptionSlide1 |
                                    MdtBclContactOptionSlide2 | MdtBclContactOptionAdhesive | MdtBclContactOptionSoft |
                                    MdtBclContactOptionBounce);
    MdtContactParamsSetSlip(&p, 0);
    MdtContactParamsSetRestitution(&p, 0);
    ck_assert_int_eq(p.options & (MdtBclContactOptionSlip1 | MdtBclContactOptionSlip2 | MdtBclContactOptionBounce), 0);
}

/* ---- surfaces ---- */

static char told[sizeof caught.last];
static int tellings;

static void MEAPI tell(const int level, const char *const text) {
    (void)level;
    tellings++;
    snprintf(told, sizeof told, "%s", text);
}

/* The warning that a contact with these parameters gets in two steps; empty: none. An information is in `told`. No more
 * than one of them. */
static const char *saidOf(const MdtBclContactParams *params) {
    static char text[sizeof caught.last];
    const MeShow before = MeSetInfoShow(tell);
    MdtWorldID w = scene_world(1, 1, 10);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MdtContactID c = MdtContactCreate(w, b, 0);
    MdtContactSetParams(c, (MdtContactParamsID)(size_t)params);
    MdtContactEnable(c);
    tellings = 0;
    told[0] = 0;
    for (int i = 0; i < 2; i++)
        MdtWorldStep(w, FRAME);
    ck_assert_int_le(caught.warnings + tellings, 1);
    strcpy(text, caught.warnings ? caught.last : "");
    messages_forget();
    MeSetInfoShow(before);
    return text;
}

TEST(friction_that_cannot_act_or_has_no_bound_is_told_once) {
    MdtBclContactParams p;
    MdtContactParamsReset(&p);
    ck_assert_str_eq(saidOf(&p), "");
    MdtContactParamsSetFrictionCoeffecient(&p, .7);
    ck_assert(strstr(saidOf(&p), "MdtContactParamsSetSurface") && strstr(saidOf(&p), "SetType was not called"));
    MdtContactParamsSetFrictionModel(&p, MdtFrictionModelCone);
    ck_assert(strstr(saidOf(&p), "SetType was not called"));
    MdtContactParamsSetType(&p, MdtContactTypeFrictionZero);
    ck_assert_str_eq(saidOf(&p), "");
    MdtContactParamsSetType(&p, MdtContactTypeFriction2D);
    ck_assert_str_eq(saidOf(&p), "");
    MdtContactParamsSetSecondaryFrictionModel(&p, MdtFrictionModelBox);
    ck_assert(strstr(saidOf(&p), "the box"));
    MdtContactParamsSetType(&p, MdtContactTypeFriction1D);
    ck_assert_str_eq(saidOf(&p), "");
    MdtContactParamsReset(&p);
    MdtContactParamsSetType(&p, MdtContactTypeFriction2D);
    ck_assert_str_eq(saidOf(&p), ""); /* no warning: the User Guide's quadbike does so */
    ck_assert(strstr(told, "without bound") && strstr(told, "MEINFINITY"));
    MdtContactParamsSetFriction(&p, MEINFINITY);
    ck_assert_str_eq(saidOf(&p), "");
    ck_assert_str_eq(told, "");
    MdtContactParamsSetFrictionModel(&p, MdtFrictionModelNormalForce);
    ck_assert(strstr(saidOf(&p), "wants a coefficient"));
}

TEST(a_surface_is_set_by_one_call) {
    MdtBclContactParams p;
    MdtContactParamsReset(&p);
    MdtContactParamsSetSurface(&p, .6, .3);
    ck_assert_int_eq(MdtContactParamsGetType(&p), MdtContactTypeFriction2D);
    ck_assert_int_eq(MdtContactParamsGetPrimaryFrictionModel(&p), MdtFrictionModelCone);
    ck_assert_int_eq(MdtContactParamsGetSecondaryFrictionModel(&p), MdtFrictionModelCone);
    ck_assert(MdtContactParamsGetPrimaryFrictionCoeffecient(&p) == (MeReal).6);
    ck_assert(MdtContactParamsGetSecondaryFrictionCoeffecient(&p) == (MeReal).6);
    ck_assert(MdtContactParamsGetRestitution(&p) == (MeReal).3);
    ck_assert_str_eq(saidOf(&p), "");
    assert_refused(MdtContactParamsSetSurface, &p, -1, 0);
    assert_refused(MdtContactParamsSetSurface, &p, 1, 2);
    assert_refused(MdtContactParamsSetSurface, 0, 1, 0);
    ck_assert(MdtContactParamsGetPrimaryFrictionCoeffecient(&p) == (MeReal).6);
    MdtContactParamsSetSurface(&p, 0, 0);
    ck_assert_int_eq(MdtContactParamsGetType(&p), MdtContactTypeFrictionZero);
    ck_assert_str_eq(saidOf(&p), "");
}

TEST(the_threshold_of_restitution_is_of_the_world_s_length_scale) {
    const MdtWorldID world = MdtWorldCreate(2, 8, .25, 1);
    MdtBclContactParams *const p = MdtContactGetParams(MdtContactCreate(world));
    assert_near_rel(MdtContactParamsGetRestitutionThreshold(p), .001 / 4, 1e-6);
    MdtWorldDestroy(world);
}
