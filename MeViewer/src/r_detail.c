/* Round shapes at the detail that the picture needs.
 *
 * A graphic that still has the vertices it was created with is drawn with another mesh of the same shape: with so many
 * sides that none is seen, and no more. Small things far away cost little, and near ones are rounder than they were
 * made. Shapes of one kind share a mesh of size 1, which their transforms stretch: a thousand boxes are one call. */
#include "r_draw_i.h"
#include "RGeometryUtils.h"

#include <string.h>

static const int steps[] = {8, 12, 16, 24, 32, 48, 64, 96, 128};
enum { STEPS = sizeof steps / sizeof steps[0] };

/* A circle of n sides is off by r (1 - cos(pi / n)): less than a sixth of a pixel. */
static int sidesFor(float pixels) {
    for (int i = 0; i < STEPS; i++)
        if (pixels * (1 - cosf(3.14159265f / (float)steps[i])) < 0.16f)
            return steps[i];
    return steps[STEPS - 1];
}

static int vertexCount(const RShape *shape, int sides) {
    switch (shape->kind) {
    case rShapeBox:
        return RCalculateBoxVertexCount();
    case rShapeSphere:
        return RCalculateSphereVertexCount(sides, sides / 2);
    case rShapeCylinder:
        return RCalculateFrustumVertexCount(sides);
    case rShapeCone:
        return RCalculateConeVertexCount(sides);
    case rShapeSphyl:
        return RCalculateSphylVertexCount(sides, sides / 2);
    case rShapeTorus:
        return RCalculateTorusVertexCount(sides, sides / 2);
    default:
        return 0;
    }
}

static void calculate(RGraphic *rg, const RShape *shape, int sides) {
    switch (shape->kind) {
    case rShapeBox:
        RCalculateBoxGeometry(rg, 1, 1, 1);
        break;
    case rShapeSphere:
        RCalculateSphereGeometry(rg, 1, sides, sides / 2);
        break;
    case rShapeCylinder:
        RCalculateFrustumGeometry(rg, 1, 1, -0.5f, 0.5f, sides);
        break;
    case rShapeCone:
        RCalculateConeGeometry(rg, 1, 0, 1, sides);
        break;
    case rShapeSphyl:
        RCalculateSphylGeometry(rg, 1, shape->ratio, sides, sides / 2);
        break;
    case rShapeTorus:
        RCalculateTorusGeometry(rg, 1, shape->ratio, sides, sides / 2);
        break;
    default:
        break;
    }
}

/* Cones and cylinders of few sides would have flat ones, as frustums do. */
static int fewestSides(const RShape *shape) {
    return shape->kind == rShapeCylinder || shape->kind == rShapeCone ? 16 : 8;
}

RMesh *r_detailMesh(RDraw *d, RGraphic *rg, float pixelsPerUnit) {
    const RShape *shape = &rg->m_pPart->shape;
    if (shape->kind == rShapeOther)
        return NULL;
    uint64_t hash[2];
    r_hashVertices(rg->m_pVertices, rg->m_pObject->m_nNumVertices, hash);
    if (memcmp(hash, shape->hash, sizeof hash) != 0)
        return NULL;

    int sides = shape->kind == rShapeBox ? 4 : sidesFor(pixelsPerUnit * shape->scale[0]);
    sides = sides > fewestSides(shape) ? sides : fewestSides(shape);
    uint32_t ratio;
    memcpy(&ratio, &shape->ratio, sizeof ratio);
    const uint64_t key[2] = {r_hashWord((uint64_t)shape->kind, (uint64_t)sides), r_hashWord((uint64_t)sides, ratio)};
    const int count = vertexCount(shape, sides);
    RMesh *mesh = r_meshFind(d, key, -count, rg->m_pPart);
    if (mesh)
        return mesh;
    RGraphic *model = r_graphicCreate(__func__, count, rMesh);
    if (!model)
        return NULL;
    calculate(model, shape, sides);
    mesh = r_meshAdd(d, key, -count, model->m_pVertices, model->m_pObject->m_nNumVertices);
    RGraphicDestroy(model);
    return mesh;
}

void r_detailTransform(const RShape *shape, float m[16]) {
    for (int k = 0; k < 3; k++)
        m[12 + k] += shape->shift * m[8 + k];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            m[4 * i + k] *= shape->scale[i];
}
