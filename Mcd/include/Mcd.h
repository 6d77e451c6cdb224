/** @file Mcd.h
 *  All headers of the collision library (User Guide ch. 4, "Collision").
 */
#ifndef MCD_H
#define MCD_H

#include "McdAggregate.h"
#include "McdAll.h"
#include "McdBatch.h"
#include "McdBox.h"
#include "McdCTypes.h"
#include "McdCompositeModel.h"
#include "McdCone.h"
#include "McdContact.h"
#include "McdConvexInteractions.h"
#include "McdConvexMesh.h"
#include "McdCullingTable.h"
#include "McdCylinder.h"
#include "McdFrame.h"
#include "McdGeometry.h"
#include "McdGeometryInstance.h"
#include "McdGeometryTypes.h"
#include "McdInteractionTable.h"
#include "McdInteractions.h"
#include "McdModel.h"
#include "McdModelPair.h"
#include "McdModelPairContainer.h"
#include "McdModelPairManager.h"
#include "McdNull.h"
#include "McdPlane.h"
#include "McdPlaneIntersect.h"
#include "McdPrimitives.h"
#include "McdProfile.h"
#include "McdQuery.h"
#include "McdRGHeightField.h"
#include "McdSpace.h"
#include "McdSphere.h"
#include "McdSphyl.h"
#include "McdTriangleList.h"
#include "McduDebugDraw.h"
#include "McduRequestTable.h"
#include "MeMemory.h"

#endif
