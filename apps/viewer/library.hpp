// The scenes that can be opened beside the one on show, and the opening of them, which takes its time and may
// fail, while the window goes on.
#pragma once

#include "viewer/opening.hpp"
#include "viewer/previews.hpp"

#include <functional>
#include <future>
#include <memory>

namespace sinew::viewer {

/// One thread uses it; it loads in another, and its destructor waits for that.
class Library {
public:
    /// What else there is to do for a scene that was loaded, in the thread that loads; throws what it likes.
    using Prepare = std::function<void(Opening&, const Options&)>;

    /// What a scene looks like, in the thread of the previews; likewise.
    using Draw = std::function<std::optional<Picture>(const Options&, const std::stop_token&)>;

    /// `options` as the program was started with. Offered are the scene files beside the one opened, or those
    /// built in.
    explicit Library(Options options, Prepare prepare = {}, Draw draw = {});

    /// What the first scene is opened with.
    const Options& options() const { return options_; }
    /// What the one on show was opened with.
    const Options& shown() const { return shown_->options; }
    const std::vector<std::string>& names() const { return names_; }
    /// Of the scene on show, or of none (-1).
    std::size_t current() const { return current_; }
    /// Of names(), where there is a Draw.
    Previews& previews() { return previews_; }

    /// Begins to open another scene for a picture `aspect` wide; nothing while one is being opened.
    void open(std::size_t name, float aspect);
    /// The one before (-1) or after (+1) in the list, round its ends.
    void openNext(int by, float aspect);
    /// A scene or a mesh: as on the command line.
    void openFile(const std::string& file, float aspect);
    /// The scene on show once more, to take over from it: with another solver, other substeps or another
    /// material, all else that was asked for as before.
    void reopen(const scenes::Overrides& overrides, const Again& again, float aspect);

    /// The scene on show once more, and from then on all of them, on another device.
    void reopenOn(const std::string& device, const Again& again, float aspect);

    /// What is on show plays on that device from here on, and what is opened next is to, too.
    void moveTo(const std::string& device);

    /// The state on show once more, to begin a log anew that begins from it.
    void playAgain(const InputFile& input, float aspect);

    bool isOpening() const { return opening_.valid(); }
    /// What was asked for, once it is there; until then nothing. Throws app::Failure and what scenes::load
    /// and Prepare throw: the scene on show is then still the current one.
    std::unique_ptr<Opening> take();
    /// After take() of what was to take over: that is made once more, for what is to be taken over by now.
    void askAgain(const Again& again, float aspect);
    /// After take(), where what it gave could not be shown: what was on show before is the current one again.
    void putBack();

private:
    struct Request {
        Options options;
        std::size_t name;
        std::optional<Again> again = {};
        std::optional<InputFile> input = {};
    };
    void begin(Request request, float aspect);
    Options ofScene(Options options, std::size_t name) const;

    Options options_;
    Prepare prepare_;
    std::vector<std::string> names_, files_; // no files: built in
    std::size_t current_;
    std::optional<Request> shown_, before_, asked_;
    std::future<std::unique_ptr<Opening>> opening_;
    Previews previews_; // last: its thread reads names_ and files_
};

} // namespace sinew::viewer
