/* A course for vehicles: hills, a ramp, and a driver, by itself or by the arrow keys. Forward is x, left is -z. */
#ifndef COURSE_H
#define COURSE_H

#include "MstVehicle.h"
#include "play.h"

/* Creates the hills. Call it before playStart; false if there is no memory. */
MeBool courseCreate(void);
/* Shows them, and creates the ramp, of which x = 5 is the lower edge, y 1 the height, z = -8 the middle. */
void courseShow(void);
/* Puts a vehicle's chassis at the start, at a height, with the camera behind it; it drives by itself again. */
void courseStart(McdModelID chassis, MeReal height, float cameraDistance);
/* Drives for a step: by itself at up to `fastest` m/s, slower in bends, until an arrow key takes over. `sharp`: how far
 * it steers by itself for a curvature of 1/m; `calm` m/s: at that speed keys steer half as far as at rest. */
void courseDrive(MstVehicleID v, MeReal fastest, MeReal sharp, MeReal calm, MeReal handbrake);

#endif
