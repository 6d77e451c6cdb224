/* Scenes in which edges meet faces: a house of cards, and a heap of boxes. */
#include "scenes_i.h"

#include <math.h>
#include <string.h>

/* A house of cards
 *
 * In the plane: a leaning card stands on its inner lower edge. Two of them, mirror images, would touch with their inner
 * upper edges, foot to foot 2 length sin(lean) apart; the highest points are their outer upper edges, thickness
 * cos(lean) to either side of where they touch and length cos(lean) + thickness sin(lean) high. Flat cards lie on
 * these, from one pair to the next, and the pairs above stand on the flat cards, each above the gap of two pairs.
 *
 * Where only one of two cards bears a flat one, which is so on both flanks, half of its load goes through their touch
 * to the other: with V on the one and w the weight of a card, the force in the touch has H = (V/2 + w/2) tan(lean) to
 * the side and V/2 down, at the bottom V = 2.625 w, 57 degrees below the level. Friction (35 degrees) bears that only
 * if the normal is the one of the bearing card's face, 25 degrees below the level: the other one's edge must touch its
 * face, not the other way round. So the cards of the flanks, which bear nothing, lean a little more. At the feet H is
 * .39 of the load, and friction .7. */

enum {
    PAIRS = 4, /* in the lowest storey */
    LEANING = PAIRS * (PAIRS + 1),
    CARDS = LEANING + PAIRS * (PAIRS - 1) / 2
};
static const double cardLength = .4, cardWidth = .3, cardThickness = .01, cardMass = .1; /* m, kg */
static const double flatLength = .3538, pairSpacing = .3578;                             /* m */
static const double lean = 25 * PI / 180, leanMore = .5 * PI / 180;                      /* rad, from the upright */

/* A card whose foot is at (x, y) and whose top leans by an angle to the right (or, negative, to the left). */
static void addLeaning(SceneWorld *w, double x, double y, double angle) {
    const double a = fabs(angle), side = angle > 0 ? 1 : -1;
    const double middle = cardLength / 2 * sin(a) - cardThickness / 2 * cos(a);
    SceneBody *b = scene_addBox(w, cardMass, cardThickness, cardLength, cardWidth, x + side * middle,
                                y + cardLength / 2 * cos(a) + cardThickness / 2 * sin(a), 0);
    b->friction = .7;
    b->start.quaternion[0] = cos(angle / 2);
    b->start.quaternion[3] = -sin(angle / 2);
}

/* Two cards that touch above x. The one that leans more ends lower: its edge touches the other's face. */
static void addPair(SceneWorld *w, double x, double y, double left, double right) {
    const double steep = fmin(left, right), lower = cardLength * (cos(steep) - cos(fmax(left, right)));
    const double aside = lower * tan(steep);
    addLeaning(w, x - cardLength * sin(left) + (left > right ? aside : 0), y, left);
    addLeaning(w, x + cardLength * sin(right) - (right > left ? aside : 0), y, -right);
}

static void buildCards(const Scene *s, SceneWorld *w) {
    const double storey = cardLength * cos(lean) + cardThickness * sin(lean);
    (void)s;
    scenes_setDown(w);
    w->collides = true;
    for (int level = 0; level < PAIRS; level++) {
        const int pairs = PAIRS - level, last = pairs - 1;
        const double y = level * (storey + cardThickness), first = -pairSpacing * last / 2;
        for (int i = 0; i < pairs; i++)
            addPair(w, first + pairSpacing * i, y, lean + (i == 0 && last > 0 ? leanMore : 0),
                    lean + (i == last && last > 0 ? leanMore : 0));
        for (int i = 0; i < last; i++)
            scene_addBox(w, cardMass, flatLength, cardThickness, cardWidth, first + pairSpacing * (i + .5),
                         y + storey + cardThickness / 2, 0)
                ->friction = .7;
    }
}

/* How far any card is from where it was put. */
static void watchCards(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    (void)time;
    for (int i = 0; i < w->numBodies; i++) {
        const double *from = w->bodies[i].start.position, *at = states[i].position;
        const double off[3] = {at[0] - from[0], at[1] - from[1], at[2] - from[2]};
        scenes_note(t, 0, sqrt(scene_dot(off, off)));
    }
}

#define CARD_HOUSE(label, time)                                                                                        \
    {                                                                                                                  \
        .name = "cards" label,                                                                                         \
        .text = "26 cards of .4 x .3 x .01 m, in pairs at 25 degrees and flat on these, four storeys, mu .7, 0.1 kg: " \
                "largest way of any",                                                                                  \
        .duration = time, .hasEdges = true, .errors = {{"moved m", .1, 1e-3}}, .build = buildCards,                    \
        .observe = watchCards, .measure = scenes_copyWorst,                                                            \
    }
const Scene scenes_cards = CARD_HOUSE("", 20), scenes_longCards = CARD_HOUSE("-600s", 600);

/* A heap: boxes that fall in layers, each turned its own way. */

enum { HEAP_WATCHED = 15 /* frames */ };

/* In layers of `parameter` times `parameter`. */
static void buildHeap(const Scene *s, SceneWorld *w) {
    const int layer = (int)s->parameter;
    scenes_setDown(w);
    w->collides = true;
    for (int n = 0; n < s->count; n++) {
        const int x = n % layer, z = n / layer % layer, y = n / layer / layer;
        const double angle = .3 + .7 * n, axis[3] = {sin(1. * n), sin(2. * n + 1), sin(3. * n + 2)};
        SceneBody *b = scene_addBox(w, 1, 1, .8, .6, 1.5 * (x - layer / 2) + .1 * (y % 3), 1.2 + 1.5 * y,
                                    1.5 * (z - layer / 2) - .1 * (y % 2));
        const double size = sqrt(scene_dot(axis, axis));
        b->friction = .5;
        b->start.quaternion[0] = cos(angle / 2);
        for (int c = 0; c < 3; c++)
            b->start.quaternion[c + 1] = sin(angle / 2) * axis[c] / size;
    }
}

/* The overlap is looked for four times a second; the speed is the present one. */
static void watchHeap(SceneTrace *t, const SceneWorld *w, const SceneState states[], double time) {
    if (lround(time / SCENE_FRAME) % HEAP_WATCHED == 0)
        scenes_note(t, 0, t->worst[1] = scenes_deepest(w, states));
    t->worst[2] = 0;
    for (int i = 0; i < w->numBodies; i++)
        scenes_note(t, 2, sqrt(scene_dot(states[i].velocity, states[i].velocity)));
}

#define HEAP(label, boxes, boxesText, side, many)                                                                      \
    {                                                                                                                  \
        .name = "heap" label,                                                                                          \
        .text =                                                                                                        \
            boxesText " boxes of 1 x .8 x .6 m, turned any way, fall on each other, mu .5, 10 s: how deep any two "    \
                      "are in each other, at most and at the end, largest speed at the end",                           \
        .parameter = side, .count = boxes, .heaped = boxes, .isCrowd = many, .duration = 10, .hasEdges = true,         \
        .errors = {{"worst m", .8, 1e-2}, {"at end m", .8, 1e-3}, {"speed m/s", INFINITY, .1}}, .build = buildHeap,    \
        .observe = watchHeap, .measure = scenes_copyWorst,                                                             \
    }
const Scene scenes_heap = HEAP("", 300, "300", 5, false), scenes_heap1000 = HEAP("-1000", 1000, "1000", 10, true);
