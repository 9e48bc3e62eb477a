// Plays every shipped scene with contacts until a few frames after the first one (a contact between particles
// or faces, if the scene has such). Bits must be equal from run to run, with one thread and two, in reversed
// order and with other lists. Scenes are found in their folder, so new ones are included.
#include "sinew/study/plan.hpp"
#include "sinew/study/truth.hpp"
#include "support/full.hpp"
#include "tools/program.hpp"

#include <fstream>
#include <sstream>

using namespace sinew;
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t framesAfterContact = 4, mostFrames = 60;
constexpr double moved = 1e-3; // deviation from the motion without contacts that exceeds any rounding [m]

/// Large scenes keep all of their particles, but use fewer substeps.
constexpr std::size_t large = 10'000;
constexpr std::uint32_t substepsOfLarge = 4;

std::vector<std::string> sceneNames() {
    std::vector<std::string> names;
    for (const fs::directory_entry& file : fs::directory_iterator(SINEW_SOURCE_FOLDER "/scenes"))
        if (file.path().extension() == ".toml") names.push_back(file.path().stem().string());
    std::ranges::sort(names);
    return names;
}

/// Names of the scenes with contacts. drop_mesh has no mesh yet, but a floor. cloth_cut has contacts only
/// when its first strip has fallen, long after the cut; test_cut_sheets covers it. The organ of organ_held
/// reaches its floor only after a cut.
std::vector<std::string> contactSceneNames() {
    std::vector<std::string> names = sceneNames();
    std::erase_if(names, [](const std::string& name) {
        if (name == "drop_mesh") return false;
        return name == "cloth_cut" || name == "organ_held" ||
               !tools::study::isOfContacts(scenes::load(test::shippedScene(name)).scene);
    });
    return names;
}

class ContactScenes : public test::Program, public testing::WithParamInterface<std::string> {
protected:
    /// The scene's file, or a mesh for the scene that drops one.
    std::string argument() const {
        if (GetParam() != "drop_mesh") return test::shippedScene(GetParam());
        return write("tetrahedron.obj",
                     "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
            .string();
    }

    static tools::Session& session() {
        static tools::Session shared{tools::DeviceOptions{}};
        return shared;
    }
};

/// The scene without contacts of particles and faces. A floor and colliders remain, so that only such
/// contacts count as the first.
sim::Scene withoutContacts(sim::Scene scene) {
    const bool hasLists =
        std::ranges::any_of(scene.particles, [](const sim::Particle& p) { return p.radius > 0; });
    if (!hasLists) {
        scene.planes.clear();
        scene.colliders.clear();
    }
    scene.faces.clear();
    for (sim::Particle& particle : scene.particles) particle.radius = 0;
    return scene;
}

std::string hashOf(tools::Runner& runner) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx",
                  static_cast<unsigned long long>(tools::stateHash(runner.readState())));
    return text;
}

std::string hashOf(tools::Session& session, const scenes::LoadedScene& loaded, const sim::Settings& settings,
                   std::uint64_t frames) {
    tools::Runner runner(session, loaded.scene, settings, {loaded.blades, loaded.scene.dt});
    runner.advance(frames, 1);
    EXPECT_EQ(runner.steps(), frames);
    return hashOf(runner);
}

struct FirstRun {
    std::uint64_t frames =
        0; ///< number of frames until contacts have moved a particle, and a few more; 0 = never
    std::string hash;
};

FirstRun firstRun(tools::Session& session, const scenes::LoadedScene& loaded) {
    const sim::Scene free = withoutContacts(loaded.scene);
    tools::Runner touching(session, loaded.scene, loaded.settings), falling(session, free, loaded.settings);
    for (std::uint64_t frame = 1; frame <= mostFrames; ++frame) {
        touching.advance(1, 1);
        falling.advance(1, 1);
        const auto a = tools::study::positionsOf(touching.readState()),
                   b = tools::study::positionsOf(falling.readState());
        if (tools::study::distanceOf(a, b).max <= moved) continue;
        const std::uint64_t frames = frame + framesAfterContact;
        // A blade changes the motion, too, so the search used neither; runs the scene again with it.
        if (!loaded.blades.empty()) return {frames, hashOf(session, loaded, loaded.settings, frames)};
        touching.advance(framesAfterContact, 1);
        EXPECT_EQ(touching.steps(), frames);
        return {frames, hashOf(touching)};
    }
    return {};
}

using FoldedCloth = test::Program;

} // namespace

TEST_P(ContactScenes, EndInTheSameBitsWhateverRunsThem) {
    scenes::LoadedScene loaded = scenes::load(argument());
    sim::Settings& settings = loaded.settings;
    if (loaded.scene.particles.size() > large) settings.substeps = substepsOfLarge;
    const FirstRun run = firstRun(session(), loaded);
    const std::uint64_t frames = run.frames;
    const std::string& first = run.hash;
    ASSERT_GT(frames, 0u) << "no contact within " << mostFrames << " frames";
    const auto hash = [&](const sim::Settings& with) { return hashOf(session(), loaded, with, frames); };
    std::printf("%s: %s after %u frames\n", GetParam().c_str(), first.c_str(), static_cast<unsigned>(frames));
    sim::Settings other = settings;
    other.isReversed = true;
    if (test::isFull()) {
        EXPECT_EQ(hash(other), first) << "reversed";
    }
    other.contactMargin *= 0.4f;
    EXPECT_EQ(hash(other), first) << "reversed, another margin";
    for (const char* threads : {"1", "2"}) {                // these are also second and third runs
        if (threads[0] == '2' && !test::isFull()) continue; // the first run uses all threads of the machine
        EXPECT_EQ(report({argument(), "--frames", std::to_string(frames), "--substeps",
                          std::to_string(settings.substeps)},
                         {{"LP_NUM_THREADS", threads}})["state_hash"],
                  first)
            << "threads " << threads;
    }
}

INSTANTIATE_TEST_SUITE_P(Shipped, ContactScenes, testing::ValuesIn(contactSceneNames()),
                         [](const auto& scene) { return scene.param; });

TEST(ShippedScenes, HaveContactsInMoreThanAFew) {
    EXPECT_GE(contactSceneNames().size(), 16u);
}

// Their folds pass through each other without a thickness, which is why cloth_links and cloth_links_on_sphere
// are for measurements alone.
TEST_F(FoldedCloth, OfTheShippedSheetsStaysOutsideItself) {
    for (const auto& [scene, frames] : {std::pair{"cloth", "150"}, std::pair{"cloth_on_sphere", "100"}})
        EXPECT_EQ(report({test::shippedScene(scene), "--frames", frames})["error"]["edges_through_faces"], 0)
            << scene;
}

// The shipped strip that falls onto itself. With too few substeps it passes through its own folds, and
// contacts on the wrong side keep it moving.
TEST_F(FoldedCloth, ComesToRestOutsideItself) {
    const nlohmann::json report = this->report(
        {test::shippedScene("cloth_fold"), "--frames", "60", "--trace", "trace.csv", "--trace-every", "60"});
    std::ifstream stream(folder_ / "trace.csv");
    std::string line, field;
    while (std::getline(stream, line) && line.rfind("60,", 0) != 0) {
    }
    std::istringstream fields(line);
    for (int k = 0; k < 3; ++k) std::getline(fields, field, ',');
    EXPECT_LT(std::stod(field), 2e-3) << "kinetic energy [J]; 0.1 where it has passed through itself";
    EXPECT_EQ(report["error"]["edges_through_faces"], 0);
    EXPECT_LT(report["error"]["strain_max"], 0.05) << "0.26 where zones hold its folds";
    EXPECT_EQ(report["substep_choice"]["reason"], "stiffness");
    EXPECT_TRUE(report["warnings"].empty());
}
