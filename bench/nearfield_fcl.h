/* Pairs of boxes and cylinders, collided by FCL. */
#ifndef NEARFIELD_FCL_H
#define NEARFIELD_FCL_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct PeerShape {
    int isCylinder;
    double size[3]; /* half sizes */
    double axis[3][3], place[3];
} PeerShape;

void fcl_clear(void);
void fcl_add(const PeerShape *a, const PeerShape *b);
int fcl_collideAll(void); /* the number of contacts */

#ifdef __cplusplus
}
#endif

#endif
