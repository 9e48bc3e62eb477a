// The list of scenes and their loader. Loading runs in another thread and may fail, while the window goes on.
#pragma once

#include "scenes/gallery.hpp"
#include "viewer/jobs/opened_scene.hpp"
#include "viewer/jobs/previews.hpp"

#include <functional>
#include <future>
#include <memory>

namespace sinew::viewer {

/// The first sentence of the comment that a scene file begins with; empty if it begins with something else.
std::string firstSentence(std::string_view text);

/// Used by one thread; loads in another, which the destructor waits for.
class SceneLoader {
public:
    /// Further work for a loaded scene, in the loading thread; may throw.
    using Prepare = std::function<void(OpenedScene&, const Options&)>;

    /// Draws the preview of a scene, in the thread of the previews; may throw.
    using Draw = std::function<std::optional<Picture>(const Options&, const std::stop_token&)>;

    /// `options` as the program was started with. The list holds the scene files in the folder of the opened
    /// one, or the built-in scenes.
    explicit SceneLoader(Options options, Prepare prepare = {}, Draw draw = {});

    /// Options of the first scene.
    const Options& options() const { return options_; }
    /// Options of the scene on show.
    const Options& shown() const { return shown_->options; }
    const std::vector<std::string>& names() const { return names_; }
    /// The first sentence of each scene's file, without the #; empty = the file has none.
    const std::vector<std::string>& sentences() const { return sentences_; }
    /// Marks of each scene; scenes for studies come last.
    const std::vector<scenes::Gallery>& marks() const { return marks_; }
    /// Absolute paths of files that were opened though the list has them not, newest first.
    const std::vector<std::string>& recent() const { return recent_; }
    /// Those of earlier runs.
    void addRecent(const std::vector<std::string>& files);
    /// Index of the scene on show, or -1 if it is not in the list.
    std::size_t current() const { return current_; }
    /// Previews of names(), if there is a Draw.
    Previews& previews() { return previews_; }

    /// Starts to open another scene for a picture of aspect ratio `aspect`; ignored while a scene is being
    /// opened.
    void open(std::size_t name, float aspect);
    /// Opens the one before (-1) or after (+1) in the list, cyclically.
    void openNext(int by, float aspect);
    /// Opens a scene or a mesh, as on the command line.
    void openFile(const std::string& file, float aspect);
    /// Opens the scene on show again, to take over from it with another solver, other substeps or another
    /// material; all other options stay.
    void reopen(const scenes::Overrides& overrides, const ReloadRequest& reload, float aspect);

    /// Opens the scene on show again on another device; later scenes also use that device.
    void reopenOn(const std::string& device, const ReloadRequest& reload, float aspect);

    /// Records that the scene on show, and all opened later, use that device.
    void moveTo(const std::string& device);

    /// Opens the state on show again, to start a log from it.
    void playAgain(const InputFile& input, float aspect);

    bool isOpening() const { return opening_.valid(); }
    /// The requested scene once it is loaded, else null. Throws app::Failure and the exceptions of
    /// scenes::load and Prepare; the scene on show then stays the current one.
    std::unique_ptr<OpenedScene> take();
    /// After take() of a scene that was to take over: makes it again, to take over the present state.
    void askAgain(const ReloadRequest& reload, float aspect);
    /// After take(), if the scene could not be shown: makes the one before current again.
    void putBack();

private:
    struct Request {
        Options options;
        std::size_t name;
        std::optional<ReloadRequest> reload = {};
        std::optional<InputFile> input = {};
    };
    void remember(const Request& shown);
    void begin(Request request, float aspect);
    Options ofScene(Options options, std::size_t name) const;

    Options options_;
    Prepare prepare_;
    std::vector<std::string> names_, sentences_, files_; // files_ is empty for built-in scenes
    std::vector<scenes::Gallery> marks_;
    std::vector<std::string> recent_;
    std::size_t current_;
    std::optional<Request> shown_, before_, asked_;
    std::future<std::unique_ptr<OpenedScene>> opening_;
    Previews previews_; // last: its thread reads names_ and files_
};

} // namespace sinew::viewer
