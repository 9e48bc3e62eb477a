// What buffers of a program that is being made begin with, for who follows from what others have uploaded.
#pragma once

#include "sim/program.hpp"

#include <cstring>

namespace sinew::sim::cutting {

/// Empty for a buffer that begins with zeros.
template <typename T> std::vector<T> firstContents(ProgramBuilder& program, BufferId buffer) {
    const std::vector<std::byte>& bytes = program.program().buffers[buffer.index].initial;
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

} // namespace sinew::sim::cutting
