#pragma once

// Every tolerance and bound of the precise solver, with its reason.

namespace urto {

// The contact problem -------------------------------------------------------------------------------------------

// Residual that counts as zero: of the speed that the bodies would have without contacts, plus so many roundings of
// the largest impulse.
inline constexpr double kResidual = 1e-13;
inline constexpr double kRoundings = 64;
// Newton's method ends sooner where points are all but redundant; up to so many tolerances that is the answer.
inline constexpr double kGoodEnough = 1e3;
// Weight of a constraint in the factorised matrix, in masses of the heavier body. A repetition shrinks the error by 1 /
// (1 + stiffness · the least eigenvalue of the contacts), which is 2.5e-4 for a stack of a hundred; each decade costs a
// digit of the factorisation, which the next repetition brings back.
inline constexpr double kStiffness = 1e7;
inline constexpr int kCorrectionsFirst = 3;  // repetitions before their gain is looked at
inline constexpr int kCorrectionsMax = 24;
// Rounds of Newton's method from the guess, and after the interior-point method. Where it converges it takes under ten;
// more means that it runs in a circle.
inline constexpr int kNewtonRounds = 24;
inline constexpr int kPolishRounds = 24;
inline constexpr int kInteriorRounds = 40;
inline constexpr double kInteriorGap = 1e-11;  // of the first complementarity: near enough to name the states

// Sweeps where the direct methods fail: of 367 such problems of a card house 83 were left with more than 1e-4 m/s,
// 18 after 256 sweeps, 3 after 1024, none after 4096.
inline constexpr int kSweepsMax = 1024;
inline constexpr int kSweepsBetweenLooks = 32;

// Touching ------------------------------------------------------------------------------------------------------

// Surfaces nearer than this touch: they share forces. Far below what anybody sees, far above the rounding of
// coordinates up to 1e7 m.
inline constexpr double kTouchDistance = 1e-6;  // m
// Speeds along a normal below this are rest: neither an impact nor a departure.
inline constexpr double kRestSpeed = 1e-7;  // m/s
// Penetration deeper than this is taken back, so much of it a step and no faster than the engine's push speed.
inline constexpr double kPenetrationMin = 1e-9;  // m
inline constexpr double kPenetrationShare = 0.5;

// Impacts -------------------------------------------------------------------------------------------------------

// An impact is found to this distance, which a millimetre a second passes in a tenth of a microsecond.
inline constexpr double kImpactDistance = 1e-10;  // m
inline constexpr int kAdvancesMaxPrecise = 64;
// Impacts of one moment among bodies that touch, taken one after the other; the rest are taken together as inelastic.
inline constexpr int kImpactRoundsMax = 256;
// Bounces of a pair in one step: of more, as those of a ball that comes to rest, the rest is inelastic.
inline constexpr unsigned kBouncesMax = 64;
inline constexpr unsigned kStrikesMax = 128;  // of all impacts of a pair in one step: then it rests for a moment
// A pair whose search ended without a touch is looked at again after this share of the step, and then ever later:
// one-sided segments let pass what comes from behind.
inline constexpr double kSilence = 1e-3;
inline constexpr double kSilenceGrowth = 4;
// Bodies whose contacts may be solved anew in one step, in multiples of the awake ones. Beyond it a body stops where it
// touches, keeps its velocity, and the next step goes on from there.
inline constexpr unsigned kWorkFactor = 16;
inline constexpr unsigned kWorkLeast = 512;
// Where sliding ends within a step, it is settled there anew, so often a pair and step and in clusters up to this size.
inline constexpr unsigned kStopsMax = 8;
inline constexpr unsigned kStopClusterMax = 32;
inline constexpr double kStopLeast = 1e-6;  // of the time at hand: what ends sooner has ended

}  // namespace urto
