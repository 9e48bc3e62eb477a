// Tests that the state hash does not depend on the run, on threads, or on the order of invocations, nor the
// figures of a report on bodies that are absent.
#include "tools/program.hpp"

#include <fstream>
#include <set>

using namespace sinew;
using test::shippedScene;

namespace {

class SameState : public test::Program {
protected:
    std::string hash(const std::string& scene, const std::string& solver,
                     const std::vector<std::string>& more = {},
                     const test::Environment& environment = {}) const {
        std::vector<std::string> arguments{scene, "--solver", solver};
        if (more.empty() || more[0] != "--frames") arguments.insert(arguments.end(), {"--frames", "4"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        const nlohmann::json report = this->report(arguments, environment);
        EXPECT_EQ(report["finite"], true);
        return report["state_hash"].get<std::string>();
    }
};

/// A cube that touches the floor within the compared frames.
std::string landedCube(const std::filesystem::path& folder) {
    std::ifstream stream(shippedScene("cube"));
    std::string text(std::istreambuf_iterator<char>(stream), {});
    const std::string center = "center = [0, 0.45, 0]";
    const std::size_t at = text.find(center);
    EXPECT_NE(at, std::string::npos);
    text.replace(at, center.size(), "center = [0, 0.151, 0]");
    std::ofstream(folder / "landed.toml") << text;
    return "landed.toml";
}

} // namespace

TEST_F(SameState, OverRunsThreadsAndReversedOrder) {
    for (const std::string& scene : {shippedScene("cloth_links"), shippedScene("cube"), landedCube(folder_)})
        for (const char* solver : {"split", "jacobi", "gauss_seidel"}) {
            const std::string first = hash(scene, solver);
            for (const char* threads : {"0", "1", "2"}) // one of them repeats the same run
                EXPECT_EQ(hash(scene, solver, {}, {{"LP_NUM_THREADS", threads}}), first)
                    << scene << ", threads " << threads;
            EXPECT_EQ(hash(scene, solver, {"--reversed"}), first) << scene << ", reversed";
        }
}

TEST_F(SameState, OfContactsOverRunsThreadsReversedOrderAndMargins) {
    const auto clutter = [&](const std::string& contacts) {
        std::ofstream(folder_ / "clutter.toml")
            << "[solver]\nsubsteps = 8\n[[particles]]\nradius = 0.05\njitter = 0.005\ncount = [6, 6, 6]\n"
               "center = [0, 0.345, 0]\n[[box]]\nparticles = [4, 4, 4]\nspacing = 0.1\ncollides = true\n"
               "center = [0, 0.9, 0]\nyoung_modulus = 1e5\n[[plane]]\nfriction = 0.3\n[contacts]\n" +
                   contacts;
        return std::string("clutter.toml");
    };
    for (const std::string friction : {"", "friction = 0.3\n"}) {
        const std::vector<std::string> frames{"--frames", "30"};
        const std::string first = hash(clutter(friction), "split", frames);
        for (const char* threads : {"0", "1", "2"})
            EXPECT_EQ(hash("clutter.toml", "split", frames, {{"LP_NUM_THREADS", threads}}), first)
                << "threads " << threads;
        EXPECT_EQ(hash("clutter.toml", "split", {"--frames", "30", "--reversed"}), first) << "reversed";
        EXPECT_EQ(hash(clutter(friction + "margin = 0.2\n"), "split", frames), first) << "another margin";
    }
}

TEST_F(SameState, IsAnotherStateWithAnotherSolverOrNumberOfSubsteps) {
    const std::string scene = shippedScene("cloth_links");
    const std::string split = hash(scene, "split");
    EXPECT_NE(hash(scene, "jacobi"), split);
    EXPECT_NE(hash(scene, "split", {"--substeps", "65"}), split);
}

// --pass-times adds timestamps around every pass and must not change the state.
TEST_F(SameState, WithEveryKindOfPassTimedByItself) {
    const std::vector<std::string> arguments{shippedScene("cube"), "--frames", "3"};
    std::vector<std::string> timing = arguments;
    timing.push_back("--pass-times");
    const nlohmann::json report = this->report(timing);
    std::set<std::string> timed, passes;
    for (const auto& [name, ms] : report["phase_ms"].items()) {
        timed.insert(name);
        EXPECT_GT(ms, 0.0) << name;
    }
    for (const auto& name : report["passes"]) passes.insert(name.get<std::string>());
    EXPECT_EQ(timed, passes);
    EXPECT_EQ(this->report(arguments)["state_hash"], report["state_hash"]);
}

TEST_F(SameState, OverNumbersOfSubmissionsAStep) {
    for (const char* scene : {"clutter", "cube_quarters"}) {
        const std::string whole = hash(shippedScene(scene), "split");
        for (const char* parts : {"2", "7", "32"})
            EXPECT_EQ(hash(shippedScene(scene), "split", {}, {{"SINEW_STEP_PARTS", parts}}), whole)
                << scene << ' ' << parts;
    }
}

TEST_F(SameState, WithFormsThatWereMeasuredAndRemembered) {
    write("box.toml", "[[box]]\nparticles = [3, 3, 3]\nspacing = 0.1\ncenter = [0, 0.3, 0]\n");
    const test::Environment kept{{"SINEW_CACHE", (folder_ / "kept").string()}};
    const auto runIt = [&] { return report({"box.toml", "--frames", "100"}, kept); };
    const nlohmann::json measured = runIt();
    EXPECT_EQ(measured["forms"]["source"], "measured");
    const nlohmann::json remembered = runIt();
    EXPECT_EQ(remembered["forms"]["source"], "remembered");
    for (const char* part : {"texels", "grids", "columns", "chunk", "resident_bytes"})
        EXPECT_EQ(remembered["forms"][part], measured["forms"][part]) << part;
    EXPECT_EQ(remembered["state_hash"], measured["state_hash"]);
    for (const std::string& file : files())
        if (file.starts_with("kept/")) write(file, "damaged");
    const nlohmann::json again = runIt();
    EXPECT_EQ(again["forms"]["source"], "measured");
    EXPECT_EQ(again["state_hash"], measured["state_hash"]);
    const nlohmann::json off = report({"box.toml", "--frames", "100"}, {{"SINEW_CACHE", "off"}});
    EXPECT_EQ(off["forms"]["source"], "measured");
    const nlohmann::json given = report({"box.toml", "--frames", "5", "--forms", "columns=1,chunk=1"}, kept);
    EXPECT_EQ(given["forms"]["source"], "given");
    EXPECT_EQ(report({"box.toml", "--frames", "5"}, kept)["forms"]["source"], "usual");
}

// A body that is absent from start to end changes no figure.
TEST_F(SameState, OfFiguresBesideAnAbsentBody) {
    const std::string box = "[[box]]\nparticles = [3, 3, 3]\nspacing = 0.1\ncenter = [0, 0.3, 0]\n";
    const std::string guest = "[[box]]\nname = \"guest\"\nparticles = [3, 3, 3]\nspacing = 0.1\n"
                              "center = [2, 0.5, 0]\nvelocity = [3, 0, 0]\ncollides = true\nabsent = true\n",
                      solver = "[solver]\nsubsteps = 8\nsleep = true\n", host = box + "collides = true\n";
    for (const std::string plane : {"", "[[plane]]\n[[plane]]\nnormal = [0, -1, 0]\noffset = -9\n"}) {
        write("alone.toml", solver + plane + host);
        write("beside.toml", solver + plane + host + guest);
        const auto reportOf = [&](const char* scene) {
            return report({scene, "--frames", "60", "--trace", "trace.csv", "--trace-every", "30"});
        };
        const auto trace = [&] { // without the memory that is in use
            std::ifstream stream(folder_ / "trace.csv");
            std::string kept;
            for (std::string line; std::getline(stream, line);)
                kept += line.substr(0, line.rfind(',', line.rfind(',') - 1)) + "\n";
            return kept;
        };
        const nlohmann::json alone = reportOf("alone.toml");
        const std::string traced = trace();
        const nlohmann::json beside = reportOf("beside.toml");
        EXPECT_EQ(alone["error"], beside["error"]);
        EXPECT_EQ(alone["sleeping"], beside["sleeping"]);
        EXPECT_EQ(traced, trace());
        EXPECT_EQ(alone["error"]["momentum"].is_null(), !plane.empty());
        EXPECT_FALSE(alone["error"]["volume"].is_null());
    }
}
