// Triangles of all panels go into two buffers per slot, which only grow, and are drawn into an image;
// pictures get the parts of that image that are not empty.
#include "viewer/ui/panel_painter.hpp"

#include "sinew/vk/check.hpp"
#include "viewer/panel.h"
#include "viewer_shaders.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace sinew::viewer {

namespace {

static_assert(sizeof(ImDrawVert) == sizeof(PanelVertex));
static_assert(sizeof(ImDrawIdx) == 2);

constexpr VkDescriptorSetLayoutBinding bufferBinding(std::uint32_t binding) {
    return {.binding = binding,
            .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
            .descriptorCount = 1,
            .stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT};
}
constexpr std::uint32_t ofAtlas = 0, ofSheet = 1, ofKept = 2;
constexpr std::array textures{
    bufferBinding(ofAtlas), bufferBinding(ofSheet),
    VkDescriptorSetLayoutBinding{.binding = ofKept,
                                 .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                 .descriptorCount = 1,
                                 .stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT}};

// Whether the target encodes sRGB (panel.vert, panel_picture.frag).
std::array<vk::SpecialisationConstant, 1> srgbConstant(VkFormat format) {
    const bool encodes = format == VK_FORMAT_B8G8R8A8_SRGB || format == VK_FORMAT_R8G8B8A8_SRGB;
    return {vk::SpecialisationConstant{0, encodes ? 1u : 0u}};
}

using Blend = PipelineRequest::Blend;

Pipeline makePipeline(const vk::Device& device, const char* name, const vk::ShaderCode& fragment,
                      const SetLayout& set, const RenderPass& pass, VkFormat format,
                      Blend blend = Blend::laid) {
    const auto constants = srgbConstant(format);
    return {device,
            {.name = name,
             .vertex = &shaders::panelVert,
             .fragment = &fragment,
             .layout = set.handle(),
             .pass = pass.handle(),
             .input = PipelineRequest::Input::panels,
             .blend = blend,
             .constants = constants}};
}

// Grows the buffer to at least `bytes`; a new one is half as large again.
void grow(std::optional<vk::Buffer>& buffer, const vk::Device& device, const char* name, std::size_t bytes,
          VkBufferUsageFlags usage) {
    if (buffer && buffer->count() * 4 >= bytes) return;
    buffer.emplace(device, vk::BufferRequest{.name = name,
                                             .count = (bytes + bytes / 2) / 4 + 1,
                                             .stride = 4,
                                             .kind = vk::MemoryKind::upload,
                                             .usage = usage});
}

Pipeline makeShowing(const vk::Device& device, const char* name, const SetLayout& set, const RenderPass& pass,
                     Blend blend) {
    return {device,
            {.name = name,
             .vertex = &shaders::enlargeVert,
             .fragment = &shaders::panelKeptFrag,
             .layout = set.handle(),
             .pass = pass.handle(),
             .blend = blend}};
}

} // namespace

PanelPainter::Kept::Kept(const vk::Device& device, const RenderPass& pass, VkFormat format, VkExtent2D extent)
    : image(device, {.name = "panels.kept",
                     .extent = extent,
                     .format = format,
                     .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT}),
      framebuffer(device, pass.handle(), std::array{image.view()}, extent, "panels.kept") {}

PanelPainter::PanelPainter(const vk::Device& device, VkFormat format, VkImageLayout finalLayout,
                           std::uint32_t slots)
    : device_(device), format_(format), pass_(RenderPass::over(device, format, finalLayout)),
      keptPass_(RenderPass::colorMap(device, format, "panels.kept")),
      set_(device, "panels", textures, sizeof(layout::PanelPush), 1),
      glyphs_(makePipeline(device, "panels", shaders::panelFrag, set_, keptPass_, format)),
      pictures_(makePipeline(device, "panels.pictures", shaders::panelPictureFrag, set_, keptPass_, format)),
      areas_(
          makePipeline(device, "panels.areas", shaders::panelAreaFrag, set_, keptPass_, format, Blend::none)),
      laysOver_(makeShowing(device, "panels.lays_over", set_, pass_, Blend::overTimesAlpha)),
      covers_(makeShowing(device, "panels.covers", set_, pass_, Blend::none)),
      sampler_(device, {.name = "panels.kept", .beyond = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE}),
      slots_(slots) {}

void PanelPainter::write(std::uint32_t binding, const VkDescriptorBufferInfo* buffer,
                         const VkDescriptorImageInfo* image) const noexcept {
    const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                     .dstSet = set_.set(0),
                                     .dstBinding = binding,
                                     .descriptorCount = 1,
                                     .descriptorType = textures[binding].descriptorType,
                                     .pImageInfo = image,
                                     .pBufferInfo = buffer};
    device_.functions().vkUpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
}

void PanelPainter::write(std::uint32_t binding, const vk::BufferView& view) const noexcept {
    const VkDescriptorBufferInfo buffer{view.buffer, view.offset, view.size};
    write(binding, &buffer, nullptr);
}

void PanelPainter::setAtlas(const GlyphAtlas& atlas) {
    atlasSize_ = {atlas.width, atlas.height};
    full_ = atlas.full;
    atlas_.emplace(device_, vk::BufferRequest{.name = "panels.atlas",
                                              .count = atlas.coverage.size() / 4,
                                              .stride = 4,
                                              .kind = vk::MemoryKind::upload});
    std::memcpy(atlas_->mapped(), atlas.coverage.data(), atlas.coverage.size() / 4 * 4);
    write(ofAtlas, atlas_->view());
    if (kept_) kept_->isDrawn = false;
}

void PanelPainter::setSheet(const PictureSheet& sheet) {
    if (kept_) kept_->isDrawn = false;
    const auto count = static_cast<std::uint32_t>(sheet.has().size());
    sheetSize_ = {PictureSheet::extent.width, PictureSheet::extent.height * count};
    if (count == 0) return sheet_.reset();
    sheet_.emplace(device_, vk::BufferRequest{.name = "panels.sheet",
                                              .count = sheet.texels().size(),
                                              .stride = 4,
                                              .kind = vk::MemoryKind::upload});
    std::memcpy(sheet_->mapped(), sheet.texels().data(), sheet.texels().size() * sizeof(std::uint32_t));
    write(ofSheet, sheet_->view());
}

void PanelPainter::addPicture(const PictureSheet& sheet, std::size_t i) {
    const std::span<const std::uint32_t> texels = sheet.texelsOf(i);
    if (sheet_ && !texels.empty())
        std::memcpy(sheet_->mapped() + i * texels.size_bytes(), texels.data(), texels.size_bytes());
}

void PanelPainter::setPictures(VkExtent2D extent, std::span<const VkImageView> pictures) {
    framebuffers_.clear();
    extent_ = extent;
    for (const VkImageView picture : pictures)
        framebuffers_.emplace_back(device_, pass_.handle(), std::array{picture}, extent,
                                   "panels.framebuffer");
    kept_.emplace(device_, keptPass_, format_, extent);
    const VkDescriptorImageInfo image{sampler_.handle(), kept_->image.view(),
                                      VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    write(ofKept, nullptr, &image);
}

void PanelPainter::upload(Slot& slot, const ImDrawData& drawn) {
    grow(slot.vertices, device_, "panels.vertices",
         static_cast<std::size_t>(drawn.TotalVtxCount) * sizeof(ImDrawVert),
         VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
    grow(slot.indices, device_, "panels.indices",
         static_cast<std::size_t>(drawn.TotalIdxCount) * sizeof(ImDrawIdx), VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
    std::byte *vertices = slot.vertices->mapped(), *indices = slot.indices->mapped();
    for (int i = 0; i < drawn.CmdListsCount; ++i) {
        const ImDrawList& list = *drawn.CmdLists[i];
        std::memcpy(vertices, list.VtxBuffer.Data, static_cast<std::size_t>(list.VtxBuffer.size_in_bytes()));
        std::memcpy(indices, list.IdxBuffer.Data, static_cast<std::size_t>(list.IdxBuffer.size_in_bytes()));
        vertices += list.VtxBuffer.size_in_bytes();
        indices += list.IdxBuffer.size_in_bytes();
    }
}

void PanelPainter::begin(VkCommandBuffer commands, const RenderPass& pass,
                         VkFramebuffer framebuffer) const noexcept {
    constexpr VkClearValue clear{}; // transparent
    const VkRenderPassBeginInfo info{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                     .renderPass = pass.handle(),
                                     .framebuffer = framebuffer,
                                     .renderArea = {{0, 0}, extent_},
                                     .clearValueCount = 1,
                                     .pClearValues = &clear};
    const VkViewport viewport{0, 0, static_cast<float>(extent_.width), static_cast<float>(extent_.height),
                              0, 1};
    device_.functions().vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    device_.functions().vkCmdSetViewport(commands, 0, 1, &viewport);
}

void PanelPainter::bind(VkCommandBuffer commands, const Slot& slot) const noexcept {
    const vk::DeviceFunctions& functions = device_.functions();
    const vk::BufferView vertices = slot.vertices->view(), indices = slot.indices->view();
    set_.bind(commands, 0);
    functions.vkCmdBindVertexBuffers(commands, 0, 1, &vertices.buffer, &vertices.offset);
    functions.vkCmdBindIndexBuffer(commands, indices.buffer, indices.offset, VK_INDEX_TYPE_UINT16);
}

void PanelPainter::use(VkCommandBuffer commands, std::size_t texture) const noexcept {
    const VkExtent2D size = texture == sheetTexture ? sheetSize_ : atlasSize_;
    const Pipeline& pipeline = texture == sheetTexture  ? pictures_
                               : texture == areaTexture ? areas_
                                                        : glyphs_;
    const layout::PanelPush push{
        .scale = {2 / static_cast<float>(extent_.width), 2 / static_cast<float>(extent_.height)},
        .atlas = {static_cast<float>(size.width), static_cast<float>(size.height)},
        .full = {full_.x(), full_.y()},
        .pictureHeight = static_cast<float>(PictureSheet::extent.height)};
    const vk::DeviceFunctions& functions = device_.functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.handle());
    functions.vkCmdPushConstants(commands, set_.handle(), drawingStages, 0, sizeof(push), &push);
}

void PanelPainter::drawList(VkCommandBuffer commands, const ImDrawList& list, std::uint32_t firstVertex,
                            std::uint32_t firstIndex) const noexcept {
    std::optional<std::size_t> used;
    for (const ImDrawCmd& command : list.CmdBuffer) {
        const auto within = [](float value, std::uint32_t most) {
            return std::clamp(static_cast<std::int32_t>(std::floor(value)), 0,
                              static_cast<std::int32_t>(most));
        };
        const VkOffset2D from{within(command.ClipRect.x, extent_.width),
                              within(command.ClipRect.y, extent_.height)};
        const std::int32_t right = within(command.ClipRect.z, extent_.width);
        const std::int32_t bottom = within(command.ClipRect.w, extent_.height);
        const auto texture = reinterpret_cast<std::size_t>(command.TextureId);
        if (right <= from.x || bottom <= from.y || (texture == sheetTexture && !sheet_)) continue;
        if (std::exchange(used, texture) != texture) use(commands, texture);
        const VkRect2D scissor{
            from, {static_cast<std::uint32_t>(right - from.x), static_cast<std::uint32_t>(bottom - from.y)}};
        device_.functions().vkCmdSetScissor(commands, 0, 1, &scissor);
        device_.functions().vkCmdDrawIndexed(commands, command.ElemCount, 1, firstIndex + command.IdxOffset,
                                             static_cast<std::int32_t>(firstVertex + command.VtxOffset), 0);
    }
}

void PanelPainter::draw(VkCommandBuffer commands, Slot& slot, const ImDrawData& drawn) {
    upload(slot, drawn);
    begin(commands, keptPass_, kept_->framebuffer.handle());
    bind(commands, slot);
    std::uint32_t vertex = 0, index = 0;
    for (int i = 0; i < drawn.CmdListsCount; ++i) {
        const ImDrawList& list = *drawn.CmdLists[i];
        drawList(commands, list, vertex, index);
        vertex += static_cast<std::uint32_t>(list.VtxBuffer.Size);
        index += static_cast<std::uint32_t>(list.IdxBuffer.Size);
    }
    device_.functions().vkCmdEndRenderPass(commands);
    kept_->isDrawn = true;
    kept_->cover = coverOf(drawn, extent_);
}

void PanelPainter::show(VkCommandBuffer commands, const Pipeline& pipeline,
                        std::span<const VkRect2D> parts) const noexcept {
    const vk::DeviceFunctions& functions = device_.functions();
    functions.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.handle());
    for (const VkRect2D& part : parts) {
        functions.vkCmdSetScissor(commands, 0, 1, &part);
        functions.vkCmdDraw(commands, 3, 1, 0, 0);
    }
}

void PanelPainter::showKept(VkCommandBuffer commands, std::size_t picture) const noexcept {
    begin(commands, pass_, framebuffers_[picture].handle());
    set_.bind(commands, 0);
    show(commands, covers_, kept_->cover.areas);
    show(commands, laysOver_, kept_->cover.parts);
    device_.functions().vkCmdEndRenderPass(commands);
}

void PanelPainter::record(VkCommandBuffer commands, std::uint32_t slot, std::size_t picture,
                          const ImDrawData& drawn, Draw which) {
    if (drawn.TotalVtxCount == 0 || !atlas_) return;
    if (which == Draw::anew || !kept_->isDrawn) draw(commands, slots_[slot], drawn);
    showKept(commands, picture);
}

} // namespace sinew::viewer
