/* API of contacts: geometry, parameters, the list for the contacts' maker. */
#include "api/mdt_api_i.h"
#include "MeAssert.h"
#include <string.h>

const MdtContactID MdtContactInvalidID = NULL;

MdtContactID MEAPI(MdtContactCreate)(const MdtWorldID w) {
    return (MdtContactID)mdt_pointCreate(w, "MdtContactCreate");
}

MdtContactID MEAPI MdtContactCreateBetween(const MdtWorldID w, const MdtBodyID b1, const MdtBodyID b2) {
    MdtContactID c = (MdtContactID)mdt_pointCreate(w, "MdtContactCreate");
    if (c)
        mdt_constraintSetBodies((MdtConstraintID)c, b1, b2, "MdtContactCreate");
    return c;
}

void MEAPI MdtContactReset(const MdtContactID c) {
    MdtPoint *p = mdt_pointOf(c, __func__);
    if (p)
        mdt_pointReset(p);
}

MdtConstraintID MEAPI MdtContactQuaConstraint(const MdtContactID c) {
    return (MdtConstraintID)c;
}

MdtContactID MEAPI MdtConstraintDCastContact(const MdtConstraintID c) {
    return mdt_isConstraint(c, __func__) && mdt_isPoint(c) ? (MdtContactID)c : NULL;
}

/* Ends the rest certificates of the contact's bodies: an input of the solver has changed. */
static void disturbManifold(const MdtPoint *p) {
    mdt_constraintDisturb(&mdt_manifoldOf(p)->base);
}

/* ---- geometry ---- */

void MEAPI MdtContactSetPosition(const MdtContactID c, const MeReal x, const MeReal y, const MeReal z) {
    MdtPoint *p = mdt_pointOf(c, __func__);
    const double position[3] = {x, y, z};
    if (!p || memcmp(p->position, position, sizeof position) == 0 ||
        !mdt_isPositionValid(__func__, "the position", mdt_manifoldOf(p)->base.world, x, y, z))
        return;
    keaCopy(p->position, position);
    disturbManifold(p);
}

static void writeResult(MeVector3 v, const char *caller, const double from[3]) {
    if (mdt_isPointer(caller, "the result", v))
        mdt_toReal(v, from);
}

void MEAPI MdtContactGetPosition(const MdtContactID c, MeVector3 v) {
    static const double none[3] = {0, 0, 0};
    const MdtPoint *p = mdt_pointOf(c, __func__);
    writeResult(v, __func__, p ? p->position : none);
}

/* True for a vector of positive, finite length; otherwise warns. */
static MeBool isDirection(const char *caller, const char *what, MeReal x, MeReal y, MeReal z) {
    const double v[3] = {x, y, z}, size = keaLength(v);
    if (size > 0 && isfinite(size))
        return METRUE;
    MeWarning(1, "%s: %s is (%g, %g, %g), it must have a length; nothing is changed", caller, what, (double)x,
              (double)y, (double)z);
    return MEFALSE;
}

void MEAPI MdtContactSetNormal(const MdtContactID c, const MeReal x, const MeReal y, const MeReal z) {
    MdtPoint *p = mdt_pointOf(c, __func__);
    const MeReal normal[3] = {x, y, z};
    double before[3], now[3] = {x, y, z};
    if (!p || !isDirection(__func__, "the normal", x, y, z))
        return;
    mdt_pointNormal(p, before);
    keaScale(now, 1 / keaLength(now), now);
    if (memcmp(before, now, sizeof now) != 0) /* another length of the same direction is no change */
        mdt_pointSetNormal(p, normal);
}

void MEAPI MdtContactGetNormal(const MdtContactID c, MeVector3 v) {
    const MdtPoint *p = mdt_pointOf(c, __func__);
    double normal[3] = {0, 0, 0};
    if (p)
        mdt_pointNormal(p, normal);
    writeResult(v, __func__, normal);
}

static MeBool isDepth(const char *caller, double depth) {
    const MeReal x[3] = {(MeReal)depth, 0, 0};
    if (mdt_areFinite(x))
        return METRUE;
    MeWarning(1, "%s: the penetration is %g, it must be a number that single precision can have; nothing is changed",
              caller, depth);
    return MEFALSE;
}

void MEAPI MdtContactSetPenetration(const MdtContactID c, const MeReal penetration) {
    MdtPoint *p = mdt_pointOf(c, __func__);
    if (!p || !isDepth(__func__, penetration) || p->depth == (double)penetration)
        return;
    p->depth = penetration;
    disturbManifold(p);
}

MeReal MEAPI MdtContactGetPenetration(const MdtContactID c) {
    const MdtPoint *p = mdt_pointOf(c, __func__);
    return p ? (MeReal)p->depth : 0;
}

void MEAPI MdtContactSetExact(const MdtContactID c, const double position[3], const double penetration) {
    MdtPoint *p = mdt_pointOf(c, __func__);
    double normal[3], share[2];
    if (!p || !mdt_isPointer(__func__, "the position", position) ||
        !mdt_isFinite3(__func__, "the position", (MeReal)position[0], (MeReal)position[1], (MeReal)position[2]) ||
        !isDepth(__func__, penetration))
        return;
    mdt_pointNormal(p, normal);
    mdt_pointMotionWeights(p, share);
    mdt_pointSetFound(p, normal, share, position, penetration);
}

void MEAPI MdtContactSetRadius(const MdtContactID c, const unsigned int bodyindex, const MeReal radius) {
    MdtPoint *p = mdt_pointOf(c, __func__);
    if (p && mdt_isSide(__func__, bodyindex) && mdt_isNotBelow(__func__, "the radius", radius, 0))
        mdt_pointSetRadius(p, (int)bodyindex, radius);
}

MeReal MEAPI MdtContactGetRadius(const MdtContactID c, const unsigned int bodyindex) {
    const MdtPoint *p = mdt_pointOf(c, __func__);
    return p && mdt_isSide(__func__, bodyindex) ? mdt_pointRadius(p, (int)bodyindex) : 0;
}

void MEAPI MdtContactSetRim(const MdtContactID c, const unsigned int bodyindex, const MeReal radius,
                            const MeVector3 axis) {
    MdtPoint *p = mdt_pointOf(c, __func__);
    double unit[3] = {0, 0, 0};
    if (!p || !mdt_isSide(__func__, bodyindex) || !mdt_isNotBelow(__func__, "the radius", radius, 0) ||
        !mdt_isPointer(__func__, "the axis", axis) || !isDirection(__func__, "the axis", axis[0], axis[1], axis[2]))
        return;
    for (int i = 0; i < 3; i++)
        unit[i] = (double)axis[i];
    keaScale(unit, radius > 0 ? 1 / keaLength(unit) : 0, unit);
    mdt_pointSetRim(p, (int)bodyindex, (double)radius, unit);
}

MeReal MEAPI MdtContactGetRim(const MdtContactID c, const unsigned int bodyindex, MeVector3 axis) {
    const MdtPoint *p = mdt_pointOf(c, __func__);
    double unit[3];
    if (!p || !mdt_isSide(__func__, bodyindex) || !mdt_isResult(__func__, axis, 3))
        return 0;
    const double rim = mdt_pointRim(p, (int)bodyindex, unit);
    keaScale(unit, rim > 0 ? 1 : 0, unit);
    mdt_toReal(axis, unit);
    return (MeReal)rim;
}

void MEAPI MdtContactSetEdge(const MdtContactID c, const unsigned int bodyindex, const MeVector3 axis) {
    MdtPoint *p = mdt_pointOf(c, __func__);
    double unit[3];
    if (!p || !mdt_isSide(__func__, bodyindex) || !mdt_isPointer(__func__, "the axis", axis) ||
        !mdt_isFinite3(__func__, "the axis", axis[0], axis[1], axis[2]))
        return;
    mdt_fromReal(unit, axis);
    const double length = keaLength(unit);
    keaScale(unit, length > 0 ? 1 / length : 0, unit);
    mdt_pointSetRim(p, (int)bodyindex, 0, unit);
}

MeBool MEAPI MdtContactGetEdge(const MdtContactID c, const unsigned int bodyindex, MeVector3 axis) {
    const MdtPoint *p = mdt_isResult(__func__, axis, 3) ? mdt_pointOf(c, __func__) : NULL;
    double unit[3];
    if (!p || !mdt_isSide(__func__, bodyindex))
        return MEFALSE;
    const MeBool isEdge = !(mdt_pointRim(p, (int)bodyindex, unit) > 0) && mdt_isAxis(unit);
    keaScale(unit, isEdge ? 1 : 0, unit);
    mdt_toReal(axis, unit);
    return isEdge;
}

void MEAPI MdtContactSetVertex(const MdtContactID c, const unsigned int bodyindex, const MeBool isVertex) {
    MdtPoint *p = mdt_pointOf(c, __func__);
    if (p && mdt_isSide(__func__, bodyindex))
        mdt_pointSetVertex(p, (int)bodyindex, isVertex);
}

MeBool MEAPI MdtContactIsVertex(const MdtContactID c, const unsigned int bodyindex) {
    const MdtPoint *p = mdt_pointOf(c, __func__);
    return p && mdt_isSide(__func__, bodyindex) && mdt_pointIsVertex(p, (int)bodyindex);
}

/* The contact's present primary direction and normal. */
static void getAxes(const MdtPoint *p, double direction[3], double normal[3]) {
    mdt_pointNormal(p, normal);
    mdt_pointDirection(p, normal, direction);
}

void MEAPI MdtContactSetDirection(const MdtContactID c, const MeReal x, const MeReal y, const MeReal z) {
    MdtPoint *p = mdt_pointOf(c, __func__);
    double direction[3] = {x, y, z}, before[3], normal[3], across[3];
    if (!p || !isDirection(__func__, "the direction", x, y, z))
        return;
    getAxes(p, before, normal);
    keaCross(across, normal, direction);
    if (!(keaLength(across) > 1e-6 * keaLength(direction))) {
        MeWarning(1, "MdtContactSetDirection: the direction is along the normal; nothing is changed");
        return;
    }
    MdtExtra *extra = mdt_extraMake(mdt_blockOf(p), p->slot, __func__);
    if (!extra)
        return;
    keaCopy(extra->direction, direction);
    extra->record.flags |= MDT_OWN_DIRECTION;
    extra->params.options |= MdtBclContactOptionUseDirection;
    getAxes(p, direction, normal);
    if (memcmp(before, direction, sizeof before) != 0)
        disturbManifold(p);
}

void MEAPI MdtContactGetDirection(const MdtContactID c, MeVector3 v) {
    const MdtPoint *p = mdt_pointOf(c, __func__);
    double normal[3], direction[3] = {0, 0, 0};
    if (p)
        getAxes(p, direction, normal);
    writeResult(v, __func__, direction);
}

/* ---- parameters ---- */

/* The contact's own parameters, created if necessary. The program may write them from now on: a hash of them is
 * compared in every step. */
static MdtBclContactParams *watchedParams(MdtPoint *p, const char *caller) {
    MdtManifold *m = mdt_manifoldOf(p);
    const MdtBclContactParams shown = *mdt_pointParams(p);
    MdtExtra *extra = mdt_extraMake(mdt_blockOf(p), p->slot, caller);
    if (!extra || (extra->record.flags & MDT_WATCHED))
        return extra ? &extra->params : NULL;
    const int isDirected = extra->params.options & MdtBclContactOptionUseDirection;
    memcpy(&extra->params, &shown, sizeof shown);
    extra->params.options |= isDirected;
    extra->record.flags |= MDT_OWN_PARAMS | MDT_WATCHED;
    mdt_constraintMarkWatched(&m->base);
    mdt_constraintDisturb(&m->base);
    return &extra->params;
}

MdtContactParamsID MEAPI MdtContactGetParams(const MdtContactID c) {
    MdtPoint *p = mdt_pointOf(c, __func__);
    return p ? watchedParams(p, __func__) : NULL;
}

void MEAPI MdtContactSetParams(const MdtContactID c, const MdtContactParamsID params) {
    MdtPoint *p = mdt_pointOf(c, __func__);
    if (p && mdt_isPointer(__func__, "the parameters", params))
        mdt_pointSetParams(p, params);
}

void MEAPI MdtContactSetWorldVelocity(const MdtContactID c, const MeReal x, const MeReal y, const MeReal z) {
    MdtPoint *p = mdt_pointOf(c, __func__);
    if (p)
        ME_UNDER_OWN_NAME(MdtConstraintSetWorldLinearVelocity((MdtConstraintID)c, x, y, z));
}

void MEAPI MdtContactGetWorldVelocity(const MdtContactID c, MeVector3 v) {
    ME_UNDER_OWN_NAME(MdtConstraintGetWorldLinearVelocity(MdtContactQuaConstraint(c), v));
}

void MEAPI MdtContactGetRelativeVelocity(const MdtContactID c, MeVector3 v) {
    const MdtPoint *p = mdt_isResult(__func__, v, 3) ? mdt_pointOf(c, __func__) : NULL;
    if (!p)
        return;
    MeVector3 point, of[2];
    mdt_toReal(point, p->position);
    for (unsigned int k = 0; k < 2; k++) {
        const MdtBodyID b = mdt_manifoldOf(p)->base.side[k].body; /* a hidden one, too */
        if (b)
            MdtBodyGetVelocityAtPoint(b, point, of[k]);
        else
            MdtContactGetWorldVelocity(c, of[k]);
    }
    for (int i = 0; i < 3; i++)
        v[i] = of[0][i] - of[1][i];
}

void MEAPI MdtContactSetFeature(const MdtContactID c, const MeU32 feature) {
    MdtPoint *p = mdt_pointOf(c, __func__);
    if (p)
        p->feature = feature;
}

MeU32 MEAPI MdtContactGetFeature(const MdtContactID c) {
    const MdtPoint *p = mdt_pointOf(c, __func__);
    return p ? p->feature : 0;
}

/* ---- the list ---- */

void MEAPI MdtContactSetNext(const MdtContactID c, const MdtContactID nc) {
    MdtPoint *p = mdt_pointOf(c, __func__);
    if (!p || (nc && !mdt_pointOf(nc, __func__)))
        return;
    MdtExtra *extra = mdt_extraMake(mdt_blockOf(p), p->slot, __func__);
    if (extra)
        extra->nextContact = nc;
}

MdtContactID MEAPI MdtContactGetNext(const MdtContactID c) {
    const MdtPoint *p = mdt_pointOf(c, __func__);
    const MdtExtra *extra = p ? mdt_extraOf(mdt_blockOf(p), p->slot) : NULL;
    return extra ? extra->nextContact : MdtContactInvalidID;
}

MdtContactGroupID MEAPI MdtContactGetContactGroup(const MdtContactID c) {
    const MdtPoint *p = mdt_pointOf(c, __func__);
    return p && mdt_isInGroup(p) ? (MdtContactGroupID)mdt_manifoldOf(p) : NULL;
}
