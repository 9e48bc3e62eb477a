// Reference for picking: tests every triangle and every ball on the host, from copies of the state. Shares no
// code with the kernels.
#pragma once

#include "sinew/simulation.hpp"
#include "viewer/input/pick.hpp"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace sinew::viewer {

/// The section of a picture; `isClosed`: see SceneLight::isClosed.
struct Opened {
    Section section;
    const std::vector<bool>& isClosed;
};

/// Cut skins and the surface of cuts, copied from the device.
struct SeenCuts {
    using Triangle = std::array<std::uint32_t, 3>;
    /// All skins, one behind the other; indices of the vertices of all. Sheets are uncut.
    std::span<const Triangle> skins;
    std::span<const Triangle> surface; ///< of sim::CutSurface
    std::span<const sim::layout::SkinVertex> vertices;
    std::span<const sim::layout::CutVertex> rest; ///< one per vertex
    std::span<const std::uint32_t> particles;     ///< by slot
};

/// A state copied from the device.
struct SeenState {
    std::span<const sim::layout::vec4> positions;
    std::span<const sim::layout::SkinVertex> vertices; ///< of all skins
    bool isWhole = false;                              ///< see sim::Simulation::DrawnSkins::areWhole
    std::optional<SeenCuts> cuts{};                    ///< empty if nothing is cut
    /// For every particle (see sim::Simulation::pieces()); empty if nothing can be cut.
    std::span<const std::uint32_t> pieces{};
};

/// Copies of the state for which recordSkin() was recorded. Waits.
class StateCopy {
public:
    StateCopy(const sim::Scene& scene, const sim::Simulation& simulation);
    SeenState seen() const;

private:
    std::vector<sim::layout::vec4> positions_;
    std::vector<sim::layout::SkinVertex> vertices_, cutVertices_;
    std::vector<std::uint32_t> pieces_, particles_, skins_, surface_;
    std::vector<sim::layout::CutVertex> rest_;
    std::size_t triangles_ = 0, cutVertexCount_ = 0;
    bool isWhole_ = false;
};

/// Casts the ray; empty if it meets no body, or only particles not asked for.
std::optional<Pick> pickOnHost(const sim::Scene& scene, const BallList& balls, const Ray& ray,
                               const SeenState& state, Among among = Among::moving,
                               const std::optional<Opened>& opened = {});

} // namespace sinew::viewer
