// One table of a scene file, checked against the schema as a whole before anything is read from it.
#pragma once

#include "scenes/schema.hpp"
#include "scenes/source_file.hpp"

#include <array>
#include <optional>
#include <vector>

namespace sinew::scenes {

class Section {
public:
    /// `label` names the table in errors: "cloth[0]"; empty for the top level. Throws SceneError for the
    /// first unknown key, wrong type, number out of range or missing required key. Keeps references to all
    /// but `label`.
    Section(const toml::table& table, std::string_view section, std::string label, const std::string& file);

    /// How errors name the table: "cloth[0]"; empty for the top level.
    const std::string& label() const { return label_; }

    /// In the file itself, not by its default.
    bool has(std::string_view name) const { return table_.contains(name); }

    /// The value in the file or else the default. Asking for a key that has neither is a fault of ours.
    std::string text(std::string_view name) const;
    float number(std::string_view name) const;
    std::uint32_t count(std::string_view name) const;
    /// Of Kind::countOrAuto: empty for "auto".
    std::optional<std::uint32_t> countOrAuto(std::string_view name) const;
    sim::Vec3 vector(std::string_view name) const;
    bool flag(std::string_view name) const;
    /// In the precision of the file.
    double value(std::string_view name) const { return component(name, 0); }
    std::array<double, 3> point(std::string_view name) const {
        return {component(name, 0), component(name, 1), component(name, 2)};
    }
    template <std::size_t size> std::array<std::uint32_t, size> counts(std::string_view name) const {
        std::array<std::uint32_t, size> result{};
        for (std::size_t i = 0; i < size; ++i) result[i] = static_cast<std::uint32_t>(component(name, i));
        return result;
    }
    /// An element of `pinned`: the name of a corner or edge, or [column, row].
    struct Pin {
        std::string name;
        std::array<std::int64_t, 2> at{};
    };
    std::vector<Pin> pins(std::string_view name) const;

    /// A list of texts, or a text alone.
    std::vector<std::string> names(std::string_view name) const;

    std::vector<double> numbers(std::string_view name) const;
    std::vector<std::vector<std::array<double, 3>>> lines(std::string_view name) const;

    /// The tables [[name]] in order.
    std::vector<Section> list(std::string_view name) const;
    /// The table [name]; empty where the file has none, so that its defaults apply.
    Section child(std::string_view name) const;

    /// Throws SceneError at the line of `name`, or of the table's head where the file has no such key.
    [[noreturn]] void fail(std::string_view name, const std::string& why, const std::string& whatToDo) const;
    /// Fails unless exactly one of two keys is given.
    void requireOneOf(std::string_view first, std::string_view second) const;

private:
    void check(const toml::key& name, const toml::node& node) const;
    void checkNumbers(const Key& key, const toml::node& node) const;
    void checkRange(const Key& key, double value) const;
    const toml::node& node(std::string_view name) const;
    double component(std::string_view name, std::size_t index) const;
    std::string fullName(std::string_view name) const;

    const toml::table& table_;
    std::string_view section_;
    std::string label_;
    const std::string& file_;
    toml::table defaults_;
};

} // namespace sinew::scenes
