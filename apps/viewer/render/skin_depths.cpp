// Distances of the nodes of a grid from a skin. The sign is that of the winding number, so that skins that
// touch or cross themselves have an inside.
#include "viewer/render/skin_depths.hpp"

#include "mesh/triangle_tree.hpp"

#include <algorithm>
#include <cmath>

namespace sinew::viewer {

namespace {

using Box = Eigen::AlignedBox3d;

constexpr double nodesAlong = 32, mostNodes = 20000;
constexpr int border = 2;      // nodes beside the box: each place in it lies between eight nodes
constexpr double reach = 0.06; // depth up to which a picture needs it / size of the body

std::vector<mesh::Vector3> placesOf(const sim::Scene& scene, const sim::Skin& skin) {
    const auto at = [&](std::uint32_t particle) {
        return mesh::toVector(scene.particles[particle].position);
    };
    std::vector<mesh::Vector3> places;
    for (const std::uint32_t particle : skin.particles) places.push_back(at(particle));
    for (const sim::CellEmbedding& cell : skin.cells) {
        mesh::Vector3 place = mesh::Vector3::Zero();
        for (std::size_t k = 0; k < cell.particles.size(); ++k)
            place += double{cell.share(k)} * at(cell.particles[k]);
        places.push_back(place);
    }
    return places;
}

bool isCuttable(const sim::Scene& scene, const sim::Skin& skin) {
    return !skin.cells.empty() && std::ranges::any_of(scene.grids, [&](const sim::Grid& grid) {
        return grid.isCuttable && skin.cells[0].particles[0] - grid.firstParticle < grid.node.size();
    });
}

layout::vec4 packed(const mesh::Vector3& v, double w) {
    const Eigen::Vector3f f = v.cast<float>();
    return {f.x(), f.y(), f.z(), static_cast<float>(w)};
}

// A row of nodes along x. Nodes are skipped that are further from the surface than `band`, as the last one
// tells.
void addRow(std::vector<float>& depths, const mesh::TriangleTree& surface, const mesh::Vector3& first,
            double spacing, int count, double band) {
    double least = 0;
    for (int i = 0; i < count; ++i, least -= spacing) {
        const mesh::Vector3 place = first + i * spacing * mesh::Vector3::UnitX();
        if (least < band) least = surface.distance(place);
        const bool isOutside = least < band && surface.windingNumber(place) < 0.5;
        depths.push_back(static_cast<float>(isOutside ? -least : std::min(least, band)));
    }
}

// `size` of the body [m].
layout::SkinInside addGrid(std::vector<float>& depths, const mesh::TriangleTree& surface, const Box& box,
                           double size) {
    const double spacing =
        std::max(box.sizes().maxCoeff() / nodesAlong, std::cbrt(std::max(box.volume(), 1e-30) / mostNodes));
    const mesh::Vector3 low = box.min() - border * spacing * mesh::Vector3::Ones();
    const Eigen::Vector3i nodes = (box.sizes() / spacing).array().ceil().cast<int>() + 2 * border;
    const layout::SkinInside inside{
        packed(low, spacing), packed(nodes.cast<double>(), static_cast<double>(depths.size())), {}};
    for (int z = 0; z < nodes.z(); ++z)
        for (int y = 0; y < nodes.y(); ++y)
            addRow(depths, surface, low + spacing * mesh::Vector3(0, y, z), spacing, nodes.x(),
                   std::max(reach * size, 2 * spacing));
    return inside;
}

} // namespace

SkinDepths skinDepths(const sim::Scene& scene, const std::vector<bool>& isTissue) {
    SkinDepths all;
    for (layout::SkinInside& inside : all.skins) { // those without a skin are read too
        inside.nodes.w = -1;
        inside.size.x = 1;
    }
    for (std::size_t i = 0; i < std::min(scene.skins.size(), all.skins.size()); ++i) {
        const sim::Skin& skin = scene.skins[i];
        const std::vector<mesh::Vector3> places = placesOf(scene, skin);
        Box box;
        for (const mesh::Vector3& place : places) box.extend(place);
        const double size = box.isEmpty() ? 1 : std::cbrt(std::max(box.volume(), 1e-9));
        if (isTissue[i] && isCuttable(scene, skin)) {
            const mesh::TriangleTree surface(places, skin.wholeTriangles.empty() ? skin.triangles
                                                                                 : skin.wholeTriangles);
            all.skins[i] = addGrid(all.depths, surface, box, size);
        }
        all.skins[i].size.x = static_cast<float>(size);
    }
    return all;
}

} // namespace sinew::viewer
