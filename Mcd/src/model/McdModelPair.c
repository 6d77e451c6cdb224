/* Pairs of models that programs create themselves. */
#include "McdModelPair.h"
#include "model/mcd_result_i.h"
#include <string.h>

MeBool mcd_modelsMakeAPair(McdModelID m1, McdModelID m2, const char *function) {
    if (!mcd_modelCheck(m1, function) || !mcd_modelCheck(m2, function))
        return MEFALSE;
    if (m1 == m2 || mcd_record(m1)->frame != mcd_record(m2)->frame) {
        MeWarning(1, "%s: a pair is made of two models of one framework", function);
        return MEFALSE;
    }
    return METRUE;
}

int mcd_warnNotPlaced(const char *function) {
    MeWarning(1, "%s: a model has no transform, or one that is not finite, or flat: they do not touch",
              MeCallerName(function));
    return 0;
}

MeBool mcd_pairIsPlaced(const McdModelPair *p, const char *function) {
    return (mcd_modelIsPlaced(mcd_record(p->model1)) && mcd_modelIsPlaced(mcd_record(p->model2))) ||
           mcd_warnNotPlaced(function);
}

static MeBool isPair(McdModelPairID p, const char *function) {
    if (!p)
        MeWarning(1, "%s: no pair", function);
    return p != 0;
}

McdModelPairID MEAPI McdModelPairCreate(McdModelID m1, McdModelID m2) {
    if (!mcd_modelsMakeAPair(m1, m2, "McdModelPairCreate"))
        return 0;
    McdModelPairID p = MeMemoryTake(1, sizeof *p, "McdModelPairCreate", "a pair");
    if (p)
        McdModelPairReset(p, m1, m2);
    return p;
}

void MEAPI McdModelPairDestroy(McdModelPairID p) {
    MeMemoryGive(p);
}

void MEAPI McdModelPairReset(McdModelPairID p, McdModelID m1, McdModelID m2) {
    if (!isPair(p, "McdModelPairReset") || !mcd_modelsMakeAPair(m1, m2, "McdModelPairReset"))
        return;
    memset(p, 0, sizeof *p);
    p->model1 = m1;
    p->model2 = m2;
}

void MEAPI McdModelPairSetRequestPtr(McdModelPairID p, McdRequest *request) {
    if (isPair(p, "McdModelPairSetRequestPtr"))
        p->request = request;
}

McdRequest *MEAPI McdModelPairGetRequestPtr(const McdModelPairID p) {
    if (!isPair(p, "McdModelPairGetRequestPtr"))
        return 0;
    return p->request ? p->request : mcd_record(p->model1)->frame->defaultRequest;
}

void MEAPI McdModelPairGetModels(McdModelPairID p, McdModelID *m1, McdModelID *m2) {
    if (!mcd_areGiven(__func__, m1, m2, m2))
        return;
    const MeBool isGood = isPair(p, "McdModelPairGetModels");
    *m1 = isGood ? p->model1 : 0;
    *m2 = isGood ? p->model2 : 0;
}

void MEAPI McdModelPairGetGeometryNames(McdModelPairID p, const char **name1, const char **name2) {
    if (!mcd_areGiven(__func__, name1, name2, name2))
        return;
    const MeBool isGood = isPair(p, "McdModelPairGetGeometryNames");
    *name1 = isGood ? McdGeometryGetTypeName(McdModelGetGeometry(p->model1)) : "(none)";
    *name2 = isGood ? McdGeometryGetTypeName(McdModelGetGeometry(p->model2)) : "(none)";
}

void MEAPI McdModelPairSetUserData(McdModelPairID p, void *data) {
    if (isPair(p, "McdModelPairSetUserData"))
        p->userData = data;
}

void *MEAPI McdModelPairGetUserData(McdModelPairID p) {
    return isPair(p, "McdModelPairGetUserData") ? p->userData : 0;
}
