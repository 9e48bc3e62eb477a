// Notes and warnings about the meshes of a scene.
#pragma once

#include "scenes/load.hpp"
#include "scenes/place_mesh.hpp"
#include "scenes/section.hpp"

#include "mesh/bridges.hpp"

namespace sinew::scenes {

/// A length with the unit that suits it: "8.9 mm", "1.2 m".
std::string lengthWithUnit(double metres);
/// "1.43 kg".
std::string massText(double kilograms);
/// "24 x 21 x 14 voxels of 8.9 mm".
std::string voxelText(const mesh::VoxelGrid& grid);

/// How sentences call the mesh of a table, which is a `kind`: `mesh liver.obj`, with its `name` where it has
/// one `mesh "left" (liver.obj)`, and with its place where another body is of that file `mesh[1]
/// (liver.obj)`.
std::string calledIn(const LoadedScene& loaded, const Section& section, const std::string& kind,
                     const std::string& file);

/// "is 190 m long: if the file is in millimetres, say unit = \"mm\"" of a placed mesh; empty where its size
/// is usual, or asked for in metres.
std::string oddSizeOf(const Section& section, const mesh::MeshReport& surface);

/// Notes how large a mesh is, "mesh liver.obj: 0.21 x 0.18 x 0.12 m" and `more`, and warns where it seems to
/// have another unit than its section says.
void noteSize(LoadedScene& loaded, const std::string& name, const Section& section,
              const mesh::MeshReport& surface, const std::string& more);

/// "is scaled to 0.4 m, from 189 in units of the file: ...", of a mesh that was dropped.
std::string scaledText(double given, double metres);

/// Notes what components a mesh of several has, the ten largest of them by themselves.
void noteComponents(LoadedScene& loaded, const std::string& name,
                    const std::vector<mesh::Component>& components);

/// "has 2 components, 0.1 m apart at the nearest (\"part 1\" and \"part 2\"), that voxels of 0.2 m join";
/// empty where they join none.
std::string bridgesText(const mesh::Bridges& bridges, double voxel);

/// "\"liver\" and \"tumour\" touch or overlap", for the first ten pairs.
std::vector<std::string> overlapTexts(const mesh::Bridges& bridges);

/// "has a component inside out, \"part 2\": ...", for the first ten of several components; empty where there
/// is none. `how` the mesh was repaired decides on the cure.
std::string inwardText(const std::vector<mesh::Component>& components, mesh::Repair how,
                       Words words = Words::scene);

/// The share of a surface whose thickness is held against the voxels.
constexpr double thinnestShare = 0.05;

/// "is 6 mm thin ..., less than 2 voxels of 17 mm: resolution = 139 gives two", or which voxel does; empty
/// where it is thicker. `thickness` is that of the thinnest share, `longest` the side that has as many voxels
/// as the resolution, all in metres.
std::string thinText(double thickness, double longest, double voxel, bool saysVoxel,
                     Words words = Words::scene);

/// Notes each repair of an imported mesh: "mesh liver.obj: 3 holes were closed: 14 edges, 8 new triangles".
void noteRepairs(LoadedScene& loaded, const std::string& name, const mesh::Repairs& repairs);

/// "has a seam that is wider than the tolerance of 0.002 (units of the file): weld = 0.03 joins 64 of its
/// open edges"; empty where there is none.
/// `hasParts`: the mesh has others, or is a part of one, whose numbers may change by that.
std::string seamText(const mesh::Repairs& repairs, bool hasParts, Words words = Words::scene);
void warnOfSeam(LoadedScene& loaded, const std::string& name, const mesh::Repairs& repairs, bool hasParts);

/// "has no open edges that weld = 0.001 joins"; empty where it joins some, or `weld` is 0.
std::string vainWeldText(const mesh::Repairs& repairs, double weld, Words words = Words::scene);

/// The extent of a choice: "object takes 412 triangles, 31 x 20 x 10 around (12, 40, 3) in units of the
/// file".
std::string choiceText(const mesh::TriangleMesh& chosen);

/// Warns of what makes the inside of a mesh uncertain.
void warnOfDefects(const MeshSummary& summary, std::vector<std::string>& warnings);

} // namespace sinew::scenes
