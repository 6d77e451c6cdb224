/* How a mover goes: along what is in the way, up steps, down with the ground. */
#include "mover/mst_mover_i.h"

enum { MAX_SLIDES = 4 };

/* ---- planes of contacts ------------------------------------------------------------------------------------------ */

/* Ground that is too steep is a wall for what goes up, and a slope for what goes down. */
static MeBool isSteep(const MstMove *v, const MstMoverContact *c) {
    return !c->isWalkable && mst_dot(c->gap.normal, v->mover->up) > 1e-3;
}

static MstMoverPlane wallOf(const MstMove *v, const MstMoverContact *c) {
    MstMoverPlane wall = {.bound = 0};
    mst_across(wall.normal, c->gap.normal, v->mover->up);
    mst_scale(wall.normal, wall.normal, 1 / fmax(mst_length(wall.normal), 1e-12));
    return wall;
}

/* The half-spaces of a displacement that keep the skin, or restore it. */
static int planesOf(const MstMove *v, MeBool isRestoring, MstMoverPlane plane[2 * MST_MOVER_CONTACTS]) {
    int count = 0;
    for (int i = 0; i < v->contactCount; i++) {
        const MstMoverContact *c = &v->contact[i];
        const double deficit = v->mover->skin - c->gap.distance;
        plane[count].bound = isRestoring ? deficit : fmin(deficit, 0);
        mst_copy(plane[count++].normal, c->gap.normal);
        if (isSteep(v, c))
            plane[count++] = wallOf(v, c);
    }
    return count;
}

/* The displacement nearest to the wanted one. Between surfaces at a small angle, what restores the skin would be a long
 * way; then it stays as it is. */
static void solve(const MstMove *v, const double want[3], double out[3]) {
    MstMoverPlane plane[2 * MST_MOVER_CONTACTS];
    double deficit = 0;
    for (int i = 0; i < v->contactCount; i++)
        deficit = fmax(deficit, v->mover->skin - v->contact[i].gap.distance);
    if (mst_nearestInPlanes(plane, planesOf(v, METRUE, plane), want, out) &&
        mst_length(out) <= mst_length(want) + 2 * deficit)
        return;
    if (!mst_nearestInPlanes(plane, planesOf(v, MEFALSE, plane), want, out))
        mst_scale(out, want, 0);
}

/* ---- slides ------------------------------------------------------------------------------------------------------ */

static void notePushed(MstMove *v, const MstMoverContact *c) {
    const McdModelID cm = McdNearGetModel(v->near, c->child);
    for (int i = 0; i < v->pushedCount; i++)
        if (McdNearGetModel(v->near, v->pushed[i].child) == cm)
            return;
    if (McdModelGetBody(cm) && v->pushedCount < MST_MOVER_PUSHED)
        v->pushed[v->pushedCount++] = *c;
}

static void noteBlocking(MstMove *v, const double want[3]) {
    double level[3];
    mst_across(level, want, v->mover->up);
    for (int i = 0; i < v->contactCount; i++) {
        const MstMoverContact *c = &v->contact[i];
        if (mst_dot(c->gap.normal, level) >= -1e-6 * mst_length(level))
            continue;
        if (mst_dot(c->gap.normal, v->mover->up) < v->mover->minUp) {
            v->isBlocked = METRUE;
            notePushed(v, c);
        }
    }
}

/* The share of a length that may be added to another one up to a limit. */
static double shareWithin(double length, double added, double max) {
    return added > 0 ? fmin(fmax(max - length, 0) / added, 1) : 1;
}

/* Shortens a displacement so that the foot stays within what was gathered. */
static void limit(const MstMove *v, double by[3]) {
    const MstMover *m = v->mover;
    double from[3], to[3];
    mst_across(from, v->place, m->up);
    mst_across(to, by, m->up);
    const double level = shareWithin(mst_length(from), mst_length(to), v->reach);
    const double upright =
        shareWithin(fabs(mst_dot(v->place, m->up)), fabs(mst_dot(by, m->up)), v->reach + m->stepHeight);
    mst_scale(by, by, fmin(level, upright));
}

/* Until nothing is in the way: goes to what is, and finds the displacement along it that is nearest to the rest. */
void mst_slide(MstMove *v, const double want[3]) {
    double remaining[3], by[3];
    McdNearGap hit;
    mst_copy(remaining, want);
    for (int i = 0; i < MAX_SLIDES; i++) {
        mst_findMoverContacts(v);
        noteBlocking(v, remaining);
        solve(v, remaining, by);
        limit(v, by);
        const McdCapsule c = mst_moverCapsule(v->mover, v->place);
        const double t = mst_castMover(v, &c, by, v->mover->skin / 2, &hit);
        mst_mad(v->place, v->place, t, by);
        mst_scale(remaining, remaining, 1 - t);
        if (t == 1)
            return;
    }
}

/* ---- walking ----------------------------------------------------------------------------------------------------- */

/* Whether it cannot fall: all ways down are closed, as between two slopes. */
static MeBool isSupported(const MstMove *v) {
    MstMoverPlane plane[MST_MOVER_CONTACTS];
    double down[3], out[3];
    mst_scale(down, v->mover->up, -1);
    for (int i = 0; i < v->contactCount; i++) {
        plane[i].bound = 0;
        mst_copy(plane[i].normal, v->contact[i].gap.normal);
    }
    return !mst_nearestInPlanes(plane, v->contactCount, down, out) || mst_dot(out, out) < 1e-6;
}

const MstMoverContact *mst_groundContact(const MstMove *v) {
    const MstMoverContact *best = 0;
    const double *up = v->mover->up;
    for (int i = 0; i < v->contactCount; i++) {
        const MstMoverContact *c = &v->contact[i];
        const int better = best ? c->isWalkable - best->isWalkable : 1;
        if (better > 0 || (better == 0 && mst_dot(c->gap.normal, up) > mst_dot(best->gap.normal, up)))
            best = c;
    }
    return best && (best->isWalkable || isSupported(v)) ? best : 0;
}

/* Casts along `up` by a height, and moves there. Returns how far. */
static double moveUpright(MstMove *v, double height, double stop) {
    double by[3];
    McdNearGap hit;
    const McdCapsule c = mst_moverCapsule(v->mover, v->place);
    mst_scale(by, v->mover->up, height);
    const double t = mst_castMover(v, &c, by, stop, &hit);
    mst_mad(v->place, v->place, t, by);
    return t * fabs(height);
}

MeBool mst_followGround(MstMove *v) {
    const MstMover *m = v->mover;
    double before[3];
    mst_copy(before, v->place);
    const double max = m->stepHeight + m->skin;
    if (moveUpright(v, -max, m->skin) < max) {
        mst_findMoverContacts(v);
        if (mst_groundContact(v))
            return METRUE;
    }
    mst_copy(v->place, before);
    return MEFALSE;
}

/* How far it has come from a place in a wanted direction. */
static double progress(const MstMove *v, const double from[3], const double want[3]) {
    double by[3], level[3];
    mst_sub(by, v->place, from);
    mst_across(level, want, v->mover->up);
    return mst_dot(by, level) / fmax(mst_length(level), 1e-300);
}

/* Tries to go up, over, and down onto something that can be stood on; kept if that brings it farther. */
static void tryStep(MstMove *v, const double from[3], const double want[3]) {
    const MstMover *m = v->mover;
    double slid[3], level[3];
    const double reached = progress(v, from, want);
    mst_copy(slid, v->place);
    mst_copy(v->place, from);
    mst_across(level, want, m->up);
    const double risen = moveUpright(v, m->stepHeight, m->skin / 2);
    mst_slide(v, level);
    const double max = risen + m->skin;
    const MeBool isOver = moveUpright(v, -max, m->skin) < max;
    mst_findMoverContacts(v);
    v->hasStepped = isOver && mst_groundContact(v) && progress(v, from, want) > reached + 1e-3 * mst_length(level);
    if (!v->hasStepped)
        mst_copy(v->place, slid);
}

void mst_walk(MstMove *v, const double want[3]) {
    const double *up = v->mover->up;
    double from[3], along[3];
    mst_copy(from, v->place);
    mst_across(along, want, up);
    mst_findMoverContacts(v);
    const MstMoverContact *ground = mst_groundContact(v);
    const double level = ground ? mst_dot(ground->gap.normal, up) : 0;
    if (level >= v->mover->minUp) /* the same speed on level ground and on slopes, as seen from above */
        mst_mad(along, along, -mst_dot(ground->gap.normal, along) / level, up);
    v->isBlocked = MEFALSE;
    mst_slide(v, along);
    if (v->isBlocked && v->mover->stepHeight > 0)
        tryStep(v, from, along);
}

/* ---- velocities -------------------------------------------------------------------------------------------------- */

void mst_clipVelocity(const MstMove *v, MeBool isOnGround, double velocity[3]) {
    MstMoverPlane plane[2 * MST_MOVER_CONTACTS];
    double clipped[3];
    int count = 0;
    for (int i = 0; i < v->contactCount; i++) {
        const MstMoverContact *c = &v->contact[i];
        if (isOnGround ? !c->isWalkable : isSteep(v, c))
            plane[count++] = wallOf(v, c);
        if (!isOnGround) {
            plane[count] = (MstMoverPlane){.bound = 0};
            mst_copy(plane[count++].normal, c->gap.normal);
        }
    }
    if (isOnGround)
        mst_across(velocity, velocity, v->mover->up);
    if (mst_nearestInPlanes(plane, count, velocity, clipped))
        mst_copy(velocity, clipped);
    else
        mst_scale(velocity, velocity, 0);
}
