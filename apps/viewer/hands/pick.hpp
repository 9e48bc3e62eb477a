// Which particle lies under the pointer: the nearest one to where a ray meets a skin, or a ball.
#pragma once

#include "layout.h"
#include "viewer/draw/balls.hpp"
#include "viewer/draw/camera.hpp"
#include "viewer/draw/section.hpp"

namespace sinew::viewer {

struct Pick {
    std::uint32_t particle = 0;       ///< the nearest to the point
    Vector3 point = Vector3::Zero();  ///< where the ray meets what is seen [m]
    Vector3 offset = Vector3::Zero(); ///< of that point from the particle [m]
    float distance = 0;               ///< along the ray [m]
    bool operator==(const Pick&) const = default;
};

/// Whether what is fixed may be the nearest particle.
enum class Among { moving, all };

/// What a tool asks of the state on show: what lies there. A preview is for the eye alone.
struct Question {
    enum class Asker { hand, pin, poke, blade, preview } asker = Asker::hand;
    Ray ray;
    /// Particles that are fixed can be cut, not grabbed or poked; N says that they are held.
    Among among() const { return asker == Asker::hand || asker == Asker::poke ? Among::moving : Among::all; }
    bool operator==(const Question&) const = default;
};

/// What a section leaves of a picture; `isClosed` as StageLight::isClosed.
struct Opened {
    Section section;
    const std::vector<bool>& isClosed;
};

/// What cuts have made of skins, and what they have laid open, as CutProbe reads it.
struct SeenCuts {
    using Triangle = std::array<std::uint32_t, 3>;
    /// Of skins one behind the other, into the vertices of all; of sheets as they are uncut.
    std::span<const Triangle> skins;
    std::span<const Triangle> surface; ///< of sim::CutSurface
    std::span<const sim::layout::SkinVertex> vertices;
    std::span<const sim::layout::CutVertex> rest; ///< of each vertex
    std::span<const std::uint32_t> particles;     ///< by slot
};

/// A state as StateProbe reads it.
struct SeenState {
    std::span<const sim::layout::vec4> positions;
    std::span<const sim::layout::SkinVertex> vertices; ///< of all skins
    bool isWhole = false;                              ///< sim::Simulation::DrawnSkins::areWhole
    std::optional<SeenCuts> cuts{};                    ///< nothing where nothing is cut
    /// Of every particle, sim::Simulation::pieces(); empty where nothing can be cut.
    std::span<const std::uint32_t> pieces{};
};

/// Whether it is part of a crumb, of which nothing is seen.
bool isRemoved(std::span<const std::uint32_t> pieces, std::uint32_t particle);

/// Nothing where the ray meets no body, or only what is not asked for. Of a section, what is cut away is not
/// met, the inside that it has laid open is. The particle is one of those that what is met hangs on, on its
/// side of a cut.
std::optional<Pick> pick(const sim::Scene& scene, const BallList& balls, const Ray& ray,
                         const SeenState& state, Among among = Among::moving,
                         const std::optional<Opened>& opened = {});

/// Which one a particle is of; one of no particles where none holds it.
sim::Body bodyOf(const sim::Scene& scene, std::uint32_t particle);

/// How far around a picked particle a hand takes hold [m]: an eighth of the size of its body at the start,
/// but more than its next neighbours are away.
float holdRadius(const sim::Scene& scene, std::uint32_t particle);

} // namespace sinew::viewer
