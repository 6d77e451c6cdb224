/* Contacts at internal faces of compounds: where two parts of an aggregate abut or overlap, the faces between them are
 * no surface of the whole, and a contact there pushes into the neighbouring part (a ghost contact).
 *
 * A contact is on the surface of a part, whose outward normal there is the contact's. It is internal if the point a
 * little outside is in another part of the same model. A face's point at the border of that other part is not, if a
 * point beside it is on the surface of the whole: so the foot of a wall belongs to the floor. At an edge or a corner
 * another part may also be flush: no normal there is one of the whole, but those of the flush faces. (The same for
 * triangles: mcd_mesh_topology.c.)
 *
 * An internal manifold is dropped if one that is not, of the same part of the other model, separates the two as well:
 * as far as that one pushes, along its normal, they no longer overlap. So nothing is lost. What remains is in a corner
 * of the whole, and right, or deep between parts, each of which pushes into the other: there the manifold is replaced
 * by that of the least depth along a normal of the whole. */
#include "pair/mcd_compound_i.h"
#include "model/mcd_geometries_i.h"
#include "convex/mcd_kind_i.h"
#include "pair/mcd_pair_i.h"

#include <string.h>

/* Of a part's extent: what is nearer than this abuts, what is lower is flush. Places in single precision are off by up
 * to 5e-6 of the size a hundred sizes from the origin (docs/collision.md), twice as much against each other. Twice or
 * half of it fails Mcd_Compounds. */
static const double skinShare = 1e-4;
/* Of 8 degrees. A normal that leans by less over a face is that face's. What is a skin outside along one that leans by
 * more is above a flush neighbour by less than this share of the skin, and covered: with one limit for both, every
 * normal is the one or the other. With .98 for covers alone Mcd_Compounds fails. */
static const double flushCosine = .99;
/* The sine of the angle between the normal of a contact and of a face that are the same: contacts have theirs in single
 * precision, off by 6e-8 in each coordinate. */
static const double minSine = 1e-6;
/* Directions of least depth that are tried for what is deep between parts: as many as two boxes have. */
enum { MAX_DIRECTIONS = 12 };

/* ---- points and parts -------------------------------------------------------------------------------------------- */

/* A sphere without a radius. */
static const McdKind pointKind = {
    .type = kMcdGeometryTypeSphere, .support = mcd_pointSupport, .face = mcd_pointFace, .rank = MCD_RANK_SPHERE};

/* The signed distance of a point from a convex shape. */
static double distanceFrom(const McdShape *s, const double point[3]) {
    McdShape dot = {.kind = &pointKind, .extent = s->extent};
    double onDot[3], onShape[3], normal[3];
    mcd_copy(dot.place, point);
    for (int i = 0; i < 3; i++)
        dot.axis[i][i] = 1;
    return mcd_convexDistance(&dot, s, onDot, onShape, normal);
}

static MeBool isInBox(const McdGeometryInstance *child, const double point[3], double reach) {
    for (int i = 0; i < 3; i++)
        if (!(point[i] >= (double)child->min[i] - reach && point[i] <= (double)child->max[i] + reach))
            return MEFALSE;
    return METRUE;
}

/* The surface of a part where contacts of one normal are. Points are relative to the origin. */
typedef struct Surface {
    McdGeometryInstance *child, *whole;
    double origin[3], normal[3]; /* outward */
    McdShape shape;
    double skin;         /* m */
    MeBool isClassified; /* the others are set: */
    MeBool isOfFace;     /* the normal is that of a face, */
    double sine;         /* of the angle by which it leans off that, */
    double lean[3];      /* in this direction; 0: it does not, */
    MeBool isOfEdge;     /* or that of an edge or a corner between flat faces */
} Surface;

/* False: the part is no convex shape. */
static MeBool beginSurface(Surface *s, const McdContact *contact, McdGeometryInstance *child, int side) {
    s->child = child;
    s->isClassified = MEFALSE;
    s->whole = &mcd_record(child->model)->instance;
    mcd_copy(s->origin, contact->exactPosition);
    for (int i = 0; i < 3; i++)
        s->normal[i] = side ? (double)contact->normal[i] : -(double)contact->normal[i];
    if (!mcd_shapeOf(child, s->origin, &s->shape))
        return MEFALSE;
    s->skin = skinShare * s->shape.extent;
    for (int i = 0; i < 3; i++) /* roundings of the places of two parts */
        s->skin += 4 * (double)ME_EPSILON * fabs(s->origin[i]);
    return METRUE;
}

/* The first part within reach of a point, other than the surface's own; null: none. */
static McdGeometryInstance *childAt(const Surface *s, const McdGeometryInstance *whole, const double point[3],
                                    const double world[3], double reach) {
    McdGeometryInstance *found = 0;
    for (McdGeometryInstance *child = whole->firstChild; child && !found; child = child->nextSibling) {
        McdShape shape;
        if (child == s->child || !isInBox(child, world, reach))
            continue;
        if (child->firstChild)
            found = childAt(s, child, point, world, reach);
        else if (mcd_shapeOf(child, s->origin, &shape) && distanceFrom(&shape, point) <= reach)
            found = child;
    }
    return found;
}

static McdGeometryInstance *childNear(const Surface *s, const double point[3], double reach) {
    double world[3];
    mcd_mad(world, s->origin, 1, point);
    return childAt(s, s->whole, point, world, reach);
}

/* The part that covers what is a skin outside of a point of the surface. */
static McdGeometryInstance *coverAbove(const Surface *s, const double point[3]) {
    double outside[3];
    mcd_mad(outside, point, s->skin, s->normal);
    return childNear(s, outside, flushCosine * s->skin);
}

static void classifyNormal(Surface *s) {
    McdFace face;
    s->isClassified = METRUE;
    mcd_faceToward(&s->shape, s->normal, &face);
    const double cosine = mcd_dot(face.normal, s->normal);
    s->isOfFace = face.count > 2 && cosine > flushCosine;
    mcd_mad(s->lean, s->normal, -cosine, face.normal);
    s->sine = mcd_length(s->lean);
    mcd_scale(s->lean, s->lean, s->isOfFace && s->sine > minSine ? 1 / s->sine : 0);
    s->isOfEdge = face.count > 2 && (!s->isOfFace || s->sine > minSine);
}

/* At an edge of the face, over which the normal leans: the part that continues the face there. */
static McdGeometryInstance *coverBeyond(const Surface *s, const double point[3]) {
    double beyond[3];
    if (mcd_dot(s->lean, s->lean) == 0)
        return 0;
    mcd_mad(beyond, point, s->skin, s->lean);
    return distanceFrom(&s->shape, beyond) > s->skin / 2 ? childNear(s, beyond, s->skin / 2) : 0;
}

/* Is one of eight points of the face, on a square about the point, on the surface of the whole? */
static MeBool hasExposedNeighbour(const Surface *s, const double point[3]) {
    static const double around[8][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    double u[3], w[3], beside[3];
    mcd_basis(s->normal, u, w);
    for (int i = 0; i < 8; i++) {
        mcd_mad(beside, point, around[i][0] * s->skin, u);
        mcd_mad(beside, beside, around[i][1] * s->skin, w);
        if (distanceFrom(&s->shape, beside) <= (1 - flushCosine) * s->skin && !coverAbove(s, beside))
            return METRUE;
    }
    return MEFALSE;
}

/* The part that covers a point of the surface; null: it is on the surface of the whole. Lean: the sine of the angle by
 * which the normal leans over a flush face, or mcd_coveredLean. */
static McdGeometryInstance *coverOf(Surface *s, const double point[3], double *lean) {
    if (!childNear(s, point, 2 * s->skin))
        return 0;
    McdGeometryInstance *cover = coverAbove(s, point);
    if (!s->isClassified)
        classifyNormal(s);
    *lean = cover ? mcd_coveredLean : s->sine;
    if (!cover)
        return coverBeyond(s, point);
    return s->isOfFace && hasExposedNeighbour(s, point) ? 0 : cover;
}

/* ---- manifolds --------------------------------------------------------------------------------------------------- */

/* A manifold, and the surfaces that it is on. */
typedef struct Classified {
    const McdContact *contact; /* the manifold's first */
    McdChildManifold *m;
    Surface surface[2];
    MeBool isCompound[2]; /* and the part is convex; the others have no surface yet */
} Classified;

/* Is a point covered on either surface? Separation: from both surfaces; the point is half-way between them. */
static MeBool isCovered(Classified *l, const double position[3], double separation, MeBool isDeepest) {
    McdChildManifold *m = l->m;
    MeBool isIt = MEFALSE;
    for (int side = 0; side < 2; side++) {
        Surface *s = &l->surface[side];
        double point[3], lean;
        if (!l->isCompound[side])
            continue;
        mcd_sub(point, position, s->origin);
        mcd_mad(point, point, -separation / 2, s->normal);
        McdGeometryInstance *cover = coverOf(s, point, &lean);
        if (!cover)
            continue;
        isIt = METRUE;
        m->lean = fmax(m->lean, lean);
        m->skin = fmax(m->skin, s->skin);
        if (isDeepest)
            m->cover[side] = cover;
    }
    return isIt;
}

/* The surface on a side, classified; null: it is none. */
static Surface *surfaceOf(Classified *l, int side) {
    Surface *s = &l->surface[side];
    McdGeometryInstance *child = l->m->child[side];
    if (!l->isCompound[side] && (child->parent || !beginSurface(s, l->contact, child, side)))
        return 0;
    if (!s->isClassified)
        classifyNormal(s);
    return s;
}

/* Is the normal just that of a face of neither part, nor of a round side? Then edges make it, and not what is between
 * the contacts. */
static MeBool isOfEdges(Classified *l) {
    const Surface *a = surfaceOf(l, 0), *b = surfaceOf(l, 1);
    return a && b && a->isOfEdge && b->isOfEdge;
}

/* Are all contacts covered and, unless edges make the normal, the middle of these? */
static MeBool isInternal(Classified *l, int deepest) {
    const McdChildManifold *m = l->m;
    double mean[3] = {0, 0, 0}, separation = 0;
    for (int i = 0; i < m->count; i++) {
        const McdContact *c = &l->contact[(i + deepest) % m->count];
        if (!isCovered(l, c->exactPosition, c->exactSeparation, i == 0))
            return MEFALSE;
        mcd_mad(mean, mean, 1. / m->count, c->exactPosition);
        separation += c->exactSeparation / m->count;
    }
    return isOfEdges(l) || isCovered(l, mean, separation, MEFALSE);
}

static MeBool isConvex(const McdGeometryInstance *child) {
    const McdKind *kind = mcd_kindOf(child->geometry);
    return kind && kind->setShape;
}

/* Sets the members that follow from the contacts. What meets a plane or triangles is on the surface: convex parts alone
 * can be separated along a normal. */
static void classify(const McdContact *contact, McdChildManifold *m) {
    Classified l;
    int deepest = 0;
    l.contact = &contact[m->first];
    l.m = m;
    for (int i = 1; i < m->count; i++)
        if (l.contact[i].exactSeparation < l.contact[deepest].exactSeparation)
            deepest = i;
    m->separation = l.contact[deepest].exactSeparation;
    m->lean = m->skin = 0;
    m->cover[0] = m->cover[1] = 0;
    if (!isConvex(m->child[0]) || !isConvex(m->child[1]))
        return;
    for (int side = 0; side < 2; side++)
        l.isCompound[side] = m->child[side]->parent && beginSurface(&l.surface[side], l.contact, m->child[side], side);
    if (isInternal(&l, deepest))
        return;
    m->lean = 0;
    m->cover[0] = m->cover[1] = 0;
}

static MeBool isOfOneManifold(const McdContact *a, const McdContact *b) {
    return a->instance1 == b->instance1 && a->instance2 == b->instance2 &&
           memcmp(a->normal, b->normal, sizeof a->normal) == 0;
}

/* Divides contacts into manifolds; returns how many there are. */
static int makeManifolds(const McdContact *contact, int count, McdChildManifold *manifold) {
    int made = 0;
    for (int i = 0; i < count; i++) {
        if (i > 0 && isOfOneManifold(&contact[i - 1], &contact[i])) {
            manifold[made - 1].count++;
            continue;
        }
        McdChildManifold *m = &manifold[made++];
        memset(m, 0, sizeof *m);
        m->first = i;
        m->count = 1;
        m->child[0] = contact[i].instance1;
        m->child[1] = contact[i].instance2;
    }
    return made;
}

/* Normals by which a manifold separates: its own, and those of both parts' faces that are its own but for a tilt, of
 * which it has one where the other part's is as good. Returns how many. */
static int normalsOf(const McdContact *contact, const McdChildManifold *m, double normal[3][3]) {
    int count = 1;
    for (int i = 0; i < 3; i++)
        normal[0][i] = (double)contact[m->first].normal[i];
    for (int side = 0; side < 2; side++) {
        static const double origin[3] = {0, 0, 0};
        const double out = side ? 1 : -1;
        double outward[3];
        McdShape shape;
        McdFace face;
        if (!mcd_shapeOf(m->child[side], origin, &shape))
            continue;
        mcd_scale(outward, normal[0], out);
        mcd_faceToward(&shape, outward, &face);
        if (face.count > 2 && mcd_dot(face.normal, outward) > flushCosine)
            mcd_scale(normal[count++], face.normal, out);
    }
    return count;
}

/* The largest separation of a manifold's parts along another one's normals. */
static double separationAlong(const McdContact *contact, const McdChildManifold *m, const McdChildManifold *along) {
    double normal[3][3], origin[3], max = -INFINITY;
    McdShape a, b;
    const int count = normalsOf(contact, along, normal);
    mcd_pairOrigin(m->child[0], m->child[1], origin);
    if (!mcd_shapeOf(m->child[0], origin, &a) || !mcd_shapeOf(m->child[1], origin, &b))
        return max;
    for (int i = 0; i < count; i++)
        max = fmax(max, mcd_separationAlong(&a, &b, normal[i]) - a.rounding - b.rounding);
    return max;
}

/* Does another manifold separate the parts as well? One of the same part of the other model. */
static MeBool isSeparatedBy(const McdContact *contact, const McdChildManifold *m, const McdChildManifold *other) {
    for (int side = 0; side < 2; side++)
        if (m->cover[side] && other->child[!side] == m->child[!side])
            return separationAlong(contact, m, other) >= other->separation - m->skin;
    return MEFALSE;
}

/* The next larger lean of any manifold; INFINITY: there is none. */
static double nextLean(const McdChildManifold *all, int count, double lean) {
    double next = INFINITY;
    for (int i = 0; i < count; i++)
        if (all[i].lean > lean && all[i].lean < next)
            next = all[i].lean;
    return next;
}

/* Drops manifolds that lean by more than `above` and whose parts are separated by one that leans less. Those that lean
 * less come first, so that none is dropped for one that is dropped itself. */
static void dropSeparated(const McdContact *contact, McdChildManifold *all, int count, double above) {
    for (double lean = nextLean(all, count, above); lean < INFINITY; lean = nextLean(all, count, lean))
        for (int i = 0; i < count; i++)
            for (int k = 0; k < count && all[i].lean == lean && !all[i].isDropped; k++)
                all[i].isDropped = all[k].lean < lean && !all[k].isDropped && isSeparatedBy(contact, &all[i], &all[k]);
}

/* ---- what is deep between parts ---------------------------------------------------------------------------------- */

/* m: the shortest translation by d1 or more along the unit vector n1, and by d2 or more along n2, which point away from
 * each other. */
static double translationAlong(const double n1[3], double d1, const double n2[3], double d2) {
    const double c = mcd_dot(n1, n2), sine2 = 1 - c * c;
    MEASSERT(c < 0 && d1 > 0 && d2 > 0);
    return sine2 > 0 ? sqrt((d1 * d1 + d2 * d2 - 2 * c * d1 * d2) / sine2) : INFINITY;
}

/* m: how far the two parts must move for this manifold and those of the covering parts that push the other way; 0: none
 * does. */
static double translationWithCovers(const McdContact *contact, const McdChildManifold *m, const McdChildManifold *all,
                                    int count) {
    double n[2][3], max = 0;
    for (int i = 0; i < count; i++)
        for (int side = 0; side < 2; side++) {
            const McdChildManifold *other = &all[i];
            if (!m->cover[side] || other->child[side] != m->cover[side] || other->child[!side] != m->child[!side])
                continue;
            for (int k = 0; k < 3; k++) {
                n[0][k] = (double)contact[m->first].normal[k];
                n[1][k] = (double)contact[other->first].normal[k];
            }
            if (m->separation < 0 && other->separation < 0 && mcd_dot(n[0], n[1]) < 0)
                max = fmax(max, translationAlong(n[0], -m->separation, n[1], -other->separation));
        }
    return max;
}

/* Two parts that overlap, and the normals that are tried. */
typedef struct Overlap {
    McdShape shape[2];
    double origin[3], margin;
    double across[2][3]; /* from the other side's part, away from the line from each part to the one that covers it */
} Overlap;

static int countFaceNormals(const McdShape *s) {
    return s->hull ? s->hull->faceCount : 6;
}

/* The outward normal of a flat face; false: there is none of that number. */
static MeBool faceNormal(const McdShape *s, int i, double normal[3]) {
    if (s->hull) {
        const double *own = s->hull->face[i].normal;
        mcd_shapeDirection(s, own[0], own[1], own[2], normal);
        return METRUE;
    }
    mcd_scale(normal, s->axis[i / 2], i % 2 ? -1 : 1);
    return (s->kind->flatAxes >> i / 2 & 1) != 0;
}

/* The direction from b's part to a's of the normal of that number; false: there is none. */
static MeBool normalOf(const Overlap *e, int i, double normal[3]) {
    if (i < 2) {
        mcd_scale(normal, e->across[i], i ? 1 : -1);
        return mcd_dot(normal, normal) > 0;
    }
    const int first = countFaceNormals(&e->shape[0]);
    const MeBool isFirst = i - 2 < first;
    if (!faceNormal(&e->shape[!isFirst], isFirst ? i - 2 : i - 2 - first, normal))
        return MEFALSE;
    mcd_scale(normal, normal, isFirst ? -1 : 1);
    return METRUE;
}

typedef struct Direction {
    double normal[3], separation;
} Direction;

/* The normals of least depth, in ascending order of it, of equal ones by number; returns how many. */
static int chooseDirections(const Overlap *e, Direction direction[MAX_DIRECTIONS]) {
    const int normals = 2 + countFaceNormals(&e->shape[0]) + countFaceNormals(&e->shape[1]);
    int count = 0;
    for (int i = 0; i < normals; i++) {
        Direction d;
        if (!normalOf(e, i, d.normal))
            continue;
        d.separation = mcd_separationAlong(&e->shape[0], &e->shape[1], d.normal);
        int at = count < MAX_DIRECTIONS ? count++ : MAX_DIRECTIONS;
        for (; at > 0 && direction[at - 1].separation < d.separation; at--)
            if (at < MAX_DIRECTIONS)
                direction[at] = direction[at - 1];
        if (at < MAX_DIRECTIONS)
            direction[at] = d;
    }
    return count;
}

/* The part's place from the other's, without what is along the line to the cover. */
static void setAcross(const McdChildManifold *m, int side, Overlap *e) {
    McdShape cover;
    double line[3];
    mcd_set(e->across[side], 0, 0, 0);
    if (!m->cover[side] || !mcd_shapeOf(m->cover[side], e->origin, &cover))
        return;
    double *away = e->across[side];
    mcd_sub(away, e->shape[!side].place, e->shape[side].place);
    mcd_sub(line, cover.place, e->shape[side].place);
    const double square = mcd_dot(line, line);
    if (square > 0)
        mcd_mad(away, away, -mcd_dot(away, line) / square, line);
    const double length = mcd_length(away);
    mcd_scale(away, away, length > mcd_faceBias * e->shape[side].extent ? 1 / length : 0);
}

static MeBool beginOverlap(const McdModelPair *p, const McdChildManifold *m, Overlap *e) {
    mcd_pairOrigin(m->child[0], m->child[1], e->origin);
    if (!mcd_shapeOf(m->child[0], e->origin, &e->shape[0]) || !mcd_shapeOf(m->child[1], e->origin, &e->shape[1]))
        return MEFALSE;
    e->margin = mcd_childMargin(p, m->child[0], m->child[1]);
    setAcross(m, 0, e);
    setAcross(m, 1, e);
    return METRUE;
}

/* Contacts along a normal, where the parts touch along it: faces above each other, or a ball's lowest point on one. */
static int manifoldAlong(const Overlap *e, const double normal[3], double separation, McdManifold *m) {
    const McdShape *a = &e->shape[0], *b = &e->shape[1];
    const double back[3] = {-normal[0], -normal[1], -normal[2]};
    McdProximity p = {.separation = separation, .isGuess = METRUE};
    McdFace faceA, faceB;
    mcd_copy(p.normal, normal);
    mcd_faceToward(a, back, &faceA);
    mcd_faceToward(b, normal, &faceB);
    if (faceA.count > 1 && faceB.count > 1)
        return mcd_facesManifold(a, b, &faceA, &faceB, &p, e->margin, m);
    mcd_coreSupport(a, back, p.onA);
    mcd_coreSupport(b, normal, p.onB);
    const MeBool isOnA = faceA.count == 1; /* the point that is one; the other is where it is above the other shape */
    mcd_mad(isOnA ? p.onB : p.onA, isOnA ? p.onA : p.onB, isOnA ? -separation : separation, normal);
    if (distanceFrom(isOnA ? b : a, isOnA ? p.onB : p.onA) > mcd_faceBias * mcd_pairSize(a, b))
        return 0;
    return mcd_pointManifold(a, b, &p, 0, e->margin, m);
}

/* Puts contacts behind the others; returns how many. */
static int addContacts(const Overlap *e, const McdManifold *from, McdScratch *scratch, McdChildManifold *to) {
    const MeU32 path = mcd_featureMix(mcd_childPath(to->child[0]), mcd_childPath(to->child[1]));
    McdIntersectResult result;
    memset(&result, 0, sizeof result);
    result.contacts = scratch->contact + to->first;
    result.contactMaxCount = MCD_MANIFOLD_POINTS;
    mcd_resultAdd(&result, from, e->origin, to->child[0], to->child[1]);
    for (int i = 0; i < result.contactCount; i++)
        result.contacts[i].feature = mcd_featureMix(result.contacts[i].feature, path);
    return to->count = result.contactCount;
}

/* Makes the manifold of least depth on the surfaces of both models, less than a limit, behind the others. False: there
 * is none. */
static MeBool expose(const McdModelPair *p, McdScratch *scratch, int count, double limit, const McdChildManifold *m,
                     McdChildManifold *made) {
    Overlap e;
    McdManifold points;
    Direction direction[MAX_DIRECTIONS];
    if (!beginOverlap(p, m, &e) || !mcd_scratchReserveContacts(scratch, count, count + MCD_MANIFOLD_POINTS))
        return MEFALSE;
    const int directions = chooseDirections(&e, direction);
    *made = *m;
    made->first = count;
    for (int i = 0; i < directions && e.shape[0].rounding + e.shape[1].rounding - direction[i].separation < limit;
         i++) {
        if (!manifoldAlong(&e, direction[i].normal, direction[i].separation, &points) ||
            !addContacts(&e, &points, scratch, made))
            continue;
        classify(scratch->contact, made);
        if (made->lean > 0)
            continue;
        memcpy(made->cover, m->cover, sizeof made->cover);
        made->skin = m->skin;
        return METRUE;
    }
    return MEFALSE;
}

/* Replaces manifolds that are deep between parts; returns how many manifolds there are then. */
static int replaceDeep(const McdModelPair *p, McdScratch *scratch, int *count, int manifolds) {
    int all = manifolds;
    for (int i = 0; i < manifolds; i++) {
        McdChildManifold *m = &scratch->manifold[i];
        if (m->isDropped || m->lean < mcd_coveredLean)
            continue;
        const double limit = translationWithCovers(scratch->contact, m, scratch->manifold, manifolds);
        if (!(limit > -m->separation) || !expose(p, scratch, *count, limit, m, &scratch->manifold[all]))
            continue;
        m->isDropped = METRUE;
        *count += scratch->manifold[all++].count;
    }
    return all;
}

/* The next smaller separation of any manifold from number `first` on; -INFINITY: there is none. */
static double nextSeparation(const McdChildManifold *all, int first, int count, double separation) {
    double next = -INFINITY;
    for (int i = first; i < count; i++)
        if (all[i].separation < separation && all[i].separation > next)
            next = all[i].separation;
    return next;
}

/* Drops what has replaced another, from number `first` on, where a manifold of less depth separates the parts: not each
 * of the parts between which something is deep is below the face through which that leaves. The least deep ones come
 * first, so that none is dropped for one that is dropped itself. */
static void dropDeeper(const McdContact *contact, McdChildManifold *all, int first, int count) {
    for (double min = nextSeparation(all, first, count, INFINITY); min > -INFINITY;
         min = nextSeparation(all, first, count, min))
        for (int i = first; i < count; i++)
            for (int k = 0; k < count && all[i].separation == min && !all[i].isDropped; k++)
                all[i].isDropped = all[k].lean == 0 && !all[k].isDropped && all[k].separation > min + all[i].skin &&
                                   isSeparatedBy(contact, &all[i], &all[k]);
}

/* ---- the filter -------------------------------------------------------------------------------------------------- */

/* Moves what remains to the front. Returns the number of contacts. */
static int compact(McdContact *contact, const McdChildManifold *manifold, int manifolds) {
    int kept = 0;
    for (int i = 0; i < manifolds; i++) {
        const McdChildManifold *m = &manifold[i];
        if (m->isDropped)
            continue;
        MEASSERT(kept <= m->first);
        if (kept < m->first)
            memmove(&contact[kept], &contact[m->first], (size_t)m->count * sizeof *contact);
        kept += m->count;
    }
    return kept;
}

int mcd_dropInternalContacts(const McdModelPair *p, McdScratch *scratch, int count) {
    MeBool isAnyInternal = MEFALSE;
    if (count == 0 || !mcd_scratchReserveManifolds(scratch, 2 * count))
        return count;
    const int found = makeManifolds(scratch->contact, count, scratch->manifold);
    for (int i = 0; i < found; i++) {
        classify(scratch->contact, &scratch->manifold[i]);
        isAnyInternal |= scratch->manifold[i].lean > 0;
    }
    if (!isAnyInternal)
        return count;
    dropSeparated(scratch->contact, scratch->manifold, found, 0);
    const int manifolds = replaceDeep(p, scratch, &count, found);
    dropDeeper(scratch->contact, scratch->manifold, found, manifolds);
    dropSeparated(scratch->contact, scratch->manifold, manifolds, 1); /* covered ones: no sine is above 1 */
    const int kept = compact(scratch->contact, scratch->manifold, manifolds);
    MEASSERT(kept > 0);
    return kept;
}
