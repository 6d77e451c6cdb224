/* The list of the scenes, and what they share. */
#include "scenes_i.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

void scenes_setDown(SceneWorld *w) {
    w->gravity[1] = -GRAVITY;
}

void scenes_note(SceneTrace *t, int which, double error) {
    if (!(fabs(error) <= t->worst[which]))
        t->worst[which] = fabs(error);
}

void scenes_copyWorst(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    (void)w;
    memcpy(errors, t->worst, sizeof t->worst);
}

const Scene *const scenes[] = {
    &scenes_pendulum,
    &scenes_hinge,
    &scenes_top,
    &scenes_chain10,
    &scenes_chain100,
    &scenes_chain1000,
    &scenes_chain1e5,
    &scenes_chain100Links,
    &scenes_levelChain,
    &scenes_levelChain1000,
    &scenes_tumbling,
    &scenes_projectile,
    &scenes_heavy100,
    &scenes_heavy1e4,
    &scenes_heavy1e6,
    &scenes_tower,
    &scenes_shakenTower,
    &scenes_towerCentimetre,
    &scenes_towerDecimetre,
    &scenes_towerMetre,
    &scenes_towerTen,
    &scenes_towerHundred,
    &scenes_cards,
    &scenes_heap,
    &scenes_incline,
    &scenes_isotropy,
    &scenes_rolling,
    &scenes_backspin,
    &scenes_block,
    &scenes_bounce,
    &scenes_cradle,
    &scenes_pendulums,
    &scenes_elastic,
    NULL,
};

const Scene *scene_find(const char *name) {
    for (int i = 0; scenes[i]; i++)
        if (strcmp(scenes[i]->name, name) == 0)
            return scenes[i];
    return NULL;
}
