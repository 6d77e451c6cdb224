/* Models with and without bodies: creation, mass properties, freezing. */
#include "MstUtils.h"
#include "McdGeometry.h"
#include "McdInteractions.h"
#include "McdInternal.h"
#include "MdtWorld.h"
#include "MeAssert.h"
#include "MeMessage.h"
#include "MstUniverse.h"
#include "step/mst_step_i.h"

/* ---- mass ------------------------------------------------------------------------------------------------------ */

static MeBool getMassProperties(McdModelID model, MeMatrix4 centre, MeMatrix3 inertia, MeReal *volume,
                                const char *function) {
    if (!McdModelIsValid(model) || !McdGeometryGetMassProperties(McdModelGetGeometry(model), centre, inertia, volume) ||
        !(*volume > 0)) {
        MeWarning(1,
                  "%s: the model's geometry has no mass properties: mass and inertia stay as they are. What does not "
                  "move is made "
                  "by MstFixedModelCreate",
                  MeCallerName(function));
        return MEFALSE;
    }
    return METRUE;
}

static void scaleInertia(MeMatrix3 inertia, MeReal by) {
    for (int i = 0; i < 3; i++)
        MeVector3MultiplyScalar(inertia[i], inertia[i], by);
}

/* Sets mass and inertia, and writes where the geometry has its centre of mass. False, with a warning: it has none. */
static MeBool setMass(MdtBodyID body, McdModelID model, MeReal density, MeMatrix4 centre, const char *function) {
    MeMatrix3 inertia;
    MeReal volume;
    if (!(density > 0) || !MeRealIsValid(density)) {
        MeWarning(1, "%s: density is %g: it must be positive; mass and inertia stay as they are",
                  MeCallerName(function), (double)density);
        return MEFALSE;
    }
    if (!getMassProperties(model, centre, inertia, &volume, function))
        return MEFALSE;
    scaleInertia(inertia, density);
    MdtBodySetMass(body, density * volume);
    MdtBodySetInertiaTensor(body, (const MeVector3 *)inertia);
    return METRUE;
}

void MEAPI MstAutoSetMassProperties(const MdtBodyID body, const McdModelID model, const MeReal density) {
    MeMatrix4 centre;
    setMass(body, model, density, centre, __func__);
}

void MEAPI MstAutoSetMassAndCenter(const MdtBodyID body, const McdModelID model, const MeReal density) {
    MeMatrix4 centre;
    if (setMass(body, model, density, centre, __func__))
        MdtBodySetCenterOfMassRelativeTransform(body, (const MeVector4 *)centre);
}

void MEAPI MstAutoSetInertialTensor(const McdModelID model) {
    MeMatrix4 centre;
    MeMatrix3 inertia;
    MeReal volume;
    const MdtBodyID body = McdModelIsValid(model) ? McdModelGetBody(model) : 0;
    if (!body)
        MeWarning(1, "MstAutoSetInertialTensor: the model is null, or has no body; nothing is changed");
    if (!body || !getMassProperties(model, centre, inertia, &volume, __func__))
        return;
    scaleInertia(inertia, MdtBodyGetMass(body) / volume);
    MdtBodySetInertiaTensor(body, (const MeVector3 *)inertia);
}

/* ---- models ---------------------------------------------------------------------------------------------------- */

/* Inserts a model, in a change block of its own if none is open, and updates its box if its transform is known. */
static MeBool insertModel(McdSpaceID s, McdModelID m, MeBool isPlaced) {
    const MeBool isOpen = McdSpaceIsChanging(s) != 0;
    if (!isOpen)
        McdSpaceBeginChanges(s);
    const MeBool isIn = McdSpaceInsertModel(s, m);
    if (isIn && isPlaced)
        McdSpaceUpdateModel(m);
    if (!isOpen)
        McdSpaceEndChanges(s);
    return isIn;
}

static MeBool checkGeometry(McdGeometryID g, const char *function) {
    if (g && McdGeometryIsValid(g))
        return METRUE;
    MeWarning(1, "%s: g %s", function, g ? "is no geometry, or has been destroyed" : "is null: it must be a geometry");
    return MEFALSE;
}

/* Whether the geometry's centre of mass is at its origin, to a hundredth of its radius. */
static MeBool isCentred(McdGeometryID g) {
    MeMatrix4 relative;
    MeMatrix3 inertia;
    MeVector3 middle;
    MeReal volume, radius;
    if (!McdGeometryGetMassProperties(g, relative, inertia, &volume))
        return METRUE;
    McdGeometryGetBSphere(g, middle, &radius);
    return MeVector3Magnitude(relative[3]) <= (MeReal)0.01 * radius;
}

/* Creates a model and its body, without mass; on failure, nothing remains. */
static McdModelID createWithBody(MstUniverse *u, McdGeometryID g) {
    const McdModelID m = McdModelCreate(g);
    const MdtBodyID b = m ? MdtBodyCreate(u->world) : 0;
    if (!b || !insertModel(u->space, m, MEFALSE)) {
        McdModelDestroy(m);
        if (b)
            MdtBodyDestroy(b);
        return 0;
    }
    McdModelSetBody(m, b);
    MdtBodyEnable(b);
    return m;
}

static McdModelID createAsGiven(MstUniverse *u, McdGeometryID g, MeReal density) {
    const McdModelID m = createWithBody(u, g);
    if (!m)
        return 0;
    MstAutoSetMassProperties(McdModelGetBody(m), m, density);
    if (!isCentred(g))
        MdtBodyExpectCentreOfMass(McdModelGetBody(m));
    return m;
}

static McdModelID createWithCentre(MstUniverse *u, McdGeometryID g, MeReal density) {
    const McdModelID m = createWithBody(u, g);
    if (m)
        MstAutoSetMassAndCenter(McdModelGetBody(m), m, density);
    return m;
}

McdModelID MEAPI MstModelAndBodyCreate(const MstUniverseID u, const McdGeometryID g, const MeReal density) {
    ME_RETURN_UNDER_OWN_NAME(McdModelID,
                             MstUniverseGetWorld(u) && checkGeometry(g, __func__) ? createAsGiven(u, g, density) : 0);
}

McdModelID MEAPI MstModelAndBodyCreateWithCenter(const MstUniverseID u, const McdGeometryID g, const MeReal density) {
    ME_RETURN_UNDER_OWN_NAME(
        McdModelID, MstUniverseGetWorld(u) && checkGeometry(g, __func__) ? createWithCentre(u, g, density) : 0);
}

/* Whether the rotation has orthogonal rows of length 1 and is right-handed, to the precision of hand-written
 * numbers. */
static MeBool isRigid(const MeMatrix4 tm) {
    const double digits = 0.01; /* tolerates a rotation written with two digits; intended scales differ by more */
    double cross[3], handed = 0;
    for (int i = 0; i < 3; i++)
        for (int k = i; k < 3; k++) {
            double product = i == k ? -1 : 0;
            for (int j = 0; j < 3; j++)
                product += (double)tm[i][j] * (double)tm[k][j];
            if (!(fabs(product) < 2 * digits))
                return MEFALSE;
        }
    for (int j = 0; j < 3; j++) {
        const int a = (j + 1) % 3, b = (j + 2) % 3;
        cross[j] = (double)tm[0][a] * (double)tm[1][b] - (double)tm[0][b] * (double)tm[1][a];
        handed += cross[j] * (double)tm[2][j];
    }
    return handed > 0;
}

static McdModelID createFixed(McdSpaceID s, McdGeometryID g, MeMatrix4Ptr transformation) {
    if (!s || !checkGeometry(g, MeCallerName("MstFixedModelCreate")))
        return 0;
    if (!transformation)
        MeWarning(1,
                  "MstFixedModelCreate: the transform is null: set one (McdModelSetTransformPtr) before the next step");
    else if (!isRigid((const MeVector4 *)transformation))
        MeWarning(1,
                  "MstFixedModelCreate: the transform is not a rotation and a position: its first three rows must be "
                  "axes at right angles, of length 1 and right-handed; sizes belong to the geometry");
    const McdModelID m = McdModelCreate(g);
    if (!m)
        return 0;
    McdModelSetTransformPtr(m, transformation);
    if (!insertModel(s, m, transformation != 0)) {
        McdModelDestroy(m);
        return 0;
    }
    McdSpaceFreezeModel(m);
    return m;
}

McdModelID MEAPI MstFixedModelCreate(const MstUniverseID u, const McdGeometryID g, MeMatrix4Ptr transformation) {
    ME_RETURN_UNDER_OWN_NAME(McdModelID, createFixed(MstUniverseGetSpace(u), g, transformation));
}

/* The transform of a pose. False, with a warning: it is none. */
static MeBool toTransform(MeMatrix4 tm, const MeVector3 position, const MeVector4 quaternion) {
    static const MeVector4 none = {1, 0, 0, 0};
    const MeReal *given = quaternion ? quaternion : none;
    const double q[4] = {(double)given[0], (double)given[1], (double)given[2], (double)given[3]};
    const double size = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    MeVector4 unit;
    if (!position || !isfinite((double)position[0] + (double)position[1] + (double)position[2]) || !isfinite(size) ||
        !(size > 0)) {
        MeWarning(1, "MstFixedModelCreateAt: the %s; there is no model",
                  !position ? "position is null" : "pose is none: its numbers must be finite, the quaternion not 0");
        return MEFALSE;
    }
    MeQuaternionSet(unit, (MeReal)(q[0] / size), (MeReal)(q[1] / size), (MeReal)(q[2] / size), (MeReal)(q[3] / size));
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix4TMSetRotationFromQuaternion(tm, unit);
    MeVector3Copy(tm[3], position);
    return METRUE;
}

/* Creates the model with a transform of the caller's, which a copy then replaces. */
static McdModelID createFixedAt(McdSpaceID s, McdGeometryID g, const MeVector3 position, const MeVector4 quaternion) {
    MeMatrix4 tm;
    const McdModelID m = s && toTransform(tm, position, quaternion) ? createFixed(s, g, tm) : 0;
    if (m && !McdModelPlaceAtCopy(m, (const MeVector4 *)tm)) {
        McdModelDestroy(m);
        return 0;
    }
    return m;
}

McdModelID MEAPI MstFixedModelCreateAt(const MstUniverseID u, const McdGeometryID g, const MeVector3 position,
                                       const MeVector4 quaternion) {
    ME_RETURN_UNDER_OWN_NAME(McdModelID, createFixedAt(MstUniverseGetSpace(u), g, position, quaternion));
}

/* Removes a model from its space and handles the goodbye pairs, so that its contacts are destroyed. */
static void removeFromSpace(McdModelID m) {
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
    MEASSERT(!McdModelGetSpace(m));
    if (isOpen)
        McdSpaceBeginChanges(s);
}

/* For an invalid model, McdModelDestroy gives the warning. */
static MeBool mayDestroy(McdModelID m, const char *function) {
    if (!m || McdModelIsValid(m))
        return m && MeProgramMayChange(function);
    const char *const before = MeMessagesAs(function);
    McdModelDestroy(m);
    MeMessagesAs(before);
    return MEFALSE;
}

/* While a stage guards the models, McdModelDestroy defers the removal to its end. */
static void destroyModel(McdModelID m) {
    if (!McdModelGetGuardStage(m))
        removeFromSpace(m);
    McdModelDestroy(m);
}

void MEAPI MstFixedModelDestroy(const McdModelID m) {
    if (mayDestroy(m, "MstFixedModelDestroy"))
        destroyModel(m);
}

void MEAPI MstModelAndBodyDestroy(const McdModelID m) {
    if (!mayDestroy(m, "MstModelAndBodyDestroy"))
        return;
    const MdtBodyID b = McdModelGetBody(m);
    if (b)
        MdtBodyEndSleep(b);
    destroyModel(m);
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
    ME_UNDER_OWN_NAME(MdtWorldSetModelHandlers(world, unfreezeModels, freezeModels));
}
