// Tables for the kernels: where each corner has its coordinates at load, and which triangles of the mesh lie
// side by side in the texture.
#include "sim/surface/texture_coordinates.hpp"

#include "kernels.hpp"
#include "sim/surface/hung_surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace sinew::sim::surface {

namespace {

namespace k = kernels;

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// Coordinates of both ends of an edge that differ by no more are no seam [texture].
constexpr float sameWithin = 1e-5f;

bool areSame(const TexturePoint& a, const TexturePoint& b) {
    return std::abs(a.u - b.u) <= sameWithin && std::abs(a.v - b.v) <= sameWithin;
}

void set(float (&at)[6], const TextureCorners& corners) {
    for (std::size_t n = 0; n < 3; ++n) {
        at[2 * n] = corners[n].u;
        at[2 * n + 1] = corners[n].v;
    }
}

void add(std::vector<TexturePoint>& all, const std::vector<TextureCorners>& corners, std::size_t triangles) {
    for (const TextureCorners& of : corners) all.insert(all.end(), of.begin(), of.end());
    if (corners.empty()) all.resize(all.size() + 3 * triangles);
}

// For each triangle the ones across its edges, NO_TEXTURE across seams.
std::vector<std::array<std::uint32_t, 3>> neighbours(const Triangles& triangles,
                                                     const std::vector<TextureCorners>& corners) {
    std::vector<std::array<std::uint32_t, 3>> beyond(triangles.size(), {NO_TEXTURE, NO_TEXTURE, NO_TEXTURE});
    std::map<std::array<std::uint32_t, 2>, std::array<std::uint32_t, 2>>
        edges; // triangle and edge, by its ends
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (std::uint32_t n = 0; n < 3; ++n) edges[{triangles[t][n], triangles[t][(n + 1) % 3]}] = {t, n};
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (std::uint32_t n = 0; n < 3; ++n) {
            const auto found = edges.find({triangles[t][(n + 1) % 3], triangles[t][n]});
            if (found == edges.end()) continue;
            const auto [other, edge] = found->second;
            if (areSame(corners[t][n], corners[other][(edge + 1) % 3]) &&
                areSame(corners[t][(n + 1) % 3], corners[other][edge]))
                beyond[t][n] = other;
        }
    return beyond;
}

// The number of the part of the texture of each triangle: parts end at seams.
std::vector<std::uint32_t> partsOf(const std::vector<std::array<std::uint32_t, 3>>& beyond) {
    std::vector<std::uint32_t> parts(beyond.size(), NO_TEXTURE), open;
    for (std::uint32_t first = 0; first < beyond.size(); ++first) {
        if (parts[first] != NO_TEXTURE) continue;
        parts[first] = first;
        open = {first};
        while (!open.empty()) {
            const std::uint32_t t = open.back();
            open.pop_back();
            for (const std::uint32_t other : beyond[t]) {
                if (other == NO_TEXTURE || parts[other] != NO_TEXTURE) continue;
                parts[other] = first;
                open.push_back(other);
            }
        }
    }
    return parts;
}

// One whole triangle for all corners at one vertex that have the same coordinates in the same part of the
// texture, so that all of them find the same new place. Parts may overlap: six faces of a cube, each of which
// has the whole texture, say.
class Homes {
public:
    explicit Homes(std::vector<std::uint32_t> parts) : parts_(std::move(parts)) {}

    std::uint32_t of(std::uint32_t vertex, const TexturePoint& at, std::uint32_t whole) {
        std::vector<Home>& homes = homes_[vertex];
        for (const Home& home : homes)
            if (areSame(home.at, at) && parts_[home.whole] == parts_[whole]) return home.whole;
        homes.push_back({at, whole});
        return whole;
    }

private:
    struct Home {
        TexturePoint at;
        std::uint32_t whole = 0;
    };
    std::vector<std::uint32_t> parts_; // by whole triangle
    std::map<std::uint32_t, std::vector<Home>> homes_;
};

void addToTopology(ProgramBuilder& program, BufferId buffer) {
    program.program().cutting.topology.push_back(buffer);
    program.addToState(buffer, buffer);
}

} // namespace

bool areTextured(const std::vector<Skin>& skins) {
    return std::ranges::any_of(skins, [](const Skin& skin) { return !skin.textureCoordinates.empty(); });
}

void addTextureCoordinates(ProgramBuilder& program, const std::vector<Skin>& skins, Coordinates are,
                           std::size_t count) {
    BufferId& buffer = program.program().textureCoordinates;
    if (buffer != BufferId{} || !areTextured(skins)) return;
    std::vector<TexturePoint> all;
    for (const Skin& skin : skins) add(all, skin.textureCoordinates, skin.triangles.size());
    all.resize(std::max(all.size(), count));
    buffer = program.upload("skin.texture_coordinates", all);
    if (are == Coordinates::changing) addToTopology(program, buffer);
}

void addWholeTextureCoordinates(ProgramBuilder& program, const std::vector<Skin>& skins) {
    if (!areTextured(skins)) return;
    std::vector<TexturePoint> all;
    for (const Skin& skin : skins) {
        const bool isSplit = !skin.wholeTriangles.empty();
        add(all, isSplit ? skin.wholeTextureCoordinates : skin.textureCoordinates,
            isSplit ? skin.wholeTriangles.size() : skin.triangles.size());
    }
    program.program().wholeTextureCoordinates = program.upload("skin.whole_texture_coordinates", all);
}

void addTexturedPrisms(CutBodies& bodies, const Skin& skin, const SkinComplex& complex,
                       std::uint32_t firstTriangle) {
    layout::TexturedPrism none{};
    none.triangle = NO_TEXTURE;
    bodies.texturedPrisms.resize(bodies.prisms.size(), none);
    if (skin.textureCoordinates.empty()) return;
    const auto firstHung = static_cast<std::uint32_t>(bodies.vertices.size()),
               firstWhole = static_cast<std::uint32_t>(bodies.texturedWholes.size());
    const bool isSplit = !skin.wholeOf.empty();
    const Triangles& wholes = isSplit ? skin.wholeTriangles : skin.triangles;
    const auto& corners = isSplit ? skin.wholeTextureCoordinates : skin.textureCoordinates;
    const auto beyond = neighbours(wholes, corners);
    for (std::size_t w = 0; w < wholes.size(); ++w) {
        layout::TexturedWhole& whole = bodies.texturedWholes.emplace_back();
        for (std::size_t n = 0; n < 3; ++n) {
            whole.vertices[n] = firstHung + wholes[w][n];
            whole.beyond[n] = beyond[w][n] == NO_TEXTURE ? NO_TEXTURE : firstWhole + beyond[w][n];
        }
        set(whole.at, corners[w]);
    }
    Homes homes(partsOf(beyond));
    for (std::uint32_t t = 0; t < complex.prisms.size(); ++t) {
        layout::TexturedPrism& prism = bodies.texturedPrisms.emplace_back();
        prism.triangle = firstTriangle + t;
        for (std::size_t n = 0; n < 3; ++n)
            prism.homes[n] = firstWhole + homes.of(skin.triangles[t][n], skin.textureCoordinates[t][n],
                                                   isSplit ? skin.wholeOf[t] : t);
        set(prism.at, skin.textureCoordinates[t]);
    }
}

void addTexturedFaces(CutBodies& bodies, const Skin& skin, const Grid& grid,
                      std::span<const layout::SkinFace> faces, layout::TexturedFacePush push) {
    if (skin.textureCoordinates.empty()) return;
    push.first = static_cast<std::uint32_t>(bodies.texturedFaces.size());
    push.count = static_cast<std::uint32_t>(faces.size());
    for (std::size_t t = 0; t < faces.size(); ++t) {
        const auto heightOf = [&](std::size_t n) { // ascends along the edges of a face
            const std::uint32_t particle = skin.particles[skin.triangles[t][n]];
            const auto node = lattice::coordinates(grid, grid.node[particle - grid.firstParticle]);
            return node[0] + node[1] + node[2];
        };
        std::array<std::size_t, 3> order{0, 1, 2};
        std::ranges::sort(order, {}, heightOf);
        const TextureCorners& at = skin.textureCoordinates[t];
        layout::TexturedFace& face = bodies.texturedFaces.emplace_back();
        face.item = faces[t].item;
        set(face.at, {at[order[0]], at[order[1]], at[order[2]]});
    }
    bodies.texturedRanges.push_back(push);
}

void addTextureBuffers(ProgramBuilder& program, const std::vector<Skin>& skins, CutSurface& surface,
                       const CutBodies& bodies) {
    addTextureCoordinates(program, skins, Coordinates::changing);
    if (bodies.texturedWholes.empty() && bodies.texturedFaces.empty()) return;
    BufferId& drawn = program.program().cutSurface.textureCoordinates;
    drawn = program.scratch<TexturePoint>("surface.texture_coordinates", surface.push.room);
    addToTopology(program, drawn);
    if (!bodies.texturedWholes.empty()) {
        std::vector<layout::TexturedPrism> prisms = bodies.texturedPrisms;
        prisms.resize(bodies.prisms.size(), layout::TexturedPrism{NO_TEXTURE, {}, {}});
        surface.texture.prisms = program.upload("surface.textured_prisms", prisms);
        surface.texture.wholes = program.upload("surface.textured_wholes", bodies.texturedWholes);
    }
    surface.texture.ranges = bodies.texturedRanges;
    if (!bodies.texturedFaces.empty())
        surface.texture.faces = program.upload("surface.textured_faces", bodies.texturedFaces);
}

void addTexturePasses(ProgramBuilder& program, const CutSurface& surface) {
    const StepProgram& built = program.program();
    const CutSurfaceBuffers& drawn = built.cutSurface;
    const HungSurface& hung = surface.hung;
    const SurfaceTexture& texture = surface.texture;
    if (texture.prisms != BufferId{}) {
        const layout::CountPush prisms{hung.prismCount};
        program.dispatch(k::placeTexturePoints, prisms.count,
                         {texture.prisms, texture.wholes, hung.prisms, hung.vertices, hung.moved,
                          built.textureCoordinates},
                         prisms);
        addListedPrisms(program, surface, k::writePieceTextures,
                        {surface.listed, surface.owned, built.cutting.links, hung.prisms, hung.vertices,
                         surface.starts, drawn.state, drawn.rest, hung.moved, texture.prisms,
                         built.textureCoordinates, drawn.textureCoordinates});
    }
    for (const layout::TexturedFacePush& range : texture.ranges)
        program.dispatch(k::writeFaceTextures, range.count,
                         {surface.complex, surface.partitions, surface.owned, texture.faces, surface.starts,
                          drawn.state, surface.rest, drawn.rest, surface.counts, drawn.textureCoordinates},
                         range);
}

} // namespace sinew::sim::surface
