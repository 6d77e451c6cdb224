/* The system of one partition: memory, predictions, A = J M⁻¹ Jᵀ, and where given forces take the bodies. */
#include "kea_i.h"
#include <stdint.h>
#include <string.h>

static void layOut(MdtKeaSystem *s, KeaArena *arena) {
    const size_t n = (size_t)s->numBodies, m = (size_t)s->maxRows;
    s->pose = kea_carve(arena, n, sizeof *s->pose);
    s->velocity = kea_carve(arena, n, sizeof *s->velocity);
    s->predicted = kea_carve(arena, n, sizeof *s->predicted);
    s->invMass = kea_carve(arena, n, sizeof *s->invMass);
    s->rows = kea_carve(arena, m, sizeof *s->rows);
    MdtKeaWork *work = kea_carve(arena, 1, sizeof *work), measured;
    s->work = work;
    if (!work)
        work = &measured;
    work->freeMomentum = kea_carve(arena, n, sizeof *work->freeMomentum);
    work->freeVelocity = kea_carve(arena, n, sizeof *work->freeVelocity);
    work->end = kea_carve(arena, n, sizeof *work->end);
    work->endPose = kea_carve(arena, n, sizeof *work->endPose);
    work->response = kea_carve(arena, m, sizeof *work->response);
    work->freeRate = kea_carve(arena, m, sizeof(double));
    work->shift = kea_carve(arena, m, sizeof(double));
    work->errors = kea_carve(arena, m, sizeof(double));
    work->matrix = kea_carve(arena, m * m, sizeof(double));
    kea_mlcpInit(&work->mlcp, s->maxRows, work->matrix, arena);
}

size_t MEAPI MdtKeaScratchSize(int numBodies, int maxRows) {
    MdtKeaSystem s;
    memset(&s, 0, sizeof s);
    s.numBodies = numBodies > 0 ? numBodies : 0;
    s.maxRows = maxRows > 0 ? maxRows : 0;
    KeaArena measure = {NULL, 0};
    layOut(&s, &measure);
    return measure.used;
}

int MEAPI MdtKeaMemoryRequired(const int num_rows_exc_padding[], int num_partitions, int max_rows, int max_bodies) {
    size_t most = 0;
    for (int i = 0; i < num_partitions; i++) {
        const size_t bytes = MdtKeaScratchSize(max_bodies, num_rows_exc_padding ? num_rows_exc_padding[i] : max_rows);
        most = bytes > most ? bytes : most;
    }
    return most > (size_t)INT32_MAX ? INT32_MAX : (int)most;
}

static void setPose(MdtKeaTransformation *pose, const double position[3], const double quaternion[4]) {
    keaCopy(pose->pos, position);
    keaQuaternionToMatrix(pose->R, quaternion);
}

/* The solution of dv/dt = a - d v after h seconds; without damping exactly v + h a. */
static void advance(double r[3], const double v[3], const double a[3], double scale, double damping, double h) {
    const double x = damping * h;
    const double keep = exp(-x), gain = x > 0 ? -expm1(-x) / x : 1;
    for (int i = 0; i < 3; i++)
        r[i] = keep * v[i] + h * gain * scale * a[i];
}

/* Velocity and momentum at the end of the step without constraints, and the rates that they mean at the start's pose:
 * the forces of the rows change the momenta of just this pose, so that rows solved for it hold whatever the free body
 * would have done. */
static void predict(MdtKeaSystem *s, int i) {
    const MdtKeaBody *body = s->bodies[i];
    MdtKeaWork *work = s->work;
    const double h = s->parameters.stepsize;
    advance(work->freeVelocity[i], body->velocity, body->force, body->invMass, body->linearDamping, h);
    advance(work->freeMomentum[i], body->angularMomentum, body->torque, 1, body->angularDamping, h);
    keaCopy(s->predicted[i].lin, work->freeVelocity[i]);
    kea_angularVelocity(body, body->quaternion, work->freeMomentum[i], s->predicted[i].ang);
}

void MEAPI MdtKeaInit(MdtKeaSystem *s, void *scratch) {
    KeaArena arena = {scratch, 0};
    s->numRows = 0;
    memset(&s->report, 0, sizeof s->report);
    layOut(s, &arena);
    for (int i = 0; i < s->numBodies; i++) {
        const MdtKeaBody *body = s->bodies[i];
        setPose(&s->pose[i], body->position, body->quaternion);
        keaCopy(s->velocity[i].lin, body->velocity);
        MdtKeaBodyGetAngularVelocity(body, s->velocity[i].ang);
        s->invMass[i].mass = body->invMass;
        kea_inverseInertia(body, body->quaternion, s->invMass[i].inertia);
        predict(s, i);
    }
}

static void respond(MdtKeaJBlock *response, const MdtKeaJBlock *J, const MdtKeaInverseMassMatrix *m) {
    keaScale(response->lin, m->mass, J->lin);
    keaApply(response->ang, (const double(*)[3])m->inertia, J->ang);
}

/* J_i M⁻¹ J_jᵀ: the sum over the bodies that both rows act on. */
static double coupling(const MdtKeaRow *row, const MdtKeaRow *other, const MdtKeaJBlockPair response) {
    double sum = 0;
    for (int k = 0; k < 2; k++)
        for (int l = 0; l < 2; l++)
            if (row->body[k] >= 0 && row->body[k] == other->body[l])
                sum += keaDot(row->J[k].lin, response[l].lin) + keaDot(row->J[k].ang, response[l].ang);
    return sum;
}

void kea_assemble(MdtKeaSystem *s) {
    MdtKeaWork *work = s->work;
    const int m = s->numRows;
    for (int i = 0; i < m; i++) {
        const MdtKeaRow *row = &s->rows[i];
        work->freeRate[i] = 0;
        for (int k = 0; k < 2; k++) {
            if (row->body[k] < 0)
                continue;
            const MdtKeaVelocity *v = &s->predicted[row->body[k]];
            work->freeRate[i] += keaDot(row->J[k].lin, v->lin) + keaDot(row->J[k].ang, v->ang);
            respond(&work->response[i][k], &row->J[k], &s->invMass[row->body[k]]);
        }
        for (int j = 0; j <= i; j++) {
            const double a = coupling(row, &s->rows[j], work->response[j]);
            work->matrix[i * m + j] = work->matrix[j * m + i] = a;
        }
    }
}

/* How far the springs of the system move row i in a step: h² Σ |A_ij| kp_j for the stiffness, h Σ |A_ij| kd_j for the
 * damping. By Gershgorin's theorem no combination of the springs is stiffer than the largest of these. */
static void springiness(const MdtKeaSystem *s, int i, double *stiff, double *damped) {
    const double h = s->parameters.stepsize, *A = s->work->matrix + (size_t)i * (size_t)s->numRows;
    *stiff = *damped = 0;
    for (int j = 0; j < s->numRows; j++) {
        if (!s->rows[j].spring)
            continue;
        *stiff += h * h * fabs(A[j]) * s->rows[j].stiffness;
        *damped += h * fabs(A[j]) * s->rows[j].damping;
    }
}

static double rateNow(const MdtKeaSystem *s, const MdtKeaRow *row) {
    double rate = 0;
    for (int k = 0; k < 2; k++) {
        if (row->body[k] < 0)
            continue;
        const MdtKeaVelocity *v = &s->velocity[row->body[k]];
        rate += keaDot(row->J[k].lin, v->lin) + keaDot(row->J[k].ang, v->ang);
    }
    return rate;
}

/* λ = -kp (φ + a h u⁺) - kd ((1 - b) u + b u⁺) with u the rate, as a row u⁺ = s - h E λ:
 *     C = a h kp + b kd,   s = -(kp φ + (1 - b) kd u) / C,   E = 1 / (h C).
 * a = 0, b = 1/2 is the spring of the leapfrog and of the midpoint rule: no numerical damping, frequency and decay
 * right to second order. Where that would be unstable, for stiff springs on light bodies, a and b grow towards 1, the
 * backward Euler rule, which no stiffness makes gain energy. With K and D the springiness of the row, a and b are the
 * least that bring K / (1 + a K) <= 1 and (1 - b) D <= 1; the leapfrog itself is stable up to K = 4. */
static void makeSpring(const MdtKeaSystem *s, int i) {
    MdtKeaRow *row = &s->rows[i];
    const double h = s->parameters.stepsize, kp = row->stiffness, kd = row->damping, rest = row->target;
    double K, D;
    springiness(s, i, &K, &D);
    const double a = K > 1 ? 1 - 1 / K : 1e-9; /* not 0: a row without compliance has no E */
    const double b = D > 2 ? 1 - 1 / D : 0.5;
    const double C = a * h * kp + b * kd;
    if (!(C > 0)) { /* neither stiffness nor damping: no force */
        row->lower = row->upper = 0;
        return;
    }
    row->target = rest - (kp * row->error + (1 - b) * kd * (rateNow(s, row) - rest)) / C;
    row->softness = 1 / (h * C);
}

void kea_makeSprings(MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].spring)
            makeSpring(s, i);
}

void kea_moveWithForces(MdtKeaSystem *s) {
    MdtKeaWork *work = s->work;
    const double h = s->parameters.stepsize;
    for (int i = 0; i < s->numBodies; i++) {
        keaCopy(work->end[i].velocity, work->freeVelocity[i]);
        keaCopy(work->end[i].angularMomentum, work->freeMomentum[i]);
    }
    for (int i = 0; i < s->numRows; i++) {
        const MdtKeaRow *row = &s->rows[i];
        for (int k = 0; k < 2; k++) {
            if (row->body[k] < 0)
                continue;
            keaAddScaled(work->end[row->body[k]].velocity, h * row->force, work->response[i][k].lin);
            keaAddScaled(work->end[row->body[k]].angularMomentum, h * row->force, row->J[k].ang);
        }
    }
    for (int i = 0; i < s->numBodies; i++) {
        const MdtKeaBody *body = s->bodies[i];
        KeaEnd *end = &work->end[i];
        keaCopy(end->position, body->position);
        keaAddScaled(end->position, h, end->velocity);
        kea_rotateFree(body, body->quaternion, end->angularMomentum, h, end->quaternion);
        setPose(&work->endPose[i], end->position, end->quaternion);
    }
}
