// Skins where they are cut, and what the cuts have laid open, for StateProbe: as much of it as there was the
// time before and some more, since how much there is now only the device knows.
#pragma once

#include "sim/simulation.hpp"
#include "viewer/hands/pick.hpp"
#include "vk/buffer.hpp"
#include "vk/commands.hpp"

#include <optional>

namespace sinew::viewer {

/// Must not outlive its Device, which must not move, nor the simulation. One recording at a time.
class CutProbe {
public:
    /// Of a simulation of this scene that has a surface of cuts.
    CutProbe(const vk::Device& device, const sim::Scene& scene, const sim::Simulation& simulation);

    /// After a barrier that follows recordSkin(). Without memory for it, it is as if nothing were cut.
    void record(vk::Commands& commands) noexcept;

    /// Of what was recorded, which must have finished: nothing where nothing is cut.
    std::optional<SeenCuts> seen() const noexcept;
    /// False where there was more than was copied: the next time all of it is.
    bool isComplete() const noexcept;

private:
    struct Room {
        vk::Buffer vertices, rest, indices;
    };
    // Of a skin that is no sheet, in all triangles.
    struct Range {
        vk::BufferView from, to;
    };
    sim::layout::SurfaceState counts() const noexcept;
    void makeRoom();

    const vk::Device& device_;
    const sim::Simulation& simulation_;
    vk::Buffer counts_, particles_, skins_; // triangles of sheets stay as they are uncut
    std::vector<Range> ranges_;
    std::optional<Room> room_;
    bool isThere_ = false; // in what was recorded
};

} // namespace sinew::viewer
