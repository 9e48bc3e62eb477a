// glTF 2.0, sections 3 (JSON), 3.9 (materials) and 4 (GLB): 12 bytes of head, a chunk of JSON, a chunk of
// binary, each padded to 4 bytes.
#include "mesh/export_gltf.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <ostream>

namespace sinew::mesh {
namespace {

using Json = nlohmann::json;

// Constants of the format.
constexpr int floats = 5126, wholeNumbers = 5125, vertexData = 34962, indexData = 34963;
constexpr std::uint32_t magic = 0x46546c67, jsonChunk = 0x4e4f534a, binaryChunk = 0x004e4942;

void append(std::string& bytes, std::uint32_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8)
        bytes.push_back(static_cast<char>(value >> shift & 0xffu));
}

void append(std::string& bytes, const Vec3& v) {
    for (const float value : {v.x, v.y, v.z}) append(bytes, std::bit_cast<std::uint32_t>(value));
}

// Unit vector; any direction for a normal without length, such as that of a triangle without area, because
// the format requires one.
Vec3 unit(const Vec3& v) {
    const double x = double{v.x}, y = double{v.y}, z = double{v.z}, length = std::sqrt(x * x + y * y + z * z);
    if (!(length > 1e-30) || !std::isfinite(length)) return {0, 1, 0};
    return {static_cast<float>(x / length), static_cast<float>(y / length), static_cast<float>(z / length)};
}

class Document {
public:
    explicit Document(const std::filesystem::path& file) : file_(file) {
        json_["asset"] = {{"version", "2.0"}, {"generator", "Sinew"}};
        json_["scene"] = 0;
        json_["scenes"] = Json::array({Json::object()});
    }

    void add(const ShadedMesh& mesh) {
        Json primitives = Json::array();
        for (const ShadedPart& part : mesh.parts)
            if (!part.triangles.empty()) primitives.push_back(primitive(mesh, part));
        if (primitives.empty()) return;
        const std::size_t index = json_["meshes"].size();
        json_["meshes"].push_back({{"name", mesh.name}, {"primitives", std::move(primitives)}});
        json_["nodes"].push_back({{"name", mesh.name}, {"mesh", index}});
        json_["scenes"][0]["nodes"].push_back(index);
    }

    void write(std::ostream& out) {
        if (!binary_.empty()) {
            json_["buffers"] = Json::array({Json::object({{"byteLength", binary_.size()}})});
            json_["materials"] = materials_;
        }
        // invalid UTF-8 in a name is replaced
        std::string text = json_.dump(-1, ' ', false, Json::error_handler_t::replace);
        text.append((4 - text.size() % 4) % 4, ' ');
        const std::size_t chunks = binary_.empty() ? 1 : 2,
                          size = 12 + 8 * chunks + text.size() + binary_.size();
        if (size > std::numeric_limits<std::uint32_t>::max())
            fail("more than 4 GiB do not fit in a GLB file", "take a coarser mesh");
        std::string head;
        for (const std::size_t word :
             {std::size_t{magic}, std::size_t{2}, size, text.size(), std::size_t{jsonChunk}})
            append(head, static_cast<std::uint32_t>(word));
        out << head << text;
        if (binary_.empty()) return;
        head.clear();
        append(head, static_cast<std::uint32_t>(binary_.size()));
        append(head, binaryChunk);
        out << head << binary_;
    }

private:
    [[noreturn]] void fail(const std::string& why, const std::string& whatToDo) const {
        throw ExportError("cannot write " + file_.string() + ": " + why + ": " + whatToDo);
    }

    Json primitive(const ShadedMesh& mesh, const ShadedPart& part) {
        const std::size_t count = part.positions.size();
        if (part.normals.size() != count) fail("a vertex has no normal", "report this");
        Json attributes;
        attributes["POSITION"] = positions(part);
        const std::size_t start = binary_.size();
        for (const Vec3& normal : part.normals) append(binary_, unit(normal));
        attributes["NORMAL"] =
            accessor(start, vertexData, {{"type", "VEC3"}, {"componentType", floats}, {"count", count}});
        return {{"attributes", std::move(attributes)},
                {"indices", indices(part)},
                {"material", material(mesh.color, part.isInside)}};
    }

    std::size_t positions(const ShadedPart& part) {
        const std::size_t start = binary_.size();
        std::array<float, 3> low, high;
        low.fill(std::numeric_limits<float>::max());
        high.fill(std::numeric_limits<float>::lowest());
        for (const Vec3& x : part.positions) {
            const std::array<float, 3> at{x.x, x.y, x.z};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (!std::isfinite(at[axis])) fail("a vertex is not finite", "report this");
                low[axis] = std::min(low[axis], at[axis]);
                high[axis] = std::max(high[axis], at[axis]);
            }
            append(binary_, x);
        }
        return accessor(start, vertexData,
                        {{"type", "VEC3"},
                         {"componentType", floats},
                         {"count", part.positions.size()},
                         {"min", low},
                         {"max", high}});
    }

    std::size_t indices(const ShadedPart& part) {
        const std::size_t start = binary_.size();
        for (const auto& triangle : part.triangles)
            for (const std::uint32_t vertex : triangle) {
                if (vertex >= part.positions.size())
                    fail("a triangle names a vertex that does not exist", "report this");
                append(binary_, vertex);
            }
        return accessor(
            start, indexData,
            {{"type", "SCALAR"}, {"componentType", wholeNumbers}, {"count", 3 * part.triangles.size()}});
    }

    // Adds an accessor for the data appended since `start`; all data are words of 4 bytes, so all are
    // aligned.
    std::size_t accessor(std::size_t start, int target, Json accessor) {
        accessor["bufferView"] = json_["bufferViews"].size();
        json_["bufferViews"].push_back({{"buffer", 0},
                                        {"byteOffset", start},
                                        {"byteLength", binary_.size() - start},
                                        {"target", target}});
        json_["accessors"].push_back(std::move(accessor));
        return json_["accessors"].size() - 1;
    }

    std::size_t material(const Vec3& color, bool isInside) {
        // like the viewer's inside: darker, and red whatever the skin is
        const auto shade = [isInside](float skin, float flesh) {
            return isInside ? 0.2f * skin + 0.6f * flesh : skin;
        };
        const Json base = {shade(color.x, 0.36f), shade(color.y, 0.035f), shade(color.z, 0.03f), 1};
        const Json made = {
            {"name", isInside ? "inside" : "outside"},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", base}, {"metallicFactor", 0}, {"roughnessFactor", isInside ? 0.35 : 0.6}}}};
        const auto found = std::ranges::find(materials_, made);
        const auto index = static_cast<std::size_t>(found - materials_.begin());
        if (found == materials_.end()) materials_.push_back(made);
        return index;
    }

    const std::filesystem::path& file_;
    Json json_;
    std::vector<Json> materials_;
    std::string binary_;
};

} // namespace

void exportGlb(const std::filesystem::path& file, std::span<const ShadedMesh> meshes) {
    writeWhole(file, [&](std::ostream& out) {
        Document document(file);
        for (const ShadedMesh& mesh : meshes) document.add(mesh);
        document.write(out);
    });
}

} // namespace sinew::mesh
