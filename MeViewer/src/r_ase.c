/* Reads .ASE files (3D Studio's text export): the triangles of all meshes in them, with texture coordinates. */
#include "r_i.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

typedef struct {
    float v[3];
} Point;

typedef struct {
    int corner[3], texture[3];
    Point normal[3];
    bool hasNormals;
} Face;

/* One *MESH; its faces name its vertices by number. */
typedef struct {
    R_ARRAY(Point) vertices, textures;
    R_ARRAY(Face) faces;
    Face *normalsOf;  /* The face that *MESH_VERTEXNORMAL lines belong to. */
    int normalsGiven; /* Of it. */
    bool leftOut;
} Mesh;

typedef struct {
    const char *at; /* What has not been read yet; ends with a 0. */
    Mesh mesh;
    R_ARRAY(RObjectVertex) out;
    bool noMcd; /* Objects named MCD... are left out. */
    bool isMcd; /* The object that is being read is named so. */
    bool broken;
} Reader;

/* ---- Words and numbers ---- */

static const char *nextWord(Reader *r, size_t *length) {
    r->at += strspn(r->at, " \t\r\n");
    const char *word = r->at;
    if (*word == '"') { /* A name; may contain anything but quotation marks. */
        r->at += 1 + strcspn(r->at + 1, "\"");
        r->at += *r->at == '"';
    } else {
        r->at += strcspn(r->at, " \t\r\n");
    }
    *length = (size_t)(r->at - word);
    return word;
}

static bool is(const char *word, size_t length, const char *keyword) {
    return strlen(keyword) == length && strncmp(word, keyword, length) == 0;
}

static int readInt(Reader *r) {
    char *end;
    const long value = strtol(r->at, &end, 10);
    if (end == r->at || value < 0 || value > 100000000)
        r->broken = true;
    r->at = end;
    return (int)value;
}

static Point readPoint(Reader *r) {
    Point p = {{0, 0, 0}};
    for (int i = 0; i < 3; i++) {
        char *end;
        p.v[i] = strtof(r->at, &end);
        if (end == r->at || !isfinite(p.v[i]))
            r->broken = true;
        r->at = end;
    }
    return p;
}

/* ---- Statements ---- */

#define STORE(r, array, index, value)                                                                                  \
    do {                                                                                                               \
        const size_t index_ = (size_t)(index);                                                                         \
        if (index_ == (array).count && r_grow(array, 1))                                                               \
            (array).count++;                                                                                           \
        if (index_ < (array).count)                                                                                    \
            (array).items[index_] = (value);                                                                           \
        else                                                                                                           \
            (r)->broken = true; /* Numbers are to come in their order. */                                              \
    } while (0)

static void readVertex(Reader *r) {
    const int index = readInt(r);
    const Point p = readPoint(r);
    STORE(r, r->mesh.vertices, index, p);
}

static void readTextureVertex(Reader *r) {
    const int index = readInt(r);
    const Point p = readPoint(r);
    STORE(r, r->mesh.textures, index, p);
}

/* "*MESH_FACE 0: A: 0 B: 2 C: 3 AB: 1 ...": the first three letters with a colon name the corners. */
static void readFace(Reader *r) {
    Face f = {.texture = {-1, -1, -1}};
    const int index = readInt(r);
    for (int i = 0; i < 3; i++) {
        const char label[] = {(char)('A' + i), ':', 0};
        r->at += strspn(r->at, " \t:");
        if (strncmp(r->at, label, 2) != 0) {
            r->broken = true;
            return;
        }
        r->at += 2;
        f.corner[i] = readInt(r);
    }
    STORE(r, r->mesh.faces, index, f);
}

static Face *faceAt(Reader *r) {
    const int index = readInt(r);
    if ((size_t)index < r->mesh.faces.count && index >= 0)
        return &r->mesh.faces.items[index];
    r->broken = true;
    return NULL;
}

static void readTextureFace(Reader *r) {
    Face *f = faceAt(r);
    for (int i = 0; f && i < 3; i++)
        f->texture[i] = readInt(r);
}

static void readFaceNormal(Reader *r) {
    r->mesh.normalsOf = faceAt(r);
    r->mesh.normalsGiven = 0;
}

static void readVertexNormal(Reader *r) {
    Mesh *m = &r->mesh;
    (void)readInt(r); /* The vertex's number: they come in the order of the face's corners. */
    const Point n = readPoint(r);
    if (!m->normalsOf || m->normalsGiven >= 3)
        return;
    m->normalsOf->normal[m->normalsGiven++] = n;
    m->normalsOf->hasNormals = m->normalsGiven == 3;
}

/* *NODE_NAME "MCDBX_Wheel": shapes for collision, as modelling programs name them. */
static void readName(Reader *r) {
    size_t length;
    const char *name = nextWord(r, &length);
    r->isMcd = length > 4 && strncasecmp(name, "\"MCD", 4) == 0;
}

static const struct {
    const char *keyword;
    void (*read)(Reader *r);
} statements[] = {{"*NODE_NAME", readName},
                  {"*MESH_VERTEX", readVertex},
                  {"*MESH_TVERT", readTextureVertex},
                  {"*MESH_FACE", readFace},
                  {"*MESH_TFACE", readTextureFace},
                  {"*MESH_FACENORMAL", readFaceNormal},
                  {"*MESH_VERTEXNORMAL", readVertexNormal}};

/* ---- From a mesh to triangles ---- */

static Point flatNormal(const Point *a, const Point *b, const Point *c) {
    const float u[3] = {b->v[0] - a->v[0], b->v[1] - a->v[1], b->v[2] - a->v[2]};
    const float v[3] = {c->v[0] - a->v[0], c->v[1] - a->v[1], c->v[2] - a->v[2]};
    return (Point){{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]}};
}

static RObjectVertex makeVertex(const Mesh *m, const Face *f, int i, const Point *flat) {
    const Point *p = &m->vertices.items[f->corner[i]], *n = f->hasNormals ? &f->normal[i] : flat;
    const float length = sqrtf(n->v[0] * n->v[0] + n->v[1] * n->v[1] + n->v[2] * n->v[2]);
    const float scale = length > 0 ? 1 / length : 0;
    RObjectVertex v = {p->v[0], p->v[1], p->v[2], n->v[0] * scale, n->v[1] * scale, n->v[2] * scale, 0, 0};
    if (f->texture[i] >= 0 && (size_t)f->texture[i] < m->textures.count) {
        v.m_U = m->textures.items[f->texture[i]].v[0];
        v.m_V = 1 - m->textures.items[f->texture[i]].v[1]; /* In the file, v goes up. */
    }
    return v;
}

/* Adds the mesh's triangles to the output and begins a new mesh. */
static void finishMesh(Reader *r) {
    Mesh *m = &r->mesh;
    if (!r_grow(r->out, 3 * m->faces.count))
        r->broken = true;
    for (size_t k = 0; !m->leftOut && !r->broken && k < m->faces.count; k++) {
        const Face *f = &m->faces.items[k];
        for (int i = 0; i < 3; i++)
            r->broken |= (size_t)f->corner[i] >= m->vertices.count;
        if (r->broken)
            break;
        const Point *p = m->vertices.items;
        const Point flat = flatNormal(&p[f->corner[0]], &p[f->corner[1]], &p[f->corner[2]]);
        for (int i = 0; i < 3; i++)
            r->out.items[r->out.count++] = makeVertex(m, f, i, &flat);
    }
    m->vertices.count = m->textures.count = m->faces.count = 0;
    m->normalsOf = NULL;
}

static void readAll(Reader *r) {
    while (!r->broken) {
        size_t length;
        const char *word = nextWord(r, &length);
        if (length == 0)
            break;
        if (is(word, length, "*MESH")) {
            finishMesh(r);
            r->mesh.leftOut = r->noMcd && r->isMcd;
        }
        for (size_t i = 0; i < sizeof statements / sizeof statements[0]; i++)
            if (is(word, length, statements[i].keyword))
                statements[i].read(r);
    }
    finishMesh(r);
}

/* ---- Files ---- */

static char *readFile(const char *filename) {
    enum { MAX_BYTES = 1 << 30 };
    FILE *file = fopen(filename, "rb");
    char *text = NULL;
    if (!file)
        return NULL;
    const long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    if (size >= 0 && size < MAX_BYTES && fseek(file, 0, SEEK_SET) == 0 && (text = r_alloc((size_t)size + 1)) != NULL &&
        fread(text, 1, (size_t)size, file) != (size_t)size) {
        r_free(text);
        text = NULL;
    }
    fclose(file);
    return text;
}

static RGraphic *readAse(const char *function, const char *filename, bool noMcd) {
    Reader r = {.noMcd = noMcd};
    RGraphic *rg = NULL;
    char *text = readFile(filename);
    if (!text) {
        MeWarning(1, "%s: the file %s cannot be read", function, filename);
        return NULL;
    }
    r.at = text;
    readAll(&r);
    if (r.broken)
        MeWarning(1, "%s: the file %s is broken at byte %ld", function, filename, (long)(r.at - text));
    else if (r.out.count == 0 || r.out.count > 300000000)
        MeWarning(1, "%s: the file %s has no triangles", function, filename);
    else
        rg = r_graphicCreate(function, (int)r.out.count, rMesh);
    if (rg)
        memcpy(rg->m_pVertices, r.out.items, r.out.count * sizeof *r.out.items);
    r_free(r.mesh.vertices.items);
    r_free(r.mesh.textures.items);
    r_free(r.mesh.faces.items);
    r_free(r.out.items);
    r_free(text);
    return rg;
}

static bool scalesAreGood(const char *function, AcmeReal x, AcmeReal y, AcmeReal z) {
    const AcmeReal scales[3] = {x, y, z};
    if (!r_isFinite(scales, 3, function, "the scales"))
        return false;
    if (x == 0 || y == 0 || z == 0)
        MeWarning(1, "%s: a scale is 0", function);
    return x != 0 && y != 0 && z != 0;
}

/* Everything but RGraphicCreate; offset may be null. */
static RGraphic *load(const char *function, RRender *rc, const char *filename, const AcmeReal scale[3], bool noMcd,
                      const MeReal *offset, const float color[4], MeMatrix4Ptr matrix) {
    static const MeVector3 none = {0, 0, 0};
    if (!r_isContext(rc, function) || !r_isPointer(filename, function, "filename") ||
        !scalesAreGood(function, scale[0], scale[1], scale[2]))
        return NULL;
    RGraphic *rg = readAse(function, filename, noMcd);
    if (rg) {
        RGraphicScale(rg, scale[0], scale[1], scale[2]);
        RGraphicTranslateVertices(rc, rg, offset ? offset : none);
    }
    return r_graphicFinish(function, rc, rg, color, matrix, false);
}

RGraphic *MEAPI RGraphicLoadASE(RRender *rc, const char *filename, AcmeReal xScale, AcmeReal yScale, AcmeReal zScale,
                                const float color[4], MeMatrix4Ptr matrix) {
    return load(__func__, rc, filename, (AcmeReal[]){xScale, yScale, zScale}, false, NULL, color, matrix);
}

RGraphic *MEAPI RGraphicLoadASENoMCD(RRender *rc, const char *filename, AcmeReal xScale, AcmeReal yScale,
                                     AcmeReal zScale, const float color[4], MeMatrix4Ptr matrix) {
    return load(__func__, rc, filename, (AcmeReal[]){xScale, yScale, zScale}, true, NULL, color, matrix);
}

RGraphic *MEAPI RGraphicLoadASEwithOffset(RRender *rc, const char *filename, AcmeReal xScale, AcmeReal yScale,
                                          AcmeReal zScale, const float color[4], const MeVector3 offset,
                                          MeMatrix4Ptr matrix) {
    if (!r_isPointer(offset, __func__, "offset"))
        return NULL;
    return load(__func__, rc, filename, (AcmeReal[]){xScale, yScale, zScale}, false, offset, color, matrix);
}

RGraphic *MEAPI RGraphicLoadASEwithOffsetNoMcd(RRender *rc, const char *filename, AcmeReal xScale, AcmeReal yScale,
                                               AcmeReal zScale, const float color[4], const MeVector3 offset,
                                               MeMatrix4Ptr matrix) {
    if (!r_isPointer(offset, __func__, "offset"))
        return NULL;
    return load(__func__, rc, filename, (AcmeReal[]){xScale, yScale, zScale}, true, offset, color, matrix);
}

RGraphic *MEAPI RGraphicCreate(RRender *rc, const char *filename, AcmeReal xScale, AcmeReal yScale, AcmeReal zScale,
                               const float color[4], MeMatrix4Ptr matrix, MeBool is2D, MeBool bKeepAspectRatio) {
    if (!r_isContext(rc, __func__) || !r_isPointer(filename, __func__, "filename") ||
        !scalesAreGood(__func__, xScale, yScale, zScale))
        return NULL;
    RGraphic *rg = readAse(__func__, filename, false);
    if (rg) {
        RGraphicNormalize(rg, bKeepAspectRatio);
        RGraphicScale(rg, xScale, yScale, zScale);
    }
    return r_graphicFinish(__func__, rc, rg, color, matrix, is2D != 0);
}
