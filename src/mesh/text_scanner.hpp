// Scanner of lines, words and numbers in text formats. Never reads beyond its view, never allocates.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

namespace sinew::mesh {

/// Splits text at line feeds; a carriage return before one belongs to the line end.
class LineScanner {
public:
    explicit LineScanner(std::string_view text) : rest_(text) {}

    bool next(std::string_view& line) {
        if (rest_.empty()) return false;
        const std::size_t end = rest_.find('\n');
        line = rest_.substr(0, end);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        ++number_;
        return true;
    }

    std::size_t number() const { return number_; } ///< number of the line last returned, from 1
    std::string_view rest() const { return rest_; }

private:
    std::string_view rest_;
    std::size_t number_ = 0;
};

inline bool isBlank(char character) {
    return character == ' ' || character == '\t' || character == '\r' || character == '\v' ||
           character == '\f';
}

/// Removes the first word from `line` and returns it; empty at the end of the line.
inline std::string_view takeWord(std::string_view& line) {
    while (!line.empty() && isBlank(line.front())) line.remove_prefix(1);
    std::size_t size = 0;
    while (size < line.size() && !isBlank(line[size])) ++size;
    const std::string_view word = line.substr(0, size);
    line.remove_prefix(size);
    return word;
}

/// Converts the whole word to a number; accepts "nan", "inf" and a leading +; a number too large for double
/// is infinite.
inline std::optional<double> toNumber(std::string_view word) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || end != word.data() + word.size() || error == std::errc::invalid_argument)
        return std::nullopt;
    if (error == std::errc::result_out_of_range) // too large, or so small that it is 0
        return word.find("e-") != word.npos || word.find("E-") != word.npos ? 0.0 : HUGE_VAL;
    return value;
}

template <typename Integer> std::optional<Integer> toInteger(std::string_view word) {
    Integer value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || end != word.data() + word.size() || error != std::errc{}) return std::nullopt;
    return value;
}

} // namespace sinew::mesh
