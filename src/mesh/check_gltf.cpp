// Checks of glTF and GLB files: the chunks must add up, and the JSON is streamed through a handler that
// builds nothing: sizes within the file, nesting within 64 levels (assimp's parser recurses), version 2,
// buffers embedded.
#include "mesh/import_checks.hpp"

#include <nlohmann/json.hpp>

#include <vector>

namespace sinew::mesh {
namespace {

constexpr std::size_t deepest = 64;

class GltfHandler : public nlohmann::json_sax<nlohmann::json> {
public:
    explicit GltfHandler(std::uint64_t fileBytes) : fileBytes_(fileBytes) {}

    /// Throws Refusal for faults of the whole document. Sizes come last: those of an external buffer never
    /// fit in the file.
    void finish() const {
        if (!isVersion2_) throw Refusal("", "it is not glTF version 2: export the mesh again as glTF 2");
        if (wrongSize_) throw Refusal(*wrongSize_);
    }

    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t value) override {
        if (isSize() && value < 0) refuseSize("a size is negative: export the mesh again");
        return true;
    }
    bool number_unsigned(number_unsigned_t value) override {
        if (isSize() && value > fileBytes_)
            refuseSize(std::to_string(value) + " does not fit in a file of " + std::to_string(fileBytes_) +
                       " bytes: export the mesh again");
        return true;
    }
    bool number_float(number_float_t, const string_t&) override {
        if (isSize()) refuseSize("a size is not an integer: export the mesh again");
        return true;
    }
    bool string(string_t& value) override {
        if (keys_.size() == 3 && keys_[0] == "buffers" && keys_[2] == "uri" && !value.starts_with("data:"))
            throw Refusal(path(), "the mesh is kept in a second file, which is never opened: "
                                  "export it as GLB, or as glTF with embedded buffers");
        if (keys_.size() == 2 && keys_[0] == "asset" && keys_[1] == "version")
            isVersion2_ = value.starts_with("2.");
        return true;
    }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return open(); }
    bool key(string_t& name) override {
        keys_.back() = name;
        return true;
    }
    bool end_object() override { return close(); }
    bool start_array(std::size_t) override { return open(); }
    bool end_array() override { return close(); }
    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception&) override {
        throw Refusal("byte " + std::to_string(position),
                      "its JSON is damaged or cut short: export the mesh again");
    }

private:
    void refuseSize(const std::string& whyAndAdvice) {
        if (!wrongSize_) wrongSize_.emplace(path(), whyAndAdvice);
    }
    bool open() {
        if (keys_.size() == deepest)
            throw Refusal("", "its JSON is nested too deeply: export the mesh again");
        keys_.emplace_back();
        return true;
    }
    bool close() {
        keys_.pop_back();
        return true;
    }
    /// True for counts of elements and bytes, which the file size bounds: an element takes at least a byte.
    bool isSize() const {
        if (keys_.empty() || (keys_[0] != "accessors" && keys_[0] != "bufferViews" && keys_[0] != "buffers"))
            return false;
        const std::string& key = keys_.back();
        return key == "count" || key == "byteLength" || key == "byteOffset" || key == "byteStride";
    }
    std::string path() const {
        std::string text;
        for (const std::string& key : keys_) {
            if (!key.empty() && !text.empty()) text += '.';
            text += key.substr(0, 32);
        }
        return text;
    }

    std::uint64_t fileBytes_;
    std::vector<std::string> keys_;    ///< keys of the open objects; empty for an array
    std::optional<Refusal> wrongSize_; ///< the first wrong size
    bool isVersion2_ = false;
};

using Json = nlohmann::json;

/// The member `key` of item `index` of the top-level list `name` as a count; 0 if missing.
std::uint64_t countAt(const Json& document, const char* name, const Json& index, const char* key) {
    if (!index.is_number_unsigned() || !document.contains(name) || !document[name].is_array()) return 0;
    const auto place = index.get<std::uint64_t>();
    if (place >= document[name].size() || !document[name][place].is_object()) return 0;
    const Json count = document[name][place].value(key, Json());
    return count.is_number_unsigned() ? count.get<std::uint64_t>() : 0;
}

std::uint64_t countTriangles(const Json& document, const Json& primitive) {
    constexpr std::uint64_t triangles = 4, strip = 5, fan = 6;
    if (!primitive.is_object()) return 0;
    const Json mode = primitive.value("mode", Json(triangles));
    const Json attributes = primitive.value("attributes", Json::object());
    const Json corners = primitive.contains("indices") ? primitive["indices"]
                         : attributes.is_object()      ? attributes.value("POSITION", Json())
                                                       : Json();
    const std::uint64_t count = countAt(document, "accessors", corners, "count");
    if (mode == triangles) return count / 3;
    return (mode == strip || mode == fan) && count > 2 ? count - 2 : 0;
}

bool hasIntegerTexture(const Json& document, const Json& primitive) {
    constexpr std::uint64_t floats = 5126;
    if (!primitive.is_object()) return false;
    const Json attributes = primitive.value("attributes", Json::object());
    if (!attributes.is_object() || !attributes.contains("TEXCOORD_0")) return false;
    return countAt(document, "accessors", attributes["TEXCOORD_0"], "componentType") != floats;
}

/// Facts of all meshes, including those that no node shows. The document must have passed the handler above.
Announced announcedBy(std::string_view json) {
    const Json document = Json::parse(json.begin(), json.end(), nullptr, false);
    Announced announced;
    if (!document.is_object() || !document.contains("meshes") || !document["meshes"].is_array()) return {};
    for (const Json& mesh : document["meshes"]) {
        if (!mesh.is_object() || !mesh.contains("primitives") || !mesh["primitives"].is_array()) continue;
        for (const Json& primitive : mesh["primitives"]) {
            announced.triangles += countTriangles(document, primitive);
            announced.hasIntegerTexture |= hasIntegerTexture(document, primitive);
        }
    }
    return announced;
}

} // namespace

Announced checkGltf(std::string_view json, std::uint64_t fileBytes, const ImportLimits& limits) {
    GltfHandler handler(fileBytes);
    nlohmann::json::sax_parse(json.begin(), json.end(), &handler);
    handler.finish();
    const Announced announced = announcedBy(json);
    checkTriangleCount(announced.triangles, limits);
    return announced;
}

Announced checkGlb(std::string_view bytes, const ImportLimits& limits) {
    constexpr std::size_t headBytes = 12, chunkHeadBytes = 8;
    if (bytes.size() < headBytes + chunkHeadBytes)
        throw Refusal("", "the file ends too early: export the mesh again");
    if (readUint32(bytes, 4) != 2)
        throw Refusal("", "it is not glTF version 2: export the mesh again as glTF 2");
    if (readUint32(bytes, 8) > bytes.size())
        throw Refusal("", "it claims " + std::to_string(readUint32(bytes, 8)) + " bytes but has " +
                              std::to_string(bytes.size()) + ": export the mesh again");
    const std::string_view content = bytes.substr(0, readUint32(bytes, 8));
    std::size_t offset = headBytes;
    std::string_view json;
    for (int chunk = 0; offset + chunkHeadBytes <= content.size(); ++chunk) {
        const std::uint64_t size = readUint32(content, offset);
        if (size > content.size() - offset - chunkHeadBytes)
            throw Refusal("chunk " + std::to_string(chunk),
                          "it claims " + std::to_string(size) + " bytes, the file has " +
                              std::to_string(bytes.size()) + ": export the mesh again");
        if (chunk == 0) json = content.substr(offset + chunkHeadBytes, size);
        offset += chunkHeadBytes + size;
    }
    if (readUint32(bytes, headBytes + 4) != 0x4e4f534a) // "JSON"
        throw Refusal("chunk 0", "it is not JSON: export the mesh again");
    return checkGltf(json, bytes.size(), limits);
}

} // namespace sinew::mesh
