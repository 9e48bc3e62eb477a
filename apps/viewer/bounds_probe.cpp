// A copy of the positions in mapped memory.
#include "viewer/bounds_probe.hpp"

#include "vk/commands.hpp"

namespace sinew::viewer {

BoundsProbe::BoundsProbe(const vk::Device& device, const vk::BufferView& positions)
    : device_(device), positions_(positions), readback_(device, {.name = "bounds.readback",
                                                                 .count = positions.size / positions.stride,
                                                                 .stride = positions.stride,
                                                                 .kind = vk::MemoryKind::readback}) {}

void BoundsProbe::record(VkCommandBuffer handle) const noexcept {
    vk::Commands commands(device_, handle);
    commands.copy(positions_, readback_.view());
    commands.hostBarrier();
}

Box BoundsProbe::read() const {
    const auto* positions = reinterpret_cast<const float*>(readback_.mapped());
    Box box;
    for (std::size_t i = 0; i < readback_.count(); ++i) {
        const Vector3 position(positions + 4 * i);
        if (position.allFinite()) box.extend(position);
    }
    return box;
}

} // namespace sinew::viewer
