// The cells of the solver's hash grids, read on the device. Grids are rebuilt only when a particle has moved
// farther than the contact lists allow for, so cells are those of the last rebuild. Made when the layer is
// first turned on.
#pragma once

#include "sinew/simulation.hpp"
#include "sinew/vk/commands.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "viewer/render/layer.hpp"
#include "viewer/values.h"

namespace sinew::viewer {

namespace layer {
extern const Layer cells;
} // namespace layer

/// Statistics of a hash grid at its last rebuild.
struct GridFacts {
    std::string name;         ///< its contents
    float edge = 0;           ///< side of a cell [m]
    std::uint32_t cells = 0;  ///< cells that are not empty
    std::uint32_t shared = 0; ///< cells that share their slot of the table with others
    std::uint32_t most = 0;   ///< largest number of items in a cell
    std::uint32_t held = 0;   ///< number of items in all cells
    std::uint32_t slots = 0;  ///< slots of the table
};

/// Must not outlive its Device, which must not move, nor the simulation.
class HashCells : public LayerPart {
public:
    /// At most `slots` readings may be in flight at a time. Throws vk::Error.
    HashCells(const vk::Device& device, const sim::Simulation& simulation, std::uint32_t slots);

    void record(VkCommandBuffer commands, std::size_t look, std::uint32_t slot) const noexcept override;
    LayerReading reading(std::uint32_t slot) const override;
    /// One entry for each grid of the solver, once the commands of that slot have finished.
    std::vector<GridFacts> grids(std::uint32_t slot) const;

    /// layout::CellMark; the marks of a grid start behind the capacity of `sorted` of the grid before.
    vk::BufferView marks() const noexcept { return marks_.view(); }

    /// Draws lines, one instance per cell.
    void draw(const LayerDrawing& to) const noexcept override;

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
