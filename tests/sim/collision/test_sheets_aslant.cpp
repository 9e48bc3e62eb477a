// Tests of two sheets that meet aslant or edge on, at many reaches a substep: no edge passes another, and no
// point passes a face.
#include "sim/collision/face_scenes.hpp"
#include "sim/collision/passage.hpp"
#include "sim/runner.hpp"
#include "sim/scenes.hpp"
#include "sinew/bodies.hpp"
#include "support/full.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <set>
#include <vector>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;

namespace {

constexpr std::uint32_t side = 9; // particles of a sheet along each edge
constexpr std::size_t size = std::size_t{side} * side;
constexpr float spacing = 0.03f; // [m]

struct Meeting {
    double degrees; // between the two sheets
    double reaches; // that the upper sheet moves in a substep
    std::uint32_t substeps;
    double reach = 0.008; // distance at which the two touch, the thickness of each [m]
};

// A sheet in the middle, and one above it, inclined and turned, that comes down on it.
Scene sheets(const Meeting& meeting) {
    Scene scene;
    scene.gravity = {};
    const double angle = meeting.degrees * std::numbers::pi / 180, turn = 0.3;
    const double half = 0.5 * double{spacing} * (side - 1);
    const double speed = meeting.reaches * meeting.reach * 60 * meeting.substeps;
    const double gap = 1.3 * meeting.reach, height = gap + half * std::sin(angle);
    for (const bool isUpper : {false, true}) {
        const double a = isUpper ? angle : 0, b = isUpper ? turn : 0;
        const Vector3d right(std::cos(a) * std::cos(b), std::sin(a), std::cos(a) * std::sin(b));
        const Vector3d down(-std::sin(b), 0, std::cos(b));
        const Vector3d middle = isUpper ? Vector3d(0.37 * spacing, height, 0.21 * spacing) : Vector3d::Zero();
        addCloth(scene, {.origin = test::toFloats(middle - half * (right + down)),
                         .right = test::toFloats(right),
                         .down = test::toFloats(down),
                         .size = {side, side},
                         .spacing = spacing,
                         .thickness = static_cast<float>(meeting.reach)});
    }
    for (std::size_t i = size; i < 2 * size; ++i)
        scene.particles[i].velocity = {0, -static_cast<float>(speed), 0};
    return scene;
}

using Edge = std::array<std::uint32_t, 2>;

std::vector<Edge> edgesOf(const Scene& scene, bool ofUpper) {
    std::set<Edge> edges;
    for (const Face& face : scene.faces)
        for (std::size_t c = 0; c < 3; ++c) {
            const auto [a, b] = std::minmax(face.particles[c], face.particles[(c + 1) % 3]);
            if ((a >= size) == ofUpper) edges.insert({a, b});
        }
    return {edges.begin(), edges.end()};
}

// A box around places at two times.
struct Box {
    Vector3d low = Vector3d::Constant(1e30), high = Vector3d::Constant(-1e30);
    void add(const Vector3d& x) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    bool meets(const Box& other) const {
        return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
    }
};

template <typename Indices>
std::vector<Box> boxesOf(const std::vector<Indices>& all, const std::vector<Vector3d>& before,
                         const std::vector<Vector3d>& after) {
    std::vector<Box> boxes(all.size());
    for (std::size_t k = 0; k < all.size(); ++k)
        for (const std::uint32_t i : all[k])
            for (const auto* x : {&before, &after}) boxes[k].add((*x)[i]);
    return boxes;
}

struct Passed {
    int edges = 0, points = 0;
};

// Counts edges and points of the two sheets that pass in a step: looks at all pairs.
class Judge {
public:
    explicit Judge(const Scene& scene) : lower_(edgesOf(scene, false)), upper_(edgesOf(scene, true)) {
        for (std::uint32_t i = 0; i < 2 * size; ++i) points_.push_back({i});
        for (const Face& face : scene.faces) faces_.push_back(face.particles);
    }

    Passed look(const std::vector<Vector3d>& before, const std::vector<Vector3d>& after) const {
        Passed passed;
        const auto low = boxesOf(lower_, before, after), high = boxesOf(upper_, before, after);
        for (std::size_t e = 0; e < lower_.size(); ++e)
            for (std::size_t f = 0; f < upper_.size(); ++f) {
                if (!low[e].meets(high[f])) continue;
                const std::array<std::uint32_t, 4> ends{lower_[e][0], lower_[e][1], upper_[f][0],
                                                        upper_[f][1]};
                test::Ends from, to;
                for (std::size_t k = 0; k < 4; ++k) {
                    from[k] = before[ends[k]];
                    to[k] = after[ends[k]];
                }
                passed.edges += test::edgesPass(from, to) ? 1 : 0;
            }
        const auto faces = boxesOf(faces_, before, after), points = boxesOf(points_, before, after);
        for (std::size_t f = 0; f < faces_.size(); ++f)
            for (std::uint32_t i = 0; i < points_.size(); ++i) {
                const auto& k = faces_[f];
                if ((i < size) == (k[0] < size) || !faces[f].meets(points[i])) continue;
                passed.points +=
                    test::passesThrough(before[i], after[i], {before[k[0]], before[k[1]], before[k[2]]},
                                        {after[k[0]], after[k[1]], after[k[2]]})
                        ? 1
                        : 0;
            }
        return passed;
    }

private:
    std::vector<Edge> lower_, upper_;
    std::vector<std::array<std::uint32_t, 1>> points_;
    std::vector<std::array<std::uint32_t, 3>> faces_;
};

// Edges of a sheet through faces of the other one.
int crossingsOf(const Scene& scene, const std::vector<Vector3d>& x) {
    int both = test::intersections(scene, x);
    for (const bool isUpper : {false, true}) {
        Scene one = scene;
        std::erase_if(one.faces, [&](const Face& face) { return (face.particles[0] >= size) != isUpper; });
        both -= test::intersections(one, x);
    }
    return both;
}

struct Outcome {
    Passed passed;
    int crossings = 0;
    double fastest = 0; // in speeds of the upper sheet
};

// Each substep is a step of its own, so that the whole path of each particle is seen.
Outcome outcomeOf(Scene scene, const Meeting& meeting) {
    scene.dt /= static_cast<float>(meeting.substeps);
    const double speed = std::abs(double{scene.particles.back().velocity.y});
    test::Runner runner(scene, {.substeps = 1, .contactRoom = 512});
    const Judge judge(scene);
    Outcome outcome;
    auto before = runner.positions();
    for (int step = 0; step < 40; ++step) {
        const Status status = runner.run(1);
        EXPECT_FALSE(status.isUndone) << "step " << step << ", room " << status.contactRoom;
        if (status.isUndone) break;
        auto after = runner.positions();
        const Passed passed = judge.look(before, after);
        outcome.passed.edges += passed.edges;
        outcome.passed.points += passed.points;
        before = std::move(after);
        for (const Vector3d& v : runner.velocities())
            outcome.fastest = std::max(outcome.fastest, v.norm() / speed);
    }
    outcome.crossings = crossingsOf(scene, before);
    return outcome;
}

} // namespace

TEST(SheetsAslant, PassNothingOfEachOther) {
    for (const double degrees : {30.0, 60.0, 90.0})
        for (const double reaches : {1.5, 4.0, 20.0})
            for (const std::uint32_t substeps : {4u, 16u, 64u}) {
                const Meeting meeting{degrees, reaches, substeps};
                const Outcome outcome = outcomeOf(sheets(meeting), meeting);
                std::printf(
                    "%.0f degrees, %.1f reaches a substep, %u substeps: %d edges and %d points pass, %d "
                    "edges in faces at the end, fastest %.2f\n",
                    degrees, reaches, substeps, outcome.passed.edges, outcome.passed.points,
                    outcome.crossings, outcome.fastest);
                EXPECT_EQ(outcome.passed.edges, 0);
                EXPECT_EQ(outcome.passed.points, 0);
                EXPECT_EQ(outcome.crossings, 0);
                EXPECT_LE(outcome.fastest, reaches == 20 ? 8 : 4)
                    << "a sheet that is hit edge on is pressed together";
            }
}

// Contacts throw corners past edges that were out of reach of their predicted paths, which are in no list.
// The longer form has more angles and ways.
TEST(SheetsAslant, PassNothingThatTheyAreThrownAt) {
    const auto angles =
        test::isFull() ? std::vector{8.0, 15.0, 22.5, 40.0, 50.0, 70.0, 80.0} : std::vector{80.0};
    const auto ways = test::isFull() ? std::vector{8.0, 20.0, 40.0} : std::vector{20.0};
    for (const double degrees : angles)
        for (const double reaches : ways) {
            const Meeting meeting{degrees, reaches, 4};
            const Outcome outcome = outcomeOf(sheets(meeting), meeting);
            std::printf(
                "%.1f degrees, %.1f reaches a substep: %d edges and %d points pass, %d edges in faces at "
                "the end, fastest %.2f\n",
                degrees, reaches, outcome.passed.edges, outcome.passed.points, outcome.crossings,
                outcome.fastest);
            EXPECT_EQ(outcome.passed.edges, 0);
            EXPECT_EQ(outcome.passed.points, 0);
            EXPECT_EQ(outcome.crossings, 0);
        }
}
