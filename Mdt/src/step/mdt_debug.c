/* Debug drawing of a step by MeDebugDrawAPI: contacts and their forces. */
#include "MdtConstraint.h"
#include "MdtContact.h"
#include "MdtContactGroup.h"
#include "MdtWorld.h"
#include "MeDebugDraw.h"
#include "MeInternal.h"
#include "MeMath.h"
#include "step/mdt_step_i.h"

static void drawLine(const MeVector3 start, const MeVector3 direction, MeReal length, const MeReal colour[3]) {
    MeVector3 from, to;
    MeVector3Copy(from, start);
    MeVector3ScaleAndAdd(to, direction, length, start);
    const MeProgramCall before = MeProgramEnterQuiet("MeDebugDrawAPI.line");
    MeDebugDrawAPI.line(from, to, colour[0], colour[1], colour[2]);
    MeProgramLeave(&before);
}

static void drawContact(MdtContactID c, int options) {
    static const MeReal yellow[3] = {1, 1, 0}, red[3] = {1, 0, 0};
    const MeReal normalLength = (MeReal)0.3; /* m */
    /* Forces are drawn as the acceleration of the contact's first body, .1 m for 1 m/s²: a force that carries a body's
     * weight is about a metre long, whatever the mass. */
    const MeReal perAcceleration = (MeReal)0.1;
    const MdtConstraintID constraint = MdtContactQuaConstraint(c);
    const MdtBodyID body = MdtConstraintGetBody(constraint, 0);
    MeVector3 position, v;
    MdtContactGetPosition(c, position);
    if (options & MdtDebugDrawContacts) {
        MdtContactGetNormal(c, v);
        drawLine(position, v, normalLength, yellow);
    }
    if ((options & MdtDebugDrawContactForce) && body) {
        MdtConstraintGetForce(constraint, 0, v);
        drawLine(position, v, perAcceleration / MdtBodyGetMass(body), red);
    }
}

/* Draws the contacts of a group, or a contact that is in no group. */
static void drawConstraint(MdtConstraintID constraint, int options) {
    const MdtContactGroupID group = MdtConstraintDCastContactGroup(constraint);
    const MdtContactID single = group ? 0 : MdtConstraintDCastContact(constraint);
    if (single && !MdtContactGetContactGroup(single))
        drawContact(single, options);
    if (!group)
        return;
    for (MdtContactID c = MdtContactGroupGetFirstContact(group); c; c = MdtContactGroupGetNextContact(group, c))
        drawContact(c, options);
}

void mdt_debugDraw(MdtWorldID w) {
    for (MdtConstraintID c = MdtConstraintGetFirst(w); c; c = MdtConstraintGetNext(c))
        drawConstraint(c, (int)w->debugDraw);
}

void MEAPI MdtWorldSetDebugDrawing(const MdtWorldID w, const MdtDebugDrawOptions drawOptions) {
    MDT_NEED_WORLD(w, );
    if ((unsigned)drawOptions & ~(unsigned)(MdtDebugDrawContacts | MdtDebugDrawContactForce))
        MeWarning(1,
                  "MdtWorldSetDebugDrawing: drawOptions is %d: it must be a sum of MdtDebugDrawContacts and "
                  "MdtDebugDrawContactForce",
                  (int)drawOptions);
    else
        w->debugDraw = drawOptions;
}
