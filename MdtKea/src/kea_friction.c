/* Coulomb friction within one step: bounds μ λ_n with the normal forces of this very step, renewed until they agree.
 *
 * The normal-force model bounds each of the two tangential forces by itself. The cone bounds their size: |λ| <= F = μ
 * λ_n. It is solved with two rows, t and s, that are turned in the plane of contact.
 *   sticking:  both rows are free.
 *   sliding:   λ = -F w / |w| with the slip w. Linearized about a slip along t, that is
 *                  λ_t = -F,   λ_s = -(F / |w|) w_s,
 *              a row at its bound and a row of the compliance |w| / (F h): Newton's method for the direction. After
 *              each solve the rows are turned to the slip that was found; in the end λ_s and w_s vanish.
 */
#include "kea_i.h"

static const double tolerance = 1e-9; /* of a bound; of a right angle */
static const int fullPasses = 10;     /* then bounds move half the way, since a wedge can make them alternate */

/* The normal-force model starts with the last step's normal forces. A cone starts as if it held: what it must bear then
 * points the way in which it slides if it does not. */
double kea_firstFrictionBound(const MdtKeaSystem *s, const MdtKeaRow *row) {
    if (row->normal < 0 || row->partner >= 0)
        return HUGE_VAL;
    return row->friction * fmax(s->rows[row->normal].force, 0);
}

double kea_slip(const MdtKeaSystem *s, int i) {
    const KeaMlcp *p = &s->work->mlcp;
    double w = s->rows[i].softness * p->x[i] - p->b[i];
    for (int j = 0; j < p->n; j++)
        w += p->A[i * p->n + j] * p->x[j];
    return w * s->parameters.stepsize;
}

/* ---- the normal-force model ---- */

static MeBool setBound(MdtKeaSystem *s, int i, double bound) {
    KeaMlcp *p = &s->work->mlcp;
    const MdtKeaRow *row = &s->rows[i];
    if (s->report.passes > fullPasses)
        bound = 0.5 * (bound + fmax(p->upper[i], 0));
    const double lower = fmax(row->lower, -bound), upper = fmin(row->upper, bound);
    const double change = fmax(fabs(upper - p->upper[i]), fabs(lower - p->lower[i]));
    const MeBool isInside = p->set[i] == KEA_FREE && p->x[i] > lower && p->x[i] < upper;
    p->lower[i] = lower;
    p->upper[i] = upper;
    return change > tolerance * bound && !isInside;
}

/* ---- the cone ---- */

static void mix(double *a, double *b, double c, double d) {
    const double t = c * *a + d * *b;
    *b = c * *b - d * *a;
    *a = t;
}

static void mixBlocks(MdtKeaJBlock *a, MdtKeaJBlock *b, double c, double d) {
    for (int i = 0; i < 3; i++) {
        mix(&a->lin[i], &b->lin[i], c, d);
        mix(&a->ang[i], &b->ang[i], c, d);
    }
}

/* Row t becomes c t + d s, and row s becomes c s - d t (c² + d² = 1): Jacobians, what follows from them, and the
 * answer. */
static void turnRows(MdtKeaSystem *s, int t, int k, double c, double d) {
    MdtKeaWork *work = s->work;
    double *A = work->matrix;
    const int n = s->numRows;
    for (int b = 0; b < 2; b++) {
        mixBlocks(&s->rows[t].J[b], &s->rows[k].J[b], c, d);
        mixBlocks(&work->response[t][b], &work->response[k][b], c, d);
    }
    mix(&s->rows[t].target, &s->rows[k].target, c, d);
    mix(&work->freeRate[t], &work->freeRate[k], c, d);
    mix(&work->shift[t], &work->shift[k], c, d);
    mix(&work->mlcp.b[t], &work->mlcp.b[k], c, d);
    mix(&work->mlcp.x[t], &work->mlcp.x[k], c, d);
    mix(&s->rows[t].force, &s->rows[k].force, c, d);
    for (int j = 0; j < n; j++)
        mix(&A[t * n + j], &A[k * n + j], c, d);
    for (int j = 0; j < n; j++)
        mix(&A[j * n + t], &A[j * n + k], c, d);
}

static void setCone(MdtKeaSystem *s, int t, double limit, double compliance) {
    KeaMlcp *p = &s->work->mlcp;
    const int k = s->rows[t].partner;
    p->upper[t] = limit;
    p->lower[t] = -limit;
    p->upper[k] = limit > 0 ? HUGE_VAL : 0;
    p->lower[k] = -p->upper[k];
    p->E[k] = s->rows[k].softness + compliance;
    kea_mlcpRenew(p, t);
    kea_mlcpRenew(p, k);
}

/* Turns row t to where the friction pulls. Returns by how much: the sine. */
static double turnTo(MdtKeaSystem *s, int t, double alongT, double alongS) {
    const double size = hypot(alongT, alongS);
    if (size == 0)
        return 0;
    turnRows(s, t, s->rows[t].partner, alongT / size, alongS / size);
    return alongT < 0 ? 1 : fabs(alongS) / size;
}

static MeBool renewCone(MdtKeaSystem *s, int t, double limit) {
    KeaMlcp *p = &s->work->mlcp;
    const int k = s->rows[t].partner;
    const double before = p->upper[t], h = s->parameters.stepsize;
    const double force[2] = {p->x[t], p->x[k]}, size = hypot(force[0], force[1]);
    const MeBool isFree = p->set[t] == KEA_FREE, isSoft = p->E[k] > s->rows[k].softness;
    if (s->report.passes > fullPasses && isfinite(before))
        limit = 0.5 * (limit + before);
    if (isFree && !isSoft && size <= limit * (1 + tolerance))
        return MEFALSE; /* it sticks, whatever the bounds have been */
    if (isFree) {       /* it held so far, or does so again */
        turnTo(s, t, force[0], force[1]);
        setCone(s, t, limit, 0);
        return METRUE;
    }
    const double slip[2] = {kea_slip(s, t), kea_slip(s, k)};
    const double turned = turnTo(s, t, -slip[0], -slip[1]);
    setCone(s, t, limit, limit > 0 ? hypot(slip[0], slip[1]) / (limit * h) : 0);
    return turned > tolerance || fabs(limit - before) > tolerance * limit || size > limit * (1 + tolerance);
}

/* ---- all ---- */

MeBool kea_renewFriction(MdtKeaSystem *s) {
    MeBool moved = MEFALSE;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if (row->normal < 0 || (row->partner >= 0 && row->partner < i)) /* a cone is done with its first row */
            continue;
        const double limit = row->friction * fmax(s->rows[row->normal].force, 0);
        const MeBool hasMoved = row->partner >= 0 ? renewCone(s, i, limit) : setBound(s, i, limit);
        moved = moved || hasMoved;
    }
    return moved;
}
