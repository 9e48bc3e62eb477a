// Results, the last sentence of each thread, and the log.
#include "capi/call.hpp"

#include "sinew/vk/check.hpp"

#include <cstdio>
#include <cstring>
#include <mutex>
#include <new>
#include <stdexcept>

namespace sinew::capi {

namespace {

// Has a fixed size, so that a lack of memory can be told too.
thread_local char lastError[8192] = "";

struct Log {
    SinewLog write = nullptr;
    void* user = nullptr;
};
constinit std::mutex logMutex; // guards theLog
constinit Log theLog;

Log currentLog() noexcept {
    const std::lock_guard lock(logMutex);
    return theLog;
}

void write(std::uint32_t severity, const char* sentence) noexcept {
    const Log current = currentLog();
    if (current.write == nullptr) return;
    try { // a log written in C++ must not throw, and nothing may leave this interface
        current.write(current.user, severity, sentence);
    } catch (...) {
    }
}

SinewResult note(const char* function, SinewResult result, const char* sentence) noexcept {
    const int length = std::snprintf(lastError, sizeof lastError, "%s: %s", function, sentence);
    if (length >= static_cast<int>(sizeof lastError)) std::strcpy(lastError + sizeof lastError - 5, " ...");
    write(SINEW_LOG_ERROR, lastError);
    return result;
}

SinewResult resultOf(vk::Failure failure) {
    switch (failure) {
    case vk::Failure::noDevice:
        return SINEW_ERROR_NO_DEVICE;
    case vk::Failure::outOfMemory:
        return SINEW_ERROR_OUT_OF_MEMORY;
    case vk::Failure::deviceLost:
        return SINEW_ERROR_DEVICE_LOST;
    case vk::Failure::misuse:
        break;
    }
    return SINEW_ERROR_INVALID_ARGUMENT;
}

} // namespace

SinewResult failed(const char* function, SinewResult invalid) noexcept {
    try {
        throw;
    } catch (const Failed& failure) {
        return note(function, failure.result, failure.sentence.c_str());
    } catch (const vk::Error& error) {
        return note(function, resultOf(error.failure()), error.what());
    } catch (const std::bad_alloc&) {
        return note(function, SINEW_ERROR_OUT_OF_MEMORY, "the host has no memory for it");
    } catch (const std::length_error& error) {
        return note(function, SINEW_ERROR_INVALID_ARGUMENT, error.what());
    } catch (const std::invalid_argument& error) {
        return note(function, invalid, error.what());
    } catch (const std::domain_error& error) {
        return note(function, invalid, error.what());
    } catch (const std::exception& error) {
        return note(function, SINEW_ERROR_INTERNAL, error.what());
    } catch (...) {
        return note(function, SINEW_ERROR_INTERNAL, "unknown exception");
    }
}

void log(std::uint32_t severity, const std::string& sentence) noexcept {
    write(severity, sentence.c_str());
}

void invalidArgument(const std::string& sentence) {
    throw Failed{SINEW_ERROR_INVALID_ARGUMENT, sentence};
}

void requireNotNull(const void* pointer, const char* name) {
    if (pointer == nullptr) invalidArgument(std::string(name) + " is null");
}

void requireArray(const void* pointer, std::size_t count, const char* name) {
    if (pointer == nullptr && count > 0)
        invalidArgument(std::string(name) + " is null, but there are " + std::to_string(count) + " elements");
}

} // namespace sinew::capi

using namespace sinew;

extern "C" {

uint32_t sinewVersion(void) {
    return SINEW_MAJOR << 22 | SINEW_MINOR << 12 | SINEW_PATCH;
}

const char* sinewResultName(SinewResult result) {
    switch (result) {
#define SINEW_NAME(name)                                                                                     \
    case name:                                                                                               \
        return #name;
        SINEW_NAME(SINEW_OK)
        SINEW_NAME(SINEW_NOT_READY)
        SINEW_NAME(SINEW_END)
        SINEW_NAME(SINEW_ERROR_INVALID_ARGUMENT)
        SINEW_NAME(SINEW_ERROR_INVALID_HANDLE)
        SINEW_NAME(SINEW_ERROR_IN_USE)
        SINEW_NAME(SINEW_ERROR_INVALID_SCENE)
        SINEW_NAME(SINEW_ERROR_NO_DEVICE)
        SINEW_NAME(SINEW_ERROR_OUT_OF_MEMORY)
        SINEW_NAME(SINEW_ERROR_DEVICE_LOST)
        SINEW_NAME(SINEW_ERROR_FILE)
        SINEW_NAME(SINEW_ERROR_UNSUPPORTED)
        SINEW_NAME(SINEW_ERROR_MISMATCH)
        SINEW_NAME(SINEW_ERROR_DIVERGED)
        SINEW_NAME(SINEW_ERROR_INTERNAL)
#undef SINEW_NAME
    default:
        return "unknown result";
    }
}

const char* sinewLastError(void) {
    return capi::lastError;
}

SinewResult sinewSetLog(SinewLog log, void* user) {
    const std::lock_guard lock(capi::logMutex);
    capi::theLog = {log, user};
    return SINEW_OK;
}

} // extern "C"
