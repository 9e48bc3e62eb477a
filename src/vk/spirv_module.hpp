// A parsed SPIR-V module, as far as kernels need it: types, constants, decorations, variables. Private to
// src/vk. Opcodes and layout follow the SPIR-V specification 1.5, sections 2.3 and 3.
#pragma once

#include "sinew/vk/spirv.hpp"

#include <map>
#include <stdexcept>
#include <unordered_map>

namespace sinew::vk::spirv {

enum class Op : std::uint16_t {
    name = 5,
    entryPoint = 15,
    executionMode = 16,
    capability = 17,
    typeVoid = 19,
    typeBool = 20,
    typeInt = 21,
    typeFloat = 22,
    typeVector = 23,
    typeMatrix = 24,
    typeImage = 25,
    typeSampledImage = 27,
    typeArray = 28,
    typeRuntimeArray = 29,
    typeStruct = 30,
    typePointer = 32,
    constantTrue = 41,
    constantFalse = 42,
    constant = 43,
    constantComposite = 44,
    specConstantTrue = 48,
    specConstantFalse = 49,
    specConstant = 50,
    specConstantComposite = 51,
    specConstantOp = 52,
    function = 54,
    variable = 59,
    decorate = 71,
    memberDecorate = 72,
    executionModeId = 331,
};

enum class Decoration : std::uint32_t {
    specId = 1,
    bufferBlock = 3,
    rowMajor = 4,
    arrayStride = 6,
    builtIn = 11,
    aliased = 20,
    nonWritable = 24,
    nonReadable = 25,
    binding = 33,
    descriptorSet = 34,
    offset = 35,
};

enum class Storage : std::uint32_t {
    uniformConstant = 0,
    input = 1,
    uniform = 2,
    output = 3,
    workgroup = 4,
    privateToInvocation = 6,
    function = 7,
    pushConstant = 9,
    storageBuffer = 12,
};

/// One instruction; operands exclude the opcode word.
struct Instruction {
    Op op{};
    std::span<const std::uint32_t> operands;
};

using Decorations = std::map<Decoration, std::uint32_t>; ///< to the first literal, 0 without one

struct Variable {
    std::uint32_t id = 0, type = 0; ///< type: of a pointer
    Storage storage{};
};

struct Module {
    std::string shader; ///< for messages
    std::span<const SpecialisationConstant> specialised;
    std::unordered_map<std::uint32_t, std::string> names;
    std::unordered_map<std::uint32_t, Instruction> types, constants; ///< by result id
    std::unordered_map<std::uint32_t, Decorations> decorations;
    std::unordered_map<std::uint32_t, std::map<std::uint32_t, Decorations>>
        memberDecorations; ///< by type and member
    std::vector<Variable> variables;
    std::vector<std::uint32_t> capabilities;
    std::array<std::uint32_t, 3> localSize{1, 1, 1};
    std::uint32_t entryPoints = 0;

    [[noreturn]] void fail(const std::string& why) const {
        throw std::runtime_error("kernel " + shader + ": " + why);
    }
    std::string nameOf(std::uint32_t id) const; ///< "%id" if the module has no name for it
    const Instruction& type(std::uint32_t id) const;
    std::optional<std::uint32_t> decoration(std::uint32_t id, Decoration wanted) const;
    std::optional<std::uint32_t> memberDecoration(std::uint32_t type, std::uint32_t member,
                                                  Decoration wanted) const;

    /// Value of an integer constant, as specialised or else the default.
    std::uint32_t value(std::uint32_t constant) const;
    /// Constituent `index` of a composite constant, as an id.
    std::uint32_t constituent(std::uint32_t constant, std::uint32_t index) const;
    /// [B], from decorations of an explicit layout, else std430.
    std::uint32_t size(std::uint32_t type) const;
    std::uint32_t alignment(std::uint32_t type) const;

private:
    std::uint32_t structSize(std::uint32_t type) const;
    std::uint32_t operation(const Instruction& instruction) const;
    const SpecialisationConstant* specialisation(std::uint32_t constant) const;
};

Module parse(const ShaderCode& code, std::span<const SpecialisationConstant> constants);

} // namespace sinew::vk::spirv
