/** @file RParameter.h
 *  Numbers of a program that the user may change by keys and sliders. An addition to the 1.2 interface.
 *
 *      static MeReal slope = 24, grip = (MeReal)0.5;
 *      static const RParameter parameters[] = {
 *          {"slope", "degrees", &slope, 5, 45, 1, .less = "Down", .more = "Up", .changed = tilt},
 *          {"friction", 0, &grip, 0, 1, (MeReal)0.05, .changed = setGrip},
 *      };
 *      RRenderCreateParameters(rc, parameters, 2);
 *
 *  This table defines the keys, their lines in the help (F1), and the sliders of the panel "Parameters" (F9). Its keys
 *  override those of RRenderSetUpCallBack and the like; actions override its keys.
 */
#ifndef RPARAMETER_H
#define RPARAMETER_H

#include "MeViewerTypes.h"

ME_BEGIN_C

/** A parameter. Members that are not given are 0 or null. */
typedef struct RParameter {
    const char *name; /**< Text in help and slider; must be unique in a context. */
    const char *unit; /**< Null for none. */
    MeReal *value;    /**< The program's variable: read in every picture, and written when the user changes it. */
    MeReal low, high; /**< Range of values that the user may set; the program may set others. */
    MeReal step;      /**< Increment of a key press, above 0. Sliders are restricted to multiples of it, counted from @a
                          low. */
    MeBool isFactor;  /**< Keys multiply and divide by @a step, which must be above 1; then @a low must be above 0. */
    const char *less, *more; /**< Names of the keys, as in the option -key: "Down", "Left", "a"; null for none. */
    /** Called after the user has changed the number, between ticks. Null for none. */
    RButtonPressCallBack changed;
    void *userdata; /**< For @a changed. */
} RParameter;

/** @name Parameters
 *  @{ */
/**
 * Adds @a count parameters to those of the context. Table and texts are copied; the variables are not, and must exist
 * as long as the context. An invalid parameter (no name, no variable, a bad range or step, an unknown key or one that
 * another parameter uses) gets a warning and is skipped.
 */
MEPUBLIC void MEAPI RRenderCreateParameters(RRender *rc, const RParameter parameters[], int count);
/** @} */

ME_END_C

#endif
