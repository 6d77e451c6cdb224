/** @file McdCompositeModel.h
 *  For programs written for earlier versions: a composite model is a model of an aggregate, see McdAggregate.h and
 *  McdModel.h. The type McdCompositeModelID is that of a model.
 */
#ifndef MCDCOMPOSITEMODEL_H
#define MCDCOMPOSITEMODEL_H

#include "McdAggregate.h"
#include "McdModel.h"

#endif
