// Collects passes, checks them against their SPIR-V, and plans the barriers between them.
#include "sim/program/program.hpp"

#include "common/layout.h"

#include <algorithm>
#include <stdexcept>

namespace sinew::sim {

namespace {

// constant_id of isReversed in kernel.glsl, usesTexels in fetched.glsl, runsOver in kernel.glsl
constexpr std::uint32_t reversedId = 0, usesTexelsId = USES_TEXELS_ID, runsOverId = RUNS_OVER_ID;

bool touches(vk::Access access, vk::Access part) {
    return (static_cast<unsigned>(access) & static_cast<unsigned>(part)) != 0;
}

[[noreturn]] void refuse(const vk::ShaderCode& code, const std::string& why) {
    throw std::logic_error(std::string("kernel ") + code.name + ": " + why);
}

const vk::KernelBinding& bindingOf(const vk::KernelInterface& interface, const BufferUse& use) {
    return *std::ranges::find(interface.bindings, use.binding, &vk::KernelBinding::binding);
}

// A compiler may assume that bindings are different buffers, unless both are decorated Aliased.
void checkAliases(const vk::ShaderCode& code, const vk::KernelInterface& interface, const Pass& pass,
                  const std::vector<BufferSpec>& buffers) {
    const auto& uses = pass.uses;
    for (std::size_t a = 0; a < uses.size(); ++a)
        for (std::size_t b = a + 1; b < uses.size(); ++b) {
            const vk::KernelBinding& first = bindingOf(interface, uses[a]);
            const vk::KernelBinding& second = bindingOf(interface, uses[b]);
            const bool isWritten =
                touches(uses[a].access, vk::Access::write) || touches(uses[b].access, vk::Access::write);
            if (uses[a].buffer == uses[b].buffer && isWritten && !(first.isAliased && second.isAliased))
                refuse(code, "buffer " + buffers[uses[a].buffer.index].label + " is bound as " + first.name +
                                 " and as " + second.name +
                                 ", and one of both writes it: decorate both Aliased");
        }
}

} // namespace

std::vector<BufferId> boundBuffers(const StepProgram& program, const Pass& pass) {
    const KernelUse& kernel = program.kernels[pass.kernel];
    const auto texels = kernel.constants.find(usesTexelsId);
    const bool usesTexels = texels != kernel.constants.end() && texels->second != 0;
    const auto used = [&](std::uint32_t binding) {
        const auto use = std::ranges::find(boundUses(pass), binding, &BufferUse::binding);
        return use == boundUses(pass).end() ? unbound : use->buffer;
    };
    std::vector<BufferId> buffers;
    for (const vk::KernelBinding& binding : kernel.interface.bindings)
        buffers.push_back(!binding.isTwin() ? used(binding.binding)
                          : usesTexels      ? used(binding.binding - vk::texelTwins)
                                            : unbound);
    return buffers;
}

namespace {

// Sets what the planned barriers order: the run of passes before each, and the run after it.
void planScopes(std::span<Pass> passes, Recording recording) {
    const std::size_t way = recording.index();
    vk::BarrierScope* scope = nullptr; // of the barrier before the present run
    bool hasTransfers = false;         // in the present run
    for (Pass& pass : passes) {
        if (!isIn(recording, pass)) continue;
        if (pass.barriers[way]) {
            scope = &pass.scopes[way];
            *scope = {hasTransfers, false, false};
            hasTransfers = false;
        }
        hasTransfers |= pass.kind != PassKind::dispatch;
        if (scope == nullptr) continue;
        scope->beforeTransfers |= pass.kind != PassKind::dispatch;
        scope->beforeArguments |= pass.isIndirect;
    }
}

} // namespace

void planBarriers(std::span<Pass> passes, std::size_t bufferCount, Recording recording) {
    std::vector<bool> isRead(bufferCount), isWritten(bufferCount);
    for (Pass& pass : passes) {
        bool& hasBarrier = pass.barriers[recording.index()];
        hasBarrier = false;
        if (!isIn(recording, pass)) continue;
        for (const BufferUse& use : pass.uses) {
            const bool writes = touches(use.access, vk::Access::write);
            hasBarrier |= isWritten[use.buffer.index] || (writes && isRead[use.buffer.index]);
        }
        if (hasBarrier) {
            isRead.assign(bufferCount, false);
            isWritten.assign(bufferCount, false);
        }
        for (const BufferUse& use : pass.uses) {
            if (touches(use.access, vk::Access::read)) isRead[use.buffer.index] = true;
            if (touches(use.access, vk::Access::write)) isWritten[use.buffer.index] = true;
        }
    }
    planScopes(passes, recording);
}

BufferId ProgramBuilder::add(BufferSpec spec) {
    program_.buffers.push_back(std::move(spec));
    return {static_cast<std::uint32_t>(program_.buffers.size() - 1)};
}

void ProgramBuilder::beginPhase(std::string name) {
    program_.phases.push_back(std::move(name));
}

const vk::KernelInterface& ProgramBuilder::interfaceOf(const vk::ShaderCode& code) {
    const auto [found, isNew] = interfaces_.try_emplace(&code);
    if (isNew) found->second = vk::readInterface(code);
    return found->second;
}

std::uint32_t ProgramBuilder::kernelIndex(const vk::ShaderCode& code, Constants constants) {
    const vk::KernelInterface& interface = interfaceOf(code);
    constants[reversedId] = isReversed_;
    if (interface.hasConstant(usesTexelsId)) constants[usesTexelsId] = usesTexels_;
    for (std::uint32_t k = 0; k < program_.kernels.size(); ++k) {
        if (program_.kernels[k].code == &code && program_.kernels[k].constants == constants) return k;
    }
    program_.kernels.push_back({&code, interface, std::move(constants)});
    return static_cast<std::uint32_t>(program_.kernels.size() - 1);
}

void ProgramBuilder::append(Pass pass) {
    if (program_.phases.empty()) throw std::logic_error("pass " + pass.label + " belongs to no phase");
    pass.phase = static_cast<std::uint32_t>(program_.phases.size() - 1);
    pass.substep = substep_;
    pass.when = when_;
    program_[list_].push_back(std::move(pass));
}

void ProgramBuilder::setSlots(std::vector<std::uint32_t> slots, std::uint32_t all) {
    if (slots.empty()) return;
    slots_ = {.items = static_cast<std::uint32_t>(slots.size()), .all = all};
    slotList_ = std::move(slots);
}

const Slots& ProgramBuilder::slots() {
    if (slots_.items > 0 && slots_.list == BufferId{}) slots_.list = upload("state.compact_slots", slotList_);
    return slots_;
}

void ProgramBuilder::dispatchDirect(const vk::ShaderCode& code, std::uint32_t items,
                                    std::span<const BufferId> buffers, std::span<const std::byte> push,
                                    const Constants& constants) {
    if (!indirection_ || list_ != List::step || when_ != When::always) {
        if (items != slots_.all || !interfaceOf(code).hasConstant(runsOverId))
            return dispatchBytes(code, items, buffers, push, constants);
        Constants overItems = constants;
        overItems[runsOverId] = RUNS_OVER_ITEMS;
        return dispatchListedBytes(code, slots_.items, buffers, slots().list, push, overItems);
    }
    const IndirectForm form = indirection_(interfaceOf(code), items);
    if (form.listed != BufferId{})
        dispatchListedBytes(code, form.items.most, buffers, form.listed, push, constants);
    else
        dispatchBytes(code, form.items.most, buffers, push, constants);
    makeLastIndirect(form.items);
}

void ProgramBuilder::dispatchListedBytes(const vk::ShaderCode& code, std::uint32_t items,
                                         std::span<const BufferId> buffers, BufferId listed,
                                         std::span<const std::byte> push, Constants constants) {
    std::vector<BufferId> all(buffers.begin(), buffers.end());
    all.push_back(listed);
    constants.try_emplace(runsOverId, RUNS_OVER_GROUPS);
    dispatchBytes(code, items, all, push, constants);
}

void ProgramBuilder::bind(const vk::ShaderCode& code, Pass& pass, std::span<const BufferId> buffers) {
    const KernelUse& kernel = program_.kernels[pass.kernel];
    const auto& bindings = kernel.interface.bindings;
    auto count =
        static_cast<std::size_t>(std::ranges::count_if(bindings, [](const auto& b) { return !b.isTwin(); }));
    // Kernels that may run over a list need none if they run over all.
    if (kernel.interface.hasConstant(runsOverId) && !kernel.constants.contains(runsOverId)) --count;
    if (buffers.size() != count)
        refuse(code, "takes " + std::to_string(count) + " buffers, got " + std::to_string(buffers.size()));
    for (std::size_t b = 0; b < buffers.size(); ++b) {
        if (buffers[b] == unbound) continue;
        if (buffers[b].index >= program_.buffers.size())
            refuse(code, "binding " + bindings[b].name + " got a buffer that does not exist");
        const BufferSpec& spec = program_.buffers[buffers[b].index];
        if (!bindings[b].takes(spec.stride))
            refuse(code, "binding " + bindings[b].name + " has stride " + std::to_string(bindings[b].stride) +
                             ", buffer " + spec.label + " has " +
                             std::to_string(spec.stride)); // 0: texels of 4, 8 or 16 n bytes
        pass.uses.push_back({buffers[b], bindings[b].access, bindings[b].binding});
    }
    checkAliases(code, kernel.interface, pass, program_.buffers);
}

void ProgramBuilder::dispatchBytes(const vk::ShaderCode& code, std::uint32_t items,
                                   std::span<const BufferId> buffers, std::span<const std::byte> push,
                                   const Constants& constants) {
    Pass pass{.kind = PassKind::dispatch,
              .label = code.name,
              .kernel = kernelIndex(code, constants),
              .items = items};
    const vk::KernelInterface& interface = program_.kernels[pass.kernel].interface;
    if (items == 0) refuse(code, "nothing to do: leave the pass out");
    if (interface.pushConstantSize != push.size()) {
        refuse(code, "takes " + std::to_string(interface.pushConstantSize) +
                         " bytes of push constants, got " + std::to_string(push.size()));
    }
    bind(code, pass, buffers);
    pass.push.assign(push.begin(), push.end());
    append(std::move(pass));
}

void ProgramBuilder::makeLastIndirect(const IndirectItems& items) {
    Pass& pass = last();
    const vk::ShaderCode& code = *program_.kernels[pass.kernel].code;
    const bool exists = items.arguments.index < program_.buffers.size();
    if (!exists) refuse(code, "its arguments are in a buffer that does not exist");
    BufferSpec& spec = program_.buffers[items.arguments.index];
    if (spec.stride != sizeof(layout::DispatchArguments))
        refuse(code, "its arguments are in buffer " + spec.label + " with stride " +
                         std::to_string(spec.stride) + ", must be " +
                         std::to_string(sizeof(layout::DispatchArguments)));
    if (items.element >= spec.count)
        refuse(code, "argument " + std::to_string(items.element) + " of buffer " + spec.label +
                         ", which has " + std::to_string(spec.count));
    for (const BufferUse& use : pass.uses)
        if (use.buffer == items.arguments && use.access != vk::Access::read)
            refuse(code, "writes its own arguments " + spec.label);
    pass.isIndirect = true;
    pass.isOfLists = items.isOfLists && isAfterFirstSubstep();
    pass.value = items.element;
    pass.uses.push_back({items.arguments, vk::Access::read});
}

void ProgramBuilder::numberLast(std::uint32_t index) {
    last().label.append("[").append(std::to_string(index)).append("]");
}

void ProgramBuilder::fill(BufferId buffer, std::uint32_t value) {
    append({.kind = PassKind::fill, .label = "fill", .uses = {{buffer, vk::Access::write}}, .value = value});
}

void ProgramBuilder::copy(BufferId from, BufferId to) {
    const BufferSpec &source = program_.buffers.at(from.index), &target = program_.buffers.at(to.index);
    const std::uint64_t bytes =
        source.count * source.stride; // also of the initial contents of another buffer
    if (bytes != target.bytes()) {
        throw std::logic_error("copy: " + source.label + " has " + std::to_string(bytes) + " bytes, " +
                               target.label + " has " + std::to_string(target.bytes()));
    }
    append({.kind = PassKind::copy,
            .label = "copy",
            .uses = {{from, vk::Access::read}, {to, vk::Access::write}}});
}

void ProgramBuilder::update(BufferId buffer, HostData data) {
    append({.kind = PassKind::update,
            .label = "update",
            .uses = {{buffer, vk::Access::write}},
            .value = static_cast<std::uint32_t>(data)});
}

StepProgram ProgramBuilder::finish() {
    for (const Recording recording : allRecordings)
        for (std::vector<Pass>& list : program_.lists) planBarriers(list, program_.buffers.size(), recording);
    return std::move(program_);
}

} // namespace sinew::sim
