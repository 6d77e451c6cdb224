/* Kea as its clients have it: a system filled by hand, through the public header only. */
#include "MeMemory.h"
#include "random_numbers.h"
#include "system.h"

enum { SCENE_BODIES = 12, MAX_ROWS = 80, MAX_BALLS = 12 };

/* ---- a client ---- */

/* Joins a point of body a with one of body b (or the world): three position rows, the first ones of the system. */
typedef struct {
    int a, b;
    double arm[2][3]; /* in the bodies, or the world */
} Ball;

static Ball balls[MAX_BALLS];
static int numBalls;
static double epsilon;

static void pointOf(const MdtKeaTransformation poses[], int at, const double arm[3], double point[3]) {
    keaCopy(point, arm);
    if (at < 0)
        return;
    keaApply(point, (const double(*)[3])poses[at].R, arm);
    keaAddScaled(point, 1, poses[at].pos);
}

static void MEAPI ballErrors(void *context, const MdtKeaTransformation poses[], double errors[]) {
    (void)context;
    for (int k = 0; k < numBalls; k++) {
        const Ball *joint = &balls[k];
        double a[3], b[3];
        pointOf(poses, joint->a, joint->arm[0], a);
        pointOf(poses, joint->b, joint->arm[1], b);
        keaSubtract(errors + 3 * k, a, b);
    }
}

static void MEAPI ballJacobians(void *context, const MdtKeaTransformation poses[]) {
    (void)context;
    for (int i = 0; i < 3 * numBalls; i++) {
        const Ball *joint = &balls[i / 3];
        MdtKeaRow *row = &s.rows[i];
        for (int k = 0; k < 2; k++) {
            double direction[3] = {0};
            if (row->body[k] < 0)
                continue;
            direction[i % 3] = k ? -1 : 1;
            keaApply(row->arm[k], (const double(*)[3])poses[row->body[k]].R, joint->arm[k]);
            keaCopy(row->J[k].lin, direction);
            keaCross(row->J[k].ang, row->arm[k], direction);
        }
    }
}

static void beginIn(int garbage, int numBodies, int maxRows, double stepsize) {
    system_beginIn(garbage, numBodies, maxRows, 0, stepsize);
    s.parameters.gamma = 0.2;
    numBalls = 0;
    epsilon = 0;
}

static void begin(int numBodies, int maxRows, double stepsize) {
    beginIn(0, numBodies, maxRows, stepsize);
}

static void randomBody(int i) {
    const double mass = exp(uniform(-1, 1));
    double G[3][3], tensor[3][3], q[4], w[3];
    MdtKeaBody *b = &body[i];
    for (int k = 0; k < 9; k++)
        G[k / 3][k % 3] = uniform(-0.4, 0.4);
    for (int k = 0; k < 9; k++)
        tensor[k / 3][k % 3] = mass * ((k % 4 == 0 ? 0.1 : 0) + keaDot(G[k / 3], G[k % 3]));
    for (int k = 0; k < 4; k++)
        q[k] = uniform(-1, 1);
    keaQuaternionNormalize(q);
    memcpy(b->quaternion, q, sizeof q);
    b->invMass = 1 / mass;
    b->flags = MdtKeaBodyFlagAddCoriolisForce | MdtKeaBodyFlagIsNonSpherical;
    ck_assert(MdtKeaBodySetInertia(b, (const double(*)[3])tensor));
    for (int k = 0; k < 3; k++) {
        b->position[k] = uniform(-2, 2);
        b->velocity[k] = uniform(-1, 1);
        b->force[k] = mass * (uniform(-1, 1) - (k == 1 ? 10 : 0));
        b->torque[k] = 0.1 * mass * uniform(-1, 1);
        w[k] = uniform(-2, 2);
    }
    MdtKeaBodySetAngularVelocity(b, w);
}

/* A ball joint that fits but for `gap`. */
static void addBall(int a, int b, double gap) {
    Ball *joint = &balls[numBalls++];
    double point[3], R[3][3];
    s.errors = ballErrors;
    s.jacobians = ballJacobians;
    joint->a = a;
    joint->b = b;
    for (int k = 0; k < 3; k++)
        joint->arm[0][k] = uniform(-0.7, 0.7);
    keaQuaternionToMatrix(R, body[a].quaternion);
    keaApply(point, (const double(*)[3])R, joint->arm[0]);
    keaAddScaled(point, 1, body[a].position);
    for (int k = 0; k < 3; k++)
        point[k] += uniform(-gap, gap);
    keaCopy(joint->arm[1], point);
    if (b >= 0) {
        keaSubtract(point, point, body[b].position);
        keaQuaternionToMatrix(R, body[b].quaternion);
        keaApplyTransposed(joint->arm[1], (const double(*)[3])R, point);
    }
}

static void init(void) {
    system_init();
    for (int i = 0; i < 3 * numBalls; i++) {
        MdtKeaRow *row = addRow(balls[i / 3].a, balls[i / 3].b);
        row->position = METRUE;
        row->owner = -1 - i / 3;
        row->softness = epsilon;
    }
    double errors[3 * MAX_BALLS];
    ballErrors(NULL, s.pose, errors);
    ballJacobians(NULL, s.pose);
    for (int i = 0; i < 3 * numBalls; i++) {
        s.rows[i].error = errors[i];
        s.rows[i].target = -s.parameters.gamma * errors[i] / s.parameters.stepsize;
    }
}

static void randomJacobian(MdtKeaRow *row) {
    for (int k = 0; k < 2; k++) {
        double direction[3] = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
        for (int c = 0; c < 3; c++)
            row->arm[k][c] = uniform(-0.5, 0.5);
        if (k)
            keaScale(direction, -1, row->J[0].lin);
        keaCopy(row->J[k].lin, direction);
        keaCross(row->J[k].ang, row->arm[k], direction);
    }
}

/* A normal row and two of friction, of body a against b or the world. */
static void addContact(int a, int b, double gap) {
    static const double axes[3][3] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
    const int normal = s.numRows;
    const double h = s.parameters.stepsize, mu = uniform(0.1, 0.8), arm[3] = {uniform(-0.3, 0.3), -0.5, 0.2};
    const MeBool isCone = below(2);
    for (int i = 0; i < 3; i++) {
        MdtKeaRow *row = addRow(a, b);
        for (int k = 0; k < 2 && row->body[k] >= 0; k++) {
            keaScale(row->J[k].lin, k ? -1 : 1, axes[i]);
            keaScale(row->arm[k], k ? -1 : 1, arm);
            keaCross(row->J[k].ang, row->arm[k], row->J[k].lin);
        }
        row->contact = normal;
        row->owner = normal;
        row->normal = i ? normal : -1;
        row->partner = i && isCone ? normal + 3 - i : -1;
        row->friction = i ? mu : 0;
    }
    s.rows[normal].lower = 0;
    s.rows[normal].error = gap;
    s.rows[normal].target = -(gap > 0 ? 1 : s.parameters.gamma) * gap / h;
    s.rows[normal].softness = 1e-4;
}

/* Everything there is: joints in trees and loops, motors, springs, stops, contacts. */
static void randomScene(int garbage) {
    const int n = 1 + below(SCENE_BODIES), joints = below(MAX_BALLS + 1);
    beginIn(garbage, n, MAX_ROWS, uniform(0.002, 0.03));
    epsilon = below(2) ? 0 : 1e-4;
    for (int i = 0; i < n; i++)
        randomBody(i);
    for (int i = 0; i < joints; i++) {
        const int a = below(n), b = below(n);
        addBall(a, a == b ? MdtKeaWORLD : b, below(3) ? 0 : 0.05);
    }
}

static void fillRandomRows(void) {
    const int n = s.numBodies, others = below(8), contacts = below(6);
    init();
    for (int i = 0; i < others; i++) {
        const int a = below(n), b = below(n), kind = below(3);
        MdtKeaRow *row = addRow(a, a == b ? MdtKeaWORLD : b);
        randomJacobian(row);
        if (row->body[1] < 0)
            memset(&row->J[1], 0, sizeof row->J[1]);
        row->target = kind == 1 ? 0 : uniform(-1, 1);
        row->softness = below(2) ? uniform(0, 0.1) : 0;
        row->lower = kind == 0 ? -uniform(0, 20) : -HUGE_VAL;
        row->upper = kind == 0 ? uniform(0, 20) : HUGE_VAL;
        row->spring = kind == 1;
        row->error = uniform(-0.2, 0.2);
        row->stiffness = uniform(0, 400);
        row->damping = uniform(0, 5);
    }
    for (int i = 0; i < contacts; i++) {
        const int a = below(n), b = below(n);
        addContact(a, a == b ? MdtKeaWORLD : b, uniform(-0.01, 0.02));
    }
}

static double rateOf(const MdtKeaRow *row) {
    double rate = 0;
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            rate += keaDot(row->J[k].lin, s.velocity[row->body[k]].lin) +
                    keaDot(row->J[k].ang, s.velocity[row->body[k]].ang);
    return rate;
}

/* J M⁻¹ Jᵀ: what an impulse of 1 N s does to the row's velocity. */
static double inverseMassOf(const MdtKeaRow *row) {
    double sum = 0, turn[3];
    for (int k = 0; k < 2; k++) {
        if (row->body[k] < 0)
            continue;
        keaApply(turn, (const double(*)[3])s.invMass[row->body[k]].inertia, row->J[k].ang);
        sum += s.invMass[row->body[k]].mass * keaDot(row->J[k].lin, row->J[k].lin) + keaDot(row->J[k].ang, turn);
    }
    return sum;
}

/* ---- rows ---- */

TEST(two_bodies_share_an_impulse) {
    begin(2, 1, 0.1);
    setBody(0, 1, 1, 0);
    setBody(1, 3, 1, 1);
    body[0].velocity[0] = 4;
    init();
    MdtKeaRow *row = addAlongX(0, 1);
    MdtKeaSolve(&s);
    ck_assert(body[0].velocity[0] == 4); /* the bodies are only read */
    ck_assert(MdtKeaIntegrate(&s));
    assert_near(body[0].velocity[0], 1, 9e-14);
    assert_near(body[1].velocity[0], 1, 9e-14);
    assert_near(body[0].velocity[0] + 3 * body[1].velocity[0], 4, 1e-14);
    assert_near(row->force, -30, 3e-12);           /* 3 kg m/s in 0.1 s */
    assert_near(body[0].position[0], 0.25, 2e-13); /* with the mean of 4 and 1 m/s */
    assert_near(s.pose[1].pos[0], body[1].position[0], 0);
    assert_near(s.velocity[1].lin[0], body[1].velocity[0], 0);
    assert_near(s.report.resolution, 1e-9 * 2, 1e-20); /* the row has changed the mean relative velocity by 2 */
    ck_assert(s.report.residual <= s.report.resolution);
    end();
}

/* J v⁺ = s - h E λ, as exactly as Kea balances momenta, and v⁺ = v + h (f + Jᵀ λ)/m, whatever the row and the
 * bodies. */
TEST(velocity_rows_obey_their_law) {
    for (unsigned seed = 1; seed <= 60; seed++) {
        double start[6];
        state = seed;
        begin(2, 3, uniform(0.005, 0.03));
        randomBody(0);
        randomBody(1);
        init();
        for (int i = 0; i < 3; i++) {
            MdtKeaRow *row = addRow(i == 2 ? 1 : 0, i == 1 ? MdtKeaWORLD : i == 2 ? 0 : 1);
            randomJacobian(row);
            row->target = uniform(-2, 2);
            row->softness = i == 0 ? 0 : uniform(0, 5);
        }
        memcpy(start, body[0].velocity, sizeof body[0].velocity);
        memcpy(start + 3, body[0].angularMomentum, sizeof body[0].angularMomentum);
        const double h = s.parameters.stepsize;
        MdtKeaSolve(&s);
        ck_assert_msg(!s.report.capped, "seed %u", seed);
        double speed = 1;
        for (int i = 0; i < 3; i++)
            speed = keaMax(speed, h * fabs(s.rows[i].force) * inverseMassOf(&s.rows[i]));
        ck_assert(MdtKeaIntegrate(&s));
        for (int i = 0; i < 3; i++) {
            const MdtKeaRow *row = &s.rows[i];
            const double rate = rateOf(row), law = row->target - h * row->softness * row->force;
            ck_assert_msg(fabs(rate - law) < 1e-8 * speed, "seed %u, row %d: %.12g, not %.12g", seed, i, rate, law);
        }
        for (int c = 0; c < 3; c++) {
            double force = body[0].force[c], torque = body[0].torque[c];
            for (int i = 0; i < 3; i++)
                for (int k = 0; k < 2; k++)
                    if (s.rows[i].body[k] == 0) {
                        force += s.rows[i].force * s.rows[i].J[k].lin[c];
                        torque += s.rows[i].force * s.rows[i].J[k].ang[c];
                    }
            assert_near(body[0].velocity[c], start[c] + h * force * body[0].invMass, 3e-13);
            assert_near(body[0].angularMomentum[c], start[3 + c] + h * torque, 3e-13);
        }
        end();
    }
}

/* A body that turns, on springs and rows with bounds to the world, as a car on its wheels. Writes the forces and the
 * end velocities. */
static void solveCar(unsigned seed, MeBool isFixed, double answer[]) {
    enum { WHEELS = 4 };
    state = seed * 331;
    begin(1, 3 * WHEELS, uniform(0.005, 0.02));
    randomBody(0);
    init();
    for (int i = 0; i < 3 * WHEELS; i++) {
        MdtKeaRow *row = addRow(0, MdtKeaWORLD);
        randomJacobian(row);
        memset(&row->J[1], 0, sizeof row->J[1]);
        row->isFixed = isFixed;
        row->spring = i % 3 == 0;
        row->error = uniform(-0.1, 0.1);
        row->stiffness = uniform(50, 400);
        row->damping = uniform(0, 5);
        row->target = row->spring ? 0 : uniform(-1, 1);
        row->softness = row->spring ? 0 : uniform(0.05, 1);
        row->lower = row->spring ? 0 : -uniform(1, 20);
        row->upper = row->spring ? HUGE_VAL : uniform(1, 20);
    }
    MdtKeaSolve(&s);
    for (int i = 0; i < 3 * WHEELS; i++)
        answer[i] = s.rows[i].force;
    ck_assert(MdtKeaIntegrate(&s));
    keaCopy(answer + 3 * WHEELS, s.velocity[0].lin);
    keaCopy(answer + 3 * WHEELS + 3, s.velocity[0].ang);
}

/* Rows that are the same at all poses have the same answer whether Kea knows it or not: to the tolerance of velocities,
 * 1e-9 of their scale, over E of some .05. If it does, it factors less. */
TEST(fixed_rows_have_the_answer_of_others_by_fewer_factorizations) {
    int factorizations[2] = {0, 0};
    for (unsigned seed = 1; seed <= 60; seed++) {
        double answer[2][18];
        for (int k = 0; k < 2; k++) {
            solveCar(seed, k == 1, answer[k]);
            ck_assert_msg(!s.report.capped, "seed %u", seed);
            factorizations[k] += s.report.factorizations;
            end();
        }
        for (int i = 0; i < 18; i++)
            assert_near(answer[1][i], answer[0][i], i < 12 ? 4e-7 : 8e-9);
    }
    ck_assert_int_lt(3 * factorizations[1], 2 * factorizations[0]);
}

/* φ⁺ = φ + h (s - h E λ) where the bodies have arrived. */
static void assertPositionLaw(unsigned seed) {
    double errors[3 * MAX_BALLS];
    const double h = s.parameters.stepsize;
    ballErrors(NULL, s.pose, errors);
    for (int i = 0; i < 3 * numBalls; i++) {
        const MdtKeaRow *row = &s.rows[i];
        const double law = row->error + h * (row->target - h * row->softness * row->force);
        ck_assert_msg(fabs(errors[i] - law) < 1e-9, "seed %u, row %d: φ = %.15g, not %.15g", seed, i, errors[i], law);
    }
    assert_below(s.report.error, 1e-9);
}

static void chain(unsigned seed, double gap) {
    state = seed * 7919;
    begin(4, 12, uniform(0.005, 0.03));
    s.parameters.gamma = uniform(0.05, 1);
    for (int i = 0; i < 4; i++)
        randomBody(i);
    for (int i = 0; i < 4; i++)
        addBall(i, i - 1, gap);
}

/* However the bodies turn, and whatever is wrong at the start: s = -γ φ/h takes γ of it away. */
TEST(rigid_position_rows_obey_their_law) {
    for (unsigned seed = 1; seed <= 60; seed++) {
        chain(seed, 0.05);
        for (int i = 0; i < 3; i++) {
            init();
            MdtKeaSolve(&s);
            ck_assert_msg(!s.report.capped && !s.report.violent && !s.report.conflicting, "seed %u", seed);
            ck_assert(MdtKeaIntegrate(&s));
            assertPositionLaw(seed);
        }
        end();
    }
}

/* From rest, so that λ is the force of the motion alone: what the velocity stage adds to it does not move. */
TEST(soft_position_rows_obey_their_law) {
    int checked = 0;
    for (unsigned seed = 1; seed <= 60; seed++) {
        chain(seed, 0);
        epsilon = uniform(1e-4, 0.05);
        for (int i = 0; i < 4; i++) {
            keaZero(body[i].velocity);
            keaZero(body[i].angularMomentum);
        }
        for (int i = 0; i < 5; i++) {
            init();
            step();
            if (s.report.stages > 0)
                continue;
            assertPositionLaw(seed);
            checked++;
        }
        end();
    }
    ck_assert_msg(checked > 100, "%d steps without a velocity stage", checked);
}

/* A joint that gives way: 3 N hold back a body that 10 N pull. */
TEST(position_rows_give_way_at_their_bound) {
    begin(1, 1, 0.01);
    setBody(0, 2, 1, 0);
    for (int i = 0; i < 20; i++) {
        body[0].force[0] = 10;
        init();
        MdtKeaRow *row = addAlongX(0, MdtKeaWORLD);
        row->lower = -3;
        row->upper = 3;
        step();
        assert_near(row->force, -3, 3e-13);
    }
    assert_near(body[0].velocity[0], 0.2 * 7 / 2, 7e-14);
    end();
}

/* Forces are finite and within bounds in systems of every kind, where the answer is cut short too. */
TEST(forces_stay_within_bounds) {
    for (unsigned seed = 1; seed <= 200; seed++) {
        state = seed * 104729;
        randomScene(0);
        fillRandomRows();
        s.parameters.maxIterations = seed % 3 == 0 ? 1 : 0;
        MdtKeaSolve(&s);
        for (int i = 0; i < s.numRows; i++) {
            const MdtKeaRow *row = &s.rows[i];
            const double slack = 1e-9 * fabs(row->force);
            ck_assert_msg(isfinite(row->force) && row->force >= row->lower - slack && row->force <= row->upper + slack,
                          "seed %u, row %d: %g in [%g, %g]", seed, i, row->force, row->lower, row->upper);
            if (row->normal < 0 || s.report.capped || s.parameters.maxIterations > 0)
                continue;
            const double bound = row->friction * s.rows[row->normal].force;
            const double size = hypot(row->force, row->partner >= 0 ? s.rows[row->partner].force : 0);
            ck_assert_msg(size <= bound * (1 + 1e-6) + 1e-9, "seed %u, row %d: friction %g of %g", seed, i, size,
                          bound);
        }
        ck_assert_msg(MdtKeaIntegrate(&s), "seed %u", seed);
        end();
    }
}

/* ---- springs ---- */

/* A mass on a spring, one step, from x and v; the way and velocity after it. */
static void springStep(double stiffness, double damping, double rest, double h, double x[2]) {
    begin(1, 1, h);
    setBody(0, 2, 1, x[0]);
    body[0].velocity[0] = x[1];
    init();
    MdtKeaRow *row = addAlongX(0, MdtKeaWORLD);
    row->spring = METRUE;
    row->error = x[0];
    row->target = rest;
    row->stiffness = stiffness;
    row->damping = damping;
    step();
    x[0] = body[0].position[0];
    x[1] = body[0].velocity[0];
    end();
}

/* The midpoint rule: v⁺ = v - h (k (x + x⁺)/2 + d (v + v⁺)/2)/m, x⁺ = x + h (v + v⁺)/2. */
TEST(springs_follow_the_midpoint_rule) {
    for (unsigned seed = 1; seed <= 50; seed++) {
        state = seed;
        const double h = uniform(0.002, 0.05), m = 2, x0 = uniform(-1, 1), v0 = uniform(-1, 1);
        const double k = (seed == 1 ? 3.99 : uniform(0, 3.5)) * m / (h * h),
                     d = seed % 3 == 0 ? 0 : uniform(0, 2) * m / h;
        double x[2] = {x0, v0};
        springStep(k, d, 0, h, x);
        /* u = (v + v⁺)/2:  2 (u - v)/h = -(k (x + h u/2) + d u)/m */
        const double u = (2 * v0 / h - k * x0 / m) / (2 / h + k * h / (2 * m) + d / m);
        assert_near(x[0], x0 + h * u, 4e-13);
        assert_near(x[1], 2 * u - v0, 1e-12 / h);
        if (d == 0)
            assert_near_rel(k * x[0] * x[0] + m * x[1] * x[1], k * x0 * x0 + m * v0 * v0, 1e-12);
        else
            assert_below(k * x[0] * x[0] + m * x[1] * x[1], k * x0 * x0 + m * v0 * v0);
    }
}

/* Stiffer than h² k/m = 4: backward Euler, v⁺ = v - h (k x⁺ + d v⁺)/m. */
TEST(springs_too_stiff_are_damped) {
    for (unsigned seed = 1; seed <= 50; seed++) {
        state = seed;
        const double h = uniform(0.002, 0.05), m = 2, x0 = uniform(-1, 1), v0 = uniform(-1, 1);
        const double k = (seed == 1 ? 4.01 : uniform(4.5, 1e6)) * m / (h * h), d = uniform(0, 2) * m / h;
        double x[2] = {x0, v0};
        springStep(k, d, 0, h, x);
        const double v = (v0 - h * k * x0 / m) / (1 + h * h * k / m + h * d / m);
        assert_near_rel(x[1], v, 2e-12);
        assert_near(x[0], x0 + h * v, TOL(4e-11, 2e-12));
    }
}

/* A dashpot of h d / m above 2 stops the mass, and does not throw it back. */
TEST(strong_dashpots_do_not_ring) {
    for (double damping = .5; damping < 1e9; damping *= 3) {
        const double h = .01, m = 2;
        double x[2] = {0, 1};
        for (int i = 0; i < 4; i++)
            springStep(0, damping * m / h, 0, h, x);
        ck_assert(x[1] >= 0);
        assert_below(x[1], 1);
    }
}

/* ---- bodies without rows ---- */

/* ---- robustness ---- */

/* The guards are checked by end(): scratch memory is not left, whatever is in the system. */
TEST(scratch_memory_is_not_left) {
    for (unsigned seed = 1; seed <= 150; seed++) {
        state = seed * 15485863;
        randomScene(0x7f);
        s.parameters.timed = seed % 4 == 0;
        s.parameters.mayRefuse = seed % 3 == 0;
        for (int i = 0; i < 3; i++) {
            fillRandomRows();
            s.maxRows = MAX_ROWS;
            MdtKeaSolve(&s);
            ck_assert_msg(MdtKeaIntegrate(&s), "seed %u", seed);
        }
        end();
    }
}

/* No more room than rows: the arrays are not laid out larger than they were measured. */
TEST(scratch_of_exactly_that_many_rows) {
    for (int n = 1; n <= SCENE_BODIES; n++) {
        state = (unsigned)n;
        beginIn(0x7f, n, 3 * n, 0.01);
        for (int i = 0; i < n; i++)
            randomBody(i);
        for (int i = 0; i < n; i++)
            addBall(i, i - 1, 0);
        init();
        step();
        end();
    }
}

static MeBool isFiniteBody(const MdtKeaBody *b) {
    return isfinite(keaLength(b->position)) && isfinite(keaLength(b->velocity)) &&
           isfinite(keaLength(b->angularMomentum)) && isfinite(keaLength(b->quaternion) + b->quaternion[3]);
}

/* They do not get into the state of a body: the step is not taken, or it is, without them, and that is told. */
TEST(rows_that_are_not_numbers_spoil_nothing) {
    const double wrong[] = {NAN, HUGE_VAL};
    for (int where = 0; where < 12; where++) {
        MdtKeaBody before[2];
        const double value = wrong[where % 2];
        state = 11;
        begin(2, 4, 0.01);
        randomBody(0);
        randomBody(1);
        addBall(0, 1, 0.01);
        memcpy(before, body, sizeof before);
        init();
        s.jacobians = NULL;
        MdtKeaRow *row = addAlongX(1, MdtKeaWORLD);
        double *const victim[] = {&s.rows[1].target,      &row->target,   &row->J[0].ang[1],
                                  &s.rows[2].J[1].lin[0], &row->softness, &s.rows[0].error};
        *victim[where / 2] = value;
        MdtKeaSolve(&s);
        if (MdtKeaIntegrate(&s)) {
            ck_assert_msg(s.report.capped, "case %d", where);
            ck_assert_msg(isFiniteBody(&body[0]) && isFiniteBody(&body[1]), "case %d", where);
        } else {
            ck_assert_msg(memcmp(before, body, sizeof before) == 0, "case %d", where);
        }
        end();
    }
}

TEST(loads_that_are_not_numbers_move_nothing) {
    const double wrong[] = {NAN, HUGE_VAL};
    for (int where = 0; where < 8; where++) {
        MdtKeaBody before[2];
        state = 11;
        begin(2, 3, 0.01);
        randomBody(0);
        randomBody(1);
        if (where / 4)
            addBall(0, 1, 0.01);
        (where & 2 ? body[0].force : body[0].torque)[1] = wrong[where % 2];
        memcpy(before, body, sizeof before);
        init();
        MdtKeaSolve(&s);
        ck_assert_msg(!MdtKeaIntegrate(&s), "case %d", where);
        ck_assert_msg(memcmp(before, body, sizeof before) == 0, "case %d", where);
        end();
    }
}

/* A guess that is not a number is none; one that is wildly wrong is found out. */
TEST(a_bad_guess_does_no_harm) {
    const double wrong[] = {NAN, HUGE_VAL, -HUGE_VAL, 1e6};
    for (int where = 0; where < 4; where++) {
        state = 12;
        begin(2, 6, 0.01);
        randomBody(0);
        randomBody(1);
        addBall(0, 1, 0);
        addBall(1, MdtKeaWORLD, 0);
        init();
        for (int i = 0; i < 6; i++)
            s.rows[i].force = wrong[where];
        MdtKeaSolve(&s);
        ck_assert_msg(MdtKeaIntegrate(&s), "case %d", where);
        ck_assert_msg(s.report.error < 1e-9, "case %d: %g", where, s.report.error);
        end();
    }
}

static void *MEAPI noMemory(size_t bytes) {
    (void)bytes;
    return NULL;
}

/* Without memory for the matrices there is no answer, but a step all the same. */
TEST(lack_of_memory_leaves_finite_bodies) {
    state = 13;
    begin(2, 6, 0.01);
    randomBody(0);
    randomBody(1);
    addBall(0, 1, 0);
    addBall(1, MdtKeaWORLD, 0);
    init();
    const MeMemoryFuncPtrCreate real = MeMemoryAPI.create;
    MeMemoryAPI.create = noMemory;
    MdtKeaSolve(&s);
    MeMemoryAPI.create = real;
    ck_assert_int_ge(caught.fatal, 1);
    ck_assert(MdtKeaIntegrate(&s));
    for (int i = 0; i < 2; i++)
        ck_assert(isfinite(keaLength(body[i].position) + keaLength(body[i].velocity)));
    init(); /* and goes on once there is some */
    step();
    ck_assert_int_gt(s.report.factorizations, 0);
    end();
    messages_forget();
}

/* ---- the report ---- */

TEST(fast_tops_are_refused_if_they_may_be) {
    const double flat[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 2}}, w[3] = {0, 0, 100};
    for (int mayRefuse = 0; mayRefuse < 2; mayRefuse++) {
        state = 6;
        begin(1, 3, 0.02);
        setBody(0, 1, 1, 0);
        ck_assert(MdtKeaBodySetInertia(&body[0], flat));
        MdtKeaBodySetAngularVelocity(&body[0], w);
        addBall(0, MdtKeaWORLD, 0);
        init();
        s.parameters.mayRefuse = mayRefuse;
        const MdtKeaBody before = body[0];
        MdtKeaSolve(&s);
        ck_assert(memcmp(&before, &body[0], sizeof before) == 0);
        if (mayRefuse)
            ck_assert(s.report.violent && s.report.passes == 0);
        else
            ck_assert_int_gt(s.report.passes, 0);
        end();
    }
}

/* ---- impacts ---- */

/* Balls in a row along x that touch, rows between neighbours; the first is moving. */
static void cradle(int n, double restitution) {
    begin(n, n, 0.01);
    for (int i = 0; i < n; i++)
        setBody(i, 1, 0.4, i);
    body[0].velocity[0] = 3;
    init();
    s.parameters.timed = METRUE;
    for (int i = 0; i + 1 < n; i++) {
        MdtKeaRow *row = addAlongX(i + 1, i);
        row->contact = i;
        row->lower = 0;
        row->restitution = restitution;
    }
}

/* Does a body of 2 kg meet what a contact of that softness keeps it from, when it moves into it by `speed`, of what its
 * weight changes in a step? Others may hang about in the partition, and press on it. */
static MeBool meetsWith(double speed, double softness, double others) {
    const double g = 10, h = 0.01;
    begin(2, 1, h);
    setBody(0, 2, 1, 0);
    setBody(1, others, 1, 5);
    body[0].velocity[0] = speed * g * h;
    for (int i = 0; i < 2; i++)
        body[i].force[0] = g / body[i].invMass;
    init();
    s.parameters.timed = METRUE;
    MdtKeaRow *row = addRow(0, MdtKeaWORLD);
    row->J[0].lin[0] = -1;
    row->contact = 0;
    row->lower = 0;
    row->softness = softness;
    const MeBool meets = MdtKeaMeets(&s);
    end();
    return meets;
}

/* It gives way to the weight of all by v = h E m g, which is E m of what the weight changes in a step; to no more than
 * a twentieth. A hard one gives way to nothing but a millionth. */
TEST(giving_way_to_a_load_is_no_impact) {
    ck_assert(!meetsWith(0, 0, 3));
    ck_assert(!meetsWith(.75e-6, 0, 3));
    ck_assert(meetsWith(1.5e-6, 0, 3));
    ck_assert(!meetsWith(-1, 0, 3));
    for (int k = 0; k < 2; k++) {
        const double others = k ? 30 : 3, softness = 1e-3, gives = softness * (2 + others);
        ck_assert(!meetsWith(.99 * gives, softness, others));
        ck_assert(meetsWith(1.01 * gives, softness, others));
    }
    ck_assert(!meetsWith(.049, 1, 3));
    ck_assert(meetsWith(.051, 1, 3));
}

TEST(the_last_ball_of_a_cradle_leaves_alone) {
    cradle(5, 1);
    MdtKeaImpact(&s);
    for (int i = 0; i < 5; i++)
        assert_near(body[i].velocity[0], i == 4 ? 3 : 0, TOL(1e-6, 3e-13));
    end();
}

/* Three balls in a row that touch, of which the first hits with some m/s, and others elsewhere that move as they like.
 * Returns the work of the impact. */
static double hitAmong(int others, double speed) {
    MdtKeaBody before[SCENE_BODIES];
    begin(3 + others, 2, 0.01);
    for (int i = 0; i < 3; i++)
        setBody(i, 1, 0.4, i);
    body[0].velocity[0] = speed;
    state = 5;
    for (int i = 3; i < 3 + others; i++)
        randomBody(i);
    memcpy(before, body, sizeof before);
    init();
    s.parameters.timed = METRUE;
    for (int i = 0; i < 2; i++) {
        MdtKeaRow *row = addAlongX(i + 1, i);
        row->contact = i;
        row->lower = 0;
    }
    MdtKeaImpact(&s);
    for (int i = 0; i < 3; i++)
        assert_near(body[i].velocity[0], speed / 3, 1e-12); /* the third one, too, which nothing approached */
    for (int i = 3; i < 3 + others; i++)
        ck_assert_mem_eq(&body[i], &before[i], sizeof before[i]);
    const double work = s.report.work;
    end();
    return work;
}

TEST(impacts_leave_alone_what_they_do_not_reach) {
    const double work = hitAmong(0, 1);
    ck_assert(work > 0);
    ck_assert(hitAmong(1, 1) == work);
    ck_assert(hitAmong(8, 1) == work);
    ck_assert(hitAmong(8, 0) == 0);
}

/* Two bodies that spin meet, and one of them has a gap of .03 m to a third. Steps after the impact, with new rows or
 * with those from before it. Returns whether they flew. */
static MeBool stepAfterImpact(double restitution, MeBool renews) {
    begin(3, 2, 0.1);
    state = 17;
    for (int i = 0; i < 3; i++) {
        randomBody(i);
        for (int k = 0; k < 3; k++)
            body[i].velocity[k] = k == 0 && i == 0;
    }
    s.parameters.timed = METRUE;
    for (int round = 0; round < (renews ? 2 : 1); round++) {
        system_init();
        for (int i = 0; i < 2; i++) {
            MdtKeaRow *row = addAlongX(i + 1, i);
            row->contact = i;
            row->lower = 0;
            row->error = i * .03;
            row->restitution = restitution;
        }
        if (round == 0)
            MdtKeaImpact(&s);
    }
    const MeBool flies = MdtKeaFlies(&s);
    MdtKeaSolve(&s);
    ck_assert(s.report.ballistic == flies);
    ck_assert(MdtKeaIntegrate(&s));
    return flies;
}

TEST(rows_from_before_an_impact_will_do_for_what_flies) {
    MdtKeaBody before[3];
    ck_assert(stepAfterImpact(1, MEFALSE));
    memcpy(before, body, sizeof before);
    const double event = s.report.event;
    end();
    ck_assert(stepAfterImpact(1, METRUE));
    ck_assert_mem_eq(before, body, sizeof before);
    ck_assert(s.report.event == event && event < 0.1);
    ck_assert(body[1].velocity[0] > 0);
    end();
    ck_assert(!stepAfterImpact(0, METRUE));
    end();
}

static double kineticEnergyOf(const MdtKeaBody *b) {
    double w[3];
    MdtKeaBodyGetAngularVelocity(b, w);
    return .5 * (keaDot(b->velocity, b->velocity) / b->invMass + keaDot(w, b->angularMomentum));
}

/* A contact with the world at an arm, its normal up, with a friction cone. */
static void addTouch(const double arm[3], double friction, double restitution) {
    static const double direction[3][3] = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
    const int normal = s.numRows;
    for (int i = 0; i < 3; i++) {
        MdtKeaRow *row = addRow(0, MdtKeaWORLD);
        keaCopy(row->J[0].lin, direction[i]);
        keaCross(row->J[0].ang, arm, direction[i]);
        row->contact = normal;
        row->lower = i ? -HUGE_VAL : 0;
        row->restitution = restitution;
        row->normal = i ? normal : -1;
        row->partner = i ? normal + 3 - i : -1;
        row->friction = friction;
    }
}

/* A ball of r = .5 m and 1 kg that moves by 6 m/s along and falls by v; per unit of mass the impulse along is at most
 * mu (1 + e) v, and 6 * 2/7 where it comes to roll: 2/7 of the slip. */
static void bounceBall(double friction, double fall, double v[2]) {
    static const double below[3] = {0, -.5, 0};
    double w[3];
    begin(1, 3, 1. / 60);
    setBody(0, 1, .4 * .25, 0);
    body[0].velocity[0] = 6;
    body[0].velocity[1] = -fall;
    body[0].force[1] = -9.81;
    init();
    s.parameters.timed = METRUE;
    addTouch(below, friction, .8);
    MdtKeaImpact(&s);
    MdtKeaBodyGetAngularVelocity(&body[0], w);
    assert_near(body[0].velocity[1], .8 * fall, 1e-7);
    v[0] = body[0].velocity[0];
    v[1] = -w[2];
    end();
}

TEST(impacts_have_friction) {
    const double fall = sqrt(2 * 9.81 * 1.5);
    double v[2];
    bounceBall(.1, fall, v); /* it slides */
    assert_near(v[0], 6 - .1 * 1.8 * fall, 1e-7);
    assert_near(v[1], .1 * 1.8 * fall / (.4 * .5), 1e-7);
    bounceBall(.2, fall, v); /* it comes to roll: 4.2857 m/s and 8.5714 rad/s */
    assert_near(v[0], 6 * 5. / 7, 1e-7);
    assert_near(v[1], 6 * 5. / 7 / .5, 1e-7);
    bounceBall(0, fall, v);
    assert_near(v[0], 6, 1e-12);
    assert_near(v[1], 0, 1e-12);
}

/* Newton's law with friction can ask for energy that is not there (Kane's paradox): a slanted rod, or a box on some
 * corners. Then as much of the rebound is given as energy allows: none is gained, and in those cases none is lost. */
TEST(rebounds_with_friction_gain_no_energy) {
    int limited = 0;
    for (unsigned seed = 1; seed <= 2000; seed++) {
        state = seed * 7919;
        begin(1, 9, 1. / 60);
        setBody(0, 1, 1, 0);
        const double moment[3] = {uniform(.02, .3), uniform(.02, .3), uniform(.02, .3)};
        double tensor[3][3] = {{moment[0], 0, 0}, {0, moment[1], 0}, {0, 0, moment[2]}}, w[3];
        MdtKeaBodySetInertia(&body[0], (const double(*)[3])tensor);
        for (int k = 0; k < 3; k++) {
            body[0].velocity[k] = uniform(-5, 5) - (k == 1 ? 4 : 0);
            w[k] = uniform(-8, 8);
        }
        MdtKeaBodySetAngularVelocity(&body[0], w);
        init();
        s.parameters.timed = METRUE;
        for (int i = 0; i < 1 + (int)seed % 3; i++) {
            const double arm[3] = {uniform(-1, 1), uniform(-1, -.2), uniform(-1, 1)};
            addTouch(arm, uniform(.2, 1.5), uniform(.5, 1));
        }
        const double before = kineticEnergyOf(&body[0]);
        const MeBool meets = MdtKeaMeets(&s);
        MdtKeaImpact(&s);
        const double after = kineticEnergyOf(&body[0]);
        ck_assert_msg(after <= before * (1 + 1e-9), "seed %u: %.12g J, before %.12g", seed, after, before);
        limited += meets && after > before * (1 - 1e-9);
        end();
    }
    ck_assert_int_ge(limited, 20); /* of those that touch at several points, a restitution below 1 and friction */
}

/* ---- what has no answer ends ---- */

/* A joint that does not feel how its body turns: each pass turns it further, and at half a turn, with many times the
 * energy that the row asks for, there is no way back. */
static void MEAPI unmoved(void *context, const MdtKeaTransformation poses[], double errors[]) {
    (void)context, (void)poses;
    errors[0] = 0;
}

TEST(a_runaway_ends_the_passes) {
    begin(1, 1, 1. / 64);
    setBody(0, 1, 1, 0);
    init();
    s.errors = unmoved;
    MdtKeaRow *row = addRow(0, MdtKeaWORLD);
    row->J[0].ang[0] = 1;
    row->position = METRUE;
    row->target = 0.5 * 64;
    MdtKeaSolve(&s);
    ck_assert(s.report.capped);
    ck_assert_int_le(s.report.passes, 8);
    end();
}

/* A slide that is forced to go on, at a rod whose friction presses it to the ground more than it is pressed: no force
 * is the answer (Painlevé's paradox). Its bounds are frozen, or it ends with its work. */
TEST(friction_without_an_answer_ends) {
    double work = 0;
    for (int isShort = 0; isShort < 2; isShort++) {
        begin(1, 2, 1. / 64);
        setBody(0, 1, 1, 0);
        body[0].force[1] = -64;
        s.parameters.maxWork = isShort ? work / 2 : 0;
        init();
        for (int i = 0; i < 2; i++) {
            const double arm[3] = {2, -2, 0}, direction[3] = {i, !i, 0};
            MdtKeaRow *row = addRow(0, MdtKeaWORLD);
            keaCopy(row->J[0].lin, direction);
            keaCross(row->J[0].ang, arm, direction);
            row->lower = i ? -HUGE_VAL : 0;
            row->contact = 0;
            row->normal = i ? 0 : -1;
            row->friction = i ? 2 : 0;
            row->isForced = i;
            row->forced = -1;
        }
        MdtKeaSolve(&s);
        ck_assert_int_eq(s.report.limited, isShort);
        ck_assert_int_eq(s.report.freezes > 0, !isShort);
        ck_assert(!isShort || s.report.work <= s.parameters.maxWork);
        work = s.report.work;
        end();
    }
}

/* ---- the same again ---- */

/* Everything that a step leaves, of a few steps with a cache that has seen `others` graphs before. */
static void record(unsigned seed, int garbage, int others, MdtKeaBody bodies[], double forces[]) {
    state = 99;
    MdtKeaCache *cache = MdtKeaCacheCreate();
    for (int i = 0; i < others; i++) {
        randomScene(0);
        MdtKeaCache *own = s.cache;
        s.cache = cache;
        fillRandomRows();
        MdtKeaSolve(&s);
        s.cache = own;
        end();
    }
    state = seed * 32452843;
    randomScene(garbage);
    MdtKeaCacheDestroy(s.cache);
    s.cache = cache;
    for (int i = 0; i < 5; i++) {
        fillRandomRows();
        MdtKeaSolve(&s);
        ck_assert_msg(MdtKeaIntegrate(&s), "seed %u", seed);
    }
    memset(forces, 0, MAX_ROWS * sizeof *forces);
    memcpy(bodies, body, SCENE_BODIES * sizeof *body);
    for (int i = 0; i < s.numRows; i++)
        forces[i] = s.rows[i].force;
    end();
}

/* The same bits: twice, whatever was in the scratch memory, and whatever the cache has seen. */
#ifdef TEST_IS_SLOW
enum { SEEDS = 16 };
#else
enum { SEEDS = 40 };
#endif

TEST(steps_depend_on_the_system_alone) {
    for (unsigned seed = 1; seed <= SEEDS; seed++) {
        static MdtKeaBody a[SCENE_BODIES], b[SCENE_BODIES];
        double p[MAX_ROWS], q[MAX_ROWS];
        record(seed, 0, 0, a, p);
        record(seed, 0, 0, b, q);
        ck_assert_msg(memcmp(a, b, sizeof a) == 0 && memcmp(p, q, sizeof p) == 0, "twice, seed %u", seed);
        record(seed, 0x7f, 0, b, q);
        ck_assert_msg(memcmp(a, b, sizeof a) == 0 && memcmp(p, q, sizeof p) == 0, "scratch, seed %u", seed);
        record(seed, 0, seed % 8 == 0 ? 80 : 5, b, q);
        ck_assert_msg(memcmp(a, b, sizeof a) == 0 && memcmp(p, q, sizeof p) == 0, "cache, seed %u", seed);
    }
}

/* Each test has the same numbers, whichever ran before it. */
static void restartNumbers(void) {
    state = 1;
}
TEST_FIXTURE(restartNumbers, NULL)
