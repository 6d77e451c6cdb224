/* A universe on the screen, by MeApp: what the tutorials of collision and dynamics together have in common.
 *
 * y is up, gravity 9.81 m/s². There is one of everything, so that a tutorial shows what it is about. Models have
 * graphics that follow them; all of it is given back when the program ends. The key C (action 5) shows contacts; the
 * mouse, F, Space and the panels of F9 are those of MeAppCreateControls: every tutorial has them, and its help says so.
 */
#ifndef PLAY_H
#define PLAY_H

#include "MeApp.h"
#include "MeViewer.h"
#include "Mst.h"

extern MeApp *playApp;
extern RRender *playRc; /* its context */
extern MstUniverseID playUniverse;
extern const MeReal playFrame; /* s, of a step: 1/60 */

/* The viewer and a universe for so many moving models; false if there is no picture to draw on. Materials touch with
 * the friction cone, coefficient .5, no restitution. */
MeBool playStart(int argc, const char **argv, const char *name, int models);
/* Help: the lines of RRenderCreateUserHelp. */
void playHelp(const char *const help[], int lines);
/* The camera: what it looks at, how far away, from which angles (rad). */
void playCamera(float x, float y, float z, float distance, float angle, float elevation);
/* Calls tick before every frame, until the user leaves; does not return. Before it, the mouse pulls (MeAppStep). A run
 * of so many frames (-frames) ends on a hash of all bodies' state: the same program gives the same. */
void playRun(RMainLoopCallBackNoData tick);

/* Moves an aggregate's parts, whose transforms are the program's, so that its centre of mass is its origin, where Karma
 * keeps a body's. Tells where it was. */
void playCentre(McdAggregateID whole, MeVector3 was);
/* A model with an enabled body of a density (kg/m³), its middle at a place, and its graphic. Null if there is no
 * room. */
McdModelID playModel(McdGeometryID g, MeReal density, MeReal x, MeReal y, MeReal z, const float color[4]);
/* Another colour for such a model's graphic. */
void playColor(McdModelID m, const float color[4]);
/* A model that does not move, at a transform that is kept. */
McdModelID playFixed(McdGeometryID g, MeMatrix4Ptr tm, const float color[4]);
/* The floor: the plane y = 0. */
McdModelID playFloor(void);
/* Puts a model's body at rest at a place, turned by an angle (rad) about an axis (0, 1, 2). Enables it. */
void playPlace(McdModelID m, MeReal x, MeReal y, MeReal z, int axis, MeReal angle);
/* The contact parameters of two materials. */
MdtContactParamsID playContact(MstMaterialID m1, MstMaterialID m2);

/* For status lines: J, of motion; how many bodies are awake. */
double playEnergy(void);
int playAwake(void);

#endif
