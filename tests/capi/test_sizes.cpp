// Structs of hosts that were compiled with an earlier header, or with a later one.
#include "sinew/sinew_query.h"

#include "capi/support.hpp"

#include <cstddef>
#include <cstring>

namespace sinew::test {
namespace {

/// A struct with bytes behind it that belong to the host, or to a later version of the struct.
template <typename T> struct Longer {
    T value;
    std::uint32_t behind[4];
};

TEST(CApiSizes, MembersThatAFormerHeaderLacksHaveTheirDefaults) {
    Scene scene;
    makeCube(scene);
    for (const std::size_t size :
         {offsetof(SinewSettings, hasSharpClamp), offsetof(SinewSettings, outputFrames)}) {
        SinewSettings settings = sinewDefaultSettings();
        std::memset(reinterpret_cast<char*>(&settings) + size, 0xff, sizeof settings - size);
        EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_SCENE, "outputFrames", sinewValidate(scene, &settings)));
        settings.size = static_cast<std::uint32_t>(size);
        EXPECT_TRUE(isOk(sinewValidate(scene, &settings)));
    }
}

TEST(CApiSizes, OtherSizesAreRefused) {
    Scene scene;
    makeCube(scene);
    SinewSettings settings = sinewDefaultSettings();
    for (const std::uint32_t size : {0u, 4u, 80u, 99u, 101u, 5000u, 0xffff'ffffu}) {
        settings.size = size;
        EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "this library knows 116, 100, 104, 108",
                              sinewValidate(scene, &settings)))
            << size;
    }
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "the size of SinewSettings is 12",
                          sinewSetDefaults(SINEW_TYPE_SETTINGS, &settings, 12)));
    EXPECT_EQ(settings.size, 0u) << "sinewDefaultSettings() ignores the result";
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "no type 9",
                          sinewSetDefaults(9, &settings, sizeof settings)));
    EXPECT_TRUE(failsWith(SINEW_ERROR_INVALID_ARGUMENT, "null", sinewSetDefaults(0, nullptr, 40)));
}

TEST(CApiSizes, ALaterHeaderMayOnlyAskForWhatThisLibraryKnows) {
    Scene scene;
    makeCube(scene);
    Longer<SinewSettings> settings{};
    settings.behind[1] = 7; // the defaults of what is unknown are 0
    ASSERT_TRUE(isOk(sinewSetDefaults(SINEW_TYPE_SETTINGS, &settings, sizeof settings)));
    EXPECT_EQ(settings.value.size, sizeof settings);
    EXPECT_EQ(settings.value.substeps, sinewDefaultSettings().substeps);
    EXPECT_EQ(settings.behind[1], 0u);
    EXPECT_TRUE(isOk(sinewValidate(scene, &settings.value)));
    settings.behind[3] = 1;
    EXPECT_TRUE(
        failsWith(SINEW_ERROR_INVALID_ARGUMENT, "byte 128 is not 0", sinewValidate(scene, &settings.value)));
}

TEST(CApiSizes, ResultsHaveTheSizeOfTheHost) {
    Scene scene;
    makeCube(scene);
    SinewSettings former;
    std::memset(&former, 0xff, sizeof former);
    former.size = offsetof(SinewSettings, hasSharpClamp);
    ASSERT_TRUE(isOk(sinewGetSceneSettings(scene, &former)));
    EXPECT_EQ(former.size, offsetof(SinewSettings, hasSharpClamp));
    EXPECT_EQ(former.keepsPrevious, 0u);
    EXPECT_EQ(former.hasSharpClamp, 0xffff'ffffu);
    EXPECT_EQ(former.outputFrames, 0xffff'ffffu);

    Longer<SinewSceneCounts> counts;
    std::memset(&counts, 0xff, sizeof counts);
    counts.value.size = sizeof counts;
    ASSERT_TRUE(isOk(sinewGetSceneCounts(scene, &counts.value)));
    EXPECT_EQ(counts.value.size, sizeof counts);
    EXPECT_EQ(counts.value.particles, 27u);
    for (const std::uint32_t word : counts.behind) EXPECT_EQ(word, 0u);
}

} // namespace
} // namespace sinew::test
