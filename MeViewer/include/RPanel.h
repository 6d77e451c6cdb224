/** @file RPanel.h
 *  Panels of a program's own, in the window and in pictures: figures, plots, switches, sliders. An addition to the 1.2
 *  interface.
 *
 *      static void MEAPI show(RRender *rc, void *userdata) {
 *          if (RPanelSlider("gravity", &gravity, 0, 20, "m/s²"))
 *              MdtWorldSetGravity(world, 0, -gravity, 0);
 *      }
 *      RPanelCreate(rc, "Moon", show, 0);
 *
 *  F9 shows and hides all panels; the viewer's own one, "Viewer", says which of them are seen. A panel belongs to its
 *  context. Its function is called in every frame in which the panel is seen, before or after the tick but never in it;
 *  it may change the simulation, but neither destroy the context (which gets a warning) nor end the program. The
 *  functions that begin with RPanel, but for RPanelCreate, RPanelDestroy and RPanelShow, may be called by such a
 *  function only (else a warning and 0); labels within a panel must differ, and what follows "##" in one is not seen.
 *  With -null no panel is ever seen.
 */
#ifndef RPANEL_H
#define RPANEL_H

#include "MeViewerTypes.h"

ME_BEGIN_C

typedef void(MEAPI *RPanelCallBack)(RRender *rc, void *userdata);

/** @name Panels
 *  @{ */
/** A panel, seen at first when F9 is pressed. @a title is copied; a second panel of the same title replaces the first.
 */
MEPUBLIC void MEAPI RPanelCreate(RRender *rc, const char *title, RPanelCallBack func, void *userdata);
/** Takes a panel away; none of this title: nothing. */
MEPUBLIC void MEAPI RPanelDestroy(RRender *rc, const char *title);
/** Shows a panel (not 0) alone, without F9, or hides it, also from F9. Warns if there is none of this title. */
MEPUBLIC void MEAPI RPanelShow(RRender *rc, const char *title, MeBool shown);
/** @} */

/** @name What a panel shows
 *  @{ */
MEPUBLIC void MEAPI RPanelText(const char *text);
/** As wide as a list, in as many lines as it needs. */
MEPUBLIC void MEAPI RPanelWrapped(const char *text);
MEPUBLIC void MEAPI RPanelHeading(const char *text);
/** The next thing stands beside the last one. */
MEPUBLIC void MEAPI RPanelSameLine(void);
/** @a count values over time and the last as a figure, from 0 to @a high; to the greatest if @a high is not above 0. */
MEPUBLIC void MEAPI RPanelPlot(const char *label, const float *values, int count, float high, const char *unit);
/** A texture (RRenderTextureCreate), its size in heights of a line. */
MEPUBLIC void MEAPI RPanelPicture(int texture, AcmeReal width, AcmeReal height);
/** A list that is @a lines high and can be scrolled; what follows is in it, up to RPanelListEnd. */
MEPUBLIC void MEAPI RPanelListBegin(const char *name, int lines);
MEPUBLIC void MEAPI RPanelListEnd(void);
/** @} */

/** @name What a panel asks
 *  Each returns not 0 in the frame in which the user has changed or clicked it.
 *  @{ */
MEPUBLIC MeBool MEAPI RPanelButton(const char *label);
MEPUBLIC MeBool MEAPI RPanelCheck(const char *label, MeBool *value);
/** Warns if not @a low < @a high. A value that is outside is shown as it is until it is moved. @a unit may be null. */
MEPUBLIC MeBool MEAPI RPanelSlider(const char *label, MeReal *value, MeReal low, MeReal high, const char *unit);
MEPUBLIC MeBool MEAPI RPanelWhole(const char *label, int *value, int low, int high);
/** One of @a count names. */
MEPUBLIC MeBool MEAPI RPanelChoice(const char *label, int *which, const char *const names[], int count);
/** A text of at most @a size bytes, its end included. Letters arrive in lower case. */
MEPUBLIC MeBool MEAPI RPanelEdit(const char *label, char *text, int size);
/** A line of a list, to be clicked. A list that is new is scrolled to a line that is marked. */
MEPUBLIC MeBool MEAPI RPanelLine(const char *text, MeBool marked);
/** Is the pointer on what was asked last? */
MEPUBLIC MeBool MEAPI RPanelIsPointedAt(void);
/** A title that opens and closes what follows: is it open? */
MEPUBLIC MeBool MEAPI RPanelSection(const char *title);
/** @} */

ME_END_C

#endif
