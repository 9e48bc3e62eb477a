// Choice of the number of substeps, and the stiffness that a solver effectively gives to a scene. Pure
// functions of Scene and Settings: reports, compile() and Simulation use the same numbers.
#pragma once

#include "sinew/export.hpp"
#include "sinew/scene.hpp"

namespace sinew::sim {

/// The share of one body in a StiffnessReport.
struct SINEW_API BodyStiffness {
    std::string name; ///< of the body
    std::size_t elastic = 0, soft = 0;
    double softest = 1, mean = 1;
};

/// Effective stiffness k_eff of links, bends and volumes of cells with a compliance, in substeps of h = dt /
/// substeps:
///   split         min(k, k~ min(tau_a, tau_b) / h^2), see solvers/shares.hpp; exact
///   gauss_seidel  k (1 - (1 - r)^iterations), r = 1 / (1 + k h^2 (w_a + w_b)); a model of one link that
///                 others pull back to its old length after each sweep
///   jacobi        k (1 - (1 - s r)^iterations); the same model, s = a particle's share of a correction
struct SINEW_API StiffnessReport {
    std::size_t elastic = 0;           ///< constraints with a compliance and an end that moves
    std::size_t clamped = 0;           ///< constraints of `split` with k_eff < k; other solvers have no clamp
    std::size_t soft = 0;              ///< constraints with k_eff < (1 - tolerance) k
    double softest = 1, mean = 1;      ///< of k_eff / k
    std::vector<BodyStiffness> bodies; ///< bodies with such constraints, in the order of Scene::bodies
    /// Smallest number of substeps for which 1 - k_eff / k is at most the tolerance everywhere; 0 = no number
    /// suffices, since the shares of `jacobi` alone exceed the tolerance.
    std::uint32_t neededSubsteps = 1;
    double dampingTime = 0; ///< effective part of Scene::dampingTime in a step of scene.dt [s]
};

/// `settings.substeps` may be 0.
SINEW_API StiffnessReport inspectStiffness(const Scene& scene, const Settings& settings);

/// The clamp of link stiffness that a simulation runs with, and the reason if it is that by the sum although
/// a host may ask for the sharp one (docs/clamp.md).
enum class Clamp : std::uint8_t {
    none,       ///< another solver than `split`
    sharp,      ///< by the directions in which links meet
    sumAsked,   ///< Settings::hasSharpClamp is false
    sumLevels,  ///< coarse levels need the sum
    sumDamping, ///< internal damping takes what the sum leaves of the stability bound
    sumWhole,   ///< the sum clamps no link and no cell of the bodies at rest in a step of Scene::dt
};

/// The clamp of a simulation of `scene`; `settings.substeps` may be 0.
SINEW_API Clamp clampOf(const Scene& scene, const Settings& settings);

/// The clamp as text: "sharp", "sum: levels"; "none" for other solvers than `split`.
SINEW_API std::string toText(Clamp clamp);

/// The rule that decided the number of substeps.
enum class SubstepReason : std::uint8_t {
    asked,     ///< settings.substeps
    stiffness, ///< no elastic link is softer than the tolerance allows
    weight,    ///< no rigid link stretches by more than tolerance x length under the weight that hangs on it
    damping,   ///< `split`: stable with the whole dampingTime
    drag,      ///< Scene::damping: terminal speeds within dragTolerance
    contacts,  ///< particles resting on particles or faces overlap by at most 1 % of a radius
    folds,     ///< no sheet with faces overlaps itself by more than a part of its thickness in a substep
    fewest,    ///< no rule asks for more than ranges::fewestChosen
    most,      ///< a rule asks for more than ranges::mostChosen
};

struct SINEW_API SubstepChoice {
    std::uint32_t substeps = 1;
    std::uint32_t wanted = 1; ///< before the limits fewestChosen and mostChosen
    std::uint32_t levels = 0; ///< Settings::levels, chosen if that is autoLevels
    SubstepReason reason = SubstepReason::asked;
    SubstepReason rule = SubstepReason::asked; ///< the rule behind `wanted`, if the reason is `most`
    double own = 1; ///< share of its stiffness that the deciding link must have itself; levels carry the rest
    double share = 1;        ///< smallest s_m of an elastic constraint; 1 if the settings give substeps
    bool isReachable = true; ///< false: s_m keeps a link from the tolerance with any number of substeps
    /// Name of the body whose link, bend or cell needs `wanted`; empty in a scene of one body, and if another
    /// rule decides.
    std::string body = {};
};

/// Allowed error of a terminal speed in the choice of substeps, whatever the tolerance of links is.
inline constexpr double dragTolerance = 0.05;

/// Smallest number of substeps for which the error of a terminal speed g / damping is at most dragTolerance.
/// In substeps of h the relative error is damping h / 2: `split` falls slower by that, other solvers faster.
SINEW_API std::uint32_t dragSubsteps(const Scene& scene);

/// The number of substeps if settings.substeps is 0: the smallest one with which, at scene.dt,
/// - every elastic link has k_eff >= (1 - tolerance) k, of links on grids a quarter with one of
///   Settings::levels and a ninth with more or in a sheet, as levels carry the rest; if the share s_m = 1 -
///   (1 - s)^iterations of `jacobi` alone is below 1 - tolerance, which no substep changes, then k_eff >= (1
///   - tolerance) s_m k, and toText() reports it,
/// - every rigid link stretches by at most tolerance x its length under the weight that hangs on it: from
///   static particles, from attachments, or above colliders (stiffness/tensions.hpp; bodies that hang on
///   nothing need nothing),
/// - `split` is stable with the whole dampingTime,
/// - a body that falls against Scene::damping has its terminal speed within dragTolerance (dragSubsteps()),
/// - particles that may rest on particles or faces overlap by at most 1 % of a radius (collision/loads.hpp),
/// - no sheet with faces overlaps itself by more than a part of its thickness in a substep
///   (stiffness/folds.hpp),
/// - it is at least ranges::fewestTouching if particles may touch each other or faces.
/// The result is limited to the range from fewestChosen to mostChosen; a scene with only free particles has
/// the number that drag needs. Longer or shorter steps keep the number.
///
/// The number of levels if settings.levels is autoLevels: by how many substeps are lacking for the whole
/// stiffness of links on grids, as levels win at equal error; 0 where nothing wins, and where levels would be
/// refused. With both numbers to choose, a third of the substeps and the levels for it, or all and none.
SINEW_API SubstepChoice chooseSubsteps(const Scene& scene, const Settings& settings);

/// Returns `settings` with the chosen numbers if substeps is 0 or levels is autoLevels.
SINEW_API Settings withSubsteps(const Scene& scene, Settings settings);

/// The effect of more substeps than were chosen, and an alternative: "would keep the tolerance of 5 %",
/// "larger voxels or spacing, or a softer material".
struct SINEW_API SubstepCure {
    std::string would, otherwise;
};
SINEW_API SubstepCure cureOf(const SubstepChoice& choice, const Settings& settings);

/// The number that contacts alone need, as `wanted`, by the rule `contacts` or `folds`, without the limits of
/// chooseSubsteps(). 1 if nothing may touch.
SINEW_API SubstepChoice contactSubsteps(const Scene& scene);

/// The numbers as text: "64 substeps", "16 substeps and 2 levels".
SINEW_API std::string toText(const Settings& settings);

/// The choice as a sentence: "64 substeps: so that no link is more than 5 % softer than asked".
SINEW_API std::string toText(const SubstepChoice& choice, const Settings& settings);

/// The factor of `jacobi` on corrections averaged over a particle's constraints: overRelaxation x weight x
/// the largest number of constraints of a particle, or overRelaxation alone if weight is 0. Convergence is
/// proven below ranges::provenRelaxation.
SINEW_API double jacobiRelaxation(const Scene& scene, const Settings& settings);

/// Bounds of the largest eigenvalue that each kind of constraint contributes to h^2 M^-1 K in `split`:
/// min(kind x h^2, omegaKind), with D_c the sum of w |grad|^2 / share. Bends use the part of the stability
/// bound that links leave, so that links in a scene with bends are as stiff as without.
struct SINEW_API SplitBudget {
    double links = 0, bends = 0;           ///< largest k_c D_c; infinite for rigid ones
    double omegaLinks = 0, omegaBends = 0; ///< clamps of h^2 k_c D_c
};
SINEW_API SplitBudget splitBudget(const Scene& scene, const Settings& settings);

/// Bound of the damping of links in a substep of `split` of length h: every damping coefficient c obeys h c D
/// <= this. A mode has the quadratic z^2 - (2 - s (1 + theta) - d) z + (1 - s theta - d), with s, d the
/// Rayleigh quotients of h^2 K and h C, so that the two need not commute; it is stable for s (1 + 2 theta) +
/// 2 d <= 4. 5 % of that are held in reserve.
SINEW_API double dampingBudget(const SplitBudget& budget, double theta, double h);

} // namespace sinew::sim
