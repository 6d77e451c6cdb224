/* Meshes on the graphics card. Graphics may be changed at any time, so in every frame each one's vertices are hashed
 * and the hash finds the mesh: unchanged ones, and equal ones (all spheres of one size), cost nothing more. */
#include "r_draw_i.h"

#include <stdlib.h>
#include <string.h>

/* ---- Numbering equal things ---- */

typedef struct {
    size_t size;     /* Of one thing, bytes: a multiple of 4. */
    uint8_t *things; /* The different ones, in the order in which they came. */
    uint32_t count;
    uint32_t *slots; /* Number + 1; 0 is free. */
    size_t mask;
} Numbering;

static bool numberingBegin(Numbering *n, size_t size, size_t max) {
    size_t slots = 16;
    while (slots < 2 * max)
        slots *= 2;
    *n = (Numbering){.size = size, .mask = slots - 1};
    n->things = r_alloc(size * max);
    n->slots = r_alloc(slots * sizeof *n->slots);
    return n->things && n->slots;
}

static void numberingEnd(Numbering *n) {
    r_free(n->things);
    r_free(n->slots);
}

static uint64_t hashThing(const void *thing, size_t size) {
    uint64_t hash = size;
    for (size_t i = 0; i < size; i += sizeof(uint32_t)) {
        uint32_t word;
        memcpy(&word, (const char *)thing + i, sizeof word);
        hash = r_hashWord(hash, word);
    }
    return hash;
}

static uint32_t numberOf(Numbering *n, const void *thing) {
    size_t slot = (size_t)hashThing(thing, n->size) & n->mask;
    for (; n->slots[slot]; slot = (slot + 1) & n->mask) {
        const uint32_t number = n->slots[slot] - 1;
        if (memcmp(n->things + n->size * number, thing, n->size) == 0)
            return number;
    }
    memcpy(n->things + n->size * n->count, thing, n->size);
    n->slots[slot] = ++n->count;
    return n->count - 1;
}

/* ---- Geometry ---- */

/* A vertex's place; -0 is 0, so that equal places have equal bits. */
static void placeOf(const RObjectVertex *v, float place[3]) {
    place[0] = v->m_X + 0.0f;
    place[1] = v->m_Y + 0.0f;
    place[2] = v->m_Z + 0.0f;
}

/* The cross product of two sides: the triangle's normal, times twice its area. */
static void faceNormal(const RObjectVertex *t, float n[3]) {
    float a[3], b[3], c[3];
    placeOf(&t[0], a);
    placeOf(&t[1], b);
    placeOf(&t[2], c);
    for (int k = 0; k < 3; k++) {
        b[k] -= a[k];
        c[k] -= a[k];
    }
    n[0] = b[1] * c[2] - b[2] * c[1];
    n[1] = b[2] * c[0] - b[0] * c[2];
    n[2] = b[0] * c[1] - b[1] * c[0];
}

static void findBounds(RMesh *mesh, const RObjectVertex *v, int count) {
    float low[3], high[3], square = 0;
    for (int k = 0; k < 3; k++) {
        low[k] = INFINITY;
        high[k] = -INFINITY;
    }
    mesh->finite = true;
    for (int i = 0; i < count; i++) {
        float p[3];
        placeOf(&v[i], p);
        for (int k = 0; k < 3; k++) {
            low[k] = fminf(low[k], p[k]);
            high[k] = fmaxf(high[k], p[k]);
            mesh->finite &= isfinite(p[k]) != 0;
        }
    }
    for (int k = 0; k < 3; k++)
        mesh->centre[k] = 0.5f * (low[k] + high[k]);
    for (int i = 0; i < count; i++) {
        float p[3], sum = 0;
        placeOf(&v[i], p);
        for (int k = 0; k < 3; k++)
            sum += (p[k] - mesh->centre[k]) * (p[k] - mesh->centre[k]);
        square = fmaxf(square, sum);
    }
    mesh->radius = sqrtf(square);
}

/* Whether the triangles turn the way their normals say, all of them. */
static bool facesAgree(const RObjectVertex *v, int count) {
    for (int i = 0; i < count; i += 3) {
        float n[3], sum = 0;
        faceNormal(&v[i], n);
        for (int k = 0; k < 3; k++)
            sum += n[0] * v[i + k].m_NX + n[1] * v[i + k].m_NY + n[2] * v[i + k].m_NZ;
        if (sum < 0)
            return false;
    }
    return true;
}

/* A surface is closed when every edge is passed as often one way as the other. Each edge gets a random number, which
 * is added one way and subtracted the other: the sum is 0 for a closed surface and, but for 1 in 2^64, only then. */
static bool isClosed(Numbering *places, const RObjectVertex *v, int count) {
    uint64_t sum = 0;
    for (int i = 0; i < count; i += 3) {
        uint64_t at[3];
        for (int k = 0; k < 3; k++) {
            float p[3];
            placeOf(&v[i + k], p);
            at[k] = numberOf(places, p);
        }
        for (int k = 0; k < 3; k++) {
            const uint64_t a = at[k], b = at[(k + 1) % 3];
            sum += r_hashWord(r_hashWord(7, a), b);
            sum -= r_hashWord(r_hashWord(7, b), a);
        }
    }
    return sum == 0;
}

/* ---- Making a mesh ---- */

static void describeVertex(const RGL *gl) {
    static const GLint sizes[3] = {3, 3, 2};
    static const size_t offsets[3] = {offsetof(RObjectVertex, m_X), offsetof(RObjectVertex, m_NX),
                                      offsetof(RObjectVertex, m_U)};
    for (GLuint i = 0; i < 3; i++) {
        gl->EnableVertexAttribArray(i);
        gl->VertexAttribPointer(i, sizes[i], GL_FLOAT, GL_FALSE, sizeof(RObjectVertex), (const void *)offsets[i]);
    }
}

static void upload(const RGL *gl, RMesh *mesh, const Numbering *vertices, const uint32_t *indices) {
    gl->GenVertexArrays(1, &mesh->array);
    gl->GenBuffers(1, &mesh->vertices);
    gl->GenBuffers(1, &mesh->indices);
    gl->BindVertexArray(mesh->array);
    gl->BindBuffer(GL_ARRAY_BUFFER, mesh->vertices);
    gl->BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(vertices->count * vertices->size), vertices->things, GL_STATIC_DRAW);
    describeVertex(gl);
    gl->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh->indices);
    gl->BufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)((size_t)mesh->indexCount * sizeof *indices), indices,
                   GL_STATIC_DRAW);
    for (GLuint i = 3; i < 10; i++) {
        gl->EnableVertexAttribArray(i);
        gl->VertexAttribDivisor(i, 1);
    }
    gl->BindVertexArray(0);
}

static bool build(const RGL *gl, RMesh *mesh, const RObjectVertex *v, int count) {
    Numbering vertices, places;
    uint32_t *indices = r_alloc((size_t)count * sizeof *indices);
    const bool hasVertices = numberingBegin(&vertices, sizeof(RObjectVertex), (size_t)count);
    const bool hasPlaces = numberingBegin(&places, 3 * sizeof(float), (size_t)count);
    const bool good = indices && hasVertices && hasPlaces;
    if (good) {
        for (int i = 0; i < count; i++)
            indices[i] = numberOf(&vertices, &v[i]);
        mesh->indexCount = count;
        findBounds(mesh, v, count);
        mesh->closed = facesAgree(v, count) && isClosed(&places, v, count);
        MEASSERT(places.count <= vertices.count && vertices.count <= (uint32_t)count);
        upload(gl, mesh, &vertices, indices);
    }
    numberingEnd(&vertices);
    numberingEnd(&places);
    r_free(indices);
    return good;
}

/* ---- Finding a mesh ---- */

/* Where a mesh was found last is looked at first. */
RMesh *r_meshFind(RDraw *d, const uint64_t hash[2], int vertexCount, struct RGraphicPart *part) {
    for (size_t i = 0; i < d->meshes.count; i++) {
        const size_t at = (i + part->meshGuess) % d->meshes.count;
        RMesh *m = d->meshes.items[at];
        if (m->hash[0] == hash[0] && m->hash[1] == hash[1] && m->vertexCount == vertexCount) {
            part->meshGuess = at;
            m->lastFrame = d->frame;
            return m;
        }
    }
    return NULL;
}

RMesh *r_meshAdd(RDraw *d, const uint64_t hash[2], int vertexCount, const RObjectVertex *vertices, int count) {
    RMesh *m = r_grow(d->meshes, 1) ? r_alloc(sizeof *m) : NULL;
    if (!m)
        return NULL;
    *m = (RMesh){
        .hash = {hash[0], hash[1]}, .vertexCount = vertexCount, .lastFrame = d->frame, .number = d->meshesMade++};
    if (!build(&d->gl, m, vertices, count)) {
        r_free(m);
        return NULL;
    }
    d->meshes.items[d->meshes.count++] = m;
    return m;
}

RMesh *r_meshOf(RDraw *d, RGraphic *rg) {
    const int count = rg->m_pObject->m_nNumVertices;
    uint64_t hash[2];
    r_hashVertices(rg->m_pVertices, count, hash);
    RMesh *m = r_meshFind(d, hash, count, rg->m_pPart);
    return m ? m : r_meshAdd(d, hash, count, rg->m_pVertices, count);
}

/* ---- Edges, for wireframes ---- */

typedef struct {
    uint32_t low, high; /* Places. */
    float normal[3];
} Side;

static int compareSides(const void *a, const void *b) {
    const Side *p = a, *q = b;
    if (p->low != q->low)
        return p->low < q->low ? -1 : 1;
    return p->high < q->high ? -1 : p->high > q->high;
}

static bool sameDirection(const float a[3], const float b[3]) {
    const float ab = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    const float aa = a[0] * a[0] + a[1] * a[1] + a[2] * a[2], bb = b[0] * b[0] + b[1] * b[1] + b[2] * b[2];
    return ab > 0.9999f * sqrtf(aa * bb);
}

static void listSides(Side *sides, Numbering *places, const RObjectVertex *v, int count) {
    for (int i = 0; i < count; i++) {
        const int next = i % 3 == 2 ? i - 2 : i + 1;
        float p[3], q[3];
        placeOf(&v[i], p);
        placeOf(&v[next], q);
        const uint32_t a = numberOf(places, p), b = numberOf(places, q);
        sides[i] = (Side){.low = a < b ? a : b, .high = a < b ? b : a};
        faceNormal(&v[i - i % 3], sides[i].normal);
    }
}

/* Every edge once; the diagonals inside flat faces are left out. */
bool r_meshEdges(RMesh *mesh, const RGraphic *rg) {
    const int count = mesh->vertexCount;
    if (mesh->edges)
        return true;
    Numbering places;
    Side *sides = r_alloc((size_t)count * sizeof *sides);
    mesh->edges = r_alloc((size_t)count * sizeof *mesh->edges);
    const bool good = numberingBegin(&places, 3 * sizeof(float), (size_t)count) && sides && mesh->edges;
    if (good) {
        listSides(sides, &places, rg->m_pVertices, count);
        qsort(sides, (size_t)count, sizeof *sides, compareSides);
        for (int i = 0; i < count;) {
            int n = 1;
            while (i + n < count && compareSides(&sides[i], &sides[i + n]) == 0)
                n++;
            if (sides[i].low != sides[i].high && !(n == 2 && sameDirection(sides[i].normal, sides[i + 1].normal))) {
                REdge *e = &mesh->edges[mesh->edgeCount++];
                memcpy(e->a, places.things + places.size * sides[i].low, sizeof e->a);
                memcpy(e->b, places.things + places.size * sides[i].high, sizeof e->b);
            }
            i += n;
        }
    }
    numberingEnd(&places);
    r_free(sides);
    return good;
}

/* ---- Forgetting ---- */

static void freeMesh(const RGL *gl, RMesh *m, bool current) {
    if (current) {
        gl->DeleteVertexArrays(1, &m->array);
        gl->DeleteBuffers(1, &m->vertices);
        gl->DeleteBuffers(1, &m->indices);
    }
    r_free(m->edges);
    r_free(m);
}

void r_meshesTrim(RDraw *d) {
    enum { FRAMES = 60 };
    size_t kept = 0;
    for (size_t i = 0; i < d->meshes.count; i++) {
        RMesh *m = d->meshes.items[i];
        if (d->frame - m->lastFrame > FRAMES)
            freeMesh(&d->gl, m, true);
        else
            d->meshes.items[kept++] = m;
    }
    d->meshes.count = kept;
}

void r_meshesFree(RDraw *d, bool current) {
    for (size_t i = 0; i < d->meshes.count; i++)
        freeMesh(&d->gl, d->meshes.items[i], current);
    r_free(d->meshes.items);
}
