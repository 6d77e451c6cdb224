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

void scenes_measureCounted(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]) {
    scenes_copyWorst(t, w, errors);
    errors[2] = t->events[0];
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
    &scenes_heap1000,
    &scenes_mixedHeap,
    &scenes_columns,
    &scenes_pyramid210,
    &scenes_pyramid820,
    &scenes_dominoes,
    &scenes_dolls,
    &scenes_net,
    &scenes_machines,
    &scenes_bridge,
    &scenes_cars,
    &scenes_incline,
    &scenes_isotropy,
    &scenes_rolling,
    &scenes_backspin,
    &scenes_block,
    &scenes_bounce,
    &scenes_cradle,
    &scenes_rollingXY,
    &scenes_rollingY,
    &scenes_bouncing49,
    &scenes_666,
    &scenes_elastic666,
    &scenes_quadrupedMomentum,
    &scenes_quadrupedEnergy,
    &scenes_planarChain,
    &scenes_capsules,
    &scenes_humanoid,
    &scenes_grasp,
    &scenes_pendulums,
    &scenes_elastic,
    &scenes_coin,
    &scenes_coinFalls,
    &scenes_turning,
    &scenes_turningLimit,
    &scenes_linkage,
    &scenes_ring,
    &scenes_slackBridge,
    &scenes_ledArm,
    &scenes_gears,
    &scenes_terrainRoll,
    &scenes_terrainCar,
    &scenes_rocking,
    &scenes_discRolls,
    &scenes_pack,
    &scenes_bumps,
    NULL,
};

const Scene *scene_find(const char *name) {
    for (int i = 0; scenes[i]; i++)
        if (strcmp(scenes[i]->name, name) == 0)
            return scenes[i];
    return NULL;
}
