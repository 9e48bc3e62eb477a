// Tests that sums and products are equal on every device; roots and quotients are not tested. A compiler may
// fuse a product and a sum unless they are decorated with NoContraction, which vk::withoutContraction adds to
// all of them. Dot products and similar instructions remain free. They must not occur in functions whose
// results must have equal bits everywhere: predicates used by several kernels, signs of determinants, and
// code shared by the forms of a step. The test reads the SPIR-V of every kernel in the build.
#include "sinew/vk/device.hpp"
#include "sinew/vk/spirv.hpp"
#include "vk/exact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <vector>

namespace sinew::test {

namespace {

namespace fs = std::filesystem;

/// Names as mangled by the compiler, up to the first difference from other names.
const std::vector<std::string> exactFunctions{
    // math.glsl
    "dot3(", "cross3(", "length3(", "sizeOf(",
    // hash grids
    "wayOf(f1;vf3", "frameOf(", "cellOf(", "isHurrying(", "motionOf(vf3", "mostMotion(",
    // contacts, restitution, interlocked bodies
    "isApart(", "touches(", "meetingOf(vf3", "axisFor(", "directionOf(vf3", "passes(vf3", "passedDirection(",
    "bounceFrom(", "partingOf(", "held(u1;", "impulseOf(u1;struct-Pair",
    // blades
    "volumeOf(", "edgeHit(", "rayHit(", "hitOf(", "isNearBlade(",
    // forms of `split`
    "linkImpulse(", "latticeLink(", "pressCell(", "ofCorner(", "pressCells(", "advance(", "rebound(",
    "projectOntoPlane("};

/// Functions that decide in several kernels and are not exact, with the reason why this is harmless.
const std::map<std::string, std::string> looseDecisions{
    {"isBesideWay(struct-Searched", "a face is searched by find_faces or by find_wide_faces"},
    {"isNear(struct-Searched-u1-struct-ContactFace",
     "a face is searched by find_faces or by find_wide_faces"},
    {"isPast(", "contacts and stops look at paths of their own: a stop acts on what contacts left"},
    {"isRegarded(",
     "a path that is not regarded is tested against all colliders, which finds the same contacts"},
    {"keepsApart(", "search_patches asks for more than check_patches; a patch that is given up searches, "
                    "which changes nothing"},
    {"isSliver(",
     "find_faces looks farther around a sliver, and find_face_contacts passes it over: one is enough"}};

constexpr std::uint32_t opName = 5, opExtInst = 12, opTypeBool = 20, opFunction = 54, opFunctionCall = 57,
                        opDecorate = 71, noContraction = 42, opDot = 148;

// Float operations that may be fused: OpFAdd, OpFSub, OpFMul, and products with vectors and matrices.
bool mayBeFused(std::uint32_t op) {
    return op == 129 || op == 131 || op == 133 || (op >= 142 && op <= 147);
}

// GLSL.std.450 instructions made of products and sums: FMix, SmoothStep, Length, Distance, Cross, Normalize,
// FaceForward, Reflect.
bool isLoose(std::uint32_t extended) {
    return std::set<std::uint32_t>{46, 49, 66, 67, 68, 69, 70, 71}.contains(extended);
}

std::vector<std::uint32_t> wordsOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(stream), {});
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), words.size() * 4);
    return words;
}

struct Inexact {
    std::set<std::string> functions;  ///< all functions of the module
    int fused = 0;                    ///< fusible operations in all functions
    std::map<std::string, int> loose; ///< number of inexact instructions by function
    std::set<std::string> decisions;  ///< functions that return a bool
    std::map<std::string, std::set<std::string>> calls;

    /// Whether a function, or one that it calls, has inexact instructions.
    bool isLoose(const std::string& function) const {
        if (loose.contains(function)) return true;
        const auto called = calls.find(function);
        return called != calls.end() &&
               std::ranges::any_of(called->second, [&](const std::string& one) { return isLoose(one); });
    }
};

Inexact inspect(const std::vector<std::uint32_t>& words) {
    Inexact result;
    std::map<std::uint32_t, std::string> names;
    std::set<std::uint32_t> decorated, bools;
    std::string function;
    for (std::size_t at = 5; at < words.size(); at += words[at] >> 16) {
        const std::uint32_t op = words[at] & 0xffff, *operands = words.data() + at + 1;
        if (op == opName) names[operands[0]] = reinterpret_cast<const char*>(operands + 1);
        if (op == opDecorate && operands[1] == noContraction) decorated.insert(operands[0]);
        if (op == opTypeBool) bools.insert(operands[0]);
        if (op == opFunction) {
            result.functions.insert(function = names[operands[1]]);
            if (bools.contains(operands[0])) result.decisions.insert(function);
        }
        if (op == opFunctionCall) result.calls[function].insert(names[operands[2]]);
        const bool isFused = mayBeFused(op) && !decorated.contains(operands[1]);
        result.fused += isFused ? 1 : 0;
        if (isFused || op == opDot || (op == opExtInst && isLoose(operands[3]))) ++result.loose[function];
    }
    return result;
}

std::vector<fs::path> kernelsIn(const fs::path& folder) {
    std::vector<fs::path> files;
    for (fs::recursive_directory_iterator file(folder), end; file != end; ++file) {
        if (file->path().filename() == "archive") file.disable_recursion_pending(); // of another time
        if (file->path().string().ends_with(".comp.spv")) files.push_back(file->path());
    }
    return files;
}

std::set<std::string> sourcesIn(const fs::path& folder) {
    std::set<std::string> stems;
    for (const fs::directory_entry& file : fs::recursive_directory_iterator(folder))
        if (file.path().extension() == ".comp") stems.insert(file.path().stem().string());
    return stems;
}

// The kernel of a form. A form's name begins with that of its source.
std::string kernelOf(const fs::path& file) {
    static const std::set<std::string> sources = sourcesIn(GLSL_FOLDER);
    const std::string whole = file.stem().stem().string();
    for (std::size_t end = whole.size(); end != std::string::npos && end > 0; end = whole.rfind('_', end - 1))
        if (sources.contains(whole.substr(0, end))) return whole.substr(0, end);
    return whole;
}

} // namespace

TEST(ExactKernels, LeaveACompilerNothingToFuseWhereBitsMustAgree) {
    const std::vector<fs::path> kernels = kernelsIn(KERNEL_FOLDER);
    ASSERT_GE(kernels.size(), 150u) << "the kernels of src/sim are built with the library that this links";
    std::set<std::string> found;
    for (const fs::path& kernel : kernels) {
        const Inexact inexact = inspect(vk::withoutContraction(wordsOf(kernel))); // as drivers get it
        for (const std::string& exact : exactFunctions)
            for (const std::string& function : inexact.functions) {
                if (!function.starts_with(exact)) continue;
                found.insert(exact);
                EXPECT_FALSE(inexact.loose.contains(function)) << kernel.filename() << ": " << function;
            }
    }
    EXPECT_EQ(found.size(), exactFunctions.size()); // each entry must match a function
}

// Two kernels must decide alike. Otherwise one takes a particle for fast and the other for slow, and a pair
// is listed twice or never.
TEST(ExactKernels, DecideNothingTwiceThatIsNotExact) {
    const std::vector<fs::path> kernels = kernelsIn(KERNEL_FOLDER);
    ASSERT_GE(kernels.size(), 150u) << "the kernels of src/sim are built with the library that this links";
    std::map<std::string, std::set<std::string>> decidedIn, looseIn;
    for (const fs::path& kernel : kernels) {
        const Inexact inexact = inspect(vk::withoutContraction(wordsOf(kernel)));
        for (const std::string& decision : inexact.decisions) {
            decidedIn[decision].insert(kernelOf(kernel));
            if (inexact.isLoose(decision)) looseIn[decision].insert(kernelOf(kernel));
        }
    }
    std::set<std::string> excused;
    for (const auto& [decision, loose] : looseIn) {
        const auto& in = decidedIn[decision];
        if (in.size() < 2) continue;
        const auto excuse = std::ranges::find_if(
            looseDecisions, [&name = decision](const auto& one) { return name.starts_with(one.first); });
        if (excuse != looseDecisions.end())
            excused.insert(excuse->first);
        else
            ADD_FAILURE() << decision << " is not exact, and asked in " << *in.begin() << " and "
                          << *in.rbegin() << ": decide once and store it, or make it exact (math.glsl)";
    }
    for (const auto& [decision, why] : looseDecisions)
        EXPECT_TRUE(excused.contains(decision)) << "an excuse for nothing: " << decision;
}

TEST(ExactKernels, AreMadeWithoutAnOperationThatMayBeFused) {
    int before = 0;
    for (const fs::path& kernel : kernelsIn(KERNEL_FOLDER)) {
        const std::vector<std::uint32_t> words = wordsOf(kernel), exact = vk::withoutContraction(words);
        before += inspect(words).fused;
        EXPECT_EQ(inspect(exact).fused, 0) << kernel.filename();
        EXPECT_EQ(vk::withoutContraction(exact), exact) << kernel.filename() << " is exact already";
    }
    EXPECT_GT(before, 1000) << "without it there are many";
}

// The largest kernel binds as many storage buffers as `sinew devices` and the documentation state.
TEST(Kernels, BindAsManyStorageBuffersAsIsSaid) {
    const std::vector<fs::path> kernels = kernelsIn(KERNEL_FOLDER);
    ASSERT_GE(kernels.size(), 150u) << "the kernels of src/sim are built with the library that this links";
    std::ptrdiff_t most = 0;
    for (const fs::path& kernel : kernels) {
        if (kernel.string().find("sinew_sim_kernels") == std::string::npos) continue;
        const std::vector<std::uint32_t> words = wordsOf(kernel);
        const vk::KernelInterface read = vk::readInterface({"kernel", words});
        most = std::max(most,
                        std::ranges::count(read.bindings, vk::BlockKind::storage, &vk::KernelBinding::kind));
    }
    EXPECT_EQ(most, vk::mostStorageBuffers);
}

TEST(ExactKernels, AreToldFromLooseOnes) {
    const Inexact inexact = inspect(wordsOf(fs::path(EXACT_FOLDER) / "loose_and_exact.comp.spv"));
    const auto looseIn = [&](const std::string& name) {
        int count = 0;
        for (const auto& [function, loose] : inexact.loose)
            if (function.starts_with(name)) count += loose;
        return count;
    };
    EXPECT_EQ(looseIn("fused("), 2); // a product and a sum
    EXPECT_EQ(looseIn("exact("), 0);
    EXPECT_EQ(looseIn("dotted("), 1); // `precise` does not affect it
    EXPECT_EQ(looseIn("crossed("), 1);
}

} // namespace sinew::test
