// The parent's part of the import: opens the file, runs a child process that checks and reads it, and
// validates all that the child returns.
#include "mesh/import.hpp"

#include "mesh/import_assimp.hpp"
#include "mesh/import_checks.hpp"
#include "mesh/sandbox.hpp"
#include "mesh/text_scanner.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace sinew::mesh {
namespace {

namespace fs = std::filesystem;

constexpr char meshMark = 'M', refusalMark = 'R'; ///< first byte of the child's answer
constexpr std::size_t triangleBytes = 9 * sizeof(float), textureBytes = 6 * sizeof(float);

std::string printable(std::string_view text) {
    std::string result(text.substr(0, 500));
    for (char& character : result)
        if (static_cast<unsigned char>(character) < ' ') character = ' ';
    return result;
}

[[noreturn]] void fail(const fs::path& file, const std::string& where, const std::string& whyAndAdvice) {
    throw ImportError("cannot read mesh: " + printable(file.string()) + (where.empty() ? "" : ":" + where) +
                      ": " + whyAndAdvice);
}

/// A descriptor of a regular file within the size limit, closed with this object.
class RegularFile {
public:
    RegularFile(const fs::path& file, const ImportLimits& limits) {
        // Checked first by name, because opening some devices has effects; then by descriptor, because the
        // name may refer to another file by then.
        struct stat status {};
        check(file, stat(file.c_str(), &status), status, limits);
        descriptor_ = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
        if (descriptor_ < 0)
            fail(file, "", std::string(std::strerror(errno)) + ": check the path and its permissions");
        try {
            check(file, fstat(descriptor_, &status), status, limits);
        } catch (...) {
            close(descriptor_);
            throw;
        }
        size_ = static_cast<std::size_t>(status.st_size);
    }
    RegularFile(const RegularFile&) = delete;
    RegularFile& operator=(const RegularFile&) = delete;
    ~RegularFile() { close(descriptor_); }

    std::string readAll(const fs::path& file) const {
        std::string bytes(size_, '\0');
        std::size_t done = 0;
        while (done < size_) {
            const ssize_t count = read(descriptor_, bytes.data() + done, size_ - done);
            if (count < 0 && errno != EINTR)
                fail(file, "", std::string(std::strerror(errno)) + ": check the disk");
            if (count == 0) break; // the file shrank meanwhile
            done += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
        }
        bytes.resize(done);
        return bytes;
    }

private:
    static void check(const fs::path& file, int result, const struct stat& status,
                      const ImportLimits& limits) {
        if (result != 0)
            fail(file, "", std::string(std::strerror(errno)) + ": check the path and its permissions");
        if (!S_ISREG(status.st_mode))
            fail(file, "",
                 std::string(S_ISDIR(status.st_mode) ? "it is a folder" : "it is not a regular file") +
                     ": give the name of a mesh file");
        if (static_cast<std::uint64_t>(status.st_size) > limits.fileBytes)
            fail(file, "",
                 "its " + std::to_string(status.st_size) + " bytes exceed the limit of " +
                     std::to_string(limits.fileBytes) + ": simplify the mesh");
    }

    int descriptor_ = -1;
    std::size_t size_ = 0;
};

Format formatOf(const fs::path& file, std::string_view bytes) {
    if (bytes.empty()) fail(file, "", "the file is empty: export the mesh again");
    if (const std::optional<Format> format = sniff(bytes)) return *format;
    // Damaged binary STL has no mark of its own; the file name is used for a better message only.
    if (file.extension() == ".stl" && bytes.substr(0, 84).find('\0') != std::string_view::npos)
        return Format::stl;
    fail(file, "",
         "its content is neither OBJ, STL, PLY, glTF nor GLB: export the mesh in one of these formats");
}

/// Content without a byte order mark, which some editors put before text.
std::string_view withoutMark(std::string_view bytes) {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    return bytes.substr(bytes.starts_with(mark) ? mark.size() : 0);
}

/// Removes objects and their names.
Soup nameless(Soup soup) {
    soup.objects.clear();
    soup.names.clear();
    return soup;
}

/// Replaces the names of nodes by `names`; `of` maps the index of a node to its object.
template <typename Of> Soup named(Soup soup, const ObjectNames& names, const Of& of) {
    if (names.all().empty()) return nameless(std::move(soup));
    for (std::uint32_t& object : soup.objects) object = of(object);
    soup.names = names.all();
    return soup;
}

Soup readObj(const Reduced& obj, const ImportLimits& limits) {
    Soup soup = readTriangles(Format::obj, obj.text, limits);
    std::vector<std::uint32_t> objects; // by node; the name of each node is the number of a run
    for (const std::string& name : soup.names) {
        const auto run = toInteger<std::size_t>(name);
        objects.push_back(run && *run < obj.objects.size() ? obj.objects[*run] : noObject);
    }
    return named(std::move(soup), obj.names, [&](std::uint32_t node) { return objects[node]; });
}

Soup readTextStl(const Reduced& stl, const ImportLimits& limits) {
    Soup soup = readTriangles(Format::stl, stl.text, limits);
    if (soup.objects.size() != stl.objects.size()) return nameless(std::move(soup));
    soup.objects = stl.objects;
    return named(std::move(soup), stl.names, [](std::uint32_t object) { return object; });
}

/// Objects named by the nodes themselves.
Soup withNodeNames(Soup soup) {
    ObjectNames names;
    std::vector<std::uint32_t> objects;
    for (const std::string& name : soup.names) objects.push_back(names.add(name));
    return named(std::move(soup), names, [&](std::uint32_t node) { return objects[node]; });
}

/// Checks and reads a file. Runs in the child.
Soup checkAndRead(Format format, std::string_view bytes, const ImportLimits& limits) {
    switch (format) {
    case Format::obj:
        return readObj(reduceObj(bytes, limits), limits);
    case Format::stl:
        return isTextStl(bytes) ? readTextStl(reduceTextStl(bytes, limits), limits)
                                : nameless(readTriangles(format, checkBinaryStl(bytes, limits), limits));
    case Format::ply: {
        const std::string obj = checkPly(bytes, limits);
        return nameless(obj.empty() ? readTriangles(format, bytes, limits)
                                    : readTriangles(Format::obj, obj, limits));
    }
    case Format::glb:
        return withNodeNames(readTriangles(format, bytes, limits, checkGlb(bytes, limits)));
    case Format::gltf:
        return withNodeNames(readTriangles(format, bytes, limits, checkGltf(bytes, bytes.size(), limits)));
    }
    throw Refusal("", "its format is unknown: report this");
}

template <typename T> void append(std::string& bytes, const std::vector<T>& values) {
    const std::size_t size = bytes.size();
    bytes.resize(size + values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(bytes.data() + size, values.data(), values.size() * sizeof(T));
}

/// The child's answer. Runs in the child. For a mesh: its mark, the number of names, the names with a zero
/// after each, 1 if there are texture coordinates or else 0, the corners, these coordinates, and the objects
/// if there are names.
std::string answer(Format format, std::string_view bytes, const ImportLimits& limits) {
    try {
        const Soup soup = checkAndRead(format, bytes, limits);
        std::string result(1, meshMark);
        append(result, std::vector{static_cast<std::uint32_t>(soup.names.size())});
        for (const std::string& name : soup.names) (result += name) += '\0';
        result += soup.textureCoordinates.empty() ? '\0' : '\1';
        append(result, soup.corners);
        append(result, soup.textureCoordinates);
        append(result, soup.objects);
        return result;
    } catch (const Refusal& refusal) {
        return refusalMark + refusal.where() + '\0' + refusal.what();
    }
}

/// Removes `count` values from the front of `bytes`, which must contain them.
template <typename T> std::vector<T> take(std::string_view& bytes, std::size_t count) {
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(T));
    bytes.remove_prefix(count * sizeof(T));
    return values;
}

/// Removes the number of names and the names from the front of `bytes`. False if they are invalid.
bool takeNames(std::string_view& bytes, std::vector<std::string>& names) {
    if (bytes.size() < sizeof(std::uint32_t)) return false;
    const std::uint32_t count = take<std::uint32_t>(bytes, 1)[0];
    if (count > mostObjects) return false;
    ObjectNames sound;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::size_t end = bytes.find('\0');
        if (end == std::string_view::npos || sound.add(bytes.substr(0, end)) != i) return false;
        bytes.remove_prefix(end + 1);
    }
    names = sound.all();
    return true;
}

std::vector<sim::TextureCorners> takeTexture(const fs::path& file, std::string_view& bytes,
                                             std::size_t triangles) {
    const auto values = take<float>(bytes, 6 * triangles);
    if (!std::ranges::all_of(values, [](float x) { return std::abs(double{x}) <= largestCoordinate; }))
        fail(file, "", "the importer failed (a texture coordinate is not finite): export the mesh again");
    std::vector<sim::TextureCorners> corners(triangles);
    for (std::size_t t = 0; t < triangles; ++t)
        for (std::size_t n = 0; n < 3; ++n)
            corners[t][n] = {values[6 * t + 2 * n], values[6 * t + 2 * n + 1]};
    return corners;
}

TriangleMesh decode(const fs::path& file, std::string_view bytes, const ImportLimits& limits) {
    const char mark = bytes.empty() ? '\0' : bytes.front();
    bytes.remove_prefix(std::min<std::size_t>(bytes.size(), 1));
    if (const std::size_t end = bytes.find('\0'); mark == refusalMark && end != std::string_view::npos)
        fail(file, printable(bytes.substr(0, end)), printable(bytes.substr(end + 1)));
    TriangleMesh mesh{.name = file.stem().string()};
    const bool isSound = mark == meshMark && takeNames(bytes, mesh.objectNames) && !bytes.empty();
    const bool isTextured = isSound && take<char>(bytes, 1)[0] != 0;
    const std::size_t size = triangleBytes + (isTextured ? textureBytes : 0) +
                             (mesh.objectNames.empty() ? 0 : sizeof(std::uint32_t));
    const std::size_t count = bytes.size() / size;
    if (!isSound || bytes.size() != count * size || count > limits.triangles)
        fail(file, "", "the importer failed (its answer is invalid): export the mesh again");
    const auto corners = take<float>(bytes, 9 * count);
    if (!std::ranges::all_of(corners, [](float x) { return std::abs(double{x}) <= largestCoordinate; }))
        fail(file, "", "the importer failed (a coordinate is not finite): repair the mesh");
    if (isTextured) mesh.textureCoordinates = takeTexture(file, bytes, count);
    mesh.objects = take<std::uint32_t>(bytes, bytes.size() / sizeof(std::uint32_t));
    for (std::uint32_t& object : mesh.objects)
        if (object >= mesh.objectNames.size()) object = noObject;
    mesh.positions.reserve(3 * count);
    mesh.triangles.reserve(count);
    for (std::size_t i = 0; i < corners.size(); i += 3)
        mesh.positions.push_back({corners[i], corners[i + 1], corners[i + 2]});
    for (std::uint32_t i = 0; i < mesh.positions.size(); i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
    return mesh;
}

} // namespace

TriangleMesh importMesh(const fs::path& file, MeshDefects& defects, const ImportLimits& limits, Repair how,
                        Repairs* repairs, double weldWithin) {
    const std::string content = RegularFile(file, limits).readAll(file);
    const std::string_view bytes = withoutMark(content);
    const Format format = formatOf(file, bytes);
    const double forSize = std::floor(static_cast<double>(bytes.size()) / limits.bytesPerSecond);
    std::string result;
    try {
        result = runInChild([&] { return answer(format, bytes, limits); },
                            {.addressSpaceBytes = limits.addressSpaceBytes,
                             .answerBytes = (1 << 20) + limits.triangles * (triangleBytes + textureBytes +
                                                                            sizeof(std::uint32_t)),
                             .cpuSeconds = limits.cpuSeconds + forSize,
                             .wallSeconds = limits.wallSeconds + 2 * forSize});
    } catch (const ChildFailure& failure) {
        fail(file, "",
             std::string("the importer failed (") + failure.what() +
                 "): the mesh is damaged or too large, export it again or simplify it");
    }
    TriangleMesh mesh = weld(decode(file, result, limits), defects);
    if (mesh.triangles.empty())
        fail(file, "", "all its faces have zero area: check the scale it was exported with");
    Repairs done;
    mesh = repair(std::move(mesh), how, defects, done, weldWithin);
    if (repairs) *repairs = done;
    return mesh;
}

} // namespace sinew::mesh
