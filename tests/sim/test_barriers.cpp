// Tests planBarriers against a brute-force search, on random lists of passes and on programs of real scenes.
#include "mesh/generate.hpp"
#include "mesh/to_scene.hpp"
#include "sim/compile/compile.hpp"
#include "sim/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
#include <random>
#include <utility>

using namespace sinew;
using namespace sinew::sim;

namespace {

// Buffers that a pass reads and writes, one bit a buffer.
constexpr std::size_t mostBuffers = 256;
struct Footprint {
    std::bitset<mostBuffers> reads, writes;
};

Footprint footprint(const Pass& pass) {
    Footprint result;
    for (const BufferUse& use : pass.uses) {
        if (use.access != vk::Access::write) result.reads.set(use.buffer.index);
        if (use.access != vk::Access::read) result.writes.set(use.buffer.index);
    }
    return result;
}

// Whether there is a read after write, write after write, or write after read.
bool conflict(const Footprint& first, const Footprint& second) {
    return ((first.writes & (second.reads | second.writes)) | (first.reads & second.writes)).any();
}

// Whether two passes in a run without barriers depend on each other.
bool hasHazard(std::span<const Footprint> run) {
    for (std::size_t j = 1; j < run.size(); ++j) {
        for (std::size_t i = 0; i < j; ++i) {
            if (conflict(run[i], run[j])) return true;
        }
    }
    return false;
}

// The runs between barriers.
std::vector<std::span<const Footprint>> runs(std::span<const Footprint> footprints,
                                             const std::vector<bool>& barriers) {
    std::vector<std::span<const Footprint>> result;
    std::size_t first = 0;
    for (std::size_t p = 1; p <= footprints.size(); ++p) {
        if (p < footprints.size() && !barriers[p]) continue;
        result.push_back(footprints.subspan(first, p - first));
        first = p;
    }
    return result;
}

// Smallest number of barriers without a hazard, by dynamic programming over the last run.
std::size_t fewestBarriers(std::span<const Footprint> footprints) {
    std::vector<std::size_t> fewest(footprints.size() + 1, footprints.size());
    fewest[0] = 0;
    for (std::size_t end = 1; end <= footprints.size(); ++end) {
        for (std::size_t first = 0; first < end; ++first) {
            if (hasHazard(footprints.subspan(first, end - first))) continue;
            fewest[end] = std::min(fewest[end], fewest[first] + (first > 0));
        }
    }
    return fewest[footprints.size()];
}

std::vector<Footprint> footprintsOf(std::span<const Pass> passes, Recording recording = {}) {
    std::vector<Footprint> result;
    for (const Pass& pass : passes)
        if (isIn(recording, pass)) result.push_back(footprint(pass));
    return result;
}

std::vector<bool> barriersOf(std::span<const Pass> passes, Recording recording = {}) {
    std::vector<bool> result;
    for (const Pass& pass : passes)
        if (isIn(recording, pass)) result.push_back(hasBarrier(recording, pass));
    return result;
}

// Expects no hazard within any run, and one after removing any single barrier.
void expectSafeAndNeeded(std::span<const Pass> passes, Recording recording = {}) {
    const std::vector<Footprint> footprints = footprintsOf(passes, recording);
    std::vector<bool> barriers = barriersOf(passes, recording);
    for (const auto& run : runs(footprints, barriers)) ASSERT_FALSE(hasHazard(run)) << "a barrier is missing";
    ASSERT_FALSE(!barriers.empty() && barriers[0]) << "nothing comes before the first pass";
    for (std::size_t p = 1; p < barriers.size(); ++p) {
        if (!barriers[p]) continue;
        barriers[p] = false;
        const auto merged = runs(footprints, barriers);
        ASSERT_TRUE(std::any_of(merged.begin(), merged.end(), hasHazard)) << "nobody needs barrier " << p;
        barriers[p] = true;
    }
}

// Kinds of work, as bits.
constexpr unsigned shaders = 1, transfers = 2, arguments = 4;

// The work of a pass that uses the buffer.
unsigned workOf(const Pass& pass, std::uint32_t buffer) {
    if (pass.kind != PassKind::dispatch) return transfers;
    unsigned work = 0;
    for (std::size_t u = 0; u < pass.uses.size(); ++u)
        if (pass.uses[u].buffer.index == buffer)
            work |= pass.isIndirect && u + 1 == pass.uses.size() ? arguments : shaders;
    return work;
}

// The work that has to wait for `work` after the barriers of the passes (first, last]: the work that a chain
// of dependencies leads to. Arguments are read before shaders run, so what orders shaders orders these.
unsigned orderedAfter(std::span<const Pass* const> passes, unsigned work, std::size_t first, std::size_t last,
                      std::size_t way) {
    unsigned reached = work == arguments ? shaders : work;
    bool isFirst = true;
    for (std::size_t p = first + 1; p <= last; ++p) {
        if (!passes[p]->barriers[way]) continue;
        const vk::BarrierScope& scope = passes[p]->scopes[way];
        const unsigned before = shaders | (scope.afterTransfers ? transfers : 0u);
        const unsigned after =
            shaders | (scope.beforeTransfers ? transfers : 0u) | (scope.beforeArguments ? arguments : 0u);
        if ((reached & before) != 0)
            reached = after;
        else if (isFirst)
            return 0; // what was written is not available to any later barrier
        isFirst = false;
    }
    return isFirst ? 0 : reached;
}

// Expects that each use of a buffer waits for those before it that it depends on.
void expectOrdered(std::span<const Pass> list, Recording recording = {}) {
    std::vector<const Pass*> passes;
    for (const Pass& pass : list)
        if (isIn(recording, pass)) passes.push_back(&pass);
    for (std::size_t j = 1; j < passes.size(); ++j)
        for (std::size_t i = 0; i < j; ++i)
            for (const BufferUse& a : passes[i]->uses)
                for (const BufferUse& b : passes[j]->uses) {
                    if (a.buffer != b.buffer ||
                        (a.access == vk::Access::read && b.access == vk::Access::read))
                        continue;
                    const unsigned first = workOf(*passes[i], a.buffer.index),
                                   second = workOf(*passes[j], b.buffer.index);
                    for (const unsigned one : {shaders, transfers, arguments})
                        if ((first & one) != 0) {
                            ASSERT_EQ(second & ~orderedAfter(passes, one, i, j, recording.index()), 0u)
                                << "pass " << j << " after " << i;
                        }
                }
}

// Expects that no barrier names work that does not happen beside it.
void expectNarrow(std::span<const Pass> list, Recording recording = {}) {
    const std::size_t way = recording.index();
    bool hasTransfers = false, hasArguments = false, hadTransfers = false;
    const vk::BarrierScope* scope = nullptr;
    const auto end = [&] {
        if (scope == nullptr) return;
        EXPECT_EQ(*scope, (vk::BarrierScope{hadTransfers, hasTransfers, hasArguments}));
    };
    for (const Pass& pass : list) {
        if (!isIn(recording, pass)) continue;
        if (pass.barriers[way]) {
            end();
            scope = &pass.scopes[way];
            hadTransfers = std::exchange(hasTransfers, false);
            hasArguments = false;
        }
        hasTransfers |= pass.kind != PassKind::dispatch;
        hasArguments |= pass.isIndirect;
    }
    end();
}

std::vector<Pass> randomPasses(std::mt19937& random, std::uint32_t buffers) {
    std::vector<Pass> passes(random() % 24);
    for (Pass& pass : passes) {
        pass.barriers[0] = random() % 2 == 0; // as if left from an earlier plan
        pass.kind = random() % 4 == 0 ? PassKind::copy : PassKind::dispatch;
        pass.uses.resize(random() % 5);
        for (BufferUse& use : pass.uses) {
            use = {{static_cast<std::uint32_t>(random() % buffers)},
                   static_cast<vk::Access>(1 + random() % 3)};
        }
        pass.isIndirect = pass.kind == PassKind::dispatch && !pass.uses.empty() && random() % 3 == 0;
        if (pass.isIndirect) pass.uses.back().access = vk::Access::read;
    }
    return passes;
}

} // namespace

TEST(Barriers, AreSafeNeededAndFewestOnTwentyThousandRandomLists) {
    std::mt19937 random(2024);
    std::size_t barriers = 0;
    for (int list = 0; list < 20000; ++list) {
        const auto buffers = static_cast<std::uint32_t>(1 + random() % 12);
        std::vector<Pass> passes = randomPasses(random, buffers);
        planBarriers(passes, buffers);
        ASSERT_NO_FATAL_FAILURE(expectSafeAndNeeded(passes)) << "list " << list;
        ASSERT_NO_FATAL_FAILURE(expectOrdered(passes)) << "list " << list;
        expectNarrow(passes);
        const auto planned = barriersOf(passes);
        const auto count = static_cast<std::size_t>(std::count(planned.begin(), planned.end(), true));
        ASSERT_EQ(count, fewestBarriers(footprintsOf(passes))) << "list " << list;
        barriers += count;
    }
    EXPECT_GT(barriers, 20000u) << "the lists are too tame to show anything";
}

TEST(Barriers, AreSafeAndNeededInTheProgramsOfAllScenes) {
    for (const test::NamedScene& named : test::allScenes()) {
        for (const Solver solver : {Solver::jacobi, Solver::split}) {
            for (const std::uint32_t substeps : {1u, 2u, 5u}) {
                const Settings settings{.solver = solver, .substeps = substeps, .iterations = 3};
                const StepProgram program = compile(named.scene, settings);
                SCOPED_TRACE(named.name + " " + solverName(solver) + " x" + std::to_string(substeps));
                ASSERT_LE(program.buffers.size(), mostBuffers);
                for (const Recording recording : allRecordings) {
                    ASSERT_NO_FATAL_FAILURE(expectSafeAndNeeded(program[List::step], recording));
                    ASSERT_NO_FATAL_FAILURE(expectOrdered(program[List::step], recording));
                    expectNarrow(program[List::step], recording);
                }
                for (const List list : {List::skin, List::rewrite})
                    ASSERT_NO_FATAL_FAILURE(expectSafeAndNeeded(program[list]));
            }
        }
    }
}

// A cuttable mesh: a step with a blade, and all lists of its skin.
TEST(Barriers, AreSafeAndNeededWhereAMeshIsCut) {
    Scene scene;
    mesh::MeshBody body{.name = "sphere", .youngModulus = 1e5f, .isCuttable = true};
    body.voxels.resolution = 6;
    mesh::addMesh(scene, mesh::generate("sphere", 12), body);
    for (const bool usesTexels : {true, false}) {
        const StepProgram program = compile(scene, {.substeps = 2, .forms = {.usesTexels = usesTexels}});
        ASSERT_LE(program.buffers.size(), mostBuffers);
        for (const List list : {List::step, List::skin, List::wholeSkin, List::rewrite})
            ASSERT_FALSE(program[list].empty());
        for (const std::vector<Pass>& list : program.lists)
            ASSERT_NO_FATAL_FAILURE(expectSafeAndNeeded(list));
        for (const Recording recording : allRecordings)
            ASSERT_NO_FATAL_FAILURE(expectSafeAndNeeded(program[List::step], recording));
    }
}

TEST(Barriers, AreSafeAndNeededWhereParticlesTouch) {
    Scene scene = test::block(2, 0.1f, 1e5f);
    for (Particle& particle : scene.particles) particle.radius = 0.05f;
    scene.particles.push_back({.position = {0, 1, 0}, .radius = 0.1f});
    for (const float friction : {0.0f, 0.5f}) {
        scene.contacts.friction = friction;
        scene.planes = {{.restitution = friction}};
        const StepProgram program = compile(scene, {.substeps = 3});
        SCOPED_TRACE(friction);
        ASSERT_LE(program.buffers.size(), mostBuffers);
        for (const Recording recording : allRecordings)
            ASSERT_NO_FATAL_FAILURE(expectSafeAndNeeded(program[List::step], recording));
        EXPECT_LT(countPasses(program, calmStep).passes, countPasses(program, plainStep).passes);
    }
}

TEST(Barriers, OfSplitAreOneASubstepAndThreeAround) {
    const auto count = [](std::uint32_t substeps) {
        const StepProgram program = compile(test::block(3, 0.1f, 1e5f), {.substeps = substeps});
        const auto barriers = barriersOf(program[List::step]);
        return std::count(barriers.begin(), barriers.end(), true);
    };
    EXPECT_EQ(count(2), 4); // one before each substep, one before measuring, one before publishing
    EXPECT_EQ(count(32) - count(2), 30);
}
