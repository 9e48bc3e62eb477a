// Draws the panels' Dear ImGui triangles over a finished picture, with the viewer's own pipelines. ImGui's
// Vulkan backend would link the loader, which this program opens at run time, and blends colours without
// regard to sRGB.
#pragma once

#include "sinew/vk/buffer.hpp"
#include "viewer/render/geometry.hpp"
#include "viewer/render/pipeline.hpp"
#include "viewer/render/render_pass.hpp"
#include "viewer/render/sampler.hpp"
#include "viewer/render/set_layout.hpp"
#include "viewer/ui/panel_cover.hpp"
#include "viewer/ui/picture_sheet.hpp"

#include <optional>
#include <vector>

struct ImDrawList;

namespace sinew::viewer {

/// One byte per texel: coverage of a glyph. Rows from the top.
struct GlyphAtlas {
    std::uint32_t width = 0, height = 0; ///< [texels]; width is a multiple of 4
    Vector2 full = Vector2::Zero();      ///< a fully covered place, for triangles without glyphs [texels]
    std::vector<std::uint8_t> coverage;
};

/// Must not outlive its Device, which must not move.
class PanelPainter {
public:
    /// Format and layout of the pictures: see RenderPass::over(). At most `slots` pictures may be recorded
    /// but not finished. Throws vk::Error.
    PanelPainter(const vk::Device& device, VkFormat format, VkImageLayout finalLayout, std::uint32_t slots);

    /// Sets the glyphs. All recorded commands must have finished.
    void setAtlas(const GlyphAtlas& atlas);

    /// Sets the pictures. All recorded commands must have finished.
    void setSheet(const PictureSheet& sheet);
    /// Copies picture `i` of the same sheet; no unfinished commands may show it.
    void addPicture(const PictureSheet& sheet, std::size_t i);

    /// Makes framebuffers for pictures of one size. The views belong to the caller and must outlive them;
    /// drawing into the old ones must have finished.
    void setPictures(VkExtent2D extent, std::span<const VkImageView> pictures);

    enum class Draw {
        anew,  ///< draws the triangles of `drawn`
        asKept ///< copies the last drawing, if it is newer than setPictures(), setAtlas() and setSheet()
    };
    /// Draws over a picture in its final layout and leaves it there. `commands` must be recording, outside a
    /// render pass; the slot's previous picture must be finished. Throws vk::Error if there is no memory for
    /// more triangles than ever before.
    void record(VkCommandBuffer commands, std::uint32_t slot, std::size_t picture, const ImDrawData& drawn,
                Draw which = Draw::anew);

private:
    struct Slot {
        std::optional<vk::Buffer> vertices, indices;
    };
    /// Image of the panels alone: most pictures show the same panels as the one before.
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
