/* Persistent contacts (MdtInternal.h): matches the contacts found by collision with those of the last step, for warm
 * starting. */
#include "MdtInternal.h"
#include "MeAssert.h"
#include "api/mdt_api_i.h"
#include <string.h>

/* Clears the marks of all slots, used or not. */
static void clearFound(MdtManifold *m) {
    for (MdtManifold *block = m; block; block = block->next)
        for (int slot = 0; slot < MDT_POINTS; slot++)
            block->point[slot].isFound = MEFALSE;
}

static MdtContactID markFound(MdtPoint *p) {
    if (p)
        p->isFound = METRUE;
    return (MdtContactID)p;
}

/* The slots of the record whose contacts have this feature and are unmatched. All are compared without branches, which
 * would be mispredicted. */
static unsigned int slotsOfFeature(const MdtManifold *block, MeU32 feature) {
    unsigned int slots = 0;
    for (int slot = 0; slot < MDT_POINTS; slot++)
        slots |= (unsigned int)((block->point[slot].feature == feature) & !block->point[slot].isFound) << slot;
    return slots & block->used;
}

static MdtPoint *pointOfFeature(MdtManifold *m, MeU32 feature) {
    for (MdtManifold *block = m; block; block = block->next) {
        const unsigned int slots = slotsOfFeature(block, feature);
        if (slots)
            return &block->point[mdt_lowestSlot(slots)];
    }
    return NULL;
}

/* Predicted position of a contact: moved with its first body for `time` seconds since it was found. */
static void predictPosition(const MdtPoint *p, double time, double place[3]) {
    const MdtBodyID body = mdt_manifoldOf(p)->base.side[0].body;
    MeVector3 now, velocity = {0, 0, 0};
    mdt_toReal(now, p->position);
    if (body)
        MdtBodyGetVelocityAtPoint(body, now, velocity);
    for (int i = 0; i < 3; i++)
        place[i] = p->position[i] + time * (double)velocity[i];
}

static double distanceSquared(const double a[3], const double b[3]) {
    double difference[3];
    keaSubtract(difference, a, b);
    return keaDot(difference, difference);
}

/* Matches the closest pair of an unmatched found contact and an unmatched one of the group. Returns the latter; null if
 * there is none. */
static MdtPoint *matchNearest(const MdtManifold *m, const MdtFoundContact found[], int count, double time,
                              MdtContactID contacts[]) {
    MdtPoint *nearest = NULL;
    double min = HUGE_VAL;
    int match = 0;
    for (MdtPoint *p = mdt_pointFirst(m); p; p = mdt_pointAfter(p)) {
        double place[3];
        if (p->isFound)
            continue;
        predictPosition(p, time, place);
        for (int i = 0; i < count; i++) {
            const double distance = contacts[i] ? HUGE_VAL : distanceSquared(place, found[i].position);
            if (distance < min) {
                min = distance;
                nearest = p;
                match = i;
            }
        }
    }
    if (nearest)
        contacts[match] = markFound(nearest);
    return nearest;
}

/* Matches contacts by feature id, then the others by distance: feature ids of boxes that lie flat may change with
 * rounding, from a corner to an edge, while the points and their forces stay. */
static void matchContacts(MdtManifold *m, const MdtFoundContact found[], int count, double time,
                          MdtContactID contacts[]) {
    int unmatched = 0;
    clearFound(m);
    for (int i = 0; i < count; i++) {
        contacts[i] = markFound(pointOfFeature(m, found[i].feature));
        unmatched += contacts[i] == NULL;
    }
    while (unmatched > 0 && matchNearest(m, found, count, time, contacts))
        unmatched--;
}

static void destroyUnmatched(MdtManifold *m) {
    unsigned int others = 0;
    for (const MdtManifold *block = m; block; block = block->next)
        for (int slot = 0; slot < MDT_POINTS; slot++)
            others |= (unsigned int)!block->point[slot].isFound << slot & block->used;
    for (MdtPoint *p = others ? mdt_pointFirst(m) : NULL, *next; p; p = next) {
        next = mdt_pointAfter(p);
        if (!p->isFound)
            mdt_pointTerm(p);
    }
}

/* Sets a record's shared values to those of its first point; points that differ store their own values later. */
static void setSharedValues(MdtManifold *block, const MdtFoundContact *found) {
    if (memcmp(&block->surface->params, found->params, sizeof *found->params) != 0)
        mdt_blockSetSurface(block, found->params);
    if (memcmp(block->normal, found->normal, sizeof block->normal) == 0 &&
        memcmp(block->radius, found->radius, sizeof block->radius) == 0)
        return;
    memcpy(block->normal, found->normal, sizeof block->normal);
    memcpy(block->radius, found->radius, sizeof block->radius);
    mdt_constraintDisturb(block->group ? &block->group->base : &block->base);
}

static void setAllSharedValues(MdtManifold *m, const MdtFoundContact found[], int count,
                               const MdtContactID contacts[]) {
    for (MdtManifold *block = m; block; block = block->next) {
        int first = 0;
        while (first < count && !(contacts[first] && mdt_blockOf((MdtPoint *)contacts[first]) == block))
            first++;
        setSharedValues(block, &found[first < count ? first : 0]);
    }
}

/* Adds a point in the first free slot of the group. Null, with a warning, if the world is full. */
static MdtPoint *addPoint(MdtManifold *m, const MdtFoundContact *found) {
    for (MdtManifold *block = m; block; block = block->next)
        for (int slot = 0; slot < MDT_POINTS; slot++)
            if (!(block->used & 1u << slot)) {
                if (!mdt_constraintCount(m->base.world, "MdtContactGroupCreateContact"))
                    return NULL;
                m->numPoints++;
                mdt_constraintDisturb(&m->base);
                return mdt_slotActivate(block, slot);
            }
    MdtPoint *p = mdt_pointCreateIn(m, "MdtContactGroupCreateContact");
    if (p)
        setSharedValues(mdt_blockOf(p), found);
    return p;
}

static void setRadiusAndRim(MdtPoint *p, int side, const MdtFoundContact *found) {
    mdt_pointSetRadius(p, side, found->radius[side]);
    mdt_pointSetRim(p, side, found->rim[side], found->axis[side]);
}

/* True if the point already has the found values, in its extra (null: none) or shared with its record. Positions are
 * not compared. */
static MeBool hasFoundValues(const MdtManifold *block, const MdtExtra *extra, const MdtFoundContact *found) {
    const int own = extra ? extra->record.flags : 0;
    const MeReal *normal = own & MDT_OWN_NORMAL ? extra->normal : block->normal;
    const MeReal *radius = own & MDT_OWN_RADIUS ? extra->radius : block->radius;
    if ((own & (MDT_WATCHED | MDT_OWN_PARAMS)) || memcmp(normal, found->normal, sizeof found->normal) != 0 ||
        memcmp(radius, found->radius, sizeof found->radius) != 0)
        return MEFALSE;
    for (int k = 0; k < 2; k++) {
        if (!extra && mdt_isAxis(found->axis[k]))
            return MEFALSE;
        if (extra &&
            (extra->rim[k] != found->rim[k] || memcmp(extra->axis[k], found->axis[k], sizeof extra->axis[k]) != 0))
            return MEFALSE;
    }
    return memcmp(&block->surface->params, found->params, sizeof *found->params) == 0;
}

/* True if the contact needs no values of its own beside the group's first contact. */
static MeBool sharesValues(const MdtFoundContact *found, const MdtFoundContact *first) {
    return memcmp(found->normal, first->normal, sizeof found->normal) == 0 &&
           memcmp(found->radius, first->radius, sizeof found->radius) == 0 && found->params == first->params &&
           !mdt_isAxis(found->axis[0]) && !mdt_isAxis(found->axis[1]);
}

/* The found contact from which the last point was set; with its record if the record's shared values equal it. */
typedef struct Shared {
    const MdtManifold *block;
    const MdtFoundContact *found;
    double normal[3]; /* unit */
    double share[2];  /* of mdt_pointMotionWeights */
} Shared;

static void setPoint(MdtPoint *p, const MdtFoundContact *found, Shared *last) {
    const MdtManifold *block = mdt_blockOf(p);
    if (block != last->block || !sharesValues(found, last->found)) {
        const MdtExtra *extra = mdt_extraOf(block, p->slot);
        const MeBool isShared = !block->extras, isSame = (isShared || extra) && hasFoundValues(block, extra, found);
        if (!isSame) {
            mdt_pointSetParams(p, found->params);
            mdt_pointSetNormal(p, found->normal);
            for (int k = 0; k < 2; k++)
                setRadiusAndRim(p, k, found);
        }
        last->block = isShared && isSame ? block : NULL;
        last->found = found;
        mdt_pointNormal(p, last->normal);
        mdt_pointMotionWeights(p, last->share);
    }
    mdt_pointSetFound(p, last->normal, last->share, found->position, found->depth);
    p->feature = found->feature;
    for (int k = 0; k < 2; k++)
        mdt_pointSetVertex(p, k, found->isVertex[k]);
}

static MeBool areAllAlike(const MdtFoundContact found[], int count) {
    for (int i = 0; i < count; i++)
        if (!sharesValues(&found[i], &found[0]))
            return MEFALSE;
    return METRUE;
}

/* Nothing is taken from a pool if all records have the surface already, and all points that need an extra have one
 * (MdtContactGroupRenew makes extras for all points of a group, or for none). */
MeBool MEAPI MdtContactGroupGoesOn(MdtContactGroupID g, const MdtFoundContact found[], int count) {
    const MdtManifold *m = mdt_groupOf(g, __func__);
    if (!m || m->numPoints != count || count == 0 || (found->params->options & MdtBclContactOptionUseDirection))
        return MEFALSE;
    const MeBool areAlike = areAllAlike(found, count);
    for (int i = 0; i < count; i++)
        if (found[i].params != found[0].params)
            return MEFALSE;
    for (const MdtManifold *block = m; block; block = block->next) {
        if (memcmp(&block->surface->params, found->params, sizeof *found->params) != 0)
            return MEFALSE;
        for (const MdtPoint *p = mdt_pointIn(block, 0); p && !areAlike; p = mdt_pointIn(block, p->slot + 1))
            if (!mdt_extraOf(block, p->slot))
                return MEFALSE;
    }
    return METRUE;
}

int MEAPI MdtContactGroupRenew(MdtContactGroupID g, const MdtFoundContact found[], int count, MeReal time,
                               MdtContactID contacts[]) {
    MdtManifold *m = mdt_groupOf(g, __func__);
    Shared last = {NULL, NULL, {0, 0, 0}, {0, 0}};
    if (!m)
        return 0;
    const MeBool areAlike = areAllAlike(found, count);
    matchContacts(m, found, count, (double)time, contacts);
    destroyUnmatched(m);
    if (count > 0)
        setAllSharedValues(m, found, count, contacts);
    for (int i = 0; i < count; i++) {
        MdtPoint *p = contacts[i] ? mdt_asPoint((MdtConstraintID)contacts[i]) : addPoint(m, &found[i]);
        if (!p)
            return i;  /* the world is full, and a warning was given */
        if (!areAlike) /* every point gets an extra, so that later renewals allocate nothing */
            mdt_extraMake(mdt_blockOf(p), p->slot, "MdtContactGroupCreateContact");
        setPoint(p, &found[i], &last);
        contacts[i] = (MdtContactID)p;
    }
    MEASSERT((int)m->numPoints == count);
    MEVALIDATE(mdt_manifoldIsConsistent(m));
    return count;
}
