// Makes Vulkan functions of a HostDevice fail on request.
#pragma once

#include "support/host_device.hpp"

#include <limits>
#include <string>

namespace sinew::test {

inline constexpr int never = std::numeric_limits<int>::max();

// Global state of the replaced Vulkan functions, which have no user pointer.
struct Fault {
    int callsToGo = never; ///< number of successful calls before the failure
    VkResult result = VK_SUCCESS;
    std::string struck; ///< name of the call that failed
};
inline Fault fault;

template <int Number, typename Function> struct Failing;
template <int Number, typename... Arguments> struct Failing<Number, VkResult(VKAPI_PTR*)(Arguments...)> {
    static inline VkResult(VKAPI_PTR* original)(Arguments...) = nullptr;
    static inline const char* name = nullptr;
    static VkResult VKAPI_CALL call(Arguments... arguments) {
        if (fault.callsToGo-- != 0) return original(arguments...);
        fault.struck = name;
        return fault.result;
    }
};

template <int Number, typename Function> void makeFallible(HostDevice& host, const char* name) {
    using Replaced = Failing<Number, Function>;
    Replaced::original = reinterpret_cast<Function>(host.original(name));
    Replaced::name = name;
    host.replace(name, reinterpret_cast<PFN_vkVoidFunction>(&Replaced::call));
}

#define FALLIBLE(name) makeFallible<__COUNTER__, PFN_##name>(host, #name)

} // namespace sinew::test
