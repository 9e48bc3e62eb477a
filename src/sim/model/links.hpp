// The kinds of links of a scene, as rows of traits. Links are constraints with
// an energy that act between particles only. Code that needs no more of a link than
// its traits walks all kinds and names none.
#pragma once

#include "sinew/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace sinew::sim {

/// Traits of a kind of link.
template <typename Link> struct LinkTraits;

template <> struct LinkTraits<DistanceConstraint> {
    static constexpr const char* name = "distance"; ///< in complaints
    /// Whether `split` computes grids in a scene with such links.
    static constexpr bool fitsGrids = true;
    static std::array<std::uint32_t, 2> ends(const DistanceConstraint& link) { return {link.a, link.b}; }
    /// Values other than the ends that are not material.
    static std::array<float, 1> rest(const DistanceConstraint& link) { return {link.restLength}; }
    /// The factor of its stiffness, from those of the particles.
    static double factor(const DistanceConstraint& link, std::span<const double> ofParticles) {
        return std::sqrt(ofParticles[link.a] * ofParticles[link.b]);
    }
};

template <> struct LinkTraits<BendConstraint> {
    static constexpr const char* name = "bend";
    static constexpr bool fitsGrids = false;
    /// In a row: neighbours are adjacent.
    static std::array<std::uint32_t, 3> ends(const BendConstraint& link) { return {link.a, link.b, link.c}; }
    static std::array<float, 0> rest(const BendConstraint&) { return {}; }
    static double factor(const BendConstraint& link, std::span<const double> ofParticles) {
        return ofParticles[link.b];
    }
};

/// Calls `visit(links)` for the list of each kind. A new kind needs a row of
/// traits, and a line here.
template <typename AnyScene, typename Visit> void forEachKind(AnyScene& scene, const Visit& visit) {
    visit(scene.distances);
    visit(scene.bends);
}

/// Calls `visit(ends)` for all links, kind by kind.
template <typename Visit> void forEachLink(const Scene& scene, const Visit& visit) {
    forEachKind(scene, [&]<typename Link>(const std::vector<Link>& links) {
        for (const Link& link : links) visit(LinkTraits<Link>::ends(link));
    });
}

/// Calls `visit(a, b)` for all pairs of ends of all links.
template <typename Visit> void forEachLinkedPair(const Scene& scene, const Visit& visit) {
    forEachLink(scene, [&](const auto& ends) {
        for (std::size_t i = 0; i < ends.size(); ++i)
            for (std::size_t j = i + 1; j < ends.size(); ++j) visit(ends[i], ends[j]);
    });
}

inline std::size_t linkCount(const Scene& scene) {
    std::size_t count = 0;
    forEachKind(scene, [&](const auto& links) { count += links.size(); });
    return count;
}

/// Whether `split` may compute grids in this scene, as far as its links are
/// concerned.
inline bool linksFitGrids(const Scene& scene) {
    bool fit = true;
    forEachKind(scene, [&]<typename Link>(const std::vector<Link>& links) {
        fit = fit && (links.empty() || LinkTraits<Link>::fitsGrids);
    });
    return fit;
}

} // namespace sinew::sim
