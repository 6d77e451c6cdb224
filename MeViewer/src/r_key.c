/* Keys that are held and released. */
#include "RKey.h"
#include "r_i.h"

#include <string.h>

int MEAPI RRenderGetKeyFrames(RRender *rc, const char *name) {
    if (!r_isContext(rc, "RRenderGetKeyFrames"))
        return 0;
    const int key = name ? r_keyByName(name, strlen(name)) : RKEY_NONE;
    if (key > RKEY_NONE && key < RKEY_COUNT)
        return rc->m_pViewer->input.heldFor[key];
    MeWarning(1, "RRenderGetKeyFrames: %s: there is no such key", name ? name : "null");
    return 0;
}
