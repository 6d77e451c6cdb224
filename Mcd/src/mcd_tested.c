/* Whether a pair would be found as it was when it was last tested.
 *
 * What convex shapes and planes have in common depends on where they are, how large they are and how far the pair looks, and
 * on nothing else. A model gets a new stamp when any of that has another bit than at the last look; a pair keeps the stamps
 * of its last test. Triangle lists, fields, aggregates and a program's own types may depend on more: they are always tested.
 */
#include "McdInternal.h"
#include "McdModelPair.h"
#include "mcd_geometries.h"
#include <string.h>

/* Bytes of the geometry's own parameters; -1: a test of it may depend on more. */
static int parameterBytes(McdGeometryType type) {
    switch (type) {
    case kMcdGeometryTypeSphere:
        return sizeof(McdSphere) - sizeof(McdGeometry);
    case kMcdGeometryTypeBox:
        return sizeof(McdBox) - sizeof(McdGeometry);
    case kMcdGeometryTypeCylinder:
        return sizeof(McdCylinder) - sizeof(McdGeometry);
    case kMcdGeometryTypeSphyl:
        return sizeof(McdSphyl) - sizeof(McdGeometry);
    case kMcdGeometryTypeCone:
        return sizeof(McdCone) - sizeof(McdGeometry);
    case kMcdGeometryTypeConvexMesh:
        return sizeof(McdConvexMesh) - sizeof(McdGeometry);
    case kMcdGeometryTypePlane:
        return 0;
    default:
        return -1;
    }
}

/* All that a test reads of one model. */
static MeBool look(const McdModelRecord *m, McdSeen *seen) {
    const McdGeometry *g = m->instance.geometry;
    const int bytes = parameterBytes(g->type);
    if (bytes < 0 || m->intersect || !m->instance.tm)
        return MEFALSE;
    MEASSERT((size_t)bytes <= sizeof seen->parameters);
    memset(seen, 0, sizeof *seen);
    seen->geometry = g;
    memcpy(seen->parameters, (const char *)g + sizeof *g, (size_t)bytes);
    memcpy(seen->tm, m->instance.tm, sizeof seen->tm);
    return METRUE;
}

/* The model's stamp as it is now; 0: nobody can tell what a test of it depends on. */
static MeU64 stampOf(McdModelRecord *m) {
    McdSeen now;
    if (!look(m, &now))
        return 0;
    if (m->stamp == 0 || memcmp(&now, &m->seen, sizeof now) != 0) {
        m->seen = now;
        m->stamp = ++m->frame->lastStamp;
    }
    return m->stamp;
}

/* The pair's own, or the framework's: both can be changed at any time. */
static McdTest testOf(McdModelPair *p) {
    const McdRequest *request = McdModelPairGetRequestPtr(p);
    McdTest test;
    memset(&test, 0, sizeof test);
    test.stamp1 = stampOf(mcd_record(p->model1));
    test.stamp2 = stampOf(mcd_record(p->model2));
    test.margin = mcd_pairMargin(p);
    test.contactMaxCount = request->contactMaxCount;
    test.faceNormalsFirst = request->faceNormalsFirst;
    return test;
}

MeBool MEAPI McdModelPairIsAsTested(McdModelPair *p) {
    MEASSERT(p && p->model1 && p->model2);
    const McdTest now = testOf(p);
    const MeBool isSame = now.stamp1 != 0 && now.stamp2 != 0 && memcmp(&now, &p->test, sizeof now) == 0;
    p->test = now;
    return isSame && mcd_interactionIsBuiltIn(p);
}

void MEAPI McdModelPairForgetTest(McdModelPair *p) {
    MEASSERT(p);
    memset(&p->test, 0, sizeof p->test);
}
