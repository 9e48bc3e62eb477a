// Tests of panels without a device: reactions to the pointer, and their contents.
#include "panels_test.hpp"

#include "viewer/ui/knob_keys.hpp"
#include "viewer/ui/panel_parts.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace sinew::viewer {
namespace {

// All actions except drags, the wheel, and the key of the panels themselves.
std::set<Action> actionsOfButtons() {
    std::set<Action> actions;
    for (const Binding& binding : bindings())
        if (!binding.button.empty()) actions.insert(binding.action);
    return actions;
}

TEST_F(PanelsTest, TurnTheMaterialOfAllOrOfOneBody) {
    scene.bodies = {"liver", "gut"};
    scene.fromFile.bodies = facts.knobs.bodies = {1, 1};
    facts.knobs.damping = scene.fromFile.damping = 200; // beyond the end of the slider
    constexpr VkExtent2D tall{1280, 1400};              // shows all sliders
    settle(tall);
    const auto wishes = [&] {
        std::set<std::string> turned;
        for (float y = 20; y < 1390; y += 6)
            if (const auto knobs = click({1120, y}, tall).knobs) {
                if (knobs->stiffness != 1) turned.insert("stiffness");
                if (knobs->bodies != facts.knobs.bodies) turned.insert("body");
                if (knobs->damping != facts.knobs.damping) turned.insert("damping");
                if (knobs->friction != 0) turned.insert("friction");
            }
        return turned;
    };
    EXPECT_EQ(wishes(), (std::set<std::string>{"stiffness", "damping", "friction"}));
    facts.knobs.body = 1;
    EXPECT_TRUE(wishes().contains("body"));
}

TEST_F(PanelsTest, WarnThatBodiesAreSofterThanAskedAndOfferTheSubsteps) {
    constexpr VkExtent2D tall{1280, 1400};
    const auto offered = [&] {
        settle(tall);
        std::set<int> substeps;
        for (float y = 20; y < 1390; y += 6)
            if (const auto knobs = click({1040, y}, tall).knobs) substeps.insert(knobs->substeps);
        return substeps;
    };
    facts.knobs.substeps = scene.fromFile.substeps = 8;
    EXPECT_FALSE(offered().contains(112));
    scene.stiffness = "Softer than asked: the softest link has 2 % of its stiffness.";
    EXPECT_FALSE(offered().contains(112)) << "no number would do";
    scene.neededSubsteps = 112;
    EXPECT_TRUE(offered().contains(112));
}

// Another button under the pointer would get the next click.
TEST_F(PanelsTest, KeepTheirControlsInPlaceWhileTextBelowThemComesAndGoes) {
    facts.phases = {{"begin", {}}, {"solve", {}}, {"publish", {}}};
    for (PhaseCurve& phase : facts.phases) phase.ms.add(1);
    facts.knobs.substeps = 16;
    settle();
    const ImGuiWindow* side = shownWindow("side");
    ASSERT_NE(side, nullptr);
    const PanelInput over{.pointer = {1200, 100}}, away{.pointer = {200, 100}};
    for (int i = 0; i < 200; ++i) picture({.pointer = over.pointer, .notches = -5});
    const float end = side->Scroll.y;
    ASSERT_GT(end, 100);
    ASSERT_EQ(end, side->ScrollMax.y);

    std::vector<PhaseCurve> none = facts.phases;
    for (PhaseCurve& phase : none) phase.ms = {};
    facts.phases.swap(none);
    for (int i = 0; i < 3; ++i) picture(over);
    EXPECT_EQ(side->Scroll.y, end) << "the plot is gone";
    scene.stiffness = "Softer than asked: the softest link has 2 % of its stiffness.";
    scene.neededSubsteps = 112;
    for (int i = 0; i < 3; ++i) picture(over);
    EXPECT_EQ(side->Scroll.y, end);
    scene.stiffness.clear();
    for (int i = 0; i < 3; ++i) picture(over);
    EXPECT_EQ(side->Scroll.y, end) << "the warning is gone";
    for (int i = 0; i < 3; ++i) picture(away);
    EXPECT_LT(side->Scroll.y, end) << "no empty room at the end";
}

// A click anywhere on the slider sets it; its right end means a cut through the body.
TEST_F(PanelsTest, TurnTheDepthOfTheBlade) {
    facts.bladeDepths = {0.01f, 0.5f};
    constexpr VkExtent2D tall{1280, 1400};
    settle(tall);
    const auto depths = [&](float x) {
        std::set<float> turned;
        for (float y = 20; y < 1390; y += 6)
            if (const auto knobs = click({x, y}, tall).knobs;
                knobs && knobs->bladeDepth != facts.knobs.bladeDepth)
                turned.insert(knobs->bladeDepth.value_or(-1));
        return turned;
    };
    const std::set<float> middle = depths(1110);
    ASSERT_EQ(middle.size(), 1u);
    EXPECT_GT(*middle.begin(), 0.01f);
    EXPECT_LT(*middle.begin(), 0.5f);
    facts.knobs.bladeDepth = scene.fromFile.bladeDepth = *middle.begin();
    std::set<float> right;
    for (float x = 1130; x < 1164; x += 2) right.merge(depths(x));
    EXPECT_TRUE(right.contains(-1)) << "through";
    scene.canCut = false;
    EXPECT_TRUE(depths(1110).empty());
}

TEST_F(PanelsTest, TakeAPathThatIsTypedOrPastedAndNoneAfterEsc) {
    const auto key = [&](int code, int modifiers = 0) {
        Wishes wishes = picture({.keys = {{code, true}}, .modifiers = modifiers});
        const Wishes after = picture({.keys = {{code, false}}});
        return wishes.file ? wishes.file : after.file;
    };
    const auto ask = [&] {
        panels.toggleFiles();
        settle();
        settle();
        EXPECT_TRUE(panels.takesKeys());
    };
    settle();
    EXPECT_FALSE(panels.takesKeys());
    ask();
    PanelInput typed;
    for (const char one : std::string("/tmp/a.obj")) typed.characters.push_back(static_cast<unsigned>(one));
    EXPECT_FALSE(picture(typed).file);
    EXPECT_EQ(key(GLFW_KEY_ENTER), "/tmp/a.obj");
    settle();
    EXPECT_FALSE(panels.takesKeys());

    ask();
    picture(typed);
    EXPECT_EQ(picture({.keys = {{GLFW_KEY_ENTER, true}, {GLFW_KEY_ENTER, false}}}).file, "/tmp/a.obj")
        << "tapped between two pictures";
    settle();

    panels.setPaste([] { return "/tmp/b.toml"; });
    ask();
    EXPECT_FALSE(key(GLFW_KEY_V, GLFW_MOD_CONTROL));
    EXPECT_EQ(key(GLFW_KEY_ENTER), "/tmp/b.toml");

    ask();
    picture(typed);
    EXPECT_FALSE(key(GLFW_KEY_ESCAPE));
    settle();
    EXPECT_FALSE(panels.takesKeys());
    EXPECT_FALSE(key(GLFW_KEY_ENTER));
}

PanelInput typing(const std::string& text) {
    PanelInput input;
    for (const char one : text) input.characters.push_back(static_cast<unsigned char>(one));
    return input;
}

TEST_F(PanelsTest, TakeAPathThatIsTypedBeforeTheLineForItIsThere) {
    settle();
    panels.toggleFiles();
    EXPECT_TRUE(panels.takesKeys()) << "or what is typed would be commands";
    PanelInput all = typing("/tmp/a.obj");
    all.keys = {{GLFW_KEY_ENTER, true}, {GLFW_KEY_ENTER, false}};
    std::optional<std::string> file = picture(all).file;
    for (int i = 0; i < 6 && !file; ++i) file = picture().file;
    EXPECT_EQ(file, "/tmp/a.obj");
    settle();
    EXPECT_FALSE(panels.takesKeys());
    panels.toggleFiles();
    panels.toggle(); // hides the line
    EXPECT_FALSE(panels.takesKeys());
}

TEST_F(PanelsTest, KeepTheLineForAPathWhateverAppears) {
    panels.toggleHelp();
    settle();
    panels.toggleFiles();
    EXPECT_FALSE(panels.isHelpShown());
    settle();
    settle();
    picture(typing("/tmp/a"));
    facts.notice = "the blade goes 10 cm deep";
    settle();
    facts.isInspecting = true;
    settle();
    EXPECT_TRUE(panels.takesKeys());
    picture(typing(".obj"));
    const PanelInput enter{.keys = {{GLFW_KEY_ENTER, true}}};
    EXPECT_EQ(picture(enter).file, "/tmp/a.obj");
}

TEST_F(PanelsTest, CopyWhatIsInALine) {
    std::string copied;
    panels.setCopy([&](const std::string& text) { copied = text; });
    settle();
    panels.toggleFiles();
    settle();
    settle();
    picture(typing("/tmp/a.obj"));
    for (const int key : {GLFW_KEY_A, GLFW_KEY_C}) {
        picture({.keys = {{key, true}}, .modifiers = GLFW_MOD_CONTROL});
        picture({.keys = {{key, false}}});
    }
    EXPECT_EQ(copied, "/tmp/a.obj");
}

// Covers pictures that take long.
TEST_F(PanelsTest, SeeEveryTapOfAButton) {
    settle();
    std::optional<Vector2> at;
    for (float y = 20; y < 720 && !at; y += 12)
        for (float x = 1010; x < 1260 && !at; x += 30)
            if (const Wishes wishes = click({x, y}); wishes.actions == std::vector{Action::step})
                at = Vector2(x, y);
    ASSERT_TRUE(at);
    const auto taps = [&](std::initializer_list<int> presses) {
        std::size_t steps = 0;
        for (const int count : presses) {
            PanelInput input{.pointer = *at};
            input.presses[0] = count;
            steps += picture(input).actions.size();
        }
        return steps;
    };
    EXPECT_EQ(taps({1, 0, 0}), 1u);
    EXPECT_EQ(taps({1, 1, 0, 0, 0}), 2u) << "in two pictures";
    EXPECT_EQ(taps({2, 0, 0, 0, 0}), 2u) << "in one";
}

TEST_F(PanelsTest, KeepANoticeBesideThePanel) {
    facts.notice = "a line that is long enough to be as wide as the window lets it, which is less than that";
    for (const float width : {1280.0f, 800.0f, 770.0f}) {
        const VkExtent2D extent{static_cast<std::uint32_t>(width), 600};
        settle(extent);
        settle(extent);
        const ImGuiWindow* notice = ImGui::FindWindowByName("notice");
        const ImGuiWindow* side = ImGui::FindWindowByName("side");
        ASSERT_TRUE(notice != nullptr && side != nullptr && side->Active);
        EXPECT_LE(notice->Pos.x + notice->Size.x, side->Pos.x) << width;
        EXPECT_GT(notice->Size.x, 200) << width;
    }
}

// An action may have a slider in place of a button.
TEST_F(PanelsTest, HaveAButtonForEveryActionThatAKeyDoes) {
    for (const Binding& binding : bindings()) {
        const bool isKey = binding.trigger.kind == Trigger::Kind::key;
        const bool hasSlider = turnedBy(binding.action, {}).has_value();
        EXPECT_TRUE(!isKey || hasSlider || actionsOfButtons().contains(binding.action)) << binding.shown;
    }
    facts.cuts = {"at 1.00 s", "at 2.00 s"};
    facts.undos = 1;
    constexpr VkExtent2D tall{1280, 1480};
    settle(tall);
    std::set<Action> clicked;
    for (float y = 20; y < 1470; y += 12)
        for (const float x :
             {30.0f, 1010.0f, 1040.0f, 1070.0f, 1100.0f, 1130.0f, 1160.0f, 1190.0f, 1220.0f, 1250.0f})
            for (const Action action : click({x, y}, tall).actions) clicked.insert(action);
    EXPECT_EQ(clicked, actionsOfButtons());
}

// A newcomer needs these first: they are in view without scrolling, whatever the scene.
TEST_F(PanelsTest, ShowUndoResetAndParametersInASmallWindow) {
    facts.cuts = {"at 1.00 s"};
    facts.undos = 1;
    panels.choose(true);
    constexpr VkExtent2D low{1280, 500};
    for (const bool canCut : {true, false}) {
        scene.canCut = canCut;
        settle(low);
        std::set<Action> clicked;
        std::set<std::string> turned;
        for (float y = 20; y < 490; y += 8)
            for (const float x : {30.0f, 1005.0f, 1120.0f, 1160.0f, 1220.0f}) {
                const Wishes wishes = click({x, y}, low);
                clicked.insert(wishes.actions.begin(), wishes.actions.end());
                if (wishes.knobs && wishes.knobs->stiffness != 1) turned.insert("stiffness");
                if (wishes.knobs && wishes.knobs->gravity != facts.knobs.gravity) turned.insert("gravity");
            }
        for (const Action action : {Action::undo, Action::reset, Action::pause})
            EXPECT_TRUE(clicked.contains(action)) << canCut;
        EXPECT_EQ(turned, (std::set<std::string>{"stiffness", "gravity"})) << canCut;
    }
}

// The panel has one more line if fragments were removed.
TEST_F(PanelsTest, SayHowMuchDebrisWasRemoved) {
    const auto height = [&] {
        settle();
        float most = 0;
        for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
            most = std::max(most, window->ContentSize.y);
        return most;
    };
    const float without = height();
    facts.debris = 3;
    facts.debrisParticles = 1'200;
    facts.debrisMass = 0.0214f;
    EXPECT_GT(height(), without + 8);
    EXPECT_EQ(parts::debrisText(facts), "3: 1,200 particles, 0.0214 kg");
}

TEST_F(PanelsTest, OfferToUndoOnlyWhatWasDone) {
    settle();
    std::set<Action> clicked;
    for (float y = 20; y < 720; y += 12)
        for (const float x : {30.0f, 1010.0f, 1130.0f, 1250.0f})
            for (const Action action : click({x, y}).actions) clicked.insert(action);
    EXPECT_TRUE(clicked.contains(Action::reset)) << "their neighbor";
    EXPECT_FALSE(clicked.contains(Action::undo));
    EXPECT_FALSE(clicked.contains(Action::redo));
}

// The window of an open list.
const ImGuiWindow* openList() {
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
        if (window->Active && !window->Hidden && (window->Flags & ImGuiWindowFlags_Popup) != 0) return window;
    return nullptr;
}

TEST_F(PanelsTest, OfferOtherDevicesButNoneThatCannotBeUsed) {
    const auto device = [](std::uint32_t index, const char* name, const char* type) {
        return vk::DeviceDescription{.index = index, .name = name, .driver = "some driver", .type = type};
    };
    facts.devices = {device(0, "llvmpipe", "software"), device(1, "other", "discrete GPU"),
                     device(2, "third", "integrated GPU")};
    facts.devices[2].missing = {"it cannot draw to this window"};
    settle();
    std::set<std::size_t> wished;
    areSectionsOpen = false;
    for (float y = 150; y < 300; y += 8) { // the list is the first control of Performance
        panels.fold(Folds().set().reset(indexOf(Fold::performance)));
        settle();
        click({1200, y});
        settle();
        if (openList() == nullptr) continue;
        const ImVec2 corner = openList()->Pos, size = openList()->Size;
        for (float down = 2; down < size.y; down += 9) {
            if (openList() == nullptr) click({1200, y});
            settle();
            const Vector2 at{corner.x + 30, corner.y + down};
            if (const Wishes wishes = click(at); wishes.device) wished.insert(*wishes.device);
        }
        break;
    }
    EXPECT_EQ(wished, (std::set<std::size_t>{1}))
        << "the current one and one that lacks something are no choice";
}

TEST_F(PanelsTest, CoverTheirSideAndNothingOfTheMiddle) {
    settle();
    EXPECT_TRUE(panels.covers({1200, 60}));
    EXPECT_FALSE(panels.covers({640, 360}));
    EXPECT_FALSE(panels.covers({100, 700})) << "the hint lets the pointer through";
    panels.toggle();
    settle();
    EXPECT_FALSE(panels.covers({1200, 60}));
}

TEST_F(PanelsTest, LeaveASmallWindowToTheSceneUntilAskedFor) {
    settle(small);
    EXPECT_FALSE(panels.covers({600, 60}));
    panels.toggle();
    settle(small);
    EXPECT_TRUE(panels.covers({600, 60}));
}

TEST_F(PanelsTest, ShowHelpOverTheMiddleUntilItIsClosed) {
    panels.toggleHelp();
    settle();
    EXPECT_TRUE(panels.covers({640, 360}));
    panels.closeHelp();
    settle();
    EXPECT_FALSE(panels.covers({640, 360}));
}

TEST(Help, IsFoundByTheWordsOfNewcomers) {
    for (const char* word : {"film", "video", "record", "undo", "cut", "inside", "reset", "comma", "picture"})
        EXPECT_FALSE(helpLines(word).empty()) << word;
}

TEST_F(PanelsTest, SearchTheHelpForWhatIsTyped) {
    const auto triangles = [&](const PanelInput& input) {
        picture(input);
        picture();
        return panels.drawn().TotalIdxCount;
    };
    PanelInput undo, back;
    for (const char letter : std::string("undo")) undo.characters.push_back(static_cast<unsigned>(letter));
    back.keys = {{GLFW_KEY_BACKSPACE, true}};
    EXPECT_FALSE(panels.takesLetters());
    panels.toggleHelp();
    settle();
    EXPECT_TRUE(panels.takesLetters());
    EXPECT_FALSE(panels.takesKeys()) << "Esc and Ctrl + Q act as always";
    const int all = triangles({});
    const ImVec2 size = shownWindow("help")->Size;
    panels.closeHelp();
    const int without = triangles({});
    panels.toggleHelp();
    settle();
    EXPECT_LT(triangles(undo) - without, (all - without) / 4);
    EXPECT_EQ(shownWindow("help")->Size.y, size.y) << "it does not move under the pointer";
    for (int letter = 0; letter < 4; ++letter) triangles(back);
    EXPECT_EQ(triangles(back), all);
    triangles(undo);
    panels.closeHelp();
    panels.toggleHelp();
    settle();
    EXPECT_EQ(triangles({}), all) << "the next one begins anew";
}

TEST_F(PanelsTest, DrawMoreWhereThereIsMoreToSay) {
    settle();
    const int before = panels.drawn().TotalVtxCount;
    facts.notice = "no such mesh";
    settle();
    EXPECT_GT(panels.drawn().TotalVtxCount, before);
}

// Checks the assumptions of the painter: finite positions, complete triangles, clip rectangles within the
// picture.
void expectSound(const ImDrawData& drawn, VkExtent2D extent) {
    EXPECT_EQ(drawn.DisplaySize.x, static_cast<float>(extent.width));
    EXPECT_EQ(drawn.DisplaySize.y, static_cast<float>(extent.height));
    for (int l = 0; l < drawn.CmdListsCount; ++l) {
        const ImDrawList& list = *drawn.CmdLists[l];
        for (const ImDrawVert& vertex : list.VtxBuffer)
            ASSERT_TRUE(std::isfinite(vertex.pos.x) && std::isfinite(vertex.pos.y)) << extent.width;
        for (const ImDrawCmd& draw : list.CmdBuffer) {
            ASSERT_LE(draw.IdxOffset + draw.ElemCount, static_cast<unsigned>(list.IdxBuffer.Size));
            for (unsigned i = draw.IdxOffset; i < draw.IdxOffset + draw.ElemCount; ++i)
                ASSERT_LT(draw.VtxOffset + list.IdxBuffer[static_cast<int>(i)],
                          static_cast<unsigned>(list.VtxBuffer.Size));
        }
    }
}

// Expects every panel to lie within the picture.
void expectWithin(VkExtent2D extent) {
    int seen = 0;
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
        if (!window->Active || window->Hidden || (window->Flags & ImGuiWindowFlags_ChildWindow) != 0)
            continue;
        if (std::string(window->Name) == "Debug##Default") continue;
        ++seen;
        EXPECT_GE(window->Pos.x, 0) << window->Name << " in " << extent.width << " x " << extent.height;
        EXPECT_GE(window->Pos.y, 0) << window->Name << " in " << extent.width << " x " << extent.height;
        EXPECT_LE(window->Pos.x + window->Size.x, static_cast<float>(extent.width)) << window->Name;
        EXPECT_LE(window->Pos.y + window->Size.y, static_cast<float>(extent.height)) << window->Name;
    }
    EXPECT_GE(seen, 3) << "the hint, the message and a panel";
}

TEST_F(PanelsTest, FitIntoAnyWindow) {
    panels.toggle();
    if (!panels.isShown(large)) panels.toggle();
    facts.phases = {{"begin", {}}, {"solve", {}}};
    for (PhaseCurve& phase : facts.phases)
        for (int i = 0; i < 300; ++i) phase.ms.add(static_cast<float>(i % 7));
    facts.notice = "a message that is long enough to need more than one line in a window that is not wide";
    for (const bool isHelp : {false, true})
        for (const VkExtent2D extent : {VkExtent2D{1, 1}, VkExtent2D{33, 500}, VkExtent2D{700, 20},
                                        VkExtent2D{320, 200}, small, large}) {
            if (isHelp != panels.isHelpShown()) panels.toggleHelp();
            settle(extent);
            expectSound(panels.drawn(), extent);
            if (extent.width >= 320 && extent.height >= 200) expectWithin(extent);
        }
}

TEST_F(PanelsTest, FitIntoSmallWindowsWithLargeTexts) {
    panels.choose(true);
    facts.notice = "a message";
    settle();
    const auto texels = panels.atlas().coverage.size();
    for (const float scale : {0.5f, 2.0f, 4.0f}) {
        panels.rescale(scale);
        for (const VkExtent2D extent : {VkExtent2D{320, 200}, small, large}) {
            if (scale > 2 && extent.width < large.width) continue;
            settle(extent);
            expectSound(panels.drawn(), extent);
            expectWithin(extent);
        }
    }
    EXPECT_GT(panels.atlas().coverage.size(), texels) << "larger glyphs";
}

TEST_F(PanelsTest, SayWhatIsUnderThePointerWhereverThatIs) {
    panels.choose(true);
    facts.notice = "a message";
    facts.isInspecting = true;
    Found found{.body = "organ", .particle = 417, .speed = 0.25f, .links = 26, .contacts = 3};
    found.strain = Strain{0.01, 0.2};
    for (const auto& what : {std::optional<Found>(), std::optional<Found>(found)}) {
        facts.found = what;
        for (const VkExtent2D extent : {VkExtent2D{320, 200}, small, large})
            for (const Vector2& at : {Vector2(0, 0), Vector2(1, 1), Vector2(0, 1), Vector2(0.5f, 0.5f)}) {
                const Vector2 pointer(at.x() * static_cast<float>(extent.width),
                                      at.y() * static_cast<float>(extent.height));
                picture({.pointer = pointer}, extent);
                picture({.pointer = pointer}, extent);
                expectWithin(extent);
            }
    }
}

TEST(GlyphAtlas, CoversItsTexels) {
    const Panels panels(2);
    const GlyphAtlas& atlas = panels.atlas();
    ASSERT_EQ(atlas.coverage.size(), std::size_t{atlas.width} * atlas.height);
    EXPECT_EQ(atlas.width % 4, 0u);
    const auto column = static_cast<std::size_t>(atlas.full.x()),
               row = static_cast<std::size_t>(atlas.full.y());
    EXPECT_EQ(atlas.coverage.at(row * atlas.width + column), 255);
    EXPECT_TRUE(std::ranges::any_of(atlas.coverage, [](std::uint8_t texel) { return texel == 255; }));
    EXPECT_TRUE(std::ranges::any_of(atlas.coverage, [](std::uint8_t texel) { return texel == 0; }));
}

TEST(Curve, KeepsTheNewestValues) {
    Curve curve;
    EXPECT_EQ(curve.mean(), 0);
    for (std::size_t i = 0; i < Curve::length + 3; ++i) curve.add(static_cast<float>(i));
    EXPECT_EQ(curve.count(), Curve::length);
    EXPECT_EQ(curve.at(0), 3);
    EXPECT_EQ(curve.newest(), static_cast<float>(Curve::length + 2));
    EXPECT_EQ(curve.median(), 3 + static_cast<float>((Curve::length - 1) / 2));
}

TEST(KnobKeys, TurnWhatTheSlidersTurn) {
    const Knobs file{.gravity = 9.81f, .bodies = {1, 1}};
    const auto expect = [](Action action, const Knobs& before, const Knobs& after, const char* said) {
        const auto turned = turnedBy(action, before);
        ASSERT_TRUE(turned) << said;
        EXPECT_EQ(turned->knobs, after) << said;
        EXPECT_EQ(turned->said, said);
    };
    const auto with = [&](auto&& set) {
        Knobs knobs = file;
        set(knobs);
        return knobs;
    };
    const Knobs stiff = with([](Knobs& k) { k.stiffness = 2; });
    expect(Action::stiffer, turnedBy(Action::stiffer, file)->knobs, stiff, "stiffness x 2");
    expect(Action::moreDamping, file, with([](Knobs& k) { k.damping = 0.5f; }), "damping 0.50 1/s");
    expect(Action::moreFriction, file, with([](Knobs& k) { k.friction = 0.1f; }), "friction 0.10");
    expect(Action::lessGravity, file, with([](Knobs& k) { k.gravity = 9.5f; }), "gravity 9.50 m/s\u00b2");
    const Knobs second = with([](Knobs& k) { k.body = 1; });
    expect(Action::softer, turnedBy(Action::stiffer, second)->knobs, second, "stiffness of this body x 1");
}

TEST(KnobKeys, StayWithinReasonAndLeaveOtherActionsAlone) {
    const auto pressed = [](Action action) {
        Knobs knobs{.bodies = {1}};
        for (int n = 0; n < 3000; ++n) knobs = turnedBy(action, knobs)->knobs;
        return knobs;
    };
    EXPECT_EQ(pressed(Action::stiffer).stiffness, 1e4f);
    EXPECT_EQ(pressed(Action::softer).stiffness, 1e-4f);
    EXPECT_EQ(pressed(Action::moreDamping).damping, 100);
    EXPECT_EQ(pressed(Action::lessDamping).damping, 0);
    EXPECT_EQ(pressed(Action::moreFriction).friction, 10);
    EXPECT_EQ(pressed(Action::lessFriction).friction, 0);
    EXPECT_EQ(pressed(Action::moreGravity).gravity, 1000);
    EXPECT_EQ(pressed(Action::lessGravity).gravity, 0);
    for (const Binding& binding : bindings())
        if (binding.action < Action::stiffer || binding.action > Action::lessGravity) {
            EXPECT_FALSE(turnedBy(binding.action, {})) << binding.shown;
        }
}

} // namespace
} // namespace sinew::viewer
