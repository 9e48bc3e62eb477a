// Counts the pieces that cuts have made, like reports do, from copies that a picture brings along.
#pragma once

#include "app/piece_count.hpp"
#include "sinew/vk/buffer.hpp"

#include <vector>

namespace sinew::viewer {

class Document;

/// Must not outlive its Device, which must not move, nor the document. One recording at a time.
class PieceProbe {
public:
    PieceProbe(const vk::Device& device, const Document& document) : device_(device), document_(document) {}

    /// Call after the document changed its simulation: drops the copies.
    void restart() noexcept { copies_.clear(); }
    /// Records the copies; call it after recordSkin() of the simulation. Allocates at the first use; without
    /// memory it records nothing.
    void record(VkCommandBuffer commands) noexcept;
    /// Counts the pieces in the last recorded copy, which must have finished. `all` is sim::Status::pieces of
    /// its newest step. PieceCount::isCounted is false if nothing was recorded.
    app::PieceCount count(std::size_t all) const;

private:
    struct Copy {
        vk::BufferView from;
        vk::Buffer to;
    };
    const vk::Device& device_;
    const Document& document_;
    std::vector<Copy> copies_;
};

} // namespace sinew::viewer
