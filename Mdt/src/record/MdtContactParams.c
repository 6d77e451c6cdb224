/* Contact parameters: setters with checks, getters. An option bit of a parameter says whether it is set. */
#include "record/mdt_record_i.h"

static MeBool isParams(const MdtContactParamsID p, const char *caller) {
    return mdt_isPointer(caller, "the pointer to the parameters", p);
}

static void setOption(MdtContactParamsID p, int option, MeBool on) {
    p->options = on ? p->options | option : p->options & ~option;
}

/* Sets a number >= 0; otherwise warns. */
static MeBool setNonNegative(MdtContactParamsID p, MeReal *value, MeReal x, const char *caller, const char *what) {
    if (!isParams(p, caller) || !mdt_isNotBelow(caller, what, x, 0))
        return MEFALSE;
    *value = x;
    return METRUE;
}

/* A function that returns a parameter; `none` for null. */
#define PARAMS_GETTER(Type, function, member, none)                                                                    \
    Type MEAPI function(const MdtContactParamsID p) {                                                                  \
        return isParams(p, __func__) ? p->member : none;                                                               \
    }
#define FIELD(p, name) ((p) ? &(p)->name : NULL)

void MEAPI MdtContactParamsReset(const MdtContactParamsID p) {
    if (isParams(p, __func__))
        MdtBclContactParamsReset(p);
}

/* ---- the usual surface ---- */

void MEAPI MdtContactParamsSetSurface(const MdtContactParamsID p, MeReal friction, MeReal restitution) {
    if (!isParams(p, __func__) || !mdt_isNotBelow(__func__, "the friction coefficient", friction, 0))
        return;
    if (!(restitution >= 0 && restitution <= 1)) {
        MeWarning(1, "MdtContactParamsSetSurface: the restitution %g is not between 0 and 1; nothing is changed",
                  (double)restitution);
        return;
    }
    MdtContactParamsSetType(p, friction > 0 ? MdtContactTypeFriction2D : MdtContactTypeFrictionZero);
    MdtContactParamsSetFrictionModel(p, MdtFrictionModelCone);
    MdtContactParamsSetFrictionCoeffecient(p, friction);
    MdtContactParamsSetRestitution(p, restitution);
}

enum { WITHOUT_TYPE = 1, WITHOUT_MODEL = 2, WITHOUT_COEFFICIENT = 4, WITHOUT_BOUND = 8 };

static const struct {
    int problem;
    const char *text;
} surfaceTexts[] = {
    {WITHOUT_TYPE, "has a coefficient, a bound in newtons or a model of friction, but no friction: "
                   "MdtContactParamsSetType was not called"},
    {WITHOUT_MODEL, "has a friction coefficient, which its friction model, the box, does not use"},
    {WITHOUT_COEFFICIENT, "has a friction model that wants a coefficient, and none: there is no friction"},
    {WITHOUT_BOUND, "has friction without bound: nothing slides. If that is meant, call "
                    "MdtContactParamsSetFriction(params, MEINFINITY)"},
};

static int problemOf(const MdtBclContactParams *p, MdtFrictionModel model, MeReal coefficient, MeReal bound) {
    const MeBool isBoundSet = (p->options & MdtBclContactOptionBoundSet) != 0 && bound > 0;
    if (p->type == MdtContactTypeFrictionZero)
        return !(p->options & MdtBclContactOptionTypeSet) &&
                       (model != MdtFrictionModelBox || coefficient > 0 || isBoundSet)
                   ? WITHOUT_TYPE
                   : 0;
    if (model != MdtFrictionModelBox)
        return coefficient > 0 ? 0 : WITHOUT_COEFFICIENT;
    if (p->options & (MdtBclContactOptionBoundSet | MdtBclContactOptionSlip1 | MdtBclContactOptionSlip2))
        return 0; /* a surface with slip does slide */
    return coefficient > 0 ? WITHOUT_MODEL : bound < MEINFINITY ? 0 : WITHOUT_BOUND;
}

int mdt_surfaceProblem(const MdtBclContactParams *p) {
    const int problem = problemOf(p, p->model1, p->FrictionCoefficient, p->friction1);
    if (problem || p->type == MdtContactTypeFriction1D)
        return problem;
    return problemOf(p, p->model2, p->FrictionCoefficient2, p->friction2);
}

/* Friction without bound only gets an information: in the guides it is what setting a type alone means (User Guide ch.
 * 8). */
void mdt_surfaceWarn(MdtWorldID w, int problems) {
    const int more = problems & ~w->surfaceWarnings;
    w->surfaceWarnings |= problems;
    for (size_t i = 0; i < sizeof surfaceTexts / sizeof *surfaceTexts; i++)
        if (surfaceTexts[i].problem & more)
            (surfaceTexts[i].problem == WITHOUT_BOUND ? MeInfo : MeWarning)(
                1, "%s: a contact %s; MdtContactParamsSetSurface sets all that friction needs",
                MeCallerName("MdtWorldStep"), surfaceTexts[i].text);
}

/* ---- kind of friction ---- */

void MEAPI MdtContactParamsSetType(const MdtContactParamsID p, MdtContactType t) {
    if (!isParams(p, __func__))
        return;
    if (t < MdtContactTypeFrictionZero || t > MdtContactTypeFriction2D)
        MeWarning(1, "MdtContactParamsSetType: there is no contact type %d; nothing is changed", (int)t);
    else {
        p->type = t;
        setOption(p, MdtBclContactOptionTypeSet, METRUE);
    }
}

PARAMS_GETTER(MdtContactType, MdtContactParamsGetType, type, MdtContactTypeUnknown)

static MeBool setModel(MdtContactParamsID p, MdtFrictionModel *model, MdtFrictionModel m, const char *caller) {
    if (!isParams(p, caller))
        return MEFALSE;
    if (m < MdtFrictionModelBox || m > MdtFrictionModelCone) {
        MeWarning(1, "%s: there is no friction model %d; nothing is changed", caller, (int)m);
        return MEFALSE;
    }
    *model = m;
    return METRUE;
}

void MEAPI MdtContactParamsSetFrictionModel(const MdtContactParamsID p, MdtFrictionModel m) {
    if (setModel(p, FIELD(p, model1), m, __func__))
        p->model2 = m;
}

void MEAPI MdtContactParamsSetPrimaryFrictionModel(const MdtContactParamsID p, MdtFrictionModel m) {
    setModel(p, FIELD(p, model1), m, __func__);
}

void MEAPI MdtContactParamsSetSecondaryFrictionModel(const MdtContactParamsID p, MdtFrictionModel m) {
    setModel(p, FIELD(p, model2), m, __func__);
}

PARAMS_GETTER(MdtFrictionModel, MdtContactParamsGetPrimaryFrictionModel, model1, MdtFrictionModelUnknown)

PARAMS_GETTER(MdtFrictionModel, MdtContactParamsGetSecondaryFrictionModel, model2, MdtFrictionModelUnknown)

/* ---- friction ---- */

static MeBool setBound(MdtContactParamsID p, MeReal *bound, MeReal f, const char *caller) {
    if (!setNonNegative(p, bound, f, caller, "the friction"))
        return MEFALSE;
    setOption(p, MdtBclContactOptionBoundSet, METRUE);
    return METRUE;
}

static MeBool setCoefficient(MdtContactParamsID p, MeReal *coefficient, MeReal f, const char *caller) {
    return setNonNegative(p, coefficient, f, caller, "the friction coefficient");
}

void MEAPI MdtContactParamsSetFriction(const MdtContactParamsID p, MeReal f) {
    if (setBound(p, FIELD(p, friction1), f, __func__))
        p->friction2 = f;
}

void MEAPI MdtContactParamsSetPrimaryFriction(const MdtContactParamsID p, MeReal f) {
    setBound(p, FIELD(p, friction1), f, __func__);
}

void MEAPI MdtContactParamsSetSecondaryFriction(const MdtContactParamsID p, MeReal f) {
    setBound(p, FIELD(p, friction2), f, __func__);
}

PARAMS_GETTER(MeReal, MdtContactParamsGetPrimaryFriction, friction1, 0)

PARAMS_GETTER(MeReal, MdtContactParamsGetSecondaryFriction, friction2, 0)

void MEAPI MdtContactParamsSetFrictionCoeffecient(const MdtContactParamsID p, MeReal f) {
    if (setCoefficient(p, FIELD(p, FrictionCoefficient), f, __func__))
        p->FrictionCoefficient2 = f;
}

void MEAPI MdtContactParamsSetPrimaryFrictionCoeffecient(const MdtContactParamsID p, MeReal f) {
    setCoefficient(p, FIELD(p, FrictionCoefficient), f, __func__);
}

void MEAPI MdtContactParamsSetSecondaryFrictionCoeffecient(const MdtContactParamsID p, MeReal f) {
    setCoefficient(p, FIELD(p, FrictionCoefficient2), f, __func__);
}

PARAMS_GETTER(MeReal, MdtContactParamsGetPrimaryFrictionCoeffecient, FrictionCoefficient, 0)

PARAMS_GETTER(MeReal, MdtContactParamsGetSecondaryFrictionCoeffecient, FrictionCoefficient2, 0)

/* ---- slip and slide ---- */

static MeBool setSlip(MdtContactParamsID p, MeReal *slip, MeReal s, int option, const char *caller) {
    if (!setNonNegative(p, slip, s, caller, "the slip"))
        return MEFALSE;
    setOption(p, option, s > 0);
    return METRUE;
}

void MEAPI MdtContactParamsSetSlip(const MdtContactParamsID p, MeReal f) {
    if (setSlip(p, FIELD(p, slip1), f, MdtBclContactOptionSlip1, __func__))
        setSlip(p, &p->slip2, f, MdtBclContactOptionSlip2, __func__);
}

void MEAPI MdtContactParamsSetPrimarySlip(const MdtContactParamsID p, MeReal s) {
    setSlip(p, FIELD(p, slip1), s, MdtBclContactOptionSlip1, __func__);
}

void MEAPI MdtContactParamsSetSecondarySlip(const MdtContactParamsID p, MeReal s) {
    setSlip(p, FIELD(p, slip2), s, MdtBclContactOptionSlip2, __func__);
}

PARAMS_GETTER(MeReal, MdtContactParamsGetPrimarySlip, slip1, 0)

PARAMS_GETTER(MeReal, MdtContactParamsGetSecondarySlip, slip2, 0)

void MEAPI MdtContactParamsSetPrimarySlide(const MdtContactParamsID p, MeReal s) {
    if (!isParams(p, __func__) || !mdt_isFinite(__func__, "the slide", s))
        return;
    p->slide1 = s;
    setOption(p, MdtBclContactOptionSlide1, s != 0);
}

void MEAPI MdtContactParamsSetSecondarySlide(const MdtContactParamsID p, MeReal s) {
    if (!isParams(p, __func__) || !mdt_isFinite(__func__, "the slide", s))
        return;
    p->slide2 = s;
    setOption(p, MdtBclContactOptionSlide2, s != 0);
}

PARAMS_GETTER(MeReal, MdtContactParamsGetPrimarySlide, slide1, 0)

PARAMS_GETTER(MeReal, MdtContactParamsGetSecondarySlide, slide2, 0)

/* ---- rolling and spinning friction ---- */

void MEAPI MdtContactParamsSetRollingFriction(const MdtContactParamsID p, MeReal r) {
    setNonNegative(p, FIELD(p, rollingFriction), r, __func__, "the rolling friction");
}

PARAMS_GETTER(MeReal, MdtContactParamsGetRollingFriction, rollingFriction, 0)

void MEAPI MdtContactParamsSetSpinningFriction(const MdtContactParamsID p, MeReal r) {
    setNonNegative(p, FIELD(p, spinningFriction), r, __func__, "the spinning friction");
}

PARAMS_GETTER(MeReal, MdtContactParamsGetSpinningFriction, spinningFriction, 0)

/* ---- restitution, softness, adhesion ---- */

void MEAPI MdtContactParamsSetRestitution(const MdtContactParamsID p, MeReal r) {
    if (!isParams(p, __func__))
        return;
    if (!(r >= 0 && r <= 1)) {
        MeWarning(1, "MdtContactParamsSetRestitution: %g is not between 0 and 1; nothing is changed", (double)r);
        return;
    }
    p->restitution = r;
    setOption(p, MdtBclContactOptionBounce, r > 0);
}

PARAMS_GETTER(MeReal, MdtContactParamsGetRestitution, restitution, 0)

void MEAPI MdtContactParamsSetRestitutionThreshold(const MdtContactParamsID p, MeReal v) {
    setNonNegative(p, FIELD(p, velThreshold), v, __func__, "the threshold");
}

PARAMS_GETTER(MeReal, MdtContactParamsGetRestitutionThreshold, velThreshold, 0)

void MEAPI MdtContactParamsSetSoftness(const MdtContactParamsID p, MeReal s) {
    if (setNonNegative(p, FIELD(p, softness), s, __func__, "the softness"))
        setOption(p, MdtBclContactOptionSoft, s > 0);
}

PARAMS_GETTER(MeReal, MdtContactParamsGetSoftness, softness, 0)

void MEAPI MdtContactParamsSetMaxAdhesiveForce(const MdtContactParamsID p, MeReal s) {
    if (setNonNegative(p, FIELD(p, max_adhesive_force), s, __func__, "the adhesive force"))
        setOption(p, MdtBclContactOptionAdhesive, s > 0);
}

PARAMS_GETTER(MeReal, MdtContactParamsGetMaxAdhesiveForce, max_adhesive_force, 0)
