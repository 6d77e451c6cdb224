/* Driving: two keys as an axis, and a camera that follows a body. */
#include "MdtBody.h"
#include "MeInternal.h"
#include "MeMath.h"
#include "MeMessage.h"
#include "MeViewer.h"
#include "RKey.h"
#include "me_app_i.h"

int MEAPI MeAppGetKeyAxis(MeApp *app, const char *less, const char *more) {
    if (!meapp_check(app, "MeAppGetKeyAxis"))
        return 0;
    ME_RETURN_UNDER_OWN_NAME(int, (RRenderGetKeyFrames(app->rc, more) > 0) - (RRenderGetKeyFrames(app->rc, less) > 0));
}

/* theta of a camera behind the body; as it was while the body looks nearly straight up or down. */
static MeReal headingOf(const MeApp *app, MdtBodyID body, MeReal old) {
    const MeReal *forward = MdtBodyGetTransformPtr(body)[0];
    const AcmeVector3 back = {-(AcmeReal)forward[0], -(AcmeReal)forward[1], -(AcmeReal)forward[2]};
    AcmeReal theta = (AcmeReal)old, phi = 0;
    RCameraFindAngles(app->rc, back, &theta, &phi);
    return MeCos((MeReal)phi) * MeCos((MeReal)phi) > (MeReal)0.1 ? (MeReal)theta : old;
}

static void lookAt(const MeApp *app) {
    const AcmeVector3 at = {(AcmeReal)app->follow.at[0], (AcmeReal)app->follow.at[1], (AcmeReal)app->follow.at[2]};
    RCameraSetLookAt(app->rc, at);
}

void MEAPI MeAppFollow(MeApp *app, MdtBodyID body, AcmeReal distance, AcmeReal elevation) {
    if (!meapp_check(app, "MeAppFollow"))
        return;
    app->follow.body = 0;
    if (!body)
        return;
    if (!MdtBodyIsValid(body)) {
        MeWarning(1, "MeAppFollow: the body has been destroyed");
        return;
    }
    app->follow.body = body;
    app->follow.heading = headingOf(app, body, 0);
    MdtBodyGetPosition(body, app->follow.at);
    lookAt(app);
    ME_UNDER_OWN_NAME(RCameraSetView(app->rc, distance, (AcmeReal)app->follow.heading, elevation));
}

/* A part of what is missing in each frame: at 60 a second the point is reached with a time constant of 1/17 s, the
 * heading with one of 1/3 s, so that the picture swings less than the body does. */
void meapp_followStep(MeApp *app) {
    const MeReal pointShare = (MeReal)0.25, headingShare = (MeReal)0.05;
    MeVector3 at;
    if (!app->follow.body || !MdtBodyIsValid(app->follow.body)) {
        app->follow.body = 0;
        return;
    }
    const MeReal headingError = headingOf(app, app->follow.body, app->follow.heading) - app->follow.heading;
    const MeReal turn = headingShare * MeAtan2(MeSin(headingError), MeCos(headingError));
    MdtBodyGetPosition(app->follow.body, at);
    MeVector3Lerp(app->follow.at, app->follow.at, at, pointShare);
    app->follow.heading += turn;
    lookAt(app);
    RCameraRotateAngle(app->rc, (AcmeReal)turn);
}
