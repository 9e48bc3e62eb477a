// One kernel per grid; the marks of a grid follow those of the one before.
#include "viewer/draw/hash_cells.hpp"

#include "common/layout.h"
#include "sim/program/program.hpp"
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

VkDeviceSize roomOf(const sim::StepProgram& program) {
    VkDeviceSize room = 1; // buffers must not be empty
    for (const sim::GridBuffers& grid : program.grids) room += grid.count;
    return room;
}

} // namespace

HashCells::HashCells(const vk::Device& device, const sim::Simulation& simulation, std::uint32_t slots)
    : device_(device), marks_(device, {.name = "cells",
                                       .count = roomOf(simulation.program()),
                                       .stride = sizeof(layout::CellMark),
                                       .usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT}),
      draws_(device, {.name = "cells.draws",
                      .count = simulation.program().grids.size() + 1,
                      .stride = sizeof(layout::CellDraw),
                      .usage = VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT}),
      readings_(device, {.name = "cells.readings",
                         .count = slots * (simulation.program().grids.size() + 1),
                         .stride = sizeof(layout::CellDraw),
                         .kind = vk::MemoryKind::readback}),
      kernel_(device.kernels().get(device, shaders::markCells, {})), sets_(bindingSets(simulation)) {
    std::uint32_t first = 0;
    for (const sim::GridBuffers& grid : simulation.program().grids) {
        const auto index = static_cast<std::uint32_t>(grids_.size());
        grids_.push_back({shownName(grid.name), {grid.count, grid.cells, index, first}});
        first += grid.count;
    }
}

vk::BindingSets HashCells::bindingSets(const sim::Simulation& simulation) const {
    std::vector<vk::BindingRequest> requests;
    for (const sim::GridBuffers& grid : simulation.program().grids)
        requests.push_back({kernel_.get(),
                            {simulation.view(grid.bounds), simulation.view(grid.starts),
                             simulation.view(grid.sorted), marks_.view(), draws_.view()}});
    return {device_, requests};
}

void HashCells::record(VkCommandBuffer handle, std::uint32_t slot) const noexcept {
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

std::vector<GridFacts> HashCells::reading(std::uint32_t slot) const {
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

void HashCells::draw(VkCommandBuffer commands) const noexcept {
    const vk::DeviceFunctions& functions = device_.functions();
    const vk::BufferView marks = marks_.view(), draws = draws_.view();
    for (std::size_t g = 0; g < grids_.size(); ++g) {
        const VkDeviceSize first = marks.offset + grids_[g].push.first * sizeof(layout::CellMark);
        functions.vkCmdBindVertexBuffers(commands, 0, 1, &marks.buffer, &first);
        functions.vkCmdDrawIndirect(commands, draws.buffer, draws.offset + g * sizeof(layout::CellDraw), 1,
                                    sizeof(layout::CellDraw));
    }
}

} // namespace sinew::viewer
