// The parent's side of the wall: opens the one file, lets a child check and read it, and believes nothing the
// child says.
#include "mesh/import.hpp"

#include "mesh/import_assimp.hpp"
#include "mesh/import_checks.hpp"
#include "mesh/sandbox.hpp"

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
constexpr std::size_t triangleBytes = 9 * sizeof(float);

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
        // First by name: opening some devices has effects. Then by descriptor: the name may mean another file
        // by now.
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
            if (count == 0) break; // it shrank meanwhile
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
    // Damaged binary STL has no mark of its own; its name makes for a better message, and for nothing else.
    if (file.extension() == ".stl" && bytes.substr(0, 84).find('\0') != std::string_view::npos)
        return Format::stl;
    fail(file, "",
         "its content is neither OBJ, STL, PLY, glTF nor GLB: export the mesh in one of these formats");
}

/// Some editors put a byte order mark before text.
std::string_view withoutMark(std::string_view bytes) {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    return bytes.substr(bytes.starts_with(mark) ? mark.size() : 0);
}

/// Runs in the child.
std::vector<float> checkAndRead(Format format, std::string_view bytes, const ImportLimits& limits) {
    switch (format) {
    case Format::obj:
        return readTriangles(format, reduceObj(bytes, limits), limits);
    case Format::stl:
        return isTextStl(bytes) ? readTriangles(format, reduceTextStl(bytes, limits), limits)
                                : readTriangles(format, checkBinaryStl(bytes, limits), limits);
    case Format::ply: {
        const std::string obj = checkPly(bytes, limits);
        return obj.empty() ? readTriangles(format, bytes, limits) : readTriangles(Format::obj, obj, limits);
    }
    case Format::glb:
        return readTriangles(format, bytes, limits, checkGlb(bytes, limits));
    case Format::gltf:
        return readTriangles(format, bytes, limits, checkGltf(bytes, bytes.size(), limits));
    }
    throw Refusal("", "its format is unknown: report this");
}

/// Runs in the child.
std::string answer(Format format, std::string_view bytes, const ImportLimits& limits) {
    try {
        const std::vector<float> corners = checkAndRead(format, bytes, limits);
        std::string result(1 + corners.size() * sizeof(float), meshMark);
        std::memcpy(result.data() + 1, corners.data(), corners.size() * sizeof(float));
        return result;
    } catch (const Refusal& refusal) {
        return refusalMark + refusal.where() + '\0' + refusal.what();
    }
}

TriangleMesh decode(const fs::path& file, std::string_view bytes, const ImportLimits& limits) {
    const char mark = bytes.empty() ? '\0' : bytes.front();
    bytes.remove_prefix(std::min<std::size_t>(bytes.size(), 1));
    if (const std::size_t end = bytes.find('\0'); mark == refusalMark && end != std::string_view::npos)
        fail(file, printable(bytes.substr(0, end)), printable(bytes.substr(end + 1)));
    if (mark != meshMark || bytes.size() % triangleBytes != 0 ||
        bytes.size() / triangleBytes > limits.triangles)
        fail(file, "", "the importer failed (its answer makes no sense): export the mesh again");
    std::vector<float> corners(bytes.size() / sizeof(float));
    std::memcpy(corners.data(), bytes.data(), bytes.size());
    if (!std::ranges::all_of(corners, [](float x) { return std::abs(double{x}) <= largestCoordinate; }))
        fail(file, "", "the importer failed (a coordinate is not finite): repair the mesh");
    TriangleMesh mesh{.name = file.stem().string()};
    for (std::size_t i = 0; i < corners.size(); i += 3)
        mesh.positions.push_back({corners[i], corners[i + 1], corners[i + 2]});
    for (std::uint32_t i = 0; i < mesh.positions.size(); i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
    return mesh;
}

} // namespace

TriangleMesh importMesh(const fs::path& file, MeshDefects& defects, const ImportLimits& limits) {
    const std::string content = RegularFile(file, limits).readAll(file);
    const std::string_view bytes = withoutMark(content);
    const Format format = formatOf(file, bytes);
    const double forSize = std::floor(static_cast<double>(bytes.size()) / limits.bytesPerSecond);
    std::string result;
    try {
        result = runInChild([&] { return answer(format, bytes, limits); },
                            {.addressSpaceBytes = limits.addressSpaceBytes,
                             .answerBytes = 4096 + limits.triangles * triangleBytes,
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
    return mesh;
}

} // namespace sinew::mesh
