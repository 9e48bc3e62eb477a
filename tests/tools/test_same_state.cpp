// The state hash of a run must not depend on when it ran, on threads, or on the order of invocations.
#include "tools/program.hpp"

#include <fstream>

using namespace sinew;
using test::shippedScene;

namespace {

class SameState : public test::Program {
protected:
    std::string hash(const std::string& scene, const std::string& solver,
                     const std::vector<std::string>& more = {},
                     const test::Environment& environment = {}) const {
        std::vector<std::string> arguments{scene, "--solver", solver, "--frames", "4"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const nlohmann::json report = this->report(arguments, environment);
        EXPECT_EQ(report["finite"], true);
        return report["state_hash"].get<std::string>();
    }
};

/// The cube touches the floor within the frames that are compared.
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
    for (const std::string& scene : {shippedScene("cloth"), shippedScene("cube"), landedCube(folder_)})
        for (const char* solver : {"split", "jacobi", "gauss_seidel"}) {
            const std::string first = hash(scene, solver);
            EXPECT_EQ(hash(scene, solver), first) << scene << ", second run";
            EXPECT_EQ(hash(scene, solver), first) << scene << ", third run";
            for (const char* threads : {"0", "1", "2"})
                EXPECT_EQ(hash(scene, solver, {}, {{"LP_NUM_THREADS", threads}}), first)
                    << scene << ", threads " << threads;
            EXPECT_EQ(hash(scene, solver, {"--reversed"}), first) << scene << ", reversed";
        }
}

TEST_F(SameState, IsAnotherStateWithAnotherSolverOrNumberOfSubsteps) {
    const std::string scene = shippedScene("cloth");
    const std::string split = hash(scene, "split");
    EXPECT_NE(hash(scene, "jacobi"), split);
    EXPECT_NE(hash(scene, "split", {"--substeps", "65"}), split);
}
