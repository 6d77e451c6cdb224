#include "parts.h"

RGraphic *partBox(RRender *rc, float lx, float ly, float lz, MeReal x, MeReal y, MeReal z, const float color[4],
                  MeMatrix4Ptr tm) {
    const MeVector3 offset = {x, y, z};
    RGraphic *box = RGraphicBoxCreate(rc, lx, ly, lz, color, tm);
    RGraphicTranslateVertices(rc, box, offset);
    return box;
}

void partWheel(RRender *rc, float radius, float width, MeMatrix4Ptr tm) {
    const float dark[4] = {.22f, .23f, .25f, 1}, pale[4] = {.80f, .81f, .82f, 1};
    RGraphicCylinderCreate(rc, radius, width, dark, tm);
    RGraphicCylinderCreate(rc, radius * .6f, width + .01f, pale, tm);
    RGraphicBoxCreate(rc, radius * 1.1f, .1f, width + .03f, dark, tm);
}
