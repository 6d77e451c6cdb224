/* Compounds: things of several parts, and where their mass is (McdAggregate.h).
 *
 * An aggregate is a geometry made of others, each at a place of its own; a body of it moves as one. Tables, stools,
 * hammers, dumb-bells and jacks fall into a heap, and hook into each other. MstModelAndBodyCreateWithCenter finds
 * mass, inertia and centre of mass of all parts together: a hammer turns about a point close to its head, and the
 * bird, which stands on a peg by the tip below its neck, sways about it, since its weights hang below the tip. The
 * tumblers are balls whose centre of mass the program has put low: they get up again. Rolling friction (5 mm) calms
 * what sways.
 *
 * Press 3 to put the bird's centre of mass where it would be without its weights: it falls. Pull things with the
 * mouse.
 */
#include "play.h"
#include <math.h>
#include <stdio.h>

typedef struct Part {
    double size[3], at[3]; /* m; with one size alone a sphere of that radius */
} Part;
#define LEG(height, x, z)                                                                                              \
    {                                                                                                                  \
        {.08, height, .08}, {                                                                                          \
            x, 0, z                                                                                                    \
        }                                                                                                              \
    }

enum { TABLE, STOOL, HAMMER, DUMBBELL, JACK, BIRD, TUMBLER, KINDS };
enum { EACH = 5, THINGS = BIRD * EACH + 4, PARTS = 8 }; /* five of each, a bird, three tumblers */

static const Part part[KINDS][PARTS] = {
    {{{1.4, .08, .9}, {0, .38, 0}}, LEG(.7, .6, .35), LEG(.7, .6, -.35), LEG(.7, -.6, .35), LEG(.7, -.6, -.35)},
    {{{.5, .08, .5}, {0, .25, 0}}, LEG(.45, .2, .2), LEG(.45, .2, -.2), LEG(.45, -.2, .2), LEG(.45, -.2, -.2)},
    {{{.08, 1, .08}, {0, .5, 0}}, {{.5, .22, .22}, {0, 1, 0}}},
    {{{.25}, {-.45, 0, 0}}, {{.9, .1, .1}, {0, 0, 0}}, {{.25}, {.45, 0, 0}}},
    {{{1, .14, .14}, {0, 0, 0}}, {{.14, 1, .14}, {0, 0, 0}}, {{.14, .14, 1}, {0, 0, 0}}},
    {{{.08}, {0, .08, 0}},
     {{.1, .6, .1}, {0, .4, 0}},
     {{.16}, {0, .8, 0}},
     {{2, .06, .3}, {0, .4, 0}},
     LEG(.8, 1, 0),
     LEG(.8, -1, 0),
     {{.25}, {-1, -.5, 0}},
     {{.25}, {1, -.5, 0}}},
    {{{.4}, {0, 0, 0}}, {{.25}, {0, .5, 0}}},
};

static McdModelID thing[THINGS];
static MeVector3 centre; /* of the bird's mass, found */
static MeBool isFound = METRUE;

static int kindOf(int i) {
    return i < BIRD * EACH ? i / EACH : i == BIRD * EACH ? BIRD : TUMBLER;
}

static McdGeometryID create(const Part parts[PARTS]) {
    const McdFrameworkID frame = playUniverse->frame;
    const McdAggregateID whole = McdAggregateCreate(frame, PARTS);
    for (const Part *p = parts; p < parts + PARTS && p->size[0] > 0; p++) {
        const MeReal x = (MeReal)p->size[0], y = (MeReal)p->size[1], z = (MeReal)p->size[2];
        MeMatrix4 tm;
        MeMatrix4TMMakeIdentity(tm);
        MeVector3Set(tm[3], (MeReal)p->at[0], (MeReal)p->at[1], (MeReal)p->at[2]);
        McdAggregateAddElement(whole, y > 0 ? McdBoxCreate(frame, x, y, z) : McdSphereCreate(frame, x), tm);
    }
    return whole;
}

static void MEAPI Reset(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    for (int i = 0; i < THINGS; i++)
        if (kindOf(i) == BIRD)
            playPlace(thing[i], -3, 2, -1, 2, (MeReal)0.3);
        else if (kindOf(i) == TUMBLER)
            playPlace(thing[i], (MeReal)(1.5 * (i - BIRD * EACH) - 5), (MeReal)0.4, (MeReal)2.5, 2, (MeReal)1.4);
        else
            playPlace(thing[i], (MeReal)(1.3 * (i % 3) + .2), (MeReal)(1 + .45 * (i / 3)),
                      (MeReal)(1.3 * (i % 9 / 3) - 2), i % 3, (MeReal)i);
}

/* The bird's centre of mass: as found, or as if its weights were of paper. */
static void MEAPI toggleCentre(RRender *context, void *userdata) {
    const MeVector3 ofNeck = {0, (MeReal)0.4, 0};
    (void)context, (void)userdata;
    isFound = !isFound;
    MdtBodySetCenterOfMassRelativePosition(McdModelGetBody(thing[BIRD * EACH]), isFound ? centre : ofNeck);
}

/* degrees from upright */
static double tiltOf(McdModelID m) {
    return acos(fmax(-1, fmin(1, (double)McdModelGetTransformPtr(m)[1][1]))) * 180 / 3.14159265358979;
}

static void MEAPI Tick(RRender *context) {
    char text[160];
    int upright = 0;
    (void)context;
    MstUniverseStep(playUniverse, playFrame);
    for (int i = BIRD * EACH + 1; i < THINGS; i++)
        upright += tiltOf(thing[i]) < 20;
    snprintf(text, sizeof text,
             "the bird leans by %.1f degrees    tumblers upright %d of 3    awake %d    motion %.3f J",
             tiltOf(thing[BIRD * EACH]), upright, playAwake(), playEnergy());
    RRenderSetStatusText(playRc, text);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {"Tables, hammers, a bird on a peg.", "$ACTION2 - once more",
                                       "$ACTION3 - another centre of mass for the bird"};
    static const float stone[4] = {.6f, .58f, .55f, 1};
    static const MeVector3 pegAt = {-3, 1, -1}, low = {0, (MeReal)-0.25, 0};
    McdGeometryID whole[KINDS];
    if (!playStart(argc, argv, "Compounds", THINGS))
        return 1;
    MdtContactParamsSetRollingFriction(playContact(0, 0), (MeReal)0.005); /* what sways comes to rest */
    playFloor();
    playColor(
        MstFixedModelCreateAt(playUniverse, McdBoxCreate(playUniverse->frame, (MeReal)0.3, 2, (MeReal)0.3), pegAt, 0),
        stone);
    for (int kind = 0; kind < KINDS; kind++)
        whole[kind] = create(part[kind]);
    for (int i = 0; i < THINGS; i++) {
        thing[i] = MstModelAndBodyCreateWithCenter(playUniverse, whole[kindOf(i)], 600);
        playColor(thing[i], RPalette[kindOf(i) % 6]);
        if (kindOf(i) == TUMBLER)
            MdtBodySetCenterOfMassRelativePosition(McdModelGetBody(thing[i]), low);
    }
    MdtBodyGetCenterOfMassRelativePosition(McdModelGetBody(thing[BIRD * EACH]), centre);
    playHelp(help, 3);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, toggleCentre, 0);
    playCamera(-.5f, 1, 0, 12, .25f, .3f);
    Reset(playRc, 0);
    playRun(Tick);
    return 0;
}
