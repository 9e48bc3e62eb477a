// Tests of the positions and skins of the step before, which hosts make motion vectors from.
#include "sim/runner.hpp"
#include "sim/world_play.hpp"

#include <limits>

using namespace sinew;
using namespace sinew::sim;
using test::fallingBox, test::Words, test::wordsOf;

namespace {

constexpr Settings keeping{.substeps = 4, .keepsPrevious = true};

Words positionsOf(const Simulation& simulation) {
    return wordsOf(simulation.positions());
}

} // namespace

TEST(Previous, PositionsAreThoseAtTheStartOfTheStep) {
    for (const Solver solver : {Solver::split, Solver::jacobi, Solver::gaussSeidel}) {
        Scene scene;
        addLattice(scene, {.origin = {0, 0.3f, 0}, .cells = {2, 2, 2}, .spacing = 0.1f});
        Settings settings = keeping;
        settings.solver = solver;
        test::Runner runner(scene, settings);
        const Simulation& simulation = runner.simulation();
        for (int s = 0; s < 5; ++s) {
            const Words before = positionsOf(simulation);
            runner.run(1);
            EXPECT_EQ(wordsOf(simulation.previousPositions()), before) << "step " << s;
            EXPECT_NE(positionsOf(simulation), before) << "step " << s;
        }
        runner.writePosition(3, std::numeric_limits<float>::quiet_NaN());
        const Words before = positionsOf(simulation);
        EXPECT_TRUE(runner.run(1).isUndone);
        EXPECT_EQ(wordsOf(simulation.previousPositions()), before);
        EXPECT_EQ(positionsOf(simulation), before) << "an undone step";
    }
}

TEST(Previous, PositionsBelongToASavedState) {
    test::Runner runner(fallingBox(), keeping);
    runner.run(5);
    const Words previous = wordsOf(runner.simulation().previousPositions());
    const test::Runner::Saved saved = runner.save();
    runner.run(3);
    runner.load(saved);
    EXPECT_EQ(wordsOf(runner.simulation().previousPositions()), previous);
}

TEST(Previous, PositionsFollowTheirBodiesWhenOthersLeave) {
    test::Play play({}, keeping);
    Scene first = fallingBox(), second = fallingBox();
    for (Particle& particle : second.particles) particle.position.x += 2;
    const PartId leaves = play.add(first), stays = play.add(second);
    for (int s = 0; s < 3; ++s) play.step();
    const auto ofSecond = [&] {
        const PartRange range = play.world().find(stays).value();
        const Words all = wordsOf(play.world().simulation().previousPositions());
        const auto begin = all.begin() + 4 * static_cast<std::ptrdiff_t>(range.first.particles);
        return Words(begin, begin + 4 * static_cast<std::ptrdiff_t>(range.count.particles));
    };
    const Words before = ofSecond();
    play.remove(leaves);
    EXPECT_EQ(ofSecond(), before);
}

TEST(Previous, SkinsAreThoseRecordedBefore) {
    test::Runner runner(fallingBox(), keeping);
    const Simulation& simulation = runner.simulation();
    runner.skin();
    for (int s = 0; s < 4; ++s) {
        const Words before = wordsOf(simulation.skinVertices());
        runner.run(1);
        runner.skin();
        EXPECT_EQ(wordsOf(simulation.previousSkinVertices()), before) << "step " << s;
        EXPECT_NE(wordsOf(simulation.skinVertices()), before) << "step " << s;
    }
}

TEST(Previous, AreNotKeptUnlessAskedFor) {
    test::Runner runner(fallingBox(), {.substeps = 4});
    runner.run(1);
    EXPECT_EQ(runner.simulation().previousPositions().size, 0u);
    EXPECT_EQ(runner.simulation().previousSkinVertices().size, 0u);
    test::Runner kept(fallingBox(), keeping);
    kept.run(1);
    EXPECT_EQ(kept.stateHash(), runner.stateHash());
}
