/* See random_judge.h. */
#include "random_judge.h"

const char *const random_faultName[FAULTS] = {"not finite", "energy", "motor", "spike", "gap", "sunk", "capped"};

typedef struct {
    double low, high, kinetic;
} Energy;

/* ---- what the library says ---- */

static int stopped;

static void onWarning(const int level, const char *const format, va_list ap) {
    char text[512];
    (void)level;
    vsnprintf(text, sizeof text, format, ap);
    stopped += strstr(text, "finite") != NULL;
}

/* ---- verdicts ---- */

static void blame(RandomJudge *j, RandomFaultKind kind, double amount, int joint) {
    RandomFault *f = &j->verdict.fault[kind];
    if (!f->is)
        f->step = j->step;
    if (!f->is || amount > f->amount) {
        f->amount = amount;
        f->joint = joint;
    }
    f->is = METRUE;
}

/* ---- finite ---- */

static MeBool isFiniteBody(const RandomBody *b) {
    double v[3], w[3];
    const MeReal *tm = &MdtBodyGetTransformPtr(b->id)[0][0];
    for (int k = 0; k < 16; k++)
        if (!isfinite(tm[k]))
            return MEFALSE;
    measure_velocity(b->id, v);
    measure_rate(b->id, w);
    return isfinite(keaDot(v, v) + keaDot(w, w));
}

static MeBool isFiniteScene(const RandomJudge *j) {
    for (int i = 0; i < j->scene.bodies; i++)
        if (!isFiniteBody(&j->scene.body[i]))
            return MEFALSE;
    return METRUE;
}

/* ---- gaps ---- */

static double tieGap(const RandomJoint *j, const RandomTie *tie) {
    MdtBodyID a = j->body[0] ? j->body[0]->id : NULL, b = j->body[1] ? j->body[1]->id : NULL;
    double p[2][3], d[3], axis[3];
    if (tie->kind == TIE_DIRECTION || tie->kind == TIE_RIGHT_ANGLE) {
        measure_turnOut(a, tie->at[0], p[0]);
        measure_turnOut(b, tie->at[1], p[1]);
        keaSubtract(d, p[0], p[1]);
        return j->size * (tie->kind == TIE_DIRECTION ? keaLength(d) : fabs(keaDot(p[0], p[1])));
    }
    measure_pointOut(a, tie->at[0], p[0]);
    measure_pointOut(b, tie->at[1], p[1]);
    keaSubtract(d, p[0], p[1]);
    if (tie->kind == TIE_LINE) {
        measure_turnOut(b, tie->axis, axis);
        keaAddScaled(d, -keaDot(d, axis), axis);
    }
    if (tie->kind == TIE_ROD)
        return fabs(keaLength(d) - tie->length);
    if (tie->kind == TIE_STRING)
        return fmax(0, keaLength(d) - tie->length);
    return keaLength(d);
}

static double gapOf(const RandomJoint *j) {
    double widest = 0;
    for (int i = 0; i < j->ties; i++)
        widest = fmax(widest, tieGap(j, &j->tie[i]));
    return widest;
}

/* φ⁺ = (1 - γ) φ + h² ε λ: the law of a row, for the forces that the joint has had. */
static double stretchOf(const RandomScene *s, const RandomJoint *j, double before) {
    double f[3], t[3];
    read_force(j->id, 0, f);
    read_torque(j->id, 0, t);
    return (1 - s->gamma) * before + s->step * s->step * s->epsilon * (keaLength(f) + j->size * keaLength(t));
}

static void judgeGap(RandomJudge *j, int i, MeBool wasKicked) {
    const RandomJoint *joint = &j->scene.joint[i];
    j->gap[i] = gapOf(joint);
    j->stretch[i] = stretchOf(&j->scene, joint, j->stretch[i]);
    const double size = joint->size, beyond = (j->gap[i] - j->stretch[i]) / size;
    j->verdict.gap = fmax(j->verdict.gap, beyond);
    j->open[i] = beyond > RANDOM_GAP && !wasKicked ? j->open[i] + 1 : 0;
    if (j->open[i] >= RANDOM_PATIENCE)
        blame(j, FAULT_GAP, beyond, i);
}

/* ---- the ground ---- */

static void judgeDepth(RandomJudge *j, int i, MeBool wasKicked) {
    const RandomScene *s = &j->scene;
    const RandomBody *b = &s->body[i];
    double corner[8][3], depth = 0, mass = 0;
    for (int k = random_cornersOf(b, corner) - 1; k >= 0; k--)
        depth = fmax(depth, -corner[k][1]);
    for (int k = 0; k < s->bodies; k++)
        mass += s->body[k].mass;
    depth -= s->epsilon * mass * s->gravity * s->step * s->step / s->gamma;
    j->sunk[i] = depth > RANDOM_DEPTH * b->size && !wasKicked ? j->sunk[i] + 1 : 0;
    if (j->sunk[i] >= RANDOM_PATIENCE)
        blame(j, FAULT_SUNK, depth / b->size, i);
}

/* ---- energy ---- */

static void addBody(const RandomScene *s, RandomBody *b, Energy *e) {
    double v[3], w[3], p[3], local[3], kinetic;
    measure_position(b->id, p);
    measure_velocity(b->id, v);
    measure_rate(b->id, w);
    measure_turnIn(b->id, w, local);
    kinetic = .5 * b->mass * keaDot(v, v);
    for (int i = 0; i < 3; i++)
        kinetic += .5 * b->moment[i] * local[i] * local[i];
    e->kinetic += kinetic;
    kinetic += b->mass * s->gravity * p[1];
    e->low += kinetic;
    e->high += kinetic;
}

static void addSprings(RandomJoint *j, Energy *e) {
    double strain[3], k[3];
    random_strainOf(j, strain, k);
    for (int i = 0; i < 3; i++) {
        e->low += .5 * k[i] * strain[i] * strain[i];
        e->high += .5 * k[i] * strain[i] * strain[i];
    }
}

static void addStretch(const RandomJudge *j, int i, Energy *e) {
    const RandomScene *s = &j->scene;
    const double x = fmin(j->gap[i], j->stretch[i]);
    if (s->epsilon > 0)
        e->high += .5 * s->gamma / (s->epsilon * s->step * s->step) * x * x;
}

static Energy energyOf(RandomJudge *j) {
    RandomScene *s = &j->scene;
    Energy e = {0, 0, 0};
    for (int i = 0; i < s->bodies; i++)
        addBody(s, &s->body[i], &e);
    for (int i = 0; i < s->joints; i++) {
        addSprings(&s->joint[i], &e);
        addStretch(j, i, &e);
    }
    return e;
}

static double motorPower(const RandomJoint *j) {
    MdtHingeID hinge = MdtConstraintDCastHinge(j->id);
    MdtPrismaticID slider = MdtConstraintDCastPrismatic(j->id);
    MdtLimitID limit = hinge ? MdtHingeGetLimit(hinge) : slider ? MdtPrismaticGetLimit(slider) : NULL;
    if (!limit || !MdtLimitIsMotorized(limit))
        return 0;
    return fabs(MdtLimitGetMotorDesiredVelocity(limit)) * (double)MdtLimitGetMotorMaxForce(limit);
}

static double powerOf(const RandomScene *s) {
    double power = 0;
    for (int i = 0; s->hasMotors && i < s->joints; i++)
        power += motorPower(&s->joint[i]);
    return power;
}

static double scaleOf(const RandomScene *s, double kinetic) {
    double scale = kinetic;
    for (int i = 0; i < s->bodies; i++)
        scale += s->body[i].mass * 9.81 * s->body[i].size;
    return scale;
}

static double lastingGrowth(const RandomJudge *j) {
    double min = HUGE_VAL;
    for (int i = 0; i < RANDOM_LASTING; i++)
        min = fmin(min, j->growth[i]);
    return min;
}

static void judgeGrowth(RandomJudge *j, double growth, RandomFaultKind kind) {
    if (growth > RANDOM_SPIKE)
        blame(j, FAULT_SPIKE, growth, -1);
    j->growth[j->calm++ % RANDOM_LASTING] = growth;
    if (j->calm < RANDOM_LASTING)
        return;
    const double lasting = lastingGrowth(j);
    j->verdict.growth = fmax(j->verdict.growth, lasting);
    if (lasting > RANDOM_GROWTH)
        blame(j, kind, lasting, -1);
}

static void judgeEnergy(RandomJudge *j, const Energy *e, MeBool wasKicked) {
    const double power = powerOf(&j->scene);
    if (wasKicked) {
        j->min = e->high;
        j->scale = scaleOf(&j->scene, e->kinetic);
        j->calm = 0;
        return;
    }
    j->min += j->scene.step * power;
    judgeGrowth(j, (e->low - j->min) / j->scale, power > 0 ? FAULT_MOTOR : FAULT_ENERGY);
    j->min = fmin(j->min, e->high);
}

/* ---- a scene ---- */

static int widestJoint(const RandomJudge *j) {
    int widest = 0;
    for (int i = 0; i < j->scene.joints; i++)
        if (j->gap[i] / j->scene.joint[i].size > j->gap[widest] / j->scene.joint[widest].size)
            widest = i;
    return widest;
}

static void logStep(const RandomJudge *j, const Energy *e, MeBool wasKicked) {
    const int i = widestJoint(j);
    const double size = j->scene.joint[i].size;
    fprintf(j->log, "%4d%s energy %.6g to %.6g, kinetic %.6g, growth %.3g; ", j->step, wasKicked ? "*" : " ", e->low,
            e->high, e->kinetic, (e->low - j->min) / j->scale);
    fprintf(j->log, "gap %.3g of the size (joint %d, allowed %.3g); %d contacts\n", j->gap[i] / size, i,
            j->stretch[i] / size, j->scene.contacts);
}

static void judgeScene(RandomJudge *j, MeBool wasKicked) {
    RandomScene *s = &j->scene;
    for (int i = 0; i < s->joints; i++)
        judgeGap(j, i, wasKicked);
    for (int i = 0; s->hasGround && i < s->bodies; i++)
        judgeDepth(j, i, wasKicked);
    const Energy e = energyOf(j);
    judgeEnergy(j, &e, wasKicked);
    if (j->log)
        logStep(j, &e, wasKicked);
}

void random_judgeBegin(RandomJudge *j, unsigned long long seed, FILE *log) {
    memset(j, 0, sizeof *j);
    j->log = log;
    random_sceneMake(&j->scene, seed);
    MdtWorldEnableReport(j->scene.world);
    if (log)
        random_sceneDescribe(&j->scene, log);
}

MeBool random_judgeStep(RandomJudge *j) {
    MdtReport report;
    stopped = 0;
    MeHandler before = MeSetWarningHandler(onWarning);
    const MeBool wasKicked = random_sceneStep(&j->scene, j->step);
    MeSetWarningHandler(before);
    if (MdtWorldGetReport(j->scene.world, &report) && report.fallbacks)
        blame(j, FAULT_CAPPED, report.fallbacks, -1);
    if (stopped || !isFiniteScene(j)) {
        blame(j, FAULT_NOT_FINITE, stopped, -1);
        return MEFALSE;
    }
    judgeScene(j, wasKicked);
    return ++j->step < j->scene.duration;
}

void random_judgeEnd(RandomJudge *j) {
    random_sceneDestroy(&j->scene);
}

MeBool random_judge(RandomJudge *j, unsigned long long seed, FILE *log) {
    MeBool isGood = METRUE;
    random_judgeBegin(j, seed, log);
    while (random_judgeStep(j))
        continue;
    random_judgeEnd(j);
    for (int i = 0; i < FAULTS; i++)
        if (j->verdict.fault[i].is && i != FAULT_CAPPED)
            isGood = MEFALSE;
    return isGood;
}
