/* The guess at the forces of contacts where none are known (common/kea_guess.c): bodies of 1 kg under a load of 8 N. */
#include "common/kea_policy_i.h"
#include "system.h"

static const double load = 8;
static MdtKeaManifold manifold[2 * MAX_BODIES];

/* Whose manifolds are new, of a point each between the world and the first body, with y up. */
static void begin(int numBodies, int numManifolds) {
    system_begin(numBodies, 0, 0, 1. / 64);
    for (int i = 0; i < numBodies; i++) {
        setBody(i, 1, 1, 0);
        body[i].force[1] = -load;
    }
    for (int i = 0; i < numManifolds; i++)
        manifold[i] = (MdtKeaManifold){.body = {0, MdtKeaWORLD},
                                       .numPoints = 1,
                                       .normal = {0, 1, 0},
                                       .direction = {1, 0, 0},
                                       .point[0].isNew = METRUE};
    s.numManifolds = numManifolds;
    s.manifolds = manifold;
    s.parameters.solver = MdtKeaSolverFast;
}

static void guess(void) {
    system_init();
    end();
}

static double forceOf(int i) {
    double sum = 0;
    for (int k = 0; k < manifold[i].numPoints; k++)
        sum += manifold[i].point[k].guess[0];
    return sum;
}

/* Body k's place from the ground up, in an order of some kind: the world's is -1. */
static void makeColumn(const int place[]) {
    begin(MAX_BODIES, MAX_BODIES);
    for (int i = 0; i < MAX_BODIES; i++)
        for (int k = 0; k < MAX_BODIES; k++) {
            if (place[k] == place[i] - 1)
                manifold[i].body[1] = k;
            manifold[i].body[0] = i;
        }
}

/* Each contact of a column bears all that is above it, in whatever order contacts and bodies come. */
TEST(a_columns_contacts_bear_what_is_above) {
    for (int stride = 1; stride < MAX_BODIES; stride += 6) { /* coprime with 60: 1, 7, 13, 19, 31, 37, 43, 49 */
        int place[MAX_BODIES];
        if (stride % 5 == 0)
            continue;
        for (int i = 0; i < MAX_BODIES; i++)
            place[i] = i * stride % MAX_BODIES;
        makeColumn(place);
        guess();
        for (int i = 0; i < MAX_BODIES; i++)
            assert_near_rel(forceOf(i), load * (MAX_BODIES - place[i]), kea_guessTolerance);
    }
}

/* A row of boxes on twice as many legs, of which each bears half. Only points that touch do: a gap, and what has come
 * deep into the ground, bear nothing. */
TEST(contacts_that_touch_share_the_load) {
    begin(1, 2);
    manifold[0].numPoints = 4;
    for (int k = 0; k < 4; k++)
        manifold[0].point[k] = (MdtKeaPoint){.isNew = METRUE, .depth = k == 3 ? -1e-3 : 0};
    guess();
    assert_near(forceOf(0), load / 2, 1e-12);
    assert_near(forceOf(1), load / 2, 1e-12);
    ck_assert(manifold[0].point[3].guess[0] == 0 && manifold[0].point[2].guess[0] > 0);
    begin(1, 3);
    manifold[1].point[0].depth = 2 * kea_smallOverlap;
    manifold[2].point[0].depth = -1e-3;
    guess();
    assert_near(forceOf(0), load, 1e-12);
    ck_assert(forceOf(1) == 0 && forceOf(2) == 0);
}

/* In a groove of 60 degrees to each side, F = G / (2 cos 60). */
TEST(a_groove_presses_from_both_sides) {
    begin(1, 2);
    for (int k = 0; k < 2; k++) {
        manifold[k].normal[0] = (k ? 1 : -1) * sqrt(.75);
        manifold[k].normal[1] = .5;
        manifold[k].direction[0] = manifold[k].direction[1] = 0;
        manifold[k].direction[2] = 1;
    }
    guess();
    assert_near(forceOf(0), load, 1e-9);
    assert_near(forceOf(1), load, 1e-9);
}

/* What is known is not touched, nor guessed beside; bodies that bear each other in a circle are left alone. */
TEST(known_forces_are_left_alone) {
    begin(1, 2);
    manifold[1].point[0].isNew = MEFALSE;
    manifold[1].point[0].guess[0] = 3;
    guess();
    ck_assert(forceOf(0) == 0 && forceOf(1) == 3);
    begin(2, 2);
    for (int k = 0; k < 2; k++) {
        manifold[k].body[0] = k;
        manifold[k].body[1] = 1 - k;
    }
    guess();
    ck_assert(forceOf(0) == 0 && forceOf(1) == 0);
}
