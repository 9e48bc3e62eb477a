// The links of bodies as lines, those that the solver corrects together in one color. Made when that layer is
// first on.
#pragma once

#include "sim/simulation.hpp"
#include "viewer/draw/layers.hpp"
#include "viewer/values.h"
#include "vk/commands.hpp"
#include "vk/kernel_store.hpp"

namespace sinew::viewer {

/// Which links a solver corrects together.
struct LinkClasses {
    std::vector<std::uint32_t> order; ///< indices of Scene::distances, class after class; the rest is
                                      ///< corrected by nobody, since neither of its ends moves
    std::vector<std::uint32_t> ends;  ///< one past the last of each class in `order`
    std::string note;                 ///< what the solver does with them
    std::size_t count() const { return ends.size(); }
};
LinkClasses linkClasses(const sim::Scene& scene, sim::Solver solver);

/// Must not outlive its Device, which must not move, nor the simulation.
class LinkLines {
public:
    /// `settings` are those of the simulation. Throws vk::Error.
    LinkLines(const vk::Device& device, const sim::Scene& scene, const sim::Settings& settings,
              const sim::Simulation& simulation);

    /// Leaves out what a blade has cut by the state that recordSkin() was recorded for.
    void record(VkCommandBuffer commands) const noexcept;

    struct Range {
        std::uint32_t firstIndex, indexCount;
        std::array<float, 3> color; ///< linear RGB
    };
    /// One a class, then what nobody corrects.
    std::span<const Range> ranges() const noexcept { return ranges_; }
    /// Two a link: particles.
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
    vk::Buffer noWords_;                     // stands for live links where nothing can be cut
    std::shared_ptr<const vk::Kernel> live_; // of the device's store
    vk::BindingSets sets_;
    std::vector<Range> ranges_;
};

} // namespace sinew::viewer
