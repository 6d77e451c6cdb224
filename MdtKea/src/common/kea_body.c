/* A body at the start and at the end of a step: its prediction without rows, and the commit of its end state. */
#include "kea_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <string.h>

static void setPose(MdtKeaTransformation *pose, const double position[3], const double quaternion[4]) {
    keaCopy(pose->pos, position);
    keaQuaternionToMatrix(pose->R, quaternion);
}

/* Sets r to the solution of dv/dt = scale a - damping v after h seconds; without damping it is exactly v + h scale
 * a. */
static void integrateDamped(double r[3], const double v[3], const double a[3], double scale, double damping, double h) {
    const double x = damping * h;
    MEASSERT(x >= 0);
    const double keep = exp(-x), gain = x > 0 ? -expm1(-x) / x : 1;
    for (int i = 0; i < 3; i++)
        r[i] = keep * v[i] + h * gain * scale * a[i];
}

double kea_bodyExtent(const MdtKeaBody *body) {
    MEASSERT(body->invMass > 0);
    return sqrt(kea_maxOf(body->moments) * body->invMass);
}

/* Sets the velocity and angular momentum that the body would have at the end of the step without rows. */
static void predictBody(MdtKeaSystem *s, int i) {
    const MdtKeaBody *body = s->bodies[i];
    KeaBody *b = &s->work->body[i];
    const double h = s->parameters.stepsize;
    b->size = kea_bodyExtent(body);
    b->locked = body->locked;
    integrateDamped(s->predicted[i].lin, body->velocity, body->force, body->invMass, body->damping[0], h);
    integrateDamped(b->freeMomentum, body->angularMomentum, body->torque, 1, body->damping[1], h);
}

/* Sets the inverse inertia to that with the principal axes R, and the predicted angular velocity to that of the
 * predicted momentum with it. */
static void setInertia(MdtKeaSystem *s, int i, const double R[3][3]) {
    const MdtKeaBody *body = s->bodies[i];
    kea_inverseInertiaBy(body->moments, R, s->invMass[i].inertia);
    if (body->locked)
        kea_dropLockedRotations(body->locked, s->invMass[i].inertia);
    kea_angularVelocityBy(body->moments, R, s->work->body[i].freeMomentum, s->predicted[i].ang);
}

void kea_orientInertia(MdtKeaSystem *s, int i, const double quaternion[4]) {
    double R[3][3];
    kea_principalAxes(s->bodies[i], quaternion, R);
    setInertia(s, i, (const double(*)[3])R);
}

void kea_beginBody(MdtKeaSystem *s, int i) {
    const MdtKeaBody *body = s->bodies[i];
    double R[3][3];
    const double(*axes)[3] = (const double(*)[3])R; /* principal axes */
    setPose(&s->pose[i], body->position, body->quaternion);
    keaCopy(s->velocity[i].lin, body->velocity);
    kea_principalAxes(body, body->quaternion, R);
    kea_angularVelocityBy(body->moments, axes, body->angularMomentum, s->velocity[i].ang);
    s->invMass[i].mass = body->invMass;
    predictBody(s, i);
    setInertia(s, i, axes);
}

/* Stores the acceleration of the step in the body, and replaces `start`, the velocity at the start, by that at the
 * end. */
static void storeAcceleration(MdtKeaBody *body, MdtKeaVelocity *start, double h) {
    double w[3];
    MEASSERT(h > 0);
    MdtKeaBodyGetAngularVelocity(body, w);
    for (int i = 0; i < 3; i++) {
        body->acceleration[i] = (body->velocity[i] - start->lin[i]) / h;
        body->acceleration[3 + i] = (w[i] - start->ang[i]) / h;
        start->lin[i] = body->velocity[i];
        start->ang[i] = w[i];
    }
}

/* Copies the end state to the body. Without the Coriolis term the angular velocity is constant, and the momentum is
 * computed anew for the new orientation. */
static void commitState(MdtKeaBody *body, const KeaEnd *end) {
    double w[3];
    const MeBool steady = kea_isSteady(body);
    if (steady)
        kea_angularVelocity(body, body->quaternion, end->angularMomentum, w);
    keaCopy(body->position, end->position);
    memcpy(body->quaternion, end->quaternion, sizeof body->quaternion);
    keaCopy(body->velocity, end->velocity);
    keaCopy(body->angularMomentum, end->angularMomentum);
    if (steady)
        MdtKeaBodySetAngularVelocity(body, w);
}

void kea_commitBody(MdtKeaSystem *s, int i) {
    MEASSERT(fabs(keaDot(s->work->end[i].quaternion, s->work->end[i].quaternion) +
                  s->work->end[i].quaternion[3] * s->work->end[i].quaternion[3] - 1) < kea_assertedRounding);
    MEASSERT(s->work->end[i].theta >= 0.5 && s->work->end[i].theta <= 1);
    commitState(s->bodies[i], &s->work->end[i]);
    const double signedStep = s->parameters.isBack ? -s->parameters.stepsize : s->parameters.stepsize;
    s->bodies[i]->fall += signedStep * (s->parameters.elapsed + s->work->end[i].theta * signedStep);
    storeAcceleration(s->bodies[i], &s->velocity[i], s->parameters.stepsize);
    s->pose[i] = s->work->endPose[i];
}

void MEAPI MdtKeaMoverPose(const MdtKeaMover *mover, double time, MdtKeaTransformation *pose) {
    double position[3], rotation[3], turn[4], q[4];
    keaCopy(position, mover->position);
    keaAddScaled(position, time, mover->velocity.lin);
    keaScale(rotation, time, mover->velocity.ang);
    keaQuaternionExp(turn, rotation);
    keaQuaternionProduct(q, turn, mover->quaternion);
    setPose(pose, position, q);
}
