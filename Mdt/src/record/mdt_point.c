/* Contacts: their properties, shared within a manifold or of their own (mdt_manifold_i.h). */
#include "record/mdt_point_i.h"
#include "MeAssert.h"
#include <string.h>

/* The point's extra if it replaces the shared values of these flags; else null. */
static MdtExtra *findOwnExtra(const MdtPoint *p, int own) {
    const MdtManifold *block = mdt_blockOf(p);
    MdtExtra *extra = block->extras ? mdt_extraOf(block, p->slot) : NULL;
    return extra && (extra->record.flags & own) ? extra : NULL;
}

/* Writes a value of the manifold or of an extra. Writing an equal value does not end rest certificates. */
static void setProperty(MdtPoint *p, void *property, const void *value, size_t size) {
    if (memcmp(property, value, size) == 0)
        return;
    memcpy(property, value, size);
    mdt_constraintDisturb(&mdt_manifoldOf(p)->base);
}

/* The extra in which the point is to store its own value, created if necessary. Null if the value equals the shared one
 * (isShared) or no other point uses the shared one, which may then be written; also null if there is no memory. */
static MdtExtra *makeOwnExtra(MdtPoint *p, int own, MeBool isShared, const char *caller) {
    MdtManifold *block = mdt_blockOf(p);
    MdtExtra *extra = block->extras ? mdt_extraOf(block, p->slot) : NULL;
    if (isShared || mdt_countSlots(block) == 1) {
        if (extra && (extra->record.flags & own)) {
            extra->record.flags &= ~own;
            mdt_constraintDisturb(&mdt_manifoldOf(p)->base);
        }
        return NULL;
    }
    extra = mdt_extraMake(block, p->slot, caller);
    if (extra)
        extra->record.flags |= own;
    return extra;
}

/* Stores numbers of a point: in its extra, at offset `inExtra`, or in the manifold if no other point shares them. */
static void setNumbers(MdtPoint *p, int own, MeReal *shared, size_t inExtra, const MeReal *numbers, size_t size,
                       const char *caller) {
    const MeBool isShared = memcmp(shared, numbers, size) == 0;
    MdtExtra *extra = makeOwnExtra(p, own, isShared, caller);
    if (extra)
        setProperty(p, (char *)extra + inExtra, numbers, size);
    else if (!isShared && mdt_countSlots(mdt_blockOf(p)) == 1)
        setProperty(p, shared, numbers, size);
}

const MdtBclContactParams *mdt_pointParams(const MdtPoint *p) {
    const MdtExtra *own = findOwnExtra(p, MDT_OWN_PARAMS);
    return own ? &own->params : &mdt_blockOf(p)->surface->params;
}

void mdt_blockSetSurface(MdtManifold *block, const MdtBclContactParams *params) {
    MdtSurfaces *surfaces = &block->base.world->surfaces;
    const MdtSurface *before = block->surface;
    block->surface = mdt_surfaceAcquire(surfaces, params);
    mdt_surfaceRelease(surfaces, before);
    MEASSERT(block->surface->users > 0);
    mdt_constraintDisturb(block->group ? &block->group->base : &block->base);
}

void mdt_pointSetParams(MdtPoint *p, const MdtBclContactParams *params) {
    MdtManifold *block = mdt_blockOf(p);
    MdtExtra *extra = findOwnExtra(p, MDT_WATCHED);
    MdtBclContactParams own;
    memcpy(&own, params, sizeof own); /* with the padding, since parameters are compared as bytes */
    own.options &= ~MdtBclContactOptionUseDirection;
    if (extra) {
        own.options |= extra->params.options & MdtBclContactOptionUseDirection;
        setProperty(p, &extra->params, &own, sizeof own);
        return;
    }
    const MeBool isShared = memcmp(&block->surface->params, &own, sizeof own) == 0;
    extra = makeOwnExtra(p, MDT_OWN_PARAMS, isShared, "MdtContactSetParams");
    if (extra)
        setProperty(p, &extra->params, &own, sizeof own);
    else if (!isShared && mdt_countSlots(block) == 1)
        mdt_blockSetSurface(block, &own);
}

static const MeReal *rawNormal(const MdtPoint *p) {
    const MdtExtra *own = findOwnExtra(p, MDT_OWN_NORMAL);
    return own ? own->normal : mdt_blockOf(p)->normal;
}

void mdt_pointNormal(const MdtPoint *p, double normal[3]) {
    mdt_fromReal(normal, rawNormal(p));
    const double size = keaLength(normal);
    if (size > 0 && isfinite(size)) {
        keaScale(normal, 1 / size, normal);
        return;
    }
    keaZero(normal); /* normals of extremely large shapes may be zero or not finite */
    normal[2] = 1;
}

void mdt_pointSetNormal(MdtPoint *p, const MeReal normal[3]) {
    setNumbers(p, MDT_OWN_NORMAL, mdt_blockOf(p)->normal, offsetof(MdtExtra, normal), normal, 3 * sizeof *normal,
               "MdtContactSetNormal");
}

MeReal mdt_pointRadius(const MdtPoint *p, int side) {
    const MdtExtra *own = findOwnExtra(p, MDT_OWN_RADIUS);
    return own ? own->radius[side] : mdt_blockOf(p)->radius[side];
}

void mdt_pointSetRadius(MdtPoint *p, int side, MeReal radius) {
    MeReal both[2] = {mdt_pointRadius(p, 0), mdt_pointRadius(p, 1)};
    both[side] = radius;
    setNumbers(p, MDT_OWN_RADIUS, mdt_blockOf(p)->radius, offsetof(MdtExtra, radius), both, sizeof both,
               "MdtContactSetRadius");
}

double mdt_pointRim(const MdtPoint *p, int side, double axis[3]) {
    const MdtManifold *block = mdt_blockOf(p);
    const MdtExtra *extra = block->extras ? mdt_extraOf(block, p->slot) : NULL;
    keaZero(axis);
    if (!extra)
        return 0;
    keaCopy(axis, extra->axis[side]);
    return extra->rim[side];
}

MeBool mdt_pointIsRound(const MdtPoint *p, int side) {
    double axis[3];
    return mdt_pointRadius(p, side) > 0 || (mdt_blockOf(p)->extras && mdt_pointRim(p, side, axis) > 0);
}

void mdt_pointSetRim(MdtPoint *p, int side, double rim, const double axis[3]) {
    MdtManifold *block = mdt_blockOf(p);
    MdtExtra *extra = mdt_extraOf(block, p->slot);
    if (!extra && mdt_isAxis(axis))
        extra = mdt_extraMake(block, p->slot, "MdtContactSetRim");
    if (!extra)
        return;
    setProperty(p, &extra->rim[side], &rim, sizeof rim);
    setProperty(p, extra->axis[side], axis, sizeof extra->axis[side]);
}

/* Replaces `direction` by the unit vector along its projection on the contact plane; false if it is parallel to the
 * normal. */
static MeBool projectOnPlane(const double normal[3], double direction[3]) {
    const double before = keaLength(direction);
    keaAddScaled(direction, -keaDot(direction, normal), normal);
    const double size = keaLength(direction);
    if (!(size > 1e-6 * before))
        return MEFALSE;
    keaScale(direction, 1 / size, direction);
    return METRUE;
}

/* The default primary direction: the projection of x, z or y on the contact plane; a later one of these only if it is
 * more orthogonal to the normal by a margin. The margin keeps the choice between equivalent axes, as on level ground,
 * from changing with rounding: the warm start of friction is stored in coordinates along this direction. */
static void chooseDirection(const double n[3], double direction[3]) {
    static const int order[] = {0, 2, 1};
    const double clearly = 0.1;
    int min = order[0];
    for (int i = 1; i < 3; i++)
        if (fabs(n[order[i]]) < fabs(n[min]) - clearly)
            min = order[i];
    keaZero(direction);
    direction[min] = 1;
    projectOnPlane(n, direction);
}

void mdt_pointDirection(const MdtPoint *p, const double normal[3], double direction[3]) {
    const MdtExtra *own = findOwnExtra(p, MDT_OWN_DIRECTION);
    if (own) {
        keaCopy(direction, own->direction);
        if (projectOnPlane(normal, direction))
            return;
    }
    chooseDirection(normal, direction);
    MEASSERT(fabs(keaDot(normal, direction)) < 1e-6 && fabs(1 - keaLength(direction)) < 1e-6);
}

const MdtKeaVelocity *mdt_pointWorldVelocity(const MdtPoint *p) {
    const MdtManifold *block = mdt_blockOf(p);
    const MdtExtra *extra = block->extras ? mdt_extraOf(block, p->slot) : NULL;
    return extra ? &extra->worldVelocity : &MdtBclWorldVelocity;
}

void mdt_pointMotionWeights(const MdtPoint *p, double share[2]) {
    const MdtBaseConstraint *base = &mdt_manifoldOf(p)->base;
    const MeBool hasBoth = base->side[0].body && base->side[1].body;
    const MeBool isRound[2] = {hasBoth && mdt_pointIsRound(p, 0), hasBoth && mdt_pointIsRound(p, 1)};
    for (int k = 0; k < 2; k++)
        share[k] = isRound[0] != isRound[1] ? isRound[k] : hasBoth ? 0.5 : 1;
    MEASSERT(!hasBoth || share[0] + share[1] == 1);
}

/* Writes position and depth if they differ. */
static void setPositionAndDepth(MdtPoint *p, const double place[3], double depth) {
    if (p->position[0] == place[0] && p->position[1] == place[1] && p->position[2] == place[2] && p->depth == depth)
        return;
    keaCopy(p->position, place);
    p->depth = depth;
    mdt_constraintDisturb(&mdt_manifoldOf(p)->base);
}

void mdt_pointSetFound(MdtPoint *p, const double normal[3], const double share[2], const double position[3],
                       double depth) {
    const MdtBaseConstraint *base = &mdt_manifoldOf(p)->base;
    double place[3];
    keaCopy(place, position);
    for (int k = 0; k < 2; k++) {
        double lost[3];
        if (!base->side[k].body)
            continue;
        mdt_bodyRoundingOffset(base->side[k].body, position, lost);
        keaAddScaled(place, share[k], lost);
        depth -= (k == 0 ? 1 : -1) * keaDot(normal, lost);
    }
    setPositionAndDepth(p, place, depth);
}

void mdt_pointReset(MdtPoint *p) {
    static const MeReal up[3] = {0, 1, 0};
    static const double origin[3] = {0, 0, 0};
    MdtExtra *extra = mdt_extraOf(mdt_blockOf(p), p->slot);
    if (extra)
        extra->record.flags &= ~MDT_OWN_DIRECTION;
    mdt_pointSetParams(p, &mdt_blockOf(p)->base.world->surfaces.standard.params);
    mdt_pointSetNormal(p, up);
    for (int k = 0; k < 2; k++) {
        mdt_pointSetRadius(p, k, 0);
        mdt_pointSetRim(p, k, 0, origin);
        mdt_pointSetVertex(p, k, MEFALSE);
    }
    keaCopy(p->position, origin);
    p->depth = 0;
    keaZero(p->force);
    p->numWarm = 0;
    mdt_constraintDisturb(&mdt_manifoldOf(p)->base);
}

void mdt_manifoldClearWarmStart(MdtManifold *m) {
    for (MdtPoint *p = mdt_pointFirst(m); p; p = mdt_pointAfter(p)) {
        p->numWarm = 0;
        p->force[0] = 0;
    }
}
