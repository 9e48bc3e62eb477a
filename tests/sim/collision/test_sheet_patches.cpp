// Tests of patches of sheets: whatever the shape of a sheet, no pair that touches is missing from lists
// because a patch is taken to be alone; a sheet that is not folded has patches that are; and a change of
// shape ends it.
#include "common/layout.h"
#include "sim/collision/distances.hpp"
#include "sim/collision/face_contacts.hpp"
#include "sim/device/gpu_executor.hpp"
#include "sim/model/components.hpp"
#include "sinew/bodies.hpp"
#include "support/device.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

using namespace sinew;
using namespace sinew::sim;
using Eigen::Vector3d;
using test::toTriangle;
namespace lists = sinew::sim::collision::face_lists;
namespace patches = sinew::sim::collision::sheet_patches;

namespace {

constexpr std::uint32_t nodesX = 19, nodesY = 14, sheetNodes = nodesX * nodesY, loose = 54;
constexpr float spacing = 0.02f, substep = 1e-3f;
constexpr std::uint32_t count = 384; // slots
static_assert(sheetNodes + loose <= count);

// A sheet, and loose points behind it.
struct Sheet {
    Scene scene;
    StateLayout layout = orderedLayout(sheetNodes + loose);
    std::vector<float> radii = std::vector<float>(count, -1), masses = std::vector<float>(count, 0);
    std::vector<layout::ContactFace> faces;
    std::vector<std::uint32_t> exclusions;
    float reach = 0;

    explicit Sheet(float thickness) : reach(thickness) {
        addCloth(scene,
                 {.size = {nodesX, nodesY}, .spacing = spacing, .areaDensity = 0.2f, .thickness = thickness});
        for (std::uint32_t i = 0; i < loose; ++i)
            scene.particles.push_back({.position = {50, float(i), 0}, .radius = thickness / 2});
        for (std::size_t i = 0; i < scene.particles.size(); ++i) {
            radii[i] = scene.particles[i].radius;
            masses[i] = 1;
        }
        for (const Face& face : scene.faces)
            faces.push_back({face.particles[0], face.particles[1], face.particles[2], face.thickness});
        exclusions = collision::face_contacts::excludedPoints(
            scene, linkedBodies(scene), faces, std::span(radii).first(scene.particles.size()), layout);
    }
    bool isExcluded(std::uint32_t f, std::uint32_t i) const {
        const layout::ContactFace& face = faces[f];
        return i == face.a || i == face.b || i == face.c ||
               std::binary_search(exclusions.begin() + exclusions[f], exclusions.begin() + exclusions[f + 1],
                                  i);
    }
};

struct State {
    std::vector<Vector3d> x = std::vector<Vector3d>(count, Vector3d::Zero()), way = x; // [m]
};

std::vector<layout::vec4> wordsOf(const std::vector<Vector3d>& all, double scale) {
    std::vector<layout::vec4> words;
    for (const Vector3d& v : all)
        words.push_back({float(scale * v.x()), float(scale * v.y()), float(scale * v.z()), 1});
    return words;
}

// A program that only updates the lists of a sheet.
class Device {
public:
    Device(const Sheet& sheet, float margin, bool isReversed = false, bool isShared = false)
        : builder_(isReversed, true) {
        builder_.program().status = builder_.scratch<layout::StatusWords>("status", 1);
        const std::vector<layout::StepParams> step(1, layout::StepParams{.h = substep});
        particles_ = {.count = count,
                      .step = builder_.upload("step", step),
                      .positions = builder_.scratch<layout::vec4>("positions", count),
                      .velocities = builder_.scratch<layout::vec4>("velocities", count)};
        std::vector<float> extents(sheet.faces.size(), spacing);
        const std::vector<patches::Sheet> sheets =
            patches::sheetsOf(sheet.scene, sheet.layout, sheet.radii, sheet.faces);
        EXPECT_EQ(sheets.size(), 1u);
        lists_ = lists::add(builder_, {.radii = sheet.radii,
                                       .inverseMasses = sheet.masses,
                                       .faces = sheet.faces,
                                       .moving = std::uint32_t(sheet.faces.size()),
                                       .extents = extents,
                                       .exclusions = sheet.exclusions,
                                       .sheets = sheets,
                                       .sharesPatches = isShared,
                                       .margin = margin,
                                       .capacity = 300});
        builder_.beginPhase("solve");
        builder_.fill(builder_.program().status, 0);
        lists::addListCheck(builder_, lists_, particles_);
        lists::addLists(builder_, lists_, particles_);
        program_ = builder_.finish();
        executor_.emplace(test::device(), program_);
        submit([&](vk::Commands& commands) { executor_->upload(commands); });
    }

    void update(const State& state) {
        const auto x = wordsOf(state.x, 1), v = wordsOf(state.way, 1 / double{substep});
        test::queue().upload(executor_->view(particles_.positions), x.data(), x.size() * sizeof x[0]);
        test::queue().upload(executor_->view(particles_.velocities), v.data(), v.size() * sizeof v[0]);
        submit([&](vk::Commands& commands) { executor_->step(commands, {}, {}, nullptr); });
    }
    std::vector<std::vector<std::uint32_t>> facesOfPoints() const {
        const auto ranges = read<layout::ListRange>(lists_.pooled.ranges);
        const auto entries = read<layout::ContactCandidate>(lists_.pooled.contacts);
        std::vector<std::vector<std::uint32_t>> result(count);
        for (std::uint32_t i = 0; i < count; ++i)
            for (std::uint32_t s = 0; s < ranges[i].count; ++s)
                result[i].push_back(entries[ranges[i].first + s].other);
        return result;
    }
    std::vector<std::uint32_t> alone() const { return read<std::uint32_t>(lists_.patches.alone); }
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

// By point: the faces that it touches at one of some moments of the substep.
std::vector<std::vector<std::uint32_t>> touching(const Sheet& sheet, const State& state) {
    constexpr int moments = 6;
    const double far = 4 * double{spacing}, reach = (1 - 1e-4) * double{sheet.reach};
    std::vector<std::vector<Vector3d>> at(moments, state.x);
    for (int k = 1; k < moments; ++k)
        for (std::uint32_t i = 0; i < count; ++i) at[k][i] -= k / (moments - 1.0) * state.way[i];
    std::vector<std::vector<std::uint32_t>> result(count);
    for (std::uint32_t f = 0; f < sheet.faces.size(); ++f) {
        const layout::ContactFace& face = sheet.faces[f];
        for (std::uint32_t i = 0; i < sheetNodes + loose; ++i) {
            if ((at[0][i] - at[0][face.a]).squaredNorm() > far * far || sheet.isExcluded(f, i)) continue;
            bool touches = false;
            for (int k = 0; k < moments && !touches; ++k)
                touches = toTriangle(at[k][i], {at[k][face.a], at[k][face.b], at[k][face.c]}) < reach;
            if (touches) result[i].push_back(f);
        }
    }
    return result;
}

double uniform(std::mt19937& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}
Vector3d within(std::mt19937& random, double half) {
    return {uniform(random, -half, half), uniform(random, -half, half), uniform(random, -half, half)};
}

enum class Form { flat, waves, roll, crumpled, fold, sheared };
constexpr std::array forms{Form::flat, Form::waves, Form::roll, Form::crumpled, Form::fold, Form::sheared};

// Places of the nodes of a sheet, in spacings; `hard` from 0 to 1.
using Shape = std::function<Vector3d(double, double)>;
Shape shapeOf(std::mt19937& random, Form form, double hard, double reach) {
    const double a = uniform(random, 0, 6.3), c = std::cos(a), s = std::sin(a);
    switch (form) {
    case Form::waves: {
        const double length = uniform(random, 3, 12), height = hard * length / 2;
        return [=](double u, double v) {
            return Vector3d(u, v, height * std::sin(2 * std::numbers::pi / length * (c * u + s * v) + 5 * a));
        };
    }
    case Form::roll: {
        const double radius = 0.4 / (0.02 + hard);
        return [=](double u, double v) {
            const double along = c * u + s * v, across = c * v - s * u;
            return Vector3d(radius * std::sin(along / radius), across, radius * std::cos(along / radius));
        };
    }
    case Form::crumpled: {
        std::array<Vector3d, 5> wave, push;
        for (int k = 0; k < 5; ++k) wave[k] = within(random, 1.2), push[k] = within(random, hard);
        return [=](double u, double v) {
            Vector3d x(u, v, 0);
            for (int k = 0; k < 5; ++k) x += std::sin(wave[k].x() * u + wave[k].y() * v + 3 * k) * push[k];
            return x;
        };
    }
    case Form::fold: {
        const double angle = hard * std::numbers::pi, at = uniform(random, 3, 10), gap = 1.3 * reach;
        return [=](double u, double v) -> Vector3d {
            const double along = c * u + s * v - (c + s) * at, across = c * v - s * u;
            const double bent = gap / std::max(angle, 0.1);
            if (along < 0) return {along, across, 0};
            const double turn = std::min(along / bent, angle), rest = along - turn * bent;
            return {bent * std::sin(turn) + rest * std::cos(turn), across,
                    bent * (1 - std::cos(turn)) + rest * std::sin(turn)};
        };
    }
    case Form::sheared: {
        const double x = uniform(random, 1 - hard, 1.2), y = uniform(random, 1 - hard, 1.2),
                     shear = uniform(random, -hard, hard);
        return [=](double u, double v) { return Vector3d(x * u + shear * v, y * v, 0); };
    }
    default:
        return [](double u, double v) { return Vector3d(u, v, 0); };
    }
}

State placed(std::mt19937& random, const Sheet& sheet, Form form, double hard, bool areNear) {
    const double unit = double{spacing};
    const Shape end = shapeOf(random, form, hard, double{sheet.reach} / unit);
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(Eigen::Vector4d(within(random, 1).x(), 0.3, within(random, 1).y(), 0.2))
            .normalized();
    const Vector3d from = within(random, random() % 8 == 0 ? 100 : 0.5);
    const double wildness = random() % 2 == 0 ? 0 : uniform(random, 0, 0.3 * hard);
    const Vector3d drift = within(random, 0.4), spin = within(random, 0.05);
    State state;
    for (std::uint32_t y = 0; y < nodesY; ++y)
        for (std::uint32_t x = 0; x < nodesX; ++x) {
            const std::uint32_t i = x + nodesX * y;
            const Vector3d place = turn * end(x, y);
            state.x[i] = from + unit * (place + within(random, wildness / 2));
            state.way[i] = unit * (drift + spin.cross(place) + within(random, wildness));
        }
    for (std::uint32_t i = sheetNodes; i < sheetNodes + loose; ++i) {
        const std::uint32_t node = std::uint32_t(random() % sheetNodes);
        state.x[i] = areNear ? Vector3d(state.x[node] + within(random, 3 * double{sheet.reach}))
                             : Vector3d(from + Vector3d(3 + i * 0.1, 0, 0));
        if (areNear) state.way[i] = within(random, 2 * unit);
    }
    for (std::uint32_t i = sheetNodes + loose; i < count; ++i) state.x[i] = from;
    return state;
}

struct Found {
    std::size_t pairs = 0, alone = 0, all = 0;
};

void expectComplete(const Sheet& sheet, const State& state, const Device& device, Found& found) {
    ASSERT_EQ(device.needed(), 0u);
    const auto listed = device.facesOfPoints(), touches = touching(sheet, state);
    for (std::uint32_t i = 0; i < count; ++i) {
        found.pairs += touches[i].size();
        ASSERT_TRUE(std::ranges::includes(listed[i], touches[i])) << "point " << i << " misses a face";
    }
    for (const std::uint32_t one : device.alone()) found.alone += one;
    found.all += device.alone().size();
}

} // namespace

TEST(PatchesOfSheets, HideNothingThatTouchesInTwelveHundredShapes) {
    std::mt19937 random(29);
    std::array<Found, forms.size()> found;
    std::size_t shapes = 0;
    for (const float thickness : {0.0115f, 0.01f, 0.005f, 0.02f}) {
        const Sheet sheet(thickness);
        Device device(sheet, thickness / 4), backwards(sheet, thickness / 4, true, true);
        for (int turn = 0; turn < 50; ++turn)
            for (std::size_t k = 0; k < forms.size(); ++k, ++shapes) {
                SCOPED_TRACE(testing::Message()
                             << "thickness " << thickness << ", form " << k << ", turn " << turn);
                const State state = placed(random, sheet, forms[k], (turn % 10) / 9.0, turn % 3 == 0);
                device.update(state);
                ASSERT_NO_FATAL_FAILURE(expectComplete(sheet, state, device, found[k]));
                backwards.update(state); // in every turn: leeways depend on the lists before
                ASSERT_EQ(backwards.facesOfPoints(), device.facesOfPoints()) << "in reversed order";
            }
    }
    EXPECT_GE(shapes, 1200u);
    const auto share = [&](Form form) {
        const Found& one = found[std::size_t(form)];
        return double(one.alone) / double(one.all);
    };
    EXPECT_GT(share(Form::flat), 0.4); // all but those with a point near, and under wild motion
    EXPECT_GT(share(Form::waves), 0.1);
    EXPECT_GT(share(Form::roll), 0.05); // most are narrow
    EXPECT_GT(share(Form::fold), 0.1);
    for (std::size_t k = 0; k < forms.size(); ++k) {
        EXPECT_GT(found[k].pairs, 1000u) << "form " << k << " shows little";
        RecordProperty("alone_" + std::to_string(k), std::to_string(100 * found[k].alone / found[k].all));
    }
}

TEST(PatchesOfSheets, AreAllAloneInAFlatSheetAndListNothing) {
    std::mt19937 random(3);
    const Sheet sheet(0.0115f);
    Device device(sheet, 0.003f);
    State state = placed(random, sheet, Form::flat, 0, false);
    for (Vector3d& way : state.way) way *= 0.1; // a tenth of a spacing in a substep, and a slow turn
    device.update(state);
    for (const std::uint32_t one : device.alone()) EXPECT_EQ(one, 1u);
    for (const auto& list : device.facesOfPoints()) EXPECT_TRUE(list.empty());

    const Vector3d above = (state.x[1] - state.x[0]).cross(state.x[nodesX] - state.x[0]).normalized();
    const std::uint32_t node = 9 + nodesX * 6; // in the middle of a patch
    state.x[sheetNodes] = state.x[node] + 0.9 * double{sheet.reach} * above;
    state.way[sheetNodes].setZero();
    device.update(state);
    std::size_t searching = 0;
    for (const std::uint32_t one : device.alone()) searching += one == 0;
    EXPECT_EQ(searching, 1u) << "only the patch below the point searches";
    EXPECT_FALSE(device.facesOfPoints()[sheetNodes].empty());
}

// Every node stays within the slack of lists, but a strip of the sheet is squeezed until a corner touches the
// face across the diagonal. One invocation and several that share a patch give it up in the same substep.
TEST(PatchesOfSheets, AreGivenUpWhenTheirShapeChanges) {
    std::mt19937 random(4);
    const Sheet sheet(0.0115f);
    const float margin = 0.5f * spacing; // slack of about a quarter of a spacing
    Device device(sheet, margin), sharing(sheet, margin, false, true);
    const State flat = placed(random, sheet, Form::flat, 0, false);
    State state = flat;
    for (Vector3d& way : state.way) way.setZero();
    device.update(state);
    sharing.update(state);
    const std::uint32_t builds = device.builds();
    bool wasGivenUp = false;
    for (int step = 1; step <= 24 && !wasGivenUp; ++step) {
        const State before = state;
        for (std::uint32_t i = 0; i < sheetNodes; ++i) {
            const double part = step / 100.0 * (i % nodesX % 2 == 0 ? 1 : -1);
            state.x[i] = flat.x[i] + part * (flat.x[1] - flat.x[0]);
            state.way[i] = state.x[i] - before.x[i];
        }
        device.update(state);
        sharing.update(state);
        Found found;
        ASSERT_NO_FATAL_FAILURE(expectComplete(sheet, state, device, found)) << step;
        ASSERT_EQ(sharing.builds(), device.builds()) << step;
        wasGivenUp = device.builds() > builds;
        EXPECT_TRUE(wasGivenUp || found.pairs == 0) << step;
    }
    EXPECT_TRUE(wasGivenUp);
}

// Loose points come towards a sheet at rest, each along its own heading: lists that were made while all were
// far away are complete until the points touch.
TEST(PatchesOfSheets, AreNotAloneWhenAPointArrives) {
    std::mt19937 random(9);
    const Sheet sheet(0.0115f);
    const double reach = double{sheet.reach};
    Device device(sheet, sheet.reach / 4);
    State state = placed(random, sheet, Form::flat, 0, false);
    for (Vector3d& way : state.way) way.setZero();
    const Vector3d above = (state.x[1] - state.x[0]).cross(state.x[nodesX] - state.x[0]).normalized();
    for (std::uint32_t i = sheetNodes; i < sheetNodes + loose; ++i) {
        state.x[i] = state.x[random() % sheetNodes] + uniform(random, 3, 8) * reach * above;
        state.way[i] = -uniform(random, 0.03, 0.1) * reach * above + within(random, 0.01 * reach);
    }
    Found found;
    constexpr int steps = 120;
    for (int step = 0; step < steps; ++step) {
        for (std::uint32_t i = sheetNodes; i < sheetNodes + loose; ++i) state.x[i] += state.way[i];
        device.update(state);
        ASSERT_NO_FATAL_FAILURE(expectComplete(sheet, state, device, found)) << step;
    }
    EXPECT_GT(found.pairs, 100u);
    EXPECT_LT(device.builds(), steps / 2) << "lists last for several substeps";
    EXPECT_GT(found.alone, found.all / 10);
}
