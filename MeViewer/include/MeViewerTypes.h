/** @file MeViewerTypes.h
 *  The viewer's structures, enumerations and callback types.
 *
 *  Members that are documented here may be read at any time, and written where the comment says so. All other state
 *  (window, OpenGL objects, input) is hidden behind RRender::m_pViewer. Numbers are AcmeReal, which is float in both
 *  precisions; only transforms are MeReal, because they point into the simulation.
 *
 *  Strings are UTF-8 (ASCII, Latin-1, Greek letters and arrows can be shown). Colours are red, green, blue, alpha in
 *  0..1, in sRGB. Alpha 0 counts as opaque, since old programs write {1, 0, 0, 0} for red; values between 0 and 1 are
 *  transparent.
 */
#ifndef MEVIEWERTYPES_H
#define MEVIEWERTYPES_H

#include "MePrecision.h"

ME_BEGIN_C

/** @name Constants
 *  @{ */
#define NUM_ACTION_CALLBACKS 6               /**< Actions are numbered 0 to 5; 1 to 5 have keys. */
#define NEARZ                0.300000012f    /**< Near plane of the camera, unless it is close to its look-at point. */
#define FARZ                 500             /**< Minimum distance of the far plane; larger if a scene needs it. */
#define OFFSET_2D            9.99999975e-05f /**< Depth between two neighbours of the 2D list. */
/** @} */

/** @name Modifier keys: bits of RMouseCallBack's argument
 *  @{ */
#define RCONTROL 1
#define RSHIFT   2
#define RALT     4
/** @} */

/** @name What a renderer can do: bits of RRender::m_nCapabilities
 *  @{ */
#define RJOYSTICK         1
#define RMOUSE            2
#define RTEXT             4
#define RLINES            8
#define RLINESTRIPS       16
#define RPOINTS           32
#define RQUADSTRIPS       64
#define RTRIFANS          128
#define RTRISTRIPS        256
#define RAMBIENT          512
#define RDIFFUSE          1024
#define REMISSIVE         2048
#define RSPECULAR         4096
#define RWIREFRAME        8192
#define RFLATSHADED       16384
#define RSMOOTH           32768
#define RTEXTURES         65536
#define MENUS             131072
#define ASSIGNABLEBUTTONS 262144
/** @} */

/** @name Parts of a scene's state, as bits
 *  Kept for source compatibility: no function of this viewer takes them.
 *  @{ */
#define MEV_AMBLIGHT   1
#define MEV_DIRLIGHT1  2
#define MEV_DIRLIGHT2  4
#define MEV_POINTLIGHT 8
#define MEV_CAMERA     16
/** @} */

/** The lights of a context (RLightSwitchOn). */
typedef enum RRenderLight { kRAmbient = 0, kRDirect1 = 1, kRDirect2 = 2, kRPoint = 3 } RRenderLight;

/** Where a context draws. The PlayStation values are kept for source compatibility. */
typedef enum RRenderType {
    kRDefault = 0,   /**< A window if available, else an off-screen buffer. */
    kROpenGL = 1,    /**< A window (-gl). */
    kRPs2 = 3,       /**< Not on this platform. */
    kRPs2HiG = 4,    /**< Not on this platform. */
    kRNull = 6,      /**< Nothing is drawn (-null). */
    kRBenchmark = 7, /**< Nothing is drawn (-bench). */
    kROSMesa = 8     /**< An off-screen buffer (-osmesa). An addition to the 1.2 interface. */
} RRenderType;

/** How solid graphics are drawn (RRender::m_Quality). */
typedef enum RRenderQuality {
    kRQualityWireframe = 0, /**< Edges only. */
    kRFilled = 1,           /**< Unlit colour. */
    kRQualityFlat = 2,      /**< Lit, each triangle flat. */
    kRQualitySmooth = 3     /**< Lit, smooth. The default. */
} RRenderQuality;

/** The eight direction buttons. */
typedef enum RButtonList {
    kRButtonUp = 0,
    kRButtonDown = 1,
    kRButtonLeft = 2,
    kRButtonRight = 3,
    kRButtonUp2 = 4,
    kRButtonDown2 = 5,
    kRButtonLeft2 = 6,
    kRButtonRight2 = 7,
    kRButtons = 8 /**< Their number. */
} RButtonList;

typedef enum RMouseButtonWhich { kRLeftButton = 1, kRMiddleButton = 2, kRRightButton = 3 } RMouseButtonWhich;
typedef enum RMouseButtonEvent { kRNewlyPressed = 1, kRStillPressed = 2, kRNewlyReleased = 3 } RMouseButtonEvent;

typedef struct _RRender RRender;
typedef struct RGraphic RGraphic;
typedef struct RNativeLine RNativeLine;
typedef struct RMenu RMenu;
typedef struct RMenuBaseEntry RMenuBaseEntry;
typedef struct RPerformanceBar RPerformanceBar;
typedef RGraphic *RGraphicPtr;
typedef RNativeLine *RNativeLinePtr;
typedef struct RParticleSystem RParticleSystem;
typedef RParticleSystem *RPSystemPtr;

/** @name Callbacks
 *  Called between frames, when no step is in progress: they may do anything with the simulation.
 *  @{ */
typedef void(MEAPI *RMainLoopCallBack)(RRender *rc, void *userdata);
typedef void(MEAPI *RMainLoopCallBackNoData)(RRender *rc); /**< The form of Tick in the Dynamics guide. */
typedef void(MEAPI *RButtonPressCallBack)(RRender *rc, void *userdata);
typedef void(MEAPI *RButtonPressCallBackNoData)(RRender *rc); /**< The form described in App. B. */
/** A mouse event: @a x to the right and @a y DOWN, in pixels from the window's upper left corner. */
typedef void(MEAPI *RMouseCallBack)(RRender *rc, int x, int y, int modifiers, RMouseButtonWhich which,
                                    RMouseButtonEvent event, void *userdata);
typedef void(MEAPI *RJoystickCallBack)(RRender *rc, AcmeReal x, AcmeReal y, void *userdata);
typedef void(MEAPI *RCreateCallback)(RRender *rc);
typedef void(MEAPI *RMenuToggleCallback)(MeBool on);
typedef void(MEAPI *RMenuValueCallback)(MeReal value);
typedef void(MEAPI *RMenuEntryFunc)(RMenuBaseEntry *entry);
typedef void(MEAPI *RMenuEntryDisplayFunc)(RMenuBaseEntry *entry, MeReal x, MeReal y);
/** @} */

/** A vertex of a triangle. The program may write all members at any time; the next frame shows it. */
typedef struct RObjectVertex {
    AcmeReal m_X, m_Y, m_Z;    /**< Position in the graphic's own frame. */
    AcmeReal m_NX, m_NY, m_NZ; /**< Normal, of length 1. */
    AcmeReal m_U, m_V;         /**< Texture coordinates, 0..1; v is 0 at the upper edge of the picture. */
} RObjectVertex;

/** The look of a graphic. The program may write all members but m_Matrix at any time; the next frame shows it. */
typedef struct RObjectHeader {
    MeMatrix4 m_Matrix;       /**< Copy of *m_pLWMatrix in the last frame. */
    int m_nNumVertices;       /**< Vertices in use: a multiple of 3, at most RGraphic::m_nMaxNumVertices. */
    int m_nTextureID;         /**< From RRenderTextureCreate; -1 for none. */
    int m_bIsWireFrame;       /**< Not 0: only the edges are drawn. */
    float m_ColorAmbient[4];  /**< Reflectance of ambient light. */
    float m_ColorDiffuse[4];  /**< Reflectance of other lights; its alpha is the graphic's. */
    float m_ColorEmissive[4]; /**< Added to the reflected light. */
    float m_ColorSpecular[4]; /**< Highlights, in addition to a slight sheen of all graphics. */
    AcmeReal m_SpecularPower; /**< Shininess: 1 is dull, 100 is polished. */
} RObjectHeader;

struct RGraphicPart; /* The viewer's private data of a graphic. */

/** A graphic: a list of triangles with one transform and one look; or a line, or a text. */
struct RGraphic {
    union {
        MeMatrix4Ptr m_pLWMatrix; /**< Local to world, read every frame; null is the identity. May be written. */
        MeMatrix4Ptr m_matrix;    /**< The same pointer under the Dynamics guide's name. */
    };
    RObjectHeader *m_pObject;     /**< Never null. */
    RObjectVertex *m_pVertices;   /**< Follows *m_pObject in memory. */
    int m_nMaxNumVertices;        /**< Capacity for vertices. Read only. */
    RGraphic *m_pNext, *m_pPrev;  /**< Neighbours in its list. Read only. */
    struct RGraphicPart *m_pPart; /**< The viewer's private data. */
};

/** The ends of a line. */
typedef struct RNativeLineVectors {
    AcmeReal m_Start[3];
    AcmeReal m_End[3];
} RNativeLineVectors;

/** A line of constant thickness on the screen. */
struct RNativeLine {
    RNativeLineVectors m_Vectors; /**< In the line's own frame. May be written. */
    AcmeReal m_Color[4];          /**< May be written. */
    const MeVector4 *m_pLWMatrix; /**< Local to world, read every frame; null is the identity. May be written. */
    RNativeLine *m_pNext;         /**< Next in the context's list. Read only. */
    RRender *m_pRender;           /**< The context whose list it is in; null for none. Read only. */
};

/** Triangles at the program's positions, facing the camera. */
struct RParticleSystem {
    int m_nParticles;         /**< Read only. */
    MeVector3 *m_Positions;   /**< World frame; owned by the program, read every frame. May be written. */
    AcmeReal m_Size;          /**< Side of a triangle. May be written. */
    RGraphic *m_pGraphic;     /**< The graphic that is drawn: its colour and texture may be changed; other members are
                                   private. */
    RParticleSystem *m_pNext; /**< Next in the context's list. Read only. */
    RRender *m_pRender;       /**< The context whose list it is in; null for none. Read only. */
};

/** A directional light. After a change in the main loop, set the context's force-update flag. */
typedef struct RDirectLight {
    int m_bUseLight;           /**< Not 0: it shines. */
    AcmeReal m_Direction[3];   /**< Direction in which the light travels, any length. */
    AcmeReal m_rgbDiffuse[3];  /**< 1: a white surface that faces the light is fully lit. */
    AcmeReal m_rgbSpecular[3]; /**< Strength of highlights. */
    AcmeReal m_rgbAmbient[3];  /**< Added to the ambient light. */
} RDirectLight;

/** A point light. Its intensity is divided by constant + linear d + quadratic d^2 at distance d. */
typedef struct RPointLight {
    int m_bUseLight;        /**< Not 0: it shines. */
    AcmeReal m_Position[3]; /**< World. */
    AcmeReal m_rgbDiffuse[3];
    AcmeReal m_rgbSpecular[3];
    AcmeReal m_rgbAmbient[3];
    AcmeReal m_AttenuationConstant;
    AcmeReal m_AttenuationLinear;    /**< 1/length */
    AcmeReal m_AttenuationQuadratic; /**< 1/length^2 */
} RPointLight;

/** The performance bar's figures. Read only; RPerformanceBarUpdate writes them. */
struct RPerformanceBar {
    AcmeReal m_Collision; /**< Seconds per frame, as the others; averaged over some frames. */
    AcmeReal m_Dynamics;
    AcmeReal m_Render;
    AcmeReal m_Idle;
    RGraphic *m_pTicks; /**< From RPerformanceBarCreateTicks, or null. */
    int m_bVisible;     /**< F3 toggles it. May be written. */
};

/** The callback of a button. */
typedef struct RCallBackDataButton {
    RButtonPressCallBack m_Func;             /**< Null if none. */
    RButtonPressCallBackNoData m_FuncNoData; /**< Null if none. At most one of the two is set. */
    void *m_pUserData;
    char m_Text[64]; /**< Description of the button, for the help; "" if unknown. */
} RCallBackDataButton;

typedef struct RCallBackDataMouse {
    RMouseCallBack m_Func; /**< Null if none. */
    void *m_pUserData;
    char m_Text[64];
} RCallBackDataMouse;

typedef struct RCallBackDataJoystick {
    RJoystickCallBack m_Func; /**< Stored, but never called on this platform. */
    void *m_pUserData;
    char m_Text[64];
} RCallBackDataJoystick;

/** The look of a ground (RGraphicGroundPlaneCreate). */
typedef enum RGroundLook {
    kRGroundGrid,    /**< Lines, one unit apart, every tenth bolder. */
    kRGroundChecker, /**< Squares in two tones, one unit wide. */
    kRGroundPlain,   /**< One tone. */
    kRGroundEarth    /**< Spots of many sizes in brown and green. */
} RGroundLook;

/** All callbacks of a context. Read only; the RRenderSet*CallBack functions write them. */
typedef struct RRenderCallBacks {
    RCallBackDataButton m_Button[kRButtons];
    RCallBackDataButton m_Action[NUM_ACTION_CALLBACKS];
    RCallBackDataMouse m_Mouse;
    RCallBackDataJoystick m_Joystick;
} RRenderCallBacks;
typedef RRenderCallBacks *RRenderCallBacksPtr;

/** The options that a context was created with. Read only. */
typedef struct RRenderOptions {
    RRenderType m_Type;      /**< As requested; the actual type is RRender::m_RenderType. */
    int m_nWidth, m_nHeight; /**< -size, pixels; else 960x600 times the scale. */
    int m_bSize;             /**< -size was given. */
    AcmeReal m_Scale;        /**< -scale; 0 if it was not given. */
    int m_nFrames;           /**< -frames; 0 for no end. */
    int m_nRate;             /**< -rate: ticks per second (RRenderSetTickRate); 0 if not given. */
    int m_nWorkers;          /**< -workers: number of threads on which a program's worlds are to step; 0 if not
                                  given. */
    AcmeReal m_Advise[2];    /**< -advise: seconds to try settings for, and seconds to wait before; 0 if not given, or
                                  if a program has handled it. */
    int m_nEvery;            /**< -every; 0: no series of pictures, and numbers only at the end. */
    int m_bPaused;           /**< -paused */
    int m_bBar;              /**< -bar */
    int m_bProfile;          /**< -profile */
    int m_bCamera;           /**< -camera was given. */
    AcmeReal m_Camera[3];    /**< -camera: distance, theta, phi. */
    int m_bQuality;          /**< -quality was given. */
    int m_nQuality;          /**< -quality: as RRenderSetPictureQuality. */
    int m_Ground;            /**< -ground: an RGroundLook; -1 if it was not given. */
    char m_Screenshot[256];  /**< -screenshot; "" if not given. */
    char m_Film[256];        /**< -film; "" if not given. */
    char m_Keys[512];        /**< -key; "" if not given. */
} RRenderOptions;

struct RViewer; /* Private state of the platform. */

/**
 * A rendering context: the state of the viewer. Create it with RRenderContextCreate only.
 */
struct _RRender {
    char m_AppName[40];       /**< The program's name, $APPNAME in texts. May be written. */
    RRenderType m_RenderType; /**< Type of the output. Read only. */
    RRenderQuality m_Quality; /**< May be written. */
    int m_nCapabilities;      /**< RMOUSE | RTEXT | ... Read only. */
    RRenderOptions m_Options; /**< Read only. */

    AcmeReal m_CameraLookAt[3];   /**< World. After writing a camera member, call RCameraUpdate. */
    AcmeReal m_CameraDist;        /**< From the look-at point, at least 0.01. */
    AcmeReal m_CameraAngle;       /**< theta, radians, -pi..pi */
    AcmeReal m_CameraElevation;   /**< phi, radians, -pi/2..pi/2 */
    AcmeReal m_CameraFov;         /**< Vertical field of view, radians. */
    AcmeReal m_CameraPos[3];      /**< World. Read only. */
    MeMatrix4 m_CameraMatrix;     /**< World to camera: x right, y up, looking along -z. Read only. */
    MeMatrix4 m_ProjectionMatrix; /**< Camera to clip coordinates. Read only. */

    RGraphic *m_p3DGraphics;             /**< First of the 3D list. Read only. */
    RGraphic *m_p2DGraphics;             /**< First of the 2D list. Read only. */
    RNativeLine *m_pNativeLines;         /**< First of the native lines. Read only. */
    RParticleSystem *m_pParticleSystems; /**< The first one. Read only. */

    int m_bUseAmbientLight;             /**< May be written, as the lights below. */
    AcmeReal m_rgbAmbientLightColor[4]; /**< A change takes effect in the next frame. */
    RDirectLight m_DirectLight1;        /**< The key light, which casts shadows. */
    RDirectLight m_DirectLight2;        /**< The fill light. */
    RPointLight m_PointLight;           /**< Off unless switched on. */
    int m_bForceDirectLight1Update;     /**< Set it to non-zero after a change; the next frame clears it. */
    int m_bForceDirectLight2Update;
    int m_bForcePointLightUpdate;

    int m_bPause;                 /**< The tick is not called. Read only: RRenderSetPause. */
    int m_bShowHelp;              /**< Read only: RRenderToggleUserHelp. */
    RRenderCallBacks m_CallBacks; /**< Read only. */
    union {
        RPerformanceBar *m_pPerformanceBar; /**< Or null. */
        RPerformanceBar *m_PerformanceBar;  /**< The same pointer, for old programs. */
    };
    RMenu *m_pCurrentMenu; /**< The visible menu, or null. */
    RMenu *m_pDefaultMenu; /**< The menu of the menu key, or null. */

    struct RViewer *m_pViewer; /**< The viewer's private data. */
};

/** Common first member of menu entries. */
struct RMenuBaseEntry {
    RMenu *m_pMenu;                  /**< The menu that it is in. */
    char *m_Name;                    /**< Its text. */
    RMenuEntryFunc m_Execute1;       /**< Right: more, on, open. */
    RMenuEntryFunc m_Execute2;       /**< Left: less, off, back. */
    RMenuEntryDisplayFunc m_Display; /**< Draws the entry with its left edge and baseline at x, y (pixels, y down). */
    RMenuBaseEntry *m_pNext, *m_pPrev;
};

typedef struct RMenuToggleEntry {
    RMenuBaseEntry m_Base;
    RMenuToggleCallback m_Func; /**< Or null. */
    MeBool m_Value;
} RMenuToggleEntry;

typedef struct RMenuValueEntry {
    RMenuBaseEntry m_Base;
    RMenuValueCallback m_Func; /**< Or null. */
    MeReal m_Low, m_High, m_Increment, m_Value;
} RMenuValueEntry;

typedef struct RMenuSubmenuEntry {
    RMenuBaseEntry m_Base;
    RMenu *m_pSubmenu; /**< Null once it has been destroyed. */
} RMenuSubmenuEntry;

/** A menu. Read only; the RMenu functions write it. */
struct RMenu {
    RRender *m_pRender; /**< The context that shows it. */
    char *m_Name;       /**< Its title. */
    RMenuBaseEntry *m_pFirst, *m_pLast;
    RMenuBaseEntry *m_pCurrent; /**< The highlighted entry; null while there is none. */
    RMenu *m_pParent;           /**< The menu that opened it, or null. */
    RMenu *m_pNext;             /**< Next in the context's list. */
};

#define RDeleteRenderContext RRenderContextDestroy /**< An old name. */

ME_END_C

#endif
