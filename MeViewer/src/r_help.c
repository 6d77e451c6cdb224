/* The help: the program's own lines, then the viewer's keys, in as many columns as fit into the window. */
#include "r_i.h"

#include <stdio.h>
#include <string.h>

typedef enum { rTitle, rHeading, rKeyed, rWhole } RowKind;

/* The title, a heading, a key with its text, or a text over the whole width. */
typedef struct {
    RowKind kind;
    char key[48], text[512];
    float height; /* Of its text, wrapped. */
    int column;
} Row;

enum { MAX_ROWS = 128, MAX_COLUMNS = 4 };

typedef struct {
    Row rows[MAX_ROWS + 1]; /* The last one takes what is too much. */
    int count;
} Page;

static const struct {
    const char *key, *text;
} viewerKeys[] = {
    {"View", NULL},
    {"Drag", "orbit"},
    {"Ctrl+drag", "orbit"}, /* Instead, if the program has the mouse. */
    {"Right or Shift drag", "pan"},
    {"Wheel", "zoom to the pointer"},
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
    {"F9", "menu and panels"},
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

static void addRow(Page *page, RowKind kind, const char *key, const char *text) {
    Row *row = &page->rows[page->count];
    row->kind = kind;
    snprintf(row->key, sizeof row->key, "%s", key);
    snprintf(row->text, sizeof row->text, "%s", text);
    page->count += page->count < MAX_ROWS;
}

static void addText(Page *page, const char *key, const char *text) {
    addRow(page, *key ? rKeyed : rWhole, key, text);
}

/* What stands before " - " or a tab names keys. A colon is in sentences too: a key before it is one word. */
static bool isKey(const char *line, const char *mark) {
    return mark > line && mark - line < 24 && (*mark != ':' || !memchr(line, ' ', (size_t)(mark - line)));
}

/* A line such as "Space - reset" or "Enter: jump" is a key and a text. */
static void addLine(Page *page, const char *line) {
    static const char *const marks[] = {" - ", "\t", ": "};
    char key[48];
    for (size_t i = 0; i < sizeof marks / sizeof marks[0]; i++) {
        const char *mark = strstr(line, marks[i]);
        if (mark && isKey(line, mark)) {
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
    const RInput *in = &rc->m_pViewer->input;
    for (size_t i = 0; i < in->extraKeys.count; i++) {
        if (!in->extraKeys.items[i].button.m_Text[0] || !r_keyIsFree(rc, in->extraKeys.items[i].key))
            continue;
        r_keyName(in->extraKeys.items[i].key, key, sizeof key);
        addText(page, key, in->extraKeys.items[i].button.m_Text);
    }
    if (rc->m_CallBacks.m_Mouse.m_Text[0])
        addText(page, "Left mouse button", rc->m_CallBacks.m_Mouse.m_Text);
}

/* What parameters have of keys. */
static void addParameters(const RRender *rc, Page *page) {
    const RParameters *list = &rc->m_pViewer->parameters;
    char keys[48], text[256];
    for (size_t i = 0; i < list->count; i++) {
        r_parameterKeys(&list->items[i], keys, sizeof keys);
        r_parameterText(&list->items[i], text, sizeof text);
        if (*keys)
            addText(page, keys, text);
    }
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

static void fillPage(RRender *rc, Page *page) {
    const RHelp *h = &rc->m_pViewer->help;
    char line[512];
    page->count = 0;
    addRow(page, rTitle, "", title(rc));
    for (size_t i = 0; i < h->lines.count; i++) {
        RParseText(rc, h->lines.items[i], line, sizeof line);
        addLine(page, line);
    }
    addParameters(rc, page);
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
            addRow(page, rHeading, "", viewerKeys[i].key);
    }
}

/* In ems. */
static const float lineHeight = 1.36f, titleSize = 1.25f, headingGap = 0.55f, keyGap = 1.0f, columnGap = 2.0f,
                   padding = 1.2f;

typedef struct {
    int columns;
    float size; /* Pixels of an em. */
    float key[MAX_COLUMNS], text[MAX_COLUMNS], width, height;
} Layout;

static float sizeOf(const Row *row, float size) {
    return row->kind == rTitle ? titleSize * size : size;
}

/* Where rows begin below the one before. */
static float gapAbove(const Row *row, float size, bool first) {
    return row->kind == rHeading && !first ? headingGap * size : 0;
}

/* Rows into columns of at most a height, in their order; a heading stays with what follows. False if there are too
 * many. */
static bool fill(Page *page, Layout *l, float max) {
    int column = 0;
    float y = 0;
    l->height = 0;
    for (int i = 0; i < page->count; i++) {
        Row *row = &page->rows[i];
        const bool leads = row->kind == rHeading && i + 1 < page->count;
        const float needed = row->height + gapAbove(row, l->size, y == 0) + (leads ? page->rows[i + 1].height : 0);
        if (y > 0 && y + needed > max) {
            column++;
            y = 0;
        }
        if (column >= l->columns)
            return false;
        row->column = column;
        y += row->height + gapAbove(row, l->size, y == 0);
        l->height = fmaxf(l->height, y);
    }
    return l->height <= max;
}

/* How wide the columns are; a text is no wider than `wrap`. */
static void measureColumns(const Page *page, Layout *l, float wrap) {
    float whole[MAX_COLUMNS] = {0};
    memset(l->key, 0, sizeof l->key);
    memset(l->text, 0, sizeof l->text);
    for (int i = 0; i < page->count; i++) {
        const Row *row = &page->rows[i];
        const float width = fminf(wrap, r_uiTextSize(row->text, sizeOf(row, l->size), wrap, NULL));
        float *const widest = row->kind == rKeyed ? l->text : whole;
        widest[row->column] = fmaxf(widest[row->column], ceilf(width));
        l->key[row->column] = fmaxf(l->key[row->column], ceilf(r_uiTextSize(row->key, l->size, 0, NULL)));
    }
    l->width = columnGap * l->size * (float)(l->columns - 1);
    for (int c = 0; c < l->columns; c++) {
        l->key[c] += l->key[c] > 0 ? keyGap * l->size : 0;
        l->text[c] = fmaxf(l->text[c], whole[c] - l->key[c]);
        l->width += l->key[c] + l->text[c];
    }
}

/* With columns of one height, which is sought; false if they do not fit. */
static bool tryLayout(Page *page, Layout *l, float wrap, float roomX, float roomY) {
    float total = 0;
    for (int i = 0; i < page->count; i++) {
        Row *row = &page->rows[i];
        r_uiTextSize(row->text, sizeOf(row, l->size), wrap, &row->height);
        row->height = fmaxf(row->height, l->size) + (lineHeight - 1.164f) * l->size;
        total += row->height;
    }
    for (float max = total / (float)l->columns; max <= roomY; max += l->size) {
        if (fill(page, l, max)) {
            measureColumns(page, l, wrap);
            return l->width <= roomX;
        }
    }
    return false;
}

/* The largest text, then the fewest columns, that fit. What fits at no size is cut at the lower edge. */
static void layOutPage(const RRender *rc, Page *page, Layout *l) {
    static const float wraps[] = {36, 30, 25, 21, 18, 15, 12};
    const float preferred = 15 * r_uiScale(rc), roomX = 0.97f * (float)rc->m_pViewer->width,
                roomY = 0.97f * (float)rc->m_pViewer->height;
    for (l->size = preferred; l->size > 3; l->size *= 0.96f)
        for (l->columns = 1; l->columns <= MAX_COLUMNS; l->columns++)
            for (size_t w = 0; w < sizeof wraps / sizeof wraps[0]; w++)
                if (tryLayout(page, l, wraps[w] * l->size, roomX - 2 * padding * l->size,
                              roomY - 2 * padding * l->size))
                    return;
    l->columns = MAX_COLUMNS;
    tryLayout(page, l, roomX, INFINITY, INFINITY);
}

static void drawRows(const Page *page, const Layout *l, float left, float top) {
    float y = top;
    for (int i = 0, column = 0; i < page->count; i++) {
        const Row *row = &page->rows[i];
        if (row->column != column) {
            left += l->key[column] + l->text[column] + columnGap * l->size;
            column = row->column;
            y = top;
        }
        y += gapAbove(row, l->size, y == top);
        const float base = roundf(y + sizeOf(row, l->size)), x = row->kind == rKeyed ? left + l->key[column] : left;
        const float wrap = l->text[column] + (row->kind == rKeyed ? 0 : l->key[column]) + 1;
        r_uiText(left, base, l->size, 0, rTextPlain, r_white, row->key);
        const float *color = row->kind == rHeading ? r_accent : r_white;
        r_uiText(x, base, sizeOf(row, l->size), wrap, rTextPlain, color, row->text);
        y += row->height;
    }
}

void r_helpDraw(RRender *rc, RHelpLayout *layout) {
    const struct RViewer *v = rc->m_pViewer;
    Page page;
    Layout l = {0};
    fillPage(rc, &page);
    layOutPage(rc, &page, &l);
    const float width = l.width + 2 * padding * l.size, height = l.height + 2 * padding * l.size;
    const float left = roundf(((float)v->width - width) / 2), top = roundf(((float)v->height - height) / 2);
    *layout = (RHelpLayout){left, top, left + width, top + height, l.size};
    r_uiFixedWindow("help", left, top, width, height);
    drawRows(&page, &l, left + padding * l.size, top + padding * l.size);
    r_uiWindowEnd();
}
