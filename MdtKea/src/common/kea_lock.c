/* Locked axes: a body has infinite mass along them.
 *
 * Its velocity and its loads along them are 0, and so are these columns of the Jacobians that the solvers work with:
 * J M⁻¹ Jᵀ is then the one of the free axes alone, and no impulse moves the body along a locked one, not even by
 * rounding. The rows of the system keep their whole Jacobians: forces that are read back have all components.
 *
 * With ω = P ω_f, P the free rotations, the momentum L_f = Pᵀ I P ω_f obeys dL_f/dt = Pᵀ (torque), without gyroscopic
 * term. The owner gives Pᵀ I P as the body's inertia.
 */
#include "kea_i.h"
#include "common/kea_policy_i.h"

void kea_dropLockedRotations(int locked, double M[3][3]) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if ((locked >> (3 + i) & 1) || (locked >> (3 + j) & 1))
                M[i][j] = 0;
}

/* 1/kg: J M⁻¹ Jᵀ of a body, from its mass and size. */
static double mobilityOf(const MdtKeaSystem *s, int body, const double J[6]) {
    const double size = s->work->body[body].size;
    return s->bodies[body]->invMass * (keaDot(J, J) + keaDot(J + 3, J + 3) / (size * size));
}

void kea_dropLockedOfRow(const MdtKeaSystem *s, const int body[2], double (*J)[6]) {
    double all = 0, left = 0;
    for (int k = 0; k < 2; k++) {
        if (body[k] < 0)
            continue;
        all += mobilityOf(s, body[k], J[k]);
        kea_dropLocked(s->work->body[body[k]].locked, J[k]);
        left += mobilityOf(s, body[k], J[k]);
    }
    for (int i = 0; i < 12 && left < kea_minMobility * all; i++)
        J[i / 6][i % 6] = 0;
}

MeBool kea_isContactLocked(const MdtKeaSystem *s, const MdtKeaManifold *m, const double arm[2][3]) {
    double J[2][6];
    if (!s->work->hasLocks)
        return MEFALSE;
    for (int k = 0; k < 2; k++) {
        keaScale(J[k], k == 0 ? 1 : -1, m->normal);
        keaCross(J[k] + 3, arm[k], J[k]);
    }
    kea_lockRow(s, m->body, J);
    for (int k = 0; k < 2; k++)
        if (m->body[k] >= 0 && mobilityOf(s, m->body[k], J[k]) > 0)
            return MEFALSE;
    return METRUE;
}
