// A scene whose bodies are picked on the device, and on the host for comparison.
#pragma once

#include "host_pick.hpp"
#include "support/device.hpp"
#include "viewer/document/document.hpp"
#include "viewer/input/picker.hpp"

#include <gtest/gtest.h>

namespace sinew::viewer {

struct Picked {
    static constexpr std::uint32_t slots = 16;
    using Found = std::vector<std::optional<Pick>>;

    explicit Picked(const sim::Scene& of, const sim::Settings& settings = {.substeps = 8})
        : scene(of), light{.isClosed = closedSkins(scene), .balls = ballsOf(scene)},
          document(test::device(), scene, settings), picker(test::device(), document, light, slots) {
        run([&](VkCommandBuffer commands) {
            document.recordReset(commands);
            document.recordSkin(commands);
        });
    }
    template <typename Record> void run(const Record& record) {
        VkCommandBuffer commands = test::queue().begin();
        record(commands);
        test::queue().wait(test::queue().submit(commands));
    }
    /// The blade cuts in the first step.
    void step(int steps, const sim::Blade& blade = {}) {
        run([&](VkCommandBuffer commands) {
            for (int i = 0; i < steps; ++i)
                document.recordStep(commands, nullptr, {}, i == 0 ? blade : sim::Blade{});
            document.recordSkin(commands);
        });
    }
    Found at(std::span<const Ray> rays, Among among = Among::moving,
             const std::optional<Section>& section = {}) {
        Found all;
        for (std::size_t first = 0; first < rays.size(); first += slots * Picker::rays) {
            const auto some = rays.subspan(first, std::min(slots * Picker::rays, rays.size() - first));
            run([&](VkCommandBuffer commands) {
                for (std::size_t i = 0; i < some.size(); i += Picker::rays) {
                    Picker::Casts casts;
                    for (std::size_t k = i; k < std::min(i + Picker::rays, some.size()); ++k)
                        casts[k - i] = {some[k], among};
                    picker.record(commands, static_cast<std::uint32_t>(i / Picker::rays), casts, section);
                }
            });
            for (std::size_t i = 0; i < some.size(); ++i)
                all.push_back(picker.answer(static_cast<std::uint32_t>(i / Picker::rays), i % Picker::rays));
        }
        return all;
    }
    std::optional<Pick> at(const Ray& ray, Among among = Among::moving,
                           const std::optional<Section>& section = {}) {
        return at(std::span(&ray, 1), among, section)[0];
    }
    Found onHost(std::span<const Ray> rays, Among among = Among::moving,
                 const std::optional<Section>& section = {}) const {
        const StateCopy copy(scene, document.simulation());
        std::optional<Opened> opened;
        if (section) opened.emplace(Opened{*section, light.isClosed});
        Found all;
        for (const Ray& ray : rays)
            all.push_back(pickOnHost(scene, light.balls, ray, copy.seen(), among, opened));
        return all;
    }
    /// Expects the same from both; returns the number of rays that met something.
    std::size_t expectAsOnHost(std::span<const Ray> rays, Among among = Among::moving,
                               const std::optional<Section>& section = {}) {
        const Found found = at(rays, among, section), expected = onHost(rays, among, section);
        std::size_t met = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            EXPECT_EQ(found[i].has_value(), expected[i].has_value()) << "ray " << i;
            if (!found[i] || !expected[i]) continue;
            ++met;
            EXPECT_NEAR(found[i]->distance, expected[i]->distance, 1e-5f * (1 + expected[i]->distance)) << i;
            EXPECT_LT((found[i]->point - expected[i]->point).norm(), 2e-5f * (1 + expected[i]->distance))
                << i;
            if (found[i]->particle != expected[i]->particle) // only where two are equally near
                EXPECT_NEAR(found[i]->offset.norm(), expected[i]->offset.norm(), 1e-5f) << i;
            else
                EXPECT_LT((found[i]->offset - expected[i]->offset).norm(),
                          2e-5f * (1 + expected[i]->distance));
        }
        return met;
    }

    sim::Scene scene;
    SceneLight light;
    Document document;
    Picker picker;
};

} // namespace sinew::viewer
