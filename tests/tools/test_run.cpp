// Tests of `sinew run`: its report, its files, and the early end of a run.
#include "tools/program.hpp"

#include "mesh/export.hpp"
#include "mesh/import.hpp"
#include "support/time_limit.hpp"

#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

using namespace sinew;
using nlohmann::json;
using test::expectOneError;
using test::Outcome;
using test::shippedScene;

namespace {

class Run : public test::Program {};

const std::string sheet = "[[cloth]]\nname = \"sheet\"\nsize = [4, 4]\nspacing = 0.1\n";
const std::string box = "[[box]]\nparticles = [3, 3, 3]\nspacing = 0.1\ncenter = [0, 0.3, 0]\n";
// Balls that fall onto each other within four walls.
const std::string balls =
    "[solver]\nsubsteps = 8\n[[particles]]\nradius = 0.05\njitter = 0.005\ncount = [4, 6, 4]\n"
    "center = [0, 0.4, 0]\n[[plane]]\n[[plane]]\nnormal = [1, 0, 0]\noffset = -0.25\n"
    "[[plane]]\nnormal = [-1, 0, 0]\noffset = -0.25\n[[plane]]\nnormal = [0, 0, 1]\n"
    "offset = -0.25\n[[plane]]\nnormal = [0, 0, -1]\noffset = -0.25\n";
// Compliance 0 with a mass of 1e-35 kg: the first correction overflows.
const std::string bomb =
    "name = \"bomb\"\ngravity = [0, -1e6, 0]\ndt = 0.1\n[solver]\nname = \"jacobi\"\nsubsteps = "
    "1\nover_relaxation = 1.99\n"
    "weight = 1\n[[cloth]]\nname = \"fuse\"\nsize = [16, 16]\nspacing = 1\npinned = [\"first_row\"]\n";

// The fields that docs/report.md lists.
// clang-format off
constexpr const char* reportFields[] = {
    "schema", "scene", "device", "solver", "substeps", "levels", "sharp_clamp", "clamp", "substep_choice", "forms", "iterations", "reversed",
    "dt", "velocity_age", "origin", "particles", "constraints", "bodies", "cut", "meshes", "passes",
    "skipped", "step", "frames", "frames_wanted", "interrupted", "frame_ms", "phase_ms", "error",
    "error_estimate", "stiffness", "finite", "sleeping", "divergence", "overflow", "forces", "state_hash", "peak_memory_mib",
    "validation", "validation_messages", "warnings", "notes"};
// clang-format on

} // namespace

TEST_F(Run, TracesEnergyOverlapAndSleepOverTime) {
    write("balls.toml", balls + "[contacts]\nfriction = 0.3\n");
    run({"run", "balls.toml", "--frames", "10", "--trace", "trace.csv", "--trace-every", "4"});
    std::ifstream stream(folder_ / "trace.csv");
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    ASSERT_EQ(lines.size(), 4u) << "after 4, 8 and 10 steps";
    EXPECT_TRUE(lines[0].ends_with(",potential_energy,resident_mib,device_mib")) << lines[0];
    const auto fields = [&](std::size_t line) {
        std::istringstream text(lines[line]);
        std::vector<double> values;
        for (std::string value; std::getline(text, value, ',');) values.push_back(std::stod(value));
        return values;
    };
    ASSERT_EQ(fields(1).size(), 9u);
    EXPECT_EQ(fields(1)[0], 4);
    EXPECT_EQ(fields(3)[0], 10);
    EXPECT_NEAR(fields(3)[1], 10 / 60.0, 1e-5);
    EXPECT_GT(fields(1)[2], 0) << "they fall";
    EXPECT_EQ(fields(3)[5], 0);
    EXPECT_LT(fields(3)[6], fields(1)[6]) << "they fall";
    EXPECT_TRUE(fields(3)[7] > fields(3)[8] && fields(3)[8] > 0) << "buffers are in this process";
    // The trace agrees with the report at the end and does not change the motion.
    const json traced =
        report({"balls.toml", "--frames", "10", "--trace", "trace.csv", "--trace-every", "3"});
    EXPECT_NEAR(fields(3)[3], traced["error"]["penetration_max"].get<double>(), 1e-6);
    EXPECT_EQ(traced["state_hash"], report({"balls.toml", "--frames", "10"})["state_hash"]);
    expectOneError(run({"run", "balls.toml", "--frames", "1", "--trace", "none/trace.csv"}), 6, "none");
}

TEST_F(Run, SaysThatABladeHasCutNothing) {
    const auto warnsOf = [&](const std::string& edges, const std::string& frames) {
        write("scene.toml", box + "cuttable = true\n[[blade]]\ntimes = [0, 0.01]\nedges = " + edges + "\n");
        const Outcome outcome = run({"run", "scene.toml", "--frames", frames});
        EXPECT_EQ(outcome.code, 0) << outcome.error;
        return outcome.error.find("warning: no blade has cut anything in ") != std::string::npos;
    };
    EXPECT_FALSE(warnsOf("[[[-1, 0.33, -1], [-1, 0.33, 1]], [[1, 0.33, -1], [1, 0.33, 1]]]", "2"));
    EXPECT_TRUE(warnsOf("[[[-1, 3, -1], [-1, 3, 1]], [[1, 3, -1], [1, 3, 1]]]", "2")) << "above it";
    EXPECT_TRUE(
        warnsOf("[[[-1000, 330, -1000], [-1000, 330, 1000]], [[1000, 330, -1000], [1000, 330, 1000]]]", "2"))
        << "in millimetres";
}

// A blade cuts a falling box.
TEST_F(Run, GoesOnFromASavedStateToTheSameBits) {
    write("cut.toml",
          box + "cuttable = true\nyoung_modulus = 1e6\n[solver]\nsubsteps = 8\n[[plane]]\n"
                "[[blade]]\ntimes = [0.05, 0.45]\n"
                "edges = [[[-0.5, 0.23, -0.5], [-0.5, 0.23, 0.5]], [[0.5, 0.23, -0.5], [0.5, 0.23, 0.5]]]\n");
    const json whole = report({"cut.toml", "--frames", "40", "--levels", "1"});
    report({"cut.toml", "--frames", "15", "--save", "half.state", "--levels", "1"});
    const json rest = report({"half.state", "--frames", "25", "--save", "end.state"});
    EXPECT_EQ(rest["state_hash"], whole["state_hash"]);
    EXPECT_EQ(rest["cut"]["links"], whole["cut"]["links"]) << "the blade goes on where it was";
    EXPECT_GT(rest["cut"]["links"], 0);
    EXPECT_EQ(rest["scene"], whole["scene"]);
    const json later = report({"end.state", "--frames", "1"}); // from a resumed run
    EXPECT_EQ(later["state_hash"], report({"cut.toml", "--frames", "41", "--levels", "1"})["state_hash"]);
}

TEST_F(Run, RefusesAStateThatItCannotGoOnFrom) {
    write("scene.toml", sheet);
    report({"scene.toml", "--frames", "2", "--save", "sheet.state"});
    expectOneError(run({"run", "scene.toml", "--frames", "1", "--save", "none/sheet.state"}), 6, "none");
    EXPECT_EQ(run({"run", "scene.toml", "--frames", "1", "--save", "sheet.txt"}).code, 2);
    expectOneError(run({"run", "sheet.state", "--frames", "1", "--solver", "jacobi"}), 3,
                   "another simulation");
    expectOneError(run({"run", "nothing.state", "--frames", "1"}), 3, "nothing.state");
    write("scene.toml", box); // the scene has changed since the state was saved
    expectOneError(run({"run", "sheet.state", "--frames", "1"}), 3, "has the scene");
}

TEST_F(Run, ReportHasEveryDocumentedField) {
    write("scene.toml", sheet);
    const json report = this->report({"scene.toml", "--frames", "3"});
    for (const char* field : reportFields) EXPECT_TRUE(report.contains(field)) << field;
    EXPECT_EQ(report.size(), std::size(reportFields)) << "a field that docs/report.md does not name";
    EXPECT_EQ(report["schema"], 1);
    EXPECT_EQ(report["scene"], "scene");
    EXPECT_EQ(report["solver"], "split");
    EXPECT_EQ(report["substeps"], 4);
    EXPECT_NEAR(report["velocity_age"].get<double>(), report["dt"].get<double>() / 8, 1e-9);
    EXPECT_EQ(report["particles"], 16);
    EXPECT_EQ(report["constraints"], 42);
    EXPECT_EQ(report["frames"], 3);
    EXPECT_EQ(report["finite"], true);
    EXPECT_EQ(report["bodies"][0]["name"], "sheet");
    EXPECT_EQ(report["overflow"], json::object());
    for (const char* field : {"name", "driver", "type"})
        EXPECT_TRUE(report["device"][field].is_string()) << field;
    for (const char* field : {"p50", "p99", "mean", "stddev"})
        EXPECT_TRUE(report["frame_ms"][field].is_number()) << field;
    EXPECT_EQ(report["state_hash"].get<std::string>().size(), 16u);
    EXPECT_FALSE(report["phase_ms"].empty());
}

TEST_F(Run, ReportSaysNullWhereAnErrorHasNoMeaning) {
    write("scene.toml", sheet);
    const json falling = report({"scene.toml", "--frames", "3"})["error"];
    EXPECT_TRUE(falling["strain_rms"].is_number());
    EXPECT_TRUE(falling["volume"].is_null());
    EXPECT_TRUE(falling["penetration_max"].is_null());
    EXPECT_TRUE(falling["penetration_rms"].is_null());
    EXPECT_LT(falling["momentum"], 1e-5);
    write("scene.toml", box + "[[plane]]\n");
    const json landing = report({"scene.toml", "--frames", "3"})["error"];
    EXPECT_LT(std::abs(landing["volume"].get<double>()), 1e-4);
    EXPECT_TRUE(landing["momentum"].is_null());
    EXPECT_EQ(landing["penetration_max"], 0);
}

TEST_F(Run, DoesAStepWithoutRoomForItsContactsAgainWithMore) {
    for (const std::string friction : {"", "friction = 0.4\n"}) {
        write("roomy.toml", balls + "[contacts]\nroom = 64\n" + friction);
        write("tight.toml", balls + "[contacts]\nroom = 1\n" + friction);
        const json roomy = report({"roomy.toml", "--frames", "40", "--validation"});
        const json tight = report({"tight.toml", "--frames", "40", "--validation"});
        json enough = roomy["overflow"]["contacts"], grown = tight["overflow"]["contacts"];
        for (const char* key : {"calm_steps", "repeated_steps"}) EXPECT_EQ(enough.erase(key), 1u);
        EXPECT_EQ(enough, (json{{"room", 64}, {"needed", nullptr}, {"grown", 0}, {"slowed", 0}}));
        EXPECT_EQ(roomy["warnings"], json::array());
        EXPECT_TRUE(grown["grown"] >= 1 && grown["repeated_steps"] >= grown["grown"]) << grown;
        EXPECT_GE(grown["needed"], 2);
        EXPECT_GE(grown["room"], grown["needed"]);
        EXPECT_EQ(tight["frames"], 40);
        EXPECT_EQ(tight["state_hash"], roomy["state_hash"]) << "nothing was dropped";
        EXPECT_EQ(tight["validation_messages"], json::array());
    }
}

TEST_F(Run, WarnsOfParticlesThatWereSlowedDownForSafety) {
    // One particle more than the search along paths takes, faster than a radius a substep (48 m/s): +-60 m/s.
    const auto swarm = [](const std::string& speed) {
        const std::string row = "[[particles]]\nradius = 0.05\nspacing = 0.4\n";
        return "gravity = [0, 0, 0]\n[solver]\nsubsteps = 16\n" + row + "count = [1, 1, 129]\nvelocity = [" +
               speed + ", 0, 0]\n" + row + "count = [1, 1, 128]\nvelocity = [-" + speed + ", 0, 0]\n";
    };
    write("fast.toml", swarm("60"));
    write("slow.toml", swarm("40"));
    const Outcome outcome = run({"run", "fast.toml", "--frames", "2", "--out", "out"});
    EXPECT_EQ(outcome.code, 0);
    const std::string warning =
        "257 times a particle was slowed down, so that its contacts are found: momentum "
        "was lost, take more substeps";
    EXPECT_NE(outcome.error.find("warning: " + warning + "\n"), std::string::npos) << outcome.error;
    const json fast = json::parse(std::ifstream(folder_ / "out/report.json"));
    EXPECT_EQ(fast["overflow"]["contacts"]["slowed"], 257);
    EXPECT_EQ(fast["warnings"], json::array({warning}));
    const json slow = report({"slow.toml", "--frames", "2"});
    EXPECT_EQ(slow["overflow"]["contacts"]["slowed"], 0);
    EXPECT_EQ(slow["warnings"], json::array());
}

TEST_F(Run, WarnsOfRigidLinksThatAreTooLong) {
    for (const std::string solver : {"split", "gauss_seidel", "jacobi"}) {
        const auto chain = [&](const std::string& substeps) {
            return "[solver]\nname = \"" + solver + "\"\nsubsteps = " + substeps +
                   "\n[[chain]]\nlength = 1\nparticles = 30\n";
        };
        write("soft.toml", chain("1"));
        write("stiff.toml", chain("100"));
        const json soft = report({"soft.toml", "--frames", "60"}),
                   stiff = report({"stiff.toml", "--frames", "60"});
        ASSERT_EQ(soft["warnings"].size(), 1u) << solver;
        const std::string warning = soft["warnings"][0];
        EXPECT_TRUE(warning.starts_with("rigid links are up to ")) << warning;
        EXPECT_NE(warning.find(" % too long at the end; solver.tolerance is 5 %: take "), std::string::npos)
            << warning;
        EXPECT_LT(stiff["error"]["strain_max"], 0.1) << solver;
        EXPECT_EQ(stiff["warnings"], json::array()) << solver;
    }
}

TEST_F(Run, StopsWithASentenceWhereNoRoomIsEnough) {
    // Four heaps of balls at one place: each ball is near most of the 2,916.
    std::string scene = "gravity = [0, 0, 0]\n[contacts]\nmargin = 10\n";
    for (const std::string center : {"[0, 0, 0]", "[0.04, 0, 0]", "[0, 0.04, 0]", "[0, 0, 0.04]"})
        scene += "[[particles]]\nradius = 0.05\ncount = [9, 9, 9]\ncenter = " + center + "\n";
    write("scene.toml", scene);
    const Outcome outcome = run({"run", "scene.toml", "--frames", "5", "--out", "out"});
    expectOneError(outcome, 7,
                   "the simulation is too crowded: step 1: more than 1024 contact candidates for a particle "
                   "on average");
    const json report = json::parse(std::ifstream(folder_ / "out/report.json"));
    EXPECT_EQ(report["finite"], true);
    EXPECT_EQ(report["divergence"]["cause"], "crowded");
    EXPECT_GT(report["overflow"]["contacts"]["needed"], 1024);
}

TEST_F(Run, ReportSaysHowDeepParticlesAreInEachOther) {
    write("scene.toml", balls);
    const json error = report({"scene.toml", "--frames", "60"})["error"];
    EXPECT_GT(error["penetration_max"], 0);
    EXPECT_LT(error["penetration_max"], 0.05) << "a radius";
    EXPECT_LT(error["penetration_rms"], error["penetration_max"]);
    EXPECT_TRUE(error["strain_rms"].is_null());
}

TEST_F(Run, ReportListsOnlyThePassesOfTheScene) {
    write("scene.toml", sheet);
    const auto has = [](const json& list, const std::string& part) {
        return std::ranges::any_of(list, [&](const json& label) {
            return label.get<std::string>().find(part) != std::string::npos;
        });
    };
    const json without = report({"scene.toml", "--frames", "1"});
    EXPECT_FALSE(has(without["passes"], "plane") || has(without["passes"], "colliders"));
    EXPECT_TRUE(has(without["skipped"], "plane"));
    write("scene.toml", sheet + "[[plane]]\noffset = -9\n\n[[collider]]\nshape = \"sphere\"\ncenter = [0, "
                                "-8, 0]\nradius = 0.1\n");
    const json with = report({"scene.toml", "--frames", "1"});
    EXPECT_TRUE(has(with["passes"], "solve_colliders"));
    EXPECT_FALSE(has(with["skipped"], "plane")) << "kernels of other passes handle planes";
}

TEST_F(Run, FolderHoldsReportMeshesAndStateThatReadBack) {
    write("scene.toml", sheet + box + "name = \"../b x\"\n");
    const Outcome outcome = run({"run", "scene.toml", "--frames", "2", "--out", "a/b", "--json", "r.json"});
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    EXPECT_EQ(files(), (std::vector<std::string>{"a/b/___b_x.glb", "a/b/___b_x.obj", "a/b/___b_x.ply",
                                                 "a/b/report.json", "a/b/sheet.glb", "a/b/sheet.obj",
                                                 "a/b/sheet.ply", "a/b/state.ply", "r.json", "scene.toml"}));
    mesh::MeshDefects defects;
    const mesh::TriangleMesh skin = mesh::importMesh(folder_ / "a/b/___b_x.obj", defects);
    EXPECT_TRUE(defects.isClosed());
    EXPECT_NEAR(mesh::inspect(skin).volume, 0.008, 1e-5);
    EXPECT_EQ(mesh::importMesh(folder_ / "a/b/sheet.ply", defects).triangles.size(), 18u);
    EXPECT_EQ(mesh::importMesh(folder_ / "a/b/sheet.glb", defects).triangles.size(), 36u) << "both sides";
    EXPECT_NEAR(mesh::inspect(mesh::importMesh(folder_ / "a/b/___b_x.glb", defects)).volume, 0.008, 1e-5);
    EXPECT_TRUE(defects.isClosed());
    const auto particles = mesh::importParticles(folder_ / "a/b/state.ply");
    ASSERT_EQ(particles.size(), 43u);
    EXPECT_LT(particles[0].velocity.y, -0.2f);
    EXPECT_GT(particles[0].inverseMass, 0);
}

namespace {

std::string textOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

json gltfOf(const std::filesystem::path& file) {
    const std::string bytes = textOf(file);
    std::size_t size = 0; // of the first chunk
    for (std::size_t byte = 16; byte-- > 12;) size = size << 8 | static_cast<unsigned char>(bytes.at(byte));
    return json::parse(bytes.substr(20, size), nullptr, false);
}

} // namespace

// A removed corner of a cube is in no output, and the report counts it.
TEST_F(Run, LeavesOutDebrisAndSaysHowMuchThereIs) {
    const std::string scene =
        "dt = 0.01\ngravity = [0, 0, 0]\n[solver]\nsubsteps = 4\n[[box]]\nname = \"box\"\n"
        "particles = [5, 5, 5]\nspacing = 0.1\ncenter = [0, 0, 0]\nyoung_modulus = 1e5\ndensity = 1000\n"
        "cuttable = true\n[[blade]]\ntimes = [0.01, 0.02]\nedges = [[[-2.15, -0.15, 1.85], "
        "[-0.15, -2.15, 1.85]], [[-0.15, 1.85, -2.15], [1.85, -0.15, -2.15]]]\n";
    write("kept.toml", scene);
    write("cut.toml", "debris = 5\n" + scene);
    const json kept = report({"kept.toml", "--frames", "5"});
    EXPECT_EQ(kept["cut"]["pieces"], 2);
    EXPECT_EQ(kept["cut"]["debris"], (json{{"pieces", 0}, {"particles", 0}, {"mass", 0.0}}));
    const Outcome outcome = run({"run", "cut.toml", "--frames", "5", "--out", "out"});
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    EXPECT_NE(outcome.out.find("1 piece, 1 removed with 4 particles, 0.875 kg"), std::string::npos)
        << outcome.out;
    const json cut = json::parse(textOf(folder_ / "out/report.json"))["cut"];
    EXPECT_EQ(cut["pieces"], 1);
    EXPECT_EQ(cut["debris"]["pieces"], 1);
    EXPECT_EQ(cut["debris"]["particles"], 4);
    EXPECT_NEAR(cut["debris"]["mass"].get<double>(), 7.0 / 8, 1e-6) << "of 64 cells of 1 kg";
    EXPECT_EQ(mesh::importParticles(folder_ / "out/state.ply").size(), 125u - 4);
    for (const char* name : {"out/box.obj", "out/box.ply", "out/box.glb"}) {
        mesh::MeshDefects defects;
        const mesh::MeshReport left = mesh::inspect(mesh::importMesh(folder_ / name, defects));
        EXPECT_TRUE(defects.isClosed()) << name;
        EXPECT_NEAR(left.volume, 0.064 - 0.15 * 0.15 * 0.15 / 6, 1e-5) << name;
    }
}

// Cut links do not count as strain.
TEST_F(Run, CountsNoCutLinkAsStrain) {
    const std::string blade = "[[blade]]\ntimes = [0, 0.01]\nedges = [[[0.06, 2, -2], [0.06, 2, 2]], "
                              "[[0.06, -2, -2], [0.06, -2, 2]]]\n";
    const std::string head = "dt = 0.01\n[solver]\nsubsteps = 16\n[[plane]]\nfriction = 0\n"
                             "normal = [0.6, 0.8, 0]\noffset = -0.3\n[[plane]]\nfriction = 0\n"
                             "normal = [-0.6, 0.8, 0]\noffset = -0.3\n";
    const std::map<std::string, std::string> bodies{
        {"box", "[[box]]\nparticles = [6, 5, 5]\nspacing = 0.1\ncenter = [0, 0.1, 0]\n"
                "young_modulus = 1e6\ncuttable = true\n"},
        {"mesh", "[[mesh]]\ngenerate = \"sphere\"\ndetail = 16\nsize = 0.5\nresolution = 8\n"
                 "center = [0, 0.1, 0]\nyoung_modulus = 1e6\ncuttable = true\n"},
        {"cloth", "[[cloth]]\nsize = [14, 10]\nspacing = 0.05\norigin = [-0.3, 0.1, -0.2]\n"
                  "skip_stiffness = 10\ncuttable = true\n"}};
    for (const auto& [name, body] : bodies) {
        write("cut.toml", head + body + blade);
        const json cut = report({"cut.toml", "--frames", "25"});
        EXPECT_EQ(cut["cut"]["pieces"], 2) << name;
        EXPECT_LT(cut["error"]["strain_rms"].get<double>(), 0.02)
            << name << "; with links that are cut 0.03 to 0.35";
    }
}

TEST_F(Run, CountsThePiecesThatItsMeshesShow) {
    for (const char* at : {"0.1055", "0.02", "-0.13", "0.142"})
        for (const char* resolution : {"8", "13"}) {
            write("cut.toml",
                  std::string("gravity = [0, 0, 0]\n[[mesh]]\nname = \"ball\"\ngenerate = \"sphere\"\n"
                              "detail = 32\nsize = 0.3\ncenter = [0, 0, 0]\ncuttable = true\n"
                              "resolution = ") +
                      resolution + "\n[[blade]]\ntimes = [0, 0.0166667]\nedges = [[[" + at + ", 1, -1], [" +
                      at + ", 1, 1]], [[" + at + ", -1, -1], [" + at + ", -1, 1]]]\n");
            const Outcome outcome = run({"run", "cut.toml", "--frames", "4", "--out", "out"});
            ASSERT_EQ(outcome.code, 0) << outcome.error;
            const json cut = json::parse(textOf(folder_ / "out/report.json"))["cut"];
            EXPECT_EQ(cut["pieces"], 2) << at << ", " << resolution;
            EXPECT_EQ(gltfOf(folder_ / "out/ball.glb")["meshes"].size(), 2u) << at << ", " << resolution;
            EXPECT_NE(textOf(folder_ / "out/ball.obj").find("\no ball 2\n"), std::string::npos);
            EXPECT_EQ(outcome.out.find("fragment") == std::string::npos, cut["fragments"] == 0)
                << outcome.out;
        }
}

// A cube is cut in two while it lands and spreads. Its skin is clipped along the cut and closed by the
// inside.
TEST_F(Run, WritesWhatWasCutAsAClosedMeshWithItsInside) {
    write("cut.toml", "dt = 0.01\n[solver]\nsubsteps = 8\n[[plane]]\nfriction = 0\n[[box]]\nname = \"box\"\n"
                      "particles = [5, 5, 5]\nspacing = 0.1\ncenter = [0, 0.5, 0]\nyoung_modulus = 1e5\n"
                      "cuttable = true\n[[blade]]\ntimes = [0.22, 0.25]\n"
                      "edges = [[[0.03, 2, -1], [0.03, 2, 1]], [[0.03, -1, -1], [0.03, -1, 1]]]\n");
    const Outcome outcome = run({"run", "cut.toml", "--frames", "60", "--out", "out", "--json", "r.json"});
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    mesh::MeshDefects defects;
    const mesh::TriangleMesh skin = mesh::importMesh(folder_ / "out/box.obj", defects);
    EXPECT_TRUE(defects.isClosed());
    const mesh::MeshReport report = mesh::inspect(skin);
    EXPECT_NEAR(report.volume, 0.064, 0.002);
    EXPECT_GT(report.area, 6 * 0.16 + 1.8 * 0.16) << "and both sides of the cut";

    const mesh::TriangleMesh pieces = mesh::importMesh(folder_ / "out/box.glb", defects);
    EXPECT_TRUE(defects.isClosed());
    EXPECT_NEAR(mesh::inspect(pieces).volume, report.volume, 1e-6);
    EXPECT_NEAR(mesh::inspect(pieces).area, report.area, 1e-5);
    const json document = gltfOf(folder_ / "out/box.glb");
    ASSERT_EQ(document["meshes"].size(), 2u) << "a mesh for each piece";
    std::vector<std::array<double, 2>> reach; // extent of each piece along x
    for (const json& mesh : document["meshes"]) {
        std::set<std::string> materials;
        reach.push_back({1, -1});
        for (const json& part : mesh["primitives"]) {
            materials.insert(document["materials"][part["material"].get<std::size_t>()]["name"]);
            EXPECT_TRUE(part["attributes"].contains("NORMAL"));
            const json& at = document["accessors"][part["attributes"]["POSITION"].get<std::size_t>()];
            reach.back() = {std::min(reach.back()[0], at["min"][0].get<double>()),
                            std::max(reach.back()[1], at["max"][0].get<double>())};
        }
        EXPECT_EQ(materials, (std::set<std::string>{"inside", "outside"}));
    }
    for (const std::size_t end : {0u, 1u}) EXPECT_LT(reach[0][end] + 0.15, reach[1][end]) << "on either side";
    const std::string obj = textOf(folder_ / "out/box.obj"), ply = textOf(folder_ / "out/box.ply");
    EXPECT_NE(obj.find("o box 1\n"), std::string::npos);
    EXPECT_NE(obj.find("\no box 2\n"), std::string::npos);
    EXPECT_NE(ply.find("property uint piece\n"), std::string::npos);
    EXPECT_NEAR(mesh::inspect(mesh::importMesh(folder_ / "out/box.ply", defects)).volume, report.volume,
                1e-6);
    EXPECT_TRUE(defects.isClosed());
}

// Sixty cuts through a box exceed the initial capacity for cut surfaces.
TEST_F(Run, MakesRoomForTheSurfaceOfCuts) {
    write("shred.toml", "gravity = [0, -0.5, 0]\n[solver]\nsubsteps = 8\n[[box]]\nname = \"box\"\n"
                        "particles = [10, 10, 10]\nspacing = 0.1\ncenter = [0, 0, 0]\ncuttable = "
                        "true\n[[strokes]]\ncount = 60\n"
                        "center = [0, 0, 0]\nsize = [0.9, 0.9, 0.9]\nlength = 3\nevery = 0.016666667\n");
    const json grown = report({"shred.toml", "--frames", "62"});
    const json& surface = grown["overflow"]["cut_surface"];
    EXPECT_GE(surface["grown"], 1);
    EXPECT_GT(surface["needed"], 65'536);
    EXPECT_EQ(grown["warnings"], json::array());
    EXPECT_NEAR(grown["error"]["volume"].get<double>(), 0, 1e-3) << "what is read back is closed";
}

TEST_F(Run, WritesTheHalvesOfASheetApart) {
    write("cut.toml", "gravity = [0, 0, 0]\n[[cloth]]\nname = \"sheet\"\nsize = [5, 5]\nspacing = 0.1\n"
                      "cuttable = true\norigin = [0, 0, 0]\n[[blade]]\ntimes = [0, 0.016666667]\n"
                      "edges = [[[0.23, -1, -1], [0.23, -1, 1]], [[0.23, 1, -1], [0.23, 1, 1]]]\n");
    const Outcome outcome = run({"run", "cut.toml", "--frames", "2", "--out", "out", "--json", "r.json"});
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    const json document = gltfOf(folder_ / "out/sheet.glb");
    ASSERT_EQ(document["meshes"].size(), 2u);
    std::vector<std::array<double, 2>> reach;
    for (const json& mesh : document["meshes"]) {
        const json& part = mesh["primitives"][0];
        const json& at = document["accessors"][part["attributes"]["POSITION"].get<std::size_t>()];
        reach.push_back({at["min"][0].get<double>(), at["max"][0].get<double>()});
    }
    EXPECT_LT(reach[0][1], reach[1][0] + 1e-5) << "neither reaches over the cut";
    EXPECT_NEAR(reach[0][1], 0.23, 0.01);
}

TEST_F(Run, TextGoesToStdoutUnlessTheReportDoes) {
    write("scene.toml", sheet);
    const Outcome text = run({"run", "scene.toml", "--frames", "2"});
    EXPECT_EQ(text.out.find("scene: 16 particles, 42 constraints, split with 4 substeps"), 0u) << text.out;
    EXPECT_NE(text.out.find("\n4 substeps: the stiffness alone needs fewer\n"), std::string::npos)
        << text.out;
    EXPECT_NE(text.error.find("2 of 2 steps"), std::string::npos) << text.error;
    EXPECT_EQ(text.error.find('\r'), std::string::npos) << "a bar in a pipe";
}

TEST_F(Run, DivergenceNamesStepAndBodyAndKeepsTheLastFiniteState) {
    write("scene.toml", bomb);
    const Outcome outcome = run({"run", "scene.toml", "--frames", "100000", "--out", "out"});
    expectOneError(outcome, 7, "the simulation diverged: step ");
    EXPECT_NE(outcome.error.find("body \"fuse\", particle "), std::string::npos) << outcome.error;
    EXPECT_NE(outcome.error.find(" s): body"), std::string::npos) << outcome.error;
    const json report = json::parse(std::ifstream(folder_ / "out/report.json"));
    EXPECT_EQ(report["finite"], false);
    EXPECT_EQ(report["divergence"]["body"], "fuse");
    EXPECT_EQ(report["divergence"]["step"].get<std::uint64_t>(), report["frames"].get<std::uint64_t>() + 1);
    EXPECT_NEAR(report["divergence"]["time"].get<double>(), 0.1 * report["divergence"]["step"].get<double>(),
                1e-6);
    for (const mesh::ParticleState& particle : mesh::importParticles(folder_ / "out/state.ply"))
        EXPECT_TRUE(std::isfinite(particle.position.x) && std::isfinite(particle.velocity.y));
}

// Averaging keeps jacobi stable: without it, the corrections of a stiff block add up.
TEST_F(Run, TimesTheStepThatDivergesBeItTheFirst) {
    write("scene.toml",
          "[[box]]\ncenter = [0, 0, 0]\nparticles = [8, 3, 3]\nspacing = 0.1\nyoung_modulus = 1e7\n"
          "clamped = [\"low_x\"]\n[solver]\nname = \"jacobi\"\nweight = 1\nsubsteps = 16\n"
          "iterations = 4\n");
    const Outcome outcome = run({"run", "scene.toml", "--frames", "2", "--out", "out"});
    EXPECT_EQ(outcome.code, 7) << outcome.error;
    const json report = json::parse(std::ifstream(folder_ / "out/report.json"));
    ASSERT_TRUE(report["frame_ms"]["p50"].is_number());
    EXPECT_GT(report["frame_ms"]["p50"], 0);
}

TEST_F(Run, AnInterruptedRunWritesWholeOutputs) {
    write("scene.toml", sheet);
    const Outcome outcome =
        run({"run", "scene.toml", "--frames", "1000000000", "--out", "out", "--json", "-"}, {}, errorFile());
    EXPECT_EQ(outcome.code, 130) << outcome.error;
    const json report = json::parse(outcome.out, nullptr, false);
    ASSERT_FALSE(report.is_discarded()) << outcome.out;
    EXPECT_EQ(report["interrupted"], true);
    EXPECT_LT(report["frames"], report["frames_wanted"]);
    EXPECT_EQ(files(), (std::vector<std::string>{"out/report.json", "out/sheet.glb", "out/sheet.obj",
                                                 "out/sheet.ply", "out/state.ply", "scene.toml"}));
}

// A step of this scene takes minutes on a software device.
TEST_F(Run, ARunWhoseStepTakesLongEndsWithinSecondsOfASignal) {
    write("scene.toml", "[[box]]\nparticles = [60, 60, 60]\nspacing = 0.01\ncenter = [0, 1, 0]\n"
                        "[solver]\nsubsteps = 1000\n");
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome =
        run({"run", "scene.toml", "--frames", "90", "--out", "out", "--json", "report.json"}, {},
            "out/.sinew-lock");
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(outcome.code, 130);
    if (std::filesystem::exists(folder_ / "report.json"))
        GTEST_SKIP() << "this device ends such a step within 2 s: not tested";
    EXPECT_EQ(outcome.error, "error: interrupted: the running work did not end within 2 s: nothing more "
                             "was written\n");
    EXPECT_LT(taken.count(), 60 * test::slowness) << "most of it to load the scene";
}

// The loader gives this warning, and the simulation must not repeat it.
TEST_F(Run, SaysOnceHowCoarsePositionsAre) {
    write("scene.toml", "[[box]]\nparticles = [3, 3, 3]\nspacing = 0.1\ncenter = [0, 0, 0]\n"
                        "[[box]]\nparticles = [3, 3, 3]\nspacing = 0.1\ncenter = [2000, 0, 0]\n");
    const Outcome outcome = run({"run", "scene.toml", "--frames", "2", "--json", "-"});
    const json report = json::parse(outcome.out, nullptr, false);
    ASSERT_FALSE(report.is_discarded()) << outcome.out;
    EXPECT_EQ(std::ranges::count_if(report["warnings"],
                                    [](const json& warning) {
                                        return warning.get<std::string>().starts_with(
                                            "positions are rounded");
                                    }),
              1)
        << report["warnings"];
}

TEST_F(Run, BodiesInOneSpotAreRefusedWithTheirNames) {
    const auto spot = [&](const std::string& scene, const std::string& why) {
        write("scene.toml", scene + "[[plane]]\n");
        expectOneError(run({"run", "scene.toml", "--frames", "5"}), 3, why);
    };
    const auto repeated = [](const std::string& body) {
        std::string scene;
        for (int n = 0; n < 300; ++n) scene += body;
        return scene;
    };
    spot(
        "[[box]]\nparticles = [2, 2, 2]\nspacing = 0.02\ncenter = [0, 0.5, 0]\ncollides = true\n"
        "copies = [10, 10, 4]\npitch = [1e-6, 1e-6, 1e-6]\n",
        "bodies \"box 1\" and \"box 2\" and 398 more overlap: they have 400 particles that touch each other");
    spot(repeated("[[particles]]\nradius = 0.01\ncount = [1, 1, 1]\n"),
         "300 particles that touch each other");
    spot(repeated("[[cloth]]\nsize = [4, 4]\nspacing = 0.05\nthickness = 0.02\n"),
         "300 particles that touch each other");
}

// A cloth thicker than its spacing is near itself at rest, which must not count as crowding.
TEST_F(Run, AThickClothOfFineMeshIsNoCrowd) {
    write("scene.toml", "[[cloth]]\nsize = [24, 24]\nspacing = 0.001\nthickness = 0.02\n");
    const Outcome outcome = run({"describe", "scene.toml"});
    EXPECT_EQ(outcome.code, 0) << outcome.error;
}

TEST_F(Run, ValidationHasNothingToSayAboutTheShippedScenes) {
    for (const char* scene : {"cloth_links", "cube", "organ"})
        for (const char* solver : {"split", "jacobi", "gauss_seidel"}) {
            const json report = this->report({shippedScene(scene), "--frames", "6", "--substeps", "4",
                                              "--validation", "--solver", solver});
            EXPECT_EQ(report["validation"], true);
            EXPECT_EQ(report["validation_messages"], json::array()) << scene << " with " << solver;
        }
}

TEST_F(Run, WarningsAreInTheReportAndOnStderr) {
    write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
    const Outcome outcome = run({"run", "open.obj", "--frames", "1", "--json", "-"});
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    EXPECT_NE(outcome.error.find("warning: mesh open.obj is open: 3 boundary edges"), std::string::npos);
    const json report = json::parse(outcome.out);
    EXPECT_EQ(report["meshes"][0]["boundary_edges"], 3);
    EXPECT_FALSE(report["warnings"].empty());
}

TEST_F(Run, KeepsOutOfAFolderInUse) {
    write("scene.toml", sheet);
    std::filesystem::create_directory(folder_ / "out");
    const int lock =
        ::open((folder_ / "out/.sinew-lock").c_str(), O_CREAT | O_RDWR, 0600); // locked as in a run
    ASSERT_EQ(::flock(lock, LOCK_EX), 0);
    expectOneError(run({"run", "scene.toml", "--frames", "1", "--out", "out"}), 6,
                   "out: another run writes there");
    ::close(lock);
    EXPECT_EQ(run({"run", "scene.toml", "--frames", "1", "--out", "out"}).code, 0);
}
