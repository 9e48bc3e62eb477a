// For a build without Jolt.
#include "sinew/cpu_program.hpp"

namespace sinew::tools {

bool hasJolt() {
    return false;
}

std::unique_ptr<CpuProgram> makeJoltBody(const sim::Scene&, std::uint32_t, std::uint32_t) {
    return nullptr;
}

} // namespace sinew::tools
