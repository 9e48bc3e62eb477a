// The bindings that a kernel uses once its specialisation constants have values, by spirv-opt of SPIR-V
// Tools.
#pragma once

#include "sinew/vk/shader_code.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <set>

namespace sinew::test {

/// The bindings that the kernel may still access with these constants, by id; those without a value keep the
/// default. Empty if spirv-opt is not installed or fails; it then says why on stderr.
std::optional<std::set<std::uint32_t>>
accessedBindings(const vk::ShaderCode& code, const std::map<std::uint32_t, std::uint32_t>& constants);

} // namespace sinew::test
