// Writes files by the specifications of the formats. Shares no code with the exporters.
#include "mesh_files.hpp"

#include <array>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace sinew::mesh::test {
namespace {

namespace fs = std::filesystem;

std::string number(float value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.9g", double{value});
    return text.data();
}

std::string words(Vec3 p) {
    return number(p.x) + ' ' + number(p.y) + ' ' + number(p.z);
}

void append(std::string& bytes, std::uint32_t value, ByteOrder order = ByteOrder::little) {
    for (unsigned i = 0; i < 4; ++i)
        bytes.push_back(static_cast<char>(value >> 8 * (order == ByteOrder::little ? i : 3 - i) & 0xffu));
}

void append(std::string& bytes, float value, ByteOrder order = ByteOrder::little) {
    append(bytes, std::bit_cast<std::uint32_t>(value), order);
}

void append(std::string& bytes, Vec3 p, ByteOrder order = ByteOrder::little) {
    for (const float value : {p.x, p.y, p.z}) append(bytes, value, order);
}

std::string plyHead(const TriangleMesh& mesh, std::string_view format) {
    std::ostringstream out;
    out << "ply\nformat " << format << " 1.0\ncomment a test\nelement vertex " << mesh.positions.size()
        << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.triangles.size()
        << "\nproperty list uchar int vertex_indices\nend_header\n";
    return out.str();
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t j = 0; j < 3; ++j)
            group = group << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
        for (std::size_t j = 0; j < 4; ++j)
            text += i + j > bytes.size() ? '=' : digits[group >> (18 - 6 * j) & 63u];
    }
    return text;
}

/// A binary buffer with positions, then indices.
std::string buffer(const TriangleMesh& mesh) {
    std::string bytes;
    for (const Vec3& position : mesh.positions) append(bytes, position);
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle) append(bytes, vertex);
    return bytes;
}

std::string json(const TriangleMesh& mesh, std::string_view nodes, const std::string& uri) {
    const std::size_t vertexBytes = 12 * mesh.positions.size(), indexBytes = 12 * mesh.triangles.size();
    std::ostringstream out;
    out << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" << nodes
        << R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{)" << uri
        << R"("byteLength":)" << vertexBytes + indexBytes << R"(}],"bufferViews":[{"buffer":0,"byteLength":)"
        << vertexBytes << R"(},{"buffer":0,"byteOffset":)" << vertexBytes << R"(,"byteLength":)" << indexBytes
        << R"(}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)"
        << mesh.positions.size() << R"(},{"bufferView":1,"componentType":5125,"type":"SCALAR","count":)"
        << 3 * mesh.triangles.size() << "}]}";
    return out.str();
}

} // namespace

Folder::Folder() {
    std::string name = (fs::temp_directory_path() / "sinew-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for tests can be made");
    path_ = name;
}

Folder::~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

fs::path Folder::write(std::string_view name, std::string_view bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
}

std::string read(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string objText(const TriangleMesh& mesh) {
    std::string text = "# a test\nmtllib none.mtl\no thing\n";
    for (const Vec3& position : mesh.positions) text += "v " + words(position) + '\n';
    text += "vn 0 1 0\nusemtl red\ns off\n";
    for (const auto& triangle : mesh.triangles) {
        text += 'f';
        for (const std::uint32_t vertex : triangle) text += ' ' + std::to_string(vertex + 1) + "//1";
        text += '\n';
    }
    return text;
}

std::string stlText(const TriangleMesh& mesh) {
    std::string text = "solid thing\n";
    for (const auto& triangle : mesh.triangles) {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for (const std::uint32_t vertex : triangle)
            text += "      vertex " + words(mesh.positions[vertex]) + '\n';
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid thing\n";
}

std::string stlBinary(const TriangleMesh& mesh) {
    std::string bytes(80, '\0');
    bytes.replace(0, 5, "solid"); // many exporters write this against the specification
    append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles) {
        append(bytes, Vec3{});
        for (const std::uint32_t vertex : triangle) append(bytes, mesh.positions[vertex]);
        bytes.append(2, '\0');
    }
    return bytes;
}

std::string plyText(const TriangleMesh& mesh) {
    std::string text = plyHead(mesh, "ascii");
    for (const Vec3& position : mesh.positions) text += words(position) + '\n';
    for (const auto& [a, b, c] : mesh.triangles)
        text += "3 " + std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(c) + '\n';
    return text;
}

std::string plyBinary(const TriangleMesh& mesh, ByteOrder order) {
    std::string bytes =
        plyHead(mesh, order == ByteOrder::little ? "binary_little_endian" : "binary_big_endian");
    for (const Vec3& position : mesh.positions) append(bytes, position, order);
    for (const auto& triangle : mesh.triangles) {
        bytes.push_back('\3');
        for (const std::uint32_t vertex : triangle) append(bytes, vertex, order);
    }
    return bytes;
}

std::string gltf(const TriangleMesh& mesh, std::string_view nodes) {
    return json(mesh, nodes,
                R"("uri":"data:application/octet-stream;base64,)" + base64(buffer(mesh)) + R"(",)");
}

std::string glb(const TriangleMesh& mesh, std::string_view nodes) {
    std::string text = json(mesh, nodes, ""), data = buffer(mesh);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    data.resize((data.size() + 3) / 4 * 4, '\0');
    std::string bytes = "glTF";
    append(bytes, 2u);
    append(bytes, static_cast<std::uint32_t>(28 + text.size() + data.size()));
    append(bytes, static_cast<std::uint32_t>(text.size()));
    bytes += "JSON" + text;
    append(bytes, static_cast<std::uint32_t>(data.size()));
    return bytes.append("BIN\0", 4) + data;
}

std::vector<Sample> samplesOf(const TriangleMesh& mesh) {
    return {{"text.obj", objText(mesh), false},
            {"text.stl", stlText(mesh), false},
            {"binary.stl", stlBinary(mesh), true},
            {"text.ply", plyText(mesh), false},
            {"little.ply", plyBinary(mesh, ByteOrder::little), true},
            {"big.ply", plyBinary(mesh, ByteOrder::big), true},
            {"embedded.gltf", gltf(mesh), true},
            {"binary.glb", glb(mesh), true}};
}

} // namespace sinew::mesh::test
