// Tables are made on the host, once; kernels run for every picture.
#include "viewer/layers/value_maps.hpp"

#include "common/layout.h"
#include "sim/lattice/link_bits.hpp"
#include "sinew/inspection.hpp"
#include "sinew/inverse_masses.hpp"
#include "viewer/render/mesh_buffer.hpp"
#include "viewer_shaders.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

namespace sinew::viewer {

namespace {

// Sets of cuts and sheets follow these.
enum SetIndex : std::size_t { strainSet, speedSet, sleepSet, skinSet, firstOther };

template <typename T> std::vector<T> atLeastOne(std::vector<T> elements) {
    if (elements.empty()) elements.emplace_back();
    return elements;
}

template <typename T>
vk::Buffer tableOf(const vk::Device& device, const std::string& name, std::vector<T> elements) {
    return filledBuffer(device, name, atLeastOne(std::move(elements)), 0);
}

vk::Buffer valuesFor(const vk::Device& device, const std::string& name, VkDeviceSize count) {
    return vk::Buffer(
        device,
        {.name = name, .count = count, .stride = sizeof(float), .usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT});
}

std::uint32_t elements(const vk::BufferView& view) {
    return view.stride == 0 ? 0 : static_cast<std::uint32_t>(view.size / view.stride);
}

} // namespace

std::vector<std::uint32_t> particlesBySlot(const sim::ParticleSlots& slots) {
    std::vector<std::uint32_t> particles(slots.count, NO_PARTICLE);
    for (std::size_t i = 0; i < slots.slot.size(); ++i)
        particles[slots.slot[i]] = static_cast<std::uint32_t>(i);
    return particles;
}

LinkTable linkTable(const sim::Scene& scene, std::span<const std::uint32_t> slots) {
    LinkTable table;
    table.linksOf.resize(scene.particles.size());
    std::vector<sim::lattice::LinkBits> links;
    for (std::size_t d = 0; d < scene.distances.size(); ++d) {
        const sim::DistanceConstraint& constraint = scene.distances[d];
        links.push_back(sim::lattice::linkBits(scene, d));
        if (!links.back().isCounted) continue;
        ++table.linksOf[constraint.a].count;
        ++table.linksOf[constraint.b].count;
    }
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < table.linksOf.size(); ++i) {
        table.linksOf[i].first = first;
        first += std::exchange(table.linksOf[i].count, 0);
    }
    table.links.resize(first);
    const auto add = [&](std::uint32_t particle, const layout::ValueLink& link) {
        layout::ValueLinks& own = table.linksOf[particle];
        table.links[own.first + own.count++] = link;
        if (link.bit != 0) own.slot = slots[particle];
    };
    for (std::size_t d = 0; d < links.size(); ++d) {
        if (!links[d].isCounted) continue;
        const sim::DistanceConstraint& constraint = scene.distances[d];
        add(constraint.a, {constraint.b, constraint.restLength, links[d].ofA});
        add(constraint.b, {constraint.a, constraint.restLength, links[d].ofB});
    }
    return table;
}

std::vector<layout::ValueHolders> skinHolders(const sim::Scene& scene) {
    std::vector<layout::ValueHolders> all;
    for (const sim::Skin& skin : scene.skins) {
        for (const std::uint32_t particle : skin.particles)
            all.push_back({.low = {1, 0, 0, 0},
                           .high = {},
                           .particles = {particle, particle, particle, particle, particle, particle, particle,
                                         particle}});
        for (const sim::CellEmbedding& cell : skin.cells) {
            std::array<float, 8> shares{};
            layout::ValueHolders held{};
            for (std::size_t k = 0; k < 8; ++k) {
                shares[k] = cell.share(k);
                held.particles[k] = cell.particles[k];
            }
            held.low = {shares[0], shares[1], shares[2], shares[3]};
            held.high = {shares[4], shares[5], shares[6], shares[7]};
            all.push_back(held);
        }
    }
    return all;
}

MapReading readingOf(const layout::ValueSpread& spread) {
    std::uint64_t all = 0, beyond = 0;
    for (const std::uint32_t count : spread.counts) all += count;
    if (all == 0) return {};
    std::size_t bin = VALUE_BINS - 1;
    while (bin > 0 && 100 * (beyond + spread.counts[bin]) <= all) beyond += spread.counts[bin--];
    constexpr std::array<double, 3> digits{1, 2, 5};
    const double range = digits[bin % 3] * std::pow(10.0, static_cast<double>(bin / 3) - 7);
    return {.range = static_cast<float>(range),
            .largest = std::bit_cast<float>(spread.largest),
            .beyond = static_cast<float>(static_cast<double>(beyond) / static_cast<double>(all))};
}

struct ValueMaps::Tables {
    std::vector<std::uint32_t> particlesBySlot;
    LinkTable links;
    std::vector<layout::ValueHolders> holders;
    std::vector<float> inverseMasses;

    Tables(const sim::Scene& scene, const sim::ParticleSlots& slots)
        : particlesBySlot(viewer::particlesBySlot(slots)), links(linkTable(scene, slots.slot)),
          holders(skinHolders(scene)), inverseMasses(sim::inverseMasses(scene)) {}
};

namespace {

// The skins of sheets that can be cut.
template <typename Sheet> std::vector<Sheet> sheetsOf(const sim::Simulation& simulation) {
    std::vector<Sheet> sheets;
    for (const sim::InspectedSheet& sheet : sim::inspect(simulation).sheets)
        sheets.push_back({sheet.first, elements(sheet.vertices)});
    return sheets;
}

constexpr std::array<Layer::Look, 3> looks{// in the order of ColorMap
                                           {{"strain", "Strain"}, {"speed", "Speed"}, {"sleep", "Sleep"}}};

} // namespace

constinit const Layer layer::colors{.key = 'M',
                                    .help = "colors: of bodies, strain, speed, sleep",
                                    .button = "Colors",
                                    .looks = looks,
                                    .make = [](const LayerContext& of) -> std::unique_ptr<const LayerPart> {
                                        return std::make_unique<const ValueMaps>(
                                            of.device, of.scene, of.settings, of.simulation, of.slots);
                                    },
                                    .hasRange = true};

ValueMaps::ValueMaps(const vk::Device& device, const sim::Scene& scene, const sim::Settings& settings,
                     const sim::Simulation& simulation, std::uint32_t slots)
    : ValueMaps(device, Tables(scene, sim::particleSlots(scene, settings)), simulation, slots) {}

ValueMaps::ValueMaps(const vk::Device& device, const Tables& tables, const sim::Simulation& simulation,
                     std::uint32_t slots)
    : device_(device), particleCount_(sim::inspect(simulation).particles),
      heldVertices_(static_cast<std::uint32_t>(tables.holders.size())),
      cutVertices_(elements(simulation.cutSurface().rest)), hasSpeeds_(simulation.velocities().size > 0),
      linksOf_(tableOf(device, "values.links_of", tables.links.linksOf)),
      links_(tableOf(device, "values.links", tables.links.links)),
      holders_(tableOf(device, "values.holders", tables.holders)),
      particleOfSlot_(tableOf(device, "values.particle_of_slot", tables.particlesBySlot)),
      inverseMasses_(tableOf(device, "values.inverse_masses", tables.inverseMasses)),
      noLinks_(tableOf(device, "values.no_links", std::vector<std::uint32_t>{})),
      values_(valuesFor(device, "values.particles", particleCount_)),
      skinValues_(valuesFor(device, "values.skins", elements(simulation.skinVertices()))),
      cutValues_(valuesFor(device, "values.cuts", cutVertices_)),
      spread_(device, {.name = "values.spread", .count = 1, .stride = sizeof(layout::ValueSpread)}),
      spreads_(device, {.name = "values.spreads",
                        .count = slots,
                        .stride = sizeof(layout::ValueSpread),
                        .kind = vk::MemoryKind::readback}),
      strain_(device.kernels().get(device, shaders::strainValues, {})),
      speed_(device.kernels().get(device, shaders::speedValues, {})),
      sleep_(device.kernels().get(device, shaders::sleepValues, {})),
      skin_(device.kernels().get(device, shaders::skinValues, {})),
      cut_(device.kernels().get(device, shaders::cutValues, {})),
      sheet_(device.kernels().get(device, shaders::sheetValues, {})), sheets_(sheetsOf<Sheet>(simulation)),
      sets_(bindingSets(simulation)) {}

vk::BindingSets ValueMaps::bindingSets(const sim::Simulation& simulation) const {
    const sim::InspectedBuffers inner = sim::inspect(simulation);
    const vk::BufferView& alive = inner.liveLinks;
    const vk::BufferView places = simulation.positions(), values = values_.view(), spread = spread_.view(),
                         removed = removedParticles(simulation);
    std::vector<vk::BindingRequest> requests{
        {strain_.get(),
         {places, linksOf_.view(), links_.view(), alive.size > 0 ? alive : noLinks_.view(), values, spread,
          removed}},
        {speed_.get(), {hasSpeeds_ ? simulation.velocities() : places, values, spread, removed}},
        {sleep_.get(), {places, inverseMasses_.view(), values, spread, removed}}};
    if (heldVertices_ > 0) requests.push_back({skin_.get(), {values, holders_.view(), skinValues_.view()}});
    if (cutVertices_ > 0)
        requests.push_back({cut_.get(),
                            {values, skinValues_.view(), simulation.cutSurface().rest, particleOfSlot_.view(),
                             cutValues_.view()}});
    for (const sim::InspectedSheet& sheet : inner.sheets)
        requests.push_back(
            {sheet_.get(), {values, sheet.vertices, particleOfSlot_.view(), skinValues_.view()}});
    return {device_, requests};
}

void ValueMaps::dispatch(vk::Commands& commands, const vk::Kernel& kernel, std::size_t set,
                         std::uint32_t items, std::uint32_t first) const noexcept {
    const layout::ValuesPush push{items, first};
    commands.bind(kernel, sets_[set]);
    commands.push(kernel, &push, sizeof push);
    commands.dispatch((items + GROUP_ITEMS - 1) / GROUP_ITEMS);
}

void ValueMaps::record(VkCommandBuffer handle, std::size_t look, std::uint32_t slot) const noexcept {
    const auto map = static_cast<ColorMap>(look + 1);
    constexpr auto none = std::bit_cast<std::uint32_t>(static_cast<float>(NO_VALUE));
    vk::Commands commands(device_, handle);
    commands.beginLabel("color map");
    commands.beginStep();
    commands.fill(spread_.view(), 0);
    commands.fill(skinValues_.view(), none); // vertices without a known holder
    if (map == ColorMap::speed && !hasSpeeds_) commands.fill(values_.view(), none);
    commands.barrier();
    if (map == ColorMap::strain) dispatch(commands, *strain_, strainSet, particleCount_);
    if (map == ColorMap::speed && hasSpeeds_) dispatch(commands, *speed_, speedSet, particleCount_);
    if (map == ColorMap::sleep) dispatch(commands, *sleep_, sleepSet, particleCount_);
    commands.barrier();
    vk::BufferView read = spreads_.view();
    read.offset += VkDeviceSize{slot} * read.stride;
    read.size = read.stride;
    commands.copy(spread_.view(), read);
    if (heldVertices_ > 0) dispatch(commands, *skin_, skinSet, heldVertices_);
    std::size_t set = firstOther + (cutVertices_ > 0 ? 1 : 0);
    for (const Sheet& sheet : sheets_) dispatch(commands, *sheet_, set++, sheet.count, sheet.first);
    commands.barrier();
    if (cutVertices_ > 0) dispatch(commands, *cut_, firstOther, cutVertices_);
    commands.endStep();
    commands.hostBarrier();
    commands.endLabel();
}

LayerReading ValueMaps::reading(std::uint32_t slot) const {
    layout::ValueSpread spread;
    std::memcpy(&spread, spreads_.mapped() + slot * sizeof spread, sizeof spread);
    return {.values = readingOf(spread)};
}

void ValueMaps::addTo(LayerBuffers& buffers, std::size_t look) const noexcept {
    buffers.particles = values_.view();
    if (heldVertices_ > 0) buffers.skins = skinValues_.view();
    if (cutVertices_ > 0) buffers.cuts = cutValues_.view();
    const bool isSleep = static_cast<ColorMap>(look + 1) == ColorMap::sleep;
    buffers.range = isSleep ? 1 : buffers.ranges[indexOf(layer::colors)];
}

} // namespace sinew::viewer
