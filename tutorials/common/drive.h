/* Driving: an automatic driver for a course, and the arrow keys as pedals and steering wheel. */
#ifndef DRIVE_H
#define DRIVE_H

#include "play.h"

int driveForward(void); /* 1 while Up is down, -1 while Down is, else 0 */
int driveLeft(void);    /* 1 while Left is down, -1 while Right is, else 0 */

/* Automatic driver: returns the curvature (1/m, positive to the left) of the circle on which a body, which looks along
 * its x axis, reaches the next point (x, z) of the course; *next advances when that point is 6 m away. */
MeReal driveAlong(MdtBodyID body, const MeReal (*course)[2], int points, int *next);

#endif
