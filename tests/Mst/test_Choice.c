/* What the engine chooses by default is right: scenes that either solver alone had got wrong, or too dear. */
#include "choice_scenes.h"
#include "karma_test.h"

#ifdef TEST_IS_SLOW
enum { QUICK = 10 };
#else
enum { QUICK = 1 };
#endif

typedef struct Outcome {
    double error, drift, fallen, widest; /* see choice_scenes.h */
} Outcome;

static const Scene *sceneNamed(const char *name) {
    for (int i = 0; i < SCENES; i++)
        if (strcmp(scenes[i].name, name) == 0)
            return &scenes[i];
    ck_abort_msg("no scene is called %s", name);
}

/* Of a scene with these parameters, by default; its time is divided where sanitizers make it long. */
static Outcome outcomeOf(const char *name, double p0, double p1, double p2, double seconds) {
    const Variant v = {.p = {p0, p1, p2}, .scene = sceneNamed(name)};
    makeUniverse(MdtSolverAuto);
    makeScene(&v);
    const int steps = (int)(seconds / h + .5) / QUICK;
    for (int i = 0; i < steps; i++) {
        advance(i);
        note(i);
    }
    const Outcome o = {v.scene->measure->error(), drift(), fallen(), widest};
    MstUniverseDestroy(universe);
    return o;
}

/* Had burst the stack, from nine bodies on. */
TEST(a_ton_lies_on_cubes_of_a_kilogram) {
    for (int count = 2; count <= 21; count += count < 11 ? 1 : 10)
        for (double load = 100; load <= 1000; load *= 10) {
            const Outcome o = outcomeOf("ton-cubes", count, load, 0, 5);
            assert_below(o.error, 1e-8);
            assert_below(o.drift, 1e-6);
        }
}

/* Had sunk into the ground: one step of the blow takes 46 to 350 million multiplications, and was left to the fast
 * solver. */
TEST(a_slab_lands_on_layers_of_cubes_of_a_kilogram) {
    for (int edge = 2; edge <= 4; edge++)
        for (double load = 1e3; load <= (edge == 2 ? 1e5 : edge == 3 ? 1e4 : 1e3); load *= 10) {
            const Outcome o = outcomeOf("slab", edge, load, 0, 3);
            ck_assert_msg(o.error < 1e-4 && o.drift < .03, "%g kg on layers of %d x %d: overlap %g, drift %g", load,
                          edge, edge, o.error, o.drift);
        }
}

/* Had sunk, and not the less the lighter: each step used up its share after the passes that counted, and what rested
 * under a load that landed had no part in the account. */
TEST(a_drum_lands_on_layers_of_cubes_of_a_kilogram) {
    for (int edge = 2; edge <= 3; edge++)
        for (double load = 1e3; load <= 1e5; load *= 10) {
            const Outcome o = outcomeOf("drum", edge, load, 0, 3);
            ck_assert_msg(o.error < 1e-4 && o.drift < .03, "%g kg on layers of %d x %d: overlap %g, drift %g", load,
                          edge, edge, o.error, o.drift);
        }
}

/* Whatever it sags by at first; had fallen through from 500 kg on. */
static void assertCarried(double sag, double load) {
    const Outcome o = outcomeOf("ton-bridge", sag, load, 0, 10);
    ck_assert_msg(o.error < 1e-3 && o.widest < 2e-4, "%g kg, sag %g: error %g, joints open by %g", load, sag, o.error,
                  o.widest);
}

TEST(a_ton_lies_on_a_bridge_of_planks_of_a_kilogram) {
    for (double sag = .1; sag < 2; sag *= sqrt(10))
        for (double load = 1; load <= 1000; load *= 1000)
            assertCarried(sag, load);
    assertCarried(.5, 1e4);
    assertCarried(1, 1e4);
}

/* Of planks of 8 mm, 12 cm long; had fallen. */
TEST(towers_of_a_hundred_layers_of_planks_stand) {
    for (int layers = 30; layers <= 120; layers += 30) {
        const Outcome o = outcomeOf("kapla", layers, 0, 0, 4);
        assert_below(fabs(o.error), 1e-4);
        assert_below(o.fallen, 1);
        assert_below(o.drift, 1e-5);
    }
}

static void assertStands(int count, double edge, double top) {
    const Outcome o = outcomeOf("stack", count, edge, top, 1.5);
    ck_assert_msg(fabs(o.error) < 1e-6, "%d of %g m, the top %g times: sinks by %g", count, edge, top, o.error);
    assert_below(o.drift, 1e-6 * edge);
}

/* Whatever their number, size, and the mass of the top: none sinks by more than rounding, so that nothing changes from
 * one number to the next. Of high ones each number has one size and mass in its turn. */
TEST(stacks_of_any_number_stand) {
    static const double edge[] = {1, .05, .02}, top[] = {1, 1e2, 1e4};
    for (int count = 2; count <= 200; count += count < 12 ? 1 : count < 62 || count > 66 ? 13 : 1)
        for (int k = 0; k < 9; k++)
            if (count < 12 || k == count % 9)
                assertStands(count, edge[k / 3], top[k % 3]);
}

/* Multiplications, millions, of the first step, whose forces are not known. */
static double firstWorkOf(const char *name, double count) {
    MdtReport report;
    const Variant v = {.p = {count, 1, 1}, .scene = sceneNamed(name)};
    makeUniverse(MdtSolverExact);
    makeScene(&v);
    advance(0);
    MdtWorldGetReport(universe->world, &report);
    MstUniverseDestroy(universe);
    return (double)report.work;
}

/* Had taken an iteration a layer: 62, 240 and 110. */
TEST(first_steps_of_towers_are_cheap) {
    assert_below(firstWorkOf("stack", 100), 1);
    assert_below(firstWorkOf("kapla", 100), 60);
    assert_below(firstWorkOf("pyramid", 20), 25);
}

/* Multiplications, millions, of the dearest of the first steps. */
static double worstWorkOf(const char *name, double count, double load, int steps) {
    const Variant v = {.p = {count, load}, .scene = sceneNamed(name)};
    double worst = 0;
    makeUniverse(MdtSolverExact);
    makeScene(&v);
    for (int i = 0; i < steps; i++) {
        MdtReport report;
        advance(i);
        MdtWorldGetReport(universe->world, &report);
        worst = fmax(worst, (double)report.work);
    }
    MstUniverseDestroy(universe);
    return worst;
}

/* Friction at the corners of loaded cubes contradicts itself by rounding. Passes had gone on to their largest number,
 * for 27 to 46. */
TEST(passes_that_gain_nothing_end) {
    for (double load = 1e3; load <= 1e5; load *= 10)
        assert_below(worstWorkOf("slab", 2, load, 30), 20);
}
