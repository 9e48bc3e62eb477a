// What a show comes to need while it plays, made beside it: layers in a thread of their own. What a device
// uses for the first time is rehearsed, in submissions that no picture waits for: drivers of software devices
// compile it then, and hands are served meanwhile.
#pragma once

#include "viewer/hands/inspection.hpp"
#include "viewer/prepared_show.hpp"
#include "vk/queue.hpp"

#include <functional>
#include <future>
#include <optional>

namespace sinew::viewer {

/// One thread uses it, that which submits the pictures. Must not outlive device, stage and show.
class Backstage {
public:
    /// `slots` pictures may be under way at a time.
    Backstage(const vk::Device& device, PreparedShow& show, const Camera& camera, std::uint32_t slots);
    ~Backstage(); ///< waits for what is being made or rehearsed
    Backstage(const Backstage&) = delete;
    Backstage& operator=(const Backstage&) = delete;

    /// What of `wanted` is there to be recorded; begins to make the rest.
    Watched ready(const Watched& wanted);
    /// Rehearses and takes what is made, whether or not there are pictures. True where something is there
    /// that was not. Throws vk::Error where something cannot be made.
    bool goOn();
    /// Of what is ready.
    const Inspection& inspection() const { return inspection_; }
    /// Whether something is on its way that ready() has been asked for.
    bool isMaking() const { return making_.valid() || made_; }

    /// Submits what `record` records, for which no picture may be submitted until isBusy() says no more;
    /// `done` is called by that. One at a time.
    void rehearse(const std::function<void(VkCommandBuffer)>& record, std::function<void()> done = {});
    bool isBusy();

    /// Before the stage has another simulation: what was made of the one before goes, and what is rehearsed
    /// is done with. Waits.
    void forget();

private:
    // Pictures nobody sees, of a view.
    struct Unseen {
        Image image;
        Canvas canvas;
    };
    struct Made {
        Layers layers; // that it is made for
        Renderer::Additions moving, still;
        Inspection::Parts parts;
        std::optional<Unseen> ofMoving, ofStill; // where there are rehearsals
        std::size_t rehearsed = 0;               // of the parts, then of each addition
    };
    Made make(const Watched& wanted, const sim::Scene& scene) const;
    bool has(const Watched& watched) const noexcept;
    void rehearseNext();
    void add();

    const vk::Device& device_;
    PreparedShow& show_;
    const Camera camera_; // of rehearsals
    Inspection inspection_;
    std::uint32_t slots_;
    bool isRehearsing_;
    vk::Queue queue_;
    std::optional<std::uint64_t> running_; // submission
    std::function<void()> done_;
    std::optional<Made> made_;
    std::future<Made> making_;
};

} // namespace sinew::viewer
