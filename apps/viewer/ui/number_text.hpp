// Numbers as people type them.
#pragma once

#include <optional>
#include <string_view>

namespace sinew::viewer {

/// The number that `text` names, in `unit`; empty if it names none. Takes "7.5", "7,5" and "7.5 kPa"; lengths
/// (mm, cm, m) and pressures (Pa, kPa, MPa, GPa) are converted, any other unit must be `unit` itself. The
/// unit "x", that of a factor, may also stand before the number.
std::optional<float> numberOf(std::string_view text, std::string_view unit);

} // namespace sinew::viewer
