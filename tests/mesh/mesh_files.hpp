// Mesh files as bytes, in every format that can be imported, and a temporary folder.
#pragma once

#include "mesh/triangle_mesh.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::mesh::test {

/// A new empty folder; the destructor removes it with its contents.
class Folder {
public:
    Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder();

    std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

    /// Writes a file and returns its path.
    std::filesystem::path write(std::string_view name, std::string_view bytes) const;

private:
    std::filesystem::path path_;
};

std::string read(const std::filesystem::path& file);

std::string objText(const TriangleMesh& mesh);
std::string stlText(const TriangleMesh& mesh);
std::string stlBinary(const TriangleMesh& mesh);
std::string plyText(const TriangleMesh& mesh);
enum class ByteOrder { little, big };
std::string plyBinary(const TriangleMesh& mesh, ByteOrder order);

/// `nodes` is the JSON of the node list. Mesh 0 is `mesh`, and node 0 is the root.
std::string gltf(const TriangleMesh& mesh, std::string_view nodes = R"([{"mesh":0}])");
std::string glb(const TriangleMesh& mesh, std::string_view nodes = R"([{"mesh":0}])");

/// A mesh file of one format.
struct Sample {
    std::string name, bytes;
    bool isBinary = false;
};
std::vector<Sample> samplesOf(const TriangleMesh& mesh);

} // namespace sinew::mesh::test
