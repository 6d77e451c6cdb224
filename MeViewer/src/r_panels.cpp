// Dear ImGui behind functions in C: its context, its font, a frame of it as triangles, input for it, and what is drawn
// and asked in its windows. r_draw_overlay.c hands the triangles to OpenGL; nothing here knows OpenGL.
#include "MeViewer.h"
#include "RPanel.h"

#include <imgui/imgui.h>
#include <imgui/imgui_internal.h>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "MeAssert.h"
#include "MeMemory.h"
#include "MeMessage.h"
extern "C" {
#include "r_i.h"
}

/* ImGui's size of a font is the height of a line; ours that of an em, as DejaVu Sans has it: 0.928 above the baseline
 * and 0.236 below. */
static const float linePerEm = 1.164f, ascent = 0.928f;

/* Letters are drawn in about the size that is wanted: small ones could hardly be read if resampled. Pixels of an em
 * in a window of 960x600; the first one is that of panels. */
static const float ems[] = {13, 15, 11.5f, 10, 8.7f, 18.75f};

struct RPanels {
    ImGuiContext *context;
    float fontScale;       // That the atlas was made for; 0 for none.
    int fontVersion;       // Counts the atlases.
    unsigned isHandled;    // Mouse buttons, a bit each, that went down for a panel.
    R_ARRAY(REvent) mouse; // What ImGui has not seen yet: of each picture it learns one press or release.
    int64_t lastFrame;
    bool released[RKEY_COUNT]; // Keys that went up since the last frame, which has to see them down.
    ImGuiContext *before;      // The program's own, while a frame is made.
};

static ImU32 color32(const float c[4]) {
    return ImGui::ColorConvertFloat4ToU32(ImVec4(c[0], c[1], c[2], c[3]));
}

/* ---- The context, and other people's ---- */

/* While it lives, the viewer's context is ImGui's: a program may have one of its own. */
struct Within {
    ImGuiContext *before;
    explicit Within(const RPanels *panels) : before(ImGui::GetCurrentContext()) {
        ImGui::SetCurrentContext(panels->context);
    }
    ~Within() {
        ImGui::SetCurrentContext(before);
    }
};

static void setKeys(ImGuiIO &io) {
    static const int keys[][2] = {{ImGuiKey_LeftArrow, RKEY_LEFT}, {ImGuiKey_RightArrow, RKEY_RIGHT},
                                  {ImGuiKey_UpArrow, RKEY_UP},     {ImGuiKey_DownArrow, RKEY_DOWN},
                                  {ImGuiKey_Home, RKEY_HOME},      {ImGuiKey_Backspace, RKEY_BACKSPACE},
                                  {ImGuiKey_Delete, RKEY_DELETE},  {ImGuiKey_Enter, RKEY_ENTER},
                                  {ImGuiKey_Escape, RKEY_ESCAPE},  {ImGuiKey_A, 'a'}};
    for (const auto &key : keys)
        io.KeyMap[key[0]] = key[1];
}

bool r_panelsStart(RRender *rc) {
    RPanels *p = static_cast<RPanels *>(r_alloc(sizeof(RPanels)));
    if (!p)
        return false;
    ImGuiContext *before = ImGui::GetCurrentContext();
    p->context = ImGui::CreateContext();
    rc->m_pViewer->panels = p;
    ImGui::SetCurrentContext(p->context);
    ImGuiIO &io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.MousePos = ImVec2(-FLT_MAX, -FLT_MAX);
    setKeys(io);
    ImGui::SetCurrentContext(before);
    return true;
}

void r_panelsFree(RRender *rc) {
    RPanels *p = rc->m_pViewer->panels;
    if (!p)
        return;
    ImGuiContext *before = ImGui::GetCurrentContext();
    ImGui::DestroyContext(p->context);
    ImGui::SetCurrentContext(before == p->context ? nullptr : before);
    r_free(p->mouse.items);
    r_free(p);
    rc->m_pViewer->panels = nullptr;
}

/* ---- The font ---- */

static const ImWchar characters[] = {0x20,   0x7e,   0xa0,   0xff,   0x391,  0x3c9,  0x2013, 0x2014, 0x2018, 0x201d,
                                     0x2022, 0x2026, 0x2190, 0x2193, 0x2212, 0x221e, 0x2248, 0x2265, 0};

static ImFont *addFont(ImFontAtlas *atlas, float em) {
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.OversampleH = 1;
    config.OversampleV = 1;
    config.RasterizerMultiply = 1.7f; // Thin strokes of light letters on a dark panel look too thin.
    /* ImGui does not write to it. */
    return atlas->AddFontFromMemoryTTF(const_cast<unsigned char *>(r_fontFile),
                                       static_cast<int>(r_fontFileEnd - r_fontFile), roundf(em * linePerEm), &config,
                                       characters);
}

static void setStyle(float scale) {
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.Colors[ImGuiCol_WindowBg] = ImVec4(r_panel[0], r_panel[1], r_panel[2], r_panel[3]);
    style.Colors[ImGuiCol_PopupBg] = ImVec4(r_panel[0], r_panel[1], r_panel[2], 0.96f);
    style.Colors[ImGuiCol_Text] = ImVec4(r_white[0], r_white[1], r_white[2], 1);
    style.Colors[ImGuiCol_Border] = ImVec4(1, 1, 1, 0.08f);
    style.WindowRounding = 6;
    style.FrameRounding = 3;
    style.WindowMenuButtonPosition = ImGuiDir_None;
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

/* The atlas for the size of the window; another one after a resize that changes the size of the text. */
static void fitFont(RPanels *p, float scale) {
    if (p->fontScale == scale)
        return;
    ImFontAtlas *atlas = ImGui::GetIO().Fonts;
    atlas->Clear();
    for (const float em : ems)
        addFont(atlas, em * scale);
    atlas->Build();
    atlas->SetTexID(nullptr);
    setStyle(scale);
    p->fontScale = scale;
    p->fontVersion++;
}

int r_panelsFont(const RRender *rc, int *width, int *height, const uint8_t **alpha) {
    const RPanels *p = rc->m_pViewer->panels;
    if (!p || p->fontVersion == 0)
        return 0;
    const Within within(p);
    unsigned char *pixels;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&pixels, width, height);
    *alpha = pixels;
    return p->fontVersion;
}

bool r_fontPicture(RPicture *picture) {
    ImFontAtlas atlas;
    unsigned char *pixels;
    addFont(&atlas, 32);
    atlas.GetTexDataAsRGBA32(&pixels, &picture->width, &picture->height);
    const size_t bytes = 4 * static_cast<size_t>(picture->width) * static_cast<size_t>(picture->height);
    picture->rgba = static_cast<uint8_t *>(r_alloc(bytes));
    if (picture->rgba)
        memcpy(picture->rgba, pixels, bytes);
    return picture->rgba != nullptr;
}

/* ---- Text ---- */

/* UTF-8 of what may be Latin-1; lives until the next call. */
static const char *utf8(const char *text, const char **end) {
    static ImVector<char> out;
    out.resize(0);
    while (*text) {
        const char *from = text;
        const uint32_t code = r_nextCharacter(&text);
        if (text - from == 1 && code >= 0x80) {
            out.push_back(static_cast<char>(0xc0 | code >> 6));
            out.push_back(static_cast<char>(0x80 | (code & 63)));
        } else {
            for (; from < text; from++)
                out.push_back(*from);
        }
    }
    out.push_back(0);
    *end = out.end() - 1;
    return out.Data;
}

/* The letters that are nearest to a size. */
static ImFont *fontFor(float size) {
    ImFont *best = ImGui::GetFont();
    for (ImFont *font : ImGui::GetIO().Fonts->Fonts)
        if (fabsf(font->FontSize - size * linePerEm) < fabsf(best->FontSize - size * linePerEm))
            best = font;
    return best;
}

/* Outside of windows, what is drawn is behind all of them. */
static ImDrawList *list() {
    ImGuiWindow *window = GImGui->CurrentWindow;
    return window && !window->IsFallbackWindow ? window->DrawList : ImGui::GetBackgroundDrawList();
}

float r_uiTextSize(const char *text, float size, float wrap, float *height) {
    const char *end, *begin = utf8(text, &end);
    const ImVec2 extent = fontFor(size)->CalcTextSizeA(size * linePerEm, FLT_MAX, wrap, begin, end);
    if (height)
        *height = extent.y;
    return extent.x;
}

void r_uiText(float x, float y, float size, float wrap, RTextStyle style, const float color[4], const char *text) {
    const char *end, *begin = utf8(text, &end);
    const float top = y - ascent * size;
    ImDrawList *const to = list();
    ImFont *font = fontFor(size);
    if (style == rTextOutlined) {
        const float light = 0.3f * color[0] + 0.6f * color[1] + 0.1f * color[2], by = fmaxf(1, 0.07f * size);
        const float shade = light > 0.45f ? 0.08f : 1; // Dark round light text, and light round dark text.
        const float around[4] = {shade, shade, shade, 0.35f * color[3]};
        for (int i = 0; i < 9; i++)
            if (i != 4)
                to->AddText(font, size * linePerEm,
                            ImVec2(x + by * static_cast<float>(i % 3 - 1), top + by * static_cast<float>(i / 3 - 1)),
                            color32(around), begin, end, wrap);
    }
    to->AddText(font, size * linePerEm, ImVec2(x, top), color32(color), begin, end, wrap);
}

/* ---- Shapes ---- */

void r_uiBox(float x, float y, float width, float height, float radius, const float color[4]) {
    list()->AddRectFilled(ImVec2(x, y), ImVec2(x + width, y + height), color32(color), radius);
}

void r_uiLine(const float start[2], const float end[2], const float color[4], float width) {
    list()->AddLine(ImVec2(start[0], start[1]), ImVec2(end[0], end[1]), color32(color), width);
}

static ImTextureID textureID(int texture) {
    return reinterpret_cast<ImTextureID>(static_cast<intptr_t>(texture + 1));
}

void r_uiTriangle(const RCorner corners[3], int texture, const float color[4]) {
    ImDrawList *const to = list();
    const ImVec2 white = ImGui::GetDrawListSharedData()->TexUvWhitePixel;
    to->PushTextureID(textureID(texture));
    to->PrimReserve(3, 3);
    for (int i = 0; i < 3; i++) {
        const RCorner *c = &corners[i];
        to->PrimVtx(ImVec2(c->x, c->y), texture >= 0 ? ImVec2(c->u, c->v) : white, color32(color));
    }
    to->PopTextureID();
}

/* ---- A frame ---- */

static int buttonIndex(int which) {
    return which == kRLeftButton ? 0 : which == kRRightButton ? 1 : 2;
}

/* ImGui is told the state of the buttons and no events: two clicks in one slow frame would be none, or one. So it
 * learns of one press or release at a time, a frame after the moves before it: what has a button upon it takes no click
 * unless the pointer was on it in the frame before. */
static void feedMouse(RPanels *p, ImGuiIO &io) {
    size_t n = 0;
    for (; n < p->mouse.count && p->mouse.items[n].kind == rMouseMove; n++)
        io.MousePos = ImVec2(static_cast<float>(p->mouse.items[n].x), static_cast<float>(p->mouse.items[n].y));
    if (n == 0 && p->mouse.count) {
        const REvent *e = &p->mouse.items[n++];
        io.MousePos = ImVec2(static_cast<float>(e->x), static_cast<float>(e->y));
        io.MouseDown[buttonIndex(e->which)] = e->kind == rMouseDown;
    }
    p->mouse.count -= n;
    if (p->mouse.count)
        memmove(p->mouse.items, p->mouse.items + n, p->mouse.count * sizeof *p->mouse.items);
}

void r_panelsBegin(RRender *rc) {
    const struct RViewer *v = rc->m_pViewer;
    RPanels *p = v->panels;
    p->before = ImGui::GetCurrentContext();
    ImGui::SetCurrentContext(p->context);
    fitFont(p, r_uiScale(rc));
    ImGuiIO &io = ImGui::GetIO();
    const int64_t now = r_now();
    io.DisplaySize = ImVec2(static_cast<float>(v->width), static_cast<float>(v->height));
    io.DeltaTime = 1.f / 60; // Off-screen, the same run gives the same pictures.
    if (v->backend && v->backend->window && p->lastFrame)
        io.DeltaTime = fmaxf(static_cast<float>(now - p->lastFrame) * 1e-9f, 1e-4f);
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    p->lastFrame = now;
    feedMouse(p, io);
    ImGui::NewFrame();
}

static void appendList(ROverlay *overlay, const ImDrawList *from) {
    const size_t vertices = static_cast<size_t>(from->VtxBuffer.Size);
    const size_t indices = static_cast<size_t>(from->IdxBuffer.Size);
    const size_t runs = static_cast<size_t>(from->CmdBuffer.Size);
    const size_t base = overlay->vertices.count, first = overlay->indices.count;
    static_assert(sizeof(ROverlayVertex) == sizeof(ImDrawVert), "one is copied to the other");
    if (!r_grow(overlay->vertices, vertices) || !r_grow(overlay->indices, indices) || !r_grow(overlay->runs, runs))
        return;
    if (vertices)
        memcpy(overlay->vertices.items + base, from->VtxBuffer.Data, vertices * sizeof(ROverlayVertex));
    overlay->vertices.count += vertices;
    overlay->indices.count += indices;
    for (const ImDrawCmd &c : from->CmdBuffer) {
        for (unsigned i = 0; i < c.ElemCount; i++)
            overlay->indices.items[first + c.IdxOffset + i] =
                static_cast<uint32_t>(base) + c.VtxOffset + from->IdxBuffer[static_cast<int>(c.IdxOffset + i)];
        ROverlayRun *run = &overlay->runs.items[overlay->runs.count++];
        run->first = first + c.IdxOffset;
        run->count = c.ElemCount;
        run->texture = static_cast<int>(reinterpret_cast<intptr_t>(c.GetTexID())) - 1;
        const ImVec4 clip = c.ClipRect;
        const float edges[4] = {clip.x, clip.y, clip.z, clip.w};
        memcpy(run->clip, edges, sizeof edges);
    }
}

/* A window that fits its contents is hidden in its first frame, which only finds its size. */
static bool isMeasuring(const ImGuiContext *c) {
    for (const ImGuiWindow *w : c->Windows)
        if (w->Active && w->Hidden && !w->IsFallbackWindow)
            return true;
    return false;
}

static void releaseKeys(RPanels *p, ImGuiIO &io) {
    for (int key = 0; key < RKEY_COUNT; key++) {
        io.KeysDown[key] = io.KeysDown[key] && !p->released[key];
        p->released[key] = false;
    }
    io.MouseWheel = 0;
}

bool r_panelsEnd(RRender *rc, ROverlay *overlay) {
    RPanels *p = rc->m_pViewer->panels;
    ImGui::Render();
    const ImDrawData *data = ImGui::GetDrawData();
    overlay->vertices.count = overlay->indices.count = overlay->runs.count = 0;
    for (int i = 0; i < data->CmdListsCount; i++)
        appendList(overlay, data->CmdLists[i]);
    releaseKeys(p, ImGui::GetIO());
    const bool complete = !isMeasuring(p->context);
    ImGui::SetCurrentContext(p->before);
    return complete;
}

/* ---- Input ---- */

/* Where a panel was in the last frame. ImGui itself only knows in the next one. */
static bool isOver(const RPanels *p, float x, float y) {
    for (const ImGuiWindow *w : p->context->Windows)
        if (w->Active && !w->Hidden && !w->IsFallbackWindow && !(w->Flags & ImGuiWindowFlags_NoMouseInputs) &&
            w->OuterRectClipped.Contains(ImVec2(x, y)))
            return true;
    return false;
}

static bool handleKey(ImGuiIO &io, const REvent *e) {
    if (!io.WantTextInput || e->key <= RKEY_NONE || e->key >= RKEY_COUNT)
        return false;
    io.KeysDown[e->key] = true;
    io.KeyCtrl = (e->modifiers & RCONTROL) != 0;
    if (e->key >= ' ' && e->key < 127 && !(e->modifiers & RCONTROL))
        io.AddInputCharacter(static_cast<unsigned>(e->key));
    return true;
}

bool r_panelsHandle(RRender *rc, const REvent *e) {
    RPanels *p = rc->m_pViewer->panels;
    if (!p)
        return false;
    const Within within(p);
    ImGuiIO &io = ImGui::GetIO();
    const unsigned bit = 1u << buttonIndex(e->which);
    const float x = static_cast<float>(e->x), y = static_cast<float>(e->y);
    if ((e->kind == rMouseDown || e->kind == rMouseUp || e->kind == rMouseMove) && r_grow(p->mouse, 1))
        p->mouse.items[p->mouse.count++] = *e;
    bool isHandled;
    switch (e->kind) {
    case rMouseDown:
        p->isHandled |= isOver(p, x, y) ? bit : 0;
        return (p->isHandled & bit) != 0;
    case rMouseUp:
        isHandled = (p->isHandled & bit) != 0;
        p->isHandled &= ~bit;
        return isHandled;
    case rMouseMove:
        return p->isHandled != 0;
    case rWheel:
        if (!isOver(p, x, y))
            return false;
        io.MouseWheel += static_cast<float>(e->which);
        return true;
    case rKeyDown:
        return handleKey(io, e);
    case rKeyUp:
        if (e->key > RKEY_NONE && e->key < RKEY_COUNT)
            p->released[e->key] = true;
        return false;
    default:
        return false;
    }
}

/* ---- Windows ---- */

static const float itemWidth = 9, listWidth = 16; // Of the dock, in heights of a line.

void r_uiFixedWindow(const char *name, float x, float y, float width, float height) {
    ImGui::SetNextWindowPos(ImVec2(x, y));
    ImGui::SetNextWindowSize(ImVec2(width, height));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
    ImGui::Begin(name, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav);
    ImGui::PopStyleVar();
}

void r_uiDock(float x, float y, float width, float height) {
    ImGui::SetNextWindowPos(ImVec2(x, y));
    ImGui::SetNextWindowSize(ImVec2(width, height));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(r_panel[0], r_panel[1], r_panel[2], 1));
    ImGui::Begin("dock", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_AlwaysVerticalScrollbar | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
    ImGui::PushItemWidth(itemWidth * ImGui::GetFontSize());
}

void r_uiDockEnd(void) {
    ImGui::PopItemWidth();
    ImGui::End();
}

bool r_uiPanel(const char *title, bool isNew, bool *shown) {
    ImGui::PushID(title);
    const bool open = ImGui::CollapsingHeader(title, shown, ImGuiTreeNodeFlags_DefaultOpen);
    if (isNew)
        ImGui::SetScrollHereY(0);
    return open;
}

void r_uiPanelEnd(void) {
    ImGui::PopID();
    ImGui::Spacing();
}

void r_uiWindowEnd(void) {
    ImGui::End();
}

bool r_uiClicked(const char *name, float x, float y, float width, float height) {
    ImGui::SetCursorScreenPos(ImVec2(x, y));
    return ImGui::InvisibleButton(name, ImVec2(width, height));
}

float r_uiMouseX(void) {
    return ImGui::GetIO().MousePos.x;
}

/* ---- What a panel shows (RPanel.h) ---- */

/* The width of the dock is left, if that is less. */
static float widthUpTo(float lines) {
    return fminf(lines * ImGui::GetFontSize(), ImGui::GetContentRegionAvail().x);
}

/* A label that has no room beside its item stands above it. Returns what the item is to be called; lives until the next
 * call. */
static const char *labelBeside(const char *label) {
    static ImVector<char> hidden;
    const char *end = ImGui::FindRenderedTextEnd(label);
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcItemWidth() - ImGui::GetStyle().ItemInnerSpacing.x;
    if (ImGui::CalcTextSize(label, end).x <= room)
        return label;
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(label, end);
    ImGui::PopTextWrapPos();
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    const size_t length = strlen(label);
    hidden.resize(static_cast<int>(length) + 3);
    memcpy(hidden.Data, "##", 2);
    memcpy(hidden.Data + 2, label, length + 1);
    return hidden.Data;
}

/* A panel's callback is running. */
static bool inPanel(const char *function) {
    const ImGuiContext *c = ImGui::GetCurrentContext();
    if (c && c->WithinFrameScope && c->CurrentWindow && !c->CurrentWindow->IsFallbackWindow)
        return true;
    MeWarning(1, "%s: it may only be called by a panel's function", function);
    return false;
}

static bool canShow(const char *function, const void *pointer, const char *argument) {
    return r_isPointer(pointer, function, argument) && inPanel(function);
}

void MEAPI RPanelText(const char *text) {
    const char *end;
    if (canShow(__func__, text, "text")) {
        const char *begin = utf8(text, &end);
        ImGui::PushTextWrapPos(0);
        ImGui::TextUnformatted(begin, end);
        ImGui::PopTextWrapPos();
    }
}

void MEAPI RPanelWrapped(const char *text) {
    if (canShow(__func__, text, "text"))
        RPanelText(text);
}

void MEAPI RPanelHeading(const char *text) {
    if (!canShow(__func__, text, "text"))
        return;
    ImGui::Spacing();
    ImGui::TextColored(ImVec4(r_accent[0], r_accent[1], r_accent[2], 1), "%s", text);
}

MeBool MEAPI RPanelButton(const char *label) {
    return canShow(__func__, label, "label") && ImGui::Button(label);
}

MeBool MEAPI RPanelCheck(const char *label, MeBool *value) {
    if (!canShow(__func__, label, "label") || !r_isPointer(value, __func__, "value"))
        return MEFALSE;
    bool on = *value != 0;
    const bool changed = ImGui::Checkbox(label, &on);
    *value = on;
    return changed;
}

bool r_uiSlider(const char *label, MeReal *value, MeReal low, MeReal high, const char *unit, bool logarithmic) {
    char format[48];
    float shown = static_cast<float>(*value);
    ImFormatString(format, sizeof format, "%%.4g %.32s", unit ? unit : "");
    const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | (logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
    if (!ImGui::SliderFloat(labelBeside(label), &shown, static_cast<float>(low), static_cast<float>(high), format,
                            flags))
        return false;
    *value = static_cast<MeReal>(shown);
    return true;
}

static MeBool slider(const char *function, const char *label, MeReal *value, MeReal low, MeReal high, const char *unit,
                     bool logarithmic) {
    if (!canShow(function, label, "label") || !r_isPointer(value, function, "value"))
        return MEFALSE;
    if (!(low < high) || !std::isfinite(low) || !std::isfinite(high) || (logarithmic && !(low > 0))) {
        MeWarning(1, "%s: low is %g and high is %g", function, static_cast<double>(low), static_cast<double>(high));
        return MEFALSE;
    }
    return r_uiSlider(label, value, low, high, unit, logarithmic);
}

MeBool MEAPI RPanelSlider(const char *label, MeReal *value, MeReal low, MeReal high, const char *unit) {
    return slider(__func__, label, value, low, high, unit, false);
}

MeBool MEAPI RPanelScale(const char *label, MeReal *value, MeReal low, MeReal high, const char *unit) {
    return slider(__func__, label, value, low, high, unit, true);
}

MeBool MEAPI RPanelWhole(const char *label, int *value, int low, int high) {
    if (!canShow(__func__, label, "label") || !r_isPointer(value, __func__, "value"))
        return MEFALSE;
    if (low >= high) {
        MeWarning(1, "%s: low is %d and high is %d", __func__, low, high);
        return MEFALSE;
    }
    return ImGui::SliderInt(labelBeside(label), value, low, high, "%d", ImGuiSliderFlags_AlwaysClamp);
}

MeBool MEAPI RPanelChoice(const char *label, int *which, const char *const names[], int count) {
    if (!canShow(__func__, label, "label") || !r_isPointer(which, __func__, "which") ||
        !r_isPointer(names, __func__, "names"))
        return MEFALSE;
    return ImGui::Combo(labelBeside(label), which, names, count);
}

MeBool MEAPI RPanelEdit(const char *label, char *text, int size) {
    return canShow(__func__, label, "label") && r_isPointer(text, __func__, "text") && size > 1 &&
           ImGui::InputText(labelBeside(label), text, static_cast<size_t>(size));
}

MeBool MEAPI RPanelLine(const char *text, MeBool marked) {
    if (!canShow(__func__, text, "text"))
        return MEFALSE;
    const bool clicked = ImGui::Selectable(text, marked != 0);
    /* A list that is new has no height to scroll over yet. */
    bool *hasScrolled = ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("scrolled"));
    if (marked && !*hasScrolled)
        ImGui::SetScrollHereY();
    *hasScrolled = *hasScrolled || (marked && ImGui::GetScrollMaxY() > 0);
    return clicked;
}

MeBool MEAPI RPanelIsPointedAt(void) {
    return inPanel(__func__) && ImGui::IsItemHovered();
}

MeBool MEAPI RPanelSection(const char *title) {
    return canShow(__func__, title, "title") && ImGui::CollapsingHeader(title);
}

void MEAPI RPanelSameLine(void) {
    if (inPanel(__func__))
        ImGui::SameLine();
}

void MEAPI RPanelPlot(const char *label, const float *values, int count, float high, const char *unit) {
    if (!canShow(__func__, label, "label") || !r_isPointer(values, __func__, "values") || count < 1)
        return;
    char text[48];
    float max = high;
    for (int i = 0; high <= 0 && i < count; i++)
        max = fmaxf(max, values[i]);
    ImFormatString(text, sizeof text, "%.3g %.32s", static_cast<double>(values[count - 1]), unit ? unit : "");
    ImGui::PlotLines(labelBeside(label), values, count, 0, text, 0, max > 0 ? max : 1,
                     ImVec2(0, 2.4f * ImGui::GetFontSize()));
}

void MEAPI RPanelPicture(int texture, AcmeReal width, AcmeReal height) {
    if (!inPanel(__func__) || texture < 0 || !(width > 0))
        return;
    const float shown = widthUpTo(width);
    ImGui::Image(textureID(texture), ImVec2(shown, shown * height / width));
}

void MEAPI RPanelListBegin(const char *name, int lines) {
    if (canShow(__func__, name, "name"))
        ImGui::BeginChild(
            name, ImVec2(widthUpTo(listWidth), static_cast<float>(lines) * ImGui::GetTextLineHeightWithSpacing()),
            true);
}

void MEAPI RPanelListEnd(void) {
    if (inPanel(__func__))
        ImGui::EndChild();
}
