// Tests of outputs that are kept in buffers of their own, so that step N is read while step N + 1 runs.
#include "sim/runner.hpp"
#include "sim/world_play.hpp"

#include <cstring>
#include <limits>

using namespace sinew;
using namespace sinew::sim;
using test::fallingBox, test::Words, test::wordsOf;

namespace {

constexpr Settings keeping{.substeps = 4, .outputFrames = 2};

// Contents of each view that passes write, as a renderer reads them.
std::vector<Words> contentsOf(const Outputs& outputs) {
    std::vector<Words> contents;
    for (const vk::BufferView& view :
         {outputs.positions, outputs.velocities, outputs.skinVertices, outputs.skinIndices,
          outputs.cutSurface.vertices, outputs.cutSurface.rest, outputs.cutSurface.indices,
          outputs.cutSurface.draws, outputs.cutSurface.counts})
        contents.push_back(wordsOf(view));
    return contents;
}

Outputs newestOf(const Simulation& simulation) {
    return {.isKept = true,
            .positions = simulation.positions(),
            .velocities = simulation.velocities(),
            .skinVertices = simulation.skinVertices(),
            .skinIndices = simulation.skinIndices(),
            .cutSurface = simulation.cutSurface()};
}

// Records a step in two parts and, between them, a read of `view`: as a draw on another queue would read,
// with nothing that orders it and the second part. Returns what was read.
Words readWithin(Simulation& simulation, std::uint64_t frame, const vk::BufferView& view) {
    vk::Queue& queue = test::queue();
    const vk::Buffer copy(
        test::device(),
        {.name = "picture", .count = view.size / 4, .stride = 4, .kind = vk::MemoryKind::readback});
    const std::array parts{queue.begin(), queue.begin()};
    const VkCommandBuffer picture = queue.begin();
    simulation.record(parts, {.dt = 1.0f / 60, .frame = frame});
    vk::Commands(test::device(), picture).copy(view, copy.view());
    queue.submit(parts[0]);
    const auto read = queue.submit(picture);
    queue.wait(queue.submit(parts[1]));
    queue.wait(read);
    Words words(view.size / 4);
    std::memcpy(words.data(), copy.mapped(), view.size);
    return words;
}

} // namespace

TEST(OutputFrames, OfAStepAreReadWhileTheNextOneRuns) {
    test::Runner runner(fallingBox(), keeping);
    Simulation& simulation = runner.simulation();
    runner.run(3);
    const Words newest = wordsOf(simulation.positions());
    EXPECT_EQ(readWithin(simulation, 3, simulation.outputs(2).positions), newest);
    EXPECT_EQ(test::takeMessages(), std::vector<std::string>{});
    EXPECT_NE(wordsOf(simulation.positions()), newest);
    EXPECT_EQ(wordsOf(simulation.outputs(2).positions), newest);
    EXPECT_EQ(wordsOf(simulation.outputs(3).positions), wordsOf(simulation.positions()));
    readWithin(simulation, 4, simulation.positions()); // the same of what the step itself writes
    EXPECT_NE(test::takeMessages(), std::vector<std::string>{});
}

TEST(OutputFrames, AreThoseOfTheirStepAlsoWhereItCut) {
    test::Runner runner(fallingBox(), keeping);
    Simulation& simulation = runner.simulation();
    const std::array from{Vec3{0.11f, -1, -1}, Vec3{0.11f, -1, 1}}, to{Vec3{0.11f, 1, -1}, Vec3{0.11f, 1, 1}};
    std::vector<Words> before;
    for (std::uint64_t frame = 0; frame < 6; ++frame) {
        if (frame == 3)
            runner.cut({.from = from, .to = to});
        else
            runner.run(1);
        EXPECT_EQ(simulation.outputs(frame).skinVertices.size, 0u) << "no skin was recorded since";
        runner.skin();
        const Outputs outputs = simulation.outputs(frame);
        ASSERT_TRUE(outputs.isKept);
        const std::vector<Words> newest = contentsOf(outputs);
        EXPECT_EQ(newest, contentsOf(newestOf(simulation))) << "step " << frame;
        if (frame > 0) {
            EXPECT_EQ(contentsOf(simulation.outputs(frame - 1)), before) << "step " << frame;
            EXPECT_NE(newest, before);
            EXPECT_NE(simulation.outputs(frame - 1).positions.buffer, outputs.positions.buffer);
        }
        if (frame > 1) {
            EXPECT_FALSE(simulation.outputs(frame - 2).isKept);
        }
        before = newest;
    }
    EXPECT_GT(before[6].size(), 0u) << "a surface of the cut";
}

TEST(OutputFrames, OfAnUndoneStepAreTheLastFiniteState) {
    test::Runner runner(fallingBox(), keeping);
    runner.run(2);
    const Words finite = wordsOf(runner.simulation().positions());
    runner.writePosition(3, std::numeric_limits<float>::quiet_NaN());
    EXPECT_TRUE(runner.run(1).isUndone);
    EXPECT_EQ(wordsOf(runner.simulation().outputs(2).positions), finite);
}

TEST(OutputFrames, AreNoneAfterAStateFromElsewhere) {
    test::Runner runner(fallingBox(), keeping);
    Simulation& simulation = runner.simulation();
    EXPECT_FALSE(simulation.outputs(0).isKept);
    runner.run(2);
    const test::Runner::Saved saved = runner.save();
    EXPECT_TRUE(simulation.outputs(1).isKept) << "saving changes nothing";
    runner.load(saved);
    runner.skin();
    EXPECT_FALSE(simulation.outputs(1).isKept);
    runner.run(1);
    EXPECT_TRUE(simulation.outputs(2).isKept);
    runner.reset();
    EXPECT_FALSE(simulation.outputs(2).isKept);
}

TEST(OutputFrames, AreNotKeptUnlessAskedFor) {
    test::Runner runner(fallingBox(), {.substeps = 4}), keeps(fallingBox(), keeping);
    for (test::Runner* one : {&runner, &keeps}) {
        one->run(2);
        one->skin();
    }
    const Outputs outputs = runner.simulation().outputs(1);
    EXPECT_FALSE(outputs.isKept);
    EXPECT_EQ(outputs.positions.size + outputs.skinVertices.size, 0u);
    EXPECT_EQ(keeps.stateHash(), runner.stateHash());
    EXPECT_EQ(describe(keeps.simulation().program()), describe(runner.simulation().program()));
    EXPECT_EQ(keeps.simulation().stateKey(), runner.simulation().stateKey());
    EXPECT_THROW(test::Runner(fallingBox(), {.outputFrames = 9}), std::invalid_argument);
}
