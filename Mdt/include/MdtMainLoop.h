/** @file MdtMainLoop.h
 *  Callbacks by which a program hooks into MdtWorldStep.
 *
 *  With MdtWorldSetPartitionCB a program gets every partition before it is simulated, and decides, in place of the
 *  world, whether it is put to sleep; MdtAutoDisableLastPartition is the world's own decision.
 */
#ifndef MDTMAINLOOP_H
#define MDTMAINLOOP_H

#include "MdtPartition.h"

ME_BEGIN_C

/** An MdtPartitionEndCB: marks the last partition of @a po to be put to sleep if the world's thresholds say so
 *  (MdtWorldSetAutoDisable). @a cbdata is not used. */
MEPUBLIC void MEAPI MdtAutoDisableLastPartition(MdtPartitionOutput *po, void *cbdata);
/** s: the shortest safe time of the bodies of partition @a i; MEINFINITY if none was set. An invalid partition gets a
 *  warning, and 0. */
MEPUBLIC MeReal MEAPI MdtPartitionGetSafeTime(MdtPartitionOutput *po, int i);
/** Sets the forces that MdtConstraintGetForce and GetTorque return to forces that the program has computed, one pair
 *  for each constraint of a partition in its order. Returns their number; 0, with a warning, for bad input. */
MEPUBLIC unsigned int MEAPI MdtUnpackForces(const MdtKeaForcePair *force, const unsigned int partitionindex,
                                            MdtPartitionOutput *po);

ME_END_C

#endif
