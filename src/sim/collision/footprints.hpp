// Overlaps of discs across gravity at the start: they say which particle stands above which.
#pragma once

#include "sim/collision/vectors.hpp"
#include "sim/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

namespace sinew::sim::collision {

/// A particle that touches others, as a disc across gravity.
struct Disc {
    std::uint32_t particle = 0;
    double depth = 0;    ///< along gravity [m]
    double x = 0, y = 0; ///< [m]
    double radius = 0;   ///< of the particle [m]
    double reach =
        0; ///< to its neighbours: every place of a grid, or of a face, is within reach of a corner [m]
    bool isStill = false; ///< never moves
};

/// The particles of a scene that touch others, to be asked for what stands above each. Overlaps are smooth in
/// places, radii and spacings.
class Footprints {
public:
    Footprints(const Scene& scene, std::span<const float> inverseMass, const Vector& down);

    /// From the top down.
    const std::vector<Disc>& discs() const { return discs_; }

    /// Calls visit(upper, overlap, share) for discs above `lower`: the overlap is 1 where they are one above
    /// the other, 0 from where they touch no more, and less where something that never moves is between them
    /// or where one is beside the other; the share is that of the mass of `upper` that comes to `lower`, as
    /// others that fill the layer of `lower` as densely take the rest.
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
    // Discs of sizes within a factor of 2, in cells, each from its top.
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
    std::map<int, Octave> octaves_; // a ball may be a thousand times as wide as the particles of a cloth
    std::vector<Above>
        above_; // of the disc that was asked for last; the lowest first if one of them is still
};

} // namespace sinew::sim::collision
