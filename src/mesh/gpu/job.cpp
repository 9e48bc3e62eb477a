// The walk from passes to commands; sim/program plans the barriers.
#include "mesh/gpu/job.hpp"

#include "sinew/vk/check.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace sinew::mesh::gpu {

namespace {

constexpr std::uint32_t reversedId = 0; // constant_id of isReversed in kernel.glsl

} // namespace

const vk::Kernel& Kernels::operator[](const vk::ShaderCode& code) {
    const auto found = kernels_.find(&code);
    if (found != kernels_.end()) return found->second;
    const vk::SpecialisationConstant reversed{reversedId, isReversed_ ? 1u : 0u};
    return kernels_.emplace(&code, vk::Kernel(device_, code, std::span(&reversed, 1))).first->second;
}

Job::BufferId Job::add(const std::string& label, std::uint64_t count, std::uint32_t stride) {
    buffers_.emplace_back(device_,
                          vk::BufferRequest{.name = "voxels." + label, .count = count, .stride = stride});
    return {static_cast<std::uint32_t>(buffers_.size() - 1)};
}

std::uint64_t Job::bytes() const {
    std::uint64_t bytes = 0;
    for (const vk::Buffer& buffer : buffers_) bytes += buffer.view().size;
    return bytes;
}

void Job::fill(BufferId buffer, std::uint32_t value) {
    passes_.push_back({.kind = sim::PassKind::fill,
                       .label = "fill",
                       .uses = {{buffer, vk::Access::write}},
                       .value = value});
}

std::uint64_t Job::mostItems(const vk::ShaderCode& code) {
    constexpr std::uint32_t everyDevice = 65535; // groups: more would overflow 32 bits of items on some
    return std::uint64_t{std::min(device_.limits().maxGroupCount, everyDevice)} *
           kernels_[code].interface().groupSize[0];
}

void Job::dispatchBytes(const vk::ShaderCode& code, std::uint32_t items,
                        std::initializer_list<BufferId> buffers, std::span<const std::byte> push) {
    const vk::Kernel& kernel = kernels_[code];
    if (kernel.interface().pushConstantSize != push.size() ||
        kernel.interface().bindings.size() != buffers.size())
        throw std::logic_error(std::string("kernel ") + code.name + ": buffers or push constants differ");
    sim::Pass pass{.label = code.name, .items = items, .push = {push.begin(), push.end()}};
    vk::BindingRequest request{.kernel = &kernel};
    for (const BufferId buffer : buffers) {
        pass.uses.push_back({buffer, kernel.interface().bindings[pass.uses.size()].access});
        request.buffers.push_back(view(buffer));
    }
    passes_.push_back(std::move(pass));
    requests_.push_back(std::move(request));
}

void Job::record(vk::Commands& commands, const vk::BindingSets* sets) const {
    std::size_t next = 0;
    commands.beginStep();
    for (const sim::Pass& pass : passes_) {
        if (hasBarrier({}, pass)) commands.barrier(pass.scopes[sim::Recording{}.index()]);
        if (pass.kind == sim::PassKind::fill) {
            commands.fill(view(pass.uses[0].buffer), pass.value);
            continue;
        }
        const vk::Kernel& kernel = *requests_[next].kernel;
        commands.bind(kernel, (*sets)[next++]);
        commands.push(kernel, pass.push.data(), static_cast<std::uint32_t>(pass.push.size()));
        commands.dispatch((pass.items - 1) / kernel.interface().groupSize[0] + 1);
    }
    commands.endStep();
}

void Job::run() {
    sim::planBarriers(passes_, buffers_.size());
    std::optional<vk::BindingSets> sets;
    if (!requests_.empty()) sets.emplace(device_, requests_);
    const VkCommandBuffer handle = queue_.begin();
    vk::Commands commands(device_, handle);
    record(commands, sets ? &*sets : nullptr);
    queue_.wait(queue_.submit(handle));
    passes_.clear();
    requests_.clear();
}

} // namespace sinew::mesh::gpu
