// Tests of the device selection from the window's list.
#include "viewer/jobs/devices.hpp"

#include <gtest/gtest.h>

namespace sinew::viewer {
namespace {

std::vector<vk::DeviceDescription> called(const std::vector<std::string>& names) {
    std::vector<vk::DeviceDescription> devices;
    for (const std::string& name : names)
        devices.push_back({.index = static_cast<std::uint32_t>(devices.size()), .name = name});
    return devices;
}

TEST(Devices, AreAskedForByNameWhereItTellsThemApart) {
    const auto devices = called({"GeForce", "llvmpipe (LLVM 15)"});
    EXPECT_EQ(requestFor(devices, 0), "GeForce");
    EXPECT_EQ(requestFor(devices, 1), "llvmpipe (LLVM 15)");
}

TEST(Devices, AreAskedForByIndexWhereNamesAreAlike) {
    const auto devices = called({"llvmpipe", "GeForce", "llvmpipe", "GeForce RTX"});
    EXPECT_EQ(requestFor(devices, 0), "0");
    EXPECT_EQ(requestFor(devices, 2), "2");
    EXPECT_EQ(requestFor(devices, 1), "1") << "a part of a name finds the longer one too";
    EXPECT_EQ(requestFor(devices, 3), "GeForce RTX");
}

} // namespace
} // namespace sinew::viewer
