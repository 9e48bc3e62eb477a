// The printed form of a step program: for audits by people and for golden tests.
#include "sim/program/program.hpp"

#include "sim/core/hash.hpp"

#include <iomanip>
#include <sstream>

namespace sinew::sim {

namespace {

const char* accessName(vk::Access access) {
    constexpr const char* names[] = {"", ":r", ":w", ":rw"};
    return names[static_cast<std::size_t>(access)];
}

std::string line(const StepProgram& program, const Pass& pass) {
    std::ostringstream text;
    text << "  " << std::left << std::setw(24) << pass.label << ' ';
    const bool isDispatch = pass.kind == PassKind::dispatch;
    const std::string times = pass.isIndirect ? "0..x" : "x"; // the device decides; this is the maximum
    text << std::setw(10) << (isDispatch ? times + std::to_string(pass.items) : std::string());
    for (const BufferUse& use : boundUses(pass)) {
        text << ' ' << program.buffers[use.buffer.index].label << accessName(use.access);
    }
    if (pass.isIndirect)
        text << ' ' << program.buffers[pass.uses.back().buffer.index].label << '[' << pass.value << "]:i";
    if (pass.when != When::always) text << "  (with a blade)";
    if (pass.isOfLists) text << "  (not in a calm step)";
    return text.str();
}

// A block of lines: the passes of one substep, or those outside.
struct Block {
    std::uint32_t substep = 0;
    std::string phase, text;
};

std::vector<Block> blocks(const StepProgram& program, const std::vector<Pass>& passes) {
    std::vector<Block> result;
    for (const Pass& pass : passes) {
        const std::string& phase = program.phases[pass.phase];
        if (result.empty() || result.back().substep != pass.substep || result.back().phase != phase) {
            result.push_back({pass.substep, phase, {}});
        }
        if (hasBarrier({}, pass)) result.back().text += "  -- barrier\n";
        result.back().text += line(program, pass) + "\n";
    }
    return result;
}

// The length of the shortest run from `first` on that repeats immediately, and its number of repetitions.
std::pair<std::size_t, std::size_t> repetition(const std::vector<Block>& all, std::size_t first) {
    for (std::size_t length = 1; length <= 2; ++length) {
        std::size_t times = 1;
        const auto isEqual = [&](std::size_t offset) {
            const std::size_t other = first + times * length + offset;
            return other < all.size() && all[other].substep != 0 && all[first].substep != 0 &&
                   all[first + offset].text == all[other].text;
        };
        while (isEqual(0) && (length == 1 || isEqual(1))) ++times;
        if (times > 1) return {length, times};
    }
    return {1, 1};
}

void print(std::ostringstream& text, const StepProgram& program, const std::vector<Pass>& passes) {
    const std::vector<Block> all = blocks(program, passes);
    for (std::size_t b = 0; b < all.size();) {
        const auto [length, times] = repetition(all, b);
        for (std::size_t i = 0; i < length; ++i) {
            const Block& block = all[b + i];
            text << (block.substep != 0 ? "substep " + std::to_string(block.substep) : block.phase);
            if (times > 1) text << " x" << times << (length == 2 ? " (alternating)" : "");
            text << '\n' << block.text;
        }
        b += length * times;
    }
}

std::string megabytes(std::uint64_t bytes) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << static_cast<double>(bytes) / 1e6 << " MB";
    return text.str();
}

// Dispatches of a step while all, some or no particles are awake.
std::string sleepText(const StepProgram& program) {
    if (program.sleep.arguments == BufferId{}) return {};
    std::size_t all = 0, listed = 0, whole = 0, always = 0;
    for (const Pass& pass : program[List::step]) {
        if (pass.isOfCut() || pass.kind != PassKind::dispatch) continue;
        const bool isOfSleep = pass.isIndirect && pass.uses.back().buffer == program.sleep.arguments;
        const bool isListed = isOfSleep && boundUses(pass).back().buffer == program.sleep.listed;
        ++all;
        listed += isListed ? 1 : 0;
        whole += isOfSleep && !isListed ? 1 : 0;
        always += pass.isIndirect ? 0 : 1;
    }
    std::ostringstream text;
    text << "sleep: of " << all << " dispatches " << listed
         << " run for the work groups with an awake particle, " << whole << " whole while any is, "
         << all - listed - whole - always << " at the request of others, " << always << " always\n";
    return text.str();
}

} // namespace

std::uint64_t keyOf(const StepProgram& program) noexcept {
    std::uint64_t key = fnv1a({});
    const auto add = [&](std::span<const std::byte> bytes) { key = fnv1a(bytes, key); };
    for (const BufferSpec& buffer : program.buffers) {
        const std::uint64_t size = buffer.bytes();
        add(std::as_bytes(std::span(buffer.label)));
        add(std::as_bytes(std::span(&size, 1)));
        add(buffer.initial);
    }
    for (const Pass& pass : program[List::step]) add(std::as_bytes(std::span(pass.label)));
    return key;
}

PassCounts countPasses(const StepProgram& program, Recording recording) {
    PassCounts counts;
    for (const Pass& pass : program[List::step]) {
        if (!isIn(recording, pass)) continue;
        ++counts.passes;
        counts.dispatches += pass.kind == PassKind::dispatch ? 1 : 0;
        counts.barriers += hasBarrier(recording, pass) ? 1 : 0;
    }
    return counts;
}

std::uint64_t declaredBytes(const StepProgram& program) {
    std::uint64_t bytes = 0;
    for (const Pass& pass : program[List::step]) {
        if (pass.isOfCut()) continue;
        for (const BufferUse& use : pass.uses) {
            const std::uint64_t size = program.buffers[use.buffer.index].bytes();
            bytes += use.access == vk::Access::readWrite ? 2 * size : size;
        }
    }
    return bytes;
}

std::string describe(const StepProgram& program) {
    std::ostringstream text;
    std::uint64_t memory = 0;
    for (const BufferSpec& buffer : program.buffers) memory += buffer.bytes();
    text << program.particleCount << " particles, " << program.constraintCount << " constraints, "
         << program.buffers.size() << " buffers, " << megabytes(memory) << "\n\n";
    for (const BufferSpec& buffer : program.buffers) {
        text << "  " << std::left << std::setw(28) << buffer.label << std::right;
        if (buffer.initialOf)
            text << "  contents of " << program.buffers[*buffer.initialOf].label << " at the start\n";
        else
            text << std::setw(9) << buffer.count << " x " << std::setw(3) << buffer.stride << " B\n";
    }
    text << '\n';
    for (const List list : {List::step, List::skin, List::wholeSkin}) print(text, program, program[list]);
    const PassCounts counts = countPasses(program, plainStep), calm = countPasses(program, calmStep);
    text << "\nper step: " << counts.dispatches << " dispatches, " << counts.passes - counts.dispatches
         << " fills, copies and updates, " << counts.barriers << " barriers, "
         << megabytes(declaredBytes(program)) << " declared, " << program.sweeps << " sweeps\n";
    if (calm.passes < counts.passes)
        text << "per calm step: " << calm.dispatches << " dispatches, " << calm.barriers << " barriers\n";
    text << sleepText(program);
    for (const std::string& feature : program.skipped) text << "skipped: " << feature << '\n';
    return text.str();
}

} // namespace sinew::sim
