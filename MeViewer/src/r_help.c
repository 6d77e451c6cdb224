/* The help: the program's own lines, then the viewer's keys, in a panel that fits into the window. */
#include "r_i.h"

#include <stdio.h>
#include <string.h>

typedef enum { rTitle, rHeading, rKeyed, rWhole } RowKind;

/* The title, a heading, a key with its text (or a text going on under it), or a text over the whole width. */
typedef struct {
    RowKind kind;
    bool goesOn; /* The row before is the beginning of it. */
    char key[48], text[112];
} Row;

enum { MAX_ROWS = 256, MAX_COLUMNS = 4 };

typedef struct {
    size_t wrap;            /* Bytes of text that a row may have. */
    Row rows[MAX_ROWS + 1]; /* The last one takes what is too much. */
    int count;
} Page;

static const struct {
    const char *key, *text;
} viewerKeys[] = {
    {"View", NULL},
    {"Drag", "orbit"},
    {"Ctrl+drag", "orbit"}, /* Instead, if the program has the mouse. */
    {"Right drag, wheel", "zoom"},
    {"Middle or Shift drag", "pan"},
    {"Ctrl+arrows", "orbit"},
    {"PgUp, PgDn", "zoom"},
    {"Home", "first view"},
    {"Run", NULL},
    {"P", "pause, continue"},
    {"O", "one step"},
    {"Esc, Q", "quit"},
    {"Show", NULL},
    {"F1", "this help, pause"},
    {"F2", "save a picture"},
    {"F3", "performance bar"},
    {"F4", "wireframe"},
    {"F5", "shadows"},
    {"F9", "menu"},
};

void r_helpFree(RHelp *help) {
    for (size_t i = 0; i < help->lines.count; i++)
        r_free(help->lines.items[i]);
    help->lines.count = 0;
    r_free(help->lines.items);
    help->lines.items = NULL;
    help->lines.capacity = 0;
}

void MEAPI(RRenderCreateUserHelp)(RRender *const rc, const char *const help[], const int arraySize) {
    if (!r_isContext(rc, __func__))
        return;
    if (arraySize < 0 || (arraySize > 0 && !help)) {
        MeWarning(1, "%s: %d lines%s", __func__, arraySize, help ? "" : ", and help is null");
        return;
    }
    RHelp *h = &rc->m_pViewer->help;
    r_helpFree(h);
    if (!r_grow(h->lines, (size_t)arraySize))
        return;
    for (int i = 0; i < arraySize; i++)
        if (r_isPointer(help[i], __func__, "a line"))
            h->lines.items[h->lines.count++] = r_copyText(help[i]);
}

void MEAPI RRenderToggleUserHelp(RRender *const rc) {
    if (!r_isContext(rc, __func__))
        return;
    RHelp *h = &rc->m_pViewer->help;
    rc->m_bShowHelp = !rc->m_bShowHelp;
    if (rc->m_bShowHelp) {
        h->wasPaused = rc->m_bPause;
        rc->m_bPause = 1;
    } else {
        rc->m_bPause = h->wasPaused;
    }
}

static Row *addRow(Page *page, RowKind kind, const char *key, const char *text, size_t length) {
    Row *row = &page->rows[page->count];
    row->kind = kind;
    row->goesOn = false;
    snprintf(row->key, sizeof row->key, "%s", key);
    snprintf(row->text, sizeof row->text, "%.*s", (int)length, text);
    page->count += page->count < MAX_ROWS;
    return row;
}

static void addHeading(Page *page, RowKind kind, const char *text) {
    addRow(page, kind, "", text, strlen(text));
}

/* How much of a text fits into a row: up to a space, or up to the end of a character. */
static size_t rowLength(const char *text, size_t wrap) {
    size_t length = strlen(text);
    if (length <= wrap)
        return length;
    for (length = wrap; length > 0 && text[length] != ' ';)
        length--;
    if (length > 0)
        return length;
    for (length = wrap; ((unsigned char)text[length] & 0xc0) == 0x80;)
        length--;
    return length > 0 ? length : wrap;
}

/* A text, under a key unless that is "", broken between words into as many rows as it needs. */
static void addText(Page *page, const char *key, const char *text) {
    const RowKind kind = *key ? rKeyed : rWhole;
    const char *const begin = text;
    do {
        const size_t length = rowLength(text, page->wrap);
        addRow(page, kind, key, text, length)->goesOn = text != begin;
        text += length;
        text += strspn(text, " ");
        key = "";
    } while (*text);
}

/* A line such as "Space - reset" or "Enter: jump" is a key and a text. */
static void addLine(Page *page, const char *line) {
    static const char *const marks[] = {" - ", ": ", "\t"};
    char key[48];
    for (size_t i = 0; i < sizeof marks / sizeof marks[0]; i++) {
        const char *mark = strstr(line, marks[i]);
        if (mark && mark > line && mark - line < 24) {
            snprintf(key, sizeof key, "%.*s", (int)(mark - line), line);
            const char *text = mark + strlen(marks[i]);
            addText(page, key, text + strspn(text, " \t"));
            return;
        }
    }
    addText(page, "", line);
}

/* What the setters with a text were told. */
static void addCallBacks(const RRender *rc, Page *page) {
    static const int keys[kRButtons] = {RKEY_UP, RKEY_DOWN, RKEY_LEFT, RKEY_RIGHT, 'w', 's', 'a', 'd'};
    char key[48];
    for (int i = 0; i < kRButtons + NUM_ACTION_CALLBACKS; i++) {
        const bool action = i >= kRButtons;
        const RCallBackDataButton *b = action ? &rc->m_CallBacks.m_Action[i - kRButtons] : &rc->m_CallBacks.m_Button[i];
        if (!b->m_Text[0])
            continue;
        r_keyName(action ? rc->m_pViewer->input.actionKey[i - kRButtons] : keys[i], key, sizeof key);
        addText(page, key, b->m_Text);
    }
    if (rc->m_CallBacks.m_Mouse.m_Text[0])
        addText(page, "Left mouse button", rc->m_CallBacks.m_Mouse.m_Text);
}

static const char *title(const RRender *rc) {
    const bool named = strcmp(rc->m_AppName, r_programName()) != 0;
    return !named && rc->m_pViewer->title ? rc->m_pViewer->title : rc->m_AppName;
}

/* What is left of a key of the viewer's when an action of the program has its letter; null for nothing. */
static const char *remainingKey(const RRender *rc, const char *key) {
    static const struct {
        const char *key;
        int letter;
        const char *rest;
    } letters[] = {{"P", 'p', NULL}, {"O", 'o', "."}, {"Esc, Q", 'q', "Esc"}};
    for (size_t i = 0; i < sizeof letters / sizeof letters[0]; i++)
        if (strcmp(letters[i].key, key) == 0 && r_actionOfKey(rc, letters[i].letter))
            return letters[i].rest;
    return key;
}

static void fillPage(RRender *rc, Page *page, size_t wrap) {
    const RHelp *h = &rc->m_pViewer->help;
    char line[512];
    page->wrap = wrap;
    page->count = 0;
    addHeading(page, rTitle, title(rc));
    for (size_t i = 0; i < h->lines.count; i++) {
        RParseText(rc, h->lines.items[i], line, sizeof line);
        addLine(page, line);
    }
    addCallBacks(rc, page);
    if (page->count == 1)
        addText(page, "", "This program has no keys of its own.");
    for (size_t i = 0; i < sizeof viewerKeys / sizeof viewerKeys[0]; i++) {
        const bool ctrl = strcmp(viewerKeys[i].key, "Ctrl+drag") == 0, drag = strcmp(viewerKeys[i].key, "Drag") == 0;
        const char *key = remainingKey(rc, viewerKeys[i].key);
        if ((rc->m_CallBacks.m_Mouse.m_Func ? drag : ctrl) || !key)
            continue;
        if (viewerKeys[i].text)
            addText(page, key, viewerKeys[i].text);
        else
            addHeading(page, rHeading, viewerKeys[i].key);
    }
}

/* The measures of one column, in ems. */
typedef struct {
    int first, count; /* Rows. */
    float key, width, height;
} Column;

static const float rowHeight = 1.42f, titleHeight = 1.8f, titleSize = 1.25f, headingGap = 0.55f, keyGap = 1.0f,
                   columnGap = 2.0f, padding = 1.2f;

/* Where a row begins, or, for the one after the last, where the column ends. */
static float rowTop(const Page *page, const Column *c, int row) {
    float y = 0;
    for (int i = c->first; i < row; i++)
        y += page->rows[i].kind == rTitle ? titleHeight : rowHeight;
    for (int i = c->first + 1; i <= row && i < c->first + c->count; i++)
        y += page->rows[i].kind == rHeading ? headingGap : 0;
    return y;
}

static void measure(const Page *page, Column *c) {
    float text = 0, whole = 0;
    c->key = 0;
    for (int i = c->first; i < c->first + c->count; i++) {
        const Row *row = &page->rows[i];
        const float width = r_textWidth(row->text, row->kind == rTitle ? titleSize : 1);
        if (row->kind == rKeyed) {
            c->key = fmaxf(c->key, r_textWidth(row->key, 1));
            text = fmaxf(text, width);
        } else {
            whole = fmaxf(whole, width);
        }
    }
    c->width = fmaxf(whole, c->key > 0 ? c->key + keyGap + text : 0);
    c->height = rowTop(page, c, c->first + c->count);
}

/* How bad it is to begin a column with a row, in rows of difference that it would be better to bear. */
static float breakCost(const Page *page, int row) {
    if (page->rows[row].goesOn || page->rows[row - 1].kind == rHeading || page->rows[row - 1].kind == rTitle)
        return INFINITY;
    return page->rows[row].kind == rHeading ? 0 : 2.5f;
}

/* Where a column that begins with a row ends, best near the goal. */
static int columnEnd(const Page *page, int first, float goal) {
    float best = INFINITY;
    int end = page->count;
    for (int i = first + 1; i < page->count; i++) {
        const float cost = fabsf((float)i - goal) + breakCost(page, i);
        if (cost < best) {
            best = cost;
            end = i;
        }
    }
    return end;
}

/* Splits the rows into columns, each about as high as the others. Returns their number. */
static int split(const Page *page, int wanted, Column *columns) {
    int n = 0;
    for (int first = 0; first < page->count && n < wanted; n++) {
        const float goal = (float)page->count * (float)(n + 1) / (float)wanted;
        const int end = n < wanted - 1 ? columnEnd(page, first, goal) : page->count;
        columns[n] = (Column){.first = first, .count = end - first};
        measure(page, &columns[n]);
        first = end;
    }
    return n;
}

static void panelSize(const Column *columns, int n, float *width, float *height) {
    *width = 2 * padding + columnGap * (float)(n - 1);
    *height = 0;
    for (int i = 0; i < n; i++) {
        *width += columns[i].width;
        *height = fmaxf(*height, columns[i].height);
    }
    *height += 2 * padding;
}

static void drawColumn(ROverlay *overlay, const Page *page, const Column *c, float left, float top, float size) {
    for (int i = c->first; i < c->first + c->count; i++) {
        const Row *row = &page->rows[i];
        const float y = roundf(top + (rowTop(page, c, i) + 1) * size);
        const float x = row->kind == rKeyed ? left + (c->key + keyGap) * size : left;
        r_overlayText(overlay, left, y, size, rTextPlain, r_white, row->key);
        r_overlayText(overlay, x, y, row->kind == rTitle ? titleSize * size : size, rTextPlain,
                      row->kind == rHeading ? r_accent : r_white, row->text);
    }
}

/* Of all ways to break lines and to make columns, the one that allows the largest text. Returns its size. */
static float layOut(RRender *rc, Page *page, int *wanted) {
    static const size_t wraps[] = {56, 40, 28, 22};
    const float preferred = 15 * r_uiScale(rc), roomX = 0.96f * (float)rc->m_pViewer->width,
                roomY = 0.96f * (float)rc->m_pViewer->height;
    float size = 0;
    size_t wrap = wraps[0];
    *wanted = 1;
    for (size_t w = 0; w < sizeof wraps / sizeof wraps[0]; w++) {
        fillPage(rc, page, wraps[w]);
        for (int n = 1; n <= MAX_COLUMNS; n++) {
            Column columns[MAX_COLUMNS];
            float width, height;
            panelSize(columns, split(page, n, columns), &width, &height);
            const float fits = fminf(preferred, fminf(roomX / width, roomY / height));
            if (fits > size) {
                size = fits;
                wrap = wraps[w];
                *wanted = n;
            }
        }
    }
    fillPage(rc, page, wrap);
    return size;
}

void r_helpDraw(RRender *rc, ROverlay *overlay, RHelpLayout *layout) {
    const struct RViewer *v = rc->m_pViewer;
    Page page;
    Column columns[MAX_COLUMNS];
    int wanted;
    float width, height;
    const float size = layOut(rc, &page, &wanted);
    const int used = split(&page, wanted, columns);
    panelSize(columns, used, &width, &height);

    const float left = roundf(((float)v->width - width * size) / 2);
    const float top = roundf(((float)v->height - height * size) / 2);
    *layout = (RHelpLayout){left, top, left + width * size, top + height * size, size};
    r_overlayBox(overlay, left, top, width * size, height * size, 0.6f * size, r_panel);
    float x = left + padding * size;
    for (int i = 0; i < used; i++) {
        drawColumn(overlay, &page, &columns[i], x, top + padding * size, size);
        x += (columns[i].width + columnGap) * size;
    }
}
