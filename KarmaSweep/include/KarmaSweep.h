/** @file KarmaSweep.h
 *  What karma-sweep runs: a scene with parameters, which makes results of them. docs/sweep.md has an example.
 *
 *  A scene is a shared library, or a C file that karma-sweep compiles to one, with one function:
 *
 *      static int run(const double *parameter, double *result) { ... return 0; }
 *      static const SweepParameter parameters[] = {{"speed [m/s]", 1, 10, 10}, {"angle [rad]", 0, 1.5, 16}};
 *      static const char *const results[] = {"range [m]"};
 *      static const SweepScene scene = {SWEEP_VERSION, "throw", 2, parameters, 1, results, run};
 *      SWEEP_EXPORT const SweepScene *sweepScene(void) { return &scene; }
 *
 *  It needs nothing of karma-sweep but this header, and not Karma either.
 */
#ifndef KARMASWEEP_H
#define KARMASWEEP_H

#ifdef __cplusplus
extern "C" {
#endif

/** Of this header, for SweepScene. */
#define SWEEP_VERSION 1

/** How a scene's function is seen from outside. */
#if defined(__GNUC__)
#define SWEEP_EXPORT __attribute__((__visibility__("default")))
#else
#define SWEEP_EXPORT
#endif

/** Most parameters and results of a scene. */
enum { SWEEP_PARAMETERS = 32, SWEEP_RESULTS = 64 };

/** A parameter: its range as the scene suggests it; the option -set replaces it. */
typedef struct SweepParameter {
    const char *name;      /**< Title of its column, best with its unit. No commas, quotes or line ends. */
    double least, largest; /**< least <= largest */
    int count;             /**< Places on the grid, both ends among them: 1 or more; with 1 it is least. */
} SweepParameter;

/** A scene. All of it lives as long as the library is loaded. */
typedef struct SweepScene {
    int version;        /**< SWEEP_VERSION */
    const char *name;   /**< Of the table, without -out. No slashes, commas, quotes or line ends. */
    int parameterCount; /**< 0 to SWEEP_PARAMETERS */
    const SweepParameter *parameter;
    int resultCount; /**< 1 to SWEEP_RESULTS */
    const char *const *result;
    /**
     * One run. @a parameter has a value of each parameter, @a result takes one of each result; at first they are NaN.
     * Returns 0, or what went wrong, above 0: the row then says `failed` with that number. It is called many times in
     * one process, and by several processes, in any order; what it returns must depend on the parameters alone. Should
     * it crash, that costs its process, and the run is tried again. Its standard input is empty, what it prints goes to
     * the standard error output of karma-sweep, and of what is open only its own files and those of sweepScene are.
     */
    int (*run)(const double *parameter, double *result);
} SweepScene;

/** The function by which karma-sweep finds the scene in its library. */
SWEEP_EXPORT const SweepScene *sweepScene(void);

#ifdef __cplusplus
}
#endif

#endif
