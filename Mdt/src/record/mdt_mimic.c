/* Mimics: before each step they get the frames, bodies and offsets of the two joints that they couple. The first two
 * bodies are the sides of the mimic, which MdtMimicSetJoints has attached; others follow for the time of a step. */
#include "MeAssert.h"
#include "record/mdt_record_i.h"

static MdtBodyID bodyOfSide(const MdtJoint *mimic, int side) {
    return side < 2 ? mimic->base.side[side].body : mimic->further[side - 2];
}

/* The side of the mimic that has the body, which becomes a further one if none has; null: the world. */
static int findSide(MdtJoint *mimic, MdtBodyID b) {
    MdtBclCoupling *u = &mimic->bcl.of.coupling;
    if (!b)
        return MdtBclNO_SIDE;
    for (int k = 0; k < u->numSides; k++)
        if (bodyOfSide(mimic, k) == b)
            return k;
    MEASSERT(u->numSides < MdtBclMAXSIDES);
    mimic->further[u->numSides - 2] = b;
    return u->numSides++;
}

static MeBool isSource(const MdtJoint *j) {
    return j && (j->base.record.flags & MDT_ENABLED);
}

/* A frame whose primary axis is the second one. */
static MdtBclFrame turnedFrame(const MdtBclFrame *frame) {
    MdtBclFrame turned = *frame;
    keaCopy(turned.primary, frame->ortho);
    keaCopy(turned.ortho, frame->primary);
    return turned;
}

/* Of a car wheel the wheel, body 1, turns about the second axis of its frame, from the steering axis on. */
static void copyFrames(MdtJoint *mimic, const MdtJoint *j, MdtBclCoordinate *q) {
    const MeBool isWheel = j->bcl.type == MdtBclCARWHEEL;
    for (int k = 0; k < 2; k++) {
        const int of = isWheel ? 1 - k : k;
        q->frame[k] = isWheel ? turnedFrame(&j->bcl.frame[of]) : j->bcl.frame[of];
        q->side[k] = findSide(mimic, j->base.side[of].body);
    }
}

/* Copies what a coordinate is measured by, and first the full turns that a limit has counted. */
static void copyCoordinate(MdtJoint *mimic, const MdtJoint *j, MdtBclCoordinate *q) {
    const MeBool isWheel = j->bcl.type == MdtBclCARWHEEL;
    MEASSERT(isWheel || j->bcl.type == MdtBclHINGE || j->bcl.type == MdtBclPRISMATIC);
    q->kind = j->bcl.type == MdtBclPRISMATIC ? MdtBclCoordinateSlide : MdtBclCoordinateAngle;
    copyFrames(mimic, j, q);
    if (!q->isMeasured && !isWheel && j->bcl.of.limit.isMeasured) {
        q->measured = j->bcl.of.limit.measured;
        q->isMeasured = METRUE;
    }
}

static double offsetOf(const MdtJoint *j) {
    return j->bcl.type == MdtBclCARWHEEL ? 0 : (double)j->bcl.of.limit.offset;
}

/* Whether both sides are bodies of the joints, no two bodies are movers, and all others are in one partition: joints
 * that got other bodies, or a body that has become a mover, may have parted them. */
static MeBool areBodiesSound(const MdtJoint *mimic) {
    const MdtBclCoupling *u = &mimic->bcl.of.coupling;
    MeBool isUsed[MdtBclMAXSIDES] = {MEFALSE};
    int partition = -1, movers = 0;
    for (int i = 0; i < 4; i++)
        if (u->coordinate[i / 2].side[i % 2] != MdtBclNO_SIDE)
            isUsed[u->coordinate[i / 2].side[i % 2]] = METRUE;
    for (int k = 0; k < u->numSides; k++) {
        const MdtBody *b = bodyOfSide(mimic, k);
        if (!b)
            continue;
        if (!isUsed[k])
            return MEFALSE;
        movers += b->mover != NULL;
        if (!b->mover && partition >= 0 && b->partition != partition)
            return MEFALSE;
        partition = b->mover ? partition : b->partition;
    }
    return movers <= 1;
}

/* The first body of a joint that the program does not move, other than one; null: there is none. */
static MdtBodyID freeBodyOf(const MdtJoint *j, const MdtBody *other) {
    for (int k = 0; k < 2; k++)
        if (j->base.side[k].body && !j->base.side[k].body->mover && j->base.side[k].body != other)
            return j->base.side[k].body;
    return NULL;
}

static MdtBodyID anyBodyOf(const MdtJoint *j, const MdtBody *other) {
    const MdtBodyID first = j->base.side[0].body;
    return first && first != other ? first : j->base.side[1].body != other ? j->base.side[1].body : NULL;
}

void mdt_mimicFindBodies(MdtJoint *const source[2], MdtBodyID bodies[2]) {
    bodies[0] = freeBodyOf(source[0], NULL);
    bodies[1] = freeBodyOf(source[1], bodies[0]);
    for (int k = 0; k < 4; k++) { /* where one is empty, any other */
        MdtBodyID *empty = !bodies[0] ? &bodies[0] : !bodies[1] ? &bodies[1] : NULL;
        const MdtBody *other = empty == &bodies[0] ? bodies[1] : bodies[0];
        if (empty)
            *empty = k < 2 ? freeBodyOf(source[k], other) : anyBodyOf(source[k - 2], other);
    }
    if (!bodies[0]) {
        bodies[0] = bodies[1];
        bodies[1] = NULL;
    }
}

MeBool mdt_mimicUpdate(MdtJoint *mimic) {
    MdtBclCoupling *u = &mimic->bcl.of.coupling;
    const MdtJoint *const j[2] = {u->joint[0], u->joint[1]};
    u->constant = u->offset;
    u->numSides = 2;
    u->isReady = isSource(j[0]) && isSource(j[1]) && (mimic->base.side[0].body || mimic->base.side[1].body);
    mimic->further[0] = mimic->further[1] = NULL;
    for (int i = 0; i < 2 && u->isReady; i++) {
        copyCoordinate(mimic, j[i], &u->coordinate[i]);
        u->constant -= u->coordinate[i].factor * offsetOf(j[i]);
    }
    u->isReady = u->isReady && areBodiesSound(mimic);
    for (int i = 0; i < 2 && !u->isReady; i++)
        u->coordinate[i].isMeasured = MEFALSE;
    return u->isReady && u->numSides > 2;
}

void mdt_mimicForget(MdtJoint *j) {
    MdtWorldID w = j->base.world;
    w->mimics -= j->bcl.type == MdtBclMIMIC;
    MEASSERT(w->mimics >= 0);
    for (MdtLink *link = w->mimics > 0 ? w->constraints.first : NULL; link; link = link->next) {
        MdtJoint *mimic = mdt_asJoint(mdt_linkOwner(link));
        for (int i = 0; mimic && mimic->bcl.type == MdtBclMIMIC && i < 2; i++) {
            if (mimic->bcl.of.coupling.joint[i] != j)
                continue;
            mdt_constraintDisturb(&mimic->base);
            mimic->bcl.of.coupling.joint[i] = NULL;
        }
    }
}
