// Tests of mesh export: a file is written completely or not at all.
#include "mesh/export_gltf.hpp"

#include "mesh/generate.hpp"
#include "mesh/import.hpp"
#include "mesh_files.hpp"
#include "meshes.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <ostream>
#include <sys/stat.h>

using namespace sinew::mesh;
using namespace sinew::mesh::test;

namespace fs = std::filesystem;

namespace {

std::size_t filesIn(const Folder& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.path()), {}));
}

/// Message of the ExportError that `write` throws.
template <typename Write> std::string complaint(const Write& write) {
    try {
        write();
    } catch (const ExportError& error) {
        return error.what();
    }
    return "no error";
}

void writeHello(std::ostream& out) {
    out << "hello";
}

std::vector<ParticleState> someParticles() {
    std::vector<ParticleState> states;
    Random random(7);
    for (int i = 0; i < 100; ++i) {
        const auto value = [&] { return static_cast<float>(random.unit() - 0.5); };
        states.push_back({{value(), value(), value()}, {value(), value(), value()}, value()});
    }
    return states;
}

} // namespace

TEST(WriteWhole, ReplacesAFileAndLeavesNothingElse) {
    const Folder folder;
    const fs::path file = folder.write("a.txt", "old");
    writeWhole(file, writeHello);
    EXPECT_EQ(read(file), "hello");
    EXPECT_EQ(filesIn(folder), 1u);
}

TEST(WriteWhole, KeepsTheOldFileWhenTheWriterThrows) {
    const Folder folder;
    const fs::path file = folder.write("a.txt", "old");
    EXPECT_THROW(writeWhole(file,
                            [](std::ostream& out) {
                                out << std::string(1 << 20, 'x');
                                throw std::runtime_error("no more");
                            }),
                 std::runtime_error);
    EXPECT_EQ(read(file), "old");
    EXPECT_EQ(filesIn(folder), 1u);
}

TEST(WriteWhole, KeepsTheOldFileWhenTheStreamFails) {
    const Folder folder;
    const fs::path file = folder.write("a.txt", "old");
    EXPECT_THROW(writeWhole(file, [](std::ostream& out) { out.setstate(std::ios::failbit); }), ExportError);
    EXPECT_EQ(read(file), "old");
    EXPECT_EQ(filesIn(folder), 1u);
}

TEST(WriteWhole, ReportsAFullDisk) {
    if (!fs::is_character_file("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
    const std::string small = complaint([] { writeWhole("/dev/full", writeHello); });
    EXPECT_EQ(small,
              "cannot write /dev/full: No space left on device: free some space or choose another folder");
    EXPECT_EQ(complaint([] { exportObj("/dev/full", generate("organ", 48)); }), small);
    EXPECT_TRUE(fs::is_character_file("/dev/full")) << "the device was replaced by a file";
}

TEST(WriteWhole, ReportsAFolderThatIsNone) {
    const Folder folder;
    folder.write("a.txt", "");
    EXPECT_NE(complaint([&] { writeWhole(folder / "none/b.txt", writeHello); }).find("No such file"),
              std::string::npos);
    EXPECT_NE(complaint([&] { writeWhole(folder / "a.txt/b.txt", writeHello); }).find("Not a directory"),
              std::string::npos);
    EXPECT_NE(complaint([&] { writeWhole(folder.path(), writeHello); }).find("Is a directory"),
              std::string::npos);
    EXPECT_NE(complaint([&] { writeWhole("", writeHello); }), "no error");
    EXPECT_EQ(filesIn(folder), 1u);
}

TEST(WriteWhole, FollowsALinkInsteadOfReplacingIt) {
    const Folder folder;
    const fs::path file = folder.write("a.txt", "old"), link = folder / "link";
    fs::create_symlink("a.txt", link);
    writeWhole(link, writeHello);
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(read(file), "hello");
}

TEST(WriteWhole, TakesLongNamesAndNamesInTheWorkingFolder) {
    const Folder folder;
    const std::string name(255, 'n');
    writeWhole(folder / name, writeHello);
    EXPECT_EQ(read(folder / name), "hello");
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    writeWhole("here.txt", writeHello);
    fs::current_path(before);
    EXPECT_EQ(read(folder / "here.txt"), "hello");
}

TEST(Export, WritesObjThatReadsBackToTheSameFloats) {
    const Folder folder;
    TriangleMesh mesh = box({-0.1f, 1.0f / 3, 1e-20f}, {0.1f, 16777216, 1e20f});
    mesh.name = "two\nlines";
    exportObj(folder / "a.obj", mesh);
    std::istringstream in(read(folder / "a.obj"));
    std::string line, word;
    std::getline(in, line);
    EXPECT_EQ(line, "o two lines");
    for (const Vec3& position : mesh.positions) {
        float x = 0, y = 0, z = 0;
        in >> word >> x >> y >> z;
        EXPECT_TRUE(word == "v" && x == position.x && y == position.y && z == position.z);
    }
    std::uint32_t a = 0, b = 0, c = 0;
    in >> word >> a >> b >> c;
    EXPECT_TRUE(word == "f" && a == 1 && b == 3 && c == 4);
}

TEST(Export, WritesParticlesThatReadBackToTheSameBytes) {
    const Folder folder;
    const std::vector<ParticleState> states = someParticles();
    exportParticles(folder / "a.ply", states);
    const std::vector<ParticleState> back = importParticles(folder / "a.ply");
    ASSERT_EQ(back.size(), states.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
        EXPECT_EQ(back[i].position.x, states[i].position.x);
        EXPECT_EQ(back[i].velocity.z, states[i].velocity.z);
        EXPECT_EQ(back[i].inverseMass, states[i].inverseMass);
    }
    exportParticles(folder / "none.ply", {});
    EXPECT_TRUE(importParticles(folder / "none.ply").empty());
}

namespace {

// Adds normals that point away from the middle of the mesh and are not normalised.
ShadedMesh shaded(const TriangleMesh& mesh, const Vec3& color) {
    ShadedMesh result{.name = mesh.name,
                      .color = color,
                      .parts = {{.positions = mesh.positions, .normals = {}, .triangles = mesh.triangles}}};
    const MeshReport report = inspect(mesh);
    for (const Vec3& x : mesh.positions)
        result.parts[0].normals.push_back({2 * x.x - report.low.x - report.high.x,
                                           2 * x.y - report.low.y - report.high.y,
                                           2 * x.z - report.low.z - report.high.z});
    return result;
}

// A 32-bit word of a little-endian file.
std::uint32_t wordAt(const std::string& bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t byte = 4; byte-- > 0;)
        word = word << 8 | static_cast<unsigned char>(bytes.at(at + byte));
    return word;
}

} // namespace

TEST(ExportGlb, WritesMeshesThatReadBackToTheSameFloats) {
    const Folder folder;
    TriangleMesh first = box({-0.1f, 1.0f / 3, 1e-20f}, {0.1f, 0.5f, 7}), second = box({5, 0, 0}, {6, 1, 1});
    first.name = "first \xff\"\n"; // invalid UTF-8, and characters that JSON escapes
    second.name = "second";
    std::vector<ShadedMesh> meshes{shaded(first, {0.1f, 0.2f, 0.3f}), shaded(second, {0.1f, 0.2f, 0.3f})};
    meshes[1].parts.push_back(shaded(box({8, 0, 0}, {9, 1, 1}), {}).parts[0]);
    meshes[1].parts.back().isInside = true;
    meshes.push_back({.name = "nothing", .parts = {{}}});
    exportGlb(folder / "a.glb", meshes);
    MeshDefects defects;
    const TriangleMesh back = importMesh(folder / "a.glb", defects);
    EXPECT_TRUE(defects.isClosed());
    EXPECT_EQ(back.triangles.size(), 36u);
    EXPECT_EQ(back.positions.size(), 24u);
    for (const TriangleMesh& mesh : {first, second})
        for (const Vec3& x : mesh.positions)
            EXPECT_EQ(
                std::ranges::count_if(back.positions,
                                      [&](const Vec3& y) { return x.x == y.x && x.y == y.y && x.z == y.z; }),
                1);
    EXPECT_NEAR(inspect(back).volume, 0.2 * (0.5 - 1.0 / 3) * 7 + 2, 1e-6);
}

// Rules that assimp does not check: glTF 2.0, sections 3.6.2 (alignment, bounds, targets), 3.7.2 (normals),
// 4.4 (chunks).
TEST(ExportGlb, KeepsTheRulesOfTheFormat) {
    const Folder folder;
    ShadedMesh mesh = shaded(box({-1, 0, 0}, {1, 2, 3}), {0.1f, 0.2f, 0.3f});
    mesh.name = "abc"; // this length needs padding
    mesh.parts.push_back(mesh.parts[0]);
    mesh.parts[1].isInside = true;
    mesh.parts[1].normals[0] = {};
    exportGlb(folder / "a.glb", std::vector{mesh, mesh});
    const std::string bytes = read(folder / "a.glb");
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(wordAt(bytes, 4), 2u);
    EXPECT_EQ(wordAt(bytes, 8), bytes.size());
    const std::size_t text = wordAt(bytes, 12);
    EXPECT_EQ(text % 4, 0u);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(wordAt(bytes, 20 + text) + 28 + text, bytes.size());
    EXPECT_EQ(wordAt(bytes, 20 + text) % 4, 0u);
    EXPECT_EQ(bytes.substr(24 + text, 4), std::string("BIN\0", 4));
    const auto document = nlohmann::json::parse(bytes.substr(20, text));
    EXPECT_EQ(document["asset"]["version"], "2.0");
    EXPECT_EQ(document["scenes"][0]["nodes"].size(), 2u);
    EXPECT_EQ(document["materials"].size(), 2u) << "two meshes share them";
    EXPECT_EQ(document["buffers"][0]["byteLength"], wordAt(bytes, 20 + text));
    for (const auto& node : document["nodes"])
        for (const auto& part : document["meshes"][node["mesh"].get<std::size_t>()]["primitives"]) {
            const auto accessorOf = [&](const nlohmann::json& index) {
                return document["accessors"][index.get<std::size_t>()];
            };
            const auto positions = accessorOf(part["attributes"]["POSITION"]),
                       normals = accessorOf(part["attributes"]["NORMAL"]),
                       indices = accessorOf(part["indices"]);
            EXPECT_EQ(positions["min"], nlohmann::json({-1.0, 0.0, 0.0}));
            EXPECT_EQ(positions["max"], nlohmann::json({1.0, 2.0, 3.0}));
            EXPECT_EQ(positions["count"], 8);
            EXPECT_EQ(normals["count"], 8);
            EXPECT_EQ(indices["count"], 36);
            EXPECT_EQ(document["bufferViews"][indices["bufferView"].get<std::size_t>()]["target"], 34963);
            const auto view = document["bufferViews"][normals["bufferView"].get<std::size_t>()];
            EXPECT_EQ(view["target"], 34962);
            EXPECT_EQ(view["byteLength"], 8 * 12);
            const std::size_t start = 28 + text + view["byteOffset"].get<std::size_t>();
            for (std::size_t v = 0; v < 8; ++v) {
                double square = 0;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    square +=
                        std::pow(double{std::bit_cast<float>(wordAt(bytes, start + 12 * v + 4 * axis))}, 2);
                EXPECT_NEAR(square, 1, 1e-6);
            }
        }
}

TEST(ExportGlb, WritesAFileWithoutMeshesWhereThereAreNone) {
    const Folder folder;
    exportGlb(folder / "a.glb", {});
    const std::string bytes = read(folder / "a.glb");
    EXPECT_EQ(wordAt(bytes, 8), bytes.size());
    EXPECT_EQ(wordAt(bytes, 12) + 20, bytes.size());
    const auto document = nlohmann::json::parse(bytes.substr(20));
    EXPECT_FALSE(document.contains("meshes") || document.contains("buffers"));
}

TEST(ExportGlb, RefusesWhatNoReaderWouldTake) {
    const Folder folder;
    const ShadedMesh good = shaded(box({}, {1, 1, 1}), {});
    const auto error = [&](const auto& change) {
        ShadedMesh mesh = good;
        change(mesh.parts[0]);
        return complaint([&] { exportGlb(folder / "a.glb", std::span(&mesh, 1)); });
    };
    EXPECT_EQ(error([](ShadedPart&) {}), "no error");
    fs::remove(folder / "a.glb");
    EXPECT_NE(error([](ShadedPart& part) { part.positions[3].y = NAN; }).find("a vertex is not finite"),
              std::string::npos);
    EXPECT_NE(error([](ShadedPart& part) { part.triangles[3][2] = 8; }).find("that does not exist"),
              std::string::npos);
    EXPECT_NE(error([](ShadedPart& part) { part.normals.pop_back(); }).find("has no normal"),
              std::string::npos);
    EXPECT_EQ(filesIn(folder), 0u);
    if (!fs::is_character_file("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
    EXPECT_NE(complaint([&] { exportGlb("/dev/full", std::span(&good, 1)); }).find("No space left"),
              std::string::npos);
}

TEST(ImportParticles, RefusesEveryPrefixAndEveryOtherFile) {
    const Folder folder;
    exportParticles(folder / "a.ply", someParticles());
    const std::string bytes = read(folder / "a.ply");
    for (std::size_t size = 0; size < bytes.size(); size += size < 300 ? 1 : 97)
        EXPECT_THROW(importParticles(folder.write("b.ply", bytes.substr(0, size))), ImportError) << size;
    std::string huge = bytes;
    huge.replace(huge.find("vertex 100"), 10, "vertex 4000000000");
    EXPECT_THROW(importParticles(folder.write("b.ply", huge)), ImportError);
    EXPECT_THROW(importParticles(folder.write("b.ply", plyBinary(box({}, {1, 1, 1}), ByteOrder::little))),
                 ImportError);
    EXPECT_THROW(importParticles(folder.path()), ImportError);
    EXPECT_THROW(importParticles(folder / "missing.ply"), ImportError);
}
