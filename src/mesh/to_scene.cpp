// Steps: mesh to cells to lattice, and every skin vertex into the cell that contains it. The hull is
// conservative, so that cell exists; rounding at cell borders is handled by taking a neighbour.
#include "mesh/to_scene.hpp"

#include "mesh/components.hpp"
#include "mesh/inside.hpp"
#include "mesh/place_grid.hpp"
#include "mesh/split_skin.hpp"
#include "mesh/topology.hpp"
#include "mesh/wrap.hpp"
#include "sinew/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace sinew::mesh {
namespace {

using Cell = std::array<std::int64_t, 3>;

/// A body gets the mass of the surface around it if its mesh encloses less than this share of that surface's
/// volume.
constexpr double leastShare = 0.01;

bool isFilled(const VoxelGrid& grid, const Cell& cell) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (cell[axis] < 0 || cell[axis] >= grid.cells[axis]) return false;
    return grid.voxels[cell[0] + grid.cells[0] * (cell[1] + grid.cells[1] * cell[2])] != Voxel::empty;
}

/// The filled cell nearest to a point in cell units, among the cell that contains it and its 26 neighbours.
Cell findCell(const VoxelGrid& grid, const Vector3& point) {
    const Cell home{std::llround(std::floor(point.x())), std::llround(std::floor(point.y())),
                    std::llround(std::floor(point.z()))};
    if (isFilled(grid, home)) return home;
    Cell best = home;
    double bestDistance = 4; // beyond any neighbour
    for (std::int64_t k = home[2] - 1; k <= home[2] + 1; ++k)
        for (std::int64_t j = home[1] - 1; j <= home[1] + 1; ++j)
            for (std::int64_t i = home[0] - 1; i <= home[0] + 1; ++i) {
                const Eigen::AlignedBox3d box(
                    Vector3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)),
                    Vector3(static_cast<double>(i + 1), static_cast<double>(j + 1),
                            static_cast<double>(k + 1)));
                const double distance = box.squaredExteriorDistance(point);
                if (distance < bestDistance && isFilled(grid, {i, j, k})) {
                    bestDistance = distance;
                    best = {i, j, k};
                }
            }
    if (bestDistance > 3) throw std::logic_error("addMesh: a skin vertex lies in no filled cell");
    return best;
}

/// Embedding of `point`, in cell units.
sim::CellEmbedding embed(const VoxelGrid& grid, const sim::LatticeCorners& corners, const Vector3& point) {
    const Cell cell = findCell(grid, point);
    sim::CellEmbedding embedding;
    for (std::uint32_t corner = 0; corner < 8; ++corner)
        embedding.particles[corner] = corners.at(static_cast<std::uint32_t>(cell[0]) + (corner & 1),
                                                 static_cast<std::uint32_t>(cell[1]) + (corner >> 1 & 1),
                                                 static_cast<std::uint32_t>(cell[2]) + (corner >> 2));
    const Vector3 low(static_cast<double>(cell[0]), static_cast<double>(cell[1]),
                      static_cast<double>(cell[2]));
    embedding.weights = toVec3((point - low).cwiseMax(0).cwiseMin(1));
    return embedding;
}

/// Sets contact offsets so that a collider touches the skin, not the particles: particles outside of the
/// surface may come closer to it, those inside keep their depth, up to one cell. Without the second rule the
/// lowest layer alone would carry a body and be squashed flat. Corners are samples of a grid that is one cell
/// larger, shifted by half a cell.
void setContactOffsets(sim::Scene& scene, const sim::LatticeCorners& corners, const VoxelGrid& grid,
                       const TriangleMesh& mesh) {
    std::vector<Vector3> positions = toCellUnits(mesh, grid);
    for (Vector3& position : positions) position += Vector3::Constant(0.5);
    const TriangleTree tree(positions, mesh.triangles);
    const std::array<std::uint32_t, 3> count{grid.cells[0] + 1, grid.cells[1] + 1, grid.cells[2] + 1};
    const Inside inside(positions, mesh.triangles, tree, count, 1);
    for (std::uint32_t k = 0; k < count[2]; ++k)
        for (std::uint32_t j = 0; j < count[1]; ++j)
            for (std::uint32_t i = 0; i < count[0]; ++i) {
                const std::uint32_t particle = corners.at(i, j, k);
                if (particle == sim::LatticeCorners::noParticle) continue;
                const double distance = tree.distance(Vector3(i, j, k) + Vector3::Constant(0.5));
                const double offset = inside({i, j, k}).isInside ? std::min(distance, 1.0) : -distance;
                scene.particles[particle].contactOffset = static_cast<float>(offset * double{grid.spacing});
            }
}

sim::Lattice makeLattice(const VoxelGrid& grid, const MeshBody& body, double volume) {
    sim::Lattice lattice{.name = body.name,
                         .origin = grid.origin,
                         .cells = grid.cells,
                         .spacing = grid.spacing,
                         .fill = grid.fill,
                         .youngModulus = body.youngModulus,
                         .poissonRatio = body.poissonRatio,
                         .recovery = body.recovery,
                         .density = body.density,
                         .radius = body.touchesParticles ? grid.spacing / 2 : 0,
                         .isCuttable = body.isCuttable,
                         .tearStrain = body.tearStrain,
                         .tearsPerStep = body.tearsPerStep,
                         .toughness = body.toughness};
    // A hull cell may contain the surface and none of the 64 samples: it exists all the same, because the
    // skin is bound to it.
    for (std::size_t i = 0; i < grid.voxels.size(); ++i)
        if (grid.voxels[i] == Voxel::hull) lattice.fill[i] = std::max(lattice.fill[i], 1.0f / 64);
    lattice.restVolume = static_cast<float>(volume);
    return lattice;
}

/// Volume of the components that lie inside of another one and face outward like it [m^3]: a region enclosed
/// by both counts once.
double volumeWithin(const TriangleMesh& mesh, const VoxelGrid& grid) {
    const std::vector<Component> parts = components(mesh);
    if (parts.size() < 2) return 0;
    const std::vector<Vector3> positions = toCellUnits(mesh, grid);
    const TriangleTree tree(positions, mesh.triangles);
    double volume = 0;
    for (const Component& part : parts) {
        const auto& [a, b, c] = mesh.triangles[part.triangles.front()];
        const Vector3 normal = (positions[b] - positions[a]).cross(positions[c] - positions[a]).normalized();
        const Vector3 outside = (positions[a] + positions[b] + positions[c]) / 3 + 1e-3 * normal;
        if (tree.windingNumber(outside) > 0.5) volume += part.volume;
    }
    return volume;
}

/// Volume of a closed mesh [m^3]. The sampled volume is off by an eighth of a cell beside a surface at most:
/// if the mesh differs by more, parts of it overlap or cancel each other, and the filled volume counts.
double volumeOf(const TriangleMesh& mesh, const VoxelGrid& grid) {
    const MeshReport report = measure(mesh);
    const double volume = report.volume - volumeWithin(mesh, grid);
    const bool isOff = std::abs(volume - grid.filledVolume) > report.area * double{grid.spacing} / 4;
    return isOff ? grid.filledVolume : volume;
}

/// Weights of the corners of a triangle at a point in its plane, none below 0; they sum to 1.
Vector3 weightsIn(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& point) {
    const Vector3 ab = b - a, ac = c - a, ap = point - a, normal = ab.cross(ac);
    const double scale = normal.squaredNorm();
    if (scale == 0) return {1, 0, 0};
    const double atB = ap.cross(ac).dot(normal) / scale, atC = ab.cross(ap).dot(normal) / scale;
    const Vector3 weights = Vector3(1 - atB - atC, atB, atC).cwiseMax(0);
    return weights / weights.sum();
}

/// Texture coordinates of the triangles that a skin was split into: linear in each whole triangle.
std::vector<sim::TextureCorners> splitCoordinates(const sim::Skin& skin,
                                                  const std::vector<Vector3>& positions) {
    std::vector<sim::TextureCorners> corners(skin.triangles.size());
    for (std::size_t t = 0; t < corners.size(); ++t) {
        const auto& [a, b, c] = skin.wholeTriangles[skin.wholeOf[t]];
        const sim::TextureCorners& at = skin.wholeTextureCoordinates[skin.wholeOf[t]];
        for (std::size_t n = 0; n < 3; ++n) {
            const Vector3 weights =
                weightsIn(positions[a], positions[b], positions[c], positions[skin.triangles[t][n]]);
            const Vector3 u(double{at[0].u}, double{at[1].u}, double{at[2].u}),
                v(double{at[0].v}, double{at[1].v}, double{at[2].v});
            corners[t][n] = {static_cast<float>(weights.dot(u)), static_cast<float>(weights.dot(v))};
        }
    }
    return corners;
}

/// Binds every vertex to its cell; a vertex of a clipped skin also gets its anchor.
void hang(sim::Skin& skin, std::vector<Vector3> positions, const VoxelGrid& grid,
          const sim::LatticeCorners& corners, bool isClipped) {
    if (isClipped) {
        skin.wholeTriangles = skin.triangles;
        const std::size_t whole = positions.size(); // index of the first vertex added by the split
        SplitSkin split = splitSkin(std::move(positions), std::move(skin.triangles));
        positions = std::move(split.positions);
        skin.triangles = std::move(split.triangles);
        skin.wholeOf = std::move(split.wholeOf);
        skin.wholeTextureCoordinates = std::exchange(skin.textureCoordinates, {});
        if (!skin.wholeTextureCoordinates.empty())
            skin.textureCoordinates = splitCoordinates(skin, positions);
        for (const auto& node : split.anchors)
            skin.anchors.push_back(corners.at(static_cast<std::uint32_t>(node[0]),
                                              static_cast<std::uint32_t>(node[1]),
                                              static_cast<std::uint32_t>(node[2])));
        if (std::ranges::count(skin.anchors, sim::LatticeCorners::noParticle) > 0) {
            positions.resize(whole); // the skin is not clipped: restored
            skin.triangles = std::exchange(skin.wholeTriangles, {});
            skin.textureCoordinates = std::exchange(skin.wholeTextureCoordinates, {});
            skin.wholeOf.clear();
            skin.anchors.clear();
        }
    }
    skin.cells.reserve(positions.size());
    for (const Vector3& position : positions) skin.cells.push_back(embed(grid, corners, position));
}

/// A welded and oriented mesh with the voxels that it fills.
struct Filled {
    TriangleMesh mesh;
    bool isClosed = false;
    VoxelGrid grid;
    double volume = 0; ///< volume that determines the mass of the body [m^3]; 0 = that of its voxels
};

Filled fillVoxels(const TriangleMesh& mesh, const MeshBody& body) {
    Filled filled;
    MeshDefects defects;
    filled.mesh = orient(weld(mesh, defects));
    filled.isClosed = defects.isClosed();
    if (filled.mesh.triangles.empty())
        throw std::invalid_argument("addMesh: mesh \"" + body.name + "\" has no triangles");
    filled.grid = body.mostParticles > 0
                      ? voxeliseWithin(body.mostParticles, filled.mesh, body.voxels, voxelise)
                      : voxelise(filled.mesh, body.voxels);
    filled.volume = filled.isClosed ? volumeOf(filled.mesh, filled.grid) : filled.grid.filledVolume;
    return filled;
}

void addSkin(sim::Scene& scene, const Filled& filled, const sim::LatticeCorners& corners,
             const MeshBody& body) {
    scene.skins.push_back({.name = body.name,
                           .triangles = filled.mesh.triangles,
                           .textureCoordinates = filled.mesh.textureCoordinates,
                           .color = body.color});
    hang(scene.skins.back(), toCellUnits(filled.mesh, filled.grid), filled.grid, corners,
         body.isCuttable && filled.isClosed);
}

/// True if the mesh, as the skin of these voxels, can show the inside along cuts.
bool showsInside(const Filled& filled, const MeshBody& body) {
    if (!filled.isClosed) return false;
    sim::Scene alone;
    addSkin(alone, filled, addLattice(alone, makeLattice(filled.grid, body, filled.volume)), body);
    return sim::showsInside(alone, 0, 0);
}

/// True if a wrapped surface encloses about the same volume as the voxels of its mesh; parts thinner than a
/// cell are thicker in it.
bool encloses(const TriangleMesh& surface, const VoxelGrid& grid) {
    const MeshReport report = measure(surface);
    const double more = report.volume - grid.filledVolume, layer = report.area * double{grid.spacing};
    return more > -layer / 4 && more < layer / 2;
}

/// The wrapped surface of the mesh, with its voxels; none if it cannot show the inside either.
std::optional<Filled> wrapVoxels(const Filled& given, const MeshBody& body) {
    const TriangleMesh surface = wrap(given.mesh, given.grid);
    if (!encloses(surface, given.grid)) return std::nullopt;
    Filled wrapped = fillVoxels(surface, body);
    if (!showsInside(wrapped, body)) return std::nullopt;
    if (given.volume > leastShare * wrapped.volume) wrapped.volume = given.volume;
    wrapped.grid.doubtful = given.grid.doubtful; // the wrapped surface itself has no doubtful cells
    return wrapped;
}

} // namespace

AddedMesh addMesh(sim::Scene& scene, const TriangleMesh& mesh, const MeshBody& body) {
    Filled filled = fillVoxels(mesh, body);
    Shown shown = Shown::mesh;
    if (body.isCuttable && !showsInside(filled, body)) {
        std::optional<Filled> wrapped = wrapVoxels(filled, body);
        shown = wrapped ? Shown::wrapped : Shown::voxels;
        if (wrapped) filled = std::move(*wrapped);
    }
    const sim::Lattice lattice = makeLattice(filled.grid, body, filled.volume);
    const sim::LatticeCorners corners = addLattice(scene, lattice);
    setContactOffsets(scene, corners, filled.grid, filled.mesh);
    if (shown == Shown::voxels)
        addLatticeSkin(scene, lattice, corners, body.color);
    else
        addSkin(scene, filled, corners, body);
    return {std::move(filled.grid), shown};
}

} // namespace sinew::mesh
