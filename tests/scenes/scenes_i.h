/* What the files of scenes share. */
#ifndef SCENES_I_H
#define SCENES_I_H

#include "scene.h"

#define GRAVITY 9.81
#define PI      3.14159265358979323846

void scenes_setDown(SceneWorld *w);
/* A larger error replaces the worst one; so does one that is no number. */
void scenes_note(SceneTrace *t, int which, double error);
/* The third error is what was counted last. */
void scenes_measureCounted(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]);
void scenes_copyWorst(const SceneTrace *t, const SceneWorld *w, double errors[SCENE_MAX_ERRORS]);

/* m, how deep two bodies, neither of them a cylinder or a compound, are in each other, and one in the ground; negative
 * where they are apart, for boxes then the largest distance along one of the directions that are looked at. */
double scenes_overlap(const SceneBody *a, const SceneState *p, const SceneBody *b, const SceneState *q);
double scenes_below(const SceneBody *b, const SceneState *s);
/* m, the deepest of all that may collide. */
double scenes_deepest(const SceneWorld *w, const SceneState states[]);

extern const Scene scenes_pendulum, scenes_hinge, scenes_top;
extern const Scene scenes_chain10, scenes_chain100, scenes_chain1000, scenes_chain1e5, scenes_chain100Links;
extern const Scene scenes_levelChain, scenes_levelChain1000;
extern const Scene scenes_tumbling, scenes_projectile, scenes_bounce, scenes_cradle;
extern const Scene scenes_heavy100, scenes_heavy1e4, scenes_heavy1e6, scenes_tower, scenes_shakenTower,
    scenes_longTower;
extern const Scene scenes_towerCentimetre, scenes_towerDecimetre, scenes_towerMetre, scenes_towerTen,
    scenes_towerHundred;
extern const Scene scenes_cards, scenes_longCards, scenes_heap, scenes_heap1000;
extern const Scene scenes_columns, scenes_pyramid210, scenes_pyramid820, scenes_mixedHeap, scenes_dominoes;
extern const Scene scenes_dolls, scenes_net, scenes_machines, scenes_bridge, scenes_cars;
extern const Scene scenes_rollingXY, scenes_rollingY, scenes_bouncing49, scenes_666, scenes_elastic666,
    scenes_quadrupedMomentum, scenes_quadrupedEnergy;
extern const Scene scenes_planarChain, scenes_capsules, scenes_humanoid, scenes_grasp;
extern const Scene scenes_pendulums, scenes_elastic;
extern const Scene scenes_coin, scenes_coinFalls, scenes_turning, scenes_turningLimit;
extern const Scene scenes_linkage, scenes_ring, scenes_slackBridge, scenes_ledArm;
/* rad, that the large wheel may be turned to that side (1 or -1) of half of the small one's angle. */
double scenes_gearPlay(double small, int side);
extern const Scene scenes_gears, scenes_terrainRoll, scenes_terrainCar;
extern const Scene scenes_rocking, scenes_discRolls, scenes_pack, scenes_bumps;
extern const Scene scenes_incline, scenes_isotropy, scenes_rolling, scenes_backspin, scenes_block;

#endif
