// The renderer: draws skins, colliders, and balls for bodies without a skin, lit and shadowed, on a floor
// under a sky. The same code serves the window and files.
#pragma once

#include "sinew/simulation.hpp"
#include "viewer/render/balls.hpp"
#include "viewer/render/collider_meshes.hpp"
#include "viewer/render/halves.hpp"
#include "viewer/render/hand_mesh.hpp"
#include "viewer/render/picture_sets.hpp"
#include "viewer/render/pipeline.hpp"
#include "viewer/render/scene_light.hpp"

namespace sinew::viewer {

struct Quality {
    std::uint32_t shadowSize = 2048;                       ///< pixels a side
    std::uint32_t floorSize = 512;                         ///< map of the floor's light, pixels a side
    std::uint32_t shadowTaps = 32, skyTaps = 96;           ///< per pixel
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_4_BIT; ///< 1 and 4 work on every device
    bool keepsBackdrop = false; ///< caches sky and far floor while the camera rests; saves shading
    bool mayEnlarge = false;    ///< pictures may be drawn smaller than they are; needs one sample
    /// Draws backs of skins of closed bodies only if the camera may be inside one, or for a section.
    bool leavesBacks = false;
    std::uint32_t floorEvery = 1; ///< pictures per update of the floor's light
    /// Draws bodies and colliders as surfaces first and shades each pixel once; needs one sample.
    bool shadesOnce = false;
};

/// For moving pictures in a window on a software device: smaller maps, fewer taps, one sample.
Quality reducedQuality();

/// Whether a device made by the viewer can draw the edges of triangles.
bool drawsEdges(const vk::Device& device);

/// Whether the device is a CPU.
bool isSoftware(const vk::Device& device);

/// Owns passes, pipelines and maps, not the targets. Must not outlive its Device, which must not move.
class Renderer {
public:
    /// The most pictures recorded but not finished: those of a window, of films and of files, each of two
    /// halves, and one rehearsal.
    static constexpr std::uint32_t slots = 13;

    struct Target {
        VkFormat color = VK_FORMAT_R8G8B8A8_SRGB;
        VkImageLayout finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    };
    /// For a target format without sRGB encoding, the shaders encode. `light` belongs to the scene that will
    /// be drawn.
    Renderer(const vk::Device& device, const Target& target, const Quality& quality, const SceneLight& light);
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Pipelines that a renderer lacks.
    class Additions {
    public:
        std::size_t count() const { return made_.size(); }

    private:
        friend class Renderer;
        struct Made {
            std::size_t index;
            PipelineRequest request;
            Pipeline pipeline;
        };
        std::vector<Made> made_;
        std::optional<RenderPass> countsPass_;
    };
    /// Makes the missing pipelines for overlays with these layers. Any thread, while pictures are recorded,
    /// but not during add(). Throws vk::Error.
    Additions make(const Layers& layers) const;
    void add(Additions additions);
    /// Whether all pipelines for these layers exist.
    bool has(const Layers& layers) const noexcept;
    /// Makes and adds the missing pipelines and the images that the canvas needs. Throws vk::Error.
    void prepare(const Layers& layers, Canvas& canvas);
    /// Makes only the images of the canvas, if the renderer has these layers.
    void prepareCanvas(const Layers& layers, Canvas& canvas) const;
    /// Binds the pipelines of one addition, made for `layers`, and draws nothing visible into `canvas`, which
    /// need not be prepared and is never shown: drivers that compile at the first use compile here. Slot: see
    /// record().
    void recordRehearsal(VkCommandBuffer commands, std::uint32_t slot, Canvas& canvas, const Camera& camera,
                         const Layers& layers, const Additions& additions, std::size_t which) const;

    /// `scale` < 1 reduces the sides of the drawn image, if quality has mayEnlarge.
    Canvas makeCanvas(VkExtent2D extent, std::span<const VkImageView> pictures, float scale = 1) const;
    /// For pictures that are left in TRANSFER_SRC_OPTIMAL layout; if that is not the target's layout, the
    /// scale is 1.
    Canvas makeCopiedCanvas(VkExtent2D extent, std::span<const VkImageView> pictures, float scale = 1) const;
    /// For two pictures in one: each is recorded into its own canvas in its own slot; then both are copied to
    /// their places, `width` pixels from the left. `isCopied`: see makeCopiedCanvas().
    Halves makeHalves(VkExtent2D extent, std::span<const VkImageView> pictures, std::uint32_t width,
                      bool isCopied = false) const;
    void recordHalves(VkCommandBuffer commands, std::array<std::uint32_t, 2> ofHalves, const Halves& halves,
                      std::size_t picture) const noexcept;
    VkFormat format() const noexcept { return format_.color; }

    /// Records one picture. `commands` must be recording, outside a render pass, after recordSkin() of
    /// `simulation` in the same queue. `slot` < slots; its previous picture must be finished. Leaves the
    /// picture in the final layout. The layers of `overlay` must be prepared; layers that the device cannot
    /// draw are left out.
    void record(VkCommandBuffer commands, std::uint32_t slot, Canvas& canvas, std::size_t picture,
                const Camera& camera, const sim::Simulation& simulation,
                const Overlay& overlay = {}) noexcept;

private:
    static constexpr sim::Vec3 handColor{0.95f, 0.62f, 0.10f}, pinColor{0.02f, 0.30f, 0.72f},
        strokeColor{0.10f, 0.55f, 0.95f}, gaugeColor{0.95f, 0.75f, 0.15f};
    static constexpr layout::vec4 barColor{0.16f, 0.20f, 0.24f, 0.15f}, // w: gloss, opacity
        sideColor{0.30f, 0.45f, 0.60f, 0.30f};

    void addPipeline(Additions& to, std::size_t index, PipelineRequest request) const;
    void addLit(Additions& to, std::size_t index, PipelineRequest request) const;
    void addDepths(Additions& to, std::size_t ofShadow, std::size_t ofPlan,
                   const PipelineRequest& request) const;
    /// The form of a pipeline that omits the side cut away by a section, if there is such a form.
    std::size_t opened(std::size_t pipeline, const Layers& layers) const noexcept {
        return layers.section && has(pipeline + pipelineCount) ? pipeline + pipelineCount : pipeline;
    }
    bool has(std::size_t pipeline) const noexcept { return pipelines_[pipeline].has_value(); }
    bool hasSection() const noexcept;
    /// The pipelines of layers that change how bodies are drawn; if the first one exists, all do.
    struct Feature {
        bool (*isIn)(const Layers& layers);
        std::size_t first;
        void (Renderer::*make)(Additions& to) const;
    };
    static std::span<const Feature> features();
    bool isDrawn(const Feature& feature, const Layers& layers) const;
    /// Whether a layer of the table is on and draws something of its own.
    static bool isDrawn(std::size_t layer, const Layers& layers);
    void makeLayer(Additions& to, std::size_t layer) const;
    void makeGlass(Additions& to) const;
    void makeValues(Additions& to) const;
    void makeWires(Additions& to) const;
    void makeSection(Additions& to) const;
    void makeOpened(Additions& to, std::size_t index, const PipelineRequest& whole) const;
    void makeCounts(Additions& to) const;
    void makeMaps(Additions& to) const;
    void makeBodies(Additions& to) const;
    void makeBackdrop(Additions& to) const;
    void makeEnlarging(Additions& to) const;
    void makeCuts(Additions& to) const;
    void makeSurfaces(Additions& to) const;
    void makeSheets(Additions& to) const;
    void makeBalls(Additions& to) const;
    void makeHeld(Additions& to) const;
    void makeWalls(Additions& to) const;
    static const vk::ShaderCode* openedForm(std::size_t index, const PipelineRequest& request) noexcept;
    const RenderPass& countsPass(Additions& to) const;
    /// The pass of a picture, or the one that keeps the depth of surfaces.
    const RenderPass& passOf(const Canvas& canvas, bool keepsDepth = false) const noexcept;
    void addSurfaces(Canvas& canvas) const;
    /// Whether pictures with these layers are shaded from surfaces.
    bool shadesOnce(const Canvas& canvas, const Layers& layers) const noexcept;
    void recordSurfaces(VkCommandBuffer commands, const Canvas& canvas, const sim::Simulation& simulation,
                        const Layers& layers) const noexcept;
    /// Draws nothing with pipelines that a picture may need later, so that a driver that compiles at the
    /// first use does so before a stroke begins.
    void drawUnseen(VkCommandBuffer commands, std::initializer_list<std::size_t> pipelines) const noexcept;
    void bindNothing(VkCommandBuffer commands) const noexcept; ///< vertices of a degenerate triangle
    void recordMaps(VkCommandBuffer commands, const sim::Simulation& simulation, const Overlay& overlay,
                    bool isFloorDue) const noexcept;
    /// Pipelines of a light map: for all faces, for faces towards the light, and for balls.
    struct Shades {
        std::size_t all, facing, balls;
    };
    void drawShades(VkCommandBuffer commands, const Shades& shades, const sim::Simulation& simulation,
                    const Overlay& overlay) const noexcept;
    void recordCounts(VkCommandBuffer commands, const Canvas& canvas, const sim::Simulation& simulation,
                      const Overlay& overlay) const noexcept;
    void drawInsides(VkCommandBuffer commands, const sim::Simulation& simulation,
                     const Overlay& overlay) const noexcept;
    void drawCap(VkCommandBuffer commands, const Canvas& canvas, const Layers& layers) const noexcept;
    void recordLayers(VkCommandBuffer commands, const sim::Simulation& simulation,
                      const Overlay& overlay) const noexcept;
    void drawLayers(VkCommandBuffer commands, const sim::Simulation& simulation,
                    const Overlay& overlay) const noexcept;
    void drawValues(VkCommandBuffer commands, const sim::Simulation& simulation,
                    const Overlay& overlay) const noexcept;
    /// The target of a picture.
    struct Sheet {
        Canvas& canvas;
        std::size_t picture;
        std::uint32_t slot;
    };
    Backdrop::Use prepareBackdrop(const Sheet& sheet, const layout::FrameParams& params) const noexcept;
    void recordBackdrop(VkCommandBuffer commands, const Canvas& canvas,
                        const layout::FrameParams& params) const noexcept;
    void recordPicture(VkCommandBuffer commands, const Sheet& sheet, const sim::Simulation& simulation,
                       const Overlay& overlay, const layout::FrameParams& params,
                       bool hasBackdrop) const noexcept;
    void recordEnlarging(VkCommandBuffer commands, const Enlarging& enlarging,
                         std::size_t picture) const noexcept;
    void drawScreen(VkCommandBuffer commands, std::size_t pipeline) const noexcept;
    void drawGround(VkCommandBuffer commands, const layout::FrameParams& params,
                    bool isLitAlone) const noexcept;
    void begin(VkCommandBuffer commands, const RenderPass& pass, VkFramebuffer framebuffer, VkExtent2D extent,
               std::span<const VkClearValue> clear) const noexcept;
    void bind(VkCommandBuffer commands, std::size_t pipeline) const noexcept;
    /// Pipelines for any skin, and for closed skins whose triangles face outwards.
    struct OfSkins {
        OfSkins(std::size_t one) : any(one), solids(one) {}
        OfSkins(std::size_t ofAny, std::size_t ofSolids) : any(ofAny), solids(ofSolids) {}
        std::size_t any, solids;
        bool leavesSheets = false;
    };
    void drawSheets(VkCommandBuffer commands, const Layers& layers,
                    const sim::Simulation& simulation) const noexcept;
    void drawSkins(VkCommandBuffer commands, OfSkins pipelines, const sim::Simulation& simulation,
                   const LayerBuffers& buffers = {}) const noexcept;
    void drawThings(VkCommandBuffer commands, const sim::Simulation& simulation, const Layers& layers,
                    std::size_t pipeline) const noexcept;
    void drawColliders(VkCommandBuffer commands, std::size_t pipeline,
                       const sim::Simulation& simulation) const noexcept;
    void drawHostColliders(VkCommandBuffer commands, std::size_t pipeline,
                           const sim::Simulation& simulation) const noexcept;
    void drawWalls(VkCommandBuffer commands, std::size_t pipeline, const Walls::Part& part,
                   const layout::vec4& color) const noexcept;
    void drawBalls(VkCommandBuffer commands, std::size_t pipeline, const sim::Simulation& simulation,
                   const Overlay& overlay) const noexcept;
    void drawMarks(VkCommandBuffer commands, const sim::Simulation& simulation,
                   const Layers& layers) const noexcept;
    void drawCuts(VkCommandBuffer commands, std::size_t ofInside, std::size_t ofClipped,
                  const sim::Simulation& simulation, const LayerBuffers& buffers = {}) const noexcept;
    static constexpr std::size_t pointsASlot = mostStrokePoints + 2; // a stroke and a gauge
    void drawStroke(VkCommandBuffer commands, std::span<const Vector3> stroke, const sim::Vec3& color,
                    std::size_t first) const noexcept;
    void drawHand(VkCommandBuffer commands, const sim::Simulation& simulation, const Hand& hand,
                  const sim::Vec3& color, float ball) const noexcept;
    void bindMesh(VkCommandBuffer commands, const vk::BufferView& vertices,
                  const vk::BufferView& indices) const noexcept;
    void drawIndirect(VkCommandBuffer commands, const vk::BufferView& draws,
                      std::size_t which) const noexcept;
    void push(VkCommandBuffer commands, const layout::SkinPush& values) const noexcept;
    void push(VkCommandBuffer commands, const sim::Vec3& color, float gloss, const sim::Pose& pose,
              float scale = 1) const noexcept;

    const vk::Device& device_;
    SceneLight light_;
    ColliderMeshes colliders_, sphere_; // the second: of radius 1, for colliders of tools
    CanvasFormat format_;
    VkImageLayout finalLayout_;
    Quality quality_;
    bool drawsEdges_;
    std::uint64_t pictures_ = 0;
    bool leavesBacks_ = false; // for this picture
    LightMaps maps_;
    RenderPass pass_;
    vk::Buffer insidesOfSkins_; ///< Insides of inside.glsl
    PictureSets sets_;
    Balls balls_, insides_, marks_;
    Walls walls_;
    HandMesh hand_;
    vk::Buffer strokes_;                                        // vec4, pointsASlot each
    vk::Buffer sheets_;                                         // vec4, one for each vertex of skins
    vk::Buffer nothing_;                                        // one degenerate corner
    std::array<vk::SpecialisationConstant, 3> look_, heldLook_; // for lit bodies; for marks of held particles
    enum PipelineIndex : std::size_t {
        shadowPipeline,
        planPipeline,
        shadowFacingPipeline, // faces that look towards the light: a closed body's nearest ones
        planFacingPipeline,
        floorPipeline,
        skinPipeline,
        skinBacksPipeline,
        groundPipeline,
        skyPipeline,
        backdropPipeline,
        enlargePipeline,
        handPipeline,
        insidePipeline,
        clippedPipeline,
        skinSurfacePipeline,
        skinBacksSurfacePipeline,
        insideSurfacePipeline,
        clippedSurfacePipeline,
        surfacesPipeline, // shades them
        clothPipeline,
        clothPiecesPipeline, // along cuts
        ballShadowPipeline,
        ballPlanPipeline,
        ballPipeline,
        heldPipeline,
        wallPipeline,
        skinGlassPipeline,
        insideGlassPipeline,
        clippedGlassPipeline,
        skinValuesPipeline,
        cutValuesPipeline,
        ballValuesPipeline,
        wiresPipeline,
        skinCountPipeline,
        cutCountPipeline,
        pieceCountPipeline,
        ballCountPipeline,
        ballValuesCountPipeline,
        sectionValuesPipeline,
        capPipeline,
        layerPipelines, // one for each row of layerTable()
        pipelineCount = layerPipelines + mostLayers
    };
    std::array<PipelineRequest, pipelineCount> requests_; // of the pipelines that exist
    // A pipeline exists once a layer that uses it is prepared. The second half holds, in the same order, the
    // forms for a section.
    std::array<std::optional<Pipeline>, 2 * pipelineCount> pipelines_;
    std::optional<RenderPass> countsPass_;   // for counts of a section
    std::optional<RenderPass> readablePass_; // like pass_, for pictures that shaders read
    RenderPass copiedPass_;                  // like pass_, for pictures that are copied
    std::optional<RenderPass> wholePass_;    // if pictures may be enlarged
    std::optional<RenderPass> surfacesPass_; // if each pixel is shaded once
    std::vector<RenderPass> keepingPasses_;  // then: like pass_, readablePass_, copiedPass_, with its depth
};

} // namespace sinew::viewer
