// Inspector of the particle under the pointer, while it is on: a few times a second, from copies of the state
// that frames bring along, without waiting.
#pragma once

#include "sinew/holds.hpp"
#include "viewer/input/found.hpp"
#include "viewer/input/pick.hpp"
#include "viewer/layers/contact_marks.hpp"

#include <chrono>
#include <functional>
#include <vector>

namespace sinew::viewer {

class Document;
class StateProbe;

/// Properties of a particle in a state. `positions` and `velocities` of every particle; velocities may be
/// empty. `holds`: whether a link of the scene is live (StateProbe::liveLinks).
Found foundAt(const sim::Scene& scene, std::uint32_t particle, std::span<const sim::layout::vec4> positions,
              std::span<const sim::layout::vec4> velocities, const std::function<bool(std::size_t)>& holds);

/// Must not outlive the document, nor the holds of its scene.
class Inspector {
public:
    /// At most `slots` frames may be in flight at a time.
    Inspector(const Document& document, std::span<const sim::NamedHold> holds, std::uint32_t slots);

    void toggle();
    bool isOn() const { return isOn_; }
    /// Call after the document changed its simulation.
    void restart();

    /// Whether a copy of the state is needed for `ray`; true at most ten times a second while nothing else
    /// changes.
    bool isDue(const Ray& ray) const;
    /// Records into the frame of `slot`, which also copies the state. `counter` of contacts may be null;
    /// settle() must get the same one.
    void record(VkCommandBuffer commands, std::uint32_t slot, const Ray& ray, const ContactMarks* counter);
    /// Call when that frame has finished.
    /// `met`: what the ray met.
    void settle(std::uint32_t slot, const std::optional<Pick>& met, StateProbe& probe,
                const ContactMarks* counter);

    /// Empty if the inspector is off or nothing was hit.
    const std::optional<Found>& found() const { return found_; }

private:
    using Clock = std::chrono::steady_clock;
    struct Asked {
        std::optional<Ray> ray;
        std::optional<std::uint32_t> counted; // particle whose contacts are counted
    };

    const Document& document_;
    std::span<const sim::NamedHold> holds_;
    std::vector<Asked> asked_; // one per slot
    std::optional<Ray> last_;
    std::optional<Found> found_;
    Clock::time_point lastTime_{};
    bool isOn_ = false;
};

} // namespace sinew::viewer
