/** @file McdAggregate.h
 *  Geometries put together (User Guide ch. 4, "Creating a Model with an Aggregate Geometry" and "Aggregate").
 *
 *  An aggregate has elements: geometries, each with a transform relative to the aggregate. Elements may be aggregates
 *  themselves, and everything may be shared; an aggregate cannot be, through any number of others, its own element.
 *  A model of an aggregate has one child instance for each element, all the way down, from the pool of McdInit's
 *  instanceCount. Elements that are added later count for models that are made later.
 *
 *  Contacts name the child instances (McdContact.instance1, instance2); each may have its own material.
 */
#ifndef MCDAGGREGATE_H
#define MCDAGGREGATE_H

#include "McdGeometryTypes.h"

ME_BEGIN_C

/** Registers the geometry type, on which McdAggregateCreate depends. */
MEPUBLIC void MEAPI McdAggregateRegisterType(McdFramework *frame);
/**
 * Creates an aggregate without elements.
 * @param maxChildren how many elements it may get: 1 or more.
 * @return null, with a warning, if that is out of range or the type is not registered.
 */
MEPUBLIC McdAggregateID MEAPI McdAggregateCreate(McdFramework *frame, int maxChildren);
/**
 * Adds an element; it counts as a reference to @a geom.
 * @param relTM where the element is, in the aggregate's frame: copied. Null: where the aggregate is.
 * @return the element's number. -1, with a warning, where there is no place left, for what is no geometry of the same
 *         framework, and for an aggregate that has this one as a part.
 */
MEPUBLIC int MEAPI McdAggregateAddElement(McdAggregateID a, McdGeometryID geom, MeMatrix4 relTM);
/** Removes element @a i; those after it move down by one number. Refused, with a warning, while a model or another
 *  aggregate uses this one. */
MEPUBLIC void MEAPI McdAggregateRemoveElement(McdAggregateID a, int i);
/** How many elements it has. */
MEPUBLIC int MEAPI McdAggregateGetElementCount(McdAggregateID a);
/** How many it may have. */
MEPUBLIC int MEAPI McdAggregateGetElementCountMax(McdAggregateID a);
/** An element's geometry; null, with a warning, where there is none. */
MEPUBLIC McdGeometryID MEAPI McdAggregateGetElementGeometry(McdAggregateID a, int i);
/** Where an element is, in the aggregate's frame: a pointer to the aggregate's copy, good until an element is removed.
 *  What is written there counts when models are next updated. Null, with a warning, where there is no such element. */
MEPUBLIC MeMatrix4Ptr MEAPI McdAggregateGetElementTransformPtr(McdAggregateID a, int i);

/** @name The type's functions
 *  @{ */
MEPUBLIC MeI16 MEAPI McdAggregateGetTypeId(void);
MEPUBLIC char *MEAPI McdAggregateGetTypeName(McdGeometryID g);
/** Gives the references to its elements back. */
MEPUBLIC void MEAPI McdAggregateDestroy(McdGeometryID g);
/** Renews the boxes of all children, and makes a box around them; a point for an aggregate without elements. */
MEPUBLIC void MEAPI McdAggregateUpdateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight);
/** The smaller one of a ball around the elements' balls and one around the box. */
MEPUBLIC void MEAPI McdAggregateGetBSphere(const McdGeometryID g, MeVector3 center, MeReal *radius);
MEPUBLIC void MEAPI McdAggregateMaximumPoint(McdGeometryInstanceID ins, MeReal *const inDir, MeReal *const outPoint);
/** The sum of the elements; where they overlap, the overlap counts twice. Elements without a volume count for nothing;
 *  0 if all are. */
MEPUBLIC MeI16 MEAPI McdAggregateGetMassProperties(McdGeometryID g, MeMatrix4 relTM, MeMatrix3 m, MeReal *volume);
MEPUBLIC void MEAPI McdAggregateDebugDraw(const McdGeometryID g, const MeMatrix4 tm, const MeReal colour[3]);
/** @} */

/** @name Interactions
 *  @{ */
/**
 * Has aggregates interact with all geometry types, the program's too, and with each other: wherever parts come near
 * each other, their types' own interactions are asked, with a pair of models that stand for the parts. Cells of the
 * table that are set already stay. More contacts than fit are reduced as McdContactSimplify does. Returns 1.
 */
MEPUBLIC MeBool MEAPI McdAggregateGenericRegisterInteractions(McdFrameworkID frame);
/** The same, and line segments. */
MEPUBLIC void MEAPI McdAggregateRegisterInteractions(McdFrameworkID frame);
/** Has line segments meet aggregates: the first hit over all parts. */
MEPUBLIC void MEAPI McdAggregateLineSegmentRegisterInteraction(McdFramework *frame);
/** @} */

ME_END_C

#endif
