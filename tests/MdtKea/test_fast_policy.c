/* Choices of the fast solver (common/kea_policy_i.h) at work: each test meets its number from both sides, by less than
 * a factor of two, and fails when it is halved or doubled. Bodies are of 1 kg and 1 kg m², so that sizes are 1 m; y is
 * up, and loads give 1/8 m/s in a step. */
#include "common/kea_policy_i.h"
#include "fast/kea_regions_i.h"
#include "karma_test.h"
#include "kea_i.h"

enum { MAX_BODIES = 130, MAX_MANIFOLDS = 1600 };

static const double h = 1. / 64, gravity = 8, unit[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

static MdtKeaSystem s;
static MdtKeaBody body[MAX_BODIES], *pointer[MAX_BODIES];
static MdtKeaManifold manifold[MAX_MANIFOLDS];
static void *scratch;

/* Any residual is small enough, so that as few passes are taken as may be. */
static void begin(int numBodies, int numManifolds, int maxRows) {
    memset(&s, 0, sizeof s);
    memset(body, 0, sizeof body);
    memset(manifold, 0, sizeof manifold);
    for (int i = 0; i < numBodies; i++) {
        pointer[i] = &body[i];
        body[i].quaternion[0] = body[i].invMass = 1;
        ck_assert(MdtKeaBodySetInertia(&body[i], unit));
    }
    for (int i = 0; i < numManifolds; i++)
        manifold[i] =
            (MdtKeaManifold){.body = {0, MdtKeaWORLD}, .numPoints = 1, .normal = {0, 1, 0}, .direction = {1, 0, 0}};
    s.numBodies = numBodies;
    s.bodies = pointer;
    s.numManifolds = numManifolds;
    s.manifolds = manifold;
    s.maxRows = maxRows;
    s.cache = MdtKeaCacheCreate();
    s.parameters =
        (MdtKeaParameters){.stepsize = h, .gamma = 0.25, .softening = 1, .solver = MdtKeaSolverFast, .accuracy = 1e9};
    const size_t size = MdtKeaScratchSize(numBodies, maxRows, 0);
    scratch = aligned_alloc(16, (size + 15) & ~(size_t)15);
    memset(scratch, 0, size);
}

static void end(void) {
    MdtKeaCacheDestroy(s.cache);
    free(scratch);
}

static void solve(void) {
    MdtKeaSolve(&s);
    ck_assert(MdtKeaIntegrate(&s));
}

/* Along x, without bounds; after MdtKeaInit. */
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

/* ---- how many passes ---- */

/* A column that has just been put together; its bodies have these masses, from the ground up to the last one, kg. */
enum { COLUMN = 20 };
static void solveColumn(int count, double mass, double last, double accuracy) {
    begin(count, count, 0);
    for (int i = 0; i < count; i++) {
        const double m = i + 1 < count ? mass : last;
        body[i].invMass = 1 / m;
        body[i].force[1] = -gravity * m;
        body[i].position[1] = i + 0.5;
        manifold[i].body[0] = i;
        manifold[i].body[1] = i > 0 ? i - 1 : MdtKeaWORLD;
        manifold[i].point[0].position[1] = i;
    }
    s.parameters.accuracy = accuracy;
    MdtKeaInit(&s, scratch);
    solve();
    end();
}

/* Passes, by eight, until the residuals are small against their tolerances. */
TEST(passes_end_where_the_accuracy_is_met) {
    int before = KEA_MIN_PASSES;
    for (double accuracy = 1e-2; accuracy > 1e-6; accuracy *= 0.1) {
        solveColumn(4, 1, 1, accuracy);
        ck_assert_int_ge(s.report.iterations, before);
        ck_assert_int_eq(s.report.iterations % KEA_MORE_PASSES, 0);
        assert_below(s.report.excess, 1);
        before = s.report.iterations;
    }
    ck_assert_int_gt(before, KEA_MIN_PASSES);
}

/* A residual that is harmless between equal bodies is not under a load, nor where a light body carries a heavy one:
 * what passes cannot settle is told. */
TEST(loads_and_mass_ratios_ask_for_smaller_residuals) {
    solveColumn(2, 1, 1, 1e-3);
    assert_below(s.report.excess, 1);
    solveColumn(2, 1, 1e4, 1e-3);
    ck_assert_int_eq(s.report.iterations, KEA_MAX_PASSES);
    ck_assert_double_gt(s.report.excess, 10);
    solveColumn(COLUMN, 1, 1e3, 1e-3);
    ck_assert_double_gt(s.report.excess, 10);
}

/* Nesterov's sequence, theta' = (1 + sqrt(1 + 4 theta^2)) / 2. */
TEST(held_extrapolation_is_that_of_eight_passes) {
    double theta = 1;
    for (int i = 0; i < KEA_MORE_PASSES; i++)
        theta = .5 * (1 + sqrt(1 + 4 * theta * theta));
    assert_near(theta, kea_limitedTheta, 1e-3);
}

/* ---- work ---- */

/* Bodies on the ground, each with a manifold of its own: those share groups of eight. */
TEST(work_is_counted_by_visits_of_manifolds) {
    begin(20, 20, 0);
    for (int i = 0; i < 20; i++)
        manifold[i].body[0] = i;
    MdtKeaInit(&s, scratch);
    solve();
    end();
    /* passes over velocities and displacements; three groups */
    ck_assert(s.report.work == (16 + 6) * (3 * 8 * 300.) + 20 * 1200.);
}

/* m by which a body is lifted that lies on another, with overlaps of 1 mm between them and below. */
static double liftOfUpper(void) {
    begin(2, 2, 0);
    for (int i = 0; i < 2; i++) {
        body[i].position[1] = i;
        manifold[i].body[0] = i;
        manifold[i].body[1] = i - 1;
        manifold[i].point[0].position[1] = i - 0.5;
        manifold[i].point[0].depth = 1e-3;
    }
    MdtKeaInit(&s, scratch);
    solve();
    end();
    return body[1].position[1] - 1;
}

/* Of what is more than a ten thousandth, that a pass removes with gamma of a quarter. */
static const double sharePerPass = 0.189422168068;

/* Six passes of Gauss-Seidel, each of which removes a share of what is more than a ten thousandth. */
TEST(six_passes_push_bodies_apart) {
    const double share = sharePerPass, max = 0.9e-3;
    double low = 0, high = 0;
    for (int pass = 0; pass < 6; pass++) {
        low += share * (max - low);
        const double apart = 0.5 * share * (max - (high - low));
        low -= apart;
        high += apart;
    }
    assert_near_rel(liftOfUpper(), high, 1e-5);
}

/* ---- joints ---- */

static double error0, errorRatio; /* of the first round, and of each to the one before */
static int rounds, turns;

static void MEAPI errorsOfRounds(void *context, const MdtKeaTransformation poses[], double errors[]) {
    (void)context;
    (void)poses;
    for (int i = 0; i < s.numRows; i++)
        errors[i] = error0 * pow(errorRatio, rounds);
    rounds++;
}

static void MEAPI countTurns(void *context, const MdtKeaTransformation poses[]) {
    (void)context;
    (void)poses;
    turns++;
}

/* A joint with such errors, m or rad, whatever is done about them, and a contact with that overlap. */
static void beginJointAt(double error, double ratio, double overlap) {
    begin(1, overlap > 0, 1);
    manifold[0].point[0].depth = overlap;
    error0 = error;
    errorRatio = ratio;
    rounds = turns = 0;
    s.errors = errorsOfRounds;
    s.jacobians = countTurns;
    MdtKeaInit(&s, scratch);
    addRow(0, MdtKeaWORLD)->position = METRUE;
}

static void beginJoint(double error, double ratio) {
    beginJointAt(error, ratio, 0);
}

static int roundsAt(double error, double ratio, double overlap) {
    beginJointAt(error, ratio, overlap);
    solve();
    end();
    return rounds;
}

/* One round, and a look at what contacts have done; or eight. */
TEST(joints_are_closed_at_three_millionths) {
    ck_assert_int_eq(roundsAt(2e-6, 1, 0), 1);
    ck_assert_int_eq(roundsAt(2e-6, 1, .1), 1 + 1);
    ck_assert_int_eq(roundsAt(4e-6, 1, 0), 8);
}

/* Closed after four: contacts have nothing left to do, which would want one more. */
TEST(contacts_take_part_in_three_rounds_of_joints) {
    ck_assert_int_eq(roundsAt(1e-2, .1, .1), 4 + 1);
}

/* The error of a joint at the end, whose bodies have the size 1, and at the start. */
static MeBool isViolent(double after, double before) {
    beginJoint(after, 1);
    s.rows[0].error = before;
    MdtKeaSolve(&s);
    end();
    return s.report.violent;
}

TEST(a_step_that_opens_joints_by_a_twentieth_is_violent) {
    ck_assert(!isViolent(.04, 0));
    ck_assert(isViolent(.06, 0));
    ck_assert(!isViolent(.56, .52));
}

static int turnsAt(double ratio) {
    beginJoint(1, ratio);
    solve();
    end();
    return turns;
}

/* A round is to leave a tenth. */
TEST(rounds_that_gain_no_digit_have_new_derivatives) {
    ck_assert_int_eq(turnsAt(0.08), 0);
    ck_assert_int_gt(turnsAt(0.13), 0);
}

/* Rad that the rounds turn a body by, of which each is asked for so much. */
static double turnedBy(double error) {
    beginJoint(error, 1);
    s.rows[0].J[0] = (MdtKeaJBlock){{0}, {0, 0, 1}};
    solve();
    end();
    return -2 * atan2(body[0].quaternion[3], body[0].quaternion[0]);
}

/* Three rounds of two passes each, then five of one, which turn by a tenth at most. */
TEST(a_pass_turns_by_a_tenth_of_a_radian) {
    assert_near(turnedBy(0.08), 8 * 0.08, 1e-5);
    assert_near(turnedBy(0.15), 3 * 0.15 + 5 * 0.1, 1e-5);
}

/* The part of its speed that a row lacks after one pass, about an axis of a body that is thinner than double precision
 * can tell beside the stiffness of a rigid joint. */
static double lackOfThinBody(void) {
    begin(1, 0, 1);
    body[0].moments[2] = 1e-11;
    body[0].quaternion[0] = cos(0.4);
    body[0].quaternion[1] = sin(0.4);
    s.parameters.maxIterations = 1;
    MdtKeaInit(&s, scratch);
    MdtKeaRow *row = addRow(0, MdtKeaWORLD);
    row->J[0] = (MdtKeaJBlock){{0}, {0, s.pose[0].R[1][1], s.pose[0].R[2][1]}};
    row->target = 1;
    solve();
    end();
    return s.report.residual;
}

TEST(joints_of_thin_bodies_are_softer_by_half_of_the_decades) {
    assert_near_rel(lackOfThinBody(), 1e-3, 1e-2);
}

/* m/s of the first body of a chain of n, which a motor of 1 m/s drives, after one pass. */
static double speedOfDriven(int n) {
    begin(n, 0, n);
    s.parameters.maxIterations = 1;
    MdtKeaInit(&s, scratch);
    MdtKeaRow *motor = addRow(0, MdtKeaWORLD);
    motor->target = 1;
    motor->lower = -1e6;
    motor->upper = 1e6;
    for (int i = 1; i < n; i++)
        addRow(i, i - 1);
    solve();
    end();
    return body[0].velocity[0];
}

/* It is driven with the response of the whole block, or with that of the first body alone. */
TEST(motors_feel_a_block_of_up_to_128_bodies) {
    assert_near(speedOfDriven(127), 1, 1e-3);
    assert_near(speedOfDriven(129), 1. / 129, 1e-3);
}

/* ---- contacts ---- */

/* Two points that are so far apart, m, on a body that turns about its centre as easily as it moves: the determinant of
 * their coupling, of the product of its diagonal, is the square of that. */
static MeBool areSolvedAtOnce(double apart) {
    static KeaGroup g;
    memset(&g, 0, sizeof g);
    g.normal.y[0] = g.along.x[0] = 1;
    g.invMass[0][0] = 1;
    g.invInertia[0][0][0] = g.invInertia[0][3][0] = g.invInertia[0][5][0] = 1;
    for (int k = 0; k < 2; k++) {
        g.isPoint[k][0] = -1;
        g.x[k][0] = (float)(k == 0 ? -apart / 2 : apart / 2);
    }
    kea_kernel.prepare(&g, 1, (float)h);
    return g.isDirect[0] != 0;
}

TEST(a_determinant_of_a_ten_thousandth_is_inverted) {
    ck_assert(!areSolvedAtOnce(sqrt(0.7e-4)));
    ck_assert(areSolvedAtOnce(sqrt(1.4e-4)));
}

/* m/s by which overlaps are said to grow, of a body that falls with 1 m/s and is so deep at the end of the step. */
static double growthAt(double depth) {
    static KeaGroup g;
    static KeaMotion motion[2];
    static const float change[2];
    const KeaTolerance tolerance = {.change = change, .accuracy = 1, .stepsize = (float)h};
    KeaMeasure measure;
    memset(&measure, 0, sizeof measure);
    memset(&g, 0, sizeof g);
    g.normal.y[0] = g.along.x[0] = 1;
    g.body[0][0] = 1;
    g.size[0] = 1;
    g.isPoint[0][0] = -1;
    g.response[0][0] = 1;
    g.gap[0][0] = (float)(h - depth);
    motion[1].lin[1] = -1;
    kea_kernel.measure(&g, 1, motion, &tolerance, &measure);
    return (double)measure.closing[0];
}

TEST(an_overlap_of_a_tenth_is_deep) {
    ck_assert(growthAt(0.08) == 0);
    ck_assert(growthAt(0.15) == 1);
}

/* m by which a body that rests with that overlap is lifted in a step. */
static double liftAt(double depth) {
    begin(1, 1, 0);
    manifold[0].point[0].depth = depth;
    MdtKeaInit(&s, scratch);
    solve();
    end();
    return body[0].position[1];
}

/* Six passes lift it by what they remove of what is more than a ten thousandth of its size. */
TEST(overlaps_of_a_ten_thousandth_rest) {
    ck_assert(liftAt(0.8e-4) == 0);
    assert_near(liftAt(1.6e-4), (1 - pow(1 - sharePerPass, 6)) * 0.6e-4, 1e-10);
}

/* m/s with which a contact, or a joint, of that compliance gives way to a load. */
static double yieldOfContact(double epsilon) {
    begin(1, 1, 0);
    body[0].force[1] = -gravity;
    s.parameters.epsilon = epsilon;
    MdtKeaInit(&s, scratch);
    solve();
    end();
    return -body[0].velocity[1];
}
static double yieldOfJoint(double epsilon) {
    begin(1, 0, 1);
    body[0].force[0] = gravity;
    MdtKeaInit(&s, scratch);
    MdtKeaRow *row = addRow(0, MdtKeaWORLD);
    row->position = METRUE;
    row->softness = epsilon;
    solve();
    end();
    return body[0].velocity[0];
}

/* E p of the impulse p that leaves it that velocity; below a thousandth of the mobility it counts as a sag. */
TEST(a_thousandth_of_the_mobility_is_soft) {
    const double soft = 1.6e-3, yield = gravity * h * soft / (1 + soft);
    assert_near(yieldOfContact(0.8e-3), 0, 1e-7);
    assert_near(yieldOfContact(soft), yield, 1e-7);
    assert_near(yieldOfJoint(0.8e-3), 0, 1e-7);
    assert_near(yieldOfJoint(soft), yield, 1e-7);
}

/* m/s with which a ball leaves the ground that meets it with 1 m/s, where restitution gives it that part more: twice
 * that part is the energy gained. */
static double reboundWith(double more) {
    begin(1, 1, 0);
    body[0].velocity[1] = -1;
    manifold[0].surface.restitution = 1 + more;
    MdtKeaInit(&s, scratch);
    solve();
    end();
    return body[0].velocity[1];
}

TEST(a_hundred_thousandth_of_the_energy_may_be_gained) {
    assert_near(reboundWith(0.4e-5) - 1, 0.4e-5, 2e-7);
    assert_near(reboundWith(0.7e-5) - 1, 0, 2e-7);
}

/* m/s along the ground, with friction without bound, of a body that these forces, N, pull along it and press on it. */
static double speedOfHeld(double along, double down) {
    begin(1, 1, 0);
    body[0].force[0] = along;
    body[0].force[1] = -down;
    manifold[0].surface.coefficient[0] = manifold[0].surface.coefficient[1] = HUGE_VAL;
    MdtKeaInit(&s, scratch);
    solve();
    end();
    return body[0].velocity[0];
}

/* It holds with any load, and not without one. The bound is the largest power of two whose products are finite. */
TEST(friction_without_bound_is_bounded_by_single_precision) {
    const volatile float bound = (float)kea_maxBound;
    assert_near(speedOfHeld(gravity, 1e-6 * gravity), 0, 1e-7);
    assert_near(speedOfHeld(gravity, -gravity), gravity * h, 1e-7);
    ck_assert(isfinite(bound * bound + bound) && !isfinite(2 * bound * 2 * bound));
}

/* ---- workers ---- */

static int regionsOf(int manifolds) {
    static KeaNode nodes[KEA_MAX_NODES];
    static KeaRegions regions = {.node = nodes};
    begin(16, manifolds, 0);
    for (int i = 0; i < 16; i++)
        body[i].position[0] = i;
    for (int i = 0; i < manifolds; i++)
        manifold[i].body[0] = i % 16;
    MdtKeaInit(&s, scratch);
    KeaArena arena = {NULL, 0};
    kea_regionsLayOut(&s, &regions, &arena);
    char *memory = aligned_alloc(64, (arena.used + 63) & ~(size_t)63);
    arena = (KeaArena){memory, 0};
    kea_regionsLayOut(&s, &regions, &arena);
    kea_regionsDivide(&s, &regions);
    free(memory);
    end();
    return regions.count;
}

TEST(regions_have_four_hundred_manifolds) {
    ck_assert_int_eq(regionsOf(799), 1);
    ck_assert_int_eq(regionsOf(800), 2);
    ck_assert_int_eq(regionsOf(1599), 2);
    ck_assert_int_eq(regionsOf(1600), 4);
}

/* A worker that never comes: the calling thread does all items. */
static void *MEAPI enqueueNothing(MeTaskCB task, void *taskContext, void *userContext) {
    *(MeTaskCB *)userContext = task;
    return taskContext;
}
static void MEAPI callTask(void *taskContext, void *userContext) {
    (*(MeTaskCB *)userContext)(taskContext);
}

static void MEAPI noteItems(const MeTeamNews *news, void *watchContext) {
    if (news->event == MeTeamLoopBegins)
        *(int *)watchContext = news->number;
}

/* Items of a loop over so many bodies. */
static int itemsOf(int bodies) {
    MeTaskCB task = NULL;
    int items = 1; /* of which loops are not told */
    MeTeam *team = MeTeamCreate(2, enqueueNothing, callTask, &task, "itemsOf");
    MeTeamWatch(team, noteItems, &items);
    begin(bodies, 0, 0);
    s.team = team;
    MeTeamOpen(team);
    MdtKeaInit(&s, scratch);
    MeTeamClose(team);
    end();
    MeTeamDestroy(team);
    return items;
}

TEST(a_worker_takes_sixty_four_bodies_at_a_time) {
    ck_assert_int_eq(itemsOf(64), 1);
    ck_assert_int_eq(itemsOf(65), 2);
}
