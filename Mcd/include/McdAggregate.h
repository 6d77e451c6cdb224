/** @file McdAggregate.h
 *  Aggregates: compound geometries.
 *
 *  An aggregate has elements: geometries, each with a transform relative to the aggregate. Elements may be
 *  aggregates themselves, and geometries may be shared between aggregates and models; an aggregate cannot contain
 *  itself, directly or indirectly. A model of an aggregate has one child instance for each element at each level,
 *  from the pool of McdInit's instanceCount. Models that exist already do not get elements that are added later.
 *
 *  Contacts refer to the child instances (McdContact.instance1, instance2); each may have its own material.
 */
#ifndef MCDAGGREGATE_H
#define MCDAGGREGATE_H

#include "McdGeometryTypes.h"

ME_BEGIN_C

/** Registers the geometry type; required before McdAggregateCreate. */
MEPUBLIC void MEAPI McdAggregateRegisterType(McdFramework *frame);
/**
 * Creates an aggregate without elements.
 * @param maxChildren the maximum number of elements: 1 or more.
 * @return null, with a warning, if that is out of range or the type is not registered.
 */
MEPUBLIC McdAggregateID MEAPI McdAggregateCreate(McdFramework *frame, int maxChildren);
/**
 * Adds an element, which counts as a reference to @a geom.
 * @param relTM the element's transform in the aggregate's frame: copied. Null: identity.
 * @return the element's index. -1, with a warning, if there is no room, if @a geom is not a geometry of the same
 *         framework, and if it is an aggregate that contains this one.
 */
MEPUBLIC int MEAPI McdAggregateAddElement(McdAggregateID a, McdGeometryID geom, MeMatrix4 relTM);
/** Removes element @a i; the indices of later elements decrease by one. Refused, with a warning, while a model or
 *  another aggregate uses this one. */
MEPUBLIC void MEAPI McdAggregateRemoveElement(McdAggregateID a, int i);
/** The number of elements. */
MEPUBLIC int MEAPI McdAggregateGetElementCount(McdAggregateID a);
/** The maximum number of elements. */
MEPUBLIC int MEAPI McdAggregateGetElementCountMax(McdAggregateID a);
/** The geometry of an element; null, with a warning, if there is no such element. */
MEPUBLIC McdGeometryID MEAPI McdAggregateGetElementGeometry(McdAggregateID a, int i);
/** The transform of an element in the aggregate's frame: a pointer to the aggregate's copy, valid until an element
 *  is removed. Changes of it take effect when models are next updated. Null, with a warning, if there is no such
 *  element. */
MEPUBLIC MeMatrix4Ptr MEAPI McdAggregateGetElementTransformPtr(McdAggregateID a, int i);

/** @name The type's functions, as every type has them: see McdGeometryDeclare.h
 *  @{ */
/** kMcdGeometryTypeAggregate. */
MEPUBLIC MeI16 MEAPI McdAggregateGetTypeId(void);
/** "Aggregate"; the argument is ignored. */
MEPUBLIC char *MEAPI McdAggregateGetTypeName(McdGeometryID g);
/** Also releases the references to its elements. */
MEPUBLIC void MEAPI McdAggregateDestroy(McdGeometryID g);
/** Updates the boxes of all children, and sets a box around them; a point for an aggregate without elements. */
MEPUBLIC void MEAPI McdAggregateUpdateAABB(McdGeometryInstanceID ins, const MeMatrix4Ptr finalTM, MeBool tight);
/** The smaller one of a sphere around the elements' spheres and a sphere around the box. */
MEPUBLIC void MEAPI McdAggregateGetBSphere(const McdGeometryID g, MeVector3 center, MeReal *radius);
/** World frame: the farthest of its children's points in a direction; its own place if it has none. */
MEPUBLIC void MEAPI McdAggregateMaximumPoint(McdGeometryInstanceID ins, MeReal *const inDir, MeReal *const outPoint);
/** The sum over the elements; overlaps count twice. Elements without a volume are ignored; 0 if no element has one. */
MEPUBLIC MeI16 MEAPI McdAggregateGetMassProperties(McdGeometryID g, MeMatrix4 relTM, MeMatrix3 m, MeReal *volume);
/** Draws all its elements. */
MEPUBLIC void MEAPI McdAggregateDebugDraw(const McdGeometryID g, const MeMatrix4 tm, const MeReal colour[3]);
/** @} */

/** @name Interactions
 *  @{ */
/**
 * Registers interactions of aggregates with all geometry types registered so far, including the program's, and with
 * each other: where children come near each other, the interaction of their types is called, with a pair of models that
 * stand for the children. Interactions that are set already stay. If there is not room for all contacts, they are
 * reduced as by McdContactSimplify. Returns 1.
 */
MEPUBLIC MeBool MEAPI McdAggregateGenericRegisterInteractions(McdFrameworkID frame);
/** McdAggregateGenericRegisterInteractions and McdAggregateLineSegmentRegisterInteraction. */
MEPUBLIC void MEAPI McdAggregateRegisterInteractions(McdFrameworkID frame);
/** Registers the intersection of line segments with aggregates: the first hit over all children. */
MEPUBLIC void MEAPI McdAggregateLineSegmentRegisterInteraction(McdFramework *frame);
/** @} */

ME_END_C

#endif
