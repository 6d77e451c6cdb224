/* Contacts: geometry, parameters, the list that their maker keeps. */
#include "MeAssert.h"
#include "mdt_i.h"
#include <string.h>

const MdtContactID MdtContactInvalidID = NULL;

static MdtBclContact *contactOf(const MdtContactID c, const char *caller) {
    MdtConstraintID base = mdt_constraintOfType(c, MdtBclCONTACT, caller);
    return base ? &base->bcl.of.contact : NULL;
}

/* Sets a part of a contact, which is renewed in every step: what is written as it was is no change. */
static void setPart(MdtConstraintID c, void *part, const void *value, size_t size) {
    if (memcmp(part, value, size) == 0)
        return;
    memcpy(part, value, size);
    mdt_constraintDisturb(c);
}

MdtContactID MEAPI(MdtContactCreate)(const MdtWorldID w) {
    return (MdtContactID)mdt_constraintCreate(w, MdtBclCONTACT, "MdtContactCreate");
}

MdtContactID MEAPI MdtContactCreateBetween(const MdtWorldID w, const MdtBodyID b1, const MdtBodyID b2) {
    MdtContactID c = (MdtContactCreate)(w);
    if (c)
        MdtContactSetBodies(c, b1, b2);
    return c;
}

void MEAPI MdtContactReset(const MdtContactID c) {
    MdtConstraintID base = mdt_constraintOfType(c, MdtBclCONTACT, __func__);
    if (!base)
        return;
    base->type->reset(&base->bcl);
    mdt_constraintDisturb(base);
}

MdtConstraintID MEAPI MdtContactQuaConstraint(const MdtContactID c) {
    return (MdtConstraintID)c;
}

MdtContactID MEAPI MdtConstraintDCastContact(const MdtConstraintID c) {
    return mdt_constraintCast(c, MdtBclCONTACT, __func__);
}

/* ---- geometry ---- */

void MEAPI MdtContactSetPosition(const MdtContactID c, const MeReal x, const MeReal y, const MeReal z) {
    MdtConstraintID base = mdt_constraintOfType(c, MdtBclCONTACT, __func__);
    if (!base || !mdt_isFinite3(__func__, "the position", x, y, z))
        return;
    const double position[3] = {x, y, z};
    setPart(base, base->bcl.of.contact.position, position, sizeof position);
}

static void readBack(MeVector3 v, const char *caller, const double *from) {
    static const double none[3] = {0, 0, 0};
    if (mdt_isPointer(caller, "the result", v))
        mdt_toReal(v, from ? from : none);
}

void MEAPI MdtContactGetPosition(const MdtContactID c, MeVector3 v) {
    const MdtBclContact *contact = contactOf(c, __func__);
    readBack(v, __func__, contact ? contact->position : NULL);
}

/* Makes `direction` a unit vector in the contact plane, as near as may be to what it is; false when it is along the
 * normal. */
static MeBool layIntoPlane(const double normal[3], double direction[3]) {
    const double before = keaLength(direction);
    keaAddScaled(direction, -keaDot(direction, normal), normal);
    const double size = keaLength(direction);
    if (!(size > 1e-6 * before))
        return MEFALSE;
    keaScale(direction, 1 / size, direction);
    return METRUE;
}

/* An axis across the normal gives the direction: x, or z, or y, if it is clearly more across than those before it. Of
 * two that are alike, as on level ground, rounding must not choose another one in the next step: friction forces are
 * kept as numbers along it. */
static void chooseDirection(const double n[3], double direction[3]) {
    static const int order[] = {0, 2, 1};
    const double clearly = 0.1;
    int least = order[0];
    for (int i = 1; i < 3; i++)
        if (fabs(n[order[i]]) < fabs(n[least]) - clearly)
            least = order[i];
    keaZero(direction);
    direction[least] = 1;
    layIntoPlane(n, direction);
}

static void fitDirection(MdtConstraintID c) {
    MdtBclContact *contact = &c->bcl.of.contact;
    const MeBool isSet = (contact->params.options & MdtBclContactOptionUseDirection) != 0;
    double direction[3];
    keaCopy(direction, contact->direction);
    if (!isSet || !layIntoPlane(contact->normal, direction))
        chooseDirection(contact->normal, direction);
    setPart(c, contact->direction, direction, sizeof direction);
}

/* A unit vector, or false with a warning. */
static MeBool toUnit(const char *caller, const char *what, MeReal x, MeReal y, MeReal z, double v[3]) {
    v[0] = x, v[1] = y, v[2] = z;
    const double size = keaLength(v);
    if (!(size > 0) || !isfinite(size)) {
        MeWarning(1, "%s: %s is (%g, %g, %g), it must have a length; nothing is changed", caller, what, (double)x,
                  (double)y, (double)z);
        return MEFALSE;
    }
    keaScale(v, 1 / size, v);
    return METRUE;
}

void MEAPI MdtContactSetNormal(const MdtContactID c, const MeReal x, const MeReal y, const MeReal z) {
    MdtConstraintID base = mdt_constraintOfType(c, MdtBclCONTACT, __func__);
    double normal[3];
    if (!base || !toUnit(__func__, "the normal", x, y, z, normal))
        return;
    const MdtBclContact *contact = &base->bcl.of.contact;
    setPart(base, base->bcl.of.contact.normal, normal, sizeof normal);
    fitDirection(base);
    MEASSERT(fabs(keaDot(contact->normal, contact->direction)) < 1e-6);
    MEASSERT(fabs(1 - keaLength(contact->direction)) < 1e-6);
}

void MEAPI MdtContactGetNormal(const MdtContactID c, MeVector3 v) {
    const MdtBclContact *contact = contactOf(c, __func__);
    readBack(v, __func__, contact ? contact->normal : NULL);
}

void MEAPI MdtContactSetPenetration(const MdtContactID c, const MeReal p) {
    MdtConstraintID base = mdt_constraintOfType(c, MdtBclCONTACT, __func__);
    const double penetration = p;
    if (base && mdt_isFinite(__func__, "the penetration", p))
        setPart(base, &base->bcl.of.contact.penetration, &penetration, sizeof penetration);
}

MeReal MEAPI MdtContactGetPenetration(const MdtContactID c) {
    const MdtBclContact *contact = contactOf(c, __func__);
    return contact ? (MeReal)contact->penetration : 0;
}

/* How much of a body's displacement its contact's position follows: that of the one that rolls, or moves at all. */
static double shareOf(const MdtBaseConstraint *base, int k) {
    const double *radius = base->bcl.of.contact.radius;
    if (base->side[0].body && base->side[1].body && (radius[0] > 0) != (radius[1] > 0))
        return radius[k] > 0;
    return base->side[1 - k].body ? 0.5 : 1;
}

void MEAPI MdtContactSetExact(const MdtContactID c, const double position[3], const double penetration) {
    MdtConstraintID base = mdt_constraintOfType(c, MdtBclCONTACT, __func__);
    if (!base || !mdt_isPointer(__func__, "the position", position) ||
        !mdt_isFinite3(__func__, "the position", (MeReal)position[0], (MeReal)position[1], (MeReal)position[2]) ||
        !mdt_isFinite(__func__, "the penetration", (MeReal)penetration))
        return;
    MdtBclContact *contact = &base->bcl.of.contact;
    double place[3], depth = penetration;
    keaCopy(place, position);
    for (int k = 0; k < 2; k++) {
        double lost[3];
        if (!base->side[k].body)
            continue;
        mdt_bodyLostByRounding(base->side[k].body, position, lost);
        keaAddScaled(place, shareOf(base, k), lost);
        depth -= (k == 0 ? 1 : -1) * keaDot(contact->normal, lost);
    }
    setPart(base, contact->position, place, sizeof place);
    setPart(base, &contact->penetration, &depth, sizeof depth);
}

void MEAPI MdtContactSetRadius(const MdtContactID c, const unsigned int bodyindex, const MeReal radius) {
    MdtConstraintID base = mdt_constraintOfType(c, MdtBclCONTACT, __func__);
    const double r = radius;
    if (base && mdt_isSide(__func__, bodyindex) && mdt_isAtLeast(__func__, "the radius", radius, 0))
        setPart(base, &base->bcl.of.contact.radius[bodyindex], &r, sizeof r);
}

MeReal MEAPI MdtContactGetRadius(const MdtContactID c, const unsigned int bodyindex) {
    const MdtBclContact *contact = contactOf(c, __func__);
    return contact && mdt_isSide(__func__, bodyindex) ? (MeReal)contact->radius[bodyindex] : 0;
}

void MEAPI MdtContactSetDirection(const MdtContactID c, const MeReal x, const MeReal y, const MeReal z) {
    MdtConstraintID base = mdt_constraintOfType(c, MdtBclCONTACT, __func__);
    double direction[3];
    if (!base || !toUnit(__func__, "the direction", x, y, z, direction))
        return;
    MdtBclContact *contact = &base->bcl.of.contact;
    if (!layIntoPlane(contact->normal, direction)) {
        MeWarning(1, "MdtContactSetDirection: the direction is along the normal; nothing is changed");
        return;
    }
    setPart(base, contact->direction, direction, sizeof direction);
    contact->params.options |= MdtBclContactOptionUseDirection;
}

void MEAPI MdtContactGetDirection(const MdtContactID c, MeVector3 v) {
    const MdtBclContact *contact = contactOf(c, __func__);
    readBack(v, __func__, contact ? contact->direction : NULL);
}

/* ---- parameters ---- */

MdtContactParamsID MEAPI MdtContactGetParams(const MdtContactID c) {
    MdtConstraintID base = mdt_constraintOfType(c, MdtBclCONTACT, __func__);
    if (!base)
        return NULL;
    if (!base->isWatched)
        mdt_constraintWatch(base); /* what the program writes there is seen only by looking */
    return &base->bcl.of.contact.params;
}

void MEAPI MdtContactSetParams(const MdtContactID c, const MdtContactParamsID p) {
    MdtConstraintID base = mdt_constraintOfType(c, MdtBclCONTACT, __func__);
    if (!base || !mdt_isPointer(__func__, "the parameters", p))
        return;
    MdtBclContactParams *own = &base->bcl.of.contact.params, params;
    memcpy(&params, p, sizeof params); /* padding and all: they are compared */
    params.options = (p->options & ~MdtBclContactOptionUseDirection) | (own->options & MdtBclContactOptionUseDirection);
    setPart(base, own, &params, sizeof params);
}

void MEAPI MdtContactSetWorldVelocity(const MdtContactID c, const MeReal x, const MeReal y, const MeReal z) {
    MdtBclContact *contact = contactOf(c, __func__);
    if (!contact)
        return;
    MdtConstraintSetWorldLinearVelocity(MdtContactQuaConstraint(c), x, y, z);
    contact->params.options |= MdtBclContactOptionUseWorldVelocity;
}

void MEAPI MdtContactGetWorldVelocity(const MdtContactID c, MeVector3 v) {
    MdtConstraintGetWorldLinearVelocity(MdtContactQuaConstraint(c), v);
}

void MEAPI MdtContactGetRelativeVelocity(const MdtContactID c, MeVector3 v) {
    const MdtBclContact *contact = mdt_isResult(__func__, v, 3) ? contactOf(c, __func__) : NULL;
    if (!contact)
        return;
    MeVector3 point, of[2];
    mdt_toReal(point, contact->position);
    for (unsigned int k = 0; k < 2; k++) {
        MdtBodyID b = MdtContactGetBody(c, k);
        if (b)
            MdtBodyGetVelocityAtPoint(b, point, of[k]);
        else
            MdtContactGetWorldVelocity(c, of[k]);
    }
    for (int i = 0; i < 3; i++)
        v[i] = of[0][i] - of[1][i];
}

void MEAPI MdtContactSetFeature(const MdtContactID c, const MeU32 feature) {
    MdtConstraintID base = mdt_constraintOfType(c, MdtBclCONTACT, __func__);
    if (base)
        base->feature = feature;
}

MeU32 MEAPI MdtContactGetFeature(const MdtContactID c) {
    MdtConstraintID base = mdt_constraintOfType(c, MdtBclCONTACT, __func__);
    return base ? base->feature : 0;
}

/* ---- the list ---- */

void MEAPI MdtContactSetNext(const MdtContactID c, const MdtContactID nc) {
    MdtConstraintID base = mdt_constraintOfType(c, MdtBclCONTACT, __func__);
    if (base && (!nc || contactOf(nc, __func__)))
        base->nextContact = nc;
}

MdtContactID MEAPI MdtContactGetNext(const MdtContactID c) {
    MdtConstraintID base = mdt_constraintOfType(c, MdtBclCONTACT, __func__);
    return base ? base->nextContact : MdtContactInvalidID;
}

MdtContactGroupID MEAPI MdtContactGetContactGroup(const MdtContactID c) {
    MdtConstraintID base = mdt_constraintOfType(c, MdtBclCONTACT, __func__);
    return base ? (MdtContactGroupID)base->group : NULL;
}
