/* What the drawing files share: OpenGL through one table of functions, and what is kept on the graphics card. */
#ifndef R_DRAW_I_H
#define R_DRAW_I_H

#include <GL/glcorearb.h>

#include "r_i.h"

/* ---- Shaders (r_shaders.c): null-terminated lists of pieces ---- */

typedef enum {
    rProgramBackground,
    rProgramSolid,
    rProgramGround,
    rProgramSolidExtra, /* With all lights; see r_shaders.c. */
    rProgramGroundExtra,
    rProgramDepth,
    rProgramOcclusion,
    rProgramAmbient,
    rProgramAmbientMean,
    rProgramLine,
    rProgramResolve,
    rProgramOverlay,
    R_PROGRAMS
} RProgram;

typedef struct {
    const char *const *vertex, *const *fragment;
} RProgramSource;
extern const RProgramSource r_programSources[R_PROGRAMS];

/* ---- OpenGL (r_gl.c) ----
 * libGL and libOSMesa both have functions of these names. So none is called by its name: each is asked for from the
 * backend that made the context. */

#define R_GL_FUNCTIONS(X)                                                                                              \
    X(ACTIVETEXTURE, ActiveTexture)                                                                                    \
    X(ATTACHSHADER, AttachShader)                                                                                      \
    X(BINDBUFFER, BindBuffer)                                                                                          \
    X(BINDBUFFERBASE, BindBufferBase)                                                                                  \
    X(BINDFRAMEBUFFER, BindFramebuffer)                                                                                \
    X(BINDRENDERBUFFER, BindRenderbuffer)                                                                              \
    X(BINDTEXTURE, BindTexture)                                                                                        \
    X(BINDVERTEXARRAY, BindVertexArray)                                                                                \
    X(BLENDFUNCSEPARATE, BlendFuncSeparate)                                                                            \
    X(BLITFRAMEBUFFER, BlitFramebuffer)                                                                                \
    X(BUFFERDATA, BufferData)                                                                                          \
    X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                                                                  \
    X(CLEAR, Clear)                                                                                                    \
    X(CLEARCOLOR, ClearColor)                                                                                          \
    X(COLORMASK, ColorMask)                                                                                            \
    X(COMPILESHADER, CompileShader)                                                                                    \
    X(CREATEPROGRAM, CreateProgram)                                                                                    \
    X(CREATESHADER, CreateShader)                                                                                      \
    X(CULLFACE, CullFace)                                                                                              \
    X(DELETEBUFFERS, DeleteBuffers)                                                                                    \
    X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                                                                          \
    X(DELETEPROGRAM, DeleteProgram)                                                                                    \
    X(DELETERENDERBUFFERS, DeleteRenderbuffers)                                                                        \
    X(DELETESHADER, DeleteShader)                                                                                      \
    X(DELETETEXTURES, DeleteTextures)                                                                                  \
    X(DELETEVERTEXARRAYS, DeleteVertexArrays)                                                                          \
    X(DEPTHFUNC, DepthFunc)                                                                                            \
    X(DEPTHMASK, DepthMask)                                                                                            \
    X(DISABLE, Disable)                                                                                                \
    X(DRAWARRAYS, DrawArrays)                                                                                          \
    X(DRAWARRAYSINSTANCED, DrawArraysInstanced)                                                                        \
    X(DRAWBUFFER, DrawBuffer)                                                                                          \
    X(DRAWELEMENTSINSTANCED, DrawElementsInstanced)                                                                    \
    X(ENABLE, Enable)                                                                                                  \
    X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)                                                                \
    X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer)                                                                \
    X(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D)                                                                      \
    X(GENBUFFERS, GenBuffers)                                                                                          \
    X(GENFRAMEBUFFERS, GenFramebuffers)                                                                                \
    X(GENRENDERBUFFERS, GenRenderbuffers)                                                                              \
    X(GENTEXTURES, GenTextures)                                                                                        \
    X(GENVERTEXARRAYS, GenVertexArrays)                                                                                \
    X(GENERATEMIPMAP, GenerateMipmap)                                                                                  \
    X(GETINTEGERV, GetIntegerv)                                                                                        \
    X(GETPROGRAMINFOLOG, GetProgramInfoLog)                                                                            \
    X(GETPROGRAMIV, GetProgramiv)                                                                                      \
    X(GETSHADERINFOLOG, GetShaderInfoLog)                                                                              \
    X(GETSHADERIV, GetShaderiv)                                                                                        \
    X(GETSTRING, GetString)                                                                                            \
    X(GETUNIFORMBLOCKINDEX, GetUniformBlockIndex)                                                                      \
    X(GETUNIFORMLOCATION, GetUniformLocation)                                                                          \
    X(LINKPROGRAM, LinkProgram)                                                                                        \
    X(PIXELSTOREI, PixelStorei)                                                                                        \
    X(POLYGONOFFSET, PolygonOffset)                                                                                    \
    X(READBUFFER, ReadBuffer)                                                                                          \
    X(READPIXELS, ReadPixels)                                                                                          \
    X(RENDERBUFFERSTORAGEMULTISAMPLE, RenderbufferStorageMultisample)                                                  \
    X(SCISSOR, Scissor)                                                                                                \
    X(SHADERSOURCE, ShaderSource)                                                                                      \
    X(TEXIMAGE2D, TexImage2D)                                                                                          \
    X(TEXPARAMETERFV, TexParameterfv)                                                                                  \
    X(TEXPARAMETERI, TexParameteri)                                                                                    \
    X(UNIFORM1F, Uniform1f)                                                                                            \
    X(UNIFORM1I, Uniform1i)                                                                                            \
    X(UNIFORM2F, Uniform2f)                                                                                            \
    X(UNIFORMBLOCKBINDING, UniformBlockBinding)                                                                        \
    X(UNIFORMMATRIX4FV, UniformMatrix4fv)                                                                              \
    X(USEPROGRAM, UseProgram)                                                                                          \
    X(VERTEXATTRIBDIVISOR, VertexAttribDivisor)                                                                        \
    X(VERTEXATTRIBPOINTER, VertexAttribPointer)                                                                        \
    X(VIEWPORT, Viewport)

typedef struct {
#define X(type, name) PFNGL##type##PROC name;
    R_GL_FUNCTIONS(X)
#undef X
} RGL;

/* Fills the table; false with a reason if OpenGL is older than 3.3 or lacks a function. */
bool r_glLoad(RGL *gl, RProc (*proc)(const char *name), char *reason, size_t size);
/* A program; 0 with a reason if the shaders do not compile. */
GLuint r_glProgram(const RGL *gl, const RProgramSource *source, char *reason, size_t size);

/* Uniform block "Frame", std140: the same for everything in a frame. */
typedef struct {
    float viewProjection[16];
    float shadow[16];        /* World to the shadow map's texture coordinates and depth. */
    float eye[4];            /* xyz; w: 1 with perspective, 0 without. */
    float back[4];           /* Towards the viewer. */
    float right[4], up[4];   /* Half of what is seen at distance 1; 0 without perspective. */
    float viewport[4];       /* Pixels: width and height of the scene, width of lines, width of the picture. */
    float sky[4], bounce[4]; /* Ambient light from above and from below. */
    float keyDirection[4], keyColor[4], keySpecular[4]; /* Directions point to the light. */
    float fillDirection[4], fillColor[4], fillSpecular[4];
    float pointPosition[4], pointColor[4], pointSpecular[4], pointAttenuation[4];
    float shadowSettings[4]; /* Texel (texture), texel (world), strength, (depth per length / texture per length)^2 */
    float occlusion[4];      /* Corner x, z; 1 / size; strength. */
    float ground[4];         /* Height of the ground; 1 if there is one; height up to which things darken it. */
    float fade[4];           /* Middle x, z; where the ground begins to fade, where it ends. */
    float horizon[4], zenith[4];
    float quality[4]; /* 1 lit, 1 flat. */
} RFrameBlock;

/* ---- Meshes (r_mesh.c): one for all graphics whose vertices are the same ---- */

typedef struct {
    float a[3], b[3];
} REdge;

typedef struct {
    uint64_t hash[2];
    int number;      /* In the order of their making. */
    int vertexCount; /* As given; negative in r_detail.c. */
    GLuint array, vertices, indices;
    GLsizei indexCount;
    bool closed;             /* Inside is never seen: faces that look away need not be drawn. */
    float centre[3], radius; /* Round all vertices. */
    bool finite;
    REdge *edges; /* For wireframes; made when first needed. */
    size_t edgeCount;
    int lastFrame; /* In which it was drawn. */
} RMesh;

typedef R_ARRAY(RMesh *) RMeshes;

/* ---- What is drawn in a frame (r_scene.c), in the upright frame ---- */

/* One instance, as the shaders read it: seven vectors. */
typedef struct {
    float row[3][4];                                        /* Place = row . (x, y, z, 1). */
    float diffuse[4], ambient[4], emissive[4], specular[4]; /* Linear; specular[3] and emissive[3]: see r_scene.c. */
} RInstance;

typedef enum { rOpaque, rBlended, rFloor } RClass;

typedef struct {
    RClass class;
    const RMesh *mesh;
    int texture;
    float centre[3], radius;
    float depth;  /* From the camera, for blending order. */
    size_t order; /* In the list. */
    RInstance instance;
} RItem;

typedef struct {
    R_ARRAY(RItem) items;
    R_ARRAY(RInstance) instances; /* Of the items, in their order. */
    RLineSegments lines;
    size_t casters;
    float casterLow[3], casterHigh[3];
    float casterSize;        /* The mean radius. */
    float eye[3], lookAt[3]; /* The camera's. */
    bool hasGround;
    float groundHeight; /* Of the first ground. */
    float farthest;     /* Distance from the camera to what is farthest. */
} RScene;

/* ---- Everything (r_draw.c) ---- */

typedef struct {
    GLuint frame, color, depth;
} RTarget;

typedef struct RDraw {
    RGL gl;
    GLuint programs[R_PROGRAMS];
    GLuint frameBlock;
    RFrameBlock block;
    RMeshes meshes;
    int meshesMade;
    RScene scene;
    GLuint instanceBuffer, skyBuffer;
    GLuint lineArray, lineBuffer;
    GLuint overlayArray, overlayBuffer, overlayIndices;
    GLuint emptyArray;
    GLuint fontTexture;
    int fontVersion; /* That the texture has. */
    GLuint textures[R_MAX_TEXTURES];
    bool textureTried[R_MAX_TEXTURES];
    RTarget samples;             /* Several samples per pixel, linear light. */
    RTarget linear;              /* The same, one per pixel; with depth where that is used for ambient. */
    RTarget ambient;             /* Half as wide and high: how much of the sky is open; how far away. */
    RTarget ambientMean;         /* The former, averaged. */
    RTarget picture;             /* As it is shown. */
    RTarget shadow;              /* Depth from the key light. */
    RTarget below;               /* Depth from below. */
    RTarget occlusion;           /* How much sky the ground sees. */
    int width, height;           /* Of the picture, */
    int sceneWidth;              /* of which the scene has so much. */
    int drawnWidth, drawnHeight; /* Of the two before it. */
    int level;                   /* Of quality; -1 before the first picture. */
    int frame;
    bool drawn;  /* There is a picture. */
    bool warned; /* That there is no room for one. */
    float shadowMatrix[16], belowMatrix[16];
    float belowSize[2]; /* Side and height of what is seen from below. */
} RDraw;

/* r_target.c */
/* To a picture's size and a level of quality; false if there is no room. */
bool r_targetsResize(RDraw *d, int width, int height, int sceneWidth, int level);
void r_targetsStart(RDraw *d);
void r_targetsStop(RDraw *d);

/* r_mesh.c */
RMesh *r_meshOf(RDraw *d, RGraphic *rg);
/* By a hash and a count, which are together the name of a mesh; a negative count is r_detail.c's. */
RMesh *r_meshFind(RDraw *d, const uint64_t hash[2], int vertexCount, struct RGraphicPart *part);
RMesh *r_meshAdd(RDraw *d, const uint64_t hash[2], int vertexCount, const RObjectVertex *vertices, int count);
bool r_meshEdges(RMesh *mesh, const RGraphic *rg);
void r_meshesTrim(RDraw *d);               /* Forgets those that have not been drawn for a while. */
void r_meshesFree(RDraw *d, bool current); /* current: OpenGL can still be called. */

/* r_detail.c */
/* Null if the graphic is not a shape that is known, or has been changed since. */
RMesh *r_detailMesh(RDraw *d, RGraphic *rg, float pixelsPerUnit);
void r_detailTransform(const RShape *shape, float m[16]); /* From the shape of size 1 to the graphic's. */

/* r_scene.c */
void r_sceneGather(RRender *rc, RDraw *d);
void r_sceneFree(RScene *scene);
void r_drawItems(RRender *rc, RDraw *d, RClass class);
bool r_castsShadow(const RItem *item);
void r_drawCasters(RDraw *d);
void r_drawSky(RRender *rc, RDraw *d);

/* r_block.c */
float r_toLinear(float screen);       /* From a screen's value to light. */
bool r_needsExtra(const RRender *rc); /* Lights that only the programs with "Extra" in their names know. */
void r_blockFill(RRender *rc, RDraw *d);

/* r_shadow.c */
void r_shadowFit(RRender *rc, RDraw *d); /* Fills the block's part. */
void r_shadowDraw(RDraw *d);

/* r_draw_lines.c, r_draw_overlay.c, r_draw_texture.c */
bool r_linesStart(RDraw *d);
void r_linesDraw(RDraw *d);
bool r_overlayStart(RDraw *d);
void r_overlayDraw(RRender *rc, RDraw *d);
GLuint r_textureObject(RRender *rc, RDraw *d, int id); /* 0 if there is none. */

#endif
