/* How the time of a hanging chain grows with its links: 1 kg each, 1000 kg at the end, one step of 1/60 s per frame.
 *
 *     chains [--budget SECONDS] [--report] [LINKS ...]         10 100 1000 10000 if not given
 *
 * A chain that would take longer than the budget, by what the shorter ones took, is left out. With --report, what the
 * report of a step costs (MdtReport.h): frames with it and without take turns, and their medians are compared. */
#include "timing.h"

#include "Mdt.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FRAMES = 60, REPORT_FRAMES = 1200, MAX_SIZES = 16 };
static const double linkLength = .5, linkWidth = .1, ballMass = 1000, ballRadius = .5, gravity = 9.81;
static const double shake = .2; /* rad/s, of the links' spins at the start */

typedef struct Chain {
    MdtWorldID world;
    MdtBodyID *bodies; /* the links, and the ball */
    int links;
} Chain;

/* What a size took. */
typedef struct Cost {
    int links;
    double frame, all, gap, energy; /* s, s, m, relative */
} Cost;

/* Building */

static MdtBodyID addBody(const Chain *c, double mass, const MeMatrix3 inertia, double y) {
    const MdtBodyID b = MdtBodyCreate(c->world);
    MdtBodySetMass(b, (MeReal)mass);
    MdtBodySetInertiaTensor(b, inertia);
    MdtBodySetPosition(b, 0, (MeReal)y, 0);
    MdtBodyEnable(b);
    return b;
}

static void join(const Chain *c, int child) {
    const MdtBSJointID j = MdtBSJointCreate(c->world);
    MdtBSJointSetBodies(j, c->bodies[child], child ? c->bodies[child - 1] : 0);
    MdtBSJointSetPosition(j, 0, (MeReal)(-linkLength * child), 0);
    MdtBSJointEnable(j);
}

/* Each link turns at its own rate, and its lower end takes the next one along. */
static void setTurning(const Chain *c) {
    double velocity = 0;
    for (int i = 0; i <= c->links; i++) {
        const double rate = i < c->links ? shake * sin(2.5 * i + 1) : 0;
        MdtBodySetAngularVelocity(c->bodies[i], 0, 0, (MeReal)rate);
        MdtBodySetLinearVelocity(c->bodies[i], (MeReal)(velocity + rate * linkLength / 2), 0, 0);
        velocity += rate * linkLength;
    }
}

static Chain makeChain(int links) {
    Chain c = {.links = links, .bodies = calloc((size_t)links + 1, sizeof *c.bodies)};
    MeMatrix3 link, ball;
    if (!c.bodies)
        abort();
    MdtMakeInertiaTensorBox(1, (MeReal)linkWidth, (MeReal)linkLength, (MeReal)linkWidth, link);
    MdtMakeInertiaTensorSphere((MeReal)ballMass, (MeReal)ballRadius, ball);
    c.world = MdtWorldCreate((unsigned)links + 1, (unsigned)links + 1);
    MdtWorldSetAutoDisable(c.world, 0);
    MdtWorldSetEpsilon(c.world, 0);
    MdtWorldSetGravity(c.world, 0, (MeReal)-gravity, 0);
    for (int i = 0; i <= links; i++) {
        const double y = -linkLength * i - (i < links ? linkLength / 2 : ballRadius);
        c.bodies[i] = i < links ? addBody(&c, 1, link, y) : addBody(&c, ballMass, ball, y);
        join(&c, i);
    }
    setTurning(&c);
    return c;
}

static void destroyChain(Chain *c) {
    MdtWorldDestroy(c->world);
    free(c->bodies);
}

/* Measuring */

/* Where the point is that lies `up` above the body's centre in its own axes. */
static void pointOf(MdtBodyID b, double up, double out[3]) {
    MeVector3 p;
    MeMatrix3 r;
    MdtBodyGetPosition(b, p);
    MdtBodyGetOrientation(b, r);
    for (int i = 0; i < 3; i++)
        out[i] = (double)p[i] + up * (double)r[i][1];
}

static double gapOf(const Chain *c) {
    double worst = 0, end[3] = {0, 0, 0};
    for (int i = 0; i <= c->links; i++) {
        const double half = i < c->links ? linkLength / 2 : ballRadius;
        double top[3];
        pointOf(c->bodies[i], half, top);
        worst = fmax(worst, sqrt(pow(top[0] - end[0], 2) + pow(top[1] - end[1], 2) + pow(top[2] - end[2], 2)));
        pointOf(c->bodies[i], -half, end);
    }
    return worst;
}

static double energyOf(const Chain *c) {
    double sum = 0;
    for (int i = 0; i <= c->links; i++) {
        MeVector3 p;
        MdtBodyGetPosition(c->bodies[i], p);
        sum += (double)MdtBodyGetKineticEnergy(c->bodies[i]) +
               (double)MdtBodyGetMass(c->bodies[i]) * gravity * (double)p[1];
    }
    return sum;
}

/* As many frames as there is time for, at least one. */
static Cost measure(int links, double budget) {
    Chain c = makeChain(links);
    Cost cost = {.links = links};
    double times[FRAMES];
    const double before = energyOf(&c);
    int n = 0;
    while (n < FRAMES && (n == 0 || cost.all < budget)) {
        const double start = now();
        MdtWorldStep(c.world, (MeReal)(1.0 / 60));
        cost.all += times[n++] = now() - start;
        cost.gap = fmax(cost.gap, gapOf(&c));
        cost.energy = fmax(cost.energy, fabs(energyOf(&c) - before));
    }
    cost.energy /= (links + ballMass) * gravity * linkLength;
    cost.frame = median(times, n);
    printf("%8d%14.1f%14.3g%14.3g%8d\n", links, 1e6 * cost.frame, cost.gap, cost.energy, n);
    fflush(stdout);
    destroyChain(&c);
    return cost;
}

/* Pairs of frames, one of them reported, the first and the second in turn. */
static void measureReport(int links, double budget) {
    static double times[2][REPORT_FRAMES];
    Chain c = makeChain(links);
    double all = 0;
    int n = 0;
    for (; n < REPORT_FRAMES && (n == 0 || all < budget); n++)
        for (int turn = 0; turn < 2; turn++) {
            const int isOn = (n + turn) % 2;
            if (isOn)
                MdtWorldEnableReport(c.world);
            const double start = now();
            MdtWorldStep(c.world, (MeReal)(1.0 / 60));
            all += times[isOn][n] = now() - start;
            MdtWorldDisableReport(c.world);
        }
    const double off = median(times[0], n), on = median(times[1], n);
    printf("%8d%14.1f%14.1f%14.2f%8d\n", links, 1e6 * off, 1e6 * on, 100 * (on / off - 1), n);
    fflush(stdout);
    destroyChain(&c);
}

/* s, of one frame: the time grows by the power that it last grew by, or by the third. */
static double forecast(const Cost *last, const Cost *before, int links) {
    if (!last->links)
        return 0;
    const double power = before->links && before->links != last->links
                             ? log(last->frame / before->frame) / log((double)last->links / before->links)
                             : 3;
    return last->frame * pow((double)links / last->links, power);
}

static void usage(void) {
    fputs("usage: chains [--budget SECONDS] [--report] [LINKS ...]\n", stderr);
    exit(2);
}

int main(int argc, char *argv[]) {
    int sizes[MAX_SIZES] = {10, 100, 1000, 10000}, count = 4, given = 0;
    double budget = 60;
    int isReport = 0;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--budget") == 0 && i + 1 < argc)
            budget = atof(argv[++i]);
        else if (strcmp(argv[i], "--report") == 0)
            isReport = 1;
        else if (atoi(argv[i]) > 0 && given < MAX_SIZES)
            sizes[given++] = atoi(argv[i]);
        else
            usage();
    }
    count = given ? given : count;
    if (isReport) {
        printf("the report of a step\n%8s%14s%14s%14s%8s\n", "links", "off us", "on us", "cost %", "pairs");
        for (int i = 0; i < count; i++)
            measureReport(sizes[i], budget);
        return 0;
    }
    printf("%s precision; 1000 kg at the end; gap: the largest in %d frames; energy: its largest error / (all weights "
           "x length of a link)\n%8s%14s%14s%14s%8s\n",
           sizeof(MeReal) == sizeof(double) ? "double" : "single", FRAMES, "links", "us/frame", "gap m", "energy",
           "frames");
    Cost last = {.links = 0}, before = {.links = 0};
    for (int i = 0; i < count; i++) {
        const double expected = forecast(&last, &before, sizes[i]);
        if (expected > budget) {
            printf("%8d   left out: a frame would take some %.0f s\n", sizes[i], expected);
            continue;
        }
        const Cost cost = measure(sizes[i], budget);
        before = last;
        last = cost;
    }
    return 0;
}
