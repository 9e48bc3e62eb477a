// Copies into mapped memory, which grows.
#include "viewer/hands/cut_probe.hpp"

#include "sinew/vk/check.hpp"

#include <algorithm>
#include <cstring>

namespace sinew::viewer {

namespace {

constexpr VkDeviceSize some = 4096; // vertices, triangles: more than most cuts add in a picture

using Triangle = SeenCuts::Triangle;

vk::Buffer readback(const vk::Device& device, const char* name, VkDeviceSize count, std::uint32_t stride) {
    return {device, {.name = name, .count = count, .stride = stride, .kind = vk::MemoryKind::readback}};
}

// Sheets: their pieces are not in the surface of cuts.
bool isSheet(const sim::Scene& scene, const sim::Skin& skin) {
    if (skin.particles.empty()) return false;
    const std::uint32_t one = skin.particles.front();
    return std::ranges::any_of(scene.grids, [&](const sim::Grid& grid) {
        return one - grid.firstParticle < grid.node.size() && grid.nodes[1] == 1;
    });
}

VkDeviceSize countOf(const vk::BufferView& view) {
    return view.size / view.stride;
}

template <typename Value> std::span<const Value> valuesOf(const vk::Buffer& buffer, std::size_t count) {
    return {reinterpret_cast<const Value*>(buffer.mapped()), count};
}

} // namespace

CutProbe::CutProbe(const vk::Device& device, const sim::Scene& scene, const sim::Simulation& simulation)
    : device_(device), simulation_(simulation),
      counts_(readback(device, "probe.cut_counts", 1, sizeof(sim::layout::SurfaceState))),
      particles_(readback(device, "probe.cut_particles", countOf(simulation.cutSurface().particles), 4)),
      skins_(readback(device, "probe.cut_skins", countOf(simulation.skinIndices()), 4)) {
    std::memset(counts_.mapped(), 0, sizeof(sim::layout::SurfaceState));
    const vk::BufferView all = simulation.skinIndices();
    VkDeviceSize offset = 0;
    std::uint32_t firstVertex = 0;
    for (std::size_t s = 0; s < scene.skins.size(); ++s) {
        const sim::Skin& skin = scene.skins[s];
        const VkDeviceSize size = skin.triangles.size() * sizeof(Triangle);
        if (isSheet(scene, skin)) {
            auto* corners = reinterpret_cast<std::uint32_t*>(skins_.mapped() + offset);
            for (const Triangle& triangle : skin.triangles)
                for (const std::uint32_t corner : triangle) *corners++ = firstVertex + corner;
        } else if (size > 0) {
            const VkDeviceSize first = 4 * VkDeviceSize{simulation.skins()[s].firstIndex};
            ranges_.push_back(
                {{all.buffer, all.offset + first, size, 4}, {skins_.view().buffer, offset, size, 4}});
        }
        offset += size;
        firstVertex += static_cast<std::uint32_t>(skin.vertexCount());
    }
}

sim::layout::SurfaceState CutProbe::counts() const noexcept {
    sim::layout::SurfaceState counts;
    std::memcpy(&counts, counts_.mapped(), sizeof counts);
    return counts;
}

// Allocates for half as much again as the last time.
void CutProbe::makeRoom() {
    const sim::CutSurface surface = simulation_.cutSurface();
    const sim::layout::SurfaceState last = counts();
    const auto enough = [](VkDeviceSize count, const vk::BufferView& of, VkDeviceSize each) {
        return std::min(count + count / 2 + some, countOf(of) / each);
    };
    const VkDeviceSize vertices = enough(last.points + VkDeviceSize{3} * last.outside, surface.vertices, 1);
    const VkDeviceSize triangles = enough(VkDeviceSize{last.inside} + last.outside, surface.indices, 3);
    if (room_ && room_->vertices.count() >= vertices && room_->indices.count() >= 3 * triangles) return;
    room_.reset();
    room_.emplace(Room{readback(device_, "probe.cut_vertices", vertices, sizeof(sim::layout::SkinVertex)),
                       readback(device_, "probe.cut_rest", vertices, sizeof(sim::layout::CutVertex)),
                       readback(device_, "probe.cut_indices", 3 * triangles, 4)});
}

void CutProbe::record(vk::Commands& commands) noexcept {
    isThere_ = !simulation_.drawnSkins().areWhole;
    if (!isThere_) return;
    try {
        makeRoom();
    } catch (const vk::Error&) {
        isThere_ = false;
        return;
    }
    const auto copy = [&](const vk::BufferView& from, const vk::Buffer& to) {
        const vk::BufferView all = to.view();
        commands.copy({from.buffer, from.offset, all.size, from.stride}, all);
    };
    const sim::CutSurface surface = simulation_.cutSurface();
    copy(surface.counts, counts_);
    copy(surface.particles, particles_);
    copy(surface.vertices, room_->vertices);
    copy(surface.rest, room_->rest);
    copy(surface.indices, room_->indices);
    for (const Range& range : ranges_) commands.copy(range.from, range.to);
}

bool CutProbe::isComplete() const noexcept {
    if (!isThere_) return true;
    const sim::layout::SurfaceState now = counts();
    return now.points + VkDeviceSize{3} * now.outside <= room_->vertices.count() &&
           3 * (VkDeviceSize{now.inside} + now.outside) <= room_->indices.count();
}

std::optional<SeenCuts> CutProbe::seen() const noexcept {
    const sim::layout::SurfaceState now = counts();
    const std::size_t triangles = now.inside + std::size_t{now.outside};
    if (!isThere_ || triangles == 0 || !isComplete()) return std::nullopt;
    const std::size_t vertices = now.points + std::size_t{3} * now.outside;
    return SeenCuts{
        .skins = valuesOf<Triangle>(skins_, skins_.count() / 3),
        .surface = valuesOf<Triangle>(room_->indices, triangles),
        .vertices = valuesOf<sim::layout::SkinVertex>(room_->vertices, vertices),
        .rest = valuesOf<sim::layout::CutVertex>(room_->rest, vertices),
        .particles = valuesOf<std::uint32_t>(particles_, particles_.count()),
    };
}

} // namespace sinew::viewer
