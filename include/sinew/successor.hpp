// The simulation that takes over from the one that is stepped, for other settings, another material, another
// device or more room. It is made on a thread, while the other one goes on.
#pragma once

#include "sinew/export.hpp"
#include "sinew/simulation.hpp"

#include <functional>
#include <future>
#include <memory>
#include <stop_token>

namespace sinew::sim {

/// A simulation to be made.
struct SINEW_API SuccessorRequest {
    const vk::Device& device; ///< must outlive the simulation; may move
    /// Returns the scene. Called on the thread, once or, if another request came first, not at all. All that
    /// it refers to must outlive the Successor.
    std::function<Scene()> scene;
    Settings settings;
};

/// At most one simulation of a Successor exists at a time, finished or not. One thread uses it.
class SINEW_API Successor {
public:
    /// A finished simulation. Its state arrives with Simulation::recordTakeOver().
    struct Made {
        Scene scene;
        Settings settings;                      ///< those of the request
        std::unique_ptr<Simulation> simulation; ///< never null in what take() returns
    };

    Successor() = default;
    ~Successor(); ///< waits for the thread
    Successor(const Successor&) = delete;
    Successor& operator=(const Successor&) = delete;

    /// Begins to make a simulation. A former one that was not taken is destroyed first. Does not wait.
    void request(SuccessorRequest request);
    /// True from request() until take() or drop().
    bool isRequested() const noexcept { return making_.valid(); }
    /// True if take() would not wait. False if nothing was requested.
    bool isReady() const;
    /// Returns the simulation that was requested; waits for it. Throws what SuccessorRequest::scene or the
    /// constructor of Simulation threw. In both cases nothing is requested any more.
    Made take();
    /// Destroys the simulation that was requested, as soon as it is made. Does not wait.
    void drop();

private:
    std::future<Made> making_;
    std::future<void> destroying_; // what was dropped; valid only while nothing is requested
    std::stop_source stop_;        // of making_
};

} // namespace sinew::sim
