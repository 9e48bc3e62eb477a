// The numbers behind color maps: a kernel gives each particle its value in the state that is shown, others
// hand it on to the vertices of skins and of cuts. Made when a map is first on; nothing of the state goes to
// the host but how values are spread.
#pragma once

#include "sim/simulation.hpp"
#include "viewer/draw/layers.hpp"
#include "viewer/values.h"
#include "vk/commands.hpp"
#include "vk/kernel_store.hpp"

namespace sinew::sim {
struct StateLayout;
}

namespace sinew::viewer {

/// Which particle a slot of the solver's state holds, or NO_PARTICLE.
std::vector<std::uint32_t> particlesBySlot(const sim::StateLayout& state);

/// The links of every particle, by which a kernel finds their strain. `slots`: of the particles in the
/// solver's state.
struct LinkTable {
    std::vector<layout::ValueLinks> linksOf;
    std::vector<layout::ValueLink> links;
};
LinkTable linkTable(const sim::Scene& scene, std::span<const std::uint32_t> slots);

/// Of every vertex of all skins, in their order.
std::vector<layout::ValueHolders> skinHolders(const sim::Scene& scene);

MapReading readingOf(const layout::ValueSpread& spread);

/// Must not outlive its Device, which must not move, nor the simulation.
class ValueMaps {
public:
    /// `settings` are those of the simulation; `slots` readings may be under way at a time. Throws vk::Error.
    ValueMaps(const vk::Device& device, const sim::Scene& scene, const sim::Settings& settings,
              const sim::Simulation& simulation, std::uint32_t slots);

    /// Of the state that recordSkin() was recorded for. `slot` < slots; what was recorded into it must have
    /// finished.
    void record(VkCommandBuffer commands, ColorMap map, std::uint32_t slot) const noexcept;
    /// Of a slot that has finished.
    MapReading reading(std::uint32_t slot) const noexcept;

    /// Empty where there are no skins, no cuts.
    vk::BufferView particles() const noexcept { return values_.view(); }
    vk::BufferView skins() const noexcept;
    vk::BufferView cuts() const noexcept;

private:
    struct Tables;
    ValueMaps(const vk::Device& device, const Tables& tables, const sim::Simulation& simulation,
              std::uint32_t slots);
    vk::BindingSets bindingSets(const sim::Simulation& simulation) const;
    void dispatch(vk::Commands& commands, const vk::Kernel& kernel, std::size_t set, std::uint32_t items,
                  std::uint32_t first = 0) const noexcept;

    const vk::Device& device_;
    struct Sheet {
        std::uint32_t first, count; // vertices
    };
    std::uint32_t particleCount_, heldVertices_, cutVertices_;
    bool hasSpeeds_;
    vk::Buffer linksOf_, links_, holders_, particleOfSlot_, inverseMasses_;
    vk::Buffer noLinks_; // stands for live links where nothing can be cut
    vk::Buffer values_, skinValues_, cutValues_, spread_, spreads_;
    std::shared_ptr<const vk::Kernel> strain_, speed_, sleep_, skin_, cut_, sheet_; // of the device's store
    std::vector<Sheet> sheets_;
    vk::BindingSets sets_;
};

} // namespace sinew::viewer
