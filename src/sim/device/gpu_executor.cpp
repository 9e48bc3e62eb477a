// The loop from a pass list to Vulkan commands. Dispatches with equal kernel and buffers share one descriptor
// set.
#include "sim/device/gpu_executor.hpp"

#include "sinew/vk/check.hpp"

#include <algorithm>
#include <cstring>

namespace sinew::sim {

namespace {

// The empty buffer: bytes for all bindings that kernels only read, as long as a uniform block may be, and
// then some for each descriptor set. Two sets never share bytes that one of them might write: validation
// would take that for a hazard.
constexpr std::uint32_t emptyRead = 16384, emptyWritten = 256;

vk::BufferView emptyView(const vk::Buffer& empty, vk::Access access, std::size_t set) {
    vk::BufferView view = empty.view();
    view.stride = vk::BufferView::anyStride;
    view.size = access == vk::Access::read ? emptyRead : emptyWritten;
    if (access != vk::Access::read) view.offset += emptyRead + set * emptyWritten;
    return view;
}

// By buffer: whether it holds the arguments of an indirect dispatch.
std::vector<bool> holdArguments(const StepProgram& program) {
    std::vector<bool> result(program.buffers.size());
    forEachPass(program, [&](const Pass& pass) {
        if (pass.isIndirect) result[pass.uses.back().buffer.index] = true;
    });
    return result;
}

// How a host draws with a buffer; 0 = it is no output.
VkBufferUsageFlags usageOf(const StepProgram& program, BufferId id) {
    const CutSurfaceBuffers& cut = program.cutSurface;
    VkBufferUsageFlags usage = 0;
    const auto add = [&](VkBufferUsageFlags flags, std::initializer_list<BufferId> buffers) {
        if (std::ranges::find(buffers, id) != buffers.end()) usage |= flags;
    };
    add(VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
        {program.skinVertices, program.positions, program.velocities, program.previousPositions,
         program.previousSkinVertices, program.cutting.pieces, program.textureCoordinates,
         program.wholeTextureCoordinates, cut.vertices, cut.rest, cut.textureCoordinates});
    add(VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, {cut.draws, program.pieceDraws});
    add(VK_BUFFER_USAGE_INDEX_BUFFER_BIT, {program.skinIndices, program.wholeIndices, cut.indices});
    add(VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
        {cut.state, cut.particles, program.cutting.pieceSizes, program.forces.sums});
    return usage;
}

std::vector<vk::Buffer> makeBuffers(const vk::Device& device, const StepProgram& program,
                                    const OutputUse& use) {
    const std::vector<bool> holdsArguments = holdArguments(program);
    std::vector<vk::Buffer> buffers;
    buffers.reserve(program.buffers.size());
    for (std::uint32_t b = 0; b < program.buffers.size(); ++b) {
        const BufferSpec& spec = program.buffers[b];
        VkBufferUsageFlags usage = usageOf(program, BufferId{b});
        const bool isOutput = usage != 0;
        if (isOutput) usage |= use.usage;
        if (holdsArguments[b]) usage |= VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
        buffers.emplace_back(
            device, vk::BufferRequest{.name = spec.label,
                                      .count = spec.initialOf ? 1 : spec.count,
                                      .stride = spec.stride,
                                      .kind = vk::MemoryKind::device,
                                      .usage = usage,
                                      .families = isOutput ? std::span<const std::uint32_t>(use.families)
                                                           : std::span<const std::uint32_t>()});
    }
    return buffers;
}

std::vector<std::pair<std::uint32_t, vk::Buffer>> makeStaging(const vk::Device& device,
                                                              const StepProgram& program) {
    std::vector<std::pair<std::uint32_t, vk::Buffer>> staging;
    for (std::uint32_t b = 0; b < program.buffers.size(); ++b) {
        const BufferSpec& spec = program.buffers[b];
        if (spec.initial.empty()) continue;
        vk::Buffer buffer(device, {.name = spec.label + ".initial",
                                   .count = spec.count,
                                   .stride = spec.stride,
                                   .kind = vk::MemoryKind::upload});
        std::copy(spec.initial.begin(), spec.initial.end(), buffer.mapped());
        buffer.flush();
        staging.emplace_back(b, std::move(buffer));
    }
    return staging;
}

std::vector<std::shared_ptr<const vk::Kernel>> makeKernels(const vk::Device& device,
                                                           const StepProgram& program) {
    std::vector<vk::KernelStore::Request> requests;
    for (const KernelUse& use : program.kernels) {
        vk::KernelStore::Request& request = requests.emplace_back(vk::KernelStore::Request{use.code, {}});
        for (const auto& [id, value] : use.constants) request.constants.push_back({id, value});
    }
    return device.kernels().getAll(device, requests);
}

bool isSameDispatch(const Pass& a, const Pass& b) {
    const auto isSameBuffer = [](const BufferUse& x, const BufferUse& y) {
        return x.buffer == y.buffer && x.binding == y.binding;
    };
    return a.kernel == b.kernel && std::ranges::equal(boundUses(a), boundUses(b), isSameBuffer);
}

// Distinct (kernel, buffers) pairs of all lists, and the pair of each dispatch.
struct SetPlan {
    std::vector<const Pass*> distinct;
    std::vector<std::size_t> setOfPass;
};

SetPlan planSets(const StepProgram& program) {
    SetPlan plan;
    forEachPass(program, [&](const Pass& pass) {
        if (pass.kind != PassKind::dispatch) return;
        const auto isSame = [&](const Pass* other) { return isSameDispatch(*other, pass); };
        const auto found = std::find_if(plan.distinct.begin(), plan.distinct.end(), isSame);
        plan.setOfPass.push_back(static_cast<std::size_t>(found - plan.distinct.begin()));
        if (found == plan.distinct.end()) plan.distinct.push_back(&pass);
    });
    return plan;
}

} // namespace

GpuExecutor::GpuExecutor(const vk::Device& device, const StepProgram& program, const OutputUse& use)
    : buffers_(makeBuffers(device, program, use)), staging_(makeStaging(device, program)),
      kernels_(makeKernels(device, program)) {
    for (std::uint32_t b = 0; b < program.buffers.size(); ++b)
        if (program.buffers[b].initialOf) initialOf_.emplace(b, *program.buffers[b].initialOf);
    const SetPlan plan = planSets(program);
    std::vector<vk::BindingRequest> requests;
    empty_.emplace(device, vk::BufferRequest{.name = "empty",
                                             .count = (emptyRead + plan.distinct.size() * emptyWritten) / 16,
                                             .stride = 16,
                                             .kind = vk::MemoryKind::device});
    for (const Pass* pass : plan.distinct) {
        const auto& bindings = program.kernels[pass->kernel].interface.bindings;
        const std::vector<BufferId> buffers = boundBuffers(program, *pass);
        vk::BindingRequest& request = requests.emplace_back();
        request.kernel = kernels_[pass->kernel].get();
        for (std::size_t b = 0; b < buffers.size(); ++b)
            request.buffers.push_back(buffers[b] == unbound
                                          ? emptyView(*empty_, bindings[b].access, requests.size() - 1)
                                          : view(buffers[b]));
    }
    if (!requests.empty()) sets_.emplace_back(device, requests);
    setOfPass_ = plan.setOfPass;
    std::size_t nextSet = 0;
    for (std::size_t list = 0; list < listCount; ++list) {
        lists_[list] = resolve(program.lists[list], nextSet);
        checkGroups(lists_[list], device.limits().maxGroupCount);
    }
    for (const Recorded& pass : lists_[static_cast<std::size_t>(List::step)]) {
        if (timedPhases_.empty() || timedPhases_.back() != pass.phase) timedPhases_.push_back(pass.phase);
    }
}

void requireGroups(const vk::Kernel& kernel, std::uint32_t groups, std::uint32_t most) {
    if (groups <= most) return;
    throw vk::Error(vk::Failure::outOfMemory, "dispatch of " + kernel.name() + ": " + std::to_string(groups) +
                                                  " groups, the device allows " + std::to_string(most));
}

void GpuExecutor::checkGroups(const std::vector<Recorded>& passes, std::uint32_t most) {
    for (const Recorded& pass : passes)
        if (pass.kernel != nullptr) requireGroups(*pass.kernel, pass.groups, most);
}

std::vector<GpuExecutor::Recorded> GpuExecutor::resolve(const std::vector<Pass>& passes,
                                                        std::size_t& nextSet) const {
    std::vector<Recorded> result;
    result.reserve(passes.size());
    for (const Pass& pass : passes) {
        Recorded recorded{.kind = pass.kind,
                          .isIn = {},
                          .hasBarrier = {},
                          .scopes = pass.scopes,
                          .when = pass.when,
                          .isIndirect = pass.isIndirect,
                          .phase = pass.phase,
                          .groups = 0,
                          .value = pass.value,
                          .kernel = nullptr,
                          .set = VK_NULL_HANDLE,
                          .push = &pass.push,
                          .first = view(pass.isIndirect ? pass.uses.back().buffer : pass.uses[0].buffer),
                          .second = pass.uses.size() > 1 ? view(pass.uses[1].buffer) : vk::BufferView{}};
        for (const Recording recording : allRecordings) {
            recorded.isIn[recording.index()] = isIn(recording, pass);
            recorded.hasBarrier[recording.index()] = sim::hasBarrier(recording, pass);
        }
        if (pass.kind == PassKind::dispatch) {
            recorded.kernel = kernels_[pass.kernel].get();
            recorded.set = sets_[0][setOfPass_[nextSet++]];
            const std::uint32_t groupSize = recorded.kernel->interface().groupSize[0];
            recorded.groups = (pass.items - 1) / groupSize + 1;
        }
        result.push_back(recorded);
    }
    return result;
}

void GpuExecutor::upload(vk::Commands& commands) noexcept {
    commands.beginStep();
    for (const auto& [index, initial] : staging_) commands.copy(initial.view(), buffers_[index].view());
    for (std::uint32_t b = 0; b < buffers_.size(); ++b)
        if (stagingOf({b}) == nullptr) commands.fill(buffers_[b].view(), 0);
    commands.endStep();
}

// Memory that is not coherent is left out: its atoms may hold parts of other buffers, which the device
// writes.
bool GpuExecutor::fill() noexcept {
    for (std::uint32_t b = 0; b < buffers_.size(); ++b) {
        const vk::Buffer& buffer = buffers_[b];
        const vk::BufferView whole = buffer.view();
        if (buffer.mapped() == nullptr || !buffer.isCoherent())
            unfilled_.emplace_back(b, whole);
        else if (const vk::Buffer* initial = stagingOf({b}))
            std::memcpy(buffer.mapped(), initial->mapped(), whole.size);
        else
            std::memset(buffer.mapped(), 0, whole.size);
    }
    return unfilled_.empty();
}

bool GpuExecutor::uploadRest(vk::Commands& commands, VkDeviceSize most) noexcept {
    while (!unfilled_.empty() && most > 0) {
        auto& [buffer, rest] = unfilled_.back();
        vk::BufferView part = rest;
        part.size = std::min(rest.size, most);
        if (const vk::Buffer* initial = stagingOf({buffer})) {
            vk::BufferView from = initial->view();
            from.offset += part.offset;
            from.size = part.size;
            commands.copy(from, part);
        } else {
            commands.fill(part, 0);
        }
        rest.offset += part.size;
        rest.size -= part.size;
        most -= part.size;
        if (rest.size == 0) unfilled_.pop_back();
    }
    return unfilled_.empty();
}

void GpuExecutor::step(vk::Commands& commands, std::span<const VkCommandBuffer> later, const HostBytes& host,
                       vk::Timestamps* timestamps, Recording recording) noexcept {
    record(commands, later, lists_[static_cast<std::size_t>(List::step)], host, timestamps, recording);
}

void GpuExecutor::record(vk::Commands& commands, List list) noexcept {
    record(commands, {}, lists_[static_cast<std::size_t>(list)], {}, nullptr);
}

const vk::Buffer* GpuExecutor::stagingOf(BufferId buffer) const noexcept {
    const auto found = std::ranges::find(staging_, buffer.index, &decltype(staging_)::value_type::first);
    return found == staging_.end() ? nullptr : &found->second;
}

void GpuExecutor::restore(vk::Commands& commands, BufferId buffer) noexcept {
    if (const vk::Buffer* initial = stagingOf(buffer)) commands.copy(initial->view(), view(buffer));
}

// The device writes the source of later resets; a reset already in flight still copies the old contents.
void GpuExecutor::replace(vk::Commands& commands, BufferId buffer, const vk::BufferView& contents,
                          bool isOfState) noexcept {
    if (const vk::Buffer* initial = stagingOf(buffer)) commands.copy(contents, initial->view());
    if (!isOfState) commands.copy(contents, view(buffer));
}

void GpuExecutor::surface(vk::Commands& commands) noexcept {
    for (const Recorded& pass : lists_[static_cast<std::size_t>(List::step)]) {
        if (pass.when != When::surface) continue;
        commands.barrier(); // it is rare, and no barriers are planned for these passes alone
        recordPass(commands, pass, {});
    }
}

void GpuExecutor::record(vk::Commands& commands, std::span<const VkCommandBuffer> later,
                         const std::vector<Recorded>& passes, const HostBytes& host,
                         vk::Timestamps* timestamps, Recording recording) noexcept {
    const std::size_t way = recording.index(), parts = later.size() + 1;
    std::uint32_t span = 0;
    std::size_t part = 0;
    for (std::size_t p = 0; p < passes.size(); ++p) {
        const bool opensPart = passes[p].hasBarrier[way] && p * parts >= (part + 1) * passes.size();
        if (opensPart && part < later.size()) commands.continueIn(later[part++]);
        const bool opensPhase = p == 0 || passes[p - 1].phase != passes[p].phase;
        const bool closesPhase = p + 1 == passes.size() || passes[p + 1].phase != passes[p].phase;
        if (timestamps && opensPhase) timestamps->begin(commands, span);
        if (passes[p].isIn[way]) {
            if (passes[p].hasBarrier[way]) commands.barrier(passes[p].scopes[way]);
            recordPass(commands, passes[p], host);
        }
        if (timestamps && closesPhase) timestamps->end(commands, span++);
    }
    if (part < later.size()) commands.continueIn(later.back()); // those between have nothing to do
}

void GpuExecutor::recordPass(vk::Commands& commands, const Recorded& pass, const HostBytes& host) noexcept {
    switch (pass.kind) {
    case PassKind::dispatch:
        commands.bind(*pass.kernel, pass.set);
        commands.push(*pass.kernel, pass.push->data(), static_cast<std::uint32_t>(pass.push->size()));
        if (pass.isIndirect)
            commands.dispatchIndirect(pass.first, pass.value);
        else
            commands.dispatch(pass.groups);
        break;
    case PassKind::fill:
        commands.fill(pass.first, pass.value);
        break;
    case PassKind::copy:
        commands.copy(pass.first, pass.second);
        break;
    case PassKind::update:
        commands.update(pass.first, host[pass.value].data(), host[pass.value].size());
        break;
    }
}

vk::BufferView GpuExecutor::view(BufferId buffer) const noexcept {
    if (buffer == BufferId{} || buffer == unbound) return {};
    const auto found = initialOf_.find(buffer.index);
    return found == initialOf_.end() ? buffers_[buffer.index].view() : stagingOf({found->second})->view();
}

const std::byte* GpuExecutor::mapped(const vk::BufferView& view) const noexcept {
    const auto found = std::ranges::find_if(
        buffers_, [&](const vk::Buffer& buffer) { return buffer.view().buffer == view.buffer; });
    const bool isReadable = found != buffers_.end() && found->mapped() != nullptr && found->isCoherent();
    return isReadable ? found->mapped() + view.offset : nullptr;
}

} // namespace sinew::sim
