/* What a convex shape on triangles costs: microseconds per query of shapes a metre in size on a grid of cells, flat and
 * rough, as a triangle list, a height field and an indexed mesh; lying flat, tilted a little, and lying any way. Then a
 * mesh of a million triangles: creation, fitting to moved vertices, rays.
 *
 *     meshes [--rounds COUNT] */
#include "timing.h"

#include "McdBox.h"
#include "McdCone.h"
#include "McdConvexMesh.h"
#include "McdCylinder.h"
#include "McdFrame.h"
#include "McdGeometry.h"
#include "McdInteractions.h"
#include "McdMesh.h"
#include "McdModel.h"
#include "McdModelPair.h"
#include "McdRGHeightField.h"
#include "McdSphere.h"
#include "McdSphyl.h"
#include "McdTriangleList.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS = 40, SAMPLES = CELLS + 1, QUERIES = 300, CONTACTS = 64 };
static const double cell = .37;
static MeVector3 vertex[SAMPLES * SAMPLES];
static MeReal height[SAMPLES * SAMPLES];

enum { SPHERE, BOX, CYLINDER, SPHYL, CONE, HULL, SHAPES };
static const char *const shapeName[SHAPES] = {"sphere", "box", "cylinder", "sphyl", "cone", "hull"};
enum { FLAT, TILTED, ANY, POSES };
static const char *const poseName[POSES] = {"flat", "tilted", "any"};

static unsigned int seed;
static double between(double low, double high) {
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(seed >> 8) / 16777216.0;
}

static void makeGround(double roughness) {
    for (int j = 0; j < SAMPLES; j++)
        for (int i = 0; i < SAMPLES; i++) {
            MeReal *v = vertex[j * SAMPLES + i];
            height[j * SAMPLES + i] = (MeReal)between(-roughness, roughness);
            MeVector3Set(v, (MeReal)(cell * (i - CELLS / 2)), (MeReal)(cell * (j - CELLS / 2)),
                         height[j * SAMPLES + i]);
        }
}

static int cellAt(MeReal x) {
    const int i = (int)floor((double)x / cell) + CELLS / 2;
    return MeCLAMP(i, 0, CELLS - 1);
}

static void addTriangle(McdUserTriangle *t, int a, int b, int c) {
    t->vertices[0] = &vertex[a];
    t->vertices[1] = &vertex[b];
    t->vertices[2] = &vertex[c];
    t->normal = 0;
    t->triangleData.ptr = 0;
    t->flags = (McdTriangleFlags)(kMcdTriangleStandard & ~kMcdTriangleTwoSided);
}

static int MEAPI findTriangles(McdModelPair *pair, McdUserTriangle *triangle, MeVector3 pos, MeReal radius, int max) {
    int count = 0;
    (void)pair;
    for (int j = cellAt(pos[1] - radius); j <= cellAt(pos[1] + radius); j++)
        for (int i = cellAt(pos[0] - radius); i <= cellAt(pos[0] + radius) && count + 2 <= max; i++) {
            const int a = j * SAMPLES + i;
            addTriangle(&triangle[count++], a, a + 1, a + 1 + SAMPLES);
            addTriangle(&triangle[count++], a, a + 1 + SAMPLES, a + SAMPLES);
        }
    return count;
}

static McdFrameworkID makeFramework(void) {
    McdFrameworkID f = McdInit(0, 20, 20, 1);
    McdSphereRegisterType(f);
    McdBoxRegisterType(f);
    McdCylinderRegisterType(f);
    McdSphylRegisterType(f);
    McdConeRegisterType(f);
    McdConvexMeshRegisterType(f);
    McdTriangleListRegisterType(f);
    McdRGHeightFieldRegisterType(f);
    McdMeshRegisterType(f);
    McdSphereTriangleListRegisterInteraction(f);
    McdBoxTriangleListRegisterInteraction(f);
    McdCylinderTriangleListRegisterInteraction(f);
    McdSphylTriangleListRegisterInteraction(f);
    McdConeTriangleListRegisterInteraction(f);
    McdConvexMeshTriangleListRegisterInteraction(f);
    McdSphereRGHeightFieldRegisterInteraction(f);
    McdBoxRGHeightFieldRegisterInteraction(f);
    McdCylinderRGHeightFieldRegisterInteraction(f);
    McdSphylRGHeightFieldRegisterInteraction(f);
    McdConeRGHeightFieldRegisterInteraction(f);
    McdConvexMeshRGHeightFieldRegisterInteraction(f);
    McdMeshRegisterInteractions(f);
    return f;
}

static McdGeometryID makeShape(McdFrameworkID f, int kind) {
    MeVector3 p[24];
    switch (kind) {
    case SPHERE:
        return McdSphereCreate(f, (MeReal).5);
    case BOX:
        return McdBoxCreate(f, 1, 1, 1);
    case CYLINDER:
        return McdCylinderCreate(f, (MeReal).5, 1);
    case SPHYL:
        return McdSphylCreate(f, (MeReal).3, (MeReal).6);
    case CONE:
        return McdConeCreate(f, 1, (MeReal).5);
    default:
        for (int i = 0; i < 24; i++)
            MeVector3Set(p[i], (MeReal)(.5 * cos(i * .7853981634)), (MeReal)(.5 * sin(i * .7853981634)),
                         (MeReal)(i < 8    ? -.5
                                  : i < 16 ? .3
                                           : .5));
        for (int i = 16; i < 24; i++)
            MeVector3Set(p[i], p[i][0] / 2, p[i][1] / 2, p[i][2]);
        return McdConvexMeshCreateHull(f, (const MeVector3 *)p, 24, 0);
    }
}

static McdGeometryID makeList(McdFrameworkID f) {
    const MeReal reach = (MeReal)(cell * CELLS / 2);
    MeVector3 min = {-reach, -reach, -1}, max = {reach, reach, 1};
    return McdTriangleListCreate(f, min, max, 2000, findTriangles);
}

static McdGeometryID makeField(McdFrameworkID f) {
    const MeReal reach = (MeReal)(cell * CELLS / 2);
    return McdRGHeightFieldCreate(f, height, SAMPLES, SAMPLES, (MeReal)cell, (MeReal)cell, -reach, -reach);
}

/* The grid's triangles; `stride` points a row. */
static McdGeometryID makeMesh(McdFrameworkID f, const MeVector3 *points, int stride) {
    const int cells = stride - 1;
    int *index = malloc(6 * (size_t)cells * (size_t)cells * sizeof *index), *next = index;
    for (int j = 0; j < cells; j++)
        for (int i = 0; i < cells; i++, next += 6) {
            const int a = j * stride + i, of[6] = {a, a + 1, a + 1 + stride, a, a + 1 + stride, a + stride};
            memcpy(next, of, sizeof of);
        }
    const double begin = now();
    McdGeometryID mesh = McdMeshCreate(f, points, stride * stride, index, 2 * cells * cells, 0);
    if (cells > CELLS)
        printf("%d triangles: created in %.3f s", 2 * cells * cells, now() - begin);
    free(index);
    return mesh;
}

/* Its lowest point a hundredth below 0. */
static void makePose(McdGeometryID g, int pose, MeMatrix4 tm) {
    const double turn = pose == FLAT ? 0 : pose == TILTED ? .02 : 3;
    MeReal down[3] = {0, 0, -1};
    MeMatrix3 r;
    MeVector3 lowest;
    MeMatrix4TMMakeIdentity(tm);
    MeMatrix3FromEulerAngles(r, (MeReal)between(-turn, turn), (MeReal)between(-turn, turn), (MeReal)between(-3, 3));
    MeMatrix4TMSetRotation(tm, (const MeVector3 *)r);
    MeMatrix4TMSetPosition(tm, (MeReal)between(-3, 3), (MeReal)between(-3, 3), 0);
    McdGeometryMaximumPoint(g, (const MeVector4 *)tm, down, lowest);
    tm[3][2] = -lowest[2] - (MeReal).01;
}

/* The best of the rounds, per query. */
static double timeShape(McdFrameworkID f, int kind, McdGeometryID ground, int pose, int rounds, double *contacts) {
    static MeMatrix4 tm[QUERIES];
    McdGeometryID g = makeShape(f, kind);
    McdModelID model = McdModelCreate(g), groundModel = McdModelCreate(ground);
    McdModelPair pair;
    McdContact contact[CONTACTS];
    McdIntersectResult result;
    MeMatrix4 groundTM;
    double best = INFINITY;
    memset(&pair, 0, sizeof pair);
    pair.model1 = model;
    pair.model2 = groundModel;
    result.contacts = contact;
    result.contactMaxCount = CONTACTS;
    MeMatrix4TMMakeIdentity(groundTM);
    McdModelSetTransformPtr(groundModel, groundTM);
    McdModelUpdate(groundModel);
    seed = 1;
    for (int i = 0; i < QUERIES; i++)
        makePose(g, pose, tm[i]);
    McdModelSetTransformPtr(model, tm[0]);
    McdHello(&pair);
    for (int i = 0; i < rounds; i++) {
        double sum = 0;
        *contacts = 0;
        for (int k = 0; k < QUERIES; k++) {
            McdModelSetTransformPtr(model, tm[k]);
            McdModelUpdate(model);
            const double begin = now();
            McdIntersect(&pair, &result);
            sum += now() - begin;
            *contacts += result.contactCount;
        }
        best = fmin(best, sum / QUERIES);
    }
    *contacts /= QUERIES;
    McdGoodbye(&pair);
    McdModelDestroy(model);
    McdModelDestroy(groundModel);
    return best;
}

static void timeGround(const char *name, double roughness, int rounds) {
    seed = 7;
    makeGround(roughness);
    static const char *const groundName[] = {"list", "field", "mesh"};
    for (int kindOfGround = 0; kindOfGround < 3; kindOfGround++)
        for (int kind = 0; kind < SHAPES; kind++) {
            printf("%-6s %-6s %-9s", name, groundName[kindOfGround], shapeName[kind]);
            for (int pose = 0; pose < POSES; pose++) {
                McdFrameworkID f = makeFramework();
                McdGeometryID ground = kindOfGround == 0   ? makeList(f)
                                       : kindOfGround == 1 ? makeField(f)
                                                           : makeMesh(f, (const MeVector3 *)vertex, SAMPLES);
                double contacts;
                const double t = timeShape(f, kind, ground, pose, rounds, &contacts);
                printf(" %8.2f %4.1f", 1e6 * t, contacts);
                McdFrameworkDestroyAllModelsAndGeometries(f);
                McdTerm(f);
            }
            printf("\n");
        }
}

static void timeMillion(void) {
    enum { POINTS = 708, RAYS = 100000 };
    MeVector3 *points = malloc((size_t)POINTS * POINTS * sizeof *points);
    McdFrameworkID f = makeFramework();
    MeMatrix4 tm;
    int hits = 0;
    for (int i = 0; i < POINTS * POINTS; i++)
        MeVector3Set(points[i], (MeReal)(i % POINTS), (MeReal)(i / POINTS), (MeReal)between(0, .2));
    McdGeometryID mesh = makeMesh(f, (const MeVector3 *)points, POINTS);
    double begin = now();
    McdMeshSetVertices(mesh, (const MeVector3 *)points);
    printf(", fitted in %.3f s", now() - begin);
    McdMeshLineSegmentRegisterInteraction(f);
    McdModelID m = McdModelCreate(mesh);
    MeMatrix4TMMakeIdentity(tm);
    McdModelSetTransformPtr(m, tm);
    McdModelUpdate(m);
    begin = now();
    for (int i = 0; i < RAYS; i++) {
        MeVector3 from = {(MeReal)between(10, 690), (MeReal)between(10, 690), 5}, to;
        McdLineSegIntersectResult hit;
        MeVector3Set(to, from[0] + (MeReal)between(-5, 5), from[1] + (MeReal)between(-5, 5), -5);
        hits += (int)McdLineSegIntersect(m, from, to, &hit);
    }
    printf(", a ray takes %.2f us (%d of %d hit)\n", 1e6 * (now() - begin) / RAYS, hits, (int)RAYS);
    McdFrameworkDestroyAllModelsAndGeometries(f);
    McdTerm(f);
    free(points);
}

int main(int argc, char **argv) {
    const int rounds = argc > 2 && !strcmp(argv[1], "--rounds") ? atoi(argv[2]) : 10;
    printf("%-23s", "");
    for (int pose = 0; pose < POSES; pose++)
        printf(" %8s     ", poseName[pose]);
    printf("  us, and contacts per query\n");
    timeGround("flat", 0, rounds);
    timeGround("rough", .05, rounds);
    timeMillion();
    return 0;
}
