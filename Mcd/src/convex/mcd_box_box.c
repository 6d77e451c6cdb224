/* Two boxes by the separating axis theorem (Gottschalk, Lin and Manocha, OBBTree, 1996): of the 15 axes (face
 * normals and cross products of edges) the one with the smallest overlap is the contact normal. */
#include "convex/mcd_nearfield_i.h"

/* Both boxes in the frame of box a. */
typedef struct Boxes {
    const double *sizeA, *sizeB;
    double offset[3];         /* from b's centre to a's */
    double rotation[3][3];    /* relative rotation: rotation[i][j] = a's axis i . b's axis j */
    double absRotation[3][3]; /* |rotation| */
} Boxes;

/* The axis with the smallest overlap so far. */
typedef struct Best {
    double separation;
    int face;         /* 0 to 2: a face of a, 3 to 5: a face of b; -1: none yet */
    int edgeA, edgeB; /* axes of the two edges; -1: the axis is a face's normal */
    double axis[3];   /* cross product of the edges: in a's axes, from b to a, unit */
} Best;

static void setRelativeTransform(const McdShape *a, const McdShape *b, Boxes *x) {
    double d[3];
    mcd_sub(d, a->place, b->place);
    x->sizeA = a->size;
    x->sizeB = b->size;
    for (int i = 0; i < 3; i++) {
        x->offset[i] = mcd_dot(a->axis[i], d);
        for (int j = 0; j < 3; j++) {
            x->rotation[i][j] = mcd_dot(a->axis[i], b->axis[j]);
            x->absRotation[i][j] = fabs(x->rotation[i][j]);
        }
    }
}

/* Stores a separation above the limit, which ends the search: returns false. */
static MeBool stopAtSeparation(Best *best, double separation) {
    best->separation = separation;
    return MEFALSE;
}

/* Compares the normals of three faces, numbered from `first`. Without branches, since the best one is unpredictable. */
static MeBool keepBestFace(const double separation[3], int first, double limit, double bias, Best *best) {
    for (int i = 0; i < 3; i++)
        if (separation[i] > limit)
            return stopAtSeparation(best, separation[i]);
    for (int i = 0; i < 3; i++) {
        const int isBetter = separation[i] > best->separation + bias;
        best->separation = isBetter ? separation[i] : best->separation;
        best->face = isBetter ? first + i : best->face;
    }
    return METRUE;
}

static MeBool tryFacesOfA(const Boxes *x, double limit, Best *best) {
    double separation[3];
    for (int i = 0; i < 3; i++)
        separation[i] = fabs(x->offset[i]) - x->sizeA[i] - mcd_dot(x->absRotation[i], x->sizeB);
    return keepBestFace(separation, 0, limit, 0, best);
}

/* The component along b's axis j of the offset between the centres. */
static double offsetAlongB(const Boxes *x, int j) {
    const double axis[3] = {x->rotation[0][j], x->rotation[1][j], x->rotation[2][j]};
    return mcd_dot(x->offset, axis);
}

static MeBool tryFacesOfB(const Boxes *x, double limit, double bias, Best *best) {
    double separation[3];
    for (int j = 0; j < 3; j++) {
        const double steep[3] = {x->absRotation[0][j], x->absRotation[1][j], x->absRotation[2][j]};
        separation[j] = fabs(offsetAlongB(x, j)) - x->sizeB[j] - mcd_dot(steep, x->sizeA);
    }
    return keepBestFace(separation, 3, limit, bias, best);
}

/* Compares the 9 cross products of edges, a's axis i x b's axis j; the length of each is the sine of the angle
 * between them. */
static MeBool tryEdgePairs(const Boxes *x, double limit, double bias, Best *best) {
    double min = best->separation + bias; /* the separation to exceed */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            const double y = -x->rotation[i2][j], z = x->rotation[i1][j], squared = y * y + z * z;
            if (squared < mcd_parallelSine * mcd_parallelSine)
                continue;
            const double along = x->offset[i1] * y + x->offset[i2] * z;
            const double reach = x->sizeA[i1] * x->absRotation[i2][j] + x->sizeA[i2] * x->absRotation[i1][j] +
                                 x->sizeB[j1] * x->absRotation[i][j2] + x->sizeB[j2] * x->absRotation[i][j1];
            const double gap = fabs(along) - reach;
            /* gap <= min * sine, without the square root */
            if (gap < 0 && (min >= 0 || gap * gap >= min * min * squared))
                continue;
            const double sine = sqrt(squared), s = gap / sine;
            if (s > limit)
                return stopAtSeparation(best, s);
            if (s > min) {
                const double k = (along < 0 ? -1 : 1) / sine;
                min = s;
                *best = (Best){s, -1, i, j, {0, 0, 0}};
                best->axis[i1] = y * k;
                best->axis[i2] = z * k;
            }
        }
    return METRUE;
}

/* The best axis, rotated to the world's frame. */
static void setNormal(const McdShape *a, const Boxes *x, const Best *best, double normal[3]) {
    double axis[3] = {0, 0, 0};
    if (best->edgeA >= 0) {
        mcd_copy(axis, best->axis);
    } else if (best->face < 3) {
        axis[best->face] = x->offset[best->face] < 0 ? -1 : 1;
    } else {
        const int j = best->face - 3;
        const double sign = offsetAlongB(x, j) < 0 ? -1 : 1;
        mcd_set(axis, sign * x->rotation[0][j], sign * x->rotation[1][j], sign * x->rotation[2][j]);
    }
    mcd_shapeDirection(a, axis[0], axis[1], axis[2], normal);
}

/* The midpoint of the box's edge along axis k that is farthest in a direction. */
static void supportEdgeMiddle(const McdShape *s, const double direction[3], int k, double out[3]) {
    mcd_copy(out, s->place);
    for (int i = 0; i < 3; i++)
        if (i != k)
            mcd_mad(out, out, copysign(s->size[i], mcd_dot(s->axis[i], direction)), s->axis[i]);
}

/* Witness points of an edge-edge contact: the closest points of the two edges. */
static void setEdgeWitnesses(const McdShape *a, const McdShape *b, const Best *best, McdProximity *p) {
    const double *u = a->axis[best->edgeA], *w = b->axis[best->edgeB];
    double back[3];
    double from[3], to[3], d[3];
    mcd_scale(back, p->normal, -1);
    supportEdgeMiddle(a, back, best->edgeA, from);
    supportEdgeMiddle(b, p->normal, best->edgeB, to);
    mcd_sub(d, to, from);
    const double c = mcd_dot(u, w), du = mcd_dot(d, u), dw = mcd_dot(d, w), sine2 = 1 - c * c;
    const double la = a->size[best->edgeA], lb = b->size[best->edgeB];
    const double s = sine2 > 0 ? (du - c * dw) / sine2 : 0, t = sine2 > 0 ? (c * du - dw) / sine2 : 0;
    mcd_mad(p->onA, from, MeCLAMP(s, -la, la), u);
    mcd_mad(p->onB, to, MeCLAMP(t, -lb, lb), w);
}

void mcd_setFaceWitnesses(const McdShape *a, const McdShape *b, MeBool isFaceOfA, McdProximity *p) {
    double back[3];
    mcd_scale(back, p->normal, -1);
    mcd_coreSupport(isFaceOfA ? b : a, isFaceOfA ? p->normal : back, isFaceOfA ? p->onB : p->onA);
    if (isFaceOfA)
        mcd_mad(p->onA, p->onB, p->separation, p->normal);
    else
        mcd_mad(p->onB, p->onA, -p->separation, p->normal);
}

/* Whether a has a face more nearly orthogonal to the normal than any of b's. */
static MeBool isFaceOfFirst(const McdShape *a, const McdShape *b, const double normal[3]) {
    double steepA = 0, steepB = 0;
    for (int i = 0; i < 3; i++) {
        steepA = MeMAX(steepA, fabs(mcd_dot(a->axis[i], normal)));
        steepB = MeMAX(steepB, fabs(mcd_dot(b->axis[i], normal)));
    }
    return steepA >= steepB;
}

MeBool mcd_isAlongNormal(const McdShape *a, const McdShape *b, const McdProximity *p, double ofSize, double ofLargest) {
    const double max = ofSize * mcd_pairSize(a, b) + ofLargest * (MeMAX(a->extent, b->extent) + fabs(p->separation));
    return !mcd_areResolved(a, b) ||
           (mcd_isUnit(p->normal) && fabs(mcd_separationAlong(a, b, p->normal) - p->separation) <= max);
}

MeBool mcd_boxBoxProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p) {
    Boxes x;
    Best best = {.separation = -INFINITY, .face = -1, .edgeA = -1, .edgeB = -1};
    const double bias = mcd_faceBias * mcd_pairSize(a, b);
    setRelativeTransform(a, b, &x);
    const MeBool isNear =
        tryFacesOfA(&x, limit, &best) && tryFacesOfB(&x, limit, bias, &best) && tryEdgePairs(&x, limit, bias, &best);
    p->separation = best.separation;
    if (!isNear || !isfinite(best.separation))
        return MEFALSE;
    MEASSERT((best.edgeA < 0) == (best.edgeB < 0) && (best.edgeA >= 0 || best.face >= 0));
    setNormal(a, &x, &best, p->normal);
    p->isGuess = best.separation > 0;
    if (best.edgeA >= 0)
        setEdgeWitnesses(a, b, &best, p);
    else
        mcd_setFaceWitnesses(a, b, isFaceOfFirst(a, b, p->normal), p);
    /* axes are orthogonal to single precision's rounding: their products are known less well where they are small */
    MEVALIDATE(mcd_isAlongNormal(a, b, p, best.edgeA >= 0 ? 2e-7 : 1e-8, 1e-12));
    return METRUE;
}
