/* Inside Kea: all tuned constants. Numbers that follow from arithmetic or geometry stay in their formulas.
 *
 * Each comment gives the unit, or what the constant is relative to, and the reason for the value: a derivation, a
 * measurement, or a behaviour that is lost if the value is halved (/2) or doubled (x2), with its test. Constants that
 * affect cost only are measured by programs of bench/.
 *
 * Units: `A_ii' is a row's J B⁻¹ Jᵀ, 1/kg, the inverse of its effective mass; `load speed' is the largest change of a
 * body's velocity by its loads in the step, m/s (kea_loadSpeed): g h under gravity.
 */
#ifndef KEA_POLICY_I_H
#define KEA_POLICY_I_H

#include "MePrecision.h"

/* ---- convergence (kea_isConverged, kea_residual.c) ----
 *
 * A pass has converged if the residuals of positions, velocities and momenta are below their tolerances. These are as
 * tight as double arithmetic allows at mass ratios of 1e6 (rounding 1e-16 times the ratio), since errors accumulate: a
 * joint error φ that passes leave does the work λ φ in every step, and the residual of a contact is a creep
 * velocity. */

/* Position tolerance, relative to the scale of a row's error (lengthScaleOf, kea_residual.c). With 1e-5 the solver
 * diverges for 1000 kg on links of 1 kg, with 1e-6 it does not; lower values reduce the error of energy, λ φ a step. x2
 * fails Mdt_Order: the_sag_of_a_load_is_epsilon_force_over_gamma. */
static const double kea_positionTolerance = 1e-10;
/* Velocity tolerance, relative to the speed scale of the partition; of the velocity stage, to its initial residual.
 * Under gravity at 60 Hz a contact may creep by 2e-10 m/s; scenes allow 1e-9 m in 2 s. x2 fails MdtKea_system:
 * velocity_rows_obey_their_law. */
static const double kea_velocityTolerance = 1e-9;
/* Momentum tolerance of Newton's method, relative to a body's momentum scale. A tenth of kea_velocityTolerance, so that
 * the residual of the inner problem does not matter in the outer one. x2 fails MdtKea_problem:
 * large_problems_are_complementary. */
static const double kea_newtonTolerance = 1e-10;
/* Momentum tolerance of a converged pass, in units of kea_newtonTolerance: 1e-8. Momentum is restored exactly
 * afterwards (kea_balanceMomentum): lower values cost passes, higher ones leave more to that correction. */
static const double kea_momentumSlack = 1e2;

/* Loose tolerances, in units of the tolerances of positions (and momenta) and of velocities: 1e-6 of a row's size and
 * 1e-4 of the speed. An answer for which no passes are left counts as exact if it is within them, and else is reported
 * as capped. x2 and /2 fail MdtKea_problem: answers_are_exact_enough_to_a_millionth. */
static const double kea_loosePosition = 1e4, kea_looseVelocity = 1e5;
/* Fraction of the loose tolerances at which passes by sweeps end, and those that gain nothing: a digit less, so that
 * rounding does not decide whether a swept answer is reported as capped. */
static const double kea_sweptMargin = 0.1;
/* The same of solves without joints that the world's accounts pay (MdtKeaParameters.mayDecline): 1e-3 of the speed.
 * After KEA_ORDINARY_FACTORIZATIONS they end at the first pass that does not halve the residual: further ones mostly
 * fail, and the account would soon be empty. Of 108 drums, balls and slabs of 1 to 100 t on 16 to 37 light cubes,
 * planks and cylinders 11 sink, without 20 (Mst_Choice: a_drum_lands_on_layers_of_cubes_of_a_kilogram). */
static const double kea_paidMargin = 10;

/* Fraction of a body's own velocity in the speed scale of residuals, beside the load speed: a fast body's residuals
 * have the rounding of its speed. Higher values are lax for fast bodies, lower ones spend passes on rounding. */
static const double kea_ownSpeedShare = 0.1;
/* Fraction of a body's radius of gyration in the scale of position errors, for rows without lever arm and motion. x2
 * fails Mdt_Order: the_sag_of_a_load_is_epsilon_force_over_gamma. */
static const double kea_bodySizeShare = 1e-2;
/* Fraction of a body's distance from the origin in the scale of position errors, and of its momentum in the scale of
 * its impulses: with the tolerances of both it is 1e-14, 50 times the rounding of a double. Without it the tolerance of
 * a body without loads would be 0. */
static const double kea_roundingShare = 1e-4;
/* Possible error of attachments that a program gives in single precision, relative to lever arms and distances from the
 * origin, or in rad: eight roundings. A linkage may be too long by this to pass its change point, and joints that
 * contradict each other by less count as consistent. */
static const double kea_attachmentRounding = 5e-7;
/* Rad, h |w| of a body: a partition without loops in which a body turns further is not solved by the tangent problem.
 * With 0 rag dolls take a sixth more factorizations. x2 fails Mst_SweptJoints: swept_pairs_on_hinges_do_not_explode. */
static const double kea_tangentTurn = 0.3;

/* ---- passes of a step ---- */

enum {
    /* Passes, also of an impact, that set friction bounds to μ p_n; later ones move them half of the way, with
     * acceleration. The velocity stage has no more passes than these. Bounds that settle at all have mostly settled
     * after 3 to 6. */
    KEA_FULL_BOUND_PASSES = 6,
    /* Passes after which friction bounds are frozen: the first if the answer is within kea_looseVelocity, the second in
     * any case. Collapsing heaps settle within 60 in all but 3 % of their steps (tests/Mst/test_Heaps). */
    KEA_FREEZE_PASS = 12,
    KEA_MAX_COUPLED_PASSES = 60,
    /* Passes with frozen bounds. The problem is convex then, and each pass reduces the residual by a factor of 3 to 70,
     * so that 4 gain two to seven digits. */
    KEA_FROZEN_PASSES = 4,
    /* Maximal number of passes in which contacts follow bodies. Each multiplies the error of their places by the
     * angle in rad by which bodies turn relative to each other in a step; 8 leave 1e-3 at .4 rad. With 6, discs fall
     * that roll by .3 rad and more a step (Mst_Order_Edges), with 12 and 16 as many as with 8. */
    KEA_CONTACT_PASSES = 8,
    /* Passes of the tangent problem, which converges quadratically: 2 to 4 where it is regular, 6 near a change point.
     * At a change point, and with redundant joints, more do not converge either. x2 and /2 fail scenes_linkage:
     * momentum_chooses_the_branch_at_a_change_point. */
    KEA_TANGENT_PASSES = 6,
    /* Passes of joints without loops and friction after which slow ones, which leave more than half of the residual,
     * give way to tangent ones: ordinary steps take 3 to 6. Whips of 8 links with narrow cones and 10 t at their end
     * take 34 factorizations a step with 2 and with 4, without tangent passes 54 (Mdt_ConeLimit). */
    KEA_ORDINARY_PASSES = 4,
    /* Passes of such joints that do not halve the residual, after which the step is divided. The whips take 34, 34, 36,
     * 37, 48 factorizations a step with 6, 8, 12, 16 and without. 8 fails Mdt_Degenerate:
     * a_cone_limit_that_had_no_plane_yet. Without joints: passes after which an answer within kea_sweptMargin is
     * accepted. Slabs that land on light cubes take 10 to 14 million multiplications instead of 27 to 46 (Mst_Choice);
     * with 2 tutorials take up to 42 % more instructions. */
    KEA_STUCK_PASSES = 12,
    /* Factorizations of a step that its account pays after which it is content with kea_paidMargin. Steps of towers and
     * of what rests take fewer; with 0 a tower of 100 layers of planks falls (Mst_Choice), with 48 a third more of
     * the loads of kea_paidMargin sink. */
    KEA_ORDINARY_FACTORIZATIONS = 12,
    /* Number of passes by sweeps among which the remaining work is divided: several, since each pass linearizes the
     * rows anew where the bodies have moved to (test_Mst_WorkBudget). */
    KEA_SWEPT_PASSES = 8,
    /* Above this number of passes the energy of the motion is limited: ordinary steps take 3 to 6; contradicting rows
     * may converge, in more passes, to a motion of a hundred times the energy. Twice the ordinary number. /2 fails
     * MdtKea_system: velocity_rows_obey_their_law. */
    KEA_UNUSUAL_PASSES = 12
};
/* Range of t, the coefficient of Anderson's acceleration (kea_friction.c): t -> 1 is a division by zero, and a linear
 * extrapolation is not trusted beyond five times its length. */
static const double kea_minSecant = -4, kea_maxSecant = 0.9;

/* Fraction of the work budget (MdtKeaParameters.maxWork) that passes may use, so that end velocities and the position
 * projection have the rest. x2 fails Mdt_RandomJoints: random_joints_end_their_steps_and_give_no_energy. */
static const double kea_workForMotion = 0.9;
/* Fraction of the work budget that may be spent while friction bounds do not settle. Bounds that settled had taken 17
 * million at most, a third of a budget of 50 million. */
static const double kea_workForFriction = 0.375;

/* Rad, h |w_m|: beyond it a body counts as turned over. The Cayley map turns by 2 atan(h w / 2), here by 1.8 rad; near
 * half a turn (infinite h w) the velocity does not determine the motion. At half of the limit the rotation by 1.1 rad
 * is followed well; at twice the limit it is 2.4 rad. x2 fails Mdt_Friction: a_ball_may_spin_as_fast_as_it_likes. */
static const double kea_maxTurn = 2.5;
/* Rad, h |w| times the relative difference of the moments: a step in which a body turns further is divided; in
 * partitions with contacts, five times as far. The midpoint rule would precess a top wrongly, and it makes the angle
 * too small, by the fraction (h w)²/12: 1e-3, and 2 % with contacts, where impacts lose more. .5 everywhere fails free
 * rotation and tops of tests/scenes; .2 in contact costs rag dolls 40 % more factorizations. */
static const double kea_farTurn = 0.1;
/* Lever arm of a contact's normal about a ball's centre, relative to the radius, up to which the ball's rotation does
 * not matter to the contact: its effect is 1e-3 x 2.5 rad of a radius at most. x2 fails Mdt_Report:
 * a_whirling_ball_is_divided_where_a_contact_pushes_past_its_centre. */
static const double kea_centredArm = 1e-3;
/* Factor on the load speed: after a larger change of velocity in the last step, such as by an impact, this change is
 * not the first guess of this step. The guess affects the answer within the tolerance only: without the constant
 * Mdt_CarWheel fails, the_steering_motor_moves_and_stops, in one figure by 3e-5. */
static const double kea_jerk = 30;

/* ---- theta and geometric stiffness ---- */

/* Gap, relative to a body's size, below which a contact may act at any speed, and one touches that has carried a load
 * and moves with a rolling body: the path of its point leaves the surface by O(h³) in a step, and that gap is not
 * flight, at whose end there would be an impact. A hundred times kea_touchingGap of single precision. With a larger
 * value near misses dissipate energy, with a smaller one contacts are activated a pass later; /10 fails
 * Mst_Order_Edges: a_disc_may_roll_by_half_a_rad_in_a_step. */
static const double kea_nearbyGap = 1e-3;
/* In steps: a contact that would close within this time at its present speed may act. One step would be enough if rows
 * did not change velocities; the additional half is for that, and for impacts with restitution, which are to be
 * resolved at their time. 1 in MdtKeaBounces fails Mst_Blows: a_step_may_end_at_the_blow. */
static const double kea_reach = 1.5;
/* h² k / m of a spring: above 4, where h ω > 2 (the stability limit of explicit schemes), the midpoint rule does not
 * follow the oscillation, and backward Euler is used. x2 and /2 fail MdtKea_system: springs_too_stiff_are_damped,
 * springs_follow_the_midpoint_rule. */
static const double kea_stiffSpring = 4;
/* Of a spring's stiffness: the least slope of its mean force that Newton's method counts. A spring that has just let go
 * has next to none, and its compliance would overflow. Each pass leaves up to 4 times this fraction of an error. */
static const double kea_minSpringSlope = 1e-3;
/* Fraction of the smallest moment: a smaller geometric stiffness is left out of the metric. Newton's method then leaves
 * 1 % of an error in a pass, as it does anyway. */
static const double kea_smallStiffness = 0.01;
/* Relative difference up to which moments count as equal: the rounding of a program's tensor in double arithmetic. */
static const double kea_equalMoments = 1e-9;

/* Of a row's mobility J M⁻¹ Jᵀ, the share that has to be along free axes: a row closer to the locked ones, within a
 * milliradian, is left out. Else the rounding of its direction would be its lever. */
static const double kea_minMobility = 1e-6;
/* Of the square of the trace of the mobility along two directions: its determinant, up to which locked axes leave them
 * one. Ten times the rounding of single precision. */
static const double kea_lockedDirection = 1e-6;

/* ---- the proximal parameter N, relative to A_ii: a compliance of the method, which the passes take out again ---- */

/* N of joints; and of limits, motors, other bounded rows, and joints that make loops. The latter contradict each other,
 * if only by rounding, and respond with impulses of the error over h N. Lower values cost iterations where rows become
 * active and inactive, higher ones cost passes where heavy bodies rest on light ones. */
static const double kea_proximalJoint = 1e-8, kea_proximalLimit = 1e-6;
/* N of stops that act, once a pass has left more than half of the residual. A pass leaves the fraction N / (N + m) of
 * an error, m the row's mobility while all others hold, relative to A_ii: 6e-8 where 10 t hang on 8 links of 1 kg that
 * are all pressed against their stops. There kea_proximalLimit leaves .94, and the step is divided into 64 parts
 * (Mdt_Whips). If all passes have it, light whips take a sixth more factorizations, as their stops open and close. */
static const double kea_proximalStop = 1e-9;
/* N of contacts, by the number of passes that have converged well; in an impact, by the number of passes: 1e-4, and a
 * tenth of the last in each. A start of 1e-3 saves 14 % of the factorizations of small partitions and fails the heavy
 * cube and the creep of tests/scenes; constant 1e-4 takes 22 to 35 factorizations a step in a heap at rest. The last is
 * kea_velocityTolerance: a pass then leaves no more than is tolerated. */
enum { KEA_PROXIMAL_LEVELS = 6 };
static const double kea_proximalContact[KEA_PROXIMAL_LEVELS] = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};
/* Regularization of the dual matrix, relative to A_ii, which is not taken out again. Two rows of a joint may be equal
 * but for rounding; this is 500 times the rounding of a double. */
static const double kea_dualRegularization = 1e-13;
/* Regularization for redundant joints, relative to the metric: the relative error of their smallest impulses, and the
 * rounding at a mass ratio of 1e4. */
static const double kea_redundancyRegularization = 1e-12;

/* ---- semismooth Newton ---- */

enum {
    /* Cap on the iterations of the convex problem. With an exact line search the iteration always converges, but in
     * collapsing heaps it takes more. */
    KEA_MAX_CONVEX = 60,
    /* Cap on the iterations of the coupled problem, which has no potential. The iteration converges quadratically near
     * the answer; elsewhere the passes have to approach it. */
    KEA_MAX_COUPLED = 12,
    /* Solves with kept factors: each leaves 1e-2 of the error or less if the factors still fit. Without such solves
     * bridges under a ton take 4 to 6 % more work (bench/choice, ton-bridge-0.5-1 and -1-1). */
    KEA_MAX_REFINEMENTS = 4,
    /* Trial lengths of a step of the coupled problem, each half of the last: an eighth at least. Reasoned: shorter
     * steps are left to the outer iteration. */
    KEA_MAX_HALVINGS = 4,
    /* Cap on the iterations of the line search. At least every second one halves the interval: 50 halvings leave 2^-50
     * of it, the precision of a double. */
    KEA_MAX_LINE_SEARCH = 100
};
/* Smallest pivot of a block's factor, relative to its diagonal entry: below 4 roundings of a double no digit is
 * left. */
static const double kea_minPivot = 1e-15;
/* Rounding error of a row's r - J d, a sum of 12 products, in roundings of a double. With 6 (and kea_minPivot of 4
 * roundings) Mst_SweptJoints fails, swept_pairs_on_hinges_do_not_explode, which depends on single bits. */
static const double kea_roundingSteps = 8;
/* Line search: the fraction of the slope that may be left, and the longest step that is tried. 1e-3 costs Newton's
 * method nothing; lower values take more visits of rows, higher ones more factorizations. Without a longest step
 * Mst_SweptJoints fails: swept_pairs_on_hinges_do_not_explode. */
static const double kea_lineSearchTolerance = 1e-3, kea_longestStep = 64;
/* The error of the convex problem, in tolerances, counts as rounding if it is below the first and a step has left more
 * than the second, a fraction, of it. */
static const double kea_convexRounding = 1e5, kea_convexProgress = 0.3;
/* The fraction of the error that a step of the coupled problem may leave; else the step is shortened. If this does not
 * help, and the error in tolerances is below the second constant, it counts as rounding. With 1 for the first constant
 * Mst_SweptJoints fails, swept_pairs_on_hinges_do_not_explode, and a wall takes 8 % more work (bench/choice). */
static const double kea_coupledProgress = 0.9, kea_coupledRounding = 1e3;
/* Simplified Newton's method: the fraction of the error that a solve with kept factors may leave; else Jacobians are
 * evaluated, and the matrix is factored, anew. The fast solver's rounds of joints alone are five, and gain five digits
 * if each gains one: from .3 of a body's size to kea_closedJoint. */
static const double kea_refinedShare = 0.1;
/* Residual in tolerances: a converged answer with a larger one is refined with the kept factors, which costs no
 * factorization and improves the next step's first guess. Without it a linkage in double precision opens by 1.3e-12 m
 * instead of less than 3e-13 (tests/scenes). */
static const double kea_refinedEnough = 1e-2;
/* Relative error of friction bounds against μ p_n up to which no coupled solve is needed. */
static const double kea_boundsAgree = 1e-12;

/* ---- work, counted in multiplications per row ---- */

enum {
    KEA_VISIT = 32,          /* J d of two bodies, bounds, Jᵀ p */
    KEA_ASSEMBLY = 108,      /* a row's part of the matrix: three blocks of 6 x 6 */
    KEA_LINEARIZATION = 256, /* a row's Jacobian, error and target; the same for a body */
    KEA_SWEEP = 96,          /* J d, the bound, B⁻¹ Jᵀ p */
    KEA_ITERATION_VISITS = 8 /* visits in an iteration: gradient, forces, and five of the line search */
};

/* ---- sweeps ---- */

enum {
    KEA_SWEEPS = 32,       /* maximum of a solve: accelerated, they do what 500 plain ones do in a pyramid */
    KEA_FEWEST_SWEEPS = 2, /* minimum of a solve: the first sweep has no momentum */
    KEA_START_SWEEPS = 2,  /* cost of choosing the start of sweeps, in sweeps: three visits of each row */
    KEA_SOME_SWEEPS = 8    /* minimum of a pass, a quarter of the maximum: else there are fewer passes */
};
/* Relative change of the impulses: a sweep that changes them by less has converged. It is a hundredth of where passes
 * by sweeps stop (kea_sweptMargin kea_looseVelocity kea_velocityTolerance, 1e-5). */
static const double kea_sweepTolerance = 1e-7;

/* ---- the velocity stage ---- */

/* Fraction of the load speed: with a smaller residual the motion is smooth, and the stage is left out. If made
 * in every step, the stage costs 1.7e-4 of a pendulum's energy in 47 s; with .05, 7e-7. */
static const double kea_calmResidual = 0.05;
/* Fraction of the largest residual: rows with a smaller one do not count in the test for the midpoint rule's mode
 * (-1)^n, so that no small row decides. x2 fails guide_chapter_5: a_closed_system_does_not_explode. */
static const double kea_rippleShare = 0.1;

/* ---- energy ---- */

/* Joint error, relative to a body's size, above which a joint counts as open. Converged passes leave 1e-9. Piles of
 * swept boxes on hinges gained energy with errors from 1.5e-4 on (test_Mst_SweptJoints): with 1e-3, two piles of 4000
 * gain more than 1e-3 of their energy. */
static const double kea_openJoint = 1e-5;
/* Relative rounding of sums of energies, which does not count as gained energy; in assertions relative to their largest
 * terms, which cancel to 1e-14 for a needle that spins about its own axis at 1e16 rad/s. */
static const double kea_energyRounding = 1e-12;
/* Relative tolerance of assertions of check builds, for energies, bounds and unit quaternions that were computed in
 * another order: a thousand times kea_energyRounding. No answer depends on it. */
static const double kea_assertedRounding = 1e-9;
/* N s: assertions do not compare impulses with a larger sum, such as fuzzed input leads to. */
static const double kea_maxAsserted = 1e20;
/* m/s, rad/s: a pass with a larger change has diverged. Up to it, the squares of the change and of the distances that
 * it leads to fit a double; no real motion comes near. */
static const double kea_largestChange = 1e100;

/* ---- contacts in time ---- */

enum {
    /* Cap on the rounds of an impact: a cradle of n balls takes n. */
    KEA_MAX_ROUNDS = 60,
    /* Passes of a round: 6 lower N from the first to the last of kea_proximalContact, the others are for friction
     * bounds. */
    KEA_MAX_IMPACT_PASSES = 14
};
enum {
    /* Reflections of an undivided step, by manifold with restitution (kea_reflect.c); contacts that meet after them are
     * stopped. A column of n balls takes (n + 1)/2. With 8 Mst_Packs fails: so_do_larger_packs. */
    KEA_REFLECTIONS = 64,
    /* Projected Gauss-Seidel passes that stop the points of a manifold together. The energy does not depend on them; a
     * face that lands flat rotates by what they leave. With 4 Mst_Packs fails: a_layer_bounces_by_the_law. */
    KEA_FACE_PASSES = 32,
    /* Visits of points after which passes over the manifolds of a set end: those of one that does not converge by then
     * are reflected one after the other. With 256 Mst_Packs fails: billiards_break_evenly. */
    KEA_SET_VISITS = 4096
};
/* Overlap of a contact at rest, relative to a body's size, up to which impacts wait for simultaneous ones. The corner
 * on which a block rocks sinks in by 3e-5. With 1e-3 towers of superellipsoids in double precision overlap ten times as
 * much, and take twice the calls of their support functions (Mst_ConvexType). */
static const double kea_waitingDepth = 1e-4;
/* Torque of a contact's two impulses that do not act along one line, relative to a body's impulse times its size: with
 * more, a timed solve with joints is not taken. Of 540 closed systems of arms that motors press together 17 turn with
 * 1e-6 to 1e-2, 55 without (Mst_Closed). */
static const double kea_maxTwist = 1e-3;
/* Fraction of the first round's fastest rebound: rounds end when nothing rebounds faster, and contacts that still
 * approach are stopped. With this limit a tower of 8 bricks with restitution .3 that a ball hits takes a third of the
 * work. */
static const double kea_lastRound = 0.02;
/* Fraction of the load speed. A contact that separates faster is open; one that slides faster may have an event when it
 * stops; one that approaches faster at the start of a step, without rebound, chatters (rolling bodies reach the ground
 * more slowly: with 0 Mst_Rims and Mst_Cases_Friction fail). It is far above rounding (with 1e-7 a rolling ball stopped
 * 794 times) and far below 1, the change of velocity in a step. x2 fails Mst_Cases_Friction:
 * one_block_stops_and_one_topples. */
static const double kea_separatingSpeed = 0.03;
/* Fraction of the load speed: a slower approach is no impact. Faster ones are located in time. With .25, in 3 of 8 runs
 * a rocking column of ten bodies did not lose its energy in 120 s. x2 and /2 fail MdtKea_system:
 * giving_way_to_a_load_is_no_impact. */
static const double kea_minImpactSpeed = 1e-6;
/* Fraction of the load speed: upper limit of the minimal impact speed of soft contacts, whose bodies approach as the
 * contact yields to its load (minImpactSpeedOf). x2 fails
 * MdtKea_system: giving_way_to_a_load_is_no_impact. */
static const double kea_softContactSpeed = 0.05;
/* Fraction of the load speed: a slower impact does not rebound, and does not divide the step unless another one is
 * faster. It is half of what one step's loads give, so that a ball at rest stays at rest. */
static const double kea_minReboundSpeed = 0.5;
/* Fraction of the load speed below which impacts without restitution do not divide a step. x2 gives a block that rocks
 * at 30 Hz .87 of its first peak instead of .99, and fails Mst_Order_Edges: a_block_rocks_gently_and_in_long_steps.
 * With 0.1 the dominoes take half as many instructions again, with 0.25 2 % more than with 0.5. */
static const double kea_minPlasticSpeed = 0.25;
/* A slower one divides the step all the same if it is a blow: faster than this multiple of the speed that the contact
 * gains in the step, as of a slender block, whose edge comes down slowly, and than a share of the load speed. Otherwise
 * a block of 1 m, 9 degrees wide, keeps .76 of its first peak at 60 Hz. */
static const double kea_minOwnSpeed = 4, kea_minBlowSpeed = 1e-3;
/* Fraction of the bodies' own speeds that takes the place of the load speed where there are no loads. */
static const double kea_unloadedSpeed = 1e-6;
/* Largest restitution with which overlaps of rebounding contacts are removed, and bodies damped that may touch. Of 50
 * discs of .1 m that tumble at 30 Hz without friction 0 gain energy with .95, 1 with .99, 5 with .999; without removal
 * coins with .7 stay 68 mm deep (Mst_Rims). */
static const double kea_lossyRestitution = 0.95;
/* Fraction of the speed of the fastest body: with a smaller residual the passes of an impact end. It is three digits
 * below kea_velocityTolerance, the slowest approach that takes part in a round, so that a reflected contact does not
 * approach again. */
static const double kea_impactTolerance = 1e-12;
/* Relative margin: friction sticks if it is below its bound by more than this. With 0 sliding contacts seem to stop: a
 * wall takes 15 % more work, 100 balls that roll 25 % (bench/choice, wall and roll-100). */
static const double kea_stickMargin = 1e-7;
/* Slip, relative to the change of a mover's velocity, below which a body sticks to it at the end of a step. What slides
 * slips by most of the change, what sticks by a residual. Mst.Moved: what stands on a platform that starts. */
static const double kea_stickingSlip = 0.1;
/* Of the speed of a jointed body: the smallest jump by which it carries what sticks to it. Residuals of joints are
 * less. */
static const double kea_minJump = 1e-6;
/* Gap, relative to the smaller body's size, below which a contact touches. 1e-5 in double precision toppled a tower,
 * 1e-6 left it rocking in 3 of 8 runs; in single precision programs place bodies no more accurately than to 1e-5. */
static const double kea_touchingGap = sizeof(MeReal) == sizeof(double) ? 1e-7 : 1e-5;

/* ---- rotation, inertia ---- */

/* Rad: a body that turns further in a step turns as a free body does, and not by the chord (the Cayley map), which
 * turns by 93 degrees for 120 and never reaches 180. Reasoned: contacts do not carry a body
 * round by a third of a turn in a step. */
static const double kea_maxChord = 2.1;
/* Rad a step, of the rotations about the two axes of the splitting (kea_rotation.c): slower rotation is integrated by
 * the leapfrog, whose error, angle³/12, is 1e-7 rad in the worst case. Reasoned: a compromise of work and accuracy.
 * With 0 Mdt_Behaviours_Joints fails, a_ball_and_socket_leaves_all_rotations_free. */
static const double kea_slowRotation = 1e-2;
/* Rad a step, of the same rotations: faster rotation is divided into substeps, of which KEA_MAX_ROTATIONS is the
 * maximal number, a cap on the cost of a step: 60 000 rad/s at 60 Hz. A box of 1 x .5 x .2 m about its middle axis
 * keeps energy to 5.7e-8 for 10 s at 3000 rad/s and 60 Hz, with 2 rad to 8.6e-7; undivided it had 1.7 times as much. x2
 * of the first fails MdtKea_rotation: whirling_about_the_middle_axis_keeps_its_energy, and so does /2 of the second. */
static const double kea_fastRotation = 1;
enum { KEA_MAX_ROTATIONS = 1000 };
/* Sum of the squares of off-diagonal entries relative to those of the diagonal: entries of 1e-16 are rounding. */
static const double kea_jacobiTolerance = 1e-32;
/* Limits of a program's inertia tensor: the relative asymmetry, for single precision; and the smallest moment relative
 * to the largest, as a thinner body is refused. x2 and /2 of either fail MdtKea_rotation:
 * tensors_are_refused_where_they_are_said_to_be. */
static const double kea_asymmetry = 1e-5, kea_minMoment = 1e-12;

/* ---- the fast solver ---- */

/* Passes over velocities: minimal and maximal number, and how many are added at a time. The error of an accelerated
 * method falls with the square of the passes and grows with the height over which forces are transmitted. With a
 * minimum of 8, 16 and 24 a pyramid of 40 rows takes 10.6, 7.6 and 6.3 millions of multiplications a step until it
 * rests, a row of dominoes .61, .76 and .95 (bench/choice). With a maximum of 32, 48 and 64 a tower of 64 cubes falls,
 * sinks by .6 and by .008 of a cube; above 96, Newton's method is cheaper. */
enum { KEA_MIN_PASSES = 16, KEA_MAX_PASSES = 96, KEA_MORE_PASSES = 8 };
/* Upper limit of the extrapolation's theta after additional passes have increased the residual. Derived: theta after
 * KEA_MORE_PASSES, so that extrapolation reaches no further than between two measurements. 200 balls that settle in a
 * pit leave .0034 m/s, and .0074 if all passes are made without the limit (Mst_Crowd:
 * what_friction_feeds_is_held_back). KEA_MIN_PASSES more passes are made with it: no test tells 12, 24, 48 apart, which
 * leave .0037, .0034, .0032 m/s in that test. */
static const double kea_limitedTheta = 5.42;
/* Passes over displacements. 1 leaves half of the overlaps of a heap, 12 gain nothing. */
enum { KEA_POSITION_PASSES = 6 };
/* A pass over displacements removes 1 - (1 - gamma)^kea_pushExponent of an overlap: .15 at the default gamma. With 1/6
 * all passes together remove gamma of a lone contact's overlap, but far less in a heap, whose contacts push against
 * each other: 500 cylinders in a pit overlap by 1.5e-4 m on average, and 5.2e-3 at most, with .73 by 1.3e-5 and 8e-5
 * (bench/crowds, steps to 500). With 1 three boxes of 30 come 5 cm deep into a floor (Mst_Gone). */
static const double kea_pushExponent = 0.73;
/* Where joints are open, passes over displacements are made in KEA_JOINT_ROUNDS rounds, since errors of joints are not
 * linear in a rotation; rounds of joints alone follow until they are closed, up to KEA_MAX_JOINT_ROUNDS rounds in all.
 * Without the latter a ton on a light chain opens it by 1e-2 m (Mst_Jointed). /2 of the first fails Mst_Jointed:
 * figures_of_any_kind_hold_together_and_gain_no_energy; of the second Mst_Crowd: chains_hold_in_a_crowd. */
enum { KEA_JOINT_ROUNDS = 3, KEA_MAX_JOINT_ROUNDS = 8 };
/* Error, relative to a body's size, up to which joints and stops count as closed. gamma adds up the errors of five
 * steps; a net of 225 balls in loops, whose rows contradict each other by rounding, comes no nearer than 1.5e-6. 1e-5
 * lets the ropes of tutorial Bridge yield by 2.5e-5 m. */
static const double kea_closedJoint = 3e-6;
/* Relative to a body's size: if joints open by more in a step, the motion is too violent for the step, as that of a
 * light body that is whipped round by more than the rounds of a step can turn it. Without it one of 22 bodies opens by
 * .45 m (Mst_Jointed: a_light_body_may_be_whipped_round). If the exact solver's work ran out before it closed them to
 * this, the fast one takes over (Mst_Jointed: what_the_exact_solver_leaves_open_the_fast_one_closes). */
static const double kea_violentOpening = 0.05;
/* Rad: the largest rotation of a jointed body in a pass over displacements. Errors are linear for small rotations only,
 * and a chain that is pulled straight needs large ones. Without it a ton on a light chain opens it by a metre
 * (Mst_Jointed). /2 fails Mst_Crowd: chains_hold_in_a_crowd. */
static const double kea_maxPush = 0.1;
/* (h ω)² of a body as a pendulum under the load of its joints. Above it the start's velocities do not predict the pose
 * at the middle of the step well enough, and the joints of its block are of first order; a single body is stable up to
 * 4. With .5 a chain of 150 motors opens by 6e-5 m instead of 2e-6; without it a ton opens a light chain by 8 mm, and a
 * cloth gains .8 J (Mst_Jointed). */
static const double kea_stiffLoad = 0.15;
/* Bodies of a block up to which each row with bounds has the response of the whole block. Its memory and a visit are
 * proportional to the bodies: if all blocks had it, a free chain of 1000 hinges with motors would take 364 ms a step
 * instead of 11, one of 300 19 instead of 10. 128 bodies are 6 kB a row. */
enum { KEA_WIDE_BLOCK = 128 };
/* Smallest determinant of a matrix that is inverted in single precision, relative to the product of its diagonal: the
 * inverse has the error 6e-8 / 1e-4. */
static const float kea_soundDeterminant = 1e-4f;
/* Overlap at the end of the step, relative to a body's size: a contact that is deeper and still closes takes more
 * passes, even while bodies move. x2 fails Mst_Crowd: chains_hold_in_a_crowd. */
static const double kea_smallOverlap = 0.1;
/* While bodies move, passes end although deep overlaps still grow, if at less than this fraction of the bodies' speed
 * (root mean square). The rounding error that velocities may have is this fraction of the largest speed. A lower value
 * takes more passes while a heap settles, and overlaps are the same. x4 fails Mst_Crowd:
 * a_pyramid_of_forty_rows_comes_to_rest, which sinks by more than a millimetre. */
static const double kea_impactAccuracy = 0.05;
/* Root mean square of the contacts' residuals, in tolerances, at which passes end. A heap of 1000 boxes that falls and
 * settles takes 3.1, 2.85, 3.0 s for 500 steps with .1, .3, 1 (bench/heap), a pyramid of 40 rows 7.6, 8.7, 11.5
 * millions of multiplications a step until it rests (bench/choice). */
static const double kea_passedExcess = 0.3;
/* Fraction of a body's change of velocity in the step: the residual that its rows may leave beside the accuracy, since
 * the length of the step makes its motion as uncertain. With .01 dolls that settle cost twice as much; with 1 sixty
 * marbles roll round a bowl for ever (tutorial Marbles), and houses of cards slide. */
static const double kea_changeShare = 0.1;
/* Compliance relative to 1/m_0 + 1/m_1, or to a joint's A_ii: a larger one is felt within the step, and is part of the
 * equations. */
static const double kea_softShare = 1e-3;
/* Overlap, relative to the smaller body's radius of gyration, that is not corrected: else resting contacts would open
 * and close by the rounding of their passes. Nor may a contact leave a residual that moves bodies further in a step: a
 * cube of 2 cm would sink by what is invisible on one of a metre. /2 fails Mst_Crowd:
 * a_pyramid_of_forty_rows_comes_to_rest. */
static const double kea_restingDepth = 1e-4;
/* Fraction of the kinetic energy that contacts that move may add in a step. The scheme is not exact in energy for them:
 * a disc that rolls by .6 rad a step on its rim gained 13 % (Mst_Cases_Round). */
static const double kea_rollingGain = 1e-3;
/* Fraction of the kinetic energy that the passes of a step may add by rounding and by their residual. */
static const double kea_energyRoom = 1e-5;
/* The same of a step in which contacts follow their bodies. It gains 4.4e-4 of its weight times a metre at most where a
 * disc lands; /10 fails Mst_Order_Edges: a_disc_rolls_in_a_circle_of_its_own_radius, as its scheme is not exact in
 * energy. */
static const double kea_followedRoom = 1e-3;
/* Relative to the smaller body's size: if the mean velocities press a contact deeper than the end's velocities do by
 * more than this, its bodies are moved by the latter. A tenth of kea_restingDepth, so that resting bodies are moved by
 * the mean, and pressed ones come no deeper than resting ones. */
static const double kea_pressedDepth = 1e-5;
/* In resolutions of velocities: a body whose velocity changes by less in a step is at rest, and is moved by its end
 * velocity, so that it stays where contacts hold it. At 1000 and below Mst_Choice: stacks_of_any_number_stand fails in
 * double precision, where the mean velocity passes on the residual of the solver; 1e4 is a hundred thousandth of what
 * loads change in a step. */
static const double kea_restingChange = 10000;
/* Maximal number of sweeps over contacts that find pressed ones: bodies that are moved by their end velocities may
 * press others. */
enum { KEA_PRESSED_SWEEPS = 3 };
/* Rounds of passes of the fast solver for contacts that follow their bodies. Each leaves a tenth to a fortieth of the
 * change: a disc that rolls by half a radian in a step takes 6, by a quarter 4. */
enum { KEA_ARM_ROUNDS = 6 };
/* N s, or a coefficient of friction: stands for an infinite bound. Derived: the product of a coefficient and an impulse
 * of that size, and such a bound added to it, are within single precision, 2^128. */
static const double kea_maxBound = 0x1p63;
/* Multiplications, counted in the source. The first, of a visit to a manifold: 275 in a pass (kea_kernel_i.h), and an
 * eighth of a measurement of the residual. The second, of preparing a manifold and of the work after passes: 600 in the
 * kernel, and about as many in double precision, for the manifold and its share of a body. */
enum { KEA_MANIFOLD_VISIT = 300, KEA_MANIFOLD_PREPARATION = 1200 };

/* ---- workers ---- */

/* Minimal number of manifolds of a region, and the number of bodies that a worker takes at a time. The first affects
 * the answer's bits: manifolds between regions are solved after those within them. On two threads, ms a step of a
 * pyramid of 820 and of a heap of 1000 boxes (bench/threads): 2.3, 2.1, 1.9, 1.9, 2.7 and 7.8, 7.4, 6.9, 6.8, 7.8 with
 * 100, 200, 400, 800, 1600; small regions leave lanes of their groups empty, large ones leave workers idle. Half of the
 * second, and twice as much, take the same time within 5 %. */
enum { KEA_REGION_MANIFOLDS = 400, KEA_BODY_CHUNK = 64 };

/* Distance in bodies at which loops prefetch. It changes no bit. 200 steps of a heap of 10 000 boxes, s, least of
 * three: 23.4 without, 21.9, 20.1, 19.8 with 2, 4, 8, and as many in Mdt (bench/heap). */
enum { KEA_AHEAD = 4 };

/* ---- memory ---- */

/* Number of factors that a world's cache keeps: partitions with equal graphs share one; with fewer, structures are
 * found anew more often. x2 and /2 fail MdtKea_factor: the_cache_keeps_what_was_used_last. */
enum { KEA_MAX_FACTORS = 64 };

/* ---- contacts as collision gives them ---- */

/* Change of all forces in a sweep, relative to their sum, that counts as rounding. A load that is not passed down yet
 * changes few forces in each sweep: with 1e-2 those of a column whose contacts are in no order are a fifth too small.
 * x1e7 fails MdtKea_guess: a_columns_contacts_bear_what_is_above. */
static const double kea_guessTolerance = 1e-9;

/* Relative rounding of coordinates: half a unit of the last digit of MeReal, in which collision reads the bodies'
 * transforms. */
static const double kea_poseRounding = sizeof(MeReal) == sizeof(double) ? 1.2e-16 : 6e-8;
/* Relative tolerance of lengths in assertions: a hundred roundings of single precision, in which directions may be
 * given. No answer depends on it. */
static const double kea_unitRounding = 1e-5;
/* Distance, relative to a ball's radius, of its centre from its body's centre of mass, up to which it does not move
 * when the body turns. Collision gives normals and radii in MeReal, and so this centre to some 1e-7 of the radius. */
static const double kea_centredBall = 1e-6;
/* Cosine of the angle between the normal and the axis of a surface that is round about it, up to which it touches along
 * a line: of a cylinder that lies on its side, as in collision (segmentSine, mcd_face.c). */
static const double kea_lineCosine = 0.05;
/* Rad: a normal that turns less within a step counts as constant, with an error of its square: what rests or wobbles
 * under loads takes no passes for it. With kea_minTurn Mst_Choice fails: a_drum_lands_on_layers_of_cubes_of_a_kilogram.
 */
static const double kea_minNormalTurn = 1e-4;
/* Rad, sqrt(2 DBL_EPSILON): half of the square of a smaller angle is lost in rounding beside 1. */
static const double kea_minTurn = 2.1e-8;
/* Factor on the change of an approach by one step's own acceleration: a body that fell for just one step must not seem
 * faster by rounding. */
static const double kea_ownChangeMargin = 1.1;

#endif
