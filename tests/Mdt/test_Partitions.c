/* Partitions, found anew only where the graph has changed: against a search that knows nothing of that, from what
 * programs see, after whatever a program can do to the graph. */
#include "measure.h"

enum { MAX_BODIES = 40, MAX_CONSTRAINTS = 200, STEPS = 1000 };

/* Bodies and constraints in the order of simulation, partition by partition, and where each begins. */
typedef struct Partitions {
    int count;
    int bodyStart[MAX_BODIES + 1], constraintStart[MAX_BODIES + 1];
    MdtBodyID body[MAX_BODIES];
    MdtConstraintID constraint[MAX_CONSTRAINTS];
} Partitions;

typedef struct Scene {
    MdtWorldID world;
    Random random;
    MdtBodyID body[MAX_BODIES];
    MdtConstraintID constraint[MAX_CONSTRAINTS]; /* joints and groups; contacts are in groups */
    int numBodies, numConstraints;
    int shown;       /* partitions that the world has shown in this step */
    Partitions seen; /* what they were */
    MeBool isToRest; /* the next partition is put to sleep */
} Scene;

/* What the test knows of a body, as its user data: the world has put it to sleep; it was pushed since. */
static char asleep, pushed;

/* ---- what there should be ---- */

static MeBool isInGroup(MdtConstraintID c) {
    const MdtContactID contact = MdtConstraintDCastContact(c);
    return contact && MdtContactGetContactGroup(contact);
}

static int placeOf(const MdtBodyID list[], int n, MdtBodyID b) {
    for (int i = 0; i < n; i++)
        if (list[i] == b)
            return i;
    return -1;
}

/* Every body takes the least label of those that it is tied to, until nothing changes. */
static void label(MdtWorldID w, const MdtBodyID list[], int n, int labels[]) {
    for (int i = 0; i < n; i++)
        labels[i] = i;
    for (int changes = 1; changes > 0;) {
        changes = 0;
        for (MdtConstraintID c = MdtConstraintGetFirst(w); c; c = MdtConstraintGetNext(c)) {
            const int a = placeOf(list, n, MdtConstraintGetBody(c, 0)),
                      b = placeOf(list, n, MdtConstraintGetBody(c, 1));
            if (a < 0 || b < 0 || !MdtConstraintIsEnabled(c) || labels[a] == labels[b])
                continue;
            labels[a] = labels[b] = labels[a] < labels[b] ? labels[a] : labels[b];
            changes++;
        }
    }
}

static MeBool isAwake(MdtBodyID b) {
    return MdtBodyIsEnabled(b) || MdtBodyGetUserData(b) == &pushed;
}

static void addConstraints(Partitions *p, MdtWorldID w, const MdtBodyID list[], int n, const int labels[], int wanted) {
    int *end = &p->constraintStart[p->count];
    for (MdtConstraintID c = MdtConstraintGetFirst(w); c; c = MdtConstraintGetNext(c)) {
        const MdtBodyID b = MdtConstraintGetBody(c, 0) ? MdtConstraintGetBody(c, 0) : MdtConstraintGetBody(c, 1);
        if (isInGroup(c) || !MdtConstraintIsEnabled(c) || !b || labels[placeOf(list, n, b)] != wanted)
            continue;
        p->constraint[(*end)++] = c;
        const MdtContactGroupID group = MdtConstraintDCastContactGroup(c);
        for (MdtContactID at = group ? MdtContactGroupGetFirstContact(group) : 0; at;
             at = MdtContactGroupGetNextContact(group, at))
            p->constraint[(*end)++] = MdtContactQuaConstraint(at);
    }
}

static Partitions search(MdtWorldID w) {
    Partitions p = {0};
    MdtBodyID list[MAX_BODIES];
    int labels[MAX_BODIES], n = 0;
    for (MdtBodyID b = MdtBodyGetFirst(w); b; b = MdtBodyGetNext(b))
        list[n++] = b;
    label(w, list, n, labels);
    for (int first = 0; first < n; first++) {
        MeBool awake = MEFALSE;
        for (int i = first; i < n; i++)
            awake = awake || (labels[i] == first && isAwake(list[i]));
        if (!awake)
            continue;
        p.count++;
        p.bodyStart[p.count] = p.bodyStart[p.count - 1];
        p.constraintStart[p.count] = p.constraintStart[p.count - 1];
        for (int i = first; i < n; i++)
            if (labels[i] == first)
                p.body[p.bodyStart[p.count]++] = list[i];
        addConstraints(&p, w, list, n, labels, first);
    }
    return p;
}

/* ---- what there is ---- */

static void MEAPI see(MdtPartitionOutput *po, void *data) {
    Scene *s = data;
    const int p = po->numPartitions - 1;
    const MdtPartitionInfo *info = &po->info[p];
    Partitions *seen = &s->seen;
    s->shown++;
    seen->count = po->numPartitions;
    for (int i = 0; i < info->numBodies; i++)
        seen->body[info->firstBody + i] = po->bodies[info->firstBody + i];
    for (int i = 0; i < info->numConstraints; i++)
        seen->constraint[info->firstConstraint + i] = po->constraints[info->firstConstraint + i];
    seen->bodyStart[p + 1] = info->firstBody + info->numBodies;
    seen->constraintStart[p + 1] = info->firstConstraint + info->numConstraints;
    po->info[p].isDisabled = s->isToRest;
    for (int i = 0; i < info->numBodies; i++)
        MdtBodySetUserData(po->bodies[info->firstBody + i], s->isToRest ? &asleep : 0);
    s->isToRest = MEFALSE;
}

static void compare(const Partitions *seen, const Partitions *wanted, int step, int last) {
    const int n = wanted->count;
    ck_assert_msg(seen->count == n, "step %d, after %d: %d partitions, expected %d", step, last, seen->count, n);
    for (int p = 0; p <= n; p++) {
        ck_assert_msg(seen->bodyStart[p] == wanted->bodyStart[p], "step %d, after %d: bodies of %d", step, last, p);
        ck_assert_msg(seen->constraintStart[p] == wanted->constraintStart[p], "step %d, after %d: constraints of %d",
                      step, last, p);
    }
    for (int i = 0; i < wanted->bodyStart[n]; i++)
        ck_assert_msg(seen->body[i] == wanted->body[i], "step %d, after %d: body %d", step, last, i);
    for (int i = 0; i < wanted->constraintStart[n]; i++)
        ck_assert_msg(seen->constraint[i] == wanted->constraint[i], "step %d, after %d: constraint %d", step, last, i);
}

/* ---- what a program does ---- */

static int below(Scene *s, int n) {
    return (int)((random_number(&s->random) + 1) / 2 * n) % n;
}

static MdtBodyID someBody(Scene *s) {
    return s->numBodies > 0 ? s->body[below(s, s->numBodies)] : 0;
}

static MdtConstraintID someConstraint(Scene *s) {
    return s->numConstraints > 0 ? s->constraint[below(s, s->numConstraints)] : 0;
}

/* One that acts, if there is any. */
static MdtContactGroupID someGroup(Scene *s) {
    MdtContactGroupID found = 0;
    for (int i = 0; i < s->numConstraints; i++) {
        const MdtContactGroupID g = MdtConstraintDCastContactGroup(s->constraint[i]);
        if (g && (!found || (MdtConstraintIsEnabled(s->constraint[i]) && below(s, 3))))
            found = g;
    }
    return found;
}

static void keep(Scene *s, MdtConstraintID c) {
    s->constraint[s->numConstraints++] = c;
}

static void createBody(Scene *s) {
    if (s->numBodies == MAX_BODIES - 2)
        return;
    const MdtBodyID from = below(s, 4) == 0 ? someBody(s) : 0;
    const MdtBodyID b = from ? MdtBodyCopy(from, s->world) : MdtBodyCreate(s->world);
    MdtBodySetUserData(b, 0);
    s->body[s->numBodies++] = b;
    if (below(s, 2))
        MdtBodyEnable(b);
}

/* What the constraint acts on wakes in the next step. */
static void disturb(MdtConstraintID c) {
    for (unsigned int k = 0; c && MdtConstraintIsEnabled(c) && k < 2; k++)
        if (MdtConstraintGetBody(c, k) && MdtBodyGetUserData(MdtConstraintGetBody(c, k)) == &asleep)
            MdtBodySetUserData(MdtConstraintGetBody(c, k), &pushed);
}

static void destroyBody(Scene *s) {
    if (s->numBodies == 0)
        return;
    const int i = below(s, s->numBodies);
    for (MdtConstraintID c = MdtBodyGetFirstConstraint(s->body[i]); c; c = MdtBodyGetNextConstraint(s->body[i], c))
        disturb(c);
    MdtBodyDestroy(s->body[i]);
    s->body[i] = s->body[--s->numBodies];
}

static void switchBody(Scene *s) {
    const MdtBodyID b = someBody(s);
    if (!b)
        return;
    if (MdtBodyIsEnabled(b))
        MdtBodyDisable(b);
    else
        MdtBodyEnable(b);
    MdtBodySetUserData(b, 0);
}

static void push(Scene *s) {
    const MdtBodyID b = someBody(s);
    if (b && MdtBodyGetUserData(b) == &asleep) { /* wakes in the next step */
        MdtBodyAddForce(b, 100, 0, 0);
        MdtBodySetUserData(b, &pushed);
    }
}

/* Two bodies, or one and the world. */
static void tie(Scene *s, MdtConstraintID c) {
    const MdtBodyID a = someBody(s), b = below(s, 3) ? someBody(s) : 0;
    if (a && a != b)
        MdtConstraintSetBodies(c, below(s, 2) && b ? b : a, below(s, 2) && b ? a : 0);
    disturb(c);
}

static void destroyConstraint(Scene *s) {
    if (s->numConstraints == 0)
        return;
    const int i = below(s, s->numConstraints);
    disturb(s->constraint[i]);
    MdtConstraintDestroy(s->constraint[i]);
    s->constraint[i] = s->constraint[--s->numConstraints];
}

static void createJoint(Scene *s) {
    const MdtBodyID a = someBody(s), b = someBody(s);
    if (!a || a == b)
        return;
    if (s->numConstraints >= MAX_CONSTRAINTS / 5)
        destroyConstraint(s);
    const MdtConstraintID c = below(s, 2) ? MdtContactGroupQuaConstraint(MdtContactGroupCreate(s->world))
                                          : MdtBSJointQuaConstraint(MdtBSJointCreate(s->world));
    MdtConstraintSetBodies(c, a, b);
    keep(s, c);
    if (below(s, 4))
        MdtConstraintEnable(c);
    disturb(c);
}

static void switchConstraint(Scene *s) {
    const MdtConstraintID c = someConstraint(s);
    disturb(c);
    if (c && MdtConstraintIsEnabled(c))
        MdtConstraintDisable(c);
    else if (c && (MdtConstraintGetBody(c, 0) || MdtConstraintGetBody(c, 1)))
        MdtConstraintEnable(c);
    disturb(c);
}

static void retie(Scene *s) {
    const MdtConstraintID c = someConstraint(s);
    disturb(c);
    if (c)
        tie(s, c);
}

static void addContact(Scene *s) {
    const MdtContactGroupID g = someGroup(s);
    if (!g || MdtContactGroupGetCount(g) >= 3)
        return;
    MdtContactGroupCreateContact(g);
    disturb(MdtContactGroupQuaConstraint(g));
}

static void destroyContact(Scene *s) {
    const MdtContactGroupID g = someGroup(s);
    const MdtContactID c = g ? MdtContactGroupGetFirstContact(g) : 0;
    if (!c)
        return;
    MdtContactGroupDestroyContact(g, c);
    disturb(MdtContactGroupQuaConstraint(g));
}

/* A contact that leaves its group is a constraint of its own. */
static void removeContact(Scene *s) {
    const MdtContactGroupID g = someGroup(s);
    const MdtContactID c = g && s->numConstraints < MAX_CONSTRAINTS / 4 ? MdtContactGroupGetFirstContact(g) : 0;
    if (!c)
        return;
    MdtContactGroupRemoveContact(g, c);
    disturb(MdtContactGroupQuaConstraint(g));
    keep(s, MdtContactQuaConstraint(c));
    if (below(s, 2))
        MdtConstraintEnable(MdtContactQuaConstraint(c));
    disturb(MdtContactQuaConstraint(c));
}

static void sortBody(Scene *s) {
    const MdtBodyID b = someBody(s);
    if (b)
        MdtBodySetSortKey(b, below(s, 5));
}

static void sortConstraint(Scene *s) {
    const MdtConstraintID c = someConstraint(s);
    if (c)
        MdtConstraintSetSortKey(c, below(s, 5));
}

static void rest(Scene *s) {
    s->isToRest = METRUE;
}

static void reset(Scene *s) {
    if (below(s, 20))
        return;
    MdtWorldReset(s->world);
    s->numBodies = s->numConstraints = 0;
}

/* All bodies that were woken by what the program did are awake for the test, too. */
static void noteWoken(Scene *s) {
    for (int i = 0; i < s->numBodies; i++)
        if (MdtBodyIsEnabled(s->body[i]))
            MdtBodySetUserData(s->body[i], 0);
}

static void (*const actions[])(Scene *) = {
    createBody,     createBody,        destroyBody,      switchBody,     push,       createJoint,
    createJoint,    destroyConstraint, switchConstraint, retie,          addContact, addContact,
    destroyContact, removeContact,     sortBody,         sortConstraint, rest,       reset};

static Scene create(void) {
    Scene s = {.world = MdtWorldCreate(MAX_BODIES, MAX_CONSTRAINTS), .random = {1}};
    MdtWorldSetGravity(s.world, 0, 0, 0);
    MdtWorldSetGamma(s.world, 0);
    return s;
}

TEST(partitions_are_those_of_a_search_after_whatever_changes_the_graph) {
    enum { ACTIONS = sizeof actions / sizeof *actions };
    Scene s = create();
    int done[ACTIONS] = {0}, max = 0;
    MdtWorldSetPartitionCB(s.world, see, &s);
    for (int i = 0; i < 20; i++)
        createBody(&s);
    for (int step = 0; step < STEPS; step++) {
        const int action = below(&s, ACTIONS), isQuiet = below(&s, 3) == 0;
        if (!isQuiet)
            actions[action](&s);
        done[action] += !isQuiet;
        noteWoken(&s);
        const Partitions wanted = search(s.world);
        s.shown = 0;
        s.seen = (Partitions){0};
        MdtWorldStep(s.world, FRAME);
        ck_assert_int_eq(s.shown, wanted.count);
        compare(&s.seen, &wanted, step, isQuiet ? -1 : action);
        max = wanted.count > max ? wanted.count : max;
    }
    for (int i = 0; i < ACTIONS; i++)
        ck_assert_int_gt(done[i], STEPS / ACTIONS / 4);
    ck_assert_int_gt(max, 5);
    MdtWorldDestroy(s.world);
    messages_forget();
}
