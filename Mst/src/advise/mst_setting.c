/* Selects the settings that are worth a trial in a scene, and applies them (MstAdvise.h). */
#include "McdModel.h"
#include "McdSpace.h"
#include "MdtContactParams.h"
#include "MdtDefaults.h"
#include "MdtWorld.h"
#include "MeAssert.h"
#include "MeMath.h"
#include "MeTask.h"
#include "advise/mst_advise_i.h"
#include "step/mst_step_i.h"
#include <stdarg.h>
#include <stdio.h>

/* ---- the list ---------------------------------------------------------------------------------------------------- */

typedef struct Plan {
    MstSetting *setting;
    int count;
} Plan;

static void addSetting(Plan *plan, MstKnob knob, double value, double value2, const char *format, ...)
    ME_PRINTF_LIKE(5, 6);

static void addSetting(Plan *plan, MstKnob knob, double value, double value2, const char *format, ...) {
    va_list arguments;
    MEASSERT(plan->count < MST_SETTINGS);
    MstSetting *s = &plan->setting[plan->count++];
    *s = (MstSetting){knob, value, value2, ""};
    va_start(arguments, format);
    vsnprintf(s->call, sizeof s->call, format, arguments);
    va_end(arguments);
}

/* ---- properties of the scene ------------------------------------------------------------------------------------- */

typedef struct Models {
    int withBody, swept;
    double size, mass; /* m, kg: geometric means of their radii and masses, as scales are ratios */
} Models;

static Models summarizeModels(MstUniverseID u) {
    Models all = {0, 0, 0, 0};
    McdSpaceModelIterator it;
    McdModelID m;
    McdSpaceModelIteratorBegin(u->space, &it);
    while (McdSpaceGetModel(u->space, &it, &m)) {
        const MdtBodyID body = McdModelGetBody(m);
        MeVector3 center;
        MeReal radius = 0;
        if (!body)
            continue;
        McdGeometryGetBSphere(McdModelGetGeometry(m), center, &radius);
        if (!(radius > 0) || !MeRealIsValid(radius))
            continue;
        all.withBody++;
        all.swept += McdModelIsSwept(m) != 0;
        all.size += log((double)radius);
        all.mass += log((double)MdtBodyGetMass(body));
    }
    if (all.withBody > 0) {
        all.size = exp(all.size / all.withBody);
        all.mass = exp(all.mass / all.withBody);
    }
    return all;
}

/* Number of material pairs with this friction model and non-zero friction. */
static int countFriction(MstUniverseID u, MdtFrictionModel model) {
    const MstBridgeRecord *b = (const MstBridgeRecord *)u->bridge;
    int count = 0;
    for (MstMaterialID i = 0; i < b->materialCount; i++)
        for (MstMaterialID j = 0; j <= i; j++) {
            const MdtBclContactParams *p = &mst_materialPair(b, i, j)->params;
            count += p->type == MdtContactTypeFriction2D && p->model1 == model && p->frictioncoeff1 > 0;
        }
    return count;
}

/* ---- selection --------------------------------------------------------------------------------------------------- */

static void planSolver(Plan *plan, MdtWorldID w, const MstSceneTraits *traits) {
    static const char *const name[] = {"MdtSolverAuto", "MdtSolverExact", "MdtSolverFast"};
    const MdtSolver now = MdtWorldGetSolver(w);
    for (int i = MdtSolverAuto; i <= (int)MdtSolverFast; i++) {
        const MeBool isUsed = now == MdtSolverAuto && ((i == MdtSolverExact && !traits->usesFastSolver) ||
                                                       (i == MdtSolverFast && !traits->usesExactSolver));
        if (i != (int)now && !isUsed)
            addSetting(plan, MST_KNOB_SOLVER, i, 0, "MdtWorldSetSolver(world, %s)", name[i]);
    }
    const double accuracy = (double)MdtWorldGetAccuracy(w);
    if (traits->usesFastSolver && accuracy > 0)
        for (int i = 0; i < 2; i++) {
            const double value = i ? accuracy / 10 : accuracy * 10;
            addSetting(plan, MST_KNOB_ACCURACY, value, 0, "MdtWorldSetAccuracy(world, %.2g)", value);
        }
    if (traits->exceedsBudget) {
        const double budget = 4 * (double)MdtWorldGetWorkBudget(w);
        addSetting(plan, MST_KNOB_BUDGET, budget, 0, "MdtWorldSetWorkBudget(world, %g)", budget);
    }
}

static void planTimeIntegration(Plan *plan, MdtWorldID w, const MstSceneTraits *traits) {
    const int n = MdtWorldGetSubSteps(w);
    if (n > 2)
        addSetting(plan, MST_KNOB_SUBSTEPS, 1, 0, "MdtWorldSetSubSteps(world, 1)");
    if (n > 1)
        addSetting(plan, MST_KNOB_SUBSTEPS, n / 2, 0, "MdtWorldSetSubSteps(world, %d)", n / 2);
    for (int factor = 2; factor <= 4; factor *= 2)
        if (factor * n <= 1000)
            addSetting(plan, MST_KNOB_SUBSTEPS, factor * n, 0, "MdtWorldSetSubSteps(world, %d)", factor * n);
    if (traits->hasContacts && MdtWorldGetTimedContacts(w) > 0)
        addSetting(plan, MST_KNOB_TIMED, 0, 0, "MdtWorldSetTimedContacts(world, 0)");
    else if (traits->hasContacts)
        addSetting(plan, MST_KNOB_TIMED, 8, 0, "MdtWorldSetTimedContacts(world, 8)");
    if (traits->hasJoints) {
        const int other = MdtWorldGetIntegratorOrder(w) == 2 ? 4 : 2;
        addSetting(plan, MST_KNOB_ORDER, other, 0, "MdtWorldSetIntegratorOrder(world, %d)", other);
    }
}

static void planFriction(Plan *plan, MstUniverseID u) {
    static const struct {
        MdtFrictionModel from, to;
        const char *name;
    } change[] = {{MdtFrictionModelCone, MdtFrictionModelNormalForce, "MdtFrictionModelNormalForce"},
                  {MdtFrictionModelNormalForce, MdtFrictionModelCone, "MdtFrictionModelCone"}};
    for (int i = 0; i < 2; i++) {
        const int pairs = countFriction(u, change[i].from);
        if (pairs > 0)
            addSetting(plan, MST_KNOB_FRICTION, change[i].from, change[i].to,
                       "MdtContactParamsSetFrictionModel(params, %s) of %d material pair%s", change[i].name, pairs,
                       pairs > 1 ? "s" : "");
    }
}

static void planSleep(Plan *plan, MdtWorldID w) {
    const MeBool isOn = MdtWorldGetAutoDisable(w);
    addSetting(plan, MST_KNOB_SLEEP, !isOn, 0, "MdtWorldSetAutoDisable(world, %s)", isOn ? "MEFALSE" : "METRUE");
    if (isOn)
        for (int i = 0; i < 2; i++)
            addSetting(plan, MST_KNOB_SLEEP_THRESHOLD, i ? .5 : 2, 0,
                       "MdtWorldSetAutoDisable...Threshold(world, %s of what it is), all four",
                       i ? "a quarter" : "four times");
}

/* Plans a trial of other scales if the length scale is wrong by a factor of 4, as sleep thresholds, which are squares
 * of speeds and accelerations, are then wrong by 16; or if the mass scale is wrong by 64. */
static void planScales(Plan *plan, MstUniverseID u, const Models *models) {
    enum { FAR = 4 };
    const double length = 2 * models->size, mass = models->mass;
    if (models->withBody == 0 || !(mass > 0))
        return;
    const double byLength = length / (double)u->sizes.lengthScale, byMass = mass / (double)u->sizes.massScale;
    if (byLength > FAR || byLength < 1. / FAR || byMass > FAR * FAR * FAR || byMass < 1. / (FAR * FAR * FAR))
        addSetting(plan, MST_KNOB_SCALES, length, mass, "MstUniverseSizes.lengthScale = %.2g, .massScale = %.2g",
                   length, mass);
}

int mst_settingsPlan(MstUniverseID u, const MstSceneTraits *traits, MstSetting setting[MST_SETTINGS]) {
    Plan plan = {setting, 0};
    const Models models = summarizeModels(u);
    planTimeIntegration(&plan, u->world, traits);
    if (traits->hasContacts) {
        planSolver(&plan, u->world, traits);
        planFriction(&plan, u);
    }
    if (models.swept > 0)
        addSetting(&plan, MST_KNOB_SWEPT, MEFALSE, 0, "McdModelSetSwept(model, MEFALSE) of all %d", models.swept);
    if (traits->hasFastBodies && models.swept < models.withBody)
        addSetting(&plan, MST_KNOB_SWEPT, METRUE, 0, "McdModelSetSwept(model, METRUE) of all %d", models.withBody);
    planSleep(&plan, u->world);
    if (traits->hasLargeIsland && MstBridgeGetContactReuse(u->bridge) > 0)
        addSetting(&plan, MST_KNOB_REUSE, 0, 0, "MstBridgeSetContactReuse(bridge, 0)");
    if (traits->hasLargeIsland) {
        const double reuse = fmin(1, 10 * fmax((double)MstBridgeGetContactReuse(u->bridge), .1 * MST_CONTACT_REUSE));
        addSetting(&plan, MST_KNOB_REUSE, reuse, 0, "MstBridgeSetContactReuse(bridge, %g)", reuse);
    }
    planScales(&plan, u, &models);
    return plan.count;
}

/* ---- applying one ------------------------------------------------------------------------------------------------ */

static void setFriction(MstUniverseID u, MdtFrictionModel from, MdtFrictionModel to) {
    const MstBridgeRecord *b = (const MstBridgeRecord *)u->bridge;
    for (MstMaterialID i = 0; i < b->materialCount; i++)
        for (MstMaterialID j = 0; j <= i; j++) {
            MdtBclContactParams *p = &mst_materialPair(b, i, j)->params;
            if (p->type == MdtContactTypeFriction2D && p->model1 == from)
                MdtContactParamsSetFrictionModel(p, to);
        }
}

static void setSwept(MstUniverseID u, MeBool isSwept) {
    McdSpaceModelIterator it;
    McdModelID m;
    McdSpaceModelIteratorBegin(u->space, &it);
    while (McdSpaceGetModel(u->space, &it, &m))
        if (McdModelGetBody(m))
            McdModelSetSwept(m, isSwept);
}

/* Scales the sleep thresholds, which are squares, to speeds and accelerations larger by these factors. */
static void scaleThresholds(MdtWorldID w, double velocity, double angularVelocity, double acceleration,
                            double turningAcc) {
    MdtWorldSetAutoDisableVelocityThreshold(
        w, (MeReal)(velocity * velocity * (double)MdtWorldGetAutoDisableVelocityThreshold(w)));
    MdtWorldSetAutoDisableAngularVelocityThreshold(
        w, (MeReal)(angularVelocity * angularVelocity * (double)MdtWorldGetAutoDisableAngularVelocityThreshold(w)));
    MdtWorldSetAutoDisableAccelerationThreshold(
        w, (MeReal)(acceleration * acceleration * (double)MdtWorldGetAutoDisableAccelerationThreshold(w)));
    MdtWorldSetAutoDisableAngularAccelerationThreshold(
        w, (MeReal)(turningAcc * turningAcc * (double)MdtWorldGetAutoDisableAngularAccelerationThreshold(w)));
}

/* Sets what a universe derives from its scales: epsilon, sleep thresholds, and contact tolerances of models. */
static void setScales(MstUniverseID u, double length, double mass) {
    MstUniverseSizes sizes = u->sizes;
    const double by = length / (double)sizes.lengthScale;
    McdSpaceModelIterator it;
    McdModelID m;
    sizes.lengthScale = (MeReal)length;
    sizes.massScale = (MeReal)mass;
    MdtWorldSetEpsilon(u->world, (MeReal)mst_epsilonForSizes(&sizes));
    scaleThresholds(u->world, by, 1, by, 1);
    McdSpaceModelIteratorBegin(u->space, &it);
    while (McdSpaceGetModel(u->space, &it, &m))
        McdModelSetContactTolerance(m, (MeReal)(by * (double)McdModelGetContactTolerance(m)));
}

static void setReference(MstUniverseID u, int subSteps, MeBool sweeps) {
    MdtWorldSetSolver(u->world, MdtSolverExact);
    MdtWorldSetAccuracy(u->world, 0);
    MdtWorldSetSubSteps(u->world, subSteps);
    if (MdtWorldGetTimedContacts(u->world) < 8) /* the default */
        MdtWorldSetTimedContacts(u->world, 8);
    MdtWorldSetWorkBudget(u->world, 0);
    MdtWorldSetMaxLCPIterations(u->world, 0);
    MdtWorldSetAutoDisable(u->world, MEFALSE);
    MstBridgeSetContactReuse(u->bridge, 0);
    if (sweeps)
        setSwept(u, METRUE);
}

void mst_settingApply(MstUniverseID u, const MstSetting *s) {
    const MdtWorldID w = u->world;
    switch (s->knob) {
    case MST_KNOB_REFERENCE:
        setReference(u, (int)s->value, s->value2 != 0);
        break;
    case MST_KNOB_TIMED:
        MdtWorldSetTimedContacts(w, (int)s->value);
        break;
    case MST_KNOB_SUBSTEPS:
        MdtWorldSetSubSteps(w, (int)s->value);
        break;
    case MST_KNOB_SOLVER:
        MdtWorldSetSolver(w, (MdtSolver)s->value);
        break;
    case MST_KNOB_ACCURACY:
        MdtWorldSetAccuracy(w, (MeReal)s->value);
        break;
    case MST_KNOB_BUDGET:
        MdtWorldSetWorkBudget(w, (MeReal)s->value);
        break;
    case MST_KNOB_ORDER:
        MdtWorldSetIntegratorOrder(w, (int)s->value);
        break;
    case MST_KNOB_FRICTION:
        setFriction(u, (MdtFrictionModel)s->value, (MdtFrictionModel)s->value2);
        break;
    case MST_KNOB_SWEPT:
        setSwept(u, s->value != 0);
        break;
    case MST_KNOB_SLEEP:
        MdtWorldSetAutoDisable(w, s->value != 0);
        break;
    case MST_KNOB_SLEEP_THRESHOLD:
        scaleThresholds(w, s->value, s->value, s->value, s->value);
        break;
    case MST_KNOB_REUSE:
        MstBridgeSetContactReuse(u->bridge, (MeReal)s->value);
        break;
    case MST_KNOB_SCALES:
        setScales(u, s->value, s->value2);
        break;
    case MST_KNOB_NONE:
    case MST_KNOBS:
        break;
    }
}
