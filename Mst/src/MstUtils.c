/* Models with and without bodies, their mass, and what freezes them. */
#include "MstUtils.h"
#include "McdGeometry.h"
#include "McdInteractions.h"
#include "MdtWorld.h"
#include "MeMessage.h"
#include "MstUniverse.h"
#include "mst_i.h"

/* ---- mass ------------------------------------------------------------------------------------------------------ */

static MeBool massOf(McdModelID model, MeMatrix3 inertia, MeReal *volume, const char *function) {
    MeMatrix4 relative;
    if (!McdModelIsValid(model) ||
        !McdGeometryGetMassProperties(McdModelGetGeometry(model), relative, inertia, volume) || !(*volume > 0)) {
        MeWarning(1, "%s: the model's geometry has no mass properties; nothing is changed", function);
        return MEFALSE;
    }
    return METRUE;
}

static void scaleInertia(MeMatrix3 inertia, MeReal by) {
    for (int i = 0; i < 3; i++)
        MeVector3MultiplyScalar(inertia[i], inertia[i], by);
}

void MEAPI MstAutoSetMassProperties(const MdtBodyID body, const McdModelID model, const MeReal density) {
    MeMatrix3 inertia;
    MeReal volume;
    if (!(density > 0) || !MeRealIsValid(density)) {
        MeWarning(1, "MstAutoSetMassProperties: density is %g: it must be positive; nothing is changed",
                  (double)density);
        return;
    }
    if (!massOf(model, inertia, &volume, "MstAutoSetMassProperties"))
        return;
    scaleInertia(inertia, density);
    MdtBodySetMass(body, density * volume);
    MdtBodySetInertiaTensor(body, (const MeVector3 *)inertia);
}

void MEAPI MstAutoSetInertialTensor(const McdModelID model) {
    MeMatrix3 inertia;
    MeReal volume;
    const MdtBodyID body = McdModelGetBody(model);
    if (!body || !massOf(model, inertia, &volume, "MstAutoSetInertialTensor"))
        return;
    scaleInertia(inertia, MdtBodyGetMass(body) / volume);
    MdtBodySetInertiaTensor(body, (const MeVector3 *)inertia);
}

/* ---- models ---------------------------------------------------------------------------------------------------- */

/* Between changes as it was before. */
static void insertModel(McdSpaceID s, McdModelID m) {
    const MeBool isOpen = McdSpaceIsChanging(s) != 0;
    if (!isOpen)
        McdSpaceBeginChanges(s);
    if (McdSpaceInsertModel(s, m))
        McdSpaceUpdateModel(m);
    if (!isOpen)
        McdSpaceEndChanges(s);
}

McdModelID MEAPI MstModelAndBodyCreate(const MstUniverseID u, const McdGeometryID g, const MeReal density) {
    const MdtWorldID w = MstUniverseGetWorld(u);
    const McdModelID m = w ? McdModelCreate(g) : 0;
    const MdtBodyID b = m ? MdtBodyCreate(w) : 0;
    if (!b) {
        McdModelDestroy(m);
        return 0;
    }
    McdModelSetBody(m, b);
    MdtBodyEnable(b);
    MstAutoSetMassProperties(b, m, density);
    insertModel(u->space, m);
    return m;
}

McdModelID MEAPI MstFixedModelCreate(const MstUniverseID u, const McdGeometryID g, MeMatrix4Ptr transformation) {
    const McdSpaceID s = MstUniverseGetSpace(u);
    const McdModelID m = s ? McdModelCreate(g) : 0;
    if (!m)
        return 0;
    McdModelSetTransformPtr(m, transformation);
    insertModel(s, m);
    McdSpaceFreezeModel(m);
    return m;
}

/* Hands over the goodbye pairs of a model that leaves, so that their contacts go. */
static void removeModel(McdModelID m) {
    enum { ROOM = 64 };
    McdModelPair *array[ROOM];
    McdModelPairContainer pairs;
    McdSpacePairIterator iterator;
    const McdSpaceID s = McdModelGetSpace(m);
    if (!s)
        return;
    const MeBool isOpen = McdSpaceIsChanging(s) != 0;
    if (!isOpen)
        McdSpaceBeginChanges(s);
    McdSpaceRemoveModel(m);
    McdSpaceEndChanges(s);
    McdModelPairContainerInit(&pairs, array, ROOM);
    McdSpacePairIteratorBegin(s, &iterator);
    int isMore;
    do {
        McdModelPairContainerReset(&pairs);
        isMore = McdSpaceGetTransitions(s, &iterator, &pairs);
        MstHandleTransitionsOf(&pairs);
    } while (isMore);
    if (isOpen)
        McdSpaceBeginChanges(s);
}

void MEAPI MstFixedModelDestroy(const McdModelID m) {
    if (!m)
        return;
    removeModel(m);
    McdModelDestroy(m);
}

void MEAPI MstModelAndBodyDestroy(const McdModelID m) {
    const MdtBodyID b = m ? McdModelGetBody(m) : 0;
    MstFixedModelDestroy(m);
    if (b)
        MdtBodyDestroy(b);
}

/* ---- freezing ---------------------------------------------------------------------------------------------------- */

static void MEAPI freezeModels(const MdtBodyID b) {
    for (McdModelID m = MdtBodyGetModel(b); m; m = m->mOfBody)
        if (McdModelGetSpace(m))
            McdSpaceFreezeModel(m);
}

static void MEAPI unfreezeModels(const MdtBodyID b) {
    for (McdModelID m = MdtBodyGetModel(b); m; m = m->mOfBody)
        if (McdModelGetSpace(m))
            McdSpaceUnfreezeModel(m);
}

void MEAPI MstSetWorldHandlers(const MdtWorldID world) {
    MdtWorldSetBodyHandlers(world, unfreezeModels, freezeModels);
}
