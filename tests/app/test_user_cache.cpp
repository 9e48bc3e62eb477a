// Tests of what the programs keep between runs: it comes back whole or not at all, and only where it applies.
#include "app/kept_forms.hpp"
#include "app/kept_pipelines.hpp"
#include "app/user_cache.hpp"
#include "scenes/load.hpp"
#include "sinew/bodies.hpp"
#include "sinew/vk/kernel_store.hpp"
#include "sinew/vk/loader.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace fs = std::filesystem;
using namespace sinew;
using app::UserCache;

namespace {

std::vector<std::byte> bytesOf(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

class Cache : public testing::Test {
protected:
    Cache() {
        std::string name = (fs::temp_directory_path() / "sinew-cache-XXXXXX").string();
        folder = ::mkdtemp(name.data());
    }
    ~Cache() override { fs::remove_all(folder); }

    std::vector<fs::path> files() const {
        std::vector<fs::path> found;
        for (const auto& entry : fs::directory_iterator(folder)) found.push_back(entry.path());
        return found;
    }

    static std::string contents(const fs::path& file) {
        std::ifstream stream(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    static void write(const fs::path& file, const std::string& text) {
        std::ofstream(file, std::ios::binary) << text;
    }

    fs::path folder;
};

} // namespace

TEST_F(Cache, IsTheUsersFolderOrTheOneAskedForOrNone) {
    EXPECT_EQ(app::cacheFolder(nullptr, "/x", "/home/a"), "/x/sinew");
    EXPECT_EQ(app::cacheFolder(nullptr, "relative", "/home/a"), "/home/a/.cache/sinew");
    EXPECT_EQ(app::cacheFolder(nullptr, nullptr, "/home/a"), "/home/a/.cache/sinew");
    EXPECT_EQ(app::cacheFolder("/mine", "/x", "/home/a"), "/mine");
    EXPECT_EQ(app::cacheFolder("off", "/x", "/home/a"), "");
    EXPECT_EQ(app::cacheFolder("", "/x", "/home/a"), "/x/sinew");
    EXPECT_EQ(app::cacheFolder(nullptr, nullptr, "here"), "");
}

TEST_F(Cache, GivesBackWholeBytesUnderTheirKeyAlone) {
    const UserCache cache(folder / "made");
    EXPECT_TRUE(cache.find("a", "key").empty());
    cache.keep("a", "key", bytesOf("12345"));
    EXPECT_EQ(cache.find("a", "key"), bytesOf("12345"));
    EXPECT_TRUE(cache.find("a", "another").empty());
    EXPECT_TRUE(cache.find("b", "key").empty());
    cache.keep("a", "key", bytesOf("6"));
    EXPECT_EQ(cache.find("a", "key"), bytesOf("6"));
    UserCache(fs::path()).keep("a", "key", bytesOf("1"));
    EXPECT_TRUE(UserCache(fs::path()).find("a", "key").empty());
}

TEST_F(Cache, TakesADamagedOrForeignFileForNone) {
    const UserCache cache(folder);
    cache.keep("a", "key", bytesOf("12345"));
    const fs::path file = files().at(0);
    const std::string whole = contents(file);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        write(file, whole.substr(0, size));
        EXPECT_TRUE(cache.find("a", "key").empty()) << size;
    }
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ 16);
        write(file, damaged);
        EXPECT_TRUE(cache.find("a", "key").empty()) << i;
    }
    cache.keep("a", "key", bytesOf("again"));
    EXPECT_EQ(cache.find("a", "key"), bytesOf("again"));
    fs::remove(file);
    fs::create_directory(file); // in the way
    cache.keep("a", "key", bytesOf("12345"));
    EXPECT_TRUE(cache.find("a", "key").empty());
}

TEST_F(Cache, HasABoundedSizeAndDeletesTheOldest) {
    const UserCache cache(folder);
    const auto now = fs::file_time_type::clock::now();
    write(folder / "others.cache", "1");
    fs::last_write_time(folder / "others.cache", now - std::chrono::hours(1000));
    for (std::size_t i = 0; i < UserCache::mostFiles + 3; ++i) {
        cache.keep("a", std::to_string(i), bytesOf("1"));
        for (const fs::path& file : files())
            if (contents(file).find("\n" + std::to_string(i) + "\n") != std::string::npos)
                fs::last_write_time(file, now - std::chrono::hours(100 - i));
    }
    EXPECT_EQ(files().size(), UserCache::mostFiles + 1);
    EXPECT_TRUE(fs::exists(folder / "others.cache"));
    EXPECT_TRUE(cache.find("a", "2").empty());
    EXPECT_FALSE(cache.find("a", "3").empty());
    cache.keep("b", "", std::vector<std::byte>(UserCache::mostBytes));
    EXPECT_TRUE(cache.find("b", "").empty());
}

TEST_F(Cache, KeepsFormsByDeviceDriverAndScene) {
    const UserCache cache(folder);
    const app::KeptForms kept(cache, "device 1"), ofAnotherDriver(cache, "device 2");
    const sim::Forms forms{.usesTexels = false, .columns = 1, .chunk = 4};
    EXPECT_EQ(kept.find(7), std::nullopt);
    kept.keep(7, forms);
    EXPECT_EQ(kept.find(7), forms);
    EXPECT_EQ(kept.find(8), std::nullopt);
    EXPECT_EQ(ofAnotherDriver.find(7), std::nullopt);
    const sim::Forms other{.columns = 2, .chunk = 8};
    kept.keep(7, other);
    EXPECT_EQ(kept.find(7), other);
    for (std::uint64_t scene = 100; scene < 100 + app::KeptForms::most; ++scene) kept.keep(scene, forms);
    EXPECT_EQ(kept.find(7), std::nullopt) << "the oldest goes first";
    EXPECT_EQ(kept.find(100), forms);
}

TEST_F(Cache, ReadsNoFormsOutOfRange) {
    const sim::Forms forms{.usesTexels = false, .columns = 2, .chunk = 3, .residentBytes = 5};
    EXPECT_EQ(app::parseForms(app::toText(forms)), forms);
    for (const char* wrong :
         {"", "columns=3,chunk=1,texels=0,grids=1,resident=0",
          "columns=1,chunk=0,texels=0,grids=1,resident=0", "columns=1,chunk=1,texels=2,grids=1,resident=0",
          "columns=1,chunk=1,texels=0,grids=1", "columns=1,chunk=1,texels=0,grids=1,resident=0x",
          "columns=-1,chunk=1,texels=0,grids=1,resident=0"})
        EXPECT_EQ(app::parseForms(wrong), std::nullopt) << wrong;
}

class CacheOnADevice : public Cache {
protected:
    vk::Loader loader;
    const UserCache cache{folder};
    vk::Device device = app::createDevice(loader.getInstanceProcAddr(), {}, cache);
};

TEST_F(CacheOnADevice, MeasuresFormsOnceAndRemembersThem) {
    vk::Queue queue(device);
    sim::Scene scene;
    sim::addLattice(scene, {.cells = {5, 5, 5}, .spacing = 0.05f, .youngModulus = 1e5f});
    const app::FormChoice first = app::chooseForms(device, queue, scene, {}, cache);
    EXPECT_EQ(first.source, app::FormSource::measured);
    const app::FormChoice second = app::chooseForms(device, queue, scene, {}, cache);
    EXPECT_EQ(second.source, app::FormSource::remembered);
    EXPECT_EQ(second.forms, first.forms);
    EXPECT_EQ(app::chooseForms(device, queue, scene, {}, UserCache(fs::path())).source,
              app::FormSource::measured);
    EXPECT_EQ(app::chooseForms(device, queue, scene, {.solver = sim::Solver::jacobi}, cache).source,
              app::FormSource::usual);
}

namespace {

// The bytes of the last pipeline cache that a device was made with, through functions that stand between.
std::string initial;
PFN_vkGetInstanceProcAddr instanceFunctions = nullptr;
PFN_vkGetDeviceProcAddr deviceFunctions = nullptr;
PFN_vkCreatePipelineCache createCache = nullptr;

VKAPI_ATTR VkResult VKAPI_CALL noteCache(VkDevice device, const VkPipelineCacheCreateInfo* info,
                                         const VkAllocationCallbacks* allocator, VkPipelineCache* cache) {
    initial.assign(static_cast<const char*>(info->pInitialData), info->initialDataSize);
    return createCache(device, info, allocator, cache);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceFunction(VkDevice device, const char* name) {
    if (std::string_view(name) != "vkCreatePipelineCache") return deviceFunctions(device, name);
    createCache = reinterpret_cast<PFN_vkCreatePipelineCache>(deviceFunctions(device, name));
    return reinterpret_cast<PFN_vkVoidFunction>(&noteCache);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceFunction(VkInstance instance, const char* name) {
    const PFN_vkVoidFunction found = instanceFunctions(instance, name);
    if (std::string_view(name) != "vkGetDeviceProcAddr") return found;
    deviceFunctions = reinterpret_cast<PFN_vkGetDeviceProcAddr>(found);
    return reinterpret_cast<PFN_vkVoidFunction>(&deviceFunction);
}

} // namespace

TEST_F(CacheOnADevice, GivesKeptPipelinesToTheDriver) {
    app::keepPipelines(device, cache);
    instanceFunctions = loader.getInstanceProcAddr();
    const vk::Device without = app::createDevice(&instanceFunction, {}, UserCache(fs::path()));
    EXPECT_TRUE(initial.empty());
    const vk::Device with = app::createDevice(&instanceFunction, {}, cache);
    EXPECT_FALSE(initial.empty());
    EXPECT_NE(contents(files().at(0)).find(initial), std::string::npos) << "the bytes of the file";
}

TEST_F(CacheOnADevice, KeepsPipelinesForThisDeviceAlone) {
    EXPECT_EQ(device.description().identity.size(), 2u * (16 + 16 + 16 + 4));
    app::keepPipelines(device, cache);
    ASSERT_EQ(files().size(), 1u);
    const fs::path file = files()[0];
    const std::string whole = contents(file);
    EXPECT_NE(whole.find(device.description().identity), std::string::npos);
    const vk::Device second = app::createDevice(loader.getInstanceProcAddr(), {}, cache);
    EXPECT_EQ(second.pipelineCacheData().size(), device.pipelineCacheData().size());
    write(file, whole.substr(0, whole.size() / 2));
    const vk::Device third = app::createDevice(loader.getInstanceProcAddr(), {}, cache);
    app::keepPipelines(third, cache);
    EXPECT_EQ(contents(file), whole);
}
