/* Where a contact is.
 *
 * As a step begins it is where its maker found it, and the surface points p_k of the two bodies lie half the depth on
 * either side. Within a divided step they move with their bodies: depth = n·(p_1 - p_0). What moves with a body is that
 * point, or, of a round surface, the centre of its sphere or circle.
 */
#include "exact/kea_contact_i.h"
#include "MeAssert.h"
#include "common/kea_policy_i.h"
#include <float.h>

/* ---- the two sides ---- */

static const MdtKeaTransformation *poseOf(const MdtKeaSystem *s, const KeaContact *c, int k) {
    static const MdtKeaTransformation world = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
    return c->manifold->body[k] >= 0 ? &s->pose[c->manifold->body[k]] : &world;
}

static const MdtKeaVelocity *velocityOf(const MdtKeaSystem *s, const KeaContact *c, int k) {
    static const MdtKeaVelocity still;
    const MdtKeaManifold *m = c->manifold;
    return m->body[k] >= 0 ? &s->velocity[m->body[k]] : m->worldVelocity ? m->worldVelocity : &still;
}

static MeBool isWorld(const KeaContact *c, int k) {
    return c->manifold->body[k] < 0;
}

static MeBool isRound(const KeaContact *c, int k) {
    return c->manifold->radius[k] > 0 || c->circle[k] > 0;
}

/* ---- the depth ---- */

/* m: the depth at which the last step's force holds the contact still, h² E λ / γ. */
static double depthUnderLoad(const MdtKeaSystem *s, const KeaContact *c) {
    const MdtKeaParameters *p = &s->parameters;
    const double E = p->epsilon + p->softening * c->manifold->surface.softness;
    return p->gamma > 0 ? p->stepsize * p->stepsize * E * fmax(c->at->guess[0], 0) / p->gamma : 0;
}

/* The depth, or gap, is known but for the rounding of the transforms that it was found from, as far as that moves the
 * surfaces along the normal: the noise of each step would else move what rests, and the last answer would not hold. Of
 * the depths that it may be, the one nearest to rest is taken: 0, or what the load has sunk by, if that is less than
 * the rounding. With 0 it would go on sinking, by h E λ a second, until the rounding is passed. */
static double beyondRounding(const MdtKeaSystem *s, const KeaContact *c) {
    const double *n = c->normal, depth = c->at->depth;
    double extent = 0;
    for (int k = 0; k < 2; k++) {
        const double *place = poseOf(s, c, k)->pos;
        double arm[3], across[3];
        if (isWorld(c, k))
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

/* ---- attached ---- */

/* From what moves with the body to the surface point, with the outward normal o: of a sphere r o; of a circle about
 * the axis a the way to its point farthest along o, r (o - a (a·o)) / |..|, none where it lies flat; of corners, edges
 * and faces, which move with the body themselves, 0. */
static void outOfCentre(const KeaContact *c, int k, const double axis[3], double out[3]) {
    keaScale(out, k == 0 ? -1 : 1, c->normal);
    if (c->circle[k] > 0) {
        keaAddScaled(out, -keaDot(out, axis) / keaDot(axis, axis), axis);
        keaScale(out, c->circle[k] / fmax(keaLength(out), DBL_MIN), out);
    } else {
        keaScale(out, c->manifold->radius[k], out);
    }
}

/* Is it round about the body's own centre? */
static MeBool isAboutCentre(const KeaContact *c, int k) {
    return c->manifold->radius[k] > 0 && !(c->circle[k] > 0) &&
           keaLength(c->anchor[k]) <= kea_centredBall * c->manifold->radius[k];
}

/* The circle that touches, if the part of the step cannot bring its axis to the normal: there it would lie flat, no
 * point of it would be farthest out, and the one that is, near that, would go far round it. */
static double circleOf(const MdtKeaSystem *s, const KeaContact *c, int k) {
    const double *axis = c->manifold->axis[k];
    double aside[3], turn[3];
    keaCross(aside, axis, c->normal);
    keaCross(turn, axis, velocityOf(s, c, k)->ang);
    return keaLength(aside) > s->parameters.stepsize * keaLength(turn) ? c->manifold->rim[k] : 0;
}

static void attach(const MdtKeaSystem *s, KeaContact *c) {
    const double *normal = c->manifold->normal;
    keaCopy(c->normal, normal);
    keaCopy(c->direction, c->manifold->direction);
    keaCopy(c->point, c->at->position);
    c->depth = beyondRounding(s, c);
    MEASSERT(fabs(keaDot(normal, normal) - 1) < kea_unitRounding && isfinite(c->depth));
    for (int k = 0; k < 2; k++) {
        const MdtKeaTransformation *pose = poseOf(s, c, k);
        double arm[3], out[3];
        c->circle[k] = c->manifold->rim[k] > 0 ? circleOf(s, c, k) : 0;
        outOfCentre(c, k, c->manifold->axis[k], out);
        keaSubtract(arm, c->point, pose->pos);
        keaAddScaled(arm, (k == 0 ? -1 : 1) * 0.5 * c->depth, normal);
        keaAddScaled(arm, -1, out);
        keaApplyTransposed(c->anchor[k], pose->R, arm);
        if (c->circle[k] > 0)
            keaApplyTransposed(c->axle[k], pose->R, c->manifold->axis[k]);
    }
}

/* ---- carried along ---- */

/* Whose point it is where the bodies slide past each other: that of a round surface rather than another, of a body
 * rather than the world's. */
enum { BOTH = 2 };
static int ownerOf(const KeaContact *c) {
    if (isRound(c, 0) != isRound(c, 1))
        return isRound(c, 0) ? 0 : 1;
    return isWorld(c, 1) ? 0 : isWorld(c, 0) ? 1 : BOTH;
}

/* Of its circle; 0: there is none. */
static void axisOf(const MdtKeaSystem *s, const KeaContact *c, int k, double axis[3]) {
    if (c->circle[k] > 0)
        keaApply(axis, poseOf(s, c, k)->R, c->axle[k]);
    else
        keaZero(axis);
}

/* Is the surface a ball's about its body's centre? A sphyl's is round, too, but moments tell them apart. */
static MeBool isBall(const MdtKeaSystem *s, const KeaContact *c, int k) {
    const double *I = isWorld(c, k) ? NULL : s->bodies[c->manifold->body[k]]->moments;
    const double most = I ? kea_equalMoments * I[0] : 0;
    return I && isAboutCentre(c, k) && fabs(I[1] - I[0]) <= most && fabs(I[2] - I[0]) <= most;
}

/* Two balls touch along the line of their centres, wherever these have come to. */
static void renewNormal(const MdtKeaSystem *s, KeaContact *c) {
    double n[3], d[3];
    keaSubtract(n, poseOf(s, c, 0)->pos, poseOf(s, c, 1)->pos);
    keaCopy(d, c->direction);
    const double distance = keaLength(n);
    if (!(distance > 0))
        return;
    keaScale(n, 1 / distance, n);
    keaAddScaled(d, -keaDot(d, n), n);
    const double across = keaLength(d);
    if (!(across > 0.5)) /* turned by more than the part of a step that follows can mean */
        return;
    keaCopy(c->normal, n);
    keaScale(c->direction, 1 / across, d);
}

static void carry(const MdtKeaSystem *s, KeaContact *c) {
    const int owner = ownerOf(c);
    double p[2][3], between[3];
    if (isBall(s, c, 0) && isBall(s, c, 1))
        renewNormal(s, c);
    for (int k = 0; k < 2; k++) {
        const MdtKeaTransformation *pose = poseOf(s, c, k);
        double axis[3], out[3];
        axisOf(s, c, k, axis);
        outOfCentre(c, k, axis, out);
        keaApply(p[k], pose->R, c->anchor[k]);
        keaAddScaled(p[k], 1, pose->pos);
        keaAddScaled(p[k], 1, out);
    }
    keaSubtract(between, p[1], p[0]);
    c->depth = keaDot(c->normal, between);
    for (int i = 0; i < 3; i++) {
        const double off = 0.5 * c->depth * c->normal[i];
        const double on[2] = {p[0][i] + off, p[1][i] - off};
        c->point[i] = owner == BOTH ? 0.5 * (on[0] + on[1]) : on[owner];
    }
}

/* ---- how the place moves within a part of the step ----
 *
 * As with the velocities that the bodies have at its start: by (h v, h w), known before the rows are solved, so that
 * they are the same in all passes. What loads and impulses of this step change is of the next order. */

/* cay(φ) r - r = (φ x r + φ x (φ x r) / 2) / (1 + φ²/4), as bodies turn. */
static void turnBy(const double turn[3], double share, double r[3]) {
    const double part = share / (1 + keaDot(turn, turn) / 4);
    double once[3], twice[3];
    keaCross(once, turn, r);
    keaCross(twice, turn, once);
    keaAddScaled(r, part, once);
    keaAddScaled(r, 0.5 * part, twice);
}

/* A fixed model stays where it is, even where its surface moves. */
static void movedBy(const MdtKeaSystem *s, const KeaContact *c, int k, double way[3], double turn[3]) {
    const double h = isWorld(c, k) ? 0 : s->parameters.stepsize;
    keaScale(way, h, velocityOf(s, c, k)->lin);
    keaScale(turn, h, velocityOf(s, c, k)->ang);
}

/* The point that a round surface touches with. */
static void roundPoint(const MdtKeaSystem *s, const KeaContact *c, int k, double share, double p[3]) {
    const MdtKeaTransformation *pose = poseOf(s, c, k);
    double way[3], turn[3], axis[3], out[3];
    movedBy(s, c, k, way, turn);
    axisOf(s, c, k, axis);
    turnBy(turn, share, axis);
    outOfCentre(c, k, axis, out);
    keaApply(p, pose->R, c->anchor[k]);
    turnBy(turn, share, p);
    keaAddScaled(p, 1, out);
    keaAddScaled(p, (k == 0 ? 0.5 : -0.5) * c->depth, c->normal);
    keaAddScaled(p, 1, pose->pos);
    keaAddScaled(p, share, way);
}

/* A flat surface touches where the round one does; of two round ones each has its own point. */
static void rollArms(const MdtKeaSystem *s, const KeaContact *c, double share, double arm[2][3]) {
    for (int k = 0; k < 2; k++) {
        double p[3], way[3], turn[3];
        roundPoint(s, c, isRound(c, k) ? k : 1 - k, share, p);
        movedBy(s, c, k, way, turn);
        keaSubtract(arm[k], p, poseOf(s, c, k)->pos);
        keaAddScaled(arm[k], -share, way);
    }
}

/* Does the arm of this side stay as it is: of a world that does not turn, of a ball about its own centre? */
static MeBool isStill(const MdtKeaSystem *s, const KeaContact *c, int k) {
    const double *spin = velocityOf(s, c, k)->ang;
    if (isWorld(c, k) && keaDot(spin, spin) == 0)
        return METRUE;
    return isAboutCentre(c, k);
}

/* From what a side turns about to the contact: the body's centre, or, where the world moves with v at the origin and
 * turns with w, the axis through w x v / w². */
static void fromAxis(const MdtKeaSystem *s, const KeaContact *c, int k, double r[3]) {
    const MdtKeaVelocity *v = velocityOf(s, c, k);
    const double w2 = keaDot(v->ang, v->ang);
    keaCopy(r, c->arm[k]);
    if (isWorld(c, k) && w2 > 0) {
        double place[3];
        keaCross(place, v->ang, v->lin);
        keaAddScaled(r, -1 / w2, place);
    }
}

/* What of flat surfaces turns is not known: a corner turns with its body, an edge that another one slides along does
 * not. What holds for all is that a contact turns by what both sides turn, taken to be the turn of the side that moves
 * it less. False: that is so little that its square, over 2, is lost in rounding. */
static MeBool findSharedTurn(const MdtKeaSystem *s, KeaContact *c) {
    const double h = s->parameters.stepsize, least = kea_leastTurn;
    const double *spin[2] = {velocityOf(s, c, 0)->ang, velocityOf(s, c, 1)->ang};
    double way2[2] = {0, 0}, size2 = 0;
    if (h * keaLength(spin[0]) <= least || h * keaLength(spin[1]) <= least)
        return MEFALSE;
    for (int k = 0; k < 2; k++) {
        double r[3], speed[3];
        fromAxis(s, c, k, r);
        size2 += keaDot(r, r);
        for (int side = 0; side < 2; side++) {
            keaCross(speed, spin[side], r);
            way2[side] += h * h * keaDot(speed, speed);
        }
    }
    const int less = way2[1] <= way2[0];
    keaScale(c->turn, h, spin[less]);
    return way2[less] > least * least * size2;
}

static void turnArms(const MdtKeaSystem *s, const KeaContact *c, double share, double arm[2][3]) {
    for (int k = 0; k < 2; k++) {
        double r[3], turned[3];
        fromAxis(s, c, k, r);
        keaCopy(turned, r);
        turnBy(c->turn, share, turned);
        keaSubtract(r, turned, r);
        keaCopy(arm[k], c->arm[k]);
        keaAddScaled(arm[k], 1, r);
    }
}

static MeBool rolls(const KeaContact *c) {
    return isRound(c, 0) || isRound(c, 1);
}

void kea_contactPlace(const MdtKeaSystem *s, KeaContact *c) {
    if (s->parameters.elapsed > 0)
        carry(s, c);
    else
        attach(s, c);
    keaZero(c->turn);
    for (int k = 0; k < 2; k++)
        keaSubtract(c->arm[k], c->point, poseOf(s, c, k)->pos);
    c->moves = rolls(c) ? !isStill(s, c, 0) || !isStill(s, c, 1) : findSharedTurn(s, c);
}

void kea_contactArms(const MdtKeaSystem *s, const KeaContact *c, double share, double arm[2][3]) {
    MEASSERT(c->moves);
    if (rolls(c))
        rollArms(s, c, share, arm);
    else
        turnArms(s, c, share, arm);
}
