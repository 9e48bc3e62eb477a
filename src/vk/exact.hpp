// One arithmetic on every device: kernels whose sums and products no compiler fuses.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sinew::vk {

/// `module` (SPIR-V) with every operation on floats decorated NoContraction. A compiler may otherwise fuse a
/// product and a sum, and not alike in each copy of a loop that it unrolls: then a result depends on where in
/// a list its terms stand.
std::vector<std::uint32_t> withoutContraction(std::span<const std::uint32_t> module);

} // namespace sinew::vk
