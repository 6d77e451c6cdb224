/** @file MdtDefaults.h
 *  Initial values of worlds and bodies, for a length scale and a mass scale of 1.
 *
 *  Where the guides disagree, the Dynamics guide is followed: epsilon is 0.0001 (its chapter 5), not the User Guide's
 *  0.01. The acceleration thresholds are those of the User Guide's appendix A.
 */
#ifndef MDTDEFAULTS_H
#define MDTDEFAULTS_H

#define MDTWORLD_DEFAULT_GRAVITY_X 0
#define MDTWORLD_DEFAULT_GRAVITY_Y 0
#define MDTWORLD_DEFAULT_GRAVITY_Z 0
#define MDTWORLD_DEFAULT_EPSILON                                                                                       \
    0.0001 /**< 1/kg, for a mass scale of 1 kg; of worlds that programs make themselves (MstUniverseCreate) */
#define MDTWORLD_DEFAULT_GAMMA             0.2   /**< of an error per step */
#define MDTWORLD_DEFAULT_MIN_SAFETIME      0.001 /**< s */
#define MDTWORLD_DEFAULT_VEL_THRESH        0.02  /**< m²/s², for a length scale of 1 m */
#define MDTWORLD_DEFAULT_VELROT_THRESH     0.001 /**< rad²/s² */
#define MDTWORLD_DEFAULT_ACC_THRESH        0.5   /**< m²/s⁴, for a length scale of 1 m */
#define MDTWORLD_DEFAULT_ACCROT_THRESH     0.002 /**< rad²/s⁴ */
#define MDTWORLD_DEFAULT_ALIVE_TIME_THRESH 0.2   /**< s */
#define MDTWORLD_DEFAULT_WORK_BUDGET       400   /**< millions of multiplications per step of a partition */

#define MDTMAXMATRIXSIZE_MAX 2147483647 /**< rows of a partition: no cap by default */

#define MDTBODY_DEFAULT_MASS            1   /**< kg, times the mass scale */
#define MDTBODY_DEFAULT_INERTIA         0.4 /**< kg m², times the mass scale and the length scale squared */
#define MDTBODY_DEFAULT_LINEAR_DAMPING  0   /**< 1/s */
#define MDTBODY_DEFAULT_ANGULAR_DAMPING 0   /**< 1/s */
#define MDTBODY_DEFAULT_FAST_SPIN_X     0
#define MDTBODY_DEFAULT_FAST_SPIN_Y     1
#define MDTBODY_DEFAULT_FAST_SPIN_Z     0

#endif
