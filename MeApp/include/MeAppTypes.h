/** @file MeAppTypes.h
 *  The types of MeApp. All members may be read at any time; only the functions of MeApp.h write them.
 */
#ifndef MEAPPTYPES_H
#define MEAPPTYPES_H

#include "MeTask.h"
#include "MeViewerTypes.h"
#include "MstTypes.h"

ME_BEGIN_C

/** The body picked with the mouse. */
typedef struct MeAppMousePickInfo {
    McdModelID model; /**< Null: none; then the other members are undefined. */
    union {
        MdtBodyID body;     /**< The model's body; null if none is picked. */
        MdtBodyID dragBody; /**< The same, for old programs. */
    };
    MeVector3 relative; /**< The picked point, in the body's frame. */
    MeVector3 target;   /**< The target point, world frame: under the mouse, at the depth of the picked point. */
    int x, y;           /**< Position of the mouse, pixels from the window's upper left corner, y down. */
    RNativeLine *line;  /**< Line of the spring, the redder the larger the force. In the context's list while a body is
                       picked. */
    MeReal force;       /**< N, the last force of the spring. */
} MeAppMousePickInfo;

/** How contacts are drawn. */
typedef struct MeAppContactDrawInfo {
    MeReal length;       /**< Length of a line, m. */
    int max;             /**< Number of lines allocated. */
    int count;           /**< Number of lines in the context's list: the first ones. */
    RNativeLine **lines; /**< All lines; null before MeAppDrawContactsInit. */
} MeAppContactDrawInfo;

/** The body that the camera follows. */
typedef struct MeAppFollowInfo {
    MdtBodyID body; /**< Null: none. */
    MeVector3 at;   /**< The camera's look-at point. */
    MeReal heading; /**< theta of a camera behind the body, rad. */
} MeAppFollowInfo;

/** The state of MeApp. Created by MeAppCreate. */
typedef struct MeApp {
    MdtWorldID world;
    McdSpaceID space;
    RRender *rc;
    MstUniverseID universe; /**< Null if created from a world and a space. */
    MeReal lengthScale;     /**< m, size of a typical object: the universe's, else 1. */
    union {
        MeAppMousePickInfo pick;
        MeAppMousePickInfo mouseInfo; /**< The same, for old programs. */
    };
    MeBool drawContacts;            /**< Are contacts drawn? Set by MeAppDrawContactsInit and
                                         MeAppToggleDrawContacts. */
    MeAppContactDrawInfo *contacts; /**< Never null. */
    McdModelID selected;            /**< The model clicked last, or null; may be destroyed: use MeAppGetSelected. */
    struct MeAppControls *controls; /**< Null before MeAppCreateControls. */
    MeAppFollowInfo follow;         /**< MeAppFollow. */
    struct MeAppShown *shown;       /**< Graphics of models (MeAppShowModel); null before the first. */
    MeTaskPoolID pool;              /**< Threads of MeAppStart; null: the universe steps on one thread. */
    MeBool ownsUniverse;            /**< Made by MeAppStart. */
} MeApp;

/** Called by MeAppRun before each step, between all operations: it may do anything. */
typedef void(MEAPI *MeAppStepCB)(MeApp *app, void *userdata);

ME_END_C

#endif
