// The links of a scene that a cut has parted, read from the device's link masks, and the strain of the
// others.
#pragma once

#include "sinew/scene.hpp"

#include <functional>
#include <span>
#include <vector>

namespace sinew::app {

/// Finds the bits that the device keeps for each link.
class CutLinks {
public:
    /// `slot` is sim::StateLayout::slot of the scene.
    CutLinks(const sim::Scene& scene, std::span<const std::uint32_t> slot);
    /// Whether a distance constraint of the scene is parted. `links` are the words of live links by slot
    /// (sim::CuttingBuffers::links).
    bool isCut(std::size_t distance, std::span<const std::uint32_t> links) const {
        const Place& place = places_[distance];
        return (place.ofA & ~links[place.slotOfA]) != 0 || (place.ofOver & ~links[place.slotOfOver]) != 0;
    }

private:
    struct Place {
        std::uint32_t slotOfA = 0, ofA = 0, slotOfOver = 0, ofOver = 0;
    };
    std::vector<Place> places_;
};

/// Strain over links: (length - rest length) / rest length.
struct LinkStrain {
    double rms = 0, largest = 0; ///< root of the mean square; largest absolute value
    std::size_t links = 0;       ///< 0: the others mean nothing
};

/// Sums strains in double, in the order in which they come.
class StrainSum {
public:
    void add(double strain);
    LinkStrain result() const;

private:
    double squares_ = 0, largest_ = 0;
    std::size_t links_ = 0;
};

/// Gives the strain of each distance constraint with a rest length for which `counts` is true, in the order
/// of the scene. `positions` has four words a particle, of which three are its place [m].
void eachStrain(const sim::Scene& scene, std::span<const float> positions,
                const std::function<bool(std::size_t)>& counts,
                const std::function<void(std::size_t, double)>& give);
/// All of them together.
LinkStrain strainOf(const sim::Scene& scene, std::span<const float> positions,
                    const std::function<bool(std::size_t)>& counts);

} // namespace sinew::app
