// Plays every shipped scene with cuts or tears, with all checks of sim/cutting/stroke_check after each
// stroke, and in some steps of a tear. Scenes are found in their folder, so new ones are included. To take
// only seconds, the test uses coarser voxels and fewer substeps and strokes, and waits for rest only before
// the first stroke. SINEW_FULL=1 plays the scenes as they are, except that checked bodies stay awake.
#include "scenes/blades.hpp"
#include "sim/cutting/stroke_check.hpp"
#include "sim/cutting/swept_area.hpp"
#include "support/full.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace sinew;
namespace fs = std::filesystem;
using test::isFull;
using test::StrokeCheck;
using test::StrokeResult;

namespace {

constexpr std::uint32_t fewSubsteps = 8, roomForContacts = 160, roomForSurface = 1u << 19;
constexpr float coarseVoxel = 0.025f;                 // [m]
constexpr std::uint64_t fewSteps = 2, someSteps = 90; // between strokes; of a scene that tears
constexpr std::size_t fewStrokes = 5;

std::vector<std::string> cutSceneNames() {
    std::vector<std::string> names;
    for (const fs::directory_entry& file : fs::directory_iterator(SINEW_SOURCE_FOLDER "/scenes")) {
        std::ifstream stream(file.path());
        const std::string text(std::istreambuf_iterator<char>(stream), {});
        const auto has = [&](const char* words) { return text.find(words) != std::string::npos; };
        if (has("\n[[blade]]") || has("\n[[strokes]]") || has("\ntear = "))
            names.push_back(file.path().stem().string());
    }
    std::ranges::sort(names);
    return names;
}

scenes::LoadedScene loadScene(const std::string& name) {
    scenes::Overrides overrides;
    if (!isFull()) overrides.voxel = coarseVoxel;
    scenes::LoadedScene loaded = scenes::load(SINEW_SOURCE_FOLDER "/scenes/" + name + ".toml", overrides);
    loaded.settings.contactRoom = roomForContacts;
    if (isFull())
        loaded.settings.cutSurfaceRoom = roomForSurface;
    else
        loaded.settings.substeps = std::min(loaded.settings.substeps, fewSubsteps);
    return loaded;
}

// The checked steps of a scene: those with a blade, or every few of those in which the body may tear.
std::vector<std::uint64_t> stepsToLookAt(const scenes::LoadedScene& loaded) {
    scenes::ScriptedBlades blades(loaded.blades, loaded.scene.dt);
    const bool tears = loaded.scene.grids[0].tearStrain > 0;
    const std::uint64_t most = isFull() ? 2000 : tears ? someSteps : 1000;
    std::vector<std::uint64_t> steps;
    std::size_t strokes = 0;
    for (std::uint64_t frame = 1; frame < most; ++frame) {
        const sim::Blade blade = blades.at(frame);
        strokes += !blade.from.empty() && !blade.isCarried ? 1 : 0;
        if (strokes > fewStrokes && !isFull()) break;
        if (!blade.from.empty() || (tears && frame % 10 == 0)) steps.push_back(frame);
    }
    return steps;
}

// Single particles cannot be cut, so the swept area is meaningless for fragments.
constexpr std::uint32_t mostPieces = 10;

// Compares the areas of a cut. Returns false if the cut ends inside of a body and the uncertainty of this
// end, between particles, is as large as the rest.
bool checkArea(const test::CutArea& cut, double cell, const std::string& what) {
    const double ofEnd = 2 * cell * cut.front;
    const bool isSure = cut.swept > 0 && cut.swept >= 1.5 * ofEnd;
    EXPECT_LE(std::abs(cut.inside - cut.swept), 0.05 * cut.swept + (isSure ? 0.6 : 1.0) * ofEnd) << what;
    if (!isFull() || !isSure) return isSure;
    std::printf("%s: inside %.5f m^2, %+.1f %% of what the blade swept", what.c_str(), cut.inside,
                100 * (cut.inside / cut.swept - 1));
    if (cut.front > 0)
        std::printf(": %+.2f cells at %.2f m of an end inside", (cut.inside - cut.swept) / ofEnd, cut.front);
    std::printf("\n");
    return true;
}

class CutScenes : public testing::TestWithParam<std::string> {};

} // namespace

TEST_P(CutScenes, HoldAfterEveryStroke) {
    const scenes::LoadedScene loaded = loadScene(GetParam());
    ASSERT_EQ(loaded.scene.grids.size(), 1u) << "one body a scene";
    scenes::ScriptedBlades blades(loaded.blades, loaded.scene.dt);
    StrokeCheck check(loaded.scene, loaded.settings, false);
    std::uint64_t done = 1;                           // the check has taken the first step
    std::size_t looked = 0, inVain = 0, measured = 0; // numbers of areas
    double volumeError = 0;
    StrokeResult last;
    for (const std::uint64_t step : stepsToLookAt(loaded)) {
        const std::uint64_t wait = step - std::min(done, step);
        const sim::Blade blade = blades.at(step);
        const bool isPlayed = isFull() || blade.from.empty() || looked + inVain == 0;
        check.run(static_cast<int>(isPlayed ? wait : std::min(wait, fewSteps)));
        done = step + 1;
        const std::string what = GetParam() + ", step " + std::to_string(step);
        const vk::Buffer before = check.body().runner().saveTopology();
        last = check.stroke(blade, what);
        check.checkSurface(last, what);
        volumeError = std::max(volumeError, std::abs(last.volumeError));
        (last.status.linksCut > 0 ? looked : inVain) += 1;
        if (isFull() && last.status.linksCut > 0)
            std::printf("step %4u: %5u links cut, %4u pieces, %zu triangles, %zu open edges, %zu with four "
                        "triangles, volume %+.1e\n",
                        static_cast<unsigned>(step), last.status.linksCut, last.status.pieces, last.triangles,
                        last.openEdges, last.crowdedEdges, last.volumeError);
        if (!blade.from.empty() && !blade.isCarried && last.triangles > 0 && last.status.pieces <= mostPieces)
            measured +=
                checkArea(test::cutArea(check.body(), before, blade), check.body().spacing(), what) ? 1 : 0;
        ASSERT_FALSE(HasFailure()); // later failures would only repeat it
    }
    EXPECT_GT(looked, 0u) << "nothing was cut";
    const bool isSheet = sim::lattice::isSheet(loaded.scene.grids[0]);
    const bool isCoarse = GetParam() == "shred" && !isFull();
    EXPECT_TRUE(isSheet || last.triangles > 0) << "there is no surface";
    EXPECT_TRUE(measured > 0 || isSheet || isCoarse) << "no area was looked at";
    if (GetParam() == "shred") {
        EXPECT_LE(50 * inVain, looked) << "strokes meet what is left of the body";
    }
    std::printf("%s: %zu steps with cuts, %zu without, %u links cut, %u pieces, %zu triangles, volume within "
                "%.1e\n",
                GetParam().c_str(), looked, inVain, last.status.linksCutInAll, last.status.pieces,
                last.triangles, volumeError);
}

INSTANTIATE_TEST_SUITE_P(Shipped, CutScenes, testing::ValuesIn(cutSceneNames()),
                         [](const auto& scene) { return scene.param; });

TEST(ShippedScenes, AreCutInSix) {
    EXPECT_EQ(cutSceneNames(), (std::vector<std::string>{"cloth_cut", "cube_quarters", "organ_incision",
                                                         "shred", "tear", "tube_slice"}));
}
