/* UserConstraint: a function of the program writes its rows (Dynamics guide ch. 4 lists MdtUserConstraint). */
#include "bcl_i.h"
#include "MeMessage.h"
#include <string.h>

MdtKeaRow *MEAPI MdtBclAddRow(MdtKeaConstraints *list) {
    if (!list || list->numRows >= list->maxRows) {
        if (list)
            MeWarning(1, "MdtBclAddRow: the constraint has its %d rows (MdtBclGETMAXROWSUSER)", list->maxRows);
        else
            MeWarning(1, "MdtBclAddRow: the list is null");
        return NULL;
    }
    MdtKeaRow *row = &list->rows[list->numRows++];
    bcl_startRow(row, list->context);
    return row;
}

/* Has the program's function write the rows; returns their number. They are velocity rows, because the program supplies
 * no function that evaluates the position error at another pose. */
static int prepare(MdtBclConstraint *c, const MdtBclContext *x) {
    MdtBclUser *user = &c->of.user;
    MdtKeaConstraints list = {.rows = user->rows, .maxRows = MdtBclGETMAXROWSUSER, .context = x};
    const MdtKeaTransformation pose[2] = {*x->pose[0], *x->pose[1]};
    MdtKeaBody *const body[2] = {x->kea[0], x->kea[1]};
    if (user->function)
        user->function(&list, user->owner, pose, body, &x->parameters);
    MEASSERT(list.numRows >= 0 && list.numRows <= list.maxRows);
    for (int i = 0; i < list.numRows; i++)
        list.rows[i].position = list.rows[i].isSplit = list.rows[i].isTail = MEFALSE;
    return user->numRows = list.numRows;
}

static void fill(const MdtBclConstraint *c, const MdtBclContext *x, MdtKeaRow rows[]) {
    (void)x;
    memcpy(rows, c->of.user.rows, (size_t)c->of.user.numRows * sizeof *rows);
}

/* reset keeps the function of the program, which defines the constraint. */
const MdtBclType bcl_user = {.name = "UserConstraint",
                             .maxRows = MdtBclGETMAXROWSUSER,
                             .reset = bcl_resetFrames,
                             .prepare = prepare,
                             .fill = fill};
