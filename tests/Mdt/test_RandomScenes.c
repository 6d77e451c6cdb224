/* Stability as a property: no random scene (random_scene.h), all of them shaken, has a number that is not
 * finite, an energy that grows without a motor, or a joint that stays open (random_judge.h).
 *
 *     test_Mdt_RandomScenes                       the tests
 *     test_Mdt_RandomScenes --survey COUNT [FIRST] what goes wrong in so many seeds, and how often
 *     test_Mdt_RandomScenes --seed SEED            one scene, step by step
 */
#include "random_judge.h"
#include <time.h>

/* All in single precision, a third in double; a sanitizer makes a step many times as long. */
#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define IS_SANITIZED
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
#define IS_SANITIZED
#endif
#ifdef IS_SANITIZED
enum { SCENES = 1000, STRIDE = 20, FIRST = 2 };
#elif defined _ME_API_DOUBLE
enum { SCENES = 1000, STRIDE = 3, FIRST = 1 };
#else
enum { SCENES = 1000, STRIDE = 1, FIRST = 0 };
#endif

/* A chain of balls in free air, without motors. */
enum { GOOD_SEED = 228 };

static RandomJudge judge;

/* ---- words ---- */

/* One line: the scene, and its faults. It still describes a scene that is over, but for its world. */
static void printFaults(FILE *file, const RandomJudge *j) {
    const RandomScene *s = &j->scene;
    fprintf(file, "seed %llu: 1/%.0f s, %s of %d%s%s%s, epsilon %g, masses 1:%.2g, %.2g m/s", s->seed, 1 / s->step,
            s->topology, s->bodies, s->isOneKind ? " by " : "", s->isOneKind ? s->joint[0].kind : "",
            s->hasGround ? ", ground" : "", s->epsilon, s->ratio, s->shaking);
    for (int i = 0; i < FAULTS; i++) {
        const RandomFault *f = &j->verdict.fault[i];
        if (!f->is)
            continue;
        fprintf(file, " | %s %.3g from step %d", random_faultName[i], f->amount, f->step);
        if (f->joint >= 0)
            fprintf(file, " (%s %d)", s->joint[f->joint].kind, f->joint);
    }
    fputc('\n', file);
}

static int show(unsigned long long seed) {
    const MeBool isGood = random_judge(&judge, seed, stdout);
    printFaults(stdout, &judge);
    return isGood ? EXIT_SUCCESS : EXIT_FAILURE;
}

/* ---- the survey ---- */

enum { SLOWEST = 5 };

typedef struct {
    int bad, failed[FAULTS];
    int grown[4], open[4]; /* by more than so many powers of ten */
    double seconds;
    long bodySteps;
    struct {
        unsigned long long seed;
        double microseconds; /* per body and step */
    } slow[SLOWEST];
} Survey;

static void noteSpeed(Survey *v, const RandomScene *s, double seconds) {
    double microseconds = 1e6 * seconds / (s->bodies * s->duration);
    unsigned long long seed = s->seed;
    v->seconds += seconds;
    v->bodySteps += (long)s->bodies * s->duration;
    for (int i = 0; i < SLOWEST; i++)
        if (microseconds > v->slow[i].microseconds) {
            const double m = v->slow[i].microseconds;
            const unsigned long long other = v->slow[i].seed;
            v->slow[i].microseconds = microseconds;
            v->slow[i].seed = seed;
            microseconds = m;
            seed = other;
        }
}

static void note(Survey *v, const RandomJudge *j, MeBool isGood) {
    v->bad += !isGood;
    for (int i = 0; i < FAULTS; i++)
        v->failed[i] += j->verdict.fault[i].is;
    for (int i = 0; i < 4; i++) {
        v->grown[i] += j->verdict.growth > pow(10, i - 2);
        v->open[i] += j->verdict.gap > pow(10, i - 3);
    }
}

static void printSurvey(const Survey *v, unsigned long long count) {
    printf("\n%d of %llu scenes went wrong:", v->bad, count);
    for (int i = 0; i < FAULTS; i++)
        printf(" %s %d%s", random_faultName[i], v->failed[i], i + 1 < FAULTS ? "," : "\n");
    printf("energy grew, and stayed so, by 0.01 of itself in %d, 0.1 in %d, 1 in %d, 10 in %d\n", v->grown[0],
           v->grown[1], v->grown[2], v->grown[3]);
    printf("a joint was open, if only for a step, by 0.001 of its size in %d, 0.01 in %d, 0.1 in %d, 1 in %d\n",
           v->open[0], v->open[1], v->open[2], v->open[3]);
    printf("%.1f s, %.1f us per body and step; slowest:", v->seconds, 1e6 * v->seconds / (double)v->bodySteps);
    for (int i = 0; i < SLOWEST; i++)
        printf(" seed %llu %.0f us%s", v->slow[i].seed, v->slow[i].microseconds, i + 1 < SLOWEST ? "," : "\n");
}

static int survey(unsigned long long count, unsigned long long first) {
    Survey v = {0};
    for (unsigned long long seed = first; seed < first + count; seed++) {
        const clock_t start = clock();
        const MeBool isGood = random_judge(&judge, seed, NULL);
        noteSpeed(&v, &judge.scene, (double)(clock() - start) / CLOCKS_PER_SEC);
        note(&v, &judge, isGood);
        if (!isGood)
            printFaults(stdout, &judge);
        fflush(stdout);
    }
    printSurvey(&v, count);
    return v.bad ? EXIT_FAILURE : EXIT_SUCCESS;
}

/* ---- the tests ---- */

TEST(no_random_scene_goes_wrong) {
    int bad = 0, inexact = 0;
    for (unsigned long long seed = FIRST; seed < SCENES; seed += STRIDE) {
        const MeBool isGood = random_judge(&judge, seed, NULL);
        inexact += judge.verdict.fault[FAULT_CAPPED].is;
        if (isGood)
            continue;
        bad++;
        printFaults(stderr, &judge);
    }
    ck_assert_msg(bad == 0, "%d scenes went wrong", bad);
    ck_assert_msg(inexact * STRIDE <= SCENES / 50, "%d scenes had inexact steps", inexact);
}

/* A joint that lets go, unknown to the judge. */
TEST(the_judge_sees_an_open_joint) {
    random_judgeBegin(&judge, GOOD_SEED, NULL);
    do {
        if (judge.step == judge.scene.duration - RANDOM_CALM)
            MdtConstraintDisable(judge.scene.joint[0].id);
    } while (random_judgeStep(&judge));
    random_judgeEnd(&judge);
    ck_assert(judge.verdict.fault[FAULT_GAP].is);
    ck_assert_int_eq(judge.verdict.fault[FAULT_GAP].joint, 0);
}

/* Velocities that grow by a thousandth a step, unknown to the judge. */
TEST(the_judge_sees_energy_from_nowhere) {
    random_judgeBegin(&judge, GOOD_SEED, NULL);
    do {
        for (int i = 0; i < judge.scene.bodies; i++) {
            MdtBodyID b = judge.scene.body[i].id;
            MeVector3 v, w;
            MdtBodyGetLinearVelocity(b, v);
            MdtBodyGetAngularVelocity(b, w);
            const MeReal more = 1.001;
            MdtBodySetLinearVelocity(b, more * v[0], more * v[1], more * v[2]);
            MdtBodySetAngularVelocity(b, more * w[0], more * w[1], more * w[2]);
        }
    } while (random_judgeStep(&judge));
    random_judgeEnd(&judge);
    ck_assert(judge.verdict.fault[FAULT_ENERGY].is);
    ck_assert(!judge.verdict.fault[FAULT_GAP].is);
}

TEST(the_judge_has_nothing_to_say_of_a_good_scene) {
    ck_assert(random_judge(&judge, GOOD_SEED, NULL));
}

TEST(the_same_scene_gives_the_same_bits) {
    static RandomScene s[2];
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
}

int main(int argc, char **argv) {
    if (argc >= 3 && strcmp(argv[1], "--survey") == 0)
        return survey(strtoull(argv[2], NULL, 10), argc > 3 ? strtoull(argv[3], NULL, 10) : 0);
    if (argc == 3 && strcmp(argv[1], "--seed") == 0)
        return show(strtoull(argv[2], NULL, 10));
    return test_main("RandomScenes");
}
