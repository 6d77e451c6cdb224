/** @file MeViewer.h
 *  The viewer: a window, or a picture without one, for test programs and prototypes (User Guide App. B).
 *
 *  A program creates a context, puts graphics into it whose transforms point into the simulation, and hands its
 *  tick function to RRun:
 *
 *      MeCommandLineOptions *options = MeCommandLineOptionsCreate(argc, argv);
 *      rc = RRenderContextCreate(options, 0, 1);
 *      RRenderRefuseOptions(rc, options);
 *      MeCommandLineOptionsDestroy(options);
 *      if (!rc)
 *          return 1;
 *      RGraphicSphereCreate(rc, 1, RPalette[0], MdtBodyGetTransformPtr(body));
 *      atexit(cleanup);   // calls RRenderContextDestroy(rc)
 *      RRun(rc, tick);    // does not return
 *
 *  Where it draws is chosen on the command line: `-gl` a window, `-osmesa` an off-screen buffer, `-null` nowhere;
 *  `-help` lists the options. The environment variable KARMA_VIEWER may hold options too, separated by blanks, for
 *  programs that do not pass theirs on: KARMA_VIEWER="-null -frames 600". The command line wins over it. Without a
 *  choice it is a window if one can be opened, else the off-screen buffer.
 *
 *  The world is drawn as it is simulated, right-handed: x to the right, y up and z out of the screen for a camera at
 *  theta 0, or, after RCameraSetUp(rc, 0, 0, 1), z up and y into the screen. (The User Guide, Preface, excepts its
 *  viewer from "right-handed coordinate systems everywhere"; here it is no exception. The camera's angles are the
 *  guide's, App. B.) Lengths are the program's own; one cell of the ground's grid is one unit. 2D graphics have the
 *  window's lower left corner at (-1, -1) and its upper right corner at (1, 1).
 *
 *  Bad input (a null context or graphic, a NaN, a size that is not positive, a number out of range) gets a MeWarning
 *  that names function and argument; then the call does nothing and returns 0. This holds for every function here
 *  and is not repeated. All functions are to be called from one thread.
 */
#ifndef MEVIEWER_H
#define MEVIEWER_H

/* Programs rely on these coming along: transforms, memory, messages, times, options, colours (MeHSVtoRGB). */
#include "MeCommandLine.h"
#include "MeMath.h"
#include "MeMemory.h"
#include "MeMessage.h"
#include "MeMisc.h"
#include "MeProfile.h"
#include "MeViewerTypes.h"

ME_BEGIN_C

/** @name Render contexts
 *  @{ */

/**
 * Creates a context with default values and starts what it draws with (RInit).
 * Options in @a overrideoptions win over those in @a options; either may be null. With @a eat, the options that the
 * viewer has understood are removed from both. `-help` prints the options and ends the program. An option whose value
 * cannot be used counts as not given, after a warning; RRenderRefuseOptions ends the program then.
 * Destroy the context with RRenderContextDestroy. Returns null, after a warning that says why, if it cannot draw.
 */
MEPUBLIC RRender *MEAPI RRenderContextCreate(MeCommandLineOptions *options, MeCommandLineOptions *overrideoptions,
                                             MeBool eat);
/**
 * The same; @a cb, unless null, is called with the new context when its values are set and before anything is
 * started. @a pWnd must be null: there is no drawing into a window of the program's own.
 */
MEPUBLIC RRender *MEAPI RRenderContextCreate2(MeCommandLineOptions *options, MeCommandLineOptions *overrideoptions,
                                              int eat, void *pWnd, RCreateCallback cb);
/**
 * Ends a program that was started with options which nobody knows: to be called with the options of
 * RRenderContextCreate, which has eaten its own, when the program has eaten its own too. Where a word is left, or the
 * viewer could not use the value of one of its options, a warning names the first of them and what to write instead;
 * context and options are destroyed, and the program ends with exit code 2. Does nothing if @a rc is null.
 */
MEPUBLIC void MEAPI RRenderRefuseOptions(RRender *rc, MeCommandLineOptions *options);
/** Starts what the context draws with. Called by RRenderContextCreate. Returns 1, or 0 if it cannot be started. */
MEPUBLIC int MEAPI RInit(RRender *rc);
/**
 * Frees the context and everything that is still in its lists: graphics, lines, menus, the performance bar.
 * May be called from an atexit() handler. Called by the tick or a callback, it ends the program when that returns.
 * Returns 0, or 1 with a warning if @a rc is not a live context.
 */
MEPUBLIC int MEAPI RRenderContextDestroy(RRender *rc);
/** Ends the main loop before the next frame. */
MEPUBLIC void MEAPI RRenderQuit(RRender *rc);
/** The window's title, which also heads the help. The text is copied. */
MEPUBLIC void MEAPI RRenderSetWindowTitle(RRender *rc, const char *title);
/** The program's name, up to 39 bytes: $APPNAME in texts, and the name of pictures. At first that of its file. */
MEPUBLIC void MEAPI RRenderSetAppName(RRender *rc, const char *appname);
/** The background at the horizon; it darkens towards the top. Alpha is not used. */
MEPUBLIC void MEAPI RRenderSetBackgroundColor(RRender *rc, const float color[4]);
/**
 * How often the tick is called in a second of the clock: above 0, at first 60. The option -rate wins. In a window a
 * frame that takes long has several ticks, as far as these are done within 1/30 s; beyond that the simulation is slower
 * than the clock, and the window says so ("x0.4"). Without a window, and with -frames, -every, -film or
 * -key, each frame has one tick. MeAppRun calls it for its step. An addition to the 1.2 interface.
 */
MEPUBLIC void MEAPI RRenderSetTickRate(RRender *rc, AcmeReal ticksPerSecond);
/**
 * How much is spent on a window's picture: 3 is full, 2 without smooth outlines and without darker corners between
 * bodies, 1 and 0 are drawn smaller and scaled up, with coarser shadows; -1, as at first, lets the viewer choose by the
 * time that frames take: down, one level after half a second of frames that are longer than 1/30 s because of drawing,
 * and up, after two seconds of frames so short that the next level fits; longer where that has failed before. Without a
 * window, with -frames, -every, -film or -key, and in pictures that are written, it is full. The option -quality wins.
 * An addition to the 1.2 interface.
 */
MEPUBLIC void MEAPI RRenderSetPictureQuality(RRender *rc, int quality);
/** The level of the next picture, 0 to 3. An addition to the 1.2 interface. */
MEPUBLIC int MEAPI RRenderGetPictureQuality(RRender *rc);
/** Pauses (not 0) or continues (0): while paused, the tick is not called. */
MEPUBLIC void MEAPI RRenderSetPause(RRender *rc, int p);
/**
 * One line at the lower left of the window; null or "" removes it. Copied. A run without a window prints the last one
 * when it ends. An addition to the 1.2 interface.
 */
MEPUBLIC void MEAPI RRenderSetStatusText(RRender *rc, const char *text);
/** Shows @a fps (frames per second) in the upper right corner until it is called with a negative number. */
MEPUBLIC void MEAPI RRenderDisplayFps(RRender *rc, AcmeReal fps);
/** Prints the product's name and version. */
MEPUBLIC void MEAPI RDisplayBanner(void);
/** Prints the options that RRenderContextCreate understands. */
MEPUBLIC void MEAPI RDisplayCommandLineHelp(void);

/** Eight calm colours that colour-blind readers can tell apart. An addition to the 1.2 interface. */
extern MEPUBLIC const float RPalette[8][4];
/** @} */

/** @name The main loop
 *  RRun(rc, tick) or RRun(rc, tick, userdata), where tick is `void MEAPI tick(RRender *)`, `void
 *  MEAPI tick(RRender *, void *)` or one of the forms at the end of this header: handles input, calls tick, draws; and
 *  so on until the user leaves (Escape, Q, the window's close button), the program calls RRenderQuit, or the frames of
 *  `-frames` are over. Then it calls exit(), so cleanup belongs into an atexit() handler. RRun itself does not return
 *  (App. B, "Terminating the Program").
 *
 *  The exit code is 0; or 2 if warnings were given, when there was no window or `-frames` ended the loop. A window
 *  is drawn 60 times a second; without one, frames follow each other as fast as they can. Without a window, and with
 *  `-frames`, nobody is expected to watch: help that the program shows before RRun stays hidden and does not pause it.
 *  @{ */
MEPUBLIC void MEAPI RRunWithData(RRender *rc, RMainLoopCallBack func, void *userdata);
/** @a unused is there so that both functions are called in one way. */
MEPUBLIC void MEAPI RRunWithoutData(RRender *rc, RMainLoopCallBackNoData func, void *unused);
/** @} */

/** @name Lists
 *  What is in a list is drawn. The functions that create graphics put them into a list; RGraphicCreateEmpty does not.
 *  A graphic that is not in a list belongs to the program, which destroys it.
 *  @{ */
MEPUBLIC void MEAPI RGraphicAddToList(RRender *rc, RGraphic *rg, int is2D);
MEPUBLIC void MEAPI RGraphicRemoveFromList(RRender *rc, RGraphic *rg, int is2D);
/** Removes from the list and frees. @a is2D says which list. */
MEPUBLIC void MEAPI RGraphicDelete(RRender *rc, RGraphic *rg, int is2D);
/** Frees; if it is still in a list, removes it first. */
MEPUBLIC void MEAPI RGraphicDestroy(RGraphic *rg);
/** @} */

/** @name Creating graphics
 *  Each returns a graphic in the context's list, or null. @a matrix is the transform that it follows, read every
 *  frame; null is the identity. It must live as long as the graphic. Curved shapes have 48 sides.
 *  @{ */
MEPUBLIC RGraphic *MEAPI RGraphicBoxCreate(RRender *rc, AcmeReal width, AcmeReal height, AcmeReal depth,
                                           const float color[4], MeMatrix4Ptr matrix); /**< Along x, y, z. */
/** Along z: the apex at @a upper_height, the base at -@a lower_height. One of the two heights may be negative or 0. */
MEPUBLIC RGraphic *MEAPI RGraphicConeCreate(RRender *rc, AcmeReal radius, AcmeReal upper_height, AcmeReal lower_height,
                                            const float color[4], MeMatrix4Ptr matrix);
/** Along z, the origin at half the height. */
MEPUBLIC RGraphic *MEAPI RGraphicCylinderCreate(RRender *rc, AcmeReal radius, AcmeReal height, const float color[4],
                                                MeMatrix4Ptr matrix);
/** A cone without its tip, or a prism: @a sides sides (3 to 1024), along z from @a bottom to @a top (z coordinates). */
MEPUBLIC RGraphic *MEAPI RGraphicFrustumCreate(RRender *rc, AcmeReal bottomRadius, AcmeReal topRadius, AcmeReal bottom,
                                               AcmeReal top, int sides, const float color[4], MeMatrix4Ptr matrix);
MEPUBLIC RGraphic *MEAPI RGraphicSphereCreate(RRender *rc, AcmeReal radius, const float color[4], MeMatrix4Ptr matrix);
/** A cylinder of @a height along z with a half sphere on each end. */
MEPUBLIC RGraphic *MEAPI RGraphicSphylCreate(RRender *rc, AcmeReal radius, AcmeReal height, const float color[4],
                                             MeMatrix4Ptr matrix);
/** A ring round the z axis: @a outerRadius from the centre to the outermost point, @a innerRadius to the innermost. */
MEPUBLIC RGraphic *MEAPI RGraphicTorusCreate(RRender *rc, AcmeReal innerRadius, AcmeReal outerRadius,
                                             const float color[4], MeMatrix4Ptr matrix);
/** In the xy plane, its normal along z, seen from both sides. */
MEPUBLIC RGraphic *MEAPI RGraphicSquareCreate(RRender *rc, AcmeReal side, const float color[4], MeMatrix4Ptr matrix);
/**
 * A level square (across the axis of RCameraSetUp) at height @a y_position, with a grid of unit lines (every tenth
 * bolder) in tints of @a color, fading out towards its edge. With the texture "checkerboard" its squares are one unit
 * wide. It casts no shadow.
 */
MEPUBLIC RGraphic *MEAPI RGraphicGroundPlaneCreate(RRender *rc, AcmeReal side_length, int triangles_per_side,
                                                   const float color[4], AcmeReal y_position);
/**
 * All grounds of a context look like this (an RGroundLook), whatever their textures; -1, as at first: each by its
 * texture. The option -ground wins. An addition to the 1.2 interface.
 */
MEPUBLIC void MEAPI RRenderSetGroundLook(RRender *rc, int look);
MEPUBLIC int MEAPI RRenderGetGroundLook(RRender *rc);
/** A line as a graphic; it is drawn as native lines are. */
MEPUBLIC RGraphic *MEAPI RGraphicLineCreate(RRender *rc, const AcmeReal origin[3], const AcmeReal end[3],
                                            const float color[4], MeMatrix4Ptr matrix);
/** Text in the 2D list, its upper left corner at the given place. It is parsed (RParseText) and copied. */
MEPUBLIC RGraphic *MEAPI RGraphicTextCreate(RRender *rc, const char *text, AcmeReal orig_x, AcmeReal orig_y,
                                            const float color[4]);
/** A rectangle in the 2D list: the coordinates of its left edge and of its top edge, and its size. */
MEPUBLIC RGraphic *MEAPI RGraphic2DRectangleCreate(RRender *rc, AcmeReal orig_x, AcmeReal orig_y, AcmeReal width,
                                                   AcmeReal height, const float color[4]);
/**
 * An object from an .ASE file, normalized to fit a cube of side 1 round the origin (RGraphicNormalize), then scaled.
 * Null after a warning that names the file, if it cannot be read.
 */
MEPUBLIC RGraphic *MEAPI RGraphicCreate(RRender *rc, const char *filename, AcmeReal xScale, AcmeReal yScale,
                                        AcmeReal zScale, const float color[4], MeMatrix4Ptr matrix, MeBool is2D,
                                        MeBool bKeepAspectRatio);
/**
 * An object from an .ASE file, scaled. Its materials are not read. Null after a warning, if it cannot be read. RMesh.h
 * has other formats.
 */
MEPUBLIC RGraphic *MEAPI RGraphicLoadASE(RRender *rc, const char *filename, AcmeReal xScale, AcmeReal yScale,
                                         AcmeReal zScale, const float color[4], MeMatrix4Ptr matrix);
/**
 * The same without the objects whose name begins with MCD: so modelling programs mark shapes that are there for
 * collision only (MCDBX_..., MCDSP_..., MCDCX_...).
 */
MEPUBLIC RGraphic *MEAPI RGraphicLoadASENoMCD(RRender *rc, const char *filename, AcmeReal xScale, AcmeReal yScale,
                                              AcmeReal zScale, const float color[4], MeMatrix4Ptr matrix);
/** RGraphicLoadASE, then RGraphicTranslateVertices: @a offset is in the graphic's own frame, after the scale. */
MEPUBLIC RGraphic *MEAPI RGraphicLoadASEwithOffset(RRender *rc, const char *filename, AcmeReal xScale, AcmeReal yScale,
                                                   AcmeReal zScale, const float color[4], const MeVector3 offset,
                                                   MeMatrix4Ptr matrix);
/** The same of RGraphicLoadASENoMCD. */
MEPUBLIC RGraphic *MEAPI RGraphicLoadASEwithOffsetNoMcd(RRender *rc, const char *filename, AcmeReal xScale,
                                                        AcmeReal yScale, AcmeReal zScale, const float color[4],
                                                        const MeVector3 offset, MeMatrix4Ptr matrix);
/** An object of @a numVertices vertices (a multiple of 3), all 0, white, in no list. */
MEPUBLIC RGraphic *MEAPI RGraphicCreateEmpty(int numVertices);
/**
 * A sky: the named texture on the inside of a half sphere far away, repeated @a tileU times round and @a tileV times
 * up. A second one takes the first one's place; a null name removes it.
 */
MEPUBLIC void MEAPI RRenderSkydomeCreate(RRender *const rc, const char *name, int tileU, int tileV);
/**
 * A new graphic, in the 3D list, of the triangles of @a a and of those of @a b moved by @a transform (null: the
 * identity). It has the look and the transform pointer of @a a. The two are left as they are.
 */
MEPUBLIC RGraphic *MEAPI RGraphicCombine(RRender *rc, RGraphic *a, RGraphic *b, MeMatrix4Ptr transform);
/** Sides of the spheres created from now on, 8 to 256 (at first 48), which have half as many rings. */
MEPUBLIC void MEAPI RRenderSetSphereResolution(RRender *r, int res);
MEPUBLIC int MEAPI RRenderGetSphereResolution(RRender *r);
/** @} */

/** @name Changing graphics
 *  @{ */
/** Null: the identity. */
MEPUBLIC void MEAPI RGraphicSetTransformPtr(RGraphic *g, MeMatrix4Ptr matrix);
/** Sets the ambient and the diffuse colour; the emissive and the specular one become 0. */
MEPUBLIC void MEAPI RGraphicSetColor(RGraphic *g, const float color[4]);
/** The ambient colour. */
MEPUBLIC void MEAPI RGraphicGetColor(RGraphic *g, float color[4]);
MEPUBLIC void MEAPI RGraphicSetWireframe(RGraphic *g, MeBool b);
MEPUBLIC MeBool MEAPI RGraphicIsWireframe(RGraphic *g);
/** Moves a line that RGraphicLineCreate made. Returns 0, or 1 with a warning if it cannot. */
MEPUBLIC int MEAPI RGraphicLineMoveEnds(RGraphic *lineG, const AcmeReal *origin, const AcmeReal *end);
/** Multiplies the vertices' coordinates; the normals stay right. The scales must not be 0. */
MEPUBLIC void MEAPI RGraphicScale(RGraphic *rg, AcmeReal xScale, AcmeReal yScale, AcmeReal zScale);
/** Adds @a offset to the vertices' coordinates. */
MEPUBLIC void MEAPI RGraphicTranslateVertices(RRender *rc, RGraphic *rg, const MeVector3 offset);
/** Moves and scales the vertices into the cube from -0.5 to 0.5; with @a bKeepAspectRatio, by the same on all axes. */
MEPUBLIC void MEAPI RGraphicNormalize(RGraphic *rg, int bKeepAspectRatio);
/**
 * Replaces the triangles of @a rg by those of @a numStrips triangle strips. Strip i is @a stripSize[i] vertices from
 * @a strips[@a stripStart[i]] on. @a rg must have room for 3 vertices per triangle.
 */
MEPUBLIC void MEAPI RConvertTriStripToTriList(RGraphic *rg, RObjectVertex *strips, int *stripSize, int *stripStart,
                                              int numStrips);
/**
 * Once told a renderer to prepare a graphic. Here each frame finds by itself what has changed, and keeps the rest on
 * the graphics card: nothing is to be done.
 */
MEPUBLIC void MEAPI RGraphicCalcOGLDisplayList(RGraphic *rg);
/** Copies the transforms that graphics follow into their m_Matrix. Every frame does it. */
MEPUBLIC void MEAPI RRenderUpdateGraphicMatrices(RRender *rc);
/** @} */

/** @name Native lines
 *  They are as thick on the screen at every distance, and are not lit.
 *  @{ */
MEPUBLIC RNativeLine *MEAPI RNLineCreate(RRender *const rc, const AcmeReal start[3], const AcmeReal end[3],
                                         const AcmeReal color[4], const MeVector4 *const matrix);
MEPUBLIC void MEAPI RNLineMoveEnds(RNativeLine *const line, const AcmeReal start[3], const AcmeReal end[3]);
MEPUBLIC void MEAPI RNLineSetColor(RNativeLine *line, const AcmeReal color[4]);
MEPUBLIC void MEAPI RNLineAddToList(RRender *rc, RNativeLine *line);
MEPUBLIC void MEAPI RNLineRemoveFromList(RRender *rc, RNativeLine *line);
/** Removes from the list and frees. */
MEPUBLIC void MEAPI RNLineDelete(RRender *rc, RNativeLine *line);
/** Frees; if it is still in a list, removes it first. */
MEPUBLIC void MEAPI RNLineDestroy(RNativeLine *line);
/** Adds a line in world coordinates that is drawn until RLineRemoveAll. */
MEPUBLIC void MEAPI RLineAdd(RRender *const rc, const AcmeVector3 start, const AcmeVector3 end, const AcmeReal r,
                             const AcmeReal g, const AcmeReal b);
/** Removes all lines that RLineAdd made. */
MEPUBLIC void MEAPI RLineRemoveAll(RRender *rc);
/** @} */

/** @name Particles
 *  A particle system draws an equilateral triangle at each of @a numParticles places of the world, turned towards the
 *  camera. @a positions is kept by pointer, must live as long, and is read every frame; particles that are not finite
 *  are not drawn. The size is a triangle's side.
 *  @{ */
/** A new system in the context's list, which it belongs to. @a tex_filename is a texture's name, or null for none. */
MEPUBLIC RParticleSystem *MEAPI RParticleSystemCreate(RRender *rc, int numParticles, MeVector3 *positions,
                                                      const char *tex_filename, const float color[4],
                                                      AcmeReal tri_size);
/** The same, in no list, with a texture by number (RRenderTextureCreate); -1 for none. */
MEPUBLIC RParticleSystem *MEAPI RParticleSystemNew(int numParticles, MeVector3 *positions, int tex_id,
                                                   const float color[4], AcmeReal size);
MEPUBLIC void MEAPI RParticleSystemAddToList(RRender *rc, RParticleSystem *ps);
MEPUBLIC void MEAPI RParticleSystemRemoveFromList(RRender *rc, RParticleSystem *ps);
/** Frees; if it is still in a list, removes it first. */
MEPUBLIC void MEAPI RParticleSystemDestroy(RParticleSystem *ps);
/** @} */

/** @name The camera
 *  It looks at a point from a distance (at least 0.01), in a direction given by two angles in radians: theta in the
 *  xz plane, anticlockwise from the z axis as seen from above, and phi, the elevation above that plane:
 *  position = look-at + distance (cos phi sin theta, sin phi, cos phi cos theta); with z up (RCameraSetUp) it is
 *  look-at + distance (cos phi sin theta, -cos phi cos theta, sin phi).
 *  At first, as in 1.2: distance 15, theta 0, phi 0, at (0, 0, 1); so the camera is at (0, 0, 16) and looks along -z, x
 *  to the right and y up. theta is wrapped to -pi..pi, phi is kept in -pi/2..pi/2.
 *  `-camera` wins over what the program sets before RRun.
 *  @{ */
/**
 * The axis of the world that is up on the screen, of any length but 0: at first (0, 1, 0); MeAppStart makes it
 * (0, 0, 1). What this header says of x, y and z of the camera's angles and views, the ground and the sky holds in the
 * world turned by the shortest rotation that takes the axis to y (the other way about, by half a turn about x and the
 * shortest after it, for an axis whose y is negative). So with z up, theta 0 is seen from -y, with x to the right.
 * Angles, distance and look-at point stay as they are, grounds and sky that exist turn along, and so do the lights,
 * about the origin: they shine on the screen from where they did. An addition to the 1.2 interface.
 */
MEPUBLIC void MEAPI RCameraSetUp(RRender *rc, AcmeReal x, AcmeReal y, AcmeReal z);
/** The axis of RCameraSetUp, of length 1; RCameraGetUp is the camera's own. An addition to the 1.2 interface. */
MEPUBLIC void MEAPI RCameraGetUpAxis(RRender *rc, AcmeVector3 axis);
/**
 * The angles of a camera that is in this direction (world, of any length) from its look-at point. @a theta keeps its
 * value for a direction along the up axis, both keep theirs for one without length. An addition to the 1.2 interface.
 */
MEPUBLIC void MEAPI RCameraFindAngles(RRender *rc, const AcmeVector3 direction, AcmeReal *theta, AcmeReal *phi);
MEPUBLIC void MEAPI RCameraSetLookAt(RRender *rc, const AcmeVector3 lookAt);
MEPUBLIC void MEAPI RCameraGetLookAt(RRender *rc, AcmeVector3 camlookat);
MEPUBLIC void MEAPI RCameraSetView(RRender *rc, AcmeReal dist, AcmeReal angle, AcmeReal elevation);
MEPUBLIC void MEAPI RCameraSetLookAtAndPosition(RRender *rc, const MeVector3 lookAt, const MeVector3 position);
MEPUBLIC void MEAPI RCameraGetPosition(RRender *rc, AcmeVector3 pos);
MEPUBLIC void MEAPI RCameraGetLookDir(RRender *rc, AcmeVector3 dir); /**< Of length 1. */
MEPUBLIC void MEAPI RCameraGetUp(RRender *rc, AcmeVector3 up);       /**< Of length 1. */
MEPUBLIC AcmeReal MEAPI RCameraGetDistance(RRender *rc);
MEPUBLIC AcmeReal MEAPI RCameraGetRotation(RRender *rc);  /**< theta */
MEPUBLIC AcmeReal MEAPI RCameraGetElevation(RRender *rc); /**< phi */
MEPUBLIC void MEAPI RCameraSetRotation(RRender *rc, const MeReal rotation);
MEPUBLIC void MEAPI RCameraSetElevation(RRender *rc, const MeReal elevation);
MEPUBLIC void MEAPI RCameraSetOffset(RRender *rc, const MeReal offset); /**< The distance. */
/** Adds to the distance. */
MEPUBLIC void MEAPI RCameraZoom(RRender *rc, AcmeReal dist);
/** Adds to theta. */
MEPUBLIC void MEAPI RCameraRotateAngle(RRender *rc, AcmeReal d_theta);
/** Adds to phi. */
MEPUBLIC void MEAPI RCameraRotateElevation(RRender *rc, AcmeReal d_phi);
/** Move the camera and the look-at point along the camera's own axes: right, up, and towards the viewer. */
MEPUBLIC void MEAPI RCameraPanX(RRender *rc, AcmeReal dist);
MEPUBLIC void MEAPI RCameraPanY(RRender *rc, AcmeReal dist);
MEPUBLIC void MEAPI RCameraPanZ(RRender *rc, AcmeReal dist);
/** The vertical field of view, radians, more than 0 and less than pi; at first 0.7. Ends an orthographic view. */
MEPUBLIC void MEAPI RCameraSetFov(RRender *rc, AcmeReal fov);
/**
 * Without perspective: @a zoomFactor is the height of what is seen, and what is nearer to the look-at point than
 * @a viewDepth along the line of sight is drawn. RCameraSetFov brings the perspective back.
 */
MEPUBLIC void MEAPI RCameraSetOrthographicView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth);
/** The same from one side: from +z, -z, -x, +x, +y and -y; with z up, from -y, +y, -x, +x, +z and -z. */
MEPUBLIC void MEAPI RCameraSetFrontView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth);
MEPUBLIC void MEAPI RCameraSetBackView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth);
MEPUBLIC void MEAPI RCameraSetLeftView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth);
MEPUBLIC void MEAPI RCameraSetRightView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth);
MEPUBLIC void MEAPI RCameraSetTopView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth);
MEPUBLIC void MEAPI RCameraSetBottomView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth);
/** A view of the program's own: world to camera, as RRender::m_CameraMatrix. Other camera functions end it. */
MEPUBLIC void MEAPI RCameraSetMatrix(RRender *rc, MeMatrix4Ptr m);
/** Makes position and matrix fit the look-at point and the polar coordinates. Only needed after writing members. */
MEPUBLIC void MEAPI RCameraUpdate(RRender *rc);
/** Makes the projection fit the field of view and the window. Every frame does it. */
MEPUBLIC void MEAPI RRenderUpdateProjectionMatrices(RRender *rc);
/**
 * Where a pixel is in a plane that fills the window, is @a width wide and @a height high, and has its origin in the
 * middle, x to the right and y up. The pixel is counted from the upper left corner, y down, as in RMouseCallBack.
 */
MEPUBLIC void MEAPI RCalculatePortalCoordinates(RRender *rc, AcmeReal width, AcmeReal height, int x, int y,
                                                AcmeReal *portalx, AcmeReal *portaly);
/** @} */

/** @name Lights
 *  One ambient light, two directional ones (the first casts shadows), one point light. The ambient one and the two
 *  directional ones are on at first. See RRender for their colours.
 *  @{ */
MEPUBLIC void MEAPI RLightSwitchOn(RRender *rc, RRenderLight light);
MEPUBLIC void MEAPI RLightSwitchOff(RRender *rc, RRenderLight light);
/** @} */

/** @name Textures
 *  Up to 100; the guide's viewer had 25. A texture is a .bmp file or, beyond Karma, a .png, .jpg or .tga file, given by
 *  name without the extension. It is looked for in the working directory, in $KARMA_TEXTURES, and in `textures` and
 *  `../textures`, and is read when it is first drawn; without the file there is a message (MeInfo, once) and no
 *  texture. Two are built in: "checkerboard" and "font".
 *  @{ */
/** The texture's number, the same for the same name; -1 if all are in use. */
MEPUBLIC int MEAPI RRenderTextureCreate(RRender *rc, const char *filename);
/** Gives a graphic a texture. Returns its number, or -1. A null name takes the texture off. */
MEPUBLIC int MEAPI RGraphicSetTexture(RRender *rc, RGraphic *rg, const char *filename);
/** @} */

/** @name Controls
 *  The viewer's own keys: F1 help and pause, F2 a picture NAME-0001.png into the working directory, F3 performance
 *  bar, F4 wireframe, F5 shadows, F9 menu and panels (RPanel.h), P pause, O or . one step, Escape or Q quit, PageUp and
 *  PageDown zoom, Ctrl and arrows turn the camera, Home the first view. The mouse: dragging turns the camera; with the
 *  right or the middle button, or Shift, it moves it; the wheel zooms to the pointer. What begins on a panel is the
 *  panel's. Upper and lower case are the same.
 *
 *  The program's: eight direction buttons (arrow keys; w s a d for the second four), actions and the mouse.
 *
 *  RRenderSetUpCallBack(rc, func) or (rc, func, userdata), and so for Down, Left, Right, Up2, Down2, Left2, Right2;
 *  RRenderSetActionNCallBack(rc, N, func) or (rc, N, func, userdata), N from 0 to 5;
 *  func is `void MEAPI func(RRender *, void *)`, `void MEAPI func(RRender *)` or one of the forms at the end of this
 *  header, called when the button is pressed, and again and again while a direction button is held. 0 or NULL removes
 *  it. Keys of the actions: 1 Space, 2 Enter, 3 to 5 the digits; 0 has none.
 *
 *  RRenderSetMouseCallBack(rc, func) or (rc, func, userdata): func gets the left button's events while neither Ctrl
 *  nor Shift is held; then Ctrl and the left button turn the camera, and without Ctrl a drag that func leaves to it
 *  (RRenderLeaveMouse).
 *  RRenderSetJoystickCallBack is the same for a joystick; it is kept, but never called on this platform.
 *  @{ */
MEPUBLIC void MEAPI RRenderSetButtonCallBack(RRender *rc, RButtonList which, RButtonPressCallBack func, void *userdata);
MEPUBLIC void MEAPI RRenderSetButtonCallBackNoData(RRender *rc, RButtonList which, RButtonPressCallBackNoData func,
                                                   void *unused);
MEPUBLIC void MEAPI RRenderSetActionCallBack(RRender *rc, int N, RButtonPressCallBack func, void *userdata);
MEPUBLIC void MEAPI RRenderSetActionCallBackNoData(RRender *rc, int N, RButtonPressCallBackNoData func, void *unused);

/** The same with a text that says what the button does, for the help. The text is copied; it may be null. */
MEPUBLIC void MEAPI RRenderSetUpCallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata,
                                                 const char *text);
MEPUBLIC void MEAPI RRenderSetDownCallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata,
                                                   const char *text);
MEPUBLIC void MEAPI RRenderSetLeftCallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata,
                                                   const char *text);
MEPUBLIC void MEAPI RRenderSetRightCallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata,
                                                    const char *text);
MEPUBLIC void MEAPI RRenderSetUp2CallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata,
                                                  const char *text);
MEPUBLIC void MEAPI RRenderSetDown2CallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata,
                                                    const char *text);
MEPUBLIC void MEAPI RRenderSetLeft2CallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata,
                                                    const char *text);
MEPUBLIC void MEAPI RRenderSetRight2CallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata,
                                                     const char *text);
MEPUBLIC void MEAPI RRenderSetActionNCallBackWithText(RRender *rc, int N, RButtonPressCallBack func, void *userdata,
                                                      const char *text);
MEPUBLIC void MEAPI RRenderSetMouseCallBackWithText(RRender *rc, RMouseCallBack func, void *userdata, const char *text);
MEPUBLIC void MEAPI RRenderSetJoystickCallBackWithText(RRender *rc, RJoystickCallBack func, void *userdata,
                                                       const char *text);
/**
 * Gives action @a N (2 to 5) another key: a printable ASCII character. While the action has a callback, that one is
 * called and not what the viewer itself does with the key.
 */
MEPUBLIC void MEAPI RRenderSetActionNKey(RRender *rc, const unsigned int N, const char key);
/**
 * For helpers of programs: a printable ASCII character whose callback is called unless the program has an action or a
 * direction button on that key; before the viewer's own use of it. A null @a func takes the viewer's own use away too.
 * The text is for the help; copied, may be null. An addition to the 1.2 interface.
 */
MEPUBLIC void MEAPI RRenderSetKeyCallBack(RRender *rc, char key, RButtonPressCallBack func, void *userdata,
                                          const char *text);
/**
 * Called by a mouse callback that has been told kRNewlyPressed: it does not want this drag, which turns the camera
 * then. An addition to the 1.2 interface.
 */
MEPUBLIC void MEAPI RRenderLeaveMouse(RRender *rc);
/** @} */

/** @name Menus
 *  Up and Down choose an entry of the menu shown, Right and Left change it; a click does what Right does, on the left
 *  half of a value entry what Left does. F9 shows and hides the default menu, and the panels (RPanel.h).
 *  @{ */
/** A menu without entries. It belongs to the context, which destroys it; RMenuDestroy does so earlier. */
MEPUBLIC RMenu *MEAPI RMenuCreate(RRender *rc, const char *name);
/**
 * Entries of other menus that lead to this one stay, but do nothing. One that is there no more,
 * as after its context has gone, is ignored.
 */
MEPUBLIC void MEAPI RMenuDestroy(RMenu *rm);
MEPUBLIC void MEAPI RMenuDisplay(RMenu *rm);
MEPUBLIC void MEAPI RRenderSetDefaultMenu(RRender *rc, RMenu *menu);
/** @a func, which may be null, is called with each new state. */
MEPUBLIC void MEAPI RMenuAddToggleEntry(RMenu *rm, const char *name, RMenuToggleCallback func, MeBool defaultValue);
/**
 * A number between @a lo and @a hi that changes by @a increment. @a func, which may be null, is called with each new
 * value. Warns and uses the nearest sensible value if @a lo is above @a hi or the default is outside.
 */
MEPUBLIC void MEAPI RMenuAddValueEntry(RMenu *rm, const char *name, RMenuValueCallback func, MeReal hi, MeReal lo,
                                       MeReal increment, MeReal defaultValue);
MEPUBLIC void MEAPI RMenuAddSubmenuEntry(RMenu *rm, const char *name, RMenu *submenu);
/** @} */

/** @name Help and text
 *  @{ */
/**
 * The program's part of the help that F1 shows: @a arraySize lines, put through RParseText and copied. Each call
 * replaces the lines. `char *help[]` and `const char *help[]` are accepted as they are.
 */
MEPUBLIC void MEAPI RRenderCreateUserHelp(RRender *const rc, const char *const help[], const int arraySize);
/** Shows the help and pauses, or hides it and continues. */
MEPUBLIC void MEAPI RRenderToggleUserHelp(RRender *const rc);
/**
 * Replaces $UP, $DOWN, $LEFT, $RIGHT, $UP2 ... $RIGHT2, $ACTION1 ... $ACTION5, $MOUSE and $APPNAME by what they stand
 * for; other words after a $ stay. @a text_out gets at most @a outbuffersize bytes, its end included.
 */
MEPUBLIC void MEAPI RParseText(RRender *rc, const char *text_in, char *text_out, int outbuffersize);
/** @} */

/** @name Performance
 *  @{ */
/**
 * A bar that shows the milliseconds of the profile sections "Collision", "Dynamics" and "Render", the budget of one
 * sixtieth of a second, and frames per second. Starts profiling, if it does not run. It belongs to the context; a
 * second call returns the same. Without a window it is shown, and something is measured for it, only with `-bar`: it
 * makes pictures differ, and has every frame drawn.
 */
MEPUBLIC RPerformanceBar *MEAPI RPerformanceBarCreate(RRender *rc);
/** Shows these times (seconds) in this frame instead of the measured ones. */
MEPUBLIC void MEAPI RPerformanceBarUpdate(RRender *rc, AcmeReal coltime, AcmeReal dyntime, AcmeReal rentime,
                                          AcmeReal idletime);
/** Marks at every quarter of the budget along the bar: a graphic in the 2D list, or null if there is no bar. */
MEPUBLIC RGraphic *MEAPI RPerformanceBarCreateTicks(RRender *rc);
/** @} */

ME_END_C

/* What follows makes one name serve calls with and without user data, and callbacks of several forms:
 *
 *     void f(RRender *, void *)   and with user data of another type, as `int *` or `MyApp *`: get rc and the user data
 *     void f(RRender *)           gets rc
 *     void f()                    gets both, which a function without parameters ignores; in C, such a declaration
 *                                 may stand for any of the three
 *     0, NULL, nullptr            none
 *
 * each also with a result, as int, that is ignored. Whatever cannot be called so does not compile. */
#ifdef __cplusplus

/* The two forms of a callback, at most one of them not null. */
struct RButtonCallBackArgument {
    RButtonPressCallBack func = nullptr;
    RButtonPressCallBackNoData funcNoData = nullptr;

    RButtonCallBackArgument(decltype(nullptr)) {}
    template <class Result, class Data>
    RButtonCallBackArgument(Result(MEAPI *f)(RRender *, Data *))
        : func(reinterpret_cast<RButtonPressCallBack>(reinterpret_cast<void(MEAPI *)()>(f))) {}
    template <class Result>
    RButtonCallBackArgument(Result(MEAPI *f)(RRender *))
        : funcNoData(reinterpret_cast<RButtonPressCallBackNoData>(reinterpret_cast<void(MEAPI *)()>(f))) {}
    template <class Result>
    RButtonCallBackArgument(Result(MEAPI *f)())
        : func(reinterpret_cast<RButtonPressCallBack>(reinterpret_cast<void(MEAPI *)()>(f))) {}
    /* A lambda that captures nothing. */
    template <class Lambda> RButtonCallBackArgument(Lambda f, int Lambda::* = nullptr) : RButtonCallBackArgument(+f) {}
};

/* Mouse and joystick: Func has fixed parameters and then the user data. */
template <class Func, class... Fixed> struct RAnalogCallBackArgument {
    Func func = nullptr;

    RAnalogCallBackArgument(decltype(nullptr)) {}
    template <class Result, class Data>
    RAnalogCallBackArgument(Result(MEAPI *f)(RRender *, Fixed..., Data *))
        : func(reinterpret_cast<Func>(reinterpret_cast<void(MEAPI *)()>(f))) {}
    template <class Result>
    RAnalogCallBackArgument(Result(MEAPI *f)()) : func(reinterpret_cast<Func>(reinterpret_cast<void(MEAPI *)()>(f))) {}
    template <class Lambda> RAnalogCallBackArgument(Lambda f, int Lambda::* = nullptr) : RAnalogCallBackArgument(+f) {}
};
using RMouseCallBackArgument =
    RAnalogCallBackArgument<RMouseCallBack, int, int, int, RMouseButtonWhich, RMouseButtonEvent>;
using RJoystickCallBackArgument = RAnalogCallBackArgument<RJoystickCallBack, AcmeReal, AcmeReal>;

inline void RRun(RRender *rc, RButtonCallBackArgument tick, void *userdata = nullptr) {
    if (tick.funcNoData)
        RRunWithoutData(rc, tick.funcNoData, userdata);
    else
        RRunWithData(rc, tick.func, userdata);
}
#define R_BUTTON_SETTER(Name)                                                                                          \
    inline void RRenderSet##Name##CallBack(RRender *rc, RButtonCallBackArgument func, void *userdata = nullptr) {      \
        if (func.funcNoData)                                                                                           \
            RRenderSetButtonCallBackNoData(rc, kRButton##Name, func.funcNoData, userdata);                             \
        else                                                                                                           \
            RRenderSetButtonCallBack(rc, kRButton##Name, func.func, userdata);                                         \
    }
R_BUTTON_SETTER(Up)
R_BUTTON_SETTER(Down)
R_BUTTON_SETTER(Left)
R_BUTTON_SETTER(Right)
R_BUTTON_SETTER(Up2)
R_BUTTON_SETTER(Down2)
R_BUTTON_SETTER(Left2)
R_BUTTON_SETTER(Right2)
#undef R_BUTTON_SETTER
inline void RRenderSetActionNCallBack(RRender *rc, int N, RButtonCallBackArgument func, void *userdata = nullptr) {
    if (func.funcNoData)
        RRenderSetActionCallBackNoData(rc, N, func.funcNoData, userdata);
    else
        RRenderSetActionCallBack(rc, N, func.func, userdata);
}
inline void RRenderSetMouseCallBack(RRender *rc, RMouseCallBackArgument func, void *userdata = nullptr) {
    RRenderSetMouseCallBackWithText(rc, func.func, userdata, nullptr);
}
inline void RRenderSetJoystickCallBack(RRender *rc, RJoystickCallBackArgument func, void *userdata = nullptr) {
    RRenderSetJoystickCallBackWithText(rc, func.func, userdata, nullptr);
}

#else

/* The ninth argument: a name chosen by how many stand before the names. */
#define R_PICK(a1, a2, a3, a4, a5, a6, a7, a8, name, ...) name
#define R_PICK_2_OR_3(with3, with2, ...)                                                                               \
    R_PICK(__VA_ARGS__, R_COUNT, R_COUNT, R_COUNT, R_COUNT, R_COUNT, with3, with2, R_COUNT, 0)
#define R_PICK_3_OR_4(with4, with3, ...)                                                                               \
    R_PICK(__VA_ARGS__, R_COUNT, R_COUNT, R_COUNT, R_COUNT, with4, with3, R_COUNT, R_COUNT, 0)
#define R_MUST(condition, message)                                                                                     \
    ((void)sizeof(struct {                                                                                             \
        _Static_assert(condition, message);                                                                            \
        int unused;                                                                                                    \
    }))
#define R_COUNT(...)              R_MUST(0, "wrong number of arguments")

/* One association at a time: `void f()` is compatible with several, which one _Generic does not allow. */
#define R_IS(func, Type, yes, no) _Generic((func), Type : yes, default : no)
/* What takes the callback: `func` is called with user data unless it is known to have no parameter for them. */
#define R_TAKER(func, WithData, NoData, takesWithData, takesNoData)                                                    \
    R_IS(func, WithData, takesWithData, R_IS(func, NoData, takesNoData, takesWithData))
/* The callback in the type that its taker has. A null pointer constant stays one. */
#define R_CALLBACK(func, WithData, NoData)                                                                             \
    R_IS(func, WithData, func,                                                                                         \
         R_IS(func, NoData, func,                                                                                      \
              _Generic((func), int: (func), void *: (func), default: (WithData)(void(MEAPI *)(void))(func))))
/* Refuses what can not be called with these arguments, by a call that is not made; and integers other than 0. */
#define R_CHECK(func, WithData, NoData, IntNoData, arguments)                                                          \
    ((void)sizeof((R_IS(func, WithData, (WithData)0,                                                                   \
                        _Generic((func), NoData: (WithData)0, IntNoData: (WithData)0,                                  \
                                 default: _Generic((func), void(MEAPI *)(void): (WithData)0,                           \
                                                   int(MEAPI *)(void): (WithData)0, int: (WithData)0,                  \
                                                   void *: (WithData)0, default: (func)))) arguments,                  \
                   0)),                                                                                                \
     R_MUST(_Generic((func), int: (func), default: 0) == 0, "a callback is a function, 0 or NULL"))

#define RRun(...)        R_PICK_2_OR_3(R_RUN3, R_RUN2, __VA_ARGS__)(__VA_ARGS__)
#define R_RUN2(rc, func) R_RUN3(rc, func, 0)
#define R_RUN3(rc, func, userdata)                                                                                     \
    (R_CHECK_BUTTON(func), R_TAKER(func, RMainLoopCallBack, RMainLoopCallBackNoData, RRunWithData, RRunWithoutData)(   \
                               rc, R_CALLBACK(func, RMainLoopCallBack, RMainLoopCallBackNoData), userdata))
#define R_CHECK_BUTTON(func)                                                                                           \
    R_CHECK(func, RButtonPressCallBack, RButtonPressCallBackNoData, int(MEAPI *)(RRender *), ((RRender *)0, (void *)0))

#define R_BUTTON2(which, rc, func) R_BUTTON3(which, rc, func, 0)
#define R_BUTTON3(which, rc, func, userdata)                                                                           \
    (R_CHECK_BUTTON(func),                                                                                             \
     R_TAKER(func, RButtonPressCallBack, RButtonPressCallBackNoData, RRenderSetButtonCallBack,                         \
             RRenderSetButtonCallBackNoData)(                                                                          \
         rc, which, R_CALLBACK(func, RButtonPressCallBack, RButtonPressCallBackNoData), userdata))
#define R_BUTTON(which, ...)          R_PICK_2_OR_3(R_BUTTON3, R_BUTTON2, __VA_ARGS__)(which, __VA_ARGS__)
#define RRenderSetUpCallBack(...)     R_BUTTON(kRButtonUp, __VA_ARGS__)
#define RRenderSetDownCallBack(...)   R_BUTTON(kRButtonDown, __VA_ARGS__)
#define RRenderSetLeftCallBack(...)   R_BUTTON(kRButtonLeft, __VA_ARGS__)
#define RRenderSetRightCallBack(...)  R_BUTTON(kRButtonRight, __VA_ARGS__)
#define RRenderSetUp2CallBack(...)    R_BUTTON(kRButtonUp2, __VA_ARGS__)
#define RRenderSetDown2CallBack(...)  R_BUTTON(kRButtonDown2, __VA_ARGS__)
#define RRenderSetLeft2CallBack(...)  R_BUTTON(kRButtonLeft2, __VA_ARGS__)
#define RRenderSetRight2CallBack(...) R_BUTTON(kRButtonRight2, __VA_ARGS__)

#define RRenderSetActionNCallBack(...) R_PICK_3_OR_4(R_ACTION4, R_ACTION3, __VA_ARGS__)(__VA_ARGS__)
#define R_ACTION3(rc, N, func)         R_ACTION4(rc, N, func, 0)
#define R_ACTION4(rc, N, func, userdata)                                                                               \
    (R_CHECK_BUTTON(func), R_TAKER(func, RButtonPressCallBack, RButtonPressCallBackNoData, RRenderSetActionCallBack,   \
                                   RRenderSetActionCallBackNoData)(                                                    \
                               rc, N, R_CALLBACK(func, RButtonPressCallBack, RButtonPressCallBackNoData), userdata))

/* Mouse and joystick: one form, with user data. */
#define R_ANALOG(rc, func, userdata, Type, takes, arguments)                                                           \
    (R_CHECK(func, Type, Type, int(MEAPI *)(void), arguments), takes(rc, R_CALLBACK(func, Type, Type), userdata, 0))
#define RRenderSetMouseCallBack(...) R_PICK_2_OR_3(R_MOUSE3, R_MOUSE2, __VA_ARGS__)(__VA_ARGS__)
#define R_MOUSE2(rc, func)           R_MOUSE3(rc, func, 0)
#define R_MOUSE3(rc, func, userdata)                                                                                   \
    R_ANALOG(rc, func, userdata, RMouseCallBack, RRenderSetMouseCallBackWithText,                                      \
             ((RRender *)0, 0, 0, 0, kRLeftButton, kRNewlyPressed, (void *)0))
#define RRenderSetJoystickCallBack(...) R_PICK_2_OR_3(R_JOYSTICK3, R_JOYSTICK2, __VA_ARGS__)(__VA_ARGS__)
#define R_JOYSTICK2(rc, func)           R_JOYSTICK3(rc, func, 0)
#define R_JOYSTICK3(rc, func, userdata)                                                                                \
    R_ANALOG(rc, func, userdata, RJoystickCallBack, RRenderSetJoystickCallBackWithText,                                \
             ((RRender *)0, (AcmeReal)0, (AcmeReal)0, (void *)0))

/* C, unlike C++, does not turn char ** into const char *const * by itself. */
static inline void RUserHelpOfChars(RRender *rc, char *const help[], int arraySize) {
    RRenderCreateUserHelp(rc, (const char *const *)help, arraySize);
}
static inline void RUserHelpOfConstChars(RRender *rc, const char *help[], int arraySize) {
    RRenderCreateUserHelp(rc, (const char *const *)help, arraySize);
}
#define RRenderCreateUserHelp(rc, help, arraySize)                                                                     \
    _Generic((help), char **: RUserHelpOfChars, char *const *: RUserHelpOfChars,                                      \
             const char **: RUserHelpOfConstChars, default: RRenderCreateUserHelp)(rc, help, arraySize)

#endif

#endif
