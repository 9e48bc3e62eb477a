// Copies of cut skins and of the surface of cuts, for StateProbe. Only the device knows how much there is
// now, so a copy takes as much as the last time and some more.
#pragma once

#include "sinew/simulation.hpp"
#include "sinew/vk/buffer.hpp"
#include "sinew/vk/commands.hpp"
#include "viewer/hands/pick.hpp"

#include <optional>

namespace sinew::viewer {

/// Must not outlive its Device, which must not move, nor the simulation. One recording at a time.
class CutProbe {
public:
    /// The simulation must be of this scene and have a surface of cuts.
    CutProbe(const vk::Device& device, const sim::Scene& scene, const sim::Simulation& simulation);

    /// Record after a barrier that follows recordSkin(). Without memory, the result is as if nothing were
    /// cut.
    void record(vk::Commands& commands) noexcept;

    /// Result of the last recording, which must have finished; empty if nothing is cut.
    std::optional<SeenCuts> seen() const noexcept;
    /// False if there was more than was copied; the next recording copies all of it.
    bool isComplete() const noexcept;

private:
    struct Room {
        vk::Buffer vertices, rest, indices;
    };
    // All triangles of a skin that is no sheet.
    struct Range {
        vk::BufferView from, to;
    };
    sim::layout::SurfaceState counts() const noexcept;
    void makeRoom();

    const vk::Device& device_;
    const sim::Simulation& simulation_;
    vk::Buffer counts_, particles_, skins_; // triangles of sheets stay uncut
    std::vector<Range> ranges_;
    std::optional<Room> room_;
    bool isThere_ = false; // in the last recording
};

} // namespace sinew::viewer
