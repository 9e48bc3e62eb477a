// Wording and collection of complaints about a scene: for validate.cpp and the checks it calls.
#pragma once

#include "sinew/ranges.hpp"
#include "sinew/scene.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::sim {

template <typename Number> std::string number(Number value) {
    char text[32];
    const auto end = std::to_chars(std::begin(text), std::end(text), value).ptr;
    return {text, end};
}

/// Writes a value that was float32 with its shortest digits: 0.1f reads "0.1", not "0.10000000149011612".
inline std::string asWritten(double value) {
    const auto narrow = static_cast<float>(value);
    return double{narrow} == value || std::isnan(value) ? number(narrow) : number(value);
}

/// A length or a speed in thousandths of its unit, with two digits or as a whole number.
inline std::string thousandths(double value) {
    char text[32];
    std::snprintf(text, sizeof text, value >= 0.00995 ? "%.0f" : "%.2g", 1000 * value);
    return text;
}

inline std::string element(std::string_view list, std::size_t index) {
    return std::string(list) + "[" + number(index) + "]";
}

/// The name of a particle's body; "" in a scene of one body, and for a particle without a body.
inline std::string bodyOf(const Scene& scene, std::uint32_t particle) {
    if (scene.bodies.size() < 2) return {};
    const auto found = std::ranges::find_if(scene.bodies, [particle](const Body& body) {
        return particle >= body.firstParticle && particle - body.firstParticle < body.particleCount;
    });
    return found == scene.bodies.end() ? std::string() : found->name;
}

// Keeps the first sentences and counts the rest, so that a million NaNs stay readable.
class Complaints {
public:
    void add(const std::string& item, const std::string& why) {
        if (++count_ <= most) sentences_.push_back(item + ": " + why);
    }

    // `name` is a function, so that no name is built for valid values.
    void check(double value, const Range& range, const auto& name) {
        if (!range.holds(value)) add(name(), "is " + asWritten(value) + ", must be " + toText(range));
    }

    void checkFinite(const Vec3& v, const auto& name) {
        for (const float value : {v.x, v.y, v.z}) {
            if (ranges::finite.holds(double{value})) continue;
            add(name(), "is (" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + "), must be finite");
            return;
        }
    }

    void checkIndex(std::size_t index, std::size_t count, const char* counted, const auto& name) {
        if (index >= count)
            add(name(), "is " + number(index) + ", but there are " + number(count) + " " + counted);
    }

    bool isEmpty() const { return count_ == 0; }

    std::vector<std::string> finish() {
        if (count_ > most) sentences_.push_back("and " + number(count_ - most) + " more complaints");
        return std::move(sentences_);
    }

private:
    static constexpr std::size_t most = 20;
    std::vector<std::string> sentences_;
    std::size_t count_ = 0;
};

} // namespace sinew::sim
