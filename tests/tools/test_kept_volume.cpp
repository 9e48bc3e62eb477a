// Tests that no default of a mesh body loses volume: shipped scenes, dropped files and generated shapes keep
// it within 5 % at rest, and a cut through a squashed body leaves no fragments.
#include "tools/program.hpp"

#include "mesh/export.hpp"
#include "mesh/generate.hpp"
#include "mesh/import.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

using namespace sinew;
namespace fs = std::filesystem;

namespace {

constexpr double most = 0.05; // relative change from the volume at rest

class KeptVolume : public test::Program {
protected:
    /// Largest relative change of a body's volume.
    double change(const std::string& scene, int frames, std::vector<std::string> more = {}) const {
        std::vector<std::string> arguments{"run", scene, "--frames", std::to_string(frames), "--json", "-"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const test::Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.error;
        if (outcome.code != 0) return 1;
        const double volume = nlohmann::json::parse(outcome.out)["error"]["volume"].get<double>();
        std::printf("%s: %+.2f %%\n", fs::path(scene).stem().c_str(), 100 * volume);
        return volume;
    }
    /// A mesh of 0.4 m with the defaults of [[mesh]] that falls onto a floor.
    std::string falling(const std::string& keys) const {
        return write("falling.toml", "damping = 1.5\n[[mesh]]\nsize = 0.4\ncenter = [0, 0.3, 0]\n" + keys +
                                         "\n[[plane]]\nfriction = 0.4\n")
            .string();
    }
};

/// A ring around z; both radii in any unit, because dropped files are scaled.
mesh::TriangleMesh ring(double radius, double thickness) {
    constexpr std::uint32_t around = 64, across = 24;
    mesh::TriangleMesh mesh{.name = "ring"};
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < across; ++j) {
            const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / across;
            const double r = radius + thickness * std::cos(b);
            mesh.positions.push_back({static_cast<float>(r * std::cos(a)),
                                      static_cast<float>(r * std::sin(a)),
                                      static_cast<float>(thickness * std::sin(b))});
            const std::uint32_t here = i * across + j, up = i * across + (j + 1) % across;
            const std::uint32_t next = (here + across) % (around * across),
                                nextUp = (up + across) % (around * across);
            mesh.triangles.push_back({here, next, nextUp});
            mesh.triangles.push_back({here, nextUp, up});
        }
    return mesh;
}

mesh::TriangleMesh turned(mesh::TriangleMesh mesh) { // from upright to flat
    for (sim::Vec3& p : mesh.positions) p = {p.x, p.z, -p.y};
    return mesh;
}

mesh::TriangleMesh onEnd(mesh::TriangleMesh mesh) {
    for (sim::Vec3& p : mesh.positions) p = {p.y, -p.x, p.z};
    return mesh;
}

double longestEdge(const mesh::TriangleMesh& mesh) {
    double longest = 0;
    for (const auto& triangle : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const sim::Vec3 &p = mesh.positions[triangle[k]], &q = mesh.positions[triangle[(k + 1) % 3]];
            longest = std::max(longest, std::hypot(double{p.x} - double{q.x}, double{p.y} - double{q.y},
                                                   double{p.z} - double{q.z}));
        }
    return longest;
}

} // namespace

// Covers cut, torn, suspended and falling bodies, with coarse voxels to save time.
TEST_F(KeptVolume, OfEveryShippedSceneWithAMesh) {
    std::size_t count = 0;
    for (const fs::directory_entry& file : fs::directory_iterator(SINEW_SOURCE_FOLDER "/scenes")) {
        std::ifstream stream(file.path());
        const std::string text(std::istreambuf_iterator<char>(stream), {});
        if (text.find("\n[[mesh]]") == std::string::npos || text.find("\"argument\"") != std::string::npos)
            continue;
        ++count;
        EXPECT_LE(std::abs(change(file.path().string(), 110, {"--voxel", "0.025", "--substeps", "auto"})),
                  most)
            << file.path();
    }
    EXPECT_GE(count, 6u);
}

TEST_F(KeptVolume, OfFilesThatAreDropped) {
    const std::pair<const char*, mesh::TriangleMesh> dropped[] = {
        {"ring_on_edge", ring(0.2, 0.06)},
        {"ring_lying", turned(ring(0.2, 0.06))},
        {"thick_ring", ring(0.2, 0.1)},
        {"slab_on_end", onEnd(mesh::generate("slab_with_hole", 32))},
        {"tube_on_end", onEnd(mesh::generate("tube", 32))},
        {"sphere", mesh::generate("sphere", 32)},
        {"organ_on_end", onEnd(mesh::generate("organ", 32))}};
    for (const auto& [name, mesh] : dropped) {
        const fs::path file = folder_ / (std::string(name) + ".obj");
        mesh::exportObj(file, mesh);
        EXPECT_LE(std::abs(change(file.string(), 150)), most) << name;
    }
}

TEST_F(KeptVolume, OfShapesAtTheDefaultsOfAScene) {
    for (const char* resolution : {"12", "20"})
        for (const char* shape :
             {"generate = \"organ\"\nrotation = [0, 0, 70]", "generate = \"tube\"\nrotation = [0, 0, 90]",
              "generate = \"slab_with_hole\"\nrotation = [0, 0, 90]", "generate = \"sphere\"",
              "generate = \"torus_knot\""})
            EXPECT_LE(std::abs(change(falling(std::string(shape) + "\nresolution = " + resolution), 180)),
                      most)
                << shape << ", " << resolution << " voxels";
}

// A ring that stands on its edge is still open at rest: it keeps its height.
TEST_F(KeptVolume, LeavesADroppedRingARing) {
    const fs::path file = folder_ / "ring.obj", out = folder_ / "out";
    mesh::exportObj(file, ring(0.2, 0.06));
    change(file.string(), 240, {"--out", out.string()});
    mesh::MeshDefects defects;
    const mesh::TriangleMesh after = mesh::importMesh(out / "ring.obj", defects);
    sim::Vec3 low{1e9f, 1e9f, 1e9f}, high{-1e9f, -1e9f, -1e9f};
    for (const sim::Vec3& p : after.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const std::array<float, 3> sides{high.x - low.x, high.y - low.y, high.z - low.z};
    const auto longest = std::ranges::max(sides);
    EXPECT_NEAR(double{longest}, 0.4, 0.04);
    EXPECT_GE(std::ranges::count_if(sides, [](float side) { return side > 0.3f; }), 2) << "it is folded";
}

TEST_F(KeptVolume, LeavesNoShardsWhereASquashedBodyIsCut) {
    constexpr double voxel = 0.4 / 24;
    for (const char* rotation : {"[0, 0, 70]", "[0, 30, 70]"})
        for (const int frames : {30, 60, 90}) {
            const std::string scene =
                write("shards.toml", "damping = 1.5\n[[mesh]]\nname = \"squashed\"\ngenerate = "
                                     "\"organ\"\ndetail = 64\nsize = 0.4\n"
                                     "center = [0, 0.2, 0]\nrotation = " +
                                         std::string(rotation) +
                                         "\nresolution = 24\nyoung_modulus = 2e4\ncuttable = true\n"
                                         "[[plane]]\nfriction = 0.4\n[[blade]]\ntimes = [0.6, 0.7]\n"
                                         "edges = [[[-0.15, 0.5, -0.4], [-0.15, 0.5, 0.4]], [[-0.08, -0.05, "
                                         "-0.4], [-0.08, -0.05, 0.4]]]\n")
                    .string();
            const fs::path out = folder_ / "out";
            const double volume = change(scene, frames, {"--out", out.string()});
            if (frames > 30) { // the impact is over
                EXPECT_LE(std::abs(volume), most) << rotation << ", frame " << frames;
            }
            mesh::MeshDefects defects;
            EXPECT_LE(longestEdge(mesh::importMesh(out / "squashed.obj", defects)), 2 * voxel)
                << rotation << ", frame " << frames;
        }
}
