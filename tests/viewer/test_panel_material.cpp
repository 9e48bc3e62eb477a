// Tests of materials with Young's moduli: presets, sliders in kPa, numbers that are typed.
#include "panels_test.hpp"

#include "viewer/ui/number_text.hpp"
#include "viewer/ui/panel_parts.hpp"
#include "viewer/ui/presets.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace sinew::viewer {
namespace {

SceneFacts bodiesOf(std::vector<float> moduli) {
    SceneFacts scene = someScene();
    for (std::size_t i = 0; i < moduli.size(); ++i) scene.bodies.push_back("body " + std::to_string(i));
    scene.fromFile.bodies.assign(moduli.size(), 1);
    scene.youngModuli = std::move(moduli);
    return scene;
}

TEST(Presets, HaveDifferentNamesModuliAndSources) {
    std::set<std::string_view> names, sources;
    for (const MaterialPreset& preset : materialPresets()) {
        names.insert(preset.name);
        sources.insert(preset.source);
        EXPECT_GT(preset.youngModulus, 100) << preset.name;
        EXPECT_LT(preset.youngModulus, 1e7) << preset.name;
    }
    EXPECT_EQ(names.size(), materialPresets().size());
    EXPECT_EQ(sources.size(), materialPresets().size());
    EXPECT_EQ(sources.count(""), 0u);
}

TEST(Presets, ChangeAllBodiesOrTheChosenOne) {
    const SceneFacts alike = bodiesOf({2e4f, 2e4f});
    Knobs knobs = withYoungModulus(alike, alike.fromFile, 5e3f);
    EXPECT_FLOAT_EQ(knobs.stiffness, 0.25f) << "one factor is enough";
    EXPECT_EQ(knobs.bodies, alike.fromFile.bodies);
    EXPECT_FLOAT_EQ(youngModulusOf(alike, knobs).value(), 5e3f);

    knobs.body = 1;
    knobs = withYoungModulus(alike, knobs, 1e4f);
    EXPECT_FLOAT_EQ(youngModulusOf(alike, knobs).value(), 1e4f);
    knobs.body = 0;
    EXPECT_FLOAT_EQ(youngModulusOf(alike, knobs).value(), 5e3f) << "the other one is as before";
    knobs.body = -1;
    EXPECT_FALSE(youngModulusOf(alike, knobs)) << "they differ";
}

TEST(Presets, GiveDifferentBodiesOneModulusAndLeaveOthersAlone) {
    const SceneFacts mixed = bodiesOf({1e4f, 0, 4e4f});
    EXPECT_FALSE(youngModulusOf(mixed, mixed.fromFile));
    Knobs before = mixed.fromFile;
    before.stiffness = 3;
    const Knobs knobs = withYoungModulus(mixed, before, 2e4f);
    for (const int body : {0, 2}) {
        Knobs chosen = knobs;
        chosen.body = body;
        EXPECT_FLOAT_EQ(youngModulusOf(mixed, chosen).value(), 2e4f) << body;
    }
    EXPECT_FLOAT_EQ(knobs.stiffness * knobs.bodies[1], 3) << "cloth keeps its stiffness";
    const SceneFacts cloth = bodiesOf({0});
    EXPECT_FALSE(hasYoungModulus(cloth));
    EXPECT_EQ(withYoungModulus(cloth, before, 2e4f).bodies[0], 3) << "and its factor is the product";
}

class MaterialTest : public PanelsTest {
protected:
    MaterialTest() {
        scene = bodiesOf({2e4f});
        facts.knobs = scene.fromFile;
    }
    // All moduli that clicks lead to, in the column at x, with the height of the click.
    std::map<float, float> moduliOfClicks(float x) {
        std::map<float, float> found;
        for (float y = 20; y < 700; y += 6)
            if (const auto knobs = click({x, y}).knobs)
                if (const auto modulus = youngModulusOf(scene, *knobs)) found.emplace(*modulus, y);
        return found;
    }
    // The number beside the first slider, just clicked.
    std::optional<Vector2> stiffnessField() {
        settle();
        for (float y = 20; y < 700; y += 6) {
            click({1210, y});
            picture({.pointer = {1210, y}});
            if (panels.takesKeys()) return Vector2(1210, y);
        }
        return std::nullopt;
    }
    void type(const Vector2& at, const std::string& text) {
        PanelInput input{.pointer = at};
        for (const char one : text) input.characters.push_back(static_cast<unsigned>(one));
        picture(input);
    }
    // The value that Enter sets after a text.
    std::optional<Knobs> typed(const Vector2& at, const std::string& text) {
        type(at, text);
        return picture({.pointer = at, .keys = {{GLFW_KEY_ENTER, true}, {GLFW_KEY_ENTER, false}}}).knobs;
    }
};

TEST_F(MaterialTest, HasAButtonForEveryPreset) {
    settle();
    std::map<float, float> found;
    for (const float x : {1010.0f, 1080.0f, 1150.0f, 1220.0f}) found.merge(moduliOfClicks(x));
    for (const MaterialPreset& preset : materialPresets()) {
        const auto next = found.lower_bound(preset.youngModulus * 0.999f);
        ASSERT_NE(next, found.end()) << preset.name;
        EXPECT_NEAR(next->first, preset.youngModulus, 1e-3f * preset.youngModulus) << preset.name;
    }
    facts.knobs.stiffness = 5;
    settle();
    std::set<float> factors;
    for (float y = 20; y < 700; y += 6)
        if (const auto knobs = click({1220, y}).knobs) factors.insert(knobs->stiffness);
    EXPECT_TRUE(factors.contains(1)) << "back to the file";
}

TEST_F(MaterialTest, TakesAModulusThatIsTypedInKiloPascals) {
    const std::optional<Vector2> field = stiffnessField();
    ASSERT_TRUE(field);
    const std::optional<Knobs> knobs = typed(*field, "7.5");
    ASSERT_TRUE(knobs);
    EXPECT_FLOAT_EQ(youngModulusOf(scene, *knobs).value(), 7.5e3f) << "stiffness is the first";
    settle();
    EXPECT_FALSE(panels.takesKeys());
}

TEST_F(MaterialTest, TakesAUnitThatIsTypedAndRefusesWhatIsNoModulus) {
    const std::optional<Vector2> field = stiffnessField();
    ASSERT_TRUE(field);
    const std::optional<Knobs> knobs = typed(*field, "0.0075 MPa");
    ASSERT_TRUE(knobs);
    EXPECT_FLOAT_EQ(youngModulusOf(scene, *knobs).value(), 7.5e3f);
    for (const char* text : {"7.5 cm", "soft", ""}) {
        settle();
        click(*field);
        EXPECT_FALSE(typed(*field, text)) << text;
    }
}

TEST_F(MaterialTest, TakesANumberWhenAPressElsewhereEndsTyping) {
    const std::optional<Vector2> field = stiffnessField();
    ASSERT_TRUE(field);
    const auto press = [&](const Vector2& at) {
        PanelInput input{.pointer = at};
        picture(input);
        input.isDown[0] = true;
        input.presses[0] = 1;
        const std::optional<Knobs> knobs = picture(input).knobs;
        picture({.pointer = at});
        return knobs;
    };
    const Vector2 onNothing(1200, 715);
    for (const Vector2& at : {onNothing, Vector2(1210, field->y() - 30), Vector2(1210, field->y() + 30)}) {
        settle();
        click(*field);
        ASSERT_TRUE(panels.takesKeys());
        type(*field, "7.5");
        const std::optional<Knobs> knobs = press(at);
        ASSERT_TRUE(knobs) << at.transpose();
        EXPECT_FLOAT_EQ(youngModulusOf(scene, *knobs).value(), 7.5e3f) << at.transpose();
        picture({.pointer = at, .keys = {{GLFW_KEY_ESCAPE, true}, {GLFW_KEY_ESCAPE, false}}});
        settle();
    }
    settle();
    click(*field);
    type(*field, "7.5");
    panels.closeAll(); // as a press in the scene does
    const std::optional<Knobs> knobs = picture({.pointer = {400, 300}}).knobs;
    ASSERT_TRUE(knobs);
    EXPECT_FLOAT_EQ(youngModulusOf(scene, *knobs).value(), 7.5e3f);
    EXPECT_FALSE(picture().knobs) << "once";
}

TEST_F(MaterialTest, TakesNoNumberThatWasNotTypedOrThatEscGaveUp) {
    const std::optional<Vector2> field = stiffnessField();
    ASSERT_TRUE(field);
    facts.knobs.stiffness = 3; // changed by something else while the field has the keys
    panels.closeAll();
    EXPECT_FALSE(picture().knobs);
    for (const bool isEsc : {true, false}) {
        settle();
        click(*field);
        type(*field, isEsc ? "7.5" : "soft");
        std::optional<Knobs> knobs;
        if (isEsc)
            knobs = picture({.pointer = *field, .keys = {{GLFW_KEY_ESCAPE, true}, {GLFW_KEY_ESCAPE, false}}})
                        .knobs;
        EXPECT_FALSE(knobs);
        panels.closeAll();
        EXPECT_FALSE(picture().knobs) << isEsc;
        EXPECT_FALSE(picture().knobs) << isEsc;
    }
}

// A second click would else select a word, such as the unit, and the number would stay beside what is typed.
TEST_F(MaterialTest, ReplacesTheWholeNumberAfterADoubleClick) {
    const std::optional<Vector2> field = stiffnessField();
    ASSERT_TRUE(field);
    click(*field); // soon after the one that found it
    const std::optional<Knobs> knobs = typed(*field, "7.5");
    ASSERT_TRUE(knobs);
    EXPECT_FLOAT_EQ(youngModulusOf(scene, *knobs).value(), 7.5e3f);
}

// A number that cannot be read is seen before Enter leaves the value as it is.
TEST_F(MaterialTest, DrawsANumberInRedThatCannotBeRead) {
    const std::optional<Vector2> field = stiffnessField();
    ASSERT_TRUE(field);
    const auto redAfter = [&](const char* text) {
        type(*field, text);
        picture({.pointer = *field});
        const ImU32 red = ImGui::ColorConvertFloat4ToU32(parts::bad());
        return std::ranges::count(shownWindow("side")->DrawList->VtxBuffer, red, &ImDrawVert::col);
    };
    EXPECT_EQ(redAfter("7.5 "), 0);
    EXPECT_GT(redAfter("apples"), 0) << "7.5 apples";
}

TEST(NumberText, ReadsNumbersAndConvertsUnits) {
    EXPECT_EQ(numberOf("7.5", "kPa"), 7.5f);
    EXPECT_EQ(numberOf(" 7,5 kPa ", "kPa"), 7.5f);
    EXPECT_EQ(numberOf("2MPa", "kPa"), 2000.0f);
    EXPECT_EQ(numberOf("25 mm", "cm"), 2.5f);
    EXPECT_EQ(numberOf("0.02 m", "cm"), 2.0f);
    EXPECT_EQ(numberOf("-1e-2", ""), -0.01f);
    EXPECT_EQ(numberOf("x 0.5", "x"), 0.5f);
    EXPECT_EQ(numberOf("0.5 x", "x"), 0.5f);
    EXPECT_EQ(numberOf("9.81 m/s\u00b2", "m/s\u00b2"), 9.81f);
    for (const char* text : {"", " ", "kPa", "through", "5 cm", "5 5", "nan", "inf", "1.2.3", "x 5"})
        EXPECT_FALSE(numberOf(text, "kPa")) << text;
}

TEST_F(MaterialTest, HasNoPresetsForAClothAlone) {
    settle();
    const float with = ImGui::FindWindowByName("side")->ContentSize.y;
    scene = bodiesOf({0});
    facts.knobs = scene.fromFile;
    for (int i = 0; i < 3; ++i) settle();
    EXPECT_LT(ImGui::FindWindowByName("side")->ContentSize.y, with - 40);
}

// The number stands in a field of its own.
TEST_F(MaterialTest, DoesNotDrawTheKnobOfASliderOverItsNumber) {
    settle();
    const ImU32 grab = ImGui::GetColorU32(ImGuiCol_SliderGrab);
    int knobs = 0;
    for (const ImDrawVert& vertex : shownWindow("side")->DrawList->VtxBuffer) {
        if (vertex.col != grab) continue;
        ++knobs;
        EXPECT_LT(vertex.pos.x, 1170);
    }
    EXPECT_GT(knobs, 8);
}

} // namespace
} // namespace sinew::viewer
