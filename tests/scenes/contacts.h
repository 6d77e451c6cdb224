/* Contacts of a scene's bodies, for an engine that has no collision of its own: spheres and the corners of boxes with
 * the ground, spheres with each other, and faces of boxes with each other. Edges against edges, and spheres against
 * boxes, are not looked for: no scene needs them. */
#ifndef SCENES_CONTACTS_H
#define SCENES_CONTACTS_H

#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { SCENE_MAX_CONTACTS = 512 };

typedef struct SceneContact {
    int body, other;  /* the other may be SCENE_WORLD */
    double point[3];  /* m */
    double normal[3]; /* unit, the way the first body is pushed */
    double depth;     /* m, negative for a gap */
    double radius[2]; /* m, of the two surfaces where they are spheres; 0: corners and faces */
    double friction, restitution;
} SceneContact;

/* Those of bodies that touch, or are nearer than 2 % of their smallest half edge and what they move in `h` seconds.
 * Returns how many. */
int scene_contacts(const SceneWorld *w, const SceneState states[], double h, SceneContact contacts[SCENE_MAX_CONTACTS]);

#ifdef __cplusplus
}
#endif

#endif
