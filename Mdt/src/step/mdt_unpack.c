/* Unpack: reads back forces to constraints after each part, and states and accelerations to bodies at the end of the
 * step. */
#include "MeAssert.h"
#include "MeInternal.h"
#include "step/mdt_step_i.h"
#include <limits.h>
#include <string.h>

/* ---- constraints ---- */

/* Whether a joint goes on closing: errors have to shrink. A rigid joint leaves 1 - gamma of them, one that is soft
 * compared with its bodies' masses more; what stays open is jammed, or its attachments move. */
static void findClosing(const MdtIsland *p, MdtJoint *j) {
    static const double minShare = 1. / 16; /* of gamma: of joints whose compliance is 15 times that of their bodies */
    if (!(j->gap < (1 - minShare * (double)p->world->gamma) * j->gapBefore) && j->gap != HUGE_VAL)
        j->gap = 0;
    j->gapBefore = j->gap;
}

void mdt_unpackBegin(const MdtIsland *p) {
    MdtJoint *j;
    for (int i = 0; (j = mdt_nextJoint(p, &i));) {
        findClosing(p, j);
        j->wasDegenerate = j->isDegenerate;
        j->isDegenerate = MEFALSE;
        memset(&j->force, 0, sizeof j->force);
    }
}

/* The force of a divided step is the mean over its parts, weighted by their duration. */
static void addJointForces(MdtJoint *j, const MdtKeaRow rows[], double share) {
    for (int r = 0; r < j->numRows; r++)
        for (int k = 0; k < 2 && !rows[r].isTail; k++) {
            keaAddScaled(j->force.body[k].lin, share * rows[r].force, rows[r].J[k].lin);
            keaAddScaled(j->force.body[k].ang, share * rows[r].force, rows[r].J[k].ang);
        }
    if (!isfinite(keaDot(j->force.body[0].lin, j->force.body[0].lin))) /* rows of callbacks may be anything */
        memset(&j->force, 0, sizeof j->force);
}

/* Adds `share` times the forces of the present part to those of the step. */
static void addForces(const MdtIsland *p, double share) {
    MdtJoint *j;
    for (int i = 0; (j = mdt_nextJoint(p, &i));)
        addJointForces(j, p->kea.rows + j->firstRow, share);
    mdt_contactsAddForces(p, share);
}

void mdt_unpackImpact(const MdtIsland *p) {
    addForces(p, 1 / p->h);
}

/* True if the row moves the bodies, by a motor or a moving attachment. A row at its bound does not count: its body is
 * held by something else, and does not move. */
static MeBool movesBodies(const MdtKeaRow *row) {
    const MeBool isMotor = !row->position && !row->spring && row->target != 0;
    const double nearly = 1 - 1e-9;
    return (isMotor || row->drift != 0) && row->force > nearly * row->lower && row->force < nearly * row->upper;
}

static void unpackJoint(const MdtIsland *p, MdtJoint *j, MeBool isGuess) {
    const MdtKeaRow *rows = p->kea.rows + j->firstRow;
    MdtBclContext x;
    MEASSERT(j->firstRow >= 0 && j->firstRow + j->numRows <= p->kea.numRows);
    j->numWarm = isGuess ? j->numRows : 0;
    j->isDriven = MEFALSE;
    for (int r = 0; r < j->numRows; r++) {
        j->warm[r] = rows[r].force, j->ripple[r] = rows[r].ripple;
        j->isDriven = j->isDriven || movesBodies(&rows[r]);
    }
    mdt_jointContext(p, j, 1, p->kea.pose, &x); /* where movers are at the end of the part, too */
    if (j->type->readBack)
        j->type->readBack(&j->bcl, &x, rows);
}

void mdt_unpackConstraints(const MdtIsland *p) {
    /* forces of very short parts are no warm start of a long one */
    const MeBool isGuess = p->isHalved || p->parameters.stepsize > 0.1 * p->h;
    addForces(p, mdt_substepTime(p) / p->h);
    MdtJoint *j;
    for (int i = 0; (j = mdt_nextJoint(p, &i));)
        unpackJoint(p, j, isGuess);
    mdt_contactsUnpack(p, isGuess);
}

/* ---- bodies ---- */

/* Computes the position correction: the displacement beyond h ((1 - θ) v + θ v⁺). */
static void recordPositionCorrection(MdtBodyID b, const MdtStart *start, const MdtKeaVelocity *end, double h) {
    b->theta = b->kea.fall / (h * h);
    for (int k = 0; k < 3; k++)
        b->push[k] = (b->kea.position[k] - start->pose.position[k]) / h - (1 - b->theta) * start->velocity.lin[k] -
                     b->theta * end->lin[k];
}

static void unpackBody(MdtBodyID b, double h) {
    MdtKeaVelocity end;
    mdt_bodyClampPosition(b);
    mdt_bodyTurnInertia(b, 0);
    mdt_bodyShow(b);
    mdt_bodyVelocity(b, &end);
    for (int k = 0; k < 3; k++) {
        b->kea.lastStep.lin[k] = (end.lin[k] - b->start.velocity.lin[k]) / h;
        b->kea.lastStep.ang[k] = (end.ang[k] - b->start.velocity.ang[k]) / h;
    }
    recordPositionCorrection(b, &b->start, &end, h);
    MEASSERT(b->theta >= 0.5 - 1e-9 && b->theta <= 1 + 1e-9);
    MEASSERT(isfinite(keaLength(b->kea.lastStep.lin) + keaLength(b->kea.lastStep.ang) + keaLength(b->push)));
    mdt_bodyCapSpeeds(b);
    mdt_bodyAge(b, h);
    if (b->moves != b->start.moves + 1)
        b->start.moves = ULONG_MAX;
}

/* For results independent of threads (rule in MeTeam.h), a range writes to its own bodies only. */
static void MEAPI unpackBodies(void *island, int first, int end, int worker) {
    const MdtIsland *p = island;
    (void)worker;
    for (int i = first; i < end; i++) {
        if (i + MDT_AHEAD < end)
            me_prefetch(p->bodies[i + MDT_AHEAD], sizeof *p->bodies[i]);
        unpackBody(p->bodies[i], p->h);
    }
}

void mdt_unpackBodies(MdtIsland *p) {
    MeTeamRunRanges(p->team, p->numBodies, MDT_RANGE, unpackBodies, p);
}

void mdt_unpackStopped(const MdtIsland *p) {
    static const double none[3] = {0, 0, 0};
    MeWarning(2, "%s: partition %d (%d bodies) would leave the finite numbers; its bodies are stopped",
              MeCallerName("MdtWorldStep"), p->number, p->numBodies);
    for (int i = 0; i < p->numBodies; i++) {
        keaZero(p->bodies[i]->kea.velocity);
        MdtKeaBodySetAngularVelocity(&p->bodies[i]->kea, none);
        mdt_bodyClampPosition(p->bodies[i]); /* an earlier part of the step may have moved it beyond */
        mdt_bodyShow(p->bodies[i]);
        p->bodies[i]->start.moves = ULONG_MAX;
    }
}
