/* The triangles of simple shapes (RGeometryUtils.h). Positions on a seam are equal to the last bit, so that closed
 * shapes are closed. */
#include "r_i.h"
#include "MeInternal.h"
#include "RGeometryUtils.h"

static const AcmeReal pi = 3.14159265f;

/* A profile that is turned round the z axis: radius and height, the normal in that plane, and v. */
typedef struct {
    AcmeReal r, z, nr, nz, v;
} Ring;

/* Where the vertices go, and the directions round the axis. */
typedef struct {
    RObjectVertex *next;
    AcmeReal *c, *s; /* cos and sin; sides + 1 of them, the last equal to the first. */
    int sides;
} Lathe;

static bool between(int n, int low, int high, const char *function, const char *argument) {
    if (n >= low && n <= high)
        return true;
    MeWarning(1, "%s: %s is %d: it must be %d to %d", function, argument, n, low, high);
    return false;
}

static bool hasRoom(const RGraphic *rg, int vertices, const char *function) {
    if (vertices <= rg->m_nMaxNumVertices)
        return true;
    MeWarning(1, "%s: the graphic has room for %d vertices, the shape needs %d", function, rg->m_nMaxNumVertices,
              vertices);
    return false;
}

static bool latheBegin(Lathe *l, RGraphic *rg, int sides, int vertices) {
    const size_t n = (size_t)sides + 1;
    l->c = r_alloc(2 * n * sizeof *l->c);
    if (!l->c)
        return false;
    l->s = l->c + n;
    l->sides = sides;
    l->next = rg->m_pVertices;
    rg->m_pObject->m_nNumVertices = vertices;
    for (int i = 0; i <= sides; i++) {
        const AcmeReal angle = 2 * pi * (AcmeReal)(i % sides) / (AcmeReal)sides;
        l->c[i] = cosf(angle);
        l->s[i] = sinf(angle);
    }
    return true;
}

static void latheEnd(Lathe *l) {
    r_free(l->c);
}

static void put(Lathe *l, const Ring *ring, int side, AcmeReal turn) {
    const AcmeReal c = l->c[side], s = l->s[side];
    const AcmeReal half = pi / (AcmeReal)l->sides * turn; /* Flat sides have the normal of their middle. */
    const AcmeReal nc = turn != 0 ? c * cosf(half) - s * sinf(half) : c;
    const AcmeReal ns = turn != 0 ? s * cosf(half) + c * sinf(half) : s;
    *l->next++ = (RObjectVertex){
        ring->r * c, ring->r * s, ring->z, ring->nr * nc, ring->nr * ns, ring->nz, (AcmeReal)side / (AcmeReal)l->sides,
        ring->v};
}

/* The band from the ring below to the ring above, seen from outside; a ring of radius 0 is a point. */
static void band(Lathe *l, const Ring *below, const Ring *above, bool flat) {
    const AcmeReal a = flat ? 1 : 0, b = flat ? -1 : 0;
    for (int i = 0; i < l->sides; i++) {
        if (below->r > 0) {
            put(l, below, i, a);
            put(l, below, i + 1, b);
            put(l, above, i + 1, b);
        }
        if (above->r > 0) {
            put(l, below, i, a);
            put(l, above, i + 1, b);
            put(l, above, i, a);
        }
    }
}

/* A disc at the ring, facing up or down. */
static void disc(Lathe *l, AcmeReal radius, AcmeReal z, bool up) {
    const Ring edge = {radius, z, 0, up ? 1.0f : -1.0f, 1}, middle = {0, z, 0, edge.nz, 0};
    for (int i = 0; i < l->sides; i++) {
        put(l, &middle, i, 0);
        put(l, &edge, up ? i : i + 1, 0);
        put(l, &edge, up ? i + 1 : i, 0);
    }
}

void MEAPI RSetVertex(RObjectVertex *vertex, const MeVector3 vert, const MeVector3 norm, MeReal u, MeReal v) {
    if (!r_isPointer(vertex, __func__, "vertex") || !r_isPointer(vert, __func__, "vert") ||
        !r_isPointer(norm, __func__, "norm"))
        return;
    *vertex = (RObjectVertex){(AcmeReal)vert[0], (AcmeReal)vert[1], (AcmeReal)vert[2], (AcmeReal)norm[0],
                              (AcmeReal)norm[1], (AcmeReal)norm[2], (AcmeReal)u,       (AcmeReal)v};
}

int MEAPI RCalculateBoxVertexCount(void) {
    return 36;
}

void MEAPI RCalculateBoxGeometry(RGraphic *rg, AcmeReal lx, AcmeReal ly, AcmeReal lz) {
    static const AcmeReal corners[6][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}};
    const AcmeReal half[3] = {lx / 2, ly / 2, lz / 2};
    if (!r_isGraphic(rg, __func__) || !hasRoom(rg, 36, __func__) || !r_isSize(lx, __func__, "lx") ||
        !r_isSize(ly, __func__, "ly") || !r_isSize(lz, __func__, "lz"))
        return;
    RObjectVertex *to = rg->m_pVertices;
    for (int face = 0; face < 6; face++) {
        const int axis = face / 2, a = (axis + 1) % 3, b = (axis + 2) % 3;
        const AcmeReal sign = face % 2 ? -1.0f : 1.0f;
        for (int i = 0; i < 6; i++) {
            AcmeReal p[3], n[3] = {0, 0, 0};
            p[axis] = sign * half[axis];
            p[a] = sign * corners[i][0] * half[a]; /* Mirrored with the face, so it stays anticlockwise. */
            p[b] = corners[i][1] * half[b];
            n[axis] = sign;
            *to++ = (RObjectVertex){
                p[0], p[1], p[2], n[0], n[1], n[2], 0.5f + 0.5f * corners[i][0], 0.5f - 0.5f * corners[i][1]};
        }
    }
    rg->m_pObject->m_nNumVertices = 36;
}

int MEAPI RCalculateSphereVertexCount(int sides, int rings) {
    if (!between(sides, 3, 1024, __func__, "sides") || !between(rings, 2, 1024, __func__, "rings"))
        return 0;
    return 6 * sides * (rings - 1);
}

/* Ring i of a sphere whose upper and lower half are `height` apart, from the lower pole up. */
static Ring sphereRing(AcmeReal radius, AcmeReal height, int i, int rings) {
    const AcmeReal angle = pi * ((AcmeReal)i / (AcmeReal)rings - 0.5f);
    const bool pole = i == 0 || i == rings;
    const AcmeReal nr = pole ? 0 : cosf(angle), nz = pole ? (i ? 1.0f : -1.0f) : sinf(angle);
    const AcmeReal shift = 2 * i < rings ? -height / 2 : height / 2;
    return (Ring){radius * nr, radius * nz + shift, nr, nz, 1 - (AcmeReal)i / (AcmeReal)rings};
}

void MEAPI RCalculateSphereGeometry(RGraphic *rg, AcmeReal radius, int sides, int rings) {
    Lathe l;
    int vertices;
    ME_UNDER_OWN_NAME(vertices = RCalculateSphereVertexCount(sides, rings));
    if (vertices == 0 || !r_isGraphic(rg, __func__) || !hasRoom(rg, vertices, __func__) ||
        !r_isSize(radius, __func__, "radius") || !latheBegin(&l, rg, sides, vertices))
        return;
    for (int i = 0; i < rings; i++) {
        const Ring below = sphereRing(radius, 0, i, rings), above = sphereRing(radius, 0, i + 1, rings);
        band(&l, &below, &above, false);
    }
    latheEnd(&l);
}

int MEAPI RCalculateSphylVertexCount(int sides, int rings) {
    if (!between(sides, 3, 1024, __func__, "sides") || !between(rings, 2, 1024, __func__, "rings"))
        return 0;
    if (rings % 2) {
        MeWarning(1, "%s: rings is %d: it must be even", __func__, rings);
        return 0;
    }
    return 6 * sides * rings;
}

void MEAPI RCalculateSphylGeometry(RGraphic *rg, AcmeReal radius, AcmeReal height, int sides, int rings) {
    Lathe l;
    int vertices;
    ME_UNDER_OWN_NAME(vertices = RCalculateSphylVertexCount(sides, rings));
    if (vertices == 0 || !r_isGraphic(rg, __func__) || !hasRoom(rg, vertices, __func__) ||
        !r_isSize(radius, __func__, "radius") || !r_isSize(height, __func__, "height") ||
        !latheBegin(&l, rg, sides, vertices))
        return;
    for (int i = 0; i < rings; i++) {
        const Ring below = sphereRing(radius, height, i, rings), above = sphereRing(radius, height, i + 1, rings);
        const Ring foot = {radius, -height / 2, 1, 0, 0.5f}, head = {radius, height / 2, 1, 0, 0.5f};
        band(&l, &below, 2 * (i + 1) == rings ? &foot : &above, false);
        if (2 * (i + 1) == rings)
            band(&l, &foot, &head, false);
    }
    latheEnd(&l);
}

int MEAPI RCalculateFrustumVertexCount(int sides) {
    return between(sides, 3, 1024, __func__, "sides") ? 12 * sides : 0;
}

/* Flat or smooth sides, and a disc at each end that is not a point. */
static void frustum(Lathe *l, AcmeReal bottomRadius, AcmeReal topRadius, AcmeReal bottom, AcmeReal top) {
    const AcmeReal nr = top - bottom, nz = bottomRadius - topRadius, length = hypotf(nr, nz);
    const Ring below = {bottomRadius, bottom, nr / length, nz / length, 1};
    const Ring above = {topRadius, top, nr / length, nz / length, 0};
    /* At an apex there is no one normal: the one of each triangle's middle looks best. */
    const bool flat = l->sides <= 12;
    if (flat || (bottomRadius > 0 && topRadius > 0)) {
        band(l, &below, &above, flat);
    } else {
        RObjectVertex *first = l->next;
        band(l, &below, &above, false);
        for (int i = 0; i < l->sides; i++, first += 3) {
            RObjectVertex *apex = topRadius > 0 ? &first[0] : &first[2];
            const RObjectVertex *p = topRadius > 0 ? &first[1] : &first[0], *q = topRadius > 0 ? &first[2] : &first[1];
            const AcmeReal x = p->m_NX + q->m_NX, y = p->m_NY + q->m_NY;
            const AcmeReal scale = below.nr / hypotf(x, y);
            apex->m_NX = x * scale;
            apex->m_NY = y * scale;
        }
    }
    if (bottomRadius > 0)
        disc(l, bottomRadius, bottom, false);
    if (topRadius > 0)
        disc(l, topRadius, top, true);
}

static void frustumGeometry(const char *function, RGraphic *rg, AcmeReal bottomRadius, AcmeReal topRadius,
                            AcmeReal bottom, AcmeReal top, int sides) {
    Lathe l;
    const bool pointed = bottomRadius == 0 || topRadius == 0;
    const int vertices = (pointed ? 6 : 12) * sides;
    if (!(bottomRadius >= 0 && topRadius >= 0 && bottomRadius + topRadius > 0 && isfinite(bottomRadius + topRadius))) {
        MeWarning(1, "%s: the radii are %g and %g: they must not be negative, and not both 0", function,
                  (double)bottomRadius, (double)topRadius);
        return;
    }
    if (!r_isSize(top - bottom, function, "the height") || !hasRoom(rg, vertices, function) ||
        !latheBegin(&l, rg, sides, vertices))
        return;
    frustum(&l, bottomRadius, topRadius, bottom, top);
    latheEnd(&l);
}

void MEAPI RCalculateFrustumGeometry(RGraphic *rg, AcmeReal bottomRadius, AcmeReal topRadius, AcmeReal bottom,
                                     AcmeReal top, int sides) {
    if (r_isGraphic(rg, __func__) && between(sides, 3, 1024, __func__, "sides"))
        frustumGeometry(__func__, rg, bottomRadius, topRadius, bottom, top, sides);
}

int MEAPI RCalculateConeVertexCount(int sides) {
    return between(sides, 3, 1024, __func__, "sides") ? 6 * sides : 0;
}

void MEAPI RCalculateConeGeometry(RGraphic *rg, AcmeReal radius, AcmeReal bottom, AcmeReal top, int sides) {
    if (r_isGraphic(rg, __func__) && between(sides, 3, 1024, __func__, "sides"))
        frustumGeometry(__func__, rg, radius, 0, bottom, top, sides);
}

int MEAPI RCalculateTorusVertexCount(int sides, int rings) {
    if (!between(sides, 3, 1024, __func__, "sides") || !between(rings, 3, 1024, __func__, "rings"))
        return 0;
    return 6 * sides * rings;
}

static Ring torusRing(AcmeReal middle, AcmeReal tube, int i, int rings) {
    const AcmeReal angle = 2 * pi * (AcmeReal)(i % rings) / (AcmeReal)rings;
    return (Ring){middle + tube * cosf(angle), tube * sinf(angle), cosf(angle), sinf(angle),
                  1 - (AcmeReal)i / (AcmeReal)rings};
}

void MEAPI RCalculateTorusGeometry(RGraphic *rg, AcmeReal outerRadius, AcmeReal innerRadius, int sides, int rings) {
    Lathe l;
    int vertices;
    ME_UNDER_OWN_NAME(vertices = RCalculateTorusVertexCount(sides, rings));
    if (vertices == 0 || !r_isGraphic(rg, __func__) || !hasRoom(rg, vertices, __func__) ||
        !r_isSize(innerRadius, __func__, "innerRadius") ||
        !r_isSize(outerRadius - innerRadius, __func__, "outerRadius - innerRadius") ||
        !latheBegin(&l, rg, sides, vertices))
        return;
    const AcmeReal middle = (outerRadius + innerRadius) / 2, tube = (outerRadius - innerRadius) / 2;
    for (int i = 0; i < rings; i++) {
        const Ring below = torusRing(middle, tube, i, rings), above = torusRing(middle, tube, i + 1, rings);
        band(&l, &below, &above, false);
    }
    latheEnd(&l);
}

int MEAPI RCalculateDomeVertexCount(int sides, int rings) {
    if (!between(sides, 3, 1024, __func__, "sides") || !between(rings, 2, 1024, __func__, "rings"))
        return 0;
    return 3 * sides * (2 * rings - 1);
}

/* Turned round z like the others, then laid so that z becomes y; and inside out. */
void MEAPI RCalculateDomeGeometry(RGraphic *rg, AcmeReal radius, int sides, int rings, int tileU, int tileV) {
    Lathe l;
    int vertices;
    ME_UNDER_OWN_NAME(vertices = RCalculateDomeVertexCount(sides, rings));
    if (vertices == 0 || !r_isGraphic(rg, __func__) || !hasRoom(rg, vertices, __func__) ||
        !r_isSize(radius, __func__, "radius") || !between(tileU, 1, 1024, __func__, "tileU") ||
        !between(tileV, 1, 1024, __func__, "tileV") || !latheBegin(&l, rg, sides, vertices))
        return;
    for (int i = 0; i < rings; i++) {
        const Ring below = sphereRing(radius, 0, rings + i, 2 * rings);
        const Ring above = sphereRing(radius, 0, rings + i + 1, 2 * rings);
        band(&l, &below, &above, false);
    }
    for (RObjectVertex *v = rg->m_pVertices; v < l.next; v++)
        *v = (RObjectVertex){v->m_X,
                             v->m_Z,
                             v->m_Y,
                             -v->m_NX,
                             -v->m_NZ,
                             -v->m_NY,
                             v->m_U * (AcmeReal)tileU,
                             v->m_V * 2 * (AcmeReal)tileV};
    latheEnd(&l);
}
