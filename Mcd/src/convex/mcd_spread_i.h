/* Inside Mcd: contact reduction: which of many contacts to keep. */
#ifndef MCD_SPREAD_H
#define MCD_SPREAD_H

/* A contact's properties that the choice depends on. */
typedef struct McdSpot {
    double at[6]; /* position, normal; mcd_spread scales the normal */
    double separation;
    double support; /* used by mcd_spread: the separation that the chosen spots leave to this one */
} McdSpot;

/* Chooses at most `maxCount` spots that support the others (mcd_spread.c), and writes their indices in ascending order;
 * returns their number. Spots within `same` (m) of a chosen one are left out, unless they are deeper. */
int mcd_spread(McdSpot *spot, int count, int maxCount, double same, int *kept);
/* Adds to the chosen spots, in the order of need, those that may overlap by more than `slack` (m) when the bodies tilt
 * by `tilt` (rad) while the chosen ones do not. kept: the indices of keptCount chosen ones, 1 or more, then of those
 * added. Returns their number, at most maxCount. */
int mcd_spreadForTilt(McdSpot *spot, int count, int maxCount, double tilt, double slack, int keptCount, int *kept);
void mcd_sortAscending(int *kept, int count);

#endif
