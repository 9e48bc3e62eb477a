// Draws what Dear ImGui made of the panels over a finished picture, with the viewer's own pipelines: ImGui's
// Vulkan backend would link the loader, which this program opens at run time, and mixes colors without regard
// to sRGB.
#pragma once

#include "viewer/draw/geometry.hpp"
#include "viewer/draw/pipeline.hpp"
#include "viewer/draw/render_pass.hpp"
#include "viewer/draw/sampler.hpp"
#include "viewer/draw/set_layout.hpp"
#include "viewer/panels/panel_cover.hpp"
#include "viewer/panels/picture_sheet.hpp"
#include "vk/buffer.hpp"

#include <optional>
#include <vector>

struct ImDrawList;

namespace sinew::viewer {

/// One byte a texel: how much of it a glyph covers. Rows from the top.
struct GlyphAtlas {
    std::uint32_t width = 0, height = 0; ///< [texels]; width is a multiple of 4
    Vector2 full = Vector2::Zero();      ///< a place that is covered whole: what is no glyph has it [texels]
    std::vector<std::uint8_t> coverage;
};

/// Must not outlive its Device, which must not move.
class PanelPainter {
public:
    /// Format and layout of the pictures as RenderPass::over(); `slots` of them may be recorded but not
    /// finished. Throws vk::Error.
    PanelPainter(const vk::Device& device, VkFormat format, VkImageLayout finalLayout, std::uint32_t slots);

    /// Glyphs from now on. Nothing that was recorded may be unfinished.
    void setAtlas(const GlyphAtlas& atlas);

    /// Pictures from now on, likewise.
    void setSheet(const PictureSheet& sheet);
    /// One more of the same sheet, which nothing that was recorded shows.
    void addPicture(const PictureSheet& sheet, std::size_t i);

    /// Framebuffers for pictures of a size. The views belong to the caller and must outlive them; what was
    /// drawn into the old ones must be finished.
    void setPictures(VkExtent2D extent, std::span<const VkImageView> pictures);

    enum class Draw {
        anew,  ///< as they are in `drawn`
        asKept ///< as they were drawn last, where they were since setPictures(), setAtlas() and setSheet()
    };
    /// Draws over a picture in its final layout and leaves it there. `commands` must be recording,
    /// outside a render pass; the slot's previous picture must be finished. Throws vk::Error where there is
    /// no memory for more triangles than ever before.
    void record(VkCommandBuffer commands, std::uint32_t slot, std::size_t picture, const ImDrawData& drawn,
                Draw which = Draw::anew);

private:
    struct Slot {
        std::optional<vk::Buffer> vertices, indices;
    };
    /// Where panels are drawn by themselves: most pictures show them as the one before did.
    struct Kept {
        Kept(const vk::Device& device, const RenderPass& pass, VkFormat format, VkExtent2D extent);
        Image image;
        Framebuffer framebuffer;
        bool isDrawn = false;
        PanelCover cover;
    };
    void upload(Slot& slot, const ImDrawData& drawn);
    void draw(VkCommandBuffer commands, Slot& slot, const ImDrawData& drawn);
    void showKept(VkCommandBuffer commands, std::size_t picture) const noexcept;
    void show(VkCommandBuffer commands, const Pipeline& pipeline,
              std::span<const VkRect2D> parts) const noexcept;
    void begin(VkCommandBuffer commands, const RenderPass& pass, VkFramebuffer framebuffer) const noexcept;
    void bind(VkCommandBuffer commands, const Slot& slot) const noexcept;
    void use(VkCommandBuffer commands, std::size_t texture) const noexcept;
    void drawList(VkCommandBuffer commands, const ImDrawList& list, std::uint32_t firstVertex,
                  std::uint32_t firstIndex) const noexcept;
    void write(std::uint32_t binding, const vk::BufferView& view) const noexcept;
    void write(std::uint32_t binding, const VkDescriptorBufferInfo* buffer,
               const VkDescriptorImageInfo* image) const noexcept;

    const vk::Device& device_;
    VkFormat format_;
    RenderPass pass_, keptPass_;
    SetLayout set_;
    Pipeline glyphs_, pictures_, areas_, laysOver_, covers_;
    Sampler sampler_;
    std::optional<Kept> kept_;
    std::optional<vk::Buffer> atlas_, sheet_;
    VkExtent2D atlasSize_{}, sheetSize_{}, extent_{};
    Vector2 full_ = Vector2::Zero();
    std::vector<Slot> slots_;
    std::vector<Framebuffer> framebuffers_;
};

} // namespace sinew::viewer
