/** @file MeAppTypes.h
 *  The types of MeApp. All members may be read at any time; the functions of MeApp.h write them.
 */
#ifndef MEAPPTYPES_H
#define MEAPPTYPES_H

#include "MeTask.h"
#include "MeViewerTypes.h"
#include "MstTypes.h"

ME_BEGIN_C

/** What the mouse holds. */
typedef struct MeAppMousePickInfo {
    McdModelID model; /**< Null: nothing; then the rest has no meaning. */
    union {
        MdtBodyID body;     /**< The model's; null when nothing is held. */
        MdtBodyID dragBody; /**< The same; so old programs call it. */
    };
    MeVector3 relative; /**< Where it is held, in the body's frame. */
    MeVector3 target;   /**< Where it is pulled to, world frame: under the mouse, as deep in the picture as it was. */
    int x, y;           /**< The mouse, pixels from the window's upper left corner, y down. */
    RNativeLine
        *line;    /**< The spring, the redder the harder it pulls. In the context's list while something is held. */
    MeReal force; /**< N, with which it has pulled last. */
} MeAppMousePickInfo;

/** How contacts are drawn. */
typedef struct MeAppContactDrawInfo {
    MeReal length;       /**< Of a line, m. */
    int max;             /**< Lines there are. */
    int count;           /**< Lines in the context's list: the first so many. */
    RNativeLine **lines; /**< All lines; null before MeAppDrawContactsInit. */
} MeAppContactDrawInfo;

/** What the camera follows. */
typedef struct MeAppFollowInfo {
    MdtBodyID body; /**< Null: nothing. */
    MeVector3 at;   /**< Where the camera looks. */
    MeReal heading; /**< theta of a camera behind it, rad. */
} MeAppFollowInfo;

/** A demonstration program's helpers. Created by MeAppCreate. */
typedef struct MeApp {
    MdtWorldID world;
    McdSpaceID space;
    RRender *rc;
    MstUniverseID universe; /**< Null if it was created from a world and a space. */
    MeReal lengthScale;     /**< m, of a medium-sized object: the universe's, else 1. */
    union {
        MeAppMousePickInfo pick;
        MeAppMousePickInfo mouseInfo; /**< The same; so old programs call it. */
    };
    MeBool drawContacts;            /**< Are contacts drawn? MeAppDrawContactsInit and MeAppToggleDrawContacts say. */
    MeAppContactDrawInfo *contacts; /**< Never null. */
    McdModelID selected; /**< What was clicked last, or null: MeAppGetSelected says whether it is still there. */
    struct MeAppControls *controls; /**< Null before MeAppCreateControls. */
    MeAppFollowInfo follow;         /**< MeAppFollow. */
    struct MeAppShown *shown;       /**< The graphics of MeAppShowModel; null before the first. */
    MeTaskPoolID pool;              /**< Of MeAppStart, for -workers; null: the universe steps on one thread. */
} MeApp;

/** Called by MeAppRun before each step, when nothing is under way: it may do anything. */
typedef void(MEAPI *MeAppStepCB)(MeApp *app, void *userdata);

ME_END_C

#endif
