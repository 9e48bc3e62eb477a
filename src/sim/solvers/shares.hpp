// How `split` divides a particle among its distance constraints. A constraint's share of particle i is
// k~_c / sum_c k~_c: any positive k~ is stable (methods: D), a good one lets every constraint reach its clamp
// at about the same substep. k~ is the stiffness, levelled off where a substep cannot follow it anyway:
//
//   k~_c = k_c / (1 + 2 w h^2 K_c),   K_c = k_c; in a grid, the stiffest constraint of the grid that has the
//                                     same rest length; w the mean inverse mass, h the scene's dt / substeps
//
// so that constraints that a substep cannot follow do not take everything (a soft one beside one a million
// times stiffer keeps its stiffness), and links of one kind in a grid keep their ratio (kernels then need one
// factor a kind).
//
// The volume of a cell is a constraint of eight particles, C = V - V0 with gradients g_i, that takes the same
// share k~_c / sum k~ of each. With tau_i = omega / (2 w_i sum k~) its clamp (methods: D) is
//
//   omega / D_c = omega / sum_i (w_i |g_i|^2 sum k~ / k~_c) = 2 k~_c / sum_i (|g_i|^2 / tau_i)
//               >= 2 k~_c min tau_i / sum_i |g_i|^2
//
// taken with the gradients of the state it acts in, however deformed: sum |g_i|^2 = (|c_x|^2 + |c_y|^2 +
// |c_z|^2) / 2 with c the cofactors of the mean edges e, 1.5 a^4 at rest. A cell that is reached at the same
// substep as its links has k_c = K 1.5 a^4 / 2 = 0.75 lambda_v a. Unlike a link's, the gradient also turns
// with the state at no length: C V'' is not small where a cell is stretched or mirrored. x^T V'' x <= |x|^2
// |e| / sqrt 3, so adding |C| |e| / sqrt 3 to sum |g_i|^2 bounds the whole Hessian; kernels use |e| / sqrt 3
// <= a (|e|^2 / (6 a^2) + 1/2), which is equal at rest.
//
// Pressure that unfolds cells acts only in cells without volume and shall cost the others nothing: it takes
// no part in sum k~, but overdraws a particle by up to the factor 1 + recoveryBudget, which the bound on
// omega leaves room for.
//
// A cut leaves tau as it is. Of the sum that bounds a particle only terms go, so the bound holds with the old
// tau, and each link keeps the clamp that it had: what is cut off is as stiff as before, though some of its
// links might have become stiffer.
#pragma once

#include "sim/scene.hpp"

#include <span>
#include <vector>

namespace sinew::sim::solvers {

/// Stiffness of a constraint [N/m]. A rigid one gets 1e20: the clamp takes over long before, and padding must
/// give 0, not Inf x 0.
float stiffnessOf(float compliance);

/// k~ of a full cell of a grid [N/m]; of one with less fill it is less in proportion.
struct CellShares {
    float volume = 0;
    float recovery = 0;
};

/// How the particles of a scene are divided.
struct Shares {
    std::vector<float> ofLinks;      ///< k~ of every distance constraint [N/m]; 0 where neither end moves
    std::vector<CellShares> ofCells; ///< of every grid
    /// tau = omega / (2 w sum k~) of every particle [s^2], the sum over links and cells: a link is clamped to
    /// k~ min(tau_a, tau_b) / h^2. Large where a particle never moves or has no constraint.
    std::vector<float> times;
};

/// `settings.substeps` is a number; `inverseMass` after fixed constraints.
Shares sharesOf(const Scene& scene, const Settings& settings, std::span<const float> inverseMass);

/// k~ of the links of one kind of a grid where they are whole [N/m], from those of the scene's distance
/// constraints: a link's k~ over its stiffness is the same for all links of a rest length.
float wholeShare(const Scene& scene, const Grid& grid, std::uint32_t kind, std::span<const float> ofLinks);

/// By how much recovery pressure may overdraw what a particle has to share, in parts of it: a tenth less than
/// stability leaves. Not above 0 where omega leaves nothing.
double recoveryBudget(const Settings& settings);

/// Clamp of h^2 k_c D_c of bends: what links leave of the stability bound, and no more than half of what they
/// use.
double omegaOfBends(const Settings& settings);

} // namespace sinew::sim::solvers
