/* Drops a ball for a second and has a hull collide with a box in a space, as a program outside Karma's tree would; with
 * CONSUMER_VIEWER the ball falls in the viewer. */
#include "Mcd.h"
#include "Mdt.h"
#include "MeVersion.h"
#include <stdio.h>
#include <stdlib.h>

static MdtWorldID world;
static MdtBodyID ball;

#ifdef CONSUMER_VIEWER
#include "MeViewer.h"

static void MEAPI tick(RRender *rc, void *userdata) {
    (void)rc;
    (void)userdata;
    MdtWorldStep(world, 1.0 / 60);
}
#endif

/* Are a pyramid, one deep in a box, and the box a pair, with contacts of that depth? */
static MeBool collides(void) {
    static const MeVector3 corner[] = {{0, 2, 0}, {-3, -1, -3}, {3, -1, -3}, {-3, -1, 3}, {3, -1, 3}};
    static MeMatrix4 tm[2];
    McdFrameworkID frame = McdInit(0, 2, 0, 1);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
    McdSpaceID space = McdSpaceAxisSortCreate(frame, McdAllAxes, 2, 2);
    for (int i = 0; i < 2; i++) {
        McdModelID m = McdModelCreate(i ? McdConvexMeshCreateHull(frame, corner, 5, 0) : McdBoxCreate(frame, 8, 2, 8));
        MeMatrix4TMMakeIdentity(tm[i]);
        MeMatrix4TMSetPosition(tm[i], 0, i ? (MeReal)1.5 : 0, 0);
        McdModelSetTransformPtr(m, tm[i]);
        McdSpaceInsertModel(space, m);
    }
    McdSpaceUpdateAll(space);
    McdSpaceEndChanges(space);
    McdSpacePairIterator iterator;
    McdModelPairContainer *pairs = McdModelPairContainerCreate(8);
    McdContact contacts[8];
    McdIntersectResult result;
    result.contacts = contacts;
    result.contactMaxCount = 8;
    result.contactCount = 0;
    McdSpacePairIteratorBegin(space, &iterator);
    McdSpaceGetPairs(space, &iterator, pairs);
    McdHelloEach(pairs);
    for (int i = pairs->helloFirst; i < pairs->stayingEnd; i++)
        McdIntersect(pairs->array[i], &result);
    const MeBool found = result.contactCount == 4 && fabs((double)contacts[0].separation + .5) < 1e-5;
    McdModelPairContainerDestroy(pairs);
    McdSpaceDestroy(space);
    McdFrameworkDestroyAllModelsAndGeometries(frame);
    McdTerm(frame);
    return found;
}

static void MEAPI_CDECL check(void) {
    MeVector3 p;
    MdtBodyGetPosition(ball, p);
    MdtWorldDestroy(world);
    printf("%s: the ball fell to %g\n", MeToolkitVersionString(), (double)p[1]);
    if (!(p[1] < -4.9 && p[1] > -5.1) || !collides())
        _Exit(1);
}

int main(void) {
    world = MdtWorldCreate(1, 0);
    ball = MdtBodyCreate(world);
    MdtBodyEnable(ball);
    MdtWorldSetGravity(world, 0, -9.81, 0);
#ifdef CONSUMER_VIEWER
    const char *arguments[] = {"consumer", "-null", "-frames", "60"};
    MeCommandLineOptions *options = MeCommandLineOptionsCreate(4, arguments);
    RRender *rc = RRenderContextCreate(options, 0, 1);
    MeCommandLineOptionsDestroy(options);
    if (!rc)
        return 1;
    atexit(check);
    RRun(rc, tick, 0);
#else
    for (int i = 0; i < 60; i++)
        MdtWorldStep(world, 1.0 / 60);
    check();
#endif
    return 0;
}
