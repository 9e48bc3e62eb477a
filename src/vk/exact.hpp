// Sums and products of numbers that are the same bits on every device: no compiler may fuse them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sinew::vk {

/// `module` (SPIR-V) with every sum, difference, product, quotient and remainder of floats decorated
/// NoContraction. A compiler may otherwise fuse a product and a sum, and not alike in each copy of a loop
/// that it unrolls: then a result depends on where in a list its terms stand. How exact a quotient or a root
/// is, and extended instructions such as length(), stay the driver's.
std::vector<std::uint32_t> withoutContraction(std::span<const std::uint32_t> module);

} // namespace sinew::vk
