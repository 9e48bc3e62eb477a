// Input logs as text: a head, then one event per line.
#include "viewer/input/input_log.hpp"

#include "app/guard.hpp"
#include "app/kept_forms.hpp"
#include "sinew/ranges.hpp"
#include "sinew/solver_names.hpp"
#include "viewer/input/tool.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace sinew::viewer {

namespace {

constexpr std::string_view title = "sinew input 2";
constexpr std::string_view titleBefore = "sinew input 1"; // where "solve" lost all states to go back to
static_assert(title.size() == titleBefore.size());

// Builds a line of words with blanks between them.
class Line {
public:
    explicit Line(std::string_view name) : text_(name) {}
    template <typename Number> Line& add(Number number, int base = 0) {
        std::array<char, 48> digits{};
        char* const end = digits.data() + digits.size();
        if constexpr (std::is_floating_point_v<Number>)
            text_.append(" ").append(digits.data(), std::to_chars(digits.data(), end, number).ptr);
        else
            text_.append(" ").append(digits.data(),
                                     std::to_chars(digits.data(), end, number, base == 0 ? 10 : base).ptr);
        return *this;
    }
    template <typename Vector> Line& addAll(const Vector& vector) {
        for (const float number : vector) add(number);
        return *this;
    }
    Line& addWord(std::string_view word) {
        text_.append(" ").append(word);
        return *this;
    }
    std::string end() { return std::move(text_) + "\n"; }

private:
    std::string text_;
};

std::string text(const Camera& camera) {
    return Line("camera")
        .addAll(camera.target)
        .add(camera.distance)
        .add(camera.azimuth)
        .add(camera.elevation)
        .add(camera.fieldOfView)
        .add(camera.lowestEye)
        .end();
}

std::string text(const Pointed& pointed) {
    return Line("pointer").addAll(pointed.at).end();
}

std::string text(const Pressed& pressed) {
    return Line(pressed.isDown ? "press" : "release").addAll(pressed.at).end();
}

std::string text(Action action) {
    return "key " + std::string(keyOf(action)) + "\n";
}

std::string text(const Answered& answered) {
    const std::string_view tool = toolTable()[answered.tool]->name;
    if (!answered.pick) return Line(tool).addWord("nothing").end();
    const Pick& pick = *answered.pick;
    return Line(tool).add(pick.particle).addAll(pick.point).addAll(pick.offset).add(answered.radius).end();
}

std::string text(const Pulled& pulled) {
    return Line("gravity").add(pulled.gravity).end();
}

// A dash stands for the scene's own value.
std::string text(const Turned& turned) {
    const sim::Material& material = turned.material;
    Line line("material");
    line.add(material.stiffness);
    for (const std::optional<float>& own : {material.damping, material.friction})
        if (own)
            line.add(*own);
        else
            line.addWord("-");
    return line.addAll(material.bodies).end();
}

std::string text(const Shaped& shaped) {
    return Line("solve").addWord(sim::solverName(shaped.solver)).add(shaped.substeps).end();
}

std::string text(const ToolSet& set) {
    Line line(toolTable()[set.tool]->setting);
    return set.setting ? line.add(*set.setting).end() : line.addWord("-").end();
}

std::string text(const Forgot& forgot) {
    return forgot.areOfSteps ? "forget steps\n" : "forget\n";
}

std::string text(const Stepped& stepped) {
    return Line("steps").add(stepped.count).end();
}

// Reads the rest of a line, word by word.
class Words {
public:
    explicit Words(const std::string& line) : words_(line) {}
    std::string word() {
        std::string next;
        if (!(words_ >> next)) throw std::runtime_error("the line is incomplete");
        return next;
    }
    template <typename Number> Number number(int base = 10) {
        const std::string text = word();
        Number value{};
        const char* const end = text.data() + text.size();
        std::from_chars_result read{};
        if constexpr (std::is_floating_point_v<Number>)
            read = std::from_chars(text.data(), end, value);
        else
            read = std::from_chars(text.data(), end, value, base);
        if (read.ec != std::errc() || read.ptr != end) throw std::runtime_error("not a number: " + text);
        return value;
    }
    float finite() {
        const auto value = number<float>();
        if (!std::isfinite(value)) throw std::runtime_error("not a finite number");
        return value;
    }
    // A number, or empty for a dash.
    std::optional<float> finiteOrNone() {
        const std::string next = word();
        return next == "-" ? std::nullopt : std::optional(Words(next).finite());
    }
    bool isAtEnd() { return (words_ >> std::ws).eof(); }
    Vector2 pair() {
        const float x = finite();
        return {x, finite()};
    }
    Vector3 triple() {
        const float x = finite(), y = finite();
        return {x, y, finite()};
    }
    std::string rest() {
        std::string all;
        std::getline(words_ >> std::ws, all);
        if (all.empty()) throw std::runtime_error("the line is incomplete");
        return all;
    }
    void end() {
        std::string more;
        if (words_ >> more) throw std::runtime_error("unexpected text on the line: " + more);
    }

private:
    std::istringstream words_;
};

Camera readCamera(Words& words) {
    Camera camera{.target = words.triple()};
    camera.distance = words.finite();
    camera.azimuth = words.finite();
    camera.elevation = words.finite();
    camera.fieldOfView = words.finite();
    camera.lowestEye = words.number<float>();
    if (!(camera.distance > 0) || !(camera.fieldOfView > 0) || std::isnan(camera.lowestEye))
        throw std::runtime_error("invalid camera");
    return camera;
}

template <bool isDown> void readPress(InputFile& to, Words& words) {
    to.events.emplace_back(Pressed{isDown, words.pair()});
}

Action readKey(Words& words) {
    const std::string shown = words.rest();
    const auto known = std::ranges::find(bindings(), shown, &Binding::shown);
    if (known == bindings().end()) throw std::runtime_error("unknown action: " + shown);
    return known->action;
}

Answered readAnswer(std::size_t tool, Words& words) {
    const std::string first = words.word();
    if (first == "nothing") return {.tool = tool};
    Pick pick{.particle = Words(first).number<std::uint32_t>()};
    pick.point = words.triple();
    pick.offset = words.triple();
    return {tool, pick, words.finite()};
}

ToolSet readSetting(std::size_t tool, Words& words) {
    return {tool, toolTable()[tool]->isSettingOptional ? words.finiteOrNone() : words.finite()};
}

// An answer to the question of a tool, or its setting; false if no tool has lines of this name.
bool readTool(const std::string& name, InputFile& to, Words& words) {
    for (std::size_t i = 0; i < toolTable().size(); ++i) {
        const Tool& tool = *toolTable()[i];
        if (name == tool.name)
            to.events.emplace_back(readAnswer(i, words));
        else if (name == tool.setting)
            to.events.emplace_back(readSetting(i, words));
        else
            continue;
        return true;
    }
    return false;
}

sim::Material readMaterial(Words& words) {
    sim::Material material{.stiffness = words.finite()};
    material.damping = words.finiteOrNone();
    material.friction = words.finiteOrNone();
    while (!words.isAtEnd()) material.bodies.push_back(words.finite());
    const auto isFactor = [](float factor) { return factor > 0; };
    if (!isFactor(material.stiffness) || !std::ranges::all_of(material.bodies, isFactor) ||
        material.damping.value_or(0) < 0 || material.friction.value_or(0) < 0)
        throw std::runtime_error("invalid material");
    return material;
}

Shaped readShape(Words& words) {
    Shaped shaped;
    const std::string solver = words.word();
    if (!sim::parseSolver(solver, shaped.solver)) throw std::runtime_error("no solver is called " + solver);
    shaped.substeps = words.number<std::uint32_t>();
    if (!sim::ranges::substeps.holds(shaped.substeps))
        throw std::runtime_error("substeps must be " + sim::toText(sim::ranges::substeps));
    return shaped;
}

sim::Forms readForms(Words& words) {
    const std::optional<sim::Forms> forms = app::parseForms(words.word());
    if (!forms) throw std::runtime_error("invalid forms");
    return *forms;
}

SavedOrigin readOrigin(Words& words) {
    SavedOrigin from;
    from.hash = words.number<std::uint64_t>(16);
    from.file = words.rest();
    return from;
}

Forgot readForgot(Words& words) {
    if (words.isAtEnd()) return {};
    if (words.word() != "steps") throw std::runtime_error("forget must be alone, or followed by steps");
    return {.areOfSteps = true};
}

struct Reader {
    std::string_view name;
    void (*read)(InputFile&, Words&);
};

const std::array readers{
    Reader{"scene", [](InputFile& to, Words& words) { to.scene = words.rest(); }},
    Reader{"from", [](InputFile& to, Words& words) { to.from = readOrigin(words); }},
    Reader{"solver", [](InputFile& to, Words& words) { to.solver = words.word(); }},
    Reader{"substeps", [](InputFile& to, Words& words) { to.substeps = words.number<std::uint32_t>(); }},
    Reader{"levels", [](InputFile& to, Words& words) { to.levels = words.number<std::uint32_t>(); }},
    Reader{"sharp_clamp",
           [](InputFile& to, Words& words) { to.hasSharpClamp = words.number<std::uint32_t>() != 0; }},
    Reader{"room", [](InputFile& to, Words& words) { to.room = words.number<std::uint32_t>(); }},
    Reader{"surface", [](InputFile& to, Words& words) { to.surface = words.number<std::uint32_t>(); }},
    Reader{"forms", [](InputFile& to, Words& words) { to.forms = readForms(words); }},
    Reader{"camera", [](InputFile& to, Words& words) { to.events.emplace_back(readCamera(words)); }},
    Reader{"pointer", [](InputFile& to, Words& words) { to.events.emplace_back(Pointed{words.pair()}); }},
    Reader{"press", readPress<true>},
    Reader{"release", readPress<false>},
    Reader{"key", [](InputFile& to, Words& words) { to.events.emplace_back(readKey(words)); }},
    Reader{"gravity", [](InputFile& to, Words& words) { to.events.emplace_back(Pulled{words.finite()}); }},
    Reader{"material",
           [](InputFile& to, Words& words) { to.events.emplace_back(Turned{readMaterial(words)}); }},
    Reader{"solve", [](InputFile& to, Words& words) { to.events.emplace_back(readShape(words)); }},
    Reader{"forget", [](InputFile& to, Words& words) { to.events.emplace_back(readForgot(words)); }},
    Reader{"steps", [](InputFile& to,
                       Words& words) { to.events.emplace_back(Stepped{words.number<std::uint32_t>()}); }},
    Reader{"state", [](InputFile& to, Words& words) { to.hash = words.number<std::uint64_t>(16); }}};

void readLine(const std::string& line, InputFile& file) {
    if (line.empty() || line.front() == '#') return;
    Words words(line);
    const std::string name = words.word();
    const auto* reader = std::ranges::find(readers, name, &Reader::name);
    if (reader != readers.end())
        reader->read(file, words);
    else if (!readTool(name, file, words))
        throw std::runtime_error("unknown event: " + name);
    words.end();
}

[[noreturn]] void refuse(const std::string& where, const std::string& why) {
    throw app::Failure(app::badInput, "cannot read input: " + where + ": " + why + ": save it with " +
                                          std::string(keyOf(Action::saveInput)) + " in the window");
}

} // namespace

std::string toText(const InputFile& file) {
    std::string all = std::string(title) + "\n";
    if (!file.scene.empty()) all += "scene " + file.scene + "\n";
    if (file.from) all += Line("from").add(file.from->hash, 16).addWord(file.from->file).end();
    if (!file.solver.empty()) all += "solver " + file.solver + "\n";
    if (file.substeps > 0) all += Line("substeps").add(file.substeps).end();
    if (file.levels) all += Line("levels").add(*file.levels).end();
    if (file.hasSharpClamp) all += Line("sharp_clamp").add(std::uint32_t{*file.hasSharpClamp}).end();
    if (file.room > 0) all += Line("room").add(file.room).end();
    if (file.surface > 0) all += Line("surface").add(file.surface).end();
    if (file.forms) all += Line("forms").addWord(app::toText(*file.forms)).end();
    for (const InputEvent& event : file.events)
        all += std::visit([](const auto& one) { return text(one); }, event);
    if (file.hash) all += Line("state").add(*file.hash, 16).end();
    return all;
}

InputFile parseInput(const std::string& text, const std::string& name) {
    InputFile file;
    std::istringstream lines(text);
    std::string line;
    if (!std::getline(lines, line) || (line != title && line != titleBefore))
        refuse(name, "it does not begin with " + std::string(title));
    const bool forgetsWithSolver = line == titleBefore;
    for (std::size_t number = 2; std::getline(lines, line); ++number) {
        try {
            readLine(line, file);
            if (forgetsWithSolver && line.starts_with("solve ")) file.events.emplace_back(Forgot{});
        } catch (const std::runtime_error& error) {
            refuse(name + ":" + std::to_string(number), error.what());
        }
    }
    return file;
}

InputFile loadInput(const std::filesystem::path& file) {
    std::error_code error;
    std::ostringstream text;
    if (std::filesystem::is_regular_file(file, error)) {
        std::ifstream stream(file, std::ios::binary);
        std::string head(title.size(), ' '); // other files, which may be large, are not read
        stream.read(head.data(), static_cast<std::streamsize>(head.size()));
        text << head;
        if (head == title || head == titleBefore) text << stream.rdbuf();
    } else if (std::filesystem::exists(file, error))
        refuse(file.string(), "it is not a file");
    else
        refuse(file.string(), "there is no such file");
    return parseInput(text.str(), file.string());
}

} // namespace sinew::viewer
