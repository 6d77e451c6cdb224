/** @file McdCompositeModel.h
 *  Models of several parts are models of an aggregate, see McdAggregate.h and McdModel.h. Programs of
 *  earlier versions name this header; the type McdCompositeModelID is a model's.
 */
#ifndef MCDCOMPOSITEMODEL_H
#define MCDCOMPOSITEMODEL_H

#include "McdAggregate.h"
#include "McdModel.h"

#endif
