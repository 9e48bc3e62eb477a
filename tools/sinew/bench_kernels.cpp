// Measures bodies with 26 neighbours, cloths with 8, and one body again with listed links: the ratio of these
// two forms at 32^3 has a design target of 10. The host times whole submissions, as a program would see them.
#include "sinew/bench_kernels.hpp"

#include "app/guard.hpp"
#include "sim/device/gpu_compile.hpp"
#include "sim/program/program.hpp"
#include "sinew/bodies.hpp"
#include "sinew/gpu_tune.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace sinew::tools {

namespace {

constexpr int measuredSteps = 40;
constexpr std::uint32_t shortStep = 8, longStep = 32; // substeps
constexpr std::size_t largeBody = 100'000;            // particles; larger bodies take short steps

struct Body {
    const char* name;
    sim::Scene scene;
    bool isListed = false;
};

sim::Lattice cube(std::uint32_t nodes) {
    return {.origin = {0, 0.1f, 0},
            .cells = {nodes - 1, nodes - 1, nodes - 1},
            .spacing = 0.02f,
            .youngModulus = 5e4f,
            .hasBodyDiagonals = true};
}

sim::Scene bodies(std::uint32_t nodes, std::uint32_t count) {
    sim::Scene scene;
    sim::Lattice lattice = cube(nodes);
    for (std::uint32_t i = 0; i < count; ++i) {
        lattice.origin.x = 0.3f * static_cast<float>(i);
        addLattice(scene, lattice);
    }
    return scene;
}

sim::Scene sphere(std::uint32_t nodes) {
    sim::Lattice lattice = cube(nodes);
    const double radius = 0.5 * (nodes - 1);
    const auto square = [&](std::uint32_t i) { return std::pow(i + 0.5 - radius, 2); };
    for (std::uint32_t z = 0; z + 1 < nodes; ++z)
        for (std::uint32_t y = 0; y + 1 < nodes; ++y)
            for (std::uint32_t x = 0; x + 1 < nodes; ++x)
                lattice.fill.push_back(square(x) + square(y) + square(z) < radius * radius ? 1.0f : 0.0f);
    sim::Scene scene;
    addLattice(scene, lattice);
    return scene;
}

sim::Scene cloth(std::uint32_t nodes) {
    sim::Scene scene;
    addCloth(scene, {.origin = {0, 1, 0},
                     .size = {nodes, nodes},
                     .spacing = 1 / static_cast<float>(nodes - 1),
                     .stretchCompliance = 1e-4f,
                     .shearCompliance = 1e-3f,
                     .pinned = {0, nodes - 1}});
    return scene;
}

double bytesAParticle(const sim::StepProgram& program) {
    std::uint64_t sum = 0;
    for (const sim::BufferSpec& buffer : program.buffers)
        if (!buffer.label.starts_with("skin")) sum += buffer.bytes();
    return static_cast<double>(sum) / program.particleCount;
}

std::string formOf(const sim::Forms& forms, bool isListed) {
    const std::string loads = forms.usesTexels ? "texels" : "loads";
    if (isListed) return "listed, " + loads;
    if (forms.residentBytes > 0) return "resident";
    return fmt::format("{}, columns {}, chunk {}", loads, forms.columns, forms.chunk);
}

Json measure(Session& session, const Body& body, const FormOptions& forms) {
    sim::Settings settings{.substeps = body.scene.particles.size() >= largeBody ? shortStep : longStep};
    settings.forms.usesGrids = !body.isListed;
    settings.forms = forms.in(settings.forms);
    if (forms.isGiven())
        settings.forms = sim::completed(settings.forms, sim::kindOf(session.device));
    else
        settings = sim::tuned(session.device, session.queue, body.scene, settings);
    sim::Simulation simulation(session.device, body.scene, settings);
    VkCommandBuffer commands = session.queue.begin();
    simulation.recordReset(commands);
    session.queue.wait(session.queue.submit(commands));
    std::vector<double> ms;
    for (std::uint64_t frame = 0; frame < measuredSteps && !app::isInterrupted(); ++frame) {
        commands = session.queue.begin();
        simulation.record(commands, {.dt = body.scene.dt, .frame = frame});
        const auto start = std::chrono::steady_clock::now();
        session.queue.wait(session.queue.submit(commands));
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        ms.push_back(taken.count() / settings.substeps);
    }
    if (ms.empty()) return {};
    std::ranges::sort(ms);
    return {{"body", body.name},
            {"form", formOf(settings.forms, body.isListed)},
            {"particles", body.scene.particles.size()},
            {"links", body.scene.distances.size()},
            {"ms_per_substep_least", ms.front()},
            {"ms_per_substep_median", ms[ms.size() / 2]},
            {"ns_per_link", ms.front() * 1e6 / static_cast<double>(body.scene.distances.size())},
            {"bytes_per_particle", bytesAParticle(simulation.program())}};
}

} // namespace

Json measureKernels(Session& session, const FormOptions& forms) {
    struct Entry {
        const char* name;
        sim::Scene (*make)();
        bool isListed = false;
    };
    constexpr Entry entries[] = {
        {"cube 10^3", [] { return bodies(10, 1); }},
        {"cube 16^3", [] { return bodies(16, 1); }},
        {"cube 32^3", [] { return bodies(32, 1); }},
        {"cube 32^3", [] { return bodies(32, 1); }, true},
        {"cube 64^3", [] { return bodies(64, 1); }},
        {"sphere in 64^3", [] { return sphere(65); }},
        {"100 cubes of 10^3", [] { return bodies(10, 100); }},
        {"cloth 64^2", [] { return cloth(64); }},
        {"cloth 256^2", [] { return cloth(256); }},
    };
    Json rows = Json::array();
    for (const Entry& entry : entries) {
        if (app::isInterrupted()) break;
        Json row = measure(session, {entry.name, entry.make(), entry.isListed}, forms);
        if (!row.empty()) rows.push_back(std::move(row));
    }
    return rows;
}

std::string kernelsTable(const Json& rows) {
    std::string text = fmt::format("{:<18} {:<29} {:>9} {:>10} {:>10} {:>8} {:>7}\n", "a substep of split",
                                   "form", "links", "least ms", "median ms", "ns/link", "B/part.");
    for (const Json& row : rows)
        text += fmt::format("{:<18} {:<29} {:>9} {:>10.4f} {:>10.4f} {:>8.2f} {:>7.1f}\n",
                            row["body"].get<std::string>(), row["form"].get<std::string>(),
                            row["links"].get<std::uint64_t>(), row["ms_per_substep_least"].get<double>(),
                            row["ms_per_substep_median"].get<double>(), row["ns_per_link"].get<double>(),
                            row["bytes_per_particle"].get<double>());
    return text;
}

} // namespace sinew::tools
