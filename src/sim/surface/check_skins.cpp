// Sizes, indices and weights of skins, and their texture coordinates.
#include "sim/surface/check_skins.hpp"

namespace sinew::sim::surface {

namespace {

void checkCells(const Skin& skin, const std::string& name, std::size_t particles, Complaints& complaints) {
    for (std::size_t v = 0; v < skin.cells.size(); ++v) {
        const auto vertex = [&] { return name + element(".cells", v); };
        for (const std::uint32_t corner : skin.cells[v].particles)
            complaints.checkIndex(corner, particles, "particles", [&] { return vertex() + ".particles"; });
        const Vec3& weights = skin.cells[v].weights;
        for (const float weight : {weights.x, weights.y, weights.z})
            complaints.check(double{weight}, ranges::embeddingWeight, [&] { return vertex() + ".weights"; });
    }
}

void checkTexture(const std::vector<TextureCorners>& given, std::size_t triangles, const std::string& name,
                  Complaints& complaints) {
    if (given.size() != triangles)
        complaints.add(name, "has texture coordinates for " + number(given.size()) + " of " +
                                 number(triangles) + " triangles, must have them for each");
    for (std::size_t t = 0; t < given.size(); ++t)
        for (const TexturePoint& at : given[t])
            if (!std::isfinite(at.u) || !std::isfinite(at.v)) {
                complaints.add(name + element("", t), "is not finite");
                return;
            }
}

void checkTextures(const Skin& skin, const std::string& name, Complaints& complaints) {
    if (skin.textureCoordinates.empty() && skin.wholeTextureCoordinates.empty()) return;
    checkTexture(skin.textureCoordinates, skin.triangles.size(), name + ".textureCoordinates", complaints);
    checkTexture(skin.wholeTextureCoordinates, skin.wholeTriangles.size(), name + ".wholeTextureCoordinates",
                 complaints);
}

} // namespace

void checkSkin(const Skin& skin, const std::string& name, std::size_t particles, Complaints& complaints) {
    if (skin.vertexCount() == 0) {
        complaints.add(name, "has no vertices: fill particles or cells");
        return;
    }
    if (!skin.particles.empty() && !skin.cells.empty())
        complaints.add(name, "has both particles and cells, must have one of the two");
    for (std::size_t v = 0; v < skin.particles.size(); ++v)
        complaints.checkIndex(skin.particles[v], particles, "particles",
                              [&] { return name + element(".particles", v); });
    checkCells(skin, name, particles, complaints);
    if (!skin.anchors.empty() && skin.anchors.size() != skin.cells.size())
        complaints.add(name, "has " + number(skin.anchors.size()) + " anchors for " +
                                 number(skin.cells.size()) + " vertices in cells, must have as many or none");
    for (std::size_t v = 0; v < skin.anchors.size(); ++v)
        complaints.checkIndex(skin.anchors[v], particles, "particles",
                              [&] { return name + element(".anchors", v); });
    for (std::size_t t = 0; t < skin.triangles.size(); ++t)
        for (const std::uint32_t corner : skin.triangles[t])
            complaints.checkIndex(corner, skin.vertexCount(), "vertices",
                                  [&] { return name + element(".triangles", t); });
    if (!skin.wholeOf.empty() && skin.wholeOf.size() != skin.triangles.size())
        complaints.add(name, "has wholeOf for " + number(skin.wholeOf.size()) + " of " +
                                 number(skin.triangles.size()) +
                                 " triangles, must have an entry for each of them or none at all");
    for (std::size_t t = 0; t < skin.wholeOf.size(); ++t)
        complaints.checkIndex(skin.wholeOf[t], skin.wholeTriangles.size(), "whole triangles",
                              [&] { return name + element(".wholeOf", t); });
    for (std::size_t t = 0; t < skin.wholeTriangles.size(); ++t)
        for (const std::uint32_t corner : skin.wholeTriangles[t])
            complaints.checkIndex(corner, skin.vertexCount(), "vertices",
                                  [&] { return name + element(".wholeTriangles", t); });
    checkTextures(skin, name, complaints);
    for (const float channel : {skin.color.x, skin.color.y, skin.color.z})
        complaints.check(double{channel}, ranges::color, [&] { return name + ".color"; });
}

} // namespace sinew::sim::surface
