// Copies whole buffers: only the device knows how much of them is in use, and cuts are rare.
#include "viewer/input/piece_probe.hpp"

#include "app/drawn.hpp"
#include "sinew/vk/check.hpp"
#include "sinew/vk/commands.hpp"
#include "viewer/document/document.hpp"

#include <algorithm>
#include <cstring>

namespace sinew::viewer {

void PieceProbe::record(VkCommandBuffer handle) noexcept {
    try {
        if (copies_.empty())
            for (const vk::BufferView& view : app::topologyViews(document_.simulation(), document_.scene()))
                copies_.push_back({view, vk::Buffer(device_, {.name = "probe.triangles",
                                                              .count = view.size / view.stride,
                                                              .stride = view.stride,
                                                              .kind = vk::MemoryKind::readback})});
    } catch (const vk::Error&) {
        return copies_.clear();
    }
    vk::Commands commands(device_, handle);
    commands.barrier();
    for (const Copy& copy : copies_) commands.copy(copy.from, copy.to.view());
    commands.hostBarrier();
}

app::PieceCount PieceProbe::count(std::size_t all) const {
    const auto read = [this](const vk::BufferView& view, void* bytes) {
        const auto copy = std::ranges::find_if(copies_, [&](const Copy& one) {
            return one.from.buffer == view.buffer && one.from.offset == view.offset;
        });
        std::memcpy(bytes, copy->to.mapped(), view.size);
    };
    if (copies_.empty()) return {.isCounted = false};
    const sim::Scene& scene = document_.scene();
    return app::countPieces(
        scene, app::readTopology(read, document_.simulation(), scene, document_.settings()), all);
}

} // namespace sinew::viewer
