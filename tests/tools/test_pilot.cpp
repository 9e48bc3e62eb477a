// Tests of what `sinew run` chooses: substeps by --error, levels, the clamp.
#include "tools/program.hpp"

using namespace sinew;
using nlohmann::json;
using test::expectOneError;
using test::Outcome;

namespace {

class PilotRun : public test::Program {};

const std::string bar = "[[box]]\nparticles = [8, 3, 3]\nspacing = 0.05\ncenter = [0, 0, 0]\n"
                        "young_modulus = 1e6\nclamped = [\"low_x\"]\n",
                  bySum = "[solver]\nsharp_clamp = false\n";

} // namespace

TEST_F(PilotRun, EstimatesTheErrorOfItsSubstepsFromPilotRuns) {
    write("beam.toml", bar + bySum); // with which 4 substeps lack most of the stiffness
    const std::vector<std::string> few{"beam.toml", "--frames", "10", "--substeps", "4"};
    EXPECT_TRUE(report(few)["error_estimate"].is_null());
    const auto estimate = [&](const std::string& substeps) {
        const json e =
            report({"beam.toml", "--frames", "10", "--substeps", substeps, "--error"})["error_estimate"];
        EXPECT_TRUE(e["of_motion"].is_number()) << e;
        EXPECT_EQ(e["steps"], 10);
        return e;
    };
    const json coarse = estimate("4"), fine = estimate("16");
    EXPECT_EQ(coarse["substeps"].size(), 3u);
    EXPECT_EQ(coarse["substeps"][2], 2 * coarse["substeps"][1].get<int>());
    EXPECT_GT(coarse["substeps"][2], 8) << "4 and 8 differ as much as 2 and 4: finer runs tell";
    EXPECT_GT(coarse["of_motion"], fine["of_motion"]);
    EXPECT_GE(coarse["of_motion"], coarse["difference"]) << "the finer run has an error as well";
    EXPECT_GT(coarse["of_motion"], coarse["of_body"]) << "it moves by less than its size";
    EXPECT_GT(coarse["order"], 0.4);
    const Outcome outcome = run({"run", "beam.toml", "--frames", "10", "--error"});
    EXPECT_NE(outcome.out.find("error of these substeps: about "), std::string::npos) << outcome.out;
    EXPECT_NE(run({"describe", "beam.toml"}).out.find("error of these substeps: not measured"),
              std::string::npos);
}

TEST_F(PilotRun, TakesTheSubstepsThatReachAnError) {
    write("beam.toml", bar);
    const json loose = report({"beam.toml", "--frames", "10", "--error", "10%"});
    const json tight = report({"beam.toml", "--frames", "10", "--error", "1%"});
    EXPECT_LT(loose["substeps"], tight["substeps"]);
    EXPECT_LE(loose["error_estimate"]["of_motion"], 0.1);
    EXPECT_LE(tight["error_estimate"]["of_motion"], 0.01);
    EXPECT_GT(loose["error_estimate"]["of_motion"], tight["error_estimate"]["of_motion"]);
    EXPECT_EQ(loose["substep_choice"]["reason"], "error");
    expectOneError(run({"run", "beam.toml", "--error", "much"}), 2, "much is no error");
    expectOneError(run({"run", "beam.toml", "--error", "0%"}), 2, "0% is no error");
    expectOneError(run({"run", "beam.toml", "--error", "1%", "--substeps", "8"}), 2, "exclude each other");
    report({"beam.toml", "--frames", "1", "--save", "beam.state"});
    expectOneError(run({"run", "beam.state", "--frames", "1", "--error"}), 2, "not a saved state");
    write("hanging.toml",
          "gravity = [0, 0, 0]\n[[box]]\nparticles = [3, 3, 3]\nspacing = 0.05\ncenter = [0, 0, 0]\n");
    expectOneError(run({"run", "hanging.toml", "--frames", "2", "--error", "1%"}), 3,
                   "cannot reach an error");
}

// A clamp by the sum leaves other links than the scene's: a state of one is none of the other.
TEST_F(PilotRun, GoesOnWithTheClampOfTheSavedRun) {
    write("beam.toml", bar);
    for (const char* clamp : {"--sharp-clamp", "--no-sharp-clamp"}) {
        report({"beam.toml", "--frames", "5", "--substeps", "4", "--save", "beam.state", clamp});
        EXPECT_EQ(report({"beam.state", "--frames", "5"})["state_hash"],
                  report({"beam.toml", "--frames", "10", "--substeps", "4", clamp})["state_hash"]);
    }
}

// Reports and saved states have the number.
TEST_F(PilotRun, TakesTheLevelsThatWin) {
    write(
        "beam.toml",
        "[[box]]\nparticles = [24, 6, 6]\nspacing = 0.02\norigin = [0, 0, 0]\nyoung_modulus = 2e5\n[solver]\n"
        "substeps = 8\nlevels = \"auto\"\n");
    const json chosen = report({"beam.toml", "--frames", "4", "--save", "half.state"});
    EXPECT_EQ(chosen["levels"], 2);
    EXPECT_EQ(report({"beam.toml", "--frames", "2", "--levels", "0"})["levels"], 0);
    EXPECT_EQ(report({"beam.toml", "--frames", "2", "--substeps", "64"})["levels"], 0);
    const std::vector<std::string> both{"beam.toml", "--frames", "2",   "--substeps",
                                        "auto",      "--levels", "auto"};
    std::vector<std::string> sum = both;
    sum.emplace_back("--no-sharp-clamp");
    EXPECT_EQ(report(sum)["substeps"], 11);
    EXPECT_EQ(report(sum)["levels"], 2);
    EXPECT_EQ(report(both)["levels"], 0) << "the sharp clamp is faster";
    EXPECT_GT(report(both)["substeps"], 22);
    const json rest = report({"half.state", "--frames", "4"});
    EXPECT_EQ(rest["levels"], 2);
    EXPECT_EQ(rest["state_hash"], report({"beam.toml", "--frames", "8", "--levels", "2"})["state_hash"]);
}

TEST_F(PilotRun, TakesTheClampOfTheSceneUnlessAskedForAnother) {
    const auto isSharp = [&](const std::string& keys, const std::vector<std::string>& options) {
        write("beam.toml", bar + keys);
        std::vector<std::string> arguments{"beam.toml", "--frames", "1"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return report(arguments)["sharp_clamp"].get<bool>();
    };
    EXPECT_TRUE(isSharp("", {}));
    EXPECT_FALSE(isSharp(bySum, {}));
    EXPECT_FALSE(isSharp("", {"--no-sharp-clamp"}));
    EXPECT_TRUE(isSharp(bySum, {"--sharp-clamp"}));
}

TEST_F(PilotRun, SaysWhichClampItHasAndWhy) {
    const auto clamp = [&](const std::string& scene, const std::vector<std::string>& options = {},
                           const std::string& substeps = "4") {
        write("beam.toml", scene);
        std::vector<std::string> arguments{"beam.toml", "--frames", "1", "--substeps", substeps};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return report(arguments)["clamp"];
    };
    EXPECT_EQ(clamp(bar), "sharp");
    EXPECT_EQ(clamp(bySum + bar), "sum: as asked");
    EXPECT_EQ(clamp(bar, {"--levels", "1"}), "sum: levels");
    EXPECT_EQ(clamp("damping_time = 0.01\n" + bar), "sum: internal damping");
    EXPECT_EQ(clamp(bar, {}, "64"), "sum: nothing is clamped");
    EXPECT_TRUE(clamp(bar, {"--solver", "jacobi"}).is_null());
    const auto describes = [&](const std::string& substeps, const std::string& text) {
        const std::string out = run({"describe", "beam.toml", "--substeps", substeps}).out;
        return out.find("\nclamp: " + text + "\n") != std::string::npos;
    };
    EXPECT_TRUE(describes("4", "sharp"));
    EXPECT_TRUE(describes("64", "sum: nothing is clamped"));
}
