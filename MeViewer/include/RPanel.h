/** @file RPanel.h
 *  Panels of a program, in the window and in pictures: numbers, plots, switches, sliders. An addition to the 1.2
 *  interface.
 *
 *      static void MEAPI show(RRender *rc, void *userdata) {
 *          if (RPanelSlider("gravity", &gravity, 0, 20, "m/s²"))
 *              MdtWorldSetGravity(world, 0, 0, -gravity);
 *      }
 *      RPanelCreate(rc, "Moon", show, 0);
 *
 *  Panels are the sections of a column at the right edge of the window, which scrolls; the scene is drawn in the rest
 *  of the window. F9 shows and hides all panels; in the viewer's own panel, "Viewer", the user selects which ones are
 *  visible. A panel is owned by its context. Its callback is called in every frame in which the panel is visible,
 *  before or after the tick but never during it; it may change the simulation, but neither destroy the context (which
 *  gets a warning) nor end the program. All functions RPanel..., except RPanelCreate, RPanelDestroy and RPanelShow, may
 *  only be called by such a callback (otherwise a warning and 0). Labels within a panel must differ; the part of a
 *  label after "##" is hidden. With -null panels are never visible.
 */
#ifndef RPANEL_H
#define RPANEL_H

#include "MeViewerTypes.h"

ME_BEGIN_C

typedef void(MEAPI *RPanelCallBack)(RRender *rc, void *userdata);

/** @name Panels
 *  @{ */
/** Creates a panel, hidden until F9 is pressed. @a title is copied; a second panel of the same title replaces the
 * first.
 */
MEPUBLIC void MEAPI RPanelCreate(RRender *rc, const char *title, RPanelCallBack func, void *userdata);
/** Destroys a panel; does nothing if there is none of this title. */
MEPUBLIC void MEAPI RPanelDestroy(RRender *rc, const char *title);
/** Shows a single panel without F9 (not 0), or hides it, also from F9 (0). Warns if there is none of this title. */
MEPUBLIC void MEAPI RPanelShow(RRender *rc, const char *title, MeBool shown);
/** @} */

/** @name Output
 *  @{ */
/** Text, wrapped to the width of the column. */
MEPUBLIC void MEAPI RPanelText(const char *text);
/** The same. */
MEPUBLIC void MEAPI RPanelWrapped(const char *text);
/** Text in the colour of headings. */
MEPUBLIC void MEAPI RPanelHeading(const char *text);
/** Places the next item beside the last one. */
MEPUBLIC void MEAPI RPanelSameLine(void);
/** A plot of @a count values over time, with the last one as a number. The range is 0 to @a high, or to the largest
 * value if
 * @a high is not above 0. */
MEPUBLIC void MEAPI RPanelPlot(const char *label, const float *values, int count, float high, const char *unit);
/** A texture (RRenderTextureCreate); width and height in units of a line's height, both smaller if the column is
 * narrower. */
MEPUBLIC void MEAPI RPanelPicture(int texture, AcmeReal width, AcmeReal height);
/** Begins a scrollable list, @a lines high; the following items are in it, until RPanelListEnd. */
MEPUBLIC void MEAPI RPanelListBegin(const char *name, int lines);
/** Ends the list of RPanelListBegin. */
MEPUBLIC void MEAPI RPanelListEnd(void);
/** @} */

/** @name Input
 *  Each returns non-zero in the frame in which the user has changed or clicked it.
 *  @{ */
/** A button. */
MEPUBLIC MeBool MEAPI RPanelButton(const char *label);
/** A tick box; a click changes @a value. */
MEPUBLIC MeBool MEAPI RPanelCheck(const char *label, MeBool *value);
/** A slider; warns unless @a low < @a high. A value out of range is shown unchanged until the slider is moved. @a unit
 * may be null. */
MEPUBLIC MeBool MEAPI RPanelSlider(const char *label, MeReal *value, MeReal low, MeReal high, const char *unit);
/** The same with equal ways for equal factors: @a low must be above 0. */
MEPUBLIC MeBool MEAPI RPanelScale(const char *label, MeReal *value, MeReal low, MeReal high, const char *unit);
/** A slider of whole numbers; warns unless @a low < @a high. */
MEPUBLIC MeBool MEAPI RPanelWhole(const char *label, int *value, int low, int high);
/** A choice of one of @a count names. */
MEPUBLIC MeBool MEAPI RPanelChoice(const char *label, int *which, const char *const names[], int count);
/** A text field of at most @a size bytes, the terminator included. Letters are entered in lower case. */
MEPUBLIC MeBool MEAPI RPanelEdit(const char *label, char *text, int size);
/** A line of a list that can be clicked. A new list is scrolled to a marked line. */
MEPUBLIC MeBool MEAPI RPanelLine(const char *text, MeBool marked);
/** Is the pointer on the last item? */
MEPUBLIC MeBool MEAPI RPanelIsPointedAt(void);
/** The title of a section that can be opened and closed; returns whether it is open. */
MEPUBLIC MeBool MEAPI RPanelSection(const char *title);
/** @} */

ME_END_C

#endif
