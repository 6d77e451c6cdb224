/* The friction cone: as strong in every direction, sticking below the friction angle and sliding above it. */
#include "scene.h"

static const double mu = .5, gravity = 10, pi = 3.14159265358979323846;

/* A cube of edge 1 and mass 1 on four contacts, its weight down. */
typedef struct {
    MdtWorldID world;
    MdtBodyID body;
} Cube;

static Cube makeCube(void) {
    const double edge[3] = {1, 1, 1};
    Cube s;
    s.world = scene_world(1, 4, gravity);
    MdtWorldSetEpsilon(s.world, 0);
    s.body = scene_box(s.world, 1, edge, 0, .5, 0);
    return s;
}

/* Four contacts at the lower corners of a body whose faces are upright, with a primary direction turned by `turn` about
 * the normal. */
static void standOn(MdtBodyID body, MdtBodyID on, double depth, MdtFrictionModel model, double turn) {
    MeVector3 p;
    MdtBodyGetPosition(body, p);
    for (int i = 0; i < 4; i++) {
        MdtContactID c = MdtContactCreate(MdtBodyGetWorld(body));
        MdtContactSetBodies(c, body, on);
        MdtContactSetPosition(c, p[0] + (MeReal)(i & 1 ? .5 : -.5), p[1] - (MeReal).5,
                              p[2] + (MeReal)(i & 2 ? .5 : -.5));
        MdtContactSetNormal(c, 0, 1, 0);
        MdtContactSetPenetration(c, depth);
        MdtContactSetDirection(c, cos(turn), 0, sin(turn));
        MdtContactParamsID params = MdtContactGetParams(c);
        MdtContactParamsSetType(params, MdtContactTypeFriction2D);
        MdtContactParamsSetFrictionModel(params, model);
        MdtContactParamsSetFrictionCoeffecient(params, mu);
        MdtContactEnable(c);
    }
}

static void makeContacts(Cube *s, MdtFrictionModel model, double turn) {
    MeVector3 p;
    MdtBodyGetPosition(s->body, p);
    while (MdtConstraintGetFirst(s->world))
        MdtConstraintDestroy(MdtConstraintGetFirst(s->world));
    standOn(s->body, 0, .5 - (double)p[1], model, turn);
}

/* Pushes at the height of the floor, so that the cube does not tip, for n steps. */
static void push(Cube *s, MdtFrictionModel model, double force, double angle, double turn, int n) {
    for (int i = 0; i < n; i++) {
        MeVector3 p;
        MdtBodyGetPosition(s->body, p);
        makeContacts(s, model, turn);
        MdtBodyAddForceAtPosition(s->body, force * cos(angle), 0, force * sin(angle), p[0], 0, p[2]);
        MdtWorldStep(s->world, FRAME);
    }
}

TEST(it_holds_below_and_slides_above_in_every_direction) {
    for (int k = 0; k < 16; k++) {
        const double angle = k * pi / 8 + .05;
        MeVector3 v;
        Cube s = makeCube();
        push(&s, MdtFrictionModelCone, .999 * mu * gravity, angle, .3, 30);
        MdtBodyGetLinearVelocity(s.body, v);
        assert_vec3_near(v, 0, 0, 0, TOL(1e-5, 1e-9));

        s = makeCube();
        push(&s, MdtFrictionModelCone, 1.1 * mu * gravity, angle, .3, 30);
        MdtBodyGetLinearVelocity(s.body, v);
        const double speed = .1 * mu * gravity * 30 * (double)FRAME; /* what the friction leaves, straight on */
        assert_vec3_near(v, speed * cos(angle), 0, speed * sin(angle), TOL(2e-4, 7e-8) * speed + TOL(1e-5, 0));
    }
}

TEST(a_sliding_cube_keeps_its_direction_and_stops) {
    for (int k = 0; k < 8; k++) {
        const double angle = k * pi / 4 + .4, speed = 2;
        Cube s = makeCube();
        MeVector3 p;
        MdtBodySetLinearVelocity(s.body, speed * cos(angle), 0, speed * sin(angle));
        for (int i = 0; i < 60; i++) {
            makeContacts(&s, MdtFrictionModelCone, .1 * k);
            MdtWorldStep(s.world, FRAME);
        }
        MdtBodyGetPosition(s.body, p);
        const double way = hypot(p[0], p[2]);
        assert_near(way, speed * speed / (2 * mu * gravity), TOL(1e-6, 4e-9)); /* the box model would curve */
        assert_near((double)p[0] * sin(angle) - (double)p[2] * cos(angle), 0, TOL(1e-6, 1e-7));
    }
}

TEST(the_normal_force_model_is_a_pyramid) {
    MeVector3 v;
    Cube s = makeCube();
    push(&s, MdtFrictionModelNormalForce, 1.3 * mu * gravity, pi / 4, 0, 30); /* the pyramid's corner holds 1.41 */
    MdtBodyGetLinearVelocity(s.body, v);
    assert_vec3_near(v, 0, 0, 0, TOL(1e-5, 1e-9));
}

/* m/s along x and z, after a step, of a cube that slid along both with 1 m/s. */
static void slideWith(MdtFrictionModel model, double first, double second, MeVector3 v) {
    Cube s = makeCube();
    makeContacts(&s, model, 0);
    for (MdtConstraintID c = MdtConstraintGetFirst(s.world); c; c = MdtConstraintGetNext(c)) {
        MdtContactParamsID params = MdtContactGetParams(MdtConstraintDCastContact(c));
        params->FrictionCoefficient = first;
        params->FrictionCoefficient2 = second;
    }
    MdtBodySetLinearVelocity(s.body, 1, 0, 1);
    MdtWorldStep(s.world, FRAME);
    MdtBodyGetLinearVelocity(s.body, v);
}

/* A cone has but the first one's coefficient; bounds are those of boxes, however large. */
TEST(each_model_has_its_own_coefficients_and_no_bounds) {
    const double lost = mu * gravity * (double)FRAME;
    MeVector3 v;
    slideWith(MdtFrictionModelCone, mu, 0, v);
    assert_vec3_near(v, 1 - lost * sqrt(.5), 0, 1 - lost * sqrt(.5), TOL(1e-5, 1e-9));
    slideWith(MdtFrictionModelNormalForce, mu, 0, v);
    assert_vec3_near(v, 1 - lost, 0, 1, TOL(1e-5, 1e-9));
    messages_forget(); /* it may be told that there is no second one */
}

/* Loads make both of two cubes fall alike; what holds the lower one closes the gap that a rounding has left. */
TEST(it_acts_between_bodies_that_stand_on_each_other) {
    const double edge[3] = {1, 1, 1}, gaps[] = {0, TOL(1e-6, 1e-12), 1e-4};
    for (int k = 0; k < 3; k++) {
        MeVector3 v;
        Cube s = {.world = scene_world(2, 8, gravity)};
        MdtWorldSetEpsilon(s.world, 0);
        s.body = scene_box(s.world, 1, edge, 0, .5, 0);
        const MdtBodyID upper = scene_box(s.world, 1, edge, 0, 1.5 + gaps[k], 0);
        standOn(s.body, 0, 0, MdtFrictionModelCone, 0);
        standOn(upper, s.body, -gaps[k], MdtFrictionModelCone, 0);
        MdtBodyAddForce(upper, .4 * mu * gravity, 0, 0);
        MdtWorldSetTimedContacts(s.world, 0); /* as in larger partitions */
        MdtWorldStep(s.world, FRAME);
        MdtBodyGetLinearVelocity(upper, v);
        assert_near(v[0], 0, TOL(1e-5, 1e-9));
    }
}

/* In the first step a ball with that spin turns by 3.3 rad, which no rotation of a step shows: nobody needs it. One
 * whose mass is beside its middle does, and says so. */
TEST(a_ball_may_spin_as_fast_as_it_likes) {
    const double radius = .1, spin = 200;
    for (int aside = 0; aside < 2; aside++) {
        MdtReport report;
        MeVector3 v;
        MdtWorldID w = scene_world(1, 1, gravity);
        MdtWorldSetEpsilon(w, 0);
        MdtWorldEnableReport(w);
        MdtBodyID b = scene_body(w, 1, 0, radius, 0);
        MdtBodySetInertiaTensor(b, (MeMatrix3){{.004, 0, 0}, {0, (MeReal).004, 0}, {0, 0, (MeReal).004}});
        MdtBodySetAngularVelocity(b, 0, 0, spin);
        MdtContactID c = MdtContactCreate(w);
        MdtContactSetBodies(c, b, 0);
        MdtContactSetPosition(c, aside * radius / 2, 0, 0);
        MdtContactSetRadius(c, 0, radius);
        MdtContactParamsSetType(MdtContactGetParams(c), MdtContactTypeFriction2D);
        MdtContactParamsSetFrictionModel(MdtContactGetParams(c), MdtFrictionModelCone);
        MdtContactParamsSetFrictionCoeffecient(MdtContactGetParams(c), mu);
        MdtContactEnable(c);
        MdtWorldStep(w, FRAME);
        if (!aside)
            assert_silent();
        messages_forget();
        ck_assert(MdtWorldGetReport(w, &report));
        if (aside)
            ck_assert(report.fallbacks > 0 || report.parts > 1);
        else {
            ck_assert_int_eq(report.fallbacks, 0);
            ck_assert_int_eq(report.parts, 1);
            MdtBodyGetLinearVelocity(b, v);
            assert_near(v[0], -mu * gravity * (double)FRAME, TOL(2e-7, 1e-8));
        }
    }
}
