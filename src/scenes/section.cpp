// Checks are driven by the schema alone: no key has code of its own here.
#include "scenes/section.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <stdexcept>

namespace sinew::scenes {

namespace {

const toml::table emptyTable;

std::string shortest(double value) {
    char text[32];
    return {text, std::to_chars(std::begin(text), std::end(text), value).ptr};
}

/// What the file has there, in words and no longer than a line.
std::string describeValue(const toml::node& node) {
    if (const auto* text = node.as_string()) {
        const std::string& value = text->get();
        return "text \"" + value.substr(0, 40) + (value.size() > 40 ? "..." : "") + "\"";
    }
    if (const auto* value = node.as_floating_point()) return "the number " + shortest(value->get());
    if (const auto* value = node.as_integer()) return "the whole number " + std::to_string(value->get());
    if (const auto* list = node.as_array()) return "a list of " + std::to_string(list->size());
    std::ostringstream type;
    type << node.type();
    return "a value of type " + type.str();
}

std::string expectedText(const Key& key) {
    const std::string name =
        (key.section.empty() ? "" : std::string(key.section) + ".") + std::string(key.name);
    if (key.kind == Kind::table) return "[" + name + "]";
    if (key.kind == Kind::tables) return "[[" + name + "]]";
    std::string text(ruleOf(key.kind).expected);
    if (!key.unit.empty()) text += " in " + std::string(key.unit);
    return text;
}

/// "[solver]", "[[hold.keyframe]]": the head of the tables of a section.
std::string headOf(std::string_view section) {
    for (const Key& key : schema())
        if (key.kind == Kind::table || key.kind == Kind::tables)
            if (const std::string head = expectedText(key);
                head.find("[" + std::string(section) + "]") != head.npos)
                return head;
    return "the file itself, above all tables";
}

/// "did you mean radius?"; where nothing is spelled alike, the one table that has such a key, or all keys of
/// this one.
std::string adviceFor(std::string_view section, std::string_view name) {
    const Key& nearest = nearestKey(section, name);
    if (3 * editDistance(nearest.name, name) <= nearest.name.size())
        return "did you mean " + std::string(nearest.name) + "?";
    if (std::ranges::count(schema(), name, &Key::name) == 1)
        return "it is a key of " + headOf(std::ranges::find(schema(), name, &Key::name)->section);
    std::string names;
    for (const Key& key : schema())
        if (key.section == section) names += (names.empty() ? "" : ", ") + std::string(key.name);
    return "possible are " + names;
}

bool isPin(const toml::node& node) {
    if (node.is_string()) return true;
    const toml::array* pair = node.as_array();
    return pair && pair->size() == 2 && pair->get(0)->is_integer() && pair->get(1)->is_integer();
}

bool isPinList(const toml::node& node) {
    const toml::array* list = node.as_array();
    if (!list) return false;
    for (const toml::node& element : *list)
        if (!isPin(element)) return false;
    return true;
}

bool isNameList(const toml::node& node) {
    const toml::array* list = node.as_array();
    return list && (list->empty() || list->is_homogeneous(toml::node_type::string));
}

bool isNameOrNames(const toml::node& node) {
    return node.is_string() || isNameList(node);
}

bool isNumberList(const toml::node& node) {
    const toml::array* list = node.as_array();
    return list && std::ranges::all_of(*list, [](const toml::node& element) { return element.is_number(); });
}

bool isPoint(const toml::node& node) {
    return isNumberList(node) && node.as_array()->size() == 3;
}

bool isLineList(const toml::node& node) {
    const auto isLine = [](const toml::node& line) {
        return line.as_array() && std::ranges::all_of(*line.as_array(), isPoint);
    };
    return node.as_array() && std::ranges::all_of(*node.as_array(), isLine);
}

double numberOf(const toml::node& node) {
    return node.is_integer() ? static_cast<double>(node.as_integer()->get())
                             : node.as_floating_point()->get();
}

bool isAuto(const toml::node& node) {
    return node.value_or(std::string_view()) == "auto";
}

bool isTables(const toml::node& node) {
    return node.is_array_of_tables();
}

/// A node as the numbers of a kind: itself, or the elements of a list of the right length. Null where it is
/// neither.
const toml::node* numberAt(const toml::node& node, const KindRule& rule, std::size_t index) {
    const toml::array* list = node.as_array();
    if (rule.components == 1) return &node;
    return list && list->size() == rule.components ? list->get(index) : nullptr;
}

} // namespace

Section::Section(const toml::table& table, std::string_view section, std::string label,
                 const std::string& file)
    : table_(table), section_(section), label_(std::move(label)), file_(file) {
    for (const auto& [name, value] : table) check(name, value);
    std::string defaults;
    for (const Key& key : schema()) {
        if (key.section != section_) continue;
        if (key.isRequired && !table.contains(key.name))
            fail(key.name, "is missing", "give " + expectedText(key));
        if (!key.fallback.empty())
            defaults += std::string(key.name) + " = " + std::string(key.fallback) + "\n";
    }
    defaults_ = toml::parse(defaults);
}

void Section::check(const toml::key& name, const toml::node& node) const {
    const Key* key = findKey(section_, name.str());
    if (!key)
        scenes::fail(lineOf(file_, name.source()), "unknown key " + fullName(name.str().substr(0, 64)),
                     adviceFor(section_, name.str()));
    const bool isRight = key->kind == Kind::text          ? node.is_string()
                         : key->kind == Kind::pins        ? isPinList(node)
                         : key->kind == Kind::names       ? isNameList(node)
                         : key->kind == Kind::nameOrNames ? isNameOrNames(node)
                         : key->kind == Kind::flag        ? node.is_boolean()
                         : key->kind == Kind::numbers     ? isNumberList(node)
                         : key->kind == Kind::lines       ? isLineList(node)
                         : key->kind == Kind::table       ? node.is_table()
                         : key->kind == Kind::tables      ? isTables(node)
                                                          : true;
    if (!isRight) fail(key->name, "is " + describeValue(node), "write " + expectedText(*key));
    if (key->kind == Kind::countOrAuto && isAuto(node)) return;
    if (ruleOf(key->kind).components > 0) checkNumbers(*key, node);
    if (key->kind == Kind::numbers)
        for (const double value : numbers(key->name)) checkRange(*key, value);
    if (key->kind == Kind::lines)
        for (const auto& line : lines(key->name))
            for (const auto& point : line)
                for (const double value : point) checkRange(*key, value);
}

void Section::checkNumbers(const Key& key, const toml::node& node) const {
    const KindRule& rule = ruleOf(key.kind);
    for (std::size_t i = 0; i < rule.components; ++i) {
        const toml::node* element = numberAt(node, rule, i);
        const bool isRight =
            element && (element->is_integer() || (element->is_floating_point() && !rule.isWhole));
        if (!isRight) {
            const toml::node& wrong = element ? *element : node;
            const char* hint = wrong.is_string() ? ", without quotes and unit" : "";
            fail(key.name, "is " + describeValue(wrong), "write " + expectedText(key) + hint);
        }
        // not value<double>(): that is empty for whole numbers that a double cannot hold
        checkRange(key, numberOf(*element));
    }
}

void Section::checkRange(const Key& key, double value) const {
    // As the simulation will see it: 1e-60 is 0 in float32, 1e39 infinite.
    const double seen = double{static_cast<float>(value)};
    if (key.range.holds(seen) && sim::ranges::finite.holds(seen)) return;
    const std::string unit = key.unit.empty() ? "" : " " + std::string(key.unit);
    fail(key.name, "is " + shortest(value) + unit, "must be " + sim::toText(key.range) + unit);
}

std::string Section::fullName(std::string_view name) const {
    return (label_.empty() ? "" : label_ + ".") + std::string(name);
}

void Section::fail(std::string_view name, const std::string& why, const std::string& whatToDo) const {
    const toml::node* node = table_.get(name);
    const toml::source_region& region = node ? node->source() : table_.source();
    scenes::fail(lineOf(file_, region), fullName(name) + " " + why, whatToDo);
}

void Section::requireOneOf(std::string_view first, std::string_view second) const {
    const std::string both = std::string(first) + " or " + std::string(second);
    if (has(first) && has(second)) fail(second, "is given beside " + std::string(first), "give " + both);
    if (!has(first) && !has(second)) fail(first, "is missing", "give " + both);
}

const toml::node& Section::node(std::string_view name) const {
    if (const toml::node* found = table_.get(name)) return *found;
    if (const toml::node* found = defaults_.get(name)) return *found;
    throw std::logic_error("scene key " + fullName(name) + " has neither a value nor a default");
}

double Section::component(std::string_view name, std::size_t index) const {
    const Key* key = findKey(section_, name);
    const toml::node* element = key ? numberAt(node(name), ruleOf(key->kind), index) : nullptr;
    if (!element) throw std::logic_error("scene key " + fullName(name) + " does not hold such a number");
    return element->value<double>().value_or(0);
}

std::string Section::text(std::string_view name) const {
    return node(name).value_or(std::string());
}

float Section::number(std::string_view name) const {
    return static_cast<float>(component(name, 0));
}

std::uint32_t Section::count(std::string_view name) const {
    return counts<1>(name)[0];
}

std::optional<std::uint32_t> Section::countOrAuto(std::string_view name) const {
    if (isAuto(node(name))) return {};
    return count(name);
}

sim::Vec3 Section::vector(std::string_view name) const {
    return {static_cast<float>(component(name, 0)), static_cast<float>(component(name, 1)),
            static_cast<float>(component(name, 2))};
}

bool Section::flag(std::string_view name) const {
    return node(name).value_or(false);
}

std::vector<Section::Pin> Section::pins(std::string_view name) const {
    std::vector<Pin> result;
    const toml::array* list = node(name).as_array();
    for (std::size_t i = 0; list && i < list->size(); ++i) {
        const toml::node& element = *list->get(i);
        if (const toml::array* pair = element.as_array())
            result.push_back(
                {{}, {pair->get(0)->value_or(std::int64_t{0}), pair->get(1)->value_or(std::int64_t{0})}});
        else
            result.push_back({element.value_or(std::string()), {}});
    }
    return result;
}

std::vector<std::string> Section::names(std::string_view name) const {
    std::vector<std::string> result;
    if (node(name).is_string()) result.push_back(text(name));
    const toml::array* list = node(name).as_array();
    for (std::size_t i = 0; list && i < list->size(); ++i)
        result.push_back(list->get(i)->value_or(std::string()));
    return result;
}

std::vector<double> Section::numbers(std::string_view name) const {
    std::vector<double> result;
    for (const toml::node& element : *node(name).as_array()) result.push_back(numberOf(element));
    return result;
}

std::vector<std::vector<std::array<double, 3>>> Section::lines(std::string_view name) const {
    std::vector<std::vector<std::array<double, 3>>> result;
    for (const toml::node& element : *node(name).as_array()) {
        auto& line = result.emplace_back();
        for (const toml::node& point : *element.as_array()) {
            const toml::array& axes = *point.as_array();
            line.push_back({numberOf(axes[0]), numberOf(axes[1]), numberOf(axes[2])});
        }
    }
    return result;
}

std::vector<Section> Section::list(std::string_view name) const {
    std::vector<Section> result;
    const toml::array* tables = table_.get_as<toml::array>(name);
    const std::string_view section = sectionOf(section_, name);
    for (std::size_t i = 0; tables && i < tables->size(); ++i)
        result.emplace_back(*tables->get(i)->as_table(), section,
                            fullName(name) + "[" + std::to_string(i) + "]", file_);
    return result;
}

Section Section::child(std::string_view name) const {
    const toml::table* table = table_.get_as<toml::table>(name);
    return {table ? *table : emptyTable, sectionOf(section_, name), fullName(name), file_};
}

} // namespace sinew::scenes
