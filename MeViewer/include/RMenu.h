/** @file RMenu.h
 *  Working the menu that is shown, for programs that have input of their own (User Guide App. B, "Menu System").
 *  MeViewer.h has the functions that make menus. Without a menu shown these functions do nothing.
 */
#ifndef RMENU_H
#define RMENU_H

#include "MeViewerTypes.h"

ME_BEGIN_C

/** The next entry; after the last one comes the first. */
MEPUBLIC void MEAPI RMenuNextEntry(RRender *rc);
/** The entry before; before the first one comes the last. */
MEPUBLIC void MEAPI RMenuPreviousEntry(RRender *rc);
/** What Right does: toggles a toggle entry, adds the increment to a value entry, opens a submenu. */
MEPUBLIC void MEAPI RMenuExecute1Entry(RRender *rc);
/** What Left does: toggles a toggle entry, takes the increment from a value entry, goes back from a submenu entry. */
MEPUBLIC void MEAPI RMenuExecute2Entry(RRender *rc);
/** Shows the default menu; if there is none, does nothing. */
MEPUBLIC void MEAPI RRenderDisplayDefaultMenu(RRender *rc);
MEPUBLIC void MEAPI RRenderHideCurrentMenu(RRender *rc);
/** The menu that is shown, or null. */
MEPUBLIC RMenu *MEAPI RRenderGetCurrentMenu(RRender *rc);

ME_END_C

#endif
