// The edge of the C interface: every function runs in call(), through which no exception leaves.
#pragma once

#include "capi/handles.hpp"

#include <string>

namespace sinew::capi {

/// For use in a handler: notes the current exception as the failure of `function`, and returns its result.
/// `invalid` is the result of std::invalid_argument and std::domain_error.
SinewResult failed(const char* function, SinewResult invalid) noexcept;

/// Runs `body`, which returns a SinewResult or nothing.
template <typename Body>
SinewResult call(const char* function, Body&& body,
                 SinewResult invalid = SINEW_ERROR_INVALID_ARGUMENT) noexcept {
    try {
        if constexpr (std::is_void_v<decltype(body())>) {
            body();
            return SINEW_OK;
        } else {
            return body();
        }
    } catch (...) {
        return failed(function, invalid);
    }
}

/// Gives a sentence to the log of the process.
void log(std::uint32_t severity, const std::string& sentence) noexcept;

[[noreturn]] void invalidArgument(const std::string& sentence);

/// Throws unless `pointer` is not null; `name` is that of the parameter.
void requireNotNull(const void* pointer, const char* name);
/// Throws if there are elements and no pointer to them.
void requireArray(const void* pointer, std::size_t count, const char* name);

} // namespace sinew::capi
