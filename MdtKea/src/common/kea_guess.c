/* Cold start: a guess at the forces of contacts if none are known, as in the first step of a tower. Both solvers start
 * from the last step's forces; without them Newton's method finds the active contacts from the ground up, one layer per
 * iteration, and the fast solver's passes transmit forces as slowly.
 *
 * The load L of a body is its own force plus what the bodies above it press it with. The contacts below share it as if
 * there were no friction and no lever arms:
 *
 *     F_i = α c_i,    c = -n·l,    α = -L l·N / N²,    N = Σ c n,
 *
 * with l the direction of the body's force. α minimizes the unsupported remainder |α N + L l|: a slope gets L c, each
 * side of a groove L / (2 c). No contact gets more than L: friction carries the rest on sides steeper than 60 degrees.
 * Loads are passed down by sweeps over the contacts, alternately in reverse order and in order. If contacts are sorted
 * from the ground up or from the top down, two sweeps are enough. */
#include "kea_i.h"
#include "common/kea_policy_i.h"
#include "inner/kea_factor_i.h"
#include "MeAssert.h"

/* What a body's contacts have to carry. */
typedef struct Load {
    double force;     /* L, in newtons */
    double normal[3]; /* the vector N: the sum of the normals of the contacts that support the body, weighted by c */
    double share;     /* α / L: a contact carries L share c */
} Load;

/* A resting contact: a manifold of which some points touch. */
typedef struct RestingContact {
    MdtKeaManifold *manifold;
    double size;  /* m, of the smaller body */
    double c[2];  /* by body: the fraction of the normal force that supports it; negative: that presses it down */
    double force; /* N, the normal force of all points together */
    int numTouching;
} RestingContact;

typedef struct Guess {
    Load *load; /* by body */
    RestingContact *contact;
    int numContacts;
} Guess;

static size_t layOutGuess(const MdtKeaSystem *s, Guess *g, char *memory) {
    KeaArena arena = {memory, 0};
    KEA_CARVE(&arena, g->load, (size_t)s->numBodies);
    KEA_CARVE(&arena, g->contact, (size_t)s->numManifolds);
    return arena.used;
}

static MeBool isAnyForceKnown(const MdtKeaSystem *s) {
    for (int i = 0; i < s->numManifolds; i++)
        for (int k = 0; k < s->manifolds[i].numPoints; k++)
            if (!s->manifolds[i].point[k].isNew)
                return METRUE;
    return MEFALSE;
}

/* The coefficient c = -n·l of body k of a manifold; 0 for the world, and for bodies without force. */
static double supportOf(const MdtKeaSystem *s, const MdtKeaManifold *m, int k) {
    if (m->body[k] < 0)
        return 0;
    const double *force = s->bodies[m->body[k]]->force, size = keaLength(force);
    return size > 0 ? (k == 0 ? -1 : 1) * keaDot(m->normal, force) / size : 0;
}

/* Whether the gap of the point is closed, and its overlap not deep; size: m, of the smaller body. */
static MeBool isTouching(const MdtKeaPoint *point, double size) {
    return point->depth >= -kea_touchingGap * size && point->depth <= kea_smallOverlap * size;
}

/* Adds a manifold to the resting contacts, if points of it touch, and to the normals of the bodies that it supports. */
static void addRestingContact(const MdtKeaSystem *s, MdtKeaManifold *m, Guess *g) {
    RestingContact *n = &g->contact[g->numContacts];
    *n = (RestingContact){.manifold = m, .size = kea_smallerExtent(s, m->body)};
    for (int k = 0; k < m->numPoints; k++)
        n->numTouching += isTouching(&m->point[k], n->size);
    if (n->numTouching == 0)
        return;
    g->numContacts++;
    for (int k = 0; k < 2; k++) {
        n->c[k] = supportOf(s, m, k);
        if (n->c[k] > 0)
            keaAddScaled(g->load[m->body[k]].normal, k == 0 ? n->c[k] : -n->c[k], m->normal);
    }
}

/* Sets the share from the force and the normals of a body. */
static void setLoadShare(const double force[3], Load *load) {
    MEASSERT(load->force >= 0);
    const double *N = load->normal, squares = keaDot(N, N);
    load->share = squares > 0 ? -keaDot(N, force) / (load->force * squares) : 0;
}

/* Finds the resting contacts, and sets each body's load to its own force. */
static void beginGuess(const MdtKeaSystem *s, Guess *g) {
    g->numContacts = 0;
    for (int i = 0; i < s->numBodies; i++)
        g->load[i] = (Load){.force = keaLength(s->bodies[i]->force)};
    for (int i = 0; i < s->numManifolds; i++)
        addRestingContact(s, &s->manifolds[i], g);
    for (int i = 0; i < s->numBodies; i++)
        setLoadShare(s->bodies[i]->force, &g->load[i]);
}

/* Sets the contact's force to its share of the upper body's load, and adds the change to the lower body's load. Returns
 * the absolute change of the force. */
static double passLoad(RestingContact *n, Load load[]) {
    const double before = n->force;
    n->force = 0;
    for (int k = 0; k < 2; k++)
        if (n->c[k] > 0) {
            const Load *l = &load[n->manifold->body[k]];
            n->force = keaMax(n->force, l->force * keaMin(l->share * n->c[k], 1));
        }
    for (int k = 0; k < 2; k++)
        if (n->c[k] < 0)
            load[n->manifold->body[k]].force -= n->c[k] * (n->force - before);
    return fabs(n->force - before);
}

/* Sweeps until the forces have converged. False: they have not after `max` sweeps, as for bodies that support each
 * other in a cycle. */
static MeBool passLoadsDown(Guess *g, int max) {
    for (int i = 0; i < max; i++) {
        double change = 0, all = 0;
        for (int k = 0; k < g->numContacts; k++) {
            RestingContact *n = &g->contact[i % 2 ? k : g->numContacts - 1 - k];
            change += passLoad(n, g->load);
            all += n->force;
        }
        if (change <= kea_guessTolerance * all)
            return METRUE;
    }
    return MEFALSE;
}

/* Writes the contacts' forces as warm start, in equal parts to their touching points. */
static void writeForces(const Guess *g) {
    for (int i = 0; i < g->numContacts; i++) {
        const RestingContact *n = &g->contact[i];
        MEASSERT(n->numTouching > 0);
        for (int k = 0; k < n->manifold->numPoints; k++)
            if (isTouching(&n->manifold->point[k], n->size))
                n->manifold->point[k].guess[0] = n->force / n->numTouching;
    }
}

void kea_guessContactForces(MdtKeaSystem *s) {
    Guess g;
    if (s->numManifolds == 0 || isAnyForceKnown(s))
        return;
    char *memory = kea_cacheScratch(s->cache, KEA_STEP_BLOCK, layOutGuess(s, &g, NULL));
    if (!memory)
        return;
    layOutGuess(s, &g, memory);
    beginGuess(s, &g);
    if (passLoadsDown(&g, s->numBodies + 1))
        writeForces(&g);
}
