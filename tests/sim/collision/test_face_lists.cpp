// Compares lists of particles and faces on the device with brute force, on many kinds of clouds. Each pair is
// listed once, sorted, for any order of invocations. Also tests lists whose capacity is too small.
#include "common/layout.h"
#include "sim/collision/distances.hpp"
#include "sim/collision/face_contacts.hpp"
#include "sim/device/gpu_executor.hpp"
#include "sim/model/components.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <random>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::toTriangle;
namespace lists = sinew::sim::collision::face_lists;

namespace {

using Neighbours = std::vector<std::vector<std::uint32_t>>;

constexpr std::uint32_t count = 256, faceCount = 64, movingFaces = 40;
constexpr float substep = 1e-3f;

float inverseMassOf(std::uint32_t i) {
    return i >= 3 * movingFaces && (i < 3 * faceCount || i % 5 == 0) ? 0.0f : 1.0f;
}

// Faces between particles 3 f, 3 f + 1 and 3 f + 2; all other particles are loose.
struct Cloud {
    std::vector<float> radii = std::vector<float>(count, 0.02f); // below 0 = no particle
    std::vector<float> thickness = std::vector<float>(faceCount, 0.01f);
    std::vector<float> extents = std::vector<float>(faceCount, 0.1f);
    std::vector<std::uint32_t> exclusions;
    float margin = 0.02f;
    std::uint32_t capacity = 256;
    bool isReversed = false, usesTexels = true;

    std::vector<layout::ContactFace> faces() const {
        std::vector<layout::ContactFace> result;
        for (std::uint32_t f = 0; f < faceCount; ++f)
            result.push_back({3 * f, 3 * f + 1, 3 * f + 2, thickness[f]});
        return result;
    }
    std::vector<std::uint32_t> excluded() const {
        return exclusions.empty() ? std::vector<std::uint32_t>(faceCount + 1, faceCount + 1) : exclusions;
    }
};

// Positions, velocities and inverse masses of all particles.
struct State {
    std::vector<layout::vec4> x = std::vector<layout::vec4>(count), v = std::vector<layout::vec4>(count);
};

// How far lists look ahead: until when particles follow their headings [s], their largest heading as a way in
// a substep, and their largest leeway [m].
struct Ahead {
    double horizon = 0, pace = 1, leeway = 0;
};

// A program that only updates the lists of a cloud.
class Device {
public:
    explicit Device(const Cloud& cloud) : builder_(cloud.isReversed, cloud.usesTexels) {
        builder_.program().status = builder_.scratch<layout::StatusWords>("status", 1);
        const std::vector<layout::StepParams> step(1, layout::StepParams{.h = substep});
        particles_ = {.count = count,
                      .step = builder_.upload("step", step),
                      .positions = builder_.scratch<layout::vec4>("positions", count),
                      .velocities = builder_.scratch<layout::vec4>("velocities", count)};
        std::vector<float> masses;
        for (std::uint32_t i = 0; i < count; ++i) masses.push_back(inverseMassOf(i));
        lists_ = lists::add(builder_, {.radii = cloud.radii,
                                       .inverseMasses = masses,
                                       .faces = cloud.faces(),
                                       .moving = movingFaces,
                                       .extents = cloud.extents,
                                       .exclusions = cloud.excluded(),
                                       .margin = cloud.margin,
                                       .capacity = cloud.capacity});
        builder_.beginPhase("solve");
        builder_.fill(builder_.program().status, 0);
        lists::addListCheck(builder_, lists_, particles_);
        lists::addLists(builder_, lists_, particles_);
        program_ = builder_.finish();
        executor_.emplace(test::device(), program_);
        submit([&](vk::Commands& commands) { executor_->upload(commands); });
    }

    /// `h`: length of the substep [s].
    void update(const State& state, float h = substep) {
        constexpr std::size_t bytes = count * sizeof(layout::vec4);
        const layout::StepParams step{.h = h};
        test::queue().upload(executor_->view(particles_.step), &step, sizeof step);
        test::queue().upload(executor_->view(particles_.positions), state.x.data(), bytes);
        test::queue().upload(executor_->view(particles_.velocities), state.v.data(), bytes);
        submit([&](vk::Commands& commands) { executor_->step(commands, {}, {}, nullptr); });
    }

    /// From now on the frame of all particles turns about the origin, clockwise seen along -z [1/s].
    void turn(float rate) {
        auto frames = read<layout::BodyFrame>(lists_.grid.frames.frames);
        frames[0].rates[0].y = rate;
        frames[0].rates[1].x = -rate;
        test::queue().upload(executor_->view(lists_.grid.frames.frames), frames.data(),
                             frames.size() * sizeof frames[0]);
    }
    /// How far particles may be from their expected positions [m].
    double slack() const { return double{read<layout::BodyFrame>(lists_.grid.frames.frames)[0].speed.w}; }

    Neighbours facesOfPoints() const {
        const auto lists = read<layout::ListRange>(lists_.pooled.ranges);
        const auto entries = read<layout::ContactCandidate>(lists_.pooled.contacts);
        Neighbours result(count);
        for (std::uint32_t i = 0; i < count; ++i)
            for (std::uint32_t s = 0; s < lists[i].count; ++s)
                result[i].push_back(entries[lists[i].first + s].other);
        return result;
    }
    // The points listed at each moving face; fails if a point's list lacks the face.
    Neighbours pointsOfFaces() const {
        const auto lists = read<layout::ListRange>(lists_.pooled.ranges),
                   ofFaces = read<layout::ListRange>(lists_.pooled.links->ranges);
        const auto links = read<std::uint32_t>(lists_.pooled.links->elements);
        const auto entries = read<layout::ContactCandidate>(lists_.pooled.contacts);
        std::vector<std::uint32_t> owners(entries.size(), ~0u);
        for (std::uint32_t i = 0; i < count; ++i)
            std::fill_n(owners.begin() + lists[i].first, lists[i].count, i);
        Neighbours result(movingFaces);
        for (std::uint32_t f = 0; f < movingFaces; ++f)
            for (std::uint32_t s = 0; s < ofFaces[f].count; ++s) {
                const std::uint32_t element = links[ofFaces[f].first + s];
                EXPECT_EQ(entries[element].other, f);
                result[f].push_back(owners[element]);
            }
        return result;
    }
    Ahead ahead() const {
        const layout::GridPush& push = lists_.grid.push;
        return {double{read<layout::GridBounds>(lists_.grid.bounds)[0].horizon}, double{push.pace},
                double{push.leeway}};
    }
    std::uint32_t builds() const { return read<layout::GridBounds>(lists_.grid.bounds)[0].builds; }
    std::uint32_t needed() const { return read<layout::StatusWords>(program_.status)[0].candidates; }

private:
    template <typename T> std::vector<T> read(BufferId buffer) const {
        return test::queue().download<T>(executor_->view(buffer));
    }
    static void submit(const std::function<void(vk::Commands&)>& record) {
        const VkCommandBuffer buffer = test::queue().begin();
        vk::Commands commands(test::device(), buffer);
        record(commands);
        test::queue().wait(test::queue().submit(buffer));
    }

    ProgramBuilder builder_;
    ParticleBuffers particles_;
    lists::Lists lists_;
    StepProgram program_;
    std::optional<GpuExecutor> executor_;
};

Vector3d at(const layout::vec4& v) {
    return {double{v.x}, double{v.y}, double{v.z}};
}

double longestFrom(const Vector3d& way, const std::array<Vector3d, 3>& ways) {
    return std::max({(way - ways[0]).norm(), (way - ways[1]).norm(), (way - ways[2]).norm()});
}

// Bounds of the lists: pairs that must be listed, and pairs that may be, because their distance equals the
// reach within float rounding of the face's size. Slivers have a tolerance of their height, a thousandth of
// their length.
struct Expected {
    Neighbours sure = Neighbours(count), possible = Neighbours(count);
};

// The heading of a particle, whose frame stands still, as a way until the horizon.
Vector3d headingOf(const layout::vec4& v, const Ahead& ahead) {
    const Vector3d velocity = at(v);
    const double most = ahead.pace / double{substep}, speed = velocity.norm();
    return ahead.horizon * std::min(1.0, most / std::max(speed, 1e-30)) * velocity;
}

Expected bruteForce(const Cloud& cloud, const State& state, double margin, const Ahead& ahead = {}) {
    Expected expected;
    const auto faces = cloud.faces();
    for (std::uint32_t f = 0; f < faceCount; ++f) {
        std::array<Vector3d, 3> x;
        std::array<Vector3d, 3> ways, headings;
        for (std::uint32_t k = 0; k < 3; ++k) {
            x[k] = at(state.x[3 * f + k]);
            ways[k] = double{substep} * at(state.v[3 * f + k]);
            headings[k] = headingOf(state.v[3 * f + k], ahead);
        }
        const double size = std::max({(x[1] - x[0]).norm(), (x[2] - x[1]).norm(), (x[0] - x[2]).norm()});
        const double area = (x[1] - x[0]).cross(x[2] - x[0]).norm();
        const double slack = (area < 1.1e-3 * size * size ? 2e-3 : 1e-5) * size;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (cloud.radii[i] < 0 || i / 3 == f || (f >= movingFaces && state.v[i].w == 0)) continue;
            const Vector3d ofPoint = double{substep} * at(state.v[i]);
            const Vector3d heading = headingOf(state.v[i], ahead), point = at(state.x[i]);
            const double still = double{cloud.radii[i]} + double{cloud.thickness[f]} + margin;
            const double most = still + std::max(longestFrom(ofPoint, ways), longestFrom(heading, headings)) +
                                2 * ahead.leeway;
            const double d = toTriangle(point, x), rounding = slack + 1e-6 * (point.norm() + most);
            if (d >= most * (1 + 1e-5) + slack) continue;
            expected.possible[i].push_back(f);
            // Backwards along the ways of this substep, on along headings: sure if they are ever near enough.
            bool meets = d < still - rounding;
            for (int k = 1; k <= 24 && !meets; ++k) {
                const double share = k / 24.0;
                std::array<Vector3d, 3> before = x, later = x;
                for (std::size_t corner = 0; corner < 3; ++corner) {
                    before[corner] -= share * ways[corner];
                    later[corner] += share * headings[corner];
                }
                meets = toTriangle(point - share * ofPoint, before) < still - rounding ||
                        toTriangle(point + share * heading, later) < still - rounding;
            }
            if (meets) expected.sure[i].push_back(f);
        }
    }
    return expected;
}

void expectBetween(const Expected& expected, const Neighbours& found) {
    for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_TRUE(std::is_sorted(found[i].begin(), found[i].end(), std::less_equal<>()))
            << "point " << i << ": not sorted, or a face twice";
        ASSERT_TRUE(std::ranges::includes(found[i], expected.sure[i])) << "point " << i << " misses a face";
        for (const std::uint32_t f : found[i])
            ASSERT_TRUE(std::ranges::binary_search(expected.possible[i], f))
                << "point " << i << " is far from face " << f;
    }
}

// Expects the lists of faces to hold the same pairs as those of points.
void expectMutual(const Neighbours& faces, const Neighbours& points) {
    Neighbours turned(movingFaces);
    for (std::uint32_t i = 0; i < count; ++i)
        for (const std::uint32_t f : faces[i])
            if (f < movingFaces) turned[f].push_back(i);
    ASSERT_EQ(points, turned);
}

float uniform(std::mt19937& random, float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
}

layout::vec4 within(std::mt19937& random, const layout::vec4& center, float half) {
    return {center.x + uniform(random, -half, half), center.y + uniform(random, -half, half),
            center.z + uniform(random, -half, half), 0};
}

using Placing = std::function<layout::vec4(std::mt19937&, std::uint32_t)>;
struct NamedPlacing {
    const char* name;
    Placing place;
};

// Places the first corner of a face, or a loose particle.
std::vector<NamedPlacing> placings() {
    return {{"random", [](std::mt19937& r, std::uint32_t) { return within(r, {}, 0.3f); }},
            {"sparse", [](std::mt19937& r, std::uint32_t) { return within(r, {}, 20); }},
            {"clustered",
             [](std::mt19937& r, std::uint32_t i) {
                 const float n = static_cast<float>(i % 7);
                 return within(r, {3 * n, -n * n, 2 - n, 0}, 0.1f);
             }},
            {"coincident",
             [](std::mt19937&, std::uint32_t i) {
                 return layout::vec4{static_cast<float>(i % 5) * 0.07f, i % 2 == 0 ? 0.0f : -0.0f, 0, 0};
             }},
            {"negative",
             [](std::mt19937& r, std::uint32_t) {
                 return within(r, {-7, -9, -11, 0}, 0.3f);
             }},
            {"far away",
             [](std::mt19937& r, std::uint32_t) {
                 return within(r, {1e4f, -3e4f, 2e4f, 0}, 0.3f);
             }},
            {"with runaways", [](std::mt19937& r, std::uint32_t i) {
                 return within(r, {}, i % 50 == 0 ? 3e4f : i % 50 == 1 ? 1e9f : 0.3f);
             }}};
}

enum class Shape { small, any, degenerate };

State placed(std::mt19937& random, const Placing& place, Shape shape, float speed) {
    State state;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t first = i < 3 * faceCount ? i / 3 * 3 : i;
        const float size = shape == Shape::any && first % 4 == 0 ? 1.5f : 0.06f;
        state.x[i] = i == first ? place(random, i) : within(random, state.x[first], size);
        if (shape == Shape::degenerate && i != first) {
            const int kind = static_cast<int>(first % 4); // at a point, an edge, a line, almost a line
            const layout::vec4& a = state.x[first];
            const float along = 0.05f * static_cast<float>(i - first);
            if (kind == 0) state.x[i] = a;
            if (kind == 1) state.x[i] = {a.x + 0.05f, a.y, a.z, 0};
            if (kind == 2) state.x[i] = {a.x + along, a.y - along, a.z, 0};
            if (kind == 3) state.x[i] = {a.x + along, a.y, a.z + (i == first + 1 ? 1e-5f : 0), 0};
        }
        state.v[i] = within(random, {}, speed);
        if (i % 50 == 7) state.v[i] = within(random, {}, 20 * speed);
        const bool isHeld = inverseMassOf(i) == 0;
        if (isHeld) state.v[i] = {};
        state.v[i].w = isHeld ? 0.0f : 1.0f;
    }
    return state;
}

Cloud cloudOf(std::mt19937& random, int kind) {
    Cloud cloud;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (kind == 1) cloud.radii[i] = uniform(random, 0.005f, 0.03f);
        if (kind == 1 && random() % 30 == 0) cloud.radii[i] = uniform(random, 0.2f, 0.4f);
        if (kind == 2 && random() % 3 == 0) cloud.radii[i] = -1;
    }
    for (std::uint32_t f = 0; f < faceCount; ++f) {
        if (kind == 1) cloud.thickness[f] = uniform(random, 0, 0.02f);
        if (kind == 2 && f % 4 == 0) cloud.extents[f] = 3; // compared with all points
    }
    return cloud;
}

} // namespace

TEST(FaceLists, EqualBruteForceOnTwelveHundredConfigurations) {
    std::mt19937 random(17);
    std::size_t pairs = 0, configurations = 0;
    for (int kind = 0; kind < 3; ++kind) {
        const Cloud cloud = cloudOf(random, kind);
        Cloud reversed = cloud, loads = cloud;
        reversed.isReversed = true;
        loads.usesTexels = false;
        Device device(cloud), backwards(reversed), loading(loads);
        for (const NamedPlacing& placing : placings())
            for (const Shape shape : {Shape::small, Shape::any, Shape::degenerate})
                for (int seed = 0; seed < 20; ++seed, ++configurations) {
                    SCOPED_TRACE(testing::Message() << placing.name << ", cloud " << kind << ", shape "
                                                    << static_cast<int>(shape) << ", seed " << seed);
                    State state = placed(random, placing.place, shape, seed % 3 == 0 ? 0.0f : 8.0f);
                    for (layout::vec4& x : state.x) x.y += seed % 2 == 0 ? 0.0f : 0.125f; // forces new lists
                    device.update(state);
                    const Neighbours found = device.facesOfPoints(), points = device.pointsOfFaces();
                    ASSERT_NO_FATAL_FAILURE(
                        expectBetween(bruteForce(cloud, state, double{cloud.margin}, device.ahead()), found));
                    ASSERT_NO_FATAL_FAILURE(expectMutual(found, points));
                    backwards.update(state);
                    ASSERT_EQ(backwards.facesOfPoints(), found) << "in reversed order";
                    ASSERT_EQ(backwards.pointsOfFaces(), points) << "in reversed order";
                    for (const auto& list : found) pairs += list.size();
                    loading.update(state); // in every turn: leeways depend on the lists before
                    ASSERT_EQ(loading.facesOfPoints(), found) << "without texels";
                }
    }
    EXPECT_GE(configurations, 1200u);
    EXPECT_GT(pairs, 500'000u) << "clouds too thin to show anything";
}

// While all particles wander, every contact on the path of a substep is listed, and lists are rebuilt only
// after long displacements.
TEST(FaceLists, HoldWhatMeetsWhileParticlesWanderAndAreRarelyMadeAgain) {
    std::mt19937 random(5);
    const Cloud cloud = [] {
        Cloud one;
        one.margin = 0.05f;
        return one;
    }();
    Device device(cloud);
    State state = placed(random, placings()[0].place, Shape::small, 0);
    constexpr std::uint32_t updates = 60;
    for (std::uint32_t u = 0; u < updates; ++u) {
        for (std::uint32_t i = 0; i < count; ++i) {
            if (state.v[i].w == 0) continue;
            const layout::vec4 before = state.x[i];
            state.x[i] = within(random, before, 0.002f);
            state.v[i] = {(state.x[i].x - before.x) / substep, (state.x[i].y - before.y) / substep,
                          (state.x[i].z - before.z) / substep, 1};
        }
        device.update(state);
        State still = state; // contacts at the end of the path are a subset
        for (layout::vec4& v : still.v) v = {0, 0, 0, v.w};
        const Neighbours found = device.facesOfPoints(), touching = bruteForce(cloud, still, 0).sure;
        for (std::size_t i = 0; i < found.size(); ++i)
            ASSERT_TRUE(std::ranges::includes(found[i], touching[i])) << "update " << u << ", point " << i;
    }
    EXPECT_GE(device.builds(), 2u);
    EXPECT_LE(device.builds(), updates / 4);
}

TEST(FaceLists, AreMadeAgainForAParticleThatCameFromFarAway) {
    std::mt19937 random(3);
    Cloud cloud;
    cloud.margin = 0.1f;
    Device device(cloud);
    State state = placed(random, placings()[0].place, Shape::small, 0);
    const auto builds = [&] {
        device.update(state);
        return device.builds();
    };
    EXPECT_EQ(builds(), 1u);
    EXPECT_EQ(builds(), 1u);
    state.v[5] = {48, 0, 0, 1}; // 0.048 m in the substep
    EXPECT_EQ(builds(), 1u);
    state.v[5] = {52, 0, 0, 1};
    EXPECT_EQ(builds(), 2u) << "it is where it was, but it began the substep elsewhere";
}

// The substep becomes eight times as long while lists look ahead. In a frame that turns, a point slides over
// a wide face: both follow their headings, and both are nearer to each other than expected by what lists
// allow. They touch in the middle of the substep, because the way of each is straight there.
TEST(FaceLists, HoldWhatMeetsInALongerSubstepWhileTheFrameTurns) {
    Cloud cloud;
    cloud.margin = 0.05f;
    cloud.extents[0] = 3; // compared with all points
    constexpr std::uint32_t point = 251;
    constexpr double h = double{substep}, longer = 8 * h, turn = 0.3; // [s]; of the longer substep [rad]
    const double reach = double{cloud.radii[point]} + double{cloud.thickness[0]};
    Device device(cloud);
    const double way = 0.999 * device.ahead().pace; // along a heading in a short substep [m]
    std::vector<Vector3d> first(count), heading(count, Vector3d::Zero());
    for (std::uint32_t i = 0; i < count; ++i)
        first[i] = {10.0 + i / 3, i % 3 == 1 ? 0.05 : 0, i % 3 == 2 ? 0.05 : 0};
    const double height = reach + 1.02 * double{cloud.margin};
    for (std::uint32_t k = 0; k < 3; ++k) {
        first[k] = {k == 0 ? -1.0 : 0.5, -height / 2, k == 0 ? 0 : k - 1.5};
        heading[k] = {-way / h, 0, 0};
    }
    first[point] = {-9 * way, height / 2, 0};
    heading[point] = {way / h, 0, 0};

    State state;
    const auto update = [&](const std::vector<Vector3d>& start, const std::vector<Vector3d>& end, double dt) {
        const auto vectorOf = [](const Vector3d& v, float w) {
            return layout::vec4{static_cast<float>(v.x()), static_cast<float>(v.y()),
                                static_cast<float>(v.z()), w};
        };
        for (std::uint32_t i = 0; i < count; ++i) {
            state.x[i] = vectorOf(end[i], 0);
            state.v[i] = vectorOf((end[i] - start[i]) / dt, inverseMassOf(i));
        }
        device.update(state, static_cast<float>(dt));
    };
    const auto along = [&](double time) {
        std::vector<Vector3d> x(count);
        for (std::uint32_t i = 0; i < count; ++i) x[i] = first[i] + time * heading[i];
        return x;
    };
    update(along(-h), first, h);
    ASSERT_TRUE(device.facesOfPoints()[point].empty()) << "farther than touching and the margin";
    device.turn(static_cast<float>(turn / longer));
    update(first, along(h), longer);
    ASSERT_EQ(device.builds(), 1u);
    std::vector<Vector3d> start = along(h), end = along(longer);
    const Vector3d up = Vector3d(turn, 1, 0).normalized(); // turned
    for (Vector3d& x : end) x += turn * Vector3d(x.y(), -x.x(), 0);
    for (const std::uint32_t i : {0u, 1u, 2u, point}) {
        const double nearer = (i == point ? -0.97 : 0.97) * device.slack();
        start[i].y() += nearer;
        end[i] += nearer * up;
    }
    const auto middle = [&](std::uint32_t i) -> Vector3d { return (start[i] + end[i]) / 2; };
    ASSERT_LT(toTriangle(middle(point), {middle(0), middle(1), middle(2)}), reach);
    update(start, end, longer);
    EXPECT_EQ(device.facesOfPoints()[point], std::vector<std::uint32_t>{0});
}

// `faces` faces at the origin with 50 points there; all other particles are far apart.
State crowdedState(std::uint32_t faces) {
    State state;
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool isThere = i < 3 * faces || (i >= 200 && i < 250);
        const float side = i < 3 * faceCount ? 0.05f * static_cast<float>(i % 3) : 0;
        state.x[i] = {isThere ? 0.02f : 10.0f * static_cast<float>(i / 3), side, side * side, 0};
        state.v[i].w = 1;
    }
    return state;
}

std::size_t entriesOf(const Neighbours& lists) {
    std::size_t entries = 0;
    for (const auto& list : lists) entries += list.size();
    return entries;
}

TEST(FaceLists, ThatLackRoomSayHowMuchTheyNeedOnAverage) {
    const State state = crowdedState(24);
    Device all({});
    all.update(state);
    const std::size_t entries = entriesOf(all.facesOfPoints());
    const auto needed = static_cast<std::uint32_t>((entries + count - 1) / count);
    ASSERT_GT(needed, 8u);
    EXPECT_EQ(all.needed(), 0u);
    for (const std::uint32_t capacity : {needed, needed - 1, needed / 2, 1u}) {
        Cloud cloud;
        cloud.capacity = capacity;
        Device device(cloud);
        device.update(state);
        // The count stops at four times the capacity.
        const std::uint32_t said = std::min(needed, 4 * capacity + 1);
        EXPECT_EQ(device.needed(), capacity < needed ? said : 0) << "capacity " << capacity;
        EXPECT_LE(entriesOf(device.facesOfPoints()), std::size_t{capacity} * count);
    }
}

TEST(FaceLists, GiveOneOwnerAsMuchAsItNeeds) {
    const State state = crowdedState(faceCount);
    Cloud cloud;
    cloud.capacity = 60; // less than each point there needs
    Device device(cloud);
    device.update(state);
    EXPECT_EQ(device.needed(), 0u);
    EXPECT_EQ(device.facesOfPoints()[201].size(), faceCount);
    expectMutual(device.facesOfPoints(), device.pointsOfFaces());
}

TEST(FaceLists, LeaveOutPairsThatNeverTouch) {
    std::mt19937 random(3);
    Cloud cloud;
    const State state = placed(random, placings()[0].place, Shape::small, 0);
    const auto isOut = [](std::uint32_t f, std::uint32_t i) { return (i * f + i + f) % 3 == 0; };
    Device all(cloud);
    all.update(state);
    Neighbours allowed = all.facesOfPoints();
    for (std::uint32_t i = 0; i < count; ++i)
        std::erase_if(allowed[i], [&](std::uint32_t f) { return isOut(f, i); });
    cloud.exclusions.resize(faceCount + 1);
    for (std::uint32_t f = 0; f < faceCount; ++f) {
        cloud.exclusions[f] = static_cast<std::uint32_t>(cloud.exclusions.size());
        for (std::uint32_t i = 0; i < count; ++i)
            if (isOut(f, i)) cloud.exclusions.push_back(i);
    }
    cloud.exclusions[faceCount] = static_cast<std::uint32_t>(cloud.exclusions.size());
    Device device(cloud);
    device.update(state);
    EXPECT_EQ(device.facesOfPoints(), allowed);
}

TEST(ExcludedPoints, AreThoseOfTheBodyThatAreNearAtRest) {
    Scene scene;
    addCloth(scene, {.size = {6, 6}, .spacing = 0.1f, .thickness = 0.1f});
    const auto loose = static_cast<std::uint32_t>(scene.particles.size());
    scene.particles.push_back({.position = {0.15f, 0, 0.15f}});
    std::vector<layout::ContactFace> faces;
    for (const Face& face : scene.faces)
        faces.push_back({face.particles[0], face.particles[1], face.particles[2], face.thickness});
    const std::vector<float> radii(scene.particles.size(), 0.04f);
    const auto excluded = collision::face_contacts::excludedPoints(scene, linkedBodies(scene), faces, radii,
                                                                   orderedLayout(scene.particles.size()));
    std::size_t near = 0;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const std::array corners{faces[f].a, faces[f].b, faces[f].c};
        std::array<Vector3d, 3> x;
        for (int k = 0; k < 3; ++k) x[k] = test::toVector(scene.particles[corners[k]].position);
        for (std::uint32_t i = 0; i <= loose; ++i) {
            const bool isExcluded =
                std::binary_search(excluded.begin() + excluded[f], excluded.begin() + excluded[f + 1], i);
            const bool isCorner = std::ranges::find(corners, i) != corners.end();
            const bool isNear = !isCorner && i != loose &&
                                toTriangle(test::toVector(scene.particles[i].position), x) < 1.05 * 0.09;
            EXPECT_EQ(isExcluded, isNear) << "face " << f << ", point " << i;
            near += isNear ? 1 : 0;
        }
    }
    EXPECT_GE(near, faces.size()) << "across the diagonal at least";
}
