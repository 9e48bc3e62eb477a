// Converts a triangle mesh to a lattice body with the mesh as its skin.
#pragma once

#include "mesh/voxelise.hpp"

namespace sinew::mesh {

struct MeshBody {
    std::string name = "mesh";
    VoxelRequest voxels;
    std::size_t mostParticles = 0; ///< more than 0: voxels as fine as this limit allows, not as `voxels`
    float youngModulus = 2e4f;     ///< [Pa]
    float poissonRatio = 0.25f;    ///< 0.25 to 0.49
    float recovery = 0;            ///< sim::Lattice::recovery
    float density = 1000;          ///< [kg/m^3]
    bool touchesParticles = false; ///< each particle has a radius of half a voxel
    /// sim::Grid::isCuttable. The skin is split along the cells, into three to seven times as many triangles,
    /// and has sim::Skin::anchors: it is clipped along cuts and shows the inside.
    bool isCuttable = false;
    float tearStrain = 0;            ///< sim::Grid::tearStrain
    std::uint32_t tearsPerStep = 16; ///< sim::Grid::tearsPerStep
    float toughness = 0;             ///< sim::Grid::toughness [J/m^2]
    Vec3 color{0.78f, 0.36f, 0.32f};
};

/// The surface that a body shows. Only a closed surface that can be bound to the voxels can show the inside
/// along cuts, so a body that may be cut uses the first of these that can.
enum class Shown {
    mesh,    ///< the mesh unchanged
    wrapped, ///< wrap(): the mesh is open, intersects itself or is too thin in places
    voxels,  ///< the outer faces of its voxels: the mesh encloses nothing, or is too thin everywhere
};

struct AddedMesh {
    VoxelGrid voxels;
    Shown shown = Shown::mesh;
};

/// Appends particles on the corners of the filled cells, links, a body (restVolume = the mesh's volume if it
/// is closed and no parts of it overlap, else the filled volume) and the skin, with every vertex in the cell
/// that contains it. Corners outside the surface get a negative contact offset (minus their distance to it),
/// so that the skin, not the hull of cells, rests on a plane. The skin has the mesh's texture coordinates
/// unless another surface is shown (AddedMesh::shown). Returns the voxels and the kind of skin, for
/// reports. Throws std::invalid_argument if the mesh is empty.
AddedMesh addMesh(sim::Scene& scene, const TriangleMesh& mesh, const MeshBody& body);

} // namespace sinew::mesh
