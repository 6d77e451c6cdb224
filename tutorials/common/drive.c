#include "drive.h"

/* An arc from the origin, tangential to the heading, through (x, y), y to the left, has the curvature 2 y / (x² +
 * y²). */
MeReal driveAlong(MdtBodyID body, const MeReal (*course)[2], int points, int *next) {
    MeMatrix4Ptr tm = MdtBodyGetTransformPtr(body);
    const MeVector3 way = {course[*next][0] - tm[3][0], 0, course[*next][1] - tm[3][2]};
    const MeReal toLeft = -MeVector3Dot(way, tm[2]), square = MeVector3Dot(way, way);
    if (square < 36)
        *next = (*next + 1) % points;
    return 2 * toLeft / MeMAX(square, 1);
}

int driveForward(void) {
    return MeAppGetKeyAxis(playApp, "Down", "Up");
}

int driveLeft(void) {
    return MeAppGetKeyAxis(playApp, "Right", "Left");
}
