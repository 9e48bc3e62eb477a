// Tests of the decoder of deflate: streams of gzip and streams made here come back, and others are refused.
#include "sinew/vk/spirv.hpp"
#include "test_kernels.hpp"
#include "vk/inflate.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <random>
#include <unistd.h>

namespace sinew::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes readFile(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The stream in the file that gzip makes of `bytes`.
Bytes packedByGzip(const Bytes& bytes, int level) {
    const auto path = std::filesystem::temp_directory_path() / ("sinew_gzip_" + std::to_string(::getpid()));
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    const std::string command = "gzip -n -c -" + std::to_string(level) + " " + path.string();
    FILE* pipe = popen(command.c_str(), "r");
    Bytes file;
    for (int byte = std::fgetc(pipe); byte != EOF; byte = std::fgetc(pipe))
        file.push_back(static_cast<std::uint8_t>(byte));
    EXPECT_EQ(pclose(pipe), 0) << command;
    std::filesystem::remove(path);
    constexpr std::size_t head = 10, tail = 8;
    EXPECT_GT(file.size(), head + tail);
    if (file.size() < head + tail) return {};
    return {file.begin() + head, file.end() - tail};
}

/// Contents that lead to blocks of all kinds, to long and to far repeats.
std::vector<Bytes> contents() {
    std::mt19937 random(7);
    Bytes noise(100'000), zeros(70'000, 0), far = noise;
    for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
    for (std::size_t i = 0; i < far.size(); ++i) far[i] = noise[i % 32'768];
    Bytes few; // long codes: each byte half as frequent as the one before it
    for (int i = 0; i < 60'000; ++i)
        few.push_back(static_cast<std::uint8_t>(std::countl_zero(static_cast<std::uint32_t>(random()))));
    return {{}, {7}, zeros, noise, far, few, readFile(std::string(EXACT_FOLDER) + "/everything.comp.spv")};
}

bool unpacks(const Bytes& packed, const Bytes& expected) {
    Bytes out(expected.size(), 0xaa);
    return vk::inflate(packed, out) && out == expected;
}

/// A stream written bit by bit.
struct BitWriter {
    Bytes bytes{};
    std::uint32_t bits = 0;
    BitWriter& put(std::uint32_t value, std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i, ++bits) {
            if (bits % 8 == 0) bytes.push_back(0);
            bytes.back() |= static_cast<std::uint8_t>((value >> i & 1) << bits % 8);
        }
        return *this;
    }
    BitWriter& code(std::uint32_t value, std::uint32_t count) { // from the highest bit on
        for (std::uint32_t i = count; i-- > 0;) put(value >> i & 1, 1);
        return *this;
    }
};

bool isRefused(const BitWriter& stream, std::size_t size) {
    Bytes out(size);
    return !vk::inflate(stream.bytes, out);
}

/// The head of a block with codes of its own, and the lengths of the code of lengths, in the order of RFC
/// 1951.
BitWriter dynamicHead(std::initializer_list<std::uint32_t> lengths) {
    BitWriter stream;
    stream.put(1, 1).put(2, 2).put(0, 5).put(0, 5).put(static_cast<std::uint32_t>(lengths.size()) - 4, 4);
    for (const std::uint32_t length : lengths) stream.put(length, 3);
    return stream;
}

} // namespace

TEST(Inflate, UnpacksAllThatGzipPacks) {
    for (const Bytes& bytes : contents())
        for (const int level : {1, 6, 9})
            EXPECT_TRUE(unpacks(packedByGzip(bytes, level), bytes)) << bytes.size() << " bytes, -" << level;
}

TEST(Inflate, RefusesEveryTruncationAndEveryOtherSize) {
    for (const Bytes& bytes : {Bytes(300, 5), readFile(std::string(EXACT_FOLDER) + "/everything.comp.spv")}) {
        Bytes packed = packedByGzip(bytes, 9);
        Bytes out(bytes.size());
        for (std::size_t size = 0; size < packed.size(); ++size)
            EXPECT_FALSE(vk::inflate(std::span(packed).first(size), out)) << size;
        EXPECT_TRUE(vk::inflate(packed, out));
        EXPECT_FALSE(vk::inflate(packed, std::span(out).first(out.size() - 1)));
        out.push_back(0);
        EXPECT_FALSE(vk::inflate(packed, out));
        out.pop_back();
        packed.push_back(0);
        EXPECT_FALSE(vk::inflate(packed, out)) << "a byte behind the end";
    }
}

TEST(Inflate, SurvivesEveryFlippedBit) {
    const Bytes bytes = readFile(std::string(EXACT_FOLDER) + "/everything.comp.spv");
    std::size_t same = 0;
    Bytes packed = packedByGzip(bytes, 9);
    for (std::size_t bit = 0; bit < 8 * packed.size(); ++bit) {
        packed[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
        same += unpacks(packed, bytes);
        packed[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
    }
    // Nothing may crash, hang or be written outside. A few repeats have another source with the same bytes.
    EXPECT_LT(same, packed.size() / 8);
}

TEST(Inflate, ReadsStoredBlocks) {
    BitWriter stream;
    stream.put(0, 1).put(0, 2).put(0, 5).put(3, 16).put(0xfffc, 16).put('a', 8).put('b', 8).put('c', 8);
    stream.put(1, 1).put(0, 2).put(0, 5).put(0, 16).put(0xffff, 16); // an empty one
    EXPECT_TRUE(unpacks(stream.bytes, {'a', 'b', 'c'}));
    stream.bytes[3] ^= 1; // the inverse of the size
    EXPECT_TRUE(isRefused(stream, 3));
}

TEST(Inflate, ReadsFixedCodesAndRefusesWhatTheyDoNotHave) {
    const auto fixed = [] { return BitWriter().put(1, 1).put(1, 2); };
    const auto letter = [](BitWriter stream) { return stream.code(0x30 + 'a', 8); };
    EXPECT_TRUE(unpacks(letter(fixed()).code(0, 7).bytes, {'a'}));
    const auto repeat = [&](std::uint32_t distance) { return letter(fixed()).code(1, 7).code(distance, 5); };
    EXPECT_TRUE(unpacks(repeat(0).code(0, 7).bytes, {'a', 'a', 'a', 'a'}));
    EXPECT_TRUE(isRefused(repeat(1).code(0, 7), 4)) << "before the first byte";
    EXPECT_TRUE(isRefused(repeat(30).code(0, 7), 4)) << "distance 30 does not exist";
    EXPECT_TRUE(isRefused(letter(fixed()).code(0xc6, 8).code(0, 5).code(0, 7), 4))
        << "length 286 does not exist";
    EXPECT_TRUE(isRefused(repeat(0), 4)) << "no end of the block";
    EXPECT_TRUE(isRefused(BitWriter().put(1, 1).put(3, 2), 0)) << "no block is of the fourth kind";
}

TEST(Inflate, RefusesCodesThatAreNone) {
    EXPECT_TRUE(isRefused(dynamicHead({1, 1, 1, 0}), 0)) << "three codes of one bit";
    EXPECT_TRUE(isRefused(dynamicHead({2, 2, 2, 0}), 0)) << "a quarter of the codes is missing";
    EXPECT_TRUE(isRefused(dynamicHead({0, 0, 0, 0}), 0)) << "there are no codes";
    EXPECT_TRUE(isRefused(dynamicHead({1, 0, 1, 0}).code(0, 1), 0)) << "repeats the length before the first";
    // 18 repeats a zero 138 times: twice it exceeds the 258 lengths.
    EXPECT_TRUE(isRefused(dynamicHead({0, 1, 1, 0}).code(1, 1).put(127, 7).code(1, 1).put(127, 7), 0));
    // 255 zeros and, for the last literal, the end of the block and distance 0, too, as no other symbol is
    // left.
    BitWriter stream = dynamicHead({0, 0, 1, 1}); // 18 and 0
    stream.code(1, 1).put(127, 7).code(1, 1).put(109, 7);
    EXPECT_TRUE(isRefused(stream, 0)) << "a block without an end";
}

TEST(PackedKernels, HaveTheWordsOfTheirFiles) {
    for (const vk::ShaderCode* code : {&kernels::everything, &kernels::addOne, &kernels::looseAndExact}) {
        const Bytes file = readFile(std::string(EXACT_FOLDER) + "/" + code->name + ".comp.spv");
        const std::vector<std::uint32_t> words = vk::wordsOf(*code);
        ASSERT_EQ(words.size() * sizeof(std::uint32_t), file.size()) << code->name;
        EXPECT_EQ(std::memcmp(words.data(), file.data(), file.size()), 0) << code->name;
        EXPECT_LT(code->packed.size(), file.size() / 2) << code->name;
    }
}

TEST(PackedKernels, AreRefusedByNameWhenDamaged) {
    vk::ShaderCode code = kernels::addOne;
    code.packed = code.packed.first(code.packed.size() - 1);
    try {
        vk::wordsOf(code);
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "kernel add_one: its packed bytes are damaged");
    }
}

} // namespace sinew::test
