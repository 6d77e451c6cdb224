/* Debug drawing of a universe by the program's table of functions: models, then contacts, joints and bodies. */
#include "MstDebugDraw.h"
#include "Mcd.h"
#include "McduDebugDraw.h"
#include "Mdt.h"
#include "MdtReport.h"
#include "MeDebugDraw.h"
#include "MeMath.h"
#include "MeInternal.h"
#include "MeMessage.h"
#include "MstModelDynamics.h"
#include "MstUniverse.h"
#include <math.h>
#include <stdio.h>

/* Common arguments of the drawing functions. */
typedef struct Drawing {
    const MstDebugDraw *to;
    unsigned int layers;
    MeReal length;
    const char *function; /* name of the public function, for messages */
} Drawing;

static const float white[4] = {.92f, .93f, .95f, 1}, grey[4] = {.55f, .57f, .60f, 1}, red[4] = {.90f, .25f, .20f, 1},
                   green[4] = {.25f, .75f, .35f, 1}, blue[4] = {.30f, .50f, .95f, 1}, orange[4] = {.95f, .60f, .15f, 1},
                   yellow[4] = {.98f, .90f, .25f, 1}, cyan[4] = {.35f, .85f, .90f, 1},
                   translucent[4] = {.98f, .90f, .25f, .3f};

static MeBool isDrawn(const Drawing *d, unsigned int layers) {
    return (d->layers & layers) != 0;
}

static MeBool isOfBody(const Drawing *d, MdtBodyID b) {
    return !d->to->only || d->to->only == b;
}

/* ---- calls of the program's functions ---------------------------------------------------------------------------- */

/* Calls a function of the program's table unless it is null. The function may change nothing. */
#define CALL_PROGRAM(d, member, ...)                                                                                   \
    do {                                                                                                               \
        if ((d)->to->member) {                                                                                         \
            const MeProgramCall before = MeProgramEnterQuiet((d)->function);                                           \
            (d)->to->member((d)->to->userdata, __VA_ARGS__);                                                           \
            MeProgramLeave(&before);                                                                                   \
        }                                                                                                              \
    } while (0)

static void drawLine(const Drawing *d, const MeVector3 a, const MeVector3 b, const float color[4]) {
    CALL_PROGRAM(d, line, a, b, color);
}

static void drawPoint(const Drawing *d, const MeVector3 p, const float color[4]) {
    CALL_PROGRAM(d, point, p, color);
}

static void drawTriangle(const Drawing *d, const MeVector3 a, const MeVector3 b, const MeVector3 c,
                         const float color[4]) {
    CALL_PROGRAM(d, triangle, a, b, c, color);
}

static void drawText(const Drawing *d, const MeVector3 p, const char *words, const float color[4]) {
    CALL_PROGRAM(d, text, p, words, color);
}

/* Draws a line from a point along `times` v, and returns its end. */
static void drawLineAlong(const Drawing *d, const MeVector3 from, const MeVector3 v, MeReal times, const float color[4],
                          MeVector3 end) {
    MeVector3ScaleAndAdd(end, v, times, from);
    drawLine(d, from, end, color);
}

/* Draws a line from a point along `times` v, with a head of two strokes. */
static void drawArrow(const Drawing *d, const MeVector3 from, const MeVector3 v, MeReal times, const float color[4]) {
    const MeReal length = times * MeVector3Magnitude(v);
    MeVector3 end, along, side, other, barb;
    drawLineAlong(d, from, v, times, color, end);
    MeVector3Copy(along, v);
    MeVector3Normalize(along); /* MeVector3PlaneSpace wants it so */
    MeVector3PlaneSpace(along, side, other);
    for (int i = -1; i <= 1; i += 2) {
        for (int k = 0; k < 3; k++)
            barb[k] = end[k] - (MeReal)0.2 * length * along[k] + (MeReal)(0.1 * i) * length * side[k];
        drawLine(d, end, barb, color);
    }
}

/* ---- models ------------------------------------------------------------------------------------------------------ */

/* The drawing of the present call: the line callback of McdGeometryDebugDraw has no context argument. */
static _Thread_local const Drawing *outlineDrawing;

static void MEAPI drawOutlineLine(MeVector3 a, MeVector3 b, MeReal r, MeReal g, MeReal bl) {
    const float color[4] = {(float)r, (float)g, (float)bl, 1};
    drawLine(outlineDrawing, a, b, color);
}

static void drawOutline(const Drawing *d, McdModelID m, McduDebugDrawFlags flags, const float color[4]) {
    const MeReal c[3] = {(MeReal)color[0], (MeReal)color[1], (MeReal)color[2]};
    const MeDebugLineFuncPtr before = MeDebugDrawAPI.line;
    outlineDrawing = d;
    MeDebugDrawAPI.line = drawOutlineLine;
    McduDebugDrawModel(m, flags, c);
    MeDebugDrawAPI.line = before;
}

static const float *partitionColor(int partition) {
    static const float colors[8][4] = {{.20f, .47f, .71f, 1}, {.90f, .58f, .20f, 1}, {.22f, .62f, .51f, 1},
                                       {.79f, .37f, .29f, 1}, {.95f, .83f, .42f, 1}, {.51f, .73f, .88f, 1},
                                       {.72f, .51f, .65f, 1}, {.60f, .80f, .30f, 1}};
    return partition < 0 ? grey : colors[partition % 8];
}

/* By the partition's path in the last step: at rest grey, result kept cyan, fast solver blue, exact solver green,
 * sub-steps orange, out of work budget red. */
static const float *solverColor(MdtBodyID b) {
    static const float *const colors[] = {white, grey, cyan, blue, green, orange, orange, red};
    MdtReport report;
    const int partition = MdtBodyGetPartition(b);
    const MdtWorldID w = MdtBodyGetWorld(b);
    if (partition < 0 || partition >= MdtWorldGetReportCount(w) || !MdtWorldGetPartitionReport(w, partition, &report))
        return grey;
    return colors[report.way];
}

/* The colour of a model's outline; null if no layer draws it. */
static const float *outlineColor(const Drawing *d, MdtBodyID b) {
    if (b && isDrawn(d, MstDebugSolver))
        return solverColor(b);
    if (b && isDrawn(d, MstDebugSleep))
        return MdtBodyIsEnabled(b) ? orange : blue;
    if (b && isDrawn(d, MstDebugPartitions))
        return partitionColor(MdtBodyGetPartition(b));
    return !isDrawn(d, MstDebugShapes) ? 0 : b ? white : grey;
}

static void nameModel(const Drawing *d, McdModelID m, int number) {
    char words[80];
    MeVector3 low, high;
    McdModelGetAABB(m, low, high);
    MeVector3Add(low, low, high);
    MeVector3Scale(low, (MeReal)0.5);
    snprintf(words, sizeof words, "%s %d", McdGeometryGetTypeName(McdModelGetGeometry(m)), number);
    if (MeRealIsValid(MeVector3MagnitudeSqr(low)))
        drawText(d, low, words, white);
}

static void drawModel(const Drawing *d, McdModelID m, int number) {
    const float *color = outlineColor(d, McdModelGetBody(m));
    if (color)
        drawOutline(d, m, kMcduDebugDrawDetail, color);
    if (isDrawn(d, MstDebugBoxes) && McdModelGetGeometryType(m) != kMcdGeometryTypePlane)
        drawOutline(d, m, kMcduDebugDrawAABB, cyan);
    if (isDrawn(d, MstDebugNames))
        nameModel(d, m, number);
}

static void drawModels(const Drawing *d, McdSpaceID s) {
    McdSpaceModelIterator it;
    McdModelID m;
    int number = 0;
    McdSpaceModelIteratorBegin(s, &it);
    for (; McdSpaceGetModel(s, &it, &m); number++)
        if (isOfBody(d, McdModelGetBody(m)))
            drawModel(d, m, number);
}

/* ---- contacts ---------------------------------------------------------------------------------------------------- */

/* Draws a contact's force; without a length of 1 N divided by the body's mass: the weights of 1 kg and of 1000 kg have
 * the same length. */
static void drawForce(const Drawing *d, MdtConstraintID c, const MeVector3 at) {
    MeVector3 f;
    const unsigned int side = MdtConstraintGetBody(c, 0) ? 0 : 1;
    const MdtBodyID b = MdtConstraintGetBody(c, side);
    MdtConstraintGetForce(c, side, f);
    const MeReal length = d->to->forceLength;
    if (b && MeVector3MagnitudeSqr(f) > 0)
        drawArrow(d, at, f, length > 0 ? length : (MeReal)0.1 / MdtBodyGetMass(b), red);
}

static void drawContact(const Drawing *d, MdtContactID c) {
    MeVector3 p, n, end;
    MdtContactGetPosition(c, p);
    MdtContactGetNormal(c, n);
    if (isDrawn(d, MstDebugContacts)) {
        drawPoint(d, p, MdtContactGetPenetration(c) > 0 ? red : yellow);
        drawLineAlong(d, p, n, (MeReal)0.2 * d->length, yellow, end);
    }
    if (isDrawn(d, MstDebugForces))
        drawForce(d, MdtContactQuaConstraint(c), p);
}

/* ---- joints ------------------------------------------------------------------------------------------------------ */

static const char *jointName(MdtConstraintID c) {
    return MdtConstraintDCastHinge(c)            ? "hinge"
           : MdtConstraintDCastPrismatic(c)      ? "slider"
           : MdtConstraintDCastBSJoint(c)        ? "ball and socket"
           : MdtConstraintDCastUniversal(c)      ? "universal"
           : MdtConstraintDCastConeLimit(c)      ? "cone limit"
           : MdtConstraintDCastSpring(c)         ? "spring"
           : MdtConstraintDCastSpring6(c)        ? "spring of six"
           : MdtConstraintDCastCarWheel(c)       ? "car wheel"
           : MdtConstraintDCastAngular3(c)       ? "angular"
           : MdtConstraintDCastLinear1(c)        ? "in a plane"
           : MdtConstraintDCastLinear2(c)        ? "on a line"
           : MdtConstraintDCastSkeletal(c)       ? "skeletal"
           : MdtConstraintDCastGear(c)           ? "gear"
           : MdtConstraintDCastPulley(c)         ? "pulley"
           : MdtConstraintDCastMimic(c)          ? "mimic"
           : MdtConstraintDCastFixedPath(c)      ? "fixed path"
           : MdtConstraintDCastRPROJoint(c)      ? "RPRO"
           : MdtConstraintDCastFPFOJoint(c)      ? "fixed"
           : MdtConstraintDCastUserConstraint(c) ? "the program's"
                                                 : "joint";
}

/* out: v rotated about a unit axis (Rodrigues' formula). */
static void rotateVector(const MeVector3 v, const MeVector3 axis, MeReal angle, MeVector3 out) {
    const MeReal cosine = MeCos(angle), sine = MeSin(angle), along = MeVector3Dot(axis, v) * (1 - cosine);
    MeVector3 cross;
    MeVector3Cross(cross, axis, v);
    for (int i = 0; i < 3; i++)
        out[i] = cosine * v[i] + sine * cross[i] + along * axis[i];
}

/* Draws a circular arc about a point, from a unit direction on, with an arrow head at its end. */
static void drawArcArrow(const Drawing *d, const MeVector3 at, const MeVector3 axis, const MeVector3 from,
                         MeReal radius, MeReal angle, const float color[4]) {
    enum { STEPS = 12 };
    const MeReal head = (angle < 0 ? -1 : 1) * (MeReal)0.25 * radius;
    MeVector3 edge, end, before, ahead, barb;
    for (int i = 0; i <= STEPS; i++) {
        rotateVector(from, axis, angle * (MeReal)i / STEPS, edge);
        MeVector3ScaleAndAdd(end, edge, radius, at);
        if (i > 0)
            drawLine(d, before, end, color);
        MeVector3Copy(before, end);
    }
    MeVector3Cross(ahead, axis, edge);
    for (int i = -1; i <= 1; i += 2) {
        for (int k = 0; k < 3; k++)
            barb[k] = end[k] - head * ahead[k] + (MeReal)(0.12 * i) * radius * edge[k];
        drawLine(d, end, barb, color);
    }
}

/* Draws the sector, or the cone's mantle, that a radius from `at` sweeps as it turns about an axis: from the direction
 * `from`, between two angles. */
static void drawSector(const Drawing *d, const MeVector3 at, const MeVector3 axis, const MeVector3 from, MeReal radius,
                       MeReal first, MeReal last) {
    enum { STEPS = 16 };
    MeVector3 edge, end, before;
    for (int i = 0; i <= STEPS; i++) {
        rotateVector(from, axis, first + (last - first) * (MeReal)i / STEPS, edge);
        MeVector3ScaleAndAdd(end, edge, radius, at);
        if (i > 0) {
            drawTriangle(d, at, before, end, translucent);
            drawLine(d, before, end, yellow);
        }
        MeVector3Copy(before, end);
    }
}

static void drawAngleText(const Drawing *d, const MeVector3 at, MeReal angle) {
    char words[32];
    snprintf(words, sizeof words, "%.1f\xc2\xb0", (double)angle * 57.29577951308232);
    drawText(d, at, words, yellow);
}

static MeBool isMeasured(MdtLimitID limit) {
    return MdtLimitIsActive(limit) || MdtLimitIsMotorized(limit) || MdtLimitPositionIsCalculated(limit);
}

/* Draws the sector between a hinge's stops, a needle that moves with the first body and is inside the sector while the
 * angle is between the stops, and an arrow from angle zero to the needle, without full turns. `side` is -1 if the first
 * body is the world: then the needle moves with the second one. Stops of ten turns and more are not drawn. */
static void drawHinge(const Drawing *d, MdtHingeID hinge, const MeVector3 at, const MeVector3 axis,
                      const MeVector3 second, MeReal side) {
    enum { MAX_TURN = 63 };
    const MdtLimitID limit = MdtHingeGetLimit(hinge);
    if (!isMeasured(limit))
        return;
    const MeReal angle = MdtLimitGetPosition(limit), radius = (MeReal)0.4 * d->length;
    MeVector3 edge, end;
    drawLineAlong(d, at, second, radius, yellow, end);
    drawAngleText(d, end, angle);
    rotateVector(second, axis, -side * angle, edge);
    drawLineAlong(d, at, edge, radius, orange, end);
    drawArcArrow(d, at, axis, edge, (MeReal)0.75 * radius, side * (MeReal)fmod((double)angle, 2 * ME_PI), orange);
    const MeReal low = side * (MdtSingleLimitGetStop(MdtLimitGetLowerLimit(limit)) - angle);
    const MeReal high = side * (MdtSingleLimitGetStop(MdtLimitGetUpperLimit(limit)) - angle);
    if (!MdtLimitIsActive(limit) || !(MeFabs(low) < MAX_TURN) || !(MeFabs(high) < MAX_TURN))
        return;
    drawSector(d, at, axis, second, radius, low, high);
}

/* Draws the track between a slider's stops, and an arrow from coordinate zero to the present one. */
static void drawSlider(const Drawing *d, MdtPrismaticID slider, const MeVector3 at, const MeVector3 axis, MeReal side) {
    const MdtLimitID limit = MdtPrismaticGetLimit(slider);
    if (!isMeasured(limit))
        return;
    const MeReal now = MdtLimitGetPosition(limit);
    const MeReal low = side * (MdtSingleLimitGetStop(MdtLimitGetLowerLimit(limit)) - now);
    const MeReal high = side * (MdtSingleLimitGetStop(MdtLimitGetUpperLimit(limit)) - now);
    MeVector3 a, b;
    char words[32];
    snprintf(words, sizeof words, "%.3g m", (double)now);
    drawText(d, at, words, yellow);
    MeVector3ScaleAndAdd(a, axis, -side * now, at);
    if (now != 0)
        drawArrow(d, a, axis, side * now, orange);
    if (!MdtLimitIsActive(limit) || !(MeFabs(high - low) < (MeReal)1e6 * d->length))
        return;
    MeVector3ScaleAndAdd(a, axis, low, at);
    MeVector3ScaleAndAdd(b, axis, high, at);
    drawLine(d, a, b, yellow);
    drawPoint(d, a, yellow);
    drawPoint(d, b, yellow);
}

/* Draws the cone about the second body's axis, and the first body's axis. */
static void drawCone(const Drawing *d, MdtConeLimitID cone, const MeVector3 at) {
    const MdtConstraintID c = MdtConeLimitQuaConstraint(cone);
    const MeReal half = MdtConeLimitGetConeHalfAngle(cone), radius = (MeReal)0.4 * d->length;
    MeVector3 inner, axis, across, other, edge, end;
    MdtConstraintBodyGetAxis(c, 0, inner);
    MdtConstraintBodyGetAxis(c, 1, axis);
    MeVector3PlaneSpace(axis, across, other);
    rotateVector(axis, across, half, edge);
    drawSector(d, at, axis, edge, radius, 0, (MeReal)(2 * ME_PI));
    drawLineAlong(d, at, inner, radius, yellow, end);
    const MeReal cosine = MeVector3Dot(inner, axis);
    drawAngleText(d, end, MeAcos(MeCLAMP(cosine, -1, 1)));
}

/* Draws the rope of a pulley: from each attachment to its wheel, and between the wheels. */
static void drawRope(const Drawing *d, MdtPulleyID pulley) {
    MeVector3 wheel[2], end;
    for (unsigned int k = 0; k < 2; k++) {
        MdtPulleyGetPosition(pulley, k, end);
        MdtPulleyGetWheel(pulley, k, wheel[k]);
        drawLine(d, end, wheel[k], orange);
        drawPoint(d, wheel[k], orange);
    }
    drawLine(d, wheel[0], wheel[1], orange);
}

static void drawLimits(const Drawing *d, MdtConstraintID c, const MeVector3 at, const MeVector3 axis,
                       const MeVector3 second) {
    const MeReal side = MdtConstraintGetBody(c, 0) ? 1 : -1;
    if (MdtConstraintDCastHinge(c))
        drawHinge(d, MdtConstraintDCastHinge(c), at, axis, second, side);
    else if (MdtConstraintDCastPrismatic(c))
        drawSlider(d, MdtConstraintDCastPrismatic(c), at, axis, side);
    else if (MdtConstraintDCastConeLimit(c))
        drawCone(d, MdtConstraintDCastConeLimit(c), at);
    else if (MdtConstraintDCastPulley(c))
        drawRope(d, MdtConstraintDCastPulley(c));
}

/* Draws the direction of motion of the first body in which the coordinate grows (of the second body, if the first is
 * the world): a quarter turn about a hinge's axis, an arrow beside a slider's. */
static void drawPositiveDirection(const Drawing *d, MdtConstraintID c, const MeVector3 at, const MeVector3 axis,
                                  const MeVector3 second) {
    const MeReal side = MdtConstraintGetBody(c, 0) ? 1 : -1;
    MeVector3 beside;
    if (MdtConstraintDCastHinge(c)) {
        MeVector3ScaleAndAdd(beside, axis, (MeReal)0.2 * d->length, at);
        drawArcArrow(d, beside, axis, second, (MeReal)0.15 * d->length, side * (MeReal)(ME_PI / 2), orange);
    } else if (MdtConstraintDCastPrismatic(c)) {
        MeVector3ScaleAndAdd(beside, second, (MeReal)0.08 * d->length, at);
        drawArrow(d, beside, axis, side * (MeReal)0.3 * d->length, orange);
    }
}

static void drawJoint(const Drawing *d, MdtConstraintID c) {
    MeVector3 at, axis, second, centre;
    const float *color = MdtConstraintIsEnabled(c) ? cyan : grey;
    MdtConstraintGetPosition(c, at);
    MdtConstraintGetAxes(c, axis, second);
    if (isDrawn(d, MstDebugJoints)) {
        for (unsigned int i = 0; i < 2; i++) {
            const MdtBodyID b = MdtConstraintGetBody(c, i);
            if (!b)
                continue;
            MdtBodyGetCenterOfMassPosition(b, centre);
            MdtConstraintBodyGetPosition(c, i, second);
            drawLine(d, centre, second, color);
        }
        MdtConstraintGetAxes(c, axis, second);
        drawArrow(d, at, axis, (MeReal)0.4 * d->length, color);
        drawPositiveDirection(d, c, at, axis, second);
    }
    if (isDrawn(d, MstDebugLimits))
        drawLimits(d, c, at, axis, second);
    if (isDrawn(d, MstDebugNames))
        drawText(d, at, jointName(c), cyan);
}

/* Contacts of groups are drawn with their group; all other constraints are joints. */
static void drawConstraint(const Drawing *d, MdtConstraintID c) {
    const MdtContactGroupID group = MdtConstraintDCastContactGroup(c);
    const MdtContactID single = group ? 0 : MdtConstraintDCastContact(c);
    if (group)
        for (MdtContactID k = MdtContactGroupGetFirstContact(group); k; k = MdtContactGroupGetNextContact(group, k))
            drawContact(d, k);
    else if (!single)
        drawJoint(d, c);
    else if (!MdtContactGetContactGroup(single))
        drawContact(d, single);
}

/* ---- bodies ------------------------------------------------------------------------------------------------------ */

static void drawBody(const Drawing *d, MdtBodyID b) {
    static const float *const colors[3] = {red, green, blue};
    MeVector3 centre, v, end;
    MdtBodyGetCenterOfMassPosition(b, centre);
    if (isDrawn(d, MstDebugCentresOfMass)) {
        const MeVector4 *tm = (const MeVector4 *)MdtBodyGetCenterOfMassTransformPtr(b);
        drawPoint(d, centre, white);
        for (int i = 0; i < 3; i++)
            drawLineAlong(d, centre, tm[i], (MeReal)0.2 * d->length, colors[i], end);
    }
    if (!isDrawn(d, MstDebugVelocities))
        return;
    MdtBodyGetLinearVelocity(b, v);
    if (MeVector3MagnitudeSqr(v) > 0)
        drawArrow(d, centre, v, (MeReal)0.1, green);
    MdtBodyGetAngularVelocity(b, v);
    if (MeVector3MagnitudeSqr(v) > 0)
        drawArrow(d, centre, v, (MeReal)0.1 * d->length, orange);
}

/* ---- the interface ----------------------------------------------------------------------------------------------- */

static MeBool areArgumentsValid(const char *function, unsigned int layers, const MstDebugDraw *to) {
    if (!to)
        MeWarning(1, "%s: draw is null", function);
    else if (layers & ~(unsigned int)MstDebugAll)
        MeWarning(1, "%s: layers is %u: it must be a sum of MstDebugLayer", function, layers);
    else if (!(to->forceLength >= 0) || !MeRealIsValid(to->forceLength))
        MeWarning(1, "%s: forceLength is %g: it must be 0 or positive", function, (double)to->forceLength);
    else
        return METRUE;
    return MEFALSE;
}

static void drawAll(const Drawing *d, MdtWorldID w, McdSpaceID s) {
    if (s && isDrawn(d, MstDebugShapes | MstDebugBoxes | MstDebugPartitions | MstDebugSleep | MstDebugSolver |
                            MstDebugNames))
        drawModels(d, s);
    if (!w)
        return;
    for (MdtConstraintID c = MdtConstraintGetFirst(w); c; c = MdtConstraintGetNext(c))
        if (isOfBody(d, MdtConstraintGetBody(c, 0)) || isOfBody(d, MdtConstraintGetBody(c, 1)))
            drawConstraint(d, c);
    for (MdtBodyID b = MdtBodyGetFirst(w); b; b = MdtBodyGetNext(b))
        if (isOfBody(d, b))
            drawBody(d, b);
}

void MEAPI MstDebugDrawParts(const MdtWorldID w, const McdSpaceID s, const MeReal lengthScale,
                             const unsigned int layers, const MstDebugDraw *draw) {
    if (!areArgumentsValid("MstDebugDrawParts", layers, draw))
        return;
    if (!(lengthScale > 0) || !MeRealIsValid(lengthScale)) {
        MeWarning(1, "MstDebugDrawParts: lengthScale is %g: it must be positive", (double)lengthScale);
        return;
    }
    drawAll(&(Drawing){draw, layers, lengthScale, "MstDebugDrawParts"}, w, s);
}

void MEAPI MstDebugDrawUniverse(const MstUniverseID u, const unsigned int layers, const MstDebugDraw *draw) {
    MdtWorldID w;
    ME_UNDER_OWN_NAME(w = MstUniverseGetWorld(u));
    if (!w || !areArgumentsValid("MstDebugDrawUniverse", layers, draw))
        return;
    drawAll(&(Drawing){draw, layers, u->sizes.lengthScale, "MstDebugDrawUniverse"}, w, u->space);
}
