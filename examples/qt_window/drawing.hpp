// Draws skins and surfaces of cuts from the buffers of the simulation, by Qt's function tables.
#pragma once

#include "sinew/simulation.hpp"

#include <QMatrix4x4>
#include <QVulkanDeviceFunctions>
#include <QVulkanWindow>

class Drawing {
public:
    /// Makes the pipeline for the window's render pass.
    explicit Drawing(const QVulkanWindow& window);
    ~Drawing();
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;

    /// Records the render pass of a frame into the window's command buffer, behind the simulation's step.
    void record(const QVulkanWindow& window, const sinew::sim::Simulation& simulation,
                const QMatrix4x4& clipFromWorld) const;

private:
    VkShaderModule makeModule(std::span<const std::uint32_t> code) const;
    void makePipeline(const QVulkanWindow& window);

    QVulkanDeviceFunctions* functions_;
    VkDevice device_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};
