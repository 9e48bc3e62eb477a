// Tests mesh import with damaged files made here: prefixes, flipped bytes, hostile headers, noise. Each file
// is read or refused with a one-line error. The parent process stays small and keeps no child and no file
// descriptor.
#include "mesh/import.hpp"

#include "mesh/generate.hpp"
#include "mesh_files.hpp"
#include "meshes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <sys/resource.h>
#include <sys/wait.h>

using namespace sinew::mesh;
using namespace sinew::mesh::test;

namespace {

enum class Outcome { read, refused };

/// Whether the text is one line of the form "cannot read mesh: <where>: <why>: <what to do>".
bool isSentence(std::string_view text) {
    const std::size_t where = text.find(": "), why = text.find(": ", where + 2),
                      advice = text.find(": ", why + 2);
    return text.starts_with("cannot read mesh: ") && advice != text.npos && advice + 2 < text.size() &&
           std::ranges::none_of(text, [](char c) { return static_cast<unsigned char>(c) < ' '; });
}

bool isControl(char c) {
    return static_cast<unsigned char>(c) < ' ' || c == 0x7f;
}

/// One file of each kind, and two with named objects.
std::vector<Sample> namedSamplesOf(const TriangleMesh& mesh) {
    std::vector<Sample> samples = samplesOf(mesh);
    std::string obj = objText(mesh);
    for (std::size_t line = obj.find("\nf"), i = 0; line != obj.npos; line = obj.find("\nf", line + 10))
        obj.insert(line, "\no part " + std::to_string(i++ % 3));
    samples.push_back({"named.obj", obj, false});
    samples.push_back({"named.gltf",
                       gltf(mesh, R"([{"children":[1,2]},{"mesh":0,"name":"one"},{"mesh":0,"name":"two"}])"),
                       true});
    return samples;
}

/// Imports the file and checks the properties that every outcome must have.
Outcome outcome(const std::filesystem::path& file, const std::string& what) {
    try {
        MeshDefects defects;
        const TriangleMesh mesh = importMesh(file, defects);
        EXPECT_FALSE(mesh.triangles.empty()) << what;
        for (const Vec3& p : mesh.positions)
            EXPECT_TRUE(std::abs(p.x) <= 1e9f && std::abs(p.y) <= 1e9f && std::abs(p.z) <= 1e9f) << what;
        for (const auto& triangle : mesh.triangles)
            for (const std::uint32_t vertex : triangle) EXPECT_LT(vertex, mesh.positions.size()) << what;
        EXPECT_TRUE(mesh.objects.empty() || mesh.objects.size() == mesh.triangles.size()) << what;
        for (const std::uint32_t object : mesh.objects)
            EXPECT_TRUE(object == noObject || object < mesh.objectNames.size()) << what;
        for (const std::string& name : mesh.objectNames)
            EXPECT_TRUE(!name.empty() && name.size() <= 64 && std::ranges::none_of(name, isControl)) << what;
        return Outcome::read;
    } catch (const ImportError& error) {
        EXPECT_TRUE(isSentence(error.what())) << what << ": " << error.what();
        return Outcome::refused;
    }
}

long peakMiB(int who) {
    rusage usage{};
    getrusage(who, &usage);
    return usage.ru_maxrss / 1024;
}

/// Checks that memory, children and descriptors of this process are the same after a test as before.
class Malformed : public testing::Test {
protected:
    static std::size_t descriptors() {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
    }
    void TearDown() override {
        EXPECT_EQ(descriptors(), descriptorsBefore_);
        EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
        EXPECT_LT(peakMiB(RUSAGE_SELF), peakBefore_ + 256);
        EXPECT_LT(peakMiB(RUSAGE_CHILDREN), peakBefore_ + 1100);
    }
    const Folder folder_;

private:
    std::size_t descriptorsBefore_ = descriptors();
    long peakBefore_ = peakMiB(RUSAGE_SELF);
};

} // namespace

TEST_F(Malformed, EveryPrefixIsReadOrRefused) {
    for (const Sample& sample : namedSamplesOf(box({0, 0, 0}, {1, 2, 3}))) {
        const std::size_t size = sample.bytes.size();
        for (std::size_t length = 1; length < size; length += size / 40 + 1) {
            const std::string what = sample.name + " cut to " + std::to_string(length);
            const Outcome result = outcome(folder_.write(sample.name, sample.bytes.substr(0, length)), what);
            EXPECT_TRUE(result == Outcome::refused || !sample.isBinary) << what;
        }
        for (std::size_t cut = 1; cut < 4; ++cut)
            outcome(folder_.write(sample.name, sample.bytes.substr(0, size - cut)), sample.name);
    }
}

TEST_F(Malformed, FlippedBytesAreReadOrRefused) {
    Random random(20240607);
    for (const Sample& sample : namedSamplesOf(generate("sphere", 8)))
        for (int round = 0; round < 25; ++round) {
            std::string bytes = sample.bytes;
            for (int flip = 0; flip <= round / 5; ++flip)
                bytes[random.next() % bytes.size()] = static_cast<char>(random.next() & 0xffu);
            outcome(folder_.write(sample.name, bytes), sample.name + " round " + std::to_string(round));
        }
}

TEST_F(Malformed, NoiseIsRefused) {
    Random random(1);
    for (const std::size_t size : {1u, 4u, 12u, 83u, 84u, 85u, 134u, 1000u, 100'000u}) {
        std::string bytes(size, '\0');
        for (char& byte : bytes) byte = static_cast<char>(random.next() & 0xffu);
        for (const std::string_view name : {"a.obj", "a.stl", "a.ply", "a.glb", "a.gltf"})
            EXPECT_EQ(outcome(folder_.write(name, bytes), std::to_string(size)), Outcome::refused);
        for (const std::string_view head : {"glTF", "ply\n", "solid ", "{", "v 0 0 0\n"})
            EXPECT_EQ(outcome(folder_.write("b", std::string(head) + bytes), std::string(head)),
                      Outcome::refused);
    }
}

TEST_F(Malformed, HostilePlyHeadersAreRefused) {
    const std::string head = "ply\nformat ascii 1.0\n";
    const std::string vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
    const std::string body = "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    EXPECT_EQ(outcome(folder_.write("a.ply", head + vertices + faces + body), "good"), Outcome::read);
    for (const std::string& bytes : {
             head + vertices + faces,                                              // no end
             head + vertices + body,                                               // no faces
             head + faces + body,                                                  // no vertices
             vertices + faces + body,                                              // no format
             "ply\n" + vertices + faces + body,                                    //
             head + head + vertices + faces + body,                                // two formats
             head + "property float x\n" + vertices + faces + body,                // a property of nothing
             head + vertices + "property list uchar int x\n" + faces + body,       // a fourth coordinate
             head + vertices + faces + "element edge 4000000000\n" + body,         // elements of zero bytes
             head + vertices + faces + "element edge 1\nproperty quad x\n" + body, // a fractional list length
             head + vertices + faces + "property list float int x\n" + body, // a length that is no integer
             head + vertices + faces + "whatever\n" + body,                  //
             head + vertices + faces +
                 "end_header\n0 0 0\n1 0 0\n0 1 0\n255 0 1 2\n", // a list longer than its line
             head + vertices + faces + "end_header\n0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n",  //
             head + vertices + faces + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",   // an index too large
             head + vertices + faces + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n", //
             head + vertices + faces + "end_header\n0 0 0\n1 0 0\n0 1\n3 0 1 2\n",     // a line too short
             head + vertices + faces + "end_header\n0 0 0\n1 0 0\n0 1 0\n",            // a line is missing
         })
        EXPECT_EQ(outcome(folder_.write("a.ply", bytes), bytes), Outcome::refused) << bytes;
    std::string many = head + vertices;
    for (int i = 0; i < 1000; ++i) many += "property float p" + std::to_string(i) + "\n";
    EXPECT_EQ(outcome(folder_.write("a.ply", many + faces + body), "1000 properties"), Outcome::refused);
}

TEST_F(Malformed, HostileJsonIsRefused) {
    const std::string good = gltf(box({0, 0, 0}, {1, 1, 1}));
    EXPECT_EQ(outcome(folder_.write("a.gltf", good), "good"), Outcome::read);
    const auto replaced = [&](std::string_view from, std::string_view to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    for (const std::string& text :
         {std::string(1'000'000, '['), std::string(1'000'000, '{'),
          std::string("{\"a\":") + std::string(100'000, '['), replaced("2.0", "1.0"),
          replaced(R"("mesh":0)", R"("mesh":7)"), replaced(R"("nodes":[0])", R"("nodes":[9])"),
          replaced(R"([{"mesh":0}])", R"([{"children":[0],"mesh":0}])"), replaced("VEC3", "MAT4"),
          replaced(R"("indices":1)", R"("indices":0)"), replaced(R"("bufferView":1)", R"("bufferView":5)"),
          replaced(R"("byteLength":)", R"("byteLength":-)"), replaced(R"("count":)", R"("count":-)"),
          replaced("base64,", "base64,!!!!"), replaced("base64,", ""),
          replaced(R"("scene":0)", R"("scene":[])")})
        EXPECT_EQ(outcome(folder_.write("a.gltf", text), text.substr(0, 200)), Outcome::refused)
            << text.substr(0, 400);
}

TEST_F(Malformed, LongLinesAndManyPolygonsStayBounded) {
    std::string fan = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
    for (int i = 0; i < 200'000; ++i) fan += " 1 2 3";
    outcome(folder_.write("fan.obj", fan), "one face of 600,000 corners");
    outcome(folder_.write("long.obj", "v 0 0 0\n" + std::string(20'000'000, '\\')), "one line");
    outcome(folder_.write("lines.obj", "v 0 0 0\n" + std::string(5'000'000, '\n')), "empty lines");
    outcome(folder_.write("name.stl", "solid " + std::string(5'000'000, 'x')), "a name without end");
}
