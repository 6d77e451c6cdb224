/* FixedPath: a ball and socket whose attachments are moved by the program (Dynamics guide ch. 3, "MdtFixedPath").
 *
 *     φ = P_0 - P_1,   dP_k/dt = v_k + ω_k x r_k + R_k u_k,   u_k the attachment's velocity in body k.
 *
 * The rows are those of the ball and socket with the target -γ φ / h - (R_0 u_0 - R_1 u_1). If the program sets the
 * velocities u, the bodies follow the attachments without lag and the forces are those of the motion; else they lag,
 * pulled by γ.
 */
#include "bcl_i.h"
#include <string.h>

static void reset(MdtBclConstraint *c) {
    bcl_resetFrames(c);
    memset(&c->of.path, 0, sizeof c->of.path);
}

/* u = R_0 u_0 - R_1 u_1: the relative velocity of the attachments, world. */
static void pathVelocity(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double u[3]) {
    double other[3];
    keaApply(u, pose[0]->R, c->of.path.velocity[0]);
    keaApply(other, pose[1]->R, c->of.path.velocity[1]);
    keaSubtract(u, u, other);
}

/* The program sets the attachment points at the start of the step; for later sub-steps they are advanced by u. */
static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    MdtBclPath *path = &c->of.path;
    for (int k = 0; k < 2; k++) {
        if (x->elapsed == 0)
            keaCopy(path->place[k], c->frame[k].position);
        keaCopy(c->frame[k].position, path->place[k]);
        keaAddScaled(c->frame[k].position, x->elapsed, path->velocity[k]);
    }
    path->stepsize = x->parameters.stepsize;
    MEASSERT(path->stepsize > 0);
    pathVelocity(c, x->pose, path->start);
    return 3;
}

/* φ at these poses with the attachment points advanced by h u, less h (R_0 u_0 - R_1 u_1) of the start, which is in the
 * targets already: of the displacement, h times the change of R_0 u_0 - R_1 u_1 remains. */
static void errors(const MdtBclConstraint *c, const MdtKeaTransformation *const pose[2], double e[]) {
    double u[3];
    pathVelocity(c, pose, u);
    keaSubtract(u, u, c->of.path.start);
    bcl_separation(c, pose, e);
    keaAddScaled(e, c->of.path.stepsize, u);
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    bcl_pointRows(c, x, rows);
    for (int i = 0; i < 3; i++)
        rows[i].target -= c->of.path.start[i], rows[i].drift -= c->of.path.start[i];
}

static void readBack(MdtBclConstraint *c, const MdtBclContext *x, const MdtKeaRow rows[]) {
    (void)x, (void)rows;
    for (int k = 0; k < 2; k++)
        keaCopy(c->frame[k].position, c->of.path.place[k]);
}

const MdtBclType bcl_fixedPath = {.name = "FixedPath",
                                  .maxRows = MdtBclGETMAXROWSFIXEDPATH,
                                  .reset = reset,
                                  .prepare = prepare,
                                  .fill = fill,
                                  .errors = errors,
                                  .readBack = readBack};
