/** @file MdtMainLoop.h
 *  What happens inside MdtWorldStep, for programs that want a say in it (User Guide ch. 2, "MdtWorldStep").
 *
 *  With MdtWorldSetPartitionCB a program is shown every partition before it is simulated and decides whether it is put
 *  to rest, in place of the world; MdtAutoDisableLastPartition is what the world would do.
 */
#ifndef MDTMAINLOOP_H
#define MDTMAINLOOP_H

#include "MdtPartition.h"

ME_BEGIN_C

/** Marks the last partition of @a po to be put to rest if the world's thresholds say so (MdtWorldSetAutoDisable); an
 *  MdtPartitionEndCB. @a cbdata is not used. */
MEPUBLIC void MEAPI MdtAutoDisableLastPartition(MdtPartitionOutput *po, void *cbdata);
/** The shortest safe time of the bodies of partition @a i, s; MEINFINITY where none was set. A partition that is not
 *  there gets a warning, and 0. */
MEPUBLIC MeReal MEAPI MdtPartitionGetSafeTime(MdtPartitionOutput *po, int i);
/** Writes forces that a program has found by itself to the constraints of a partition, one pair for each in its order,
 *  as what MdtConstraintGetForce and GetTorque return. Returns how many; 0, with a warning, for bad input. */
MEPUBLIC unsigned int MEAPI MdtUnpackForces(const MdtKeaForcePair *force, const unsigned int partitionindex,
                                            MdtPartitionOutput *po);

ME_END_C

#endif
