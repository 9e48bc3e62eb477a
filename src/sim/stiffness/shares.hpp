// Mass splitting of `split`: how it divides a particle among its distance constraints. A constraint's share
// of particle i is k~_c / sum_c k~_c. Any positive k~ is stable: with shares s_ic that sum to 1 over the
// constraints of a particle, J W J^T <= D for D_c = sum_i w_i |grad_i C_c|^2 / s_ic (Cauchy-Schwarz), so the
// clamp h^2 k_c D_c <= omega bounds the eigenvalues of h^2 M^-1 K by omega. With a good k~ every constraint
// reaches its clamp at about the same substep. k~ is the stiffness, levelled off where a substep cannot
// follow it:
//
//   k~_c = k_c / (1 + 2 w h^2 K_c),   K_c = k_c; in a grid, the stiffest constraint of the grid that has the
//                                     same rest length; w the mean inverse mass, h the scene's dt / substeps
//
// so that constraints that a substep cannot follow do not take everything (a soft one beside one a million
// times stiffer keeps its stiffness), and links of one kind in a grid keep their ratio (kernels then need one
// factor a kind).
//
// The volume of a cell is a constraint of eight particles, C = V - V0 with gradients g_i, that takes the
// share k~_c / sum k~ of each. With tau_i = omega / (2 w_i sum k~) its clamp is
//
//   omega / D_c = omega / sum_i (w_i |g_i|^2 sum k~ / k~_c) = 2 k~_c / sum_i (|g_i|^2 / tau_i)
//               >= 2 k~_c min tau_i / sum_i |g_i|^2
//
// evaluated with the gradients of the present state, however deformed: sum |g_i|^2 = (|c_x|^2 + |c_y|^2 +
// |c_z|^2) / 2 with c the cofactors of the mean edges e, 1.5 a^4 at rest. A cell that reaches its clamp at
// the same substep as its links has k_c = K 1.5 a^4 / 2 = 0.75 lambda_v a. Unlike a link's, the gradient also
// changes direction without limit to the deformation: C V'' is not small where a cell is stretched or
// mirrored. x^T V'' x <= |x|^2 |e| / sqrt 3, so adding |C| |e| / sqrt 3 to sum |g_i|^2 bounds the whole
// Hessian; kernels use |e| / sqrt 3 <= a (|e|^2 / (6 a^2) + 1/2), which is equal at rest.
//
// Settings::hasSharpClamp replaces the sum of k~ in tau_i by the largest eigenvalue of sum k~ n n^T, with the
// directions n of links (docs/clamp.md).
//
// Pressure that unfolds cells acts only in cells without volume and must not slow the others: it takes no
// part in sum k~, but overdraws a particle by up to the factor 1 + recoveryBudget, for which the bound on
// omega leaves room.
//
// A cut does not change tau. It only removes terms from the sum that bounds a particle, so the bound holds
// with the old tau, and each link keeps its clamp: the material beside a cut stays as stiff as before,
// although some links could become stiffer.
#pragma once

#include "sinew/scene.hpp"
#include "sinew/substeps.hpp"

#include <span>
#include <vector>

namespace sinew::sim::stiffness {

/// Stiffness of a constraint [N/m]; 1e20 for a rigid one: the clamp is far lower, and padding must give 0,
/// not Inf x 0.
float stiffnessOf(float compliance);

/// k~ of a full cell of a grid [N/m]; proportionally less for a cell with less fill.
struct CellShares {
    float volume = 0;
    float recovery = 0;
};

/// The division of the particles of a scene.
struct Shares {
    std::vector<float> ofLinks;      ///< k~ of every distance constraint [N/m]; 0 if neither end moves
    std::vector<CellShares> ofCells; ///< of every grid
    /// tau = omega / (2 w sum k~) of every particle [s^2], the sum over links and cells: a link is clamped to
    /// k~ min(tau_a, tau_b) / h^2. Large for a particle that never moves or has no constraint.
    /// With a sharp clamp, of the bodies at rest.
    std::vector<float> times;
    std::vector<float>
        startTimes; ///< tau of the scene's own state: lower where a sharp clamp finds it deformed
    Clamp clamp = Clamp::none;
    bool isSharp() const { return clamp == Clamp::sharp; }
};

/// `settings.substeps` must be resolved; `inverseMass` is taken after fixed constraints. The clamp is sharp
/// if the settings ask for it, without levels, whose bound holds for links of any direction, and internal
/// damping.
Shares sharesOf(const Scene& scene, const Settings& settings, std::span<const float> inverseMass);

/// The shares with which `split` moves a scene: those of sharesOf(), or of the sum if the sum clamps no link
/// and no cell. A sharp clamp has nothing to give there, and kernels need not follow directions.
Shares sharesOfMotion(const Scene& scene, const Settings& settings, std::span<const float> inverseMass);

/// The largest 2 w_i tau_i lambda_max(A_i) that a sharp clamp allows in a deformed state: what bends and
/// dampers leave of the stability bound.
double mostOfLinks(const Scene& scene, const Settings& settings);

/// k~ of whole links of one kind of a grid [N/m], from those of the scene's distance constraints: the ratio
/// of k~ to stiffness is the same for all links of a rest length.
float wholeShare(const Scene& scene, const Grid& grid, std::uint32_t kind, std::span<const float> ofLinks);

/// Share of a particle by which recovery pressure may exceed it: nine tenths of what stability leaves. Not
/// above 0 if omega leaves nothing.
double recoveryBudget(const Settings& settings);

/// Clamp of h^2 k_c D_c of bends: what links leave of the stability bound, and at most half of what links
/// use.
double omegaOfBends(const Settings& settings);

} // namespace sinew::sim::stiffness
