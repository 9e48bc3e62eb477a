// Results, sentences and the log; handles that are null, stale, of another kind, or in use.
#include "capi/support.hpp"

#include <atomic>
#include <chrono>
#include <thread>

namespace sinew::test {
namespace {

TEST(CApiHandles, NullStaleAndForeignOnesAreDetected) {
    Scene scene;
    ASSERT_TRUE(isOk(sinewCreateScene(&scene)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "null", sinewDestroyScene({0})));
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_HANDLE, "that of a scene", sinewDestroyDevice({scene.handle.id})));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "never given out", sinewDestroyScene({0xffff'ffff})));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "never given out",
                          sinewDestroyScene({scene.handle.id + (std::uint64_t{1} << 32)})));
    SinewScene second{};
    ASSERT_TRUE(isOk(sinewCreateScene(&second)));
    ASSERT_TRUE(isOk(sinewDestroyScene(second)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "destroyed", sinewDestroyScene(second)));
    SinewScene third{}; // takes the place of the second one
    ASSERT_TRUE(isOk(sinewCreateScene(&third)));
    EXPECT_NE(third.id, second.id);
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_HANDLE, "destroyed", sinewAddFixed(second, 0, nullptr)));
    EXPECT_TRUE(isOk(sinewDestroyScene(third)));
}

TEST(CApiHandles, ADeviceOutlivesItsSimulations) {
    Log log;
    Device device;
    makeDevice(device);
    Scene scene;
    makeCube(scene);
    const SinewSettings settings = sinewDefaultSettings();
    SinewSimulation simulation{};
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &simulation)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_IN_USE, "1 simulation", sinewDestroyDevice(device)));
    EXPECT_TRUE(isOk(sinewDestroyScene(scene))); // was copied
    EXPECT_TRUE(isOk(sinewDestroySimulation(simulation)));
    EXPECT_TRUE(isOk(sinewDestroyDevice(device)));
    EXPECT_EQ(log.warnings, std::vector<std::string>{});
    EXPECT_EQ(log.errors.size(), 1u);
    EXPECT_EQ(log.notes.size(), 1u);
}

// The log is called inside of a call that reads the scene.
struct Intruder {
    SinewScene scene;
    SinewResult writing = SINEW_OK, reading = SINEW_ERROR_INTERNAL;
    std::string sentence;
    static void add(void* user, uint32_t severity, const char*) {
        if (severity != SINEW_LOG_WARNING) return;
        auto& intruder = *static_cast<Intruder*>(user);
        std::thread([&] {
            intruder.writing = sinewDestroyScene(intruder.scene);
            intruder.sentence = sinewLastError();
            SinewSceneCounts counts{};
            counts.size = sizeof counts;
            intruder.reading = sinewGetSceneCounts(intruder.scene, &counts);
        }).join();
    }
};

TEST(CApiHandles, ASecondThreadMayReadAndNotDestroyWhatIsRead) {
    Device device;
    makeDevice(device);
    Scene scene;
    makeCube(scene, 1, 3e3f); // so high that there is a warning about it
    Intruder intruder{.scene = scene};
    sinewSetLog(&Intruder::add, &intruder);
    const SinewSettings settings = sinewDefaultSettings();
    Simulation simulation;
    const SinewResult result = sinewCreateSimulation(device, scene, &settings, &simulation);
    sinewSetLog(nullptr, nullptr);
    EXPECT_TRUE(isOk(result));
    EXPECT_EQ(intruder.writing, SINEW_ERROR_IN_USE) << intruder.sentence;
    EXPECT_EQ(intruder.reading, SINEW_OK);
}

TEST(CApiHandles, TwoThreadsCannotUseOneSimulationAtATime) {
    Device device;
    makeDevice(device);
    Scene scene;
    makeCube(scene, 4);
    const SinewSettings settings = sinewDefaultSettings();
    Simulation simulation;
    ASSERT_TRUE(isOk(sinewCreateSimulation(device, scene, &settings, &simulation)));
    const SinewStep step = sinewDefaultStep();
    std::atomic<bool> isOver = false;
    std::atomic<int> stepped = SINEW_OK; // of the other thread, which is refused where this one was first
    std::thread other([&] {
        while (!isOver)
            if (const SinewResult result = sinewStep(simulation, &step, 64); result != SINEW_ERROR_IN_USE)
                stepped = result;
    });
    bool isRefused = false;
    for (int i = 0; i < 5000 && !isRefused; ++i) { // the other one works nearly all of the time
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        SinewSimulationInfo info{};
        info.size = sizeof info;
        const SinewResult result = sinewGetSimulationInfo(simulation, &info);
        EXPECT_TRUE(result == SINEW_OK || result == SINEW_ERROR_IN_USE) << sinewLastError();
        isRefused = result == SINEW_ERROR_IN_USE;
    }
    isOver = true;
    other.join();
    EXPECT_TRUE(isRefused);
    EXPECT_EQ(stepped, SINEW_OK);
}

TEST(CApiErrors, ResultsHaveNamesAndEachThreadItsSentence) {
    EXPECT_STREQ(sinewResultName(SINEW_OK), "SINEW_OK");
    EXPECT_STREQ(sinewResultName(SINEW_ERROR_INTERNAL), "SINEW_ERROR_INTERNAL");
    EXPECT_STREQ(sinewResultName(-13), "unknown result");
    sinewDestroyScene({0});
    EXPECT_STREQ(sinewLastError(), "sinewDestroyScene: the handle of the scene is null");
    std::string ofOther = "unset";
    std::thread([&] { ofOther = sinewLastError(); }).join();
    EXPECT_EQ(ofOther, "");
    EXPECT_GE(sinewVersion(), 1u << 12);
}

TEST(CApiErrors, NullAndWrongSizesAreRefused) {
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "scene is null", sinewCreateScene(nullptr)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "null", sinewCreateDevice(nullptr, nullptr)));
    SinewDeviceRequest request = sinewDefaultDeviceRequest();
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_ARGUMENT, "device is null", sinewCreateDevice(&request, nullptr)));
    SinewDevice device{};
    request.size = 12;
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "is 12", sinewCreateDevice(&request, &device)));
    request = sinewDefaultDeviceRequest();
    request.device = "no such device";
    EXPECT_TRUE(failsWith(SINEW_ERROR_NO_DEVICE, "no such device", sinewCreateDevice(&request, &device)));
    request.isSoftware = 1;
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "one of both", sinewCreateDevice(&request, &device)));
    SinewHostDevice host = sinewDefaultHostDevice();
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_ARGUMENT, "getInstanceProcAddr", sinewBorrowDevice(&host, &device)));
    EXPECT_EQ(device.id, 0u);
}

TEST(CApiDevice, PipelinesGoOutAndComeIn) {
    Log log;
    SinewDeviceRequest request = sinewDefaultDeviceRequest();
    std::vector<char> bytes;
    {
        Device device;
        makeDevice(device);
        SinewDeviceInfo info{};
        info.size = sizeof info;
        ASSERT_TRUE(isOk(sinewGetDeviceInfo(device, &info)));
        EXPECT_EQ(info.isSoftware, 1u);
        EXPECT_EQ(info.hasQueue, 1u);
        EXPECT_NE(info.device, VkDevice{VK_NULL_HANDLE});
        EXPECT_NE(std::string(info.name).find("llvmpipe"), std::string::npos) << info.name;
        std::size_t size = 0;
        ASSERT_TRUE(isOk(sinewGetPipelineCache(device, &size, nullptr)));
        ASSERT_GT(size, 0u);
        bytes.resize(size);
        size = 1;
        EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "room for 1",
                              sinewGetPipelineCache(device, &size, bytes.data())));
        size = bytes.size();
        ASSERT_TRUE(isOk(sinewGetPipelineCache(device, &size, bytes.data())));
    }
    request.pipelineCache = bytes.data();
    request.pipelineCacheSize = bytes.size();
    request.isSoftware = 1;
    request.hasValidation = 1;
    Device again;
    EXPECT_TRUE(isOk(sinewCreateDevice(&request, &again)));
    EXPECT_EQ(log.warnings, std::vector<std::string>{});
}

} // namespace
} // namespace sinew::test
