/* How much is spent on a picture: levels, and the choice of one so that 30 frames a second hold.
 *
 * The choice is a pure function of the times that it is given: frames that take too long, if it is drawing that takes
 * it, lower the level; frames so short that the next level cannot make them late raise it again.
 */
#include "r_i.h"

/* One step up costs at most 1.9 times as much, whatever share of the cost depends on pixels: .55^2 to .75^2 is 1.86,
 * .75^2 to 1 is 1.78, and four samples for one have been measured at 1.3 (Stack) to 1.9 (Car) in software. */
const RQualityLevel r_qualityLevels[R_QUALITY_FULL + 1] = {
    {1, 512, 106, .55f, false}, {1, 512, 144, .75f, false}, {1, 1024, 192, 1, false}, {4, 1024, 192, 1, true}};

/* ns. A frame of 1/30 s is late. One that is 1.9 times as short is not made late by the next level; in a window that
 * waits for the screen, frames of 1/60 s have to count as that short. */
enum { LATE = 33333333, SHORT = 17500000 };
/* ns. A window's frames begin no less than 1/60 s apart. */
enum { PERIOD = 16666667 };
/* ns, as which what takes longer counts: five such frames are no hiccup any more, one is. */
enum { HICCUP = 100000000 };
/* ns, over which frames are averaged, and after which the level is lowered: with HICCUP, no single frame does it. */
enum { WINDOW = 500000000 };
/* ns: how long frames have to be short at first. */
enum { RAISE_AFTER = 2000000000 };
/* A raise that was a mistake doubles the time to the next one, up to so many times. */
enum { MAX_PATIENCE = 32 };

void r_qualityRestart(RQuality *q) {
    *q = (RQuality){.level = R_QUALITY_FULL, .patience = 1};
}

static void change(RQuality *q, int by) {
    if (by < 0 && q->raised && q->patience < MAX_PATIENCE)
        q->patience *= 2;
    *q = (RQuality){.level = q->level + by, .patience = q->patience, .raised = by > 0, .isNew = true};
}

static void add(RQuality *q, int64_t frame, int64_t drawing) {
    const int64_t counted = frame < PERIOD ? PERIOD : frame < HICCUP ? frame : HICCUP;
    q->frames++;
    q->elapsed += counted;
    q->drawing += drawing < counted ? drawing : counted;
}

static void chooseLevel(RQuality *q) {
    const bool late = q->elapsed > q->frames * (int64_t)LATE, isShort = q->elapsed < q->frames * (int64_t)SHORT;
    /* Where drawing takes less than half, a lower level saves too little to be worth its look. */
    const bool helps = 2 * q->drawing > q->elapsed;
    q->shortFor = isShort ? q->shortFor + q->elapsed : 0;
    q->frames = 0;
    q->elapsed = q->drawing = 0;
    if (late && helps && q->level > 0)
        change(q, -1);
    else if (q->shortFor >= q->patience * (int64_t)RAISE_AFTER && q->level < R_QUALITY_FULL)
        change(q, 1);
    else
        q->raised = false; /* It has proved right. */
}

void r_qualityFrame(RQuality *q, int64_t frame, int64_t drawing) {
    if (q->isNew) { /* Its buffers and shaders have just been made. */
        q->isNew = false;
        return;
    }
    add(q, frame, drawing);
    if (q->elapsed >= WINDOW)
        chooseLevel(q);
}

static bool isAutomatic(const RRender *rc) {
    return r_pictureQuality(rc) == R_QUALITY_AUTO;
}

int r_pictureQuality(const RRender *rc) {
    return rc->m_Options.m_bQuality ? rc->m_Options.m_nQuality : rc->m_pViewer->pictureQuality;
}

/* What is drawn into files, or not seen, does not depend on the clock. */
int r_qualityLevel(const RRender *rc) {
    const struct RViewer *v = rc->m_pViewer;
    if (!isAutomatic(rc))
        return v->backend->window ? r_pictureQuality(rc) : R_QUALITY_FULL;
    return r_isByClock(rc) && !v->loop.saving ? v->quality.level : R_QUALITY_FULL;
}

void MEAPI RRenderSetPictureQuality(RRender *rc, int quality) {
    if (!r_isContext(rc, __func__))
        return;
    if (quality < R_QUALITY_AUTO || quality > R_QUALITY_FULL) {
        MeWarning(1, "%s: quality is %d: it must be %d to %d", __func__, quality, R_QUALITY_AUTO, R_QUALITY_FULL);
        return;
    }
    rc->m_pViewer->pictureQuality = quality;
    r_qualityRestart(&rc->m_pViewer->quality);
}

int MEAPI RRenderGetPictureQuality(RRender *rc) {
    return r_isContext(rc, __func__) && rc->m_pViewer->backend ? r_qualityLevel(rc) : R_QUALITY_FULL;
}
