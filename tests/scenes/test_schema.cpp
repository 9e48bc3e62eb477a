// Compares the table of keys with the documentation and with the defaults of the structs, and tests
// suggestions.
#include "scenes/schema.hpp"

#include "sinew/scene.hpp"

#include <gtest/gtest.h>
#include <toml++/toml.h>

#include <fstream>
#include <set>
#include <sstream>

using namespace sinew;
using scenes::Key;

namespace {

std::string documentation() {
    std::ifstream stream(SINEW_SOURCE_FOLDER "/docs/scene-files.md");
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

std::string code(std::string_view text) {
    std::string quoted = "`";
    return quoted.append(text).append("`");
}

/// The row of docs/scene-files.md that describes a key.
std::string rowOf(const Key& key) {
    const scenes::KindRule& rule = scenes::ruleOf(key.kind);
    const std::string fallback = key.isRequired ? "required" : key.fallback.empty() ? "" : code(key.fallback);
    std::string row = "|";
    for (const std::string& cell :
         {code(key.name), std::string(rule.expected), std::string(key.unit),
          rule.components > 0 ? sim::toText(key.range) : "", fallback, std::string(key.meaning)})
        row += " " + cell + " |";
    return row;
}

/// The part of the documentation from a section's heading to the next heading.
std::string partOf(const std::string& text, const Key& key) {
    std::string heading = "\n## Top level\n";
    const std::size_t dot = key.section.rfind('.'); // the table of a nested table
    const bool isInner = dot != std::string_view::npos;
    const std::string_view outer = isInner ? key.section.substr(0, dot) : "";
    const Key* table = scenes::findKey(outer, isInner ? key.section.substr(dot + 1) : key.section);
    if (table && !key.section.empty()) {
        const std::string name(key.section);
        heading = table->kind == scenes::Kind::tables ? "\n## [[" + name + "]]\n" : "\n## [" + name + "]\n";
    }
    const std::size_t begin = text.find(heading);
    if (begin == std::string::npos) return {};
    return text.substr(begin, text.find("\n## ", begin + heading.size()) - begin);
}

double numberOf(std::string_view section, std::string_view name) {
    const Key* key = scenes::findKey(section, name);
    return toml::parse("value = " + std::string(key->fallback))["value"].value<double>().value();
}

} // namespace

TEST(Schema, IsDocumentedKeyByKeyInItsOwnWords) {
    const std::string text = documentation();
    ASSERT_FALSE(text.empty());
    for (const Key& key : scenes::schema())
        EXPECT_NE(partOf(text, key).find(rowOf(key)), std::string::npos) << "docs/scene-files.md lacks:\n"
                                                                         << rowOf(key);
}

TEST(Schema, NamesNoKeyTwice) {
    std::set<std::pair<std::string_view, std::string_view>> seen;
    for (const Key& key : scenes::schema())
        EXPECT_TRUE(seen.insert({key.section, key.name}).second) << key.name;
}

TEST(Schema, HasTheDefaultsOfTheStructs) {
    const sim::Scene scene;
    const sim::Settings settings;
    EXPECT_EQ(static_cast<float>(numberOf("", "dt")), scene.dt);
    EXPECT_EQ(static_cast<float>(numberOf("", "damping")), scene.damping);
    EXPECT_EQ(scenes::findKey("solver", "substeps")->fallback, "\"auto\"");
    EXPECT_EQ(settings.substeps, 0u);
    EXPECT_EQ(static_cast<float>(numberOf("solver", "tolerance")), settings.tolerance);
    EXPECT_EQ(static_cast<float>(numberOf("", "damping_time")), scene.dampingTime);
    EXPECT_EQ(numberOf("solver", "iterations"), settings.iterations);
    EXPECT_EQ(static_cast<float>(numberOf("solver", "omega")), settings.omega);
    EXPECT_EQ(static_cast<float>(numberOf("solver", "theta")), settings.theta);
    EXPECT_EQ(static_cast<float>(numberOf("solver", "weight")), settings.weight);
    EXPECT_EQ(static_cast<float>(numberOf("solver", "over_relaxation")), settings.overRelaxation);
    EXPECT_EQ(static_cast<float>(numberOf("solver", "warm_start")), settings.warmStart);
    EXPECT_EQ(scenes::findKey("solver", "sharp_clamp")->fallback,
              "true"); // a host asks for it: docs/clamp.md
    EXPECT_FALSE(settings.hasSharpClamp);
    EXPECT_EQ(scenes::findKey("solver", "sleep")->fallback, settings.sleeps ? "true" : "false");
}

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
    EXPECT_EQ(scenes::editDistance("spacing", "spacing"), 0u);
    EXPECT_EQ(scenes::editDistance("spaing", "spacing"), 1u);
    EXPECT_EQ(scenes::editDistance("spaccing", "spacing"), 1u);
    EXPECT_EQ(scenes::editDistance("spazing", "spacing"), 1u);
    EXPECT_EQ(scenes::editDistance("spacign", "spacing"), 1u);
    EXPECT_EQ(scenes::editDistance("", "dt"), 2u);
}

TEST(Suggestions, FindEveryKeyFromOneMisspelling) {
    for (const Key& key : scenes::schema()) {
        if (key.name.size() < 5) continue; // shorter names may be as similar to another key
        for (const std::string& wrong :
             {std::string(key.name) + "s", std::string(key.name.substr(1)),
              std::string(1, key.name[1]) + key.name[0] + std::string(key.name.substr(2))})
            EXPECT_EQ(scenes::nearestKey(key.section, wrong).name, key.name) << wrong;
    }
}

TEST(Suggestions, StayInTheirSection) {
    EXPECT_EQ(scenes::nearestKey("plane", "spacing").section, "plane");
    EXPECT_EQ(scenes::nearestKey("solver", std::string(1'000'000, 'x')).section, "solver");
}
