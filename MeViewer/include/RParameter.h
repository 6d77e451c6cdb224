/** @file RParameter.h
 *  Numbers of a program that its user may change, each by keys and by a slider. An addition to the 1.2 interface.
 *
 *      static MeReal slope = 24, grip = (MeReal)0.5;
 *      static const RParameter parameters[] = {
 *          {"slope", "degrees", &slope, 5, 45, 1, .less = "Down", .more = "Up", .changed = tilt},
 *          {"friction", 0, &grip, 0, 1, (MeReal)0.05, .changed = setGrip},
 *      };
 *      RRenderCreateParameters(rc, parameters, 2);
 *
 *  This one table makes the keys, their lines of the help (F1), and the sliders of the panel "Parameters" (F9). Its
 *  keys win over those of RRenderSetUpCallBack and its like; actions win over them.
 */
#ifndef RPARAMETER_H
#define RPARAMETER_H

#include "MeViewerTypes.h"

ME_BEGIN_C

/** One number. Members that are not given are 0 or null. */
typedef struct RParameter {
    const char *name; /**< As help and slider show it; those of a context must differ. */
    const char *unit; /**< Null for none. */
    MeReal *value; /**< The program's own number: it is read in every picture, and written when the user changes it. */
    MeReal low, high; /**< The user stays within these; the program may write what it likes. */
    MeReal step;     /**< What a press of a key adds or takes, above 0. A slider stops at whole steps from @a low on. */
    MeBool isFactor; /**< Keys multiply and divide by @a step, which is above 1; so is @a low above 0. */
    const char *less, *more; /**< Keys, named as in the option -key: "Down", "Left", "a"; null for none. */
    /** Called after the user has changed the number: between ticks, not in one. Null for none. */
    RButtonPressCallBack changed;
    void *userdata; /**< For @a changed. */
} RParameter;

/** @name Parameters
 *  @{ */
/**
 * Adds @a count parameters to those of the context. Table and texts are copied, the numbers are not: they must live as
 * long as the context. A parameter that is mistaken (no name, no value, a range or step that is none, a key that there
 * is not or that another parameter has) gets a warning and is left out.
 */
MEPUBLIC void MEAPI RRenderCreateParameters(RRender *rc, const RParameter parameters[], int count);
/** @} */

ME_END_C

#endif
