// Initial contents of buffers of a program under construction, for features that depend on what others have
// uploaded.
#pragma once

#include "sim/program/program.hpp"

#include <cstring>

namespace sinew::sim {

/// The initial contents; empty for a buffer that starts with zeros.
template <typename T> std::vector<T> firstContents(ProgramBuilder& program, BufferId buffer) {
    const std::vector<std::byte>& bytes = program.program().buffers[buffer.index].initial;
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

} // namespace sinew::sim
