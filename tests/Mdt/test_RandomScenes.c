/* Stability as a property: none of 1000 random scenes (random_scene.h), all of them shaken, has a number that is not
 * finite, an energy that grows without a motor, or a joint that stays open (random_judge.h).
 *
 *     test_Mdt_RandomScenes                       the tests
 *     test_Mdt_RandomScenes --survey COUNT [FIRST] what goes wrong in so many seeds, and how often
 *     test_Mdt_RandomScenes --seed SEED            one scene, step by step
 */
#include "random_judge.h"

/* A sanitizer makes a step ten times as long, so that build runs every tenth scene. */
#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define IS_SANITIZED
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
#define IS_SANITIZED
#endif
#ifdef IS_SANITIZED
enum { SCENES = 1000, STRIDE = 10 };
#else
enum { SCENES = 1000, STRIDE = 1 };
#endif

/* ---- the survey ---- */

static void printFaults(FILE *file, const RandomVerdict *v) {
    for (int i = 0; i < FAULTS; i++)
        if (v->fault[i].is) {
            fprintf(file, " | %s %.3g from step %d", random_faultName[i], v->fault[i].amount, v->fault[i].step);
            if (i == FAULT_GAP)
                fprintf(file, " (joint %d)", v->fault[i].joint);
        }
    fputc('\n', file);
}

/* What the scene is, in the words of a table. */
static void printScene(FILE *file, unsigned long long seed) {
    static RandomScene s;
    random_sceneMake(&s, seed);
    fprintf(file, "seed %llu: 1/%.0f s, %s of %d%s%s%s, masses 1:%.2g, %.2g m/s", s.seed, 1 / s.step, s.topology,
            s.bodies, s.isOneKind && s.joints > 0 ? " by " : "", s.isOneKind && s.joints > 0 ? s.joint[0].kind : "",
            s.hasGround ? ", ground" : "", s.ratio, s.shaking);
    random_sceneDestroy(&s);
}

static int survey(unsigned long long count, unsigned long long first) {
    int bad = 0, failed[FAULTS] = {0}, grown[3] = {0}, open[3] = {0};
    for (unsigned long long seed = first; seed < first + count; seed++) {
        RandomVerdict v;
        random_judge(seed, &v, NULL);
        for (int i = 0; i < FAULTS; i++)
            failed[i] += v.fault[i].is;
        for (int i = 0; i < 3; i++) {
            grown[i] += v.growth > pow(10, i - 2);
            open[i] += v.gap > pow(10, i - 3);
        }
        if (random_worstFault(&v) < 0)
            continue;
        bad++;
        printScene(stdout, seed);
        printFaults(stdout, &v);
    }
    printf("%d of %llu scenes failed:", bad, count);
    for (int i = 0; i < FAULTS; i++)
        printf(" %s %d%s", random_faultName[i], failed[i], i + 1 < FAULTS ? "," : "\n");
    printf("energy grew by 1 %% in %d, 10 %% in %d, 100 %% in %d; ", grown[0], grown[1], grown[2]);
    printf("a joint was ever open by 0.001 of the size in %d, 0.01 in %d, 0.1 in %d\n", open[0], open[1], open[2]);
    return bad ? EXIT_FAILURE : EXIT_SUCCESS;
}

static int show(unsigned long long seed) {
    RandomVerdict v;
    random_judge(seed, &v, stdout);
    printf("growth %.3g, widest gap %.3g (joint %d)", v.growth, v.gap, v.gapJoint);
    printFaults(stdout, &v);
    return random_worstFault(&v) < 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

/* ---- the tests ---- */

START_TEST(none_of_1000_random_scenes_goes_wrong) {
    int bad = 0;
    for (unsigned long long seed = 0; seed < SCENES; seed += STRIDE) {
        RandomVerdict v;
        random_judge(seed, &v, NULL);
        if (random_worstFault(&v) < 0)
            continue;
        bad++;
        printScene(stderr, seed);
        printFaults(stderr, &v);
    }
    ck_assert_msg(bad == 0, "%d scenes went wrong", bad);
}
END_TEST

START_TEST(the_same_scene_gives_the_same_bits) {
    static RandomScene s[2];
    messages_catch();
    for (unsigned long long seed = 500; seed < 510; seed++) {
        for (int k = 0; k < 2; k++) {
            random_sceneMake(&s[k], seed);
            for (int i = 0; i < 40; i++)
                random_sceneStep(&s[k], i);
        }
        for (int i = 0; i < s[0].bodies; i++)
            ck_assert_mem_eq(MdtBodyGetTransformPtr(s[0].body[i].id), MdtBodyGetTransformPtr(s[1].body[i].id),
                             sizeof(MeMatrix4));
        for (int k = 0; k < 2; k++)
            random_sceneDestroy(&s[k]);
    }
    messages_release();
}
END_TEST

static void tests(TCase *t) {
    tcase_add_test(t, none_of_1000_random_scenes_goes_wrong);
    tcase_add_test(t, the_same_scene_gives_the_same_bits);
}

int main(int argc, char **argv) {
    if (argc >= 3 && strcmp(argv[1], "--survey") == 0)
        return survey(strtoull(argv[2], NULL, 10), argc > 3 ? strtoull(argv[3], NULL, 10) : 0);
    if (argc == 3 && strcmp(argv[1], "--seed") == 0)
        return show(strtoull(argv[2], NULL, 10));
    return test_main("RandomScenes", tests);
}
