// The links of bodies as lines; links that the solver corrects together have one colour. Made when the layer
// is first turned on.
#pragma once

#include "sinew/simulation.hpp"
#include "sinew/vk/commands.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "viewer/render/layer.hpp"
#include "viewer/values.h"

namespace sinew::viewer {

namespace layer {
extern const Layer links;
} // namespace layer

/// Partition of the links into classes that the solver corrects together.
struct LinkClasses {
    std::vector<std::uint32_t> order; ///< indices of Scene::distances, class after class; then links in no
                                      ///< class, since neither end moves
    std::vector<std::uint32_t> ends;  ///< one past the last link of each class in `order`
    std::string note;                 ///< how the solver treats links
    std::size_t count() const { return ends.size(); }
};
LinkClasses linkClasses(const sim::Scene& scene, sim::Solver solver);

/// Counts of links by the class in which the solver corrects them.
struct LinkFacts {
    std::vector<std::uint32_t> classes; ///< number of links of each class
    std::size_t fixed = 0;              ///< links between two fixed particles, in no class
    std::string note;                   ///< how the solver treats links
};

/// Must not outlive its Device, which must not move, nor the simulation.
class LinkLines : public LayerPart {
public:
    /// `settings` are those of the simulation. Throws vk::Error.
    LinkLines(const vk::Device& device, const sim::Scene& scene, const sim::Settings& settings,
              const sim::Simulation& simulation);

    /// Removes links that are cut in the state for which recordSkin() was recorded.
    void record(VkCommandBuffer commands, std::size_t look, std::uint32_t slot) const noexcept override;
    LayerReading reading(std::uint32_t slot) const override;
    void draw(const LayerDrawing& to) const noexcept override;

    struct Range {
        std::uint32_t firstIndex, indexCount;
        std::array<float, 3> color; ///< linear RGB
    };
    /// One per class, then the links in no class.
    std::span<const Range> ranges() const noexcept { return ranges_; }
    /// Two particles per link.
    vk::BufferView indices() const noexcept { return indices_.view(); }
    LinkFacts facts() const;

private:
    LinkLines(const vk::Device& device, const sim::Scene& scene, const sim::Simulation& simulation,
              LinkClasses classes, std::span<const std::uint32_t> slots);
    vk::BindingSets bindingSets(const sim::Simulation& simulation) const;

    const vk::Device& device_;
    LinkClasses classes_;
    std::uint32_t count_;
    vk::Buffer links_, indices_;
    vk::Buffer noWords_;                     // stands for live links if nothing can be cut
    std::shared_ptr<const vk::Kernel> live_; // shared with the device's kernel store
    vk::BindingSets sets_;
    std::vector<Range> ranges_;
};

} // namespace sinew::viewer
