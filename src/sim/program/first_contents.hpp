// Initial contents of buffers, for features that depend on uploads of others, and for states that are
// carried.
#pragma once

#include "sim/program/program.hpp"

#include <cstring>

namespace sinew::sim {

/// The initial contents; empty for a buffer that starts with zeros, and for an invalid one.
template <typename T> std::vector<T> firstContents(const StepProgram& program, BufferId buffer) {
    if (buffer == BufferId{}) return {};
    const std::vector<std::byte>& bytes = program.buffers[buffer.index].initial;
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}
template <typename T> std::vector<T> firstContents(ProgramBuilder& program, BufferId buffer) {
    return firstContents<T>(program.program(), buffer);
}

} // namespace sinew::sim
