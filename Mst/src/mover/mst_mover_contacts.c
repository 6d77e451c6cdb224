/* What a mover touches, and what is in its way. */
#include "mover/mst_mover_i.h"

McdCapsule mst_moverCapsule(const MstMover *m, const double foot[3]) {
    McdCapsule c = {.radius = m->radius};
    mst_mad(c.end[0], foot, m->radius, m->up);
    mst_mad(c.end[1], foot, m->height - m->radius, m->up);
    return c;
}

/* ---- casts ------------------------------------------------------------------------------------------------------- */

static McdCapsule moved(const McdCapsule *c, double t, const double by[3]) {
    McdCapsule out = *c;
    mst_mad(out.end[0], c->end[0], t, by);
    mst_mad(out.end[1], c->end[1], t, by);
    return out;
}

/* Conservative advancement against one part: an open gap has a separating plane, and the shapes cannot touch before
 * that is reached. Returns the fraction, or `most`. */
static double castOntoChild(const MstMove *v, int child, const McdCapsule *c, const double by[3], double stop,
                            double max, McdNearGap *hit) {
    enum { MAX_ADVANCES = 50 };
    const double length = mst_length(by), enough = stop * 1e-3;
    McdNearGap gap;
    double t = 0;
    for (int i = 0; i < MAX_ADVANCES; i++) {
        const McdCapsule here = moved(c, t, by);
        if (!McdNearMeasure(v->near, child, &here, (max - t) * length + stop, &gap))
            return max;
        const double closing = -mst_dot(gap.normal, by);
        if (closing <= 1e-6 * length)
            return max;
        if (gap.distance <= stop + enough)
            break;
        t += (gap.distance - stop) / closing;
        if (t >= max)
            return max;
    }
    *hit = gap;
    return t;
}

static MeBool isOfContact(const MstMove *v, int child) {
    for (int i = 0; i < v->contactCount; i++)
        if (v->contact[i].child == child)
            return METRUE;
    return MEFALSE;
}

/* What is near comes first: it is hit first, and then the others are soon known to be too far. */
double mst_castMover(const MstMove *v, const McdCapsule *c, const double by[3], double stop, McdNearGap *hit) {
    double t = 1;
    if (!(mst_dot(by, by) > 0))
        return t;
    for (int i = 0; i < v->contactCount; i++)
        t = castOntoChild(v, v->contact[i].child, c, by, stop, t, hit);
    for (int i = 0; i < McdNearGetCount(v->near); i++)
        if (!isOfContact(v, i))
            t = castOntoChild(v, i, c, by, stop, t, hit);
    return t;
}

/* ---- contacts ---------------------------------------------------------------------------------------------------- */

/* Whether the surface just behind an edge can be stood on: what a point meets that falls onto it, a skin away from the
 * edge, from above the steepest ground that can be stood on. */
static MeBool isLedge(const MstMove *v, const McdNearGap *gap) {
    const MstMover *m = v->mover;
    const double b = m->skin, steepest = sqrt(1 - m->minUp * m->minUp) / fmax(m->minUp, 1e-3);
    double level[3], start[3], by[3];
    McdNearGap hit;
    mst_across(level, gap->normal, m->up);
    if (mst_dot(gap->position, m->up) - v->footing > m->stepHeight + m->skin || mst_dot(gap->normal, m->up) <= 1e-3)
        return MEFALSE;
    mst_mad(start, gap->position, -b / mst_length(level), level);
    mst_mad(start, start, b * (steepest + .5), m->up);
    mst_scale(by, m->up, -2 * b * (steepest + .5));
    const McdCapsule point = {{{start[0], start[1], start[2]}, {start[0], start[1], start[2]}}, 0};
    return mst_castMover(v, &point, by, 1e-3 * b, &hit) < 1 && mst_dot(hit.normal, m->up) >= m->minUp;
}

/* Whether another contact's part contains the point of this one and comes nearer to the capsule from there: then the
 * surface has no least distance at that point. So nothing is felt of edges inside of flat surfaces. */
static MeBool isInsideOf(const MstMove *v, const MstMoverContact *c, const MstMoverContact *other) {
    const double tolerance = 1e-3 * v->mover->skin;
    const McdCapsule point = {{{c->gap.position[0], c->gap.position[1], c->gap.position[2]},
                               {c->gap.position[0], c->gap.position[1], c->gap.position[2]}},
                              0};
    McdNearGap gap;
    double to[3];
    mst_sub(to, other->gap.position, c->gap.position);
    return mst_dot(to, c->gap.normal) > tolerance && McdNearMeasure(v->near, other->child, &point, tolerance, &gap);
}

static void addContact(MstMove *v, int child, const McdNearGap *gap) {
    int at = v->contactCount;
    if (at == MST_MOVER_CONTACTS) { /* the nearest ones are kept */
        at = 0;
        for (int i = 1; i < v->contactCount; i++)
            if (v->contact[i].gap.distance > v->contact[at].gap.distance)
                at = i;
        if (v->contact[at].gap.distance <= gap->distance)
            return;
    } else
        v->contactCount++;
    v->contact[at] = (MstMoverContact){.child = child, .gap = *gap};
}

static void dropInner(MstMove *v) {
    MeBool isDropped[MST_MOVER_CONTACTS] = {0};
    int kept = 0;
    for (int i = 0; i < v->contactCount; i++)
        for (int j = 0; j < v->contactCount && !isDropped[i]; j++)
            isDropped[i] = i != j && isInsideOf(v, &v->contact[i], &v->contact[j]);
    for (int i = 0; i < v->contactCount; i++)
        if (!isDropped[i])
            v->contact[kept++] = v->contact[i];
    v->contactCount = kept;
}

void mst_findMoverContacts(MstMove *v) {
    const McdCapsule c = mst_moverCapsule(v->mover, v->place);
    const double reach = 1.5 * v->mover->skin;
    McdNearGap gap;
    if (v->hasContacts && memcmp(v->foundAt, v->place, sizeof v->place) == 0)
        return;
    v->contactCount = 0;
    v->hasContacts = METRUE;
    mst_copy(v->foundAt, v->place);
    for (int i = 0; i < McdNearGetCount(v->near); i++)
        if (McdNearMeasure(v->near, i, &c, reach, &gap))
            addContact(v, i, &gap);
    dropInner(v);
    for (int i = 0; i < v->contactCount; i++) {
        MstMoverContact *contact = &v->contact[i];
        contact->isWalkable =
            mst_dot(contact->gap.normal, v->mover->up) >= v->mover->minUp || isLedge(v, &contact->gap);
    }
}
