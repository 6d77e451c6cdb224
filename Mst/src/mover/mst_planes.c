/* The point of a polyhedron nearest to a wanted one: exact, by the planes that hold it. */
#include "mover/mst_mover_i.h"

/* The sum of a point and up to two normals, each times a number. */
static void combine(double out[3], const double p[3], double a, const double n[3], double b, const double m[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = p[i] + a * n[i] + b * m[i];
}

static double violation(const MstMoverPlane *p, const double point[3]) {
    return p->bound - mst_dot(p->normal, point);
}

static MeBool isInside(const MstMoverPlane *plane, int count, const double point[3], double tolerance) {
    for (int i = 0; i < count; i++)
        if (violation(&plane[i], point) > tolerance)
            return MEFALSE;
    return METRUE;
}

/* The nearest point on both planes; false if they are parallel. */
static MeBool onLine(const MstMoverPlane *p, const MstMoverPlane *q, const double want[3], double out[3]) {
    const double c = mst_dot(p->normal, q->normal), det = 1 - c * c;
    const double a = violation(p, want), b = violation(q, want);
    if (det < 1e-12)
        return MEFALSE;
    combine(out, want, (a - c * b) / det, p->normal, (b - c * a) / det, q->normal);
    return METRUE;
}

/* The point on three planes; false if they have none, or more than one. */
static MeBool onVertex(const MstMoverPlane *p, const MstMoverPlane *q, const MstMoverPlane *r, double out[3]) {
    double qr[3], rp[3], pq[3];
    mst_cross(qr, q->normal, r->normal);
    mst_cross(rp, r->normal, p->normal);
    mst_cross(pq, p->normal, q->normal);
    const double det = mst_dot(p->normal, qr);
    if (fabs(det) < 1e-9)
        return MEFALSE;
    for (int i = 0; i < 3; i++)
        out[i] = (p->bound * qr[i] + q->bound * rp[i] + r->bound * pq[i]) / det;
    return METRUE;
}

typedef struct Search {
    const MstMoverPlane *plane;
    int count;
    const double *want;
    double tolerance, best, *out;
} Search;

static void tryPoint(Search *s, const double point[3]) {
    double by[3];
    mst_sub(by, point, s->want);
    if (mst_dot(by, by) < s->best && isInside(s->plane, s->count, point, s->tolerance)) {
        s->best = mst_dot(by, by);
        mst_copy(s->out, point);
    }
}

/* The nearest point is the wanted one, or on one, two or three of the planes: the nearest of these that is inside. */
static MeBool searchAll(Search *s) {
    const MstMoverPlane *p = s->plane;
    double point[3];
    tryPoint(s, s->want);
    for (int i = 0; i < s->count; i++) {
        combine(point, s->want, violation(&p[i], s->want), p[i].normal, 0, p[i].normal);
        tryPoint(s, point);
        for (int j = 0; j < i; j++) {
            if (onLine(&p[i], &p[j], s->want, point))
                tryPoint(s, point);
            for (int k = 0; k < j; k++)
                if (onVertex(&p[i], &p[j], &p[k], point))
                    tryPoint(s, point);
        }
    }
    return s->best < INFINITY;
}

/* The plane that a point violates most, beyond a tolerance; null: none. */
static const MstMoverPlane *worst(const MstMoverPlane *plane, int count, const double point[3], double tolerance) {
    const MstMoverPlane *found = 0;
    for (int i = 0; i < count; i++)
        if (violation(&plane[i], point) > tolerance) {
            found = &plane[i];
            tolerance = violation(found, point);
        }
    return found;
}

MeBool mst_nearestInPlanes(const MstMoverPlane *plane, int count, const double want[3], double out[3]) {
    enum { MAX_USED = 12 };
    MstMoverPlane used[MAX_USED];
    double tolerance = sqrt(mst_dot(want, want));
    for (int i = 0; i < count; i++)
        tolerance = fmax(tolerance, fabs(plane[i].bound));
    tolerance *= 1e-9;
    mst_copy(out, want);
    for (int n = 0; n < MAX_USED; n++) {
        const MstMoverPlane *next = worst(plane, count, out, 2 * tolerance);
        if (!next)
            return METRUE;
        used[n] = *next;
        Search s = {used, n + 1, want, tolerance, INFINITY, out};
        if (!searchAll(&s))
            return MEFALSE;
    }
    return MEFALSE;
}
