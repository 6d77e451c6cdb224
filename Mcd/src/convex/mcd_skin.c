/* Places where two shapes may touch that tilt: the corners of either over or under the other, and the crossings of
 * their edges, seen along the normal.
 *
 * The gap between two convex shapes is a convex function in the contact plane, and stays one while a tilt adds an
 * affine function: its least value is always at one of these places. Of polyhedra those count that the tilt may bring
 * down (mcd_cap.c), of discs points of the rim, of other shapes the face. */
#include "convex/mcd_face_i.h"

enum { EDGES = 96, RIM_POINTS = 32 };

/* The side of a shape that is toward the other one. */
typedef struct Skin {
    const McdShape *shape;
    const McdOutline *face;
    MeBool isA;
    int corners, edges;
    double centre[3], radius;          /* of a disc; else 0 */
    McdCap cap;                        /* of a polyhedron */
    double corner[MCD_FACE_POINTS][3]; /* along the view's axes */
    double edge[EDGES][2][3];
    MeU32 cornerCode[MCD_FACE_POINTS], edgeCode[EDGES];
} Skin;

static void toView(const McdView *v, const double point[3], double out[3]) {
    mcd_set(out, mcd_dot(v->u, point), mcd_dot(v->w, point), mcd_dot(v->n, point));
}

static void setCap(const McdView *v, double tilt, Skin *s) {
    double direction[3];
    mcd_scale(direction, v->n, s->isA ? -1 : 1);
    s->corners = mcd_capToward(s->shape, direction, tilt, &s->cap);
    s->edges = 0;
    for (int i = 0; i < s->corners; i++) {
        toView(v, s->cap.point[i], s->corner[i]);
        s->cornerCode[i] = mcd_featureCode(SUPPORT, (MeU32)s->cap.corner[i], CAP_NAME);
    }
}

static void addCapEdges(const McdView *v, Skin *s) {
    int edge[EDGES][3];
    s->edges = mcd_capEdges(s->shape, &s->cap, edge, EDGES);
    for (int i = 0; i < s->edges; i++) {
        for (int k = 0; k < 2; k++) {
            double point[3];
            mcd_cornerAt(s->shape, edge[i][k], point);
            toView(v, point, s->edge[i][k]);
        }
        s->edgeCode[i] = mcd_featureCode(EDGE, (MeU32)edge[i][2], CAP_NAME);
    }
}

static void setFace(Skin *s) {
    const McdOutline *o = s->face;
    s->corners = o->count;
    s->edges = o->count > 2 ? o->count : o->count - 1;
    for (int i = 0; i < o->count; i++) {
        mcd_set(s->corner[i], o->x[i], o->y[i], o->z[i]);
        s->cornerCode[i] = mcd_featureCode(CORNER, o->id, o->name[i]);
    }
    for (int i = 0; i < s->edges; i++) {
        mcd_copy(s->edge[i][0], s->corner[i]);
        mcd_copy(s->edge[i][1], s->corner[i + 1 < o->count ? i + 1 : 0]);
        s->edgeCode[i] = mcd_featureCode(EDGE, o->id, o->name[i]);
    }
}

/* Adds points of a rim, from the one that is nearest to the other shape on: a tilt may bring down any of it. */
static void addRim(const McdView *v, int end, Skin *s) {
    static const double cosine = .98078528040323044, sine = .19509032201612827; /* of a sixteenth of pi */
    const McdShape *d = s->shape;
    double out[3], side[3], centre[3];
    mcd_mad(centre, d->place, (end ? d->size[2] : 0) - d->low, d->axis[2]);
    mcd_mad(out, v->n, -mcd_dot(v->n, d->axis[2]), d->axis[2]);
    const double length = mcd_length(out);
    const MeBool isTilted = length > 1e-6; /* beyond rounding */
    mcd_scale(out, isTilted ? out : d->axis[0], isTilted ? (s->isA ? -1 : 1) / length : 1);
    mcd_cross(side, d->axis[2], out);
    for (int i = 0; i < (d->size[end] > 0 ? RIM_POINTS : 1); i++) {
        double point[3], next[3];
        mcd_mad(point, centre, d->size[end], out);
        toView(v, point, s->corner[s->corners]);
        s->cornerCode[s->corners++] = mcd_featureCode(EDGE, (MeU32)(end * RIM_POINTS + i), CAP_NAME);
        mcd_scale(next, out, cosine);
        mcd_mad(next, next, sine, side);
        mcd_scale(side, side, cosine);
        mcd_mad(side, side, -sine, out);
        mcd_copy(out, next);
    }
}

/* The rims of a solid of revolution: of the disc that is its face, or both of one that touches with its side. */
static void setRims(const McdView *v, Skin *s) {
    const McdShape *d = s->shape;
    const int face = (int)s->face->id;
    s->corners = 0;
    for (int end = 0; end < 2; end++)
        if (end == face || !s->face->isDisc)
            addRim(v, end, s);
    if (!s->face->isDisc)
        return;
    mcd_mad(s->centre, d->place, (face ? d->size[2] : 0) - d->low, d->axis[2]);
    s->radius = d->size[face];
}

static MeBool isDisc(const Skin *s) {
    return s->radius > 0;
}

static void setSkin(const McdShape *shape, const McdOutline *face, MeBool isA, const McdView *v, double tilt, Skin *s) {
    s->shape = shape;
    s->face = face;
    s->isA = isA;
    s->radius = 0;
    if (mcd_isPolyhedron(shape)) {
        setCap(v, tilt, s);
        return;
    }
    setFace(s);
    if (mcd_isTurned(shape))
        setRims(v, s);
}

/* ---- heights ----------------------------------------------------------------------------------------------------- */

/* Whether a point in the contact plane is inside of a polygon, or at its border. */
static MeBool isWithin(const McdOutline *o, double x, double y, double slack) {
    for (int i = 0; i < o->count; i++) {
        const int next = i + 1 < o->count ? i + 1 : 0;
        const double ex = o->x[next] - o->x[i], ey = o->y[next] - o->y[i];
        if (ex * (y - o->y[i]) - ey * (x - o->x[i]) < -slack * hypot(ex, ey))
            return MEFALSE;
    }
    return o->count > 2;
}

/* The height of a face at a place; false: it is beside the face, or at its border. */
static MeBool heightOfFace(const Skin *s, const McdView *v, double x, double y, double *height) {
    double point[3];
    *height = s->face->count > 2 ? mcd_planeHeight(s->face, x, y) : 0;
    if (!isDisc(s))
        return isWithin(s->face, x, y, v->slack);
    for (int i = 0; i < 3; i++)
        point[i] = x * v->u[i] + y * v->w[i] + *height * v->n[i];
    return mcd_distanceSquared(point, s->centre) <= (s->radius + v->slack) * (s->radius + v->slack);
}

/* The height of the skin at a place; false: it is beside the shape. */
static MeBool heightAt(const Skin *s, const McdView *v, double x, double y, double *height) {
    double point[3], low, high;
    if (!mcd_isPolyhedron(s->shape))
        return heightOfFace(s, v, x, y, height);
    for (int i = 0; i < 3; i++)
        point[i] = x * v->u[i] + y * v->w[i];
    const MeBool isIn = mcd_spanAlong(s->shape, point, v->n, v->slack, &low, &high);
    *height = s->isA ? low : high;
    return isIn;
}

/* ---- places ------------------------------------------------------------------------------------------------------ */

typedef struct Places {
    McdCandidate *at;
    int count;
    double margin; /* m: of the cores */
} Places;

/* Whether the faces have that place in common already. */
static MeBool isKnown(const Places *p, MeU64 feature) {
    for (int i = 0; i < p->count; i++)
        if (p->at[i].feature == feature)
            return METRUE;
    return MEFALSE;
}

static void addPlace(Places *p, double x, double y, double a, double b, MeU32 codeA, MeU32 codeB) {
    const MeU64 feature = mcd_featureOfPair(codeA, codeB);
    if (p->count < MCD_CANDIDATES && a - b <= p->margin && !isKnown(p, feature))
        p->at[p->count++] = (McdCandidate){.x = x, .y = y, .a = a, .b = b, .feature = feature};
}

/* Adds the corners of one shape over or under the other one. */
static void addCorners(const Skin *s, const Skin *onto, const McdView *v, Places *p) {
    const MeU32 inside = mcd_featureCode(INSIDE, onto->face->id, 0);
    for (int i = 0; i < s->corners; i++) {
        const double *c = s->corner[i];
        double height;
        if (!heightAt(onto, v, c[0], c[1], &height))
            continue;
        if (s->isA)
            addPlace(p, c[0], c[1], c[2], height, s->cornerCode[i], inside);
        else
            addPlace(p, c[0], c[1], height, c[2], inside, s->cornerCode[i]);
    }
}

/* Where two edges cross, as shares of both; false: they do not. */
static MeBool crossing(double (*const a)[3], double (*const b)[3], double *s, double *t) {
    const double ax = a[1][0] - a[0][0], ay = a[1][1] - a[0][1], bx = b[1][0] - b[0][0], by = b[1][1] - b[0][1];
    const double x = b[0][0] - a[0][0], y = b[0][1] - a[0][1], area = ax * by - ay * bx;
    const double onA = x * by - y * bx, onB = x * ay - y * ax, size = fabs(area);
    if (!(onA * area > 0 && onB * area > 0 && fabs(onA) < size && fabs(onB) < size))
        return MEFALSE;
    *s = onA / area;
    *t = onB / area;
    return METRUE;
}

static void addCrossings(Skin *a, Skin *b, Places *p) {
    for (int i = 0; i < a->edges; i++)
        for (int k = 0; k < b->edges; k++) {
            double(*const e)[3] = a->edge[i], (*const f)[3] = b->edge[k], s, t;
            if (MeMIN(e[0][2], e[1][2]) - MeMAX(f[0][2], f[1][2]) > p->margin || !crossing(e, f, &s, &t))
                continue;
            addPlace(p, e[0][0] + s * (e[1][0] - e[0][0]), e[0][1] + s * (e[1][1] - e[0][1]),
                     e[0][2] + s * (e[1][2] - e[0][2]), f[0][2] + t * (f[1][2] - f[0][2]), a->edgeCode[i],
                     b->edgeCode[k]);
        }
}

/* ---- choice ------------------------------------------------------------------------------------------------------ */

static void siteOf(const McdCandidate *c, const McdView *v, double rounding, McdSite *s) {
    const double height[2] = {c->a, c->b};
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 3; i++)
            s->on[k][i] = c->x * v->u[i] + c->y * v->w[i] + height[k] * v->n[i];
    s->separation = c->a - c->b - rounding;
}

/* The highest point of b toward a, or the lowest of a, along the normal. */
static double heightOf(const Skin *s, const McdView *v) {
    double point[3], direction[3], extreme = -INFINITY;
    const double side = s->isA ? -1 : 1;
    if (mcd_isPolyhedron(s->shape)) {
        mcd_scale(direction, v->n, side);
        mcd_coreSupport(s->shape, direction, point);
        return mcd_dot(point, v->n);
    }
    for (int i = 0; i < s->face->count; i++)
        extreme = fmax(extreme, side * s->face->z[i]);
    return side * extreme;
}

/* Whether no corner of a polyhedron will come down as far as the other shape reaches: then nothing of it will. Saves
 * 11 % of all instructions of hulls that land. */
static MeBool staysAbove(const McdLanding *l, const Skin *s, const Skin *other, const McdView *v, double rounding,
                         const McdSite *site, int count) {
    const double height = heightOf(other, v), side = s->isA ? 1 : -1;
    for (int i = 0; i < s->corners; i++) {
        McdSite further;
        mcd_copy(further.on[!s->isA], s->cap.point[i]);
        mcd_mad(further.on[s->isA], s->cap.point[i], height - s->corner[i][2], v->n);
        further.separation = side * (s->corner[i][2] - height) - rounding;
        if (mcd_landingMayNeed(l, &further, site, count))
            return MEFALSE;
    }
    return METRUE;
}

/* Chooses of sites at all candidates, beside the chosen ones. Returns the number of chosen ones. */
static int chooseOf(McdLanding *l, const McdView *v, double rounding, const McdCandidate *all, int count,
                    McdCandidate *chosen, int chosenCount, McdSite *site) {
    int kept[MCD_MANIFOLD_POINTS] = {0};
    for (int i = 0; i < count; i++) {
        siteOf(&all[i], v, rounding, &site[i]);
        for (int k = 0; k < chosenCount; k++)
            kept[k] = all[i].feature == chosen[k].feature ? i : kept[k];
    }
    const int keptCount = mcd_landingChoose(l, site, count, MCD_MANIFOLD_POINTS, chosenCount, kept);
    for (int k = chosenCount; k < keptCount; k++)
        chosen[k] = all[kept[k]];
    return keptCount;
}

int mcd_addLanding(const McdShape *a, const McdShape *b, const McdOutline *outA, const McdOutline *outB,
                   const McdView *v, McdReach reach, McdCandidate *all, int count, McdCandidate *chosen,
                   int chosenCount) {
    McdForecast forecast;
    McdLanding landing;
    McdSite site[MCD_CANDIDATES];
    Skin skin[2];
    const double rounding = a->rounding + b->rounding;
    const MeBool mayStay = !mcd_isTurned(a) && !mcd_isTurned(b);
    Places places = {all, count, reach.margin + rounding};
    if (!mcd_landingForecast(reach, &forecast) || !mcd_landingBegin(&landing, &forecast, a, b, v->n))
        return chosenCount;
    const double tilt = mcd_landingTilt(&forecast, v->n, mcd_pairSize(a, b));
    setSkin(a, outA, METRUE, v, tilt, &skin[0]);
    setSkin(b, outB, MEFALSE, v, tilt, &skin[1]);
    chosenCount = chooseOf(&landing, v, rounding, all, count, chosen, chosenCount, site);
    for (int k = 0; k < 2 && mayStay; k++)
        if (mcd_isPolyhedron(skin[k].shape) && staysAbove(&landing, &skin[k], &skin[!k], v, rounding, site, count))
            return chosenCount;
    for (int k = 0; k < 2; k++)
        if (mcd_isPolyhedron(skin[k].shape))
            addCapEdges(v, &skin[k]);
    addCorners(&skin[0], &skin[1], v, &places);
    addCorners(&skin[1], &skin[0], v, &places);
    addCrossings(&skin[0], &skin[1], &places);
    return chooseOf(&landing, v, rounding, all, places.count, chosen, chosenCount, site);
}
