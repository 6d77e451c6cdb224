/* Position, depth and lever arms of a contact in each sub-step of a step.
 *
 * At the start of the step a contact is where collision detection found it, and the surface points p_k of the two
 * bodies lie half the depth on either side of it. In later sub-steps each point moves with its body, and
 * depth = n·(p_1 - p_0). The anchor is fixed in the body: it is the surface point, or, if the surface is round there,
 * the centre of the sphere or circle.
 */
#include "common/kea_anchor_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <float.h>

/* ---- the two sides ---- */

const MdtKeaTransformation *kea_sidePose(const MdtKeaSystem *s, const MdtKeaManifold *m, int k,
                                         MdtKeaTransformation *memory) {
    static const MdtKeaTransformation world = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
    if (m->body[k] >= 0)
        return &s->pose[m->body[k]];
    if (!m->mover)
        return &world;
    MdtKeaMoverPose(m->mover, s->parameters.late + s->parameters.elapsed, memory);
    return memory;
}

static const MdtKeaTransformation *poseOf(const MdtKeaSystem *s, const KeaContact *c, int k,
                                          MdtKeaTransformation *memory) {
    return kea_sidePose(s, c->manifold, k, memory);
}

const MdtKeaVelocity *kea_sideVelocity(const MdtKeaSystem *s, const MdtKeaManifold *m, int k) {
    static const MdtKeaVelocity still;
    return m->body[k] >= 0 ? &s->velocity[m->body[k]] : m->worldVelocity ? m->worldVelocity : &still;
}

static const MdtKeaVelocity *sideVelocityOf(const MdtKeaSystem *s, const KeaContact *c, int k) {
    return kea_sideVelocity(s, c->manifold, k);
}

void kea_armsTo(const MdtKeaSystem *s, const MdtKeaManifold *m, const double point[3], double arm[2][3]) {
    MdtKeaTransformation memory;
    for (int k = 0; k < 2; k++)
        keaSubtract(arm[k], point, kea_sidePose(s, m, k, &memory)->pos);
}

MeBool kea_isManifoldTied(const MdtKeaSystem *s, const MdtKeaManifold *m) {
    for (int k = 0; k < 2; k++)
        if (m->body[k] >= 0 && s->work->body[m->body[k]].isTied)
            return METRUE;
    return MEFALSE;
}

static MeBool isWorld(const KeaContact *c, int k) {
    return c->manifold->body[k] < 0;
}

/* Whether the side stays where it is, though its surface may move (conveyor belt). */
static MeBool isPlaced(const KeaContact *c, int k) {
    return isWorld(c, k) && !c->manifold->mover;
}

/* Whether the contact point is a feature of this side: the farthest point of a sphere or circle, or a vertex. */
static MeBool isOwner(const KeaContact *c, int k) {
    return c->manifold->radius[k] > 0 || c->circle[k] > 0 || c->isVertex[k];
}

/* ---- the depth ---- */

/* m: the sag of the contact under the last step's force, h² E λ / γ. */
static double depthUnderLoad(const MdtKeaSystem *s, const KeaContact *c) {
    const MdtKeaParameters *p = &s->parameters;
    const double E = p->epsilon + p->softening * c->manifold->surface.softness;
    MEASSERT(E >= 0);
    return p->gamma > 0 ? p->stepsize * p->stepsize * E * fmax(c->at->guess[0], 0) / p->gamma : 0;
}

/* m: the depth nearest to the depth at rest, within the rounding error of the depth that collision gave. That has the
 * rounding of the transforms that it was computed from, projected on the normal, which would move resting bodies, so
 * that the last step's answer would not fit this step. At rest the depth is 0, or the sag under load if that is less
 * than the rounding: with 0 a soft contact would sink by h E λ a second until its depth exceeds the rounding. */
static double depthWithinRounding(const MdtKeaSystem *s, const KeaContact *c) {
    const double *n = c->manifold->normal, depth = c->at->depth;
    double extent = 0;
    for (int k = 0; k < 2; k++) {
        MdtKeaTransformation memory;
        const double *place = poseOf(s, c, k, &memory)->pos;
        double arm[3], across[3];
        if (isPlaced(c, k))
            continue;
        keaSubtract(arm, c->at->position, place);
        keaCross(across, arm, n);
        extent += keaLength(across);
        for (int i = 0; i < 3; i++)
            extent += fabs(n[i] * place[i]);
    }
    const double rounding = kea_poseRounding * extent, sunk = depthUnderLoad(s, c);
    return fmin(fmax(sunk <= rounding ? sunk : 0, depth - rounding), depth + rounding);
}

/* ---- centres of curvature ---- */

/* r += share (cay(φ) r - r), with cay(φ) r - r = (φ x r + φ x (φ x r) / 2) / (1 + φ²/4), the rotation of bodies. */
static void turnBy(const double turn[3], double share, double r[3]) {
    const double halfAngleFactor = share / (1 + keaDot(turn, turn) / 4);
    double once[3], twice[3];
    keaCross(once, turn, r);
    keaCross(twice, turn, once);
    keaAddScaled(r, halfAngleFactor, once);
    keaAddScaled(r, 0.5 * halfAngleFactor, twice);
}

/* Displacement, m, and rotation vector, rad, of a side in this sub-step. */
static void motionOf(const MdtKeaSystem *s, const KeaContact *c, int k, const double move[6], double displacement[3],
                     double turn[3]) {
    const double h = isPlaced(c, k) ? 0 : s->parameters.stepsize;
    const MdtKeaVelocity *given = isWorld(c, k) ? sideVelocityOf(s, c, k) : NULL;
    keaScale(displacement, h, given ? given->lin : move);
    keaScale(turn, h, given ? given->ang : move + 3);
}

/* The axis of the circle or line (world); 0 without one. */
static void circleAxisOf(const MdtKeaSystem *s, const KeaContact *c, int k, double axis[3]) {
    MdtKeaTransformation memory;
    if (c->circle[k] > 0 || c->isLine[k])
        keaApply(axis, poseOf(s, c, k, &memory)->R, c->circleAxis[k]);
    else
        keaZero(axis);
}

/* Where a point of a side is after a share of the sub-step: its anchor, and `out` from there. */
static void movePoint(const MdtKeaSystem *s, const KeaContact *c, int k, const double move[6], double share,
                      const double out[3], double at[3]) {
    MdtKeaTransformation memory;
    const MdtKeaTransformation *pose = poseOf(s, c, k, &memory);
    double displacement[3], turn[3];
    motionOf(s, c, k, move, displacement, turn);
    keaApply(at, pose->R, c->anchor[k]);
    turnBy(turn, share, at);
    keaAddScaled(at, 1, out);
    keaAddScaled(at, 1, pose->pos);
    keaAddScaled(at, share, displacement);
}

/* The line of the centres of curvature after a share of the sub-step, from the second side to the first. What is round
 * about a line, such as a cylinder or an edge, has its centre where that is nearest to the other one's. move: null at
 * share 0. */
static void lineOfCentres(const MdtKeaSystem *s, const KeaContact *c, const double move[2][6], double share,
                          double line[3]) {
    static const double centre[3], still[2][6];
    const double(*moves)[6] = move ? move : still;
    double other[3];
    movePoint(s, c, 0, moves[0], share, centre, line);
    movePoint(s, c, 1, moves[1], share, centre, other);
    keaSubtract(line, line, other);
    for (int k = 0; k < 2; k++) {
        double displacement[3], turn[3], axis[3];
        if (!c->isLine[k])
            continue;
        motionOf(s, c, k, moves[k], displacement, turn);
        circleAxisOf(s, c, k, axis);
        turnBy(turn, share, axis);
        keaAddScaled(line, -keaDot(line, axis), axis);
    }
}

/* The rotation from one direction to another: a = u x v and u·v of the unit vectors. */
static double turnBetween(const double from[3], const double to[3], double a[3]) {
    const double perLengths = 1 / (keaLength(from) * keaLength(to));
    keaCross(a, from, to);
    keaScale(a, perLengths, a);
    return keaDot(from, to) * perLengths;
}

/* Turns d by that rotation, d + a x d + a x (a x d) / (1 + u·v). False: the centres have passed each other. */
static MeBool turnAlong(const double a[3], double along, double d[3]) {
    double once[3], twice[3];
    if (!(along > 0))
        return MEFALSE;
    keaCross(once, a, d);
    keaCross(twice, a, once);
    keaAddScaled(d, 1, once);
    keaAddScaled(d, 1 / (1 + along), twice);
    return METRUE;
}

/* m: the radius of the circle that touches; 0 if its axis may become parallel to the normal within the sub-step. A
 * circle that lies flat has no farthest point, and close to that the farthest point moves far along the circle. */
static double circleOf(const MdtKeaSystem *s, const MdtKeaManifold *m, int k) {
    double aside[3], turn[3];
    if (!(m->rim[k] > 0))
        return 0;
    keaCross(aside, m->axis[k], m->normal);
    keaCross(turn, m->axis[k], kea_sideVelocity(s, m, k)->ang);
    return keaLength(aside) > s->parameters.stepsize * keaLength(turn) ? m->rim[k] : 0;
}

/* Whether the surface is round about a line at right angles to the normal: the side of a cylinder or capsule, an edge.
 */
static MeBool isLine(const MdtKeaManifold *m, int k) {
    return keaDot(m->axis[k], m->axis[k]) > 0 && fabs(keaDot(m->axis[k], m->normal)) < kea_lineCosine;
}

/* m: the radius of curvature of a side; negative: it has no centre, as a face, or a rim that is not at right angles to
 * the normal. */
static double centreRadius(const MdtKeaSystem *s, const MdtKeaManifold *m, const MdtKeaPoint *at, int k) {
    if (m->rim[k] > 0)
        return isLine(m, k) && circleOf(s, m, k) > 0 ? m->rim[k] : -1;
    return m->radius[k] > 0 || at->isVertex[k] || isLine(m, k) ? m->radius[k] : -1;
}

/* Whether the normal is the line of the centres of curvature of both sides. */
static MeBool haveCentres(const MdtKeaSystem *s, const KeaContact *c) {
    const double a = centreRadius(s, c->manifold, c->at, 0), b = centreRadius(s, c->manifold, c->at, 1);
    return a >= 0 && b >= 0 && a + b > 0;
}

/* ---- anchors, at the start of the step ---- */

/* The vector `out` from the anchor to the surface point, with o the outward normal: r o for a sphere; for a circle with
 * the axis a, to its farthest point along o, r (o - a (a·o)) / |..|, or 0 if it lies flat; 0 for corners, edges and
 * faces. */
static void offsetToSurface(const KeaContact *c, int k, const double axis[3], const double normal[3], double out[3]) {
    double outward[3];
    keaScale(outward, k == 0 ? -1 : 1, normal);
    MdtKeaOffsetToSurface(c->manifold->radius[k], c->circle[k], axis, outward, out);
}

void MEAPI MdtKeaOffsetToSurface(double radius, double rim, const double axis[3], const double outward[3],
                                 double offset[3]) {
    keaCopy(offset, outward);
    if (rim > 0) {
        keaAddScaled(offset, -keaDot(offset, axis) / keaDot(axis, axis), axis);
        keaScale(offset, rim / fmax(keaLength(offset), DBL_MIN), offset);
    } else {
        keaScale(offset, radius, offset);
    }
}

/* Whether the surface is spherical about the body's centre of mass. */
static MeBool isAboutCentre(const KeaContact *c, int k) {
    return c->manifold->radius[k] > 0 && !(c->circle[k] > 0) &&
           keaLength(c->anchor[k]) <= kea_centredBall * c->manifold->radius[k];
}

static void setAnchors(const MdtKeaSystem *s, KeaContact *c) {
    const double *normal = c->manifold->normal;
    keaCopy(c->normal, normal);
    keaCopy(c->direction, c->manifold->direction);
    keaCopy(c->point, c->at->position);
    c->depth = depthWithinRounding(s, c);
    MEASSERT(fabs(keaDot(normal, normal) - 1) < kea_unitRounding && isfinite(c->depth));
    for (int k = 0; k < 2; k++) {
        MdtKeaTransformation memory;
        const MdtKeaTransformation *pose = poseOf(s, c, k, &memory);
        double arm[3], out[3];
        c->circle[k] = circleOf(s, c->manifold, k);
        offsetToSurface(c, k, c->manifold->axis[k], c->normal, out);
        keaSubtract(arm, c->point, pose->pos);
        keaAddScaled(arm, (k == 0 ? -1 : 1) * 0.5 * c->depth, normal);
        keaAddScaled(arm, -1, out);
        keaApplyTransposed(c->anchor[k], pose->R, arm);
        c->isLine[k] = isLine(c->manifold, k);
        if (c->circle[k] > 0 || c->isLine[k])
            keaApplyTransposed(c->circleAxis[k], pose->R, c->manifold->axis[k]);
        c->isAboutCentre[k] = isAboutCentre(c, k);
    }
    c->hasCentres = haveCentres(s, c);
    if (c->hasCentres)
        lineOfCentres(s, c, NULL, 0, c->line);
}

/* ---- later sub-steps ---- */

/* The side whose surface point the contact follows while the bodies slide: a round surface before a flat one, a body
 * before the world; else the mean of both. */
enum { BOTH = 2 };
static int sideToFollow(const KeaContact *c) {
    if (isOwner(c, 0) != isOwner(c, 1))
        return isOwner(c, 0) ? 0 : 1;
    return isWorld(c, 1) ? 0 : isWorld(c, 0) ? 1 : BOTH;
}

/* The normal of two surfaces with centres of curvature is the line of these. */
static void turnNormal(const MdtKeaSystem *s, KeaContact *c) {
    double line[3], a[3];
    lineOfCentres(s, c, NULL, 0, line);
    const double along = turnBetween(c->line, line, a);
    if (!turnAlong(a, along, c->normal))
        return;
    turnAlong(a, along, c->direction);
    keaCopy(c->line, line);
    MEASSERT(fabs(keaDot(c->direction, c->direction) - 1) < kea_unitRounding);
}

static void moveWithBodies(const MdtKeaSystem *s, KeaContact *c) {
    const int owner = sideToFollow(c);
    double p[2][3], between[3];
    if (c->hasCentres)
        turnNormal(s, c);
    for (int k = 0; k < 2; k++) {
        MdtKeaTransformation memory;
        const MdtKeaTransformation *pose = poseOf(s, c, k, &memory);
        double axis[3], out[3];
        circleAxisOf(s, c, k, axis);
        offsetToSurface(c, k, axis, c->normal, out);
        keaApply(p[k], pose->R, c->anchor[k]);
        keaAddScaled(p[k], 1, pose->pos);
        keaAddScaled(p[k], 1, out);
    }
    keaSubtract(between, p[1], p[0]);
    c->depth = keaDot(c->normal, between);
    for (int i = 0; i < 3; i++) {
        const double offset = 0.5 * c->depth * c->normal[i];
        const double on[2] = {p[0][i] + offset, p[1][i] - offset};
        c->point[i] = owner == BOTH ? 0.5 * (on[0] + on[1]) : on[owner];
    }
}

/* ---- motion of the contact point within a sub-step ----
 *
 * It follows from the velocities with which the bodies move during the sub-step, (h v, h w): those of the present
 * iterate in the exact solver's first passes, predicted ones in the fast solver. */

void kea_contactTurnDirection(const MdtKeaSystem *s, const KeaContact *c, const double move[2][6], double share,
                              double d[3]) {
    double line[3], a[3];
    if (!c->followsCentres) {
        turnBy(c->faceTurn, share, d);
        return;
    }
    lineOfCentres(s, c, move, share, line);
    const double along = turnBetween(c->line, line, a);
    turnAlong(a, along, d);
}

/* The contact point p of the side that owns it after a share of the sub-step. */
static void pointOfOwner(const MdtKeaSystem *s, const KeaContact *c, int k, const double move[2][6], double share,
                         double p[3]) {
    double displacement[3], turn[3], axis[3], normal[3], out[3];
    motionOf(s, c, k, move[k], displacement, turn);
    circleAxisOf(s, c, k, axis);
    turnBy(turn, share, axis);
    keaCopy(normal, c->normal);
    kea_contactTurnDirection(s, c, move, share, normal);
    offsetToSurface(c, k, axis, normal, out);
    keaAddScaled(out, (k == 0 ? 0.5 : -0.5) * c->depth, normal);
    movePoint(s, c, k, move[k], share, out, p);
}

/* Lever arms of a rolling contact. A flat surface uses the point of the round one. Of two round ones each has its own
 * point, if these stay on the line of centres; else both use the middle of these, as forces that act along two lines
 * would turn a closed system. */
static void rollArms(const MdtKeaSystem *s, const KeaContact *c, const double move[2][6], double share,
                     double arm[2][3]) {
    double p[2][3];
    for (int k = 0; k < 2; k++)
        pointOfOwner(s, c, isOwner(c, k) ? k : 1 - k, move, share, p[k]);
    for (int k = 0; k < 2; k++) {
        MdtKeaTransformation memory;
        double displacement[3], turn[3];
        motionOf(s, c, k, move[k], displacement, turn);
        keaSubtract(arm[k], p[k], poseOf(s, c, k, &memory)->pos);
        if (!c->followsCentres) {
            double between[3];
            keaSubtract(between, p[1 - k], p[k]);
            keaAddScaled(arm[k], 0.5, between);
        }
        keaAddScaled(arm[k], -share, displacement);
    }
}

/* Whether the lever arm of this side is constant: the side is a world that does not rotate, or a sphere about the
 * body's centre of mass. */
static MeBool isArmConstant(const MdtKeaSystem *s, const KeaContact *c, int k) {
    const double *spin = sideVelocityOf(s, c, k)->ang;
    if (isWorld(c, k) && keaDot(spin, spin) == 0)
        return METRUE;
    return c->isAboutCentre[k];
}

/* The arm from the axis of rotation, which goes through the body's centre or, for a world that moves with v at
 * the origin and rotates with w, through w x v / w². */
static void armFromAxis(const MdtKeaSystem *s, const KeaContact *c, int k, double r[3]) {
    const MdtKeaVelocity *v = sideVelocityOf(s, c, k);
    const double w2 = keaDot(v->ang, v->ang);
    keaCopy(r, c->arm[k]);
    if (isPlaced(c, k) && w2 > 0) {
        double place[3];
        keaCross(place, v->ang, v->lin);
        keaAddScaled(r, -1 / w2, place);
    }
}

/* Chooses the rotation c->turn of a contact of flat surfaces. It is not known which features touch: a corner turns with
 * its body, an edge that another one slides along does not. The contact certainly turns with a rotation that both sides
 * have in common; the rotation of the side that displaces the contact less stands for it. False: the rotation is so
 * small that half of its square is lost in rounding. */
static MeBool findSharedTurn(const MdtKeaSystem *s, KeaContact *c) {
    const double h = s->parameters.stepsize, min = kea_minTurn;
    const double *spin[2] = {sideVelocityOf(s, c, 0)->ang, sideVelocityOf(s, c, 1)->ang};
    double distance2[2] = {0, 0}, size2 = 0;
    if (h * keaLength(spin[0]) <= min || h * keaLength(spin[1]) <= min)
        return MEFALSE;
    for (int k = 0; k < 2; k++) {
        double r[3], speed[3];
        armFromAxis(s, c, k, r);
        size2 += keaDot(r, r);
        for (int side = 0; side < 2; side++) {
            keaCross(speed, spin[side], r);
            distance2[side] += h * h * keaDot(speed, speed);
        }
    }
    const int less = distance2[1] <= distance2[0];
    keaScale(c->turn, h, spin[less]);
    return distance2[less] > min * min * size2;
}

static void turnArms(const MdtKeaSystem *s, const KeaContact *c, double share, double arm[2][3]) {
    for (int k = 0; k < 2; k++) {
        double r[3], turned[3];
        armFromAxis(s, c, k, r);
        keaCopy(turned, r);
        turnBy(c->turn, share, turned);
        keaSubtract(r, turned, r);
        keaCopy(arm[k], c->arm[k]);
        keaAddScaled(arm[k], 1, r);
    }
}

/* Whether vertices move with their bodies: these rotate relative to each other, and no joint constrains them. With
 * joints, passes under heavy loads would not converge, and contacts are of first order anyway, as they are met by
 * θ = 1. */
static MeBool doVerticesMove(const MdtKeaSystem *s, const KeaContact *c) {
    double relative[3];
    keaSubtract(relative, sideVelocityOf(s, c, 0)->ang, sideVelocityOf(s, c, 1)->ang);
    return !kea_isManifoldTied(s, c->manifold) && s->parameters.stepsize * keaLength(relative) > kea_minTurn;
}

static MeBool hasOwner(const KeaContact *c) {
    return isOwner(c, 0) || isOwner(c, 1);
}

/* Finds the rotation of the face on which a contact lies, if it is a mover's: a round side or a vertex has no face.
 * Without it what a drum carries along would leave the circle by its motion relative to the drum, times h w, and be
 * pushed along the normals of the start, which drives it on. Returns whether directions turn. */
static MeBool findFaceTurn(const MdtKeaSystem *s, KeaContact *c) {
    double across[3];
    keaZero(c->faceTurn);
    for (int k = 0; k < 2; k++)
        if (isWorld(c, k) && !isPlaced(c, k) && !isOwner(c, k))
            keaScale(c->faceTurn, s->parameters.stepsize, sideVelocityOf(s, c, k)->ang);
    keaCross(across, c->faceTurn, c->normal);
    if (keaLength(across) > kea_minTurn)
        return METRUE;
    keaZero(c->faceTurn);
    return MEFALSE;
}

/* Whether the line of centres turns: they move rather across it than along it, which a blow stops. Not with joints, as
 * vertices. */
static MeBool doCentresTurn(const MdtKeaSystem *s, const KeaContact *c) {
    double move[2][6], line[3], a[3], moved[3];
    if (!c->hasCentres || kea_isManifoldTied(s, c->manifold))
        return MEFALSE;
    for (int k = 0; k < 2; k++) {
        keaCopy(move[k], sideVelocityOf(s, c, k)->lin);
        keaCopy(move[k] + 3, sideVelocityOf(s, c, k)->ang);
    }
    lineOfCentres(s, c, (const double(*)[6])move, 1, line);
    turnBetween(c->line, line, a);
    keaSubtract(moved, line, c->line);
    const double across = keaLength(a) * keaLength(line);
    return keaLength(a) > kea_minNormalTurn && across > fabs(keaDot(moved, c->normal));
}

void kea_contactChooseMotion(const MdtKeaSystem *s, KeaContact *c) {
    const MeBool areVertices = doVerticesMove(s, c);
    keaZero(c->turn);
    for (int k = 0; k < 2; k++)
        c->isVertex[k] = c->at->isVertex[k] && areVertices;
    const MeBool turns = findFaceTurn(s, c);
    c->followsCentres = doCentresTurn(s, c);
    c->rolls = c->followsCentres || (hasOwner(c) && (!isArmConstant(s, c, 0) || !isArmConstant(s, c, 1)));
    c->moves = c->rolls || (!hasOwner(c) && findSharedTurn(s, c)) || turns;
}

void kea_contactPlaceAtStart(const MdtKeaSystem *s, KeaContact *c) {
    setAnchors(s, c);
    kea_armsTo(s, c->manifold, c->point, c->arm);
}

void kea_contactPlace(const MdtKeaSystem *s, KeaContact *c) {
    if (s->parameters.elapsed > 0)
        moveWithBodies(s, c);
    else
        setAnchors(s, c);
    kea_armsTo(s, c->manifold, c->point, c->arm);
}

void kea_contactArms(const MdtKeaSystem *s, const KeaContact *c, const double move[2][6], double share,
                     double arm[2][3]) {
    MEASSERT(c->moves);
    MEASSERT(share >= 0 && share <= 1);
    if (hasOwner(c))
        rollArms(s, c, move, share, arm);
    else
        turnArms(s, c, share, arm);
}

double kea_contactBend(const MdtKeaSystem *s, const KeaContact *c, const double move[2][6]) {
    double bend = 0;
    for (int k = 0; k < 2; k++) {
        MdtKeaTransformation memory;
        double displacement[3], turn[3], start[3], end[3], straight[3];
        if (!isOwner(c, k))
            continue;
        motionOf(s, c, k, move[k], displacement, turn);
        pointOfOwner(s, c, k, move, 0, start);
        pointOfOwner(s, c, k, move, 1, end);
        keaSubtract(end, end, start);
        keaAddScaled(end, -1, displacement);
        keaSubtract(start, start, poseOf(s, c, k, &memory)->pos);
        keaAddScaled(start, 0.5, end);
        keaCross(straight, turn, start);
        keaSubtract(end, end, straight);
        bend += (k == 0 ? 1 : -1) * keaDot(c->normal, end);
    }
    return bend;
}
