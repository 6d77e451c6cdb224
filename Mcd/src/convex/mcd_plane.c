/* Manifold and distance of a convex shape and a half-space. */
#include "convex/mcd_kind_i.h"

/* Kind of the square of the plane that is clipped. */
static const McdKind flat = {.rank = MCD_RANK_OTHER};

int mcd_planeManifold(const McdShape *a, const double normal[3], double offset, McdReach reach, McdManifold *m) {
    double back[3];
    McdProximity p = {.isGuess = 0};
    McdFace face, ground = {.count = 4};
    double u[3], w[3];
    mcd_scale(back, normal, -1);
    mcd_copy(p.normal, normal);
    mcd_coreSupport(a, back, p.onA);
    p.separation = mcd_dot(p.onA, normal) - offset;
    mcd_mad(p.onB, p.onA, -p.separation, normal);
    if (!(p.separation - a->rounding <= reach.margin)) {
        m->count = 0;
        mcd_copy(m->normal, normal);
        return 0;
    }
    mcd_faceToward(a, back, &face);
    /* A square of the plane below the shape, wider than the shape. */
    mcd_basis(normal, u, w);
    mcd_copy(ground.normal, normal);
    const McdShape square = {.kind = &flat, .extent = a->extent};
    for (int i = 0; i < 4; i++) {
        double *corner = ground.point[i];
        mcd_mad(corner, a->place, offset - mcd_dot(a->place, normal), normal);
        mcd_mad(corner, corner, (i == 0 || i == 3 ? -4 : 4) * a->extent, u);
        mcd_mad(corner, corner, (i < 2 ? -4 : 4) * a->extent, w);
        ground.name[i] = (MeU32)i;
    }
    return mcd_facesManifold(a, &square, &face, &ground, &p, reach, m);
}

double mcd_planeDistance(const McdShape *a, const MeVector4 *tm, const double origin[3], double onA[3], double onB[3],
                         double normal[3]) {
    double down[3], distance = 0;
    mcd_fromReal(normal, tm[2]);
    mcd_scale(down, normal, -1);
    mcd_support(a, down, onA);
    for (int i = 0; i < 3; i++)
        distance += normal[i] * (onA[i] + origin[i] - (double)tm[3][i]);
    mcd_mad(onB, onA, -distance, normal);
    return distance;
}
