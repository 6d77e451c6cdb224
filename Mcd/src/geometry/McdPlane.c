/* Planes: z = 0; everything below is inside. */
#include "McdPlane.h"
#include "convex/mcd_kind_i.h"
#include "geometry/mcd_geometry_i.h"

/* The extent of an unbounded plane: sums and differences of such numbers are finite. */
static const double reach = (double)(MEINFINITY / 4);

/* A half-space has no support point; a distant point in that direction stands for it. */
static void support(const McdGeometry *g, const double d[3], double point[3]) {
    (void)g;
    point[0] = d[0] > 0 ? reach : d[0] < 0 ? -reach : 0;
    point[1] = d[1] > 0 ? reach : d[1] < 0 ? -reach : 0;
    point[2] = d[2] < 0 ? -reach : 0;
}

static void clip(const McdGeometry *g, McdClip *c) {
    const double up[3] = {0, 0, 1};
    (void)g;
    mcd_clipHalfSpace(c, up, 0);
}

MCD_DEFINE_LINE_SEGMENT(Plane)

static const McdKind kind = {MCD_KIND_FUNCTIONS(Plane, mcd_geometryFree), .size = sizeof(McdPlane),
                             .isHalfSpace = METRUE, .isStatic = METRUE};

McdPlaneID MEAPI McdPlaneCreate(McdFramework *frame) {
    return (McdPlaneID)mcd_geometryCreate(frame, kMcdGeometryTypePlane, sizeof(McdPlane), "McdPlaneCreate");
}

static MeBool isPlane(const MeMatrix4 tm, const char *function) {
    if (mcd_isValidTransform(tm))
        return METRUE;
    MeWarning(1, "%s: the transform is not finite, or flat", function);
    return MEFALSE;
}

void MEAPI McdPlaneGetNormal(const McdGeometry *g, const MeMatrix4 tm, MeVector3 normal) {
    if (!mcd_areGiven(__func__, tm, normal, normal))
        return;
    (void)g;
    const MeBool isPlaced = isPlane(tm, __func__);
    for (int i = 0; i < 3; i++)
        normal[i] = isPlaced ? tm[2][i] : 0;
}

MeReal MEAPI McdPlaneGetDistanceToPoint(const McdGeometry *g, const MeMatrix4 tm, const MeVector3 point) {
    if (!mcd_areGiven(__func__, tm, point, point))
        return 0;
    double distance = 0;
    (void)g;
    if (!isPlane(tm, __func__))
        return 0;
    if (!mcd_areInRange(point, 3)) {
        MeWarning(1, "%s: the point is (%g, %g, %g)", __func__, (double)point[0], (double)point[1], (double)point[2]);
        return 0;
    }
    for (int k = 0; k < 3; k++)
        distance += (double)tm[2][k] * ((double)point[k] - (double)tm[3][k]);
    return mcd_clampReal(distance);
}

void MEAPI McdPlaneMaximumPoint(McdGeometryInstanceID ins, MeReal *const inDir, MeReal *const outPoint) {
    if (!mcd_areGiven(__func__, inDir, outPoint, outPoint))
        return;
    MeVector3Set(outPoint, 0, 0, 0);
    if (!mcd_instanceIs(ins, kMcdGeometryTypePlane, "McdPlaneMaximumPoint"))
        return;
    mcd_localMaximumPoint(ins, inDir, outPoint, support);
    for (int k = 0; k < 3; k++)
        outPoint[k] = MeCLAMP(outPoint[k], -(MeReal)reach, (MeReal)reach);
}

/* Sets the box. A plane orthogonal to a world axis ends at its coordinate on that axis, on one side; other planes
 * are unbounded on all axes. */
static void boxAt(const MeVector4 *tm, double low[3], double high[3]) {
    for (int i = 0; i < 3; i++) {
        const double n = (double)tm[2][i];
        const MeBool isAlong = tm[2][(i + 1) % 3] == 0 && tm[2][(i + 2) % 3] == 0;
        low[i] = isAlong && n < 0 ? (double)tm[3][i] : -reach;
        high[i] = isAlong && n > 0 ? (double)tm[3][i] : reach;
    }
}

void MEAPI McdPlaneUpdateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight) {
    (void)tight;
    if (!mcd_instanceIs(ins, kMcdGeometryTypePlane, "McdPlaneUpdateAABB"))
        return;
    double low[3], high[3], finalLow[3], finalHigh[3];
    const MeVector4 *tm = mcd_const(mcd_instanceTM(ins));
    boxAt(tm, low, high);
    boxAt(finalTM ? mcd_const(finalTM) : tm, finalLow, finalHigh);
    MeVector3 min, max;
    for (int i = 0; i < 3; i++) {
        min[i] = (MeReal)MeMIN(low[i], finalLow[i]);
        max[i] = (MeReal)MeMAX(high[i], finalHigh[i]);
    }
    McdGeometryInstanceSetAABB(ins, min, max);
}

static MeReal boundingRadius(const McdGeometry *g, MeVector3 center) {
    (void)g;
    (void)center;
    return (MeReal)reach;
}

/* Draws a square of 2 by 2 and the normal. */
static void draw(const McdGeometry *g, const MeMatrix4 tm, const MeReal colour[3]) {
    const double corner[4][3] = {{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}}, origin[3] = {0, 0, 0},
                 up[3] = {0, 0, 1};
    (void)g;
    for (int i = 0; i < 4; i++)
        mcd_drawLine(tm, colour, corner[i], corner[(i + 1) % 4]);
    mcd_drawLine(tm, colour, origin, up);
}

MCD_DEFINE_TYPE(Plane, mcd_addNoMass)
