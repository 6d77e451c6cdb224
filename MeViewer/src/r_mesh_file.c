/* Graphics from files of meshes, by assimp.
 *
 * It is loaded when the first file is read, as OSMesa is when something is drawn: programs that read no meshes neither
 * wait for its ten megabytes nor need it. */
#include "RMesh.h"
#include "r_i.h"

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <dlfcn.h>
#include <string.h>

static struct {
    void *library;
    const struct aiScene *(*import)(const char *path, unsigned int flags);
    void (*release)(const struct aiScene *scene);
    const char *(*error)(void);
} assimp;

/* A function's address as a function pointer, which ISO C does not convert to. */
static bool find(const char *name, void *function, size_t size) {
    void *address = dlsym(assimp.library, name);
    memcpy(function, &address, size);
    return address != NULL;
}

/* Version 5, whose structures the headers have. Stays loaded. */
static bool load(void) {
    if (!assimp.library)
        assimp.library = dlopen("libassimp.so.5", RTLD_NOW | RTLD_LOCAL);
    return assimp.library && find("aiImportFile", &assimp.import, sizeof assimp.import) &&
           find("aiReleaseImport", &assimp.release, sizeof assimp.release) &&
           find("aiGetErrorString", &assimp.error, sizeof assimp.error);
}

/* aiProcess_SortByPType leaves one kind in a mesh; a flag beside it tells which triangles were one polygon. */
static bool isOfTriangles(const struct aiMesh *mesh) {
    return (mesh->mPrimitiveTypes & aiPrimitiveType_TRIANGLE) != 0;
}

static size_t countTriangles(const struct aiScene *scene) {
    size_t n = 0;
    for (unsigned i = 0; i < scene->mNumMeshes; i++)
        if (isOfTriangles(scene->mMeshes[i]))
            n += scene->mMeshes[i]->mNumFaces;
    return n;
}

static RObjectVertex vertexOf(const struct aiMesh *mesh, unsigned i) {
    const struct aiVector3D p = mesh->mVertices[i], n = mesh->mNormals[i];
    RObjectVertex v = {.m_X = p.x, .m_Y = p.y, .m_Z = p.z, .m_NX = n.x, .m_NY = n.y, .m_NZ = n.z};
    if (mesh->mTextureCoords[0]) {
        v.m_U = mesh->mTextureCoords[0][i].x;
        v.m_V = mesh->mTextureCoords[0][i].y;
    }
    return v;
}

static void addMesh(const struct aiMesh *mesh, RObjectVertex **to) {
    if (!isOfTriangles(mesh))
        return;
    for (unsigned i = 0; i < mesh->mNumFaces; i++)
        for (unsigned k = 0; k < 3; k++)
            *(*to)++ = vertexOf(mesh, mesh->mFaces[i].mIndices[k]);
}

static RGraphic *graphicOf(const struct aiScene *scene, const char *function, const char *filename) {
    enum { MAX = 100000000 };
    const size_t triangles = countTriangles(scene);
    if (triangles == 0 || triangles > MAX) {
        MeWarning(1, "%s: the file %s has %s triangles", function, filename, triangles ? "too many" : "no");
        return NULL;
    }
    RGraphic *rg = r_graphicCreate(function, (int)(3 * triangles), rMesh);
    RObjectVertex *to = rg ? rg->m_pVertices : NULL;
    for (unsigned i = 0; rg && i < scene->mNumMeshes; i++)
        addMesh(scene->mMeshes[i], &to);
    return rg;
}

static RGraphic *readMesh(const char *function, const char *filename) {
    const unsigned flags = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_PreTransformVertices |
                           aiProcess_GenNormals | aiProcess_FlipUVs;
    if (!load()) {
        MeWarning(1, "%s: %s is not read: the library assimp is not there (install libassimp5)", function, filename);
        return NULL;
    }
    const struct aiScene *scene = assimp.import(filename, flags);
    if (!scene) {
        MeWarning(1, "%s: the file %s cannot be read: %s", function, filename, assimp.error());
        return NULL;
    }
    RGraphic *rg = graphicOf(scene, function, filename);
    assimp.release(scene);
    return rg;
}

RGraphic *MEAPI RGraphicLoadMesh(RRender *rc, const char *filename, AcmeReal scale, const float color[4],
                                 MeMatrix4Ptr matrix) {
    if (!r_isContext(rc, "RGraphicLoadMesh") || !r_isPointer(filename, "RGraphicLoadMesh", "filename") ||
        !r_isNumber(scale, "RGraphicLoadMesh", "scale"))
        return NULL;
    if (scale == 0) {
        MeWarning(1, "RGraphicLoadMesh: scale is 0");
        return NULL;
    }
    RGraphic *rg = readMesh("RGraphicLoadMesh", filename);
    if (rg)
        RGraphicScale(rg, scale, scale, scale);
    return r_graphicFinish("RGraphicLoadMesh", rc, rg, color, matrix, false);
}
