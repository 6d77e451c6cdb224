/* How many ticks a frame has, so that simulated time follows the clock though frames take as long as they take.
 *
 * Time that has passed is owed to the simulation, in ticks of 1 / rate seconds. A frame pays what it can: where ticks
 * alone would take longer than BUDGET, the rest is forgotten, and the simulation is slower than the clock, which the
 * window says ("x0.4"). A pure function of the times it is given: the loop reads the clock.
 */
#include "r_i.h"

/* ns. Frames that are not late begin 1/60 s apart, and count as that much: no frame has two ticks and the next one none
 * because threads wake a little early or late. */
enum { FRAME = 16666667 };
/* ns of ticks in a frame: with as much for drawing, 15 frames a second, the least that a hand can steer by. */
enum { BUDGET = 33333333 };
/* ns that a frame owes at most: what takes longer is a window or a process that stood still, and not to be caught up
 * with; nobody steers by 4 frames a second. */
enum { STALL = 250000000 };
/* ns over which the pace is measured. */
enum { SECOND = 1000000000 };

void r_clockRestart(RClock *c, int64_t now) {
    *c = (RClock){.last = now, .measuredFrom = now, .pace = 1};
}

static void measure(RClock *c, int64_t now) {
    const int64_t elapsed = now - c->measuredFrom;
    if (elapsed < SECOND)
        return;
    c->pace = c->paid / (double)elapsed;
    c->paid = 0;
    c->measuredFrom = now;
}

void r_clockFrame(RClock *c, int64_t now) {
    const int64_t passed = now - c->last < FRAME + FRAME / 2 ? FRAME : now - c->last;
    c->last = passed == FRAME ? c->last + FRAME : now;
    c->owed += (double)(passed < STALL ? passed : STALL);
    c->begun = now;
    measure(c, now);
}

bool r_clockCountTicks(RClock *c, int64_t now, double rate) {
    const double tick = 1e9 / rate;
    if (c->owed < tick * (1 - 1e-6))
        return false;
    if (now - c->begun > BUDGET) {
        c->owed = 0;
        return false;
    }
    c->owed -= tick;
    c->paid += tick;
    return true;
}
