// Checks shared by all formats, and format detection.
#include "mesh/import_checks.hpp"

#include "mesh/text_scanner.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>

namespace sinew::mesh {
namespace {

bool isText(std::string_view bytes) {
    return std::ranges::none_of(bytes.substr(0, 4096), [](char c) { return c == '\0'; });
}

std::string_view firstWord(std::string_view bytes) {
    const std::size_t start = bytes.find_first_not_of(" \t\r\n");
    std::string_view rest = bytes.substr(std::min(start, bytes.size()), 64);
    const std::size_t end = rest.find_first_of(" \t\r\n");
    return rest.substr(0, end);
}

/// False for text that may also be a damaged binary STL.
bool isBinaryStl(std::string_view bytes) {
    if (bytes.size() < 84) return false;
    const std::uint64_t needed = 84 + 50ull * readUint32(bytes, 80);
    return needed == bytes.size() || (!isText(bytes) && needed <= bytes.size() && needed > 84);
}

bool hasVertexLine(std::string_view text) {
    LineScanner lines(text);
    for (std::string_view line; lines.next(line);)
        if (takeWord(line) == "v") return true;
    return false;
}

constexpr std::size_t longestName = 64; ///< bytes

std::string trimmed(std::string_view text) {
    std::string name(text.substr(0, 4 * longestName));
    for (char& character : name)
        if (static_cast<unsigned char>(character) <= ' ' || character == 0x7f) character = ' ';
    name.erase(0, name.find_first_not_of(' '));
    if (name.size() > longestName) {
        std::size_t end = longestName; // not within a UTF-8 character
        while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80) --end;
        name.resize(end);
    }
    name.erase(name.find_last_not_of(' ') + 1);
    return name;
}

} // namespace

std::uint32_t ObjectNames::add(std::string_view text) {
    const std::string name = trimmed(text);
    if (name.empty()) return noObject;
    if (const auto known = numbers_.find(name); known != numbers_.end()) return known->second;
    if (names_.size() == mostObjects) return noObject;
    names_.push_back(name);
    return numbers_[name] = static_cast<std::uint32_t>(names_.size() - 1);
}

std::uint32_t readUint32(std::string_view bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t byte = 4; byte-- > 0;)
        value = value << 8 | static_cast<unsigned char>(bytes[offset + byte]);
    return value;
}

void checkCoordinate(double value, const std::string& where) {
    if (!std::isfinite(value)) throw Refusal(where, "a coordinate is not a finite number: repair the mesh");
    if (std::abs(value) > largestCoordinate)
        throw Refusal(where, "a coordinate lies beyond 1e9 m: check the unit of the mesh");
}

double checkCoordinate(std::string_view word, std::size_t line) {
    const std::optional<double> value = toNumber(word);
    if (!value)
        throw Refusal(std::to_string(line), word.empty()
                                                ? "a coordinate is missing: export the mesh again"
                                                : "a coordinate is not a number: export the mesh again");
    if (!std::isfinite(*value) || std::abs(*value) > largestCoordinate)
        checkCoordinate(*value, std::to_string(line));
    return *value;
}

void appendNumber(std::string& text, double value) {
    std::array<char, 32> digits; // a double needs at most 24
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    (text += ' ').append(digits.data(), end);
}

void checkTriangleCount(std::uint64_t count, const ImportLimits& limits) {
    if (count == 0) throw Refusal("", "it holds no faces: export a surface, not points or lines");
    if (count > limits.triangles)
        throw Refusal("", "its " + std::to_string(count) + " triangles exceed the limit of " +
                              std::to_string(limits.triangles) + ": simplify the mesh");
}

std::optional<Format> sniff(std::string_view bytes) {
    if (bytes.starts_with("glTF")) return Format::glb;
    if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return Format::ply;
    if (isBinaryStl(bytes)) return Format::stl;
    if (!isText(bytes)) return std::nullopt;
    const std::string_view word = firstWord(bytes);
    if (word == "solid") return Format::stl;
    if (word.starts_with("{")) return Format::gltf;
    if (hasVertexLine(bytes)) return Format::obj;
    return std::nullopt;
}

} // namespace sinew::mesh
