/* Joints among the manifolds of the fast solver: the rows of bodies that joints tie together, directly or through
 * others, are one block, solved at once in each pass by a dense factor of J M⁻¹ Jᵀ + E; rows with bounds follow one by
 * one, projected.
 *
 * Velocities: J v⁺ = t - E p. A position row has no part of its error in t, but for a stop that may close; a spring is
 * implicit, E = 1 / (h (h k + d)), t = E h (d s - k φ). Positions: what the velocities leave of
 *
 *     φ(x⁺) = φ(x) + h (s - E p)
 *
 * is taken away by displacements.
 */
#include "fast/kea_joints_i.h"
#include "inner/kea_factor_i.h"
#include "common/kea_policy_i.h"
#include "MeAssert.h"
#include <string.h>

/* ---- which rows are tied together ---- */

static int rootOf(int parent[], int i) {
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

static int bodyOf(const MdtKeaRow *row) {
    return row->body[0] >= 0 ? row->body[0] : row->body[1];
}

static void join(const MdtKeaSystem *s, int parent[]) {
    for (int i = 0; i < s->numBodies; i++)
        parent[i] = i;
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        if (row->body[0] < 0 || row->body[1] < 0)
            continue;
        const int a = rootOf(parent, row->body[0]), b = rootOf(parent, row->body[1]);
        parent[a > b ? a : b] = a > b ? b : a;
    }
}

/* By the first body of their block, in their order: a counting sort. Returns how many blocks there are. */
static int sortRows(const MdtKeaSystem *s, KeaJoints *j) {
    int blocks = 0, at = 0;
    memset(j->count, 0, (size_t)s->numBodies * sizeof *j->count);
    for (int i = 0; i < s->numRows; i++)
        j->count[rootOf(j->parent, bodyOf(&s->rows[i]))]++;
    for (int b = 0; b < s->numBodies; b++) {
        const int here = j->count[b];
        j->count[b] = at;
        if (here > 0)
            j->block[blocks++].first = at;
        at += here;
    }
    j->block[blocks].first = at;
    for (int i = 0; i < s->numRows; i++)
        j->row[j->count[rootOf(j->parent, bodyOf(&s->rows[i]))]++].index = i;
    return blocks;
}

/* ---- rows ---- */

static MeBool isTwoSided(const MdtKeaRow *row) {
    return row->lower == -HUGE_VAL && row->upper == HUGE_VAL;
}

/* J M⁻¹ Jᵀ of two rows, of which the other's response is known. */
static double mobilityOf(const MdtKeaRow *row, const KeaJointRow *b, const MdtKeaRow *other) {
    double sum = 0;
    for (int k = 0; k < 2; k++)
        for (int m = 0; m < 2; m++)
            if (row->body[k] >= 0 && row->body[k] == other->body[m])
                sum += keaDot(row->J[k].lin, b->response[m]) + keaDot(row->J[k].ang, b->response[m] + 3);
    return sum;
}

static void setResponse(const MdtKeaSystem *s, const MdtKeaRow *row, KeaJointRow *r) {
    memset(r->response, 0, sizeof r->response);
    for (int k = 0; k < 2; k++) {
        if (row->body[k] < 0)
            continue;
        const MdtKeaInverseMassMatrix *m = &s->invMass[row->body[k]];
        keaScale(r->response[k], m->mass, row->J[k].lin);
        keaApply(r->response[k] + 3, (const double(*)[3])m->inertia, row->J[k].ang);
    }
}

/* A spring without stiffness and damping is none. */
static void setSpring(const MdtKeaSystem *s, const MdtKeaRow *row, KeaJointRow *r) {
    const double h = s->parameters.stepsize, hold = h * (h * row->stiffness + row->damping);
    r->isOff = !(hold > 0);
    r->compliance = r->isOff ? 0 : 1 / hold;
    r->target = r->compliance * h * (row->damping * row->target - row->stiffness * row->error);
}

static void setPosition(const MdtKeaSystem *s, const MdtKeaRow *row, KeaJointRow *r) {
    const double h = s->parameters.stepsize;
    const MeBool isSoft = row->softness > kea_softShare * r->size;
    r->isHeld = !isSoft && (isTwoSided(row) || row->lower == 0 || row->upper == 0);
    if (!r->isHeld)
        return;
    r->compliance = 0;
    r->wanted = row->error + h * row->target;
    r->target = isTwoSided(row)   ? row->drift
                : row->lower == 0 ? keaMin(row->target, row->drift)
                                  : keaMax(row->target, row->drift);
}

static void setRow(const MdtKeaSystem *s, const int place[], KeaJointRow *r) {
    const MdtKeaRow *row = &s->rows[r->index];
    const double h = s->parameters.stepsize;
    for (int k = 0; k < 2; k++)
        r->motion[k] = row->body[k] >= 0 ? 1 + place[row->body[k]] : 0;
    setResponse(s, row, r);
    r->size = mobilityOf(row, r, row);
    r->isOff = !(r->size > 0);
    r->isHeld = MEFALSE;
    r->isBounded = !isTwoSided(row);
    r->target = row->target;
    r->compliance = row->softness;
    r->wanted = 0;
    if (row->spring)
        setSpring(s, row, r);
    else if (row->position)
        setPosition(s, row, r);
    r->lower = h * row->lower;
    r->upper = h * row->upper;
    r->impulse = r->before = r->isOff ? 0 : keaMin(keaMax(h * row->force, r->lower), r->upper);
}

/* ---- factors ---- */

/* L D Lᵀ in place; a row that others imply is left out: its pivot vanishes. */
static void factor(double *A, int n) {
    for (int j = 0; j < n; j++) {
        const double before = A[j * n + j];
        for (int k = 0; k < j; k++)
            A[j * n + j] -= A[j * n + k] * A[j * n + k] * A[k * n + k];
        if (!(A[j * n + j] > kea_redundantPivot * before)) {
            A[j * n + j] = 0;
            for (int i = j + 1; i < n; i++)
                A[i * n + j] = 0;
            continue;
        }
        for (int i = j + 1; i < n; i++) {
            for (int k = 0; k < j; k++)
                A[i * n + j] -= A[i * n + k] * A[j * n + k] * A[k * n + k];
            A[i * n + j] /= A[j * n + j];
        }
    }
}

static void solve(const double *A, int n, double x[]) {
    for (int i = 0; i < n; i++)
        for (int k = 0; k < i; k++)
            x[i] -= A[i * n + k] * x[k];
    for (int i = 0; i < n; i++)
        x[i] = A[i * n + i] > 0 ? x[i] / A[i * n + i] : 0;
    for (int i = n - 1; i >= 0; i--)
        for (int k = i + 1; k < n; k++)
            x[i] -= A[k * n + i] * x[k];
}

/* The rows without bounds come first. */
static int partition(KeaJointRow rows[], int count) {
    int free = 0;
    for (int i = 0; i < count; i++)
        if (!rows[i].isBounded && !rows[i].isOff) {
            const KeaJointRow row = rows[i];
            memmove(&rows[free + 1], &rows[free], (size_t)(i - free) * sizeof *rows);
            rows[free++] = row;
        }
    return free;
}

static void fillFactor(const MdtKeaSystem *s, KeaJoints *j, KeaJointBlock *b) {
    const KeaJointRow *rows = &j->row[b->first];
    const int n = b->numFree;
    for (int i = 0; i < n; i++)
        for (int k = 0; k <= i; k++)
            b->factor[i * n + k] = mobilityOf(&s->rows[rows[i].index], &rows[k], &s->rows[rows[k].index]) +
                                   (i == k ? rows[i].compliance : 0);
    factor(b->factor, n);
}

void kea_jointsRefill(const MdtKeaSystem *s, KeaJoints *j) {
    for (int i = 0; i < j->numBlocks; i++) {
        KeaJointBlock *b = &j->block[i];
        for (int k = 0; k < b->count; k++) {
            KeaJointRow *r = &j->row[b->first + k];
            setResponse(s, &s->rows[r->index], r);
            r->size = mobilityOf(&s->rows[r->index], r, &s->rows[r->index]);
        }
        fillFactor(s, j, b);
    }
}

size_t kea_jointsLayOut(const MdtKeaSystem *s, KeaJoints *j, char *memory) {
    KeaArena arena = {memory, 0};
    const size_t n = (size_t)s->numBodies, m = (size_t)s->numRows;
    j->parent = kea_carve(&arena, n, sizeof *j->parent);
    j->count = kea_carve(&arena, n, sizeof *j->count);
    j->row = kea_carve(&arena, m, sizeof *j->row);
    j->block = kea_carve(&arena, m + 1, sizeof *j->block);
    j->x = kea_carve(&arena, m, sizeof *j->x);
    j->errors = kea_carve(&arena, m, sizeof *j->errors);
    return arena.used;
}

MeBool kea_jointsBegin(MdtKeaSystem *s, const int place[], KeaJoints *j) {
    size_t doubles = 0;
    j->numBlocks = 0;
    if (s->numRows == 0)
        return METRUE;
    char *memory = kea_cacheScratch(s->cache, KEA_JOINT_BLOCK, kea_jointsLayOut(s, j, NULL));
    if (!memory)
        return MEFALSE;
    kea_jointsLayOut(s, j, memory);
    join(s, j->parent);
    j->numBlocks = sortRows(s, j);
    for (int i = 0; i < j->numBlocks; i++) {
        KeaJointBlock *b = &j->block[i];
        b->count = b[1].first - b->first;
        for (int k = 0; k < b->count; k++)
            setRow(s, place, &j->row[b->first + k]);
        b->numFree = partition(&j->row[b->first], b->count);
        doubles += (size_t)b->numFree * (size_t)b->numFree;
    }
    double *factors = kea_cacheScratch(s->cache, KEA_JOINT_FACTOR_BLOCK, doubles * sizeof *factors + sizeof *factors);
    if (!factors)
        return MEFALSE;
    for (int i = 0; i < j->numBlocks; i++) {
        j->block[i].factor = factors;
        factors += j->block[i].numFree * j->block[i].numFree;
        fillFactor(s, j, &j->block[i]);
    }
    return METRUE;
}

/* ---- passes ---- */

static double rateOf(const MdtKeaRow *row, const KeaJointRow *r, const KeaMotion motion[]) {
    double rate = 0;
    for (int k = 0; k < 2; k++)
        if (r->motion[k] > 0) {
            const KeaMotion *m = &motion[r->motion[k]];
            for (int i = 0; i < 3; i++)
                rate += row->J[k].lin[i] * (double)m->lin[i] + row->J[k].ang[i] * (double)m->ang[i];
        }
    return rate;
}

static void push(const KeaJointRow *r, double impulse, KeaMotion motion[]) {
    for (int k = 0; k < 2; k++)
        if (r->motion[k] > 0) {
            KeaMotion *m = &motion[r->motion[k]];
            for (int i = 0; i < 3; i++) {
                m->lin[i] = (float)((double)m->lin[i] + impulse * r->response[k][i]);
                m->ang[i] = (float)((double)m->ang[i] + impulse * r->response[k][3 + i]);
            }
        }
}

void kea_jointsApply(const MdtKeaSystem *s, const KeaJoints *j, KeaMotion motion[]) {
    for (int i = 0; i < s->numRows; i++)
        push(&j->row[i], j->row[i].impulse, motion);
}

static double take(KeaJointRow *r, double guess, double next) {
    const double uphill = -(next - guess) * (next - r->impulse);
    r->before = r->impulse;
    r->impulse = next;
    return uphill;
}

double kea_jointsPass(const MdtKeaSystem *s, KeaJoints *j, KeaMotion motion[], double beta) {
    double uphill = 0;
    for (int i = 0; i < j->numBlocks; i++) {
        KeaJointBlock *b = &j->block[i];
        KeaJointRow *rows = &j->row[b->first];
        for (int k = 0; k < b->numFree; k++) {
            const double guess = rows[k].impulse + beta * (rows[k].impulse - rows[k].before);
            j->x[k] = rows[k].target - rateOf(&s->rows[rows[k].index], &rows[k], motion) - rows[k].compliance * guess;
        }
        solve(b->factor, b->numFree, j->x);
        for (int k = 0; k < b->numFree; k++) {
            const double guess = rows[k].impulse + beta * (rows[k].impulse - rows[k].before);
            push(&rows[k], j->x[k], motion);
            uphill += take(&rows[k], guess, guess + j->x[k]);
        }
        for (int k = b->numFree; k < b->count; k++) {
            KeaJointRow *r = &rows[k];
            const MdtKeaRow *row = &s->rows[r->index];
            const double guess = r->impulse + beta * (r->impulse - r->before);
            if (r->isOff)
                continue;
            const double off = r->target - rateOf(row, r, motion) - r->compliance * guess;
            const double next = keaMin(keaMax(guess + off / (r->size + r->compliance), r->lower), r->upper);
            push(r, next - guess, motion);
            uphill += take(r, guess, next);
        }
    }
    return uphill;
}

double kea_jointsResidual(const MdtKeaSystem *s, const KeaJoints *j, const KeaMotion motion[]) {
    double most = 0;
    for (int i = 0; i < s->numRows; i++) {
        const KeaJointRow *r = &j->row[i];
        const MdtKeaRow *row = &s->rows[r->index];
        if (r->isOff)
            continue;
        const double off = r->target - rateOf(row, r, motion) - r->compliance * r->impulse,
                     size = r->size + r->compliance;
        const double next = keaMin(keaMax(r->impulse + off / size, r->lower), r->upper);
        most = keaMax(most, fabs(next - r->impulse) * size * kea_lengthOf(s, row));
    }
    return most;
}

/* ---- positions ---- */

void kea_jointsAdvance(MdtKeaSystem *s, KeaJoints *j, const KeaMotion way[]) {
    const double h = s->parameters.stepsize;
    if (s->numRows == 0 || !s->errors)
        return;
    if (s->jacobians) {
        s->jacobians(s->context, s->work->endPose);
        kea_jointsRefill(s, j);
    }
    s->errors(s->context, s->work->endPose, j->errors);
    for (int i = 0; i < s->numRows; i++) {
        KeaJointRow *r = &j->row[i];
        if (r->isHeld)
            r->gap = j->errors[r->index] - (r->wanted - h * s->rows[r->index].softness * r->impulse) -
                     rateOf(&s->rows[r->index], r, way);
    }
}

void kea_jointsPush(const MdtKeaSystem *s, KeaJoints *j, KeaMotion way[]) {
    for (int i = 0; i < j->numBlocks && s->errors; i++) {
        KeaJointBlock *b = &j->block[i];
        const KeaJointRow *rows = &j->row[b->first];
        for (int k = 0; k < b->numFree; k++)
            j->x[k] = rows[k].isHeld ? -(rows[k].gap + rateOf(&s->rows[rows[k].index], &rows[k], way)) : 0;
        solve(b->factor, b->numFree, j->x);
        for (int k = 0; k < b->numFree; k++)
            if (rows[k].isHeld)
                push(&rows[k], j->x[k], way);
        for (int k = b->numFree; k < b->count; k++) {
            const MdtKeaRow *row = &s->rows[rows[k].index];
            if (!rows[k].isHeld || rows[k].isOff)
                continue;
            const double need = -(rows[k].gap + rateOf(row, &rows[k], way)) / rows[k].size;
            push(&rows[k], row->lower == 0 ? keaMax(need, 0) : keaMin(need, 0), way);
        }
    }
}

/* ---- rebounds, and the end ---- */

MeBool kea_jointsRebound(const MdtKeaSystem *s, KeaJoints *j) {
    MeBool isAny = MEFALSE;
    for (int i = 0; i < s->numRows; i++) {
        KeaJointRow *r = &j->row[i];
        const MdtKeaRow *row = &s->rows[r->index];
        if (row->bounces && r->impulse > 0) {
            r->target = row->rebound;
            isAny = METRUE;
        }
    }
    return isAny;
}

void kea_jointsAddImpulses(const MdtKeaSystem *s, const KeaJoints *j, double (*change)[6]) {
    for (int i = 0; i < s->numRows; i++) {
        const KeaJointRow *r = &j->row[i];
        const MdtKeaRow *row = &s->rows[r->index];
        for (int k = 0; k < 2; k++)
            if (r->motion[k] > 0) {
                keaAddScaled(change[r->motion[k] - 1], r->impulse, row->J[k].lin);
                keaAddScaled(change[r->motion[k] - 1] + 3, r->impulse, row->J[k].ang);
            }
    }
}

void kea_jointsReturn(MdtKeaSystem *s, const KeaJoints *j) {
    for (int i = 0; i < s->numRows; i++) {
        s->rows[j->row[i].index].force = j->row[i].impulse / s->parameters.stepsize;
        s->rows[j->row[i].index].ripple = 0;
    }
}
