// Background maker of layers for a scene player. A thread of its own makes the buffers and pipelines that
// layers need. The first use of each on a device is a rehearsal: a submission that no picture waits for,
// because drivers of software devices compile at the first use. Input is handled meanwhile.
#pragma once

#include "sinew/vk/queue.hpp"
#include "viewer/jobs/prepared_player.hpp"
#include "viewer/layers/inspection.hpp"

#include <functional>
#include <future>
#include <optional>

namespace sinew::viewer {

/// Used by one thread, the one that submits pictures. Must not outlive device, document and show.
class LayerLoader {
public:
    /// At most `slots` pictures may be in flight at a time.
    LayerLoader(const vk::Device& device, PreparedPlayer& player, const Camera& camera, std::uint32_t slots);
    ~LayerLoader(); ///< waits for the layers in the making and for the rehearsal
    LayerLoader(const LayerLoader&) = delete;
    LayerLoader& operator=(const LayerLoader&) = delete;

    /// Returns the part of `wanted` that can be recorded now, and begins to make the rest.
    WantedLayers ready(const WantedLayers& wanted);
    /// Continues rehearsals and adopts finished layers; needs no pictures. Returns true if a layer became
    /// ready. Throws vk::Error if a layer cannot be made.
    bool goOn();
    /// Buffers of the layers that are ready.
    const Inspection& inspection() const { return inspection_; }
    /// Whether a layer that ready() was asked for is still being made.
    bool isMaking() const { return making_.valid() || made_; }

    /// Submits the commands that `record` records. No picture may be submitted until isBusy() returns false;
    /// isBusy() then calls `done`. One rehearsal at a time.
    void rehearse(const std::function<void(VkCommandBuffer)>& record, std::function<void()> done = {});
    bool isBusy();

    /// Call before the document changes its simulation: drops the layers of the old one and finishes
    /// rehearsals. Waits.
    void forget();

private:
    // An off-screen image of a view, for rehearsals.
    struct Unseen {
        Image image;
        Canvas canvas;
    };
    struct Made {
        Layers layers; // layers that it is made for
        Renderer::Additions moving, still;
        Inspection::Parts parts;
        std::optional<Unseen> ofMoving, ofStill; // for views that are rehearsed
        std::size_t rehearsed = 0;               // count: the parts, then each addition
    };
    Made make(const WantedLayers& wanted, const sim::Scene& scene) const;
    bool has(const WantedLayers& watched) const noexcept;
    void rehearseNext();
    void add();

    const vk::Device& device_;
    PreparedPlayer& player_;
    const Camera camera_; // for rehearsals
    Inspection inspection_;
    std::uint32_t slots_;
    bool isRehearsing_;
    vk::Queue queue_;
    std::optional<std::uint64_t> running_; // submission value
    std::function<void()> done_;
    std::optional<Made> made_;
    std::future<Made> making_;
};

} // namespace sinew::viewer
