// Tests of `sinew study` on a scene that takes a second: its output, its resumption, and its errors.
#include "tools/program.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

using sinew::test::expectOneError;
using sinew::test::Outcome;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::string scene =
    "name = \"tiny\"\n[[chain]]\nlength = 0.3\nparticles = 4\nstretch_compliance = 1e-2\n"
    "direction = [1, 0, 0]\n";

// Balls that fall onto a floor and onto each other.
const std::string balls = "name = \"tiny\"\n[contacts]\nfriction = 0.3\n[[particles]]\ncount = [2, 3, 2]\n"
                          "radius = 0.05\njitter = 0.01\nspacing = 0.13\ncenter = [0, 0.19, 0]\n[[plane]]\n";

class Study : public sinew::test::Program {
protected:
    Outcome study(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> arguments{"study",    "--scene", "scene.toml", "--out", "out",
                                           "--points", "1",       "--frames",   "4"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    std::string text(const std::string& name) const {
        std::ifstream stream(folder_ / "out" / name, std::ios::binary);
        std::ostringstream content;
        content << stream.rdbuf();
        return content.str();
    }
    std::vector<fs::path> runs() const {
        std::vector<fs::path> files;
        for (const auto& file : fs::directory_iterator(folder_ / "out" / "runs"))
            files.push_back(file.path());
        return files;
    }
};

} // namespace

TEST_F(Study, WritesWhatItsDocumentationSays) {
    write("scene.toml", scene);
    const Outcome outcome = study();
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    EXPECT_NE(outcome.out.find("page: out/study.html"), std::string::npos);
    const Json json = Json::parse(text("study.json"));
    EXPECT_EQ(json["schema"], 1);
    EXPECT_TRUE(json["device"]["name"].is_string());
    EXPECT_EQ(json["complete"], true);
    ASSERT_EQ(json["scenes"].size(), 1u);
    const Json& tiny = json["scenes"][0];
    EXPECT_EQ(tiny["name"], "tiny");
    EXPECT_EQ(tiny["particles"], 4);
    EXPECT_EQ(tiny["frames"], 4);
    EXPECT_LT(tiny["truth"]["self_difference"], 1e-6);
    EXPECT_EQ(tiny["truth"]["growth"].size(), 4u);
    ASSERT_GE(tiny["curves"].size(), 3u);
    for (const Json& curve : tiny["curves"]) {
        const std::string solver = curve["solver"];
        EXPECT_TRUE(tiny["ms_to_1_percent"].contains(solver));
        EXPECT_TRUE(tiny["speedup_over_jacobi"].contains(solver));
        EXPECT_TRUE(tiny["ms_to_1_percent_of_motion"].contains(solver));
        for (const Json& point : curve["points"]) {
            for (const char* field :
                 {"substeps", "iterations", "sweeps", "barriers", "ms_per_frame", "error_rms", "error_max"})
                EXPECT_TRUE(point[field].is_number()) << solver << ' ' << field;
            EXPECT_EQ(point["sweeps"], 8);
            EXPECT_GT(point["ms_per_frame"], 0);
            EXPECT_LE(point["error_rms"], point["error_max"]);
            EXPECT_GE(point["frames_timed"], 4);
            EXPECT_LE(point["ms_of_repeats"]["least"], point["ms_of_repeats"]["greatest"]);
            EXPECT_GE(point["load"]["least"], 0);
            EXPECT_NEAR(point["error_of_motion"].get<double>() *
                            tiny["truth"]["standing_still"].get<double>(),
                        point["error_rms"].get<double>(), 1e-9);
        }
    }
    // A soft chain of four needs at most eight substeps.
    EXPECT_TRUE(tiny["ms_to_1_percent"]["split"].is_number()) << tiny["ms_to_1_percent"];
    for (const char* name : {"tiny-time.svg", "tiny-sweeps.svg", "tiny-barriers.svg"})
        EXPECT_EQ(text(name).substr(0, 4), "<svg") << name;
    const std::string page = text("study.html");
    EXPECT_EQ(page.find("http"), page.find("http://www.w3.org/2000/svg")) << "the page fetches nothing";
    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_NE(page.find("name=\"viewport\""), std::string::npos);
    std::size_t points = 0;
    for (const Json& curve : tiny["curves"]) points += curve["points"].size();
    std::istringstream csv(text("study.csv"));
    std::size_t lines = 0;
    for (std::string line; std::getline(csv, line);) ++lines;
    EXPECT_EQ(lines, points + 1);
}

TEST_F(Study, GivesEverySolverTheSameMesh) {
    write("scene.toml", "name = \"tiny\"\n[[mesh]]\nname = \"ball\"\ngenerate = \"sphere\"\nsize = 0.2\n"
                        "resolution = 4\nyoung_modulus = 2e3\ncuttable = true\nspin = [3, 0, 0]\n");
    const Outcome outcome = study();
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    const Json json = Json::parse(text("study.json"))["scenes"][0];
    EXPECT_EQ(json["notes"], Json({"studied without the recovery that \"ball\" would have by default: jacobi "
                                   "and gauss_seidel do not support it",
                                   "studied without the contacts that \"ball\" would have by default: jacobi "
                                   "and gauss_seidel have none"}));
    std::set<std::string> solvers;
    for (const Json& curve : json["curves"]) solvers.insert(curve["solver"]);
    for (const char* solver : {"split", "jacobi", "gauss_seidel"})
        EXPECT_TRUE(solvers.contains(solver)) << solver;
    // The settings of the file itself give another scene, which only split supports, alone, with levels,
    // and with the clamp by the sum.
    write("scene.toml", "name = \"tiny\"\n[[mesh]]\nname = \"ball\"\ngenerate = \"sphere\"\nsize = 0.2\n"
                        "resolution = 4\nyoung_modulus = 2e3\nrecovery = 1\n[[plane]]\noffset = -1\n");
    const Outcome asked = study();
    ASSERT_EQ(asked.code, 0) << asked.error;
    EXPECT_EQ(Json::parse(text("study.json"))["scenes"][0]["curves"].size(), 3u);
}

TEST_F(Study, ComparesContactsWithShortStepsAndFollowsThemToRest) {
    write("scene.toml", balls);
    const Outcome outcome = study();
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    const Json json = Json::parse(text("study.json"))["scenes"][0];
    EXPECT_EQ(json["truth"]["kind"], "split");
    EXPECT_NEAR(json["truth"]["h"].get<double>(), 1 / 60e3, 1e-9);
    ASSERT_EQ(json["truth"]["halving"].size(), 4u);
    EXPECT_GT(json["truth"]["halving"][3], 0) << "half as many substeps are another run";
    EXPECT_LT(json["truth"]["halving"][3], 1e-3);
    EXPECT_EQ(json["truth"]["frames_at_1_percent"], 4);
    EXPECT_TRUE(json["ms_to_1_percent"]["split"].is_number());
    EXPECT_EQ(json["curves"].size(), 1u) << "no other solver has a form for particles that touch";
    EXPECT_NE(json["notes"].dump().find("jacobi was not tried everywhere"), std::string::npos);
    for (const Json& point : json["curves"][0]["points"]) EXPECT_GT(point["error_rms"], 0);
    ASSERT_EQ(json["rest"].size(), 3u);
    for (const Json& run : json["rest"]) {
        EXPECT_EQ(run["diverged"], false);
        ASSERT_EQ(run["samples"].size(), 8u) << "32 frames, every fourth";
        EXPECT_NEAR(run["samples"][7]["time"].get<double>(), 32 / 60.0, 1e-6);
        EXPECT_GT(run["samples"][0]["kinetic_energy"], 0);
        EXPECT_GE(run["penetration_max"], run["penetration_max_at_end"]);
        EXPECT_GE(run["penetration_max_at_end"], run["penetration_rms_at_end"]);
    }
    EXPECT_LT(json["rest"][2]["penetration_max"], json["rest"][0]["penetration_max"]) << "32 substeps, 8";
    for (const char* name : {"tiny-penetration.svg", "tiny-energy.svg"})
        EXPECT_EQ(text(name).substr(0, 4), "<svg") << name;
    EXPECT_NE(text("study.html").find("coming to rest"), std::string::npos);
    const std::string csv = text("rest.csv");
    EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 3 * 8);
    EXPECT_NE(outcome.out.find("split 32"), std::string::npos) << outcome.out;

    const std::string before = text("study.json");
    const Outcome again = study();
    EXPECT_EQ(again.error.find("runs to"), std::string::npos) << again.error;
    EXPECT_EQ(text("study.json"), before);
}

TEST_F(Study, RunsNothingAgain) {
    write("scene.toml", scene);
    ASSERT_EQ(study().code, 0);
    const std::string before = text("study.json");
    const Outcome again = study();
    ASSERT_EQ(again.code, 0) << again.error;
    EXPECT_EQ(again.error.find("runs to do"), std::string::npos) << again.error;
    EXPECT_EQ(again.error.find("timing"), std::string::npos) << again.error;
    EXPECT_EQ(text("study.json"), before);
}

// Errors are the same numbers; only times are measured twice.
TEST_F(Study, OfPartsIsThatOfTheWhole) {
    for (const auto& [content, points] : {std::pair{scene, "2"}, std::pair{balls, "1"}}) {
        write("scene.toml", content);
        const auto studyIn = [&](const char* folder, const std::vector<std::string>& more) {
            std::vector<std::string> arguments{"study",    "--scene", "scene.toml", "--out", folder,
                                               "--points", points,    "--frames",   "4"};
            arguments.insert(arguments.end(), more.begin(), more.end());
            const Outcome outcome = run(arguments);
            EXPECT_EQ(outcome.code, 0) << outcome.error;
            return outcome;
        };
        for (const char* folder : {"a", "b", "merged", "out"}) fs::remove_all(folder_ / folder);
        studyIn("a", {"--shard", "1/2"});
        const Outcome last = studyIn("b", {"--shard", "2/2"});
        EXPECT_NE(last.out.find("part 2/2"), std::string::npos) << last.out;
        EXPECT_FALSE(fs::exists(folder_ / "a" / "study.json"));
        const auto filesIn = [&](const char* folder) {
            return std::distance(fs::directory_iterator(folder_ / folder / "runs"), fs::directory_iterator());
        };
        const Outcome merged = studyIn("merged", {"--merge", "a", "b"});
        EXPECT_EQ(merged.error.find("runs to"), std::string::npos) << merged.error;
        EXPECT_EQ(merged.error.find("timing"), std::string::npos) << merged.error;
        studyIn("out", {});
        EXPECT_EQ(filesIn("merged"), filesIn("out"));
        EXPECT_LT(filesIn("a"), filesIn("merged"));

        const auto withoutTimes = [&](const char* folder) {
            Json tiny = Json::parse(std::ifstream(folder_ / folder / "study.json"))["scenes"][0];
            Json kept{{"notes", tiny["notes"]}, {"truth", tiny["truth"]}, {"rest", tiny["rest"]}};
            for (const Json& curve : tiny["curves"])
                for (const Json& point : curve["points"])
                    kept["points"].push_back({curve["solver"], point["substeps"], point["iterations"],
                                              point["sweeps"], point["barriers"], point["error_rms"],
                                              point["error_max"]});
            return kept;
        };
        EXPECT_EQ(withoutTimes("merged"), withoutTimes("out"));
        EXPECT_TRUE(fs::exists(folder_ / "merged" / "study.html"));
    }
}

TEST_F(Study, RunsAgainWhatIsMissingOrDamaged) {
    write("scene.toml", scene);
    ASSERT_EQ(study().code, 0);
    const std::size_t kept = runs().size();
    std::ofstream(runs().at(0)) << "{\"identity\": \"";
    fs::remove(runs().at(1));
    Json untimed = Json::parse(std::ifstream(runs().at(2)));
    untimed["frame_ms"] = Json::array(); // it would be at 0 ms, outside of a logarithmic axis
    std::ofstream(runs().at(2)) << untimed;
    const Outcome again = study();
    ASSERT_EQ(again.code, 0) << again.error;
    EXPECT_NE((again.error + again.out).find("page: "), std::string::npos);
    EXPECT_EQ(runs().size(), kept);
    for (const fs::path& file : runs()) {
        std::ifstream stream(file);
        const Json run = Json::parse(stream, nullptr, false);
        EXPECT_TRUE(run.is_object()) << file;
        EXPECT_FALSE(run.contains("frame_ms") && run["frame_ms"].empty()) << file;
    }
}

TEST_F(Study, KnowsAnotherSceneOfTheSameNameFromItsRuns) {
    write("scene.toml", scene);
    ASSERT_EQ(study().code, 0);
    const std::size_t kept = runs().size();
    write("scene.toml", scene + "mass = 0.2\n");
    const Outcome other = study();
    ASSERT_EQ(other.code, 0) << other.error;
    EXPECT_NE(other.error.find("runs to do"), std::string::npos);
    EXPECT_EQ(runs().size(), 2 * kept);
}

TEST_F(Study, RefusesWhatItCannotStudy) {
    expectOneError(run({"study", "--scene", "beem", "--out", "out"}), 3,
                   "cannot study: beem: no such scene: possible are beam, ");
    write("damped.toml", "damping = 1\n" + scene);
    expectOneError(run({"study", "--scene", "damped.toml", "--out", "out", "--points", "1"}), 3, "damping");
    write("rigid.toml", "[[chain]]\nlength = 1\n");
    expectOneError(run({"study", "--scene", "rigid.toml", "--out", "out", "--points", "1"}), 3,
                   "cannot study rigid");
    write("scene.toml", scene);
    for (const char* points : {"0", "9", "-1", "many"})
        expectOneError(run({"study", "--scene", "scene.toml", "--out", "out", "--points", points}), 2,
                       "--points");
    expectOneError(run({"study", "--scene", "scene.toml", "--out", "out", "--frames", "0"}), 2, "--frames");
    for (const char* shard : {"0/2", "3/2", "1", "1/", "/2", "1/2x", "-1/2"})
        expectOneError(run({"study", "--scene", "scene.toml", "--out", "out", "--shard", shard}), 2,
                       "--shard");
    expectOneError(run({"study", "--scene", "scene.toml", "--out", "out", "--merge", "nowhere"}), 3,
                   "cannot merge: nowhere/runs: ");
}

TEST_F(Study, RefusesAFolderItCannotWriteTo) {
    write("scene.toml", scene);
    write("file", "");
    expectOneError(run({"study", "--scene", "scene.toml", "--out", "file"}), 6, "file: ");
    expectOneError(run({"study", "--scene", "scene.toml", "--out", "/proc/sinew"}), 6, "/proc/sinew: ");
}
