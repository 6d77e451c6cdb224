/* Rows of a partition's constraints in one part of its step. Each type of joint has a file of MdtBcl; here its rows are
 * counted, filled in the order of simulation, and updated for Kea after the bodies have moved. They are followed by the
 * rows of contacts, which Kea makes from manifolds. A cap limits the sum (mdt_cap.c). */
#include "MeAssert.h"
#include "step/mdt_step_i.h"
#include <string.h>

/* The mean of two poses. */
static void setMeanPose(MdtKeaTransformation *mean, const MdtKeaTransformation *end) {
    for (int i = 0; i < 3; i++) {
        mean->pos[i] = 0.5 * (mean->pos[i] + end->pos[i]);
        for (int j = 0; j < 3; j++)
            mean->R[i][j] = 0.5 * (mean->R[i][j] + end->R[i][j]);
    }
}

static const MdtKeaTransformation *moverPose(const MdtIsland *p, const MdtMover *m, double share,
                                             MdtKeaTransformation *memory) {
    const double start = p->late + p->elapsed, h = p->parameters.stepsize;
    MdtKeaMoverPose(&m->kea, start + (share == 1 ? h : 0), memory);
    if (share == 0.5) {
        MdtKeaTransformation end;
        MdtKeaMoverPose(&m->kea, start + h, &end);
        setMeanPose(memory, &end);
    }
    return memory;
}

/* The pose of a body, or the world's, after a share of the part: in `poses`, or of a mover in `memory`. */
static inline const MdtKeaTransformation *poseOf(const MdtIsland *p, const MdtBody *b, double share,
                                                 const MdtKeaTransformation poses[], MdtKeaTransformation *memory) {
    if (b && b->mover)
        return moverPose(p, b->mover, share, memory);
    return b ? &poses[b->index] : &MdtBclWorldPose;
}

/* The further bodies of a mimic. */
static void setFurther(const MdtIsland *p, const MdtJoint *j, double share, const MdtKeaTransformation poses[],
                       MdtBclContext *x) {
    for (int k = 0; k < 2 && j->further[k]; k++) {
        const MdtBody *b = j->further[k];
        MEASSERT(b->mover || p->bodies[b->index] == b);
        x->body[2 + k] = b->mover ? MdtBclNO_BODY : b->index;
        x->pose[2 + k] = poseOf(p, b, share, poses, &x->moverPose[2 + k]);
        x->velocity[2 + k] = b->mover ? &b->mover->kea.chord : &p->kea.velocity[b->index];
    }
}

void mdt_jointContext(const MdtIsland *p, MdtJoint *j, double share, const MdtKeaTransformation poses[],
                      MdtBclContext *x) {
    const MdtKeaSystem *kea = &p->kea;
    x->parameters = p->parameters;
    x->elapsed = p->elapsed;
    x->isUpdate = MEFALSE;
    x->firstRow = j->firstRow;
    for (int k = 0; k < 2; k++) {
        const MdtBodyID b = mdt_sideBody(&j->base, k);
        const MdtMover *m = mdt_sideMover(&j->base, k);
        const MdtKeaVelocity *given = m ? &m->kea.chord : &j->worldVelocity;
        MEASSERT(!b || p->bodies[b->index] == b);
        x->body[k] = b ? b->index : MdtBclNO_BODY;
        x->kea[k] = b ? &b->kea : NULL;
        x->pose[k] = m ? moverPose(p, m, share, &x->moverPose[k]) : b ? &poses[b->index] : &MdtBclWorldPose;
        x->velocity[k] = b ? &kea->velocity[b->index] : given;
        x->predicted[k] = b ? &kea->predicted[b->index] : given;
        x->invMass[k] = b ? &kea->invMass[b->index] : &MdtBclWorldInvMass;
    }
    if (j->further[0])
        setFurther(p, j, share, poses, x);
}

void mdt_jointPoses(const MdtIsland *p, const MdtJoint *j, double share, const MdtKeaTransformation poses[],
                    const MdtKeaTransformation *pose[], MdtKeaTransformation memory[]) {
    for (int k = 0; k < 2; k++)
        pose[k] = poseOf(p, j->base.side[k].body, share, poses, &memory[k]);
    for (int k = 0; k < 2 && j->further[k]; k++)
        pose[2 + k] = poseOf(p, j->further[k], share, poses, &memory[2 + k]);
}

/* ---- counting ---- */

/* Warns when a joint becomes degenerate, once until it has not been so for a step. */
static void warnIfDegenerate(MdtIsland *p, MdtJoint *j) {
    p->isDegenerate = p->isDegenerate || j->bcl.isDegenerate;
    if (!j->bcl.isDegenerate || j->isDegenerate)
        return;
    j->isDegenerate = METRUE;
    if (j->wasDegenerate)
        return;
    MeWarning(2, "%s: a %s (sort key %d) cannot work as it stands: %s", MeCallerName("MdtWorldStep"), j->type->name,
              j->base.link.sortKey, j->type->degenerate);
}

static int prepareJoint(MdtIsland *p, MdtJoint *j) {
    MdtBclContext x;
    mdt_jointContext(p, j, 0, p->kea.pose, &x);
    j->numRows = j->type->prepare(&j->bcl, &x);
    MEASSERT(j->numRows >= 0 && j->numRows <= j->type->maxRows);
    warnIfDegenerate(p, j);
    return j->numRows;
}

static MeBool isUserConstraint(const MdtJoint *j) {
    return j->bcl.type == MdtBclUSER;
}

/* Calls the callbacks that make rows. First, because they may change other joints. */
static void makeUserRows(MdtIsland *p) {
    const MeProgramCall before = MeProgramEnter("MdtUserConstraintSetFunction");
    MdtJoint *j;
    for (int i = 0; (j = mdt_nextJoint(p, &i));)
        if (isUserConstraint(j))
            prepareJoint(p, j);
    MeProgramLeave(&before);
}

static int countJointRows(MdtIsland *p) {
    MdtJoint *j;
    int rows = 0;
    for (int i = 0; (j = mdt_nextJoint(p, &i));)
        rows += isUserConstraint(j) ? j->numRows : prepareJoint(p, j);
    return rows;
}

int mdt_rowsCount(MdtIsland *p) {
    return countJointRows(p) + MdtKeaCountContactRows(&p->kea);
}

/* ---- filling ---- */

/* m/s: the part of a row's rate that comes from the motion of the world's side. */
static double worldRate(const MdtKeaVelocity *v, const MdtKeaRow *row) {
    double rate = 0;
    for (int k = 0; k < 2; k++)
        if (row->body[k] == MdtBclNO_BODY)
            rate += keaDot(row->J[k].lin, v->lin) + keaDot(row->J[k].ang, v->ang);
    return rate;
}

/* Moves a known part of the rate to the right-hand side: subtracts it from the row's target. */
static void subtractRate(double rate, MdtKeaRow *row) {
    row->target -= rate;
    row->drift -= rate;
}

/* Sets the rate due to a mover to that of the row's present Jacobian, and that of its tail. */
static void setCarriedRate(MdtKeaRow *row) {
    const double rate = worldRate(row->mover, row) + (row->isSplit ? worldRate(row->mover, row + 1) : 0);
    subtractRate(rate - row->carried, row);
    row->carried = rate;
}

/* The velocities of a joint's mover; null: it has none. */
static const MdtKeaVelocity *velocityOfMover(const MdtJoint *j) {
    const MdtMover *m = mdt_sideMover(&j->base, 0) ? mdt_sideMover(&j->base, 0) : mdt_sideMover(&j->base, 1);
    for (int k = 0; k < 2 && !m && j->further[k]; k++)
        m = j->further[k]->mover;
    return m ? &m->kea.chord : NULL;
}

/* Sets the softness of angular rows, 1/(kg m²), to that of a linear row at a lever arm of the length scale. */
static void scaleAngularSoftness(const MdtWorld *w, MdtKeaRow rows[], int count) {
    const double length = (double)w->params.lengthScale;
    for (int r = 0; r < count; r++)
        if (keaDot(rows[r].J[0].lin, rows[r].J[0].lin) + keaDot(rows[r].J[1].lin, rows[r].J[1].lin) == 0)
            rows[r].softness /= length * length;
}

/* Lets errors that the program has made, by placing bodies or enabling joints, close without a velocity. */
static void removeBias(const MdtIsland *p, MdtJoint *j, MdtKeaRow rows[]) {
    double square = 0;
    if (j->gap == 0)
        return;
    for (int r = 0; r < j->numRows; r++) {
        square += rows[r].position ? rows[r].error * rows[r].error : 0;
        rows[r].isUnbiased = rows[r].position;
    }
    if (p->elapsed == 0)
        j->gap = sqrt(square);
}

/* Writes the joint's rows behind those of the system. `owner`: the number by which Kea identifies the joint's rows. */
static void fillJoint(MdtIsland *p, MdtJoint *j, int owner) {
    MdtKeaRow *rows = p->kea.rows + p->kea.numRows;
    MdtBclContext x;
    j->firstRow = p->kea.numRows;
    mdt_jointContext(p, j, 0, p->kea.pose, &x);
    MEASSERT(p->kea.numRows + j->numRows <= p->kea.maxRows);
    if (j->numRows > 0)
        j->type->fill(&j->bcl, &x, rows);
    if (mdt_constraintType(&j->base) != MdtBclUSER)
        scaleAngularSoftness(p->world, rows, j->numRows);
    const MeBool isWarm = j->numWarm == j->numRows;
    for (int r = 0; r < j->numRows; r++) {
        rows[r].carried = 0;
        rows[r].mover = velocityOfMover(j);
        if (rows[r].mover && !rows[r].isTail)
            setCarriedRate(&rows[r]);
        else
            subtractRate(worldRate(&j->worldVelocity, &rows[r]), &rows[r]);
        rows[r].owner = owner;
        rows[r].isFixed = j->type->keepsRows;
        rows[r].force = isWarm ? j->warm[r] : rows[r].force;
        rows[r].ripple = isWarm ? j->ripple[r] : 0;
    }
    removeBias(p, j, rows);
    p->kea.numRows += j->numRows;
}

/* Counts the rows, leaves out those beyond the cap, fills them. */
void mdt_rowsMake(MdtIsland *p) {
    const MdtWorld *w = p->world;
    MEASSERT(p->kea.numRows == 0);
    if (w->userConstraints > 0)
        makeUserRows(p);
    p->numRows = mdt_rowsCount(p);
    if (p->numRows > w->maxMatrixSize && p->numMembers == 0) /* batches are below the cap */
        p->numRows = mdt_capRows(p, p->numRows, w->maxMatrixSize);
    MdtJoint *j;
    for (int i = 0; (j = mdt_nextJoint(p, &i));)
        fillJoint(p, j, i);
    MdtKeaMakeContactRows(&p->kea);
    MEASSERT(p->isFast || p->kea.numRows == p->numRows);
    if (p->number < w->sizeLogLength && p->numMembers == 0)
        w->sizeLog[p->number] = p->numRows;
}

/* ---- rows at other poses ---- */

/* False: a pose that Kea tries has overflowed (gravity of 1e38 m/s²). That step will not be committed. */
static MeBool isInRange(const MdtKeaTransformation *pose) {
    return isfinite(keaDot(pose->pos, pose->pos) + pose->R[0][0]);
}

static MeBool arePosesInRange(const MdtJoint *j, const MdtBclContext *x) {
    for (int k = 0; k < 2; k++)
        if (!isInRange(x->pose[k]) || (j->further[k] && !isInRange(x->pose[2 + k])))
            return MEFALSE;
    return METRUE;
}

/* Updates the joints' Jacobians and bounds as bodies move from pass to pass. Where a pose has overflowed, they stay. */
void MEAPI mdt_rowsUpdateJacobians(void *island, const MdtKeaTransformation poses[]) {
    const MdtIsland *p = island;
    MdtKeaRow rows[MdtBclGETMAXROWS];
    MdtBclContext x;
    MdtJoint *j;
    for (int i = 0; (j = mdt_nextJoint(p, &i));) {
        if (j->numRows == 0 || j->type->keepsRows)
            continue;
        mdt_jointContext(p, j, p->kea.share, poses, &x);
        x.isUpdate = METRUE;
        MEASSERT(j->firstRow + j->numRows <= p->kea.numRows);
        if (!arePosesInRange(j, &x))
            continue;
        j->type->fill(&j->bcl, &x, rows);
        for (int r = 0; r < j->numRows; r++) {
            MdtKeaRow *row = &p->kea.rows[j->firstRow + r];
            memcpy(row->J, rows[r].J, sizeof row->J);
            memcpy(row->arm, rows[r].arm, sizeof row->arm);
            memcpy(row->bend, rows[r].bend, sizeof row->bend);
            row->curvature = rows[r].curvature;
            row->lower = rows[r].lower;
            row->upper = rows[r].upper;
        }
        for (MdtKeaRow *row = &p->kea.rows[j->firstRow], *end = row + j->numRows; row < end; row++)
            if (row->mover && !row->isTail)
                setCarriedRate(row);
    }
}

void MEAPI mdt_rowsErrors(void *island, const MdtKeaTransformation poses[], double errors[]) {
    const MdtIsland *p = island;
    const MdtJoint *j;
    for (int i = 0; (j = mdt_nextJoint(p, &i));) {
        const MdtKeaTransformation *pose[MdtBclMAXSIDES];
        MdtKeaTransformation memory[MdtBclMAXSIDES];
        if (!j->type->errors)
            continue;
        mdt_jointPoses(p, j, p->kea.share, poses, pose, memory);
        j->type->errors(&j->bcl, pose, errors + j->firstRow);
    }
}

int mdt_rowsPassed(const MdtIsland *p) {
    int count = 0;
    MdtJoint *j;
    for (int i = 0; (j = mdt_nextJoint(p, &i));) {
        const MdtKeaTransformation *pose[MdtBclMAXSIDES];
        MdtKeaTransformation memory[MdtBclMAXSIDES];
        if (!j->type->passed)
            continue;
        mdt_jointPoses(p, j, 1, MdtKeaEndPoses(&p->kea), pose, memory);
        count += j->type->passed(&j->bcl, pose);
    }
    return count;
}
