/* Contact in time: events that divide a step, and impacts.
 *
 * In a timed step bodies move with their mean velocities, x⁺ = x + h (v + v⁺)/2, and contacts that are closed hold the
 * velocity at the end: exact for constant forces, where a step that moves with v⁺ is off by a h²/2. What changes the
 * forces within the step divides it:
 *
 *   an impact: an open contact's gap, φ + J v t + J (v⁺ - v) t²/2h, vanishes at some t;
 *   a stop:    a contact that slides would stick or slide back at the end. With the friction still against the slip u of
 *              the start, it vanishes at t = h |u| / (|u| - u⁺·u/|u|).
 *
 * Impacts go by rounds (generalized reflections: Smith et al. 2012): all contacts that meet are reflected at once, and
 * again while some still meet. That brings the last ball of a cradle out alone and keeps a flat box from turning. Where
 * a round with restitution gains energy, it is blended with the plastic one.
 */
#include "kea_i.h"
#include "MeAssert.h"
#include <string.h>

enum { MAX_ROUNDS = 60, MAX_IMPACT_PASSES = 14 };
static const double parts = 0.03;        /* of a step's change of speed by the loads: faster is open */
static const double slides = 0.03;       /* the same: faster is a slide that can stop */
static const double slow = 1e-6;         /* the same: meeting more slowly is no impact */
static const double sinks = 0.05;        /* the same, in a soft contact, at most */
static const double plastic = 0.5;       /* the same: meeting more slowly does not rebound */
static const double simultaneous = 1e-9; /* of the partition's speed */
#ifdef _ME_API_DOUBLE
static const double touches = 1e-7; /* of the smaller body's size */
#else
static const double touches = 1e-5; /* the same; programs place bodies in single precision */
#endif

static double rateOf(const MdtKeaSystem *s, int i) {
    const MdtKeaRow *row = &s->rows[i];
    double rate = -row->target;
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            rate += keaDot(row->J[k].lin, s->velocity[row->body[k]].lin) +
                    keaDot(row->J[k].ang, s->velocity[row->body[k]].ang);
    return row->contact == i ? rate + row->target - row->drift : rate;
}

/* m/s: by how much the loads change speeds in a step; without loads, a little of the speeds. */
static double loadSpeed(const MdtKeaSystem *s) {
    double change = 0, speed = 0;
    for (int i = 0; i < s->numBodies; i++) {
        double dv[3];
        keaSubtract(dv, s->work->body[i].freeVelocity, s->bodies[i]->velocity);
        change = keaMax(change, keaLength(dv));
        speed =
            keaMax(speed, keaLength(s->bodies[i]->velocity) + s->work->body[i].size * keaLength(s->velocity[i].ang));
    }
    return keaMax(change, 1e-6 * speed);
}

static MeBool isTouching(const MdtKeaSystem *s, const MdtKeaRow *row) {
    double size = HUGE_VAL;
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            size = keaMin(size, s->work->body[row->body[k]].size);
    return row->error < touches * size;
}

void kea_timedBegin(MdtKeaSystem *s) {
    const double speed = loadSpeed(s);
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact == i)
            s->rows[i].isOpen = !isTouching(s, &s->rows[i]) || rateOf(s, i) > parts * speed;
}

/* ---- events ---- */

/* When φ + a t + b t²/2 falls through zero; HUGE_VAL: never. */
static double timeOfFall(double gap, double a, double b) {
    gap = keaMax(gap, 0);
    const double root = a * a - 2 * b * gap;
    if (root < 0)
        return HUGE_VAL;
    if (a < 0)
        return 2 * gap / (-a + sqrt(root));
    return b < 0 ? (a + sqrt(root)) / -b : HUGE_VAL;
}

static double firstImpact(const MdtKeaSystem *s) {
    const double h = s->parameters.stepsize;
    double first = HUGE_VAL;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if (row->contact != i || !row->isOpen)
            continue;
        const double a = rateOf(s, i), b = (kea_endRate(s, i) - row->drift - a) / h;
        first = keaMin(first, timeOfFall(row->error, a, b));
    }
    return first;
}

typedef struct Slip {
    double start[2], size; /* m/s, at the start */
    double end[2];
    int row[2]; /* the second may be -1 */
} Slip;

static Slip slipOf(const MdtKeaSystem *s, int i) {
    Slip slip = {.row = {i, s->rows[i].partner}};
    for (int k = 0; k < 2 && slip.row[k] >= 0; k++) {
        slip.start[k] = rateOf(s, slip.row[k]);
        slip.end[k] = kea_endRate(s, slip.row[k]) - s->rows[slip.row[k]].target;
    }
    slip.size = keaHypotenuse(slip.start[0], slip.start[1]);
    return slip;
}

/* Rows of friction that depends on the normal force and that slide at the start; a cone by its first row. */
static MeBool canStop(const MdtKeaSystem *s, int i, double gate) {
    const MdtKeaRow *row = &s->rows[i];
    return row->normal >= 0 && !s->rows[row->contact].isOpen && !(row->partner >= 0 && row->partner < i) &&
           slipOf(s, i).size > gate;
}

static MeBool hasStopped(const MdtKeaSystem *s, const Slip *slip) {
    const KeaProblemRow *p = &s->work->problem.row[slip->row[0]];
    const double force = keaHypotenuse(p->p, slip->row[1] >= 0 ? s->work->problem.row[slip->row[1]].p : 0);
    const MeBool sticks = force < (1 - 1e-7) * p->friction * s->work->problem.row[p->normal].p;
    return sticks || slip->start[0] * slip->end[0] + slip->start[1] * slip->end[1] < 0;
}

/* Contacts that stop are held to slide on against the slip of the start. Returns whether there are any. */
static MeBool forceSlides(MdtKeaSystem *s, double gate) {
    MeBool any = MEFALSE;
    for (int i = 0; i < s->numRows; i++) {
        if (!canStop(s, i, gate) || s->rows[i].isForced)
            continue;
        const Slip slip = slipOf(s, i);
        if (!hasStopped(s, &slip))
            continue;
        for (int k = 0; k < 2 && slip.row[k] >= 0; k++) {
            s->rows[slip.row[k]].isForced = METRUE;
            s->rows[slip.row[k]].forced = -slip.start[k] / slip.size;
        }
        any = METRUE;
    }
    return any;
}

static double firstStop(const MdtKeaSystem *s) {
    const double h = s->parameters.stepsize;
    double first = HUGE_VAL;
    for (int i = 0; i < s->numRows; i++) {
        if (!s->rows[i].isForced || (s->rows[i].partner >= 0 && s->rows[i].partner < i))
            continue;
        const Slip slip = slipOf(s, i);
        const double end = (slip.start[0] * slip.end[0] + slip.start[1] * slip.end[1]) / slip.size;
        if (end < slip.size)
            first = keaMin(first, h * slip.size / (slip.size - end));
    }
    return first;
}

double kea_firstEvent(MdtKeaSystem *s, MeBool *mustRepeat) {
    const double gate = slides * loadSpeed(s);
    *mustRepeat = forceSlides(s, gate);
    return keaMin(firstImpact(s), firstStop(s));
}

void kea_releaseSlides(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        s->rows[i].isForced = MEFALSE;
}

/* ---- impacts ---- */

/* kg */
static double totalMass(const MdtKeaSystem *s) {
    double sum = 0;
    for (int i = 0; i < s->numBodies; i++)
        sum += 1 / s->bodies[i]->invMass;
    return sum;
}

/* A soft contact gives way to its load, J v⁺ = -h E λ, where λ is no more than the weight of all: that is no impact. */
MeBool MEAPI MdtKeaMeets(const MdtKeaSystem *s) {
    const double speed = loadSpeed(s), mass = totalMass(s);
    for (int i = 0; i < s->numRows; i++) {
        const double gate = keaMin(slow + s->rows[i].softness * mass, sinks) * speed;
        if (s->rows[i].contact == i && isTouching(s, &s->rows[i]) && rateOf(s, i) < -gate)
            return METRUE;
    }
    return MEFALSE;
}

static void setMetric(MdtKeaSystem *s, int i) {
    KeaProblem *q = &s->work->problem;
    KeaMetric *B = &q->metric[i];
    const double *I = s->bodies[i]->moments;
    B->linear = 1 / s->bodies[i]->invMass;
    kea_inertia(s->bodies[i], s->bodies[i]->quaternion, B->angular);
    kea_invert(B->inverse, (const double(*)[3])B->angular);
    q->length[i] = sqrt(keaMax(I[0], keaMax(I[1], I[2])) * s->bodies[i]->invMass);
    q->scale[i] = B->linear * (keaLength(s->velocity[i].lin) + q->length[i] * keaLength(s->velocity[i].ang)) + 1e-300;
    memset(q->load[i], 0, sizeof q->load[i]);
}

static void setRow(MdtKeaSystem *s, int i) {
    const MdtKeaRow *row = &s->rows[i];
    KeaProblemRow *p = &s->work->problem.row[i];
    for (int k = 0; k < 2; k++) {
        p->body[k] = row->body[k];
        keaCopy(p->J[k], row->J[k].lin);
        keaCopy(p->J[k] + 3, row->J[k].ang);
    }
    p->normal = row->normal;
    p->partner = row->partner;
    p->friction = row->friction;
    /* a force of given strength does nothing in an instant */
    p->lower = row->normal >= 0 || row->lower == -HUGE_VAL ? -HUGE_VAL : 0;
    p->upper = row->normal >= 0 || row->upper == HUGE_VAL ? HUGE_VAL : 0;
    p->E = row->contact == i ? 0 : row->softness;
    p->p = p->p0 = 0;
    p->isForced = p->isElsewhere = MEFALSE;
    p->state = KEA_HELD;
}

static void setProblem(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    q->numBodies = s->numBodies;
    q->numRows = s->numRows;
    for (int i = 0; i < s->numBodies; i++)
        setMetric(s, i);
    for (int i = 0; i < s->numRows; i++)
        setRow(s, i);
}

/* One round: the contacts in `takesPart` (by normal row) get the relative velocities that they ask for, the rest does
 * nothing. The change of velocities is left in `change`. */
static void solveRound(MdtKeaSystem *s, const double wanted[], const char takesPart[], double (*change)[6]) {
    KeaProblem *q = &s->work->problem;
    double start = -1;
    for (int i = 0; i < s->numRows; i++) {
        KeaProblemRow *p = &q->row[i];
        p->isOff = s->rows[i].contact < 0 || !takesPart[s->rows[i].contact] || p->size == 0;
        p->p = p->p0 = 0;
        p->radius = HUGE_VAL;
        p->Jd = 0;
        p->r = (s->rows[i].contact == i ? wanted[i] : 0) - rateOf(s, i);
    }
    for (int b = 0; b < s->numBodies; b++) {
        memset(change[b], 0, sizeof change[b]);
        memset(q->load[b], 0, sizeof q->load[b]);
    }
    for (int pass = 0; pass < MAX_IMPACT_PASSES; pass++) {
        for (int i = 0; i < s->numRows; i++)
            q->row[i].N = keaMax(1e-4 * pow(10, -pass), 1e-9) * q->row[i].size;
        for (int i = 0; i < s->numRows; i++)
            if (q->row[i].partner > i)
                q->row[i].N = q->row[q->row[i].partner].N = keaMax(q->row[i].N, q->row[q->row[i].partner].N);
        if (pass > 0)
            kea_problemApproachRadii(q, pass < 6 ? 1 : 0.5, pass > 6);
        kea_problemSolve(q, METRUE);
        kea_problemCarryOn(q, change);
        const double residual = kea_problemResidual(q, NULL);
        start = start < 0 ? residual : start;
        if ((pass > 0 && residual <= 1e-12 * (start + s->work->speed)) || q->counts.isLimited)
            break;
    }
}

static void addChange(MdtKeaSystem *s, double (*change)[6]) {
    for (int b = 0; b < s->numBodies; b++) {
        keaAddScaled(s->velocity[b].lin, 1, change[b]);
        keaAddScaled(s->velocity[b].ang, 1, change[b] + 3);
    }
}

/* The kinetic energy with a change of the velocities; null: without. */
static double kineticEnergy(const MdtKeaSystem *s, double (*change)[6]) {
    double sum = 0, v[6];
    for (int b = 0; b < s->numBodies; b++) {
        keaCopy(v, s->velocity[b].lin);
        keaCopy(v + 3, s->velocity[b].ang);
        for (int k = 0; change && k < 6; k++)
            v[k] += change[b][k];
        sum += kea_energyOf(&s->work->problem.metric[b], v, v);
    }
    return sum;
}

/* False too where the change is not finite: friction bounds need not settle. */
static MeBool isAffordable(const MdtKeaSystem *s, double (*change)[6]) {
    return kineticEnergy(s, change) <= kineticEnergy(s, NULL) * (1 + 1e-12);
}

/* The largest share a in [0, 1] for which v + a (elastic - plastic), v with the plastic change, has this energy at most. */
static double elasticShare(MdtKeaSystem *s, double (*elastic)[6], double (*plasticChange)[6], double most) {
    double c[3] = {-most, 0, 0}, step[6], v[6];
    for (int b = 0; b < s->numBodies; b++) {
        const KeaMetric *B = &s->work->problem.metric[b];
        keaCopy(v, s->velocity[b].lin);
        keaCopy(v + 3, s->velocity[b].ang);
        for (int k = 0; k < 6; k++)
            step[k] = elastic[b][k] - plasticChange[b][k];
        c[0] += kea_energyOf(B, v, v);
        c[1] += 2 * kea_energyOf(B, v, step);
        c[2] += kea_energyOf(B, step, step);
    }
    return kea_largestRoot(c);
}

/* The velocities get the plastic change, and as much of the elastic one as energy allows. */
static void blend(MdtKeaSystem *s, double (*elastic)[6], double (*plasticChange)[6]) {
    const double before = kineticEnergy(s, NULL);
    MEASSERT(isAffordable(s, plasticChange));
    const MeBool isFinite = isfinite(kineticEnergy(s, elastic)) ? METRUE : MEFALSE;
    addChange(s, plasticChange);
    const double share = isFinite ? elasticShare(s, elastic, plasticChange, before) : 0;
    for (int b = 0; share > 0 && b < s->numBodies; b++) {
        for (int k = 0; k < 3; k++) {
            s->velocity[b].lin[k] += share * (elastic[b][k] - plasticChange[b][k]);
            s->velocity[b].ang[k] += share * (elastic[b][3 + k] - plasticChange[b][3 + k]);
        }
    }
    MEASSERT(kineticEnergy(s, NULL) <= before * (1 + 1e-9));
}

static void keepImpulses(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (!s->work->problem.row[i].isOff)
            s->rows[i].force += s->work->problem.row[i].p;
}

/* Which touching contacts meet, what they want, and whether any of them rebounds. */
static MeBool chooseMeeting(MdtKeaSystem *s, double slowest, double gate, double wanted[], char takesPart[]) {
    MeBool rebounds = MEFALSE;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        takesPart[i] = 0;
        wanted[i] = 0;
        if (row->contact != i || !isTouching(s, row))
            continue;
        const double speed = -rateOf(s, i);
        takesPart[i] = speed > slowest;
        MEASSERT(row->restitution >= 0 && row->restitution <= 1);
        if (takesPart[i] && row->restitution > 0 && speed > keaMax(row->threshold, gate)) {
            wanted[i] = row->restitution * speed;
            rebounds = METRUE;
        }
    }
    return rebounds;
}

/* False: there is no change that energy allows, and the contacts are left to the step. */
static MeBool takeRound(MdtKeaSystem *s, const double wanted[], const char takesPart[]) {
    solveRound(s, wanted, takesPart, s->work->added);
    if (isAffordable(s, s->work->added)) {
        keepImpulses(s);
        addChange(s, s->work->added);
        return METRUE;
    }
    memset(s->work->wanted + s->numRows, 0, (size_t)s->numRows * sizeof(double));
    solveRound(s, s->work->wanted + s->numRows, takesPart, s->work->plastic);
    if (!isAffordable(s, s->work->plastic))
        return MEFALSE;
    keepImpulses(s);
    blend(s, s->work->added, s->work->plastic);
    return METRUE;
}

static void touchAll(MdtKeaSystem *s, double wanted[], char takesPart[]) {
    for (int i = 0; i < s->numRows; i++) {
        wanted[i] = 0;
        takesPart[i] = (char)(s->rows[i].contact == i && isTouching(s, &s->rows[i]));
    }
}

static void commitVelocities(MdtKeaSystem *s) {
    for (int b = 0; b < s->numBodies; b++) {
        keaCopy(s->bodies[b]->velocity, s->velocity[b].lin);
        MdtKeaBodySetAngularVelocity(s->bodies[b], s->velocity[b].ang);
    }
}

void MEAPI MdtKeaImpact(MdtKeaSystem *s) {
    double *wanted = s->work->wanted;
    char *takesPart = s->work->takesPart;
    const double gate = plastic * loadSpeed(s);
    s->work->speed = 0;
    for (int b = 0; b < s->numBodies; b++)
        s->work->speed = keaMax(s->work->speed, keaLength(s->velocity[b].lin));
    setProblem(s);
    if (!kea_problemBegin(&s->work->problem, s->cache))
        return;
    kea_setMeans(s, 1, 1);
    const double before = kineticEnergy(s, NULL);
    kea_problemMeasure(&s->work->problem);
    for (int i = 0; i < s->numRows; i++)
        s->rows[i].force = 0;
    const double slowest = keaMax(1e-9 * loadSpeed(s), simultaneous * s->work->speed);
    for (int round = 0; round < MAX_ROUNDS && chooseMeeting(s, slowest, gate, wanted, takesPart); round++)
        if (!takeRound(s, wanted, takesPart) || s->work->problem.counts.isLimited)
            break;
    touchAll(s, wanted, takesPart);
    takeRound(s, wanted, takesPart);
    MEASSERT(!(kineticEnergy(s, NULL) > before * (1 + 1e-9)));
    commitVelocities(s);
    kea_reportWork(s);
}

/* ---- positions ---- */

static MeBool mustBeMovedOut(const MdtKeaSystem *s, int i, double *error) {
    const MdtKeaRow *row = &s->rows[i];
    double size = HUGE_VAL;
    for (int k = 0; k < 2; k++)
        if (row->body[k] >= 0)
            size = keaMin(size, s->work->body[row->body[k]].size);
    *error = row->error + 0.5 * s->parameters.stepsize * (rateOf(s, i) + kea_endRate(s, i) - row->drift);
    return row->contact == i && !row->isOpen && *error < -touches * size;
}

/* What a soft contact keeps of γ times its overlap. */
static double sagOf(const MdtKeaSystem *s, int i) {
    return s->parameters.stepsize * s->rows[i].softness * s->work->problem.row[i].p;
}

static void displace(MdtKeaSystem *s) {
    for (int b = 0; b < s->numBodies; b++) {
        KeaEnd *end = &s->work->end[b];
        double turn[4];
        keaAddScaled(end->position, 1, s->work->added[b]);
        keaQuaternionExp(turn, s->work->added[b] + 3);
        keaQuaternionProduct(end->quaternion, turn, end->quaternion);
        keaQuaternionNormalize(end->quaternion);
        keaCopy(s->work->endPose[b].pos, end->position);
        keaQuaternionToMatrix(s->work->endPose[b].R, end->quaternion);
    }
}

static void solveDisplacement(MdtKeaSystem *s, const double wanted[]) {
    KeaProblem *q = &s->work->problem;
    memset(s->work->added, 0, (size_t)s->numBodies * sizeof *s->work->added);
    for (int i = 0; i < s->numRows; i++) {
        q->row[i].isOff = !s->work->takesPart[i];
        q->row[i].r = wanted[i];
    }
    for (int pass = 0; pass < 3 && !q->counts.isLimited; pass++) {
        for (int i = 0; i < s->numRows; i++)
            q->row[i].N = 1e-5 * q->row[i].size;
        kea_problemSolve(q, MEFALSE);
        kea_problemCarryOn(q, s->work->added);
    }
}

/* The smallest displacement, in the metric of the masses, that takes γ of every overlap away and makes none deeper. */
void kea_project(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    double *wanted = s->work->wanted, error;
    MeBool isNeeded = MEFALSE;
    for (int i = 0; i < s->numRows; i++) {
        s->work->takesPart[i] = (char)mustBeMovedOut(s, i, &error);
        wanted[i] = s->work->takesPart[i] ? keaMax(-s->parameters.gamma * error - sagOf(s, i), 0) : 0;
        isNeeded = isNeeded || wanted[i] > 0;
    }
    if (!isNeeded)
        return;
    for (int i = 0; i < s->numRows; i++)
        s->work->errors[i] = q->row[i].p;
    for (int b = 0; b < s->numBodies; b++)
        setMetric(s, b);
    for (int i = 0; i < s->numRows; i++) {
        s->work->takesPart[i] = (char)(s->rows[i].contact == i && !s->rows[i].isOpen);
        setRow(s, i);
        q->row[i].isElsewhere = s->rows[i].contact != i;
    }
    kea_problemMeasure(q);
    solveDisplacement(s, wanted);
    for (int i = 0; i < s->numRows; i++)
        q->row[i].p = s->work->errors[i];
    displace(s);
}
