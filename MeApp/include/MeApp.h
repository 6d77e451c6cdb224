/** @file MeApp.h
 *  Shared by demonstration programs: shows a universe on the screen, lets the mouse pull bodies, and draws contacts.
 *  RGeometry.h makes graphics of collision geometries. Includes Mst.h and MeViewer.h.
 *
 *  A program that leaves window, universe and main loop to MeApp:
 *
 *      MeApp *app = MeAppStart(argc, argv, "Falling box", 0);
 *      MstUniverseID universe = MeAppGetMstUniverse(app);
 *      MdtWorldSetGravity(MstUniverseGetWorld(universe), 0, 0, (MeReal)-9.8);
 *      MstModelAndBodyCreate(universe, McdBoxCreate(MstUniverseGetFramework(universe), 1, 1, 1), 1000);
 *      MeAppRun(app, (MeReal)(1.0 / 60), 0, 0);
 *
 *  A program with its own universe and context:
 *
 *      MeApp *app = MeAppCreateFromUniverse(universe, rc);
 *      MeAppCreateControls(app);               // the mouse, F, Space, panels; or the mouse alone:
 *      RRenderSetMouseCallBack(rc, MeAppMousePickCB, app);
 *      MeAppDrawContactsInit(app, yellow, 500);
 *      ...
 *      static void MEAPI tick(RRender *rc) {
 *          MeAppStep(app);                     // pulls the picked body, draws the contacts of the last step
 *          MstUniverseStep(universe, step);
 *      }
 *      ...
 *      MeAppDestroy(app);                      // before RRenderContextDestroy and MstUniverseDestroy
 *
 *  World, space and context are owned by the program and must outlive the MeApp. A null MeApp gets a MeWarning that
 *  names the function; the call then does nothing and returns 0. Pixels are counted from the window's upper left
 *  corner, y down, as in RMouseCallBack. Results in world coordinates are for the camera at the time of the call.
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
 * Creates the MeApp of a world, a space with models of the world's bodies (McdModelSetBody), and a context. Null, with
 * a warning, if one of them is null. Nothing is drawn and no callback is set yet.
 */
MEPUBLIC MeApp *MEAPI MeAppCreate(const MdtWorldID world, const McdSpaceID space, RRender *rc);
/** Creates the MeApp of a universe's world and space. */
MEPUBLIC MeApp *MEAPI MeAppCreateFromUniverse(const MstUniverseID u, RRender *rc);
/**
 * Releases the picked body, and frees the MeApp with its lines. Call it before the context is destroyed, and when
 * MeAppMousePickCB can no longer be called with it. Null does nothing.
 */
MEPUBLIC void MEAPI MeAppDestroy(MeApp *const app);
/** The universe it was created from; null if it was created from a world and a space. */
MEPUBLIC MstUniverseID MEAPI MeAppGetMstUniverse(MeApp *app);
/** To be called once before each step of the world: MeAppUpdateMouseSpring, MeAppDrawContacts, and the camera of
 *  MeAppFollow. It does not step the world. */
MEPUBLIC void MEAPI MeAppStep(MeApp *app);
/** @} */

/** @name A universe on the screen
 *  Additions to the 1.2 interface.
 *  @{ */
/**
 * Creates a viewer context with the options of the command line (MeViewer.h; unknown ones end the program,
 * RRenderRefuseOptions), a universe of these sizes (null: MstUniverseGrowingSizes), the MeApp of both, and the controls
 * (MeAppCreateControls). @a name is the title of the window. The universe has no gravity and no friction yet, as after
 * MstUniverseCreate. z is up on the screen, as for planes and height fields (RCameraSetUp changes that). The camera
 * looks at the origin from a distance of 12 length scales; RCameraSetView and others change that, with MeApp::rc as
 * context. Null, after a warning with the reason, if there is nothing to draw on or no memory.
 */
MEPUBLIC MeApp *MEAPI MeAppStart(int argc, const char **argv, const char *name, const MstUniverseSizes *sizes);
/** Destroys all objects of MeAppStart, in the right order. MeAppRun calls it when the program ends. Null does
 * nothing. */
MEPUBLIC void MEAPI MeAppEnd(MeApp *app);
/**
 * The main loop of a program started with MeAppStart. Each frame: MeAppStep, @a beforeStep (may be null) with @a
 * userdata, a step of the universe by @a step seconds (> 0), MeAppShowUniverse, and drawing. It does not return: when
 * the user leaves, or after the frames of `-frames`, it calls exit(), which calls MeAppEnd. A bad argument gets a
 * warning, and the function returns at once.
 */
MEPUBLIC void MEAPI MeAppRun(MeApp *app, MeReal step, MeAppStepCB beforeStep, void *userdata);
/**
 * Creates a graphic for each model of the space without one (RGraphicCreateFromModel): grey for fixed models, the
 * colours of RPalette in turn for others; wireframe for sensors. Removes graphics of models that left the space or were
 * destroyed. Call it after models were created or removed, before the next picture; it visits each model. A graphic
 * keeps the shape that the geometry had. Returns the number of models shown.
 */
MEPUBLIC int MEAPI MeAppShowUniverse(MeApp *app);
/**
 * Creates a graphic of a colour for a model, or sets the colour of its graphic. The MeApp owns it: MeAppShowUniverse
 * and MeAppDestroy remove it. Null for a geometry without a shape of its own, and, with a warning, for a bad argument.
 */
MEPUBLIC RGraphic *MEAPI MeAppShowModel(MeApp *app, McdModelID m, const float color[4]);
/**
 * Shows a model by a graphic of the program, such as one of a file (RMesh.h), which must be in the context's 3D list
 * and in the model's frame. It replaces the model's graphic, follows the model, and is owned by the MeApp from now on.
 * Returns it; null, with a warning, for a bad argument.
 */
MEPUBLIC RGraphic *MEAPI MeAppShowModelAs(MeApp *app, McdModelID m, RGraphic *rg);
/** @} */

/** @name Driving
 *  Additions to the 1.2 interface. RKey.h has how long a single key has been down.
 *  @{ */
/** Two keys as an axis: 1 while @a more is down, -1 while @a less is down, 0 while both or none are. Key names are
 *  those of RRenderGetKeyFrames: MeAppGetKeyAxis(app, "Left", "Right"). */
MEPUBLIC int MEAPI MeAppGetKeyAxis(MeApp *app, const char *less, const char *more);
/**
 * Places the camera behind a body that looks along its x axis, at a distance and an @a elevation (rad) above it; from
 * then on each MeAppStep moves and turns the camera with the body. The user may turn it further. Ends when the body is
 * destroyed, or with a null body.
 */
MEPUBLIC void MEAPI MeAppFollow(MeApp *app, MdtBodyID body, AcmeReal distance, AcmeReal elevation);
/** @} */

/** @name Contacts
 *  Each contact is drawn as a line along its normal with the contact in the middle, also between sleeping bodies.
 *  @{ */
/**
 * Allocates @a max lines (1 or more) of a colour, and draws contacts from now on; of more contacts, the first ones in
 * the order of simulation are drawn. A second call replaces the first. A bad number or colour gets a warning.
 */
MEPUBLIC void MEAPI MeAppDrawContactsInit(MeApp *const app, float color[4], int max);
/** Updates the lines to the world's present contacts; there are none before MeAppDrawContactsInit or when toggled
 * off. */
MEPUBLIC void MEAPI MeAppDrawContacts(const MeApp *app);
/** Draws contacts (not 0) from the next MeAppDrawContacts on, or removes the lines (0). */
MEPUBLIC void MEAPI MeAppToggleDrawContacts(MeApp *app, MeBool d);
/** Sets the length of the lines, m, > 0, otherwise warns; default .3 of MeApp::lengthScale. */
MEPUBLIC void MEAPI MeAppSetContactDrawLength(MeApp *app, MeReal length);
/** @} */

/** @name The mouse
 *  @{ */
/**
 * For RRenderSetMouseCallBack, with the MeApp as user data. Pressing the left button picks the nearest model under the
 * mouse if it has a body, and enables the body. A fixed model is not picked, but hides models behind it. Moving the
 * mouse moves the target; releasing the button releases the body. Other buttons are ignored.
 */
MEPUBLIC void MEAPI MeAppMousePickCB(RRender *rc, int x, int y, int modifiers, RMouseButtonWhich which,
                                     RMouseButtonEvent event, void *userdata);
/**
 * Pulls the picked body by a spring from the picked point to the point under the mouse, in the plane through the picked
 * point that faces the camera. The motion is the same for every mass: the spring is critically damped at 15 rad/s, its
 * force is limited to that at a length of 4 length scales, and it damps the body's rotation. Call it once before each
 * step, as the force acts in one step only. The body is kept enabled. It is released if model or body is destroyed, or
 * the model has left the space.
 */
MEPUBLIC void MEAPI MeAppUpdateMouseSpring(MeApp *app);
/**
 * The nearest visible model at a pixel, or null. @a normClickDir gets the unit direction of the ray there, @a pos the
 * point where it hits the model (world frame; unchanged if null is returned). With @a orth, and always in an
 * orthographic view, the ray is parallel to the line of sight, through MeAppFindClickPos.
 */
MEPUBLIC McdModelID MEAPI MeAppPickMcdModel(const MeApp *const app, int x, int y, MeVector3 normClickDir, MeVector3 pos,
                                            MeBool orth);
/** The unit direction from the camera to a pixel; in an orthographic view, the line of sight. */
MEPUBLIC void MEAPI MeAppFindClickDir(const MeApp *const app, int x, int y, MeVector3 normClickDir);
/** The point at a pixel in the plane through the camera's look-at point that faces the camera. */
MEPUBLIC void MEAPI MeAppFindClickPos(const MeApp *const app, int x, int y, MeVector3 clickPos);
/** @} */

/** @name Controls
 *  The usual controls of a demonstration program, in one call. Additions to the 1.2 interface.
 *  @{ */
/**
 * Sets up the controls. Dragging with the mouse pulls models (MeAppMousePickCB), or turns the camera where there is
 * none. F frames the model clicked last. Space throws a ball (MeAppThrowBall), unless the program uses it. F9 shows
 * panels: "Simulation" (gravity, rate, sub-steps, solver, budget, workers, sleep, swept models, materials), "Report"
 * (the world's report over time, switched on while the panel is visible), "Inspector" (the model clicked last, which is
 * outlined: its mass, velocity, sleep and friction can be set) and "Layers" (MeAppSetLayers; the arrows of contact
 * forces have a scale, and the layers can be those of the selected body alone).
 * MeAppStep must be called before each step. A second call does nothing.
 */
MEPUBLIC void MEAPI MeAppCreateControls(MeApp *app);
/**
 * Tells of the program's step, s: the variable, above 0, that it steps the universe by in each tick. The panel
 * "Simulation" then has a setting of it, in steps per second, that also sets the rate of ticks (RRenderSetTickRate).
 * Null: no setting. The variable must exist as long as the MeApp. MeAppRun does this for its own step. Without controls
 * a warning.
 */
MEPUBLIC void MEAPI MeAppSetStepPtr(MeApp *app, MeReal *step);
/** Sets the debug layers drawn over the picture: a sum of MstDebugLayer (MstDebugDraw.h); 0, the default: none. */
MEPUBLIC void MEAPI MeAppSetLayers(MeApp *app, unsigned int layers);
/** The model clicked last; null if there is none, or it has left the space. */
MEPUBLIC McdModelID MEAPI MeAppGetSelected(const MeApp *app);
/** Moves the camera so that the model clicked last, or else all models with bodies, fill a third of the picture's
 *  height. */
MEPUBLIC void MEAPI MeAppFrameSelected(MeApp *app);
/**
 * Throws a ball from the camera along its line of sight: its radius is 1/4 length scale, its density that of water for
 * a mass scale of a kilogram, its speed 20 length scales per second. There are eight balls; then the first one is
 * thrown again. Null without a universe, silently, or if there is no room, with a warning.
 */
MEPUBLIC McdModelID MEAPI MeAppThrowBall(MeApp *app);
/** @} */

ME_END_C

#endif
