/* Two boxes by the separating axis theorem (Gottschalk, Lin and Manocha, OBBTree, 1996): of the 15 axes, face normals
 * and cross products of edges, the one with the least overlap is the contact normal. */
#include "mcd_nearfield_i.h"

/* Both boxes in the axes of the first. */
typedef struct Boxes {
    const double *sizeA, *sizeB;
    double apart[3];    /* from b's centre to a's */
    double turn[3][3];  /* relative rotation: turn[i][j] = a's axis i . b's axis j */
    double steep[3][3]; /* |turn| */
} Boxes;

typedef struct Best {
    double separation, axis[3]; /* in a's axes, from b to a */
    int edgeA, edgeB;           /* -1: a face */
} Best;

static void compare(const McdShape *a, const McdShape *b, Boxes *x) {
    double d[3];
    mcd_sub(d, a->place, b->place);
    x->sizeA = a->size;
    x->sizeB = b->size;
    for (int i = 0; i < 3; i++) {
        x->apart[i] = mcd_dot(a->axis[i], d);
        for (int j = 0; j < 3; j++) {
            x->turn[i][j] = mcd_dot(a->axis[i], b->axis[j]);
            x->steep[i][j] = fabs(x->turn[i][j]);
        }
    }
}

/* An axis along which they are so far apart settles it: false. */
static MeBool isApart(Best *best, double separation) {
    best->separation = separation;
    return MEFALSE;
}

static MeBool facesOfA(const Boxes *x, double limit, Best *best) {
    for (int i = 0; i < 3; i++) {
        const double s = fabs(x->apart[i]) - x->sizeA[i] - mcd_dot(x->steep[i], x->sizeB);
        if (s > limit)
            return isApart(best, s);
        if (s > best->separation) {
            *best = (Best){s, {0, 0, 0}, -1, -1};
            best->axis[i] = x->apart[i] < 0 ? -1 : 1;
        }
    }
    return METRUE;
}

static MeBool facesOfB(const Boxes *x, double limit, double bias, Best *best) {
    for (int j = 0; j < 3; j++) {
        const double axis[3] = {x->turn[0][j], x->turn[1][j], x->turn[2][j]};
        const double steep[3] = {x->steep[0][j], x->steep[1][j], x->steep[2][j]};
        const double along = mcd_dot(x->apart, axis);
        const double s = fabs(along) - x->sizeB[j] - mcd_dot(steep, x->sizeA);
        if (s > limit)
            return isApart(best, s);
        if (s > best->separation + bias) {
            *best = (Best){s, {0, 0, 0}, -1, -1};
            mcd_scale(best->axis, axis, along < 0 ? -1 : 1);
        }
    }
    return METRUE;
}

/* The direction e_i x b_j, whose length is the sine of their angle. */
static MeBool edges(const Boxes *x, double limit, double bias, Best *best) {
    double least = best->separation + bias; /* to be better than */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            const double y = -x->turn[i2][j], z = x->turn[i1][j], squared = y * y + z * z;
            if (squared < mcd_parallelSine * mcd_parallelSine)
                continue;
            const double along = x->apart[i1] * y + x->apart[i2] * z;
            const double reach = x->sizeA[i1] * x->steep[i2][j] + x->sizeA[i2] * x->steep[i1][j] +
                                 x->sizeB[j1] * x->steep[i][j2] + x->sizeB[j2] * x->steep[i][j1];
            const double gap = fabs(along) - reach;
            /* gap <= least * sine, without the root */
            if (gap < 0 && (least >= 0 || gap * gap >= least * least * squared))
                continue;
            const double sine = sqrt(squared), s = gap / sine;
            if (s > limit)
                return isApart(best, s);
            if (s > least) {
                const double k = (along < 0 ? -1 : 1) / sine;
                least = s;
                *best = (Best){s, {0, 0, 0}, i, j};
                best->axis[i1] = y * k;
                best->axis[i2] = z * k;
            }
        }
    return METRUE;
}

/* The middle of the edge of a box that is farthest in a direction, along axis k. */
static void edgeMiddle(const McdShape *s, const double direction[3], int k, double out[3]) {
    mcd_copy(out, s->place);
    for (int i = 0; i < 3; i++)
        if (i != k)
            mcd_mad(out, out, copysign(s->size[i], mcd_dot(s->axis[i], direction)), s->axis[i]);
}

/* The nearest points of both edges' lines. */
static void crossEdges(const McdShape *a, const McdShape *b, const Best *best, McdProximity *p) {
    const double *u = a->axis[best->edgeA], *w = b->axis[best->edgeB];
    const double back[3] = {-p->normal[0], -p->normal[1], -p->normal[2]};
    double from[3], to[3], d[3];
    edgeMiddle(a, back, best->edgeA, from);
    edgeMiddle(b, p->normal, best->edgeB, to);
    mcd_sub(d, to, from);
    const double c = mcd_dot(u, w), du = mcd_dot(d, u), dw = mcd_dot(d, w), sine2 = 1 - c * c;
    const double la = a->size[best->edgeA], lb = b->size[best->edgeB];
    const double s = sine2 > 0 ? (du - c * dw) / sine2 : 0, t = sine2 > 0 ? (c * du - dw) / sine2 : 0;
    mcd_mad(p->onA, from, MeCLAMP(s, -la, la), u);
    mcd_mad(p->onB, to, MeCLAMP(t, -lb, lb), w);
}

/* The farthest corner of the one over the other's face. */
static void cornerOverFace(const McdShape *a, const McdShape *b, McdProximity *p) {
    const double back[3] = {-p->normal[0], -p->normal[1], -p->normal[2]};
    double steepA = 0, steepB = 0;
    for (int i = 0; i < 3; i++) {
        steepA = MeMAX(steepA, fabs(mcd_dot(a->axis[i], p->normal)));
        steepB = MeMAX(steepB, fabs(mcd_dot(b->axis[i], p->normal)));
    }
    if (steepA >= steepB) {
        mcd_coreSupport(b, p->normal, p->onB);
        mcd_mad(p->onA, p->onB, p->separation, p->normal);
    } else {
        mcd_coreSupport(a, back, p->onA);
        mcd_mad(p->onB, p->onA, -p->separation, p->normal);
    }
}

MeBool mcd_isAlongNormal(const McdShape *a, const McdShape *b, const McdProximity *p) {
    const double most = 1e-8 * mcd_pairSize(a, b) + 1e-12 * (MeMAX(a->extent, b->extent) + fabs(p->separation));
    return !mcd_shapeIsRigid(a) || !mcd_shapeIsRigid(b) ||
           (mcd_isUnit(p->normal) && fabs(mcd_separationAlong(a, b, p->normal) - p->separation) <= most);
}

MeBool mcd_boxBoxProximity(const McdShape *a, const McdShape *b, double limit, McdProximity *p) {
    Boxes x;
    Best best = {-INFINITY, {0, 0, 0}, -1, -1};
    const double bias = mcd_faceBias * mcd_pairSize(a, b);
    compare(a, b, &x);
    const MeBool isNear =
        facesOfA(&x, limit, &best) && facesOfB(&x, limit, bias, &best) && edges(&x, limit, bias, &best);
    p->separation = best.separation;
    if (!isNear)
        return MEFALSE;
    for (int i = 0; i < 3; i++)
        p->normal[i] = a->axis[0][i] * best.axis[0] + a->axis[1][i] * best.axis[1] + a->axis[2][i] * best.axis[2];
    p->isGuess = best.separation > 0;
    MEASSERT((best.edgeA < 0) == (best.edgeB < 0));
    if (best.edgeA >= 0)
        crossEdges(a, b, &best, p);
    else
        cornerOverFace(a, b, p);
    MEVALIDATE(mcd_isAlongNormal(a, b, p));
    return isfinite(best.separation) != 0;
}
