// The cells of the hash grids in which the solver looks for contacts, as the device has them: as they were
// built last, which is whenever something has moved farther than lists allow for. Made when that layer is
// first on.
#pragma once

#include "sim/simulation.hpp"
#include "viewer/draw/layers.hpp"
#include "viewer/values.h"
#include "vk/commands.hpp"
#include "vk/kernel_store.hpp"

namespace sinew::viewer {

/// Must not outlive its Device, which must not move, nor the simulation.
class HashCells {
public:
    /// `slots` readings may be under way at a time. Throws vk::Error.
    HashCells(const vk::Device& device, const sim::Simulation& simulation, std::uint32_t slots);

    /// After a step, in the same queue. `slot` < slots; what was recorded into it must have finished.
    void record(VkCommandBuffer commands, std::uint32_t slot) const noexcept;
    /// Of a slot that has finished: each grid that the solver has.
    std::vector<GridFacts> reading(std::uint32_t slot) const;

    /// layout::CellMark, those of a grid behind as many as `sorted` of the one before may have.
    vk::BufferView marks() const noexcept { return marks_.view(); }

    /// Lines, an instance a cell; the pipeline must be bound.
    void draw(VkCommandBuffer commands) const noexcept;

private:
    struct Grid {
        std::string name;
        layout::CellPush push;
    };
    vk::BindingSets bindingSets(const sim::Simulation& simulation) const;

    const vk::Device& device_;
    std::vector<Grid> grids_;
    vk::Buffer marks_, draws_, readings_;
    std::shared_ptr<const vk::Kernel> kernel_; // of the device's store
    vk::BindingSets sets_;
};

} // namespace sinew::viewer
