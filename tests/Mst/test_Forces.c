/* Forces that a program computes from the state of its bodies: springs, dampers, thrusters by hand. */
#include "Mst.h"
#include "karma_test.h"

/* A box of 1 t and 1 m on a spring and a damper of the program's. */
typedef enum Way {
    FREE,     /* in space, */
    MOVING,   /* the spring's other end moves along with it, across and along */
    SLIDING,  /* on a floor without friction */
    IN_CROWD, /* the same, by the fast solver */
    GUIDED,   /* on a slider, with gravity */
    HINGED,   /* 2 m below a hinge, pushed at its centre */
    TWISTED,  /* a torsion spring */
    WAYS
} Way;

typedef struct Oscillator {
    MstUniverseID u;
    MdtBodyID b;
    Way way;
    double w, ratio, h; /* rad/s; of damping; s */
    double mass;        /* kg, or kg m² */
    double start;       /* m, or rad */
} Oscillator;

static const double drift = 3; /* m/s, of what moves */

static void placeAt(Oscillator *o, double angle, double x, double y) {
    MdtBodySetPosition(o->b, x, y, o->way == SLIDING || o->way == IN_CROWD ? (MeReal).5 : 0);
    MdtBodySetQuaternion(o->b, cos(angle / 2), 0, 0, sin(angle / 2));
}

static void addFloor(MstUniverseID u, McdFrameworkID frame) {
    static MeMatrix4 tm;
    MeMatrix4TMMakeIdentity(tm);
    MstFixedModelCreate(u, McdPlaneCreate(frame), tm);
    MdtContactParamsSetSurface(MstBridgeGetContactParams(MstUniverseGetBridge(u), 0, 0), 0, 0);
}

static void addSlider(MdtWorldID w, MdtBodyID b) {
    MdtPrismaticID p = MdtPrismaticCreate(w);
    MdtPrismaticSetBodies(p, b, 0);
    MdtPrismaticSetAxis(p, 1, 0, 0);
    MdtPrismaticEnable(p);
}

static void addHinge(MdtWorldID w, MdtBodyID b) {
    MdtHingeID j = MdtHingeCreate(w);
    MdtHingeSetBodies(j, b, 0);
    MdtHingeSetPosition(j, 0, 0, 0);
    MdtHingeSetAxis(j, 0, 0, 1);
    MdtHingeEnable(j);
}

static Oscillator oscillator(Way way, double wh, double ratio, double h, int subSteps) {
    Oscillator o = {.way = way, .w = wh / h, .ratio = ratio, .h = h};
    o.u = MstUniverseCreate(&MstUniverseGrowingSizes);
    MdtWorldID w = MstUniverseGetWorld(o.u);
    McdFrameworkID frame = MstUniverseGetFramework(o.u);
    MdtWorldSetAutoDisable(w, 0);
    MdtWorldSetSubSteps(w, subSteps);
    MdtWorldSetSolver(w, way == IN_CROWD ? MdtSolverFast : MdtSolverExact);
    MdtWorldSetGravity(w, 0, 0, way == SLIDING || way == IN_CROWD || way == GUIDED ? (MeReal)-9.8 : 0);
    o.b = McdModelGetBody(MstModelAndBodyCreate(o.u, McdBoxCreate(frame, 1, 1, 1), 1000));
    const double m = 1000, moment = m / 6, arm = 2;
    o.mass = way == TWISTED ? moment : way == HINGED ? m * arm * arm + moment : m;
    o.start = way == TWISTED || way == HINGED ? .1 : 1;
    placeAt(&o, way == TWISTED || way == HINGED ? o.start : 0,
            way == HINGED    ? arm * sin(o.start)
            : way == TWISTED ? 0
                             : o.start,
            way == HINGED ? -arm * cos(o.start) : 0);
    if (way == MOVING)
        MdtBodySetLinearVelocity(o.b, drift, 2 * drift, 0);
    if (way == SLIDING || way == IN_CROWD)
        addFloor(o.u, frame);
    if (way == GUIDED)
        addSlider(w, o.b);
    if (way == HINGED)
        addHinge(w, o.b);
    return o;
}

/* Displacement and its rate, at the time t. */
static void look(const Oscillator *o, double t, double *x, double *v) {
    MeVector3 p, velocity;
    MeVector4 q;
    MdtBodyGetPosition(o->b, p);
    MdtBodyGetQuaternion(o->b, q);
    MdtBodyGetLinearVelocity(o->b, velocity);
    *x = (double)p[0] - (o->way == MOVING ? drift * t : 0);
    *v = (double)velocity[0] - (o->way == MOVING ? drift : 0);
    if (o->way != HINGED && o->way != TWISTED)
        return;
    MdtBodyGetAngularVelocity(o->b, velocity);
    *x = 2 * atan2(q[3], q[0]);
    *v = (double)velocity[2];
}

static void push(const Oscillator *o, double t) {
    double x, v;
    look(o, t, &x, &v);
    const double f = -o->mass * o->w * (o->w * x + 2 * o->ratio * v);
    if (o->way == TWISTED)
        MdtBodyAddTorque(o->b, 0, 0, f);
    else if (o->way == HINGED)
        MdtBodyAddForce(o->b, f / 2 * cos(x), f / 2 * sin(x), 0);
    else
        MdtBodyAddForce(o->b, f, 0, 0);
}

/* What a linear oscillator that is let go at rest does not exceed. */
static double envelope(double w, double ratio, double t) {
    return ratio < 1 ? exp(-ratio * w * t) / sqrt(1 - ratio * ratio) : (1 + w * t) * exp(-w * t);
}

typedef struct Swing {
    double first, last; /* the largest displacement of the first second and of the tenth, */
    double excess;      /* and the most by which it exceeded the envelope; of its start */
} Swing;

static Swing swing(Way way, double wh, double ratio, double h, int subSteps) {
    Oscillator o = oscillator(way, wh, ratio, h, subSteps);
    Swing s = {0, 0, 0};
    const int second = (int)(1 / h + .5);
    for (int i = 0; i < 10 * second; i++) {
        double x, v;
        push(&o, i * h);
        MstUniverseStep(o.u, h);
        look(&o, (i + 1) * h, &x, &v);
        x = fabs(x) / o.start;
        s.first = i < second ? fmax(s.first, x) : s.first;
        s.last = i >= 9 * second ? fmax(s.last, x) : s.last;
        s.excess = fmax(s.excess, x - envelope(o.w, ratio, (i + 1) * h));
    }
    MstUniverseDestroy(o.u);
    ck_assert_msg(caught.warnings == 0, "%d, w h = %g, damping ratio %g: %s", (int)way, wh, ratio, caught.last);
    return s;
}

static const char *nameOf(Way way) {
    static const char *const name[WAYS] = {"free", "moving", "sliding", "in a crowd", "guided", "hinged", "twisted"};
    return name[way];
}

/* Before, w h = 1/6 multiplied the amplitude by 57. What turns about a hinge by a tenth of a radian in a step is pushed
 * askew in the end, as a force keeps its direction during a step. */
TEST(an_undamped_spring_keeps_its_amplitude) {
    const double wh[] = {1. / 12, 1. / 6, 1. / 3, .6, 1}, h[] = {1. / 60, 1. / 240};
    for (Way way = FREE; way < WAYS; way++)
        for (int i = 0; i < 5 - (way == HINGED); i++)
            for (int k = 0; k < 3; k++) {
                const Swing s = swing(way, wh[i], 0, h[k == 1], k == 2 ? 4 : 1);
                ck_assert_msg(fabs(s.last / s.first - 1) < .01 || (way == HINGED && i == 3 && s.last / s.first < 1.04),
                              "%s, w h = %g, %s: %g times as large in the end", nameOf(way), wh[i],
                              k == 1   ? "240 Hz"
                              : k == 2 ? "4 sub-steps"
                                       : "60 Hz",
                              s.last / s.first);
                ck_assert_msg(s.first < 1.01 / sqrt(1 - wh[i] * wh[i] / 4), "%s, w h = %g: grows to %g at once",
                              nameOf(way), wh[i], s.first);
            }
}

TEST(a_damped_spring_stays_below_its_envelope) {
    const double wh[] = {1. / 12, 1. / 6, 1. / 3, .6, .9}, ratio[] = {.02, .05, .2, .5, .7, 1};
    for (Way way = FREE; way < WAYS; way++)
        for (int i = 0; i < (way == IN_CROWD ? 4 : 5); i++)
            for (int k = 0; k < 6; k++) {
                const Swing s = swing(way, wh[i], ratio[k], 1. / 60, 1);
                ck_assert_msg(s.excess < .05, "%s, w h = %g, damping ratio %g: %g above", nameOf(way), wh[i], ratio[k],
                              s.excess);
            }
}

static MdtBodyID lonelyBody(MstUniverseID u) {
    MdtWorldSetAutoDisable(MstUniverseGetWorld(u), 0);
    return McdModelGetBody(MstModelAndBodyCreate(u, McdSphereCreate(MstUniverseGetFramework(u), 1), 1));
}

/* Where the program itself sets the velocity, or the place, the force of the step before says nothing. */
TEST(a_velocity_that_is_set_is_not_corrected) {
    MstUniverseID u = MstUniverseCreate(&MstUniverseGrowingSizes);
    MdtBodyID b = lonelyBody(u);
    const double mass = MdtBodyGetMass(b), h = 1. / 64;
    MeVector3 v;
    for (int way = 0; way < 2; way++)
        for (int i = 0; i < 10; i++) {
            if (way == 0)
                MdtBodySetLinearVelocity(b, 1, 0, 0);
            else if (i == 0)
                MdtBodySetLinearVelocity(b, 1, 0, 0);
            else
                MdtBodySetPosition(b, (MeReal)i, 0, 0);
            MdtBodyGetLinearVelocity(b, v);
            const double force = (way == 0 || i % 2 ? 10. : -10.) * (10 + i), before = (double)v[0];
            MdtBodyAddForce(b, force * mass, 0, 0);
            MstUniverseStep(u, h);
            MdtBodyGetLinearVelocity(b, v);
            assert_near(v[0], before + force * h, TOL(1e-6, 1e-14));
        }
    MstUniverseDestroy(u);
}

/* ---- as by the method of Verlet ---- */

/* m/s²: of springs along x and y, or of a trampoline, with gravity. */
static void accelerationAt(int way, double w, const double x[3], double a[3]) {
    a[0] = -w * w * x[0];
    a[1] = way == 1 ? -.3 * w * w * x[1] : 0;
    a[2] = way == 2 ? (x[2] < 0 ? -w * w * x[2] : 0) - 9.8 : 0;
}

/* Setters that change nothing, or put the body back into its plane. */
static void setAsItIs(MdtBodyID b) {
    MeVector3 x, v;
    MdtBodyGetPosition(b, x);
    MdtBodyGetLinearVelocity(b, v);
    MdtBodySetPosition(b, x[0], 0, x[2]);
    MdtBodySetLinearVelocity(b, v[0], 0, v[2]);
    MdtBodySetAngularVelocity(b, 0, 0, 0);
    MdtBodySetQuaternion(b, 1, 0, 0, 0);
    MdtBodySetMass(b, MdtBodyGetMass(b));
}

/* Frames of other lengths, a stiffness that depends on the direction, a force on one side only, setters in between. */
TEST(forces_of_programs_act_as_by_verlet) {
    for (int way = 0; way < 4; way++)
        for (double w = 3; w < 25; w *= 2) {
            MstUniverseID u = MstUniverseCreate(&MstUniverseGrowingSizes);
            MdtBodyID b = lonelyBody(u);
            double x[3] = {way == 2 ? 0 : 1, way == 1 ? 1 : 0, way == 2 ? 2 : 0}, v[3] = {0, 0, 0}, a[3], max = 0,
                   off = 0;
            MdtWorldSetGravity(MstUniverseGetWorld(u), 0, 0, 0);
            MdtBodySetPosition(b, x[0], x[1], x[2]);
            MdtBodySetLinearVelocity(b, 0, 0, 0);
            for (int i = 0; i < 600; i++) {
                const double h = way == 0 && i % 3 == 0 ? .033 : 1. / 60;
                MeVector3 at;
                MdtBodyGetPosition(b, at);
                const double place[3] = {(double)at[0], (double)at[1], (double)at[2]}, m = (double)MdtBodyGetMass(b);
                double next[3];
                accelerationAt(way, w, place, next);
                MdtBodyAddForce(b, m * next[0], m * next[1], m * next[2]);
                if (way == 3)
                    setAsItIs(b);
                MstUniverseStep(u, h);
                accelerationAt(way, w, x, a);
                for (int k = 0; k < 3; k++)
                    x[k] += h * v[k] + .5 * h * h * a[k];
                accelerationAt(way, w, x, next);
                for (int k = 0; k < 3; k++)
                    v[k] += .5 * h * (a[k] + next[k]);
                MdtBodyGetPosition(b, at);
                for (int k = 0; k < 3; k++)
                    off = fmax(off, fabs((double)at[k] - x[k])), max = fmax(max, fabs(x[k]));
            }
            ck_assert_msg(off < TOL(2e-2, 1e-6) * max, "way %d, %g rad/s: %g off by %g", way, w, max, off);
            MstUniverseDestroy(u);
        }
}

/* Frequency times step above 2, or h c / m: no explicit force is stable. */
TEST(a_spring_too_stiff_for_the_step_is_told_of) {
    for (int isDamper = 0; isDamper < 2; isDamper++)
        for (int way = 0; way < 2; way++) {
            Oscillator o = oscillator(way ? TWISTED : FREE, isDamper ? .1 : 2.1, isDamper ? 11 : 0, 1. / 60, 1);
            if (way)
                placeAt(&o, 1e-4, 0, 0);
            for (int i = 0; i < 60 && caught.warnings == 0; i++) {
                push(&o, 0);
                MstUniverseStep(o.u, o.h);
            }
            assert_warned(way ? "MdtBodyAddTorque: " : "MdtBodyAddForce: ");
            for (int i = 0; i < 10; i++) {
                push(&o, 0);
                MstUniverseStep(o.u, o.h);
            }
            assert_silent(); /* once */
            MstUniverseDestroy(o.u);
        }
}

/* ---- a mechanism ---- */

/* Andrews' squeezing mechanism (Schiehlen, Multibody Systems Handbook, 1990; Hairer and Wanner, Solving Ordinary
 * Differential Equations II, VII.7): seven bodies, ten hinges, a stiff spring, driven by a constant torque. */
static MdtBodyID plate(MdtWorldID w, double mass, double moment, double x, double y, double angle) {
    MdtBodyID b = MdtBodyCreate(w);
    MdtBodySetMass(b, mass);
    MdtBodySetSphericalInertiaTensor(b, moment);
    MdtBodySetPosition(b, x, y, 0);
    MdtBodySetQuaternion(b, cos(angle / 2), 0, 0, sin(angle / 2));
    MdtBodyEnable(b);
    return b;
}

static void pin(MdtWorldID w, MdtBodyID a, MdtBodyID b, double x, double y) {
    MdtHingeID j = MdtHingeCreate(w);
    MdtHingeSetBodies(j, a, b);
    MdtHingeSetPosition(j, x, y, 0);
    MdtHingeSetAxis(j, 0, 0, 1);
    MdtHingeEnable(j);
}

typedef struct Squeezer {
    MdtBodyID crank, lever;
    double at[2]; /* where the spring is attached to the lever, in its frame */
} Squeezer;

static const double crankStart = -.0617138900142764496, leverStart = .455279819163070380256;

static Squeezer makeSqueezer(MdtWorldID w) {
    const double A[2] = {-.06934, -.00227}, B[2] = {-.03635, .03273}, phi = .222668390165885884674,
                 delta = .487364979543842550226, omega = -phi, epsilon = 1.23054744454982119250, beta = crankStart,
                 gamma = leverStart, d = .028, da = .0115, e = .02, ea = .01421, rr = .007, ra = .00092, sa = .01874,
                 sb = .01043, sc = .018, sd = .02, ta = .02308, tb = .00916, u = .04, ua = .01228, ub = .00449,
                 zf = .02, zt = .04, fa = .01421;
    const double P[2] = {rr * cos(beta), rr * sin(beta)}, E[2] = {P[0] - d * cos(beta), P[1] - d * sin(beta)},
                 Q[2] = {A[0] + zt * cos(delta), A[1] + zt * sin(delta)},
                 S[2] = {A[0] + u * sin(epsilon), A[1] - u * cos(epsilon)};
    MdtBodyID k[8];
    k[1] = plate(w, .04325, 2.194e-6, ra * cos(beta), ra * sin(beta), beta);
    k[2] = plate(w, .00365, 4.410e-7, P[0] - da * cos(beta), P[1] - da * sin(beta), beta);
    const double c3[2] = {sa * sin(gamma) + sb * cos(gamma), -sa * cos(gamma) + sb * sin(gamma)};
    k[3] = plate(w, .02373, 5.255e-6, B[0] + c3[0], B[1] + c3[1], gamma);
    k[4] =
        plate(w, .00706, 5.667e-7, Q[0] + (e - ea) * sin(phi + delta), Q[1] - (e - ea) * cos(phi + delta), phi + delta);
    k[5] = plate(w, .07050, 1.169e-5, A[0] + ta * cos(delta) - tb * sin(delta),
                 A[1] + ta * sin(delta) + tb * cos(delta), delta);
    k[6] = plate(w, .00706, 5.667e-7, S[0] + (zf - fa) * cos(omega + epsilon), S[1] + (zf - fa) * sin(omega + epsilon),
                 omega + epsilon);
    k[7] = plate(w, .05498, 1.912e-5, A[0] + ua * sin(epsilon) - ub * cos(epsilon),
                 A[1] - ua * cos(epsilon) - ub * sin(epsilon), epsilon);
    pin(w, k[1], 0, 0, 0);
    pin(w, k[1], k[2], P[0], P[1]);
    pin(w, k[2], k[3], E[0], E[1]);
    pin(w, k[2], k[4], E[0], E[1]);
    pin(w, k[2], k[6], E[0], E[1]);
    pin(w, k[3], 0, B[0], B[1]);
    pin(w, k[4], k[5], Q[0], Q[1]);
    pin(w, k[5], 0, A[0], A[1]);
    pin(w, k[6], k[7], S[0], S[1]);
    pin(w, k[7], 0, A[0], A[1]);
    /* the spring's end is at (sd, -sc) from B in the lever's frame; the centre of mass at (sb, -sa) */
    return (Squeezer){.crank = k[1], .lever = k[3], .at = {sd - sb, sa - sc}};
}

static void driveSqueezer(const Squeezer *s) {
    const double C[2] = {.014, .072}, stiffness = 4530, length = .07785;
    const MeMatrix4Ptr t = MdtBodyGetTransformPtr(s->lever);
    double p[2], f[2];
    for (int i = 0; i < 2; i++)
        p[i] = (double)t[3][i] + s->at[0] * (double)t[0][i] + s->at[1] * (double)t[1][i];
    const double now = hypot(p[0] - C[0], p[1] - C[1]);
    for (int i = 0; i < 2; i++)
        f[i] = -stiffness * (now - length) / now * (p[i] - C[i]);
    MdtBodyAddForceAtPosition(s->lever, f[0], f[1], 0, p[0], p[1], 0);
    MdtBodyAddTorque(s->crank, 0, 0, .033);
}

/* rad: where the crank is after 30 ms. */
static double squeeze(double h, int order) {
    MdtWorldID w = MdtWorldCreate(8, 16);
    MdtWorldSetAutoDisable(w, 0);
    MdtWorldSetEpsilon(w, 0);
    MdtWorldSetIntegratorOrder(w, order);
    const Squeezer s = makeSqueezer(w);
    double angle = crankStart;
    for (int i = 0; i < (int)(.03 / h + .5); i++) {
        driveSqueezer(&s);
        MdtWorldStep(w, h);
        const MeMatrix4Ptr t = MdtBodyGetTransformPtr(s.crank);
        angle += remainder(atan2(t[0][1], t[0][0]) - angle, 2 * ME_PI);
    }
    MdtWorldDestroy(w);
    return angle;
}

/* The reference is that of Hairer and Wanner. With order 2 the joints of a crank that turns by .1 rad in a step have
 * the error (h w)²/12 themselves: .0079 rad with MdtSpring in place of the program's. It was .3. */
TEST(a_squeezer_with_a_spring_by_hand_is_as_exact_as_its_joints) {
    const double reference = 15.81077119629904;
    assert_near(squeeze(1e-4, 4), reference, 1e-3);
    assert_near(squeeze(1e-4, 2), reference, 8e-3);
    assert_near(squeeze(5e-5, 2), reference, 2e-3);
}
