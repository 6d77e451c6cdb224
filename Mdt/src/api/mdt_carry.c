/* Moves contacts along with bodies that have hardly moved relative to each other, in place of a new collision test
 * (MdtInternal.h). */
#include "MdtInternal.h"
#include "MeAssert.h"
#include "api/mdt_api_i.h"
#include <string.h>

/* A rigid motion: x -> R (x - from) + to. */
typedef struct Motion {
    double R[3][3], from[3], to[3];
} Motion;

static void setIdentityMotion(Motion *m) {
    keaQuaternionToMatrix(m->R, (const double[4]){1, 0, 0, 0});
    keaZero(m->from);
    keaZero(m->to);
}

static void getStepMotion(const MdtBody *b, Motion *m) {
    double moved[3], turn[4];
    mdt_bodyMotionSince(b, &b->start.pose, moved, turn);
    keaQuaternionToMatrix(m->R, turn);
    keaCopy(m->from, b->start.pose.position);
    keaCopy(m->to, b->kea.position);
}

/* The motion of a mover in the first `time` seconds of its step. */
static void getMoverMotion(const MdtKeaMover *mover, double time, Motion *m) {
    double rotation[3], turn[4];
    keaScale(rotation, time, mover->velocity.ang);
    keaQuaternionExp(turn, rotation);
    keaQuaternionToMatrix(m->R, turn);
    keaCopy(m->from, mover->position);
    keaCopy(m->to, mover->position);
    keaAddScaled(m->to, time, mover->velocity.lin);
}

static void movePoint(const Motion *m, double x[3]) {
    double arm[3];
    keaSubtract(arm, x, m->from);
    keaApply(x, (const double(*)[3])m->R, arm);
    keaAddScaled(x, 1, m->to);
}

static void rotateNormal(const Motion *m, MeReal normal[3]) {
    double before[3], after[3];
    mdt_fromReal(before, normal);
    keaApply(after, (const double(*)[3])m->R, before);
    mdt_toReal(normal, after);
}

static void rotateNormals(MdtManifold *block, const Motion *second) {
    rotateNormal(second, block->normal);
    for (MdtExtra *extra = block->extras; extra; extra = extra->next)
        if (extra->record.flags & MDT_OWN_NORMAL)
            rotateNormal(second, extra->normal);
}

/* MdtKeaOffsetToSurface of side k. turn: the rotation of a rim's axis. */
static void offsetToSurface(const MdtPoint *p, int k, const double normal[3], const double turn[3][3], double out[3]) {
    double own[3], axis[3], outward[3];
    const double rim = mdt_pointRim(p, k, own);
    keaApply(axis, turn, own);
    keaScale(outward, k == 0 ? -1 : 1, normal);
    MdtKeaOffsetToSurface((double)mdt_pointRadius(p, k), rim, axis, outward, out);
}

/* Moves the two surface points of a contact with their bodies, those of round sides with their centres. They lie half
 * the depth on either side of the contact: depth = n·(p_1 - p_0). The contact is put halfway between them; on the
 * world, along the normal from the body's point. `p` may be a copy of the record. */
static void moveSurfacePoints(const MdtPoint *record, MdtPoint *p, const Motion motion[2], const double before[3],
                              const double after[3], MeBool isOnWorld) {
    static const double identity[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    double surface[2][3], between[3];
    for (int k = 0; k < 2; k++) {
        double out[3];
        offsetToSurface(record, k, before, identity, out);
        keaCopy(surface[k], p->position);
        keaAddScaled(surface[k], (k == 0 ? -0.5 : 0.5) * p->depth, before);
        keaAddScaled(surface[k], -1, out);
        movePoint(&motion[k], surface[k]);
        offsetToSurface(record, k, after, (const double(*)[3])motion[k].R, out);
        keaAddScaled(surface[k], 1, out);
    }
    keaSubtract(between, surface[1], surface[0]);
    p->depth = keaDot(after, between);
    keaCopy(p->position, surface[0]);
    if (isOnWorld)
        keaAddScaled(p->position, 0.5 * p->depth, after);
    else
        keaAddScaled(p->position, 0.5, between);
}

void mdt_pointGetCurrent(const MdtPoint *p, double time, double position[3], double *depth) {
    const MdtManifold *m = mdt_manifoldOf(p);
    double normal[3];
    Motion motion[2];
    MdtPoint carried = *p;
    mdt_pointNormal(p, normal);
    for (int k = 0; k < 2; k++)
        if (mdt_sideMover(&m->base, k))
            getMoverMotion(&mdt_sideMover(&m->base, k)->kea, time, &motion[k]);
        else if (m->base.side[k].body)
            getStepMotion(m->base.side[k].body, &motion[k]);
        else
            setIdentityMotion(&motion[k]);
    moveSurfacePoints(p, &carried, motion, normal, normal, !m->base.side[1].body);
    keaCopy(position, carried.position);
    *depth = carried.depth;
}

/* The unit normals of a record's points, by slot. Without extras they are all the same. */
static void findNormals(const MdtManifold *block, double normal[MDT_POINTS][3]) {
    const MdtPoint *last = NULL;
    for (const MdtPoint *p = mdt_pointIn(block, 0); p; p = mdt_pointIn(block, p->slot + 1)) {
        if (last && !block->extras)
            keaCopy(normal[p->slot], normal[last->slot]);
        else
            mdt_pointNormal(p, normal[p->slot]);
        last = p;
    }
}

MeReal MEAPI MdtContactGroupCarry(MdtContactGroupID g, const MeBool hasMoved[2]) {
    MdtManifold *m = mdt_groupOf(g, __func__);
    double before[MDT_POINTS][3], after[MDT_POINTS][3], min = (double)MEINFINITY;
    Motion motion[2];
    if (!m)
        return MEINFINITY;
    for (int k = 0; k < 2; k++) {
        MEASSERT(!hasMoved[k] || m->base.side[k].body);
        if (hasMoved[k])
            getStepMotion(m->base.side[k].body, &motion[k]);
        else
            setIdentityMotion(&motion[k]);
    }
    for (MdtManifold *block = m; block; block = block->next) {
        findNormals(block, before);
        if (hasMoved[1])
            rotateNormals(block, &motion[1]);
        findNormals(block, after);
        for (MdtPoint *p = mdt_pointIn(block, 0); p; p = mdt_pointIn(block, p->slot + 1)) {
            moveSurfacePoints(p, p, motion, before[p->slot], after[p->slot], !m->base.side[1].body);
            min = keaMin(min, -p->depth);
        }
    }
    mdt_constraintDisturb(&m->base);
    return (MeReal)min;
}

MeBool MEAPI MdtContactGroupIsFlat(MdtContactGroupID g) {
    const MdtManifold *m = mdt_groupOf(g, __func__);
    for (const MdtPoint *p = m ? mdt_pointFirst(m) : NULL; p; p = mdt_pointAfter(p))
        if (mdt_pointIsRound(p, 0) || mdt_pointIsRound(p, 1))
            return MEFALSE;
    return METRUE;
}
