/* Joints whose bodies do not collide with each other: the switch of each joint, and Mst's query for two bodies.
 *
 * Mst queries every pair of models in every step. A world without such joints answers at once. Otherwise a flag of each
 * body says whether it has ever had such a joint; only if both bodies have the flag, their joints are searched. */
#include "MdtInternal.h"
#include "MeAssert.h"
#include "record/mdt_record_i.h"

void mdt_noCollideForget(MdtJoint *j) {
    const MdtConstraintID c = &j->base;
    c->world->numNoCollide -= (c->record.flags & MDT_NO_COLLIDE) != 0;
    c->record.flags &= ~MDT_NO_COLLIDE;
    MEASSERT(c->world->numNoCollide >= 0);
}

static void setNoCollide(MdtConstraintID c) {
    c->world->numNoCollide++;
    MEASSERT(c->world->numNoCollide <= c->world->jointPool.used);
    c->record.flags |= MDT_NO_COLLIDE;
    for (int k = 0; k < 2; k++)
        if (c->side[k].body)
            c->side[k].body->record.flags |= MDT_NO_COLLIDE;
}

void MEAPI MdtConstraintSetBodiesCollide(const MdtConstraintID c, const MeBool collide) {
    MDT_NEED_CONSTRAINT(c, );
    if (!mdt_isJoint(c)) {
        MeWarning(1, "%s: a %s is what a collision makes; nothing is changed", __func__, mdt_constraintName(c));
        return;
    }
    if (!collide == ((c->record.flags & MDT_NO_COLLIDE) != 0))
        return;
    if (collide)
        mdt_noCollideForget((MdtJoint *)(void *)c);
    else
        setNoCollide(c);
    for (int k = 0; k < 2; k++) /* it may rest on such contacts, or begin to collide */
        if (c->side[k].body && (c->record.flags & MDT_ENABLED))
            MdtBodyWakeIfAsleep(c->side[k].body);
}

MeBool MEAPI MdtConstraintGetBodiesCollide(const MdtConstraintID c) {
    MDT_NEED_CONSTRAINT(c, 0);
    return !(c->record.flags & MDT_NO_COLLIDE);
}

MeBool MEAPI MdtWorldHasNoCollide(const MdtWorldID w) {
    MEASSERT(MdtWorldIsValid(w));
    return w->numNoCollide > 0;
}

static MeBool isNoCollideJoint(const MdtAttachment *at, const MdtBody *other) {
    const MdtConstraintID c = mdt_attachmentOwner(at);
    const int both = MDT_ENABLED | MDT_NO_COLLIDE;
    return (c->record.flags & both) == both && c->side[1 - mdt_attachmentSide(at)].body == other;
}

/* Walks both bodies' lists in parallel: a joint between them is in both lists, so the shorter list limits the search.
 * */
MeBool MEAPI MdtBodiesAreNoCollide(const MdtBodyID b1, const MdtBodyID b2) {
    const MdtAttachment *of1 = b1->attachments, *of2 = b2->attachments;
    if (!(b1->record.flags & b2->record.flags & MDT_NO_COLLIDE))
        return MEFALSE;
    for (; of1 && of2; of1 = of1->next, of2 = of2->next)
        if (isNoCollideJoint(of1, b2) || isNoCollideJoint(of2, b1))
            return METRUE;
    return MEFALSE;
}
