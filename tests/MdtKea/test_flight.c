/* Bodies that fly from impact to impact (MdtKeaFly): where they are is known in closed form. */
#include "system.h"

static const double radius = .5;
/* m, at a place 1 m from the origin: of the transforms that gaps come from, which may be as much less. */
static const double rounding = 1e-7;

static MdtKeaManifold manifold[MAX_BODIES];

static void begin(int numBodies) {
    system_begin(numBodies, 3 * MAX_BODIES, MAX_BODIES, 1);
    memset(manifold, 0, sizeof manifold);
    s.manifolds = manifold;
    s.parameters.timed = METRUE;
}

static void setBall(int i, double x, double y, double v) {
    setBody(i, 1, .1, x);
    body[i].position[1] = y;
    body[i].velocity[0] = v;
}

/* Along x, of two balls or of one and the world. The second one is on the left. */
static void addContact(int a, int b, double gap, double restitution) {
    MdtKeaManifold *m = &manifold[s.numManifolds++];
    m->body[0] = a;
    m->body[1] = b;
    m->normal[0] = m->direction[1] = 1;
    m->radius[0] = radius;
    m->radius[1] = b < 0 ? 0 : radius;
    m->surface.restitution = restitution;
    m->numPoints = 1;
    keaCopy(m->point[0].position, body[a].position);
    m->point[0].position[0] -= radius + gap / 2;
    m->point[0].depth = -gap;
}

/* The rows of the first contacts are left out. */
static double flyWithout(int contacts, int maxImpacts) {
    system_init();
    MdtKeaCountContactRows(&s);
    for (int i = 0; i < contacts; i++)
        manifold[i].point[0].numRows = 0;
    MdtKeaMakeContactRows(&s);
    ck_assert(MdtKeaFlies(&s));
    const double flown = MdtKeaFly(&s, 1e-9, maxImpacts);
    ck_assert(s.parameters.stepsize == flown);
    ck_assert(MdtKeaIntegrate(&s));
    return flown;
}

static double fly(int maxImpacts) {
    return flyWithout(0, maxImpacts);
}

/* Five balls .1 m apart; the first comes with 1 m/s, stops where it hits, and so on. `others` fly elsewhere. Returns
 * the work of the four impacts. */
static double passOn(int others) {
    begin(5 + others);
    for (int i = 0; i < 5 + others; i++)
        setBall(i, 1.1 * i, i < 5 ? 0 : 10, i == 0 || i >= 5);
    for (int i = 0; i + 1 < 5 + others; i++)
        if (i != 4)
            addContact(i + 1, i, .1, 1);
    assert_near(fly(100), 1, 0);
    ck_assert_int_eq(s.report.impacts, 4);
    for (int i = 0; i < 5; i++) {
        assert_near(body[i].position[0], 1.1 * i + (i < 4 ? .1 : .6), 20 * rounding);
        assert_near(body[i].velocity[0], i == 4, 1e-12);
        assert_near(manifold[i].point[0].force[0], i < 4, 1e-12); /* N s */
    }
    for (int i = 5; i < 5 + others; i++)
        assert_near(body[i].position[0], 1.1 * i + 1, 1e-12);
    const double work = s.report.work;
    end();
    return work;
}

TEST(a_blow_is_passed_on_and_costs_the_same_in_a_crowd) {
    const double work = passOn(0);
    ck_assert(work > 0);
    ck_assert(passOn(50) == work);
}

/* To and fro between two walls, .2 m on either side, with 1 m/s, falling and spinning all the while: it meets them
 * after .2, .6 and 1 s. */
TEST(a_ball_bounces_through_a_step) {
    const double w[3] = {0, 0, 2};
    begin(1);
    setBall(0, 0, 0, -1);
    MdtKeaBodySetAngularVelocity(&body[0], w);
    body[0].force[1] = -1;
    addContact(0, MdtKeaWORLD, .2, 1);
    addContact(0, MdtKeaWORLD, .2, 1);
    manifold[1].normal[0] = -1;
    manifold[1].point[0].position[0] *= -1;
    s.parameters.stepsize = 1.1;
    assert_near(fly(100), 1.1, 0);
    ck_assert_int_eq(s.report.impacts, 3);
    assert_near(body[0].position[0], -.1, 6 * rounding);
    assert_near(body[0].position[1], -.5 * 1.1 * 1.1, 1e-12);
    assert_near(body[0].fall, .5 * 1.1 * 1.1, 1e-12);
    assert_near(body[0].velocity[0], 1, 1e-12);
    assert_near(body[0].acceleration[1], -1, 1e-9);
    assert_near(body[0].quaternion[3], sin(1.1), 1e-12);
    assert_near(manifold[0].point[0].force[0], 4, 1e-12); /* N s, of two */
    assert_near(manifold[1].point[0].force[0], 2, 1e-12);
    end();
}

TEST(flight_ends_where_something_is_held) {
    for (int k = 0; k < 2; k++) {
        begin(2);
        setBall(0, radius + .1, 0, -1);
        setBall(1, 5, 0, 2);
        addContact(0, MdtKeaWORLD, .1, k); /* it stops, or it bounces */
        addContact(1, 0, 5 - .6 - 2 * radius, 1);
        assert_near(fly(1), k ? 1 : .1, rounding);
        ck_assert_int_eq(s.report.impacts, 1);
        assert_near(body[0].position[0], radius + k * .9, 2 * rounding);
        assert_near(body[0].velocity[0], k, 1e-12);
        assert_near(body[1].position[0], 5 + (k ? 2 : .2), 2 * rounding);
        end();
    }
    begin(1);
    setBall(0, radius + .1, 0, -1);
    addContact(0, MdtKeaWORLD, .1, 1);
    assert_near(fly(0), .1, rounding);
    ck_assert_int_eq(s.report.impacts, 0);
    assert_near(body[0].velocity[0], -1, 1e-12);
    end();
}

TEST(what_meets_nothing_flies_to_the_end) {
    begin(1);
    setBall(0, 0, 0, 3);
    assert_near(fly(10), 1, 0);
    assert_near(body[0].position[0], 3, 1e-12);
    end();
    begin(2); /* the first ball passes the second one, which hits the wall */
    setBall(0, 3, 0, -4);
    setBall(1, 1, 0, -1);
    addContact(0, 1, 1, 1);
    addContact(1, MdtKeaWORLD, .5, 1);
    assert_near(flyWithout(1, 10), 1, 0);
    ck_assert_int_eq(s.report.impacts, 1);
    assert_near(body[0].position[0], -1, 1e-12);
    assert_near(body[1].position[0], 1, 2 * rounding);
    end();
}
