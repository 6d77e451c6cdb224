/* Contacts that will be needed before the next test.
 *
 * The contacts of a test are those of the faces at its time. A body that lands turns until the next one, by its spin
 * and by the impact, and sets down corners beside that face: with w h = .4 a flat hull of 16 points would overlap by
 * 40 % of its thickness. So the motion is predicted: both shapes move as they do now, and gravity changes that; then
 * pushes at the contacts, as small as possible (Gauss's principle), keep those apart. Of all places where the shapes
 * may touch (mcd_skin.c) the one that then overlaps most becomes a contact, until there is none. Pushes are found by
 * projected Gauss-Seidel. Masses and inertia are those of solids of one density with the spread of the corners; what
 * else acts on the bodies is not known here. */
#include "convex/mcd_landing_i.h"
#include "convex/mcd_kind_i.h"
#include "convex/mcd_spread_i.h"
#include <string.h>

MeBool mcd_landingForecast(McdReach reach, McdForecast *f) {
    if (!reach.forecast || !(reach.approach > 0))
        return MEFALSE;
    reach.forecast(&reach, f);
    return f->course[0].isFree || f->course[1].isFree;
}

/* m: by how much a shape moves along the normal. */
static double shiftAlong(const McdForecast *f, int k, const double normal[3]) {
    const McdCourse *c = &f->course[k];
    return mcd_dot(c->shift, normal) + (c->isFree ? mcd_dot(f->fall, normal) : 0);
}

/* m: by how much both come nearer without a turn. */
static double approachAlong(const McdForecast *f, const double normal[3]) {
    return fmax(shiftAlong(f, 1, normal) - shiftAlong(f, 0, normal), 0);
}

/* rad: by how much a turn tilts a shape out of the contact plane. */
static double tiltBy(const double turn[3], const double normal[3]) {
    double across[3];
    mcd_cross(across, normal, turn);
    return mcd_length(across);
}

/* The sine of the angle between the axis of a solid of revolution and the normal, if it may roll on: its turn and a
 * blow at the rim do not lay it flat, and its contact can follow the rim (half a radian: Mst_Order_Edges). Else 0. */
static double rollOf(const McdForecast *f, int k, const McdShape *s, const double normal[3]) {
    static const double max2 = .5; /* rad², about the normal */
    const double *axis = s->axis[2];
    double aside[3], moves[3];
    mcd_mad(aside, axis, -mcd_dot(axis, normal), normal);
    mcd_cross(moves, f->course[k].turn, axis);
    const double sine = mcd_length(aside);
    if (sine == 0 || (!mcd_isTurned(s) && s->kind->rank != MCD_RANK_SPHYL))
        return 0;
    const double down = -mcd_dot(moves, aside) / sine, blow = 2 * approachAlong(f, normal) / s->extent;
    const MeBool mayLie = fmax(down, 0) + blow > sine;
    return !mayLie && mcd_dot(moves, moves) - down * down < max2 * sine * sine ? sine : 0;
}

/* The turn that moves a shape. A spin about its axis does not move a solid of revolution: of the turns that move it
 * alike that which tilts least is taken, since what rolls turns about the normal, or not at all. One that may come to
 * lie flat has no such turn. */
static void turnOf(const McdForecast *f, int k, const McdShape *s, const double normal[3], double turn[3]) {
    const double *given = f->course[k].turn, *axis = s->axis[2];
    const double sine = rollOf(f, k, s, normal);
    double aside[3];
    mcd_copy(turn, given);
    if (!mcd_isTurned(s) && s->kind->rank != MCD_RANK_SPHYL)
        return;
    mcd_mad(aside, axis, -mcd_dot(axis, normal), normal);
    mcd_mad(turn, given, -(sine > 0 ? mcd_dot(given, aside) / (sine * sine) : mcd_dot(given, axis)), axis);
}

/* A blow at the end of a rod makes the other end come down by up to one and a half times the approach, and others may
 * follow: without this Mst_Landing fails; 1 and 4 in place of 2 change no drop. Beyond 1 rad a small turn's bound of
 * heights says nothing; with half of that Mst_Landing fails. */
double mcd_landingTilt(const McdForecast *f, const double normal[3], double size) {
    const double turned = tiltBy(f->course[0].turn, normal) + tiltBy(f->course[1].turn, normal);
    return MeMIN(turned + 2 * approachAlong(f, normal) / size, 1);
}

/* ---- bodies ------------------------------------------------------------------------------------------------------ */

/* m²: the mean squares and products of a hull's coordinates about a point, in its own axes. Half of those of the
 * corners, which is right to a third for prisms, boxes and balls; Mst_Landing fails with a quarter. */
static void spreadOfHull(const McdHull *h, const double about[3], double spread[3][3]) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) {
            double sum = 0;
            for (int v = 0; v < h->vertexCount; v++)
                sum += (h->vertex[v][i] - about[i]) * (h->vertex[v][j] - about[j]);
            spread[i][j] = spread[j][i] = sum / (2 * h->vertexCount);
        }
}

/* The same of the solid that moves, along the world's axes. What is no hull counts as a ball, as an aggregate does,
 * with which its children move. */
static void spreadOf(const McdShape *s, const McdCourse *c, double spread[3][3]) {
    const double extent = c->extent > 0 ? c->extent : s->extent, square = extent * extent / 8;
    double own[3][3] = {{square, 0, 0}, {0, square, 0}, {0, 0, square}}, centre[3];
    mcd_shapeToOwnAxes(s, c->arm, centre);
    if (s->hull && c->extent == 0)
        spreadOfHull(s->hull, centre, own);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            spread[i][j] = 0;
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < 3; l++)
                    spread[i][j] += s->axis[k][i] * own[k][l] * s->axis[l][j];
        }
}

/* Inverts a symmetric positive matrix by its cofactors; returns its determinant. */
static double invert(const double m[3][3], double inverse[3][3]) {
    double cofactor[3][3];
    for (int i = 0; i < 3; i++)
        mcd_cross(cofactor[i], m[(i + 1) % 3], m[(i + 2) % 3]);
    const double det = mcd_dot(m[0], cofactor[0]);
    for (int i = 0; i < 3; i++)
        mcd_scale(inverse[i], cofactor[i], det > 0 ? 1 / det : 0);
    return det;
}

static void setLander(McdLander *p, const McdForecast *f, int k, const McdShape *s, const double normal[3]) {
    const McdCourse *c = &f->course[k];
    double spread[3][3], inertia[3][3], unused[3][3];
    *p = (McdLander){.shift = shiftAlong(f, k, normal)};
    turnOf(f, k, s, normal, p->turn);
    p->roll = rollOf(f, k, s, normal);
    mcd_mad(p->centre, s->place, 1, c->arm);
    spreadOf(s, c, spread);
    const double volume2 = invert(mcd_constRows(spread), unused), all = spread[0][0] + spread[1][1] + spread[2][2];
    if (!c->isFree || !(volume2 > 0))
        return;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            inertia[i][j] = (i == j ? all : 0) - spread[i][j];
    invert(mcd_constRows(inertia), p->inverse);
    p->mobility = 1 / sqrt(volume2);
    for (int i = 0; i < 3; i++)
        mcd_scale(p->inverse[i], p->inverse[i], p->mobility);
}

MeBool mcd_landingBegin(McdLanding *l, const McdForecast *f, const McdShape *a, const McdShape *b,
                        const double normal[3]) {
    double turn[2][3];
    turnOf(f, 0, a, normal, turn[0]);
    turnOf(f, 1, b, normal, turn[1]);
    const double turnA = tiltBy(turn[0], normal), turnB = tiltBy(turn[1], normal);
    l->turn = turnA + turnB;
    l->fall = f->course[0].isFree != f->course[1].isFree ? fabs(mcd_dot(f->fall, normal)) : 0;
    l->enter = mcd_mayEnter * mcd_pairSize(a, b);
    if (2 * (approachAlong(f, normal) + turnA * a->extent + turnB * b->extent) <= l->enter)
        return MEFALSE;
    mcd_copy(l->normal, normal);
    setLander(&l->side[0], f, 0, a, normal);
    setLander(&l->side[1], f, 1, b, normal);
    return l->side[0].mobility > 0 || l->side[1].mobility > 0;
}

/* ---- motion ------------------------------------------------------------------------------------------------------ */

/* m: by how much a point moves along the normal, to first order in the turn: uncertainTilt has the rest. */
static double motionAlong(const McdLanding *l, int k, const double point[3]) {
    const McdLander *p = &l->side[k];
    double arm[3], turned[3];
    mcd_sub(arm, point, p->centre);
    mcd_cross(turned, p->turn, arm);
    return p->shift + mcd_dot(l->normal, turned);
}

static void setSite(const McdLanding *l, McdSite *s) {
    s->gap = s->separation + motionAlong(l, 0, s->on[0]) - motionAlong(l, 1, s->on[1]);
    s->target = MeMIN(s->separation, 0);
    s->push = s->softness = 0;
    s->isChosen = MEFALSE;
    for (int k = 0; k < 2; k++) {
        const McdLander *p = &l->side[k];
        double arm[3];
        mcd_sub(arm, s->on[k], p->centre);
        mcd_cross(s->lever[k], arm, l->normal);
        s->softness += p->mobility;
        for (int i = 0; i < 3; i++)
            s->softness += s->lever[k][i] * mcd_dot(p->inverse[i], s->lever[k]);
    }
}

static double gapOf(const McdLanding *l, const McdSite *s) {
    return s->gap + l->shift + mcd_dot(l->change[0], s->lever[0]) + mcd_dot(l->change[1], s->lever[1]);
}

static void pushAt(McdLanding *l, const McdSite *s, double push) {
    for (int k = 0; k < 2; k++) {
        l->shift += push * l->side[k].mobility;
        for (int i = 0; i < 3; i++)
            l->change[k][i] += push * mcd_dot(l->side[k].inverse[i], s->lever[k]);
    }
}

/* Pushes the chosen sites apart until none overlaps. Twice and half of the sweeps, and of the accuracy, change no
 * test. */
static void settle(McdLanding *l, McdSite *site, const int *kept, int keptCount) {
    enum { SWEEPS = 24 };
    double largest = INFINITY;
    for (int sweep = 0; sweep < SWEEPS && largest > l->enter / 8; sweep++) {
        largest = 0;
        for (int i = 0; i < keptCount; i++) {
            McdSite *s = &site[kept[i]];
            const double residual = s->target - gapOf(l, s), push = MeMAX(s->push + residual / s->softness, 0);
            largest = fmax(largest, fabs(push - s->push) * s->softness);
            pushAt(l, s, push - s->push);
            s->push = push;
        }
    }
}

/* The site that overlaps most, and more than is left; -1: none. */
static int deepestOf(const McdLanding *l, const McdSite *site, int count) {
    double max = l->enter;
    int deepest = -1;
    for (int i = 0; i < count; i++) {
        const double overlap = site[i].target - gapOf(l, &site[i]);
        if (!site[i].isChosen && overlap > max) {
            max = overlap;
            deepest = i;
        }
    }
    return deepest;
}

/* Chooses the deepest sites, until none is too deep. Returns the number of chosen ones. */
static int addDeepest(McdLanding *l, McdSite *site, int count, int maxCount, int keptCount, int *kept) {
    for (; keptCount < maxCount; keptCount++) {
        settle(l, site, kept, keptCount);
        const int next = deepestOf(l, site, count);
        if (next < 0)
            break;
        site[next].isChosen = METRUE;
        kept[keptCount] = next;
    }
    return keptCount;
}

/* rad: by how much the pushes tilt both shapes relative to each other. */
static double tiltByPushes(const McdLanding *l) {
    double turn[3], across[3];
    mcd_mad(turn, l->change[0], 1, l->change[1]);
    mcd_cross(across, l->normal, turn);
    return mcd_length(across);
}

/* Whether pushes act all around the centre of a body, which then does not tilt over an edge. */
static MeBool isPropped(const McdLanding *l, int k, const McdSite *site, const int *kept, int keptCount) {
    MeBool isAny = MEFALSE;
    for (int i = 0; i < keptCount && l->side[k].mobility > 0; i++) {
        MeBool isBeside = MEFALSE;
        if (!(site[kept[i]].push > 0))
            continue;
        for (int j = 0; j < keptCount && !isBeside; j++) {
            double across[3];
            mcd_cross(across, site[kept[i]].lever[k], site[kept[j]].lever[k]);
            isBeside = site[kept[j]].push > 0 && mcd_dot(across, l->normal) > 0;
        }
        if (!isBeside)
            return MEFALSE;
        isAny = METRUE;
    }
    return isAny || l->side[k].mobility == 0;
}

/* Whether one shape rolls on: the pushes bear its weight, and what they turn beyond that is small beside the angle at
 * which it leans. Then its contact moves along the rim, and to tilt further is to roll: another point of the rim would
 * be struck where it passes. */
static MeBool isRolling(const McdLanding *l, const McdSite *site, const int *kept, int keptCount) {
    static const double max = .2;
    const double roll = fmax(l->side[0].roll, l->side[1].roll);
    double motion = 0; /* m: toward each other, at the pushes */
    for (int i = 0; i < keptCount; i++)
        if (site[kept[i]].push > 0)
            motion = fmax(motion, site[kept[i]].separation - site[kept[i]].gap);
    return roll > 0 && tiltByPushes(l) * (motion - l->fall) <= max * roll * motion;
}

/* rad: by how much the shapes may tilt beyond what is predicted. Pushes are uncertain by as much as they turn the
 * shapes, since they act one after the other, and others may act. Turns are followed to first order. What is pushed on
 * all sides of its centre does not tilt further: without this a coin of 16 corners that falls flat has contacts at all
 * of them, whose friction costs the solver four times the work (Mst_Landing). */
static double uncertainTilt(const McdLanding *l, const McdSite *site, const int *kept, int keptCount) {
    const double pushed = tiltByPushes(l), all = pushed + l->turn;
    if (isRolling(l, site, kept, keptCount))
        return 0;
    if (isPropped(l, 0, site, kept, keptCount) && isPropped(l, 1, site, kept, keptCount))
        return 0;
    return pushed + all * all / 2;
}

/* Adds the sites that a further tilt would bring down. */
static int addUncertain(const McdLanding *l, const McdSite *site, int count, int maxCount, int keptCount, int *kept) {
    McdSpot spot[MCD_LANDING_SITES];
    if (l->tilt == 0 || keptCount == maxCount || count > MCD_LANDING_SITES)
        return keptCount;
    for (int i = 0; i < count; i++) {
        mcd_copy(spot[i].at, site[i].on[0]);
        mcd_copy(spot[i].at + 3, l->normal);
        spot[i].separation = gapOf(l, &site[i]) - site[i].target;
    }
    return mcd_spreadForTilt(spot, count, maxCount, l->tilt, l->enter, keptCount, kept);
}

int mcd_landingChoose(McdLanding *l, McdSite *site, int count, int maxCount, int keptCount, int *kept) {
    MEASSERT(keptCount >= 1 && keptCount <= maxCount && count >= keptCount);
    l->shift = 0;
    memset(l->change, 0, sizeof l->change);
    for (int i = 0; i < count; i++)
        setSite(l, &site[i]);
    for (int i = 0; i < keptCount; i++)
        site[kept[i]].isChosen = METRUE;
    keptCount = addDeepest(l, site, count, maxCount, keptCount, kept);
    l->tilt = uncertainTilt(l, site, kept, keptCount);
    return addUncertain(l, site, count, maxCount, keptCount, kept);
}

MeBool mcd_landingMayNeed(const McdLanding *l, McdSite *further, const McdSite *site, int count) {
    double support = 0; /* that the chosen ones leave to it */
    setSite(l, further);
    for (int i = 0, isFirst = 1; i < count && l->tilt > 0; i++) {
        if (!site[i].isChosen)
            continue;
        const double distance = sqrt(mcd_distanceSquared(further->on[0], site[i].on[0]));
        const double by = gapOf(l, &site[i]) - site[i].target + l->tilt * distance;
        support = isFirst ? by : fmin(support, by);
        isFirst = 0;
    }
    return gapOf(l, further) - further->target < fmax(support, 0) - l->enter;
}
