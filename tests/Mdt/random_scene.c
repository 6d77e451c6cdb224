/* See random_scene.h. A scene is drawn in this order: its frame, its bodies, its joints, how it is shaken. */
#include "random_scene.h"

static const double pi = 3.14159265358979323846;
static const double weight = 9.81; /* m/s² */

/* ---- drawing ---- */

static double uniform(RandomScene *s, double from, double to) {
    return from + (to - from) * .5 * (random_number(&s->random) + 1);
}

/* Each power of ten as likely as the next. */
static double spread(RandomScene *s, double from, double to) {
    return from * pow(to / from, uniform(s, 0, 1));
}

static int pick(RandomScene *s, int n) {
    return (int)uniform(s, 0, n);
}

static MeBool chance(RandomScene *s, double probability) {
    return uniform(s, 0, 1) < probability;
}

static void direction(RandomScene *s, double d[3]) {
    do {
        random_vector(&s->random, 1, d);
    } while (!(keaLength(d) > .1 && keaLength(d) < 1));
    keaScale(d, 1 / keaLength(d), d);
}

/* At right angles to a. */
static void directionAcross(RandomScene *s, const double a[3], double d[3]) {
    do {
        direction(s, d);
        keaAddScaled(d, -keaDot(a, d), a);
    } while (keaLength(d) < .1);
    keaScale(d, 1 / keaLength(d), d);
}

/* Neighbouring seeds start far from each other (the finalizer of splitmix64). */
static void startRandom(Random *r, unsigned long long seed) {
    unsigned long long z = (seed + 1) * 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    r->state = z ^ (z >> 31);
}

/* ---- bodies ---- */

static void positionOf(const RandomBody *b, double p[3]) {
    measure_position(b ? b->id : NULL, p);
}

static void shape(RandomScene *s, RandomBody *b) {
    MeMatrix3 inertia;
    b->isSphere = chance(s, .3);
    b->edge[0] = uniform(s, .3, 1.5);
    for (int i = 1; i < 3; i++)
        b->edge[i] = b->isSphere ? b->edge[0] : uniform(s, .3, 1.5);
    b->size = (b->edge[0] + b->edge[1] + b->edge[2]) / 3;
    b->mass = spread(s, pow(s->ratio, -.5), pow(s->ratio, .5));
    if (b->isSphere)
        MdtMakeInertiaTensorSphere(b->mass, .5 * b->edge[0], inertia);
    else
        MdtMakeInertiaTensorBox(b->mass, b->edge[0], b->edge[1], b->edge[2], inertia);
    MdtBodySetMass(b->id, b->mass);
    MdtBodySetInertiaTensor(b->id, inertia);
    for (int i = 0; i < 3; i++)
        b->moment[i] = (double)inertia[i][i];
}

static void makeBodies(RandomScene *s) {
    for (int i = 0; i < s->bodies; i++) {
        RandomBody *b = &s->body[i];
        double q[4];
        b->id = MdtBodyCreate(s->world);
        shape(s, b);
        for (int k = 0; k < 4; k++)
            q[k] = random_number(&s->random);
        MdtBodySetQuaternion(b->id, q[0], q[1], q[2], q[3]);
        MdtBodyEnable(b->id);
    }
}

static void placeAt(RandomBody *b, const double p[3]) {
    MdtBodySetPosition(b->id, p[0], p[1], p[2]);
}

/* About as far from its neighbour as they are large. */
static void placeBeside(RandomScene *s, RandomBody *b, const RandomBody *neighbour) {
    double p[3], d[3];
    positionOf(neighbour, p);
    direction(s, d);
    keaAddScaled(p, uniform(s, .4, .7) * (b->size + neighbour->size), d);
    placeAt(b, p);
}

static void placeOnCircle(RandomScene *s) {
    const double radius = .17 * s->bodies + .3;
    for (int i = 0; i < s->bodies; i++) {
        const double angle = 2 * pi * i / s->bodies;
        const double p[3] = {radius * cos(angle), radius * sin(angle), uniform(s, -.3, .3)};
        placeAt(&s->body[i], p);
    }
}

int random_cornersOf(const RandomBody *b, double corner[8][3]) {
    if (b->isSphere) {
        positionOf(b, corner[0]);
        corner[0][1] -= .5 * b->edge[0];
        return 1;
    }
    for (int i = 0; i < 8; i++) {
        const double local[3] = {(i & 1 ? .5 : -.5) * b->edge[0], (i & 2 ? .5 : -.5) * b->edge[1],
                                 (i & 4 ? .5 : -.5) * b->edge[2]};
        measure_pointOut(b->id, local, corner[i]);
    }
    return 8;
}

static double lowestOf(const RandomScene *s) {
    double corner[8][3], lowest = HUGE_VAL;
    for (int i = 0; i < s->bodies; i++)
        for (int k = random_cornersOf(&s->body[i], corner) - 1; k >= 0; k--)
            lowest = fmin(lowest, corner[k][1]);
    return lowest;
}

static void liftAboveGround(RandomScene *s) {
    const double up = uniform(s, .02, 1) - lowestOf(s);
    for (int i = 0; i < s->bodies; i++) {
        double p[3];
        positionOf(&s->body[i], p);
        p[1] += up;
        placeAt(&s->body[i], p);
    }
}

/* ---- parts of joints ---- */

static MdtBodyID idOf(const RandomBody *b) {
    return b ? b->id : NULL;
}

static RandomJoint *attach(RandomScene *s, const char *kind, MdtConstraintID c, RandomBody *a, RandomBody *b) {
    if (s->joints >= RANDOM_JOINTS)
        abort(); /* Check's assertions need a test, and the survey is none */
    RandomJoint *j = &s->joint[s->joints++];
    *j = (RandomJoint){.id = c, .kind = kind, .body = {a, b}};
    j->size = b ? fmin(a->size, b->size) : a->size;
    MdtConstraintSetBodies(c, idOf(a), idOf(b));
    return j;
}

static void setPosition(RandomJoint *j, const double at[3]) {
    MdtConstraintSetPosition(j->id, at[0], at[1], at[2]);
}

static RandomTie *addTie(RandomJoint *j, RandomTieKind kind) {
    RandomTie *tie = &j->tie[j->ties++];
    tie->kind = kind;
    return tie;
}

static void tiePoint(RandomJoint *j, const double at[3]) {
    RandomTie *tie = addTie(j, TIE_POINT);
    for (int k = 0; k < 2; k++)
        measure_pointIn(idOf(j->body[k]), at, tie->at[k]);
}

static void tieDirections(RandomJoint *j, RandomTieKind kind, const double a[3], const double b[3]) {
    RandomTie *tie = addTie(j, kind);
    measure_turnIn(idOf(j->body[0]), a, tie->at[0]);
    measure_turnIn(idOf(j->body[1]), b, tie->at[1]);
}

static void tieLine(RandomJoint *j, const double at[3], const double axis[3]) {
    tiePoint(j, at);
    j->tie[j->ties - 1].kind = TIE_LINE;
    measure_turnIn(idOf(j->body[1]), axis, j->tie[j->ties - 1].axis);
}

/* No turn of one body against the other. */
static void tieTurn(RandomScene *s, RandomJoint *j, const double a[3]) {
    double b[3];
    directionAcross(s, a, b);
    tieDirections(j, TIE_DIRECTION, a, a);
    tieDirections(j, TIE_DIRECTION, b, b);
}

static double reducedMass(const RandomJoint *j) {
    return 1 / (1 / j->body[0]->mass + (j->body[1] ? 1 / j->body[1]->mass : 0));
}

/* A spring and damper for an inertia: from slow ones to those that no explicit rule could bear. */
static void drawSpring(RandomScene *s, double inertia, double *stiffness, double *damping) {
    const double frequency = spread(s, 2, 2 / s->step);
    *stiffness = inertia * frequency * frequency;
    *damping = chance(s, .5) ? 0 : 2 * uniform(s, 0, 1) * inertia * frequency;
}

static void setStop(MdtSingleLimitID stop, double at, double restitution) {
    MdtSingleLimitSetStop(stop, at);
    MdtSingleLimitSetRestitution(stop, restitution);
}

static void softenStop(RandomScene *s, RandomStore *store, MdtSingleLimitID stop, int side, double inertia) {
    double stiffness, damping;
    drawSpring(s, inertia, &stiffness, &damping);
    MdtSingleLimitSetStiffness(stop, stiffness);
    MdtSingleLimitSetDamping(stop, damping);
    store->stop[side] = MdtSingleLimitGetStop(stop);
    store->stiffness[side] = stiffness;
}

/* The joint's coordinate is zero now; so large are the stops, such a one its inertia. */
static void addStops(RandomScene *s, RandomJoint *j, MdtLimitID limit, RandomStoreKind kind, double range,
                     double inertia) {
    const MeBool isSoft = chance(s, .4);
    for (int side = 0; side < 2; side++) {
        MdtSingleLimitID stop = side == 0 ? MdtLimitGetLowerLimit(limit) : MdtLimitGetUpperLimit(limit);
        const double at = range * uniform(s, .1, 1.2);
        setStop(stop, side == 0 ? -at : at, chance(s, .3) ? 0 : uniform(s, 0, 1));
        if (isSoft)
            softenStop(s, &j->store, stop, side, inertia);
    }
    if (isSoft)
        j->store.kind = kind;
    MdtLimitActivateLimits(limit, METRUE);
}

static void addMotor(RandomScene *s, MdtLimitID limit, double force) {
    const double speed = uniform(s, -5, 5);
    MdtLimitSetLimitedForceMotor(limit, speed, (force * spread(s, .1, 100)));
}

static void addLimit(RandomScene *s, RandomJoint *j, MdtLimitID limit, RandomStoreKind kind) {
    const MeBool isAngle = kind == STORE_ANGLE;
    const double arm = isAngle ? .3 * j->size : 1, mass = reducedMass(j);
    if (!s->isBare && chance(s, isAngle ? .5 : .8))
        addStops(s, j, limit, kind, isAngle ? 1 : j->size, mass * arm * arm);
    if (s->hasMotors && chance(s, .6))
        addMotor(s, limit, mass * weight * arm);
}

/* ---- joints ---- */

static void makeBall(RandomScene *s, RandomBody *a, RandomBody *b, const double at[3]) {
    RandomJoint *j = attach(s, "BSJoint", MdtBSJointQuaConstraint(MdtBSJointCreate(s->world)), a, b);
    setPosition(j, at);
    tiePoint(j, at);
}

static void makeHingeAbout(RandomScene *s, RandomBody *a, RandomBody *b, const double at[3], const double axis[3],
                           MeBool isPlain) {
    MdtHingeID hinge = MdtHingeCreate(s->world);
    RandomJoint *j = attach(s, "Hinge", MdtHingeQuaConstraint(hinge), a, b);
    double across[3];
    setPosition(j, at);
    MdtHingeSetAxis(hinge, axis[0], axis[1], axis[2]);
    tiePoint(j, at);
    tieDirections(j, TIE_DIRECTION, axis, axis);
    directionAcross(s, axis, across);
    measure_turnIn(idOf(a), across, j->store.at[0]);
    measure_turnIn(idOf(b), across, j->store.at[1]);
    measure_turnIn(idOf(b), axis, j->store.axis);
    if (!isPlain)
        addLimit(s, j, MdtHingeGetLimit(hinge), STORE_ANGLE);
}

static void makeHinge(RandomScene *s, RandomBody *a, RandomBody *b, const double at[3]) {
    double axis[3];
    direction(s, axis);
    makeHingeAbout(s, a, b, at, axis, MEFALSE);
}

static void makePrismatic(RandomScene *s, RandomBody *a, RandomBody *b, const double at[3]) {
    MdtPrismaticID slider = MdtPrismaticCreate(s->world);
    RandomJoint *j = attach(s, "Prismatic", MdtPrismaticQuaConstraint(slider), a, b);
    double axis[3];
    direction(s, axis);
    MdtPrismaticSetAxis(slider, axis[0], axis[1], axis[2]);
    tieLine(j, at, axis);
    tieTurn(s, j, axis);
    memcpy(j->store.at, j->tie[0].at, sizeof j->store.at);
    keaCopy(j->store.axis, j->tie[0].axis);
    addLimit(s, j, MdtPrismaticGetLimit(slider), STORE_SLIDE);
}

static void makeUniversal(RandomScene *s, RandomBody *a, RandomBody *b, const double at[3]) {
    MdtUniversalID universal = MdtUniversalCreate(s->world);
    RandomJoint *j = attach(s, "Universal", MdtUniversalQuaConstraint(universal), a, b);
    double p[3], o[3];
    direction(s, p);
    directionAcross(s, p, o);
    setPosition(j, at);
    MdtUniversalSetAxes(universal, p[0], p[1], p[2], o[0], o[1], o[2]);
    tiePoint(j, at);
    tieDirections(j, TIE_RIGHT_ANGLE, p, o);
}

static void makeSkeletal(RandomScene *s, RandomBody *a, RandomBody *b, const double at[3]) {
    MdtSkeletalID skeletal = MdtSkeletalCreate(s->world);
    RandomJoint *j = attach(s, "Skeletal", MdtSkeletalQuaConstraint(skeletal), a, b);
    double p[3], o[3];
    direction(s, p);
    directionAcross(s, p, o);
    setPosition(j, at);
    MdtSkeletalSetAxes(skeletal, p[0], p[1], p[2], o[0], o[1], o[2]);
    const double primary = uniform(s, .3, 1.5), secondary = uniform(s, .3, 1.5), twist = uniform(s, .2, 2.5);
    MdtSkeletalSetConePrimaryLimitAngle(skeletal, primary);
    MdtSkeletalSetConeSecondaryLimitAngle(skeletal, secondary);
    MdtSkeletalSetTwistLimitAngle(skeletal, twist);
    if (s->isBare) {
        MdtSkeletalSetConeOption(skeletal, MdtSkeletalConeOptionFree);
        MdtSkeletalSetTwistOption(skeletal, MdtSkeletalTwistOptionFree);
    }
    tiePoint(j, at);
}

/* Orientation held beside a ball: rigidly, but for an axis, or by an angular spring. */
static void makeAngular(RandomScene *s, RandomBody *a, RandomBody *b, const double at[3]) {
    MdtAngular3ID angular = MdtAngular3Create(s->world);
    RandomJoint *j = attach(s, "Angular3", MdtAngular3QuaConstraint(angular), a, b);
    double axis[3];
    direction(s, axis);
    const int form = pick(s, 3);
    if (form == 0) {
        MdtAngular3SetAxis(angular, axis[0], axis[1], axis[2]);
        MdtAngular3EnableRotation(angular, METRUE);
        tieDirections(j, TIE_DIRECTION, axis, axis);
    } else if (form == 1) {
        tieTurn(s, j, axis);
    } else {
        double stiffness, damping;
        drawSpring(s, .1 * reducedMass(j) * j->size * j->size, &stiffness, &damping);
        MdtAngular3SetStiffness(angular, stiffness);
        MdtAngular3SetDamping(angular, damping);
        j->store.kind = STORE_TURN;
        j->store.stiffness[0] = stiffness;
    }
    makeBall(s, a, b, at);
}

static void makeCone(RandomScene *s, RandomBody *a, RandomBody *b, const double at[3]) {
    MdtConeLimitID cone = MdtConeLimitCreate(s->world);
    RandomJoint *j = attach(s, "ConeLimit", MdtConeLimitQuaConstraint(cone), a, b);
    const double half = uniform(s, .3, 2.5);
    double axis[3];
    direction(s, axis);
    MdtConeLimitSetAxis(cone, axis[0], axis[1], axis[2]);
    MdtConeLimitSetConeHalfAngle(cone, half);
    if (chance(s, .5)) {
        double stiffness, damping;
        drawSpring(s, .1 * reducedMass(j) * j->size * j->size, &stiffness, &damping);
        MdtConeLimitSetStiffness(cone, stiffness);
        MdtConeLimitSetDamping(cone, damping);
        j->store.kind = STORE_LEAN;
        j->store.stop[1] = half;
        j->store.stiffness[1] = stiffness;
        measure_turnIn(idOf(a), axis, j->store.at[0]);
        measure_turnIn(idOf(b), axis, j->store.at[1]);
    }
    makeBall(s, a, b, at);
}

static void makeFixed(RandomScene *s, RandomBody *a, RandomBody *b, const double at[3]) {
    MdtFPFOJointID fixed = MdtFPFOJointCreate(s->world);
    RandomJoint *j = attach(s, "FPFOJoint", MdtFPFOJointQuaConstraint(fixed), a, b);
    double axis[3];
    direction(s, axis);
    MdtFPFOJointSetPosition(fixed, at[0], at[1], at[2]);
    tiePoint(j, at);
    tieTurn(s, j, axis);
}

/* A distance from a point of a to one of b, on the far side of `at`. */
static MdtSpringID makeDistance(RandomScene *s, const char *kind, RandomBody *a, RandomBody *b, const double at[3],
                                RandomJoint **j, double *length) {
    MdtSpringID spring = MdtSpringCreate(s->world);
    *j = attach(s, kind, MdtSpringQuaConstraint(spring), a, b);
    RandomTie *ends = &(*j)->tie[0];
    double end[2][3], p[3], d[3];
    positionOf(a, p);
    direction(s, d);
    keaCopy(end[0], p);
    keaAddScaled(end[0], .2 * a->size, d);
    keaCopy(end[1], at);
    keaSubtract(d, at, p);
    keaAddScaled(end[1], uniform(s, .2, .4) * (*j)->size / keaLength(d), d);
    keaSubtract(d, end[0], end[1]);
    *length = keaLength(d);
    for (unsigned int k = 0; k < 2; k++) {
        MdtSpringSetPosition(spring, k, end[k][0], end[k][1], end[k][2]);
        measure_pointIn(idOf((*j)->body[k]), end[k], ends->at[k]);
        keaCopy((*j)->store.at[k], ends->at[k]);
    }
    return spring;
}

static void makeRod(RandomScene *s, RandomBody *a, RandomBody *b, const double at[3]) {
    RandomJoint *j;
    double length;
    MdtSpringID spring = makeDistance(s, "rod", a, b, at, &j, &length);
    MdtSpringSetNaturalLength(spring, length);
    MdtSpringSetStiffness(spring, MEINFINITY);
    addTie(j, TIE_ROD)->length = (double)(MeReal)length;
}

static void makeString(RandomScene *s, RandomBody *a, RandomBody *b, const double at[3]) {
    RandomJoint *j;
    double length;
    MdtSpringID spring = makeDistance(s, "string", a, b, at, &j, &length);
    MdtSingleLimitID slack = MdtLimitGetLowerLimit(MdtSpringGetLimit(spring));
    MdtSingleLimitID taut = MdtLimitGetUpperLimit(MdtSpringGetLimit(spring));
    length *= uniform(s, 1, 1.4);
    MdtSpringSetNaturalLength(spring, length);
    MdtSingleLimitSetStiffness(slack, 0);
    MdtSingleLimitSetDamping(slack, 0);
    MdtSingleLimitSetStiffness(taut, MEINFINITY);
    MdtSingleLimitSetRestitution(taut, (chance(s, .5) ? 0 : uniform(s, 0, 1)));
    addTie(j, TIE_STRING)->length = (double)(MeReal)length;
}

static void makeSpring(RandomScene *s, RandomBody *a, RandomBody *b, const double at[3]) {
    RandomJoint *j;
    double length, stiffness, damping;
    MdtSpringID spring = makeDistance(s, "spring", a, b, at, &j, &length);
    drawSpring(s, reducedMass(j), &stiffness, &damping);
    MdtSpringSetNaturalLength(spring, length);
    MdtSpringSetStiffness(spring, stiffness);
    MdtSpringSetDamping(spring, damping);
    j->store.kind = STORE_DISTANCE;
    j->store.stop[0] = j->store.stop[1] = (double)(MeReal)length;
    j->store.stiffness[0] = j->store.stiffness[1] = stiffness;
}

static void makeElastic(RandomScene *s, RandomBody *a, RandomBody *b, const double at[3]) {
    RandomJoint *j;
    double length, stiffness, damping;
    MdtSpringID spring = makeDistance(s, "elastic", a, b, at, &j, &length);
    MdtSingleLimitID hard = MdtLimitGetLowerLimit(MdtSpringGetLimit(spring));
    drawSpring(s, reducedMass(j), &stiffness, &damping);
    MdtSpringSetNaturalLength(spring, length);
    MdtSpringSetStiffness(spring, stiffness);
    MdtSpringSetDamping(spring, damping);
    MdtSingleLimitSetStiffness(hard, MEINFINITY);
    MdtSingleLimitSetRestitution(hard, uniform(s, 0, 1));
    j->store.kind = STORE_DISTANCE;
    j->store.stop[0] = j->store.stop[1] = (double)(MeReal)length;
    j->store.stiffness[1] = stiffness;
}

typedef void (*Maker)(RandomScene *s, RandomBody *a, RandomBody *b, const double at[3]);

static const Maker makers[] = {makeBall, makeHinge, makePrismatic, makeUniversal, makeSkeletal, makeAngular,
                               makeCone, makeFixed, makeRod,       makeString,    makeSpring,   makeElastic};

enum { MAKERS = sizeof makers / sizeof *makers };

/* ---- topologies ---- */

/* Between the bodies; to the world, above the body. */
static void pointBetween(RandomScene *s, const RandomBody *a, const RandomBody *b, double at[3]) {
    double other[3], off[3];
    positionOf(a, at);
    keaCopy(other, at);
    if (b)
        positionOf(b, other);
    else
        other[1] += a->size;
    keaScale(at, .5, at);
    keaAddScaled(at, .5, other);
    random_vector(&s->random, .15 * a->size, off);
    keaAddScaled(at, 1, off);
}

static void tie(RandomScene *s, Maker oneKind, RandomBody *a, RandomBody *b) {
    double at[3];
    pointBetween(s, a, b, at);
    (s->isOneKind ? oneKind : makers[pick(s, MAKERS)])(s, a, b, at);
}

/* A hinge, and once more what it does already: a second hinge, or a ball on its axis. */
static void tieTwice(RandomScene *s, RandomBody *a, RandomBody *b) {
    double at[3], axis[3];
    pointBetween(s, a, b, at);
    direction(s, axis);
    makeHingeAbout(s, a, b, at, axis, MEFALSE);
    keaAddScaled(at, uniform(s, .2, .6) * a->size, axis);
    if (chance(s, .5))
        makeHingeAbout(s, a, b, at, axis, METRUE);
    else
        makeBall(s, a, b, at);
}

typedef enum { CHAIN, LOOP, TREE, STAR, REDUNDANT, TOPOLOGIES } Topology;

static RandomBody *neighbourOf(RandomScene *s, Topology topology, int i) {
    const int of[TOPOLOGIES] = {i - 1, i - 1, pick(s, i), 0, i - 1};
    return &s->body[of[topology]];
}

static void placeBodies(RandomScene *s, Topology topology) {
    static const double origin[3] = {0, 0, 0};
    placeAt(&s->body[0], origin);
    if (topology == LOOP)
        placeOnCircle(s);
    else
        for (int i = 1; i < s->bodies; i++)
            placeBeside(s, &s->body[i], &s->body[topology == STAR ? 0 : i - 1]);
    if (s->hasGround)
        liftAboveGround(s);
}

static void makeJoints(RandomScene *s, Topology topology, MeBool hangs) {
    const Maker oneKind = makers[pick(s, MAKERS)];
    for (int i = hangs ? 0 : 1; i < s->bodies; i++) {
        RandomBody *neighbour = i == 0 ? NULL : neighbourOf(s, topology, i);
        if (topology == REDUNDANT)
            tieTwice(s, &s->body[i], neighbour);
        else
            tie(s, oneKind, &s->body[i], neighbour);
    }
    if (topology == LOOP)
        tie(s, oneKind, &s->body[0], &s->body[s->bodies - 1]);
    for (int i = 0; i < s->joints; i++)
        MdtConstraintEnable(s->joint[i].id);
}

static void drawTopology(RandomScene *s) {
    static const char *const names[TOPOLOGIES][2] = {{"free chain", "hanging chain"},
                                                     {"free loop", "hanging loop"},
                                                     {"free tree", "hanging tree"},
                                                     {"free star", "hanging star"},
                                                     {"free redundant chain", "hanging redundant chain"}};
    const Topology topology = (Topology)pick(s, TOPOLOGIES);
    const MeBool hangs = chance(s, .6);
    s->topology = names[topology][hangs];
    if (topology == LOOP && s->bodies < 3)
        s->bodies = 3;
    makeBodies(s);
    placeBodies(s, topology);
    makeJoints(s, topology, hangs);
}

/* ---- shaking ---- */

static void setMotion(RandomBody *b, const double v[3], const double w[3]) {
    MdtBodySetLinearVelocity(b->id, v[0], v[1], v[2]);
    MdtBodySetAngularVelocity(b->id, w[0], w[1], w[2]);
}

static void shakeAtFirst(RandomScene *s) {
    for (int i = 0; i < s->bodies; i++) {
        double v[3], w[3];
        random_vector(&s->random, s->shaking, v);
        random_vector(&s->random, s->shaking, w);
        setMotion(&s->body[i], v, w);
    }
}

static void drawKicks(RandomScene *s) {
    s->kicks = 1 + pick(s, RANDOM_KICKS);
    for (int i = 0; i < s->kicks; i++) {
        RandomKick *kick = &s->kick[i];
        kick->step = 1 + pick(s, s->duration - RANDOM_CALM);
        kick->body = &s->body[pick(s, s->bodies)];
        random_vector(&s->random, 2 * s->shaking, kick->velocity);
        random_vector(&s->random, chance(s, .5) ? 2 * s->shaking : 0, kick->rate);
    }
}

static void apply(const RandomKick *kick) {
    double v[3], w[3];
    measure_velocity(kick->body->id, v);
    measure_rate(kick->body->id, w);
    keaAddScaled(v, 1, kick->velocity);
    keaAddScaled(w, 1, kick->rate);
    setMotion(kick->body, v, w);
}

/* ---- the ground ---- */

static void touchAt(RandomScene *s, const RandomBody *b, const double corner[3]) {
    MdtContactID c = MdtContactCreate(s->world, b->id, NULL);
    MdtContactParamsID p = MdtContactGetParams(c);
    MdtContactSetPosition(c, corner[0], .5 * corner[1], corner[2]);
    MdtContactSetNormal(c, 0, 1, 0);
    MdtContactSetPenetration(c, -corner[1]);
    MdtContactParamsSetType(p, MdtContactTypeFriction2D);
    MdtContactParamsSetFrictionModel(p, MdtFrictionModelCone);
    MdtContactParamsSetFrictionCoeffecient(p, s->friction);
    MdtContactParamsSetRestitution(p, s->restitution);
    MdtContactEnable(c);
    s->contact[s->contacts++] = c;
}

/* How far a body's surface may come in the next step, twice over: what is nearer to the ground gets a contact. */
static double reachOf(const RandomScene *s, const RandomBody *b) {
    double v[3], w[3];
    measure_velocity(b->id, v);
    measure_rate(b->id, w);
    return 2 * s->step * (keaLength(v) + b->size * keaLength(w) + s->step * s->gravity);
}

static void touchGround(RandomScene *s) {
    double corner[8][3];
    for (int i = 0; i < s->contacts; i++)
        MdtContactDestroy(s->contact[i]);
    s->contacts = 0;
    for (int i = 0; i < s->bodies; i++)
        for (int k = random_cornersOf(&s->body[i], corner) - 1; k >= 0; k--)
            if (corner[k][1] < reachOf(s, &s->body[i]))
                touchAt(s, &s->body[i], corner[k]);
}

/* ---- the scene ---- */

static void drawFrame(RandomScene *s) {
    s->hasGround = chance(s, 1. / 3);
    s->hasMotors = chance(s, .25);
    s->isOneKind = chance(s, .5);
    s->isBare = chance(s, .3);
    s->bodies = 2 + pick(s, s->hasGround ? 6 : RANDOM_BODIES - 1);
    s->ratio = spread(s, 1, 1e6);
    s->step = spread(s, 1. / 1000, 1. / 30);
    s->gravity = chance(s, .1) ? 0 : weight;
    s->epsilon = chance(s, .5) ? 0 : -1; /* the default */
    s->gamma = .2;
    s->shaking = spread(s, .3, 8);
    s->restitution = uniform(s, 0, .9);
    s->friction = uniform(s, 0, 1);
    s->duration = RANDOM_CALM + 20 + pick(s, 80);
}

static void makeWorld(RandomScene *s) {
    s->world = scene_open(RANDOM_BODIES, RANDOM_JOINTS + RANDOM_CONTACTS, s->gravity);
    MdtWorldSetGamma(s->world, s->gamma);
    if (s->epsilon >= 0)
        MdtWorldSetEpsilon(s->world, s->epsilon);
    s->epsilon = MdtWorldGetEpsilon(s->world);
}

static void rememberEnergies(RandomScene *s) {
    for (int i = 0; i < s->bodies; i++) {
        double p[3];
        positionOf(&s->body[i], p);
        s->body[i].potential = s->body[i].mass * s->gravity * p[1];
    }
    for (int i = 0; i < s->joints; i++) {
        double stiffness[3];
        random_strainOf(&s->joint[i], s->joint[i].store.strain, stiffness);
    }
}

void random_sceneMake(RandomScene *s, unsigned long long seed) {
    memset(s, 0, sizeof *s);
    s->seed = seed;
    startRandom(&s->random, seed);
    drawFrame(s);
    makeWorld(s);
    drawTopology(s);
    shakeAtFirst(s);
    drawKicks(s);
    rememberEnergies(s);
}

void random_sceneDestroy(RandomScene *s) {
    MdtWorldDestroy(s->world);
}

MeBool random_sceneStep(RandomScene *s, int i) {
    MeBool wasKicked = i == 0;
    for (int k = 0; k < s->kicks; k++)
        if (s->kick[k].step == i) {
            apply(&s->kick[k]);
            wasKicked = METRUE;
        }
    if (s->hasGround)
        touchGround(s);
    MdtWorldStep(s->world, s->step);
    return wasKicked;
}

/* ---- strains ---- */

static double angleOf(const RandomJoint *j) {
    const RandomStore *store = &j->store;
    double u[3], v[3], a[3], across[3];
    measure_turnOut(idOf(j->body[0]), store->at[0], u);
    measure_turnOut(idOf(j->body[1]), store->at[1], v);
    measure_turnOut(idOf(j->body[1]), store->axis, a);
    keaCross(across, a, v);
    const double angle = atan2(keaDot(u, across), keaDot(u, v));
    return angle + 2 * pi * nearbyint((store->coordinate - angle) / (2 * pi));
}

static double leanOf(const RandomJoint *j) {
    double a[3], b[3], across[3];
    measure_turnOut(idOf(j->body[0]), j->store.at[0], a);
    measure_turnOut(idOf(j->body[1]), j->store.at[1], b);
    keaCross(across, a, b);
    return atan2(keaLength(across), keaDot(a, b));
}

static double distanceOf(RandomJoint *j) {
    double p[2][3], *d = j->store.reach, axis[3];
    for (int k = 0; k < 2; k++)
        measure_pointOut(idOf(j->body[k]), j->store.at[k], p[k]);
    keaSubtract(d, p[0], p[1]);
    if (j->store.kind == STORE_DISTANCE)
        return keaLength(d);
    measure_turnOut(idOf(j->body[1]), j->store.axis, axis);
    return keaDot(d, axis);
}

static void quaternionBetween(const RandomJoint *j, double q[4]) {
    double R[2][3][3], between[3][3];
    for (int k = 0; k < 2; k++)
        measure_rotation(idOf(j->body[k]), R[k]);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            between[i][k] = R[1][0][i] * R[0][0][k] + R[1][1][i] * R[0][1][k] + R[1][2][i] * R[0][2][k];
    keaQuaternionFromMatrix(q, (const double(*)[3])between);
}

/* The rotation vector from how the bodies stood first to how they stand. */
static void turnOf(RandomJoint *j, double turn[3]) {
    double q[4], back[4], d[4];
    quaternionBetween(j, q);
    if (keaDot(j->store.rest + 1, j->store.rest + 1) + fabs(j->store.rest[0]) == 0)
        memcpy(j->store.rest, q, sizeof q);
    keaQuaternionConjugate(back, j->store.rest);
    keaQuaternionProduct(d, q, back);
    const double sine = keaLength(d + 1), angle = 2 * atan2(sine, fabs(d[0]));
    keaScale(turn, sine > 0 ? (d[0] < 0 ? -angle : angle) / sine : 0, d + 1);
}

static double coordinateOf(RandomJoint *j) {
    switch (j->store.kind) {
    case STORE_ANGLE:
        return angleOf(j);
    case STORE_LEAN:
        return leanOf(j);
    default:
        return distanceOf(j);
    }
}

void random_strainAt(const RandomStore *store, double coordinate, double strain[3]) {
    const MeBool isPlain = store->stop[0] == store->stop[1] && store->stiffness[0] == store->stiffness[1];
    const double x = coordinate - store->stop[0], y = coordinate - store->stop[1];
    strain[0] = isPlain ? x : fmin(x, 0);
    strain[1] = isPlain ? 0 : fmax(y, 0);
    strain[2] = 0;
}

void random_strainOf(RandomJoint *j, double strain[3], double stiffness[3]) {
    RandomStore *store = &j->store;
    keaZero(strain);
    for (int i = 0; i < 3; i++)
        stiffness[i] = store->stiffness[store->kind == STORE_TURN ? 0 : i == 1];
    if (store->kind == STORE_TURN) {
        turnOf(j, strain);
    } else if (store->kind != STORE_NONE) {
        store->coordinate = coordinateOf(j);
        random_strainAt(store, store->coordinate, strain);
    }
}

/* ---- words ---- */

static int numberOf(const RandomScene *s, const RandomBody *b) {
    return b ? (int)(b - s->body) : -1;
}

static void describeJoint(const RandomScene *s, int i, FILE *file) {
    const RandomJoint *j = &s->joint[i];
    fprintf(file, "  joint %d: %s of %d and %d", i, j->kind, numberOf(s, j->body[0]), numberOf(s, j->body[1]));
    MdtHingeID hinge = MdtConstraintDCastHinge(j->id);
    MdtPrismaticID slider = MdtConstraintDCastPrismatic(j->id);
    MdtLimitID limit = hinge ? MdtHingeGetLimit(hinge) : slider ? MdtPrismaticGetLimit(slider) : NULL;
    if (limit && MdtLimitIsMotorized(limit))
        fprintf(file, ", motor %.3g with %.3g", (double)MdtLimitGetMotorDesiredVelocity(limit),
                (double)MdtLimitGetMotorMaxForce(limit));
    if (limit && MdtLimitIsActive(limit)) {
        MdtSingleLimitID low = MdtLimitGetLowerLimit(limit), high = MdtLimitGetUpperLimit(limit);
        fprintf(file, ", stops %.3g (e %.2g) %.3g (e %.2g)", (double)MdtSingleLimitGetStop(low),
                (double)MdtSingleLimitGetRestitution(low), (double)MdtSingleLimitGetStop(high),
                (double)MdtSingleLimitGetRestitution(high));
    }
    if (j->store.kind != STORE_NONE)
        fprintf(file, ", k %.3g %.3g", j->store.stiffness[0], j->store.stiffness[1]);
    fputc('\n', file);
}

void random_sceneDescribe(const RandomScene *s, FILE *file) {
    fprintf(file, "seed %llu: %s of %d bodies and %d joints, step 1/%.0f s, %d steps, epsilon %g, gravity %g\n",
            s->seed, s->topology, s->bodies, s->joints, 1 / s->step, s->duration, s->epsilon, s->gravity);
    fprintf(file, "  masses within 1:%.3g, shaken by %.3g m/s%s", s->ratio, s->shaking, s->hasMotors ? ", motors" : "");
    if (s->hasGround)
        fprintf(file, ", ground with restitution %.2g and friction %.2g", s->restitution, s->friction);
    fputc('\n', file);
    for (int i = 0; i < s->bodies; i++)
        fprintf(file, "  body %d: %s of %.3g kg, %.3g m\n", i, s->body[i].isSphere ? "sphere" : "box", s->body[i].mass,
                s->body[i].size);
    for (int i = 0; i < s->joints; i++)
        describeJoint(s, i, file);
    for (int i = 0; i < s->kicks; i++)
        fprintf(file, "  kick before step %d of body %d: %.3g m/s, %.3g rad/s\n", s->kick[i].step,
                numberOf(s, s->kick[i].body), keaLength(s->kick[i].velocity), keaLength(s->kick[i].rate));
}
