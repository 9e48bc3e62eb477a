// Tests of the reader of kernel interfaces: its results, its refusals, and its agreement with spirv-cross.
#include "sinew/vk/spirv.hpp"
#include "test_kernels.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace sinew::test {

namespace {

using vk::Access;
using vk::readInterface;

std::string complaintAbout(const vk::ShaderCode& code) {
    try {
        readInterface(code);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "none";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Number of words before the first OpFunction, where interfaces end.
std::size_t interfaceLength(std::span<const std::uint32_t> words) {
    constexpr std::uint32_t opFunction = 54;
    std::size_t at = 5;
    while ((words[at] & 0xffff) != opFunction) at += words[at] >> 16;
    return at;
}

} // namespace

TEST(KernelInterface, HoldsNamesAccessAndStridesInBindingOrder) {
    const auto interface = readInterface(kernels::everything);
    ASSERT_EQ(interface.bindings.size(), 5u);
    const vk::KernelBinding expected[] = {{0, "Links", Access::read, 32},
                                          {1, "Frames", Access::write, 64},
                                          {2, "Positions", Access::readWrite, 16},
                                          {3, "Step", Access::read, 32},
                                          {4, "Masks", Access::read, 12}};
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(interface.bindings[i].binding, expected[i].binding);
        EXPECT_EQ(interface.bindings[i].name, expected[i].name);
        EXPECT_EQ(interface.bindings[i].access, expected[i].access) << expected[i].name;
        EXPECT_EQ(interface.bindings[i].stride, expected[i].stride) << expected[i].name;
    }
}

TEST(KernelInterface, RoundsPushConstantsToTheirAlignment) {
    EXPECT_EQ(readInterface(kernels::everything).pushConstantSize,
              48u); // 8 + 4, padding to 16, 24 rounded up to 32
    EXPECT_EQ(readInterface(kernels::writeBehindEnd).pushConstantSize, 4u);
    EXPECT_EQ(readInterface(kernels::addOne).pushConstantSize, 0u);
}

TEST(KernelInterface, KnowsFixedAndSpecialisedGroupSizes) {
    const auto fixed = readInterface(kernels::addOne);
    EXPECT_EQ(fixed.groupSize, (std::array<std::uint32_t, 3>{64, 1, 1}));
    EXPECT_FALSE(fixed.groupSizeIds[0].has_value());
    const auto specialised = readInterface(kernels::everything);
    EXPECT_EQ(specialised.groupSize,
              (std::array<std::uint32_t, 3>{1, 2, 1})); // glslang's default is 1, not the id
    EXPECT_EQ(specialised.groupSizeIds[0], 3u);
    EXPECT_FALSE(specialised.groupSizeIds[1].has_value());
}

TEST(KernelInterface, ListsSpecialisationConstantsInOrder) {
    EXPECT_EQ(readInterface(kernels::everything).specialisationIds, (std::vector<std::uint32_t>{0, 3, 7, 8}));
    EXPECT_TRUE(readInterface(kernels::addOne).specialisationIds.empty());
}

TEST(KernelInterface, AddsUpSharedMemoryWithDefaultArrayLengths) {
    EXPECT_EQ(readInterface(kernels::everything).sharedMemory, 5 * 2 * 16u + 4u);
    EXPECT_EQ(readInterface(kernels::addOne).sharedMemory, 0u);
}

TEST(KernelInterface, TakesTheValuesOfSpecialisationConstants) {
    for (const std::uint32_t width : {1u, 5u, 512u}) {
        const vk::SpecialisationConstant constants[] = {{7, width}, {3, 32}, {0, 1}, {99, 4}};
        const auto specialised = readInterface(kernels::everything, constants);
        EXPECT_EQ(specialised.sharedMemory, width * 2 * 16u + 4u);
        EXPECT_EQ(specialised.groupSize, (std::array<std::uint32_t, 3>{32, 2, 1}));
    }
}

TEST(KernelInterface, IsRefusedByNameWhereAKernelBreaksARule) {
    const std::pair<vk::ShaderCode, const char*> cases[] = {
        {kernels::uniformBlock, "uniform block Step has 16400 bytes, at most 16384 are allowed"},
        {kernels::secondSet, "Values must have a binding in set 0"},
        {kernels::bindingGap, "Third has binding 2 instead of 1, which comes next"},
        {kernels::headerAndArray, "Contacts has fixed members and a run-time array"},
        {kernels::storageImage, "picture is no storage buffer"},
        {kernels::texture, "picture is no samplerBuffer"},
        {kernels::doublePrecision, "capability 10"},
        {kernels::rowMajor, "row-major"},
        {kernels::twinAlone, "weights, must be texels of the storage block with binding 1"},
        {kernels::twinOfWritten, "before, must be Aliased"},
    };
    for (const auto& [code, complaint] : cases) {
        const std::string message = complaintAbout(code);
        EXPECT_TRUE(contains(message, complaint)) << message;
        EXPECT_TRUE(contains(message, code.name)) << message;
    }
}

TEST(KernelInterface, IsRefusedForEveryTruncationBeforeTheCode) {
    const std::vector<std::uint32_t> words = vk::wordsOf(kernels::everything);
    const std::size_t end = interfaceLength(words);
    for (std::size_t length = 0; length <= end; ++length)
        EXPECT_NE(complaintAbout({"cut", std::span(words).first(length)}), "none")
            << length << " words of " << end;
}

TEST(KernelInterface, SurvivesEverySingleDamagedWord) {
    const std::vector<std::uint32_t> words = vk::wordsOf(kernels::everything);
    std::vector<std::uint32_t> damaged = words;
    std::size_t refused = 0;
    for (std::size_t at = 0; at < interfaceLength(words); ++at)
        for (const std::uint32_t wrong : {0u, 0xffffffffu, words[at] ^ 0x10000u, words[at] + 1}) {
            damaged[at] = wrong;
            refused += complaintAbout({"damaged", damaged}) != "none" ? 1 : 0;
            damaged[at] = words[at];
        }
    EXPECT_GT(refused, interfaceLength(words)); // most are refused, and none may crash or hang
}

namespace {

vk::ShaderCode load(const std::filesystem::path& file, std::vector<std::uint32_t>& words, std::string& name) {
    std::ifstream stream(file, std::ios::binary);
    words.resize(std::filesystem::file_size(file) / 4);
    stream.read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * 4));
    name = file.stem().string();
    return {name.c_str(), words};
}

nlohmann::json reflect(const std::filesystem::path& file) {
    const std::string command = std::string(SPIRV_CROSS) + " '" + file.string() + "' --reflect";
    std::string output;
    FILE* pipe = popen(command.c_str(), "r");
    for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe))
        output += static_cast<char>(letter);
    EXPECT_EQ(pclose(pipe), 0) << command;
    return nlohmann::json::parse(output);
}

// The binding of a kernel's interface for a resource of its reflection. Bindings are sorted, with a gap
// before the last.
const vk::KernelBinding& bindingOf(const vk::KernelInterface& interface, const nlohmann::json& resource) {
    const auto found = std::ranges::find(interface.bindings, resource["binding"].get<std::uint32_t>(),
                                         &vk::KernelBinding::binding);
    if (found == interface.bindings.end())
        throw std::runtime_error("no binding " + resource["binding"].dump());
    return *found;
}

void compareBindings(const vk::KernelInterface& interface, const nlohmann::json& reflection) {
    nlohmann::json buffers = reflection.value("ssbos", nlohmann::json::array());
    for (nlohmann::json block : reflection.value("ubos", nlohmann::json::array())) {
        block["readonly"] = block["uniform"] = true;
        buffers.push_back(block);
    }
    const nlohmann::json texels = reflection.value("textures", nlohmann::json::array());
    ASSERT_EQ(interface.bindings.size(), buffers.size() + texels.size());
    for (const nlohmann::json& texel : texels) {
        const auto& binding = bindingOf(interface, texel);
        EXPECT_EQ(binding.kind, vk::BlockKind::texels);
        EXPECT_EQ(binding.name, texel["name"]);
        EXPECT_EQ(binding.isFloat ? "samplerBuffer" : "usamplerBuffer", texel["type"]);
    }
    for (const nlohmann::json& buffer : buffers) {
        const auto& binding = bindingOf(interface, buffer);
        const nlohmann::json& block = reflection["types"][buffer["type"].get<std::string>()];
        EXPECT_EQ(binding.name, block["name"]);
        const Access access = buffer.value("readonly", false)    ? Access::read
                              : buffer.value("writeonly", false) ? Access::write
                                                                 : Access::readWrite;
        EXPECT_EQ(binding.access, access) << binding.name;
        EXPECT_EQ(binding.kind == vk::BlockKind::uniform, buffer.value("uniform", false)) << binding.name;
        const nlohmann::json& last = block["members"].back();
        if (last.contains("array") && last["array"].back() == 0) {
            EXPECT_EQ(binding.stride, last["array_stride"]) << binding.name;
        } else { // spirv-cross does not round up to the alignment
            const auto size = buffer["block_size"].get<std::uint32_t>();
            EXPECT_GE(binding.stride, size) << binding.name;
            EXPECT_LT(binding.stride, size + 16) << binding.name;
        }
    }
}

void compareGroupSize(const vk::KernelInterface& interface, const nlohmann::json& reflection) {
    const nlohmann::json& entry = reflection["entryPoints"][0];
    for (std::size_t dimension = 0; dimension < 3; ++dimension) {
        const bool isSpecialised = entry.contains("workgroup_size_is_spec_constant_id") &&
                                   entry["workgroup_size_is_spec_constant_id"][dimension].get<bool>();
        ASSERT_EQ(interface.groupSizeIds[dimension].has_value(), isSpecialised);
        const std::uint32_t ours =
            isSpecialised ? *interface.groupSizeIds[dimension] : interface.groupSize[dimension];
        EXPECT_EQ(ours, entry["workgroup_size"][dimension]);
    }
}

std::vector<std::filesystem::path> computeKernels(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().string().ends_with(".comp.spv")) files.push_back(entry.path());
    return files;
}

} // namespace

TEST(KernelInterface, AgreesWithSpirvCrossOnEveryKernelInTheBuild) {
    if (std::string_view(SPIRV_CROSS).empty()) GTEST_SKIP() << "spirv-cross is not installed";
    std::size_t compared = 0;
    for (const auto& file : computeKernels(KERNEL_FOLDER)) {
        std::vector<std::uint32_t> words;
        std::string name;
        const vk::ShaderCode code = load(file, words, name);
        if (complaintAbout(code) != "none")
            continue; // kernels that deliberately break a rule; the others have their
                      // own tests
        SCOPED_TRACE(file.filename().string());
        const vk::KernelInterface interface = readInterface(code);
        const nlohmann::json reflection = reflect(file);
        compareBindings(interface, reflection);
        compareGroupSize(interface, reflection);
        EXPECT_EQ(interface.pushConstantSize > 0, reflection.contains("push_constants"));
        EXPECT_EQ(interface.specialisationIds.size(),
                  reflection.value("specialization_constants", nlohmann::json::array()).size());
        ++compared;
    }
    EXPECT_GE(compared, 7u); // at least the valid kernels of this folder
}

} // namespace sinew::test
