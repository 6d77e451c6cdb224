/* What a pair of convex shapes costs: nanoseconds per pair of kinds, standing on each other, tilted a little, touching
 * in any way, deep in each other, and a little apart; for comparison, ODE's boxes, where it is installed, and FCL's
 * boxes and cylinders.
 *
 *     nearfield [--rounds COUNT] */
#include "timing.h"

#include "convex/mcd_vector_i.h"
#include "nearfield_fcl.h"
#include "reference.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef NEARFIELD_ODE
#include <ode/ode.h>
extern int dBoxBox(const dVector3 p1, const dMatrix3 R1, const dVector3 side1, const dVector3 p2, const dMatrix3 R2,
                   const dVector3 side2, dVector3 normal, dReal *depth, int *return_code, int flags,
                   dContactGeom *contact, int skip);
#endif

enum { PAIRS = 1000 };
enum { STANDING, TILTED, TOUCHING, DEEP, APART, POSES };
static const char *const poseName[POSES] = {"standing", "tilted", "touching", "deep", "apart"};
static McdShape a[PAIRS], b[PAIRS];

/* a on top of b, a hundredth of their sizes in it, or, apart, half of that above; in any way: deep in it, or as much as
 * shapes at rest are. */
static void makePair(McdShape *x, McdShape *y, int kindX, int kindY, int pose, Random *r) {
    const double up[3] = {0, 0, 1};
    double axis[3];
    shape_random(x, kindX, 1, 0, r);
    shape_random(y, kindY, 1, 0, r);
    random_direction(r, axis);
    if (pose == TILTED)
        shape_rotate(x, axis, random_between(r, 0, 1e-3));
    if (pose == TOUCHING || pose == DEEP) {
        shape_rotateRandomly(x, r);
        shape_rotateRandomly(y, r);
    }
    shape_move(x, random_between(r, -.3, .3), random_between(r, -.3, .3), 0);
    shape_move(x, 0, 0, (pose == APART ? .005 : pose == DEEP ? -.4 : -.01) - reference_along(x, y, up));
    if (pose == TOUCHING) {
        double onX[3], onY[3], n[3];
        const double out = -1e-4 - mcd_convexDistance(x, y, onX, onY, n);
        shape_move(x, out * n[0], out * n[1], out * n[2]);
    }
    random_direction(r, axis);
    shape_rotate(x, axis, 1);
    shape_rotate(y, axis, 1);
}

/* The best of the rounds, per pair. */
static double timePairs(int rounds, int *contacts) {
    double best = INFINITY;
    for (int i = 0; i < rounds; i++) {
        const double begin = now();
        *contacts = 0;
        for (int k = 0; k < PAIRS; k++) {
            McdManifold m;
            *contacts += mcd_convexManifold(&a[k], &b[k], (McdReach){.margin = .01}, &m);
        }
        best = fmin(best, (now() - begin) / PAIRS);
    }
    return best;
}

#ifdef NEARFIELD_ODE
static void odePose(const McdShape *s, dVector3 place, dMatrix3 turn, dVector3 side) {
    memset(turn, 0, sizeof(dMatrix3));
    for (int i = 0; i < 3; i++) {
        place[i] = (dReal)s->place[i];
        side[i] = (dReal)(2 * s->size[i]);
        for (int k = 0; k < 3; k++)
            turn[4 * i + k] = (dReal)s->axis[k][i];
    }
}

static double timeOde(int rounds) {
    double best = INFINITY;
    for (int i = 0; i < rounds; i++) {
        const double begin = now();
        for (int k = 0; k < PAIRS; k++) {
            dVector3 p1, p2, side1, side2, normal;
            dMatrix3 R1, R2;
            dContactGeom contact[4];
            dReal depth;
            int code;
            odePose(&a[k], p1, R1, side1);
            odePose(&b[k], p2, R2, side2);
            dBoxBox(p1, R1, side1, p2, R2, side2, normal, &depth, &code, 4, contact, sizeof *contact);
        }
        best = fmin(best, (now() - begin) / PAIRS);
    }
    return best;
}
#endif

static PeerShape peer(const McdShape *s) {
    PeerShape p = {.isCylinder = s->kind->type == kMcdGeometryTypeCylinder};
    mcd_copy(p.size, s->size);
    mcd_copy(p.place, s->place);
    memcpy(p.axis, s->axis, sizeof p.axis);
    return p;
}

static double timeFcl(int rounds, int *contacts) {
    double best = INFINITY;
    fcl_clear();
    for (int k = 0; k < PAIRS; k++) {
        const PeerShape x = peer(&a[k]), y = peer(&b[k]);
        fcl_add(&x, &y);
    }
    for (int i = 0; i < rounds; i++) {
        const double begin = now();
        *contacts = fcl_collideAll();
        best = fmin(best, (now() - begin) / PAIRS);
    }
    return best;
}

int main(int argc, char **argv) {
    const int rounds = argc > 2 && !strcmp(argv[1], "--rounds") ? atoi(argv[2]) : 20;
    printf("%-9s %-9s", "", "");
    for (int pose = 0; pose < POSES; pose++)
        printf(" %9s   ", poseName[pose]);
    printf("  ns, and contacts per pair\n");
    for (int i = 0; i < SHAPE_KINDS; i++)
        for (int j = i; j < SHAPE_KINDS; j++) {
            printf("%-9s %-9s", shape_name[i], shape_name[j]);
            for (int pose = 0; pose < POSES; pose++) {
                Random r = {.state = 1};
                int contacts = 0;
                for (int k = 0; k < PAIRS; k++)
                    makePair(&a[k], &b[k], i, j, pose, &r);
                const double t = timePairs(rounds, &contacts);
                printf(" %7.0f %4.1f", 1e9 * t, (double)contacts / PAIRS);
#ifdef NEARFIELD_ODE
                if (i == SHAPE_BOX && j == SHAPE_BOX)
                    printf(" (ODE %.0f)", 1e9 * timeOde(rounds));
#endif
                if (i == SHAPE_BOX && (j == SHAPE_BOX || j == SHAPE_CYLINDER)) {
                    const double fcl = timeFcl(rounds, &contacts);
                    printf(" (FCL %.0f %.1f)", 1e9 * fcl, (double)contacts / PAIRS);
                }
            }
            printf("\n");
        }
    return 0;
}
