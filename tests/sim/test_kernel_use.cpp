// Tests that simulations of one device share the common parts of their programs.
#include "sim/program/program.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/vk/kernel_store.hpp"

#include <gtest/gtest.h>

using namespace sinew;
using namespace sinew::sim;

namespace {

// Number of other users of each kernel of a simulation's program.
std::vector<long> usersOf(const Simulation& simulation) {
    std::vector<long> users;
    for (const KernelUse& use : simulation.program().kernels) {
        std::vector<vk::SpecialisationConstant> constants;
        for (const auto& [id, value] : use.constants) constants.push_back({id, value});
        users.push_back(test::device().kernels().get(test::device(), *use.code, constants).use_count() - 1);
    }
    return users;
}

} // namespace

class KernelUsed : public testing::TestWithParam<bool> {};

TEST_P(KernelUsed, IsSharedBySimulations) {
    Scene scene = test::sheet(6, 1e-5f);
    test::addRoom(scene);
    const Settings settings{.substeps = 2, .keepsForces = GetParam()};
    test::Runner first(scene, settings);
    const std::vector<long> before = usersOf(first.simulation());
    {
        test::Runner second(scene, settings);
        const std::vector<long> during = usersOf(second.simulation());
        ASSERT_EQ(during.size(), before.size());
        for (std::size_t k = 0; k < before.size(); ++k) EXPECT_EQ(during[k], before[k] + 1) << k;
    }
    EXPECT_EQ(usersOf(first.simulation()), before);
}

INSTANTIATE_TEST_SUITE_P(, KernelUsed, testing::Bool(), [](const auto& keepsForces) {
    return std::string(keepsForces.param ? "with_forces" : "without_forces");
});
