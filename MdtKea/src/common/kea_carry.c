/* What stands on a mover moves with it, also when the mover's velocity changes.
 *
 * A mover moves with one velocity V through the whole step, so its velocity changes by a jump D = V - V_before when the
 * step begins. A body that sticks to it has V_before at the start and V at the end, and moves by their mean: it would
 * lag by h/2 D, which adds up to half a step's way while a platform starts. So it is displaced by what it lacks of the
 * way that it would have made with D from the start on, h (1 - θ) D: along the surface, and along the normal where the
 * mover begins to go away and the body comes along. (Where it comes nearer, that is an impact.) Otherwise the body
 * falls behind, flies in the next step, and slides. Bodies that stick to such a body are displaced likewise. Joints
 * hold the places of their bodies, which are left out.
 */
#include "common/kea_anchor_i.h"
#include "common/kea_policy_i.h"
#include "MeAssert.h"
#include <string.h>

static MeBool hasJump(const MdtKeaMover *m) {
    return m && keaDot(m->jump.lin, m->jump.lin) + keaDot(m->jump.ang, m->jump.ang) > 0;
}

/* A linear velocity at a place, from that of a frame at its origin. */
static void velocityAt(const double origin[3], const MdtKeaVelocity *v, const double place[3], double at[3]) {
    double arm[3];
    keaSubtract(arm, place, origin);
    keaCross(at, v->ang, arm);
    keaAddScaled(at, 1, v->lin);
}

/* The same along the surface, and the spin about the normal. */
static void alongSurface(const double normal[3], const double origin[3], const MdtKeaVelocity *v, const double place[3],
                         double at[6]) {
    velocityAt(origin, v, place, at);
    keaAddScaled(at, -keaDot(at, normal), normal);
    keaScale(at + 3, keaDot(v->ang, normal), normal);
}

/* m/s: the magnitude of a body's velocity. */
static double speedOf(const MdtKeaSystem *s, int body, const double v[6]) {
    return keaLength(v) + s->work->body[body].size * keaLength(v + 3);
}

/* Whether the body, at a place, has the velocity of the mover, less `jump`, but for a small share of `whole`. */
static MeBool follows(const MdtKeaSystem *s, const double normal[3], const MdtKeaMover *mover, const double origin[3],
                      int body, const double place[3], const MdtKeaVelocity *own, const double jump[6], double whole) {
    double of[6], slip[6];
    alongSurface(normal, origin, &mover->chord, place, of);
    alongSurface(normal, place, own, place, slip);
    for (int i = 0; i < 6; i++)
        slip[i] -= of[i] - (jump ? jump[i] : 0);
    return speedOf(s, body, slip) < kea_stickingSlip * whole;
}

/* Whether the body has stuck to the mover before its jump, and sticks to it at the end. */
static MeBool sticks(const MdtKeaSystem *s, const double normal[3], const MdtKeaMover *mover, int body,
                     const double jump[6]) {
    const KeaEnd *end = &s->work->end[body];
    const double whole = speedOf(s, body, jump);
    double origin[3];
    MdtKeaVelocity v;
    if (!follows(s, normal, mover, mover->position, body, s->pose[body].pos, &s->velocity[body], jump, whole))
        return MEFALSE;
    keaCopy(origin, mover->position);
    keaAddScaled(origin, s->parameters.stepsize, mover->velocity.lin);
    keaCopy(v.lin, end->velocity);
    kea_angularVelocity(s->bodies[body], end->quaternion, end->angularMomentum, v.ang);
    return follows(s, normal, mover, origin, body, end->position, &v, NULL, whole);
}

/* m/s: the jump along the normal, if the mover goes away and the body comes along; side: 1 for the manifold's first
 * body, -1. */
static double dropOf(const MdtKeaSystem *s, const double normal[3], double side, const MdtKeaMover *mover, int body) {
    double jump[3], of[3];
    velocityAt(mover->position, &mover->jump, s->pose[body].pos, jump);
    velocityAt(mover->position, &mover->velocity, s->pose[body].pos, of);
    const double along = keaDot(jump, normal);
    const double behind = keaDot(s->work->end[body].velocity, normal) - keaDot(of, normal);
    return side * along < 0 && fabs(behind) < kea_stickingSlip * fabs(along) ? along : 0;
}

static MeBool pushes(const MdtKeaManifold *m) {
    for (int i = 0; i < m->numPoints; i++)
        if (m->point[i].force[0] > 0)
            return METRUE;
    return MEFALSE;
}

/* Carries a body of the manifold that is not carried yet. Returns whether there is one. */
static MeBool carryOver(const MdtKeaSystem *s, const MdtKeaManifold *m, const MdtKeaMover *carrier[]) {
    for (int k = 0; k < 2; k++) {
        const int body = m->body[k], other = m->body[1 - k];
        const MdtKeaMover *mover = other < 0 ? m->mover : carrier[other];
        if (body < 0 || carrier[body] || !hasJump(mover) || s->work->body[body].isTied || !pushes(m))
            continue;
        double *jump = s->work->added[body];
        alongSurface(m->normal, mover->position, &mover->jump, s->pose[body].pos, jump);
        kea_dropLocked(s->work->body[body].locked, jump);
        const double drop = dropOf(s, m->normal, k == 0 ? 1 : -1, mover, body);
        const MeBool isCarried = sticks(s, m->normal, mover, body, jump);
        if (!isCarried && drop == 0)
            continue;
        if (!isCarried)
            memset(jump, 0, 6 * sizeof *jump);
        keaAddScaled(jump, drop, m->normal);
        kea_dropLocked(s->work->body[body].locked, jump);
        carrier[body] = mover;
        return METRUE;
    }
    return MEFALSE;
}

static void displace(MdtKeaSystem *s, int body, const double jump[6]) {
    KeaEnd *end = &s->work->end[body];
    const double time = (1 - end->theta) * s->parameters.stepsize;
    double rotation[3], turn[4];
    keaAddScaled(end->position, time, jump);
    keaScale(rotation, time, jump + 3);
    keaQuaternionExp(turn, rotation);
    keaQuaternionProduct(end->quaternion, turn, end->quaternion);
    keaQuaternionNormalize(end->quaternion);
    kea_setPoses(s, body);
}

void kea_carryBodies(MdtKeaSystem *s) {
    MeBool isAny = MEFALSE;
    if (s->parameters.elapsed + s->parameters.late > 0)
        return;
    for (int i = 0; i < s->numManifolds && !isAny; i++)
        isAny = hasJump(s->manifolds[i].mover);
    if (!isAny)
        return;
    memset(s->work->carrier, 0, (size_t)s->numBodies * sizeof *s->work->carrier);
    for (int sweep = 0; sweep < s->numBodies && isAny; sweep++) {
        isAny = MEFALSE;
        for (int i = 0; i < s->numManifolds; i++)
            isAny |= carryOver(s, &s->manifolds[i], s->work->carrier);
    }
    for (int i = 0; i < s->numBodies; i++)
        if (s->work->carrier[i])
            displace(s, i, s->work->added[i]);
}
