/* Moves the origin of a universe.
 *
 * Transforms are the program's, or those of bodies, and any number of models may share one. The order: note which
 * models are as they were last compared; shift the world with its bodies' transforms; shift each of the program's
 * matrices once; then have every model take its new place as the one that it was last compared with. */
#include "McdInternal.h"
#include "McdModel.h"
#include "McdSpace.h"
#include "MdtInternal.h"
#include "MdtWorld.h"
#include "MeInternal.h"
#include "MeMessage.h"
#include "mover/mst_mover_i.h"
#include "step/mst_step_i.h"
#include "universe/mst_universe_i.h"
#include "vehicle/mst_vehicle_i.h"
#include <math.h>
#include <stdlib.h>

typedef struct Place {
    MeMatrix4Ptr tm; /* null: none */
    MeBool isBodys;
} Place;

typedef struct Shift {
    double by[3];
    Place *place; /* of models, then of bodies */
    MeBool *wasCurrent;
    int models, places;
} Shift;

static int comparePlaces(const void *a, const void *b) {
    const Place *p = a, *q = b;
    if (p->tm != q->tm)
        return (uintptr_t)p->tm < (uintptr_t)q->tm ? -1 : 1;
    return (q->isBodys != 0) - (p->isBodys != 0);
}

/* The matrix that places a model and is not computed from others. */
static MeMatrix4Ptr rootOf(McdModelID m) {
    MeMatrix4Ptr relative, reference;
    McdModelGetRelativeTransformPtrs(m, &relative, &reference);
    return reference ? reference : McdModelGetTransformPtr(m);
}

/* False, after a fatal error: no memory. */
static MeBool allocate(Shift *s, const MstUniverse *u) {
    for (McdModelID m = McdFrameworkNextModel(u->frame, 0); m; m = McdFrameworkNextModel(u->frame, m))
        s->models++;
    s->places = s->models + 2 * (int)MdtWorldGetTotalBodies(u->world);
    s->place = MeMemoryTake((size_t)s->places + 1, sizeof *s->place, "MstUniverseShiftOrigin", "transforms");
    s->wasCurrent = MeMemoryTake((size_t)s->models + 1, sizeof *s->wasCurrent, "MstUniverseShiftOrigin", "models");
    return s->place && s->wasCurrent;
}

static void gather(Shift *s, const MstUniverse *u) {
    int i = 0;
    for (McdModelID m = McdFrameworkNextModel(u->frame, 0); m; m = McdFrameworkNextModel(u->frame, m), i++) {
        s->place[i] = (Place){rootOf(m), MEFALSE};
        s->wasCurrent[i] = McdModelIsCurrent(m);
    }
    for (MdtBodyID b = MdtBodyGetFirst(u->world); b; b = MdtBodyGetNext(b)) {
        s->place[i++] = (Place){MdtBodyGetTransformPtr(b), METRUE};
        s->place[i++] = (Place){MdtBodyGetCenterOfMassTransformPtr(b), METRUE};
    }
    MEASSERT(i == s->places);
    qsort(s->place, (size_t)s->places, sizeof *s->place, comparePlaces);
}

static void shiftMatrices(const Shift *s) {
    for (int i = 0; i < s->places; i++) {
        const Place *p = &s->place[i];
        if (!p->tm || p->isBodys || (i > 0 && p[-1].tm == p->tm))
            continue;
        for (int k = 0; k < 3; k++)
            p->tm[3][k] = (MeReal)((double)p->tm[3][k] + s->by[k]);
    }
}

static void shiftModels(const Shift *s, const MstUniverse *u) {
    int i = 0;
    const MeBool isOpen = McdSpaceIsChanging(u->space) != 0;
    if (!isOpen)
        McdSpaceBeginChanges(u->space);
    for (McdModelID m = McdFrameworkNextModel(u->frame, 0); m; m = McdFrameworkNextModel(u->frame, m))
        McdModelShift(m, s->by, s->wasCurrent[i++]);
    McdSpaceBuild(u->space);
    if (!isOpen)
        McdSpaceEndChanges(u->space);
}

static void shiftTouches(MstBridgeRecord *b, const double by[3]) {
    for (int k = 0; k < b->events.blockCount; k++)
        for (int i = 0; i < MST_TOUCH_BLOCK << k; i++)
            for (int j = 0; j < 3; j++) {
                MeReal *at = &b->events.block[k][i].position[j];
                *at = (MeReal)((double)*at + by[j]);
            }
}

static void shiftAll(Shift *s, const MstUniverse *u) {
    gather(s, u);
    if (!mst_moversMayShift(u, s->by) || !MdtWorldShift(u->world, s->by)) {
        MeWarning(1, "MstUniverseShiftOrigin: the shift takes a body or mover too far (MdtBodyGetPositionBound); "
                     "nothing is changed");
        return;
    }
    shiftMatrices(s);
    mst_shiftMoved(u->world, s->by);
    mst_vehiclesShift(u, s->by);
    mst_moversShift(u, s->by);
    shiftModels(s, u);
    shiftTouches((MstBridgeRecord *)u->bridge, s->by);
}

void MEAPI MstUniverseShiftOrigin(const MstUniverseID u, const MeVector3 shift) {
    Shift s = {.place = 0};
    if (!mst_universeIsFree(u, __func__))
        return;
    if (!shift || !isfinite((double)shift[0] + (double)shift[1] + (double)shift[2])) {
        MeWarning(1, "%s: the shift is null or not finite; nothing is changed", __func__);
        return;
    }
    for (int i = 0; i < 3; i++)
        s.by[i] = -(double)shift[i];
    if (allocate(&s, u))
        shiftAll(&s, u);
    MeMemoryGive(s.place);
    MeMemoryGive(s.wasCurrent);
}
