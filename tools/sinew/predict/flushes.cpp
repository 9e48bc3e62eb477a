// Rules read from Mesa: radv_stage_flush, radv_src_access_flush and radv_dst_access_flush in
// src/amd/vulkan/radv_cmd_buffer.c; anv_pipe_flush_bits_for_access_flags and
// anv_pipe_invalidate_bits_for_access_flags in src/intel/vulkan/anv_private.h.
#include "sinew/predict/flushes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

namespace sinew::tools {

namespace {

bool isAlways(const vk::BarrierScope&) {
    return true;
}
bool isAfterTransfers(const vk::BarrierScope& scope) {
    return scope.afterTransfers;
}
bool isBeforeArguments(const vk::BarrierScope& scope) {
    return scope.beforeArguments;
}

// Stages: compute and transfer wait for compute shaders, transfer for draws too. Writes of shaders write L2
// back, those of transfers flush the render caches and their metadata. Reads of shaders and uniforms.
constexpr std::array radv{Flush{"wait for compute shaders", isAlways},
                          Flush{"write L2 back", isAlways},
                          Flush{"invalidate L2", isAlways},
                          Flush{"invalidate the vector cache", isAlways},
                          Flush{"invalidate the scalar cache", isAlways},
                          Flush{"wait for draws", isAfterTransfers},
                          Flush{"flush the color cache", isAfterTransfers},
                          Flush{"flush the depth cache", isAfterTransfers},
                          Flush{"flush metadata of color", isAfterTransfers},
                          Flush{"flush metadata of depth", isAfterTransfers}};

constexpr std::array anv{Flush{"flush the data port", isAlways},
                         Flush{"flush the untyped data port", isAlways},
                         Flush{"invalidate the constant cache", isAlways},
                         Flush{"invalidate the texture cache", isAlways},
                         Flush{"flush the render target cache", isAfterTransfers},
                         Flush{"flush the depth cache", isAfterTransfers},
                         Flush{"stall the command streamer", isBeforeArguments},
                         Flush{"invalidate the vertex cache", isBeforeArguments},
                         Flush{"flush the data cache", isBeforeArguments},
                         Flush{"flush the tile cache", isBeforeArguments}};

std::size_t countOf(std::span<const Flush> flushes, const vk::BarrierScope& scope) {
    return static_cast<std::size_t>(
        std::ranges::count_if(flushes, [&](const Flush& flush) { return flush.isDone(scope); }));
}

void add(FlushCount& count, const vk::BarrierScope& scope) {
    ++count.barriers;
    count.afterTransfers += scope.afterTransfers ? 1 : 0;
    count.beforeTransfers += scope.beforeTransfers ? 1 : 0;
    count.beforeArguments += scope.beforeArguments ? 1 : 0;
    count.radv += countOf(radv, scope);
    count.anv += countOf(anv, scope);
}

template <typename Visit>
void forEachBarrier(const sim::StepProgram& program, sim::Recording recording, const Visit& visit) {
    for (const sim::Pass& pass : program[sim::List::step])
        if (sim::hasBarrier(recording, pass)) visit(pass, pass.scopes[recording.index()]);
}

std::string row(const std::string& name, const FlushCount& count) {
    return fmt::format("  {:<34} {:>7} {:>9} {:>9} {:>9} {:>7} {:>7}\n", name, count.barriers,
                       count.afterTransfers, count.beforeTransfers, count.beforeArguments, count.radv,
                       count.anv);
}

std::string totals(const char* driver, std::span<const Flush> flushes, const sim::StepProgram& program,
                   sim::Recording recording) {
    std::string text = fmt::format("{}, times a step:\n", driver);
    for (const Flush& flush : flushes) {
        std::size_t times = 0;
        forEachBarrier(program, recording, [&](const sim::Pass&, const vk::BarrierScope& scope) {
            times += flush.isDone(scope) ? 1 : 0;
        });
        text += fmt::format("  {:<34} {:>7}\n", flush.name, times);
    }
    return text;
}

} // namespace

std::span<const Flush> radvFlushes() {
    return radv;
}
std::span<const Flush> anvFlushes() {
    return anv;
}

FlushCount countFlushes(const sim::StepProgram& program, sim::Recording recording) {
    FlushCount count;
    forEachBarrier(program, recording,
                   [&](const sim::Pass&, const vk::BarrierScope& scope) { add(count, scope); });
    return count;
}

std::string flushText(const sim::StepProgram& program) {
    const sim::Recording recording = sim::plainStep;
    std::map<std::string, FlushCount> byPass;
    forEachBarrier(program, recording, [&](const sim::Pass& pass, const vk::BarrierScope& scope) {
        add(byPass[pass.label], scope);
    });
    std::string text =
        fmt::format("barriers of a step without a blade, and what drivers do at them by their "
                    "public rules, not measured\n  {:<34} {:>7} {:>9} {:>9} {:>9} {:>7} {:>7}\n",
                    "before", "number", "after", "before", "before", "RADV", "ANV") +
        fmt::format("  {:<34} {:>7} {:>9} {:>9} {:>9}\n", "", "", "transfers", "transfers", "arguments");
    for (const auto& [label, count] : byPass) text += row(label, count);
    const FlushCount all = countFlushes(program, recording);
    text += row("all", all);
    text += fmt::format("if each ordered all kinds of work: {} on RADV, {} on ANV\n",
                        all.barriers * radv.size(), all.barriers * anv.size());
    return text + totals("RADV", radv, program, recording) + totals("ANV", anv, program, recording);
}

} // namespace sinew::tools
