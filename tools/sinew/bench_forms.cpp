// Forms are forced, not tuned: a row must have the form that it names. Device timestamps exclude the host's
// cost of a submission; a family without timestamps is timed by the host's clock.
#include "sinew/bench_forms.hpp"

#include "app/guard.hpp"
#include "app/kept_forms.hpp"
#include "scenes/load.hpp"
#include "sim/device/gpu_compile.hpp"
#include "sim/model/grids.hpp"
#include "sim/program/program.hpp"
#include "sim/solvers/batches.hpp"
#include "sinew/bodies.hpp"
#include "sinew/options.hpp"
#include "sinew/simulation.hpp"
#include "sinew/vk/timestamps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace sinew::tools {

namespace {

constexpr std::size_t leastSteps = 2, mostSteps = 60; // after one that is not measured
constexpr double mostSeconds = 0.2;

struct Body {
    const char* name;
    sim::Scene scene;
    std::uint32_t substeps;
};

// A shipped body that touches only planes: contacts do not have these forms, and take most of a step.
Body shipped(const char* name) {
    scenes::LoadedScene loaded = scenes::loadBuiltIn(name);
    for (sim::Particle& particle : loaded.scene.particles) particle.radius = 0;
    return {name, std::move(loaded.scene), loaded.settings.substeps};
}

Body cubes(const char* name, std::uint32_t nodes, std::uint32_t count = 1) {
    sim::Scene scene;
    for (std::uint32_t i = 0; i < count; ++i)
        addLattice(scene, {.origin = {0.3f * static_cast<float>(i), 0.1f, 0},
                           .cells = {nodes - 1, nodes - 1, nodes - 1},
                           .spacing = 0.02f,
                           .youngModulus = 5e4f});
    return {name, std::move(scene), 32};
}

bool mayBeListed(const sim::Scene& scene) {
    return std::ranges::none_of(scene.grids, [](const sim::Grid& grid) {
        return grid.isCuttable || grid.volumeStiffness > 0 || grid.recoveryPressure > 0;
    });
}

// Large bodies are measured in few forms: their programs take seconds to make.
std::vector<sim::Forms> formsOf(const vk::Device& device, const sim::Scene& scene) {
    constexpr std::size_t largeBody = 200'000; // particles
    std::vector<sim::Forms> forms{{.columns = 2, .chunk = 16},
                                  {.usesTexels = false, .columns = 1, .chunk = 4},
                                  {.usesTexels = false, .columns = 1, .chunk = 1}};
    if (scene.particles.size() >= largeBody) return forms;
    forms.push_back({.columns = 1, .chunk = 16});
    forms.push_back({.usesTexels = false, .columns = 2, .chunk = 16});
    forms.push_back({.usesTexels = false, .columns = 1, .chunk = 16});
    const sim::Settings resident{.forms = {.residentBytes = device.limits().maxSharedMemory}};
    const std::vector<std::uint32_t> grids = sim::computedGrids(scene, resident);
    if (sim::solvers::isResident(scene, resident, grids))
        for (const auto& [columns, chunk] : {std::pair{2u, 16u}, {1u, 1u}})
            forms.push_back(
                {.columns = columns, .chunk = chunk, .residentBytes = resident.forms.residentBytes});
    if (mayBeListed(scene)) forms.push_back({.usesTexels = false, .usesGrids = false});
    return forms;
}

struct Times {
    std::vector<double> device, host; // [ms]
};

Times measure(Session& session, const sim::Scene& scene, const sim::Settings& settings) {
    using Clock = std::chrono::steady_clock;
    sim::Simulation simulation(session.device, scene, settings);
    vk::Timestamps timestamps(session.device, 1);
    const vk::Drain drain(session.queue);
    VkCommandBuffer commands = session.queue.begin();
    simulation.recordReset(commands);
    session.queue.wait(session.queue.submit(commands));
    Times times;
    const Clock::time_point begin = Clock::now();
    for (std::uint64_t frame = 0; frame <= mostSteps && !app::isInterrupted(); ++frame) {
        const std::chrono::duration<double> soFar = Clock::now() - begin;
        if (frame > leastSteps && soFar.count() > mostSeconds) break;
        commands = session.queue.begin();
        vk::Commands recorder(session.device, commands);
        timestamps.reset(recorder);
        timestamps.begin(recorder, 0);
        simulation.record(commands, {.dt = scene.dt, .gravity = scene.gravity, .frame = frame});
        timestamps.end(recorder, 0);
        const Clock::time_point start = Clock::now();
        session.queue.wait(session.queue.submit(commands));
        const std::chrono::duration<double, std::milli> taken = Clock::now() - start;
        if (frame == 0) continue; // drivers may compile in the first
        times.host.push_back(taken.count());
        for (const double ms : timestamps.milliseconds()) times.device.push_back(ms);
    }
    std::ranges::sort(times.device);
    std::ranges::sort(times.host);
    return times;
}

Json rowOf(Session& session, const Body& body, const sim::Forms& forms) {
    const Times times = measure(session, body.scene, {.substeps = body.substeps, .forms = forms});
    if (times.host.empty()) return {};
    const bool hasDevice = !times.device.empty();
    const std::vector<double>& ms = hasDevice ? times.device : times.host;
    return {{"body", body.name},
            {"form", app::toText(sim::completed(forms, sim::kindOf(session.device)))},
            {"particles", body.scene.particles.size()},
            {"substeps", body.substeps},
            {"steps", ms.size()},
            {"clock", hasDevice ? "device" : "host"},
            {"ms_best", ms.front()},
            {"ms_median", ms[ms.size() / 2]},
            {"host_ms_best", times.host.front()}};
}

std::string lineOf(const Json& row) {
    return fmt::format("{:<11} {:<49} {:>9} {:>8} {:>5} {:>9.4f} {:>9.4f} {:>9.4f}\n",
                       row["body"].get<std::string>(), row["form"].get<std::string>(),
                       row["particles"].get<std::uint64_t>(), row["substeps"].get<std::uint32_t>(),
                       row["steps"].get<std::uint64_t>(), row["ms_best"].get<double>(),
                       row["ms_median"].get<double>(), row["host_ms_best"].get<double>());
}

} // namespace

Json measureForms(Session& session) {
    Json rows = Json::array();
    Body (*const bodies[])() = {[] { return shipped("cloth_links"); },
                                [] { return shipped("cube"); },
                                [] { return shipped("organ"); },
                                [] { return cubes("body 10^3", 10); },
                                [] { return cubes("100 of 10^3", 10, 100); },
                                [] { return cubes("body 64^3", 64); },
                                [] { return cubes("body 100^3", 100); }};
    for (Body (*const make)() : bodies) {
        if (app::isInterrupted()) break;
        const Body body = make();
        for (const sim::Forms& forms : formsOf(session.device, body.scene)) {
            if (app::isInterrupted()) break;
            Json row = rowOf(session, body, forms);
            if (row.empty()) break;
            std::fputs(lineOf(row).c_str(), stderr); // the whole may take a minute
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

std::string formsTable(const Json& rows) {
    std::string text = fmt::format("{:<11} {:<49} {:>9} {:>8} {:>5} {:>9} {:>9} {:>9}\n", "a step", "form",
                                   "particles", "substeps", "steps", "best ms", "median ms", "host ms");
    for (const Json& row : rows) text += lineOf(row);
    if (!rows.empty()) text += fmt::format("by the {}'s clock\n", rows[0]["clock"].get<std::string>());
    return text;
}

} // namespace sinew::tools
