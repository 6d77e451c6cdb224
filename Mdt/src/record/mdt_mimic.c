/* Mimics: before each step they get the frames and offsets of the two joints that they couple. */
#include "MeAssert.h"
#include "record/mdt_record_i.h"

/* The side of the mimic that has the body; NULL: the world. False: neither has it. */
static MeBool findSide(const MdtJoint *mimic, const MdtBody *b, int *side) {
    const MdtAttachment *at = mimic->base.side;
    *side = !b ? MdtBclNO_SIDE : b == at[0].body ? 0 : 1;
    return !b || b == at[0].body || b == at[1].body;
}

/* Copies what a coordinate is measured by. False: the joint does not act, or is attached to other bodies. */
static MeBool copyCoordinate(const MdtJoint *mimic, const MdtJoint *j, MdtBclCoordinate *q) {
    if (!j || !(j->base.record.flags & MDT_ENABLED))
        return MEFALSE;
    MEASSERT(j->bcl.type == MdtBclHINGE || j->bcl.type == MdtBclPRISMATIC);
    q->kind = j->bcl.type == MdtBclHINGE ? MdtBclCoordinateAngle : MdtBclCoordinateSlide;
    for (int k = 0; k < 2; k++) {
        q->frame[k] = j->bcl.frame[k];
        if (!findSide(mimic, j->base.side[k].body, &q->side[k]))
            return MEFALSE;
    }
    if (!q->isMeasured && j->bcl.of.limit.isMeasured) { /* full turns that the joint has counted */
        q->measured = j->bcl.of.limit.measured;
        q->isMeasured = METRUE;
    }
    return METRUE;
}

void mdt_mimicUpdate(MdtJoint *mimic) {
    MdtBclCoupling *u = &mimic->bcl.of.coupling;
    u->constant = u->offset;
    u->isReady = METRUE;
    for (int i = 0; i < 2 && u->isReady; i++) {
        const MdtJoint *j = u->joint[i];
        u->isReady = copyCoordinate(mimic, j, &u->coordinate[i]);
        if (u->isReady)
            u->constant -= u->coordinate[i].factor * (double)j->bcl.of.limit.offset;
    }
    for (int i = 0; i < 2 && !u->isReady; i++)
        u->coordinate[i].isMeasured = MEFALSE;
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
