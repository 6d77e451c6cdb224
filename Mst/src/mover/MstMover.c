/* Movers: capsules that are moved, not simulated. */
#include "mover/mst_mover_i.h"
#include "McdModel.h"
#include "MdtBody.h"
#include "MdtWorld.h"
#include "MeMessage.h"
#include "bridge/mst_bridge_i.h"

static MeBool isMover(MstMoverID m, const char *function) {
    if (m && MST_IS_KNOWN(m, MST_MOVER) && m->magic == MST_MOVER)
        return METRUE;
    mst_warnGone(m, "mover", function);
    return MEFALSE;
}

/* Single precision counts in whole numbers up to this. */
static const double maxPlace = 16777216;

static MeBool arePlaces(const MeReal *x) {
    for (int i = 0; x && i < 3; i++)
        if (!(fabs((double)x[i]) <= maxPlace))
            return MEFALSE;
    return x != 0;
}

static MeBool areFinite(const MeReal *x, int count) {
    for (int i = 0; i < count; i++)
        if (!MeRealIsValid(x[i]))
            return MEFALSE;
    return METRUE;
}

static void fromReal(double out[3], const MeReal a[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = (double)a[i];
}

static void toReal(MeReal out[3], const double a[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = (MeReal)a[i];
}

/* ---- life -------------------------------------------------------------------------------------------------------- */

void MEAPI MstMoverSetDefaults(MstMoverParams *params, MstUniverseID u) {
    MeVector3 gravity;
    const char *member = !params ? "params" : !u || !MST_IS_KNOWN(u, MST_UNIVERSE) ? "universe" : 0;
    if (member) {
        MeWarning(1, "MstMoverSetDefaults: the %s is null, or has been destroyed", member);
        return;
    }
    const MeReal length = u->sizes.lengthScale;
    MdtWorldGetGravity(u->world, gravity);
    const MeReal g = MeVector3Magnitude(gravity);
    *params = (MstMoverParams){.radius = (MeReal)0.3 * length,
                               .height = (MeReal)1.8 * length,
                               .slopeLimit = (MeReal)(50 * ME_PI / 180),
                               .stepHeight = (MeReal)0.35 * length,
                               .skin = (MeReal)0.02 * length,
                               .pushStrength = 500 * u->sizes.massScale,
                               .up = {0, 0, 1}};
    for (int i = 0; i < 3 && g > 0; i++)
        params->up[i] = -gravity[i] / g;
}

/* What is wrong with the parameters; null: nothing. */
static const char *faultOf(const MstMoverParams *p) {
    const MeReal number[] = {p->radius, p->height, p->slopeLimit, p->stepHeight, p->skin, p->pushStrength};
    if (!areFinite(number, 6) || !areFinite(p->up, 3))
        return "a number is not finite";
    if (!(p->radius > 0 && p->height > 2 * p->radius))
        return "radius is not > 0, or height not > 2 radius";
    if ((double)p->radius > maxPlace || (double)p->height > maxPlace || (double)p->stepHeight > maxPlace)
        return "a length is beyond 2^24";
    if (!(p->skin > 0 && p->skin < p->radius))
        return "skin is not > 0 and < radius";
    if (!(p->slopeLimit >= 0 && (double)p->slopeLimit <= 1.5708))
        return "slopeLimit is not 0 .. pi/2";
    if (p->stepHeight < 0 || p->pushStrength < 0)
        return "stepHeight or pushStrength is negative";
    return MeVector3Magnitude(p->up) > 0 ? 0 : "up is zero";
}

static void setParams(MstMoverID m, const MstMoverParams *p) {
    m->radius = (double)p->radius;
    m->height = (double)p->height;
    m->stepHeight = (double)p->stepHeight;
    m->skin = (double)p->skin;
    m->strength = (double)p->pushStrength;
    m->minUp = cos((double)p->slopeLimit);
    m->filter = p->filter;
    m->filterData = p->filterData;
    fromReal(m->up, p->up);
    mst_scale(m->up, m->up, 1 / mst_length(m->up));
}

MstMoverID MEAPI MstMoverCreate(MstUniverseID u, const MstMoverParams *params, const MeVector3 position) {
    const char *fault = !u || !MST_IS_KNOWN(u, MST_UNIVERSE) ? "the universe is null, or has been destroyed"
                        : !params                            ? "params is null"
                        : !arePlaces(position)               ? "the position is null, not finite, or beyond 2^24"
                                                             : faultOf(params);
    if (fault) {
        MeWarning(1, "MstMoverCreate: %s", fault);
        return 0;
    }
    MstMoverID m = MeMemoryTakeZeroed(1, sizeof *m, "MstMoverCreate", "a mover");
    if (!m)
        return 0;
    m->magic = MST_MOVER;
    m->universe = u;
    m->space = u->space;
    setParams(m, params);
    fromReal(m->foot, position);
    m->next = u->movers;
    u->movers = m;
    MeHandleEnter(&m->handle, m, MST_MOVER);
    return m;
}

static void leaveUniverse(MstMoverID m) {
    MstMover **at = &m->universe->movers;
    while (*at != m)
        at = &(*at)->next;
    *at = m->next;
}

void MEAPI MstMoverDestroy(MstMoverID m) {
    if (!m || !isMover(m, "MstMoverDestroy"))
        return;
    if (m->universe)
        leaveUniverse(m);
    MeHandleLeave(&m->handle);
    m->magic = 0;
    MeMemoryGive(m);
}

void mst_moversLeave(MstUniverse *u) {
    for (MstMover *m = u->movers; m; m = m->next) {
        m->universe = 0;
        m->space = 0;
    }
    u->movers = 0;
}

MeBool mst_moversMayShift(const MstUniverse *u, const double by[3]) {
    for (const MstMover *m = u->movers; m; m = m->next)
        for (int i = 0; i < 3; i++)
            if (!(fabs(m->foot[i] + by[i]) <= maxPlace))
                return MEFALSE;
    return METRUE;
}

/* The ground's point too: what the ground has moved since the last move is the same. */
void mst_moversShift(const MstUniverse *u, const double by[3]) {
    for (MstMover *m = u->movers; m; m = m->next) {
        mst_mad(m->foot, m->foot, 1, by);
        mst_mad(m->anchorPlace, m->anchorPlace, 1, by);
    }
}

void MEAPI MstMoverSetPosition(MstMoverID m, const MeVector3 position) {
    if (!isMover(m, "MstMoverSetPosition"))
        return;
    if (!arePlaces(position)) {
        MeWarning(1, "MstMoverSetPosition: the position is null, not finite, or beyond 2^24");
        return;
    }
    fromReal(m->foot, position);
    m->isOnGround = MEFALSE;
}

void MEAPI MstMoverGetPosition(MstMoverID m, MeVector3 position) {
    if (isMover(m, "MstMoverGetPosition") && position)
        toReal(position, m->foot);
}

MeReal MEAPI MstMoverGetHeight(MstMoverID m) {
    return isMover(m, "MstMoverGetHeight") ? (MeReal)m->height : 0;
}

/* ---- what is near ------------------------------------------------------------------------------------------------ */

/* Gathers what is within `reach` of the mover, and a step above and below that; false: there is no space. */
static MeBool begin(MstMove *v, MstMoverID m, double reach) {
    const double start[3] = {0, 0, 0}, around = m->radius + reach + 1.5 * m->skin;
    double low[3], high[3];
    const McdCapsule c = mst_moverCapsule(m, start);
    for (int i = 0; i < 3; i++) {
        const double upright = fabs(m->up[i]) * m->stepHeight;
        low[i] = fmin(c.end[0][i], c.end[1][i]) - around - upright;
        high[i] = fmax(c.end[0][i], c.end[1][i]) + around + upright;
    }
    *v = (MstMove){.mover = m, .reach = reach};
    v->near = McdNearBegin(m->space, m->foot, low, high, m->filter, m->filterData);
    return v->near != 0;
}

/* Room for what may push it out: what it overlaps. */
static MeBool beginMove(MstMove *v, MstMoverID m, double length) {
    double depth = 0;
    if (!begin(v, m, length + m->skin))
        return MEFALSE;
    mst_findMoverContacts(v);
    for (int i = 0; i < v->contactCount; i++)
        depth = fmax(depth, -v->contact[i].gap.distance);
    if (depth <= 0)
        return METRUE;
    McdNearEnd(v->near);
    return begin(v, m, length + 2 * depth + m->skin);
}

MeBool MEAPI MstMoverSetHeight(MstMoverID m, MeReal height) {
    MstMove v;
    if (!isMover(m, "MstMoverSetHeight"))
        return MEFALSE;
    if (!((double)height > 2 * m->radius && (double)height <= maxPlace)) {
        MeWarning(1, "MstMoverSetHeight: the height is %g: it must be more than 2 radius", (double)height);
        return MEFALSE;
    }
    const double before = m->height;
    m->height = (double)height;
    if (m->height <= before)
        return METRUE;
    MeBool fits = begin(&v, m, 0);
    if (fits) {
        mst_findMoverContacts(&v);
        for (int i = 0; i < v.contactCount; i++)
            fits = fits && v.contact[i].gap.distance >= 0;
        McdNearEnd(v.near);
    }
    if (!fits)
        m->height = before;
    return fits;
}

/* ---- the ground -------------------------------------------------------------------------------------------------- */

/* A point in the frame of a model, from its place in the world; and back. */
static void intoFrame(MeMatrix4Ptr tm, const double world[3], double local[3]) {
    double from[3];
    for (int k = 0; k < 3; k++)
        from[k] = world[k] - (double)tm[3][k];
    for (int i = 0; i < 3; i++)
        local[i] = (double)tm[i][0] * from[0] + (double)tm[i][1] * from[1] + (double)tm[i][2] * from[2];
}

static void outOfFrame(MeMatrix4Ptr tm, const double local[3], double world[3]) {
    for (int k = 0; k < 3; k++)
        world[k] =
            (double)tm[0][k] * local[0] + (double)tm[1][k] * local[1] + (double)tm[2][k] * local[2] + (double)tm[3][k];
}

/* How far the ground has moved since the last move, at its point of contact; false: not at all, or it is gone. */
static MeBool hasGroundMoved(const MstMover *m, double by[3]) {
    double now[3];
    MeBool hasMoved = MEFALSE;
    if (!m->isOnGround || McdModelGetSerial(m->ground) != m->groundSerial)
        return MEFALSE;
    outOfFrame(McdModelGetPlace(m->ground), m->anchor, now);
    mst_sub(by, now, m->anchorPlace);
    for (int i = 0; i < 3; i++)
        hasMoved = hasMoved || fabs(by[i]) > 4 * (double)ME_EPSILON * fabs(now[i]); /* not by rounding alone */
    return hasMoved;
}

static void land(MstMove *v, const MstMoverContact *c) {
    MstMoverID m = v->mover;
    const McdModelID cm = McdNearGetModel(v->near, c->child);
    m->ground = cm;
    m->groundSerial = McdModelGetSerial(cm);
    for (int i = 0; i < 3; i++)
        m->anchorPlace[i] = m->foot[i] + c->gap.position[i];
    intoFrame(McdModelGetPlace(cm), m->anchorPlace, m->anchor);
    outOfFrame(McdModelGetPlace(cm), m->anchor, m->anchorPlace); /* so that both are rounded in the same way */
}

static void velocityOf(const MstMove *v, const MstMoverContact *c, double velocity[3]) {
    const MdtBodyID body = McdModelGetBody(McdNearGetModel(v->near, c->child));
    MeVector3 place, found = {0, 0, 0};
    for (int i = 0; i < 3; i++)
        place[i] = (MeReal)(v->mover->foot[i] + c->gap.position[i]);
    if (body)
        MdtBodyGetVelocityAtPoint(body, place, found);
    fromReal(velocity, found);
}

/* ---- pushes ------------------------------------------------------------------------------------------------------ */

/* The mass (kg) of a body as a push at a point feels it: 1 / (1/m + (r x n) . I^-1 (r x n)). */
static double effectiveMass(MdtBodyID body, const double place[3], const double normal[3]) {
    MeMatrix3 inverse;
    MeVector3 centre, turn, own, by;
    double r[3], rn[3];
    MdtBodyGetCenterOfMassPosition(body, centre);
    for (int i = 0; i < 3; i++)
        r[i] = place[i] - (double)centre[i];
    mst_cross(rn, r, normal);
    const MeMatrix4Ptr tm = MdtBodyGetTransformPtr(body);
    toReal(turn, rn);
    for (int i = 0; i < 3; i++)
        own[i] = tm[i][0] * turn[0] + tm[i][1] * turn[1] + tm[i][2] * turn[2];
    MdtBodyGetInertiaTensor(body, inverse);
    MeMatrix3Invert(inverse);
    double sum = 1 / (double)MdtBodyGetMass(body);
    for (int i = 0; i < 3; i++) {
        by[i] = inverse[i][0] * own[0] + inverse[i][1] * own[1] + inverse[i][2] * own[2];
        sum += (double)(by[i] * own[i]);
    }
    return 1 / sum;
}

/* Pushes what is in the way towards the wanted velocity, with no more than the mover's strength. */
static void push(const MstMove *v, const MstMoverContact *c, const double target[3], double step) {
    const MdtBodyID body = McdModelGetBody(McdNearGetModel(v->near, c->child));
    double velocity[3], place[3];
    if (!body || MdtBodyIsKinematic(body))
        return;
    velocityOf(v, c, velocity);
    mst_mad(place, v->mover->foot, 1, c->gap.position);
    const double deficit = mst_dot(c->gap.normal, velocity) - mst_dot(c->gap.normal, target);
    if (!(deficit > 0))
        return;
    const double impulse = fmin(effectiveMass(body, place, c->gap.normal) * deficit, v->mover->strength * step);
    MdtBodyEnable(body);
    MdtBodyAddImpulseAtPosition(body, (MeReal)(-impulse * c->gap.normal[0]), (MeReal)(-impulse * c->gap.normal[1]),
                                (MeReal)(-impulse * c->gap.normal[2]), (MeReal)place[0], (MeReal)place[1],
                                (MeReal)place[2]);
}

/* ---- moves ------------------------------------------------------------------------------------------------------- */

static int flagsOf(const MstMove *v, MeBool isOnGround) {
    int flags = (isOnGround ? kMstMoverOnGround : 0) | (v->hasStepped ? kMstMoverStepped : 0);
    for (int i = 0; i < v->contactCount; i++) {
        const double up = mst_dot(v->contact[i].gap.normal, v->mover->up);
        if (!v->contact[i].isWalkable)
            flags |= up > .1 ? kMstMoverOnSteep : up < -.1 ? kMstMoverHead : kMstMoverSide;
    }
    return flags;
}

static void writeResult(const MstMove *v, const MstMoverContact *ground, const double velocity[3],
                        MstMoverResult *result) {
    const MstMoverID m = v->mover;
    memset(result, 0, sizeof *result);
    for (int i = 0; i < 3; i++)
        result->position[i] = (MeReal)(m->foot[i] + v->place[i]);
    toReal(result->velocity, velocity);
    result->flags = flagsOf(v, ground != 0);
    if (!ground)
        return;
    result->ground = McdNearGetModel(v->near, ground->child);
    for (int i = 0; i < 3; i++)
        result->groundPosition[i] = (MeReal)(m->foot[i] + ground->gap.position[i]);
    toReal(result->groundNormal, ground->gap.normal);
    toReal(result->groundVelocity, m->groundVelocity);
}

/* Goes for a step by a velocity; returns what it stands on then, or null. */
static const MstMoverContact *go(MstMove *v, double step, const double ride[3], double velocity[3]) {
    MstMoverID m = v->mover;
    double by[3], carried[3];
    const MeBool walks = m->isOnGround && mst_dot(velocity, m->up) <= 0;
    mst_scale(m->groundVelocity, ride, 1 / step);
    if (mst_dot(ride, ride) > 0)
        mst_slide(v, ride);
    if (m->isOnGround && !walks)
        mst_mad(velocity, velocity, 1, m->groundVelocity);
    mst_scale(by, velocity, step);
    v->footing = mst_dot(v->place, m->up);
    if (walks)
        mst_walk(v, by);
    else
        mst_slide(v, by);
    const MeBool follows = walks && mst_followGround(v);
    if (!follows)
        mst_findMoverContacts(v);
    const MstMoverContact *ground = mst_groundContact(v);
    if (!walks && ground) {
        velocityOf(v, ground, m->groundVelocity);
        mst_sub(carried, velocity, m->groundVelocity);
        if (mst_dot(carried, ground->gap.normal) > 1e-6 * mst_length(carried))
            ground = 0; /* it leaves it */
        else
            mst_copy(velocity, carried);
    }
    if (walks && !ground)
        mst_mad(velocity, velocity, 1, m->groundVelocity);
    mst_clipVelocity(v, ground != 0, velocity);
    return ground;
}

void MEAPI MstMoverMove(MstMoverID m, const MeVector3 velocity, MeReal step, MstMoverResult *result) {
    MstMove v;
    double target[3], after[3], ride[3] = {0, 0, 0};
    if (!isMover(m, "MstMoverMove"))
        return;
    if (!arePlaces(velocity) || !(step > 0 && (double)step <= 1e3)) {
        MeWarning(1, "MstMoverMove: the velocity is null, not finite, or beyond 2^24, or the step is %g s",
                  (double)step);
        return;
    }
    fromReal(target, velocity);
    const double h = (double)step;
    if (!hasGroundMoved(m, ride))
        mst_scale(ride, target, 0);
    if (!beginMove(&v, m, mst_length(target) * h + mst_length(ride)))
        return;
    mst_copy(after, target);
    const MstMoverContact *ground = go(&v, h, ride, after);
    for (int i = 0; i < v.pushedCount; i++)
        push(&v, &v.pushed[i], target, h);
    if (result)
        writeResult(&v, ground, after, result);
    if (ground)
        land(&v, ground);
    m->isOnGround = ground != 0;
    for (int i = 0; i < 3; i++)
        m->foot[i] = MeCLAMP(m->foot[i] + v.place[i], -maxPlace, maxPlace);
    McdNearEnd(v.near);
}
