// Uses the solver's own classes: colouring is a pure function of the scene.
#include "viewer/layers/link_lines.hpp"

#include "common/layout.h"
#include "sim/lattice/link_bits.hpp"
#include "sim/model/coloring.hpp"
#include "sinew/inspection.hpp"
#include "sinew/inverse_masses.hpp"
#include "viewer/layers/value_maps.hpp"
#include "viewer/render/mesh_buffer.hpp"
#include "viewer_shaders.hpp"

#include <algorithm>
#include <utility>

namespace sinew::viewer {

namespace {

constexpr std::array<float, 3> still{0.22f, 0.22f, 0.22f};  // links without a class
constexpr std::array<float, 3> atOnce{0.03f, 0.05f, 0.10f}; // solvers without classes

std::string noteOf(sim::Solver solver, std::size_t classes) {
    if (solver == sim::Solver::gaussSeidel)
        return countText(classes, "class", "classes") +
               ", one after another; no two links of one share a particle that moves";
    if (solver == sim::Solver::split)
        return "The split solver updates all links together, so there are no color classes.";
    return "The jacobi solver updates all links together, so there are no color classes.";
}

layout::LineLink lineOf(const sim::Scene& scene, std::uint32_t d, std::span<const std::uint32_t> slots) {
    const sim::DistanceConstraint& link = scene.distances[d];
    const sim::lattice::LinkBits bits = sim::lattice::linkBits(scene, d);
    return {link.a,
            link.b,
            bits.ofA != 0 ? slots[link.a] : 0,
            bits.ofA,
            bits.ofOver != 0 ? slots[bits.over] : 0,
            bits.ofOver};
}

// Links class by class, then the others; `slots` of the particles in the solver's state.
std::vector<layout::LineLink> lineLinks(const sim::Scene& scene, const LinkClasses& classes,
                                        std::span<const std::uint32_t> slots) {
    std::vector<std::uint32_t> order = classes.order;
    std::vector<bool> isListed(scene.distances.size());
    for (const std::uint32_t d : order) isListed[d] = true;
    for (std::uint32_t d = 0; d < scene.distances.size(); ++d)
        if (!isListed[d]) order.push_back(d);
    std::vector<layout::LineLink> links;
    links.reserve(order.size());
    for (const std::uint32_t d : order) links.push_back(lineOf(scene, d, slots));
    if (links.empty()) links.emplace_back(); // buffers must not be empty
    return links;
}

std::vector<LinkLines::Range> rangesOf(const LinkClasses& classes, std::uint32_t links) {
    std::vector<LinkLines::Range> ranges;
    std::uint32_t first = 0;
    for (const std::uint32_t end : classes.ends) {
        ranges.push_back(
            {2 * first, 2 * (end - first), classes.count() > 1 ? classColor(ranges.size()) : atOnce});
        first = end;
    }
    if (first < links) ranges.push_back({2 * first, 2 * (links - first), still});
    return ranges;
}

constexpr VkVertexInputBindingDescription binding{0, sizeof(sim::layout::vec4), VK_VERTEX_INPUT_RATE_VERTEX};
constexpr VkVertexInputAttributeDescription attribute{0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0};

PipelineRequest linkPipeline() {
    return {.name = "links",
            .vertex = &shaders::wiresVert,
            .fragment = &shaders::linkFrag,
            .input = PipelineRequest::Input::own,
            .vertices = {{&binding, 1}, {&attribute, 1}},
            .depth = PipelineRequest::Depth::testAndWrite,
            .topology = VK_PRIMITIVE_TOPOLOGY_LINE_LIST};
}

// A square per class, in the order of solving, with the number of its links.
std::vector<LegendLine> linkLegend(const LinkFacts& links) {
    using enum LegendLine::Kind;
    std::vector<LegendLine> legend;
    if (links.classes.size() > 1) {
        LegendLine classes{.kind = squares};
        for (std::size_t i = 0; i < links.classes.size(); ++i) {
            classes.colors.push_back(classColor(i));
            classes.tips.push_back("class " + std::to_string(i + 1) + ": " +
                                   countText(links.classes[i], "link"));
        }
        legend.push_back(std::move(classes));
    }
    legend.push_back({text, links.note});
    if (links.fixed > 0) legend.push_back({row, "links between fixed particles", grouped(links.fixed)});
    return legend;
}

constexpr std::array<Layer::Look, 1> looks{{{"links", "Links"}}};

} // namespace

constinit const Layer layer::links{.key = '4',
                                   .help = "links, in one color if the solver corrects them together",
                                   .button = "Links",
                                   .looks = looks,
                                   .make = [](const LayerContext& of) -> std::unique_ptr<const LayerPart> {
                                       return std::make_unique<const LinkLines>(of.device, of.scene,
                                                                                of.settings, of.simulation);
                                   },
                                   .pipeline = linkPipeline,
                                   .opened = &shaders::linkSectionFrag};

LinkClasses linkClasses(const sim::Scene& scene, sim::Solver solver) {
    const std::vector<float> inverseMasses = sim::inverseMasses(scene);
    LinkClasses classes;
    if (solver == sim::Solver::gaussSeidel) {
        sim::Coloring coloring = sim::colorByParticles(scene, inverseMasses);
        classes.order = std::move(coloring.order);
        classes.ends = std::move(coloring.ends);
    } else {
        for (std::uint32_t d = 0; d < scene.distances.size(); ++d)
            if (inverseMasses[scene.distances[d].a] > 0 || inverseMasses[scene.distances[d].b] > 0)
                classes.order.push_back(d);
        if (!classes.order.empty()) classes.ends = {static_cast<std::uint32_t>(classes.order.size())};
    }
    classes.note = noteOf(solver, classes.count());
    return classes;
}

LinkLines::LinkLines(const vk::Device& device, const sim::Scene& scene, const sim::Settings& settings,
                     const sim::Simulation& simulation)
    : LinkLines(device, scene, simulation, linkClasses(scene, settings.solver),
                sim::particleSlots(scene, settings).slot) {}

LinkLines::LinkLines(const vk::Device& device, const sim::Scene& scene, const sim::Simulation& simulation,
                     LinkClasses classes, std::span<const std::uint32_t> slots)
    : device_(device), classes_(std::move(classes)),
      count_(static_cast<std::uint32_t>(scene.distances.size())),
      links_(filledBuffer(device, "lines.links", lineLinks(scene, classes_, slots), 0)),
      indices_(device, {.name = "lines.indices",
                        .count = 2 * std::max(VkDeviceSize{count_}, VkDeviceSize{1}),
                        .stride = sizeof(std::uint32_t),
                        .usage = VK_BUFFER_USAGE_INDEX_BUFFER_BIT}),
      noWords_(device, {.name = "lines.no_words", .count = 1, .stride = sizeof(std::uint32_t)}),
      live_(device.kernels().get(device, shaders::liveLinks, {})), sets_(bindingSets(simulation)),
      ranges_(rangesOf(classes_, count_)) {}

vk::BindingSets LinkLines::bindingSets(const sim::Simulation& simulation) const {
    const vk::BufferView alive = sim::inspect(simulation).liveLinks;
    const std::array requests{vk::BindingRequest{live_.get(),
                                                 {links_.view(), alive.size > 0 ? alive : noWords_.view(),
                                                  indices_.view(), removedParticles(simulation)}}};
    return {device_, requests};
}

LinkFacts LinkLines::facts() const {
    LinkFacts facts{.fixed = count_ - classes_.order.size(), .note = classes_.note};
    std::uint32_t first = 0;
    for (const std::uint32_t end : classes_.ends) facts.classes.push_back(end - std::exchange(first, end));
    return facts;
}

LayerReading LinkLines::reading(std::uint32_t) const {
    return {.legend = linkLegend(facts())};
}

void LinkLines::draw(const LayerDrawing& to) const noexcept {
    const vk::DeviceFunctions& functions = device_.functions();
    const vk::BufferView positions = to.simulation.positions(), indices = indices_.view();
    functions.vkCmdBindVertexBuffers(to.commands, 0, 1, &positions.buffer, &positions.offset);
    functions.vkCmdBindIndexBuffer(to.commands, indices.buffer, indices.offset, VK_INDEX_TYPE_UINT32);
    for (const Range& range : ranges_) {
        to.push({{range.color[0], range.color[1], range.color[2], 0}, {}, {}});
        functions.vkCmdDrawIndexed(to.commands, range.indexCount, 1, range.firstIndex, 0, 0);
    }
}

void LinkLines::record(VkCommandBuffer handle, std::size_t, std::uint32_t) const noexcept {
    if (count_ == 0) return;
    const layout::ValuesPush push{count_, 0};
    vk::Commands commands(device_, handle);
    commands.beginLabel("links");
    commands.beginStep();
    commands.bind(*live_, sets_[0]);
    commands.push(*live_, &push, sizeof push);
    commands.dispatch((count_ + GROUP_ITEMS - 1) / GROUP_ITEMS);
    commands.endStep();
    commands.endLabel();
}

} // namespace sinew::viewer
