// Every key of a scene file: one table for the parser, the suggested spellings and docs/scene-files.md.
#pragma once

#include "sinew/ranges.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace sinew::scenes {

/// What stands behind the equals sign.
enum class Kind : std::uint8_t {
    text,
    number,
    count,       ///< a whole number
    countOrAuto, ///< a whole number, or "auto" in quotes
    vector,      ///< [x, y, z]
    counts2,
    counts3,
    pins,        ///< a list of corner and edge names and [column, row] pairs
    names,       ///< a list of texts
    nameOrNames, ///< a text or a list of texts
    flag,        ///< true or false
    numbers,     ///< a list of numbers
    lines,       ///< a list of lists of [x, y, z]
    table,       ///< [key]
    tables,      ///< [[key]], any number of them
};

struct KindRule {
    Kind kind;
    std::string_view expected; ///< as in "must be ..."
    std::size_t components;    ///< numbers in it; 0 = none
    bool isWhole;
};
const KindRule& ruleOf(Kind kind);

struct Key {
    std::string_view section; ///< "" = top level; of a table in a table "outer.inner"
    std::string_view name;
    Kind kind = Kind::number;
    std::string_view unit;
    sim::Range range;          ///< of each component
    std::string_view fallback; ///< a TOML value; empty = none
    std::string_view meaning;
    bool isRequired = false;
};

std::span<const Key> schema();

/// Null where the section has no such key.
const Key* findKey(std::string_view section, std::string_view name);

/// The section of the table `name` in a section, as the schema holds it.
std::string_view sectionOf(std::string_view section, std::string_view name);

/// The key of the section whose spelling is nearest to `name`.
const Key& nearestKey(std::string_view section, std::string_view name);

/// Edits (insert, delete, replace, swap neighbours) that lead from one word to the other.
std::size_t editDistance(std::string_view a, std::string_view b);

} // namespace sinew::scenes
