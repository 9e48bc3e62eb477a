// Writers of OBJ and PLY, and the PLY layout of saved states. Numbers in OBJ are the shortest that read back
// to the same float; PLY is written little endian on any machine.
#include "mesh/export.hpp"

#include "mesh/import.hpp"

#include <array>
#include <bit>
#include <charconv>
#include <fstream>
#include <ostream>
#include <sstream>
#include <string_view>

namespace sinew::mesh {
namespace {

void appendNumber(std::string& line, float value) {
    std::array<char, 32> digits{};
    line.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

void appendLittleEndian(std::string& bytes, std::uint32_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8)
        bytes.push_back(static_cast<char>(value >> shift & 0xffu));
}

void appendLittleEndian(std::string& bytes, float value) {
    appendLittleEndian(bytes, std::bit_cast<std::uint32_t>(value));
}

float readLittleEndian(const char* bytes) {
    std::uint32_t value = 0;
    for (unsigned byte = 4; byte-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[byte]);
    return std::bit_cast<float>(value);
}

/// Replaces line breaks and control characters of a name, for text formats.
std::string oneLine(std::string text) {
    for (char& character : text)
        if (static_cast<unsigned char>(character) < ' ') character = ' ';
    return text;
}

constexpr std::string_view particleProperties = "property float x\nproperty float y\nproperty float z\n"
                                                "property float vx\nproperty float vy\nproperty float vz\n"
                                                "property float inverse_mass\nend_header\n";
constexpr std::string_view particleHead = "ply\nformat binary_little_endian 1.0\nelement vertex ";
constexpr std::size_t particleBytes = 28;

[[noreturn]] void failToRead(const std::filesystem::path& file, const std::string& why) {
    throw ImportError("cannot read particles: " + file.string() + ": " + why +
                      ": use a file that sinew wrote as its state");
}

} // namespace

void exportObj(const std::filesystem::path& file, std::span<const TriangleMesh> meshes) {
    writeWhole(file, [&](std::ostream& out) {
        std::string line;
        std::size_t first = 1; // first vertex of the mesh
        for (const TriangleMesh& mesh : meshes) {
            if (!mesh.name.empty()) out << "o " << oneLine(mesh.name) << '\n';
            for (const Vec3& position : mesh.positions) {
                line.assign(1, 'v');
                for (const float value : {position.x, position.y, position.z})
                    appendNumber(line += ' ', value);
                out << (line += '\n');
            }
            for (const auto& [a, b, c] : mesh.triangles)
                out << "f " << a + first << ' ' << b + first << ' ' << c + first << '\n';
            first += mesh.positions.size();
        }
    });
}

void exportPly(const std::filesystem::path& file, std::span<const TriangleMesh> meshes) {
    std::size_t vertices = 0, faces = 0;
    for (const TriangleMesh& mesh : meshes) {
        vertices += mesh.positions.size();
        faces += mesh.triangles.size();
    }
    writeWhole(file, [&](std::ostream& out) {
        out << "ply\nformat binary_little_endian 1.0\n";
        for (const TriangleMesh& mesh : meshes)
            if (!mesh.name.empty()) out << "comment " << oneLine(mesh.name) << '\n';
        out << "element vertex " << vertices
            << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << faces
            << "\nproperty list uchar uint vertex_indices\n"
            << (meshes.size() > 1 ? "property uint piece\n" : "") << "end_header\n";
        std::string bytes;
        for (const TriangleMesh& mesh : meshes)
            for (const Vec3& position : mesh.positions) {
                bytes.clear();
                for (const float value : {position.x, position.y, position.z})
                    appendLittleEndian(bytes, value);
                out << bytes;
            }
        std::uint32_t first = 0;
        for (std::uint32_t piece = 0; piece < meshes.size(); ++piece) {
            for (const auto& triangle : meshes[piece].triangles) {
                bytes.assign(1, '\3');
                for (const std::uint32_t vertex : triangle) appendLittleEndian(bytes, first + vertex);
                if (meshes.size() > 1) appendLittleEndian(bytes, piece);
                out << bytes;
            }
            first += static_cast<std::uint32_t>(meshes[piece].positions.size());
        }
    });
}

void exportObj(const std::filesystem::path& file, const TriangleMesh& mesh) {
    exportObj(file, std::span(&mesh, 1));
}

void exportPly(const std::filesystem::path& file, const TriangleMesh& mesh) {
    exportPly(file, std::span(&mesh, 1));
}

void exportParticles(const std::filesystem::path& file, std::span<const ParticleState> particles) {
    writeWhole(file, [&](std::ostream& out) {
        out << particleHead << particles.size() << '\n' << particleProperties;
        std::string bytes;
        for (const auto& [position, velocity, inverseMass] : particles) {
            bytes.clear();
            for (const float value :
                 {position.x, position.y, position.z, velocity.x, velocity.y, velocity.z, inverseMass})
                appendLittleEndian(bytes, value);
            out << bytes;
        }
    });
}

std::vector<ParticleState> importParticles(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        failToRead(file, error ? error.message() : "not a regular file");
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    std::ifstream in(file, std::ios::binary);
    if (error || !in) failToRead(file, error ? error.message() : "it cannot be opened");
    std::string head(particleHead.size(), '\0'), count, properties(particleProperties.size(), '\0');
    in.read(head.data(), static_cast<std::streamsize>(head.size()));
    for (int digit; in && count.size() < 12 && (digit = in.get()) != '\n';)
        count.push_back(static_cast<char>(digit));
    in.read(properties.data(), static_cast<std::streamsize>(properties.size()));
    std::uint64_t particles = 0;
    const auto parsed = std::from_chars(count.data(), count.data() + count.size(), particles);
    if (!in || head != particleHead || properties != particleProperties || count.empty() ||
        parsed.ptr != count.data() + count.size())
        failToRead(file, "its header is not that of a state");
    const std::uintmax_t headerBytes = head.size() + count.size() + 1 + properties.size();
    if (size != headerBytes + particles * particleBytes)
        failToRead(file,
                   std::to_string(particles) + " particles do not make " + std::to_string(size) + " bytes");
    std::vector<ParticleState> states(particles);
    std::array<char, particleBytes> bytes{};
    for (ParticleState& state : states) {
        in.read(bytes.data(), particleBytes);
        const auto at = [&](std::size_t i) { return readLittleEndian(bytes.data() + 4 * i); };
        state = {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, at(6)};
    }
    if (!in) failToRead(file, "it ends too early");
    return states;
}

} // namespace sinew::mesh
