// One kernel per grid; the marks of a grid follow those of the one before.
#include "viewer/layers/hash_cells.hpp"

#include "common/layout.h"
#include "sinew/inspection.hpp"
#include "viewer/render/length_text.hpp"
#include "viewer_shaders.hpp"

#include <algorithm>
#include <cstring>

namespace sinew::viewer {

namespace {

constexpr std::uint32_t cornersOfEdges = 24;

std::string shownName(const std::string& name) {
    if (name == "faces.grid") return "points near faces";
    return name == "edges.grid" ? "edges" : "particles";
}

VkDeviceSize roomOf(const sim::Simulation& simulation) {
    VkDeviceSize room = 1; // buffers must not be empty
    for (const sim::InspectedGrid& grid : sim::inspect(simulation).grids) room += grid.count;
    return room;
}

constexpr VkVertexInputBindingDescription binding{0, sizeof(layout::CellMark), VK_VERTEX_INPUT_RATE_INSTANCE};
constexpr std::array attributes{
    VkVertexInputAttributeDescription{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(layout::CellMark, low)},
    VkVertexInputAttributeDescription{1, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(layout::CellMark, held)}};

PipelineRequest cellPipeline() {
    return {.name = "cells",
            .vertex = &shaders::cellVert,
            .fragment = &shaders::cellFrag,
            .input = PipelineRequest::Input::own,
            .vertices = {{&binding, 1}, attributes},
            .depth = PipelineRequest::Depth::testAndWrite,
            .topology = VK_PRIMITIVE_TOPOLOGY_LINE_LIST};
}

// A bar of colors from one item to the fullest cell, for all grids, and the counts of each.
std::vector<LegendLine> cellLegend(std::span<const GridFacts> grids) {
    using enum LegendLine::Kind;
    constexpr std::array<float, 3> sharedColor{0.79f, 0.0f, 0.21f}; // cell.vert
    if (grids.empty()) return {{text, "no hash grid: the scene has no contacts that need one"}};
    std::uint32_t most = 0, shared = 0;
    for (const GridFacts& grid : grids) {
        most = std::max(most, grid.most);
        shared += grid.shared;
    }
    if (most == 0) return {{text, "no step has been taken yet: the grids are empty"}};
    std::vector<LegendLine> legend{{bar}, {row, "items in a cell, from 0", grouped(most)}};
    for (const GridFacts& grid : grids) {
        legend.push_back({row, grid.name + ", cells of " + lengthText(grid.edge), grouped(grid.cells)});
        legend.push_back({row, "  items / slots", grouped(grid.held) + " / " + grouped(grid.slots)});
    }
    if (shared > 0) legend.push_back({swatch, "cells that share a slot", grouped(shared), {sharedColor}});
    return legend;
}

constexpr std::array<Layer::Look, 1> looks{{{"cells", "Cells"}}};

} // namespace

constinit const Layer layer::cells{.key = '6',
                                   .help = "cells of the hash grids that are not empty, colored by count",
                                   .button = "Cells",
                                   .looks = looks,
                                   .make = [](const LayerContext& of) -> std::unique_ptr<const LayerPart> {
                                       return std::make_unique<const HashCells>(of.device, of.simulation,
                                                                                of.slots);
                                   },
                                   .pipeline = cellPipeline,
                                   .opened = &shaders::cellSectionFrag,
                                   .hasRange = true};

HashCells::HashCells(const vk::Device& device, const sim::Simulation& simulation, std::uint32_t slots)
    : device_(device), marks_(device, {.name = "cells",
                                       .count = roomOf(simulation),
                                       .stride = sizeof(layout::CellMark),
                                       .usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT}),
      draws_(device, {.name = "cells.draws",
                      .count = sim::inspect(simulation).grids.size() + 1,
                      .stride = sizeof(layout::CellDraw),
                      .usage = VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT}),
      readings_(device, {.name = "cells.readings",
                         .count = slots * (sim::inspect(simulation).grids.size() + 1),
                         .stride = sizeof(layout::CellDraw),
                         .kind = vk::MemoryKind::readback}),
      kernel_(device.kernels().get(device, shaders::markCells, {})), sets_(bindingSets(simulation)) {
    std::uint32_t first = 0;
    for (const sim::InspectedGrid& grid : sim::inspect(simulation).grids) {
        const auto index = static_cast<std::uint32_t>(grids_.size());
        grids_.push_back({shownName(grid.name), {grid.count, grid.cells, index, first}});
        first += grid.count;
    }
}

vk::BindingSets HashCells::bindingSets(const sim::Simulation& simulation) const {
    std::vector<vk::BindingRequest> requests;
    for (const sim::InspectedGrid& grid : sim::inspect(simulation).grids)
        requests.push_back(
            {kernel_.get(), {grid.bounds, grid.starts, grid.sorted, marks_.view(), draws_.view()}});
    return {device_, requests};
}

void HashCells::record(VkCommandBuffer handle, std::size_t, std::uint32_t slot) const noexcept {
    const vk::BufferView all = draws_.view();
    vk::BufferView read = readings_.view();
    read.size = all.size;
    read.offset += slot * all.size;
    vk::Commands commands(device_, handle);
    commands.beginLabel("cells");
    commands.beginStep();
    commands.fill(all, 0);
    commands.barrier();
    for (std::size_t g = 0; g < grids_.size(); ++g) {
        vk::BufferView corners = all;
        corners.offset += g * sizeof(layout::CellDraw);
        corners.size = sizeof cornersOfEdges;
        commands.update(corners, &cornersOfEdges, sizeof cornersOfEdges);
    }
    for (std::size_t g = 0; g < grids_.size(); ++g) {
        commands.barrier();
        commands.bind(*kernel_, sets_[g]);
        commands.push(*kernel_, &grids_[g].push, sizeof(layout::CellPush));
        commands.dispatch((grids_[g].push.count + GROUP_ITEMS - 1) / GROUP_ITEMS);
    }
    commands.barrier();
    commands.copy(all, read);
    commands.endStep();
    commands.hostBarrier();
    commands.endLabel();
}

LayerReading HashCells::reading(std::uint32_t slot) const {
    const std::vector<GridFacts> all = grids(slot);
    LayerReading reading{.legend = cellLegend(all)};
    for (const GridFacts& grid : all)
        reading.values.range = std::max(reading.values.range, static_cast<float>(grid.most));
    if (all.empty()) reading.note = "this scene has no hash grid: no cells are drawn";
    return reading;
}

std::vector<GridFacts> HashCells::grids(std::uint32_t slot) const {
    std::vector<GridFacts> facts;
    for (std::size_t g = 0; g < grids_.size(); ++g) {
        layout::CellDraw draw;
        std::memcpy(&draw, readings_.mapped() + slot * draws_.view().size + g * sizeof draw, sizeof draw);
        facts.push_back({.name = grids_[g].name,
                         .edge = draw.edge,
                         .cells = draw.instanceCount,
                         .shared = draw.sharing,
                         .most = draw.most,
                         .held = draw.held,
                         .slots = grids_[g].push.cells});
    }
    return facts;
}

void HashCells::draw(const LayerDrawing& to) const noexcept {
    to.push({{to.range}, {}, {}});
    const vk::DeviceFunctions& functions = device_.functions();
    const vk::BufferView marks = marks_.view(), draws = draws_.view();
    for (std::size_t g = 0; g < grids_.size(); ++g) {
        const VkDeviceSize first = marks.offset + grids_[g].push.first * sizeof(layout::CellMark);
        functions.vkCmdBindVertexBuffers(to.commands, 0, 1, &marks.buffer, &first);
        functions.vkCmdDrawIndirect(to.commands, draws.buffer, draws.offset + g * sizeof(layout::CellDraw), 1,
                                    sizeof(layout::CellDraw));
    }
}

} // namespace sinew::viewer
