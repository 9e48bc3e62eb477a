// Decorations are inserted at their place in a module: before its types.
#include "vk/exact.hpp"

#include <algorithm>
#include <set>

namespace sinew::vk {

namespace {

constexpr std::uint32_t header = 5, opDecorate = 71, noContraction = 42;

/// True from OpTypeVoid to OpSpecConstantOp, after which no decoration may follow.
bool isTypeOrConstant(std::uint32_t op) {
    return op >= 19 && op <= 52;
}

/// True for OpFAdd, OpFSub, OpFMul, OpFDiv, OpFRem, OpFMod, and the products of vectors and matrices up to
/// OpDot.
bool isOnFloats(std::uint32_t op) {
    return op == 129 || op == 131 || op == 133 || op == 136 || op == 140 || (op >= 141 && op <= 148);
}

} // namespace

std::vector<std::uint32_t> withoutContraction(std::span<const std::uint32_t> module) {
    std::vector<std::uint32_t> results;
    std::set<std::uint32_t> decorated;
    std::size_t types = module.size();
    for (std::size_t at = header; at < module.size(); at += std::max(module[at] >> 16, 1u)) {
        const std::uint32_t op = module[at] & 0xffff;
        if (op == opDecorate && module[at + 2] == noContraction) decorated.insert(module[at + 1]);
        if (isTypeOrConstant(op)) types = std::min(types, at);
        if (isOnFloats(op)) results.push_back(module[at + 2]);
    }
    std::vector<std::uint32_t> exact(module.begin(), module.begin() + static_cast<std::ptrdiff_t>(types));
    for (const std::uint32_t result : results)
        if (!decorated.contains(result))
            exact.insert(exact.end(), {3u << 16 | opDecorate, result, noContraction});
    exact.insert(exact.end(), module.begin() + static_cast<std::ptrdiff_t>(types), module.end());
    return exact;
}

} // namespace sinew::vk
