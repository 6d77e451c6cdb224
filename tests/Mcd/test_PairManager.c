/* Pairs that a program activates by itself: phases, against an array of what is near; limits, containers, bad input. */
#include "Mcd.h"
#include "karma_test.h"

enum { MODELS = 12, MAX = MODELS * (MODELS - 1) / 2 };

static McdFrameworkID frame;
static McdModelID model[MODELS];
static McdModelPairManagerID manager;
static MeMatrix4 place;
static int told;

static void setUp(void) {
    frame = McdInit(0, MODELS, 0, 1);
    McdAllRegisterTypes(frame);
    McdAllRegisterInteractions(frame);
    MeMatrix4TMMakeIdentity(place);
    for (int i = 0; i < MODELS; i++) {
        model[i] = McdModelCreate(McdSphereCreate(frame, 1));
        McdModelSetTransformPtr(model[i], place);
    }
    manager = McdModelPairManagerCreate(MAX);
    told = 0;
}

static void tearDown(void) {
    McdModelPairManagerDestroy(manager);
    McdFrameworkDestroyAllModelsAndGeometries(frame);
    McdTerm(frame);
}
TEST_FIXTURE(setUp, tearDown)

static int indexOf(McdModelID m) {
    int i = 0;
    while (model[i] != m)
        i++;
    return i;
}

/* How many pairs come in which phase, in containers of that size; each once. */
static void countPairs(int room, int *phase, MeBool withStaying) {
    McdModelPairContainer *c = McdModelPairContainerCreate(room);
    McdSpacePairIterator it;
    MeBool isMore = METRUE;
    memset(phase, 0, MODELS * MODELS * sizeof *phase);
    McdModelPairManagerResetIterator(manager, &it);
    while (isMore) {
        isMore = withStaying ? McdModelPairManagerGetPairs(manager, &it, c)
                             : McdModelPairManagerGetTransitions(manager, &it, c);
        int ends[3][2] = {
            {c->goodbyeFirst, c->goodbyeEnd}, {c->helloFirst, c->helloEnd}, {c->stayingFirst, c->stayingEnd}};
        const int name[3] = {kMcdFFStateGoodbye, kMcdFFStateHello, kMcdFFStateStaying};
        for (int k = 0; k < 3; k++)
            for (int i = ends[k][0]; i < ends[k][1]; i++) {
                int *p = &phase[indexOf(c->array[i]->model1) * MODELS + indexOf(c->array[i]->model2)];
                ck_assert_int_eq(*p, 0);
                ck_assert_int_eq((int)c->array[i]->phase, name[k]);
                *p = name[k];
            }
    }
    McdModelPairContainerDestroy(c);
}

TEST(phases_follow_what_comes_near_and_goes) {
    int before[MODELS][MODELS] = {{0}}, now[MODELS][MODELS] = {{0}}, phase[MODELS * MODELS];
    MeU32 seed = 3;
    for (int step = 0; step < 300; step++) {
        for (int k = 0; k < 30; k++) {
            seed = seed * 1664525u + 1013904223u;
            const int a = (int)(seed >> 8) % MODELS, b = (int)(seed >> 16) % MODELS, i = MeMIN(a, b), j = MeMAX(a, b);
            if (i == j)
                continue;
            const MeBool comes = seed >> 30 & 1;
            /* the order of the models does not matter, but for who is the first of a new pair */
            if (comes)
                ck_assert(McdModelPairManagerActivate(manager, model[now[i][j] || before[i][j] ? j : i],
                                                      model[now[i][j] || before[i][j] ? i : j]));
            else
                ck_assert_int_eq(McdModelPairManagerDeactivate(manager, model[j], model[i]), now[i][j]);
            now[i][j] = comes;
            ck_assert_int_eq(McdModelPairManagerGetPair(manager, model[j], model[i]) != NULL, comes);
        }
        countPairs(1 + step % 7, phase, step & 1);
        for (int i = 0; i < MODELS; i++)
            for (int j = i + 1; j < MODELS; j++) {
                const int stays = step & 1 ? kMcdFFStateStaying : 0;
                const int expected =
                    now[i][j] ? (before[i][j] ? stays : kMcdFFStateHello) : (before[i][j] ? kMcdFFStateGoodbye : 0);
                ck_assert_int_eq(phase[i * MODELS + j], expected);
                before[i][j] = now[i][j];
            }
        McdModelPairManagerFlush(manager);
    }
}

static void MEAPI tell(McdModelID a, McdModelID b) {
    ck_assert(a == model[2] && b == model[3]);
    told++;
}

TEST(what_has_no_place_is_told) {
    McdModelPairManagerID small = McdModelPairManagerCreate(1);
    ck_assert(McdModelPairManagerGetSize(small) == 1 && McdModelPairManagerActivate(small, model[0], model[1]));
    assert_silent();
    ck_assert(!McdModelPairManagerActivate(small, model[2], model[3]));
    assert_warned("McdModelPairManagerCreate");
    McdModelPairManagerSetPoolFullHandler(small, tell);
    ck_assert(McdModelPairManagerGetPoolFullHandler(small) == tell);
    ck_assert(!McdModelPairManagerActivate(small, model[2], model[3]) && told == 1);
    McdModelPairManagerDeactivate(small, model[0], model[1]);
    ck_assert(McdModelPairManagerActivate(small, model[2], model[3]) && told == 1);
    McdModelPairManagerDestroy(small);
}

TEST(its_pairs_can_be_asked_for_contacts) {
    McdContact contact[4];
    McdIntersectResult result = {.contacts = contact, .contactMaxCount = 4};
    McdModelUpdate(model[0]);
    McdModelUpdate(model[1]);
    McdModelPairManagerActivate(manager, model[0], model[1]);
    McdModelPairID p = McdModelPairManagerGetPair(manager, model[0], model[1]);
    McdHello(p);
    ck_assert(McdIntersect(p, &result) && result.contactCount == 1);
    assert_near(contact[0].separation, -2, 1e-6);
}

TEST(bad_input_warns) {
    McdSpacePairIterator it;
    McdModelPairContainer *c = McdModelPairContainerCreate(4);
    assert_none(McdModelPairManagerCreate, 0);
    assert_none(McdModelPairManagerActivate, manager, model[0], model[0]);
    assert_none(McdModelPairManagerActivate, manager, model[0], NULL);
    McdModelPairManagerResetIterator(manager, &it);
    McdModelPairManagerActivate(manager, model[0], model[1]);
    ck_assert(!McdModelPairManagerGetPairs(manager, &it, c));
    assert_warned("McdModelPairManagerResetIterator");
    assert_none(McdModelPairManagerGetTransitions, manager, NULL, c);
    ck_assert(!McdModelPairManagerDeactivate(NULL, model[0], model[1]) && !McdModelPairManagerGetSize(NULL));
    assert_warned("McdModelPairManagerGetSize");
    assert_refused(McdModelPairManagerFlush, NULL);
    McdModelPairManagerDestroy(NULL);
    McdModelPairContainerDestroy(c);
}
