// Cloth, lattices and bodies of meshes.
#include "capi/bodies.hpp"
#include "capi/convert.hpp"

#include "mesh/repair.hpp"
#include "sinew/bodies.hpp"
#include "sinew/ranges.hpp"

#include <cmath>

namespace sinew::capi {

namespace {

void requireNodes(double nodes, const char* body) {
    if (nodes > sim::ranges::mostGridNodes)
        invalidArgument(std::string(body) + " would have more than " +
                        std::to_string(static_cast<std::uint32_t>(sim::ranges::mostGridNodes)) + " nodes");
}

void requirePositive(float value, const char* name) {
    if (!(value > 0) || !std::isfinite(value))
        invalidArgument(std::string(name) + " is " + std::to_string(value) + ", must be above 0");
}

std::uint32_t lastBody(const sim::Scene& scene, std::uint32_t* body) {
    const auto index = static_cast<std::uint32_t>(scene.bodies.size() - 1);
    if (body != nullptr) *body = index;
    return index;
}

void addTexture(mesh::TriangleMesh& mesh, const SinewMesh& given) {
    if (given.textureCoordinates == nullptr) return;
    for (std::size_t i = 0; i < std::size_t{2} * given.vertexCount; ++i)
        if (!std::isfinite(given.textureCoordinates[i]))
            invalidArgument("the texture coordinates of vertex " + std::to_string(i / 2) + " are not finite");
    for (const auto& triangle : mesh.triangles) {
        sim::TextureCorners& corners = mesh.textureCoordinates.emplace_back();
        for (std::size_t n = 0; n < 3; ++n) {
            const float* at = given.textureCoordinates + std::size_t{2} * triangle[n];
            corners[n] = {at[0], at[1]};
        }
    }
}

mesh::TriangleMesh meshOf(const SinewMesh& given) {
    requireArray(given.vertices, given.vertexCount, "vertices");
    requireArray(given.triangles, given.triangleCount, "triangles");
    mesh::TriangleMesh made{.name = nameOr(given.name, "mesh"), .positions = {}, .triangles = {}};
    made.positions.reserve(given.vertexCount);
    for (std::uint32_t i = 0; i < given.vertexCount; ++i) {
        const sim::Vec3 vertex = toVec3(given.vertices[i]);
        if (!std::isfinite(vertex.x) || !std::isfinite(vertex.y) || !std::isfinite(vertex.z))
            invalidArgument("vertex " + std::to_string(i) + " is not finite");
        made.positions.push_back(vertex);
    }
    made.triangles.reserve(given.triangleCount);
    for (std::uint32_t i = 0; i < given.triangleCount; ++i) {
        const std::uint32_t* corners = given.triangles + std::size_t{3} * i;
        for (int k = 0; k < 3; ++k)
            if (corners[k] >= given.vertexCount)
                invalidArgument("triangle " + std::to_string(i) + " names vertex " +
                                std::to_string(corners[k]) + ", and there are " +
                                std::to_string(given.vertexCount));
        made.triangles.push_back({corners[0], corners[1], corners[2]});
    }
    addTexture(made, given);
    mesh::MeshDefects defects;
    mesh::Repairs repairs;
    made = mesh::weld(made, defects);
    if (made.triangles.empty()) invalidArgument("the mesh has no triangle with an area");
    return mesh::repair(std::move(made), mesh::Repair::close, defects, repairs);
}

} // namespace

std::uint32_t addMeshBody(sim::Scene& scene, const mesh::TriangleMesh& mesh, const SinewMesh& given) {
    if (given.spacing == 0 && (given.resolution < 1 || given.resolution > 512))
        invalidArgument("resolution is " + std::to_string(given.resolution) + ", must be from 1 to 512");
    if (given.spacing != 0) requirePositive(given.spacing, "spacing");
    requirePositive(given.youngModulus, "youngModulus");
    requirePositive(given.density, "density");
    if (!sim::ranges::poissonRatio.holds(double{given.poissonRatio}) ||
        !sim::ranges::recovery.holds(double{given.recovery}))
        invalidArgument("poissonRatio must be " + sim::toText(sim::ranges::poissonRatio) + ", and recovery " +
                        sim::toText(sim::ranges::recovery));
    mesh::addMesh(scene, mesh,
                  {.name = nameOr(given.name, "mesh"),
                   .voxels = {.spacing = given.spacing, .resolution = given.resolution},
                   .youngModulus = given.youngModulus,
                   .poissonRatio = given.poissonRatio,
                   .recovery = given.recovery,
                   .density = given.density,
                   .touchesParticles = given.touches != 0,
                   .isCuttable = given.isCuttable != 0,
                   .tearStrain = given.tearStrain,
                   .toughness = given.toughness});
    return lastBody(scene, nullptr);
}

SinewCloth defaultCloth() {
    const sim::ClothSheet sheet;
    SinewCloth cloth{};
    cloth.size = sizeof cloth;
    cloth.columns = sheet.size[0];
    cloth.rows = sheet.size[1];
    cloth.spacing = sheet.spacing;
    cloth.right = fromVec3(sheet.right);
    cloth.down = fromVec3(sheet.down);
    cloth.areaDensity = sheet.areaDensity;
    return cloth;
}

SinewLattice defaultLattice() {
    const sim::Lattice from;
    SinewLattice lattice{};
    lattice.size = sizeof lattice;
    for (int axis = 0; axis < 3; ++axis) lattice.cells[axis] = from.cells[static_cast<std::size_t>(axis)];
    lattice.spacing = from.spacing;
    lattice.youngModulus = from.youngModulus;
    lattice.poissonRatio = from.poissonRatio;
    lattice.density = from.density;
    return lattice;
}

SinewMesh defaultMesh() {
    const mesh::MeshBody from;
    SinewMesh made{};
    made.size = sizeof made;
    made.resolution = from.voxels.resolution;
    made.youngModulus = from.youngModulus;
    made.poissonRatio = from.poissonRatio;
    made.recovery = from.recovery;
    made.density = from.density;
    return made;
}

} // namespace sinew::capi

using namespace sinew;
using namespace sinew::capi;

extern "C" {

SinewResult sinewAddCloth(SinewScene scene, const SinewCloth* cloth, uint32_t* body) {
    return call(__func__, [&] {
        const SinewCloth given = described(cloth, "SinewCloth", defaultCloth);
        requireArray(given.pinned, given.pinnedCount, "pinned");
        const double nodes = double{1} * given.columns * given.rows;
        requireNodes(nodes, "the cloth");
        requirePositive(given.spacing, "spacing");
        if (given.columns < 2 || given.rows < 2) invalidArgument("a cloth has at least 2 columns and 2 rows");
        for (std::uint32_t i = 0; i < given.pinnedCount; ++i)
            if (given.pinned[i] >= nodes)
                invalidArgument("pinned[" + std::to_string(i) + "] is " + std::to_string(given.pinned[i]) +
                                ", and the cloth has fewer particles");
        const Use<SceneObject> object(scene.id, Access::write);
        Addition addition(object->scene);
        sim::addCloth(object->scene, {.name = nameOr(given.name, "cloth"),
                                      .origin = toVec3(given.origin),
                                      .right = toVec3(given.right),
                                      .down = toVec3(given.down),
                                      .size = {given.columns, given.rows},
                                      .spacing = given.spacing,
                                      .areaDensity = given.areaDensity,
                                      .stretchCompliance = given.stretchCompliance,
                                      .shearCompliance = given.shearCompliance,
                                      .membraneStiffness = given.membraneStiffness,
                                      .skipStiffness = given.skipStiffness,
                                      .bendingStiffness = given.bendingStiffness,
                                      .thickness = given.thickness,
                                      .tethers = given.tethers,
                                      .radius = given.radius,
                                      .pinned = {given.pinned, given.pinned + given.pinnedCount},
                                      .isCuttable = given.isCuttable != 0,
                                      .tearStrain = given.tearStrain,
                                      .toughness = given.toughness});
        addition.keep();
        lastBody(object->scene, body);
    });
}

SinewResult sinewAddLattice(SinewScene scene, const SinewLattice* lattice, uint32_t* body) {
    return call(__func__, [&] {
        const SinewLattice given = described(lattice, "SinewLattice", defaultLattice);
        requireArray(given.fill, given.fillCount, "fill");
        double cells = 1, nodes = 1;
        for (const std::uint32_t side : given.cells) {
            cells *= side;
            nodes *= side + 1.0;
        }
        requireNodes(nodes, "the lattice");
        requirePositive(given.spacing, "spacing");
        if (given.fillCount != 0 && static_cast<double>(given.fillCount) != cells)
            invalidArgument("fillCount is " + std::to_string(given.fillCount) + ", and there are " +
                            std::to_string(static_cast<std::uint64_t>(cells)) + " cells");
        if (given.hasFaces != 0 && !(given.radius > 0))
            invalidArgument("hasFaces needs a radius: faces are as thick as it");
        const Use<SceneObject> object(scene.id, Access::write);
        sim::Scene& to = object->scene;
        const std::size_t grids = to.grids.size();
        Addition addition(to);
        const sim::Lattice added{.name = nameOr(given.name, "lattice"),
                                 .origin = toVec3(given.origin),
                                 .cells = {given.cells[0], given.cells[1], given.cells[2]},
                                 .spacing = given.spacing,
                                 .fill = {given.fill, given.fill + given.fillCount},
                                 .youngModulus = given.youngModulus,
                                 .poissonRatio = given.poissonRatio,
                                 .recovery = given.recovery,
                                 .density = given.density,
                                 .radius = given.radius,
                                 .hasBodyDiagonals = given.hasBodyDiagonals != 0,
                                 .isCuttable = given.isCuttable != 0,
                                 .tearStrain = given.tearStrain,
                                 .toughness = given.toughness};
        const sim::LatticeCorners corners = sim::addLattice(to, added);
        if (given.hasSkin != 0) sim::addLatticeSkin(to, added, corners, {0.78f, 0.36f, 0.32f});
        if (given.hasFaces != 0) {
            if (to.grids.size() == grids)
                invalidArgument("so far from the origin a lattice cannot have faces");
            sim::addSurfaceFaces(to, sim::Grid(to.grids.back()));
        }
        addition.keep();
        lastBody(to, body);
    });
}

SinewResult sinewAddMesh(SinewScene scene, const SinewMesh* mesh, uint32_t* body) {
    return call(__func__, [&] {
        const SinewMesh given = described(mesh, "SinewMesh", defaultMesh);
        const mesh::TriangleMesh made = meshOf(given);
        const Use<SceneObject> object(scene.id, Access::write);
        Addition addition(object->scene);
        addMeshBody(object->scene, made, given);
        addition.keep();
        lastBody(object->scene, body);
    });
}

} // extern "C"
