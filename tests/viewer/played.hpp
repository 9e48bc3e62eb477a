// A scene played with tools, and its replay: steps, tools and their queries in the order of the window's
// loop, without its timing.
#pragma once

#include "support/device.hpp"
#include "viewer/input/controller.hpp"
#include "viewer/input/picker.hpp"
#include "viewer/input/state_probe.hpp"
#include "viewer/jobs/opened_scene.hpp"
#include "viewer/jobs/replay.hpp"
#include "viewer/tools/cut_tool.hpp"
#include "viewer/tools/pins.hpp"
#include "viewer/tools/poke_tool.hpp"
#include "viewer/tools/tools.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <unistd.h>

namespace sinew::viewer {

inline constexpr const char* block = R"([solver]
substeps = 4
[[box]]
name = "block"
particles = [4, 4, 4]
center = [0, 0.5, 0]
spacing = 0.13
young_modulus = 2e4
cuttable = true
[[plane]]
[camera]
eye = [0, 0.5, 2]
target = [0, 0.4, 0]
)";

inline OpenedScene openText(const std::string& text, const scenes::Overrides& overrides = {}) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("sinew-replay-" + std::to_string(::getpid()) + ".toml");
    std::ofstream(file) << text;
    OpenedScene opening = open({.scene = file.string(), .overrides = overrides}, 1.6f);
    std::filesystem::remove(file);
    prepareForReplay(opening, {});
    return opening;
}

inline OpenedScene openFile(const std::filesystem::path& file, const InputFile& input = {}) {
    OpenedScene opening = open({.scene = file.string()}, 1.6f);
    prepareForReplay(opening, input);
    return opening;
}

// A scene with steps, tools and their queries in the order of the window's loop, without its timing.
struct Scene {
    OpenedScene opening;
    Controller controller{opening.camera, opening.loaded.scene.dt};
    Document document;
    Tools tools{test::device(), toolContext(opening)};
    Picker picker{test::device(), document, opening.light, 1};
    StateProbe probe{test::device(), document.scene(), document.settings(), document.simulation()};

    explicit Scene(const std::string& text = block, const sim::Material& material = {})
        : Scene(openText(text), material) {}
    explicit Scene(const std::filesystem::path& file, const InputFile& input = {})
        : Scene(openFile(file, input)) {}
    explicit Scene(OpenedScene opened, const std::optional<sim::Material>& material = {})
        : opening(std::move(opened)), document(test::device(), opening.loaded.scene, opening.loaded.settings,
                                               material.value_or(firstMaterial(opening))) {
        document.setDefaults(opening.loaded.defaults);
        if (opening.run) {
            document.load(test::device(), *opening.run, test::queue());
            tools.begin(document);
        } else {
            run([&](VkCommandBuffer commands) { document.recordReset(commands); });
        }
    }
    template <typename Record> void run(const Record& record) {
        VkCommandBuffer commands = test::queue().begin();
        record(commands);
        test::queue().wait(test::queue().submit(commands));
    }
    void step(VkCommandBuffer commands) {
        if (const auto material = document.recordTurn(commands)) tools.turned(*material);
        const StepHands hands = tools.takeStep(commands, document);
        recordStep(commands, document, hands);
    }
    std::uint64_t hash() { return stateHash(test::device(), document, test::queue()); }
};

// A scene with simulated user input.
struct Played : Scene {
    using Scene::Scene;
    void turn(const Input& input, int steps = 1) {
        for (const Action action : input.actions) tools.act(action);
        tools.handle(input, controller);
        if (input.notches != 0) controller.wheel(input.notches, input.pointer);
        if (asked && asked == tools.question()) { // from the previous turn
            picker.restart();                     // the document may have another simulation
            run([&](VkCommandBuffer commands) {
                picker.record(commands, 0, {Picker::Cast{asked->ray, asked->among}});
            });
            const auto found = picker.answer(0, 0);
            tools.answer(*asked, found, found ? holdRadius(document.scene(), found->particle) : 0);
        }
        run([&](VkCommandBuffer commands) {
            tools.recordHistory(commands, document);
            for (int i = 0; i < steps; ++i) step(commands);
            document.recordSkin(commands);
            probe.record(commands);
        });
        asked = tools.question();
    }
    void pressAt(const Vector2& at, bool isDown) {
        turn({.presses = {{Action::grab, isDown, at}}, .pointer = at});
    }
    void dragFrom(const Vector2& from, const Vector2& by, int turns) {
        pressAt(from, true);
        for (int i = 0; i <= turns; ++i)
            turn({.pointer = from + static_cast<float>(i) / static_cast<float>(turns) * by});
    }
    bool isPoking() const { return document.simulation().hostColliders()[0].isThere; }
    InputFile file() { return {.scene = "/block.toml", .events = tools.log().events(), .hash = hash()}; }

    std::optional<Question> asked;
};

inline Replay::Due replayAll(Scene& scene, Replay& replay) {
    for (;;) {
        const Replay::Due due = replay.next(scene.tools, scene.controller.camera, scene.document);
        if (due == Replay::Due::nothing) return due;
        if (due == Replay::Due::shape) {
            scene.document.reshape(test::queue(), scene.tools.bring());
            scene.tools.reshaped();
            continue;
        }
        scene.run([&](VkCommandBuffer commands) {
            if (due == Replay::Due::history)
                scene.tools.recordHistory(commands, scene.document);
            else
                scene.step(commands);
        });
    }
}

} // namespace sinew::viewer
