// How many substeps a step needs, and what a solver makes of the stiffness a scene asks for (methods: A4, D,
// K). Pure functions of Scene and Settings: what a report prints is what compile() and Simulation use.
#pragma once

#include "sim/scene.hpp"

namespace sinew::sim {

/// The part of a StiffnessReport that one body has.
struct BodyStiffness {
    std::string name; ///< of the body
    std::size_t elastic = 0, soft = 0;
    double softest = 1, mean = 1;
};

/// The stiffness k_eff that the links (and bends, and volumes of cells) with a compliance really have in
/// substeps of h = dt / substeps:
///   split         min(k, k~ min(tau_a, tau_b) / h^2), see solvers/shares.hpp; exact
///   gauss_seidel  k (1 - (1 - r)^iterations), r = 1 / (1 + k h^2 (w_a + w_b)); a model of one link that
///                 others pull back to where it was after each sweep
///   jacobi        k (1 - (1 - s r)^iterations); likewise, s = the share a particle takes of a correction
struct StiffnessReport {
    std::size_t elastic = 0;           ///< constraints with a compliance and an end that moves
    std::size_t clamped = 0;           ///< `split`: those with k_eff < k; other solvers have no clamp
    std::size_t soft = 0;              ///< those with k_eff < (1 - tolerance) k
    double softest = 1, mean = 1;      ///< of k_eff / k
    std::vector<BodyStiffness> bodies; ///< those with such constraints, in the order of Scene::bodies
    /// With which 1 - k_eff / k is at most the tolerance for all; 0 = with no number, since the shares of
    /// `jacobi` alone exceed it.
    std::uint32_t neededSubsteps = 1;
    double dampingTime = 0; ///< of the scene's, what a step of scene.dt has [s]
};

/// `settings.substeps` may be 0.
StiffnessReport inspectStiffness(const Scene& scene, const Settings& settings);

/// What decided the number of substeps.
enum class SubstepReason : std::uint8_t {
    asked,     ///< settings.substeps
    stiffness, ///< no elastic link softer than the tolerance allows
    weight,    ///< no rigid link stretched by more than tolerance x length under the weight hanging on it
    damping,   ///< `split`: dampingTime in full
    drag,      ///< Scene::damping: terminal speeds within dragTolerance
    contacts,  ///< what rests on particles or faces presses them in by no more than 1 % of a radius
    folds,     ///< no sheet with faces falls onto itself by more than a part of its thickness in a substep
    fewest,    ///< nothing asked for more than ranges::fewestChosen
    most,      ///< more than ranges::mostChosen were wanted
};

struct SubstepChoice {
    std::uint32_t substeps = 1;
    std::uint32_t wanted = 1; ///< before the limits fewestChosen and mostChosen
    SubstepReason reason = SubstepReason::asked;
    SubstepReason rule = SubstepReason::asked; ///< what asks for `wanted`, where the reason is `most`
    double share = 1;        ///< the smallest s_m of an elastic constraint; 1 where substeps are asked for
    bool isReachable = true; ///< false: s_m keeps a link from the tolerance, whatever the substeps
    /// Name of the body whose link, bend or cell asks for `wanted`; empty in a scene of one body, and where
    /// something else decides.
    std::string body = {};
};

/// How far off a terminal speed may be where substeps are chosen, whatever the tolerance of links is.
inline constexpr double dragTolerance = 0.05;

/// With which a terminal speed g / damping is off by no more than dragTolerance. In substeps of h it is off
/// by damping h / 2 of itself: `split` falls slower by that, other solvers faster.
std::uint32_t dragSubsteps(const Scene& scene);

/// Where settings.substeps is 0: the smallest number with which, at scene.dt,
/// - every elastic link has k_eff >= (1 - tolerance) k; where the share s_m = 1 - (1 - s)^iterations of
///   `jacobi` alone is below 1 - tolerance, which no substep changes, k_eff >= (1 - tolerance) s_m k, and
///   toText() says so,
/// - every rigid link stretches by at most tolerance x its length under the weight that hangs on it: on
///   particles that never move, on attachments, or on colliders below it (stiffness/tensions.hpp; bodies that
///   hang on nothing ask for nothing),
/// - `split` is stable with the whole of dampingTime,
/// - what falls against Scene::damping has its terminal speed within dragTolerance (dragSubsteps()),
/// - what may rest on particles or faces presses them in by at most 1 % of a radius (collision/loads.hpp),
/// - no sheet with faces falls onto itself by more than a part of its thickness in a substep
///   (stiffness/folds.hpp),
///   and there are ranges::fewestTouching where particles may touch each other or faces,
/// but from fewestChosen to mostChosen; where a scene has nothing but free particles, as many as drag asks
/// for. Longer or shorter steps keep the number.
SubstepChoice chooseSubsteps(const Scene& scene, const Settings& settings);

/// `settings` with a number in the place of 0.
Settings withSubsteps(const Scene& scene, Settings settings);

/// The use of more substeps than are chosen, and something else that does as well: "would keep the tolerance
/// of 5 %", "larger voxels or spacing, or a softer material".
struct SubstepCure {
    std::string would, otherwise;
};
SubstepCure cureOf(const SubstepChoice& choice, const Settings& settings);

/// The number that contacts alone ask for as `wanted`, by the rule `contacts` or `folds`, without the limits
/// of chooseSubsteps(). 1 where nothing may touch.
SubstepChoice contactSubsteps(const Scene& scene);

/// "64 substeps: so that no link is more than 5 % softer than asked".
std::string toText(const SubstepChoice& choice, const Settings& settings);

/// The factor of `jacobi` on corrections averaged over a particle's constraints: overRelaxation x weight x
/// the most constraints of one, overRelaxation alone where weight is 0. Proven below
/// ranges::provenRelaxation.
double jacobiRelaxation(const Scene& scene, const Settings& settings);

/// Bounds of the largest eigenvalue that each kind of constraint gives h^2 M^-1 K in `split`: min(kind x h^2,
/// omegaKind), D_c being sum of w |grad|^2 / share. Bends use what links leave of the stability bound, so
/// that a scene with bends has links as stiff as without.
struct SplitBudget {
    double links = 0, bends = 0;           ///< largest k_c D_c; infinite for rigid ones
    double omegaLinks = 0, omegaBends = 0; ///< clamps of h^2 k_c D_c
};
SplitBudget splitBudget(const Scene& scene, const Settings& settings);

/// What links may damp in a substep of `split` of length h: every damping coefficient c obeys h c D <= this.
/// With the quadratic z^2 - (2 - s (1 + theta) - d) z + (1 - s theta - d) of a mode (s, d: Rayleigh quotients
/// of h^2 K and h C, so that the two need not commute), stability is s (1 + 2 theta) + 2 d <= 4; 5 % are kept
/// back.
double dampingBudget(const SplitBudget& budget, double theta, double h);

} // namespace sinew::sim
