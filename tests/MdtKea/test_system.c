/* Kea as a library of arrays: a system filled by hand. */
#include "MdtKea.h"
#include "MdtKeaMath.h"
#include "karma_test.h"

static MdtKeaBody point(double mass, double x) {
    const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    MdtKeaBody b = {.position = {x, 0, 0}, .quaternion = {1, 0, 0, 0}, .invMass = 1 / mass};
    b.flags = MdtKeaBodyFlagAddCoriolisForce;
    ck_assert(MdtKeaBodySetInertia(&b, unit));
    return b;
}

static void *scratchFor(MdtKeaSystem *s) {
    return aligned_alloc(16, (MdtKeaScratchSize(s->numBodies, s->maxRows) + 15) & ~(size_t)15);
}

/* A row along x between two bodies, or a body and the world. */
static MdtKeaRow *addRow(MdtKeaSystem *s, int a, int b) {
    MdtKeaRow *row = &s->rows[s->numRows++];
    memset(row, 0, sizeof *row);
    row->body[0] = a;
    row->body[1] = b;
    row->J[0].lin[0] = 1;
    row->J[1].lin[0] = -1;
    row->lower = -HUGE_VAL;
    row->upper = HUGE_VAL;
    row->normal = row->partner = -1;
    return row;
}

START_TEST(two_bodies_share_an_impulse) {
    MdtKeaBody a = point(1, 0), b = point(3, 1), *bodies[] = {&a, &b};
    MdtKeaSystem s = {.numBodies = 2, .bodies = bodies, .maxRows = 1, .parameters = {.stepsize = .1}};
    void *scratch = scratchFor(&s);
    a.velocity[0] = 4;
    MdtKeaInit(&s, scratch);
    addRow(&s, 0, 1);
    MdtKeaSolve(&s);
    ck_assert(a.velocity[0] == 4); /* the bodies are only read */
    ck_assert(MdtKeaIntegrate(&s));
    assert_near(a.velocity[0], 1, 1e-12);
    assert_near(b.velocity[0], 1, 1e-12);
    assert_near(s.rows[0].force, -30, 1e-9); /* 3 kg m/s in 0.1 s */
    assert_near(a.position[0], .1, 1e-12);
    assert_near(s.pose[1].pos[0], 1.1, 1e-12);
    assert_below(s.report.residual, 1e-12);
    free(scratch);
}
END_TEST

START_TEST(softness_and_targets_obey_the_row_s_law) {
    MdtKeaBody a = point(2, 0), *bodies[] = {&a};
    MdtKeaSystem s = {.numBodies = 1, .bodies = bodies, .maxRows = 1, .parameters = {.stepsize = .02}};
    void *scratch = scratchFor(&s);
    a.force[0] = 7;
    MdtKeaInit(&s, scratch);
    MdtKeaRow *row = addRow(&s, 0, MdtKeaWORLD);
    row->target = .3;
    row->softness = 5;
    MdtKeaSolve(&s);
    MdtKeaIntegrate(&s);
    assert_near(a.velocity[0], .3 - .02 * 5 * row->force, 1e-12);  /* J v⁺ = s - h E λ */
    assert_near(a.velocity[0], .02 * (7 + row->force) / 2, 1e-12); /* v⁺ = v + h (f + λ) / m */
    free(scratch);
}
END_TEST

START_TEST(bounds_and_friction_bounds_hold) {
    MdtKeaBody a = point(1, 0), *bodies[] = {&a};
    MdtKeaSystem s = {.numBodies = 1, .bodies = bodies, .maxRows = 2, .parameters = {.stepsize = .01}};
    void *scratch = scratchFor(&s);
    a.force[1] = -10;
    a.force[0] = 8;
    MdtKeaInit(&s, scratch);
    MdtKeaRow *normal = addRow(&s, 0, MdtKeaWORLD), *friction = addRow(&s, 0, MdtKeaWORLD);
    normal->J[0].lin[0] = 0;
    normal->J[0].lin[1] = 1;
    normal->lower = 0;
    friction->normal = 0;
    friction->friction = .5;
    MdtKeaSolve(&s);
    MdtKeaIntegrate(&s);
    assert_near(normal->force, 10, 1e-9);
    assert_near(friction->force, -5, 1e-9);
    assert_near(a.velocity[0], .03, 1e-12);
    assert_near(a.velocity[1], 0, 1e-12);
    free(scratch);
}
END_TEST

/* Position rows are met where the body arrives: a point on a circle of radius 1, turning fast. */
static void MEAPI circleError(void *context, const MdtKeaTransformation poses[], double errors[]) {
    (void)context;
    errors[0] = keaLength(poses[0].pos) - 1;
}

static double radiusAfterStep(MeBool position, MeBool *violent) {
    MdtKeaBody a = point(1, 1), *bodies[] = {&a};
    MdtKeaSystem s = {.numBodies = 1, .bodies = bodies, .maxRows = 1, .parameters = {.stepsize = .02}};
    void *scratch = scratchFor(&s);
    s.errors = circleError;
    a.velocity[1] = 10;
    MdtKeaInit(&s, scratch);
    addRow(&s, 0, MdtKeaWORLD)->position = position;
    MdtKeaSolve(&s);
    MdtKeaIntegrate(&s);
    *violent = s.report.violent;
    free(scratch);
    return keaLength(a.position);
}

START_TEST(position_rows_are_met_at_the_end) {
    MeBool violent;
    assert_near(radiusAfterStep(MEFALSE, &violent), sqrt(1 + .04), 1e-12);
    ck_assert(!violent);
    assert_near(radiusAfterStep(METRUE, &violent), 1, 1e-8);
    ck_assert(!violent);
}
END_TEST

START_TEST(a_state_that_is_not_finite_is_not_taken) {
    MdtKeaBody a = point(1, 0), *bodies[] = {&a};
    MdtKeaSystem s = {.numBodies = 1, .bodies = bodies, .parameters = {.stepsize = 1}};
    void *scratch = scratchFor(&s);
    a.force[0] = HUGE_VAL;
    MdtKeaInit(&s, scratch);
    MdtKeaSolve(&s);
    ck_assert(!MdtKeaIntegrate(&s));
    ck_assert(a.position[0] == 0 && a.velocity[0] == 0);
    free(scratch);
}
END_TEST

START_TEST(memory_required_is_that_of_the_largest_partition) {
    const int rows[] = {3, 30, 12};
    ck_assert_int_eq(MdtKeaMemoryRequired(rows, 3, 30, 5), (int)MdtKeaScratchSize(5, 30));
    ck_assert_int_eq(MdtKeaMemoryRequired(NULL, 1, 12, 5), (int)MdtKeaScratchSize(5, 12));
    ck_assert_int_eq(MdtKeaMemoryRequired(rows, 0, 30, 5), 0);
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, two_bodies_share_an_impulse);
    tcase_add_test(t, softness_and_targets_obey_the_row_s_law);
    tcase_add_test(t, bounds_and_friction_bounds_hold);
    tcase_add_test(t, position_rows_are_met_at_the_end);
    tcase_add_test(t, a_state_that_is_not_finite_is_not_taken);
    tcase_add_test(t, memory_required_is_that_of_the_largest_partition);
}

TEST_MAIN("system", tests)
