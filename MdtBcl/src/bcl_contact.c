/* Contact: converts contact parameters (Dynamics guide ch. 3, "MdtContactParams") to Kea's MdtKeaSurface. Kea makes the
 * rows of contacts (kea_contact.c). */
#include "bcl_i.h"
#include <string.h>

void MEAPI MdtBclContactParamsReset(MdtBclContactParams *params) {
    if (!params) {
        MeWarning(1, "MdtBclContactParamsReset: the parameters are null");
        return;
    }
    memset(params, 0, sizeof *params);
    params->type = MdtContactTypeFrictionZero;
    params->model1 = params->model2 = MdtFrictionModelBox;
    params->velThreshold = (MeReal)0.001;
    params->friction1 = params->friction2 = MEINFINITY;
}

/* N: the constant bound of friction along a direction; 0 if it has a coefficient. */
static double frictionBound(const MdtBclContactParams *params, int direction) {
    const MeReal bound = direction == 0 ? params->friction1 : params->friction2;
    const MdtFrictionModel model = direction == 0 ? params->model1 : params->model2;
    return model == MdtFrictionModelBox ? bcl_boundOf(bound) : 0;
}

/* The coefficient of friction along a direction; 0 if it has a constant bound. */
static double frictionCoefficient(const MdtBclContactParams *params, int direction) {
    const MeReal coefficient = direction == 0 ? params->FrictionCoefficient : params->FrictionCoefficient2;
    const MdtFrictionModel model = direction == 0 ? params->model1 : params->model2;
    return model == MdtFrictionModelBox ? 0 : fmax((double)coefficient, 0);
}

static MeBool isCone(const MdtBclContactParams *params) {
    return params->model1 == MdtFrictionModelCone && params->model2 == MdtFrictionModelCone;
}

static void setFriction(const MdtBclContactParams *params, int directions, MdtKeaSurface *s) {
    const double slip[2] = {(double)params->slip1, (double)params->slip2};
    const double slide[2] = {(double)params->slide1, (double)params->slide2};
    const int slips[2] = {MdtBclContactOptionSlip1, MdtBclContactOptionSlip2};
    const int slides[2] = {MdtBclContactOptionSlide1, MdtBclContactOptionSlide2};
    for (int i = 0; i < directions; i++) {
        s->coefficient[i] = frictionCoefficient(params, i);
        s->bound[i] = frictionBound(params, i);
        s->slip[i] = params->options & slips[i] ? fmax(slip[i], 0) : 0; /* 0 for NaN */
        s->slide[i] = params->options & slides[i] ? slide[i] : 0;
    }
    s->isCone = directions == 2 && isCone(params);
    if (s->isCone)
        s->coefficient[1] = s->coefficient[0], s->bound[1] = s->bound[0];
    MEASSERT(s->coefficient[0] >= 0 && s->coefficient[1] >= 0 && s->bound[0] >= 0 && s->bound[1] >= 0);
    s->isOneWay = directions < 2 || (s->coefficient[1] == 0 && s->bound[1] == 0);
}

void MEAPI MdtBclContactSurface(const MdtBclContactParams *params, MdtKeaSurface *s) {
    const int options = params->options;
    const MdtContactType type = params->type;
    memset(s, 0, sizeof *s);
    setFriction(params, type >= MdtContactTypeFriction2D ? 2 : type >= MdtContactTypeFriction1D, s);
    if (options & MdtBclContactOptionSoft)
        s->softness = fmax((double)params->softness, 0);
    s->rolling = bcl_boundOf(params->rollingFriction);
    s->spinning = bcl_boundOf(params->spinningFriction);
    if (options & MdtBclContactOptionAdhesive)
        s->adhesion = bcl_boundOf(params->max_adhesive_force);
    if ((options & MdtBclContactOptionBounce) && params->restitution > 0) {
        s->restitution = fmin((double)params->restitution, 1);
        s->threshold = params->velThreshold;
    }
    MEASSERT(s->softness >= 0 && s->adhesion >= 0 && s->restitution >= 0 && s->restitution <= 1);
}

const MdtBclType bcl_contact = {.name = "Contact", .maxRows = MdtBclGETMAXROWSCONTACT};
const MdtBclType bcl_contactGroup = {.name = "ContactGroup"};
