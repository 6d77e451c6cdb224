/* The inertia of bodies with locked rotations: that between the free ones, in world axes. */
#include "record/mdt_record_i.h"

/* Replaces a tensor in the body's axes by that in world axes at the attitude q. */
static void turnTensor(const double q[4], double inertia[3][3]) {
    double R[3][3], half[3][3];
    keaQuaternionToMatrix(R, q);
    for (int i = 0; i < 3; i++)
        keaApply(half[i], (const double(*)[3])inertia, R[i]); /* row i: (I Rᵀ)ᵀ, as I is symmetric */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++)
            inertia[i][j] = inertia[j][i] = keaDot(half[i], R[j]);
}

/* The entries of locked axes do not act. They get the mean moment of the free ones, so that the body with one of these
 * is a ball to Kea, whose inertia has no axes that rounding could turn. */
void mdt_lockInertia(int rotations, const double q[4], double inertia[3][3]) {
    double mean = 0;
    int free = 0;
    turnTensor(q, inertia);
    for (int i = 0; i < 3; i++)
        if (rotations == 7 || !(rotations >> i & 1))
            mean += inertia[i][i], free++;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if ((rotations >> i & 1) || (rotations >> j & 1))
                inertia[i][j] = i == j ? mean / free : 0;
}
