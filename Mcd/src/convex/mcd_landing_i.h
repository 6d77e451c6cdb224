/* Inside Mcd: where two shapes will touch that come nearer and tilt before the next test. */
#ifndef MCD_LANDING_H
#define MCD_LANDING_H

#include "convex/mcd_shape_i.h"
#include "convex/mcd_vector_i.h"

/* ---- corners that may come down (mcd_cap.c) ---- */

enum { MCD_CAP_POINTS = 48 };
typedef struct McdCap {
    int count, corner[MCD_CAP_POINTS]; /* numbers of vertices */
    double point[MCD_CAP_POINTS][3];   /* without the rounding */
} McdCap;
/* Whether the shape has corners and edges: a hull or a box. */
MeBool mcd_isPolyhedron(const McdShape *s);
/* Whether it is a solid of revolution between two discs: a cylinder or a cone. */
MeBool mcd_isTurned(const McdShape *s);
/* The corners of a polyhedron that a tilt (rad) may bring as far in a direction as the farthest one. Returns their
 * number; 0: of other shapes. */
int mcd_capToward(const McdShape *s, const double direction[3], double tilt, McdCap *cap);
/* The edges from corners of a cap, at most `max`: the numbers of both vertices, the first one of the cap, and its
 * own. */
int mcd_capEdges(const McdShape *s, const McdCap *cap, int (*edge)[3], int max);
void mcd_cornerAt(const McdShape *s, int corner, double point[3]);
/* Where the line through a point along a direction is within a polyhedron: from point + low direction on. */
MeBool mcd_spanAlong(const McdShape *s, const double point[3], const double direction[3], double slack, double *low,
                     double *high);

/* ---- motion before the next test (mcd_landing.c) ---- */

/* Relative to the size: corners that will overlap by more are contacts. x2 fails Mst_Landing. */
static const double mcd_mayEnter = 2e-3;

/* One of two shapes: its mass and inertia, in units that both share, and its course. */
typedef struct McdLander {
    double centre[3], turn[3], shift; /* m; rad; m, along the normal */
    double mobility, inverse[3][3];   /* of mass and inertia; 0 of what is not free */
    double roll;                      /* of what may roll on: the sine of its lean; else 0 */
} McdLander;

typedef struct McdLanding {
    double normal[3], enter; /* m: the overlap that may remain */
    double turn;             /* rad: by how much they tilt relative to each other, at most, if nothing pushes */
    double fall;             /* m: by how much gravity alone brings them nearer, at most */
    McdLander side[2];
    double shift, change[2][3]; /* m, rad: by how much pushes have moved the shapes apart and turned them */
    double tilt;                /* rad: by how much they may tilt beyond that */
} McdLanding;

enum { MCD_LANDING_SITES = 128 };
/* A place where the shapes may touch. */
typedef struct McdSite {
    double on[2][3], separation; /* m: the points of both surfaces, and their distance along the normal */
    double target, gap;          /* m: the least separation at the next test; that of the free motion */
    double lever[2][3];          /* m: of the normal about both centres */
    double push, softness;       /* the impulse there, and the response to it */
    MeBool isChosen;
} McdSite;

/* Reads how the shapes will move; false: it is not known, or they do not come nearer. */
MeBool mcd_landingForecast(McdReach reach, McdForecast *f);
/* rad: by how much shapes of a size may tilt. */
double mcd_landingTilt(const McdForecast *f, const double normal[3], double size);
/* Begins for two shapes. False: they will not overlap more. */
MeBool mcd_landingBegin(McdLanding *l, const McdForecast *f, const McdShape *a, const McdShape *b,
                        const double normal[3]);
/* Chooses, beside keptCount chosen sites, those that would overlap at the next test while the chosen ones do not.
 * Returns the number of all, at most maxCount. on and separation of the sites are set. */
int mcd_landingChoose(McdLanding *l, McdSite *site, int count, int maxCount, int keptCount, int *kept);

/* Whether a further site may be needed, beside those that were chosen, if its gap is at least `separation`. */
MeBool mcd_landingMayNeed(const McdLanding *l, McdSite *further, const McdSite *site, int count);

#endif
