/* Locks of differentials: clutches between the driven wheels of an axle, and between axles, which pass torque to what
 * turns slower.
 *
 * Their torques τ are implicit. With F the force of a wheel's tyre along, β the torque of its brake, B the torque that
 * a clutch takes from a wheel over τ, at the end of the step
 *     ω⁺ = ω + h/I (T - β - Σ B τ - R F)
 *     v⁺ = v + Δv + h Σ A (F - F_before)      A: mobility of chassis and ground; Δv: change in the last step
 * F, β and τ fulfil, each within its bounds,
 *     v⁺ - R ω⁺ = -C F,    ω⁺ = 0,    Σ B ω⁺ = 0
 * This is a problem with a symmetric matrix and bounds. The wheels' joints then get the torques T - Σ B τ, and find F
 * with all else that acts on the chassis. The difference of speeds that the prediction has left, clutches take out by
 * impulses after the step: a lock of 1 leaves none.
 *
 * A constraint of the chassis that is not in A makes it less mobile, so that the prediction does too little in a step,
 * and never too much.
 */
#include "vehicle/mst_vehicle_i.h"
#include "MdtBody.h"
#include "MdtWorld.h"

enum { MAX_UNKNOWNS = 3 * MST_VEHICLE_WHEELS };

/* Unknowns with bounds: matrix · value = side. */
typedef struct System {
    int count;
    double matrix[MAX_UNKNOWNS][MAX_UNKNOWNS], side[MAX_UNKNOWNS];
    double low[MAX_UNKNOWNS], high[MAX_UNKNOWNS], value[MAX_UNKNOWNS];
    double pull[MAX_UNKNOWNS][MST_VEHICLE_WHEELS]; /* the torque that an unknown takes from a wheel, over its value */
} System;

/* ---- the problem with bounds ------------------------------------------------------------------------------------- */

typedef enum State { AT_LOW = -1, FREE = 0, AT_HIGH = 1 } State;

/* Solves for the free unknowns, with the others at their bounds. */
static void solveFree(System *s, const State state[]) {
    static const double rounding = 1e-12; /* of a diagonal element: brakes and locks of a wheel off the ground */
    double a[MAX_UNKNOWNS][MAX_UNKNOWNS], x[MAX_UNKNOWNS];
    int index[MAX_UNKNOWNS], n = 0;
    for (int i = 0; i < s->count; i++)
        if (state[i] == FREE)
            index[n++] = i;
    for (int i = 0; i < n; i++) {
        x[i] = s->side[index[i]];
        for (int k = 0; k < s->count; k++)
            x[i] -= state[k] != FREE ? s->matrix[index[i]][k] * s->value[k] : 0;
        for (int k = 0; k < n; k++)
            a[i][k] = s->matrix[index[i]][index[k]] * (i == k ? 1 + rounding : 1);
    }
    for (int i = 0; i < n; i++)
        for (int k = i + 1; k < n; k++) {
            const double factor = a[i][i] > 0 ? a[k][i] / a[i][i] : 0;
            for (int j = i; j < n && factor != 0; j++)
                a[k][j] -= factor * a[i][j];
            x[k] -= factor * x[i];
        }
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++)
            x[i] -= a[i][k] * x[k];
        x[i] = a[i][i] > 0 ? x[i] / a[i][i] : 0; /* 0: brakes stop all its wheels */
    }
    for (int i = 0; i < n; i++)
        s->value[index[i]] = x[i];
}

/* The state that an unknown should have. */
static State nextState(const System *s, int i, State state) {
    double more = s->side[i];
    if (s->low[i] >= s->high[i])
        return AT_LOW;
    if (state == FREE)
        return s->value[i] < s->low[i] ? AT_LOW : s->value[i] > s->high[i] ? AT_HIGH : FREE;
    for (int k = 0; k < s->count; k++)
        more -= s->matrix[i][k] * s->value[k];
    return (state == AT_HIGH) == (more > 0) ? state : FREE;
}

/* Changes all states that are wrong, or only the first of them. Returns their number. */
static int changeStates(System *s, State state[], MeBool isCareful) {
    State next[MAX_UNKNOWNS];
    int changes = 0;
    for (int i = 0; i < s->count; i++) {
        next[i] = isCareful && changes > 0 ? state[i] : nextState(s, i, state[i]);
        changes += next[i] != state[i];
    }
    for (int i = 0; i < s->count; i++) {
        state[i] = next[i];
        if (state[i] != FREE)
            s->value[i] = state[i] == AT_LOW ? s->low[i] : s->high[i];
    }
    return changes;
}

/* Pivots of whole sets of unknowns, then, if these do not end, of one at a time, which do (Murty, Note on a Bard-type
 * scheme for solving the complementarity problem, 1974). */
static void solve(System *s) {
    State state[MAX_UNKNOWNS] = {FREE};
    const int quick = 10, careful = 20 * s->count;
    for (int i = 0; i < quick + careful; i++) {
        solveFree(s, state);
        if (changeStates(s, state, i >= quick) == 0)
            return;
    }
    for (int i = 0; i < s->count; i++)
        s->value[i] = fmin(fmax(s->value[i], s->low[i]), s->high[i]);
}

/* ---- clutches ---------------------------------------------------------------------------------------------------- */

/* A clutch takes its torque from the wheels of one group, and gives it to those of another. */
typedef struct Clutch {
    double pull[MST_VEHICLE_WHEELS];
    double max; /* N m */
} Clutch;

/* The driven wheels of an axle: their part of the engine's torque. */
typedef struct Axle {
    int number;
    double drive;
} Axle;

static MeBool isDriven(const MstWheel *w) {
    return w->params.drive > 0 && w->data;
}

static int findAxles(const MstVehicle *v, Axle axle[]) {
    int count = 0;
    for (int i = 0; i < v->wheelCount; i++) {
        const MstWheel *w = v->wheel[i];
        int k = 0;
        while (k < count && axle[k].number != w->params.axle)
            k++;
        if (!isDriven(w))
            continue;
        if (k == count)
            axle[count++] = (Axle){w->params.axle, 0};
        axle[k].drive += (double)w->params.drive;
    }
    return count;
}

static double maxOf(double lock, double torque) {
    return lock >= 1 ? HUGE_VAL : lock * fabs(torque) / 2;
}

/* N m: of the engine, at the wheels of an axle, or of all. */
static double torqueOf(const MstVehicle *v, const Axle *axle) {
    double sum = 0;
    for (int i = 0; i < v->wheelCount; i++)
        if (isDriven(v->wheel[i]) && (!axle || v->wheel[i]->params.axle == axle->number))
            sum += v->wheel[i]->torque;
    return sum;
}

/* Adds the torque of a clutch on the wheels of an axle, which its differential shares among them. */
static void pullAxle(const MstVehicle *v, const Axle *axle, double sign, Clutch *c) {
    for (int i = 0; i < v->wheelCount; i++)
        if (isDriven(v->wheel[i]) && v->wheel[i]->params.axle == axle->number)
            c->pull[i] = sign * (double)v->wheel[i]->params.drive / axle->drive;
}

/* Each driven wheel of an axle with the next one; each axle with the next one. */
static int findClutches(const MstVehicle *v, Clutch clutch[]) {
    const double axleLock = (double)v->params.axleLock, centreLock = (double)v->params.centreLock;
    Axle axle[MST_VEHICLE_WHEELS];
    const int axles = findAxles(v, axle);
    int count = 0;
    for (int k = 0; k < axles && axleLock > 0; k++)
        for (int i = 0, last = -1; i < v->wheelCount; i++) {
            if (!isDriven(v->wheel[i]) || v->wheel[i]->params.axle != axle[k].number)
                continue;
            if (last >= 0) {
                clutch[count] = (Clutch){.max = maxOf(axleLock, torqueOf(v, &axle[k]))};
                clutch[count].pull[last] = 1;
                clutch[count++].pull[i] = -1;
            }
            last = i;
        }
    for (int k = 1; k < axles && centreLock > 0; k++) {
        clutch[count] = (Clutch){.max = maxOf(centreLock, torqueOf(v, 0))};
        pullAxle(v, &axle[k - 1], 1, &clutch[count]);
        pullAxle(v, &axle[k], -1, &clutch[count++]);
    }
    return count;
}

/* ---- the system -------------------------------------------------------------------------------------------------- */

static int addUnknown(System *s, double low, double high, int wheel, double pull) {
    const int i = s->count++;
    memset(s->pull[i], 0, sizeof s->pull[i]);
    memset(s->matrix[i], 0, sizeof s->matrix[i]);
    for (int k = 0; k < i; k++)
        s->matrix[k][i] = 0;
    if (wheel >= 0)
        s->pull[i][wheel] = pull;
    s->low[i] = low;
    s->high[i] = high;
    s->value[i] = s->side[i] = 0;
    return i;
}

/* used: N m, by clutch, of the step already. */
static void addClutches(System *s, const Clutch clutch[], int count, const double usedOf[]) {
    for (int k = 0; k < count; k++) {
        const double used = usedOf ? usedOf[k] : 0;
        const int i = addUnknown(s, -clutch[k].max - used, clutch[k].max - used, -1, 0);
        memcpy(s->pull[i], clutch[k].pull, sizeof s->pull[i]);
    }
}

/* Adds what unknowns change of the wheels' speeds in a time, and the speeds without them. inverse: 1/I by wheel. */
static void addSpins(System *s, const MstVehicle *v, const double spin[], const double inverse[], double time) {
    for (int w = 0; w < v->wheelCount; w++)
        for (int i = 0; i < s->count; i++) {
            if (s->pull[i][w] == 0)
                continue;
            s->side[i] += s->pull[i][w] * spin[w];
            for (int k = 0; k < s->count; k++)
                s->matrix[i][k] += time * inverse[w] * s->pull[i][w] * s->pull[k][w];
        }
}

/* A tyre's force on the chassis, and against it on the ground. */
typedef struct Tyre {
    int unknown;
    const MstWheel *wheel;
    MdtBodyID ground; /* null: not moved by it */
    double direction[3];
} Tyre;

static Tyre tyreOf(const MstWheel *w, const MdtKeaTransformation *pose, int unknown) {
    Tyre t = {.unknown = unknown, .wheel = w, .ground = w->ground ? mst_freeBodyOf(w->ground) : 0};
    double axle[3];
    keaApply(axle, pose->R, w->axle);
    keaCross(t.direction, axle, w->normal);
    keaScale(t.direction, 1 / fmax(keaLength(t.direction), 1e-9), t.direction);
    return t;
}

/* 1/kg: the velocity that a tyre has by the impulse of another. */
static double mobility(const Tyre *by, const Tyre *at, MdtBodyID chassis) {
    const double own = MdtBodyGetMobility(chassis, by->wheel->point, by->direction, at->wheel->point, at->direction);
    return by->ground && by->ground == at->ground
               ? own + MdtBodyGetMobility(by->ground, by->wheel->point, by->direction, at->wheel->point, at->direction)
               : own;
}

/* Adds the forces of the driven wheels' tyres, and what they change of the velocities of chassis and ground. */
static void addTyres(System *s, const MstVehicle *v, MdtBodyID b, double h) {
    Tyre tyre[MST_VEHICLE_WHEELS];
    MdtKeaTransformation pose;
    int count = 0;
    MdtBodyGetExactPose(b, &pose);
    for (int i = 0; i < v->wheelCount; i++) {
        const MstWheel *w = v->wheel[i];
        if (!isDriven(w) || !w->data->isOnGround || w->model)
            continue;
        const double max = w->data->bound[0];
        tyre[count++] = tyreOf(w, &pose, addUnknown(s, -max, max, i, w->data->radius));
    }
    for (int i = 0; i < count; i++) {
        const MdtBclGroundWheel *d = tyre[i].wheel->data;
        const int at = tyre[i].unknown;
        s->matrix[at][at] += d->slip[0];
        s->side[at] -= d->velocity[0] + d->gain;
        for (int k = 0; k < count; k++) {
            const double by = h * mobility(&tyre[k], &tyre[i], b);
            s->matrix[at][tyre[k].unknown] += by;
            s->side[at] += by * tyre[k].wheel->data->force[0];
        }
    }
}

static void addBrakes(System *s, const MstVehicle *v) {
    for (int i = 0; i < v->wheelCount; i++)
        if (isDriven(v->wheel[i]) && v->wheel[i]->brake > 0)
            addUnknown(s, -v->wheel[i]->brake, v->wheel[i]->brake, i, 1);
}

/* ---- the step ---------------------------------------------------------------------------------------------------- */

static MeBool hasLocks(const MstVehicle *v) {
    return v->params.axleLock > 0 || v->params.centreLock > 0;
}

void mst_vehicleLock(MstVehicle *v, MdtBodyID b, double step) {
    Clutch clutch[MST_VEHICLE_WHEELS];
    System s;
    double spin[MST_VEHICLE_WHEELS] = {0}, inverse[MST_VEHICLE_WHEELS] = {0};
    const double h = step / MdtWorldGetSubSteps(v->universe->world);
    const int count = hasLocks(v) ? findClutches(v, clutch) : 0;
    if (count == 0)
        return;
    s.count = 0;
    memset(v->clutch, 0, sizeof v->clutch);
    addClutches(&s, clutch, count, 0);
    addTyres(&s, v, b, h);
    addBrakes(&s, v);
    for (int i = 0; i < v->wheelCount; i++) {
        const MstWheel *w = v->wheel[i];
        inverse[i] = 1 / w->inertia;
        spin[i] = isDriven(w) ? w->data->spin + h * w->torque * inverse[i] : 0;
    }
    addSpins(&s, v, spin, inverse, h);
    solve(&s);
    for (int k = 0; k < count; k++)
        v->clutch[k] = s.value[k];
    for (int i = 0; i < v->wheelCount; i++)
        for (int k = 0; k < count && isDriven(v->wheel[i]); k++)
            v->wheel[i]->data->drive -= clutch[k].pull[i] * s.value[k];
}

void mst_vehicleEqualize(MstVehicle *v, MdtBodyID b, double step) {
    Clutch clutch[MST_VEHICLE_WHEELS];
    System s;
    double spin[MST_VEHICLE_WHEELS] = {0}, inverse[MST_VEHICLE_WHEELS] = {0};
    for (int i = 0; i < v->wheelCount && hasLocks(v); i++)
        v->wheel[i]->data = mst_wheelData(v->wheel[i], b);
    const int count = hasLocks(v) ? findClutches(v, clutch) : 0;
    if (count == 0)
        return;
    s.count = 0;
    addClutches(&s, clutch, count, v->clutch);
    for (int i = 0; i < v->wheelCount; i++) {
        const MstWheel *w = v->wheel[i];
        inverse[i] = isDriven(w) && w->data->isLocked ? 0 : 1 / w->inertia;
        spin[i] = isDriven(w) ? w->data->spin : 0;
    }
    addSpins(&s, v, spin, inverse, step);
    solve(&s);
    for (int i = 0; i < v->wheelCount; i++)
        for (int k = 0; k < count && isDriven(v->wheel[i]) && !v->wheel[i]->model; k++)
            v->wheel[i]->data->spin -= step * inverse[i] * clutch[k].pull[i] * s.value[k];
}
