/* Explosions: impulses that fall off with the distance from a point. */
#include "McdGeometry.h"
#include "McdModel.h"
#include "McdQuery.h"
#include "MdtBody.h"
#include "MdtInternal.h"
#include "MeMessage.h"
#include "step/mst_step_i.h"
#include "universe/mst_universe_i.h"
#include <math.h>

typedef struct Explosion {
    McdSpaceID space;
    MeVector3 at;
    double radius, impulse, falloff;
    MeBool isShielded;
} Explosion;

/* A model's box, in the axes of its geometry. */
typedef struct Box {
    double half[3];  /* m */
    double point[3]; /* m, from its middle to the explosion */
    double along[3]; /* unit, direction of the impulse */
} Box;

static double dot(const double a[3], const MeVector3 b) {
    return a[0] * (double)b[0] + a[1] * (double)b[1] + a[2] * (double)b[2];
}

/* False: the model has no finite box, or no transform. */
static MeBool boxOf(McdModelID m, const Explosion *e, const double along[3], Box *box) {
    MeMatrix4 unit;
    MeVector3 low, high;
    const MeMatrix4Ptr tm = McdModelGetTransformPtr(m);
    if (!tm)
        return MEFALSE;
    MeMatrix4TMMakeIdentity(unit);
    McdGeometryGetAABB(McdModelGetGeometry(m), (const MeVector4 *)unit, low, high);
    for (int i = 0; i < 3; i++) {
        const double from[3] = {(double)e->at[0] - (double)tm[3][0], (double)e->at[1] - (double)tm[3][1],
                                (double)e->at[2] - (double)tm[3][2]};
        box->half[i] = ((double)high[i] - (double)low[i]) / 2;
        box->point[i] = dot(from, tm[i]) - ((double)high[i] + (double)low[i]) / 2;
        box->along[i] = dot(along, tm[i]);
    }
    return isfinite(box->half[0] * box->half[1] * box->half[2]);
}

static double distanceTo(const Box *box) {
    double gap[3];
    for (int i = 0; i < 3; i++)
        gap[i] = fmax(fabs(box->point[i]) - box->half[i], 0);
    return sqrt(gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2]);
}

static double shadowOf(const Box *box) {
    const double *half = box->half, *along = box->along;
    return 4 * (fabs(along[0]) * half[1] * half[2] + fabs(along[1]) * half[0] * half[2] +
                fabs(along[2]) * half[0] * half[1]);
}

static int MEAPI isShield(McdModelID m, void *none) {
    (void)none;
    return !mst_freeBodyOf(m) && !McdModelIsSensor(m);
}

static MeBool isBehindShield(const Explosion *e, const MeVector3 centre) {
    McdCastResult hit;
    MeVector3 by;
    MeVector3Subtract(by, centre, e->at);
    return e->isShielded && McdSpaceCastRay(e->space, e->at, by, isShield, 0, &hit);
}

/* N s: the impulse of a model's body; 0: none. `along` is its direction. */
static double impulseOn(const Explosion *e, McdModelID m, double along[3]) {
    MeVector3 centre;
    Box box;
    MdtBodyGetCenterOfMassPosition(mst_bodyOf(m), centre);
    for (int i = 0; i < 3; i++)
        along[i] = (double)centre[i] - (double)e->at[i];
    const double length = sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
    for (int i = 0; i < 3 && length > 0; i++)
        along[i] /= length;
    if (!(length > 0) || !boxOf(m, e, along, &box))
        return 0;
    const double share = 1 - distanceTo(&box) / e->radius;
    return share > 0 && !isBehindShield(e, centre) ? e->impulse * shadowOf(&box) * pow(share, e->falloff) : 0;
}

/* Whether the model's body is pushed. */
static MeBool push(const Explosion *e, McdModelID m) {
    double along[3];
    const MdtBodyID b = mst_freeBodyOf(m);
    if (!b || McdModelIsSensor(m))
        return MEFALSE;
    const double impulse = impulseOn(e, m, along);
    if (impulse == 0 || !(MdtBodyWakeIfAsleep(b) || MdtBodyIsEnabled(b)))
        return MEFALSE;
    MdtBodyAddImpulse(b, (MeReal)(impulse * along[0]), (MeReal)(impulse * along[1]), (MeReal)(impulse * along[2]));
    return METRUE;
}

static int pushAll(const Explosion *e) {
    McdSpaceModelIterator it;
    McdModelID m;
    int pushed = 0;
    McdSpaceModelIteratorBegin(e->space, &it);
    while (McdSpaceGetModel(e->space, &it, &m))
        pushed += push(e, m);
    return pushed;
}

static MeBool areGood(const MeVector3 position, double radius, double impulse, double falloff) {
    if (!position || !isfinite((double)position[0] + (double)position[1] + (double)position[2]))
        MeWarning(1, "MstUniverseExplode: the position is null or not finite; nothing is changed");
    else if (!(radius > 0 && isfinite(radius) && falloff >= 0 && isfinite(falloff) && fabs(impulse) <= FLT_MAX))
        MeWarning(1,
                  "MstUniverseExplode: radius %g must be positive, impulse %g finite, falloff %g not negative; "
                  "nothing is changed",
                  radius, impulse, falloff);
    else
        return METRUE;
    return MEFALSE;
}

int MEAPI MstUniverseExplode(const MstUniverseID u, const MeVector3 position, const MeReal radius, const MeReal impulse,
                             const MeReal falloff, const MeBool isShielded) {
    if (!mst_universeIsFree(u, __func__) || !areGood(position, (double)radius, (double)impulse, (double)falloff))
        return 0;
    Explosion e = {u->space,        {position[0], position[1], position[2]},
                   (double)radius,  (double)impulse,
                   (double)falloff, isShielded != 0};
    const MeBool ends = e.isShielded && McdSpaceIsChanging(u->space);
    if (ends)
        McdSpaceEndChanges(u->space);
    const int pushed = pushAll(&e);
    if (ends)
        McdSpaceBeginChanges(u->space);
    return pushed;
}
