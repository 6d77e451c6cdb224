/* Unpack: forces back to the constraints after each part, states and accelerations to the bodies at the end of the
 * step. */
#include "MeAssert.h"
#include "mdt_step_i.h"
#include <string.h>

/* ---- constraints ---- */

void mdt_unpackBegin(MdtIsland *p) {
    for (int i = 0; i < p->numConstraints; i++) {
        p->constraints[i]->wasDegenerate = p->constraints[i]->isDegenerate;
        p->constraints[i]->isDegenerate = MEFALSE;
        memset(&p->constraints[i]->force, 0, sizeof p->constraints[i]->force);
        keaZero(p->constraints[i]->normalForce);
    }
}

/* The force of a divided step is the mean over its parts. */
static void addForces(MdtConstraintID c, const MdtKeaRow *row, double share) {
    for (int k = 0; k < 2; k++) {
        keaAddScaled(c->force.body[k].lin, share * row->force, row->J[k].lin);
        keaAddScaled(c->force.body[k].ang, share * row->force, row->J[k].ang);
    }
}

/* A group's forces and rows are those of its contacts. It comes before them. */
static void addToGroup(MdtConstraintID c, const MdtKeaRow rows[], double share) {
    MdtConstraintID group = c->group;
    for (int r = 0; r < c->numRows; r++)
        addForces(group, &rows[r], share);
    if (c->numRows > 0)
        keaAddScaled(group->normalForce, share * rows[0].force, c->bcl.of.contact.normal);
}

void mdt_unpackImpact(MdtIsland *p) {
    for (int i = 0; i < p->numConstraints; i++) {
        MdtConstraintID c = p->constraints[i];
        for (int r = 0; r < c->numRows; r++)
            addForces(c, &p->kea.rows[c->firstRow + r], 1 / p->h);
        if (c->group)
            addToGroup(c, p->kea.rows + c->firstRow, 1 / p->h);
    }
}

void mdt_unpackConstraints(MdtIsland *p) {
    MdtBclContext x;
    for (int i = 0; i < p->numConstraints; i++) {
        MdtConstraintID c = p->constraints[i];
        const MdtKeaRow *rows = p->kea.rows + c->firstRow;
        MEASSERT(c->firstRow >= 0 && c->firstRow + c->numRows <= p->kea.numRows);
        for (int r = 0; r < c->numRows; r++)
            addForces(c, &rows[r], p->parameters.stepsize / p->h);
        MEASSERT(isfinite(keaDot(c->force.body[0].lin, c->force.body[0].lin)));
        const MeBool isLong = p->parameters.stepsize > 0.1 * p->h; /* the forces of a shorter part are no guess */
        c->numWarm = isLong ? c->numRows : 0;
        for (int r = 0; r < c->numRows; r++)
            c->warm[r] = rows[r].force, c->ripple[r] = rows[r].ripple;
        if (c->group)
            addToGroup(c, rows, p->parameters.stepsize / p->h);
        mdt_rowsContext(p, c, &x);
        if (c->isDropped)
            c->bcl.of.contact.normalForce = 0;
        else if (c->type->readBack)
            c->type->readBack(&c->bcl, &x, rows);
    }
}

/* ---- bodies ---- */

/* Bodies move with their velocity at the end of the step, or with its mean. */
static void notePush(MdtBodyID b, const MdtStart *start, const MdtKeaVelocity *end, double h) {
    double beyondEnd[3], beyondMean[3];
    for (int k = 0; k < 3; k++) {
        const double way = (b->kea.position[k] - start->position[k]) / h;
        beyondEnd[k] = way - end->lin[k];
        beyondMean[k] = way - 0.5 * (start->velocity.lin[k] + end->lin[k]);
    }
    keaCopy(b->push, keaLength(beyondEnd) < keaLength(beyondMean) ? beyondEnd : beyondMean);
}

void mdt_unpackBodies(MdtIsland *p) {
    for (int i = 0; i < p->numBodies; i++) {
        MdtBodyID b = p->bodies[i];
        MdtKeaVelocity end;
        mdt_bodyVelocity(b, &end);
        for (int k = 0; k < 3; k++) {
            b->acceleration.lin[k] = (end.lin[k] - p->start[i].velocity.lin[k]) / p->h;
            b->acceleration.ang[k] = (end.ang[k] - p->start[i].velocity.ang[k]) / p->h;
        }
        notePush(b, &p->start[i], &end, p->h);
        MEASSERT(isfinite(keaLength(b->acceleration.lin) + keaLength(b->acceleration.ang) + keaLength(b->push)));
        mdt_bodyAge(b, p->h);
        mdt_bodyKeepWithinReach(b);
        mdt_bodyShow(b);
    }
}

void mdt_unpackStopped(MdtIsland *p) {
    static const double none[3] = {0, 0, 0};
    MeWarning(2, "MdtWorldStep: partition %d (%d bodies) would leave the finite numbers; its bodies are stopped",
              p->number, p->numBodies);
    for (int i = 0; i < p->numBodies; i++) {
        keaZero(p->bodies[i]->kea.velocity);
        MdtKeaBodySetAngularVelocity(&p->bodies[i]->kea, none);
        mdt_bodyShow(p->bodies[i]);
    }
}
