/* What the viewer's files share. Nothing here knows OpenGL: that is r_draw_i.h's. */
#ifndef R_I_H
#define R_I_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "MeAssert.h"
#include "MeMemory.h"
#include "MeMessage.h"
#include "MeViewer.h"

/* ---- Memory (r_base.c): through MeMemoryAPI; null and a fatal error when there is none left ---- */

void *r_alloc(size_t bytes); /* Zeroed. */
void r_free(void *block);    /* Null is allowed. */
char *r_copyText(const char *text);

/* A growing array of any element type: { T *items; size_t count, capacity; } */
#define R_ARRAY(T)                                                                                                     \
    struct {                                                                                                           \
        T *items;                                                                                                      \
        size_t count, capacity;                                                                                        \
    }
bool r_growBytes(void **items, size_t *capacity, size_t needed, size_t size);
/* Makes room for n more; false when there is no memory. */
#define r_grow(a, n) r_growBytes((void **)&(a).items, &(a).capacity, (a).count + (n), sizeof *(a).items)

/* ---- Checks (r_base.c): each warns in the name of a function and is false when the argument is bad ---- */

bool r_isContext(const RRender *rc, const char *function);
bool r_isLive(const RRender *rc); /* r_context.c; says nothing. */
bool r_isGraphic(const RGraphic *rg, const char *function);
bool r_isSize(AcmeReal value, const char *function, const char *argument); /* Finite and above 0. */
bool r_isFinite(const AcmeReal *values, int n, const char *function, const char *argument);
bool r_isNumber(AcmeReal value, const char *function, const char *argument);
bool r_isPointer(const void *pointer, const char *function, const char *argument);

/* ---- Input (r_input.c) ---- */

/* Keys: printable ASCII (letters in lower case), Enter, Escape, and these. */
enum {
    RKEY_NONE = 0,
    RKEY_BACKSPACE = 8,
    RKEY_ENTER = 13,
    RKEY_ESCAPE = 27,
    RKEY_DELETE = 127,
    RKEY_F1 = 257,
    RKEY_F2,
    RKEY_F3,
    RKEY_F4,
    RKEY_F5,
    RKEY_F9 = RKEY_F1 + 8,
    RKEY_F12 = RKEY_F1 + 11,
    RKEY_UP = 300,
    RKEY_DOWN,
    RKEY_LEFT,
    RKEY_RIGHT,
    RKEY_PAGE_UP,
    RKEY_PAGE_DOWN,
    RKEY_HOME,
    RKEY_COUNT
};

typedef enum { rKeyDown, rKeyUp, rMouseDown, rMouseUp, rMouseMove, rWheel, rResize, rClose } REventKind;

typedef struct {
    REventKind kind;
    int key;       /* rKey* */
    int which;     /* rMouse*: an RMouseButtonWhich; rWheel: notches, away from the user positive */
    int modifiers; /* RCONTROL | RSHIFT | RALT */
    int x, y;      /* rMouse*: pixels, y down; rResize: the new size */
} REvent;

typedef struct {
    int key, modifiers;
    int frame, last; /* In which it is down; 1 is the first. */
} RScriptedKey;

/* RRenderSetKeyCallBack's. */
typedef struct {
    int key;
    RCallBackDataButton button;
} RExtraKey;

typedef struct {
    R_ARRAY(REvent) events;
    R_ARRAY(RScriptedKey) script;
    int heldFor[RKEY_COUNT];      /* Frames since the key went down, from 1; 0 if it is up. */
    bool heldControl[RKEY_COUNT]; /* Ctrl was down when the key went down. */
    int actionKey[NUM_ACTION_CALLBACKS];
    int dragButton; /* The button that moves the camera, or 0. */
    bool dragPans;
    bool mouseToProgram; /* The left button went down for the program. */
    bool mouseLeft;      /* RRenderLeaveMouse: the program does not want it. */
    R_ARRAY(RExtraKey) extraKeys;
    int lastX, lastY;
} RInput;

void r_post(RRender *rc, REvent event);
void r_inputInit(RInput *input);
bool r_inputScript(RRender *rc, const char *script); /* Takes what -key says; false if a key is no key. */
void r_inputFrame(RRender *rc);                      /* Handles what has come in since the last frame. */
void r_inputFree(RInput *input);
int r_keyByName(const char *name, size_t length); /* RKEY_NONE if there is no such key. */
void r_keyName(int key, char *name, size_t size);
bool r_keyIsFree(const RRender *rc, int key); /* The program has no action, parameter, button or menu on it. */
void r_press(RRender *rc, const RCallBackDataButton *b);              /* Calls the program, if it wants to be. */
const RCallBackDataButton *r_actionOfKey(const RRender *rc, int key); /* The program's action on it, or null. */

/* ---- Parameters (r_parameter.c) ---- */

/* RParameter, kept. */
typedef struct {
    char *name, *unit;
    MeReal *value, first; /* The program's; as it was when the parameter was made. */
    MeReal low, high, step;
    bool isFactor;
    int key[2]; /* For less and for more; RKEY_NONE. */
    RCallBackDataButton changed;
} RParameterKept;
typedef R_ARRAY(RParameterKept) RParameters;

const RParameterKept *r_parameterOfKey(const RRender *rc, int key, bool *isMore); /* Null; isMore may be null. */
bool r_parameterKey(RRender *rc, int key); /* Does what a key does to a parameter; false if it does nothing to any. */
void r_parameterText(const RParameterKept *p, char *text, size_t size); /* Name and unit. */
void r_parameterKeys(const RParameterKept *p, char *text, size_t size); /* Their names; empty for none. */
void r_parametersFree(RParameters *list);

/* ---- Camera (r_camera.c) ---- */

/* The upright frame is the world turned so that the program's up axis (RCameraSetUp) is y. Angles of the camera, the
 * ground, the sky, and all that is drawn are in it, so that nothing else has to know which axis is up. */
typedef struct {
    AcmeReal upright[3][3]; /* The upright frame's axes in the world: upright = rows . world. */
    bool orthographic;
    bool ownMatrix; /* RCameraSetMatrix */
    bool isSet;     /* By the program, or by -camera. */
    bool goesBelow; /* In the user's hand, also below the ground. */
    AcmeReal orthoHeight, orthoDepth;
    AcmeReal farthest; /* Distance from the camera up to which the scene reaches. */
    bool hasHome;
    AcmeReal home[6]; /* The first view: look-at, distance, theta, phi. */
} RCamera;

void r_cameraInit(RRender *rc);
void r_toUpright(const RRender *rc, const AcmeReal world[3], AcmeReal upright[3]);
void r_fromUpright(const RRender *rc, const AcmeReal upright[3], AcmeReal world[3]);
void r_cameraApplyOption(RRender *rc); /* -camera */
/* A camera that no program has set sees all models and the ground below them, from above the ground. */
void r_cameraSeeScene(RRender *rc);
void r_cameraKeepHome(RRender *rc);
void r_cameraHome(RRender *rc);
/* Extends a box in the upright frame by a graphic; a ground has only a height. Returns whether it is a model. */
bool r_cameraAddToBox(const RRender *rc, RGraphic *rg, AcmeReal box[2][3]);

/* ---- The camera in the user's hand (r_orbit.c) ---- */

void r_cameraOrbit(RRender *rc, AcmeReal theta, AcmeReal phi);
void r_cameraPan(RRender *rc, AcmeReal right, AcmeReal up);       /* In pixels of the window, at the look-at point. */
void r_cameraDolly(RRender *rc, AcmeReal factor);                 /* Multiplies the distance. */
void r_cameraDollyAt(RRender *rc, AcmeReal factor, int x, int y); /* The same, towards a pixel. */

/* ---- Graphics (r_graphic.c) ---- */

typedef enum { rMesh, rLine, rText, rGround, rSky } RKind;

typedef enum { rShapeOther, rShapeBox, rShapeSphere, rShapeCylinder, rShapeCone, rShapeSphyl, rShapeTorus } RShapeKind;

/* What a graphic was created as (r_detail.c): a shape of size 1, stretched, then moved along z. */
typedef struct {
    RShapeKind kind;
    float scale[3], shift;
    float ratio;      /* rShapeSphyl: height / radius; rShapeTorus: inner / outer radius. */
    uint64_t hash[2]; /* Of its vertices when it was created. */
} RShape;

struct RGraphicPart {
    RKind kind;
    RRender *owner;   /* In whose list it is; null for none. */
    int number;       /* In the order in which graphics first came into the lists of a context, from 1. */
    bool is2D;        /* Which list. */
    bool warned;      /* Its bad transform or vertices have been told. */
    AcmeReal side;    /* rGround: length of its side. */
    AcmeReal x, y;    /* rText: upper left corner. */
    char *text;       /* rText */
    size_t meshGuess; /* Where its mesh was found last. */
    RShape shape;
};

RGraphic *r_graphicCreate(const char *function, int numVertices, RKind kind);
/* Remembers what the graphic, which may be null, has just been given the vertices of. */
void r_graphicIsShape(RGraphic *rg, RShape shape);
/* Colour, transform, list. Frees the graphic and returns null if an argument is bad. */
RGraphic *r_graphicFinish(const char *function, RRender *rc, RGraphic *rg, const float color[4], MeMatrix4Ptr matrix,
                          bool is2D);
void r_graphicFreeAll(RRender *rc);
/* The transform as 16 floats in OpenGL's order; false, after one warning, if it is not finite. */
bool r_graphicTransform(RGraphic *rg, float out[16]);
bool r_matrixFloats(const MeVector4 *matrix, float out[16]);

/* ---- Particles (r_particle.c) ---- */

void r_particlesUpdate(RRender *rc); /* Turns all of them towards the camera. */
void r_particlesFree(RRender *rc);

/* ---- Hashes (r_hash.c) ---- */

uint64_t r_hashWord(uint64_t hash, uint64_t word);                               /* Adds a word to a hash. */
void r_hashVertices(const RObjectVertex *vertices, int count, uint64_t hash[2]); /* Of all of them. */

/* ---- Lines (r_line.c) ---- */

typedef struct {
    float a[3], b[3]; /* World. */
    float color[4];
} RLineSegment;
typedef R_ARRAY(RLineSegment) RLineSegments;

void r_linesFree(RRender *rc);
/* Karma's own drawing (MeDebugDrawAPI): kept until the next tick; nothing is kept before the first. */
void r_debugLine(RRender *rc, const MeVector3 start, const MeVector3 end, MeReal r, MeReal g, MeReal b);
void r_debugLinesForget(RRender *rc);
void r_linesCollect(RRender *rc, RLineSegments *out); /* Everything in the native list and from RLineAdd. */

/* ---- Lights (r_light.c) ---- */

typedef struct {
    RDirectLight key, fill;
    RPointLight point;
} RLights;

void r_lightsInit(RRender *rc);
/* Directions and place of the lights, so that they can stay where they are in the upright frame. */
void r_lightsToUpright(RRender *rc, AcmeReal upright[3][3]);
void r_lightsFromUpright(RRender *rc, AcmeReal upright[3][3]);
void r_lightsUpdate(RRender *rc); /* Takes over what the force-update flags say has changed. */

/* ---- Textures (r_texture.c) ---- */

#define R_MAX_TEXTURES 100
#define R_MAX_PICTURE  4096 /* Pixels, of a side of a texture from a file. */

typedef struct {
    int width, height;
    uint8_t *rgba; /* From the upper left corner on. */
} RPicture;

typedef struct {
    char *names[R_MAX_TEXTURES];
    int count;
} RTextures;

/* Built in or from a file; warns if there is none. The caller frees picture->rgba. */
bool r_texturePicture(const char *name, RPicture *picture);
/* Warns if the file is there but cannot be used. The caller frees picture->rgba. (r_image.c) */
bool r_imageRead(const char *path, RPicture *picture);
void r_texturesFree(RTextures *textures);

/* ---- Pictures as files (r_image.c) ---- */

bool r_writePng(const char *path, const RPicture *picture); /* Warns, naming the file, if it cannot be written. */

/* ---- What is laid over the picture, as triangles in pixels, x right, y down ---- */

typedef struct {
    float x, y, u, v;
    uint32_t color; /* Red in the lowest byte. */
} ROverlayVertex;

typedef struct {
    size_t first, count; /* Indices. */
    int texture;         /* -1 for the font's, which has a white place too. */
    float clip[4];       /* Left, top, right, bottom. */
} ROverlayRun;

typedef struct {
    R_ARRAY(ROverlayVertex) vertices;
    R_ARRAY(uint32_t) indices;
    R_ARRAY(ROverlayRun) runs;
} ROverlay;

void r_overlayFree(ROverlay *overlay);

/* ---- Panels (r_panels.cpp) ---- */

struct RPanels;
bool r_panelsStart(RRender *rc);
void r_panelsFree(RRender *rc);
bool r_panelsHandle(RRender *rc, const REvent *event); /* True: a panel has taken the event. */
void r_panelsBegin(RRender *rc);                       /* From here to the end, r_ui functions draw. */
bool r_panelsEnd(RRender *rc, ROverlay *overlay);      /* False: a panel has only been measured, and is not seen. */
/* The picture of the letters, and its number, which changes with it; 0 before the first frame. */
int r_panelsFont(const RRender *rc, int *width, int *height, const uint8_t **alpha);
bool r_fontPicture(RPicture *picture);                    /* White letters on nothing. */
extern const unsigned char r_fontFile[], r_fontFileEnd[]; /* r_font.c */

typedef enum { rTextPlain, rTextOutlined } RTextStyle;
typedef struct {
    float x, y, u, v;
} RCorner;
/* y is the first line's baseline, size the height of an em, wrap the width for lines or 0. */
void r_uiText(float x, float y, float size, float wrap, RTextStyle style, const float color[4], const char *text);
float r_uiTextSize(const char *text, float size, float wrap, float *height); /* The width; height may be null. */
void r_uiBox(float x, float y, float width, float height, float radius, const float color[4]);
void r_uiTriangle(const RCorner corners[3], int texture, const float color[4]);
void r_uiLine(const float start[2], const float end[2], const float color[4], float width);
void r_uiFixedWindow(const char *name, float x, float y, float width, float height);
void r_uiWindowEnd(void);
/* The place of panels, which scrolls. */
void r_uiDock(float x, float y, float width, float height);
void r_uiDockEnd(void);
/* A section of the dock; a new one is scrolled to. False if it is folded. The end is due in any case. */
bool r_uiPanel(const char *title, bool isNew, bool *shown);
void r_uiPanelEnd(void);
/* A slider with its value beside the label; logarithmic: low is above 0. */
bool r_uiSlider(const char *label, MeReal *value, MeReal low, MeReal high, const char *unit, bool logarithmic);
bool r_uiClicked(const char *name, float x, float y, float width, float height);
float r_uiMouseX(void);

/* ---- What the viewer itself lays over the picture: r_hud.c, r_help.c, r_menu.c, r_bar.c, r_panel.c ---- */

extern const float r_white[4], r_dimmed[4], r_accent[4], r_panel[4];
float r_uiScale(const RRender *rc);          /* 1 in a window of 960x600 of a usual display. */
uint32_t r_nextCharacter(const char **text); /* Moves on to the next one; the text must not be at its end. */
void r_hudDraw(RRender *rc, ROverlay *overlay);

typedef struct {
    R_ARRAY(char *) lines; /* The program's, as given. */
    bool wasPaused;        /* Before the help was shown. */
} RHelp;

typedef struct {
    float left, top, right, bottom; /* Of the panel last drawn. */
    float size;                     /* Of its text. */
} RHelpLayout;

void r_helpDraw(RRender *rc, RHelpLayout *layout);
void r_helpFree(RHelp *help);
void r_menuDraw(RRender *rc);
void r_menuAct(RRender *rc); /* What the mouse has done to the menu in the last picture. */
void r_menusFree(RRender *rc);
void r_barStart(RRender *rc); /* Begins to measure, if there is a bar that can be seen. */
bool r_barIsShown(const RRender *rc);
void r_barToggle(RRender *rc);
void r_barDraw(RRender *rc);
void r_barFrame(RRender *rc); /* Takes the times of the frame that has ended. */
void r_barFree(RRender *rc);
void r_profileStart(RRender *rc);

typedef struct {
    char *title;
    void(MEAPI *func)(RRender *rc, void *userdata);
    void *userdata;
    bool shown;  /* When F9 shows panels. */
    bool pinned; /* RPanelShow: also when it does not. */
    int drawnIn; /* The last frame in which it was visible. */
} RPanel;
typedef R_ARRAY(RPanel) RPanelList;

void r_marksDraw(RRender *rc); /* r_mark.c */
void r_panelsDraw(RRender *rc);
int r_sceneWidth(const RRender *rc); /* Pixels from the left edge: what panels, which are at the right, leave. */
bool r_tickIsDue(const RRender *rc); /* In slow motion, not in every frame. */
void r_panelsToggle(RRender *rc);
void r_panelListFree(RPanelList *list);

typedef struct {
    int frames; /* Since `begin`. */
    int64_t begin;
    double collision, dynamics, render; /* Sums, seconds. */
    double fps;
    bool given; /* RPerformanceBarUpdate was called since. */
} RBarState;

/* ---- Where it is drawn (r_backend_*.c) ---- */

typedef void (*RProc)(void);

typedef struct {
    const char *option; /* On the command line. */
    RRenderType type;
    bool draws;  /* False: no OpenGL at all. */
    bool window; /* Somebody can see it and press keys. */
    /* Makes an OpenGL context current; false with a reason. On resize events the backend needs no call. */
    bool (*start)(RRender *rc, char *reason, size_t size);
    void (*stop)(RRender *rc);
    void (*poll)(RRender *rc);    /* Posts the events that have come in. */
    void (*present)(RRender *rc); /* The frame is in framebuffer 0. */
    void (*title)(RRender *rc, const char *title);
    RProc (*proc)(const char *name);        /* An OpenGL function. */
    bool (*makeCurrent)(const RRender *rc); /* Its OpenGL context; false if that is gone. */
} RBackend;

extern const RBackend r_backendGlut, r_backendOsmesa, r_backendNull;

/* ---- Options (r_options.c, r_refuse.c) ---- */

enum { R_GROUNDS = 4 };
extern const char *const r_groundNames[R_GROUNDS]; /* Of RGroundLook (r_scene.c). */

/* False, after messages, if a value cannot be used; that option counts as not given then. */
bool r_optionsRead(RRenderOptions *out, MeCommandLineOptions *options, MeCommandLineOptions *overrideoptions, bool eat);
/* Says what of the options is left; false if nothing is. */
bool r_refuseOthers(const MeCommandLineOptions *options);

/* ---- The main loop (r_loop.c) ---- */

typedef struct {
    RMainLoopCallBack func;
    RMainLoopCallBackNoData funcNoData;
    void *userdata;
} RTick;

/* r_clock.c. Times in ns. */
typedef struct {
    int64_t last, begun;  /* The frame before began, as counted; this one began, by the clock. */
    double owed;          /* To the simulation. */
    int64_t measuredFrom; /* The pace; */
    double paid;          /* simulated since then. */
    double pace;          /* Simulated time over that of the clock, in the last second. */
} RClock;

typedef struct {
    int frames, ticks; /* Done; a frame that is paused has no tick. */
    RClock clock;
    bool quit, step, pictureRequested;
    int pictures;     /* Of the series, written. */
    int64_t deadline; /* Nanoseconds: when the next frame begins. */
    int64_t progress; /* When progress was last shown. */
    bool progressShown;
    bool isDrawn; /* This frame. */
    bool saving;  /* A picture for a file. */
} RLoop;

/* r_quality.c. Times in ns. */
typedef struct {
    int samples;    /* Of a pixel. */
    int shadowSize; /* Texels, of a side of the shadow's map. */
    int belowSize;  /* The same of the map of the shade below things: 192 scale, so that it costs as pixels do. */
    float scale;    /* Of what is drawn to the picture's width and height. */
    bool ambient;   /* Corners between things are darker. */
} RQualityLevel;
enum { R_QUALITY_AUTO = -1, R_QUALITY_FULL = 3 };
extern const RQualityLevel r_qualityLevels[R_QUALITY_FULL + 1];

typedef struct {
    int level;
    int frames;               /* Of this window, */
    int64_t elapsed, drawing; /* what these took. */
    int64_t shortFor;         /* How long frames have been short. */
    int patience;             /* How many times as long frames have to be short. */
    bool raised;              /* The last change was a raise, not yet proved right. */
    bool isNew;               /* The next frame does not count. */
} RQuality;

void r_qualityRestart(RQuality *q);
/* A frame took so long in all, without waiting for the next one, and its drawing so long. */
void r_qualityFrame(RQuality *q, int64_t frame, int64_t drawing);
int r_pictureQuality(const RRender *rc); /* As asked for: R_QUALITY_AUTO to R_QUALITY_FULL. */
int r_qualityLevel(const RRender *rc);   /* With which the next picture is drawn. */

/* From now on time is owed; what was owed is forgotten. */
void r_clockRestart(RClock *c, int64_t now);
/* A frame begins. */
void r_clockFrame(RClock *c, int64_t now);
/* Has the frame another tick, of so many in a second? */
bool r_clockCountTicks(RClock *c, int64_t now, double rate);
/* Does the program's tick follow the clock: in a window, where no number of frames was asked for? */
bool r_isByClock(const RRender *rc);
void r_frame(RRender *rc, const RTick *tick); /* One turn of the main loop; tick may be null. */
void r_drawNow(RRender *rc);                  /* This frame, if it has not been drawn yet. */
bool r_loopEnded(const RRender *rc);
void r_afterCallBack(const RRender *rc); /* Ends the program if the context has been destroyed meanwhile. */
int64_t r_now(void);                     /* Nanoseconds of a clock that only goes forward. */

/* ---- Pictures of a run (r_picture.c) ---- */

void r_pictureFrame(RRender *rc); /* What F2 and -every ask for in this frame. */
void r_pictureEnd(RRender *rc);   /* What -screenshot asks for, and what an off-screen run writes anyway. */

/* ---- A film of a run (r_film.c) ---- */

typedef struct {
    FILE *pipe; /* To ffmpeg; null before the first picture, and after the last. */
    int width, height, pictures;
    int lastTick; /* That has a picture. */
    bool ended;
} RFilm;

bool r_filmHasMaker(void); /* Whether ffmpeg is installed. */
void r_filmFrame(RRender *rc);
void r_filmEnd(RRender *rc);

/* ---- Drawing (r_draw.c) ---- */

struct RDraw;
bool r_drawStart(RRender *rc, char *reason, size_t size);
void r_drawStop(RRender *rc);
void r_drawFrame(RRender *rc);
bool r_drawRead(RRender *rc, RPicture *picture); /* The frame last drawn. The caller frees picture->rgba. */

/* ---- The context (r_context.c) ---- */

struct RViewer {
    const RBackend *backend; /* Null until RInit has succeeded. */
    void *backendState;
    struct RDraw *draw;
    int width, height; /* Pixels. */
    float scale;       /* Pixels for one of a usual display. */
    int ground;        /* RRenderSetGroundLook's; -1: each ground has its own. */
    bool isMistaken;   /* An option has a value that cannot be used, which has been told. */
    RGraphic *last3D, *last2D;
    int graphicsListed;
    RGraphic *sky;
    R_ARRAY(RLineSegment) lines;      /* RLineAdd's. */
    R_ARRAY(RLineSegment) debugLines; /* MeDebugDrawAPI's, since the last tick began. */
    RNativeLine *lastLine;
    RCamera camera;
    RLights lights;
    RTextures textures;
    RInput input;
    RParameters parameters;
    RHelp help;
    RHelpLayout helpLayout;
    RLoop loop;
    RQuality quality;
    int pictureQuality; /* RRenderSetPictureQuality's. */
    RFilm film;
    ROverlay overlay;
    struct RPanels *panels; /* Null unless something is drawn. */
    RPanelList panelList;   /* RPanelCreate's. */
    void(MEAPI *markFunc)(RRender *rc, void *userdata);
    void *markData;
    bool marking;            /* It is being called. */
    bool overlaying;         /* A panel or marks may be called: the context has to stay. */
    int dockDrawnIn;         /* The last frame in which there was any panel. */
    bool panelsShown;        /* F9. */
    int slow;                /* The tick is called in one of so many frames, or so many times less often; 0 is 1. */
    AcmeReal tickRate;       /* Ticks in a second, without the option. */
    int64_t rateBegin;       /* When ticks began to be counted, */
    int rateTicks;           /* from which number, */
    float rate;              /* and how many there are in a second. */
    RMenuBaseEntry *clicked; /* The menu's entry that the mouse has clicked, or null; */
    bool clickedLess;        /* to do what Left does. */
    char *title, *status;
    AcmeReal fps; /* RRenderDisplayFps; below 0 for none. */
    int sphereSides;
    bool hasBackground;
    float background[3];
    bool wireframe, shadows; /* F4, F5. */
    bool profiling, profileIsOurs;
    RBarState bar;
    RRender *next; /* Of the live contexts. */
};

void r_setScale(RRender *rc, float scale); /* Before there is a window: it also has its first size from it. */
int r_warnings(void);                      /* Given since the first live context was created. */
const char *r_programName(void);

#endif
