/* Driving: the arrow keys as pedals and a steering wheel, a driver for a course, and a camera that follows.
 *
 * The viewer tells when an arrow key goes down, and again and again while it is held, but not when it comes up (User
 * Guide, chapter 8, "Adding User Control to the Vehicle"). So a press counts until the next one should have come.
 */
#ifndef DRIVE_H
#define DRIVE_H

#include "Mdt.h"
#include "MeViewer.h"

/* Has the arrow keys drive from now on. */
void driveStart(RRender *rc);
/* Once a frame. */
void driveTick(void);
int driveForward(void); /* 1 while Up is held, -1 while Down is, else 0 */
int driveLeft(void);    /* 1 while Left is held, -1 while Right is, else 0 */

/* Round a course without a driver: the curvature (1/m, positive to the left) of the circle on which a body that looks
 * along its x comes to the next of some points (x, z); *next becomes the one after it when it is 6 m away. */
MeReal driveAlong(MdtBodyID body, const MeReal (*course)[2], int points, int *next);

/* Puts the camera behind a body that looks along its x, a distance away and with an elevation (rad). */
void driveCamera(RRender *rc, MdtBodyID body, float distance, float elevation);
/* Once a frame: glides after the body and turns as it turns. The user may turn the camera further. */
void driveFollow(RRender *rc, MdtBodyID body);

#endif
