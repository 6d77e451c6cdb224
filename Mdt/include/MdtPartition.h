/** @file MdtPartition.h
 *  Partitions: sets of bodies that constraints tie together (Dynamics guide ch. 1, "Partitioning the World").
 *
 *  The world joins nothing: two boxes on the ground are two partitions, a stack is one. MdtBodyGetPartition tells a
 *  body's; MdtWorldSetPartitionCB shows them while the world is stepped.
 */
#ifndef MDTPARTITION_H
#define MDTPARTITION_H

#include "MdtTypes.h"
#include "MeDict.h"

ME_BEGIN_C

/** One partition: where its bodies and constraints are in the output's arrays. */
typedef struct MdtPartitionInfo {
    int firstBody, numBodies;
    int firstConstraint, numConstraints; /**< a contact group is followed by its contacts */
    MeBool isDisabled;                   /**< to be put to rest instead of being simulated; the callback may set it */
} MdtPartitionInfo;

/** The partitions of this step, as far as they have been found. The arrays are the world's and are not to be written.
 *  */
struct MdtPartitionOutput {
    MdtWorldID world;
    int numPartitions;
    MdtPartitionInfo *info;       /**< numPartitions */
    MdtBodyID *bodies;            /**< in the order of simulation, partition by partition */
    MdtConstraintID *constraints; /**< the same */
};

/** Calls @a cb for every partition before it is simulated, with @a data; the partition is the last of the output. It
 *  then decides about rest in place of the world. What it creates, enables or destroys waits until the step is done
 *  (docs/simulation.md, "Callbacks"). Null: the world decides (default). */
MEPUBLIC void MEAPI MdtWorldSetPartitionCB(const MdtWorldID w, MdtPartitionEndCB cb, void *data);

/**
 * Finds the partitions of the bodies in a dictionary, whose nodes carry them (MeDictNodeGet; the keys are the
 * program's), as a step of their world would: what is tied to an enabled body is enabled. They are written to @a po,
 * whose members are set to the world's own arrays, valid until its next step; then @a pcb, unless it is null, is called
 * for each partition, which is the last of the output then. Only to look at: MdtWorldStep finds them anew. Disabled
 * bodies alone are in no partition. A node that carries no body of the first one's world gets a warning and is left
 * out; without a body there are 0 partitions.
 */
MEPUBLIC void MEAPI MdtUpdatePartitions(MeDict *enabledBodyList, MdtPartitionOutput *po, const MdtPartitionEndCB pcb,
                                        void *pcbdata);

ME_END_C

#endif
