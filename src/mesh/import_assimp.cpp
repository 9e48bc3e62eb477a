// Only the importer of the given format is registered; it reads from memory, and every other file name is
// refused.
//
// Two steps of assimp's post-processing are left out: joining identical vertices (its tolerance of 1e-5 is
// absolute, so a mesh of 20 um lost 17 of 441 vertices) and dropping degenerate triangles (below 1e-6 in
// area, absolute too, and uncounted). weld() does both exactly, and counts.
#include "mesh/import_assimp.hpp"

#include "mesh/vector3.hpp"

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cstring>
#include <vector>

namespace sinew::mesh {
namespace {

class MemoryStream : public Assimp::IOStream {
public:
    explicit MemoryStream(std::string_view bytes) : bytes_(bytes) {}

    std::size_t Read(void* buffer, std::size_t size, std::size_t count) override {
        const std::size_t items = size == 0 ? 0 : std::min(count, (bytes_.size() - offset_) / size);
        std::memcpy(buffer, bytes_.data() + offset_, items * size);
        offset_ += items * size;
        return items;
    }
    std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override {
        const std::size_t base = origin == aiOrigin_SET   ? 0
                                 : origin == aiOrigin_CUR ? offset_
                                                          : bytes_.size();
        if (offset > bytes_.size() - base) // also if assimp means a negative offset
            return aiReturn_FAILURE;
        offset_ = base + offset;
        return aiReturn_SUCCESS;
    }
    std::size_t Tell() const override { return offset_; }
    std::size_t FileSize() const override { return bytes_.size(); }
    void Flush() override {}

private:
    std::string_view bytes_;
    std::size_t offset_ = 0;
};

/// A file system of one file.
class OneFile : public Assimp::IOSystem {
public:
    OneFile(std::string name, std::string_view bytes) : name_(std::move(name)), bytes_(bytes) {}

    bool Exists(const char* name) const override { return name_ == name; }
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* name, const char* mode) override {
        return Exists(name) && mode[0] == 'r' ? new MemoryStream(bytes_) : nullptr; // assimp calls Close
    }
    void Close(Assimp::IOStream* stream) override { delete stream; }

private:
    std::string name_;
    std::string_view bytes_;
};

struct ImporterOf {
    Format format;
    const char *name, *file; ///< assimp's name of the importer; a file name that it accepts
};
constexpr std::array<ImporterOf, 5> importers{
    {{Format::obj, "Wavefront Object Importer", "mesh.obj"},
     {Format::stl, "Stereolithography (STL) Importer", "mesh.stl"},
     {Format::ply, "Stanford Polygon Library (PLY) Importer", "mesh.ply"},
     {Format::glb, "glTF2 Importer", "mesh.glb"},
     {Format::gltf, "glTF2 Importer", "mesh.gltf"}}};

void keepOnly(Assimp::Importer& assimp, std::string_view name) {
    std::vector<Assimp::BaseImporter*> others;
    for (std::size_t i = 0; i < assimp.GetImporterCount(); ++i)
        if (assimp.GetImporterInfo(i)->mName != name) others.push_back(assimp.GetImporter(i));
    for (Assimp::BaseImporter* other : others)
        assimp.UnregisterLoader(other); // never freed: the child ends soon
    if (assimp.GetImporterCount() != 1)
        throw Refusal("", "this build of assimp cannot read the format: install libassimp5");
}

/// Repeats assimp's own checks of indices, which its validation does not always reach, and checks every
/// float.
void check(const aiScene& scene) {
    for (unsigned number = 0; number < scene.mNumMeshes; ++number) {
        const aiMesh& mesh = *scene.mMeshes[number];
        const std::string head = scene.mNumMeshes > 1 ? "mesh " + std::to_string(number) + " " : "";
        for (unsigned vertex = 0; vertex < mesh.mNumVertices; ++vertex)
            for (unsigned axis = 0; axis < 3; ++axis)
                if (const double value = double{mesh.mVertices[vertex][axis]};
                    !(std::abs(value) <= largestCoordinate))
                    checkCoordinate(value, head + "vertex " + std::to_string(vertex));
        for (unsigned face = 0; face < mesh.mNumFaces; ++face)
            for (unsigned corner = 0; corner < mesh.mFaces[face].mNumIndices; ++corner)
                if (mesh.mFaces[face].mIndices[corner] >= mesh.mNumVertices)
                    throw Refusal(head + "face " + std::to_string(face),
                                  "it names a vertex that does not exist: export the mesh again");
    }
}

std::uint64_t countTriangles(const aiScene& scene) {
    std::uint64_t count = 0;
    for (unsigned number = 0; number < scene.mNumMeshes; ++number) {
        const aiMesh& mesh = *scene.mMeshes[number];
        for (unsigned face = 0; face < mesh.mNumFaces; ++face)
            count += mesh.mFaces[face].mNumIndices == 3 ? 1 : 0;
    }
    return count;
}

const aiScene& load(Assimp::Importer& assimp, const ImporterOf& importer, std::uint64_t announced) {
    const aiScene* scene = assimp.ReadFile(importer.file, 0);
    if (scene != nullptr) {
        check(*scene); // before post-processing renumbers anything
        if (countTriangles(*scene) < announced)
            throw Refusal("", "a face names a vertex that does not exist: export the mesh again");
        assimp.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
        // It would drop the coordinates of a part that has one texel, and of one with a single NaN.
        assimp.SetPropertyBool(AI_CONFIG_PP_FID_IGNORE_TEXTURECOORDS, true);
        scene = assimp.ApplyPostProcessing(aiProcess_ValidateDataStructure | aiProcess_Triangulate |
                                           aiProcess_FindInvalidData | aiProcess_SortByPType);
    }
    if (scene == nullptr)
        throw Refusal("", std::string("the importer says \"") + assimp.GetErrorString() +
                              "\": export the mesh again");
    check(*scene);
    return *scene;
}

Eigen::Affine3d toAffine(const aiMatrix4x4& m) {
    Eigen::Affine3d result = Eigen::Affine3d::Identity();
    for (unsigned row = 0; row < 3; ++row)
        for (unsigned column = 0; column < 4; ++column) result(row, column) = double{m[row][column]};
    return result;
}

/// Texture coordinates of a vertex in the first set; (0, 0) if there are none, or none that are finite.
std::array<float, 2> texturePointOf(const aiMesh& mesh, unsigned vertex) {
    if (!mesh.HasTextureCoords(0)) return {0, 0};
    const aiVector3D& at = mesh.mTextureCoords[0][vertex];
    const bool isUsable =
        std::abs(double{at.x}) <= largestCoordinate && std::abs(double{at.y}) <= largestCoordinate;
    return isUsable ? std::array<float, 2>{at.x, at.y} : std::array<float, 2>{0, 0};
}

/// Appends a mesh. A mirroring transform inverts triangles; they are reversed again.
void append(const aiMesh& mesh, const Eigen::Affine3d& transform, bool isTextured, Soup& soup) {
    const bool isMirrored = transform.linear().determinant() < 0;
    for (unsigned face = 0; face < mesh.mNumFaces; ++face) {
        const aiFace& triangle = mesh.mFaces[face];
        if (triangle.mNumIndices != 3) continue;
        for (unsigned corner = 0; corner < 3; ++corner) {
            const unsigned vertex = triangle.mIndices[isMirrored ? 2 - corner : corner];
            const aiVector3D& x = mesh.mVertices[vertex];
            const Vector3 moved = transform * Vector3(double{x.x}, double{x.y}, double{x.z});
            for (unsigned axis = 0; axis < 3; ++axis) {
                checkCoordinate(moved[axis], "face " + std::to_string(face));
                soup.corners.push_back(static_cast<float>(moved[axis]));
            }
            if (!isTextured) continue;
            for (const float value : texturePointOf(mesh, vertex)) soup.textureCoordinates.push_back(value);
        }
    }
}

/// Name of a node's object. Assimp invents names such as "nodes[3]" and "meshes[3]-1", and numbers the parts
/// of a mesh: "liver-1".
std::string nameOf(const aiNode& node, const aiMesh& mesh) {
    const std::string_view name(node.mName.C_Str(), node.mName.length);
    if (!name.starts_with("nodes[")) return std::string(name);
    const std::string_view other(mesh.mName.C_Str(), mesh.mName.length);
    if (other.starts_with("meshes[")) return {};
    return std::string(node.mNumMeshes > 1 ? other.substr(0, other.rfind('-')) : other);
}

} // namespace

Soup readTriangles(Format format, std::string_view bytes, const ImportLimits& limits,
                   const Announced& announced) {
    const ImporterOf& importer = *std::ranges::find(importers, format, &ImporterOf::format);
    Assimp::Importer assimp;
    keepOnly(assimp, importer.name);
    assimp.SetIOHandler(new OneFile(importer.file, bytes)); // owned by assimp
    const aiScene& scene = load(assimp, importer, announced.triangles);

    Soup soup;
    const bool isTextured = !announced.hasIntegerTexture &&
                            std::any_of(scene.mMeshes, scene.mMeshes + scene.mNumMeshes,
                                        [](const aiMesh* mesh) { return mesh->HasTextureCoords(0); });
    std::vector<std::pair<const aiNode*, Eigen::Affine3d>> open{
        {scene.mRootNode, Eigen::Affine3d::Identity()}};
    std::uint64_t triangles = 0;
    while (!open.empty()) {
        const auto [node, parent] = open.back();
        open.pop_back();
        const Eigen::Affine3d transform = parent * toAffine(node->mTransformation);
        for (unsigned i = 0; i < node->mNumMeshes; ++i) {
            const aiMesh& mesh = *scene.mMeshes[node->mMeshes[i]];
            triangles += mesh.mNumFaces; // several nodes may share a mesh
            if (triangles > limits.triangles) checkTriangleCount(triangles, limits);
            append(mesh, transform, isTextured, soup);
            if (i == 0) soup.names.push_back(nameOf(*node, mesh));
            soup.objects.resize(soup.corners.size() / 9, static_cast<std::uint32_t>(soup.names.size() - 1));
        }
        for (unsigned i = node->mNumChildren; i-- > 0;) open.emplace_back(node->mChildren[i], transform);
    }
    checkTriangleCount(triangles, limits);
    return soup;
}

} // namespace sinew::mesh
