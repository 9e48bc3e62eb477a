// Picking: the particle nearest to the point where a ray meets a skin or a ball.
#pragma once

#include "common/layout.h"
#include "viewer/draw/balls.hpp"
#include "viewer/draw/camera.hpp"
#include "viewer/draw/section.hpp"

namespace sinew::viewer {

struct Pick {
    std::uint32_t particle = 0;       ///< nearest to the point
    Vector3 point = Vector3::Zero();  ///< where the ray meets a skin, ball or cut [m]
    Vector3 offset = Vector3::Zero(); ///< from the particle to the point [m]
    float distance = 0;               ///< along the ray [m]
    bool operator==(const Pick&) const = default;
};

/// Whether fixed particles may be picked.
enum class Among { moving, all };

/// A pick that a tool asks for. A preview is only drawn.
struct Question {
    enum class Asker { hand, pin, poke, blade, preview } asker = Asker::hand;
    Ray ray;
    /// Fixed particles can be cut or pinned, not grabbed or poked; the key N reports that they are held.
    Among among() const { return asker == Asker::hand || asker == Asker::poke ? Among::moving : Among::all; }
    bool operator==(const Question&) const = default;
};

/// The section of a picture; `isClosed`: see StageLight::isClosed.
struct Opened {
    Section section;
    const std::vector<bool>& isClosed;
};

/// Cut skins and the surface of cuts, as CutProbe reads them.
struct SeenCuts {
    using Triangle = std::array<std::uint32_t, 3>;
    /// All skins, one behind the other; indices of the vertices of all. Sheets are uncut.
    std::span<const Triangle> skins;
    std::span<const Triangle> surface; ///< of sim::CutSurface
    std::span<const sim::layout::SkinVertex> vertices;
    std::span<const sim::layout::CutVertex> rest; ///< one per vertex
    std::span<const std::uint32_t> particles;     ///< by slot
};

/// A state as StateProbe reads it.
struct SeenState {
    std::span<const sim::layout::vec4> positions;
    std::span<const sim::layout::SkinVertex> vertices; ///< of all skins
    bool isWhole = false;                              ///< see sim::Simulation::DrawnSkins::areWhole
    std::optional<SeenCuts> cuts{};                    ///< empty if nothing is cut
    /// For every particle (see sim::Simulation::pieces()); empty if nothing can be cut.
    std::span<const std::uint32_t> pieces{};
};

/// Whether the particle is part of a removed fragment, which is not drawn.
bool isRemoved(std::span<const std::uint32_t> pieces, std::uint32_t particle);

/// Casts the ray; empty if it meets no body, or only particles not asked for. With a section, the ray passes
/// the hidden side and meets the opened inside. The particle is one that the hit triangle depends on, on its
/// side of a cut.
std::optional<Pick> pick(const sim::Scene& scene, const BallList& balls, const Ray& ray,
                         const SeenState& state, Among among = Among::moving,
                         const std::optional<Opened>& opened = {});

/// The body that holds a particle; a body without particles if none does.
sim::Body bodyOf(const sim::Scene& scene, std::uint32_t particle);

/// Radius of a grab around a picked particle [m]: an eighth of the size of its body at the start, but more
/// than the distance to its next neighbours.
float holdRadius(const sim::Scene& scene, std::uint32_t particle);

} // namespace sinew::viewer
