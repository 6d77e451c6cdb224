/** @file MeApp.h
 *  What demonstration programs share: a universe on the screen, bodies that the mouse pulls, and contacts that are
 *  drawn. RGeometry.h makes graphics of collision geometries. It brings along Mst.h and MeViewer.h.
 *
 *  A program that leaves window, universe and main loop to MeApp:
 *
 *      MeApp *app = MeAppStart(argc, argv, "Falling box", 0);
 *      MstUniverseID universe = MeAppGetMstUniverse(app);
 *      MdtWorldSetGravity(MstUniverseGetWorld(universe), 0, 0, (MeReal)-9.8);
 *      MstModelAndBodyCreate(universe, McdBoxCreate(MstUniverseGetFramework(universe), 1, 1, 1), 1000);
 *      MeAppRun(app, (MeReal)(1.0 / 60), 0, 0);
 *
 *  A program that has its own:
 *
 *      MeApp *app = MeAppCreateFromUniverse(universe, rc);
 *      MeAppCreateControls(app);               // the mouse, F, Space, panels; or the mouse alone:
 *      RRenderSetMouseCallBack(rc, MeAppMousePickCB, app);
 *      MeAppDrawContactsInit(app, yellow, 500);
 *      ...
 *      static void MEAPI tick(RRender *rc) {
 *          MeAppStep(app);                     // pulls what the mouse holds, draws the contacts of the last step
 *          MstUniverseStep(universe, step);
 *      }
 *      ...
 *      MeAppDestroy(app);                      // before RRenderContextDestroy and MstUniverseDestroy
 *
 *  World, space and context belong to the program and outlive the MeApp. A null MeApp gets a MeWarning that names the
 *  function; then the call does nothing and returns 0. Pixels are counted from the window's upper left corner, y down,
 *  as in RMouseCallBack. What is written in world coordinates is right for the camera as it is at the call.
 */
#ifndef MEAPP_H
#define MEAPP_H

#include "MeAppTypes.h"
#include "MeViewer.h"
#include "Mst.h"

ME_BEGIN_C

/** @name Creation
 *  @{ */
/**
 * The helpers of a program with a world, a space with models of the world's bodies (McdModelSetBody), and a context.
 * Null, with a warning, if one of them is null. Nothing is drawn and no callback is set yet.
 */
MEPUBLIC MeApp *MEAPI MeAppCreate(const MdtWorldID world, const McdSpaceID space, RRender *rc);
/** The same for a universe's world and space. */
MEPUBLIC MeApp *MEAPI MeAppCreateFromUniverse(const MstUniverseID u, RRender *rc);
/**
 * Lets go of what is held, and frees the helpers with their lines. To be called before the context is destroyed, and
 * not while MeAppMousePickCB may still be called with it. Null does nothing.
 */
MEPUBLIC void MEAPI MeAppDestroy(MeApp *const app);
/** The universe it was created from; null if it was created from a world and a space. */
MEPUBLIC MstUniverseID MEAPI MeAppGetMstUniverse(MeApp *app);
/** Once before each step of the world: MeAppUpdateMouseSpring, MeAppDrawContacts, and the camera of MeAppFollow. It
 *  does not step the world. */
MEPUBLIC void MEAPI MeAppStep(MeApp *app);
/** @} */

/** @name A universe on the screen
 *  Additions to the 1.2 interface.
 *  @{ */
/**
 * A viewer context for the options of the command line (MeViewer.h; others end the program, RRenderRefuseOptions), a
 * universe of these sizes (null:
 * MstUniverseGrowingSizes), the helpers of both, and their controls (MeAppCreateControls). @a name is the title of the
 * window. The universe has no gravity and no friction yet, as MstUniverseCreate makes it. z is up
 * on the screen, as planes and height fields have it (RCameraSetUp changes that). The camera looks at the origin from
 * 12 length scales away; RCameraSetView and the others change that, the context is MeApp::rc. Null, after
 * a warning that says why, if there is nothing to draw on or no memory.
 */
MEPUBLIC MeApp *MEAPI MeAppStart(int argc, const char **argv, const char *name, const MstUniverseSizes *sizes);
/** Destroys what MeAppStart made, in the right order. MeAppRun calls it when the program ends. Null does nothing. */
MEPUBLIC void MEAPI MeAppEnd(MeApp *app);
/**
 * The main loop of a program that MeAppStart started. Each frame: MeAppStep, @a beforeStep (may be null) with @a
 * userdata, a step of the universe by @a step seconds (> 0), MeAppShowUniverse, and the picture. It does not return:
 * when the user leaves, or the frames of `-frames` are over, MeAppEnd is called by exit(). A bad argument gets a
 * warning; then it returns at once.
 */
MEPUBLIC void MEAPI MeAppRun(MeApp *app, MeReal step, MeAppStepCB beforeStep, void *userdata);
/**
 * Gives each model of the space that has none a graphic (RGraphicCreateFromModel): fixed models a grey one, the others
 * colours of RPalette in turn; of sensors the edges are drawn. Graphics of models that have left the space or were
 * destroyed are removed. To be called after models came or went, and before the next picture; it costs a look at each
 * model. A graphic keeps the shape that the geometry had. Returns how many models are shown.
 */
MEPUBLIC int MEAPI MeAppShowUniverse(MeApp *app);
/**
 * Gives a model a graphic of a colour, or its graphic that colour. It belongs to the helpers: MeAppShowUniverse
 * and MeAppDestroy remove it. Null for a geometry without a shape of its own, and, with a warning, for a bad argument.
 */
MEPUBLIC RGraphic *MEAPI MeAppShowModel(MeApp *app, McdModelID m, const float color[4]);
/**
 * The same with a graphic of the program's, in the context's 3D list and in the model's own frame, as one of a file
 * (RMesh.h): it takes the place of the one that the model has, follows the model, and belongs to the helpers from now
 * on. Returns it, or null, with a warning, for a bad argument.
 */
MEPUBLIC RGraphic *MEAPI MeAppShowModelAs(MeApp *app, McdModelID m, RGraphic *rg);
/** @} */

/** @name Driving
 *  Additions to the 1.2 interface. RKey.h tells for how long a single key has been held.
 *  @{ */
/** Two keys as an axis: 1 while @a more is held, -1 while @a less is, 0 while both or none are. Names are those of
 *  RRenderGetKeyFrames: MeAppGetKeyAxis(app, "Left", "Right"). */
MEPUBLIC int MEAPI MeAppGetKeyAxis(MeApp *app, const char *less, const char *more);
/**
 * Puts the camera behind a body that looks along its x, @a distance away and @a elevation (rad) above it; from then on
 * each MeAppStep moves it after the body and turns it as the body turns. The user may turn it further. It ends with the
 * body, or with a null one.
 */
MEPUBLIC void MEAPI MeAppFollow(MeApp *app, MdtBodyID body, AcmeReal distance, AcmeReal elevation);
/** @} */

/** @name Contacts
 *  Each is a line along its normal, its middle where the contact is; those of bodies at rest are drawn too.
 *  @{ */
/**
 * Makes room for @a max lines (1 or more) of a colour and has contacts drawn from now on; if there are more contacts,
 * those first in the order of simulation are drawn. A second call replaces the first. A bad number or colour gets a
 * warning.
 */
MEPUBLIC void MEAPI MeAppDrawContactsInit(MeApp *const app, float color[4], int max);
/** Puts a line at every contact that the world has now; before MeAppDrawContactsInit or when toggled off, none. */
MEPUBLIC void MEAPI MeAppDrawContacts(const MeApp *app);
/** Has contacts drawn (not 0), from the next MeAppDrawContacts on, or takes the lines away (0). */
MEPUBLIC void MEAPI MeAppToggleDrawContacts(MeApp *app, MeBool d);
/** The length of the lines, m, > 0; at first .3 of MeApp::lengthScale. Otherwise a warning. */
MEPUBLIC void MEAPI MeAppSetContactDrawLength(MeApp *app, MeReal length);
/** @} */

/** @name The mouse
 *  @{ */
/**
 * For RRenderSetMouseCallBack, with the MeApp as user data. The left button, pressed, holds the nearest model under the
 * mouse if it has a body; the body is enabled. A fixed model is not held, and hides what is behind it. Moving the mouse
 * moves the target; releasing the button lets go. Other buttons are not its business.
 */
MEPUBLIC void MEAPI MeAppMousePickCB(RRender *rc, int x, int y, int modifiers, RMouseButtonWhich which,
                                     RMouseButtonEvent event, void *userdata);
/**
 * Pulls the body that is held, by a spring from where it is held to the point under the mouse in the plane through that
 * point that faces the camera. The spring does for every mass the same: it is critically damped at 15 rad/s, longer
 * than 4 length scales it pulls no harder, and it slows the body's rotation. To be called once before each step: the
 * force acts in that step only. The body is kept enabled. Lets go if model or body is gone, or the model has left the
 * space.
 */
MEPUBLIC void MEAPI MeAppUpdateMouseSpring(MeApp *app);
/**
 * The nearest model that is seen at a pixel, or null. @a normClickDir becomes the direction of the ray there, of length
 * 1,
 * @a pos the point of the model that it meets (world frame; untouched for null). With @a orth the ray is parallel to
 * the line of sight, through MeAppFindClickPos; in an orthographic view it is so anyway.
 */
MEPUBLIC McdModelID MEAPI MeAppPickMcdModel(const MeApp *const app, int x, int y, MeVector3 normClickDir, MeVector3 pos,
                                            MeBool orth);
/** The direction in which the camera sees a pixel, of length 1; in an orthographic view the line of sight. */
MEPUBLIC void MEAPI MeAppFindClickDir(const MeApp *const app, int x, int y, MeVector3 normClickDir);
/** The point at a pixel, in the plane through the camera's look-at point that faces the camera. */
MEPUBLIC void MEAPI MeAppFindClickPos(const MeApp *const app, int x, int y, MeVector3 clickPos);
/** @} */

/** @name Controls
 *  What the user of a demonstration program may expect, in one call. Additions to the 1.2 interface.
 *  @{ */
/**
 * The mouse pulls models (MeAppMousePickCB) and its drag turns the camera where there is none; F frames the model that
 * was clicked last; Space, where the program has no use for it, throws a ball (MeAppThrowBall); and F9 shows panels:
 * "Simulation" (gravity, sub-steps, solver, budget, sleep, materials), "Report" (the world's report over time: it is
 * switched on while the panel is seen), "Inspector" (the model that was clicked last) and "Layers" (MeAppSetLayers).
 * MeAppStep has to be called before each step. A second call does nothing.
 */
MEPUBLIC void MEAPI MeAppCreateControls(MeApp *app);
/** What is drawn over the picture to explain it: a sum of MstDebugLayer (MstDebugDraw.h); 0, as at first, nothing. */
MEPUBLIC void MEAPI MeAppSetLayers(MeApp *app, unsigned int layers);
/** The model that was clicked last; null if there is none, or it is no longer in the space. */
MEPUBLIC McdModelID MEAPI MeAppGetSelected(const MeApp *app);
/** Moves the camera to where the model that was clicked last, else all models with bodies, fill a third of the
 *  picture's height. */
MEPUBLIC void MEAPI MeAppFrameSelected(MeApp *app);
/**
 * Throws a ball from the camera along its line of sight: its radius is a quarter of a length scale, its density that of
 * water for a mass scale of a kilogram, its speed 20 length scales a second. There are eight; then the first one is
 * thrown again. Null without a universe, silently, or if there is no room, with a warning.
 */
MEPUBLIC McdModelID MEAPI MeAppThrowBall(MeApp *app);
/** @} */

ME_END_C

#endif
