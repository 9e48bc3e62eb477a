#include "scenes/specialised.hpp"

#include "sinew/vk/spirv.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <unistd.h>

namespace sinew::test {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::uint32_t>;

constexpr std::uint32_t opSpecConstantTrue = 48, opSpecConstantFalse = 49, opSpecConstant = 50,
                        opVariable = 59, opDecorate = 71;
constexpr std::uint32_t specId = 1, bindingDecoration = 33;
constexpr std::size_t headerWords = 5;

// Calls `visit` with each instruction: its opcode, and the index of its first word.
template <typename Visit> void forEachInstruction(const Words& words, Visit visit) {
    for (std::size_t at = headerWords; at < words.size(); at += words[at] >> 16)
        visit(words[at] & 0xffffu, at);
}

// Values of a decoration, by id of what it decorates.
std::map<std::uint32_t, std::uint32_t> decorated(const Words& words, std::uint32_t decoration) {
    std::map<std::uint32_t, std::uint32_t> values;
    forEachInstruction(words, [&](std::uint32_t op, std::size_t at) {
        if (op == opDecorate && words[at + 2] == decoration) values[words[at + 1]] = words[at + 3];
    });
    return values;
}

// The module with other defaults of its specialisation constants.
Words withDefaults(Words words, const std::map<std::uint32_t, std::uint32_t>& constants) {
    const auto ids = decorated(words, specId);
    forEachInstruction(Words(words), [&](std::uint32_t op, std::size_t at) {
        if (op != opSpecConstantTrue && op != opSpecConstantFalse && op != opSpecConstant) return;
        const auto id = ids.find(words[at + 2]);
        if (id == ids.end() || !constants.contains(id->second)) return;
        const std::uint32_t value = constants.at(id->second);
        if (op == opSpecConstant)
            words[at + 3] = value;
        else
            words[at] = (words[at] & 0xffff0000u) | (value != 0 ? opSpecConstantTrue : opSpecConstantFalse);
    });
    return words;
}

void write(const fs::path& path, const Words& words) {
    std::ofstream file(path, std::ios::binary);
    for (const std::uint32_t word : words) file.write(reinterpret_cast<const char*>(&word), sizeof(word));
}

Words read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    Words words(bytes.size() / sizeof(std::uint32_t));
    std::copy_n(bytes.data(), words.size() * sizeof(std::uint32_t), reinterpret_cast<char*>(words.data()));
    return words;
}

} // namespace

std::optional<std::set<std::uint32_t>>
accessedBindings(const vk::ShaderCode& code, const std::map<std::uint32_t, std::uint32_t>& constants) {
    const fs::path folder = fs::temp_directory_path();
    const std::string stem = "sinew_specialised_" + std::to_string(::getpid()) + "_" + code.name;
    const fs::path from = folder / (stem + ".spv"), to = folder / (stem + ".out.spv");
    write(from, withDefaults(vk::wordsOf(code), constants));
    const std::string command =
        "spirv-opt --freeze-spec-const --fold-spec-const-op-composite "
        "--merge-return --inline-entry-points-exhaustive --convert-local-access-chains "
        "--eliminate-local-single-block --eliminate-local-single-store --ssa-rewrite "
        "--ccp --eliminate-dead-branches --ccp --eliminate-dead-branches "
        "--eliminate-dead-code-aggressive --eliminate-dead-variables " +
        from.string() + " -o " + to.string();
    if (std::system(command.c_str()) != 0) return std::nullopt;
    const Words words = read(to);
    fs::remove(from);
    fs::remove(to);
    std::set<std::uint32_t> variables, bindings;
    forEachInstruction(words, [&](std::uint32_t op, std::size_t at) {
        if (op == opVariable) variables.insert(words[at + 2]);
    });
    for (const auto& [id, binding] : decorated(words, bindingDecoration))
        if (variables.contains(id)) bindings.insert(binding);
    return bindings;
}

} // namespace sinew::test
