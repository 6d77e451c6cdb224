/* Boxes. */
#include "McdBox.h"
#include "convex/mcd_kind_i.h"
#include "geometry/mcd_geometry_i.h"

static const McdBox *get(const McdGeometry *g) {
    return (const McdBox *)g;
}

static void support(const McdGeometry *g, const double d[3], double point[3]) {
    for (int k = 0; k < 3; k++)
        point[k] = copysign((double)get(g)->radii[k], d[k]); /* branchless: the signs are unpredictable */
}

static void clip(const McdGeometry *g, McdClip *c) {
    for (int k = 0; k < 3; k++) {
        double normal[3] = {0, 0, 0};
        for (int side = -1; side <= 1; side += 2) {
            normal[k] = side;
            mcd_clipHalfSpace(c, normal, (double)get(g)->radii[k]);
        }
    }
}

MCD_DEFINE_LINE_SEGMENT(Box)

/* ---- narrow phase ---------------------------------------------------------------------------------------------- */

static void setShape(const McdGeometry *g, McdShape *s) {
    mcd_fromReal(s->size, get(g)->radii);
    s->extent = mcd_length(s->size);
}

static void farthestCorner(const McdShape *s, const double d[3], double point[3]) {
    mcd_shapePoint(s, copysign(s->size[0], mcd_dot(s->axis[0], d)), copysign(s->size[1], mcd_dot(s->axis[1], d)),
                   copysign(s->size[2], mcd_dot(s->axis[2], d)), point);
}

static void face(const McdShape *s, const double direction[3], McdFace *f) {
    static const double round[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    double d[3];
    int k = 0;
    mcd_shapeToOwnAxes(s, direction, d);
    for (int i = 1; i < 3; i++)
        if (fabs(d[i]) > fabs(d[k]))
            k = i;
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double side = d[k] < 0 ? -1 : 1;
    double middle[3], u[3], w[3];
    mcd_scale(f->normal, s->axis[k], side);
    mcd_mad(middle, s->place, s->size[k], f->normal);
    mcd_scale(u, s->axis[i], side * s->size[i]); /* mirrored: counter-clockwise on either side */
    mcd_scale(w, s->axis[j], s->size[j]);
    f->id = (MeU32)(2 * k + (side > 0));
    f->count = 4;
    for (int corner = 0; corner < 4; corner++) {
        for (int c = 0; c < 3; c++)
            f->point[corner][c] = middle[c] + (round[corner][0] * u[c] + round[corner][1] * w[c]);
        f->name[corner] = (MeU32)corner;
    }
}

static void visitEdges(const McdGeometry *g, int sides, McdEdgeVisit visit, void *context) {
    const MeReal *size = get(g)->radii;
    (void)sides;
    for (int axis = 0; axis < 3; axis++)
        for (int k = 0; k < 4; k++) {
            double end[2][3];
            for (int e = 0; e < 2; e++) {
                end[e][axis] = (e ? 1 : -1) * (double)size[axis];
                end[e][(axis + 1) % 3] = (k & 1 ? 1 : -1) * (double)size[(axis + 1) % 3];
                end[e][(axis + 2) % 3] = (k & 2 ? 1 : -1) * (double)size[(axis + 2) % 3];
            }
            visit(context, end[0], end[1]);
        }
}

static const McdKind kind = {MCD_KIND_FUNCTIONS(Box, mcd_geometryFree),
                             .size = sizeof(McdBox),
                             .setShape = setShape,
                             .support = farthestCorner,
                             .face = face,
                             .rank = MCD_RANK_BOX,
                             .flatAxes = 1 | 2 | 4,
                             .edges = visitEdges};

/* ---- sizes --------------------------------------------------------------------------------------------------- */

static MeBool sizesAreGood(MeReal dx, MeReal dy, MeReal dz, const char *function) {
    return mcd_sizeIsGood(dx, "length along x", function) && mcd_sizeIsGood(dy, "length along y", function) &&
           mcd_sizeIsGood(dz, "length along z", function);
}

McdBoxID MEAPI McdBoxCreate(McdFramework *frame, MeReal dx, MeReal dy, MeReal dz) {
    if (!sizesAreGood(dx, dy, dz, "McdBoxCreate"))
        return 0;
    McdBox *b = mcd_geometryCreate(frame, kMcdGeometryTypeBox, sizeof *b, "McdBoxCreate");
    if (b)
        MeVector3Set(b->radii, dx / 2, dy / 2, dz / 2);
    return (McdBoxID)b;
}

void MEAPI McdBoxSetDimensions(McdGeometryID g, MeReal dx, MeReal dy, MeReal dz) {
    if (mcd_geometryIs(g, kMcdGeometryTypeBox, "McdBoxSetDimensions") &&
        sizesAreGood(dx, dy, dz, "McdBoxSetDimensions")) {
        MeVector3Set(((McdBox *)g)->radii, dx / 2, dy / 2, dz / 2);
        mcd_geometryChanged(g);
    }
}

void MEAPI McdBoxGetDimensions(McdGeometryID g, MeReal *dx, MeReal *dy, MeReal *dz) {
    if (!mcd_areGiven(__func__, dx, dy, dz))
        return;
    const MeBool isBox = mcd_geometryIs(g, kMcdGeometryTypeBox, "McdBoxGetDimensions");
    *dx = isBox ? 2 * get(g)->radii[0] : 0;
    *dy = isBox ? 2 * get(g)->radii[1] : 0;
    *dz = isBox ? 2 * get(g)->radii[2] : 0;
}

MeReal *MEAPI McdBoxGetRadii(McdBoxID g) {
    return mcd_geometryIs(g, kMcdGeometryTypeBox, "McdBoxGetRadii") ? ((McdBox *)g)->radii : 0;
}

void MEAPI McdBoxGetXYAABB(McdBoxID g, MeMatrix4 tm, MeReal bounds[4]) {
    mcd_localXYAABB(g, kMcdGeometryTypeBox, tm, bounds, support, __func__);
}

void MEAPI McdBoxMaximumPointLocal(McdBoxID g, MeReal *inDir, MeReal *outPoint) {
    if (!mcd_areGiven(__func__, inDir, outPoint, outPoint))
        return;
    const MeBool isBox = mcd_geometryIs(g, kMcdGeometryTypeBox, "McdBoxMaximumPointLocal");
    for (int k = 0; k < 3; k++)
        outPoint[k] = !isBox ? 0 : inDir[k] < 0 ? -get(g)->radii[k] : get(g)->radii[k];
}

/* ---- the type ---------------------------------------------------------------------------------------------------- */

static MeReal boundingRadius(const McdGeometry *g, MeVector3 center) {
    double size[3];
    (void)center;
    mcd_fromReal(size, get(g)->radii);
    return mcd_roundUp(mcd_length(size));
}

/* I_xx = m (y^2 + z^2) / 3 with half extents x, y, z. */
static void addMass(const McdGeometry *g, McdMass *sum) {
    double size[3];
    mcd_fromReal(size, get(g)->radii);
    const double x = size[0], y = size[1], z = size[2], mass = 8 * x * y * z;
    mcd_massDiagonal(sum, mass, mass * (y * y + z * z) / 3, mass * (z * z + x * x) / 3, mass * (x * x + y * y) / 3);
}

static void draw(const McdGeometry *g, const MeMatrix4 tm, const MeReal colour[3]) {
    MeVector3 low;
    MeVector3MultiplyScalar(low, get(g)->radii, -1);
    mcd_drawBox(tm, colour, low, get(g)->radii);
}

MCD_DEFINE_GEOMETRY_TYPE(Box, addMass)
