/* Checks of handles and numbers, with all warnings about misuse.
 *
 * A handle points to a record whose magic tells its type and whether it is live. Records of destroyed bodies and
 * constraints stay in their world's pool, so that the magic can still be read. All live objects are also in a table
 * (MeInternal.h). Check builds look up every handle there before they read through it, as the world may be destroyed.
 * All builds do so for MdtBodyDestroy, because programs may destroy their objects in any order.
 */
#include "MdtInternal.h"
#include "base/mdt_world_i.h"
#include "MdtBody.h"
#include "MdtConstraint.h"
#include "MeMath.h"
#include <float.h>
#include <stdatomic.h>
#include <string.h>

static void warnAbout(const char *caller, const char *what, MeBool isNull) {
    if (isNull)
        MeWarning(1, "%s: the %s is null", caller, what);
    else
        MeWarning(1, "%s: the %s has been destroyed, or never was one", caller, what);
}

void mdt_warnGone(const char *caller, const char *what) {
    warnAbout(caller, what, MEFALSE);
}

static atomic_int liveWorlds;

void mdt_countWorlds(int change) {
    atomic_fetch_add(&liveWorlds, change);
    MEASSERT(atomic_load(&liveWorlds) >= 0);
}

#if KARMA_CHECK
#define IS_KNOWN(p, magic) MeHandleIsLive((p), (magic))
#else
#define IS_KNOWN(p, magic) METRUE
#endif

MeBool MEAPI MdtWorldIsValid(const MdtWorldID w) {
    return w && MeHandleIsLive(w, MDT_WORLD) && w->magic == MDT_WORLD;
}

/* Programs have no handles of hidden bodies, but for stale ones where such a body is now. */
static MeBool isHidden(const MdtBody *b) {
    return b->mover && b->mover->isHidden;
}

MeBool MEAPI MdtBodyIsValid(const MdtBodyID b) {
    return b && MeHandleIsLive(b, MDT_BODY) && b->record.magic == MDT_BODY && !(b->record.flags & MDT_CONDEMNED) &&
           !isHidden(b);
}

/* True if the handle is a contact of a live manifold. A contact is a slot of a manifold's record, and only records are
 * in the table of live objects: the record's address is computed from the contact's, and is looked up before it is
 * read. */
static MeBool isLivePoint(const void *handle) {
    for (int slot = 0; slot < MDT_POINTS; slot++) {
        const size_t offset = offsetof(MdtManifold, point) + (size_t)slot * sizeof(MdtPoint);
        if ((uintptr_t)handle > offset && MeHandleIsLive((const char *)handle - offset, MDT_MANIFOLD))
            return ((const MdtPoint *)handle)->magic == MDT_POINT;
    }
    return MEFALSE;
}

/* True if the manifold is a contact group. Its record may also be that of a single contact, or continue a group: then
 * its address is not a valid handle, or one of a group that was destroyed. */
static MeBool isGroup(const MdtBaseConstraint *c) {
    return !((const MdtManifold *)(const void *)c)->group && !(c->record.flags & MDT_LONE);
}

MeBool mdt_constraintIsCondemned(const MdtBaseConstraint *c) {
    return mdt_isPoint(c) ? ((const MdtPoint *)(const void *)c)->isCondemned : (c->record.flags & MDT_CONDEMNED) != 0;
}

static MeBool isLiveConstraint(const MdtBaseConstraint *c) {
    return c && (MeHandleIsLive(c, MDT_JOINT) || (MeHandleIsLive(c, MDT_MANIFOLD) && isGroup(c)) || isLivePoint(c));
}

MeBool MEAPI MdtConstraintIsValid(const MdtConstraintID c) {
    return isLiveConstraint(c) && !mdt_constraintIsCondemned(c);
}

MeBool mdt_mayDestroyBody(const MdtBody *b, const char *caller) {
    if (MdtBodyIsValid((MdtBodyID)b))
        return METRUE;
    if (!b || atomic_load(&liveWorlds))
        warnAbout(caller, "body", b == NULL);
    return MEFALSE;
}

MeBool mdt_isWorld(const MdtWorld *w, const char *caller) {
    if (w && IS_KNOWN(w, MDT_WORLD) && w->magic == MDT_WORLD)
        return METRUE;
    warnAbout(caller, "world", w == NULL);
    return MEFALSE;
}

MeBool mdt_isBody(const MdtBody *b, const char *caller) {
    if (b && IS_KNOWN(b, MDT_BODY) && b->record.magic == MDT_BODY && !isHidden(b))
        return METRUE;
    warnAbout(caller, "body", b == NULL);
    return MEFALSE;
}

MeBool mdt_isAnyBody(const MdtBody *b, const char *caller) {
    return b && IS_KNOWN(b, MDT_BODY) && b->record.magic == MDT_BODY ? METRUE : mdt_isBody(b, caller);
}

MeBool mdt_isConstraint(const MdtBaseConstraint *c, const char *caller) {
#if KARMA_CHECK
    const MeBool isLive = isLiveConstraint(c);
#else
    const MeBool isLive = c && (mdt_isPoint(c) || mdt_isJoint(c) || (mdt_isManifold(c) && isGroup(c)));
#endif
    if (isLive) {
        mdt_constraintMarkTouched((MdtConstraintID)(uintptr_t)c);
        return METRUE;
    }
    warnAbout(caller, "constraint", c == NULL);
    return MEFALSE;
}

MeBool mdt_attachmentsAreLinked(const MdtBody *b) {
    const MdtAttachment *previous = NULL;
    for (const MdtAttachment *at = b->attachments; at; previous = at, at = at->next)
        if (at->body != b || at->previous != previous || mdt_attachmentOwner(at)->world != b->world)
            return MEFALSE;
    return METRUE;
}

MeBool mdt_isFinite(const char *caller, const char *what, MeReal x) {
    if (isfinite(x))
        return METRUE;
    MeWarning(1, "%s: %s is %g; nothing is changed", caller, what, (double)x);
    return MEFALSE;
}

MeBool mdt_areFinite(const MeReal v[3]) {
    const double max = (double)FLT_MAX;
    return fabs((double)v[0]) <= max && fabs((double)v[1]) <= max && fabs((double)v[2]) <= max;
}

MeBool mdt_isFinite3(const char *caller, const char *what, MeReal x, MeReal y, MeReal z) {
    const MeReal v[3] = {x, y, z};
    if (mdt_areFinite(v))
        return METRUE;
    MeWarning(1, "%s: %s is (%g, %g, %g); nothing is changed", caller, what, (double)x, (double)y, (double)z);
    return MEFALSE;
}

/* The rounding error of MeReal at this position is half the length scale; squares of distances are still finite. */
double mdt_worldBound(const MdtWorld *w) {
    MEASSERT(w->params.lengthScale > 0);
    return fmin(2 / (double)ME_EPSILON * (double)w->params.lengthScale, sqrt((double)MEINFINITY) / 4);
}

MeBool mdt_isPositionValid(const char *caller, const char *what, const MdtWorld *w, MeReal x, MeReal y, MeReal z) {
    const double max = mdt_worldBound(w);
    if (!mdt_isFinite3(caller, what, x, y, z))
        return MEFALSE;
    if (fabs((double)x) <= max && fabs((double)y) <= max && fabs((double)z) <= max)
        return METRUE;
    MeWarning(1, "%s: %s (%g, %g, %g) is farther away than %g m (MdtBodyGetPositionBound); nothing is changed", caller,
              what, (double)x, (double)y, (double)z, max);
    return MEFALSE;
}

MeBool mdt_isNotBelow(const char *caller, const char *what, MeReal x, MeReal lower) {
    if (x >= lower && isfinite(x))
        return METRUE;
    MeWarning(1, "%s: %s is %g, it must be at least %g; nothing is changed", caller, what, (double)x, (double)lower);
    return MEFALSE;
}

MeBool mdt_setServo(const char *caller, MdtBclServo *motor, MeReal frequency, MeReal dampingRatio, MeReal force) {
    if (!mdt_isNotBelow(caller, "the frequency", frequency, 0) ||
        !mdt_isNotBelow(caller, "the damping ratio", dampingRatio, 0) ||
        !mdt_isNotBelow(caller, "the force limit", force, 0))
        return MEFALSE;
    *motor = (MdtBclServo){frequency, dampingRatio, force};
    return METRUE;
}

/* Dividing by a smaller number, or by its square, would overflow. */
MeBool mdt_isPositiveInRange(MeReal x) {
    return x >= (MeReal)FLT_MIN && x <= (MeReal)FLT_MAX;
}

MeBool mdt_isPositive(const char *caller, const char *what, MeReal x) {
    if (mdt_isPositiveInRange(x))
        return METRUE;
    MeWarning(1, "%s: %s is %g, it must be positive%s; nothing is changed", caller, what, (double)x,
              x > 0 && isfinite(x) ? ", and a number that single precision can have" : "");
    return MEFALSE;
}

MeBool mdt_isSortKey(const char *caller, MeI32 key) {
    if (key >= 0)
        return METRUE;
    MeWarning(1, "%s: the sort key is %d, it must not be negative; nothing is changed", caller, key);
    return MEFALSE;
}

MeBool mdt_isPointer(const char *caller, const char *what, const void *p) {
    if (p)
        return METRUE;
    MeWarning(1, "%s: %s is null", caller, what);
    return MEFALSE;
}

MeBool mdt_isResult(const char *caller, MeReal *result, int n) {
    if (!mdt_isPointer(caller, "the result", result))
        return MEFALSE;
    for (int i = 0; i < n; i++)
        result[i] = 0;
    return METRUE;
}

MeBool mdt_normalizeQuaternion(const char *caller, double q[4]) {
    const double size = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (isfinite(size) && size > 0) {
        keaQuaternionNormalize(q);
        return METRUE;
    }
    MeWarning(1, "%s: (%g, %g, %g, %g) is no orientation; nothing is changed", caller, q[0], q[1], q[2], q[3]);
    return MEFALSE;
}

void mdt_setTargetTurn(const char *caller, MdtBclTargetTurn *target, const MeReal q[4], const MeReal w[3]) {
    if (!mdt_isPointer(caller, "the quaternion", q) ||
        (w && !mdt_isFinite3(caller, "the angular velocity", w[0], w[1], w[2])))
        return;
    double unit[4] = {q[0], q[1], q[2], q[3]};
    if (!mdt_normalizeQuaternion(caller, unit))
        return;
    memcpy(target->quaternion, unit, sizeof unit);
    keaZero(target->velocity);
    if (w)
        mdt_fromReal(target->velocity, w);
}

void mdt_setNonNegative(const char *caller, const char *what, MeReal *place, MeReal x) {
    if (place && mdt_isNotBelow(caller, what, x, 0))
        *place = x;
}

void mdt_setAngle(const char *caller, const char *what, MeReal *place, MeReal x) {
    if (place && mdt_isFinite(caller, what, x))
        *place = x < 0 ? 0 : x > ME_PI ? ME_PI : x;
}

MeBool mdt_isSolver(MdtSolver solver) {
    return solver == MdtSolverAuto || solver == MdtSolverExact || solver == MdtSolverFast;
}
