// Makes Vulkan functions of a HostDevice fail when a test says so.
#pragma once

#include "support/host_device.hpp"

#include <limits>
#include <string>

namespace sinew::test {

inline constexpr int never = std::numeric_limits<int>::max();

// Vulkan's entry points carry no user pointer.
struct Fault {
    int callsToGo = never; ///< succeed before the one that fails
    VkResult result = VK_SUCCESS;
    std::string struck; ///< the call that failed
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
