/** @file MeViewer.h
 *  The viewer: draws to a window or an off-screen buffer, for test programs and prototypes.
 *
 *  A program creates a context, adds graphics whose transforms point into the simulation, and passes its tick function
 *  to RRun:
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
 *  Options of the command line select the output: `-gl` a window, `-osmesa` an off-screen buffer, `-null` none; `-help`
 *  lists all options. The environment variable KARMA_VIEWER may contain options, too, separated by blanks, for programs
 *  that do not pass their command line: KARMA_VIEWER="-null -frames 600". The command line overrides it. By default the
 *  output is a window if one can be opened, else the off-screen buffer.
 *
 *  The world is drawn right-handed, as it is simulated: x to the right, y up and z out of the screen for a camera at
 *  theta 0, or, after RCameraSetUp(rc, 0, 0, 1), z up and y into the screen. (The User Guide, Preface, excludes its
 *  viewer from "right-handed coordinate systems everywhere"; here it is no exception. The camera's angles are the
 *  guide's, App. B.) Lengths are in the program's unit; a cell of the ground's grid is one unit. 2D graphics have the
 *  window's lower left corner at (-1, -1) and its upper right corner at (1, 1).
 *
 *  For every function here: bad input (a null context or graphic, a NaN, a size that is not positive, a number out of
 *  range) gets a MeWarning that names function and argument; the call then does nothing and returns 0. All functions
 *  must be called from one thread.
 */
#ifndef MEVIEWER_H
#define MEVIEWER_H

/* Included as programs rely on it: transforms, memory, messages, times, options, colours (MeHSVtoRGB). */
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
 * Creates a context with default values and initializes its output (RInit). Options in @a overrideoptions override
 * those in @a options; either may be null. With @a eat, the viewer's options are removed from both. `-help` prints the
 * options and ends the program. An option with an unusable value is ignored, after a warning; RRenderRefuseOptions then
 * ends the program. Destroy the context with RRenderContextDestroy. Returns null, after a warning with the reason, if
 * it cannot draw.
 */
MEPUBLIC RRender *MEAPI RRenderContextCreate(MeCommandLineOptions *options, MeCommandLineOptions *overrideoptions,
                                             MeBool eat);
/**
 * The same; @a cb, unless null, is called with the new context after its values are set and before the output is
 * initialized. @a pWnd must be null: drawing into a window of the program is not supported.
 */
MEPUBLIC RRender *MEAPI RRenderContextCreate2(MeCommandLineOptions *options, MeCommandLineOptions *overrideoptions,
                                              int eat, void *pWnd, RCreateCallback cb);
/**
 * Ends a program that was started with unknown options: call it with the options of RRenderContextCreate, after viewer
 * and program have removed their own options. If a word is left, or the viewer could not use an option's value, a
 * warning names the first of them and the valid form; context and options are destroyed, and the program ends with exit
 * code 2. Does nothing if @a rc is null.
 */
MEPUBLIC void MEAPI RRenderRefuseOptions(RRender *rc, MeCommandLineOptions *options);
/** Initializes the context's output. Called by RRenderContextCreate. Returns 1, or 0 on failure. */
MEPUBLIC int MEAPI RInit(RRender *rc);
/**
 * Frees the context and all objects in its lists: graphics, lines, menus, the performance bar. May be called from an
 * atexit() handler. If the tick or a callback calls it, the program ends when that returns. Returns 0, or 1 with a
 * warning if @a rc is not a live context.
 */
MEPUBLIC int MEAPI RRenderContextDestroy(RRender *rc);
/** Ends the main loop before the next frame. */
MEPUBLIC void MEAPI RRenderQuit(RRender *rc);
/** Sets the title of the window and the help. The text is copied. */
MEPUBLIC void MEAPI RRenderSetWindowTitle(RRender *rc, const char *title);
/** Sets the program's name, up to 39 bytes: $APPNAME in texts, and the name of pictures. Default: that of its file. */
MEPUBLIC void MEAPI RRenderSetAppName(RRender *rc, const char *appname);
/** Sets the background colour at the horizon; it darkens towards the top. Alpha is ignored. */
MEPUBLIC void MEAPI RRenderSetBackgroundColor(RRender *rc, const float color[4]);
/**
 * Sets the number of ticks per second of wall-clock time: above 0, default 60. The option -rate overrides it. In a
 * window, a long frame has several ticks, as far as they can be computed within 1/30 s; beyond that the simulation is
 * slower than real time, which the window shows ("x0.4"). Without a window, and with -frames, -every, -film or -key,
 * each frame has one tick. MeAppRun calls it with its step. An addition to the 1.2 interface.
 */
MEPUBLIC void MEAPI RRenderSetTickRate(RRender *rc, AcmeReal ticksPerSecond);
/**
 * Sets the rendering quality of a window: 3 is full; 2 without antialiasing and ambient occlusion; 1 and 0 render at a
 * lower resolution, scaled up, with coarser shadows. -1, the default: the viewer chooses by the frame time: one level
 * down after half a second of frames longer than 1/30 s due to drawing, and up after two seconds of frames short enough
 * for the next level, or longer if that failed before. Without a window, with -frames, -every, -film or -key, and in
 * pictures that are written, quality is full. The option -quality overrides it. An addition to the 1.2 interface.
 */
MEPUBLIC void MEAPI RRenderSetPictureQuality(RRender *rc, int quality);
/** The quality of the next picture, 0 to 3. An addition to the 1.2 interface. */
MEPUBLIC int MEAPI RRenderGetPictureQuality(RRender *rc);
/** Pauses (not 0) or continues (0): while paused, the tick is not called. */
MEPUBLIC void MEAPI RRenderSetPause(RRender *rc, int p);
/**
 * Sets a line of text at the lower left of the window; null or "" removes it. Copied. A run without a window prints the
 * last one when it ends. An addition to the 1.2 interface.
 */
MEPUBLIC void MEAPI RRenderSetStatusText(RRender *rc, const char *text);
/** Shows @a fps (frames per second) in the upper right corner until it is called with a negative number. */
MEPUBLIC void MEAPI RRenderDisplayFps(RRender *rc, AcmeReal fps);
/** Prints the product's name and version. */
MEPUBLIC void MEAPI RDisplayBanner(void);
/** Prints the options that RRenderContextCreate understands. */
MEPUBLIC void MEAPI RDisplayCommandLineHelp(void);

/** Eight muted colours that colour-blind people can distinguish. An addition to the 1.2 interface. */
extern MEPUBLIC const float RPalette[8][4];
/** @} */

/** @name The main loop
 *  RRun(rc, tick) or RRun(rc, tick, userdata), where tick is `void MEAPI tick(RRender *)`, `void MEAPI tick(RRender *,
 *  void *)` or one of the forms at the end of this header. Each frame: handles input, calls tick, draws; until the user
 *  leaves (Escape, Q, the window's close button), the program calls RRenderQuit, or the frames of `-frames` are over.
 *  Then it calls exit(), so cleanup must be done in an atexit() handler. RRun itself does not return (App. B,
 *  "Terminating the Program").
 *
 *  The exit code is 0; or 2 if there were warnings and there was no window or `-frames` ended the loop. A window is
 *  drawn 60 times a second; without one, frames follow each other as fast as possible. Without a window, and with
 *  `-frames`, help that the program shows before RRun stays hidden and does not pause it.
 *  @{ */
/** RRun for a tick with @a userdata, which may be null. */
MEPUBLIC void MEAPI RRunWithData(RRender *rc, RMainLoopCallBack func, void *userdata);
/** @a unused gives both functions the same parameters. */
MEPUBLIC void MEAPI RRunWithoutData(RRender *rc, RMainLoopCallBackNoData func, void *unused);
/** @} */

/** @name Lists
 *  Graphics in a list are drawn. Functions that create graphics add them to a list, except RGraphicCreateEmpty. A
 *  graphic in no list is owned by the program, which must destroy it.
 *  @{ */
/** @a is2D: the list of 2D graphics, else that of 3D ones. A graphic in a list gets a warning. */
MEPUBLIC void MEAPI RGraphicAddToList(RRender *rc, RGraphic *rg, int is2D);
/** It is not drawn any more, and belongs to the program. */
MEPUBLIC void MEAPI RGraphicRemoveFromList(RRender *rc, RGraphic *rg, int is2D);
/** Removes a graphic from a list, given by @a is2D, and frees it. */
MEPUBLIC void MEAPI RGraphicDelete(RRender *rc, RGraphic *rg, int is2D);
/** Frees; if it is still in a list, removes it first. */
MEPUBLIC void MEAPI RGraphicDestroy(RGraphic *rg);
/** @} */

/** @name Creating graphics
 *  Each function returns a graphic in the context's list, or null. The graphic follows the transform @a matrix, read
 *  every frame; null is the identity. The transform must exist as long as the graphic. Curved shapes have 48 sides.
 *  @{ */
MEPUBLIC RGraphic *MEAPI RGraphicBoxCreate(RRender *rc, AcmeReal width, AcmeReal height, AcmeReal depth,
                                           const float color[4], MeMatrix4Ptr matrix); /**< A box with edges along x, y,
                                                                                            z. */
/** A cone along z: the apex at @a upper_height, the base at -@a lower_height. One of the heights may be negative or
 * 0. */
MEPUBLIC RGraphic *MEAPI RGraphicConeCreate(RRender *rc, AcmeReal radius, AcmeReal upper_height, AcmeReal lower_height,
                                            const float color[4], MeMatrix4Ptr matrix);
/** A cylinder along z, with the origin in its centre. */
MEPUBLIC RGraphic *MEAPI RGraphicCylinderCreate(RRender *rc, AcmeReal radius, AcmeReal height, const float color[4],
                                                MeMatrix4Ptr matrix);
/** A frustum or prism with @a sides sides (3 to 1024), along z from @a bottom to @a top (z coordinates). */
MEPUBLIC RGraphic *MEAPI RGraphicFrustumCreate(RRender *rc, AcmeReal bottomRadius, AcmeReal topRadius, AcmeReal bottom,
                                               AcmeReal top, int sides, const float color[4], MeMatrix4Ptr matrix);
/** A sphere about the origin, with as many sides as RRenderSetSphereResolution says. */
MEPUBLIC RGraphic *MEAPI RGraphicSphereCreate(RRender *rc, AcmeReal radius, const float color[4], MeMatrix4Ptr matrix);
/** A capsule: a cylinder of @a height along z with a hemisphere on each end. */
MEPUBLIC RGraphic *MEAPI RGraphicSphylCreate(RRender *rc, AcmeReal radius, AcmeReal height, const float color[4],
                                             MeMatrix4Ptr matrix);
/** A ring about the z axis; @a innerRadius and @a outerRadius are the smallest and largest distance of its points from
 * the axis. */
MEPUBLIC RGraphic *MEAPI RGraphicTorusCreate(RRender *rc, AcmeReal innerRadius, AcmeReal outerRadius,
                                             const float color[4], MeMatrix4Ptr matrix);
/** A two-sided square in the xy plane. */
MEPUBLIC RGraphic *MEAPI RGraphicSquareCreate(RRender *rc, AcmeReal side, const float color[4], MeMatrix4Ptr matrix);
/**
 * A horizontal square (normal to the axis of RCameraSetUp) at height @a y_position, with a grid of unit lines (every
 * tenth bolder) in tints of @a color, fading towards its edge. With the texture "checkerboard" it has squares of one
 * unit. It casts no shadow.
 */
MEPUBLIC RGraphic *MEAPI RGraphicGroundPlaneCreate(RRender *rc, AcmeReal side_length, int triangles_per_side,
                                                   const float color[4], AcmeReal y_position);
/**
 * Sets the look (an RGroundLook) of all grounds of a context, whatever their textures; -1, the default: each by its
 * texture. The option -ground overrides it. An addition to the 1.2 interface.
 */
MEPUBLIC void MEAPI RRenderSetGroundLook(RRender *rc, int look);
/** -1 by default. */
MEPUBLIC int MEAPI RRenderGetGroundLook(RRender *rc);
/** A line as a graphic, drawn like native lines. */
MEPUBLIC RGraphic *MEAPI RGraphicLineCreate(RRender *rc, const AcmeReal origin[3], const AcmeReal end[3],
                                            const float color[4], MeMatrix4Ptr matrix);
/** Text in the 2D list, with its upper left corner at the given position. It is parsed (RParseText) and copied. */
MEPUBLIC RGraphic *MEAPI RGraphicTextCreate(RRender *rc, const char *text, AcmeReal orig_x, AcmeReal orig_y,
                                            const float color[4]);
/** A rectangle in the 2D list, given by its left edge, its top edge and its size. */
MEPUBLIC RGraphic *MEAPI RGraphic2DRectangleCreate(RRender *rc, AcmeReal orig_x, AcmeReal orig_y, AcmeReal width,
                                                   AcmeReal height, const float color[4]);
/**
 * An object from an .ASE file, normalized to a cube of side 1 about the origin (RGraphicNormalize), then scaled. Null,
 * after a warning that names the file, if it cannot be read.
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
 * The same without objects whose name begins with MCD, by which modelling programs mark collision shapes (MCDBX_...,
 * MCDSP_..., MCDCX_...).
 */
MEPUBLIC RGraphic *MEAPI RGraphicLoadASENoMCD(RRender *rc, const char *filename, AcmeReal xScale, AcmeReal yScale,
                                              AcmeReal zScale, const float color[4], MeMatrix4Ptr matrix);
/** RGraphicLoadASE, then RGraphicTranslateVertices: @a offset is in the graphic's own frame, after the scale. */
MEPUBLIC RGraphic *MEAPI RGraphicLoadASEwithOffset(RRender *rc, const char *filename, AcmeReal xScale, AcmeReal yScale,
                                                   AcmeReal zScale, const float color[4], const MeVector3 offset,
                                                   MeMatrix4Ptr matrix);
/** The same for RGraphicLoadASENoMCD. */
MEPUBLIC RGraphic *MEAPI RGraphicLoadASEwithOffsetNoMcd(RRender *rc, const char *filename, AcmeReal xScale,
                                                        AcmeReal yScale, AcmeReal zScale, const float color[4],
                                                        const MeVector3 offset, MeMatrix4Ptr matrix);
/** A white graphic of @a numVertices vertices (a multiple of 3), all 0, in no list. */
MEPUBLIC RGraphic *MEAPI RGraphicCreateEmpty(int numVertices);
/**
 * Sets a sky: a texture on the inside of a distant hemisphere, repeated @a tileU times around and @a tileV times
 * upwards. A second one replaces the first; a null name removes it.
 */
MEPUBLIC void MEAPI RRenderSkydomeCreate(RRender *const rc, const char *name, int tileU, int tileV);
/**
 * Creates a graphic, in the 3D list, of the triangles of @a a and those of @a b moved by @a transform (null: the
 * identity). It has the look and the transform pointer of @a a, and leaves both unchanged.
 */
MEPUBLIC RGraphic *MEAPI RGraphicCombine(RRender *rc, RGraphic *a, RGraphic *b, MeMatrix4Ptr transform);
/** Sets the number of sides of spheres created from now on, 8 to 256 (default 48); they have half as many rings. */
MEPUBLIC void MEAPI RRenderSetSphereResolution(RRender *r, int res);
/** 48 by default. */
MEPUBLIC int MEAPI RRenderGetSphereResolution(RRender *r);
/** @} */

/** @name Changing graphics
 *  @{ */
/** Sets the transform to follow; null: the identity. */
MEPUBLIC void MEAPI RGraphicSetTransformPtr(RGraphic *g, MeMatrix4Ptr matrix);
/** Sets the ambient and the diffuse colour; the emissive and the specular one become 0. */
MEPUBLIC void MEAPI RGraphicSetColor(RGraphic *g, const float color[4]);
/** Gets the ambient colour. */
MEPUBLIC void MEAPI RGraphicGetColor(RGraphic *g, float color[4]);
/** Draws its edges only, whatever the quality of the context. */
MEPUBLIC void MEAPI RGraphicSetWireframe(RGraphic *g, MeBool b);
/** MEFALSE by default. */
MEPUBLIC MeBool MEAPI RGraphicIsWireframe(RGraphic *g);
/** Moves the ends of a line made by RGraphicLineCreate. Returns 0, or 1 with a warning on failure. */
MEPUBLIC int MEAPI RGraphicLineMoveEnds(RGraphic *lineG, const AcmeReal *origin, const AcmeReal *end);
/** Scales the vertices; the normals remain correct. The scales must not be 0. */
MEPUBLIC void MEAPI RGraphicScale(RGraphic *rg, AcmeReal xScale, AcmeReal yScale, AcmeReal zScale);
/** Translates the vertices by @a offset. */
MEPUBLIC void MEAPI RGraphicTranslateVertices(RRender *rc, RGraphic *rg, const MeVector3 offset);
/** Translates and scales the vertices to fill the cube from -0.5 to 0.5; with @a bKeepAspectRatio, equally on all
 * axes. */
MEPUBLIC void MEAPI RGraphicNormalize(RGraphic *rg, int bKeepAspectRatio);
/**
 * Replaces the triangles of @a rg by those of @a numStrips triangle strips. Strip i has @a stripSize[i] vertices,
 * starting at @a strips[@a stripStart[i]]. @a rg must have room for 3 vertices per triangle.
 */
MEPUBLIC void MEAPI RConvertTriStripToTriList(RGraphic *rg, RObjectVertex *strips, int *stripSize, int *stripStart,
                                              int numStrips);
/**
 * Does nothing: changes of a graphic are found in each frame. Kept for source compatibility.
 */
MEPUBLIC void MEAPI RGraphicCalcOGLDisplayList(RGraphic *rg);
/** Copies the transforms that graphics follow to their m_Matrix. Done in every frame. */
MEPUBLIC void MEAPI RRenderUpdateGraphicMatrices(RRender *rc);
/** @} */

/** @name Native lines
 *  Lines of constant thickness on the screen, not lit.
 *  @{ */
/** Creates a line and adds it to the list. It follows @a matrix, by pointer; null: world coordinates. */
MEPUBLIC RNativeLine *MEAPI RNLineCreate(RRender *const rc, const AcmeReal start[3], const AcmeReal end[3],
                                         const AcmeReal color[4], const MeVector4 *const matrix);
/** In the frame of the line's matrix. */
MEPUBLIC void MEAPI RNLineMoveEnds(RNativeLine *const line, const AcmeReal start[3], const AcmeReal end[3]);
/** Red, green, blue and alpha, 0 to 1. */
MEPUBLIC void MEAPI RNLineSetColor(RNativeLine *line, const AcmeReal color[4]);
/** For a line that was removed from its list. */
MEPUBLIC void MEAPI RNLineAddToList(RRender *rc, RNativeLine *line);
/** It is not drawn any more, and belongs to the program. */
MEPUBLIC void MEAPI RNLineRemoveFromList(RRender *rc, RNativeLine *line);
/** Removes a line from its list and frees it. */
MEPUBLIC void MEAPI RNLineDelete(RRender *rc, RNativeLine *line);
/** Frees; if it is still in a list, removes it first. */
MEPUBLIC void MEAPI RNLineDestroy(RNativeLine *line);
/** Adds a line in world coordinates that is drawn until RLineRemoveAll. */
MEPUBLIC void MEAPI RLineAdd(RRender *const rc, const AcmeVector3 start, const AcmeVector3 end, const AcmeReal r,
                             const AcmeReal g, const AcmeReal b);
/** Removes all lines of RLineAdd. */
MEPUBLIC void MEAPI RLineRemoveAll(RRender *rc);
/** @} */

/** @name Particles
 *  A particle system draws an equilateral triangle, facing the camera, at each of @a numParticles positions in the
 *  world frame. @a positions is kept by pointer, must exist as long, and is read every frame; particles with positions
 *  that are not finite are not drawn. The size is a triangle's side.
 *  @{ */
/** Creates a system in the list of the context, which owns it. @a tex_filename is a texture's name; null: none. */
MEPUBLIC RParticleSystem *MEAPI RParticleSystemCreate(RRender *rc, int numParticles, MeVector3 *positions,
                                                      const char *tex_filename, const float color[4],
                                                      AcmeReal tri_size);
/** The same, in no list, with the number of a texture (RRenderTextureCreate); -1: none. */
MEPUBLIC RParticleSystem *MEAPI RParticleSystemNew(int numParticles, MeVector3 *positions, int tex_id,
                                                   const float color[4], AcmeReal size);
/** For a system of RParticleSystemNew, or one that was removed. */
MEPUBLIC void MEAPI RParticleSystemAddToList(RRender *rc, RParticleSystem *ps);
/** It is not drawn any more, and belongs to the program. */
MEPUBLIC void MEAPI RParticleSystemRemoveFromList(RRender *rc, RParticleSystem *ps);
/** Frees; if it is still in a list, removes it first. */
MEPUBLIC void MEAPI RParticleSystemDestroy(RParticleSystem *ps);
/** @} */

/** @name The camera
 *  The camera looks at a point from a distance (at least 0.01), in a direction given by two angles in radians: theta in
 *  the xz plane, counter-clockwise from the z axis seen from above, and phi, the elevation above that plane: position =
 *  look-at + distance (cos phi sin theta, sin phi, cos phi cos theta); with z up (RCameraSetUp) it is look-at +
 *  distance (cos phi sin theta, -cos phi cos theta, sin phi). Defaults, as in 1.2: distance 15, theta 0, phi 0, look-at
 *  (0, 0, 1); so the camera is at (0, 0, 16) and looks along -z, x to the right and y up. theta is wrapped to -pi..pi,
 *  phi is clamped to -pi/2..pi/2. `-camera` overrides settings of the program before RRun. If neither has set the
 *  camera by then, RRun looks at the middle of all models and of the ground below them, with phi .2, from at least 15
 *  and so far that all are in the picture: the default would see a ground at y = 0 edge-on.
 *  @{ */
/**
 * Sets the axis of the world that is up on the screen, of any length but 0: default (0, 1, 0); MeAppStart sets (0, 0,
 * 1). All that this header says about x, y and z for camera angles and views, ground and sky holds in the world rotated
 * by the shortest rotation of the axis to y (for an axis with negative y: half a turn about x, preceded by the shortest
 * rotation of the axis to -y). So with z up, theta 0 looks from -y, with x to the right. Angles, distance and look-at
 * point are unchanged; existing grounds and the sky are rotated, and so are the lights, about the origin: their
 * direction on the screen is unchanged. An addition to the 1.2 interface.
 */
MEPUBLIC void MEAPI RCameraSetUp(RRender *rc, AcmeReal x, AcmeReal y, AcmeReal z);
/** The axis of RCameraSetUp, normalized; RCameraGetUp returns the camera's own up vector. An addition to the 1.2
 * interface. */
MEPUBLIC void MEAPI RCameraGetUpAxis(RRender *rc, AcmeVector3 axis);
/**
 * The angles of a camera in a direction (world frame, any length) from its look-at point. For a direction along the up
 * axis, @a theta is unchanged; for a zero direction, both are. An addition to the 1.2 interface.
 */
MEPUBLIC void MEAPI RCameraFindAngles(RRender *rc, const AcmeVector3 direction, AcmeReal *theta, AcmeReal *phi);
/** World frame. Distance and angles stay, so the camera moves along. */
MEPUBLIC void MEAPI RCameraSetLookAt(RRender *rc, const AcmeVector3 lookAt);
/** World frame; (0, 0, 1) by default. */
MEPUBLIC void MEAPI RCameraGetLookAt(RRender *rc, AcmeVector3 camlookat);
/** Distance, theta and phi at once. */
MEPUBLIC void MEAPI RCameraSetView(RRender *rc, AcmeReal dist, AcmeReal angle, AcmeReal elevation);
/** World frame: distance and angles follow from both points. */
MEPUBLIC void MEAPI RCameraSetLookAtAndPosition(RRender *rc, const MeVector3 lookAt, const MeVector3 position);
/** World frame. */
MEPUBLIC void MEAPI RCameraGetPosition(RRender *rc, AcmeVector3 pos);
MEPUBLIC void MEAPI RCameraGetLookDir(RRender *rc, AcmeVector3 dir); /**< Of length 1. */
MEPUBLIC void MEAPI RCameraGetUp(RRender *rc, AcmeVector3 up);       /**< Of length 1. */
/** 15 by default. */
MEPUBLIC AcmeReal MEAPI RCameraGetDistance(RRender *rc);
MEPUBLIC AcmeReal MEAPI RCameraGetRotation(RRender *rc);  /**< theta */
MEPUBLIC AcmeReal MEAPI RCameraGetElevation(RRender *rc); /**< phi */
/** theta */
MEPUBLIC void MEAPI RCameraSetRotation(RRender *rc, const MeReal rotation);
/** phi */
MEPUBLIC void MEAPI RCameraSetElevation(RRender *rc, const MeReal elevation);
MEPUBLIC void MEAPI RCameraSetOffset(RRender *rc, const MeReal offset); /**< The distance. */
/** Adds to the distance. */
MEPUBLIC void MEAPI RCameraZoom(RRender *rc, AcmeReal dist);
/** Adds to theta. */
MEPUBLIC void MEAPI RCameraRotateAngle(RRender *rc, AcmeReal d_theta);
/** Adds to phi. */
MEPUBLIC void MEAPI RCameraRotateElevation(RRender *rc, AcmeReal d_phi);
/** Move the camera and the look-at point along the camera's axes: right, up, and towards the viewer. */
MEPUBLIC void MEAPI RCameraPanX(RRender *rc, AcmeReal dist);
/** Up. */
MEPUBLIC void MEAPI RCameraPanY(RRender *rc, AcmeReal dist);
/** Towards the viewer. */
MEPUBLIC void MEAPI RCameraPanZ(RRender *rc, AcmeReal dist);
/** Sets the vertical field of view, radians, more than 0 and less than pi; default 0.7. Ends an orthographic view. */
MEPUBLIC void MEAPI RCameraSetFov(RRender *rc, AcmeReal fov);
/**
 * Sets an orthographic view: @a zoomFactor is the visible height; objects within @a viewDepth of the look-at point
 * along the line of sight are drawn. RCameraSetFov restores the perspective.
 */
MEPUBLIC void MEAPI RCameraSetOrthographicView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth);
/** Orthographic views from the sides +z, -z, -x, +x, +y and -y; with z up, from -y, +y, -x, +x, +z and -z. */
MEPUBLIC void MEAPI RCameraSetFrontView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth);
/** From -z; with z up from +y. */
MEPUBLIC void MEAPI RCameraSetBackView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth);
/** From -x. */
MEPUBLIC void MEAPI RCameraSetLeftView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth);
/** From +x. */
MEPUBLIC void MEAPI RCameraSetRightView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth);
/** From +y; with z up from +z. */
MEPUBLIC void MEAPI RCameraSetTopView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth);
/** From -y; with z up from -z. */
MEPUBLIC void MEAPI RCameraSetBottomView(RRender *rc, AcmeReal zoomFactor, AcmeReal viewDepth);
/** Sets a view matrix: world to camera, as RRender::m_CameraMatrix. Other camera functions end it. */
MEPUBLIC void MEAPI RCameraSetMatrix(RRender *rc, MeMatrix4Ptr m);
/** Updates position and matrix from the look-at point and the polar coordinates. Only needed after writing members. */
MEPUBLIC void MEAPI RCameraUpdate(RRender *rc);
/** Updates the projection from the field of view and the window's size. Done in every frame. */
MEPUBLIC void MEAPI RRenderUpdateProjectionMatrices(RRender *rc);
/**
 * The position of a pixel in a plane that fills the window, @a width wide and @a height high, with the origin in the
 * middle, x to the right and y up. The pixel is counted from the upper left corner, y down, as in RMouseCallBack.
 */
MEPUBLIC void MEAPI RCalculatePortalCoordinates(RRender *rc, AcmeReal width, AcmeReal height, int x, int y,
                                                AcmeReal *portalx, AcmeReal *portaly);
/** @} */

/** @name Lights
 *  One ambient light, two directional ones (the first casts shadows), one point light. By default all but the point
 *  light are on. See RRender for their colours.
 *  @{ */
/** Another value than those of RRenderLight gets a warning. */
MEPUBLIC void MEAPI RLightSwitchOn(RRender *rc, RRenderLight light);
/** A light that is off keeps its colours. */
MEPUBLIC void MEAPI RLightSwitchOff(RRender *rc, RRenderLight light);
/** @} */

/** @name Textures
 *  Up to 100; the guide's viewer had 25. A texture is a .bmp file or, beyond Karma, a .png, .jpg or .tga file, named
 *  without its extension. It is searched in the working directory, in $KARMA_TEXTURES, and in `textures` and
 *  `../textures`, and read when it is first drawn; a missing file gives a message (MeInfo, once) and no texture. Two
 *  are built in: "checkerboard" and "font".
 *  @{ */
/** Creates a texture, or finds the one of this name, and returns its number; -1 if all are in use. */
MEPUBLIC int MEAPI RRenderTextureCreate(RRender *rc, const char *filename);
/** Sets a graphic's texture. Returns its number, or -1. A null name removes the texture. */
MEPUBLIC int MEAPI RGraphicSetTexture(RRender *rc, RGraphic *rg, const char *filename);
/** @} */

/** @name Controls
 *  The viewer's own keys: F1 help and pause, F2 saves a picture NAME-0001.png in the working directory, F3 performance
 *  bar, F4 wireframe, F5 shadows, F9 menu and panels (RPanel.h), P pause, O or . single step, Escape or Q quit, PageUp
 *  and PageDown zoom, Ctrl and arrows turn the camera, Home the initial view. The mouse: dragging turns the camera;
 *  with the right or the middle button, or Shift, it moves it; the wheel zooms to the pointer. A drag that begins on a
 *  panel is handled by the panel. Keys are case-insensitive.
 *
 *  The program's: eight direction buttons (arrow keys; w s a d for the second four), actions and the mouse.
 *
 *  RRenderSetUpCallBack(rc, func) or (rc, func, userdata), and so for Down, Left, Right, Up2, Down2, Left2, Right2;
 *  RRenderSetActionNCallBack(rc, N, func) or (rc, N, func, userdata), N from 0 to 5; func is `void MEAPI func(RRender
 *  *, void *)`, `void MEAPI func(RRender *)` or one of the forms at the end of this header. It is called when the
 *  button is pressed, and repeatedly while a direction button is down. 0 or NULL removes it. Keys of the actions: 1
 *  Space, 2 Enter, 3 to 5 the digits; 0 has none.
 *
 *  RRenderSetMouseCallBack(rc, func) or (rc, func, userdata): func gets the left button's events while neither Ctrl nor
 *  Shift is down. Then Ctrl and the left button turn the camera; without Ctrl, only drags that func declines do
 *  (RRenderLeaveMouse). RRenderSetJoystickCallBack is the same for a joystick; it is stored, but never called on this
 *  platform.
 *  @{ */
/** For a direction button, and a function with user data. */
MEPUBLIC void MEAPI RRenderSetButtonCallBack(RRender *rc, RButtonList which, RButtonPressCallBack func, void *userdata);
/** For a direction button, and a function without user data. */
MEPUBLIC void MEAPI RRenderSetButtonCallBackNoData(RRender *rc, RButtonList which, RButtonPressCallBackNoData func,
                                                   void *unused);
/** For action @a N, and a function with user data. */
MEPUBLIC void MEAPI RRenderSetActionCallBack(RRender *rc, int N, RButtonPressCallBack func, void *userdata);
/** For action @a N, and a function without user data. */
MEPUBLIC void MEAPI RRenderSetActionCallBackNoData(RRender *rc, int N, RButtonPressCallBackNoData func, void *unused);

/** The same with a text for the help that describes the button. The text is copied; it may be null. */
MEPUBLIC void MEAPI RRenderSetUpCallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata,
                                                 const char *text);
/** For kRButtonDown. */
MEPUBLIC void MEAPI RRenderSetDownCallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata,
                                                   const char *text);
/** For kRButtonLeft. */
MEPUBLIC void MEAPI RRenderSetLeftCallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata,
                                                   const char *text);
/** For kRButtonRight. */
MEPUBLIC void MEAPI RRenderSetRightCallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata,
                                                    const char *text);
/** For kRButtonUp2. */
MEPUBLIC void MEAPI RRenderSetUp2CallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata,
                                                  const char *text);
/** For kRButtonDown2. */
MEPUBLIC void MEAPI RRenderSetDown2CallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata,
                                                    const char *text);
/** For kRButtonLeft2. */
MEPUBLIC void MEAPI RRenderSetLeft2CallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata,
                                                    const char *text);
/** For kRButtonRight2. */
MEPUBLIC void MEAPI RRenderSetRight2CallBackWithText(RRender *rc, RButtonPressCallBack func, void *userdata,
                                                     const char *text);
/** For action @a N. */
MEPUBLIC void MEAPI RRenderSetActionNCallBackWithText(RRender *rc, int N, RButtonPressCallBack func, void *userdata,
                                                      const char *text);
/** For the left mouse button. */
MEPUBLIC void MEAPI RRenderSetMouseCallBackWithText(RRender *rc, RMouseCallBack func, void *userdata, const char *text);
/** Stored, never called on this platform. */
MEPUBLIC void MEAPI RRenderSetJoystickCallBackWithText(RRender *rc, RJoystickCallBack func, void *userdata,
                                                       const char *text);
/**
 * Sets the key of action @a N (2 to 5): a printable ASCII character. While the action has a callback, it is called
 * instead of the viewer's own function of the key.
 */
MEPUBLIC void MEAPI RRenderSetActionNKey(RRender *rc, const unsigned int N, const char key);
/**
 * For helper libraries of programs: sets the callback of a key, a printable ASCII character. It is called unless the
 * program has an action or a direction button on that key, and replaces the viewer's own function of the key, also if
 * @a func is null. The text is for the help; copied, may be null. An addition to the 1.2 interface.
 */
MEPUBLIC void MEAPI RRenderSetKeyCallBack(RRender *rc, char key, RButtonPressCallBack func, void *userdata,
                                          const char *text);
/**
 * Called by a mouse callback during kRNewlyPressed: declines the drag, which then turns the camera. An addition to the
 * 1.2 interface.
 */
MEPUBLIC void MEAPI RRenderLeaveMouse(RRender *rc);
/** @} */

/** @name Menus
 *  Up and Down select an entry of the menu shown, Right and Left change it; a click does the same as Right, on the left
 *  half of a value entry the same as Left. F9 shows and hides the default menu, and the panels (RPanel.h).
 *  @{ */
/** Creates a menu without entries. The context owns and destroys it; RMenuDestroy destroys it earlier. */
MEPUBLIC RMenu *MEAPI RMenuCreate(RRender *rc, const char *name);
/**
 * Destroys a menu. Entries of other menus that open it remain, but do nothing. A menu that was destroyed already, such
 * as with its context, is ignored.
 */
MEPUBLIC void MEAPI RMenuDestroy(RMenu *rm);
/** Shows the menu in place of the visible one. */
MEPUBLIC void MEAPI RMenuDisplay(RMenu *rm);
/** The menu that F9 shows; null: none. */
MEPUBLIC void MEAPI RRenderSetDefaultMenu(RRender *rc, RMenu *menu);
/** Adds a toggle; @a func, which may be null, is called with each new state. */
MEPUBLIC void MEAPI RMenuAddToggleEntry(RMenu *rm, const char *name, RMenuToggleCallback func, MeBool defaultValue);
/**
 * Adds a number between @a lo and @a hi that changes by @a increment; @a func, which may be null, is called with each
 * new value. If @a lo is above @a hi, or the default is out of range, warns and uses the nearest valid value.
 */
MEPUBLIC void MEAPI RMenuAddValueEntry(RMenu *rm, const char *name, RMenuValueCallback func, MeReal hi, MeReal lo,
                                       MeReal increment, MeReal defaultValue);
/** Opens @a submenu, whose Left returns here. */
MEPUBLIC void MEAPI RMenuAddSubmenuEntry(RMenu *rm, const char *name, RMenu *submenu);
/** @} */

/** @name Help and text
 *  @{ */
/**
 * Sets the program's part of the help (F1): @a arraySize lines, parsed by RParseText and copied. Each call replaces the
 * lines. `char *help[]` and `const char *help[]` are both accepted.
 */
MEPUBLIC void MEAPI RRenderCreateUserHelp(RRender *const rc, const char *const help[], const int arraySize);
/** Shows the help and pauses, or hides it and continues. */
MEPUBLIC void MEAPI RRenderToggleUserHelp(RRender *const rc);
/**
 * Replaces $UP, $DOWN, $LEFT, $RIGHT, $UP2 ... $RIGHT2, $ACTION1 ... $ACTION5, $MOUSE and $APPNAME by the names of
 * their keys and of the program; other words after a $ are kept. @a text_out gets at most @a outbuffersize bytes, its
 * terminator included.
 */
MEPUBLIC void MEAPI RParseText(RRender *rc, const char *text_in, char *text_out, int outbuffersize);
/** @} */

/** @name Performance
 *  @{ */
/**
 * Creates a bar of the milliseconds of the profile sections "Collision", "Dynamics" and "Render", the budget of 1/60 s,
 * and frames per second. Starts profiling if it is off. Owned by the context; a second call returns the same. Without a
 * window, it is shown and measured only with `-bar`: it makes pictures differ, and forces every frame to be drawn.
 */
MEPUBLIC RPerformanceBar *MEAPI RPerformanceBarCreate(RRender *rc);
/** Shows these times (seconds) in this frame instead of the measured ones. */
MEPUBLIC void MEAPI RPerformanceBarUpdate(RRender *rc, AcmeReal coltime, AcmeReal dyntime, AcmeReal rentime,
                                          AcmeReal idletime);
/** Creates marks at every quarter of the budget along the bar: a graphic in the 2D list; null if there is no bar. */
MEPUBLIC RGraphic *MEAPI RPerformanceBarCreateTicks(RRender *rc);
/** @} */

ME_END_C

/* The following macros and overloads let one name accept calls with and without user data, and callbacks of several
 * forms:
 *
 *     void f(RRender *, void *)   and with user data of another type, as `int *` or `MyApp *`: get rc and the user data
 *     void f(RRender *)           gets rc
 *     void f()                    gets both, which a function without parameters ignores; in C, such a declaration
 *                                 may stand for any of the three
 *     0, NULL, nullptr            none
 *
 * each also with an ignored result, such as int. Other callbacks do not compile. */
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
    /* A lambda without captures. */
    template <class Lambda> RButtonCallBackArgument(Lambda f, int Lambda::* = nullptr) : RButtonCallBackArgument(+f) {}
};

/* For mouse and joystick: Func has fixed parameters, followed by the user data. */
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

/* The ninth argument: the number of arguments before the names selects the name. */
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

/* One association per _Generic: `void f()` is compatible with several, which is not allowed in one. */
#define R_IS(func, Type, yes, no) _Generic((func), Type : yes, default : no)
/* Selects the function that accepts the callback: `func` is called with user data unless it has no parameter for
 * them. */
#define R_TAKER(func, WithData, NoData, takesWithData, takesNoData)                                                    \
    R_IS(func, WithData, takesWithData, R_IS(func, NoData, takesNoData, takesWithData))
/* Casts the callback to the parameter type of that function. A null pointer constant is unchanged. */
#define R_CALLBACK(func, WithData, NoData)                                                                             \
    R_IS(func, WithData, func,                                                                                         \
         R_IS(func, NoData, func,                                                                                      \
              _Generic((func), int: (func), void *: (func), default: (WithData)(void(MEAPI *)(void))(func))))
/* Rejects, by an unevaluated call, callbacks that cannot be called with these arguments; and integers other than 0. */
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

/* C, unlike C++, does not convert char ** to const char *const * implicitly. */
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
