/* Rows: those of a partition's constraints in one part of its step. Each kind of joint is a file of MdtBcl; here they
 * are counted, capped (mdt_cap.c), filled, and refilled for Kea where the bodies have moved. Constraints come in their
 * order of simulation, and the contacts of a manifold in its place. */
#include "MeAssert.h"
#include "mdt_step_i.h"
#include <string.h>

void mdt_rowsContext(const MdtIsland *p, MdtConstraintID c, const MdtKeaVelocity *worldVelocity, MdtBclContext *x) {
    const MdtKeaSystem *kea = &p->kea;
    x->parameters = p->parameters;
    x->elapsed = p->elapsed;
    for (int k = 0; k < 2; k++) {
        MdtBodyID b = c->side[k].body;
        MEASSERT(!b || (b->partition == p->number && p->bodies[b->index] == b));
        x->body[k] = b ? b->index : MdtBclNO_BODY;
        x->kea[k] = b ? &b->kea : NULL;
        x->pose[k] = b ? &kea->pose[b->index] : &MdtBclWorldPose;
        x->velocity[k] = b ? &kea->velocity[b->index] : worldVelocity;
        x->predicted[k] = b ? &kea->predicted[b->index] : worldVelocity;
        x->acceleration[k] = b ? &b->acceleration : &MdtBclWorldVelocity;
        x->invMass[k] = b ? &kea->invMass[b->index] : &MdtBclWorldInvMass;
    }
}

static void jointContext(const MdtIsland *p, MdtJoint *j, MdtBclContext *x) {
    mdt_rowsContext(p, &j->base, &j->worldVelocity, x);
    x->firstRow = j->firstRow;
}

/* Where the world moves, that is known of each contact by itself. */
static void contactContext(const MdtIslandContact *c, MdtBclContext *x) {
    const MdtKeaVelocity *worldVelocity = mdt_pointWorldVelocity(c->point);
    for (int k = 0; k < 2; k++)
        if (x->body[k] == MdtBclNO_BODY)
            x->velocity[k] = x->predicted[k] = worldVelocity;
    x->firstRow = c->firstRow;
}

/* ---- how many ---- */

/* Once when a joint comes there, not at every step, or part of one, that it stays. */
static void noteDegenerate(MdtIsland *p, MdtJoint *j) {
    p->isDegenerate = p->isDegenerate || j->bcl.isDegenerate;
    if (!j->bcl.isDegenerate || j->isDegenerate)
        return;
    j->isDegenerate = METRUE;
    if (j->wasDegenerate)
        return;
    p->world->degenerate++;
    MeWarning(2, "MdtWorldStep: a %s (sort key %d) cannot work as it stands: %s", j->type->name, j->base.link.sortKey,
              j->type->degenerate);
}

static int countJoint(MdtIsland *p, MdtJoint *j) {
    MdtBclContext x;
    jointContext(p, j, &x);
    j->numRows = j->type->prepare(&j->bcl, &x);
    MEASSERT(j->numRows >= 0 && j->numRows <= j->type->maxRows);
    noteDegenerate(p, j);
    return j->numRows;
}

static int countContacts(MdtIsland *p, MdtManifold *m, MdtIslandContact contacts[]) {
    MdtBclContext x;
    int rows = 0;
    mdt_rowsContext(p, &m->base, &MdtBclWorldVelocity, &x);
    for (int i = 0; i < m->numPoints; i++) {
        MdtIslandContact *c = &contacts[i];
        contactContext(c, &x);
        c->isDropped = MEFALSE;
        c->numRows = MdtBclContactPrepare(&c->bcl, &x);
        mdt_checkSurface(p->world, c->bcl.params);
        rows += c->numRows;
    }
    return rows;
}

static int countRows(MdtIsland *p) {
    int rows = 0, contact = 0;
    for (int i = 0; i < p->numActing; i++) {
        MdtJoint *j = mdt_asJoint(p->acting[i]);
        MdtManifold *m = mdt_asManifold(p->acting[i]);
        if (!j && p->isFast)
            continue;
        rows += j ? countJoint(p, j) : countContacts(p, m, p->contacts + contact);
        contact += j ? 0 : m->numPoints;
    }
    return rows;
}

/* ---- what they are ---- */

/* A row's rate is the velocity of one side relative to the other: the world's part. */
static double worldRate(const MdtKeaVelocity *v, const MdtKeaRow *row, const MdtKeaJBlockPair J) {
    double rate = 0;
    for (int k = 0; k < 2; k++)
        if (row->body[k] == MdtBclNO_BODY)
            rate += keaDot(J[k].lin, v->lin) + keaDot(J[k].ang, v->ang);
    return rate;
}

/* That is known and goes to the target. */
static void subtractWorldVelocity(const MdtKeaVelocity *v, MdtKeaRow *row) {
    const double rate = worldRate(v, row, row->J);
    row->target -= rate;
    row->drift -= rate;
}

/* 1/(kg m²): a row that only turns bodies has epsilon at a lever arm of the length scale. */
static void softenTurns(const MdtWorld *w, MdtKeaRow rows[], int count) {
    const double length = (double)w->params.lengthScale;
    for (int r = 0; r < count; r++)
        if (keaDot(rows[r].J[0].lin, rows[r].J[0].lin) + keaDot(rows[r].J[1].lin, rows[r].J[1].lin) == 0)
            rows[r].softness /= length * length;
}

static void fillJoint(MdtIsland *p, MdtJoint *j, int owner) {
    MdtKeaRow *rows = p->kea.rows + p->kea.numRows;
    MdtBclContext x;
    j->firstRow = p->kea.numRows;
    jointContext(p, j, &x);
    if (j->numRows > 0)
        j->type->fill(&j->bcl, &x, rows);
    if (mdt_constraintType(&j->base) != MdtBclUSER)
        softenTurns(p->world, rows, j->numRows);
    const MeBool isWarm = j->numWarm == j->numRows;
    for (int r = 0; r < j->numRows; r++) {
        subtractWorldVelocity(&j->worldVelocity, &rows[r]);
        rows[r].owner = owner;
        rows[r].force = isWarm ? j->warm[r] : rows[r].force;
        rows[r].ripple = isWarm ? j->ripple[r] : 0;
    }
    p->kea.numRows += j->numRows;
}

/* The place of a contact in the middle and at the end of the part. */
static void moveContact(MdtIsland *p, const MdtIslandContact *c, const MdtBclContext *x) {
    static const double share[2] = {0.5, 1};
    const MdtKeaVelocity *v = mdt_pointWorldVelocity(c->point);
    for (int k = 0; k < 2 && c->numRows > 0; k++) {
        MdtKeaJBlockPair J[MdtBclGETMAXROWSCONTACT];
        MdtBclContactMove(&c->bcl, x, share[k], J);
        for (int r = 0; r < c->numRows; r++) {
            const MdtKeaRow *row = &p->kea.rows[c->firstRow + r];
            MdtKeaMove *move = &p->kea.moves[c->firstRow + r][k];
            memcpy(move->J, J[r], sizeof J[r]);
            move->rate = worldRate(v, row, J[r]) - worldRate(v, row, row->J);
        }
    }
}

/* The friction of the last step turns with the contact, about the normal. */
static void turnFriction(const MdtBclContact *c, int numRows, MdtKeaRow rows[]) {
    const double angle = keaDot(c->turn, c->normal), cosine = cos(angle), sine = sin(angle);
    if (numRows < 3)
        return;
    const double primary = rows[1].force, secondary = rows[2].force;
    rows[1].force = cosine * primary - sine * secondary;
    rows[2].force = sine * primary + cosine * secondary;
}

static void fillContact(MdtIsland *p, MdtIslandContact *c, MdtBclContext *x, int owner) {
    MdtKeaRow *rows = p->kea.rows + p->kea.numRows;
    c->firstRow = p->kea.numRows;
    contactContext(c, x);
    if (c->numRows > 0)
        MdtBclContactFill(&c->bcl, x, rows);
    const MeBool isWarm = c->point->numWarm == c->numRows;
    for (int r = 0; r < c->numRows; r++) {
        subtractWorldVelocity(mdt_pointWorldVelocity(c->point), &rows[r]);
        rows[r].owner = owner;
        rows[r].force = isWarm ? c->point->force[r] : rows[r].force;
        rows[r].ripple = 0;
    }
    if (c->bcl.moves)
        moveContact(p, c, x);
    if (c->bcl.moves && isWarm)
        turnFriction(&c->bcl, c->numRows, rows);
    p->kea.numRows += c->numRows;
}

static void fillRows(MdtIsland *p) {
    int contact = 0;
    for (int i = 0; i < p->numActing; i++) {
        MdtJoint *j = mdt_asJoint(p->acting[i]);
        if (j) {
            fillJoint(p, j, mdt_ownerOfJoint(i));
            continue;
        }
        if (p->isFast)
            continue;
        MdtManifold *m = mdt_asManifold(p->acting[i]);
        MdtBclContext x;
        mdt_rowsContext(p, &m->base, &MdtBclWorldVelocity, &x);
        for (int k = 0; k < m->numPoints; k++, contact++)
            fillContact(p, &p->contacts[contact], &x, mdt_ownerOfContact(p, contact));
    }
    MEASSERT((p->isFast || contact == p->numContacts) && p->kea.numRows <= p->kea.maxRows);
}

/* Count, leave out what is too much, fill. */
void mdt_rowsMake(MdtIsland *p) {
    MdtWorldID w = p->world;
    const int rows = countRows(p);
    if (rows > w->maxMatrixSize)
        mdt_capRows(p, rows, w->maxMatrixSize);
    fillRows(p);
    if (p->isFast)
        mdt_crowdMake(p);
    if (p->number < w->sizeLogLength)
        w->sizeLog[p->number] = mdt_islandRows(p);
}

/* ---- elsewhere ---- */

/* Rows of joints move with the bodies from pass to pass. */
void MEAPI mdt_rowsMove(void *island, const MdtKeaTransformation poses[]) {
    const MdtIsland *p = island;
    MdtKeaRow rows[MdtBclGETMAXROWS];
    MdtBclContext x;
    for (int i = 0; i < p->numActing; i++) {
        MdtJoint *j = mdt_asJoint(p->acting[i]);
        if (!j || j->numRows == 0)
            continue;
        jointContext(p, j, &x);
        for (int k = 0; k < 2; k++)
            if (j->base.side[k].body)
                x.pose[k] = &poses[j->base.side[k].body->index];
        j->type->fill(&j->bcl, &x, rows);
        for (int r = 0; r < j->numRows; r++) {
            MdtKeaRow *row = &p->kea.rows[j->firstRow + r];
            memcpy(row->J, rows[r].J, sizeof row->J);
            memcpy(row->arm, rows[r].arm, sizeof row->arm);
            row->lower = rows[r].lower;
            row->upper = rows[r].upper;
        }
    }
}

void MEAPI mdt_rowsErrors(void *island, const MdtKeaTransformation poses[], double errors[]) {
    const MdtIsland *p = island;
    for (int i = 0; i < p->numActing; i++) {
        const MdtJoint *j = mdt_asJoint(p->acting[i]);
        const MdtKeaTransformation *pose[2];
        if (!j || !j->type->errors)
            continue;
        for (int k = 0; k < 2; k++)
            pose[k] = j->base.side[k].body ? &poses[j->base.side[k].body->index] : &MdtBclWorldPose;
        j->type->errors(&j->bcl, pose, errors + j->firstRow);
    }
}
