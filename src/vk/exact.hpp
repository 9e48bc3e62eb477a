// Sums and products of floats with equal bits on every device: forbids compilers to fuse them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sinew::vk {

/// `module` (SPIR-V) with every sum, difference, product, quotient and remainder of floats decorated
/// NoContraction. Otherwise a compiler may fuse a product and a sum, and differently in each copy of a loop
/// that it unrolls: then a result depends on the positions of its terms in a list. The precision of
/// quotients, roots and extended instructions such as length() still depends on the driver.
std::vector<std::uint32_t> withoutContraction(std::span<const std::uint32_t> module);

} // namespace sinew::vk
