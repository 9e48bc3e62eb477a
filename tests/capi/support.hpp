// Objects of the C interface for tests, destroyed at the end of a scope.
#pragma once

#include "sinew/sinew.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace sinew::test {

/// Fails the test with the sentence of the library unless `result` is SINEW_OK.
inline ::testing::AssertionResult isOk(SinewResult result) {
    if (result == SINEW_OK) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << sinewResultName(result) << ": " << sinewLastError();
}

/// Checks the result of a call that fails, and that its sentence contains `part`.
inline ::testing::AssertionResult failsWith(SinewResult expected, const std::string& part,
                                            SinewResult result) {
    const std::string sentence = sinewLastError();
    if (result == expected && sentence.find(part) != std::string::npos) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << sinewResultName(result) << ": " << sentence << "; expected "
                                         << sinewResultName(expected) << " with \"" << part << "\"";
}

/// A handle that its scope destroys. Destroying a handle that is destroyed already fails and does nothing.
template <typename Handle, SinewResult (*destroy)(Handle)> struct Owned {
    Owned() = default;
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;
    ~Owned() {
        if (handle.id != 0) destroy(handle);
    }
    operator Handle() const { return handle; }
    Handle* operator&() { return &handle; }
    Handle handle{};
};
using Device = Owned<SinewDevice, sinewDestroyDevice>;
using Scene = Owned<SinewScene, sinewDestroyScene>;
using Simulation = Owned<SinewSimulation, sinewDestroySimulation>;
using State = Owned<SinewState, sinewDestroyState>;

/// Sentences that the log of the process got, in its scope.
class Log {
public:
    Log() { sinewSetLog(&Log::add, this); }
    ~Log() { sinewSetLog(nullptr, nullptr); }
    Log(const Log&) = delete;
    Log& operator=(const Log&) = delete;
    std::vector<std::string> warnings, errors, notes;

private:
    static void add(void* user, uint32_t severity, const char* sentence) {
        Log& log = *static_cast<Log*>(user);
        (severity == SINEW_LOG_ERROR     ? log.errors
         : severity == SINEW_LOG_WARNING ? log.warnings
                                         : log.notes)
            .push_back(sentence);
    }
};

/// A software device under validation; the log gets its messages.
inline void makeDevice(Device& device) {
    SinewDeviceRequest request = sinewDefaultDeviceRequest();
    request.isSoftware = 1;
    request.hasValidation = 1;
    ASSERT_TRUE(isOk(sinewCreateDevice(&request, &device)));
}

/// Tests on a device of their own, which must leave no warning of the validation layer, leaks included.
class OnDevice : public ::testing::Test {
protected:
    void SetUp() override { makeDevice(device); }
    void TearDown() override {
        if (device.handle.id != 0) {
            EXPECT_TRUE(isOk(sinewDestroyDevice(device)));
            device.handle.id = 0;
        }
        EXPECT_EQ(log.warnings, std::vector<std::string>{});
    }
    Log log;
    Device device;
};

/// A scene with a cube of `side` cells of 0.1 m on each side, over a floor.
inline void makeCube(Scene& scene, std::uint32_t side = 2, float height = 0.2f, bool isCuttable = false) {
    ASSERT_TRUE(isOk(sinewCreateScene(&scene)));
    SinewLattice lattice = sinewDefaultLattice();
    lattice.name = "cube";
    for (std::uint32_t& cells : lattice.cells) cells = side;
    lattice.origin = {0, height, 0};
    lattice.hasSkin = 1;
    lattice.isCuttable = isCuttable ? 1 : 0;
    ASSERT_TRUE(isOk(sinewAddLattice(scene, &lattice, nullptr)));
    const SinewPlane plane = sinewDefaultPlane();
    ASSERT_TRUE(isOk(sinewAddPlane(scene, &plane)));
}

inline std::vector<std::array<float, 4>> download(SinewDevice device, SinewSimulation simulation,
                                                  std::uint32_t output) {
    SinewBufferView view{};
    EXPECT_TRUE(isOk(sinewGetView(simulation, output, &view)));
    std::vector<std::array<float, 4>> elements(view.size / 16);
    EXPECT_TRUE(isOk(sinewDownload(device, &view, elements.size() * 16, elements.data())));
    return elements;
}

} // namespace sinew::test
