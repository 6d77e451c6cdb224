/* Documented behaviours: contacts (Dynamics guide ch. 3, "Creating Contacts", "The MdtBclContactParams Structure",
 * "MdtContactGroups").
 *
 * Already proved elsewhere:
 *   it never pulls unless adhesive                    test_Contact: a_contact_does_not_pull_unless_it_is_adhesive
 *   a contact that is not enabled is ignored          test_Contact: a_disabled_contact_is_ignored_and_the_world_may_...
 *   frictionless, and infinite friction               test_Contact: frictionless_and_infinite_friction
 *   box friction of 10: 9 holds, 11 moves with 1      test_Contact: box_friction_is_a_box
 *   the box: more along its diagonal                  test_Contact: box_friction_is_a_box
 *   normal-force friction (this step's force is used, not the last one's, so that it holds from the first step on)
 *                                                     test_Contact: normal_force_friction_is_coulomb_s
 *   Friction1D acts along the primary direction       test_Contact: friction_1d_acts_along_the_primary_direction
 *   slip: velocity = slip × force (reached within steps much longer than mass × slip; a body has inertia)
 *                                                     test_Contact: slip_velocity_is_slip_times_force_at_once
 *   slide: a conveyor belt                            test_Contact: slide_carries_at_belt_speed
 *   restitution e, above the threshold only           test_Contact: impacts_below_the_threshold_do_not_bounce
 *   softness lets bodies overlap                      test_Contact: softness_rests_softness_force_step_squared_over_...
 *   what overlaps is pushed out, a gap may be closed  test_Contact: overlap_is_pushed_out_by_gamma_a_step
 *                                                     test_Contact: a_gap_closes_exactly
 *   MdtContactGetNext ends with MdtContactInvalidID   test_Constraint: contacts_form_lists_of_their_makers
 *   a group's list, count, creating, removing         test_ContactGroup: the_list_is_walked_from_first_to_null
 *                                                     test_ContactGroup: contacts_come_and_go
 *   a group's normal force                            test_ContactGroup: forces_are_the_sums_over_the_contacts
 *   with the world the body comes first               test_ContactGroup: with_the_world_the_body_comes_first
 *   the group's Enable, Disable, IsEnabled            test_ContactGroup: only_the_group_s_switch_counts
 */
#include "behaviour.h"

/* Two balls of the mass 1 that touch at the origin along n, the first on the side to which n points. */
typedef struct {
    MdtWorldID world;
    MdtBodyID first, second;
    MdtContactID contact;
    double n[3];
} Pair;

static Pair makePair(double x, double y, double z) {
    Pair s = {.n = {x, y, z}};
    s.world = scene_world(2, 2, 0);
    MdtWorldSetEpsilon(s.world, 0);
    s.first = scene_body(s.world, 1, x, y, z);
    s.second = scene_body(s.world, 1, -x, -y, -z);
    s.contact = MdtContactCreate(s.world);
    MdtContactSetBodies(s.contact, s.first, s.second);
    MdtContactSetPosition(s.contact, 0, 0, 0);
    MdtContactSetNormal(s.contact, x, y, z);
    for (unsigned int k = 0; k < 2; k++)
        MdtContactSetRadius(s.contact, k, 1);
    MdtContactEnable(s.contact);
    return s;
}

static void approachWith(Pair *s, double speed) {
    MdtBodySetLinearVelocity(s->first, -speed * s->n[0], -speed * s->n[1], -speed * s->n[2]);
}

/* How fast the first body moves away from the second. */
static double separation(const Pair *s) {
    double v = 0;
    for (int i = 0; i < 3; i++)
        v += s->n[i] * (velocity(s->first, i) - velocity(s->second, i));
    return v;
}

static const double normals[][3] = {{0, 1, 0}, {1, 0, 0}, {.6, 0, .8}, {-.48, .6, .64}};
enum { NORMALS = sizeof normals / sizeof *normals };

/* "There is no relative motion in the direction opposite to the contact normal", and only that is blocked: the normal
 * is the way in which the first body is pushed. */
TEST(a_contact_blocks_motion_against_its_normal_only) {
    for (int i = 0; i < NORMALS; i++)
        for (int way = -1; way <= 1; way += 2) {
            Pair s = makePair(normals[i][0], normals[i][1], normals[i][2]);
            approachWith(&s, 2 * way);
            MdtWorldStep(s.world, FRAME);
            assert_near(separation(&s), way > 0 ? 0 : 2, TOL(1e-6, 1e-9));
            const double pushed = forceOn(MdtContactQuaConstraint(s.contact), 0, 0) * s.n[0] +
                                  forceOn(MdtContactQuaConstraint(s.contact), 0, 1) * s.n[1] +
                                  forceOn(MdtContactQuaConstraint(s.contact), 0, 2) * s.n[2];
            assert_near(pushed, way > 0 ? 1 / (double)FRAME : 0, TOL(1e-3, 1e-6)); /* both to 1 m/s: 1 N s */
        }
}

/* "The secondary direction is perpendicular to the primary direction, ... according to the right-hand rule", normal ×
 * primary: friction of 10 along the one and of 2 along the other, pushed with 6 along both. */
TEST(the_secondary_direction_follows_the_right_hand_rule) {
    for (int i = 0; i < NORMALS; i++) {
        const double *n = normals[i];
        MdtWorldID w = scene_world(1, 1, 0);
        MdtWorldSetEpsilon(w, 0);
        MdtBodyID b = scene_body(w, 1, 0, 0, 0);
        MdtContactID c = MdtContactCreate(w, b, 0);
        double p[3] = {-n[1], n[0], 0}, q[3];
        if (p[0] == 0 && p[1] == 0)
            p[0] = 1;
        const double size = sqrt(p[0] * p[0] + p[1] * p[1]);
        for (int k = 0; k < 3; k++)
            p[k] /= size;
        for (int k = 0; k < 3; k++)
            q[k] = n[(k + 1) % 3] * p[(k + 2) % 3] - n[(k + 2) % 3] * p[(k + 1) % 3];
        MdtContactSetNormal(c, n[0], n[1], n[2]);
        MdtContactSetDirection(c, p[0], p[1], p[2]);
        MdtContactParamsID params = MdtContactGetParams(c);
        MdtContactParamsSetType(params, MdtContactTypeFriction2D);
        MdtContactParamsSetPrimaryFriction(params, 10);
        MdtContactParamsSetSecondaryFriction(params, 2);
        MdtContactParamsSetSecondarySlide(params, 1); /* a belt along the secondary direction tells its sign */
        MdtContactEnable(c);
        MdtBodyAddForce(b, 6 * p[0] + 6 * q[0], 6 * p[1] + 6 * q[1], 6 * p[2] + 6 * q[2]);
        MdtWorldStep(w, FRAME);
        double along[2] = {0, 0};
        for (int k = 0; k < 3; k++) {
            along[0] += velocity(b, k) * p[k];
            along[1] += velocity(b, k) * q[k];
        }
        assert_near(along[0], 0, TOL(1e-6, 1e-9));
        assert_near(along[1], (6 + 2) * (double)FRAME, TOL(1e-6, 1e-9)); /* slower than the belt: it pushes too */
    }
}

/* "The direction of a 2D contact will be set automatically": when none is given, one at right angles to the normal. */
TEST(a_primary_direction_is_chosen_when_none_is_set) {
    for (int i = 0; i < NORMALS; i++) {
        Pair s = makePair(normals[i][0], normals[i][1], normals[i][2]);
        MdtContactParamsSetType(MdtContactGetParams(s.contact), MdtContactTypeFriction2D);
        MdtWorldStep(s.world, FRAME);
        MeVector3 d, n;
        MdtContactGetDirection(s.contact, d);
        MdtContactGetNormal(s.contact, n);
        assert_near((double)d[0] * d[0] + (double)d[1] * d[1] + (double)d[2] * d[2], 1, TOL(1e-5, 9e-9));
        assert_near((double)d[0] * n[0] + (double)d[1] * n[1] + (double)d[2] * n[2], 0, TOL(1e-6, 9e-9));
    }
}

/* "Sticky contacts": with MEINFINITY the contact holds whatever pulls. */
TEST(a_contact_of_infinite_adhesion_never_lets_go) {
    Pair s = makePair(0, 1, 0);
    MdtContactParamsSetMaxAdhesiveForce(MdtContactGetParams(s.contact), MEINFINITY);
    for (int i = 0; i < 60; i++) {
        MdtBodyAddForce(s.first, 0, 1e4f, 0);
        MdtBodyAddForce(s.second, 0, -1e4f, 0);
        MdtWorldStep(s.world, FRAME);
        /* a velocity that the load of 1e4 N alone would change by 1e4 h in each, to the solver's 1e-9 of that */
        assert_near(separation(&s), 0, TOL(1e-3, 2 * 1.1e-9 * 1e4 * (double)FRAME));
    }
}

/* "MdtContactSetParams: set all values in the structure at once": they are copied, so later changes of the original do
 * not count. */
TEST(set_params_copies_all_values) {
    MdtWorldID w = scene_world(1, 1, 0);
    MdtContactID c = MdtContactCreate(w);
    MdtBclContactParams own;
    MdtContactParamsReset(&own);
    MdtContactParamsSetType(&own, MdtContactTypeFriction1D);
    MdtContactParamsSetPrimaryFrictionModel(&own, MdtFrictionModelNormalForce);
    MdtContactParamsSetFrictionCoeffecient(&own, .3);
    MdtContactParamsSetFriction(&own, 4);
    MdtContactParamsSetRestitution(&own, .5);
    MdtContactParamsSetRestitutionThreshold(&own, .6);
    MdtContactParamsSetSoftness(&own, .7);
    MdtContactParamsSetMaxAdhesiveForce(&own, 8);
    MdtContactParamsSetPrimarySlip(&own, 9);
    MdtContactParamsSetSecondarySlide(&own, 10);
    MdtContactSetParams(c, &own);
    const MdtBclContactParams copy = *MdtContactGetParams(c);
    ck_assert_int_eq(copy.type, own.type);
    ck_assert_int_eq(copy.model1, own.model1);
    ck_assert_int_eq(copy.model2, own.model2);
    ck_assert_int_eq(copy.options, own.options);
    ck_assert(copy.FrictionCoefficient == own.FrictionCoefficient && copy.restitution == own.restitution);
    ck_assert(copy.velThreshold == own.velThreshold && copy.softness == own.softness);
    ck_assert(copy.max_adhesive_force == own.max_adhesive_force && copy.friction1 == own.friction1);
    ck_assert(copy.friction2 == own.friction2 && copy.slip1 == own.slip1 && copy.slip2 == own.slip2);
    ck_assert(copy.slide1 == own.slide1 && copy.slide2 == own.slide2);
    MdtContactParamsSetFriction(&own, 44);
    assert_near(MdtContactParamsGetPrimaryFriction(MdtContactGetParams(c)), 4, 0);
}
