// Comparison of two programs, list by list.
#include "sim/program/program_values.hpp"

#include <algorithm>
#include <stdexcept>

namespace sinew::sim {

namespace {

bool isSameKernel(const KernelUse& a, const KernelUse& b) {
    return a.code == b.code && a.constants == b.constants;
}

bool isSameBuffer(const BufferSpec& a, const BufferSpec& b) {
    return a.label == b.label && a.count == b.count && a.stride == b.stride &&
           a.initial.empty() == b.initial.empty();
}

// Whether two passes are equal except for their push constants.
bool isSamePass(const Pass& a, const Pass& b) {
    const auto isSameUse = [](const BufferUse& x, const BufferUse& y) {
        return x.buffer == y.buffer && x.access == y.access && x.binding == y.binding;
    };
    return a.kind == b.kind && a.kernel == b.kernel && a.items == b.items && a.value == b.value &&
           a.isIndirect == b.isIndirect && a.when == b.when && a.isOfLists == b.isOfLists &&
           a.phase == b.phase && a.push.size() == b.push.size() &&
           std::ranges::equal(a.uses, b.uses, isSameUse);
}

bool haveOneShape(const StepProgram& a, const StepProgram& b) {
    return a.particleCount == b.particleCount && a.phases == b.phases &&
           std::ranges::equal(a.kernels, b.kernels, isSameKernel) &&
           std::ranges::equal(a.buffers, b.buffers, isSameBuffer) &&
           std::ranges::equal(a.lists, b.lists, [&](const auto& list, const auto& other) {
               return std::ranges::equal(list, other, isSamePass);
           });
}

std::vector<ProgramValues::Push> pushesOf(const StepProgram& from, const StepProgram& to) {
    std::vector<ProgramValues::Push> pushes;
    for (std::size_t list = 0; list < listCount; ++list)
        for (std::size_t p = 0; p < from.lists[list].size(); ++p)
            if (const std::vector<std::byte>& push = to.lists[list][p].push; from.lists[list][p].push != push)
                pushes.push_back({static_cast<List>(list), p, push});
    return pushes;
}

void markWritten(const Pass& pass, std::vector<bool>& isWritten) {
    for (const BufferUse& use : pass.uses)
        if (use.access != vk::Access::read) isWritten[use.buffer.index] = true;
}

} // namespace

std::vector<bool> areWritten(const StepProgram& program) {
    std::vector<bool> isWritten(program.buffers.size());
    forEachPass(program, [&](const Pass& pass) { markWritten(pass, isWritten); });
    return isWritten;
}

std::optional<ProgramValues> valuesOf(const StepProgram& from, const StepProgram& to) {
    if (!haveOneShape(from, to)) return std::nullopt;
    const std::vector<bool> isWritten = areWritten(from);
    std::vector<bool> isRefreshed(from.buffers.size());
    for (const Pass& pass : from[List::refresh]) markWritten(pass, isRefreshed);
    ProgramValues values{.buffers = {}, .pushes = pushesOf(from, to)};
    for (std::uint32_t b = 0; b < from.buffers.size(); ++b) {
        if (from.buffers[b].initial == to.buffers[b].initial) continue;
        if (isWritten[b] && !isRefreshed[b]) return std::nullopt;
        values.buffers.push_back({{b}, to.buffers[b].initial, isWritten[b]});
    }
    return values;
}

void take(StepProgram& program, ProgramValues values) noexcept {
    for (ProgramValues::Contents& contents : values.buffers)
        program.buffers[contents.buffer.index].initial = std::move(contents.initial);
    for (ProgramValues::Push& push : values.pushes)
        program[push.list][push.pass].push = std::move(push.bytes);
}

void requireSameParticles(const StepProgram& from, const StepProgram& to) {
    const auto isSame = [&](BufferId a, BufferId b) {
        return a == b && (a == BufferId{} || from.buffers[a.index].initial == to.buffers[b.index].initial);
    };
    if (!isSame(from.positions, to.positions) || !isSame(from.velocities, to.velocities))
        throw std::invalid_argument("particles: a change of material must have those of the simulation, "
                                    "with the same positions and masses");
}

std::vector<BufferId> writtenByStep(const StepProgram& program) {
    std::vector<bool> isWritten(program.buffers.size());
    for (const Pass& pass : program[List::step]) markWritten(pass, isWritten);
    std::vector<BufferId> buffers;
    for (const BufferId buffer : program.ofStep) isWritten[buffer.index] = false;
    for (std::uint32_t b = 0; b < isWritten.size(); ++b)
        if (isWritten[b]) buffers.push_back({b});
    return buffers;
}

} // namespace sinew::sim
