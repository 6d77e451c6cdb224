/* Poses at the end and the middle of the step, and the motion of bodies that no row acts on. */
#include "kea_i.h"

void kea_setPoses(MdtKeaSystem *s, int i) {
    MdtKeaTransformation *end = &s->work->endPose[i], *mean = &s->work->meanPose[i];
    const MdtKeaTransformation *start = &s->pose[i];
    keaCopy(end->pos, s->work->end[i].position);
    keaQuaternionToMatrix(end->R, s->work->end[i].quaternion);
    for (int r = 0; r < 3; r++) {
        mean->pos[r] = 0.5 * (start->pos[r] + end->pos[r]);
        for (int c = 0; c < 3; c++)
            mean->R[r][c] = 0.5 * (start->R[r][c] + end->R[r][c]);
    }
}

/* Strang splitting: half of the loads, free flight and rotation, the other half of the loads. The method is of second
 * order; positions under constant forces are exact. */
void kea_moveFreeBody(MdtKeaSystem *s, int i) {
    const double h = s->parameters.stepsize;
    const MdtKeaBody *body = s->bodies[i];
    const KeaBody *b = &s->work->body[i];
    KeaEnd *end = &s->work->end[i];
    double L[3];
    for (int k = 0; k < 3; k++) {
        end->position[k] = body->position[k] + 0.5 * h * (body->velocity[k] + s->predicted[i].lin[k]);
        L[k] = 0.5 * (body->angularMomentum[k] + b->freeMomentum[k]);
    }
    end->theta = 0.5;
    keaCopy(end->velocity, s->predicted[i].lin);
    keaCopy(end->angularMomentum, b->freeMomentum);
    kea_rotateFree(body, body->quaternion, L, h, end->quaternion);
    kea_setPoses(s, i);
}

void kea_moveFreeBodies(MdtKeaSystem *s) {
    for (int i = 0; i < s->numBodies; i++)
        if (s->work->body[i].isFree)
            kea_moveFreeBody(s, i);
}
