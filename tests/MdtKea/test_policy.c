/* Choices of Kea (common/kea_policy_i.h) at work: each test meets its number from both sides, by less than a factor of
 * two, and fails when it is halved or doubled. Bodies are of 1 kg and 1 kg m². */
#include "common/kea_policy_i.h"
#include "inner/kea_newton_i.h"
#include "inner/kea_problem_i.h"
#include "karma_test.h"
#include "kea_i.h"
#include <float.h>

enum { MAX_BODIES = 70 };

static const double unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/* ---- the inner problem ---- */

static _Alignas(16) char memory[1 << 20];
static KeaProblem q;
static MdtKeaCache *cache;

/* Rows hold body 0 along x. */
static void begin(int numBodies, int numRows) {
    KeaArena arena = {memory, 0};
    memset(&q, 0, sizeof q);
    memset(memory, 0, sizeof memory);
    q.numBodies = numBodies;
    q.numRows = numRows;
    kea_problemLayOut(&q, numBodies, numRows, &arena);
    ck_assert_uint_lt(arena.used, sizeof memory);
    for (int b = 0; b < numBodies; b++) {
        q.metric[b].linear = q.scale[b] = q.length[b] = 1;
        memcpy(q.metric[b].angular, unit, sizeof unit);
        memcpy(q.metric[b].inverse, unit, sizeof unit);
    }
    for (int i = 0; i < numRows; i++) {
        KeaProblemRow *row = &q.row[i];
        row->body[1] = MdtKeaWORLD;
        row->J[0][0] = 1;
        row->normal = row->partner = -1;
        row->lower = -HUGE_VAL;
        row->upper = HUGE_VAL;
        row->state = KEA_ACTIVE;
    }
    cache = MdtKeaCacheCreate();
}

static void measure(void) {
    ck_assert(kea_problemBegin(&q, cache));
    kea_problemSetEffectiveMasses(&q);
}

static void end(void) {
    MdtKeaCacheDestroy(cache);
}

/* The friction bound after a pass, from R where μ p_n is R + f. The pass before went by 1 to R, and f was `before`. */
static double boundAfter(int pass, double f, double before) {
    begin(1, 2);
    q.row[1].normal = 0;
    q.row[1].friction = 1;
    q.row[1].frictionBound = 10;
    q.row[1].lastBound = 9;
    q.row[1].lastBoundError = before;
    q.row[0].p = 10 + f;
    kea_frictionApproachBounds(&q, pass);
    end();
    return q.row[1].frictionBound;
}

/* With β of a half, the step is f/2 - t (1 + Δf/2), and t is f/Δf between -4 and .9. */
static void assertSecant(double wanted, double taken) {
    const double f = 1, change = f / wanted;
    assert_near(boundAfter(9, f, f - change), 10 + 0.5 * f - taken * (1 + 0.5 * change), 1e-12);
}

TEST(friction_bounds_follow_in_full_then_by_a_secant) {
    assert_near(boundAfter(5, 1, 0.5), 11, 1e-12);
    assert_near(boundAfter(6, 1, 0.5), 10.5, 1e-12);
    assertSecant(0.8, 0.8);
    assertSecant(0.95, 0.9);
    assertSecant(-3, -3);
    assertSecant(-6, -4);
}

/* Solves with the factors of a metric that is smaller by `change`: each leaves that part of the error, which begins
 * with so many tolerances. */
static MeBool isRefined(double change, double error) {
    begin(1, 0);
    measure();
    q.isLinear = METRUE;
    ck_assert(kea_newtonFactorize(&q, METRUE));
    q.metric[0].linear += change;
    q.load[0][0] = error * 1e-10;
    const MeBool isFound = kea_problemRefine(&q);
    end();
    return isFound;
}

/* Each solve has to leave less than a tenth, and there are four. */
TEST(factors_that_are_kept_are_good_enough) {
    ck_assert(isRefined(0.08, 1e3) && !isRefined(0.12, 1e3));
    ck_assert(isRefined(0.08, 1e4) && !isRefined(0.08, 1e5));
}

/* With an inertia that is singular but for so many roundings of its diagonal. */
static MeBool isFactored(int roundings) {
    begin(1, 0);
    q.metric[0].angular[0][1] = q.metric[0].angular[1][0] = 1;
    q.metric[0].angular[1][1] = 1 + roundings * DBL_EPSILON;
    measure();
    const MeBool isRegular = kea_newtonFactorize(&q, MEFALSE);
    end();
    return isRegular;
}

TEST(a_pivot_of_four_roundings_is_none) {
    ck_assert(isFactored(5) && !isFactored(4));
}

/* What is missing of a momentum, in tolerances, beside a row whose impulse is the difference of two rates of 1 m/s. */
static double errorBeside(double missing) {
    begin(1, 1);
    measure();
    q.scale[0] = 0;
    q.row[0].N = 1;
    q.row[0].r = 1;
    q.load[0][0] = missing;
    const double error = kea_newtonError(&q, 0);
    end();
    return error;
}

TEST(eight_roundings_of_rates_are_no_error) {
    assert_below(errorBeside(7 * DBL_EPSILON), 1);
    assert_below(1, errorBeside(9 * DBL_EPSILON));
}

/* The friction of a slide, in μ p_n, after a solve that begins with a bound that is too large by that part. */
static double frictionAfter(double excess) {
    begin(1, 2);
    for (int i = 0; i < 2; i++)
        q.row[i].E = 1;
    q.row[0].lower = 0;
    q.row[1].normal = 0;
    q.row[1].friction = 0.5;
    q.row[1].frictionBound = 0.25 * (1 + excess); /* a load of 1 N s, half of which gives way */
    q.row[1].J[0][0] = 0;
    q.row[1].J[0][1] = 1;
    q.load[0][0] = 1;
    q.load[0][1] = 20;
    measure();
    ck_assert(kea_problemSolve(&q, METRUE));
    end();
    return q.row[1].p / (0.5 * q.row[0].p) - 1;
}

TEST(bounds_that_agree_to_twelve_digits_stay) {
    assert_near(frictionAfter(0.7e-12), 0.7e-12, 1e-14);
    assert_near(frictionAfter(1.4e-12), 0, 1e-14);
}

/* A column of n bodies, each on the one below, which a load presses down. */
static void makeColumn(int n) {
    begin(n, n);
    for (int b = 0; b < n; b++) {
        q.load[b][0] = 1;
        q.row[b].body[0] = b;
        q.row[b].body[1] = b > 0 ? b - 1 : MdtKeaWORLD;
        q.row[b].J[1][0] = b > 0 ? -1 : 0;
        q.row[b].lower = 0;
    }
    measure();
}

/* Sweeps of a solve that has so much work left, and shares it with other passes; the choice of its start counts as two.
 * */
static double sweepsOf(int bodies, double maxWork, int passes) {
    makeColumn(bodies);
    q.maxWork = maxWork;
    q.sweptPasses = passes;
    kea_problemSweep(&q);
    const double sweeps = q.counts.work / (96. * bodies) - 2;
    end();
    return sweeps;
}

/* 32 at most, 2 at least; as few passes as have room for 8 each, with their linearization of 256 a row and body. */
TEST(sweeps_share_what_work_is_left) {
    const double linearization = 256 * 2 * 50, sweep = 96 * 50, pass = linearization + sweep * (8 + 2);
    ck_assert(sweepsOf(50, 0, 1) == 32);
    ck_assert(sweepsOf(50, 1, 1) == 2);
    const double left = 3.5 * pass; /* of which three passes are made, that have 1.17 of it */
    ck_assert(sweepsOf(50, left + linearization, 8) == floor((left / 3 - linearization - 2 * sweep) / (96 * 51)));
}

/* Sweeps of two bodies, the upper of which is heavier and heavier, end when they move the impulses by less than 1e-7.
 * */
TEST(sweeps_end_when_they_have_settled) {
    double sweeps = 0;
    for (int k = 1; k <= 8; k++) {
        makeColumn(2);
        q.metric[1].linear = k;
        kea_problemSetEffectiveMasses(&q);
        q.sweptPasses = 1;
        kea_problemSweep(&q);
        sweeps += q.counts.work / (96. * 2) - 2;
        end();
    }
    ck_assert_msg(sweeps == 214, "%g", sweeps);
}

/* Contacts become harder by ten with each pass, until one pass leaves no more than is tolerated. */
TEST(contacts_harden_to_the_tolerance) {
    for (int i = 1; i < KEA_PROXIMAL_LEVELS; i++)
        assert_near_rel(kea_proximalContact[i], 0.1 * kea_proximalContact[i - 1], 1e-12);
    ck_assert(kea_proximalContact[KEA_PROXIMAL_LEVELS - 1] == kea_velocityTolerance);
}

/* ---- a step ---- */

static MdtKeaSystem s;
static MdtKeaBody body[MAX_BODIES], *pointer[MAX_BODIES];
static void *scratch;
static const double h = 1. / 64;

static void beginStep(int numBodies, int maxRows) {
    memset(&s, 0, sizeof s);
    memset(body, 0, sizeof body);
    for (int i = 0; i < numBodies; i++) {
        pointer[i] = &body[i];
        body[i].quaternion[0] = body[i].invMass = 1;
        body[i].flags = MdtKeaBodyFlagAddCoriolisForce;
        ck_assert(MdtKeaBodySetInertia(&body[i], unit));
    }
    s.numBodies = numBodies;
    s.bodies = pointer;
    s.maxRows = maxRows;
    s.maxContacts = 1;
    s.cache = MdtKeaCacheCreate();
    s.parameters.stepsize = h;
    s.parameters.gamma = 0.25;
    const size_t size = MdtKeaScratchSize(numBodies, maxRows, 1);
    scratch = aligned_alloc(16, (size + 15) & ~(size_t)15);
    memset(scratch, 0, size);
}

static void endStep(void) {
    MdtKeaCacheDestroy(s.cache);
    free(scratch);
}

/* Along x. */
static MdtKeaRow *addRow(int a, int b) {
    MdtKeaRow *row = &s.rows[s.numRows++];
    ck_assert_int_le(s.numRows, s.maxRows);
    memset(row, 0, sizeof *row);
    row->body[0] = a;
    row->body[1] = b;
    row->J[0].lin[0] = 1;
    row->J[1].lin[0] = b < 0 ? 0 : -1;
    row->lower = -HUGE_VAL;
    row->upper = HUGE_VAL;
    row->normal = row->partner = row->contact = -1;
    row->owner = s.numRows;
    return row;
}

static MdtKeaRow *addContact(int a, int b) {
    MdtKeaRow *row = addRow(a, b);
    row->contact = s.numRows - 1;
    row->lower = 0;
    return row;
}

/* Passes of a step in which a motor accelerates a body by `times` what its load would, as it did in the last step. */
static int passesAtAcceleration(double times) {
    beginStep(1, 1);
    body[0].force[0] = 1 / h;
    body[0].acceleration[0] = times / h;
    MdtKeaInit(&s, scratch);
    MdtKeaRow *row = addRow(0, MdtKeaWORLD);
    row->target = times;
    row->force = (times - 1) / h;
    MdtKeaSolve(&s);
    const int passes = s.report.passes;
    endStep();
    return passes;
}

TEST(an_acceleration_goes_on_up_to_thirty_loads) {
    ck_assert_int_eq(passesAtAcceleration(25), 0);
    ck_assert_int_gt(passesAtAcceleration(40), 0);
}

/* What turns a body of the midpoint rule costs beside its moment of 2 kg m², where a joint pulls at an arm: of that
 * stiffness, in moments. */
static double stiffnessOf(double share) {
    beginStep(1, 1);
    MdtKeaInit(&s, scratch);
    MdtKeaRow *row = addRow(0, MdtKeaWORLD);
    row->position = METRUE;
    row->arm[0][0] = 1;
    s.work->problem.numBodies = s.work->problem.numRows = 1;
    kea_beginBodies(&s);
    kea_beginRows(&s);
    kea_guessMotion(&s);
    kea_moveBodies(&s);
    s.work->problem.row[0].p = share * 2 / (0.5 * h);
    kea_linearizeBodies(&s);
    const double moment = s.work->problem.metric[0].angular[1][1];
    endStep();
    return moment / 2 - 1;
}

/* Below a hundredth it is left out, and below minus a half it is taken away. */
TEST(stiffness_counts_where_it_is_felt_and_harmless) {
    ck_assert(stiffnessOf(0.007) == 0);
    assert_near(stiffnessOf(0.014), 0.014, 1e-12);
    assert_near(stiffnessOf(-0.4), -0.4, 1e-12);
    ck_assert(stiffnessOf(-0.7) == 0);
}

/* The part of a load of 1 N s that a joint, or two that share it, do not bear; of the two, of what they bore together.
 * */
static double unborne(int joints) {
    double sum = 0;
    beginStep(1, joints);
    body[0].force[0] = 1 / h;
    MdtKeaInit(&s, scratch);
    for (int i = 0; i < joints; i++)
        addRow(0, MdtKeaWORLD)->position = METRUE;
    MdtKeaSolve(&s);
    ck_assert(MdtKeaIntegrate(&s));
    for (int i = 0; i < joints; i++)
        sum += h * s.rows[i].force;
    endStep();
    return joints == 1 ? 1 + sum : 1 + sum - body[0].velocity[0];
}

TEST(rigid_joints_are_soft_by_rounding) {
    assert_near(unborne(1), 1e-13, 0.3e-13);
    assert_near(unborne(2), 0.5e-12, 0.15e-12);
}

/* Passes of a step in which a body meets a contact with that speed, where a load across it gives 1 m/s. */
static int passesAfterMeeting(double speed) {
    beginStep(1, 1);
    body[0].force[1] = 1 / h;
    body[0].velocity[0] = -speed;
    MdtKeaInit(&s, scratch);
    addContact(0, MdtKeaWORLD);
    MdtKeaSolve(&s);
    const int passes = s.report.passes;
    endStep();
    return passes;
}

/* 1.1e-9 m/s are tolerated, with a tenth of the body's own speed. */
TEST(the_first_pass_leaves_a_ten_thousandth_of_a_contact) {
    ck_assert_int_eq(passesAfterMeeting(0.8e-5), 1);
    ck_assert_int_eq(passesAfterMeeting(1.5e-5), 2);
}

/* Displacements along x, of all rows. */
static void MEAPI displacements(void *context, const MdtKeaTransformation poses[], double errors[]) {
    (void)context;
    for (int i = 0; i < s.numRows; i++)
        errors[i] = poses[0].pos[0] - body[0].position[0];
}

/* Whether two joints conflict that disagree by so much, in m, at a body 1 m from the origin. */
static MeBool doConflict(double difference) {
    beginStep(1, 2);
    body[0].position[0] = 1;
    s.errors = displacements;
    MdtKeaInit(&s, scratch);
    for (int i = 0; i < 2; i++)
        addRow(0, MdtKeaWORLD)->position = METRUE;
    s.rows[0].target = difference / h;
    MdtKeaSolve(&s);
    const MeBool isConflicting = s.report.conflicting;
    endStep();
    return isConflicting;
}

/* By half of that each, they miss their aims: 5e-7 of the distance is what places in single precision may be wrong by.
 * */
TEST(joints_may_disagree_by_the_rounding_of_places) {
    ck_assert(!doConflict(0.8e-6) && doConflict(1.4e-6));
}

/* Passes of a step in which a joint is to move a body that far, in m, a thousand kilometres from the origin. */
static int passesFarAway(double way) {
    beginStep(1, 1);
    body[0].position[0] = 1e6;
    s.errors = displacements;
    MdtKeaInit(&s, scratch);
    MdtKeaRow *row = addRow(0, MdtKeaWORLD);
    row->position = METRUE;
    row->target = way / h;
    MdtKeaSolve(&s);
    const int passes = s.report.passes;
    endStep();
    return passes;
}

TEST(far_places_are_known_to_fourteen_digits) {
    ck_assert_int_eq(passesFarAway(0.7e-8), 0);
    ck_assert_int_gt(passesFarAway(1.4e-8), 0);
}

/* A joint that each pass brings nearer, but by 1e-6 of the way only, once the first one has brought it up to `short`
 * of that: passes add up, and none converges. */
static double shortOf;
static void MEAPI reluctant(void *context, const MdtKeaTransformation poses[], double errors[]) {
    const double way = poses[0].pos[0] - body[0].position[0], knee = h * (1 - shortOf);
    (void)context;
    errors[0] = way < knee ? way : knee + 1e-6 * (way - knee);
}

/* The way that it goes, in those that it was to go. */
static double wayOfReluctant(double part) {
    shortOf = part;
    beginStep(1, 1);
    s.errors = reluctant;
    MdtKeaInit(&s, scratch);
    MdtKeaRow *row = addRow(0, MdtKeaWORLD);
    row->position = METRUE;
    row->target = 1;
    MdtKeaSolve(&s);
    ck_assert(s.report.capped);
    ck_assert(MdtKeaIntegrate(&s));
    endStep();
    return body[0].position[0] / h;
}

/* An answer that was not found is let go of if it has ten times the energy of what the rows ask for: 3.2 times the
 * speed. */
TEST(a_runaway_has_ten_times_the_energy) {
    assert_near(wayOfReluctant(0.026), 1 + 63 * 0.026, 1e-3);
    ck_assert(wayOfReluctant(0.04) == 0);
}

/* A joint that does not feel how its body turns: each pass turns it further. */
static void MEAPI unmoved(void *context, const MdtKeaTransformation poses[], double errors[]) {
    (void)context, (void)poses;
    errors[0] = 0;
}

/* At half a turn, with many times the energy that the row asks for, there is no way back. */
TEST(a_runaway_ends_the_passes) {
    beginStep(1, 1);
    s.errors = unmoved;
    MdtKeaInit(&s, scratch);
    MdtKeaRow *row = addRow(0, MdtKeaWORLD);
    memset(row->J, 0, sizeof row->J);
    row->J[0].ang[0] = 1;
    row->position = METRUE;
    row->target = 0.5 / h;
    MdtKeaSolve(&s);
    ck_assert(s.report.capped);
    ck_assert_int_le(s.report.passes, 8);
    endStep();
}

/* ---- work ---- */

TEST(work_is_counted_in_multiplications) {
    beginStep(2, 1);
    MdtKeaInit(&s, scratch);
    addContact(0, MdtKeaWORLD)->error = 1;
    s.parameters.timed = METRUE;
    MdtKeaSolve(&s);
    ck_assert(s.report.least == 8 * 256 * 3);
    ck_assert(s.report.work == 32 * 3); /* all contacts are open: it flies */
    endStep();
    begin(2, 3);
    measure();
    const double factor = kea_factorFlops(q.factor) + 2. * (double)kea_factorEntries(q.factor);
    ck_assert(kea_problemIterationWork(&q, MEFALSE) == factor + 3 * (108 + 8 * 32));
    end();
}

/* ---- contacts in time ---- */

/* The velocity after an impact, where a load gives -1 m/s a step, or something else in the partition flies. */
static double reboundOf(double speed, double load, double flight) {
    beginStep(2, 1);
    body[0].velocity[0] = -speed;
    body[0].force[0] = -load / h;
    body[1].velocity[1] = flight;
    MdtKeaInit(&s, scratch);
    s.parameters.timed = METRUE;
    addContact(0, MdtKeaWORLD)->restitution = 1;
    MdtKeaImpact(&s);
    endStep();
    return body[0].velocity[0];
}

TEST(half_of_a_steps_loads_do_not_rebound) {
    assert_near(reboundOf(0.45, 1, 0), 0, 1e-11);
    assert_near(reboundOf(0.55, 1, 0), 0.55, 1e-11);
    assert_near(reboundOf(0.45e-6, 0, 1), 0, 1e-11); /* without loads, of a millionth of the speed */
    assert_near(reboundOf(0.55e-6, 0, 1), 0.55e-6, 1e-11);
}

static int iterationsOf(double speed, double flight) {
    reboundOf(speed, 0, flight);
    return s.report.iterations;
}

/* Its passes leave 1e-4, 1e-9 and 1e-15 of twice the speed, until that is 1e-12 of the greatest there is. */
TEST(impacts_are_solved_to_twelve_digits) {
    ck_assert_int_eq(iterationsOf(0.35e-3, 1), 2);
    ck_assert_int_eq(iterationsOf(0.7e-3, 1), 3);
}

/* The velocity of the last of so many balls in a row that touch, after the first has hit with 1 m/s. */
static double lastOfCradle(int n) {
    beginStep(n, n);
    body[0].velocity[0] = 1;
    MdtKeaInit(&s, scratch);
    s.parameters.timed = METRUE;
    for (int i = 0; i + 1 < n; i++)
        addContact(i + 1, i)->restitution = 1;
    MdtKeaImpact(&s);
    endStep();
    return body[n - 1].velocity[0];
}

/* A round takes it one ball on. */
TEST(an_impact_has_sixty_rounds) {
    assert_near(lastOfCradle(60), 1, 1e-9);
    assert_below(lastOfCradle(64), 0.9);
}

/* A wall that comes with u gives 4 u of the energy: of more than 1e-12 that would be gained, none is. */
static double gainAt(double u) {
    beginStep(1, 1);
    body[0].velocity[0] = -1;
    MdtKeaInit(&s, scratch);
    s.parameters.timed = METRUE;
    MdtKeaRow *row = addContact(0, MdtKeaWORLD);
    row->restitution = 1;
    row->drift = row->target = u;
    MdtKeaImpact(&s);
    endStep();
    return 2 * (body[0].velocity[0] - 1);
}

TEST(energy_is_known_to_twelve_digits) {
    assert_near(gainAt(0.7e-12 / 4), 0.7e-12, 0.1e-12);
    assert_near(gainAt(1.4e-12 / 4), 0, 0.1e-12);
}

TEST(a_gap_that_counts_as_none) {
    const double gap = TOL(1e-5, 1e-7); /* of the radius of gyration, which is 1 */
    beginStep(1, 1);
    MdtKeaInit(&s, scratch);
    MdtKeaRow *row = addContact(0, MdtKeaWORLD);
    row->error = 0.7 * gap;
    ck_assert(kea_isTouching(&s, row));
    row->error = 1.4 * gap;
    ck_assert(!kea_isTouching(&s, row));
    endStep();
}

/* Does something that slides stop, where the friction at the end is that part less than its bound? */
static MeBool doesStop(double less) {
    MeBool mustRepeat;
    beginStep(1, 2);
    body[0].velocity[1] = 1;
    MdtKeaInit(&s, scratch);
    s.parameters.timed = METRUE;
    addContact(0, MdtKeaWORLD);
    MdtKeaRow *row = addRow(0, MdtKeaWORLD);
    row->J[0].lin[0] = 0;
    row->J[0].lin[1] = 1;
    row->contact = row->normal = 0;
    row->friction = 0.5;
    kea_beginBodies(&s);
    kea_markOpenContacts(&s);
    kea_beginRows(&s);
    s.work->problem.row[0].p = 1;
    s.work->problem.row[1].p = -0.5 * (1 - less);
    s.work->body[0].endVelocity[0] = 0;
    s.work->body[0].endVelocity[1] = 0.5;
    kea_firstEvent(&s, &mustRepeat);
    endStep();
    return mustRepeat;
}

TEST(friction_below_its_bound_by_rounding_slides) {
    ck_assert(!doesStop(0.7e-7) && doesStop(1.4e-7));
}

/* Does the place of a spinning ball's contact move, if the centre of its sphere is that far from the body's? */
static MeBool doesContactMove(double off) {
    MdtKeaManifold m;
    memset(&m, 0, sizeof m);
    m.body[1] = MdtKeaWORLD;
    m.numPoints = 1;
    m.normal[1] = m.direction[0] = m.radius[0] = 1;
    m.point[0].position[0] = off;
    m.point[0].position[1] = -1;
    beginStep(1, 1);
    body[0].angularMomentum[2] = 1;
    MdtKeaInit(&s, scratch);
    s.manifolds = &m;
    s.numManifolds = 1;
    ck_assert_int_eq(MdtKeaCountContactRows(&s), 1);
    MdtKeaMakeContactRows(&s);
    const MeBool moves = s.rows[0].moves;
    endStep();
    return moves;
}

TEST(a_ball_whose_centre_is_off_by_a_millionth_moves) {
    ck_assert(!doesContactMove(0.7e-6) && doesContactMove(1.4e-6));
}

/* The rebound of a body that meets something with that speed, where its load changes that by 1 m/s. */
static double reboundInStep(double speed) {
    const KeaApproach a = {.rate = -speed, .predicted = -speed - 1};
    s.parameters.stepsize = h;
    return kea_reboundInStep(&s, &a, 0, 0.5, 0);
}

TEST(one_steps_own_acceleration_is_no_blow) {
    ck_assert(reboundInStep(1.05) == 0);
    assert_near(reboundInStep(1.15), 0.575, 1e-12);
}

/* By how much a body's orientation is off after it has turned for that angle, against a thousand steps. */
static double turnError(double angle) {
    const double inertia[3][3] = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, L[3] = {1, 2, 3};
    double once[4], many[4] = {1, 0, 0, 0}, off = 0;
    MdtKeaBody b = body[0];
    memset(&b, 0, sizeof b);
    b.quaternion[0] = b.invMass = 1;
    b.flags = MdtKeaBodyFlagAddCoriolisForce;
    ck_assert(MdtKeaBodySetInertia(&b, inertia));
    const double t = angle / (keaLength(L) * (0.5 + 1. / 6)); /* by the splitting's rates, 1/I - 1/2 */
    kea_rotateFree(&b, b.quaternion, L, t, once);
    for (int i = 0; i < 1000; i++)
        kea_rotateFree(&b, many, L, t / 1000, many);
    for (int k = 0; k < 4; k++)
        off = fmax(off, fabs(once[k] - many[k]));
    return off;
}

TEST(rotation_beyond_a_hundredth_of_a_radian_is_of_fourth_order) {
    assert_below(1e-10, turnError(0.7e-2));
    assert_below(turnError(1.4e-2), 1e-12);
}

/* Are a matrix's own axes taken for its eigenvectors, with that part of its diagonal beside it? */
static MeBool isDiagonal(double part) {
    const double beside = part * sqrt(1 + 4 + 9);
    double S[3][3] = {{1, beside, 0}, {beside, 2, 0}, {0, 0, 3}}, V[3][3];
    kea_eigen(S, V);
    return V[0][1] == 0;
}

TEST(an_off_diagonal_of_rounding_is_none) {
    ck_assert(isDiagonal(0.8e-16) && !isDiagonal(1.2e-16));
}

/* ---- friction that does not settle ---- */

/* A slide that is forced to go on, at a rod whose friction presses it to the ground more than it is pressed: no force
 * is the answer (Painlevé's paradox). The load gives that speed, and another body 1 m/s. */
static void solveParadox(double speed, double maxWork) {
    beginStep(2, 2);
    body[0].force[1] = -speed / h;
    body[1].force[0] = 1 / h;
    s.parameters.maxWork = maxWork;
    MdtKeaInit(&s, scratch);
    for (int i = 0; i < 2; i++) {
        const double arm[3] = {2, -2, 0}, direction[3] = {i, !i, 0};
        MdtKeaRow *row = i ? addRow(0, MdtKeaWORLD) : addContact(0, MdtKeaWORLD);
        keaCopy(row->J[0].lin, direction);
        keaCross(row->J[0].ang, arm, direction);
        if (i) {
            row->contact = row->normal = 0;
            row->friction = 2;
            row->isForced = METRUE;
            row->forced = -1;
        }
    }
    MdtKeaSolve(&s);
    endStep();
}

/* After 60 passes, or 12 where the answer is good enough by then; and four follow. */
TEST(friction_bounds_that_do_not_settle_are_frozen) {
    solveParadox(1, 0);
    ck_assert(s.report.freezes == 4 && s.report.passes == 60 + 4 && !s.report.limited);
    solveParadox(1e-6, 0);
    ck_assert(s.report.passes == 60 + 4 && s.report.freezes == 60 + 4 - 12);
}

/* Three eighths of the work may go on them. */
TEST(friction_bounds_that_do_not_settle_cost_part_of_the_work) {
    solveParadox(1, 0);
    const double whole = s.report.work / 0.375;
    solveParadox(1, 1.3 * whole);
    ck_assert(s.report.passes == 60 + 4 && !s.report.limited);
    solveParadox(1, whole / 1.3);
    ck_assert(s.report.passes < 60 && s.report.limited);
}

/* ---- joints that are kept open ---- */

static void MEAPI closing(void *context, const MdtKeaTransformation poses[], double errors[]) {
    (void)context;
    errors[0] = s.rows[0].error + 0.1 * (poses[0].pos[0] - poses[1].pos[0]);
}

/* The speed per metre with which two bodies take away a joint's error, beside one that rests on the ground. The joint
 * counts a tenth of their way, so that they move by five times the speed at which it closes. */
static double closingSpeed(double error) {
    beginStep(3, 2);
    body[2].force[0] = -1 / h;
    MdtKeaInit(&s, scratch);
    MdtKeaRow *row = addRow(0, 1);
    row->J[0].lin[0] = 0.1;
    row->J[1].lin[0] = -0.1;
    row->position = METRUE;
    row->error = error;
    row->target = -error / h;
    addContact(2, MdtKeaWORLD);
    s.errors = closing;
    MdtKeaSolve(&s);
    ck_assert(MdtKeaIntegrate(&s));
    endStep();
    return body[1].velocity[0] / error;
}

/* Beyond 1e-5 of a body's size, what contacts may keep open closes with the energy of the speed that it asks for. */
TEST(open_joints_close_calmly_among_contacts) {
    assert_near_rel(closingSpeed(0.7e-5), closingSpeed(0.1e-5), 1e-6);
    assert_below(closingSpeed(1.4e-5), 0.5 * closingSpeed(0.1e-5));
}

/* ---- counted work ----
 *
 * What only steers cost is seen in the number of iterations, which is the same on every machine. One that is lower for
 * a better method is right, too. */

static unsigned long long state;

static double uniform(double low, double high) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return low + (high - low) * (double)(state >> 11) / 9007199254740992.0;
}

/* Rows of a contact at random points of two bodies, with a cone where it rubs. */
static void addRandomContact(int a, int b, double friction) {
    const int normal = s.numRows;
    double arm[2][3];
    for (int k = 0; k < 6; k++)
        arm[k / 3][k % 3] = uniform(-1, 1);
    for (int k = 0; k < (friction > 0 ? 3 : 1); k++) {
        MdtKeaRow *row = addRow(a, b);
        for (int side = 0; side < 2; side++) {
            const double sign = side ? -1 : 1, direction[3] = {sign * (k == 0), sign * (k == 1), sign * (k == 2)};
            keaCopy(row->J[side].lin, direction);
            keaCross(row->J[side].ang, arm[side], direction);
        }
        row->contact = normal;
        row->lower = k ? -HUGE_VAL : 0;
        row->normal = k ? normal : -1;
        row->partner = k ? normal + 3 - k : -1;
        row->friction = friction;
    }
}

/* Bodies that fly about and press on the ground, each other, and in a ring of joints. */
static void beginHeap(unsigned seed, int numBodies, int numContacts, int numJoints, double friction) {
    state = seed * 7919;
    beginStep(numBodies, numJoints + 3 * numContacts);
    for (int i = 0; i < numBodies; i++) {
        body[i].invMass = 1 / uniform(0.1, 3);
        for (int k = 0; k < 3; k++) {
            body[i].force[k] = (uniform(-1, 1) - (k == 0)) / h;
            body[i].velocity[k] = uniform(-1, 1);
        }
    }
    MdtKeaInit(&s, scratch);
    for (int i = 0; i < numJoints; i++)
        addRow(i, i + 1)->position = METRUE;
    for (int i = 0; i < numContacts; i++) {
        const int a = i < numBodies ? i : (int)uniform(0, numBodies);
        const int b = i < numBodies ? i - 1 : (int)uniform(0, numBodies);
        addRandomContact(a, a == b ? MdtKeaWORLD : b, friction);
    }
}

TEST(iterations_of_steps) {
    int contacts = 0, friction = 0, jointed = 0, passes = 0;
    for (unsigned seed = 1; seed <= 60; seed++) {
        for (int k = 0; k < 3; k++) {
            beginHeap(seed, 6, 14, k == 2 ? 4 : 0, k ? 0.5 : 0);
            MdtKeaSolve(&s);
            *(k == 0 ? &contacts : k == 1 ? &friction : &jointed) += s.report.iterations;
            passes += k == 2 ? s.report.passes : 0;
            endStep();
        }
    }
    ck_assert_int_eq(contacts, 483);
    ck_assert_int_eq(friction, 1474);
    ck_assert_int_eq(jointed, 1679);
    ck_assert_int_eq(passes, 273);
}

TEST(iterations_of_impacts) {
    int iterations = 0;
    for (unsigned seed = 1; seed <= 100; seed++) {
        beginHeap(seed, 4, 8, 0, 0.8);
        s.parameters.timed = METRUE;
        MdtKeaImpact(&s);
        iterations += s.report.iterations;
        endStep();
    }
    ck_assert_int_eq(iterations, 1874);
}

/* A body that is all but at rest lies on four contacts beside one that hits the ground. */
static int iterationsBeside(double speed) {
    int iterations = 0;
    for (unsigned seed = 1; seed <= 100; seed++) {
        state = seed * 7919;
        beginStep(2, 3 * 5);
        body[0].velocity[0] = -1;
        for (int k = 0; k < 3; k++)
            body[1].velocity[k] = speed * uniform(-1, 1);
        MdtKeaInit(&s, scratch);
        for (int i = 0; i < 5; i++)
            addRandomContact(i > 0, MdtKeaWORLD, 0.8);
        s.parameters.timed = METRUE;
        MdtKeaImpact(&s);
        iterations += s.report.iterations;
        endStep();
    }
    return iterations;
}

/* 14 times as many where each body was solved for to ten digits of its own speed. */
TEST(what_all_but_rests_beside_an_impact_is_not_solved_for) {
    ck_assert_int_le(iterationsBeside(1e-20), iterationsBeside(0));
    ck_assert_int_gt(iterationsBeside(1e-3), iterationsBeside(0));
}

/* Rows of four bodies, bounded on one side or on both; tolerances are as coarse as 1e-4 of the impulses, so that most
 * solves end where they make little progress. */
static int iterationsOfBounded(unsigned seed) {
    state = seed * 104729;
    begin(4, 24);
    for (int b = 0; b < 4; b++) {
        q.scale[b] = 1e6;
        for (int k = 0; k < 6; k++)
            q.load[b][k] = uniform(-1, 1);
    }
    for (int i = 0; i < q.numRows; i++) {
        q.row[i].body[0] = (int)uniform(0, 4);
        for (int k = 0; k < 6; k++)
            q.row[i].J[0][k] = uniform(-1, 1);
        q.row[i].lower = i % 2 ? 0 : -uniform(0.02, 0.5);
        q.row[i].upper = i % 2 ? HUGE_VAL : uniform(0.02, 0.5);
        q.row[i].r = uniform(-1, 1);
        q.row[i].N = i % 3 == 0 ? 1e-5 : i % 3 == 1 ? 1e-2 : 1;
    }
    measure();
    ck_assert(kea_problemSolve(&q, METRUE));
    end();
    return q.counts.iterations;
}

/* Contacts with friction, eight of four bodies. */
static int iterationsOfFriction(unsigned seed, double scale, int *found) {
    state = seed * 104729;
    begin(4, 24);
    for (int b = 0; b < 4; b++) {
        q.scale[b] = scale;
        for (int k = 0; k < 6; k++)
            q.load[b][k] = uniform(-1, 1);
    }
    for (int i = 0; i < q.numRows; i++) {
        KeaProblemRow *row = &q.row[i], *normal = &q.row[i - i % 3];
        row->body[0] = i % 3 ? normal->body[0] : (int)uniform(0, 4);
        for (int k = 0; k < 6; k++)
            row->J[0][k] = uniform(-1, 1);
        row->lower = i % 3 ? -HUGE_VAL : 0;
        row->normal = i % 3 ? i - i % 3 : -1;
        row->partner = i % 3 ? i - i % 3 + 3 - i % 3 : -1;
        row->friction = i % 3 ? uniform(0.2, 1) : 0;
        row->frictionBound = 1;
        row->r = uniform(-1, 1);
        row->N = 1e-6;
    }
    measure();
    *found += kea_problemSolve(&q, METRUE);
    end();
    return q.counts.iterations;
}

TEST(iterations_of_solves) {
    int bounded = 0, friction = 0, found = 0, near = 0;
    for (unsigned seed = 1; seed <= 100; seed++) {
        bounded += iterationsOfBounded(seed);
        friction += iterationsOfFriction(seed, 1, &found);
        iterationsOfFriction(seed, 1e7, &near); /* tolerances of a thousandth: solves end near kea_coupledRounding */
    }
    ck_assert_int_eq(bounded, 336);
    ck_assert_int_eq(friction, 2063);
    ck_assert_int_eq(found, 28);
    ck_assert_int_eq(near, 44);
}

/* A step on the way to where two rows let go, far beyond what their stiffness tells: at 32 and 64 times the first step
 * the slope is that of one of them, and it goes on from there. */
TEST(a_line_search_looks_sixty_four_steps_ahead) {
    begin(1, 2);
    q.scale[0] = 1e9; /* one iteration */
    q.load[0][0] = -1;
    for (int i = 0; i < 2; i++) {
        q.row[i].lower = i ? -0.3 : -0.2;
        q.row[i].upper = HUGE_VAL;
    }
    measure();
    q.row[0].N = 1e-3;
    q.row[1].N = 0.3;
    ck_assert(kea_problemSolve(&q, METRUE));
    const double step = 1 / (1 + 1 / 1e-3 + 1 / 0.3);
    const double low = 32 * step * (1 + 1 / 0.3) - 0.8, high = 64 * step - 0.5 + fmin(0, 64 * step / 0.3 - 0.3);
    assert_near(q.d[0][0], 32 * step * (1 + low / (low - high)), 1e-9);
    end();
}

/* When one iteration is all there is, sweeps come next: they end once the residual is below 1e-5 of the speed. */
TEST(sweeps_end_a_digit_below_what_is_reported) {
    int near = 0;
    for (unsigned seed = 1; seed <= 1000; seed++) {
        beginHeap(seed, 6, 10, 0, 0);
        s.parameters.maxIterations = 1;
        MdtKeaSolve(&s);
        const double residual = s.report.residual / s.report.resolution * 1e-9;
        if (s.report.passes == 1) {
            ck_assert_msg(residual <= 1e-5, "seed %u: %g", seed, residual);
            near += residual > 0.5e-5;
        }
        endStep();
    }
    ck_assert_int_gt(near, 0);
}

/* So many passes of sweeps share the work, where it is enough for each to have eight, but not for a matrix. */
TEST(sweeps_leave_work_for_eight_passes) {
    beginHeap(1, 40, 400, 0, 0);
    s.parameters.maxWork = 5e6;
    MdtKeaSolve(&s);
    ck_assert(s.report.limited && s.report.iterations == 0);
    ck_assert_int_eq(s.report.passes, 8);
    endStep();
}

/* The speed with which the first two of three balls in a row that touch leave each other, after the first has hit with
 * 1 m/s. They part with e, the second hits the third, and is met by the first once more, with (1 - e)²/4. */
static double partAgain(double restitution) {
    beginStep(3, 3);
    body[0].velocity[0] = 1;
    MdtKeaInit(&s, scratch);
    s.parameters.timed = METRUE;
    for (int i = 0; i < 2; i++)
        addContact(i + 1, i)->restitution = restitution;
    MdtKeaImpact(&s);
    endStep();
    return body[1].velocity[0] - body[0].velocity[0];
}

TEST(rounds_end_at_a_fiftieth_of_the_first_rebound) {
    const double faster = 1 - sqrt(4 * 0.03), slower = 1 - sqrt(4 * 0.015);
    assert_near(partAgain(faster), faster * 0.03, 1e-12);
    assert_near(partAgain(slower), 0, 1e-12);
}
