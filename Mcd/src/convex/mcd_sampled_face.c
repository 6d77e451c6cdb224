/* Faces, lines and curvature of convex shapes that are known by their support function alone.
 *
 * A contact takes the face or the line of the surface whose normal is nearest to its direction, at any tilt, as
 * built-in shapes do. Faces are known since the shape got its data (mcd_features.c). Of the lines of round sides some
 * are known; from the nearest of these it is a turn about the side's axis to the line whose normal is nearest.
 *
 * If not all of the surface consists of flat faces, a face or a line counts only where the support point in the
 * direction lies on its border, or on a rounding of the border. Elsewhere there is the support point alone. */
#include "convex/mcd_sampled_i.h"
#include <string.h>

/* Tangent of the angle up to which a line touches along its length; beyond, with its end. */
static const double wide = .05;
/* Tangent for differences of support points: the radius of curvature is exact to its square. */
static const double difference = 1e-3;

/* ---- lines ------------------------------------------------------------------------------------------------------- */

/* Sets the direction along the line, and the normal that is nearest to n; false: too steep. */
static MeBool alignLine(McdLine *line, const double n[3]) {
    mcd_sub(line->along, line->end[1], line->end[0]);
    line->length = mcd_length(line->along);
    if (!(line->length > 0))
        return MEFALSE;
    mcd_scale(line->along, line->along, 1 / line->length);
    const double up = mcd_dot(n, line->along);
    mcd_mad(line->normal, n, -up, line->along);
    mcd_scale(line->normal, line->normal, 1 / mcd_length(line->normal));
    return fabs(up) < 2 * wide;
}

MeBool mcd_sampledLine(const McdSampled *s, const double n[3], const double along[3], double exact, McdLine *line) {
    enum { ROUNDS = 6 };
    /* The tilt of each round, of that before. The line through two rounded ends is exact to the tilt's square, so that
     * the tilt may be so much smaller each time. Ends that come together as much are on a curved surface. */
    static const double narrower[ROUNDS] = {.125, .0625, .03125, .03125, .03125, 0};
    double tilt = wide, before = 0;
    MeBool isLine = MEFALSE;
    McdLine next;
    mcd_sampledBeside(s, n, -tilt, along, next.end[0]);
    mcd_sampledBeside(s, n, tilt, along, next.end[1]);
    for (int round = 0; round < ROUNDS; round++) {
        if (!alignLine(&next, n) || next.length < before)
            break;
        const double height = mcd_sampledHeight(s, next.normal, next.end[0]);
        if (height <= fmax(exact, mcd_sampledSlack(s))) {
            isLine = METRUE;
            *line = next;
        }
        if (height <= exact)
            break;
        before = next.length * sqrt(narrower[round]);
        tilt *= narrower[round];
        mcd_sampledBeside(s, next.normal, -tilt, next.along, next.end[0]);
        mcd_sampledBeside(s, next.normal, tilt, next.along, next.end[1]);
    }
    return isLine;
}

/* The line with a normal that is known to 1e-6 rad. */
static MeBool confirmLine(const McdSampled *s, const double n[3], const double along[3], double length, McdLine *line) {
    const double tilt = fmax(1e-6, 4 * s->noise / length);
    mcd_sampledBeside(s, n, -tilt, along, line->end[0]);
    mcd_sampledBeside(s, n, tilt, along, line->end[1]);
    return alignLine(line, n) && line->length > length / 2 &&
           mcd_sampledHeight(s, line->normal, line->end[0]) <= mcd_sampledExact(s);
}

/* v turned by an angle about an axis of length 1. */
static void turnAbout(const double axis[3], double angle, const double v[3], double turned[3]) {
    double across[3];
    const double along = mcd_dot(axis, v) * (1 - cos(angle));
    mcd_cross(across, axis, v);
    for (int k = 0; k < 3; k++)
        turned[k] = v[k] * cos(angle) + across[k] * sin(angle) + axis[k] * along;
    mcd_scale(turned, turned, 1 / mcd_length(turned));
}

/* As the normal m of a line moves across it, along w = m x a, its direction a moves along w by some share of that, the
 * twist: both turn about the axis twist m - a, which is constant on solids of revolution and cylinders of any section.
 */
static void axisOf(const McdRuling *r, double axis[3]) {
    mcd_scale(axis, r->normal, r->twist);
    mcd_mad(axis, axis, -1, r->along);
    mcd_scale(axis, axis, 1 / mcd_length(axis));
}

double mcd_rulingAngle(const McdRuling *r, const double n[3]) {
    double axis[3], across[3];
    axisOf(r, axis);
    mcd_cross(across, r->normal, n);
    return atan2(mcd_dot(axis, across), mcd_dot(r->normal, n) - mcd_dot(r->normal, axis) * mcd_dot(n, axis));
}

void mcd_rulingTurn(const McdRuling *r, double angle, double normal[3], double along[3]) {
    double axis[3];
    axisOf(r, axis);
    turnAbout(axis, angle, r->normal, normal);
    turnAbout(axis, angle, r->along, along);
}

/* Goes on to the line whose normal is nearest to n. */
static MeBool nearestLine(const McdSampled *s, const double n[3], const McdRuling *start, McdLine *line) {
    enum { STEPS = 12 };
    static const double maxTurn = .4, near = .01; /* rad */
    McdRuling here = *start;
    MeBool isExact = MEFALSE;
    for (int i = 0; i < STEPS; i++) {
        double m[3], a[3], w[3];
        const double to = mcd_rulingAngle(&here, n), turned = MeCLAMP(to, -maxTurn, maxTurn);
        if (isExact && fabs(turned) < fmax(1e-9, 8 * s->noise / here.length))
            return METRUE;
        mcd_rulingTurn(&here, turned, m, a);
        isExact = confirmLine(s, m, a, here.length, line);
        if (!isExact) {
            isExact = fabs(turned) < near;
            if (!mcd_sampledLine(s, m, a, isExact ? mcd_sampledExact(s) : 1e-5 * s->extent, line))
                return MEFALSE;
        }
        mcd_cross(w, here.normal, here.along);
        const double moved = mcd_dot(line->normal, w);
        if (fabs(moved) > near)
            here.twist = mcd_dot(line->along, w) / moved;
        mcd_copy(here.normal, line->normal);
        mcd_copy(here.along, line->along);
        here.length = line->length;
    }
    return isExact;
}

/* The line of a nearly straight surface whose normal is nearest to n. */
static MeBool nearestBent(const McdSampled *s, const double n[3], const McdRuling *start, McdLine *line) {
    double m[3], a[3];
    mcd_rulingTurn(start, mcd_rulingAngle(start, n), m, a);
    return mcd_dot(m, n) > 1 - wide * wide / 2 && mcd_sampledLine(s, m, a, mcd_sampledSlack(s), line);
}

/* m: the radius of curvature of the surface with the normal n in the direction across. */
static double radiusAcross(const McdSampled *s, const double n[3], const double across[3], double tilt) {
    double p[3], q[3];
    mcd_sampledBeside(s, n, tilt, across, p);
    mcd_sampledBeside(s, n, -tilt, across, q);
    mcd_sub(p, p, q);
    return fmax(mcd_dot(p, across), 0) * (sqrt(1 + tilt * tilt) / (2 * tilt));
}

/* The radius of curvature across a line, the mean of both ends, between which a cone's changes. */
static double radiusAcrossLine(const McdSampled *s, const McdLine *line) {
    static const double toEnd = .1; /* of the tangent: else a bent side gives points of both ends */
    double across[3], sum = 0;
    mcd_cross(across, line->normal, line->along);
    for (int end = 0; end < 2; end++) {
        double n[3];
        mcd_mad(n, line->normal, (end ? toEnd : -toEnd) * difference, line->along);
        mcd_scale(n, n, 1 / mcd_length(n));
        sum += radiusAcross(s, n, across, difference);
    }
    return sum / 2;
}

/* ---- roundings --------------------------------------------------------------------------------------------------- */

/* A rounding of the radius r of a border with the normal m: its support points are r (n - m) from the border's. */
static void roundedPoint(const double on[3], double radius, const double n[3], const double m[3], double point[3]) {
    for (int k = 0; k < 3; k++)
        point[k] = on[k] + radius * (n[k] - m[k]);
}

/* The radius of the rounding that the support point in the direction n lies on: r (1 - n . m) below the face. */
static double roundingAt(const double farthest[3], const double n[3], const double on[3], const double m[3]) {
    const double fall = .5 * mcd_distanceSquared(n, m), depth = -mcd_heightOver(farthest, on, m);
    return fall > 1e-12 && depth > 0 ? depth / fall : 0;
}

/* How far a support point may be from where a rounding says: of the extent. */
static const double onBorder = 1e-5;

static MeBool isNear(const McdSampled *s, const double a[3], const double b[3]) {
    return mcd_distanceSquared(a, b) <= onBorder * onBorder * s->extent * s->extent;
}

/* ---- faces from flat faces --------------------------------------------------------------------------------------- */

/* What is near a direction: a flat face, whose rounded border is seen from `toward`; or a line; or neither. */
typedef struct Choice {
    const McdFlat *flat;
    double rounding, toward[3];
    double cosine; /* of the angle to the direction */
    McdLine line;
    MeBool isLine, isBent;
} Choice;

static void addPoint(const McdShape *s, McdFace *f, const double point[3], MeU32 name) {
    mcd_faceAdd(s, f, point[0], point[1], point[2], name);
}

/* A disc as a cylinder has it. The corners begin at the shape's x axis, or y. */
static void makeDisc(const McdShape *shape, const McdFlat *flat, const double centre[3], const double n[3],
                     McdFace *f) {
    const double *m = flat->normal;
    McdShape disc = *shape;
    double u[3] = {fabs(m[0]) < .9, 0, 0}, w[3], d[3];
    u[1] = 1 - u[0];
    mcd_mad(u, u, -mcd_dot(u, m), m);
    mcd_scale(u, u, 1 / mcd_length(u));
    mcd_cross(w, m, u);
    mcd_shapeDirection(shape, u[0], u[1], u[2], disc.axis[0]);
    mcd_shapeDirection(shape, w[0], w[1], w[2], disc.axis[1]);
    mcd_shapeDirection(shape, m[0], m[1], m[2], disc.axis[2]);
    mcd_shapePoint(shape, centre[0], centre[1], centre[2], disc.place);
    mcd_set(d, mcd_dot(n, u), mcd_dot(n, w), mcd_dot(n, m));
    mcd_discFace(&disc, d, flat->radius, 0, 1, f);
}

/* Support points around a face with a round border that is no circle; of a tilted one five, of which the first is the
 * one in the direction n (mcd_discs.c). Returns their number. */
static int sampleRim(const McdSampled *s, const McdFlat *flat, const double n[3], double point[][3]) {
    enum { TILTED = 5 };
    static const double flatSine = .05, fifth = 1.2566370614359173;
    const double beside = fmax(1e-5, mcd_sampledBesideFlat(s)); /* so wide that nearly flat surfaces stand */
    double u[3], w[3];
    mcd_mad(u, n, -mcd_dot(n, flat->normal), flat->normal);
    const double sine = mcd_length(u);
    if (sine <= flatSine) {
        mcd_sampledRing(s, flat->normal, beside, MCD_RING, point);
        return MCD_RING;
    }
    mcd_scale(u, u, 1 / sine);
    mcd_cross(w, flat->normal, u);
    for (int i = 0; i < TILTED; i++) {
        double along[3];
        mcd_scale(along, u, cos(i * fifth));
        mcd_mad(along, along, sin(i * fifth), w);
        mcd_sampledBeside(s, flat->normal, beside, along, point[i]);
    }
    return TILTED;
}

static void makeRim(const McdShape *shape, const McdFlat *flat, const double offset[3], const double n[3], McdFace *f) {
    enum { LAST = MCD_FACE_POINTS - 1 };
    const McdSampled *s = shape->sampled;
    double point[MCD_RING][3];
    const int count = sampleRim(s, flat, n, point);
    for (int i = 0; i < count; i++) {
        double at[3];
        if (i > 0 && (mcd_sampledEqual(s, point[i], point[i - 1]) || mcd_sampledEqual(s, point[i], point[0])))
            continue;
        mcd_mad(at, point[i], 1, offset);
        addPoint(shape, f, at, (MeU32)(count == MCD_RING ? i : LAST - i));
    }
    f->isDisc = METRUE;
}

/* The edge of a face that is nearest to the direction n: that of a plate, at which n looks along the face. */
static void makeEdge(const McdShape *shape, const McdFlat *flat, const double n[3], McdFace *f) {
    const McdFeatures *k = shape->sampled->features;
    const double(*corner)[3] = mcd_constRows(k->corner + flat->first);
    double best = -INFINITY, normal[3] = {0, 0, 0};
    int first = 0;
    for (int i = 0; i < flat->count; i++) {
        double along[3], out[3];
        mcd_sub(along, corner[(i + 1) % flat->count], corner[i]);
        mcd_scale(along, along, 1 / mcd_length(along));
        mcd_cross(out, along, flat->normal);
        if (!(mcd_dot(out, n) > best))
            continue;
        best = mcd_dot(out, n);
        first = i;
        mcd_mad(normal, n, -mcd_dot(n, along), along);
    }
    mcd_scale(normal, normal, 1 / mcd_length(normal));
    mcd_shapeDirection(shape, normal[0], normal[1], normal[2], f->normal);
    addPoint(shape, f, corner[first], 0);
    addPoint(shape, f, corner[(first + 1) % flat->count], 1);
    f->id = (MeU32)(MCD_FLATS + 2 + first);
}

/* The face, its border moved along its rounding. */
static void makeFlat(const McdShape *shape, const McdFlat *flat, const Choice *c, const double n[3], McdFace *f) {
    const McdFeatures *k = shape->sampled->features;
    double offset[3], at[3];
    mcd_sub(offset, c->toward, flat->normal);
    mcd_scale(offset, offset, c->rounding);
    mcd_shapeDirection(shape, flat->normal[0], flat->normal[1], flat->normal[2], f->normal);
    for (int i = 0; i < flat->count; i++) {
        mcd_mad(at, k->corner[flat->first + i], 1, offset);
        addPoint(shape, f, at, (MeU32)i);
    }
    mcd_mad(at, flat->centre, 1, offset);
    if (flat->radius > 0)
        makeDisc(shape, flat, at, n, f);
    else if (flat->count == 0)
        makeRim(shape, flat, offset, n, f);
    f->id = (MeU32)(flat - k->flat);
}

/* ---- faces from lines -------------------------------------------------------------------------------------------- */

/* An end as it is seen from the direction n: the support point there, if that is on the end's rounding. The radius of
 * the end that is not in that direction is found by the support point in the mirrored direction. */
static void endToward(const McdSampled *s, const McdLine *line, int end, const double n[3], const double farthest[3],
                      double point[3]) {
    const double up = mcd_dot(n, line->along);
    const MeBool isFar = end != (up > 0);
    double d[3], there[3], at[3];
    mcd_copy(d, n);
    mcd_copy(there, farthest);
    if (isFar) {
        mcd_mad(d, n, -2 * up, line->along);
        mcd_sampledPoint(s, d, there);
    }
    const double radius = roundingAt(there, d, line->end[end], line->normal);
    roundedPoint(line->end[end], radius, d, line->normal, at);
    mcd_copy(point, line->end[end]);
    if (isNear(s, at, there))
        roundedPoint(there, isFar ? radius : 0, n, d, point);
}

/* The ends are named in the order of the coordinate in which they differ most. */
static void makeLine(const McdShape *shape, const McdLine *line, const double n[3], const double farthest[3],
                     McdFace *f) {
    const McdSampled *s = shape->sampled;
    const double *along = line->along;
    double end[2][3];
    int k = fabs(along[1]) > fabs(along[0]);
    k = fabs(along[2]) > fabs(along[k]) ? 2 : k;
    const int low = along[k] < 0;
    memcpy(end, line->end, sizeof end);
    for (int i = 0; i < 2 && fabs(mcd_dot(n, along)) > 1e-6; i++)
        endToward(s, line, i, n, farthest, end[i]);
    mcd_shapeDirection(shape, line->normal[0], line->normal[1], line->normal[2], f->normal);
    f->curvatureRadius = radiusAcrossLine(s, line);
    f->id = MCD_FLATS;
    addPoint(shape, f, end[low], 0);
    addPoint(shape, f, end[!low], 1);
}

/* Whether the surface is curved in both directions where the outward normal is n, not at a rim or a corner. */
static MeBool isCurved(const McdSampled *s, const double n[3]) {
    double axis[2][3], moved[2][3], area[3];
    mcd_basis(n, axis[0], axis[1]);
    for (int i = 0; i < 2; i++) {
        double back[3];
        mcd_sampledBeside(s, n, difference, axis[i], moved[i]);
        mcd_sampledBeside(s, n, -difference, axis[i], back);
        mcd_sub(moved[i], moved[i], back);
    }
    mcd_cross(area, moved[0], moved[1]);
    return mcd_length(area) > 1e-3 * (mcd_dot(moved[0], moved[0]) + mcd_dot(moved[1], moved[1]));
}

/* Whether a line is what touches in the direction n: at a small tilt, or with an end, or the rounding of an end, or
 * beside one, on a rim that is no circle. */
static MeBool isOnLine(const McdSampled *s, const McdLine *line, const double n[3], const double farthest[3]) {
    const double *end = line->end[mcd_dot(n, line->along) > 0];
    double at[3];
    if (mcd_dot(n, line->normal) > 1 - wide * wide / 2)
        return METRUE;
    roundedPoint(end, roundingAt(farthest, n, end, line->normal), n, line->normal, at);
    return isNear(s, at, farthest) || !isCurved(s, n);
}

/* ---- the nearest of all ------------------------------------------------------------------------------------------ */

/* Whether the support point in the direction n is on the rounded border of a face, whose radius it sets. */
static MeBool isOnRounding(const McdSampled *s, const McdFlat *flat, const double n[3], const double farthest[3],
                           double *rounding) {
    double out[3], border[3];
    mcd_mad(out, n, -mcd_dot(n, flat->normal), flat->normal);
    const double sine = mcd_length(out), beside = mcd_sampledBesideFlat(s);
    *rounding = 0;
    if (!(sine > 2 * beside))
        return METRUE;
    mcd_scale(out, out, 1 / sine);
    mcd_sampledBeside(s, flat->normal, beside, out, border);
    const double moved = mcd_heightOver(farthest, border, out); /* along an edge both may be anywhere */
    if (moved > fmax(mcd_sampledExact(s), beside * s->extent))
        *rounding = moved / (sine - beside);
    const double fall = .5 * mcd_distanceSquared(n, flat->normal);
    const double depth = -mcd_heightOver(farthest, flat->centre, flat->normal);
    return fabs(depth - *rounding * fall) <= onBorder * s->extent * fall / sine + mcd_sampledExact(s);
}

/* Of the angle to a face that may be chosen: more tilted ones are seen from their edge. */
static const double minCosine = .5;

static const McdFlat *nearestFlat(const McdFeatures *k, const double n[3]) {
    const McdFlat *best = 0;
    double max = -INFINITY;
    for (int i = 0; i < k->flats; i++) {
        const double cosine = mcd_dot(k->flat[i].normal, n);
        if (cosine > max) {
            max = cosine;
            best = &k->flat[i];
        }
    }
    return best;
}

/* Of the faces that have the support point the one nearest to n; or the nearest one, if its rounding has that point. */
static void chooseFlat(const McdSampled *s, const double n[3], const double farthest[3], Choice *c) {
    const McdFeatures *k = s->features;
    const McdFlat *nearest = nearestFlat(k, n);
    mcd_copy(c->toward, n);
    c->cosine = minCosine;
    if (!nearest || !(mcd_dot(nearest->normal, n) > minCosine))
        return;
    const MeBool isRounded = isOnRounding(s, nearest, n, farthest, &c->rounding);
    if (!isRounded)
        c->rounding = 0;
    if (isRounded || mcd_dot(nearest->normal, n) > 1 - wide * wide / 2) {
        c->flat = nearest;
        c->cosine = mcd_dot(nearest->normal, n);
        return;
    }
    for (int i = 0; i < k->flats; i++) {
        const McdFlat *flat = &k->flat[i];
        if (mcd_dot(flat->normal, n) > c->cosine &&
            -mcd_heightOver(farthest, flat->centre, flat->normal) <= mcd_sampledSlack(s)) {
            c->flat = flat;
            c->cosine = mcd_dot(flat->normal, n);
        }
    }
}

/* Whether the line is on the rounding of an edge of the face, with both ends. */
static MeBool isOnEdge(const McdSampled *s, const McdFlat *flat, const McdLine *line, double *rounding) {
    static const double same = .1; /* of the radius, which has a large error near the face's normal */
    const double sine = sqrt(mcd_distanceSquared(line->normal, flat->normal));
    double other;
    return isOnRounding(s, flat, line->normal, line->end[0], rounding) &&
           isOnRounding(s, flat, line->normal, line->end[1], &other) &&
           fabs(other - *rounding) * sine <= same * *rounding * sine + 2 * mcd_sampledExact(s);
}

/* A line on the rounding of an edge of a face stands for the face: seen from where the line is, or from n at a rounded
 * corner. */
static void preferFlat(const McdSampled *s, const double n[3], Choice *c) {
    const McdFlat *flat = c->rounding > 0 ? c->flat : nearestFlat(s->features, n);
    double rounding;
    if (!c->isLine || !flat || !(mcd_dot(flat->normal, n) > minCosine) || !isOnEdge(s, flat, &c->line, &rounding))
        return;
    c->isLine = MEFALSE;
    if (c->rounding > 0)
        return;
    c->flat = flat;
    c->rounding = rounding;
    mcd_copy(c->toward, c->line.normal);
}

static const McdRuling *nearestRuling(const McdFeatures *k, const double n[3], double *cosine) {
    const McdRuling *best = 0;
    *cosine = -INFINITY;
    for (int i = 0; i < k->rulings; i++) {
        const double here = mcd_dot(k->ruling[i].normal, n);
        if (here > *cosine) {
            *cosine = here;
            best = &k->ruling[i];
        }
    }
    return best;
}

static void chooseLine(const McdSampled *s, const double n[3], const double farthest[3], Choice *c) {
    static const double reach = .4; /* rad: a line may be so much nearer than the nearest one that is known */
    double cosine;
    McdLine line;
    const McdRuling *start = nearestRuling(s->features, n, &cosine);
    if (!start || (c->flat && acos(MeMIN(c->cosine, 1)) + reach < acos(MeCLAMP(cosine, -1, 1))) ||
        !(start->isBent ? nearestBent : nearestLine)(s, n, start, &line) ||
        (c->flat && mcd_dot(line.normal, n) <= c->cosine + 1e-12) || !isOnLine(s, &line, n, farthest))
        return;
    c->isLine = METRUE;
    c->line = line;
    c->isBent = start->isBent;
}

static MeBool isSharp(const McdSampled *s, const double n[3], const double farthest[3]) {
    enum { AROUND = 4 };
    double ring[AROUND][3];
    mcd_sampledRing(s, n, wide, AROUND, ring);
    for (int i = 0; i < AROUND; i++)
        if (!mcd_sampledEqual(s, ring[i], farthest))
            return MEFALSE;
    return METRUE;
}

static void findFace(const McdShape *shape, const double direction[3], McdFace *f) {
    enum { POINT = MCD_FLATS + 1 };
    static const double edgeOn = .1; /* cosine */
    const McdSampled *s = shape->sampled;
    const McdFeatures *k = s->features;
    double n[3], farthest[3];
    Choice c = {.flat = 0};
    mcd_sampledDirection(shape, direction, n);
    if (k->isPolyhedron) {
        const McdFlat *flat = nearestFlat(k, n);
        const MeBool isPlate = k->flats == 2;
        if (isPlate && mcd_dot(flat->normal, n) < edgeOn)
            makeEdge(shape, flat, n, f);
        else
            makeFlat(shape, flat, &c, n, f);
        return;
    }
    mcd_sampledPoint(s, n, farthest);
    chooseFlat(s, n, farthest, &c);
    if (!(c.flat && c.cosine > 1 - wide * wide / 2)) {
        chooseLine(s, n, farthest, &c);
        preferFlat(s, n, &c);
    }
    if (c.isLine) {
        makeLine(shape, &c.line, n, farthest, f);
    } else if (c.flat) {
        makeFlat(shape, c.flat, &c, n, f);
    } else {
        f->id = POINT;
        f->isDisc = !isSharp(s, n, farthest); /* the point moves along the surface */
        addPoint(shape, f, farthest, 0);
    }
}

MeBool mcd_sampledLineToward(const McdShape *shape, const double direction[3], McdLine *line, double *radius) {
    const McdSampled *s = shape->sampled;
    const MeProgramCall before = mcd_sampledEnter();
    double n[3], farthest[3] = {0, 0, 0};
    Choice c = {.flat = 0};
    mcd_sampledDirection(shape, direction, n);
    chooseLine(s, n, farthest, &c);
    const MeBool isAlong = c.isLine && !c.isBent && mcd_dot(c.line.normal, n) > 1 - wide * wide / 2;
    if (isAlong)
        *radius = radiusAcrossLine(s, &c.line);
    MeProgramLeave(&before);
    for (int i = 0; i < 2 && isAlong; i++)
        mcd_shapePoint(shape, c.line.end[i][0], c.line.end[i][1], c.line.end[i][2], line->end[i]);
    if (isAlong)
        mcd_shapeDirection(shape, c.line.normal[0], c.line.normal[1], c.line.normal[2], line->normal);
    return isAlong;
}

void mcd_sampledFace(const McdShape *s, const double direction[3], McdFace *f) {
    const MeProgramCall before = mcd_sampledEnter();
    findFace(s, direction, f);
    MeProgramLeave(&before);
}

/* ---- curvature --------------------------------------------------------------------------------------------------- */

/* m: the radius of curvature in a direction across the normal n; 0: there is a corner, or a flat face or line, at which
 * support points jump. */
static double smoothRadius(const McdSampled *s, const double n[3], const double across[3]) {
    static const double same = 1e-2; /* twice as much for what jumps */
    const double radius = radiusAcross(s, n, across, difference);
    return radius > difference * s->extent && fabs(radiusAcross(s, n, across, difference / 2) - radius) <= same * radius
               ? radius
               : 0;
}

/* rad/s: what turns more slowly does not roll: in 1/60 s less than the root of a double's rounding. What is at rest has
 * a spin of 1e-10 rad/s, and none asleep: its contacts are to stay the same. */
static const double slowestRolling = 1e-6;

/* The direction in which the contact moves over the surface as the shape turns; false: it does not turn. */
static MeBool rollingDirection(const McdShape *shape, const double outward[3], double across[3]) {
    double spin[3], moves[3];
    if (!shape->spin)
        return MEFALSE;
    mcd_fromReal(spin, shape->spin);
    mcd_cross(moves, outward, spin);
    const double speed = mcd_length(moves);
    if (!(speed > slowestRolling && speed < INFINITY))
        return MEFALSE;
    mcd_scale(moves, moves, 1 / speed);
    mcd_sampledDirection(shape, moves, across);
    return METRUE;
}

/* The radius of curvature in the direction in which the shape rolls; the mean one if it does not; across a line, if it
 * tilts over that. */
static double radiusAlong(const McdShape *shape, const double outward[3]) {
    const McdSampled *s = shape->sampled;
    McdFace face = {.count = 0};
    double n[3], u[3], w[3];
    if (s->features->isPolyhedron)
        return s->rounding;
    mcd_sampledDirection(shape, outward, n);
    mcd_basis(n, u, w);
    const MeBool rolls = rollingDirection(shape, outward, w);
    const double along = smoothRadius(s, n, w), across = rolls || along == 0 ? along : smoothRadius(s, n, u);
    if (across > 0)
        return s->rounding + (along + across) / 2;
    findFace(shape, outward, &face);
    return s->rounding +
           (face.count == 2 && mcd_dot(face.normal, outward) > 1 - wide * wide / 2 ? face.curvatureRadius : 0);
}

double mcd_sampledRadius(const McdShape *s, const double outward[3], const double point[3]) {
    const MeProgramCall before = mcd_sampledEnter();
    const double radius = radiusAlong(s, outward);
    MeProgramLeave(&before);
    (void)point;
    return radius;
}

double mcd_sampledRim(const McdShape *s, const double outward[3], const double point[3]) {
    double n[3];
    if (!s->sampled->features->hasDisc)
        return 0;
    const MeProgramCall before = mcd_sampledEnter();
    mcd_sampledDirection(s, outward, n);
    const MeBool isSmooth = isCurved(s->sampled, n);
    MeProgramLeave(&before);
    return isSmooth ? 0 : mcd_discsRim(s, outward, point);
}
