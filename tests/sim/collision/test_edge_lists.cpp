// Compares lists of edge pairs on the device with brute force, on many kinds of clouds. The owner lists each
// pair once, sorted, for any order of invocations. Also tests lists whose capacity is too small, and the
// edges of scenes.
#include "common/layout.h"
#include "sim/collision/edge_contacts.hpp"
#include "sim/device/gpu_executor.hpp"
#include "sim/model/components.hpp"
#include "sinew/bodies.hpp"
#include "sinew/inverse_masses.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <random>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
namespace lists = sinew::sim::collision::edge_lists;

namespace {

using Neighbours = std::vector<std::vector<std::uint32_t>>;

constexpr std::uint32_t edgeCount = 128, count = 2 * edgeCount;
constexpr float substep = 1e-3f, margin = 0.02f;

bool isLong(std::uint32_t e) {
    return e % 16 == 0;
}

// Edges between particles 2 e and 2 e + 1; every fifth never moves.
std::vector<lists::Edge> edges() {
    std::vector<lists::Edge> result;
    for (std::uint32_t e = 0; e < edgeCount; ++e) {
        const float thickness = 0.005f * static_cast<float>(1 + e % 3), half = isLong(e) ? 0.7f : 0.06f;
        result.push_back({{2 * e, 2 * e + 1}, thickness, half + thickness, e % 5 != 0});
    }
    return result;
}

struct State {
    std::vector<layout::vec4> x = std::vector<layout::vec4>(count), v = std::vector<layout::vec4>(count);
};

// How far lists look ahead: until when particles follow their headings [s], their largest heading as a way in
// a substep, and their largest leeway [m].
struct Ahead {
    double horizon = 0, pace = 1, leeway = 0;
};

// A program that only updates lists of edges.
class Device {
public:
    explicit Device(bool isReversed, bool usesTexels, std::uint32_t capacity = 256,
                    std::vector<std::uint32_t> exclusions = std::vector<std::uint32_t>(edgeCount + 1,
                                                                                       edgeCount + 1))
        : builder_(isReversed, usesTexels) {
        builder_.program().status = builder_.scratch<layout::StatusWords>("status", 1);
        const std::vector<layout::StepParams> step(1, layout::StepParams{.h = substep});
        particles_ = {.count = count,
                      .step = builder_.upload("step", step),
                      .positions = builder_.scratch<layout::vec4>("positions", count),
                      .velocities = builder_.scratch<layout::vec4>("velocities", count)};
        const std::vector<lists::Edge> all = edges();
        lists_ = lists::add(builder_, {.edges = all,
                                       .exclusions = exclusions,
                                       .margin = margin,
                                       .capacity = capacity,
                                       .particles = count});
        builder_.beginPhase("solve");
        builder_.fill(builder_.program().status, 0);
        lists::addListCheck(builder_, lists_, particles_);
        lists::addLists(builder_, lists_, particles_);
        program_ = builder_.finish();
        executor_.emplace(test::device(), program_);
        submit([&](vk::Commands& commands) { executor_->upload(commands); });
    }

    void update(const State& state) {
        constexpr std::size_t bytes = count * sizeof(layout::vec4);
        test::queue().upload(executor_->view(particles_.positions), state.x.data(), bytes);
        test::queue().upload(executor_->view(particles_.velocities), state.v.data(), bytes);
        submit([&](vk::Commands& commands) { executor_->step(commands, {}, {}, nullptr); });
    }

    Neighbours found() const {
        const auto ranges = read<layout::ListRange>(lists_.pooled.ranges);
        const auto entries = read<layout::ContactCandidate>(lists_.pooled.contacts);
        const std::vector<lists::Edge> all = edges();
        Neighbours result(edgeCount);
        for (std::uint32_t e = 0; e < edgeCount; ++e)
            for (std::uint32_t s = 0; s < ranges[e].count; ++s) {
                const layout::ContactCandidate& one = entries[ranges[e].first + s];
                EXPECT_EQ(one.reach, all[e].thickness + all[one.other].thickness);
                result[e].push_back(one.other);
            }
        return result;
    }
    // For each edge, the partners found through the reverse links; every link must match its list entry.
    Neighbours linked() const {
        const auto ranges = read<layout::ListRange>(lists_.pooled.links->ranges);
        const auto elements = read<std::uint32_t>(lists_.pooled.links->elements);
        const auto owners = read<std::uint32_t>(lists_.pooled.links->owners);
        const auto entries = read<layout::ContactCandidate>(lists_.pooled.contacts);
        Neighbours result(edgeCount);
        for (std::uint32_t e = 0; e < edgeCount; ++e)
            for (std::uint32_t s = 0; s < ranges[e].count; ++s) {
                const std::uint32_t element = elements[ranges[e].first + s];
                EXPECT_EQ(entries[element].other, e);
                result[owners[element]].push_back(e);
            }
        for (auto& list : result) std::ranges::sort(list);
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

// Distance by alternating projections from several starts, without the kernel's formula.
double distance(const std::array<Vector3d, 2>& one, const std::array<Vector3d, 2>& other) {
    const auto nearest = [](const Vector3d& p, const std::array<Vector3d, 2>& segment) {
        const Vector3d d = segment[1] - segment[0];
        const double length = d.squaredNorm();
        return Vector3d(segment[0] +
                        (length > 0 ? std::clamp((p - segment[0]).dot(d) / length, 0.0, 1.0) : 0) * d);
    };
    double least = 1e300;
    for (const double start : {0.0, 0.5, 1.0}) {
        Vector3d p = one[0] + start * (one[1] - one[0]), q = nearest(p, other);
        for (int turn = 0; turn < 2000; ++turn) {
            const Vector3d before = p;
            p = nearest(q, one);
            q = nearest(p, other);
            if ((p - before).squaredNorm() < 1e-24 * (1 + p.squaredNorm())) break;
        }
        least = std::min(least, (p - q).norm());
    }
    return least;
}

// Bounds of the lists: pairs that must be listed, and pairs that may be, because their distance equals the
// reach within float rounding.
struct Expected {
    Neighbours sure = Neighbours(edgeCount), possible = Neighbours(edgeCount);
};

// Whether e owns the pair: e moves and f never does, or else one of both by a rule that halves the pairs of
// each edge.
bool owns(const std::vector<lists::Edge>& all, std::uint32_t e, std::uint32_t f) {
    if (all[e].moves != all[f].moves) return all[e].moves;
    return (e + f) % 2 == 0 ? e < f : f < e;
}

// The heading of a particle, whose frame stands still, as a way until the horizon.
Vector3d headingOf(const layout::vec4& v, const Ahead& ahead) {
    const Vector3d velocity = at(v);
    const double most = ahead.pace / double{substep}, speed = velocity.norm();
    return ahead.horizon * std::min(1.0, most / std::max(speed, 1e-30)) * velocity;
}

Expected bruteForce(const State& state, double beyond, const Ahead& ahead = {}) {
    const std::vector<lists::Edge> all = edges();
    Expected expected;
    const auto wayOf = [&](std::uint32_t e) {
        double way = 0;
        for (const std::uint32_t end : {2 * e, 2 * e + 1})
            way = std::max(
                {way, double{substep} * at(state.v[end]).norm(), headingOf(state.v[end], ahead).norm()});
        return way;
    };
    const auto moved = [&](std::uint32_t e, double back, double on) {
        std::array<Vector3d, 2> ends;
        for (std::uint32_t k = 0; k < 2; ++k)
            ends[k] = at(state.x[2 * e + k]) - back * double{substep} * at(state.v[2 * e + k]) +
                      on * headingOf(state.v[2 * e + k], ahead);
        return ends;
    };
    for (std::uint32_t e = 0; e < edgeCount; ++e)
        for (std::uint32_t f = 0; f < edgeCount; ++f) {
            if (e == f || !owns(all, e, f) || (!all[e].moves && !all[f].moves)) continue;
            const std::array<Vector3d, 2> one{at(state.x[2 * e]), at(state.x[2 * e + 1])},
                other{at(state.x[2 * f]), at(state.x[2 * f + 1])};
            const double still = double{all[e].thickness} + double{all[f].thickness} + beyond,
                         reach = still + wayOf(e) + wayOf(f);
            if (0.5 * (one[0] + one[1] - other[0] - other[1]).norm() > reach + 2) continue;
            const double d = distance(one, other), slack = 2e-5 * reach + 2e-7 * one[0].norm() + 1e-5;
            if (d < reach + slack) expected.possible[e].push_back(f);
            // Backwards along the ways of this substep, on along headings: sure if they are ever near enough.
            bool meets = d < still - slack;
            for (int k = 1; k <= 4 && d < reach && !meets; ++k)
                meets = distance(moved(e, k / 4.0, 0), moved(f, k / 4.0, 0)) < still - slack ||
                        distance(moved(e, 0, k / 4.0), moved(f, 0, k / 4.0)) < still - slack;
            if (meets) expected.sure[e].push_back(f);
        }
    return expected;
}

void expectBetween(const Expected& expected, const Neighbours& found) {
    for (std::size_t e = 0; e < found.size(); ++e) {
        ASSERT_TRUE(std::is_sorted(found[e].begin(), found[e].end(), std::less_equal<>()))
            << "edge " << e << ": not sorted, or another twice";
        ASSERT_TRUE(std::ranges::includes(found[e], expected.sure[e])) << "edge " << e << " misses another";
        ASSERT_TRUE(std::ranges::includes(expected.possible[e], found[e]))
            << "edge " << e << " has one far away";
    }
}

layout::vec4 within(std::mt19937& random, const layout::vec4& center, float half) {
    std::uniform_real_distribution<float> any(-half, half);
    const float x = any(random), y = any(random), z = any(random);
    return {center.x + x, center.y + y, center.z + z, 0};
}

// Position of the middle of an edge.
layout::vec4 placed(std::mt19937& random, int kind, std::uint32_t e) {
    const float n = static_cast<float>(e % 5);
    switch (kind) {
    case 0:
        return within(random, {}, 0.25f);
    case 1:
        return within(random, {}, 20);
    case 2:
        return within(random, {3 * n, -n * n, 2 - n, 0}, 0.1f);
    case 3:
        return {0.07f * n, e % 2 == 0 ? 0.0f : -0.0f, 0, 0};
    case 4:
        return within(random, {-7, -9, -11, 0}, 0.25f);
    case 5:
        return within(random, {1000, -3000, 2000, 0}, 0.25f);
    default:
        return within(random, {}, e % 30 == 1 ? 3e4f : 0.25f);
    }
}

State stateOf(std::mt19937& random, int kind, float speed) {
    State state;
    for (std::uint32_t e = 0; e < edgeCount; ++e) {
        const layout::vec4 middle = placed(random, kind, e);
        layout::vec4 half = within(random, {}, isLong(e) ? 0.35f : 0.03f);
        if (e % 11 == 3) half = {};
        if (e % 11 == 4) half = {0.03f, 0, 0, 0}; // many edges are parallel
        state.x[2 * e] = {middle.x - half.x, middle.y - half.y, middle.z - half.z, 0};
        state.x[2 * e + 1] = {middle.x + half.x, middle.y + half.y, middle.z + half.z, 0};
        const bool moves = e % 5 != 0;
        for (std::uint32_t i = 2 * e; i < 2 * e + 2; ++i) {
            if (moves) state.v[i] = within(random, {}, e % 25 == 7 ? 20 * speed : speed);
            state.v[i].w = moves ? 1.0f : 0.0f;
        }
    }
    return state;
}

} // namespace

TEST(EdgeLists, EqualBruteForceOnAThousandConfigurations) {
    std::mt19937 random(11);
    std::size_t pairs = 0, configurations = 0;
    Device device(false, true), backwards(true, true), loading(false, false);
    for (int kind = 0; kind < 7; ++kind)
        for (int seed = 0; seed < 150; ++seed, ++configurations) {
            SCOPED_TRACE(testing::Message() << "kind " << kind << ", seed " << seed);
            State state = stateOf(random, kind, seed % 3 == 0 ? 0.0f : 8.0f);
            for (layout::vec4& x : state.x) x.y += seed % 2 == 0 ? 0.0f : 0.125f; // forces new lists
            device.update(state);
            const Neighbours found = device.found();
            ASSERT_NO_FATAL_FAILURE(expectBetween(bruteForce(state, double{margin}, device.ahead()), found));
            ASSERT_EQ(device.linked(), found) << "links";
            for (const auto& list : found) pairs += list.size();
            backwards.update(state); // in every turn: how far lists look ahead depends on the lists before
            ASSERT_EQ(backwards.found(), found) << "in reversed order";
            ASSERT_EQ(backwards.linked(), found) << "links in reversed order";
            loading.update(state);
            ASSERT_EQ(loading.found(), found) << "without texels";
        }
    std::printf("%zu pairs in %zu configurations\n", pairs, configurations);
    EXPECT_GE(configurations, 1000u);
    EXPECT_GT(pairs, 250'000u) << "clouds too thin to show anything";
}

// While all edges wander, every contact is listed, and lists are rebuilt only after long displacements.
TEST(EdgeLists, HoldWhatMeetsWhileEdgesWanderAndAreRarelyMadeAgain) {
    std::mt19937 random(5);
    Device device(false, true);
    State state = stateOf(random, 0, 0);
    constexpr std::uint32_t updates = 40;
    for (std::uint32_t u = 0; u < updates; ++u) {
        for (std::uint32_t i = 0; i < count; ++i) {
            if (state.v[i].w == 0) continue;
            const layout::vec4 before = state.x[i];
            state.x[i] = within(random, before, 0.001f);
            state.v[i] = {(state.x[i].x - before.x) / substep, (state.x[i].y - before.y) / substep,
                          (state.x[i].z - before.z) / substep, 1};
        }
        device.update(state);
        State still = state;
        for (layout::vec4& v : still.v) v = {0, 0, 0, v.w};
        const Neighbours found = device.found(), touching = bruteForce(still, 0).sure;
        for (std::size_t e = 0; e < found.size(); ++e)
            ASSERT_TRUE(std::ranges::includes(found[e], touching[e])) << "update " << u << ", edge " << e;
    }
    EXPECT_GE(device.builds(), 2u);
    EXPECT_LE(device.builds(), updates / 3);
}

TEST(EdgeLists, ThatLackRoomSayHowMuchTheyNeedAndLeaveOutWhatNeverTouches) {
    std::mt19937 random(3);
    State state = stateOf(random, 0, 0);
    for (layout::vec4& x : state.x) x = {0.5f * x.x, 0.5f * x.y, 0.5f * x.z, x.w};
    Device all(false, true);
    all.update(state);
    Neighbours allowed = all.found();
    std::size_t entries = 0;
    for (const auto& list : allowed) entries += list.size();
    const auto needed = static_cast<std::uint32_t>(entries / edgeCount + 1);
    ASSERT_GE(needed, 2u);
    Device narrow(false, true, needed - 1);
    narrow.update(state);
    EXPECT_EQ(narrow.needed(), needed);
    EXPECT_EQ(all.needed(), 0u);
    std::vector<std::uint32_t> exclusions(edgeCount + 1);
    for (std::uint32_t e = 0; e <= edgeCount; ++e) {
        exclusions[e] = static_cast<std::uint32_t>(exclusions.size());
        for (std::uint32_t f = 0; e < edgeCount && f < edgeCount; ++f)
            if ((e + f) % 3 == 0) exclusions.push_back(f);
        if (e < edgeCount) std::erase_if(allowed[e], [&](std::uint32_t f) { return (e + f) % 3 == 0; });
    }
    Device device(false, true, 256, exclusions);
    device.update(state);
    EXPECT_EQ(device.found(), allowed);
}

TEST(ContactEdges, AreThoseOfFacesButForTheInsidesOfPlanesThatNeverMove) {
    Scene scene;
    addMeshCollider(scene, {.vertices = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}},
                            .triangles = {{0, 1, 2}, {0, 2, 3}},
                            .thickness = 0.01f});
    EXPECT_EQ(collision::edge_contacts::edgesOf(scene, inverseMasses(scene)).size(), 4u)
        << "not the diagonal";
    scene.particles[3].position.y = 0.1f;
    EXPECT_EQ(collision::edge_contacts::edgesOf(scene, inverseMasses(scene)).size(), 5u) << "a crease";
    addCloth(scene, {.origin = {0, 1, 0}, .size = {3, 3}, .spacing = 0.1f, .thickness = 0.04f});
    const auto all = collision::edge_contacts::edgesOf(scene, inverseMasses(scene));
    EXPECT_EQ(all.size(), 5u + 16u) << "6 + 6 along rows and columns, 4 diagonals";
    for (const lists::Edge& edge : all) EXPECT_EQ(edge.moves, edge.ends[0] >= 4);
}

// With cells of 0.1 m and a thickness of 0.12 m, edges one cell apart are near at rest and excluded, those
// two cells apart are not.
TEST(ContactEdges, OfABodyThatAreNearAtRestNeverTouch) {
    Scene scene;
    addCloth(scene, {.size = {5, 5}, .spacing = 0.1f, .thickness = 0.12f});
    const auto edges = collision::edge_contacts::edgesOf(scene, inverseMasses(scene));
    const auto excluded = collision::edge_contacts::excludedEdges(scene, linkedBodies(scene), edges);
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        const std::vector<std::uint32_t> partners(excluded.begin() + excluded[e],
                                                  excluded.begin() + excluded[e + 1]);
        std::vector<std::uint32_t> expected;
        for (std::uint32_t f = 0; f < edges.size(); ++f) {
            const auto& [a, b] = edges[e].ends;
            const auto& [c, d] = edges[f].ends;
            if (a == c || a == d || b == c || b == d) continue;
            const auto x = [&](std::uint32_t i) {
                const Vec3& p = scene.particles[i].position;
                return Vector3d(double{p.x}, double{p.y}, double{p.z});
            };
            if (distance({x(a), x(b)}, {x(c), x(d)}) < 1.05 * 0.12) expected.push_back(f);
        }
        EXPECT_EQ(partners, expected) << "edge " << e;
    }
}
