/* The interactions of a convex type with the framework's other types, from the types' function tables. */
#include "convex/mcd_kind_i.h"
#include "model/mcd_motion_i.h"
#include "pair/mcd_pair_i.h"

static int MEAPI intersectConvex(McdModelPair *p, McdIntersectResult *result) {
    mcd_resultBegin(result, p);
    return mcd_convexContacts(p, result, "McdIntersect");
}

static int MEAPI intersectHalfSpace(McdModelPair *p, McdIntersectResult *result) {
    mcd_resultBegin(result, p);
    return mcd_planeContacts(p, result, "McdIntersect");
}

/* The interaction of a convex type with another one; without functions if the pair is not supported. */
static McdInteractions interactionsWith(const McdKind *other) {
    if (other->setShape)
        return (McdInteractions){.intersectFn = intersectConvex, .safeTimeFn = mcd_safeTimeConvex};
    if (other->isHalfSpace)
        return (McdInteractions){.intersectFn = intersectHalfSpace, .safeTimeFn = mcd_safeTimePlane};
    return (McdInteractions){.intersectFn = other->gather ? mcd_meshIntersect : 0};
}

void mcd_kindRegisterInteractions(McdFramework *frame, const McdKind *kind, const char *function) {
    if (!mcd_frameCheck(frame, function))
        return;
    MEASSERT(kind->setShape && kind->support && kind->face);
    for (int type = 0; type < frame->typeCount; type++) {
        const McdKind *other = frame->types[type].kind;
        if (!other || McdFrameworkGetInteractions(frame, kind->type, type) ||
            McdFrameworkGetInteractions(frame, type, kind->type))
            continue;
        McdInteractions interactions = interactionsWith(other);
        if (interactions.intersectFn)
            mcd_interactionRegister(frame, kind->type, type, &interactions);
    }
}
