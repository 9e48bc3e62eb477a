// Files are written whole or not at all.
#include "mesh/export.hpp"

#include "mesh/generate.hpp"
#include "mesh/import.hpp"
#include "mesh_files.hpp"
#include "meshes.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <sys/stat.h>

using namespace sinew::mesh;
using namespace sinew::mesh::test;

namespace fs = std::filesystem;

namespace {

std::size_t filesIn(const Folder& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.path()), {}));
}

/// The sentence of the ExportError that `write` throws.
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
