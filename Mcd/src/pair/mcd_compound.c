/* Contacts at internal faces of compounds: where two parts of an aggregate abut or overlap, the faces between them
 * are not part of the compound's surface, and a contact there pushes into the neighbouring part (a ghost contact).
 *
 * A contact lies on the surface of a part, whose outward normal there is the contact's. It is internal if the point
 * a little outside is in another part of the same model. Exception: a point of a face at the border of that other
 * part is not internal if a point beside it is on the compound's surface; so the foot of a wall belongs to the
 * floor. At an edge or corner another part may also be flush: then no normal there is one of the compound, except
 * those of the flush faces. A contact is also internal at an edge where a face of the part continues a face of
 * another part (mcd_seam.c).
 *
 * An internal manifold is dropped if a manifold that is not internal, of the same part of the other model, separates
 * the two parts as well: pushed apart as far as that manifold says, along its normal, they no longer overlap. So
 * nothing is lost. The remaining internal manifolds are in a corner of the compound, and right, or deep between
 * parts each of which pushes into the other: these are replaced by the manifold of the smallest depth along a normal
 * of the compound. */
#include "pair/mcd_compound_i.h"
#include "model/mcd_geometries_i.h"
#include "convex/mcd_seam_i.h"
#include "pair/mcd_pair_i.h"
#include "surface/mcd_pieces_i.h"

#include <string.h>

/* cos(8 degrees). A normal that leans by less over a face is that face's. A point one skin outside along a normal
 * that leans by more is above a flush neighbour by less than this fraction of the skin, and covered: with one limit
 * for both, every normal is either the one or the other. With .98 for covers alone Mcd_Compounds fails. */
static const double flushCosine = .99;
/* Number of directions of smallest depth that are tried for manifolds deep between parts: as many as two boxes have. */
enum { MAX_DIRECTIONS = 12 };

/* The surface of a part at the contacts of one normal. Points are relative to the origin. */
typedef struct Surface {
    McdPieces others;     /* the other parts of the model */
    double normal[3];     /* outward */
    McdShape shape, body; /* of the part, and of the other model's part */
    double skin;          /* m, see mcd_seamSkin */
    MeBool isClassified;  /* the members below are set */
    MeBool isOfFace;      /* the normal is that of a face */
    double sine;          /* of the angle between the normal and that face's */
    double lean[3];       /* unit direction in which the normal leans; 0: it does not */
    MeBool isOfEdge;      /* the normal is that of an edge or a corner between flat faces */
} Surface;

/* Sets the surface of a contact's part on one side; false if one of the parts is not convex. */
static MeBool beginSurface(Surface *s, const McdContact *contact, McdGeometryInstance *const child[2], int side) {
    s->others = (McdPieces){.own = child[side]};
    s->isClassified = MEFALSE;
    mcd_copy(s->others.origin, contact->exactPosition);
    mcd_fromReal(s->normal, contact->normal);
    mcd_scale(s->normal, s->normal, side ? 1 : -1);
    if (!mcd_shapeOf(s->others.own, s->others.origin, &s->shape) ||
        !mcd_shapeOf(child[!side], s->others.origin, &s->body))
        return MEFALSE;
    s->skin = mcd_seamSkin(&s->shape, &s->body, s->others.origin);
    return METRUE;
}

typedef struct Ball {
    const double *centre;
    double radius;
} Ball;

static MeBool isInBall(const McdPieces *others, McdGeometryInstance *child, void *context) {
    const Ball *ball = context;
    McdShape shape;
    return mcd_shapeOf(child, others->origin, &shape) && mcd_pointDistance(&shape, ball->centre) <= ball->radius;
}

/* The first convex part within reach of a point, other than the surface's own; null: none. */
static McdGeometryInstance *childNear(const Surface *s, const double point[3], double reach) {
    Ball ball = {point, reach};
    return mcd_piecesNear(&s->others, point, reach, isInBall, &ball);
}

/* The part beyond an internal edge of this part (mcd_seam.c); null: the contact is not at an internal edge. */
static McdGeometryInstance *childBeyondEdge(const Surface *s, const double point[3], double separation,
                                            MeBool isNearest, double *lean) {
    McdSeam seam = {
        .shape = s->shape, .body = &s->body, .separation = separation, .find = mcd_piecesFind, .pieces = &s->others};
    double face[3];
    seam.skin = s->skin;
    seam.gap = mcd_seamGap(&s->body);
    seam.isBeside = !isNearest;
    mcd_copy(seam.normal, s->normal);
    mcd_copy(seam.point, point);
    McdGeometryInstance *child = mcd_shapeIsRigid(&s->shape) ? mcd_seamPieceBeyond(&seam, face) : 0;
    const double cosine = child ? mcd_dot(face, s->normal) : 0;
    *lean = cosine > flushCosine ? sqrt(fmax(1 - cosine * cosine, 0)) : mcd_coveredLean;
    return child;
}

/* The part that covers the point one skin outside of a surface point; null: none. */
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
    mcd_scale(s->lean, s->lean, s->isOfFace && s->sine > mcd_minSine ? 1 / s->sine : 0);
    s->isOfEdge = face.count > 2 && (!s->isOfFace || s->sine > mcd_minSine);
}

/* The part that continues the face beyond an edge over which the normal leans; null: none. */
static McdGeometryInstance *coverBeyond(const Surface *s, const double point[3]) {
    double beyond[3];
    if (mcd_dot(s->lean, s->lean) == 0)
        return 0;
    mcd_mad(beyond, point, s->skin, s->lean);
    return mcd_pointDistance(&s->shape, beyond) > s->skin / 2 ? childNear(s, beyond, s->skin / 2) : 0;
}

/* Whether one of eight points of the face, on a square around the point, is on the compound's surface. */
static MeBool hasExposedNeighbour(const Surface *s, const double point[3]) {
    static const double around[8][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    double u[3], w[3], beside[3];
    mcd_basis(s->normal, u, w);
    for (int i = 0; i < 8; i++) {
        mcd_mad(beside, point, around[i][0] * s->skin, u);
        mcd_mad(beside, beside, around[i][1] * s->skin, w);
        if (mcd_pointDistance(&s->shape, beside) <= (1 - flushCosine) * s->skin && !coverAbove(s, beside))
            return METRUE;
    }
    return MEFALSE;
}

/* The part that covers a surface point; null: the point is on the compound's surface. *lean gets the sine of the
 * angle by which the normal leans over a flush face, or mcd_coveredLean. */
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

/* A manifold and the surfaces that it lies on. */
typedef struct Classified {
    const McdContact *contact; /* the manifold's first contact */
    McdChildManifold *m;
    Surface surface[2];
    MeBool isCompound[2]; /* the part belongs to a compound and both are convex; otherwise its surface is not set */
} Classified;

/* Whether a point is covered on either surface. The point is midway between both surfaces; separation: between them. */
static MeBool isCovered(Classified *c, const double position[3], double separation, MeBool isDeepest) {
    McdChildManifold *m = c->m;
    MeBool isCoveredAnywhere = MEFALSE;
    for (int side = 0; side < 2; side++) {
        Surface *s = &c->surface[side];
        double point[3], lean;
        if (!c->isCompound[side])
            continue;
        mcd_sub(point, position, s->others.origin);
        mcd_mad(point, point, -separation / 2, s->normal);
        McdGeometryInstance *cover = coverOf(s, point, &lean);
        if (!cover)
            cover = childBeyondEdge(s, point, separation, isDeepest, &lean);
        if (!cover)
            continue;
        isCoveredAnywhere = METRUE;
        m->lean = fmax(m->lean, lean);
        m->skin = fmax(m->skin, s->skin);
        if (isDeepest)
            m->cover[side] = cover;
    }
    return isCoveredAnywhere;
}

/* The classified surface on a side; null: the part has none. */
static Surface *surfaceOf(Classified *c, int side) {
    Surface *s = &c->surface[side];
    McdGeometryInstance *child = c->m->child[side];
    if (!c->isCompound[side] && (child->parent || !beginSurface(s, c->contact, c->m->child, side)))
        return 0;
    if (!s->isClassified)
        classifyNormal(s);
    return s;
}

/* Whether the normal is exactly that of a face of neither part, nor of a round side: then it comes from edges, and
 * the region between the contacts does not matter. */
static MeBool isOfEdges(Classified *c) {
    const Surface *a = surfaceOf(c, 0), *b = surfaceOf(c, 1);
    return a && b && a->isOfEdge && b->isOfEdge;
}

/* Whether all contacts are covered and also, unless the normal comes from edges, their centroid. */
static MeBool isInternal(Classified *c, int deepest) {
    const McdChildManifold *m = c->m;
    double mean[3] = {0, 0, 0}, separation = 0;
    for (int i = 0; i < m->count; i++) {
        const McdContact *contact = &c->contact[(i + deepest) % m->count];
        if (!isCovered(c, contact->exactPosition, contact->exactSeparation, i == 0))
            return MEFALSE;
        mcd_mad(mean, mean, 1. / m->count, contact->exactPosition);
        separation += contact->exactSeparation / m->count;
    }
    return isOfEdges(c) || isCovered(c, mean, separation, MEFALSE);
}

/* Sets the members of a manifold that follow from its contacts. Contacts with planes and triangles count as on the
 * surface: only convex parts can be separated along a normal. */
static void classifyManifold(const McdContact *contact, McdChildManifold *m) {
    Classified c;
    int deepest = 0;
    c.contact = &contact[m->first];
    c.m = m;
    for (int i = 1; i < m->count; i++)
        if (c.contact[i].exactSeparation < c.contact[deepest].exactSeparation)
            deepest = i;
    m->separation = c.contact[deepest].exactSeparation;
    m->lean = m->skin = 0;
    m->cover[0] = m->cover[1] = 0;
    if (!mcd_isConvex(m->child[0]) || !mcd_isConvex(m->child[1]))
        return;
    for (int side = 0; side < 2; side++)
        c.isCompound[side] = m->child[side]->parent && beginSurface(&c.surface[side], c.contact, m->child, side);
    if (isInternal(&c, deepest))
        return;
    m->lean = 0;
    m->cover[0] = m->cover[1] = 0;
}

static MeBool isOfOneManifold(const McdContact *a, const McdContact *b) {
    return a->instance1 == b->instance1 && a->instance2 == b->instance2 &&
           memcmp(a->normal, b->normal, sizeof a->normal) == 0;
}

/* Divides contacts into manifolds; returns their number. */
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

/* The normals along which a manifold separates: its own, and those of both parts' faces that differ from it only by
 * a tilt, which it has where the other part's face is equally good. Returns their number. */
static int normalsOf(const McdContact *contact, const McdChildManifold *m, double normal[3][3]) {
    int count = 1;
    mcd_fromReal(normal[0], contact[m->first].normal);
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

/* The largest separation of a manifold's parts along the normals of another manifold. */
static double separationAlong(const McdContact *contact, const McdChildManifold *m, const McdChildManifold *along) {
    double normal[3][3], origin[3], max = -INFINITY;
    McdShape a, b;
    const int count = normalsOf(contact, along, normal);
    if (!mcd_shapesOf(m->child[0], m->child[1], origin, &a, &b))
        return max;
    for (int i = 0; i < count; i++)
        max = fmax(max, mcd_separationAlong(&a, &b, normal[i]) - a.rounding - b.rounding);
    return max;
}

/* Whether another manifold, of the same part of the other model, separates the parts as well. */
static MeBool isSeparatedBy(const McdContact *contact, const McdChildManifold *m, const McdChildManifold *other) {
    for (int side = 0; side < 2; side++)
        if (m->cover[side] && other->child[!side] == m->child[!side])
            return separationAlong(contact, m, other) >= other->separation - m->skin;
    return MEFALSE;
}

/* The next larger lean among all manifolds; INFINITY: there is none. */
static double nextLean(const McdChildManifold *all, int count, double lean) {
    double next = INFINITY;
    for (int i = 0; i < count; i++)
        if (all[i].lean > lean && all[i].lean < next)
            next = all[i].lean;
    return next;
}

/* Drops manifolds that lean by more than `above` and whose parts are separated by a manifold that leans less.
 * Manifolds that lean less come first, so that none is dropped because of one that is dropped itself. */
static void dropSeparated(const McdContact *contact, McdChildManifold *all, int count, double above) {
    for (double lean = nextLean(all, count, above); lean < INFINITY; lean = nextLean(all, count, lean))
        for (int i = 0; i < count; i++)
            for (int k = 0; k < count && all[i].lean == lean && !all[i].isDropped; k++)
                all[i].isDropped = all[k].lean < lean && !all[k].isDropped && isSeparatedBy(contact, &all[i], &all[k]);
}

/* ---- manifolds deep between parts -------------------------------------------------------------------------------- */

/* m: the shortest translation by at least d1 along the unit vector n1 and at least d2 along n2; n1 . n2 < 0. */
static double translationAlong(const double n1[3], double d1, const double n2[3], double d2) {
    const double c = mcd_dot(n1, n2), sine2 = 1 - c * c;
    MEASSERT(c < 0 && d1 > 0 && d2 > 0);
    return sine2 > 0 ? sqrt((d1 * d1 + d2 * d2 - 2 * c * d1 * d2) / sine2) : INFINITY;
}

/* m: the largest translation of the two parts that resolves this manifold together with one of a covering part that
 * pushes the opposite way; 0: there is none. */
static double translationWithCovers(const McdContact *contact, const McdChildManifold *m, const McdChildManifold *all,
                                    int count) {
    double n[2][3], max = 0;
    for (int i = 0; i < count; i++)
        for (int side = 0; side < 2; side++) {
            const McdChildManifold *other = &all[i];
            if (!m->cover[side] || other->child[side] != m->cover[side] || other->child[!side] != m->child[!side])
                continue;
            mcd_fromReal(n[0], contact[m->first].normal);
            mcd_fromReal(n[1], contact[other->first].normal);
            if (m->separation < 0 && other->separation < 0 && mcd_dot(n[0], n[1]) < 0)
                max = fmax(max, translationAlong(n[0], -m->separation, n[1], -other->separation));
        }
    return max;
}

/* Two overlapping parts, and the normals to try. */
typedef struct Overlap {
    McdShape shape[2];
    double origin[3];
    McdReach reach;
    double across[2][3]; /* unit: from the other part, orthogonal to the line from each part to its cover */
} Overlap;

/* The normal number i to try, from b's part to a's; false: there is none. */
static MeBool normalOf(const Overlap *e, int i, double normal[3]) {
    if (i < 2) {
        mcd_scale(normal, e->across[i], i ? 1 : -1);
        return mcd_dot(normal, normal) > 0;
    }
    const int first = mcd_shapeFaces(&e->shape[0]);
    const MeBool isFirst = i - 2 < first;
    if (!mcd_shapeFaceNormal(&e->shape[!isFirst], isFirst ? i - 2 : i - 2 - first, normal))
        return MEFALSE;
    mcd_scale(normal, normal, isFirst ? -1 : 1);
    return METRUE;
}

typedef struct Direction {
    double normal[3], separation;
} Direction;

/* Chooses the normals of smallest depth, in ascending order of depth, then of number; returns their number. */
static int chooseDirections(const Overlap *e, Direction direction[MAX_DIRECTIONS]) {
    const int normals = 2 + mcd_shapeFaces(&e->shape[0]) + mcd_shapeFaces(&e->shape[1]);
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

/* Sets the direction of the part from the other part, without its component along the line to the cover. */
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
    if (!mcd_shapesOf(m->child[0], m->child[1], e->origin, &e->shape[0], &e->shape[1]))
        return MEFALSE;
    e->reach = mcd_childReach(p, m->child[0], m->child[1]);
    setAcross(m, 0, e);
    setAcross(m, 1, e);
    return METRUE;
}

/* Writes a manifold's contacts to the scratch; returns their number. */
static int addContacts(const Overlap *e, const McdManifold *from, McdScratch *scratch, McdChildManifold *to) {
    McdIntersectResult result;
    memset(&result, 0, sizeof result);
    result.contacts = scratch->contact + to->first;
    result.contactMaxCount = MCD_MANIFOLD_POINTS;
    mcd_resultAdd(&result, from, e->origin, to->child[0], to->child[1]);
    mcd_mixChildPaths(&result, 0, to->child[0], to->child[1]);
    return to->count = result.contactCount;
}

/* Appends to the scratch the manifold of smallest depth, below a limit, that lies on the surfaces of both compounds.
 * False: there is none. */
static MeBool addExposedManifold(const McdModelPair *p, McdScratch *scratch, int count, double limit,
                                 const McdChildManifold *m, McdChildManifold *made) {
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
        if (!mcd_manifoldAlong(&e.shape[0], &e.shape[1], direction[i].normal, direction[i].separation, e.reach,
                               &points) ||
            !addContacts(&e, &points, scratch, made))
            continue;
        classifyManifold(scratch->contact, made);
        if (made->lean > 0)
            continue;
        memcpy(made->cover, m->cover, sizeof made->cover);
        made->skin = m->skin;
        return METRUE;
    }
    return MEFALSE;
}

/* Replaces manifolds that are deep between parts; returns the number of manifolds then. */
static int replaceDeep(const McdModelPair *p, McdScratch *scratch, int *count, int manifolds) {
    int all = manifolds;
    for (int i = 0; i < manifolds; i++) {
        McdChildManifold *m = &scratch->manifold[i];
        if (m->isDropped || m->lean < mcd_coveredLean)
            continue;
        const double limit = translationWithCovers(scratch->contact, m, scratch->manifold, manifolds);
        if (!(limit > -m->separation) || !addExposedManifold(p, scratch, *count, limit, m, &scratch->manifold[all]))
            continue;
        m->isDropped = METRUE;
        *count += scratch->manifold[all++].count;
    }
    return all;
}

/* The next smaller separation among the manifolds from number `first` on; -INFINITY: there is none. */
static double nextSeparation(const McdChildManifold *all, int first, int count, double separation) {
    double next = -INFINITY;
    for (int i = first; i < count; i++)
        if (all[i].separation < separation && all[i].separation > next)
            next = all[i].separation;
    return next;
}

/* Drops replacements (manifolds from number `first` on) whose parts are separated by a manifold of smaller depth: if
 * a body is deep between several parts, not every part is below the face through which the body leaves. The
 * shallowest come first, so that none is dropped because of one that is dropped itself. */
static void dropDeeper(const McdContact *contact, McdChildManifold *all, int first, int count) {
    for (double min = nextSeparation(all, first, count, INFINITY); min > -INFINITY;
         min = nextSeparation(all, first, count, min))
        for (int i = first; i < count; i++)
            for (int k = 0; k < count && all[i].separation == min && !all[i].isDropped; k++)
                all[i].isDropped = all[k].lean == 0 && !all[k].isDropped && all[k].separation > min + all[i].skin &&
                                   isSeparatedBy(contact, &all[i], &all[k]);
}

/* ---- the filter -------------------------------------------------------------------------------------------------- */

/* Moves the contacts of the remaining manifolds to the front; returns their number. */
static int compactContacts(McdContact *contact, const McdChildManifold *manifold, int manifolds) {
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
        classifyManifold(scratch->contact, &scratch->manifold[i]);
        isAnyInternal |= scratch->manifold[i].lean > 0;
    }
    if (!isAnyInternal)
        return count;
    dropSeparated(scratch->contact, scratch->manifold, found, 0);
    const int manifolds = replaceDeep(p, scratch, &count, found);
    dropDeeper(scratch->contact, scratch->manifold, found, manifolds);
    dropSeparated(scratch->contact, scratch->manifold, manifolds,
                  1); /* the covered ones, whose lean exceeds any sine */
    const int kept = compactContacts(scratch->contact, scratch->manifold, manifolds);
    MEASSERT(kept > 0);
    return kept;
}
