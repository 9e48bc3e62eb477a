// Checked tables of a scene file become particles, links, planes and skins.
#pragma once

#include "scenes/faces.hpp"

namespace sinew::scenes {

/// A lattice particle costs about 500 bytes on the host, with its links, and again on the device: a file must
/// not be able to ask for all memory there is.
inline constexpr std::uint64_t mostParticles = 2'000'000;

/// Where a scene comes from and what surrounds it.
struct Source {
    std::string file;                                  ///< name that errors show
    std::filesystem::path folder;                      ///< mesh files must lie in it or below
    std::optional<std::filesystem::path> meshArgument; ///< the mesh of the command line
};

/// Fails where the value of `key` has not length 1.
void requireUnit(const Section& section, const char* key);

/// Whether the particles of a body touch others: `collides`, and where it is missing `cuttable`, so that what
/// a cut parts touches. Only `split` has contacts: without it, a body that says nothing touches nothing.
bool isColliding(const LoadedScene& loaded, const Section& body);

/// Notes in LoadedScene::defaults the bodies of a section, those from `first` on, if they touch by
/// default.
void noteDefaultContacts(LoadedScene& loaded, const Section& body, std::size_t first);
/// Lets the bodies from `firstBody` on be absent at first, if the table says so, with room for motions.
void letBeAbsent(LoadedScene& loaded, const Section& section, std::size_t firstBody);

/// Throws SceneError for `key`, which says how a body touches that touches nothing.
[[noreturn]] void refuseUntouching(const LoadedScene& loaded, const Section& body, const char* key);

/// As sim::Grid has it; 0 = never tears.
float tearStrainOf(const Section& body);
float toughnessOf(const Section& body);

void addCloth(LoadedScene& loaded, const Section& cloth);
void addChain(LoadedScene& loaded, const Section& chain);
void addBox(LoadedScene& loaded, const Section& box, FaceChoices& faces);
/// `voxel` overrides the file's voxel size [m].
void addMesh(LoadedScene& loaded, const Section& mesh, const Source& source, std::optional<float> voxel,
             FaceChoices& faces);
void addParticles(LoadedScene& loaded, const Section& particles);
/// What never moves: after the bodies that do.
void addMeshCollider(LoadedScene& loaded, const Section& section, const Source& source);
/// The triangles of a table with `file` or `generate`, where its other keys place them.
struct PlacedMesh {
    mesh::TriangleMesh mesh;
    sim::Vec3 middle; ///< of its bounding box [m]
    std::string file; ///< as reports show it
    mesh::Repairs repairs;
    std::vector<std::string> notes; ///< what follows the name of the mesh in them
    std::string odd; ///< "is 190 m long: if the file is in millimetres ..."; empty where its size is usual
};
PlacedMesh placedMesh(const Section& section, const Source& source, const std::array<double, 3>& origin);
/// All [[hold]] of a file: after the bodies that move, before those that do not.
void addHolds(LoadedScene& loaded, const Section& top, const Source& source);
void addPlane(LoadedScene& loaded, const Section& plane);
void addCollider(LoadedScene& loaded, const Section& collider);
/// `shape` of a table, if it is a sphere, a capsule or a box; else fails with these and `others` as choices.
void readShape(const Section& section, sim::Collider& collider, const std::string& others = "");

} // namespace sinew::scenes
