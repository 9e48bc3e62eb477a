// A vertex of the surface of a cut goes with the first corner that it hangs on; one of a skin with its
// particle or anchor. All three vertices of a triangle go with the same piece.
#include "app/drawn.hpp"

#include "sim/compile/compile.hpp"
#include "sim/core/counted.hpp"

#include <algorithm>
#include <set>

namespace sinew::app {

namespace {

using Corners = std::array<std::uint32_t, 3>;
using Part = DrawnTriangle::Part;

template <typename T> std::vector<T> elementsOf(const ReadView& read, const vk::BufferView& view) {
    std::vector<T> elements(static_cast<std::size_t>(view.size / sizeof(T)));
    read(view, elements.data());
    return elements;
}

bool haveSurface(const sim::Simulation& simulation, const sim::Scene& scene) {
    return simulation.pieces().size > 0 && !scene.skins.empty();
}

void readPieces(const ReadView& read, const sim::Simulation& simulation, const sim::Scene& scene,
                const sim::Settings& settings, Drawn& drawn) {
    const sim::StateLayout layout = sim::stateLayout(scene, settings);
    drawn.pieces = elementsOf<std::uint32_t>(read, simulation.pieces());
    drawn.slotPieces.assign(layout.count, NO_PARTICLE);
    for (std::size_t i = 0; i < layout.slot.size(); ++i) drawn.slotPieces[layout.slot[i]] = drawn.pieces[i];
}

void readSheets(const ReadView& read, const sim::Simulation& simulation, Drawn& drawn) {
    const vk::BufferView all = simulation.skinVertices();
    drawn.pieceDraws = elementsOf<sim::layout::DrawArguments>(read, simulation.pieceDraws());
    drawn.sheetSlots.assign(all.size / all.stride, NO_PARTICLE);
    for (const sim::PieceVertices& pieces : simulation.program().pieceSkins) {
        const auto vertices = elementsOf<sim::layout::SheetVertex>(read, simulation.view(pieces.vertices));
        std::ranges::transform(vertices, drawn.sheetSlots.begin() + pieces.first,
                               &sim::layout::SheetVertex::a);
    }
}

void findThinned(const sim::Scene& scene, Drawn& drawn) {
    std::size_t index = 0;
    for (const sim::Skin& skin : scene.skins) {
        bool isThinned = false;
        for (std::size_t t = 0; t < skin.triangles.size(); ++t, index += 3)
            isThinned = isThinned || drawn.skinIndices[index] == drawn.skinIndices[index + 1];
        drawn.isThinned.push_back(isThinned);
    }
}

class Walk {
public:
    Walk(const sim::Scene& scene, std::size_t index, const Drawn& drawn,
         const std::function<void(const DrawnTriangle&)>& use)
        : skin_(scene.skins[index]), drawn_(drawn), use_(use) {
        for (std::size_t s = 0; s < index; ++s) {
            firstVertex_ += static_cast<std::uint32_t>(scene.skins[s].vertexCount());
            firstIndex_ += 3 * scene.skins[s].triangles.size();
        }
        walkSurface(static_cast<float>(index));
        walkSkin();
        if (index < drawn.pieceDraws.size()) walkSheet(drawn.pieceDraws[index]);
    }

private:
    void walkSurface(float mine) {
        for (std::size_t d = 0; d < drawn_.draws.size(); ++d)
            for (std::uint32_t t = 0; t < drawn_.draws[d].indexCount / 3; ++t) {
                const Corners corners =
                    cornersAt(drawn_.indices, drawn_.draws[d].firstIndex + 3 * std::size_t{t});
                const sim::layout::CutVertex& first = drawn_.rest[corners[0]];
                if (first.rest.w != mine) continue;
                const bool isOfSkin = (first.point & (SURFACE_SKIN | SURFACE_PARTICLE)) == SURFACE_SKIN;
                give({d == 0 ? Part::inside : Part::beside,
                      isOfSkin ? pieceOf(first.point & ~SURFACE_SKIN) : drawn_.slotPieces[first.corners[0]],
                      corners});
            }
    }

    void walkSkin() {
        for (std::size_t t = 0; t < skin_.triangles.size(); ++t) {
            Corners corners = skin_.triangles[t];
            if (drawn_.skinIndices.empty()) // they never change
                for (std::uint32_t& corner : corners) corner += firstVertex_;
            else
                corners = cornersAt(drawn_.skinIndices, firstIndex_ + 3 * t);
            if (corners[0] != corners[1]) give({Part::skin, pieceOf(corners[0]), corners});
        }
    }

    void walkSheet(const sim::layout::DrawArguments& draw) {
        for (std::uint32_t t = 0; t < draw.indexCount / 3; ++t) {
            const Corners corners = cornersAt(drawn_.skinIndices, draw.firstIndex + 3 * std::size_t{t});
            if (corners[0] == corners[1]) continue;
            give({Part::ofSheet, drawn_.slotPieces[drawn_.sheetSlots[corners[0]]], corners});
        }
    }

    void give(const DrawnTriangle& triangle) const {
        if (triangle.piece != REMOVED_PIECE) use_(triangle);
    }

    static Corners cornersAt(const std::vector<std::uint32_t>& indices, std::size_t first) {
        return {indices[first], indices[first + 1], indices[first + 2]};
    }

    /// Of a vertex of the buffer of all skins.
    std::uint32_t pieceOf(std::uint32_t vertex) const {
        if (drawn_.pieces.empty()) return NO_PARTICLE;
        const std::uint32_t own = vertex - firstVertex_;
        if (!skin_.particles.empty()) return drawn_.pieces[skin_.particles[own]];
        return skin_.anchors.empty() ? NO_PARTICLE : drawn_.pieces[skin_.anchors[own]]; // else it stretches
    }

    const sim::Skin& skin_;
    const Drawn& drawn_;
    const std::function<void(const DrawnTriangle&)>& use_;
    std::uint32_t firstVertex_ = 0;
    std::size_t firstIndex_ = 0;
};

} // namespace

std::vector<vk::BufferView> topologyViews(const sim::Simulation& simulation, const sim::Scene& scene) {
    std::vector<vk::BufferView> views{simulation.pieces()};
    if (!haveSurface(simulation, scene)) return {};
    views.push_back(simulation.skinIndices());
    if (simulation.pieceDraws().size > 0) {
        views.push_back(simulation.pieceDraws());
        for (const sim::PieceVertices& pieces : simulation.program().pieceSkins)
            views.push_back(simulation.view(pieces.vertices));
    }
    const sim::CutSurface cut = simulation.cutSurface();
    if (cut.vertices.size > 0) views.insert(views.end(), {cut.indices, cut.rest, cut.draws});
    return views;
}

Drawn readTopology(const ReadView& read, const sim::Simulation& simulation, const sim::Scene& scene,
                   const sim::Settings& settings) {
    Drawn drawn;
    if (!haveSurface(simulation, scene)) return drawn;
    readPieces(read, simulation, scene, settings, drawn);
    drawn.skinIndices = elementsOf<std::uint32_t>(read, simulation.skinIndices());
    findThinned(scene, drawn);
    if (simulation.pieceDraws().size > 0) readSheets(read, simulation, drawn);
    const sim::CutSurface cut = simulation.cutSurface();
    if (cut.vertices.size == 0) return drawn;
    drawn.indices = elementsOf<std::uint32_t>(read, cut.indices);
    drawn.rest = elementsOf<sim::layout::CutVertex>(read, cut.rest);
    drawn.draws = elementsOf<sim::layout::DrawArguments>(read, cut.draws);
    return drawn;
}

Drawn downloadDrawn(vk::Queue& queue, const sim::Simulation& simulation, const sim::Scene& scene,
                    const sim::Settings& settings) {
    const auto read = [&](const vk::BufferView& view, void* bytes) {
        queue.download(view, bytes, view.size);
    };
    Drawn drawn = readTopology(read, simulation, scene, settings);
    drawn.skinVertices = queue.download<sim::layout::SkinVertex>(simulation.skinVertices());
    if (drawn.pieces.empty() || simulation.cutSurface().vertices.size == 0) return drawn;
    drawn.vertices = queue.download<sim::layout::SkinVertex>(simulation.cutSurface().vertices);
    return drawn;
}

void eachTriangle(const sim::Scene& scene, std::size_t index, const Drawn& drawn,
                  const std::function<void(const DrawnTriangle&)>& use) {
    Walk(scene, index, drawn, use);
}

std::size_t piecesWithSurface(const sim::Scene& scene, const Drawn& drawn) {
    if (drawn.pieces.empty()) return 0;
    std::set<std::uint32_t> pieces;
    for (std::size_t s = 0; s < scene.skins.size(); ++s) {
        std::uint32_t last = REMOVED_PIECE; // that no triangle has
        eachTriangle(scene, s, drawn, [&](const DrawnTriangle& triangle) {
            if (triangle.piece != last) pieces.insert(last = triangle.piece);
        });
        if (pieces.erase(NO_PARTICLE) == 0) continue;
        for (const sim::CellEmbedding& cell : scene.skins[s].cells) // not clipped
            for (const std::uint32_t particle : cell.particles) pieces.insert(drawn.pieces[particle]);
        pieces.erase(NO_PARTICLE);
        pieces.erase(REMOVED_PIECE);
    }
    return pieces.size();
}

PieceCount countPieces(const sim::Scene& scene, const Drawn& drawn, std::size_t all) {
    const std::size_t pieces = piecesWithSurface(scene, drawn);
    return {.pieces = pieces, .fragments = all - std::min(pieces, all)};
}

std::string toText(const PieceCount& count) {
    if (!count.isCounted) return "pieces were not counted";
    std::string text = sim::counted(count.pieces, "piece");
    if (count.fragments > 0)
        text += " and " + sim::counted(count.fragments, "fragment") + " without a surface";
    return text;
}

bool isCut(std::size_t index, const Drawn& drawn) {
    if (index < drawn.isThinned.size() && drawn.isThinned[index]) return true;
    if (index < drawn.pieceDraws.size() && drawn.pieceDraws[index].indexCount > 0) return true;
    const auto mine = static_cast<float>(index);
    return std::ranges::any_of(drawn.draws, [&](const sim::layout::DrawArguments& draw) {
        for (std::uint32_t t = 0; t < draw.indexCount / 3; ++t)
            if (drawn.rest[drawn.indices[draw.firstIndex + 3 * std::size_t{t}]].rest.w == mine) return true;
        return false;
    });
}

} // namespace sinew::app
