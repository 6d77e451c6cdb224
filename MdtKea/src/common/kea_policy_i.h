/* Inside Kea: every number that is a choice. What follows from arithmetic or geometry stays in its formula.
 *
 * Of each: its unit, and why it is what it is: a derivation, a measurement, or a test that fails when it is halved
 * (/2) or doubled (x2). Most of those are in tests/MdtKea/test_policy.c and test_fast_policy.c, and what only steers
 * cost is seen there in counted iterations.
 *
 * Units: `A_ii' is a row's J B⁻¹ Jᵀ, 1/kg, the inverse of its effective mass; `load speed' the greatest change of a
 * body's velocity by its loads in the step, m/s (kea_loadSpeed): g h under gravity.
 */
#ifndef KEA_POLICY_I_H
#define KEA_POLICY_I_H

/* Keeps quotients finite where nothing moves: far below every quantity in SI units, far above underflow. */
static const double kea_tiny = 1e-300;

/* ---- converged: the one definition, see kea_isConverged (kea_residual.c) ----
 *
 * A pass is converged when all three are met. They are as tight as double arithmetic meets at mass ratios of 1e6
 * (rounding 1e-16 times the ratio), since errors feed back: what a pass leaves of a joint's error does work λ φ in
 * every step, and a contact's residual is a creep. */

/* Of a position row's size (lengthScaleOf, kea_residual.c). 1e-5 diverges with 1000 kg on links of 1 kg, 1e-6 holds
 * them; what is below is energy, λ φ a step. x2 fails Mdt_Order: the_sag_of_a_load_is_epsilon_force_over_gamma. */
static const double kea_positionTolerance = 1e-10;
/* Of the partition's speed, and of the residual that a velocity stage starts with. Under gravity at 60 Hz a contact
 * may creep by 2e-10 m/s; scenes allow 1e-9 m in 2 s. x2 fails MdtKea_system: velocity_rows_obey_their_law. */
static const double kea_velocityTolerance = 1e-9;
/* Of a body's momentum scale: where Newton's method stops. A digit below kea_velocityTolerance, so that the inner
 * problem's rest does not count as the outer one's. x2 fails MdtKea_problem: large_problems_are_complementary. */
static const double kea_newtonTolerance = 1e-10;
/* Of kea_newtonTolerance, in a converged pass: 1e-8. Momentum is restored exactly afterwards (kea_balanceMomentum);
 * less costs passes, more leaves momentum to that correction. x2 and /2 fail MdtKea_system:
 * a_guess_within_the_tolerances_is_kept. */
static const double kea_momentumSlack = 1e2;

/* Passes have run out: below these times the tolerances the answer is exact enough, above them it is reported as
 * capped: 1e-6 of a row's size and 1e-4 of the speed. x2 and /2 fail MdtKea_problem:
 * answers_are_exact_enough_to_a_millionth. */
static const double kea_loosePosition = 1e4, kea_looseVelocity = 1e5;
/* Of kea_loose...: where passes by sweeps stop. A digit, so that a sweep's answer is not at the edge of being
 * reported. x2 and /2 fail MdtKea_policy: sweeps_end_a_digit_below_what_is_reported. */
static const double kea_sweptMargin = 0.1;

/* Of a body's velocity, in the speed that residuals are compared with, beside the load speed: something that flies
 * fast rounds its residuals by its own speed: more is laxer for fast bodies, less spends passes on rounding. x2 and /2
 * fail MdtKea_system: a_guess_within_the_tolerances_is_kept. */
static const double kea_ownSpeedShare = 0.1;
/* Of a body's radius of gyration, and of its distance from the origin, in the size that a position error is compared
 * with: the first is for rows with no lever arm and no motion, the second for the rounding of far places (1e-4 x 1e-10
 * = 1e-14 of the distance, 50 times the rounding of a double). x2 of the first fails Mdt_Order:
 * the_sag_of_a_load_is_epsilon_force_over_gamma; x2 and /2 of the second MdtKea_policy:
 * far_places_are_known_to_fourteen_digits. */
static const double kea_bodySizeShare = 1e-2, kea_distanceShare = 1e-4;
/* Of the momentum, in the scale of a body's impulses beside its loads': else a body without loads would ask for 0. It
 * is 1e-14 of the momentum with kea_newtonTolerance, 50 times the rounding of a double. x2 and /2 fail MdtKea_system:
 * a_guess_within_the_tolerances_is_kept. */
static const double kea_momentumShare = 1e-4;
/* A joint is inconsistent if a pass leaves more than this of what it asked for, twice: half way between 0, obeyed, and
 * 1. x2 fails Mdt_Report: joints_that_contradict_each_other_are_told. */
static const double kea_inconsistentShare = 0.5;
/* Of lever arms and distances from the origin, and rad: what may be wrong with attachments that a program gives in
 * single precision, eight of its roundings. A linkage may be too long by so much to pass its change point, and joints
 * that contradict each other by less agree. x2 and /2 fail MdtKea_policy:
 * joints_may_disagree_by_the_rounding_of_places. */
static const double kea_attachmentRounding = 5e-7;
/* Rad, h |w| of any body: turning further, partitions without loops do not take the tangent problem. 0 costs rag dolls
 * a sixth of their factorizations more. x2 fails Mst_SweptJoints: swept_pairs_on_hinges_do_not_explode. */
static const double kea_tangentTurn = 0.3;

/* ---- passes of a step ---- */

enum {
    /* Friction bounds go all the way to μ p_n in so many passes and impact passes, then half of it, accelerated; of the
     * velocity stage these are all passes. Where bounds settle at all, they have mostly done so in 3 to 6. x2 and /2
     * fail MdtKea_policy: friction_bounds_follow_in_full_then_by_a_secant. */
    KEA_FULL_BOUND_PASSES = 6,
    /* Passes after which friction bounds are frozen: once the answer is within kea_looseVelocity; and whatever it is.
     * Collapsing heaps settle within 60 in all but 3 % of their steps (tests/Mst/test_Heaps). x2 and /2 of either fail
     * MdtKea_policy: friction_bounds_that_do_not_settle_are_frozen. */
    KEA_FREEZE_PASS = 12,
    KEA_MAX_COUPLED_PASSES = 60,
    /* With frozen bounds the rest is convex; passes converge by 3 to 70 each, so 4 gain two to seven digits. x2 and /2
     * fail MdtKea_policy: friction_bounds_that_do_not_settle_are_frozen. */
    KEA_FROZEN_PASSES = 4,
    /* Passes of the tangent problem, which converges quadratically: 2 to 4 where it is regular, 6 near a change point;
     * at one, and with redundant joints, more do not converge either. x2 and /2 fail scenes_linkage:
     * momentum_chooses_the_branch_at_a_change_point. */
    KEA_TANGENT_PASSES = 6,
    /* Passes of sweeps that share what work is left, so that the geometry is followed (test_Mst_WorkBudget).
     * /2 fails MdtKea_policy: sweeps_leave_work_for_eight_passes. */
    KEA_SWEPT_PASSES = 8,
    /* More passes than this, and the motion's energy is watched: ordinary steps take 3 to 6; contradicting rows may be
     * found to agree in a motion of a hundred times the energy. Two times the ordinary. /2 fails MdtKea_system:
     * velocity_rows_obey_their_law. */
    KEA_UNUSUAL_PASSES = 12
};
/* The range of the secant's t, which takes back that part of the last approach: t -> 1 is division by zero, and a
 * straight line is not to be trusted beyond five times its length. x2 and /2 of either fail MdtKea_policy:
 * friction_bounds_follow_in_full_then_by_a_secant. */
static const double kea_minSecant = -4, kea_maxSecant = 0.9;

/* Of the budget of work (MdtKeaParameters.maxWork): what passes may use, so that velocities and positions at the end
 * have the rest. x2 fails Mdt_RandomJoints:
 * random_joints_end_their_steps_and_give_no_energy. */
static const double kea_workForMotion = 0.9;
/* Of it: what may be spent while friction bounds do not settle. Those that settled had taken 17 million at most, a
 * third of a budget of 50 million. x2 and /2 fail MdtKea_policy:
 * friction_bounds_that_do_not_settle_cost_part_of_the_work. */
static const double kea_workForFriction = 0.375;

/* Rad, h |w_m| of the Cayley map, which turns by 2 atan of half of it, 1.8: near half a turn (infinite h w) the
 * velocity means nothing. Halved it is 1.1 rad, which is followed well; doubled 2.4. x2 fails Mdt_Friction:
 * a_ball_may_spin_as_fast_as_it_likes. */
static const double kea_maxTurn = 2.5;
/* Rad, h |w| times the moments' relative difference: a step that turns further is divided. A top would precess
 * wrongly, and the angle is short by its square over 12: 1e-3, and 2 % where there are contacts, which lose more. .5
 * everywhere fails free rotation and tops of tests/scenes; .2 in contact costs ragdolls 40 % more factorizations. x2
 * and /2 of either fail MdtKea_system: tops_are_refused_from_a_tenth_of_a_radian_on. */
static const double kea_farTurn = 0.1, kea_farTurnInContact = 0.5;
/* Of the radius: contacts that push so close to a ball's centre do not feel its turn, 1e-3 x 2.5 rad of a radius at
 * most. x2 fails Mdt_Report: a_whirling_ball_is_divided_where_a_contact_pushes_past_its_centre. */
static const double kea_centredArm = 1e-3;
/* Times the energy at the greatest speed in the partition: an answer above it is no motion. Room for answers cut
 * short, whose energy is limited later: more lets runaways through to the limiter, less lets go of rows that still
 * hold. x2 and /2 fail MdtKea_policy: a_runaway_has_ten_times_the_energy. */
static const double kea_runawayRoom = 10;
/* Times the load speed: a greater acceleration in the last step was a jerk, and is no guess for this one. It
 * changes the first guess only, never the answer beyond tolerance. Without it Mdt_CarWheel fails,
 * the_steering_motor_moves_and_stops, in one figure by 3e-5. x2 and /2 fail MdtKea_policy:
 * an_acceleration_goes_on_up_to_thirty_loads. */
static const double kea_jerk = 30;

/* ---- theta and geometric stiffness ---- */

/* Of a body's size: a contact nearer than this may act, whatever its speed: a hundred times kea_touchingGap of single
 * precision. More makes near misses dissipate, less admits contacts a pass later. x2 and /2 fail MdtKea_system:
 * contacts_within_reach_damp. */
static const double kea_nearbyGap = 1e-3;
/* Steps: a contact that would be closed in so many with its present speed may act; 1 is the answer without rows, half
 * a step is for what rows add, and what bounces so near is met in time. x2 and /2 fail MdtKea_system:
 * contacts_within_reach_damp; 1 for what bounces fails Mst_Blows: a_step_may_end_at_the_blow. */
static const double kea_reach = 1.5;
/* Of a bounded joint's strength: above it, it may give way in this step, and is treated as a stop. x2 fails Mdt_Hinge:
 * the_lock_holds_up_to_its_force. */
static const double kea_nearBound = 0.5;
/* h² k / m of a spring: above 4, h ω > 2, a midpoint oscillation is not followed (beyond the limit of explicit
 * schemes). x2 and /2 fail MdtKea_system: springs_too_stiff_are_damped, springs_follow_the_midpoint_rule. */
static const double kea_stiffSpring = 4;
/* Of the least moment: a geometric stiffness below it is left out: Newton's method then leaves 1 % of an error a pass,
 * no more than it does anyway. x2 and /2 fail MdtKea_policy:
 * stiffness_counts_where_it_is_felt_and_harmless. */
static const double kea_smallStiffness = 0.01;
/* Of the least moment: so much negative stiffness may stay: B is positive with half its inertia. x2 and /2
 * fail MdtKea_policy: stiffness_counts_where_it_is_felt_and_harmless. */
static const double kea_harmlessStiffness = 0.5;
/* Relative difference of moments that counts as none: what a program's tensor in double arithmetic leaves. x2 and
 * /2 fail MdtKea_system: tops_are_refused_from_a_tenth_of_a_radian_on. */
static const double kea_equalMoments = 1e-9;

/* ---- the proximal parameter N: the method's own softness, of A_ii, taken out again pass by pass ---- */

/* Joints; limits, motors, other bounded rows, and joints that make loops: these contradict each other, if only by
 * rounding, and answer with impulses of the error over h N. With less, what comes and goes takes more iterations; with
 * more, heavy bodies on light ones take more passes. x2 and /2 of either fail MdtKea_system:
 * a_pass_leaves_the_proximal_part. */
static const double kea_proximalJoint = 1e-8, kea_proximalLimit = 1e-6;
/* Contacts, by passes that went well, of an impact by all of them: 1e-4 and a tenth a pass. A start of 1e-3 saves 14 %
 * of the factorizations of small partitions and fails the heavy cube and the creep of tests/scenes; constant 1e-4 takes
 * 22 to 35 factorizations a step in a heap at rest. The last is kea_velocityTolerance: a pass then leaves no more than
 * is tolerated. x2 and /2 fail MdtKea_policy: the_first_pass_leaves_a_ten_thousandth_of_a_contact,
 * contacts_harden_to_the_tolerance. */
enum { KEA_PROXIMAL_LEVELS = 6 };
static const double kea_proximalContact[KEA_PROXIMAL_LEVELS] = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};
/* Of the projection of positions: with N of 1e-5 A_ii, a contact's after a pass that went well, 1e-15 is left of a row
 * alone. 1e-6 fails Mst_Cases_Defaults in double precision: stacks_stand_by_default. */
enum { KEA_PROJECTION_PASSES = 3 };
/* The joints' side, of A_ii, where it is not taken out: rows of one joint may coincide but for rounding, which this is
 * 500 times. x2 and /2 fail MdtKea_policy: rigid_joints_are_soft_by_rounding. */
static const double kea_dualRegularization = 1e-13;
/* Redundant joints, of the metric: the part by which their smallest impulses miss; rounding of it at a mass ratio of
 * 1e4. x2 and /2 fail MdtKea_policy: rigid_joints_are_soft_by_rounding. */
static const double kea_redundancyRegularization = 1e-12;

/* ---- semismooth Newton ---- */

enum {
    /* Iterations of the convex problem; a cap: with an exact line search it ends by itself, but collapsing heaps reach
     * 60. /2 fails MdtKea_policy: iterations_of_solves. */
    KEA_MAX_CONVEX = 60,
    /* Of the coupled one, which has no potential: quadratic near the answer, else the outer iteration has to bring it
     * there. /2 fails MdtKea_policy: iterations_of_solves. */
    KEA_MAX_COUPLED = 12,
    /* Solves with kept factors: each leaves 1e-2 of the error or less where they are any good. Without such solves
     * bridges under a ton take 4 to 6 % more work (bench/choice, ton-bridge-0.5-1 and -1-1). x2 and /2 fail
     * MdtKea_policy: factors_that_are_kept_are_good_enough. */
    KEA_MAX_REFINEMENTS = 4,
    /* Halvings of its step: an eighth at least. Reasoned: shorter steps go to the outer iteration instead. x2 and /2
     * fail MdtKea_policy: iterations_of_solves. */
    KEA_MAX_HALVINGS = 4,
    /* Of the line search, which halves its interval in every second: 2^-50, a double's digits. /2 fails MdtKea_policy:
     * iterations_of_steps. */
    KEA_MAX_LINE_SEARCH = 100
};
/* A pivot of a block's factor, of its diagonal entry: below 4 roundings of a double there is no digit left. x2 and /2
 * fail MdtKea_policy: a_pivot_of_four_roundings_is_none. */
static const double kea_minPivot = 1e-15;
/* Times a double's rounding: of the sums r - J d, 12 products. With 6 (and kea_minPivot of 4 roundings)
 * Mst_SweptJoints fails, swept_pairs_on_hinges_do_not_explode, which hangs on single bits. x2 and /2 fail
 * MdtKea_policy: eight_roundings_of_rates_are_no_error. */
static const double kea_roundingSteps = 8;
/* The line search: what is left of the slope, 1e-3, costs Newton's method nothing, tighter is more visits of rows,
 * looser more factorizations; and the longest step that is looked at. x2 and /2 of the first fail MdtKea_policy:
 * iterations_of_steps; x2 of the second a_line_search_looks_sixty_four_steps_ahead. Without a longest step
 * Mst_SweptJoints fails: swept_pairs_on_hinges_do_not_explode. */
static const double kea_lineSearchTolerance = 1e-3, kea_longestStep = 64;
/* In tolerances: where the convex problem's error is below the first and falls by less than the second a step, it is
 * rounding. x2 and /2 of either fail MdtKea_policy: iterations_of_solves. */
static const double kea_convexRounding = 1e5, kea_convexProgress = 0.3;
/* The coupled step must leave at most this of the error; else it is shorter, or rounding below the second, in
 * tolerances. With 1 for the first Mst_SweptJoints fails, swept_pairs_on_hinges_do_not_explode, and a wall takes 8 %
 * more work (bench/choice). x2 and /2 of either fail MdtKea_policy: iterations_of_solves. */
static const double kea_coupledProgress = 0.9, kea_coupledRounding = 1e3;
/* Of the error: what a solve with kept factors may leave; else there is a new factor. x2 and /2 fail MdtKea_policy:
 * factors_that_are_kept_are_good_enough. */
static const double kea_refinedShare = 0.1;
/* Relative: friction bounds that agree with μ p_n so well need no coupled solve. x2 and /2 fail MdtKea_policy:
 * bounds_that_agree_to_twelve_digits_stay. */
static const double kea_boundsAgree = 1e-12;

/* ---- work, in multiplications per row, as counted ----
 *
 * x2 and /2 of each fail MdtKea_policy: work_is_counted_in_multiplications, of sweeps sweeps_share_what_work_is_left.
 * */

enum {
    KEA_VISIT = 32,          /* J d of two bodies, bounds, Jᵀ p */
    KEA_ASSEMBLY = 108,      /* of its part of the matrix: three blocks of 6 x 6 */
    KEA_LINEARIZATION = 256, /* its Jacobian, error, target; the same of a body */
    KEA_SWEEP = 96,          /* J d, the bound, B⁻¹ Jᵀ p */
    KEA_ITERATION_VISITS = 8 /* of an iteration: gradient, forces, and five of the line search */
};

/* ---- sweeps ----
 *
 * x2 and /2 of each fail MdtKea_policy: sweeps_share_what_work_is_left. */

enum {
    KEA_SWEEPS = 32,       /* of a solve, at most: accelerated they do what 500 plain ones do in a pyramid */
    KEA_FEWEST_SWEEPS = 2, /* at least: the first has no momentum */
    KEA_START_SWEEPS = 2,  /* what the choice of their start costs, counted in sweeps: three visits */
    KEA_SOME_SWEEPS = 8    /* passes that would have less are fewer: a quarter of the most */
};
/* Of the impulses: a sweep that moves them by less has settled: a hundredth of where passes by sweeps stop
 * (kea_sweptMargin kea_looseVelocity kea_velocityTolerance, 1e-5). x2 and /2 fail MdtKea_policy:
 * sweeps_end_when_they_have_settled. */
static const double kea_sweepTolerance = 1e-7;

/* ---- the velocity stage ---- */

/* Of the load speed: a residual below it is calm motion, and the stage is left out. Done always, it costs 1.7e-4 of a
 * pendulum's energy in 47 s; with .05, 7e-7. x2 and /2 fail MdtKea_system:
 * velocities_are_corrected_where_it_matters. */
static const double kea_calmResidual = 0.05;
/* The midpoint rule's mode (-1)^n: this step's residual is minus the last one's, their sum below this part of their
 * difference; and at least this part of the greatest residual, so that no small row decides. x2 of kea_rippleShare
 * fails guide_chapter_5: a_closed_system_does_not_explode; x2 and /2 of kea_rippleBalance MdtKea_system:
 * velocities_are_corrected_where_it_matters. */
static const double kea_rippleBalance = 0.5, kea_rippleShare = 0.1;

/* ---- energy ---- */

/* Of a body's size: a joint's error above it is an open joint. Solved joints leave 1e-9 of it; piles of swept boxes on
 * hinges gained energy from 1.5e-4 of it on (test_Mst_SweptJoints); with 1e-3 two of 4000 gain over 1e-3 of theirs. x2
 * and /2 fail MdtKea_policy: open_joints_close_calmly_among_contacts. */
static const double kea_brokenJoint = 1e-5;
/* Relative: rounding of sums of energies, which is not gained energy. x2 and /2 fail MdtKea_policy:
 * energy_is_known_to_twelve_digits. */
static const double kea_energyRounding = 1e-12;
/* Relative: what assertions of check builds allow to energies, bounds and unit quaternions that were computed in
 * another order: a thousand times kea_energyRounding. No answer depends on it. */
static const double kea_assertedRounding = 1e-9;
/* N s, of all impulses together: assertions do not compare larger ones, which fuzzed input reaches. */
static const double kea_maxAsserted = 1e20;
/* Relative to the largest terms of a sum of energies, for the same assertions: of a needle that spins about itself at
 * 1e16 rad/s they cancel to 1e-14. */
static const double kea_assertedCancelling = 1e-12;
/* m/s, rad/s: the largest change of a pass, whose square, and that of a distance, a double holds. No motion is near. */
static const double kea_largestChange = 1e100;
/* What is left of a direction of length 1 when its part along the normal is taken off; less is no direction but
 * rounding, and not across the normal to kea_unitRounding any more. */
static const double kea_minAcross = 1e-6;

/* ---- contacts in time ---- */

enum {
    /* Rounds of an impact; a cap: a cradle of n balls takes n. x2 and /2 fail MdtKea_policy:
     * an_impact_has_sixty_rounds. */
    KEA_MAX_ROUNDS = 60,
    /* Passes of a round: 6 take N from the first to the last of kea_proximalContact, the rest is for friction
     * bounds. x2 and /2 fail MdtKea_policy: iterations_of_impacts. */
    KEA_MAX_IMPACT_PASSES = 14
};
/* Of the first round's fastest rebound: rounds end where nothing rebounds faster, and what meets still is stopped. A
 * tower of 8 bricks with restitution .3 that a ball hits takes a third of the work. x2 and /2 fail MdtKea_policy:
 * rounds_end_at_a_fiftieth_of_the_first_rebound. */
static const double kea_lastRound = 0.02;
/* Of the load speed: what leaves faster is open, what slides faster can stop; what meets faster as a step begins, but
 * does not rebound, trembles: what rolls meets the ground more slowly (with 0 Mst_Rims and Mst_Cases_Friction fail).
 * Far above rounding: with 1e-7 a rolling ball made 794 stops, and far below 1, a step's own change. x2 fails
 * Mst_Cases_Friction: one_block_stops_and_one_topples. */
static const double kea_separatingSpeed = 0.03;
/* The same: what meets more slowly is no impact. Every impact is located: with .25 a rocking column of ten kept its
 * energy for 120 s, in 3 of 8 runs. x2 and /2 fail MdtKea_system: giving_way_to_a_load_is_no_impact. */
static const double kea_minImpactSpeed = 1e-6;
/* The same, at most, in a soft contact, which gives way to its load. x2 fails MdtKea_system:
 * giving_way_to_a_load_is_no_impact. */
static const double kea_softContactSpeed = 0.05;
/* The same: what meets more slowly does not rebound, nor divides a step by itself: half of what one step's loads give,
 * so that a ball at rest stays there. x2 and /2 fail MdtKea_policy: half_of_a_steps_loads_do_not_rebound. */
static const double kea_minReboundSpeed = 0.5;
/* Of the body's own speeds, in the load speed where there are no loads. x2 and /2 fail MdtKea_policy:
 * half_of_a_steps_loads_do_not_rebound. */
static const double kea_unloadedSpeed = 1e-6;
/* Of the speed: where an impact's passes end. Three digits below kea_velocityTolerance, the slowest meeting that is
 * part of a round, so that what is reflected does not meet again. x2 and /2 fail MdtKea_policy:
 * impacts_are_solved_to_twelve_digits. */
static const double kea_impactTolerance = 1e-12;
/* Of friction: a force that is less than the bound by more than this sticks. With 0 what slides seems to stop: a wall
 * takes 15 % more work, 100 balls that roll 25 % (bench/choice, wall and roll-100). x2 and /2 fail MdtKea_policy:
 * friction_below_its_bound_by_rounding_slides. */
static const double kea_stickMargin = 1e-7;
/* Of the smaller body's size: a gap below it touches. 1e-5 in double precision toppled a tower, 1e-6 left it rocking
 * in 3 of 8 runs; in single precision programs place bodies no better than that. x2 and /2 fail
 * MdtKea_policy: a_gap_that_counts_as_none. */
#ifdef _ME_API_DOUBLE
static const double kea_touchingGap = 1e-7;
#else
static const double kea_touchingGap = 1e-5;
#endif

/* ---- rotation, inertia ---- */

/* Rad: what turns further in a step turns as a free body does, and not by the chord, which is 93 degrees of 120 and
 * never reaches 180. Reasoned: nothing is carried round a third of a circle in a step. */
static const double kea_maxChord = 2.1;
/* Rad a step by the splitting's own rates: below it the leapfrog's error, angle³/12, is 1e-7 of a radian in the worst
 * case. Reasoned: it is work against accuracy of slow rotation. With 0 Mdt_Behaviours_Joints fails,
 * a_ball_and_socket_leaves_all_rotations_free. x2 and /2 fail MdtKea_policy:
 * rotation_beyond_a_hundredth_of_a_radian_is_of_fourth_order. */
static const double kea_slowRotation = 1e-2;
/* Rad, the same: faster rotation is divided. A box of 1 x .5 x .2 m about its middle axis keeps energy to 5.7e-8 for
 * 10 s at 3000 rad/s and 60 Hz, with 2 rad to 8.6e-7; undivided it had 1.7 times as much. x2 fails MdtKea_rotation:
 * whirling_about_the_middle_axis_keeps_its_energy. And so many parts at most, a cap on the cost of a step: 60 000 rad/s
 * at 60 Hz. /2 fails the same test. */
static const double kea_fastRotation = 1;
enum { KEA_MAX_ROTATIONS = 1000 };
/* Of the diagonal's squares: off-diagonal entries of 1e-16 of it are rounding. x2 and /2 fail MdtKea_policy:
 * an_off_diagonal_of_rounding_is_none. */
static const double kea_jacobiTolerance = 1e-32;
/* A program's tensor: by so little it may miss symmetry, single precision; and its least moment of its largest:
 * thinner is no body. x2 and /2 of either fail MdtKea_rotation: tensors_are_refused_where_they_are_said_to_be. */
static const double kea_asymmetry = 1e-5, kea_minMoment = 1e-12;

/* ---- the fast solver ---- */

/* Passes over velocities: at least, at most, and at a time. An accelerated method's error falls with the square of the
 * passes and grows with the height that forces have to pass. With 8, 16 and 24 at least a pyramid of 40 rows takes
 * 10.6, 7.6 and 6.3 millions of multiplications a step until it rests, a row of dominoes .61, .76 and .95
 * (bench/choice). With 32, 48 and 64 at most a tower of 64 cubes falls, sinks by .6 and by .008 of a cube; above the
 * most, Newton's method is cheaper. */
enum { KEA_MIN_PASSES = 16, KEA_MAX_PASSES = 96, KEA_MORE_PASSES = 8 };
/* Theta of the extrapolation, at most, once more passes have left more. Derived: what KEA_MORE_PASSES reach, so that it
 * goes no further than between two measures. 200 balls that settle in a pit leave .0034 m/s, and .0074 where all passes
 * are taken without it (Mst_Crowd: what_friction_feeds_is_held_back). x2 and /2 fail MdtKea_fast_policy:
 * held_extrapolation_is_that_of_eight_passes. KEA_MIN_PASSES are taken from there on: no test tells 12, 24, 48 apart,
 * which leave .0037, .0034, .0032 m/s in that test. */
static const double kea_limitedTheta = 5.42;
/* Passes over displacements. 1 leaves half of the overlaps of a heap, 12 gain nothing. x2 and /2 fail
 * MdtKea_fast_policy: six_passes_push_bodies_apart. */
enum { KEA_POSITION_PASSES = 6 };
/* A pass over displacements removes 1 - (1 - gamma)^kea_pushExponent of an overlap: .15 at the default gamma. With 1/6
 * all passes together remove gamma of a lone contact's overlap, but far less in a heap, where passes undo each other's
 * work: 500 cylinders in a pit overlap by 1.5e-4 m on average, and 5.2e-3 at most, with .73 by 1.3e-5 and 8e-5
 * (bench/crowds, steps to 500). With 1 three boxes of 30 come 5 cm deep into a floor (Mst_Gone). */
static const double kea_pushExponent = 0.73;
/* In so many rounds where joints are open, whose errors are not linear in a turn; and rounds of joints alone, at most,
 * until they are closed. Without the latter a ton on a light chain opens it by 1e-2 m (Mst_Jointed). /2 of the first
 * fails Mst_Jointed: figures_of_any_kind_hold_together_and_gain_no_energy; of the second Mst_Crowd:
 * chains_hold_in_a_crowd; x2 of the first MdtKea_fast_policy: contacts_take_part_in_three_rounds_of_joints, x2 and /2
 * of the second joints_are_closed_at_three_millionths. */
enum { KEA_JOINT_ROUNDS = 3, KEA_MAX_JOINT_ROUNDS = 8 };
/* Of a body's size: joints and stops are closed. gamma adds up five steps' of it; a net of 225 balls in loops, whose
 * rows contradict each other by rounding, comes no nearer than 1.5e-6. 1e-5 lets the ropes of tutorial Bridge give way
 * by 2.5e-5 m. x2 and /2 fail MdtKea_fast_policy: joints_are_closed_at_three_millionths. */
static const double kea_closedJoint = 3e-6;
/* Of a body's size: joints that open further in a step are those of motion that is too violent for it, as of a light
 * body that is whipped round by more than the rounds of a step can turn it. Without it one of 22 bodies opens by .45 m
 * (Mst_Jointed: a_light_body_may_be_whipped_round). Where the exact solver's work ran out before it closed them to
 * this, the fast one takes over (Mst_Jointed: what_the_exact_solver_leaves_open_the_fast_one_closes). x2 and /2 fail
 * MdtKea_fast_policy: a_step_that_opens_joints_by_a_twentieth_is_violent. */
static const double kea_violentOpening = 0.05;
/* Of its error: a round of Newton's method that leaves more had the derivatives of another pose. The rounds of joints
 * alone are five, and gain five digits if each gains one: from .3 of a size to kea_closedJoint. x2 and /2 fail
 * MdtKea_fast_policy: rounds_that_gain_no_digit_have_new_derivatives. */
static const double kea_roundShare = 0.1;
/* Rad, that a pass over displacements turns a body of what is tied by, at most: errors are linear for small turns only,
 * and a chain that is pulled straight asks for large ones. Without it a ton on a light chain opens it by a metre
 * (Mst_Jointed). /2 fails Mst_Crowd: chains_hold_in_a_crowd; x2 and /2 MdtKea_fast_policy:
 * a_pass_turns_by_a_tenth_of_a_radian. */
static const double kea_maxPush = 0.1;
/* Times kea_proximalLimit, where a block has no factor: half of its decades, so that the third trial is A_ii itself.
 * x2 and /2 fail MdtKea_fast_policy: joints_of_thin_bodies_are_softer_by_half_of_the_decades. */
static const double kea_softerJoint = 1e3;
/* Bodies that joints tie together, for which rows with bounds are given the response of all: their memory, and a visit,
 * go with the bodies: where all blocks do so, a free chain of 1000 hinges with motors takes 364 ms a step instead of
 * 11, one of 300 19 instead of 10. 128 are 6 kB a row. x2 and /2 fail MdtKea_fast_policy:
 * motors_feel_a_block_of_up_to_128_bodies. */
enum { KEA_WIDE_BLOCK = 128 };
/* Of the product of its diagonal, a determinant in single precision: 6e-8 / 1e-4 is what is wrong with the inverse. x2
 * and /2 fail MdtKea_fast_policy: a_determinant_of_a_ten_thousandth_is_inverted. */
static const float kea_soundDeterminant = 1e-4f;
/* Of a body's size, at the end of the step: a contact that closes further into a deeper overlap takes more passes, also
 * while bodies move. x2 fails Mst_Crowd: chains_hold_in_a_crowd; x2 and /2 MdtKea_fast_policy:
 * an_overlap_of_a_tenth_is_deep. */
static const double kea_smallOverlap = 0.1;
/* Of the bodies' speeds (root of the mean square): the residual that passes may leave where bodies are slow, and at
 * deep overlaps. Less takes more passes while a heap settles, and overlaps are the same. x4 fails Mst_Crowd:
 * a_pyramid_of_forty_rows_comes_to_rest, which sinks by more than a millimetre. */
static const double kea_impactAccuracy = 0.05;
/* Of the smaller body's size a step: no contact may leave a larger residual, or a cube of 2 cm sinks by what nobody
 * sees of one of a metre. As kea_restingDepth. */
static const double kea_stepShare = 1e-4;
/* In tolerances: the root of the mean square of the contacts' residuals with which passes end. A heap of 1000 boxes
 * that falls and settles takes 3.1, 2.85, 3.0 s for 500 steps with .1, .3, 1 (bench/heap), a pyramid of 40 rows 7.6,
 * 8.7, 11.5 millions of multiplications a step until it rests (bench/choice). */
static const double kea_passedExcess = 0.3;
/* Of a body's change of velocity in the step: the residual that its rows may leave beside the accuracy, since a step's
 * motion is that uncertain by its length. With .01 dolls that settle cost twice as much; with 1 sixty marbles roll
 * round a bowl for ever (tutorial Marbles), and houses of cards slide. */
static const double kea_changeShare = 0.1;
/* Of the speed of rest: what passes in single precision may lose of a velocity, which is found anew from impulses. A
 * pyramid of 40 rows has lost .1 to 1 of it. */
static const double kea_lostMotion = 10;
/* Of 1/m_0 + 1/m_1, or of a joint's A_ii: a compliance above is felt within the step, and solved for. x2 and /2 fail
 * MdtKea_fast_policy: a_thousandth_of_the_mobility_is_soft. */
static const double kea_softShare = 1e-3;
/* Of the smaller body's radius of gyration: overlaps up to this are left alone, or contacts that rest would open and
 * close by the rounding of their passes. /2 fails Mst_Crowd: a_pyramid_of_forty_rows_comes_to_rest; x2 and /2
 * MdtKea_fast_policy: overlaps_of_a_ten_thousandth_rest. */
static const double kea_restingDepth = 1e-4;
/* Of the kinetic energy: what the passes of a step may add to it by their rounding and by what they leave. x2 and /2
 * fail MdtKea_fast_policy: a_hundred_thousandth_of_the_energy_may_be_gained. */
static const double kea_energyRoom = 1e-5;
/* Of the smaller body's size: so much deeper than the end's velocities the mean ones may press a contact; where it
 * is more, its bodies are moved by the former: a tenth of kea_restingDepth, so that what rests moves by the
 * mean, and what presses comes no deeper than to where contacts rest. */
static const double kea_pressedDepth = 1e-5;
/* In resolutions of velocities: a body that changes its velocity by less is at rest, and stays where contacts hold it.
 * At 1000 and below Mst_Choice: stacks_of_any_number_stand fails in double precision, where the mean passes on what the
 * solver leaves; 1e4 is a hundred thousandth of what loads change in a step. */
static const double kea_restingChange = 10000;
/* Sweeps over contacts that find what is pressed, at most: bodies that are moved by the end's velocities may press
 * others. */
enum { KEA_PRESSED_SWEEPS = 3 };
/* N s, or a coefficient of friction: a bound that is none. Derived: a coefficient times an impulse of that size, and
 * such a bound beside it, are within single precision, 2^128. x2 and /2 fail MdtKea_fast_policy:
 * friction_without_bound_is_bounded_by_single_precision. */
static const double kea_maxBound = 0x1p63;
/* Multiplications, counted: of a visit to a manifold, 275 in a pass (kea_kernel_i.h), and the measure of the residual
 * after each eighth; of preparation and of what follows passes, 600 in the kernel, and about as many in double
 * precision, of the manifold and of its share of a body. x2 and /2 of either fail MdtKea_fast_policy:
 * work_is_counted_by_visits_of_manifolds. */
enum { KEA_MANIFOLD_VISIT = 300, KEA_MANIFOLD_PREPARATION = 1200 };

/* ---- workers ---- */

/* Manifolds of a region, at least, and bodies that a worker takes at a time. The first is part of the answer's bits:
 * manifolds between regions come after those in them. On two threads, ms a step of a pyramid of 820 and of a heap of
 * 1000 boxes (bench/threads): 2.3, 2.1, 1.9, 1.9, 2.7 and 7.8, 7.4, 6.9, 6.8, 7.8 with 100, 200, 400, 800, 1600; small
 * regions leave lanes of their groups empty, large ones leave workers without. With half of the second and with twice
 * as much, the same within 5 %. x2 and /2 of the first fail MdtKea_fast_policy: regions_have_four_hundred_manifolds; of
 * the second a_worker_takes_sixty_four_bodies_at_a_time. */
enum { KEA_REGION_MANIFOLDS = 400, KEA_BODY_CHUNK = 64 };

/* Bodies ahead of the one that a loop works on, whose memory is asked for. It changes no bit. 200 steps of a heap of
 * 10 000 boxes, s, least of three: 23.4 without, 21.9, 20.1, 19.8 with 2, 4, 8, and as many in Mdt (bench/heap). */
enum { KEA_AHEAD = 4 };

/* ---- memory ---- */

/* Factors that a world keeps: partitions that look alike share one; fewer are found anew more often. x2 and /2 fail
 * MdtKea_factor: the_cache_keeps_what_was_used_last. */
enum { KEA_MAX_FACTORS = 64 };

/* ---- contacts as they come ---- */

/* Of the sum of all forces: changes in a sweep by rounding. A load that has not come down yet changes few forces in
 * each sweep: with 1e-2 those of a column whose contacts come in no order are a fifth too small. x1e7 fails
 * MdtKea_guess: a_columns_contacts_bear_what_is_above. */
static const double kea_guessTolerance = 1e-9;

/* Of coordinates: half a unit of the last digit of MeReal, in which collision sees the bodies' transforms. */
#ifdef _ME_API_DOUBLE
static const double kea_poseRounding = 1.2e-16;
#else
static const double kea_poseRounding = 6e-8;
#endif
/* Of lengths, in assertions: directions may have come in single precision, a hundred roundings of it. No answer depends
 * on it. */
static const double kea_unitRounding = 1e-5;
/* Of a ball's radius: a centre that is so near to its body's does not move when that turns. Collision gives normals and
 * radii in MeReal, and so this centre to some 1e-7 of the radius. x2 and /2 fail MdtKea_policy:
 * a_ball_whose_centre_is_off_by_a_millionth_moves. */
static const double kea_centredBall = 1e-6;
/* rad, sqrt(2 DBL_EPSILON): the square of a smaller turn, over 2, is lost in rounding. */
static const double kea_minTurn = 2.1e-8;
/* Of the change of an approach by one step's own acceleration: a body that fell for just one step must not seem faster
 * by rounding. x2 and /2 fail MdtKea_policy: one_steps_own_acceleration_is_no_blow. */
static const double kea_ownChangeMargin = 1.1;

#endif
