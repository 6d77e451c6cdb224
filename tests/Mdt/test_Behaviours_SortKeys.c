/* Documented behaviours: sort keys and determinism (Dynamics guide ch. 4, "Sort Keys - Deterministic Simulation").
 *
 * Already proved elsewhere:
 *   same start, same order of data: identical results   test_World: the_same_scene_gives_the_same_bits
 *   removing and adding again may change the order; sort keys restore it
 *                                                        test_World: the_same_scene_gives_the_same_bits
 *                                                        test_World: bodies_and_constraints_are_walked_in_the_order_...
 *   ranges of the keys of collision models               (belongs to collision)
 */
#include "behaviour.h"

#define EVERY_TYPE(X)                                                                                                  \
    X(Angular3)                                                                                                        \
    X(BSJoint)                                                                                                         \
    X(CarWheel)                                                                                                        \
    X(ConeLimit)                                                                                                       \
    X(FPFOJoint)                                                                                                       \
    X(FixedPath)                                                                                                       \
    X(Hinge)                                                                                                           \
    X(Linear1)                                                                                                         \
    X(Linear2)                                                                                                         \
    X(Prismatic)                                                                                                       \
    X(RPROJoint)                                                                                                       \
    X(Spring)                                                                                                          \
    X(Universal)                                                                                                       \
    X(UserConstraint)                                                                                                  \
    X(Spring6)                                                                                                         \
    X(Skeletal)                                                                                                        \
    X(Gear)                                                                                                            \
    X(Pulley)                                                                                                          \
    X(Mimic)                                                                                                           \
    X(Contact)                                                                                                         \
    X(ContactGroup)

/* Keys are not negative: such a key gets a warning and changes nothing. */
TEST(keys_lie_between_0_and_two_to_the_31_minus_1) {
    MdtWorldID w = scene_world(1, 21, 0);
    MdtBodyID b = MdtBodyCreate(w);
    MdtBodySetSortKey(b, 2147483647);
    assert_silent();
    MdtBodySetSortKey(b, -1);
    assert_warned("sort key");
    ck_assert_int_eq(MdtBodyGetSortKey(b), 2147483647);
#define NOT_NEGATIVE(Type)                                                                                             \
    {                                                                                                                  \
        Mdt##Type##ID j = Mdt##Type##Create(w);                                                                        \
        Mdt##Type##SetSortKey(j, 2147483647);                                                                          \
        assert_silent();                                                                                               \
        Mdt##Type##SetSortKey(j, -2147483647);                                                                         \
        assert_warned("sort key");                                                                                     \
        ck_assert_int_eq(Mdt##Type##GetSortKey(j), 2147483647);                                                        \
    }
    EVERY_TYPE(NOT_NEGATIVE)
}

/* Five contacts under one body, made anew before every step in one order or in another. */
static void runPile(MeBool reversed, MeBool keyed, MeReal out[2][4]) {
    MdtWorldID w = scene_world(2, 8, 10);
    MdtBodyID b = scene_body(w, 1, 0, 0, 0);
    MdtContactID made[5] = {0};
    for (int i = 0; i < 300; i++) {
        for (int k = 0; k < 5; k++)
            if (made[k])
                MdtContactDestroy(made[k]);
        for (int k = 0; k < 5; k++) {
            const int at = reversed ? 4 - k : k;
            made[at] = scene_contact(w, b, 0, at - 1.7, 0, .3 * at * at - 1);
            MdtContactSetPenetration(made[at], .001 * at);
            MdtContactParamsSetType(MdtContactGetParams(made[at]), MdtContactTypeFriction2D);
            MdtContactParamsSetFriction(MdtContactGetParams(made[at]), 1);
            if (keyed)
                MdtContactSetSortKey(made[at], at);
        }
        MdtBodyAddForce(b, sin(.1 * i), 0, 2);
        MdtWorldStep(w, FRAME);
    }
    MdtBodyGetQuaternion(b, out[0]);
    MdtBodyGetPosition(b, out[1]);
}

/* Removing contacts and adding them in another order changes the last digits; with sort keys not a bit. */
TEST(sort_keys_restore_the_order_of_contacts_added_again) {
    MeReal first[2][4] = {{0}}, again[2][4] = {{0}}, other[2][4] = {{0}};
    runPile(0, 1, first);
    runPile(0, 1, again);
    runPile(1, 1, other);
    ck_assert_msg(memcmp(first, again, sizeof first) == 0, "the same order gives other bits");
    ck_assert_msg(memcmp(first, other, sizeof first) == 0,
                  "another order of creation with the same keys gives other bits");
    runPile(1, 0, other); /* without keys it is nearly the same */
    for (int i = 0; i < 3; i++)
        assert_near(other[1][i], first[1][i], TOL(1e-7, 1e-14));
}
