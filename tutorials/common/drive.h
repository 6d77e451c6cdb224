/* Driving: a driver for a course, and the arrow keys as pedals and a steering wheel. */
#ifndef DRIVE_H
#define DRIVE_H

#include "play.h"

int driveForward(void); /* 1 while Up is held, -1 while Down is, else 0 */
int driveLeft(void);    /* 1 while Left is held, -1 while Right is, else 0 */

/* Round a course without a driver: the curvature (1/m, positive to the left) of the circle on which a body that looks
 * along its x comes to the next of some points (x, z); *next becomes the one after it when it is 6 m away. */
MeReal driveAlong(MdtBodyID body, const MeReal (*course)[2], int points, int *next);

#endif
