// Derives the interface of a kernel from a parsed module.
#include "sinew/vk/spirv.hpp"

#include "vk/inflate.hpp"
#include "vk/spirv_module.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>

namespace sinew::vk {

namespace {

using spirv::Decoration;
using spirv::Instruction;
using spirv::Module;
using spirv::Op;
using spirv::Storage;

std::uint32_t pointee(const Module& module, const spirv::Variable& variable) {
    const Instruction& pointer = module.type(variable.type);
    if (pointer.op != Op::typePointer) module.fail("a variable's type is no pointer");
    return pointer.operands[2];
}

/// True for a decoration of a block. glslang puts readonly and writeonly on every member of a block, other
/// compilers on the variable.
bool isDecorated(const Module& module, std::uint32_t variable, std::uint32_t block, Decoration wanted) {
    if (module.decoration(variable, wanted)) return true;
    const std::size_t members = module.type(block).operands.size() - 1;
    for (std::uint32_t member = 0; member < members; ++member)
        if (!module.memberDecoration(block, member, wanted)) return false;
    return members > 0;
}

Access accessOf(const Module& module, std::uint32_t variable, std::uint32_t block) {
    if (isDecorated(module, variable, block, Decoration::nonWritable)) return Access::read;
    return isDecorated(module, variable, block, Decoration::nonReadable) ? Access::write : Access::readWrite;
}

std::uint32_t strideOf(const Module& module, std::uint32_t block) {
    const auto members = module.type(block).operands.subspan(1);
    const auto isRuntimeArray = [&](std::uint32_t member) {
        return module.type(member).op == Op::typeRuntimeArray;
    };
    if (std::none_of(members.begin(), members.end(), isRuntimeArray)) return module.size(block);
    if (members.size() != 1)
        module.fail("block " + module.nameOf(block) +
                    " has fixed members and a run-time array: make two buffers");
    const auto stride = module.decoration(members[0], Decoration::arrayStride);
    if (!stride) module.fail("the array of block " + module.nameOf(block) + " has no stride");
    module.size(module.type(members[0]).operands[1]); // throws on row-major members
    return *stride;
}

KernelBinding bindingOf(const Module& module, const spirv::Variable& variable, BlockKind kind) {
    const std::uint32_t block = pointee(module, variable);
    if (module.type(block).op != Op::typeStruct)
        module.fail("the variable " + module.nameOf(variable.id) + " is no buffer block");
    const std::string name = module.nameOf(block);
    const auto binding = module.decoration(variable.id, Decoration::binding);
    if (!binding || module.decoration(variable.id, Decoration::descriptorSet).value_or(0) != 0)
        module.fail("buffer " + name + " must have a binding in set 0");
    const Access access = kind == BlockKind::uniform ? Access::read : accessOf(module, variable.id, block);
    const std::uint32_t stride = strideOf(module, block);
    constexpr std::uint32_t smallestLimit = 16384; // guaranteed maxUniformBufferRange of every device
    if (kind == BlockKind::uniform && stride > smallestLimit)
        module.fail("uniform block " + name + " has " + std::to_string(stride) +
                    " bytes, at most 16384 are allowed");
    return {*binding,
            name,
            access,
            stride,
            kind,
            false,
            module.decoration(variable.id, Decoration::aliased).has_value()};
}

KernelBinding texelsOf(const Module& module, const spirv::Variable& variable) {
    constexpr std::uint32_t buffer = 5, sampled = 1;
    const std::string name = module.nameOf(variable.id);
    const Instruction& type = module.type(pointee(module, variable));
    if (type.op != Op::typeSampledImage || module.type(type.operands[1]).op != Op::typeImage)
        module.fail(name + " is no storage buffer and no texel buffer: kernels bind nothing else");
    const auto& image = module.type(type.operands[1]).operands; // result, component, dimension, ..., sampled
    const Instruction& component = module.type(image[1]);
    const bool isFloat = component.op == Op::typeFloat;
    const bool isUnsigned = component.op == Op::typeInt && component.operands[2] == 0;
    if (image[2] != buffer || image[6] != sampled || !(isFloat || isUnsigned) || component.operands[1] != 32)
        module.fail(name + " is no samplerBuffer and no usamplerBuffer");
    const auto binding = module.decoration(variable.id, Decoration::binding);
    if (!binding || module.decoration(variable.id, Decoration::descriptorSet).value_or(0) != 0)
        module.fail("texel buffer " + name + " must have a binding in set 0");
    return {*binding,
            name,
            Access::read,
            0,
            BlockKind::texels,
            isFloat,
            module.decoration(variable.id, Decoration::aliased).has_value()};
}

void addVariable(const Module& module, const spirv::Variable& variable, KernelInterface& interface) {
    switch (variable.storage) {
    case Storage::storageBuffer:
        interface.bindings.push_back(bindingOf(module, variable, BlockKind::storage));
        break;
    case Storage::uniform: { // before SPIR-V 1.3 storage buffers had this class too, decorated BufferBlock
        const bool isStorage =
            module.decoration(pointee(module, variable), Decoration::bufferBlock).has_value();
        const BlockKind kind = isStorage ? BlockKind::storage : BlockKind::uniform;
        interface.bindings.push_back(bindingOf(module, variable, kind));
        break;
    }
    case Storage::uniformConstant:
        interface.bindings.push_back(texelsOf(module, variable));
        break;
    case Storage::pushConstant:
        interface.pushConstantSize = module.size(pointee(module, variable));
        break;
    case Storage::workgroup:
        interface.sharedMemory += module.size(pointee(module, variable));
        break;
    case Storage::input:
    case Storage::privateToInvocation:
        break;
    default:
        module.fail(module.nameOf(variable.id) + " is no storage buffer: kernels bind nothing else");
    }
}

// A twin must be texels, and the binding that it reads a storage block.
void checkTwin(const Module& module, const std::vector<KernelBinding>& bindings, const KernelBinding& twin) {
    const auto block = std::ranges::find(bindings, twin.binding - texelTwins, &KernelBinding::binding);
    const std::string name = "binding " + std::to_string(twin.binding) + ", " + twin.name;
    if (twin.kind != BlockKind::texels || block == bindings.end() || block->kind != BlockKind::storage)
        module.fail(name + ", must be texels of the storage block with binding " +
                    std::to_string(twin.binding - texelTwins));
    if (!twin.isAliased && (block->isAliased || block->access != Access::read))
        module.fail(name + ", must be Aliased, because its buffer may be written");
}

void checkBindings(const Module& module, const std::vector<KernelBinding>& bindings) {
    for (std::uint32_t i = 0; i < bindings.size(); ++i)
        if (bindings[i].isTwin())
            checkTwin(module, bindings, bindings[i]);
        else if (bindings[i].binding != i && bindings[i].binding < firstLoose)
            module.fail("buffer " + bindings[i].name + " has binding " + std::to_string(bindings[i].binding) +
                        " instead of " + std::to_string(i) + ", which comes next");
}

void checkCapabilities(const Module& module) {
    constexpr std::uint32_t matrix = 0, shader = 1, sampledBuffer = 46;
    for (const std::uint32_t capability : module.capabilities)
        if (capability != matrix && capability != shader && capability != sampledBuffer)
            module.fail("it needs the SPIR-V capability " + std::to_string(capability) +
                        ", an optional feature that no kernel of the core may use");
}

/// Reads the group size. layout(local_size_x_id = ...) decorates a composite of specialisation constants as
/// the WorkgroupSize built-in.
void readGroupSize(const Module& module, KernelInterface& interface) {
    constexpr std::uint32_t workgroupSize = 25;
    interface.groupSize = module.localSize;
    for (const auto& [id, instruction] : module.constants) {
        if (module.decoration(id, Decoration::builtIn) != workgroupSize) continue;
        for (std::uint32_t dimension = 0; dimension < 3; ++dimension) {
            const std::uint32_t constant = module.constituent(id, dimension);
            interface.groupSize[dimension] = module.value(constant);
            interface.groupSizeIds[dimension] = module.decoration(constant, Decoration::specId);
        }
    }
}

} // namespace

std::vector<std::uint32_t> wordsOf(const ShaderCode& code) {
    if (code.packed.empty()) return {code.words.begin(), code.words.end()};
    std::vector<std::uint32_t> words(code.wordCount);
    auto* const bytes = reinterpret_cast<std::uint8_t*>(words.data());
    if (!inflate(code.packed, {bytes, words.size() * sizeof(std::uint32_t)}))
        throw std::runtime_error(std::string("kernel ") + code.name + ": its packed bytes are damaged");
    if constexpr (std::endian::native == std::endian::big) // the bytes are little-endian
        for (std::uint32_t& word : words)
            word = word >> 24 | (word >> 8 & 0xff00) | (word << 8 & 0xff0000) | word << 24;
    return words;
}

KernelInterface readInterface(const ShaderCode& code, std::span<const SpecialisationConstant> constants) {
    const std::vector<std::uint32_t> words = wordsOf(code); // the module refers to them
    const Module module = spirv::parse({code.name, words}, constants);
    checkCapabilities(module);
    if (module.entryPoints != 1)
        module.fail("it has " + std::to_string(module.entryPoints) + " entry points instead of one");
    KernelInterface interface;
    for (const spirv::Variable& variable : module.variables) addVariable(module, variable, interface);
    std::sort(interface.bindings.begin(), interface.bindings.end(),
              [](const KernelBinding& a, const KernelBinding& b) { return a.binding < b.binding; });
    checkBindings(module, interface.bindings);
    readGroupSize(module, interface);
    for (const auto& [id, instruction] : module.constants)
        if (const auto specialisation = module.decoration(id, Decoration::specId))
            interface.specialisationIds.push_back(*specialisation);
    std::sort(interface.specialisationIds.begin(), interface.specialisationIds.end());
    return interface;
}

} // namespace sinew::vk
