/* What sticks to a body whose velocity changes at once moves with it.
 *
 * A mover moves with one velocity V through the whole step, so its velocity changes by a jump D = V - V_before when the
 * step begins. A body that sticks to it has V_before at the start and V at the end, and moves by their mean: it would
 * lag by h/2 D, which adds up to half a step's way while a platform starts. So it is displaced by what it lacks of the
 * way that it would have made with D from the start on, h (1 - θ) D: along the surface, and along the normal where the
 * mover begins to go away and the body comes along. (Where it comes nearer, that is an impact.) Otherwise the body
 * falls behind, flies in the next step, and slides. Bodies that stick to such a body are displaced likewise.
 *
 * Joints of a mover take their bodies along in the same way, as fingers on a hand: such a body moves by u, not by the
 * mean of v and v⁺, and D = 2 u - v - v⁺ is its jump. Joints hold the places of their bodies, which
 * carry others, but are not carried.
 */
#include "common/kea_anchor_i.h"
#include "common/kea_policy_i.h"
#include "MeAssert.h"
#include <string.h>

/* The motion of what carries, at the start and at the end of the step; its jump. */
typedef struct Carrier {
    double position[2][3];
    MdtKeaVelocity velocity[2], jump;
} Carrier;

static MeBool hasJump(const MdtKeaVelocity *jump) {
    return keaDot(jump->lin, jump->lin) + keaDot(jump->ang, jump->ang) > 0;
}

static void addVelocity(MdtKeaVelocity *v, double factor, const MdtKeaVelocity *other) {
    keaAddScaled(v->lin, factor, other->lin);
    keaAddScaled(v->ang, factor, other->ang);
}

static MeBool setMover(const MdtKeaSystem *s, const MdtKeaMover *m, Carrier *c) {
    if (!m || !hasJump(&m->jump))
        return MEFALSE;
    keaCopy(c->position[0], m->position);
    keaCopy(c->position[1], m->position);
    keaAddScaled(c->position[1], s->parameters.stepsize, m->velocity.lin);
    c->velocity[0] = c->velocity[1] = m->chord;
    c->jump = m->jump;
    addVelocity(&c->velocity[0], -1, &c->jump);
    return METRUE;
}

/* m/s: the magnitude of a body's velocity. */
static double speedOf(const MdtKeaSystem *s, int body, const double v[6]) {
    return keaLength(v) + s->work->body[body].size * keaLength(v + 3);
}

/* The velocity that has displaced a body. */
static void displacingVelocity(const MdtKeaSystem *s, int body, MdtKeaVelocity *v) {
    const KeaEnd *end = &s->work->end[body];
    const double perStep = 1 / s->parameters.stepsize;
    double back[4], turn[4];
    keaSubtract(v->lin, end->position, s->bodies[body]->position);
    keaScale(v->lin, perStep, v->lin);
    keaCopy(back + 1, s->bodies[body]->quaternion + 1);
    keaScale(back + 1, -1, back + 1);
    back[0] = s->bodies[body]->quaternion[0];
    keaQuaternionProduct(turn, end->quaternion, back);
    keaScale(v->ang, 2 * perStep / turn[0], turn + 1); /* as by the Cayley map */
}

static MeBool setTied(const MdtKeaSystem *s, int body, Carrier *c) {
    const KeaEnd *end = &s->work->end[body];
    double jump[6], speed[6];
    keaCopy(c->position[0], s->bodies[body]->position);
    keaCopy(c->position[1], end->position);
    c->velocity[0] = s->velocity[body];
    keaCopy(c->velocity[1].lin, end->velocity);
    kea_angularVelocity(s->bodies[body], end->quaternion, end->angularMomentum, c->velocity[1].ang);
    displacingVelocity(s, body, &c->jump);
    memcpy(speed, &c->jump, sizeof speed);
    addVelocity(&c->jump, 1, &c->jump);
    addVelocity(&c->jump, -1, &c->velocity[0]);
    addVelocity(&c->jump, -1, &c->velocity[1]);
    memcpy(jump, &c->jump, sizeof jump);
    return speedOf(s, body, jump) > kea_minJump * speedOf(s, body, speed);
}

/* Sets what carries the bodies on a side of a manifold. Returns whether there is something. */
static MeBool setCarrier(const MdtKeaSystem *s, const KeaCarrier *by, Carrier *c) {
    return by->body > 0 ? setTied(s, by->body - 1, c) : setMover(s, by->mover, c);
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

/* Whether the body, with its velocity at a place, moves along with what carries it at the start or the end (0, 1) but
 * for a small share of `whole`. */
static MeBool follows(const MdtKeaSystem *s, const double normal[3], const Carrier *c, int at, int body,
                      const double place[3], const MdtKeaVelocity *own, double whole) {
    double of[6], slip[6];
    alongSurface(normal, c->position[at], &c->velocity[at], place, of);
    alongSurface(normal, place, own, place, slip);
    for (int i = 0; i < 6; i++)
        slip[i] -= of[i];
    return speedOf(s, body, slip) < kea_stickingSlip * whole;
}

/* Whether the body has stuck to what carries it before the jump, and sticks to it at the end. */
static MeBool sticks(const MdtKeaSystem *s, const double normal[3], const Carrier *c, int body, const double jump[6]) {
    const KeaEnd *end = &s->work->end[body];
    const double whole = speedOf(s, body, jump);
    MdtKeaVelocity v;
    if (!follows(s, normal, c, 0, body, s->pose[body].pos, &s->velocity[body], whole))
        return MEFALSE;
    keaCopy(v.lin, end->velocity);
    kea_angularVelocity(s->bodies[body], end->quaternion, end->angularMomentum, v.ang);
    return follows(s, normal, c, 1, body, end->position, &v, whole);
}

/* m/s: the jump along the normal, if the carrier goes away and the body comes along; side: 1 for the manifold's first
 * body, -1. */
static double dropOf(const MdtKeaSystem *s, const double normal[3], double side, const Carrier *c, int body) {
    double jump[3], of[3];
    velocityAt(c->position[0], &c->jump, s->pose[body].pos, jump);
    velocityAt(c->position[0], &c->velocity[1], s->pose[body].pos, of);
    const double along = keaDot(jump, normal);
    const double behind = keaDot(s->work->end[body].velocity, normal) - keaDot(of, normal);
    return side * along < 0 && fabs(behind) < kea_stickingSlip * fabs(along) ? along : 0;
}

/* Sets the velocity along the surface that a body lacks, as it has been displaced, to move along with a jointed one. */
static void lagBehind(const MdtKeaSystem *s, const double normal[3], int carrier, int body, double lag[6]) {
    MdtKeaVelocity of, own;
    double place[3], origin[3], more[6];
    displacingVelocity(s, carrier, &of);
    displacingVelocity(s, body, &own);
    for (int i = 0; i < 3; i++) {
        place[i] = 0.5 * (s->bodies[body]->position[i] + s->work->end[body].position[i]);
        origin[i] = 0.5 * (s->bodies[carrier]->position[i] + s->work->end[carrier].position[i]);
    }
    alongSurface(normal, origin, &of, place, lag);
    alongSurface(normal, place, &own, place, more);
    for (int i = 0; i < 6; i++)
        lag[i] -= more[i];
}

static MeBool pushes(const MdtKeaManifold *m) {
    for (int i = 0; i < m->numPoints; i++)
        if (m->point[i].force[0] > 0)
            return METRUE;
    return MEFALSE;
}

/* What carries others on a side of the manifold. */
static KeaCarrier carrierOn(const MdtKeaSystem *s, const MdtKeaManifold *m, int side) {
    const int body = m->body[side];
    if (body < 0)
        return (KeaCarrier){.mover = m->mover};
    return s->work->body[body].isTied ? (KeaCarrier){.body = body + 1} : s->work->carrier[body];
}

/* Carries a body of the manifold that is not carried yet. Returns whether there is one. */
static MeBool carryOver(const MdtKeaSystem *s, const MdtKeaManifold *m) {
    for (int k = 0; k < 2; k++) {
        const int body = m->body[k];
        if (body < 0 || s->work->body[body].isTied || s->work->carrier[body].body || s->work->carrier[body].mover)
            continue;
        const KeaCarrier by = carrierOn(s, m, 1 - k);
        Carrier c;
        if (!pushes(m) || !setCarrier(s, &by, &c))
            continue;
        double *jump = s->work->added[body];
        alongSurface(m->normal, c.position[0], &c.jump, s->pose[body].pos, jump);
        kea_dropLocked(s->work->body[body].locked, jump);
        const double drop = dropOf(s, m->normal, k == 0 ? 1 : -1, &c, body);
        const MeBool isCarried = sticks(s, m->normal, &c, body, jump);
        if (!isCarried && drop == 0)
            continue;
        keaScale(jump, isCarried ? 1 - s->work->end[body].theta : 0, jump);
        keaScale(jump + 3, isCarried ? 1 - s->work->end[body].theta : 0, jump + 3);
        if (isCarried && by.body > 0)
            lagBehind(s, m->normal, by.body - 1, body, jump);
        keaAddScaled(jump, (1 - s->work->end[body].theta) * drop, m->normal);
        kea_dropLocked(s->work->body[body].locked, jump);
        s->work->carrier[body] = by;
        return METRUE;
    }
    return MEFALSE;
}

static void displace(MdtKeaSystem *s, int body, const double lag[6]) {
    KeaEnd *end = &s->work->end[body];
    const double time = s->parameters.stepsize;
    double rotation[3], turn[4];
    keaAddScaled(end->position, time, lag);
    keaScale(rotation, time, lag + 3);
    keaQuaternionExp(turn, rotation);
    keaQuaternionProduct(end->quaternion, turn, end->quaternion);
    keaQuaternionNormalize(end->quaternion);
    kea_setPoses(s, body);
}

/* Whether joints connect bodies with a mover. */
static MeBool areJointsMoved(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numRows; i++)
        if (s->rows[i].contact < 0 && s->rows[i].mover)
            return METRUE;
    return MEFALSE;
}

void kea_carryBodies(MdtKeaSystem *s) {
    if (s->parameters.elapsed + s->parameters.late > 0)
        return;
    MeBool isAny = areJointsMoved(s);
    for (int i = 0; i < s->numManifolds && !isAny; i++)
        isAny = s->manifolds[i].mover && hasJump(&s->manifolds[i].mover->jump);
    if (!isAny)
        return;
    memset(s->work->carrier, 0, (size_t)s->numBodies * sizeof *s->work->carrier);
    for (int sweep = 0; sweep < s->numBodies && isAny; sweep++) {
        isAny = MEFALSE;
        for (int i = 0; i < s->numManifolds; i++)
            isAny |= carryOver(s, &s->manifolds[i]);
    }
    for (int i = 0; i < s->numBodies; i++)
        if (s->work->carrier[i].body || s->work->carrier[i].mover)
            displace(s, i, s->work->added[i]);
}
