// What is drawn of a scene, read back, triangle by triangle: what is left of skins, what stands for them
// beside cuts, and the inside. For whoever exports or measures it.
#pragma once

#include "app/piece_count.hpp"
#include "common/layout.h"
#include "sinew/simulation.hpp"
#include "sinew/vk/queue.hpp"

#include <functional>

namespace sinew::app {

/// What the device has of skins and of the surface of cuts, after recordSkin(); lists are empty where a scene
/// has none of it.
struct Drawn {
    std::vector<sim::layout::SkinVertex> skinVertices, vertices;
    std::vector<std::uint32_t> skinIndices, indices;
    std::vector<sim::layout::CutVertex> rest;
    std::vector<sim::layout::DrawArguments> draws, pieceDraws; // of the surface; by skin
    std::vector<std::uint32_t> sheetSlots; ///< by skin vertex: of those that sheets fall into, a slot
    std::vector<std::uint32_t> pieces;     ///< by particle, as Simulation::pieces()
    std::vector<std::uint32_t> slotPieces; ///< the same by slot of the solver's state
    std::vector<bool> isThinned;           ///< by skin: triangles of it have shrunk to a point
};

/// `scene` and `settings` are those of `simulation`. Waits for `queue`.
Drawn downloadDrawn(vk::Queue& queue, const sim::Simulation& simulation, const sim::Scene& scene,
                    const sim::Settings& settings);

/// The triangles that are drawn, without vertices: enough for everything below. The copies of topologyViews()
/// come from `read`, which writes all bytes of a view to the address.
using ReadView = std::function<void(const vk::BufferView& view, void* bytes)>;
Drawn readTopology(const ReadView& read, const sim::Simulation& simulation, const sim::Scene& scene,
                   const sim::Settings& settings);
std::vector<vk::BufferView> topologyViews(const sim::Simulation& simulation, const sim::Scene& scene);

/// One of a skin. Its corners are vertices of the skin, or of the surface of cuts.
struct DrawnTriangle {
    enum class Part { skin, ofSheet, beside, inside };
    Part part = Part::skin;
    std::uint32_t piece = 0; ///< one number a piece; the same for all where nothing of the body may be cut
    std::array<std::uint32_t, 3> corners{};
    /// Whether the corners are vertices of the surface of cuts.
    bool isOfSurface() const { return part == Part::beside || part == Part::inside; }
};

/// All of skin `index` but those that have shrunk to a point, and those of debris (Scene::debris), in the
/// order in which they are drawn.
void eachTriangle(const sim::Scene& scene, std::size_t index, const Drawn& drawn,
                  const std::function<void(const DrawnTriangle&)>& use);

/// How many pieces of bodies that may be cut have a surface, as meshes count them: others are fragments, of
/// particles that stand outside the body's skin. Of a skin that no cut clips, those that it hangs on.
std::size_t piecesWithSurface(const sim::Scene& scene, const Drawn& drawn);

/// `all` is sim::Status::pieces of the same step.
PieceCount countPieces(const sim::Scene& scene, const Drawn& drawn, std::size_t all);

/// Whether something else is drawn of that skin than the skin itself.
bool isCut(std::size_t index, const Drawn& drawn);

} // namespace sinew::app
