// The stream is read through a buffer of up to 64 bits, refilled once per symbol: a literal or a copy takes
// at most 48 (15 + 5 for its length, 15 + 13 for its distance). Codes of up to `quickBits` are looked up,
// longer ones, which are rare, are searched bit by bit in canonical order.
#include "vk/inflate.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace sinew::vk {

namespace {

constexpr std::uint32_t longestCode = 15, quickBits = 10, endOfBlock = 256, invalid = 0xffff;

class BitReader {
public:
    explicit BitReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    /// Makes at least 56 bits available, or all that are left.
    void refill() {
        for (; held_ <= 56 && next_ < bytes_.size(); held_ += 8)
            bits_ |= std::uint64_t{bytes_[next_++]} << held_;
    }
    /// The next bits, the first as the lowest. Behind the end of the stream they are 0.
    std::uint32_t peek(std::uint32_t count) const {
        return static_cast<std::uint32_t>(bits_ & ((std::uint64_t{1} << count) - 1));
    }
    /// False behind the end of the stream.
    bool skip(std::uint32_t count) {
        if (count > held_) return false;
        bits_ >>= count;
        held_ -= count;
        return true;
    }
    bool take(std::uint32_t count, std::uint32_t& value) {
        value = peek(count);
        return skip(count);
    }
    void alignToByte() { skip(held_ % 8); }
    bool isAtEnd() const { return held_ < 8 && next_ == bytes_.size(); }

private:
    std::span<const std::uint8_t> bytes_;
    std::size_t next_ = 0;
    std::uint64_t bits_ = 0;
    std::uint32_t held_ = 0;
};

/// A Huffman code, given by the lengths of its symbols: canonical, shorter codes first.
class Code {
public:
    /// False if the lengths claim more codes than there are, or fewer. RFC 1951 allows fewer in one case
    /// alone: a single code of one bit.
    bool build(std::span<const std::uint8_t> lengths) {
        counts_.fill(0);
        for (const std::uint8_t length : lengths) ++counts_[length];
        const std::size_t used = lengths.size() - counts_[0];
        counts_[0] = 0;
        std::int32_t free = 1;
        for (std::uint32_t length = 1; length <= longestCode; ++length) {
            free = 2 * free - counts_[length];
            if (free < 0) return false;
        }
        if (free > 0 && (used > 1 || counts_[1] != used)) return false;
        std::array<std::uint16_t, longestCode + 2> first{};
        for (std::uint32_t length = 1; length <= longestCode; ++length)
            first[length + 1] = static_cast<std::uint16_t>(first[length] + counts_[length]);
        for (std::uint32_t symbol = 0; symbol < lengths.size(); ++symbol)
            if (lengths[symbol] != 0) symbols_[first[lengths[symbol]]++] = static_cast<std::uint16_t>(symbol);
        fillQuick();
        return true;
    }

    /// The next symbol; `invalid` if there is none.
    std::uint32_t read(BitReader& in) const {
        const std::uint32_t entry = quick_[in.peek(quickBits)];
        if (entry != invalid) return in.skip(entry & 15) ? entry >> 4 : invalid;
        std::uint32_t code = 0, first = 0, index = 0;
        for (std::uint32_t length = 1, bits = in.peek(longestCode); length <= longestCode;
             ++length, bits >>= 1) {
            code |= bits & 1;
            const std::uint32_t count = counts_[length];
            if (code < first + count) return in.skip(length) ? symbols_[index + code - first] : invalid;
            index += count;
            first = (first + count) << 1;
            code <<= 1;
        }
        return invalid;
    }

private:
    void fillQuick() {
        quick_.fill(invalid);
        std::uint32_t code = 0, index = 0;
        for (std::uint32_t length = 1; length <= quickBits; ++length, code <<= 1)
            for (std::uint32_t i = 0; i < counts_[length]; ++i, ++code) {
                std::uint32_t reversed = 0; // codes are stored from their highest bit on
                for (std::uint32_t bit = 0; bit < length; ++bit)
                    reversed |= (code >> bit & 1) << (length - 1 - bit);
                const auto entry = static_cast<std::uint16_t>(symbols_[index++] << 4 | length);
                for (std::uint32_t at = reversed; at < quick_.size(); at += 1u << length) quick_[at] = entry;
            }
    }

    std::array<std::uint16_t, longestCode + 1> counts_{}; // of codes of each length
    std::array<std::uint16_t, 288> symbols_{};            // in the order of their codes
    std::array<std::uint16_t, 1u << quickBits> quick_{};  // symbol << 4 | length, by the next bits
};

/// The output so far.
class Window {
public:
    explicit Window(std::span<std::uint8_t> out) : out_(out) {}
    bool isFull() const { return size_ == out_.size(); }
    bool add(std::uint8_t byte) {
        if (isFull()) return false;
        out_[size_++] = byte;
        return true;
    }
    /// Repeats what was written `distance` bytes before, which may overlap with the copy.
    bool copy(std::size_t distance, std::size_t length) {
        if (distance > size_ || length > out_.size() - size_) return false;
        for (; length > 0; --length, ++size_) out_[size_] = out_[size_ - distance];
        return true;
    }

private:
    std::span<std::uint8_t> out_;
    std::size_t size_ = 0;
};

struct Range {
    std::uint16_t base;
    std::uint8_t extraBits;
};
constexpr Range lengthRanges[] = {{3, 0},   {4, 0},   {5, 0},   {6, 0},   {7, 0},  {8, 0},  {9, 0},  {10, 0},
                                  {11, 1},  {13, 1},  {15, 1},  {17, 1},  {19, 2}, {23, 2}, {27, 2}, {31, 2},
                                  {35, 3},  {43, 3},  {51, 3},  {59, 3},  {67, 4}, {83, 4}, {99, 4}, {115, 4},
                                  {131, 5}, {163, 5}, {195, 5}, {227, 5}, {258, 0}};
constexpr Range distanceRanges[] = {
    {1, 0},     {2, 0},     {3, 0},     {4, 0},      {5, 1},      {7, 1},     {9, 2},     {13, 2},
    {17, 3},    {25, 3},    {33, 4},    {49, 4},     {65, 5},     {97, 5},    {129, 6},   {193, 6},
    {257, 7},   {385, 7},   {513, 8},   {769, 8},    {1025, 9},   {1537, 9},  {2049, 10}, {3073, 10},
    {4097, 11}, {6145, 11}, {8193, 12}, {12289, 12}, {16385, 13}, {24577, 13}};

bool readRange(BitReader& in, std::span<const Range> ranges, std::uint32_t index, std::uint32_t& value) {
    if (index >= ranges.size() || !in.take(ranges[index].extraBits, value)) return false;
    value += ranges[index].base;
    return true;
}

struct Codes {
    Code literals, distances;
};

bool readCompressed(BitReader& in, const Codes& codes, Window& out) {
    for (;;) {
        in.refill();
        const std::uint32_t symbol = codes.literals.read(in);
        if (symbol < endOfBlock) {
            if (!out.add(static_cast<std::uint8_t>(symbol))) return false;
            continue;
        }
        if (symbol == endOfBlock) return true;
        std::uint32_t length = 0, distance = 0; // `invalid` is no index of a range
        if (!readRange(in, lengthRanges, symbol - endOfBlock - 1, length)) return false;
        if (!readRange(in, distanceRanges, codes.distances.read(in), distance)) return false;
        if (!out.copy(distance, length)) return false;
    }
}

bool readStored(BitReader& in, Window& out) {
    in.alignToByte();
    in.refill();
    std::uint32_t size = 0, inverse = 0;
    if (!in.take(16, size) || !in.take(16, inverse) || (size ^ inverse) != 0xffff) return false;
    for (; size > 0; --size) {
        in.refill();
        std::uint32_t byte = 0;
        if (!in.take(8, byte) || !out.add(static_cast<std::uint8_t>(byte))) return false;
    }
    return true;
}

bool makeFixed(Codes& codes) {
    std::array<std::uint8_t, 288> lengths{};
    std::fill_n(lengths.begin(), 144, std::uint8_t{8});
    std::fill_n(lengths.begin() + 144, 112, std::uint8_t{9});
    std::fill_n(lengths.begin() + 256, 24, std::uint8_t{7});
    std::fill_n(lengths.begin() + 280, 8, std::uint8_t{8});
    std::array<std::uint8_t, 32> distances{}; // the last two are never used
    distances.fill(5);
    return codes.literals.build(lengths) && codes.distances.build(distances);
}

/// Reads the lengths of both codes, which are themselves packed by a third.
bool readLengths(BitReader& in, const Code& code, std::span<std::uint8_t> lengths) {
    for (std::size_t at = 0; at < lengths.size();) {
        in.refill();
        const std::uint32_t symbol = code.read(in);
        if (symbol < 16) {
            lengths[at++] = static_cast<std::uint8_t>(symbol);
            continue;
        }
        if (symbol > 18 || (symbol == 16 && at == 0)) return false;
        constexpr Range repeats[] = {{3, 2}, {3, 3}, {11, 7}};
        std::uint32_t count = 0;
        if (!readRange(in, repeats, symbol - 16, count) || count > lengths.size() - at) return false;
        const std::uint8_t length = symbol == 16 ? lengths[at - 1] : std::uint8_t{0};
        std::fill_n(lengths.begin() + static_cast<std::ptrdiff_t>(at), count, length);
        at += count;
    }
    return true;
}

bool readCodes(BitReader& in, Codes& codes) {
    constexpr std::uint8_t order[] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
    std::uint32_t literals = 0, distances = 0, ordered = 0;
    if (!in.take(5, literals) || !in.take(5, distances) || !in.take(4, ordered)) return false;
    literals += 257;
    distances += 1;
    if (literals > 286 || distances > std::size(distanceRanges)) return false;
    std::array<std::uint8_t, std::size(order)> own{};
    for (std::uint32_t i = 0; i < ordered + 4; ++i) {
        in.refill();
        std::uint32_t length = 0;
        if (!in.take(3, length)) return false;
        own[order[i]] = static_cast<std::uint8_t>(length);
    }
    Code code;
    std::array<std::uint8_t, 286 + std::size(distanceRanges)> lengths{};
    const std::span<std::uint8_t> both = std::span(lengths).first(literals + distances);
    return code.build(own) && readLengths(in, code, both) && lengths[endOfBlock] != 0 &&
           codes.literals.build(both.first(literals)) && codes.distances.build(both.subspan(literals));
}

} // namespace

bool inflate(std::span<const std::uint8_t> packed, std::span<std::uint8_t> out) noexcept {
    BitReader in(packed);
    Window window(out);
    Codes codes;
    for (bool isLast = false; !isLast;) {
        in.refill();
        std::uint32_t last = 0, kind = 0;
        if (!in.take(1, last) || !in.take(2, kind)) return false;
        isLast = last != 0;
        bool isGood = false;
        if (kind == 0) isGood = readStored(in, window);
        if (kind == 1) isGood = makeFixed(codes) && readCompressed(in, codes, window);
        if (kind == 2) isGood = readCodes(in, codes) && readCompressed(in, codes, window);
        if (!isGood) return false;
    }
    return window.isFull() && in.isAtEnd();
}

} // namespace sinew::vk
