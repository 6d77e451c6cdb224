/* Is this handle alive, is this number a number? Every warning about misuse comes from here.
 *
 * A handle points to a record whose magic says what it is and that it lives. Records of destroyed bodies and
 * constraints stay in their world's pool, so the magic can be read. The check build also knows which worlds live and
 * asks whether the pointer is a record of one of them, so that nothing is read through a handle of a destroyed world.
 */
#include "mdt_i.h"
#include "MeMath.h"

static void warnAbout(const char *caller, const char *what, MeBool isNull) {
    if (isNull)
        MeWarning(1, "%s: the %s is null", caller, what);
    else
        MeWarning(1, "%s: the %s has been destroyed, or never was one", caller, what);
}

#if KARMA_CHECK
#include <stdatomic.h>

static MdtWorldID liveWorlds;
static atomic_flag listIsTaken = ATOMIC_FLAG_INIT;

static void takeList(void) {
    while (atomic_flag_test_and_set(&listIsTaken)) {
    }
}

static void releaseList(void) {
    atomic_flag_clear(&listIsTaken);
}

void mdt_registerWorld(MdtWorldID w) {
    takeList();
    w->nextLive = liveWorlds;
    liveWorlds = w;
    releaseList();
}

void mdt_forgetWorld(MdtWorldID w) {
    takeList();
    for (MdtWorldID *at = &liveWorlds; *at; at = &(*at)->nextLive) {
        if (*at == w) {
            *at = w->nextLive;
            break;
        }
    }
    releaseList();
}

/* Whether the pointer is a live world, or a record of the kind in one. */
static MeBool isKnown(const void *p, unsigned int magic) {
    MeBool found = MEFALSE;
    takeList();
    for (MdtWorldID w = liveWorlds; w && !found; w = w->nextLive) {
        if (magic == MDT_WORLD)
            found = w == p;
        else
            found = mdt_poolOwns(magic == MDT_BODY ? &w->bodyPool : &w->constraintPool, p);
    }
    releaseList();
    return found;
}
#else
void mdt_registerWorld(MdtWorldID w) {
    (void)w;
}

void mdt_forgetWorld(MdtWorldID w) {
    (void)w;
}

static MeBool isKnown(const void *p, unsigned int magic) {
    (void)p, (void)magic;
    return METRUE;
}
#endif

MeBool mdt_isWorld(const MdtWorld *w, const char *caller) {
    if (w && isKnown(w, MDT_WORLD) && w->magic == MDT_WORLD)
        return METRUE;
    warnAbout(caller, "world", w == NULL);
    return MEFALSE;
}

MeBool mdt_isBody(const MdtBody *b, const char *caller) {
    if (b && isKnown(b, MDT_BODY) && b->record.magic == MDT_BODY)
        return METRUE;
    warnAbout(caller, "body", b == NULL);
    return MEFALSE;
}

MeBool mdt_isConstraint(const MdtBaseConstraint *c, const char *caller) {
    if (c && isKnown(c, MDT_CONSTRAINT) && c->record.magic == MDT_CONSTRAINT)
        return METRUE;
    warnAbout(caller, "constraint", c == NULL);
    return MEFALSE;
}

MeBool mdt_isFinite(const char *caller, const char *what, MeReal x) {
    if (isfinite(x))
        return METRUE;
    MeWarning(1, "%s: %s is %g; nothing is changed", caller, what, (double)x);
    return MEFALSE;
}

MeBool mdt_isFinite3(const char *caller, const char *what, MeReal x, MeReal y, MeReal z) {
    if (isfinite(x) && isfinite(y) && isfinite(z))
        return METRUE;
    MeWarning(1, "%s: %s is (%g, %g, %g); nothing is changed", caller, what, (double)x, (double)y, (double)z);
    return MEFALSE;
}

MeBool mdt_isAtLeast(const char *caller, const char *what, MeReal x, MeReal lower) {
    if (x >= lower && isfinite(x))
        return METRUE;
    MeWarning(1, "%s: %s is %g, it must be at least %g; nothing is changed", caller, what, (double)x, (double)lower);
    return MEFALSE;
}

MeBool mdt_isPositive(const char *caller, const char *what, MeReal x) {
    if (x > 0 && isfinite(x))
        return METRUE;
    MeWarning(1, "%s: %s is %g, it must be positive; nothing is changed", caller, what, (double)x);
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

void mdt_setAtLeast0(const char *caller, const char *what, MeReal *place, MeReal x) {
    if (place && mdt_isAtLeast(caller, what, x, 0))
        *place = x;
}

void mdt_setAngle(const char *caller, const char *what, MeReal *place, MeReal x) {
    if (place && mdt_isFinite(caller, what, x))
        *place = x < 0 ? 0 : x > ME_PI ? ME_PI : x;
}
