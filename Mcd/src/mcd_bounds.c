/* Boxes in a geometry's own frame, and line segments there. */
#include "mcd_bounds.h"
#include "MeDebugDraw.h"
#include "mcd_local.h"
#include <math.h>

static void cornerOf(const MeReal *min, const MeReal *max, int k, MeVector3 corner) {
    MeVector3Set(corner, k & 1 ? max[0] : min[0], k & 2 ? max[1] : min[1], k & 4 ? max[2] : min[2]);
}

static void boxAt(const MeReal *min, const MeReal *max, MeMatrix4Ptr tm, MeVector3 low, MeVector3 high) {
    for (int i = 0; i < 3; i++) {
        double middle = (double)tm[3][i], reach = 0;
        for (int k = 0; k < 3; k++) {
            middle += (double)tm[k][i] * ((double)min[k] + (double)max[k]) / 2;
            reach += fabs((double)tm[k][i]) * ((double)max[k] - (double)min[k]) / 2;
        }
        low[i] = mcd_roundDown(middle - reach);
        high[i] = mcd_roundUp(middle + reach);
    }
}

void mcd_boxUpdateAABB(McdGeometryInstance *ins, const MeReal *min, const MeReal *max, const MeMatrix4Ptr finalTM) {
    MeVector3 low, high;
    boxAt(min, max, mcd_instanceTM(ins), low, high);
    if (finalTM) {
        MeVector3 finalLow, finalHigh;
        boxAt(min, max, finalTM, finalLow, finalHigh);
        MeVector3Min(low, low, finalLow);
        MeVector3Max(high, high, finalHigh);
    }
    McdGeometryInstanceSetAABB(ins, low, high);
}

void mcd_boxBSphere(const MeReal *min, const MeReal *max, MeVector3 center, MeReal *radius) {
    MeReal sum = 0;
    for (int i = 0; i < 3; i++) {
        center[i] = (min[i] + max[i]) / 2;
        sum += (max[i] - min[i]) * (max[i] - min[i]);
    }
    *radius = MeSqrt(sum) / 2;
}

void mcd_boxMaximumPoint(McdGeometryInstance *ins, const MeReal *min, const MeReal *max, const MeReal *direction,
                         MeReal *point) {
    MeVector3 local;
    MeMatrix4TMInverseRotate(local, mcd_const(mcd_instanceTM(ins)), direction);
    cornerOf(min, max, (local[0] > 0) + 2 * (local[1] > 0) + 4 * (local[2] > 0), local);
    MeMatrix4TMTransform(point, mcd_const(mcd_instanceTM(ins)), local);
}

void mcd_boxDebugDraw(const MeReal *min, const MeReal *max, const MeMatrix4 tm, const MeReal colour[3]) {
    for (int k = 0; k < 8; k++)
        for (int bit = 1; bit < 8; bit *= 2) {
            MeVector3 ends[2], corner;
            if (k & bit)
                continue;
            cornerOf(min, max, k, corner);
            MeMatrix4TMTransform(ends[0], tm, corner);
            cornerOf(min, max, k | bit, corner);
            MeMatrix4TMTransform(ends[1], tm, corner);
            MeDebugDrawAPI.line(ends[0], ends[1], colour[0], colour[1], colour[2]);
        }
}

void mcd_toLocal(MeMatrix4Ptr tm, const MeReal *world, double local[3]) {
    for (int i = 0; i < 3; i++) {
        local[i] = 0;
        for (int k = 0; k < 3; k++)
            local[i] += ((double)world[k] - (double)tm[3][k]) * (double)tm[i][k];
    }
}

int mcd_segmentHit(MeMatrix4Ptr tm, const MeReal *from, const MeReal *to, double part, const double normal[3],
                   McdLineSegIntersectResult *hit) {
    double length = 0;
    for (int i = 0; i < 3; i++) {
        const double along = (double)to[i] - (double)from[i];
        length += along * along;
        hit->position[i] = (MeReal)((double)from[i] + part * along);
        hit->normal[i] =
            (MeReal)(normal[0] * (double)tm[0][i] + normal[1] * (double)tm[1][i] + normal[2] * (double)tm[2][i]);
    }
    hit->distance = (MeReal)(part * sqrt(length));
    return 1;
}
