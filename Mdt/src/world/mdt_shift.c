/* Moves the origin: adds a vector to all coordinates of a world. Nothing else changes, so that certificates of rest,
 * sleep, contacts and warm starts go on. */
#include "MdtInternal.h"
#include "base/mdt_manifold_i.h"
#include "base/mdt_world_i.h"
#include "island/mdt_island_i.h"

static void shiftPoint(double point[3], const double by[3]) {
    keaAddScaled(point, 1, by);
}

/* `moves`, the version of the pose, stays: relative to everything else the body has not moved. */
static void shiftBody(MdtBodyID b, const double by[3]) {
    shiftPoint(b->kea.position, by);
    shiftPoint(b->start.pose.position, by);
    shiftPoint(b->stay.pose.position, by);
    shiftPoint(b->frame.pos, by);
    for (int i = 0; i < 3; i++) {
        b->transform[3][i] = (MeReal)b->frame.pos[i];
        b->centreTransform[3][i] = (MeReal)b->kea.position[i];
    }
}

static void shiftMover(MdtMover *m, const double by[3]) {
    shiftPoint(m->target.position, by);
    shiftPoint(m->end.position, by);
    shiftPoint(m->kea.position, by);
    if (m->isHidden) /* it is not in the world's list */
        shiftBody(m->body, by);
}

/* A moving world: v + w x p at p, so v - w x by at p + by. */
static void shiftVelocity(MdtKeaVelocity *world, const double by[3]) {
    double turned[3];
    keaCross(turned, world->ang, by);
    keaSubtract(world->lin, world->lin, turned);
}

/* Of a coupling the base frames that are fixed in the world. */
static void shiftBases(MdtBclConstraint *c, const double by[3]) {
    for (int i = 0; (c->type == MdtBclGEAR || c->type == MdtBclPULLEY) && i < 2; i++)
        if (c->of.coupling.coordinate[i].side[1] == MdtBclNO_SIDE)
            shiftPoint(c->of.coupling.coordinate[i].frame[1].position, by);
}

static void shiftJoint(MdtJoint *j, const double by[3]) {
    const MeBool isCertified = mdt_jointIsCertified(j);
    for (int k = 0; k < 2; k++)
        if (!j->base.side[k].body)
            shiftPoint(j->bcl.frame[k].position, by);
    shiftBases(&j->bcl, by);
    shiftVelocity(&j->worldVelocity, by);
    if (isCertified)
        mdt_jointCertify(j);
}

static void shiftManifold(MdtManifold *m, const double by[3]) {
    for (MdtManifold *block = m; block; block = block->next) {
        for (int i = 0; i < MDT_POINTS; i++)
            shiftPoint(block->point[i].position, by);
        for (MdtExtra *extra = block->extras; extra; extra = extra->next)
            shiftVelocity(&extra->worldVelocity, by);
    }
}

static MeBool isWithinBound(const MdtWorld *w, const double point[3], const double by[3]) {
    const double max = mdt_worldBound(w);
    for (int i = 0; i < 3; i++)
        if (!(fabs(point[i] + by[i]) < max))
            return MEFALSE;
    return METRUE;
}

static MeBool areWithinBound(const MdtWorld *w, const double by[3]) {
    static const double origin[3];
    if (!isWithinBound(w, origin, by))
        return MEFALSE;
    for (MdtLink *link = w->bodies.first; link; link = link->next)
        if (!isWithinBound(w, ((const MdtBody *)mdt_linkOwner(link))->kea.position, by))
            return MEFALSE;
    return METRUE;
}

MeBool MEAPI MdtWorldShift(const MdtWorldID w, const double by[3]) {
    if (!areWithinBound(w, by))
        return MEFALSE;
    for (MdtLink *link = w->bodies.first; link; link = link->next)
        shiftBody(mdt_linkOwner(link), by);
    for (MdtMover *m = w->movers; m; m = m->next)
        shiftMover(m, by);
    for (MdtLink *link = w->constraints.first; link; link = link->next) {
        const MdtConstraintID c = mdt_linkOwner(link);
        if (mdt_isManifold(c))
            shiftManifold(mdt_asManifold(c), by);
        else
            shiftJoint(mdt_asJoint(c), by);
    }
    return METRUE;
}
