// Compares candidate lists on the device with brute force, on many kinds of point clouds. Both partners list
// each pair once, sorted, for any order of invocations. Also tests lists whose capacity is too small.
#include "common/layout.h"
#include "common/share_band.h"
#include "sim/collision/contact_lists.hpp"
#include "sim/device/gpu_executor.hpp"
#include "sim/model/components.hpp"
#include "sim/scenes.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

using namespace sinew;
using namespace sinew::sim;
namespace lists = sinew::sim::collision::contact_lists;

namespace {

using Neighbours = std::vector<std::vector<std::uint32_t>>;

// Bounds of neighbour lists: pairs that must be listed, and pairs that may be, because their distance equals
// the reach within float rounding.
struct Expected {
    Neighbours sure, possible;
};

struct Cloud {
    std::vector<float> radii; // padded to work groups; below 0 = no particle
    float margin = 0;
    std::uint32_t capacity = 256;
    bool isReversed = false, usesTexels = true;
    lists::Exclusions exclusions;
    float h = 1; // length of the last substep [s]
};

// A program that only updates the lists of a cloud.
class Device {
public:
    explicit Device(const Cloud& cloud)
        : count_(cloud.radii.size()), builder_(cloud.isReversed, cloud.usesTexels) {
        builder_.program().status = builder_.scratch<layout::StatusWords>("status", 1);
        positions_ = builder_.scratch<layout::vec4>("positions", count_);
        lists_ = lists::add(builder_, {.radii = cloud.radii,
                                       .margin = cloud.margin,
                                       .capacity = cloud.capacity,
                                       .exclusions = cloud.exclusions});
        velocities_ = builder_.scratch<layout::vec4>("velocities", count_);
        const layout::StepParams step{.h = cloud.h};
        const BufferId parameters = builder_.upload("step", std::span(&step, 1));
        builder_.beginPhase("solve");
        builder_.fill(builder_.program().status, 0);
        lists::addUpdate(builder_, lists_, {positions_, velocities_, parameters});
        program_ = builder_.finish();
        executor_.emplace(test::device(), program_);
        submit([&](vk::Commands& commands) { executor_->upload(commands); });
    }

    void update(const std::vector<layout::vec4>& positions, const std::vector<layout::vec4>& velocities) {
        test::queue().upload(executor_->view(velocities_), velocities.data(),
                             velocities.size() * sizeof(layout::vec4));
        update(positions);
    }

    void update(const std::vector<layout::vec4>& positions) {
        test::queue().upload(executor_->view(positions_), positions.data(),
                             positions.size() * sizeof(layout::vec4));
        submit([&](vk::Commands& commands) { executor_->step(commands, {}, {}, nullptr); });
    }

    Neighbours neighbours() const {
        const auto lists = test::queue().download<layout::ListRange>(executor_->view(lists_.pooled.ranges));
        const auto entries =
            test::queue().download<layout::ContactCandidate>(executor_->view(lists_.pooled.contacts));
        Neighbours result(count_);
        for (std::uint32_t i = 0; i < count_; ++i)
            for (std::uint32_t s = 0; s < lists[i].count; ++s)
                result[i].push_back(entries[lists[i].first + s].other);
        return result;
    }
    float edge() const {
        return test::queue().download<layout::GridBounds>(executor_->view(lists_.grid.bounds))[0].edge;
    }
    std::uint32_t builds() const {
        return test::queue().download<layout::GridBounds>(executor_->view(lists_.grid.bounds))[0].builds;
    }
    std::uint32_t candidatesNeeded() const { return status().candidates; }
    layout::StatusWords status() const {
        return test::queue().download<layout::StatusWords>(executor_->view(program_.status))[0];
    }

private:
    static void submit(const std::function<void(vk::Commands&)>& record) {
        const VkCommandBuffer buffer = test::queue().begin();
        vk::Commands commands(test::device(), buffer);
        record(commands);
        test::queue().wait(test::queue().submit(buffer));
    }

    std::size_t count_;
    ProgramBuilder builder_;
    BufferId positions_, velocities_;
    lists::Lists lists_;
    StepProgram program_;
    std::optional<GpuExecutor> executor_;
};

// Pairs that touch or count in shares, and those up to `margin` beyond [m].
Expected bruteForce(const Cloud& cloud, const std::vector<layout::vec4>& x, float margin) {
    Expected expected{Neighbours(x.size()), Neighbours(x.size())};
    for (std::uint32_t i = 0; i < x.size(); ++i) {
        if (cloud.radii[i] < 0) continue;
        for (std::uint32_t j = 0; j < x.size(); ++j) {
            if (i == j || cloud.radii[j] < 0) continue;
            const double touching = double{cloud.radii[i]} + double{cloud.radii[j]};
            const double reach = (1 + double{SHARE_BAND}) * touching + double{margin};
            const double dx = double{x[i].x} - double{x[j].x}, dy = double{x[i].y} - double{x[j].y},
                         dz = double{x[i].z} - double{x[j].z}, d = std::sqrt(dx * dx + dy * dy + dz * dz);
            if (d < reach * (1 + 1e-6)) expected.possible[i].push_back(j);
            if (d < reach * (1 - 1e-6)) expected.sure[i].push_back(j);
        }
    }
    return expected;
}

// Expects sorted lists without duplicates that contain all sure pairs and only possible ones.
void expectBetween(const Expected& expected, const Neighbours& found) {
    for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_TRUE(std::is_sorted(found[i].begin(), found[i].end(), std::less_equal<>()))
            << "particle " << i << ": not sorted, or somebody twice";
        ASSERT_TRUE(std::ranges::includes(found[i], expected.sure[i]))
            << "particle " << i << " misses a pair";
        ASSERT_TRUE(std::ranges::includes(expected.possible[i], found[i]))
            << "particle " << i << " has too many";
    }
}

void expectMutual(const Neighbours& found) {
    for (std::uint32_t i = 0; i < found.size(); ++i)
        for (const std::uint32_t j : found[i])
            ASSERT_TRUE(std::ranges::binary_search(found[j], i)) << j << " does not know " << i;
}

// Places the particles of one kind of configuration.
using Placing = std::function<layout::vec4(std::mt19937&, std::uint32_t)>;

float uniform(std::mt19937& random, float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
}

layout::vec4 within(std::mt19937& random, const layout::vec4& center, float half) {
    return {center.x + uniform(random, -half, half), center.y + uniform(random, -half, half),
            center.z + uniform(random, -half, half), 0};
}

struct NamedPlacing {
    const char* name;
    Placing place;
};

// Radii are about 0.05 m, grid cells about 0.13 m.
std::vector<NamedPlacing> placings() {
    return {{"random", [](std::mt19937& r, std::uint32_t) { return within(r, {}, 0.4f); }},
            {"sparse", [](std::mt19937& r, std::uint32_t) { return within(r, {}, 30); }},
            {"clustered",
             [](std::mt19937& r, std::uint32_t i) {
                 const float at = static_cast<float>(i % 7);
                 return within(r, {3 * at, -at * at, 2 - at, 0}, 0.1f);
             }},
            {"coincident",
             [](std::mt19937&, std::uint32_t i) {
                 return layout::vec4{static_cast<float>(i % 5) * 0.07f, i % 2 == 0 ? 0.0f : -0.0f, 0, 0};
             }},
            {"negative",
             [](std::mt19937& r, std::uint32_t) {
                 return within(r, {-7, -9, -11, 0}, 0.5f);
             }},
            {"far away",
             [](std::mt19937& r, std::uint32_t) {
                 return within(r, {1e4f, -3e4f, 2e4f, 0}, 0.5f);
             }},
            {"very far away",
             [](std::mt19937& r, std::uint32_t) {
                 return within(r, {1e6f, 1e6f, -1e6f, 0}, 0.5f);
             }},
            {"with runaways",
             [](std::mt19937& r, std::uint32_t i) {
                 return within(r, {}, i % 50 == 0 ? 3e4f : i % 50 == 1 ? 1e9f : 0.5f);
             }},
            {"in a line",
             [](std::mt19937& r, std::uint32_t) {
                 return layout::vec4{uniform(r, -20, 20), 0, 0, 0};
             }},
            {"on cell borders", [](std::mt19937& r, std::uint32_t) {
                 const auto whole = [&r] {
                     return 0.05f * static_cast<float>(static_cast<int>(r() % 9) - 4);
                 };
                 return layout::vec4{whole(), whole() * 0, whole(), 0};
             }}};
}

std::vector<float> radiiFor(std::mt19937& random, int kind, std::size_t count) {
    std::vector<float> radii(count, 0.05f);
    for (std::size_t i = 0; i < count; ++i) {
        if (kind == 1) radii[i] = uniform(random, 0.02f, 0.06f);
        if (kind == 2 && random() % 40 == 0) radii[i] = uniform(random, 0.3f, 0.6f); // not in the grid
        if (kind == 2 && random() % 20 == 0) radii[i] = 0;
        if (kind == 3 && random() % 3 == 0) radii[i] = -1; // no particle
    }
    return radii;
}

std::vector<layout::vec4> placed(std::mt19937& random, const Placing& place, std::size_t count) {
    std::vector<layout::vec4> positions;
    for (std::uint32_t i = 0; i < count; ++i) positions.push_back(place(random, i));
    return positions;
}

} // namespace

// Also hard case 26: particles far outside of the others, at -0.0, and on cell borders.
TEST(ContactLists, EqualBruteForceOnTwelveHundredConfigurations) {
    std::mt19937 random(11);
    std::size_t pairs = 0, configurations = 0;
    for (int kind = 0; kind < 4; ++kind) {
        Cloud cloud{.radii = radiiFor(random, kind, 256), .margin = 0.025f};
        Cloud reversed = cloud, loads = cloud;
        reversed.isReversed = true;
        loads.usesTexels = false;
        Device device(cloud), backwards(reversed), loading(loads);
        for (const NamedPlacing& placing : placings())
            for (int seed = 0; seed < 30; ++seed, ++configurations) {
                SCOPED_TRACE(testing::Message() << placing.name << ", radii " << kind << ", seed " << seed);
                const auto x = placed(random, placing.place, cloud.radii.size());
                device.update(x);
                const Neighbours found = device.neighbours();
                ASSERT_NO_FATAL_FAILURE(expectBetween(bruteForce(cloud, x, cloud.margin), found));
                ASSERT_NO_FATAL_FAILURE(expectMutual(found));
                backwards.update(x);
                ASSERT_EQ(backwards.neighbours(), found) << "in reversed order";
                for (const auto& list : found) pairs += list.size();
                if (seed > 2) continue;
                loading.update(x);
                ASSERT_EQ(loading.neighbours(), found) << "without texels";
            }
    }
    EXPECT_GE(configurations, 1000u);
    EXPECT_GT(pairs, 1'000'000u) << "clouds too thin to show anything";
}

// While all particles wander, every contact is listed, and lists are rebuilt only after long displacements.
TEST(ContactLists, HoldWhatTouchesWhileParticlesWanderAndAreRarelyMadeAgain) {
    std::mt19937 random(5);
    const Cloud cloud{.radii = radiiFor(random, 1, 256), .margin = 0.04f};
    Device device(cloud);
    auto x = placed(random, placings()[0].place, cloud.radii.size());
    constexpr std::uint32_t updates = 60;
    for (std::uint32_t u = 0; u < updates; ++u) {
        for (layout::vec4& at : x) at = within(random, at, 0.002f);
        device.update(x);
        const Neighbours found = device.neighbours(), counted = bruteForce(cloud, x, 0).sure;
        for (std::size_t i = 0; i < found.size(); ++i)
            ASSERT_TRUE(std::ranges::includes(found[i], counted[i])) << "update " << u << ", particle " << i;
    }
    EXPECT_GE(device.builds(), 3u);
    EXPECT_LE(device.builds(), updates / 4);
}

TEST(ContactLists, AreMadeAgainOnlyWhenSomebodyMovesFartherThanHalfTheMargin) {
    const Cloud cloud{.radii = std::vector<float>(128, 0.05f), .margin = 0.1f};
    Device device(cloud);
    std::vector<layout::vec4> x(128);
    for (std::uint32_t i = 0; i < 128; ++i) x[i].x = 0.08f * static_cast<float>(i);
    const auto buildsAfterMoving = [&](float way) {
        x[77].y += way;
        device.update(x);
        return device.builds();
    };
    EXPECT_EQ(buildsAfterMoving(0), 1u) << "the first lists";
    EXPECT_EQ(buildsAfterMoving(0), 1u);
    EXPECT_EQ(buildsAfterMoving(0.048f), 1u);
    EXPECT_EQ(buildsAfterMoving(0.004f), 2u) << "0.052 m in all";
    EXPECT_EQ(buildsAfterMoving(-0.048f), 2u) << "counted from there";
    EXPECT_EQ(buildsAfterMoving(std::numeric_limits<float>::quiet_NaN()), 3u) << "who knows where";
}

TEST(ContactLists, ThatLackRoomSayHowMuchTheyNeedOnAverage) {
    Cloud cloud{.radii = std::vector<float>(256, 0.05f), .margin = 0.01f};
    std::vector<layout::vec4> x(256);
    // 64 particles at one place have 64 x 63 entries, 15.75 a particle.
    for (std::uint32_t i = 0; i < 256; ++i) x[i].x = static_cast<float>(i < 64 ? 0 : i);
    // The count stops at four times the capacity.
    for (const auto& [capacity, needed] : {std::pair{1u, 5u}, {4u, 16u}, {15u, 16u}, {16u, 0u}, {17u, 0u}}) {
        cloud.capacity = capacity;
        Device device(cloud);
        device.update(x);
        EXPECT_EQ(device.candidatesNeeded(), needed) << "capacity " << capacity;
        std::size_t entries = 0;
        for (const auto& list : device.neighbours()) entries += list.size();
        EXPECT_LE(entries, std::size_t{capacity} * 256);
        if (needed == 0) {
            EXPECT_EQ(device.neighbours()[0].size(), 63u) << "far more than there is room for on average";
        }
    }
}

// A large particle among many small ones. Long lists are sorted by another algorithm than short ones.
TEST(ContactLists, OfOneMayHaveUpToTwoThousand) {
    for (const std::uint32_t small : {1500u, 2048u, 2049u}) {
        Cloud cloud{.radii = std::vector<float>(2176, 0.001f), .margin = 0.0005f, .capacity = 8};
        cloud.radii[700] = 1;
        std::vector<layout::vec4> x(2176);
        for (std::uint32_t i = 0; i < 2176; ++i) {
            const float turn = 2.399963f * static_cast<float>(i), // the golden angle
                height = 1 - 2 * (static_cast<float>(i) + 0.5f) / 2176, ring = std::sqrt(1 - height * height);
            const float far = i <= small && i != 700 ? 1.0f : 2.0f;
            x[i] = {far * ring * std::cos(turn), far * ring * std::sin(turn), far * height, 0};
        }
        x[700] = {};
        Device device(cloud);
        device.update(x);
        EXPECT_EQ(device.candidatesNeeded(), small > LIST_MOST ? CONTACT_MOST_ROOM + 1u : 0u) << small;
        if (small > LIST_MOST) continue;
        const Neighbours found = device.neighbours();
        ASSERT_EQ(found[700].size(), small);
        EXPECT_TRUE(std::ranges::is_sorted(found[700]));
        EXPECT_EQ(std::ranges::adjacent_find(found[700]), found[700].end());
    }
}

// Hard case 25: counting stops early, no buffer overflows, and each run reports the same.
TEST(ContactLists, OfTenThousandParticlesInOnePlaceStopCounting) {
    Cloud cloud{.radii = std::vector<float>(10112, 0.05f), .margin = 0.01f, .capacity = 16};
    for (const bool isReversed : {false, true}) {
        cloud.isReversed = isReversed;
        Device device(cloud);
        device.update(std::vector<layout::vec4>(10112));
        EXPECT_EQ(device.candidatesNeeded(), 4 * cloud.capacity + 1);
    }
}

TEST(ContactLists, LeaveOutPairsThatNeverTouch) {
    std::mt19937 random(3);
    Cloud cloud{.radii = std::vector<float>(256, 0.05f), .margin = 0.025f};
    const auto x = placed(random, placings()[0].place, cloud.radii.size());
    const Neighbours all = bruteForce(cloud, x, cloud.margin).sure;
    Neighbours allowed = all;
    cloud.exclusions.resize(257);
    const auto isOut = [](std::uint32_t i, std::uint32_t j) { return (i * j + i + j) % 3 == 0; };
    for (std::uint32_t i = 0; i < 256; ++i) {
        cloud.exclusions[i] = static_cast<std::uint32_t>(cloud.exclusions.size());
        for (std::uint32_t j = i + 1; j < 256; ++j)
            if (isOut(i, j)) cloud.exclusions.push_back(j);
        std::erase_if(allowed[i], [&](std::uint32_t j) { return isOut(i, j); });
    }
    cloud.exclusions[256] = static_cast<std::uint32_t>(cloud.exclusions.size());
    for (const bool usesTexels : {true, false}) {
        cloud.usesTexels = usesTexels;
        Device device(cloud);
        device.update(x);
        EXPECT_EQ(device.neighbours(), allowed);
    }
}

namespace {

// In the row of the first of the two.
bool isExcluded(const lists::Exclusions& exclusions, std::uint32_t i, std::uint32_t j) {
    if (i > j) std::swap(i, j);
    return std::binary_search(exclusions.begin() + exclusions[i], exclusions.begin() + exclusions[i + 1], j);
}

} // namespace

TEST(ExcludedPairs, AreLinksAndWhatIsNearAtRestWithinABody) {
    Scene scene = test::block(3, 0.1f, 1e5f); // 4^3 particles, links up to face diagonals
    const auto single = static_cast<std::uint32_t>(scene.particles.size());
    scene.particles.push_back({.position = {0.02f, 0, 0}}); // inside the body, but not part of it
    const std::vector<float> radii(scene.particles.size(), 0.09f);
    const StateLayout layout = orderedLayout(scene.particles.size());
    const lists::Exclusions excluded = lists::excludedPairs(scene, linkedBodies(scene), radii, layout);
    ASSERT_GE(excluded.size(), layout.count + 1);
    const auto at = [&](std::uint32_t i) { return test::toVector(scene.particles[i].position); };
    std::size_t pairs = 0;
    for (std::uint32_t i = 0; i < single; ++i) {
        EXPECT_FALSE(isExcluded(excluded, i, single) || isExcluded(excluded, single, i)) << i;
        for (std::uint32_t j = 0; j < single; ++j) {
            const bool isNear = i != j && (at(i) - at(j)).norm() < 1.05 * 0.18;
            EXPECT_EQ(isExcluded(excluded, i, j), isNear) << i << ", " << j;
            pairs += isNear && i < j ? 1 : 0;
        }
    }
    EXPECT_EQ(excluded.size(), layout.count + 1 + pairs) << "each pair once";
}

TEST(ExcludedPairs, OfParticlesThatTouchNothingAndOfLooseOnesAreNone) {
    Scene scene = test::chain(5);
    const StateLayout layout = orderedLayout(5);
    EXPECT_TRUE(
        lists::excludedPairs(scene, linkedBodies(scene), std::vector<float>(5, -1.0f), layout).empty());
    const auto excluded = lists::excludedPairs(scene, linkedBodies(scene),
                                               std::vector<float>{0.01f, 0.01f, -1, 0.01f, 0.01f}, layout);
    EXPECT_TRUE(isExcluded(excluded, 0, 1) && isExcluded(excluded, 4, 3));
    EXPECT_FALSE(isExcluded(excluded, 1, 2) || isExcluded(excluded, 2, 3) || isExcluded(excluded, 0, 3));
    scene.distances.clear();
    EXPECT_TRUE(
        lists::excludedPairs(scene, linkedBodies(scene), std::vector<float>(5, 1.0f), layout).empty());
}

TEST(HashGrid, KeepsItsCellsSmallWhereAFewParticlesAreLarge) {
    using collision::hash_grid::largestInGrid, collision::hash_grid::mostLarge;
    std::vector<float> radii(1000, 0.05f);
    EXPECT_EQ(largestInGrid(radii), 0.1f);
    for (std::size_t i = 0; i < mostLarge; ++i) radii[3 * i] = 1;
    EXPECT_EQ(largestInGrid(radii), 0.1f);
    radii[1] = 1;
    EXPECT_EQ(largestInGrid(radii), 1.0f) << "too many to search one by one";
    EXPECT_EQ(largestInGrid(std::vector<float>(128, -1.0f)), 0.0f);
}

// Cells need room for ways only in a substep in which many particles move far enough to touch others on their
// way. A few are searched one by one.
TEST(HashGrid, HasCellsAsWideAsTwoThatTouchWhileFewAreFast) {
    Cloud cloud{.radii = std::vector<float>(128, 0.05f), .margin = 0.025f};
    std::mt19937 random(23);
    const float narrow = 0.1f * (1 + SHARE_BAND) + 0.025f, wide = 0.2f * (1 + SHARE_BAND) + 0.025f;
    Device device(cloud);
    const auto edgeWithFast = [&](std::size_t fast) {
        std::vector<layout::vec4> v(cloud.radii.size());
        for (std::size_t i = 0; i < fast; ++i) v[3 * i].x = 0.2f;
        device.update(placed(random, placings()[0].place, cloud.radii.size()), v);
        return device.edge();
    };
    EXPECT_FLOAT_EQ(edgeWithFast(0), narrow);
    EXPECT_FLOAT_EQ(edgeWithFast(1), narrow);
    EXPECT_FLOAT_EQ(edgeWithFast(MOST_SWEEPERS), narrow);
    EXPECT_FLOAT_EQ(edgeWithFast(MOST_SWEEPERS + 1), wide);
    EXPECT_FLOAT_EQ(edgeWithFast(0), narrow);
}

namespace {

// Smallest distance of two particles on straight paths [m].
double nearest(const layout::vec4& xi, const layout::vec4& xj, const layout::vec4& vi,
               const layout::vec4& vj) {
    const auto vector = [](const layout::vec4& a) {
        return Eigen::Vector3d(double{a.x}, double{a.y}, double{a.z});
    };
    const Eigen::Vector3d d = vector(xi) - vector(xj), way = vector(vi) - vector(vj);
    const double t = std::clamp(d.dot(way) / std::max(way.squaredNorm(), 1e-30), 0.0, 1.0);
    return (d - t * way).norm();
}

// Velocities of which about a tenth cross the cloud in a substep, for all radii; with `areFew` few are fast.
std::vector<layout::vec4> velocitiesOf(std::mt19937& random, std::size_t count, float most, bool areFew) {
    std::vector<layout::vec4> v(count);
    for (layout::vec4& one : v)
        one = within(random, {}, random() % 10 == 0 ? most : random() % 2 == 0 ? 0.05f : 0.004f);
    if (areFew)
        for (std::size_t i = 0; i < count; ++i)
            if (i % (count / MOST_SWEEPERS) != 0) v[i] = within(random, {}, 0.001f);
    return v;
}

} // namespace

// Substeps last 1 s. Both particles list each other if they touched on the way, whatever grid cells they end
// in.
TEST(ContactLists, HoldWhatMetOnTheWayOfASubstep) {
    std::mt19937 random(17);
    std::size_t met = 0;
    for (int kind = 0; kind < 3; ++kind) {
        Cloud cloud{.radii = radiiFor(random, kind, 256), .margin = 0.025f};
        for (float& radius : cloud.radii) radius = radius == 0 ? 0.01f : radius;
        Cloud reversed = cloud, loads = cloud;
        reversed.isReversed = true;
        loads.usesTexels = false;
        Device device(cloud), backwards(reversed), loading(loads);
        for (int seed = 0; seed < 80; ++seed) {
            SCOPED_TRACE(testing::Message() << "radii " << kind << ", seed " << seed);
            const auto x = placed(random, placings()[seed % 2 == 0 ? 0 : 2].place, cloud.radii.size());
            const auto v = velocitiesOf(random, x.size(), seed % 3 == 0 ? 0.2f : 3.0f, seed >= 40);
            device.update(x, v);
            const Neighbours found = device.neighbours();
            EXPECT_EQ(device.status().slowed, 0u);
            for (std::uint32_t i = 0; i < x.size(); ++i)
                for (std::uint32_t j = 0; j < x.size(); ++j) {
                    const double touching = double{cloud.radii[i]} + double{cloud.radii[j]};
                    if (i == j || nearest(x[i], x[j], v[i], v[j]) >= touching * (1 - 1e-5)) continue;
                    ++met;
                    ASSERT_TRUE(std::ranges::binary_search(found[i], j)) << i << " and " << j << " met";
                }
            ASSERT_NO_FATAL_FAILURE(expectMutual(found));
            backwards.update(x, v);
            ASSERT_EQ(backwards.neighbours(), found) << "in reversed order";
            loading.update(x, v);
            ASSERT_EQ(loading.neighbours(), found) << "without texels";
        }
    }
    EXPECT_GT(met, 20'000u);
}
