// Tests every key of the schema with values at, below and above its range, with NaN, infinities and wrong
// types. The tables are made from the schema, so new keys are included.
#include "scenes/section.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>

using namespace sinew;
using scenes::Key;
using scenes::Kind;

namespace {

std::string shortest(double value) {
    char text[32];
    return {text, std::to_chars(std::begin(text), std::end(text), value).ptr};
}

/// `text` as the value of a key, repeated for each of its components.
std::string repeated(const Key& key, const std::string& text) {
    const std::size_t components = scenes::ruleOf(key.kind).components;
    if (components == 1) return text;
    std::string list = "[";
    for (std::size_t i = 0; i < components; ++i) list += (i > 0 ? ", " : "") + text;
    return list + "]";
}

/// A valid value for a required key.
std::string filler(const Key& key) {
    if (!key.fallback.empty()) return std::string(key.fallback);
    if (key.kind == Kind::lines) return "[[[0, 0, 0], [0, 0, 1]]]";
    if (key.kind == Kind::numbers) return "[0, 1]";
    return key.kind == Kind::text ? "\"x\"" : repeated(key, "1");
}

/// The error of a section in which `key` has `value` and all other required keys are valid; "" without an
/// error.
std::string errorOf(const Key& key, const std::string& value) {
    std::string text = std::string(key.name) + " = " + value + "\n";
    for (const Key& other : scenes::schema())
        if (other.section == key.section && other.isRequired && other.name != key.name)
            text += std::string(other.name) + " = " + filler(other) + "\n";
    const std::string file = "test.toml";
    try {
        const toml::table table = scenes::parse(text, file);
        const scenes::Section section(table, key.section, "item", file);
    } catch (const scenes::SceneError& error) {
        return error.what();
    }
    return "";
}

std::string text(const Key& key, double value) {
    const std::string number =
        scenes::ruleOf(key.kind).isWhole ? std::to_string(std::llround(value)) : shortest(value);
    return repeated(key, number);
}

double step(const Key& key, double from) {
    return scenes::ruleOf(key.kind).isWhole ? 1 : std::max(1e-3, std::abs(from) * 1e-3);
}

void expectRefused(const Key& key, const std::string& value, const std::string& why) {
    const std::string error = errorOf(key, value);
    EXPECT_EQ(error.find("cannot read scene: test.toml:1: item." + std::string(key.name) + " is "), 0u)
        << key.section << "." << key.name << " = " << value << ": " << error;
    EXPECT_NE(error.find(why), std::string::npos) << error;
}

bool isNumeric(const Key& key) {
    return scenes::ruleOf(key.kind).components > 0;
}
bool hasLow(const Key& key) {
    return key.range.low > -sim::ranges::largest;
}
bool hasHigh(const Key& key) {
    return key.range.high < sim::ranges::largest;
}

} // namespace

TEST(EveryNumericKey, AcceptsTheEndsOfItsRange) {
    for (const Key& key : scenes::schema()) {
        if (!isNumeric(key)) continue;
        if (hasLow(key) && !key.range.isLowOpen) {
            EXPECT_EQ(errorOf(key, text(key, key.range.low)), "");
        }
        if (hasHigh(key) && !key.range.isHighOpen) {
            EXPECT_EQ(errorOf(key, text(key, key.range.high)), "");
        }
    }
}

TEST(EveryNumericKey, RefusesTheOpenEndsOfItsRange) {
    for (const Key& key : scenes::schema()) {
        if (!isNumeric(key)) continue;
        if (key.range.isLowOpen)
            expectRefused(key, text(key, key.range.low), "must be " + sim::toText(key.range));
        if (key.range.isHighOpen)
            expectRefused(key, text(key, key.range.high), "must be " + sim::toText(key.range));
    }
}

TEST(EveryNumericKey, RefusesWhatLiesBelowOrAboveItsRange) {
    for (const Key& key : scenes::schema()) {
        if (!isNumeric(key)) continue;
        const std::string range = "must be " + sim::toText(key.range);
        if (hasLow(key)) expectRefused(key, text(key, key.range.low - step(key, key.range.low)), range);
        if (hasHigh(key)) expectRefused(key, text(key, key.range.high + step(key, key.range.high)), range);
    }
}

TEST(EveryNumericKey, RefusesNaNInfinityAndOverflow) {
    for (const Key& key : scenes::schema()) {
        if (!isNumeric(key)) continue;
        const bool isWhole = scenes::ruleOf(key.kind).isWhole;
        for (const char* value : {"nan", "inf", "-inf", "1e39", "-1e300"})
            expectRefused(key, repeated(key, value), isWhole ? "write " : "must be ");
        if (isWhole) expectRefused(key, repeated(key, "9223372036854775807"), "must be ");
    }
}

TEST(EveryNumericKey, RefusesOtherTypesAndSaysWhatItWants) {
    for (const Key& key : scenes::schema()) {
        if (!isNumeric(key)) continue;
        const scenes::KindRule& rule = scenes::ruleOf(key.kind);
        expectRefused(key, "\"5 cm\"", "text \"5 cm\": write " + std::string(rule.expected));
        expectRefused(key, "true", "write " + std::string(rule.expected));
        expectRefused(key, "{}", "write " + std::string(rule.expected));
        expectRefused(key, "[]", "a list of 0: write ");
        expectRefused(key, "1979-05-27", "write ");
        if (rule.isWhole) expectRefused(key, repeated(key, "3.0"), "the number 3: write ");
        if (rule.components > 1) expectRefused(key, "[1, 1, 1, 1]", "a list of 4: write ");
    }
}

TEST(EveryTextKey, RefusesNumbers) {
    for (const Key& key : scenes::schema())
        if (key.kind == Kind::text) expectRefused(key, "5", "the whole number 5: write text in quotes");
}

TEST(EveryTableKey, RefusesAValue) {
    for (const Key& key : scenes::schema()) {
        const std::string inner = key.section.empty() ? "" : std::string(key.section) + ".",
                          name = inner + std::string(key.name);
        if (key.kind == Kind::table) expectRefused(key, "5", "write [" + name + "]");
        if (key.kind == Kind::tables) expectRefused(key, "5", "write [[" + name + "]]");
    }
}

TEST(EveryRequiredKey, IsMissedAtTheHeadOfItsTable) {
    const std::string file = "test.toml";
    for (const Key& key : scenes::schema()) {
        if (!key.isRequired) continue;
        const std::string name(key.section.substr(key.section.rfind('.') + 1)); // the table of a nested table
        std::string text = "\n[[" + name + "]]\n";
        for (const Key& other : scenes::schema())
            if (other.section == key.section && other.isRequired && other.name != key.name)
                text += std::string(other.name) + " = " + filler(other) + "\n";
        const toml::table table = scenes::parse(text, file);
        const toml::table& body = *table.begin()->second.as_array()->get(0)->as_table();
        try {
            const scenes::Section section(body, key.section, "item", file);
            ADD_FAILURE() << key.name;
        } catch (const scenes::SceneError& error) {
            EXPECT_EQ(std::string(error.what())
                          .find("cannot read scene: test.toml:2: item." + std::string(key.name) +
                                " is missing: give "),
                      0u)
                << error.what();
        }
    }
}

TEST(EveryKey, IsSuggestedForAnUnknownOneOfItsSection) {
    for (const Key& key : scenes::schema()) {
        const std::string nothing = errorOf({key.section, "zzzzzzzzzzzzzzzz"}, "1");
        EXPECT_EQ(
            nothing.find("cannot read scene: test.toml:1: unknown key item.zzzzzzzzzzzzzzzz: possible are "),
            0u)
            << nothing;
        EXPECT_NE(nothing.find(std::string(key.name)), std::string::npos) << nothing;
        if (key.name.size() < 4) continue;
        std::string swapped(key.name);
        std::swap(swapped[1], swapped[2]);
        if (swapped == key.name || scenes::findKey(key.section, swapped) != nullptr) continue;
        EXPECT_NE(errorOf({key.section, swapped}, "1").find("did you mean " + std::string(key.name) + "?"),
                  std::string::npos)
            << swapped;
    }
}

TEST(EveryKey, OfAnotherTableIsToldItsTable) {
    EXPECT_NE(errorOf({"cloth", "gravity"}, "1").find(": it is a key of the file itself, above all tables"),
              std::string::npos)
        << errorOf({"cloth", "gravity"}, "1");
    EXPECT_NE(errorOf({"mesh", "substeps"}, "1").find(": it is a key of [solver]"), std::string::npos)
        << errorOf({"mesh", "substeps"}, "1");
    EXPECT_NE(errorOf({"box", "tethers"}, "1").find(": it is a key of [[cloth]]"), std::string::npos)
        << errorOf({"box", "tethers"}, "1");
    EXPECT_NE(errorOf({"cloth", "center"}, "[0, 0, 0]").find(": possible are name, origin, "),
              std::string::npos)
        << "several have it: " << errorOf({"cloth", "center"}, "[0, 0, 0]");
}

TEST(Section, GivesDefaultsWhereTheFileIsSilent) {
    const std::string file = "test.toml";
    const toml::table table = scenes::parse("spacing = 0.5", file);
    const scenes::Section cloth(table, "cloth", "cloth[0]", file);
    EXPECT_TRUE(cloth.has("spacing"));
    EXPECT_FALSE(cloth.has("size"));
    EXPECT_EQ(cloth.number("spacing"), 0.5f);
    EXPECT_EQ(cloth.counts<2>("size"), (std::array<std::uint32_t, 2>{64, 64}));
    EXPECT_EQ(cloth.vector("down").z, 1);
    EXPECT_EQ(cloth.text("name"), "cloth");
    EXPECT_TRUE(cloth.pins("pinned").empty());
}

TEST(Section, TakesWholeNumbersForNumbers) {
    const std::string file = "test.toml";
    const toml::table table = scenes::parse("gravity = [0, -10, 0.5]", file);
    const scenes::Section top(table, "", "", file);
    EXPECT_EQ(top.vector("gravity").y, -10);
    EXPECT_EQ(top.vector("gravity").z, 0.5f);
}
