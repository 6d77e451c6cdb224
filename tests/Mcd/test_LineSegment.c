/* Line segments against each solid: where a slow march along the segment enters it, and with the normal there. */
#include "shapes.h"

static const double tolerance = TOL(4e-6, 3e-14);

/* The first entry by steps, then by halving: 0 .. 1, or -1. */
static double march(int kind, const double from[3], const double way[3]) {
    enum { STEPS = 600 };
    double last = 0;
    for (int n = 0; n <= STEPS; n++) {
        const double t = (double)n / STEPS, p[3] = {from[0] + t * way[0], from[1] + t * way[1], from[2] + t * way[2]};
        if (excess(kind, p) > 0) {
            last = t;
            continue;
        }
        if (n == 0)
            return 0;
        double high = t;
        for (int i = 0; i < 60; i++) {
            const double middle = (last + high) / 2;
            const double q[3] = {from[0] + middle * way[0], from[1] + middle * way[1], from[2] + middle * way[2]};
            *(excess(kind, q) > 0 ? &last : &high) = middle;
        }
        return high;
    }
    return -1;
}

/* The normal is that of a plane which the solid is behind. */
static double beyondPlane(McdModelID m, const McdLineSegIntersectResult *r) {
    MeVector3 n, far;
    double beyond = 0;
    MeVector3Copy(n, r->normal);
    McdGeometryInstanceMaximumPoint(McdModelGetGeometryInstance(m), n, far);
    for (int k = 0; k < 3; k++)
        beyond += (double)n[k] * ((double)far[k] - (double)r->position[k]);
    return beyond;
}

static void checkSegment(int kind, McdModelID m, const MeVector4 *tm, double size, MeVector3 from, MeVector3 to,
                         int counts[3]) {
    double worldFrom[3], worldTo[3], a[3], b[3], length = 0;
    for (int k = 0; k < 3; k++) {
        worldFrom[k] = (double)from[k];
        worldTo[k] = (double)to[k];
    }
    toShape(tm, worldFrom, size, a);
    toShape(tm, worldTo, size, b);
    for (int k = 0; k < 3; k++) {
        b[k] -= a[k];
        length += b[k] * b[k];
    }
    length = sqrt(length);
    const double t = march(kind, a, b);
    McdLineSegIntersectResult r;
    memset(&r, 0, sizeof r);
    const int hit = (int)McdLineSegIntersect(m, from, to, &r);
    counts[!hit ? 0 : r.distance > 0 ? 1 : 2]++;
    if (!hit) { /* the march may have been lucky at a distance that rounding decides */
        const double p[3] = {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]};
        ck_assert_msg(t < 0 || excess(kind, p) > -tolerance, "kind %d: entry at %g missed", kind, t);
        return;
    }
    ck_assert_ptr_eq(r.model, m);
    const double d = (double)r.distance / size, at = d / length;
    const double p[3] = {a[0] + at * b[0], a[1] + at * b[1], a[2] + at * b[2]};
    ck_assert_msg(fabs(excess(kind, p)) < tolerance * 2 || r.distance == 0, "kind %d: off by %g", kind,
                  excess(kind, p));
    for (int k = 0; k < 3; k++)
        assert_near(r.position[k], worldFrom[k] + at * (worldTo[k] - worldFrom[k]), tolerance * size);
    if (r.distance == 0) {
        ck_assert_msg(t == 0 || excess(kind, a) < tolerance, "kind %d: not inside", kind);
        ck_assert(r.normal[0] == 0 && r.normal[1] == 0 && r.normal[2] == 0);
        return;
    }
    if (t >= 0) /* not later; a grazing hit between two steps may be earlier */
        assert_below(d, t * length + tolerance * 30);
    const double along = (double)MeVector3Dot(r.normal, to) - (double)MeVector3Dot(r.normal, from);
    assert_below(along, tolerance * size);
    assert_near(MeVector3Magnitude(r.normal), 1, tolerance);
    assert_below(beyondPlane(m, &r), tolerance * size * 4);
}

TEST(segments_enter_where_a_march_does) {
    McdFrameworkID f = framework();
    for (int kind = 0; kind < SOLIDS; kind++)
        for (double size = 1e-3; size < 2e3; size *= 1e3) {
            McdGeometryID g = solid(f, kind, size);
            McdModelID m = McdModelCreate(g);
            MeMatrix4 tm;
            int counts[3] = {0, 0, 0};
            McdModelSetTransformPtr(m, tm);
            for (int n = 0; n < 1500; n++) {
                MeVector3 from, to;
                randomPlace(tm, size);
                McdModelUpdate(m);
                const double spread = n % 3 == 0 ? .5 : 1.5;
                for (int k = 0; k < 3; k++) {
                    from[k] = tm[3][k] + (MeReal)(size * uniform(-spread, spread));
                    to[k] = tm[3][k] + (MeReal)(size * uniform(-spread, spread));
                }
                checkSegment(kind, m, (const MeVector4 *)tm, size, from, to, counts);
            }
            ck_assert_msg(counts[0] > 100 && counts[1] > 100 && counts[2] > 40, "kind %d: %d missed, %d hit, %d inside",
                          kind, counts[0], counts[1], counts[2]);
            McdModelDestroy(m);
            McdGeometryDestroy(g);
        }
}

/* Along the axes and through the middle, where slopes are 0 and roots are double. */
TEST(segments_along_axes) {
    McdFrameworkID f = framework();
    for (int kind = 0; kind < SOLIDS; kind++) {
        McdGeometryID g = solid(f, kind, 1);
        McdModelID m = McdModelCreate(g);
        MeMatrix4 tm;
        int counts[3] = {0, 0, 0};
        MeMatrix4TMMakeIdentity(tm);
        McdModelSetTransformPtr(m, tm);
        McdModelUpdate(m);
        for (int axis = 0; axis < 3; axis++)
            for (int side = -1; side <= 1; side += 2)
                for (int off = 0; off < 27; off++) {
                    MeVector3 from = {(off % 3 - 1) * .15, (off / 3 % 3 - 1) * .15, (off / 9 - 1) * .15};
                    MeVector3 to;
                    MeVector3Copy(to, from);
                    from[axis] = (MeReal)(side * 3);
                    to[axis] = (MeReal)(-side * 3);
                    checkSegment(kind, m, (const MeVector4 *)tm, 1, from, to, counts);
                }
        ck_assert_int_eq(counts[2], 0);
        ck_assert_int_gt(counts[1], 50);
        McdModelDestroy(m);
        McdGeometryDestroy(g);
    }
}

TEST(a_segment_that_is_a_point_hits_from_inside_only) {
    McdFrameworkID f = framework();
    for (int kind = 0; kind < SOLIDS; kind++) {
        McdGeometryID g = solid(f, kind, 1);
        McdModelID m = McdModelCreate(g);
        MeMatrix4 tm;
        MeVector3 in, out = {3, 1, 2};
        McdLineSegIntersectResult r;
        randomPlace(tm, 0);
        MeVector3Set(in, 0, 0, 0);
        McdModelSetTransformPtr(m, tm);
        McdModelUpdate(m);
        ck_assert_int_eq((int)McdLineSegIntersect(m, in, in, &r), 1);
        assert_near(r.distance, 0, 0);
        ck_assert_int_eq((int)McdLineSegIntersect(m, out, out, &r), 0);
        McdModelDestroy(m);
        McdGeometryDestroy(g);
    }
}

TEST(a_plane_is_met_from_above) {
    McdFrameworkID f = framework();
    McdGeometryID g = McdPlaneCreate(f);
    McdModelID m = McdModelCreate(g);
    MeMatrix4 tm;
    McdModelSetTransformPtr(m, tm);
    for (int n = 0; n < 300; n++) {
        MeVector3 from, to;
        McdLineSegIntersectResult r;
        randomPlace(tm, 1);
        McdModelUpdate(m);
        for (int k = 0; k < 3; k++) {
            from[k] = (MeReal)uniform(-4, 4);
            to[k] = (MeReal)uniform(-4, 4);
        }
        const double a = McdPlaneGetDistanceToPoint(g, (const MeVector4 *)tm, from);
        const double b = McdPlaneGetDistanceToPoint(g, (const MeVector4 *)tm, to);
        ck_assert_int_eq((int)McdLineSegIntersect(m, from, to, &r), a <= 0 || b <= 0);
        if (a <= 0)
            assert_near(r.distance, 0, 0);
        else if (b <= 0) {
            assert_near(r.distance, a / (a - b) * (double)MeVector3Distance(from, to), TOL(4e-6, 2e-14));
            assert_near(McdPlaneGetDistanceToPoint(g, (const MeVector4 *)tm, r.position), 0, TOL(2e-6, 1e-14));
            assert_vec3_near(r.normal, tm[2][0], tm[2][1], tm[2][2], TOL(5e-7, 9e-16));
        }
    }
}
