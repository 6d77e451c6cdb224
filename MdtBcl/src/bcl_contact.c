/* Contact: a point where two bodies touch (Dynamics guide ch. 3, "MdtContact").
 *
 * n is the normal, the way the first body is pushed; t1 the primary direction, t2 = n x t1 the secondary. With r_k
 * from body k's centre to the contact, the row along d has J_0 = [d, r_0 x d], J_1 = -[d, r_1 x d]: its rate is the
 * velocity of body 0 against body 1 along d.
 *
 *   normal:   φ = -penetration.   J v⁺ >= γ penetration / h where the bodies overlap, >= -gap / h where they do not,
 *             and >= -e J v when they meet faster than velThreshold and than one step's own acceleration explains.
 *             λ >= -max_adhesive_force.   E = ε + softness.
 *   friction: J v⁺ = slide - slip λ, |λ| <= friction (box) or μ λ_n (normal force).   E = slip / h, without ε: on a row
 *             without a position that would be viscosity, and what friction holds would creep by h ε λ a second.
 *             Cone, in both directions: λ_1² + λ_2² <= (μ λ_n)², with the primary coefficient.
 *             Only where the bodies touch, or will within the step.
 */
#include "bcl_i.h"
#include <float.h>
#include <string.h>

enum { PRIMARY = 1, SECONDARY = 2 };

/* Collision sees the bodies' transforms as programs do, in MeReal: half a unit of the last digit. */
#ifdef _ME_API_DOUBLE
static const double poseRounding = 1.2e-16;
#else
static const double poseRounding = 6e-8;
#endif

void MEAPI MdtBclContactParamsReset(MdtBclContactParams *params) {
    memset(params, 0, sizeof *params);
    params->type = MdtContactTypeFrictionZero;
    params->model1 = params->model2 = MdtFrictionModelBox;
    params->velThreshold = (MeReal)0.001;
    params->friction1 = params->friction2 = MEINFINITY;
}

static MeBool isRound(const MdtBclContact *contact, int k) {
    return contact->radius[k] > 0 || contact->circle[k] > 0;
}

static void contactJacobian(const double arm[2][3], const double d[3], MdtKeaJBlock J[2]) {
    for (int k = 0; k < 2; k++) {
        keaScale(J[k].lin, k == 0 ? 1 : -1, d);
        keaCross(J[k].ang, arm[k], J[k].lin);
    }
}

static void contactRow(const MdtBclContact *contact, const MdtBclContext *x, const double d[3], MdtKeaRow *row) {
    bcl_startRow(row, x);
    contactJacobian((const double(*)[3])contact->arm, d, row->J);
    row->contact = x->firstRow;
    row->moves = contact->moves;
}

/* m: the depth at which the last step's force holds the contact still, h² E λ / γ. */
static double depthUnderLoad(const MdtBclContact *contact, const MdtBclContext *x) {
    const MdtBclSolverParameters *p = &x->parameters;
    const MeBool isSoft = (contact->params->options & MdtBclContactOptionSoft) != 0;
    const double own = isSoft ? fmax((double)contact->params->softness, 0) : 0;
    const double E = p->epsilon + p->softening * own;
    return p->gamma > 0 ? p->stepsize * p->stepsize * E * fmax(contact->normalForce, 0) / p->gamma : 0;
}

/* The depth, or gap, is known but for the rounding of the transforms that it was found from, as far as that moves the
 * surfaces along the normal: the noise of each step would else move what rests, and the last answer would not hold. Of
 * the depths that it may be, the one nearest to rest is taken: 0, or what the load has sunk by, if that is less than
 * the rounding. With 0 it would go on sinking, by h E λ a second, until the rounding is passed. */
static double beyondRounding(const MdtBclContact *contact, const MdtBclContext *x) {
    const double *n = contact->normal, depth = contact->penetration;
    double extent = 0;
    for (int k = 0; k < 2; k++) {
        const double *place = x->pose[k]->pos;
        double arm[3], across[3];
        if (x->body[k] == MdtBclNO_BODY)
            continue;
        keaSubtract(arm, contact->position, place);
        keaCross(across, arm, n);
        extent += keaLength(across);
        for (int i = 0; i < 3; i++)
            extent += fabs(n[i] * place[i]);
    }
    const double rounding = poseRounding * extent, sunk = depthUnderLoad(contact, x);
    return fmin(fmax(sunk <= rounding ? sunk : 0, depth - rounding), depth + rounding);
}

/* From what moves with the body to the surface point, with the outward normal o: of a sphere r o; of a circle about
 * the axis a the way to its point farthest along o, r (o - a (a·o)) / |..|, none where it lies flat; of corners, edges
 * and faces, which move with the body themselves, 0. */
static void outOfCentre(const MdtBclContact *contact, int k, const double axis[3], double out[3]) {
    keaScale(out, k == 0 ? -1 : 1, contact->normal);
    if (contact->circle[k] > 0) {
        keaAddScaled(out, -keaDot(out, axis) / keaDot(axis, axis), axis);
        keaScale(out, contact->circle[k] / fmax(keaLength(out), DBL_MIN), out);
    } else {
        keaScale(out, contact->radius[k], out);
    }
}

/* The circle that touches, if the part of the step cannot bring its axis to the normal: there it would lie flat, no
 * point of it would be farthest out, and the one that is, near that, would go far round it. */
static double circleOf(const MdtBclContact *contact, const MdtBclContext *x, int k) {
    double aside[3], turn[3];
    keaCross(aside, contact->axis[k], contact->normal);
    keaCross(turn, contact->axis[k], x->velocity[k]->ang);
    return keaLength(aside) > x->parameters.stepsize * keaLength(turn) ? contact->rim[k] : 0;
}

/* At the start of a step the contact is as its maker set it: the surface points lie half the depth on either side. What
 * moves with a body is the point, or, of a round surface, the centre of its sphere or circle. */
static void anchorContact(MdtBclContact *contact, const MdtBclContext *x) {
    keaCopy(contact->point, contact->position);
    contact->depth = beyondRounding(contact, x);
    MEASSERT(bcl_isUnit(contact->normal) && isfinite(contact->depth));
    for (int k = 0; k < 2; k++) {
        double arm[3], out[3];
        contact->circle[k] = contact->rim[k] > 0 ? circleOf(contact, x, k) : 0;
        outOfCentre(contact, k, contact->axis[k], out);
        keaSubtract(arm, contact->point, x->pose[k]->pos);
        keaAddScaled(arm, (k == 0 ? -1 : 1) * 0.5 * contact->depth, contact->normal);
        keaAddScaled(arm, -1, out);
        keaApplyTransposed(contact->anchor[k], x->pose[k]->R, arm);
        if (contact->circle[k] > 0)
            keaApplyTransposed(contact->axle[k], x->pose[k]->R, contact->axis[k]);
    }
}

/* Whose point it is where the bodies slide past each other: that of a round surface rather than another, of a body
 * rather than the world's. */
enum { BOTH = 2 };
static int ownerOf(const MdtBclContact *contact, const MdtBclContext *x) {
    if (isRound(contact, 0) != isRound(contact, 1))
        return isRound(contact, 0) ? 0 : 1;
    return x->body[1] == MdtBclNO_BODY ? 0 : x->body[0] == MdtBclNO_BODY ? 1 : BOTH;
}

/* Of its circle; 0: there is none. */
static void axisOf(const MdtBclContact *contact, const MdtBclContext *x, int k, double axis[3]) {
    if (contact->circle[k] > 0)
        keaApply(axis, x->pose[k]->R, contact->axle[k]);
    else
        keaZero(axis);
}

/* Within a divided step the surface points move with their bodies: depth = n·(p_1 - p_0). */
static void carryContact(MdtBclContact *contact, const MdtBclContext *x) {
    const int owner = ownerOf(contact, x);
    double p[2][3], between[3];
    for (int k = 0; k < 2; k++) {
        double axis[3], out[3];
        axisOf(contact, x, k, axis);
        outOfCentre(contact, k, axis, out);
        keaApply(p[k], x->pose[k]->R, contact->anchor[k]);
        keaAddScaled(p[k], 1, x->pose[k]->pos);
        keaAddScaled(p[k], 1, out);
    }
    keaSubtract(between, p[1], p[0]);
    contact->depth = keaDot(contact->normal, between);
    for (int i = 0; i < 3; i++) {
        const double off = 0.5 * contact->depth * contact->normal[i];
        const double on[2] = {p[0][i] + off, p[1][i] - off};
        contact->point[i] = owner == BOTH ? 0.5 * (on[0] + on[1]) : on[owner];
    }
}

/* ---- how the place moves within a part of the step ----
 *
 * As with the velocities that the bodies have at its start: by (h v, h w), known before the rows are solved, so that
 * they are the same in all passes. What loads and impulses of this step change is of the next order. `share` is the
 * part of the way: 1 to the end, 1/2 for the mean of start and end. */

/* cay(φ) r - r = (φ x r + φ x (φ x r) / 2) / (1 + φ²/4), as bodies turn. */
static void turnBy(const double turn[3], double share, double r[3]) {
    const double part = share / (1 + 0.25 * keaDot(turn, turn));
    double once[3], twice[3];
    keaCross(once, turn, r);
    keaCross(twice, turn, once);
    keaAddScaled(r, part, once);
    keaAddScaled(r, 0.5 * part, twice);
}

/* A fixed model stays where it is, even where its surface moves. */
static void movedBy(const MdtBclContext *x, int k, double way[3], double turn[3]) {
    const double h = x->body[k] == MdtBclNO_BODY ? 0 : x->parameters.stepsize;
    keaScale(way, h, x->velocity[k]->lin);
    keaScale(turn, h, x->velocity[k]->ang);
}

/* The point that a round surface touches with. */
static void roundPoint(const MdtBclContact *contact, const MdtBclContext *x, int k, double share, double p[3]) {
    double way[3], turn[3], axis[3], out[3];
    movedBy(x, k, way, turn);
    axisOf(contact, x, k, axis);
    turnBy(turn, share, axis);
    outOfCentre(contact, k, axis, out);
    keaApply(p, x->pose[k]->R, contact->anchor[k]);
    turnBy(turn, share, p);
    keaAddScaled(p, 1, out);
    keaAddScaled(p, (k == 0 ? 0.5 : -0.5) * contact->depth, contact->normal);
    keaAddScaled(p, 1, x->pose[k]->pos);
    keaAddScaled(p, share, way);
}

/* A flat surface touches where the round one does; of two round ones each has its own point. */
static void rollArms(const MdtBclContact *contact, const MdtBclContext *x, double share, double arm[2][3]) {
    for (int k = 0; k < 2; k++) {
        double p[3], way[3], turn[3];
        roundPoint(contact, x, isRound(contact, k) ? k : 1 - k, share, p);
        movedBy(x, k, way, turn);
        keaSubtract(arm[k], p, x->pose[k]->pos);
        keaAddScaled(arm[k], -share, way);
    }
}

/* Does the arm of this side stay as it is: of a world that does not turn, of a ball about its own centre? Collision
 * gives normals and radii in MeReal, and so this centre to some 1e-7 of the radius. */
static MeBool isStill(const MdtBclContact *contact, const MdtBclContext *x, int k) {
    const double centred = 1e-6;
    if (x->body[k] == MdtBclNO_BODY && keaDot(x->velocity[k]->ang, x->velocity[k]->ang) == 0)
        return METRUE;
    return contact->radius[k] > 0 && !(contact->circle[k] > 0) &&
           keaLength(contact->anchor[k]) <= centred * contact->radius[k];
}

/* From what a side turns about to the contact: the body's centre, or, where the world moves with v at the origin and
 * turns with w, the axis through w x v / w². */
static void fromAxis(const MdtBclContact *contact, const MdtBclContext *x, int k, double r[3]) {
    const MdtKeaVelocity *v = x->velocity[k];
    const double w2 = keaDot(v->ang, v->ang);
    keaCopy(r, contact->arm[k]);
    if (x->body[k] == MdtBclNO_BODY && w2 > 0) {
        double place[3];
        keaCross(place, v->ang, v->lin);
        keaAddScaled(r, -1 / w2, place);
    }
}

/* What of flat surfaces turns is not known: a corner turns with its body, an edge that another one slides along does
 * not. What holds for all is that a contact turns by what both sides turn, taken to be the turn of the side that moves
 * it less. False: that is at most sqrt(2 DBL_EPSILON), the square of which, over 2, is lost in rounding. */
static MeBool findSharedTurn(MdtBclContact *contact, const MdtBclContext *x) {
    const double h = x->parameters.stepsize, least = 2.1e-8; /* rad */
    double way2[2] = {0, 0}, size2 = 0;
    for (int side = 0; side < 2; side++)
        if (h * keaLength(x->velocity[side]->ang) <= least)
            return MEFALSE;
    for (int k = 0; k < 2; k++) {
        double r[3], speed[3];
        fromAxis(contact, x, k, r);
        size2 += keaDot(r, r);
        for (int side = 0; side < 2; side++) {
            keaCross(speed, x->velocity[side]->ang, r);
            way2[side] += h * h * keaDot(speed, speed);
        }
    }
    const int less = way2[1] <= way2[0];
    keaScale(contact->turn, h, x->velocity[less]->ang);
    return way2[less] > least * least * size2;
}

static void turnArms(const MdtBclContact *contact, const MdtBclContext *x, double share, double arm[2][3]) {
    for (int k = 0; k < 2; k++) {
        double r[3], turned[3];
        fromAxis(contact, x, k, r);
        keaCopy(turned, r);
        turnBy(contact->turn, share, turned);
        keaSubtract(r, turned, r);
        keaCopy(arm[k], contact->arm[k]);
        keaAddScaled(arm[k], 1, r);
    }
}

static MeBool rolls(const MdtBclContact *contact) {
    return isRound(contact, 0) || isRound(contact, 1);
}

static void beginArms(MdtBclContact *contact, const MdtBclContext *x) {
    keaZero(contact->turn);
    for (int k = 0; k < 2; k++)
        keaSubtract(contact->arm[k], contact->point, x->pose[k]->pos);
    contact->moves = rolls(contact) ? !isStill(contact, x, 0) || !isStill(contact, x, 1) : findSharedTurn(contact, x);
}

/* ---- rows ---- */

static MeBool frictionActs(const MdtBclContactParams *p, int direction) {
    const MdtFrictionModel model = direction == 0 ? p->model1 : p->model2;
    const MeReal bound = direction == 0 ? p->friction1 : p->friction2;
    const MeReal coefficient = direction == 0 ? p->FrictionCoefficient : p->FrictionCoefficient2;
    return model == MdtFrictionModelBox ? bound > 0 : coefficient > 0;
}

/* m/s: the fastest that the bodies may come together in this step, negative where they do. What is predicted knows only
 * loads; other contacts may hold either body, so that its velocity stays: of two that stand on each other, the lower
 * one does not fall. */
static double fastestApproach(const MdtKeaRow *normal, const MdtBclContext *x) {
    double sum = 0;
    for (int k = 0; k < 2; k++) {
        const MdtKeaVelocity *const may[2] = {x->predicted[k], x->velocity[k]};
        double rate[2];
        for (int i = 0; i < 2; i++)
            rate[i] = keaDot(normal->J[k].lin, may[i]->lin) + keaDot(normal->J[k].ang, may[i]->ang);
        sum += fmin(rate[0], rate[1]);
    }
    return sum;
}

int MEAPI MdtBclContactPrepare(MdtBclContact *contact, const MdtBclContext *x) {
    MdtKeaRow normal;
    if (x->elapsed > 0)
        carryContact(contact, x);
    else
        anchorContact(contact, x);
    beginArms(contact, x);
    contactRow(contact, x, contact->normal, &normal);
    const MeBool touches = contact->depth >= 0 || x->parameters.stepsize * fastestApproach(&normal, x) < contact->depth;
    contact->rows = 0;
    if (touches && contact->params->type >= MdtContactTypeFriction1D && frictionActs(contact->params, 0))
        contact->rows |= PRIMARY;
    if (touches && contact->params->type >= MdtContactTypeFriction2D && frictionActs(contact->params, 1))
        contact->rows |= SECONDARY;
    return 1 + !!(contact->rows & PRIMARY) + !!(contact->rows & SECONDARY);
}

static void normalRow(const MdtBclContact *contact, const MdtBclContext *x, MdtKeaRow *row) {
    const MdtBclContactParams *p = contact->params;
    const double h = x->parameters.stepsize, depth = contact->depth;
    contactRow(contact, x, contact->normal, row);
    const double rate = bcl_rate(row, x->velocity), predicted = bcl_rate(row, x->predicted);
    row->error = -depth;
    for (int k = 0; k < 2; k++)
        row->radius[k] = contact->radius[k];
    row->target = depth > 0 ? x->parameters.gamma * depth / h : depth / h;
    if (p->options & MdtBclContactOptionBounce) {
        row->restitution = fmin((double)p->restitution, 1);
        row->threshold = p->velThreshold;
    }
    const MeBool isHit = h * predicted < depth && rate < -fmax((double)p->velThreshold, bcl_ownChange(row, x));
    if ((p->options & MdtBclContactOptionBounce) && isHit && p->restitution > 0) {
        row->bounces = METRUE;
        row->rebound = fmin((double)p->restitution, 1) * bcl_speedOfArrival(row, x, -depth);
    }
    if (p->options & MdtBclContactOptionSoft)
        row->softness += x->parameters.softening * fmax((double)p->softness, 0);
    row->lower = p->options & MdtBclContactOptionAdhesive ? -bcl_boundOf(p->max_adhesive_force) : 0;
    MEASSERT(row->lower <= 0 && row->softness >= 0);
    row->force = contact->normalForce;
}

static void frictionDirection(const MdtBclContact *contact, int direction, double d[3]) {
    if (direction == 0)
        keaCopy(d, contact->direction);
    else
        keaCross(d, contact->normal, contact->direction);
    MEASSERT(bcl_isUnit(d));
}

static void frictionRow(const MdtBclContact *contact, const MdtBclContext *x, int direction, MdtKeaRow *row) {
    const MdtBclContactParams *p = contact->params;
    const MeBool slips = p->options & (direction == 0 ? MdtBclContactOptionSlip1 : MdtBclContactOptionSlip2);
    const MeBool slides = p->options & (direction == 0 ? MdtBclContactOptionSlide1 : MdtBclContactOptionSlide2);
    const double slip =
        slips ? fmax((double)(direction == 0 ? p->slip1 : p->slip2), 0) : 0; /* 0 for what is no number */
    double d[3];
    frictionDirection(contact, direction, d);
    contactRow(contact, x, d, row);
    row->target = slides ? (double)(direction == 0 ? p->slide1 : p->slide2) : 0;
    row->softness = slip / x->parameters.stepsize;
    if ((direction == 0 ? p->model1 : p->model2) != MdtFrictionModelBox) {
        row->normal = x->firstRow;
        row->friction = direction == 0 ? p->FrictionCoefficient : p->FrictionCoefficient2;
    } else {
        row->upper = bcl_boundOf(direction == 0 ? p->friction1 : p->friction2);
        row->lower = -row->upper;
    }
}

static MeBool isCone(const MdtBclContact *contact) {
    return contact->rows == (PRIMARY | SECONDARY) && contact->params->model1 == MdtFrictionModelCone &&
           contact->params->model2 == MdtFrictionModelCone;
}

void MEAPI MdtBclContactFill(const MdtBclContact *contact, const MdtBclContext *x, MdtKeaRow rows[]) {
    normalRow(contact, x, rows++);
    if (contact->rows & PRIMARY)
        frictionRow(contact, x, 0, rows++);
    if (contact->rows & SECONDARY)
        frictionRow(contact, x, 1, rows);
    if (isCone(contact)) {
        rows[-1].partner = x->firstRow + 2;
        rows[0].partner = x->firstRow + 1;
    }
}

void MEAPI MdtBclContactMove(const MdtBclContact *contact, const MdtBclContext *x, double share, MdtKeaJBlockPair J[]) {
    double arm[2][3], d[3];
    MEASSERT(contact->moves);
    if (rolls(contact))
        rollArms(contact, x, share, arm);
    else
        turnArms(contact, x, share, arm);
    contactJacobian((const double(*)[3])arm, contact->normal, *J++);
    for (int direction = 0; direction < 2; direction++) {
        if (!(contact->rows & (direction == 0 ? PRIMARY : SECONDARY)))
            continue;
        frictionDirection(contact, direction, d);
        contactJacobian((const double(*)[3])arm, d, *J++);
    }
}

/* ---- for a solver that takes manifolds ---- */

static double frictionBound(const MdtBclContactParams *params, int direction) {
    const MeReal bound = direction == 0 ? params->friction1 : params->friction2;
    const MdtFrictionModel model = direction == 0 ? params->model1 : params->model2;
    return model == MdtFrictionModelBox ? bcl_boundOf(bound) : 0;
}

static double frictionCoefficient(const MdtBclContactParams *params, int direction) {
    const MeReal coefficient = direction == 0 ? params->FrictionCoefficient : params->FrictionCoefficient2;
    const MdtFrictionModel model = direction == 0 ? params->model1 : params->model2;
    return model == MdtFrictionModelBox ? 0 : fmax((double)coefficient, 0);
}

void MEAPI MdtBclContactSurface(const MdtBclContactParams *params, const MdtBclSolverParameters *solver,
                                MdtKeaSurface *s) {
    const int options = params->options;
    const int directions = params->type == MdtContactTypeFriction2D ? 2 : params->type == MdtContactTypeFriction1D;
    const double slip[2] = {(double)params->slip1, (double)params->slip2};
    const double slide[2] = {(double)params->slide1, (double)params->slide2};
    memset(s, 0, sizeof *s);
    for (int i = 0; i < directions; i++) {
        s->coefficient[i] = frictionCoefficient(params, i);
        s->bound[i] = frictionBound(params, i);
        s->slip[i] = options & (i == 0 ? MdtBclContactOptionSlip1 : MdtBclContactOptionSlip2) ? fmax(slip[i], 0) : 0;
        s->slide[i] = options & (i == 0 ? MdtBclContactOptionSlide1 : MdtBclContactOptionSlide2) ? slide[i] : 0;
    }
    s->softness = solver->epsilon;
    if (options & MdtBclContactOptionSoft)
        s->softness += solver->softening * fmax((double)params->softness, 0);
    s->adhesion = options & MdtBclContactOptionAdhesive ? bcl_boundOf(params->max_adhesive_force) : 0;
    s->isOneWay = directions < 2 || (s->coefficient[1] == 0 && s->bound[1] == 0);
    s->isCone = directions == 2 && params->model1 == MdtFrictionModelCone && params->model2 == MdtFrictionModelCone;
}

const MdtBclType bcl_contact = {.name = "Contact", .maxRows = MdtBclGETMAXROWSCONTACT};
const MdtBclType bcl_contactGroup = {.name = "ContactGroup"};
