// The cells of the solver's hash grids, read on the device. Grids are rebuilt only when a particle has moved
// farther than the contact lists allow for, so cells are those of the last rebuild. Made when the layer is
// first turned on.
#pragma once

#include "sinew/simulation.hpp"
#include "sinew/vk/commands.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "viewer/draw/layers.hpp"
#include "viewer/values.h"

namespace sinew::viewer {

/// Must not outlive its Device, which must not move, nor the simulation.
class HashCells {
public:
    /// At most `slots` readings may be in flight at a time. Throws vk::Error.
    HashCells(const vk::Device& device, const sim::Simulation& simulation, std::uint32_t slots);

    /// Record after a step, in the same queue. `slot` < slots; the slot's previous commands must have
    /// finished.
    void record(VkCommandBuffer commands, std::uint32_t slot) const noexcept;
    /// One entry for each grid of the solver, once the commands of that slot have finished.
    std::vector<GridFacts> reading(std::uint32_t slot) const;

    /// layout::CellMark; the marks of a grid start behind the capacity of `sorted` of the grid before.
    vk::BufferView marks() const noexcept { return marks_.view(); }

    /// Draws lines, one instance per cell; the pipeline must be bound.
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
    std::shared_ptr<const vk::Kernel> kernel_; // shared with the device's kernel store
    vk::BindingSets sets_;
};

} // namespace sinew::viewer
