// Initial overlaps of discs, projected along gravity: they determine which particle stands above which.
#pragma once

#include "sim/collision/vectors.hpp"
#include "sinew/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

namespace sinew::sim::collision {

/// A touching particle, projected along gravity to a disc.
struct Disc {
    std::uint32_t particle = 0;
    double depth = 0;    ///< along gravity [m]
    double x = 0, y = 0; ///< [m]
    double radius = 0;   ///< of the particle [m]
    double reach =
        0; ///< to its neighbours: every point of a grid, or of a face, is within reach of a corner [m]
    bool isStill = false; ///< never moves
};

/// The touching particles of a scene; finds the particles above each. Overlaps are smooth functions of
/// positions, radii and spacings.
class Footprints {
public:
    Footprints(const Scene& scene, std::span<const float> inverseMass, const Vector& down);

    /// Discs ordered from top to bottom.
    const std::vector<Disc>& discs() const { return discs_; }

    /// Calls visit(upper, overlap, share) for discs above `lower`. The overlap is 1 if they are one above the
    /// other, falls to 0 at the distance where they no longer touch, and is smaller if a static particle lies
    /// between them or if one is beside the other. The share is the part of the mass of `upper` that rests on
    /// `lower`; others that fill the layer of `lower` equally densely take the rest.
    template <typename Visit> void forEachAbove(const Disc& lower, const Visit& visit) {
        findAbove(lower);
        double still = 0;
        for (const Above& above : above_) {
            const double overlap = above.overlap * (1 - std::min(1.0, still));
            if (overlap <= 0) return;
            if (discs_[above.disc].isStill)
                still += above.overlap;
            else
                visit(discs_[above.disc], overlap, overlap * above.part);
        }
    }

private:
    struct Above {
        std::uint32_t disc = 0;
        double overlap = 0, part = 0;
    };
    using Key = std::pair<std::int64_t, std::int64_t>;
    struct Hash {
        std::size_t operator()(const Key& key) const {
            return static_cast<std::size_t>(static_cast<std::uint64_t>(key.first) * 73856093 ^
                                            static_cast<std::uint64_t>(key.second) * 19349663);
        }
    };
    // Discs of sizes within a factor of 2, in cells, each from top to bottom.
    struct Octave {
        double width = 0, mostRadius = 0, mostReach = 0; // [m]
        std::unordered_map<Key, std::vector<std::uint32_t>, Hash> cells;
    };

    static Key keyOf(const Octave& octave, double x, double y);
    void addToOctave(std::uint32_t disc);
    void findAbove(const Disc& lower);
    void searchOctave(const Disc& lower, const Octave& octave);
    void searchCell(const Disc& lower, const std::vector<std::uint32_t>& cell);

    std::vector<Disc> discs_;
    std::map<int, Octave> octaves_; // a sphere may be a thousand times as wide as the particles of a cloth
    std::vector<Above>
        above_; // those above the disc of the last query; from bottom to top if one of them is static
};

} // namespace sinew::sim::collision
