/* Dispatch of the convex narrow phase: which algorithm serves which pair of shapes.
 *
 * A cell's function finds the contact normal, in closed form where a short one exists. The contacts come from
 * clipping the faces along the normal, for all pairs alike (mcd_face.c). A pair whose cell is empty uses the
 * mirrored cell, with the shapes swapped. */
#include "convex/mcd_kind_i.h"

typedef MeBool (*Proximity)(const McdShape *a, const McdShape *b, double limit, McdProximity *p);

/* Separated boxes may be nearest at corners, which no separating axis of the 15 gives: these use GJK. */
static MeBool exactBoxBox(const McdShape *a, const McdShape *b, double limit, McdProximity *p) {
    if (!mcd_boxBoxProximity(a, b, limit, p))
        return MEFALSE;
    return p->separation <= 0 || mcd_coreProximity(a, b, limit, p);
}

enum { CLOSED = MCD_RANK_CYLINDER + 1 }; /* number of ranks with closed forms; all others use GJK and EPA */

#define POINTS   mcd_pointPointProximity
#define SEGMENT  mcd_pointSegmentProximity
#define SEGMENTS mcd_segmentSegmentProximity
#define CLAMPED  mcd_pointBoxProximity
#define INTUBE   mcd_pointCylinderProximity
#define AXES     exactBoxBox
#define GENERAL  mcd_coreProximity
/* clang-format off */
static const Proximity grid[CLOSED][CLOSED] = {
    /*              SPHERE   SPHYL     BOX      CYLINDER */
    /* SPHERE   */ {POINTS,  SEGMENT,  CLAMPED, INTUBE},
    /* SPHYL    */ {0,       SEGMENTS, GENERAL, GENERAL},
    /* BOX      */ {0,       0,        AXES,    GENERAL},
    /* CYLINDER */ {0,       0,        0,       GENERAL},
};
/* clang-format on */

static Proximity proximityOf(McdRank a, McdRank b) {
    MEASSERT(a <= b);
    return (int)b < CLOSED ? grid[a][b] : GENERAL;
}

static McdRank rankOf(const McdShape *s) {
    return s->kind->rank;
}

/* ---- preference for a face's normal --------------------------------------------------------- */

/* Replaces the proximity's normal by n if the angle between them has a cosine > .9 and the separation along n is at
 * least `min`. */
static void tryNormal(const McdShape *a, const McdShape *b, const double n[3], McdProximity *p, double min) {
    if (!(mcd_dot(n, p->normal) > .9))
        return;
    const double s = mcd_separationAlong(a, b, n);
    if (!(s >= min))
        return;
    mcd_copy(p->normal, n);
    p->separation = s;
}

/* Contact along two lines, of round sides or edges. Tries as normal the cross product of the lines or, if they are
 * parallel, the direction between them; `between` joins them. The searched normal is less exact: the search stops when
 * the depth is exact enough, and the normal's error is the square root of the depth's. */
static void tryNormalAcrossLines(const McdShape *a, const McdShape *b, const double u[3], const double w[3],
                                 const double between[3], McdProximity *p, double min) {
    const double squared = mcd_dot(u, u), other = mcd_dot(w, w);
    double n[3];
    mcd_cross(n, u, w);
    if (mcd_dot(n, n) < 1e-6 * squared * other)
        mcd_mad(n, between, -mcd_dot(between, u) / squared, u);
    const double length = mcd_length(n);
    if (!(length > 0))
        return;
    mcd_scale(n, n, (mcd_dot(n, p->normal) < 0 ? -1 : 1) / length);
    tryNormal(a, b, n, p, min);
}

static void tryNormalOfSides(const McdShape *a, const McdShape *b, const McdFace *faceA, const McdFace *faceB,
                             McdProximity *p, double min) {
    double u[3], w[3], between[3];
    mcd_sub(u, faceA->point[1], faceA->point[0]);
    mcd_sub(w, faceB->point[1], faceB->point[0]);
    mcd_sub(between, a->place, b->place);
    tryNormalAcrossLines(a, b, u, w, between, p, min);
}

/* The corner of a triangle that is not the nearest one to the other shape, nor the second. */
static int farthestCorner(const McdShape *triangle, const double outward[3]) {
    int farthest = 0;
    for (int i = 1; i < 3; i++)
        if (mcd_dot(triangle->corner[i], outward) < mcd_dot(triangle->corner[farthest], outward))
            farthest = i;
    return farthest;
}

/* Contact of the round side of shape a with an edge of triangle b. If both are parallel, but for rounding, the
 * direction is that to the edge beside the side's middle. */
static void tryNormalOfEdge(const McdShape *a, const McdShape *b, const McdFace *line, McdProximity *p, double min) {
    const int other = farthestCorner(b, p->normal);
    const double *from = b->corner[(other + 1) % 3], *to = b->corner[(other + 2) % 3];
    double u[3], w[3], beside[3], between[3];
    mcd_sub(u, line->point[1], line->point[0]);
    mcd_sub(w, to, from);
    const double square = mcd_dot(w, w), along = mcd_heightOver(a->place, from, w);
    mcd_mad(beside, from, square > 0 ? MeCLAMP(along / square, 0, 1) : 0, w);
    mcd_sub(between, a->place, beside);
    tryNormalAcrossLines(a, b, u, w, between, p, min);
}

/* Replaces the normal by a face's normal if these are equal to within rounding, so that it is constant from step to
 * step. */
static void preferFaceNormals(const McdShape *a, const McdShape *b, const McdFace *faceA, const McdFace *faceB,
                              McdProximity *p) {
    const double min = p->separation - mcd_faceBias * mcd_pairSize(a, b);
    double negated[3];
    mcd_scale(negated, faceA->normal, -1);
    const int first = faceA->count >= faceB->count; /* a polygon's normal is more exact than a line's */
    double best[3];
    if (faceA->count == 2 && faceB->count == 2) {
        tryNormalOfSides(a, b, faceA, faceB, p, min);
        return;
    }
    mcd_copy(best, p->normal);
    tryNormal(a, b, first ? negated : faceB->normal, p, min);
    if (mcd_distanceSquared(best, p->normal) == 0 && faceA->count == 2 && rankOf(b) == MCD_RANK_TRIANGLE)
        tryNormalOfEdge(a, b, faceA, p, min);
    if (mcd_distanceSquared(best, p->normal) == 0)
        tryNormal(a, b, first ? faceB->normal : negated, p, min);
    MEASSERT(p->separation >= min);
}

/* ---- manifolds and distances ------------------------------------------------------------------------------------- */

/* Compares the bounding spheres. If they are farther apart than the limit: false, with a lower bound of the
 * separation. */
static MeBool areSpheresWithin(const McdShape *a, const McdShape *b, double limit, McdProximity *p) {
    const double reach = a->extent + b->extent + MeMAX(limit, 0), squared = mcd_distanceSquared(a->place, b->place);
    p->separation = sqrt(squared) - a->extent - b->extent;
    return squared <= reach * reach;
}

/* Finds the proximity by the pair's cell of the grid. The normal points from b to a. */
static MeBool dispatchProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p) {
    const McdRank i = rankOf(a), j = rankOf(b);
    if (!areSpheresWithin(a, b, limit, p))
        return MEFALSE;
    if (i <= j)
        return proximityOf(i, j)(a, b, limit, p);
    McdProximity swapped;
    if (!proximityOf(j, i)(b, a, limit, &swapped)) {
        p->separation = swapped.separation;
        return MEFALSE;
    }
    mcd_scale(p->normal, swapped.normal, -1);
    p->separation = swapped.separation;
    p->isGuess = 0;
    mcd_copy(p->onA, swapped.onB);
    mcd_copy(p->onB, swapped.onA);
    return METRUE;
}

/* For checks, rad: by how much rounding may turn the normal of a search, which ends where no nearer point is found.
 * Places are rounded to eps L, L being the larger extent, and squared distances to 2 d eps L: points that lie up to
 * (2 d eps L)^1/2 beside the nearest one are as near, and turn the normal by (2 eps L / d)^1/2. The separation along it
 * is wrong by up to L times that. Errors seen are 5e-5 m in a falling arch of stones that are 9e-8 m apart, 4e-5 m
 * between a capsule of 800 m and a hull of 3 m, 1.3e-7 m apart, 1.3e-5 m between a hull of .9 m and a triangle of
 * .15 m, 1.8e-7 m apart, and 6.7e-5 m between a sphere and a corner of a triangle of 500 m, .2 m apart. */
static double searchedTurn(const McdShape *a, const McdShape *b, const McdProximity *p) {
    return sqrt(4 * DBL_EPSILON * MeMAX(a->extent, b->extent) / fabs(p->separation));
}

/* A normal is good to 2e-5 of the size, and that turn; a wrong feature has a larger error. */
static MeBool findProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p) {
    if (!dispatchProximity(a, b, limit, p))
        return MEFALSE;
    MEASSERT(p->separation <= limit);
    MEVALIDATE(mcd_isAlongNormal(a, b, p, 2e-5, 1e-9 + searchedTurn(a, b, p)));
    return METRUE;
}

static MeBool isPointCore(const McdShape *s) {
    return rankOf(s) == MCD_RANK_SPHERE;
}

static void findFacesAlong(const McdShape *a, const McdShape *b, const double n[3], McdFace *faceA, McdFace *faceB) {
    double back[3];
    mcd_scale(back, n, -1);
    mcd_faceToward(a, back, faceA);
    mcd_faceToward(b, n, faceB);
}

static MeBool areBoxes(const McdShape *a, const McdShape *b) {
    return rankOf(a) == MCD_RANK_BOX && rankOf(b) == MCD_RANK_BOX;
}

/* Two boxes, or a box and a triangle: for these all separating axes are tried (mcd_box_box.c, mcd_box_triangle.c). */
static MeBool areAllAxesTried(const McdShape *a, const McdShape *b) {
    return areBoxes(a, b) || (rankOf(a) == MCD_RANK_BOX && rankOf(b) == MCD_RANK_TRIANGLE);
}

/* Guesses the normal; where all separating axes are tried and the shapes overlap, the result is exact. False if they
 * are farther apart than the limit. */
static MeBool guessNormal(const McdShape *a, const McdShape *b, double limit, McdProximity *p) {
    if (!areSpheresWithin(a, b, limit, p))
        return MEFALSE;
    if (areAllAxesTried(a, b))
        return (areBoxes(a, b) ? mcd_boxBoxProximity : mcd_boxTriangleProximity)(a, b, limit, p);
    mcd_guessFaces(a, b, p);
    return p->separation <= limit;
}

static MeBool isSmoothPoint(const McdShape *s, const McdFace *f) {
    return s->kind->isSampled && f->count == 1 && f->isDisc;
}

/* The contact of a smooth surface, which is its support point: exact, while the search's witness points have the square
 * root of the separation's error. A guess is verified: 0 unless the other shape is there. */
static int smoothContact(const McdShape *a, const McdShape *b, MeBool isPointOfA, double margin, McdProximity *p,
                         McdManifold *m) {
    mcd_setFaceWitnesses(a, b, !isPointOfA, p);
    const McdShape *other = isPointOfA ? b : a;
    if (p->isGuess && !(mcd_pointDistance(other, isPointOfA ? p->onB : p->onA) + other->rounding <=
                        mcd_faceBias * mcd_pairSize(a, b)))
        return 0;
    return mcd_pointManifold(a, b, p, 0, margin, m);
}

static int clipFacesAlongNormal(const McdShape *a, const McdShape *b, McdReach reach, McdProximity *p, McdManifold *m) {
    McdFace faceA, faceB;
    findFacesAlong(a, b, p->normal, &faceA, &faceB);
    if (isSmoothPoint(a, &faceA) || isSmoothPoint(b, &faceB))
        return smoothContact(a, b, isSmoothPoint(a, &faceA), reach.margin, p, m);
    if (!p->isGuess &&
        !(areAllAxesTried(a, b) && p->separation <= 0)) { /* else the separating axes prefer face normals already */
        preferFaceNormals(a, b, &faceA, &faceB, p);
        if (faceA.count == 2 || faceB.count == 2) /* lines depend on the normal */
            findFacesAlong(a, b, p->normal, &faceA, &faceB);
    }
    return mcd_facesManifold(a, b, &faceA, &faceB, p, reach, m);
}

/* For shapes without contacts: stores the gap of their surfaces, which lie outside of the cores by the rounding.
 * Returns 0. */
static int storeGap(const McdShape *a, const McdShape *b, const McdProximity *p, McdManifold *m) {
    m->minGap = fmax(p->separation - a->rounding - b->rounding, 0);
    return 0;
}

/* Finds the manifold by the cheapest algorithm that is exact. Resting shapes mostly touch along a face's normal, and
 * round ones along a normal between their sides: these guesses only need verification. Other pairs use GJK and EPA. */
static int manifoldOf(const McdShape *a, const McdShape *b, McdReach reach, McdManifold *m) {
    const double limit = reach.margin + a->rounding + b->rounding;
    McdProximity p;
    m->count = 0;
    m->minGap = 0;
    mcd_set(m->normal, 0, 0, 1);
    if (isPointCore(a) || isPointCore(b))
        return findProximity(a, b, limit, &p) ? mcd_pointManifold(a, b, &p, 0, reach.margin, m) : storeGap(a, b, &p, m);
    if (!guessNormal(a, b, limit, &p))
        return storeGap(a, b, &p, m);
    if ((p.separation > 0 || (p.isGuess && mcd_isMinDepth(a, b, &p))) && clipFacesAlongNormal(a, b, reach, &p, m))
        return m->count;
    if (p.isGuess && mcd_guessSides(a, b, &p)) {
        if (!(p.separation <= limit))
            return storeGap(a, b, &p, m);
        if ((p.separation > 0 || mcd_isMinDepthOfRound(a, b, &p)) && clipFacesAlongNormal(a, b, reach, &p, m))
            return m->count;
    }
    if (p.isGuess && !findProximity(a, b, limit, &p))
        return storeGap(a, b, &p, m);
    return clipFacesAlongNormal(a, b, reach, &p, m);
}

static MeBool isManifoldWithin(const McdManifold *m, double margin) {
    for (int i = 0; i < m->count; i++)
        if (!(m->point[i].separation <= margin * (1 + 1e-9)) || !isfinite(mcd_length(m->point[i].position)))
            return MEFALSE;
    return m->count >= 0 && m->count <= MCD_MANIFOLD_POINTS;
}

int mcd_convexManifold(const McdShape *a, const McdShape *b, McdReach reach, McdManifold *m) {
    MEASSERT(a->extent > 0 && b->extent > 0 && a->rounding >= 0 && b->rounding >= 0);
    if (rankOf(a) <= rankOf(b))
        return manifoldOf(a, b, reach, m);
    const int count = manifoldOf(b, a, mcd_reachSwap(reach), m);
    mcd_manifoldSwap(m);
    MEASSERT(count == m->count && (isManifoldWithin(m, reach.margin) || !mcd_areResolved(a, b)));
    return count;
}

/* Moves the witness points of two overlapping boxes to the deepest point of the faces' intersection, where the
 * normal is a face's. The deepest corner itself may be beside the other face if several corners are equally deep to
 * within rounding. */
static void moveWitnessesToFaces(const McdShape *a, const McdShape *b, McdProximity *p) {
    McdFace faceA, faceB;
    McdManifold m;
    const McdManifoldPoint *deepest = m.point;
    findFacesAlong(a, b, p->normal, &faceA, &faceB);
    if (fmax(-mcd_dot(faceA.normal, p->normal), mcd_dot(faceB.normal, p->normal)) < 1 - 1e-9)
        return; /* an edge-edge contact has a single point */
    const int count = mcd_facesManifold(a, b, &faceA, &faceB, p, (McdReach){.margin = INFINITY}, &m);
    for (int i = 1; i < count; i++)
        if (m.point[i].separation < deepest->separation)
            deepest = &m.point[i];
    mcd_mad(p->onA, deepest->position, p->separation / 2, p->normal);
    mcd_mad(p->onB, deepest->position, -p->separation / 2, p->normal);
}

/* For checks: the difference of the witness points is the separation along the normal. */
static MeBool areWitnessesGood(const McdShape *a, const McdShape *b, const McdProximity *p) {
    double d[3];
    mcd_sub(d, p->onA, p->onB);
    mcd_mad(d, d, -p->separation, p->normal);
    const double max = 1e-7 * mcd_pairSize(a, b) + 1e-9 * (MeMAX(a->extent, b->extent) + fabs(p->separation));
    return !mcd_areResolved(a, b) || mcd_length(d) <= max;
}

double mcd_convexDistance(const McdShape *a, const McdShape *b, double onA[3], double onB[3], double normal[3]) {
    McdProximity p;
    if (!findProximity(a, b, INFINITY, &p)) {
        mcd_copy(onA, a->place);
        mcd_copy(onB, b->place);
        mcd_set(normal, 0, 0, 1);
        return INFINITY;
    }
    if (areBoxes(a, b) && p.separation <= 0)
        moveWitnessesToFaces(a, b, &p);
    MEVALIDATE(areWitnessesGood(a, b, &p));
    mcd_mad(onA, p.onA, -a->rounding, p.normal);
    mcd_mad(onB, p.onB, b->rounding, p.normal);
    mcd_copy(normal, p.normal);
    MEASSERT(isfinite(mcd_dot(normal, normal)) && !isnan(p.separation));
    return p.separation - a->rounding - b->rounding;
}

/* Kind of a point: a sphere without a radius. */
static const McdKind pointKind = {.support = mcd_pointSupport, .face = mcd_pointFace, .rank = MCD_RANK_SPHERE};

double mcd_pointGap(const McdShape *s, const double point[3], double normal[3]) {
    McdShape dot = {.kind = &pointKind, .extent = s->extent};
    double onDot[3], onShape[3];
    mcd_copy(dot.place, point);
    for (int i = 0; i < 3; i++)
        dot.axis[i][i] = 1;
    return mcd_convexDistance(&dot, s, onDot, onShape, normal);
}

double mcd_pointDistance(const McdShape *s, const double point[3]) {
    double normal[3];
    return mcd_pointGap(s, point, normal);
}
