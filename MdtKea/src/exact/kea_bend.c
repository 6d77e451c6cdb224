/* Bends: how the direction of an angular row turns as its bodies do.
 *
 * The angle between two axes, which a cone limits, has a gradient that turns with them: on a cone of half angle c by
 * 1/c rad for each rad along its rim. So an impulse p that holds an axis on the rim resists displacements along it with
 * the stiffness p cot c, the Hessian of the angle: that of a pendulum in a narrow bowl. Passes without it diverge where
 * it is above the inertia, as for light links with heavy ends and narrow cones.
 *
 * It couples both bodies, so that it is no part of the metric. The inner problem gets a row along the rim for it,
 * behind those of the system, which resists the change d of a pass:
 *
 *     b d + E p = 0,   1/E = h/2 p_row curvature       since the mean pose turns by half of h d
 *
 * Its impulse is forgotten after each pass: bends change the way to the answer, and not the answer.
 */
#include "kea_i.h"
#include "MeAssert.h"
#include <string.h>

static MeBool bends(const MdtKeaRow *row) {
    return row->position && row->curvature > 0;
}

void kea_beginBends(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    q->numRows = s->numRows;
    for (int i = 0; i < s->numRows; i++) {
        if (!bends(&s->rows[i]))
            continue;
        MEASSERT(q->numRows < s->maxRows);
        KeaProblemRow *p = &q->row[q->numRows++];
        const int edge = p->edge; /* of kea_problemBegin */
        memset(p, 0, sizeof *p);
        p->edge = edge;
        p->body[0] = s->rows[i].body[0];
        p->body[1] = s->rows[i].body[1];
        p->normal = p->partner = -1;
        p->lower = -HUGE_VAL;
        p->upper = HUGE_VAL;
        p->state = KEA_ACTIVE;
        p->isInactive = p->isCheckedElsewhere = METRUE;
        p->bent = i;
    }
}

void kea_linearizeBends(MdtKeaSystem *s) {
    KeaProblem *q = &s->work->problem;
    for (int n = s->numRows; n < q->numRows; n++) {
        KeaProblemRow *p = &q->row[n];
        const MdtKeaRow *row = &s->rows[p->bent];
        const double stiffness = 0.5 * s->parameters.stepsize * q->row[p->bent].p * row->curvature;
        for (int k = 0; k < 2; k++) {
            keaZero(p->J[k]);
            keaCopy(p->J[k] + 3, row->bend[k]);
        }
        kea_lockRow(s, p->body, p->J);
        p->isInactive = !(stiffness > 0);
        p->E = p->isInactive ? 0 : 1 / stiffness;
        p->p = p->p0 = p->r = p->Jd = 0;
    }
}

void kea_disableBends(MdtKeaSystem *s) {
    for (int n = s->numRows; n < s->work->problem.numRows; n++)
        s->work->problem.row[n].isInactive = METRUE;
}
