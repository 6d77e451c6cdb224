/* CardHouse: a house of twenty-six cards that stands by friction alone (User Guide, chapter 5, "The Bridge").
 *
 * Four storeys: cards lean on each other in pairs, 25 degrees from the upright, and others lie flat across the tops of
 * neighbouring pairs. Nothing holds them but contacts of edges with faces. A flat card pulls the feet above it together
 * like a tie rod, by friction; an error of a tenth of a millimetre a second would soon open the house. Watch how far
 * any card has moved since the house was built, and how it falls asleep. After two seconds a ball is thrown; a house
 * that is built again stands until you pull a card out of it, or throw the ball.
 */
#include "play.h"
#include <math.h>
#include <stdio.h>

enum { STOREYS = 4, LEANING = STOREYS * (STOREYS + 1), FLAT = STOREYS * (STOREYS - 1) / 2, CARDS = LEANING + FLAT };

static const double length = .4, width = .3, thickness = .01, mass = .1; /* m, kg */
static const double flatLength = .3538, pairSpacing = .3578;             /* m */
static const double degree = 3.14159265358979 / 180;
static const double lean = 25 * degree, leanMore = .5 * degree; /* rad, from the upright */

static McdModelID card[CARDS], ball; /* the leaning ones first */
static MeVector3 built[CARDS];
static int pull;       /* steps that the hand still pulls */
static int untilThrow; /* frames, until the ball is thrown by itself; 0: it is not */

/* A card that stands on its inner lower edge at (x, y) and leans to the right by an angle, or to the left by a
 * negative. */
static void placeCard(int n, double x, double y, double angle) {
    const double a = fabs(angle), side = angle > 0 ? 1 : -1;
    const double middle = length / 2 * sin(a) - thickness / 2 * cos(a);
    playPlace(card[n], (MeReal)(x + side * middle), (MeReal)(y + length / 2 * cos(a) + thickness / 2 * sin(a)), 0, 2,
              (MeReal)-angle);
}

/* Two cards that touch above x; y is where they stand. The one that leans more ends lower: its edge touches the other's
 * face. */
static void placePair(int n, double x, double y, double left, double right) {
    const double steep = fmin(left, right), lower = length * (cos(steep) - cos(fmax(left, right)));
    const double aside = lower * tan(steep);
    placeCard(n, x - length * sin(left) + (left > right ? aside : 0), y, left);
    placeCard(n + 1, x + length * sin(right) - (right > left ? aside : 0), y, -right);
}

/* The cards of the flanks bear no flat card, and half of what their partners bear must pass over to them. That takes a
 * touch on the partner's face: so they lean a little more. */
static void placeStorey(int level, int *leaning, int *flat) {
    const double height = length * cos(lean) + thickness * sin(lean);
    const int pairs = STOREYS - level, last = pairs - 1;
    const double y = level * (height + thickness), first = -pairSpacing * last / 2;
    for (int i = 0; i < pairs; i++, *leaning += 2)
        placePair(*leaning, first + pairSpacing * i, y, lean + (i == 0 && last > 0 ? leanMore : 0),
                  lean + (i == last && last > 0 ? leanMore : 0));
    for (int i = 0; i < last; i++, ++*flat)
        playPlace(card[*flat], (MeReal)(first + pairSpacing * (i + .5)), (MeReal)(y + height + thickness / 2), 0, 0, 0);
}

static void MEAPI Reset(RRender *context, void *userdata) {
    int leaning = 0, flat = LEANING;
    (void)context, (void)userdata;
    pull = untilThrow = 0;
    for (int level = 0; level < STOREYS; level++)
        placeStorey(level, &leaning, &flat);
    for (int i = 0; i < CARDS; i++)
        McdModelDynamicsGetPosition(card[i], built[i]);
    playPlace(ball, (MeReal)-1.2, (MeReal)0.06, (MeReal)0.5, 0, 0);
}

static void MEAPI throwBall(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    untilThrow = 0;
    playPlace(ball, (MeReal)-1.4, (MeReal)0.5, 0, 0, 0);
    MdtBodySetLinearVelocity(McdModelGetBody(ball), 5, 1, 0);
}

/* The card that bears the left end of the first flat one goes towards the viewer, by a hand that is stronger than its
 * friction. What it bore comes down; the rest leans on itself, and stays. */
static void MEAPI pullCard(RRender *context, void *userdata) {
    (void)context, (void)userdata;
    untilThrow = 0;
    pull = 15;
}

static void pullOn(void) {
    if (pull > 0) {
        pull--;
        MdtBodySetLinearVelocity(McdModelGetBody(card[1]), 0, 0, 2);
    }
}

/* mm, of the card that has moved farthest. */
static double farthest(void) {
    double max = 0;
    for (int i = 0; i < CARDS; i++) {
        MeVector3 p;
        McdModelDynamicsGetPosition(card[i], p);
        MeVector3Subtract(p, p, built[i]);
        max = fmax(max, 1000 * (double)MeVector3Magnitude(p));
    }
    return max;
}

static double top(void) {
    MeVector3 p;
    McdModelDynamicsGetPosition(card[LEANING - 1], p);
    return (double)p[1] + length / 2 * cos(lean) + thickness / 2 * sin(lean);
}

static void MEAPI Tick(RRender *context) {
    char text[160];
    (void)context;
    if (untilThrow > 0 && --untilThrow == 0)
        throwBall(context, 0);
    pullOn();
    MstUniverseStep(playUniverse, playFrame);
    snprintf(text, sizeof text, "top at %.4f m    moved %.4f mm    awake %d of %d    motion %.1e J", top(), farthest(),
             playAwake(), CARDS + 1, playEnergy());
    RRenderSetStatusText(playRc, text);
}

static void createModels(void) {
    static const float red[4] = {.80f, .25f, .25f, 1}, blue[4] = {.25f, .40f, .70f, 1};
    static const float ivory[4] = {.95f, .92f, .82f, 1}, iron[4] = {.30f, .32f, .36f, 1};
    const McdFrameworkID frame = playUniverse->frame;
    const McdGeometryID leaning = McdBoxCreate(frame, (MeReal)thickness, (MeReal)length, (MeReal)width);
    const McdGeometryID flat = McdBoxCreate(frame, (MeReal)flatLength, (MeReal)thickness, (MeReal)width);
    const MeReal density = (MeReal)(mass / (length * width * thickness));
    playFloor();
    for (int i = 0; i < CARDS; i++)
        card[i] = playModel(i < LEANING ? leaning : flat, density, 0, 0, 0, i >= LEANING ? ivory : i % 2 ? red : blue);
    ball = playModel(McdSphereCreate(frame, (MeReal)0.06), 500, 0, 0, 0, iron);
    MdtContactParamsSetFrictionCoeffecient(playContact(0, 0), (MeReal)0.7);
}

int MEAPI_CDECL main(int argc, const char **argv) {
    static const char *const help[] = {
        "A house of cards, held by friction alone; after two seconds a ball comes.",
        "$ACTION2 - build it again",
        "$ACTION3 - throw the ball",
        "$ACTION4 - pull a card out of the lowest storey",
    };
    if (!playStart(argc, argv, "CardHouse", CARDS + 1))
        return 1;
    /* Some 5 ms of a step at most, where the ball is among the cards; standing needs less. */
    MdtWorldSetWorkBudget(playUniverse->world, 24);
    createModels();
    playHelp(help, 4);
    RRenderSetActionNCallBack(playRc, 2, Reset, 0);
    RRenderSetActionNCallBack(playRc, 3, throwBall, 0);
    RRenderSetActionNCallBack(playRc, 4, pullCard, 0);
    playCamera(0, .72f, 0, 3.4f, .45f, .2f);
    Reset(playRc, 0);
    untilThrow = 120;
    playRun(Tick);
    return 0;
}
