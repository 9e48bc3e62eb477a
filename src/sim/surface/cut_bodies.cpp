// Reads grids and their skins; for each grid the first skin that can be clipped.
#include "sim/surface/cut_bodies.hpp"

#include "sim/surface/lattice_faces.hpp"
#include "sim/surface/skin_complex.hpp"
#include "sim/surface/skin_slots.hpp"
#include "sim/surface/texture_coordinates.hpp"
#include "sim/surface/unfold_anchors.hpp"
#include "sinew/bodies.hpp"

#include <algorithm>

namespace sinew::sim::surface {

namespace {

class Reader {
public:
    Reader(const Scene& scene, const StateLayout& layout, std::span<const layout::CutPush> runs)
        : scene_(scene), layout_(layout), runs_(runs) {
        bodies_.complex.resize(layout.count);
        bodies_.rest.resize(layout.count);
    }

    void add(const Grid& grid, const lattice::Box& box) {
        SkinPlace place;
        for (const Skin& skin : scene_.skins) {
            if (skin.anchors.empty() ? addFaces(grid, box, place) : addMesh(grid, box, place)) return;
            ++place.index;
            place.firstVertex += static_cast<std::uint32_t>(skin.vertexCount());
            place.firstTriangle += static_cast<std::uint32_t>(skin.triangles.size());
        }
    }

    CutBodies finish() {
        if (pulled_.empty()) return std::move(bodies_);
        bodies_.pulled = bodies_.rest;
        for (const auto& [slot, x] : pulled_) bodies_.pulled[slot] = {x.x, x.y, x.z, bodies_.rest[slot].w};
        return std::move(bodies_);
    }

private:
    bool addFaces(const Grid& grid, const lattice::Box& box, const SkinPlace& place) {
        const auto faces = latticeFaces(scene_.skins[place.index], grid, box, place.firstTriangle);
        if (!faces) return false;
        bodies_.faces.insert(bodies_.faces.end(), faces->begin(), faces->end());
        if (areTextured_) {
            const layout::CutPush& run = runOf(box);
            addTexturedFaces(
                bodies_, scene_.skins[place.index], grid, *faces,
                {.first = 0, .count = 0, .rowStride = run.rowStride, .sliceStride = run.sliceStride});
        }
        addBody(grid, place.index);
        for (const std::uint32_t index : grid.node) {
            const std::array<std::uint32_t, 3> node = lattice::coordinates(grid, index);
            if (lattice::fillAround(grid, node) >> 28 != 0)
                bodies_.complex[box.slot(node[0], node[1], node[2])] =
                    63 | COMPLEX_HAS_FACES | COMPLEX_IS_CELL;
        }
        return true;
    }

    bool addMesh(const Grid& grid, const lattice::Box& box, const SkinPlace& place) {
        const auto firstPrism = static_cast<std::uint32_t>(bodies_.prisms.size()),
                   firstHung = static_cast<std::uint32_t>(bodies_.vertices.size());
        const auto complex = hangSkin(scene_, grid, box, place, firstPrism, firstHung);
        if (!complex) return false;
        const auto prisms = static_cast<std::uint32_t>(complex->prisms.size());
        const Skin& skin = scene_.skins[place.index];
        const auto firstWhole = static_cast<std::uint32_t>(bodies_.wholes.size());
        for (std::uint32_t t = 0; t < prisms; ++t) // prisms follow all slots
            bodies_.faces.push_back(
                {.item = 16 * (static_cast<std::uint32_t>(layout_.count) + firstPrism + t),
                 .triangle = place.firstTriangle + t,
                 .whole = skin.wholeOf.empty() ? NO_WHOLE : firstWhole + skin.wholeOf[t],
                 .padding = 0});
        if (!skin.wholeOf.empty()) {
            for (const auto& [a, b, c] : skin.wholeTriangles)
                bodies_.wholes.push_back({{firstHung + a, firstHung + b, firstHung + c}});
            for (const layout::PartVertex& part : complex->parts)
                bodies_.parts.push_back(
                    {firstHung + part.vertex, firstWhole + part.whole, {part.shares[0], part.shares[1]}});
        }
        if (areTextured_) addTexturedPrisms(bodies_, skin, *complex, place.firstTriangle);
        bodies_.prisms.insert(bodies_.prisms.end(), complex->prisms.begin(), complex->prisms.end());
        bodies_.vertices.insert(bodies_.vertices.end(), complex->vertices.begin(), complex->vertices.end());
        bodies_.planes.insert(bodies_.planes.end(), complex->planes.begin(), complex->planes.end());
        std::ranges::copy(complex->words, bodies_.complex.begin() + box.origin);
        Pulled pulled = pullAnchors(scene_, grid, box, *complex);
        unfoldAnchors(scene_, grid, box, *complex, pulled);
        pulled_.insert(pulled_.end(), pulled.begin(), pulled.end());
        addBody(grid, place.index);
        addRange(box, firstPrism, firstHung, *complex);
        return true;
    }

    void addBody(const Grid& grid, std::uint32_t skin) {
        bodies_.skins.push_back(skin);
        for (std::uint32_t i = grid.firstParticle; i < grid.firstParticle + grid.node.size(); ++i) {
            const Vec3& x = scene_.particles[i].position;
            bodies_.rest[layout_.slot[i]] = {x.x, x.y, x.z, static_cast<float>(skin)};
        }
        bodies_.cells +=
            static_cast<double>(std::ranges::count_if(grid.fill, [](std::uint8_t fill) { return fill > 0; }));
    }

    const layout::CutPush& runOf(const lattice::Box& box) const {
        return *std::ranges::find_if(runs_, [&](const layout::CutPush& push) {
            return box.origin >= push.first && box.origin - push.first < push.count;
        });
    }

    void addRange(const lattice::Box& box, std::uint32_t firstPrism, std::uint32_t firstHung,
                  const SkinComplex& complex) {
        const layout::CutPush& run = runOf(box);
        HungRange range{run, run};
        range.prisms.first = firstPrism;
        range.prisms.count = static_cast<std::uint32_t>(complex.prisms.size());
        range.vertices.first = firstHung;
        range.vertices.count = static_cast<std::uint32_t>(complex.vertices.size());
        range.prisms.run = range.vertices.run = static_cast<std::uint32_t>(bodies_.ranges.size());
        addSkinSlots(bodies_, complex, range);
        bodies_.ranges.push_back(range);
    }

    const Scene& scene_;
    const StateLayout& layout_;
    const std::span<const layout::CutPush> runs_;
    const bool areTextured_ = areTextured(scene_.skins);
    CutBodies bodies_;
    std::vector<std::pair<std::uint32_t, Vec3>> pulled_;
};

} // namespace

CutBodies readCutBodies(const SceneModel& model, std::span<const layout::CutPush> runs) {
    Reader reader(model.scene, model.layout, runs);
    for (std::size_t g = 0; g < model.grids.size(); ++g) {
        const Grid& grid = model.scene.grids[model.grids[g]];
        if (grid.isCuttable && !lattice::isSheet(grid)) reader.add(grid, model.boxes[g]);
    }
    CutBodies bodies = reader.finish();
    bodies.room = model.settings.cutSurfaceRoom;
    return bodies;
}

} // namespace sinew::sim::surface

namespace sinew::sim {

bool showsInside(const Scene& scene, std::size_t skin, std::size_t grid) {
    const Grid& of = scene.grids[grid];
    const lattice::Box box = lattice::place(of, 0);
    return scene.skins[skin].anchors.empty()
               ? surface::latticeFaces(scene.skins[skin], of, box, 0).has_value()
               : surface::hangSkin(scene, of, box, {.index = static_cast<std::uint32_t>(skin)}, 0, 0)
                     .has_value();
}

} // namespace sinew::sim
