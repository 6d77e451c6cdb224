/* The flat faces and the straight lines of a shape that is known by its support function alone, found once.
 *
 * Support points in directions on a grid over the sphere start the search:
 *
 *   The support points of three neighbouring directions span a plane. If the shape is not above it, it is a face.
 *   Between two directions whose support points stay apart however near the directions are made, there is the normal
 *   of a straight line of the surface: of an edge, or of a round side.
 *
 * A face's border is traced by directions that lean out of the face: beyond an edge they give no other corner. About
 * each edge the plane is turned until it touches the shape again, which is the next face (gift wrapping). So all faces
 * of a polyhedron are found from one, however small they are, and all its corners, exactly. Faces among curved surfaces
 * are found if no other face or line is within a step of the grid. */
#include "convex/mcd_sampled_i.h"
#include <string.h>

enum { STEPS = 12 };                    /* of the grid, along an edge of the octahedron */
static const double step = 1.5 / STEPS; /* rad, between neighbours */
/* m per m of extent: narrower faces, and shorter lines, are not kept. */
static const double minWidth = 1e-4;
static const double normalError = 1e-4; /* rad: faces are not kept whose normals rounding turns by more */
static const double halfTurn = 3.14159265358979324;

typedef struct Search {
    const McdSampled *s;
    MeBool isClosed; /* all edges found so far lie between two flat faces */
    int visited;     /* faces about whose edges the plane was turned */
    McdFeatures found;
    McdFlat flat[MCD_FLATS];
    double corner[MCD_FLAT_CORNERS][3];
    McdRuling ruling[MCD_RULINGS];
} Search;

static double minWidthOf(const McdSampled *s) {
    return fmax(minWidth * s->extent, s->noise / normalError);
}

/* ---- a face's border --------------------------------------------------------------------------------------------- */

enum { MAX_BORDER = MCD_FACE_POINTS - 1 };

/* Counter-clockwise from outside. */
typedef struct Border {
    int count;
    double point[MAX_BORDER][3];
    MeBool isStraight[MAX_BORDER]; /* to the next point there is an edge */
    MeBool isPolygon;
} Border;

static const double *pointAfter(const Border *b, int i) {
    return b->point[i + 1 < b->count ? i + 1 : 0];
}

/* The direction out of the face across p-q; false: no length. */
static MeBool outwardOf(const double p[3], const double q[3], const double normal[3], double out[3]) {
    double along[3];
    mcd_sub(along, q, p);
    mcd_cross(out, along, normal);
    const double length = mcd_length(out);
    if (length > 0)
        mcd_scale(out, out, 1 / length);
    return length > 0;
}

static void insertAfter(Border *b, int i, const double point[3]) {
    memmove(b->point[i + 2], b->point[i + 1], (size_t)(b->count - i - 1) * sizeof *b->point);
    memmove(&b->isStraight[i + 2], &b->isStraight[i + 1], (size_t)(b->count - i - 1) * sizeof *b->isStraight);
    mcd_copy(b->point[i + 1], point);
    b->isStraight[i + 1] = MEFALSE;
    b->count++;
}

/* Whether there is a point of the face beyond p-q. */
static MeBool findBeyond(const McdSampled *s, const double normal[3], const double p[3], const double q[3],
                         double beyond[3]) {
    double out[3];
    if (!outwardOf(p, q, normal, out))
        return MEFALSE;
    mcd_sampledBeside(s, normal, mcd_sampledBesideFlat(s), out, beyond);
    return mcd_heightOver(beyond, p, out) > 4 * mcd_sampledSlack(s) && !mcd_sampledEqual(s, beyond, p) &&
           !mcd_sampledEqual(s, beyond, q);
}

static void traceBorder(const McdSampled *s, const double normal[3], Border *b) {
    enum { FIRST = 4 };
    double ring[FIRST][3];
    mcd_sampledRing(s, normal, mcd_sampledBesideFlat(s), FIRST, ring);
    b->count = 0;
    for (int i = 0; i < FIRST; i++)
        if (b->count == 0 ||
            (!mcd_sampledEqual(s, ring[i], b->point[b->count - 1]) && !mcd_sampledEqual(s, ring[i], b->point[0]))) {
            b->isStraight[b->count] = MEFALSE;
            mcd_copy(b->point[b->count++], ring[i]);
        }
    MeBool isLarger = b->count > 1;
    while (isLarger) {
        isLarger = MEFALSE;
        for (int i = 0; i < b->count; i++) {
            double beyond[3];
            if (b->isStraight[i] || b->count == MAX_BORDER)
                continue;
            b->isStraight[i] = !findBeyond(s, normal, b->point[i], pointAfter(b, i), beyond);
            if (b->isStraight[i])
                continue;
            insertAfter(b, i++, beyond);
            isLarger = METRUE;
        }
    }
    b->isPolygon = METRUE;
    for (int i = 0; i < b->count; i++)
        b->isPolygon = b->isPolygon && b->isStraight[i];
}

/* m: twice the area over the largest distance from the first point. */
static double widthOf(const Border *b, const double normal[3]) {
    double twice = 0, longest = 0;
    for (int i = 1; i + 1 < b->count; i++) {
        double x[3], y[3], area[3];
        mcd_sub(x, b->point[i], b->point[0]);
        mcd_sub(y, b->point[i + 1], b->point[0]);
        mcd_cross(area, x, y);
        twice += mcd_dot(area, normal);
        longest = fmax(longest, fmax(mcd_length(x), mcd_length(y)));
    }
    return longest > 0 ? twice / longest : 0;
}

/* ---- faces ------------------------------------------------------------------------------------------------------- */

/* The border's radius about `centre`; 0: it is not circular. */
static double circleOf(const McdSampled *s, const double normal[3], double centre[3]) {
    double ring[MCD_RING][3], radius = 0;
    mcd_sampledRing(s, normal, mcd_sampledBesideFlat(s), MCD_RING, ring);
    mcd_set(centre, 0, 0, 0);
    for (int i = 0; i < MCD_RING; i++)
        mcd_mad(centre, centre, 1. / MCD_RING, ring[i]);
    for (int i = 0; i < MCD_RING; i++)
        radius += sqrt(mcd_distanceSquared(ring[i], centre)) / MCD_RING;
    for (int i = 0; i < MCD_RING; i++) { /* the corners of a regular polygon are not where a circle's points would be */
        double x[3], y[3], sine[3];
        mcd_sub(x, ring[i], centre);
        mcd_sub(y, ring[(i + 1) % MCD_RING], centre);
        mcd_cross(sine, x, y);
        if (fabs(mcd_length(x) - radius) > 4 * mcd_sampledSlack(s) ||
            fabs(mcd_length(sine) / (radius * radius) - .38268343236508977) > 1e-6)
            return 0;
    }
    return radius;
}

static int indexOfFlat(const Search *w, const double normal[3], const double on[3]) {
    static const double same = 1e-10; /* 1 - cosine: of what a corner within the slack tilts a small face */
    for (int i = 0; i < w->found.flats; i++)
        if (mcd_dot(w->flat[i].normal, normal) > 1 - same &&
            fabs(mcd_heightOver(on, w->flat[i].centre, normal)) <= 4 * mcd_sampledSlack(w->s))
            return i;
    return -1;
}

/* Adds the face with the normal, through a point; false: it is too narrow, or there is no room. */
static MeBool addFlat(Search *w, const double normal[3], const double on[3]) {
    Border b;
    if (indexOfFlat(w, normal, on) >= 0)
        return METRUE;
    traceBorder(w->s, normal, &b);
    if (widthOf(&b, normal) < minWidthOf(w->s))
        return MEFALSE;
    if (w->found.flats == MCD_FLATS || (b.isPolygon && w->found.corners + b.count > MCD_FLAT_CORNERS))
        return w->isClosed = MEFALSE;
    McdFlat *f = &w->flat[w->found.flats++];
    *f = (McdFlat){.first = w->found.corners};
    mcd_copy(f->normal, normal);
    mcd_copy(f->centre, b.point[0]);
    if (b.isPolygon) {
        memcpy(w->corner[f->first], b.point, (size_t)b.count * sizeof *b.point);
        f->count = b.count;
        w->found.corners += b.count;
    } else {
        double centre[3];
        f->radius = circleOf(w->s, normal, centre);
        if (f->radius > 0)
            mcd_copy(f->centre, centre);
    }
    return METRUE;
}

/* Turns the plane with a normal through the edge p-q about the edge, downwards on its outer side, until the shape is
 * below it: `turned`. Returns the angle. False in isFlat: it touches nothing that is as wide as a face. */
static double turnPlane(const McdSampled *s, const double p[3], const double q[3], const double normal[3],
                        double turned[3], MeBool *isFlat) {
    enum { TURNS = 40 };
    static const double round = 1e-5; /* rad: a smaller turn is that of a round side */
    const double exact = mcd_sampledExact(s);
    double out[3], point[3], angle = halfTurn;
    *isFlat = MEFALSE;
    mcd_copy(turned, normal);
    if (!outwardOf(p, q, normal, out))
        return 0;
    mcd_scale(turned, normal, -1);
    for (int i = 0; i < TURNS && angle > round; i++) {
        mcd_sampledPoint(s, turned, point);
        const double height = mcd_heightOver(point, p, turned);
        const double x = mcd_heightOver(point, p, out), y = fmin(mcd_heightOver(point, p, normal), 0);
        const double next = atan2(-y, x);
        *isFlat = height <= exact || (height <= mcd_sampledSlack(s) && hypot(x, y) > minWidthOf(s));
        if (height <= exact || !(next < angle))
            break;
        angle = next;
        for (int k = 0; k < 3; k++)
            turned[k] = normal[k] * cos(angle) + out[k] * sin(angle);
        mcd_scale(turned, turned, 1 / mcd_length(turned));
    }
    *isFlat = *isFlat && angle > round;
    return angle;
}

static void borderOf(const Search *w, const McdFlat *f, Border *b) {
    if (f->count == 0) {
        traceBorder(w->s, f->normal, b);
        return;
    }
    b->count = f->count;
    memcpy(b->point, w->corner[f->first], (size_t)f->count * sizeof *b->point);
    for (int i = 0; i < b->count; i++)
        b->isStraight[i] = METRUE;
}

/* Adds the faces beyond all edges of those found. */
static void spread(Search *w) {
    for (; w->visited < w->found.flats; w->visited++) {
        const McdFlat f = w->flat[w->visited];
        Border b;
        w->isClosed = w->isClosed && f.count > 0;
        borderOf(w, &f, &b);
        for (int i = 0; i < b.count; i++) {
            double turned[3];
            MeBool isFlat = MEFALSE;
            if (b.isStraight[i])
                turnPlane(w->s, b.point[i], pointAfter(&b, i), f.normal, turned, &isFlat);
            w->isClosed = (isFlat && addFlat(w, turned, b.point[i])) && w->isClosed;
        }
    }
}

/* ---- faces found by three support points ------------------------------------------------------------------------- */

/* A direction and its support point. */
typedef struct Sample {
    double d[3], p[3];
} Sample;

/* The unit normal of the plane through three points, on the side of a direction; false: they are in line. */
static MeBool planeOf(const double a[3], const double b[3], const double c[3], const double side[3], double normal[3]) {
    double x[3], y[3];
    mcd_sub(x, b, a);
    mcd_sub(y, c, a);
    mcd_cross(normal, x, y);
    const double length = mcd_length(normal);
    if (!(length > 0))
        return MEFALSE;
    mcd_scale(normal, normal, (mcd_dot(normal, side) < 0 ? -1 : 1) / length);
    return METRUE;
}

/* The face whose border is rounded: where the cone of directions is made narrower, its support points stay apart,
 * while those of a curved surface come together. */
static void findRounded(Search *w, double normal[3]) {
    enum { AROUND = 8, ROUNDS = 9 };
    static const double narrower = .25;
    const McdSampled *s = w->s;
    double tilt = step, before = 0;
    for (int round = 0; round < ROUNDS; round++) {
        double ring[AROUND][3], next[3], width = 0;
        int aside = 0;
        mcd_sampledRing(s, normal, tilt, AROUND, ring);
        for (int i = 1; i < AROUND; i++) { /* the widest triangle with two points that are opposite to each other */
            double x[3], y[3], area[3];
            mcd_sub(x, ring[AROUND / 2], ring[0]);
            mcd_sub(y, ring[i], ring[0]);
            mcd_cross(area, x, y);
            const double length = mcd_length(x), here = length > 0 ? mcd_length(area) / length : 0;
            aside = here > width ? i : aside;
            width = fmax(width, here);
        }
        if (width < fmax(minWidthOf(s), sqrt(narrower) * before) ||
            !planeOf(ring[0], ring[AROUND / 2], ring[aside], normal, next) || mcd_dot(next, normal) < 1 - step * step)
            return;
        mcd_copy(normal, next);
        if (mcd_sampledHeight(s, normal, ring[0]) <= mcd_sampledSlack(s)) {
            addFlat(w, normal, ring[0]);
            return;
        }
        before = width;
        tilt *= narrower;
    }
}

/* Whether the support points are farther apart than where radii of curvature are those of the shape. */
static MeBool isNearlyFlat(const McdSampled *s, const Sample *a, const Sample *b, const Sample *c) {
    static const double flatter = 2;
    double x[3], y[3], area[3];
    mcd_sub(x, b->p, a->p);
    mcd_sub(y, c->p, a->p);
    mcd_cross(area, x, y);
    const double longest = fmax(fmax(mcd_length(x), mcd_length(y)), sqrt(mcd_distanceSquared(b->p, c->p)));
    return mcd_length(area) > flatter * step * s->extent * longest;
}

static void considerTriangle(Search *w, const Sample *a, const Sample *b, const Sample *c) {
    const double near = 1 - 4 * step * step; /* cosine */
    const McdSampled *s = w->s;
    double normal[3];
    if (mcd_sampledEqual(s, a->p, b->p) || mcd_sampledEqual(s, b->p, c->p) || mcd_sampledEqual(s, c->p, a->p) ||
        !planeOf(a->p, b->p, c->p, a->d, normal) || mcd_dot(normal, a->d) < near || indexOfFlat(w, normal, a->p) >= 0)
        return;
    const double length = sqrt(mcd_distanceSquared(a->p, b->p)) + sqrt(mcd_distanceSquared(b->p, c->p));
    const double height = mcd_sampledHeight(s, normal, a->p);
    if (height <= mcd_sampledSlack(s))
        addFlat(w, normal, a->p);
    else if (height < .02 * step * length || isNearlyFlat(s, a, b, c)) /* curved surfaces: three times as high */
        findRounded(w, normal);
    spread(w);
}

/* ---- lines ------------------------------------------------------------------------------------------------------- */

enum { SPACING = 2 }; /* steps of the grid between the lines that are kept of one side */

/* Whether the line is one of a side of which a line is kept nearby. */
static MeBool isRulingKnown(const Search *w, const double normal[3], const double along[3]) {
    const double near = 1 - step * step / 8; /* cosine */
    for (int i = 0; i < w->found.rulings; i++) {
        const McdRuling *r = &w->ruling[i];
        double m[3], a[3];
        if (mcd_dot(r->normal, normal) < 1 - SPACING * SPACING * step * step / 2)
            continue;
        mcd_rulingTurn(r, mcd_rulingAngle(r, normal), m, a);
        if (mcd_dot(m, normal) > near && fabs(mcd_dot(a, along)) > near)
            return METRUE;
    }
    return MEFALSE;
}

/* Whether the line beside is another one, as on a round side, and not the same edge; sets the twist. */
static MeBool isOnRoundSide(const McdSampled *s, const McdLine *line, double *twist) {
    static const double turn = .01; /* rad */
    double w[3], n[3];
    McdLine beside;
    *twist = 0;
    mcd_cross(w, line->normal, line->along);
    mcd_scale(n, line->normal, cos(turn));
    mcd_mad(n, n, sin(turn), w);
    if (!mcd_sampledLine(s, n, line->along, mcd_sampledExact(s), &beside) || beside.length < line->length / 2)
        return MEFALSE;
    *twist = mcd_dot(beside.along, w) / mcd_dot(beside.normal, w);
    return !mcd_sampledEqual(s, beside.end[0], line->end[0]) || !mcd_sampledEqual(s, beside.end[1], line->end[1]);
}

/* Adds the faces on both sides of an edge. False: there are none. */
static MeBool addFlatsBeside(Search *w, const McdLine *line) {
    MeBool hasFlat = MEFALSE;
    for (int side = 0; side < 2; side++) {
        double turned[3];
        MeBool isFlat;
        turnPlane(w->s, line->end[side], line->end[!side], line->normal, turned, &isFlat);
        hasFlat = (isFlat && addFlat(w, turned, line->end[0])) || hasFlat;
    }
    spread(w);
    return hasFlat;
}

/* Whether the line ends: as the directions lean more to its ends, these move no more than on a rounding as large as the
 * shape. Nearly flat surfaces look straight over a length that depends on how near the directions are. */
static MeBool hasEnds(const McdSampled *s, const McdLine *line) {
    static const double tilt = 1e-3;
    double end[2][3], between[3];
    for (int i = 0; i < 2; i++)
        mcd_sampledBeside(s, line->normal, i ? tilt : -tilt, line->along, end[i]);
    mcd_sub(between, end[1], end[0]);
    return mcd_dot(between, line->along) - line->length <= 3 * tilt * s->extent;
}

/* A line of a round side, or an edge between two of them, is kept; of other edges the faces beside. */
static void addLine(Search *w, const McdLine *line) {
    double twist;
    if (line->length < minWidthOf(w->s) || w->found.rulings == MCD_RULINGS ||
        isRulingKnown(w, line->normal, line->along) || (!isOnRoundSide(w->s, line, &twist) && addFlatsBeside(w, line)))
        return;
    McdRuling *r = &w->ruling[w->found.rulings++];
    mcd_copy(r->normal, line->normal);
    mcd_copy(r->along, line->along);
    r->length = line->length;
    r->twist = twist;
    r->isBent = !hasEnds(w->s, line);
}

/* Adds the other lines of the side that the line is on. */
static void addSide(Search *w, const McdLine *line) {
    int i = w->found.rulings;
    for (addLine(w, line); i < w->found.rulings; i++)
        for (int side = -1; side <= 1; side += 2) {
            double normal[3], along[3];
            McdLine next;
            mcd_rulingTurn(&w->ruling[i], 1.01 * side * SPACING * step, normal, along);
            if (!isRulingKnown(w, normal, along) && mcd_sampledLine(w->s, normal, along, mcd_sampledExact(w->s), &next))
                addLine(w, &next);
        }
}

/* Halves the way between two directions, and goes on with the half whose support points are farther apart, as long as
 * that is much more than the other half. */
static void considerEdge(Search *w, const Sample *from, const Sample *to) {
    enum { HALVES = 12 };
    static const double jump = 1.5;
    Sample a = *from, b = *to, middle;
    double along[3];
    McdLine line;
    for (int i = 0; i < HALVES; i++) {
        if (mcd_sampledEqual(w->s, a.p, b.p))
            return;
        for (int k = 0; k < 3; k++)
            middle.d[k] = a.d[k] + b.d[k];
        mcd_scale(middle.d, middle.d, 1 / mcd_length(middle.d));
        mcd_sampledPoint(w->s, middle.d, middle.p);
        const double left = sqrt(mcd_distanceSquared(a.p, middle.p)), right = sqrt(mcd_distanceSquared(middle.p, b.p));
        if (fmax(left, right) < jump * fmin(left, right))
            return;
        *(left > right ? &b : &a) = middle;
    }
    mcd_sub(along, b.p, a.p);
    const double length = mcd_length(along);
    if (length < minWidthOf(w->s))
        return;
    mcd_scale(along, along, 1 / length);
    if (!isRulingKnown(w, middle.d, along) && mcd_sampledLine(w->s, middle.d, along, mcd_sampledExact(w->s), &line))
        addSide(w, &line);
}

/* ---- the whole shape --------------------------------------------------------------------------------------------- */

/* Row i of an octant of directions, turned so that those along the axes, which often lie between corners or along
 * edges, are not among them. */
static void sampleRow(const McdSampled *s, int octant, int i, Sample row[]) {
    static const double turned[3][3] = {{.7936, .4329, -.4276}, {-.2367, .8665, .4395}, {.5608, -.2476, .7901}};
    for (int j = 0; j <= STEPS - i; j++) {
        double *d = row[j].d;
        mcd_set(d, 0, 0, 0);
        mcd_mad(d, d, octant & 1 ? -i : i, turned[0]);
        mcd_mad(d, d, octant & 2 ? -j : j, turned[1]);
        mcd_mad(d, d, octant & 4 ? i + j - STEPS : STEPS - i - j, turned[2]);
        mcd_scale(d, d, 1 / mcd_length(d));
        mcd_sampledPoint(s, d, row[j].p);
    }
}

/* Each edge of the grid belongs to one of the triangles that point up. */
static void searchOctant(Search *w, int octant) {
    Sample memory[2][STEPS + 1];
    sampleRow(w->s, octant, 0, memory[0]);
    for (int i = 0; i < STEPS && !w->found.isPolyhedron; i++) {
        const Sample *row = memory[i % 2], *next = memory[(i + 1) % 2];
        sampleRow(w->s, octant, i + 1, memory[(i + 1) % 2]);
        for (int j = 0; j < STEPS - i && !w->found.isPolyhedron; j++) {
            considerTriangle(w, &row[j], &next[j], &row[j + 1]);
            if (j + 1 < STEPS - i)
                considerTriangle(w, &next[j], &next[j + 1], &row[j + 1]);
            considerEdge(w, &row[j], &next[j]);
            considerEdge(w, &row[j], &row[j + 1]);
            considerEdge(w, &next[j], &row[j + 1]);
            w->found.isPolyhedron = w->found.flats > 0 && w->isClosed;
        }
    }
}

/* Whether the support points in directions that differ by a turn about z differ by that turn. */
static MeBool isTurned(const McdSampled *s) {
    enum { LATITUDES = 7, LONGITUDES = 5 };
    for (int i = 0; i < LATITUDES; i++) {
        const double up = cos((i + .6) * halfTurn / LATITUDES), aside = sqrt(1 - up * up);
        double radius = 0, height = 0;
        for (int j = 0; j < LONGITUDES; j++) {
            const double angle = (j + .2) * 2 * halfTurn / LONGITUDES, c = cos(angle), k = sin(angle);
            const double d[3] = {aside * c, aside * k, up};
            double p[3];
            mcd_sampledPoint(s, d, p);
            radius = j == 0 ? c * p[0] + k * p[1] : radius;
            height = j == 0 ? p[2] : height;
            const double at[3] = {radius * c, radius * k, height};
            if (!mcd_sampledEqual(s, p, at))
                return MEFALSE;
        }
    }
    return METRUE;
}

static MeBool hasDisc(const Search *w) {
    for (int i = 0; i < w->found.flats; i++)
        if (w->flat[i].radius > 0 && fabs(w->flat[i].normal[2]) > 1 - mcd_slack * mcd_slack)
            return isTurned(w->s);
    return MEFALSE;
}

/* A copy that is as large as what it holds. */
static McdFeatures *copyFound(const Search *w) {
    const McdFeatures *from = &w->found;
    const size_t flats = (size_t)from->flats * sizeof *from->flat,
                 corners = (size_t)from->corners * sizeof *from->corner,
                 rulings = (size_t)from->rulings * sizeof *from->ruling;
    char *block = MeMemoryTake(1, sizeof *from + flats + corners + rulings, "McdConvexCreate", "faces");
    McdFeatures *to = (McdFeatures *)(void *)block;
    if (!to)
        return 0;
    *to = *from;
    to->flat = (McdFlat *)(void *)(block + sizeof *from);
    to->corner = (double(*)[3])(void *)(block + sizeof *from + flats);
    to->ruling = (McdRuling *)(void *)(block + sizeof *from + flats + corners);
    memcpy(to->flat, w->flat, flats);
    memcpy(to->corner, w->corner, corners);
    memcpy(to->ruling, w->ruling, rulings);
    return to;
}

McdFeatures *mcd_sampledFeatures(const McdSampled *s) {
    Search *w = MeMemoryTake(1, sizeof *w, "McdConvexCreate", "finding faces");
    if (!w)
        return 0;
    w->s = s;
    w->isClosed = METRUE;
    w->visited = 0;
    w->found = (McdFeatures){.flats = 0};
    for (int octant = 0; octant < 8 && s->isConsistent && !w->found.isPolyhedron; octant++)
        searchOctant(w, octant);
    w->found.hasDisc = hasDisc(w);
    McdFeatures *found = copyFound(w);
    MeMemoryGive(w);
    return found;
}
