/* Closed chains of 40 links of 1 kg, .25 x .05 x .05 m, in a plane that is turned out of all axes: lying free and
 * kicked, hanging from one joint, and a bridge of 40 links that sags between two. Some rows of a loop of hinges are
 * redundant; they agree with the others, and no joints contradict each other. */
#include "Mdt.h"
#include "karma_test.h"

static const double pi = 3.14159265358979323846, gravity = 9.81;
static const double length = .25, thickness = .05; /* m */
static const double kick = .3;                     /* m/s, of every link in another direction */
static const double damping = .5;                  /* 1/s */
static const double frame = 1.0 / 60;              /* s */
enum { LINKS = 40, FRAMES = 600 };

typedef enum Joint { BALL, ACROSS, TANGENT, RADIAL } Joint; /* hinges: by the direction of their axes in the ring */
typedef enum Hold { FREE, HANGING, BRIDGE } Hold;

/* The plane of the ring: 0.7 rad about (1, .4, .3). */
static void turnOut(double q[4]) {
    const double size = sqrt(1 + .4 * .4 + .3 * .3), s = sin(.35) / size;
    q[0] = cos(.35);
    q[1] = s;
    q[2] = .4 * s;
    q[3] = .3 * s;
}

static void multiply(const double a[4], const double b[4], double r[4]) {
    r[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    r[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    r[2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
    r[3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
}

static void place(const double in[3], double out[3]) {
    double q[4], qv[4], r[4];
    turnOut(q);
    const double v[4] = {0, in[0], in[1], in[2]}, back[4] = {q[0], -q[1], -q[2], -q[3]};
    multiply(q, v, qv);
    multiply(qv, back, r);
    for (int i = 0; i < 3; i++)
        out[i] = r[i + 1];
}

static MdtBodyID addLink(MdtWorldID w, double x, double y, double angle, int number) {
    const MdtBodyID b = MdtBodyCreate(w);
    const double flat[3] = {x, y, 0}, about[4] = {cos(angle / 2), 0, 0, sin(angle / 2)};
    double p[3], plane[4], q[4];
    MeMatrix3 inertia;
    turnOut(plane);
    place(flat, p);
    multiply(plane, about, q);
    MdtMakeInertiaTensorBox(1, length, thickness, thickness, inertia);
    MdtBodySetMass(b, 1);
    MdtBodySetInertiaTensor(b, inertia);
    MdtBodySetPosition(b, p[0], p[1], p[2]);
    MdtBodySetQuaternion(b, q[0], q[1], q[2], q[3]);
    MdtBodySetLinearVelocity(b, kick * sin(3. * number), kick * cos(5. * number), kick * sin(7. * number));
    MdtBodySetLinearVelocityDamping(b, damping);
    MdtBodySetAngularVelocityDamping(b, damping);
    MdtBodyEnable(b);
    return b;
}

/* At (x, y) of the plane; `angle`: of the radius there. */
static void join(MdtWorldID w, Joint kind, MdtBodyID a, MdtBodyID b, double x, double y, double angle) {
    const double
        flat[3] = {x, y, 0},
        axes[][3] = {
            [ACROSS] = {0, 0, 1}, [TANGENT] = {-sin(angle), cos(angle), 0}, [RADIAL] = {cos(angle), sin(angle), 0}};
    double p[3], axis[3];
    place(flat, p);
    place(axes[kind], axis);
    const MdtConstraintID j =
        kind == BALL ? MdtBSJointQuaConstraint(MdtBSJointCreate(w)) : MdtHingeQuaConstraint(MdtHingeCreate(w));
    MdtConstraintSetBodies(j, a, b);
    MdtConstraintSetPosition(j, p[0], p[1], p[2]);
    if (kind != BALL)
        MdtConstraintSetAxis(j, axis[0], axis[1], axis[2]);
    MdtConstraintEnable(j);
}

static void addRing(MdtWorldID w, Joint kind, Hold hold) {
    const double radius = length / 2 / sin(pi / LINKS);
    MdtBodyID links[LINKS];
    for (int i = 0; i < LINKS; i++) {
        const double angle = 2 * pi * (i + .5) / LINKS, r = radius * cos(pi / LINKS);
        links[i] = addLink(w, r * cos(angle), r * sin(angle), angle + pi / 2, i);
    }
    for (int i = 0; i < LINKS; i++) {
        const double angle = 2 * pi * i / LINKS;
        join(w, kind, links[(i + LINKS - 1) % LINKS], links[i], radius * cos(angle), radius * sin(angle), angle);
    }
    if (hold == HANGING)
        join(w, BALL, links[LINKS / 4], 0, 0, radius, 0);
}

/* An arc of 2 rad, whose ends are joined with the world. */
static void addBridge(MdtWorldID w, Joint kind) {
    MdtBodyID before = 0;
    double x = 0, y = 0;
    for (int i = 0; i < LINKS; i++) {
        const double angle = -1 + 2 * (i + .5) / LINKS, dx = length * cos(angle), dy = length * sin(angle);
        const MdtBodyID link = addLink(w, x + dx / 2, y + dy / 2, angle, i);
        join(w, kind, link, before, x, y, angle);
        before = link;
        x += dx;
        y += dy;
    }
    join(w, kind, before, 0, x, y, 0);
}

typedef struct Outcome {
    int conflicts, fallbacks;
    double gap; /* m */
} Outcome;

static Outcome run(Joint kind, Hold hold, double epsilon) {
    const MdtWorldID w = MdtWorldCreate(LINKS, LINKS + 1);
    Outcome o = {.gap = 0};
    MdtWorldSetAutoDisable(w, 0);
    MdtWorldSetEpsilon(w, epsilon);
    MdtWorldSetGravity(w, 0, hold == FREE ? 0 : (MeReal)-gravity, 0);
    MdtWorldEnableReport(w);
    if (hold == BRIDGE)
        addBridge(w, kind);
    else
        addRing(w, kind, hold);
    for (int i = 0; i < FRAMES; i++) {
        MdtReport r;
        MdtWorldStep(w, frame);
        ck_assert(MdtWorldGetReport(w, &r));
        o.conflicts += r.conflicts;
        o.fallbacks += r.fallbacks;
        o.gap = fmax(o.gap, r.jointGap);
    }
    MdtWorldDestroy(w);
    return o;
}

typedef struct Case {
    const char *what;
    Joint kind;
    Hold hold;
    double epsilon;
    double gap; /* m */
} Case;

static const Case cases[] = {
    {"ball joints, free", BALL, FREE, 0, 1e-9},
    {"hinges, free", ACROSS, FREE, 0, 1e-9},
    {"hinges with radial axes, free", RADIAL, FREE, 0, 1e-9},
    {"ball joints, hanging", BALL, HANGING, 0, 1e-9},
    {"hinges, hanging", ACROSS, HANGING, 0, 1e-9},
    {"hinges of 1e-8 / kg, hanging", ACROSS, HANGING, 1e-8, 1e-7},
    {"hinges of the guide's 1e-4 / kg, hanging", ACROSS, HANGING, 1e-4, 1e-3},
    {"ball joints, bridge", BALL, BRIDGE, 0, 1e-9},
    {"hinges, bridge", ACROSS, BRIDGE, 0, 1e-9},
    {"hinges of the guide's 1e-4 / kg, bridge", ACROSS, BRIDGE, 1e-4, 1e-3},
};

TEST(redundant_joints_that_agree_are_no_conflict) {
    for (unsigned int i = 0; i < sizeof cases / sizeof *cases; i++) {
        const Case *c = &cases[i];
        const Outcome o = run(c->kind, c->hold, c->epsilon);
        ck_assert_msg(o.conflicts == 0 && o.fallbacks == 0 && o.gap <= c->gap, "%s: %d conflicts, %d inexact, gap %g m",
                      c->what, o.conflicts, o.fallbacks, o.gap);
    }
}
