#pragma once

// Every tolerance of the engine, with its reason.

namespace urto {

// Points closer than this become contact constraints before they touch, so that a body is stopped at the surface and
// not inside it. Two centimetres cover a step at 1.2 m/s; what approaches faster gets its own reach on top.
inline constexpr double kSpeculativeDistanceMax = 0.02;  // m
// A thin shape's reach is smaller, or a card would feel what it does not touch.
inline constexpr double kSpeculativeFraction = 0.2;  // of the shape's smallest half extent

// What a proxy's bounds are fattened by, as a share of its half extents: a larger share means fewer moves of the
// broad phase and more pairs for the narrow phase.
inline constexpr double kFatMarginFraction = 0.12;
inline constexpr double kFatMarginMin = 0.01;  // m
inline constexpr double kFatMarginMax = 0.1;   // m

// Overlap is undone no faster than this, so that a deep overlap does not become an explosion.
inline constexpr double kPushSpeedMax = 3.0;  // m/s
// Stiffness and damping of a contact; the stiffness is also bounded by what the sub-step can integrate.
inline constexpr double kContactHertz = 30.0;
inline constexpr double kContactDampingRatio = 10.0;
inline constexpr double kContactHertzPerSubStepRate = 0.25;  // of the sub-steps per second
// What stands still cannot swing with what lies on it, so contacts with it can have twice the frequency (as in Box2D).
inline constexpr double kGroundStiffness = 2.0;

// Time in which a contact's preload follows its impulse. Shorter, and large pyramids spread and stacks of a hundred
// boxes begin to swing, because the load reaches the ground more slowly than the preload chases it; longer, and they
// recover late. Measured in docs/decisions/0008.
inline constexpr double kPreloadTime = 12.0;  // s
// The time on top where contacts are few in a row and their load is found soon: of masses that differ, and with ground
// that is sunk into. Shorter, and it races the solver under some thousand times the mass (docs/decisions/0002).
inline constexpr double kPreloadTimeFast = 1.0;  // s
inline constexpr double kUnevenMasses = 8.0;     // the heavier one's mass over the lighter's; in full at twice that
inline constexpr double kSunkDepth = 4e-3;       // m, into what does not move; in full at twice that
inline constexpr double kSteadyChange = 1e-3;    // of an impulse, from a step's mean to its last sub-step: half as fast

// A normal impulse that grows by more than this speed in a sub-step is a shock: its friction waits until bodies have
// moved.
inline constexpr double kShockSpeed = 1.0;  // m/s

// The arms of a contact follow the drift of its bodies up to this share of the shorter arm. Bodies that pass each other
// faster have left the point that their masses were computed for, and long arms on a small body would make energy.
inline constexpr double kDriftFraction = 0.25;

// Where two faces of the ground meet, a gap between them up to this share of the speculative reach makes a seam all the
// same; a body that has sunk in so far still lies on the ground and not beside it.
inline constexpr double kSeamFraction = 0.25;
// A step up to this share of the reach (0.4 mm under a box of half a metre) is no step.
inline constexpr double kSeamStepFraction = 0.02;
// 1 − cosine of the angle up to which two faces have one direction: 0.26 degrees.
inline constexpr double kSeamTurn = 1e-5;
// Sine of the angle up to which the normal of round surfaces is a face's: rounding.
inline constexpr double kSeamRoundTurn = 3e-7;

// Two contact points so near to each other that their equations say the same are solved as one: least determinant,
// as a share of the diagonal's product.
inline constexpr double kDeterminantMin = 1e-5;

// Sleep: slower than this for so long. The angular part is a speed of the body's farthest point.
inline constexpr double kSleepSpeed = 0.05;  // m/s
inline constexpr double kSleepTime = 0.5;    // s

// A body counts as fast in a step in which it moves further than this share of its smallest half extent:
// below it, its centre cannot pass through what it did not overlap before.
inline constexpr double kFastFraction = 0.75;
// Distance at which a swept body stops before what it hits, as a share of its speculative reach.
inline constexpr double kImpactTargetFraction = 0.25;
inline constexpr double kImpactToleranceFraction = 0.05;
// So often may a body bounce, or be pushed by a kinematic one, within a step.
inline constexpr unsigned kImpactsMax = 8;
// A body that gives way for the second time in a step stands still for the rest of it.
inline constexpr unsigned kWaysMax = 2;

// Nearer to an attractor's centre than this its pull grows no more: at the centre itself the law has no finite value.
inline constexpr double kAttractionDistanceMin = 1e-3;  // m

// Above this count of shapes a tree beats the comparison of all pairs (bench/README.md).
inline constexpr unsigned kBruteForceShapesMax = 24;

// Stiffness and damping of a joint that is not a spring. With half of this stiffness a hanging grid of 100 × 100
// discs stretches 2.5 times as far; with twice as much it bursts.
inline constexpr double kJointHertzPerSubStepRate = 0.25;  // of the sub-steps per second
inline constexpr double kJointDampingRatio = 2.0;
// A gap of a joint is pulled shut no faster than this, so that a chain that starts torn does not strike itself into a
// knot. A load holds a gap open that asks for more only from a thousand times its own weight on: 0.16 m at 60 Hz.
inline constexpr double kJointPullSpeedMax = 10.0;  // m/s
// Anchors of a distance joint nearer to each other than this have no direction.
inline constexpr double kAnchorDistanceMin = 1e-6;  // m

// Of two faces that separate equally well, SAT keeps the first unless the second is better by this much, so that the
// reference face does not flicker.
inline constexpr double kFacePreference = 1e-4;  // m

// From this ratio of its least to its greatest reach on, the disc around an outline tells most pairs apart that are.
inline constexpr double kNearlyRound = 0.5;
// By this share two discs must be further apart than they are large, so that rounding cannot hide a contact.
inline constexpr double kDiscSlack = 1e-5;

// Loops shorter than two of these are not worth a second thread: about two microseconds of work each.
inline constexpr unsigned kBodiesPerShare = 64;
inline constexpr unsigned kBlocksPerShare = 4;
// A pass takes a tenth of a microsecond a block, but where it is shared out the bodies have to come over from the other
// processor's cache: that much for each block, if neighbours in a block are not neighbours in the world.
inline constexpr unsigned kBlocksPerPassShare = 16;
inline constexpr unsigned kPairsPerShare = 256;
inline constexpr unsigned kImpactsPerShare = 8;

}  // namespace urto
