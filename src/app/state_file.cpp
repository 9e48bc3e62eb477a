// A line of text, numbers as this machine has them, and a hash over both.
#include "app/state_file.hpp"

#include "app/guard.hpp"
#include "mesh/export.hpp"
#include "sim/core/hash.hpp"
#include "sim/device/gpu_compile.hpp"
#include "sinew/ranges.hpp"
#include "sinew/vk/commands.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <ostream>
#include <type_traits>

namespace sinew::app {

namespace {

static_assert(std::endian::native == std::endian::little, "state files are little endian");

// By version, from `firstVersion` on: each appends to the one before a view, levels, the substep of clamps,
// and the clamp.
constexpr std::string_view titles[] = {"sinew state 2\n", "sinew state 3\n", "sinew state 4\n",
                                       "sinew state 5\n", "sinew state 6\n"};
constexpr std::size_t firstVersion = 2, withView = 3, withLevels = 4, withClamps = 5, withSharpness = 6;
static_assert(withSharpness == firstVersion + std::size(titles) - 1);

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
    throw Failure(badInput, "cannot read a state: " + file.string() + ": " + why);
}

class Writer {
public:
    template <typename Value> void operator()(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        add(std::as_bytes(std::span(&value, 1)));
    }
    void operator()(const std::string& text) { list(text); }
    template <typename Value> void operator()(const std::vector<Value>& values) { list(values); }
    std::vector<std::byte> take() { return std::move(bytes_); }

private:
    template <typename List> void list(const List& values) {
        (*this)(std::uint64_t{values.size()});
        add(std::as_bytes(std::span(values)));
    }
    void add(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }

    std::vector<std::byte> bytes_;
};

class Reader {
public:
    explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
    template <typename Value> void operator()(Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        const auto from = take(sizeof(value));
        if (isWhole_) std::memcpy(&value, from.data(), sizeof(value));
    }
    void operator()(std::string& text) { list(text); }
    template <typename Value> void operator()(std::vector<Value>& values) { list(values); }
    /// Everything was there, and nothing more.
    bool isWhole() const { return isWhole_ && bytes_.empty(); }

private:
    template <typename List> void list(List& values) {
        std::uint64_t size = 0;
        (*this)(size);
        constexpr std::size_t each = sizeof(values[0]);
        const auto from = take(size <= bytes_.size() / each ? size * each : bytes_.size() + 1);
        if (!isWhole_) return;
        values.resize(size);
        if (size > 0) std::memcpy(values.data(), from.data(), from.size());
    }
    std::span<const std::byte> take(std::uint64_t size) {
        isWhole_ = isWhole_ && size <= bytes_.size();
        if (!isWhole_) return {};
        const auto taken = bytes_.first(size);
        bytes_ = bytes_.subspan(size);
        return taken;
    }

    std::span<const std::byte> bytes_;
    bool isWhole_ = true;
};

// The same order both ways. Grabs and colliders of tools are not saved.
template <typename Run, typename Visit> void visit(Run& run, Visit& each) {
    each(run.scene);
    each(run.settings.solver);
    each(run.settings.substeps);
    each(run.settings.contactRoom);
    each(run.settings.cutSurfaceRoom);
    each(run.settings.forms.usesTexels);
    each(run.settings.forms.usesGrids);
    each(run.settings.forms.columns);
    each(run.settings.forms.chunk);
    each(run.settings.forms.residentBytes);
    each(run.key);
    each(run.played);
    each(run.material.stiffness);
    each(run.material.bodies);
    each(run.material.damping);
    each(run.material.friction);
    each(run.gravity);
    each(run.host.h);
    each(run.host.colliderTime);
    each(run.host.anchors);
    each(run.host.hasNewTopology);
    each(run.host.isUncut);
    each(run.bytes);
}

// After the rest, since there was none in files of version 2.
template <typename View, typename Visit> void visitView(View& view, Visit& each) {
    each(view.target);
    each(view.distance);
    each(view.azimuth);
    each(view.elevation);
    each(view.fieldOfView);
}

bool isView(const SavedView& view) {
    const auto isFinite = [](std::initializer_list<float> numbers) {
        return std::ranges::all_of(numbers, [](float one) { return std::isfinite(one); });
    };
    constexpr float half = 3.14f; // of a turn [rad]
    return isFinite(
               {view.target.x, view.target.y, view.target.z, view.distance, view.azimuth, view.elevation}) &&
           view.distance > 0 && view.fieldOfView > 0 && view.fieldOfView < half;
}

vk::Buffer bufferFor(const vk::Device& device, std::uint64_t size, vk::MemoryKind kind) {
    return {device, {.name = "state", .count = size / 4, .stride = 4, .kind = kind}};
}

void readView(SavedRun& run, Reader& reader) {
    std::uint32_t hasView = 0;
    reader(hasView);
    if (hasView != 0) visitView(run.view.emplace(), reader);
}

} // namespace

SavedRun saveRun(const vk::Device& device, const sim::Simulation& simulation, const sim::Settings& settings,
                 vk::Queue& queue) {
    queue.waitIdle();
    const vk::Buffer copy = bufferFor(device, simulation.stateSize(), vk::MemoryKind::readback);
    const VkCommandBuffer commands = queue.begin();
    SavedRun run{.settings = settings, .key = simulation.stateKey(), .hasSharpClamp = settings.hasSharpClamp};
    run.settings.forms = sim::completed(run.settings.forms, sim::kindOf(device)); // on other kinds as well
    run.host = simulation.recordSaveState(commands, copy.view());
    run.host.hostColliders.clear();
    vk::Commands(device, commands).hostBarrier();
    queue.wait(queue.submit(commands));
    const auto* bytes = static_cast<const std::byte*>(copy.mapped());
    run.bytes.assign(bytes, bytes + simulation.stateSize());
    return run;
}

void loadRun(const vk::Device& device, sim::Simulation& simulation, const SavedRun& run, vk::Queue& queue) {
    if (simulation.stateKey() != run.key || simulation.stateSize() != run.bytes.size())
        throw Failure(badInput, "cannot resume from a state: it is of another simulation than " + run.scene +
                                    " makes now: has the scene, the version or the device changed?");
    queue.waitIdle();
    const vk::Buffer copy = bufferFor(device, run.bytes.size(), vk::MemoryKind::upload);
    std::memcpy(copy.mapped(), run.bytes.data(), run.bytes.size());
    const VkCommandBuffer commands = queue.begin();
    simulation.recordReset(commands);
    simulation.recordLoadState(commands, copy.view(), run.host);
    queue.wait(queue.submit(commands));
}

sim::Settings withRun(sim::Settings settings, const SavedRun& run) {
    settings.contactRoom = run.settings.contactRoom;
    settings.cutSurfaceRoom = run.settings.cutSurfaceRoom;
    settings.forms = run.settings.forms;
    return settings;
}

void addRoomForUser(sim::Settings& settings) {
    settings.grabs = sim::ranges::mostGrabs;
    settings.hostColliders = 1;
}

void writeRun(const std::filesystem::path& file, const SavedRun& run) {
    Writer writer;
    visit(run, writer);
    writer(std::uint32_t{run.view.has_value()});
    if (run.view) visitView(*run.view, writer);
    writer(run.settings.levels);
    writer(run.host.longestH);
    writer(std::uint32_t{*run.hasSharpClamp});
    const std::vector<std::byte> bytes = writer.take();
    const std::uint64_t hash = sim::fnv1a(bytes);
    mesh::writeWhole(file, [&](std::ostream& stream) {
        stream << titles[withSharpness - firstVersion];
        stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        stream.write(reinterpret_cast<const char*>(&hash), sizeof(hash));
    });
}

SavedRun readRun(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) refuse(file, "there is no such file");
    if (!std::filesystem::is_regular_file(file, error)) refuse(file, "it is not a file");
    std::ifstream stream(file, std::ios::binary);
    std::string head(titles[0].size(), ' '); // other files, which may be large, are not read
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    const auto title = std::ranges::find(titles, head);
    if (title == std::end(titles)) refuse(file, "it does not begin like a state of this version");
    const std::size_t version = firstVersion + static_cast<std::size_t>(title - std::begin(titles));
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    std::span<const std::byte> bytes = std::as_bytes(std::span(text));
    std::uint64_t hash = 0;
    if (bytes.size() < sizeof(hash)) refuse(file, "it is cut short");
    const auto end = bytes.last(sizeof(hash));
    bytes = bytes.first(bytes.size() - sizeof(hash));
    std::memcpy(&hash, end.data(), sizeof(hash));
    if (sim::fnv1a(bytes) != hash) refuse(file, "it is cut short, or was changed");
    SavedRun run;
    Reader reader(bytes);
    visit(run, reader);
    if (version >= withView) readView(run, reader);
    if (version >= withLevels) reader(run.settings.levels);
    if (version >= withClamps) reader(run.host.longestH);
    if (version >= withSharpness) {
        std::uint32_t isSharp = 0;
        reader(isSharp);
        run.hasSharpClamp = isSharp != 0;
    }
    if (!reader.isWhole() || (run.view && !isView(*run.view)) ||
        run.settings.solver > sim::Solver::gaussSeidel)
        refuse(file, "its contents do not match its version");
    run.fileHash = hash;
    return run;
}

bool isRunFile(const std::filesystem::path& file) {
    return file.extension() == ".state";
}

} // namespace sinew::app
