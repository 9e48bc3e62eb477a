// Tests of help, of wrong usage, and of the commands that need no device.
#include "tools/program.hpp"

#include <set>

using sinew::test::expectOneError;
using sinew::test::Outcome;
using sinew::test::shippedScene;

namespace {

class Usage : public sinew::test::Program {};

const sinew::test::Environment noDevice{{"VK_ICD_FILENAMES", "/nonexistent.json"},
                                        {"VK_DRIVER_FILES", "/nonexistent.json"}};

} // namespace

TEST_F(Usage, HelpNamesEveryCommandOptionAndExitCode) {
    const Outcome help = run({"--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_EQ(help.error, "");
    for (const char* word : {"run", "describe", "mesh", "devices", "bench", "Exit codes", "130"})
        EXPECT_NE(help.out.find(word), std::string::npos) << word;
    const Outcome runHelp = run({"run", "--help"});
    EXPECT_EQ(runHelp.code, 0);
    for (const char* word : {"--frames", "--out", "--json", "--solver", "--substeps", "--iterations",
                             "--device", "--reversed", "--validation", "240", "jacobi"})
        EXPECT_NE(runHelp.out.find(word), std::string::npos) << word;
}

TEST_F(Usage, VersionIsPrinted) {
    const Outcome version = run({"--version"});
    EXPECT_EQ(version.code, 0);
    EXPECT_EQ(version.out.find("sinew "), 0u);
}

TEST_F(Usage, WrongUsageIsCodeTwoAndPointsAtTheRightHelp) {
    const std::vector<std::vector<std::string>> wrong = {
        {},
        {"frobnicate"},
        {"run"},
        {"run", "a.toml", "b.toml"},
        {"run", "a.toml", "--frames", "0"},
        {"run", "a.toml", "--frames", "-1"},
        {"run", "a.toml", "--frames", "many"},
        {"run", "a.toml", "--frames"},
        {"run", "a.toml", "--substeps", "0"},
        {"run", "a.toml", "--substeps", "1001"},
        {"run", "a.toml", "--substeps", "0x10"},
        {"run", "a.toml", "--levels", "7"},
        {"run", "a.toml", "--levels", "7"},
        {"run", "a.toml", "--levels", "many"},
        {"run", "a.toml", "--iterations", "0"},
        {"run", "a.toml", "--solver", "magic"},
        {"run", "a.toml", "--voxel", "-1"},
        {"run", "a.toml", "--voxel", "nan"},
        {"run", "a.toml", "--voxel", "inf"},
        {"run", "a.toml", "--voxel", "1e300"},
        {"run", "a.toml", "--unknown"},
        {"describe"},
        {"mesh"},
        {"mesh", "a.obj", "--resolution", "0"},
        {"mesh", "a.obj", "--resolution", "4", "--voxel", "1"},
        {"mesh", "a.obj", "--particles", "7"},
        {"mesh", "a.obj", "--unit", "parsec"},
        {"mesh", "a.obj", "--scale", "0"},
        {"mesh", "a.obj", "--scale", "1e38"},
        {"mesh", "a.obj", "--scale", "nan"},
        {"mesh", "a.obj", "--voxel", "nan"},
        {"mesh", "a.obj", "--particles", "70", "--voxel", "1"},
        {"bench", "--scene", "heap"},
        {"bench", "--seconds", "0"},
        {"bench", "--kernels", "--peers"},
        {"bench", "--contacts", "--kernels"},
        {"bench", "--contacts", "--peers"},
        {"bench", "--only", "stack"},
        {"bench", "--by-form", "--kernels"},
        {"bench", "--by-form", "--contacts"},
        {"bench", "--forms", "chunk=1"},
        {"bench", "--kernels", "--forms", "chunk=65536"},
        {"run", "a.toml", "--forms", "columns=3"},
        {"run", "a.toml", "--forms", "columns"},
        {"run", "a.toml", "--forms", "texels=2"},
        {"run", "a.toml", "--forms", "items=1"},
        {"describe", "a.toml", "--forms", "rows=1"},
        {"describe", "a.toml", "--predict"},
        {"describe", "a.toml", "--cards", "b.csv"},
        {"bench", "--contacts", "--only", "heap"},
        {"devices", "extra"},
    };
    for (const std::vector<std::string>& arguments : wrong) {
        const std::string command =
            arguments.empty() || arguments[0] == "frobnicate" ? "" : arguments[0] + " ";
        expectOneError(run(arguments), 2, "see `sinew " + command + "--help`");
    }
}

TEST_F(Usage, WhatIsMisspeltIsNamedWithWhatIsSpelledAlike) {
    expectOneError(run({"rnu", "a.toml"}), 2, "no command \"rnu\": did you mean run?");
    expectOneError(run({"run", "a.toml", "--frame", "10"}), 2, "did you mean --frames?");
    expectOneError(run({"descibe"}), 2, "did you mean describe?");
    expectOneError(run({"frobnicate"}), 2, "no command \"frobnicate\": see `sinew --help`");
    expectOneError(run({"--versoin"}), 2, "did you mean --version?");
    expectOneError(run({}), 2, "name a command: run, describe, mesh, devices, bench, study: see");
}

TEST_F(Usage, DescribeNeedsNoDevice) {
    const Outcome outcome = run({"describe", shippedScene("cube")}, noDevice);
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    EXPECT_NE(outcome.out.find("4096 particles"), std::string::npos);
    EXPECT_NE(outcome.out.find("-- barrier"), std::string::npos);
    EXPECT_NE(
        run({"describe", shippedScene("cube"), "--solver", "jacobi"}, noDevice).out.find("apply_corrections"),
        std::string::npos);
}

TEST_F(Usage, DescribePredictsCardsThatAreNotThere) {
    const Outcome outcome = run({"describe", shippedScene("cube"), "--predict", "h200"}, noDevice);
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    EXPECT_EQ(outcome.out.rfind("predicted for h200, not measured", 0), 0u) << outcome.out;
    EXPECT_NE(outcome.out.find("gather_node "), std::string::npos) << outcome.out;
    expectOneError(run({"describe", shippedScene("cube"), "--predict", "h300"}, noDevice), 2,
                   "no card \"h300\": choose h200, rx6900xt, rtx4060m, xelp96");
    const auto cards = write("cards.csv", "name,simds,lanes,waves,ghz,gb_s,dispatch_us,empty_us\n"
                                          "mine,10,32,16,1,100,1000,1000\n");
    const Outcome mine =
        run({"describe", shippedScene("cube"), "--predict", "mine", "--cards", cards.string()}, noDevice);
    EXPECT_EQ(mine.code, 0) << mine.error;
    EXPECT_NE(mine.out.find("all: 34."), std::string::npos) << mine.out; // 34 dispatches of 1 ms, and work
    expectOneError(
        run({"describe", shippedScene("cube"), "--predict", "mine", "--cards", "no.csv"}, noDevice), 3,
        "cannot read cards: no.csv");
}

TEST_F(Usage, MeshRepairsAndSaysSo) {
    // A cube whose top meets a wall in a T-junction.
    const auto mesh =
        write("t.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\nv 0.5 1 0\n"
                       "f 1 2 3\nf 1 3 4\nf 5 8 9\nf 9 8 7\nf 9 7 6\nf 1 5 6\nf 1 6 2\nf 2 6 7\nf 2 7 3\n"
                       "f 3 7 8\nf 3 8 4\nf 4 8 5\nf 4 5 1\n");
    const Outcome text = run({"mesh", mesh.string()}, noDevice);
    EXPECT_NE(text.out.find("closed, volume 1 m^3"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("repaired  1 edge was split at T-junctions"), std::string::npos) << text.out;
    const Outcome none = run({"mesh", mesh.string(), "--repair", "none", "--json", "-"}, noDevice);
    const auto report = nlohmann::json::parse(none.out);
    EXPECT_EQ(report["repair"]["how"], "none");
    EXPECT_EQ(report["repair"]["split_edges"], 0);
    EXPECT_EQ(report["surface"]["boundary_edges"], 3);
    expectOneError(run({"mesh", mesh.string(), "--repair", "all"}), 2, "see `sinew mesh --help`");
    expectOneError(run({"mesh", mesh.string(), "--repair", "none", "--weld", "1"}), 2,
                   "--weld: is given, but --repair none joins nothing: remove one of them");
}

TEST_F(Usage, MeshNeedsNoDeviceAndReportsWhatItFound) {
    const auto mesh = write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
    const Outcome text = run({"mesh", mesh.string()}, noDevice);
    EXPECT_EQ(text.code, 0) << text.error;
    EXPECT_NE(text.out.find("3 boundary edges"), std::string::npos) << text.out;
    const Outcome json = run({"mesh", mesh.string(), "--voxel", "0.25", "--json", "-"}, noDevice);
    ASSERT_EQ(json.code, 0) << json.error;
    const auto report = nlohmann::json::parse(json.out);
    EXPECT_EQ(report["schema"], 1);
    EXPECT_EQ(report["surface"]["triangles"], 3);
    EXPECT_EQ(report["surface"]["boundary_edges"], 3);
    EXPECT_EQ(report["surface"]["closed"], false);
    EXPECT_TRUE(report["surface"]["volume"].is_null());
    EXPECT_EQ(report["repair"]["how"], "close");
    EXPECT_EQ(report["repair"]["open_edges"], 3);
    EXPECT_EQ(report["repair"]["largest_hole"]["edges"], 3);
    EXPECT_EQ(report["voxels"]["spacing"], 0.25);
    EXPECT_GT(report["voxels"]["hull"], 0);
    EXPECT_GT(report["voxels"]["bytes"], 0);
    EXPECT_EQ(report["voxels"]["filled_by"], "host");
    const Outcome budget = run({"mesh", mesh.string(), "--particles", "500", "--json", "-"}, noDevice);
    ASSERT_EQ(budget.code, 0) << budget.error;
    EXPECT_LE(nlohmann::json::parse(budget.out)["voxels"]["particles"], 500);
}

TEST_F(Usage, MeshTakesUnitScaleAndObject) {
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 3 0 0\nv 5 0 0\nv 3 2 0\nv 3 0 2\n";
    const auto mesh = write("two.obj", corners + "o liver\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
                                                 "o gall\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n");
    const auto report = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"mesh", mesh.string(), "--json", "-"});
        const Outcome outcome = run(options, noDevice);
        EXPECT_EQ(outcome.code, 0) << outcome.error;
        return nlohmann::json::parse(outcome.out);
    };
    const auto whole = report({});
    EXPECT_EQ(whole["components"]["count"], 2);
    EXPECT_EQ(whole["components"]["largest"][0]["name"], "gall");
    EXPECT_NEAR(whole["components"]["largest"][0]["volume"].get<double>(), 8.0 / 6, 1e-6);
    EXPECT_EQ(whole["components"]["largest"][1]["triangles"], 4);
    EXPECT_NEAR(report({"--object", "liver"})["surface"]["high"][0].get<double>(), 1, 1e-6);
    EXPECT_NEAR(report({"--object", "liver", "--object", "part 1"})["surface"]["high"][0].get<double>(), 5,
                1e-6);
    EXPECT_NEAR(report({"--unit", "cm", "--scale", "2"})["surface"]["high"][0].get<double>(), 0.1, 1e-6);
    expectOneError(run({"mesh", mesh.string(), "--object", "galll"}, noDevice), 3,
                   "which no object of " + mesh.string() + " is called: did you mean \"gall\"?");
    const Outcome strange = run({"mesh", mesh.string(), "--object", "kidney"}, noDevice);
    expectOneError(strange, 3, "is called: there are \"liver\", \"gall\"");
    expectOneError(run({"mesh", mesh.string(), "--scale", "1e-30"}, noDevice), 3,
                   "--unit m with --scale 1e-30 makes the mesh 5e-30 m long");
}

TEST_F(Usage, MeshSpeaksOfHolesInWhatWasChosenAlone) {
    const auto mesh =
        write("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 3 0 0\nv 5 0 0\nv 3 2 0\nv 3 0 2\n"
                         "o liver\nf 1 3 2\nf 1 2 4\nf 1 4 3\no gall\nf 5 7 6\nf 5 6 8\nf 5 8 7\n"
                         "f 6 7 8\n");
    const auto text = [&](const std::string& object) {
        return run({"mesh", mesh.string(), "--object", object}, noDevice).out;
    };
    EXPECT_NE(text("liver").find("  open      3 boundary edges"), std::string::npos);
    EXPECT_EQ(text("gall").find("  open "), std::string::npos);
}

TEST_F(Usage, MeshSaysWhatIsLikelyToSurprise) {
    const auto mesh =
        write("two.obj", "v 0 0 0\nv 40 0 0\nv 40 0 40\nv 0 0 40\nv 0 1 0\nv 40 1 0\nv 40 1 40\nv 0 1 40\n"
                         "v 0 2 0\nv 1 2 0\nv 0 3 0\nv 0 2 1\n"
                         "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n"
                         "f 9 11 10\nf 9 10 12\nf 9 12 11\nf 10 11 12\n");
    const Outcome outcome = run({"mesh", mesh.string(), "--voxel", "2"}, noDevice);
    for (const std::string sentence :
         {" is 40 m long: if the file is in millimetres, say --unit mm\n",
          " has 2 components, 1 m apart at the nearest (\"part 1\" and \"part 2\"), that voxels of 2 m "
          "join\n",
          " is 1 m thin at the thinnest 5 % of its surface, less than 2 voxels of 2 m: --voxel 0.5 gives "
          "two\n"})
        EXPECT_NE(outcome.error.find("warning: " + mesh.string() + sentence), std::string::npos)
            << sentence << outcome.error;
    EXPECT_EQ(run({"mesh", mesh.string(), "--resolution", "90", "--unit", "cm"}, noDevice).error, "");
}

TEST_F(Usage, MeshMakesTheSameVoxelsOnADevice) {
    const auto mesh =
        write("tetrahedron.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    const auto voxels = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"mesh", mesh.string(), "--voxel", "0.07", "--json", "-"});
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.error;
        EXPECT_EQ(outcome.error, "");
        return nlohmann::json::parse(outcome.out)["voxels"];
    };
    const auto host = voxels({}), device = voxels({"--device", "0", "--validation"});
    EXPECT_NE(device["filled_by"], "host");
    for (const char* key : {"cells", "hull", "core", "doubtful", "volume", "particles"})
        EXPECT_EQ(device[key], host[key]) << key;
    expectOneError(run({"mesh", mesh.string(), "--device", "no such device"}), 4, "no such device");
}

TEST_F(Usage, DevicesMarksTheOneThatWouldBeUsed) {
    const Outcome outcome = run({"devices"});
    EXPECT_EQ(outcome.code, 0) << outcome.error;
    EXPECT_NE(outcome.out.find("\n* "), std::string::npos) << outcome.out;
    if (outcome.out.find("llvmpipe") != std::string::npos) {
        EXPECT_NE(outcome.out.find("LP_NUM_THREADS=0"), std::string::npos);
    }
    expectOneError(run({"devices", "--device", "no such device"}), 4, "no such device");
}

TEST_F(Usage, BenchWritesARowForEverySolver) {
    const Outcome outcome = run({"bench", "--scene", "cloth", "--seconds", "0.01", "--json", "-"});
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    const auto rows = nlohmann::json::parse(outcome.out)["rows"];
    ASSERT_GE(rows.size(), 4u);
    std::vector<std::string> solvers{"sequential", "sequential", "jacobi", "split"};
    for (std::size_t i = solvers.size(); i < rows.size(); ++i) solvers.push_back(rows[i]["solver"]);
    EXPECT_EQ(std::set(solvers.begin() + 1, solvers.end()).size(), rows.size() - 1) << "a row for each";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i]["solver"], solvers[i]);
        EXPECT_EQ(rows[i]["constraints"], 16002);
        for (const char* field : {"scene", "size", "device", "particles", "substeps", "iterations",
                                  "fps_mean", "fps_stddev", "ms_mean", "ms_stddev", "ms_p50", "ms_p99",
                                  "ns_per_constraint_sweep", "speedup", "speedup_over_best", "precision"})
            EXPECT_TRUE(rows[i].contains(field)) << field;
        EXPECT_GT(rows[i]["ms_p50"], 0);
        EXPECT_TRUE(rows[i]["error"]["strain_rms"].is_number());
    }
    EXPECT_EQ(rows[0]["order"], "natural");
    EXPECT_EQ(rows[1]["order"], "color");
    EXPECT_TRUE(rows[0]["flags"].is_string());
    EXPECT_TRUE(rows[2]["flags"].is_null());
    EXPECT_EQ(rows[0]["speedup"], 1);
    EXPECT_LE(rows[2]["speedup_over_best"], rows[2]["speedup"]);
}

TEST_F(Usage, BenchOfContactsWritesWhatTheyCost) {
    const Outcome outcome =
        run({"bench", "--contacts", "--only", "box 14^3", "--seconds", "0.01", "--json", "-"});
    ASSERT_EQ(outcome.code, 0) << outcome.error;
    const auto rows = nlohmann::json::parse(outcome.out)["contacts"];
    ASSERT_EQ(rows.size(), 1u);
    const auto &row = rows[0], &with = row["with"], &without = row["without"];
    EXPECT_EQ(row["scene"], "box 14^3 in free fall");
    EXPECT_EQ(row["particles"], 2744);
    EXPECT_GT(row["ratio"], 0);
    EXPECT_GT(row["contact_bytes_per_particle"], 0);
    EXPECT_GE(with["steps"], 32);
    EXPECT_EQ(with["list_builds"], 0) << "it falls as one";
    EXPECT_EQ(without["list_builds"], 0);
    EXPECT_EQ(without["indirect_dispatches_per_substep"], 0) << "makes no lists";
    for (const char* field : {"ms_p50", "passes_per_substep", "dispatches_per_substep",
                              "barriers_per_substep", "gpu_dispatch_us_predicted"}) {
        EXPECT_GT(without[field], 0) << field;
        EXPECT_GE(with[field], without[field]) << field;
    }
    EXPECT_TRUE(with["finite"]);
}
