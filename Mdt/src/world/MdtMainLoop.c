/* Functions for a program's partition callback (MdtMainLoop.h). */
#include "world/mdt_workers_i.h"

static MeBool hasPartition(const MdtPartitionOutput *po, int i, const char *caller) {
    if (!mdt_isPointer(caller, "the partition output", po))
        return MEFALSE;
    if (i >= 0 && i < po->numPartitions)
        return METRUE;
    MeWarning(1, "%s: there is no partition %d", caller, i);
    return MEFALSE;
}

void MEAPI MdtAutoDisableLastPartition(MdtPartitionOutput *po, void *cbdata) {
    (void)cbdata;
    if (!hasPartition(po, po ? po->numPartitions - 1 : 0, __func__))
        return;
    const MdtIsland p = mdt_islandOf(po->world, po->numPartitions - 1, po->world->lastStep);
    po->info[p.number].isDisabled = mdt_islandIsToSleep(&p);
}

MeReal MEAPI MdtPartitionGetSafeTime(MdtPartitionOutput *po, int i) {
    if (!hasPartition(po, i, __func__))
        return 0;
    return (MeReal)mdt_minSafeTime(po->bodies + po->info[i].firstBody, po->info[i].numBodies, (double)MEINFINITY);
}

unsigned int MEAPI MdtUnpackForces(const MdtKeaForcePair *force, const unsigned int partitionindex,
                                   MdtPartitionOutput *po) {
    if (!mdt_isPointer(__func__, "the forces", force) || !hasPartition(po, (int)partitionindex, __func__))
        return 0;
    const MdtPartitionInfo *info = &po->info[partitionindex];
    for (int i = 0; i < info->numConstraints; i++)
        mdt_constraintSetForce(po->constraints[info->firstConstraint + i], &force[i]);
    return (unsigned int)info->numConstraints;
}
