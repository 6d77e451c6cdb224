/* A universe on the screen, by MeApp: shared by the tutorials of collision and dynamics.
 *
 * y is up, gravity is 9.81 m/s². There is a single universe, viewer and MeApp, so that a tutorial shows only its
 * subject. Models have graphics that follow them; everything is freed when the program ends. The key C (action 5) shows
 * contacts; the mouse, F, Space and the panels of F9 are those of MeAppCreateControls, in every tutorial and its help.
 */
#ifndef PLAY_H
#define PLAY_H

#include "MeApp.h"
#include "MeViewer.h"
#include "Mst.h"

extern MeApp *playApp;
extern RRender *playRc; /* playApp's context */
extern MstUniverseID playUniverse;
extern MeReal playFrame; /* s, length of a step: 1/60, until the user sets another one */

/* Creates the viewer and a universe with room for a number of moving models; false if there is nothing to draw on.
 * Contacts have the friction cone, coefficient .5, and no restitution. */
MeBool playStart(int argc, const char **argv, const char *name, int models);
/* Sets the help: lines as in RRenderCreateUserHelp. */
void playHelp(const char *const help[], int lines);
/* Sets the camera: look-at point, distance, and angles (rad). */
void playCamera(float x, float y, float z, float distance, float angle, float elevation);
/* Calls MeAppStep (by which the mouse pulls bodies) and tick before every frame until the user leaves; does not return.
 * A run with -frames prints a hash of all bodies' states at its end: the same in every run of a program. */
void playRun(RMainLoopCallBackNoData tick);

/* Translates an aggregate's children, whose transforms the program owns, so that the centre of mass is the origin, as
 * for bodies; `was` gets its former position. */
void playCentre(McdAggregateID whole, MeVector3 was);
/* Creates a model with an enabled body of a density (kg/m³) at a position, and its graphic. Null if there is no
 * room. */
McdModelID playModel(McdGeometryID g, MeReal density, MeReal x, MeReal y, MeReal z, const float color[4]);
/* Sets the colour of the model's graphic. */
void playColor(McdModelID m, const float color[4]);
/* Creates a model that does not move, at a transform that is kept by pointer. */
McdModelID playFixed(McdGeometryID g, MeMatrix4Ptr tm, const float color[4]);
/* Creates the floor: the plane y = 0. */
McdModelID playFloor(void);
/* Moves a model's body to a position, rotated by an angle (rad) about an axis (0, 1, 2), at rest. Enables it. */
void playPlace(McdModelID m, MeReal x, MeReal y, MeReal z, int axis, MeReal angle);
/* The contact parameters of two materials. */
MdtContactParamsID playContact(MstMaterialID m1, MstMaterialID m2);

/* For status lines: the kinetic energy, J; the number of bodies that are awake. */
double playEnergy(void);
int playAwake(void);

#endif
