// Soft organs in a QVulkanWindow: Sinew records into Qt's command buffer, on Qt's device, and the skins are
// drawn from the buffers of the simulation.
// Keys: S drops an organ, Delete removes the oldest. Dragging pulls, with the right button it cuts.
//
// --play DIR does all of that by itself and writes pictures into DIR.
//
// --validate asks for the validation layer; the exit code is 1 if it complains.
#include "qt_window/drawing.hpp"
#include "qt_window/organs.hpp"

#include <QGuiApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QTimer>

#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace {

constexpr QVector3D eye(0, 0.6f, 1.0f), target(0, 0.08f, 0);
int complaints = 0;

class Window;

class Renderer : public QVulkanWindowRenderer {
public:
    explicit Renderer(Window& window) : window_(window) {}
    void initResources() override;
    void releaseResources() override;
    void startNextFrame() override;
    Organs* organs() { return organs_.get(); }

private:
    Window& window_;
    std::unique_ptr<Organs> organs_;
    std::unique_ptr<Drawing> drawing_;
};

class Window : public QVulkanWindow {
public:
    QVulkanWindowRenderer* createRenderer() override {
        return renderer_ = new Renderer(*this);
    } // the window owns it

    QMatrix4x4 clipFromWorld() {
        QMatrix4x4 matrix = clipCorrectionMatrix();
        matrix.perspective(35, static_cast<float>(width()) / static_cast<float>(height()), 0.1f, 10);
        matrix.lookAt(eye, target, QVector3D(0, 1, 0));
        return matrix;
    }
    Ray rayThrough(const QPointF& point) {
        const QVector4D clip(static_cast<float>(2 * point.x() / width() - 1),
                             static_cast<float>(2 * point.y() / height() - 1), 1, 1);
        const QVector4D far = clipFromWorld().inverted() * clip;
        const QVector3D direction = (far.toVector3DAffine() - eye).normalized();
        return {{eye.x(), eye.y(), eye.z()}, {direction.x(), direction.y(), direction.z()}};
    }
    QPointF pointOf(const QVector3D& place) {
        const QVector3D clip = (clipFromWorld() * QVector4D(place, 1)).toVector3DAffine();
        return {(double{clip.x()} + 1) * width() / 2, (double{clip.y()} + 1) * height() / 2};
    }

    void press(const QPointF& point, bool isCut) {
        at_ = point;
        isCut_ = isCut;
        if (Organs* organs = renderer_->organs(); organs && !isCut) organs->grab(rayThrough(point));
    }
    void move(const QPointF& point) {
        Organs* organs = renderer_->organs();
        if (!organs || !at_) return;
        if (isCut_)
            organs->cut(rayThrough(*at_), rayThrough(point));
        else
            organs->pull(rayThrough(point));
        at_ = point;
    }
    void leave() {
        at_.reset();
        if (Organs* organs = renderer_->organs()) {
            organs->release();
            organs->endStroke();
        }
    }
    void spawn() {
        const int place = spawned_++ % 3;
        if (Organs* organs = renderer_->organs()) organs->spawn(0.36f * static_cast<float>(place - 1), 0);
    }
    void removeOldest() {
        if (Organs* organs = renderer_->organs()) organs->removeOldest();
    }

    /// Does what a user would do, and keeps pictures.
    void play(const std::filesystem::path& folder) { folder_ = folder; }
    void endFrame() {
        if (folder_.empty())
            requestUpdate();
        else
            QTimer::singleShot(0, this, [this] { playFrame(); });
    }

private:
    void playFrame();
    void take(const char* name) {
        const QString file = QString::fromStdString((folder_ / name).string() + ".png");
        QImage picture = grab();
        if (colorFormat() == VK_FORMAT_B8G8R8A8_UNORM)
            picture = std::move(picture).rgbSwapped(); // Qt reads RGBA
        const bool isSaved = picture.save(file);
        std::printf("%s: %zu organs, %u pieces%s\n", qPrintable(file), renderer_->organs()->count(),
                    renderer_->organs()->pieces(), isSaved ? "" : ": not written");
        hasFailed_ |= !isSaved;
        pieces_[name] = renderer_->organs()->pieces();
    }
    void mousePressEvent(QMouseEvent* event) override {
        press(event->position(), event->button() == Qt::RightButton);
    }
    void mouseMoveEvent(QMouseEvent* event) override { move(event->position()); }
    void mouseReleaseEvent(QMouseEvent*) override { leave(); }
    void keyPressEvent(QKeyEvent* event) override {
        if (event->key() == Qt::Key_S) spawn();
        if (event->key() == Qt::Key_Delete) removeOldest();
    }

    Renderer* renderer_ = nullptr;
    std::optional<QPointF> at_;
    bool isCut_ = false, hasFailed_ = false;
    std::map<std::string, std::uint32_t> pieces_; // when each picture was taken
    int spawned_ = 0, frame_ = 0;
    std::filesystem::path folder_;
};

void Window::playFrame() {
    if (renderer_->organs()->isChanging()) { // beside the frames, which may be fast or slow
        requestUpdate();
        return;
    }
    const int frame = frame_++;
    if (frame % 30 == 0 && frame < 90) spawn();
    if (frame == 150) take("spawned");
    const QPointF left = pointOf({-0.36f, 0.1f, 0.05f}), right = pointOf({0.36f, 0.1f, 0.05f});
    if (frame == 151) press(left, false);
    if (frame > 160 && frame <= 190) move(left - QPointF(0, 4.0 * (frame - 160)));
    if (frame == 200) take("pulled");
    if (frame == 201) leave();
    const QPointF above = right - QPointF(-5, 140), below = right + QPointF(15, 140);
    if (frame == 240) press(above, true);
    if (frame > 240 && frame <= 246) move(above + (below - above) * (frame - 240) / 6.0);
    if (frame == 247) leave();
    const QPointF end = pointOf({0.46f, 0.06f, 0.05f});
    if (frame == 250) press(end, false);
    if (frame > 260 && frame <= 280) move(end + QPointF(4, -4) * (frame - 260));
    if (frame == 300) take("cut");
    if (frame == 301) leave();
    if (frame == 330) removeOldest();
    if (frame == 340) {
        take("removed");
        const bool isDone = pieces_["cut"] > pieces_["pulled"] && renderer_->organs()->count() == 2;
        QGuiApplication::exit(hasFailed_ || !isDone ? 1 : 0);
        return;
    }
    requestUpdate();
}

void Renderer::initResources() {
    const auto entry = reinterpret_cast<PFN_vkGetInstanceProcAddr>(
        window_.vulkanInstance()->getInstanceProcAddr("vkGetInstanceProcAddr"));
    organs_ =
        std::make_unique<Organs>(sinew::vk::HostDevice{.getInstanceProcAddr = entry,
                                                       .instance = window_.vulkanInstance()->vkInstance(),
                                                       .physicalDevice = window_.physicalDevice(),
                                                       .device = window_.device(),
                                                       .queueFamily = window_.graphicsQueueFamilyIndex()});
    drawing_ = std::make_unique<Drawing>(window_);
}

void Renderer::releaseResources() { // the window has waited for the device
    drawing_.reset();
    organs_.reset();
}

void Renderer::startNextFrame() {
    organs_->record(window_.currentCommandBuffer(), static_cast<std::uint32_t>(window_.currentFrame()));
    drawing_->record(window_, organs_->simulation(), window_.clipFromWorld());
    window_.frameReady();
    window_.endFrame();
}

} // namespace

int main(int argc, char** argv) {
    QGuiApplication application(argc, argv);
    const QStringList arguments = application.arguments();
    QVulkanInstance instance;
    instance.setApiVersion(QVersionNumber(1, 2));
    if (arguments.contains("--validate")) {
        const QByteArray layer = "VK_LAYER_KHRONOS_validation";
        if (!instance.supportedLayers().contains(layer)) {
            std::fprintf(stderr, "error: no validation layer\n");
            return 4;
        }
        instance.setLayers({layer});
        instance.installDebugOutputFilter([](VkDebugReportFlagsEXT flags, VkDebugReportObjectTypeEXT,
                                             std::uint64_t, std::size_t, std::int32_t, const char*,
                                             const char* message) {
            if ((flags & (VK_DEBUG_REPORT_ERROR_BIT_EXT | VK_DEBUG_REPORT_WARNING_BIT_EXT)) != 0) {
                ++complaints;
                std::fprintf(stderr, "validation: %s\n", message);
            }
            return true;
        });
    }
    if (!instance.create()) {
        std::fprintf(stderr, "error: Qt cannot make a Vulkan instance\n");
        return 4;
    }
    Window window;
    window.setVulkanInstance(&instance);
    window.setPreferredColorFormats({VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM});
    window.resize(960, 600);
    if (const qsizetype at = arguments.indexOf("--play"); at >= 0 && at + 1 < arguments.size()) {
        const std::filesystem::path folder = arguments[at + 1].toStdString();
        std::filesystem::create_directories(folder);
        window.play(folder);
    }
    window.show();
    const int code = application.exec();
    window.destroy();
    if (complaints > 0) std::fprintf(stderr, "error: the validation layer complained %d times\n", complaints);
    return complaints > 0 ? 1 : code;
}
