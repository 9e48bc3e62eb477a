// Parsing of SPIR-V words into a Module, and sizes of its types.
#include "vk/spirv_module.hpp"

#include <algorithm>

namespace sinew::vk::spirv {

namespace {

constexpr std::uint32_t magic = 0x07230203, headerWords = 5;
constexpr std::uint32_t compositeExtract = 81; ///< inside OpSpecConstantOp

bool isExtract(std::span<const std::uint32_t> specConstantOp) {
    return specConstantOp[2] == compositeExtract;
}

std::string literalString(std::span<const std::uint32_t> words) {
    std::string text;
    for (const std::uint32_t word : words)
        for (int shift = 0; shift < 32; shift += 8) {
            const char letter = static_cast<char>(word >> shift & 0xff);
            if (letter == 0) return text;
            text += letter;
        }
    return text;
}

/// Least number of operands of every instruction that is read.
std::size_t leastOperands(Op op) {
    switch (op) {
    case Op::capability:
    case Op::typeVoid:
    case Op::typeBool:
    case Op::typeStruct:
        return 1;
    case Op::name:
    case Op::executionMode:
    case Op::executionModeId:
    case Op::typeFloat:
    case Op::typeSampledImage:
    case Op::typeRuntimeArray:
    case Op::decorate:
    case Op::constantTrue:
    case Op::constantFalse:
    case Op::constantComposite:
    case Op::specConstantTrue:
    case Op::specConstantFalse:
    case Op::specConstantComposite:
        return 2;
    case Op::entryPoint:
    case Op::typeInt:
    case Op::typeVector:
    case Op::typeMatrix:
    case Op::typeArray:
    case Op::typePointer:
    case Op::constant:
    case Op::specConstant:
    case Op::specConstantOp:
    case Op::variable:
    case Op::memberDecorate:
        return 3;
    case Op::typeImage:
        return 8;
    case Op::function:
        break;
    }
    return 0;
}

/// Throws unless the operands of an instruction are declared before it, so that no type or constant contains
/// itself.
void checkOrder(const Module& module, const Instruction& instruction) {
    const auto& operands = instruction.operands;
    std::span<const std::uint32_t> types, constants;
    switch (instruction.op) {
    case Op::typeVector:
    case Op::typeMatrix:
    case Op::typeImage:
    case Op::typeSampledImage:
    case Op::typeRuntimeArray:
        types = operands.subspan(1, 1);
        break;
    case Op::typeArray:
        types = operands.subspan(1, 1);
        constants = operands.subspan(2, 1);
        break;
    case Op::typeStruct:
        types = operands.subspan(1);
        break;
    case Op::constantComposite:
    case Op::specConstantComposite:
        constants = operands.subspan(2);
        break;
    case Op::specConstantOp:
        constants =
            operands.subspan(3, std::min<std::size_t>(operands.size() - 3, isExtract(operands) ? 1 : 2));
        break;
    default:
        break;
    }
    const bool isOrdered = std::all_of(types.begin(), types.end(),
                                       [&](std::uint32_t id) { return module.types.contains(id); }) &&
                           std::all_of(constants.begin(), constants.end(),
                                       [&](std::uint32_t id) { return module.constants.contains(id); });
    if (!isOrdered) module.fail("it uses a type or a constant before it is declared");
}

template <typename Map>
void declare(Module& module, Map& map, std::uint32_t id, const Instruction& instruction) {
    checkOrder(module, instruction);
    if (!map.emplace(id, instruction).second) module.fail(module.nameOf(id) + " is declared twice");
}

void readDecoration(Module& module, const Instruction& instruction) {
    const auto& operands = instruction.operands;
    if (instruction.op == Op::decorate) {
        module.decorations[operands[0]][Decoration{operands[1]}] = operands.size() > 2 ? operands[2] : 0;
    } else {
        const std::uint32_t literal = operands.size() > 3 ? operands[3] : 0;
        module.memberDecorations[operands[0]][operands[1]][Decoration{operands[2]}] = literal;
    }
}

void readEntryPoint(Module& module, const Instruction& instruction) {
    constexpr std::uint32_t glCompute = 5, localSize = 17, localSizeId = 38;
    const auto& operands = instruction.operands;
    if (instruction.op == Op::entryPoint) {
        ++module.entryPoints;
        if (operands[0] != glCompute || literalString(operands.subspan(2)) != "main")
            module.fail("its entry point is no compute shader called main");
    } else if (operands[1] == localSizeId) {
        module.fail(
            "it gives its group size by LocalSizeId, which is an optional feature: compile for vulkan1.2");
    } else if (instruction.op == Op::executionMode && operands[1] == localSize) {
        if (operands.size() < 5) module.fail("its group size is truncated");
        std::copy_n(operands.begin() + 2, 3, module.localSize.begin());
    }
}

void read(Module& module, const Instruction& instruction) {
    const auto& operands = instruction.operands;
    switch (instruction.op) {
    case Op::name:
        module.names[operands[0]] = literalString(operands.subspan(1));
        break;
    case Op::entryPoint:
    case Op::executionMode:
    case Op::executionModeId:
        readEntryPoint(module, instruction);
        break;
    case Op::capability:
        module.capabilities.push_back(operands[0]);
        break;
    case Op::decorate:
    case Op::memberDecorate:
        readDecoration(module, instruction);
        break;
    case Op::typeVoid:
    case Op::typeBool:
    case Op::typeInt:
    case Op::typeFloat:
    case Op::typeVector:
    case Op::typeMatrix:
    case Op::typeImage:
    case Op::typeSampledImage:
    case Op::typeArray:
    case Op::typeRuntimeArray:
    case Op::typeStruct:
    case Op::typePointer:
        declare(module, module.types, operands[0], instruction);
        break;
    case Op::constantTrue:
    case Op::constantFalse:
    case Op::constant:
    case Op::constantComposite:
    case Op::specConstantTrue:
    case Op::specConstantFalse:
    case Op::specConstant:
    case Op::specConstantComposite:
    case Op::specConstantOp:
        declare(module, module.constants, operands[1], instruction);
        break;
    case Op::variable:
        module.variables.push_back({operands[1], operands[0], Storage{operands[2]}});
        break;
    case Op::function:
        break;
    }
}

std::uint32_t roundUp(std::uint32_t size, std::uint32_t alignment) {
    return (size + alignment - 1) / alignment * alignment;
}

} // namespace

Module parse(const ShaderCode& code, std::span<const SpecialisationConstant> constants) {
    Module module{.shader = code.name, .specialised = constants};
    if (code.words.size() < headerWords || code.words[0] != magic) module.fail("it is no SPIR-V");
    for (std::size_t at = headerWords; at < code.words.size();) {
        const std::size_t length = code.words[at] >> 16;
        if (length == 0 || at + length > code.words.size()) module.fail("the module is truncated");
        const Instruction instruction{Op(code.words[at] & 0xffff), code.words.subspan(at + 1, length - 1)};
        if (instruction.operands.size() < leastOperands(instruction.op))
            module.fail("the module is truncated");
        if (instruction.op == Op::function)
            return module; // interfaces are complete before the first function
        read(module, instruction);
        at += length;
    }
    module.fail("the module is truncated: it has no function");
}

std::string Module::nameOf(std::uint32_t id) const {
    const auto found = names.find(id);
    return found == names.end() ? std::string("%").append(std::to_string(id)) : found->second;
}

const Instruction& Module::type(std::uint32_t id) const {
    const auto found = types.find(id);
    if (found == types.end()) fail(nameOf(id) + " is a type that kernels do not use");
    return found->second;
}

std::optional<std::uint32_t> Module::decoration(std::uint32_t id, Decoration wanted) const {
    const auto found = decorations.find(id);
    if (found == decorations.end() || !found->second.contains(wanted)) return std::nullopt;
    return found->second.at(wanted);
}

std::optional<std::uint32_t> Module::memberDecoration(std::uint32_t id, std::uint32_t member,
                                                      Decoration wanted) const {
    const auto found = memberDecorations.find(id);
    if (found == memberDecorations.end() || !found->second.contains(member) ||
        !found->second.at(member).contains(wanted))
        return std::nullopt;
    return found->second.at(member).at(wanted);
}

std::uint32_t Module::constituent(std::uint32_t constant, std::uint32_t index) const {
    const auto found = constants.find(constant);
    if (found == constants.end() || found->second.operands.size() <= 2 + index ||
        (found->second.op != Op::constantComposite && found->second.op != Op::specConstantComposite))
        fail(nameOf(constant) + " is no composite constant");
    return found->second.operands[2 + index];
}

const SpecialisationConstant* Module::specialisation(std::uint32_t constant) const {
    const auto id = decoration(constant, Decoration::specId);
    const auto found = std::ranges::find_if(specialised, [&](const auto& one) { return one.id == id; });
    return found == specialised.end() ? nullptr : &*found;
}

std::uint32_t Module::value(std::uint32_t constant) const {
    if (const SpecialisationConstant* given = specialisation(constant)) return given->value;
    const auto found = constants.find(constant);
    if (found == constants.end()) fail(nameOf(constant) + " is no constant");
    switch (found->second.op) {
    case Op::constantTrue:
    case Op::specConstantTrue:
        return 1;
    case Op::constantFalse:
    case Op::specConstantFalse:
        return 0;
    case Op::constant:
    case Op::specConstant:
        return found->second.operands[2];
    case Op::specConstantOp:
        return operation(found->second);
    default:
        fail(nameOf(constant) + " is no scalar constant");
    }
}

std::uint32_t Module::operation(const Instruction& instruction) const {
    constexpr std::uint32_t add = 128, subtract = 130, multiply = 132, divide = 134;
    const auto& operands = instruction.operands; // type, result, opcode, arguments
    if (operands.size() < 5) fail("a specialisation constant operation is truncated");
    if (isExtract(operands)) return value(constituent(operands[3], operands[4]));
    const std::uint32_t a = value(operands[3]), b = value(operands[4]);
    switch (operands[2]) {
    case add:
        return a + b;
    case subtract:
        return a - b;
    case multiply:
        return a * b;
    case divide:
        return b == 0 ? 0 : a / b;
    default:
        fail("an array length uses the opcode " + std::to_string(operands[2]) + ", which is not known here");
    }
}

std::uint32_t Module::alignment(std::uint32_t id) const {
    const Instruction& instruction = type(id);
    const auto& operands = instruction.operands;
    switch (instruction.op) {
    case Op::typeVector:
        return std::max(size(operands[1]), 1u) * (operands[2] == 2 ? 2 : 4);
    case Op::typeMatrix:
    case Op::typeArray:
    case Op::typeRuntimeArray:
        return alignment(operands[1]);
    case Op::typeStruct: {
        std::uint32_t largest = 1;
        for (const std::uint32_t member : operands.subspan(1)) largest = std::max(largest, alignment(member));
        return largest;
    }
    default:
        return std::max(size(id), 1u); // a damaged type may have no bits
    }
}

std::uint32_t Module::size(std::uint32_t id) const {
    const Instruction& instruction = type(id);
    const auto& operands = instruction.operands;
    switch (instruction.op) {
    case Op::typeBool: // only in shared memory
        return 4;
    case Op::typeInt:
    case Op::typeFloat:
        return operands[1] / 8;
    case Op::typeVector:
        return operands[2] * size(operands[1]);
    case Op::typeMatrix:
        return operands[2] * roundUp(size(operands[1]), alignment(operands[1]));
    case Op::typeArray: {
        const std::uint32_t packed = roundUp(size(operands[1]), alignment(operands[1]));
        return value(operands[2]) * decoration(id, Decoration::arrayStride).value_or(packed);
    }
    case Op::typeStruct:
        return structSize(id);
    default:
        fail(nameOf(id) + " is a type without a size");
    }
}

std::uint32_t Module::structSize(std::uint32_t id) const {
    std::uint32_t end = 0, index = 0;
    for (const std::uint32_t member : type(id).operands.subspan(1)) {
        if (memberDecoration(id, index, Decoration::rowMajor))
            fail("member " + std::to_string(index) + " of " + nameOf(id) + " is a row-major matrix");
        const std::uint32_t packed = roundUp(end, alignment(member));
        const std::uint32_t offset = memberDecoration(id, index, Decoration::offset).value_or(packed);
        end = std::max(end, offset + size(member));
        ++index;
    }
    return roundUp(end, alignment(id));
}

} // namespace sinew::vk::spirv
