/** @file RMenu.h
 *  Control of the visible menu, for programs with input of their own. MeViewer.h has the functions that make menus.
 *  Without a visible menu these functions do nothing.
 */
#ifndef RMENU_H
#define RMENU_H

#include "MeViewerTypes.h"

ME_BEGIN_C

/** Selects the next entry, cyclically. */
MEPUBLIC void MEAPI RMenuNextEntry(RRender *rc);
/** Selects the previous entry, cyclically. */
MEPUBLIC void MEAPI RMenuPreviousEntry(RRender *rc);
/** The action of Right: switches a toggle entry, adds the increment to a value entry, opens a submenu. */
MEPUBLIC void MEAPI RMenuExecute1Entry(RRender *rc);
/** The action of Left: switches a toggle entry, subtracts the increment from a value entry, returns from the menu on a
 * submenu entry. */
MEPUBLIC void MEAPI RMenuExecute2Entry(RRender *rc);
/** Shows the default menu, if there is one. */
MEPUBLIC void MEAPI RRenderDisplayDefaultMenu(RRender *rc);
/** Hides the visible menu, if there is one. */
MEPUBLIC void MEAPI RRenderHideCurrentMenu(RRender *rc);
/** The visible menu, or null. */
MEPUBLIC RMenu *MEAPI RRenderGetCurrentMenu(RRender *rc);

ME_END_C

#endif
