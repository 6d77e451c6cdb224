/* A constraint whose rows the program writes: what its function is given, and what rows of each kind do. */
#include "measure.h"

static MdtWorldID makeWorld(double gravity) {
    MdtWorldID w = scene_world(2, 2, gravity);
    MdtWorldSetEpsilon(w, 0);
    return w;
}

static MdtUserConstraintID make(MdtWorldID w, MdtBodyID a, MdtBodyID b, MdtBclAddConstraintFn f, void *data) {
    MdtUserConstraintID j = MdtUserConstraintCreate(w);
    MdtUserConstraintSetBodies(j, a, b);
    MdtUserConstraintSetFunction(j, f);
    if (data)
        MdtUserConstraintSetConstraintData(j, data);
    MdtUserConstraintEnable(j);
    return j;
}

/* ---- what the function is given ---- */

typedef struct {
    int calls;
    void *owner;
    MdtKeaTransformation pose[2];
    MdtKeaBody *body[2];
    MdtBclSolverParameters parameters;
} Seen;

static Seen seen;

static void MEAPI look(MdtKeaConstraints *const list, void *const constraint, const MdtKeaTransformation *const pose,
                       MdtKeaBody *const bodies[], const void *const params) {
    (void)list;
    seen.calls++;
    seen.owner = constraint;
    seen.parameters = *(const MdtBclSolverParameters *)params;
    for (int k = 0; k < 2; k++) {
        seen.pose[k] = pose[k];
        seen.body[k] = bodies[k];
    }
}

TEST(the_function_is_given_poses_bodies_and_parameters) {
    MdtWorldID w = makeWorld(0);
    MdtBodyID b = scene_body(w, 4, 1, 2, 3);
    MdtUserConstraintID j = make(w, 0, b, look, NULL);
    MdtWorldSetEpsilon(w, .25);
    MdtWorldSetGamma(w, .5);
    memset(&seen, 0, sizeof seen);
    MdtWorldStep(w, .125);
    ck_assert_int_eq(seen.calls, 1);
    ck_assert(seen.owner == (void *)j);
    ck_assert(seen.body[0] == NULL && seen.body[1] != NULL);
    assert_near(seen.body[1]->invMass, .25, 0);
    assert_vec3_near(seen.pose[0].pos, 0, 0, 0, 0);
    assert_vec3_near(seen.pose[1].pos, 1, 2, 3, 0);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            assert_near(seen.pose[0].R[i][k], i == k, 0);
    assert_near(seen.parameters.stepsize, .125, 0);
    assert_near(seen.parameters.epsilon, .25, 0);
    assert_near(seen.parameters.gamma, .5, 0);
    int data;
    MdtUserConstraintSetConstraintData(j, &data);
    ck_assert(MdtUserConstraintGetConstraintData(j) == &data);
    MdtWorldStep(w, .125);
    ck_assert(seen.owner == &data);
    MdtUserConstraintDisable(j);
    MdtWorldStep(w, .125);
    ck_assert_int_eq(seen.calls, 2);
}

TEST(without_a_function_it_has_no_rows) {
    MdtWorldID w = makeWorld(10);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MdtUserConstraintID j = make(w, b, 0, NULL, NULL);
    double v[3];
    MdtWorldStep(w, FRAME);
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtUserConstraintQuaConstraint(j)), 0);
    measure_velocity(b, v);
    assert_vec3_near(v, 0, -10. / 60, 0, TOL(1e-7, 9e-14));
}

/* ---- rows ---- */

/* How one row along y is to be. */
typedef struct {
    double target, lower, upper, softness;
    double stiffness, damping, rest;
    MeBool isSpring;
} Recipe;

static void MEAPI oneRow(MdtKeaConstraints *const list, void *const constraint, const MdtKeaTransformation *const pose,
                         MdtKeaBody *const bodies[], const void *const params) {
    const Recipe *r = constraint;
    MdtKeaRow *row = MdtBclAddRow(list);
    (void)bodies, (void)params;
    row->J[0].lin[1] = 1;
    row->J[1].lin[1] = -1;
    row->target = r->target;
    row->lower = r->lower;
    row->upper = r->upper;
    if (r->softness > 0)
        row->softness = r->softness;
    if (r->isSpring) {
        row->spring = METRUE;
        row->error = pose[0].pos[1] - pose[1].pos[1] - r->rest;
        row->stiffness = r->stiffness;
        row->damping = r->damping;
    }
}

static const Recipe free_ = {.lower = -HUGE_VAL, .upper = HUGE_VAL};

TEST(a_row_aims_at_its_target) {
    MdtWorldID w = makeWorld(10);
    MdtBodyID b = scene_body(w, 3, 0, 0, 0);
    Recipe r = free_;
    r.target = 2;
    MdtUserConstraintID j = make(w, b, 0, oneRow, &r);
    double v[3], f[3];
    MdtBodySetLinearVelocity(b, 1, 0, 0);
    for (int i = 0; i < 10; i++) {
        MdtWorldStep(w, FRAME);
        measure_velocity(b, v);
        assert_vec3_near(v, 1, 2, 0, TOL(1e-6, 4e-11));
    }
    read_force(MdtUserConstraintQuaConstraint(j), 0, f);
    assert_vec3_near(f, 0, 30, 0, TOL(3e-5, 8e-10));
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtUserConstraintQuaConstraint(j)), 1);
}

/* One-sided, as a contact; and with a bound, as a motor. */
TEST(bounds_are_kept) {
    MdtWorldID w = makeWorld(10);
    MdtBodyID b = scene_body(w, 3, 0, 0, 0);
    Recipe r = {.lower = 0, .upper = HUGE_VAL};
    MdtUserConstraintID j = make(w, b, 0, oneRow, &r);
    double v[3], f[3];
    steps(w, 10, FRAME);
    measure_velocity(b, v);
    assert_near(v[1], 0, TOL(1e-6, 2e-11)); /* carried */
    MdtBodySetLinearVelocity(b, 0, 5, 0);
    MdtWorldStep(w, FRAME);
    measure_velocity(b, v);
    assert_near(v[1], 5 - 10. / 60, TOL(1e-6, 5e-13)); /* not held back */
    read_force(MdtUserConstraintQuaConstraint(j), 0, f);
    assert_near(f[1], 0, 0);
    r.lower = -12, r.upper = 12; /* 12 N on 3 kg */
    MdtBodySetLinearVelocity(b, 0, 0, 0);
    MdtWorldStep(w, FRAME);
    measure_velocity(b, v);
    assert_near(v[1], -(10 - 4) / 60., TOL(1e-7, 9e-15));
}

/* J v = s - h E λ: with the target 0 and its weight on it, a body sinks at h E m g. */
TEST(softness_is_a_compliance_in_velocity) {
    MdtWorldID w = makeWorld(10);
    MdtBodyID b = scene_body(w, 3, 0, 0, 0);
    Recipe r = free_;
    r.softness = .2;
    make(w, b, 0, oneRow, &r);
    double v[3];
    steps(w, 600, FRAME);
    measure_velocity(b, v);
    assert_near(v[1], -.2 * 30 / 60, TOL(1e-7, 3e-9));
}

TEST(a_spring_row_is_a_damped_spring) {
    const double k = 80, c = 1, mass = 2, h = FRAME;
    MdtWorldID w = makeWorld(10);
    MdtBodyID b = scene_body(w, mass, 0, 1, 0);
    Recipe r = free_;
    Swing swing = {0};
    double p[3];
    r.isSpring = METRUE;
    r.stiffness = k, r.damping = c, r.rest = 1;
    make(w, b, 0, oneRow, &r);
    for (int n = 0; n < 2000 && swing.crossings < 11; n++) {
        MdtWorldStep(w, FRAME);
        measure_position(b, p);
        swing_add(&swing, p[1] - 1 + mass * 10 / k);
    }
    const double w0 = sqrt(k / mass), decay = c / (2 * mass);
    swing_check(&swing, w0, decay, h, TOL(1e-5, 1e-8));
}

/* ---- a gear, which no joint of the library is: two wheels about z, ω_0 = -2 ω_1 ---- */

static void MEAPI gear(MdtKeaConstraints *const list, void *const constraint, const MdtKeaTransformation *const pose,
                       MdtKeaBody *const bodies[], const void *const params) {
    MdtKeaRow *row = MdtBclAddRow(list);
    (void)constraint, (void)pose, (void)bodies, (void)params;
    row->J[0].ang[2] = 1;
    row->J[1].ang[2] = 2;
}

TEST(a_gear) {
    MdtWorldID w = makeWorld(0);
    MdtBodyID a = scene_body(w, 1, 0, 0, 0), b = scene_body(w, 1, 1, 0, 0);
    double rate[2][3];
    MdtBodySetSphericalInertiaTensor(a, .1);
    MdtBodySetSphericalInertiaTensor(b, .3);
    make(w, a, b, gear, NULL);
    for (int i = 1; i <= 60; i++) {
        MdtBodyAddTorque(a, 0, 0, 1);
        MdtWorldStep(w, FRAME);
        measure_rate(a, rate[0]);
        measure_rate(b, rate[1]);
        assert_near(rate[0][2], -2 * rate[1][2], TOL(1e-5, 6e-13));
        assert_near(rate[0][2], 1 / (.1 + .3 / 4) * i / 60, TOL(1e-5, 6e-13)); /* I_0 + I_1 / 4 */
    }
}

/* ---- too many rows ---- */

static int granted;

static void MEAPI tooMany(MdtKeaConstraints *const list, void *const constraint, const MdtKeaTransformation *const pose,
                          MdtKeaBody *const bodies[], const void *const params) {
    (void)constraint, (void)pose, (void)bodies, (void)params;
    granted = 0;
    for (int i = 0; i < MdtBclGETMAXROWSUSER + 3; i++) {
        MdtKeaRow *row = MdtBclAddRow(list);
        if (!row)
            continue;
        granted++;
        row->J[0].lin[i % 3] = 1; /* redundant, too */
    }
}

TEST(too_many_rows_get_a_warning) {
    MdtWorldID w = makeWorld(10);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MdtUserConstraintID j = make(w, b, 0, tooMany, NULL);
    double p[3];
    MdtWorldStep(w, FRAME);
    ck_assert_int_eq(granted, MdtBclGETMAXROWSUSER);
    ck_assert_int_eq(MdtConstraintGetRowCount(MdtUserConstraintQuaConstraint(j)), MdtBclGETMAXROWSUSER);
    assert_warned("MdtBclAddRow");
    steps(w, 60, FRAME);
    measure_position(b, p);
    assert_vec3_near(p, 0, 0, 0, TOL(1e-6, 4e-12));
    messages_forget();
}

TEST(reset_keeps_the_function) {
    MdtWorldID w = makeWorld(10);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    Recipe r = free_;
    double p[3];
    MdtUserConstraintID j = make(w, b, 0, oneRow, &r);
    MdtUserConstraintReset(j);
    ck_assert(MdtUserConstraintGetFunction(j) == oneRow && MdtUserConstraintGetConstraintData(j) == &r);
    steps(w, 60, FRAME);
    measure_position(b, p);
    assert_near(p[1], 0, TOL(1e-6, 5e-12));
}
