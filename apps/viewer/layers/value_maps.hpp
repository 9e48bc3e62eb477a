// The values behind colour maps. A kernel computes a value for each particle in the shown state; others pass
// it to the vertices of skins and cuts. Only the distribution of values goes to the host. Made when a map is
// first turned on.
#pragma once

#include "sinew/simulation.hpp"
#include "sinew/vk/commands.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "viewer/render/layer.hpp"
#include "viewer/values.h"

namespace sinew::sim {
struct ParticleSlots;
}

namespace sinew::viewer {

/// The particle in each slot of the solver's state, or NO_PARTICLE.
std::vector<std::uint32_t> particlesBySlot(const sim::ParticleSlots& slots);

/// The links of every particle, for the strain kernel. `slots`: slots of the particles in the solver's state.
struct LinkTable {
    std::vector<layout::ValueLinks> linksOf;
    std::vector<layout::ValueLink> links;
};
LinkTable linkTable(const sim::Scene& scene, std::span<const std::uint32_t> slots);

/// One for every vertex of all skins, in order.
std::vector<layout::ValueHolders> skinHolders(const sim::Scene& scene);

MapReading readingOf(const layout::ValueSpread& spread);

/// Must not outlive its Device, which must not move, nor the simulation.
class ValueMaps : public LayerPart {
public:
    /// `settings` are those of the simulation; `slots` readings may be under way at a time. Throws vk::Error.
    ValueMaps(const vk::Device& device, const sim::Scene& scene, const sim::Settings& settings,
              const sim::Simulation& simulation, std::uint32_t slots);

    void record(VkCommandBuffer commands, std::size_t look, std::uint32_t slot) const noexcept override;
    /// The distribution of values.
    LayerReading reading(std::uint32_t slot) const override;
    void addTo(LayerBuffers& buffers, std::size_t look) const noexcept override;

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
    vk::Buffer noLinks_; // stands for live links if nothing can be cut
    vk::Buffer values_, skinValues_, cutValues_, spread_, spreads_;
    std::shared_ptr<const vk::Kernel> strain_, speed_, sleep_, skin_, cut_, sheet_; // from the device's store
    std::vector<Sheet> sheets_;
    vk::BindingSets sets_;
};

} // namespace sinew::viewer
