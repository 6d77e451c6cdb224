/** @file MdtPartition.h
 *  Partitions: sets of bodies that constraints connect (Dynamics guide ch. 1, "Partitioning the World").
 *
 *  The world does not connect bodies: two boxes on the ground are two partitions, a stack is one. MdtBodyGetPartition
 *  returns a body's partition; MdtWorldSetPartitionCB passes them to the program during a step.
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
    MeBool isDisabled;                   /**< to be put to sleep instead of being simulated; the callback may set it */
} MdtPartitionInfo;

/** The partitions of this step that have been processed so far. The world owns the arrays, which are read-only. */
struct MdtPartitionOutput {
    MdtWorldID world;
    int numPartitions;
    MdtPartitionInfo *info;       /**< numPartitions */
    MdtBodyID *bodies;            /**< in the order of simulation, partition by partition */
    MdtConstraintID *constraints; /**< in the order of simulation, partition by partition */
};

/** Calls @a cb, with @a data, for every partition before it is simulated; the partition is the last one of the output.
 *  The callback then decides, in place of the world, which partitions fall asleep. Objects that it creates, enables or
 *  destroys are processed after the step (docs/simulation.md, "Callbacks"). Null, the default: the world decides. */
MEPUBLIC void MEAPI MdtWorldSetPartitionCB(const MdtWorldID w, MdtPartitionEndCB cb, void *data);

/**
 * Finds the partitions of the bodies in a dictionary, whose nodes carry them (MeDictNodeGet; the keys are free for the
 * program), as a step of their world would: bodies that are connected to an enabled body are enabled. Writes them to
 * @a po, whose members are set to the world's own arrays, valid until its next step; then calls @a pcb, unless it is
 * null, for each partition, which is the last one of the output at that time. For inspection only: MdtWorldStep finds
 * the partitions again. Sets of disabled bodies are no partitions. A node that carries no body of the first one's
 * world gets a warning and is left out; without a body there are 0 partitions.
 */
MEPUBLIC void MEAPI MdtUpdatePartitions(MeDict *enabledBodyList, MdtPartitionOutput *po, const MdtPartitionEndCB pcb,
                                        void *pcbdata);

ME_END_C

#endif
