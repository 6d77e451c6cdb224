/* Rows: those of a partition's constraints in one part of its step. Each kind of joint is a file of MdtBcl; here they
 * are counted, capped (mdt_cap.c), filled, and refilled for Kea where the bodies have moved. */
#include "MeAssert.h"
#include "mdt_step_i.h"
#include <string.h>

void mdt_rowsContext(const MdtIsland *p, MdtConstraintID c, MdtBclContext *x) {
    const MdtKeaSystem *kea = &p->kea;
    x->parameters = p->parameters;
    x->elapsed = p->elapsed;
    x->firstRow = c->firstRow;
    for (int k = 0; k < 2; k++) {
        MdtBodyID b = c->side[k].body;
        MEASSERT(!b || (b->partition == p->number && p->bodies[b->index] == b));
        x->body[k] = b ? b->index : MdtBclNO_BODY;
        x->kea[k] = b ? &b->kea : NULL;
        x->pose[k] = b ? &kea->pose[b->index] : &MdtBclWorldPose;
        x->velocity[k] = b ? &kea->velocity[b->index] : &c->worldVelocity;
        x->predicted[k] = b ? &kea->predicted[b->index] : &c->worldVelocity;
        x->acceleration[k] = b ? &b->acceleration : &MdtBclWorldVelocity;
        x->invMass[k] = b ? &kea->invMass[b->index] : &MdtBclWorldInvMass;
    }
}

/* A row's rate is the velocity of one side relative to the other; the world's part is known and goes to the target. */
static void subtractWorldVelocity(MdtConstraintID c, MdtKeaRow *row) {
    double rate = 0;
    for (int k = 0; k < 2; k++)
        if (row->body[k] == MdtBclNO_BODY)
            rate += keaDot(row->J[k].lin, c->worldVelocity.lin) + keaDot(row->J[k].ang, c->worldVelocity.ang);
    row->target -= rate;
    row->drift -= rate;
}

/* Once when a joint comes there, not at every step, or part of one, that it stays. */
static void noteDegenerate(MdtIsland *p, MdtConstraintID c) {
    p->isDegenerate = p->isDegenerate || c->bcl.isDegenerate;
    if (!c->bcl.isDegenerate || c->isDegenerate)
        return;
    c->isDegenerate = METRUE;
    if (c->wasDegenerate)
        return;
    c->world->degenerate++;
    MeWarning(2, "MdtWorldStep: a %s (sort key %d) cannot work as it stands: %s", c->type->name, c->link.sortKey,
              c->type->degenerate);
}

static int countRows(MdtIsland *p) {
    MdtBclContext x;
    int rows = 0;
    for (int i = 0; i < p->numConstraints; i++) {
        MdtConstraintID c = p->constraints[i];
        mdt_rowsContext(p, c, &x);
        c->isDropped = MEFALSE;
        c->numRows = c->type->prepare(&c->bcl, &x);
        MEASSERT(c->numRows >= 0 && c->numRows <= c->type->maxRows);
        noteDegenerate(p, c);
        mdt_checkSurface(c);
        rows += c->numRows;
    }
    return rows;
}

static void fillRows(MdtIsland *p) {
    MdtKeaSystem *kea = &p->kea;
    MdtBclContext x;
    for (int i = 0; i < p->numConstraints; i++) {
        MdtConstraintID c = p->constraints[i];
        c->firstRow = kea->numRows;
        mdt_rowsContext(p, c, &x);
        if (c->numRows > 0)
            c->type->fill(&c->bcl, &x, kea->rows + c->firstRow);
        for (int r = 0; r < c->numRows; r++) {
            MdtKeaRow *row = &kea->rows[c->firstRow + r];
            subtractWorldVelocity(c, row);
            row->owner = i;
            row->force = c->numWarm == c->numRows ? c->warm[r] : row->force;
            row->ripple = c->numWarm == c->numRows ? c->ripple[r] : 0;
        }
        kea->numRows += c->numRows;
        MEASSERT(kea->numRows <= kea->maxRows);
    }
}

/* Count, leave out what is too much, fill. */
void mdt_rowsMake(MdtIsland *p) {
    MdtWorldID w = p->world;
    const int rows = countRows(p);
    if (rows > w->maxMatrixSize)
        mdt_capRows(w, p->constraints, p->numConstraints, rows, w->maxMatrixSize);
    fillRows(p);
    if (p->number < w->sizeLogLength)
        w->sizeLog[p->number] = p->kea.numRows;
}

/* Rows of joints move with the bodies; contacts stay as they were found. */
void MEAPI mdt_rowsMove(void *island, const MdtKeaTransformation poses[]) {
    const MdtIsland *p = island;
    MdtKeaRow rows[MdtBclGETMAXROWS];
    MdtBclContext x;
    for (int i = 0; i < p->numConstraints; i++) {
        MdtConstraintID c = p->constraints[i];
        if (c->numRows == 0 || c->type == MdtBclTypeOf(MdtBclCONTACT))
            continue;
        mdt_rowsContext(p, c, &x);
        for (int k = 0; k < 2; k++)
            if (c->side[k].body)
                x.pose[k] = &poses[c->side[k].body->index];
        c->type->fill(&c->bcl, &x, rows);
        for (int r = 0; r < c->numRows; r++) {
            MdtKeaRow *row = &p->kea.rows[c->firstRow + r];
            memcpy(row->J, rows[r].J, sizeof row->J);
            memcpy(row->arm, rows[r].arm, sizeof row->arm);
            row->lower = rows[r].lower;
            row->upper = rows[r].upper;
        }
    }
}

void MEAPI mdt_rowsErrors(void *island, const MdtKeaTransformation poses[], double errors[]) {
    const MdtIsland *p = island;
    for (int i = 0; i < p->numConstraints; i++) {
        MdtConstraintID c = p->constraints[i];
        const MdtKeaTransformation *pose[2];
        if (!c->type->errors)
            continue;
        for (int k = 0; k < 2; k++)
            pose[k] = c->side[k].body ? &poses[c->side[k].body->index] : &MdtBclWorldPose;
        c->type->errors(&c->bcl, pose, errors + c->firstRow);
    }
}
