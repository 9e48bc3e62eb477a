// Says what lies under the pointer, while that is asked for: a few times a second, from copies that frames
// bring along; nothing waits.
#pragma once

#include "sim/holds.hpp"
#include "viewer/draw/contact_marks.hpp"
#include "viewer/hands/found.hpp"
#include "viewer/hands/pick.hpp"

#include <chrono>
#include <functional>
#include <vector>

namespace sinew::viewer {

class Stage;
class StateProbe;

/// What a state says of a particle. `positions` and `velocities` of every particle, or no velocities.
/// `holds`: whether a link of the scene does (StateProbe::liveLinks).
Found foundAt(const sim::Scene& scene, std::uint32_t particle, std::span<const sim::layout::vec4> positions,
              std::span<const sim::layout::vec4> velocities, const std::function<bool(std::size_t)>& holds);

/// Must not outlive the stage, nor the holds of its scene.
class Inspector {
public:
    /// `slots` frames may be under way at a time.
    Inspector(const Stage& stage, std::span<const sim::NamedHold> holds, std::uint32_t slots);

    void toggle();
    bool isOn() const { return isOn_; }
    /// After the stage has another simulation.
    void restart();

    /// Whether a copy of the state is wanted to look where `ray` leads; says so at most ten times a second
    /// while nothing else changes.
    bool isDue(const Ray& ray) const;
    /// Of the state that is copied into the frame of `slot`, for `ray`. `counter` of contacts, null where
    /// there is none yet; settle() has the same one then.
    void record(VkCommandBuffer commands, std::uint32_t slot, const Ray& ray, const ContactMarks* counter);
    /// When that frame has finished.
    void settle(std::uint32_t slot, const BallList& balls, StateProbe& probe,
                const std::optional<Opened>& opened, const ContactMarks* counter);

    /// Nothing where it is off or where nothing is.
    const std::optional<Found>& found() const { return found_; }

private:
    using Clock = std::chrono::steady_clock;
    struct Asked {
        std::optional<Ray> ray;
        std::optional<std::uint32_t> counted; // the particle whose contacts are counted
    };

    const Stage& stage_;
    std::span<const sim::NamedHold> holds_;
    std::vector<Asked> asked_; // a slot
    std::optional<Ray> last_;
    std::optional<Found> found_;
    Clock::time_point lastTime_{};
    bool isOn_ = false;
};

} // namespace sinew::viewer
